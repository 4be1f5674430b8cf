#include <math.h>

#include "measure/argument.h"
#include "measure/power.h"
#include "measure/summit.h"

enum { AXIS, SMOOTH };

static const ves_key KEYS[] = {
    {.name = "axis",
     .kind = VES_VECTOR,
     .unit = "1",
     .about = "the way the mould opens, [0, 1, 0] unless given; any length"},
    {.name = "smooth",
     .kind = VES_NUMBER,
     .unit = "1",
     .min = 0,
     .max = HUGE_VAL,
     .about = "0: the least; p > 0: -log(mean of exp(-p draft) over the area)/p, which is more, and smooth"},
    {.name = NULL}};

static unsigned needs(const ves_args *args)
{
    return VES_NORMAL | (args->arg[SMOOTH].given ? VES_AREA : 0);
}

static void normal_of(const ves_samples *s, int n, double normal[3])
{
    for (int c = 0; c < 3; c++) normal[c] = s->normal[c][n];
}

/* sin of the draft is -n . axis, its cosine |n x axis|; exact to rounding at a level wall too. */
static double draft(const double normal[3], const double axis[3])
{
    double across[3];
    ves_cross(normal, axis, across);
    return atan2(-ves_dot(normal, axis), sqrt(ves_dot(across, across)));
}

/* Adds scale * d draft / d of and d with, which may be the normal and the axis either way round. On a level wall
 * the draft has a kink, and 0 is one of its slopes. */
static void draft_gradient(const double of[3], const double with[3], double scale, double back[3])
{
    double dot = ves_dot(of, with), across[3];
    ves_cross(of, with, across);
    double cosine = sqrt(ves_dot(across, across));
    if (!(cosine > 0)) return;
    for (int c = 0; c < 3; c++)
        back[c] += scale * (-cosine * with[c] + dot * (of[c] - dot * with[c]) / cosine);
}

/* The least draft is where the normal points most along the axis. */
static double height(const void *of, const ves_samples *s, int n)
{
    double normal[3];
    normal_of(s, n, normal);
    return ves_dot(normal, of);
}

/* The power mean of exp(-draft), which is positive whatever the draft. */
static ves_status gather(const ves_measure_input *input, double p, const double axis[3], ves_power *power)
{
    *power = (ves_power){.p = p, .largest = exp(VES_PI / 2)};
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            double normal[3];
            normal_of(s, n, normal);
            double x = exp(-draft(normal, axis));
            if (!isfinite(x)) return VES_NO_NUMBER;
            ves_power_add(power, x, s->dA[n]);
        }
    }
    ves_power_close(power);
    return power->mean > 0 ? VES_OK : VES_NO_NUMBER;
}

/* The least angle between the wall's tangent plane and the axis, asin(-n . axis), n outward: positive where the wall
 * widens along the axis, negative where it is undercut. Or the soft least of it. Caps do not count.
 * VES_NO_NUMBER: the axis is zero.
 * test  cone, ball, ellipsoid in closed form; soft least on a cone and in closed form on a ball; turns with the
 * shape; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double p = ves_argument_number(input, SMOOTH), normal[3], top;
    ves_direction d;
    VES_TRY(ves_direction_init(input, AXIS, &d));
    if (p > 0) {
        ves_power power;
        VES_TRY(gather(input, p, d.unit, &power));
        *value = -log(power.mean);
        return VES_OK;
    }
    VES_TRY(ves_summit_find(input, height, d.unit, input->room, &top));
    normal_of(input->sample[(int)input->room[0]], (int)input->room[1], normal);
    *value = draft(normal, d.unit);
    return VES_OK;
}

/* Of one node. */
static void scatter(const ves_samples *s, int n, const double axis[3], double scale,
                    const ves_adjoint *adjoint, double axis_back[3])
{
    double normal[3], back[3] = {0};
    normal_of(s, n, normal);
    draft_gradient(axis, normal, scale, axis_back);
    if (!adjoint->normal[0]) return;
    draft_gradient(normal, axis, scale, back);
    for (int c = 0; c < 3; c++) adjoint->normal[c][n] += back[c];
}

static void smooth_gradient(const ves_measure_input *input, const double axis[3], double seed,
                            const ves_adjoint *const *adjoint, double axis_back[3], double *number_adjoint)
{
    ves_power power;
    if (gather(input, ves_argument_number(input, SMOOTH), axis, &power) != VES_OK) return;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            double normal[3];
            normal_of(s, n, normal);
            double x = exp(-draft(normal, axis));
            ves_power_slope g = ves_power_gradient(&power, x, s->dA[n]);
            scatter(s, n, axis, seed * g.x * x / power.mean, adjoint[i], axis_back);
            if (adjoint[i]->dA) adjoint[i]->dA[n] -= seed * g.w / power.mean;
        }
    }
    ves_argument_scatter(input, SMOOTH, 0, -seed * ves_power_by_exponent(&power) / power.mean,
                         number_adjoint);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double back[3] = {0};
    if (ves_direction_init(input, AXIS, &d) != VES_OK) return;
    if (ves_argument_number(input, SMOOTH) > 0) {
        smooth_gradient(input, d.unit, seed, adjoint, back, number_adjoint);
    } else {
        int i = (int)input->room[0], n = (int)input->room[1];
        scatter(input->sample[i], n, d.unit, seed, adjoint[i], back);
    }
    ves_direction_gradient(input, AXIS, &d, back, number_adjoint);
}

const ves_measure ves_measure_draft_angle = {
    .name = "draft_angle",
    .about =
        "the least draft of the wall: the angle between its tangent plane and an axis, positive where it "
        "widens along the axis, negative where it is undercut; caps do not count",
    .unit = "rad",
    .degree = 0,
    .extreme = true,
    .looks = 1,
    .surface = VES_NORMAL | VES_AREA,
    .closed = true,
    .keys = KEYS,
    .needs = needs,
    .room = ves_summit_room,
    .eval = eval,
    .gradient = gradient};
