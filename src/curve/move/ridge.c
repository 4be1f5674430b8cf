/* Ridges: C_new(v) = C(v) + by b(v) e(v), b the periodic uniform cubic B-spline whose N = `points`
 * coefficients are +1, -1, +1 ... (+1 at v = 0, |b| = 1/3 at the knots): what moving alternate control points
 * of a spline by +-by along e gives [Ugail 2011, eq 7.6]. Its spectrum has the odd multiples of N/2 alone:
 *     b(v) = sum_{m odd} 2 (2 / (pi m))^4 cos(m N/2 v)
 *   radial  e(v) = e0 cos v + e1 sin v, where e0 and e1 are the unit vectors along the first cosine and sine
 *           modes a_1, b_1 of the curve: a circle that has been dilated unevenly still has the directions of
 *           the circle
 *   axis    e = a_1 x b_1 / |a_1 x b_1|: the side from which the curve is seen to run counterclockwise
 * Products with cos v and sin v move a mode by one, nothing is sampled. */
#include <math.h>

#include "base/vector.h"
#include "curve/modes.h"

enum { POINTS, BY, ALONG };
enum { RADIAL, AXIS };

static const ves_key keys[] = {
    {.name = "points",
     .kind = VES_COUNT,
     .required = true,
     .min = 2,
     .max = 1 << 16,
     .about = "control points, an even number; half as many ridges"},
    {.name = "by",
     .kind = VES_NUMBER,
     .required = true,
     .about = "how far control points move, alternately + and -"},
    {.name = "along",
     .kind = VES_CHOICE,
     .fallback = RADIAL,
     .words = "radial|axis",
     .about = "radial: away from the centre, in the curve's plane; axis: across that plane"},
    {.name = NULL},
};

static int choice(const ves_curve_input *input)
{
    return input->args->arg[ALONG].value;
}

static int lowest(const ves_curve_input *input)
{
    return input->args->arg[POINTS].value / 2;
}

/* The highest mode of b for which the product with e stays inside the limit; 0: none does. */
static int highest(const ves_curve_input *input)
{
    int half = lowest(input), most = input->limit - (choice(input) == RADIAL);
    return most < half ? 0 : half * ((most / half - 1) / 2 * 2 + 1);
}

static double factor(int mode, int half)
{
    double s = 2.0 * half / (VES_PI * mode);
    return 2 * s * s * s * s;
}

/* First cosine and sine mode of the curve as vectors. */
static void first_modes(const ves_curve_input *input, double a[3], double b[3])
{
    int stride = ves_curve_stride(input->input_modes[0]);
    for (int c = 0; c < 3; c++) {
        a[c] = stride > 1 ? input->input[0][c * stride + 1] : 0;
        b[c] = stride > 1 ? input->input[0][c * stride + 2] : 0;
    }
}

/* The vectors whose unit vectors are the directions: a_1 and b_1, or a_1 x b_1 (twice). */
static void directions(const ves_curve_input *input, double d[2][3])
{
    double a[3], b[3];
    first_modes(input, a, b);
    for (int c = 0; c < 3; c++) d[0][c] = a[c], d[1][c] = b[c];
    if (choice(input) == AXIS) ves_cross(a, b, d[0]), ves_cross(a, b, d[1]);
}

static ves_status prepare(const ves_curve_input *input, ves_arena *arena, void **state, ves_diag *diag)
{
    (void)arena, (void)state;
    double d[2][3];
    int points = input->args->arg[POINTS].value;
    if (points < 2 || points % 2)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, POINTS),
                            "\"points\" of a ridge must be even, found %d: they move alternately out and in",
                            points);
    if (highest(input) == 0)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, POINTS),
                            "%d points need %d modes, but a curve may have at most %d here", points,
                            points / 2 + 1, input->limit);
    directions(input, d);
    if (ves_dot(d[0], d[0]) > 0 && ves_dot(d[1], d[1]) > 0) return VES_OK;
    return ves_diag_add(
        diag, VES_ERROR, VES_RANGE, input->args->mark,
        "a ridge needs a curve that goes round: this one has no first mode to take directions from");
}

static int modes(const ves_curve_input *input)
{
    int own = highest(input) + (choice(input) == RADIAL);
    return own > input->input_modes[0] ? own : input->input_modes[0];
}

static void eval(const ves_curve_input *input, double *out)
{
    int half = lowest(input), stride = ves_curve_stride(input->modes), top = highest(input);
    double by = ves_input_number(input, BY), d[2][3];
    directions(input, d);
    double l0 = sqrt(ves_dot(d[0], d[0])), l1 = sqrt(ves_dot(d[1], d[1]));
    ves_modes_copy(input->input[0], input->input_modes[0], input->modes, out);
    for (int k = half; k <= top; k += 2 * half)
        for (int c = 0; c < 3; c++) {
            double *mode = out + c * stride + 2 * k - 1; /* cos k v; sin k v follows */
            double f = by * factor(k, half), e0 = f * d[0][c] / l0, e1 = f * d[1][c] / l1;
            if (choice(input) == AXIS) {
                mode[0] += e0;
                continue;
            }
            mode[2] += e0 / 2;
            mode[3] += e1 / 2;
            if (k > 1)
                mode[-2] += e0 / 2, mode[-1] -= e1 / 2;
            else
                mode[-1] += e0 / 2; /* cos^2 v has a mean; sin v cos v has none */
        }
}

/* d J / d e of the transposed products. */
static void transpose(const ves_curve_input *input, const double *adjoint, double e_adjoint[2][3])
{
    int half = lowest(input), stride = ves_curve_stride(input->modes), top = highest(input);
    for (int c = 0; c < 3; c++) {
        e_adjoint[0][c] = e_adjoint[1][c] = 0;
        for (int k = half; k <= top; k += 2 * half) {
            const double *mode = adjoint + c * stride + 2 * k - 1;
            double f = factor(k, half);
            if (choice(input) == AXIS) {
                e_adjoint[0][c] += f * mode[0];
                continue;
            }
            e_adjoint[0][c] += f / 2 * (mode[2] + (k > 1 ? mode[-2] : mode[-1]));
            e_adjoint[1][c] += f / 2 * (mode[3] - (k > 1 ? mode[-1] : 0));
        }
    }
}

/* From the directions d to the first modes of the input. */
static void scatter(const ves_curve_input *input, double d_adjoint[2][3], double *input_adjoint)
{
    int stride = ves_curve_stride(input->input_modes[0]);
    double a[3], b[3], a_adjoint[3], b_adjoint[3];
    first_modes(input, a, b);
    for (int c = 0; c < 3; c++) a_adjoint[c] = d_adjoint[0][c], b_adjoint[c] = d_adjoint[1][c];
    if (choice(input) == AXIS) ves_cross(b, d_adjoint[0], a_adjoint), ves_cross(d_adjoint[0], a, b_adjoint);
    for (int c = 0; input_adjoint && c < 3; c++) {
        input_adjoint[c * stride + 1] += a_adjoint[c];
        input_adjoint[c * stride + 2] += b_adjoint[c];
    }
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    double d[2][3], e_adjoint[2][3], by = ves_input_number(input, BY), by_adjoint = 0;
    ves_modes_scatter(adjoint, input->modes, 1, input->input_modes[0], input_adjoint[0]);
    directions(input, d);
    transpose(input, adjoint, e_adjoint);
    for (int i = 0; i < 2; i++) {
        double length = sqrt(ves_dot(d[i], d[i])), along = ves_dot(e_adjoint[i], d[i]) / length;
        by_adjoint += along;
        for (int c = 0; c < 3; c++)
            e_adjoint[i][c] = by * (e_adjoint[i][c] - along * d[i][c] / length) / length;
    }
    ves_input_scatter(input, BY, 0, by_adjoint, number_adjoint);
    scatter(input, e_adjoint, input_adjoint[0]);
}

const ves_curve_op ves_curve_ridge_op = {
    .name = "ridge",
    .about = "ridges, as by moving control points alternately out and in",
    .move = true,
    .keys = keys,
    .prepare = prepare,
    .modes = modes,
    .eval = eval,
    .gradient = gradient,
};
