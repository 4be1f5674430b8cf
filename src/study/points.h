/* Points of a patch as people list them: one "u, v" a line, with a heading "u,v" before them or none. */
#ifndef VES_STUDY_POINTS_H
#define VES_STUDY_POINTS_H

#include <stdio.h>

#include "vesica/diag.h"

typedef struct ves_points {
    int count, room;
    double *u, *v; /* 0 <= u <= 1; v in radians */
} ves_points;

/* All of `in`; name is what messages call it. VES_SYNTAX, VES_RANGE: a line is not as it should be, or there
 * is none; VES_USAGE: cannot be read. *points is to be freed whatever the answer. */
ves_status ves_points_read(FILE *in, const char *name, ves_points *points, ves_diag *diag);
void ves_points_free(ves_points *points);

#endif
