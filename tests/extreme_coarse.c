/* Extremes of surfaces that the grid does not resolve: what is reported is the value of the surface at a
 * point of it, no node lies beyond it, and the gradient is the derivative at that point. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "base/random.h"
#include "bed.h"
#include "plan/inside.h"

static double draw(ves_random *random, double low, double high)
{
    return low + (high - low) * ves_random_uniform(random);
}

static double measured(const bed *b, const double *x, int level)
{
    ves_design design;
    ves_status status = ves_plan_measure(b->plan, x, level, &design);
    cr_assert_eq(status, VES_OK, "%s", ves_status_text(status));
    return design.measure[0];
}

/* Where measure 0, an extent, was found: least and most. */
typedef struct found {
    int patch;
    double at[2];
} found;

static found found_at(const bed *b, int level, int end)
{
    const ves_measure_input *in = &b->plan->level[level].instance[0].input;
    const double *room = in->room + 4 * end;
    const ves_samples *s = in->sample[(int)room[0]];
    int node = (int)room[1];
    cr_assert(room[2] == 0 && room[3] == 0, "a promise: %g, %g from what was seen", room[2], room[3]);
    return (found){s->patch, {s->u[node % s->nu], s->v[node / s->nu]}};
}

/* d . X at a point, of the design last evaluated. */
static double along(const bed *b, const found *f, const double d[3])
{
    double X[18];
    cr_assert_eq(ves_plan_points(b->plan, f->patch, 1, &f->at[0], &f->at[1], X), VES_OK);
    return d[0] * X[0] + d[1] * X[1] + d[2] * X[2];
}

/* Rounding: of a hundred terms of the size of the surface. */
static void check_attained(const bed *b, const double *x, int level, const double d[3])
{
    double value = measured(b, x, level), size = 0, most = -HUGE_VAL, least = HUGE_VAL;
    found high = found_at(b, level, 0), low = found_at(b, level, 1);
    double top = along(b, &high, d), bottom = along(b, &low, d);
    const ves_measure_input *in = &b->plan->level[level].instance[0].input;
    for (int k = 0; k < in->first_look; k++)
        for (int n = 0; n < in->sample[k]->count; n++) {
            double *const *X = (double *const *)in->sample[k]->X, f = 0;
            for (int c = 0; c < 3; c++) f += d[c] * X[c][n];
            most = fmax(most, f), least = fmin(least, f), size = fmax(size, fabs(f));
        }
    size = fmax(size, fmax(fabs(top), fabs(bottom)));
    cr_expect(fabs(value - (top - bottom)) <= 1e-12 * size, "got %.16g, the surface there has %.16g", value,
              top - bottom);
    cr_expect(top >= most - 1e-12 * size && bottom <= least + 1e-12 * size,
              "from %.16g to %.16g, nodes from %.16g to %.16g", bottom, top, least, most);
}

/* Against differences of the two points, held where they are; of fourth order, h = 1e-3 of the variable. */
static void check_gradient(const bed *b, const double *x, int n, const double d[3])
{
    double gradient[8], constraint[1], at[8], side[4];
    ves_verdict verdict = {.constraint = constraint, .gradient = gradient};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE | VES_WANT_GRADIENT};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    cr_assert_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    found high = found_at(b, 0, 0), low = found_at(b, 0, 1);
    for (int k = 0; k < n; k++) {
        double h = 1e-3 * fabs(x[k]);
        memcpy(at, x, sizeof *x * (size_t)n);
        for (int i = 0; i < 4; i++) {
            at[k] = x[k] + (i < 2 ? i - 2 : i - 1) * h;
            measured(b, at, 0);
            side[i] = along(b, &high, d) - along(b, &low, d);
        }
        double want = (side[0] - 8 * side[1] + 8 * side[2] - side[3]) / (12 * h);
        cr_expect(fabs(gradient[k] - want) < 1e-6 * fmax(1, fabs(want)), "by %s: got %.12g, want %.12g",
                  b->problem->variable[k].name, gradient[k], want);
    }
}

static const int GRID[][2] = {{16, 16}, {8, 16}, {5, 9}, {24, 32}};
enum { GRIDS = sizeof GRID / sizeof *GRID };

/* Peaks of height 1, as narrow as 1/sqrt(q), between the nodes and beyond them. */
Test(extreme_coarse, a_peak_is_no_higher_than_it_is)
{
    const double y[3] = {0, 1, 0};
    for (int g = 0; g < GRIDS; g++) {
        bed b = bed_with("vesica: 1\n"
                         "variables: {q: [1, 100, 1e9], c: [0.01, 0.52, 0.99], w: [0.1, 3, 6]}\n"
                         "patches: {p: {surface: {formula: [\"u\", \"exp(-q*((u - c)^2 + (v - w)^2/40))\", "
                         "\"v\"]}, periodic: false}}\n"
                         "validity: {jacobian: any}\nminimize: height\n",
                         NULL, GRID[g][0], GRID[g][1]);
        for (uint64_t k = 0; k < 60; k++) {
            ves_random random = {.seed = 1000 * (uint64_t)g + k + 1};
            double x[3] = {pow(10, draw(&random, 0, 4)), draw(&random, 0.05, 0.95), draw(&random, 0.2, 6)};
            for (int level = 0; level < 2; level++) {
                check_attained(&b, x, level, y);
                double value = measured(&b, x, level);
                cr_expect(value <= 1 && value >= 0, "q = %g, c = %g: %.16g", x[0], x[1], value);
            }
            check_gradient(&b, x, 3, y);
        }
        bed_clear(&b);
    }
}

Test(extreme_coarse, a_ridge_is_no_higher_than_it_is)
{
    static const double q[] = {100, 500, 2000, 4000, 20000};
    bed b = bed_with("vesica: 1\nvariables: {q: [1, 100, 1e9], c: [0, 0.52, 1]}\n"
                     "patches: {p: {surface: {formula: [\"u\", \"exp(-q*(u - c)^2)\", \"v\"]}, periodic: "
                     "false}}\nvalidity: {jacobian: any}\nminimize: height\n",
                     NULL, 16, 16);
    for (int k = 0; k < 5; k++) {
        double x[2] = {q[k], 0.52}, value = measured(&b, x, 0);
        cr_expect(value <= 1 && value > 0.5, "q = %g: %.16g", q[k], value);
    }
    bed_clear(&b);
}

/* A biharmonic tube whose walls fall away from its rims like (1 + a u) e^(-a u). */
#define RIMS                                                                                                 \
    "vesica: 1\n"                                                                                            \
    "variables: {a: [0.1, 1, 1100], r: [0.1, 1, 3], t: [-2, 0.3, 2], s: [0.1, 1, 3]}\n"                      \
    "curves:\n"                                                                                              \
    "  low: {ellipse: {radii: [r, 1]}}\n"                                                                    \
    "  high: {like: low, apply: [{rotate: [t, 0, 0]}, {translate: [0.3, 0, 2*s]}]}\n"                        \
    "  up: {formula: [\"0\", \"0\", \"1\"]}\n"                                                               \
    "patches:\n  wall: {operator: {power: 2, a: a}, conditions: [{u: 0, position: low}, {u: 0, derivative: " \
    "1, field: up}, {u: 1, position: high}, {u: 1, derivative: 1, field: up}]}\n"                            \
    "validity: {jacobian: any}\n"

Test(extreme_coarse, walls_that_fall_away_from_their_rims)
{
    static const double e[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.36, -0.48, 0.8}};
    static const char *const what[] = {"width", "height", "depth", "E"};
    for (int m = 0; m < 4; m++)
        for (int g = 0; g < GRIDS; g++) {
            char text[2000] = RIMS "measures: {E: {extent: {along: [0.36, -0.48, 0.8]}}}\nminimize: ";
            if (m < 3) strcpy(text, RIMS "minimize: ");
            strcat(text, what[m]);
            bed b = bed_with(text, NULL, GRID[g][0], GRID[g][1]);
            for (uint64_t k = 0; k < 12; k++) {
                ves_random random = {.seed = 1000 * (uint64_t)g + k + 1};
                double x[4] = {pow(10, draw(&random, 0, 3)), draw(&random, 0.3, 2), draw(&random, 0.1, 1),
                               draw(&random, 0.3, 2)};
                for (int level = 0; level < 2; level++) check_attained(&b, x, level, e[m]);
                check_gradient(&b, x, 4, e[m]);
            }
            bed_clear(&b);
        }
}

/* Nothing is wider than the two unit circles at the ends, and they are found though hardly a node shows them.
 */
Test(extreme_coarse, the_width_of_a_tube_is_that_of_its_rims)
{
    static const double a[] = {1, 30, 100, 300, 500, 700, 1000};
    for (int g = 0; g < GRIDS; g++) {
        bed b = bed_with(RIMS "minimize: height\n", NULL, GRID[g][0], GRID[g][1]);
        for (int k = 0; k < 7; k++) {
            double x[4] = {a[k], 1, 0, 1}, value = measured(&b, x, 0);
            cr_expect(fabs(value - 2) < 1e-12, "a = %g: %.16g", a[k], value);
        }
        bed_clear(&b);
    }
}
