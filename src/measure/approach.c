#include "measure/approach.h"

#include <math.h>
#include <stdbool.h>

#include "base/vector.h"

enum { STEPS = 40 };
static const double CLOSE = 1e-7; /* steps shorten to their square, or at worst by 1e-6 */

void ves_approach_vector(const ves_piece *a, const ves_piece *b, const double t[2], double vector[3])
{
    for (int c = 0; c < 3; c++)
        vector[c] = b->X[c] + t[1] * (b->Xv[c] + t[1] / 2 * b->Xvv[c]) - a->X[c] -
                    t[0] * (a->Xv[c] + t[0] / 2 * a->Xvv[c]);
}

static double half_square(const ves_piece *a, const ves_piece *b, const double t[2])
{
    double r[3];
    ves_approach_vector(a, b, t, r);
    return ves_dot(r, r) / 2;
}

/* Slope and Hessian of |r|^2 / 2 at t. */
typedef struct model {
    double slope[2], h00, h01, h11;
} model;

static model model_init(const ves_piece *a, const ves_piece *b, const double t[2])
{
    double r[3], p[3], q[3];
    ves_approach_vector(a, b, t, r);
    for (int c = 0; c < 3; c++) {
        p[c] = -(a->Xv[c] + t[0] * a->Xvv[c]);
        q[c] = b->Xv[c] + t[1] * b->Xvv[c];
    }
    return (model){{ves_dot(r, p), ves_dot(r, q)},
                   ves_dot(p, p) - ves_dot(r, a->Xvv),
                   ves_dot(p, q),
                   ves_dot(q, q) + ves_dot(r, b->Xvv)};
}

/* Takes a variable out that its end holds, or that moves nothing. */
static void freeze(model *m, const ves_piece *a, const ves_piece *b, const double t[2])
{
    const ves_piece *piece[2] = {a, b};
    for (int k = 0; k < 2; k++) {
        bool held = (t[k] <= piece[k]->lo && m->slope[k] >= 0) || (t[k] >= piece[k]->hi && m->slope[k] <= 0);
        if (!held) continue;
        m->slope[k] = m->h01 = 0;
        *(k ? &m->h11 : &m->h00) = 0;
    }
}

/* The Newton step of the Hessian + damping * its size, made positive definite; false: not with this damping.
 */
static bool newton(const model *m, double damping, double step[2])
{
    double size = fabs(m->h00) + fabs(m->h11), extra = damping * size;
    double h00 = m->h00 + extra, h11 = m->h11 + extra;
    if (m->slope[0] == 0) h00 = size;
    if (m->slope[1] == 0) h11 = size;
    double det = h00 * h11 - m->h01 * m->h01;
    step[0] = step[1] = 0;
    if (size == 0) return true;
    if (!(h00 > 0 && h11 > 0 && det > 1e-10 * h00 * h11)) return false;
    step[0] = (m->h01 * m->slope[1] - h11 * m->slope[0]) / det;
    step[1] = (m->h01 * m->slope[0] - h00 * m->slope[1]) / det;
    return true;
}

static double clamp(double t, const ves_piece *piece)
{
    return fmin(fmax(t, piece->lo), piece->hi);
}

/* One accepted step; returns its length relative to the pieces, 0 when there is none. */
static double advance(const ves_piece *a, const ves_piece *b, double *f, double t[2])
{
    model m = model_init(a, b, t);
    freeze(&m, a, b, t);
    for (double damping = 0; damping<1e9; damping = damping> 0 ? 10 * damping : 1e-6) {
        double step[2];
        if (!newton(&m, damping, step)) continue;
        double to[2] = {clamp(t[0] + step[0], a), clamp(t[1] + step[1], b)}, g = half_square(a, b, to);
        if (g > *f * (1 + 1e-15)) continue;
        double length = 0;
        if (a->hi > a->lo) length += fabs(to[0] - t[0]) / (a->hi - a->lo);
        if (b->hi > b->lo) length += fabs(to[1] - t[1]) / (b->hi - b->lo);
        t[0] = to[0], t[1] = to[1], *f = g;
        return length;
    }
    return 0;
}

double ves_approach_solve(const ves_piece *a, const ves_piece *b, double t[2])
{
    t[0] = t[1] = 0;
    double f = half_square(a, b, t);
    for (int k = 0; k < STEPS; k++)
        if (advance(a, b, &f, t) < CLOSE) break;
    return sqrt(2 * f);
}
