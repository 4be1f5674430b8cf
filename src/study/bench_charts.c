#include "study/bench_charts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "output/chart.h"
#include "study/folder.h"
#include "suite/profile.h"

enum { NAME = 200 };

static const double least = 1e-10; /* what a convergence chart shows a gap of 0 as */

typedef struct charts {
    const ves_bench *bench;
    const ves_tally_input *input;
    ves_arena arena;
    ves_diag *diag;
    int room;             /* points of a line */
    ves_chart_line *line; /* [methods] */
    double *x, *y;        /* [methods][room] */
} charts;

static ves_status write(charts *c, const ves_chart *chart, const char *name)
{
    char *path = ves_folder_path(c->bench->folder, name, &c->arena);
    return path ? ves_chart_write(chart, path, c->diag) : ves_diag_fail(c->diag, VES_MEMORY);
}

/* The name in the legend; a method that draws no line says why. */
static const char *name_of(charts *c, int method, bool drawn, const char *why)
{
    const char *name = c->bench->suite->method[method].name;
    const char *noted = drawn ? name : ves_arena_format(&c->arena, "%s (%s)", name, why);
    return noted ? noted : name;
}

/* Stairs go from 0 at the left end of the axis to the right end. */
static void line_close(charts *c, int e, int count, const ves_chart_axis *axis)
{
    double *x = c->x + (size_t)e * c->room, *y = c->y + (size_t)e * c->room;
    memmove(x + 1, x, (size_t)count * sizeof *x);
    memmove(y + 1, y, (size_t)count * sizeof *y);
    x[0] = axis->low;
    y[0] = 0;
    x[count + 1] = axis->high;
    y[count + 1] = y[count];
    c->line[e] = (ves_chart_line){
        .name = name_of(c, e, count > 0, "none"), .count = count + 2, .x = x, .y = y, .stairs = true};
}

/* The largest budget, for each variable or for n + 1. */
static double right_end(const charts *c, int more)
{
    const ves_suite *s = c->bench->suite;
    double most = 2;
    for (int p = 0; p < s->problems; p++)
        most = fmax(most, ves_suite_budget(s, c->input->n[p]) / (c->input->n[p] + more));
    return most;
}

static ves_status ecdf(charts *c)
{
    const ves_suite *s = c->bench->suite;
    ves_chart chart = {.title = s->title,
                       .x = {"cost units for each variable", 0.1, right_end(c, 0), true},
                       .y = {"share of (problem, target, run) solved", 0, 1, false},
                       .lines = s->methods,
                       .line = c->line};
    for (int e = 0; e < s->methods; e++) {
        size_t at = (size_t)e * c->room;
        int count = ves_profile_ecdf(c->input, &c->bench->tally, e, c->x + at, c->y + at);
        line_close(c, e, count, &chart.x);
    }
    return write(c, &chart, "ecdf.png");
}

static ves_status profile(charts *c, double tau, const char *name)
{
    const ves_suite *s = c->bench->suite;
    char label[NAME];
    snprintf(label, sizeof label, "share of runs at f <= f_L + %g (f_0 - f_L)", tau);
    ves_chart chart = {.title = s->title,
                       .x = {"cost units over (variables + 1)", 0.1, right_end(c, 1), true},
                       .y = {label, 0, 1, false},
                       .lines = s->methods,
                       .line = c->line};
    for (int e = 0; e < s->methods; e++) {
        size_t at = (size_t)e * c->room;
        line_close(c, e, ves_profile_data(c->input, &c->bench->tally, e, tau, c->x + at, c->y + at),
                   &chart.x);
    }
    return write(c, &chart, name);
}

static ves_status convergence(charts *c, int problem)
{
    const ves_suite *s = c->bench->suite;
    ves_profile_band *band = ves_arena_take(&c->arena, (size_t)s->methods, sizeof *band);
    char *path;
    if (!band) return ves_diag_fail(c->diag, VES_MEMORY);
    double high = 10 * least, low = INFINITY;
    for (int e = 0; e < s->methods; e++) {
        if (!ves_profile_convergence(c->input, &c->bench->tally, e, problem, least, &band[e]))
            return ves_diag_fail(c->diag, VES_MEMORY);
        bool drawn = false;
        for (int k = 0; k < VES_PROFILE_POINTS; k++) {
            drawn = drawn || isfinite(band[e].y[k]);
            if (isfinite(band[e].y[k])) high = fmax(high, band[e].y[k]), low = fmin(low, band[e].y[k]);
            if (isfinite(band[e].low[k])) low = fmin(low, band[e].low[k]);
        }
        c->line[e] = (ves_chart_line){.name = name_of(c, e, drawn, "infeasible"),
                                      .count = VES_PROFILE_POINTS,
                                      .x = band[e].x,
                                      .y = band[e].y,
                                      .low = band[e].low,
                                      .high = band[e].high,
                                      .stairs = true};
    }
    VES_TRY(ves_folder_picture(c->bench->folder, "convergence", c->bench->problem[problem].picture, &c->arena,
                               &path, c->diag));
    double bottom = pow(10, floor(log10(fmin(low, high / 10)))), top = pow(10, ceil(log10(high)));
    const ves_chart chart = {
        .title = s->problem[problem].name,
        .x = {"cost units", 1, fmax(ves_suite_budget(s, c->input->n[problem]), 2), true},
        .y = {"best feasible value minus the reference (1e-10: there, or below): median, quartiles", bottom,
              top, true},
        .lines = s->methods,
        .line = c->line};
    return ves_chart_write(&chart, path, c->diag);
}

static ves_status all(charts *c)
{
    static const struct {
        double tau;
        const char *name;
    } profiles[] = {{1e-1, "profile-1e-1.png"}, {1e-3, "profile-1e-3.png"}, {1e-5, "profile-1e-5.png"}};
    VES_TRY(ecdf(c));
    for (int k = 0; k < 3; k++) VES_TRY(profile(c, profiles[k].tau, profiles[k].name));
    for (int p = 0; p < c->bench->suite->problems; p++) VES_TRY(convergence(c, p));
    return VES_OK;
}

ves_status ves_bench_charts_write(const ves_bench *bench, const ves_tally_input *input, ves_diag *diag)
{
    const ves_suite *s = bench->suite;
    charts c = {.bench = bench, .input = input, .diag = diag};
    c.room = s->problems * s->seeds * VES_PROFILE_TARGETS + 2;
    size_t points = (size_t)c.room * (size_t)s->methods;
    c.line = ves_arena_take(&c.arena, (size_t)s->methods, sizeof *c.line);
    c.x = ves_arena_take(&c.arena, points, sizeof *c.x);
    c.y = ves_arena_take(&c.arena, points, sizeof *c.y);
    ves_status status = c.line && c.x && c.y ? all(&c) : ves_diag_fail(diag, VES_MEMORY);
    ves_arena_destroy(&c.arena);
    return status;
}
