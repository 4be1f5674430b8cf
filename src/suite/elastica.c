#include "suite/elastica.h"

#include <math.h>

#include "base/vector.h"

enum { H = VES_ELASTICA_HALF, NODES = 96 };

/* Harmonic k may turn the tangent as much as any other: |a_k| <= 1/(2k). */
const double ves_elastica_bounds[VES_ELASTICA][2] = {
    {0.2, 2}, {-1.0 / 4, 1.0 / 4}, {-1.0 / 6, 1.0 / 6}, {-1.0 / 8, 1.0 / 8},
    {0.2, 2}, {-1.0 / 4, 1.0 / 4}, {-1.0 / 6, 1.0 / 6}, {-1.0 / 8, 1.0 / 8}};
const double ves_elastica_place[VES_ELASTICA] = {
    0.53297033532209892, -0.090375965449949303, -0.096455887923515116, 0.0340983459921331,
    1.2134234740013734,  -0.16983419930919769,  -0.069254809791970712, 0.018646961659202266};
const double ves_elastica_least = 12.48630004910537;
const double ves_elastica_reduced = 0.7;

double ves_elastica_optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = ves_elastica_place[i];
    return ves_elastica_least;
}

/* One node: harmonics, and the curve with its derivatives by t. */
typedef struct node {
    double cosine[H], sine[H]; /* of k t */
    double x, y, x1, y1, x2, y2;
} node;

static void node_at(const double *p, int index, node *q)
{
    double t = VES_TWO_PI * index / NODES, c = cos(t), s = sin(t), ck = 1, sk = 0;
    q->x = q->y = q->x1 = q->y1 = q->x2 = q->y2 = 0;
    for (int k = 0; k < H; k++) {
        double next = ck * c - sk * s, n = k + 1, a = p[k], b = p[H + k];
        sk = sk * c + ck * s;
        ck = next;
        q->cosine[k] = ck, q->sine[k] = sk;
        q->x += a * ck, q->y += b * sk;
        q->x1 -= n * a * sk, q->y1 += n * b * ck;
        q->x2 -= n * n * a * ck, q->y2 -= n * n * b * sk;
    }
}

/* kappa^2 ds = cross^2 / s^5 dt; the adjoints of x1, y1, x2, y2 go to the amplitudes. */
static void add_slopes(const node *q, double s, double cross, ves_elastica *out)
{
    double s5 = 1 / (s * s * s * s * s), two = 2 * cross * s5, five = 5 * cross * cross * s5 / (s * s);
    double to_x1 = two * q->y2 - five * q->x1, to_y1 = -two * q->x2 - five * q->y1;
    double to_x2 = -two * q->y1, to_y2 = two * q->x1;
    for (int k = 0; k < H; k++) {
        double n = k + 1, c = q->cosine[k], r = q->sine[k];
        out->bending_slope[k] += -n * r * to_x1 - n * n * c * to_x2;
        out->bending_slope[H + k] += n * c * to_y1 - n * n * r * to_y2;
        out->length_slope[k] -= n * r * q->x1 / s;
        out->length_slope[H + k] += n * c * q->y1 / s;
        out->area_slope[k] += (c * q->y1 + q->y * n * r) / 2;
        out->area_slope[H + k] += (q->x * n * c - r * q->x1) / 2;
    }
}

/* A cusp between two nodes, where the tangent turns back, would bend for nothing: rings with half of the least
 * energy could be had that way. cos 0.5; the best ring turns by 0.16 from node to node. */
static const double least_cosine = 0.8775825618903728;

bool ves_elastica_measure(const double *p, bool slopes, ves_elastica *out)
{
    const double h = VES_TWO_PI / NODES;
    node before;
    *out = (ves_elastica){.resolved = true};
    node_at(p, NODES - 1, &before);
    for (int i = 0; i < NODES; i++) {
        node q;
        node_at(p, i, &q);
        double s = hypot(q.x1, q.y1), cross = q.x1 * q.y2 - q.y1 * q.x2;
        if (!(s > 1e-6)) return false;
        if (!(q.x1 * before.x1 + q.y1 * before.y1 >= least_cosine * s * hypot(before.x1, before.y1)))
            out->resolved = false;
        before = q;
        out->bending += cross * cross / (s * s * s * s * s);
        out->length += s;
        out->area += (q.x * q.y1 - q.y * q.x1) / 2;
        if (slopes) add_slopes(&q, s, cross, out);
    }
    out->bending *= h, out->length *= h, out->area *= h;
    for (int k = 0; slopes && k < VES_ELASTICA; k++)
        out->bending_slope[k] *= h, out->length_slope[k] *= h, out->area_slope[k] *= h;
    return true;
}

double ves_elastica_shape(const ves_elastica *e, double *slope)
{
    double shape = 2 * VES_TWO_PI * e->area / (e->length * e->length);
    for (int k = 0; slope && k < VES_ELASTICA; k++)
        slope[k] = 2 * VES_TWO_PI * e->area_slope[k] / (e->length * e->length) -
                   2 * shape * e->length_slope[k] / e->length;
    return shape;
}

double ves_elastica_energy(const ves_elastica *e, double *slope)
{
    for (int k = 0; slope && k < VES_ELASTICA; k++)
        slope[k] = (e->bending_slope[k] * e->length + e->bending * e->length_slope[k]) / VES_TWO_PI;
    return e->bending * e->length / VES_TWO_PI;
}
