/* Vesicles: what problems/vesicle finds against the exact least of all axisymmetric shapes of each family. */
#include "vesicle_exact.h"

#include "problem/problem.h"
#include "vesica/run.h"

TestSuite(vesicle, .timeout = 200);

/* A first shape of an inner and an outer sphere whose rims are joined by a half torus; psi turns by -turn inside, by pi
 * round the rim, and by turn outside. */
static void stomatocyte_begin(double *b)
{
    const double turn = 2.44, length[3] = {0.55 * turn, 0.1 * EX_PI, 0.78 * turn};
    const double whole = length[0] + length[1] + length[2], s1 = length[0] / whole,
                 s2 = s1 + length[1] / whole;
    enum { POINTS = 4000 };
    for (int k = 0; k < EX_MODES; k++) {
        double sum = 0;
        for (int n = 0; n < POINTS; n++) {
            double s = (n + 0.5) / POINTS;
            double psi = s < s1   ? -turn * s / s1
                         : s < s2 ? -turn + EX_PI * (s - s1) / (s2 - s1)
                                  : EX_PI - turn + turn * (s - s2) / (1 - s2);
            sum += 2 * (psi - EX_PI * s) * sin((k + 1) * EX_PI * s) / POINTS;
        }
        b[k] = sum * exp(-pow((k + 1) / 25., 2));
    }
}

static void oblate_begin(double *b)
{
    b[1] = -0.6;
}

static void prolate_begin(double *b)
{
    b[1] = 0.35;
}

typedef struct family {
    const char *file;
    void (*begin)(double *b);
    int modes;        /* so many resolve it */
    double c0, nu;    /* as the file has them */
    double energy, M; /* as it expects them; an energy is unsure by less than its last digit */
} family;

static const family FAMILIES[] = {{"discocyte", oblate_begin, 60, 0, 0.6, 1.95568027, 1.037979},
                                  {"prolate", prolate_begin, 60, 0, 0.8, 1.38744043, 1.126711},
                                  {"stomatocyte", stomatocyte_begin, 120, 0, 0.55, 1.98383423, 0.441852},
                                  {"dumbbell", prolate_begin, 60, 3, 0.762, 0.22325963, 1.168113}};

Test(vesicle, the_numbers_in_the_files_are_exact)
{
    for (size_t k = 0; k < sizeof FAMILIES / sizeof *FAMILIES; k++) {
        const family *f = &FAMILIES[k];
        double b[EX_MODES] = {0};
        f->begin(b);
        exact *e = exact_create(f->modes, f->c0, f->nu);
        exact_solve(e, b);
        cr_expect(fabs(e->energy - f->energy) < 2e-8, "%s: %.9f, want %.9f", f->file, e->energy, f->energy);
        cr_expect(e->tail < 1e-5, "%s: not resolved, %g", f->file, e->tail);
        cr_expect(fabs(e->M - f->M) < 2e-6, "%s: M %.7f, want %.7f", f->file, e->M, f->M);
        free(e);
    }
}

/* The file with another nu, as `vesica run FILE --set nu=...` has it. */
static ves_run *run_file(const char *file, double nu, ves_problem **problem)
{
    char path[200], value[32];
    ves_run *run = NULL;
    snprintf(path, sizeof path, "%s/problems/vesicle/%s.yaml", VESICA_SOURCE, file);
    snprintf(value, sizeof value, "%g", nu);
    const ves_override set = {"nu", value};
    const ves_read_options options = {.overrides = 1, .override = &set};
    cr_assert(ves_problem_read(path, &options, problem, NULL) == VES_OK, "%s", path);
    cr_assert(ves_run_create(*problem, NULL, NULL, &run, NULL) == VES_OK);
    cr_assert(run->any && run->feasible, "%s at %g: not feasible", file, nu);
    return run;
}

static double slot(const ves_run *run, const char *name)
{
    for (int k = 0; k < run->problem->variables; k++)
        if (!strcmp(run->problem->variable[k].name, name)) return run->best.x[k] * run->best.similarity;
    cr_assert_fail("no %s", name);
    return NAN;
}

/* A walk of the oracle beside the file; each nu from the exact shape before. part: what a surface of these patches may
 * have more; shape: of its thickness. */
static void compare(const family *f, const double *nu, int count, double part, double shape)
{
    double b[EX_MODES] = {0};
    f->begin(b);
    for (int k = 0; k < count; k++) {
        ves_problem *problem = NULL;
        exact *e = exact_create(f->modes, f->c0, nu[k]);
        exact_solve(e, b);
        ves_run *run = run_file(f->file, nu[k], &problem);
        double excess = run->best.objective / e->energy - 1, thick = fabs(slot(run, "zn") - slot(run, "zs"));
        cr_expect(excess <= part, "%s at %g: %.7f, exactly %.7f: %.4f %% more", f->file, nu[k],
                  run->best.objective, e->energy, 100 * excess);
        cr_expect(run->best.objective > e->energy - 1e-6, "%s at %g: %.9f is less than the least, %.9f",
                  f->file, nu[k], run->best.objective, e->energy);
        cr_expect(fabs(thick / fabs(e->thickness) - 1) < shape,
                  "%s at %g: %.6f from pole to pole, exactly %.6f", f->file, nu[k], thick, e->thickness);
        ves_run_destroy(run);
        ves_problem_destroy(problem);
        free(e);
    }
}

Test(vesicle, discocytes)
{
    compare(&FAMILIES[0], (double[]){0.99, 0.95, 0.9, 0.8, 0.7, 0.65, 0.6, 0.57, 0.55}, 9, 1e-4, 2e-3);
}

Test(vesicle, prolates)
{
    compare(&FAMILIES[1], (double[]){0.99, 0.95, 0.9, 0.8, 0.7, 0.65, 0.6, 0.55}, 8, 1e-4, 2e-3);
}

Test(vesicle, stomatocytes)
{
    compare(&FAMILIES[2], (double[]){0.55, 0.58, 0.62, 0.65}, 4, 5e-4, 2e-2);
}

/* In um and J: E is 8 pi kappa times that of the same reduced volume, whatever the size. */
Test(vesicle, a_red_cell_in_its_units)
{
    enum { SIZES = 3 };
    static const char *const set[SIZES][3] = {{"135 um^2", "94 um^3", "2e-19 J"},
                                              {"540 um^2", "752 um^3", "2e-19 J"},
                                              {"135 mm^2", "94 mm^3", "3 J"}};
    static const double kappa[SIZES] = {2e-19, 2e-19, 3}, size[SIZES] = {1e-6, 2e-6, 1e-3};
    double b[EX_MODES] = {0};
    oblate_begin(b);
    exact *e = exact_create(60, 0, 94 * 6 * sqrt(EX_PI) / pow(135, 1.5));
    exact_solve(e, b);
    cr_expect(fabs(e->energy - 1.85886309) < 2e-8, "%.9f", e->energy);
    for (int k = 0; k < SIZES; k++) {
        ves_problem *problem = NULL;
        ves_run *run = NULL;
        const ves_override with[3] = {{"A", set[k][0]}, {"V", set[k][1]}, {"kappa", set[k][2]}};
        const ves_read_options options = {.overrides = 3, .override = with};
        cr_assert(ves_problem_read(VESICA_SOURCE "/problems/vesicle/red-cell.yaml", &options, &problem,
                                   NULL) == VES_OK);
        cr_assert(ves_run_create(problem, NULL, NULL, &run, NULL) == VES_OK);
        cr_assert(run->any && run->feasible);
        double reduced = run->best.objective / (8 * EX_PI * kappa[k]);
        cr_expect(reduced > e->energy * (1 - 1e-6) && reduced < e->energy * (1 + 1e-5),
                  "%s: %.8f, exactly %.8f", set[k][0], reduced, e->energy);
        double thick = fabs(slot(run, "zn") - slot(run, "zs")),
               want = fabs(e->thickness) * sqrt(135 / (4 * EX_PI)) * size[k];
        cr_expect(fabs(thick / want - 1) < 2e-3, "%s: %g thick, exactly %g", set[k][0], thick, want);
        ves_run_destroy(run);
        ves_problem_destroy(problem);
    }
    free(e);
}
