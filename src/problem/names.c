/* The names of a section: curves, patches, places, measures. */
#include <string.h>

#include "problem/reader.h"

void ves_names_read(ves_reader *reader, const ves_node *section, const char *what, bool formulas,
                    ves_names *names)
{
    *names = (ves_names){.what = what};
    if (!section) return;
    if (section->kind != VES_NODE_MAP) {
        ves_reader_error(reader, VES_SYNTAX, section, "expected a mapping of names, one for each %s", what);
        return;
    }
    if (section->count > VES_NAMES) {
        ves_reader_error(reader, VES_RANGE, section, "more than %d names in one section", VES_NAMES);
        return;
    }
    names->name = ves_arena_take(reader->arena, (size_t)section->count, sizeof *names->name);
    if (!ves_reader_memory(reader, names->name)) return;
    for (int k = 0; k < section->count; k++) {
        const ves_node *word = section->key[k];
        if (!ves_reader_new_name(reader, word, what, formulas)) continue;
        names->name[names->count++] =
            (ves_named){.text = word->text, .word = word, .value = section->item[k], .index = -1};
    }
}

ves_named *ves_names_find(const ves_names *names, const char *text)
{
    for (int k = 0; k < names->count; k++)
        if (!strcmp(names->name[k].text, text)) return &names->name[k];
    return NULL;
}

static const char *nearest(ves_reader *reader, const ves_names *names, const char *text)
{
    const char **candidate = ves_arena_take(reader->arena, (size_t)names->count, sizeof *candidate);
    if (!candidate) return "";
    for (int k = 0; k < names->count; k++) candidate[k] = names->name[k].text;
    return ves_reader_suggestion(reader, text, candidate, names->count);
}

ves_named *ves_names_ask(ves_reader *reader, const ves_names *names, const ves_node *node)
{
    if (!ves_reader_word(reader, node, names->what)) return NULL;
    ves_named *found = ves_names_find(names, node->text);
    if (!found)
        ves_reader_error(reader, VES_NAME, node, "no %s \"%.80s\"%s", names->what, node->text,
                         nearest(reader, names, node->text));
    return found;
}
