#include "study/facts.h"

#include <math.h>
#include <string.h>

#include "surface/patch.h"

/* The whole number block at the start design. */
static double *block_make(const ves_problem *p, const double *slot, ves_arena *arena)
{
    double *block = ves_arena_take(arena, (size_t)p->block, sizeof *block);
    if (!block) return NULL;
    memcpy(block, slot, sizeof *slot * (size_t)p->slots);
    for (int k = 0; k < p->numbers; k++) {
        double *room = ves_arena_take(arena, (size_t)ves_formula_room(p->number[k]), sizeof *room);
        if (!room) return NULL;
        block[p->slots + k] = ves_formula_eval(p->number[k], slot, NULL, room);
    }
    return block;
}

static double coefficient(const ves_curves *curves, int curve, int c, int k)
{
    int width = curve < 0 ? 0 : ves_curve_stride(ves_curves_modes(curves, curve));
    return k < width ? ves_curves_coef(curves, curve)[c * width + k] : 0;
}

/* The sum of squares of modes first .. last of curve - from. */
static double power(const ves_curves *curves, const ves_condition *d, int first, int last)
{
    double sum = 0;
    for (int c = 0; c < 3; c++)
        for (int k = 2 * first - 1; k <= 2 * last; k++) {
            double f = coefficient(curves, d->curve, c, k) - coefficient(curves, d->from, c, k);
            sum += f * f;
        }
    return sum;
}

static ves_patch_facts look(const ves_curves *curves, const ves_patch_def *def)
{
    ves_patch_facts f = {0};
    for (int k = 0; k < def->conditions; k++) {
        int curve[2] = {def->condition[k].curve, def->condition[k].from};
        for (int side = 0; side < 2; side++)
            if (curve[side] >= 0 && ves_curves_modes(curves, curve[side]) > f.band)
                f.band = ves_curves_modes(curves, curve[side]);
    }
    int most = def->modes > 0 ? def->modes : VES_PATCH_MODES;
    f.modes = f.band < most ? f.band : most;
    for (int k = 0; k < def->conditions; k++) {
        double all = power(curves, &def->condition[k], 1, f.band);
        double rest = power(curves, &def->condition[k], f.modes + 1, f.band);
        if (all > 0) f.tail = fmax(f.tail, sqrt(rest / all));
    }
    return f;
}

ves_status ves_study_facts(const ves_problem *problem, const double *slot, ves_patch_facts *facts)
{
    ves_arena arena = {0};
    ves_curves *curves = NULL;
    double *block = block_make(problem, slot, &arena);
    ves_status status = block ? ves_curves_create(problem->curve, problem->curves, problem->curve_limit,
                                                  block, problem->varying, &arena, &curves, NULL)
                              : VES_MEMORY;
    if (status == VES_OK) ves_curves_bind(curves, block);
    for (int k = 0; status == VES_OK && k < problem->patches; k++)
        facts[k] =
            problem->patch[k].kind == VES_PATCH_PDE ? look(curves, &problem->patch[k]) : (ves_patch_facts){0};
    ves_arena_destroy(&arena);
    return status;
}
