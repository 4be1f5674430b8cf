/* Every gradient against differences: by single plane entries and numbers, and along families of shapes. */
#include "samples.h"

/* Central differences with steps of 1e-5: truncation (1e-5)^2 times third derivatives up to 1e2, rounding
 * 1e-16 / 1e-5 times the value. */
static const double STEP = 1e-5, TOLERANCE = 2e-7;

/* One way to use a measure. */
typedef struct use {
    const char *measure, *formula;
    double smooth;
    int choice;
    bool along, axis, curves, plane;
    struct {
        const char *key;
        double value;
    } numbers[4];
} use;

static const use USES[] = {
    {.measure = "area"},
    {.measure = "volume"},
    {.measure = "bending"},
    {.measure = "willmore"},
    {.measure = "mean_curvature"},
    {.measure = "gauss_curvature"},
    {.measure = "max_curvature"},
    {.measure = "max_curvature", .smooth = 2},
    {.measure = "max_curvature", .smooth = 7.5},
    {.measure = "width"},
    {.measure = "height"},
    {.measure = "depth"},
    {.measure = "extent", .along = true},
    {.measure = "centroid", .along = true, .choice = 0},
    {.measure = "centroid", .along = true, .choice = 1},
    {.measure = "centroid", .choice = 1},
    {.measure = "distance"},
    {.measure = "distance", .curves = true},
    {.measure = "integral", .formula = "p*x*y + sin(q*z)*H^2 + K*u - k1*v*k2^2 + p*q"},
    {.measure = "integral", .formula = "3"},
    {.measure = "integral", .formula = "p*x*y + sin(q*z)"},
    {.measure = "integral", .formula = "q*k1^2 + u*K"},
    {.measure = "max", .formula = "p*x - z*v"},
    {.measure = "max", .formula = "p*x - z*y", .smooth = 4},
    {.measure = "min", .formula = "q*H + k2 + 0.01*v"},
    {.measure = "min", .formula = "q*u^2 + v"},
    {.measure = "max", .formula = "p*x + q*y^2 + 0.1*H*k1 - z*K"},
    {.measure = "min", .formula = "p*x + q*y^2 + 0.1*H*k1 - z*K"},
    {.measure = "max", .formula = "k1*p + x*q*u - k2 + v", .smooth = 3},
    {.measure = "max", .formula = "k1*p + x*q*u - k2 + v - 2", .smooth = 6.5},
    {.measure = "canham"},
    {.measure = "canham", .numbers = {{"kappa", 0.7}, {"c0", 0.6}, {"kappa_g", -0.4}}},
    {.measure = "canham", .numbers = {{"kappa", 1.3}, {"reduced_c0", 2.1}}},
    {.measure = "canham", .numbers = {{"c0", -0.3}, {"reduced_c0", 1.1}, {"kappa_g", 0.2}}},
    {.measure = "area_difference"},
    {.measure = "reduced_volume"},
    {.measure = "ade", .numbers = {{"kappa", 0.7}, {"reduced_c0", 0.9}, {"alpha", 1.4}, {"m0", 1.2}}},
    {.measure = "ade", .numbers = {{"c0", 0.9}, {"alpha", 0.2}, {"m0", 1.7}, {"kappa_g", 0.3}}},
    {.measure = "adhesion", .numbers = {{"w", 0.8}, {"range", 1.9}}, .plane = true},
    {.measure = "line_tension", .numbers = {{"sigma", 0.6}}, .curves = true},
    {.measure = "draft_angle", .axis = true},
    {.measure = "draft_angle", .axis = true, .smooth = 4.5},
    {.measure = "undercut", .axis = true},
    {.measure = "undercut"},
    {.measure = "min_radius"},
    {.measure = "min_radius", .choice = 2},
    {.measure = "fill_volume", .axis = true, .numbers = {{"height", 0.3}}},
    {.measure = "fill_volume", .axis = true, .numbers = {{"below", 0.4}}},
    {.measure = "fill_volume", .axis = true, .numbers = {{"height", 0.3}, {"below", 0.1}}},
    {.measure = "brimful_volume", .axis = true},
    {.measure = "nesting_pitch", .axis = true, .numbers = {{"thickness", 0.15}}},
    {.measure = "brimful_volume", .axis = true, .curves = true},
};

enum { COUNT = sizeof USES / sizeof *USES };

static void furnish(rig *r, const use *how, const body *b)
{
    body far = body_moved(*b, 77);
    const ves_measure *measure = ves_measure_find(how->measure, NULL);
    cr_assert(measure != NULL, "%s", how->measure);
    for (int c = 0; c < 3; c++) far.shift[c] += 3 + c;
    if (measure->surface) rig_surface(r, b, 8, 12), rig_surface(r, &far, 4, 9);
    if (measure->cap) rig_ring(r, b, 0, 12, -1), rig_ring(r, b, 1, 12, 1);
    if (measure->curve && how->curves) rig_ring(r, b, 0.2, 12, 0);
    if (measure->curve && !how->curves) rig_place(r, b, 0.4, 1.1);
    if (measure->curve) rig_ring(r, &far, 0.7, 15, 0);
    rig_measure_with(r, measure);
    if (how->formula) rig_formula(r, "of", how->formula);
    if (how->smooth > 0) rig_number(r, "smooth", how->smooth);
    if (how->along) rig_vector(r, "along", 0.4, -1.3, 0.7);
    if (how->axis) rig_vector(r, "axis", 0.4, -1.3, 0.7);
    if (how->curves && !strcmp(how->measure, "brimful_volume")) rig_key(r, "rim")->given = true;
    if (!strcmp(how->measure, "min_radius")) rig_choice(r, "side", how->choice);
    if (!strcmp(how->measure, "centroid")) rig_choice(r, "of", how->choice);
    if (how->plane) rig_vector(r, "at", 0.3, -0.2, 0.1), rig_vector(r, "normal", 0.3, 0.5, 1.1);
    if (!strcmp(how->measure, "line_tension")) rig_key(r, "curve")->given = true;
    for (int k = 0; k < 4 && how->numbers[k].key; k++)
        rig_number(r, how->numbers[k].key, how->numbers[k].value);
}

static double difference(rig *r, double *place)
{
    double keep = *place, up, down;
    *place = keep + STEP, up = rig_eval(r);
    *place = keep - STEP, down = rig_eval(r);
    *place = keep;
    return (up - down) / (2 * STEP);
}

static void compare(const use *how, double got, double want, const char *kind, int plane, int node)
{
    cr_assert(fabs(got - want) <= TOLERANCE * fmax(1, fabs(want)),
              "%s (%s): %s %d node %d: got %.12g, want %.12g", how->measure, how->formula ? how->formula : "",
              kind, plane, node, got, want);
}

/* All entries with an adjoint (they are few for an extreme), and some of the others. */
static void check_site(rig *r, const use *how, int i, double seed)
{
    ves_random random = {.seed = 17};
    int count = r->site[i].count, checked = 0;
    const planes back = r->back[i];
    for (int k = 0; k < RIG_PLANES; k++)
        for (int n = 0; n < count; n++) {
            double got = back.at[k][n];
            bool pick = ves_random_uniform(&random) < (got != 0 && count > 20 ? 0.15 : got != 0 ? 1 : 0.04);
            if (!pick && !(got != 0 && checked < 30)) continue;
            checked++;
            compare(how, got, seed * difference(r, &r->plane[i].at[k][n]), "plane", k, n);
        }
}

/* Fallbacks stand in the block, but a measure does not follow them. */
static void check_numbers(rig *r, const use *how, double seed)
{
    for (int n = 0; n < r->numbers; n++) {
        bool moves = n < RIG_SLOTS && how->formula;
        for (int k = 0; k < r->args.count; k++)
            moves |= r->arg[k].given && n >= r->arg[k].first && n < r->arg[k].first + r->arg[k].count;
        compare(how, r->number_back[n], moves ? seed * difference(r, &r->number[n]) : 0, "number", 0, n);
    }
}

Test(measure_gradient, agrees_with_differences_in_every_plane_and_number)
{
    double seed = -1.7;
    for (int k = 0; k < COUNT; k++) {
        rig r;
        body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 3);
        rig_open(&r);
        furnish(&r, &USES[k], &b);
        rig_eval(&r);
        rig_gradient(&r, seed);
        for (int i = 0; i < r.samples; i++) check_site(&r, &USES[k], i, seed);
        check_numbers(&r, &USES[k], seed);
        rig_close(&r);
    }
}

static double contract(const rig *r, const rig *up, const rig *down, double step)
{
    double sum = 0;
    for (int i = 0; i < r->samples; i++)
        for (int k = 0; k < RIG_PLANES; k++)
            for (int n = 0; n < r->site[i].count; n++)
                sum += r->back[i].at[k][n] * (up->plane[i].at[k][n] - down->plane[i].at[k][n]) / (2 * step);
    return sum;
}

/* d J along a family of bodies, through all planes at once, against the difference of J itself. */
static void check_family(const use *how, const body *b, int parameter, double step, double tolerance)
{
    rig at[3];
    double value[3];
    for (int k = 0; k < 3; k++) {
        body moved = *b;
        moved.p[parameter] += (k - 1) * step;
        rig_open(&at[k]);
        furnish(&at[k], how, &moved);
        value[k] = rig_eval(&at[k]);
    }
    rig_gradient(&at[1], 1);
    double got = contract(&at[1], &at[2], &at[0], step), want = (value[2] - value[0]) / (2 * step);
    cr_assert(fabs(got - want) <= tolerance * fmax(1, fabs(want)), "%s (%s) by p[%d]: got %.12g, want %.12g",
              how->measure, how->formula ? how->formula : "", parameter, got, want);
    for (int k = 0; k < 3; k++) rig_close(&at[k]);
}

Test(measure_gradient, carries_through_all_planes_along_a_family_of_shapes)
{
    for (int k = 0; k < COUNT; k++)
        for (int parameter = 0; parameter < 3; parameter++) {
            body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 3);
            check_family(&USES[k], &b, parameter, STEP, TOLERANCE);
        }
}

/* Two nodes that mirror each other are the most hollow: a change of one alone meets a kink, a change of the shape does
 * not. */
Test(measure_gradient, follows_the_most_hollow_place_of_a_symmetric_shape)
{
    const use hollow = {.measure = "min_radius", .choice = 1};
    for (int parameter = 0; parameter < 3; parameter++) {
        body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 3);
        check_family(&hollow, &b, parameter, STEP, TOLERANCE);
    }
}

/* At a sphere k1 = k2 everywhere: measures that treat them alike are smooth there, and their gradients must
 * hold. Steps of 1e-4, since s = sqrt(H^2 - K) is rounding below 1e-8. */
Test(measure_gradient, holds_at_umbilics_for_symmetric_functions)
{
    static const use symmetric[] = {{.measure = "max_curvature", .smooth = 2},
                                    {.measure = "max_curvature", .smooth = 6},
                                    {.measure = "integral", .formula = "k1^2 + k2^2"},
                                    {.measure = "integral", .formula = "(k1*k2)^2 + exp(k1) + exp(k2)"},
                                    {.measure = "max", .formula = "k1 + k2", .smooth = 4}};
    body ball = body_init(ellipsoid, 1, 2.385, 2.385, 2.385);
    for (int k = 0; k < 5; k++)
        for (int parameter = 0; parameter < 3; parameter++)
            check_family(&symmetric[k], &ball, parameter, 1e-4, 1e-6);
}

/* A site that depends on no variable has NULL planes in its adjoint; numbers still count. */
Test(measure_gradient, leaves_constant_sites_alone)
{
    for (int k = 0; k < COUNT; k++) {
        rig r;
        body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 3);
        double want[RIG_NUMBERS];
        rig_open(&r);
        furnish(&r, &USES[k], &b);
        rig_eval(&r);
        rig_gradient(&r, 1);
        memcpy(want, r.number_back, sizeof want);
        memset(r.number_back, 0, sizeof r.number_back);
        ves_measure_input input = rig_input(&r);
        memset(r.adjoint, 0, sizeof r.adjoint);
        r.measure->gradient(&input, 1, r.adjoints, r.number_back);
        for (int n = 0; n < RIG_NUMBERS; n++)
            cr_assert(r.number_back[n] == want[n], "%s: number %d: got %g, want %g", USES[k].measure, n,
                      r.number_back[n], want[n]);
        rig_close(&r);
    }
}
