/* What people read when a run is done. */
#include <math.h>
#include <string.h>

#include "app/app.h"
#include "app/table.h"
#include "base/vector.h"
#include "study/annealing.h"
#include "study/apart.h"
#include "study/design.h"

/* A variable this near to its limit, relative to its range, lies on it. */
static const double AT_LIMIT = 1e-6;

enum { OPTIMA = 8, JOINTS = 24, LIMITS = 8 };

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

/* A number in the units of the file; empty when it is none. */
static void shown_cell(app_table *t, double value, const ves_shown *shown)
{
    app_table_number(t, value / shown->factor);
}

/* Decimals that show a millionth of the range: numbers of a column stand point under point, and what is
 * rounding beside the range is shown as 0. */
static const char *in_range(double value, const ves_variable *v, char buffer[32])
{
    double scale = v->shown.factor, decimals = 6 - floor(log10((v->max - v->min) / scale));
    if (!(decimals >= 0 && decimals <= 12)) return app_screen_number(value / scale, buffer);
    snprintf(buffer, 32, "%.*f", (int)decimals, value / scale);
    bool zero = !strpbrk(buffer, "123456789");
    if (zero && *buffer == '-') memmove(buffer, buffer + 1, strlen(buffer));
    return buffer;
}

static void goal(const ves_problem *problem, const ves_design *best, const ves_design *start, FILE *out)
{
    char a[32], b[32];
    const ves_shown *shown = &problem->objective_shown;
    if (!problem->objective) return;
    fprintf(out, "  %s %s   ", problem->maximize ? "maximize" : "minimize", problem->objective_text);
    if (isnan(best->objective))
        fputs("not measured", out);
    else
        fprintf(out, "%s%s%s", app_screen_number(best->objective / shown->factor, a), *shown->unit ? " " : "",
                shown->unit);
    if (start && !isnan(start->objective)) {
        fprintf(out, "   start %s", app_screen_number(start->objective / shown->factor, b));
        double change = 100 * (best->objective / start->objective - 1);
        if (!start->feasible)
            fputs(", which violates a constraint", out); /* then the change says nothing */
        else if (isfinite(change))
            fprintf(out, "   %+.1f %%", change);
    }
    fputs("\n\n", out);
}

static const char *kind_of(const ves_problem *problem, const ves_design *design)
{
    return design->status != VES_OK ? "not measured" : ves_design_kind(problem, design->kind);
}

static void kinds(const ves_problem *problem, const ves_design *best, const ves_design *start, FILE *out)
{
    if (!problem->kinds) return;
    fprintf(out, "  kind   %s", kind_of(problem, best));
    if (start) fprintf(out, "   start %s", kind_of(problem, start));
    fputs("\n\n", out);
}

static void constraints(const ves_problem *problem, const ves_design *design, FILE *out)
{
    app_table t = {.align = "lrrll"};
    if (!problem->constraints) return;
    app_table_cell(&t, "constraint");
    app_table_cell(&t, "value");
    app_table_cell(&t, "limit");
    app_table_end(&t);
    for (int k = 0; k < problem->constraints; k++) {
        const ves_sides *s = &design->side[k];
        const ves_constraint_def *c = &problem->constraint[k];
        app_table_cell(&t, "%s", c->text);
        shown_cell(&t, s->value, &c->shown);
        shown_cell(&t, s->limit, &c->shown);
        app_table_cell(&t, "%s", c->shown.unit);
        if (isnan(s->violation))
            app_table_cell(&t, "not measured");
        else if (s->holds)
            app_table_cell(&t, "ok");
        else
            app_table_cell(&t, "VIOLATED by %.2g of its size", s->violation);
    }
    app_table_print(&t, out);
    fputc('\n', out);
}

/* Of validity: {holds: ...}. finer: the same design on a finer grid. */
static void checks(const ves_problem *problem, const ves_design *design, const ves_design *finer, FILE *out)
{
    const ves_validity_def *v = &problem->validity;
    app_table t = {.align = "ll"};
    if (!v->checks) return;
    app_table_cell(&t, "check");
    app_table_end(&t);
    for (int k = 0; k < v->checks; k++) {
        app_table_cell(&t, "%s", v->check[k].text);
        app_table_cell(&t, "%s",
                       design->status != VES_OK ? "not measured"
                       : !design->check[k]      ? "DOES NOT HOLD"
                       : finer->check[k]        ? "holds"
                                                : "DOES NOT HOLD on the finer grid");
    }
    app_table_print(&t, out);
    fputc('\n', out);
}

/* What is to be said of a variable at x. Under `scale:` a limit need not shut a shape out: it is there in
 * other sizes. */
static const char *remark(const ves_variable *v, double x, bool idle, bool scaled)
{
    if (idle) return "had no effect on what is judged, in the designs looked at";
    double near = AT_LIMIT * (v->max - v->min);
    if (x <= v->min + near)
        return scaled ? "at its lower limit" : "at its lower limit: the optimum may lie outside";
    if (x >= v->max - near)
        return scaled ? "at its upper limit" : "at its upper limit: the optimum may lie outside";
    return "";
}

void app_screen_variables(const ves_run *run, FILE *out)
{
    const ves_problem *p = run->problem;
    bool best = run->searched && run->any;
    app_table t = {.align = best ? "lrrll" : "lrll"};
    char low[32], high[32];
    if (!p->variables) return;
    app_table_cell(&t, "variable");
    app_table_cell(&t, "start");
    if (best) app_table_cell(&t, "best");
    app_table_cell(&t, "range");
    app_table_end(&t);
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        double scale = v->shown.factor;
        app_table_cell(&t, "%s", v->name);
        shown_cell(&t, run->start.x[k], &v->shown);
        if (best) app_table_cell(&t, "%s", in_range(run->best.x[k], v, low));
        app_table_cell(&t, "[%s, %s]%s%s", app_screen_number(v->min / scale, low),
                       app_screen_number(v->max / scale, high), *v->shown.unit ? " " : "", v->shown.unit);
        bool idle = run->idle && run->idle[k];
        app_table_cell(&t, "%s",
                       best   ? remark(v, run->best.x[k], idle, p->scale)
                       : idle ? remark(v, 0, true, false)
                              : "");
    }
    app_table_print(&t, out);
    fputc('\n', out);
}

static void measure_row(app_table *t, const double start[], double best, const ves_shown *shown)
{
    if (start) shown_cell(t, *start, shown);
    shown_cell(t, best, shown);
    app_table_cell(t, "%s", shown->unit);
}

/* Measures, and what the equations of solve: and scale: found. */
/* " (along y)": a height need not be where the reader thinks that up is. */
static const char *axis_of(const ves_measure_def *m)
{
    static const char *const fixed[][2] = {
        {"height", " (along y)"}, {"width", " (along x)"}, {"depth", " (along z)"}};
    for (int k = 0; k < 3; k++)
        if (!strcmp(m->measure->name, fixed[k][0])) return fixed[k][1];
    bool of_all = false; /* the largest displacement is a length */
    for (int k = 0; k < m->args.count; k++)
        of_all = of_all || (m->args.key[k].kind == VES_SHELL_AT && !m->args.arg[k].given);
    for (int k = 0; k < m->args.count && !of_all; k++)
        if (!strcmp(m->args.key[k].name, "along") && !m->args.arg[k].given) return " (along y)";
    return "";
}

static void measures(const ves_problem *p, const ves_design *best, const ves_design *start, FILE *out)
{
    static const ves_shown plain = {.factor = 1};
    app_table t = {.align = start ? "lrrl" : "lrl"};
    if (!p->measures && !p->solve && !p->scale) return;
    app_table_cell(&t, "measure");
    if (start) app_table_cell(&t, "start");
    app_table_cell(&t, start ? "best" : "value");
    app_table_end(&t);
    for (int k = 0; k < p->measures; k++) {
        app_table_cell(&t, "%s%s", p->measure[k].name, axis_of(&p->measure[k]));
        measure_row(&t, start ? &start->measure[k] : NULL, best->measure[k], &p->measure[k].shown);
    }
    if (p->solve) {
        double from = start && start->status == VES_OK ? start->slot[p->variables] : NAN;
        app_table_cell(&t, "%s (solved)", p->solve->name);
        measure_row(&t, start ? &from : NULL, best->status == VES_OK ? best->slot[p->variables] : NAN,
                    &p->solve->shown);
    }
    if (p->scale) {
        app_table_cell(&t, "scale");
        measure_row(&t, start ? &start->similarity : NULL, best->similarity, &plain);
    }
    app_table_print(&t, out);
    fputc('\n', out);
}

/* A crease by its angle; a smooth joint in a word; where only the curvature jumps, by how much. */
static void joint_row(app_table *t, const ves_problem *p, const ves_joint *j)
{
    const char *class = ves_joint_text(j->continuity), *metre = p->units ? " m" : "",
               *per_metre = p->units ? " 1/m" : "";
    app_table_cell(t, "%s.u%d, %s.u%d", p->patch[j->patch[0]].name, j->end[0], p->patch[j->patch[1]].name,
                   j->end[1]);
    app_table_cell(t, "%s", j->curve ? j->curve : "itself");
    app_table_cell(t, "%s", class);
    if (j->continuity == VES_JOINT_OPEN)
        app_table_cell(t, "a gap of %.2g%s", j->gap, metre);
    else if (j->continuity == VES_JOINT_C0 && isnan(j->angle))
        app_table_cell(t, "no tangent plane somewhere");
    else if (j->continuity == VES_JOINT_C0)
        app_table_cell(t, "crease of %.4g deg", j->angle * 180 / VES_PI);
    else if (j->continuity == VES_JOINT_G1 || j->continuity == VES_JOINT_C1)
        app_table_cell(t, "smooth; curvature jumps by %.3g%s (%.2g %%)", j->curvature_jump, per_metre,
                       100 * j->curvature_relative);
    else
        app_table_cell(t, "smooth");
}

void app_screen_joints(const ves_run *run, FILE *out)
{
    app_table t = {.align = "llll"};
    if (!run->joints) return;
    app_table_cell(&t, "joint");
    app_table_cell(&t, "on");
    app_table_end(&t);
    for (int k = 0; k < run->joints && k < JOINTS; k++) joint_row(&t, run->problem, &run->joint[k]);
    app_table_print(&t, out);
    if (run->joints > JOINTS) fprintf(out, "  and %d more with --json\n", run->joints - JOINTS);
    fputc('\n', out);
}

/* What sets another optimum apart from the best. */
static void differences(const ves_run *run, int index, char text[VES_APART * VES_APART_TEXT])
{
    char apart[VES_APART][VES_APART_TEXT];
    int count = ves_apart_tell(run, index, 0, apart);
    size_t length = 0;
    *text = 0;
    for (int k = 0; k < count; k++)
        length += (size_t)snprintf(text + length, VES_APART * VES_APART_TEXT - length, "%s%s",
                                   k ? ", " : "   at ", apart[k]);
}

static void optima(const ves_run *run, app_table *t)
{
    const ves_shown *shown = &run->problem->objective_shown;
    if (run->optima < 2 && !(run->optima == 1 && run->optimum[0].saddle)) return;
    for (int k = 0; k < run->optima && k < OPTIMA; k++) {
        const ves_optimum *o = &run->optimum[k];
        char number[32], hits[64] = "once"; /* more digits than elsewhere: they may differ late */
        char apart[VES_APART * VES_APART_TEXT] = "";
        snprintf(number, sizeof number, "%#.9g", o->value / shown->factor);
        if (o->hits != 1) app_screen_plural(o->hits, "time", "times", hits);
        if (k) differences(run, k, apart);
        app_table_cell(t, k ? "" : run->optima == 1 ? "optimum" : "optima");
        app_table_cell(t, "%s%s%s   found %s%s%s%s%s", number, *shown->unit ? " " : "", shown->unit, hits,
                       run->problem->kinds ? "   " : "",
                       run->problem->kinds ? ves_design_kind(run->problem, run->optimum_kind[k]) : "",
                       o->saddle ? "   a saddle" : "", apart);
    }
    if (run->optima > OPTIMA) {
        app_table_cell(t, "%s", "");
        app_table_cell(t, "and %d more in result.json", run->optima - OPTIMA);
    }
}

/* What of the objective is to be had, or paid, for one unit: in the units of the file. */
static void price_write(const ves_run *run, double rate, const ves_shown *of, const char *way, char text[120])
{
    const ves_problem *p = run->problem;
    const ves_shown *shown = &p->objective_shown;
    snprintf(text, 120, "1%s%s %s %s %.4g%s%s", *of->unit ? " " : "", of->unit, way,
             (rate > 0) == p->maximize ? "gains" : "costs", fabs(rate) * of->factor / shown->factor,
             *shown->unit ? " " : "", shown->unit);
}

/* What holds the best; at first order, as are all these prices. */
static void limits(const ves_run *run, app_table *t)
{
    const ves_problem *p = run->problem;
    const ves_kkt *kkt = &run->kkt;
    char text[120], number[32];
    int rows = 0;
    if (!kkt->known || !p->objective) return;
    for (int k = 0; k < p->constraints; k++) {
        if (kkt->multiplier[k] == 0 || rows++ >= LIMITS) continue;
        price_write(run, kkt->multiplier[k], &p->constraint[k].shown, "more", text);
        app_table_cell(t, rows == 1 ? "limits" : "");
        app_table_cell(t, "%s: %s", p->constraint[k].text, text);
    }
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        double rate = kkt->bound[k];
        if (rate == 0 || rows++ >= LIMITS) continue;
        bool lower = run->best.x[k] - v->min < v->max - run->best.x[k];
        bool idle = fabs(rate) * (v->max - v->min) < AT_LIMIT * fabs(run->best.objective);
        price_write(run, lower ? -rate : rate, &v->shown, lower ? "lower" : "higher", text);
        app_table_cell(t, rows == 1 ? "limits" : "");
        app_table_cell(t, "%s stands at its %s bound %s%s%s: %s", v->name, lower ? "lower" : "upper",
                       app_screen_number((lower ? v->min : v->max) / v->shown.factor, number),
                       *v->shown.unit ? " " : "", v->shown.unit, idle ? "which costs next to nothing" : text);
    }
    if (rows > LIMITS) {
        app_table_cell(t, "%s", "");
        app_table_cell(t, "and %d more in result.json", rows - LIMITS);
    }
    if (rows && !kkt->unique) {
        app_table_cell(t, "%s", "");
        app_table_cell(t, "%s", "these prices are not unique: the limits that hold depend on each other");
    }
    app_table_cell(t, rows ? "" : "slope");
    app_table_cell(t, "%s%.1e of the objective's is left", rows ? "slope: " : "", kkt->residual);
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

/* A line for each portfolio. */
static void strategies(const ves_run *run, app_table *t)
{
    for (int first = 0, next; first < run->strategies; first = next) {
        const ves_strategy_report *r = run->strategy;
        char text[300] = "", number[64];
        const char *best = NULL;
        size_t at = 0;
        long all = 0;
        for (next = first; next < run->strategies && r[next].stage == r[first].stage; next++)
            all += r[next].evaluations;
        for (int k = first; k < next; k++) {
            if (r[k].best) best = r[k].name;
            if (!r[k].evaluations || at >= sizeof text) continue;
            int length = snprintf(text + at, sizeof text - at, "%s%s %.0f %%", at ? ", " : "", r[k].name,
                                  100 * (double)r[k].evaluations / (double)all);
            at += length > 0 ? (size_t)length : 0;
        }
        if (!all) continue;
        app_table_cell(t, "%s", "");
        app_table_cell(t, "%s of %s; %s%s", text, app_screen_plural(all, "evaluation", "evaluations", number),
                       best ? "the best by " : "none found better than the start", best ? best : "");
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
    strategies(run, t);
    app_table_cell(t, "stopped");
    app_table_cell(t, "%s", run->stop);
    if (!run->evidence.sentence) return;
    app_table_cell(t, "verdict");
    app_table_cell(t, "%s", run->evidence.sentence);
}

/* One line each: how it was, and what it says of itself. */
static void annealings(const ves_run *run, app_table *t)
{
    const ves_shown *shown = &run->problem->objective_shown;
    for (int k = 0; k < run->annealings; k++) {
        const ves_annealing_report *r = &run->annealing[k];
        char text[300], legs[64];
        size_t at = 0;
        for (int j = 0; j < r->moves && at < sizeof text; j++) {
            const ves_move_count *m = &r->count[j];
            int length = snprintf(text + at, sizeof text - at, "%s%s %.0f %%", j ? ", " : "", r->move[j],
                                  m->trials ? 100 * (double)m->accepted / (double)m->trials : 0);
            at += length > 0 ? (size_t)length : 0;
        }
        app_table_cell(t, k ? "" : "annealed");
        app_table_cell(t, "T %.2g to %.2g%s%s in %s; accepted: %s", r->c0 / shown->factor,
                       r->c / shown->factor, *shown->unit ? " " : "", shown->unit,
                       app_screen_plural(r->legs, "leg", "legs", legs), text);
        if (r->swaps) {
            app_table_cell(t, "%s", "");
            app_table_cell(t, "exchanges of replicas: %.0f %%, the least of a pair %.0f %%",
                           100 * (double)r->swapped / (double)r->swaps, 100 * r->least_swap);
        }
        app_table_cell(t, "%s", "");
        app_table_cell(t, "%s", r->sentence);
    }
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
    limits(run, &t);
    expectations(run, &t);
    effort(run, &t);
    annealings(run, &t);
    for (int k = 0; k < run->notes; k++) {
        app_table_cell(&t, k ? "" : "notes");
        app_table_cell(&t, "%s", run->note[k]);
    }
    app_table_print(&t, out);
}

/* " --plugin FILE" for each: without them the folder cannot be read again. */
static void plugins(const ves_problem *p, FILE *out)
{
    for (int k = 0; p->plugin_file && p->plugin_file[k]; k++) fprintf(out, " --plugin %s", p->plugin_file[k]);
}

static void conclusion(const ves_run *run, FILE *out)
{
    bool stopped = run->ending == VES_ENDED_STOPPED;
    if (stopped) fputs("\n  interrupted: this is the best so far\n", out);
    if (!run->any)
        fputs("\n  no design could be measured\n", out);
    else if (!run->feasible && !run->best.feasible)
        fprintf(out, "\n  no design met all constraints: the least violation is %.2g\n", run->best.violation);
    else if (!run->feasible)
        fprintf(out, "\n  the result %s\n",
                stopped ? "has not passed its checks" : "did not pass its checks (see above)");
    if (!run->folder) return;
    fprintf(out, "\n  %s/   %s%s%sstart.vtp  result.json  %s%slog.txt\n", run->folder,
            run->any ? "best.vtp  best.png  " : "", run->optima > 1 ? "optima.png  " : "",
            ves_annealing_seen(run) ? "annealing.png  " : "", run->searched ? "trace.jsonl  " : "",
            run->journaled ? "journal  " : "");
    if (!run->any) return;
    fprintf(out, "  next: %s export %s --to stl,obj", app_called(), run->folder);
    plugins(run->problem, out);
    fprintf(out, "    %s show %s", app_called(), run->folder);
    plugins(run->problem, out);
    fputc('\n', out);
}

void app_screen_run(const ves_run *run, FILE *out)
{
    const ves_problem *p = run->problem;
    const ves_design *start = run->searched && run->any ? &run->start : NULL;
    goal(p, &run->best, start, out);
    kinds(p, &run->best, start, out);
    constraints(p, &run->best, out);
    checks(p, &run->best, &run->finer, out);
    app_screen_variables(run, out);
    measures(p, &run->best, start, out);
    app_screen_joints(run, out);
    remarks(run, out);
    conclusion(run, out);
}

void app_screen_design(const ves_problem *problem, const ves_design *design, const ves_design *finer,
                       FILE *out)
{
    goal(problem, design, NULL, out);
    kinds(problem, design, NULL, out);
    constraints(problem, design, out);
    checks(problem, design, finer, out);
    measures(problem, design, NULL, out);
}
