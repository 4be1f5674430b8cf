/* How fast the shell of a new design is analysed: the pot of bench/peers/calculix as a surface of revolution, with ridges (a
 * twenty-fourth of it is solved), with two mirror planes (a quarter) and whole; the largest shear, then the factor of buckling too,
 * over all classes. Prints JSON Lines: the least of ROUNDS rounds, CPU time of this thread, and the ratio to the whole pot's, of
 * factors to the stress before them. Give the checkout's folder if it is not the current one. */
#include <math.h>
#include <stdio.h>
#include <time.h>

#include "plan/inside.h"

enum { ROUNDS = 12, VARIABLES = 8, OVERRIDES = 3, LONGEST = 10000 };

#define RIDGED          "{ridge: {points: 24, by: cT*L, along: radial}}, "
#define INNER(z, ridge) "[{dilate: [d1Dx, 1, " z "]}, " ridge "{translate: [0 mm, d1Ty*L, 0 mm]}]"
#define OUTER(z)        "[{dilate: [d2Dx, 1, " z "]}, {translate: [0 mm, h + d2Ty*L, 0 mm]}]"
#define KEPT            "measures:\n  kept: {max_shear: {where: \"y > 4*thickness and y < h - thickness\"}}\n"
#define FACTOR          "  factor: {buckling: {}}\n"

typedef struct shape {
    const char *name, *inner, *outer, *symmetry;
} shape;
static const shape SHAPE[] = {{"whole", INNER("d1Dz", RIDGED), OUTER("d2Dz"), "none"},
                              {"quarter", INNER("d1Dz", RIDGED), OUTER("d2Dz"), "auto"},
                              {"ridges", INNER("d1Dx", RIDGED), OUTER("d2Dx"), "auto"},
                              {"revolution", INNER("d1Dx", ""), OUTER("d2Dx"), "auto"}};
enum { SHAPES = sizeof SHAPE / sizeof *SHAPE };

typedef struct goal {
    const char *name, *text; /* in the file */
} goal;
/* The second has the mesh of factors but does not ask for them. */
enum { STRESS, STRESS_THERE, FACTORS, GOALS };
static const goal GOAL[GOALS] = {
    [STRESS] = {"stress", KEPT "minimize: kept\n"},
    [STRESS_THERE] = {"stress, mesh for factors", KEPT FACTOR "minimize: kept\n"},
    [FACTORS] = {"stress and factors", KEPT FACTOR "minimize: kept + 0 Pa*factor\n"}};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double least_ms(ves_plan *plan, const ves_problem *problem)
{
    double x[VARIABLES], least = HUGE_VAL;
    for (int k = 0; k < problem->variables; k++) x[k] = problem->variable[k].start;
    for (int round = 0; round < ROUNDS; round++) {
        ves_verdict verdict = {0};
        const ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
        x[0] += 1e-9;
        double start = now();
        ves_plan_evaluate(plan, &ask, &verdict);
        least = fmin(least, now() - start);
        if (verdict.status != VES_OK) return NAN;
    }
    return 1e3 * least;
}

/* NAN, and the diagnostic: it cannot be measured. */
static double time_ms(const char *text, const shape *s, const goal *g)
{
    const ves_override set[OVERRIDES] = {
        {"curves.d1.apply", s->inner}, {"curves.d2.apply", s->outer}, {"shell.symmetry", s->symmetry}};
    const ves_read_options options = {.overrides = OVERRIDES, .override = set};
    char message[2000], all[LONGEST];
    double ms = NAN;
    ves_diag *diag = ves_diag_create();
    ves_problem *problem = NULL;
    ves_plan *plan = NULL;
    int length = snprintf(all, sizeof all, "%s%s", text, g->text);
    if (!ves_problem_read_text("pot.yaml", all, (size_t)length, &options, &problem, diag) &&
        problem->variables <= VARIABLES && !ves_plan_create(problem, NULL, &plan, diag))
        ms = least_ms(plan, problem);
    else
        ves_diag_text(diag, 0, message, sizeof message), fprintf(stderr, "%s\n", message);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
    return ms;
}

static bool read(const char *folder, char text[LONGEST / 2])
{
    char path[1000];
    snprintf(path, sizeof path, "%s/bench/peers/calculix/pot.yaml", folder);
    FILE *file = fopen(path, "r");
    if (!file) return false;
    size_t length = fread(text, 1, LONGEST / 2 - 1, file);
    text[length] = 0;
    fclose(file);
    return true;
}

static void report(const shape *s, const goal *g, double ms, const char *ratio, double of)
{
    printf("{\"shape\": \"%s\", \"asked\": \"%s\", \"ms\": %.3f, \"%s\": %.2f}\n", s->name, g->name, ms,
           ratio, of);
}

int main(int count, char **argument)
{
    char text[LONGEST / 2];
    double whole = NAN;
    if (!read(count > 1 ? argument[1] : ".", text)) {
        fprintf(stderr, "no bench/peers/calculix/pot.yaml here: give the folder of the checkout\n");
        return 2;
    }
    for (int k = 0; k < SHAPES; k++) {
        double ms[GOALS];
        for (int g = 0; g < (k == 0 ? 1 : GOALS); g++) {
            ms[g] = time_ms(text, &SHAPE[k], &GOAL[g]);
            if (isnan(ms[g])) return 4;
        }
        if (k == 0) whole = ms[STRESS];
        report(&SHAPE[k], &GOAL[STRESS], ms[STRESS], "whole_over_this", whole / ms[STRESS]);
        if (k) report(&SHAPE[k], &GOAL[FACTORS], ms[FACTORS], "over_stress", ms[FACTORS] / ms[STRESS_THERE]);
    }
    return 0;
}
