/* Moves of curves against moving points one by one, and their gradients. */
#include "curve_shelf.h"

static const double pi = 3.14159265358979323846;

enum { PLACES = 60 };

static double place(int j)
{
    return 2 * pi * (j + 0.123) / PLACES;
}

/* Curve 0: something without symmetry; curve 1: like it, ready for moves. Mean point far from the origin. */
static void begin(shelf *s, bool varying)
{
    static const double mean[3] = {1.1, -0.6, 0.4}, cosine[9] = {2, 0.3, -0.1, 0.2, 0.1, 0.4, 0.05, -0.1, 0};
    static const double sine[6] = {0.1, 1.5, 0.6, -0.3, 0.2, 0.1};
    shelf_open(s);
    shelf_curve(s, "fourier");
    shelf_give(s, "mean", 3, mean, varying);
    shelf_give(s, "cos", 9, cosine, varying);
    shelf_give(s, "sin", 6, sine, varying);
    shelf_curve(s, "like");
    shelf_read(s, 0);
}

static void expect_near(const double *got, const double *want, double tolerance, const char *what, double v)
{
    for (int c = 0; c < 3; c++)
        cr_assert(fabs(got[c] - want[c]) <= tolerance, "%s at v = %g, [%d]: got %.17g, want %.17g", what, v,
                  c, got[c], want[c]);
}

/* Few operations on numbers below 5. */
static const double rounding = 4e-15;

Test(curve_moves, translate_and_dilate_move_every_point)
{
    static const double by[3] = {0.3, -0.7, 1.9}, scale[3] = {1.5, -0.4, 0.8}, mean[3] = {1.1, -0.6, 0.4};
    for (int about = 0; about < 2; about++) {
        shelf s;
        begin(&s, false);
        shelf_step(&s, "dilate", true);
        shelf_give(&s, "by", 3, scale, false);
        shelf_choose(&s, "about", about);
        shelf_step(&s, "translate", true);
        shelf_give(&s, "by", 3, by, false);
        shelf_ready(&s);
        for (int j = 0; j < PLACES; j++) {
            double in[9], out[9], want[3];
            shelf_point(&s, 0, place(j), in);
            shelf_point(&s, 1, place(j), out);
            for (int c = 0; c < 3; c++) {
                double fixed = about ? mean[c] : 0;
                want[c] = fixed + scale[c] * (in[c] - fixed) + by[c];
            }
            expect_near(out, want, rounding, "dilate", place(j));
        }
        shelf_close(&s);
    }
}

/* One rotation about a fixed axis, counterclockwise seen from its tip. */
static void turn(int axis, double angle, double p[3])
{
    int a = (axis + 1) % 3, b = (axis + 2) % 3;
    double x = p[a], y = p[b];
    p[a] = x * cos(angle) - y * sin(angle);
    p[b] = x * sin(angle) + y * cos(angle);
}

Test(curve_moves, rotate_turns_every_point_about_x_then_y_then_z)
{
    static const double angle[3] = {0.4, -1.1, 2.3}, mean[3] = {1.1, -0.6, 0.4};
    for (int about = 0; about < 2; about++) {
        shelf s;
        begin(&s, false);
        shelf_step(&s, "rotate", true);
        shelf_give(&s, "by", 3, angle, false);
        shelf_choose(&s, "about", about);
        shelf_ready(&s);
        for (int j = 0; j < PLACES; j++) {
            double in[9], out[9], want[3];
            shelf_point(&s, 0, place(j), in);
            shelf_point(&s, 1, place(j), out);
            for (int c = 0; c < 3; c++) want[c] = in[c] - (about ? mean[c] : 0);
            for (int axis = 0; axis < 3; axis++) turn(axis, angle[axis], want);
            for (int c = 0; c < 3; c++) want[c] += about ? mean[c] : 0;
            expect_near(out, want, rounding, "rotate", place(j));
        }
        shelf_close(&s);
    }
}

Test(curve_moves, shift_runs_ahead_by_its_angle)
{
    shelf s;
    begin(&s, false);
    shelf_step(&s, "shift", true);
    shelf_give(&s, "by", 1, (double[]){0.83}, false);
    shelf_ready(&s);
    for (int j = 0; j < PLACES; j++) {
        double in[9], out[9];
        shelf_point(&s, 0, place(j) + 0.83, in);
        shelf_point(&s, 1, place(j), out);
        for (int d = 0; d < 3; d++)
            expect_near(out + 3 * d, in + 3 * d, (1 + 8 * d) * rounding, "shift", place(j));
    }
    shelf_close(&s);
}

/* Cubic B-spline on integer knots, B(0) = 2/3. */
static double cubic(double t)
{
    double a = fabs(t);
    return a < 1 ? 2.0 / 3 - a * a + a * a * a / 2 : a < 2 ? (2 - a) * (2 - a) * (2 - a) / 6 : 0;
}

/* b(v) of `points` coefficients +1, -1, ... by its definition. */
static double ridges(int points, double v)
{
    double sum = 0, t = v * points / (2 * pi);
    for (int j = -points; j < 2 * points; j++) sum += (j % 2 ? -1 : 1) * cubic(t - j);
    return sum;
}

/* The sum of 2 (2 / (pi m))^4 over the odd m that are left out, from `first` on; over all odd m it is b(0) =
 * 1/3. */
static double ridge_tail(int first)
{
    double sum = 1.0 / 3;
    for (int m = 1; m < first; m += 2) sum -= 2 * pow(2 / (pi * m), 4);
    return sum;
}

Test(curve_moves, ridges_on_a_dilated_circle_are_those_of_the_container)
{
    static const double dx = 0.45, dz = 0.37, ct = 0.2, length = 0.1, down = -0.04;
    shelf s;
    shelf_open(&s);
    shelf_curve(&s, "circle");
    shelf_give(&s, "radius", 1, &length, false);
    shelf_give(&s, "axis", 3, (double[]){0, 1, 0}, false);
    shelf_step(&s, "dilate", true);
    shelf_give(&s, "by", 3, (double[]){dx, 1, dz}, false);
    shelf_step(&s, "ridge", true);
    shelf_choose(&s, "points", 24);
    shelf_give(&s, "by", 1, (double[]){ct * length}, false);
    shelf_step(&s, "translate", true);
    shelf_give(&s, "by", 3, (double[]){0, down, 0}, false);
    shelf_ready(&s);
    cr_assert(ves_curves_modes(s.curves, 0) ==
              109); /* 108 is the last odd multiple of 12 below 128, times cos v */
    double tail = ct * length * ridge_tail(11);
    for (int j = 0; j < 24 * PLACES; j++) {
        double v = 2 * pi * j / (24 * PLACES), b = ridges(24, v), out[9];
        double want[3] = {(dx + ct * b) * cos(v) * length, down, (dz + ct * b) * sin(v) * length};
        shelf_point(&s, 0, v, out);
        expect_near(out, want, tail + rounding, "ridge", v);
        if (j % PLACES == 0) cr_assert(fabs(fabs(b) - 1.0 / 3) < rounding); /* at the knots */
    }
    shelf_close(&s);
}

Test(curve_moves, ridges_are_what_moving_alternate_control_points_gives)
{
    /* Control points on a circle, and the same moved by +-0.2 along z: the difference is a ridge along the
     * axis. */
    double point[2][36];
    for (int j = 0; j < 12; j++)
        for (int k = 0; k < 2; k++) {
            point[k][3 * j] = 1.3 * cos(2 * pi * j / 12), point[k][3 * j + 1] = 1.3 * sin(2 * pi * j / 12);
            point[k][3 * j + 2] = k ? (j % 2 ? -0.2 : 0.2) : 0;
        }
    shelf s;
    shelf_open(&s);
    for (int k = 0; k < 2; k++) {
        shelf_curve(&s, "bspline");
        shelf_give(&s, "points", 36, point[k], false);
    }
    shelf_curve(&s, "like");
    shelf_read(&s, 0);
    shelf_step(&s, "ridge", true);
    shelf_choose(&s, "points", 12);
    shelf_give(&s, "by", 1, (double[]){0.2}, false);
    shelf_choose(&s, "along", 1);
    shelf_ready(&s);
    for (int j = 0; j < PLACES; j++) {
        double want[9], out[9];
        shelf_point(&s, 1, place(j), want);
        shelf_point(&s, 2, place(j), out);
        expect_near(out, want, 1e-10, "ridge along the axis", place(j)); /* where constant splines are cut */
    }
    shelf_close(&s);
}

Test(curve_moves, two_and_four_control_points_make_ridges_too)
{
    for (int points = 2; points <= 4; points += 2) {
        shelf s;
        shelf_open(&s);
        shelf_curve(&s, "circle");
        shelf_give(&s, "radius", 1, (double[]){1.3}, false);
        shelf_step(&s, "ridge", true);
        shelf_choose(&s, "points", points);
        shelf_give(&s, "by", 1, (double[]){0.2}, false);
        shelf_ready(&s);
        for (int j = 0; j < PLACES; j++) {
            double v = place(j), r = 1.3 + 0.2 * ridges(points, v), want[3] = {r * cos(v), r * sin(v), 0},
                   out[9];
            shelf_point(&s, 0, v, out);
            expect_near(out, want, 0.2 * ridge_tail(127 / (points / 2)) + rounding, "coarse ridge", v);
        }
        shelf_close(&s);
    }
}

/* b(v) = 3/2 B((v - c) / h), whole turns away included. */
static double bump(double from, double to, double v)
{
    double h = (to - from) / 4, c = (from + to) / 2, sum = 0;
    for (int turn_number = -2; turn_number <= 2; turn_number++)
        sum += 1.5 * cubic((v - c + 2 * pi * turn_number) / h);
    return sum;
}

/* Sum over n > limit of 3 h / pi / 2 sinc^4(n h / 2) <= sum 3 h / (2 pi) (2 / (n h))^4. */
static double bump_tail(double from, double to, int limit)
{
    double h = (to - from) / 4;
    return 3 * h / (2 * pi) * pow(2 / h, 4) / (3 * pow(limit, 3));
}

Test(curve_moves, a_bump_has_its_shape_its_peak_and_nothing_outside)
{
    static const double range[5][2] = {
        {0.2, 2.9}, {5.5, 7.8}, {-1, 0.9}, {3, 3 + 2 * 3.14159265358979323846}, {1, 4.6}};
    static const double by[3] = {0.5, -0.3, 0.8};
    for (int k = 0; k < 5; k++) {
        double from = range[k][0], to = range[k][1], out[9], in[9], want[3], tail = bump_tail(from, to, 512);
        shelf s;
        begin(&s, false);
        s.limit = 512;
        shelf_step(&s, "bump", true);
        shelf_give(&s, "from", 1, &from, false);
        shelf_give(&s, "to", 1, (double[]){k == 1 ? to - 2 * pi : to}, false); /* 5.5 to 1.52: through 2 pi */
        shelf_give(&s, "by", 3, by, false);
        shelf_ready(&s);
        for (int j = 0; j <= 4 * PLACES; j++) {
            double v = j == 4 * PLACES ? (from + to) / 2 : place(j) / 4 + pi / 2 * (j % 4);
            double b = j == 4 * PLACES ? 1 : bump(from, to, v);
            shelf_point(&s, 0, v, in);
            shelf_point(&s, 1, v, out);
            for (int c = 0; c < 3; c++) want[c] = in[c] + by[c] * b;
            expect_near(out, want, tail + 10 * rounding, "bump", v);
        }
        shelf_close(&s);
    }
}

Test(curve_moves, a_bump_joins_with_two_continuous_derivatives)
{
    double jump[2];
    static const double from = 0.7, to = 2.9;
    for (int k = 0; k < 2; k++) {
        double in[9], out[9];
        shelf s;
        begin(&s, false);
        s.limit = k ? 1024 : 256;
        shelf_step(&s, "bump", true);
        shelf_give(&s, "from", 1, &from, false);
        shelf_give(&s, "to", 1, &to, false);
        shelf_give(&s, "by", 3, (double[]){1, 0, 0}, false);
        shelf_ready(&s);
        shelf_point(&s, 0, from, in);
        shelf_point(&s, 1, from, out);
        jump[k] = fabs(out[6] - in[6]);
        shelf_close(&s);
    }
    /* The second derivative is continuous and 0 there, with kinks: the cut series misses it by c / M. */
    cr_assert(jump[1] < 0.02 && fabs(log(jump[0] / jump[1]) / log(4) - 1) < 0.1, "off by %g, then %g",
              jump[0], jump[1]);
}

Test(curve_moves, moves_are_affine_in_the_curve)
{
    /* Move(p + q) = Move(p) + Move(q) - Move(0), for moves that do not take directions from the curve. */
    static const char *const name[5] = {"translate", "dilate", "rotate", "shift", "bump"};
    for (int k = 0; k < 5; k++) {
        shelf s;
        begin(&s, false);
        shelf_curve(&s, "circle");
        shelf_give(&s, "radius", 1, (double[]){1.9}, false);
        for (int t = 0; t < 4; t++) { /* 3: p + q, 4: p, 5: q, 6: 0 */
            shelf_curve(&s, "combine");
            shelf_give(&s, "terms", 2, (double[]){t == 0 || t == 1, t == 0 || t == 2}, false);
            shelf_read(&s, 0);
            shelf_read(&s, 2);
            shelf_step(&s, name[k], true);
            if (k == 4) {
                shelf_give(&s, "from", 1, (double[]){1}, false);
                shelf_give(&s, "to", 1, (double[]){3}, false);
            }
            shelf_give(&s, "by", k == 3 ? 1 : 3, (double[]){0.4, -0.3, 0.9}, false);
        }
        shelf_ready(&s);
        int size = 3 * ves_curve_stride(ves_curves_modes(s.curves, 3));
        for (int i = 0; i < size; i++) {
            double both = ves_curves_coef(s.curves, 3)[i], p = ves_curves_coef(s.curves, 4)[i];
            double q = ves_curves_coef(s.curves, 5)[i], none = ves_curves_coef(s.curves, 6)[i];
            cr_assert(fabs(both - (p + q - none)) < rounding, "%s is not affine", name[k]);
        }
        shelf_close(&s);
    }
}

/* A chain with every move in it; `varying` says which of its numbers and whether its input vary. */
static void chain(shelf *s, bool input_varies, bool numbers_vary, int along)
{
    begin(s, input_varies);
    shelf_step(s, "dilate", true);
    shelf_give(s, "by", 3, (double[]){1.2, 0.7, 0.9}, numbers_vary);
    shelf_choose(s, "about", along);
    shelf_step(s, "rotate", true);
    shelf_give(s, "by", 3, (double[]){0.3, -0.6, 1.4}, numbers_vary);
    shelf_choose(s, "about", 1 - along);
    shelf_step(s, "ridge", true);
    shelf_choose(s, "points", along ? 10 : 2);
    shelf_give(s, "by", 1, (double[]){0.17}, numbers_vary);
    shelf_choose(s, "along", along);
    shelf_step(s, "shift", true);
    shelf_give(s, "by", 1, (double[]){0.55}, numbers_vary);
    shelf_step(s, "translate", true);
    shelf_give(s, "by", 3, (double[]){0.3, -0.6, 1.4}, numbers_vary);
    shelf_curve(s, "like");
    shelf_read(s, 1);
    shelf_step(s, "bump", true);
    shelf_give(s, "from", 1, (double[]){5.1}, numbers_vary);
    shelf_give(s, "to", 1, (double[]){1.2}, numbers_vary);
    shelf_give(s, "by", 3, (double[]){0.3, 0.2, -0.4}, numbers_vary);
    shelf_step(s, "dilate", true);
    shelf_give(s, "by", 3, (double[]){1.1, 1.2, 1.3}, numbers_vary);
    shelf_curve(s, "combine");
    shelf_give(s, "terms", 3, (double[]){0.5, -1, 2}, numbers_vary);
    shelf_read(s, 0);
    shelf_read(s, 2);
    shelf_read(s, 1);
    s->limit = 40;
    shelf_ready(s);
}

Test(curve_moves, gradients_of_chains_agree_with_differences)
{
    for (int k = 0; k < 6; k++) {
        shelf s;
        chain(&s, k % 3 != 1, k % 3 != 0, k / 3);
        shelf_check_gradient(&s, k / 3 ? "chain, ridges along the axis" : "chain, radial ridges");
        cr_assert(ves_curves_varies(s.curves, 0) == (k % 3 != 1));
        shelf_close(&s);
    }
}

Test(curve_moves, each_move_alone_has_its_gradient)
{
    static const char *const name[6] = {"translate", "dilate", "rotate", "shift", "bump", "ridge"};
    for (int k = 0; k < 12; k++) {
        shelf s;
        begin(&s, true);
        s.limit = 30;
        shelf_step(&s, name[k % 6], true);
        if (k % 6 == 4) {
            shelf_give(&s, "from", 1, (double[]){0.4}, true);
            shelf_give(&s, "to", 1, (double[]){2.2}, true);
        }
        if (k % 6 == 5) shelf_choose(&s, "points", 8);
        shelf_give(&s, "by", k % 6 == 3 || k % 6 == 5 ? 1 : 3, (double[]){0.4, -0.3, 0.9}, true);
        if (k % 6 == 1 || k % 6 == 2) shelf_choose(&s, "about", k / 6);
        if (k % 6 == 5) shelf_choose(&s, "along", k / 6);
        shelf_ready(&s);
        shelf_check_gradient(&s, name[k % 6]);
        shelf_close(&s);
    }
}

Test(curve_moves, a_radial_ridge_follows_first_modes_of_any_length)
{
    /* Scaling the curve scales nothing of the ridge: only directions are taken from it. */
    double ridge[2][9];
    for (int k = 0; k < 2; k++) {
        shelf s;
        begin(&s, false);
        shelf_step(&s, "dilate", true);
        shelf_give(&s, "by", 3, k ? (double[]){3, 3, 3} : (double[]){1, 1, 1}, false);
        shelf_curve(&s, "like");
        shelf_read(&s, 1);
        shelf_step(&s, "ridge", true);
        shelf_choose(&s, "points", 6);
        shelf_give(&s, "by", 1, (double[]){0.3}, false);
        shelf_ready(&s);
        double before[9], after[9];
        shelf_point(&s, 1, 0.77, before);
        shelf_point(&s, 2, 0.77, after);
        for (int c = 0; c < 9; c++) ridge[k][c] = after[c] - before[c];
        shelf_close(&s);
    }
    expect_near(ridge[1], ridge[0], 10 * rounding, "ridge", 0.77);
}

static int broken(shelf *s, int points)
{
    shelf_curve(s, "circle");
    shelf_give(s, "radius", 1, (double[]){1.1}, false);
    shelf_step(s, "ridge", true);
    shelf_choose(s, "points", points);
    return shelf_give(s, "by", 1, (double[]){0.1}, true);
}

Test(curve_moves, ridges_that_cannot_be_made_are_refused)
{
    shelf s;
    shelf_open(&s);
    broken(&s, 7);
    shelf_refused(&s, VES_RANGE, "must be even, found 7");
    shelf_open(&s);
    s.limit = 12;
    broken(&s, 24);
    shelf_refused(&s, VES_RANGE, "24 points need 13 modes, but a curve may have at most 12");
    shelf_open(&s);
    shelf_curve(&s, "point");
    shelf_give(&s, "at", 3, (double[]){1, 2, 3}, false);
    shelf_step(&s, "ridge", true);
    shelf_choose(&s, "points", 8);
    shelf_give(&s, "by", 1, (double[]){0.1}, true);
    shelf_refused(&s, VES_RANGE, "a ridge needs a curve that goes round");
}
