#include <math.h>
#include <string.h>

#include "search/anneal.h"
#include "search/spread.h"

/* The warm-up: a look at points all over the box, from which everything follows that has a scale. */

static void explore(void *data, int worker, int index)
{
    ves_annealing *a = data;
    ves_chain *chain = &a->chain[index];
    int m = a->session->m;
    chain->asker.worker = worker;
    for (int d = 0; d < a->draws; d++) {
        ves_status status = ves_chain_explore(chain, &a->start[0].point);
        const ves_verdict *verdict = &chain->candidate.verdict;
        bool measured = status == VES_OK && verdict->status == VES_OK;
        int at = index * a->draws + d;
        a->value[at] = measured ? verdict->value : NAN;
        a->violation[at] = measured ? verdict->violation : NAN;
        for (int j = 0; j < m; j++) a->constraint[at * m + j] = measured ? verdict->constraint[j] : NAN;
    }
}

/* How large violations of constraint j are: the middle one of those that were met. */
static double size_of(ves_annealing *a, int j, int count, double typical)
{
    const ves_session *session = a->session;
    bool equal = ves_session_equality(session, j);
    for (int k = 0; k < count; k++) {
        double g = a->constraint[k * session->m + j];
        a->violation[k] = equal ? fabs(g) : g;
    }
    double size = ves_median_above(a->violation, count, session->tolerance);
    return size > 0 ? size : typical;
}

static void place(ves_annealing *a, const ves_burden *burden, double margin)
{
    for (int k = 0; k < a->chains; k++) {
        ves_chain *chain = &a->chain[k];
        ves_burden *own = &chain->burden;
        own->weight = burden->weight;
        own->most = burden->most;
        own->worst = burden->worst;
        for (int j = 0; j < own->m; j++) own->stiffness[j] = burden->stiffness[j];
        chain->margin = margin;
        bool taken = a->starts > 1 || k == 0 || chain->best.verdict.status != VES_OK;
        ves_chain_place(chain, taken ? &a->start[k % a->starts].point : NULL);
    }
}

/* A violation as large as the middle one costs two spreads. Stiffness: a constraint's own middle one does. Crude: a
 * hundred spreads, whatever the violation is. */
static void weigh(ves_annealing *a, int count, double width, ves_burden *burden)
{
    ves_session *session = a->session;
    double given = a->options.weight;
    double typical = ves_typical(a->violation, count, session->tolerance, session->usual);
    burden->weight = given > 0 ? given : ves_weight(width, typical);
    burden->most = given > 0 ? given : 1e8 * burden->weight;
    for (int j = 0; j < session->m; j++) {
        double size = size_of(a, j, count, typical);
        burden->stiffness[j] = given > 0 ? 2 * given / size : 4 * width / (size * size);
        session->price[j] = fmax(session->price[j], burden->weight);
    }
    if (given == 0 && !strcmp(a->options.constraints, "crude")) burden->weight = 100 * width;
}

/* A step of a tenth of the box changes f by some tenths of its spread over the box: at a first temperature of 0.3
 * spreads most uphill steps are accepted. */
ves_status ves_annealing_warm(ves_annealing *a)
{
    ves_session *session = a->session;
    const ves_anneal *options = &a->options;
    bool needed = options->c0 == 0 || (session->m && options->weight == 0);
    int count = needed ? a->chains * a->draws : 0;
    if (needed) VES_TRY(ves_annealing_round(a, explore));
    double stiffness[1] = {0};
    ves_burden burden = {.worst = a->start[0].point.verdict.value, .stiffness = stiffness};
    if (session->m) burden.stiffness = ves_arena_take(&session->arena, (size_t)session->m, sizeof(double));
    if (!burden.stiffness) return VES_MEMORY;
    int kept = count;
    double width = ves_spread(a->value, &kept);
    if (!(width > 0)) width = fmax(1e-3 * fabs(a->start[0].point.verdict.value), 1e-12);
    if (kept) burden.worst = fmax(burden.worst, a->value[kept - 1]);
    weigh(a, count, width, &burden);
    session->spread = width;
    place(a, &burden, width);
    double c0 = options->c0 > 0 ? options->c0 : 0.3 * width;
    a->cooling.c0 = a->report.c0 = a->report.c = c0;
    a->cooling.c_end = options->c_end * c0;
    return VES_OK;
}
