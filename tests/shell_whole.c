/* What whole shells must do exactly: work is energy, supports hold what loads push, and no frame or
 * numbering matters. */
#include <criterion/criterion.h>

#include "shell/inside.h"
#include "shell_case.h"

static const int ORDERS[] = {1, 2, 6};
enum { ORDER_COUNT = sizeof ORDERS / sizeof *ORDERS };

/* A piece of a bent and twisted tube, clamped at u0, on springs at u1, loaded in every way. turn: all of it
 * turned; swapped: u and v change places. */
typedef struct whole {
    shell_case c;
    ves_shell_spring spring;
    double number[1], turn[3][3];
    bool sprung, askew; /* the last node is on springs; in a frame of its own */
} whole;

static void tube_surface(const shell_case *c, double u, double v, double X[3])
{
    bool swapped = c->number[0] > 0;
    double a = swapped ? v : u, b = (swapped ? u : v) + 0.4 * a, r = 0.7 + 0.1 * a;
    X[0] = (2 + r * cos(b)) * cos(a), X[1] = (2 + r * cos(b)) * sin(a), X[2] = r * sin(b) + 0.3 * a;
}

static void apply(const double turn[3][3], const double a[3], double out[3])
{
    for (int r = 0; r < 3; r++) out[r] = ves_dot(turn[r], a);
}

static const double AREA[3] = {30, -20, 50}, LINE[3] = {-4, 7, 3}, POINT[3] = {2, 1, -5}, PRESSURE = 100,
                    SPRING = 3000;

static void planes(whole *w, const double a[3], const double *to[3])
{
    double turned[3];
    apply((const double(*)[3])w->turn, a, turned);
    for (int c = 0; c < 3; c++) to[c] = case_constant(&w->c, turned[c]);
}

static void whole_turned(whole *w)
{
    shell_case *c = &w->c;
    for (int s = 0; s < c->rows * c->columns; s++) {
        double X[3], n[3], Y[3], m[3];
        for (int i = 0; i < 3; i++) X[i] = c->X[i][s], n[i] = c->normal[i][s] * c->side[0];
        apply((const double(*)[3])w->turn, X, Y);
        apply((const double(*)[3])w->turn, n, m);
        for (int i = 0; i < 3; i++) {
            c->X[i][s] = Y[i], c->normal[i][s] = m[i];
            for (int k = 0; k < 3; k++) c->node[s].frame[k][i] = w->turn[i][k];
        }
    }
}

static void whole_solve(whole *w, int order, bool swapped)
{
    shell_case *c = &w->c;
    int n = order == 1   ? 8
            : order == 2 ? 4
                         : 2,
        clamped = swapped ? 2 : 0, sprung = clamped + 1, loaded = swapped ? 0 : 2;
    w->number[0] = swapped;
    *c = (shell_case){.surface = tube_surface,
                      .number = w->number,
                      .u = {0, 1},
                      .v = {0, 1},
                      .order = order,
                      .elements = {n, n},
                      .thickness = 0.05,
                      .material = {1e6, 0.3, 5. / 6}};
    case_mesh(c);
    c->side[0] = swapped ? -1 : 1;
    whole_turned(w);
    case_hold(c, clamped, HELD_ALL);
    w->spring = (ves_shell_spring){.edge = sprung, .stiffness = {SPRING, SPRING, SPRING}};
    c->model.springs = 1, c->model.spring = &w->spring;
    planes(w, AREA, c->load.area);
    planes(w, LINE, c->load.line[loaded]);
    c->load.pressure = case_constant(c, PRESSURE);
    double force[3];
    apply((const double(*)[3])w->turn, POINT, force);
    case_push(c, c->rows * c->columns - 1, force[0], force[1], force[2]);
    static const double FRAME[3][3] = {{0.6, 0.8, 0}, {-0.48, 0.36, 0.8}, {0.64, -0.48, 0.6}};
    ves_shell_node *last = &c->node[c->rows * c->columns - 1];
    for (int i = 0; i < 3 && w->sprung; i++) last->spring[i] = 100 * (i + 1);
    if (w->askew) memcpy(last->frame, FRAME, sizeof FRAME);
    cr_assert(case_solve(c) == VES_OK);
}

static whole *whole_make(void)
{
    whole *w = calloc(1, sizeof *w);
    for (int i = 0; i < 3; i++) w->turn[i][i] = 1;
    return w;
}

static void whole_end(whole *w)
{
    case_end(&w->c);
    free(w);
}

/* The energy of an element; adds to force [nodes of the sheet][3] what it holds its nodes with. Columns are
 * x, y, z of moves and of changes of the director: no freedoms, no axes. */
static double element_energy(ves_shell *shell, const shell_element *e, double (*force)[3])
{
    enum { SIX = 6 };
    ves_shell_body body = ves_shell_gather(shell, e);
    int count = SIX * body.kind->nodes;
    ves_arena arena = {0};
    ves_shell_column *column = ves_arena_take(&arena, (size_t)count, sizeof *column);
    double *K = ves_arena_doubles(&arena, (size_t)(count * count)),
           *u = ves_arena_doubles(&arena, (size_t)count), energy = 0;
    ves_shell_scratch scratch;
    cr_assert(ves_shell_scratch_make(body.kind, 1, count, &arena, &scratch) == VES_OK);
    for (int k = 0; k < body.kind->nodes; k++) {
        double U[3], n[3], half = sqrt(ves_dot(body.V[k], body.V[k])) * shell->input->side[0];
        ves_shell_displacement(shell, 0, e->sheet, e->s[k], U, n);
        for (int i = 0; i < SIX; i++) {
            column[SIX * k + i] = (ves_shell_column){.node = k, .turns = i > 2};
            column[SIX * k + i].vector[i % 3] = 1;
            u[SIX * k + i] = i < 3 ? U[i] : half * n[i - 3];
        }
    }
    cr_assert(ves_shell_stiffness(&body, &shell->input->material, count, column, &scratch, K) == VES_OK);
    for (int i = 0; i < count; i++) {
        double f = 0;
        for (int j = 0; j < count; j++) f += (i >= j ? K[j * count + i] : K[i * count + j]) * u[j];
        energy += f * u[i] / 2;
        if (i % SIX < 3) force[e->s[i / SIX]][i % SIX] += f;
    }
    ves_arena_destroy(&arena);
    return energy;
}

/* The energy of springs, and the force that they hold with, by Gauss's rule along the edge. */
static double spring_energy(const whole *w, int edge, double held[3])
{
    const shell_case *c = &w->c;
    double node[VES_SHELL_ORDER + 1], at[VES_SHELL_ORDER + 1], weight[VES_SHELL_ORDER + 1], energy = 0;
    int p = c->order;
    ves_rule_nodes(p, node);
    ves_rule_gauss(p + 1, at, weight);
    for (int e = 0; e < c->elements[1]; e++)
        for (int q = 0; q <= p; q++) {
            double N[VES_SHELL_ORDER + 1], slope[VES_SHELL_ORDER + 1], t[3] = {0}, u[3] = {0};
            ves_rule_lagrange(p + 1, node, at[q], N, slope);
            for (int k = 0; k <= p; k++) {
                int s = ves_shell_edge_node(&c->sheet, edge, e * p + k);
                for (int i = 0; i < 3; i++) {
                    t[i] += slope[k] * c->X[i][s];
                    u[i] += N[k] * case_moved(c, s, i == 0, i == 1, i == 2);
                }
            }
            double share = weight[q] * sqrt(ves_dot(t, t)) * SPRING;
            energy += share * ves_dot(u, u) / 2;
            for (int i = 0; i < 3; i++) held[i] -= share * u[i];
        }
    return energy;
}

/* All loads, areas by their own quadrature, and [1] those of them that act on the nodes of the clamped edge
 * u0. */
static void loads_sum(whole *w, double sum[2][3])
{
    ves_shell *shell = w->c.shell;
    int p = w->c.order;
    double node[VES_SHELL_ORDER + 1], at[VES_SHELL_ORDER + 1], weight[VES_SHELL_ORDER + 1];
    for (int c = 0; c < 3; c++) sum[0][c] = POINT[c], sum[1][c] = 0;
    for (int k = 0; k < shell->elements; k++) {
        ves_shell_body body = ves_shell_gather(shell, &shell->element[k]);
        const ves_shell_points *rule = &body.kind->rule;
        for (int q = 0; q < rule->points; q++) {
            ves_shell_frame f;
            double n[3];
            ves_shell_frame_at(&body, &rule->table, q, &f);
            ves_cross(f.Xr, f.Xs, n);
            double area = sqrt(ves_dot(n, n)), share = 0;
            for (int i = 0; i < body.kind->nodes; i++)
                if (shell->element[k].s[i] % w->c.rows == 0) share += rule->table.N[q * body.kind->nodes + i];
            for (int c = 0; c < 3; c++) {
                double force = rule->weight[q] * (area * AREA[c] + PRESSURE * n[c]);
                sum[0][c] += force, sum[1][c] += share * force;
            }
        }
    }
    ves_rule_nodes(p, node);
    ves_rule_gauss(p + 1, at, weight);
    for (int e = 0; e < w->c.elements[0]; e++)
        for (int q = 0; q <= p; q++) {
            double N[VES_SHELL_ORDER + 1], slope[VES_SHELL_ORDER + 1], t[3] = {0};
            ves_rule_lagrange(p + 1, node, at[q], N, slope);
            for (int k = 0; k <= p; k++)
                for (int c = 0; c < 3; c++) t[c] += slope[k] * w->c.X[c][e * p + k];
            for (int c = 0; c < 3; c++) {
                double force = weight[q] * sqrt(ves_dot(t, t)) * LINE[c];
                sum[0][c] += force;
                if (e == 0) sum[1][c] += N[0] * force;
            }
        }
}

/* Half of the work of the loads is the energy of elements and springs, and what clamp and springs hold is
 * what loads push: both from elements, without the shell's matrix. */
Test(whole, work_and_equilibrium)
{
    for (int o = 0; o < ORDER_COUNT; o++) {
        whole *w = whole_make();
        whole_solve(w, ORDERS[o], false);
        ves_shell *shell = w->c.shell;
        double(*force)[3] = calloc((size_t)(w->c.rows * w->c.columns), sizeof *force);
        double held[3] = {0}, load[2][3], size = 0;
        double energy = spring_energy(w, 1, held), work = ves_shell_work(shell, 0) / 2;
        for (int k = 0; k < shell->elements; k++) energy += element_energy(shell, &shell->element[k], force);
        cr_assert(fabs(energy - work) < 1e-10 * work, "order %d: %.15g, %.15g", ORDERS[o], energy, work);
        loads_sum(w, load);
        for (int j = 0; j < w->c.columns; j++)
            for (int c = 0; c < 3; c++) held[c] += force[j * w->c.rows][c];
        for (int c = 0; c < 3; c++) held[c] -= load[1][c], size = fmax(size, fabs(load[0][c]));
        for (int c = 0; c < 3; c++)
            cr_assert(fabs(load[0][c] + held[c]) < 1e-10 * size, "order %d: %.12g and %.12g", ORDERS[o],
                      load[0][c], held[c]);
        free(force);
        whole_end(w);
    }
}

/* Springs at a node are along x, y, z, whatever the frame that the node is held in: u' k u of them is the same. */
Test(whole, springs_at_a_node)
{
    double U[3][3], director[3];
    for (int k = 0; k < 3; k++) {
        whole *w = whole_make();
        w->sprung = k > 0, w->askew = k > 1;
        whole_solve(w, 6, false);
        ves_shell_displacement(w->c.shell, 0, 0, w->c.rows * w->c.columns - 1, U[k], director);
        whole_end(w);
    }
    for (int c = 0; c < 3; c++) {
        cr_assert(fabs(U[1][c] - U[2][c]) < 1e-9 * fabs(U[1][c]), "%.12g, in another frame %.12g", U[1][c],
                  U[2][c]);
        cr_assert(fabs(U[1][c]) < 0.99 * fabs(U[0][c]), "%g, without springs %g", U[1][c], U[0][c]);
    }
}

/* The whole model turned: all stresses in the frames of the elements are the same. */
Test(whole, objectivity)
{
    static const double AXIS[3] = {2. / 7, -3. / 7, 6. / 7}, ANGLE = 1.234;
    for (int o = 0; o < ORDER_COUNT; o++) {
        whole *w = whole_make(), *t = whole_make();
        for (int i = 0; i < 3; i++) {
            double e[3] = {i == 0, i == 1, i == 2}, across[3];
            ves_cross(AXIS, e, across);
            for (int r = 0; r < 3; r++) /* [Rodrigues] */
                t->turn[r][i] =
                    cos(ANGLE) * e[r] + sin(ANGLE) * across[r] + (1 - cos(ANGLE)) * AXIS[i] * AXIS[r];
        }
        whole_solve(w, ORDERS[o], false);
        whole_solve(t, ORDERS[o], false);
        const ves_shell_stresses *a = ves_shell_stress(w->c.shell, 0), *b = ves_shell_stress(t->c.shell, 0);
        double most = 0, worst = 0;
        for (int k = 0; k < a->points; k++)
            for (int z = 0; z < VES_SHELL_LEVELS; z++)
                for (int i = 0; i < VES_STRESSES; i++) {
                    most = fmax(most, fabs(a->stress[k][z][i]));
                    worst = fmax(worst, fabs(a->stress[k][z][i] - b->stress[k][z][i]));
                }
        cr_assert(worst < 1e-10 * most, "order %d: %g of %g", ORDERS[o], worst, most);
        whole_end(w), whole_end(t);
    }
}

/* u and v, and with them the side that is up, change places: nothing moves otherwise. */
Test(whole, swapped)
{
    for (int o = 0; o < ORDER_COUNT; o++) {
        whole *w = whole_make(), *t = whole_make();
        whole_solve(w, ORDERS[o], false);
        whole_solve(t, ORDERS[o], true);
        double most = 0, worst = 0;
        for (int j = 0; j < w->c.columns; j++)
            for (int i = 0; i < w->c.rows; i++)
                for (int c = 0; c < 3; c++) {
                    double a = case_moved(&w->c, j * w->c.rows + i, c == 0, c == 1, c == 2),
                           b = case_moved(&t->c, i * t->c.rows + j, c == 0, c == 1, c == 2);
                    most = fmax(most, fabs(a)), worst = fmax(worst, fabs(a - b));
                }
        /* normals are differences here, good to 1e-11 */
        cr_assert(worst < 1e-9 * most, "order %d: %g of %g", ORDERS[o], worst, most);
        whole_end(w), whole_end(t);
    }
}

/* A hinge lets a folded shell turn, however much its fold has against drilling; so thick that this would be
 * felt. */
static void corner_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = u, X[1] = v, X[2] = 0;
}

Test(whole, hinge)
{
    for (double t = 0.1; t > 5e-4; t /= 10)
        for (int held = 0; held < 2; held++) {
            shell_case c = {.surface = corner_surface,
                            .u = {0, 1},
                            .v = {0, 1},
                            .order = 2,
                            .elements = {2, 2},
                            .thickness = t,
                            .material = {1e7, 0.3, 5. / 6}};
            case_mesh(&c);
            case_hold(&c, 0, HELD_X | HELD_Y | HELD_Z | (held ? HELD_RY : 0));
            for (int k = 0; k < ves_shell_edge_count(&c.sheet, 1); k++)
                c.node[ves_shell_edge_node(&c.sheet, 1, k)].fold = true;
            case_push(&c, c.rows - 1, 0, 0, 1);
            cr_assert(case_solve(&c) == (held ? VES_OK : VES_LOOSE), "t %g held %d", t, held);
            case_end(&c);
        }
}
