/* Tables on the screen: columns as wide as their widest cell. */
#ifndef VES_APP_TABLE_H
#define VES_APP_TABLE_H

#include <stdio.h>

#include "base/arena.h"

typedef struct app_table {
    const char *align; /* one letter a column: l or r */
    int cells, room;
    char **cell; /* row after row */
    ves_arena arena;
} app_table;

/* Starts as {.align = "lrr"}. A cell that finds no memory stays empty. */
void app_table_cell(app_table *table, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A number in seven digits; empty when it is none. */
void app_table_number(app_table *table, double value);
/* Fills up the row. */
void app_table_end(app_table *table);
/* Prints and frees. */
void app_table_print(app_table *table, FILE *out);

#endif
