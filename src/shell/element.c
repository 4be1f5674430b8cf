#include "shell/element.h"

#include <math.h>
#include <string.h>

#include <cblas.h>

#include "base/vector.h"
#include "shell/lamina.h"
#include "shell/tensor.h"

static void interpolate(int nodes, const double *N, const double (*X)[3], double out[3])
{
    double sum[3] = {0};
    for (int k = 0; k < nodes; k++)
        for (int c = 0; c < 3; c++) sum[c] += N[k] * X[k][c];
    memcpy(out, sum, sizeof sum);
}

void ves_shell_frame_at(const ves_shell_body *body, const ves_shell_table *table, int point,
                        ves_shell_frame *f)
{
    int nodes = body->kind->nodes, from = point * nodes;
    interpolate(nodes, table->Nr + from, body->X, f->Xr);
    interpolate(nodes, table->Ns + from, body->X, f->Xs);
    interpolate(nodes, table->Nr + from, body->V, f->Vr);
    interpolate(nodes, table->Ns + from, body->V, f->Vs);
    interpolate(nodes, table->N + from, body->V, f->V);
}

/* The same at once, as products with the tables. */
static void frames_fill(const ves_shell_body *body, const ves_shell_table *t, double (*both)[6],
                        ves_shell_frame *out)
{
    enum { SIX = 6, FRAME = sizeof *out / sizeof(double) };
    const int nodes = body->kind->nodes;
    const double *of[3] = {t->Nr, t->Ns, t->N};
    double *to[3] = {out->Xr, out->Xs, out->V};
    for (int k = 0; k < nodes; k++) {
        memcpy(both[k], body->X[k], sizeof body->X[k]);
        memcpy(both[k] + 3, body->V[k], sizeof body->V[k]);
    }
    for (int k = 0; k < 3; k++)
        cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, t->points, k < 2 ? SIX : 3, nodes, 1, of[k],
                    nodes, both[0] + (k < 2 ? 0 : 3), SIX, 0, to[k], FRAME);
}

const ves_shell_frame *ves_shell_frames(const ves_shell_body *body, const ves_shell_table *table,
                                        const ves_shell_scratch *scratch)
{
    frames_fill(body, table, scratch->both, scratch->frame);
    return scratch->frame;
}

/* --- strains at points: of columns, or of one field of displacements --- */

/* Where in the eight strains a strain has its even part, and whether it has an odd one, 3 places further. */
static const int EVEN[VES_STRAINS] = {0, 1, 2, 6, 7};
static const double Z = VES_LEVEL;

static bool bends(int strain)
{
    return strain <= VES_RS;
}

/* The eight strains of a motion m (element.h). */
static void strains_of(const ves_shell_frame *f, const ves_shell_frame *m, double e[VES_GENERAL])
{
    e[0] = ves_dot(f->Xr, m->Xr) + Z * Z * ves_dot(f->Vr, m->Vr);
    e[1] = ves_dot(f->Xs, m->Xs) + Z * Z * ves_dot(f->Vs, m->Vs);
    e[2] = ves_dot(f->Xr, m->Xs) + ves_dot(f->Xs, m->Xr) +
           Z * Z * (ves_dot(f->Vr, m->Vs) + ves_dot(f->Vs, m->Vr));
    e[3] = Z * (ves_dot(f->Xr, m->Vr) + ves_dot(f->Vr, m->Xr));
    e[4] = Z * (ves_dot(f->Xs, m->Vs) + ves_dot(f->Vs, m->Xs));
    e[5] =
        Z * (ves_dot(f->Xr, m->Vs) + ves_dot(f->Xs, m->Vr) + ves_dot(f->Vr, m->Xs) + ves_dot(f->Vs, m->Xr));
    e[6] = ves_dot(f->Xr, m->V) + ves_dot(f->V, m->Xr);
    e[7] = ves_dot(f->Xs, m->V) + ves_dot(f->V, m->Xs);
}

/* The same of a column, which moves one node alone: e[k] at e[k * stride]. */
static void strains_of_column(const ves_shell_frame *f, double N, double Nr, double Ns,
                              const ves_shell_column *c, int stride, double *e)
{
    const double *a = c->vector;
    double Xr = ves_dot(f->Xr, a), Xs = ves_dot(f->Xs, a), Vr = ves_dot(f->Vr, a), Vs = ves_dot(f->Vs, a);
    const double even[3] = {Nr * Xr, Ns * Xs, Nr * Xs + Ns * Xr},
                 odd[3] = {Nr * Vr, Ns * Vs, Nr * Vs + Ns * Vr};
    double V = ves_dot(f->V, a);
    for (int k = 0; k < 3; k++) {
        e[k * stride] = c->turns ? Z * Z * odd[k] : even[k];
        e[(3 + k) * stride] = Z * (c->turns ? even[k] : odd[k]);
    }
    e[6 * stride] = c->turns ? N * Xr : Nr * V;
    e[7 * stride] = c->turns ? N * Xs : Ns * V;
}

/* What is strained: columns, or (NULL) one field. */
typedef struct cause {
    int columns;
    const ves_shell_column *column;
    const double (*U)[3], (*A)[3];
} cause;

/* e [VES_GENERAL][columns] at a point of a table. */
static void strains_at(const ves_shell_body *body, const ves_shell_table *t, int point, const cause *of,
                       double *e)
{
    int nodes = body->kind->nodes;
    ves_shell_frame frame, motion;
    ves_shell_frame_at(body, t, point, &frame);
    if (!of->column) {
        const ves_shell_body moved = {body->kind, of->U, of->A};
        ves_shell_frame_at(&moved, t, point, &motion);
        strains_of(&frame, &motion, e);
        return;
    }
    for (int c = 0; c < of->columns; c++) {
        int at = point * nodes + of->column[c].node;
        strains_of_column(&frame, t->N[at], t->Nr[at], t->Ns[at], &of->column[c], of->columns, e + c);
    }
}

/* --- mixed interpolation --- */

static int tied_points(const ves_shell_kind *kind)
{
    int count = 0;
    for (int k = 0; k < VES_STRAINS; k++) count += kind->tied[k].points;
    return count;
}

/* Row `to` gets factor times row `from`, of `columns`. */
static void add(int columns, double factor, const double *from, double *to)
{
    for (int c = 0; c < columns; c++) to[c] += factor * from[c];
}

/* All strains at all tying points: [tied][VES_GENERAL][columns], strain by strain. */
static void tied_fill(const ves_shell_body *body, const cause *of, double *tied)
{
    for (int k = 0; k < VES_STRAINS; k++)
        for (int q = 0; q < body->kind->tied[k].points; q++, tied += VES_GENERAL * of->columns)
            strains_at(body, &body->kind->tied[k], q, of, tied);
}

/* The membrane of MITC4+ at (r, s) as sums of its five tied strains [Ko, Lee, Bathe 2017, eq 27]: coefficient[strain]
 * of e_rr(A), e_rr(B), e_ss(C), e_ss(D), e_rs(E), tensor components. What distorts the element enters by
 * x_d = sum xi_i eta_i x_i / 4 in the plane of x_r and x_s at the centre. */
typedef struct plus {
    double a[5]; /* a_A .. a_E */
} plus;

static void plus_make(const ves_shell_body *body, plus *p)
{
    static const double R[4] = {-1, 1, -1, 1}, S[4] = {-1, -1, 1, 1};
    double xr[3] = {0}, xs[3] = {0}, xd[3] = {0}, n[3], dual[2][3];
    for (int k = 0; k < 4; k++)
        for (int c = 0; c < 3; c++) {
            xr[c] += R[k] * body->X[k][c] / 4;
            xs[c] += S[k] * body->X[k][c] / 4;
            xd[c] += R[k] * S[k] * body->X[k][c] / 4;
        }
    ves_cross(xr, xs, n);
    double area = ves_dot(n, n);
    ves_cross(xs, n, dual[0]);
    ves_cross(n, xr, dual[1]);
    double cr = ves_dot(xd, dual[0]) / area, cs = ves_dot(xd, dual[1]) / area, d = cr * cr + cs * cs - 1;
    p->a[0] = cr * (cr - 1) / (2 * d), p->a[1] = cr * (cr + 1) / (2 * d);
    p->a[2] = cs * (cs - 1) / (2 * d), p->a[3] = cs * (cs + 1) / (2 * d);
    p->a[4] = 2 * cr * cs / d;
}

static void plus_at(const plus *p, const double at[2], ves_strain strain, double w[5])
{
    const double *a = p->a, r = at[0], s = at[1], rr = r * r - 1, ss = s * s - 1;
    if (strain == VES_RR) {
        const double of[5] = {(1 - 2 * a[0] + s + 2 * a[0] * s * s) / 2,
                              (1 - 2 * a[1] - s + 2 * a[1] * s * s) / 2, a[2] * ss, a[3] * ss, a[4] * ss};
        memcpy(w, of, sizeof of);
    } else if (strain == VES_SS) {
        const double of[5] = {a[0] * rr, a[1] * rr, (1 - 2 * a[2] + r + 2 * a[2] * r * r) / 2,
                              (1 - 2 * a[3] - r + 2 * a[3] * r * r) / 2, a[4] * rr};
        memcpy(w, of, sizeof of);
    } else {
        const double of[5] = {(r + 4 * a[0] * r * s) / 4, (-r + 4 * a[1] * r * s) / 4,
                              (s + 4 * a[2] * r * s) / 4, (-s + 4 * a[3] * r * s) / 4, 1 + a[4] * r * s};
        memcpy(w, of, sizeof of);
    }
}

/* The even part of a strain in the surface, of MITC4+; the fifth tied strain is twice e_rs, and so is that of RS. */
static void plus_mix(const plus *p, const double at[2], int strain, int columns, const double *tied,
                     double *row)
{
    static const int OF[5] = {0, 0, 1, 1, 2};
    double w[5];
    plus_at(p, at, (ves_strain)strain, w);
    memset(row, 0, sizeof *row * (size_t)columns);
    for (int k = 0; k < 5; k++) {
        double factor = w[k] * (k == 4 ? 0.5 : 1) * (strain == VES_RS ? 2 : 1);
        add(columns, factor, tied + (k * VES_GENERAL + OF[k]) * columns, row);
    }
}

/* The eight strains at one point, [VES_GENERAL][columns]. */
static void mix(const ves_shell_body *body, const ves_shell_points *out, int q, const plus *p, int columns,
                const double *tied, double *row)
{
    const ves_shell_kind *kind = body->kind;
    for (int k = 0, from = 0; k < VES_STRAINS; from += kind->tied[k].points, k++) {
        if (kind->plus && bends(k)) plus_mix(p, out->at[q], k, columns, tied, row + EVEN[k] * columns);
        if (!out->mix[k]) continue;
        for (int part = 0; part < 1 + bends(k); part++) {
            double *to = row + (EVEN[k] + 3 * part) * columns;
            memset(to, 0, sizeof *to * (size_t)columns);
            for (int i = 0; i < kind->tied[k].points; i++)
                add(columns, out->mix[k][q * kind->tied[k].points + i],
                    tied + ((from + i) * VES_GENERAL + EVEN[k] + 3 * part) * columns, to);
        }
    }
}

/* Does every strain come from tying points? Then none is wanted at the points themselves. */
static bool all_mixed(const ves_shell_points *out)
{
    bool all = true;
    for (int k = 0; k < VES_STRAINS; k++) all = all && out->mix[k];
    return all;
}

static void rows_fill(const ves_shell_body *body, const ves_shell_points *out, const cause *of, double *tied,
                      double *row)
{
    plus p = {{0}};
    if (body->kind->plus) plus_make(body, &p);
    tied_fill(body, of, tied);
    for (int q = 0; q < out->points; q++, row += VES_GENERAL * of->columns) {
        if (!all_mixed(out)) strains_at(body, &out->table, q, of, row);
        mix(body, out, q, &p, of->columns, tied, row);
    }
}

void ves_shell_strains(const ves_shell_body *body, const ves_shell_points *at, const double (*U)[3],
                       const double (*A)[3], const ves_shell_scratch *scratch, double *strain)
{
    const cause of = {.columns = 1, .U = U, .A = A};
    const ves_shell_body moved = {body->kind, U, A};
    if (!body->kind->twice[0]) {
        rows_fill(body, at, &of, scratch->tied, strain);
        return;
    }
    frames_fill(body, &at->table, scratch->both, scratch->frame);
    frames_fill(&moved, &at->table, scratch->both, scratch->motion);
    for (int q = 0; q < at->points; q++)
        strains_of(&scratch->frame[q], &scratch->motion[q], strain + q * VES_GENERAL);
}

/* --- the transpose --- */

/* What forces on the eight strains at a point do on the motion there, and that on nodes. */
static void strains_pull(const ves_shell_body *body, const ves_shell_table *t, int point, const double *g,
                         double (*U)[3], double (*A)[3])
{
    const int nodes = body->kind->nodes, from = point * nodes;
    ves_shell_frame f;
    ves_shell_frame m;
    ves_shell_frame_at(body, t, point, &f);
    for (int c = 0; c < 3; c++) {
        double Xr = f.Xr[c], Xs = f.Xs[c], Vr = f.Vr[c], Vs = f.Vs[c];
        m.Xr[c] = g[0] * Xr + g[2] * Xs + Z * (g[3] * Vr + g[5] * Vs) + g[6] * f.V[c];
        m.Xs[c] = g[1] * Xs + g[2] * Xr + Z * (g[4] * Vs + g[5] * Vr) + g[7] * f.V[c];
        m.V[c] = g[6] * Xr + g[7] * Xs;
        m.Vr[c] = Z * Z * (g[0] * Vr + g[2] * Vs) + Z * (g[3] * Xr + g[5] * Xs);
        m.Vs[c] = Z * Z * (g[1] * Vs + g[2] * Vr) + Z * (g[4] * Xs + g[5] * Xr);
    }
    for (int k = 0; k < nodes; k++) {
        double N = t->N[from + k], Nr = t->Nr[from + k], Ns = t->Ns[from + k];
        for (int c = 0; c < 3; c++) {
            U[k][c] += Nr * m.Xr[c] + Ns * m.Xs[c];
            A[k][c] += N * m.V[c] + Nr * m.Vr[c] + Ns * m.Vs[c];
        }
    }
}

/* Takes from the forces at a point what belongs to tying points, and adds it there. */
static void unmix(const ves_shell_body *body, const ves_shell_points *out, int q, const plus *p, double *row,
                  double *tied)
{
    static const int OF[5] = {0, 0, 1, 1, 2};
    const ves_shell_kind *kind = body->kind;
    for (int k = 0, from = 0; k < VES_STRAINS; from += kind->tied[k].points, k++) {
        if (kind->plus && bends(k)) {
            double w[5];
            plus_at(p, out->at[q], (ves_strain)k, w);
            for (int i = 0; i < 5; i++)
                tied[i * VES_GENERAL + OF[i]] +=
                    w[i] * (i == 4 ? 0.5 : 1) * (k == VES_RS ? 2 : 1) * row[EVEN[k]];
            row[EVEN[k]] = 0;
        }
        for (int part = 0; out->mix[k] && part < 1 + bends(k); part++) {
            int at = EVEN[k] + 3 * part;
            for (int i = 0; i < kind->tied[k].points; i++)
                tied[(from + i) * VES_GENERAL + at] += out->mix[k][q * kind->tied[k].points + i] * row[at];
            row[at] = 0;
        }
    }
}

void ves_shell_pull(const ves_shell_body *body, const ves_shell_points *at, const double *force,
                    const ves_shell_scratch *scratch, double (*U)[3], double (*A)[3])
{
    const ves_shell_kind *kind = body->kind;
    double *tied = scratch->tied;
    plus p = {{0}};
    if (kind->plus) plus_make(body, &p);
    memset(tied, 0, sizeof *tied * (size_t)(tied_points(kind) * VES_GENERAL));
    for (int q = 0; q < at->points; q++) {
        double row[VES_GENERAL];
        memcpy(row, force + q * VES_GENERAL, sizeof row);
        unmix(body, at, q, &p, row, tied);
        if (!all_mixed(at)) strains_pull(body, &at->table, q, row, U, A);
    }
    for (int k = 0; k < VES_STRAINS; k++)
        for (int q = 0; q < kind->tied[k].points; q++, tied += VES_GENERAL)
            strains_pull(body, &kind->tied[k], q, tied, U, A);
}

/* --- stiffness --- */

static size_t most(size_t a, size_t b)
{
    return a > b ? a : b;
}

ves_status ves_shell_scratch_make(const ves_shell_kind *kind, int kinds, int columns, ves_arena *arena,
                                  ves_shell_scratch *scratch)
{
    size_t rows = (size_t)(VES_GENERAL * columns), nodes = 0, points = 0, row = 0, tied = 0, line = 0,
           block = 0;
    for (int k = 0; k < kinds; k++) {
        ves_shell_tensor_size sums = ves_shell_tensor_needs(&kind[k]);
        nodes = most(nodes, (size_t)kind[k].nodes);
        points = most(points, most((size_t)kind[k].rule.points, (size_t)kind[k].lattice.points));
        row = most(row, kind[k].twice[0] ? sums.points : (size_t)kind[k].rule.points * rows);
        line = most(line, sums.lines), block = most(block, sums.blocks);
        tied = most(tied, (size_t)tied_points(&kind[k]) * rows);
    }
    scratch->row = ves_arena_doubles(arena, row);
    scratch->tied = ves_arena_doubles(arena, tied);
    scratch->line = ves_arena_doubles(arena, line);
    scratch->block = ves_arena_doubles(arena, block);
    scratch->begin = ves_arena_take(arena, nodes + 1, sizeof *scratch->begin);
    scratch->both = ves_arena_take(arena, nodes, sizeof *scratch->both);
    scratch->frame = ves_arena_take(arena, points, sizeof *scratch->frame);
    scratch->motion = ves_arena_take(arena, points, sizeof *scratch->motion);
    return scratch->row && scratch->tied && scratch->line && scratch->block && scratch->begin &&
                   scratch->both && scratch->frame && scratch->motion
               ? VES_OK
               : VES_MEMORY;
}

/* Rows e become F e, in place: F is upper triangular. */
static void rows_weigh(int columns, double F[VES_GENERAL][VES_GENERAL], double *row)
{
    for (int c = 0; c < columns; c++)
        for (int i = 0; i < VES_GENERAL; i++) {
            double sum = 0;
            for (int k = i; k < VES_GENERAL; k++) sum += F[i][k] * row[k * columns + c];
            row[i * columns + c] = sum;
        }
}

/* Of tied elements K = sum over points of e' G e = R' R with the rows R = F e of all points: one product. */
ves_status ves_shell_stiffness(const ves_shell_body *body, const ves_shell_material *material, int columns,
                               const ves_shell_column *column, const ves_shell_scratch *scratch, double *K)
{
    const ves_shell_points *rule = &body->kind->rule;
    const cause of = {.columns = columns, .column = column};
    if (body->kind->twice[0]) return ves_shell_tensor_stiffness(body, material, columns, column, scratch, K);
    rows_fill(body, rule, &of, scratch->tied, scratch->row);
    for (int q = 0; q < rule->points; q++) {
        ves_shell_frame frame;
        double F[VES_GENERAL][VES_GENERAL];
        ves_shell_frame_at(body, &rule->table, q, &frame);
        if (!ves_lamina_factor(&frame, material, rule->weight[q], F)) return VES_DEGENERATE;
        rows_weigh(columns, F, scratch->row + q * VES_GENERAL * columns);
    }
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, columns, rule->points * VES_GENERAL, 1, scratch->row,
                columns, 0, K, columns);
    return VES_OK;
}

/* --- stresses --- */

bool ves_shell_stress_at(const ves_shell_frame *frame, const ves_shell_material *material,
                         const double strain[VES_GENERAL], double z, double stress[VES_STRESSES])
{
    ves_lamina lamina;
    double local[VES_STRESSES] = {0};
    if (!ves_lamina_at(frame, z, &lamina)) return false;
    for (int i = 0; i < VES_STRESSES; i++)
        for (int j = 0; j < VES_STRESSES; j++) {
            double at_level = j < 3 ? strain[j] + z / Z * strain[3 + j] : strain[3 + j];
            local[i] += lamina.T[i][j] * at_level;
        }
    ves_lamina_stress(material, local, stress);
    return true;
}
