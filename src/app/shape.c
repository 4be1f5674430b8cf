#include "app/shape.h"

static ves_status plan_make(app *a, app_shape *shape)
{
    const ves_problem *p = shape->opened.problem;
    int quadrature[2];
    double change;
    shape->x = ves_arena_take(&a->arena, (size_t)p->variables, sizeof(double));
    if (!shape->x) return ves_diag_add(a->diag, VES_ERROR, VES_MEMORY, (ves_mark){0}, "out of memory");
    for (int k = 0; k < p->variables; k++) shape->x[k] = p->variable[k].start;
    VES_TRY(ves_study_quadrature(p, quadrature, &change, a->diag));
    return ves_study_plan(p, quadrature, &shape->plan, a->diag);
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
    int errors = ves_diag_errors(a->diag);
    ves_status status = ves_plan_figure(shape->plan, shape->x, grid[0], grid[1], &figure, a->diag);
    if (figure) return figure;
    *code = app_code(status);
    if (ves_diag_errors(a->diag) == errors)
        app_fail(a, status, "there is no shape to show: %s", ves_status_text(status));
    return NULL;
}
