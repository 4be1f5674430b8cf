/* vesica check: is the file in order, and what would a run do? */
#include <math.h>
#include <string.h>

#include "app/app.h"
#include "app/table.h"
#include "study/propose.h"
#include "study/result.h"

/* What check finds out besides the start design. */
typedef struct checked {
    const ves_run *run;
    ves_patch_facts *facts;
    bool gradients;                   /* every measure that is judged has one */
    double value_time, gradient_time; /* s; NAN: not measured */
    ves_shell_facts shell[2];
    ves_elimination elimination[2];
    int eliminations;
} checked;

static const double PATIENCE = 0.05; /* s for each timing */
static const double PROPOSING = 0.2; /* s for an evaluation times the variables */

/* Seconds of one evaluation at the start; NAN: it cannot be measured. */
static double time_one(ves_plan *plan, const ves_ask *ask, ves_verdict *verdict)
{
    double begin = ves_study_clock(), now = begin;
    long count = 0;
    for (; now - begin < PATIENCE; now = ves_study_clock(), count++)
        if (ves_plan_evaluate(plan, ask, verdict) != VES_OK || verdict->status != VES_OK) return NAN;
    return (now - begin) / (double)count;
}

static ves_status timings(app *a, checked *c, ves_plan *plan)
{
    const ves_problem *p = c->run->problem;
    size_t n = (size_t)p->variables, m = (size_t)p->constraints;
    ves_verdict verdict = {0};
    verdict.constraint = ves_arena_take(&a->arena, m, sizeof(double));
    verdict.gradient = ves_arena_take(&a->arena, n, sizeof(double));
    verdict.jacobian = ves_arena_take(&a->arena, n * m, sizeof(double));
    if (!verdict.constraint || !verdict.gradient || !verdict.jacobian) return VES_MEMORY;
    ves_ask ask = {.x = c->run->start.x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    c->value_time = time_one(plan, &ask, &verdict);
    c->gradient_time = NAN;
    ask.want = VES_WANT_GRADIENT;
    c->gradients = ves_plan_search(&plan, 1).gradients;
    if (n && (p->objective || m) && c->gradients) c->gradient_time = time_one(plan, &ask, &verdict);
    return VES_OK;
}

/* Equations that need not be searched for. Not where looking would take long. */
static ves_status propose(app *a, checked *c, ves_plan *plan)
{
    const ves_problem *p = c->run->problem;
    if (!(c->value_time * p->variables < PROPOSING)) return VES_OK;
    return ves_study_propose(plan, p, &a->arena, c->elimination, &c->eliminations);
}

static ves_status look(app *a, checked *c)
{
    const ves_problem *p = c->run->problem;
    ves_plan *plan;
    c->facts = ves_arena_take(&a->arena, (size_t)p->patches, sizeof *c->facts);
    if (!c->facts) return VES_MEMORY;
    const ves_plan_options grid = {{c->run->quadrature[0], c->run->quadrature[1]}};
    VES_TRY(ves_plan_create(p, &grid, &plan, NULL));
    for (int k = 0; k < p->patches; k++) c->facts[k] = ves_plan_patch(plan, k);
    for (int k = 0; k < 2; k++) c->shell[k] = ves_plan_shell(plan, k);
    ves_status status = timings(a, c, plan);
    if (status == VES_OK) status = propose(a, c, plan);
    ves_plan_destroy(plan);
    return status;
}

/* "PDE, order 4 raised to 6" */
static void kind_cell(app_table *t, const ves_patch_def *p)
{
    if (p->kind != VES_PATCH_PDE) {
        app_table_cell(t, "%s", p->kind == VES_PATCH_FORMULA ? "formula" : "points");
        return;
    }
    char raised[32] = "";
    if (p->lower) snprintf(raised, sizeof raised, " raised to %d", 2 * p->power);
    app_table_cell(t, "PDE, order %d%s%s%s%s", 2 * (p->lower ? p->lower : p->power), raised,
                   p->general ? ", coefficients" : "", p->operators > 1 ? " for each of x, y, z" : "",
                   p->spine ? ", spine given" : "");
}

static void modes_cell(app_table *t, const ves_patch_facts *f)
{
    char at[40] = "";
    if (!isnan(f->omega))
        snprintf(at, sizeof at, ", at omega = %.4g,", f->omega);
    else if (!isnan(f->rest))
        snprintf(at, sizeof at, ", solved as mode %.4g,", f->rest);
    if (f->modes == f->band)
        app_table_cell(t, "%d Fourier %s, all solved", f->band, f->band == 1 ? "mode" : "modes");
    else
        app_table_cell(t, "%d of %d Fourier modes solved; the remainder%s carries %.1e of the data", f->modes,
                       f->band, at, f->tail);
}

static void patches(const checked *c)
{
    const ves_problem *p = c->run->problem;
    app_table t = {.align = "lll"};
    app_table_cell(&t, "patch");
    app_table_cell(&t, "made by");
    app_table_end(&t);
    for (int k = 0; k < p->patches; k++) {
        app_table_cell(&t, "%s", p->patch[k].name);
        kind_cell(&t, &p->patch[k]);
        if (p->patch[k].kind == VES_PATCH_PDE)
            modes_cell(&t, &c->facts[k]);
        else
            app_table_end(&t);
    }
    app_table_print(&t, stdout);
    fputc('\n', stdout);
}

/* Of patches with conditions inside: what these make of their data. */
static void amplifications(const checked *c)
{
    const ves_problem *p = c->run->problem;
    app_table t = {.align = "lrrr"};
    bool any = false;
    for (int k = 0; k < p->patches; k++) {
        const ves_patch_facts *f = &c->facts[k];
        const int mode[3] = {0, f->modes, f->worst};
        for (int i = 0; i < 3 && f->inside; i++) {
            if (i && (mode[i] == mode[0] || (i == 2 && mode[2] == mode[1]))) continue;
            if (!any) {
                app_table_cell(&t, "conditions inside");
                app_table_cell(&t, "mode");
                app_table_cell(&t, "amplified");
                app_table_cell(&t, "condition number");
            }
            any = true;
            app_table_cell(&t, "%s", i ? "" : p->patch[k].name);
            app_table_cell(&t, "%d", mode[i]);
            app_table_cell(&t, "%.3g", f->amplification[i]);
            app_table_cell(&t, "%.1e", f->condition[i]);
        }
    }
    if (!any) return;
    app_table_print(&t, stdout);
    fputc('\n', stdout);
}

static void heading(const checked *c)
{
    const ves_problem *p = c->run->problem;
    int equal = 0;
    char v[64], e[64], i[64];
    for (int k = 0; k < p->constraints; k++) equal += p->constraint[k].relation == VES_EQUAL;
    ves_status wrong = c->run->any ? c->run->proof : c->run->best.status;
    printf("%s: ", p->path);
    if (wrong == VES_OK)
        fputs("ok", stdout);
    else
        printf("the file can be read, but its start design %s: %s",
               c->run->any ? "does not pass the checks" : "cannot be measured", ves_status_text(wrong));
    printf("\n  %s\n  %s, %s, %s\n\n", p->title, app_screen_plural(p->variables, "variable", "variables", v),
           app_screen_plural(equal, "equality", "equalities", e),
           app_screen_plural(p->constraints - equal, "inequality", "inequalities", i));
}

static void costs(const checked *c)
{
    const ves_run *run = c->run;
    char value[32], gradient[32];
    printf("  quadrature   %d x %d nodes a patch", run->quadrature[0], run->quadrature[1]);
    const int *said = run->problem->quadrature;
    if (said[0] > 0 && said[1] > 0)
        printf(", as the file says");
    else if (isnan(run->change))
        printf(run->any ? ", not chosen: a finer grid could not be measured"
                        : ", not chosen: nothing could be measured");
    else
        printf(", chosen: half as many again change a measure by %.1e at most", run->change);
    if (!isnan(run->finer_change)) printf("; twice as many by %.1e", run->finer_change);
    if (!isnan(c->value_time))
        printf("\n  time         %s an evaluation", app_screen_time(c->value_time, value));
    if (!isnan(c->gradient_time))
        printf(", %s with gradients", app_screen_time(c->gradient_time, gradient));
    else if (run->problem->variables && !c->gradients)
        printf("; %s", run->problem->shell && run->problem->shell->mesh.order == 1
                           ? "shells of order 1 have no gradient"
                           : "a measure has no gradient");
    fputc('\n', stdout);
}

/* As the file would have it: "h: {in: [20 mm, 80 mm]}". */
static void proposals(const checked *c)
{
    const ves_problem *p = c->run->problem;
    char low[32], high[32];
    for (int k = 0; k < c->eliminations; k++) {
        const ves_elimination *e = &c->elimination[k];
        const char *text = p->constraint[e->constraint].text;
        printf("  %-13s", k ? "or" : "exact");
        if (e->variable < 0) {
            printf("%s could be met by similarity, if the size of the shape is free:\n"
                   "               scale: {equation: %s}\n",
                   text, text);
            continue;
        }
        const ves_variable *v = &p->variable[e->variable];
        const char *unit = v->shown.unit, *space = *unit ? " " : "";
        app_screen_number(v->min / v->shown.factor, low);
        app_screen_number(v->max / v->shown.factor, high);
        printf("%s could be met by %s, then no variable any more:\n"
               "               solve: {unknown: %s, in: [%s%s%s, %s%s%s], equation: %s}\n",
               text, v->name, v->name, low, space, unit, high, space, unit, text);
    }
}

/* What vesica sweep would do. */
static void sweeps(const ves_problem *p)
{
    const ves_sweep_def *s = p->sweep;
    char points[64], walks[64];
    if (!s) return;
    const int seconds = s->axes > 1 ? s->axis[1].count : 1;
    long walked = 0, all = s->axis[0].count;
    for (int b = 0; b < (s->branches ? s->branches : 1); b++)
        for (int j = 0; j < seconds; j++)
            if (ves_sweep_walked(s, b, j)) walked += s->forth + s->back;
    printf("  sweep        over %s, %d values", s->axis[0].name, s->axis[0].count);
    if (s->axes > 1) printf(", for %d of %s", s->axis[1].count, s->axis[1].name);
    printf(": %s in %s (vesica sweep)\n", app_screen_plural(all * walked, "point", "points", points),
           app_screen_plural(walked, "walk", "walks", walks));
}

static void json_three(ves_json *json, const char *name, const double value[3])
{
    ves_json_array(json, name);
    for (int k = 0; k < 3; k++) ves_json_number(json, NULL, value[k]);
    ves_json_end(json, ']');
}

static void json_patch(ves_json *json, const ves_patch_facts *f)
{
    if (!f->order) return;
    ves_json_integer(json, "order", f->order);
    ves_json_number(json, "omega", f->omega);
    ves_json_number(json, "rest", f->rest);
    if (!f->inside) return;
    ves_json_integer(json, "worst", f->worst);
    json_three(json, "amplification",
               f->amplification); /* of mode 0, of the highest that is solved, of the worst */
    json_three(json, "condition", f->condition);
}

static void json_print(const checked *c)
{
    ves_json json = {.out = stdout};
    const ves_problem *p = c->run->problem;
    ves_json_object(&json, NULL);
    ves_json_text(&json, "title", p->title);
    ves_result_design(p, &c->run->best, &json);
    ves_result_joints(c->run, &json);
    ves_json_object(&json, "quadrature");
    ves_json_integer(&json, "u", c->run->quadrature[0]);
    ves_json_integer(&json, "v", c->run->quadrature[1]);
    ves_json_number(&json, "change", c->run->change);
    ves_json_end(&json, '}');
    ves_json_object(&json, "patches");
    for (int k = 0; k < p->patches; k++) {
        ves_json_object(&json, p->patch[k].name);
        ves_json_integer(&json, "band", c->facts[k].band);
        ves_json_integer(&json, "modes", c->facts[k].modes);
        ves_json_number(&json, "tail", c->facts[k].tail);
        json_patch(&json, &c->facts[k]);
        ves_json_end(&json, '}');
    }
    ves_json_end(&json, '}');
    app_screen_shell_json(p, c->shell, &json);
    ves_json_array(&json, "notes"); /* what is wrong with the start */
    for (int k = 0; k < c->run->notes; k++) ves_json_text(&json, NULL, c->run->note[k]);
    ves_json_end(&json, ']');
    ves_json_array(&json, "eliminations");
    for (int k = 0; k < c->eliminations; k++) {
        const ves_elimination *e = &c->elimination[k];
        ves_json_object(&json, NULL);
        ves_json_text(&json, "constraint", p->constraint[e->constraint].text);
        ves_json_text(&json, "by", e->variable < 0 ? "scale" : "solve");
        if (e->variable >= 0) ves_json_text(&json, "unknown", p->variable[e->variable].name);
        ves_json_end(&json, '}');
    }
    ves_json_end(&json, ']');
    ves_json_number(&json, "evaluation_s", c->value_time);
    ves_json_number(&json, "gradient_s", c->gradient_time);
    ves_json_end(&json, '}');
}

static int report(app *a, checked *c)
{
    if (a->options.json) {
        json_print(c);
    } else {
        heading(c);
        app_screen_variables(c->run, stdout);
        patches(c);
        amplifications(c);
        app_screen_shell(c->run->problem, c->shell, stdout);
        printf("  start design\n\n");
        app_screen_design(c->run->problem, &c->run->best, &c->run->finer, stdout);
        app_screen_joints(c->run, stdout);
        costs(c);
        proposals(c);
        sweeps(c->run->problem);
    }
    return c->run->any && c->run->proof == VES_OK ? APP_DONE : APP_UNMET;
}

int app_check(app *a)
{
    ves_opened opened;
    checked c = {0};
    ves_status looked = VES_OK;
    ves_run *run;
    int code;
    if (!app_open(a, &opened, &code)) return code;
    const ves_run_options options = {.once = true, .prove = true};
    app_patience_begin();
    ves_status status = ves_run_create(opened.problem, &options, NULL, &run, a->diag);
    c.run = run;
    if (run) looked = look(a, &c);
    app_patience_end();
    app_say(a);
    code = app_code(status);
    if (run) {
        code = looked == VES_OK ? report(a, &c) : app_fail(a, looked, "%s", ves_status_text(looked));
        ves_run_destroy(run);
    }
    ves_study_close(&opened);
    return code;
}
