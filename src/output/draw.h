/* Draws a scene with what surrounds it: background, title, legend, scale bar, axes. */
#ifndef VES_OUTPUT_DRAW_H
#define VES_OUTPUT_DRAW_H

#include <cairo.h>

#include "output/scene.h"

/* Where the shape goes on paper of view->width x view->height. */
ves_frame ves_draw_frame(const ves_figure *figure, const ves_view *view);

/* Pixels that texts and lines are laid out by: 1 on paper of 960 x 720. */
double ves_draw_unit(const ves_view *view);

/* scenes: as many on one sheet, alike (ves_scenes_build), the figure of the first. */
void ves_draw(cairo_t *cairo, const ves_figure *figure, const ves_view *view, const ves_scene *scene,
              int scenes, double unit);

#endif
