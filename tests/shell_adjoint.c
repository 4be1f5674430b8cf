/* Gradients of shells against differences of fourth order: J reads all that can be read, and all that can vary does. */
#include <criterion/criterion.h>
#include <stdio.h>

#include "shell/adjoint.h"
#include "shell/buckling.h"
#include "shell/inside.h"
#include "shell_case.h"
#include "shell_rotation.h"

enum { PLANES = 64, SHEETS = 2, SPRUNG = 5 };

/* A plane that varies: at + step * along. */
typedef struct plane {
    double *at, *base, *along, *gradient;
    int count;
} plane;

typedef struct trial {
    ves_arena arena;
    shell_case part[SHEETS];
    ves_shell_model model;
    ves_shell_input input;
    ves_shell_sheet sheet[SHEETS];
    ves_shell_load load[SHEETS];
    ves_shell_load_gradient on_load[SHEETS];
    ves_shell_node *node;
    int *weld[SHEETS], sizes[SHEETS];
    bool *far[SHEETS];
    const int *welds[SHEETS];
    const bool *fars[SHEETS];
    const double *X[SHEETS][3], *normal[SHEETS][3], *thickness[SHEETS];
    double *on_X[SHEETS][3], *on_normal[SHEETS][3], *on_thickness[SHEETS], side[SHEETS], on_force[4][3];
    const double *seed_U[SHEETS][3], *seed_director[SHEETS][3];
    ves_shell_seed seed;
    double (*seed_stress)[VES_SHELL_LEVELS][VES_STRESSES];
    double (*seed_mean)[VES_SHELL_EDGES][3];
    double along_force[3], along_E, along_nu, along_shear, on_spring[1][3], (*on_springs)[3];
    ves_shell_point point;
    ves_shell_spring spring;
    plane plane[PLANES];
    int planes, drawn;
    ves_shell *shell;
} trial;

/* Some number, always the same one. */
static double draw(trial *t)
{
    t->drawn++;
    return sin(12.9898 * t->drawn) + 0.5 * cos(78.233 * t->drawn);
}

/* A plane of `count` numbers becomes one that varies by smooth amounts of `size`. */
static double *vary(trial *t, double *at, int count, double size)
{
    plane *p = &t->plane[t->planes++];
    *p = (plane){.at = at,
                 .count = count,
                 .base = ves_arena_doubles(&t->arena, (size_t)count),
                 .along = ves_arena_doubles(&t->arena, (size_t)count),
                 .gradient = ves_arena_take(&t->arena, (size_t)count, sizeof(double))};
    double a = draw(t), b = draw(t);
    memcpy(p->base, at, sizeof *at * (size_t)count);
    for (int k = 0; k < count; k++) p->along[k] = size * sin(a + 0.37 * k + b * k * k / count);
    return p->gradient;
}

static double *filled(trial *t, int count, double mean, double size)
{
    double *at = ves_arena_doubles(&t->arena, (size_t)count), a = draw(t);
    for (int k = 0; k < count; k++) at[k] = mean + size * sin(a + 0.7 * k);
    return at;
}

static void loads_make(trial *t, int sheet)
{
    ves_shell_load *load = &t->load[sheet];
    ves_shell_load_gradient *on = &t->on_load[sheet];
    int count = t->sizes[sheet];
    double *p = filled(t, count, 300, 100);
    load->pressure = p, on->pressure = vary(t, p, count, 100);
    for (int c = 0; c < 3; c++) {
        p = filled(t, count, 0, 200), load->area[c] = p, on->area[c] = vary(t, p, count, 50);
        for (int edge = 1; edge < 4; edge += 2) {
            int n = ves_shell_edge_count(&t->sheet[sheet], edge);
            p = filled(t, n, 50, 40), load->line[edge][c] = p, on->line[edge][c] = vary(t, p, n, 20);
        }
    }
}

/* Every second sheet has its normals the other way round. */
static void sheet_make(trial *t, int sheet)
{
    shell_case *c = &t->part[sheet];
    int count = t->sizes[sheet];
    t->side[sheet] = sheet ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        for (int s = 0; s < count; s++) c->normal[i][s] *= t->side[sheet];
        t->X[sheet][i] = c->X[i], t->normal[sheet][i] = c->normal[i];
        t->on_X[sheet][i] = vary(t, c->X[i], count, 0.05);
        t->on_normal[sheet][i] = vary(t, c->normal[i], count, 0.05);
    }
    double *wall = filled(t, count, c->thickness, 0.2 * c->thickness);
    t->thickness[sheet] = wall, t->on_thickness[sheet] = vary(t, wall, count, 0.1 * c->thickness);
}

/* Weights of what J reads: all of it about as large. */
static void seeds_make(trial *t)
{
    const ves_shell_stresses *s = ves_shell_stress(t->shell, 0);
    double top = 0, moved = 0;
    for (int q = 0; q < s->points; q++)
        for (int l = 0; l < VES_SHELL_LEVELS; l++)
            for (int k = 0; k < VES_STRESSES; k++) top = fmax(top, fabs(s->stress[q][l][k]));
    for (int sheet = 0; sheet < t->model.sheets; sheet++)
        for (int k = 0; k < t->sizes[sheet]; k++) {
            double U[3], d[3];
            ves_shell_displacement(t->shell, 0, sheet, k, U, d);
            moved = fmax(moved, sqrt(ves_dot(U, U)));
        }
    t->seed_stress = ves_arena_take(&t->arena, (size_t)s->points, sizeof *t->seed_stress);
    for (int q = 0; q < s->points; q++)
        for (int l = 0; l < VES_SHELL_LEVELS; l++)
            for (int k = 0; k < VES_STRESSES; k++) t->seed_stress[q][l][k] = draw(t) / top / sqrt(s->points);
    for (int sheet = 0; sheet < t->model.sheets; sheet++)
        for (int c = 0; c < 3; c++) {
            t->seed_U[sheet][c] = filled(t, t->sizes[sheet], 0, 1 / moved / sqrt(t->sizes[sheet]));
            t->seed_director[sheet][c] = filled(t, t->sizes[sheet], 0, 0.1 / moved / sqrt(t->sizes[sheet]));
        }
    t->seed = (ves_shell_seed){.U = t->seed_U,
                               .director = t->seed_director,
                               .stress = (const double(*)[VES_SHELL_LEVELS][VES_STRESSES])t->seed_stress,
                               .work = 1 / ves_shell_work(t->shell, 0)};
    t->seed_mean = ves_arena_take(&t->arena, SHEETS, sizeof *t->seed_mean);
    for (int c = 0; c < 3; c++)
        t->seed_mean[0][2][c] = draw(t) / moved, t->seed_mean[t->model.sheets - 1][1][c] = draw(t) / moved;
    t->seed.mean = (const double(*)[VES_SHELL_EDGES][3])t->seed_mean;
    for (int c = 0; c < 3; c++) t->seed.X[c] = filled(t, s->points, 0, 0.01);
    t->seed.thickness = filled(t, s->points, 0, 0.1), t->seed.area = filled(t, s->points, 0, 0.1);
}

static double J(trial *t)
{
    double sum = 0;
    cr_assert(ves_shell_solve(t->shell, &t->input) == VES_OK);
    const ves_shell_stresses *s = ves_shell_stress(t->shell, 0);
    for (int q = 0; q < s->points; q++) {
        for (int l = 0; l < VES_SHELL_LEVELS; l++)
            for (int k = 0; k < VES_STRESSES; k++) sum += t->seed_stress[q][l][k] * s->stress[q][l][k];
        for (int c = 0; c < 3; c++) sum += t->seed.X[c][q] * s->X[c][q];
        sum += t->seed.thickness[q] * s->thickness[q] + t->seed.area[q] * s->area[q];
    }
    for (int sheet = 0; sheet < t->model.sheets; sheet++)
        for (int k = 0; k < t->sizes[sheet]; k++) {
            double U[3], d[3];
            ves_shell_displacement(t->shell, 0, sheet, k, U, d);
            for (int c = 0; c < 3; c++)
                sum += t->seed_U[sheet][c][k] * U[c] + t->seed_director[sheet][c][k] * d[c];
        }
    sum += t->seed.work * ves_shell_work(t->shell, 0);
    for (int sheet = 0; sheet < t->model.sheets && t->seed.mean; sheet++)
        for (int edge = 0; edge < VES_SHELL_EDGES; edge++) {
            double U[3];
            if (t->seed.mean[sheet][edge][0] == 0) continue;
            ves_shell_edge_mean(t->shell, 0, sheet, edge, U);
            sum += ves_dot(t->seed.mean[sheet][edge], U);
        }
    if (t->seed.factor == 0) return sum;
    ves_shell_buckled found;
    cr_assert(ves_shell_buckling(t->shell, 0, &found) == VES_OK && isfinite(found.factor));
    shell_mode mode; /* its factor is good to the square of what the mode is */
    cr_assert(ves_shell_mode_take(t->shell, 0, &mode) == VES_OK);
    return sum + t->seed.factor * mode.factor;
}

static double J_at(trial *t, double step)
{
    const ves_shell_material was = t->input.material;
    const ves_shell_point point = t->point;
    const ves_shell_spring spring = t->spring;
    const ves_shell_node node = t->node[SPRUNG];
    for (int k = 0; k < t->planes; k++)
        for (int i = 0; i < t->plane[k].count; i++)
            t->plane[k].at[i] = t->plane[k].base[i] + step * t->plane[k].along[i];
    t->input.material.E += step * t->along_E, t->input.material.nu += step * t->along_nu;
    t->input.material.shear += step * t->along_shear;
    for (int c = 0; c < 3; c++) {
        t->point.force[c] += step * t->along_force[c];
        t->spring.stiffness[c] *= 1 + step * (c + 1) / 8;
        t->node[SPRUNG].spring[c] *= 1 - step * (c + 1) / 8;
    }
    double value = J(t);
    t->input.material = was, t->point = point, t->spring = spring, t->node[SPRUNG] = node;
    return value;
}

static double difference(trial *t, double h)
{
    return (8 * (J_at(t, h) - J_at(t, -h)) - (J_at(t, 2 * h) - J_at(t, -2 * h))) / (12 * h);
}

static double gradient(trial *t)
{
    ves_shell_gradient g = {.X = t->on_X,
                            .normal = t->on_normal,
                            .thickness = t->on_thickness,
                            .load = t->on_load,
                            .force = t->on_force,
                            .spring = t->on_spring,
                            .node_spring = t->on_springs};
    double sum = 0;
    J_at(t, 0);
    cr_assert(ves_shell_adjoint(t->shell, 0, &t->seed, &g) == VES_OK);
    for (int k = 0; k < t->planes; k++)
        for (int i = 0; i < t->plane[k].count; i++) sum += t->plane[k].gradient[i] * t->plane[k].along[i];
    for (int c = 0; c < 3; c++)
        sum += (c + 1) / 8. *
               (t->on_spring[0][c] * t->spring.stiffness[c] -
                t->on_springs[SPRUNG][c] * t->node[SPRUNG].spring[c]);
    return sum + g.E * t->along_E + g.nu * t->along_nu + g.shear * t->along_shear +
           ves_dot(t->on_force[0], t->along_force);
}

/* Differences come to the gradient with h^4, down to rounding: eigenvalues, about 1 here, are good to 1e-9 or so, over a step
 * of 1e-2. */
static void compare(trial *t, const char *what, double step, double small)
{
    double exact = gradient(t), error[3];
    for (int k = 0; k < 3; k++) error[k] = fabs(difference(t, step / (1 << k)) / exact - 1);
    double order = log2(error[0] / error[1]);
    cr_log_info("%s: %.12g, differences off by %.2g %.2g %.2g, order %.2f", what, exact, error[0], error[1],
                error[2], order);
    cr_assert(error[2] < small, "%s: %g", what, error[2]);
    cr_assert(order > 3.5 || (t->seed.factor != 0 && error[0] * fmin(1, fabs(exact)) < 1e-6),
              "%s: order %.2f", what, order);
}

static void piece_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = u + 0.1 * v * v, X[1] = 1.3 * v - 0.2 * u * v, X[2] = 0.4 * u * u - 0.3 * u * v + 0.2 * sin(2 * v);
}

/* Goes on from its edge u = 1 at an angle. */
static void folded_surface(const shell_case *c, double u, double v, double X[3])
{
    piece_surface(c, 1, v, X);
    X[0] += 0.1 * u, X[1] += 0.1 * u * v, X[2] += -0.6 * u + 0.1 * u * u;
}

/* A third of a tube, waved three times. */
static void tube_surface(const shell_case *c, double u, double v, double X[3])
{
    double r = 1 + 0.1 * cos(3 * v) + 0.2 * u * u;
    (void)c;
    X[0] = r * cos(v), X[1] = 1.5 * u, X[2] = r * sin(v);
}

typedef enum outline { ONE, FOLDED, SECTOR } outline;

static void sector_make(trial *t)
{
    static const double CO = -0.5, SI = 0.86602540378443864676;
    const double turn[3][3] = {{CO, 0, -SI}, {0, 1, 0}, {SI, 0, CO}};
    const shell_case *c = &t->part[0];
    int last = (c->columns - 1) * c->rows;
    t->far[0] = ves_arena_take(&t->arena, (size_t)t->sizes[0], sizeof *t->far[0]), t->fars[0] = t->far[0];
    for (int s = last; s < t->sizes[0]; s++) t->far[0][s] = true, t->weld[0][s] = s - last;
    t->model.nodes = last, t->model.far = t->fars;
    memcpy(t->model.turn, turn, sizeof turn);
}

static void trial_make(trial *t, outline form, int order)
{
    static case_surface *const SURFACE[][SHEETS] = {
        {piece_surface}, {piece_surface, folded_surface}, {tube_surface}};
    int sheets = form == FOLDED ? 2 : 1;
    *t = (trial){.planes = 0};
    t->model = (ves_shell_model){
        .sheets = sheets, .sheet = t->sheet, .weld = t->welds, .cases = 1, .gradients = true};
    t->node = ves_arena_take(&t->arena, CASE_NODES, sizeof *t->node);
    t->model.node = t->node;
    for (int k = 0; k < sheets; k++) {
        shell_case *c = &t->part[k];
        *c = (shell_case){.surface = SURFACE[form][k],
                          .u = {0, 1},
                          .v = {0, form == SECTOR ? VES_TWO_PI / 3 : 1},
                          .order = order,
                          .elements = {order > 2 ? 1 : 3, order > 2 ? 1 : 2},
                          .thickness = 0.05};
        case_mesh(c);
        t->sheet[k] = c->sheet, t->sizes[k] = c->rows * c->columns;
        t->weld[k] = ves_arena_take(&t->arena, (size_t)t->sizes[k], sizeof *t->weld[k]),
        t->welds[k] = t->weld[k];
        for (int s = 0; s < t->sizes[k]; s++) {
            bool seam = k && s % c->rows == 0;
            t->weld[k][s] =
                seam ? t->weld[0][s / c->rows * t->part[0].rows + t->part[0].rows - 1] : t->model.nodes++;
            t->node[t->weld[k][s]].fold = seam;
        }
        if (form == SECTOR) sector_make(t);
        sheet_make(t, k);
        loads_make(t, k);
    }
    for (int s = 0; s < t->model.nodes; s++)
        for (int i = 0; i < 3; i++) t->node[s].frame[i][i] = 1;
    t->point = (ves_shell_point){.node = t->model.nodes - 2, .force = {3, -2, 4}};
    t->spring = (ves_shell_spring){.sheet = 0, .edge = 3, .stiffness = {1e5, 2e5, 3e5}};
    t->along_force[0] = 1, t->along_force[2] = -2, t->along_E = 1e8, t->along_nu = 0.05;
    t->along_shear = 0.3;
    for (int c = 0; c < 3; c++) t->node[SPRUNG].spring[c] = 1e4 * (c + 1);
    t->on_springs = ves_arena_take(&t->arena, CASE_NODES, sizeof *t->on_springs);
    t->model.springs = 1, t->model.spring = &t->spring;
    t->input = (ves_shell_input){.material = {1e9, 0.3, 5. / 6},
                                 .X = t->X,
                                 .normal = t->normal,
                                 .thickness = t->thickness,
                                 .side = t->side,
                                 .load = t->load,
                                 .points = 1,
                                 .point = &t->point};
}

static void trial_start(trial *t)
{
    cr_assert(ves_shell_create(&t->model, &t->input, &t->arena, &t->shell) == VES_OK);
    cr_assert(ves_shell_solve(t->shell, &t->input) == VES_OK);
    seeds_make(t);
}

static void trial_end(trial *t)
{
    ves_shell_destroy(t->shell);
    for (int k = 0; k < t->model.sheets; k++) ves_arena_destroy(&t->part[k].arena);
    ves_arena_destroy(&t->arena);
}

/* Held along one edge, and nodes that may turn about one direction of their tangent plane alone, about axes that are skew. */
static void hold(trial *t, bool skew)
{
    const shell_case *c = &t->part[0];
    for (int k = 0; k < c->columns; k++) t->node[k * c->rows].held |= HELD_ALL;
    for (int k = 1; k < c->rows - 1 && skew; k++) {
        ves_shell_node *node = &t->node[k];
        static const double FRAME[3][3] = {{0.6, 0.8, 0}, {-0.48, 0.36, 0.8}, {0.64, -0.48, 0.6}};
        memcpy(node->frame, FRAME, sizeof FRAME);
        node->held |= k % 2 ? HELD_RX : HELD_Y | HELD_RZ;
    }
}

Test(adjoint, differences)
{
    static const char *const NAME[] = {"one sheet", "fold", "sector"};
    for (int order = 2; order < 7; order += 2)
        for (int form = 0; form < 3; form++)
            for (int skew = 0; skew < 2; skew++) {
                static trial t;
                char what[60];
                trial_make(&t, (outline)form, order);
                hold(&t, skew);
                trial_start(&t);
                snprintf(what, sizeof what, "%s, order %d%s", NAME[form], order, skew ? ", partly held" : "");
                compare(&t, what, 0.02, 1e-6);
                trial_end(&t);
            }
}

/* Another class of modes, which are held less than the loads are, and about other axes. */
static void class_make(trial *t)
{
    static unsigned held[CASE_NODES];
    static const unsigned *const list[] = {held};
    const shell_case *c = &t->part[0];
    for (int k = 0; k < t->model.nodes; k++)
        held[k] = k % c->rows == 0 && k / c->rows < c->columns / 2 ? HELD_X | HELD_Y | HELD_Z
                  : k % 3                                          ? 0
                                                                   : HELD_RY;
    t->model.classes = 1, t->model.held = list;
}

/* The factor of buckling, alone and with all else. Here the loads press; eigenvalues are good to 1e-10 or so. */
Test(adjoint, buckling)
{
    static const char *const NAME[] = {"one sheet", "fold", "sector"};
    for (int order = 2; order < 7; order += 2)
        for (int form = 0; form < 3; form++)
            for (int alone = 0; alone < 2; alone++) {
                static trial t;
                char what[60];
                ves_shell_buckled found;
                trial_make(&t, (outline)form, order);
                hold(&t, alone);
                t.model.buckling = true;
                if (form == ONE && alone) class_make(&t);
                trial_start(&t);
                cr_assert(ves_shell_buckling(t.shell, 0, &found) == VES_OK);
                cr_assert(found.symmetry == t.model.classes);
                if (alone)
                    memset(t.seed_stress, 0,
                           sizeof *t.seed_stress * (size_t)ves_shell_stress(t.shell, 0)->points);
                for (int k = 0; k < form % 2 + 1 && alone; k++)
                    for (int c = 0; c < 3; c++)
                        t.seed_U[k][c] = t.seed_director[k][c] = filled(&t, t.sizes[k], 0, 0);
                t.seed.factor = 1 / found.factor;
                snprintf(what, sizeof what, "%s, order %d, factor %g wave %d%s", NAME[form], order,
                         found.factor, found.wave, alone ? ", alone, partly held" : "");
                compare(&t, what, 0.01, 1e-5);
                trial_end(&t);
            }
}

/* A fold turns as a whole: the stresses do on a rigid rotation what the loads do, here two forces that pull it together. */
Test(adjoint, fold_rotates)
{
    static const double THETA[3] = {0.31, -0.87, 0.55};
    static trial t;
    ves_shell_point point[2] = {{.node = 0}};
    double work = 0;
    trial_make(&t, FOLDED, 6);
    memset(t.load, 0, sizeof t.load);
    const int last = t.sizes[1] - 1;
    point[1].node = t.weld[1][last];
    for (int c = 0; c < 3; c++) {
        point[0].force[c] = 100 * (t.X[1][c][last] - t.X[0][c][0]), point[1].force[c] = -point[0].force[c];
        /* six springs, which carry nothing */
        t.node[3].spring[c] = 1e6, t.node[20].spring[c] = c < 2 ? 1e6 : 0,
        t.node[35].spring[c] = c > 1 ? 1e6 : 0;
    }
    for (int end = 0; end < 2; end++) {
        double X[3], turned[3], twice[3];
        for (int c = 0; c < 3; c++) X[c] = end ? t.X[1][c][last] : t.X[0][c][0];
        ves_cross(THETA, X, turned);
        ves_cross(THETA, turned, twice);
        work -= ves_dot(point[end].force, twice);
    }
    memset(t.node[SPRUNG].spring, 0, sizeof t.node[SPRUNG].spring);
    t.input.points = 2, t.input.point = point, t.model.springs = 0;
    trial_start(&t);
    double got = rotation_work(t.shell, THETA);
    /* rounding, over the 1e-8 by which folds are stiffened */
    cr_assert(fabs(got / work - 1) < 1e-6, "%.15g, loads %.15g", got, work);
    trial_end(&t);
}

/* What is not asked for is not needed, and what is read of one thing alone is its part of the sum. */
Test(adjoint, parts)
{
    static trial t;
    trial_make(&t, ONE, 2);
    hold(&t, false);
    trial_start(&t);
    const ves_shell_seed all = t.seed;
    ves_shell_seed part[3] = {{.U = all.U, .mean = all.mean, .thickness = all.thickness},
                              {.director = all.director, .work = all.work, .area = all.area},
                              {.stress = all.stress, .X = {all.X[0], all.X[1], all.X[2]}}};
    double sum[2] = {0}, sums[2] = {0};
    for (int k = 0; k < 4; k++) {
        ves_shell_gradient g = {.thickness = NULL};
        cr_assert(ves_shell_adjoint(t.shell, 0, k < 3 ? &part[k] : &all, &g) == VES_OK);
        (k < 3 ? sums : sum)[0] += g.E, (k < 3 ? sums : sum)[1] += g.nu;
    }
    for (int k = 0; k < 2; k++)
        cr_assert(fabs(sums[k] / sum[k] - 1) < 1e-9, "%d: %.15g, of parts %.15g", k, sum[k], sums[k]);
    trial_end(&t);
}

Test(adjoint, absent_of_order_1)
{
    static trial t;
    ves_shell_gradient g = {.thickness = NULL};
    trial_make(&t, ONE, 1);
    hold(&t, false);
    trial_start(&t);
    cr_assert(ves_shell_adjoint(t.shell, 0, &t.seed, &g) == VES_ABSENT);
    trial_end(&t);
}
