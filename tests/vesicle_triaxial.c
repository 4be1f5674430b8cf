/* Vesicles that are not axisymmetric: problems/vesicle/triaxial.yaml against the exact axisymmetric shapes that it can turn
 * on their side, against itself about other axes, and against what symmetry says of shapes near the sphere. */
#include "vesicle_exact.h"

#include "problem/problem.h"
#include "vesica/run.h"

TestSuite(vesicle_triaxial, .timeout = 200);

enum { SETTINGS = 16, TEXT = 32 };

typedef struct settings {
    int count;
    ves_override set[SETTINGS];
    char text[SETTINGS][TEXT];
} settings;

static void put(settings *s, const char *name, double value)
{
    cr_assert(s->count < SETTINGS);
    char *text = s->text[s->count];
    snprintf(text, TEXT, "%.9g", value);
    s->set[s->count++] = (ves_override){name, text};
}

/* Begins at the ellipsoid of half axes a, b along x, y and c towards the poles: u is the angle from the pole over pi/2. */
static void ellipsoid(settings *s, double a, double b, double c)
{
    const double h = EX_PI / 2;
    b /= a, c /= a;
    put(s, "zn", c), put(s, "Y", b), put(s, "mx", h), put(s, "my", b * h), put(s, "b0", -c * h * h);
    put(s, "px", -h * h * h), put(s, "py", -b * h * h * h), put(s, "l0", c * h);
    put(s, "rx", -h * h), put(s, "ry", -b * h * h), put(s, "g0", c * h * h * h);
}

typedef struct found {
    double energy, axis[3]; /* of the rim along x and y, and from pole to pole: half of it */
} found;

static found find(settings *s)
{
    ves_problem *problem = NULL;
    ves_run *run = NULL;
    const ves_read_options options = {.overrides = s->count, .override = s->set};
    cr_assert(ves_problem_read(VESICA_SOURCE "/problems/vesicle/triaxial.yaml", &options, &problem, NULL) ==
              VES_OK);
    cr_assert(ves_run_create(problem, NULL, NULL, &run, NULL) == VES_OK);
    cr_assert(run->any && run->feasible);
    found f = {run->best.objective, {1, 0, 0}};
    for (int k = 0; k < problem->variables; k++) {
        const char *name = problem->variable[k].name;
        double x = run->best.x[k];
        if (!strcmp(name, "x3")) f.axis[0] += x;
        if (!strcmp(name, "Y")) f.axis[1] += x;
        if (!strcmp(name, "y3")) f.axis[1] -= x;
        if (!strcmp(name, "zn")) f.axis[2] = x;
    }
    for (int k = 0; k < 3; k++) f.axis[k] *= run->best.similarity;
    ves_run_destroy(run);
    ves_problem_destroy(problem);
    return f;
}

static void family(exact *e, double second)
{
    double b[EX_MODES] = {0};
    b[1] = second;
    exact_solve(e, b);
}

/* With m free the least of all is the prolate, about an axis of its own: poles on its side, an equator that is a meridian. */
Test(vesicle_triaxial, finds_prolates_that_lie)
{
    static const double nu[] = {0.9, 0.8}, part[] = {1e-5, 1e-4};
    for (int k = 0; k < 2; k++) {
        exact *e = exact_create(48, 0, nu[k]);
        family(e, 0.35);
        settings s = {.set = {{"constraints", "[reduced_volume == nu]"}}, .count = 1};
        put(&s, "nu", nu[k]);
        found f = find(&s);
        cr_expect(f.energy < e->energy * (1 + part[k]) && f.energy > e->energy * (1 - 1e-7),
                  "%g: %.8f, exactly %.8f", nu[k], f.energy, e->energy);
        cr_expect(fabs(f.axis[0] / fabs(e->thickness) * 2 - 1) < 1e-3, "%g: %g long, exactly %g", nu[k],
                  2 * f.axis[0], e->thickness);
        cr_expect(fabs(f.axis[1] / f.axis[2] - 1) < 2e-3, "%g: %g and %g", nu[k], f.axis[1], f.axis[2]);
        free(e);
    }
}

/* The same shape with its poles on the short, the long and the middle axis: three models that share nothing but m. */
Test(vesicle_triaxial, the_same_about_each_axis)
{
    static const double half[3] = {1.4, 0.84, 0.665};
    static const int about[3][3] = {{0, 1, 2}, {2, 1, 0}, {0, 2, 1}};
    found first = {0};
    for (int k = 0; k < 3; k++) {
        const int *at = about[k];
        settings s = {0};
        if (k == 1) /* x is the short axis, Y begins above 1 */
            ellipsoid(&s, half[1], half[2], half[0]);
        else
            ellipsoid(&s, half[at[0]], half[at[1]], half[at[2]]);
        found f = find(&s);
        if (!k) first = f;
        cr_expect(fabs(f.energy / 1.2008563 - 1) < 2e-5, "%d: %.8f", k, f.energy);
        double want[3] = {first.axis[0], first.axis[1], first.axis[2]};
        if (k == 1) want[0] = first.axis[1], want[1] = first.axis[2], want[2] = first.axis[0];
        if (k == 2) want[1] = first.axis[2], want[2] = first.axis[1];
        for (int i = 0; i < 3; i++)
            cr_expect(fabs(f.axis[i] / want[i] - 1) < 3e-3, "%d, axis %d: %g, want %g", k, i, f.axis[i],
                      want[i]);
    }
}

/* Near the sphere a shape is a symmetric tensor without trace, and E and m at a given volume are functions of cos 3 g, the
 * invariant that tells prolate (1) from oblate (-1): E = e0 + e1 c + e2 c^2 with e1 ~ d^(3/2), e2 ~ d^3, d = 1 - nu, and
 * m likewise. So E is linear in m between the two but for a part ~ d^(3/2) of the difference. */
Test(vesicle_triaxial, between_oblate_and_prolate_as_symmetry_has_it)
{
    static const double nu[] = {0.9, 0.95, 0.98};
    double off[3];
    for (int k = 0; k < 3; k++) {
        exact *oblate = exact_create(32, 0, nu[k]), *prolate = exact_create(32, 0, nu[k]);
        family(oblate, -0.3), family(prolate, 0.2);
        settings s = {0};
        put(&s, "nu", nu[k]), put(&s, "m", (oblate->M + prolate->M) / 2);
        found f = find(&s);
        double middle = (oblate->energy + prolate->energy) / 2, gap = oblate->energy - prolate->energy;
        cr_expect(gap > 0);
        off[k] = (f.energy - middle) / gap / pow(1 - nu[k], 1.5);
        cr_expect(fabs(f.axis[0] - f.axis[1]) > 0.1 && fabs(f.axis[1] - f.axis[2]) > 0.1, "%g: %g %g %g",
                  nu[k], f.axis[0], f.axis[1], f.axis[2]);
        free(oblate), free(prolate);
    }
    /* what is next is sqrt(d) of that */
    double slope = (off[0] - off[1]) / (sqrt(0.1) - sqrt(0.05)),
           next = off[1] + slope * (sqrt(0.02) - sqrt(0.05));
    cr_expect(off[0] > 0 && off[0] < 2 && fabs(off[2] - next) < 0.02, "%g %g %g, expected %g", off[0], off[1],
              off[2], next);
}
