#include "base/basis.h"

#include <math.h>

double ves_basis_size(int n, const double *row)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += row[i] * row[i];
    return sqrt(sum);
}

double ves_basis_strip(int n, int wide, const double *unit, double *row)
{
    double along = 0;
    for (int i = 0; i < n; i++) along += row[i] * unit[i];
    for (int i = 0; i < wide; i++) row[i] -= along * unit[i];
    return along;
}

double ves_basis_strip_all(int n, const double *unit, int count, double *row, double *along)
{
    for (int k = 0; along && k < count; k++) along[k] = 0;
    for (int k = 0; k < 2 * count; k++) {
        double by = ves_basis_strip(n, n, unit + (long)(k % count) * n, row);
        if (along) along[k % count] += by;
    }
    return ves_basis_size(n, row);
}
