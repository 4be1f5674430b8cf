#include "shell/tensor.h"

#include <math.h>
#include <string.h>

enum { LINE = VES_SHELL_ORDER + 2 };

/* Points of a tensor product, r fastest. */
static ves_status product(const double *r, int nr, const double *s, int ns, ves_arena *arena,
                          double (**at)[2])
{
    *at = ves_arena_take(arena, (size_t)(nr * ns), sizeof **at);
    if (!*at) return VES_MEMORY;
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < nr; i++) (*at)[j * nr + i][0] = r[i], (*at)[j * nr + i][1] = s[j];
    return VES_OK;
}

static ves_status table_make(const ves_shell_kind *kind, const double (*at)[2], int points, ves_arena *arena,
                             ves_shell_table *table)
{
    const int *p = kind->order;
    double node[2][LINE], value[2][LINE], slope[2][LINE];
    *table = (ves_shell_table){points, ves_arena_doubles(arena, (size_t)(points * kind->nodes)),
                               ves_arena_doubles(arena, (size_t)(points * kind->nodes)),
                               ves_arena_doubles(arena, (size_t)(points * kind->nodes))};
    if (!table->N || !table->Nr || !table->Ns) return VES_MEMORY;
    for (int d = 0; d < 2; d++) ves_rule_nodes(p[d], node[d]);
    for (int q = 0; q < points; q++) {
        for (int d = 0; d < 2; d++) ves_rule_lagrange(p[d] + 1, node[d], at[q][d], value[d], slope[d]);
        for (int k = 0; k < kind->nodes; k++) {
            int i = k % (p[0] + 1), j = k / (p[0] + 1);
            table->N[q * kind->nodes + k] = value[0][i] * value[1][j];
            table->Nr[q * kind->nodes + k] = slope[0][i] * value[1][j];
            table->Ns[q * kind->nodes + k] = value[0][i] * slope[1][j];
        }
    }
    return VES_OK;
}

/* --- where strains are tied --- */

typedef struct line {
    int count;
    double at[3];
} line;

static const double OUTER = 0.77459666924148337704; /* sqrt(3/5) */
static const double INNER = 0.57735026918962576451; /* sqrt(1/3) */

/* Along r (0) or s (1): the tying points of a strain. False: it is not tied. */
static bool tying(int order, ves_strain strain, line at[2])
{
    const line three = {3, {-OUTER, 0, OUTER}}, two = {2, {-INNER, INNER}}, ends = {2, {-1, 1}},
               middle = {1, {0}};
    bool along_r = strain == VES_RR || strain == VES_RT;
    if (order > 2 || (order == 1 && strain != VES_RT && strain != VES_ST)) return false;
    if (order == 1)
        at[!along_r] = middle, at[along_r] = ends;
    else if (strain == VES_RS)
        at[0] = at[1] = two;
    else
        at[!along_r] = two, at[along_r] = three;
    return true;
}

/* The membrane strains that MITC4+ interpolates: rr at (0, 1) and (0, -1), ss at (1, 0) and (-1, 0), rs at the centre
 * (points A to E of the paper). */
static const double PLUS[VES_STRAINS][2][2] = {
    [VES_RR] = {{0, 1}, {0, -1}}, [VES_SS] = {{1, 0}, {-1, 0}}, [VES_RS] = {{0, 0}}};

static ves_status tied_make(ves_shell_kind *kind, ves_strain strain, ves_arena *arena)
{
    line at[2];
    double(*point)[2];
    if (kind->plus && strain <= VES_RS)
        return table_make(kind, PLUS[strain], strain == VES_RS ? 1 : 2, arena, &kind->tied[strain]);
    if (kind->order[0] != kind->order[1] || !tying(kind->order[0], strain, at)) return VES_OK;
    VES_TRY(product(at[0].at, at[0].count, at[1].at, at[1].count, arena, &point));
    return table_make(kind, point, at[0].count * at[1].count, arena, &kind->tied[strain]);
}

static ves_status mix_make(const ves_shell_kind *kind, ves_strain strain, ves_arena *arena,
                           ves_shell_points *out)
{
    line at[2];
    double value[2][LINE], slope[LINE];
    if (!kind->tied[strain].points || !tying(kind->order[0], strain, at)) return VES_OK;
    int tied = at[0].count * at[1].count;
    double *mix = ves_arena_doubles(arena, (size_t)(out->points * tied));
    if (!mix) return VES_MEMORY;
    for (int q = 0; q < out->points; q++) {
        for (int d = 0; d < 2; d++) ves_rule_lagrange(at[d].count, at[d].at, out->at[q][d], value[d], slope);
        for (int k = 0; k < tied; k++)
            mix[q * tied + k] = value[0][k % at[0].count] * value[1][k / at[0].count];
    }
    out->mix[strain] = mix;
    return VES_OK;
}

static ves_status points_make(const ves_shell_kind *kind, ves_arena *arena, ves_shell_points *out)
{
    VES_TRY(table_make(kind, out->at, out->points, arena, &out->table));
    for (int strain = 0; strain < VES_STRAINS; strain++)
        VES_TRY(mix_make(kind, (ves_strain)strain, arena, out));
    return VES_OK;
}

static ves_status rule_make(ves_shell_kind *kind, bool flat, ves_arena *arena)
{
    ves_shell_points *rule = &kind->rule;
    double at[2][LINE], weight[2][LINE];
    int count[2] = {kind->order[0] + 1, flat ? 1 : kind->order[1] + 1};
    for (int d = 0; d < 2; d++) ves_rule_gauss(count[d], at[d], weight[d]);
    rule->points = count[0] * count[1];
    memcpy(rule->along, count, sizeof count);
    VES_TRY(product(at[0], count[0], at[1], count[1], arena, &rule->at));
    rule->weight = ves_arena_doubles(arena, (size_t)rule->points);
    if (!rule->weight) return VES_MEMORY;
    for (int q = 0; q < rule->points; q++)
        rule->weight[q] = weight[0][q % count[0]] * weight[1][q / count[0]];
    return points_make(kind, arena, rule);
}

/* Simpson's rule on an odd number of points, or all of it at one. */
static double simpson(int count, int k)
{
    if (count == 1) return 2;
    return 2.0 / (count - 1) / 3 * (k == 0 || k == count - 1 ? 1 : k % 2 ? 4 : 2);
}

static ves_status lattice_make(ves_shell_kind *kind, bool flat, ves_arena *arena)
{
    double at[2][2 * LINE];
    int count[2];
    for (int d = 0; d < 2; d++) {
        count[d] = d == 1 && flat ? 1 : 2 * kind->order[d] + 1;
        for (int k = 0; k < count[d]; k++) at[d][k] = count[d] == 1 ? 0 : 2.0 * k / (count[d] - 1) - 1;
    }
    kind->lattice.points = count[0] * count[1];
    memcpy(kind->lattice.along, count, sizeof count);
    VES_TRY(product(at[0], count[0], at[1], count[1], arena, &kind->lattice.at));
    kind->lattice.weight = ves_arena_doubles(arena, (size_t)kind->lattice.points);
    if (!kind->lattice.weight) return VES_MEMORY;
    for (int q = 0; q < kind->lattice.points; q++)
        kind->lattice.weight[q] = simpson(count[0], q % count[0]) * simpson(count[1], q / count[0]);
    return points_make(kind, arena, &kind->lattice);
}

static bool is_tied(const ves_shell_kind *kind)
{
    bool any = false;
    for (int strain = 0; strain < VES_STRAINS; strain++) any = any || kind->tied[strain].points;
    return any;
}

ves_status ves_shell_kind_make(const int order[2], bool flat, ves_arena *arena, ves_shell_kind *kind)
{
    *kind = (ves_shell_kind){.order = {order[0], order[1]}, .nodes = (order[0] + 1) * (order[1] + 1)};
    kind->plus = order[0] == 1 && order[1] == 1 && !flat;
    for (int strain = 0; strain < VES_STRAINS && !flat; strain++)
        VES_TRY(tied_make(kind, (ves_strain)strain, arena));
    VES_TRY(rule_make(kind, flat, arena));
    if (!is_tied(kind)) VES_TRY(ves_shell_tensor_make(kind, arena));
    return lattice_make(kind, flat, arena);
}
