/* Gallery of designs: a picture of those that a search, or a benchmark, ended at. */
#ifndef VES_STUDY_GALLERY_H
#define VES_STUDY_GALLERY_H

#include "output/gallery.h"
#include "problem/problem.h"
#include "vesica/plan.h"

/* One design: where, and what is written under it. */
typedef struct ves_shown_design {
    const double *x; /* [variables] in the units of the problem */
    const char *caption;
    const char *const *note; /* [notes] */
    int notes;
} ves_shown_design;

typedef struct ves_shown_designs {
    const char *name;       /* of the problem */
    const char *one, *many; /* what they are: "optimum", "optima" */
    int designs;
    const ves_shown_design *design; /* [designs] the best first */
} ves_shown_designs;

/* A value of the goal as captions have it, with the unit of the file: values of neighbours may differ late. NULL: out of
 * memory. */
char *ves_shown_value(double value, const ves_shown *shown, ves_arena *arena);

/* The first VES_GALLERY_MOST. A design without a shape is left out; where
 * none has one there is no file, and VES_OK. */
ves_status ves_designs_draw(ves_plan *plan, const ves_shown_designs *d, const char *path, ves_diag *diag);

#endif
