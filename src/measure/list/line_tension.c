#include <math.h>

#include "base/arena.h"
#include "base/vector.h"
#include "measure/argument.h"
#include "measure/ring.h"

/* A line tension along a curve, as between two phases of a membrane [Juelicher and Lipowsky 1993]: sigma times its length.
 * The nodes of a curve say all of it, but the root in its length has more modes: it is integrated over more points,
 * where the trapezoid rule converges like exp(-points).
 * test  circle; ellipse by the elliptic integral; scales with s */
enum { CURVE, SIGMA };

enum { POINTS = 64, EACH = 4 }; /* at least so many points in all, and for each node */

static const ves_key KEYS[] = {
    {.name = "curve", .kind = VES_CURVE, .required = true, .about = "along which it pulls"},
    {.name = "sigma", .kind = VES_NUMBER, .unit = "kg m/s^2", .fallback = 1, .about = "energy per length"},
    {.name = NULL}};

static int points_of(const ves_samples *s)
{
    int least = EACH * s->count;
    return least > POINTS ? least : POINTS;
}

/* [points][nodes]: what each node counts at each point. */
static ves_status prepare(const ves_measure_input *input, void **state)
{
    const ves_samples *s = ves_sample_of(input, CURVE);
    const int points = points_of(s);
    const size_t nodes = (size_t)s->count;
    double *weight = ves_memory_take(((size_t)points + 3) * nodes * sizeof *weight);
    if (!weight) return VES_MEMORY;
    double *scratch = weight + (size_t)points * nodes;
    for (int k = 0; k < points; k++) {
        double at = (double)k / points * s->count;
        int node = (int)floor(at);
        ves_ring_weights(s, ves_ring_near(s, (ves_ring_point){node, (at - node) * VES_TWO_PI / s->count}),
                         scratch);
        for (size_t j = 0; j < nodes; j++) weight[(size_t)k * nodes + j] = scratch[j];
    }
    *state = weight;
    return VES_OK;
}

static void release(void *state)
{
    ves_memory_free(state);
}

/* |Xv| at a point; its direction. */
static double speed(const ves_samples *s, const double *weight, double along[3])
{
    for (int c = 0; c < 3; c++) {
        along[c] = 0;
        for (int j = 0; j < s->count; j++) along[c] += weight[j] * s->Xv[c][j];
    }
    double length = sqrt(ves_dot(along, along));
    for (int c = 0; c < 3 && length > 0; c++) along[c] /= length;
    return length;
}

static double length_of(const ves_measure_input *input)
{
    const ves_samples *s = ves_sample_of(input, CURVE);
    const int points = points_of(s);
    const double *weight = input->state;
    double sum = 0, along[3];
    for (int k = 0; k < points; k++, weight += s->count) sum += speed(s, weight, along);
    return sum * VES_TWO_PI / points;
}

static ves_status eval(const ves_measure_input *input, double *value)
{
    *value = ves_argument_number(input, SIGMA) * length_of(input);
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    const ves_samples *s = ves_sample_of(input, CURVE);
    const ves_adjoint *g = adjoint[ves_sample_index(input, CURVE)];
    const int points = points_of(s);
    const double *weight = input->state;
    const double each = seed * ves_argument_number(input, SIGMA) * VES_TWO_PI / points;
    double along[3];
    ves_argument_scatter(input, SIGMA, 0, seed * length_of(input), number_adjoint);
    for (int k = 0; k < points && g->Xv[0]; k++, weight += s->count) {
        speed(s, weight, along);
        for (int c = 0; c < 3; c++)
            for (int j = 0; j < s->count; j++) g->Xv[c][j] += each * weight[j] * along[c];
    }
}

const ves_measure ves_measure_line_tension = {.name = "line_tension",
                                              .about = "sigma times the length of a curve",
                                              .unit = "kg m^2/s^2",
                                              .degree = VES_NO_DEGREE,
                                              .curve = VES_XV,
                                              .keys = KEYS,
                                              .prepare = prepare,
                                              .release = release,
                                              .eval = eval,
                                              .gradient = gradient};
