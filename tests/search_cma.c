/* CMA-ES: what must not matter does not, and what is learned is right. */
#include "search_cma.h"

#include "base/eigen.h"

/* ---- what follows from n and lambda ---- */

/* sum ln((lambda + 1) / 2 i) = mu ln((lambda + 1) / 2) - ln mu!; mu_w and w_1 are what pycma prints for the default
 * populations of 2, 5, 10 and 20 variables. */
Test(cma, weights_are_those_of_the_tutorial)
{
    static const struct {
        int n, lambda;
        double mu_w, first;
    } want[] = {{2, 6, 2.0, 0.63}, {5, 8, 2.6, 0.52}, {10, 10, 3.2, 0.45}, {20, 12, 3.7, 0.40}};
    for (int c = 0; c < 4; c++) {
        int n = want[c].n, lambda = want[c].lambda, mu = lambda / 2;
        ves_cma cma = made(n, 1);
        cr_assert(eq(int, ves_cma_population(n), lambda));
        ves_cma_restart(&cma, middle, 0.3, lambda);
        double total = mu * log((lambda + 1) / 2.) - lgamma(mu + 1), positive = 0, negative = 0;
        for (int i = 0; i < lambda; i++) {
            double w = cma.weight[i];
            cr_expect(i == 0 || w < cma.weight[i - 1], "n %d: weight %d is %g", n, i, w);
            if (i < mu) cr_expect(fabs(w - log((lambda + 1) / (2. * (i + 1))) / total) < 1e-14);
            if (i < mu)
                positive += w;
            else
                negative -= w;
        }
        cr_expect(fabs(positive - 1) < 1e-14 && cma.rates.mu == mu);
        cr_expect(fabs(cma.rates.mu_eff - want[c].mu_w) < 0.05 && fabs(cma.weight[0] - want[c].first) < 0.01,
                  "n %d: mu_w %.3f, w_1 %.3f", n, cma.rates.mu_eff, cma.weight[0]);
        const ves_cma_rates *r = &cma.rates;
        double bound = fmin(1 + r->c_1 / r->c_mu, (1 - r->c_1 - r->c_mu) / (n * r->c_mu));
        cr_expect(negative > 0.3 && negative <= bound + 1e-14, "n %d: %g of %g", n, negative, bound);
        cr_expect(fabs(r->c_1 - 2 / ((n + 1.3) * (n + 1.3) + r->mu_eff)) < 1e-15);
        cr_expect(r->c_1 + r->c_mu < 1 && r->c_sigma < 1 && r->c_c < 1 && r->d_sigma >= 1);
        /* E |N(0, I)| for two variables is sqrt(pi / 2) */
        if (n == 2) cr_expect(fabs(r->normal - sqrt(PI / 2)) < 1e-14);
    }
}

/* ---- what must not matter ---- */

Test(cma, order_of_asking_does_not_matter_and_the_seed_does)
{
    double value[10], u[MOST], last[4][MOST];
    for (int c = 0; c < 4; c++) {
        ves_cma cma = made(6, c == 2 ? 8 : 7);
        cma.options.stream = c == 3;
        ves_cma_restart(&cma, middle, 0.2, 10);
        world w = world_of(6, ellipsoid, 0.4);
        for (int g = 0; g < 40; g++) {
            for (int k = 0; k < 10; k++) {
                int i = c == 1 ? 9 - k : k;
                ves_cma_ask(&cma, i, NULL, u);
                value[i] = at(&w, u);
            }
            ves_cma_tell(&cma, value);
        }
        memcpy(last[c], cma.mean, 6 * sizeof(double));
    }
    cr_expect(memcmp(last[0], last[1], 6 * sizeof(double)) == 0);
    cr_expect(memcmp(last[0], last[2], 6 * sizeof(double)) != 0);
    cr_expect(memcmp(last[0], last[3], 6 * sizeof(double)) != 0);
}

/* Only ranks steer: f^3 gives the same bits. 1 + f, so that f^3 is as different as f. */
static double one_more(const world *w, const double *x)
{
    return 1 + ellipsoid(w, x);
}

static double cubed(const world *w, const double *x)
{
    double f = one_more(w, x);
    return f * f * f;
}

Test(cma, a_growing_function_of_the_values_gives_the_same_bits)
{
    double (*const f[2])(const world *, const double *) = {one_more, cubed};
    static double raw[2][LARGEST * MOST];
    ves_cma cma[2] = {made(8, 3), made(8, 3)};
    for (int c = 0; c < 2; c++) ves_cma_restart(&cma[c], middle, 0.3, 14);
    for (int g = 0; g < 60; g++) {
        for (int c = 0; c < 2; c++) {
            world w = world_of(8, f[c], 0.15); /* near a wall, so that beyond is judged too */
            generation(&cma[c], &w, raw[c]);
        }
        cr_assert(memcmp(raw[0], raw[1], 14 * 8 * sizeof(double)) == 0, "generation %d", g);
    }
}

/* Far from the walls; a difference is rounding, 1e-16, grown by what steps are shorter than coordinates. */
Test(cma, a_moved_function_gives_a_moved_run)
{
    static double raw[2][LARGEST * MOST];
    ves_cma cma[2] = {made(7, 5), made(7, 5)};
    for (int c = 0; c < 2; c++) {
        double mean[MOST];
        for (int i = 0; i < 7; i++) mean[i] = 0.4 + 0.11 * c;
        ves_cma_restart(&cma[c], mean, 0.02, 9);
    }
    for (int g = 0; g < 80; g++) {
        for (int c = 0; c < 2; c++) {
            world w = world_of(7, ellipsoid, 0.43 + 0.11 * c);
            generation(&cma[c], &w, raw[c]);
        }
        for (int i = 0; i < 9 * 7; i++)
            cr_assert(fabs(raw[1][i] - raw[0][i] - 0.11) < 1e-12, "generation %d: %g", g,
                      raw[1][i] - raw[0][i] - 0.11);
    }
}

/* The same draws along turned axes: to begin with C = I, of which any orthonormal basis is one. */
Test(cma, a_turned_function_gives_a_turned_run)
{
    enum { N = 6 };
    static double raw[2][LARGEST * MOST];
    ves_cma cma[2] = {made(N, 4), made(N, 4)};
    world w[2] = {world_of(N, ellipsoid, 0.5), world_of(N, ellipsoid, 0.5)};
    double mean[2][MOST], off[N] = {0.03, -0.02, 0.01, 0.04, -0.03, 0.02}, worst = 0;
    turn(&w[1], 2);
    for (int i = 0; i < N; i++) {
        mean[0][i] = mean[1][i] = 0.5;
        mean[0][i] += off[i];
        for (int j = 0; j < N; j++) mean[1][i] += w[1].turn[i][j] * off[j];
    }
    for (int c = 0; c < 2; c++) ves_cma_restart(&cma[c], mean[c], 0.02, 9);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) cma[1].basis[j * N + i] = w[1].turn[i][j];
    for (int g = 0; g < 150; g++) {
        for (int c = 0; c < 2; c++) generation(&cma[c], &w[c], raw[c]);
        for (int k = 0; k < 9; k++)
            for (int i = 0; i < N; i++) {
                double want = 0.5;
                for (int j = 0; j < N; j++) want += w[1].turn[i][j] * (raw[0][k * N + j] - 0.5);
                worst = fmax(worst, fabs(raw[1][k * N + i] - want));
            }
    }
    double low = HUGE_VAL, high = 0;
    for (int i = 0; i < N; i++) low = fmin(low, cma[0].axis[i]), high = fmax(high, cma[0].axis[i]);
    cr_expect(high > 100 * low, "%g: nothing was learned", high / low);
    cr_expect(worst < 1e-11, "off by %g after 150 generations", worst);
}

/* ---- the walls ---- */

/* A mean in another cell of the reflected space and the same one folded ask for the same points of the box. */
Test(cma, folding_back_changes_no_candidate)
{
    enum { N = 5 };
    static const double cell[][N] = {
        {0, 0, 0, 0, 0}, {-1, 0, 1, 0, 0}, {1, -1, -2, 2, 3}, {-3, 4, -4, 5, -5}};
    for (int c = 0; c < 4; c++) {
        ves_cma cma = made(N, 6);
        world w = world_of(N, ellipsoid, 0.3);
        turn(&w, 3);
        ves_cma_restart(&cma, middle, 0.3, 8);
        for (int g = 0; g < 60; g++) generation(&cma, &w, NULL);
        double u[2][8][N], product = 0;
        cma.sigma = 0.4 / cma.axis[0];
        for (int i = 0; i < N; i++) cma.mean[i] += cell[c][i];
        for (int k = 0; k < 8; k++) ves_cma_ask(&cma, k, NULL, u[0][k]);
        ves_cma_fold(&cma);
        for (int k = 0; k < 8; k++) ves_cma_ask(&cma, k, NULL, u[1][k]);
        for (int k = 0; k < 8; k++)
            for (int i = 0; i < N; i++)
                cr_expect(fabs(u[1][k][i] - u[0][k][i]) < 1e-14, "cell %d: %g, want %g", c, u[1][k][i],
                          u[0][k][i]);
        for (int i = 0; i < N; i++) cr_expect(cma.mean[i] >= 0 && cma.mean[i] <= 1);
        /* C has turned with its axes: off the diagonal of basis C basis' is what laziness leaves */
        for (int i = 0; i < N; i++)
            for (int j = 0; j < i; j++) {
                double mixed = 0;
                for (int a = 0; a < N; a++)
                    for (int b = 0; b < N; b++)
                        mixed += cma.basis[i * N + a] * cma.basis[j * N + b] *
                                 cma.covariance[a > b ? a * N + b : b * N + a];
                product = fmax(product, fabs(mixed) / (cma.axis[i] * cma.axis[j]));
            }
        cr_expect(product < 2e-4, "cell %d: %g", c, product);
    }
}

static double plane(const world *w, const double *x)
{
    double sum = 0;
    for (int i = 0; i < w->n; i++) sum += (i + 1) * x[i];
    return sum;
}

Test(cma, a_minimum_in_a_corner_or_on_a_wall_is_found)
{
    for (int c = 0; c < 3; c++) {
        ves_cma cma = made(8, c);
        world w = world_of(8, c == 0 ? plane : sphere, 0);
        if (c == 2) w.center[3] = -0.4, w.center[5] = 0.7; /* the least is on three of the walls, or beyond */
        double want = c == 2 ? 0.16 : 0, least = HUGE_VAL;
        ves_cma_restart(&cma, middle, 0.3, 10);
        for (int g = 0; g < 700; g++) least = fmin(least, generation(&cma, &w, NULL));
        cr_expect(least - want < 1e-9, "case %d: %g above", c, least - want);
    }
}

/* ---- what is learned ---- */

static int by_size(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

static long evaluations_to(const world *w, double target, int seed)
{
    ves_cma cma = made(w->n, seed);
    ves_random random = {.seed = (uint64_t)seed, .chain = 3};
    double mean[MOST];
    for (int i = 0; i < w->n; i++) mean[i] = 0.3 + 0.4 * ves_random_uniform(&random);
    ves_cma_restart(&cma, mean, 0.2, ves_cma_population(w->n));
    long spent = 0;
    while (generation(&cma, w, NULL) > target && spent < 100000) spent += cma.lambda;
    return spent;
}

/* Evaluations to 1e-9, the median of 15 seeds. Sphere: no step size lets a strategy of these weights come nearer
 * by more than exp(0.25 / n) an evaluation for large n, and cumulative control gets a quarter to all of that;
 * from a distance of about 0.4 to 3e-5 these are the bounds. Ellipsoid: the eigenvalues of C part by 1e6 =
 * exp(13.8) at rates of about c_1 + c_mu a generation, 3.9k and 13.3k evaluations; half of it to one and a half
 * times. Rosenbrock: pycma's documentation shows a run in 8 variables that is at 2e-4 after 3000 evaluations and
 * at 1e-11 after 4000, and 8000 as enough in 10. */
Test(cma, converges_at_the_rates_that_are_known)
{
    static const struct {
        const char *name;
        int n;
        double (*f)(const world *, const double *);
        bool turned;
        int low, high;
    } want[] = {
        {"sphere", 10, sphere, false, 380, 1600},         {"sphere", 20, sphere, false, 760, 3200},
        {"ellipsoid", 10, ellipsoid, false, 1950, 5850},  {"ellipsoid", 10, ellipsoid, true, 1950, 5850},
        {"ellipsoid", 20, ellipsoid, true, 6650, 19950},  {"rosenbrock", 5, rosenbrock, false, 1200, 3500},
        {"rosenbrock", 8, rosenbrock, false, 2500, 5500}, {"rosenbrock", 10, rosenbrock, false, 4000, 8000},
    };
    for (size_t c = 0; c < sizeof want / sizeof *want; c++) {
        int spent[SEEDS];
        world w = world_of(want[c].n, want[c].f, 0.5);
        if (want[c].turned) turn(&w, 5);
        for (int seed = 0; seed < SEEDS; seed++) spent[seed] = (int)evaluations_to(&w, 1e-9, seed);
        qsort(spent, SEEDS, sizeof *spent, by_size);
        cr_log_info("%s %d: %d %d %d", want[c].name, want[c].n, spent[0], spent[SEEDS / 2], spent[SEEDS - 1]);
        cr_expect(spent[SEEDS / 2] >= want[c].low && spent[SEEDS / 2] <= want[c].high, "%s of %d: %d",
                  want[c].name, want[c].n, spent[SEEDS / 2]);
    }
}

/* C is the inverse Hessian times a number: the eigenvalues of H^(1/2) C H^(1/2) are all the same but for what one
 * C fluctuates by; so C is averaged over generations, each at trace 1. */
Test(cma, covariance_becomes_the_inverse_hessian)
{
    enum { N = 6, MEAN = 400 };
    world w = world_of(N, ellipsoid, 0.5);
    turn(&w, 8);
    ves_cma cma = made(N, 2);
    double sum[N * N] = {0}, a[N * N], value[N], vector[N * N];
    ves_cma_restart(&cma, middle, 0.1, 12);
    for (int g = 0; g < 400; g++) generation(&cma, &w, NULL);
    for (int g = 0; g < MEAN; g++) {
        if (g % 100 == 0) /* before rounding is felt: away from the minimum, C as it is */
            for (int i = 0; i < N; i++)
                cma.mean[i] = 0.5 + 1e-4 * (i % 2 ? 1 : -1), cma.sigma = 1e-4 / cma.axis[0];
        generation(&cma, &w, NULL);
        double trace = 0;
        for (int i = 0; i < N * N; i++) a[i] = 0;
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++) {
                for (int p = 0; p < N; p++)
                    for (int q = 0; q < N; q++)
                        a[i * N + j] +=
                            w.turn[p][i] * w.turn[q][j] * cma.covariance[p > q ? p * N + q : q * N + p];
                a[i * N + j] *= sqrt(scale_of(&w, i) * scale_of(&w, j));
                if (i == j) trace += a[i * N + j];
            }
        for (int i = 0; i < N * N; i++) sum[i] += a[i] / trace;
    }
    ves_eigen_symmetric(N, sum, value, vector);
    double low = value[0], high = value[0];
    for (int i = 1; i < N; i++) low = fmin(low, value[i]), high = fmax(high, value[i]);
    cr_log_info("spread of the eigenvalues of H C: %g", high / low);
    cr_expect(low > 0 && high < 2 * low, "%g where the Hessian has 1e6", high / low);
}

/* Followed from matrix to matrix: an orthonormal basis, and off the diagonal no more than was promised. */
Test(cma, eigenvectors_are_followed)
{
    enum { N = 20 };
    double c[N * N] = {0}, basis[N * N], value[N], fresh[N * N], sorted[N], vector[N * N], scratch[2 * N * N];
    ves_random random = {.seed = 21};
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) c[i * N + j] = basis[i * N + j] = i == j;
    for (int step = 0; step < 300; step++) {
        double y[N], worst = 0, trace = 0;
        for (int k = 0; k < 6; k++) {
            for (int i = 0; i < N; i++) y[i] = ves_random_normal(&random) * pow(10, -3. * i / N);
            for (int i = 0; i < N; i++)
                for (int j = 0; j <= i; j++) c[i * N + j] = 0.99 * c[i * N + j] + 0.01 * y[i] * y[j];
        }
        ves_eigen_follow(N, c, basis, value, scratch);
        for (int i = 0; i < N; i++)
            for (int j = 0; j <= i; j++) {
                double dot = -(i == j), mixed = 0;
                for (int a = 0; a < N; a++) {
                    dot += basis[i * N + a] * basis[j * N + a];
                    for (int b = 0; b < N; b++)
                        mixed += basis[i * N + a] * basis[j * N + b] * c[a > b ? a * N + b : b * N + a];
                }
                worst = fmax(worst, fabs(dot) / 1e-12);
                worst = fmax(worst, i == j ? fabs(mixed / value[i] - 1) / 1e-9
                                           : fabs(mixed) / sqrt(value[i] * value[j]) / 1.01e-4);
            }
        cr_assert(worst < 1, "step %d: %g of what is allowed", step, worst);
        if (step < 299) continue;
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++) fresh[i * N + j] = c[i > j ? i * N + j : j * N + i];
        ves_eigen_symmetric(N, fresh, sorted, vector);
        double product = 1;
        for (int i = 0; i < N; i++) {
            product *= value[i] / sorted[i];
            trace += value[i] - sorted[i];
        }
        /* of 20 values up to 1: rounding of 300 steps; the square of what is left off the diagonal */
        cr_expect(fabs(trace) < 1e-12 && fabs(product - 1) < 400 * 1e-8, "trace %g, determinant %g", trace,
                  product - 1);
    }
}
