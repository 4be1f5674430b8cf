/* Facts about a problem that `check` tells: what its patches are made of. */
#ifndef VES_STUDY_FACTS_H
#define VES_STUDY_FACTS_H

#include "problem/problem.h"
#include "surface/figure.h"
#include "vesica/plan.h"

/* A PDE patch at the start design. */
typedef struct ves_patch_facts {
    int band;    /* modes in the data of its conditions */
    int modes;   /* of these solved one by one */
    double tail; /* share of the data (root of the sum of squares) beyond them, which the remainder carries */
} ves_patch_facts;

/* facts[patches]; zero for other kinds of patches. slot: of the start design. */
ves_status ves_study_facts(const ves_problem *problem, const double *slot, ves_patch_facts *facts);

#endif
