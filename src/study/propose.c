#include "study/propose.h"

#include <math.h>
#include <string.h>

enum { LOOKS = 9 }; /* along the range of a variable */

/* The measure that stands alone on the left side, with no other on the right; -1: it is not of this form. */
static int measure_of(const ves_problem *p, const ves_constraint_def *c)
{
    char op[3];
    int left, right, begin = 0, found = -1;
    if (ves_formula_split(c->text, op, &left, &right) != VES_OK) return -1;
    while (begin < left && c->text[begin] == ' ') begin++;
    while (left > begin && c->text[left - 1] == ' ') left--;
    const size_t length = (size_t)(left - begin);
    for (int m = 0; m < p->measures; m++) {
        const char *name = p->measure[m].name;
        if (ves_formula_uses_argument(c->right, m)) return -1;
        if (strlen(name) == length && !strncmp(name, c->text + begin, length)) found = m;
    }
    return found;
}

static bool scales(const ves_problem *p, const ves_constraint_def *c)
{
    int m = p->scale ? -1 : measure_of(p, c);
    if (m < 0) return false;
    int degree = p->measure[m].measure->degree;
    return degree && degree != VES_NO_DEGREE;
}

typedef struct line {
    ves_plan *plan;
    const ves_problem *problem;
    ves_arena *arena;
    double *x; /* [variables] the start */
} line;

/* left - right of every equation, along variable v: excess [LOOKS][constraints]; NAN where it is not measured. */
static ves_status look(const line *l, int v, double *excess)
{
    const ves_problem *p = l->problem;
    const ves_variable *variable = &p->variable[v];
    ves_status status = VES_OK;
    for (int k = 0; k < LOOKS && status >= VES_OK; k++) {
        ves_design design;
        l->x[v] = variable->min + (variable->max - variable->min) * k / (LOOKS - 1);
        status = ves_plan_measure(l->plan, l->x, 0, &design);
        for (int j = 0; j < p->constraints && status >= VES_OK; j++)
            excess[k * p->constraints + j] =
                status == VES_OK ? design.side[j].value - design.side[j].limit : NAN;
    }
    l->x[v] = variable->start;
    return status < VES_OK ? status : VES_OK;
}

/* How far constraint j runs from one sign to the other, always the same way; 0: it does not. */
static double crossing(const double *excess, int constraints, int j)
{
    double first = excess[j], last = excess[(LOOKS - 1) * constraints + j];
    if (!(first * last < 0)) return 0;
    for (int k = 1; k < LOOKS; k++) {
        double step = excess[k * constraints + j] - excess[(k - 1) * constraints + j];
        if (!(step * (last - first) > 0)) return 0;
    }
    return fabs(last - first);
}

/* The variable that moves an equation most, for the first equation that some variable can solve. */
static ves_status solvable(const line *l, ves_elimination *found, bool *any)
{
    const ves_problem *p = l->problem;
    const size_t m = (size_t)p->constraints;
    double *excess = ves_arena_take(l->arena, LOOKS * m, sizeof(double));
    double *most = ves_arena_take(l->arena, m, sizeof(double));
    int *by = ves_arena_take(l->arena, m, sizeof(int));
    if (!excess || !most || !by) return VES_MEMORY;
    for (int v = 0; v < p->variables; v++) {
        VES_TRY(look(l, v, excess));
        for (int j = 0; j < p->constraints; j++) {
            double far = p->constraint[j].relation != VES_EQUAL ? 0 : crossing(excess, (int)m, j);
            if (far > most[j]) most[j] = far, by[j] = v;
        }
    }
    for (int j = 0; j < p->constraints && !*any; j++)
        if (most[j] > 0) *any = true, *found = (ves_elimination){j, by[j]};
    return VES_OK;
}

ves_status ves_study_propose(ves_plan *plan, const ves_problem *problem, ves_arena *arena,
                             ves_elimination *list, int *count)
{
    const size_t n = (size_t)problem->variables;
    line l = {plan, problem, arena, ves_arena_take(arena, n, sizeof(double))};
    bool any = false;
    *count = 0;
    if (!l.x) return VES_MEMORY;
    for (size_t k = 0; k < n; k++) l.x[k] = problem->variable[k].start;
    for (int j = 0; j < problem->constraints; j++) {
        const ves_constraint_def *c = &problem->constraint[j];
        if (*count || c->relation != VES_EQUAL || !scales(problem, c)) continue;
        list[(*count)++] = (ves_elimination){j, -1};
    }
    if (problem->solve) return VES_OK;
    VES_TRY(solvable(&l, &list[*count], &any));
    *count += any;
    return VES_OK;
}
