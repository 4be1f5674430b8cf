/* Charts: lines over an axis, with what is written around them. */
#ifndef VES_OUTPUT_CHART_H
#define VES_OUTPUT_CHART_H

#include <stdbool.h>

#include "vesica/diag.h"

/* What stands at each point: CROSS, SPECK, a faint dot, and RING without a line between them. */
typedef enum ves_chart_mark {
    VES_MARK_NONE,
    VES_MARK_DOT,
    VES_MARK_CROSS,
    VES_MARK_SPECK,
    VES_MARK_RING
} ves_chart_mark;

typedef struct ves_chart_line {
    const char *name;
    int count;
    const double *x, *y;      /* [count]; points that are no finite numbers break the line */
    const double *low, *high; /* [count] a band about it, or NULL */
    bool stairs;              /* y holds from its x on */
    ves_chart_mark mark;
    int colour;  /* that of the line of this number, from 1; 0: its own */
    bool dashed; /* of two of one colour */
} ves_chart_line;

/* An axis: what it shows, from where to where; logarithmic: both ends > 0. */
typedef struct ves_chart_axis {
    const char *label;
    double low, high;
    bool logarithmic;
} ves_chart_axis;

/* A place on the x axis: an upright line with a word above it that begins there, or ends there (left), or NULL; those
 * with words from left to right. One that lies beyond the axis, or is no number, is not drawn. */
typedef struct ves_chart_guide {
    const char *name;
    double x;
    bool left;
} ves_chart_guide;

typedef struct ves_chart {
    const char *title; /* or NULL */
    ves_chart_axis x, y;
    int lines;
    const ves_chart_line *line;
    int guides;
    const ves_chart_guide *guide;
    int height; /* pixels; 0: 600 */
} ves_chart;

/* PNG, SVG or PDF, by the ending. */
ves_status ves_chart_write(const ves_chart *chart, const char *path, ves_diag *diag);

/* Several below each other on one sheet, with the title of the first. */
ves_status ves_charts_write(const ves_chart *chart, int charts, const char *path, ves_diag *diag);

#endif
