/* Help on one word: all that the tables know about it. */
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "formula/dimension.h"
#include "formula/parser.h"
#include "measure/registry.h"
#include "problem/describe.h"
#include "problem/material.h"
#include "vesica/search.h"

enum { WORDS = 600, PATH = 200 };

typedef struct help {
    ves_writer writer;
    const char *word;
    const ves_measure *const *plugin;
    bool found;
    const char *parent;           /* the word without its last part; NULL: it has one part */
    ves_writer keys;              /* what the parent has */
    const char *candidate[WORDS]; /* all words there are */
    int candidates;
} help;

static bool is_word(help *h, const char *name)
{
    if (h->candidates < WORDS) h->candidate[h->candidates++] = name;
    return !strcmp(name, h->word);
}

/* Does path end in the words of `end`, whole? "anneal.s" is an end of "search.anneal.s". */
static bool ends(const char *path, const char *end)
{
    size_t length = strlen(path), asked = strlen(end);
    if (!asked || asked > length || strcmp(path + length - asked, end)) return false;
    return asked == length || path[length - asked - 1] == '.';
}

/* Is it the path with names and numbers of the file in between: patches.wall.conditions.0.scale? */
static bool passes(const char *word, const char *path)
{
    bool last = false;
    size_t first = strcspn(path, ".");
    if (strncmp(word, path, first) || (word[first] && word[first] != '.')) return false;
    for (const char *w = word, *p = path;;) {
        size_t a = strcspn(w, "."), b = strcspn(p, ".");
        last = *p && a == b && !strncmp(w, p, a);
        if (last) p += b + (p[b] == '.');
        if (!w[a]) return last && !*p;
        w += a + 1;
    }
}

static bool is_path(const char *word, const char *path)
{
    return ends(path, word) || passes(word, path);
}

static void heading(help *h)
{
    if (h->found) ves_write(&h->writer, "\n");
    h->found = true;
}

/* One of those that the parent has. */
static void key_name(help *h, const char *name)
{
    ves_write(&h->keys, "%s%s", h->keys.length ? ", " : "", name);
}

static void key_line(ves_writer *w, const ves_key *key)
{
    ves_writer extra = {0};
    ves_write(w, "  %s: ", key->name);
    ves_describe_kind(w, key);
    ves_describe_limits(&extra, key);
    if (extra.length) ves_write(w, " (%s)", extra.text);
    extra.length = 0;
    ves_describe_default(&extra, key);
    if (extra.length) ves_write(w, ", %s", extra.text);
    ves_write(w, "\n      %s\n", key->about);
    w->failed = w->failed || extra.failed;
    ves_memory_free(extra.text);
}

/* The words of a slot, each on a line. */
static void words_help(ves_writer *w, const ves_key *key)
{
    ves_choice choice;
    if ((int)key->kind != VES_SLOT_WORD) return;
    for (int k = 0; ves_search_choice((ves_slot)key->max, k, &choice); k++)
        ves_write(w, "      %s: %s\n", choice.name, choice.about);
}

static void entry_help(help *h, const ves_entry *entry, const char *path)
{
    ves_writer *w = &h->writer;
    heading(h);
    if ((int)entry->key.kind == VES_LATER) {
        ves_write(w, "%s\n      %s; not in this version yet\n", path, entry->key.about);
        return;
    }
    ves_write(w, "%s\n", path);
    key_line(w, &entry->key);
    words_help(w, &entry->key);
    if (entry->example) ves_write(w, "      example: %s\n", entry->example);
    const ves_entry *table = entry->table;
    bool item = (int)entry->key.kind == VES_LIST || (int)entry->key.kind == VES_NAMED;
    if (item && table)
        ves_write(w, "  each %s: %s\n      example: %s\n", table->key.name, table->key.about, table->example);
    if (item && table) table = table->table;
    for (const ves_entry *e = table; e && e->key.name; e++)
        if ((int)e->key.kind != VES_LATER) key_line(w, &e->key);
}

/* The stages of a search once more: told only to who asks for them there. */
static bool is_again(const help *h, const char *path)
{
    static const char *const below[] = {"test.", "sweep.search.", "sweep.first.", "suite.methods.search."};
    for (size_t k = 0; k < sizeof below / sizeof *below; k++) {
        const size_t first = strcspn(below[k], ".");
        if (!strncmp(path, below[k], strlen(below[k])) && strncmp(h->word, below[k], first)) return true;
    }
    return false;
}

static void walk(help *h, const ves_entry *table, const char *path)
{
    for (const ves_entry *e = table; e && e->key.name; e++) {
        char inner[PATH];
        ves_writer w = {0};
        ves_write(&w, "%s%s%s", path, *path ? "." : "", e->key.name);
        inner[0] = 0;
        if (w.text && w.length < PATH) memcpy(inner, w.text, w.length + 1);
        h->writer.failed = h->writer.failed || w.failed;
        ves_memory_free(w.text);
        is_word(h, e->key.name);
        bool again = is_again(h, inner);
        bool choice = e->key.kind == VES_CHOICE && ves_words_find(e->key.words, h->word) >= 0;
        if ((choice || is_path(h->word, inner)) && !(again && h->found)) entry_help(h, e, inner);
        if (*path && h->parent && is_path(h->parent, path) && !again) key_name(h, e->key.name);
        const ves_entry *below = ves_schema_below(e);
        walk(h, below, inner);
    }
}

static void operation_help(help *h, const char *what, const char *name, const char *about,
                           const ves_key *keys)
{
    heading(h);
    ves_write(&h->writer, "%s: %s\n      %s\n      example: ", name, what, about);
    ves_describe_example(&h->writer, name, keys);
    ves_write(&h->writer, "\n");
    for (const ves_key *key = keys; key && key->name; key++) key_line(&h->writer, key);
}

/* The key of an operation: radius, circle.radius, curves.ring.circle.radius. */
static void one_key_help(help *h, const char *name, const ves_key *keys)
{
    bool parent = h->parent && ends(h->parent, name);
    const char *dot = strrchr(h->word, '.');
    for (const ves_key *key = keys; key && key->name; key++) {
        if (parent) key_name(h, key->name);
        bool same = parent && !strcmp(dot + 1, key->name);
        if (!is_word(h, key->name) && !same) continue;
        heading(h);
        ves_write(&h->writer, "%s.%s\n", name, key->name);
        key_line(&h->writer, key);
    }
}

/* curves.ring.circle is the word circle too. */
static bool is_operation(help *h, const char *name)
{
    const char *dot = strrchr(h->word, '.');
    return is_word(h, name) || (dot && !strcmp(dot + 1, name));
}

static void curve_help(help *h)
{
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++) {
        if (is_operation(h, (*op)->name))
            operation_help(h, (*op)->move ? "a move of a curve" : "a curve kind", (*op)->name, (*op)->about,
                           (*op)->keys);
        one_key_help(h, (*op)->name, (*op)->keys);
    }
}

static void measure_help(help *h)
{
    const ves_measure *const *lists[2] = {ves_measures(), h->plugin};
    for (int l = 0; l < 2; l++)
        for (const ves_measure *const *m = lists[l]; m && *m; m++) {
            one_key_help(h, (*m)->name, (*m)->keys);
            if (!is_operation(h, (*m)->name)) continue;
            operation_help(h, "a measure", (*m)->name, (*m)->about, (*m)->keys);
            if ((*m)->surface) key_line(&h->writer, &ves_schema_over);
            if ((*m)->unit && *(*m)->unit != '*')
                ves_write(&h->writer, "  in %s\n", strcmp((*m)->unit, "1") ? (*m)->unit : "no unit");
            if ((*m)->closed) ves_write(&h->writer, "  needs a closed shape\n");
            ves_write(&h->writer, "  gradient: %s\n", (*m)->gradient ? "exact" : "by differences");
        }
}

static void algorithm_help(help *h)
{
    for (const ves_algorithm *a = ves_search_algorithms(); a->name; a++) {
        if (!is_word(h, a->name)) continue;
        heading(h);
        ves_write(&h->writer,
                  "%s: an algorithm of the stage polish\n      %s\n      example: {polish: %s}\n  gradients: "
                  "%s; <=: %s; ==: %s\n",
                  a->name, a->about, a->name, a->gradient ? "uses them" : "does without",
                  a->inequality ? "itself" : "through auglag", a->equality ? "itself" : "through auglag");
    }
}

static void choice_help(help *h)
{
    static const char *const key[] = {"proposal", "schedule", "population", "constraints",
                                      "polish",   "as",       "only"};
    ves_choice choice;
    for (int slot = 0; slot <= VES_SLOT_STRATEGY; slot++)
        for (int k = 0; ves_search_choice((ves_slot)slot, k, &choice); k++) {
            if (!is_word(h, choice.name)) continue;
            heading(h);
            const char *stage = slot == VES_SLOT_STRATEGY ? "auto" : "anneal";
            ves_write(&h->writer, "%s: a word of %s.%s\n      %s\n      example: {%s: {%s: %s}}\n",
                      choice.name, stage, key[slot], choice.about, stage, key[slot], choice.name);
        }
}

static void unit_help(help *h)
{
    ves_dim dim;
    double factor;
    char text[48], each[64];
    int count;
    const char *const *name = ves_unit_names(&count);
    for (int k = 0; k < count; k++) is_word(h, name[k]);
    if (!strcmp(h->word, "1") || !ves_dim_read(h->word, &dim, &factor)) return;
    heading(h);
    ves_dim_text(dim, text);
    ves_dim_describe(dim, each);
    ves_write(&h->writer, "%s: a unit of %s\n      1 %s = %.12g%s%s\n      example: 2 %s\n", h->word, each,
              h->word, factor, ves_dim_plain(dim) ? "" : " ", ves_dim_plain(dim) ? "" : text, h->word);
}

static void function_help(help *h)
{
    for (int k = 0; ves_function_at(k); k++) {
        const ves_function *f = ves_function_at(k);
        if (!is_word(h, f->name)) continue;
        heading(h);
        ves_write(&h->writer, "%s: a function of formulas\n      %s\n", f->name, f->about);
    }
}

static void material_help(help *h)
{
    for (const ves_material *m = ves_materials(); m->name; m++) {
        if (!is_word(h, m->name)) continue;
        heading(h);
        ves_write(&h->writer,
                  "%s: a material of shells\n      %s\n      E = %.12g GPa, nu = %.12g, density = %.12g "
                  "kg/m^3, yield = %.12g MPa\n      %s\n      example: shell: {material: {like: %s, E: %.12g "
                  "GPa}}\n",
                  m->name, m->about, m->E * 1e-9, m->nu, m->density, m->yield * 1e-6, m->source, m->name,
                  m->E * 1e-9);
    }
}

/* FOLDED, folded, VES_FOLDED, or its sentence. */
static void status_help(help *h)
{
#define STATUS(name, value, sentence) {#name, sentence, value},
    static const struct {
        const char *name, *sentence;
        int value;
    } list[] = {VES_STATUS_LIST(STATUS)};
#undef STATUS
    const char *word = strncmp(h->word, "VES_", 4) ? h->word : h->word + 4;
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        if (list[k].value == VES_OK) continue;
        if (!is_word(h, list[k].name) && strcasecmp(word, list[k].name) && strcmp(word, list[k].sentence))
            continue;
        heading(h);
        ves_write(&h->writer, "%s: %s\n      %s\n", list[k].name,
                  list[k].value > 0 ? "why a candidate could not be measured, or was refused"
                                    : "why a command failed",
                  list[k].sentence);
        const char *advice = ves_describe_status((ves_status)list[k].value);
        if (*advice) ves_write(&h->writer, "      %s\n", advice);
    }
}

static void topic_help(help *h, const ves_topic *more)
{
    for (; more && more->word; more++)
        if (is_word(h, more->word)) {
            heading(h);
            ves_write(&h->writer, "%s: %s\n", more->word, more->text);
        }
    static const struct {
        const char *word, *text;
    } topic[] = {{"formula", ves_describe_formulas},
                 {"formulas", ves_describe_formulas},
                 {"names", ves_describe_names}};
    for (size_t k = 0; k < sizeof topic / sizeof *topic; k++)
        if (is_word(h, topic[k].word)) {
            heading(h);
            ves_write(&h->writer, "%s\n%s", topic[k].word, topic[k].text);
        }
    for (const ves_term *t = ves_describe_terms; t->word; t++)
        if (is_word(h, t->word)) {
            heading(h);
            ves_write(&h->writer, "%s: %s\n      %s\n      example: %s\n", t->word, t->what, t->about,
                      t->example);
        }
}

/* What was meant: a word near to all of it or, of a path, near to its last part. */
static void suggest(help *h, const char *word)
{
    const char *dot = strrchr(word, '.'), *part = dot ? dot + 1 : word;
    int near = strlen(word) < 64 ? ves_text_nearest(word, h->candidate, h->candidates) : -1;
    if (near < 0 && dot && strlen(part) < 64) near = ves_text_nearest(part, h->candidate, h->candidates);
    if (h->keys.length) {
        ves_write(&h->writer, "\"%.80s\" has no \"%.80s\": it has %s\n", h->parent, part, h->keys.text);
        return;
    }
    ves_write(&h->writer, "nothing is known about \"%.80s\"", word);
    if (near >= 0)
        ves_write(&h->writer, ", did you mean \"%s\"?", h->candidate[near]);
    else
        ves_write(&h->writer, " (vesica list; vesica schema --reference has all words)");
    ves_write(&h->writer, "\n");
}

char *ves_schema_explain(ves_arena *arena, const char *word, const ves_measure *const *plugin,
                         const ves_topic *more, bool *found)
{
    help *h = ves_memory_take(sizeof *h);
    if (!h) return NULL;
    const char *dot = strrchr(word, '.');
    h->word = word;
    h->parent = dot && dot > word ? ves_arena_text(arena, word, (size_t)(dot - word)) : NULL;
    h->plugin = plugin;
    walk(h, ves_schema_root.table, "");
    walk(h, ves_schema_suite.table, "suite");
    curve_help(h);
    measure_help(h);
    algorithm_help(h);
    choice_help(h);
    unit_help(h);
    function_help(h);
    material_help(h);
    status_help(h);
    topic_help(h, more);
    *found = h->found;
    if (!h->found) suggest(h, word);
    h->writer.failed = h->writer.failed || h->keys.failed || (dot && dot > word && !h->parent);
    ves_memory_free(h->keys.text);
    char *text = ves_writer_finish(&h->writer, arena);
    ves_memory_free(h);
    return text;
}
