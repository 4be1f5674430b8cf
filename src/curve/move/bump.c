/* A local perturbation between two places of a curve [Ugail 2011, eqs 6.1-6.2]:
 *     C_new(v) = C(v) + by 3/2 B((v - c) / h),  c = (from + to) / 2,  h = (to - from) / 4
 * with the cubic B-spline B: zero outside (from, to), twice continuously differentiable at both ends, exactly
 * `by` in the middle. Only the difference of the angles counts, up to whole turns: from 6 to 0.5 goes through
 * 2 pi. Modes, with x = n h / 2:
 *     a_n, b_n = by 3 h / (2 pi) sinc^4(x) (cos n c, sin n c),  half of that for the mean.
 * They fall off as n^-4 and never end: cut at the band limit. */
#include <math.h>

#include "base/vector.h"
#include "curve/modes.h"

enum { FROM, TO, BY };

static const double nothing[3] = {0, 0, 0};

static const ves_key keys[] = {
    {.name = "from", .kind = VES_NUMBER, .required = true, .unit = "1", .about = "angle v where it begins"},
    {.name = "to",
     .kind = VES_NUMBER,
     .required = true,
     .unit = "1",
     .about = "angle v where it ends; whole turns do not count, and equal angles mean all the way round"},
    {.name = "by", .kind = VES_VECTOR, .required = true, .about = "[x, y, z] to add in the middle"},
    {.name = NULL},
};

/* h = quarter width and c = centre; equal angles mean one whole turn. */
static void place(const ves_curve_input *input, double *h, double *c)
{
    double from = ves_input_number(input, FROM), width = ves_input_number(input, TO) - from;
    width -= 2 * VES_PI * floor(width / (2 * VES_PI));
    if (width == 0) width = 2 * VES_PI;
    *h = width / 4;
    *c = from + width / 2;
}

/* Amplitude of mode n and its derivative with respect to h. */
static double amplitude(int n, double h, double *slope)
{
    double x = n * h / 2, s = ves_sinc(x), scale = (n ? 3 : 1.5) / (2 * VES_PI);
    *slope = scale * s * s * s * (4 * cos(x) - 3 * s); /* of h sinc^4, since x sinc' = cos - sinc */
    return scale * h * s * s * s * s;
}

static int modes(const ves_curve_input *input)
{
    return input->input_modes[0] > input->limit ? input->input_modes[0] : input->limit;
}

static void eval(const ves_curve_input *input, double *out)
{
    const double *by = ves_input_vector(input, BY, nothing);
    double h, c, slope;
    int stride = ves_curve_stride(input->modes);
    place(input, &h, &c);
    ves_modes_copy(input->input[0], input->input_modes[0], input->modes, out);
    double step[2] = {cos(c), sin(c)}, z[2] = {1, 0};
    for (int n = 0; n <= input->modes; n++) {
        double f = amplitude(n, h, &slope);
        for (int d = 0; d < 3; d++) {
            out[d * stride + (n ? 2 * n - 1 : 0)] += f * z[0] * by[d];
            if (n) out[d * stride + 2 * n] += f * z[1] * by[d];
        }
        ves_turn(z, step);
    }
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    const double *by = ves_input_vector(input, BY, nothing);
    double h, c, slope, h_adjoint = 0, c_adjoint = 0, by_adjoint[3] = {0, 0, 0};
    int stride = ves_curve_stride(input->modes);
    place(input, &h, &c);
    ves_modes_scatter(adjoint, input->modes, 1, input->input_modes[0], input_adjoint[0]);
    double step[2] = {cos(c), sin(c)}, z[2] = {1, 0};
    for (int n = 0; n <= input->modes; n++) {
        double f = amplitude(n, h, &slope);
        for (int d = 0; d < 3; d++) {
            double p = adjoint[d * stride + (n ? 2 * n - 1 : 0)], q = n ? adjoint[d * stride + 2 * n] : 0;
            double along = p * z[0] + q * z[1];
            by_adjoint[d] += f * along;
            h_adjoint += slope * along * by[d];
            c_adjoint += f * n * (q * z[0] - p * z[1]) * by[d];
        }
        ves_turn(z, step);
    }
    ves_input_scatter(input, FROM, 0, c_adjoint / 2 - h_adjoint / 4, number_adjoint);
    ves_input_scatter(input, TO, 0, c_adjoint / 2 + h_adjoint / 4, number_adjoint);
    for (int d = 0; d < 3; d++) ves_input_scatter(input, BY, d, by_adjoint[d], number_adjoint);
}

const ves_curve_op ves_curve_bump_op = {
    .name = "bump",
    .about = "pushes a curve out between two places",
    .move = true,
    .keys = keys,
    .modes = modes,
    .eval = eval,
    .gradient = gradient,
};
