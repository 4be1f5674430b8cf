/* JSON Schema (draft 07) of problem files, for editors: completion, hover texts, first checks. Numbers may be
 * formulas, so a number is a number or a text here; what formulas mean is for the reader. */
#include <math.h>
#include <string.h>

#include "measure/registry.h"
#include "problem/describe.h"
#include "problem/material.h"
#include "vesica/search.h"

#define NUMBER "\"type\":[\"number\",\"string\"]"
#define POINT  "{\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{" NUMBER "}}"

static void string(ves_writer *w, const char *text)
{
    ves_write(w, "\"");
    for (; *text; text++)
        if (*text == '"' || *text == '\\')
            ves_write(w, "\\%c", *text);
        else
            ves_write(w, "%c", *text);
    ves_write(w, "\"");
}

static void words(ves_writer *w, const char *list)
{
    ves_write(w, "\"enum\":[");
    for (const char *at = list; at; at = strchr(at, '|')) {
        if (*at == '|') at++;
        ves_write(w, "%s\"%.*s\"", at == list ? "" : ",", (int)strcspn(at, "|"), at);
    }
    ves_write(w, "]");
}

/* The inside of one object; the caller writes its braces. */
static void leaf(ves_writer *w, const ves_key *key)
{
    static const char *const text[] = {
        "",
        NUMBER,
        "\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{" NUMBER "}",
        "\"anyOf\":[{" NUMBER "}," POINT "]",
        "\"type\":\"array\",\"items\":{" NUMBER "}",
        "\"type\":\"array\",\"items\":" POINT,
        "\"type\":\"array\",\"minItems\":1,\"items\":{\"type\":\"array\",\"minItems\":2,\"maxItems\":2}",
        "\"type\":[\"integer\",\"string\"]",
        "\"type\":\"boolean\"",
        "",
        "\"type\":[\"string\",\"number\",\"boolean\"]",
        "\"type\":\"string\"",
        "\"type\":\"string\"",
        "\"anyOf\":[{\"type\":\"string\"},{\"type\":\"array\",\"minItems\":1,\"items\":{\"type\":\"string\"}}"
        "]",
        "\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{" NUMBER "}",
        NUMBER,
        "\"type\":\"string\"",
        "\"type\":\"string\"",
        NUMBER,
        "\"type\":\"string\"",
    };
    bool number = key->kind == VES_NUMBER || key->kind == VES_COUNT;
    if (key->kind == VES_CHOICE)
        words(w, key->words);
    else
        ves_write(w, "%s", text[key->kind]);
    if (number && (key->min != 0 || key->max != 0)) {
        if (key->min == VES_POSITIVE)
            ves_write(w, ",\"exclusiveMinimum\":0");
        else if (!isinf(key->min))
            ves_write(w, ",\"minimum\":%.12g", key->min);
        if (!isinf(key->max)) ves_write(w, ",\"maximum\":%.12g", key->max);
    }
}

static void about(ves_writer *w, const ves_key *key)
{
    ves_write(w, ",\"description\":");
    string(w, key->about);
}

/* Operations and measures: a mapping of their keys, or the first one alone. */
static void operation(ves_writer *w, const char *text, const ves_key *keys, const ves_key *extra)
{
    ves_write(w, "{\"description\":");
    string(w, text);
    ves_write(w, ",\"anyOf\":[{\"type\":\"null\"},{\"type\":\"object\",\"additionalProperties\":false,"
                 "\"properties\":{");
    const char *gap = "";
    for (const ves_key *key = keys; key && key->name; key++, gap = ",") {
        ves_write(w, "%s\"%s\":{", gap, key->name);
        leaf(w, key);
        about(w, key);
        ves_write(w, "}");
    }
    if (extra) {
        ves_write(w, "%s\"%s\":{", gap, extra->name);
        leaf(w, extra);
        about(w, extra);
        ves_write(w, "}");
    }
    ves_write(w, "},\"required\":[");
    gap = "";
    for (const ves_key *key = keys; key && key->name; key++)
        if (key->required) ves_write(w, "%s\"%s\"", gap, key->name), gap = ",";
    ves_write(w, "]}");
    if ((keys && keys->name) || extra) {
        ves_write(w, ",{");
        leaf(w, keys && keys->name ? keys : extra);
        ves_write(w, "}");
    }
    ves_write(w, "]}");
}

static void curve_operations(ves_writer *w, bool move, const char *gap)
{
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++) {
        if ((*op)->move != move) continue;
        ves_write(w, "%s\"%s\":", gap, (*op)->name);
        operation(w, (*op)->about, (*op)->keys, NULL);
        gap = ",";
    }
}

static void measures(ves_writer *w, const ves_measure *const *plugin)
{
    const ves_measure *const *lists[2] = {ves_measures(), plugin};
    const char *gap = "";
    for (int l = 0; l < 2; l++)
        for (const ves_measure *const *m = lists[l]; m && *m; m++, gap = ",") {
            ves_write(w, "%s\"%s\":", gap, (*m)->name);
            operation(w, (*m)->about, (*m)->keys, (*m)->surface ? &ves_schema_over : NULL);
        }
}

static void entry(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin);

static void properties(ves_writer *w, const ves_entry *table, const ves_measure *const *plugin)
{
    const char *gap = "";
    ves_write(w, "\"type\":\"object\",\"additionalProperties\":false,\"properties\":{");
    for (const ves_entry *e = table; e->key.name; e++) {
        if ((int)e->key.kind == VES_LATER) continue;
        ves_write(w, "%s\"%s\":", gap, e->key.name);
        entry(w, e, plugin);
        gap = ",";
    }
    ves_write(w, "},\"required\":[");
    gap = "";
    for (const ves_entry *e = table; e->key.name; e++)
        if (e->key.required) ves_write(w, "%s\"%s\"", gap, e->key.name), gap = ",";
    ves_write(w, "]");
}

static void source(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    ves_write(w, "\"type\":\"object\",\"additionalProperties\":false,\"properties\":{");
    const char *gap = "";
    for (const ves_entry *key = e->table; key->key.name; key++, gap = ",") {
        ves_write(w, "%s\"%s\":", gap, key->key.name);
        entry(w, key, plugin);
    }
    curve_operations(w, false, gap);
    ves_write(w, "}");
}

static void choices(ves_writer *w, ves_slot slot)
{
    ves_choice choice;
    ves_write(w, "\"enum\":[");
    for (int k = 0; ves_search_choice(slot, k, &choice); k++)
        ves_write(w, "%s\"%s\"", k ? "," : "", choice.name);
    ves_write(w, "]");
}

static void algorithms(ves_writer *w)
{
    const char *gap = "";
    ves_write(w, "\"enum\":[");
    for (const ves_algorithm *a = ves_search_algorithms(); a->name; a++, gap = ",")
        ves_write(w, "%s\"%s\"", gap, a->name);
    ves_write(w, "]");
}

/* A number in its range. */
static void limited(ves_writer *w, const ves_key *key)
{
    ves_key number = *key;
    number.kind = VES_NUMBER;
    leaf(w, &number);
}

/* One entry of a curve, a move, a measure or a stage: an object with one property. */
static void one_of(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    ves_write(
        w, "\"anyOf\":[{\"type\":\"string\"},{\"type\":\"object\",\"minProperties\":1,\"maxProperties\":1,");
    if ((int)e->key.kind == VES_STAGE) {
        ves_write(w, "\"additionalProperties\":false,\"properties\":{");
        const char *gap = "";
        for (const ves_entry *s = e->table; s->key.name; s++, gap = ",") {
            ves_write(w, "%s\"%s\":{\"anyOf\":[{\"type\":[\"string\",\"number\",\"null\"]},", gap,
                      s->key.name);
            entry(w, s, plugin);
            ves_write(w, "]}");
        }
    } else {
        ves_write(w, "\"additionalProperties\":false,\"properties\":{");
        if ((int)e->key.kind == VES_MOVE)
            curve_operations(w, true, "");
        else
            measures(w, plugin);
    }
    ves_write(w, "}}]");
}

static void list(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    const ves_key *key = &e->key;
    if (key->max != 0) {
        ves_write(w, "\"type\":\"array\",");
        if (key->min > 0) ves_write(w, "\"minItems\":%g,", key->min);
        if (!isinf(key->max)) ves_write(w, "\"maxItems\":%g,", key->max);
        ves_write(w, "\"items\":");
        entry(w, e->table, plugin);
        return;
    }
    ves_write(w, "\"anyOf\":[{\"type\":\"array\",\"items\":");
    entry(w, e->table, plugin);
    ves_write(w, "},");
    entry(w, e->table, plugin);
    if (e->key.words) ves_write(w, ",{\"const\":\"%s\"}", e->key.words);
    ves_write(w, "]");
}

static void map(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    if (e->key.words) ves_write(w, "\"anyOf\":[{\"const\":\"%s\"},{", e->key.words);
    properties(w, e->table, plugin);
    if (e->key.words) ves_write(w, "}]");
}

static void relation(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    ves_write(w, "\"anyOf\":[{\"type\":\"string\"}");
    if (e->table) {
        ves_write(w, ",{");
        properties(w, e->table, plugin);
        ves_write(w, "}");
    }
    ves_write(w, "]");
}

static void material(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    if (e->table) ves_write(w, "\"anyOf\":[{");
    ves_write(w, "\"enum\":[");
    for (const ves_material *m = ves_materials(); m->name; m++)
        ves_write(w, "%s\"%s\"", m == ves_materials() ? "" : ",", m->name);
    ves_write(w, "]");
    if (e->table) ves_write(w, "},{"), properties(w, e->table, plugin), ves_write(w, "}]");
}

static void compound(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    switch ((int)e->key.kind) {
    case VES_MAP:
        map(w, e, plugin);
        break;
    case VES_NAMED:
        ves_write(w, "\"type\":\"object\",\"propertyNames\":{\"pattern\":\"^[A-Za-z_][A-Za-z0-9_]*$\"},"
                     "\"additionalProperties\":");
        entry(w, e->table, plugin);
        break;
    case VES_LIST:
        list(w, e, plugin);
        break;
    case VES_INTERVAL:
    case VES_SPAN: {
        int count = (int)e->key.kind == VES_SPAN ? 2 : 3;
        ves_write(w, "\"type\":\"array\",\"minItems\":%d,\"maxItems\":%d,\"items\":{" NUMBER "}", count,
                  count);
        break;
    }
    case VES_GRID:
        ves_write(
            w,
            "\"type\":\"array\",\"minItems\":2,\"items\":{\"type\":\"array\",\"minItems\":2,\"items\":" POINT
            "}");
        break;
    case VES_END:
        ves_write(w, "\"type\":\"string\",\"pattern\":\"\\\\.u[01]$\"");
        break;
    case VES_PAIR:
        ves_write(w, "\"anyOf\":[{");
        limited(w, &e->key);
        ves_write(w, "},{\"type\":\"array\",\"minItems\":2,\"maxItems\":2,\"items\":{");
        limited(w, &e->key);
        ves_write(w, "}}]");
        break;
    case VES_SWEPT:
        ves_write(w, "\"anyOf\":[{" NUMBER "},{\"type\":\"array\",\"minItems\":1,\"items\":{" NUMBER "}}");
        if (e->table) ves_write(w, ",{"), properties(w, e->table, plugin), ves_write(w, "}");
        ves_write(w, "]");
        break;
    case VES_VARIED:
        ves_write(w, "\"type\":[\"string\",\"array\",\"object\"]");
        break;
    case VES_SOURCE:
        source(w, e, plugin);
        break;
    case VES_MOVE:
    case VES_INSTANCE:
    case VES_STAGE:
        one_of(w, e, plugin);
        break;
    case VES_ALGORITHM:
        algorithms(w);
        break;
    case VES_SLOT_WORD:
        choices(w, (ves_slot)e->key.max);
        break;
    case VES_SEED:
        ves_write(w, "\"type\":[\"integer\",\"string\"],\"minimum\":0");
        break;
    case VES_RELATION:
        relation(w, e, plugin);
        break;
    case VES_FIELDS:
        ves_write(w, "\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{" NUMBER "}");
        break;
    case VES_MATERIAL:
        material(w, e, plugin);
        break;
    default:
        ves_write(w, NUMBER);
        break;
    }
}

/* A value, or the mapping of keys that it is short for. */
static void brief(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    ves_write(w, "\"anyOf\":[{");
    leaf(w, &e->key);
    ves_write(w, "},{");
    properties(w, e->table, plugin);
    ves_write(w, "}]");
}

static void entry(ves_writer *w, const ves_entry *e, const ves_measure *const *plugin)
{
    ves_write(w, "{");
    if ((int)e->key.kind < VES_MAP && e->table)
        brief(w, e, plugin);
    else if ((int)e->key.kind < VES_MAP)
        leaf(w, &e->key);
    else
        compound(w, e, plugin);
    about(w, &e->key);
    ves_write(w, "}");
}

static char *whole(ves_arena *arena, const ves_entry *root, const ves_measure *const *plugin)
{
    ves_writer w = {0};
    ves_write(&w,
              "{\"$schema\":\"http://json-schema.org/draft-07/schema#\",\"title\":\"vesica %s file, "
              "format 1\",",
              root->key.name);
    properties(&w, root->table, plugin);
    ves_write(&w, "}\n");
    return ves_writer_finish(&w, arena);
}

char *ves_schema_json(ves_arena *arena, const ves_measure *const *plugin)
{
    return whole(arena, &ves_schema_root, plugin);
}

char *ves_schema_suite_json(ves_arena *arena)
{
    return whole(arena, &ves_schema_suite, NULL);
}
