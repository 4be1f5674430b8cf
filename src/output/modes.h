/* Modes: a meridian and what it becomes displaced, a panel for each. */
#ifndef VES_OUTPUT_MODES_H
#define VES_OUTPUT_MODES_H

#include "vesica/diag.h"

/* wr, wz [points]: the displacement where v = 0, of a size to be seen; it goes around like cos n v. */
typedef struct ves_modes_panel {
    int n;
    const double *wr, *wz;
    char caption[2][80];
} ves_modes_panel;

typedef struct ves_modes {
    const char *title;
    int points;
    const double *r, *z; /* from pole to pole */
    int panels;
    const ves_modes_panel *panel;
} ves_modes;

/* The section at v = 0 and v = pi; a displaced one solid, the opposite one with dashes, both by a seventh of the shape
 * at most. PNG, SVG or PDF, by the ending. */
ves_status ves_modes_write(const ves_modes *modes, const char *path, ves_diag *diag);

#endif
