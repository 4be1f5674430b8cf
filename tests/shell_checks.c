/* What every shell element must do exactly: rigid motions, patch tests, numbering. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/eigen.h"
#include "base/vector.h"
#include "shell/element.h"
#include "shell/lamina.h"

/* --- elements by themselves: five degrees of freedom a node --- */

enum { FREE = 5, MOST = 49, DEGREES = FREE * MOST };

static const int ORDERS[] = {1, 2, 6};
enum { ORDER_COUNT = sizeof ORDERS / sizeof *ORDERS };

typedef struct piece {
    ves_arena arena;
    ves_shell_kind kind;
    ves_shell_scratch scratch;
    ves_shell_material material;
    double X[MOST][3], V[MOST][3];
    ves_shell_column column[DEGREES];
    int columns;
    double *K;
} piece;

static void piece_make(piece *p, int order, ves_shell_material material)
{
    const int orders[2] = {order, order};
    *p = (piece){.material = material};
    cr_assert(ves_shell_kind_make(orders, false, &p->arena, &p->kind) == VES_OK);
    p->columns = FREE * p->kind.nodes;
    cr_assert(ves_shell_scratch_make(&p->kind, 1, p->columns, &p->arena, &p->scratch) == VES_OK);
    p->K = ves_arena_doubles(&p->arena, DEGREES * DEGREES);
}

static ves_shell_body piece_body(const piece *p)
{
    return (ves_shell_body){&p->kind, (const double(*)[3])p->X, (const double(*)[3])p->V};
}

/* Turns about two axes across V: those of x and y that V is turned from z by, so those of neighbours agree
 * on a plane. */
static void piece_columns(piece *p)
{
    for (int k = 0; k < p->kind.nodes; k++) {
        double axis[2][3] = {{1, 0, 0}, {0, 1, 0}}, square = ves_dot(p->V[k], p->V[k]);
        for (int a = 0; a < 2; a++) {
            double along = ves_dot(axis[a], p->V[k]) / square;
            for (int c = 0; c < 3; c++) axis[a][c] -= along * p->V[k][c];
        }
        for (int i = 0; i < FREE; i++) {
            ves_shell_column *c = &p->column[FREE * k + i];
            *c = (ves_shell_column){.node = k, .turns = i > 2};
            if (i < 3) {
                c->vector[i] = 1;
                continue;
            }
            memcpy(c->axis, axis[i - 3], sizeof c->axis);
            ves_cross(c->axis, p->V[k], c->vector);
        }
    }
}

/* K in full */
static void piece_stiffness(piece *p)
{
    ves_shell_body body = piece_body(p);
    piece_columns(p);
    cr_assert(ves_shell_stiffness(&body, &p->material, p->columns, p->column, &p->scratch, p->K) == VES_OK);
    for (int j = 0; j < p->columns; j++)
        for (int i = 0; i < j; i++) p->K[j * p->columns + i] = p->K[i * p->columns + j];
}

typedef enum shape { FLAT, WARPED, CURVED, SHAPES } shape;

/* A quadrilateral whose sides are not parallel; bent: by a height over it, with slopes by its derivatives. */
static void shape_at(shape which, double r, double s, double X[3], double n[3])
{
    double xr = 1 + 0.15 * s, xs = 0.2 + 0.15 * r, yr = 0.1 - 0.1 * s, ys = 0.8 - 0.1 * r;
    double z = which == WARPED   ? 0.3 * r * s
               : which == CURVED ? 0.25 * r * r - 0.15 * s * s + 0.1 * r * s + 0.03 * r * s * s
                                 : 0,
           zr = which == WARPED   ? 0.3 * s
                : which == CURVED ? 0.5 * r + 0.1 * s + 0.03 * s * s
                                  : 0,
           zs = which == WARPED   ? 0.3 * r
                : which == CURVED ? -0.3 * s + 0.1 * r + 0.06 * r * s
                                  : 0;
    const double Xr[3] = {xr, yr, zr}, Xs[3] = {xs, ys, zs};
    X[0] = r + 0.2 * s + 0.15 * r * s, X[1] = 0.1 * r + 0.8 * s - 0.1 * r * s, X[2] = z;
    ves_cross(Xr, Xs, n);
    double length = sqrt(ves_dot(n, n));
    for (int c = 0; c < 3; c++) n[c] /= length;
}

/* Its local numbering begins at the corner `turn` quarters further; thickness varies. */
static void piece_shape(piece *p, shape which, int turn)
{
    double at[VES_SHELL_ORDER + 1];
    int across = p->kind.order[0] + 1;
    ves_rule_nodes(across - 1, at);
    for (int k = 0; k < p->kind.nodes; k++) {
        double r = at[k % across], s = at[k / across], n[3];
        for (int q = 0; q < turn; q++) {
            double former = r;
            r = -s, s = former;
        }
        shape_at(which, r, s, p->X[k], n);
        for (int c = 0; c < 3; c++) p->V[k][c] = 0.05 * (1 + 0.2 * r) * n[c];
    }
}

/* Motion m < 3: along an axis; else about one. */
static void rigid(const piece *p, int m, double *u)
{
    double way[3] = {0}, about[3] = {0};
    (m < 3 ? way : about)[m % 3] = 1;
    for (int k = 0; k < p->kind.nodes; k++) {
        double U[3], A[3];
        ves_cross(about, p->X[k], U);
        ves_cross(about, p->V[k], A);
        for (int c = 0; c < 3; c++) u[FREE * k + c] = U[c] + way[c];
        const double *a = p->column[FREE * k + 3].vector, *b = p->column[FREE * k + 4].vector;
        double aa = ves_dot(a, a), ab = ves_dot(a, b), bb = ves_dot(b, b), d = aa * bb - ab * ab,
               A0 = ves_dot(A, a), A1 = ves_dot(A, b);
        u[FREE * k + 3] = (A0 * bb - A1 * ab) / d, u[FREE * k + 4] = (A1 * aa - A0 * ab) / d;
    }
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Six motions without strain, to rounding; and no other: the seventh eigenvalue is that of a deformation. */
Test(checks, rigid)
{
    const ves_shell_material material = {1e7, 0.3, 5. / 6};
    for (int o = 0; o < ORDER_COUNT; o++)
        for (shape which = FLAT; which < SHAPES; which++) {
            piece p;
            double value[DEGREES], u[DEGREES];
            piece_make(&p, ORDERS[o], material);
            piece_shape(&p, which, 0);
            piece_stiffness(&p);
            int n = p.columns;
            for (int m = 0; m < 6; m++) {
                rigid(&p, m, u);
                for (int i = 0; i < n; i++) {
                    double force = 0, size = 0;
                    for (int j = 0; j < n; j++)
                        force += p.K[j * n + i] * u[j], size += fabs(p.K[j * n + i] * u[j]);
                    cr_assert(fabs(force) <= 1e-12 * size + 1e-6, "order %d shape %d motion %d: %g of %g",
                              ORDERS[o], which, m, force, size);
                }
            }
            double *vector = ves_arena_doubles(&p.arena, (size_t)(n * n));
            ves_eigen_symmetric(n, p.K, value, vector);
            qsort(value, (size_t)n, sizeof *value, by_size);
            cr_assert(fabs(value[0]) < 1e-9 * value[6] && fabs(value[5]) < 1e-9 * value[6],
                      "order %d shape %d: %g ... %g, then %g", ORDERS[o], which, value[0], value[5],
                      value[6]);
            /* twisted and bent: E t^3 of E t, less of many nodes */
            cr_assert(value[6] > 1e-6 * value[n - 1], "order %d shape %d: %g of %g", ORDERS[o], which,
                      value[6], value[n - 1]);
            ves_arena_destroy(&p.arena);
        }
}

/* What the columns do against a motion: forces on the strains of points, pulled back to the nodes. */
static void forces_by_points(piece *p, const double *u, double *force)
{
    const ves_shell_points *rule = &p->kind.rule;
    ves_shell_body body = piece_body(p);
    double U[MOST][3] = {{0}}, A[MOST][3] = {{0}}, on_U[MOST][3] = {{0}}, on_A[MOST][3] = {{0}},
           strain[MOST * VES_GENERAL];
    for (int i = 0; i < p->columns; i++) {
        const ves_shell_column *c = &p->column[i];
        for (int d = 0; d < 3; d++) (c->turns ? A : U)[c->node][d] += u[i] * c->vector[d];
    }
    ves_shell_strains(&body, rule, (const double(*)[3])U, (const double(*)[3])A, &p->scratch, strain);
    for (int q = 0; q < rule->points; q++) {
        ves_shell_frame frame;
        double e[VES_GENERAL];
        memcpy(e, strain + q * VES_GENERAL, sizeof e);
        ves_shell_frame_at(&body, &rule->table, q, &frame);
        cr_assert(ves_lamina_forces(&frame, &p->material, rule->weight[q], e, strain + q * VES_GENERAL));
    }
    ves_shell_pull(&body, rule, strain, &p->scratch, on_U, on_A);
    for (int i = 0; i < p->columns; i++) {
        const ves_shell_column *c = &p->column[i];
        force[i] = ves_dot(c->vector, (c->turns ? on_A : on_U)[c->node]);
    }
}

/* K u is what the strains of u say, point by point, to the rounding of the stiffest entry. */
Test(checks, points)
{
    for (int o = 0; o < ORDER_COUNT; o++) {
        piece p;
        double u[DEGREES], force[DEGREES], largest = 0;
        piece_make(&p, ORDERS[o], (ves_shell_material){2, 0.3, 5.0 / 6});
        piece_shape(&p, CURVED, 1);
        piece_stiffness(&p);
        for (int i = 0; i < p.columns; i++)
            u[i] = sin(1.7 * i), largest = fmax(largest, p.K[i * p.columns + i]);
        forces_by_points(&p, u, force);
        for (int i = 0; i < p.columns; i++) {
            double sum = 0;
            for (int j = 0; j < p.columns; j++) sum += p.K[i * p.columns + j] * u[j];
            cr_assert_float_eq(sum, force[i], 1e-12 * largest, "order %d, %d: %.17g %.17g", ORDERS[o], i, sum,
                               force[i]);
        }
        ves_arena_destroy(&p.arena);
    }
}

/* Where local numbering begins does not matter. */
Test(checks, numbering)
{
    const ves_shell_material material = {1e7, 0.3, 5. / 6};
    for (int o = 0; o < ORDER_COUNT; o++)
        for (shape which = FLAT; which < SHAPES; which++)
            for (int turn = 1; turn < 4; turn++) {
                piece p, t;
                int place[MOST];
                piece_make(&p, ORDERS[o], material);
                piece_make(&t, ORDERS[o], material);
                piece_shape(&p, which, 0);
                piece_shape(&t, which, turn);
                piece_stiffness(&p);
                piece_stiffness(&t);
                for (int k = 0; k < p.kind.nodes; k++) {
                    int found = -1;
                    for (int i = 0; i < p.kind.nodes; i++) {
                        double d[3];
                        for (int c = 0; c < 3; c++) d[c] = p.X[i][c] - t.X[k][c];
                        if (ves_dot(d, d) < 1e-20) found = i;
                    }
                    cr_assert(found >= 0);
                    place[k] = found;
                }
                int n = p.columns;
                double most = 0, worst = 0;
                for (int j = 0; j < n; j++)
                    for (int i = 0; i < n; i++) {
                        int a = FREE * place[i / FREE] + i % FREE, b = FREE * place[j / FREE] + j % FREE;
                        most = fmax(most, fabs(p.K[b * n + a]));
                        worst = fmax(worst, fabs(p.K[b * n + a] - t.K[j * n + i]));
                    }
                cr_assert(worst < 1e-12 * most, "order %d shape %d turn %d: %g of %g", ORDERS[o], which, turn,
                          worst, most);
                ves_arena_destroy(&p.arena);
                ves_arena_destroy(&t.arena);
            }
}

/* --- the patch of MacNeal and Harder (1985) --- */

enum { CELLS = 5, SPLIT = 3, PATCH = 1300 };
static const double T = 0.001, SLANT = 0.3;
static const ves_shell_material PATCHED = {1e6, 0.25, 5. / 6};

/* Exact: displacement, turns about x and y, stresses xx, yy, xy, xz, yz at a level z. */
typedef struct field {
    void (*moves)(double x, double y, double u[FREE]);
    void (*stressed)(double x, double y, double z, double s[VES_STRESSES]);
    bool turns_held; /* all of them */
} field;

typedef struct patch {
    piece p;
    int split; /* each cell into so many both ways */
    bool even; /* a grid of parallelograms instead */
    int node[CELLS * SPLIT * SPLIT][MOST], nodes;
    double at[PATCH / FREE][2];
    double *K, *u; /* [degrees]^2, [degrees] */
} patch;

static int patch_cells(const patch *a)
{
    return CELLS * a->split * a->split;
}

static void patch_cell(patch *a, int cell)
{
    static const double CORNER[8][2] = {{0, 0},       {0.24, 0},    {0.24, 0.12}, {0, 0.12},
                                        {0.04, 0.02}, {0.18, 0.03}, {0.16, 0.08}, {0.08, 0.08}};
    static const int OF[CELLS][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
    double at[VES_SHELL_ORDER + 1];
    int across = a->p.kind.order[0] + 1, which = cell % CELLS, part = cell / CELLS, n = a->split;
    ves_rule_nodes(across - 1, at);
    for (int k = 0; k < a->p.kind.nodes; k++) {
        double r = (at[k % across] + 1 + 2 * (part % n)) / n - 1,
               s = (at[k / across] + 1 + 2 * (part / n)) / n - 1;
        const double N[4] = {(1 - r) * (1 - s) / 4, (1 + r) * (1 - s) / 4, (1 + r) * (1 + s) / 4,
                             (1 - r) * (1 + s) / 4};
        double X[3] = {0};
        for (int i = 0; i < 4; i++)
            for (int c = 0; c < 2; c++) X[c] += N[i] * CORNER[OF[which][i]][c];
        if (a->even) X[0] = 0.024 * (2 * which + r + 1), X[1] = 0.06 * (s + 1), X[0] += SLANT * X[1];
        memcpy(a->p.X[k], X, sizeof X);
        a->p.V[k][0] = a->p.V[k][1] = 0, a->p.V[k][2] = T / 2;
        int found = 0;
        while (found < a->nodes && hypot(a->at[found][0] - X[0], a->at[found][1] - X[1]) > 1e-9) found++;
        if (found == a->nodes) a->at[found][0] = X[0], a->at[found][1] = X[1], a->nodes++;
        a->node[cell][k] = found;
    }
}

static void patch_make(patch *a, int order, int split, bool even)
{
    *a = (patch){.split = split, .even = even};
    piece_make(&a->p, order, PATCHED);
    for (int cell = 0; cell < patch_cells(a); cell++) patch_cell(a, cell);
    int n = FREE * a->nodes;
    cr_assert(n <= PATCH);
    a->K = ves_arena_take(&a->p.arena, (size_t)(n * n), sizeof *a->K);
    a->u = ves_arena_take(&a->p.arena, (size_t)n, sizeof *a->u);
    for (int cell = 0; cell < patch_cells(a); cell++) {
        patch_cell(a, cell);
        piece_stiffness(&a->p);
        for (int j = 0; j < a->p.columns; j++)
            for (int i = 0; i < a->p.columns; i++)
                a->K[(FREE * a->node[cell][j / FREE] + j % FREE) * n + FREE * a->node[cell][i / FREE] +
                     i % FREE] += a->p.K[j * a->p.columns + i];
    }
}

static bool on_rim(const patch *a, const double at[2])
{
    double x = at[0] - a->even * SLANT * at[1];
    return x < 1e-9 || x > 0.24 - 1e-9 || at[1] < 1e-9 || at[1] > 0.12 - 1e-9;
}

/* Cholesky; what is held has a row and a column of the identity. Once more with what is left over, so that
 * what is seen is the elements' rounding and not that of this. */
static void dense_solve(int n, const double *K, double *b, ves_arena *arena)
{
    double *L = ves_arena_doubles(arena, (size_t)(n * n)), *left = ves_arena_doubles(arena, (size_t)n);
    memcpy(L, K, sizeof *L * (size_t)(n * n));
    memcpy(left, b, sizeof *left * (size_t)n);
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < j; k++)
            for (int i = j; L[k * n + j] != 0 && i < n; i++) L[j * n + i] -= L[k * n + j] * L[k * n + i];
        double d = sqrt(L[j * n + j]);
        cr_assert(d > 0);
        for (int i = j; i < n; i++) L[j * n + i] /= d;
    }
    double *want = ves_arena_doubles(arena, (size_t)n);
    memcpy(want, b, sizeof *want * (size_t)n);
    memset(b, 0, sizeof *b * (size_t)n);
    for (int pass = 0; pass < 3; pass++) {
        for (int j = 0; j < n; j++) {
            left[j] /= L[j * n + j];
            for (int i = j + 1; i < n; i++) left[i] -= L[j * n + i] * left[j];
        }
        for (int j = n - 1; j >= 0; j--) {
            for (int i = j + 1; i < n; i++) left[j] -= L[j * n + i] * left[i];
            left[j] /= L[j * n + j];
        }
        for (int j = 0; j < n; j++) b[j] += left[j];
        for (int i = 0; i < n; i++) {
            long double sum = want[i];
            for (int j = 0; j < n; j++) sum -= (long double)K[i * n + j] * b[j];
            left[i] = (double)sum;
        }
    }
}

static void patch_solve(patch *a, const field *f)
{
    int n = FREE * a->nodes;
    double exact[FREE];
    for (int k = 0; k < a->nodes; k++) {
        f->moves(a->at[k][0], a->at[k][1], exact);
        for (int i = 0; i < FREE; i++) {
            int at = FREE * k + i;
            if (!on_rim(a, a->at[k]) && !(i > 2 && f->turns_held)) continue;
            for (int r = 0; r < n; r++) a->u[r] -= exact[i] * a->K[at * n + r];
            for (int r = 0; r < n; r++) a->K[at * n + r] = a->K[r * n + at] = 0;
            a->K[at * n + at] = 1;
        }
    }
    for (int k = 0; k < a->nodes; k++) {
        f->moves(a->at[k][0], a->at[k][1], exact);
        for (int i = 0; i < FREE; i++)
            if (on_rim(a, a->at[k]) || (i > 2 && f->turns_held)) a->u[FREE * k + i] = exact[i];
    }
    dense_solve(n, a->K, a->u, &a->p.arena);
}

/* What displacements and turns are off by, of the largest of their kind, or of what the other kind makes
 * over 0.1, the size of the patch. */
static double patch_moved(const patch *a, const field *f)
{
    double size[2] = {0}, worst[2] = {0}, exact[FREE];
    for (int k = 0; k < a->nodes; k++) {
        f->moves(a->at[k][0], a->at[k][1], exact);
        for (int i = 0; i < FREE; i++) {
            size[i > 2] = fmax(size[i > 2], fabs(exact[i]));
            worst[i > 2] = fmax(worst[i > 2], fabs(a->u[FREE * k + i] - exact[i]));
        }
    }
    size[0] = fmax(size[0], 0.1 * size[1]), size[1] = fmax(size[1], 10 * size[0]);
    return fmax(worst[0] / size[0], worst[1] / size[1]);
}

/* The same of stresses at all points that are reported, at both surfaces, in x and y. */
static double patch_stressed(patch *a, const field *f)
{
    double most = 0, worst = 0;
    for (int cell = 0; cell < patch_cells(a); cell++) {
        patch_cell(a, cell);
        piece_columns(&a->p);
        ves_shell_body body = piece_body(&a->p);
        const ves_shell_points *lattice = &a->p.kind.lattice;
        double U[MOST][3] = {{0}}, A[MOST][3] = {{0}};
        double *strain = ves_arena_doubles(&a->p.arena, (size_t)(lattice->points * VES_GENERAL));
        for (int i = 0; i < a->p.columns; i++) {
            const ves_shell_column *c = &a->p.column[i];
            for (int d = 0; d < 3; d++)
                (c->turns ? A : U)[c->node][d] +=
                    c->vector[d] * a->u[FREE * a->node[cell][c->node] + i % FREE];
        }
        ves_shell_strains(&body, lattice, (const double(*)[3])U, (const double(*)[3])A, &a->p.scratch,
                          strain);
        for (int q = 0; q < lattice->points; q++)
            for (int z = -1; z < 2; z += 2) {
                ves_shell_frame frame;
                double s[VES_STRESSES], exact[VES_STRESSES], x[3] = {0};
                ves_shell_frame_at(&body, &lattice->table, q, &frame);
                cr_assert(ves_shell_stress_at(&frame, &PATCHED, strain + q * VES_GENERAL, z, s));
                for (int k = 0; k < a->p.kind.nodes; k++)
                    for (int d = 0; d < 3; d++)
                        x[d] += lattice->table.N[q * a->p.kind.nodes + k] * body.X[k][d];
                double l = hypot(frame.Xr[0], frame.Xr[1]), co = frame.Xr[0] / l, si = frame.Xr[1] / l;
                const double got[VES_STRESSES] = {co * co * s[0] + si * si * s[1] - 2 * si * co * s[2],
                                                  si * si * s[0] + co * co * s[1] + 2 * si * co * s[2],
                                                  si * co * (s[0] - s[1]) + (co * co - si * si) * s[2],
                                                  co * s[3] - si * s[4], si * s[3] + co * s[4]};
                f->stressed(x[0], x[1], z, exact);
                for (int k = 0; k < VES_STRESSES; k++)
                    most = fmax(most, fabs(exact[k])), worst = fmax(worst, fabs(got[k] - exact[k]));
            }
    }
    return worst / most;
}

typedef struct wrong {
    double moved, stressed;
} wrong;

static wrong patch_wrong(int order, int split, bool even, const field *f)
{
    patch a;
    patch_make(&a, order, split, even);
    patch_solve(&a, f);
    wrong w = {patch_moved(&a, f), patch_stressed(&a, f)};
    ves_arena_destroy(&a.p.arena);
    return w;
}

static void patch_test(int order, bool even, const field *f, const char *what)
{
    wrong w = patch_wrong(order, 1, even, f);
    cr_assert(w.moved < 1e-9 && w.stressed < 1e-9, "%s, order %d, even %d: moves %g, stresses %g", what,
              order, even, w.moved, w.stressed);
}

static void stretch_moves(double x, double y, double u[FREE])
{
    u[0] = 1e-3 * (x + y / 2), u[1] = 1e-3 * (y + x / 2), u[2] = u[3] = u[4] = 0;
}

/* E / (1 - nu) 1e-3; G 1e-3 */
static void stretch_stressed(double x, double y, double z, double s[VES_STRESSES])
{
    (void)x, (void)y, (void)z;
    s[0] = s[1] = 4000. / 3, s[2] = 400, s[3] = s[4] = 0;
}

/* turns: of n = z by (w_y, -w_x) */
static void bend_moves(double x, double y, double u[FREE])
{
    u[0] = u[1] = 0, u[2] = 1e-3 * (x * x + x * y + y * y) / 2;
    u[3] = 1e-3 * (y + x / 2), u[4] = -1e-3 * (x + y / 2);
}

/* m = 1e-3 D (1 + nu) = 1.111e-7, m_xy = 1e-3 D (1 - nu) / 2 = 3.333e-8; 6 m / t^2 */
static void bend_stressed(double x, double y, double z, double s[VES_STRESSES])
{
    (void)x, (void)y;
    s[0] = s[1] = -z * 2. / 3, s[2] = -z * 0.2, s[3] = s[4] = 0;
}

static void shear_moves(double x, double y, double u[FREE])
{
    u[0] = u[1] = u[3] = u[4] = 0, u[2] = 1e-3 * (x + y / 2);
}

static void shear_stressed(double x, double y, double z, double s[VES_STRESSES])
{
    (void)x, (void)y, (void)z;
    s[0] = s[1] = s[2] = 0, s[3] = 5. / 6 * 400, s[4] = s[3] / 2;
}

/* Bent by a constant force Q across: psi = x^2 / 2 turns about y, D = E t^3 / 12 / (1 - nu^2), Q = D psi'',
 * w' = Q / (k G t) - psi. Order 6 has it exactly. */
static void force_moves(double x, double y, double u[FREE])
{
    (void)y;
    double gamma = 1e6 * T * T * T / 12 / (1 - 0.0625) / (5. / 6 * 4e5 * T);
    u[0] = u[1] = u[3] = 0, u[4] = x * x / 2, u[2] = gamma * x - x * x * x / 6;
}

static void force_stressed(double x, double y, double z, double s[VES_STRESSES])
{
    (void)y;
    s[0] = 1e6 / (1 - 0.0625) * z * T / 2 * x, s[1] = 0.25 * s[0], s[2] = s[4] = 0;
    s[3] = 1e6 * T * T / 12 / (1 - 0.0625);
}

static const field STRETCH = {stretch_moves, stretch_stressed, false},
                   BEND = {bend_moves, bend_stressed, false},
                   /* constant shear is no state of equilibrium unless turns are held */
    SHEAR = {shear_moves, shear_stressed, true}, FORCE = {force_moves, force_stressed, false};

Test(checks, patches)
{
    for (int o = 0; o < ORDER_COUNT; o++)
        for (int even = 0; even < 2; even++) {
            patch_test(ORDERS[o], even, &SHEAR, "shear");
            if (ORDERS[o] == 2 && !even) continue;
            patch_test(ORDERS[o], even, &STRETCH, "membrane");
            patch_test(ORDERS[o], even, &BEND, "bending");
        }
    patch_test(6, false, &FORCE, "force across");
}

/* MITC9 takes e_rs at 2 x 2 points. That is the same work in a constant state only where its weight, the
 * contravariant stress times the area, has no more than linear parts: in parallelograms. Where sides are not
 * parallel it errs, less with the squares of the elements, whose sides become parallel; bent much less than
 * stretched. (With e_rs not tied all is exact.) */
Test(checks, tapered)
{
    wrong one = patch_wrong(2, 1, false, &STRETCH), three = patch_wrong(2, SPLIT, false, &STRETCH);
    double order = log(one.moved / three.moved) / log(SPLIT),
           too = log(one.stressed / three.stressed) / log(SPLIT);
    cr_assert(one.moved < 0.01 && order > 1.8 && too > 1.8, "%g, orders %g %g", one.moved, order, too);
    one = patch_wrong(2, 1, false, &BEND), three = patch_wrong(2, SPLIT, false, &BEND);
    cr_assert(one.moved < 1e-3 && three.moved < 0.5 * one.moved, "%g, %g", one.moved, three.moved);
}
