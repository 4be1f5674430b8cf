/* The reference design: it shows where the outside of each part is, and on it a grid is chosen. The start or,
 * where that cannot be measured or encloses nothing, the first that can and does of some others, the same for
 * every plan of a problem. */
#include "base/random.h"
#include "plan/inside.h"

/* Designs that are looked at; designs that are drawn for them: the others leave the range of some key. */
enum { LOOKS = 32, DRAWS = 2000 };

/* Design t: the start, the middle of the box, and then anywhere in it. Returns a guess of the unknown. */
static double draw(const ves_problem *p, int t, double *x)
{
    ves_random random = {.seed = 1, .step = (uint64_t)t};
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        x[k] = t == 0 ? v->start : v->min + (v->max - v->min) * (t == 1 ? 0.5 : ves_random_uniform(&random));
    }
    double share = t < 2 ? 0.5 : ves_random_uniform(&random);
    return p->solve ? p->solve->lo + (p->solve->hi - p->solve->lo) * share : 0;
}

/* The first patch of a closed part that encloses nothing, or -1. */
static int empty(const ves_plan *plan)
{
    for (int k = 0; k < plan->problem->patches && plan->problem->shape.closed; k++)
        if (!plan->sense[k]) return k;
    return -1;
}

static void place(ves_plan *plan, int t)
{
    double unknown = draw(plan->problem, t, plan->reference);
    ves_plan_bind(plan, plan->reference, unknown);
}

/* Turns the plan outward at the design that is bound and measures that. With solve: the guess only gives the
 * equation its signs; what counts is how the root faces. rank: enclosing counts for more than measurable. */
static ves_status look(ves_plan *plan, int *rank)
{
    VES_TRY(ves_plan_face(plan));
    plan->measured = ves_plan_measure_all(plan, plan->reference, 0);
    if (plan->measured == VES_OK && plan->problem->solve) {
        VES_TRY(ves_plan_face(plan));
        plan->measured = ves_plan_measure_all(plan, plan->reference, 0);
    }
    *rank = 2 * (empty(plan) < 0) + (plan->measured == VES_OK);
    return plan->measured < 0 ? plan->measured : VES_OK;
}

/* A measure that needs to know what is inside, or NULL. */
static const char *needs_inside(const ves_problem *p)
{
    for (int k = 0; k < p->measures; k++) {
        const ves_measure *m = p->measure[k].measure;
        if (m->closed || (m->closes && m->closes(&p->measure[k].args))) return p->measure[k].name;
    }
    return NULL;
}

static ves_status refuse(const ves_plan *plan, bool others, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    const char *measure = needs_inside(p);
    int patch = empty(plan);
    if (patch < 0 || !measure) return VES_OK;
    return ves_diag_add(
        diag, VES_ERROR, VES_SINGULAR, p->shape.mark,
        "\"%s\" needs a shape that encloses something: the part with \"%s\" encloses nothing at "
        "the start%s; begin at a design that encloses a volume",
        measure, p->patch[patch].name, others ? ", nor at any other design that was tried" : "");
}

ves_status ves_plan_refer(ves_plan *plan, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    int best = 0, best_rank = -1, last = 0, looks = 0, most = p->variables || p->solve ? DRAWS : 1;
    for (int t = 0, rank; t < most && looks < LOOKS && best_rank < 3; t++) {
        place(plan, t);
        if (t && ves_plan_limit(plan)) continue;
        VES_TRY(look(plan, &rank));
        looks++, last = t;
        if (rank > best_rank) best = t, best_rank = rank;
    }
    if (best != last) {
        place(plan, best);
        VES_TRY(look(plan, &best_rank));
    }
    return refuse(plan, looks > 1, diag);
}
