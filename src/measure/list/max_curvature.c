#include <math.h>

#include "measure/argument.h"
#include "measure/power.h"
#include "measure/principal.h"
#include "measure/summit.h"

enum { SMOOTH };

static const ves_key KEYS[] = {
    {.name = "smooth",
     .kind = VES_NUMBER,
     .unit = "1",
     .min = 0,
     .max = HUGE_VAL,
     .about = "0: the largest; p > 0: the mean of |k1|^p and |k2|^p over the area, to the power "
              "1/p, which is smooth for p >= 2"},
    {.name = NULL}};

/* |k| of the larger one is |H| + s. */
static double larger(const void *of, const ves_samples *s, int n)
{
    (void)of;
    return fabs(s->H[n]) + ves_principal_init(s->H[n], s->K[n]).s;
}

/* Over the nodes: the scale of power means. */
static double largest(const ves_measure_input *input)
{
    double most = -1;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            double k = larger(NULL, s, n);
            if (!(k <= most)) most = k;
            if (isnan(k)) return k;
        }
    }
    return most;
}

static ves_power gather(const ves_measure_input *input, double p, double most)
{
    ves_power power = {.p = p, .largest = most};
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            ves_principal k = ves_principal_init(s->H[n], s->K[n]);
            ves_power_add(&power, fabs(k.k1), s->dA[n] / 2);
            ves_power_add(&power, fabs(k.k2), s->dA[n] / 2);
        }
    }
    ves_power_close(&power);
    return power;
}

/* The largest principal curvature |k|, or its power mean ( integral (|k1|^p + |k2|^p) / 2 dA / A )^(1/p).
 * test  sphere 1/R for any p; torus 1/r, and p = 2: sqrt(bending / 2A); ellipsoid and cone; without looks
 * order 2; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double p = ves_argument_number(input, SMOOTH), most;
    if (!(p > 0)) return ves_summit_find(input, larger, NULL, input->room, value);
    most = largest(input);
    if (!(most >= 0)) return VES_NO_NUMBER;
    *value = gather(input, p, most).mean;
    return VES_OK;
}

static void scatter(const ves_samples *s, const ves_power *power, double seed, const ves_adjoint *adjoint)
{
    for (int n = 0; n < s->count; n++) {
        ves_principal k = ves_principal_init(s->H[n], s->K[n]);
        ves_power_slope g1 = ves_power_gradient(power, fabs(k.k1), s->dA[n] / 2);
        ves_power_slope g2 = ves_power_gradient(power, fabs(k.k2), s->dA[n] / 2);
        ves_principal_gradient(&k, seed * copysign(g1.x, k.k1), seed * copysign(g2.x, k.k2), &adjoint->H[n],
                               &adjoint->K[n]);
        adjoint->dA[n] += seed / 2 * (g1.w + g2.w);
    }
}

static void smooth_gradient(const ves_measure_input *input, double p, double seed,
                            const ves_adjoint *const *adjoint, double *number_adjoint)
{
    ves_power power = gather(input, p, largest(input));
    for (int i = 0; i < input->samples; i++)
        if (input->sample[i]->site == VES_SITE_SURFACE && adjoint[i]->H)
            scatter(input->sample[i], &power, seed, adjoint[i]);
    ves_argument_scatter(input, SMOOTH, 0, seed * ves_power_by_exponent(&power), number_adjoint);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    double p = ves_argument_number(input, SMOOTH);
    if (p > 0) {
        smooth_gradient(input, p, seed, adjoint, number_adjoint);
        return;
    }
    int i = (int)input->room[0], n = (int)input->room[1];
    if (!adjoint[i]->H) return;
    ves_principal k = ves_principal_init(input->sample[i]->H[n], input->sample[i]->K[n]);
    double g1 = k.k1 + k.k2 >= 0 ? seed : 0, g2 = k.k1 + k.k2 >= 0 ? 0 : -seed;
    ves_principal_gradient(&k, g1, g2, &adjoint[i]->H[n], &adjoint[i]->K[n]);
}

const ves_measure ves_measure_max_curvature = {.name = "max_curvature",
                                               .about = "the largest principal curvature, without its sign",
                                               .unit = "1/m",
                                               .degree = -1,
                                               .extreme = true,
                                               .looks = 1,
                                               .surface = VES_AREA | VES_CURVATURE,
                                               .keys = KEYS,
                                               .room = ves_summit_room,
                                               .eval = eval,
                                               .gradient = gradient};
