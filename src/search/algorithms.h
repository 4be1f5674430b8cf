/* The NLopt algorithms that a polish may name, and what each needs around it. */
#ifndef VES_SEARCH_ALGORITHMS_H
#define VES_SEARCH_ALGORITHMS_H

#include <nlopt.h>
#include <stdbool.h>

/* How one search problem is put to NLopt. */
typedef struct ves_recipe {
    const char *name;
    nlopt_algorithm id;
    bool gradient;
    bool dual;                     /* each candidate comes from a dual problem that NLopt solves by itself */
    bool inequalities, equalities; /* go into an augmented Lagrangian: the algorithm does not take them */
} ves_recipe;

/* The recipe for a known name on a problem with this many variables. */
ves_recipe ves_recipe_find(const char *name, int n, bool gradients);

/* A sentence for what NLopt returned; never NULL. */
const char *ves_recipe_sentence(nlopt_result code);

#endif
