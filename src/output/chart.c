#include "output/chart.h"

#include <math.h>
#include <stdio.h>

#include "output/paper.h"
#include "output/scene.h"
#include "output/utf8.h"

enum {
    WIDTH = 960,
    HEIGHT = 600,
    LEFT = 84,
    RIGHT = 210,
    TOP = 56,
    NEAR = 18,
    BOTTOM = 64,
    LABEL = 400,
    ROOM = 10, /* before the word of a guide */
    COLOURS = 8,
    MANY = 400,
    DASHES = 5
};

static const ves_rgb faint = {0.87, 0.89, 0.91};

static const double FEW = 1.5; /* decades */

/* Lines beyond the colours there are get dashes. */
static const double dash[DASHES][4] = {{0, 0, 0, 0}, {7, 4, 7, 4}, {2, 3, 2, 3}, {11, 3, 2, 3}, {5, 2, 1, 2}};

static void colour(cairo_t *c, ves_rgb rgb, double opacity)
{
    cairo_set_source_rgba(c, rgb.r, rgb.g, rgb.b, opacity);
}

/* align: 0 begins at x, 0.5 centred, 1 ends at x */
static void words(cairo_t *c, double x, double y, double align, const char *text)
{
    char clean[LABEL];
    cairo_text_extents_t extents;
    ves_utf8_copy(clean, sizeof clean, text);
    cairo_text_extents(c, clean, &extents);
    cairo_move_to(c, x - align * extents.x_advance, y);
    cairo_show_text(c, clean);
}

static void font(cairo_t *c, double size, bool bold)
{
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, size);
}

/* As large as fits, in the font that is chosen. */
static void words_fit(cairo_t *c, double x, double y, double align, double size, double width,
                      const char *text)
{
    char clean[LABEL];
    cairo_text_extents_t extents;
    ves_utf8_copy(clean, sizeof clean, text);
    cairo_set_font_size(c, size);
    cairo_text_extents(c, clean, &extents);
    if (extents.x_advance > width) cairo_set_font_size(c, size * width / extents.x_advance);
    words(c, x, y, align, text);
}

/* A chart without a title, or without words under its axis, stands nearer to its neighbour. */
static double top_of(const ves_chart *chart)
{
    return chart->title ? TOP : NEAR;
}

static double height_of(const ves_chart *chart)
{
    return chart->height ? chart->height : HEIGHT;
}

static double bottom_of(const ves_chart *chart)
{
    return height_of(chart) - (chart->x.label ? BOTTOM : BOTTOM - TOP + NEAR);
}

/* 0 ... 1 along the axis. */
static double along(const ves_chart_axis *a, double value)
{
    if (a->logarithmic) return log(value / a->low) / log(a->high / a->low);
    return (value - a->low) / (a->high - a->low);
}

static double px(const ves_chart *chart, double x)
{
    return LEFT + (WIDTH - LEFT - RIGHT) * along(&chart->x, x);
}

static double py(const ves_chart *chart, double y)
{
    return bottom_of(chart) - (bottom_of(chart) - top_of(chart)) * along(&chart->y, y);
}

/* Decades (or every second, third ... so that at most ten are told) or round tenths. Of few decades 1, 2 and 5 of
 * each: step 0. */
static double first_tick(const ves_chart_axis *a, double *step)
{
    if (a->logarithmic) {
        double decades = log10(a->high / a->low), power = pow(10, floor(log10(a->low) + 1e-9)),
               least = a->low * (1 - 1e-9);
        *step = decades < FEW ? 0 : pow(10, ceil(decades / 10));
        if (*step > 0) return pow(10, ceil(log10(a->low) - 1e-9));
        return power * (power >= least ? 1 : 2 * power >= least ? 2 : 5 * power >= least ? 5 : 10);
    }
    double raw = (a->high - a->low) / 6, power = pow(10, floor(log10(raw)));
    *step = power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1);
    return ceil(a->low / *step - 1e-9) * *step;
}

static double next_tick(const ves_chart_axis *a, double at, double step)
{
    if (!a->logarithmic) return at + step;
    if (step > 0) return at * step;
    double first = at / pow(10, floor(log10(at) + 1e-9)); /* 1, 2 or 5 */
    return at * (first > 1.5 && first < 3 ? 2.5 : 2);
}

static void tick_text(const ves_chart_axis *a, double value, char text[32])
{
    double power = floor(log10(value) + 1e-9);
    if (a->logarithmic && (value >= 1e5 || value < 1e-3))
        snprintf(text, 32, "%.0fe%.0f", value / pow(10, power), power);
    else
        snprintf(text, 32, "%.6g", fabs(value) < 1e-12 ? 0 : value);
}

static void grid(cairo_t *c, const ves_chart *chart, bool upright)
{
    const ves_chart_axis *a = upright ? &chart->y : &chart->x;
    const double bottom = bottom_of(chart);
    double step, most = a->high * (1 + 1e-9) + (a->logarithmic ? 0 : 1e-12), at = first_tick(a, &step);
    cairo_set_line_width(c, 1);
    for (; at <= most; at = next_tick(a, at, step)) {
        double x = upright ? LEFT : px(chart, at), y = upright ? py(chart, at) : top_of(chart);
        char text[32];
        colour(c, faint, 1);
        cairo_move_to(c, x, y);
        cairo_line_to(c, upright ? WIDTH - RIGHT : x, upright ? y : bottom);
        cairo_stroke(c);
        colour(c, ves_quiet, 1);
        tick_text(a, at, text);
        if (upright)
            words(c, LEFT - 8, y + 4, 1, text);
        else
            words(c, x, bottom + 18, 0.5, text);
    }
}

static void frame(cairo_t *c, const ves_chart *chart)
{
    const double bottom = bottom_of(chart);
    font(c, 12, false);
    grid(c, chart, false);
    grid(c, chart, true);
    colour(c, ves_ink, 1);
    cairo_set_line_width(c, 1);
    cairo_rectangle(c, LEFT, top_of(chart), WIDTH - LEFT - RIGHT, bottom - top_of(chart));
    cairo_stroke(c);
    font(c, 13, false);
    words(c, LEFT + (WIDTH - LEFT - RIGHT) / 2.0, bottom + BOTTOM - 20, 0.5, chart->x.label);
    cairo_save(c);
    cairo_translate(c, 22, top_of(chart) + (bottom - top_of(chart)) / 2.0);
    cairo_rotate(c, -acos(-1) / 2);
    words_fit(c, 0, 0, 0.5, 13, bottom - top_of(chart), chart->y.label);
    cairo_restore(c);
    font(c, 16, true);
    if (chart->title) words_fit(c, LEFT, 34, 0, 16, WIDTH - LEFT - 20, chart->title);
}

static bool is_alone(const ves_chart_line *l)
{
    return l->mark == VES_MARK_CROSS || l->mark == VES_MARK_SPECK || l->mark == VES_MARK_RING;
}

static ves_rgb tint(const ves_chart *chart, int index)
{
    const ves_chart_line *l = &chart->line[index];
    if (l->mark == VES_MARK_CROSS || l->mark == VES_MARK_RING) return ves_ink;
    return ves_colour_line(l->colour ? l->colour - 1 : index);
}

static void dashes(cairo_t *c, const ves_chart *chart, int index)
{
    const ves_chart_line *l = &chart->line[index];
    int kind = (l->colour ? (l->colour - 1) / COLOURS * 2 + l->dashed : index / COLOURS) % DASHES;
    cairo_set_dash(c, dash[kind], kind ? 4 : 0, 0);
}

/* Where the chart can show a point: finite, and not beyond 0 of a logarithmic axis. */
static bool shown(const ves_chart *chart, double x, double y)
{
    return isfinite(x) && isfinite(y) && (x > 0 || !chart->x.logarithmic) && (y > 0 || !chart->y.logarithmic);
}

/* Specks are smaller where there are many. */
static void mark_draw(cairo_t *c, const ves_chart_line *l, double x, double y)
{
    if (l->mark == VES_MARK_RING) {
        cairo_new_sub_path(c);
        cairo_arc(c, x, y, 5, 0, 2 * acos(-1));
        cairo_stroke(c);
        return;
    }
    if (l->mark != VES_MARK_CROSS) {
        cairo_arc(c, x, y, l->mark == VES_MARK_DOT ? 2.5 : l->count > MANY ? 1.2 : 2, 0, 2 * acos(-1));
        cairo_fill(c);
        return;
    }
    cairo_move_to(c, x - 4, y - 4);
    cairo_line_to(c, x + 4, y + 4);
    cairo_move_to(c, x - 4, y + 4);
    cairo_line_to(c, x + 4, y - 4);
    cairo_stroke(c);
}

static void marks_draw(cairo_t *c, const ves_chart *chart, int index)
{
    const ves_chart_line *l = &chart->line[index];
    colour(c, tint(chart, index), l->mark == VES_MARK_SPECK ? 0.5 : 1);
    cairo_set_line_width(c, 1.5);
    for (int k = 0; k < l->count && l->mark != VES_MARK_NONE; k++)
        if (shown(chart, l->x[k], l->y[k])) mark_draw(c, l, px(chart, l->x[k]), py(chart, l->y[k]));
}

static void line_draw(cairo_t *c, const ves_chart *chart, int index)
{
    const ves_chart_line *l = &chart->line[index];
    if (is_alone(l)) return;
    bool pen = false;
    for (int k = 0; k < l->count; k++) {
        if (!shown(chart, l->x[k], l->y[k])) {
            pen = false;
            continue;
        }
        double x = px(chart, l->x[k]), y = py(chart, l->y[k]);
        if (pen && l->stairs) cairo_line_to(c, x, py(chart, l->y[k - 1]));
        if (pen)
            cairo_line_to(c, x, y);
        else
            cairo_move_to(c, x, y);
        pen = true;
    }
    colour(c, tint(chart, index), 1);
    cairo_set_line_width(c, 2);
    dashes(c, chart, index);
    cairo_stroke(c);
    cairo_set_dash(c, NULL, 0, 0);
}

/* Pieces between two points that both can be shown; what is beyond the top of the axis ends there. */
static void band_draw(cairo_t *c, const ves_chart *chart, int index)
{
    const ves_chart_line *l = &chart->line[index];
    for (int k = 0; l->low && k + 1 < l->count; k++) {
        double high[2] = {fmin(l->high[k], chart->y.high), fmin(l->high[k + 1], chart->y.high)};
        bool both = shown(chart, l->x[k], l->low[k]) && shown(chart, l->x[k + 1], l->low[k + 1]);
        if (!both || !shown(chart, l->x[k], high[0]) || !shown(chart, l->x[k + 1], high[1])) continue;
        int end = l->stairs ? k : k + 1;
        cairo_move_to(c, px(chart, l->x[k]), py(chart, l->low[k]));
        cairo_line_to(c, px(chart, l->x[k + 1]), py(chart, l->low[end]));
        cairo_line_to(c, px(chart, l->x[k + 1]), py(chart, high[end - k]));
        cairo_line_to(c, px(chart, l->x[k]), py(chart, high[0]));
        cairo_close_path(c);
    }
    colour(c, tint(chart, index), 0.16);
    cairo_fill(c);
}

static void legend(cairo_t *c, const ves_chart *chart)
{
    double step = fmin(20, (height_of(chart) - top_of(chart) - 24.0) / chart->lines),
           size = fmin(13, 0.8 * step);
    font(c, size, false);
    for (int k = 0; k < chart->lines; k++) {
        double x = WIDTH - RIGHT + 18, y = top_of(chart) + 12 + step * k;
        const bool alone = is_alone(&chart->line[k]);
        colour(c, tint(chart, k), 1);
        cairo_set_line_width(c, 2);
        dashes(c, chart, k);
        if (!alone) {
            cairo_move_to(c, x, y - 4);
            cairo_line_to(c, x + 26, y - 4);
            cairo_stroke(c);
        }
        cairo_set_dash(c, NULL, 0, 0);
        if (alone) mark_draw(c, &chart->line[k], x + 13, y - 4);
        colour(c, ves_ink, 1);
        words_fit(c, x + 34, y, 0, size, RIGHT - 58, chart->line[k].name);
    }
}

static bool guide_seen(const ves_chart *chart, const ves_chart_guide *guide)
{
    return guide->x >= chart->x.low && guide->x <= chart->x.high;
}

static void guide_draw(cairo_t *c, const ves_chart *chart, const ves_chart_guide *guide)
{
    const double x = px(chart, guide->x);
    colour(c, ves_quiet, 1);
    cairo_set_line_width(c, 1.2);
    cairo_set_dash(c, dash[1], 4, 0);
    cairo_move_to(c, x, top_of(chart));
    cairo_line_to(c, x, bottom_of(chart));
    cairo_stroke(c);
    cairo_set_dash(c, NULL, 0, 0);
}

/* Above the frame, where no line is; each behind the one before it. */
static void guides_draw(cairo_t *c, const ves_chart *chart)
{
    double end = 0;
    for (int k = 0; k < chart->guides; k++) {
        const ves_chart_guide *guide = &chart->guide[k];
        char clean[LABEL];
        cairo_text_extents_t extents;
        if (!guide_seen(chart, guide)) continue;
        guide_draw(c, chart, guide);
        if (!guide->name) continue;
        font(c, 12, false);
        colour(c, ves_ink, 1);
        ves_utf8_copy(clean, sizeof clean, guide->name);
        cairo_text_extents(c, clean, &extents);
        double from = fmax(px(chart, guide->x) - (guide->left ? extents.x_advance : 0), end + ROOM);
        words(c, from, top_of(chart) - 6, 0, clean);
        end = from + extents.x_advance;
    }
}

static void chart_draw(cairo_t *c, const ves_chart *chart)
{
    frame(c, chart);
    cairo_save(c);
    cairo_rectangle(c, LEFT, top_of(chart) - 1, WIDTH - LEFT - RIGHT, bottom_of(chart) - top_of(chart) + 2);
    cairo_clip(c);
    for (int k = 0; k < chart->lines; k++) band_draw(c, chart, k);
    for (int k = 0; k < chart->lines; k++) line_draw(c, chart, k);
    cairo_restore(c);
    for (int k = 0; k < chart->lines; k++) marks_draw(c, chart, k); /* over the frame too */
    guides_draw(c, chart);
    legend(c, chart);
}

typedef struct sheet {
    const ves_chart *chart;
    int charts;
} sheet;

static void draw(cairo_t *c, const void *data)
{
    const sheet *s = data;
    colour(c, (ves_rgb){1, 1, 1}, 1);
    cairo_paint(c);
    for (int k = 0; k < s->charts; k++) {
        chart_draw(c, &s->chart[k]);
        cairo_translate(c, 0, height_of(&s->chart[k]));
    }
}

ves_status ves_charts_write(const ves_chart *chart, int charts, const char *path, ves_diag *diag)
{
    const sheet s = {chart, charts};
    double height = 0;
    for (int k = 0; k < charts; k++) height += height_of(&chart[k]);
    const ves_paper paper = {WIDTH, (int)height, chart->title, draw, &s};
    return ves_paper_write(&paper, path, diag);
}

ves_status ves_chart_write(const ves_chart *chart, const char *path, ves_diag *diag)
{
    return ves_charts_write(chart, 1, path, diag);
}
