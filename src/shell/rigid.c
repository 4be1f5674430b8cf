/* Is the shell held? A connected part that may move as a rigid body has a motion r with r' K r = 0; of the six motions that
 * it has, in the freedoms that its supports leave, the least of r' K r over r' diag(K) r is rounding then. A matter of the
 * supports, which are the same for all candidates: asked once. (Pivots do not tell: those of thin shells are small too.) */
#include "shell/inside.h"

#include <math.h>
#include <string.h>

#include "base/eigen.h"
#include "base/vector.h"

enum { MOTIONS = 6 };

static const double ROUNDING = 1e-15;

typedef struct motions {
    double *vector[MOTIONS], *product; /* [freedoms] */
    int *part;                         /* [nodes] */
    int parts;
} motions;

static ves_status motions_take(const ves_shell *shell, ves_arena *arena, motions *m)
{
    m->part = ves_arena_take(arena, (size_t)shell->model->nodes, sizeof *m->part);
    m->product = ves_arena_doubles(arena, (size_t)shell->layout[0].freedoms);
    if (!m->part || !m->product) return VES_MEMORY;
    for (int k = 0; k < MOTIONS; k++) {
        m->vector[k] = ves_arena_doubles(arena, (size_t)shell->layout[0].freedoms);
        if (!m->vector[k]) return VES_MEMORY;
    }
    return VES_OK;
}

/* Numbers connected parts: the least node of an element goes round until nothing changes. */
static void parts_find(const ves_shell *shell, int *part)
{
    bool changed = true;
    for (int k = 0; k < shell->model->nodes; k++) part[k] = k;
    while (changed) {
        changed = false;
        for (int i = 0; i < shell->elements; i++) {
            const shell_element *e = &shell->element[i];
            const int *weld = shell->model->weld[e->sheet];
            int least = part[weld[e->s[0]]];
            for (int k = 0; k < shell->kind[e->sheet].nodes; k++)
                if (part[weld[e->s[k]]] < least) least = part[weld[e->s[k]]];
            for (int k = 0; k < shell->kind[e->sheet].nodes; k++)
                if (part[weld[e->s[k]]] != least) part[weld[e->s[k]]] = least, changed = true;
        }
    }
}

static void node_at(const ves_shell *shell, int node, double X[3])
{
    for (int c = 0; c < 3; c++) X[c] = shell->input->X[shell->lead_sheet[node]][c][shell->lead[node]];
}

/* Motion k < 3: along axis k; else about axis k - 3 through the centre of the part. */
static void motion_fill(const ves_shell *shell, const int *part, int which, const double centre[3], int k,
                        double *out)
{
    double way[3] = {0}, about[3] = {0};
    memset(out, 0, sizeof *out * (size_t)shell->layout[0].freedoms);
    (k < 3 ? way : about)[k % 3] = 1;
    for (int node = 0; node < shell->model->nodes; node++) {
        const shell_freedom *f = &shell->layout[0].freedom[node];
        double X[3], U[3];
        if (part[node] != which) continue;
        node_at(shell, node, X);
        for (int c = 0; c < 3; c++) X[c] -= centre[c];
        ves_cross(about, X, U);
        for (int c = 0; c < 3; c++) U[c] += way[c];
        for (int i = 0; i < 3; i++) {
            if (f->moves[i] >= 0) out[f->first + f->moves[i]] = ves_dot(shell->model->node[node].frame[i], U);
            if (f->turns[i] >= 0)
                out[f->first + f->turns[i]] = ves_dot(shell->layout[0].pivot[node].axis[i], about);
        }
    }
}

/* K b, of the lower triangle; without what folds have against drilling, on which no rigid motion may lean. */
static void product(const ves_shell *shell, const double *b, double *out)
{
    const int *p = shell->layout[0].matrix->p, *row = shell->layout[0].matrix->i;
    const double *x = shell->layout[0].matrix->x;
    memset(out, 0, sizeof *out * (size_t)shell->layout[0].freedoms);
    for (int j = 0; j < shell->layout[0].freedoms; j++) {
        out[j] += x[p[j]] * b[j];
        for (int k = p[j] + 1; k < p[j + 1]; k++) out[j] += x[k] * b[row[k]], out[row[k]] += x[k] * b[j];
    }
    for (int node = 0; node < shell->model->nodes; node++) {
        const shell_freedom *f = &shell->layout[0].freedom[node];
        for (int i = 0; i < 3 && shell->model->node[node].fold; i++)
            if (f->turns[i] >= 0)
                out[f->first + f->turns[i]] -= ves_shell_drilling(shell, node) * b[f->first + f->turns[i]];
    }
}

/* K and D = diag(K) in terms of the motions. */
static void project(const ves_shell *shell, const motions *m, double *K, double *D)
{
    const int *p = shell->layout[0].matrix->p;
    const double *x = shell->layout[0].matrix->x;
    for (int j = 0; j < MOTIONS; j++) {
        product(shell, m->vector[j], m->product);
        for (int i = 0; i < MOTIONS; i++) {
            double k = 0, d = 0;
            for (int f = 0; f < shell->layout[0].freedoms; f++) {
                k += m->vector[i][f] * m->product[f];
                d += m->vector[i][f] * x[p[f]] * m->vector[j][f];
            }
            K[i * MOTIONS + j] = k, D[i * MOTIONS + j] = d;
        }
    }
}

/* The least of x' K x / x' D x over combinations of the motions. */
static double least(const ves_shell *shell, const motions *m)
{
    double K[MOTIONS * MOTIONS], D[MOTIONS * MOTIONS], value[MOTIONS], V[MOTIONS * MOTIONS],
        R[MOTIONS * MOTIONS] = {0};
    project(shell, m, K, D);
    ves_eigen_symmetric(MOTIONS, D, value, V);
    double most = 0, found = HUGE_VAL;
    for (int k = 0; k < MOTIONS; k++) most = fmax(most, value[k]);
    int count = 0;
    double basis[MOTIONS][MOTIONS];
    for (int k = 0; k < MOTIONS; k++) {
        if (value[k] < 1e-12 * most) continue; /* a motion of nothing that is free */
        for (int i = 0; i < MOTIONS; i++) basis[count][i] = V[i * MOTIONS + k] / sqrt(value[k]);
        count++;
    }
    for (int a = 0; a < count; a++)
        for (int b = 0; b < count; b++)
            for (int i = 0; i < MOTIONS; i++)
                for (int j = 0; j < MOTIONS; j++)
                    R[a * count + b] += basis[a][i] * K[i * MOTIONS + j] * basis[b][j];
    ves_eigen_symmetric(count, R, value, V);
    for (int k = 0; k < count; k++) found = fmin(found, value[k]);
    return found;
}

ves_status ves_shell_held(ves_shell *shell)
{
    ves_arena arena = {0};
    motions m;
    ves_status status = motions_take(shell, &arena, &m);
    if (status == VES_OK) parts_find(shell, m.part);
    for (int which = 0; status == VES_OK && which < shell->model->nodes; which++) {
        double centre[3] = {0};
        int count = 0;
        for (int node = 0; node < shell->model->nodes && m.part[which] == which; node++) {
            double X[3];
            if (m.part[node] != which) continue;
            node_at(shell, node, X);
            for (int c = 0; c < 3; c++) centre[c] += X[c];
            count++;
        }
        if (!count) continue;
        for (int c = 0; c < 3; c++) centre[c] /= count;
        for (int k = 0; k < MOTIONS; k++) motion_fill(shell, m.part, which, centre, k, m.vector[k]);
        if (!(least(shell, &m) > ROUNDING)) status = VES_LOOSE;
    }
    ves_arena_destroy(&arena);
    return status;
}
