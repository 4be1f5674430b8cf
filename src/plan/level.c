/* Levels: the sites that all measures of a problem together read on one grid, and which measure reads
 * which. */
#include "base/vector.h"
#include "plan/shell.h"

static int patches_of(const ves_problem *p, const ves_measure_def *m, int index)
{
    return m->over ? m->patch[index] : index < p->patches ? index : -1;
}

/* Key k names a curve or a place, and it was given. */
static bool is_reference(const ves_measure_def *m, int k)
{
    ves_kind kind = m->measure->keys[k].kind;
    return (kind == VES_CURVE || kind == VES_PLACE) && m->args.arg[k].given;
}

static int references(const ves_measure_def *m)
{
    int count = 0;
    for (int k = 0; m->measure->keys && m->measure->keys[k].name; k++) count += is_reference(m, k);
    return count;
}

/* Sample `at` of a measure must have these planes. */
static void need(const ves_plan *plan, plan_level *l, int measure, int at, unsigned wanted)
{
    plan_instance *in = &l->instance[measure];
    plan_site *s = &l->site[in->site[at]];
    for (int p = 0; p < PROGRAMS; p++)
        if (plan->runs[p][measure]) s->needs[p] |= wanted;
    s->wants |= wanted;
    in->need[at] = wanted;
}

/* The site of this kind that is there already, or -1. Places are told apart by where they are. */
static int site_find(const plan_level *l, ves_site kind, int patch, int curve, const double at[2])
{
    for (int k = 0; k < l->sites; k++) {
        const plan_site *s = &l->site[k];
        if (s->samples.site != kind || s->patch != patch || s->curve != curve) continue;
        if (kind == VES_SITE_CURVE ||
            (s->grid.u[0] == at[0] && (kind == VES_SITE_CAP || s->grid.v[0] == at[1])))
            return k;
    }
    return -1;
}

static ves_status cap_add(ves_plan *plan, plan_level *l, int k, int *index)
{
    const ves_end *cap = &plan->problem->shape.cap[k];
    const double at[2] = {cap->end, 0};
    *index = site_find(l, VES_SITE_CAP, cap->patch, -1, at);
    if (*index >= 0) return VES_OK;
    plan_site s = {.patch = cap->patch, .curve = -1, .samples.site = VES_SITE_CAP};
    VES_TRY(ves_grid_ring(cap->end, l->quadrature[1], true, &plan->arena, &s.grid));
    *index = l->sites;
    l->site[l->sites++] = s;
    return VES_OK;
}

/* So many that they say all of the curve. */
static int curve_nodes(const ves_plan *plan, const plan_level *l, int curve)
{
    int enough = 2 * ves_curves_modes(plan->curves, curve) + 2, usual = 2 * l->quadrature[1];
    return usual > enough ? usual : enough;
}

static ves_status reference_add(ves_plan *plan, plan_level *l, const ves_arg *arg, int *index)
{
    plan_site s = {.patch = -1, .curve = -1};
    double at[2] = {0, 0};
    if (arg->place) {
        const ves_place *place = &plan->problem->place[arg->ref[0]];
        s.samples.site = VES_SITE_PLACE;
        s.patch = place->patch;
        at[0] = plan->block[place->u], at[1] = plan->block[place->v];
    } else {
        s.samples.site = VES_SITE_CURVE;
        s.curve = arg->ref[0];
    }
    *index = site_find(l, s.samples.site, s.patch, s.curve, at);
    if (*index >= 0) return VES_OK;
    if (arg->place)
        VES_TRY(ves_grid_given(1, &at[0], 1, &at[1], false, &plan->arena, &s.grid));
    else
        VES_TRY(ves_grid_ring(0, curve_nodes(plan, l, s.curve), true, &plan->arena, &s.grid));
    *index = l->sites;
    l->site[l->sites++] = s;
    return VES_OK;
}

/* The nodes of a look are set when it is used. */
static ves_status look_add(ves_plan *plan, plan_level *l, int patch, int *index)
{
    static const double anywhere[3] = {0.25, 0.5, 0.75};
    plan_site s = {.patch = patch, .curve = -1, .samples.site = VES_SITE_LOOK};
    bool periodic = ves_patch_periodic(plan->patch[patch]);
    VES_TRY(ves_grid_given(3, anywhere, 3, anywhere, periodic, &plan->arena, &s.grid));
    *index = l->sites;
    l->site[l->sites++] = s;
    return VES_OK;
}

static int surfaces_of(const ves_problem *p, const ves_measure_def *m)
{
    unsigned wanted = m->measure->needs ? m->measure->needs(&m->args) : m->measure->surface;
    return !wanted ? 0 : m->over ? m->over : p->patches;
}

/* Is the cap on a patch that the measure is over? */
static bool caps_it(const ves_problem *p, const ves_measure_def *m, int cap)
{
    bool found = !m->over;
    for (int k = 0; k < m->over; k++) found = found || m->patch[k] == p->shape.cap[cap].patch;
    return m->measure->cap && found;
}

static int caps_of(const ves_problem *p, const ves_measure_def *m)
{
    int count = 0;
    for (int k = 0; k < p->shape.caps; k++) count += caps_it(p, m, k);
    return count;
}

static ves_status instance_build(ves_plan *plan, plan_level *l, int m)
{
    const ves_problem *p = plan->problem;
    const ves_measure_def *def = &p->measure[m];
    const ves_measure *measure = def->measure;
    plan_instance *in = &l->instance[m];
    unsigned wanted = measure->needs ? measure->needs(&def->args) : measure->surface;
    int surfaces = surfaces_of(p, def), caps = caps_of(p, def), refs = references(def);
    int looks = surfaces * measure->looks, count = surfaces + caps + looks + refs, at = 0;
    in->site = ves_arena_take(&plan->arena, (size_t)count, sizeof *in->site);
    in->need = ves_arena_take(&plan->arena, (size_t)count, sizeof *in->need);
    if (!in->site || !in->need) return VES_MEMORY;
    for (int k = 0; k < surfaces; k++) {
        in->site[at] = patches_of(p, def, k);
        need(plan, l, m, at++, wanted);
    }
    for (int k = 0; k < p->shape.caps; k++) {
        if (!caps_it(p, def, k)) continue;
        VES_TRY(cap_add(plan, l, k, &in->site[at]));
        need(plan, l, m, at++, measure->cap);
    }
    in->input.first_look = at;
    for (int k = 0; k < looks; k++) {
        VES_TRY(look_add(plan, l, patches_of(p, def, k / measure->looks), &in->site[at]));
        need(plan, l, m, at++, wanted);
    }
    for (int k = 0; refs && measure->keys[k].name; k++) {
        if (!is_reference(def, k)) continue;
        VES_TRY(reference_add(plan, l, &def->args.arg[k], &in->site[at]));
        need(plan, l, m, at++, measure->curve);
    }
    in->input.samples = count;
    in->input.level = (int)(l - plan->level);
    return VES_OK;
}

static ves_status instance_finish(ves_plan *plan, plan_level *l, int m)
{
    plan_instance *in = &l->instance[m];
    const ves_measure_def *def = &plan->problem->measure[m];
    int count = in->input.samples;
    const ves_samples **sample = ves_arena_take(&plan->arena, (size_t)count, sizeof *sample);
    in->adjoint = ves_arena_take(&plan->arena, (size_t)count, sizeof *in->adjoint);
    if (!sample || !in->adjoint) return VES_MEMORY;
    for (int k = 0; k < count; k++) {
        sample[k] = &l->site[in->site[k]].samples;
        in->adjoint[k] = &l->site[in->site[k]].adjoint;
    }
    in->input.sample = sample;
    in->input.args = &def->args;
    in->input.number = plan->block;
    in->input.look = def->measure->looks ? ves_site_look : NULL;
    in->input.shell = l->shell ? &l->shell->view : NULL;
    in->plan = plan;
    in->looks = def->measure->looks;
    size_t room = def->measure->room ? def->measure->room(&in->input) : 0;
    in->input.room = ves_arena_doubles(&plan->arena, room);
    if (!in->input.room) return VES_MEMORY;
    return def->measure->prepare ? def->measure->prepare(&in->input, &in->input.state) : VES_OK;
}

/* What validity looks at, in the programs that judge. */
static void judging_needs(plan_site *s, unsigned wanted)
{
    s->needs[PROGRAM_JUDGE] |= wanted;
    s->needs[PROGRAM_ALL] |= wanted;
    s->wants |= wanted;
}

void ves_plan_level_face(ves_plan *plan, int index)
{
    plan_level *l = &plan->level[index];
    for (int k = 0; k < l->sites; k++) {
        plan_site *s = &l->site[k];
        if (s->patch < 0) continue;
        s->side = plan->side[s->patch];
        if (s->samples.site == VES_SITE_CAP) s->samples.side = s->grid.u[0] > 0 ? -s->side : s->side;
    }
}

static ves_status edge_add(ves_plan *plan, plan_level *l, int patch, const ves_grid *along, int *index)
{
    *index = l->sites++;
    plan_site *s = &l->site[*index];
    *s = (plan_site){.patch = patch, .curve = -1, .samples.site = VES_SITE_SURFACE};
    VES_TRY(
        ves_grid_given(along->nu, along->u, along->nv, along->v, along->periodic, &plan->arena, &s->grid));
    s->grid.symmetric = along->symmetric;
    return VES_OK;
}

/* The nodes along v and, before and after each quarter of a symmetric grid, its ends: corners of a sheet, and
 * where what is symmetric is widest. */
static ves_status edge_nodes(ves_plan *plan, const ves_grid *nodes, ves_grid *edge)
{
    int parts = ves_edge_parts(nodes), run = nodes->nv / parts, at = 0;
    *edge = *nodes;
    edge->nv = nodes->nv + 2 * parts;
    edge->v = ves_arena_take(&plan->arena, (size_t)edge->nv, sizeof *edge->v);
    if (!edge->v) return VES_MEMORY;
    for (int q = 0; q < parts; q++) {
        edge->v[at++] = VES_TWO_PI * q / parts;
        for (int j = 0; j < run; j++) edge->v[at++] = nodes->v[q * run + j];
        edge->v[at++] = VES_TWO_PI * (q + 1) / parts;
    }
    return VES_OK;
}

/* No node lies on an edge: what may happen there alone is looked at for itself. */
static ves_status edges_add(ves_plan *plan, int index, int patch)
{
    plan_level *l = &plan->level[index];
    double ends[2] = {0, 1}, sides[2] = {0, VES_TWO_PI};
    const ves_grid nodes = l->site[patch].grid;
    unsigned wanted = ves_validity_edges(plan, patch, index);
    int *edge = l->edge[patch];
    edge[0] = edge[1] = -1;
    if (!wanted) return VES_OK;
    ves_grid across, along = nodes;
    VES_TRY(edge_nodes(plan, &nodes, &across));
    across.nu = 2, across.u = ends;
    along.nv = 2, along.v = sides;
    VES_TRY(edge_add(plan, l, patch, &across, &edge[0]));
    if (!nodes.periodic) VES_TRY(edge_add(plan, l, patch, &along, &edge[1]));
    for (int k = 0; k < 2; k++)
        if (edge[k] >= 0) judging_needs(&l->site[edge[k]], wanted);
    return VES_OK;
}

ves_status ves_plan_level_build(ves_plan *plan, int index, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    plan_level *l = &plan->level[index];
    enum { EDGES = 2 };
    int most = (1 + EDGES) * p->patches + p->shape.caps + (p->shell ? p->shell->parts : 0);
    for (int m = 0; m < p->measures; m++)
        most += references(&p->measure[m]) + p->measure[m].measure->looks * surfaces_of(p, &p->measure[m]);
    l->site = ves_arena_take(&plan->arena, (size_t)most, sizeof *l->site);
    l->instance = ves_arena_take(&plan->arena, (size_t)p->measures, sizeof *l->instance);
    l->edge = ves_arena_take(&plan->arena, (size_t)p->patches, sizeof *l->edge);
    if (!l->site || !l->instance || !l->edge) return VES_MEMORY;
    l->sites = p->patches;
    for (int k = 0; k < p->patches; k++) {
        plan_site *s = &l->site[k];
        s->patch = k, s->curve = -1, s->samples.site = VES_SITE_SURFACE;
        VES_TRY(ves_grid_quadrature(l->quadrature[0], l->quadrature[1], ves_patch_periodic(plan->patch[k]),
                                    &plan->arena, &s->grid));
    }
    VES_TRY(ves_shell_begin(plan, index, diag));
    VES_TRY(ves_shell_sites(plan, index));
    for (int m = 0; m < p->measures; m++) VES_TRY(instance_build(plan, l, m));
    for (int k = 0; k < p->patches; k++) {
        judging_needs(&l->site[k], ves_validity_nodes(plan, k, index));
        VES_TRY(edges_add(plan, index, k));
    }
    for (int k = 0; k < p->shape.caps && p->shape.closed; k++) { /* the shape must not turn inside out */
        int cap;
        VES_TRY(cap_add(plan, l, k, &cap));
        judging_needs(&l->site[cap], VES_X | VES_XV);
    }
    for (int k = 0; k < l->sites; k++) VES_TRY(ves_site_finish(plan, &l->site[k], l->site[k].samples.site));
    ves_plan_level_face(plan, index);
    VES_TRY(ves_shell_finish(plan, index, diag));
    for (int m = 0; m < p->measures; m++) VES_TRY(instance_finish(plan, l, m));
    return VES_OK;
}
