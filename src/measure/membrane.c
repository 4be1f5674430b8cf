#include "measure/membrane.h"

#include <math.h>

#include "base/vector.h"
#include "measure/argument.h"

static double sphere_radius(double area)
{
    return sqrt(area / (4 * VES_PI));
}

ves_membrane ves_membrane_init(const ves_measure_input *input)
{
    ves_membrane m = {.kappa = ves_argument_number(input, VES_MEMBRANE_KAPPA),
                      .c0 = ves_argument_number(input, VES_MEMBRANE_C0),
                      .reduced_c0 = ves_argument_number(input, VES_MEMBRANE_REDUCED_C0),
                      .kappa_g = ves_argument_number(input, VES_MEMBRANE_KAPPA_G),
                      .area = ves_sum_area(input)};
    ves_sum_eval(input, (ves_quadratic){.m = 1}, &m.mean);
    m.R0 = sphere_radius(m.area);
    m.C0 = m.c0 + (m.reduced_c0 != 0 ? m.reduced_c0 / m.R0 : 0);
    return m;
}

/* kappa/2 (2 H - C0)^2 + kappa_g K */
static ves_quadratic integrand(const ves_membrane *m)
{
    return (ves_quadratic){
        .h = 2 * m->kappa, .k = m->kappa_g, .m = -2 * m->kappa * m->C0, .a = m->kappa / 2 * m->C0 * m->C0};
}

double ves_membrane_energy(const ves_measure_input *input, const ves_membrane *m)
{
    double energy;
    ves_sum_eval(input, integrand(m), &energy);
    return energy;
}

/* What the integrals of the parts are worth to numbers that were written; where none was they are not taken. */
static void rigidities_scatter(const ves_measure_input *input, const ves_membrane *m, double seed,
                               double *number_adjoint)
{
    double sum;
    if (input->args->arg[VES_MEMBRANE_KAPPA].given) {
        ves_quadratic bending = integrand(m);
        bending.k = 0;
        ves_sum_eval(input, bending, &sum);
        ves_argument_scatter(input, VES_MEMBRANE_KAPPA, 0, seed * sum / m->kappa, number_adjoint);
    }
    if (input->args->arg[VES_MEMBRANE_KAPPA_G].given) {
        ves_sum_eval(input, (ves_quadratic){.k = 1}, &sum);
        ves_argument_scatter(input, VES_MEMBRANE_KAPPA_G, 0, seed * sum, number_adjoint);
    }
}

void ves_membrane_energy_gradient(const ves_measure_input *input, const ves_membrane *m, double seed,
                                  const ves_adjoint *const *adjoint, double *number_adjoint)
{
    const double by_C0 = m->kappa * (m->C0 * m->area - 2 * m->mean);
    ves_quadratic f = integrand(m);
    if (m->reduced_c0 != 0) f.a -= by_C0 * m->reduced_c0 / (2 * m->R0 * m->area);
    ves_sum_gradient(input, f, seed, adjoint);
    ves_argument_scatter(input, VES_MEMBRANE_C0, 0, seed * by_C0, number_adjoint);
    ves_argument_scatter(input, VES_MEMBRANE_REDUCED_C0, 0, seed * by_C0 / m->R0, number_adjoint);
    rigidities_scatter(input, m, seed, number_adjoint);
}

double ves_membrane_difference(const ves_measure_input *input)
{
    double mean;
    ves_sum_eval(input, (ves_quadratic){.m = 1}, &mean);
    return mean / (4 * VES_PI * sphere_radius(ves_sum_area(input)));
}

/* M goes with A^(-1/2). */
void ves_membrane_difference_gradient(const ves_measure_input *input, double seed,
                                      const ves_adjoint *const *adjoint)
{
    const double area = ves_sum_area(input), scale = 4 * VES_PI * sphere_radius(area);
    const double M = ves_membrane_difference(input);
    ves_sum_gradient(input, (ves_quadratic){.m = 1 / scale, .a = -M / (2 * area)}, seed, adjoint);
}
