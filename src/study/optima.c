#include "study/optima.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "suite/tally.h"

enum { MOST = 20 };

static const double near = 0.05;

typedef struct end {
    double value;
    int run;
} end;

static int by_value(const void *a, const void *b)
{
    const end *x = a, *y = b;
    if (x->value != y->value) return x->value < y->value ? -1 : 1;
    return x->run - y->run;
}

/* Do the values of a and a worse b differ by less than a target's gap? */
static bool within(const ves_bench *bench, const ves_suite_problem *problem, double a, double b, int target)
{
    return b <= ves_suite_value(problem, a, bench->suite->target[target]);
}

static ves_status is_same(ves_pose *pose, const ves_bench *bench, const ves_bench_optimum *optimum,
                          const end *e, bool *same)
{
    const ves_outcome *a = &bench->outcome[optimum->run], *b = &bench->outcome[e->run];
    const ves_suite_problem *problem = &bench->suite->problem[optimum->problem];
    double apart = 0;
    *same = within(bench, problem, a->value, b->value, VES_TARGETS - 1);
    if (*same || !within(bench, problem, a->value, b->value, 1)) return VES_OK;
    for (int i = 0; i < a->n; i++) apart = fmax(apart, fabs(a->x[i] - b->x[i]));
    *same = apart <= near;
    if (*same || !pose->problem.same) return VES_OK;
    return pose->problem.same(pose->problem.data, a->x, b->x, same);
}

/* To the first optimum that it is, or a new one. */
static ves_status sort_in(ves_pose *pose, ves_bench *bench, int first, int problem, const end *e)
{
    int method = ves_suite_run(bench->suite, e->run).method;
    for (int k = first; k < bench->optima; k++) {
        bool same;
        VES_TRY(is_same(pose, bench, &bench->optimum[k], e, &same));
        if (!same) continue;
        bench->optimum[k].hits[method]++;
        return VES_OK;
    }
    if (bench->optima - first == MOST) return VES_OK;
    ves_bench_optimum *list = ves_memory_grow(bench->optimum, (size_t)(bench->optima + 1) * sizeof *list);
    if (!list) return VES_MEMORY;
    bench->optimum = list;
    ves_bench_optimum *o = &list[bench->optima];
    *o = (ves_bench_optimum){.problem = problem, .run = e->run, .value = e->value};
    o->hits = ves_memory_take((size_t)bench->suite->methods * sizeof *o->hits);
    if (!o->hits) return VES_MEMORY;
    o->hits[method] = 1;
    bench->optima++;
    return VES_OK;
}

ves_status ves_optima_find(ves_testbed *testbed, int problem, ves_bench *bench, ves_arena *arena)
{
    const ves_suite *suite = bench->suite;
    ves_pose pose;
    int count = 0, first = bench->optima;
    end *list = ves_arena_take(arena, (size_t)bench->runs, sizeof *list);
    if (!list) return VES_MEMORY;
    VES_TRY(ves_testbed_pose(testbed, 0, 0, arena, &pose));
    for (int k = 0; k < bench->runs; k++) {
        const ves_outcome *o = &bench->outcome[k];
        bool counts = ves_suite_run(suite, k).problem == problem && o->done && isfinite(ves_tally_value(o));
        if (counts) list[count++] = (end){o->value, k};
    }
    if (count) qsort(list, (size_t)count, sizeof *list, by_value);
    for (int k = 0; k < count && within(bench, testbed->problem, list[0].value, list[k].value, 0); k++)
        VES_TRY(sort_in(&pose, bench, first, problem, &list[k]));
    return VES_OK;
}
