#include "study/annealing.h"

#include <math.h>
#include <stdlib.h>

#include "base/diag.h"
#include "output/chart.h"
#include "problem/problem.h"

/* Both curves go through the temperatures of the log, each point the mean over a factor of VES_HEAT_REACH both ways and over
 * all legs, as the report has it; specks are the lines of the log as they are. */

/* MOST: annealings on a sheet, the first and the last ones; UPPER, LOWER: pixels */
enum { POINTS = 250, FEW = 40, PANELS = 2, GUIDES = 2, MOST = 6, UPPER = 300, LOWER = 380 };

/* The axis ends above the highest point; without a peak at so many times n / 2 at most. */
static const double above = 1.15, wells = 6;

/* One annealing. */
typedef struct history {
    const ves_run *run;
    int index;
    ves_shown shown; /* the unit of the objective, which is that of temperatures */
    int points;
    double *c, *x;               /* [points] temperatures, rising; in that unit */
    double *rate[VES_MOVES + 1]; /* [points] accepted of the tried: all, then each proposal */
    double *heat;                /* [points] */
    int specks;
    double *at, *raw;       /* [specks] lines of the log, as they are */
    double *scratch;        /* [temperatures] */
    double end[2], well[2]; /* of the axis; n / 2 */
    ves_chart_line upper[VES_MOVES + 1], lower[3];
    ves_chart_guide guide[PANELS * GUIDES];
} history;

static bool belongs(const ves_run *run, int line, int index)
{
    const ves_temperature *t = &run->temperature[line];
    return t->annealing == index && t->trials > 0 && t->c > 0 && isnormal(t->c);
}

/* Two temperatures at least. */
static bool has_curve(const ves_run *run, int index)
{
    double c = NAN;
    for (int k = 0; k < run->temperatures; k++) {
        if (!belongs(run, k, index)) continue;
        if (!isnan(c) && run->temperature[k].c != c) return true;
        c = run->temperature[k].c;
    }
    return false;
}

bool ves_annealing_seen(const ves_run *run)
{
    for (int k = 0; k < run->annealings; k++)
        if (has_curve(run, k)) return true;
    return false;
}

static int rising(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of all proposals (0) or one of them. */
static double rate_near(const history *h, int which, double c)
{
    long trials = 0, accepted = 0;
    for (int k = 0; k < h->run->temperatures; k++) {
        const ves_temperature *t = &h->run->temperature[k];
        if (!belongs(h->run, k, h->index) || t->c < c / VES_HEAT_REACH || t->c > c * VES_HEAT_REACH) continue;
        trials += which ? t->move[which - 1].trials : t->trials;
        accepted += which ? t->move[which - 1].accepted : t->accepted;
    }
    return trials ? (double)accepted / (double)trials : NAN;
}

static double heat_near(const history *h, double c)
{
    return ves_heat_capacity(h->run->temperature, h->run->temperatures, h->index, c / VES_HEAT_REACH,
                             c * VES_HEAT_REACH, h->scratch);
}

/* The temperatures of the log, each once, rising; where there are too many only some, the ends always. */
static void points_choose(history *h)
{
    const ves_run *run = h->run;
    int count = 0, all = 0;
    for (int k = 0; k < run->temperatures; k++)
        if (belongs(run, k, h->index)) h->scratch[all++] = run->temperature[k].c;
    qsort(h->scratch, (size_t)all, sizeof *h->scratch, rising);
    for (int k = 0; k < all; k++)
        if (!k || h->scratch[k] != h->scratch[count - 1]) h->scratch[count++] = h->scratch[k];
    h->points = count < POINTS ? count : POINTS;
    for (int k = 0; k < h->points; k++) h->c[k] = h->scratch[(int)((long)k * (count - 1) / (h->points - 1))];
}

static void curves_find(history *h)
{
    points_choose(h);
    for (int k = 0; k < h->points; k++) {
        h->x[k] = h->c[k] / h->shown.factor;
        h->heat[k] = heat_near(h, h->c[k]);
        for (int j = 0; j <= VES_MOVES; j++) h->rate[j][k] = rate_near(h, j, h->c[k]);
    }
    for (int k = 0; k < h->run->temperatures; k++) {
        const ves_temperature *t = &h->run->temperature[k];
        if (!belongs(h->run, k, h->index)) continue;
        h->at[h->specks] = t->c / h->shown.factor;
        h->raw[h->specks++] = t->variance / (t->c * t->c);
    }
}

static bool history_init(history *h, const ves_run *run, int index, ves_arena *arena)
{
    const size_t lines = (size_t)run->temperatures;
    *h = (history){.run = run, .index = index, .shown = run->problem->objective_shown};
    double **const room[] = {&h->c, &h->x, &h->heat, &h->at, &h->raw, &h->scratch};
    bool all = true;
    for (size_t k = 0; k < sizeof room / sizeof *room; k++)
        all = (*room[k] = ves_arena_take(arena, lines, sizeof(double))) && all;
    for (int j = 0; j <= VES_MOVES; j++)
        all = (h->rate[j] = ves_arena_take(arena, lines, sizeof(double))) && all;
    if (all) curves_find(h);
    return all;
}

static ves_chart upper_chart(history *h, const ves_chart_axis *x)
{
    const ves_annealing_report *r = &h->run->annealing[h->index];
    const ves_chart_mark mark = h->points < FEW ? VES_MARK_DOT : VES_MARK_NONE;
    for (int j = 0; j <= r->moves; j++)
        h->upper[j] = (ves_chart_line){.name = j               ? r->move[j - 1]
                                               : r->moves == 1 ? r->move[0]
                                                               : "all proposals",
                                       .count = h->points,
                                       .x = h->x,
                                       .y = h->rate[j],
                                       .mark = mark};
    return (ves_chart){.x = *x,
                       .y = {"share accepted", 0, 1, false},
                       .lines = r->moves > 1 ? r->moves + 1 : 1,
                       .line = h->upper,
                       .height = UPPER};
}

/* What matters: the curve where nothing is frozen, and n / 2. Of chains that are no more in equilibrium, variance / T^2
 * may be anything: that leaves the chart. So does what is no peak: it would press the level of a well to the floor. */
static double highest(const history *h, double well)
{
    const ves_annealing_report *r = &h->run->annealing[h->index];
    double most = well, low = fmin(r->freezing, r->peak);
    for (int k = 0; k < h->points; k++)
        if ((isnan(low) || h->c[k] >= low) && isfinite(h->heat[k])) most = fmax(most, h->heat[k]);
    return isnan(r->peak) ? fmin(most, wells * well) : most;
}

static ves_chart lower_chart(history *h, const ves_chart_axis *x)
{
    const ves_chart_mark mark = h->points < FEW ? VES_MARK_DOT : VES_MARK_NONE;
    const double well = h->run->problem->variables / 2.0, most = highest(h, well);
    h->end[0] = x->low, h->end[1] = x->high;
    h->well[0] = h->well[1] = well;
    for (int k = 0; k < h->specks; k++)
        if (h->raw[k] > above * most) h->raw[k] = NAN;
    h->lower[0] =
        (ves_chart_line){.name = "smoothed", .count = h->points, .x = h->x, .y = h->heat, .mark = mark};
    h->lower[1] = (ves_chart_line){
        .name = "each temperature", .count = h->specks, .x = h->at, .y = h->raw, .mark = VES_MARK_SPECK};
    h->lower[2] = (ves_chart_line){.name = "n / 2, a single well", .count = 2, .x = h->end, .y = h->well};
    return (ves_chart){.x = *x,
                       .y = {"heat capacity, variance / T^2", 0, above * most, false},
                       .lines = 3,
                       .line = h->lower,
                       .height = LOWER};
}

/* In both charts; the words in the lower one. */
static bool guides_set(history *h, ves_chart panel[PANELS], ves_arena *arena)
{
    const ves_annealing_report *r = &h->run->annealing[h->index];
    const double peak = r->peak / h->shown.factor, freezing = r->freezing / h->shown.factor;
    char *peaks = ves_arena_format(arena, "peak, %.3g", peak);
    char *freezes = ves_arena_format(arena, "frozen below %.3g", freezing);
    const bool behind = !(peak < freezing); /* as a rule; a later leg may freeze above the peak */
    for (int k = 0; k < PANELS; k++) {
        h->guide[k * GUIDES + behind] = (ves_chart_guide){k ? peaks : NULL, peak, !behind};
        h->guide[k * GUIDES + !behind] = (ves_chart_guide){k ? freezes : NULL, freezing, behind};
    }
    for (int k = 0; k < PANELS; k++) panel[k].guides = GUIDES, panel[k].guide = h->guide + k * GUIDES;
    return peaks && freezes;
}

/* Of those that are drawn: `before` are left out between it and the one above it. */
static char *title_of(const history *h, int before, ves_arena *arena)
{
    const int of = h->run->annealings;
    const char *title = h->run->problem->title;
    if (of == 1) return ves_arena_format(arena, "Annealing: %s", title);
    if (!before) return ves_arena_format(arena, "Annealing %d of %d: %s", h->index + 1, of, title);
    return ves_arena_format(arena, "Annealing %d of %d (%d before it left out): %s", h->index + 1, of, before,
                            title);
}

static ves_status panels_make(history *h, int before, ves_chart panel[PANELS], ves_arena *arena)
{
    const char *unit = h->shown.unit;
    ves_chart_axis x = {.low = h->x[0], .high = h->x[h->points - 1], .logarithmic = true};
    panel[0] = upper_chart(h, &x);
    panel[1] = lower_chart(h, &x);
    panel[0].title = title_of(h, before, arena);
    panel[1].x.label = ves_arena_format(arena, "temperature T%s%s%s; cooled from right to left",
                                        *unit ? " [" : "", unit, *unit ? "]" : "");
    return guides_set(h, panel, arena) && panel[0].title && panel[1].x.label ? VES_OK : VES_MEMORY;
}

ves_status ves_annealing_draw(const ves_run *run, const char *path, ves_arena *arena, ves_diag *diag)
{
    history *h = ves_arena_take(arena, MOST, sizeof *h);
    ves_chart *panel = ves_arena_take(arena, PANELS * MOST, sizeof *panel);
    int curves = 0, seen = 0, drawn = 0;
    if (!h || !panel) return ves_diag_fail(diag, VES_MEMORY);
    for (int k = 0; k < run->annealings; k++) curves += has_curve(run, k);
    const int out = curves > MOST ? curves - MOST : 0;
    for (int k = 0; k < run->annealings; k++) {
        if (!has_curve(run, k)) continue;
        const int at = seen++;
        if (out && at >= MOST / 2 && at < MOST / 2 + out) continue;
        const int before = at == MOST / 2 + out ? out : 0;
        if (!history_init(&h[drawn], run, k, arena) ||
            panels_make(&h[drawn], before, panel + PANELS * drawn, arena) != VES_OK)
            return ves_diag_fail(diag, VES_MEMORY);
        drawn++;
    }
    return ves_charts_write(panel, PANELS * drawn, path, diag);
}
