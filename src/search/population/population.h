/* Populations: how many chains there are, at which temperatures, and what they do when they meet at the end of a
 * round. One file each; the file's name is the descriptor's, and the word in problem files. The size never depends
 * on the number of threads. */
#ifndef VES_SEARCH_POPULATION_H
#define VES_SEARCH_POPULATION_H

#include "search/chain.h"

/* Exchanges of neighbours: tried, done. */
typedef struct ves_swaps {
    long tried, done;
} ves_swaps;

typedef struct ves_population {
    const char *name, *about;
    int size; /* unless given */
    int most; /* 0: any */
    /* The temperature of chain k when the schedule says c; most: no hotter than this. NULL: c. */
    double (*temperature)(int k, int n, double c, double most);
    /* A round is over. c[k]: the chains' temperatures, rising. One more call each time. swaps[k]: of k and k + 1.
     * Called in the main thread. NULL: nothing. */
    void (*meet)(ves_chain *chain, int count, const double *c, ves_random *random, ves_swaps *swaps);
} ves_population;

#endif
