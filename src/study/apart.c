#include "study/apart.h"

#include <math.h>
#include <stdio.h>

#include "problem/problem.h"

/* What differs by less than this part of the largest difference is not told; nearer to 0 than `nothing` of its range
 * a variable is 0. */
static const double little = 0.1, nothing = 1e-6;

int ves_apart_tell(const ves_run *run, int index, int other, char text[VES_APART][VES_APART_TEXT])
{
    const ves_problem *p = run->problem;
    const double *x = run->optimum[index].x, *y = run->optimum[other].x;
    double most = HUGE_VAL, largest = 0;
    for (int count = 0; count < VES_APART; count++) {
        double next = 0;
        int which = -1;
        for (int k = 0; k < p->variables; k++) {
            const ves_variable *v = &p->variable[k];
            double apart = fabs(x[k] - y[k]) / (v->max - v->min);
            bool idle = run->idle && run->idle[k];
            if (!idle && apart < most && apart > next) next = apart, which = k;
        }
        if (!count) largest = next;
        if (which < 0 || next < little * largest) return count;
        most = next;
        const ves_variable *v = &p->variable[which];
        double value = fabs(x[which]) < nothing * (v->max - v->min) ? 0 : x[which] / v->shown.factor;
        snprintf(text[count], VES_APART_TEXT, "%.100s = %.4g%s%s", v->name, value, *v->shown.unit ? " " : "",
                 v->shown.unit);
    }
    return VES_APART;
}
