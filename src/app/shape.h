/* A plan at the start design of an opened problem: what sample, export and show work on. */
#ifndef VES_APP_SHAPE_H
#define VES_APP_SHAPE_H

#include "app/app.h"

typedef struct app_shape {
    ves_opened opened;
    ves_plan *plan;
    double *x; /* [variables] the start: of a RUN, its best */
} app_shape;

/* Opens operand 0. On failure *code is to be returned, and there is nothing to close. */
bool app_shape_open(app *a, app_shape *shape, int *code);
void app_shape_close(app_shape *shape);

/* The figure on the grid that --grid asks for; NULL: *code is to be returned. */
ves_figure *app_shape_figure(app *a, app_shape *shape, int *code);

#endif
