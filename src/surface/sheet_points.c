/* Sheets through a grid of points: a tensor product of cardinal cubic splines, linear in the points. */
#include "base/vector.h"
#include "surface/sheet.h"

#include <math.h>
#include <stdlib.h>

/* One direction: second derivatives at the knots are a matrix times the values (knots at 0, 1, 2 ...). */
typedef struct spline {
    int knots;
    bool periodic;
    double *moment; /* [knots][knots] */
} spline;

typedef struct grid_of_points {
    int rows, columns, points;
    spline u, v;
} grid_of_points;

typedef struct tables {
    double *u[3], *v[3]; /* [derivative][node][knot] */
} tables;

/* Second derivatives at the knots from values y there, spline by spline of the unit vectors y = e_c:
 *     m_{k-1} + 4 m_k + m_{k+1} = 6 (y_{k-1} - 2 y_k + y_{k+1}). */
static double right_side(int k, int c)
{
    return abs(k - c) > 1 ? 0 : k == c ? -12 : 6;
}

/* The right side is 6 times what [1 4 1] makes of y, less 36 y: m = 6 y - 36 G y, where the inverse of the
 * cyclic [1 4 1] is G_j = (z^j + z^(n-j)) / ((1 - z^n) 2 sqrt(3)), z = sqrt(3) - 2. */
static void closed_moments(spline *s)
{
    int n = s->knots;
    double z = sqrt(3) - 2, scale = 36 / ((1 - pow(z, n)) * 2 * sqrt(3));
    for (int k = 0; k < n; k++)
        for (int c = 0; c < n; c++) {
            int j = (k - c + n) % n;
            s->moment[k * n + c] = (j ? 0 : 6) - scale * (pow(z, j) + pow(z, n - j));
        }
}

/* Not-a-knot ends: the third derivative goes on through the second knot, m_0 - 2 m_1 + m_2 = 0, so that 6 m_1
 * is its right side; between m_1 and m_{n-2} Thomas's elimination. Two knots make a line, three a
 * parabola. */
static void open_moments(spline *s, double *up)
{
    int n = s->knots, last = n - 2;
    for (int c = 0; c < n && n > 2; c++) {
        double *m = s->moment + c; /* m_k at k * n */
        m[n] = right_side(1, c) / 6;
        m[last * n] = right_side(last, c) / 6;
        up[1] = 0;
        for (int k = 2; k < last; k++) {
            double pivot = 4 - up[k - 1];
            up[k] = 1 / pivot;
            m[k * n] = (right_side(k, c) - m[(k - 1) * n]) / pivot;
        }
        for (int k = last - 1; k > 1; k--) m[k * n] -= up[k] * m[(k + 1) * n];
        m[0] = n > 3 ? 2 * m[n] - m[2 * n] : m[n];
        m[(n - 1) * n] = n > 3 ? 2 * m[last * n] - m[(last - 1) * n] : m[n];
    }
}

static ves_status spline_create(int n, bool periodic, ves_arena *arena, spline *s)
{
    *s = (spline){.knots = n, .periodic = periodic};
    double *room = ves_arena_doubles(arena, (size_t)n);
    s->moment = ves_arena_take(arena, (size_t)n * (size_t)n, sizeof *s->moment); /* zeros: those of a line */
    if (!room || !s->moment) return VES_MEMORY;
    if (periodic)
        closed_moments(s);
    else
        open_moments(s, room);
    return VES_OK;
}

/* Row of cardinal values at parameter t in [0, 1] (whole range), derivative d with respect to the surface
 * coordinate. */
static void spline_row(const spline *s, double t, double range, int d, double *row)
{
    int n = s->knots, pieces = s->periodic ? n : n - 1;
    double x = t * pieces;
    int k = (int)floor(x);
    k = k < 0 ? 0 : k > pieces - 1 ? pieces - 1 : k;
    double p = x - k, q = 1 - p, scale = pow(pieces / range, d);
    int next = (k + 1) % n;
    const double value[3][4] = {{q, p, (q * q * q - q) / 6, (p * p * p - p) / 6},
                                {-1, 1, -(3 * q * q - 1) / 6, (3 * p * p - 1) / 6},
                                {0, 0, q, p}};
    const double *w = value[d];
    for (int c = 0; c < n; c++)
        row[c] = scale * (w[2] * s->moment[k * n + c] + w[3] * s->moment[next * n + c]);
    row[k] += scale * w[0];
    row[next] += scale * w[1];
}

static void rows_fill(const grid_of_points *g, const ves_grid *grid, const tables *t)
{
    for (int d = 0; d < 3; d++) {
        for (int i = 0; i < grid->nu; i++) spline_row(&g->u, grid->u[i], 1, d, t->u[d] + i * g->rows);
        for (int j = 0; j < grid->nv; j++)
            spline_row(&g->v, grid->v[j] / VES_TWO_PI, VES_TWO_PI, d, t->v[d] + j * g->columns);
    }
}

static void move(ves_chart *chart)
{
    const ves_sheet *s = chart->state;
    rows_fill(chart->patch->state, chart->grid, s->tables);
    ves_sheet_move(chart);
}

static ves_status chart_create(ves_patch *patch, ves_chart *chart, ves_arena *arena)
{
    const grid_of_points *g = patch->state;
    const ves_grid *grid = chart->grid;
    ves_sheet *sheet;
    VES_TRY(ves_sheet_create(chart, (size_t)g->rows, arena, &sheet));
    tables *t = ves_arena_take(arena, 1, sizeof *t);
    if (!t) return VES_MEMORY;
    for (int d = 0; d < 3; d++) {
        t->u[d] = ves_arena_doubles(arena, (size_t)(grid->nu * g->rows));
        t->v[d] = ves_arena_doubles(arena, (size_t)(grid->nv * g->columns));
        if (!t->u[d] || !t->v[d]) return VES_MEMORY;
    }
    rows_fill(g, grid, t);
    sheet->tables = t;
    return VES_OK;
}

static ves_status prepare(ves_chart *chart, const ves_bound *bound, bool gradient)
{
    const grid_of_points *g = chart->patch->state;
    ves_sheet *s = chart->state;
    const tables *t = s->tables;
    const ves_grid *grid = chart->grid;
    (void)gradient;
    if (!ves_sheet_stale(chart)) return VES_OK;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++)
            for (int j = 0; j < grid->nv; j++) {
                const double *row = t->v[ves_field_e[f]] + j * g->columns;
                for (int r = 0; r < g->rows; r++) {
                    s->room[r] = 0;
                    for (int k = 0; k < g->columns; k++)
                        s->room[r] += row[k] * bound->number[g->points + 3 * (r * g->columns + k) + c];
                }
                for (int i = 0; i < grid->nu; i++) {
                    const double *w = t->u[ves_field_d[f]] + i * g->rows;
                    double sum = 0;
                    for (int r = 0; r < g->rows; r++) sum += w[r] * s->room[r];
                    s->plane[f][c][j * grid->nu + i] = sum;
                }
            }
    return VES_OK;
}

static void gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint)
{
    (void)bound;
    const grid_of_points *g = chart->patch->state;
    ves_sheet *s = chart->state;
    const tables *t = s->tables;
    const ves_grid *grid = chart->grid;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++)
            for (int j = 0; j < grid->nv; j++) {
                const double *row = t->v[ves_field_e[f]] + j * g->columns;
                for (int r = 0; r < g->rows; r++) {
                    double sum = 0;
                    for (int i = 0; i < grid->nu; i++)
                        sum += t->u[ves_field_d[f]][i * g->rows + r] * s->adjoint[f][c][j * grid->nu + i];
                    for (int k = 0; k < g->columns; k++)
                        number_adjoint[g->points + 3 * (r * g->columns + k) + c] += row[k] * sum;
                }
            }
}

static long point_room(const ves_patch *patch)
{
    const grid_of_points *g = patch->state;
    return g->rows + g->columns;
}

static void point(const ves_patch *patch, const ves_bound *bound, int count, const double *u, const double *v,
                  double *out, double *room)
{
    const grid_of_points *g = patch->state;
    double *ru = room, *rv = room + g->rows;
    for (int k = 0; k < count; k++)
        for (int f = 0; f < VES_FIELDS; f++) {
            spline_row(&g->u, u[k], 1, ves_field_d[f], ru);
            spline_row(&g->v, v[k] / VES_TWO_PI, VES_TWO_PI, ves_field_e[f], rv);
            for (int c = 0; c < 3; c++) {
                double sum = 0;
                for (int r = 0; r < g->rows; r++)
                    for (int m = 0; m < g->columns; m++)
                        sum += ru[r] * rv[m] * bound->number[g->points + 3 * (r * g->columns + m) + c];
                out[(f * 3 + c) * count + k] = sum;
            }
        }
}

static const ves_patch_ops POINTS = {.chart = chart_create,
                                     .move = move,
                                     .bind = ves_sheet_idle_bind,
                                     .prepare = prepare,
                                     .sample = ves_sheet_sample,
                                     .clear = ves_sheet_idle_clear,
                                     .clear_chart = ves_sheet_clear,
                                     .scatter = ves_sheet_scatter,
                                     .gather = gather,
                                     .unbind = ves_sheet_idle_unbind,
                                     .point_room = point_room,
                                     .point = point};

ves_status ves_patch_points(int rows, int columns, int points, bool periodic, const ves_bound *bound,
                            ves_arena *arena, ves_patch **patch)
{
    *patch = NULL;
    grid_of_points *g = ves_arena_take(arena, 1, sizeof *g);
    ves_patch *made = ves_arena_take(arena, 1, sizeof *made);
    if (!g || !made) return VES_MEMORY;
    *g = (grid_of_points){.rows = rows, .columns = columns, .points = points};
    VES_TRY(spline_create(rows, false, arena, &g->u));
    VES_TRY(spline_create(columns, periodic, arena, &g->v));
    *made = (ves_patch){.ops = &POINTS, .periodic = periodic, .state = g};
    for (int k = 0; k < 3 * rows * columns; k++) made->varies = made->varies || bound->varying[points + k];
    *patch = made;
    return VES_OK;
}
