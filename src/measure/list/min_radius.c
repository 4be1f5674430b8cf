#include <math.h>

#include "measure/principal.h"
#include "measure/summit.h"

enum { SIDE };
enum { BOTH, INSIDE, OUTSIDE };

static const ves_key KEYS[] = {
    {.name = "side",
     .kind = VES_CHOICE,
     .words = "both|inside|outside",
     .about = "outside: where the surface bulges outward, inside: where it is hollow seen from outside"},
    {.name = NULL}};

/* A surface that is nowhere curved that way has no least radius: it is told as so many times the root of its area,
 * since a candidate that any limit would accept must have a number. */
static const double FLAT = 1e6;

static bool closes(const ves_args *args)
{
    return args->arg[SIDE].value != BOTH;
}

/* H is positive on a sphere that faces outward. */
static double bend(const void *of, const ves_samples *s, int n)
{
    const ves_measure_input *input = of;
    ves_principal k = ves_principal_init(s->H[n], s->K[n]);
    int side = input->args->arg[SIDE].value;
    return side == BOTH ? fabs(s->H[n]) + k.s : side == INSIDE ? -k.k2 : k.k1;
}

static double area(const ves_measure_input *input)
{
    double sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        for (int n = 0; s->site == VES_SITE_SURFACE && n < s->count; n++) sum += s->dA[n];
    }
    return sum;
}

/* room: that of the summit, then the curvature there. */
static size_t room(const ves_measure_input *input)
{
    return 1 + ves_summit_room(input);
}

/* 1 / max |k|, 1 / max -k2 (inside) or 1 / max k1 (outside), at most FLAT times the root of the area.
 * test  sphere, torus on every side, ellipsoid, tube; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double most, far = FLAT * sqrt(area(input));
    VES_TRY(ves_summit_find(input, bend, input, input->room + 1, &most));
    input->room[0] = most;
    *value = most * far > 1 ? 1 / most : far;
    return VES_OK;
}

static void flat_gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint)
{
    double slope = seed * FLAT / (2 * sqrt(area(input)));
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE || !adjoint[i]->dA) continue;
        for (int n = 0; n < s->count; n++) adjoint[i]->dA[n] += slope;
    }
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    double most = input->room[0];
    if (!(most * FLAT * sqrt(area(input)) > 1)) {
        flat_gradient(input, seed, adjoint);
        return;
    }
    int i = (int)input->room[1], n = (int)input->room[2], side = input->args->arg[SIDE].value;
    if (!adjoint[i]->H) return;
    ves_principal k = ves_principal_init(input->sample[i]->H[n], input->sample[i]->K[n]);
    bool first = side == OUTSIDE || (side == BOTH && k.k1 + k.k2 >= 0);
    double back = -seed / (most * most);
    ves_principal_gradient(&k, first ? back : 0, first ? 0 : -back, &adjoint[i]->H[n], &adjoint[i]->K[n]);
}

const ves_measure ves_measure_min_radius = {
    .name = "min_radius",
    .about = "the least radius of curvature of the surface, 1/max_curvature; 1e6 times the root of its area "
             "where it is flatter than that",
    .unit = "m",
    .degree = 1,
    .extreme = true,
    .looks = 1,
    .surface = VES_AREA | VES_CURVATURE,
    .closes = closes,
    .keys = KEYS,
    .room = room,
    .eval = eval,
    .gradient = gradient};
