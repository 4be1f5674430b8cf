#include "suite/tally.h"

#include <math.h>
#include <string.h>

/* The runs of one method on one problem. */
typedef struct bundle {
    const ves_tally_input *input;
    int method, problem;
    const ves_outcome *run; /* [seeds] */
} bundle;

static bundle bundle_of(const ves_tally_input *input, int method, int problem)
{
    const ves_suite *s = input->suite;
    return (bundle){input, method, problem,
                    input->outcome + ((size_t)method * s->problems + problem) * s->seeds};
}

double ves_tally_value(const ves_outcome *outcome)
{
    return outcome->any && outcome->violation <= 1 ? outcome->value : INFINITY;
}

/* A violation that is worth nothing, in units of what is allowed. */
static const double nothing = 1e-2;

/* A known optimum is contradicted by a value below it by more than constraints may be worth. */
static double contradiction(const ves_suite *s, const ves_suite_problem *problem, double optimum,
                            const ves_outcome *o)
{
    double value = ves_tally_value(o), gap = s->target[o->violation <= nothing ? VES_TARGETS - 1 : 1];
    double size = ves_suite_value(problem, optimum, gap) - optimum;
    return o->done && value < optimum - size ? value : NAN;
}

/* The best of those runs whose violation is at most so much; unless they are better than what is there. */
static void best_of(const ves_tally_input *input, int problem, double allowed, ves_reference *r)
{
    const ves_suite *s = input->suite;
    for (int e = 0; e < s->methods; e++) {
        bundle b = bundle_of(input, e, problem);
        for (int k = 0; k < s->seeds; k++) {
            bool counts = b.run[k].done && b.run[k].violation <= allowed;
            double value = counts ? ves_tally_value(&b.run[k]) : INFINITY;
            if (isfinite(value) && !(r->value <= value)) r->value = value, r->method = e, r->seed = k;
        }
    }
}

ves_reference ves_tally_reference(const ves_tally_input *input, int problem)
{
    const ves_suite *s = input->suite;
    const ves_suite_problem *b = &s->problem[problem];
    ves_reference r = {
        .value = input->optimum[problem], .known = !isnan(input->optimum[problem]), .below = NAN};
    if (!r.known) best_of(input, problem, 1, &r);
    double polished = input->polished ? input->polished[problem] : NAN;
    if (!r.known && polished <= ves_suite_value(b, r.value, s->target[1])) {
        r.value = polished; /* more than the best, where that used up what constraints are allowed */
        r.polished = true;
        best_of(input, problem, nothing, &r);
    }
    for (int e = 0; e < s->methods && r.known; e++)
        for (int k = 0; k < s->seeds; k++)
            r.below = fmin(r.below, contradiction(s, b, r.value, &bundle_of(input, e, problem).run[k]));
    return r;
}

double ves_tally_dearness(const ves_suite *suite, const ves_suite_problem *problem,
                          const ves_outcome *outcome, double reference)
{
    double sum = 0;
    for (int t = 0; t < VES_TARGETS; t++) {
        double cost = ves_outcome_reach(outcome, ves_suite_value(problem, reference, suite->target[t]));
        sum += log10(isfinite(cost) && !isnan(reference) ? cost : 10 * outcome->budget);
    }
    return sum / VES_TARGETS;
}

/* Room for the numbers of a bundle. */
typedef struct space {
    double *a, *b;
    bool *hit;
} space;

static void score_target(const bundle *b, double reference, int t, space *room, ves_score *score)
{
    const ves_suite *s = b->input->suite;
    double value = ves_suite_value(&s->problem[b->problem], reference, s->target[t]);
    bool last = t == VES_TARGETS - 1, timed = true;
    int n = 0;
    for (int k = 0; k < s->seeds; k++) {
        const ves_outcome *o = &b->run[k];
        if (!o->done) continue;
        double cost = isnan(reference) ? INFINITY : ves_outcome_reach(o, value);
        room->hit[n] = isfinite(cost);
        room->a[n] = room->hit[n] ? cost : o->budget; /* one that ended of itself gains nothing by that */
        room->b[n] = o->spent > 0 ? o->wall * room->a[n] / o->spent : NAN;
        timed = timed && isfinite(room->b[n]);
        score->hits[t] += room->hit[n++];
    }
    score->share[t] = ves_statistics_share(score->hits[t], n);
    score->ert[t] = ves_statistics_ert(room->a, room->hit, n, s->seed);
    if (last && timed) score->seconds = ves_statistics_ert(room->b, room->hit, n, s->seed);
    if (last && !timed) score->seconds = (ves_interval){NAN, NAN, NAN};
}

static void score_ends(const bundle *b, space *room, ves_score *score)
{
    const ves_suite *s = b->input->suite;
    double own = 0, evaluations = 0;
    int n = 0;
    score->worst = NAN;
    for (int k = 0; k < s->seeds; k++) {
        const ves_outcome *o = &b->run[k];
        if (!o->done) continue;
        room->a[n] = ves_tally_value(o);
        score->feasible += isfinite(room->a[n++]);
        score->failed += o->failed;
        if (*o->reason && !score->reason) score->reason = o->reason;
        if (o->any && !(o->violation <= score->worst)) score->worst = o->violation;
        own += ves_outcome_own(o);
        evaluations += (double)o->evaluations;
    }
    score->runs = n;
    score->own = evaluations > 0 ? own / evaluations : NAN;
    ves_statistics_sort(room->a, n);
    for (int q = 0; q < 3; q++) score->quartile[q] = ves_statistics_quantile(room->a, n, 0.25 * (q + 1));
    score->best = n ? room->a[0] : NAN;
}

static void total_of(const ves_tally *tally, int method, ves_total *total)
{
    const ves_suite *s = tally->suite;
    double own = 0, parts = 0;
    for (int p = 0; p < s->problems; p++) {
        const ves_score *score = &tally->score[method * s->problems + p];
        total->runs += score->runs;
        total->failed += score->failed;
        total->feasible += score->feasible;
        for (int t = 0; t < VES_TARGETS; t++) total->hits[t] += score->hits[t];
        if (!isnan(score->own)) own += score->own, parts++;
    }
    total->own = parts > 0 ? own / parts : NAN;
    for (int t = 0; t < VES_TARGETS; t++) total->share[t] = ves_statistics_share(total->hits[t], total->runs);
}

/* Room for the comparison of two methods: of the runs that both have done, and of the means of problems. */
typedef struct pairing {
    double *x, *y;           /* [problems * seeds] */
    double *x_mean, *y_mean; /* [problems] */
    double *p, *q;           /* [methods^2] of the pairs so far: by runs, by problems */
} pairing;

static double mean(const double *x, int n)
{
    double sum = 0;
    for (int k = 0; k < n; k++) sum += x[k];
    return sum / n;
}

static bool failed_everywhere(const ves_tally *tally, int method)
{
    return tally->total[method].failed == tally->total[method].runs;
}

static ves_pair pair_of(const ves_tally *tally, const ves_tally_input *input, int first, int second,
                        pairing *room)
{
    const ves_suite *s = input->suite;
    double effect = 0, *x = room->x, *y = room->y;
    int n = 0, problems = 0;
    ves_pair pair = {.effect = NAN, .p = NAN, .by_problem = NAN, .least = NAN};
    if (failed_everywhere(tally, first) || failed_everywhere(tally, second)) return pair;
    for (int p = 0; p < s->problems; p++) {
        bundle a = bundle_of(input, first, p), b = bundle_of(input, second, p);
        int begin = n;
        for (int k = 0; k < s->seeds; k++) {
            if (!a.run[k].done || !b.run[k].done) continue;
            x[n] = ves_tally_dearness(s, &s->problem[p], &a.run[k], tally->reference[p].value);
            y[n++] = ves_tally_dearness(s, &s->problem[p], &b.run[k], tally->reference[p].value);
        }
        if (n == begin) continue;
        effect += ves_statistics_effect(x + begin, n - begin, y + begin, n - begin);
        room->x_mean[problems] = mean(x + begin, n - begin);
        room->y_mean[problems++] = mean(y + begin, n - begin);
    }
    if (!problems) return pair;
    ves_paired paired = ves_statistics_paired(x, y, n);
    pair.effect = effect / problems;
    pair.p = paired.p;
    pair.lead = paired.lead;
    pair.least = ves_statistics_least(n);
    if (problems >= VES_TALLY_PROBLEMS)
        pair.by_problem = ves_statistics_paired(room->x_mean, room->y_mean, problems).p;
    return pair;
}

static void mirror(const ves_pair *pair, ves_pair *other)
{
    *other = *pair;
    other->effect = 1 - pair->effect;
    other->lead = -pair->lead;
}

/* Each pair is tested once; the other half of the matrix mirrors it. */
static bool pairs_fill(const ves_tally_input *input, ves_tally *tally)
{
    int e = tally->suite->methods, count = 0, tests = 0;
    size_t problems = (size_t)tally->suite->problems, runs = problems * (size_t)tally->suite->seeds,
           square = (size_t)e * (size_t)e;
    double *all = ves_arena_take(&tally->arena, 2 * runs + 2 * problems + 2 * square, sizeof *all);
    if (!all) return false;
    pairing room = {.x = all, .y = all + runs, .x_mean = all + 2 * runs, .p = all + 2 * runs + 2 * problems};
    room.y_mean = room.x_mean + problems;
    room.q = room.p + square;
    for (int i = 0; i < e; i++)
        for (int j = i + 1; j < e; j++, count++) {
            ves_pair *pair = &tally->pair[i * e + j];
            *pair = pair_of(tally, input, i, j, &room);
            room.p[count] = pair->p;
            room.q[count] = pair->by_problem;
            tests += !isnan(pair->p);
        }
    ves_statistics_holm(room.p, count);
    ves_statistics_holm(room.q, count);
    count = 0;
    for (int i = 0; i < e; i++)
        for (int j = i + 1; j < e; j++, count++) {
            ves_pair *pair = &tally->pair[i * e + j];
            pair->p = room.p[count];
            pair->by_problem = room.q[count];
            pair->least = fmin(1, pair->least * tests);
            if (isnan(pair->p)) pair->least = NAN;
            mirror(pair, &tally->pair[j * e + i]);
        }
    return true;
}

ves_finding ves_tally_finding(const ves_pair *pair)
{
    if (isnan(pair->p)) return VES_FINDING_NONE;
    if (pair->least >= VES_TALLY_LEVEL) return VES_FINDING_FEW;
    if (!(pair->p < VES_TALLY_LEVEL)) return VES_FINDING_SAME;
    if (pair->lead > 0 && pair->effect > 0.5) return VES_FINDING_FIRST;
    if (pair->lead < 0 && pair->effect < 0.5) return VES_FINDING_SECOND;
    return VES_FINDING_MIXED;
}

static bool take(ves_tally *tally, space *room)
{
    size_t e = (size_t)tally->suite->methods, b = (size_t)tally->suite->problems,
           k = (size_t)tally->suite->seeds;
    tally->reference = ves_arena_take(&tally->arena, b, sizeof *tally->reference);
    tally->score = ves_arena_take(&tally->arena, e * b, sizeof *tally->score);
    tally->total = ves_arena_take(&tally->arena, e, sizeof *tally->total);
    tally->pair = ves_arena_take(&tally->arena, e * e, sizeof *tally->pair);
    room->a = ves_arena_take(&tally->arena, k, sizeof *room->a);
    room->b = ves_arena_take(&tally->arena, k, sizeof *room->b);
    room->hit = ves_arena_take(&tally->arena, k, sizeof *room->hit);
    return tally->reference && tally->score && tally->total && tally->pair && room->a && room->b && room->hit;
}

bool ves_tally_init(const ves_tally_input *input, ves_tally *tally)
{
    const ves_suite *s = input->suite;
    space room;
    *tally = (ves_tally){.suite = s};
    if (!take(tally, &room)) return false;
    for (int p = 0; p < s->problems; p++) tally->reference[p] = ves_tally_reference(input, p);
    for (int e = 0; e < s->methods; e++) {
        for (int p = 0; p < s->problems; p++) {
            ves_score *score = &tally->score[e * s->problems + p];
            bundle b = bundle_of(input, e, p);
            score_ends(&b, &room, score);
            for (int t = 0; t < VES_TARGETS; t++)
                score_target(&b, tally->reference[p].value, t, &room, score);
        }
        total_of(tally, e, &tally->total[e]);
    }
    return pairs_fill(input, tally);
}

void ves_tally_destroy(ves_tally *tally)
{
    ves_arena_destroy(&tally->arena);
}
