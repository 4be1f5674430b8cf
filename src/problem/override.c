#include "problem/override.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "formula/dimension.h"
#include "problem/schema.h"

enum { WORD = 200, PATH = 32 };

typedef struct override {
    ves_script *script;
    ves_diag *diag;
    const char *option, *equals;        /* how the user has written it: "--set " name "=" value */
    const char *name, *value, *written; /* written: the value as it is put into the text */
    int source;
} override;

static ves_mark name_mark(const override *o)
{
    return (ves_mark){o->source, 1, (int)strlen(o->option) + 1, (int)strlen(o->name)};
}

static ves_mark value_mark(const override *o)
{
    int length = (int)strlen(o->value);
    size_t before = strlen(o->option) + strlen(o->name) + strlen(o->equals);
    return (ves_mark){o->source, 1, (int)before + 1, length ? length : 1};
}

/* Words with a meaning in YAML are quoted; what is in brackets is taken as it is. */
static const char *quoted(ves_arena *arena, const char *value)
{
    bool bracket = *value == '[' || *value == '{' || *value == '"' || *value == '\'';
    bool plain = *value && !strpbrk(value, ",[]{}#:&*!|>'\"%@`?") && !isspace((unsigned char)*value) &&
                 !(*value == '-' && value[1] == ' ') && !isspace((unsigned char)value[strlen(value) - 1]);
    if (bracket || plain) return value;
    size_t length = strlen(value), at = 0;
    char *text = ves_arena_take(arena, 2 * length + 3, 1);
    if (!text) return NULL;
    text[at++] = '\'';
    for (const char *c = value; *c; c++) {
        if (*c == '\'') text[at++] = '\'';
        text[at++] = *c;
    }
    text[at] = '\'';
    return text;
}

static ves_status write(const override *o, size_t begin, size_t end, const char *before, const char *after)
{
    char *text = ves_arena_format(o->script->arena, "%s%s%s", before, o->written, after);
    if (!text) return VES_MEMORY;
    bool added = o->written != o->value; /* an opening quote that is not in the override */
    ves_edit edit = {.begin = begin, .end = end, .value = strlen(before) + added, .source = o->source};
    edit.name_column = (int)strlen(o->option) + 1;
    edit.value_column = edit.name_column + (int)(strlen(o->name) + strlen(o->equals));
    return ves_script_replace(o->script, &edit, text);
}

/* The unit of a text that is one number with its unit. */
static bool unit_of(const ves_node *node, char unit[VES_UNIT_TEXT], double *factor, bool *angle)
{
    static const ves_dim none = {0};
    ves_dim dim;
    if (node->kind != VES_NODE_WORD) return false;
    *angle = ves_unit_find(node->text, none, unit, factor);
    const char *end = node->text + strspn(node->text, " +-.0123456789eE");
    return *angle ||
           (*end && strlen(end) < VES_UNIT_TEXT && ves_dim_read(end, &dim, factor) && strcpy(unit, end));
}

/* A plain number in the place of one with a unit: a slip where it is a length, a surprise where it is an
 * angle. like: what stood there, or next to it in the range. */
static ves_status check_unit(const override *o, const ves_node *like)
{
    char unit[VES_UNIT_TEXT];
    double value, factor;
    bool angle;
    if (!ves_text_number(o->value, &value) || value == 0 || !unit_of(like, unit, &factor, &angle))
        return VES_OK;
    if (!angle)
        return ves_diag_add(o->diag, VES_ERROR, VES_UNIT, value_mark(o),
                            "%s has no unit, where the file has \"%s\": write %s%s%s", o->value, like->text,
                            o->value, strchr(like->text, ' ') ? " " : "", unit);
    ves_diag_add(o->diag, VES_WARNING, VES_UNIT, value_mark(o),
                 "%s has no unit, where the file has \"%s\": taken as %.6g %s", o->value, like->text,
                 value / factor, unit);
    return VES_OK;
}

/* Replaces a value. One that spans lines in block style has no end that could be trusted. */
static ves_status replace(const override *o, const ves_node *node)
{
    if (node->kind != VES_NODE_WORD && !node->flow && !node->alias)
        return ves_diag_add(o->diag, VES_ERROR, VES_USAGE, name_mark(o),
                            "\"%s\" is written over several lines; set one of the values in it", o->name);
    bool empty = node->token == node->token_end;
    VES_TRY(check_unit(o, node));
    return write(o, node->token, node->token_end, empty ? " " : "", "");
}

static int indentation(const ves_script *script, size_t at)
{
    size_t begin = at;
    while (begin > 0 && script->text[begin - 1] != '\n') begin--;
    return (int)(at - begin);
}

/* Adds a key before the first one of a mapping; inner and inner_end go around the value. */
static ves_status add(const override *o, const ves_node *map, const char *key, const char *inner,
                      const char *inner_end)
{
    size_t at = map->count ? map->key[0]->token : map->begin + 1;
    ves_arena *arena = o->script->arena;
    char *before = ves_arena_format(arena, "%s: %s", key, inner);
    char *after = map->flow ? ves_arena_format(arena, "%s%s", inner_end, map->count ? ", " : "")
                            : ves_arena_format(arena, "%s\n%*s", inner_end, indentation(o->script, at), "");
    if (!before || !after) return VES_MEMORY;
    return write(o, at, at, before, after);
}

static ves_status not_found(const override *o, const ves_node *node, const char *word)
{
    const char *candidate[WORD], *near = "", *end = "";
    int count = 0;
    for (int k = 0; node->kind == VES_NODE_MAP && k < node->count && count < WORD; k++)
        candidate[count++] = node->key[k]->text;
    int best = count ? ves_text_nearest(word, candidate, count) : -1;
    if (best >= 0) near = candidate[best], end = "\"?";
    return ves_diag_add(o->diag, VES_ERROR, VES_NAME, name_mark(o), "the file has no \"%s\"%s%s%s", o->name,
                        best >= 0 ? ", did you mean \"" : "", near, end);
}

static const ves_node *child(const ves_node *node, const char *word)
{
    if (node->kind == VES_NODE_MAP) return ves_node_find(node, word);
    if (node->kind == VES_NODE_WORD || !isdigit((unsigned char)*word) || strlen(word) > 6 ||
        word[strspn(word, "0123456789")])
        return NULL;
    int index = atoi(word);
    return index < node->count ? node->item[index] : NULL;
}

/* The entry of the schema for a key, below that of what the key stands in; NULL: there is none, or names that
 * the file gives come in between. */
static const ves_entry *below(const ves_entry *entry, const char *word)
{
    return entry && (int)entry->key.kind == VES_MAP ? ves_schema_find(entry->table, word) : NULL;
}

static bool is_nothing(const ves_node *node)
{
    return node->kind == VES_NODE_WORD && node->plain && !*node->text;
}

/* What is left of a path, a.b.c, as the mapping that the file lacks: before the value "{b: {c: ", after it
 * "}}". False: only the last word may be one that the schema does not know as a mapping; or no memory. */
static bool nest(const override *o, const ves_entry *entry, const char *rest, char **inner, char **inner_end)
{
    ves_arena *arena = o->script->arena;
    *inner = *inner_end = ves_arena_format(arena, "%s", "");
    for (; rest && *inner && *inner_end; rest = strchr(rest, '.') ? strchr(rest, '.') + 1 : NULL) {
        int length = (int)strcspn(rest, ".");
        char *word = ves_arena_text(arena, rest, (size_t)length);
        int kind = entry ? (int)entry->key.kind : 0;
        if (!word || !*word || (kind != VES_MAP && !(kind == VES_NAMED && !rest[length]))) return false;
        *inner = ves_arena_format(arena, "%s{%s: ", *inner, word);
        *inner_end = ves_arena_format(arena, "%s}", *inner_end);
        entry = below(entry, word);
    }
    return *inner && *inner_end;
}

/* Where the path leaves the file: word is not in node (entry its schema), and rest comes behind it. */
static ves_status set_new(const override *o, const ves_node *node, const ves_entry *entry, const char *word,
                          const char *rest)
{
    char *inner, *inner_end;
    bool deep = nest(o, below(entry, word), rest, &inner, &inner_end);
    if (!inner || !inner_end) return VES_MEMORY;
    if (!*word || !strchr(o->name, '.') || (rest && !deep)) return not_found(o, node, word);
    if (node->kind == VES_NODE_MAP) return add(o, node, word, inner, inner_end);
    if (!is_nothing(node) || node->alias || !entry) return not_found(o, node, word);
    char *before = ves_arena_format(o->script->arena, " {%s: %s", word, inner);
    char *after = ves_arena_format(o->script->arena, "%s}", inner_end);
    return before && after ? write(o, node->token, node->token_end, before, after) : VES_MEMORY;
}

/* patches.wall.operator.a: down to the value. The last word may be a new key, and sections that the file does
 * not have are made. */
static ves_status set_path(const override *o, const ves_node *root)
{
    char *path = ves_arena_text(o->script->arena, o->name, strlen(o->name));
    if (!path) return VES_MEMORY;
    const ves_node *node = root;
    const ves_entry *entry = ves_node_find(root, "suite") ? &ves_schema_suite : &ves_schema_root;
    for (int depth = 0; depth < PATH; depth++) {
        char *dot = strchr(path, '.');
        if (dot) *dot = 0;
        const ves_node *next = child(node, path);
        if (node->alias && depth)
            return ves_diag_add(o->diag, VES_ERROR, VES_USAGE, name_mark(o),
                                "\"%s\" lies in what *name stands for; set it where it is written", o->name);
        if (!next) return set_new(o, node, entry, path, dot ? dot + 1 : NULL);
        if (!dot) return replace(o, next);
        entry = below(entry, path);
        node = next;
        path = dot + 1;
    }
    return not_found(o, node, o->name);
}

/* d1Tx: a variable that vary declares, written as curve, letter, axis. */
static bool declared(const ves_node *root, const char *name)
{
    const ves_node *vary = ves_node_find(root, "vary");
    size_t length = strlen(name);
    if (!vary || vary->kind != VES_NODE_MAP || length < 3 || !strchr("TRD", name[length - 2]) ||
        !strchr("xyz", name[length - 1]))
        return false;
    for (int k = 0; k < vary->count; k++) {
        const char *curve = vary->key[k]->text;
        if (strlen(curve) == length - 2 && !strncmp(curve, name, length - 2)) return true;
    }
    return false;
}

static ves_status set_start(const override *o, const ves_node *root)
{
    const ves_node *start = ves_node_find(root, "start"), *old = ves_node_find(start, o->name);
    if (old) return replace(o, old);
    if (start && start->kind == VES_NODE_MAP) return add(o, start, o->name, "", "");
    char *inner = ves_arena_format(o->script->arena, "{%s: ", o->name);
    return inner ? add(o, root, "start", inner, "}") : VES_MEMORY;
}

static ves_status set_variable(const override *o, const ves_node *root, const ves_node *range)
{
    if (ves_node_find(ves_node_find(root, "start"), o->name)) return set_start(o, root);
    bool triple = range->kind == VES_NODE_LIST && range->count == 3;
    if (!triple || *o->value == '[') return replace(o, range);
    const ves_node *old = range->item[1];
    if (old->kind == VES_NODE_WORD && !strcmp(old->text, "0"))
        VES_TRY(check_unit(o, range->item[2])); /* it has none */
    return replace(o, old);
}

/* Can an unknown name be a new key of the file itself: --set seed=3? The reader knows which keys there are. */
static ves_status set_name(const override *o, const ves_node *root)
{
    static const char new_keys[] = "title|modes|minimize|maximize|search|seed|quadrature|expect|constraints";
    const ves_node *range = ves_node_find(ves_node_find(root, "variables"), o->name),
                   *parameter = ves_node_find(ves_node_find(root, "parameters"), o->name),
                   *key = ves_node_find(root, o->name);
    if (range) return set_variable(o, root, range);
    if (parameter) return replace(o, parameter);
    if (declared(root, o->name)) return set_start(o, root);
    if (key) return replace(o, key);
    if (ves_words_find(new_keys, o->name) >= 0) return add(o, root, o->name, "", "");
    if (ves_node_find(root, "suite") && ves_schema_find(ves_schema_suite.table, o->name))
        return add(o, root, o->name, "", "");
    const char *candidate[WORD];
    int count = 0;
    static const char *const sections[] = {"variables", "parameters"};
    for (int s = 0; s < 2; s++) {
        const ves_node *section = ves_node_find(root, sections[s]);
        for (int k = 0; section && section->kind == VES_NODE_MAP && k < section->count && count < WORD; k++)
            candidate[count++] = section->key[k]->text;
    }
    int near = count ? ves_text_nearest(o->name, candidate, count) : -1;
    return ves_diag_add(o->diag, VES_ERROR, VES_NAME, name_mark(o), "no variable or parameter \"%s\"%s%s%s",
                        o->name, near >= 0 ? ", did you mean \"" : "", near >= 0 ? candidate[near] : "",
                        near >= 0 ? "\"?" : "");
}

/* The value alone must be one value of YAML on one line, or it could change what stands around it. */
static ves_status check_value(const override *o)
{
    for (const char *c = o->value; *c; c++)
        if ((unsigned char)*c < 32)
            return ves_diag_add(o->diag, VES_ERROR, VES_USAGE, value_mark(o),
                                "a value must be one line of text");
    ves_script alone;
    const ves_node *node;
    VES_TRY(ves_script_init(&alone, o->written, strlen(o->written), o->script->arena));
    ves_status status = ves_tree_read(&alone, o->script->arena, &node, NULL);
    if (status == VES_MEMORY) return status;
    bool whole = status == VES_OK && node && node->token == 0 && node->token_end == strlen(o->written);
    if (whole && (node->kind == VES_NODE_WORD || node->flow)) return VES_OK;
    return ves_diag_add(o->diag, VES_ERROR, VES_USAGE, value_mark(o), "this is not one value of YAML");
}

static ves_status apply_one(override *o, const ves_node *root)
{
    char *shown = ves_arena_format(o->script->arena, "%s%s%s%s", o->option, o->name, o->equals, o->value);
    char *title = ves_arena_format(o->script->arena, "%s%s", o->option, o->name);
    if (!shown || !title) return VES_MEMORY;
    o->source = ves_diag_source(o->diag, title, shown, strlen(shown));
    o->written = quoted(o->script->arena, o->value);
    if (!o->written) return VES_MEMORY;
    if (!*o->name || strlen(o->name) > WORD)
        return ves_diag_add(o->diag, VES_ERROR, VES_USAGE, name_mark(o), "expected %sname%svalue", o->option,
                            o->equals);
    VES_TRY(check_value(o));
    return strchr(o->name, '.') ? set_path(o, root) : set_name(o, root);
}

ves_status ves_override_apply(ves_script *script, const ves_read_options *options, const ves_node **root,
                              ves_diag *diag)
{
    ves_status first = VES_OK;
    VES_TRY(ves_tree_read(script, script->arena, root, diag));
    int overrides = options ? options->overrides : 0;
    if (!*root || (*root)->kind != VES_NODE_MAP) return VES_OK; /* the reader will say so */
    for (int k = 0; k < overrides; k++) {
        override o = {script,
                      diag,
                      options->inner ? "set: " : "--set ",
                      options->inner ? ": " : "=",
                      options->override[k].name,
                      options->override[k].value,
                      NULL,
                      0};
        ves_status status = apply_one(&o, *root);
        if (status == VES_MEMORY) return status;
        if (first == VES_OK) first = status;
        if (status == VES_OK) VES_TRY(ves_tree_read(script, script->arena, root, diag));
    }
    return first;
}
