/* Sites: sampling a shape at the places that level.c has laid out, and the transpose of it. */
#include "base/domain.h"
#include "plan/inside.h"

#include <math.h>
#include <string.h>

static const unsigned FIELD_NEED[VES_FIELDS] = {VES_X, VES_XU, VES_XV, VES_XUU, VES_XUV, VES_XVV};

#define HOT static inline __attribute__((always_inline))

enum { FORM_NEEDS = VES_NORMAL | VES_AREA | VES_CURVATURE, AT_POLE = (1 << VES_POLE_FIELDS) - 1 };

/* The fields that must be computed so that `needs` can be answered. */
static unsigned fields_for(unsigned needs)
{
    unsigned fields = 0;
    for (int f = 0; f < VES_FIELDS; f++)
        if (needs & FIELD_NEED[f]) fields |= 1u << f;
    if (needs & FORM_NEEDS) fields |= 1u << VES_FIELD_U | 1u << VES_FIELD_V;
    if (needs & VES_CURVATURE) fields |= 1u << VES_FIELD_UU | 1u << VES_FIELD_UV | 1u << VES_FIELD_VV;
    return fields;
}

/* The planes of a samples or adjoint struct for field f: they are declared in the same order. */
static double **sample_field(ves_samples *s, int f)
{
    const double **const field[VES_FIELDS] = {s->X, s->Xu, s->Xv, s->Xuu, s->Xuv, s->Xvv};
    return (double **)field[f];
}

static double **adjoint_field(ves_adjoint *a, int f)
{
    double **const field[VES_FIELDS] = {a->X, a->Xu, a->Xv, a->Xuu, a->Xuv, a->Xvv};
    return field[f];
}

/* Planes start a cache line apart beyond a whole page, or all of them would share one set of the first-level
 * cache. */
static ves_status plane_take(ves_plan *plan, int count, bool varies, const double **value, double **adjoint)
{
    *value = ves_arena_doubles(&plan->arena, (size_t)count + VES_LANES);
    *adjoint = varies ? ves_arena_doubles(&plan->arena, (size_t)count + VES_LANES) : NULL;
    if (*adjoint) memset(*adjoint, 0, sizeof **adjoint * (size_t)count);
    return *value && (*adjoint || !varies) ? VES_OK : VES_MEMORY;
}

static ves_status planes_take(ves_plan *plan, plan_site *s)
{
    for (int f = 0; f < VES_FIELDS; f++)
        for (int c = 0; c < 3 && s->wants & FIELD_NEED[f]; c++)
            VES_TRY(plane_take(plan, s->grid.count, s->varies,
                               (const double **)&sample_field(&s->samples, f)[c],
                               &adjoint_field(&s->adjoint, f)[c]));
    for (int c = 0; c < 3 && s->wants & VES_NORMAL; c++)
        VES_TRY(plane_take(plan, s->grid.count, s->varies, &s->samples.normal[c], &s->adjoint.normal[c]));
    if (s->wants & VES_AREA)
        VES_TRY(plane_take(plan, s->grid.count, s->varies, &s->samples.dA, &s->adjoint.dA));
    if (s->wants & VES_CURVATURE) {
        VES_TRY(plane_take(plan, s->grid.count, s->varies, &s->samples.H, &s->adjoint.H));
        VES_TRY(plane_take(plan, s->grid.count, s->varies, &s->samples.K, &s->adjoint.K));
    }
    return VES_OK;
}

static ves_status tiles_cut(ves_plan *plan, plan_site *s)
{
    s->tiles = ves_tile_count(&s->grid);
    s->tile = ves_arena_take(&plan->arena, (size_t)s->tiles, sizeof *s->tile);
    for (int k = 0; s->tile && k < s->tiles; k++) ves_tile_at(&s->grid, k, 0, &s->tile[k]);
    s->kept = ves_arena_take(&plan->arena, s->varies ? (size_t)s->tiles : 0, sizeof *s->kept);
    return s->tile && s->kept ? VES_OK : VES_MEMORY;
}

/* A look may stand on an end that is a point. */
static unsigned chart_fields(const ves_plan *plan, plan_site *s, ves_site kind)
{
    for (int end = 0; end < 2; end++)
        s->pole[end] = (kind == VES_SITE_LOOK || s->mesh) && s->wants & FORM_NEEDS &&
                       ves_end_is_pole(plan, s->patch, end);
    return s->pole[0] || s->pole[1] ? AT_POLE : fields_for(s->wants);
}

/* That of a patch's own formulas, else 0 .. 1 and 0 .. 2 pi; a curve is no patch. */
static void domain(const ves_plan *plan, int patch, double u_range[2], double v_range[2])
{
    const ves_patch_def *d = patch >= 0 ? &plan->problem->patch[patch] : NULL;
    bool own = d && d->kind == VES_PATCH_FORMULA;
    u_range[0] = own ? d->u_range[0] : 0, u_range[1] = own ? d->u_range[1] : 1;
    v_range[0] = own ? d->v_range[0] : 0, v_range[1] = own ? d->v_range[1] : VES_TWO_PI;
}

void ves_plan_domain_at(const ves_plan *plan, int patch, double u, double v, double at[2])
{
    double u_range[2], v_range[2];
    domain(plan, patch, u_range, v_range);
    ves_domain_at(u_range, v_range, u, v, at);
}

/* Completes a site whose kind, grid and needs are known. */
ves_status ves_site_finish(ves_plan *plan, plan_site *s, ves_site kind)
{
    ves_samples *m = &s->samples;
    *m = (ves_samples){.site = kind,
                       .patch = s->patch,
                       .nu = s->grid.nu,
                       .nv = s->grid.nv,
                       .count = s->grid.count,
                       .periodic = s->grid.periodic,
                       .u = s->grid.u,
                       .v = s->grid.v,
                       .weight = s->grid.weight};
    domain(plan, s->patch, m->u_range, m->v_range);
    if (s->patch >= 0) {
        s->varies = ves_patch_varies(plan->patch[s->patch]) || plan->problem->scale || plan->displaced;
        VES_TRY(ves_chart_create(plan->patch[s->patch], &s->grid, chart_fields(plan, s, kind), &plan->arena,
                                 &s->chart));
        VES_TRY(tiles_cut(plan, s));
    } else {
        s->varies = ves_curves_varies(plan->curves, s->curve) || plan->problem->scale;
        s->curve_modes = ves_curves_modes(plan->curves, s->curve);
        int stride = ves_curve_stride(s->curve_modes);
        s->trig = ves_arena_doubles(&plan->arena, (size_t)(3 * stride * s->grid.nv));
        if (!s->trig) return VES_MEMORY;
        for (int e = 0; e < 3; e++)
            for (int j = 0; j < s->grid.nv; j++) {
                double *t = s->trig + (size_t)(e * stride * s->grid.nv + j);
                t[0] = e == 0;
                for (int n = 1; n <= s->curve_modes; n++)
                    ves_wave(n, s->grid.v[j], e, &t[(2 * n - 1) * s->grid.nv], &t[2 * n * s->grid.nv]);
            }
    }
    return planes_take(plan, s);
}

/* --- sampling --- */

static void curve_sample(ves_plan *plan, plan_site *s, unsigned needs)
{
    static const int FIELD[3] = {VES_FIELD_X, VES_FIELD_V, VES_FIELD_VV};
    int stride = ves_curve_stride(s->curve_modes), nv = s->grid.nv;
    const double *coef = ves_curves_coef(plan->curves, s->curve);
    for (int e = 0; e < 3; e++)
        for (int c = 0; c < 3 && needs & FIELD_NEED[FIELD[e]]; c++) {
            double *out = sample_field(&s->samples, FIELD[e])[c];
            memset(out, 0, sizeof *out * (size_t)nv);
            for (int k = 0; k < stride; k++) {
                const double *t = s->trig + (size_t)((e * stride + k) * nv);
                double f = plan->similarity * coef[c * stride + k];
                for (int j = 0; j < nv; j++) out[j] += f * t[j];
            }
        }
}

/* A plane of a tile into the plane of the grid, times factor (for dA the weights) when there is one. */
static void tile_store(const ves_tile *tile, const double *from, const double *factor, double *to)
{
    for (int r = 0; r < tile->rows; r++)
        for (int i = 0; i < tile->lanes; i++) {
            size_t at = tile->offset[r] + (size_t)i;
            to[at] = from[r * VES_LANES + i] * (factor ? factor[at] : 1);
        }
}

/* The three planes of a field, whole registers. */
static void field_store(const ves_tile *tile, const double *from, double *const to[3])
{
    double *restrict x = to[0], *restrict y = to[1], *restrict z = to[2];
    int rows = tile->rows;
    for (int r = 0; r < rows; r++, from += VES_LANES) {
        size_t at = tile->offset[r];
        ves_lanes_put(x + at, ves_lanes_at(from));
        ves_lanes_put(y + at, ves_lanes_at(from + VES_TILE_STRIDE));
        ves_lanes_put(z + at, ves_lanes_at(from + 2 * VES_TILE_STRIDE));
    }
}

static void fields_store(const ves_tile *tile, unsigned needs, const ves_tile_planes *field, ves_samples *to)
{
    for (int f = 0; f < VES_FIELDS; f++) {
        if (!(needs & FIELD_NEED[f])) continue;
        if (tile->lanes == VES_LANES)
            field_store(tile, field->at[f * 3], sample_field(to, f));
        else
            for (int c = 0; c < 3; c++) tile_store(tile, field->at[f * 3 + c], NULL, sample_field(to, f)[c]);
    }
}

static void forms_store(const plan_site *s, const ves_tile *tile, unsigned needs, const ves_form_planes *form)
{
    for (int c = 0; c < 3 && needs & VES_NORMAL; c++)
        tile_store(tile, form->at[VES_FORM_NX + c], NULL, (double *)s->samples.normal[c]);
    if (needs & VES_AREA) tile_store(tile, form->at[VES_FORM_J], s->grid.weight, (double *)s->samples.dA);
    if (needs & VES_CURVATURE) {
        tile_store(tile, form->at[VES_FORM_H], NULL, (double *)s->samples.H);
        tile_store(tile, form->at[VES_FORM_K], NULL, (double *)s->samples.K);
    }
}

/* Does a tile hold a pole? Then it needs all fields. */
static bool tile_fields(const plan_site *s, ves_tile *tile, unsigned needs, int pole[VES_LANES])
{
    bool any =
        (s->pole[0] || s->pole[1]) && needs & FORM_NEEDS && ves_pole_lanes(&s->grid, tile, s->pole, pole);
    tile->fields = any ? AT_POLE : fields_for(needs);
    return any;
}

/* The fields that forms are made of. */
static const ves_tile_planes *unfolded(ves_plan *plan, const ves_tile *tile, const int *pole,
                                       const ves_tile_planes *field)
{
    *plan->unfolded = *field;
    ves_pole_unfold(tile, pole, plan->unfolded);
    return plan->unfolded;
}

/* Forms of a tile into the planes of the grid: straight, where the tile is as wide as a register, else
 * through a buffer. */
static ves_status forms_sample(ves_plan *plan, plan_site *s, const ves_tile *tile,
                               const ves_tile_planes *field, unsigned needs)
{
    ves_samples *m = &s->samples;
    ves_form_rows rows;
    bool curvature = needs & VES_CURVATURE;
    if (tile->lanes < VES_LANES) {
        ves_form_rows_init(plan->form, &rows);
        ves_status status = ves_forms_eval(tile, field, s->side, curvature, &rows);
        forms_store(s, tile, needs, plan->form);
        return status;
    }
    for (int c = 0; c < 3; c++) rows.at[VES_FORM_NX + c] = needs & VES_NORMAL ? (double *)m->normal[c] : NULL;
    rows.at[VES_FORM_J] = needs & VES_AREA ? (double *)m->dA : NULL;
    rows.at[VES_FORM_H] = curvature ? (double *)m->H : NULL;
    rows.at[VES_FORM_K] = curvature ? (double *)m->K : NULL;
    rows.weight = s->grid.weight;
    rows.offset = tile->offset;
    return ves_forms_eval(tile, field, s->side, curvature, &rows);
}

/* The curves of a PDE patch, or the points of a sheet, are in all its fields: one that is no number is seen
 * in the forms. A formula may have it in X alone (log(-1) + u), and is looked at there. */
static bool looks_at_points(const ves_plan *plan, const plan_site *s, unsigned needs)
{
    bool drawn = plan->problem->patch[s->patch].kind == VES_PATCH_FORMULA;
    return needs & VES_X && (drawn || !(needs & FORM_NEEDS));
}

static bool finite_points(const plan_site *s)
{
    double sum = 0;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < s->grid.count; k++) sum += s->samples.X[c][k];
    return isfinite(sum);
}

/* Why a tile has no forms: it has no points, or no tangent plane. */
static ves_status formless(const ves_tile *tile, const ves_tile_planes *field)
{
    int f = tile->fields & 1u << VES_FIELD_X ? VES_FIELD_X : VES_FIELD_U;
    double sum = 0;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < tile->rows * VES_LANES; k++) sum += field->at[f * 3 + c][k];
    return isfinite(sum) ? VES_DEGENERATE : VES_NO_POINT;
}

/* What a gradient needs of a chart is prepared with it, but of a look, which moves, when it has come to
 * rest. */
static ves_status site_fill(ves_plan *plan, plan_site *s, unsigned needs, bool gradient)
{
    bool keep = s->varies && (gradient || s->looked);
    VES_TRY(ves_chart_prepare(s->chart, &plan->bound, gradient));
    ves_status worst = VES_OK;
    for (int k = 0; k < s->tiles; k++) {
        ves_tile *tile = &s->tile[k];
        ves_tile_planes *field = keep ? &s->kept[k] : plan->field;
        int pole[VES_LANES];
        bool at_pole = tile_fields(s, tile, needs, pole);
        ves_chart_sample(s->chart, tile, field);
        if (plan->similarity != 1) ves_tile_scale(tile, plan->similarity, field);
        if (s->displacement) ves_displace(s->displacement, tile, field);
        fields_store(tile, needs, field, &s->samples);
        if (needs & FORM_NEEDS) {
            const ves_tile_planes *of = at_pole ? unfolded(plan, tile, pole, field) : field;
            ves_status status = forms_sample(plan, s, tile, of, needs);
            if (status != VES_OK && worst != VES_NO_POINT) worst = formless(tile, field);
        }
    }
    if (looks_at_points(plan, s, needs) && !finite_points(s)) return VES_NO_POINT;
    return worst;
}

ves_status ves_site_sample(ves_plan *plan, plan_site *s, unsigned needs, bool gradient)
{
    s->looked = false;
    if (!needs || s->samples.site == VES_SITE_LOOK) return VES_OK;
    if (s->chart) return site_fill(plan, s, needs, gradient);
    curve_sample(plan, s, needs);
    return VES_OK;
}

int ves_site_look(const ves_measure_input *input, int i, int k, const double u[3], const double v[3])
{
    const plan_instance *in = (const plan_instance *)input;
    int index = input->first_look + i * in->looks + k;
    plan_site *s = &in->plan->level[input->level].site[in->site[index]];
    memcpy(s->grid.u, u, 3 * sizeof *u);
    memcpy(s->grid.v, v, 3 * sizeof *v);
    ves_chart_move(s->chart);
    s->looked = true;
    return site_fill(in->plan, s, s->wants, false) == VES_OK ? index : -1;
}

/* --- the transpose --- */

static bool idle(const plan_site *s)
{
    return s->samples.site == VES_SITE_LOOK && !s->looked;
}

/* Three loops from one text. A plane of adjoints goes into a tile, times factor or on top of what is there;
 * it is left all zeros, ready for the next sweep. */
HOT void rows_take(const ves_tile *tile, double *from, const double *factor, bool add, double *to)
{
    for (int r = 0; r < tile->rows; r++, to += VES_LANES) {
        double *at = from + tile->offset[r];
        ves_lanes x = ves_lanes_at(at);
        if (factor) x *= ves_lanes_at(factor + tile->offset[r]);
        if (add) x += ves_lanes_at(to);
        ves_lanes_put(to, x);
        ves_lanes_put(at, (ves_lanes){0});
    }
}

/* The same where a tile is narrower than a register: lanes beyond the grid are zero. */
static void part_take(const ves_tile *tile, double *from, const double *factor, bool add, double *to)
{
    for (int r = 0; r < tile->rows; r++, to += VES_LANES)
        for (int i = 0; i < VES_LANES; i++) {
            size_t at = tile->offset[r] + (size_t)i;
            double x = i < tile->lanes ? from[at] * (factor ? factor[at] : 1) : 0;
            to[i] = add ? to[i] + x : x;
            if (i < tile->lanes) from[at] = 0;
        }
}

static void tile_take(const ves_tile *tile, double *from, const double *factor, bool add, double *to)
{
    if (tile->lanes < VES_LANES)
        part_take(tile, from, factor, add, to);
    else if (factor)
        rows_take(tile, from, factor, false, to);
    else if (add)
        rows_take(tile, from, NULL, true, to);
    else
        rows_take(tile, from, NULL, false, to);
}

static void plane_zero(const ves_tile *tile, double *to)
{
    memset(to, 0, sizeof *to * (size_t)(tile->rows * VES_LANES));
}

static void form_adjoint_take(const plan_site *s, const ves_tile *tile, ves_form_planes *form)
{
    for (int c = 0; c < 3 && s->slopes & VES_NORMAL; c++)
        tile_take(tile, s->adjoint.normal[c], NULL, false, form->at[VES_FORM_NX + c]);
    if (s->slopes & VES_AREA)
        tile_take(tile, s->adjoint.dA, s->grid.weight, false, form->at[VES_FORM_J]);
    else
        plane_zero(tile, form->at[VES_FORM_J]);
    if (!(s->slopes & VES_CURVATURE)) return;
    tile_take(tile, s->adjoint.H, NULL, false, form->at[VES_FORM_H]);
    tile_take(tile, s->adjoint.K, NULL, false, form->at[VES_FORM_K]);
}

/* The adjoint of the fields of one tile: what flows back through the forms, and what measures gave
 * directly. */
static void adjoint_make(ves_plan *plan, plan_site *s, ves_tile *tile, const ves_tile_planes *field)
{
    ves_tile_planes *to = plan->field_adjoint;
    unsigned needs = s->slopes;
    int pole[VES_LANES];
    bool at_pole = tile_fields(s, tile, needs, pole);
    if (needs & FORM_NEEDS) {
        form_adjoint_take(s, tile, plan->form);
        ves_form_flow flow = {.normal = needs & VES_NORMAL, .curvature = needs & VES_CURVATURE};
        const ves_tile_planes *of = at_pole ? unfolded(plan, tile, pole, field) : field;
        ves_forms_gradient(tile, of, s->side, flow, plan->form, to);
        for (int k = 3 * VES_FIELD_UU; k < 3 * VES_FIELDS && at_pole && !flow.curvature; k++)
            plane_zero(tile, to->at[k]);
        if (at_pole) ves_pole_gradient(tile, pole, field, to);
    }
    for (int f = 0; f < VES_FIELDS; f++)
        for (int c = 0; c < 3 && tile->fields & 1u << f; c++) {
            bool made = needs & FORM_NEEDS && f != VES_FIELD_X &&
                        (ves_field_d[f] + ves_field_e[f] == 1 || needs & VES_CURVATURE || at_pole);
            if (needs & FIELD_NEED[f])
                tile_take(tile, adjoint_field(&s->adjoint, f)[c], NULL, made, to->at[f * 3 + c]);
            else if (!made)
                plane_zero(tile, to->at[f * 3 + c]);
        }
}

/* X = similarity X0: the adjoint of X0 is similarity times that of X, and d J / d similarity their inner
 * product with X0, over what something depends on: a field that nothing reads may be infinite (at the tip of
 * sqrt(u), say). */
static double tile_unscale(const ves_tile *tile, double similarity, const ves_tile_planes *field,
                           ves_tile_planes *adjoint)
{
    double sum = 0;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && tile->fields & 1u << f; c++) {
            const double *x = field->at[f * 3 + c];
            double *g = adjoint->at[f * 3 + c];
            for (int k = 0; k < tile->rows * VES_LANES; k++) {
                sum += g[k] != 0 ? g[k] * x[k] : 0;
                g[k] *= similarity;
            }
        }
    return sum / similarity;
}

static double curve_scatter(ves_plan *plan, plan_site *s)
{
    static const int FIELD[3] = {VES_FIELD_X, VES_FIELD_V, VES_FIELD_VV};
    int stride = ves_curve_stride(s->curve_modes), nv = s->grid.nv;
    double *to = ves_curves_adjoint(plan->curves, s->curve), by_similarity = 0;
    const double *coef = ves_curves_coef(plan->curves, s->curve);
    for (int e = 0; e < 3; e++)
        for (int c = 0; c < 3 && s->slopes & FIELD_NEED[FIELD[e]]; c++) {
            double *g = adjoint_field(&s->adjoint, FIELD[e])[c];
            for (int k = 0; k < stride; k++) {
                const double *t = s->trig + (size_t)((e * stride + k) * nv);
                double sum = 0;
                for (int j = 0; j < nv; j++) sum += g[j] * t[j];
                if (to) to[c * stride + k] += plan->similarity * sum;
                by_similarity += coef[c * stride + k] * sum;
            }
            memset(g, 0, sizeof *g * (size_t)nv);
        }
    return by_similarity;
}

ves_status ves_site_scatter(ves_plan *plan, plan_site *s, double *by_similarity)
{
    ves_status status = VES_OK;
    if (!s->slopes || !s->varies || idle(s)) return VES_OK;
    if (!s->chart) {
        *by_similarity += curve_scatter(plan, s);
        return VES_OK;
    }
    /* what it looked at was solved, but slopes need not be numbers where values are */
    if (s->looked) status = ves_chart_prepare(s->chart, &plan->bound, true);
    ves_chart_clear(s->chart);
    bool scaled = plan->problem->scale;
    for (int k = 0; k < s->tiles; k++) {
        ves_tile *tile = &s->tile[k];
        adjoint_make(plan, s, tile, &s->kept[k]);
        if (s->displacement) {
            ves_displace_gradient(s->displacement, tile, plan->field_adjoint);
            continue;
        }
        if (scaled) *by_similarity += tile_unscale(tile, plan->similarity, &s->kept[k], plan->field_adjoint);
        ves_chart_scatter(s->chart, tile, plan->field_adjoint);
    }
    return status;
}

void ves_site_gather(ves_plan *plan, plan_site *s)
{
    if (s->chart && s->varies && !idle(s) && !s->displacement)
        ves_chart_gather(s->chart, &plan->bound, plan->block_adjoint);
}
