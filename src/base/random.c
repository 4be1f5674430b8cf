#include "base/random.h"

#include <Random123/philox.h>
#include <math.h>

#include "base/vector.h"

void ves_random_words(uint64_t seed, uint32_t chain, uint64_t step, uint32_t draw, uint32_t word[4])
{
    philox4x32_ctr_t counter = {{draw, chain, (uint32_t)step, (uint32_t)(step >> 32)}};
    philox4x32_key_t key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
    philox4x32_ctr_t out = philox4x32(counter, key);
    for (int k = 0; k < 4; k++) word[k] = out.v[k];
}

static double unit(uint32_t high, uint32_t low)
{
    uint64_t bits = ((uint64_t)high << 32 | low) >> 11; /* 53 bits */
    return ((double)bits + 0.5) * 0x1p-53;
}

double ves_random_uniform(ves_random *random)
{
    uint32_t word[4];
    ves_random_words(random->seed, random->chain, random->step, random->draw++, word);
    return unit(word[0], word[1]);
}

double ves_random_normal(ves_random *random)
{
    uint32_t word[4];
    ves_random_words(random->seed, random->chain, random->step, random->draw++, word);
    return sqrt(-2 * log(unit(word[0], word[1]))) * cos(VES_TWO_PI * unit(word[2], word[3]));
}

int ves_random_below(ves_random *random, int n)
{
    int k = (int)(ves_random_uniform(random) * n);
    return k < n ? k : n - 1; /* u * n may round up to n */
}

void ves_random_normals(ves_random *random, int n, double *z)
{
    uint32_t word[4];
    for (int i = 0; i < n; i += 2) {
        ves_random_words(random->seed, random->chain, random->step, random->draw++, word);
        double r = sqrt(-2 * log(unit(word[0], word[1]))), angle = VES_TWO_PI * unit(word[2], word[3]);
        z[i] = r * cos(angle);
        if (i + 1 < n) z[i + 1] = r * sin(angle);
    }
}

void ves_random_uniforms(ves_random *random, int n, double *u)
{
    uint32_t word[4];
    for (int i = 0; i < n; i += 2) {
        ves_random_words(random->seed, random->chain, random->step, random->draw++, word);
        u[i] = unit(word[0], word[1]);
        if (i + 1 < n) u[i + 1] = unit(word[2], word[3]);
    }
}

void ves_random_pair(ves_random *random, double u[2])
{
    ves_random_uniforms(random, 2, u);
}

void ves_random_four(ves_random *random, double u[4])
{
    uint32_t word[4];
    ves_random_words(random->seed, random->chain, random->step, random->draw++, word);
    for (int k = 0; k < 4; k++) u[k] = (word[k] + 0.5) * 0x1p-32;
}

void ves_random_turn(double *a, double *b)
{
    double radius = sqrt(-2 * log(*a)), angle = VES_TWO_PI * *b;
    *a = radius * cos(angle);
    *b = radius * sin(angle);
}
