/* CMA-ES: candidates that fail, every way a run ends, and what comes after it. */
#include "search_cma.h"

#include "search/ipop.h"

/* ---- candidates that cannot be measured ---- */

Test(cma, a_generation_that_fails_changes_nothing)
{
    double value[10], u[MOST], c[36];
    for (int bad = 0; bad < 2; bad++) {
        ves_cma cma = made(6, 7);
        world w = world_of(6, ellipsoid, 0.4);
        ves_cma_restart(&cma, middle, 0.2, 10);
        for (int g = 0; g < 9; g++) generation(&cma, &w, NULL);
        double mean = cma.mean[2], sigma = cma.sigma;
        memcpy(c, cma.covariance, sizeof c);
        for (int g = 0; g < 10; g++) {
            cr_expect(eq(int, ves_cma_stopped(&cma), VES_CMA_RUNNING));
            for (int k = 0; k < 10; k++) {
                ves_cma_ask(&cma, k, NULL, u);
                value[k] = bad ? NAN : HUGE_VAL;
            }
            ves_cma_tell(&cma, value);
        }
        cr_expect(cma.mean[2] == mean && cma.sigma == sigma && memcmp(c, cma.covariance, sizeof c) == 0);
        cr_expect(eq(int, ves_cma_stopped(&cma), VES_CMA_FAILED));
        generation(&cma, &w, NULL);
        cr_expect(eq(int, ves_cma_stopped(&cma), VES_CMA_RUNNING));
    }
}

/* The ellipsoid beyond x_0 + x_1 >= 1.1 only, of which the minimum is not part: along the bound it is found. */
static double halved(const world *w, const double *x)
{
    return x[0] + x[1] + 2 * w->center[0] < 1.1 ? HUGE_VAL : sphere(w, x);
}

Test(cma, candidates_that_fail_do_no_harm)
{
    for (int lambda = 8; lambda <= 40; lambda += 16)
        for (int seed = 0; seed < 5; seed++) {
            ves_cma cma = made(6, seed);
            world w = world_of(6, halved, 0.5);
            double least = HUGE_VAL, want = 0.05 * 0.05 * 2;
            ves_cma_restart(&cma, middle, 0.3, lambda);
            for (int g = 0; g < 16000 / lambda; g++) least = fmin(least, generation(&cma, &w, NULL));
            cr_expect(least - want < 1e-3 * want, "lambda %d seed %d: %g above %g", lambda, seed,
                      least - want, want);
        }
    /* only one of a generation, again and again: nothing breaks */
    ves_cma cma = made(6, 3);
    ves_cma_restart(&cma, middle, 0.3, 10);
    double value[10], u[MOST];
    for (int g = 0; g < 2000 && cma.sigma < 1e3 && cma.sigma > 1e-9; g++) {
        for (int k = 0; k < 10; k++) {
            ves_cma_ask(&cma, k, NULL, u);
            value[k] = k == g % 10 ? u[0] : k % 2 ? HUGE_VAL : NAN;
        }
        ves_cma_tell(&cma, value);
        for (int i = 0; i < 6; i++) cr_assert(cma.mean[i] >= 0 && cma.mean[i] <= 1 && cma.sigma > 0);
    }
}

/* ---- ends ---- */

static double flat(const world *w, const double *x)
{
    (void)w, (void)x;
    return 3;
}

static double needle(const world *w, const double *x)
{
    double sum = 0;
    for (int i = 0; i < w->n; i++) sum += (i ? 1e18 : 1) * x[i] * x[i];
    return sum;
}

static double noise(const world *w, const double *x)
{
    uint32_t word[4];
    uint64_t seed;
    (void)w;
    memcpy(&seed, x, sizeof seed);
    ves_random_words(seed, 0, 0, 0, word);
    return word[0] * 0x1p-32;
}

static double rastrigin(const world *w, const double *x)
{
    double sum = 0;
    for (int i = 0; i < w->n; i++) sum += 100 * x[i] * x[i] + 10 * (1 - cos(20 * PI * x[i]));
    return sum;
}

static ves_cma_stop end_of(ves_cma *cma, const world *w, int generations)
{
    ves_cma_stop stop = VES_CMA_RUNNING;
    for (int g = 0; g < generations && !stop; g++) {
        generation(cma, w, NULL);
        stop = ves_cma_stopped(cma);
    }
    return stop;
}

Test(cma, every_end_is_reached)
{
    static const struct {
        ves_cma_stop stop;
        double (*f)(const world *, const double *);
        double tol_x, tol_fun, rival, center;
    } want[] = {
        {VES_CMA_TOL_X, sphere, 1e-3, 0, HUGE_VAL, 0.5},
        {VES_CMA_TOL_FUN, sphere, 0, 1e-9, HUGE_VAL, 0.5},
        {VES_CMA_TOL_UP, flat, 0, 0, HUGE_VAL, 0.5},
        {VES_CMA_NO_AXIS, sphere, 0, -1, HUGE_VAL, 0.5},
        {VES_CMA_CONDITION, needle, 0, 0, HUGE_VAL, 0.5},
        {VES_CMA_STAGNATION, noise, 0, 0, HUGE_VAL, 0.5},
        {VES_CMA_HOPELESS, rastrigin, 0, 0, -50, 0.5},
        {VES_CMA_RUNNING, rastrigin, 0, 0, HUGE_VAL, 0.5},
        {VES_CMA_NO_COORDINATE, sphere, 0, -1, HUGE_VAL, 0},
    };
    for (size_t c = 0; c < sizeof want / sizeof *want; c++) {
        ves_cma cma = made(5, 11);
        cma.options.tol_x = want[c].tol_x;
        cma.options.tol_fun = want[c].tol_fun;
        world w = world_of(5, want[c].f, want[c].center);
        w.center[1] = 0.5; /* where the others are 0 it alone loses its digits */
        ves_cma_restart(&cma, middle, 0.3, 8);
        cma.rival = want[c].rival;
        ves_cma_stop stop = end_of(&cma, &w, want[c].stop ? 20000 : 30);
        cr_expect(stop == want[c].stop, "case %zu: \"%s\", want \"%s\" (age %ld, sigma %g)", c,
                  ves_cma_stop_text(stop), ves_cma_stop_text(want[c].stop), cma.age, cma.sigma);
    }
}

/* Neither end comes while a plateau is crossed or a valley followed. */
Test(cma, no_end_before_the_minimum)
{
    for (int seed = 0; seed < SEEDS; seed++) {
        ves_cma cma = made(10, seed);
        world w = world_of(10, ellipsoid, 0.45);
        turn(&w, seed);
        ves_cma_restart(&cma, middle, 0.3, 10);
        ves_cma_stop stop = end_of(&cma, &w, 20000);
        cr_expect(cma.least < 1e-8, "seed %d: %g, %s", seed, cma.least, ves_cma_stop_text(stop));
    }
}

Test(cma, the_smallest_sizes_work)
{
    static const int n[] = {1, 1, 1, 2, 3}, lambda[] = {2, 3, 5, 3, 4};
    for (int c = 0; c < 5; c++) {
        ves_cma cma = made(n[c], 1);
        world w = world_of(n[c], sphere, 0.37);
        double least = HUGE_VAL;
        ves_cma_restart(&cma, middle, 0.2, lambda[c]);
        for (int g = 0; g < 600; g++) least = fmin(least, generation(&cma, &w, NULL));
        cr_expect(least < 1e-9, "n %d, lambda %d: %g", n[c], lambda[c], least);
    }
}

/* ---- restarts ---- */

Test(ipop, populations_double_and_starts_fill_the_box)
{
    ves_ipop ipop;
    ves_ipop_options o = ves_ipop_default(10);
    ves_ipop_run run;
    double mean[10], low = 1, high = 0, sum = 0;
    o.most = 200;
    ves_ipop_init(&ipop, 10, &o);
    for (int r = 0; r < 400; r++) {
        ves_ipop_next(&ipop, r ? 1000 : 0, &run, mean);
        int want = r < 5 ? 10 << r : 200;
        cr_expect(run.lambda == want && run.sigma == o.sigma && run.limit == 0, "run %d: %d", r, run.lambda);
        for (int i = 0; i < 10; i++) {
            low = fmin(low, mean[i]);
            high = fmax(high, mean[i]);
            sum += mean[i];
        }
    }
    /* 4000 uniform numbers: the mean within four standard errors, 0.29 / sqrt 4000 each */
    cr_expect(low > 0 && low < 0.01 && high > 0.99 && high < 1 && fabs(sum / 4000 - 0.5) < 0.0183);
}

Test(ipop, two_regimes_share_what_is_spent)
{
    ves_ipop ipop, again;
    ves_ipop_options o = ves_ipop_default(10);
    ves_ipop_run run, twin;
    double mean[10], other[10];
    long spent = 0, by[2] = {0, 0}, large = 0;
    int small = 0, doubled = 10;
    o.two = true;
    o.most = 1000;
    o.seed = 5;
    ves_ipop_init(&ipop, 10, &o);
    ves_ipop_init(&again, 10, &o);
    for (int r = 0; r < 300; r++) {
        ves_ipop_next(&ipop, spent, &run, mean);
        ves_ipop_next(&again, spent, &twin, other);
        cr_expect(memcmp(mean, other, sizeof mean) == 0 && run.lambda == twin.lambda &&
                  run.sigma == twin.sigma);
        bool is_small = run.limit > 0;
        spent = is_small ? (run.limit < 30 * run.lambda ? run.limit : 30 * run.lambda) : 50 * run.lambda;
        if (r > 0) cr_expect(is_small == (r > 1 && by[1] < by[0]), "run %d", r);
        if (r > 0) by[is_small] += spent;
        if (is_small) {
            small++;
            cr_expect(run.lambda >= 10 && run.lambda <= doubled / 2 && run.limit == large / 2, "run %d: %d",
                      r, run.lambda);
            cr_expect(run.sigma <= o.sigma && run.sigma >= 0.0099 * o.sigma);
            continue;
        }
        if (r > 0) doubled = doubled * 2 < 1000 ? doubled * 2 : 1000;
        large = spent;
        cr_expect(run.lambda == doubled && run.sigma == o.sigma, "run %d: %d, want %d", r, run.lambda,
                  doubled);
    }
    cr_expect(small > 50 && by[1] <= by[0] + 50000 && by[1] >= by[0] - 50000, "%d: %ld and %ld", small, by[0],
              by[1]);
}

Test(ipop, normal_numbers_by_the_pair_are_normal)
{
    enum { COUNT = 200001 };
    static double z[COUNT];
    ves_random random = {.seed = 9};
    double sum = 0, square = 0, fourth = 0, next = 0;
    ves_random_normals(&random, COUNT, z);
    for (int i = 0; i < COUNT; i++) {
        sum += z[i] / COUNT;
        square += z[i] * z[i] / COUNT;
        fourth += z[i] * z[i] * z[i] * z[i] / COUNT;
        if (i) next += z[i] * z[i - 1] / COUNT;
    }
    double error = 4 / sqrt(COUNT); /* four standard errors: 1, sqrt 2, sqrt 96, 1 */
    cr_expect(fabs(sum) < error && fabs(square - 1) < sqrt(2) * error &&
                  fabs(fourth - 3) < sqrt(96) * error && fabs(next) < error,
              "%g %g %g %g", sum, square, fourth, next);
}
