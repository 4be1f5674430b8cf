/* A curve by its coefficients: mean + sum_n cos[n-1] cos(n v) + sin[n-1] sin(n v)  [Ugail 2011, eq 4.20]. */
#include "curve/modes.h"

enum { MEAN, COS, SIN };

static const double origin[3] = {0, 0, 0};

static const ves_key keys[] = {
    {.name = "mean", .kind = VES_VECTOR, .about = "the mean point, the origin unless given"},
    {.name = "cos", .kind = VES_POINTS, .about = "[[x, y, z], ...]: factors of cos v, cos 2v, ..."},
    {.name = "sin", .kind = VES_POINTS, .about = "[[x, y, z], ...]: factors of sin v, sin 2v, ..."},
    {.name = NULL},
};

static int modes(const ves_curve_input *input)
{
    int cosines, sines;
    ves_input_list(input, COS, &cosines);
    ves_input_list(input, SIN, &sines);
    return (cosines > sines ? cosines : sines) / 3;
}

static ves_status prepare(const ves_curve_input *input, ves_arena *arena, void **state, ves_diag *diag)
{
    (void)arena, (void)state;
    if (modes(input) <= input->limit) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_RANGE, input->args->mark,
                        "%d modes are given, but a curve may have at most %d here", modes(input),
                        input->limit);
}

static void eval(const ves_curve_input *input, double *out)
{
    const double *mean = ves_input_vector(input, MEAN, origin);
    int stride = ves_curve_stride(input->modes);
    for (int k = 0; k < 3 * stride; k++) out[k] = 0;
    for (int c = 0; c < 3; c++) out[c * stride] = mean[c];
    for (int key = COS; key <= SIN; key++) {
        int count;
        const double *list = ves_input_list(input, key, &count);
        for (int i = 0; i < count; i++) out[i % 3 * stride + 2 * (i / 3) + key] = list[i];
    }
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)input_adjoint;
    int stride = ves_curve_stride(input->modes);
    for (int c = 0; c < 3; c++) ves_input_scatter(input, MEAN, c, adjoint[c * stride], number_adjoint);
    for (int key = COS; key <= SIN; key++) {
        int count;
        ves_input_list(input, key, &count);
        for (int i = 0; i < count; i++)
            ves_input_scatter(input, key, i, adjoint[i % 3 * stride + 2 * (i / 3) + key], number_adjoint);
    }
}

const ves_curve_op ves_curve_fourier_op = {
    .name = "fourier",
    .about = "a curve by its Fourier coefficients",
    .keys = keys,
    .prepare = prepare,
    .modes = modes,
    .eval = eval,
    .gradient = gradient,
};
