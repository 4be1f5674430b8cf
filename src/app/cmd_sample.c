/* vesica sample: exact values at given points of one patch. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app/shape.h"
#include "base/text.h"

enum { FIELDS = 6, LINE = 256, NAMES = 64 };

typedef struct points {
    int count, room;
    double *u, *v; /* one block, v after u */
} points;

static bool keep(points *p, double u, double v)
{
    if (p->count == p->room) {
        int room = p->room ? 2 * p->room : 1024;
        double *pu = ves_memory_grow(p->u, sizeof *pu * (size_t)room);
        if (pu) p->u = pu;
        double *pv = ves_memory_grow(p->v, sizeof *pv * (size_t)room);
        if (pv) p->v = pv;
        if (!pu || !pv) return false;
        p->room = room;
    }
    p->u[p->count] = u;
    p->v[p->count++] = v;
    return true;
}

static char *trimmed(char *text)
{
    size_t length = strlen(text);
    while (length && strchr(" \t\r\n", text[length - 1])) text[--length] = 0;
    return text + strspn(text, " \t");
}

/* "u, v": two numbers. */
static bool pair(char *line, double *u, double *v)
{
    char *comma = strchr(line, ',');
    if (!comma) return false;
    *comma = 0;
    return ves_text_number(trimmed(line), u) && ves_text_number(trimmed(comma + 1), v);
}

/* The one heading that says what the columns are: u,v in this order. */
static bool is_heading(const char *line)
{
    static const char mark[] = "\xEF\xBB\xBF"; /* of UTF-8, which spreadsheets put first */
    char word[4] = "";
    if (!strncmp(line, mark, 3)) line += 3;
    size_t count = 0;
    for (; *line; line++)
        if (!strchr(" \t\"", *line)) {
            if (count == 3) return false;
            word[count++] = *line;
        }
    return strlen(word) == 3 && strchr("uU", word[0]) && word[1] == ',' && strchr("vV", word[2]);
}

static int points_read(app *a, FILE *in, const char *name, points *p)
{
    char line[LINE], shown[LINE];
    for (int number = 1; fgets(line, sizeof line, in); number++) {
        double u, v;
        char *text = trimmed(line);
        memcpy(shown, text, strlen(text) + 1);
        if (!*text) continue;
        bool good = pair(text, &u, &v);
        if (number == 1 && is_heading(shown)) continue;
        if (!good)
            return app_fail(a, VES_SYNTAX, "%s:%d: two numbers u,v are needed, found \"%s\"", name, number,
                            shown);
        if (!(u >= 0 && u <= 1))
            return app_fail(a, VES_RANGE, "%s:%d: u = %g lies outside the patch (0 to 1)", name, number, u);
        if (!keep(p, u, v)) return app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    }
    if (ferror(in)) return app_fail(a, VES_USAGE, "cannot read \"%s\": %s", name, strerror(errno));
    if (!p->count) return app_fail(a, VES_SYNTAX, "\"%s\" has no points: one u,v a line is needed", name);
    return APP_DONE;
}

static int points_open(app *a, points *p)
{
    const char *name = a->options.points;
    if (!strcmp(name, "-")) return points_read(a, stdin, "stdin", p);
    FILE *in = fopen(name, "rb");
    if (!in) return app_fail(a, VES_USAGE, "cannot open \"%s\": %s", name, strerror(errno));
    int code = points_read(a, in, name, p);
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

static void values_print(const points *p, const double *value)
{
    printf("u,v,x,y,z,xu,yu,zu,xv,yv,zv,xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv\n");
    for (int k = 0; k < p->count; k++) {
        printf("%.17g,%.17g", p->u[k], p->v[k]);
        for (int f = 0; f < 3 * FIELDS; f++) printf(",%.17g", value[f * p->count + k]);
        putchar('\n');
    }
}

static int values(app *a, ves_plan *plan, int patch)
{
    points p = {0};
    int code = points_open(a, &p);
    double *value = ves_memory_take(sizeof *value * (size_t)(3 * FIELDS) * (size_t)p.count);
    if (code == APP_DONE && (!value || ves_plan_points(plan, patch, p.count, p.u, p.v, value) != VES_OK))
        code = app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    if (code == APP_DONE) values_print(&p, value);
    ves_memory_free(value);
    ves_memory_free(p.u);
    ves_memory_free(p.v);
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
    printf("u,x,y,z\n");
    for (int k = 0; k < count; k++)
        printf("%.17g,%.17g,%.17g,%.17g\n", u[k], value[k], value[count + k], value[2 * count + k]);
    return APP_DONE;
}

/* Binds the design; what fails only because of a check (a fold, say) can still be sampled. */
static int bound(app *a, app_shape *shape)
{
    const ves_problem *p = shape->opened.problem;
    double *measure = ves_arena_take(&a->arena, (size_t)p->measures, sizeof *measure);
    if (!measure) return app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    ves_status status = ves_plan_measure(shape->plan, shape->x, 0, measure);
    if (status < VES_OK || status == VES_NO_ROOT) return app_fail(a, status, "%s", ves_status_text(status));
    if (status > VES_OK)
        ves_diag_add(a->diag, VES_WARNING, status, (ves_mark){0}, "%s", ves_status_text(status));
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
        code = a->options.spine ? spine(a, shape.plan, p, patch) : values(a, shape.plan, patch);
    app_shape_close(&shape);
    return code;
}
