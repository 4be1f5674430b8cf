#include "search/point.h"

#include <math.h>
#include <string.h>

void ves_point_fail(ves_point *point)
{
    point->verdict.status = VES_NO_NUMBER;
    point->verdict.value = point->verdict.violation = HUGE_VAL;
}

bool ves_point_create(ves_arena *arena, int n, int m, ves_point *point)
{
    *point = (ves_point){0};
    ves_point_fail(point);
    point->u = ves_arena_take(arena, (size_t)n, sizeof(double));
    point->x = ves_arena_take(arena, (size_t)n, sizeof(double));
    point->verdict.constraint = ves_arena_take(arena, (size_t)m, sizeof(double));
    return point->u && point->x && point->verdict.constraint;
}

void ves_point_copy(ves_point *to, const ves_point *from, int n, int m)
{
    double *constraint = to->verdict.constraint;
    memcpy(to->u, from->u, (size_t)n * sizeof(double));
    memcpy(to->x, from->x, (size_t)n * sizeof(double));
    if (m) memcpy(constraint, from->verdict.constraint, (size_t)m * sizeof(double));
    to->verdict = from->verdict;
    to->verdict.constraint = constraint;
    to->proved = from->proved;
}

double ves_point_scale(const ves_search_problem *problem, int i, double u)
{
    double lower = problem->lower[i], upper = problem->upper[i];
    double x = lower + u * (upper - lower);
    return x < lower ? lower : x > upper ? upper : x;
}

void ves_point_place(const ves_search_problem *problem, const double *u, double *x)
{
    for (int i = 0; i < problem->n; i++) x[i] = ves_point_scale(problem, i, u[i]);
}

double ves_point_reflect(double u)
{
    if (u >= 0 && u <= 1) return u;
    double t = fabs(u);
    t -= 2 * floor(t / 2); /* as fmod(t, 2), to the bit, at a tenth of its price */
    return t > 1 ? 2 - t : t;
}
