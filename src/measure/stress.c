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

/* In the order of the arguments that the reader compiles SHELLWISE formulas with. */
enum { AT_X, AT_Y, AT_Z, AT_U, AT_V, AT_THICKNESS, NAMES };

/* A reported point, or one between two of them. */
typedef struct place {
    double at[NAMES], stress[VES_SHELL_LEVELS][VES_STRESSES];
} place;

/* Where the largest is: at a point, or (beyond >= 0) at the border of `where` a part t of the way to its neighbour. */
typedef struct peak {
    double value, t; /* value < 0: nothing counts */
    int point, beyond;
} peak;

typedef struct state {
    ves_arena arena;
    const ves_formula *margin; /* of `where` */
    double *room;              /* of that */
    peak largest;              /* of eval */
} state;

ves_status ves_stress_prepare(const ves_measure_input *input, void **out)
{
    const ves_arg *where = &input->args->arg[VES_STRESS_WHERE];
    state *s = ves_memory_take(sizeof *s);
    if (!s) return VES_MEMORY;
    *s = (state){.margin = NULL};
    *out = s;
    if (!where->given) return VES_OK;
    s->margin = ves_formula_margin(where->formula[0], &s->arena);
    s->room = ves_arena_doubles(&s->arena, s->margin ? (size_t)ves_formula_room(s->margin) : 0);
    return s->margin && s->room ? VES_OK : VES_MEMORY;
}

void ves_stress_release(void *of)
{
    state *s = of;
    ves_arena_destroy(&s->arena);
    ves_memory_free(s);
}

size_t ves_stress_room(const ves_measure_input *input)
{
    const ves_arg *where = &input->args->arg[VES_STRESS_WHERE];
    return where->given ? (size_t)ves_formula_room(where->formula[0]) : 0;
}

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
static double at_place(const ves_measure_input *input, const place *p, ves_stress_of *of, int *at)
{
    int through = input->args->arg[VES_STRESS_THROUGH].value;
    double most = 0;
    *at = through == 2 ? 1 : 0;
    for (int level = 0; level < VES_SHELL_LEVELS; level++) {
        bool middle = level == 1;
        if (through && middle != (through == 2)) continue;
        double here = of(p->stress[level]);
        if (here > most) most = here, *at = level;
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
static double border(const ves_measure_input *input, const place *in, const place *out, place *at)
{
    double low = 0, high = 1;
    for (int step = 0; step < 30; step++) {
        double middle = (low + high) / 2;
        between(in, out, middle, at);
        *(counts(input, at) ? &low : &high) = middle;
    }
    between(in, out, low, at);
    return low;
}

static void consider(peak *largest, peak other)
{
    if (other.value > largest->value) *largest = other;
}

/* Point k, and the borders between it and those before it in its element. at: of the element. */
static void largest_at(const ves_measure_input *input, const ves_shell_stresses *s, int k, int at,
                       ves_stress_of *of, peak *largest)
{
    const int *lattice = s->lattice[s->sheet[k]], before[2] = {1, lattice[0]};
    place p, other, middle;
    int level;
    place_at(input, s, k, &p);
    bool in = counts(input, &p);
    if (in) consider(largest, (peak){at_place(input, &p, of, &level), 0, k, -1});
    for (int d = 0; d < 2 && input->args->arg[VES_STRESS_WHERE].given; d++) {
        if (d ? at < lattice[0] : at % lattice[0] == 0) continue;
        int beside = k - before[d];
        place_at(input, s, beside, &other);
        if (counts(input, &other) == in) continue;
        double t = in ? border(input, &p, &other, &middle) : border(input, &other, &p, &middle);
        consider(largest, (peak){at_place(input, &middle, of, &level), t, in ? k : beside, in ? beside : k});
    }
}

static ves_power power_of(const ves_measure_input *input, const ves_shell_stresses *s, ves_stress_of *of,
                          double largest)
{
    ves_power power = {.p = ves_argument_number(input, VES_STRESS_SMOOTH), .largest = largest};
    for (int k = 0; k < s->points; k++) {
        place here;
        int level;
        place_at(input, s, k, &here);
        if (counts(input, &here)) ves_power_add(&power, at_place(input, &here, of, &level), s->area[k]);
    }
    ves_power_close(&power);
    return power;
}

static const ves_shell_stresses *stresses(const ves_measure_input *input)
{
    return ves_shell_stress(input->shell->shell, input->args->arg[VES_STRESS_CASE].value);
}

ves_status ves_stress_largest(const ves_measure_input *input, ves_stress_of *of, double *value)
{
    const ves_shell_stresses *s = stresses(input);
    peak largest = {.value = -1};
    for (int k = 0, at = 0; k < s->points; k++) {
        const int *lattice = s->lattice[s->sheet[k]];
        largest_at(input, s, k, at, of, &largest);
        at = at + 1 == lattice[0] * lattice[1] ? 0 : at + 1;
    }
    ((state *)input->state)->largest = largest;
    if (largest.value < 0) return VES_NO_NUMBER;
    *value = largest.value;
    if (!(ves_argument_number(input, VES_STRESS_SMOOTH) > 0) || largest.value == 0) return VES_OK;
    *value = power_of(input, s, of, largest.value).mean;
    return VES_OK;
}

/* --- gradients --- */

static void stress_read(ves_shell_reading *r, int point, int level, double factor, const double *slope)
{
    for (int k = 0; k < VES_STRESSES; k++) r->stress[point][level][k] += factor * slope[k];
}

static void place_read(ves_shell_reading *r, int point, double factor, const double *by)
{
    for (int c = 0; c < 3; c++) r->X[c][point] += factor * by[AT_X + c];
    r->thickness[point] += factor * by[AT_THICKNESS];
}

/* The border goes along with its margin m(at): t changes by - dm / (m' (b - a)), and with it what is between a and b. */
static void border_read(const ves_measure_input *input, const place pair[2], const place *here, double by_t,
                        double *number_adjoint)
{
    const state *s = input->state;
    const peak *p = &s->largest;
    ves_shell_reading *r = &input->shell->reading[input->args->arg[VES_STRESS_CASE].value];
    double slope[NAMES] = {0}, by[NAMES] = {0}, along = 0;
    ves_formula_gradient(s->margin, input->number, here->at, 1, NULL, slope, s->room);
    for (int k = 0; k < NAMES; k++) along += slope[k] * (pair[1].at[k] - pair[0].at[k]);
    if (along == 0) return;
    ves_formula_gradient(s->margin, input->number, here->at, -by_t / along, number_adjoint, by, s->room);
    place_read(r, p->point, 1 - p->t, by);
    place_read(r, p->beyond, p->t, by);
}

static void largest_read(const ves_measure_input *input, const ves_stress_kind *kind, double seed,
                         double *number_adjoint)
{
    const peak *p = &((const state *)input->state)->largest;
    const ves_shell_stresses *s = stresses(input);
    ves_shell_reading *r = &input->shell->reading[input->args->arg[VES_STRESS_CASE].value];
    const int beyond = p->beyond < 0 ? p->point : p->beyond;
    place pair[2], here;
    int level;
    double slope[VES_STRESSES], by_t = 0;
    place_at(input, s, p->point, &pair[0]), place_at(input, s, beyond, &pair[1]);
    between(&pair[0], &pair[1], p->t, &here);
    at_place(input, &here, kind->of, &level);
    kind->slope(here.stress[level], slope);
    stress_read(r, p->point, level, seed * (1 - p->t), slope);
    if (p->beyond < 0) return;
    stress_read(r, beyond, level, seed * p->t, slope);
    for (int k = 0; k < VES_STRESSES; k++)
        by_t += seed * slope[k] * (pair[1].stress[level][k] - pair[0].stress[level][k]);
    border_read(input, pair, &here, by_t, number_adjoint);
}

/* Which points count is taken as given. */
static void mean_read(const ves_measure_input *input, const ves_stress_kind *kind, double seed,
                      double *number_adjoint)
{
    const ves_shell_stresses *s = stresses(input);
    ves_shell_reading *r = &input->shell->reading[input->args->arg[VES_STRESS_CASE].value];
    const ves_power power = power_of(input, s, kind->of, ((const state *)input->state)->largest.value);
    for (int k = 0; k < s->points; k++) {
        place here;
        int level;
        double slope[VES_STRESSES];
        place_at(input, s, k, &here);
        if (!counts(input, &here)) continue;
        ves_power_slope by = ves_power_gradient(&power, at_place(input, &here, kind->of, &level), s->area[k]);
        kind->slope(here.stress[level], slope);
        stress_read(r, k, level, seed * by.x, slope);
        r->area[k] += seed * by.w;
    }
    ves_argument_scatter(input, VES_STRESS_SMOOTH, 0, seed * ves_power_by_exponent(&power), number_adjoint);
}

void ves_stress_gradient(const ves_measure_input *input, const ves_stress_kind *kind, double seed,
                         double *number_adjoint)
{
    const double largest = ((const state *)input->state)->largest.value;
    if (!(largest > 0)) return;
    input->shell->reading[input->args->arg[VES_STRESS_CASE].value].stressed = true;
    if (ves_argument_number(input, VES_STRESS_SMOOTH) > 0)
        mean_read(input, kind, seed, number_adjoint);
    else
        largest_read(input, kind, seed, number_adjoint);
}
