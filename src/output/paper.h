/* Paper: something drawn with cairo, written as PNG, SVG or PDF by the ending of the file's name. */
#ifndef VES_OUTPUT_PAPER_H
#define VES_OUTPUT_PAPER_H

#include <cairo.h>
#include <stdbool.h>

#include "vesica/diag.h"

typedef struct ves_paper {
    int width, height; /* pixels of 1/96 inch */
    const char *title; /* or NULL */
    void (*draw)(cairo_t *cairo, const void *data);
    const void *data;
} ves_paper;

typedef enum ves_paper_kind { VES_PAPER_PNG, VES_PAPER_SVG, VES_PAPER_PDF, VES_PAPER_NONE } ves_paper_kind;

ves_paper_kind ves_paper_kind_of(const char *path);

/* VES_NAME: the path ends otherwise. */
ves_status ves_paper_write(const ves_paper *paper, const char *path, ves_diag *diag);

#endif
