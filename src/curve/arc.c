#include "curve/arc.h"

#include <math.h>

enum {
    PANELS = 8,   /* Gauss panels a segment: (1/8)^10 of a smooth segment's tenth derivative is rounding */
    SWEEPS = 100, /* of Gauss-Seidel on rows (h0, 2 (h0 + h1), h1): the error at least halves each time */
    STEPS = 30    /* of Newton, safeguarded; 4 or 5 are used */
};

typedef struct spline {
    int points;
    const double *point;
    double *h;      /* [points] chord lengths: the parameter along each segment */
    double *bend;   /* [3 points] second derivatives at the points */
    double *length; /* [points * PANELS + 1] arc length up to each panel */
} spline;

static const double *at(const double *list, int points, int i)
{
    return list + 3 * ((i + points) % points);
}

/* Natural conditions of a periodic cubic spline with chord-length knots. */
static void spline_solve(spline *s)
{
    int n = s->points;
    for (int i = 0; i < n; i++) {
        const double *p = at(s->point, n, i), *q = at(s->point, n, i + 1);
        s->h[i] = sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]) +
                       (q[2] - p[2]) * (q[2] - p[2]));
        for (int c = 0; c < 3; c++) s->bend[3 * i + c] = 0;
    }
    for (int k = 0; k < SWEEPS * n; k++) {
        int i = k % n;
        double h0 = s->h[(i + n - 1) % n], h1 = s->h[i];
        const double *p0 = at(s->point, n, i - 1), *p = at(s->point, n, i), *p1 = at(s->point, n, i + 1);
        const double *m0 = at(s->bend, n, i - 1), *m1 = at(s->bend, n, i + 1);
        for (int c = 0; c < 3; c++) {
            double slope = 6 * ((p1[c] - p[c]) / h1 - (p[c] - p0[c]) / h0);
            s->bend[3 * i + c] = (slope - h0 * m0[c] - h1 * m1[c]) / (2 * (h0 + h1));
        }
    }
}

/* Place and speed at t in [0, 1] of segment i. */
static double spline_eval(const spline *s, int i, double t, double place[3])
{
    double h = s->h[i], a = 1 - t, speed = 0;
    const double *p = at(s->point, s->points, i), *q = at(s->point, s->points, i + 1);
    const double *m = at(s->bend, s->points, i), *r = at(s->bend, s->points, i + 1);
    for (int c = 0; c < 3; c++) {
        place[c] = a * p[c] + t * q[c] + ((a * a * a - a) * m[c] + (t * t * t - t) * r[c]) * h * h / 6;
        double d = q[c] - p[c] + ((1 - 3 * a * a) * m[c] + (3 * t * t - 1) * r[c]) * h * h / 6;
        speed += d * d;
    }
    return sqrt(speed);
}

/* Arc length of segment i between t0 and t1: Gauss-Legendre, 5 nodes. */
static double piece(const spline *s, int i, double t0, double t1)
{
    static const double node[3] = {0, 0.53846931010568309104, 0.90617984593866399280};
    static const double weight[3] = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
    double middle = (t0 + t1) / 2, half = (t1 - t0) / 2, sum = 0, place[3];
    for (int k = -2; k <= 2; k++) {
        int a = k < 0 ? -k : k;
        sum += weight[a] * spline_eval(s, i, middle + (k < 0 ? -half : half) * node[a], place);
    }
    return half * sum;
}

/* The t in panel k at arc length `target`: Newton, kept inside the panel. */
static double solve(const spline *s, int k, double target)
{
    int i = k / PANELS;
    double lo = (double)(k % PANELS) / PANELS, hi = lo + 1.0 / PANELS, rest = target - s->length[k], place[3];
    double t = lo + (hi - lo) * rest / (s->length[k + 1] - s->length[k]);
    for (int step = 0; step < STEPS; step++) {
        double change = (piece(s, i, lo, t) - rest) / spline_eval(s, i, t, place);
        t = fmin(fmax(t - change, lo), hi);
        if (!(fabs(change) > 1e-16)) break;
    }
    return t;
}

bool ves_arc_sample(const double *point, int points, int count, ves_arena *arena, double *sample)
{
    int panels = points * PANELS;
    spline s = {points, point, ves_arena_doubles(arena, (size_t)points),
                ves_arena_doubles(arena, 3 * (size_t)points), ves_arena_doubles(arena, (size_t)panels + 1)};
    if (!s.h || !s.bend || !s.length) return false;
    spline_solve(&s);
    s.length[0] = 0;
    for (int k = 0; k < panels; k++) {
        double t = (double)(k % PANELS) / PANELS;
        s.length[k + 1] = s.length[k] + piece(&s, k / PANELS, t, t + 1.0 / PANELS);
    }
    for (int j = 0, k = 0; j < count; j++) {
        double target = s.length[panels] * j / count, place[3];
        while (k + 1 < panels && s.length[k + 1] <= target) k++;
        spline_eval(&s, k / PANELS, solve(&s, k, target), place);
        for (int c = 0; c < 3; c++) sample[c * count + j] = place[c];
    }
    return true;
}
