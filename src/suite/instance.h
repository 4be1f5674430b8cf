/* An instance: a landscape with its optimum put somewhere else and, if wanted, its axes turned, seen from the
 * unit box. Instance k of one landscape and seed is the same for every search. */
#ifndef VES_SUITE_INSTANCE_H
#define VES_SUITE_INSTANCE_H

#include <stdint.h>

#include "base/arena.h"
#include "suite/landscape.h"

typedef struct ves_instance {
    const ves_landscape *landscape;
    int n, m;
    double optimum;              /* the least value */
    const bool *equality;        /* [m] */
    const double *lower, *width; /* [n] of the box */
    const double *place;         /* [n] of the optimum in the landscape's own coordinates; NAN: not told */
    const double *home;          /* [n] of the optimum in the box; NULL: not moved */
    const double *turn;          /* [n][n] orthogonal; NULL: not turned */
} ves_instance;

/* Instance `number` (0, 1, ...) of those that come from a seed. All memory is the arena's. VES_RANGE: n is not
 * for this landscape, or it cannot be turned. */
ves_status ves_instance_init(ves_arena *arena, const ves_landscape *landscape, int n, bool turned,
                             uint64_t seed, int number, ves_instance *instance);

/* u [n] in the unit box; derivatives are by u. room [2 n] is the caller's. */
ves_status ves_instance_eval(const ves_instance *instance, const double *u, bool slopes, ves_verdict *out,
                             double *room);

/* Where the optimum is, in the unit box; false: it is not told. */
bool ves_instance_best(const ves_instance *instance, double *u);

/* A point of the unit box, the same for every search: start `which` of a run with this seed. */
void ves_instance_start(uint64_t seed, int which, int n, double *u);

/* A number that two texts hardly share (FNV-1a). */
uint64_t ves_instance_hash(const char *text, uint64_t more);

#endif
