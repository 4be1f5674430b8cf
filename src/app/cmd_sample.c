/* vesica sample: exact values at given points of one patch. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app/shape.h"
#include "base/text.h"
#include "study/points.h"

enum { FIELDS = 6, NAMES = 64 };

static int points_open(app *a, ves_points *p)
{
    const char *name = a->options.points;
    if (!strcmp(name, "-")) return app_code(ves_points_read(stdin, "stdin", p, a->diag));
    FILE *in = fopen(name, "rb");
    if (!in) return app_fail(a, VES_USAGE, "cannot open \"%s\": %s", name, strerror(errno));
    int code = app_code(ves_points_read(in, name, p, a->diag));
    fclose(in);
    return code;
}

static int unknown_patch(app *a, const ves_problem *p)
{
    const char *word = a->options.patch, *name[NAMES];
    char *list = ves_arena_text(&a->arena, "", 0);
    for (int k = 0; k < p->patches && list; k++)
        list = ves_arena_format(&a->arena, "%s%s%s", list, k ? ", " : "", p->patch[k].name);
    if (!word)
        return app_fail(a, VES_USAGE, "--patch NAME is needed: this shape has %s",
                        list ? list : "several patches");
    for (int k = 0; k < p->patches && k < NAMES; k++) name[k] = p->patch[k].name;
    int near = ves_text_nearest(word, name, p->patches < NAMES ? p->patches : NAMES);
    return near < 0
               ? app_fail(a, VES_NAME, "no patch \"%s\": this shape has %s", word, list ? list : "others")
               : app_fail(a, VES_NAME, "no patch \"%s\", did you mean \"%s\"?", word, name[near]);
}

static int patch_find(const app *a, const ves_problem *p)
{
    for (int k = 0; a->options.patch && k < p->patches; k++)
        if (!strcmp(p->patch[k].name, a->options.patch)) return k;
    return !a->options.patch && p->patches == 1 ? 0 : -1;
}

static void values_print(const ves_points *p, const double *value)
{
    printf("u,v,x,y,z,xu,yu,zu,xv,yv,zv,xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv\n");
    for (int k = 0; k < p->count; k++) {
        printf("%.17g,%.17g", p->u[k], p->v[k]);
        for (int f = 0; f < 3 * FIELDS; f++) printf(",%.17g", value[f * p->count + k]);
        putchar('\n');
    }
}

/* Derivatives may be infinite at the end of a patch; points may not. */
static int values_check(app *a, const char *patch, const ves_points *p, const double *value)
{
    for (int k = 0; k < p->count; k++)
        for (int c = 0; c < 3; c++)
            if (!isfinite(value[c * p->count + k])) {
                const char axis = "xyz"[c];
                return app_fail(a, VES_NO_POINT,
                                "%c of patch \"%s\" is not a finite number at u = %.7g, v = %.7g", axis,
                                patch, p->u[k], p->v[k]);
            }
    return APP_DONE;
}

static int values(app *a, ves_plan *plan, const ves_problem *problem, int patch)
{
    ves_points p = {0};
    int code = points_open(a, &p);
    double *value = ves_memory_take(sizeof *value * (size_t)(3 * FIELDS) * (size_t)p.count);
    if (code == APP_DONE && (!value || ves_plan_points(plan, patch, p.count, p.u, p.v, value) != VES_OK))
        code = app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    if (code == APP_DONE) code = values_check(a, problem->patch[patch].name, &p, value);
    if (code == APP_DONE) values_print(&p, value);
    ves_memory_free(value);
    ves_points_free(&p);
    return code;
}

static int spine(app *a, ves_plan *plan, const ves_problem *problem, int patch)
{
    int count = a->options.spine;
    double *u = ves_arena_take(&a->arena, (size_t)count, sizeof *u);
    double *value = ves_arena_take(&a->arena, (size_t)count, 9 * sizeof *value);
    if (!u || !value) return app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    for (int k = 0; k < count; k++) u[k] = (double)k / (count - 1);
    ves_status status = ves_plan_spine(plan, patch, count, u, value);
    if (status == VES_ABSENT)
        return app_fail(a, VES_USAGE, "patch \"%s\" has no spine: it is not the solution of a PDE",
                        problem->patch[patch].name);
    if (status != VES_OK) return app_fail(a, status, "%s", ves_status_text(status));
    printf("u,x,y,z,xu,yu,zu,xuu,yuu,zuu\n");
    for (int k = 0; k < count; k++) {
        printf("%.17g", u[k]);
        for (int f = 0; f < 9; f++) printf(",%.17g", value[f * count + k]);
        putchar('\n');
    }
    return APP_DONE;
}

/* Binds the design; what fails only because of a check (a fold, say) can still be sampled. */
static int bound(app *a, app_shape *shape)
{
    ves_design design;
    ves_status status = ves_plan_measure(shape->plan, shape->x, 0, &design);
    if (status < VES_OK || status == VES_NO_ROOT || status == VES_NO_BRACKET || status == VES_NO_SCALE)
        return app_fail(a, status, "%s", ves_status_text(status));
    ves_plan_why(shape->plan, status,
                 isnan(design.similarity) ? "the design cannot be measured, and is not scaled"
                                          : "the design cannot be measured",
                 a->diag);
    return APP_DONE;
}

int app_sample(app *a)
{
    app_shape shape;
    int code;
    if (!a->options.points == !a->options.spine)
        return app_fail(a, VES_USAGE, "vesica sample needs --points FILE or --spine N, one of them");
    if (!app_shape_open(a, &shape, &code)) return code;
    const ves_problem *p = shape.opened.problem;
    int patch = patch_find(a, p);
    code = patch < 0 ? unknown_patch(a, p) : bound(a, &shape);
    if (code == APP_DONE)
        code = a->options.spine ? spine(a, shape.plan, p, patch) : values(a, shape.plan, p, patch);
    app_shape_close(&shape);
    return code;
}
