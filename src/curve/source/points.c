/* A curve through given points, say of a scan.
 *   uniform     point j lies at v = 2 pi j / N exactly: trigonometric interpolation, linear in the points
 *               [Ugail 2011, eqs 4.24-4.27]
 *   arc_length  equal steps in v are equal distances along the closed cubic spline through the points
 *               (chord-length knots); not linear, so only for points that do not vary
 * test  hits its points; constant speed */
#include <math.h>
#include <string.h>

#include "curve/arc.h"
#include "curve/modes.h"

enum { POINTS, PARAMETRIZE };
enum { UNIFORM, ARC_LENGTH };
enum { LEAST = 3, OVERSAMPLE = 4 };

static const ves_key keys[] = {
    {.name = "points",
     .kind = VES_POINTS,
     .required = true,
     .about = "[[x, y, z], ...]: at least 3, the first is not repeated at the end"},
    {.name = "parametrize",
     .kind = VES_CHOICE,
     .fallback = UNIFORM,
     .words = "uniform|arc_length",
     .about = "uniform: equal steps of v from point to point; arc_length: v proportional to length along the "
              "curve"},
    {.name = NULL},
};

typedef struct state {
    ves_modes_map map; /* uniform */
    double *coef;      /* arc length: the finished curve */
    int modes;
} state;

static bool by_length(const ves_curve_input *input)
{
    return input->args->arg[PARAMETRIZE].value == ARC_LENGTH;
}

static ves_status check(const ves_curve_input *input, const double *point, int points, ves_diag *diag)
{
    ves_mark mark = ves_input_mark(input, POINTS);
    if (points < LEAST)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, mark,
                            "a closed curve needs at least %d points, found %d", LEAST, points);
    if (!by_length(input) && points / 2 > input->limit)
        return ves_diag_add(
            diag, VES_ERROR, VES_RANGE, mark,
            "%d points need %d modes, but a curve may have at most %d here; thin them out, or write "
            "parametrize: arc_length",
            points, points / 2, input->limit);
    if (by_length(input) && ves_input_varies(input, POINTS))
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, mark,
                            "points that depend on a variable cannot be parametrized by arc length; write "
                            "parametrize: uniform");
    for (int i = 0; i < points; i++)
        if (!memcmp(point + 3 * i, point + 3 * ((i + 1) % points), 3 * sizeof *point) && by_length(input))
            return ves_diag_add(diag, VES_ERROR, VES_RANGE, mark,
                                i + 1 < points
                                    ? "points %d and %d are the same"
                                    : "point %d repeats point %d: leave it out, the curve closes by itself",
                                i + 1, (i + 1) % points + 1);
    return VES_OK;
}

static bool measure_out(const double *point, int points, int limit, ves_arena *arena, state *s)
{
    int count = OVERSAMPLE * (limit > points ? limit : points);
    double *sample = ves_arena_doubles(arena, 3 * (size_t)count);
    double *wide = ves_arena_doubles(arena, 3 * (size_t)ves_curve_stride(limit));
    s->coef = ves_arena_doubles(arena, 3 * (size_t)ves_curve_stride(limit));
    if (!sample || !wide || !s->coef || !ves_arc_sample(point, points, count, arena, sample)) return false;
    ves_curve_analyse(sample, count, limit, wide);
    s->modes = ves_modes_needed(wide, limit);
    int from = ves_curve_stride(limit), to = ves_curve_stride(s->modes);
    for (int k = 0; k < 3 * to; k++) s->coef[k] = wide[k / to * from + k % to];
    return true;
}

static ves_status prepare(const ves_curve_input *input, ves_arena *arena, void **out, ves_diag *diag)
{
    int count;
    const double *point = ves_input_list(input, POINTS, &count);
    VES_TRY(check(input, point, count / 3, diag));
    state *s = ves_arena_take(arena, 1, sizeof *s);
    if (!s) return ves_input_memory(input, diag);
    s->modes = count / 3 / 2;
    *out = s;
    bool ok = by_length(input) ? measure_out(point, count / 3, input->limit, arena, s)
                               : ves_modes_map_create(count / 3, s->modes, NULL, arena, &s->map);
    return ok ? VES_OK : ves_input_memory(input, diag);
}

static int modes(const ves_curve_input *input)
{
    const state *s = input->state;
    return s->modes;
}

static size_t room(const ves_curve_input *input)
{
    int count;
    ves_input_list(input, POINTS, &count);
    return (size_t)count;
}

static void eval(const ves_curve_input *input, double *out)
{
    const state *s = input->state;
    int count;
    const double *point = ves_input_list(input, POINTS, &count);
    if (s->coef)
        memcpy(out, s->coef, 3 * (size_t)ves_curve_stride(s->modes) * sizeof *out);
    else
        ves_modes_map_eval(&s->map, point, out);
}

/* Called for uniform points alone: those by arc length do not vary. */
static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)input_adjoint;
    const state *s = input->state;
    int count;
    ves_input_list(input, POINTS, &count);
    for (int i = 0; i < count; i++) input->room[i] = 0;
    if (!s->coef) ves_modes_map_gradient(&s->map, adjoint, input->room);
    for (int i = 0; i < count; i++) ves_input_scatter(input, POINTS, i, input->room[i], number_adjoint);
}

const ves_curve_op ves_curve_points_op = {
    .name = "points",
    .about = "a closed curve through points",
    .keys = keys,
    .prepare = prepare,
    .modes = modes,
    .room = room,
    .eval = eval,
    .gradient = gradient,
};
