/* The shell of a figure: thickness at its nodes, supports as sets of nodes, load cases as forces at nodes,
 * equivalent to what the file says on the quadratic elements over the figure's grids. */
#include "base/vector.h"
#include "plan/inside.h"
#include "surface/elements.h"

#include <math.h>
#include <string.h>

/* Of a cell: a place nearer to a node than this is at the node. It is rounding, in u and v of order 1. */
static const double AT_NODE = 1e-9;

typedef struct maker {
    const ves_plan *plan;
    ves_figure *figure;
    ves_figure_shell *shell;
    const ves_shell_def *def;
} maker;

/* Keeps the first reason; NULL: there was no memory to write it. */
static void refuse(maker *m, const char *why)
{
    if (!m->shell->refused) m->shell->refused = why ? why : "out of memory";
}

static int patch_of(const maker *m, int part)
{
    return m->def->part[part].patch;
}

static int nodes_of(const ves_figure_patch *p)
{
    return p->rows * p->columns;
}

/* --- formulas --- */

/* What a formula reads at a node: u and v in the patch's own domain. */
static void arguments(const maker *m, int k, int node, double at[VES_SHELL_ARGUMENTS])
{
    const ves_figure_patch *p = &m->figure->patch[k];
    for (int c = 0; c < 3; c++) at[VES_SHELL_X + c] = p->X[c][node];
    ves_plan_domain_at(m->plan, k, ves_figure_u(p, node), ves_figure_v(p, node), &at[VES_SHELL_U]);
}

static double value_at(const maker *m, const ves_formula *formula, int k, int node)
{
    double at[VES_SHELL_ARGUMENTS];
    arguments(m, k, node, at);
    return ves_formula_eval(formula, m->plan->block, at, m->plan->formula_room);
}

static ves_status plane_make(const maker *m, int k, double **plane)
{
    int count = nodes_of(&m->figure->patch[k]);
    *plane = ves_arena_doubles(&m->figure->arena, (size_t)count);
    for (int s = 0; *plane && s < count; s++) (*plane)[s] = 0;
    return *plane ? VES_OK : VES_MEMORY;
}

static ves_status plane_of(const maker *m, const ves_formula *formula, int k, double **plane)
{
    VES_TRY(plane_make(m, k, plane));
    for (int s = 0; s < nodes_of(&m->figure->patch[k]); s++) (*plane)[s] = value_at(m, formula, k, s);
    return VES_OK;
}

/* --- places --- */

/* The element around a place of a patch, and the values there of its functions; returns how many nodes. */
static int place_find(const maker *m, const ves_place *place, int node[VES_ELEMENT_NODES],
                      double N[VES_ELEMENT_NODES])
{
    ves_figure_patch p = m->figure->patch[place->patch];
    double by_r[VES_ELEMENT_NODES], by_s[VES_ELEMENT_NODES];
    double u = m->plan->block[place->u] * p.nu / 2, v = m->plan->block[place->v] / VES_TWO_PI * p.nv / 2;
    int i = (int)fmin(floor(u), p.nu / 2 - 1), j = (int)fmin(floor(v), p.nv / 2 - 1);
    p.side = 1; /* so that the corners run as u and v do, whatever is outside */
    int count = ves_element_nodes(&p, 2 * i, 2 * j, node);
    u -= i, v -= j;
    if (count == VES_ELEMENT_NODES)
        ves_element_shape(count, 2 * u - 1, 2 * v - 1, N, by_r, by_s);
    else if (i == 0 && p.pole[0])
        ves_element_shape(count, u * (1 - v), u * v, N, by_r, by_s);
    else
        ves_element_shape(count, u, (1 - u) * v, N, by_r, by_s);
    return count;
}

/* The node at a place; -1: the grid has none there. */
static int place_node(const maker *m, const ves_place *place)
{
    const ves_figure_patch *p = &m->figure->patch[place->patch];
    double u = m->plan->block[place->u] * p->nu, v = m->plan->block[place->v] / VES_TWO_PI * p->nv;
    int i = (int)lround(u), j = (int)lround(v);
    bool middle = i % 2 && j % 2;
    if (middle || fabs(u - i) > AT_NODE * p->nu || fabs(v - j) > AT_NODE * p->nv) return -1;
    return i * p->columns + j % p->columns;
}

/* The nodes in a row along an edge of a part, and the lengths that they stand for (planes of its patch). */
static ves_status edge_take(const maker *m, const ves_shell_edge *edge, int *count, int **node,
                            double **length)
{
    int k = patch_of(m, edge->part);
    const ves_figure_patch *p = &m->figure->patch[k];
    double *plane[3];
    *count = ves_figure_edge(p, edge->edge, NULL);
    if (!(*node = ves_arena_take(&m->figure->arena, (size_t)*count, sizeof **node))) return VES_MEMORY;
    ves_figure_edge(p, edge->edge, *node);
    for (int c = 0; c < 3; c++) VES_TRY(plane_make(m, k, &plane[c]));
    for (int n = 0; n + 2 < *count; n += 2) ves_element_line(p, *node + n, NULL, plane);
    *length = plane[0];
    return VES_OK;
}

/* --- supports --- */

static void support_place(maker *m, const ves_shell_at *at, ves_figure_support *support, int (*node)[2])
{
    const ves_place *place = &m->plan->problem->place[at->index];
    int found = place_node(m, place);
    const ves_figure_patch *p = &m->figure->patch[place->patch];
    if (found < 0)
        refuse(m, ves_arena_format(&m->figure->arena,
                                   "no node of its elements lies at \"%s\" on %d x %d cells: give a --grid",
                                   at->text, p->nu, p->nv));
    node[0][0] = place->patch, node[0][1] = found < 0 ? 0 : found;
    support->nodes = 1;
}

static ves_status support_make(maker *m, const ves_support_def *def, ves_figure_support *support)
{
    const ves_shell_at *at = &def->at;
    ves_arena *arena = &m->figure->arena;
    const double *stiffness = def->spring < 0 ? NULL : m->plan->block + def->spring;
    size_t most = 1;
    for (int e = 0; e < at->edges; e++)
        most += (size_t)ves_figure_edge(&m->figure->patch[patch_of(m, at->on[e].part)], at->on[e].edge, NULL);
    int(*node)[2] = ves_arena_take(arena, most, sizeof *node);
    double(*spring)[3] = ves_arena_take(arena, most, sizeof *spring);
    *support = (ves_figure_support){.text = ves_arena_text(arena, at->text, strlen(at->text)),
                                    .node = (const int(*)[2])node,
                                    .fix = def->kind == VES_SUPPORT_FIX ? def->fix : 0,
                                    .mirror = def->kind == VES_SUPPORT_SYMMETRY,
                                    .across = def->kind == VES_SUPPORT_DIAPHRAGM,
                                    .spring = stiffness ? spring : NULL};
    if (!node || !spring || !support->text) return VES_MEMORY;
    memcpy(support->axis, def->axis, sizeof support->axis);
    if (at->kind == VES_AT_PLACE) support_place(m, at, support, node);
    for (int c = 0; stiffness && c < 3; c++) spring[0][c] = stiffness[c];
    /* springs along a curve are there once, however many parts end on it */
    for (int e = 0; e < (stiffness && at->edges ? 1 : at->edges); e++) {
        int count, *row, k = patch_of(m, at->on[e].part);
        double *length;
        VES_TRY(edge_take(m, &at->on[e], &count, &row, &length));
        for (int n = 0; n < count - (row[count - 1] == row[0]); n++) {
            int to = support->nodes++;
            node[to][0] = k, node[to][1] = row[n];
            for (int c = 0; stiffness && c < 3; c++) spring[to][c] = stiffness[c] * length[row[n]];
        }
    }
    return VES_OK;
}

/* --- loads --- */

typedef double *planes[3];

static ves_status load_edge(const maker *m, const ves_load_def *load, planes *force)
{
    const ves_shell_edge *edge = &load->at.on[0];
    int count, *row, k = patch_of(m, edge->part);
    double *length, *q[3], whole = 0;
    VES_TRY(edge_take(m, edge, &count, &row, &length));
    int ring = row[count - 1] == row[0];
    for (int n = 0; n < count - ring; n++) whole += length[row[n]];
    for (int c = 0; c < 3; c++) {
        VES_TRY(plane_make(m, k, &q[c]));
        for (int n = 0; n < count; n++) {
            double value = value_at(m, load->formula[c], k, row[n]);
            q[c][row[n]] = load->kind == VES_LOAD_FORCE ? value / whole : value;
        }
    }
    for (int n = 0; n + 2 < count; n += 2) ves_element_line(&m->figure->patch[k], row + n, q, force[k]);
    return VES_OK;
}

static void load_place(maker *m, const ves_load_def *load, planes *force)
{
    const ves_place *place = &m->plan->problem->place[load->at.index];
    int node[VES_ELEMENT_NODES], k = place->patch;
    double N[VES_ELEMENT_NODES];
    int count = place_find(m, place, node, N);
    if (m->figure->patch[k].slide != 0)
        refuse(m, ves_arena_format(&m->figure->arena, "\"%s\" is on a grid whose last row is turned",
                                   load->at.text));
    for (int c = 0; c < 3; c++) {
        double value = value_at(m, load->formula[c], k, node[0]);
        for (int n = 0; n < count; n++) force[k][c][node[n]] += N[n] * value;
    }
}

static ves_status load_part(const maker *m, const ves_load_def *load, int k, planes *force)
{
    const ves_figure_patch *p = &m->figure->patch[k];
    double *q[3] = {NULL, NULL, NULL}, *pressure = NULL;
    if (load->kind == VES_LOAD_PRESSURE) {
        VES_TRY(plane_of(m, load->formula[0], k, &pressure));
    } else {
        for (int c = 0; c < 3; c++) VES_TRY(plane_of(m, load->formula[c], k, &q[c]));
    }
    for (int s = 0; load->kind == VES_LOAD_GRAVITY && s < nodes_of(p); s++)
        for (int c = 0; c < 3; c++) q[c][s] *= m->shell->density * m->shell->thickness[k][s];
    for (int i = 0; i + 2 <= p->nu; i += 2)
        for (int j = 0; j + 2 <= p->nv; j += 2) {
            int node[VES_ELEMENT_NODES], count = ves_element_nodes(p, i, j, node);
            ves_element_area(p, count, node, pressure ? NULL : q, pressure, force[k]);
        }
    return VES_OK;
}

static ves_status case_make(maker *m, const ves_case_def *def, ves_figure_case *out)
{
    ves_arena *arena = &m->figure->arena;
    planes *force = ves_arena_take(arena, (size_t)m->figure->patches, sizeof *force);
    *out = (ves_figure_case){ves_arena_text(arena, def->name, strlen(def->name)), force};
    if (!out->name || !force) return VES_MEMORY;
    for (int part = 0; part < m->def->parts; part++)
        for (int c = 0; c < 3; c++) VES_TRY(plane_make(m, patch_of(m, part), &force[patch_of(m, part)][c]));
    for (int n = 0; n < def->loads; n++) {
        const ves_load_def *load = &def->load[n];
        bool along = load->kind == VES_LOAD_LINE || load->kind == VES_LOAD_FORCE;
        if (along && load->at.kind == VES_AT_PLACE)
            load_place(m, load, force);
        else if (along)
            VES_TRY(load_edge(m, load, force));
        for (int p = 0; !along && p < load->parts; p++)
            VES_TRY(load_part(m, load, patch_of(m, load->part[p]), force));
    }
    return VES_OK;
}

/* --- all --- */

/* Elements take two by two cells, and have a side that is outside. */
static bool grids_good(maker *m)
{
    ves_arena *arena = &m->figure->arena;
    for (int part = 0; part < m->def->parts; part++) {
        const ves_figure_patch *p = &m->figure->patch[patch_of(m, part)];
        if (p->nu % 2 || p->nv % 2)
            refuse(m, ves_arena_format(arena,
                                       "an element takes two by two cells, and \"%s\" has %d x %d: give a "
                                       "--grid of even numbers",
                                       p->name, p->nu, p->nv));
        if (p->nu < 4 && p->pole[0] && p->pole[1])
            refuse(m, ves_arena_format(arena, "\"%s\" has fewer than 4 cells from pole to pole", p->name));
        if (p->one_sided)
            refuse(m, ves_arena_format(arena, "\"%s\" has one side, and its grid is open there", p->name));
    }
    return !m->shell->refused;
}

static ves_status parts_make(maker *m)
{
    size_t patches = (size_t)m->figure->patches;
    double **thickness = ves_arena_take(&m->figure->arena, patches, sizeof *thickness);
    bool *uniform = ves_arena_take(&m->figure->arena, patches, sizeof *uniform);
    m->shell->thickness = thickness, m->shell->uniform = uniform;
    if (!thickness || !uniform) return VES_MEMORY;
    for (int part = 0; part < m->def->parts; part++) {
        const ves_shell_part_def *p = &m->def->part[part];
        VES_TRY(plane_of(m, p->thickness, p->patch, &thickness[p->patch]));
        uniform[p->patch] = p->uniform >= 0;
        for (int s = 0; s < nodes_of(&m->figure->patch[p->patch]); s++)
            if (!(thickness[p->patch][s] > 0))
                refuse(m, ves_arena_format(&m->figure->arena, "the thickness of \"%s\" is %g somewhere",
                                           m->figure->patch[p->patch].name, thickness[p->patch][s]));
    }
    return VES_OK;
}

static ves_status loads_make(maker *m)
{
    ves_arena *arena = &m->figure->arena;
    ves_figure_support *support = ves_arena_take(arena, (size_t)m->def->supports, sizeof *support);
    ves_figure_case *load_case = ves_arena_take(arena, (size_t)m->def->cases, sizeof *load_case);
    if (!support || !load_case) return VES_MEMORY;
    for (int k = 0; k < m->def->supports; k++) VES_TRY(support_make(m, &m->def->support[k], &support[k]));
    for (int k = 0; k < m->def->cases; k++) VES_TRY(case_make(m, &m->def->load_case[k], &load_case[k]));
    m->shell->support = support, m->shell->supports = m->def->supports;
    m->shell->load_case = load_case, m->shell->cases = m->def->cases;
    return VES_OK;
}

ves_status ves_figure_shell_make(const ves_plan *plan, ves_figure *figure)
{
    const ves_shell_def *def = plan->problem->shell;
    if (!def) return VES_OK;
    maker m = {plan, figure, ves_arena_take(&figure->arena, 1, sizeof *m.shell), def};
    if (!m.shell) return VES_MEMORY;
    *m.shell = (ves_figure_shell){.E = plan->block[def->E],
                                  .nu = plan->block[def->nu],
                                  .density = def->density < 0 ? NAN : plan->block[def->density]};
    figure->shell = m.shell;
    VES_TRY(parts_make(&m));
    return grids_good(&m) ? loads_make(&m) : VES_OK;
}

/* --- grids --- */

/* Lengths of the longest lines along u and v. */
static void lengths(const ves_figure_patch *p, double length[2])
{
    length[0] = length[1] = 0;
    for (int j = 0; j < p->columns; j++) {
        double sum = 0;
        for (int i = 0; i < p->nu; i++) {
            double d[3];
            int a = i * p->columns + j;
            for (int c = 0; c < 3; c++) d[c] = p->X[c][a + p->columns] - p->X[c][a];
            sum += sqrt(ves_dot(d, d));
        }
        length[0] = fmax(length[0], sum);
    }
    for (int i = 0; i < p->rows; i++) {
        double sum = 0;
        for (int j = 0; j < p->nv; j++) {
            double d[3];
            int a = i * p->columns + j, b = i * p->columns + (j + 1) % p->columns;
            for (int c = 0; c < 3; c++) d[c] = p->X[c][b] - p->X[c][a];
            sum += sqrt(ves_dot(d, d));
        }
        length[1] = fmax(length[1], sum);
    }
}

/* The width sqrt(R t) of a bending layer at an edge, R from the mean curvature; a flat shell has none. */
static double layer_width(const ves_figure_patch *p, const double *thickness)
{
    double k = 0, t = 0;
    int count = nodes_of(p);
    for (int s = 0; s < count; s++) {
        double most = fmax(fabs(p->k1[s]), fabs(p->k2[s]));
        t += thickness[s] / count;
        if (isfinite(most)) k += most / count;
    }
    return k > 0 ? sqrt(t / k) : HUGE_VAL;
}

/* Two elements, four cells, to a layer along u, six elements at least; no cell more than four times as long
 * as wide. */
static int cells(double length, double layer, double other)
{
    double size = fmax(fmin(layer / 4, length / 12), other / 4);
    return 2 * (int)fmax(2, fmin(200, ceil(length / size / 2)));
}

void ves_figure_cells(const ves_figure *coarse, int *nu, int *nv)
{
    for (int k = 0; k < coarse->patches; k++) {
        const ves_figure_patch *p = &coarse->patch[k];
        double extent[2];
        if (!coarse->shell->thickness[k] || p->periodic) continue;
        lengths(p, extent);
        *nv = (int)fmax(*nv, cells(extent[1], layer_width(p, coarse->shell->thickness[k]), 0));
    }
    for (int k = 0; k < coarse->patches; k++) {
        const ves_figure_patch *p = &coarse->patch[k];
        double extent[2];
        nu[k] = 0;
        if (!coarse->shell->thickness[k]) continue;
        lengths(p, extent);
        nu[k] = cells(extent[0], layer_width(p, coarse->shell->thickness[k]), extent[1] / *nv);
    }
}
