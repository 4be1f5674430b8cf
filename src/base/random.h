/* Random numbers as counters: the value depends on (seed, chain, step, draw) alone, never on who asked
 * before or on which thread. Philox4x32-10 (Salmon et al., SC11) from Random123.
 * test  known answer for zero key and counter; moments */
#ifndef VES_BASE_RANDOM_H
#define VES_BASE_RANDOM_H

#include <stdint.h>

typedef struct ves_random {
    uint64_t seed;
    uint32_t chain;
    uint64_t step;
    uint32_t draw; /* counts the calls made at this step */
} ves_random;

void ves_random_words(uint64_t seed, uint32_t chain, uint64_t step, uint32_t draw, uint32_t word[4]);

/* Each call advances draw by one. uniform: in (0, 1), never 0 or 1. below: 0 .. n-1. */
double ves_random_uniform(ves_random *random);
double ves_random_normal(ves_random *random);
int ves_random_below(ves_random *random, int n);

/* n normal numbers at half the price: each draw makes two. */
void ves_random_normals(ves_random *random, int n, double *z);

/* Uniform numbers likewise; four of 32 bits by one draw. */
void ves_random_uniforms(ves_random *random, int n, double *u);
void ves_random_pair(ves_random *random, double u[2]);
void ves_random_four(ves_random *random, double u[4]);

/* Box and Muller: two normal numbers in the place of two uniform ones. */
void ves_random_turn(double *a, double *b);

#endif
