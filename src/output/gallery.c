#include "output/gallery.h"

#include <stdio.h>

#include "base/diag.h"
#include "output/draw.h"
#include "output/paper.h"
#include "output/utf8.h"

/* Pixels: the sheet is as wide as its columns, with room for the colours at the right. */
enum {
    LEAST = 720,
    COLUMN = 300,
    ROW = 300,
    SMALL = 168, /* of small ones: a column, its row, */
    SMALL_ROW = 284,
    SMALL_WORDS = 66,
    LEFT = 24,
    RIGHT = 136,
    TOP = 70,
    BOTTOM = 60,
    WORDS = 78, /* of a row: for what stands under the picture */
    GAP = 14,
    LINE = 16,
    LINES = 3, /* of notes */
    TEXT = 256
};

static const double cell_pixels = 4; /* as of a picture */

typedef struct sheet {
    const ves_gallery *gallery;
    ves_figure head; /* what is told of all: as the first, with the title of the gallery */
    ves_view view;
    ves_frame frame[VES_GALLERY_SMALL];
    ves_scene scene[VES_GALLERY_SMALL];
} sheet;

static void layout(sheet *s, bool vector)
{
    const ves_gallery *g = s->gallery;
    int items = g->items, cells = g->cell ? g->cell[items - 1] + 1 : items;
    int columns = g->columns ? g->columns : items <= 3 ? items : items == 4 ? 2 : items <= 9 ? 3 : 4;
    int rows = (cells + columns - 1) / columns, row = g->columns ? SMALL_ROW : ROW;
    int width = LEFT + columns * (g->columns ? SMALL : COLUMN) + RIGHT;
    s->view = ves_view_default();
    s->view.width = width > LEAST ? width : LEAST;
    s->view.height = TOP + rows * row + BOTTOM;
    s->view.cut = g->cut;
    if (g->cut) s->view.azimuth = 0.3, s->view.height_angle = 0.3;
    double column = (double)(s->view.width - LEFT - RIGHT) / columns;
    for (int k = 0; k < items; k++) {
        int cell = g->cell ? g->cell[k] : k;
        double left = LEFT + cell % columns * column, top = TOP + cell / columns * row;
        s->frame[k] =
            (ves_frame){left + GAP, top + GAP, left + column - GAP,
                        top + row - (g->columns ? SMALL_WORDS : WORDS) - GAP, vector ? 0 : cell_pixels};
    }
}

/* --- what stands under a picture --- */

static void font(cairo_t *c, bool bold, ves_rgb colour)
{
    cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_source_rgb(c, colour.r, colour.g, colour.b);
}

static double width_of(cairo_t *c, const char *text)
{
    cairo_text_extents_t extents;
    cairo_text_extents(c, text, &extents);
    return extents.x_advance;
}

/* Across the frame, smaller if need be. */
static void centred(cairo_t *c, const ves_frame *frame, double y, double size, const char *text)
{
    char clean[TEXT];
    ves_utf8_copy(clean, sizeof clean, text);
    cairo_set_font_size(c, size);
    double width = width_of(c, clean), most = frame->right - frame->left;
    if (width > most) cairo_set_font_size(c, size * most / width), width = most;
    cairo_move_to(c, (frame->left + frame->right - width) / 2, y);
    cairo_show_text(c, clean);
}

/* As many notes, from the first on, as fit on a line, one at least. */
static int line_fill(cairo_t *c, const ves_gallery_item *item, int first, double most, char text[TEXT])
{
    int count = 0;
    for (int k = first; k < item->notes; k++, count++) {
        char longer[2 * TEXT + 8], note[TEXT];
        ves_utf8_copy(note, sizeof note, item->note[k]);
        snprintf(longer, sizeof longer, "%s%s%s%s", count ? text : "", count ? " " : "", note,
                 k + 1 < item->notes ? "," : "");
        if (count && width_of(c, longer) > most) break;
        ves_utf8_copy(text, TEXT, longer);
    }
    return count;
}

static void notes_draw(cairo_t *c, const ves_gallery_item *item, const ves_frame *frame, double y)
{
    const double size = 12, most = frame->right - frame->left;
    int at = 0;
    font(c, false, ves_quiet);
    for (int line = 0; line < LINES && at < item->notes; line++, y += LINE) {
        char text[TEXT], more[TEXT + 32], room[32];
        bool last = line == LINES - 1;
        cairo_set_font_size(c, size);
        snprintf(room, sizeof room, " and %d more", item->notes);
        at += line_fill(c, item, at, last ? most - width_of(c, room) : most, text);
        snprintf(more, sizeof more, "%s and %d more", text, item->notes - at);
        centred(c, frame, y, size, last && at < item->notes ? more : text);
    }
}

static void draw(cairo_t *c, const void *data)
{
    const sheet *s = data;
    const ves_gallery *gallery = s->gallery;
    ves_draw(c, &s->head, &s->view, s->scene, gallery->items, 1);
    for (int k = 0; k < gallery->items; k++) {
        const ves_frame *frame = &s->frame[k];
        double y = frame->bottom + GAP + LINE;
        font(c, true, ves_ink);
        centred(c, frame, y, 15, gallery->item[k].caption);
        notes_draw(c, &gallery->item[k], frame, y + LINE + 2);
    }
}

ves_status ves_gallery_write(const ves_gallery *gallery, const char *path, ves_diag *diag)
{
    ves_arena arena = {0};
    sheet s = {.gallery = gallery, .head = *gallery->item[0].figure};
    const ves_figure *figure[VES_GALLERY_SMALL];
    for (int k = 0; k < gallery->items; k++) figure[k] = gallery->item[k].figure;
    s.head.title = gallery->title;
    layout(&s, ves_paper_kind_of(path) != VES_PAPER_PNG);
    const ves_paper paper = {s.view.width, s.view.height, gallery->title, draw, &s};
    ves_status status = ves_scenes_build(s.scene, figure, gallery->items, &s.view, s.frame, &arena);
    status = status == VES_OK ? ves_paper_write(&paper, path, diag) : ves_diag_fail(diag, status);
    ves_arena_destroy(&arena);
    return status;
}
