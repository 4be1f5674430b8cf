#include "search/chain.h"

#include <math.h>
#include <string.h>

/* Metropolis algorithm [Ugail 2011, 7.4.1]: accept v after u when
 *     E(v) - E(u) <= 0  or  e^{-(E(v) - E(u)) / c} > r,    r uniform in (0, 1),
 * E: value and what the constraints add. r is drawn before v is measured, so that measuring may stop once v cannot
 * be accepted any more. A proposal that is not symmetric is corrected as Hastings (1970) says.
 * cost  O(n) for each trial, no allocation
 * test  Boltzmann distribution (7.2) in a quadratic and in a double well, with every proposal and with one that is
 *       not symmetric; a loop of ten lines goes the same way */

static bool points_create(ves_chain *chain, ves_session *session)
{
    ves_point *all[] = {&chain->current, &chain->candidate, &chain->best, &chain->home};
    for (int k = 0; k < 4; k++)
        if (!ves_point_create(&session->arena, session->n, session->m, all[k])) return false;
    size_t m = (size_t)session->m;
    ves_burden *burden = &chain->burden;
    *burden = (ves_burden){.m = session->m,
                           .equality = session->problem->equality,
                           .tolerance = session->tolerance,
                           .heat = 1,
                           .multiplier = ves_arena_take(&session->arena, m, sizeof(double)),
                           .stiffness = ves_arena_take(&session->arena, m, sizeof(double))};
    return burden->multiplier && burden->stiffness;
}

static bool move_add(ves_chain *chain, const ves_proposal *proposal, double share)
{
    ves_session *session = chain->asker.session;
    ves_move *move = &chain->move[chain->moves++];
    *move = (ves_move){.proposal = proposal, .share = share};
    if (!proposal->room) return true;
    move->state = ves_arena_take(&session->arena, (size_t)proposal->room(session->n), sizeof(double));
    return move->state;
}

static void forget(ves_chain *chain)
{
    for (int k = 0; k < chain->moves; k++)
        if (chain->move[k].proposal->init)
            chain->move[k].proposal->init(chain->asker.session->n, chain->step0, chain->move[k].state);
}

bool ves_chain_init(ves_chain *chain, ves_session *session, int index, const ves_chain_make *make)
{
    *chain = (ves_chain){.cut = make->cut,
                         .lowest = HUGE_VAL,
                         .energy = HUGE_VAL,
                         .constraint = make->constraint,
                         .learn = 1 + session->n / 4,
                         .step0 = make->step};
    ves_asker_init(&chain->asker, session, index);
    chain->random = (ves_random){.seed = session->seed, .chain = make->stream + (uint32_t)index};
    if (!points_create(chain, session)) return false;
    const ves_share single[] = {{make->proposal, 1}, {0}};
    const ves_share *share = make->proposal->share ? make->proposal->share : single;
    for (; share->proposal; share++)
        if (!move_add(chain, share->proposal, share->share)) return false;
    forget(chain);
    return true;
}

static double energy(const ves_chain *chain, const ves_point *point)
{
    const ves_verdict *verdict = &point->verdict;
    if (verdict->status != VES_OK) return HUGE_VAL;
    return chain->burden.m ? chain->constraint->energy(&chain->burden, verdict)
                           : ves_verdict_energy(verdict, chain->burden.weight, chain->burden.tolerance);
}

/* Keeps the best and the lowest value of what was just measured. */
static void remember(ves_chain *chain, const ves_point *point)
{
    const ves_session *session = chain->asker.session;
    const ves_verdict *verdict = &point->verdict;
    if (verdict->status != VES_OK) return;
    if (verdict->value < chain->lowest) chain->lowest = verdict->value;
    if (!ves_verdict_better(verdict, &chain->best.verdict, session->tolerance)) return;
    ves_point_copy(&chain->best, point, session->n, session->m);
}

void ves_chain_place(ves_chain *chain, const ves_point *point)
{
    const ves_session *session = chain->asker.session;
    if (point) ves_point_copy(&chain->best, point, session->n, session->m);
    ves_point_copy(&chain->current, &chain->best, session->n, session->m);
    ves_point_copy(&chain->home, &chain->best, session->n, session->m);
    remember(chain, &chain->current);
    chain->energy = energy(chain, &chain->current);
}

/* Measures the candidate. */
static ves_status judge(ves_chain *chain, double cutoff)
{
    ves_ask ask = {.x = chain->candidate.x, .cutoff = cutoff, .want = VES_WANT_VALUE};
    chain->candidate.proved = false;
    return ves_asker_judge(&chain->asker, &ask, &chain->candidate.verdict);
}

static void swap(ves_point *a, ves_point *b)
{
    ves_point moved = *a;
    *a = *b;
    *b = moved;
}

/* Every other draw is uniform in the box, the others on the way from there to the start, by halves, quarters
 * ...: where most of the box cannot be measured, these can. */
ves_status ves_chain_explore(ves_chain *chain, const ves_point *start)
{
    ves_session *session = chain->asker.session;
    chain->random.draw = 0;
    double reach = chain->random.step % 2 ? ldexp(1, -1 - (int)(chain->random.step / 2 % 5)) : 1;
    for (int i = 0; i < session->n; i++) {
        double u = ves_random_uniform(&chain->random);
        chain->candidate.u[i] = start->u[i] + reach * (u - start->u[i]);
    }
    chain->random.step++;
    ves_point_place(session->problem, chain->candidate.u, chain->candidate.x);
    VES_TRY(judge(chain, HUGE_VAL));
    bool better = ves_verdict_better(&chain->candidate.verdict, &chain->best.verdict, session->tolerance);
    ves_asker_record(&chain->asker, false, NAN, better);
    remember(chain, &chain->candidate);
    return VES_OK;
}

ves_status ves_chain_restart(ves_chain *chain)
{
    const ves_session *session = chain->asker.session;
    forget(chain);
    for (int d = 0; d < VES_CHAIN_DRAWS; d++) {
        chain->random.draw = 0;
        ves_random_uniforms(&chain->random, session->n, chain->candidate.u);
        chain->random.step++;
        ves_point_place(session->problem, chain->candidate.u, chain->candidate.x);
        VES_TRY(judge(chain, HUGE_VAL));
        bool good = chain->candidate.verdict.status == VES_OK;
        ves_asker_record(&chain->asker, false, NAN, good);
        if (!good) continue;
        ves_chain_place(chain, &chain->candidate);
        return VES_OK;
    }
    ves_chain_place(chain, &chain->current);
    return VES_OK;
}

static ves_move *propose(ves_chain *chain, double choice, double heat)
{
    const ves_session *session = chain->asker.session;
    int n = session->n, k = 0;
    double *u = chain->candidate.u, *x = chain->candidate.x;
    while (k < chain->moves - 1 && choice >= chain->move[k].share) choice -= chain->move[k++].share;
    memcpy(u, chain->current.u, (size_t)n * sizeof *u);
    chain->move[k].proposal->propose(n, chain->move[k].state, heat, &chain->random, u);
    for (int i = 0; i < n; i++)
        x[i] = u[i] == chain->current.u[i] ? chain->current.x[i] : ves_point_scale(session->problem, i, u[i]);
    return &chain->move[k];
}

/* The violation beyond which the candidate is rejected whatever its value, if that is not below all seen by
 * more than a margin. */
static double cutoff(const ves_chain *chain, double limit)
{
    if (!chain->cut || !chain->burden.m) return HUGE_VAL;
    return chain->constraint->cutoff(&chain->burden, chain->energy + limit, chain->lowest - chain->margin);
}

static void count(ves_chain *chain, ves_move *move, bool accepted)
{
    chain->trials++;
    move->trials++;
    chain->accepted += accepted;
    move->accepted += accepted;
    double delta = chain->energy - chain->mean;
    chain->mean += delta / (double)chain->trials;
    chain->square += delta * (chain->energy - chain->mean);
}

static void adapt(ves_chain *chain, ves_move *move, bool accepted)
{
    int n = chain->asker.session->n;
    if (!chain->adapt) return;
    if (move->proposal->adapt) move->proposal->adapt(n, move->state, accepted);
    if (chain->trials % chain->learn) return;
    for (int k = 0; k < chain->moves; k++)
        if (chain->move[k].proposal->learn)
            chain->move[k].proposal->learn(n, chain->move[k].state, chain->current.u);
}

ves_status ves_chain_step(ves_chain *chain, double c, double heat)
{
    double r[2]; /* which move; against which the acceptance is held */
    chain->random.draw = 0;
    ves_random_pair(&chain->random, r);
    ves_move *move = propose(chain, r[0], heat);
    double limit = -c * log(r[1]);
    if (move->proposal->log_ratio)
        limit += c * move->proposal->log_ratio(chain->asker.session->n, move->state);
    chain->random.step++;
    VES_TRY(judge(chain, cutoff(chain, limit)));
    double next = energy(chain, &chain->candidate);
    bool accepted = next - chain->energy < limit;
    ves_asker_record(&chain->asker, false, c, accepted);
    remember(chain, &chain->candidate);
    if (accepted) {
        swap(&chain->current, &chain->candidate);
        chain->energy = next;
    }
    count(chain, move, accepted);
    adapt(chain, move, accepted);
    return VES_OK;
}

void ves_chain_settle(ves_chain *chain, bool feasible, double heat)
{
    if (chain->burden.m && chain->constraint->settle && chain->current.verdict.status == VES_OK) {
        chain->constraint->settle(&chain->burden, &chain->current.verdict, feasible, heat);
        chain->energy = energy(chain, &chain->current);
    }
    chain->trials = chain->accepted = 0;
    chain->mean = chain->square = 0;
    for (int k = 0; k < chain->moves; k++) chain->move[k].trials = chain->move[k].accepted = 0;
}

void ves_chain_share(ves_chain *chain, const ves_chain *other)
{
    ves_burden mine = chain->burden;
    size_t size = (size_t)mine.m * sizeof(double);
    chain->burden = other->burden;
    chain->burden.multiplier = mine.multiplier;
    chain->burden.stiffness = mine.stiffness;
    if (size) memcpy(mine.multiplier, other->burden.multiplier, size);
    if (size) memcpy(mine.stiffness, other->burden.stiffness, size);
    chain->energy = energy(chain, &chain->current);
}

void ves_chain_exchange(ves_chain *a, ves_chain *b)
{
    double moved = a->energy;
    swap(&a->current, &b->current);
    a->energy = b->energy;
    b->energy = moved;
}

void ves_chain_return(ves_chain *chain)
{
    const ves_session *session = chain->asker.session;
    ves_point_copy(&chain->current, &chain->home, session->n, session->m);
    ves_point_copy(&chain->best, &chain->home, session->n, session->m);
    chain->energy = energy(chain, &chain->current);
}

const ves_point *ves_chain_end(const ves_chain *chain)
{
    return energy(chain, &chain->current) < energy(chain, &chain->best) ? &chain->current : &chain->best;
}
