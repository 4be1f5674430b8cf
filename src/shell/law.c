#include "shell/law.h"

#include <string.h>

#include "base/vector.h"
#include "shell/lamina.h"

typedef double tensor[3][3];

/* A lamina with the components of its dual vectors: dual[j][k] = g^j . e_k. */
typedef struct level {
    double z;
    ves_lamina lamina;
    tensor dual;
} level;

static bool level_at(const ves_shell_frame *f, double z, level *l)
{
    double g[3][3], cross[3];
    l->z = z;
    if (!ves_lamina_at(f, z, &l->lamina)) return false;
    for (int c = 0; c < 3; c++)
        g[0][c] = f->Xr[c] + z * f->Vr[c], g[1][c] = f->Xs[c] + z * f->Vs[c], g[2][c] = f->V[c];
    for (int j = 0; j < 3; j++) {
        ves_cross(g[(j + 1) % 3], g[(j + 2) % 3], cross);
        for (int k = 0; k < 3; k++) l->dual[j][k] = ves_dot(cross, l->lamina.e[k]) / l->lamina.volume;
    }
    return true;
}

/* The strain at a level in its frame, all of it. */
static void strain_in(const level *l, const double e[VES_GENERAL], tensor out)
{
    double s = l->z / VES_LEVEL, e12 = (e[2] + s * e[5]) / 2;
    const tensor given = {
        {e[0] + s * e[3], e12, e[6] / 2}, {e12, e[1] + s * e[4], e[7] / 2}, {e[6] / 2, e[7] / 2, 0}};
    for (int k = 0; k < 3; k++)
        for (int m = 0; m < 3; m++) {
            out[k][m] = 0;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) out[k][m] += l->dual[i][k] * given[i][j] * l->dual[j][m];
        }
}

static void stress_of(const ves_shell_material *m, const tensor e, tensor out)
{
    const double strain[VES_STRESSES] = {e[0][0], e[1][1], 2 * e[0][1], 2 * e[0][2], 2 * e[1][2]};
    double s[VES_STRESSES];
    ves_lamina_stress(m, strain, s);
    const tensor all = {{s[0], s[2], s[3]}, {s[2], s[1], s[4]}, {s[3], s[4], 0}};
    memcpy(out, all, sizeof all);
}

/* H -= 2 s e - 2 upper(s e - e s). */
static void vary(const tensor s, const tensor e, tensor H)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double se = 0, es = 0;
            for (int k = 0; k < 3; k++) se += s[i][k] * e[k][j], es += e[i][k] * s[k][j];
            H[i][j] -= 2 * (j > i ? es : se);
        }
}

/* What the stress of b does on a changes with E, nu and shear: sigma = E (e / (1 + nu) + nu tr e / (1 - nu^2)) in the
 * plane. */
static void material_add(const ves_shell_material *m, double factor, const tensor a, const tensor b,
                         ves_law *to)
{
    double nu = m->nu, p = 1 + nu, q = 1 - nu, same = 0, crossed, across, trace;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) same += a[i][j] * b[i][j];
    trace = (a[0][0] + a[1][1]) * (b[0][0] + b[1][1]);
    crossed = 2 * (a[0][2] * b[0][2] + a[1][2] * b[1][2]), across = m->shear * crossed;
    to->E += factor * ((same + across) / p + nu * trace / (p * q));
    to->nu += factor * m->E * (-(same + across) / (p * p) + (1 + nu * nu) * trace / (p * p * q * q));
    to->shear += factor * m->E * crossed / p;
}

/* tr(L H) = sum of (H' g^j) . dg_j. */
static void frame_add(const level *l, double factor, const tensor H, ves_shell_frame *to)
{
    for (int j = 0; j < 3; j++) {
        double g[3] = {0};
        for (int k = 0; k < 3; k++) {
            double local = 0;
            for (int i = 0; i < 3; i++) local += H[i][k] * l->dual[j][i];
            for (int c = 0; c < 3; c++) g[c] += factor * local * l->lamina.e[k][c];
        }
        double *even = j == 0 ? to->Xr : j == 1 ? to->Xs : to->V, *odd = j == 0 ? to->Vr : to->Vs;
        for (int c = 0; c < 3; c++) {
            even[c] += g[c];
            if (j < 2) odd[c] += l->z * g[c];
        }
    }
}

void ves_law_energy(const ves_shell_frame *frame, const ves_shell_material *material, double factor,
                    const double a[VES_GENERAL], const double b[VES_GENERAL], ves_law *to)
{
    for (int s = -1; s < 2; s += 2) {
        level l;
        tensor ea, eb, sa, sb, H = {{0}};
        if (!level_at(frame, s * VES_LEVEL, &l)) continue;
        strain_in(&l, a, ea), strain_in(&l, b, eb);
        stress_of(material, ea, sa), stress_of(material, eb, sb);
        vary(sa, eb, H), vary(sb, ea, H);
        double density = 0;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) density += sa[i][j] * eb[i][j];
        for (int i = 0; i < 3; i++) H[i][i] += density;
        frame_add(&l, factor * l.lamina.volume, H, &to->frame);
        material_add(material, factor * l.lamina.volume, ea, eb, to);
    }
}

void ves_law_stress(const ves_shell_frame *frame, const ves_shell_material *material, const ves_law_seed *at,
                    const double a[VES_GENERAL], double on[VES_GENERAL], ves_law *to)
{
    const double *w = at->seed;
    const tensor of = {{w[0], w[2] / 2, w[3] / 2}, {w[2] / 2, w[1], w[4] / 2}, {w[3] / 2, w[4] / 2, 0}};
    level l;
    tensor ea, s, H = {{0}};
    double stress[VES_STRESSES];
    if (!level_at(frame, at->z, &l)) return;
    strain_in(&l, a, ea);
    stress_of(material, of, s);
    vary(s, ea, H);
    frame_add(&l, 1, H, &to->frame);
    material_add(material, 1, of, ea, to);
    ves_lamina_stress(material, w, stress);
    for (int j = 0; j < VES_STRESSES; j++) {
        double sum = 0;
        for (int i = 0; i < VES_STRESSES; i++) sum += l.lamina.T[i][j] * stress[i];
        on[j < 3 ? j : j + 3] += sum;
        if (j < 3) on[3 + j] += at->z / VES_LEVEL * sum;
    }
}
