/* A shelf of curves, written by hand as the reader of problem files would write them. */
#ifndef VES_TEST_CURVE_SHELF_H
#define VES_TEST_CURVE_SHELF_H

#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/random.h"
#include "curve/curve.h"

enum {
    SHELF_CURVES = 12,
    SHELF_STEPS = 6,
    SHELF_KEYS = 4,
    SHELF_REFS = 6,
    SHELF_NUMBERS = 512,
    SHELF_SLOTS = 4
};

typedef struct shelf {
    ves_arena arena;
    ves_diag *diag;
    double number[SHELF_NUMBERS]; /* SHELF_SLOTS slots first */
    bool varying[SHELF_NUMBERS];
    int numbers, count, limit;
    ves_curve_def def[SHELF_CURVES];
    ves_curve_step step[SHELF_CURVES][SHELF_STEPS];
    ves_arg arg[SHELF_CURVES][SHELF_STEPS][SHELF_KEYS];
    int ref[SHELF_CURVES][SHELF_REFS];
    const ves_formula *formula[SHELF_CURVES][3];
    ves_curves *curves;
} shelf;

static inline void shelf_open(shelf *s)
{
    memset(s, 0, sizeof *s);
    s->numbers = SHELF_SLOTS;
    s->diag = ves_diag_create();
    ves_diag_source(s->diag, "shelf", "", 0);
}

static inline void shelf_close(shelf *s)
{
    ves_arena_destroy(&s->arena);
    ves_diag_destroy(s->diag);
}

/* Adds a step to the newest curve. */
static inline void shelf_step(shelf *s, const char *name, bool move)
{
    int c = s->count - 1, k = s->def[c].steps++;
    const ves_curve_op *op = ves_curve_op_find(name, move);
    cr_assert(op != NULL, "no operation %s", name);
    int keys = 0;
    while (op->keys[keys].name) keys++;
    cr_assert(keys <= SHELF_KEYS);
    for (int i = 0; i < keys; i++)
        if (op->keys[i].kind >= VES_COUNT) s->arg[c][k][i].value = (int)op->keys[i].fallback;
    s->step[c][k] = (ves_curve_step){op, {op->keys, s->arg[c][k], keys, {0, 100 + c, 1 + k, 1}}};
}

/* A new curve with its source; returns its index. */
static inline int shelf_curve(shelf *s, const char *source)
{
    int c = s->count++;
    s->def[c] = (ves_curve_def){.name = "curve", .step = s->step[c], .input = s->ref[c]};
    shelf_step(s, source, false);
    return c;
}

static inline ves_arg *shelf_arg(shelf *s, const char *key)
{
    int c = s->count - 1, k = s->def[c].steps - 1;
    const ves_args *args = &s->step[c][k].args;
    for (int i = 0; i < args->count; i++)
        if (!strcmp(args->key[i].name, key)) {
            ves_arg *arg = &s->arg[c][k][i];
            arg->given = true;
            arg->mark = (ves_mark){0, 200 + c, 1 + k, 1};
            return arg;
        }
    cr_assert_fail("no key %s", key);
    return NULL;
}

/* Answers a key of the newest step with numbers, which vary or not. Returns the place of the first in the
 * block. */
static inline int shelf_give(shelf *s, const char *key, int count, const double *value, bool varying)
{
    ves_arg *arg = shelf_arg(s, key);
    arg->first = s->numbers, arg->count = count;
    for (int i = 0; i < count; i++) {
        s->number[s->numbers] = value[i];
        s->varying[s->numbers++] = varying;
    }
    cr_assert(s->numbers <= SHELF_NUMBERS);
    return arg->first;
}

static inline void shelf_choose(shelf *s, const char *key, int value)
{
    shelf_arg(s, key)->value = value;
}

/* The newest curve reads another one. */
static inline void shelf_read(shelf *s, int curve)
{
    ves_curve_def *def = &s->def[s->count - 1];
    s->ref[s->count - 1][def->inputs++] = curve;
}

/* Answers `of` of a formula curve; formulas may use v and the slots p0 .. p3. */
static inline void shelf_formula(shelf *s, const char *const text[3])
{
    static const ves_symbol slot[SHELF_SLOTS] = {
        {"p0", {.any = true}}, {"p1", {.any = true}}, {"p2", {.any = true}}, {"p3", {.any = true}}};
    static const ves_symbol argument[1] = {{"v", {.any = true}}};
    ves_scope scope = {slot, SHELF_SLOTS, argument, 1, false};
    ves_arg *arg = shelf_arg(s, "of");
    for (int c = 0; c < 3; c++) {
        ves_formula_error error;
        ves_status status =
            ves_formula_compile(text[c], &scope, &s->arena, &s->formula[s->count - 1][c], &error);
        cr_assert(status == VES_OK, "%s: %s", text[c], error.text);
    }
    arg->formula = s->formula[s->count - 1], arg->count = 3;
}

static inline ves_status shelf_try(shelf *s)
{
    ves_curve_set set = {s->def, s->count, s->limit, s->number, s->varying, NULL};
    return ves_curves_create(&set, &s->arena, &s->curves, s->diag);
}

static inline void shelf_ready(shelf *s)
{
    ves_status status = shelf_try(s);
    char text[300] = "";
    if (status) ves_diag_text(s->diag, 0, text, sizeof text);
    cr_assert(status == VES_OK, "%s", text);
}

/* Creation fails with one message that contains the sentence. Closes the shelf. */
static inline void shelf_refused(shelf *s, ves_status want, const char *sentence)
{
    char text[400] = "";
    ves_status got = shelf_try(s);
    ves_diag_text(s->diag, 0, text, sizeof text);
    cr_assert(got == want && ves_diag_count(s->diag) == 1 && !s->curves, "status %d: %s", got, text);
    cr_assert(strstr(text, sentence), "got \"%s\", want \"%s\"", text, sentence);
    shelf_close(s);
}

static inline void shelf_point(const shelf *s, int curve, double v, double out[9])
{
    ves_curve_point(ves_curves_coef(s->curves, curve), ves_curves_modes(s->curves, curve), v, 2, out);
}

/* The same mixed sum over all modes of all curves that vary, as a stand-in for a measure. */
static inline double shelf_weight(int curve, int k)
{
    ves_random random = {.seed = 7, .chain = (uint32_t)curve, .step = (uint64_t)k};
    return 2 * ves_random_uniform(&random) - 1;
}

static inline double shelf_sum(shelf *s)
{
    double sum = 0;
    ves_curves_bind(s->curves, s->number);
    for (int i = 0; i < s->count; i++)
        for (int k = 0; k < 3 * ves_curve_stride(ves_curves_modes(s->curves, i)); k++)
            sum += shelf_weight(i, k) * ves_curves_coef(s->curves, i)[k];
    return sum;
}

/* Checks the gradient of shelf_sum with respect to every number that varies. Differences of fourth order with
 * h = 1e-3: their own error is h^4/30 of a fifth derivative (about 1e-12 of the scale), rounding 1e-16/h;
 * 1e-9 leaves room for the highest modes. */
static inline void shelf_check_gradient(shelf *s, const char *what)
{
    double adjoint[SHELF_NUMBERS] = {0};
    ves_curves_bind(s->curves, s->number);
    ves_curves_clear(s->curves);
    for (int i = 0; i < s->count; i++) {
        double *to = ves_curves_adjoint(s->curves, i);
        for (int k = 0; to && k < 3 * ves_curve_stride(ves_curves_modes(s->curves, i)); k++)
            to[k] += shelf_weight(i, k);
    }
    ves_curves_scatter(s->curves, s->number, adjoint);
    for (int i = 0; i < s->numbers; i++) {
        if (!s->varying[i]) continue;
        double x = s->number[i], h = 1e-3, f[4];
        static const double place[4] = {-2, -1, 1, 2};
        for (int k = 0; k < 4; k++) {
            s->number[i] = x + h * place[k];
            f[k] = shelf_sum(s);
        }
        s->number[i] = x;
        double want = (8 * (f[2] - f[1]) - (f[3] - f[0])) / (12 * h);
        cr_assert(fabs(adjoint[i] - want) <= 1e-9 * (1 + fabs(want)), "%s, number %d: got %.15g, want %.15g",
                  what, i, adjoint[i], want);
    }
    ves_curves_bind(s->curves, s->number);
}

#endif
