#include "measure/stress.h"

#include <math.h>
#include <string.h>

#include "base/domain.h"
#include "formula/formula.h"
#include "measure/argument.h"
#include "measure/power.h"

const ves_key ves_stress_keys[VES_STRESS_KEYS + 1] = {
    VES_SHELL_CASE,
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

/* A reported point, or one between two of them. */
typedef struct place {
    double at[NAMES], stress[VES_SHELL_LEVELS][VES_STRESSES];
} place;

static void place_at(const ves_measure_input *input, const ves_shell_stresses *s, int k, place *p)
{
    int sheet = s->sheet[k];
    for (int c = 0; c < 3; c++) p->at[AT_X + c] = s->X[c][k];
    ves_domain_at(input->shell->u_range[sheet], input->shell->v_range[sheet], s->u[k], s->v[k], &p->at[AT_U]);
    p->at[AT_THICKNESS] = s->thickness[k];
    memcpy(p->stress, s->stress[k], sizeof p->stress);
}

static bool counts(const ves_measure_input *input, const place *p)
{
    const ves_arg *where = &input->args->arg[VES_STRESS_WHERE];
    return !where->given || ves_formula_eval(where->formula[0], input->number, p->at, input->room) != 0;
}

/* The largest of the levels that count at a point. */
static double at_place(const ves_measure_input *input, const place *p, double (*of)(const double *stress))
{
    int through = input->args->arg[VES_STRESS_THROUGH].value;
    double most = 0;
    for (int level = 0; level < VES_SHELL_LEVELS; level++) {
        bool middle = level == 1;
        if (through && middle != (through == 2)) continue;
        most = fmax(most, of(p->stress[level]));
    }
    return most;
}

static void between(const place *a, const place *b, double t, place *p)
{
    for (int k = 0; k < NAMES; k++) p->at[k] = (1 - t) * a->at[k] + t * b->at[k];
    for (int l = 0; l < VES_SHELL_LEVELS; l++)
        for (int k = 0; k < VES_STRESSES; k++)
            p->stress[l][k] = (1 - t) * a->stress[l][k] + t * b->stress[l][k];
}

/* Where `where` ends between a point that counts and a neighbour that does not: stresses are often largest there. */
static double at_border(const ves_measure_input *input, const place *in, const place *out,
                        double (*of)(const double *stress))
{
    double low = 0, high = 1;
    place p = *in;
    for (int step = 0; step < 30; step++) {
        double middle = (low + high) / 2;
        between(in, out, middle, &p);
        *(counts(input, &p) ? &low : &high) = middle;
    }
    between(in, out, low, &p);
    return at_place(input, &p, of);
}

/* Point k, and the borders between it and those before it in its element; -1: nothing counts. at: of the element. */
static double largest_at(const ves_measure_input *input, const ves_shell_stresses *s, int k, int at,
                         double (*of)(const double *stress))
{
    const int *lattice = s->lattice[s->sheet[k]], before[2] = {1, lattice[0]};
    place p, other;
    place_at(input, s, k, &p);
    bool in = counts(input, &p);
    double most = in ? at_place(input, &p, of) : -1;
    for (int d = 0; d < 2 && input->args->arg[VES_STRESS_WHERE].given; d++) {
        if (d ? at < lattice[0] : at % lattice[0] == 0) continue;
        place_at(input, s, k - before[d], &other);
        if (counts(input, &other) == in) continue;
        most = fmax(most, in ? at_border(input, &p, &other, of) : at_border(input, &other, &p, of));
    }
    return most;
}

ves_status ves_stress_largest(const ves_measure_input *input, double (*of)(const double *stress),
                              double *value)
{
    const ves_shell_stresses *s =
        ves_shell_stress(input->shell->shell, input->args->arg[VES_STRESS_CASE].value);
    double p = ves_argument_number(input, VES_STRESS_SMOOTH), most = -1;
    for (int k = 0, at = 0; k < s->points; k++) {
        const int *lattice = s->lattice[s->sheet[k]];
        most = fmax(most, largest_at(input, s, k, at, of));
        at = at + 1 == lattice[0] * lattice[1] ? 0 : at + 1;
    }
    if (most < 0) return VES_NO_NUMBER;
    *value = most;
    if (!(p > 0) || most == 0) return VES_OK;
    ves_power power = {.p = p, .largest = most};
    for (int k = 0; k < s->points; k++) {
        place here;
        place_at(input, s, k, &here);
        if (counts(input, &here)) ves_power_add(&power, at_place(input, &here, of), s->area[k]);
    }
    ves_power_close(&power);
    *value = power.mean;
    return VES_OK;
}
