#include "problem/tree.h"

#include <stdlib.h>
#include <string.h>
#include <yaml.h>

struct anchor;

typedef struct level {
    ves_node *node;
    int first; /* of its children among the pending */
    struct anchor *anchor;
} level;

enum { ANCHORS = 1000 };

typedef struct anchor {
    const char *name;
    const ves_node *node;
    bool open; /* its end has not come yet */
    struct anchor *next;
} anchor;

typedef struct builder {
    const ves_script *script;
    ves_arena *arena;
    ves_diag *diag;
    ves_status status;
    yaml_parser_t parser;
    size_t byte, character; /* libyaml counts characters; the two go forward together */
    ves_node **pending;
    int pendings, room, depth, documents, nodes, names;
    bool stop; /* no use in going on */
    level open[VES_TREE_DEPTH];
    anchor *anchors;
    const ves_node *root;
} builder;

static void fail(builder *b, ves_status status, size_t at, size_t length, const char *text)
{
    b->stop = true;
    b->status = status;
    if (status != VES_MEMORY)
        ves_diag_add(b->diag, VES_ERROR, status, ves_script_mark(b->script, at, length), "%s", text);
}

static bool continues(char c)
{
    return ((unsigned char)c & 0xC0) == 0x80;
}

/* Byte of libyaml's character number. */
static size_t byte_at(builder *b, size_t character)
{
    if (character < b->character) b->byte = b->character = 0;
    while (b->character < character && b->byte < b->script->length) {
        b->byte++;
        while (b->byte < b->script->length && continues(b->script->text[b->byte])) b->byte++;
        b->character++;
    }
    return b->byte;
}

static void push(builder *b, ves_node *node)
{
    if (b->pendings == b->room) {
        int room = b->room ? 2 * b->room : 256;
        ves_node **more = ves_memory_grow(b->pending, (size_t)room * sizeof(ves_node *));
        if (!more) {
            fail(b, VES_MEMORY, 0, 0, "");
            return;
        }
        b->pending = more;
        b->room = room;
    }
    b->pending[b->pendings++] = node;
}

static ves_node *node_create(builder *b, ves_node_kind kind, const yaml_event_t *event)
{
    if (b->nodes++ == VES_TREE_NODES) {
        fail(b, VES_SYNTAX, byte_at(b, event->start_mark.index), 1, "too large: more than 300000 entries");
        return NULL;
    }
    ves_node *node = ves_arena_take(b->arena, 1, sizeof *node);
    if (!node) {
        fail(b, VES_MEMORY, 0, 0, "");
        return NULL;
    }
    node->kind = kind;
    node->begin = node->token = byte_at(b, event->start_mark.index);
    node->end = node->token_end = byte_at(b, event->end_mark.index);
    node->exact = (size_t)-1;
    node->weight = 1;
    return node;
}

static anchor *anchor_add(builder *b, const yaml_char_t *name, const ves_node *node)
{
    if (!name) return NULL;
    if (b->names++ == ANCHORS) {
        fail(b, VES_SYNTAX, node->begin, 1, "too many anchors (&name): more than 1000");
        return NULL;
    }
    anchor *a = ves_arena_take(b->arena, 1, sizeof *a);
    char *copy = ves_arena_text(b->arena, (const char *)name, strlen((const char *)name));
    if (!a || !copy) {
        fail(b, VES_MEMORY, 0, 0, "");
        return NULL;
    }
    *a = (anchor){copy, node, node->kind != VES_NODE_WORD, b->anchors};
    b->anchors = a;
    return a;
}

/* Where the text of a word stands in the script, counted from the end, since an anchor or a tag may come
 * before it. */
static void find_exact(builder *b, ves_node *node, size_t length)
{
    size_t quote = node->plain ? 0 : 1;
    if (node->end < node->begin + length + quote) return;
    size_t at = node->end - quote - length;
    if (!memcmp(b->script->text + at, node->text, length)) node->exact = at;
    if (node->exact != (size_t)-1) node->begin = node->exact - quote;
}

static void word(builder *b, const yaml_event_t *event)
{
    ves_node *node = node_create(b, VES_NODE_WORD, event);
    if (!node) return;
    const char *value = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    bool block = event->data.scalar.style == YAML_LITERAL_SCALAR_STYLE ||
                 event->data.scalar.style == YAML_FOLDED_SCALAR_STYLE;
    node->plain = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    node->text = ves_arena_text(b->arena, value, length);
    if (!node->text) {
        fail(b, VES_MEMORY, 0, 0, "");
        return;
    }
    if (strlen(node->text) != length)
        fail(b, VES_SYNTAX, node->begin, 1, "a text must not contain a zero byte");
    if (event->data.scalar.tag)
        fail(b, VES_SYNTAX, node->begin, 1, "tags (!) have no meaning in a problem file");
    if (!block) find_exact(b, node, length);
    anchor_add(b, event->data.scalar.anchor, node);
    push(b, node);
}

static void alias(builder *b, const yaml_event_t *event)
{
    ves_node *node = node_create(b, VES_NODE_WORD, event);
    if (!node) return;
    size_t token = node->token, token_end = node->token_end;
    const char *name = (const char *)event->data.alias.anchor;
    for (const anchor *a = b->anchors; a; a = a->next) {
        if (strcmp(a->name, name)) continue;
        if (a->open) {
            fail(b, VES_SYNTAX, token, token_end - token, "this alias lies inside what it stands for");
            return;
        }
        *node = *a->node;
        node->alias = true;
        node->token = token;
        node->token_end = token_end;
        push(b, node);
        return;
    }
    fail(b, VES_SYNTAX, token, token_end - token, "no anchor (&name) of this name comes before");
}

static void begin(builder *b, ves_node_kind kind, const yaml_event_t *event)
{
    bool list = kind == VES_NODE_LIST;
    ves_node *node = node_create(b, kind, event);
    if (!node) return;
    if (b->depth == VES_TREE_DEPTH) {
        fail(b, VES_SYNTAX, node->begin, 1, "nested too deeply: at most 64 levels");
        return;
    }
    node->flow = list ? event->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE
                      : event->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE;
    if (list ? event->data.sequence_start.tag != NULL : event->data.mapping_start.tag != NULL)
        fail(b, VES_SYNTAX, node->begin, 1, "tags (!) have no meaning in a problem file");
    anchor *a =
        anchor_add(b, list ? event->data.sequence_start.anchor : event->data.mapping_start.anchor, node);
    if (!b->stop) b->open[b->depth++] = (level){node, b->pendings, a};
}

static int by_text(const void *a, const void *b)
{
    const ves_node *x = *(const ves_node *const *)a, *y = *(const ves_node *const *)b;
    int order = strcmp(x->text, y->text);
    return order ? order : (x->begin > y->begin) - (x->begin < y->begin);
}

/* Pairs first, then those whose key was given before, both in the order of the file. */
static void put_aside(builder *b, ves_node *map)
{
    const ves_node **key = ves_arena_take(b->arena, (size_t)map->count, sizeof *key);
    const ves_node **item = ves_arena_take(b->arena, (size_t)map->count, sizeof *item);
    int count = 0, all = map->count;
    if (!key || !item) {
        fail(b, VES_MEMORY, 0, 0, "");
        return;
    }
    for (int repeat = 0; repeat < 2; repeat++) {
        for (int k = 0; k < all; k++)
            if (map->key[k]->repeat == repeat) key[count] = map->key[k], item[count++] = map->item[k];
        if (!repeat) map->count = count;
    }
    map->repeats = all - map->count;
    map->key = key;
    map->item = item;
}

static void find_repeats(builder *b, ves_node *map)
{
    const ves_node **sorted = ves_arena_take(b->arena, (size_t)map->count, sizeof(ves_node *));
    if (!sorted) {
        fail(b, VES_MEMORY, 0, 0, "");
        return;
    }
    if (map->count) memcpy(sorted, map->key, (size_t)map->count * sizeof(ves_node *));
    qsort(sorted, (size_t)map->count, sizeof(ves_node *), by_text);
    bool any = false;
    for (int k = 1; k < map->count; k++) {
        if (strcmp(sorted[k - 1]->text, sorted[k]->text)) continue;
        ((ves_node *)sorted[k])->repeat = any = true;
    }
    if (any) put_aside(b, map);
}

/* YAML's merge key: `<<: *other` brings in the pairs of other that are not given here. */
static void merge(builder *b, ves_node *map)
{
    int at = 0;
    while (at < map->count && !(map->key[at]->plain && !strcmp(map->key[at]->text, "<<"))) at++;
    if (at == map->count) return;
    const ves_node *other = map->item[at];
    if (other->kind != VES_NODE_MAP) {
        fail(b, VES_SYNTAX, map->key[at]->begin, 2, "<< brings in another mapping, as in <<: *name");
        return;
    }
    int room = map->count - 1 + other->count + map->repeats, count = 0;
    const ves_node **key = ves_arena_take(b->arena, (size_t)room, sizeof *key);
    const ves_node **item = ves_arena_take(b->arena, (size_t)room, sizeof *item);
    if (!key || !item) {
        fail(b, VES_MEMORY, 0, 0, "");
        return;
    }
    for (int k = 0; k < map->count; k++)
        if (k != at) key[count] = map->key[k], item[count++] = map->item[k];
    int own = count;
    for (int k = 0; k < other->count; k++) {
        bool given = false;
        for (int i = 0; i < own && !given; i++) given = !strcmp(key[i]->text, other->key[k]->text);
        if (!given) key[count] = other->key[k], item[count++] = other->item[k];
    }
    for (int k = 0; k < map->repeats; k++)
        key[count + k] = map->key[map->count + k], item[count + k] = map->item[map->count + k];
    map->key = key;
    map->item = item;
    map->count = count;
}

static bool fill(builder *b, ves_node *node, int first)
{
    int children = b->pendings - first, step = node->kind == VES_NODE_MAP ? 2 : 1;
    node->count = children / step;
    node->item = ves_arena_take(b->arena, (size_t)node->count, sizeof *node->item);
    node->key = step == 2 ? ves_arena_take(b->arena, (size_t)node->count, sizeof *node->key) : NULL;
    if (!node->item || (step == 2 && !node->key)) {
        fail(b, VES_MEMORY, 0, 0, "");
        return false;
    }
    for (int k = 0; k < children; k++) {
        ves_node *child = b->pending[first + k];
        if (step == 2 && k % 2 == 0)
            node->key[k / 2] = child;
        else
            node->item[k / step] = child;
        node->weight += child->weight;
        if (step == 2 && k % 2 == 0 && child->kind != VES_NODE_WORD) {
            fail(b, VES_SYNTAX, child->begin, 1, "a key must be a word");
            return false;
        }
        if (node->weight > VES_TREE_NODES) {
            fail(b, VES_SYNTAX, node->begin, 1,
                 "too large: more than 300000 entries, aliases counted each time");
            return false;
        }
    }
    return true;
}

static void end(builder *b, const yaml_event_t *event)
{
    level l = b->open[--b->depth];
    l.node->end = l.node->token_end = byte_at(b, event->end_mark.index);
    if (l.anchor) l.anchor->open = false;
    if (!fill(b, l.node, l.first)) return;
    b->pendings = l.first;
    if (l.node->kind == VES_NODE_MAP) {
        find_repeats(b, l.node);
        merge(b, l.node);
    }
    push(b, l.node);
}

/* Takes one event in; false: the last one, or no use in going on. */
static bool take(builder *b, const yaml_event_t *event)
{
    switch (event->type) {
    case YAML_DOCUMENT_START_EVENT:
        if (b->documents++)
            fail(b, VES_SYNTAX, byte_at(b, event->start_mark.index), 3,
                 "a second document begins here; a file holds one problem");
        break;
    case YAML_SCALAR_EVENT:
        word(b, event);
        break;
    case YAML_ALIAS_EVENT:
        alias(b, event);
        break;
    case YAML_SEQUENCE_START_EVENT:
        begin(b, VES_NODE_LIST, event);
        break;
    case YAML_MAPPING_START_EVENT:
        begin(b, VES_NODE_MAP, event);
        break;
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
        end(b, event);
        break;
    case YAML_DOCUMENT_END_EVENT:
        if (b->pendings) b->root = b->pending[0];
        b->pendings = 0;
        break;
    case YAML_STREAM_END_EVENT:
        return false;
    default:
        break;
    }
    return !b->stop;
}

/* The reader stumbles over bytes, the scanner over characters. */
static void yaml_failed(builder *b)
{
    const yaml_parser_t *p = &b->parser;
    const char *problem = p->problem ? p->problem : "cannot be read";
    if (p->error == YAML_MEMORY_ERROR) {
        fail(b, VES_MEMORY, 0, 0, "");
        return;
    }
    b->status = VES_SYNTAX;
    if (p->error == YAML_READER_ERROR) {
        size_t at = p->problem_offset < b->script->length ? p->problem_offset : b->script->length;
        unsigned byte = at < b->script->length ? (unsigned char)b->script->text[at] : 0;
        ves_diag_add(b->diag, VES_ERROR, VES_SYNTAX, ves_script_mark(b->script, at, 1),
                     "byte 0x%02X has no place in a text (UTF-8): %s", byte, problem);
        return;
    }
    size_t at = byte_at(b, p->problem_mark.index);
    bool tab = at < b->script->length && b->script->text[at] == '\t';
    ves_diag_add(b->diag, VES_ERROR, VES_SYNTAX, ves_script_mark(b->script, at, 1), "not YAML: %s%s%s%s",
                 problem, p->context ? " " : "", p->context ? p->context : "",
                 tab ? "; indent with spaces, not tabs" : "");
    if (p->context && p->context_mark.index < p->problem_mark.index)
        ves_diag_add(b->diag, VES_NOTE, VES_SYNTAX,
                     ves_script_mark(b->script, byte_at(b, p->context_mark.index), 1), "it began here");
}

static void run(builder *b)
{
    yaml_event_t event;
    for (bool more = true; more;) {
        if (!yaml_parser_parse(&b->parser, &event)) {
            yaml_failed(b);
            return;
        }
        more = take(b, &event);
        yaml_event_delete(&event);
    }
}

ves_status ves_tree_read(const ves_script *script, ves_arena *arena, const ves_node **root, ves_diag *diag)
{
    *root = NULL;
    builder *b = ves_memory_take(sizeof *b);
    if (!b) return VES_MEMORY;
    b->script = script;
    b->arena = arena;
    b->diag = diag;
    if (yaml_parser_initialize(&b->parser)) {
        yaml_parser_set_encoding(&b->parser, YAML_UTF8_ENCODING);
        yaml_parser_set_input_string(&b->parser, (const unsigned char *)script->text, script->length);
        run(b);
        yaml_parser_delete(&b->parser);
    } else {
        b->status = VES_MEMORY;
    }
    ves_status status = b->status;
    if (status == VES_OK) *root = b->root;
    ves_memory_free(b->pending);
    ves_memory_free(b);
    return status;
}

ves_mark ves_node_mark(const ves_script *script, const ves_node *node)
{
    size_t begin = node->begin, length = node->end > begin ? node->end - begin : 0;
    if (node->alias) begin = node->token, length = node->token_end - begin;
    const char *newline = memchr(script->text + begin, '\n', length);
    if (newline) length = node->kind == VES_NODE_WORD ? (size_t)(newline - script->text) - begin : 1;
    return ves_script_mark(script, begin, length);
}

const ves_node *ves_node_find(const ves_node *map, const char *key)
{
    for (int k = 0; map && map->kind == VES_NODE_MAP && k < map->count; k++)
        if (!strcmp(map->key[k]->text, key)) return map->item[k];
    return NULL;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static bool has_word(const char *text, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        if ((at == text || !is_letter(at[-1])) && !is_letter(at[length])) return true;
    return false;
}

bool ves_node_mentions(const ves_node *node, const char *word)
{
    if (node->kind == VES_NODE_WORD) return has_word(node->text, word);
    for (int k = 0; k < node->count + node->repeats; k++)
        if (ves_node_mentions(node->item[k], word)) return true;
    return false;
}
