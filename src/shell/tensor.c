#include "shell/tensor.h"

#include <string.h>

#include <cblas.h>

#include "base/vector.h"
#include "shell/lamina.h"

/* What a motion enters the strains at a point with: U_c and A_c (six components), each as it is, by its derivative along r,
 * or by that along s. */
enum { AS_IS, BY_R, BY_S, WAYS, SIX = 6, BLOCK = SIX * SIX };

/* Ways of the row and of the column, grouped by whether each is differentiated along s: of a group, what varies is done with
 * by the sums along r. */
typedef struct ways {
    int row, column;
} ways;
enum { PAIRS = WAYS * WAYS, GROUPS = 4 };
static const ways PAIR[PAIRS] = {{AS_IS, AS_IS}, {AS_IS, BY_R}, {BY_R, AS_IS}, {BY_R, BY_R}, {AS_IS, BY_S},
                                 {BY_R, BY_S},   {BY_S, AS_IS}, {BY_S, BY_R},  {BY_S, BY_S}};
static const int GROUP[GROUPS + 1] = {0, 4, 6, 8, 9};

static int nodes_along(const ves_shell_kind *kind, int d)
{
    return kind->order[d] + 1;
}

/* Two nodes along r, i >= j. */
static int twos(const ves_shell_kind *kind)
{
    int n = nodes_along(kind, 0);
    return n * (n + 1) / 2;
}

/* --- tables --- */

/* Functions of the nodes along a direction, and their slopes, at the points of the rule there. */
typedef struct functions {
    double of[2][VES_SHELL_ORDER + 1][VES_SHELL_ORDER + 1]; /* [slope][point][node] */
} functions;

static void functions_make(const ves_shell_kind *kind, int d, functions *l)
{
    double place[VES_SHELL_ORDER + 1];
    ves_rule_nodes(kind->order[d], place);
    for (int q = 0; q < kind->rule.along[d]; q++)
        ves_rule_lagrange(nodes_along(kind, d), place, kind->rule.at[d ? q * kind->rule.along[0] : q][d],
                          l->of[0][q], l->of[1][q]);
}

/* [group][two nodes along r][pair of the group, point along r] */
static void fill_r(const ves_shell_kind *kind, double *out)
{
    functions l;
    functions_make(kind, 0, &l);
    for (int g = 0; g < GROUPS; g++)
        for (int i = 0; i < nodes_along(kind, 0); i++)
            for (int j = 0; j <= i; j++)
                for (int k = GROUP[g]; k < GROUP[g + 1]; k++)
                    for (int q = 0; q < kind->rule.along[0]; q++)
                        *out++ = l.of[PAIR[k].row == BY_R][q][i] * l.of[PAIR[k].column == BY_R][q][j];
}

/* [node][node][group, point along s] */
static void fill_s(const ves_shell_kind *kind, double *out)
{
    functions l;
    functions_make(kind, 1, &l);
    for (int i = 0; i < nodes_along(kind, 1); i++)
        for (int j = 0; j < nodes_along(kind, 1); j++)
            for (int g = 0; g < GROUPS; g++)
                for (int q = 0; q < kind->rule.along[1]; q++) {
                    ways w = PAIR[GROUP[g]];
                    *out++ = l.of[w.row == BY_S][q][i] * l.of[w.column == BY_S][q][j];
                }
}

ves_status ves_shell_tensor_make(ves_shell_kind *kind, ves_arena *arena)
{
    const int *points = kind->rule.along;
    int n = nodes_along(kind, 1);
    kind->twice[0] = ves_arena_doubles(arena, (size_t)(twos(kind) * PAIRS * points[0]));
    kind->twice[1] = ves_arena_doubles(arena, (size_t)(n * n * GROUPS * points[1]));
    if (!kind->twice[0] || !kind->twice[1]) return VES_MEMORY;
    fill_r(kind, kind->twice[0]);
    fill_s(kind, kind->twice[1]);
    return VES_OK;
}

ves_shell_tensor_size ves_shell_tensor_needs(const ves_shell_kind *kind)
{
    int n = nodes_along(kind, 1);
    return (ves_shell_tensor_size){(size_t)(PAIRS * kind->rule.points * BLOCK),
                                   (size_t)(GROUPS * kind->rule.along[1] * twos(kind) * BLOCK),
                                   (size_t)(n * n * BLOCK)};
}

/* --- points --- */

/* The eight strains as sums over U_c and A_c in each way: [VES_GENERAL][WAYS][SIX]. */
static void strains(const ves_shell_frame *f, double S[VES_GENERAL][WAYS][SIX])
{
    static const double Z = VES_LEVEL;
    memset(S, 0, VES_GENERAL * sizeof *S);
    for (int c = 0; c < 3; c++) {
        int a = 3 + c;
        S[0][BY_R][c] = S[2][BY_S][c] = f->Xr[c], S[1][BY_S][c] = S[2][BY_R][c] = f->Xs[c];
        S[3][BY_R][c] = S[5][BY_S][c] = Z * f->Vr[c], S[4][BY_S][c] = S[5][BY_R][c] = Z * f->Vs[c];
        S[6][BY_R][c] = S[7][BY_S][c] = f->V[c];
        S[0][BY_R][a] = S[2][BY_S][a] = Z * Z * f->Vr[c], S[1][BY_S][a] = S[2][BY_R][a] = Z * Z * f->Vs[c];
        S[3][BY_R][a] = S[5][BY_S][a] = Z * f->Xr[c], S[4][BY_S][a] = S[5][BY_R][a] = Z * f->Xs[c];
        S[6][AS_IS][a] = f->Xr[c], S[7][AS_IS][a] = f->Xs[c];
    }
}

/* S' G S, symmetric: [WAYS][SIX][WAYS][SIX]. */
static void law_of_motion(const double G[VES_GENERAL][VES_GENERAL], const double S[VES_GENERAL][WAYS][SIX],
                          double D[WAYS * SIX][WAYS * SIX])
{
    double GS[VES_GENERAL][WAYS * SIX] = {{0}};
    const double(*s)[WAYS * SIX] = (const double(*)[WAYS * SIX]) S;
    for (int i = 0; i < VES_GENERAL; i++)
        for (int k = 0; k < VES_GENERAL; k++)
            for (int m = 0; m < WAYS * SIX; m++) GS[i][m] += G[i][k] * s[k][m];
    memset(D, 0, WAYS * SIX * sizeof *D);
    for (int l = 0; l < WAYS * SIX; l++)
        for (int i = 0; i < VES_GENERAL; i++)
            for (int m = 0; m < WAYS * SIX; m++) D[l][m] += s[i][l] * GS[i][m];
}

/* [group][point along s][pair of the group, point along r][column][row] */
static void point_write(const ves_shell_kind *kind, int q, double D[WAYS * SIX][WAYS * SIX], double *out)
{
    const int *points = kind->rule.along, r = q % points[0], s = q / points[0];
    for (int g = 0; g < GROUPS; g++) {
        int count = GROUP[g + 1] - GROUP[g];
        for (int k = 0; k < count; k++) {
            ways w = PAIR[GROUP[g] + k];
            double *to = out + ((GROUP[g] * points[1] + s * count + k) * points[0] + r) * BLOCK;
            for (int c = 0; c < SIX; c++)
                memcpy(to + SIX * c, D[SIX * w.column + c] + SIX * w.row, SIX * sizeof *to);
        }
    }
}

static bool points_fill(const ves_shell_body *body, const ves_shell_material *material,
                        const ves_shell_scratch *scratch)
{
    const ves_shell_points *rule = &body->kind->rule;
    const ves_shell_frame *frame = ves_shell_frames(body, &rule->table, scratch);
    for (int q = 0; q < rule->points; q++) {
        double G[VES_GENERAL][VES_GENERAL], S[VES_GENERAL][WAYS][SIX], D[WAYS * SIX][WAYS * SIX];
        if (!ves_lamina_law(&frame[q], material, rule->weight[q], G)) return false;
        strains(&frame[q], S);
        law_of_motion((const double(*)[VES_GENERAL])G, (const double(*)[WAYS][SIX])S, D);
        point_write(body->kind, q, D, scratch->row);
    }
    return true;
}

/* --- sums --- */

/* Along r: [group][point along s][two nodes along r][BLOCK]. */
static void sum_r(const ves_shell_kind *kind, const double *point, double *line)
{
    const int *points = kind->rule.along, n = twos(kind);
    const double *table = kind->twice[0];
    for (int g = 0; g < GROUPS; g++) {
        int inner = (GROUP[g + 1] - GROUP[g]) * points[0];
        for (int s = 0; s < points[1]; s++, point += inner * BLOCK, line += n * BLOCK)
            cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, n, BLOCK, inner, 1, table, inner, point,
                        BLOCK, 0, line, BLOCK);
        table += n * inner;
    }
}

/* Along s: [node][node][BLOCK] of two nodes along r. */
static void sum_s(const ves_shell_kind *kind, const double *line, int two, double *block)
{
    int n = nodes_along(kind, 1), inner = GROUPS * kind->rule.along[1];
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, n * n, BLOCK, inner, 1, kind->twice[1], inner,
                line + two * BLOCK, twos(kind) * BLOCK, 0, block, BLOCK);
}

/* --- blocks of two nodes into the matrix of the columns --- */

typedef struct target {
    int columns, *begin; /* [nodes + 1] the first column of a node */
    const ves_shell_column *column;
    double *K;
} target;

static void block_take(const target *t, int a, int b, const double *block)
{
    for (int j = t->begin[b]; j < t->begin[b + 1]; j++) {
        const double *v = t->column[j].vector, *from = block + (t->column[j].turns ? 3 * SIX : 0);
        double to[SIX];
        for (int c = 0; c < SIX; c++)
            to[c] = v[0] * from[c] + v[1] * from[SIX + c] + v[2] * from[2 * SIX + c];
        for (int i = a == b ? j : t->begin[a]; i < t->begin[a + 1]; i++)
            t->K[i < j ? i * t->columns + j : j * t->columns + i] =
                ves_dot(t->column[i].vector, to + (t->column[i].turns ? 3 : 0));
    }
}

static void begins(int nodes, const target *t)
{
    for (int k = 0, column = 0; k <= nodes; k++) {
        t->begin[k] = column;
        while (column < t->columns && t->column[column].node == k) column++;
    }
}

ves_status ves_shell_tensor_stiffness(const ves_shell_body *body, const ves_shell_material *material,
                                      int columns, const ves_shell_column *column,
                                      const ves_shell_scratch *scratch, double *K)
{
    const ves_shell_kind *kind = body->kind;
    const target to = {columns, scratch->begin, column, K};
    int m = nodes_along(kind, 0), n = nodes_along(kind, 1);
    if (!points_fill(body, material, scratch)) return VES_DEGENERATE;
    begins(kind->nodes, &to);
    sum_r(kind, scratch->row, scratch->line);
    for (int i = 0, two = 0; i < m; i++)
        for (int j = 0; j <= i; j++, two++) {
            sum_s(kind, scratch->line, two, scratch->block);
            for (int k = 0; k < n; k++)
                for (int l = 0; l < (i == j ? k + 1 : n); l++)
                    block_take(&to, k * m + i, l * m + j, scratch->block + (k * n + l) * BLOCK);
        }
    return VES_OK;
}
