#include "output/modes.h"

#include <math.h>

#include "output/paper.h"
#include "output/scene.h"
#include "output/utf8.h"

enum { PANEL = 240, MARGIN = 28, TOP = 48, CAPTION = 52, ROW = 5, LABEL = 160 };

static const double SEEN = 1. / 7; /* of half the size */

typedef struct sheet {
    const ves_modes *modes;
    double size, middle; /* half the extent, m; where z is in the middle */
} sheet;

static void ink(cairo_t *c, ves_rgb rgb)
{
    cairo_set_source_rgb(c, rgb.r, rgb.g, rgb.b);
}

static void words(cairo_t *c, double x, double y, const char *text)
{
    char clean[LABEL];
    cairo_text_extents_t extents;
    ves_utf8_copy(clean, sizeof clean, text);
    cairo_text_extents(c, clean, &extents);
    cairo_move_to(c, x - extents.x_advance / 2, y);
    cairo_show_text(c, clean);
}

static void font(cairo_t *c, double size, bool bold)
{
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, size);
}

/* One pole to the other at v = 0, and back at v = pi, where cos n v is 1 or -1. */
static void outline(cairo_t *c, const sheet *s, const ves_modes_panel *panel, double by)
{
    const ves_modes *m = s->modes;
    const double scale = (PANEL - 2 * MARGIN) / (2 * s->size * (1 + SEEN));
    const double back = panel->n % 2 ? -by : by;
    cairo_new_path(c);
    for (int k = 0; k < 2 * m->points; k++) {
        const bool right = k < m->points;
        const int i = right ? k : 2 * m->points - 1 - k;
        const double f = right ? by : back, r = m->r[i] + f * panel->wr[i];
        cairo_line_to(c, scale * (right ? r : -r), -scale * (m->z[i] + f * panel->wz[i] - s->middle));
    }
    cairo_close_path(c);
}

static double largest(const ves_modes *m, const ves_modes_panel *panel)
{
    double most = 0;
    for (int i = 0; i < m->points; i++) most = fmax(most, hypot(panel->wr[i], panel->wz[i]));
    return most;
}

static void panel_draw(cairo_t *c, const sheet *s, const ves_modes_panel *panel)
{
    static const double dashes[] = {6, 4};
    const double most = largest(s->modes, panel), by = most > 0 ? SEEN * s->size / most : 0;
    outline(c, s, panel, 0);
    cairo_set_source_rgb(c, 0.93, 0.94, 0.95);
    cairo_fill_preserve(c);
    cairo_set_source_rgb(c, 0.35, 0.37, 0.4);
    cairo_set_line_width(c, 1.2);
    cairo_stroke(c);
    cairo_set_line_width(c, 2);
    outline(c, s, panel, by);
    ink(c, ves_colour_line(0));
    cairo_stroke(c);
    outline(c, s, panel, -by);
    cairo_set_dash(c, dashes, 2, 0);
    ink(c, ves_colour_line(1));
    cairo_stroke(c);
    cairo_set_dash(c, NULL, 0, 0);
    cairo_set_source_rgb(c, 0.1, 0.1, 0.12);
    font(c, 15, true);
    words(c, 0, PANEL / 2. + 14, panel->caption[0]);
    font(c, 13, false);
    words(c, 0, PANEL / 2. + 34, panel->caption[1]);
}

static int across(const ves_modes *m)
{
    return m->panels < ROW ? m->panels : ROW;
}

static void draw(cairo_t *c, const void *data)
{
    const sheet *s = data;
    const ves_modes *m = s->modes;
    cairo_set_source_rgb(c, 1, 1, 1);
    cairo_paint(c);
    cairo_set_source_rgb(c, 0.1, 0.1, 0.12);
    font(c, 17, true);
    if (m->title) words(c, PANEL * across(m) / 2., TOP - 18, m->title);
    for (int k = 0; k < m->panels; k++) {
        cairo_save(c);
        cairo_translate(c, PANEL * (k % ROW + 0.5), TOP + (PANEL + CAPTION) * (k / ROW) + PANEL / 2.);
        panel_draw(c, s, &m->panel[k]);
        cairo_restore(c);
    }
}

ves_status ves_modes_write(const ves_modes *m, const char *path, ves_diag *diag)
{
    double low = HUGE_VAL, high = -HUGE_VAL, wide = 0;
    for (int i = 0; i < m->points; i++)
        low = fmin(low, m->z[i]), high = fmax(high, m->z[i]), wide = fmax(wide, m->r[i]);
    const sheet s = {m, fmax((high - low) / 2, wide), (low + high) / 2};
    const int rows = (m->panels + ROW - 1) / ROW;
    const ves_paper paper = {PANEL * across(m), TOP + (PANEL + CAPTION) * rows, m->title, draw, &s};
    return ves_paper_write(&paper, path, diag);
}
