/* The manual's reference chapter: every table in Markdown. */
#include <string.h>

#include "formula/dimension.h"
#include "measure/registry.h"
#include "problem/describe.h"
#include "problem/material.h"
#include "vesica/search.h"

static void cell_text(ves_writer *w, const char *text)
{
    for (; *text; text++) {
        if (*text == '|') ves_write(w, "\\");
        ves_write(w, "%c", *text);
    }
}

static void row(ves_writer *w, const ves_key *key)
{
    ves_write(w, "| `%s` | ", key->name);
    ves_describe_kind(w, key);
    ves_writer extra = {0};
    ves_describe_limits(&extra, key);
    if (extra.length) ves_write(w, ", %s", extra.text);
    ves_write(w, " | ");
    ves_describe_default(w, key);
    ves_write(w, " | ");
    cell_text(w, key->about);
    ves_write(w, " |\n");
    w->failed = w->failed || extra.failed;
    ves_memory_free(extra.text);
}

static void table_head(ves_writer *w)
{
    ves_write(w, "\n| key | value | | |\n| --- | --- | --- | --- |\n");
}

static void keys(ves_writer *w, const ves_key *key, const ves_key *extra)
{
    if ((key && key->name) || extra) table_head(w);
    for (; key && key->name; key++) row(w, key);
    if (extra) row(w, extra);
    ves_write(w, "\n");
}

/* The keys of an entry, then those of the mappings among them. */
static void entries(ves_writer *w, const ves_entry *table)
{
    bool any = false;
    for (const ves_entry *e = table; e && e->key.name; e++) {
        if ((int)e->key.kind == VES_LATER) continue;
        if (!any) table_head(w);
        any = true;
        row(w, &e->key);
    }
    if (any) ves_write(w, "\n");
    for (const ves_entry *e = table; e && e->key.name; e++) {
        bool item = (int)e->key.kind == VES_LIST || (int)e->key.kind == VES_NAMED;
        const ves_entry *below = ves_schema_below(e);
        bool shown = !strcmp(e->key.name, "apply") || !strcmp(e->key.name, "search") ||
                     !strcmp(e->key.name, "first") || !strcmp(e->key.name, "expect");
        if (!below || shown) continue;
        if (item)
            ves_write(w, "Each %s of `%s`: %s. For example `%s`:\n", e->table->key.name, e->key.name,
                      e->table->key.about, e->table->example);
        else
            ves_write(w, "Keys of `%s`, for example `%s`:\n", e->key.name, e->example);
        entries(w, below);
    }
}

static void section(ves_writer *w, const ves_entry *e)
{
    ves_write(w, "\n### `%s`\n\n", e->key.name);
    ves_describe_kind(w, &e->key);
    ves_writer extra = {0};
    ves_describe_limits(&extra, &e->key);
    if (extra.length) ves_write(w, ", %s", extra.text);
    extra.length = 0;
    ves_describe_default(&extra, &e->key);
    if (extra.length) ves_write(w, ", %s", extra.text);
    ves_write(w, ": %s.\n\n    %s\n\n", e->key.about, e->example);
    w->failed = w->failed || extra.failed;
    ves_memory_free(extra.text);
    bool item = (int)e->key.kind == VES_LIST || (int)e->key.kind == VES_NAMED;
    if (item) ves_write(w, "Each %s: %s.\n", e->table->key.name, e->table->key.about);
    bool stages = item && (int)e->table->key.kind == VES_STAGE;
    if (!stages) entries(w, item ? e->table->table : e->table);
}

static void operation(ves_writer *w, const char *name, const char *about, const ves_key *table,
                      const ves_key *extra)
{
    ves_write(w, "\n### `%s`\n\n%s: `", name, about);
    ves_describe_example(w, name, table);
    ves_write(w, "`\n");
    keys(w, table, extra);
}

static void operations(ves_writer *w, bool move)
{
    ves_write(w, "\n## %s\n\n%s\n", move ? "Moves" : "Curve kinds",
              move ? "Items of `apply`, in the order of application. A move may be given without its keys: "
                     "that answers the first one, "
                     "`{translate: [0, 0, 1]}`."
                   : "A curve has one of these, and `apply` if it is to be moved. A kind may be given "
                     "without its keys: that answers the "
                     "first one, `{point: [0, 0, 1]}`.");
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++)
        if ((*op)->move == move) operation(w, (*op)->name, (*op)->about, (*op)->keys, NULL);
}

static void measures(ves_writer *w, const ves_measure *const *plugin)
{
    const ves_measure *const *lists[2] = {ves_measures(), plugin};
    ves_write(w, "\n## Measures\n\nA measure whose keys all have defaults can be used in any formula by its "
                 "name. With settings it gets a "
                 "name of its own under `measures`.\n");
    for (int l = 0; l < 2; l++)
        for (const ves_measure *const *m = lists[l]; m && *m; m++) {
            operation(w, (*m)->name, (*m)->about, (*m)->keys, (*m)->surface ? &ves_schema_over : NULL);
            const char *unit = (*m)->unit;
            if (unit && *unit == '*')
                ves_write(w, "In the unit of `of` times %s", unit + 1);
            else if (!unit)
                ves_write(w, "In the unit of `of`");
            else if (strcmp(unit, "1"))
                ves_write(w, "In %s", unit);
            else
                ves_write(w, "A plain number");
            ves_write(w, "; %s%s.\n", (*m)->gradient ? "exact gradient" : "no gradient",
                      (*m)->closed ? "; needs a closed shape" : "");
        }
}

static void choices(ves_writer *w)
{
    static const char *const key[] = {"proposal", "schedule", "population", "constraints",
                                      "polish",   "as",       "only"};
    ves_choice choice;
    ves_write(w, "\n### Words of `anneal` and `auto`\n\n| key | word | |\n| --- | --- | --- |\n");
    for (int slot = 0; slot <= VES_SLOT_STRATEGY; slot++)
        for (int k = 0; ves_search_choice((ves_slot)slot, k, &choice); k++) {
            ves_write(w, "| `%s` | `%s` | ", key[slot], choice.name);
            cell_text(w, choice.about);
            ves_write(w, " |\n");
        }
}

static void searches(ves_writer *w)
{
    const ves_entry *stage = ves_schema_find(ves_schema_root.table, "search")->table->table;
    ves_write(w, "\n## Stages of a search\n");
    for (; stage->key.name; stage++) {
        ves_write(w, "\n### `%s`\n\n%s: `{%s}`\n", stage->key.name, stage->key.about, stage->example);
        entries(w, stage->table);
    }
    ves_write(w, "\n### Algorithms of `polish`\n\n| algorithm | |\n| --- | --- |\n");
    for (const ves_algorithm *a = ves_search_algorithms(); a->name; a++) {
        ves_write(w, "| `%s` | ", a->name);
        cell_text(w, a->about);
        ves_write(w, " |\n");
    }
    choices(w);
}

static void units(ves_writer *w)
{
    int count;
    const char *const *name = ves_unit_names(&count);
    ves_write(w, "\n## Units\n\n%s\n| unit | is |\n| --- | --- |\n", ves_describe_units);
    for (int k = 0; k < count; k++) {
        ves_dim dim;
        double factor;
        char text[48];
        if (!ves_dim_read(name[k], &dim, &factor)) continue;
        ves_dim_text(dim, text);
        ves_write(w, "| `%s` | %.12g%s%s |\n", name[k], factor, ves_dim_plain(dim) ? "" : " ",
                  ves_dim_plain(dim) ? "" : text);
    }
}

static void materials(ves_writer *w)
{
    ves_write(
        w, "\n## Materials\n\nWords of `shell.material`, for walls at room temperature and loads of minutes: "
           "plastics creep.\n\n| material | | E, GPa | nu | density, kg/m^3 | yield, MPa | source |\n"
           "| --- | --- | --- | --- | --- | --- | --- |\n");
    for (const ves_material *m = ves_materials(); m->name; m++)
        ves_write(w, "| `%s` | %s | %.12g | %.12g | %.12g | %.12g | %s |\n", m->name, m->about, m->E * 1e-9,
                  m->nu, m->density, m->yield * 1e-6, m->source);
}

static void later(ves_writer *w, const ves_entry *table)
{
    for (const ves_entry *e = table; e && e->key.name; e++) {
        if ((int)e->key.kind == VES_LATER) ves_write(w, "- `%s`: %s\n", e->key.name, e->key.about);
        later(w, ves_schema_below(e));
    }
}

char *ves_schema_reference(ves_arena *arena, const ves_measure *const *plugin)
{
    ves_writer w = {0};
    ves_write(&w,
              "# Problem files: reference\n\nThis chapter is written by the program from the tables that it "
              "reads problem files with "
              "(format 1).\n\n## Formulas\n\n%s\n## Names\n\n%s\n## Keys\n",
              ves_describe_formulas, ves_describe_names);
    for (const ves_entry *e = ves_schema_root.table; e->key.name; e++)
        if ((int)e->key.kind != VES_LATER) section(&w, e);
    operations(&w, false);
    operations(&w, true);
    measures(&w, plugin);
    searches(&w);
    materials(&w);
    units(&w);
    ves_write(&w, "\n## Suites\n\nThe keys of a suite file, which `vesica bench` runs "
                  "([benchmark.md](benchmark.md)).\n");
    for (const ves_entry *e = ves_schema_suite.table; e->key.name; e++) section(&w, e);
    ves_write(&w, "\n## Words kept for later versions\n\n");
    later(&w, ves_schema_root.table);
    return ves_writer_finish(&w, arena);
}
