/* A mapping against a table of keys: what is unknown, missing, or not in this version. */
#include <string.h>

#include "base/text.h"
#include "problem/reader.h"

enum { LISTED = 12 }; /* longer lists of known keys help nobody */

static bool later(const ves_key *key)
{
    return (int)key->kind == VES_LATER;
}

static ves_field *field_of(ves_fields *fields, const char *name)
{
    for (int k = 0; k < fields->count; k++)
        if (!strcmp(fields->field[k].key->name, name)) return &fields->field[k];
    return NULL;
}

const ves_field *ves_fields_field(const ves_fields *fields, const char *name)
{
    return field_of((ves_fields *)fields, name);
}

const ves_node *ves_fields_find(const ves_fields *fields, const char *name)
{
    const ves_field *field = field_of((ves_fields *)fields, name);
    return field ? field->node : NULL;
}

bool ves_fields_excused(const ves_fields *fields, const char *name)
{
    const ves_field *field = field_of((ves_fields *)fields, name);
    return field && field->excused;
}

/* The key that an unknown word was probably meant to be, or -1. */
static int meant(const ves_reader *reader, const ves_fields *fields, const char *word)
{
    const char *candidate[VES_KEYS];
    int index[VES_KEYS], count = 0;
    if (ves_reader_full(reader) || strlen(word) >= 64) return -1;
    for (int k = 0; k < fields->count; k++)
        if (!later(fields->field[k].key)) candidate[count] = fields->field[k].key->name, index[count++] = k;
    int near = ves_text_nearest(word, candidate, count);
    return near < 0 ? -1 : index[near];
}

/* "a:1" is one word to YAML, and so is "b)" of `{x: max(a, b)}`. */
static const char *surprise(const char *word)
{
    if (strchr(word, ')')) return "; a formula with commas must be quoted: \"max(a, b)\"";
    if (strchr(word, ':')) return "; a blank must follow the colon";
    return "";
}

static void list_keys(const ves_fields *fields, char *text, size_t size)
{
    size_t at = 0;
    text[0] = 0;
    for (int k = 0; k < fields->count; k++) {
        const char *name = fields->field[k].key->name;
        if (later(fields->field[k].key) || at + strlen(name) + 3 > size || fields->count > LISTED) continue;
        if (at) memcpy(text + at, ", ", 3), at += 2;
        memcpy(text + at, name, strlen(name) + 1);
        at += strlen(name);
    }
}

static void unknown(ves_reader *reader, ves_fields *fields, const ves_node *word, const char *what)
{
    int near = meant(reader, fields, word->text);
    char known[400];
    list_keys(fields, known, sizeof known);
    const char *hint = surprise(word->text);
    if (near >= 0) {
        fields->field[near].excused = true;
        ves_reader_error(reader, VES_NAME, word, "unknown key \"%.80s\" in \"%s\", did you mean \"%s\"?",
                         word->text, what, fields->field[near].key->name);
    } else {
        ves_reader_error(reader, VES_NAME, word, "unknown key \"%.80s\" in \"%s\"%s%s%s%s", word->text, what,
                         hint, *hint || !*known ? "" : " (known: ", *hint ? "" : known,
                         *hint || !*known ? "" : ")");
    }
}

static void match(ves_reader *reader, const ves_node *node, const char *what, ves_fields *fields)
{
    for (int k = 0; k < node->count; k++) {
        ves_field *field = field_of(fields, node->key[k]->text);
        if (!field)
            unknown(reader, fields, node->key[k], what);
        else if (later(field->key))
            ves_reader_error(reader, VES_ABSENT, node->key[k], "\"%s\" (%s) is not in this version yet",
                             field->key->name, field->key->about);
        else
            field->node = node->item[k], field->word = node->key[k];
    }
    for (int k = 0; k < fields->count; k++)
        if (fields->field[k].key->required && !fields->field[k].node && !fields->field[k].excused)
            ves_reader_error(reader, VES_NAME, node, "\"%s\" lacks the key \"%s\"", what,
                             fields->field[k].key->name);
}

static const char *form(const ves_node *node)
{
    if (node->kind == VES_NODE_LIST) return "a list";
    return node->kind == VES_NODE_MAP    ? "a mapping"
           : *node->text || !node->plain ? "a single value"
                                         : "nothing";
}

static bool is_map(ves_reader *reader, const ves_node *node, const ves_fields *fields, const char *what)
{
    if (node->kind == VES_NODE_MAP) return true;
    char known[400];
    list_keys(fields, known, sizeof known);
    ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be a mapping {key: value, ...}, found %s%s%s%s",
                     what, form(node), *known ? " (keys: " : "", known, *known ? ")" : "");
    return false;
}

void ves_fields_one_of(ves_reader *reader, const ves_node *node, const ves_fields *fields, const char *what,
                       const char *a, const char *b)
{
    if (ves_fields_find(fields, a) && ves_fields_find(fields, b))
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" has both \"%s\" and \"%s\": give one", what, a, b);
    else
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" needs one of \"%s\" and \"%s\"", what, a, b);
}

bool ves_fields_read(ves_reader *reader, const ves_node *node, const ves_entry *table, const char *what,
                     ves_fields *fields)
{
    fields->count = 0;
    for (const ves_entry *e = table; e->key.name && fields->count < VES_KEYS; e++)
        fields->field[fields->count++] = (ves_field){.key = &e->key};
    if (!is_map(reader, node, fields, what)) return false;
    match(reader, node, what, fields);
    return true;
}

/* An operation written without its keys answers its first one: {translate: [0, 0, 1]}. */
static bool brief(ves_fields *fields, const ves_node *node)
{
    if (node->kind == VES_NODE_MAP || !fields->count ||
        (node->kind == VES_NODE_WORD && node->plain && !*node->text))
        return false;
    fields->field[0].node = node;
    return true;
}

bool ves_fields_read_keys(ves_reader *reader, const ves_node *node, const ves_key *keys, const ves_key *extra,
                          const char *what, ves_fields *fields)
{
    fields->count = 0;
    for (const ves_key *key = keys; key && key->name && fields->count < VES_KEYS - 1; key++)
        fields->field[fields->count++] = (ves_field){.key = key};
    if (extra) fields->field[fields->count++] = (ves_field){.key = extra};
    if (brief(fields, node)) return true;
    if (node->kind == VES_NODE_WORD && node->plain && !*node->text) {
        const ves_node nothing = {.kind = VES_NODE_MAP, .begin = node->begin, .end = node->end};
        match(reader, &nothing, what, fields);
        return true;
    }
    if (!is_map(reader, node, fields, what)) return false;
    match(reader, node, what, fields);
    return true;
}
