#include "search/population/population.h"

/* Each explores by itself; only the best of them counts. */

const ves_population ves_population_chains = {
    .name = "chains",
    .about = "independent chains",
    .size = 4,
};
