#include "search/eigen.h"

#include <math.h>

/* Jacobi's rotations, cyclic by rows (Golub and Van Loan, 8.5). Small eigenvalues of scaled matrices come
 * out with small relative errors, which is what the test for a saddle needs.
 * cost  some 6 to 10 sweeps of 4 n^3
 * test  A v = lambda v, V orthogonal, trace */

enum { SWEEPS = 60 };

static void rotate(int n, double *a, double *vector, int p, int q)
{
    double apq = a[p * n + q];
    double theta = (a[q * n + q] - a[p * n + p]) / (2 * apq);
    double t = copysign(1, theta) / (fabs(theta) + sqrt(1 + theta * theta));
    double c = 1 / sqrt(1 + t * t), s = t * c;
    for (int k = 0; k < n; k++) {
        double kp = a[k * n + p], kq = a[k * n + q];
        a[k * n + p] = c * kp - s * kq;
        a[k * n + q] = s * kp + c * kq;
    }
    for (int k = 0; k < n; k++) {
        double pk = a[p * n + k], qk = a[q * n + k];
        a[p * n + k] = c * pk - s * qk;
        a[q * n + k] = s * pk + c * qk;
    }
    for (int k = 0; k < n; k++) {
        double kp = vector[k * n + p], kq = vector[k * n + q];
        vector[k * n + p] = c * kp - s * kq;
        vector[k * n + q] = s * kp + c * kq;
    }
}

static int sweep(int n, double *a, double *vector)
{
    int turned = 0;
    for (int p = 0; p < n - 1; p++)
        for (int q = p + 1; q < n; q++) {
            double small = 1e-18 * (fabs(a[p * n + p]) + fabs(a[q * n + q]));
            if (fabs(a[p * n + q]) <= small) continue;
            rotate(n, a, vector, p, q);
            turned++;
        }
    return turned;
}

void ves_eigen_symmetric(int n, double *a, double *value, double *vector)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) vector[i * n + j] = i == j;
    for (int k = 0; k < SWEEPS && sweep(n, a, vector); k++) continue;
    for (int i = 0; i < n; i++) value[i] = a[i * n + i];
}
