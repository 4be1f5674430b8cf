#include "plain/textbook.h"

#include <math.h>

/* d-th derivative of the four functions of eq 4.13 at u: e^{lu}, u e^{lu}, e^{-lu}, u e^{-lu}. */
static void basis(double l, double u, double f[3][4])
{
    double p = exp(l * u), m = exp(-l * u);
    f[0][0] = p, f[0][1] = u * p, f[0][2] = m, f[0][3] = u * m;
    f[1][0] = l * p, f[1][1] = (1 + l * u) * p, f[1][2] = -l * m, f[1][3] = (1 - l * u) * m;
    f[2][0] = l * l * p, f[2][1] = (2 * l + l * l * u) * p, f[2][2] = l * l * m,
    f[2][3] = (-2 * l + l * l * u) * m;
}

static void cubic(double u, double f[3][4])
{
    const double value[3][4] = {{1, u, u * u, u * u * u}, {0, 1, 2 * u, 3 * u * u}, {0, 0, 2, 6 * u}};
    for (int d = 0; d < 3; d++)
        for (int k = 0; k < 4; k++) f[d][k] = value[d][k];
}

static void eliminate(double a[4][5])
{
    for (int p = 0; p < 4; p++) {
        int best = p;
        for (int r = p + 1; r < 4; r++)
            if (fabs(a[r][p]) > fabs(a[best][p])) best = r;
        for (int c = 0; c < 5; c++) {
            double swap = a[p][c];
            a[p][c] = a[best][c], a[best][c] = swap;
        }
        for (int r = 0; r < 4; r++) {
            double f = r == p ? 0 : a[r][p] / a[p][p];
            for (int c = p; c < 5 && r != p; c++) a[r][c] -= f * a[p][c];
        }
    }
    for (int p = 0; p < 4; p++) a[p][4] /= a[p][p];
}

static void solve(double l, const double value[4], double out[4])
{
    double a[4][5];
    for (int j = 0; j < 4; j++) {
        double f[3][4];
        if (l > 0)
            basis(l, j / 2, f);
        else
            cubic(j / 2, f);
        for (int k = 0; k < 4; k++) a[j][k] = f[j % 2][k];
        a[j][4] = value[j];
    }
    eliminate(a);
    for (int k = 0; k < 4; k++) out[k] = a[k][4];
}

void textbook_solve(textbook *book, double a, const double *data[4])
{
    enum { STRIDE = 1 + 2 * TEXTBOOK_MODES };
    book->a = a;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < STRIDE; k++) {
            int n = (k + 1) / 2;
            double value[4];
            for (int j = 0; j < 4; j++) value[j] = data[j][c * STRIDE + k];
            solve(a * n, value,
                  n == 0  ? book->zero[c]
                  : k % 2 ? book->cosine[n - 1][c]
                          : book->sine[n - 1][c]);
        }
}

/* X and its derivatives at one node: out[du][dv][c] in the order X, Xu, Xv, Xuu, Xuv, Xvv. */
static void point(const textbook *book, double u, double v, double out[6][3])
{
    double f[3][4];
    cubic(u, f);
    for (int c = 0; c < 3; c++) {
        double A[3] = {0};
        for (int d = 0; d < 3; d++)
            for (int k = 0; k < 4; k++) A[d] += f[d][k] * book->zero[c][k];
        out[0][c] = A[0], out[1][c] = A[1], out[2][c] = 0, out[3][c] = A[2], out[4][c] = 0, out[5][c] = 0;
    }
    for (int n = 1; n <= TEXTBOOK_MODES; n++) {
        double co = cos(n * v), si = sin(n * v);
        basis(book->a * n, u, f);
        for (int c = 0; c < 3; c++) {
            double A[3] = {0}, B[3] = {0};
            for (int d = 0; d < 3; d++)
                for (int k = 0; k < 4; k++)
                    A[d] += f[d][k] * book->cosine[n - 1][c][k], B[d] += f[d][k] * book->sine[n - 1][c][k];
            out[0][c] += A[0] * co + B[0] * si;
            out[1][c] += A[1] * co + B[1] * si;
            out[2][c] += n * (B[0] * co - A[0] * si);
            out[3][c] += A[2] * co + B[2] * si;
            out[4][c] += n * (B[1] * co - A[1] * si);
            out[5][c] -= n * n * (A[0] * co + B[0] * si);
        }
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void textbook_measure(const textbook *book, int nu, const double *u, const double *w, int nv, double out[3])
{
    const double two_pi = 6.283185307179586;
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < nu; i++)
        for (int j = 0; j < nv; j++) {
            double X[6][3], n[3];
            point(book, u[i], two_pi * (j + 0.5) / nv, X);
            for (int c = 0; c < 3; c++) {
                int a = (c + 1) % 3, b = (c + 2) % 3;
                n[c] = X[1][a] * X[2][b] - X[1][b] * X[2][a];
            }
            double J = sqrt(dot(n, n)), E = dot(X[1], X[1]), F = dot(X[1], X[2]), G = dot(X[2], X[2]);
            double L = dot(n, X[3]) / J, M = dot(n, X[4]) / J, N = dot(n, X[5]) / J,
                   weight = w[i] * two_pi / nv;
            double H = (E * N - 2 * F * M + G * L) / (2 * J * J), K = (L * N - M * M) / (J * J);
            out[0] += J * weight;
            out[1] += dot(X[0], n) / 3 * weight;
            out[2] += (4 * H * H - 2 * K) * J * weight;
        }
}
