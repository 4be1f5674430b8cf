/* Messages of the reader. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "problem/reader.h"

enum { TEXT = 1000, CANDIDATES = 400, MESSAGES = 200 };

static bool grow(ves_reader *reader)
{
    if (reader->messages < reader->message_room) return true;
    int room = reader->message_room ? 2 * reader->message_room : 16;
    ves_message *more = ves_memory_grow(reader->message, (size_t)room * sizeof *more);
    if (!ves_reader_memory(reader, more)) return false;
    reader->message = more;
    reader->message_room = room;
    return true;
}

static bool same(const ves_message *a, const ves_message *b)
{
    return !memcmp(&a->mark, &b->mark, sizeof a->mark) && !strcmp(a->text, b->text);
}

static void keep(ves_reader *reader, ves_message message)
{
    for (int k = 0; k < reader->messages; k++)
        if (same(&reader->message[k], &message)) return;
    message.text = ves_arena_text(reader->arena, message.text, strlen(message.text));
    message.order = reader->messages;
    if (ves_reader_memory(reader, message.text) && grow(reader))
        reader->message[reader->messages++] = message;
}

__attribute__((format(printf, 5, 0))) static void add(ves_reader *reader, ves_severity severity,
                                                      ves_status status, ves_mark mark, const char *format,
                                                      va_list list)
{
    char text[TEXT];
    if (reader->status == VES_MEMORY) return; /* what seems wrong from then on may only be missing */
    if (severity == VES_ERROR) reader->errors++;
    if (severity == VES_ERROR && reader->status == VES_OK) reader->status = status;
    if (reader->messages >= MESSAGES) {
        reader->lost += severity == VES_ERROR;
        return;
    }
    vsnprintf(text, sizeof text, format, list);
    keep(reader, (ves_message){severity, status, mark, text, 0});
}

void ves_reader_fail(ves_reader *reader, ves_status status, ves_mark mark, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    add(reader, VES_ERROR, status, mark, format, list);
    va_end(list);
}

void ves_reader_error(ves_reader *reader, ves_status status, const ves_node *node, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    add(reader, VES_ERROR, status, ves_reader_mark(reader, node), format, list);
    va_end(list);
}

void ves_reader_warn(ves_reader *reader, ves_mark mark, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    add(reader, VES_WARNING, VES_OK, mark, format, list);
    va_end(list);
}

static int in_file_order(const void *a, const void *b)
{
    const ves_message *x = a, *y = b;
    const int difference[] = {x->mark.source - y->mark.source, x->mark.line - y->mark.line,
                              x->mark.column - y->mark.column};
    for (int k = 0; k < 3; k++)
        if (difference[k]) return difference[k];
    return x->order - y->order;
}

void ves_reader_tell(ves_reader *reader, ves_diag *diag)
{
    if (reader->messages)
        qsort(reader->message, (size_t)reader->messages, sizeof *reader->message, in_file_order);
    for (int k = 0; k < reader->messages; k++) {
        const ves_message *m = &reader->message[k];
        ves_diag_add(diag, m->severity, m->status, m->mark, "%s", m->text);
    }
    for (int k = 0; k < reader->lost; k++) /* only counted: MESSAGES are more than are ever kept */
        ves_diag_add(diag, VES_ERROR, reader->status, (ves_mark){0}, "%s", "");
}

bool ves_reader_full(const ves_reader *reader)
{
    return reader->messages >= MESSAGES;
}

bool ves_reader_memory(ves_reader *reader, const void *block)
{
    if (!block) reader->status = VES_MEMORY;
    return block;
}

ves_mark ves_reader_mark(const ves_reader *reader, const ves_node *node)
{
    return node ? ves_node_mark(reader->script, node) : (ves_mark){0};
}

const char *ves_reader_suggestion(ves_reader *reader, const char *word, const char *const *candidate,
                                  int count)
{
    if (ves_reader_full(reader) || strlen(word) >= 64) return "";
    int near = ves_text_nearest(word, candidate, count < CANDIDATES ? count : CANDIDATES);
    const char *text =
        near < 0 ? NULL : ves_arena_format(reader->arena, ", did you mean \"%s\"?", candidate[near]);
    return text ? text : "";
}
