/* Where on a shell something is: curves, edges and places, and what measures name of it. */
#include <string.h>

#include "problem/reader.h"

static const char *const edge_name[VES_EDGES] = {"u0", "u1", "v0", "v1"};

int ves_reader_shell_part(const ves_reader *reader, int patch)
{
    const ves_shell_def *shell = reader->shell;
    for (int k = 0; k < shell->parts; k++)
        if (shell->part[k].patch == patch) return k;
    return -1;
}

/* Does the end u = 0 or u = 1 lie on the curve? */
static bool ends_on(const ves_patch_def *patch, int end, int curve)
{
    for (int k = 0; k < patch->conditions; k++) {
        const ves_condition *c = &patch->condition[k];
        if (c->derivative == 0 && c->u == end && c->shares && c->share[0].curve == curve) return true;
    }
    return false;
}

/* The ends of all parts that lie on a curve. */
static bool find_ends(ves_reader *reader, const ves_node *node, ves_shell_at *at)
{
    const ves_shell_def *shell = reader->shell;
    ves_shell_edge *on = ves_arena_take(reader->arena, 2 * (size_t)shell->parts, sizeof *on);
    if (!ves_reader_memory(reader, on)) return false;
    at->kind = VES_AT_CURVE;
    at->index = ves_reader_curve(reader, node);
    at->on = on;
    if (at->index < 0) return false;
    for (int part = 0; part < shell->parts; part++)
        for (int end = 0; end < 2; end++)
            if (ends_on(&reader->problem->patch[shell->part[part].patch], end, at->index))
                on[at->edges++] = (ves_shell_edge){part, end};
    if (at->edges) at->part = on[0].part;
    if (!at->edges && reader->shell_known)
        ves_reader_error(reader, VES_NAME, node,
                         "no part of the shell ends on the curve \"%.80s\"; an edge is named as in %s.u1",
                         node->text, reader->patches.name[shell->part[0].patch].text);
    return at->edges;
}

static bool is_part(ves_reader *reader, const ves_node *node, int patch, int *part)
{
    *part = patch < 0 ? -1 : ves_reader_shell_part(reader, patch);
    if (*part < 0 && patch >= 0 && reader->shell_known)
        ves_reader_error(reader, VES_NAME, node, "patch \"%s\" is no part of the shell",
                         reader->patches.name[patch].text);
    return *part >= 0;
}

/* wall.v0; -1: the word is no edge. */
static int edge_of(const char *text)
{
    const char *dot = strrchr(text, '.');
    for (int k = 0; dot && k < VES_EDGES; k++)
        if (!strcmp(dot + 1, edge_name[k])) return k;
    return -1;
}

static bool read_edge(ves_reader *reader, const ves_node *node, ves_shell_at *at)
{
    ves_node word = *node;
    word.text = ves_arena_text(reader->arena, node->text, (size_t)(strrchr(node->text, '.') - node->text));
    ves_shell_edge *on = ves_arena_take(reader->arena, 1, sizeof *on);
    if (!ves_reader_memory(reader, word.text) || !ves_reader_memory(reader, on)) return false;
    const ves_named *patch = ves_names_ask(reader, &reader->patches, &word);
    if (!patch || !is_part(reader, node, patch->index, &at->part)) return false;
    at->kind = VES_AT_EDGE;
    at->index = patch->index;
    at->edge = edge_of(node->text);
    at->edges = 1;
    at->on = on;
    *on = (ves_shell_edge){at->part, at->edge};
    bool along = at->edge == VES_EDGE_V0 || at->edge == VES_EDGE_V1;
    if (!along || !reader->problem->patch[patch->index].periodic) return true;
    ves_reader_error(reader, VES_NAME, node, "\"%s\" closes in v: its edges are %s.u0 and %s.u1", patch->text,
                     patch->text, patch->text);
    return false;
}

static bool read_place(ves_reader *reader, const ves_node *node, int index, ves_shell_at *at)
{
    at->kind = VES_AT_PLACE;
    at->index = index;
    return is_part(reader, node, reader->problem->place[index].patch, &at->part);
}

/* Curves, places, and the edges of parts. */
static const char *suggestion(ves_reader *reader, const char *word)
{
    const ves_names *names[2] = {&reader->curves, &reader->places};
    int parts = reader->shell->parts, count = 0;
    const char **candidate = ves_arena_take(
        reader->arena, (size_t)(names[0]->count + names[1]->count + VES_EDGES * parts), sizeof *candidate);
    if (!ves_reader_memory(reader, candidate)) return "";
    for (int l = 0; l < 2; l++)
        for (int k = 0; k < names[l]->count; k++) candidate[count++] = names[l]->name[k].text;
    for (int k = 0; k < parts; k++)
        for (int e = 0; e < VES_EDGES; e++) {
            const ves_patch_def *patch = &reader->problem->patch[reader->shell->part[k].patch];
            if (e >= VES_EDGE_V0 && patch->periodic) continue;
            candidate[count] = ves_arena_format(reader->arena, "%s.%s", patch->name, edge_name[e]);
            if (!ves_reader_memory(reader, candidate[count++])) return "";
        }
    return ves_reader_suggestion(reader, word, candidate, count);
}

bool ves_reader_shell_at(ves_reader *reader, const ves_node *node, ves_shell_at *at)
{
    *at = (ves_shell_at){.mark = ves_reader_mark(reader, node), .index = -1, .part = -1};
    if (!ves_reader_word(reader, node, "curve, edge or place")) return false;
    at->text = node->text;
    const ves_named *place = ves_names_find(&reader->places, node->text);
    if (place) return read_place(reader, node, place->index, at);
    if (ves_names_find(&reader->curves, node->text)) return find_ends(reader, node, at);
    if (edge_of(node->text) >= 0) return read_edge(reader, node, at);
    if (ves_names_find(&reader->patches, node->text))
        ves_reader_error(reader, VES_NAME, node, "\"%s\" is a whole patch: name an edge of it, as in %s.u0",
                         node->text, node->text);
    else
        ves_reader_error(reader, VES_NAME, node, "no curve, edge or place \"%.80s\"%s", node->text,
                         suggestion(reader, node->text));
    return false;
}

int ves_reader_shell_place(ves_reader *reader, const ves_node *node)
{
    ves_shell_at at;
    ves_shell_def *shell = reader->shell;
    if (!shell || !ves_reader_shell_at(reader, node, &at)) return -1; /* no shell: the measure has said so */
    if (shell->ats == reader->at_room) {
        int room = reader->at_room ? 2 * reader->at_room : 8;
        ves_shell_at *more = ves_memory_grow(reader->at, (size_t)room * sizeof *more);
        if (!ves_reader_memory(reader, more)) return -1;
        reader->at = more;
        reader->at_room = room;
    }
    reader->at[shell->ats] = at;
    return shell->ats++;
}

bool ves_reader_of_shell(const ves_key *key)
{
    return key->kind == VES_CASE || key->kind == VES_SHELL_AT || key->kind == VES_SHELL_HELD;
}

bool ves_shell_at_meets(const ves_shell_at *a, const ves_shell_at *b)
{
    if (a->kind == VES_AT_PLACE || b->kind == VES_AT_PLACE) return a->kind == b->kind && a->index == b->index;
    for (int i = 0; i < a->edges; i++)
        for (int j = 0; j < b->edges; j++)
            if (a->on[i].part == b->on[j].part && a->on[i].edge == b->on[j].edge) return true;
    return false;
}

int ves_reader_shell_held(ves_reader *reader, const ves_node *node)
{
    int index = ves_reader_shell_place(reader, node);
    const ves_shell_def *shell = reader->shell;
    if (index < 0 || !reader->shell_known) return index;
    for (int k = 0; k < shell->supports; k++)
        if (ves_shell_at_meets(&reader->at[index], &shell->support[k].at)) return index;
    ves_reader_error(reader, VES_NAME, node,
                     "no support holds the shell at \"%.80s\": name what a support names", node->text);
    return -1;
}

int ves_reader_case(ves_reader *reader, const ves_node *node)
{
    const ves_named *found = reader->shell ? ves_names_ask(reader, &reader->cases, node) : NULL;
    return found ? found->index : -1;
}

int ves_reader_only_case(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    int count = reader->cases.count;
    if (count == 1) return 0;
    if (!reader->shell || !reader->shell_known || reader->cases_lost) return -1;
    if (count)
        ves_reader_error(
            reader, VES_NAME, node,
            "which load case? There are %d: give it a name under \"measures\", with \"%s\": %s, ...", count,
            key->name, reader->cases.name[0].text);
    else
        ves_reader_error(reader, VES_NAME, node,
                         "this needs a load case: shell: {cases: {NAME: [{at: ..., line: [...]}]}}");
    return -1;
}

void ves_reader_shell_finish(ves_reader *reader)
{
    ves_shell_def *shell = reader->shell;
    if (!shell || !shell->ats) return;
    ves_shell_at *at = ves_arena_take(reader->arena, (size_t)shell->ats, sizeof *at);
    if (!ves_reader_memory(reader, at)) return;
    memcpy(at, reader->at, (size_t)shell->ats * sizeof *at);
    shell->at = at;
}
