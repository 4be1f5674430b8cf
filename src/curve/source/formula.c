/* A curve by three formulas of v. Sampled at v = 2 pi j / J and analysed [Ugail 2011, eqs 4.24-4.27]; J is
 * chosen once, from the spectrum at the start design and, for a curve that varies, at designs around it,
 * so that a harmonic whose factor happens to be zero at the start is not lost. A curve that varies is
 * sampled again for each x. A section of a family of curves has one more argument, the number AT.
 * test  cos and sin to rounding; smooth curves against direct evaluation; gradient by differences */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "curve/modes.h"

enum { OF, AT }; /* AT: of a section alone; files say it through their patches */
enum { FIRST = 16, PROBES = 4, CHECKS = 5, WHERE = 100 };

static const double golden =
    0.61803398874989484820;              /* irrational: checks and probes miss every regular pattern */
static const double negligible = 1e-14;  /* of the largest coefficient: where a spectrum ends */
static const double visible = 1e-6;      /* of the largest coefficient: worth a warning when cut */
static const double close_enough = 1e-9; /* of the largest coefficient: gap of a curve that does close */

static const ves_key keys[] = {
    {.name = "of",
     .kind = VES_FORMULAS,
     .required = true,
     .about = "[\"x\", \"y\", \"z\"]: formulas of v, period 2 pi"},
    {.name = NULL},
};

typedef struct state {
    ves_modes_map map;
    size_t room; /* of the formulas */
} state;

/* What prepare works with. */
typedef struct work {
    const ves_formula *const *formula;
    int limit, longest;    /* longest: most samples */
    double *room, *sample; /* sample[c * count + j] */
    double *coef;
    double *slot; /* [slots], those that the formulas read */
    int slots;
    double at; /* of a section */
} work;

static bool is_section(const ves_curve_input *input)
{
    return input->args->count > AT;
}

static double section_at(const ves_curve_input *input)
{
    return is_section(input) ? ves_input_number(input, AT) : 0;
}

static double value(const work *w, int c, double v)
{
    return ves_formula_eval(w->formula[c], w->slot, (const double[]){v, w->at}, w->room);
}

static bool sample(const work *w, int count)
{
    bool finite = true;
    for (int c = 0; c < 3; c++)
        for (int j = 0; j < count; j++) {
            w->sample[c * count + j] = value(w, c, VES_TWO_PI * j / count);
            if (!isfinite(w->sample[c * count + j])) finite = false;
        }
    return finite;
}

/* Does the series agree with the formulas between the samples? Else a high harmonic has been taken for its
 * alias. */
static bool agrees(const work *w, int modes, double size)
{
    for (int k = 1; k <= CHECKS; k++) {
        double v = VES_TWO_PI * fmod(k * golden, 1), out[3];
        ves_curve_point(w->coef, modes, v, 0, out);
        for (int c = 0; c < 3; c++)
            if (!(fabs(value(w, c, v) - out[c]) <= 1e-11 * size)) return false;
    }
    return true;
}

/* Modes that the curve at w->slot has, doubling the samples until the last half of the spectrum is nothing.
 * -1: not finite. */
static int spectrum(const work *w, double *size)
{
    for (int count = FIRST;; count *= 2) {
        int modes = count / 2;
        if (!sample(w, count)) return -1;
        ves_curve_analyse(w->sample, count, modes, w->coef);
        *size = ves_modes_largest(w->coef, modes, 0);
        double tail = ves_modes_largest(w->coef, modes, count / 4 + 1);
        if (count < w->longest && (tail > negligible * *size || !agrees(w, modes, *size))) continue;
        while (modes > 0 && ves_modes_largest(w->coef, count / 2, modes) <= negligible * *size) modes--;
        return modes;
    }
}

static double shifted(double x, int slot, int number)
{
    double shift = fmod((slot + 1 + number) * golden, 1) - 0.5;
    return x + 0.5 * number * shift * (1 + fabs(x));
}

/* Slots at probe `number`: 0 the start, further ones around it. False: the formulas read nothing that varies. */
static bool probe(work *w, const ves_curve_input *input, int number)
{
    bool any = is_section(input) && ves_input_varies(input, AT);
    w->at = any ? shifted(section_at(input), w->slots, number) : section_at(input);
    for (int slot = 0; slot < w->slots; slot++) {
        if (!ves_input_reads(input, OF, slot)) continue;
        double x = input->number[slot];
        w->slot[slot] = input->varying[slot] ? shifted(x, slot, number) : x;
        any = any || input->varying[slot];
    }
    return any;
}

/* Modes for every probe. A trigonometric polynomial shows the same number at each: then that is exact. Else
 * twice the largest leaves room for designs far from the start. */
static int modes_for_all(work *w, const ves_curve_input *input, int start)
{
    int most = start, least = start;
    double size;
    for (int number = 1; number < PROBES && probe(w, input, number); number++) {
        int modes = spectrum(w, &size);
        if (modes > most) most = modes;
        if (modes >= 0 && modes < least) least = modes;
    }
    return most == least ? most : 2 * most;
}

/* " at w = 0.5", of a section. */
static void say_where(const ves_curve_input *input, const work *w, char text[WHERE])
{
    text[0] = 0;
    if (is_section(input)) snprintf(text, WHERE, " at %s = %.6g", input->args->key[AT].name, w->at);
}

static ves_status check(const ves_curve_input *input, const work *w, double size, ves_diag *diag)
{
    char where[WHERE];
    say_where(input, w, where);
    for (int c = 0; c < 3; c++) {
        double gap = value(w, c, VES_TWO_PI) - value(w, c, 0);
        if (!(fabs(gap) <= close_enough * size))
            return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, OF),
                                "the curve%s does not close: from v = 0 to v = 2*pi %c changes by %g", where,
                                "xyz"[c], gap);
    }
    return VES_OK;
}

/* Says so when the band limit cuts off something that will be seen: a corner, say. */
static void warn(const ves_curve_input *input, const work *w, int modes, double size, ves_diag *diag)
{
    double lost = ves_modes_largest(w->coef, w->longest / 2, w->limit + 1);
    if (lost > visible * size)
        ves_diag_add(diag, VES_WARNING, VES_OK, ves_input_mark(input, OF),
                     "the formulas have at least %d modes, a curve here at most %d: modes as large as %.1e "
                     "are left out",
                     modes, w->limit, lost);
}

static bool work_create(work *w, const ves_curve_input *input, size_t room, ves_arena *arena)
{
    w->formula = input->args->arg[OF].formula;
    w->slots = ves_input_slots(input, OF);
    w->limit = input->limit;
    for (w->longest = FIRST; w->longest < 4 * w->limit;) w->longest *= 2;
    w->room = ves_arena_doubles(arena, room);
    w->sample = ves_arena_doubles(arena, 3 * (size_t)w->longest);
    w->coef = ves_arena_doubles(arena, 3 * (size_t)ves_curve_stride(w->longest / 2));
    w->slot = ves_arena_doubles(arena, (size_t)w->slots);
    return w->room && w->sample && w->coef && w->slot;
}

static ves_status measure(work *w, const ves_curve_input *input, int *modes, ves_diag *diag)
{
    double size;
    char where[WHERE];
    probe(w, input, 0);
    *modes = spectrum(w, &size);
    say_where(input, w, where);
    if (*modes < 0)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, OF),
                            "the formulas are not finite numbers for every v from 0 to 2*pi%s", where);
    VES_TRY(check(input, w, size, diag));
    if (*modes > w->limit) warn(input, w, *modes, size, diag);
    *modes = modes_for_all(w, input, *modes);
    if (*modes > w->limit) *modes = w->limit;
    return VES_OK;
}

static ves_status prepare(const ves_curve_input *input, ves_arena *arena, void **out, ves_diag *diag)
{
    work w;
    int modes;
    state *s = ves_arena_take(arena, 1, sizeof *s);
    if (!s) return ves_input_memory(input, diag);
    for (int c = 0; c < 3; c++) {
        size_t room = (size_t)ves_formula_room(input->args->arg[OF].formula[c]);
        if (room > s->room) s->room = room;
    }
    if (!work_create(&w, input, s->room, arena)) return ves_input_memory(input, diag);
    VES_TRY(measure(&w, input, &modes, diag));
    *out = s;
    bool ok = ves_modes_map_create(2 * modes + 2, modes, NULL, arena, &s->map);
    return ok ? VES_OK : ves_input_memory(input, diag);
}

static int modes(const ves_curve_input *input)
{
    const state *s = input->state;
    return s->map.modes;
}

static size_t room(const ves_curve_input *input)
{
    const state *s = input->state;
    return 3 * (size_t)s->map.points + s->room;
}

static void eval(const ves_curve_input *input, double *out)
{
    const state *s = input->state;
    const ves_formula *const *formula = input->args->arg[OF].formula;
    double *point = input->room, *rest = point + 3 * s->map.points;
    for (int c = 0; c < 3; c++)
        for (int j = 0; j < s->map.points; j++) {
            const double argument[] = {VES_TWO_PI * j / s->map.points, section_at(input)};
            point[3 * j + c] = ves_formula_eval(formula[c], input->number, argument, rest);
        }
    ves_modes_map_eval(&s->map, point, out);
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)input_adjoint;
    const state *s = input->state;
    const ves_formula *const *formula = input->args->arg[OF].formula;
    double *seed = input->room, *rest = seed + 3 * s->map.points, argument_adjoint[2] = {0};
    memset(seed, 0, 3 * (size_t)s->map.points * sizeof *seed);
    ves_modes_map_gradient(&s->map, adjoint, seed);
    for (int c = 0; c < 3; c++)
        for (int j = 0; j < s->map.points; j++) {
            const double argument[] = {VES_TWO_PI * j / s->map.points, section_at(input)};
            ves_formula_gradient(formula[c], input->number, argument, seed[3 * j + c], number_adjoint,
                                 argument_adjoint, rest);
        }
    if (is_section(input)) ves_input_scatter(input, AT, 0, argument_adjoint[1], number_adjoint);
}

const ves_curve_op ves_curve_formula_op = {
    .name = "formula",
    .about = "three formulas of v",
    .keys = keys,
    .prepare = prepare,
    .modes = modes,
    .room = room,
    .eval = eval,
    .gradient = gradient,
};
