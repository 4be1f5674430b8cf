/* vary: {d1: [T, R, D]} declares the variables d1Tx ... d1Dz of the book and moves the curve by them. */
#include <string.h>

#include "problem/reader.h"

enum { LETTERS = 3, AXES = 3 };

static const char letters[] = "TRD", axes[] = "xyz";

/* [min, start, max]  [Ugail 2011, Table 7.2]; there d1Ty and d2Ty are one half of this, towards the inside. */
static const double book[LETTERS][3] = {{-1.2, 0, 1.2}, {-0.8, 0, 0.8}, {0.01, 1, 3}};

/* "T", "Ry": letter and axis (-1: all three). */
static bool parse(const char *text, int *letter, int *axis)
{
    const char *l = text[0] ? strchr(letters, text[0]) : NULL;
    if (!l) return false;
    *letter = (int)(l - letters);
    *axis = -1;
    if (!text[1]) return true;
    const char *a = strchr(axes, text[1]);
    if (a) *axis = (int)(a - axes);
    return a && !text[2];
}

int ves_vary_count(const ves_node *vary)
{
    return vary && vary->kind == VES_NODE_MAP ? vary->count * LETTERS * AXES : 0;
}

/* What one curve's entry says about one letter and axis. */
typedef struct wish {
    bool wanted;
    const ves_node *word, *range;
} wish;

static void want(ves_reader *reader, wish wishes[LETTERS][AXES], int letter, int axis, wish w)
{
    wish *one = &wishes[letter][axis];
    if (one->wanted)
        ves_reader_error(reader, VES_NAME, w.word, "%c%c is asked for twice", letters[letter], axes[axis]);
    else
        *one = w;
}

static bool letter_of(ves_reader *reader, const ves_node *word, int *letter, int *axis)
{
    if (word->kind == VES_NODE_WORD && parse(word->text, letter, axis)) return true;
    ves_reader_error(
        reader, VES_NAME, word,
        "expected T, R or D (translation, rotation, dilation), or one of them with an axis, as in Tx");
    return false;
}

/* T: [min, start, max], or T: {x: [...], z: [...]}. */
static void read_ranges(ves_reader *reader, const ves_node *word, const ves_node *value,
                        wish wishes[LETTERS][AXES])
{
    int letter, axis;
    if (!letter_of(reader, word, &letter, &axis)) return;
    if (value->kind != VES_NODE_MAP || axis >= 0) {
        for (int k = 0; k < AXES; k++)
            if (axis < 0 || axis == k) want(reader, wishes, letter, k, (wish){true, word, value});
        return;
    }
    for (int k = 0; k < value->count; k++) {
        const char *name = value->key[k]->text, *a = *name ? strchr(axes, *name) : NULL;
        if (a && !name[1])
            want(reader, wishes, letter, (int)(a - axes), (wish){true, value->key[k], value->item[k]});
        else
            ves_reader_error(reader, VES_NAME, value->key[k], "expected x, y or z, found \"%.80s\"", name);
    }
}

static void read_entry(ves_reader *reader, const ves_node *entry, wish wishes[LETTERS][AXES])
{
    const ves_node *const single[1] = {entry};
    if (entry->kind == VES_NODE_MAP) {
        for (int k = 0; k < entry->count; k++) read_ranges(reader, entry->key[k], entry->item[k], wishes);
        return;
    }
    bool list = entry->kind == VES_NODE_LIST;
    for (int k = 0; k < (list ? entry->count : 1); k++) {
        const ves_node *word = list ? entry->item[k] : single[0];
        int letter, axis;
        if (!letter_of(reader, word, &letter, &axis)) continue;
        for (int a = 0; a < AXES; a++)
            if (axis < 0 || axis == a) want(reader, wishes, letter, a, (wish){true, word, NULL});
    }
}

static void declare(ves_reader *reader, const char *curve, wish wishes[LETTERS][AXES], ves_declared *variable,
                    int *count)
{
    for (int l = 0; l < LETTERS; l++)
        for (int a = 0; a < AXES; a++) {
            if (!wishes[l][a].wanted) continue;
            const char *name = ves_arena_format(reader->arena, "%s%c%c", curve, letters[l], axes[a]);
            if (!ves_reader_memory(reader, name)) return;
            variable[(*count)++] = (ves_declared){name, wishes[l][a].word, wishes[l][a].range, book[l]};
        }
}

void ves_vary_read(ves_reader *reader, const ves_node *vary, ves_declared *variable, int *count)
{
    if (vary && vary->kind != VES_NODE_MAP)
        ves_reader_error(reader, VES_SYNTAX, vary, "\"vary\" must be a mapping {curve: [T, R, D], ...}");
    for (int k = 0; vary && vary->kind == VES_NODE_MAP && k < vary->count; k++) {
        wish wishes[LETTERS][AXES] = {0};
        if (!ves_names_ask(reader, &reader->curves, vary->key[k])) continue;
        read_entry(reader, vary->item[k], wishes);
        declare(reader, vary->key[k]->text, wishes, variable, count);
    }
}

static ves_node *make(ves_reader *reader, ves_node_kind kind, const ves_node *place, int count)
{
    ves_node *node = ves_arena_take(reader->arena, 1, sizeof *node);
    if (!ves_reader_memory(reader, node)) return NULL;
    *node = *place; /* errors point at the entry of vary */
    node->kind = kind;
    node->plain = true;
    node->exact = (size_t)-1;
    node->count = count;
    node->key = ves_arena_take(reader->arena, (size_t)count, sizeof *node->key);
    node->item = ves_arena_take(reader->arena, (size_t)count, sizeof *node->item);
    return ves_reader_memory(reader, node->key) && ves_reader_memory(reader, node->item) ? node : NULL;
}

static const ves_node *make_word(ves_reader *reader, const ves_node *place, const char *text)
{
    ves_node *node = make(reader, VES_NODE_WORD, place, 0);
    if (node) node->text = text;
    return ves_reader_memory(reader, text) ? node : NULL;
}

static const ves_node *make_map(ves_reader *reader, const ves_node *place, const char *const key[],
                                const ves_node *const item[], int count)
{
    ves_node *map = make(reader, VES_NODE_MAP, place, count);
    for (int k = 0; map && k < count; k++) {
        map->key[k] = make_word(reader, place, key[k]);
        map->item[k] = item[k];
        if (!map->key[k] || !map->item[k]) return NULL;
    }
    return map;
}

/* {dilate: {by: [d1Dx, 1, d1Dz], about: centre}} */
static const ves_node *move(ves_reader *reader, const ves_node *place, const char *curve, int letter,
                            wish wishes[LETTERS][AXES])
{
    static const char *const word[LETTERS] = {"translate", "rotate", "dilate"};
    ves_node *by = make(reader, VES_NODE_LIST, place, AXES);
    if (!by) return NULL;
    for (int a = 0; a < AXES; a++) {
        const char *text = letters[letter] == 'D' ? "1" : "0";
        if (wishes[letter][a].wanted)
            text = ves_arena_format(reader->arena, "%s%c%c", curve, letters[letter], axes[a]);
        by->item[a] = make_word(reader, wishes[letter][a].wanted ? wishes[letter][a].word : place, text);
        if (!by->item[a]) return NULL;
    }
    const ves_node *item[2] = {by, make_word(reader, place, "centre")};
    const ves_node *args =
        make_map(reader, place, (const char *const[]){"by", "about"}, item, letter ? 2 : 1);
    return make_map(reader, place, &word[letter], &args, 1);
}

void ves_vary_moves(ves_reader *reader, const ves_node *vary, const ves_named *curve,
                    const ves_node *moves[3], int *count)
{
    static const int order[LETTERS] = {2, 1, 0}; /* dilate and rotate about the centre, then translate */
    *count = 0;
    const ves_node *entry = ves_node_find(vary, curve->text);
    if (!entry) return;
    wish wishes[LETTERS][AXES] = {0};
    read_entry(reader, entry, wishes);
    for (int k = 0; k < LETTERS; k++) {
        bool wanted = false, own = false;
        for (int a = 0; a < AXES; a++) {
            if (!wishes[order[k]][a].wanted) continue;
            const char *name =
                ves_arena_format(reader->arena, "%s%c%c", curve->text, letters[order[k]], axes[a]);
            if (!ves_reader_memory(reader, name)) return;
            wanted = true;
            own = own || ves_node_mentions(curve->value, name);
        }
        if (!wanted || own) continue;
        moves[*count] = move(reader, entry, curve->text, order[k], wishes);
        if (!moves[*count]) return;
        (*count)++;
    }
}
