#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "output/output.h"
#include "output/utf8.h"

enum { INDENT = 2 };

static unsigned bit(int depth)
{
    return 1u << (depth & 31);
}

static void line_break(const ves_json *json, int depth)
{
    putc('\n', json->out);
    for (int k = 0; k < INDENT * depth; k++) putc(' ', json->out);
}

static void control(FILE *out, unsigned char c)
{
    static const char plain[] = "\b\f\n\r\t\"\\", letter[] = "bfnrt\"\\";
    const char *at = c ? strchr(plain, c) : NULL;
    if (at)
        fprintf(out, "\\%c", letter[at - plain]);
    else
        fprintf(out, "\\u%04x", c);
}

static void quoted(FILE *out, const char *text)
{
    putc('"', out);
    while (*text) {
        int length = ves_utf8_length(text);
        unsigned char c = (unsigned char)*text;
        if (!length)
            fputs("\xEF\xBF\xBD", out); /* U+FFFD */
        else if (c < 0x20 || c == '"' || c == '\\')
            control(out, c);
        else
            fwrite(text, 1, (size_t)length, out);
        text += length ? length : 1;
    }
    putc('"', out);
}

/* Comma, line and key before any value. */
static void begin(ves_json *json, const char *key, bool container)
{
    bool first = !(json->filled & bit(json->depth));
    bool lines = !json->line && json->depth > 0 && (key || container);
    if (!first && json->depth > 0) putc(',', json->out);
    if (lines)
        line_break(json, json->depth);
    else if (!first && json->depth > 0 && !json->line)
        putc(' ', json->out);
    if (lines) json->broken |= bit(json->depth);
    json->filled |= bit(json->depth);
    if (!key) return;
    quoted(json->out, key);
    fputs(json->line ? ":" : ": ", json->out);
}

/* A text at the top ends its line, so that the next begins a new one. */
static void finish(ves_json *json)
{
    if (json->depth > 0) return;
    putc('\n', json->out);
    json->filled = 0;
}

static void open(ves_json *json, const char *key, char bracket)
{
    begin(json, key, true);
    putc(bracket, json->out);
    json->depth++;
    json->filled &= ~bit(json->depth);
    json->broken &= ~bit(json->depth);
}

void ves_json_object(ves_json *json, const char *key)
{
    open(json, key, '{');
}

void ves_json_array(ves_json *json, const char *key)
{
    open(json, key, '[');
}

void ves_json_end(ves_json *json, char bracket)
{
    if (json->broken & bit(json->depth)) line_break(json, json->depth - 1);
    json->depth--;
    putc(bracket, json->out);
    finish(json);
}

void ves_json_number(ves_json *json, const char *key, double value)
{
    char buffer[32] = "null";
    if (isfinite(value)) ves_text_shortest(value, buffer);
    begin(json, key, false);
    fputs(buffer, json->out);
    finish(json);
}

void ves_json_integer(ves_json *json, const char *key, long value)
{
    begin(json, key, false);
    fprintf(json->out, "%ld", value);
    finish(json);
}

void ves_json_count(ves_json *json, const char *key, uint64_t value)
{
    begin(json, key, false);
    fprintf(json->out, "%" PRIu64, value);
    finish(json);
}

void ves_json_text(ves_json *json, const char *key, const char *value)
{
    begin(json, key, false);
    if (value)
        quoted(json->out, value);
    else
        fputs("null", json->out);
    finish(json);
}

void ves_json_flag(ves_json *json, const char *key, bool value)
{
    begin(json, key, false);
    fputs(value ? "true" : "false", json->out);
    finish(json);
}
