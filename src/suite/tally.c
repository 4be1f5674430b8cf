#include "suite/tally.h"

#include <math.h>
#include <string.h>

/* The runs of one method on one problem. */
typedef struct bundle {
    const ves_tally_input *input;
    int entrant, bout;
    const ves_outcome *run; /* [seeds] */
} bundle;

static bundle bundle_of(const ves_tally_input *input, int entrant, int bout)
{
    const ves_suite *s = input->suite;
    return (bundle){input, entrant, bout, input->outcome + ((size_t)entrant * s->bouts + bout) * s->seeds};
}

double ves_tally_value(const ves_outcome *outcome)
{
    return outcome->any && outcome->violation <= 1 ? outcome->value : INFINITY;
}

static ves_reference reference_of(const ves_tally_input *input, int bout)
{
    const ves_suite *s = input->suite;
    ves_reference r = {.value = input->optimum[bout], .known = !isnan(input->optimum[bout])};
    for (int e = 0; e < s->entrants && !r.known; e++) {
        bundle b = bundle_of(input, e, bout);
        for (int k = 0; k < s->seeds; k++) {
            double value = b.run[k].done ? ves_tally_value(&b.run[k]) : INFINITY;
            if (isfinite(value) && !(r.value <= value)) r.value = value, r.entrant = e, r.seed = k;
        }
    }
    return r;
}

double ves_tally_dearness(const ves_suite *suite, const ves_bout *bout, const ves_outcome *outcome,
                          double reference)
{
    double sum = 0;
    for (int t = 0; t < VES_TARGETS; t++) {
        double cost = ves_outcome_reach(outcome, ves_suite_value(bout, reference, suite->target[t]));
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
    double value = ves_suite_value(&s->bout[b->bout], reference, s->target[t]);
    bool last = t == VES_TARGETS - 1, timed = true;
    int n = 0;
    for (int k = 0; k < s->seeds; k++) {
        const ves_outcome *o = &b->run[k];
        if (!o->done) continue;
        double cost = isnan(reference) ? INFINITY : ves_outcome_reach(o, value);
        room->hit[n] = isfinite(cost);
        room->a[n] = room->hit[n] ? cost : o->spent;
        room->b[n] = o->spent > 0 ? o->wall * room->a[n] / o->spent : 0;
        timed = timed && !isnan(o->wall);
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

static void total_of(const ves_tally *tally, int entrant, ves_total *total)
{
    const ves_suite *s = tally->suite;
    double own = 0, parts = 0;
    for (int p = 0; p < s->bouts; p++) {
        const ves_score *score = &tally->score[entrant * s->bouts + p];
        total->runs += score->runs;
        total->failed += score->failed;
        total->feasible += score->feasible;
        for (int t = 0; t < VES_TARGETS; t++) total->hits[t] += score->hits[t];
        if (!isnan(score->own)) own += score->own, parts++;
    }
    total->own = parts > 0 ? own / parts : NAN;
    for (int t = 0; t < VES_TARGETS; t++) total->share[t] = ves_statistics_share(total->hits[t], total->runs);
}

/* x, y [bouts * seeds] take the dearness of runs that both have done. */
static ves_pair pair_of(const ves_tally *tally, const ves_tally_input *input, int first, int second,
                        double *x, double *y)
{
    const ves_suite *s = input->suite;
    double effect = 0;
    int n = 0, problems = 0;
    ves_pair pair = {.effect = NAN, .p = NAN};
    for (int p = 0; p < s->bouts; p++) {
        bundle a = bundle_of(input, first, p), b = bundle_of(input, second, p);
        int begin = n;
        for (int k = 0; k < s->seeds; k++) {
            if (!a.run[k].done || !b.run[k].done) continue;
            x[n] = ves_tally_dearness(s, &s->bout[p], &a.run[k], tally->reference[p].value);
            y[n] = ves_tally_dearness(s, &s->bout[p], &b.run[k], tally->reference[p].value);
            pair.pairs += x[n] != y[n];
            n++;
        }
        if (n == begin) continue;
        effect += ves_statistics_effect(x + begin, n - begin, y + begin, n - begin);
        problems++;
    }
    if (!problems) return pair;
    pair.effect = effect / problems;
    pair.p = ves_statistics_paired(x, y, n);
    return pair;
}

/* Each pair is tested once; the other half of the matrix mirrors it. */
static bool pairs_fill(const ves_tally_input *input, ves_tally *tally)
{
    int e = tally->suite->entrants, count = 0;
    size_t runs = (size_t)tally->suite->bouts * (size_t)tally->suite->seeds;
    double *x = ves_arena_take(&tally->arena, 2 * runs, sizeof *x);
    double *p = ves_arena_take(&tally->arena, (size_t)e * (size_t)e, sizeof *p);
    if (!x || !p) return false;
    for (int i = 0; i < e; i++)
        for (int j = i + 1; j < e; j++) {
            tally->pair[i * e + j] = pair_of(tally, input, i, j, x, x + runs);
            p[count++] = tally->pair[i * e + j].p;
        }
    ves_statistics_holm(p, count);
    count = 0;
    for (int i = 0; i < e; i++)
        for (int j = i + 1; j < e; j++) {
            ves_pair *pair = &tally->pair[i * e + j];
            pair->p = p[count++];
            tally->pair[j * e + i] = *pair;
            tally->pair[j * e + i].effect = 1 - pair->effect;
        }
    return true;
}

static bool take(ves_tally *tally, space *room)
{
    size_t e = (size_t)tally->suite->entrants, b = (size_t)tally->suite->bouts,
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
    for (int p = 0; p < s->bouts; p++) tally->reference[p] = reference_of(input, p);
    for (int e = 0; e < s->entrants; e++) {
        for (int p = 0; p < s->bouts; p++) {
            ves_score *score = &tally->score[e * s->bouts + p];
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
