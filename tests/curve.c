/* Curves: each source against direct evaluation, analysis, constants and gradients through the whole chain.
 */
#include "curve_shelf.h"

static const double pi = 3.14159265358979323846;

static double far(const double *a, const double *b)
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Points that look random but are the same each time. */
static void scatter_points(int count, double *point)
{
    ves_random random = {.seed = 11};
    for (int i = 0; i < 3 * count; i++) point[i] = 4 * ves_random_uniform(&random) - 2;
}

/* A wavy ring of points, uneven in angle. */
static void ring_points(int count, double *point)
{
    for (int j = 0; j < count; j++) {
        double v = 2 * pi * j / count + 0.2 * sin(2 * pi * j / count), r = 1.7 + 0.3 * cos(3 * v);
        point[3 * j] = r * cos(v), point[3 * j + 1] = 0.4 * sin(2 * v), point[3 * j + 2] = 0.8 * r * sin(v);
    }
}

Test(curve, the_registry_holds_every_operation_once_and_finds_it)
{
    const char *move[] = {"bump", "dilate", "ridge", "rotate", "shift", "translate"};
    const char *source[] = {"bspline", "circle", "combine", "ellipse", "formula",
                            "fourier", "like",   "point",   "points"};
    int moves = 0, sources = 0;
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++) {
        int *k = (*op)->move ? &moves : &sources;
        cr_assert_str_eq((*op)->name, ((*op)->move ? move : source)[*k]);
        cr_assert(ves_curve_op_find((*op)->name, (*op)->move) == *op);
        cr_assert(!ves_curve_op_find((*op)->name, !(*op)->move));
        cr_assert((*op)->about && (*op)->keys && (*op)->eval && (*op)->gradient && (*op)->modes);
        (*k)++;
    }
    cr_assert(moves == 6 && sources == 9);
}

/* Rounding of a few operations on numbers of size 3: 4 units in the last place. */
static const double rounding = 2e-15;

Test(curve, circles_about_the_coordinate_axes_start_where_the_documents_say)
{
    static const double axis[4][3] = {{1, 0, 0}, {0, 2.5, 0}, {0, 0, 1}, {0, -1, 0}},
                        centre[3] = {0.3, -1.1, 0.7};
    static const int first[4] = {1, 0, 0, 0}, second[4] = {2, 2, 1, 2};
    for (int a = 0; a < 4; a++) {
        shelf s;
        shelf_open(&s);
        shelf_curve(&s, "circle");
        shelf_give(&s, "radius", 1, (double[]){2.385}, false);
        shelf_give(&s, "axis", 3, axis[a], false);
        shelf_give(&s, "centre", 3, centre, false);
        shelf_ready(&s);
        cr_assert(ves_curves_modes(s.curves, 0) == 1);
        for (int j = 0; j < 100; j++) {
            double v = 0.0711 * j, out[9], want[9];
            for (int c = 0; c < 9; c++) want[c] = c < 3 ? centre[c] : 0;
            double x[3] = {cos(v), -sin(v), -cos(v)}, y[3] = {sin(v), cos(v), -sin(v)};
            for (int d = 0; d < 3; d++) {
                want[3 * d + first[a]] += 2.385 * x[d];
                want[3 * d + second[a]] += 2.385 * y[d];
            }
            shelf_point(&s, 0, v, out);
            for (int c = 0; c < 9; c++)
                cr_assert(fabs(out[c] - want[c]) <= rounding, "axis %d, v %g, [%d]: got %.17g, want %.17g", a,
                          v, c, out[c], want[c]);
        }
        shelf_close(&s);
    }
}

Test(curve, a_tilted_circle_stays_round_flat_and_close_to_the_nearest_coordinate_frame)
{
    ves_random random = {.seed = 3};
    for (int k = 0; k < 200; k++) {
        double n[3], mean[3], out[9], start[9];
        for (int c = 0; c < 3; c++) n[c] = ves_random_normal(&random);
        shelf s;
        shelf_open(&s);
        shelf_curve(&s, "circle");
        shelf_give(&s, "radius", 1, (double[]){1.3}, false);
        shelf_give(&s, "axis", 3, n, false);
        shelf_ready(&s);
        for (int c = 0; c < 3; c++) mean[c] = 0;
        for (int j = 0; j < 12; j++) {
            shelf_point(&s, 0, 2 * pi * j / 12, out);
            if (!j) memcpy(start, out, sizeof start);
            cr_assert(fabs(far(out, mean) - 1.3) < rounding && fabs(dot(out, n)) < 4 * rounding);
            cr_assert(fabs(dot(out, out + 3)) <
                      2 * rounding); /* uniform: the tangent is square to the radius */
        }
        /* The smallest turn moves e0 by no more than the axis moves: at most 54.7 degrees. */
        int m = fabs(n[0]) > fabs(n[1]) && fabs(n[0]) > fabs(n[2]);
        cr_assert(start[m] >= 1.3 * cos(54.8 * pi / 180), "e0 has turned too far: %g", start[m]);
        shelf_close(&s);
    }
}

Test(curve, ellipse_point_and_fourier_are_what_their_formulas_say)
{
    static const double mean[3] = {0.1, 0.2, 0.3}, cosine[6] = {1, 2, 3, 0.4, 0.5, 0.6},
                        sine[3] = {-1, 0.7, 0.2};
    shelf s;
    shelf_open(&s);
    shelf_curve(&s, "ellipse");
    shelf_give(&s, "radii", 2, (double[]){2.1, 0.9}, false);
    shelf_curve(&s, "point");
    shelf_give(&s, "at", 3, mean, false);
    shelf_curve(&s, "fourier");
    shelf_give(&s, "mean", 3, mean, false);
    shelf_give(&s, "cos", 6, cosine, false);
    shelf_give(&s, "sin", 3, sine, false);
    shelf_ready(&s);
    cr_assert(ves_curves_modes(s.curves, 1) == 0 && ves_curves_modes(s.curves, 2) == 2);
    for (int j = 0; j < 50; j++) {
        double v = 0.13 * j, out[9], ellipse[3] = {2.1 * cos(v), 0.9 * sin(v), 0};
        shelf_point(&s, 0, v, out);
        cr_assert(far(out, ellipse) < rounding);
        shelf_point(&s, 1, v, out);
        cr_assert(far(out, mean) == 0);
        shelf_point(&s, 2, v, out);
        for (int c = 0; c < 3; c++) {
            double want = mean[c] + cosine[c] * cos(v) + sine[c] * sin(v) + cosine[3 + c] * cos(2 * v);
            cr_assert(fabs(out[c] - want) < 2 * rounding, "fourier: got %.17g, want %.17g", out[c], want);
        }
    }
    shelf_close(&s);
}

/* Cubic B-spline on integer knots -2 .. 2 by the recursion [Ugail 2011, eqs 2.4-2.5, denominators as
 * corrected]. */
static double deboor(int order, double knot, double t)
{
    if (order == 1) return knot <= t && t < knot + 1;
    return ((t - knot) * deboor(order - 1, knot, t) + (knot + order - t) * deboor(order - 1, knot + 1, t)) /
           (order - 1);
}

static void spline_point(int count, const double *point, double v, double out[3])
{
    double t = v * count / (2 * pi);
    for (int c = 0; c < 3; c++) out[c] = 0;
    for (int j = -count; j < 2 * count; j++)
        for (int c = 0; c < 3; c++) out[c] += point[3 * ((j + count) % count) + c] * deboor(4, j - 2, t);
}

static int spline(shelf *s, int count, const double *point, bool interpolate, bool varying)
{
    int c = shelf_curve(s, "bspline");
    shelf_give(s, "points", 3 * count, point, varying);
    shelf_choose(s, "interpolate", interpolate);
    return c;
}

Test(curve, bspline_is_de_boors_within_the_tail_of_its_spectrum)
{
    for (int count = 3; count <= 24; count += 7)
        for (int limit = 32; limit <= 256; limit *= 2) {
            double point[72], worst = 0;
            shelf s;
            scatter_points(count, point);
            shelf_open(&s);
            s.limit = limit;
            spline(&s, count, point, false, false);
            shelf_ready(&s);
            for (int j = 0; j < 97; j++) {
                double v = 2 * pi * j / 97, out[9], want[3];
                shelf_point(&s, 0, v, out);
                spline_point(count, point, v, want);
                worst = fmax(worst, far(out, want));
            }
            /* |mode n| <= 2 max|P| (N / (pi n))^4; the sum beyond the limit is below the integral. Rounding:
             * 1e-13. */
            double tail = 2 * 3.5 * pow(count / pi, 4) / (3 * pow(limit, 3));
            cr_assert(worst <= tail + 1e-13, "%d points, %d modes: off by %g, tail %g", count, limit, worst,
                      tail);
            shelf_close(&s);
        }
}

Test(curve, bspline_converges_as_the_third_power_of_its_modes)
{
    double point[24], worst[2] = {0, 0};
    scatter_points(8, point);
    for (int k = 0; k < 2; k++) {
        shelf s;
        shelf_open(&s);
        s.limit = k ? 320 : 80;
        spline(&s, 8, point, false, false);
        shelf_ready(&s);
        for (int j = 0; j < 8;
             j++) { /* the jumps of the third derivative are at the knots: the error is largest there */
            double out[9], want[3];
            shelf_point(&s, 0, 2 * pi * j / 8, out);
            spline_point(8, point, 2 * pi * j / 8, want);
            worst[k] = fmax(worst[k], far(out, want));
        }
        shelf_close(&s);
    }
    double order = log(worst[0] / worst[1]) / log(4);
    cr_assert(fabs(order - 3) < 0.1, "observed order %g",
              order); /* 0.1: the leading term alone is not reached at 80 */
}

Test(curve, an_interpolating_bspline_hits_its_points)
{
    for (int count = 3; count <= 30; count += 9) {
        double point[90];
        shelf s;
        scatter_points(count, point);
        shelf_open(&s);
        s.limit = 512;
        spline(&s, count, point, true, true);
        shelf_ready(&s);
        for (int j = 0; j < count; j++) {
            double out[9];
            shelf_point(&s, 0, 2 * pi * j / count, out);
            double tail = 3 * 2 * 3.5 * pow(count / pi, 4) /
                          (3 * pow(512, 3)); /* as above; solving amplifies by 3 at most */
            cr_assert(far(out, point + 3 * j) < tail + 1e-13, "point %d of %d missed by %g", j, count,
                      far(out, point + 3 * j));
        }
        shelf_close(&s);
    }
}

Test(curve, splines_of_symmetric_constant_points_keep_only_modes_that_show)
{
    double point[36];
    for (int j = 0; j < 36; j++) point[j] = j % 3 == 0 ? 1.25 : j % 3 == 1 ? 3 : -2;
    shelf s;
    shelf_open(&s);
    spline(&s, 12, point, false, false); /* all control points the same: a point, by partition of unity */
    for (int j = 0; j < 12; j++) point[3 * j] = j % 2 ? -1 : 1;
    spline(&s, 12, point, false, false);
    spline(&s, 12, point, false, true);
    shelf_ready(&s);
    double out[9], want[3] = {1.25, 3, -2};
    cr_assert(ves_curves_modes(s.curves, 0) == 0);
    shelf_point(&s, 0, 1.234, out);
    cr_assert(far(out, want) < rounding);
    cr_assert(ves_curves_modes(s.curves, 1) == 126); /* the last odd multiple of 6 below 128 */
    cr_assert(ves_curves_modes(s.curves, 2) == VES_CURVE_MODES);
    shelf_close(&s);
}

Test(curve, uniform_points_are_met_exactly)
{
    for (int count = 3; count <= 64; count = count * 2 + count % 3) {
        double point[192];
        shelf s;
        scatter_points(count, point);
        shelf_open(&s);
        shelf_curve(&s, "points");
        shelf_give(&s, "points", 3 * count, point, false);
        shelf_ready(&s);
        cr_assert(ves_curves_modes(s.curves, 0) == count / 2);
        for (int j = 0; j < count; j++) {
            double out[9];
            shelf_point(&s, 0, 2 * pi * j / count, out);
            /* 2 eps for each of count terms of size 2 */
            cr_assert(far(out, point + 3 * j) < 1e-15 * count, "point %d of %d missed by %g", j, count,
                      far(out, point + 3 * j));
        }
        shelf_close(&s);
    }
}

Test(curve, arc_length_curves_hit_their_points_at_constant_speed)
{
    double point[120];
    ring_points(40, point);
    shelf s;
    shelf_open(&s);
    shelf_curve(&s, "points");
    shelf_give(&s, "points", 120, point, false);
    shelf_choose(&s, "parametrize", 1);
    shelf_ready(&s);
    double nearest[40], out[9], low = INFINITY, high = 0;
    for (int i = 0; i < 40; i++) nearest[i] = INFINITY;
    for (int j = 0; j < 40000; j++) {
        shelf_point(&s, 0, 2 * pi * j / 40000, out);
        for (int i = 0; i < 40; i++) nearest[i] = fmin(nearest[i], far(out, point + 3 * i));
        low = fmin(low, sqrt(dot(out + 3, out + 3)));
        high = fmax(high, sqrt(dot(out + 3, out + 3)));
    }
    shelf_point(&s, 0, 0, out);
    /* the cut spectrum: 128 modes of an n^-4 decay, 1e-6; 7e-7 was seen */
    cr_assert(far(out, point) < 1e-6, "v = 0 is off the first point by %g", far(out, point));
    /* Between samples of v the curve moves 3e-4: half of that, plus the cut spectrum (128 modes of an n^-4
     * decay, 1e-6). */
    for (int i = 0; i < 40; i++) cr_assert(nearest[i] < 1.6e-4, "point %d missed by %g", i, nearest[i]);
    cr_assert(high / low - 1 < 1e-3, "speed from %.9g to %.9g", low,
              high); /* the derivative's cut spectrum: 128 * 1e-6 */
    shelf_close(&s);
}

Test(curve, arc_length_of_an_ellipse_converges_to_its_true_length)
{
    double error[2];
    for (int k = 0; k < 2; k++) {
        int count = k ? 80 : 40;
        double point[240], out[9], want = 0;
        for (int j = 0; j < count; j++) {
            double v = 2 * pi * j / count;
            point[3 * j] = 2 * cos(v), point[3 * j + 1] = sin(v), point[3 * j + 2] = 0.5;
        }
        for (int j = 0; j < 400; j++) /* trapezoid rule, exponentially accurate */
            want += hypot(2 * sin(2 * pi * j / 400), cos(2 * pi * j / 400)) / 400;
        shelf s;
        shelf_open(&s);
        shelf_curve(&s, "points");
        shelf_give(&s, "points", 3 * count, point, false);
        shelf_choose(&s, "parametrize", 1);
        shelf_ready(&s);
        double mean = 0;
        for (int j = 0; j < 4096; j++) {
            shelf_point(&s, 0, 2 * pi * j / 4096, out);
            mean += sqrt(dot(out + 3, out + 3)) / 4096;
        }
        error[k] = fabs(mean / want - 1);
        shelf_close(&s);
    }
    /* A cubic spline is of order 4: halving the distance gains 16; 8 leaves room for the constant. 1e-6: 7e-8
     * was seen on the finer one. */
    cr_assert(error[1] < 1e-6 && error[0] / error[1] > 8, "length off by %g, then %g", error[0], error[1]);
}

Test(curve, formulas_become_modes_to_rounding)
{
    static const char *const text[][3] = {{"cos(v)", "0", "sin(v)"},
                                          {"3 + 2*cos(5*v)", "cos(2*v)*sin(v)", "sin(3*v)^2"},
                                          {"exp(cos(v))", "1/(2 + sin(v))", "cos(v + sin(v))"},
                                          {"cos(16*v)", "sin(17*v)", "cos(64*v)"}};
    static const int modes[4] = {1, 6, -1, 64};
    for (int k = 0; k < 4; k++) {
        shelf s;
        shelf_open(&s);
        shelf_curve(&s, "formula");
        shelf_formula(&s, text[k]);
        shelf_ready(&s);
        if (modes[k] > 0)
            cr_assert(ves_curves_modes(s.curves, 0) == modes[k], "%s: %d modes", text[k][0],
                      ves_curves_modes(s.curves, 0));
        else
            cr_assert(ves_curves_modes(s.curves, 0) < 60);
        for (int j = 0; j < 40; j++) {
            double v = 0.157 * j, out[9], none = 0, room[64];
            shelf_point(&s, 0, v, out);
            for (int c = 0; c < 3; c++) {
                double want = ves_formula_eval(s.formula[0][c], &none, &v, room);
                /* the cut tail 1e-14, and n eps for the phase n v of mode n */
                cr_assert(fabs(out[c] - want) < 6e-14, "%s at %g: got %.17g, want %.17g", text[k][c], v,
                          out[c], want);
            }
        }
        shelf_close(&s);
    }
}

Test(curve, a_formula_with_more_modes_than_the_limit_is_cut_with_a_warning)
{
    static const char *const corner[3] = {"cos(v)", "abs(sin(v))", "0"};
    char text[300];
    shelf s;
    shelf_open(&s);
    s.limit = 20;
    shelf_curve(&s, "formula");
    shelf_formula(&s, corner);
    shelf_ready(&s);
    ves_diag_text(s.diag, 0, text, sizeof text);
    cr_assert(ves_diag_count(s.diag) == 1 && ves_diag_errors(s.diag) == 0);
    cr_assert(strstr(text, "modes, a curve here at most 20: modes as large as"), "%s", text);
    cr_assert(ves_curves_modes(s.curves, 0) == 20);
    shelf_close(&s);
}

Test(curve, a_formula_that_varies_keeps_harmonics_that_are_zero_at_the_start)
{
    static const char *const text[3] = {"cos(v) + p0*cos(7*v)", "p1^2*sin(3*v) + p2", "exp(p3*cos(v))"};
    shelf s;
    shelf_open(&s);
    s.number[3] = 1;
    for (int i = 0; i < SHELF_SLOTS; i++) s.varying[i] = true;
    shelf_curve(&s, "formula");
    shelf_formula(&s, text);
    shelf_ready(&s);
    static const double x[4] = {0.4, 0.9, -0.3, 1.7};
    memcpy(s.number, x, sizeof x);
    ves_curves_bind(s.curves, s.number);
    for (int j = 0; j < 40; j++) {
        double v = 0.157 * j, out[9];
        double want[3] = {cos(v) + 0.4 * cos(7 * v), 0.81 * sin(3 * v) - 0.3, exp(1.7 * cos(v))};
        shelf_point(&s, 0, v, out);
        cr_assert(far(out, want) < 1e-13, "v %g: off by %g", v,
                  far(out, want)); /* rounding of about 40 modes */
    }
    shelf_check_gradient(&s, "formula");
    shelf_close(&s);
}

Test(curve, analysis_follows_the_corrected_equations)
{
    double sample[192], coef[3 * 65];
    for (int j = 0; j < 64; j++) {
        double v = 2 * pi * j / 64;
        sample[j] = 3 + 2 * cos(v), sample[64 + j] = cos(32 * v),
        sample[128 + j] = 0.5 * sin(31 * v) - cos(7 * v);
    }
    ves_curve_analyse(sample, 64, 32, coef);
    for (int k = 0; k < 65; k++) {
        double want[3] = {k == 0 ? 3 : k == 1 ? 2 : 0, k == 63 ? 1 : 0, k == 62 ? 0.5 : k == 13 ? -1 : 0};
        for (int c = 0; c < 3; c++) /* rounding of a mean over 64 samples of size 5 */
            cr_assert(fabs(coef[c * 65 + k] - want[c]) < 2e-15, "[%d][%d]: got %.17g, want %g", c, k,
                      coef[c * 65 + k], want[c]);
    }
    double more[3 * 81];
    ves_curve_analyse(sample, 64, 40, more); /* modes that 64 samples cannot tell are zero */
    for (int k = 0; k < 81; k++) cr_assert(more[k] == (k < 65 ? coef[k] : 0));
}

Test(curve, constants_are_evaluated_once)
{
    shelf s;
    shelf_open(&s);
    int fixed = shelf_curve(&s, "circle");
    int radius = shelf_give(&s, "radius", 1, (double[]){2}, false);
    int moved = shelf_curve(&s, "like");
    shelf_read(&s, fixed);
    shelf_step(&s, "translate", true);
    int by = shelf_give(&s, "by", 3, (double[]){0.1, 0.2, 0.3}, true);
    int copy = shelf_curve(&s, "like");
    shelf_read(&s, moved);
    shelf_ready(&s);
    cr_assert(!ves_curves_varies(s.curves, fixed) && !ves_curves_adjoint(s.curves, fixed));
    cr_assert(ves_curves_varies(s.curves, moved) && ves_curves_adjoint(s.curves, moved));
    cr_assert(ves_curves_varies(s.curves, copy));
    s.number[radius] = 5, s.number[by] = 7;
    ves_curves_bind(s.curves, s.number);
    double out[9];
    shelf_point(&s, fixed, 0, out);
    cr_assert(out[0] == 2, "a constant circle has been evaluated again");
    shelf_point(&s, copy, 0, out);
    cr_assert(out[0] == 9, "got %g, want 9", out[0]);
    shelf_close(&s);
}

static void circle(shelf *s, double radius, const double axis[3], bool varying)
{
    shelf_curve(s, "circle");
    shelf_give(s, "radius", 1, &radius, varying);
    shelf_give(s, "axis", 3, axis, varying);
    shelf_give(s, "centre", 3, (double[]){0.4, -0.2, 0.9}, varying);
}

Test(curve, gradients_of_sources_agree_with_differences)
{
    double point[30];
    scatter_points(10, point);
    static const double axis[4][3] = {{0, 0, 1}, {0.3, 1.4, -0.5}, {-2, 0.6, 0.1}, {0.2, 0.1, -1.1}};
    shelf s;
    shelf_open(&s);
    for (int k = 0; k < 4; k++) circle(&s, 1.7, axis[k], true);
    shelf_curve(&s, "ellipse");
    shelf_give(&s, "radii", 2, (double[]){2.1, 0.9}, true);
    shelf_give(&s, "axis", 3, axis[1], true);
    shelf_give(&s, "centre", 3, (double[]){0.4, -0.2, 0.9}, true);
    shelf_curve(&s, "point");
    shelf_give(&s, "at", 3, axis[2], true);
    shelf_curve(&s, "fourier");
    shelf_give(&s, "mean", 3, axis[1], true);
    shelf_give(&s, "cos", 6, point, true);
    shelf_give(&s, "sin", 9, point, true);
    spline(&s, 10, point, false, true);
    spline(&s, 7, point, true, true);
    shelf_curve(&s, "points");
    shelf_give(&s, "points", 30, point, true);
    shelf_curve(&s, "combine");
    shelf_give(&s, "terms", 4, (double[]){1, -2, 0.7, 1.3}, true);
    shelf_read(&s, 7);
    shelf_read(&s, 0);
    shelf_read(&s, 6);
    shelf_read(&s, 0); /* the same curve twice */
    shelf_curve(&s, "like");
    shelf_read(&s, 10);
    shelf_ready(&s);
    shelf_check_gradient(&s, "sources");
    shelf_close(&s);
}

Test(curve, combine_is_the_sum_of_its_terms_at_every_point)
{
    double point[24];
    scatter_points(8, point);
    shelf s;
    shelf_open(&s);
    spline(&s, 8, point, false, true);
    circle(&s, 1.2, (double[]){0, 1, 0}, false);
    shelf_curve(&s, "combine");
    shelf_give(&s, "terms", 2, (double[]){1.5, -2}, true);
    shelf_read(&s, 0);
    shelf_read(&s, 1);
    shelf_ready(&s);
    for (int j = 0; j < 30; j++) {
        double a[9], b[9], out[9];
        shelf_point(&s, 0, 0.21 * j, a);
        shelf_point(&s, 1, 0.21 * j, b);
        shelf_point(&s, 2, 0.21 * j, out);
        for (int c = 0; c < 9; c++) /* rounding, times n^2 in the second derivative */
            cr_assert(fabs(out[c] - (1.5 * a[c] - 2 * b[c])) < 1e-12);
    }
    shelf_close(&s);
}

Test(curve, what_the_key_table_cannot_say_is_refused_once_and_in_words)
{
    static const char *const open[3] = {"v", "0", "0"}, *const pole[3] = {"1/sin(v)", "0", "0"};
    double point[18] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0, 2, 2, 2}, many[6] = {1, 2, 3, 4, 5, 6};
    shelf s;
    shelf_open(&s);
    circle(&s, 1, (double[]){0, 0, 0}, false);
    shelf_curve(&s, "like"); /* of the curve that failed: nothing more is said */
    shelf_read(&s, 0);
    shelf_refused(&s, VES_RANGE, "shelf:200:1: error: \"axis\" must not be [0, 0, 0]");
    shelf_open(&s);
    shelf_curve(&s, "ellipse");
    shelf_give(&s, "radii", 3, many, false);
    shelf_refused(&s, VES_RANGE, "two numbers, found 3");
    shelf_open(&s);
    s.limit = 1;
    shelf_curve(&s, "fourier");
    shelf_give(&s, "sin", 6, many, false);
    shelf_refused(&s, VES_RANGE, "2 modes are given, but a curve may have at most 1");
    shelf_open(&s);
    spline(&s, 2, point, false, false);
    shelf_refused(&s, VES_RANGE, "at least 3 points, found 2");
    for (int k = 0; k < 5; k++) {
        static const char *const want[5] = {"at least 3 points, found 2", "point 5 repeats point 1",
                                            "points 1 and 2 are the", "cannot be parametrized",
                                            "5 points need 2 modes"};
        shelf_open(&s);
        if (k == 4) s.limit = 1;
        shelf_curve(&s, "points");
        shelf_give(&s, "points", k ? 15 : 6,
                   k == 2 ? (double[]){1, 1, 1, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 5, 6} : point, k == 3);
        shelf_choose(&s, "parametrize", k != 4);
        shelf_refused(&s, VES_RANGE, want[k]);
    }
    shelf_open(&s);
    shelf_curve(&s, "formula");
    shelf_formula(&s, open);
    shelf_refused(&s, VES_RANGE, "the curve does not close: from v = 0 to v = 2*pi x changes by 6.28319");
    shelf_open(&s);
    shelf_curve(&s, "formula");
    shelf_formula(&s, pole);
    shelf_refused(&s, VES_RANGE, "not finite numbers");
}
