/* What a run tells of violations and failures: one unit, one meaning, in the result, the files and on the way. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <math.h>

#include "files.h"
#include "fonts.h"
#include "vesica/run.h"

#define PI 3.14159265358979323846

#define TUBE                                                                                                 \
    "vesica: 1\nvariables: {r: [0.2, 0.5, 1.1], h: [0.2, 1, 4]}\n"                                           \
    "curves: {p: {circle: {radius: r}}, q: {like: p, apply: [{translate: [0, 0, h]}]}}\n"                    \
    "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"   \
    "minimize: area\n"

/* The area is pi times what is at least 2: least anywhere on a curve. Two tolerances of their own. */
#define WIDE                                                                                                 \
    TUBE "constraints: [{require: width*h >= 2, within: 0.01}, {require: width <= 1.5*h, within: 0.05}]\n"

typedef struct trial {
    ves_problem *problem;
    ves_run *run;
    ves_plan *plan; /* of the same grid */
    double least;   /* last told */
} trial;

static void progress(void *data, const ves_progress *p)
{
    trial *t = data;
    if (p->any) t->least = p->violation;
}

static trial *run_with(trial *t, const char *text, ves_run_options options)
{
    ves_run_hooks hooks = {.progress = progress, .data = t};
    *t = (trial){.least = NAN};
    cr_assert(ves_problem_read_text("test.yaml", text, strlen(text), NULL, &t->problem, NULL) == VES_OK);
    cr_assert(ves_run_create(t->problem, &options, &hooks, &t->run, NULL) == VES_OK);
    const ves_plan_options grid = {{t->run->quadrature[0], t->run->quadrature[1]}};
    cr_assert(ves_plan_create(t->problem, &grid, &t->plan, NULL) == VES_OK);
    return t;
}

static void finish(trial *t)
{
    ves_plan_destroy(t->plan);
    ves_run_destroy(t->run);
    ves_problem_destroy(t->problem);
}

static double violation_of(const trial *t, const double *x)
{
    ves_design design;
    cr_assert(ves_plan_measure(t->plan, x, 0, &design) == VES_OK);
    return design.violation;
}

/* Nine digits are written. */
static void same(double got, double want, const char *what)
{
    cr_expect(fabs(got - want) <= 1e-8 * fmax(fabs(want), 1e-7), "%s: %.10g, a design has %.10g", what, got,
              want);
}

static void remove_folder(const char *folder)
{
    char command[600];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    cr_assert(system(command) == 0);
}

Test(study_units, a_violation_is_that_of_a_design_everywhere)
{
    static const char *const text[] = {WIDE, TUBE "constraints: [{require: area >= 100, within: 0.02}]\n"};
    for (int k = 0; k < 2; k++)
        for (int jobs = 1; jobs <= 2; jobs++) {
            trial t;
            char path[600];
            size_t length;
            double most = 0;
            long lines = 0;
            const char *folder = path_of(k ? "never" : "wide");
            remove_folder(folder);
            run_with(
                &t, text[k],
                (ves_run_options){
                    .evaluations = 2000, .jobs = jobs, .files = true, .out = folder, .trace = VES_TRACE_ALL});
            cr_expect(t.run->feasible == !k && t.run->optima >= 1 - k);
            same(t.run->best.violation, violation_of(&t, t.run->best.x), "the best");
            if (k) /* the largest has an area of 8.8 pi */
                cr_expect(fabs(t.run->best.violation - (1 - 0.088 * PI)) < 1e-6, "%g", t.run->best.violation);
            if (k) same(t.least, t.run->best.violation, "progress");
            cr_expect(t.least <= (k ? 1 : 0.05), "%g", t.least);
            for (int o = 0; o < t.run->optima; o++)
                same(t.run->optimum[o].violation, violation_of(&t, t.run->optimum[o].x), "an optimum");
            snprintf(path, sizeof path, "%s/trace.jsonl", folder);
            char *trace = slurp_bytes(path, &length);
            for (char *line = strtok(trace, "\n"); line; line = strtok(NULL, "\n"), lines++) {
                double x[2], value, violation;
                cr_assert(sscanf(strstr(line, "\"x\":"), "\"x\":[%lf,%lf]", &x[0], &x[1]) == 2, "%s", line);
                const char *at = strstr(line, "\"value\":");
                if (sscanf(at, "\"value\":%lf,\"violation\":%lf", &value, &violation) != 2) continue;
                same(violation, violation_of(&t, x), "a line of the trace");
                most = fmax(most, violation);
            }
            cr_expect(lines == t.run->evaluations && most > 0.1, "%ld lines, most %g", lines, most);
            free(trace);
            remove_folder(folder);
            finish(&t);
        }
    clean();
}

/* The least area is 2 pi, on a curve: no end keeps what a tolerance of 1 % buys, which would be 6.2204. */
Test(study_units, a_wide_tolerance_is_not_used_up)
{
    for (uint64_t seed = 1; seed <= 5; seed++) {
        trial t;
        run_with(&t, WIDE "search: [{anneal: {evaluations: 4000}}, {polish: {}}]\n",
                 (ves_run_options){.jobs = 1, .seeded = true, .seed = seed});
        cr_expect(t.run->feasible && t.run->best.objective == t.run->optimum[0].value);
        for (int k = 0; k < t.run->optima; k++) /* a ten-thousandth of the tolerance is rounding */
            cr_expect(fabs(t.run->optimum[k].value / (2 * PI) - 1) < 1e-6, "%.9g", t.run->optimum[k].value);
        finish(&t);
    }
}

/* Candidates that were cut, and bests that were refused, had been measured. */
Test(study_units, what_was_cut_has_not_failed)
{
    trial t;
    run_with(&t, WIDE "search: [{anneal: {evaluations: 4000}}]\n", (ves_run_options){.jobs = 1});
    cr_expect(eq(int, t.run->failures, 0));
    finish(&t);
}

Test(study_units, files_name_a_failure_and_keep_every_seed)
{
    static const char text[] =
        "vesica: 1\nvariables: {r: [0.2, 1.4, 2]}\n"
        "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r - 0.5, centre: [0, 0, 1.5]}}}\n"
        "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
        "minimize: area\n";
    trial t;
    char path[600];
    size_t length;
    const char *folder = path_of("named");
    remove_folder(folder);
    run_with(
        &t, text,
        (ves_run_options){
            .evaluations = 500, .jobs = 1, .seeded = true, .seed = UINT64_MAX, .files = true, .out = folder});
    snprintf(path, sizeof path, "%s/result.json", folder);
    char *json = slurp_bytes(path, &length);
    cr_expect(strstr(json, "\"OUTSIDE\": ") != NULL);
    cr_expect(strstr(json, "\"seed\": 18446744073709551615") != NULL);
    cr_expect(strstr(json, "\"refused\": ") != NULL);
    free(json);
    remove_folder(folder);
    finish(&t);
    clean();
}
