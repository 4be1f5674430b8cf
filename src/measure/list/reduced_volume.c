#include <math.h>

#include "base/vector.h"
#include "measure/flux.h"
#include "measure/sum.h"

/* V / (4 pi/3 R0^3), R0 = sqrt(A / 4 pi) [Ugail 2011, 7.5.2 with docs/errata.md] = 6 sqrt(pi) V / A^(3/2).
 * test  sphere 1 at any radius, 1 at most; spheroids */
static double of(double volume, double area)
{
    return 6 * sqrt(VES_PI) * volume / (area * sqrt(area));
}

static ves_status eval(const ves_measure_input *input, double *value)
{
    *value = of(ves_flux_volume(input), ves_sum_area(input));
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    const double volume = ves_flux_volume(input), area = ves_sum_area(input);
    ves_flux_volume_gradient(input, seed * of(1, area), adjoint);
    ves_sum_area_gradient(input, -1.5 * seed * of(volume, area) / area, adjoint);
}

const ves_measure ves_measure_reduced_volume = {
    .name = "reduced_volume",
    .about = "volume over that of a sphere of the same area; caps have no area",
    .unit = "1",
    .degree = 0,
    .surface = VES_X | VES_NORMAL | VES_AREA,
    .cap = VES_X | VES_XV,
    .closed = true,
    .eval = eval,
    .gradient = gradient,
    .most = 1,
    .most_of = "a sphere"};
