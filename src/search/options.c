#include <math.h>
#include <string.h>

#include "search/algorithms.h"
#include "search/session.h"
#include "search/slots.h"

/* Of one stage or of the whole search: sums of these do not overflow. */
static const long most_evaluations = 1L << 53;

ves_anneal ves_anneal_default(void)
{
    return (ves_anneal){0};
}

ves_polish ves_polish_default(void)
{
    return (ves_polish){0};
}

ves_search_options ves_search_options_default(void)
{
    return (ves_search_options){.seed = 1};
}

static ves_status check_start(const ves_search_problem *problem, const double *start)
{
    for (int i = 0; i < problem->n; i++)
        if (!(start[i] >= problem->lower[i] && start[i] <= problem->upper[i])) return VES_RANGE;
    return VES_OK;
}

static ves_status check_box(const ves_search_problem *problem)
{
    if (problem->n < 1 || problem->m < 0 || problem->workers < 0 || !problem->evaluate) return VES_RANGE;
    if (!problem->lower || !problem->upper || !problem->start || problem->tolerance < 0) return VES_RANGE;
    if (problem->others < 0 || (problem->others && !problem->other)) return VES_RANGE;
    for (int i = 0; i < problem->n; i++) {
        double lower = problem->lower[i], upper = problem->upper[i];
        if (!isfinite(lower) || !isfinite(upper) || !isfinite(upper - lower) || !(lower < upper))
            return VES_RANGE;
    }
    VES_TRY(check_start(problem, problem->start));
    for (int k = 0; k < problem->others; k++) VES_TRY(check_start(problem, problem->other[k]));
    return VES_OK;
}

static bool bad(double value)
{
    return !(value >= 0 && isfinite(value));
}

static bool bad_budget(long evaluations)
{
    return evaluations < 0 || evaluations > most_evaluations;
}

static ves_status check_anneal(const ves_anneal *a)
{
    if (bad_budget(a->evaluations) || a->chains < 0 || a->chains > VES_CHAINS) return VES_RANGE;
    if (bad(a->c0) || bad(a->c_end) || bad(a->step) || bad(a->weight)) return VES_RANGE;
    bool ranges = a->c_end <= 1 && a->step <= 1 && a->s >= 0 && a->s < 1;
    return ranges && ves_slots_check(a) ? VES_OK : VES_RANGE;
}

static ves_status check_polish(const ves_polish *p)
{
    if (bad_budget(p->evaluations) || p->starts < 0 || bad(p->x_tolerance) || bad(p->f_tolerance))
        return VES_RANGE;
    const ves_algorithm *a = ves_search_algorithms();
    while (p->algorithm && a->name && strcmp(a->name, p->algorithm)) a++;
    return a->name ? VES_OK : VES_RANGE;
}

static ves_status check_auto(const ves_auto *a)
{
    return ves_slots_known(VES_SLOT_STRATEGY, a->only) && !bad_budget(a->evaluations) ? VES_OK : VES_RANGE;
}

ves_status ves_search_check(const ves_search_problem *problem, const ves_search_options *options)
{
    VES_TRY(check_box(problem));
    if (options->stages < 0 || options->stages > VES_STAGES || bad_budget(options->evaluations))
        return VES_RANGE;
    if (bad(options->gradient) || (options->gradient > 0 && options->gradient < 1)) return VES_RANGE;
    for (int k = 0; k < options->stages; k++) {
        const ves_stage *stage = &options->stage[k];
        if (stage->kind == VES_STAGE_ANNEAL)
            VES_TRY(check_anneal(&stage->anneal));
        else if (stage->kind == VES_STAGE_POLISH)
            VES_TRY(check_polish(&stage->polish));
        else if (stage->kind == VES_STAGE_AUTO)
            VES_TRY(check_auto(&stage->automatic));
        else
            return VES_RANGE;
    }
    return VES_OK;
}

const char *ves_search_algorithm(const ves_search_problem *problem, const ves_polish *polish)
{
    if (polish->algorithm) return polish->algorithm;
    if (problem->gradients) return "slsqp";
    return problem->m || problem->n < 2 ? "cobyla" : "bobyqa";
}

/* What a polish may cost. Superlinear methods need some tens of steps; models without gradients a few hundred
 * for each variable; differences pay n + 1 evaluations for each step. */
static long polish_budget(const ves_search_problem *problem, const ves_polish *polish, int starts)
{
    double n = problem->n, steps = 500 + 40 * n;
    const char *name = ves_search_algorithm(problem, polish);
    bool gradient = ves_recipe_find(name, problem->n, problem->gradients).gradient;
    if (!strcmp(name, "mma") || !strcmp(name, "ccsa")) steps *= 5; /* of first order */
    if (!gradient)
        steps = 2000 + 400 * n;
    else if (!problem->gradients)
        steps *= (n + 1) / 2;
    double all = starts * steps;
    return all < (double)most_evaluations ? (long)all : most_evaluations;
}

/* What stays 0 is found from the data. */
static void complete_anneal(ves_anneal *a, int n, bool followed)
{
    ves_slots_complete(a, followed);
    if (!a->evaluations) a->evaluations = 2000 + 2000 * (long)n;
    if (a->step == 0) a->step = 0.1;
}

void ves_search_complete_polish(const ves_search_problem *problem, ves_polish *p, int ends)
{
    if (!p->starts || p->starts > ends) p->starts = ends;
    if (!p->evaluations) p->evaluations = polish_budget(problem, p, p->starts);
    p->algorithm = ves_search_algorithm(problem, p);
    if (p->x_tolerance == 0) p->x_tolerance = 1e-9;
    if (p->f_tolerance == 0) p->f_tolerance = 1e-12;
}

static long asked(const ves_stage *stage)
{
    switch (stage->kind) {
    case VES_STAGE_ANNEAL:
        return stage->anneal.evaluations;
    case VES_STAGE_POLISH:
        return stage->polish.evaluations;
    case VES_STAGE_AUTO:
        return stage->automatic.evaluations;
    }
    return 0;
}

enum { AUTO_STARTS = 16 }; /* polished in the end */
enum {
    FEW = 16
}; /* times n + 2: less of a budget is for one descent, which a portfolio would only cut short */

/* A portfolio, and a last polish of the best of its ends, each of which a descent has been to already. */
static void automatic(ves_session *session, const ves_search_options *options)
{
    ves_polish polish = {.starts = AUTO_STARTS};
    ves_stage *stage = session->stage;
    long whole = options->evaluations, usual = polish_budget(session->problem, &polish, AUTO_STARTS);
    if (whole && whole < FEW * ((long)session->n + 2)) {
        session->lone = true;
        session->stages = 1;
        stage[0] = (ves_stage){.kind = VES_STAGE_POLISH, .polish.evaluations = whole};
        return;
    }
    if (whole) polish.evaluations = whole / 10 < usual ? whole / 10 : usual;
    session->stages = 2;
    stage[0] =
        (ves_stage){.kind = VES_STAGE_AUTO, .automatic.evaluations = whole ? whole - polish.evaluations : 0};
    stage[1] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = polish};
}

/* Fills in every default, so that the stages need not. */
void ves_search_complete(ves_session *session, const ves_search_options *options)
{
    const ves_search_problem *problem = session->problem;
    session->stages = options->stages;
    memcpy(session->stage, options->stage, sizeof session->stage);
    if (!options->stages) automatic(session, options);
    long sum = 0;
    int ends = 1 + problem->others;
    for (int k = 0; k < session->stages; k++) {
        ves_stage *stage = &session->stage[k];
        session->grows[k] = options->evaluations && !asked(stage);
        session->saves[k] = !options->evaluations && !asked(stage);
        if (stage->kind == VES_STAGE_AUTO) {
            if (!stage->automatic.evaluations) stage->automatic.evaluations = 2000 + 2000 * (long)problem->n;
            ends = AUTO_STARTS;
            sum += stage->automatic.evaluations;
        } else if (stage->kind == VES_STAGE_ANNEAL) {
            bool followed = k + 1 < session->stages && session->stage[k + 1].kind == VES_STAGE_POLISH;
            complete_anneal(&stage->anneal, problem->n, followed);
            ends = stage->anneal.chains;
            sum += stage->anneal.evaluations;
        } else {
            ves_search_complete_polish(problem, &stage->polish, ends);
            ends = stage->polish.starts;
            sum += stage->polish.evaluations;
        }
    }
    long whole = options->evaluations, part = whole / 20;
    session->budget = whole ? whole : sum + 1 + VES_PROOFS; /* and the start */
    session->reserved = !whole || part > VES_PROOFS ? VES_PROOFS : part ? part : whole > 1;
}

/* What is left of the whole budget is shared in proportion to what the stages to come would take by
 * themselves, so that what one does not use goes to the next. A stage grows beyond that only when a budget
 * for the whole search was given and none for it. */
long ves_search_share(const ves_session *session, int stage)
{
    long left = ves_session_left(session), own = asked(&session->stage[stage]);
    double sum = 0;
    for (int k = stage; k < session->stages; k++) sum += (double)asked(&session->stage[k]);
    long share = stage == session->stages - 1 ? left : (long)((double)left * ((double)own / sum));
    return session->grows[stage] || share < own ? share : own;
}
