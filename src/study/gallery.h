/* Gallery of designs: a picture of those that a search, or a benchmark, ended at. */
#ifndef VES_STUDY_GALLERY_H
#define VES_STUDY_GALLERY_H

#include "output/gallery.h"
#include "vesica/plan.h"

/* One design: where, and what is written under it. */
typedef struct ves_shown_design {
    const double *x; /* [variables] in the units of the problem */
    const char *caption;
    const char *const *note; /* [notes] */
    int notes;
} ves_shown_design;

/* The first VES_GALLERY_MOST, the best first. name: of the problem. A design without a shape is left out; where
 * none has one there is no file, and VES_OK. */
ves_status ves_designs_draw(ves_plan *plan, const char *name, const ves_shown_design *design, int designs,
                            const char *path, ves_diag *diag);

#endif
