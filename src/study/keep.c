#include "study/keep.h"

#include <string.h>
#include <unistd.h>

#include "base/diag.h"
#include "output/file.h"
#include "output/output.h"
#include "study/annealing.h"
#include "study/apart.h"
#include "study/design.h"
#include "study/folder.h"
#include "study/gallery.h"
#include "study/result.h"

enum { MESSAGE = 4096 };

typedef struct keeper {
    const ves_run *run;
    ves_plan *plan;
    ves_arena *arena; /* for paths */
    ves_diag *diag;
} keeper;

/* One whole file of text, written by `fill`. */
static ves_status text_write(const keeper *k, const char *name, const char *ending,
                             void (*fill)(const keeper *, FILE *))
{
    ves_file file;
    char *path = ves_folder_path(k->run->folder, name, k->arena);
    if (!path) return ves_diag_fail(k->diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, ending, k->diag));
    fill(k, file.out);
    return ves_file_end(&file, VES_OK, k->diag);
}

static void put(FILE *out, const char *text)
{
    fwrite(text, 1, strlen(text), out);
}

static void fill_problem(const keeper *k, FILE *out)
{
    put(out, k->run->problem->text);
}

static void fill_result(const keeper *k, FILE *out)
{
    ves_json json = {.out = out};
    ves_json_object(&json, NULL);
    ves_result_write(k->run, &json);
    ves_json_end(&json, '}');
}

static void fill_times(const keeper *k, FILE *out)
{
    ves_json json = {.out = out};
    ves_json_object(&json, NULL);
    ves_result_times(k->run, &json);
    ves_json_end(&json, '}');
}

static void line(FILE *out, const char *label, const char *text)
{
    put(out, label);
    put(out, text);
    put(out, "\n");
}

/* Was the sentence a warning too? */
static bool is_said(const ves_diag *diag, const char *sentence)
{
    char text[MESSAGE];
    for (int i = 0; i < ves_diag_count(diag); i++) {
        ves_diag_text(diag, i, text, sizeof text);
        if (strstr(text, sentence)) return true;
    }
    return false;
}

static void fill_log(const keeper *k, FILE *out)
{
    const ves_run *run = k->run;
    char text[MESSAGE];
    line(out, run->problem->path, "");
    line(out, "started ", run->times.started);
    snprintf(text, sizeof text, "seed %llu, %d job%s, %d x %d nodes a patch, %ld evaluation%s",
             (unsigned long long)run->seed, run->jobs, run->jobs == 1 ? "" : "s", run->quadrature[0],
             run->quadrature[1], run->evaluations, run->evaluations == 1 ? "" : "s");
    line(out, text, "");
    for (int i = 0; i < ves_diag_count(k->diag); i++) {
        ves_diag_text(k->diag, i, text, sizeof text);
        line(out, text, "");
    }
    for (int i = 0; i < run->notes; i++)
        if (!is_said(k->diag, run->note[i])) line(out, "note: ", run->note[i]);
    line(out, "stopped: ", run->stop);
}

ves_status ves_keep_problem(const ves_run *run, ves_arena *arena, ves_diag *diag)
{
    keeper k = {.run = run, .arena = arena, .diag = diag};
    return text_write(&k, "problem.yaml", "yaml", fill_problem);
}

static ves_status shape_write(const keeper *k, ves_figure *figure, const char *name)
{
    char *path = ves_folder_path(k->run->folder, name, k->arena);
    return path ? ves_format_find("vtp")->write(figure, path, k->diag) : ves_diag_fail(k->diag, VES_MEMORY);
}

static ves_status picture_write(const keeper *k, ves_figure *figure)
{
    ves_view view = ves_view_default();
    char *path = ves_folder_path(k->run->folder, "best.png", k->arena);
    return path ? ves_picture_write(figure, &view, path, k->diag) : ves_diag_fail(k->diag, VES_MEMORY);
}

/* The shape of one design; nothing for one that has no shape. */
static ves_status figure_write(const keeper *k, const ves_design *design, const char *name, bool picture)
{
    ves_figure *figure;
    if (design->status != VES_OK) return VES_OK;
    VES_TRY(ves_plan_figure(k->plan, design->x, 0, 0, &figure, k->diag));
    ves_status status = shape_write(k, figure, name);
    if (status == VES_OK && picture) status = picture_write(k, figure);
    ves_figure_destroy(figure);
    return status;
}

/* As the screen lists them; the best is told apart from the second, that it can be compared. */
static ves_status optimum_show(const keeper *k, int index, ves_shown_design *design)
{
    const ves_optimum *o = &k->run->optimum[index];
    char apart[VES_APART][VES_APART_TEXT];
    const int told = ves_apart_tell(k->run, index, index ? 0 : 1, apart);
    const char **note = ves_arena_take(k->arena, 3 + VES_APART, sizeof *note);
    char *value = ves_shown_value(o->value, &k->run->problem->objective_shown, k->arena);
    int notes = 0;
    if (!note || !value) return VES_MEMORY;
    note[notes++] = ves_arena_format(k->arena, o->hits == 1 ? "found once" : "found %d times", o->hits);
    if (k->run->problem->kinds) note[notes++] = ves_design_kind(k->run->problem, k->run->optimum_kind[index]);
    if (o->saddle) note[notes++] = "a saddle";
    for (int i = 0; i < told; i++) note[notes++] = ves_arena_text(k->arena, apart[i], strlen(apart[i]));
    for (int i = 0; i < notes; i++)
        if (!note[i]) return VES_MEMORY;
    *design = (ves_shown_design){.x = o->x, .caption = value, .note = note, .notes = notes};
    return VES_OK;
}

/* Several only: one is best.png. A run that was interrupted may have seen more, and left a picture. */
static ves_status optima_write(const keeper *k)
{
    const ves_run *run = k->run;
    char *path = ves_folder_path(run->folder, "optima.png", k->arena);
    ves_shown_design *design = ves_arena_take(k->arena, (size_t)run->optima, sizeof *design);
    if (!path || !design) return ves_diag_fail(k->diag, VES_MEMORY);
    unlink(path);
    if (run->optima < 2) return VES_OK;
    for (int i = 0; i < run->optima; i++)
        if (optimum_show(k, i, &design[i]) != VES_OK) return ves_diag_fail(k->diag, VES_MEMORY);
    const ves_shown_designs shown = {run->problem->title, "optimum", "optima", run->optima, design};
    return ves_designs_draw(k->plan, &shown, path, k->diag);
}

static ves_status annealing_write(const keeper *k)
{
    char *path = ves_folder_path(k->run->folder, "annealing.png", k->arena);
    if (!path) return ves_diag_fail(k->diag, VES_MEMORY);
    return ves_annealing_seen(k->run) ? ves_annealing_draw(k->run, path, k->arena, k->diag) : VES_OK;
}

ves_status ves_keep_result(const ves_run *run, ves_plan *plan, ves_arena *arena, ves_diag *diag)
{
    keeper k = {run, plan, arena, diag};
    ves_status status[] = {
        text_write(&k, "result.json", "json", fill_result),
        text_write(&k, "times.json", "json", fill_times),
        figure_write(&k, &run->start, "start.vtp", false),
        run->any ? figure_write(&k, &run->best, "best.vtp", true) : VES_OK,
        optima_write(&k),
        annealing_write(&k),
        VES_OK,
    };
    enum { LOG = sizeof status / sizeof *status - 1 };
    status[LOG] = text_write(&k, "log.txt", "txt", fill_log);
    for (int i = 0; i <= LOG; i++)
        if (status[i] < VES_OK) return status[i];
    return VES_OK;
}
