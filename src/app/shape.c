#include "app/shape.h"

static ves_status plan_make(app *a, app_shape *shape)
{
    const ves_problem *p = shape->opened.problem;
    shape->x = ves_arena_take(&a->arena, (size_t)p->variables, sizeof(double));
    if (!shape->x) return ves_diag_add(a->diag, VES_ERROR, VES_MEMORY, (ves_mark){0}, "out of memory");
    for (int k = 0; k < p->variables; k++) shape->x[k] = p->variable[k].start;
    return ves_plan_create(p, NULL, &shape->plan, a->diag);
}

bool app_shape_open(app *a, app_shape *shape, int *code)
{
    *shape = (app_shape){0};
    if (!app_open(a, &shape->opened, code)) return false;
    ves_status status = plan_make(a, shape);
    *code = app_code(status);
    if (status != VES_OK) app_shape_close(shape);
    return status == VES_OK;
}

void app_shape_close(app_shape *shape)
{
    ves_plan_destroy(shape->plan);
    ves_study_close(&shape->opened);
}

ves_figure *app_shape_figure(app *a, app_shape *shape, int *code)
{
    ves_figure *figure = NULL;
    const int *grid = a->options.grid;
    ves_status status = ves_plan_figure(shape->plan, shape->x, grid[0], grid[1], &figure, a->diag);
    if (!figure) *code = app_code(status);
    return figure;
}
