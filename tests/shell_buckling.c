/* Buckling: classical loads, work of second order of rigid rotations, classes of symmetry against the whole. */
#include <criterion/criterion.h>
#include <stdio.h>

#include "shell/buckling.h"
#include "shell_case.h"
#include "shell_rotation.h"

static const ves_shell_material STEEL = {1e9, 0.3, 5. / 6};

static void flat_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = u, X[1] = v, X[2] = 0;
}

/* number[0]: the radius; u along the axis y. The normal is outward. */
static void tube_surface(const shell_case *c, double u, double v, double X[3])
{
    double R = c->number[0];
    X[0] = R * cos(v), X[1] = u, X[2] = R * sin(v);
}

static ves_shell_buckled buckle(shell_case *c)
{
    ves_shell_buckled found;
    c->model.buckling = true;
    cr_assert(case_solve(c) == VES_OK);
    ves_status status = ves_shell_buckling(c->shell, 0, &found);
    cr_assert(status == VES_OK, "status %d", status);
    return found;
}

/* A square plate, simply supported, compressed along x: k = 4, N = 4 pi^2 D / b^2. */
Test(buckling, plate)
{
    for (int order = 1; order < 7; order += order == 2 ? 4 : 1) {
        int n = order == 1 ? 24 : order == 2 ? 8 : 2;
        shell_case c = {.surface = flat_surface,
                        .u = {0, 1},
                        .v = {0, 1},
                        .order = order,
                        .elements = {n, n},
                        .thickness = 0.01,
                        .material = STEEL};
        case_mesh(&c);
        for (int edge = 0; edge < 4; edge++) case_hold(&c, edge, HELD_Z);
        case_hold(&c, 0, HELD_RX);
        case_hold(&c, 1, HELD_RX);
        case_hold(&c, 2, HELD_RY);
        case_hold(&c, 3, HELD_RY);
        case_hold(&c, 0, HELD_X);
        c.node[0].held |= HELD_Y;
        c.load.line[1][0] = case_constant(&c, -1);
        c.load.line[1][1] = c.load.line[1][2] = case_constant(&c, 0);
        ves_shell_buckled found = buckle(&c);
        double D = 1e9 * 1e-6 / 12 / (1 - 0.09), exact = 4 * VES_PI * VES_PI * D;
        /* 1 - 5.6e-4 with the shear of [Reissner], and the square of the thickness; MITC4: coarse */
        cr_assert(fabs(found.factor / exact - 1) < (order == 1 ? 2e-3 : 8e-4), "plate %d: %.6f", order,
                  found.factor / exact);
        case_end(&c);
    }
}

/* A long strip as a column, clamped and free: pi^2 EI / (4 L^2), nu = 0. */
Test(buckling, column)
{
    for (int order = 1; order < 7; order += order == 2 ? 4 : 1) {
        int n = order == 1 ? 40 : order == 2 ? 10 : 2;
        shell_case c = {.surface = flat_surface,
                        .u = {0, 10},
                        .v = {0, 1},
                        .order = order,
                        .elements = {n, 1},
                        .thickness = 0.1,
                        .material = {1e7, 0, 5. / 6}};
        case_mesh(&c);
        case_hold(&c, 0, HELD_ALL);
        c.load.line[1][0] = case_constant(&c, -1);
        c.load.line[1][1] = c.load.line[1][2] = case_constant(&c, 0);
        ves_shell_buckled found = buckle(&c);
        double exact = VES_PI * VES_PI * 1e7 * 1e-3 / 12 / 400;
        cr_assert(fabs(found.factor / exact - 1) < 2e-4, "column %d: %.6f", order, found.factor / exact);
        case_end(&c);
    }
}

/* --- one cylinder in four ways: whole, a sector that comes again, a strip, a quarter between mirrors --- */

typedef enum cut { WHOLE, SECTOR, RING, QUARTER } cut;

typedef struct tube {
    cut cut;
    int order, rows, columns, copies; /* elements; along v of the whole */
    double length, thickness, radius;
    double axial, pressure; /* loads: compression at the end, pressure from inside */
    bool clamped;
} tube;

typedef struct tube_more {
    bool far[CASE_NODES];
    int weld[CASE_NODES];
    unsigned held[3][CASE_NODES];
    const bool *fars[1];
    const int *welds[1];
    const unsigned *helds[3];
} tube_more;

static void sector_make(shell_case *c, tube_more *m, int copies)
{
    double angle = VES_TWO_PI / copies, co = cos(angle), si = sin(angle);
    int last = (c->columns - 1) * c->rows;
    const double turn[3][3] = {{co, 0, -si}, {0, 1, 0}, {si, 0, co}};
    for (int s = 0; s < last + c->rows; s++) m->far[s] = s >= last, m->weld[s] = s >= last ? s - last : s;
    m->fars[0] = m->far, m->welds[0] = m->weld;
    c->model.far = m->fars, c->model.weld = m->welds, c->model.nodes = last;
    memcpy(c->model.turn, turn, sizeof turn);
}

static void quarter_make(shell_case *c, tube_more *m)
{
    static const unsigned OTHER[2] = {HELD_X | HELD_Y | HELD_RZ, HELD_Y | HELD_Z | HELD_RX},
                          SAME[2] = {MIRROR_Z, MIRROR_X};
    for (int k = 0; k < 3; k++) {
        for (int s = 0; s < c->model.nodes; s++) m->held[k][s] = c->node[s].held;
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < c->rows; i++)
                m->held[k][ves_shell_edge_node(&c->sheet, 2 + side, i)] |=
                    (k + 1) >> side & 1 ? OTHER[side] : SAME[side];
        m->helds[k] = m->held[k];
    }
    case_hold(c, 2, MIRROR_Z);
    case_hold(c, 3, MIRROR_X);
    c->model.classes = 3, c->model.held = m->helds;
}

static void tube_make(const tube *t, shell_case *c, tube_more *m)
{
    int copies = t->cut == WHOLE ? 1 : t->cut == QUARTER ? 4 : t->copies;
    *c = (shell_case){.surface = tube_surface,
                      .number = &t->radius,
                      .u = {0, t->length},
                      .v = {0, VES_TWO_PI / copies},
                      .order = t->order,
                      .elements = {t->rows, t->cut == RING ? 1 : t->columns / copies},
                      .closed = t->cut == WHOLE,
                      .thickness = t->thickness,
                      .material = STEEL};
    case_mesh_with(c, t->cut == RING);
    if (t->length > 0 && t->clamped) {
        case_hold(c, 0, HELD_ALL);
        case_hold(c, 1, HELD_X | HELD_Z | HELD_RX | HELD_RY | HELD_RZ);
    } else {
        case_hold(c, 0, HELD_X | HELD_Y | HELD_Z);
        case_hold(c, 1, HELD_X | HELD_Z);
    }
    if (t->cut == SECTOR || t->cut == RING) sector_make(c, m, copies);
    if (t->cut == QUARTER) quarter_make(c, m);
    if (t->axial != 0) {
        c->load.line[1][1] = case_constant(c, -t->axial);
        c->load.line[1][0] = c->load.line[1][2] = case_constant(c, 0);
    }
    if (t->pressure != 0) c->load.pressure = case_constant(c, t->pressure);
}

static ves_shell_buckled tube_buckle(const tube *t)
{
    static tube_more more;
    shell_case c;
    tube_make(t, &c, &more);
    ves_shell_buckled found = buckle(&c);
    case_end(&c);
    return found;
}

/* Compressed along its axis, classical simple supports: N = E t^2 / (R sqrt(3 (1 - nu^2))); many modes are close. The
 * ways agree as far as eigenvalues are sought, 1e-4; a ring has waves as they are, a mesh around interpolates them. */
Test(buckling, cylinder)
{
    const double exact = 1e9 * 1e-4 / sqrt(3 * 0.91);
    for (int order = 2; order < 7; order += 4) {
        double whole = 0;
        for (int k = 0; k < 4; k++) {
            const tube t = {.order = order,
                            .rows = order == 2 ? 16 : 4,
                            .columns = order == 2 ? 48 : 16,
                            .copies = k == RING ? 6000 : 8,
                            .length = 1.5,
                            .thickness = 0.01,
                            .radius = 1,
                            .axial = 1,
                            .cut = (cut)k};
            double got = tube_buckle(&t).factor;
            if (k == WHOLE) whole = got;
            cr_assert(fabs(got / exact - 1) < 0.03, "order %d cut %d: %.6f", order, k, got / exact);
            cr_assert(fabs(got / whole - 1) < (k == RING ? 5e-3 : 1e-4), "order %d cut %d: %.9g, whole %.9g",
                      order, k, got, whole);
        }
    }
}

/* Pressed from outside: the same number in four ways; order 6 on a fine mesh has the waves of a ring to 1e-5. From inside:
 * none. The tolerance of an eigenvalue that stands alone is the square of that of its residual. */
Test(buckling, pressed)
{
    double whole = 0;
    for (int k = 0; k < 4; k++) {
        tube t = {.order = 6,
                  .rows = 3,
                  .columns = 24,
                  .copies = k == RING ? 6000 : 8,
                  .length = 2,
                  .thickness = 0.01,
                  .radius = 1,
                  .pressure = -1,
                  .cut = (cut)k};
        ves_shell_buckled found = tube_buckle(&t);
        static const int CLASS[4][2] = {{0, 0}, {0, 1}, {0, 7}, {1, 0}}; /* seven waves */
        if (k == WHOLE) whole = found.factor;
        cr_assert(fabs(found.factor / whole - 1) < (k == RING ? 1e-5 : 1e-7), "cut %d: %.9g, whole %.9g", k,
                  found.factor, whole);
        cr_assert(found.symmetry == CLASS[k][0] && found.wave == CLASS[k][1], "cut %d: class %d %d", k,
                  found.symmetry, found.wave);
        if (k == RING) continue;
        t.pressure = 1, t.columns = 8;
        cr_assert(isinf(tube_buckle(&t).factor), "cut %d", k);
    }
}

/* The least over all classes is that of the class that has it, each solved by itself; the rest are only asked whether they are above.
 * Both by the same Lanczos: to rounding. */
Test(buckling, classes)
{
    for (int k = SECTOR; k <= QUARTER; k += QUARTER - SECTOR) {
        static tube_more more;
        const tube t = {.order = 6,
                        .rows = 3,
                        .columns = 8,
                        .copies = 8,
                        .length = 1.5,
                        .thickness = 0.02,
                        .radius = 1,
                        .axial = 1,
                        .cut = (cut)k};
        shell_case c;
        tube_make(&t, &c, &more);
        ves_shell_buckled all = buckle(&c), least = {.factor = HUGE_VAL}, one;
        int classes = 0;
        for (int symmetry = 0; symmetry <= c.model.classes; symmetry++)
            for (int wave = 0; wave < ves_shell_waves(c.shell); wave++, classes++) {
                cr_assert(ves_shell_buckling_class(c.shell, 0, symmetry, wave, &one) == VES_OK);
                if (one.factor < least.factor) least = one;
            }
        cr_assert(classes == all.classes, "cut %d: %d classes", k, all.classes);
        cr_assert(fabs(all.factor / least.factor - 1) < 1e-8, "cut %d: %.12g, %.12g", k, all.factor,
                  least.factor);
        case_end(&c);
    }
}

/* Long: like a ring of the stiffness of a plate, p = E t^3 / (4 (1 - nu^2) R^3) with two waves; ends add some per mille. */
Test(buckling, long_tube)
{
    const double exact = 1e9 * 1e-6 / 4 / 0.91;
    for (int k = 0; k < 4; k++) {
        const tube t = {.order = 6,
                        .rows = 6,
                        .columns = 8,
                        .copies = k == RING ? 6000 : 4,
                        .length = 120,
                        .thickness = 0.01,
                        .radius = 1,
                        .pressure = -1,
                        .cut = (cut)k};
        ves_shell_buckled found = tube_buckle(&t);
        cr_assert(fabs(found.factor / exact - 1) < 5e-3, "cut %d: %.6f", k, found.factor / exact);
        cr_assert(found.wave == (k == SECTOR || k == RING ? 2 : 0), "cut %d: wave %d", k, found.wave);
    }
}

/* The mode of a sector, continued as its wave says, is that of the whole: two waves, as large all along each. */
Test(buckling, mode)
{
    static tube_more more;
    const tube t = {.order = 6,
                    .rows = 2,
                    .columns = 8,
                    .copies = 8,
                    .length = 60,
                    .thickness = 0.01,
                    .radius = 1,
                    .pressure = -1,
                    .cut = SECTOR};
    shell_case c;
    double most = 0;
    tube_make(&t, &c, &more);
    cr_assert(buckle(&c).wave == 2);
    for (int s = 0; s < c.rows * c.columns; s++) {
        double U[2][3], middle[2][3], v = c.at_v[s / c.rows], length = 0;
        ves_shell_mode(c.shell, 0, s, U);
        ves_shell_mode(c.shell, 0, s % c.rows, middle);
        /* radial displacement turned back by two waves */
        for (int part = 0; part < 2; part++) {
            double w = U[part][0] * cos(v) + U[part][2] * sin(v), sign = part ? -1 : 1,
                   other = U[!part][0] * cos(v) + U[!part][2] * sin(v),
                   plus = cos(2 * v) * w + sign * sin(2 * v) * other,
                   minus = cos(2 * v) * w - sign * sin(2 * v) * other;
            double gap = fmin(fabs(plus - middle[part][0]), fabs(minus - middle[part][0]));
            cr_assert(gap < 3e-3, "s %d: %g", s, gap); /* residual 1e-4, over gaps between eigenvalues */
            length += U[part][0] * U[part][0] + U[part][1] * U[part][1] + U[part][2] * U[part][2];
        }
        most = fmax(most, length);
    }
    cr_assert(fabs(most - 1) < 1e-12, "%.15g", most);
    case_end(&c);
}

/* --- work of second order of a rigid rotation, which strains nothing: that of the loads, and of pressure none, as it
 * turns along --- */

/* A bowl-like piece without any symmetry. */
static void piece_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = u + 0.1 * v * v, X[1] = 1.3 * v - 0.2 * u * v, X[2] = 0.4 * u * u - 0.3 * u * v + 0.2 * sin(2 * v);
}

Test(buckling, rigid_rotation)
{
    static const double THETA[3] = {0.31, -0.87, 0.55}, R = 1.7;
    for (int order = 1; order < 7; order++)
        for (int pressed = 0; pressed < 2; pressed++) {
            shell_case c = {.surface = pressed ? tube_surface : piece_surface,
                            .number = &R,
                            .u = {0, 1},
                            .v = {0, pressed ? VES_TWO_PI : 1},
                            .order = order,
                            .elements = {3, pressed ? 5 : 2},
                            .closed = pressed,
                            .thickness = 0.05,
                            .material = STEEL};
            double work = 0;
            case_mesh(&c);
            /* supports that carry nothing, as the loads are balanced */
            for (int k = 0; k < 3; k++)
                c.node[2 * k + (k == 2 ? c.rows : 0)].spring[k] = c.node[c.rows * 2 - k].spring[(k + 1) % 3] =
                    1e4;
            if (pressed) c.load.pressure = case_constant(&c, 1e3);
            for (int k = 0; k < 2 && !pressed; k++) {
                int s[2] = {k ? c.rows - 1 : 0, c.rows * (c.columns - 1) + (k ? 1 : c.rows - 1)};
                double F[3], turned[3], twice[3];
                for (int i = 0; i < 3; i++) F[i] = (c.X[i][s[1]] - c.X[i][s[0]]) * (k ? -700 : 900);
                for (int end = 0; end < 2; end++) {
                    double X[3] = {c.X[0][s[end]], c.X[1][s[end]], c.X[2][s[end]]}, sign = end ? 1 : -1;
                    case_push(&c, s[end], sign * F[0], sign * F[1], sign * F[2]);
                    ves_cross(THETA, X, turned);
                    ves_cross(THETA, turned, twice);
                    work -= sign * ves_dot(F, twice);
                }
            }
            cr_assert(case_solve(&c) == VES_OK);
            double got = rotation_work(c.shell, THETA);
            /* of the loads' size: rounding; tied strains do their work not quite where the stresses do (coarse mesh) */
            double size = pressed ? 1e3 * VES_TWO_PI * R * R : work, gap = fabs(got - work) / size;
            cr_assert(gap < (order == 1   ? 0.2
                             : order == 2 ? 0.02
                                          : 1e-9),
                      "order %d pressed %d: %g", order, pressed, gap);
            case_end(&c);
        }
}
