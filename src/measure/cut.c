#include "measure/cut.h"

#include <math.h>

enum { STEPS = 60 };

/* What the room of a row holds. A knot is a place where f is known: the ends, the nodes, and what lies lowest or
 * highest between them. */
typedef struct scratch {
    double *share;      /* [nu] barycentric weights of the nodes */
    double *part;       /* [nu] what each node counts at one place */
    double *at, *value; /* [2 nu + 4] knots */
    double *lo, *hi;    /* [nu + 3] where f is negative */
} scratch;

size_t ves_cut_room(int nu)
{
    return 8 * (size_t)nu + 14;
}

double ves_cut_weight(const ves_samples *s, int j)
{
    double sum = 0;
    for (int i = 0; i < s->nu; i++) sum += s->weight[j * s->nu + i];
    return sum;
}

/* The barycentric weights of Gauss nodes are (-1)^i sqrt(u (1 - u) weight), up to a factor. */
static scratch scratch_init(const ves_cut_row *row)
{
    const ves_samples *s = row->s;
    int nu = s->nu;
    scratch w = {.share = row->room};
    w.part = w.share + nu, w.at = w.part + nu, w.value = w.at + 2 * nu + 4;
    w.lo = w.value + 2 * nu + 4, w.hi = w.lo + nu + 3;
    for (int i = 0; i < nu; i++) {
        double size = sqrt(s->u[i] * (1 - s->u[i]) * s->weight[row->j * nu + i]);
        w.share[i] = i % 2 ? -size : size;
    }
    return w;
}

static void parts(const ves_cut_row *row, const scratch *w, double t)
{
    double sum = 0;
    int nu = row->s->nu, node = -1;
    for (int i = 0; i < nu; i++) {
        double way = t - row->s->u[i];
        if (way == 0) node = i;
        w->part[i] = w->share[i] / way;
        sum += w->part[i];
    }
    for (int i = 0; i < nu; i++) w->part[i] = node < 0 ? w->part[i] / sum : i == node;
}

static double sum_of(const ves_cut_row *row, const scratch *w, const double *plane)
{
    double sum = 0;
    for (int i = 0; i < row->s->nu; i++) sum += w->part[i] * plane[i];
    return sum;
}

static double at(const ves_cut_row *row, const scratch *w, double t)
{
    parts(row, w, t);
    return sum_of(row, w, row->f);
}

/* --- where f is negative --- */

static int first_knots(const ves_cut_row *row, const scratch *w)
{
    int nu = row->s->nu;
    w->at[0] = 0, w->value[0] = at(row, w, 0);
    for (int i = 0; i < nu; i++) w->at[i + 1] = row->s->u[i], w->value[i + 1] = row->f[i];
    w->at[nu + 1] = 1, w->value[nu + 1] = at(row, w, 1);
    return nu + 2;
}

/* Where the parabola through three knots has its vertex. */
static double vertex(const double *x, const double *f)
{
    double left = (f[1] - f[0]) / (x[1] - x[0]), right = (f[2] - f[1]) / (x[2] - x[1]);
    double bend = (right - left) / (x[2] - x[0]);
    return bend != 0 ? (x[0] + x[1]) / 2 - left / (2 * bend) : x[1];
}

/* Does f turn towards zero at the middle one of three knots of one sign? */
static bool turns(const double *f)
{
    double sign = f[1] < 0 ? -1 : 1;
    bool same = (f[0] < 0) == (f[1] < 0) && (f[2] < 0) == (f[1] < 0);
    return same && sign * f[1] < sign * f[0] && sign * f[1] <= sign * f[2];
}

/* A pair of zeros between two knots is seen by the vertex there: at most one for every other knot. */
static int add_vertices(const ves_cut_row *row, const scratch *w, int count)
{
    int added = 0, most = row->s->nu + 2;
    for (int k = 1; k + 1 < count && added < most; k++) {
        if (!turns(w->value + k - 1)) continue;
        double t = vertex(w->at + k - 1, w->value + k - 1);
        if (!(t > w->at[k - 1] && t < w->at[k + 1])) continue;
        double value = at(row, w, t);
        if ((value < 0) == (w->value[k] < 0)) continue;
        int place = t > w->at[k] ? k + 1 : k;
        for (int m = count; m > place; m--) w->at[m] = w->at[m - 1], w->value[m] = w->value[m - 1];
        w->at[place] = t, w->value[place] = value;
        count++, added++, k++;
    }
    return count;
}

/* The zero between knots k and k + 1, by false position; where the same end stays twice its value is halved. */
static double zero(const ves_cut_row *row, const scratch *w, int k)
{
    double a = w->at[k], b = w->at[k + 1], fa = w->value[k], fb = w->value[k + 1];
    for (int step = 0; step < STEPS; step++) {
        double t = b - fb * (b - a) / (fb - fa), f = at(row, w, t);
        if (f == 0 || fabs(t - b) <= 1e-16) return t;
        if ((f < 0) != (fb < 0))
            a = b, fa = fb;
        else
            fa /= 2;
        b = t, fb = f;
    }
    return b;
}

static int pieces(const ves_cut_row *row, const scratch *w)
{
    int knots = add_vertices(row, w, first_knots(row, w)), count = 0;
    bool below = w->value[0] < 0;
    if (below) w->lo[0] = 0;
    for (int k = 0; k + 1 < knots; k++) {
        if ((w->value[k + 1] < 0) == below) continue;
        double t = zero(row, w, k);
        if (below)
            w->hi[count++] = t;
        else
            w->lo[count] = t;
        below = !below;
    }
    if (below) w->hi[count++] = 1;
    return count;
}

/* --- the integral --- */

/* A row that is not cut: its own nodes. */
static double whole_sum(const ves_cut_row *row, double seed, double *f_back, double *g_back)
{
    const double *weight = row->s->weight + row->j * row->s->nu, whole = ves_cut_weight(row->s, row->j);
    double sum = 0;
    for (int i = 0; i < row->s->nu; i++) {
        sum += weight[i] / whole * row->f[i] * row->g[i];
        if (f_back) f_back[i] += seed * weight[i] / whole * row->g[i];
        if (g_back) g_back[i] += seed * weight[i] / whole * row->f[i];
    }
    return sum;
}

static double piece_sum(const ves_cut_row *row, const scratch *w, int k, double seed, double *f_back,
                        double *g_back)
{
    int nu = row->s->nu;
    double length = w->hi[k] - w->lo[k], sum = 0, whole = ves_cut_weight(row->s, row->j);
    for (int q = 0; q < nu; q++) {
        parts(row, w, w->lo[k] + length * row->s->u[q]);
        double f = sum_of(row, w, row->f), g = sum_of(row, w, row->g);
        double weight = length * row->s->weight[row->j * nu + q] / whole;
        sum += weight * f * g;
        for (int i = 0; f_back && i < nu; i++) f_back[i] += seed * weight * g * w->part[i];
        for (int i = 0; g_back && i < nu; i++) g_back[i] += seed * weight * f * w->part[i];
    }
    return sum;
}

/* With f_back and g_back its derivatives too. */
static double row_sum(const ves_cut_row *row, double seed, double *f_back, double *g_back)
{
    scratch w = scratch_init(row);
    int count = pieces(row, &w);
    double sum = 0;
    if (count == 1 && w.lo[0] == 0 && w.hi[0] == 1) return whole_sum(row, seed, f_back, g_back);
    for (int k = 0; k < count; k++) sum += piece_sum(row, &w, k, seed, f_back, g_back);
    return sum;
}

double ves_cut_eval(const ves_cut_row *row)
{
    double size = 0;
    for (int i = 0; i < row->s->nu; i++) size += row->f[i] * row->g[i];
    return isfinite(size) ? row_sum(row, 0, NULL, NULL) : NAN;
}

void ves_cut_gradient(const ves_cut_row *row, double seed, double *f_back, double *g_back)
{
    row_sum(row, seed, f_back, g_back);
}
