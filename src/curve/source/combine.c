/* A weighted sum of curves: morphs, differences, second differences  [Ugail 2005, eqs 32-33]. */
#include "curve/modes.h"

enum { TERMS };

static const ves_key keys[] = {
    {.name = "terms", .kind = VES_TERMS, .required = true, .unit = "1", .about = "[[weight, curve], ...]"},
    {.name = NULL},
};

static void eval(const ves_curve_input *input, double *out)
{
    int count, size = 3 * ves_curve_stride(input->modes);
    const double *weight = ves_input_list(input, TERMS, &count);
    for (int k = 0; k < size; k++) out[k] = 0;
    for (int i = 0; i < input->inputs; i++)
        ves_modes_add(input->input[i], input->input_modes[i], weight[i], input->modes, out);
}

static double product(const double *term, int term_modes, const double *adjoint, int modes)
{
    int from = ves_curve_stride(term_modes), to = ves_curve_stride(modes);
    double sum = 0;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < from; k++) sum += term[c * from + k] * adjoint[c * to + k];
    return sum;
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    int count;
    const double *weight = ves_input_list(input, TERMS, &count);
    for (int i = 0; i < input->inputs; i++) {
        double sum = product(input->input[i], input->input_modes[i], adjoint, input->modes);
        ves_input_scatter(input, TERMS, i, sum, number_adjoint);
        ves_modes_scatter(adjoint, input->modes, weight[i], input->input_modes[i], input_adjoint[i]);
    }
}

const ves_curve_op ves_curve_combine_op = {
    .name = "combine",
    .about = "a weighted sum of curves",
    .keys = keys,
    .modes = ves_input_modes,
    .eval = eval,
    .gradient = gradient,
};
