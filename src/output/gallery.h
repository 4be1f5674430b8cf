/* Gallery: figures of one kind side by side on one sheet, seen from one side, to one scale, in the same colours. */
#ifndef VES_OUTPUT_GALLERY_H
#define VES_OUTPUT_GALLERY_H

#include "output/output.h"

enum { VES_GALLERY_MOST = 12, VES_GALLERY_SMALL = 48 };

/* notes: what stands under the caption, with commas between; a note is not broken, and what has no room is counted. */
typedef struct ves_gallery_item {
    const ves_figure *figure;
    const char *caption;
    const char *const *note; /* [notes] */
    int notes;
} ves_gallery_item;

typedef struct ves_gallery {
    const char *title;
    int items; /* 1 to VES_GALLERY_MOST; of small ones to VES_GALLERY_SMALL */
    const ves_gallery_item *item;
    int columns;     /* of small pictures; 0: large ones, in as many as suit */
    const int *cell; /* [items] which cell each one has, rising; NULL: one after another */
    bool cut;        /* closed shapes are cut open, and seen more from the side */
} ves_gallery;

/* PNG, SVG or PDF, by the ending. Nothing of the gallery is kept. */
ves_status ves_gallery_write(const ves_gallery *gallery, const char *path, ves_diag *diag);

#endif
