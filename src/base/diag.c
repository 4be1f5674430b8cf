#include "vesica/diag.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"
#include "base/diag.h"

enum { TEXT = 1200, MESSAGES = VES_DIAG_ERRORS + VES_DIAG_REMARKS, EXCERPT = 120 };

typedef struct source {
    const char *name, *text;
    struct source *next;
} source;

typedef struct message {
    ves_severity severity;
    ves_status status;
    ves_mark mark;
    const char *text;
} message;

struct ves_diag {
    ves_arena arena;
    source *first, *last;
    int sources, base, errors, remarks, count;
    message kept[MESSAGES];
};

ves_diag *ves_diag_create(void)
{
    return ves_memory_take(sizeof(ves_diag));
}

void ves_diag_destroy(ves_diag *diag)
{
    if (!diag) return;
    ves_arena_destroy(&diag->arena);
    ves_memory_free(diag);
}

int ves_diag_source(ves_diag *diag, const char *name, const char *text, size_t length)
{
    if (!diag) return 0;
    source *s = ves_arena_take(&diag->arena, 1, sizeof *s);
    if (!s) return 0;
    s->name = ves_arena_text(&diag->arena, name, strlen(name));
    s->text = ves_arena_text(&diag->arena, text, length);
    if (!s->name || !s->text) return 0;
    if (diag->last)
        diag->last->next = s;
    else
        diag->first = s;
    diag->last = s;
    return diag->sources++ - diag->base;
}

int ves_diag_base(ves_diag *diag, int base)
{
    if (!diag) return 0;
    int before = diag->base;
    diag->base = base < 0 ? diag->sources : base;
    return before;
}

ves_status ves_diag_add(ves_diag *diag, ves_severity severity, ves_status status, ves_mark mark,
                        const char *format, ...)
{
    if (!diag) return status;
    bool keep = severity == VES_ERROR ? diag->errors++ < VES_DIAG_ERRORS : diag->remarks++ < VES_DIAG_REMARKS;
    if (!keep) return status;
    char text[TEXT];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    const char *copy = ves_arena_text(&diag->arena, text, strlen(text));
    message m = {severity, status, mark, copy ? copy : ves_status_text(VES_MEMORY)};
    m.mark.source += diag->base;
    diag->kept[diag->count++] = m;
    return status;
}

ves_status ves_diag_fail(ves_diag *diag, ves_status status)
{
    return ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "%s", ves_status_text(status));
}

int ves_diag_count(const ves_diag *diag)
{
    return diag ? diag->count : 0;
}

int ves_diag_errors(const ves_diag *diag)
{
    return diag ? diag->errors : 0;
}

static const message *kept_at(const ves_diag *diag, int index)
{
    static const message none = {VES_NOTE, VES_OK, {0}, ""};
    return index >= 0 && index < ves_diag_count(diag) ? &diag->kept[index] : &none;
}

ves_severity ves_diag_severity(const ves_diag *diag, int index)
{
    return kept_at(diag, index)->severity;
}

ves_status ves_diag_status(const ves_diag *diag, int index)
{
    return kept_at(diag, index)->status;
}

static const source *source_at(const ves_diag *diag, int index)
{
    const source *s = diag->first;
    while (s && index-- > 0) s = s->next;
    return s;
}

/* Appends like snprintf, counting what did not fit. */
static size_t append(char *buffer, size_t size, size_t at, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    int length = vsnprintf(at < size ? buffer + at : NULL, at < size ? size - at : 0, format, list);
    va_end(list);
    return at + (length > 0 ? (size_t)length : 0);
}

static bool printable(unsigned char c)
{
    return c >= 32 && c != 127;
}

/* The quoted line and its caret. A long line is shown as a window around the column. */
static size_t excerpt(char *buffer, size_t size, size_t at, const source *s, ves_mark mark)
{
    const char *line = s->text;
    for (int k = 1; k < mark.line && line; k++) {
        line = strchr(line, '\n');
        if (line) line++;
    }
    if (!line || mark.column < 1) return at;
    int length = (int)strcspn(line, "\n");
    if (mark.column > length + 1) return at;
    int first = mark.column > EXCERPT - 20 ? mark.column - 40 : 0;
    while (first && ((unsigned char)line[first] & 0xC0) == 0x80) first--; /* not inside a UTF-8 sequence */
    int shown = length - first < EXCERPT ? length - first : EXCERPT;
    at = append(buffer, size, at, "\n%5d | %s", mark.line, first ? "..." : "");
    for (int k = 0; k < shown; k++)
        at =
            append(buffer, size, at, "%c", printable((unsigned char)line[first + k]) ? line[first + k] : ' ');
    at = append(buffer, size, at, "\n      | %s", first ? "   " : "");
    for (int k = first; k < mark.column - 1; k++)
        if (((unsigned char)line[k] & 0xC0) != 0x80) at = append(buffer, size, at, " ");
    at = append(buffer, size, at, "^");
    for (int k = 1; k < mark.length && mark.column - 1 + k < first + shown; k++)
        if (((unsigned char)line[mark.column - 1 + k] & 0xC0) != 0x80) at = append(buffer, size, at, "~");
    return at;
}

size_t ves_diag_text(const ves_diag *diag, int index, char *buffer, size_t size)
{
    static const char *const word[] = {"note", "warning", "error"};
    const message *m = kept_at(diag, index);
    const source *s = m->mark.line > 0 ? source_at(diag, m->mark.source) : NULL;
    size_t length = 0;
    if (size) buffer[0] = 0;
    if (!*m->text) return 0;
    if (s) length = append(buffer, size, length, "%s:%d:%d: ", s->name, m->mark.line, m->mark.column);
    length = append(buffer, size, length, "%s: %s", word[m->severity], m->text);
    return s ? excerpt(buffer, size, length, s, m->mark) : length;
}
