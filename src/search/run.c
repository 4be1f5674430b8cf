#include "search/session.h"

/* The one loop: stages one after another, each from the ends of the one before. */

static ves_status stage_run(ves_session *session, int k, long budget)
{
    session->stage_index = k;
    const ves_stage *stage = &session->stage[k];
    switch (stage->kind) {
    case VES_STAGE_ANNEAL:
        return ves_anneal_run(session, &stage->anneal, budget);
    case VES_STAGE_POLISH:
        return ves_polish_run(session, &stage->polish, budget);
    case VES_STAGE_AUTO:
        return ves_portfolio_run(session, &stage->automatic, budget);
    }
    return VES_FAULT;
}

static ves_status work(ves_session *session)
{
    VES_TRY(ves_search_begin(session));
    if (session->fault) return session->fault;
    if (!session->ends) {
        ves_session_stop(session, VES_ENDED_DONE, "no candidate could be measured");
        return VES_OK;
    }
    for (int k = 0; k < session->stages; k++) {
        if (ves_session_over(session)) return session->fault;
        long budget = ves_search_share(session, k);
        if (budget > 0) {
            if (session->lone)
                ves_session_note(session,
                                 "the budget of %ld evaluations is for one descent from the start: other "
                                 "minima were not looked for",
                                 session->budget);
            VES_TRY(stage_run(session, k, budget));
            continue;
        }
        session->ending = VES_ENDED_BUDGET;
        ves_session_note(session, "the budget (%ld in all) left no evaluations for stage %d", session->budget,
                         k + 1);
    }
    return session->fault ? session->fault : ves_search_doubt(session);
}

ves_status ves_search_run(const ves_search_problem *problem, const ves_search_options *options,
                          const ves_search_hooks *hooks, ves_search_result **result)
{
    *result = NULL;
    ves_search_options defaults = ves_search_options_default();
    if (!options) options = &defaults;
    VES_TRY(ves_search_check(problem, options));
    ves_session session;
    ves_search_problem values = *problem;
    values.gradients = problem->gradients && !(options->gradient > problem->n + 1);
    ves_status status = ves_session_init(&session, &values, options, hooks);
    if (status == VES_OK) status = work(&session);
    if (status == VES_OK || status == VES_INTERRUPTED) {
        if (session.fault)
            status = session.fault;
        else
            status = ves_search_finish(&session, result);
    }
    ves_session_destroy(&session);
    return status;
}
