/* PDE patches: binding, tables, sampling. See pde.h. */
#include "surface/pde.h"

#include <math.h>
#include <string.h>

#include "curve/modes.h"

typedef ves_lanes lanes;

/* Spectra of splines fall like n^-4: what lies below this share moves the surface by less than 1e-5 of its
 * size, near its ends only. */
static const double SIGNIFICANT = 1e-5;

enum { HALVINGS = 40 };

static bool number_varies(const ves_bound *bound, int index)
{
    return index >= 0 && bound->varying[index];
}

/* F_j = scale * sum of factor * curve */
static void datum_bind(const pde *p, int j, const ves_bound *bound)
{
    const ves_datum *d = &p->def->datum[j];
    double scale = d->scale < 0 ? 1 : bound->number[d->scale];
    int width = ves_curve_stride(p->band);
    double *out = p->data + (size_t)(j * 3 * width);
    memset(out, 0, sizeof(double) * (size_t)(3 * width));
    for (int t = 0; t < d->terms; t++) {
        double f = scale * d->term[t].factor;
        int w = ves_curve_stride(ves_curves_modes(bound->curves, d->term[t].curve));
        const double *c = ves_curves_coef(bound->curves, d->term[t].curve);
        for (int k = 0; k < 3; k++)
            for (int m = 0; m < w; m++) out[k * width + m] += f * c[k * w + m];
    }
}

static void operators_bind(pde *p, const ves_bound *bound)
{
    double t;
    p->status = VES_OK;
    for (int k = 0; k < p->def->operators; k++) {
        memcpy(p->op[k].parameter, bound->number + p->def->parameter[k],
               sizeof(double) * (size_t)p->parameters);
        if (!ves_operator_measure(&p->op[k]).solvable) p->status = VES_UNDETERMINED;
        if (!ves_operator_elliptic(&p->op[k], &t)) p->status = VES_NOT_ELLIPTIC;
    }
    if (p->def->omega >= 0) p->rest.parameter[0] = bound->number[p->def->omega];
}

static void pde_bind(ves_patch *patch, const ves_bound *bound)
{
    pde *p = patch->state;
    for (int j = 0; j < p->conditions; j++) datum_bind(p, j, bound);
    operators_bind(p, bound);
    ves_pde_spine_bind(p, bound);
}

static ves_status chart_memory(const pde *p, pde_chart *c, int nv, ves_arena *arena)
{
    long mode = 9L * ves_curve_stride(p->modes) * c->nup, tail = p->band - p->modes;
    long residual = tail ? 3L * p->conditions * 3 * nv : 0;
    VES_TRY(ves_pde_tables_create(p, c->nup, arena, c->tables));
    c->u = ves_arena_doubles(arena, (size_t)c->nup);
    c->spine = ves_arena_doubles(arena, (size_t)(3 * p->spine.terms * c->nup));
    c->mode = ves_arena_doubles(arena, (size_t)mode);
    c->mode_adjoint = ves_arena_doubles(arena, (size_t)mode);
    c->residual = ves_arena_doubles(arena, (size_t)residual);
    c->residual_adjoint = ves_arena_doubles(arena, (size_t)residual);
    c->wave = ves_arena_doubles(arena, (size_t)(6 * tail * nv));
    c->room = ves_arena_doubles(arena, (size_t)ves_weights_room(&p->layout, c->nup));
    return c->u && c->spine && c->mode && c->mode_adjoint && c->residual && c->residual_adjoint && c->wave &&
                   c->room
               ? VES_OK
               : VES_MEMORY;
}

static ves_status pde_chart_create(ves_patch *patch, ves_chart *chart, ves_arena *arena)
{
    pde *p = patch->state;
    const ves_grid *grid = chart->grid;
    pde_chart *c = ves_arena_take(arena, 1, sizeof *c);
    if (!c) return VES_MEMORY;
    c->nup = ves_padded(grid->nu);
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        if (chart->fields & 1u << f && ves_field_d[f] >= c->orders) c->orders = ves_field_d[f] + 1;
    VES_TRY(chart_memory(p, c, grid->nv, arena));
    pde_places(grid->nu, grid->u, c->nup, c->u);
    ves_pde_spine_basis(p, c->nup, c->u, c->spine);
    int tail = p->band - p->modes;
    for (int e = 0; e < 3; e++)
        for (int n = p->modes + 1; n <= p->band; n++)
            for (int j = 0; j < grid->nv; j++) {
                double *w = c->wave + (size_t)(((e * tail + n - p->modes - 1) * 2) * grid->nv);
                ves_wave(n, grid->v[j], e, &w[j], &w[grid->nv + j]);
            }
    chart->state = c;
    return ves_synthesis_create(grid, p->modes, arena, &c->synthesis);
}

static void pde_move(ves_chart *chart)
{
    const pde *p = chart->patch->state;
    pde_chart *c = chart->state;
    const ves_grid *grid = chart->grid;
    int tail = p->band - p->modes, nv = grid->nv;
    pde_places(grid->nu, grid->u, c->nup, c->u);
    ves_synthesis_move(&c->synthesis);
    for (int j = 0; j < nv && tail; j++) {
        const double step[2] = {cos(grid->v[j]), sin(grid->v[j])};
        double z[2] = {cos(p->modes * grid->v[j]), sin(p->modes * grid->v[j])};
        for (int k = 0; k < tail; k++) {
            double n = p->modes + 1 + k, *w = c->wave + (size_t)(2 * k * nv + j);
            int next = 2 * tail * nv; /* to the next derivative */
            ves_turn(z, step);
            w[0] = z[0], w[nv] = z[1];
            w[next] = -n * z[1], w[next + nv] = n * z[0];
            w[2 * next] = -n * n * z[0], w[2 * next + nv] = -n * n * z[1];
        }
    }
    ves_pde_spine_basis(p, c->nup, c->u, c->spine);
    for (int k = 0; k < p->def->operators; k++) c->tables[k].fresh = false;
    c->binding = -1;
}

#define HOT static inline __attribute__((always_inline))

/* A = W F, two products a mode: cosine and sine. K conditions, derivatives 0 .. orders - 1. Coordinates
 * first .. last - 1 share the table. */
HOT void modes_product(const pde *p, const pde_chart *c, int K, int orders, int first, int last)
{
    int nup = c->nup, width = ves_curve_stride(p->band), mode_stride = ves_curve_stride(p->modes);
    const double *tables = c->tables[pde_operator(p, first)].table;
    for (int part = 0; part < mode_stride; part++) {
        const double *f = p->data + part, *table = tables + (size_t)((part + 1) / 2 * 3 * K * nup);
        double g[3][VES_CONDITIONS_MAX];
        for (int k = first; k < last; k++)
            for (int j = 0; j < K; j++) g[k][j] = f[(j * 3 + k) * width];
        for (int d = 0; d < orders; d++)
            for (int b = 0; b < nup; b += VES_LANES) {
                const double *w = table + d * K * nup + b;
                double *to = c->mode + (size_t)((d * 3 * mode_stride + part) * nup + b);
                for (int k = first; k < last; k++) {
                    lanes sum = *(const lanes *)w * g[k][0];
                    for (int j = 1; j < K; j++) sum += *(const lanes *)(w + j * nup) * g[k][j];
                    *(lanes *)(to + k * mode_stride * nup) = sum;
                }
            }
    }
}

/* A_0 is the given spine. */
static void spine_product(const pde *p, const pde_chart *c)
{
    int nup = c->nup, mode_stride = ves_curve_stride(p->modes), terms = p->spine.terms;
    for (int d = 0; d < c->orders; d++)
        for (int k = 0; k < 3; k++)
            for (int b = 0; b < nup; b += VES_LANES) {
                lanes sum = {0};
                for (int q = 0; q < terms; q++)
                    sum += *(const lanes *)(c->spine + (d * terms + q) * nup + b) * p->spine.point[3 * q + k];
                *(lanes *)(c->mode + (size_t)((d * 3 + k) * mode_stride * nup + b)) = sum;
            }
}

static void modes_eval(const pde *p, const pde_chart *c)
{
    if (p->def->operators == 3)
        for (int k = 0; k < 3; k++) modes_product(p, c, p->conditions, c->orders, k, k + 1);
    else if (p->conditions == 4)
        modes_product(p, c, 4, c->orders, 0, 3);
    else if (p->conditions == 2)
        modes_product(p, c, 2, c->orders, 0, 3);
    else
        modes_product(p, c, p->conditions, c->orders, 0, 3);
    if (p->spine.terms) spine_product(p, c);
}

static void residual_eval(const pde *p, const pde_chart *c, int nv)
{
    int tail = p->band - p->modes, width = ves_curve_stride(p->band);
    for (int j = 0; j < p->conditions; j++)
        for (int e = 0; e < 3; e++)
            for (int k = 0; k < 3; k++) {
                double *restrict out = c->residual + (size_t)(((j * 3 + e) * 3 + k) * nv);
                const double *f = p->data + (j * 3 + k) * width + 2 * p->modes + 1;
                memset(out, 0, sizeof(double) * (size_t)nv);
                for (int m = 0; m < 2 * tail; m++) {
                    if (f[m] == 0) continue;
                    const double *restrict w = c->wave + (size_t)((e * 2 * tail + m) * nv);
                    for (int s = 0; s < nv; s++) out[s] += f[m] * w[s];
                }
            }
}

static ves_status pde_prepare(ves_chart *chart, const ves_bound *bound, bool gradient)
{
    (void)bound;
    const pde *p = chart->patch->state;
    pde_chart *c = chart->state;
    for (int k = 0; k < p->def->operators; k++)
        VES_TRY(ves_pde_tables_make(p, k, c->nup, c->u, gradient, &c->tables[k], c->room));
    if (c->binding != chart->patch->binding) {
        modes_eval(p, c);
        if (p->band > p->modes) residual_eval(p, c, chart->grid->nv);
        c->binding = chart->patch->binding;
    }
    return VES_OK;
}

static void pde_sample(const ves_chart *chart, const ves_tile *tile, ves_tile_planes *field)
{
    const pde *p = chart->patch->state;
    const pde_chart *c = chart->state;
    ves_synthesis_eval(&c->synthesis, c->mode, tile, field);
    if (p->band == p->modes) return;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int k = 0; k < 3 && tile->fields & 1u << f; k++) {
            lanes *out = (lanes *)field->at[f * 3 + k];
            for (int j = 0; j < p->conditions; j++) {
                lanes w = *(const lanes *)(c->tables[pde_operator(p, k)].rest +
                                           (ves_field_d[f] * p->conditions + j) * c->nup + tile->block);
                const double *r =
                    c->residual + (size_t)(((j * 3 + ves_field_e[f]) * 3 + k) * chart->grid->nv);
                for (int row = 0; row < tile->rows; row++) out[row] += w * r[tile->row[row]];
            }
        }
}

/* The largest share of a condition's data, mean left out, that lies beyond the modes solved. */
static double pde_tail(const ves_patch *patch)
{
    const pde *p = patch->state;
    int width = ves_curve_stride(p->band);
    double largest = 0;
    for (int j = 0; j < p->conditions; j++) {
        double all = 0, rest = 0;
        for (int c = 0; c < 3; c++)
            for (int k = 1; k < width; k++) {
                double f = p->data[(j * 3 + c) * width + k];
                all += f * f;
                if (k > 2 * p->modes) rest += f * f;
            }
        if (all > 0) largest = fmax(largest, sqrt(rest / all));
    }
    return largest;
}

static ves_status pde_status(const ves_patch *patch)
{
    const pde *p = patch->state;
    return p->status;
}

static const ves_layout *pde_layout(const ves_patch *patch)
{
    const pde *p = patch->state;
    return &p->layout;
}

/* lam: NAN, or the operator is (d_uu + lam^2 d_vv)^N. */
static bool pde_amplification(const ves_patch *patch, double n, double lam, ves_amplification *found)
{
    const pde *p = patch->state;
    ves_operator power = {.power = p->layout.power, .parameter = {lam}};
    *found = (ves_amplification){.solvable = true};
    for (int k = 0; k < (isnan(lam) ? p->def->operators : 1); k++) {
        ves_amplification one;
        ves_status status = ves_weights_amplification(&p->layout, isnan(lam) ? &p->op[k] : &power, n, &one);
        found->amplified = fmax(found->amplified, one.amplified);
        found->lebesgue = fmax(found->lebesgue, one.lebesgue);
        found->condition = fmax(found->condition, one.condition);
        found->lam = fmax(found->lam, one.lam);
        found->free = found->free || one.free;
        found->solvable = found->solvable && one.solvable && status == VES_OK;
    }
    return true;
}

static const ves_patch_ops PDE = {.chart = pde_chart_create,
                                  .move = pde_move,
                                  .bind = pde_bind,
                                  .prepare = pde_prepare,
                                  .sample = pde_sample,
                                  .clear = ves_pde_clear,
                                  .clear_chart = ves_pde_clear_chart,
                                  .scatter = ves_pde_scatter,
                                  .gather = ves_pde_gather,
                                  .unbind = ves_pde_unbind,
                                  .point_room = ves_pde_point_room,
                                  .point = ves_pde_point,
                                  .spine = ves_pde_spine_points,
                                  .tail = pde_tail,
                                  .status = pde_status,
                                  .layout = pde_layout,
                                  .amplification = pde_amplification};

static int widest(const ves_datum *datum, int count, const ves_curves *curves)
{
    int band = 0;
    for (int j = 0; j < count; j++)
        for (int t = 0; t < datum[j].terms; t++) {
            int modes = ves_curves_modes(curves, datum[j].term[t].curve);
            if (modes > band) band = modes;
        }
    return band;
}

/* The highest mode of the data, at the design that is bound, above SIGNIFICANT of its condition's largest. */
static int significant(const pde *p)
{
    int width = ves_curve_stride(p->band), highest = 0;
    for (int j = 0; j < p->conditions; j++) {
        double largest = 0;
        for (int k = 1; k < width; k++)
            for (int c = 0; c < 3; c++) largest = fmax(largest, fabs(p->data[(j * 3 + c) * width + k]));
        for (int k = 1; k < width; k++)
            for (int c = 0; c < 3; c++)
                if (fabs(p->data[(j * 3 + c) * width + k]) > SIGNIFICANT * largest && (k + 1) / 2 > highest)
                    highest = (k + 1) / 2;
    }
    return highest;
}

/* Nothing is amplified, and all can be solved. */
static bool regular(const pde *p)
{
    return !p->def->general && ves_layout_regular(&p->layout);
}

/* Can mode n be solved, and with conditions inside, does it come out at most `most` times as large? */
static bool mild(const ves_patch *patch, double n, double most)
{
    const pde *p = patch->state;
    ves_amplification found;
    pde_amplification(patch, n, NAN, &found);
    return found.solvable && (found.amplified <= most || ves_layout_depth(&p->layout) == 0);
}

/* With conditions inside the patch mode n is amplified about e^(lam u_N) times, and where roots wave some modes much
 * more than their neighbours: the modes, up to `most`, before the first that comes out more than
 * VES_PATCH_AMPLIFIED times as large. */
static int harmless(const ves_patch *patch, int most)
{
    int n = 1;
    if (regular(patch->state)) return most;
    while (n <= most && mild(patch, n, VES_PATCH_AMPLIFIED)) n++;
    return n - 1;
}

/* The remainder is taken as the first mode that is not solved; where that one cannot be solved, or is amplified more
 * than the first of those chosen may be, as a lower one, not whole, that is harmless. */
static void rest_choose(ves_patch *patch)
{
    ves_amplification zero;
    const pde *p = patch->state;
    double least = VES_PATCH_AMPLIFIED, most = p->def->modes > 0 ? HUGE_VAL : least * least;
    patch->rest = p->modes + 1;
    if (p->status != VES_OK || p->def->omega >= 0 || p->band == p->modes || regular(p)) return;
    pde_amplification(patch, 0, NAN, &zero);
    least = fmax(least, 2 * zero.amplified), most = fmax(most, least);
    for (int k = 0; k < HALVINGS && zero.solvable && !mild(patch, patch->rest, k ? least : most); k++)
        patch->rest /= 2;
}

static void modes_choose(ves_patch *patch)
{
    pde *p = patch->state;
    int highest = significant(p), most = highest > VES_PATCH_MODES ? highest : VES_PATCH_MODES;
    if (p->def->modes > 0) most = p->def->modes;
    if (most > p->band) most = p->band;
    p->modes = p->def->modes > 0 || p->status != VES_OK ? most : harmless(patch, most);
    patch->modes = p->modes;
    rest_choose(patch);
    p->rest_mode = patch->rest;
}

/* What moves with the variables. */
static bool varies_find(pde *p, const ves_bound *bound)
{
    const ves_pde *def = p->def;
    bool varies = p->omega_varies = number_varies(bound, def->omega);
    for (int k = 0; k < def->operators; k++)
        for (int i = 0; i < p->parameters; i++) {
            bool moves = number_varies(bound, def->parameter[k] + i);
            p->op_varies[k] = p->op_varies[k] || moves;
            if (!moves) p->op[k].fixed |= 1U << i;
        }
    for (int k = 0; k < def->operators; k++) varies = varies || p->op_varies[k];
    for (int j = 0; j < p->conditions; j++) {
        varies = varies || number_varies(bound, def->datum[j].scale);
        for (int t = 0; t < def->datum[j].terms; t++)
            varies = varies || ves_curves_varies(bound->curves, def->datum[j].term[t].curve);
    }
    for (int k = 0; k < 3 * def->spine.count; k++)
        varies = varies || number_varies(bound, def->spine.first + k);
    return varies;
}

ves_status ves_patch_pde(const ves_pde *def, const ves_bound *bound, ves_arena *arena, ves_patch **patch)
{
    *patch = NULL;
    pde *p = ves_arena_take(arena, 1, sizeof *p);
    ves_patch *made = ves_arena_take(arena, 1, sizeof *made);
    if (!p || !made) return VES_MEMORY;
    *p = (pde){.def = def, .layout = def->layout, .conditions = 2 * def->layout.power};
    for (int k = 0; k < def->operators; k++)
        p->op[k] = (ves_operator){.power = def->layout.power, .general = def->general};
    p->rest = (ves_operator){.power = def->layout.power};
    p->parameters = ves_operator_parameters(&p->op[0]);
    *made = (ves_patch){.ops = &PDE, .periodic = true, .varies = varies_find(p, bound), .state = p};
    made->band = p->band = widest(def->datum, p->conditions, bound->curves);
    size_t size = (size_t)(p->conditions * 3 * ves_curve_stride(p->band));
    p->data = ves_arena_doubles(arena, size);
    p->data_adjoint = ves_arena_doubles(arena, size);
    if (!p->data || !p->data_adjoint) return VES_MEMORY;
    VES_TRY(ves_pde_spine_create(p, bound, arena));
    pde_bind(made, bound);
    modes_choose(made);
    *patch = made;
    return VES_OK;
}
