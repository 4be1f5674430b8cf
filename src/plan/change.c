/* Change: by how much two designs differ, relative to their numbers; whatever the size of the shape is. */
#include "plan/inside.h"

#include <math.h>
#include <string.h>

/* What is smaller than this share of its natural size is what rounding leaves of a zero. */
static const double NOTHING = 1e-9;

enum { ALONG = 3, AROUND = 8, POINTS = ALONG * AROUND, PLANES = 3 * VES_FIELDS };

/* Diagonal of the box around some points of the design that is bound, m. */
static ves_status diagonal(ves_plan *plan, double *length)
{
    double u[POINTS], v[POINTS], X[PLANES * POINTS], low[3], high[3];
    ves_plan_lattice(ALONG, AROUND, u, v);
    for (int c = 0; c < 3; c++) low[c] = HUGE_VAL, high[c] = -HUGE_VAL;
    for (int p = 0; p < plan->problem->patches; p++) {
        VES_TRY(ves_plan_points(plan, p, POINTS, u, v, X));
        for (int k = 0; k < 3 * POINTS; k++)
            low[k / POINTS] = fmin(low[k / POINTS], X[k]), high[k / POINTS] = fmax(high[k / POINTS], X[k]);
    }
    *length = hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    return VES_OK;
}

/* L^d for a measure in m^d; 0: what a number of other units would naturally be nobody knows. In a file
 * without units numbers are of the order of 1, or of what their degree says. */
static double natural_size(const ves_problem *p, const ves_measure_def *m, double length)
{
    if (p->units) return m->dim.any || m->dim.kg || m->dim.s ? 0 : pow(length, m->dim.m / 6.);
    return m->measure->degree == VES_NO_DEGREE ? 1 : pow(length, m->measure->degree);
}

ves_status ves_plan_sizes(ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    double length;
    VES_TRY(diagonal(plan, &length));
    for (int m = 0; m < p->measures; m++) {
        double size = natural_size(p, &p->measure[m], length);
        plan->natural[m] = isfinite(size) ? size : 0;
    }
    return VES_OK;
}

double ves_plan_measure_size(const ves_plan *plan, int measure)
{
    return plan && measure >= 0 && measure < plan->problem->measures ? plan->natural[measure] : 0;
}

static double relative(double a, double b, double natural)
{
    double size = fmax(fabs(a), fabs(b));
    return size > NOTHING * natural ? fabs(a - b) / size : 0;
}

double ves_plan_measure_change(const ves_plan *plan, int m, double a, double b)
{
    return relative(a, b, plan->natural[m]);
}

/* What the objective is made of: |df/dm| |m|, summed. Where they cancel all but their rounding, nothing is
 * left. */
static double objective_size(ves_plan *plan, const ves_design *at)
{
    const ves_problem *p = plan->problem;
    double sum = 0;
    memset(plan->measure_adjoint, 0, sizeof(double) * (size_t)p->measures);
    memset(plan->unit_row, 0, sizeof(double) * (size_t)p->slots);
    ves_formula_gradient(p->objective, at->slot, at->measure, 1, plan->unit_row, plan->measure_adjoint,
                         plan->formula_room);
    for (int m = 0; m < p->measures; m++)
        sum += fabs(plan->measure_adjoint[m]) * fmax(fabs(at->measure[m]), plan->natural[m]);
    return isfinite(sum) ? sum : 0;
}

double ves_plan_change(ves_plan *plan, const ves_design *a, const ves_design *b)
{
    const ves_problem *p = plan->problem;
    if (a->status != VES_OK || b->status != VES_OK) return NAN;
    double worst = p->objective ? relative(a->objective, b->objective, objective_size(plan, a)) : 0;
    for (int m = 0; m < p->measures; m++)
        worst = fmax(worst, ves_plan_measure_change(plan, m, a->measure[m], b->measure[m]));
    return worst;
}
