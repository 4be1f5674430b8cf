#include "surface/elements.h"

#include <math.h>

#include "base/vector.h"

/* Node (i, j) with j running on past the seam of a periodic patch, and a pole as its first node. */
static int node_at(const ves_figure_patch *patch, int i, int j)
{
    bool pole = (i == 0 && patch->pole[0]) || (i == patch->nu && patch->pole[1]);
    return i * patch->columns + (pole ? 0 : j % patch->columns);
}

int ves_element_nodes(const ves_figure_patch *patch, int i, int j, int node[VES_ELEMENT_NODES])
{
    static const int all[VES_ELEMENT_NODES][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2},
                                                  {1, 0}, {2, 1}, {1, 2}, {0, 1}},
                     low[VES_TRIANGLE_NODES][2] = {{0, 0}, {2, 0}, {2, 2}, {1, 0}, {2, 1}, {1, 2}},
                     high[VES_TRIANGLE_NODES][2] = {{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 2}, {0, 1}};
    bool first = i == 0 && patch->pole[0], last = i + 2 == patch->nu && patch->pole[1];
    const int(*at)[2] = first ? low : last ? high : all;
    int count = first || last ? VES_TRIANGLE_NODES : VES_ELEMENT_NODES, corners = count / 2;
    for (int k = 0; k < count; k++) {
        int turned = k < corners ? corners - 1 - k : corners + (count - 2 - k + corners) % corners;
        const int *step = at[patch->side < 0 ? turned : k];
        node[k] = node_at(patch, i + step[0], j + step[1]);
    }
    return count;
}

static void quadrilateral(double r, double s, double N[], double by_r[], double by_s[])
{
    static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int k = 0; k < 4; k++) {
        double a = corner[k][0], b = corner[k][1];
        N[k] = (1 + a * r) * (1 + b * s) * (a * r + b * s - 1) / 4;
        by_r[k] = a * (1 + b * s) * (2 * a * r + b * s) / 4;
        by_s[k] = b * (1 + a * r) * (a * r + 2 * b * s) / 4;
    }
    for (int k = 0; k < 2; k++) {
        double b = k ? 1 : -1, a = k ? -1 : 1; /* of the middles 4, 6 at s = -1, 1, and 5, 7 at r = 1, -1 */
        N[4 + 2 * k] = (1 - r * r) * (1 + b * s) / 2;
        by_r[4 + 2 * k] = -r * (1 + b * s), by_s[4 + 2 * k] = b * (1 - r * r) / 2;
        N[5 + 2 * k] = (1 + a * r) * (1 - s * s) / 2;
        by_r[5 + 2 * k] = a * (1 - s * s) / 2, by_s[5 + 2 * k] = -s * (1 + a * r);
    }
}

static void triangle(double r, double s, double N[], double by_r[], double by_s[])
{
    const double at[3] = {1 - r - s, r, s}, dr[3] = {-1, 1, 0}, ds[3] = {-1, 0, 1};
    for (int k = 0; k < 3; k++) {
        int n = (k + 1) % 3;
        N[k] = at[k] * (2 * at[k] - 1);
        by_r[k] = dr[k] * (4 * at[k] - 1), by_s[k] = ds[k] * (4 * at[k] - 1);
        N[3 + k] = 4 * at[k] * at[n];
        by_r[3 + k] = 4 * (dr[k] * at[n] + at[k] * dr[n]), by_s[3 + k] = 4 * (ds[k] * at[n] + at[k] * ds[n]);
    }
}

void ves_element_shape(int nodes, double r, double s, double N[], double by_r[], double by_s[])
{
    (nodes == VES_TRIANGLE_NODES ? triangle : quadrilateral)(r, s, N, by_r, by_s);
}

/* Weights and places of both rules integrate polynomials of degree 5 exactly; that of the triangle is
 * Radon's. */
enum { POINTS_MOST = 9 };

static int rule(int nodes, double place[POINTS_MOST][2], double weight[POINTS_MOST])
{
    if (nodes == VES_ELEMENT_NODES) {
        const double at[3] = {-sqrt(.6), 0, sqrt(.6)}, w[3] = {5. / 9, 8. / 9, 5. / 9};
        for (int k = 0; k < 9; k++)
            place[k][0] = at[k / 3], place[k][1] = at[k % 3], weight[k] = w[k / 3] * w[k % 3];
        return 9;
    }
    place[0][0] = place[0][1] = 1. / 3, weight[0] = 9. / 80;
    for (int k = 0; k < 6; k++) {
        double sign = k < 3 ? 1 : -1, near = (6 + sign * sqrt(15)) / 21;
        place[1 + k][0] = k % 3 == 0 ? 1 - 2 * near : near;
        place[1 + k][1] = k % 3 == 1 ? 1 - 2 * near : near;
        weight[1 + k] = (155 + sign * sqrt(15)) / 2400;
    }
    return 7;
}

static double sum_of(int count, const int *node, const double *plane, const double *factor)
{
    double sum = 0;
    for (int k = 0; k < count; k++) sum += factor[k] * plane[node[k]];
    return sum;
}

void ves_element_area(const ves_figure_patch *patch, int count, const int *node, double *const q[3],
                      const double *pressure, double *const force[3])
{
    double place[POINTS_MOST][2], weight[POINTS_MOST];
    int points = rule(count, place, weight);
    for (int g = 0; g < points; g++) {
        double N[VES_ELEMENT_NODES], by_r[VES_ELEMENT_NODES], by_s[VES_ELEMENT_NODES], Xr[3], Xs[3], n[3];
        ves_element_shape(count, place[g][0], place[g][1], N, by_r, by_s);
        for (int c = 0; c < 3; c++)
            Xr[c] = sum_of(count, node, patch->X[c], by_r), Xs[c] = sum_of(count, node, patch->X[c], by_s);
        ves_cross(Xr, Xs, n);
        double area = sqrt(ves_dot(n, n)), p = pressure ? sum_of(count, node, pressure, N) : 0;
        for (int c = 0; c < 3; c++) {
            double f = weight[g] * (p * n[c] + (q ? area * sum_of(count, node, q[c], N) : 0));
            for (int k = 0; k < count; k++) force[c][node[k]] += f * N[k];
        }
    }
}

void ves_element_line(const ves_figure_patch *patch, const int node[3], double *const q[3],
                      double *const force[3])
{
    const double at[3] = {-sqrt(.6), 0, sqrt(.6)}, weight[3] = {5. / 9, 8. / 9, 5. / 9};
    for (int g = 0; g < 3; g++) {
        double r = at[g], N[3] = {r * (r - 1) / 2, 1 - r * r, r * (r + 1) / 2};
        const double slope[3] = {r - .5, -2 * r, r + .5};
        double X[3];
        for (int c = 0; c < 3; c++) X[c] = sum_of(3, node, patch->X[c], slope);
        double length = weight[g] * sqrt(ves_dot(X, X));
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                force[c][node[k]] += length * N[k] * (q ? sum_of(3, node, q[c], N) : 1);
    }
}

int ves_figure_edge(const ves_figure_patch *patch, int edge, int *node)
{
    int count = 1 + (edge < 2 ? patch->nv : patch->nu);
    for (int k = 0; node && k < count; k++)
        node[k] =
            edge < 2 ? node_at(patch, edge * patch->nu, k) : node_at(patch, k, edge == 3 ? patch->nv : 0);
    return count;
}
