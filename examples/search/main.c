/* The search library by itself: which closed can of 330 ml takes the least sheet?
 *
 * Two variables, radius r and height h in cm; the area 2 pi r (r + h) is minimised while the volume pi r^2 h
 * is held at 330 cm^3. By hand: h = 2 r = 7.49 cm, 264.4 cm^2. */
#include <stdio.h>

#include <vesica/search.h>

static const double pi = 3.14159265358979323846;

/* Judges one candidate. A constraint is scaled: its value is a part of what is asked for, so that 1e-6 is a
 * millionth of 330 ml. verdict->violation may be left alone: the search then takes the largest of the
 * constraints. */
static ves_status evaluate(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    const double volume =
        *(const double *)data; /* the same for all threads; what is written needs one place for each worker */
    (void)worker;
    double r = ask->x[0], h = ask->x[1];
    verdict->value = 2 * pi * r * (r + h);
    verdict->constraint[0] = pi * r * r * h / volume - 1;
    if (ask->want & VES_WANT_GRADIENT) {
        verdict->gradient[0] = 2 * pi * (2 * r + h);
        verdict->gradient[1] = 2 * pi * r;
        verdict->jacobian[0] = 2 * pi * r * h / volume; /* row = constraint, column = variable */
        verdict->jacobian[1] = pi * r * r / volume;
    }
    return VES_OK; /* a candidate that cannot be judged: a positive status, say VES_DEGENERATE */
}

int main(void)
{
    double volume = 330;
    const double lower[] = {1, 1}, upper[] = {20, 40}, start[] = {2, 30};
    const bool equality[] = {true};
    const char *const name[] = {"r", "h"};
    ves_search_problem problem = {.n = 2,
                                  .m = 1,
                                  .lower = lower,
                                  .upper = upper,
                                  .start = start,
                                  .equality = equality,
                                  .gradients = true,
                                  .workers = 2,
                                  .evaluate = evaluate,
                                  .data = &volume,
                                  .name = name};
    ves_search_options options = ves_search_options_default(); /* anneal, then polish */
    options.seed = 7;

    ves_search_result *result;
    ves_status status = ves_search_run(&problem, &options, NULL, &result);
    if (status != VES_OK) {
        fprintf(stderr, "%s\n", ves_status_text(status));
        return 1;
    }
    printf("r = %.6f cm, h = %.6f cm, area = %.6f cm^2\n", result->x[0], result->x[1], result->value);
    printf("volume off by %.1e, %ld evaluations, %ld of them with gradients\n", result->violation,
           result->evaluations, result->gradients);
    printf("%s\n", result->stop);
    for (int k = 0; k < result->notes; k++) printf("note: %s\n", result->note[k]);
    int code = result->feasible ? 0 : 1;
    ves_search_result_destroy(result);
    return code;
}
