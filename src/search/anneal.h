/* An annealing that can be paused: it goes on by rounds, in which each of its chains makes some trials. */
#ifndef VES_SEARCH_ANNEAL_H
#define VES_SEARCH_ANNEAL_H

#include "search/slots.h"

typedef enum ves_annealing_phase {
    VES_ANNEALING_WARM,
    VES_ANNEALING_COOL,
    VES_ANNEALING_OVER
} ves_annealing_phase;

/* Energies that one chain has seen: how many, their mean, the sum of squared deviations from it. */
typedef struct ves_sample {
    long trials;
    double mean, square;
} ves_sample;

/* Everything about it; anneal.c, legs.c, warm.c and health.c write in it. */
typedef struct ves_annealing {
    ves_session *session;
    ves_anneal options; /* completed */
    const ves_schedule *schedule;
    const ves_population *population;
    int index; /* among those of the search */
    ves_annealing_phase phase;
    const ves_end *start; /* where chains begin: the ends of the session when it was created */
    int starts;
    long budget, spent; /* evaluations */
    long proofs;        /* of these, proofs that may still be asked for */
    long aside;         /* and what is kept for the next descents */

    int chains;
    ves_chain *chain;
    ves_asker **asker; /* [chains] theirs */
    ves_end *champion; /* [chains] the best of their legs */
    double *c;         /* [chains] their temperatures */
    ves_swaps *swaps;  /* [chains] of k and k + 1 */
    ves_random random; /* of exchanges */
    ves_point **best;
    bool *refused;

    int draws;                              /* of each chain in the warm-up */
    double *value, *violation, *constraint; /* [chains][draws], the last one [m]: NAN: not measured */

    ves_cooling cooling;
    long made, step; /* trials of each chain at this temperature; of the round that comes */
    int quiet;       /* temperatures without an acceptance */
    bool frozen;     /* so many that the leg is over */
    double proved;   /* temperature of the last round of proofs */

    ves_annealing_report report;
    double *ends;        /* [chains] mean energies at the last temperature */
    int row, held, most; /* its last line in the log: where, how many temperatures it holds, and may hold */
    ves_sample *line;    /* [chains] theirs */
} ves_annealing;

/* Begins at the ends of the session. options: completed. stream: of its random numbers, from
 * ves_session_stream. Its memory is the session's; false when there is none. */
bool ves_annealing_create(ves_annealing *a, ves_session *session, const ves_anneal *options, long budget,
                          uint32_t stream);

/* Goes on by about so many evaluations: to the end of a round. */
ves_status ves_annealing_advance(ves_annealing *a, long evaluations);
bool ves_annealing_done(const ves_annealing *a);

/* It goes on no more: proves champion[chains], which are its ends, polishes them when that was to be, and writes the
 * report. */
ves_status ves_annealing_close(ves_annealing *a);
void ves_annealing_destroy(ves_annealing *a); /* whatever became of it */

/* One round of all chains. Every question of a chain is asked in one. */
ves_status ves_annealing_round(ves_annealing *a, void (*task)(void *data, int worker, int index));

/* Of its budget: trials that each chain may still make. */
long ves_annealing_left(const ves_annealing *a);

/* warm.c: the first temperature, penalties, and where the chains begin. */
ves_status ves_annealing_warm(ves_annealing *a);

/* legs.c: what happens between legs. begin: false: there is none any more. */
ves_status ves_annealing_leg_begin(ves_annealing *a, bool *begun);
ves_status ves_annealing_leg_end(ves_annealing *a);
ves_status ves_annealing_offer(ves_annealing *a);
ves_status ves_annealing_offer_last(ves_annealing *a); /* the champions */
void ves_annealing_crown(ves_annealing *a);            /* what is best of this leg may be best of all */
ves_status ves_annealing_polish(ves_annealing *a, ves_end *end); /* [chains] */

/* health.c: the report's place in the session, what is logged of a temperature, where the heat capacity was largest
 * (0: nowhere), and the report. */
bool ves_annealing_enlist(ves_annealing *a);
ves_status ves_annealing_log(ves_annealing *a, ves_temperature *seen); /* seen: of this temperature alone */
ves_status ves_annealing_peak(const ves_annealing *a, double *peak);
ves_status ves_annealing_tell(ves_annealing *a);

#endif
