#include <math.h>

#include "search/population/population.h"

/* Parallel tempering (Swendsen and Wang 1986; Geyer 1991): chain 0 at the temperature of the schedule, each
 * further one hotter by the same factor, none hotter than the schedule began unless it samples. Energies at
 * neighbouring temperatures of n harmonic degrees of freedom overlap when that factor is about e^{1.7 / sqrt n}:
 * a quarter to a half of the exchanges are then done. At the end of a round neighbours exchange where they are,
 *     with probability min(1, e^{(1/c_i - 1/c_j) (E_i - E_j)}),
 * by turns the even and the odd pairs: each turn leaves the joint distribution as it is.
 * test  mean energies of all replicas in a quadratic well; populations of a double well that chain 0 alone would
 *       not leave; flows of exchanges between states balance */

static const double spacing = 1.7;

static double temperature(int k, int n, double c, double most)
{
    double hot = c * exp(k * spacing / sqrt(n));
    return hot < most ? hot : most > c ? most : c;
}

static void meet(ves_chain *chain, int count, const double *c, ves_random *random, ves_swaps *swaps)
{
    random->draw = 0;
    for (int k = (int)(random->step % 2); k + 1 < count; k += 2) {
        ves_chain *cold = &chain[k], *hot = &chain[k + 1];
        double gain = (1 / c[k] - 1 / c[k + 1]) * (cold->energy - hot->energy);
        bool done = log(ves_random_uniform(random)) < gain;
        swaps[k].tried++;
        swaps[k].done += done;
        if (done) ves_chain_exchange(cold, hot);
    }
    random->step++;
}

const ves_population ves_population_tempering = {
    .name = "tempering",
    .about = "replicas on a ladder of temperatures, which exchange places",
    .size = 8,
    .temperature = temperature,
    .meet = meet,
};
