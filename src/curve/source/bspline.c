/* Periodic uniform cubic B-spline  C(v) = sum_j P_j B((v - v_j) / h), h = 2 pi / N, v_j = j h  [Ugail
 * 2011, eqs 2.4-2.5, 6.2, 7.6]. Control point j pulls most at v_j: C(v_j) = (P_{j-1} + 4 P_j + P_{j+1}) /
 * 6. The transform of the cubic B is sinc^4, so the modes are those of the control points, continued
 * periodically in n, times sinc^4(pi n / N): nothing is sampled. To interpolate, the circulant system with
 * rows (1 4 1)/6 is solved in the same basis, where it is a division by (2 + cos(2 pi n / N)) / 3.
 * test  de Boor; hits its points; partition of unity */
#include <math.h>

#include "base/vector.h"
#include "curve/modes.h"

enum { POINTS, INTERPOLATE, LEAST = 3 };

static const ves_key keys[] = {
    {.name = "points",
     .kind = VES_POINTS,
     .required = true,
     .about = "[[x, y, z], ...]: at least 3, the first is not repeated at the end"},
    {.name = "interpolate",
     .kind = VES_FLAG,
     .about = "true: the curve goes through the points, at v = 2 pi j / N; false: they are control points"},
    {.name = NULL},
};

static double factor(int n, int points, bool interpolate)
{
    double s = ves_sinc(VES_PI * n / points), value = s * s * s * s;
    return interpolate ? 3 * value / (2 + cos(2 * VES_PI * n / points)) : value;
}

/* Cuts the table to the modes that constant control points need. */
static bool trim(const double *point, ves_modes_map *map, ves_arena *arena)
{
    double *coef = ves_arena_doubles(arena, 3 * (size_t)ves_curve_stride(map->modes));
    if (!coef) return false;
    ves_modes_map_eval(map, point, coef);
    map->modes = ves_modes_needed(coef, map->modes);
    return true;
}

static ves_status prepare(const ves_curve_input *input, ves_arena *arena, void **state, ves_diag *diag)
{
    int count;
    const double *point = ves_input_list(input, POINTS, &count);
    if (count < 3 * LEAST)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, POINTS),
                            "a closed spline needs at least %d points, found %d", LEAST, count / 3);
    ves_modes_map *map = ves_arena_take(arena, 1, sizeof *map);
    double *factors = ves_arena_doubles(arena, (size_t)input->limit + 1);
    if (!map || !factors) return ves_input_memory(input, diag);
    bool interpolate = input->args->arg[INTERPOLATE].value;
    for (int n = 0; n <= input->limit; n++) factors[n] = factor(n, count / 3, interpolate);
    bool ok = ves_modes_map_create(count / 3, input->limit, factors, arena, map);
    if (ok && !ves_input_varies(input, POINTS)) ok = trim(point, map, arena);
    *state = map;
    return ok ? VES_OK : ves_input_memory(input, diag);
}

static int modes(const ves_curve_input *input)
{
    const ves_modes_map *map = input->state;
    return map->modes;
}

static size_t room(const ves_curve_input *input)
{
    const ves_modes_map *map = input->state;
    return 3 * (size_t)map->points;
}

static void eval(const ves_curve_input *input, double *out)
{
    int count;
    ves_modes_map_eval(input->state, ves_input_list(input, POINTS, &count), out);
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)input_adjoint;
    int count;
    ves_input_list(input, POINTS, &count);
    for (int i = 0; i < count; i++) input->room[i] = 0;
    ves_modes_map_gradient(input->state, adjoint, input->room);
    for (int i = 0; i < count; i++) ves_input_scatter(input, POINTS, i, input->room[i], number_adjoint);
}

const ves_curve_op ves_curve_bspline_op = {
    .name = "bspline",
    .about = "a closed uniform cubic B-spline",
    .keys = keys,
    .prepare = prepare,
    .modes = modes,
    .room = room,
    .eval = eval,
    .gradient = gradient,
};
