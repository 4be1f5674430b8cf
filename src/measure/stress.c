#include "measure/stress.h"

#include <math.h>

#include "formula/formula.h"
#include "measure/argument.h"
#include "measure/power.h"

const ves_key ves_stress_keys[VES_STRESS_KEYS + 1] = {
    {.name = "case", .kind = VES_CASE, .about = "the load case; may be left out when there is one"},
    {.name = "where",
     .kind = VES_SHELLWISE,
     .unit = "1",
     .about = "which part of the shell counts: a condition of x, y, z, u, v and thickness; everywhere unless "
              "given"},
    {.name = "through",
     .kind = VES_CHOICE,
     .words = "all|surfaces|middle",
     .about = "both surfaces and the mid-surface, or the ones or the other alone"},
    {.name = "smooth",
     .kind = VES_NUMBER,
     .unit = "1",
     .min = 0,
     .max = HUGE_VAL,
     .about = "0: the largest; p > 0: the power mean over the area, which is smooth for p >= 2 and nears the "
              "largest as p grows"},
    {.name = NULL}};

size_t ves_stress_room(const ves_measure_input *input)
{
    const ves_arg *where = &input->args->arg[VES_STRESS_WHERE];
    return where->given ? (size_t)ves_formula_room(where->formula[0]) : 0;
}

/* In the order of the arguments that the reader compiles SHELLWISE formulas with. */
enum { AT_X, AT_Y, AT_Z, AT_U, AT_V, AT_THICKNESS, NAMES };

static bool counts(const ves_measure_input *input, const ves_shell_stresses *s, int k)
{
    const ves_arg *where = &input->args->arg[VES_STRESS_WHERE];
    if (!where->given) return true;
    double at[NAMES];
    const double *u = input->shell->u_range[s->sheet[k]], *v = input->shell->v_range[s->sheet[k]];
    for (int c = 0; c < 3; c++) at[AT_X + c] = s->X[c][k];
    at[AT_U] = u[0] + (u[1] - u[0]) * s->u[k];
    at[AT_V] = v[0] + (v[1] - v[0]) / VES_TWO_PI * s->v[k];
    at[AT_THICKNESS] = s->thickness[k];
    return ves_formula_eval(where->formula[0], input->number, at, input->room) != 0;
}

/* The largest of the levels that count at a point. */
static double at_point(const ves_measure_input *input, const ves_shell_stresses *s, int k,
                       double (*of)(const double *stress))
{
    int through = input->args->arg[VES_STRESS_THROUGH].value;
    double most = 0;
    for (int level = 0; level < VES_SHELL_LEVELS; level++) {
        bool middle = level == 1;
        if (through && middle != (through == 2)) continue;
        most = fmax(most, of(s->stress[k][level]));
    }
    return most;
}

ves_status ves_stress_largest(const ves_measure_input *input, double (*of)(const double *stress),
                              double *value)
{
    const ves_shell_stresses *s =
        ves_shell_stress(input->shell->shell, input->args->arg[VES_STRESS_CASE].value);
    double p = ves_argument_number(input, VES_STRESS_SMOOTH), most = -1;
    for (int k = 0; k < s->points; k++)
        if (counts(input, s, k)) most = fmax(most, at_point(input, s, k, of));
    if (most < 0) return VES_NO_NUMBER;
    *value = most;
    if (!(p > 0) || most == 0) return VES_OK;
    ves_power power = {.p = p, .largest = most};
    for (int k = 0; k < s->points; k++)
        if (counts(input, s, k)) ves_power_add(&power, at_point(input, s, k, of), s->area[k]);
    ves_power_close(&power);
    *value = power.mean;
    return VES_OK;
}
