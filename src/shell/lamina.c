#include "shell/lamina.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

static bool unit(double a[3])
{
    double length = sqrt(ves_dot(a, a));
    for (int c = 0; c < 3; c++) a[c] /= length;
    return length > 0 && isfinite(length);
}

/* g_1 = X_r + z V_r, g_2 = X_s + z V_s, g_3 = V. Strain components in the frame e_k are sums of a_ki a_lj e_ij with
 * a_ki = e_k . g^i; g^3 is along e_3, so a_13 = a_23 = 0, and e_33 = 0. */
bool ves_lamina_at(const ves_shell_frame *f, double z, ves_lamina *lamina)
{
    double g[3][3], dual[3][3], a[3][3];
    for (int c = 0; c < 3; c++)
        g[0][c] = f->Xr[c] + z * f->Vr[c], g[1][c] = f->Xs[c] + z * f->Vs[c], g[2][c] = f->V[c];
    for (int i = 0; i < 3; i++) ves_cross(g[(i + 1) % 3], g[(i + 2) % 3], dual[i]);
    double volume = ves_dot(g[2], dual[2]);
    lamina->volume = volume;
    if (!(volume > 0)) return false;
    memcpy(lamina->e[0], g[0], sizeof g[0]);
    memcpy(lamina->e[2], dual[2], sizeof dual[2]);
    if (!unit(lamina->e[0]) || !unit(lamina->e[2])) return false;
    ves_cross(lamina->e[2], lamina->e[0], lamina->e[1]);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) a[k][i] = ves_dot(lamina->e[k], dual[i]) / volume;
    static const int K[VES_STRESSES] = {0, 1, 0, 0, 1}, L[VES_STRESSES] = {0, 1, 1, 2, 2};
    for (int out = 0; out < VES_STRESSES; out++)
        for (int in = 0; in < VES_STRESSES; in++) {
            int k = K[out], l = L[out], i = K[in], j = L[in];
            double t = i == j ? a[k][i] * a[l][i] : (a[k][i] * a[l][j] + a[k][j] * a[l][i]) / 2;
            lamina->T[out][in] = out > 1 ? 2 * t : t;
        }
    return true;
}

void ves_lamina_stress(const ves_shell_material *m, const double e[VES_STRESSES], double s[VES_STRESSES])
{
    double plane = m->E / (1 - m->nu * m->nu), G = m->E / (2 * (1 + m->nu));
    s[0] = plane * (e[0] + m->nu * e[1]);
    s[1] = plane * (e[1] + m->nu * e[0]);
    s[2] = G * e[2];
    s[3] = m->shear * G * e[3];
    s[4] = m->shear * G * e[4];
}

/* The square root of the law: rows R with R' R = C. */
static void root(const ves_shell_material *m, double scale, double R[VES_STRESSES][VES_STRESSES])
{
    double plane = scale * m->E / (1 - m->nu * m->nu), G = scale * m->E / (2 * (1 + m->nu));
    memset(R, 0, VES_STRESSES * sizeof R[0]);
    R[0][0] = sqrt(plane), R[0][1] = m->nu * R[0][0];
    R[1][1] = sqrt(plane * (1 - m->nu * m->nu));
    R[2][2] = sqrt(G);
    R[3][3] = R[4][4] = sqrt(m->shear * G);
}

/* Upper F with F' F = G, in place (Cholesky, which only scales: G is a sum of two semidefinite ones). */
static bool cholesky(double G[VES_GENERAL][VES_GENERAL], double F[VES_GENERAL][VES_GENERAL])
{
    memset(F, 0, VES_GENERAL * sizeof F[0]);
    for (int i = 0; i < VES_GENERAL; i++) {
        double d = G[i][i];
        for (int k = 0; k < i; k++) d -= F[k][i] * F[k][i];
        if (!(d > 0)) return false;
        F[i][i] = sqrt(d);
        for (int j = i + 1; j < VES_GENERAL; j++) {
            double sum = G[i][j];
            for (int k = 0; k < i; k++) sum -= F[k][i] * F[k][j];
            F[i][j] = sum / F[i][i];
        }
    }
    return true;
}

/* The strains of a level are (P_11 + s B_11, P_22 + s B_22, P_12 + s B_12, S_13, S_23), s = -+1. */
bool ves_lamina_law(const ves_shell_frame *f, const ves_shell_material *m, double weight,
                    double G[VES_GENERAL][VES_GENERAL])
{
    memset(G, 0, VES_GENERAL * sizeof G[0]);
    for (int s = -1; s < 2; s += 2) {
        ves_lamina lamina;
        double R[VES_STRESSES][VES_STRESSES], rows[VES_STRESSES][VES_GENERAL] = {{0}};
        if (!ves_lamina_at(f, s * VES_LEVEL, &lamina)) return false;
        root(m, weight * lamina.volume, R);
        for (int i = 0; i < VES_STRESSES; i++)
            for (int j = 0; j < VES_STRESSES; j++) {
                double sum = 0;
                for (int k = 0; k < VES_STRESSES; k++) sum += R[i][k] * lamina.T[k][j];
                rows[i][j < 3 ? j : j + 3] = sum;
                if (j < 3) rows[i][j + 3] = s * sum;
            }
        for (int i = 0; i < VES_GENERAL; i++)
            for (int j = 0; j < VES_GENERAL; j++)
                for (int k = 0; k < VES_STRESSES; k++) G[i][j] += rows[k][i] * rows[k][j];
    }
    return true;
}

bool ves_lamina_factor(const ves_shell_frame *f, const ves_shell_material *m, double weight,
                       double F[VES_GENERAL][VES_GENERAL])
{
    double G[VES_GENERAL][VES_GENERAL];
    return ves_lamina_law(f, m, weight, G) && cholesky(G, F);
}

bool ves_lamina_forces(const ves_shell_frame *f, const ves_shell_material *m, double weight,
                       const double e[VES_GENERAL], double force[VES_GENERAL])
{
    memset(force, 0, VES_GENERAL * sizeof *force);
    for (int s = -1; s < 2; s += 2) {
        ves_lamina lamina;
        double local[VES_STRESSES] = {0}, stress[VES_STRESSES];
        if (!ves_lamina_at(f, s * VES_LEVEL, &lamina)) return false;
        for (int i = 0; i < VES_STRESSES; i++)
            for (int j = 0; j < VES_STRESSES; j++)
                local[i] += lamina.T[i][j] * (j < 3 ? e[j] + s * e[3 + j] : e[3 + j]);
        ves_lamina_stress(m, local, stress);
        for (int j = 0; j < VES_STRESSES; j++) {
            double sum = 0;
            for (int i = 0; i < VES_STRESSES; i++) sum += lamina.T[i][j] * stress[i];
            sum *= weight * lamina.volume;
            force[j < 3 ? j : j + 3] += sum;
            if (j < 3) force[j + 3] += s * sum;
        }
    }
    return true;
}
