/* sweep.png: the objective over the first parameter. Where there are branches, a panel for each value of the second
 * parameter and a colour for each branch; else one panel, and a colour for each value. */
#include <math.h>
#include <stdlib.h>

#include "base/diag.h"
#include "output/chart.h"
#include "study/folder.h"
#include "study/sweep_report.h"

enum { PANELS = 24, PANEL = 440 };

typedef struct drawer {
    const ves_sweep *sweep;
    double factor; /* of the first parameter */
    ves_arena arena;
    ves_diag *diag;
} drawer;

static int seconds_of(const ves_sweep *s)
{
    return s->def->axes > 1 ? s->def->axis[1].count : 1;
}

/* One for each value of the second parameter? */
static bool is_split(const ves_sweep *s)
{
    return s->def->branches && seconds_of(s) > 1 && seconds_of(s) <= PANELS;
}

static bool is_shown(const ves_sweep *s, int walk, int panel)
{
    return !is_split(s) || s->walk[walk].second == panel;
}

static bool number_of(const ves_sweep *s, int index, double *y)
{
    const ves_sweep_point *point = &s->point[index];
    *y =
        point->done ? point->column[s->first[VES_SWEEP_OBJECTIVE]] / s->problem->objective_shown.factor : NAN;
    return isfinite(*y);
}

/* Room around what is good, or, where nothing is, around what there is; false: nothing to show. */
static bool height_find(const ves_sweep *s, int panel, ves_chart_axis *axis)
{
    double low = INFINITY, high = -INFINITY, y;
    for (int good = 1; good >= 0 && low > high; good--)
        for (int k = 0; k < s->walks * s->count; k++)
            if (is_shown(s, k / s->count, panel) && number_of(s, k, &y) && (s->point[k].good || !good))
                low = fmin(low, y), high = fmax(high, y);
    if (low > high) return false;
    double room = high > low ? 0.05 * (high - low) : fmax(0.05 * fabs(high), 1e-6);
    axis->low = low - room;
    axis->high = high + room;
    return true;
}

static bool good_at(const ves_sweep *s, int walk, int place, double *y)
{
    const int index = ves_sweep_point_at(s, walk, place);
    return number_of(s, index, y) && s->point[index].good;
}

static bool line_make(drawer *d, int walk, ves_chart_line *line)
{
    const ves_sweep *s = d->sweep;
    const ves_sweep_walk *w = &s->walk[walk];
    double *x = ves_arena_take(&d->arena, (size_t)s->count, sizeof *x);
    double *y = ves_arena_take(&d->arena, (size_t)s->count, sizeof *y);
    const char *way = s->def->forth && s->def->back ? ves_sweep_direction(s, w->back) : "";
    const char *name = *w->name ? w->name : "best";
    if (is_split(s))
        name = ves_arena_format(&d->arena, *way ? "%s, %s" : "%s", s->def->branch[w->branch].name, way);
    if (!x || !y || !name) return false;
    for (int k = 0; k < s->count; k++) {
        x[k] = s->def->axis[0].value[k] / d->factor;
        if (!good_at(s, walk, k, &y[k])) y[k] = NAN;
    }
    const bool paired = is_split(s) || !s->def->branches || seconds_of(s) == 1;
    *line = (ves_chart_line){.name = name,
                             .count = s->count,
                             .x = x,
                             .y = y,
                             .mark = VES_MARK_DOT,
                             .dashed = paired && w->back && s->def->forth,
                             .colour = paired ? 1 + (s->def->branches ? w->branch : w->second) : 0};
    return true;
}

/* Where no walk of the panel has a good point: its objective, if it has one that can be shown, else the floor. */
static int lost_fill(const drawer *d, int panel, const ves_chart_axis *axis, double *x, double *y)
{
    const ves_sweep *s = d->sweep;
    int count = 0;
    for (int k = 0; k < s->walks * s->count; k++) {
        const int place = ves_sweep_place(s, k);
        double any;
        bool held = !is_shown(s, k / s->count, panel) || !s->point[k].done;
        for (int w = 0; w < s->walks && !held; w++)
            held = is_shown(s, w, panel) && s->walk[w].second == s->walk[k / s->count].second &&
                   good_at(s, w, place, &any);
        if (held) continue;
        x[count] = s->def->axis[0].value[place] / d->factor;
        if (!number_of(s, k, &y[count]) || y[count] < axis->low || y[count] > axis->high)
            y[count] = axis->low;
        count++;
    }
    return count;
}

/* How far branches were followed; the objective there is not kept: on the straight line through the last two points. */
static int ends_fill(const drawer *d, int panel, double *x, double *y)
{
    const ves_sweep *s = d->sweep;
    const double *value = s->def->axis[0].value;
    int count = 0;
    for (int k = 1; k < s->walks * s->count; k++) {
        const ves_sweep_point *point = &s->point[k];
        double near, far;
        if (k % s->count == 0 || !is_shown(s, k / s->count, panel) || !point->done || point->good) continue;
        if (!isfinite(point->reached) || !s->point[k - 1].good || !number_of(s, k - 1, &near)) continue;
        const double from = value[ves_sweep_place(s, k - 1)];
        x[count] = point->reached / d->factor;
        y[count] = near;
        if (k % s->count > 1 && s->point[k - 2].good && number_of(s, k - 2, &far))
            y[count] += (near - far) * (point->reached - from) / (from - value[ves_sweep_place(s, k - 2)]);
        count++;
    }
    return count;
}

static int compare(const void *a, const void *b)
{
    const double x = ((const ves_chart_guide *)a)->x, y = ((const ves_chart_guide *)b)->x;
    return (x > y) - (x < y);
}

/* Where the best goes over from one walk to another; but once where several do, as far as can be told apart. */
static bool guides_make(drawer *d, int panel, ves_chart *chart)
{
    const ves_sweep *s = d->sweep;
    const double grain = 1e-5 * (chart->x.high - chart->x.low);
    ves_chart_guide *guide = ves_arena_take(&d->arena, (size_t)(seconds_of(s) * s->count), sizeof *guide);
    ves_sweep_change c;
    int found = 0;
    if (!guide) return false;
    for (int j = 0; j < seconds_of(s); j++)
        for (int place = 0; ves_sweep_change_find(s, j, place, &c); place = c.next)
            if ((!is_split(s) || j == panel) && isfinite(c.at)) guide[found++].x = c.at / d->factor;
    qsort(guide, (size_t)found, sizeof *guide, compare);
    for (int k = 0; k < found; k++) {
        const double x = fabs(guide[k].x) < grain ? 0 : guide[k].x;
        if (chart->guides && x - guide[chart->guides - 1].x < grain) continue;
        char *name = ves_arena_format(&d->arena, "%.4g", x);
        if (!name) return false;
        guide[chart->guides++] = (ves_chart_guide){.name = name, .x = x};
    }
    chart->guide = guide;
    return true;
}

static bool lines_make(drawer *d, int panel, ves_chart *chart)
{
    const ves_sweep *s = d->sweep;
    const size_t points = (size_t)(s->walks * s->count);
    ves_chart_line *line = ves_arena_take(&d->arena, (size_t)s->walks + 2, sizeof *line);
    double *at[4];
    for (int k = 0; k < 4; k++)
        if (!(at[k] = ves_arena_take(&d->arena, points, sizeof **at))) return false;
    if (!line) return false;
    for (int w = 0; w < s->walks; w++)
        if (is_shown(s, w, panel) && !line_make(d, w, &line[chart->lines++])) return false;
    int count = ends_fill(d, panel, at[0], at[1]);
    if (count)
        line[chart->lines++] = (ves_chart_line){
            .name = "followed to here", .count = count, .x = at[0], .y = at[1], .mark = VES_MARK_RING};
    count = lost_fill(d, panel, &chart->y, at[2], at[3]);
    if (count)
        line[chart->lines++] =
            (ves_chart_line){.name = "lost", .count = count, .x = at[2], .y = at[3], .mark = VES_MARK_CROSS};
    chart->line = line;
    return true;
}

static bool words_make(drawer *d, int panel, bool first, ves_chart *chart)
{
    const ves_sweep *s = d->sweep;
    const ves_sweep_axis *axis = &s->def->axis[0];
    const ves_shown *shown = &s->problem->parameter[axis->parameter].shown,
                    *of = &s->problem->objective_shown;
    char second[VES_QUANTITY] = "";
    if (is_split(s)) ves_sweep_text(s, 1, panel, second);
    chart->title = ves_arena_format(&d->arena, "%s%s%s", first && s->problem->title ? s->problem->title : "",
                                    first && *second ? ": " : "", second);
    chart->x.label = ves_arena_format(&d->arena, *shown->unit ? "%s [%s]" : "%s", axis->name, shown->unit);
    chart->y.label =
        ves_arena_format(&d->arena, *of->unit ? "%s [%s]" : "%s", s->problem->objective_text, of->unit);
    return chart->title && chart->x.label && chart->y.label;
}

static void width_find(const drawer *d, ves_chart_axis *x)
{
    const ves_sweep_axis *axis = &d->sweep->def->axis[0];
    const double a = axis->value[0] / d->factor, b = axis->value[axis->count - 1] / d->factor;
    const double room = a == b ? fmax(0.05 * fabs(a), 1e-6) : 0;
    x->low = fmin(a, b) - room;
    x->high = fmax(a, b) + room;
}

static ves_status charts_write(drawer *d, const char *path)
{
    ves_chart chart[PANELS];
    int charts = 0, panels = is_split(d->sweep) ? seconds_of(d->sweep) : 1;
    for (int panel = 0; panel < panels; panel++) {
        ves_chart *c = &chart[charts];
        *c = (ves_chart){.height = panels > 1 ? PANEL : 0};
        if (!height_find(d->sweep, panel, &c->y)) continue;
        width_find(d, &c->x);
        if (!words_make(d, panel, !charts, c) || !lines_make(d, panel, c) || !guides_make(d, panel, c))
            return ves_diag_fail(d->diag, VES_MEMORY);
        charts++;
    }
    return charts ? ves_charts_write(chart, charts, path, d->diag) : VES_OK;
}

ves_status ves_sweep_chart_write(const ves_sweep *sweep, ves_diag *diag)
{
    const ves_problem *p = sweep->problem;
    drawer d = {
        .sweep = sweep, .factor = p->parameter[sweep->def->axis[0].parameter].shown.factor, .diag = diag};
    char *path = ves_folder_path(sweep->folder, "sweep.png", &d.arena);
    ves_status status = path ? charts_write(&d, path) : ves_diag_fail(diag, VES_MEMORY);
    ves_arena_destroy(&d.arena);
    return status;
}
