/* The meter charges, writes down and stops; suites number their runs. */
#include <criterion/criterion.h>
#include <math.h>

#include "suite/outcome.h"
#include "suite/suite.h"

/* value x, one constraint 0.5 - x <= 0; below 0.1 there is no value */
static ves_status line(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    (void)data, (void)worker;
    if (ask->x[0] < 0.1) return VES_DEGENERATE;
    verdict->value = ask->x[0];
    verdict->constraint[0] = 0.5 - ask->x[0];
    if (ask->want & VES_WANT_GRADIENT) verdict->gradient[0] = 1, verdict->jacobian[0] = -1;
    return VES_OK;
}

static const double zero = 0, one = 1;
static const ves_search_problem raw = {
    .n = 1, .m = 1, .lower = &zero, .upper = &one, .gradients = true, .evaluate = line};

static ves_status ask(ves_meter *meter, double x, bool slopes, ves_verdict *out)
{
    static double constraint[1], gradient[1], jacobian[1];
    ves_search_problem p = ves_meter_problem(meter, NULL);
    *out = (ves_verdict){.constraint = constraint, .gradient = gradient, .jacobian = jacobian};
    const ves_ask question = {
        .x = &x, .cutoff = HUGE_VAL, .want = slopes ? VES_WANT_GRADIENT : VES_WANT_VALUE};
    return p.evaluate(p.data, 0, &question, out);
}

Test(suite_meter, charges_and_writes_down)
{
    ves_meter m = {
        .inner = &raw, .budget = 12, .cost = 1, .cost_gradient = 3, .inequality = 0.1, .equality = 1};
    m.target = -HUGE_VAL;
    ves_verdict v;
    cr_assert(ves_meter_begin(&m));
    cr_expect(ask(&m, 0.3, false, &v) == VES_OK && m.spent == 1);
    cr_expect(fabs(v.violation - 2e-6) < 1e-18, "0.2 beyond, 0.1 allowed: got %g", v.violation);
    cr_expect(ask(&m, 0.05, false, &v) == VES_OK && v.status == VES_DEGENERATE && m.failed == 1);
    cr_expect(ask(&m, 0.9, true, &v) == VES_OK && m.spent == 5 && m.gradients == 1);
    cr_expect(ask(&m, 0.7, false, &v) == VES_OK && m.spent == 6);
    cr_expect(ask(&m, 0.7, true, &v) == VES_OK && m.spent == 8, "the value was paid for: got %g", m.spent);
    cr_expect(ask(&m, 0.7, true, &v) == VES_OK && m.spent == 11, "asked again, paid again: got %g", m.spent);
    cr_expect(!m.over && ask(&m, 0.6, true, &v) == VES_INTERRUPTED && m.over && m.spent == 11);
    const ves_step want[] = {{1, 0.3, 2}, {5, 0.9, 0}, {6, 0.7, 0}};
    cr_assert(m.steps == 3, "got %d", m.steps);
    for (int k = 0; k < 3; k++)
        cr_expect(m.step[k].cost == want[k].cost && m.step[k].value == want[k].value &&
                      fabs(m.step[k].violation - want[k].violation) < 1e-12,
                  "step %d: %g %g %g", k, m.step[k].cost, m.step[k].value, m.step[k].violation);
    const ves_outcome o = {.steps = m.steps, .step = m.step};
    cr_expect(ves_outcome_reach(&o, 0.9) == 5 && ves_outcome_reach(&o, 0.8) == 6);
    cr_expect(isinf(ves_outcome_reach(&o, 0.6)), "0.3 was not feasible");
    cr_expect(isinf(ves_outcome_value(&o, 4)) && ves_outcome_value(&o, 5.5) == 0.9);
    ves_meter_end(&m);
}

/* A method that ignores bounds, as NLopt's NEWUOA does, would find 0.05 below the box. */
Test(suite_meter, beyond_the_box_there_is_no_value)
{
    static const double beyond[] = {-1e-12, 1 + 1e-12, -INFINITY, NAN};
    ves_meter m = {
        .inner = &raw, .budget = 12, .cost = 1, .cost_gradient = 3, .inequality = 0.1, .equality = 1};
    m.target = -HUGE_VAL;
    ves_verdict v;
    cr_assert(ves_meter_begin(&m));
    for (int k = 0; k < 4; k++) {
        cr_expect(ask(&m, beyond[k], false, &v) == VES_OK && v.status == VES_OUTSIDE, "%g", beyond[k]);
        cr_expect(m.spent == k + 1 && m.failed == k + 1 && !m.any, "charged, and nothing found");
    }
    cr_expect(ask(&m, 1, false, &v) == VES_OK && v.status == VES_OK && m.value == 1);
    ves_meter_end(&m);
}

static ves_status mirrored(void *data, const double *a, const double *b, bool *same)
{
    *same = *(double *)data + a[0] == -b[0];
    return VES_OK;
}

/* The question whether two designs are one goes to the problem, with the problem's data. */
Test(suite_meter, asks_the_problem_what_is_the_same)
{
    double shift = 0.25, a = 0.25, b = -0.5;
    bool same = false;
    ves_search_problem inner = raw;
    inner.same = mirrored;
    inner.data = &shift;
    ves_meter m = {.inner = &inner, .budget = 1, .cost = 1, .cost_gradient = 3};
    ves_search_problem p = ves_meter_problem(&m, NULL);
    cr_expect(p.same(p.data, &a, &b, &same) == VES_OK && same);
    cr_expect(p.same(p.data, &b, &b, &same) == VES_OK && !same);
    m.inner = &raw;
    cr_expect(ves_meter_problem(&m, NULL).same == NULL);
}

Test(suite_meter, ends_at_the_target)
{
    ves_meter m = {
        .inner = &raw, .budget = 100, .cost = 1, .cost_gradient = 3, .inequality = 1e-6, .equality = 1};
    m.target = 0.55;
    ves_verdict v;
    cr_assert(ves_meter_begin(&m));
    cr_expect(ask(&m, 0.4, false, &v) == VES_OK && !m.over, "not feasible");
    cr_expect(ask(&m, 0.5, false, &v) == VES_OK && m.hit && m.over && m.x[0] == 0.5);
    cr_expect(ask(&m, 0.5, false, &v) == VES_INTERRUPTED && ves_meter_left(&m) == 0 && m.spent == 2);
    ves_meter_end(&m);
}

Test(suite_suite, runs_are_numbered_by_methods_first)
{
    const ves_suite suite = {
        .methods = 2, .problems = 3, .seeds = 4, .per_dimension = 1e4, .most = 2e5, .seed = 1};
    cr_expect(ves_suite_runs(&suite) == 24);
    ves_suite_place p = ves_suite_run(&suite, 12 + 2 * 4 + 3);
    cr_expect(p.method == 1 && p.problem == 2 && p.seed == 3);
    cr_expect(ves_suite_budget(&suite, 5) == 5e4 && ves_suite_budget(&suite, 40) == 2e5);
    const ves_suite_problem a = {.name = "a"}, b = {.name = "b"}, file = {.kind = VES_SUITE_FILE};
    cr_expect(ves_suite_value(&a, -15, 0.1) == -13.5 && ves_suite_value(&a, 0.5, 0.1) == 0.6);
    cr_expect(fabs(ves_suite_value(&file, 0.01, 0.1) - 0.011) < 1e-16 &&
              ves_suite_value(&file, 0, 0.1) == 0.1);
    cr_expect(ves_suite_seed(&suite, &a, 0) != ves_suite_seed(&suite, &b, 0));
    cr_expect(ves_suite_seed(&suite, &a, 0) != ves_suite_seed(&suite, &a, 1));
    cr_expect(ves_suite_seed(&suite, &a, 0) < 1ULL << 53);
}
