/* PDE patches: the transpose of sampling. */
#include <string.h>

#include "surface/pde.h"

typedef ves_lanes lanes;

void ves_pde_clear(ves_patch *patch)
{
    pde *p = patch->state;
    memset(p->data_adjoint, 0, sizeof(double) * (size_t)(p->conditions * 3 * ves_curve_stride(p->band)));
    memset(p->parameter_adjoint, 0, sizeof p->parameter_adjoint);
    p->omega_adjoint = 0;
    if (p->spine.terms) memset(p->spine.adjoint, 0, sizeof(double) * (size_t)(3 * p->spine.terms));
}

void ves_pde_clear_chart(ves_chart *chart)
{
    const pde *p = chart->patch->state;
    const pde_chart *c = chart->state;
    memset(c->mode_adjoint, 0, sizeof(double) * (size_t)(9 * ves_curve_stride(p->modes) * c->nup));
    if (p->band > p->modes)
        memset(c->residual_adjoint, 0, sizeof(double) * (size_t)(9 * p->conditions * chart->grid->nv));
}

/* What one field of a tile says of the remainder of coordinate k: carried back to residual curve j, and to
 * the operator or omega. */
static void rest_scatter(ves_chart *chart, const ves_tile *tile, const double *adjoint, int f, int k, int j)
{
    pde *p = chart->patch->state;
    pde_chart *c = chart->state;
    int op = pde_operator(p, k), at = (ves_field_d[f] * p->conditions + j) * c->nup + tile->block;
    size_t curve = (size_t)(((j * 3 + ves_field_e[f]) * 3 + k) * chart->grid->nv);
    const lanes *in = (const lanes *)adjoint;
    const pde_tables *t = &c->tables[op];
    lanes w = *(const lanes *)(t->rest + at), carried = {0};
    for (int row = 0; row < tile->rows; row++) {
        c->residual_adjoint[curve + (size_t)tile->row[row]] += ves_lanes_sum(in[row] * w);
        carried += in[row] * c->residual[curve + (size_t)tile->row[row]];
    }
    int size = 3 * p->conditions * c->nup;
    if (p->def->omega >= 0) {
        if (p->omega_varies)
            p->omega_adjoint += ves_lanes_sum(carried * *(const lanes *)(t->rest_slope + at));
        return;
    }
    for (int i = 0; i < p->parameters && p->op_varies[op]; i++)
        p->parameter_adjoint[op][i] +=
            ves_lanes_sum(carried * *(const lanes *)(t->rest_slope + (size_t)(i * size) + at));
}

void ves_pde_scatter(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint)
{
    pde *p = chart->patch->state;
    pde_chart *c = chart->state;
    ves_synthesis_gradient(&c->synthesis, tile, adjoint, c->mode_adjoint);
    if (p->band == p->modes) return;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int k = 0; k < 3 && tile->fields & 1u << f; k++)
            for (int j = 0; j < p->conditions; j++)
                rest_scatter(chart, tile, adjoint->at[f * 3 + k], f, k, j);
}

#define HOT static inline __attribute__((always_inline))

/* The transpose of modes_product, and the operators' part: the derivative of the table applied to the data.
 * The mean does not depend on the operator; a given spine has taken its place. */
HOT void modes_transpose(pde *p, const pde_chart *c, int K, int orders, int parameters, int first, int last)
{
    int nup = c->nup, width = ves_curve_stride(p->band), mode_stride = ves_curve_stride(p->modes),
        op = pde_operator(p, first);
    const pde_tables *t = &c->tables[op];
    size_t size = (size_t)((p->modes + 1) * 3 * K * nup);
    lanes moved[VES_PARAMETERS_MAX] = {{0}};
    for (int part = p->spine.terms ? 1 : 0; part < mode_stride; part++) {
        size_t table = (size_t)((part + 1) / 2 * 3 * K * nup);
        const double *f = p->data + part;
        lanes sum[3][VES_CONDITIONS_MAX];
        for (int k = first; k < last; k++)
            for (int j = 0; j < K; j++) sum[k][j] = (lanes){0};
        for (int d = 0; d < orders; d++)
            for (int b = 0; b < nup; b += VES_LANES) {
                size_t at = table + (size_t)(d * K * nup + b);
                const double *from = c->mode_adjoint + (size_t)((d * 3 * mode_stride + part) * nup + b);
                for (int k = first; k < last; k++) {
                    lanes g = *(const lanes *)(from + k * mode_stride * nup);
                    for (int j = 0; j < K; j++) sum[k][j] += g * *(const lanes *)(t->table + at + j * nup);
                    for (int i = 0; i < parameters; i++) {
                        const double *slope = t->slope + (size_t)i * size + at;
                        lanes x = {0};
                        for (int j = 0; j < K; j++)
                            x += *(const lanes *)(slope + j * nup) * f[(j * 3 + k) * width];
                        moved[i] += g * x;
                    }
                }
            }
        for (int k = first; k < last; k++)
            for (int j = 0; j < K; j++)
                p->data_adjoint[(j * 3 + k) * width + part] += ves_lanes_sum(sum[k][j]);
    }
    for (int i = 0; i < parameters; i++) p->parameter_adjoint[op][i] += ves_lanes_sum(moved[i]);
}

static void spine_transpose(pde *p, const pde_chart *c)
{
    int nup = c->nup, mode_stride = ves_curve_stride(p->modes), terms = p->spine.terms;
    for (int d = 0; d < c->orders; d++)
        for (int k = 0; k < 3; k++)
            for (int b = 0; b < nup; b += VES_LANES) {
                lanes g = *(const lanes *)(c->mode_adjoint + (size_t)((d * 3 + k) * mode_stride * nup + b));
                for (int q = 0; q < terms; q++)
                    p->spine.adjoint[3 * q + k] +=
                        ves_lanes_sum(g * *(const lanes *)(c->spine + (d * terms + q) * nup + b));
            }
}

static void modes_gather(pde *p, const pde_chart *c)
{
    int K = p->conditions, orders = c->orders, parameters = p->op_varies[0] ? p->parameters : 0;
    if (p->def->operators == 3)
        for (int k = 0; k < 3; k++)
            modes_transpose(p, c, K, orders, p->op_varies[k] ? p->parameters : 0, k, k + 1);
    else if (K == 4 && parameters == 1)
        modes_transpose(p, c, 4, orders, 1, 0, 3);
    else if (K == 4 && parameters == 0)
        modes_transpose(p, c, 4, orders, 0, 0, 3);
    else
        modes_transpose(p, c, K, orders, parameters, 0, 3);
    if (p->spine.terms) spine_transpose(p, c);
}

void ves_pde_gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint)
{
    (void)bound, (void)number_adjoint;
    pde *p = chart->patch->state;
    const pde_chart *c = chart->state;
    modes_gather(p, c);
    int tail = p->band - p->modes, width = ves_curve_stride(p->band), nv = chart->grid->nv;
    for (int j = 0; j < p->conditions && tail; j++)
        for (int k = 0; k < 3; k++)
            for (int m = 0; m < 2 * tail; m++) {
                double sum = 0;
                for (int e = 0; e < 3; e++) {
                    const double *g = c->residual_adjoint + (size_t)(((j * 3 + e) * 3 + k) * nv);
                    const double *w = c->wave + (size_t)((e * 2 * tail + m) * nv);
                    for (int s = 0; s < nv; s++) sum += g[s] * w[s];
                }
                p->data_adjoint[(j * 3 + k) * width + 2 * p->modes + 1 + m] += sum;
            }
}

void ves_pde_unbind(ves_patch *patch, const ves_bound *bound, double *number_adjoint)
{
    pde *p = patch->state;
    const ves_pde *def = p->def;
    int width = ves_curve_stride(p->band);
    ves_pde_spine_unbind(p, number_adjoint);
    for (int k = 0; k < def->operators; k++)
        for (int i = 0; i < p->parameters; i++)
            if (!(p->op[k].fixed >> i & 1))
                number_adjoint[def->parameter[k] + i] += p->parameter_adjoint[k][i];
    if (def->omega >= 0) number_adjoint[def->omega] += p->omega_adjoint;
    for (int j = 0; j < p->conditions; j++) {
        const ves_datum *d = &def->datum[j];
        double scale = d->scale < 0 ? 1 : bound->number[d->scale], by_scale = 0;
        for (int t = 0; t < d->terms; t++) {
            int curve = d->term[t].curve, w = ves_curve_stride(ves_curves_modes(bound->curves, curve));
            double factor = d->term[t].factor, *to = ves_curves_adjoint(bound->curves, curve);
            const double *value = ves_curves_coef(bound->curves, curve);
            for (int k = 0; k < 3; k++)
                for (int m = 0; m < w; m++) {
                    double g = p->data_adjoint[(j * 3 + k) * width + m];
                    if (to) to[k * w + m] += factor * scale * g;
                    by_scale += factor * g * value[k * w + m];
                }
        }
        if (d->scale >= 0) number_adjoint[d->scale] += by_scale;
    }
}
