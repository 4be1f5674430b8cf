/* f = 4 sum_{i<j} r^-12 - r^-6 over pairs of atoms; x holds three coordinates of each. Least energies to six
 * digits, as the Cambridge Cluster Database lists them [Wales and Doye 1997]. */
#include <math.h>

#include "suite/landscape.h"

static const double energy[] = {-1,         -3,         -6,         -9.103852,  -12.712062,
                                -16.505384, -19.821489, -24.113360, -28.422532, -32.765970,
                                -37.967600, -44.326801, -47.845157, -52.322627, -56.815742,
                                -61.317995, -66.530949, -72.659782, -77.177043};

enum { ATOMS = 1 + (int)(sizeof energy / sizeof *energy) };

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = NAN;
    return energy[n / 3 - 2];
}

static double pair(const double *a, const double *b, double *pull)
{
    double square = 0;
    for (int c = 0; c < 3; c++) square += (a[c] - b[c]) * (a[c] - b[c]);
    double r6 = 1 / (square * square * square);
    *pull = (24 * r6 - 48 * r6 * r6) / square; /* times a - b: the gradient at a */
    return 4 * (r6 * r6 - r6);
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; slopes && i < n; i++) out->gradient[i] = 0;
    for (int i = 0; i < n; i += 3)
        for (int j = 0; j < i; j += 3) {
            double pull;
            out->value += pair(x + i, x + j, &pull);
            for (int c = 0; slopes && c < 3; c++) {
                out->gradient[i + c] += pull * (x[i + c] - x[j + c]);
                out->gradient[j + c] -= pull * (x[i + c] - x[j + c]);
            }
        }
    return isfinite(out->value) ? VES_OK : VES_NO_NUMBER;
}

const ves_landscape ves_landscape_lennard_jones = {
    .name = "lennard_jones",
    .about = "energy of a cluster of n/3 atoms, up to 20",
    .least = 6,
    .most = 3 * ATOMS,
    .step = 3,
    .lower = -2,
    .upper = 2,
    .optimum = optimum,
    .eval = eval,
};
