#include <float.h>
#include <math.h>

#include "measure/approach.h"
#include "measure/argument.h"
#include "measure/cell.h"
#include "measure/ring.h"

enum { FROM, TO, VALLEYS = 8, STEPS = 20 };

/* Of sums of a hundred terms, relative to the largest: a distance of less is none. */
static const double ROUNDING = 1e-13;

static const ves_key KEYS[] = {
    {.name = "from", .kind = VES_PLACE, .required = true, .about = "a place or a curve"},
    {.name = "to", .kind = VES_PLACE, .required = true, .about = "another place or curve"},
    {.name = NULL}};

/* Samples of the keys come last. */
static const ves_samples *site(const ves_measure_input *input, int key)
{
    return input->sample[input->samples - 2 + key];
}

/* room: what counts as no distance; weights of the two nearest points (ves_ring_weights), of `from`, of `to`;
 * how far the cell of each node reaches, along `from`, along `to`. */
static size_t room(const ves_measure_input *input)
{
    return 1 + 4 * ((size_t)site(input, FROM)->count + (size_t)site(input, TO)->count);
}

static double *weights(const ves_measure_input *input, int key)
{
    return input->room + 1 + (key == TO ? 3 * site(input, FROM)->count : 0);
}

static double *reaches(const ves_measure_input *input, int key)
{
    return weights(input, TO) + 3 * site(input, TO)->count + (key == TO ? site(input, FROM)->count : 0);
}

static ves_piece piece_init(const ves_samples *s, int n)
{
    ves_piece piece = {.lo = 0, .hi = 0};
    for (int c = 0; c < 3; c++) {
        piece.X[c] = s->X[c][n];
        if (s->site != VES_SITE_PLACE) piece.Xv[c] = s->Xv[c][n], piece.Xvv[c] = s->Xvv[c][n];
    }
    if (s->site != VES_SITE_PLACE) ves_cell_v(s, n, &piece.lo, &piece.hi);
    return piece;
}

static double weighted(const double *weight, const double *plane, int count)
{
    double sum = 0;
    for (int k = 0; k < count; k++) sum += weight[k] * plane[k];
    return sum;
}

/* About a point between the nodes. */
static ves_piece piece_at(const ves_measure_input *input, int key, ves_ring_point p)
{
    const ves_samples *s = site(input, key);
    ves_piece piece = {.lo = 0, .hi = 0};
    double *weight = weights(input, key);
    ves_ring_weights(s, p, weight);
    for (int c = 0; c < 3; c++) {
        piece.X[c] = weighted(weight, s->X[c], s->count);
        piece.Xv[c] = weighted(weight + s->count, s->X[c], s->count);
        piece.Xvv[c] = weighted(weight + 2 * s->count, s->X[c], s->count);
    }
    return piece;
}

/* How far the points of a piece are at most from its node, all of them and those along the unit vector r. */
static double reach(const ves_piece *piece)
{
    double w = ves_cell_reach(piece->lo, piece->hi);
    return w * (sqrt(ves_dot(piece->Xv, piece->Xv)) + w / 2 * sqrt(ves_dot(piece->Xvv, piece->Xvv)));
}

static double reach_along(const ves_piece *piece, const double r[3])
{
    double w = ves_cell_reach(piece->lo, piece->hi);
    return w * (fabs(ves_dot(piece->Xv, r)) + w / 2 * fabs(ves_dot(piece->Xvv, r)));
}

static double squared(const ves_samples *a, int i, const ves_samples *b, int j)
{
    double x = b->X[0][j] - a->X[0][i], y = b->X[1][j] - a->X[1][i], z = b->X[2][j] - a->X[2][i];
    return x * x + y * y + z * z;
}

static double nodal(const ves_samples *a, const ves_samples *b)
{
    double least = HUGE_VAL;
    for (int i = 0; i < a->count; i++) {
#pragma omp simd reduction(min : least)
        for (int j = 0; j < b->count; j++) {
            double d2 = squared(a, i, b, j);
            least = d2 < least ? d2 : least;
        }
    }
    return sqrt(least);
}

/* --- valleys: pairs of nodes nearer to each other than the pairs next to them --- */

typedef struct valley {
    int node[2];
    double squared;
} valley;

/* Of pairs that are level, within rounding, the first is the valley. */
static bool is_valley(const ves_samples *a, const ves_samples *b, int i, int j, double rounding)
{
    double here = squared(a, i, b, j);
    for (int di = -1; di <= 1; di++)
        for (int dj = -1; dj <= 1; dj++) {
            int x = (i + di + a->count) % a->count, y = (j + dj + b->count) % b->count;
            if (x == i && y == j) continue;
            bool before = x * b->count + y < i * b->count + j;
            if (!(here <= squared(a, x, b, y) + (before ? -rounding : rounding))) return false;
        }
    return true;
}

static void insert(valley list[VALLEYS], int *count, valley made)
{
    if (*count == VALLEYS && list[VALLEYS - 1].squared <= made.squared) return;
    int at = *count < VALLEYS ? (*count)++ : VALLEYS - 1;
    for (; at > 0 && list[at - 1].squared > made.squared; at--) list[at] = list[at - 1];
    list[at] = made;
}

/* The nearest ones, among the pairs whose cells might come nearer than the nearest nodes. */
static int valleys(const ves_measure_input *input, double nearest, double rounding, valley list[VALLEYS])
{
    const ves_samples *a = site(input, FROM), *b = site(input, TO);
    const double *near = reaches(input, FROM), *far = reaches(input, TO);
    valley least = {.squared = HUGE_VAL};
    int count = 0;
    for (int i = 0; i < a->count; i++)
        for (int j = 0; j < b->count; j++) {
            double limit = nearest + near[i] + far[j], here = squared(a, i, b, j);
            if (!(here <= limit * limit)) continue;
            if (here < least.squared) least = (valley){{i, j}, here};
            if (is_valley(a, b, i, j, rounding)) insert(list, &count, (valley){{i, j}, here});
        }
    if (!count && least.squared < HUGE_VAL) list[count++] = least;
    return count;
}

/* --- down --- */

typedef struct pair {
    ves_ring_point at[2];
    ves_piece piece[2];
    double distance;
} pair;

static pair pair_at(const ves_measure_input *input, ves_ring_point from, ves_ring_point to)
{
    static const double zero[2] = {0, 0};
    pair p = {.at = {ves_ring_near(site(input, FROM), from), ves_ring_near(site(input, TO), to)}};
    double r[3];
    for (int k = 0; k < 2; k++) p.piece[k] = piece_at(input, k, p.at[k]);
    ves_approach_vector(&p.piece[0], &p.piece[1], zero, r);
    p.distance = sqrt(ves_dot(r, r));
    return p;
}

/* From two nodes to where the Taylor polynomials come nearest, and on from there; where that is no nearer,
 * half as far. Each step leaves the third power of what was left. */
static pair go_down(const ves_measure_input *input, const valley *from, double rounding)
{
    pair p = pair_at(input, (ves_ring_point){from->node[0], 0}, (ves_ring_point){from->node[1], 0});
    double cell[2], reach[2], t[2];
    for (int k = 0; k < 2; k++) {
        ves_piece piece = piece_init(site(input, k), from->node[k]);
        reach[k] = cell[k] = ves_cell_reach(piece.lo, piece.hi);
    }
    for (int step = 0; step < STEPS; step++) {
        for (int k = 0; k < 2; k++) p.piece[k].lo = -reach[k], p.piece[k].hi = reach[k];
        double promised = ves_approach_solve(&p.piece[0], &p.piece[1], t);
        if (!(promised < p.distance - rounding)) break;
        pair next = pair_at(input, (ves_ring_point){p.at[0].node, p.at[0].t + t[0]},
                            (ves_ring_point){p.at[1].node, p.at[1].t + t[1]});
        bool nearer = next.distance < p.distance;
        for (int k = 0; k < 2; k++)
            reach[k] = nearer ? fmin(2 * reach[k], cell[k]) : fmin(reach[k], fabs(t[k])) / 2;
        if (nearer) p = next;
    }
    return p;
}

/* |r + change| >= |r| - change . r/|r| */
static bool might_be_nearer(const ves_measure_input *input, const valley *v, double best)
{
    static const double zero[2] = {0, 0};
    ves_piece a = piece_init(site(input, FROM), v->node[0]), b = piece_init(site(input, TO), v->node[1]);
    double r[3];
    ves_approach_vector(&a, &b, zero, r);
    double d = sqrt(ves_dot(r, r));
    for (int c = 0; d > 0 && c < 3; c++) r[c] /= d;
    return d - reach_along(&a, r) - reach_along(&b, r) <= best;
}

/* Returns the size of what is measured: the farthest node from the origin. */
static double prepare(const ves_measure_input *input)
{
    double size = 0;
    for (int key = 0; key < 2; key++) {
        const ves_samples *s = site(input, key);
        for (int k = 0; k < s->count; k++) {
            ves_piece piece = piece_init(s, k);
            reaches(input, key)[k] = reach(&piece);
            size = fmax(size, sqrt(ves_dot(piece.X, piece.X)));
        }
    }
    return size;
}

/* The least distance between two places or curves, exact: nodes tell where the valleys are, and from there
 * it goes down along the curves themselves. What lies between nodes without a trace in them is not found;
 * what is reported is the distance of two points. Derivative: along r, both points held (envelope
 * theorem). Where the distance is 0 it has a kink and no derivative: the gradient is 0 there, which is one
 * of its slopes.
 * test  point to circle, coaxial and skew circles, against a dense search; places on their own curve,
 *       crossing curves: 0; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    const ves_samples *a = site(input, FROM), *b = site(input, TO);
    valley list[VALLEYS];
    pair best = {.distance = HUGE_VAL};
    double nearest = nodal(a, b), size = prepare(input), level = ROUNDING * size;
    int count = valleys(input, nearest * (1 + 1e-12) + DBL_MIN, level * (nearest + level), list);
    for (int k = 0; k < count; k++) {
        if (!might_be_nearer(input, &list[k], best.distance)) continue;
        pair p = go_down(input, &list[k], DBL_EPSILON * size);
        if (p.distance < best.distance) best = p;
    }
    if (!(best.distance < HUGE_VAL)) return VES_NO_NUMBER;
    for (int key = 0; key < 2; key++) ves_ring_weights(site(input, key), best.at[key], weights(input, key));
    input->room[0] = level;
    *value = best.distance;
    return VES_OK;
}

static void scatter(const ves_adjoint *adjoint, const double *weight, int count, double scale,
                    const double r[3])
{
    for (int c = 0; adjoint->X[0] && c < 3; c++)
        for (int k = 0; k < count; k++) adjoint->X[c][k] += scale * r[c] * weight[k];
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    const ves_samples *a = site(input, FROM), *b = site(input, TO);
    const double *from = weights(input, FROM), *to = weights(input, TO);
    double r[3];
    for (int c = 0; c < 3; c++) r[c] = weighted(to, b->X[c], b->count) - weighted(from, a->X[c], a->count);
    double d = sqrt(ves_dot(r, r));
    if (!(d > input->room[0])) return;
    scatter(adjoint[input->samples - 2], from, a->count, -seed / d, r);
    scatter(adjoint[input->samples - 1], to, b->count, seed / d, r);
}

const ves_measure ves_measure_distance = {.name = "distance",
                                          .about = "least distance between two places or curves",
                                          .unit = "m",
                                          .degree = 1,
                                          .extreme = true,
                                          .curve = VES_X | VES_XV | VES_XVV,
                                          .keys = KEYS,
                                          .room = room,
                                          .eval = eval,
                                          .gradient = gradient};
