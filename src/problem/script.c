#include "problem/script.h"

#include <string.h>

ves_status ves_script_init(ves_script *script, const char *text, size_t length, ves_arena *arena)
{
    int lines = 1;
    for (size_t k = 0; k < length; k++) lines += text[k] == '\n';
    *script =
        (ves_script){.arena = arena, .given = text, .text = text, .given_length = length, .length = length};
    script->line = ves_arena_take(arena, (size_t)lines, sizeof *script->line);
    if (!script->line) return VES_MEMORY;
    script->lines = 1;
    for (size_t k = 0; k < length; k++)
        if (text[k] == '\n') script->line[script->lines++] = k + 1;
    return VES_OK;
}

/* The line that `at` of the given text lies in. */
static int line_of(const ves_script *script, size_t at)
{
    int low = 0, high = script->lines;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (script->line[middle] <= at)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static ves_mark edit_mark(const ves_edit *edit, size_t at, size_t length)
{
    bool name = at < edit->value;
    int column = name ? edit->name_column : edit->value_column + (int)(at - edit->value);
    int width = name ? edit->value_column - edit->name_column - 1 : (int)length;
    return (ves_mark){edit->source, 1, column, width};
}

ves_mark ves_script_mark(const ves_script *script, size_t at, size_t length)
{
    size_t given = at;
    for (const ves_edit *e = script->edit; e && at >= e->begin; e = e->next) {
        if (at < e->end) return edit_mark(e, at, length);
        given = e->to + (at - e->end);
    }
    if (given > script->given_length) given = script->given_length;
    int line = line_of(script, given);
    size_t column = given - script->line[line];
    if (length > 1000) length = 1000;
    return (ves_mark){0, line + 1, (int)column + 1, length ? (int)length : 1};
}

/* Where a place in the text as run, at most at the border of an edit, was in the text as given. */
static size_t given_place(const ves_script *script, size_t at)
{
    size_t given = at;
    for (const ves_edit *e = script->edit; e && at >= e->begin; e = e->next)
        given = at == e->begin ? e->from : at >= e->end ? e->to + (at - e->end) : given;
    return given;
}

static ves_status splice(ves_script *script, size_t begin, size_t end, const char *text, size_t length)
{
    size_t rest = script->length - end, total = begin + length + rest;
    char *joined = ves_arena_take(script->arena, total + 1, 1);
    if (!joined) return VES_MEMORY;
    memcpy(joined, script->text, begin);
    memcpy(joined + begin, text, length);
    memcpy(joined + begin + length, script->text + end, rest);
    script->text = joined;
    script->length = total;
    return VES_OK;
}

static void shift(ves_edit *edit, size_t from, size_t to)
{
    for (; edit; edit = edit->next) {
        edit->begin += to - from;
        edit->end += to - from;
        edit->value += to - from;
    }
}

/* An earlier --set that wrote more than what is replaced now: it takes the change in. */
static ves_edit *around(const ves_script *script, size_t begin, size_t end)
{
    for (ves_edit *e = script->edit; e; e = e->next)
        if (e->begin <= begin && end <= e->end && (e->begin < begin || end < e->end)) return e;
    return NULL;
}

/* Puts the edit in its place and drops those that it writes over. */
static void insert(ves_script *script, ves_edit *fresh, size_t old_end)
{
    ves_edit **link = &script->edit;
    while (*link && (*link)->begin < fresh->begin) link = &(*link)->next;
    ves_edit *after = *link;
    while (after && after->end <= old_end && after->begin < old_end) after = after->next;
    shift(after, old_end, fresh->end);
    fresh->next = after;
    *link = fresh;
}

ves_status ves_script_replace(ves_script *script, const ves_edit *edit, const char *text)
{
    size_t length = strlen(text), old_end = edit->end;
    ves_edit *outer = around(script, edit->begin, old_end);
    ves_edit *fresh = ves_arena_take(script->arena, 1, sizeof *fresh);
    if (!fresh) return VES_MEMORY;
    *fresh = *edit;
    fresh->from = given_place(script, edit->begin);
    fresh->to = given_place(script, old_end);
    fresh->value += edit->begin;
    fresh->end = edit->begin + length;
    VES_TRY(splice(script, edit->begin, old_end, text, length));
    if (outer) {
        outer->end += fresh->end - old_end;
        shift(outer->next, old_end, fresh->end);
    } else {
        insert(script, fresh, old_end);
    }
    return VES_OK;
}
