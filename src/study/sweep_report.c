#include "study/sweep_report.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "base/text.h"
#include "output/file.h"
#include "study/design.h"
#include "study/folder.h"
#include "study/sweep_folder.h"

enum { UNIT = 2 * VES_UNIT_TEXT + 8 };

typedef struct reporter {
    const ves_sweep *sweep;
    ves_arena arena;
    ves_diag *diag;
} reporter;

static int points_of(const ves_sweep *s)
{
    return s->walks * s->count;
}

/* --- lines of JSON --- */

static void lines_fill(const reporter *r, FILE *out)
{
    ves_json json = {.out = out, .line = true};
    for (int k = 0; k < points_of(r->sweep); k++)
        if (r->sweep->point[k].done) ves_sweep_point_json(r->sweep, k, true, false, &json);
}

static void times_fill(const reporter *r, FILE *out)
{
    ves_json json = {.out = out, .line = true};
    for (int k = 0; k < points_of(r->sweep); k++) {
        if (!r->sweep->point[k].done) continue;
        ves_json_object(&json, NULL);
        ves_json_integer(&json, "point", k);
        ves_json_number(&json, "wall_s", r->sweep->point[k].wall);
        ves_json_end(&json, '}');
    }
}

static void changes_json(const ves_sweep *s, ves_json *json)
{
    const ves_sweep_axis *axis = s->def->axis;
    const int seconds = s->def->axes > 1 ? axis[1].count : 1;
    ves_sweep_change c;
    ves_json_array(json, "changes");
    for (int j = 0; j < seconds; j++)
        for (int place = 0; ves_sweep_change_find(s, j, place, &c); place = c.next) {
            ves_json_object(json, NULL);
            if (s->def->axes > 1) ves_json_number(json, axis[1].name, axis[1].value[j]);
            ves_json_text(json, "from", s->walk[c.from].name);
            ves_json_text(json, "to", s->walk[c.to].name);
            ves_json_number(json, "behind", axis->value[c.place]);
            ves_json_number(json, "before", axis->value[c.next]);
            ves_json_number(json, "at", c.at);
            const ves_sweep_known *known = ves_sweep_change_known(s, &c);
            if (known) ves_json_number(json, "known", known->at);
            ves_json_end(json, '}');
        }
    ves_json_end(json, ']');
}

void ves_sweep_json(const ves_sweep *s, ves_json *json)
{
    ves_json_text(json, "title", s->problem->title);
    ves_json_text(json, "goal", s->problem->objective_text);
    ves_json_flag(json, "maximize", s->problem->maximize);
    ves_json_text(json, "folder", s->folder);
    ves_json_text(json, "version", VESICA_VERSION);
    ves_json_integer(json, "points", points_of(s));
    ves_json_integer(json, "done", s->done);
    changes_json(s, json);
    ves_json_array(json, "point");
    for (int k = 0; k < points_of(s); k++)
        if (s->point[k].done) ves_sweep_point_json(s, k, true, false, json);
    ves_json_end(json, ']');
}

/* --- the table --- */

/* Short pieces. */
__attribute__((format(printf, 2, 3))) static void put(FILE *out, const char *format, ...)
{
    char text[160];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    fputs(text, out);
}

/* A cell of text: quoted where a comma or a quote would break it. */
static void put_text(FILE *out, const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"') fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

/* ,name [unit] */
static void put_head(FILE *out, const char *before, const char *name, const char *unit)
{
    char text[400];
    snprintf(text, sizeof text, *unit ? "%s%.200s [%s]" : "%s%.200s", before, name, unit);
    fputc(',', out);
    put_text(out, text);
}

/* In a unit that is not the SI one the division leaves a rounding, which nobody wants to see: the shortest number that
 * is `value` up to it. points.jsonl has the exact ones. */
static void number_text(double value, double factor, char text[32])
{
    double back = value / factor;
    for (int digits = 1; digits < 16 && factor != 1; digits++) {
        snprintf(text, 32, "%.*g", digits, value / factor);
        if (ves_text_number(text, &back) && fabs(back * factor - value) <= 2 * DBL_EPSILON * fabs(value))
            break;
        back = value / factor;
    }
    ves_text_shortest(back, text);
}

/* ,number in the unit of the file; empty where there is none */
static void put_number(FILE *out, double value, double factor)
{
    char text[32] = "";
    if (isfinite(value)) number_text(value, factor, text);
    put(out, ",%s", text);
}

/* What a unit of a constraint costs, in units of the objective. */
static ves_shown price_shown(const ves_problem *p, int constraint, char unit[UNIT])
{
    const ves_shown *of = &p->objective_shown, *per = &p->constraint[constraint].shown;
    snprintf(unit, UNIT, !*per->unit ? "%s" : *of->unit ? "%s/(%s)" : "%s1/(%s)", of->unit, per->unit);
    return (ves_shown){.factor = of->factor / per->factor};
}

static void table_head(const ves_sweep *s, FILE *out)
{
    const ves_problem *p = s->problem;
    char unit[UNIT];
    fputs(s->def->branches ? "point,walk,branch,direction" : "point,walk,direction", out);
    for (int k = 0; k < s->def->axes; k++)
        put_head(out, "", s->def->axis[k].name, p->parameter[s->def->axis[k].parameter].shown.unit);
    fputs(",status,reason", out);
    if (s->def->finest > 0) put_head(out, "", "reached", p->parameter[s->def->axis[0].parameter].shown.unit);
    fputs(p->kinds ? ",kind,was,optimum,best,feasible" : ",optimum,best,feasible", out);
    put_head(out, "", "objective", p->objective_shown.unit);
    fputs(",violation", out);
    for (int k = 0; k < p->measures; k++) put_head(out, "", p->measure[k].name, p->measure[k].shown.unit);
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        put_head(out, "value of ", c->text, c->shown.unit);
        put_head(out, "limit of ", c->text, c->shown.unit);
        price_shown(p, k, unit);
        put_head(out, "price of ", c->text, unit);
    }
    for (int k = 0; k < p->variables; k++) put_head(out, "", p->variable[k].name, p->variable[k].shown.unit);
    if (p->solve) put_head(out, "", p->solve->name, p->solve->shown.unit);
    fputs(",evaluations,gradients\n", out);
}

static void table_place(const ves_sweep *s, int index, FILE *out)
{
    const ves_sweep_def *def = s->def;
    const ves_sweep_walk *walk = &s->walk[index / s->count];
    const int at[VES_SWEEP_AXES] = {ves_sweep_place(s, index), walk->second};
    put(out, "%d,%d,", index, index / s->count);
    if (def->branches) {
        put_text(out, def->branch[walk->branch].name);
        fputc(',', out);
    }
    fputs(ves_sweep_direction(s, walk->back), out);
    for (int k = 0; k < def->axes; k++)
        put_number(out, def->axis[k].value[at[k]],
                   s->problem->parameter[def->axis[k].parameter].shown.factor);
}

static void table_numbers(const ves_sweep *s, const double *column, FILE *out)
{
    const ves_problem *p = s->problem;
    const int *first = s->first;
    char unit[UNIT];
    put_number(out, column[first[VES_SWEEP_OBJECTIVE]], p->objective_shown.factor);
    put_number(out, column[first[VES_SWEEP_VIOLATION]], 1);
    for (int k = 0; k < p->measures; k++)
        put_number(out, column[first[VES_SWEEP_MEASURE] + k], p->measure[k].shown.factor);
    for (int k = 0; k < p->constraints; k++) {
        put_number(out, column[first[VES_SWEEP_VALUE] + k], p->constraint[k].shown.factor);
        put_number(out, column[first[VES_SWEEP_LIMIT] + k], p->constraint[k].shown.factor);
        put_number(out, column[first[VES_SWEEP_PRICE] + k], price_shown(p, k, unit).factor);
    }
    for (int k = 0; k < p->variables; k++)
        put_number(out, column[first[VES_SWEEP_VARIABLE] + k], p->variable[k].shown.factor);
    if (p->solve) put_number(out, column[first[VES_SWEEP_UNKNOWN]], p->solve->shown.factor);
}

/* Of which kind it is, and the one that it began at was, if of another. */
static void table_kind(const ves_sweep *s, int index, FILE *out)
{
    const double violation = s->point[index].column[s->first[VES_SWEEP_VIOLATION]];
    const int before = ves_sweep_turned(s, index);
    put(out, ",%s", isfinite(violation) ? ves_design_kind(s->problem, s->point[index].kind) : "");
    put(out, ",%s", before >= 0 ? ves_design_kind(s->problem, s->point[before].kind) : "");
}

static void table_fill(const reporter *r, FILE *out)
{
    const ves_sweep *s = r->sweep;
    table_head(s, out);
    for (int k = 0; k < points_of(s); k++) {
        const ves_sweep_point *point = &s->point[k];
        if (!point->done) continue;
        table_place(s, k, out);
        put(out, ",%s,", point->good ? "ok" : "lost");
        if (point->reason) put_text(out, point->reason);
        if (s->def->finest > 0)
            put_number(out, point->reached, s->problem->parameter[s->def->axis[0].parameter].shown.factor);
        if (s->problem->kinds) table_kind(s, k, out);
        put(out, ",%d,%s,%s", point->optimum, point->best ? "true" : "false",
            point->feasible ? "true" : "false");
        table_numbers(s, point->column, out);
        put(out, ",%ld,%ld\n", point->evaluations, point->gradients);
    }
}

/* --- shapes over the parameter --- */

static void shapes_fill(const reporter *r, FILE *out)
{
    const ves_sweep *s = r->sweep;
    const ves_sweep_axis *axis = &s->def->axis[0];
    const double factor = s->problem->parameter[axis->parameter].shown.factor;
    char value[32];
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n  <Collection>\n",
          out);
    for (int place = 0; place < s->count; place++)
        for (int w = 0; w < s->walks; w++) {
            int index = ves_sweep_point_at(s, w, place);
            if (!s->point[index].done || !s->point[index].best) continue;
            number_text(axis->value[place], factor, value);
            put(out, "    <DataSet timestep=\"%s\" part=\"%d\" file=\"shapes/%04d.vtp\"/>\n", value,
                s->walk[w].second, index);
        }
    fputs("  </Collection>\n</VTKFile>\n", out);
}

/* --- all --- */

static ves_status text_write(reporter *r, const char *name, void (*fill)(const reporter *, FILE *))
{
    ves_file file;
    char *path = ves_folder_path(r->sweep->folder, name, &r->arena);
    if (!path) return ves_diag_fail(r->diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, "text", r->diag));
    fill(r, file.out);
    return ves_file_end(&file, VES_OK, r->diag);
}

static ves_status all_write(reporter *r)
{
    VES_TRY(text_write(r, "points.jsonl", lines_fill));
    VES_TRY(text_write(r, "times.jsonl", times_fill));
    VES_TRY(text_write(r, "sweep.csv", table_fill));
    VES_TRY(text_write(r, "shapes.pvd", shapes_fill));
    return ves_sweep_chart_write(r->sweep, r->diag);
}

ves_status ves_sweep_report_write(const ves_sweep *sweep, ves_diag *diag)
{
    reporter r = {.sweep = sweep, .diag = diag};
    ves_status status = all_write(&r);
    ves_arena_destroy(&r.arena);
    return status;
}
