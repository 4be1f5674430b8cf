/* Landscapes: functions to be minimised whose optimum is known, to compare searches on. One file each in
 * landscape/, with exact gradients. */
#ifndef VES_SUITE_LANDSCAPE_H
#define VES_SUITE_LANDSCAPE_H

#include "vesica/verdict.h"

enum { VES_LANDSCAPE_MOST = 200 }; /* variables, where any number will do */

typedef struct ves_landscape {
    const char *name, *about;
    int least, most;              /* variables; most 0: VES_LANDSCAPE_MOST */
    int step;                     /* their number is a multiple of this; 0: 1 */
    double lower, upper;          /* of every variable; where `bounds` is NULL */
    const double (*bounds)[2];    /* [n] of each variable its own */
    int inequalities, equalities; /* constraints: first those <= 0, then those == 0 */
    bool free; /* defined everywhere, so that the optimum may be moved and the axes turned */

    /* The least value, exact constraints understood, and one place where it is attained (NAN: not told). */
    double (*optimum)(int n, double *x);

    /* out->value and out->constraint, and, when slopes, out->gradient and out->jacobian [m][n]. A constraint
     * is divided by its size, so that 1e-6 is little of each. Positive: there is no value at x. */
    ves_status (*eval)(int n, const double *x, bool slopes, ves_verdict *out);
} ves_landscape;

const ves_landscape *const *ves_landscapes(void);          /* NULL-terminated, by name */
const ves_landscape *ves_landscape_find(const char *name); /* NULL: there is none */

/* May it have n variables? */
bool ves_landscape_takes(const ves_landscape *landscape, int n);

#endif
