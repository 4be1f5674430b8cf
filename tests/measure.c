/* Every measure against closed forms, with the order at which it converges; what scaling and rigid motions
 * do to it; what cannot be measured. */
#include "samples.h"

#include <stdio.h>

/* Gauss x trapezoid converges faster than any power on these analytic bodies: what is left is rounding of
 * some thousand terms. */
static const double ROUNDING = 1e-12;

static double of_body(const char *measure, const body *b, int nu, int nv)
{
    rig r;
    rig_open(&r);
    rig_surface(&r, b, nu, nv);
    rig_measure(&r, measure);
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

Test(measure, the_registry_is_complete_and_speaks)
{
    int count = 0;
    for (const ves_measure *const *m = ves_measures(); *m; m++, count++) {
        ves_dim dim;
        const char *unit = (*m)->unit ? (*m)->unit : "1";
        cr_assert(!m[1] || strcmp(m[0]->name, m[1]->name) < 0, "%s before %s", m[0]->name, m[1]->name);
        cr_assert(ves_measure_find((*m)->name, NULL) == *m);
        cr_assert((*m)->about && (*m)->eval && ((*m)->gradient || (*m)->shell), "%s", (*m)->name);
        cr_assert((*m)->surface || (*m)->curve || (*m)->shell, "%s reads nothing", (*m)->name);
        cr_assert(ves_dim_read(unit + (*unit == '*'), &dim, NULL), "%s: unit %s", (*m)->name, unit);
        for (const ves_key *key = (*m)->keys; key && key->name; key++) {
            cr_assert(key->about && key->kind, "%s: %s", (*m)->name, key->name);
            cr_assert((key->kind == VES_CHOICE) == (key->words != NULL), "%s: %s", (*m)->name, key->name);
        }
    }
    cr_assert(count == 35, "got %d measures, want 35", count);
    static const ves_measure extra = {.name = "mine"};
    const ves_measure *const plugin[] = {&extra, NULL};
    cr_assert(ves_measure_find("mine", plugin) == &extra && !ves_measure_find("mine", NULL));
}

Test(measure, integrals_over_bodies_meet_their_closed_forms)
{
    double R = 2.385, r = 0.731, h = 1.713, r1 = 1.129, slant = hypot(h, r1 - r), c = 0.917, t = 0.613;
    body ball = body_init(ellipsoid, 1, R, R, R), ring = body_init(torus, -1, R, r, 0);
    body cone = body_init(frustum, -1, r, r1, h), tube = body_init(frustum, -1, r, r, h);
    body soap = body_init(catenoid, -1, c, t, 0);
    double sigma = r / R, clifford = PI * PI / (sigma * sqrt(1 - sigma * sigma));
    const struct {
        const char *measure;
        const body *b;
        double want;
    } table[] = {
        {"area", &ball, 4 * PI * R * R},
        {"area", &ring, 4 * PI * PI * R * r},
        {"area", &tube, 2 * PI * r * h},
        {"area", &cone, PI * (r + r1) * slant},
        {"area", &soap, PI * c * c * (2 * t + sinh(2 * t))},
        {"volume", &ball, 4 * PI / 3 * R * R * R},
        {"volume", &ring, 2 * PI * PI * R * r * r},
        {"bending", &ball, 8 * PI},
        {"bending", &ring, 4 * clifford},
        {"bending", &tube, 2 * PI * h / r},
        {"willmore", &ball, 4 * PI},
        {"willmore", &ring, clifford},
        {"willmore", &soap, 0},
        {"mean_curvature", &ball, 4 * PI * R},
        {"mean_curvature", &ring, 2 * PI * PI * R},
        {"mean_curvature", &tube, PI * h},
        {"mean_curvature", &soap, 0},
        {"gauss_curvature", &ball, 4 * PI},
        {"gauss_curvature", &ring, 0},
        {"gauss_curvature", &cone, 0},
        {"gauss_curvature", &soap, -4 * PI * tanh(t)},
    };
    for (size_t k = 0; k < sizeof table / sizeof *table; k++)
        near(of_body(table[k].measure, table[k].b, 40, 64), table[k].want, ROUNDING, table[k].measure);
}

/* A frustum or half ball closed by caps, moved as a whole. */
static void capped(rig *r, const body *b, bool bottom, double top_side)
{
    rig_surface(r, b, 12, 24);
    if (bottom) rig_ring(r, b, 0, 24, -1);
    rig_ring(r, b, 1, 24, top_side);
}

Test(measure, volume_counts_caps_and_stays_when_the_shape_moves)
{
    double r0 = 0.731, r1 = 1.129, h = 1.713, R = 2.385;
    double want[2] = {PI * h / 3 * (r0 * r0 + r0 * r1 + r1 * r1), 2 * PI / 3 * R * R * R};
    for (uint64_t seed = 0; seed < 8; seed++) {
        for (int kind = 0; kind < 2; kind++) {
            rig r;
            body b = kind ? body_init(half_ball, 1, R, 0, 0) : body_init(frustum, -1, r0, r1, h);
            if (seed) b = body_moved(b, seed);
            rig_open(&r);
            capped(&r, &b, !kind, kind ? -1 : 1);
            rig_measure(&r, "volume");
            /* The cap of the half ball looks down: X x Xv points up at its rim. */
            near(rig_eval(&r), want[kind], ROUNDING, "volume");
            rig_close(&r);
        }
    }
}

Test(measure, the_volume_under_bent_caps_does_not_depend_on_where_it_stands)
{
    double first = 0;
    for (uint64_t seed = 0; seed < 8; seed++) {
        rig r;
        body b = body_init(wavy_tube, -1, 1.129, 0.217, 1.713);
        if (seed) b = body_moved(b, seed);
        rig_open(&r);
        capped(&r, &b, true, 1);
        rig_measure(&r, "volume");
        double volume = rig_eval(&r);
        if (!seed) first = volume;
        near(volume, first, ROUNDING, "volume");
        rig_close(&r);
    }
}

static double max_curvature(const body *b, int nu, int nv, double p)
{
    rig r;
    rig_open(&r);
    rig_surface(&r, b, nu, nv);
    rig_measure(&r, "max_curvature");
    if (p > 0) rig_number(&r, "smooth", p);
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

Test(measure, max_curvature_of_sphere_torus_and_tube)
{
    double R = 2.385, r = 0.731, p[] = {0, 1, 2, 4.5, 20, 400};
    body ball = body_init(ellipsoid, 1, R, R, R), ring = body_init(torus, -1, R, r, 0);
    body tube = body_init(frustum, -1, r, r, 1.7);
    for (int k = 0; k < 6; k++) {
        near(max_curvature(&ball, 16, 32, p[k]), 1 / R, ROUNDING, "sphere");
        near(max_curvature(&tube, 16, 32, p[k]), p[k] > 0 ? pow(0.5, 1 / p[k]) / r : 1 / r, ROUNDING, "tube");
    }
    near(max_curvature(&ring, 40, 64, 0), 1 / r, ROUNDING, "torus");
    double bending = of_body("bending", &ring, 40, 64), area = of_body("area", &ring, 40, 64);
    near(max_curvature(&ring, 40, 64, 2), sqrt(bending / (2 * area)), ROUNDING, "torus, p = 2");
}

Test(measure, power_means_grow_towards_the_maximum)
{
    body b = body_init(ellipsoid, 1, 1.9, 1.2, 0.8);
    double most = max_curvature(&b, 24, 48, 0), last = 0;
    for (double p = 1; p < 2000; p *= 2) {
        double mean = max_curvature(&b, 24, 48, p);
        cr_assert(mean > last && mean < most, "p = %g: got %.16g, before %.16g, maximum %.16g", p, mean, last,
                  most);
        last = mean;
    }
    near(last, most, 0.01, "p = 1024"); /* log(nodes) / p */
}

/* The longest half axis lies along x, at u = 1/2, v = 0, half a step beside the nodes. */
Test(measure, max_curvature_over_nodes_is_of_order_2)
{
    double a = 1.9, b = 1.2, c = 0.8, want = a / (c * c), error[3];
    body pebble = body_init(ellipsoid, 1, a, b, c);
    for (int k = 0; k < 3; k++) error[k] = want - max_curvature(&pebble, 32 << k, 64 << k, 0);
    for (int k = 0; k < 2; k++) {
        double order = log2(error[k] / error[k + 1]);
        cr_assert(order > 1.9 && order < 2.1, "order %.3f (errors %.2e, %.2e)", order, error[k],
                  error[k + 1]);
    }
}

static double extent_along(const body *b, int nu, int nv, const double d[3])
{
    rig r;
    rig_open(&r);
    rig_surface(&r, b, nu, nv);
    rig_measure(&r, "extent");
    rig_vector(&r, "along", d[0], d[1], d[2]);
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

/* 2 |diag(axes) turn^T d| of an ellipsoid; of a tube the part of its axis plus that of its discs. */
static double extent_exact(const body *b, const double d[3])
{
    double n = sqrt(inner(d, d)), local[3] = {0};
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) local[k] += b->turn[c][k] * d[c] / n;
    if (b->at == ellipsoid)
        return 2 * sqrt(pow(b->p[0] * local[0], 2) + pow(b->p[1] * local[1], 2) + pow(b->p[2] * local[2], 2));
    return b->p[2] * fabs(local[2]) + 2 * b->p[0] * hypot(local[0], local[1]);
}

/* Largest error over directions; the extreme then lies at all places of a cell. */
static double extent_error(const body *b, int nu, int nv)
{
    double worst = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        body moved = body_moved(*b, seed);
        double d[3] = {0.3, 1.7, -0.9};
        worst = fmax(worst, fabs(extent_along(&moved, nu, nv, d) - extent_exact(&moved, d)));
    }
    return worst;
}

Test(measure, extent_is_of_order_3_inside_and_at_the_rim)
{
    const body all[] = {body_init(ellipsoid, 1, 1.9, 1.2, 0.8), body_init(frustum, -1, 0.731, 0.731, 1.713)};
    for (int k = 0; k < 2; k++) {
        double e[3] = {extent_error(&all[k], 12, 16), extent_error(&all[k], 24, 32),
                       extent_error(&all[k], 48, 64)};
        for (int j = 0; j < 2; j++) {
            double order = log2(e[j] / e[j + 1]);
            cr_assert(order > 2.8, "body %d: order %.3f (errors %.2e, %.2e)", k, order, e[j], e[j + 1]);
        }
        cr_assert(e[2] < 1e-4, "body %d: error %.2e", k, e[2]); /* (2 pi / 64 / 2)^3 = 1.2e-4 */
    }
}

/* A narrow ridge across the cells: the highest node is not the one whose cell holds the top. */
static void ridge(const double *p, double u, double v, double X[6][3])
{
    double s = u - 0.5 - p[0] * (v - PI), k = p[1], t = v - PI;
    double all[6][3] = {{u, v, -k * s * s - 0.05 * t * t},
                        {1, 0, -2 * k * s},
                        {0, 1, 2 * k * p[0] * s - 0.1 * t},
                        {0, 0, -2 * k},
                        {0, 0, 2 * k * p[0]},
                        {0, 0, -2 * k * p[0] * p[0] - 0.1}};
    memcpy(X, all, sizeof all);
}

/* On a quadratic surface the Taylor polynomials are exact: the top is 0, whatever the grid. */
Test(measure, extent_finds_the_top_of_a_narrow_ridge)
{
    for (int k = 0; k < 40; k++) {
        body b = body_init(ridge, 1, 0.03 + 0.0021 * k, 300, 0);
        double d[3] = {0, 0, 1}, want = 0;
        for (int corner = 0; corner < 4; corner++) {
            double X[6][3]; /* the lowest point is a corner */
            body_at(&b, corner % 2, 2 * PI * (corner / 2), X);
            want = fmax(want, -X[0][2]);
        }
        ves_grid grid;
        rig r;
        rig_open(&r);
        cr_assert(ves_grid_quadrature(8, 12, false, &r.arena, &grid) == VES_OK);
        rig_add(&r, VES_SITE_SURFACE, &b, &grid, 0);
        rig_measure(&r, "extent");
        rig_vector(&r, "along", d[0], d[1], d[2]);
        near(rig_eval(&r), want, ROUNDING, "ridge");
        rig_close(&r);
    }
}

Test(measure, width_height_and_depth_are_extents)
{
    static const char *const name[3] = {"width", "height", "depth"};
    body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 7);
    for (int c = 0; c < 3; c++) {
        double d[3] = {0};
        d[c] = 2.5;
        near(of_body(name[c], &b, 16, 32), extent_along(&b, 16, 32, d), 0, name[c]);
    }
    rig r;
    rig_open(&r);
    rig_surface(&r, &b, 16, 32);
    rig_measure(&r, "extent");
    near(rig_eval(&r), of_body("height", &b, 16, 32), 0, "extent along y by default");
    rig_close(&r);
}

static double centroid(rig *r, int of, const double d[3])
{
    rig_measure(r, "centroid");
    rig_choice(r, "of", of);
    if (d) rig_vector(r, "along", d[0], d[1], d[2]);
    return rig_eval(r);
}

/* want is the height of the centroid over z = 0 of the unmoved body, whose other two components are 0. */
static void check_centroid(const body *still, bool bottom, double side, int of, double want)
{
    for (uint64_t seed = 0; seed < 6; seed++) {
        body b = seed ? body_moved(*still, seed) : *still;
        double d[3] = {0.3, -1.7, 0.9}, moved = 0;
        rig r;
        rig_open(&r);
        capped(&r, &b, bottom, side);
        for (int c = 0; c < 3; c++) moved += (b.turn[c][2] * want + b.shift[c]) * d[c] / sqrt(inner(d, d));
        near(centroid(&r, of, d), moved, ROUNDING, of ? "volume" : "surface");
        near(centroid(&r, of, NULL), b.turn[1][2] * want + b.shift[1], ROUNDING, "along y by default");
        rig_close(&r);
    }
}

Test(measure, centroids_of_frustum_and_half_ball_move_with_them)
{
    double r0 = 0.731, r1 = 1.129, h = 1.713, R = 2.385;
    body cone = body_init(frustum, -1, r0, r1, h), dome = body_init(half_ball, 1, R, 0, 0);
    double solid = h * (r0 * r0 + 2 * r0 * r1 + 3 * r1 * r1) / (4 * (r0 * r0 + r0 * r1 + r1 * r1));
    check_centroid(&cone, true, 1, 1, solid);
    check_centroid(&cone, true, 1, 0, h * (r0 + 2 * r1) / (3 * (r0 + r1)));
    check_centroid(&dome, false, -1, 1, 3 * R / 8);
    check_centroid(&dome, false, -1, 0, R / 2);
}

/* No closed form; but it must move with the shape, and lie on its axis of symmetry (v -> v + pi). */
Test(measure, the_centroid_under_bent_caps_moves_with_the_shape)
{
    body still = body_init(wavy_tube, -1, 1.129, 0.217, 1.713);
    double local[3] = {0};
    for (uint64_t seed = 0; seed < 6; seed++) {
        body b = seed ? body_moved(still, seed) : still;
        rig r;
        rig_open(&r);
        capped(&r, &b, true, 1);
        for (int c = 0; c < 3; c++) {
            double d[3] = {0}, want = b.shift[c];
            d[c] = 1;
            double got = centroid(&r, 1, d);
            if (!seed) local[c] = got;
            for (int k = 0; k < 3; k++) want += b.turn[c][k] * local[k];
            near(got, want, ROUNDING, "centroid");
        }
        rig_close(&r);
    }
    cr_assert(local[2] > 0.8 && local[2] < 1.0, "got %g",
              local[2]); /* half of the height, a bit more on top */
}

static double pointwise(rig *r, const char *measure, const char *formula)
{
    rig_measure(r, measure);
    rig_formula(r, "of", formula);
    return rig_eval(r);
}

Test(measure, pointwise_integrals_agree_with_the_measures_in_c)
{
    static const char *const pair[][2] = {{"1", "area"},
                                          {"4*H^2 - 2*K", "bending"},
                                          {"k1^2 + k2^2", "bending"},
                                          {"((k1 + k2)/2)^2", "willmore"},
                                          {"H", "mean_curvature"},
                                          {"k1*k2", "gauss_curvature"}};
    const body all[] = {body_init(torus, -1, 2.385, 0.731, 0), body_init(wavy_tube, -1, 1.129, 0.217, 1.713),
                        body_init(ellipsoid, 1, 2.385, 2.385, 2.385)};
    for (int b = 0; b < 3; b++)
        for (int k = 0; k < 6; k++) {
            rig r;
            rig_open(&r);
            rig_surface(&r, &all[b], 16, 32);
            near(pointwise(&r, "integral", pair[k][0]), of_body(pair[k][1], &all[b], 16, 32), ROUNDING,
                 pair[k][0]);
            rig_close(&r);
        }
}

Test(measure, pointwise_formulas_read_every_name)
{
    double R = 2.385, r = 0.731;
    body ball = body_init(ellipsoid, 1, R, R, R), ring = body_init(torus, -1, R, r, 0);
    ball.shift[0] = 0.3, ball.shift[1] = -0.4, ball.shift[2] = 0.5;
    const struct {
        const body *b;
        const char *measure, *formula;
        double want, tolerance;
    } table[] = {
        {&ball, "integral", "x", 0.3 * 4 * PI * R * R, ROUNDING},
        {&ball, "integral", "y", -0.4 * 4 * PI * R * R, ROUNDING},
        {&ball, "integral", "(z - 0.5)^2", 4 * PI / 3 * pow(R, 4), ROUNDING},
        {&ball, "integral", "p*z + q", (1.37 * 0.5 + 0.83) * 4 * PI * R * R, ROUNDING},
        {&ball, "integral", "u", 2 * PI * R * R, ROUNDING},
        {&ball, "integral", "v", 4 * PI * PI * R * R, ROUNDING},
        {&ring, "max", "k1", 1 / r, ROUNDING},
        {&ring, "min", "k1", 1 / r, ROUNDING},
        /* the nodes about t = pi are pi^2 / 80 away from it: cos t is 1 - 7.6e-3 there */
        {&ring, "max", "k2", 1 / (R + r), 1e-2},
        {&ring, "min", "k2", -1 / (R - r), 1e-2},
        {&ring, "min", "K", -1 / (r * (R - r)), 1e-2},
        {&ring, "max", "-p", -1.37, 0},
        {&ring, "max", "z", r, 1e-2},
    };
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        rig r_;
        rig_open(&r_);
        rig_surface(&r_, table[k].b, 40, 64);
        near(pointwise(&r_, table[k].measure, table[k].formula), table[k].want, table[k].tolerance,
             table[k].formula);
        rig_close(&r_);
    }
}

/* On a tube z is evenly spread over 0 .. h: the mean of z^p is h^p / (p + 1). */
Test(measure, smooth_maxima_are_power_means_of_the_positive_part)
{
    double h = 1.713, p[] = {1, 2, 4, 8};
    body tube = body_init(frustum, -1, 0.731, 0.731, h);
    for (int k = 0; k < 4; k++) {
        rig r;
        rig_open(&r);
        rig_surface(&r, &tube, 16, 16);
        rig_measure(&r, "max");
        rig_number(&r, "smooth", p[k]);
        rig_formula(&r, "of", "z");
        near(rig_eval(&r), h / pow(p[k] + 1, 1 / p[k]), ROUNDING, "z");
        rig_formula(&r, "of", "-z");
        near(rig_eval(&r), 0, 0, "-z is nowhere positive");
        rig_close(&r);
    }
}

/* A body with all that a measure may ask for: surface, caps, a place and a curve. */
static void furnish(rig *r, const body *b, const ves_measure *measure)
{
    body far = body_moved(*b, 77);
    far.scale = b->scale;
    for (int c = 0; c < 3; c++) far.shift[c] = b->shift[c] + b->scale * (3 + c);
    if (measure->surface) rig_surface(r, b, 12, 24);
    if (measure->cap) rig_ring(r, b, 0, 24, -1), rig_ring(r, b, 1, 24, 1);
    if (measure->curve) rig_place(r, b, 0.4, 1.1), rig_ring(r, &far, 0.7, 24, 0);
    rig_measure_with(r, measure);
}

static double furnished(const ves_measure *measure, const body *b, int choice, double smooth)
{
    rig r;
    rig_open(&r);
    furnish(&r, b, measure);
    for (int k = 0; k < r.args.count; k++) {
        if (r.args.key[k].kind == VES_CHOICE) r.arg[k].given = true, r.arg[k].value = choice;
        if (!strcmp(r.args.key[k].name, "smooth")) rig_number(&r, "smooth", smooth);
    }
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

Test(measure, scaling_a_shape_scales_a_measure_by_its_degree)
{
    body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 5), large = b;
    large.scale = 2.385;
    for (int c = 0; c < 3; c++) large.shift[c] *= large.scale;
    for (const ves_measure *const *m = ves_measures(); *m; m++) {
        if ((*m)->degree == VES_NO_DEGREE) continue;
        for (int k = 0; k < 2; k++) {
            double smooth = 3.5 * k, want = pow(large.scale, (*m)->degree) * furnished(*m, &b, k, smooth);
            near(furnished(*m, &large, k, smooth), want, ROUNDING, (*m)->name);
        }
    }
}

Test(measure, rigid_motions_leave_all_but_positions_alone)
{
    body b = body_init(wavy_tube, -1, 1.129, 0.217, 1.713);
    static const char *const name[] = {"area",           "volume",          "bending",       "willmore",
                                       "mean_curvature", "gauss_curvature", "max_curvature", "min_radius"};
    for (uint64_t seed = 1; seed < 6; seed++) {
        body moved = body_moved(b, seed);
        for (size_t k = 0; k < sizeof name / sizeof *name; k++) {
            const ves_measure *m = ves_measure_find(name[k], NULL);
            near(furnished(m, &moved, 0, 0), furnished(m, &b, 0, 0), ROUNDING, name[k]);
        }
    }
}

Test(measure, what_has_no_number_is_refused_and_the_value_left_alone)
{
    body b = body_init(torus, -1, 2.385, 0.731, 0);
    const struct {
        const char *measure, *key, *formula;
    } table[] = {
        {"extent", "along", NULL},        {"draft_angle", "axis", NULL}, {"undercut", "axis", NULL},
        {"brimful_volume", "axis", NULL}, {"fill_volume", "axis", NULL}, {"centroid", "along", NULL},
        {"max", "of", "sqrt(z)"},         {"min", "of", "1/(x - x)"},    {"max", "of", "log(-1 - x^2)"}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        double value = 42;
        rig r;
        rig_open(&r);
        rig_surface(&r, &b, 8, 16);
        rig_measure(&r, table[k].measure);
        if (table[k].formula)
            rig_formula(&r, table[k].key, table[k].formula);
        else
            rig_vector(&r, table[k].key, 0, 0, 0);
        cr_assert(rig_try(&r, &value) == VES_NO_NUMBER && value == 42, "%s", table[k].measure);
        rig_close(&r);
    }
    static const char *const lost[] = {"height", "max_curvature", "draft_angle", "min_radius"};
    for (int k = 0; k < 4; k++) {
        double value = 42;
        rig r;
        rig_open(&r);
        rig_surface(&r, &b, 8, 16);
        for (int p = 0; p < RIG_PLANES; p++)
            for (int n = 0; n < 128; n++) r.plane[0].at[p][n] = NAN;
        rig_measure(&r, lost[k]);
        cr_assert(rig_try(&r, &value) == VES_NO_NUMBER && value == 42, "%s", lost[k]);
        rig_close(&r);
    }
}

/* What is not read need not be computed: no curvature where the formula has none, no area where nothing
 * weighs. */
Test(measure, asks_for_what_its_arguments_make_it_read_and_no_more)
{
    const struct {
        const char *measure, *formula;
        double smooth;
        unsigned want;
    } table[] = {{"min", "x + u", 0, VES_X},
                 {"min", "k2", 0, VES_CURVATURE},
                 {"min", "p*v", 0, VES_X},
                 {"max", "H*z", 0, VES_X | VES_CURVATURE},
                 {"max", "y", 0, VES_X},
                 {"max", "y", 3, VES_X | VES_AREA},
                 {"integral", "1", 0, VES_X | VES_AREA},
                 {"integral", "x^2 + y^2", 0, VES_X | VES_AREA},
                 {"integral", "K", 0, VES_AREA | VES_CURVATURE}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        rig r;
        rig_open(&r);
        rig_measure(&r, table[k].measure);
        rig_formula(&r, "of", table[k].formula);
        if (table[k].smooth > 0) rig_number(&r, "smooth", table[k].smooth);
        unsigned got = r.measure->needs(&r.args);
        cr_assert(got == table[k].want && !(got & ~r.measure->surface), "%s of %s: got %x, want %x",
                  table[k].measure, table[k].formula, got, table[k].want);
        rig_close(&r);
    }
    rig r;
    rig_open(&r);
    rig_measure(&r, "centroid");
    cr_assert(r.measure->needs(&r.args) == (VES_X | VES_AREA));
    rig_choice(&r, "of", 1);
    cr_assert(r.measure->needs(&r.args) == (VES_X | VES_AREA | VES_NORMAL));
    rig_close(&r);
}

Test(measure, only_the_centroid_of_a_volume_needs_a_closed_shape)
{
    rig r;
    rig_open(&r);
    rig_measure(&r, "centroid");
    cr_assert(!r.measure->closed && !r.measure->closes(&r.args));
    rig_choice(&r, "of", 1);
    cr_assert(r.measure->closes(&r.args));
    rig_close(&r);
}
