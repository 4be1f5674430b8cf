/* What CMA-ES costs besides the evaluations, for 5 to 40 variables: microseconds a candidate of asking and telling
 * an ellipsoid of 1e4, and microseconds of one decomposition, anew and followed. Prints JSON Lines: the least of
 * ROUNDS rounds, CPU time of this thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/eigen.h"
#include "search/cma.h"

enum { ROUNDS = 7, MOST = 40, POPULATION = 320 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void generations(ves_cma *cma, int count, double *spent)
{
    double value[POPULATION], u[MOST];
    int n = cma->n;
    for (int g = 0; g < count; g++) {
        for (int k = 0; k < cma->lambda; k++) {
            ves_cma_ask(cma, k, NULL, u);
            double sum = 0;
            for (int i = 0; i < n; i++) sum += (1 + 9999. * i / (n - 1)) * (u[i] - 0.4) * (u[i] - 0.4);
            value[k] = sum;
        }
        ves_cma_tell(cma, value);
        *spent += ves_cma_stopped(cma) == VES_CMA_FAILED;
    }
}

int main(void)
{
    static const int sizes[] = {5, 10, 20, 40};
    static double a[MOST * MOST], basis[MOST * MOST], axis[MOST], vector[MOST * MOST],
        scratch[2 * MOST * MOST];
    double mean[MOST], dummy = 0;
    for (int i = 0; i < MOST; i++) mean[i] = 0.5;
    for (int c = 0; c < 8; c++) {
        int n = sizes[c / 2], lambda = c % 2 ? POPULATION : ves_cma_population(n);
        ves_arena arena = {0};
        ves_cma cma;
        ves_cma_options options = ves_cma_default();
        double least = HUGE_VAL, fresh = HUGE_VAL, followed = HUGE_VAL;
        if (!ves_cma_create(&arena, n, POPULATION, &options, &cma)) return 1;
        for (int round = 0; round < ROUNDS; round++) {
            ves_cma_restart(&cma, mean, 0.2, lambda);
            generations(&cma, 3000 / lambda, &dummy);
            double from = now();
            generations(&cma, 9000 / lambda, &dummy);
            least = fmin(least, 1e6 * (now() - from) / (9000 / lambda * lambda));
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) a[i * n + j] = cma.covariance[i > j ? i * n + j : j * n + i];
            memcpy(basis, cma.basis, sizeof(double) * (size_t)(n * n));
            generations(&cma, (int)ceil(cma.rates.gap), &dummy);
            from = now();
            ves_eigen_follow(n, cma.covariance, basis, axis, scratch);
            followed = fmin(followed, 1e6 * (now() - from));
            from = now();
            ves_eigen_symmetric(n, a, axis, vector);
            fresh = fmin(fresh, 1e6 * (now() - from));
        }
        printf("{\"n\": %d, \"lambda\": %d, \"us a candidate\": %.2f, \"gap\": %.1f, \"us decomposed anew\": "
               "%.1f, "
               "\"us followed\": %.1f}\n",
               n, lambda, least, cma.rates.gap, fresh, followed);
        ves_arena_destroy(&arena);
    }
    return dummy > 0;
}
