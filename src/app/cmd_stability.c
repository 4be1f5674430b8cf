/* vesica stability */
#include <math.h>

#include "app/app.h"
#include "app/follow.h"
#include "app/table.h"
#include "output/modes.h"
#include "vesica/stability.h"

/* --- JSON --- */

static void mode_json(const ves_firmness_mode *m, ves_json *json)
{
    ves_json_object(json, NULL);
    ves_json_integer(json, "n", m->n);
    ves_json_array(json, "values");
    for (int k = 0; k < m->values; k++) ves_json_number(json, NULL, m->value[k]);
    ves_json_end(json, ']');
    ves_json_array(json, "errors");
    for (int k = 0; k < m->values; k++) ves_json_number(json, NULL, m->error[k]);
    ves_json_end(json, ']');
    ves_json_array(json, "parity");
    for (int k = 0; k < m->values; k++) ves_json_number(json, NULL, m->parity[k]);
    ves_json_end(json, ']');
    ves_json_text(json, "verdict", ves_firmness_text(m->firmness));
    ves_json_end(json, '}');
}

static void own_json(const ves_problem *p, const ves_stability *s, ves_json *json)
{
    ves_json_object(json, "variables");
    ves_json_array(json, "values");
    for (int k = 0; k < s->values; k++) ves_json_number(json, NULL, s->own[k]);
    ves_json_end(json, ']');
    ves_json_array(json, "errors");
    for (int k = 0; k < s->values; k++) ves_json_number(json, NULL, s->own_error[k]);
    ves_json_end(json, ']');
    ves_json_array(json, "along");
    for (int k = 0; k < s->values; k++) ves_json_text(json, NULL, p->variable[s->own_along[k]].name);
    ves_json_end(json, ']');
    ves_json_integer(json, "flat", s->flat);
    ves_json_end(json, '}');
}

/* change: NULL: nothing is followed. */
static void along_json(const ves_problem *p, const ves_stability *s, const double *change, ves_json *json)
{
    if (!change) return;
    ves_json_object(json, "along");
    ves_json_integer(json, "n", s->followed);
    ves_json_number(json, "made", s->made);
    ves_json_object(json, "change");
    for (int k = 0; k < p->variables; k++) ves_json_number(json, p->variable[k].name, change[k]);
    ves_json_end(json, '}');
    ves_json_end(json, '}');
}

static void json_print(const ves_problem *p, const ves_stability *s, const double *change)
{
    ves_json json = {.out = stdout};
    ves_json_object(&json, NULL);
    ves_json_text(&json, "verdict", ves_firmness_text(s->firmness));
    ves_json_integer(&json, "softest", s->mode[s->softest].n);
    ves_json_array(&json, "modes");
    for (int k = 0; k < s->modes; k++) mode_json(&s->mode[k], &json);
    ves_json_end(&json, ']');
    ves_json_array(&json, "held");
    for (int k = 0; k < s->held && k < VES_STABILITY_HOLDS; k++) ves_json_text(&json, NULL, s->holds[k]);
    ves_json_end(&json, ']');
    ves_json_number(&json, "objective", s->objective);
    ves_json_number(&json, "slope", s->slope);
    ves_json_number(&json, "stationary", s->stationary);
    ves_json_number(&json, "unsure", s->unsure);
    ves_json_number(&json, "moved", s->moved);
    ves_json_number(&json, "R0", s->radius);
    own_json(p, s, &json);
    along_json(p, s, change, &json);
    ves_json_integer(&json, "functions", s->functions);
    ves_json_array(&json, "quadrature");
    for (int k = 0; k < 2; k++) ves_json_integer(&json, NULL, s->quadrature[k]);
    ves_json_end(&json, ']');
    ves_json_end(&json, '}');
}

/* --- the screen --- */

static const char *parity_text(double parity)
{
    static const double PURE = 0.99;
    return parity > PURE ? "symmetric" : parity < -PURE ? "antisymmetric" : "";
}

/* In the unit of the objective. */
static void table_print(const ves_problem *p, const ves_stability *s, FILE *out)
{
    const ves_shown *shown = &p->objective_shown;
    app_table t = {.align = "rrlrrrl"};
    app_table_cell(&t, "n");
    app_table_cell(&t, *shown->unit ? "lowest [%s]" : "lowest", shown->unit);
    app_table_cell(&t, "%s", "");
    app_table_cell(&t, "+-");
    app_table_cell(&t, "second");
    app_table_cell(&t, "third");
    app_table_end(&t);
    for (int k = 0; k < s->modes; k++) {
        const ves_firmness_mode *m = &s->mode[k];
        app_table_cell(&t, "%d", m->n);
        app_table_cell(&t, "%.5g", m->value[0] / shown->factor);
        app_table_cell(&t, "%s", parity_text(m->parity[0]));
        app_table_cell(&t, "%.1g", m->error[0] / shown->factor);
        for (int j = 1; j < 3; j++)
            if (j < m->values)
                app_table_cell(&t, "%.5g", m->value[j] / shown->factor);
            else
                app_table_cell(&t, " ");
        app_table_cell(&t, "%s", ves_firmness_text(m->firmness));
        app_table_end(&t);
    }
    app_table_print(&t, out);
}

/* What the variables of the file see of it. */
static void own_print(const ves_problem *p, const ves_stability *s, FILE *out)
{
    fprintf(out, "  variables   ");
    for (int k = 0; k < s->values; k++)
        fprintf(out, "%s%.4g (most of it %s)", k ? ", " : "", s->own[k], p->variable[s->own_along[k]].name);
    if (s->flat)
        fprintf(out, "%s%d direction%s that change%s nothing", s->values ? "; " : "", s->flat,
                s->flat > 1 ? "s" : "", s->flat > 1 ? "" : "s");
    fputs("\n", out);
}

static void stationary_print(const ves_problem *p, const ves_stability *s, FILE *out)
{
    const double factor = p->objective_shown.factor;
    if (s->relaxed)
        fprintf(out,
                "  stationary  %.9g +- %.1g; the design lies %.2g above it, a displacement of %.2g R0 away\n",
                s->stationary / factor, s->unsure / factor, (s->objective - s->stationary) / factor,
                s->moved);
    else
        fprintf(out,
                "  stationary  no stationary shape near the design, whose slope is %.2g: eigenvalues at the "
                "design\n",
                s->slope / factor);
}

static void held_print(const ves_stability *s, FILE *out)
{
    const int shown = s->held < VES_STABILITY_HOLDS ? s->held : VES_STABILITY_HOLDS;
    if (!s->held) return;
    fputs("  held        ", out);
    for (int k = 0; k < shown; k++) fprintf(out, "%s%s", k ? ", " : "", s->holds[k]);
    if (s->held > shown) fprintf(out, " and %d more", s->held - shown);
    fputs("\n", out);
}

static void verdict_print(const ves_problem *p, const ves_stability *s, FILE *out)
{
    const ves_firmness_mode *soft = &s->mode[s->softest];
    const double factor = p->objective_shown.factor;
    fprintf(out, "  verdict     %s: ", ves_firmness_text(s->firmness));
    if (s->firmness == VES_UNKNOWN)
        fputs("only at a stationary shape do eigenvalues tell; has the run converged, and does its branch "
              "still "
              "exist?\n",
              out);
    else
        fprintf(out, "the softest mode is n = %d, with %.4g +- %.1g\n", soft->n, soft->value[0] / factor,
                soft->error[0] / factor);
}

/* Of a design that is not feasible: the constraint that is missed most. */
static void missed_print(const ves_problem *p, FILE *out)
{
    const ves_plan_options grid = {{p->quadrature[0], p->quadrature[1]}};
    ves_arena arena = {0};
    ves_plan *plan = NULL;
    ves_design d = {.feasible = true};
    double *x = ves_arena_take(&arena, (size_t)p->variables + 1, sizeof *x);
    for (int k = 0; x && k < p->variables; k++) x[k] = p->variable[k].start;
    ves_status status = x ? ves_plan_create(p, &grid, &plan, NULL) : VES_MEMORY;
    if (status == VES_OK) status = ves_plan_measure(plan, x, 0, &d);
    int worst = 0;
    for (int k = 1; status == VES_OK && k < p->constraints; k++)
        if (d.side[k].violation > d.side[worst].violation) worst = k;
    if (status == VES_OK && !d.feasible)
        fprintf(out, "  design      not feasible: %s is missed by %.2g of its size\n",
                p->constraint[worst].text, d.side[worst].violation);
    ves_plan_destroy(plan);
    ves_arena_destroy(&arena);
}

static void screen(const ves_problem *p, const ves_stability *s, FILE *out)
{
    fprintf(out, "%s\n\n", *p->title ? p->title : p->name);
    table_print(p, s, out);
    fputs("\n", out);
    stationary_print(p, s, out);
    held_print(s, out);
    fprintf(out, "  functions   %d of the meridian, %d x %d nodes a patch\n", s->functions, s->quadrature[0],
            s->quadrature[1]);
    if (s->values || s->flat) own_print(p, s, out);
    missed_print(p, out);
    verdict_print(p, s, out);
}

/* --- the picture --- */

static ves_status picture(app *a, const ves_problem *p, const ves_stability *s,
                          const ves_stability_profile *at)
{
    const ves_shown *shown = &p->objective_shown;
    ves_modes_panel panel[VES_STABILITY_MODES + 1];
    for (int k = 0; k < s->modes; k++) {
        const ves_firmness_mode *m = &s->mode[k];
        panel[k] = (ves_modes_panel){.n = m->n, .wr = at->wr[m->n], .wz = at->wz[m->n]};
        snprintf(panel[k].caption[0], sizeof panel[k].caption[0], "n = %d: %.4g %s", m->n,
                 m->value[0] / shown->factor, shown->unit);
        snprintf(panel[k].caption[1], sizeof panel[k].caption[1], "%s%s%s", ves_firmness_text(m->firmness),
                 *parity_text(m->parity[0]) ? ", " : "", parity_text(m->parity[0]));
    }
    const ves_modes modes = {p->title, at->points, at->r, at->z, s->modes, panel};
    return ves_modes_write(&modes, a->options.png, a->diag);
}

int app_stability(app *a)
{
    ves_opened opened;
    ves_stability found;
    int code;
    if (!app_open(a, &opened, &code)) return code;
    ves_stability_options options = {.counted = a->options.counted,
                                     .modes = a->options.modes,
                                     .functions = a->options.functions,
                                     .along = a->options.along};
    if (a->options.follows)
        options.change = ves_arena_take(&a->arena, (size_t)opened.problem->variables, sizeof(double));
    if (a->options.png) options.profile = ves_arena_take(&a->arena, 1, sizeof *options.profile);
    if (a->options.png && !options.profile) {
        ves_study_close(&opened);
        return app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    }
    ves_status status = ves_stability_find(opened.problem, &options, &found, a->diag);
    if (status == VES_OK && options.profile) status = picture(a, opened.problem, &found, options.profile);
    app_say(a);
    code = app_code(status);
    if (status == VES_OK) {
        if (a->options.json)
            json_print(opened.problem, &found, options.change);
        else
            screen(opened.problem, &found, stdout);
        if (a->options.follows) app_follow(a, &opened, &found, options.change);
        code = found.firmness >= VES_UNSTABLE ? APP_UNMET : APP_DONE;
    }
    ves_study_close(&opened);
    return code;
}
