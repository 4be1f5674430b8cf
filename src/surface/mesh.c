/* Meshes of figures: welded to one surface, or patch by patch with all that the figure knows at its nodes. */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "surface/figure.h"

/* A mesh while it is made. */
typedef struct maker {
    const ves_figure *figure;
    bool welded;
    int vertices, triangles;
    double *point, *normal, *H, *K, *k1, *k2, *u, *v;
    int *patch, *corner;
} maker;

/* Adds a vertex that stands for a node; label: its patch, or -1 on a cap. */
static int vertex_add(maker *m, int patch, int node, int label)
{
    int k = m->vertices++, owner;
    const ves_figure_patch *p = &m->figure->patch[patch];
    int from = ves_figure_owner(m->figure, patch, node, &owner);
    for (int c = 0; c < 3; c++) m->point[3 * k + c] = m->figure->patch[owner].X[c][from];
    m->u[k] = ves_figure_u(p, node), m->v[k] = ves_figure_v(p, node);
    m->patch[k] = label;
    if (m->welded) return k;
    for (int c = 0; c < 3; c++) m->normal[3 * k + c] = p->normal[c][node];
    m->H[k] = p->H[node], m->K[k] = p->K[node], m->k1[k] = p->k1[node], m->k2[k] = p->k2[node];
    return k;
}

/* The triangles of a patch; vertex: that of each node. */
static void triangles_add(maker *m, int patch, const int *vertex)
{
    int *corner = m->corner + 3 * m->triangles;
    int count = ves_figure_triangles(&m->figure->patch[patch], corner);
    for (int k = 0; k < 3 * count; k++) corner[k] = vertex[corner[k]];
    m->triangles += count;
}

/* The triangles of a cap, and the middle of one that is a fan; vertex: those of the nodes of its rim. */
static void cap_add(maker *m, int patch, int end, const int *vertex)
{
    const ves_figure_patch *p = &m->figure->patch[patch];
    int *corner = m->corner + 3 * m->triangles, count = ves_figure_cap(p, end, corner), middle = -1;
    if (!p->lid[end]) {
        middle = vertex_add(m, patch, end ? p->nu * p->columns : 0, -1);
        ves_figure_middle(p, end, m->point + 3 * middle);
    }
    for (int k = 0; k < 3 * count; k++) corner[k] = corner[k] < 0 ? middle : vertex[corner[k]];
    m->triangles += count;
}

static bool capped(const ves_figure_patch *p, int end)
{
    return p->cap[end] && !p->pole[end];
}

/* --- patch by patch --- */

/* Of a pole only the first node becomes a vertex. */
static bool hidden(const ves_figure_patch *p, int node)
{
    int row = node / p->columns;
    bool pole = (row == 0 && p->pole[0]) || (row == p->nu && p->pole[1]);
    return pole && node % p->columns != 0;
}

/* A cap with vertices of its own, without curvature; normals are those of the triangles around each, which on
 * a flat cap are all the same. */
static void cap_lay(maker *m, int patch, int end, int *vertex)
{
    const ves_figure_patch *p = &m->figure->patch[patch];
    int row = end ? p->nu * p->columns : 0, first = m->vertices, triangle = m->triangles;
    for (int j = 0; j < p->columns; j++) vertex[row + j] = vertex_add(m, patch, row + j, -1);
    cap_add(m, patch, end, vertex);
    memset(m->normal + 3 * first, 0, 3 * sizeof *m->normal * (size_t)(m->vertices - first));
    for (const int *corner = m->corner + 3 * triangle; triangle < m->triangles; triangle++, corner += 3) {
        double area[3];
        ves_twice_area(m->point + 3 * corner[0], m->point + 3 * corner[1], m->point + 3 * corner[2], area);
        for (int k = 0; k < 9; k++) m->normal[3 * corner[k / 3] + k % 3] += area[k % 3];
    }
    for (int k = first; k < m->vertices; k++) {
        double *n = m->normal + 3 * k, size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int c = 0; c < 3 && size > 0; c++) n[c] /= size;
        m->H[k] = m->K[k] = m->k1[k] = m->k2[k] = 0;
    }
}

static void patch_lay(maker *m, int patch, int *vertex)
{
    const ves_figure_patch *p = &m->figure->patch[patch];
    for (int node = 0; node < p->rows * p->columns; node++)
        if (!hidden(p, node)) vertex[node] = vertex_add(m, patch, node, patch);
    triangles_add(m, patch, vertex);
    for (int end = 0; end < 2; end++)
        if (capped(p, end)) cap_lay(m, patch, end, vertex);
}

/* --- welded --- */

/* What the ends on one seam share. */
typedef struct seam {
    int first, columns; /* first vertex; columns 0: not met yet */
    bool pole, periodic;
} seam;

/* Vertices of an end: those of its seam when a patch before has made them. */
static ves_status end_weld(maker *m, seam *seams, int patch, int end, int *vertex)
{
    const ves_figure_patch *p = &m->figure->patch[patch];
    seam alone = {0}, *s = p->edge[end] < 0 ? &alone : &seams[p->edge[end]];
    int row = end ? p->nu * p->columns : 0, count = p->pole[end] ? 1 : p->columns;
    if (!s->columns) {
        *s = (seam){m->vertices, p->columns, p->pole[end], p->periodic};
        for (int j = 0; j < count; j++) vertex_add(m, patch, row + j, patch);
    }
    if (s->pole != p->pole[end] || (!s->pole && (s->columns != p->columns || s->periodic != p->periodic)))
        return VES_FAULT;
    for (int j = 0; j < p->columns; j++) vertex[row + j] = s->first + (s->pole ? 0 : j);
    return VES_OK;
}

static ves_status patch_weld(maker *m, seam *seams, int patch, int *vertex)
{
    const ves_figure_patch *p = &m->figure->patch[patch];
    const int *same = p->one_sided ? NULL : p->same;
    for (int end = 0; end < 2 && !same; end++) VES_TRY(end_weld(m, seams, patch, end, vertex));
    for (int k = same ? 0 : p->columns; k < (same ? p->rows : p->nu) * p->columns; k++)
        vertex[k] = same && same[k] != k ? vertex[same[k]] : vertex_add(m, patch, k, patch);
    triangles_add(m, patch, vertex);
    for (int end = 0; end < 2; end++)
        if (capped(p, end)) cap_add(m, patch, end, vertex);
    return VES_OK;
}

/* --- both --- */

/* Upper bounds of what a mesh can need. */
typedef struct room {
    size_t vertices, triangles, seams, nodes; /* nodes: of the largest patch */
} room;

static bool room_find(const ves_figure *figure, room *r)
{
    *r = (room){0};
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        if (p->nu < 1 || p->nv < 1 || p->rows != p->nu + 1 || p->columns != p->nv + !p->periodic)
            return false;
        size_t nodes = (size_t)p->rows * (size_t)p->columns, cells = (size_t)p->nu * (size_t)p->nv;
        r->vertices += nodes + 2 * (size_t)p->columns + 2;
        r->triangles += 2 * cells + 2 * (size_t)p->nv;
        if (nodes > r->nodes) r->nodes = nodes;
        for (int end = 0; end < 2; end++)
            if (p->edge[end] >= (int)r->seams) r->seams = (size_t)p->edge[end] + 1;
    }
    return true;
}

static ves_status maker_init(maker *m, ves_arena *arena, const room *r)
{
    double **plane[] = {&m->u, &m->v, &m->H, &m->K, &m->k1, &m->k2};
    bool good = (m->point = ves_arena_doubles(arena, 3 * r->vertices)) != NULL;
    good = (m->patch = ves_arena_take(arena, r->vertices, sizeof(int))) && good;
    good = (m->corner = ves_arena_take(arena, 3 * r->triangles, sizeof(int))) && good;
    for (int k = 0; k < (m->welded ? 2 : 6); k++)
        good = (*plane[k] = ves_arena_doubles(arena, r->vertices)) && good;
    if (!m->welded) good = (m->normal = ves_arena_doubles(arena, 3 * r->vertices)) && good;
    return good ? VES_OK : VES_MEMORY;
}

static ves_status make(maker *m, ves_arena *arena, ves_arena *scratch)
{
    room r;
    if (!room_find(m->figure, &r)) return VES_FAULT;
    VES_TRY(maker_init(m, arena, &r));
    seam *seams = ves_arena_take(scratch, r.seams, sizeof *seams);
    int *vertex = ves_arena_take(scratch, r.nodes, sizeof *vertex);
    if (!seams || !vertex) return VES_MEMORY;
    for (int k = 0; k < m->figure->patches; k++) {
        if (m->welded)
            VES_TRY(patch_weld(m, seams, k, vertex));
        else
            patch_lay(m, k, vertex);
    }
    return VES_OK;
}

ves_status ves_figure_mesh(ves_figure *figure, bool welded, ves_mesh *mesh)
{
    maker m = {.figure = figure, .welded = welded};
    ves_arena scratch = {0};
    *mesh = figure->mesh[welded];
    if (mesh->vertices) return VES_OK;
    ves_status status = make(&m, &figure->arena, &scratch);
    ves_arena_destroy(&scratch);
    if (status != VES_OK) return status;
    *mesh = (ves_mesh){m.vertices, m.triangles, m.point, m.corner, m.patch, m.u,
                       m.v,        m.normal,    m.H,     m.K,      m.k1,    m.k2};
    figure->mesh[welded] = *mesh;
    return VES_OK;
}
