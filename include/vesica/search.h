/* Search: minimise a callback over a box, with constraints. Knows no geometry and is usable by itself:
 *
 *     ves_search_problem problem = {
 *         .n = 2, .lower = lower, .upper = upper, .start = start, .evaluate = mine};
 *     ves_search_options options = ves_search_options_default();
 *     ves_search_result *result;
 *     ves_status status = ves_search_run(&problem, &options, NULL, &result);
 *     ... result->x, result->value ...
 *     ves_search_result_destroy(result);
 *
 * One seed, one result, whatever `workers` is: random numbers are counters, and what runs at the same time -
 * chains, descents, a generation's candidates - hears of the others only at the end of a round, whose tasks
 * do not depend on the number of workers. */
#ifndef VESICA_SEARCH_H
#define VESICA_SEARCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "vesica/status.h"
#include "vesica/verdict.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ves_search_problem {
    int n;               /* variables, >= 1 */
    int m;               /* constraints */
    const double *lower; /* [n] finite, lower < upper */
    const double *upper;
    const double *start; /* [n] inside the box */
    int others; /* further starts: the first stage begins at all that can be measured, the best first */
    const double *const *other; /* [others][n] inside the box */
    const bool *equality; /* [m] true: constraint == 0; false: constraint <= 0. NULL: all inequalities */
    double tolerance;     /* feasible: violation <= tolerance; 0: 1e-6 */
    /* evaluate answers VES_WANT_GRADIENT exactly. At the end of a search that has used them 3 of the evaluations that
     * are left (5 in doubt) compare them with differences: where they are more than a hundredth of the slope apart, and
     * not by rounding, a note tells it. */
    bool gradients;
    int workers; /* how many threads may call evaluate at once, >= 1; 0: 1 */

    /* Judges one candidate. Calls with different `worker` (0 .. workers-1) may run at the same time. A
     * candidate that cannot be judged is verdict->status > 0; a negative return ends the search. */
    ves_status (*evaluate)(void *data, int worker, const ves_ask *ask, ves_verdict *verdict);
    void *data;

    const char *const *name; /* [n] of the variables, for the notes; NULL: x[0], x[1] ... */

    /* Whether two ends of equal value are one design, though their variables differ; asked when the stages
     * are over, from the thread that called ves_search_run. A negative return ends the search. NULL: no two
     * are. */
    ves_status (*same)(void *data, const double *a, const double *b, bool *same);

    /* More than the sentence of the status, for the notes: why x was just refused by its proof, asked from the
     * thread that called ves_search_run, once for each status. It must not depend on what was evaluated before.
     * Returns false, or NULL: there is no more to say. */
    bool (*why)(void *data, const double *x, ves_status status, char *text, size_t size);
} ves_search_problem;

/* The annealer: one Metropolis loop [Ugail 2011, 7.3-7.4] and five slots, each filled by the name of a choice that
 * ves_search_choice tells. 0 (NULL, false) is the default of everything: = {0} is a whole annealing. docs/methods
 * says what each choice is for. */
enum { VES_CHAINS = 4096 };
typedef struct ves_anneal {
    const char
        *as; /* words for all slots that are not given: book = the book's loop, exactly. NULL: the defaults */
    const char *proposal;    /* NULL: mixture; with `fixed`: fixed */
    const char *schedule;    /* NULL: budget; with s: book */
    const char *population;  /* NULL: chains */
    const char *constraints; /* NULL: lagrangian */
    const char *polish;      /* when descents are made from where the chains are; NULL: stages, or none
                                before a stage that polishes */
    long
        evaluations; /* budget of the stage: all chains, descents and proofs; 0: from the number of variables */
    int chains;   /* of the population, 0: as many as it says, at most VES_CHAINS; never depends on the number
                   of threads */
    double c0;    /* first temperature; 0: measured so that uphill moves are accepted at first */
    double s;     /* schedule (7.3), 0 < s < 1; 0: so that the temperature falls to c_end within the budget */
    double c_end; /* frozen at c_end * c0; 0: 1e-4, or 1e-10 when nothing polishes the ends */
    double step;  /* first step width as a fraction of each range; 0: 0.1 */
    bool fixed;   /* widths do not follow the acceptance, covariances are not learnt */
    double weight; /* of f per unit of violation; 0: from the data, grown while the best is infeasible */
} ves_anneal;

/* What may be written in a slot of an annealing, the words of `as`, and those of `only`. False: there are no
 * more. */
typedef enum ves_slot {
    VES_SLOT_PROPOSAL,
    VES_SLOT_SCHEDULE,
    VES_SLOT_POPULATION,
    VES_SLOT_CONSTRAINTS,
    VES_SLOT_POLISH,
    VES_SLOT_PRESET,
    VES_SLOT_STRATEGY /* what ves_auto.only may say */
} ves_slot;
typedef struct ves_choice {
    const char *name, *about;
} ves_choice;
bool ves_search_choice(ves_slot slot, int index, ves_choice *choice);

/* NLopt local search on scaled quantities: variables in [0, 1], objective over its largest slope,
 * constraints over theirs. 0 (NULL, false) is the default of everything. */
typedef struct ves_polish {
    const char
        *algorithm; /* slsqp mma ccsa lbfgs cobyla bobyqa sbplx auglag; NULL: by gradients and constraints */
    long evaluations;   /* budget of the stage, proofs too; 0: from the number of variables */
    double x_tolerance; /* relative to the range; 0: 1e-9 */
    double f_tolerance; /* relative; 0: 1e-12 */
    int starts;         /* how many ends of the stage before are polished, best first; 0: all */
    bool stay;          /* on a saddle; false: leave it along a direction of negative curvature (needs
                              gradients) */
} ves_polish;

/* A portfolio of strategies that share the budget by their progress. */
typedef struct ves_auto {
    long evaluations; /* budget of the stage; 0: from the number of variables */
    const char *only; /* the name of the one strategy; NULL: those that fit */
} ves_auto;

typedef enum ves_stage_kind { VES_STAGE_ANNEAL, VES_STAGE_POLISH, VES_STAGE_AUTO } ves_stage_kind;

typedef struct ves_stage {
    ves_stage_kind kind;
    ves_auto automatic;
    ves_anneal anneal;
    ves_polish polish;
} ves_stage;

enum { VES_STAGES = 16 };

typedef struct ves_search_options {
    int stages; /* 0: a portfolio, then a polish of the best of its distinct ends */
    ves_stage stage[VES_STAGES];
    uint64_t seed; /* default: 1 */

    /* Budget of the whole search, never exceeded; 0: the sum of the stages, the start and 16 proofs, and a
     * portfolio whose stage gives none either may end before its budget is spent: once its best has been
     * found by ten independent descents and less than 1 % of the box is expected to lead elsewhere. At most
     * 2^53, like those of the stages. Proofs are evaluations like any other: an annealing asks for at most 16
     * and a tenth of its budget, a polish for at most 3; a twentieth of the whole, 1 to 16, is kept for the
     * end, where the best and the optima are proved. A budget of 1 measures the start and proves nothing: the
     * result is unproved, and counts as infeasible. */
    long evaluations;

    /* What an answer with gradients costs, in evaluations; 0: 3 (an adjoint costs about two more); else >= 1. A
     * portfolio shares out by it. Where it is more than n + 1, and differences of values would be as cheap, the
     * search does without gradients. */
    double gradient;
} ves_search_options;

ves_search_options ves_search_options_default(void);
ves_anneal ves_anneal_default(void);
ves_polish ves_polish_default(void);

/* What the search tells while it runs. Called from the thread that called ves_search_run; how often, and what
 * is not counted yet, depends on the number of workers. */
typedef struct ves_progress {
    int stage;              /* index */
    const char *stage_name; /* "anneal", "slsqp" ... */
    long evaluations, budget;
    double temperature, acceptance; /* of annealing; else NAN */
    bool any;                       /* some candidate was measured: value, violation hold */
    double value, violation;        /* best so far; violation: of a verdict. A run tells that of a design */
} ves_progress;

/* One evaluation, for the trace. The arrays live while it is told. */
typedef struct ves_record {
    long evaluation;  /* counts from 1 in the order of the trace */
    int stage, chain; /* chain: of an annealing, or the number of the polish; -1: proofs and other questions
                         of the whole search */
    const double *x;
    const double *constraint; /* [m] when status is VES_OK; else NULL */
    const double *slope; /* [n] of the value, then [m][n] of the constraints, when they were wanted; NULL */
    double value, violation, temperature;
    ves_status status;
    bool accepted, gradient, proof; /* proof: asked with VES_WANT_PROOF */
} ves_record;

typedef struct ves_search_hooks {
    void (*progress)(void *data, const ves_progress *progress);
    void (*record)(void *data, const ves_record *record);
    bool (*stopped)(void *data); /* true: stop cleanly with the best so far; asked from any worker */
    void *data;

    /* The journal. A search goes on in rounds; a round that is over is handed to `keep` as one block of bytes
     * (whole), and a part of one that takes longer than 2 s, or that a stop breaks off, is handed over as well
     * (not whole: its blocks are worthless once the whole one comes). One call at a time, from any worker.
     * `recall` gives them back in the same order, first all the whole ones, then the parts of the round behind
     * them; it answers false when there are no more. Called from the thread that called ves_search_run; the block
     * must live until the next call. The search asks for nothing that the journal knows: it goes the same way
     * again, in the time that it takes by itself, and then on from there to the same end, bit for bit. The
     * same problem, options, number of stages and version are needed: VES_STALE tells when it is not so. */
    void (*keep)(void *data, const void *block, size_t size, bool whole);
    double (*clock)(void *data); /* s, from any worker: when parts are due. NULL: only at a stop */
    bool (*recall)(void *data, const void **block, size_t *size, bool *whole);

    /* Ranks: processes that go through the same search and share out its rounds. Rank r asks for the tasks k of a
     * round with k modulo ranks = r; then `exchange` gives every rank the messages of all, in the order of the
     * ranks, as one row of bytes that lives until the next call; what the others were answered is not asked again.
     * The result is the same on all, for any number. All of them have the same problem, options and answers of
     * recall. `stopped` counts at the ends of rounds, whichever rank it told. A negative return ends the search
     * on this rank, which must then end the others. ranks 0 or 1: alone. */
    int rank, ranks;
    ves_status (*exchange)(void *data, const void *mine, size_t size, const void **all, size_t *total);
} ves_search_hooks;

/* Reads a block, whole or not, of a problem with n variables and m constraints, one record after the other. The
 * cursor begins as {0}. Returns false behind the last, or where the block is damaged. The arrays of the record
 * are those of the block, which must be aligned as doubles are. record->evaluation counts from 1 in the block. */
typedef struct ves_search_cursor {
    size_t at, end;
    unsigned part;
    int member;
    long evaluation;
} ves_search_cursor;
bool ves_search_block_read(const void *block, size_t size, int n, int m, ves_search_cursor *cursor,
                           ves_record *record);

/* Of the ranges: ends that are nearer than this in every variable are one optimum. */
#define VES_ONE_OPTIMUM 1e-3

/* A distinct feasible end of the search: within VES_ONE_OPTIMUM (variables that the objective does not
 * feel left out) of no better one, nor the `same` as one. With gradients an end where the slope has not
 * vanished, as at a kink, is one only as the best of all. */
typedef struct ves_optimum {
    const double *x;
    double value, violation; /* of a verdict; in a run those of a design */
    int hits;    /* how many descents ended here: all of the last portfolio and the independent ones of those
                 before it; where none did, polishes */
    bool saddle; /* the second-order check found a direction of negative curvature that could not be left */
} ves_optimum;

enum { VES_MOVES = 4 }; /* proposals that a mixture may have */

/* The trials of one proposal. width: of its typical step along one coordinate, as a fraction of the range, the mean of
 * the chains; 0: it has none. */
typedef struct ves_move_count {
    long trials, accepted;
    double width;
} ves_move_count;

/* One temperature of one annealing: all chains together or, of replicas, the coldest. Where a leg has more than
 * two hundred temperatures some that follow each other stand together. */
typedef struct ves_temperature {
    int stage, annealing, leg; /* annealing: its place among the reports; a leg goes from hot to cold */
    int steps;                 /* temperatures that stand here together; c is the last of them */
    double c;                  /* temperature */
    long trials, accepted;
    double mean;     /* of the energy, which is the value where there are no constraints */
    double variance; /* of the energy within each chain, the mean of the chains */
    ves_move_count move[VES_MOVES];
} ves_temperature;

/* The heat capacity, variance / c^2, of one annealing between two temperatures: the mean of its lines by their trials.
 * Where a chain falls into another basin for good the variance tells how deep that lies, so no line counts for more
 * than twice their median. 0: there are none. scratch: [lines]. A `peak` is that of temperatures from c /
 * VES_HEAT_REACH to c VES_HEAT_REACH. */
#define VES_HEAT_REACH 1.4
double ves_heat_capacity(const ves_temperature *line, int lines, int annealing, double low, double high,
                         double *scratch);

/* What an annealing says of itself. */
typedef enum ves_health {
    VES_HEALTH_FROZEN,  /* cooled to the end, and the chains agree */
    VES_HEALTH_UNEVEN,  /* cooled to the end, but not in equilibrium: chains froze at different values */
    VES_HEALTH_SHORT,   /* the budget was too short to reach the last temperature */
    VES_HEALTH_SAMPLED, /* it did not cool */
    VES_HEALTH_STOPPED  /* it was not allowed to go on */
} ves_health;

typedef struct ves_annealing_report {
    int stage;
    const char *proposal, *schedule, *population, *constraints, *polish;
    int chains, legs, moves;
    const char *move[VES_MOVES];     /* [moves] names */
    ves_move_count count[VES_MOVES]; /* [moves] of all chains, all temperatures */
    double c0, c;                    /* first and last temperature */
    double
        freezing; /* of the last leg: below it the mean energy fell by less than a hundredth of its whole fall */
    /* Where the heat capacity, variance / c^2, was largest: of all legs, smoothed, above where the first one froze.
     * NAN: nowhere half as large again as where all is frozen, or largest within VES_HEAT_REACH of the first
     * temperature, where it may rise on. */
    double peak;
    long swaps, swapped; /* exchanges of replicas: tried, done */
    double least_swap;   /* of the pair that exchanged least: done / tried; NAN: no replicas */
    double apart; /* of the chains in the end: how far their mean energies are apart, as a part of the fall
                            of the mean energy in the last leg; NAN: one chain, or replicas */
    ves_health health;
    const char *sentence;
} ves_annealing_report;

/* What one strategy of a portfolio has done. */
enum { VES_STRATEGIES = 8 * VES_STAGES };
typedef struct ves_strategy_report {
    int stage;
    const char *name; /* of the strategy; refine: the descents from bests of theirs, and of the start */
    long evaluations, gradients;
    int bests; /* turns in which it found a new best of all */
    bool best; /* the best is its, though `refine` may have gone on from there */
} ves_strategy_report;

/* How far the best can be trusted to be the best there is. */
typedef enum ves_trust {
    VES_TRUST_NONE,      /* nothing to tell: no feasible and proved best, or a sampler's */
    VES_TRUST_STOPPED,   /* the search was not allowed to go on */
    VES_TRUST_REFUSED,   /* better designs did not pass the proof: it need be no optimum */
    VES_TRUST_SHORT,     /* the budget was too short to converge */
    VES_TRUST_EDGE,      /* it lies beside designs that cannot be measured: the optimum may lie beyond them */
    VES_TRUST_KINK,      /* the slope has not vanished there: a kink, or wrong gradients */
    VES_TRUST_LOST,      /* the algorithm of the last descent failed before it had converged */
    VES_TRUST_FROZEN,    /* an annealing has frozen; nothing else is known */
    VES_TRUST_CONVERGED, /* a descent has converged; no second one that knew nothing of it ended there */
    VES_TRUST_REPEATED   /* at least two independent descents ended there */
} ves_trust;

/* Independent descents are those of portfolios from points drawn uniformly from the box that ended at a point
 * with a value; hops from the best and lines do not count. After n of them with w distinct ends, and all numbers of
 * minima and all divisions of the box among them being as likely at first, the expected number of minima is
 * w (n - 1) / (n - w - 2), and the expected part of the box from which descents lead to minima that were not
 * seen is w (w + 1) / (n (n - 1)), both for n > w + 2 [Boender and Rinnooy Kan 1987]. The box is the part of
 * it from which descents come to a value. Once 512 distinct ends are known, as of a flat optimum, no more are
 * counted. */
typedef struct ves_evidence {
    ves_trust trust;
    const char *sentence;
    int verdict;     /* so long is its first part, on the best alone; what follows tells of the descents */
    long descents;   /* n */
    long minima;     /* w: those that turned out to be one optimum counted once; infeasible ends too */
    long hits;       /* of them that ended at the best */
    long unmeasured; /* descents more, not of the n, that met nothing that could be measured */
    double expected, unseen; /* NAN: not enough descents to tell */
} ves_evidence;
double ves_evidence_expected(long descents, long minima);
double ves_evidence_unseen(long descents, long minima);

/* First-order conditions at the best. With L = f + sum_j multiplier_j constraint_j, slopes are those across the
 * whole range of a variable. A multiplier is what the best value gains, per unit, when the limit of its constraint
 * is moved outwards a little (constraint <= eps, or == eps); >= 0 for inequalities. */
typedef struct ves_kkt {
    bool known;   /* false: no gradients, no feasible best, stopped, or no evaluation left for them */
    double slope; /* |grad L| over the variables that no bound holds */
    double
        residual; /* the same relative to the largest of |grad f| at the best, at the start, and 1e-4 |f| */
    bool unique;  /* the slopes of what holds are independent, so that there are no other multipliers */
    const double *multiplier; /* [m]; 0: it does not hold the best */
    const double *bound; /* [n] dL/dx at the bound that holds x: what the best value rises by, per unit, when
                            this bound is moved up a little and constraints that hold still do; 0: none does */
} ves_kkt;

/* Why a search ended. */
typedef enum ves_ending {
    VES_ENDED_DONE,   /* of itself: frozen, converged, or nowhere left to go */
    VES_ENDED_BUDGET, /* the last stage, or one that could not begin, had no evaluations left */
    VES_ENDED_STOPPED /* the hook `stopped` said so */
} ves_ending;

/* Everything one search produced. Owned by the caller; one block. */
typedef struct ves_search_result {
    int n, m;
    ves_status status; /* VES_OK, VES_INTERRUPTED */
    bool any;          /* some candidate could be measured: the rest holds */
    bool feasible;
    const double *x; /* [n] best */
    double value, violation;
    const double *constraint; /* [m] at the best */
    long evaluations;         /* proofs too */
    long budget;              /* what they might have been */
    long gradients;
    ves_ending ending;
    const char *stop; /* a sentence: why the last stage that began ended */
    int notes;
    const char *const
        *note;  /* sentences: saddles left, bests refused by the proof and why, budget too short ... */
    int optima; /* 0: no feasible one was found and proved */
    const ves_optimum *optimum; /* best first */
    int temperatures;
    const ves_temperature *temperature;
    int annealings;
    const ves_annealing_report *annealing;
    int strategies;
    const ves_strategy_report *strategy; /* of portfolios, in their order */
    ves_evidence evidence;
    ves_kkt kkt;
    long failed;  /* candidates without a value */
    long refused; /* accepted bests refused by VES_WANT_PROOF */
} ves_search_result;

/* Runs the stages. Negative only for faults (memory, a negative return of evaluate, options out of range); an
 * infeasible end is VES_OK with feasible == false. VES_INTERRUPTED also gives a result. */
ves_status ves_search_run(const ves_search_problem *problem, const ves_search_options *options,
                          const ves_search_hooks *hooks, ves_search_result **result);
void ves_search_result_destroy(ves_search_result *result);

/* The algorithms a polish may name: NULL-terminated names; what each can do. */
typedef struct ves_algorithm {
    const char *name, *about;
    bool gradient, inequality, equality;
} ves_algorithm;
const ves_algorithm *ves_search_algorithms(void); /* ends with name == NULL */

#ifdef __cplusplus
}
#endif
#endif
