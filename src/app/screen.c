/* What people read when a run is done. */
#include <math.h>
#include <string.h>

#include "app/app.h"
#include "app/table.h"

/* A variable this near to its limit, relative to its range, lies on it. */
static const double AT_LIMIT = 1e-6;

const char *app_screen_number(double value, char buffer[32])
{
    snprintf(buffer, 32, "%.7g", value);
    return buffer;
}

/* 24310 -> 24,310 */
const char *app_screen_thousands(long value, char buffer[32])
{
    char digits[24];
    int length = snprintf(digits, sizeof digits, "%ld", value), to = 0;
    for (int k = 0; k < length; k++) {
        if (k && (length - k) % 3 == 0 && digits[k - 1] != '-') buffer[to++] = ',';
        buffer[to++] = digits[k];
    }
    buffer[to] = 0;
    return buffer;
}

const char *app_screen_time(double seconds, char buffer[32])
{
    if (seconds < 1e-3)
        snprintf(buffer, 32, "%.3g us", 1e6 * seconds);
    else if (seconds < 1)
        snprintf(buffer, 32, "%.3g ms", 1e3 * seconds);
    else if (seconds < 100)
        snprintf(buffer, 32, "%.3g s", seconds);
    else
        snprintf(buffer, 32, "%.0f s", seconds);
    return buffer;
}

const char *app_screen_plural(long count, const char *one, const char *many, char buffer[64])
{
    char number[32];
    if (count)
        snprintf(buffer, 64, "%s %s", app_screen_thousands(count, number), count == 1 ? one : many);
    else
        snprintf(buffer, 64, "no %s", many);
    return buffer;
}

/* Decimals that show a millionth of the range: numbers of a column stand point under point, and what is
 * rounding beside the range is shown as 0. */
static const char *in_range(double value, const ves_variable *v, char buffer[32])
{
    double decimals = 6 - floor(log10(v->max - v->min));
    if (!(decimals >= 0 && decimals <= 12)) return app_screen_number(value, buffer);
    snprintf(buffer, 32, "%.*f", (int)decimals, value);
    bool zero = !strpbrk(buffer, "123456789");
    if (zero && *buffer == '-') memmove(buffer, buffer + 1, strlen(buffer));
    return buffer;
}

/* " m^2"; nothing where the file has no units. */
static const char *unit_of(const ves_problem *problem, ves_dim dim, char buffer[64])
{
    char unit[48];
    ves_dim_text(dim, unit);
    bool plain = !problem->units || dim.any || !strcmp(unit, "1");
    snprintf(buffer, 64, "%s%s", plain ? "" : " ", plain ? "" : unit);
    return buffer;
}

static void goal(const ves_problem *problem, const ves_design *best, const ves_design *start, FILE *out)
{
    char a[32], b[32];
    if (!problem->objective) return;
    fprintf(out, "  %s %s   %s", problem->maximize ? "maximize" : "minimize", problem->objective_text,
            isnan(best->objective) ? "no number" : app_screen_number(best->objective, a));
    if (start && !isnan(start->objective)) {
        fprintf(out, "   start %s", app_screen_number(start->objective, b));
        double change = 100 * (best->objective / start->objective - 1);
        if (!start->feasible)
            fputs(", which violates a constraint", out); /* then the change says nothing */
        else if (isfinite(change))
            fprintf(out, "   %+.1f %%", change);
    }
    fputs("\n\n", out);
}

static void constraints(const ves_problem *problem, const ves_design *design, FILE *out)
{
    app_table t = {.align = "lrrl"};
    if (!problem->constraints) return;
    app_table_cell(&t, "constraint");
    app_table_cell(&t, "value");
    app_table_cell(&t, "limit");
    app_table_end(&t);
    for (int k = 0; k < problem->constraints; k++) {
        const ves_sides *s = &design->side[k];
        app_table_cell(&t, "%s", problem->constraint[k].text);
        app_table_number(&t, s->value);
        app_table_number(&t, s->limit);
        if (isnan(s->violation))
            app_table_cell(&t, "not measured");
        else if (s->violation <= problem->constraint[k].within)
            app_table_cell(&t, "ok");
        else
            app_table_cell(&t, "VIOLATED by %.2g of its size", s->violation);
    }
    app_table_print(&t, out);
    fputc('\n', out);
}

static const char *limit(const ves_variable *v, double x)
{
    double near = AT_LIMIT * (v->max - v->min);
    if (x <= v->min + near) return "at its lower limit: the optimum may lie outside";
    if (x >= v->max - near) return "at its upper limit: the optimum may lie outside";
    return "";
}

static void variables(const ves_run *run, FILE *out)
{
    const ves_problem *p = run->problem;
    app_table t = {.align = "lrrll"};
    char unit[64], low[32], high[32];
    if (!p->variables) return;
    app_table_cell(&t, "variable");
    app_table_cell(&t, "start");
    app_table_cell(&t, run->searched ? "best" : "");
    app_table_cell(&t, "range");
    app_table_end(&t);
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        app_table_cell(&t, "%s", v->name);
        app_table_number(&t, run->start.x[k]);
        app_table_cell(&t, "%s", run->searched ? in_range(run->best.x[k], v, low) : "");
        app_table_cell(&t, "[%s, %s]%s", app_screen_number(v->min, low), app_screen_number(v->max, high),
                       unit_of(p, v->dim, unit));
        app_table_cell(&t, "%s", run->searched ? limit(v, run->best.x[k]) : "");
    }
    app_table_print(&t, out);
    fputc('\n', out);
}

/* Measures, and what the equations of solve: and scale: found. */
static void measures(const ves_problem *p, const ves_design *best, const ves_design *start, FILE *out)
{
    app_table t = {.align = "lrrl"};
    char unit[64];
    if (!p->measures && !p->solve && !p->scale) return;
    app_table_cell(&t, "measure");
    if (start) app_table_cell(&t, "start");
    app_table_cell(&t, start ? "best" : "value");
    app_table_end(&t);
    for (int k = 0; k < p->measures; k++) {
        app_table_cell(&t, "%s", p->measure[k].name);
        if (start) app_table_number(&t, start->measure[k]);
        app_table_number(&t, best->measure[k]);
        if (!start) app_table_cell(&t, "%s", "");
        app_table_cell(&t, "%s", unit_of(p, p->measure[k].dim, unit));
    }
    if (p->solve) {
        app_table_cell(&t, "%s (solved)", p->solve->name);
        if (start) app_table_number(&t, start->status == VES_OK ? start->slot[p->variables] : NAN);
        app_table_number(&t, best->status == VES_OK ? best->slot[p->variables] : NAN);
        if (!start) app_table_cell(&t, "%s", "");
        app_table_cell(&t, "%s", unit_of(p, p->solve->dim, unit));
    }
    if (p->scale) {
        app_table_cell(&t, "scale");
        if (start) app_table_number(&t, start->similarity);
        app_table_number(&t, best->similarity);
        app_table_end(&t);
    }
    app_table_print(&t, out);
    fputc('\n', out);
}

static void optima(const ves_run *run, app_table *t)
{
    char number[32]; /* distinct optima may differ late: more digits than elsewhere */
    if (run->optima < 2 && !(run->optima == 1 && run->optimum[0].saddle)) return;
    for (int k = 0; k < run->optima && k < 8; k++) {
        const ves_run_optimum *o = &run->optimum[k];
        app_table_cell(t, k ? "" : run->optima == 1 ? "optimum" : "optima");
        snprintf(number, sizeof number, "%#.9g", o->value);
        app_table_cell(t, "%s   found %s%s%s", number, o->hits == 1 ? "once" : "",
                       o->hits == 1 ? "" : app_screen_thousands(o->hits, (char[32]){0}),
                       o->hits == 1 ? "" : " times");
        if (o->saddle)
            t->cell[t->cells - 1] = ves_arena_format(&t->arena, "%s   a saddle", t->cell[t->cells - 1]);
    }
    if (run->optima > 8) {
        app_table_cell(t, "%s", "");
        app_table_cell(t, "and %d more in result.json", run->optima - 8);
    }
}

static void expectations(const ves_run *run, app_table *t)
{
    int held = 0;
    if (!run->expects) return;
    for (int k = 0; k < run->expects; k++) held += run->expect[k].passed;
    app_table_cell(t, "expected");
    app_table_cell(t, "%d of %d hold", held, run->expects);
    for (int k = 0; k < run->expects; k++) {
        if (run->expect[k].passed) continue;
        app_table_cell(t, "%s", "");
        app_table_cell(t, "FAILED  %s", run->expect[k].text);
    }
}

static void effort(const ves_run *run, app_table *t)
{
    char evaluations[64], gradients[64], time[32];
    if (!run->searched) return;
    app_table_cell(t, "searched");
    app_table_cell(t, "%s, %s, %s, seed %llu",
                   app_screen_plural(run->evaluations, "evaluation", "evaluations", evaluations),
                   app_screen_plural(run->gradients, "gradient", "gradients", gradients),
                   app_screen_time(run->times.search, time), (unsigned long long)run->seed);
    app_table_cell(t, "stopped");
    app_table_cell(t, "%s", run->stop);
}

static void remarks(const ves_run *run, FILE *out)
{
    app_table t = {.align = "ll"};
    const int *q = run->quadrature;
    if (!isnan(run->finer_change)) {
        app_table_cell(&t, "checked");
        app_table_cell(&t, "%d x %d and %d x %d nodes a patch differ by %.1e at most", q[0], q[1], 2 * q[0],
                       2 * q[1], run->finer_change);
    }
    optima(run, &t);
    expectations(run, &t);
    effort(run, &t);
    for (int k = 0; k < run->notes; k++) {
        app_table_cell(&t, k ? "" : "notes");
        app_table_cell(&t, "%s", run->note[k]);
    }
    app_table_print(&t, out);
}

static void conclusion(const ves_run *run, FILE *out)
{
    if (run->interrupted) fputs("\n  interrupted: this is the best so far\n", out);
    if (!run->any)
        fputs("\n  no design could be measured\n", out);
    else if (!run->feasible && run->best.violation > 0)
        fprintf(out, "\n  no design met all constraints: the least violation is %.2g\n", run->best.violation);
    else if (!run->feasible)
        fputs("\n  the result did not pass its checks (see above)\n", out);
    if (!run->folder) return;
    fprintf(out, "\n  %s/   %sstart.vtp  result.json  %slog.txt\n", run->folder,
            run->any ? "best.vtp  best.png  " : "", run->searched ? "trace.jsonl  " : "");
    if (run->any)
        fprintf(out, "  next: vesica export %s --to stl,obj    vesica show %s\n", run->folder, run->folder);
}

void app_screen_run(const ves_run *run, FILE *out)
{
    const ves_problem *p = run->problem;
    const ves_design *start = run->searched ? &run->start : NULL;
    goal(p, &run->best, start, out);
    constraints(p, &run->best, out);
    variables(run, out);
    measures(p, &run->best, start, out);
    remarks(run, out);
    conclusion(run, out);
}

void app_screen_design(const ves_problem *problem, const ves_design *design, FILE *out)
{
    goal(problem, design, NULL, out);
    constraints(problem, design, out);
    measures(problem, design, NULL, out);
}
