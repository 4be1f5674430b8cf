#include "app/table.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "app/app.h"

enum { TEXT = 400, COLUMNS = 12, INDENT = 2, GAP = 3 };

static int width(const char *text)
{
    int count = 0;
    for (; *text; text++) count += ((unsigned char)*text & 0xC0) != 0x80;
    return count;
}

static void append(app_table *table, const char *text)
{
    if (table->cells == table->room) {
        int room = table->room ? 2 * table->room : 64;
        char **cell = ves_memory_grow(table->cell, sizeof *cell * (size_t)room);
        if (!cell) return;
        table->cell = cell;
        table->room = room;
    }
    table->cell[table->cells++] = ves_arena_text(&table->arena, text, strlen(text));
}

void app_table_cell(app_table *table, const char *format, ...)
{
    char text[TEXT];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    append(table, text);
}

void app_table_number(app_table *table, double value)
{
    char buffer[32];
    append(table, isnan(value) ? "" : app_screen_number(value, buffer));
}

void app_table_end(app_table *table)
{
    while (table->cells % (int)strlen(table->align)) {
        int before = table->cells;
        append(table, "");
        if (table->cells == before) return;
    }
}

static const char *at(const app_table *table, int index)
{
    return table->cell[index] ? table->cell[index] : "";
}

static void row_print(const app_table *table, int first, const int *wide, FILE *out)
{
    int columns = (int)strlen(table->align), last = columns - 1;
    while (last > 0 && !*at(table, first + last)) last--; /* nothing trails */
    fprintf(out, "%*s", INDENT, "");
    for (int c = 0; c <= last; c++) {
        const char *text = at(table, first + c);
        if (!wide[c]) continue; /* a column without a word */
        int pad = wide[c] - width(text);
        bool right = table->align[c] == 'r';
        if (right) fprintf(out, "%*s", pad, "");
        fputs(text, out);
        if (c < last) fprintf(out, "%*s", (right ? 0 : pad) + GAP, "");
    }
    fputc('\n', out);
}

void app_table_print(app_table *table, FILE *out)
{
    int columns = (int)strlen(table->align), wide[COLUMNS] = {0};
    for (int k = 0; k < table->cells; k++) {
        int w = width(at(table, k));
        if (w > wide[k % columns]) wide[k % columns] = w;
    }
    for (int first = 0; first + columns <= table->cells; first += columns) row_print(table, first, wide, out);
    ves_memory_free(table->cell);
    ves_arena_destroy(&table->arena);
    *table = (app_table){.align = table->align};
}
