/* What figures know of a shell's solution, against the measures of the same problem and against the shell solved whole. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "bed.h"
#include "surface/figure.h"
#include "vesica/figure.h"

static const char TUBE[] = "vesica: 1\n"
                           "variables: {p: [0.5, 1, 1.5]}\n"
                           "patches:\n"
                           "  wall: {surface: {formula: [\"cos(v)*(%s)\", \"2*u\", \"sin(v)*(%s)\"]}}\n"
                           "places: {there: {patch: wall, u: 0.5, v: 4*pi/3}}\n"
                           "shell:\n"
                           "  parts: {wall: {thickness: 0.03*(1 + 0.2*u)}}\n"
                           "  material: {E: 1e6, nu: 0.3}\n"
                           "  supports: [{at: wall.u0, fix: all}]\n"
                           "  cases:\n"
                           "    press: [{over: [wall], pressure: p}]\n"
                           "    load: [{at: wall.u1, line: [0, -1, 0]}, {over: [wall], area: [0, -2*u, 0]}]\n"
                           "  mesh: {order: 6, elements: [4, 24], grading: 1.8}\n"
                           "  verify: {order: 6, elements: [2, 12]}\n"
                           "  symmetry: %s\n"
                           "measures:\n"
                           "  shear: {max_shear: {case: load}}\n"
                           "  mises: {von_mises: {case: press}}\n"
                           "  far: {displacement: {case: load}}\n"
                           "  out: {displacement: {case: press, at: there, along: [1, 0, 1]}}\n"
                           "minimize: %s\n"
                           "quadrature: {u: 8, v: 16}\n";

static const char ROUND[] = "1", RIDGED[] = "1 + 0.05*cos(6*v)", SCREW[] = "1 + 0.05*cos(6*v + u)",
                  OVAL[] = "1 + 0.1*cos(2*v)", EGG[] = "1 + 0.1*cos(v) + 0.08*cos(2*v)";
enum { NU = 40, NV = 96 };

typedef struct drawn {
    bed bed;
    ves_figure *figure;
    double value; /* of the measure */
} drawn;

static drawn drawn_of(const char *radius, bool whole, const char *measure)
{
    char text[3000];
    const double start = 1;
    snprintf(text, sizeof text, TUBE, radius, radius, whole ? "none" : "auto", measure);
    drawn d = {.bed = bed_with(text, NULL, 0, 0)};
    d.value = value_at(&d.bed, &start);
    cr_assert(ves_plan_figure(d.bed.plan, &start, NU, NV, &d.figure, d.bed.diag) == VES_OK);
    return d;
}

static void drawn_clear(drawn *d)
{
    ves_figure_destroy(d->figure);
    bed_clear(&d->bed);
}

static const ves_figure_field *field_of(const drawn *d, const char *word)
{
    const ves_figure_field *field = NULL;
    cr_assert(ves_figure_fields(d->figure, word, &field) == 1, "%s", word);
    return field;
}

static int nodes_of(const drawn *d)
{
    return d->figure->patch[0].rows * d->figure->patch[0].columns;
}

static void largest(const char *measure, const char *word, double close)
{
    static const char *const radius[] = {ROUND, RIDGED, EGG};
    for (int k = 0; k < 3; k++) {
        drawn d = drawn_of(radius[k], false, measure);
        const double *value = field_of(&d, word)->value[0];
        double most = 0;
        for (int s = 0; s < nodes_of(&d); s++) most = fmax(most, value[s]);
        cr_expect(fabs(most / d.value - 1) < close, "%s of %s: %.9g, measure %.9g", word, radius[k], most,
                  d.value);
        drawn_clear(&d);
    }
}

/* A picture has its nodes where it has them: between two of them the largest lies at most half a step away, and a quarter
 * of the square of the step, as of a wave of twelve nodes, is missed. */
Test(figure_field, largest)
{
    largest("shear", "max_shear:load", 5e-3);
    largest("mises", "von_mises:press", 5e-3);
    largest("far", "displacement:load", 1e-3);
}

/* At a node of the picture that is a place of the file: the same polynomial. */
Test(figure_field, place)
{
    static const char *const radius[] = {ROUND, RIDGED, EGG};
    for (int k = 0; k < 3; k++) {
        drawn d = drawn_of(radius[k], false, "out");
        double *const *U = field_of(&d, "displacement:press")->vector[0];
        int s = NU / 2 * d.figure->patch[0].columns + 2 * NV / 3;
        double out = (U[0][s] + U[2][s]) / sqrt(2.);
        cr_expect(fabs(out / d.value - 1) < 1e-8, "%s: %.12g, measure %.12g", radius[k], out, d.value);
        drawn_clear(&d);
    }
}

/* The same elements with and without a sector: the same fields all around, but for the jumps of stresses between elements, where
 * rounding says which of two a node is in. The strip of what is round has elements that are exact around. */
/* jump: of stresses, on elements of order 6 */
static void alike(const char *radius, double close, double jump)
{
    static const char *const word[] = {"thickness",          "max_shear:press", "von_mises:press",
                                       "displacement:press", "max_shear:load",  "von_mises:load",
                                       "displacement:load"};
    drawn cut = drawn_of(radius, false, "far"), whole = drawn_of(radius, true, "far");
    for (int w = 0; w < 7; w++) {
        const ves_figure_field *a = field_of(&cut, word[w]), *b = field_of(&whole, word[w]);
        double gap = 0, size = 0;
        for (int s = 0; s < nodes_of(&cut); s++) {
            size = fmax(size, fabs(b->value[0][s])), gap = fmax(gap, fabs(a->value[0][s] - b->value[0][s]));
            for (int c = 0; b->vector && c < 3; c++)
                gap = fmax(gap, fabs(a->vector[0][c][s] - b->vector[0][c][s]));
        }
        bool stress = strstr(word[w], "shear") || strstr(word[w], "mises");
        cr_expect(gap < (stress ? jump : close) * size, "%s of %s: %.2g of %.6g", word[w], radius, gap, size);
    }
    drawn_clear(&cut), drawn_clear(&whole);
}

Test(figure_field, alike)
{
    alike(RIDGED, 1e-6, 5e-3);
    alike(SCREW, 1e-6, 5e-3);
    alike(OVAL, 1e-6, 5e-3);
    alike(ROUND, 1e-3, 5e-3);
}
