#include <float.h>
#include <math.h>

#include "measure/approach.h"
#include "measure/argument.h"
#include "measure/cell.h"

enum { FROM, TO };

static const ves_key KEYS[] = {
    {.name = "from", .kind = VES_PLACE, .required = true, .about = "a place or a curve"},
    {.name = "to", .kind = VES_PLACE, .required = true, .about = "another place or curve"},
    {.name = NULL}};

/* Samples of the keys come last. */
static const ves_samples *site(const ves_measure_input *input, int key)
{
    return input->sample[input->samples - 2 + key];
}

/* room: node and t on either side, then how far the cell of each node reaches, along `from`, along `to`. */
static size_t room(const ves_measure_input *input)
{
    return 4 + (size_t)site(input, FROM)->count + (size_t)site(input, TO)->count;
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

/* Looks closely at two nodes whose pieces might come nearer than `best`: |r + change| >= |r| - change .
 * r/|r|.
 */
static void look(const ves_measure_input *input, int i, int j, double *best)
{
    ves_piece a = piece_init(site(input, FROM), i), b = piece_init(site(input, TO), j);
    double zero[2] = {0, 0}, r[3], t[2];
    ves_approach_vector(&a, &b, zero, r);
    double d = sqrt(ves_dot(r, r));
    for (int c = 0; d > 0 && c < 3; c++) r[c] /= d;
    if (d - reach_along(&a, r) - reach_along(&b, r) > *best) return;
    d = ves_approach_solve(&a, &b, t);
    if (d >= *best) return;
    *best = d;
    input->room[0] = i, input->room[1] = j, input->room[2] = t[0], input->room[3] = t[1];
}

/* The least distance between two places or curves. About each node a curve is its Taylor polynomial of degree
 * 2, over the half way to its neighbours; the result is the least of all pairs of nodes, of third order in
 * their spacing. Pairs that cannot be nearer are passed over. Derivative: along r, both points held (envelope
 * theorem); 0 where the distance is 0. test  point to circle, coaxial and skew circles, against a dense
 * search; crossing curves: 0; order 3; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    const ves_samples *a = site(input, FROM), *b = site(input, TO);
    double *near = input->room + 4, *far = near + a->count;
    double start = nodal(a, b) * (1 + 1e-12) + DBL_MIN, best = start; /* more, so that its own pair is seen */
    for (int k = 0; k < a->count + b->count; k++) {
        ves_piece piece = k < a->count ? piece_init(a, k) : piece_init(b, k - a->count);
        near[k] = reach(&piece);
    }
    for (int i = 0; i < a->count; i++)
        for (int j = 0; j < b->count; j++) {
            double limit = best + near[i] + far[j];
            if (squared(a, i, b, j) <= limit * limit) look(input, i, j, &best);
        }
    if (!(best < start)) return VES_NO_NUMBER;
    *value = best;
    return VES_OK;
}

static void scatter(const ves_adjoint *adjoint, int n, double t, double scale, const double r[3])
{
    for (int c = 0; adjoint->X[0] && c < 3; c++) {
        adjoint->X[c][n] += scale * r[c];
        if (adjoint->Xv[0]) adjoint->Xv[c][n] += scale * t * r[c];
        if (adjoint->Xvv[0]) adjoint->Xvv[c][n] += scale * t * t / 2 * r[c];
    }
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    int i = (int)input->room[0], j = (int)input->room[1];
    ves_piece a = piece_init(site(input, FROM), i), b = piece_init(site(input, TO), j);
    double r[3];
    ves_approach_vector(&a, &b, input->room + 2, r);
    double d = sqrt(ves_dot(r, r));
    if (!(d > 0)) return;
    scatter(adjoint[input->samples - 2], i, input->room[2], -seed / d, r);
    scatter(adjoint[input->samples - 1], j, input->room[3], seed / d, r);
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
