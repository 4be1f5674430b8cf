/* What the points at one place say of each other. */
#include <math.h>
#include <string.h>

#include "study/sweep_report.h"

/* Ends are one when their objectives agree to this part of them, and their variables to a thousandth of the ranges, as a
 * search tells optima apart, or all their measures to a thousandth: variables may be such that nothing feels them. */
static const double SAME = 1e-6, NEAR = 1e-3, NOISE = 1e-9;

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

static bool agree(double a, double b, double part, double size)
{
    return !(fabs(a - b) > part * fmax(fabs(a), fabs(b)) + NOISE / SAME * part * size);
}

static bool same_variables(const ves_sweep *s, const double *a, const double *b)
{
    const ves_problem *p = s->problem;
    double apart = 0;
    for (int k = 0; k < p->variables; k++)
        apart = fmax(apart, fabs(a[s->first[VES_SWEEP_VARIABLE] + k] - b[s->first[VES_SWEEP_VARIABLE] + k]) /
                                (p->variable[k].max - p->variable[k].min));
    return apart <= NEAR;
}

static bool same(const ves_sweep *s, const double *size, int i, int j)
{
    const double *a = s->point[i].column, *b = s->point[j].column;
    const int first = s->first[VES_SWEEP_MEASURE];
    if (!agree(objective(s, i), objective(s, j), SAME, size[0])) return false;
    if (same_variables(s, a, b)) return true;
    for (int k = 0; k < s->problem->measures; k++)
        if (!agree(a[first + k], b[first + k], NEAR, size[1 + k])) return false;
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
        if (point->optimum == 1 && (best < 0 || list[k] < best)) best = list[k];
    }
    if (best >= 0) s->point[best].best = true;
}

ves_status ves_sweep_compare(ves_sweep *s)
{
    ves_arena arena = {0};
    const int seconds = s->def->axes > 1 ? s->def->axis[1].count : 1;
    int *list = ves_arena_take(&arena, (size_t)s->walks, sizeof *list);
    double *size = ves_arena_take(&arena, (size_t)s->problem->measures + 1, sizeof *size);
    ves_status status = list && size ? VES_OK : VES_MEMORY;
    if (status == VES_OK) {
        size[0] = size_of(s, s->first[VES_SWEEP_OBJECTIVE]);
        for (int k = 0; k < s->problem->measures; k++)
            size[1 + k] = size_of(s, s->first[VES_SWEEP_MEASURE] + k);
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
    const double *value = s->def->axis[0].value + c->place;
    double before = objective_at(s, c->to, c->place) - objective_at(s, c->from, c->place);
    double behind = objective_at(s, c->to, c->place + 1) - objective_at(s, c->from, c->place + 1);
    double part = round(before / (before - behind) * 1e6) / 1e6; /* lines know no more */
    return value[0] * (1 - part) + value[1] * part;
}

bool ves_sweep_change_find(const ves_sweep *s, int second, int place, ves_sweep_change *change)
{
    for (; place + 1 < s->count; place++) {
        *change = (ves_sweep_change){.place = place,
                                     .from = best_walk(s, second, place, -1),
                                     .to = best_walk(s, second, place + 1, -1)};
        if (change->from < 0 || change->to < 0 || best_walk(s, second, place, place + 1) >= 0) continue;
        change->at = crossing(s, change);
        return true;
    }
    return false;
}
