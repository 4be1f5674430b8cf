/* Session: what all stages of one search share. Members of the population (chains, polishes) ask through an
 * asker each; what they tell is kept in a journal and merged in the members' order, so that nothing depends
 * on the number of threads. */
#ifndef VES_SEARCH_SESSION_H
#define VES_SEARCH_SESSION_H

#include <stdatomic.h>
#include <stdbool.h>

#include "base/arena.h"
#include "base/pool.h"
#include "base/random.h"
#include "search/block.h"
#include "search/point.h"
#include "vesica/search.h"

enum { VES_NOTES = 64, VES_STATUS_KINDS = 64 };

/* Proofs: of one round of offers; of an annealing, or of the end; how many refused points are remembered. */
enum { VES_PROOFS_ROUND = 3, VES_PROOFS = 16, VES_PROOFS_KNOWN = 64 };

typedef struct ves_session ves_session;

/* Whether a descent's end is one: nobody has looked at the slope; it has vanished or, of an algorithm that needs
 * none, converged; it has not vanished, as at a kink; it lies beside what cannot be measured; the algorithm
 * failed. */
typedef enum ves_halt {
    VES_HALT_UNKNOWN,
    VES_HALT_REST,
    VES_HALT_KINK,
    VES_HALT_EDGE,
    VES_HALT_LOST
} ves_halt;

/* An end of a stage: where a chain or a polish stopped. The next stage starts from the ends of the one
 * before. */
typedef struct ves_end {
    ves_point point;
    bool saddle;
    bool pass; /* a saddle, and a descent from it ended lower */
    ves_halt halt;
    long hits;  /* descents that ended here */
    long blind; /* of these, from points drawn uniformly */
} ves_end;

/* One member's line to the evaluator. What it has been answered since it was flushed last stands in `said`,
 * as it will stand in a block; what a journal knows of that already is in `known`, and is not asked again. */
typedef struct ves_asker {
    ves_session *session;
    int member, worker;
    int place;   /* in its round */
    bool proves; /* asks even after a stop: an interrupted search still proves its best */
    bool joined; /* a round, or alone: what is known of it has been looked for */
    long evaluations, gradients, failed; /* not yet merged */
    ves_status fault;                    /* negative: the search must end */
    ves_bytes said, known;
    size_t last, told, saved,
        heard;   /* in said: the last event; up to where it was told, and kept; in known */
    bool whole;  /* known holds all of the round: no more may be asked */
    bool broken; /* or all until a stop broke it off, on another rank */
    double kept; /* s: when it was saved last */
} ves_asker;

struct ves_session {
    const ves_search_problem *problem;
    ves_search_hooks hooks;
    int n, m;
    double tolerance; /* feasible */
    double tight;     /* violations below this are rounding */
    double usual;     /* size of a constraint of which nothing is known: 1 for the usual tolerance */
    double dear;      /* what an answer with gradients costs, in evaluations */
    uint64_t seed;
    ves_arena arena; /* scratch of the search */
    ves_arena kept;  /* what the result points to */
    ves_pool *pool;
    atomic_bool stopped;
    ves_status fault;

    int stages, stage_index;
    bool lone; /* the budget is for one descent, not for a portfolio */
    ves_stage stage[VES_STAGES];
    bool grows[VES_STAGES]; /* the stage has no budget of its own */
    bool saves[VES_STAGES]; /* nobody has given it a budget: what it can do without goes back */
    const char *stage_name;
    long budget;   /* of the whole search */
    long reserved; /* of it, for the proofs at the end */
    double temperature, acceptance;

    long evaluations, gradients, failed, refused;
    long told;             /* events handed to the hooks */
    atomic_long under_way; /* answers of the round that were not told yet */
    bool listens;          /* some hook wants to hear of evaluations */
    bool recalls;          /* the journal may know more */
    bool closed;           /* and hears no more: the search was stopped */
    bool shares;           /* there are other ranks */
    bool rounding;         /* a round is going on */
    ves_bytes block;       /* under the lock of the pool */
    ves_bytes message;     /* for the other ranks */
    ves_verdict seen;      /* best told so far */
    double
        *price; /* [m] objective per unit of violation: what a violation within the tolerance may not buy */
    double spread; /* of the objective, from the warm-up; 0: unknown */
    bool refusal[VES_STATUS_KINDS];
    double *known; /* [VES_PROOFS_KNOWN][n] the points that were refused last, in the unit box */

    ves_point start, best; /* best: the proved one; failed while there is none */
    int ends;
    ves_end *end; /* best first */

    int notes;
    const char *note[VES_NOTES];
    ves_ending ending;
    const char *stop;
    int temperatures, temperature_room;
    ves_temperature *temperature_log;
    int annealings, annealing_room;
    ves_annealing_report *annealing_log;
    int strategies;
    ves_strategy_report strategy[VES_STRATEGIES];

    /* Of portfolios: where their descents have ended and, when a polish has gone on from there, where that ended:
     * they tell how often, not where to begin. Of descents from points drawn uniformly: how many there were, their
     * distinct ends, and how many more met nothing that could be measured. */
    int visits;
    ves_end *visited;
    long blind, kinds, unmeasured;
};

ves_status ves_session_init(ves_session *session, const ves_search_problem *problem,
                            const ves_search_options *options, const ves_search_hooks *hooks);
void ves_session_destroy(ves_session *session);

/* True once the search must end: fault, interrupt. A task of a round that ranks share hears of an interrupt only
 * by an answer that it is not given, so that it ends there on all of them. */
bool ves_session_over(ves_session *session);
bool ves_session_stopped(ves_session *session);    /* also asks the hook */
long ves_session_left(const ves_session *session); /* evaluations, but for those kept for the end */
bool ves_session_equality(const ves_session *session, int j); /* is constraint j one */

/* The order while a search runs: that of verdicts, with a price on violations that are within the tolerance
 * but more than rounding, else the best would always be the one that uses the tolerance up. */
bool ves_session_better(const ves_session *session, const ves_verdict *a, const ves_verdict *b);
bool ves_session_better_at(const ves_session *session, const double *price, const ves_verdict *a,
                           const ves_verdict *b);
/* Raises the session's prices to what descents [count] have seen of the slopes: the least they agree on. */
void ves_session_raise(ves_session *session, const double *const *price, int count);
void ves_session_sort(const ves_session *session, ves_end *end, int count);

/* Adds a sentence (printf format); too many: dropped. Out of memory is a fault of the session. What is told
 * last of why it stops holds. */
void ves_session_note(ves_session *session, const char *format, ...) __attribute__((format(printf, 2, 3)));
void ves_session_stop(ves_session *session, ves_ending ending, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void ves_session_progress(ves_session *session);

/* Offers members' bests to the population: the best of them that is better than the population's and passes
 * the proof becomes the population's best. At most `most` proofs, best first; refused[k] tells which did not
 * pass. */
ves_status ves_session_offer(ves_session *session, ves_point *const *point, int count, long most,
                             bool *refused);

/* Asks for the dear checks; a point next to one that was refused is refused without asking. */
typedef enum ves_proof { VES_PROOF_PASSED, VES_PROOF_REFUSED, VES_PROOF_STOPPED } ves_proof;
bool ves_session_costs(const ves_session *session, const ves_point *point); /* would it be asked */
ves_status ves_session_prove(ves_session *session, ves_point *point, ves_proof *proof);

/* One round: runs the tasks, each of which asks through its own asker, on the pool; merges what they have
 * been answered in their order, and hands it to the journal as one block. Where the journal knows the answers
 * already none is asked for: so runs are resumed. */
ves_status ves_session_round(ves_session *session, ves_asker *const *asker, int count,
                             void (*task)(void *data, int worker, int index), void *data);

/* The first of the 2^16 chains of random numbers that are a member's of a stage, and nobody else's. Member 0 is the
 * stage itself: an annealing, or the look round of a portfolio, whose strategies are 1, 2 ... The draws before all
 * stages are of the last chain. */
enum { VES_STREAM_MEMBERS = 16 };
#define VES_STREAM_BEGIN UINT32_MAX
uint32_t ves_session_stream(int stage, int member);

/* Takes `room` ends for the next stage; NULL when out of memory. */
ves_end *ves_session_ends(ves_session *session, int room);

void ves_asker_init(ves_asker *asker, ves_session *session, int member);

/* Asks for one verdict. The arrays are the caller's. Not a number is VES_NO_NUMBER. Returns VES_OK for any
 * candidate; VES_INTERRUPTED (nothing asked) or the evaluator's fault else. */
ves_status ves_asker_judge(ves_asker *asker, const ves_ask *ask, ves_verdict *verdict);

/* What the search made of what has just been judged; gradient: exact slopes were told. */
void ves_asker_record(ves_asker *asker, bool gradient, double temperature, bool accepted);

/* Ends a round of one: outside ves_session_round, by the caller's thread. */
void ves_asker_flush(ves_asker *asker);

/* For round.c: tells the hooks and the session what was said; keeps a part of a round that is not over. A
 * round begins for its askers, and ends. */
void ves_asker_merge(ves_asker *asker);
void ves_asker_save(ves_asker *asker);
ves_status ves_round_join(ves_session *session, ves_asker *const *asker, int count);
void ves_round_leave(ves_session *session, ves_asker *const *asker, int count);
void ves_asker_destroy(ves_asker *asker);

/* share.c: the tasks of a round, those of the other ranks too. */
typedef struct ves_round {
    ves_asker *const *asker;
    int count;
    void (*task)(void *data, int worker, int index);
    void *data;
} ves_round;
void ves_round_share(ves_session *session, const ves_round *round);

/* The stages. */
ves_status ves_search_begin(ves_session *session); /* measures the start, or finds one that can be measured */
ves_status ves_anneal_run(ves_session *session, const ves_anneal *options, long budget);
ves_status ves_portfolio_run(ves_session *session, const ves_auto *options, long budget);
ves_status ves_polish_run(ves_session *session, const ves_polish *options, long budget);

/* doubt.c: a note where gradients are not those of the values. After the stages; at most 5 evaluations. */
ves_status ves_search_doubt(ves_session *session);

/* Distinct ends, and the result. */
ves_status ves_search_finish(ves_session *session, ves_search_result **result);

/* options.c: checked and completed options; budgets. */
ves_status ves_search_check(const ves_search_problem *problem, const ves_search_options *options);
void ves_search_complete(ves_session *session, const ves_search_options *options);
void ves_search_complete_polish(const ves_search_problem *problem, ves_polish *polish, int ends);
long ves_search_share(const ves_session *session, int stage); /* budget of a stage that is about to begin */
const char *ves_search_algorithm(const ves_search_problem *problem, const ves_polish *polish);

#endif
