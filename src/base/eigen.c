#include "base/eigen.h"

#include <math.h>

/* Jacobi's rotations, cyclic by rows (Golub and Van Loan, 8.5). Small eigenvalues of scaled matrices come
 * out with small relative errors, which is what the test for a saddle needs.
 * cost  some 6 to 10 sweeps of 4 n^3
 * test  A v = lambda v, V orthogonal, trace */

enum { SWEEPS = 60, FOLLOWED = 6 };

static const double followed = 1e-4; /* an error of the covariance that no sample shows */

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

/* ---- a matrix that has changed a little ---- */

/* m = basis a basis', from the lower triangle of a; full [n][n]. */
static void project(int n, const double *a, const double *basis, double *m, double *product)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) m[i * n + j] = m[j * n + i] = a[i * n + j];
    for (int i = 0; i < n; i++) {
        double *restrict row = &product[i * n];
        for (int j = 0; j < n; j++) row[j] = 0;
        for (int k = 0; k < n; k++)
            for (int j = 0; j < n; j++) row[j] += basis[i * n + k] * m[k * n + j];
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double sum = 0;
#pragma omp simd reduction(+ : sum)
            for (int k = 0; k < n; k++) sum += product[i * n + k] * basis[j * n + k];
            m[i * n + j] = m[j * n + i] = sum;
        }
}

static void turn(int n, double c, double s, double *restrict p, double *restrict q)
{
    for (int k = 0; k < n; k++) {
        double old = p[k];
        p[k] = c * old - s * q[k];
        q[k] = s * old + c * q[k];
    }
}

/* One rotation of rows p, q, as above; the columns are copies of the rows. */
static void follow_rotate(int n, double *m, double *basis, int p, int q)
{
    double pp = m[p * n + p], qq = m[q * n + q], pq = m[p * n + q];
    double theta = (qq - pp) / (2 * pq);
    double t = copysign(1, theta) / (fabs(theta) + sqrt(1 + theta * theta));
    double c = 1 / sqrt(1 + t * t), s = t * c;
    turn(n, c, s, &m[p * n], &m[q * n]);
    m[p * n + p] = pp - t * pq;
    m[q * n + q] = qq + t * pq;
    m[p * n + q] = m[q * n + p] = 0;
    for (int k = 0; k < n; k++) {
        m[k * n + p] = m[p * n + k];
        m[k * n + q] = m[q * n + k];
    }
    turn(n, c, s, &basis[p * n], &basis[q * n]);
}

static int follow_sweep(int n, double *m, double *basis)
{
    int turned = 0;
    for (int p = 0; p < n - 1; p++)
        for (int q = p + 1; q < n; q++) {
            double pq = m[p * n + q];
            if (pq * pq <= followed * followed * fabs(m[p * n + p] * m[q * n + q])) continue;
            follow_rotate(n, m, basis, p, q);
            turned++;
        }
    return turned;
}

void ves_eigen_follow(int n, const double *a, double *basis, double *value, double *scratch)
{
    double *m = scratch;
    project(n, a, basis, m, scratch + n * n);
    for (int k = 0; k < FOLLOWED && follow_sweep(n, m, basis); k++) continue;
    for (int i = 0; i < n; i++) value[i] = m[i * n + i];
}
