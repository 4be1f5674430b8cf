/* Stresses at the lattices of the elements. */
#include "shell/inside.h"

#include <math.h>
#include <string.h>

#include "base/eigen.h"
#include "base/vector.h"

ves_status ves_shell_stresses_make(ves_shell *shell, ves_arena *arena)
{
    ves_shell_stresses *s = &shell->stresses;
    size_t count = 0;
    for (int k = 0; k < shell->elements; k++)
        count += (size_t)shell->kind[shell->element[k].sheet].lattice.points;
    s->points = (int)count;
    s->lattice = ves_arena_take(arena, (size_t)shell->model->sheets, sizeof *s->lattice);
    if (!s->lattice) return VES_MEMORY;
    for (int k = 0; k < shell->model->sheets; k++)
        memcpy(s->lattice[k], shell->kind[k].lattice.along, sizeof s->lattice[k]);
    s->sheet = ves_arena_take(arena, count, sizeof *s->sheet);
    s->u = ves_arena_doubles(arena, count);
    s->v = ves_arena_doubles(arena, count);
    s->thickness = ves_arena_doubles(arena, count);
    s->area = ves_arena_doubles(arena, count);
    s->stress = ves_arena_take(arena, count, sizeof *s->stress);
    for (int c = 0; c < 3; c++) s->X[c] = ves_arena_doubles(arena, count);
    return s->sheet && s->u && s->v && s->thickness && s->area && s->stress && s->X[0] && s->X[1] && s->X[2]
               ? VES_OK
               : VES_MEMORY;
}

static void place_fill(const ves_shell *shell, const shell_element *e, const ves_shell_body *body, int q,
                       int at)
{
    const ves_shell_stresses *s = &shell->stresses;
    const ves_shell_sheet *sheet = &shell->model->sheet[e->sheet];
    const ves_shell_points *lattice = &body->kind->lattice;
    const double *N = lattice->table.N + q * body->kind->nodes, *u = sheet->knot[0] + e->u,
                 *v = sheet->knot[1] + e->v;
    s->sheet[at] = e->sheet;
    s->u[at] = u[0] + (u[1] - u[0]) * (1 + lattice->at[q][0]) / 2;
    s->v[at] = v[0] + (v[1] - v[0]) * (1 + lattice->at[q][1]) / 2;
    s->thickness[at] = 0;
    for (int c = 0; c < 3; c++) s->X[c][at] = 0;
    for (int k = 0; k < body->kind->nodes; k++) {
        s->thickness[at] += N[k] * shell->input->thickness[e->sheet][e->s[k]];
        for (int c = 0; c < 3; c++) s->X[c][at] += N[k] * body->X[k][c];
    }
}

/* It is parabolic. */
const double ves_shell_across[VES_SHELL_LEVELS] = {0, 1.5, 0};

/* At a pole an element has a side of no length, but for rounding: strains there are none. The next points are a
 * hundredth of the element away, strips of rings a thousandth of their distance from the axis wide. */
static bool is_flat(const ves_shell_frame *frame, double area)
{
    static const double NONE = 1e-9;
    return !(area > NONE * fmax(ves_dot(frame->Xr, frame->Xr), ves_dot(frame->Xs, frame->Xs)));
}

static void stress_fill(const ves_shell *shell, const ves_shell_body *body, const ves_shell_frame *frame,
                        int q, int at)
{
    double normal[3], area;
    ves_cross(frame->Xr, frame->Xs, normal);
    area = sqrt(ves_dot(normal, normal));
    bool flat = is_flat(frame, area);
    shell->stresses.area[at] = body->kind->lattice.weight[q] * area;
    for (int level = 0; level < VES_SHELL_LEVELS; level++) {
        double *stress = shell->stresses.stress[at][level];
        if (flat || !ves_shell_stress_at(frame, &shell->input->material, shell->strain + q * VES_GENERAL,
                                         level - 1, stress))
            for (int k = 0; k < VES_STRESSES; k++) stress[k] = 0;
        stress[3] *= ves_shell_across[level], stress[4] *= ves_shell_across[level];
    }
}

const ves_shell_stresses *ves_shell_stress(ves_shell *shell, int which)
{
    const double *u = ves_shell_state(shell, which);
    if (shell->stressed == which) return &shell->stresses;
    for (int i = 0, at = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        ves_shell_body body = ves_shell_gather(shell, e);
        ves_shell_field(shell, &shell->layout[0], e, u);
        ves_shell_strains(&body, &body.kind->lattice, (const double(*)[3])shell->U,
                          (const double(*)[3])shell->A, &shell->scratch, shell->strain);
        const ves_shell_frame *frame = ves_shell_frames(&body, &body.kind->lattice.table, &shell->scratch);
        for (int q = 0; q < body.kind->lattice.points; q++, at++) {
            place_fill(shell, e, &body, q, at);
            stress_fill(shell, &body, &frame[q], q, at);
        }
    }
    shell->stressed = which;
    return &shell->stresses;
}

int ves_shell_places(const ves_shell *shell)
{
    return shell->stresses.points;
}

/* Principal stresses of a tensor with s33 = 0: roots of the characteristic cubic, by the trigonometric form. */
static void principal(const double s[VES_STRESSES], double p[3])
{
    double mean = (s[0] + s[1]) / 3, a = s[0] - mean, b = s[1] - mean, c = -mean;
    double J2 = (a * a + b * b + c * c) / 2 + s[2] * s[2] + s[3] * s[3] + s[4] * s[4];
    double J3 = a * (b * c - s[4] * s[4]) - s[2] * (s[2] * c - s[4] * s[3]) + s[3] * (s[2] * s[4] - b * s[3]);
    double root = sqrt(J2 / 3), sine = root > 0 ? J3 / (2 * root * root * root) : 0;
    double angle = acos(sine > 1 ? 1 : sine < -1 ? -1 : sine) / 3;
    for (int k = 0; k < 3; k++) p[k] = mean + 2 * root * cos(angle - VES_TWO_PI * k / 3);
}

double ves_stress_shear(const double s[VES_STRESSES])
{
    if (s[3] == 0 && s[4] == 0) {
        double centre = (s[0] + s[1]) / 2, radius = hypot((s[0] - s[1]) / 2, s[2]);
        return fmax(radius, (fabs(centre) + radius) / 2);
    }
    double p[3];
    principal(s, p);
    return (fmax(p[0], fmax(p[1], p[2])) - fmin(p[0], fmin(p[1], p[2]))) / 2;
}

double ves_stress_mises(const double s[VES_STRESSES])
{
    return sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * (s[2] * s[2] + s[3] * s[3] + s[4] * s[4]));
}

/* Of the difference of the largest and the least principal stress, d p = n' ds n with its direction n. */
static void spread_slope(const double s[VES_STRESSES], double slope[VES_STRESSES])
{
    double a[9] = {s[0], s[2], s[3], s[2], s[1], s[4], s[3], s[4], 0}, p[3], n[9];
    int top = 0, least = 0;
    ves_eigen_symmetric(3, a, p, n);
    for (int k = 1; k < 3; k++) {
        if (p[k] > p[top]) top = k;
        if (p[k] < p[least]) least = k;
    }
    static const int PAIR[VES_STRESSES][2] = {{0, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};
    for (int k = 0; k < VES_STRESSES; k++) {
        int i = 3 * PAIR[k][0], j = 3 * PAIR[k][1];
        slope[k] = (n[i + top] * n[j + top] - n[i + least] * n[j + least]) * (i == j ? 1 : 2);
    }
}

void ves_stress_shear_slope(const double s[VES_STRESSES], double slope[VES_STRESSES])
{
    memset(slope, 0, VES_STRESSES * sizeof *slope);
    if (s[3] != 0 || s[4] != 0) {
        spread_slope(s, slope);
        for (int k = 0; k < VES_STRESSES; k++) slope[k] /= 2;
        return;
    }
    double centre = (s[0] + s[1]) / 2, half = (s[0] - s[1]) / 2, radius = hypot(half, s[2]);
    bool inside = radius >= (fabs(centre) + radius) / 2; /* zero lies between the principal stresses */
    double by_radius = inside ? 1 : 0.5, by_centre = inside ? 0 : centre < 0 ? -0.5 : 0.5;
    double along = radius > 0 ? by_radius * half / radius : 0;
    slope[0] = (by_centre + along) / 2, slope[1] = (by_centre - along) / 2;
    slope[2] = radius > 0 ? by_radius * s[2] / radius : 0;
}

void ves_stress_mises_slope(const double s[VES_STRESSES], double slope[VES_STRESSES])
{
    double mises = ves_stress_mises(s), by = mises > 0 ? 1 / (2 * mises) : 0;
    slope[0] = (2 * s[0] - s[1]) * by, slope[1] = (2 * s[1] - s[0]) * by;
    for (int k = 2; k < VES_STRESSES; k++) slope[k] = 6 * s[k] * by;
}
