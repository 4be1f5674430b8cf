#include <math.h>
#include <string.h>

#include "search/cma.h"

/* When a run is over: the tutorial's B.3, with constants as there, but that the box gives the scale of sigma. Two
 * are ours: FAILED, and HOPELESS, which leaves a lesser basin early. There a run converges linearly: what is
 * still to be gained is about what the last generations gained and still differ by, and when that is a tenth
 * of the distance to the best of an earlier run, the rest of the run is wasted. */

enum { RING = VES_CMA_RING, FAILURES = 10 };

static const double ill = 1e14, beyond = 10;

const char *ves_cma_stop_text(ves_cma_stop stop)
{
    static const char *const text[] = {
#define VES_CMA_STOP_TEXT(name, sentence) sentence,
        VES_CMA_STOP_LIST(VES_CMA_STOP_TEXT)
#undef VES_CMA_STOP_TEXT
    };
    return text[stop];
}

static bool steps_tiny(const ves_cma *cma)
{
    double least = cma->options.tol_x * cma->first_sigma / cma->sigma;
    for (int i = 0; i < cma->n; i++)
        if (sqrt(cma->covariance[i * cma->n + i]) >= least || fabs(cma->path_c[i]) >= least) return false;
    return true;
}

static bool ill_conditioned(const ves_cma *cma)
{
    double low = cma->axis[0], high = low;
    for (int i = 1; i < cma->n; i++) {
        low = fmin(low, cma->axis[i]);
        high = fmax(high, cma->axis[i]);
    }
    return cma->broken || high * high > ill * low * low;
}

/* One axis a generation, in turn. */
static bool axis_lost(const ves_cma *cma)
{
    int k = (int)(cma->age % cma->n);
    double length = 0.1 * cma->sigma * cma->axis[k];
    for (int i = 0; i < cma->n; i++)
        if (cma->mean[i] + length * cma->basis[k * cma->n + i] != cma->mean[i]) return false;
    return true;
}

static bool coordinate_lost(const ves_cma *cma)
{
    for (int i = 0; i < cma->n; i++)
        if (cma->mean[i] + 0.2 * cma->sigma * sqrt(cma->covariance[i * cma->n + i]) == cma->mean[i])
            return true;
    return false;
}

static bool far_beyond(const ves_cma *cma)
{
    double longest = 0;
    for (int i = 0; i < cma->n; i++) longest = fmax(longest, cma->axis[i]);
    return cma->sigma * longest > beyond;
}

/* How many generations it takes to tell a pause from an end. */
static long window_of(const ves_cma *cma)
{
    return 10 + (long)ceil(30. * cma->n / cma->lambda);
}

/* How much the best values of the last `window` generations differ by. */
static double gained(const ves_cma *cma, long window)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (long g = cma->age - window; g < cma->age; g++) {
        low = fmin(low, cma->best[g % RING]);
        high = fmax(high, cma->best[g % RING]);
    }
    return high - low;
}

static bool values_equal(const ves_cma *cma, long window)
{
    double within = cma->options.tol_fun * cma->spread;
    return gained(cma, window) <= within && cma->worst - cma->best[(cma->age - 1) % RING] <= within;
}

static bool hopeless(const ves_cma *cma, long window)
{
    long last = (cma->age - 1) % RING;
    double little = cma->options.hopeless * (cma->least - cma->rival);
    return gained(cma, window) + cma->median[last] - cma->best[last] < little;
}

static void sift(double *heap, int k, int count)
{
    double x = heap[k];
    for (int child; (child = 2 * k + 1) < count; k = child) {
        child += child + 1 < count && heap[child + 1] > heap[child];
        if (heap[child] <= x) break;
        heap[k] = heap[child];
    }
    heap[k] = x;
}

/* The median of ring[from .. from + count - 1], by a heap of which the upper half is taken away. */
static double median(const double *ring, long from, int count, double *heap)
{
    for (int k = 0; k < count; k++) heap[k] = ring[(from + k) % RING];
    for (int k = count / 2 - 1; k >= 0; k--) sift(heap, k, count);
    for (int k = count - 1; k > count / 2; k--) {
        heap[0] = heap[k];
        sift(heap, 0, k);
    }
    return heap[0];
}

/* The latest 30 % of the last fifth of the run against its first 30 %; looked at now and then. */
static bool stagnates(const ves_cma *cma)
{
    long window = 120 + 30 * (long)cma->n / cma->lambda;
    window = cma->age / 5 > window ? cma->age / 5 : window;
    window = window < RING ? window : RING;
    int part = (int)(3 * window / 10);
    if (cma->age < window || cma->age % (part / 3) != 0) return false;
    long first = cma->age - window, last = cma->age - part;
    return median(cma->best, last, part, cma->sorted) >= median(cma->best, first, part, cma->sorted) &&
           median(cma->median, last, part, cma->sorted) >= median(cma->median, first, part, cma->sorted);
}

ves_cma_stop ves_cma_stopped(const ves_cma *cma)
{
    long window = window_of(cma);
    window = window < RING ? window : RING;
    if (cma->failed >= FAILURES) return VES_CMA_FAILED;
    if (cma->age == 0) return VES_CMA_RUNNING;
    if (ill_conditioned(cma)) return VES_CMA_CONDITION;
    if (far_beyond(cma)) return VES_CMA_TOL_UP;
    if (steps_tiny(cma)) return VES_CMA_TOL_X;
    if (axis_lost(cma)) return VES_CMA_NO_AXIS;
    if (coordinate_lost(cma)) return VES_CMA_NO_COORDINATE;
    if (cma->age >= window && values_equal(cma, window)) return VES_CMA_TOL_FUN;
    if (cma->age >= window && hopeless(cma, window)) return VES_CMA_HOPELESS;
    return stagnates(cma) ? VES_CMA_STAGNATION : VES_CMA_RUNNING;
}
