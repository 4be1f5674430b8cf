#include "output/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "output/utf8.h"

enum { NAMES = 8, LABEL = 64 };

static const ves_rgb marrow = {0.86, 0.33, 0.05};

typedef struct sheet {
    cairo_t *cairo;
    const ves_figure *figure;
    const ves_view *view;
    const ves_scene *scene;
    double unit;
} sheet;

/* Lengths of the layout follow the paper. */
double ves_draw_unit(const ves_view *view)
{
    return fmax(0.35, fmin(view->width / 960.0, view->height / 720.0));
}

static bool has_names(const ves_figure *figure)
{
    return figure->patches > 1 && figure->patches <= NAMES;
}

ves_frame ves_draw_frame(const ves_figure *figure, const ves_view *view)
{
    double unit = ves_draw_unit(view), side = 40 * unit;
    ves_quantity quantity;
    bool legend = ves_quantity_find(figure, view->colour, &quantity);
    double right = legend || has_names(figure) ? 130 * unit : side;
    double top = figure->title && figure->title[0] ? 76 * unit : side;
    ves_frame frame = {side, top, view->width - right, view->height - 66 * unit, 0};
    if (right > side && !legend) frame.left += 40 * unit;
    return frame;
}

static void colour(const sheet *s, ves_rgb rgb, double opacity)
{
    cairo_set_source_rgba(s->cairo, rgb.r, rgb.g, rgb.b, opacity);
}

static void font(const sheet *s, double size, bool bold)
{
    cairo_select_font_face(s->cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(s->cairo, size * s->unit);
}

static double width_of(const sheet *s, const char *text)
{
    cairo_text_extents_t extents;
    cairo_text_extents(s->cairo, text, &extents);
    return extents.x_advance;
}

/* align: 0 begins at x, 0.5 centred, 1 ends at x. */
static void write_text(const sheet *s, double x, double y, double align, const char *text)
{
    cairo_move_to(s->cairo, x - align * width_of(s, text), y);
    cairo_show_text(s->cairo, text);
}

static void background(const sheet *s)
{
    cairo_pattern_t *shade = cairo_pattern_create_linear(0, 0, 0, s->view->height);
    cairo_pattern_add_color_stop_rgb(shade, 0, 1, 1, 1);
    cairo_pattern_add_color_stop_rgb(shade, 1, 0.925, 0.937, 0.949);
    cairo_set_source(s->cairo, shade);
    cairo_paint(s->cairo);
    cairo_pattern_destroy(shade);
}

/* Unit normal of the side from a to b, to the right of it; false when the side has no length. */
static bool side_normal(const ves_piece *p, int a, int b, double n[2])
{
    double dx = p->x[b] - p->x[a], dy = p->y[b] - p->y[a], size = sqrt(dx * dx + dy * dy);
    if (!(size > 1e-6)) return false;
    n[0] = dy / size, n[1] = -dx / size;
    return true;
}

/* The outline with each side pushed outward by `grow`, so that no background shows between neighbours. */
static void outline(const sheet *s, const ves_piece *p, double grow)
{
    double turn = (p->x[2] - p->x[0]) * (p->y[3] - p->y[1]) - (p->x[3] - p->x[1]) * (p->y[2] - p->y[0]);
    double by = turn > 0 ? grow : -grow;
    for (int k = 0; k < 4; k++) {
        double before[2], after[2];
        bool one = side_normal(p, (k + 3) % 4, k, before), two = side_normal(p, k, (k + 1) % 4, after);
        if (!one && !two) continue;
        const double *n = one ? before : after, *m = two ? after : before;
        double mitre = by / fmax(0.5, 1 + n[0] * m[0] + n[1] * m[1]);
        cairo_line_to(s->cairo, p->x[k] + mitre * (n[0] + m[0]), p->y[k] + mitre * (n[1] + m[1]));
    }
    cairo_close_path(s->cairo);
}

/* Brightness below which lines are light. */
static const double DARK = 0.3;

static void sides(const sheet *s, const ves_piece *p, unsigned char which)
{
    static const int side[4][2] = {{0, 3}, {1, 2}, {0, 1}, {3, 2}}; /* low u, high u, low v, high v */
    for (int k = 0; k < 4; k++) {
        if (!(which & 1 << k)) continue;
        cairo_move_to(s->cairo, p->x[side[k][0]], p->y[side[k][0]]);
        cairo_line_to(s->cairo, p->x[side[k][1]], p->y[side[k][1]]);
    }
}

static void mesh_lines(const sheet *s, const ves_piece *p)
{
    static const ves_rgb paper = {1, 1, 1};
    sides(s, p, p->lines);
    ves_rgb own = {p->r, p->g, p->b};
    bool dark = 0.21 * own.r + 0.72 * own.g + 0.07 * own.b < DARK; /* ink would not be seen on it */
    colour(s, ves_colour_mix(own, dark ? paper : ves_ink, 0.5), dark ? 0.3 : 0.42);
    cairo_set_line_width(s->cairo, 0.7 * s->unit);
    cairo_stroke(s->cairo);
}

static void piece_draw(const sheet *s, const ves_piece *p)
{
    if (p->corners == 2) {
        cairo_move_to(s->cairo, p->x[0], p->y[0]);
        cairo_line_to(s->cairo, p->x[1], p->y[1]);
        colour(s, p->spine ? marrow : ves_ink, 1);
        cairo_set_line_width(s->cairo, (p->spine ? 2.6 : 1.8) * s->unit);
        cairo_stroke(s->cairo);
        return;
    }
    outline(s, p, 0.5);
    cairo_set_source_rgb(s->cairo, p->r, p->g, p->b);
    cairo_fill(s->cairo);
    if (p->lines) mesh_lines(s, p);
    if (!p->rim) return;
    sides(s, p, p->rim);
    colour(s, ves_ink, 1);
    cairo_set_line_width(s->cairo, 1.8 * s->unit);
    cairo_stroke(s->cairo);
}

static void shape(const sheet *s, const ves_scene *scene)
{
    cairo_set_antialias(s->cairo, CAIRO_ANTIALIAS_FAST);
    cairo_set_line_cap(s->cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(s->cairo, CAIRO_LINE_JOIN_ROUND);
    for (int k = 0; k < scene->pieces; k++) piece_draw(s, &scene->piece[k]);
    cairo_set_line_cap(s->cairo, CAIRO_LINE_CAP_BUTT);
}

/* Whole words of `text` that fit into `most`, at least one; returns where the rest begins. part has room for
 * all of text. */
static const char *title_line(const sheet *s, const char *text, double most, char *part)
{
    size_t taken = 0;
    while (text[taken]) {
        size_t end = taken + strspn(text + taken, " ");
        end += strcspn(text + end, " ");
        memcpy(part, text, end);
        part[end] = 0;
        if (taken && width_of(s, part) > most) break;
        taken = end;
    }
    part[taken] = 0;
    return text + taken + strspn(text + taken, " ");
}

static void title(const sheet *s)
{
    char whole[512], part[512];
    const char *rest = whole;
    double most = s->view->width - 60 * s->unit, height = 24;
    ves_utf8_copy(whole, sizeof whole, s->figure->title);
    font(s, 18, true);
    if (width_of(s, rest) > most) font(s, 15, true), height = 19;
    colour(s, ves_ink, 1);
    for (int line = 0; line < 2 && *rest; line++) {
        rest = title_line(s, rest, most, part);
        write_text(s, 30 * s->unit, (36 + line * height) * s->unit, 0, part);
    }
}

/* A length as people write it: "20 mm", or "0.02" without units. */
static void length_text(double value, const char *unit, char text[LABEL])
{
    static const struct {
        double size;
        const char *name;
    } prefix[] = {{1e3, "km"}, {1, "m"}, {1e-3, "mm"}, {1e-6, "µm"}, {1e-9, "nm"}};
    int k = 0;
    if (!unit || strcmp(unit, "m")) {
        snprintf(text, LABEL, "%.4g%s%s", value, unit ? " " : "", unit ? unit : "");
        return;
    }
    while (k < 4 && value < prefix[k].size * (1 - 1e-9)) k++;
    snprintf(text, LABEL, "%.4g %s", value / prefix[k].size, prefix[k].name);
}

static void scale_bar(const sheet *s)
{
    char text[LABEL];
    double length = ves_step_below(130 * s->unit / s->scene->camera.scale),
           size = length * s->scene->camera.scale;
    double right = s->view->width - 30 * s->unit, y = s->view->height - 28 * s->unit, tick = 4 * s->unit;
    colour(s, ves_ink, 1);
    cairo_set_line_width(s->cairo, 1.6 * s->unit);
    cairo_move_to(s->cairo, right - size, y - tick);
    cairo_line_to(s->cairo, right - size, y);
    cairo_line_to(s->cairo, right, y);
    cairo_line_to(s->cairo, right, y - tick);
    cairo_stroke(s->cairo);
    font(s, 12, false);
    length_text(length, s->figure->unit, text);
    write_text(s, right - size / 2, y - 8 * s->unit, 0.5, text);
}

/* The directions of x, y, z; those that point away are drawn first. */
static void axes(const sheet *s)
{
    static const ves_rgb tone[3] = {{0.75, 0.28, 0.27}, {0.25, 0.55, 0.30}, {0.22, 0.40, 0.70}};
    static const char *const name[3] = {"x", "y", "z"};
    const ves_camera *camera = &s->scene->camera;
    double ox = 52 * s->unit, oy = s->view->height - 50 * s->unit, size = 26 * s->unit;
    font(s, 12, true);
    cairo_set_line_width(s->cairo, 2 * s->unit);
    for (int front = 0; front < 2; front++) {
        for (int c = 0; c < 3; c++) {
            if ((camera->toward[c] > 0) != front) continue;
            double dx = size * camera->right[c], dy = -size * camera->up[c];
            colour(s, tone[c], 1);
            cairo_move_to(s->cairo, ox, oy);
            cairo_line_to(s->cairo, ox + dx, oy + dy);
            cairo_stroke(s->cairo);
            write_text(s, ox + 1.38 * dx, oy + 1.38 * dy + 4 * s->unit, 0.5, name[c]);
        }
    }
}

/* The unit that numbers up to `most` are short in, and what it is of the one that they are in. */
typedef struct prefix {
    const char *unit, *shown;
    double is;
} prefix;

static prefix prefix_of(const char *unit, double most)
{
    static const prefix known[] = {{"Pa", "GPa", 1e9}, {"Pa", "MPa", 1e6}, {"Pa", "kPa", 1e3},
                                   {"Pa", "Pa", 1},    {"m", "m", 1},      {"m", "mm", 1e-3},
                                   {"m", "µm", 1e-6},  {"m", "nm", 1e-9}};
    prefix best = {unit, unit, 1};
    for (size_t k = 0; unit && k < sizeof known / sizeof *known; k++) {
        if (strcmp(known[k].unit, unit) != 0) continue;
        best = known[k];
        if (most >= known[k].is) break;
    }
    return best;
}

static prefix shown_in(const sheet *s, const ves_quantity *quantity)
{
    const ves_colour_scale *scale = &s->scene->colours;
    double most = scale->constant ? (scale->lo + scale->hi) / 2 : scale->hi;
    return prefix_of(s->figure->unit ? quantity->unit : NULL, most);
}

static void legend_title(const sheet *s, double x, double y, const ves_quantity *quantity)
{
    char text[LABEL];
    const char *unit = quantity->unit ? shown_in(s, quantity).shown : NULL;
    font(s, 12, false);
    colour(s, ves_ink, 1);
    double right = s->view->width - 16 * s->unit, line = 17 * s->unit;
    write_text(s, right, y - (quantity->of ? 2 : 1) * line, 1, quantity->about);
    if (quantity->of) write_text(s, right, y - line, 1, quantity->of);
    if (quantity->field)
        snprintf(text, sizeof text, "%s", unit ? unit : "");
    else if (s->figure->unit && quantity->curvature)
        snprintf(text, sizeof text, "%s (1/%s%s)", quantity->word, s->figure->unit,
                 quantity->curvature == 2 ? "²" : "");
    else
        snprintf(text, sizeof text, "%s", quantity->word);
    font(s, 13, true);
    colour(s, ves_ink, 1);
    write_text(s, x, y, 0, text);
}

/* A pointed end says that some values lie beyond. */
static void legend_point(const sheet *s, double x, double y, double width, double height, double value)
{
    ves_rgb end = ves_colour_value(&s->scene->colours, value);
    cairo_move_to(s->cairo, x, y);
    cairo_line_to(s->cairo, x + width / 2, y + height);
    cairo_line_to(s->cairo, x + width, y);
    cairo_close_path(s->cairo);
    colour(s, end, 1);
    cairo_fill(s->cairo);
}

static void legend_tick(const sheet *s, double x, double y, double value)
{
    char text[LABEL];
    snprintf(text, sizeof text, "%s%.4g", value < 0 ? "\xE2\x88\x92" : "", fabs(value));
    colour(s, ves_quiet, 1);
    cairo_move_to(s->cairo, x, y);
    cairo_line_to(s->cairo, x + 4 * s->unit, y);
    cairo_stroke(s->cairo);
    colour(s, ves_ink, 1);
    write_text(s, x + 8 * s->unit, y + 4 * s->unit, 0, text);
}

/* Of a constant: what it is. */
static void legend_ticks(const sheet *s, double x, double top, double height, double one)
{
    const ves_colour_scale *scale = &s->scene->colours;
    double range = scale->hi - scale->lo, step = one * ves_step_below(range / one / 4);
    font(s, 12, false);
    cairo_set_line_width(s->cairo, s->unit);
    if (scale->constant) {
        legend_tick(s, x, top + height / 2, (scale->lo + scale->hi) / 2 / one);
        return;
    }
    for (double k = ceil(scale->lo / step - 1e-9); k * step <= scale->hi + 1e-9 * range; k++) {
        double value = fabs(k) < 0.5 ? 0 : k * step;
        legend_tick(s, x, top + height * (scale->hi - value) / range, value / one);
    }
}

static void legend(const sheet *s)
{
    ves_quantity quantity;
    if (!ves_quantity_find(s->figure, s->view->colour, &quantity)) return;
    const ves_colour_scale *scale = &s->scene->colours;
    double x = s->view->width - 100 * s->unit, width = 16 * s->unit;
    double height = scale->constant ? width : 0.46 * s->view->height;
    double top = 0.5 * (s->view->height - height), point = 11 * s->unit;
    cairo_pattern_t *fade = cairo_pattern_create_linear(0, top + height, 0, top);
    for (int k = 0; k <= 32; k++) {
        double share = scale->constant ? 0.5 : k / 32.0;
        ves_rgb c = ves_colour_value(scale, scale->lo + (scale->hi - scale->lo) * share);
        cairo_pattern_add_color_stop_rgb(fade, k / 32.0, c.r, c.g, c.b);
    }
    cairo_rectangle(s->cairo, x, top, width, height);
    cairo_set_source(s->cairo, fade);
    cairo_fill(s->cairo);
    cairo_pattern_destroy(fade);
    if (scale->above) legend_point(s, x, top, width, -point, scale->hi);
    if (scale->below) legend_point(s, x, top + height, width, point, scale->lo);
    legend_ticks(s, x + width, top, height, shown_in(s, &quantity).is);
    legend_title(s, x, top - 20 * s->unit, &quantity);
}

static void names(const sheet *s)
{
    double x = s->view->width - 112 * s->unit, size = 12 * s->unit, step = 22 * s->unit;
    double y = 0.5 * s->view->height - 0.5 * step * s->figure->patches;
    font(s, 13, false);
    for (int k = 0; k < s->figure->patches; k++, y += step) {
        char text[LABEL];
        ves_utf8_copy(text, sizeof text, s->figure->patch[k].name);
        cairo_rectangle(s->cairo, x, y, size, size);
        colour(s, ves_colour_patch(k), 1);
        cairo_fill(s->cairo);
        colour(s, ves_ink, 1);
        write_text(s, x + size + 7 * s->unit, y + size - s->unit, 0, text);
    }
}

void ves_draw(cairo_t *cairo, const ves_figure *figure, const ves_view *view, const ves_scene *scene,
              int scenes, double unit)
{
    const sheet s = {cairo, figure, view, scene, unit};
    background(&s);
    for (int k = 0; k < scenes; k++) shape(&s, &scene[k]);
    title(&s);
    scale_bar(&s);
    axes(&s);
    if (scene->plane)
        legend(&s);
    else if (has_names(figure))
        names(&s);
}
