/* Polish: what the best run of a problem comes to when its constraints are met exactly. Where the optimum is not
 * known, gaps are measured from there: else the run that used up most of what constraints are allowed would set a
 * reference that no exact design can meet. */
#ifndef VES_STUDY_BENCH_POLISH_H
#define VES_STUDY_BENCH_POLISH_H

#include "study/testbed.h"

/* The least value that a descent from outcome->x finds with a thousandth of what constraints are allowed; NAN: none.
 * stopped may be NULL. */
ves_status ves_bench_polish(ves_testbed *testbed, const ves_suite *suite, const ves_outcome *outcome,
                            bool (*stopped)(void *), void *data, double *value);

#endif
