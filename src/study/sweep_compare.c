/* What the points at one place say of each other. */
#include <math.h>
#include <string.h>

#include "study/sweep_report.h"
#include "vesica/plan.h"

/* Ends are one when their objectives agree to a millionth, and their variables to a thousandth of the ranges, as a search
 * tells optima apart, or all their measures to a thousandth of the largest that the sweep has, or to 1e-9 of their
 * natural size: variables may be such that nothing feels them.
 * Ends of different kinds are not one. A search that was broken off has a slope left. Near one optimum the Lagrangian L is convex, so that
 * L(a) - L(b) <= |grad L(a)| |a - b|: ends whose objectives differ by no more than that cannot be told apart; where it is
 * more than a millionth, neither can their measures. */
static const double SAME = 1e-6, NEAR = 1e-3;

static double objective(const ves_sweep *s, int index)
{
    return s->point[index].column[s->first[VES_SWEEP_OBJECTIVE]];
}

/* The largest size that a column has: 0 is told from it. */
static double size_of(const ves_sweep *s, int column)
{
    double most = 0;
    for (int k = 0; k < s->walks * s->count; k++)
        if (s->point[k].good) most = fmax(most, fabs(s->point[k].column[column]));
    return most;
}

/* How far apart two points are in the box of the variables: the largest of all, and the distance. */
typedef struct gap {
    double most, distance;
} gap;

static gap gap_of(const ves_sweep *s, const double *a, const double *b)
{
    const ves_problem *p = s->problem;
    gap g = {0};
    for (int k = s->first[VES_SWEEP_VARIABLE], i = 0; i < p->variables; i++, k++) {
        double apart = fabs(a[k] - b[k]) / (p->variable[i].max - p->variable[i].min);
        g.most = fmax(g.most, apart);
        g.distance = hypot(g.distance, apart);
    }
    return g;
}

static double slope_of(const ves_sweep *s, int index)
{
    double slope = s->point[index].slope;
    return isfinite(slope) ? slope : 0;
}

static bool same(const ves_sweep *s, const double *size, int i, int j)
{
    const double *a = s->point[i].column, *b = s->point[j].column;
    if (s->point[i].kind != s->point[j].kind) return false;
    const double f = objective(s, i), g = objective(s, j);
    const int first = s->first[VES_SWEEP_MEASURE];
    const gap apart = gap_of(s, a, b);
    const double within = SAME * fmax(fmax(fabs(f), fabs(g)), NEAR * size[0]);
    const double unknown = (slope_of(s, i) + slope_of(s, j)) * apart.distance;
    if (fabs(f - g) > within + unknown) return false;
    if (apart.most <= NEAR || unknown > within) return true;
    for (int k = 0; k < s->problem->measures; k++)
        if (fabs(a[first + k] - b[first + k]) > NEAR * size[1 + k]) return false;
    return s->problem->measures > 0;
}

/* Is i the better one? */
static bool better(const ves_sweep *s, int i, int j)
{
    double a = objective(s, i), b = objective(s, j);
    return s->problem->maximize ? a > b : a < b;
}

/* The points of all walks with one second value at one place, best first. Returns how many are good. */
static int gather(const ves_sweep *s, int second, int place, int *list)
{
    int count = 0;
    for (int w = 0; w < s->walks; w++) {
        int index = ves_sweep_point_at(s, w, place), k = count;
        if (s->walk[w].second != second || !s->point[index].done || !s->point[index].good) continue;
        for (; k > 0 && better(s, index, list[k - 1]); k--) list[k] = list[k - 1];
        list[k] = index;
        count++;
    }
    return count;
}

static void rank(ves_sweep *s, const double *size, const int *list, int count)
{
    int optima = 0, best = -1;
    for (int k = 0; k < count; k++) {
        ves_sweep_point *point = &s->point[list[k]];
        point->optimum = 0;
        for (int i = 0; i < k && !point->optimum; i++)
            if (same(s, size, list[i], list[k])) point->optimum = s->point[list[i]].optimum;
        if (!point->optimum) point->optimum = ++optima;
        bool equal = k == 0 || fabs(objective(s, list[k]) - objective(s, list[0])) <=
                                   SAME * fabs(objective(s, list[0]));
        if (point->optimum == 1 && equal && (best < 0 || list[k] < best)) best = list[k];
    }
    if (best >= 0) s->point[best].best = true;
}

/* 1 + measures: of the objective, and of what differences of measures count by. */
static ves_status sizes(const ves_sweep *s, double *size)
{
    const ves_problem *p = s->problem;
    const ves_plan_options grid = {{VES_NODES_LEAST, VES_NODES_LEAST}};
    ves_plan *plan = NULL;
    if (ves_plan_create(p, &grid, &plan, NULL) == VES_MEMORY) return VES_MEMORY;
    size[0] = size_of(s, s->first[VES_SWEEP_OBJECTIVE]);
    for (int k = 0; k < p->measures; k++)
        size[1 + k] =
            fmax(size_of(s, s->first[VES_SWEEP_MEASURE] + k), SAME * ves_plan_measure_size(plan, k));
    ves_plan_destroy(plan);
    return VES_OK;
}

ves_status ves_sweep_compare(ves_sweep *s)
{
    ves_arena arena = {0};
    const int seconds = s->def->axes > 1 ? s->def->axis[1].count : 1;
    int *list = ves_arena_take(&arena, (size_t)s->walks, sizeof *list);
    double *size = ves_arena_take(&arena, (size_t)s->problem->measures + 1, sizeof *size);
    ves_status status = list && size ? VES_OK : VES_MEMORY;
    if (status == VES_OK) status = sizes(s, size);
    if (status == VES_OK) {
        for (int k = 0; k < s->walks * s->count; k++) s->point[k].optimum = 0, s->point[k].best = false;
        for (int j = 0; j < seconds; j++)
            for (int i = 0; i < s->count; i++) rank(s, size, list, gather(s, j, i, list));
    }
    ves_arena_destroy(&arena);
    return status;
}

int ves_sweep_apart(const ves_sweep *s, int walk, int other, int *first, int *last)
{
    int count = 0;
    for (int k = 0; k < s->count; k++) {
        const ves_sweep_point *a = &s->point[ves_sweep_point_at(s, walk, k)],
                              *b = &s->point[ves_sweep_point_at(s, other, k)];
        if (!a->optimum || !b->optimum || a->optimum == b->optimum) continue;
        if (!count) *first = k;
        *last = k;
        count++;
    }
    return count;
}

/* The first walk whose end is the best at a place, and at `beside` too, if that is not negative; -1: none. */
static int best_walk(const ves_sweep *s, int second, int place, int beside)
{
    for (int w = 0; w < s->walks; w++) {
        bool best = s->walk[w].second == second && s->point[ves_sweep_point_at(s, w, place)].optimum == 1;
        if (best && (beside < 0 || s->point[ves_sweep_point_at(s, w, beside)].optimum == 1)) return w;
    }
    return -1;
}

static double objective_at(const ves_sweep *s, int walk, int place)
{
    int index = ves_sweep_point_at(s, walk, place);
    return s->point[index].optimum ? objective(s, index) : NAN;
}

static double crossing(const ves_sweep *s, const ves_sweep_change *c)
{
    const double *value = s->def->axis[0].value;
    double before = objective_at(s, c->to, c->place) - objective_at(s, c->from, c->place);
    double behind = objective_at(s, c->to, c->next) - objective_at(s, c->from, c->next);
    double part = round(before / (before - behind) * 1e6) / 1e6; /* lines know no more */
    return value[c->place] * (1 - part) + value[c->next] * part;
}

bool ves_sweep_change_find(const ves_sweep *s, int second, int place, ves_sweep_change *change)
{
    for (int next; place < s->count; place = next) {
        for (next = place + 1; next < s->count && best_walk(s, second, next, -1) < 0;) next++;
        if (next == s->count) return false;
        *change = (ves_sweep_change){.place = place,
                                     .next = next,
                                     .from = best_walk(s, second, place, -1),
                                     .to = best_walk(s, second, next, -1)};
        if (change->from < 0 || best_walk(s, second, place, next) >= 0) continue;
        change->at = crossing(s, change);
        return true;
    }
    return false;
}

const ves_sweep_known *ves_sweep_change_known(const ves_sweep *s, const ves_sweep_change *change)
{
    static const double NEARBY = 0.1;
    const ves_sweep_def *def = s->def;
    const double *value = def->axis[0].value, range = fabs(value[def->axis[0].count - 1] - value[0]);
    for (int k = 0; k < def->knowns; k++) {
        const ves_sweep_known *known = &def->known[k];
        if (known->from == s->walk[change->from].branch && known->to == s->walk[change->to].branch &&
            fabs(known->at - change->at) <= NEARBY * range)
            return known;
    }
    return NULL;
}

static bool is_measured(const ves_sweep *s, int index)
{
    const ves_sweep_point *point = &s->point[index];
    return point->done && isfinite(point->column[s->first[VES_SWEEP_VIOLATION]]);
}

int ves_sweep_turned(const ves_sweep *s, int index)
{
    int before = index - 1;
    if (!s->problem->kinds || !is_measured(s, index)) return -1;
    while (before >= 0 && before / s->count == index / s->count && !s->point[before].good) before--;
    bool turned =
        before >= 0 && before / s->count == index / s->count && s->point[before].kind != s->point[index].kind;
    return turned ? before : -1;
}

int ves_sweep_best_at(const ves_sweep *s, int second, int place)
{
    for (int w = 0; w < s->walks; w++) {
        int index = ves_sweep_point_at(s, w, place);
        if (s->walk[w].second == second && s->point[index].done && s->point[index].best) return index;
    }
    return -1;
}
