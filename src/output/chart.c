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
    BOTTOM = 64,
    LABEL = 400,
    COLOURS = 8,
    DASHES = 5
};

static const ves_rgb ink = {0.16, 0.19, 0.23}, quiet = {0.42, 0.46, 0.51}, faint = {0.87, 0.89, 0.91};

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
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * along(&chart->y, y);
}

/* Decades (or every second, third ... so that at most ten are told) or round tenths. */
static double first_tick(const ves_chart_axis *a, double *step)
{
    if (a->logarithmic) {
        double decades = log10(a->high / a->low);
        *step = pow(10, ceil(decades / 10));
        return pow(10, ceil(log10(a->low) - 1e-9));
    }
    double raw = (a->high - a->low) / 6, power = pow(10, floor(log10(raw)));
    *step = power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1);
    return ceil(a->low / *step - 1e-9) * *step;
}

static void tick_text(const ves_chart_axis *a, double value, char text[32])
{
    if (a->logarithmic && (value >= 1e5 || value < 1e-3))
        snprintf(text, 32, "1e%d", (int)lround(log10(value)));
    else
        snprintf(text, 32, "%.6g", fabs(value) < 1e-12 ? 0 : value);
}

static void grid(cairo_t *c, const ves_chart *chart, bool upright)
{
    const ves_chart_axis *a = upright ? &chart->y : &chart->x;
    double step, most = a->high * (1 + 1e-9) + (a->logarithmic ? 0 : 1e-12), at = first_tick(a, &step);
    cairo_set_line_width(c, 1);
    for (; at <= most; at = a->logarithmic ? at * step : at + step) {
        double x = upright ? LEFT : px(chart, at), y = upright ? py(chart, at) : TOP;
        char text[32];
        colour(c, faint, 1);
        cairo_move_to(c, x, y);
        cairo_line_to(c, upright ? WIDTH - RIGHT : x, upright ? y : HEIGHT - BOTTOM);
        cairo_stroke(c);
        colour(c, quiet, 1);
        tick_text(a, at, text);
        if (upright)
            words(c, LEFT - 8, y + 4, 1, text);
        else
            words(c, x, HEIGHT - BOTTOM + 18, 0.5, text);
    }
}

static void frame(cairo_t *c, const ves_chart *chart)
{
    colour(c, (ves_rgb){1, 1, 1}, 1);
    cairo_paint(c);
    font(c, 12, false);
    grid(c, chart, false);
    grid(c, chart, true);
    colour(c, ink, 1);
    cairo_set_line_width(c, 1);
    cairo_rectangle(c, LEFT, TOP, WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM);
    cairo_stroke(c);
    font(c, 13, false);
    words(c, LEFT + (WIDTH - LEFT - RIGHT) / 2.0, HEIGHT - 20, 0.5, chart->x.label);
    cairo_save(c);
    cairo_translate(c, 22, TOP + (HEIGHT - TOP - BOTTOM) / 2.0);
    cairo_rotate(c, -acos(-1) / 2);
    words_fit(c, 0, 0, 0.5, 13, HEIGHT - TOP - BOTTOM, chart->y.label);
    cairo_restore(c);
    font(c, 16, true);
    words_fit(c, LEFT, 34, 0, 16, WIDTH - LEFT - 20, chart->title);
}

static void dashes(cairo_t *c, int index)
{
    int kind = index / COLOURS % DASHES;
    cairo_set_dash(c, dash[kind], kind ? 4 : 0, 0);
}

/* Where the chart can show a point: finite, and not beyond 0 of a logarithmic axis. */
static bool shown(const ves_chart *chart, double x, double y)
{
    return isfinite(x) && isfinite(y) && (x > 0 || !chart->x.logarithmic) && (y > 0 || !chart->y.logarithmic);
}

static void mark_draw(cairo_t *c, ves_chart_mark mark, double x, double y)
{
    if (mark != VES_MARK_CROSS) {
        cairo_arc(c, x, y, mark == VES_MARK_DOT ? 2.5 : 1.2, 0, 2 * acos(-1));
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
    colour(c, l->mark == VES_MARK_CROSS ? ink : ves_colour_line(index), l->mark == VES_MARK_SPECK ? 0.5 : 1);
    cairo_set_line_width(c, 1.5);
    for (int k = 0; k < l->count && l->mark != VES_MARK_NONE; k++)
        if (shown(chart, l->x[k], l->y[k])) mark_draw(c, l->mark, px(chart, l->x[k]), py(chart, l->y[k]));
}

static void line_draw(cairo_t *c, const ves_chart *chart, int index)
{
    const ves_chart_line *l = &chart->line[index];
    if (l->mark == VES_MARK_CROSS || l->mark == VES_MARK_SPECK) return;
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
    colour(c, ves_colour_line(index), 1);
    cairo_set_line_width(c, 2);
    dashes(c, index);
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
    colour(c, ves_colour_line(index), 0.16);
    cairo_fill(c);
}

static void legend(cairo_t *c, const ves_chart *chart)
{
    double step = fmin(20, (HEIGHT - TOP - 24.0) / chart->lines), size = fmin(13, 0.8 * step);
    font(c, size, false);
    for (int k = 0; k < chart->lines; k++) {
        double x = WIDTH - RIGHT + 18, y = TOP + 12 + step * k;
        const ves_chart_mark mark = chart->line[k].mark;
        const bool alone = mark == VES_MARK_CROSS || mark == VES_MARK_SPECK;
        colour(c, mark == VES_MARK_CROSS ? ink : ves_colour_line(k), 1);
        cairo_set_line_width(c, 2);
        dashes(c, k);
        if (!alone) {
            cairo_move_to(c, x, y - 4);
            cairo_line_to(c, x + 26, y - 4);
            cairo_stroke(c);
        }
        cairo_set_dash(c, NULL, 0, 0);
        if (alone) mark_draw(c, mark, x + 13, y - 4);
        colour(c, ink, 1);
        words_fit(c, x + 34, y, 0, size, RIGHT - 58, chart->line[k].name);
    }
}

static void draw(cairo_t *c, const void *data)
{
    const ves_chart *chart = data;
    frame(c, chart);
    cairo_save(c);
    cairo_rectangle(c, LEFT, TOP - 1, WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM + 2);
    cairo_clip(c);
    for (int k = 0; k < chart->lines; k++) band_draw(c, chart, k);
    for (int k = 0; k < chart->lines; k++) line_draw(c, chart, k);
    cairo_restore(c);
    for (int k = 0; k < chart->lines; k++) marks_draw(c, chart, k); /* over the frame too */
    legend(c, chart);
}

ves_status ves_chart_write(const ves_chart *chart, const char *path, ves_diag *diag)
{
    const ves_paper paper = {WIDTH, HEIGHT, chart->title, draw, chart};
    return ves_paper_write(&paper, path, diag);
}
