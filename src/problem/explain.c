/* Help on one word: all that the tables know about it. */
#include <string.h>

#include "base/text.h"
#include "formula/dimension.h"
#include "measure/registry.h"
#include "problem/describe.h"
#include "vesica/search.h"

enum { WORDS = 600, PATH = 200 };

typedef struct help {
    ves_writer writer;
    const char *word;
    const ves_measure *const *plugin;
    bool found;
    const char *candidate[WORDS]; /* all words there are */
    int candidates;
} help;

static bool is_word(help *h, const char *name)
{
    if (h->candidates < WORDS) h->candidate[h->candidates++] = name;
    return !strcmp(name, h->word);
}

/* Is the asked word the path, or the end of it after a dot? */
static bool is_path(const help *h, const char *path)
{
    size_t length = strlen(path), asked = strlen(h->word);
    if (asked > length || strcmp(path + length - asked, h->word)) return false;
    return asked == length || path[length - asked - 1] == '.';
}

static void heading(help *h)
{
    if (h->found) ves_write(&h->writer, "\n");
    h->found = true;
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
    if (entry->example) ves_write(w, "      example: %s\n", entry->example);
    const ves_entry *table = entry->table;
    bool item = (int)entry->key.kind == VES_LIST || (int)entry->key.kind == VES_NAMED;
    if (item && table)
        ves_write(w, "  each %s: %s\n      example: %s\n", table->key.name, table->key.about, table->example);
    if (item && table) table = table->table;
    for (const ves_entry *e = table; e && e->key.name; e++)
        if ((int)e->key.kind != VES_LATER) key_line(w, &e->key);
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
        if (is_path(h, inner)) entry_help(h, e, inner);
        bool item = (int)e->key.kind == VES_LIST || (int)e->key.kind == VES_NAMED;
        const ves_entry *below = item && e->table ? e->table->table : e->table;
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

static void curve_help(help *h)
{
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++)
        if (is_word(h, (*op)->name))
            operation_help(h, (*op)->move ? "a move of a curve" : "a curve kind", (*op)->name, (*op)->about,
                           (*op)->keys);
}

static void measure_help(help *h)
{
    const ves_measure *const *lists[2] = {ves_measures(), h->plugin};
    for (int l = 0; l < 2; l++)
        for (const ves_measure *const *m = lists[l]; m && *m; m++) {
            if (!is_word(h, (*m)->name)) continue;
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
    ves_write(&h->writer, "%s: a unit of %s\n      1 %s = %.17g%s%s\n      example: 2 %s\n", h->word, each,
              h->word, factor, ves_dim_plain(dim) ? "" : " ", ves_dim_plain(dim) ? "" : text, h->word);
}

static void topic_help(help *h)
{
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
}

char *ves_schema_explain(ves_arena *arena, const char *word, const ves_measure *const *plugin, bool *found)
{
    help *h = ves_memory_take(sizeof *h);
    if (!h) return NULL;
    h->word = word;
    h->plugin = plugin;
    walk(h, ves_schema_root.table, "");
    curve_help(h);
    measure_help(h);
    algorithm_help(h);
    unit_help(h);
    topic_help(h);
    *found = h->found;
    if (!h->found) {
        int near = strlen(word) < 64 ? ves_text_nearest(word, h->candidate, h->candidates) : -1;
        ves_write(&h->writer, "nothing is known about \"%.80s\"%s%s%s\n", word,
                  near < 0 ? "" : ", did you mean \"", near < 0 ? "" : h->candidate[near],
                  near < 0 ? "" : "\"?");
    }
    char *text = ves_writer_finish(&h->writer, arena);
    ves_memory_free(h);
    return text;
}
