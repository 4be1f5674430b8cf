/* The other readers, as the fuzz target sees them: formulas and units, lists of points, measures from
 * outside. The first line of an input says which of them gets the rest. */
#ifndef TESTS_FUZZ_PARTS_H
#define TESTS_FUZZ_PARTS_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "formula/formula.h"
#include "measure/registry.h"
#include "problem/problem.h"
#include "study/points.h"
#include "vesica/plan.h"

static inline void require(bool holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

/* ---- formulas ---- */

static inline bool same(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* The value by eval and by gradient; adjoints go where they may. */
static inline void formula_use(const ves_formula *f, const double *slot, const double *argument)
{
    double value, by_gradient, to_slot[4] = {0, 0, 0, 42}, to_argument[3] = {0, 0, 42};
    char text[48];
    double *room = malloc(sizeof *room * (size_t)ves_formula_room(f));
    require(ves_formula_slots(f) <= 3, "a slot that is none");
    value = ves_formula_eval(f, slot, argument, room);
    by_gradient = ves_formula_gradient(f, slot, argument, 1, to_slot, to_argument, room);
    require(same(value, by_gradient), "two values of a formula");
    require(to_slot[3] == 42 && to_argument[2] == 42, "an adjoint outside");
    double constant;
    if (ves_formula_is_constant(f, &constant)) require(same(constant, value), "a constant that is not");
    ves_dim_text(ves_formula_dim(f), text);
    free(room);
}

static inline void fuzz_formula(const char *text)
{
    static const ves_symbol slot[] = {{"a", {6, 0, 0, false}}, {"b", {0}}, {"rim.r", {0}}};
    static const ves_symbol argument[] = {{"u", {0}}, {"area", {12, 0, 0, false}}};
    const double at[3] = {1.3, -0.7, 0}, with[2] = {0.4, 2.1};
    int length = (int)strlen(text), left, right;
    char operator[3];
    ves_dim dim;
    for (int dimensions = 0; dimensions < 2; dimensions++) {
        const ves_scope scope = {slot, 3, argument, 2, dimensions};
        ves_arena arena = {0};
        const ves_formula *f;
        ves_formula_error e = {0};
        ves_status status = ves_formula_compile(text, &scope, &arena, &f, &e);
        require((status == VES_OK) == (f != NULL) && status <= 0, "status and formula disagree");
        if (f) {
            formula_use(f, at, with);
            const ves_formula *d = ves_formula_derivative(f, 0, &arena);
            if (d) formula_use(d, at, with);
        } else {
            require(e.text[0] && e.offset >= 0 && e.length > 0 && e.offset + e.length <= length + 1,
                    "an error of a formula outside its text");
        }
        ves_arena_destroy(&arena);
    }
    if (ves_formula_split(text, operator, & left, &right) == VES_OK)
        require(0 <= left && left < right && right <= length, "a comparison outside its text");
    double factor;
    if (ves_dim_read(text, &dim, &factor)) require(!isnan(factor), "a unit without a factor");
}

/* ---- lists of points ---- */

static inline void fuzz_points(const char *bytes, size_t length)
{
    if (!length) return;
    FILE *in = fmemopen((void *)bytes, length, "rb");
    ves_points p;
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_points_read(in, "fuzz", &p, diag);
    require(status <= 0 && (status == VES_OK) == (ves_diag_errors(diag) == 0), "points without a message");
    for (int k = 0; k < p.count; k++)
        require(p.u[k] >= 0 && p.u[k] <= 1 && isfinite(p.v[k]), "a point outside the patch");
    require(status != VES_OK || p.count > 0, "no points");
    ves_points_free(&p);
    ves_diag_destroy(diag);
    fclose(in);
}

/* ---- measures from outside ---- */

/* What a plugin may have left in its tables: one byte of the input chooses each member. */
typedef struct tape {
    const unsigned char *at, *end;
} tape;

static inline unsigned next(tape *t)
{
    return t->at < t->end ? *t->at++ : 0;
}

static inline const char *next_text(tape *t)
{
    static const char *const text[] = {
        NULL,        "",
        "size",      "over",
        "m",         "m^2",
        "1",         "furlong",
        "one|two",   "|",
        "one|",      "area",
        "pi",        "auto",
        "mine",      "my one",
        "\xC3",      "2nd",
        "objective", "kg/(m s",
        "of",        "a_very_long_name_that_goes_on_and_on_and_on_and_on_and_on_and_on_and_on"};
    return text[next(t) % (sizeof text / sizeof *text)];
}

static inline double next_number(tape *t)
{
    static const double number[] = {0,      0,        1,         -1,  0.5,          3,   1e300,
                                    -1e300, INFINITY, -INFINITY, NAN, VES_POSITIVE, 1e10};
    return number[next(t) % (sizeof number / sizeof *number)];
}

static inline ves_status outside_eval(const ves_measure_input *input, double *value)
{
    *value = input->samples;
    return VES_OK;
}

enum { FUZZ_KEYS = 6, FUZZ_MEASURES = 2 };

static inline void measure_make(tape *t, ves_measure *m, ves_key *key)
{
    unsigned flags = next(t), keys = next(t) % (FUZZ_KEYS + 1);
    *m = (ves_measure){.name = flags & 64 ? next_text(t) : "mine",
                       .about = flags & 1 ? next_text(t) : "about",
                       .unit = flags & 2 ? next_text(t) : "1",
                       .degree = (int)next(t) - 128,
                       .cost = flags & 4 ? (int)next(t) : 0,
                       .surface = flags & 8 ? next(t) | next(t) << 8 : 1,
                       .cap = flags & 16 ? next(t) | next(t) << 8 : 0,
                       .curve = flags & 32 ? next(t) : 0,
                       .keys = keys ? key : NULL,
                       .eval = flags & 128 && next(t) % 8 == 0 ? NULL : outside_eval};
    for (unsigned k = 0; k < keys; k++)
        key[k] = (ves_key){.name = next_text(t),
                           .kind = (ves_kind)(next(t) % 18),
                           .required = next(t) % 4 == 0,
                           .unit = next_text(t),
                           .min = next_number(t),
                           .max = next_number(t),
                           .fallback = next_number(t),
                           .words = next_text(t),
                           .about = next_text(t)};
}

/* What passes the check must serve a problem. */
static inline void fuzz_plugin(const char *bytes, size_t length)
{
    static const char problem[] =
        "vesica: 1\nquadrature: {u: 8, v: 8}\ncurves: {p: {circle: {radius: 1}}, q: {circle: {radius: 2}}}\n"
        "patches: {ring: {operator: {power: 1}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n";
    tape t = {(const unsigned char *)bytes, (const unsigned char *)bytes + length};
    ves_key key[FUZZ_MEASURES][FUZZ_KEYS + 1];
    ves_measure measure[FUZZ_MEASURES];
    const ves_measure *list[FUZZ_MEASURES + 1] = {NULL};
    memset(key, 0, sizeof key);
    for (int k = 0; k < FUZZ_MEASURES; k++) measure_make(&t, &measure[k], key[k]), list[k] = &measure[k];
    if (next(&t) % 2) list[1] = NULL;
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_measures_check(list, diag);
    require(status <= 0 && (status == VES_OK) == (ves_diag_errors(diag) == 0), "a measure without a message");
    ves_problem *p = NULL;
    ves_plan *plan = NULL;
    char text[1000];
    snprintf(text, sizeof text, "%sminimize: %s + area\n", problem,
             status == VES_OK ? measure[0].name : "area");
    ves_read_options options = {.plugin = list};
    ves_status reading = ves_problem_read_text("fuzz", text, strlen(text), &options, &p, diag);
    require(reading != VES_OK || status == VES_OK, "a measure that was refused is there");
    if (p) status = ves_plan_create(p, &(ves_plan_options){{0, 0}}, &plan, diag);
    require(reading == VES_OK || ves_diag_errors(diag) > 0, "a failure without a message");
    ves_plan_destroy(plan);
    ves_problem_destroy(p);
    ves_diag_destroy(diag);
}

/* Takes an input that is for one of these; false: it is a problem. */
static inline bool fuzz_part(const char *text, size_t size)
{
    static const char *const head[] = {"--formula\n", "--points\n", "--plugin\n"};
    for (int k = 0; k < 3; k++) {
        size_t length = strlen(head[k]);
        if (size < length || memcmp(text, head[k], length)) continue;
        char *rest = malloc(size - length + 1);
        memcpy(rest, text + length, size - length);
        rest[size - length] = 0;
        if (k == 0) fuzz_formula(rest);
        if (k == 1) fuzz_points(rest, size - length);
        if (k == 2) fuzz_plugin(rest, size - length);
        free(rest);
        return true;
    }
    return false;
}

#endif
