#include "study/sweep_gallery.h"

#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "output/gallery.h"
#include "study/design.h"
#include "study/folder.h"
#include "study/sweep_report.h"

enum { COLUMNS = 8, ROWS = VES_GALLERY_SMALL / COLUMNS };

typedef struct hanging {
    const ves_sweep_task *task;
    ves_gallery gallery;
    ves_gallery_item item[VES_GALLERY_SMALL];
    ves_figure *figure[VES_GALLERY_SMALL];
    int cell[VES_GALLERY_SMALL];
    ves_arena arena;
} hanging;

/* k of `count`, spread evenly over 0 ... all - 1. */
static int spread(int k, int count, int all)
{
    return count > 1 ? (int)(((long)k * (all - 1) + (count - 1) / 2) / (count - 1)) : 0;
}

/* The kind, if the file names them, and the objective. */
static bool words_make(hanging *h, int index, ves_gallery_item *item)
{
    const ves_sweep *s = h->task->sweep;
    const ves_shown *shown = &s->problem->objective_shown;
    const double value = s->point[index].column[s->first[VES_SWEEP_OBJECTIVE]];
    const char **note = ves_arena_take(&h->arena, 2, sizeof *note);
    char first[VES_QUANTITY], second[VES_QUANTITY] = "";
    ves_sweep_text(s, 0, ves_sweep_place(s, index), first);
    if (s->def->axes > 1) ves_sweep_text(s, 1, s->walk[index / s->count].second, second);
    item->caption = ves_arena_format(&h->arena, "%s%s%s", second, *second ? ", " : "", first);
    item->note = note;
    if (!note || !item->caption) return false;
    if (s->problem->kinds) note[item->notes++] = ves_design_kind(s->problem, s->point[index].kind);
    if (!isfinite(value)) return true;
    note[item->notes] =
        ves_arena_format(&h->arena, "%.6g%s%s", value / shown->factor, *shown->unit ? " " : "", shown->unit);
    return note[item->notes++];
}

static ves_status shape_hang(hanging *h, int index, int cell)
{
    ves_gallery *g = &h->gallery;
    ves_gallery_item *item = &h->item[g->items];
    ves_figure **figure = &h->figure[g->items];
    ves_status status = ves_sweep_point_figure(h->task, index, figure);
    if (!*figure) return status < VES_OK ? status : VES_OK;
    *item = (ves_gallery_item){.figure = *figure};
    h->cell[g->items++] = cell;
    return words_make(h, index, item) ? VES_OK : VES_MEMORY;
}

static ves_status row_hang(hanging *h, int second, int row)
{
    const ves_sweep *s = h->task->sweep;
    int *best = ves_arena_take(&h->arena, (size_t)s->count, sizeof *best), bests = 0;
    if (!best) return VES_MEMORY;
    for (int place = 0; place < s->count; place++) {
        best[bests] = ves_sweep_best_at(s, second, place);
        bests += best[bests] >= 0;
    }
    const int count = bests < COLUMNS ? bests : COLUMNS;
    for (int k = 0; k < count; k++)
        VES_TRY(shape_hang(h, best[spread(k, count, bests)], row * h->gallery.columns + k));
    return VES_OK;
}

static ves_status rows_hang(hanging *h)
{
    const ves_sweep *s = h->task->sweep;
    const int seconds = s->def->axes > 1 ? s->def->axis[1].count : 1, rows = seconds < ROWS ? seconds : ROWS;
    for (int row = 0; row < rows; row++) VES_TRY(row_hang(h, spread(row, rows, seconds), row));
    return VES_OK;
}

ves_status ves_sweep_gallery_write(const ves_sweep_task *task, ves_diag *diag)
{
    const ves_sweep *s = task->sweep;
    hanging h = {.task = task};
    h.gallery = (ves_gallery){.title = s->problem->title,
                              .item = h.item,
                              .cell = h.cell,
                              .columns = s->count < COLUMNS ? s->count : COLUMNS,
                              .cut = true};
    char *path = ves_folder_path(s->folder, "shapes.png", &h.arena);
    ves_status status = path ? rows_hang(&h) : VES_MEMORY;
    if (status < VES_OK)
        ves_diag_fail(diag, status);
    else if (h.gallery.items)
        status = ves_gallery_write(&h.gallery, path, diag);
    for (int k = 0; k < h.gallery.items; k++) ves_figure_destroy(h.figure[k]);
    ves_arena_destroy(&h.arena);
    return status;
}
