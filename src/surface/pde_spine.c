/* Spines that are given [Ugail 2011, 5.3]: linear in the means of the two ends and in the vectors of the
 * file. */
#include <string.h>

#include "surface/pde.h"

static int terms_of(const ves_spine *spine)
{
    return spine->kind == VES_SPINE_SOLVED ? 0 : 2 + spine->count;
}

static int position_at(const pde *p, double u)
{
    for (int j = 0; j < p->conditions; j++)
        if (p->layout.knot[j].u == u && p->layout.knot[j].derivative == 0) return j;
    return -1;
}

ves_status ves_pde_spine_create(pde *p, const ves_bound *bound, ves_arena *arena)
{
    (void)bound;
    pde_spine *s = &p->spine;
    s->terms = terms_of(&p->def->spine);
    for (int e = 0; e < 2; e++) {
        s->ends[e] = position_at(p, e);
        if (s->terms && s->ends[e] < 0) return VES_SINGULAR;
    }
    s->point = ves_arena_doubles(arena, (size_t)(3 * s->terms));
    s->adjoint = ves_arena_doubles(arena, (size_t)(3 * s->terms));
    return s->point && s->adjoint ? VES_OK : VES_MEMORY;
}

/* Row of the spine's vector i (1 .. count) or of an end among its terms: the ends come first. */
static int control(const ves_spine *spine, int q)
{
    int last = spine->count + 1;
    return q == 0 ? 0 : q == last ? 1 : q + 1;
}

/* Cubic Hermite blending functions and their derivatives [eqs 5.5-5.8 as corrected in docs/errata.md]:
 * p0, p1, v0, v1. */
static void hermite(double u, double out[3][4])
{
    double u2 = u * u, u3 = u2 * u;
    const double value[3][4] = {{1 - 3 * u2 + 2 * u3, 3 * u2 - 2 * u3, u - 2 * u2 + u3, u3 - u2},
                                {6 * u2 - 6 * u, 6 * u - 6 * u2, 1 - 4 * u + 3 * u2, 3 * u2 - 2 * u},
                                {12 * u - 6, 6 - 12 * u, 6 * u - 4, 6 * u - 2}};
    memcpy(out, value, sizeof value);
}

/* Knot i of `points` control points of this degree: clamped, uniform between. */
static double knot(int i, int points, int degree)
{
    int inner = i - degree, spans = points - degree;
    return inner <= 0 ? 0 : inner >= spans ? 1 : (double)inner / spans;
}

/* d-th derivative of the basis function i of degree k (its knots those of `degree`), the errata's eq 2.5. */
static double basis(int i, int k, int d, double u, int points, int degree)
{
    double t0 = knot(i, points, degree), t1 = knot(i + k, points, degree);
    double s0 = knot(i + 1, points, degree), s1 = knot(i + k + 1, points, degree);
    if (k == 0) return d ? 0 : (u >= t0 && u < s0) || (u == 1 && s0 == 1 && t0 < 1);
    double left = t1 > t0 ? 1 / (t1 - t0) : 0, right = s1 > s0 ? 1 / (s1 - s0) : 0;
    if (d)
        return k * (left * basis(i, k - 1, d - 1, u, points, degree) -
                    right * basis(i + 1, k - 1, d - 1, u, points, degree));
    return (u - t0) * left * basis(i, k - 1, 0, u, points, degree) +
           (s1 - u) * right * basis(i + 1, k - 1, 0, u, points, degree);
}

void ves_pde_spine_basis(const pde *p, int nu, const double *u, double *table)
{
    const ves_spine *spine = &p->def->spine;
    int terms = p->spine.terms, degree = terms < 4 ? terms - 1 : 3;
    for (int i = 0; i < nu && terms; i++) {
        double cubic[3][4];
        hermite(u[i], cubic);
        for (int d = 0; d < 3; d++)
            for (int q = 0; q < terms; q++) {
                bool given = spine->kind == VES_SPINE_HERMITE;
                int row = given ? q : control(spine, q);
                table[(d * terms + row) * nu + i] =
                    given ? cubic[d][q] : basis(q, degree, d, u[i], terms, degree);
            }
    }
}

void ves_pde_spine_bind(pde *p, const ves_bound *bound)
{
    const ves_spine *spine = &p->def->spine;
    int width = 1 + 2 * p->band;
    for (int k = 0; k < 3 && p->spine.terms; k++) {
        for (int e = 0; e < 2; e++) p->spine.point[3 * e + k] = p->data[(p->spine.ends[e] * 3 + k) * width];
        for (int q = 0; q < spine->count; q++)
            p->spine.point[3 * (2 + q) + k] = bound->number[spine->first + 3 * q + k];
    }
}

void ves_pde_spine_unbind(pde *p, double *number_adjoint)
{
    const ves_spine *spine = &p->def->spine;
    int width = 1 + 2 * p->band;
    for (int k = 0; k < 3 && p->spine.terms; k++) {
        for (int e = 0; e < 2; e++)
            p->data_adjoint[(p->spine.ends[e] * 3 + k) * width] += p->spine.adjoint[3 * e + k];
        for (int q = 0; q < spine->count; q++)
            number_adjoint[spine->first + 3 * q + k] += p->spine.adjoint[3 * (2 + q) + k];
    }
}
