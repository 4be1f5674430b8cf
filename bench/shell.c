/* How fast the shells of problem files are analysed: of each FILE the least over ROUNDS of the CPU time of a new design, with
 * all that its objective and its constraints ask for. Prints JSON Lines. */
#include <math.h>
#include <stdio.h>
#include <time.h>

#include "plan/inside.h"

enum { ROUNDS = 12, VARIABLES = 64 };

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
        ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
        x[0] += 1e-9 * (problem->variable[0].min < x[0] ? -1 : 1);
        double start = now();
        ves_plan_evaluate(plan, &ask, &verdict);
        least = fmin(least, now() - start);
        if (verdict.status != VES_OK) return NAN;
    }
    return 1e3 * least;
}

static bool time_file(const char *path)
{
    char message[2000];
    ves_diag *diag = ves_diag_create();
    ves_problem *problem = NULL;
    ves_plan *plan = NULL;
    ves_read_options options = {0};
    bool good = !ves_problem_read(path, &options, &problem, diag) && problem->variables <= VARIABLES &&
                !ves_plan_create(problem, NULL, &plan, diag);
    if (good)
        printf("{\"file\": \"%s\", \"ms\": %.3f}\n", path, least_ms(plan, problem));
    else
        ves_diag_text(diag, 0, message, sizeof message), fprintf(stderr, "%s\n", message);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
    return good;
}

int main(int count, char **path)
{
    bool good = count > 1;
    for (int k = 1; k < count; k++) good = time_file(path[k]) && good;
    return good ? 0 : 4;
}
