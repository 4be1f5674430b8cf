#include "output/draw.h"
#include "output/paper.h"
#include "output/scene.h"

enum { WIDTH = 960, HEIGHT = 720, LEAST = 64, MOST = 16384 };

static const double cell_pixels = 6; /* pieces of a PNG: small enough to look smooth */

ves_view ves_view_default(void)
{
    return (ves_view){WIDTH, HEIGHT, 0.6, 0.42, -1, "H", false, false, false};
}

static ves_status refuse(ves_diag *diag, ves_status status, const char *what, const char *word)
{
    return ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, what, word);
}

static ves_status check(const ves_figure *figure, const ves_view *view, const char *path, ves_diag *diag)
{
    if (ves_paper_kind_of(path) == VES_PAPER_NONE)
        return refuse(diag, VES_NAME, "a picture's name ends in .png, .svg or .pdf, not \"%s\"", path);
    VES_TRY(ves_quantity_check(figure, view->colour, diag));
    if (view->width < LEAST || view->height < LEAST || view->width > MOST || view->height > MOST)
        return refuse(diag, VES_RANGE, "a picture is %s pixels wide and high", "64 to 16384");
    return VES_OK;
}

typedef struct drawing {
    const ves_figure *figure;
    const ves_view *view;
    const ves_scene *scene;
} drawing;

static void draw(cairo_t *cairo, const void *data)
{
    const drawing *d = data;
    ves_draw(cairo, d->figure, d->view, d->scene, 1, ves_draw_unit(d->view));
}

ves_status ves_picture_write(ves_figure *figure, const ves_view *view, const char *path, ves_diag *diag)
{
    ves_scene scene;
    ves_arena arena = {0};
    ves_view whole = view ? *view : ves_view_default();
    if (!whole.width) whole.width = WIDTH;
    if (!whole.height) whole.height = HEIGHT;
    VES_TRY(check(figure, &whole, path, diag));
    ves_frame frame = ves_draw_frame(figure, &whole);
    frame.cell = ves_paper_kind_of(path) == VES_PAPER_PNG ? cell_pixels : 0;
    ves_status status = ves_scene_build(&scene, figure, &whole, &frame, &arena);
    const drawing d = {figure, &whole, &scene};
    const ves_paper paper = {whole.width, whole.height, figure->title, draw, &d};
    if (status == VES_OK)
        status = ves_paper_write(&paper, path, diag);
    else
        refuse(diag, status, "%s", ves_status_text(status));
    ves_arena_destroy(&arena);
    return status;
}
