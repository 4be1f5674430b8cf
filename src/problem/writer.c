#include "problem/writer.h"

#include <stdarg.h>
#include <stdio.h>

static bool grow(ves_writer *writer, size_t more)
{
    if (writer->room - writer->length > more) return true;
    size_t room = 2 * (writer->room + more) + 256;
    char *text = ves_memory_grow(writer->text, room);
    if (!text) return false;
    writer->text = text;
    writer->room = room;
    return true;
}

void ves_write(ves_writer *writer, const char *format, ...)
{
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int length = vsnprintf(NULL, 0, format, list);
    if (length < 0 || writer->failed || !grow(writer, (size_t)length)) {
        writer->failed = true;
    } else {
        vsnprintf(writer->text + writer->length, (size_t)length + 1, format, again);
        writer->length += (size_t)length;
    }
    va_end(again);
    va_end(list);
}

char *ves_writer_finish(ves_writer *writer, ves_arena *arena)
{
    char *text =
        writer->failed ? NULL : ves_arena_text(arena, writer->text ? writer->text : "", writer->length);
    ves_memory_free(writer->text);
    *writer = (ves_writer){0};
    return text;
}
