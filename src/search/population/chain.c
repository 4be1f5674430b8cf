#include "search/population/population.h"

const ves_population ves_population_chain = {
    .name = "chain",
    .about = "one chain: the book's",
    .size = 1,
    .most = 1,
};
