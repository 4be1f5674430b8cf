/* Is the shell held? What its elements can do without strain is known: each *body*, sheets that have two or more
 * welded nodes in common, moves as a rigid one, U = a + b x (X - c), and bodies that meet in one node there move and
 * turn alike but about their normals. Of these few numbers the supports, the joints and the sector's tie ask that
 * sums of them be zero; on what is left springs work. Nothing here reads the stiffness matrix, whose rounding hides
 * what it does not hold. */
#include "shell/inside.h"

#include <math.h>
#include <string.h>

#include "base/eigen.h"
#include "base/vector.h"

enum { MOTIONS = 6 };

/* Squares of sines: what is held with a lever of a millionth of the size is held. Energies of springs over those of the
 * elements' diagonals: what is less is lost in the rounding of these. And of normals that are parallel. */
static const double LEVER = 1e-12, SOFT = 1e-13, PARALLEL = 1e-8;

struct shell_rigid {
    int bodies, *body;     /* [sheets] */
    double *apart;         /* [nodes] squared sine between normals welded there, most */
    double *firm;          /* [nodes] N/m: diagonals of the elements, without springs */
    double *G, *S, *D;     /* [2 n][2 n], n = MOTIONS * bodies: of what is zero, of springs, of elements */
    double *Z, *basis, *W; /* [2 n][2 n] */
    double *value, *row;   /* [2 n] */
    int n;                 /* of the question at hand: with a phase motions are complex */
    bool phased;
    double centre[3], size;
    ves_shell_motion found;
};

/* --- bodies --- */

static int count_of(const ves_shell *shell, int sheet)
{
    return ves_shell_rows(&shell->model->sheet[sheet]) * ves_shell_columns(&shell->model->sheet[sheet]);
}

/* first, second [nodes]: welded nodes that were seen in sheet a: 1, in both: 2 */
static int shared(const ves_shell *shell, int a, int b, int *seen)
{
    int both = 0;
    memset(seen, 0, sizeof *seen * (size_t)shell->model->nodes);
    for (int s = 0; s < count_of(shell, a); s++) seen[shell->model->weld[a][s]] = 1;
    for (int s = 0; s < count_of(shell, b); s++) {
        int *at = &seen[shell->model->weld[b][s]];
        both += *at == 1;
        if (*at == 1) *at = 2;
    }
    return both;
}

static void bodies_find(const ves_shell *shell, shell_rigid *r, int *seen)
{
    int sheets = shell->model->sheets;
    for (int k = 0; k < sheets; k++) r->body[k] = k;
    for (int a = 0; a < sheets; a++)
        for (int b = a + 1; b < sheets; b++) {
            if (r->body[a] == r->body[b] || shared(shell, a, b, seen) < 2) continue;
            int from = r->body[b], to = r->body[a];
            for (int k = 0; k < sheets; k++)
                if (r->body[k] == from) r->body[k] = to;
        }
    for (int k = 0; k < sheets; k++) { /* the least sheet's number to the next one that is free */
        if (r->body[k] < r->bodies) continue;
        int from = r->body[k];
        for (int i = k; i < sheets; i++)
            if (r->body[i] == from) r->body[i] = r->bodies;
        r->bodies++;
    }
}

ves_status ves_shell_rigid_make(ves_shell *shell, ves_arena *arena)
{
    size_t sheets = (size_t)shell->model->sheets, nodes = (size_t)shell->model->nodes;
    shell_rigid *r = ves_arena_take(arena, 1, sizeof *r);
    int *seen = ves_arena_take(arena, nodes, sizeof *seen);
    if (!r || !seen) return VES_MEMORY;
    r->body = ves_arena_take(arena, sheets, sizeof *r->body);
    r->apart = ves_arena_doubles(arena, nodes), r->firm = ves_arena_doubles(arena, nodes);
    if (!r->body || !r->apart || !r->firm) return VES_MEMORY;
    bodies_find(shell, r, seen);
    size_t n = 2 * MOTIONS * (size_t)r->bodies;
    r->G = ves_arena_doubles(arena, n * n), r->S = ves_arena_doubles(arena, n * n);
    r->D = ves_arena_doubles(arena, n * n), r->Z = ves_arena_doubles(arena, n * n);
    r->basis = ves_arena_doubles(arena, n * n), r->W = ves_arena_doubles(arena, n * n);
    r->value = ves_arena_doubles(arena, n), r->row = ves_arena_doubles(arena, n);
    shell->rigid = r;
    return r->G && r->S && r->D && r->Z && r->basis && r->W && r->value && r->row ? VES_OK : VES_MEMORY;
}

void ves_shell_firm_clear(ves_shell *shell)
{
    memset(shell->rigid->firm, 0, sizeof(double) * (size_t)shell->model->nodes);
}

void ves_shell_firm_add(ves_shell *shell, const shell_element *e, int columns)
{
    for (int k = 0; k < columns; k++)
        if (!shell->column[k].turns)
            shell->rigid->firm[shell->model->weld[e->sheet][e->s[shell->column[k].node]]] +=
                shell->K[k * columns + k];
}

/* --- rows: way . U(X) and way . b of a body --- */

static void place(const ves_shell *shell, int sheet, int s, double X[3])
{
    for (int c = 0; c < 3; c++) X[c] = shell->input->X[sheet][c][s];
}

static void normal(const ves_shell *shell, int sheet, int s, double n[3])
{
    for (int c = 0; c < 3; c++) n[c] = shell->input->normal[sheet][c][s];
}

/* factor times way . U(X), lengths over the size, to the row from `at` on. */
static void move_put(const shell_rigid *r, int body, const double X[3], const double way[3], double factor,
                     double *at)
{
    double arm[3], about[3];
    for (int c = 0; c < 3; c++) arm[c] = (X[c] - r->centre[c]) / r->size;
    ves_cross(arm, way, about); /* way . (b x arm) = b . (arm x way) */
    for (int c = 0; c < 3; c++) {
        at[MOTIONS * body + c] += factor * way[c];
        at[MOTIONS * body + 3 + c] += factor * about[c];
    }
}

static void turn_put(int body, const double way[3], double factor, double *at)
{
    for (int c = 0; c < 3; c++) at[MOTIONS * body + 3 + c] += factor * way[c];
}

static void square_add(const shell_rigid *r, const double *row, double weight, double *to)
{
    for (int i = 0; i < r->n; i++)
        for (int j = 0; j < r->n; j++) to[i * r->n + j] += weight * row[i] * row[j];
}

/* The row, of real motions, then cleared; with a phase of both parts. */
static void real_add(shell_rigid *r, double weight, double *to)
{
    int half = r->n / 2;
    square_add(r, r->row, weight, to);
    if (r->phased) {
        memcpy(r->row + half, r->row, sizeof *r->row * (size_t)half);
        memset(r->row, 0, sizeof *r->row * (size_t)half);
        square_add(r, r->row, weight, to);
    }
    memset(r->row, 0, sizeof *r->row * (size_t)r->n);
}

/* A complex row, [real parts] [imaginary parts], then cleared: M x = 0 of x = [Re] [Im]. */
static void complex_add(shell_rigid *r, double weight, double *to)
{
    int half = r->n / 2;
    square_add(r, r->row, weight, to);
    for (int k = 0; k < half; k++) { /* times -i, which is zero too */
        double re = r->row[k];
        r->row[k] = -r->row[half + k], r->row[half + k] = re;
    }
    square_add(r, r->row, weight, to);
    memset(r->row, 0, sizeof *r->row * (size_t)r->n);
}

/* --- what is zero --- */

static void turned_back(const double R[3][3], const double a[3], double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = R[0][c] * a[0] + R[1][c] * a[1] + R[2][c] * a[2];
}

/* Are all normals that are welded at a node parallel there? */
static void apart_find(const ves_shell *shell)
{
    const ves_shell_model *m = shell->model;
    double *apart = shell->rigid->apart;
    memset(apart, 0, sizeof *apart * (size_t)m->nodes);
    for (int sheet = 0; sheet < m->sheets; sheet++)
        for (int s = 0; s < count_of(shell, sheet); s++) {
            int node = m->weld[sheet][s];
            double n[3], own[3], lead[3], across[3];
            if (!m->node[node].fold) continue;
            normal(shell, sheet, s, n);
            memcpy(own, n, sizeof own);
            if (ves_shell_is_far(shell, sheet, s)) turned_back(m->turn, n, own);
            normal(shell, shell->lead_sheet[node], shell->lead[node], lead);
            ves_cross(own, lead, across);
            apart[node] = fmax(apart[node], ves_dot(across, across));
        }
}

/* A node that is held about axes a_k. It may turn about the normals there beside its body: where they are parallel only
 * what is left without that holds. */
static void turns_hold(const ves_shell *shell, const shell_layout *layout, int node)
{
    shell_rigid *r = shell->rigid;
    const shell_freedom *f = &layout->freedom[node];
    const double(*axis)[3] = (const double(*)[3])layout->pivot[node].axis;
    bool fold = shell->model->node[node].fold, free_about = fold && r->apart[node] < PARALLEL;
    double n[3], along[3] = {0}, sum[3] = {0}, square = 0;
    normal(shell, shell->lead_sheet[node], shell->lead[node], n);
    for (int k = 0; free_about && k < 3; k++) {
        if (f->turns[k] >= 0) continue;
        along[k] = ves_dot(axis[k], n), square += along[k] * along[k];
        for (int c = 0; c < 3; c++) sum[c] += along[k] * axis[k][c];
    }
    for (int k = 0; k < (fold ? 3 : 2); k++) {
        if (f->turns[k] >= 0) continue;
        turn_put(r->body[shell->lead_sheet[node]], axis[k], 1, r->row);
        if (square > LEVER) turn_put(r->body[shell->lead_sheet[node]], sum, -along[k] / square, r->row);
        real_add(r, 1, r->G);
    }
}

static void supports_add(const ves_shell *shell, const shell_layout *layout)
{
    shell_rigid *r = shell->rigid;
    for (int node = 0; node < shell->model->nodes; node++) {
        const shell_freedom *f = &layout->freedom[node];
        int body = r->body[shell->lead_sheet[node]];
        double X[3];
        place(shell, shell->lead_sheet[node], shell->lead[node], X);
        for (int k = 0; k < 3; k++) {
            if (f->moves[k] >= 0) continue;
            move_put(r, body, X, shell->model->node[node].frame[k], 1, r->row);
            real_add(r, 1, r->G);
        }
        turns_hold(shell, layout, node);
    }
}

/* Two bodies at a node: they move alike, and turn alike but each about its own normal. */
static void joint_add(const ves_shell *shell, int node, int sheet, int s)
{
    shell_rigid *r = shell->rigid;
    int one = r->body[shell->lead_sheet[node]], other = r->body[sheet];
    double X[3], n[2][3], across[3];
    place(shell, sheet, s, X);
    normal(shell, sheet, s, n[0]);
    normal(shell, shell->lead_sheet[node], shell->lead[node], n[1]);
    ves_cross(n[0], n[1], across);
    bool parallel = ves_dot(across, across) < PARALLEL;
    for (int c = 0; c < 3; c++) {
        double e[3] = {c == 0, c == 1, c == 2}, tangent[3];
        move_put(r, one, X, e, 1, r->row);
        move_put(r, other, X, e, -1, r->row);
        real_add(r, 1, r->G);
        if (!parallel && c) continue;
        ves_cross(n[0], e, tangent);
        turn_put(one, parallel ? tangent : across, 1, r->row);
        turn_put(other, parallel ? tangent : across, -1, r->row);
        real_add(r, 1, r->G);
    }
}

/* The far side moves and turns as the near one, turned, times exp(i phase); over the sector's angle, which may be small. */
static void tie_add(const ves_shell *shell, int node, int sheet, int s, double phase)
{
    shell_rigid *r = shell->rigid;
    const double(*R)[3] = shell->model->turn;
    int near = r->body[shell->lead_sheet[node]], far = r->body[sheet], half = r->n / 2;
    double X[3], Y[3], small = 0;
    place(shell, sheet, s, X);
    place(shell, shell->lead_sheet[node], shell->lead[node], Y);
    for (int i = 0; i < 9; i++) small += pow(R[i / 3][i % 3] - (i % 4 == 0), 2);
    for (int c = 0; c < 3; c++)
        for (int turns = 0; turns < 2; turns++) {
            double e[3] = {c == 0, c == 1, c == 2}, way[3];
            turned_back(R, e, way);
            for (int part = 0; part < 1 + r->phased; part++) {
                double factor = part ? sin(phase) : cos(phase), *at = r->row + part * half;
                if (turns)
                    turn_put(near, way, factor, at);
                else
                    move_put(r, near, Y, way, factor, at);
            }
            if (turns)
                turn_put(far, e, -1, r->row);
            else
                move_put(r, far, X, e, -1, r->row);
            (r->phased ? complex_add : real_add)(r, 1 / small, r->G);
        }
}

static void joints_add(const ves_shell *shell, double phase)
{
    const ves_shell_model *m = shell->model;
    for (int sheet = 0; sheet < m->sheets; sheet++)
        for (int s = 0; s < count_of(shell, sheet); s++) {
            int node = m->weld[sheet][s];
            if (ves_shell_is_far(shell, sheet, s))
                tie_add(shell, node, sheet, s, phase);
            else if (shell->rigid->body[sheet] != shell->rigid->body[shell->lead_sheet[node]])
                joint_add(shell, node, sheet, s);
        }
}

/* --- springs, and what elements have; a spring that is stiffer than its wall counts as that --- */

static void line_springs(ves_shell *shell, const shell_element *e)
{
    const ves_shell_model *m = shell->model;
    shell_rigid *r = shell->rigid;
    shell_line l;
    for (int k = 0; k < m->springs; k++) {
        const ves_shell_spring *spring = &m->spring[k];
        if (spring->sheet != e->sheet || !ves_shell_on_edge(shell, e, spring->edge)) continue;
        ves_shell_body body = ves_shell_gather(shell, e);
        ves_shell_line_at(&body, spring->edge, &l);
        for (int q = 0; q < l.count; q++) {
            double X[3] = {0}, most = r->firm[m->weld[e->sheet][e->s[l.node[q]]]];
            for (int i = 0; i < l.count; i++)
                for (int c = 0; c < 3; c++) X[c] += l.N[q][i] * shell->X[l.node[i]][c];
            for (int c = 0; c < 3; c++) {
                double way[3] = {c == 0, c == 1, c == 2};
                move_put(r, r->body[e->sheet], X, way, 1, r->row);
                real_add(r, fmin(l.weight[q] * l.length[q] * spring->stiffness[c], most), r->S);
            }
        }
    }
}

static void firmness_add(ves_shell *shell)
{
    shell_rigid *r = shell->rigid;
    for (int node = 0; node < shell->model->nodes; node++) {
        double X[3];
        place(shell, shell->lead_sheet[node], shell->lead[node], X);
        for (int c = 0; c < 3; c++) {
            double way[3] = {c == 0, c == 1, c == 2}, spring = shell->model->node[node].spring[c];
            for (int springs = spring > 0 ? 1 : 0; springs >= 0; springs--) {
                move_put(r, r->body[shell->lead_sheet[node]], X, way, 1, r->row);
                real_add(r, springs ? fmin(spring, r->firm[node]) : r->firm[node] / 3, springs ? r->S : r->D);
            }
        }
    }
    for (int i = 0; i < shell->elements; i++) line_springs(shell, &shell->element[i]);
}

/* --- what is left --- */

/* w' A v */
static double form(const double *A, const double *w, const double *v, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) sum += w[i] * A[i * n + j] * v[j];
    return sum;
}

/* Z [count][n]: all that the rows leave. */
static int null_take(shell_rigid *r)
{
    int n = r->n, count = 0;
    double most = 0;
    ves_eigen_symmetric(n, r->G, r->value, r->W);
    for (int k = 0; k < n; k++) most = fmax(most, r->value[k]);
    for (int k = 0; k < n; k++) {
        if (r->value[k] > LEVER * most) continue;
        for (int i = 0; i < n; i++) r->Z[count * n + i] = r->W[i * n + k];
        count++;
    }
    return count;
}

/* basis [count][n]: of those what springs hold too little. */
static int soft_take(shell_rigid *r, int count)
{
    int n = r->n, left = 0;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) r->G[i * count + j] = form(r->S, r->Z + i * n, r->Z + j * n, n);
    ves_eigen_symmetric(count, r->G, r->value, r->W);
    for (int k = 0; k < count; k++) {
        double *v = r->basis + left * n;
        memset(v, 0, sizeof *v * (size_t)n);
        for (int j = 0; j < count; j++)
            for (int i = 0; i < n; i++) v[i] += r->W[j * count + k] * r->Z[j * n + i];
        left += r->value[k] < SOFT * form(r->D, v, v, n);
    }
    return left;
}

/* --- telling: one of the motions that are left, the plainest --- */

static bool is_turn(int i)
{
    return i % MOTIONS > 2;
}

/* Z [count][n]: the combinations of the basis in which nothing turns; none: the basis. */
static int translations_take(shell_rigid *r, int count)
{
    int n = r->n, found = 0;
    memset(r->G, 0, sizeof *r->G * (size_t)(count * count));
    for (int a = 0; a < count; a++)
        for (int b = 0; b < count; b++)
            for (int i = 0; i < n; i++)
                if (is_turn(i)) r->G[a * count + b] += r->basis[a * n + i] * r->basis[b * n + i];
    ves_eigen_symmetric(count, r->G, r->value, r->W);
    for (int k = 0; k < count; k++) {
        if (r->value[k] > LEVER) continue;
        double *v = r->Z + found++ * n;
        memset(v, 0, sizeof *v * (size_t)n);
        for (int j = 0; j < count; j++)
            for (int i = 0; i < n; i++) v[i] += r->W[j * count + k] * r->basis[j * n + i];
    }
    if (!found) memcpy(r->Z, r->basis, sizeof *r->Z * (size_t)(count * n));
    return found;
}

/* The axis that lies nearest in them, as they have it. */
static void motion_tell(const ves_shell *shell, int count)
{
    shell_rigid *r = shell->rigid;
    int n = r->n, translations = translations_take(r, count), most = 0;
    double share = -1, *v = r->row;
    if (translations) count = translations;
    for (int i = 0; i < n; i++) {
        double own = 0;
        if (is_turn(i) != (translations == 0)) continue;
        for (int k = 0; k < count; k++) own += r->Z[k * n + i] * r->Z[k * n + i];
        if (own > share * (1 + 1e-9)) share = own, most = i;
    }
    for (int i = 0; i < n; i++) {
        v[i] = 0;
        for (int k = 0; k < count; k++) v[i] += r->Z[k * n + most] * r->Z[k * n + i];
    }
    const double *a = v + most / MOTIONS * MOTIONS, *b = a + 3, *way = translations ? a : b;
    double length = sqrt(ves_dot(way, way)), to[3];
    int body = most / MOTIONS % r->bodies;
    r->found = (ves_shell_motion){.turns = translations == 0,
                                  .whole = r->bodies == 1,
                                  .firmness = form(r->S, v, v, n) / form(r->D, v, v, n),
                                  .least = SOFT};
    while (r->body[r->found.sheet] != body) r->found.sheet++;
    ves_cross(b, a, to);
    for (int c = 0; c < 3; c++) {
        r->found.way[c] = fabs(way[c]) > 1e-9 * length ? way[c] / length : 0;
        if (!translations) r->found.at[c] = r->centre[c] + r->size * to[c] / (length * length);
    }
    memset(r->row, 0, sizeof *r->row * (size_t)n);
}

static void box(const ves_shell *shell)
{
    shell_rigid *r = shell->rigid;
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int node = 0; node < shell->model->nodes; node++) {
        double X[3];
        place(shell, shell->lead_sheet[node], shell->lead[node], X);
        for (int c = 0; c < 3; c++) low[c] = fmin(low[c], X[c]), high[c] = fmax(high[c], X[c]);
    }
    r->size = 0;
    for (int c = 0; c < 3; c++)
        r->centre[c] = (low[c] + high[c]) / 2, r->size = fmax(r->size, (high[c] - low[c]) / 2);
}

ves_status ves_shell_held(ves_shell *shell, const shell_layout *layout, double phase)
{
    shell_rigid *r = shell->rigid;
    r->phased = phase != 0; /* NOLINT: 0 is what says that there is none */
    r->n = MOTIONS * r->bodies * (1 + r->phased);
    r->found = (ves_shell_motion){.least = 0};
    size_t square = (size_t)r->n * (size_t)r->n;
    memset(r->row, 0, sizeof *r->row * (size_t)r->n);
    memset(r->G, 0, sizeof *r->G * square);
    memset(r->S, 0, sizeof *r->S * square);
    memset(r->D, 0, sizeof *r->D * square);
    box(shell);
    apart_find(shell);
    supports_add(shell, layout);
    joints_add(shell, phase);
    int left = null_take(r);
    if (left) {
        firmness_add(shell);
        left = soft_take(r, left);
    }
    if (left) motion_tell(shell, left);
    return left ? VES_LOOSE : VES_OK;
}

const ves_shell_motion *ves_shell_loose(const ves_shell *shell)
{
    return shell->rigid->found.least > 0 ? &shell->rigid->found : NULL;
}
