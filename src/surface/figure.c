#include "surface/figure.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

double ves_figure_u(const ves_figure_patch *patch, int node)
{
    return (double)(node / patch->columns) / patch->nu;
}

double ves_figure_v(const ves_figure_patch *patch, int node)
{
    bool whole = patch->v_min == 0 && patch->v_max == 0;
    double range = whole ? VES_TWO_PI : patch->v_max - patch->v_min;
    double slide = node / patch->columns == patch->nu ? patch->slide : 0;
    return patch->v_min + node % patch->columns * range / patch->nv + slide;
}

static void times(double *plane, int count, double factor)
{
    for (int k = 0; plane && k < count; k++) plane[k] *= factor;
}

static void field_scale(const ves_figure *figure, const ves_figure_field *field, double factor)
{
    for (int k = 0; k < figure->patches && field->power; k++) {
        int count = figure->patch[k].rows * figure->patch[k].columns;
        times(field->value[k], count, pow(factor, field->power));
        for (int c = 0; field->vector && c < 3; c++)
            times(field->vector[k][c], count, pow(factor, field->power));
    }
}

int ves_figure_fields(const ves_figure *figure, const char *word, const ves_figure_field **field)
{
    int found = 0;
    for (int k = 0; figure->shell && k < figure->shell->fields; k++) {
        const ves_figure_field *f = &figure->shell->field[k];
        size_t length = strlen(f->name);
        bool named = !strncmp(word, f->name, length) && (!word[length] || (word[length] == ':' && f->of));
        if (!named || (word[length] && strcmp(word + length + 1, f->of) != 0)) continue;
        if (found++ == 0) *field = f;
    }
    return found;
}

/* Newtons and seconds stay. */
static void shell_scale(const ves_figure *figure, double factor)
{
    ves_figure_shell *shell = figure->shell;
    shell->E /= factor * factor;
    shell->density /= factor * factor * factor * factor;
    for (int k = 0; k < figure->patches; k++)
        times(shell->thickness[k], figure->patch[k].rows * figure->patch[k].columns, factor);
    for (int k = 0; k < shell->supports; k++)
        for (int n = 0; shell->support[k].spring && n < shell->support[k].nodes; n++)
            times(shell->support[k].spring[n], 3, 1 / factor);
    for (int k = 0; k < shell->fields; k++) field_scale(figure, &shell->field[k], factor);
}

void ves_figure_scale(ves_figure *figure, double factor, const char *unit)
{
    figure->unit = unit;
    if (figure->shell) shell_scale(figure, factor);
    for (int k = 0; k < figure->patches; k++) {
        ves_figure_patch *p = &figure->patch[k];
        int count = p->rows * p->columns;
        for (int c = 0; c < 3; c++) times(p->X[c], count, factor), times(p->spine[c], p->rows, factor);
        times(p->H, count, 1 / factor);
        times(p->k1, count, 1 / factor);
        times(p->k2, count, 1 / factor);
        times(p->K, count, 1 / (factor * factor));
    }
}

bool ves_figure_box(const ves_figure *figure, double low[3], double high[3])
{
    for (int c = 0; c < 3; c++) low[c] = HUGE_VAL, high[c] = -HUGE_VAL;
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        for (int c = 0; c < 3; c++)
            for (int s = 0; s < p->rows * p->columns; s++)
                if (isfinite(p->X[c][s]))
                    low[c] = fmin(low[c], p->X[c][s]), high[c] = fmax(high[c], p->X[c][s]);
    }
    return low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2];
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

void ves_figure_destroy(ves_figure *figure)
{
    if (!figure) return;
    ves_arena_destroy(&figure->arena);
    ves_memory_free(figure);
}
