#include "surface/figure.h"

#include <math.h>

static const double two_pi = 6.283185307179586;

double ves_figure_u(const ves_figure_patch *patch, int node)
{
    return (double)(node / patch->columns) / patch->nu;
}

double ves_figure_v(const ves_figure_patch *patch, int node)
{
    bool whole = patch->v_min == 0 && patch->v_max == 0;
    double range = whole ? two_pi : patch->v_max - patch->v_min;
    double slide = node / patch->columns == patch->nu ? patch->slide : 0;
    return patch->v_min + node % patch->columns * range / patch->nv + slide;
}

/* Node (i, j) with j running on past the seam of a periodic patch, and a pole as its first node. */
static int node_at(const ves_figure_patch *patch, int i, int j)
{
    bool pole = (i == 0 && patch->pole[0]) || (i == patch->nu && patch->pole[1]);
    return i * patch->columns + (pole ? 0 : j % patch->columns);
}

static double distance2(const ves_figure_patch *patch, int a, int b)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double d = patch->X[c][a] - patch->X[c][b];
        sum += d * d;
    }
    return sum;
}

/* Adds a triangle, turned round when the patch looks inward; one that a pole has shut is left out. */
static int put(const ves_figure_patch *patch, int *corner, int a, int b, int c)
{
    if (a == b || b == c || c == a) return 0;
    bool flip = patch->side < 0;
    corner[0] = a;
    corner[1] = flip ? c : b;
    corner[2] = flip ? b : c;
    return 1;
}

int ves_figure_triangles(const ves_figure_patch *patch, int *corner)
{
    int count = 0;
    for (int i = 0; i < patch->nu; i++) {
        for (int j = 0; j < patch->nv; j++) {
            int a = node_at(patch, i, j), b = node_at(patch, i + 1, j);
            int c = node_at(patch, i + 1, j + 1), d = node_at(patch, i, j + 1);
            /* Equal diagonals are cut the same way whatever rounding says, so that regular shapes get regular
             * meshes. */
            if (distance2(patch, a, c) <= distance2(patch, b, d) * (1 + 1e-9)) {
                count += put(patch, corner + 3 * count, a, b, c);
                count += put(patch, corner + 3 * count, a, c, d);
            } else {
                count += put(patch, corner + 3 * count, a, b, d);
                count += put(patch, corner + 3 * count, b, c, d);
            }
        }
    }
    return count;
}

void ves_figure_middle(const ves_figure_patch *patch, int end, double middle[3])
{
    int first = end ? patch->nu * patch->columns : 0;
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int j = 0; j < patch->nv; j++) sum += patch->X[c][first + j];
        middle[c] = sum / patch->nv;
    }
}

int ves_figure_cap(const ves_figure_patch *patch, int end, int *corner)
{
    int row = end ? patch->nu : 0, count = patch->lid[end] ? patch->nv - 2 : patch->nv;
    bool flip = (end == 1) != (patch->side < 0);
    for (int t = 0; t < count; t++) {
        const int fan[3] = {t, t + 1, -1}, *turn = patch->lid[end] ? patch->lid[end] + 3 * t : fan;
        for (int k = 0; k < 3; k++) {
            int j = turn[flip && k < 2 ? 1 - k : k];
            corner[3 * t + k] = j < 0 ? -1 : node_at(patch, row, j);
        }
    }
    return count;
}

int ves_figure_owner(const ves_figure *figure, int patch, int node, int *owner)
{
    const ves_figure_patch *p = &figure->patch[patch];
    int row = node / p->columns, seam = row == 0 ? p->edge[0] : row == p->nu ? p->edge[1] : -1;
    *owner = patch;
    if (p->same) return p->same[node];
    for (int k = 0; seam >= 0 && k <= patch; k++) {
        const ves_figure_patch *q = &figure->patch[k];
        for (int end = 0; end < 2; end++) {
            if (q->edge[end] != seam) continue;
            *owner = k;
            return end * q->nu * q->columns + (q->pole[end] ? 0 : node % p->columns);
        }
    }
    return node;
}

/* What the ends on one seam share. */
typedef struct seam {
    int first, columns; /* first vertex; columns 0: not met yet */
    bool pole, periodic;
} seam;

typedef struct weld {
    ves_mesh *mesh;
    int *patch_of, *node_of; /* [vertices] */
    seam *seam;
} weld;

static int vertex_add(weld *w, const double x[3], int patch, int node)
{
    int v = w->mesh->vertices++;
    for (int c = 0; c < 3; c++) w->mesh->point[3 * v + c] = x[c];
    w->patch_of[v] = patch;
    w->node_of[v] = node;
    return v;
}

static int node_add(weld *w, const ves_figure *figure, int patch, int node)
{
    const ves_figure_patch *p = &figure->patch[patch];
    int at = p->same ? p->same[node] : node; /* a seam that must stay open still shows no gap */
    double x[3] = {p->X[0][at], p->X[1][at], p->X[2][at]};
    return vertex_add(w, x, patch, node);
}

/* Vertices of an end: those of its seam when a patch before has made them. */
static ves_status end_weld(weld *w, const ves_figure *figure, int patch, int end, int *vertex)
{
    const ves_figure_patch *p = &figure->patch[patch];
    seam alone = {0}, *s = p->edge[end] < 0 ? &alone : &w->seam[p->edge[end]];
    int row = end ? p->nu * p->columns : 0, count = p->pole[end] ? 1 : p->columns;
    if (!s->columns) {
        *s = (seam){w->mesh->vertices, p->columns, p->pole[end], p->periodic};
        for (int j = 0; j < count; j++) node_add(w, figure, patch, row + j);
    }
    if (s->pole != p->pole[end] || (!s->pole && (s->columns != p->columns || s->periodic != p->periodic)))
        return VES_FAULT;
    for (int j = 0; j < p->columns; j++) vertex[row + j] = s->first + (s->pole ? 0 : j);
    return VES_OK;
}

static void cap_weld(weld *w, const ves_figure *figure, int patch, int end, const int *vertex)
{
    const ves_figure_patch *p = &figure->patch[patch];
    int *corner = w->mesh->corner + 3 * w->mesh->triangles, count = ves_figure_cap(p, end, corner);
    double x[3];
    ves_figure_middle(p, end, x);
    int middle = p->lid[end] ? -1 : vertex_add(w, x, -1, -1);
    for (int k = 0; k < 3 * count; k++) corner[k] = corner[k] < 0 ? middle : vertex[corner[k]];
    w->mesh->triangles += count;
}

static ves_status patch_weld(weld *w, const ves_figure *figure, int patch, int *vertex)
{
    const ves_figure_patch *p = &figure->patch[patch];
    const int *same = p->one_sided ? NULL : p->same;
    for (int end = 0; end < 2 && !same; end++) VES_TRY(end_weld(w, figure, patch, end, vertex));
    for (int k = same ? 0 : p->columns; k < (same ? p->rows : p->nu) * p->columns; k++)
        vertex[k] = same && same[k] != k ? vertex[same[k]] : node_add(w, figure, patch, k);
    int *corner = w->mesh->corner + 3 * w->mesh->triangles;
    int count = ves_figure_triangles(p, corner);
    for (int k = 0; k < 3 * count; k++) corner[k] = vertex[corner[k]];
    w->mesh->triangles += count;
    for (int end = 0; end < 2; end++)
        if (p->cap[end] && !p->pole[end]) cap_weld(w, figure, patch, end, vertex);
    return VES_OK;
}

/* Upper bounds of what welding can make. */
typedef struct room {
    int vertices, triangles, seams, nodes; /* nodes: of the largest patch */
} room;

static bool room_find(const ves_figure *figure, room *r)
{
    *r = (room){0};
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        int nodes = p->rows * p->columns;
        if (p->nu < 1 || p->nv < 1 || p->rows != p->nu + 1 || p->columns != p->nv + !p->periodic)
            return false;
        r->vertices += nodes + 2;
        r->triangles += 2 * p->nu * p->nv + 2 * p->nv;
        if (nodes > r->nodes) r->nodes = nodes;
        for (int end = 0; end < 2; end++)
            if (p->edge[end] >= r->seams) r->seams = p->edge[end] + 1;
    }
    return true;
}

static ves_status weld_all(ves_figure *figure, const room *r, weld *w, ves_arena *scratch)
{
    ves_arena *arena = &figure->arena;
    w->mesh->point = ves_arena_doubles(arena, 3 * (size_t)r->vertices);
    w->mesh->corner = ves_arena_take(arena, 3 * (size_t)r->triangles, sizeof(int));
    w->patch_of = ves_arena_take(arena, (size_t)r->vertices, sizeof(int));
    w->node_of = ves_arena_take(arena, (size_t)r->vertices, sizeof(int));
    w->seam = ves_arena_take(scratch, (size_t)r->seams, sizeof(seam));
    int *vertex = ves_arena_take(scratch, (size_t)r->nodes, sizeof *vertex);
    if (!w->mesh->point || !w->mesh->corner || !w->patch_of || !w->node_of || !w->seam || !vertex)
        return VES_MEMORY;
    for (int k = 0; k < figure->patches; k++) VES_TRY(patch_weld(w, figure, k, vertex));
    return VES_OK;
}

ves_status ves_figure_mesh(ves_figure *figure, ves_mesh *mesh, int **vertex_patch, int **vertex_node)
{
    room r;
    ves_mesh made = {0};
    ves_arena scratch = {0};
    weld w = {.mesh = &made};
    if (!room_find(figure, &r)) return VES_FAULT;
    ves_status status = weld_all(figure, &r, &w, &scratch);
    ves_arena_destroy(&scratch);
    if (status != VES_OK) return status;
    *mesh = made;
    if (vertex_patch) *vertex_patch = w.patch_of;
    if (vertex_node) *vertex_node = w.node_of;
    return VES_OK;
}

void ves_figure_destroy(ves_figure *figure)
{
    if (!figure) return;
    ves_arena_destroy(&figure->arena);
    ves_memory_free(figure);
}
