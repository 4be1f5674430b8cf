#include "study/bench_gallery.h"

#include "base/diag.h"
#include "problem/problem.h"
#include "study/folder.h"
#include "study/gallery.h"

typedef struct hanging {
    const ves_bench *bench;
    ves_arena *arena;
    ves_diag *diag;
} hanging;

/* auto 9/15 */
static ves_status notes_make(const hanging *h, const ves_bench_optimum *optimum, ves_shown_design *design)
{
    const ves_suite *s = h->bench->suite;
    const char **note = ves_arena_take(h->arena, (size_t)s->methods, sizeof *note);
    if (!note) return VES_MEMORY;
    for (int e = 0; e < s->methods; e++) {
        if (!optimum->hits[e]) continue;
        int runs = h->bench->tally.score[e * s->problems + optimum->problem].runs;
        note[design->notes] =
            ves_arena_format(h->arena, "%s %d/%d", s->method[e].name, optimum->hits[e], runs);
        if (!note[design->notes++]) return VES_MEMORY;
    }
    design->note = note;
    return VES_OK;
}

/* As a run of the problem file tells it. */
static ves_status design_make(const hanging *h, const ves_bench_optimum *optimum, const ves_shown *shown,
                              ves_pose *pose, ves_shown_design *design)
{
    const ves_outcome *run = &h->bench->outcome[optimum->run];
    double value = h->bench->problem[optimum->problem].maximize ? -optimum->value : optimum->value;
    double *x = ves_arena_take(h->arena, (size_t)run->n, sizeof *x);
    char *caption = ves_shown_value(value, shown, h->arena);
    if (!x || !caption) return VES_MEMORY;
    ves_testbed_place(pose, run->x, x);
    *design = (ves_shown_design){.x = x, .caption = caption};
    return notes_make(h, optimum, design);
}

/* The ends first ... of one problem. */
static ves_status problem_draw(const hanging *h, ves_testbed *testbed, int first, int count)
{
    const int problem = h->bench->optimum[first].problem;
    ves_pose pose;
    ves_shown_design *design = ves_arena_take(h->arena, (size_t)count, sizeof *design);
    if (!design) return ves_diag_fail(h->diag, VES_MEMORY);
    char *path;
    VES_TRY(ves_folder_picture(h->bench->folder, "optima", h->bench->problem[problem].picture, h->arena,
                               &path, h->diag));
    ves_status status = ves_testbed_pose(testbed, 0, 0, h->arena, &pose);
    for (int k = 0; k < count && status == VES_OK; k++)
        status = design_make(h, &h->bench->optimum[first + k], &testbed->source->objective_shown, &pose,
                             &design[k]);
    if (status != VES_OK) return ves_diag_fail(h->diag, status);
    const ves_shown_designs shown = {testbed->problem->name, "end", "ends", count, design};
    return ves_designs_draw(testbed->plan[0], &shown, path, h->diag);
}

ves_status ves_bench_gallery_write(const ves_bench *bench, ves_testbed *testbed, ves_diag *diag)
{
    ves_arena arena = {0};
    const hanging h = {bench, &arena, diag};
    ves_status status = VES_OK;
    for (int first = 0, end; first < bench->optima && status == VES_OK; first = end) {
        int problem = bench->optimum[first].problem;
        for (end = first; end < bench->optima && bench->optimum[end].problem == problem;) end++;
        if (bench->suite->problem[problem].kind == VES_SUITE_FILE)
            status = problem_draw(&h, &testbed[problem], first, end - first);
    }
    ves_arena_destroy(&arena);
    return status;
}
