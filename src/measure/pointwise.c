#include "measure/pointwise.h"

#include <math.h>

#include "base/domain.h"
#include "formula/formula.h"
#include "measure/principal.h"
#include "measure/summit.h"

/* In the order of the arguments that the reader compiles POINTWISE formulas with. */
enum { AT_X, AT_Y, AT_Z, AT_H, AT_K, AT_K1, AT_K2, AT_U, AT_V, NAMES };

static const ves_formula *formula_of(const ves_measure_input *input)
{
    return input->args->arg[0].formula[0];
}

size_t ves_pointwise_scratch(const ves_measure_input *input)
{
    return (size_t)ves_formula_room(formula_of(input));
}

size_t ves_pointwise_nodes(const ves_measure_input *input)
{
    size_t nodes = 0;
    for (int i = 0; i < input->samples; i++)
        if (input->sample[i]->site == VES_SITE_SURFACE) nodes += (size_t)input->sample[i]->count;
    return nodes;
}

unsigned ves_pointwise_needs(const ves_args *args)
{
    const ves_formula *formula = args->arg[0].formula[0];
    unsigned needs = 0;
    for (int k = AT_X; k <= AT_Z; k++)
        if (ves_formula_uses_argument(formula, k)) needs |= VES_X;
    for (int k = AT_H; k <= AT_K2; k++)
        if (ves_formula_uses_argument(formula, k)) needs |= VES_CURVATURE;
    return needs ? needs : VES_X;
}

ves_pointwise ves_pointwise_init(const ves_measure_input *input)
{
    return (ves_pointwise){input, ves_pointwise_needs(input->args)};
}

/* What the formula does not read stays 0: its planes may be there for others, but not filled. */
static ves_principal fill(const ves_pointwise *p, const ves_samples *s, int n, double at[NAMES])
{
    ves_principal k = {0};
    for (int c = 0; c < 3 && p->needs & VES_X; c++) at[AT_X + c] = s->X[c][n];
    if (p->needs & VES_CURVATURE) {
        k = ves_principal_init(s->H[n], s->K[n]);
        at[AT_H] = s->H[n], at[AT_K] = s->K[n], at[AT_K1] = k.k1, at[AT_K2] = k.k2;
    }
    ves_domain_at(s->u_range, s->v_range, s->u[n % s->nu], s->v[n / s->nu], &at[AT_U]);
    return k;
}

double ves_pointwise_eval(const ves_pointwise *p, const ves_samples *s, int node)
{
    double at[NAMES] = {0};
    fill(p, s, node, at);
    return ves_formula_eval(formula_of(p->input), p->input->number, at, p->input->room);
}

double ves_pointwise_gradient(const ves_pointwise *p, const ves_samples *s, int node, double weight,
                              const ves_adjoint *adjoint, double *number_adjoint)
{
    double at[NAMES] = {0}, g[NAMES] = {0};
    ves_principal k = fill(p, s, node, at);
    double value = ves_formula_gradient(formula_of(p->input), p->input->number, at, weight, number_adjoint, g,
                                        p->input->room);
    for (int c = 0; c < 3 && p->needs & VES_X && adjoint->X[0]; c++) adjoint->X[c][node] += g[AT_X + c];
    if (!(p->needs & VES_CURVATURE) || !adjoint->H) return value;
    adjoint->H[node] += g[AT_H];
    adjoint->K[node] += g[AT_K];
    ves_principal_gradient(&k, g[AT_K1], g[AT_K2], &adjoint->H[node], &adjoint->K[node]);
    return value;
}

typedef struct signed_formula {
    ves_pointwise pointwise;
    double sign;
} signed_formula;

static double height(const void *of, const ves_samples *s, int node)
{
    const signed_formula *f = of;
    return f->sign * ves_pointwise_eval(&f->pointwise, s, node);
}

ves_status ves_pointwise_largest(const ves_measure_input *input, double sign, double *room, double *value)
{
    const signed_formula f = {ves_pointwise_init(input), sign};
    return ves_summit_find(input, height, &f, room, value);
}
