/* The search library by itself: where does a shallow arch come to rest?
 *
 *            o  apex (x, y), 20 N downwards
 *         /     \                        Two springs of 1000 N/m, at rest with the apex at (0, 0.5), hold it
 *    ____/_______\____                   between feet at (-1, 0) and (1, 0).
 *           ===                          A stop at y = -0.4.
 *
 * It rests where its energy is least: above the feet or, snapped through, on the stop. The stop then pushes with
 * 20 + 2000 (rest / length - 1) 0.4 = 50.455 N, by hand. That is the multiplier of the constraint: what the least
 * energy would gain for each metre that the stop is lowered.
 *
 * It is searched three times: with gradients, by values alone, and by stages of our own choice. */
#include <math.h>
#include <stdio.h>

#include <vesica/search.h>

/* What evaluate() needs to know. Several threads call it at once: they only read this. What a candidate writes needs
 * a place for each `worker`. */
typedef struct arch {
    double stiffness, load; /* N/m, N */
    double rest, stop;      /* m */
} arch;

/* Judges one candidate: the value to be minimised, each constraint (<= 0 where it holds; one that is declared as an
 * equality == 0) and, when wanted, the derivatives of all of them. A constraint is violated by as much as it is
 * positive, and up to 1e-6 counts as nothing: scale it so that this suits you. verdict->violation may be left alone.
 * A candidate that cannot be judged returns a positive status, say VES_NO_NUMBER; the search goes on. */
static ves_status evaluate(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    const arch *a = data;
    const double x = ask->x[0], y = ask->x[1];
    double energy = a->load * y, along_x = 0, along_y = a->load;
    (void)worker;
    for (int side = -1; side <= 1; side += 2) {
        double length = hypot(x - side, y), stretch = length - a->rest;
        energy += 0.5 * a->stiffness * stretch * stretch;
        along_x += a->stiffness * stretch * (x - side) / length;
        along_y += a->stiffness * stretch * y / length;
    }
    verdict->value = energy;
    verdict->constraint[0] = a->stop - y;
    if (ask->want & VES_WANT_GRADIENT) {
        verdict->gradient[0] = along_x;
        verdict->gradient[1] = along_y;
        verdict->jacobian[0] = 0; /* row k: constraint k, column i: variable i */
        verdict->jacobian[1] = -1;
    }
    return VES_OK;
}

/* Without the sign of a zero that is not quite one. */
static double tidy(double value)
{
    return fabs(value) < 5e-7 ? 0 : value;
}

static void tell(const ves_search_result *r)
{
    printf("  best       %.6f J at x = %.6f, y = %.6f%s\n", r->value, tidy(r->x[0]), r->x[1],
           r->feasible ? "" : ", which is not feasible");
    printf("  verdict    %s\n", r->evidence.sentence);
    if (r->kkt.known) printf("  stop       pushes with %.3f N\n", r->kkt.multiplier[0]);
    for (int k = 0; k < r->optima; k++)
        printf("  optimum %d  %.6f J at x = %.6f, y = %.6f, found %d times\n", k + 1, r->optimum[k].value,
               tidy(r->optimum[k].x[0]), r->optimum[k].x[1], r->optimum[k].hits);
    for (int k = 0; k < r->notes; k++) printf("  note       %s\n", r->note[k]);
    printf("  cost       %ld evaluations, %ld of them with gradients\n", r->evaluations, r->gradients);
}

/* Returns whether a feasible best was found. */
static bool search(const char *title, const ves_search_problem *problem, const ves_search_options *options)
{
    ves_search_result *result;
    ves_status status = ves_search_run(problem, options, NULL, &result);
    printf("%s\n", title);
    if (status != VES_OK) {
        printf("  %s\n", ves_status_text(status));
        return false;
    }
    tell(result);
    bool feasible = result->feasible;
    ves_search_result_destroy(result);
    return feasible;
}

int main(void)
{
    arch a = {.stiffness = 1000, .load = 20, .rest = hypot(1, 0.5), .stop = -0.4};
    const double lower[] = {-0.5, -1}, upper[] = {0.5, 1}, start[] = {0.1, 0.5};
    const char *const name[] = {"x", "y"};
    ves_search_problem problem = {.n = 2,
                                  .m = 1, /* an inequality: .equality tells others */
                                  .lower = lower,
                                  .upper = upper,
                                  .start = start,
                                  .name = name,
                                  .gradients = true,
                                  .workers = 2, /* the result is the same for any number */
                                  .evaluate = evaluate,
                                  .data = &a};
    ves_search_options options = ves_search_options_default();
    options.seed = 7; /* same seed, same result */
    bool good = search("with gradients", &problem, &options);

    problem.gradients = false;
    good = search("by values alone", &problem, &options) && good;

    options.stages = 2; /* instead of the portfolio; docs/methods tells what there is */
    options.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL, .anneal = {.evaluations = 2000, .chains = 8}};
    options.stage[1] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = {.algorithm = "cobyla"}};
    good = search("annealing by eight chains, then cobyla", &problem, &options) && good;
    return good ? 0 : 1;
}
