/* What a search ends in: saddles that are none, saddles that lead nowhere, edges, what is listed as an
 * optimum. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* ---- an equation written as two opposite inequalities ---- */

/* f = x^2 - 3 y^2 on y = 0.5: a minimum, though f has negative curvature across the line. `swap`: which comes
 * first, with different sizes as after a division by their own scales. */
static ves_status trough(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    int upper = *(int *)data, lower = !upper;
    v->value = x * x - 3 * y * y;
    v->constraint[upper] = 0.7 * (y - 0.5);
    v->constraint[lower] = 1.3 * (0.5 - y);
    if (!g) return VES_OK;
    g[0] = 2 * x, g[1] = -6 * y;
    v->jacobian[2 * upper] = v->jacobian[2 * lower] = 0;
    v->jacobian[2 * upper + 1] = 0.7;
    v->jacobian[2 * lower + 1] = -1.3;
    return VES_OK;
}

Test(ends, two_opposite_inequalities_are_an_equation)
{
    for (int swap = 0; swap < 2; swap++) {
        given g = {.evaluate = trough,
                   .n = 2,
                   .m = 2,
                   .lower = {-2, -1},
                   .upper = {1.7, 2},
                   .start = {0.9, 0.1},
                   .gradients = true,
                   .data = &swap};
        ves_search_options o = ves_search_options_default();
        for (o.seed = 1; o.seed <= 5; o.seed++) {
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            /* the slope across the line, 3, times violations that cost nothing, 1e-10 */
            cr_expect(r->feasible && fabs(r->value + 0.75) < 1e-9, "swap %d: %.12g", swap, r->value);
            cr_expect(r->optima == 1 && !r->optimum[0].saddle && !r->notes, "%d optima; %s", r->optima,
                      r->notes ? r->note[0] : "");
            ves_search_result_destroy(r);
        }
    }
}

/* f = -x^2 on the unit circle, written twice: its top is a saddle all the same. */
static ves_status ring(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = -x * x;
    v->constraint[0] = x * x + y * y - 1;
    v->constraint[1] = -v->constraint[0];
    if (!g) return VES_OK;
    g[0] = -2 * x, g[1] = 0;
    for (int k = 0; k < 2; k++) {
        v->jacobian[2 * k] = (k ? -2 : 2) * x;
        v->jacobian[2 * k + 1] = (k ? -2 : 2) * y;
    }
    return VES_OK;
}

Test(ends, a_saddle_between_two_opposite_inequalities_is_left)
{
    given g = {.evaluate = ring,
               .n = 2,
               .m = 2,
               .lower = {-2, -2},
               .upper = {2, 2},
               .start = {0, 1},
               .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(fabs(r->value + 1) < 1e-9 && r->optima == 2, "%.12g, %d optima", r->value, r->optima);
    cr_expect(noted(r, "left it both ways") != NULL);
    ves_search_result_destroy(r);
}

/* ---- only feasible directions count ---- */

/* f = x y + (x^2 + y^2) / 4 with x, y >= 0 as constraints that do not pull at 0: negative curvature along
 * (1, -1), which leaves the quadrant on either side. */
static ves_status quadrant(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = x * y + (x * x + y * y) / 4;
    v->constraint[0] = -x, v->constraint[1] = -y;
    if (!g) return VES_OK;
    g[0] = y + x / 2, g[1] = x + y / 2;
    v->jacobian[0] = v->jacobian[3] = -1;
    v->jacobian[1] = v->jacobian[2] = 0;
    return VES_OK;
}

Test(ends, curvature_along_infeasible_ways_is_no_saddle)
{
    given g = {.evaluate = quadrant,
               .n = 2,
               .m = 2,
               .lower = {-1, -1},
               .upper = {1.5, 2},
               .start = {0.3, 0.2},
               .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(r->feasible && fabs(r->value) < 1e-10, "value %g", r->value); /* of second order in 1e-9 */
    cr_expect(r->optima == 1 && !r->optimum[0].saddle && !r->notes, "%s", r->notes ? r->note[0] : "");
    ves_search_result_destroy(r);
}

/* ---- zero is no curvature ---- */

/* f = offset + y / 3 + 0.7 z with y >= +-x^3: least at a cusp where nothing bends; the slope along the fourth
 * variable is the rounding of 0. */
static ves_status corner(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    const double *x = ask->x, third = 1.0 / 3;
    double offset = *(double *)data, *g = gradient_of(ask, v);
    v->value = offset + third * x[1] + 0.7 * x[2];
    v->constraint[0] = x[0] * x[0] * x[0] - x[1];
    v->constraint[1] = -x[0] * x[0] * x[0] - x[1];
    if (!g) return VES_OK;
    g[0] = 0, g[1] = third, g[2] = 0.7, g[3] = 1e-17 * sin(1e6 * x[3]);
    for (int k = 0; k < 2; k++) {
        double *slope = v->jacobian + 4 * k;
        slope[0] = (k ? -3 : 3) * x[0] * x[0], slope[1] = -1, slope[2] = slope[3] = 0;
    }
    return VES_OK;
}

Test(ends, rounding_is_no_curvature)
{
    double offset[] = {0, 13, -1e6};
    for (int k = 0; k < 3; k++) {
        given g = {.evaluate = corner,
                   .n = 4,
                   .m = 2,
                   .lower = {-3, -3, 0.5, -1},
                   .upper = {3, 3, 2, 1.3},
                   .start = {0.2, 0.4, 1, 0.1},
                   .gradients = true,
                   .data = &offset[k]};
        ves_search_options o = ves_search_options_default();
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        /* the slope across a constraint times violations that cost nothing, 1e-10 */
        cr_expect(r->feasible && fabs(r->value - offset[k] - 0.35) < 1e-9 * fmax(1, fabs(offset[k])), "%.12g",
                  r->value);
        /* the cube of x[0] has an inflection, which a descent may meet and leave; the rounding in x[3] has none */
        cr_expect(noted(r, "mostly x[3]") == NULL, "%s", noted(r, "mostly x[3]"));
        for (int i = 0; i < r->optima; i++) cr_expect(r->optimum[i].saddle == false);
        ves_search_result_destroy(r);
    }
}

/* The least curvature that counts: of 1e-9 of the objective it still does. */
static ves_status faint(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], *g = gradient_of(ask, v);
    v->value = 1 + 1e-7 * (x * x * x * x - x * x);
    if (g) g[0] = 1e-7 * (4 * x * x * x - 2 * x);
    return VES_OK;
}

Test(ends, a_faint_saddle_is_left_all_the_same)
{
    given g = {.evaluate = faint, .n = 1, .lower = {-1}, .upper = {1}, .start = {0}, .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(fabs(r->value - (1 - 0.25e-7)) < 1e-12 && r->optima == 2, "%.12g", r->value); /* f_tolerance */
    ves_search_result_destroy(r);
}

/* ---- kinks ---- */

/* The largest of three |.|, convex, or, to compare, the sum of their squares, which is smooth. */
static ves_status ridge(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    const double row[3][3] = {{1, -2, 0}, {3, 1, 0}, {0.01, 0.01, 0.01}}, *x = ask->x;
    bool smooth = *(bool *)data;
    double *g = gradient_of(ask, v), part[3];
    int most = 0;
    v->value = 0;
    for (int k = 0; k < 3; k++) {
        part[k] = row[k][0] * x[0] + row[k][1] * x[1] + row[k][2] * x[2] - (k == 1);
        v->value = smooth ? v->value + part[k] * part[k] : fmax(v->value, fabs(part[k]));
        if (fabs(part[k]) > fabs(part[most])) most = k;
    }
    for (int i = 0; g && i < 3; i++) g[i] = part[most] > 0 ? row[most][i] : -row[most][i];
    for (int i = 0; g && smooth && i < 3; i++)
        g[i] = 2 * (part[0] * row[0][i] + part[1] * row[1][i] + part[2] * row[2][i]);
    return VES_OK;
}

Test(ends, kinks_are_told_and_are_no_list_of_optima)
{
    for (int k = 0; k < 2; k++) {
        bool smooth = k;
        given g = {.evaluate = ridge,
                   .n = 3,
                   .lower = {-3, -3, 0.5},
                   .upper = {3, 3, 2},
                   .start = {2, -1, 1},
                   .gradients = true,
                   .data = &smooth};
        ves_search_options o = ves_search_options_default();
        for (o.seed = 1; o.seed <= 5; o.seed++) {
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            cr_expect(r->feasible && r->optima == 1, "smooth %d: %d optima", k, r->optima);
            bool told = noted(r, "slope has not vanished"), converged = strstr(r->stop, "converged");
            cr_expect(told != smooth, "smooth %d: %s", k, r->notes ? r->note[0] : "no note");
            cr_expect(converged == smooth, "smooth %d: %s", k, r->stop);
            ves_search_result_destroy(r);
        }
    }
}

/* A polish that begins at its end, with hardly a slope, has converged all the same, be the objective 0 there or
 * far from 0. */
static ves_status bowl(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    double x = ask->x[0] - 0.3, y = ask->x[1] - sqrt(0.5), *g = gradient_of(ask, v);
    v->value = *(double *)data + x * x + 100 * y * y + x * x * y;
    if (g) g[0] = 2 * x + 2 * x * y, g[1] = 200 * y + x * x;
    return VES_OK;
}

Test(ends, a_polish_that_begins_at_its_end_is_at_no_kink)
{
    double offset[] = {0, 1e-9, 1, 1e6};
    const double apart[] = {0, 1e-10, 1e-7, 1e-4};
    for (int k = 0; k < 16; k++) {
        double off = apart[k / 4];
        given g = {.evaluate = bowl,
                   .n = 2,
                   .lower = {-1, -1},
                   .upper = {1, 2},
                   .start = {0.3 + off, sqrt(0.5) - off},
                   .gradients = true,
                   .data = &offset[k % 4]};
        ves_search_options o = only_polish("slsqp");
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_expect(noted(r, "slope") == NULL, "offset %g, apart %g: %s", offset[k % 4], off,
                  noted(r, "slope"));
        ves_search_result_destroy(r);
    }
}

/* ---- nothing is lost ---- */

/* A saddle at 0; what lies lower does not pass its proof. */
static ves_status guarded_saddle(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    if ((ask->want & VES_WANT_PROOF) && fabs(x) > 0.5) return VES_SELF_INTERSECTS;
    v->value = x * x * x * x / 4 - x * x / 2 + y * y;
    if (g) g[0] = x * x * x - x, g[1] = 2 * y;
    return VES_OK;
}

Test(ends, a_saddle_is_kept_when_what_lies_lower_is_refused_and_the_edge_is_found)
{
    given g = {.evaluate = guarded_saddle,
               .n = 2,
               .lower = {-2, -3},
               .upper = {2, 2},
               .start = {0, 1},
               .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    /* f(0.5), whose slope is 3/8; a point within 1e-5 of the box, 4, of one that was refused
     * is not asked, and that one may lie 1e-5 beyond the edge */
    cr_expect(r->feasible && fabs(r->value + 0.109375) < 8e-5 * 3 / 8, "value %.12g", r->value);
    cr_expect(r->optima == 2 && r->optimum[1].saddle && fabs(r->optimum[1].value) < 1e-12, "%d", r->optima);
    cr_expect(noted(r, "better designs were refused") && strstr(r->stop, "refused by its proof"), "%s",
              r->stop);
    ves_search_result_destroy(r);
}

/* ---- beside the edge of what can be measured ---- */

enum { ROOT, LOGARITHM };

static ves_status edge(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    bool root = *(int *)data == ROOT;
    double x = ask->x[0] - 0.329, y = ask->x[1], *g = gradient_of(ask, v);
    if (!(x > 0)) return VES_NO_NUMBER;
    v->value = (root ? x + sqrt(x) : log(x)) + y * y;
    if (g) g[0] = root ? 1 + 0.5 / sqrt(x) : 1 / x, g[1] = 2 * y;
    return VES_OK;
}

Test(ends, nothing_is_said_of_saddles_beside_an_edge)
{
    for (int kind = ROOT; kind <= LOGARITHM; kind++) {
        given g = {.evaluate = edge,
                   .n = 2,
                   .lower = {-2, -2},
                   .upper = {3, 3},
                   .start = {1.7, 1.1},
                   .gradients = true,
                   .data = &kind};
        ves_search_options o = ves_search_options_default();
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_expect(noted(r, "curvature") == NULL, "%s", noted(r, "curvature"));
        cr_expect(noted(r, "(along x[0]: a measure is not a finite number)") &&
                      noted(r, "could not be judged"),
                  "%d notes", r->notes);
        cr_expect(noted(r, "runs into that edge") != NULL);
        for (int k = 0; k < r->optima; k++) cr_expect(r->optimum[k].saddle == false);
        ves_search_result_destroy(r);
    }
}

/* ---- the list of optima ---- */

/* f = x where c <= 0: c has a well that goes below 0 and one that does not, where descents stay. */
static ves_status wells(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    double x = ask->x[0], *g = gradient_of(ask, v);
    (void)worker;
    v->value = x;
    v->constraint[0] = x * x * x * x / 4 - x * x / 2 - 0.1 * x + 0.25 + *(double *)data;
    if (!g) return VES_OK;
    g[0] = 1;
    v->jacobian[0] = x * x * x - x - 0.1;
    return VES_OK;
}

Test(ends, only_feasible_ends_are_optima)
{
    double lift = 0;
    given g = {.evaluate = wells,
               .n = 1,
               .m = 1,
               .lower = {-2},
               .upper = {2},
               .start = {-1.3},
               .gradients = true,
               .data = &lift};
    ves_search_options o = only_anneal(60);
    o.stage[0].anneal.chains = 8;
    o.stages = 2;
    o.stage[1] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = ves_polish_default()};
    for (o.seed = 1; o.seed <= 20; o.seed++) {
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_expect(r->optima == r->feasible, "%d optima, feasible %d", r->optima, r->feasible);
        for (int k = 0; k < r->optima; k++)
            cr_expect(r->optimum[k].violation <= 1e-6, "violation %g", r->optimum[k].violation);
        ves_search_result_destroy(r);
    }
    lift = 0.2; /* none is feasible */
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(r->any && !r->feasible && r->optima == 0);
    ves_search_result_destroy(r);
}

/* f = (x y - 1)^2: least on a curve, which only the caller knows to be one design. */
static ves_status curve(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v), t = x * y - 1;
    v->value = t * t;
    if (g) g[0] = 2 * t * y, g[1] = 2 * t * x;
    return VES_OK;
}

static ves_status same_product(void *data, const double *a, const double *b, bool *same)
{
    ++*(int *)data;
    *same = fabs(a[0] * a[1] - b[0] * b[1]) < 1e-3;
    return VES_OK;
}

static ves_status broken(void *data, const double *a, const double *b, bool *same)
{
    (void)data, (void)a, (void)b, (void)same;
    return VES_MEMORY;
}

Test(ends, the_caller_may_know_two_ends_to_be_one_design)
{
    const double lower[] = {0.1, 0.1}, upper[] = {3, 4}, start[] = {2.5, 2.9};
    int asked = 0;
    ves_search_problem p = {.n = 2,
                            .lower = lower,
                            .upper = upper,
                            .start = start,
                            .gradients = true,
                            .evaluate = curve,
                            .data = &asked};
    ves_search_result *r;
    cr_assert(eq(int, ves_search_run(&p, NULL, NULL, &r), VES_OK));
    cr_expect(r->optima > 1, "%d optima on a curve", r->optima);
    ves_search_result_destroy(r);
    p.same = same_product;
    cr_assert(eq(int, ves_search_run(&p, NULL, NULL, &r), VES_OK));
    cr_expect(r->optima == 1 && asked > 0, "%d optima", r->optima);
    cr_expect(r->evidence.minima == 1 && r->evidence.hits == r->evidence.descents && r->optimum[0].hits > 16,
              "every descent of auto ended there: %d hits, %s", r->optimum[0].hits, r->evidence.sentence);
    ves_search_result_destroy(r);
    p.same = broken;
    cr_expect(eq(int, ves_search_run(&p, NULL, NULL, &r), VES_MEMORY));
    cr_expect(r == NULL);
}

/* f = x + y + sin(9 x) / 4 where x y >= 1 - t: what an annealing alone leaves uses more or less of t up. Proved
 * points are written down. */
typedef struct ledger {
    int asked, stop; /* stop after so many questions; 0: never */
    int proofs;
    double proved[64][2];
} ledger;

static ves_status waves(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    ledger *l = data;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    (void)worker;
    l->asked++;
    v->value = x + y + 0.25 * sin(9 * x);
    v->constraint[0] = 1e-4 * (1 - x * y); /* t: 0.01 */
    if ((ask->want & VES_WANT_PROOF) && l->proofs < 64) {
        l->proved[l->proofs][0] = x;
        l->proved[l->proofs++][1] = y;
    }
    if (!g) return VES_OK;
    g[0] = 1 + 2.25 * cos(9 * x), g[1] = 1;
    v->jacobian[0] = -1e-4 * y;
    v->jacobian[1] = -1e-4 * x;
    return VES_OK;
}

static bool enough(void *data)
{
    const ledger *l = data;
    return l->stop && l->asked >= l->stop;
}

static bool is_proved(const ledger *l, const double *x)
{
    for (int k = 0; k < l->proofs; k++)
        if (l->proved[k][0] == x[0] && l->proved[k][1] == x[1]) return true;
    return false;
}

Test(ends, optima_are_listed_by_value_and_the_best_is_the_first)
{
    const int stop[] = {0, 0, 900, 3000, 6900};
    int several = 0;
    for (int c = 0; c < 5; c++)
        for (int seed = 1; seed <= 5; seed++) {
            ledger l = {.stop = stop[c]};
            given g = {.evaluate = waves,
                       .n = 2,
                       .m = 1,
                       .lower = {0.1, 0.1},
                       .upper = {4, 5},
                       .start = {2.5, 3},
                       .gradients = true,
                       .data = &l};
            ves_search_options o = c ? ves_search_options_default() : only_anneal(3000);
            ves_search_hooks hooks = {.stopped = enough, .data = &l};
            o.seed = (uint64_t)seed;
            ves_search_result *r;
            ves_status status = run(&g, &o, &hooks, &r);
            cr_assert(eq(int, status, stop[c] && l.asked >= stop[c] ? VES_INTERRUPTED : VES_OK));
            cr_assert(r->feasible && r->optima > 0, "case %d, seed %d", c, seed);
            cr_expect(r->value == r->optimum[0].value && r->violation == r->optimum[0].violation);
            for (int k = 0; k < r->optima; k++) {
                const ves_optimum *a = &r->optimum[k];
                cr_expect(a->violation <= 1e-6 && is_proved(&l, a->x), "case %d: %d of %d", c, k, r->optima);
                cr_expect(k == 0 || a[-1].value <= a->value, "case %d: %.9g before %.9g", c, a[-1].value,
                          a->value);
            }
            several += r->optima > 1;
            ves_search_result_destroy(r);
        }
    cr_expect(several > 5, "%d lists of several", several);
}

/* ---- more than one start ---- */

static ves_status two_wells(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    double x = ask->x[0], *g = gradient_of(ask, v);
    (void)data, (void)worker;
    if (x > 1.8) return VES_DEGENERATE;
    v->value = (x * x - 1) * (x * x - 1) + 0.1 * x;
    if (g) g[0] = 4 * x * (x * x - 1) + 0.1;
    return VES_OK;
}

Test(ends, a_polish_goes_on_from_every_start)
{
    const double lower = -2, upper = 2, start = 0.9, left = -1.2, near = 0.8, lost = 1.9, outside = 2.1;
    const double *const other[] = {&left, &lost, &near}, *const wrong[] = {&outside};
    ves_search_problem p = {.n = 1,
                            .lower = &lower,
                            .upper = &upper,
                            .start = &start,
                            .others = 3,
                            .other = other,
                            .gradients = true,
                            .evaluate = two_wells};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, ves_search_run(&p, &o, NULL, &r), VES_OK));
    cr_expect(r->optima == 2 && r->x[0] < -1 && r->optimum[0].hits == 1 && r->optimum[1].hits == 2,
              "%d optima, best at %g", r->optima, r->x[0]);
    cr_expect(r->failed >= 1 && r->evaluations <= r->budget);
    ves_search_result_destroy(r);
    o.evaluations = 3; /* the start, one of the others, a proof */
    cr_assert(eq(int, ves_search_run(&p, &o, NULL, &r), VES_OK));
    cr_expect(r->evaluations <= 3 && r->budget == 3 && r->x[0] < 0, "%ld, x %g", r->evaluations, r->x[0]);
    ves_search_result_destroy(r);
    p.other = wrong, p.others = 1;
    cr_expect(eq(int, ves_search_run(&p, &o, NULL, &r), VES_RANGE));
    p.other = NULL;
    cr_expect(eq(int, ves_search_run(&p, &o, NULL, &r), VES_RANGE));
    p.others = -1;
    cr_expect(eq(int, ves_search_run(&p, &o, NULL, &r), VES_RANGE));
}

/* From inside both curves the first step of SLSQP goes along the corner, beyond them, and the value changes no
 * more: NLopt says that it has converged, and gives back where it began. */
Test(ends, a_descent_that_stops_beyond_a_constraint_goes_on)
{
    double offset = 0;
    given g = {.evaluate = corner,
               .n = 4,
               .m = 2,
               .lower = {-3, -3, 0.5, -1},
               .upper = {3, 3, 2, 1.3},
               .start = {0.2, 0.4, 1, 0.1},
               .gradients = true,
               .data = &offset};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    /* a cube is flat: a change of the value below 1e-12 leaves some 1e-8 of it */
    cr_expect(r->feasible && fabs(r->value - 0.35) < 1e-6, "%.12g; %s", r->value, r->stop);
    cr_expect(noted(r, "slope has not vanished") == NULL);
    ves_search_result_destroy(r);
}
