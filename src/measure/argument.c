#include "measure/argument.h"

#include <math.h>

double ves_argument_number(const ves_measure_input *input, int key)
{
    const ves_arg *arg = &input->args->arg[key];
    return arg->count > 0 ? input->number[arg->first] : input->args->key[key].fallback;
}

void ves_argument_scatter(const ves_measure_input *input, int key, int i, double value,
                          double *number_adjoint)
{
    const ves_arg *arg = &input->args->arg[key];
    if (arg->given) number_adjoint[arg->first + i] += value;
}

ves_status ves_direction_init(const ves_measure_input *input, int key, ves_direction *direction)
{
    static const double upward[3] = {0, 1, 0};
    const ves_arg *arg = &input->args->arg[key];
    const double *vector = arg->given ? input->number + arg->first : upward;
    double length = sqrt(ves_dot(vector, vector));
    if (!(length > 0) || !isfinite(length)) return VES_NO_NUMBER;
    direction->length = length;
    for (int c = 0; c < 3; c++) direction->unit[c] = vector[c] / length;
    return VES_OK;
}

void ves_direction_gradient(const ves_measure_input *input, int key, const ves_direction *direction,
                            const double back[3], double *number_adjoint)
{
    double along = ves_dot(back, direction->unit);
    for (int c = 0; c < 3; c++)
        ves_argument_scatter(input, key, c, (back[c] - along * direction->unit[c]) / direction->length,
                             number_adjoint);
}
