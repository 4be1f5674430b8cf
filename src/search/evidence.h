/* Evidence: what the ends of descents that know nothing of each other tell of minima that none of them has seen,
 * and the verdict on the best. */
#ifndef VES_SEARCH_EVIDENCE_H
#define VES_SEARCH_EVIDENCE_H

#include "search/session.h"

/* The verdict on the first of the optima; hits: independent descents to it; merged: how many ends of such that
 * were counted as distinct turned out to be one optimum with another. */
typedef struct ves_witness {
    bool feasible, refused; /* there is a best; better ones were refused by their proofs */
    ves_halt halt;          /* what is known of it as an end, and of the slope there; NAN: nothing */
    double residual;
    long hits, merged;
} ves_witness;
ves_evidence ves_evidence_judge(ves_session *session, const ves_witness *witness);

#endif
