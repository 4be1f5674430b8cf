/* The elements of a whole shell: patches welded, and mirrored where they end in a plane of symmetry. */
#include <math.h>

#include "surface/elements.h"

/* Of the shell's size: what counts as lying in a plane. The plan's own joints are closed to about this. */
static const double FLAT = 1e-6;

typedef struct maker {
    const ves_figure *figure;
    ves_arena *arena;
    ves_elements *out;
    bool plane[3];     /* there is a plane of symmetry across this axis, */
    double at[3];      /* here */
    unsigned char *on; /* [grid] bits: lies in the plane across that axis */
    int *number;
} maker;

static void refuse(maker *m, const char *why)
{
    if (!m->out->refused) m->out->refused = why ? why : "out of memory";
}

static int flat(const maker *m, int patch, int node)
{
    return m->out->first[patch] + node;
}

/* The node that stands for all that are welded to it. */
static int welded(const maker *m, int patch, int node)
{
    const ves_figure_patch *p = &m->figure->patch[patch];
    int row = node / p->columns, owner;
    if ((row == 0 && p->pole[0]) || (row == p->nu && p->pole[1])) node = row * p->columns;
    int from = ves_figure_owner(m->figure, patch, node, &owner);
    return flat(m, owner, from);
}

static double size_of(const ves_figure *figure)
{
    double low[3], high[3], most = 0;
    if (!ves_figure_box(figure, low, high)) return 0;
    for (int c = 0; c < 3; c++) most = fmax(most, high[c] - low[c]);
    return most;
}

static int axis_of(const double axis[3])
{
    for (int c = 0; c < 3; c++)
        if (fabs(axis[c]) > 1 - 1e-12) return c;
    return -1;
}

/* Takes a plane of symmetry from a support. */
static void plane_take(maker *m, const ves_figure_support *support, double size)
{
    int axis = axis_of(support->axis);
    const ves_figure *figure = m->figure;
    if (axis < 0) {
        refuse(m, ves_arena_format(m->arena,
                                   "\"%s\" is a plane of symmetry across none of x, y and z, which cannot be "
                                   "mirrored, and CalculiX is far too stiff where single rotations are held",
                                   support->text));
        return;
    }
    double at = figure->patch[support->node[0][0]].X[axis][support->node[0][1]];
    if (m->plane[axis]) at = m->at[axis];
    m->plane[axis] = true, m->at[axis] = at;
    for (int k = 0; k < support->nodes; k++) {
        int patch = support->node[k][0], node = support->node[k][1];
        if (fabs(figure->patch[patch].X[axis][node] - at) > FLAT * size)
            refuse(m, ves_arena_format(m->arena, "\"%s\" does not lie in one plane of symmetry across %c",
                                       support->text, "xyz"[axis]));
        m->on[welded(m, patch, node)] |= (unsigned char)(1 << axis);
    }
}

static void images_make(maker *m)
{
    ves_elements *out = m->out;
    out->images = 1;
    for (int c = 0; c < 3; c++) out->sign[0][c] = 1;
    for (int axis = 0; axis < 3; axis++) {
        if (!m->plane[axis]) continue;
        for (int k = 0; k < out->images; k++) {
            for (int c = 0; c < 3; c++)
                out->sign[out->images + k][c] = out->sign[k][c] * (c == axis ? -1 : 1);
            out->turned[out->images + k] = !out->turned[k];
        }
        out->images *= 2;
    }
}

/* The image of a node, and the same node in the first image that has it: one in a plane of symmetry is its
 * own image. */
static int image_of(const maker *m, int image, unsigned on)
{
    int bit = 1, found = image;
    for (int axis = 0; axis < 3; axis++) {
        if (!m->plane[axis]) continue;
        if (on & (1u << axis)) found &= ~bit;
        bit *= 2;
    }
    return found;
}

/* Gives a number to a node that has none, and to those that are welded to it. */
static void number_give(maker *m, int image, int patch, int node)
{
    ves_elements *out = m->out;
    int own = welded(m, patch, node), from = image_of(m, image, m->on[own]);
    int *first = &m->number[from * out->grid + own];
    if (*first < 0) {
        const ves_figure_patch *p = m->figure->patch;
        int k = m->figure->patches - 1;
        while (out->first[k] > own) k--;
        for (int c = 0; c < 3; c++) {
            double x = p[k].X[c][own - out->first[k]];
            if (m->on[own] & (1u << c)) x = m->at[c];
            out->point[out->nodes][c] = out->sign[from][c] < 0 ? 2 * m->at[c] - x : x;
        }
        *first = out->nodes++;
    }
    m->number[image * out->grid + own] = *first;
    m->number[image * out->grid + flat(m, patch, node)] = *first;
}

static void patch_number(maker *m, int image, int patch)
{
    const ves_figure_patch *p = &m->figure->patch[patch];
    for (int i = 0; i <= p->nu; i++)
        for (int j = 0; j < p->columns; j++)
            if (i % 2 == 0 || j % 2 == 0) number_give(m, image, patch, i * p->columns + j);
    m->out->elements += p->nu * p->nv / 4;
}

static ves_status room_make(maker *m)
{
    const ves_figure *figure = m->figure;
    ves_elements *out = m->out;
    int *first = ves_arena_take(m->arena, (size_t)figure->patches, sizeof *first);
    if (!first) return VES_MEMORY;
    for (int k = 0; k < figure->patches; k++) {
        first[k] = out->grid;
        out->grid += figure->patch[k].rows * figure->patch[k].columns;
    }
    out->first = first;
    m->on = ves_arena_take(m->arena, (size_t)out->grid, sizeof *m->on);
    return m->on ? VES_OK : VES_MEMORY;
}

ves_status ves_elements_make(const ves_figure *figure, ves_arena *arena, ves_elements *elements)
{
    const ves_figure_shell *shell = figure->shell;
    maker m = {.figure = figure, .arena = arena, .out = elements};
    *elements = (ves_elements){0};
    VES_TRY(room_make(&m));
    for (int k = 0; k < shell->supports; k++)
        if (shell->support[k].mirror) plane_take(&m, &shell->support[k], size_of(figure));
    if (elements->refused) return VES_OK;
    images_make(&m);
    size_t most = (size_t)(elements->images * elements->grid);
    m.number = ves_arena_take(arena, most, sizeof *m.number);
    elements->point = ves_arena_take(arena, most, sizeof *elements->point);
    if (!m.number || !elements->point) return VES_MEMORY;
    for (size_t k = 0; k < most; k++) m.number[k] = -1;
    for (int image = 0; image < elements->images; image++)
        for (int k = 0; k < figure->patches; k++)
            if (shell->thickness[k]) patch_number(&m, image, k);
    elements->number = m.number;
    return VES_OK;
}

int ves_elements_nodes(const ves_elements *elements, const ves_figure *figure, const int at[4],
                       int node[VES_ELEMENT_NODES])
{
    ves_figure_patch patch = figure->patch[at[1]];
    if (elements->turned[at[0]]) patch.side = -patch.side;
    int count = ves_element_nodes(&patch, at[2], at[3], node);
    for (int k = 0; k < count; k++)
        node[k] = elements->number[at[0] * elements->grid + elements->first[at[1]] + node[k]];
    return count;
}
