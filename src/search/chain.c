#include "search/chain.h"

#include <math.h>
#include <string.h>

/* Metropolis algorithm [Ugail 2011, 7.4.1]: accept v after u when
 *     E(v) - E(u) <= 0  or  e^{-(E(v) - E(u)) / c} > r,    r uniform in (0, 1),
 * E: value + weight * violation. r is drawn before v is measured, so that measuring may stop once v cannot be
 * accepted any more.
 * cost  O(n) and 2 to n + 3 random numbers, no allocation
 * test  Boltzmann distribution (7.2) in a quadratic and in a double well */

static const double growth = 1.25;

static bool points_create(ves_chain *chain, ves_session *session)
{
    ves_point *all[] = {&chain->current, &chain->candidate, &chain->best, &chain->home};
    for (int k = 0; k < 4; k++)
        if (!ves_point_create(&session->arena, session->n, session->m, all[k])) return false;
    return true;
}

static bool move_add(ves_chain *chain, const ves_proposal *proposal, double share, double step)
{
    ves_session *session = chain->asker.session;
    ves_move *move = &chain->move[chain->moves++];
    *move = (ves_move){.proposal = proposal, .share = share};
    move->state = ves_arena_take(&session->arena, (size_t)proposal->room(session->n), sizeof(double));
    if (!move->state) return false;
    proposal->init(session->n, step, move->state);
    return true;
}

bool ves_chain_init(ves_chain *chain, ves_session *session, int index, const ves_anneal *options)
{
    *chain =
        (ves_chain){.adapt = !options->fixed, .cut = !options->fixed, .lowest = HUGE_VAL, .energy = HUGE_VAL};
    ves_asker_init(&chain->asker, session, index);
    uint32_t stream = (uint32_t)session->stage_index << 20 | (uint32_t)index;
    chain->random = (ves_random){.seed = session->seed, .chain = stream};
    if (!points_create(chain, session)) return false;
    if (options->fixed) return move_add(chain, &ves_proposal_gaussian, 1, options->step);
    return move_add(chain, &ves_proposal_gaussian, 0.25, options->step) &&
           move_add(chain, &ves_proposal_heavy, 0.75, options->step);
}

static double energy(const ves_chain *chain, const ves_point *point)
{
    return ves_verdict_energy(&point->verdict, chain->weight, chain->asker.session->tolerance);
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

static void swap(ves_chain *chain)
{
    ves_point moved = chain->current;
    chain->current = chain->candidate;
    chain->candidate = moved;
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

static ves_move *propose(ves_chain *chain)
{
    const ves_session *session = chain->asker.session;
    int n = session->n, k = 0;
    double *u = chain->candidate.u, *x = chain->candidate.x;
    chain->random.draw = 0;
    if (chain->moves > 1) {
        double r = ves_random_uniform(&chain->random);
        while (k < chain->moves - 1 && r >= chain->move[k].share) r -= chain->move[k++].share;
    }
    memcpy(u, chain->current.u, (size_t)n * sizeof *u);
    chain->move[k].proposal->propose(n, chain->move[k].state, &chain->random, u);
    for (int i = 0; i < n; i++)
        x[i] = u[i] == chain->current.u[i] ? chain->current.x[i] : ves_point_scale(session->problem, i, u[i]);
    return &chain->move[k];
}

/* The violation beyond which the candidate is rejected whatever its value, if that is not below all seen by
 * more than a margin. */
static double cutoff(const ves_chain *chain, double limit)
{
    if (!chain->cut || !(chain->weight > 0)) return HUGE_VAL;
    double room = chain->energy + limit - (chain->lowest - chain->margin);
    return chain->asker.session->tolerance + room / chain->weight;
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

ves_status ves_chain_step(ves_chain *chain, double c)
{
    const ves_session *session = chain->asker.session;
    ves_move *move = propose(chain);
    double limit = -c * log(ves_random_uniform(&chain->random));
    if (move->proposal->log_ratio) limit += c * move->proposal->log_ratio(session->n, move->state);
    chain->random.step++;
    VES_TRY(judge(chain, cutoff(chain, limit)));
    double next = energy(chain, &chain->candidate);
    bool accepted = next - chain->energy < limit;
    ves_asker_record(&chain->asker, false, c, accepted);
    remember(chain, &chain->candidate);
    if (accepted) {
        swap(chain);
        chain->energy = next;
    }
    count(chain, move, accepted);
    if (chain->adapt && move->proposal->adapt) move->proposal->adapt(session->n, move->state, accepted);
    return VES_OK;
}

void ves_chain_settle(ves_chain *chain)
{
    bool feasible = chain->best.verdict.violation <= chain->asker.session->tolerance;
    if (!feasible && chain->weight < chain->heaviest) {
        chain->weight *= growth;
        chain->energy = energy(chain, &chain->current);
    }
    chain->trials = chain->accepted = 0;
    chain->mean = chain->square = 0;
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
