/* vesica export, vesica show: the shape as files. */
#include <string.h>

#include "app/shape.h"
#include "base/text.h"
#include "study/folder.h"

enum { WORDS = 16, NAMES = 64 };

static int unknown_format(app *a, const char *word)
{
    static const char later[] = "glb|step", pictures[] = "png|svg|pdf";
    const char *name[NAMES];
    int count = 0;
    if (!*word)
        return app_fail(a, VES_USAGE, "a format is missing in --to \"%s\" (vesica list formats)",
                        a->options.to);
    if (ves_words_find(later, word) >= 0)
        return app_fail(a, VES_ABSENT, "this version of vesica (%s) does not write %s yet", VESICA_VERSION,
                        word);
    if (ves_words_find(pictures, word) >= 0)
        return app_fail(a, VES_USAGE, "pictures are made by vesica show FILE --png NAME.%s", word);
    for (const ves_format *const *f = ves_formats(); *f && count < NAMES; f++) name[count++] = (*f)->name;
    int near = ves_text_nearest(word, name, count);
    if (near >= 0) return app_fail(a, VES_USAGE, "no format \"%s\", did you mean \"%s\"?", word, name[near]);
    return app_fail(a, VES_USAGE, "no format \"%s\" (vesica list formats)", word);
}

/* "vtp,stl": all must be known before the first is written. */
static int formats_read(app *a, const ves_format **format, int *count)
{
    char *list = ves_arena_text(&a->arena, a->options.to, strlen(a->options.to));
    if (!list) return app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    for (char *word = list, *comma; word; word = comma ? comma + 1 : NULL) {
        comma = strchr(word, ',');
        if (comma) *comma = 0;
        const ves_format *f = ves_format_find(word);
        if (!f) return unknown_format(a, word);
        bool known = false; /* each is written once, however often it is named */
        for (int k = 0; k < *count; k++) known = known || format[k] == f;
        if (known) continue;
        if (*count == WORDS) return app_fail(a, VES_USAGE, "too many formats in \"%s\"", a->options.to);
        format[(*count)++] = f;
    }
    return APP_DONE;
}

/* DIR/NAME, DIR made when it is not there. */
static char *stem_of(app *a, const char *name, int *code)
{
    const char *folder = a->options.out;
    ves_status status = folder ? ves_folder_open(folder, &a->arena, a->diag) : VES_OK;
    *code = app_code(status);
    if (status != VES_OK) return NULL;
    char *stem =
        folder ? ves_folder_path(folder, name, &a->arena) : ves_arena_text(&a->arena, name, strlen(name));
    if (!stem) *code = app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    return stem;
}

/* One file, whose name must be free: STEM.FORMAT, STEM-2.FORMAT ... */
static int write_one(app *a, ves_figure *figure, const char *stem, const ves_format *format, bool spines)
{
    char *path = stem ? ves_folder_free(stem, format->name, &a->arena) : NULL;
    if (!path) return app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    ves_status status = (spines ? format->spines : format->write)(figure, path, a->diag);
    if (status == VES_OK) printf("%s\n", path);
    return app_code(status);
}

static int write_all(app *a, ves_figure *figure, const char *stem, const ves_format **format, int count)
{
    char *spines = a->options.spines ? ves_arena_format(&a->arena, "%s-spines", stem) : NULL;
    app_interrupt_listen(); /* a file that has begun is ended; a second Ctrl-C kills */
    for (int k = 0; k < count; k++) {
        if (app_interrupt_asked())
            return app_fail(a, VES_INTERRUPTED, "interrupted: %d of %d files are not written", count - k,
                            count);
        int code = write_one(a, figure, stem, format[k], false);
        if (code == APP_DONE && a->options.spines && format[k]->spines)
            code = write_one(a, figure, spines, format[k], true);
        if (code != APP_DONE) return code;
    }
    return APP_DONE;
}

/* --spines needs a format that has lines, and a patch that has a spine. */
static int spines_check(app *a, const ves_problem *p, const ves_format **format, int count)
{
    bool lines = false, any = false;
    for (int k = 0; k < count; k++) lines = lines || format[k]->spines;
    for (int k = 0; k < p->patches; k++) any = any || p->patch[k].kind == VES_PATCH_PDE;
    if (!a->options.spines || (lines && any)) return APP_DONE;
    if (any)
        return app_fail(a, VES_USAGE, "--spines: no format of --to \"%s\" has lines; add vtp, obj or csv",
                        a->options.to);
    return app_fail(a, VES_USAGE,
                    "--spines: no patch of this shape has a spine: none is the solution of a PDE");
}

/* What needs a shell: a format of elements, and --buckling. */
static int shell_check(app *a, const ves_problem *p, const ves_format **format, int count, bool *elements)
{
    for (int k = 0; k < count; k++) *elements = *elements || format[k]->shell;
    if (a->options.factors && !*elements)
        return app_fail(a, VES_USAGE, "--buckling: no format of --to \"%s\" has load cases; add inp",
                        a->options.to);
    for (int k = 0; k < count && !p->shell; k++)
        if (format[k]->shell)
            return app_fail(a, VES_USAGE,
                            "--to %s needs the section \"shell\" in the problem file (vesica explain shell): "
                            "how thick the "
                            "shape is, what holds it and what pulls",
                            format[k]->name);
    return APP_DONE;
}

/* On the grid that --grid asks for; unless it does, on one for elements when a format has them. */
static ves_figure *figure_make(app *a, app_shape *shape, bool elements, int *code)
{
    int *grid = a->options.grid;
    if (elements && !grid[0]) grid[0] = grid[1] = VES_FIGURE_ELEMENTS;
    ves_figure *figure = app_shape_figure(a, shape, code);
    if (figure && figure->shell) figure->shell->factors = a->options.factors;
    return figure;
}

/* In the unit that is asked for. A file without units has no metres that could be turned into it. */
static int convert(app *a, ves_figure *figure)
{
    const char *unit = a->options.unit;
    if (unit && !figure->unit)
        return app_fail(a, VES_USAGE,
                        "--unit %s: the problem file has no units, so its numbers are written as they are",
                        unit);
    if (unit && a->options.metres != 1) ves_figure_scale(figure, 1 / a->options.metres, unit);
    return APP_DONE;
}

/* A program that prints takes the numbers of a file for millimetres: who exports should see them. */
static void box_tell(const ves_figure *figure)
{
    double low[3], high[3];
    if (!ves_figure_box(figure, low, high)) return;
    fprintf(stderr, "box %.4g x %.4g x %.4g %s\n", high[0] - low[0], high[1] - low[1], high[2] - low[2],
            figure->unit ? figure->unit : "(the problem file has no units)");
}

int app_export(app *a)
{
    app_shape shape;
    const ves_format *format[WORDS];
    int code = APP_DONE, count = 0;
    bool elements = false;
    if (!a->options.to)
        return app_fail(a, VES_USAGE, "vesica export needs --to FORMAT (vesica list formats)");
    code = formats_read(a, format, &count);
    if (code != APP_DONE || !app_shape_open(a, &shape, &code)) return code;
    code = spines_check(a, shape.opened.problem, format, count);
    if (code == APP_DONE) code = shell_check(a, shape.opened.problem, format, count, &elements);
    char *stem = code == APP_DONE ? stem_of(a, shape.opened.name, &code) : NULL;
    ves_figure *figure = stem ? figure_make(a, &shape, elements, &code) : NULL;
    if (figure) code = convert(a, figure);
    if (figure && code == APP_DONE) {
        code = write_all(a, figure, stem, format, count);
        if (code == APP_DONE) box_tell(figure);
    }
    ves_figure_destroy(figure);
    app_shape_close(&shape);
    return code;
}

static ves_view view_of(const app_options *o)
{
    ves_view view = ves_view_default();
    if (o->colour) view.colour = o->colour;
    view.spines = o->spines;
    if (o->viewed) view.azimuth = o->view[0], view.height_angle = o->view[1];
    return view;
}

int app_show(app *a)
{
    app_shape shape;
    int code;
    if (!app_shape_open(a, &shape, &code)) return code;
    ves_figure *figure = app_shape_figure(a, &shape, &code);
    if (figure) {
        ves_view view = view_of(&a->options);
        const char *path =
            a->options.png ? a->options.png : ves_folder_free(shape.opened.name, "png", &a->arena);
        ves_status status = path ? ves_picture_write(figure, &view, path, a->diag) : VES_MEMORY;
        code = app_code(status);
        if (status == VES_OK) printf("%s\n", path);
    }
    ves_figure_destroy(figure);
    app_shape_close(&shape);
    return code;
}
