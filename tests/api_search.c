/* What a program does that uses the search alone, with the installed headers alone. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include <vesica/search.h>

typedef struct told {
    long records, slopes, blocks;
} told;

/* Least x + y on x^2 + y^2 <= 2 is at (-1, -1). */
static ves_status disk(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    (void)data, (void)worker;
    const double *x = ask->x;
    verdict->value = x[0] + x[1];
    verdict->constraint[0] = x[0] * x[0] + x[1] * x[1] - 2;
    if (ask->want & VES_WANT_GRADIENT) {
        verdict->gradient[0] = verdict->gradient[1] = 1;
        verdict->jacobian[0] = 2 * x[0];
        verdict->jacobian[1] = 2 * x[1];
    }
    return VES_OK;
}

static void count_records(void *data, const void *block, size_t size, bool whole)
{
    told *t = data;
    ves_search_cursor cursor = {0};
    ves_record record;
    cr_expect(whole);
    t->blocks++;
    while (ves_search_block_read(block, size, 2, 1, &cursor, &record)) {
        t->records++;
        t->slopes += record.slope != NULL;
    }
}

Test(api_search, a_callback_is_minimised_and_its_journal_read)
{
    const double lower[] = {-3, -3}, upper[] = {3, 3}, start[] = {2, 1};
    const ves_search_problem problem = {
        .n = 2, .m = 1, .lower = lower, .upper = upper, .start = start, .gradients = true, .evaluate = disk};
    ves_search_options options = ves_search_options_default();
    options.evaluations = 2000;
    options.stages = 2;
    options.stage[0].kind = VES_STAGE_ANNEAL;
    options.stage[1].kind = VES_STAGE_POLISH;
    told t = {0};
    const ves_search_hooks hooks = {.keep = count_records, .data = &t};
    ves_search_result *result;
    cr_assert_eq(ves_search_run(&problem, &options, &hooks, &result), VES_OK);
    cr_expect(result->feasible && fabs(result->value + 2) < 1e-6, "%.12g", result->value);
    cr_expect(t.blocks > 2 && t.records == result->evaluations && t.slopes == result->gradients);
    const ves_evidence *e = &result->evidence;
    cr_expect(e->trust == VES_TRUST_CONVERGED && e->descents == 0 && e->unmeasured == 0);
    cr_expect(strncmp(e->sentence + e->verdict, "; no independent", 16) == 0, "%s", e->sentence);
    cr_expect(isnan(ves_evidence_expected(3, 1)) && ves_evidence_expected(4, 1) == 3);
    cr_expect(isnan(ves_evidence_unseen(3, 1)) && ves_evidence_unseen(4, 1) == 2. / 12);
    ves_search_result_destroy(result);
}

/* What may be written in the slots of an annealing can be listed, and written. */
Test(api_search, choices)
{
    ves_choice choice;
    int slots = 0, words = 0;
    for (; slots <= VES_SLOT_PRESET; slots++)
        for (int k = 0; ves_search_choice((ves_slot)slots, k, &choice); k++) words += choice.about != NULL;
    cr_expect(words > 20);
    const double lower[] = {-3, -3}, upper[] = {3, 3}, start[] = {2, 1};
    const ves_search_problem problem = {
        .n = 2, .m = 1, .lower = lower, .upper = upper, .start = start, .evaluate = disk};
    ves_search_options options = ves_search_options_default();
    options.stages = 1;
    options.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL, .anneal = ves_anneal_default()};
    options.stage[0].anneal.schedule = "lam";
    options.evaluations = 2000;
    ves_search_result *result;
    cr_assert_eq(ves_search_run(&problem, &options, NULL, &result), VES_OK);
    cr_expect(result->annealings == 1 && result->annealing[0].moves == 3);
    cr_expect(strcmp(result->annealing[0].schedule, "lam") == 0);
    ves_search_result_destroy(result);
}

/* One line that is far above the others counts as twice the median; others are of another annealing, or not near. */
Test(api_search, a_heat_capacity_is_a_mean_of_what_was_seen)
{
    const ves_temperature line[] = {{.c = 1, .trials = 10, .variance = 1},
                                    {.c = 1.25, .trials = 30, .variance = 2 * 1.25 * 1.25},
                                    {.c = 1.1, .trials = 10, .variance = 100 * 1.1 * 1.1},
                                    {.c = 1.1, .trials = 0, .variance = 7},
                                    {.c = 1.1, .trials = 50, .variance = 7, .annealing = 1},
                                    {.c = 3, .trials = 50, .variance = 9}};
    double scratch[6];
    double c = ves_heat_capacity(line, 6, 0, 1.2 / VES_HEAT_REACH, 1.2 * VES_HEAT_REACH, scratch);
    cr_expect(fabs(c - (10 * 1 + 30 * 2 + 10 * 4) / 50.) < 1e-12, "%.17g", c);
    cr_expect(ves_heat_capacity(line, 6, 0, 5, 9, scratch) == 0, "none there");
}
