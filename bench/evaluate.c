/* How fast one candidate is judged: one biharmonic patch, M = 6 modes, 16 x 32 nodes, six fields, area + flux
 * + bending, against the plain baseline of bench/plain in the same run. Prints JSON Lines: the least of
 * ROUNDS rounds, CPU time of this thread, and the ratio. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "measure/registry.h"
#include "plain/textbook.h"
#include "plan/inside.h"

enum { ROUNDS = 40, CALLS = 2000, PLAIN_CALLS = 50 };

#define PROBLEM(operator_keys)                                                                               \
    "vesica: 1\n"                                                                                            \
    "quadrature: {u: 16, v: 32}\n"                                                                           \
    "variables: {x: [-1, 0.1, 1], a: [0.1, 0.9, 5]}\n"                                                       \
    "curves:\n"                                                                                              \
    "  p:\n"                                                                                                 \
    "    fourier:\n"                                                                                         \
    "      mean: [0, 0, 0]\n"                                                                                \
    "      cos: [[1, 0, 0], [0.05, 0, 0.01], [0.02, 0.01, 0], [0.01, 0, 0], [0.004, 0, 0], [0.002, 0.001, "  \
    "0]]\n"                                                                                                  \
    "      sin: [[0, 1, 0], [0, 0.04, 0], [0, 0.02, 0.01], [0, 0.01, 0], [0, 0.003, 0], [0, 0.001, 0]]\n"    \
    "    apply: [{translate: [x, 0, 0]}]\n"                                                                  \
    "  q: {like: p, apply: [{dilate: [0.9, 1.1, 1]}, {translate: [0, 0, 2]}]}\n"                             \
    "  d: {like: p, apply: [{dilate: 0.3}, {translate: [0, 0, 1.5]}]}\n"                                     \
    "patches:\n"                                                                                             \
    "  wall:\n"                                                                                              \
    "    operator: {" operator_keys "}\n"                                                                    \
    "    conditions: [{u: 0, position: p}, {u: 0, derivative: 1, field: d}, {u: 1, position: q}, {u: 1, "    \
    "derivative: 1, field: d}]\n"                                                                            \
    "minimize: bending + area + flux\n"

/* The same surface by a table in double precision and, as the operator is general, in double-double. */
static const char FAST[] = PROBLEM("power: 2, a: a"), EXACT[] = PROBLEM("coefficients: [1, 2*a^2, a^4]");

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct bed {
    ves_plan *plan, *exact;
    double x[2], gradient[2];
    textbook book;
    double u[16], w[16], sum;
} bed;

static void ask(bed *b, unsigned want)
{
    ves_verdict verdict = {.gradient = b->gradient};
    ves_ask one = {.x = b->x, .cutoff = HUGE_VAL, .want = want};
    ves_plan_evaluate(b->plan, &one, &verdict);
    b->sum += verdict.value;
}

static void new_boundary(bed *b)
{
    b->x[0] += 1e-12;
    ask(b, VES_WANT_VALUE);
}

static void new_boundary_exact(bed *b)
{
    ves_plan *plan = b->plan;
    b->plan = b->exact;
    new_boundary(b);
    b->plan = plan;
}

static void new_a(bed *b)
{
    b->x[1] += 1e-12;
    ask(b, VES_WANT_VALUE);
}

static void with_gradient(bed *b)
{
    b->x[0] += 1e-12;
    ask(b, VES_WANT_GRADIENT);
}

static void bind(bed *b)
{
    b->x[0] += 1e-12;
    ves_plan_bind(b->plan, b->x, 0);
}

static void bind_solve(bed *b)
{
    bind(b);
    ves_chart_prepare(b->plan->level[0].site[0].chart, &b->plan->bound, false);
}

static void bind_solve_a(bed *b)
{
    b->x[1] += 1e-12;
    bind_solve(b);
}

static void bind_solve_sample(bed *b)
{
    bind(b);
    plan_site *s = &b->plan->level[0].site[0];
    ves_site_sample(b->plan, s, s->needs[PROGRAM_JUDGE], false);
}

static void plain(bed *b)
{
    double out[3];
    textbook_measure(&b->book, 16, b->u, b->w, 32, out);
    b->sum += out[0] + out[1] + out[2];
}

/* What is timed. Rounds go through all of it: a busy moment of the machine spoils one round, not one row. */
enum { PLAIN, BOUNDARY, EXACT_BOUNDARY, NEW_A, GRADIENT, BIND, SOLVE, SOLVE_A, SAMPLE, ROWS };
static const struct row {
    void (*work)(bed *);
    int calls;
} ROW[ROWS] = {[PLAIN] = {plain, PLAIN_CALLS},
               [BOUNDARY] = {new_boundary, CALLS},
               [EXACT_BOUNDARY] = {new_boundary_exact, CALLS},
               [NEW_A] = {new_a, CALLS},
               [GRADIENT] = {with_gradient, CALLS},
               [BIND] = {bind, CALLS},
               [SOLVE] = {bind_solve, CALLS},
               [SOLVE_A] = {bind_solve_a, CALLS},
               [SAMPLE] = {bind_solve_sample, CALLS}};

static void least_us(bed *b, double us[ROWS])
{
    for (int k = 0; k < ROWS; k++) us[k] = HUGE_VAL;
    for (int r = 0; r < ROUNDS; r++)
        for (int k = 0; k < ROWS; k++) {
            double t = now();
            for (int c = 0; c < ROW[k].calls; c++) ROW[k].work(b);
            us[k] = fmin(us[k], (now() - t) / ROW[k].calls * 1e6);
        }
}

static void report(const char *name, double us, double plain_us)
{
    printf("{\"name\": \"%s\", \"us\": %.3f, \"per_second\": %.0f, \"plain_over_this\": %.1f}\n", name, us,
           1e6 / us, plain_us / us);
}

static void report_all(const double us[ROWS])
{
    double base = us[PLAIN];
    report("plain: eqs 4.12-4.14 node by node", base, base);
    report("evaluate, new boundary", us[BOUNDARY], base);
    report("evaluate, new boundary, table in double-double", us[EXACT_BOUNDARY], base);
    report("evaluate, new a", us[NEW_A], base);
    report("evaluate with gradient", us[GRADIENT], base);
    report("stage: bind", us[BIND], base);
    report("stage: solve (new boundary)", us[SOLVE] - us[BIND], base);
    report("stage: solve (new a)", us[SOLVE_A] - us[BIND], base);
    report("stage: sample", us[SAMPLE] - us[SOLVE], base);
    report("stage: measure and judge", us[BOUNDARY] - us[SAMPLE], base);
    report("stage: gradient", us[GRADIENT] - us[BOUNDARY], base);
}

/* The same number both ways, or the comparison means nothing. */
static int agree(bed *b)
{
    const double *data[4];
    static const int order[4] = {0, 2, 1, 2}; /* p, d, q, d */
    double out[3];
    ves_design design;
    for (int j = 0; j < 4; j++) data[j] = ves_curves_coef(b->plan->curves, order[j]);
    textbook_solve(&b->book, b->x[1], data);
    textbook_measure(&b->book, 16, b->u, b->w, 32, out);
    ves_plan_measure(b->plan, b->x, 0, &design);
    double area = NAN, bending = NAN, volume = NAN;
    for (int k = 0; k < b->plan->problem->measures; k++) {
        if (!strcmp(b->plan->problem->measure[k].name, "area")) area = design.measure[k];
        if (!strcmp(b->plan->problem->measure[k].name, "bending")) bending = design.measure[k];
        if (!strcmp(b->plan->problem->measure[k].name, "flux")) volume = design.measure[k];
    }
    return fabs(area - out[0]) < 1e-10 * area && fabs(bending - out[2]) < 1e-10 * bending &&
           fabs(fabs(volume) - fabs(out[1])) < 1e-10 * area;
}

static bool plan_of(const char *text, const ves_measure *const *more, ves_problem **problem, ves_plan **plan)
{
    char message[2000];
    ves_diag *diag = ves_diag_create();
    ves_read_options options = {.plugin = more};
    bool good = !ves_problem_read_text("bench", text, strlen(text), &options, problem, diag) &&
                !ves_plan_create(*problem, NULL, plan, diag);
    if (!good) ves_diag_text(diag, 0, message, sizeof message), fprintf(stderr, "%s\n", message);
    ves_diag_destroy(diag);
    return good;
}

int main(void)
{
    static bed b;
    ves_measure flux =
        *ves_measure_find("volume", NULL); /* the volume's integral over the patch alone, without caps */
    flux.name = "flux", flux.closed = false, flux.cap = 0;
    const ves_measure *const more[] = {&flux, NULL};
    ves_problem *problem, *other;
    if (!plan_of(FAST, more, &problem, &b.plan) || !plan_of(EXACT, more, &other, &b.exact)) return 4;
    for (int k = 0; k < 2; k++) b.x[k] = problem->variable[k].start;
    ves_gauss_nodes(16, b.u, b.w);
    new_boundary(&b);
    if (!agree(&b)) {
        fprintf(stderr, "the baseline gives other numbers\n");
        return 4;
    }
    double us[ROWS];
    least_us(&b, us);
    report_all(us);
    ves_plan_destroy(b.plan);
    ves_plan_destroy(b.exact);
    ves_problem_destroy(problem);
    ves_problem_destroy(other);
    return b.sum == 0;
}
