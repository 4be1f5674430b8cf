/* Shells of one sheet from a formula, for tests of the shell room. */
#ifndef TEST_SHELL_CASE_H
#define TEST_SHELL_CASE_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "shell/shell.h"

enum { CASE_NODES = 40000 };

typedef struct shell_case shell_case;
typedef void case_surface(const shell_case *of, double u, double v, double X[3]);

struct shell_case {
    case_surface *surface;
    case_surface *across; /* the unit normal, or NULL: by differences */
    const double *number; /* what the surface is made of */
    double u[2], v[2];    /* ranges */
    int order, elements[2];
    double grading[2]; /* of both ends, exponent; 0: even */
    bool closed;
    double thickness;
    ves_shell_material material;
    /* made */
    ves_arena arena;
    ves_shell_sheet sheet;
    ves_shell_model model;
    ves_shell_input input;
    ves_shell_load load;
    ves_shell *shell;
    ves_shell_node *node;
    int rows, columns;
    double *at_u, *at_v, *X[3], *normal[3], *t, *plane[16];
    int planes;
    const double *Xs[1][3], *ns[1][3], *ts[1];
    const int *weld[1];
    double side[1];
    ves_shell_point point[4];
};

/* Normal by differences of order 4: about 1e-11. */
static inline void case_normal(const shell_case *c, double u, double v, double n[3])
{
    if (c->across) {
        c->across(c, u, v, n);
        return;
    }
    const double h[2] = {1e-3 * (c->u[1] - c->u[0]), 1e-3 * (c->v[1] - c->v[0])};
    double T[2][3] = {{0}};
    static const double W[4] = {1 / 12., -8 / 12., 8 / 12., -1 / 12.}, D[4] = {-2, -1, 1, 2};
    for (int k = 0; k < 4; k++)
        for (int d = 0; d < 2; d++) {
            double X[3];
            c->surface(c, u + (d == 0) * D[k] * h[0], v + (d == 1) * D[k] * h[1], X);
            for (int i = 0; i < 3; i++) T[d][i] += W[k] / h[d] * X[i];
        }
    ves_cross(T[0], T[1], n);
    double length = sqrt(ves_dot(n, n));
    for (int i = 0; i < 3; i++) n[i] /= length;
}

static inline double *case_plane(shell_case *c)
{
    return c->plane[c->planes++] = ves_arena_doubles(&c->arena, CASE_NODES);
}

/* Elements of 1 - |1 - 2 t|^(1 / g) ... : both ends graded like x^g. */
static inline double case_graded(double t, double g)
{
    if (!(g > 0)) return t;
    return t < 0.5 ? 0.5 * pow(2 * t, g) : 1 - 0.5 * pow(2 - 2 * t, g);
}

/* ring: a strip, one element of order 1 along v */
static inline void case_mesh_with(shell_case *c, bool ring)
{
    double *knot[2];
    for (int d = 0; d < 2; d++) {
        const double *range = d ? c->v : c->u;
        knot[d] = ves_arena_doubles(&c->arena, (size_t)c->elements[d] + 1);
        for (int k = 0; k <= c->elements[d]; k++)
            knot[d][k] =
                range[0] + (range[1] - range[0]) * case_graded((double)k / c->elements[d], c->grading[d]);
    }
    c->sheet = (ves_shell_sheet){.order = {c->order, ring ? 1 : c->order},
                                 .ring = ring,
                                 .elements = {c->elements[0], c->elements[1]},
                                 .knot = {knot[0], knot[1]},
                                 .closed = c->closed};
    c->rows = ves_shell_rows(&c->sheet), c->columns = ves_shell_columns(&c->sheet);
    c->at_u = case_plane(c), c->at_v = case_plane(c), c->t = case_plane(c);
    ves_shell_grid(&c->sheet, c->at_u, c->at_v);
    int *weld = ves_arena_take(&c->arena, CASE_NODES, sizeof *weld);
    c->node = ves_arena_take(&c->arena, CASE_NODES, sizeof *c->node);
    for (int i = 0; i < 3; i++) c->X[i] = case_plane(c), c->normal[i] = case_plane(c);
    for (int s = 0; s < c->rows * c->columns; s++) {
        double X[3], n[3], u = c->at_u[s % c->rows], v = c->at_v[s / c->rows];
        c->surface(c, u, v, X);
        case_normal(c, u, v, n);
        weld[s] = s, c->t[s] = c->thickness;
        for (int i = 0; i < 3; i++) c->X[i][s] = X[i], c->normal[i][s] = n[i], c->node[s].frame[i][i] = 1;
    }
    c->weld[0] = weld, c->side[0] = 1, c->ts[0] = c->t;
    for (int i = 0; i < 3; i++) c->Xs[0][i] = c->X[i], c->ns[0][i] = c->normal[i];
    c->model = (ves_shell_model){.sheets = 1,
                                 .sheet = &c->sheet,
                                 .nodes = c->rows * c->columns,
                                 .node = c->node,
                                 .weld = c->weld,
                                 .cases = 1};
    c->input = (ves_shell_input){.material = c->material,
                                 .X = c->Xs,
                                 .normal = c->ns,
                                 .thickness = c->ts,
                                 .side = c->side,
                                 .load = &c->load,
                                 .point = c->point};
}

static inline void case_mesh(shell_case *c)
{
    case_mesh_with(c, false);
}

enum { HELD_X = 1, HELD_Y = 2, HELD_Z = 4, HELD_RX = 8, HELD_RY = 16, HELD_RZ = 32, HELD_ALL = 63 };
/* Mirror planes across x, y, z. */
enum {
    MIRROR_X = HELD_X | HELD_RY | HELD_RZ,
    MIRROR_Y = HELD_Y | HELD_RX | HELD_RZ,
    MIRROR_Z = HELD_Z | HELD_RX | HELD_RY
};

static inline void case_hold(shell_case *c, int edge, unsigned held)
{
    for (int k = 0; k < ves_shell_edge_count(&c->sheet, edge); k++)
        c->node[ves_shell_edge_node(&c->sheet, edge, k)].held |= held;
}

/* A mirror plane with any normal. */
static inline void case_mirror(shell_case *c, int edge, const double normal[3])
{
    double e[3] = {fabs(normal[0]) < 0.5, fabs(normal[0]) >= 0.5, 0}, t[2][3];
    ves_cross(normal, e, t[0]);
    double length = sqrt(ves_dot(t[0], t[0]));
    for (int i = 0; i < 3; i++) t[0][i] /= length;
    ves_cross(normal, t[0], t[1]);
    for (int k = 0; k < ves_shell_edge_count(&c->sheet, edge); k++) {
        ves_shell_node *node = &c->node[ves_shell_edge_node(&c->sheet, edge, k)];
        for (int i = 0; i < 3; i++)
            node->frame[0][i] = normal[i], node->frame[1][i] = t[0][i], node->frame[2][i] = t[1][i];
        node->held |= MIRROR_X;
    }
}

static inline void case_push(shell_case *c, int s, double x, double y, double z)
{
    c->point[c->input.points++] = (ves_shell_point){.node = s, .force = {x, y, z}};
}

static inline double *case_constant(shell_case *c, double value)
{
    double *plane = case_plane(c);
    for (int s = 0; s < CASE_NODES; s++) plane[s] = value;
    return plane;
}

static inline ves_status case_solve(shell_case *c)
{
    VES_TRY(ves_shell_create(&c->model, &c->input, &c->arena, &c->shell));
    return ves_shell_solve(c->shell, &c->input);
}

static inline double case_moved(const shell_case *c, int s, double x, double y, double z)
{
    double U[3], n[3];
    ves_shell_displacement(c->shell, 0, 0, s, U, n);
    return x * U[0] + y * U[1] + z * U[2];
}

static inline void case_end(shell_case *c)
{
    ves_shell_destroy(c->shell);
    ves_arena_destroy(&c->arena);
}

#endif
