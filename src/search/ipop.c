#include "search/ipop.h"

#include <math.h>

#include "base/random.h"
#include "search/cma.h"

/* BIPOP as in Hansen, "Benchmarking a BI-population CMA-ES on the BBOB-2009 function testbed", section 2:
 *     lambda_s = lambda_0 (lambda_l / (2 lambda_0))^(U^2),  sigma_s = sigma_0 10^(-2 U'),
 * at most half of the evaluations of the last large run.
 *
 * Defaults: of the twelve functions of bench/restarts.c in 5 and 10 variables, 30 seeds each, IPOP solved 355 and
 * 337 of 360, BIPOP 336 and 301; growth by 1.5 355 and 328, by 3 347 and 333; steps of 0.2 349 and 337, of 0.5
 * 356 and 343; twice the first population 355 and 348, but in 20 variables (15 seeds) 143 of 180 instead of 155.
 */

ves_ipop_options ves_ipop_default(int n)
{
    return (ves_ipop_options){.first = ves_cma_population(n), .most = 1 << 12, .growth = 2, .sigma = 0.3};
}

void ves_ipop_init(ves_ipop *ipop, int n, const ves_ipop_options *options)
{
    *ipop = (ves_ipop){.options = *options, .n = n};
}

static int grown(const ves_ipop *ipop)
{
    const ves_ipop_options *o = &ipop->options;
    double lambda = o->first * pow(o->growth, ipop->doubled);
    return lambda < o->most ? (int)lambda : o->most;
}

void ves_ipop_next(ves_ipop *ipop, long spent, ves_ipop_run *run, double *mean)
{
    const ves_ipop_options *o = &ipop->options;
    ves_random random = {.seed = o->seed, .chain = o->stream, .step = (uint64_t)ipop->runs};
    if (ipop->runs > 1) ipop->spent[ipop->small] += spent;
    if (ipop->runs > 0 && !ipop->small) ipop->last = spent;
    for (int i = 0; i < ipop->n; i++) mean[i] = ves_random_uniform(&random);
    ipop->small = o->two && ipop->runs > 1 && ipop->spent[1] < ipop->spent[0];
    if (ipop->runs > 0 && !ipop->small) ipop->doubled++;
    *run = (ves_ipop_run){.lambda = grown(ipop), .sigma = o->sigma};
    ipop->runs++;
    if (!ipop->small) return;
    double u = ves_random_uniform(&random), ratio = fmax(1, run->lambda / (2. * o->first));
    run->lambda = (int)(o->first * pow(ratio, u * u));
    run->sigma = o->sigma * pow(10, -2 * ves_random_uniform(&random));
    run->limit = ipop->last / 2;
}
