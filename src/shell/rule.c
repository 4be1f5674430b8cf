#include "shell/rule.h"

#include <math.h>

#include "base/vector.h"
#include "surface/grid.h"

/* P_n and its derivative, by the recurrence. */
static double legendre(int n, double x, double *slope)
{
    double before = 1, p = x;
    for (int k = 2; k <= n; k++) {
        double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p, p = next;
    }
    *slope = n * (x * p - before) / (x * x - 1);
    return p;
}

/* The zeros of P'_order and the ends; Newton, with (1 - x^2) P'' = 2 x P' - n (n + 1) P. */
void ves_rule_nodes(int order, double *node)
{
    for (int k = 0; k <= order; k++) {
        double x = order < 3 ? 2.0 * k / order - 1 : -cos(VES_PI * k / order);
        for (int step = 0; order > 2 && k > 0 && k < order && step < 20; step++) {
            double slope, p = legendre(order, x, &slope);
            x -= slope * (1 - x * x) / (2 * x * slope - order * (order + 1) * p);
        }
        node[k] = 2 * k == order ? 0 : x;
    }
}

void ves_rule_lagrange(int count, const double *node, double x, double *value, double *slope)
{
    for (int k = 0; k < count; k++) {
        double product = 1, sum = 0;
        for (int i = 0; i < count; i++) {
            if (i == k) continue;
            double gap = node[k] - node[i];
            sum = (sum * (x - node[i]) + product) / gap;
            product *= (x - node[i]) / gap;
        }
        value[k] = product, slope[k] = sum;
    }
}

void ves_rule_gauss(int count, double *node, double *weight)
{
    ves_gauss_nodes(count, node, weight);
    for (int k = 0; k < count; k++) node[k] = 2 * node[k] - 1, weight[k] *= 2;
}
