/* Which ends of walks are one, and where the best goes from one to another, of points made by hand. */
#include <criterion/criterion.h>
#include <math.h>

#include "bed.h"
#include "study/sweep_report.h"

enum { COUNT = 5, COLUMNS = 16 };

/* Measures: A in m^2, H in m (its natural size is 3.5 m), without an effect of y. */
static const char text[] =
    "vesica: 1\nparameters: {t: 0, s: 1 m}\nvariables: {x: [-1 m, 0.5 m, 1 m], y: [0, 0.5, 1]}\n"
    "curves: {low: {circle: {radius: s}, apply: [{translate: [y*s, 0 m, 0 m]}]}, high: {like: low, apply: "
    "[{translate: [0 m, 0 m, 2 m + x]}]}}\n"
    "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "
    "high}]}}\n"
    "measures: {A: area, H: mean_curvature}\nminimize: A + t*s^2\nconstraints: [A <= 100 m^2]\n"
    "sweep: {over: {t: {from: 0, to: 4, count: 5, walk: both}}}\n";

typedef struct made {
    bed b;
    ves_sweep sweep;
    ves_sweep_walk walk[2];
    ves_sweep_point point[2 * COUNT];
    double column[2 * COUNT][COLUMNS];
} made;

/* Two walks of good points with A = 10, H = 1 at x = 0, y = 0 and 1: at one place one optimum each. */
static void make(made *m)
{
    *m = (made){.b = bed_with(text, NULL, 8, 8), .walk = {{.name = "up"}, {.back = true, .name = "down"}}};
    const ves_problem *p = m->b.problem;
    ves_sweep *s = &m->sweep;
    *s = (ves_sweep){
        .problem = p, .def = p->sweep, .walks = 2, .count = COUNT, .walk = m->walk, .point = m->point};
    const int size[VES_SWEEP_GROUPS] = {1, 1, p->variables, p->unknowns, p->measures, 1, 1, 1};
    for (int g = 0; g < VES_SWEEP_GROUPS; g++) s->first[g + 1] = s->first[g] + size[g];
    cr_assert(s->first[VES_SWEEP_GROUPS] <= COLUMNS && p->measures == 2 && p->variables == 2);
    for (int k = 0; k < 2 * COUNT; k++) {
        double *c = m->column[k];
        m->point[k] = (ves_sweep_point){.done = true, .good = true, .column = c};
        c[0] = c[s->first[VES_SWEEP_MEASURE]] = 10;
        c[s->first[VES_SWEEP_MEASURE] + 1] = 1;
        c[s->first[VES_SWEEP_VARIABLE] + 1] = k / COUNT;
    }
}

static double *column(made *m, int walk, int place, ves_sweep_group group)
{
    return m->column[ves_sweep_point_at(&m->sweep, walk, place)] + m->sweep.first[group];
}

static ves_sweep_point *point(made *m, int walk, int place)
{
    return &m->point[ves_sweep_point_at(&m->sweep, walk, place)];
}

static bool one(made *m, int place)
{
    cr_assert_eq(ves_sweep_compare(&m->sweep), VES_OK);
    return point(m, 0, place)->optimum == point(m, 1, place)->optimum;
}

/* y is such that nothing feels it; what a measure feels by less than a thousandth of what it comes to is not felt. */
Test(sweep_compare, measures_tell_ends_apart)
{
    made m;
    make(&m);
    double *H = column(&m, 1, 2, VES_SWEEP_MEASURE) + 1, *other = column(&m, 0, 2, VES_SWEEP_MEASURE) + 1;
    cr_expect(one(&m, 2));
    *H = 1.0009;
    cr_expect(one(&m, 2));
    *H = 1.0021;
    cr_expect(one(&m, 2) == false);
    *H = 1e-4, *other = -1e-4; /* on its way through zero */
    cr_expect(one(&m, 2));
    *H = 2e-3;
    cr_expect(one(&m, 2) == false);
    *column(&m, 1, 2, VES_SWEEP_VARIABLE) = *column(&m, 0, 2, VES_SWEEP_VARIABLE) + 1e-3;
    cr_expect(one(&m, 2) == false);
    column(&m, 1, 2, VES_SWEEP_VARIABLE)[1] = 1e-3; /* of a range of 1; x of 2 m */
    cr_expect(one(&m, 2), "the variables are the same");
    bed_clear(&m.b);
}

/* Everywhere what rounding leaves of a zero. */
Test(sweep_compare, zeros_tell_nothing)
{
    made m;
    make(&m);
    for (int w = 0; w < 2; w++)
        for (int k = 0; k < COUNT; k++)
            column(&m, w, k, VES_SWEEP_MEASURE)[1] = (w ? 1e-17 : -3e-17) * (1 + k);
    for (int k = 0; k < COUNT; k++) cr_expect(one(&m, k));
    column(&m, 1, 2, VES_SWEEP_MEASURE)[1] = 3e-9; /* of 3.5 m: below 1e-9 of it */
    cr_expect(one(&m, 2));
    column(&m, 1, 2, VES_SWEEP_MEASURE)[1] = 5e-9;
    cr_expect(one(&m, 2) == false);
    bed_clear(&m.b);
}

/* By 1 in y the objective may fall by no more than the slope. */
Test(sweep_compare, slopes_that_are_left)
{
    made m;
    make(&m);
    *column(&m, 1, 1, VES_SWEEP_OBJECTIVE) = 10 + 0.9e-5;
    cr_expect(one(&m, 1));
    *column(&m, 1, 1, VES_SWEEP_OBJECTIVE) = 10 + 3e-5;
    cr_expect(one(&m, 1) == false);
    point(&m, 1, 1)->slope = 3e-5;
    cr_expect(one(&m, 1));
    column(&m, 1, 1, VES_SWEEP_MEASURE)[1] = 1.5; /* which the slope leaves open */
    cr_expect(one(&m, 1) && point(&m, 0, 1)->best && !point(&m, 1, 1)->best);
    *column(&m, 0, 1, VES_SWEEP_OBJECTIVE) = 10 + 5e-5;
    cr_expect(one(&m, 1) && point(&m, 1, 1)->best && !point(&m, 0, 1)->best, "the better one of one optimum");
    *column(&m, 0, 1, VES_SWEEP_OBJECTIVE) = 10;
    column(&m, 1, 1, VES_SWEEP_MEASURE)[1] = 1;
    point(&m, 1, 1)->slope = 1e-5;
    cr_expect(one(&m, 1) == false);
    point(&m, 1, 1)->slope = NAN;
    cr_expect(one(&m, 1) == false);
    bed_clear(&m.b);
}

/* up is the best at 0 and 1, down at 3 and 4; 2 is lost. Lines through 10, 14 and 11, 11 cross at a quarter of the way. */
Test(sweep_compare, a_change_across_a_gap)
{
    made m;
    ves_sweep_change c;
    make(&m);
    for (int k = 0; k < COUNT; k++) {
        double *up = column(&m, 0, k, VES_SWEEP_OBJECTIVE), *down = column(&m, 1, k, VES_SWEEP_OBJECTIVE);
        *up = k < 2 ? 10 : 14, *down = 11;
        point(&m, 0, k)->good = point(&m, 1, k)->good = k != 2;
    }
    cr_assert_eq(ves_sweep_compare(&m.sweep), VES_OK);
    cr_assert(ves_sweep_change_find(&m.sweep, 0, 0, &c));
    cr_expect(c.place == 1 && c.next == 3 && c.from == 0 && c.to == 1);
    cr_expect(fabs(c.at - 1.5) < 1e-12, "%.17g", c.at);
    cr_expect(ves_sweep_change_find(&m.sweep, 0, c.next, &c) == false);
    point(&m, 0, 3)->good = false; /* one line is not known there any more */
    cr_assert_eq(ves_sweep_compare(&m.sweep), VES_OK);
    cr_assert(ves_sweep_change_find(&m.sweep, 0, 0, &c) && c.next == 3);
    cr_expect(isnan(c.at));
    bed_clear(&m.b);
}
