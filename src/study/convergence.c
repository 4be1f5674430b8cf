#include "study/convergence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "output/chart.h"

/* The best is a stair with a step for each improvement. Of the accepted candidates there may be millions: each
 * `stride`-th is kept, and every second of these thrown away when the room is full. The axis shows most of them, not
 * the worst. */

enum { STEPS = 4096, SPECKS = 4000 };

static const double most_shown = 0.9, margin = 0.05; /* of the candidates; of the axis */

typedef struct convergence {
    double x[STEPS], y[STEPS];        /* the best */
    double at[SPECKS], value[SPECKS]; /* candidates */
    double sorted[SPECKS];
    int steps, specks;
    long seen, stride, evaluations;
} convergence;

static bool feasible(const ves_entries *e, const ves_entry *entry)
{
    if (entry->status != VES_OK || !isfinite(entry->value)) return false;
    for (int k = 0; k < e->m && entry->excess; k++) {
        double excess = e->equal[k] ? fabs(entry->excess[k]) : entry->excess[k];
        if (!(excess <= e->within[k])) return false;
    }
    return !e->m || entry->excess;
}

/* The last step is kept free for the right end of the axis; when the room is full it moves. */
static void step_take(convergence *c, const ves_entries *e, const ves_entry *entry)
{
    double last = c->steps ? c->y[c->steps - 1] : NAN;
    if (c->steps && !(e->maximize ? entry->value > last : entry->value < last)) return;
    int at = c->steps < STEPS - 1 ? c->steps++ : STEPS - 2;
    c->x[at] = (double)entry->evaluation;
    c->y[at] = entry->value;
}

static void speck_take(convergence *c, const ves_entry *entry)
{
    if (c->seen++ % c->stride) return;
    if (c->specks == SPECKS) {
        for (int k = 0; k < SPECKS / 2; k++) c->at[k] = c->at[2 * k], c->value[k] = c->value[2 * k];
        c->specks = SPECKS / 2;
        c->stride *= 2;
    }
    c->at[c->specks] = (double)entry->evaluation;
    c->value[c->specks++] = entry->value;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* From the best to what most candidates lie below, and to half of the steps of the stair at least. */
static ves_chart_axis axis_of(convergence *c, bool maximize)
{
    double best = c->y[c->steps - 1], worst = c->y[c->steps > 1 ? c->steps / 2 : 0];
    memcpy(c->sorted, c->value, (size_t)c->specks * sizeof *c->sorted);
    qsort(c->sorted, (size_t)c->specks, sizeof *c->sorted, ascending);
    if (c->specks) {
        double part = maximize ? 1 - most_shown : most_shown,
               typical = c->sorted[(int)(part * (c->specks - 1))];
        worst = maximize ? fmin(worst, typical) : fmax(worst, typical);
    }
    double room = margin * fabs(worst - best);
    if (!(room > 0)) room = fabs(best) > 0 ? margin * fabs(best) : 1;
    return (ves_chart_axis){.label = maximize ? "value (to be the largest)" : "value (to be the least)",
                            .low = fmin(best, worst) - room,
                            .high = fmax(best, worst) + room};
}

/* What lies beyond the axis is not drawn; a stair comes in from its end. */
static void fit(convergence *c, const ves_chart_axis *y)
{
    for (int k = 0; k < c->steps; k++) c->y[k] = fmin(y->high, fmax(y->low, c->y[k]));
    for (int k = 0; k < c->specks; k++)
        if (c->value[k] > y->high || c->value[k] < y->low) c->value[k] = NAN;
}

ves_status ves_convergence_write(ves_entries *e, const char *path, ves_arena *arena, ves_diag *diag)
{
    convergence *c = ves_arena_take(arena, 1, sizeof *c);
    if (!c) return ves_diag_fail(diag, VES_MEMORY);
    ves_entry entry;
    c->stride = 1;
    while (ves_entries_next(e, &entry)) {
        c->evaluations = entry.evaluation;
        if (!feasible(e, &entry)) continue;
        step_take(c, e, &entry);
        if (entry.accepted) speck_take(c, &entry);
    }
    if (!c->steps)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, (ves_mark){0},
                            "\"%s\" holds no feasible candidate: there is nothing to draw", e->path);
    ves_chart_axis y = axis_of(c, e->maximize);
    c->x[c->steps] = (double)c->evaluations;
    c->y[c->steps] = c->y[c->steps - 1];
    c->steps++;
    fit(c, &y);
    const ves_chart_line line[] = {
        {.name = "accepted", .count = c->specks, .x = c->at, .y = c->value, .mark = VES_MARK_SPECK},
        {.name = "best feasible", .count = c->steps, .x = c->x, .y = c->y, .stairs = true}};
    const ves_chart chart = {.title = e->path,
                             .x = {"evaluations", 1, fmax(2, (double)c->evaluations), true},
                             .y = y,
                             .lines = 2,
                             .line = line};
    return ves_chart_write(&chart, path, diag);
}
