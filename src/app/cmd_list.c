/* vesica list: what problem files may use. */
#include <string.h>

#include "app/app.h"
#include "app/table.h"
#include "app/template.h"
#include "base/text.h"
#include "formula/dimension.h"
#include "measure/registry.h"
#include "problem/material.h"
#include "problem/schema.h"
#include "suite/landscape.h"

/* Where the items of a list go: into a table, or into JSON. */
typedef struct sink {
    app_table table;
    ves_json *json; /* NULL: the table */
} sink;

static void begin(sink *s, const char *name, const char *about)
{
    if (s->json) {
        ves_json_object(s->json, NULL);
        ves_json_text(s->json, "name", name);
        ves_json_text(s->json, "about", about);
    } else {
        app_table_cell(&s->table, "%s", name);
    }
}

static void end(sink *s)
{
    if (s->json)
        ves_json_end(s->json, '}');
    else
        app_table_end(&s->table);
}

/* "radius, axis": the keys that an entry understands. */
static void keys(sink *s, const ves_key *key)
{
    char text[300] = "";
    size_t at = 0;
    if (s->json) ves_json_array(s->json, "keys");
    for (; key && key->name && at < sizeof text; key++) {
        int length = snprintf(text + at, sizeof text - at, "%s%s", at ? ", " : "", key->name);
        at += length > 0 ? (size_t)length : 0;
        if (s->json) ves_json_text(s->json, NULL, key->name);
    }
    if (s->json)
        ves_json_end(s->json, ']');
    else
        app_table_cell(&s->table, "%s", text);
}

static void plain(sink *s, const char *name, const char *about)
{
    begin(s, name, about);
    if (!s->json) app_table_cell(&s->table, "%s", about);
    end(s);
}

static void operations(sink *s, bool move)
{
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++) {
        if ((*op)->move != move) continue;
        begin(s, (*op)->name, (*op)->about);
        if (!s->json) app_table_cell(&s->table, "%s", (*op)->about);
        keys(s, (*op)->keys);
        end(s);
    }
}

static void curves(app *a, sink *s)
{
    (void)a;
    operations(s, false);
}

static void moves(app *a, sink *s)
{
    (void)a;
    operations(s, true);
}

static void measures(app *a, sink *s)
{
    const ves_measure *const *lists[2] = {ves_measures(), a->measure};
    for (int l = 0; l < 2; l++)
        for (const ves_measure *const *m = lists[l]; m && *m; m++) {
            begin(s, (*m)->name, (*m)->about);
            if (!s->json)
                app_table_cell(&s->table, "%s%s%s", (*m)->about, (*m)->closed ? " (closed shapes)" : "",
                               (*m)->gradient ? "" : " (no gradient)");
            keys(s, (*m)->keys);
            if (s->json) ves_json_flag(s->json, "closed", (*m)->closed);
            if (s->json) ves_json_flag(s->json, "gradient", (*m)->gradient);
            end(s);
        }
}

static void algorithms(app *a, sink *s)
{
    (void)a;
    for (const ves_algorithm *k = ves_search_algorithms(); k->name; k++) {
        begin(s, k->name, k->about);
        if (!s->json) app_table_cell(&s->table, "%s", k->about);
        if (s->json) ves_json_flag(s->json, "gradient", k->gradient);
        if (s->json) ves_json_flag(s->json, "inequality", k->inequality);
        if (s->json) ves_json_flag(s->json, "equality", k->equality);
        end(s);
    }
}

static void choices(sink *s, ves_slot slot)
{
    ves_choice choice;
    for (int k = 0; ves_search_choice(slot, k, &choice); k++) plain(s, choice.name, choice.about);
}

static void proposals(app *a, sink *s)
{
    (void)a;
    choices(s, VES_SLOT_PROPOSAL);
}

static void schedules(app *a, sink *s)
{
    (void)a;
    choices(s, VES_SLOT_SCHEDULE);
}

static void populations(app *a, sink *s)
{
    (void)a;
    choices(s, VES_SLOT_POPULATION);
}

static void constraints(app *a, sink *s)
{
    (void)a;
    choices(s, VES_SLOT_CONSTRAINTS);
}

static void strategies(app *a, sink *s)
{
    (void)a;
    choices(s, VES_SLOT_STRATEGY);
}

static void formats(app *a, sink *s)
{
    (void)a;
    for (const ves_format *const *f = ves_formats(); *f; f++) plain(s, (*f)->name, (*f)->about);
}

static void units(app *a, sink *s)
{
    int count;
    const char *const *name = ves_unit_names(&count);
    (void)a;
    for (int k = 0; k < count; k++) {
        ves_dim dim;
        double factor;
        char text[48], about[96];
        if (!ves_dim_read(name[k], &dim, &factor)) continue;
        ves_dim_text(dim, text);
        bool bare = !strcmp(text, "1");
        snprintf(about, sizeof about, "%.15g%s%s", factor, bare ? "" : " ", bare ? "" : text);
        begin(s, name[k], about);
        if (!s->json) app_table_cell(&s->table, "%s", about);
        if (s->json) ves_json_number(s->json, "factor", factor);
        if (s->json) ves_json_text(s->json, "unit", text);
        end(s);
    }
}

static void templates(app *a, sink *s)
{
    (void)a;
    for (const app_template *t = app_templates; t->name; t++) {
        char title[200];
        app_template_title(t, title, sizeof title);
        plain(s, t->name, title);
    }
}

static void functions(app *a, sink *s)
{
    (void)a;
    for (const ves_landscape *const *l = ves_landscapes(); *l; l++) {
        int most = (*l)->most ? (*l)->most : VES_LANDSCAPE_MOST, least = (*l)->least;
        char many[48];
        snprintf(many, sizeof many, least == most ? "%d" : "%d to %d", least, most);
        begin(s, (*l)->name, (*l)->about);
        if (!s->json) app_table_cell(&s->table, "%s", (*l)->about);
        if (!s->json) app_table_cell(&s->table, "n: %s%s", many, (*l)->free ? ", may be turned" : "");
        if (s->json) ves_json_integer(s->json, "least", least);
        if (s->json) ves_json_integer(s->json, "most", most);
        if (s->json) ves_json_integer(s->json, "inequalities", (*l)->inequalities);
        if (s->json) ves_json_integer(s->json, "equalities", (*l)->equalities);
        if (s->json) ves_json_flag(s->json, "rotate", (*l)->free);
        end(s);
    }
}

static void materials(app *a, sink *s)
{
    (void)a;
    for (const ves_material *m = ves_materials(); m->name; m++) {
        begin(s, m->name, m->about);
        if (!s->json)
            app_table_cell(&s->table, "E = %.12g GPa, nu = %.12g, %.12g kg/m^3, yield %.12g MPa", m->E * 1e-9,
                           m->nu, m->density, m->yield * 1e-6);
        if (!s->json) app_table_cell(&s->table, "%s", m->about);
        if (s->json) ves_json_number(s->json, "E", m->E);
        if (s->json) ves_json_number(s->json, "nu", m->nu);
        if (s->json) ves_json_number(s->json, "density", m->density);
        if (s->json) ves_json_number(s->json, "yield", m->yield);
        if (s->json) ves_json_text(s->json, "source", m->source);
        end(s);
    }
}

static const struct list {
    const char *name;
    void (*fill)(app *a, sink *s);
} lists[] = {{"measures", measures},       {"curves", curves},         {"moves", moves},
             {"algorithms", algorithms},   {"proposals", proposals},   {"schedules", schedules},
             {"populations", populations}, {"strategies", strategies}, {"constraints", constraints},
             {"formats", formats},         {"units", units},           {"templates", templates},
             {"functions", functions},     {"materials", materials}};

enum { LISTS = sizeof lists / sizeof *lists };

static void list_print(app *a, const struct list *l)
{
    ves_json json = {.out = stdout};
    sink s = {.table = {.align = "lll"}, .json = a->options.json ? &json : NULL};
    if (s.json) ves_json_object(&json, NULL);
    if (s.json) ves_json_array(&json, l->name);
    l->fill(a, &s);
    if (s.json) ves_json_end(&json, ']');
    if (s.json) ves_json_end(&json, '}');
    app_table_print(&s.table, stdout);
}

int app_list(app *a)
{
    const char *name[LISTS], *word = a->operands ? a->operand[0] : NULL;
    for (int k = 0; k < LISTS; k++) {
        name[k] = lists[k].name;
        if (!word || strcmp(word, name[k])) continue;
        list_print(a, &lists[k]);
        return APP_DONE;
    }
    int near = word ? ves_text_nearest(word, name, LISTS) : -1;
    if (near >= 0) return app_fail(a, VES_USAGE, "no list \"%s\", did you mean \"%s\"?", word, name[near]);
    return app_fail(a, VES_USAGE,
                    "list what? measures, curves, moves, algorithms, proposals, schedules, populations, "
                    "strategies, constraints, "
                    "formats, units, materials, templates or functions");
}
