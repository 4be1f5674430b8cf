#include <math.h>

#include "base/vector.h"
#include "measure/argument.h"

/* What holds a membrane to a plane: the integral over the surface of the Morse potential
 *     w (exp(-2 h / range) - 2 exp(-h / range)),   h the height over the plane,
 * which is -w in contact, h = 0, rises steeply below, and nothing far above. As the range goes to 0 it is the contact
 * potential -w A_contact [Seifert and Lipowsky 1990].
 * test  a flat disc at any height; a sphere by a closed form; differences in every number */
enum { AT, NORMAL, W, RANGE };

static const ves_key KEYS[] = {
    {.name = "at", .kind = VES_VECTOR, .unit = "m", .required = true, .about = "a point of the plane"},
    {.name = "normal",
     .kind = VES_VECTOR,
     .about = "the side of the plane that is free; [0, 1, 0] unless given"},
    {.name = "w",
     .kind = VES_NUMBER,
     .required = true,
     .unit = "kg/s^2",
     .about = "energy of contact per area"},
    {.name = "range",
     .kind = VES_NUMBER,
     .required = true,
     .unit = "m",
     .min = VES_POSITIVE,
     .max = HUGE_VAL,
     .about = "how far the potential reaches"},
    {.name = NULL}};

typedef struct plane {
    ves_direction up;
    double at[3], w, range;
} plane;

static ves_status plane_init(const ves_measure_input *input, plane *p)
{
    p->w = ves_argument_number(input, W), p->range = ves_argument_number(input, RANGE);
    for (int c = 0; c < 3; c++) p->at[c] = input->number[input->args->arg[AT].first + c];
    return ves_direction_init(input, NORMAL, &p->up);
}

static double height(const plane *p, const ves_samples *s, int n)
{
    double h = 0;
    for (int c = 0; c < 3; c++) h += (s->X[c][n] - p->at[c]) * p->up.unit[c];
    return h;
}

static ves_status eval(const ves_measure_input *input, double *value)
{
    plane p;
    double sum = 0;
    VES_TRY(plane_init(input, &p));
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            double e = exp(-height(&p, s, n) / p.range);
            sum += (e * e - 2 * e) * s->dA[n];
        }
    }
    *value = p.w * sum;
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    plane p;
    double sum = 0, by_h = 0, by_range = 0, by_normal[3] = {0};
    if (plane_init(input, &p) != VES_OK) return;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        const ves_adjoint *g = adjoint[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            double h = height(&p, s, n), e = exp(-h / p.range);
            double slope = seed * p.w * 2 * (e - e * e) / p.range * s->dA[n];
            sum += (e * e - 2 * e) * s->dA[n];
            by_h += slope, by_range -= slope * h / p.range;
            for (int c = 0; c < 3; c++) by_normal[c] += slope * (s->X[c][n] - p.at[c]);
            if (!g->X[0]) continue;
            g->dA[n] += seed * p.w * (e * e - 2 * e);
            for (int c = 0; c < 3; c++) g->X[c][n] += slope * p.up.unit[c];
        }
    }
    for (int c = 0; c < 3; c++) ves_argument_scatter(input, AT, c, -by_h * p.up.unit[c], number_adjoint);
    ves_direction_gradient(input, NORMAL, &p.up, by_normal, number_adjoint);
    ves_argument_scatter(input, W, 0, seed * sum, number_adjoint);
    ves_argument_scatter(input, RANGE, 0, by_range, number_adjoint);
}

const ves_measure ves_measure_adhesion = {.name = "adhesion",
                                          .about =
                                              "energy of the surface in a potential that holds it to a plane",
                                          .unit = "kg m^2/s^2",
                                          .degree = VES_NO_DEGREE,
                                          .surface = VES_X | VES_AREA,
                                          .keys = KEYS,
                                          .eval = eval,
                                          .gradient = gradient};
