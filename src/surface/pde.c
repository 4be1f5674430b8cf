/* PDE patches. Modes 0 .. M are solved one by one, A_n(u) = sum_j W_n(u)[j] F_n[j]; what the data have beyond
 * M is synthesised as residual curves r_j(v) and carried across the patch by one more weight table at lam = a
 * (M + 1). */
#include "surface/kind.h"

#include <math.h>
#include <string.h>

#include "curve/modes.h"

typedef ves_lanes lanes;

typedef struct pde {
    ves_layout layout;
    ves_datum datum[VES_CONDITIONS_MAX];
    int conditions;
    int a;          /* number block index */
    double a_value; /* of the current binding */
    bool a_varies;
    int modes, band;      /* M and the data's band limit */
    double *data;         /* [conditions][3][1 + 2 band]: F */
    double *data_adjoint; /* same shape */
    double a_adjoint;
} pde;

typedef struct pde_chart {
    int nup;
    int orders;              /* derivatives along u that the chart's fields need: 0 .. orders - 1 */
    double *u;               /* nup places: the grid's, the last one repeated */
    double *table, *table_a; /* weights of modes 0 .. M and their derivative */
    double *rest, *rest_a;   /* weights of the remainder [3][conditions][nup] */
    double *mode, *mode_adjoint;
    double *residual, *residual_adjoint; /* [conditions][e][3][nv] */
    double *wave;                        /* [e][n - M - 1][cos, sin][nv] for n > M */
    double *room;
    ves_synthesis synthesis;
    double a_table; /* a of the tables, NAN: none yet */
    bool has_table_a, has_zero_a;
    long binding;
} pde_chart;

/* Spectra of splines fall like n^-4: what lies below this share moves the surface by less than 1e-5 of its
 * size, near its ends only. */
static const double SIGNIFICANT = 1e-5;

static int stride(int modes)
{
    return 1 + 2 * modes;
}

static bool number_varies(const ves_bound *bound, int index)
{
    return index >= 0 && bound->varying[index];
}

/* F_j = scale * (curve - from) */
static void datum_bind(const pde *p, int j, const ves_bound *bound)
{
    const ves_datum *d = &p->datum[j];
    double scale = d->scale < 0 ? 1 : bound->number[d->scale];
    int width = stride(p->band);
    double *out = p->data + (size_t)(j * 3 * width);
    memset(out, 0, sizeof(double) * (size_t)(3 * width));
    for (int side = 0; side < 2; side++) {
        int curve = side ? d->from : d->curve;
        if (curve < 0) continue;
        double f = side ? -scale : scale;
        int w = stride(ves_curves_modes(bound->curves, curve));
        const double *c = ves_curves_coef(bound->curves, curve);
        for (int k = 0; k < 3; k++)
            for (int m = 0; m < w; m++) out[k * width + m] += f * c[k * w + m];
    }
}

static void pde_bind(ves_patch *patch, const ves_bound *bound)
{
    pde *p = patch->state;
    for (int j = 0; j < p->conditions; j++) datum_bind(p, j, bound);
    p->a_value = bound->number[p->a];
}

static void places_fill(pde_chart *c, const ves_grid *grid)
{
    for (int i = 0; i < c->nup; i++) c->u[i] = grid->u[i < grid->nu ? i : grid->nu - 1];
}

static ves_status pde_chart_create(ves_patch *patch, ves_chart *chart, ves_arena *arena)
{
    pde *p = patch->state;
    const ves_grid *grid = chart->grid;
    pde_chart *c = ves_arena_take(arena, 1, sizeof *c);
    if (!c) return VES_MEMORY;
    c->nup = ves_padded(grid->nu);
    c->a_table = NAN;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        if (chart->fields & 1u << f && ves_field_d[f] >= c->orders) c->orders = ves_field_d[f] + 1;
    long table = ves_weights_size(&p->layout, p->modes, c->nup), rest = 3L * p->conditions * c->nup;
    long mode = 9L * stride(p->modes) * c->nup, tail = p->band - p->modes;
    long residual = tail ? 3L * p->conditions * 3 * grid->nv : 0;
    c->u = ves_arena_doubles(arena, (size_t)c->nup);
    c->table = ves_arena_doubles(arena, (size_t)table);
    c->table_a = ves_arena_doubles(arena, p->a_varies ? (size_t)table : 0);
    c->rest = ves_arena_doubles(arena, (size_t)rest);
    c->rest_a = ves_arena_doubles(arena, (size_t)rest);
    c->mode = ves_arena_doubles(arena, (size_t)mode);
    c->mode_adjoint = ves_arena_doubles(arena, (size_t)mode);
    c->residual = ves_arena_doubles(arena, (size_t)residual);
    c->residual_adjoint = ves_arena_doubles(arena, (size_t)residual);
    c->wave = ves_arena_doubles(arena, (size_t)(6 * tail * grid->nv));
    c->room = ves_arena_doubles(arena, (size_t)ves_weights_room(c->nup));
    if (!c->u || !c->table || !c->table_a || !c->rest || !c->rest_a || !c->mode || !c->mode_adjoint ||
        !c->residual || !c->residual_adjoint || !c->wave || !c->room)
        return VES_MEMORY;
    places_fill(c, grid);
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
    places_fill(c, grid);
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
    c->a_table = NAN;
    c->binding = -1;
}

#define HOT static inline __attribute__((always_inline))

/* A = W F, two products a mode: cosine and sine. K conditions, derivatives 0 .. orders - 1. */
HOT void modes_product(const pde *p, pde_chart *c, int K, int orders)
{
    int nup = c->nup, width = stride(p->band), mode_stride = stride(p->modes);
    for (int part = 0; part < mode_stride; part++) {
        const double *f = p->data + part, *table = c->table + (size_t)((part + 1) / 2 * 3 * K * nup);
        double g[3][VES_CONDITIONS_MAX];
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < K; j++) g[k][j] = f[(j * 3 + k) * width];
        for (int d = 0; d < orders; d++)
            for (int b = 0; b < nup; b += VES_LANES) {
                const double *w = table + d * K * nup + b;
                double *to = c->mode + (size_t)((d * 3 * mode_stride + part) * nup + b);
                for (int k = 0; k < 3; k++) {
                    lanes sum = *(const lanes *)w * g[k][0];
                    for (int j = 1; j < K; j++) sum += *(const lanes *)(w + j * nup) * g[k][j];
                    *(lanes *)(to + k * mode_stride * nup) = sum;
                }
            }
    }
}

static void modes_eval(const pde *p, pde_chart *c)
{
    if (p->conditions == 4)
        modes_product(p, c, 4, c->orders);
    else
        modes_product(p, c, 2, c->orders);
}

static void residual_eval(const pde *p, const pde_chart *c, int nv)
{
    int tail = p->band - p->modes, width = stride(p->band);
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

static void tables_eval(const pde *p, pde_chart *c, bool gradient)
{
    gradient = gradient && p->a_varies;
    if (c->a_table == p->a_value && (c->has_table_a || !gradient)) return;
    /* mode 0 is the same for every a; its derivative table is all zeros once it has been made */
    bool has_zero = !isnan(c->a_table) && (c->has_zero_a || !gradient);
    c->has_zero_a = c->has_zero_a || gradient;
    c->a_table = p->a_value;
    c->has_table_a = gradient;
    double a = p->a_value;
    ves_weights_bind(&p->layout, a, p->modes, c->nup, c->u,
                     &(ves_table){c->table, gradient ? c->table_a : NULL, c->room, has_zero});
    if (p->band == p->modes) return;
    ves_weights_mode(&p->layout, a * (p->modes + 1), c->nup, c->u, c->rest, gradient ? c->rest_a : NULL,
                     c->room);
    for (int k = 0; gradient && k < 3 * p->conditions * c->nup; k++) c->rest_a[k] *= p->modes + 1;
}

static void pde_prepare(ves_chart *chart, const ves_bound *bound, bool gradient)
{
    (void)bound;
    const pde *p = chart->patch->state;
    pde_chart *c = chart->state;
    tables_eval(p, c, gradient);
    if (c->binding != chart->patch->binding) {
        modes_eval(p, c);
        if (p->band > p->modes) residual_eval(p, c, chart->grid->nv);
        c->binding = chart->patch->binding;
    }
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
                lanes w =
                    *(const lanes *)(c->rest + (ves_field_d[f] * p->conditions + j) * c->nup + tile->block);
                const double *r =
                    c->residual + (size_t)(((j * 3 + ves_field_e[f]) * 3 + k) * chart->grid->nv);
                for (int row = 0; row < tile->rows; row++) out[row] += w * r[tile->row[row]];
            }
        }
}

static void pde_clear(ves_patch *patch)
{
    pde *p = patch->state;
    memset(p->data_adjoint, 0, sizeof(double) * (size_t)(p->conditions * 3 * stride(p->band)));
    p->a_adjoint = 0;
}

static void pde_clear_chart(ves_chart *chart)
{
    const pde *p = chart->patch->state;
    const pde_chart *c = chart->state;
    memset(c->mode_adjoint, 0, sizeof(double) * (size_t)(9 * stride(p->modes) * c->nup));
    if (p->band > p->modes)
        memset(c->residual_adjoint, 0, sizeof(double) * (size_t)(9 * p->conditions * chart->grid->nv));
}

static void pde_scatter(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint)
{
    pde *p = chart->patch->state;
    pde_chart *c = chart->state;
    ves_synthesis_gradient(&c->synthesis, tile, adjoint, c->mode_adjoint);
    if (p->band == p->modes) return;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int k = 0; k < 3 && tile->fields & 1u << f; k++) {
            const lanes *in = (const lanes *)adjoint->at[f * 3 + k];
            for (int j = 0; j < p->conditions; j++) {
                int at = (ves_field_d[f] * p->conditions + j) * c->nup + tile->block;
                size_t curve = (size_t)(((j * 3 + ves_field_e[f]) * 3 + k) * chart->grid->nv);
                lanes w = *(const lanes *)(c->rest + at), carried = {0};
                for (int row = 0; row < tile->rows; row++) {
                    c->residual_adjoint[curve + (size_t)tile->row[row]] += ves_lanes_sum(in[row] * w);
                    carried += in[row] * c->residual[curve + (size_t)tile->row[row]];
                }
                if (p->a_varies) p->a_adjoint += ves_lanes_sum(carried * *(const lanes *)(c->rest_a + at));
            }
        }
}

/* The transpose of modes_product, and a's part: the derivative of the table applied to the data. */
HOT void modes_transpose(pde *p, const pde_chart *c, int K, int orders, bool by_a)
{
    int nup = c->nup, width = stride(p->band), mode_stride = stride(p->modes);
    lanes moved[3] = {{0}};
    for (int part = 0; part < mode_stride; part++) {
        size_t table = (size_t)((part + 1) / 2 * 3 * K * nup);
        const double *f = p->data + part;
        lanes sum[3][VES_CONDITIONS_MAX] = {{{0}}};
        for (int d = 0; d < orders; d++)
            for (int b = 0; b < nup; b += VES_LANES) {
                size_t at = table + (size_t)(d * K * nup + b);
                const double *from = c->mode_adjoint + (size_t)((d * 3 * mode_stride + part) * nup + b);
                for (int k = 0; k < 3; k++) {
                    lanes g = *(const lanes *)(from + k * mode_stride * nup), x = {0};
                    for (int j = 0; j < K; j++) sum[k][j] += g * *(const lanes *)(c->table + at + j * nup);
                    for (int j = 0; j < K && by_a; j++)
                        x += *(const lanes *)(c->table_a + at + j * nup) * f[(j * 3 + k) * width];
                    if (by_a) moved[k] += g * x;
                }
            }
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < K; j++)
                p->data_adjoint[(j * 3 + k) * width + part] += ves_lanes_sum(sum[k][j]);
    }
    p->a_adjoint += ves_lanes_sum(moved[0] + moved[1] + moved[2]);
}

static void modes_gather(pde *p, const pde_chart *c)
{
    if (p->conditions == 4 && p->a_varies)
        modes_transpose(p, c, 4, c->orders, true);
    else if (p->conditions == 4)
        modes_transpose(p, c, 4, c->orders, false);
    else
        modes_transpose(p, c, 2, c->orders, p->a_varies);
}

static void pde_gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint)
{
    (void)bound, (void)number_adjoint;
    pde *p = chart->patch->state;
    const pde_chart *c = chart->state;
    modes_gather(p, c);
    int tail = p->band - p->modes, width = stride(p->band), nv = chart->grid->nv;
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

static void pde_unbind(ves_patch *patch, const ves_bound *bound, double *number_adjoint)
{
    pde *p = patch->state;
    int width = stride(p->band);
    number_adjoint[p->a] += p->a_adjoint;
    for (int j = 0; j < p->conditions; j++) {
        const ves_datum *d = &p->datum[j];
        double scale = d->scale < 0 ? 1 : bound->number[d->scale], by_scale = 0;
        for (int side = 0; side < 2; side++) {
            int curve = side ? d->from : d->curve;
            if (curve < 0) continue;
            double sign = side ? -1 : 1, *to = ves_curves_adjoint(bound->curves, curve);
            int w = stride(ves_curves_modes(bound->curves, curve));
            const double *value = ves_curves_coef(bound->curves, curve);
            for (int k = 0; k < 3; k++)
                for (int m = 0; m < w; m++) {
                    double g = p->data_adjoint[(j * 3 + k) * width + m];
                    if (to) to[k * w + m] += sign * scale * g;
                    by_scale += sign * g * value[k * w + m];
                }
        }
        if (d->scale >= 0) number_adjoint[d->scale] += by_scale;
    }
}

/* Scattered points and the spine go eight at a time through a small table of their own. */
enum { CHUNK = VES_LANES };

static long pde_point_room(const ves_patch *patch)
{
    const pde *p = patch->state;
    return ves_weights_size(&p->layout, p->modes, CHUNK) + ves_weights_room(CHUNK) +
           3L * p->conditions * CHUNK;
}

/* The sum over modes at one point: weights of place i, all derivatives. */
static void point_sum(const pde *p, const double *table, const double *rest, int i, double v,
                      double out[VES_FIELDS][3])
{
    int K = p->conditions, width = stride(p->band);
    memset(out, 0, sizeof(double) * VES_FIELDS * 3);
    for (int n = 0; n <= p->band; n++) {
        double c = cos(n * v), s = sin(n * v), m = n;
        const double wave[3][2] = {{c, s}, {-m * s, m * c}, {-m * m * c, -m * m * s}};
        const double *w = n <= p->modes ? table + (size_t)(n * 3 * K * CHUNK) : rest;
        for (int f = 0; f < VES_FIELDS; f++)
            for (int k = 0; k < 3; k++)
                for (int j = 0; j < K; j++) {
                    const double *data = p->data + (j * 3 + k) * width;
                    double value =
                        n ? data[2 * n - 1] * wave[ves_field_e[f]][0] + data[2 * n] * wave[ves_field_e[f]][1]
                        : ves_field_e[f] ? 0
                                         : data[0];
                    out[f][k] += w[(ves_field_d[f] * K + j) * CHUNK + i] * value;
                }
    }
}

static void chunk_tables(const pde *p, const double *u, double *table, double *rest, double *room)
{
    ves_weights_bind(&p->layout, p->a_value, p->modes, CHUNK, u, &(ves_table){table, NULL, room, false});
    ves_weights_mode(&p->layout, p->a_value * (p->modes + 1), CHUNK, u, rest, NULL, room);
}

static void pde_point(const ves_patch *patch, const ves_bound *bound, int count, const double *u,
                      const double *v, double *out, double *room)
{
    (void)bound;
    const pde *p = patch->state;
    double *table = room, *rest = table + ves_weights_size(&p->layout, p->modes, CHUNK);
    for (int first = 0; first < count; first += CHUNK) {
        int n = count - first < CHUNK ? count - first : CHUNK;
        _Alignas(64) double place[CHUNK];
        for (int i = 0; i < CHUNK; i++) place[i] = u[first + (i < n ? i : n - 1)];
        chunk_tables(p, place, table, rest, rest + 3 * p->conditions * CHUNK);
        for (int i = 0; i < n; i++) {
            double field[VES_FIELDS][3];
            point_sum(p, table, rest, i, v[first + i], field);
            for (int f = 0; f < VES_FIELDS; f++)
                for (int k = 0; k < 3; k++) out[(f * 3 + k) * count + first + i] = field[f][k];
        }
    }
}

static bool pde_spine(const ves_patch *patch, const ves_bound *bound, int count, const double *u, double *out,
                      double *room)
{
    (void)bound;
    const pde *p = patch->state;
    int K = p->conditions, width = stride(p->band);
    double *table = room, *scratch = room + ves_weights_size(&p->layout, p->modes, CHUNK);
    for (int first = 0; first < count; first += CHUNK) {
        int n = count - first < CHUNK ? count - first : CHUNK;
        double place[CHUNK];
        for (int i = 0; i < CHUNK; i++) place[i] = u[first + (i < n ? i : n - 1)];
        ves_weights_mode(&p->layout, 0, CHUNK, place, table, NULL, scratch);
        for (int i = 0; i < n; i++)
            for (int d = 0; d < 3; d++)
                for (int k = 0; k < 3; k++) {
                    double sum = 0;
                    for (int j = 0; j < K; j++)
                        sum += table[(d * K + j) * CHUNK + i] * p->data[(j * 3 + k) * width];
                    out[(d * 3 + k) * count + first + i] = sum;
                }
    }
    return true;
}

/* The largest share of a condition's data, mean left out, that lies beyond the modes solved. */
static double pde_tail(const ves_patch *patch)
{
    const pde *p = patch->state;
    int width = stride(p->band);
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

static const ves_patch_ops PDE = {.chart = pde_chart_create,
                                  .move = pde_move,
                                  .bind = pde_bind,
                                  .prepare = pde_prepare,
                                  .sample = pde_sample,
                                  .clear = pde_clear,
                                  .clear_chart = pde_clear_chart,
                                  .scatter = pde_scatter,
                                  .gather = pde_gather,
                                  .unbind = pde_unbind,
                                  .point_room = pde_point_room,
                                  .point = pde_point,
                                  .spine = pde_spine,
                                  .tail = pde_tail};

static int widest(const ves_datum *datum, int count, const ves_curves *curves)
{
    int band = 0;
    for (int j = 0; j < count; j++)
        for (int side = 0; side < 2; side++) {
            int curve = side ? datum[j].from : datum[j].curve;
            if (curve >= 0 && ves_curves_modes(curves, curve) > band) band = ves_curves_modes(curves, curve);
        }
    return band;
}

/* The highest mode of the data, at the design that is bound, above SIGNIFICANT of its condition's largest. */
static int significant(const pde *p)
{
    int width = stride(p->band), highest = 0;
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

ves_status ves_patch_pde(const ves_layout *layout, const ves_datum *datum, int a, int modes,
                         const ves_bound *bound, ves_arena *arena, ves_patch **patch)
{
    *patch = NULL;
    VES_TRY(ves_layout_check(layout));
    pde *p = ves_arena_take(arena, 1, sizeof *p);
    ves_patch *made = ves_arena_take(arena, 1, sizeof *made);
    if (!p || !made) return VES_MEMORY;
    p->layout = *layout;
    p->conditions = 2 * layout->power;
    p->a = a;
    p->a_varies = bound->varying[a];
    bool varies = p->a_varies;
    for (int j = 0; j < p->conditions; j++) {
        p->datum[j] = datum[j];
        varies = varies || number_varies(bound, datum[j].scale) ||
                 ves_curves_varies(bound->curves, datum[j].curve) ||
                 (datum[j].from >= 0 && ves_curves_varies(bound->curves, datum[j].from));
    }
    p->band = widest(datum, p->conditions, bound->curves);
    size_t size = (size_t)(p->conditions * 3 * stride(p->band));
    p->data = ves_arena_doubles(arena, size);
    p->data_adjoint = ves_arena_doubles(arena, size);
    if (!p->data || !p->data_adjoint) return VES_MEMORY;
    for (int j = 0; j < p->conditions; j++) datum_bind(p, j, bound);
    int highest = significant(p), most = modes > 0                   ? modes
                                         : highest > VES_PATCH_MODES ? highest
                                                                     : VES_PATCH_MODES;
    p->modes = p->band < most ? p->band : most;
    *made = (ves_patch){
        .ops = &PDE, .periodic = true, .varies = varies, .modes = p->modes, .band = p->band, .state = p};
    *patch = made;
    return VES_OK;
}
