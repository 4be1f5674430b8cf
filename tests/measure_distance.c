/* Distances between places and curves: closed forms, a dense search, on grids of any fineness. */
#include "measure/approach.h"
#include "measure/ring.h"
#include "samples.h"

/* Curves are exact between their nodes: only rounding is left. */
static const double ROUNDING = 1e-12;

static double distance_of(rig *r)
{
    rig_measure(r, "distance");
    return rig_eval(r);
}

Test(measure_distance, distances_between_places_and_circles_meet_their_closed_forms)
{
    body low = body_init(frustum, -1, 0.731, 0.731, 0), high = body_init(frustum, -1, 1.129, 1.129, 0);
    for (uint64_t seed = 0; seed < 5; seed++) {
        body a = seed ? body_moved(low, seed) : low, b = seed ? body_moved(high, seed) : high;
        for (int c = 0; c < 3; c++) b.shift[c] += 1.713 * b.turn[c][2]; /* coaxial */
        rig r;
        rig_open(&r);
        rig_place(&r, &a, 0, 0.3);
        rig_place(&r, &b, 0, 2.1);
        double flat = 0.731 * 0.731 + 1.129 * 1.129 - 2 * 0.731 * 1.129 * cos(1.8);
        near(distance_of(&r), sqrt(flat + 1.713 * 1.713), ROUNDING, "two places");
        rig_close(&r);
        rig_open(&r);
        rig_ring(&r, &a, 0, 32, 0);
        rig_ring(&r, &b, 0, 24, 0);
        near(distance_of(&r), hypot(1.713, 1.129 - 0.731), ROUNDING, "coaxial circles");
        rig_close(&r);
    }
}

static double ring_error(uint64_t seed, int n)
{
    body a = body_moved(body_init(frustum, -1, 0.731, 0.731, 0), seed);
    body b = body_moved(body_init(frustum, -1, 1.129, 1.129, 0), seed + 1000);
    double X[6][3], Y[6][3], d[3], want = HUGE_VAL;
    rig r;
    rig_open(&r);
    rig_place(&r, &a, 0, 0.3);
    rig_ring(&r, &b, 0, n, 0);
    double got = distance_of(&r);
    rig_close(&r);
    body_at(&a, 0, 0.3, X);
    /* From a point to a circle: height over its plane, and from its foot to the rim. */
    double axis[3] = {b.turn[0][2], b.turn[1][2], b.turn[2][2]};
    for (int c = 0; c < 3; c++) d[c] = X[0][c] - b.shift[c];
    double height = inner(d, axis), foot = sqrt(inner(d, d) - height * height);
    body_at(&b, 0, 0, Y);
    want = hypot(height, foot - 1.129);
    return fabs(got - want) / fmax(want, 0.1);
}

Test(measure_distance, the_distance_from_a_place_to_a_circle_is_exact_on_any_grid)
{
    static const int nodes[] = {8, 9, 16, 31, 64};
    for (int k = 0; k < 5; k++)
        for (uint64_t seed = 1; seed <= 80; seed++) {
            double error = ring_error(seed, nodes[k]);
            cr_expect(error < ROUNDING, "%d nodes, seed %d: off by %.2e", nodes[k], (int)seed, error);
        }
}

/* Slow oracle: a dense search over both curves, refined around its best pair. */
static double dense(const body *a, const body *b)
{
    double best = HUGE_VAL, at[2] = {0}, width = 2 * PI, X[6][3], Y[6][3], d[3];
    for (int pass = 0; pass < 12; pass++) {
        double middle[2] = {at[0], at[1]};
        for (int i = -100; i <= 100; i++)
            for (int j = -100; j <= 100; j++) {
                double s = middle[0] + width * i / 200, t = middle[1] + width * j / 200;
                body_at(a, 0, s, X), body_at(b, 0, t, Y);
                for (int c = 0; c < 3; c++) d[c] = X[0][c] - Y[0][c];
                double f = sqrt(inner(d, d));
                if (f < best) best = f, at[0] = s, at[1] = t;
            }
        width /= 8;
    }
    return best;
}

Test(measure_distance, the_distance_between_skew_circles_agrees_with_a_dense_search)
{
    for (uint64_t seed = 1; seed <= 12; seed++) {
        body a = body_moved(body_init(wavy_tube, -1, 0.731, 0.11, 0), seed);
        body b = body_moved(body_init(frustum, -1, 1.129, 1.129, 0), seed + 1000);
        rig r;
        rig_open(&r);
        rig_ring(&r, &a, 0, 32, 0);
        rig_ring(&r, &b, 0, 48, 0);
        near(distance_of(&r), dense(&a, &b), ROUNDING, "skew circles");
        rig_close(&r);
    }
}

Test(measure_distance, the_distance_of_crossing_curves_vanishes)
{
    for (int n = 8; n <= 64; n *= 2)
        for (int turn = 0; turn < 20; turn++) {
            body a = body_init(frustum, -1, 1, 1, 0), b = a;
            double w = 0.4 + 0.11 * turn; /* about x: the circles meet at (+-1, 0, 0) */
            b.turn[1][1] = b.turn[2][2] = cos(w), b.turn[2][1] = sin(w), b.turn[1][2] = -sin(w);
            rig r;
            rig_open(&r);
            rig_ring(&r, &a, 0, n, 0);
            rig_ring(&r, &b, 0, n + n / 2, 0);
            near(distance_of(&r), 0, ROUNDING, "crossing circles");
            rig_gradient(&r, 1);
            for (int k = 0; k < n; k++) cr_expect(r.back[0].at[0][k] == 0, "a slope where there is a kink");
            rig_close(&r);
        }
}

/* Waves up to the highest mode that n nodes hold, between the nodes and all around. */
Test(measure_distance, nodes_say_all_of_a_curve)
{
    rig r;
    rig_open(&r);
    for (int n = 3; n <= 40; n++) {
        ves_grid grid;
        cr_assert(ves_grid_ring(0, n, true, &r.arena, &grid) == VES_OK);
        ves_samples s = {.nu = 1, .nv = n, .count = n, .periodic = true, .v = grid.v};
        for (int k = 0; k <= (n - 1) / 2; k++)
            for (int step = -100; step <= 100; step++) {
                double weight[3 * 40], v = grid.v[n / 3] + 0.0717 * step, sum[3] = {0};
                if (step == 0) v = grid.v[n / 3];
                if (step == 1) v = grid.v[n / 3] + 1e-6;
                ves_ring_point p = ves_ring_near(&s, (ves_ring_point){n / 3, v - grid.v[n / 3]});
                ves_ring_weights(&s, p, weight);
                for (int d = 0; d < 3; d++)
                    for (int j = 0; j < n; j++) sum[d] += weight[d * n + j] * cos(k * grid.v[j] + 0.3);
                near(sum[0], cos(k * v + 0.3), ROUNDING, "value");
                near(sum[1] / n, -k * sin(k * v + 0.3) / n, 1e-6, "slope");
                near(sum[2] / (n * n), -k * k * cos(k * v + 0.3) / (n * n), 1e-6, "bend");
            }
    }
    rig_close(&r);
}

Test(measure_distance, a_point_curve_is_a_place)
{
    body point = body_init(frustum, -1, 0, 0, 0), ring = body_init(frustum, -1, 1.129, 1.129, 0);
    point.shift[0] = 0.4, point.shift[2] = 0.9;
    rig r;
    rig_open(&r);
    rig_ring(&r, &ring, 0, 64, 0);
    rig_ring(&r, &point, 0, 8, 0);
    near(distance_of(&r), hypot(0.9, 1.129 - 0.4), ROUNDING, "point curve to circle");
    rig_close(&r);
}

/* Newton steps end when they are shorter than 1e-7 of the pieces, and then are right to its square. */
static void check_approach(ves_piece a, ves_piece b, double distance, const double want[2])
{
    double t[2];
    near(ves_approach_solve(&a, &b, t), distance, ROUNDING, "distance");
    for (int k = 0; want && k < 2; k++) near(t[k], want[k], 1e-11, k ? "t on b" : "t on a");
}

Test(measure_distance, pieces_of_lines_and_parabolas_meet_their_closed_forms)
{
    const ves_piece line = {{0.3, 0.1, 0}, {1, 0, 0}, {0}, -1, 1},
                    skew = {{0.5, 0.4, 0.7}, {1, 1, 0}, {0}, -1, 1};
    const ves_piece parallel = {{0.5, 0.5, 0.3}, {2, 0, 0}, {0}, -1, 1},
                    beyond = {{4.3, 3.1, 4}, {-1, 0, 0}, {0}, -1, 1};
    const ves_piece cross_it = {{0.5, -0.1, 0}, {1, 1, 0}, {0}, -1, 1}, place = {.X = {0, 0.9, 0}};
    const ves_piece bowl = {{-0.6, 0.36, 0}, {1, -1.2, 0}, {0, 2, 0}, -2, 1}; /* y = x^2 */
    check_approach(line, skew, 0.7, (double[2]){-0.1, -0.3});
    check_approach(skew, line, 0.7, (double[2]){-0.3, -0.1});
    check_approach(line, cross_it, 0, (double[2]){0.4, 0.2});
    check_approach(line, parallel, 0.5, NULL);
    check_approach(line, beyond, sqrt(2 * 2 + 3 * 3 + 4 * 4), (double[2]){1, 1}); /* held by both ends */
    /* (0, h) is nearest to x^2 = h - 1/2, at a distance of sqrt(h - 1/4) */
    check_approach(bowl, place, sqrt(0.9 - 0.25), (double[2]){0.6 - sqrt(0.4), 0});
    check_approach(place, bowl, sqrt(0.9 - 0.25), (double[2]){0, 0.6 - sqrt(0.4)});
    check_approach(place, place, 0, (double[2]){0, 0});
}
