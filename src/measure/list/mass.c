#include <math.h>

#include "base/domain.h"
#include "formula/formula.h"
#include "shell/view.h"
#include "vesica/measure.h"

/* In the order of VES_SHELL_ARGUMENTS of the reader. */
enum { AT_X, AT_Y, AT_Z, AT_U, AT_V, NAMES };

static void place(const ves_samples *s, int n, double at[NAMES])
{
    for (int c = 0; c < 3; c++) at[AT_X + c] = s->X[c][n];
    ves_domain_at(s->u_range, s->v_range, s->u[n % s->nu], s->v[n / s->nu], &at[AT_U]);
}

static size_t room(const ves_measure_input *input)
{
    int most = 0;
    for (int i = 0; input->shell && i < input->samples; i++) {
        const ves_formula *t = input->shell->thickness[input->sample[i]->patch];
        if (t && ves_formula_room(t) > most) most = ves_formula_room(t);
    }
    return (size_t)most;
}

/* Volume of the wall: integral of the thickness over the patches that are parts of the shell. NAN: somewhere there is none. */
static double wall(const ves_measure_input *input)
{
    double sum = 0, at[NAMES];
    bool all = true;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        const ves_formula *t = input->shell->thickness[s->patch];
        for (int n = 0; t && n < s->count; n++) {
            place(s, n, at);
            double thickness = ves_formula_eval(t, input->number, at, input->room);
            all = all && thickness > 0;
            sum += thickness * s->dA[n];
        }
    }
    return all ? sum : NAN;
}

/* Density times thickness, over the mid-surface. By the quadrature of the surface, not by elements: as exact as its area.
 * test  cylinder with constant and with varying thickness; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    if (input->shell->density < 0) return VES_NO_NUMBER;
    *value = input->number[input->shell->density] * wall(input);
    return isnan(*value) ? VES_NO_WALL : VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    double density = input->number[input->shell->density];
    number_adjoint[input->shell->density] += seed * wall(input);
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        const ves_adjoint *a = adjoint[i];
        const ves_formula *t = input->shell->thickness[s->patch];
        for (int n = 0; t && n < s->count; n++) {
            double at[NAMES], back[NAMES] = {0}, weight = seed * density * s->dA[n];
            place(s, n, at);
            double thickness =
                ves_formula_gradient(t, input->number, at, weight, number_adjoint, back, input->room);
            for (int c = 0; c < 3 && a->X[0]; c++) a->X[c][n] += back[AT_X + c];
            if (a->dA) a->dA[n] += seed * density * thickness;
        }
    }
}

const ves_measure ves_measure_mass = {.name = "mass",
                                      .about = "mass of the shell: density times thickness over its parts",
                                      .unit = "kg",
                                      .degree = VES_NO_DEGREE,
                                      .surface = VES_X | VES_AREA,
                                      .shell = true,
                                      .room = room,
                                      .eval = eval,
                                      .gradient = gradient};
