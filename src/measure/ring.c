#include "measure/ring.h"

#include <math.h>

#include "base/vector.h"

ves_ring_point ves_ring_near(const ves_samples *s, ves_ring_point p)
{
    if (s->count == 1) return (ves_ring_point){0, 0};
    double spacing = VES_TWO_PI / s->count, nodes = round(p.t / spacing);
    int node = (p.node + (int)nodes) % s->count;
    return (ves_ring_point){node < 0 ? node + s->count : node, p.t - nodes * spacing};
}

/* With h = x / 2 a weight is W = sin(nh) D(h) / n, D = cot h or 1 / sin h. */
void ves_ring_weights(const ves_samples *s, ves_ring_point p, double *weight)
{
    int n = s->count;
    bool odd = n % 2;
    double *slope = weight + n, *bend = slope + n, bend0 = -(n * (double)n + (odd ? -1 : 2)) / 12;
    for (int j = 0; j < n; j++) {
        int off = p.node - j, sign = off % 2 ? -1 : 1;
        double h = (p.t + off * VES_TWO_PI / n) / 2, sn = sin(h), cs = cos(h);
        double S = sign * sin(n * p.t / 2), C = sign * cos(n * p.t / 2);
        double D = (odd ? 1 : cs) / sn, D1 = -(odd ? cs : 1) / (sn * sn);
        double D2 = (odd ? 1 + cs * cs : 2 * cs) / (sn * sn * sn);
        weight[j] = h == 0 ? 1 : S * D / n;
        slope[j] = (C * D + S * D1 / n) / 2;
        bend[j] = (2 * C * D1 - n * S * D + S * D2 / n) / 4;
        if (fabs(n * h) < 1e-3) /* which would cancel: right to its square */
            slope[j] = bend0 * 2 * h, bend[j] = bend0;
    }
}
