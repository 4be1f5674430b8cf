/* Scene: a figure seen from somewhere, as flat coloured pieces on paper, farthest first. */
#ifndef VES_OUTPUT_SCENE_H
#define VES_OUTPUT_SCENE_H

#include "output/output.h"

typedef struct ves_rgb {
    double r, g, b;
} ves_rgb;

/* Values to colours. Diverging: zero in the middle, white. */
typedef struct ves_colour_scale {
    double lo, hi;
    bool diverging, below, above; /* some values lie outside lo .. hi */
    bool constant;                /* all values are that in the middle: lo and hi mean nothing */
} ves_colour_scale;

extern const ves_rgb ves_ink, ves_quiet; /* of words and lines; of what stands back */

ves_rgb ves_colour_patch(int index);
ves_rgb ves_colour_line(int index); /* of charts */
ves_rgb ves_colour_value(const ves_colour_scale *scale, double value);
ves_rgb ves_colour_mix(ves_rgb a, ves_rgb b, double share); /* share of b */

/* From what lies between the 1st and the 99th percentile of `values` (sorted by the call); what is smaller
 * than `noise` in all is zero, `unit` the half-width given to a constant. */
ves_colour_scale ves_colour_scale_of(double *values, int count, double noise, double unit);

/* From the least to the largest of values that are not negative. */
ves_colour_scale ves_colour_scale_whole(const double *values, int count);

/* A step of 1, 2 or 5 times a power of ten, the largest that is at most `step`. */
double ves_step_below(double step);

/* Where the viewer stands. Paper: x to the right, y down, in pixels. */
typedef struct ves_camera {
    double right[3], up[3], toward[3]; /* unit vectors; toward: from the shape to the eye */
    double target[3], distance;        /* of the eye from target; 0: parallel projection */
    double cut[3];      /* unit vector: what lies on this side of target is cut away; 0: nothing */
    double scale, x, y; /* pixels per length at the target, and where the target is */
} ves_camera;

enum { VES_LOW_U = 1, VES_HIGH_U = 2, VES_LOW_V = 4, VES_HIGH_V = 8 };

/* corners 4: a piece of surface, (low u, low v), (high u, low v), (high u, high v), (low u, high v). corners
 * 2: of an end curve; of a spine. */
typedef struct ves_piece {
    float x[4], y[4], depth; /* depth: towards the viewer */
    float r, g, b;
    int order;                    /* of making */
    unsigned char corners, lines; /* lines: which sides lie on the drawn mesh */
    unsigned char rim;            /* which sides lie where the shape is cut */
    bool spine;
} ves_piece;

typedef struct ves_scene {
    ves_camera camera;
    const double *const *plane; /* [patches] the coloured quantity; NULL: patch colours (of one patch: its) */
    ves_colour_scale colours;
    double size; /* half the diagonal of the bounding box */
    ves_piece *piece;
    int pieces;
} ves_scene;

/* The room on paper that the shape may fill; cell: how large a piece may be, in pixels (0: one piece a quad
 * of the grid). */
typedef struct ves_frame {
    double left, top, right, bottom, cell;
} ves_frame;

/* Builds the scene in `arena`. */
ves_status ves_scene_build(ves_scene *scene, const ves_figure *figure, const ves_view *view,
                           const ves_frame *frame, ves_arena *arena);

/* Several, each in its frame: seen from one side, to one scale, in the same colours. */
ves_status ves_scenes_build(ves_scene *scene, const ves_figure *const *figure, int scenes,
                            const ves_view *view, const ves_frame *frame, ves_arena *arena);

/* What the colours of a figure may show. */
typedef struct ves_quantity {
    const char *word, *about, *of; /* "max_shear", "largest shear", the load case or NULL */
    const char *unit;              /* of the number; NULL: 1 over metres to this power */
    int curvature;                 /* 1 H, k1, k2; 2 K; 0: of a shell */
    int plane;                     /* which of H, K, k1, k2 */
    const ves_figure_field *field; /* of a shell; NULL: a curvature */
} ves_quantity;

/* False: the word is "patch", or (ves_quantity_tell) none. */
bool ves_quantity_find(const ves_figure *figure, const char *word, ves_quantity *quantity);
/* VES_NAME, told: the figure has no such quantity, or several. */
ves_status ves_quantity_check(const ves_figure *figure, const char *word, ves_diag *diag);

#endif
