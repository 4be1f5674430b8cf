/* Circles and ellipses whose axis varies: their frame is chosen once and moves smoothly. */
#include "curve/frame.h"
#include "curve_shelf.h"

static const double pi = 3.14159265358979323846;

/* Rounding of a few operations on numbers of size 3: 4 units in the last place. */
static const double rounding = 2e-15;

static double far(const double *a, const double *b)
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

/* The axis starts along z and turns by 120 degrees, past where another coordinate axis is nearer and past
 * where it points down: a point moves by no more than twice what the axis turns (2 tan(theta / 2) / theta
 * is 1.65 at 120 degrees), and derivatives hold all along. */
Test(curve_ring, a_ring_does_not_jump_when_its_axis_varies)
{
    for (int ellipse = 0; ellipse < 2; ellipse++)
        for (int way = 0; way < 4; way++) {
            shelf s;
            shelf_open(&s);
            shelf_curve(&s, ellipse ? "ellipse" : "circle");
            shelf_give(&s, ellipse ? "radii" : "radius", 1 + ellipse, (double[]){1.3, 1.3}, false);
            int axis = shelf_give(&s, "axis", 3, (double[]){0, 0, way % 2 ? -0.7 : 0.7}, true);
            shelf_ready(&s);
            double out[9], last[9] = {0}, step = pi / 180;
            for (int k = 0; k <= 120; k++) {
                s.number[axis + way / 2] = sin(k * step);
                s.number[axis + 2] = (way % 2 ? -1 : 1) * cos(k * step);
                ves_curves_bind(s.curves, s.number);
                shelf_point(&s, 0, 0.9, out);
                cr_assert(!k || far(out, last) < 2 * 1.3 * step, "way %d, %d degrees: jumps by %g", way, k,
                          far(out, last));
                memcpy(last, out, sizeof last);
                if (k % 10 == 5) shelf_check_gradient(&s, "a turned ring");
            }
            shelf_close(&s);
        }
}

/* [tx, 1, tz]: whatever the start, the same axis gives the same circle, and none of them jumps. */
Test(curve_ring, a_ring_about_an_axis_with_a_constant_component_does_not_depend_on_the_start)
{
    static const double start[4][3] = {{0, 1, 0}, {3, 1, 0}, {-0.3, 1, 2.2}, {1.5, 1, -4}};
    double want[9] = {0}, out[9];
    for (int k = 0; k < 4; k++) {
        shelf s;
        shelf_open(&s);
        shelf_curve(&s, "circle");
        shelf_give(&s, "radius", 1, (double[]){1.3}, false);
        int axis = shelf_give(&s, "axis", 3, start[k], true);
        s.varying[axis + 1] = false;
        shelf_ready(&s);
        s.number[axis] = 0.9, s.number[axis + 2] = -1.7;
        ves_curves_bind(s.curves, s.number);
        shelf_point(&s, 0, 0.9, k ? out : want);
        cr_assert(!k || far(out, want) < rounding, "start %d: off by %g", k, far(out, want));
        shelf_check_gradient(&s, "a ring about [tx, 1, tz]");
        shelf_close(&s);
    }
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Orthonormal, and at a right angle to the axis, to rounding wherever the axis points, also where 1 + n . m
 * cancels and at n = -m itself. Along meridians that stop short of n = -m it turns no faster than the axis
 * does, but for tan(theta / 2). */
Test(curve_ring, the_frame_is_orthonormal_everywhere_and_continuous_short_of_the_opposite_point)
{
    static const bool varies[3] = {true, true, true};
    static const double towards[3][3] = {{0.1, 0.2, 0.9}, {-3, 1, 2}, {0.2, -5, 4}};
    for (int k = 0; k < 3; k++) {
        ves_frame frame = ves_frame_init(towards[k], varies);
        for (int meridian = 0; meridian < 12; meridian++) {
            double phi = pi * meridian / 6 + 0.1, last[2][3], step = pi / 720;
            for (int i = 0; i <= 726; i++) {
                double theta = i < 720 ? i * step : pi - (i < 726 ? pow(10, -3 * (i - 719)) : 0);
                double axis[3], e[2][3], length = 2.7;
                axis[frame.m] = frame.sign * length * cos(theta);
                axis[frame.other[0]] = i == 726 ? 0 : length * sin(theta) * cos(phi);
                axis[frame.other[1]] = i == 726 ? 0 : length * sin(theta) * sin(phi);
                ves_frame_bind(&frame, axis, e);
                cr_assert(fabs(dot(e[0], e[0]) - 1) < rounding && fabs(dot(e[1], e[1]) - 1) < rounding &&
                              fabs(dot(e[0], e[1])) < rounding && fabs(dot(e[0], axis)) < 3 * rounding &&
                              fabs(dot(e[1], axis)) < 3 * rounding,
                          "axis %g %g %g", axis[0], axis[1], axis[2]);
                for (int d = 0; d < 2 && i && i < 700; d++)
                    cr_assert(far(e[d], last[d]) < 1.01 * step * fmax(1, tan(theta / 2)), "jumps at %g",
                              theta);
                memcpy(last, e, sizeof last);
            }
        }
    }
}
