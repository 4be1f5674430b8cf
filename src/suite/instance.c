#include "suite/instance.h"

#include <math.h>
#include <string.h>

#include "base/random.h"

/* Steps of the random numbers: what they are for. */
enum { STEP_HOME, STEP_TURN, STEP_START };

static const double margin = 0.1; /* of the box, on each side, where no optimum is put */

uint64_t ves_instance_hash(const char *text, uint64_t more)
{
    uint64_t hash = 0xcbf29ce484222325;
    for (; *text; text++) hash = (hash ^ (unsigned char)*text) * 0x100000001b3;
    for (int k = 0; k < 8; k++) hash = (hash ^ (more >> 8 * k & 255)) * 0x100000001b3;
    return hash;
}

static double *home_of(ves_arena *arena, const ves_instance *it, ves_random random)
{
    double *home = ves_arena_take(arena, (size_t)it->n, sizeof *home);
    random.step = STEP_HOME;
    for (int i = 0; home && i < it->n; i++)
        home[i] = it->lower[i] + it->width[i] * (margin + (1 - 2 * margin) * ves_random_uniform(&random));
    return home;
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Gram and Schmidt on normal numbers, each row twice: orthogonal to rounding, and distributed as Haar's
 * measure. */
static double *turn_of(ves_arena *arena, int n, ves_random random)
{
    double *turn = ves_arena_take(arena, (size_t)n * (size_t)n, sizeof *turn);
    random.step = STEP_TURN;
    for (int i = 0; turn && i < n; i++) {
        double *row = turn + (size_t)i * n;
        for (int k = 0; k < n; k++) row[k] = ves_random_normal(&random);
        for (int pass = 0; pass < 2; pass++) {
            for (int j = 0; j < i; j++) {
                const double *other = turn + (size_t)j * n;
                double part = dot(n, row, other);
                for (int k = 0; k < n; k++) row[k] -= part * other[k];
            }
            double length = sqrt(dot(n, row, row));
            for (int k = 0; k < n; k++) row[k] /= length;
        }
    }
    return turn;
}

ves_status ves_instance_init(ves_arena *arena, const ves_landscape *landscape, int n, bool turned,
                             uint64_t seed, int number, ves_instance *instance)
{
    if (!ves_landscape_takes(landscape, n) || (turned && !landscape->free) || number < 0) return VES_RANGE;
    int m = landscape->inequalities + landscape->equalities;
    *instance = (ves_instance){.landscape = landscape, .n = n, .m = m};
    double *lower = ves_arena_take(arena, (size_t)n, sizeof *lower);
    double *width = ves_arena_take(arena, (size_t)n, sizeof *width);
    double *place = ves_arena_take(arena, (size_t)n, sizeof *place);
    bool *equality = ves_arena_take(arena, (size_t)m, sizeof *equality);
    if (!lower || !width || !place || !equality) return VES_MEMORY;
    for (int i = 0; i < n; i++) {
        double low = landscape->bounds ? landscape->bounds[i][0] : landscape->lower;
        lower[i] = low;
        width[i] = (landscape->bounds ? landscape->bounds[i][1] : landscape->upper) - low;
    }
    for (int j = 0; j < m; j++) equality[j] = j >= landscape->inequalities;
    instance->optimum = landscape->optimum(n, place);
    instance->lower = lower, instance->width = width, instance->place = place, instance->equality = equality;
    if (!landscape->free) return VES_OK;
    uint64_t which = (uint64_t)n + ((seed - 1) << 8); /* n < 256 */
    ves_random random = {.seed = ves_instance_hash(landscape->name, which), .chain = (uint32_t)number};
    instance->home = home_of(arena, instance, random);
    if (turned) instance->turn = turn_of(arena, n, random);
    return instance->home && (instance->turn || !turned) ? VES_OK : VES_MEMORY;
}

/* z = place + Q (x - home). */
static void inward(const ves_instance *it, const double *x, double *z)
{
    int n = it->n;
    if (!it->home) {
        memcpy(z, x, (size_t)n * sizeof *z);
        return;
    }
    for (int i = 0; i < n; i++) {
        z[i] = it->place[i];
        if (!it->turn) z[i] += x[i] - it->home[i];
        for (int k = 0; it->turn && k < n; k++) z[i] += it->turn[(size_t)i * n + k] * (x[k] - it->home[k]);
    }
}

/* A slope by z becomes one by u: width * Q^T slope. */
static void outward(const ves_instance *it, double *slope, double *room)
{
    int n = it->n;
    for (int k = 0; k < n; k++) {
        double sum = it->turn ? 0 : slope[k];
        for (int i = 0; it->turn && i < n; i++) sum += it->turn[(size_t)i * n + k] * slope[i];
        room[k] = it->width[k] * sum;
    }
    memcpy(slope, room, (size_t)n * sizeof *slope);
}

ves_status ves_instance_eval(const ves_instance *instance, const double *u, bool slopes, ves_verdict *out,
                             double *room)
{
    int n = instance->n;
    double *x = room, *z = room + n;
    for (int i = 0; i < n; i++) x[i] = instance->lower[i] + instance->width[i] * u[i];
    inward(instance, x, z);
    VES_TRY(instance->landscape->eval(n, z, slopes, out));
    if (!slopes) return VES_OK;
    outward(instance, out->gradient, room);
    for (int j = 0; j < instance->m; j++) outward(instance, out->jacobian + (size_t)j * n, room);
    return VES_OK;
}

bool ves_instance_best(const ves_instance *instance, double *u)
{
    const double *x = instance->home ? instance->home : instance->place;
    for (int i = 0; i < instance->n; i++) {
        u[i] = (x[i] - instance->lower[i]) / instance->width[i];
        if (isnan(instance->place[i])) return false;
    }
    return true;
}

void ves_instance_start(uint64_t seed, int which, int n, double *u)
{
    ves_random random = {.seed = seed, .chain = (uint32_t)which, .step = STEP_START};
    for (int i = 0; i < n; i++) u[i] = ves_random_uniform(&random);
}
