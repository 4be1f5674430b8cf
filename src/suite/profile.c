#include "suite/profile.h"

#include <math.h>

static const ves_outcome *run_of(const ves_tally_input *input, int method, int problem, int seed)
{
    const ves_suite *s = input->suite;
    return &input->outcome[((size_t)method * s->problems + problem) * s->seeds + seed];
}

/* Ascending times, INFINITY among them, to stairs of shares from the first time on; `all` of them count. */
static int stairs(double *x, double *y, int count, int all)
{
    int points = 0;
    ves_statistics_sort(x, count);
    for (int k = 0; k < count && isfinite(x[k]); k++) {
        bool last = k + 1 == count || x[k + 1] > x[k];
        if (!last) continue;
        x[points] = x[k];
        y[points++] = (double)(k + 1) / all;
    }
    return points;
}

static double gap_of(const ves_suite *suite, int k)
{
    double first = log(suite->target[0]), last = log(suite->target[VES_TARGETS - 1]);
    if (k == VES_PROFILE_TARGETS - 1) return suite->target[VES_TARGETS - 1];
    return exp(first + (last - first) * k / (VES_PROFILE_TARGETS - 1));
}

int ves_profile_ecdf(const ves_tally_input *input, const ves_tally *tally, int method, double *x, double *y)
{
    const ves_suite *s = input->suite;
    int count = 0;
    for (int p = 0; p < s->problems; p++)
        for (int k = 0; k < s->seeds; k++) {
            const ves_outcome *o = run_of(input, method, p, k);
            for (int t = 0; o->done && t < VES_PROFILE_TARGETS; t++) {
                double value = ves_suite_value(&s->problem[p], tally->reference[p].value, gap_of(s, t));
                x[count++] = ves_outcome_reach(o, value) / input->n[p];
            }
        }
    return stairs(x, y, count, count);
}

static double first_value(const ves_outcome *o)
{
    for (int k = 0; k < o->steps; k++)
        if (o->step[k].violation <= 1) return o->step[k].value;
    return NAN;
}

int ves_profile_data(const ves_tally_input *input, const ves_tally *tally, int method, double tau, double *x,
                     double *y)
{
    const ves_suite *s = input->suite;
    int count = 0;
    for (int p = 0; p < s->problems; p++)
        for (int k = 0; k < s->seeds; k++) {
            double first = NAN, best = INFINITY;
            for (int e = 0; e < s->methods; e++) {
                const ves_outcome *o = run_of(input, e, p, k);
                if (!o->done) continue;
                first = fmax(first, first_value(o)); /* of a number and NAN: the number */
                best = fmin(best, ves_tally_value(o));
            }
            const ves_outcome *o = run_of(input, method, p, k);
            if (!o->done) continue;
            best = fmax(best, tally->reference[p].value);
            double value = best + tau * (first - best);
            x[count++] = isnan(value) ? INFINITY : ves_outcome_reach(o, value) / (input->n[p] + 1);
        }
    return stairs(x, y, count, count);
}

bool ves_profile_convergence(const ves_tally_input *input, const ves_tally *tally, int method, int problem,
                             double least, ves_profile_band *band)
{
    const ves_suite *s = input->suite;
    double budget = ves_suite_budget(s, input->n[problem]), reference = tally->reference[problem].value;
    double *gap = ves_memory_take((size_t)s->seeds * sizeof *gap);
    if (!gap) return false;
    for (int i = 0; i < VES_PROFILE_POINTS; i++) {
        int n = 0;
        band->x[i] = exp(log(fmax(budget, 2)) * i / (VES_PROFILE_POINTS - 1));
        for (int k = 0; k < s->seeds; k++) {
            const ves_outcome *o = run_of(input, method, problem, k);
            if (o->done) gap[n++] = fmax(ves_outcome_value(o, band->x[i] * (1 + 1e-12)) - reference, least);
        }
        ves_statistics_sort(gap, n);
        band->low[i] = ves_statistics_quantile(gap, n, 0.25);
        band->y[i] = ves_statistics_quantile(gap, n, 0.5);
        band->high[i] = ves_statistics_quantile(gap, n, 0.75);
    }
    ves_memory_free(gap);
    return true;
}
