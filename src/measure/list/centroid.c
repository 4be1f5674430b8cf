#include "measure/argument.h"
#include "measure/flux.h"

enum { OF, ALONG };
enum { OF_SURFACE, OF_VOLUME };

static const ves_key KEYS[] = {
    {.name = "of",
     .kind = VES_CHOICE,
     .words = "surface|volume",
     .about = "of the surface (a thin skin, without caps), or of what it encloses (caps count)"},
    {.name = "along",
     .kind = VES_VECTOR,
     .unit = "1",
     .about = "the component along this direction, [0, 1, 0] unless given"},
    {.name = NULL}};

static bool closes(const ves_args *args)
{
    return args->arg[OF].value == OF_VOLUME;
}

static unsigned needs(const ves_args *args)
{
    return VES_X | VES_AREA | (closes(args) ? VES_NORMAL : 0);
}

/* Area and first moment of the surface, in the members of ves_flux. */
static void surface_add(const ves_samples *s, const double d[3], ves_flux *sum)
{
    for (int n = 0; s->site == VES_SITE_SURFACE && n < s->count; n++) {
        double t = d[0] * s->X[0][n] + d[1] * s->X[1][n] + d[2] * s->X[2][n];
        sum->volume += s->dA[n], sum->moment += t * s->dA[n];
    }
}

static void surface_gradient(const ves_samples *s, const double d[3], ves_flux back,
                             const ves_adjoint *adjoint, double d_back[3])
{
    for (int n = 0; s->site == VES_SITE_SURFACE && n < s->count; n++) {
        double t = d[0] * s->X[0][n] + d[1] * s->X[1][n] + d[2] * s->X[2][n], g = back.moment * s->dA[n];
        for (int c = 0; c < 3; c++) d_back[c] += g * s->X[c][n];
        if (!adjoint->X[0]) continue;
        adjoint->dA[n] += back.volume + back.moment * t;
        for (int c = 0; c < 3; c++) adjoint->X[c][n] += g * d[c];
    }
}

static ves_flux total(const ves_measure_input *input, const double d[3])
{
    ves_flux sum = {0};
    for (int i = 0; i < input->samples; i++) {
        if (closes(input->args))
            ves_flux_add(input->sample[i], d, &sum);
        else
            surface_add(input->sample[i], d, &sum);
    }
    return sum;
}

/* d . centroid, d = along / |along|: integral of d . X over the volume (or the surface), over the volume
 * (or the area). VES_NO_NUMBER: along is zero, or the shape encloses nothing.
 * test  frustum and half ball with caps, cone; moves and turns with the shape; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    VES_TRY(ves_direction_init(input, ALONG, &d));
    ves_flux sum = total(input, d.unit);
    if (sum.volume == 0) return VES_NO_NUMBER;
    *value = sum.moment / sum.volume;
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double d_back[3] = {0};
    if (ves_direction_init(input, ALONG, &d) != VES_OK) return;
    ves_flux sum = total(input, d.unit);
    ves_flux back = {.volume = -seed * sum.moment / (sum.volume * sum.volume), .moment = seed / sum.volume};
    for (int i = 0; i < input->samples; i++) {
        if (closes(input->args))
            ves_flux_gradient(input->sample[i], d.unit, back, adjoint[i], d_back);
        else
            surface_gradient(input->sample[i], d.unit, back, adjoint[i], d_back);
    }
    ves_direction_gradient(input, ALONG, &d, d_back, number_adjoint);
}

const ves_measure ves_measure_centroid = {
    .name = "centroid",
    .about = "one component of the centre of gravity, along y unless `along` is given, of the surface or of "
             "the volume (as `volume` has it)",
    .unit = "m",
    .degree = 1,
    .surface = VES_X | VES_NORMAL | VES_AREA,
    .cap = VES_X | VES_XV,
    .closes = closes,
    .keys = KEYS,
    .needs = needs,
    .eval = eval,
    .gradient = gradient};
