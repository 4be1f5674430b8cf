/* Modes of buckling all around a shell of which a sector was solved. */
#include <math.h>
#include <stdio.h>

#include "base/vector.h"
#include "bed.h"
#include "plan/shell.h"

/* Radius, mesh and symmetry; pressed from outside, so that it buckles in waves. */
static const char TUBE[] = "vesica: 1\n"
                           "variables: {p: [0.5, 1, 1.5]}\n"
                           "patches:\n"
                           "  wall: {surface: {formula: [\"cos(v)*(%s)\", \"2*u\", \"sin(v)*(%s)\"]}}\n"
                           "shell:\n"
                           "  parts: {wall: {thickness: 0.03}}\n"
                           "  material: {E: 1e6, nu: 0.3}\n"
                           "  supports: [{at: wall.u0, fix: all}, {at: wall.u1, fix: [x, z]}]\n"
                           "  cases: {press: [{over: [wall], pressure: -p}]}\n"
                           "  mesh: {order: 6, elements: [2, %d]}\n"
                           "  symmetry: %s\n"
                           "measures: {factor: {buckling: {}}}\n"
                           "minimize: factor\n"
                           "quadrature: {u: 8, v: 16}\n";

static const char ROUND[] = "1", RIDGED[] = "1 + 0.05*cos(6*v)", SCREW[] = "1 + 0.05*cos(6*v + u)",
                  OVAL[] = "1 + 0.1*cos(2*v)", EGG[] = "1 + 0.1*cos(v) + 0.08*cos(2*v)";

static const ves_shell_buckled NONE = {.factor = HUGE_VAL};

typedef struct tube {
    bed bed;
    plan_shell *shell;
} tube;

static tube tube_of(const char *radius, int around, bool whole)
{
    char text[2000];
    const double start = 1;
    snprintf(text, sizeof text, TUBE, radius, radius, around, whole ? "none" : "auto");
    tube t = {.bed = bed_with(text, NULL, 0, 0)};
    value_at(&t.bed, &start);
    t.shell = t.bed.plan->level[0].shell;
    return t;
}

static void at(const tube *t, const ves_shell_buckled *mode, double u, double v, double U[3])
{
    ves_shell_mode_at(t->shell, mode, 0, u, v, U);
}

/* Across the line v from one copy to the next: how far the mode jumps, and how large it is there. */
static void seam(const tube *t, const ves_shell_buckled *mode, double v, double *jump, double *size)
{
    static const double BESIDE = 1e-7;
    double before[3], after[3];
    for (int i = 1; i < 8; i++) {
        at(t, mode, i / 8., v > BESIDE ? v - BESIDE : VES_TWO_PI - BESIDE, before);
        at(t, mode, i / 8., v + BESIDE, after);
        *size = fmax(*size, sqrt(ves_dot(after, after)));
        for (int c = 0; c < 3; c++) *jump = fmax(*jump, fabs(after[c] - before[c]));
    }
}

/* Of each class of a tube that is cut into `copies`: a mode goes on from copy to copy without a jump. */
static void seamless(const char *radius, int around, int copies, int classes)
{
    tube t = tube_of(radius, around, false);
    const plan_sector *s = &t.shell->sector;
    int found = 0;
    cr_assert(!s->whole && (s->ring || fabs(s->copies - copies) < 1e-9), "%s: %g", radius, s->copies);
    for (int symmetry = 0; symmetry <= t.shell->model.classes; symmetry++)
        for (int wave = 0; wave < (s->ring ? 5 : ves_shell_waves(t.shell->shell)); wave++) {
            ves_shell_buckled mode = NONE;
            double jump = 0, size = 0;
            cr_assert(ves_shell_buckling_class(t.shell->shell, 0, symmetry, wave, &mode) == VES_OK);
            for (int c = 0; c < copies; c++)
                seam(&t, &mode, fmod(s->from + VES_TWO_PI * c / copies, VES_TWO_PI), &jump, &size);
            /* slopes of a few waves times the step */
            cr_expect(jump < 1e-5, "%s, class %d, wave %d: jumps by %.2g of %.2g", radius, symmetry, wave,
                      jump, size);
            cr_expect(size > 0.05, "%s, class %d, wave %d: %.2g", radius, symmetry, wave, size);
            found++;
        }
    cr_assert(found == classes, "%s: %d", radius, found);
    bed_clear(&t.bed);
}

Test(shell_mode, seamless)
{
    seamless(ROUND, 12, 12, 5);
    seamless(RIDGED, 12, 6, 4);
    seamless(SCREW, 12, 6, 4);
    seamless(OVAL, 8, 4, 4);
    seamless(EGG, 8, 2, 2);
}

/* The least of a sector's classes is that of the whole on the same elements, there found without any symmetry. */
static void alike(const char *radius, int around)
{
    tube cut = tube_of(radius, around, false), whole = tube_of(radius, around, true);
    ves_shell_buckled one, all;
    double product = 0, square = 0, other = 0;
    cr_assert(!cut.shell->sector.whole && whole.shell->sector.whole);
    cr_assert(ves_shell_buckling(cut.shell->shell, 0, &one) == VES_OK);
    cr_assert(ves_shell_buckling(whole.shell->shell, 0, &all) == VES_OK);
    for (int i = 0; i < 12; i++)
        for (int j = 0; j < 48; j++) {
            double U[3], W[3];
            at(&cut, &one, (i + 0.5) / 12, VES_TWO_PI * (j + 0.3) / 48, U);
            at(&whole, &all, (i + 0.5) / 12, VES_TWO_PI * (j + 0.3) / 48, W);
            product += ves_dot(U, W), square += ves_dot(U, U), other += ves_dot(W, W);
        }
    double angle = sqrt(fmax(0, 1 - product * product / (square * other)));
    /* factors to 1e-4: modes to its root, over the gap to the next factor */
    cr_expect(angle < 0.03, "%s: class %d, sine %.2g, factors %.8g %.8g", radius, one.symmetry, angle,
              one.factor, all.factor);
    bed_clear(&cut.bed), bed_clear(&whole.bed);
}

Test(shell_mode, alike)
{
    alike(OVAL, 8);
    alike(EGG, 8);
}
