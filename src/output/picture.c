#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <errno.h>
#include <math.h>
#include <string.h>

#include "output/draw.h"
#include "output/file.h"
#include "output/scene.h"
#include "output/utf8.h"

enum { WIDTH = 960, HEIGHT = 720, LEAST = 64, MOST = 16384 };

static const double cell_pixels = 4; /* pieces of a PNG: small enough to look smooth */

ves_view ves_view_default(void)
{
    return (ves_view){WIDTH, HEIGHT, 0.6, 0.42, -1, "H", false, false};
}

static ves_status refuse(ves_diag *diag, ves_status status, const char *what, const char *word)
{
    return ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, what, word);
}

typedef enum paper { PNG, SVG, PDF, NONE } paper;

static const char *const paper_name[] = {"png", "svg", "pdf"};

static paper paper_of(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int k = 0; dot && k < NONE; k++)
        if (!strcmp(dot + 1, paper_name[k])) return (paper)k;
    return NONE;
}

static ves_status check(const ves_view *view, const char *path, ves_diag *diag)
{
    if (paper_of(path) == NONE)
        return refuse(diag, VES_NAME, "a picture's name ends in .png, .svg or .pdf, not \"%s\"", path);
    if (ves_scene_quantity(view->colour) < 0)
        return refuse(diag, VES_NAME, "no colour \"%s\" (known: patch, H, K, k1, k2)",
                      view->colour ? view->colour : "");
    if (view->width < LEAST || view->height < LEAST || view->width > MOST || view->height > MOST)
        return refuse(diag, VES_RANGE, "a picture is %s pixels wide and high", "64 to 16384");
    return VES_OK;
}

static cairo_status_t put(void *out, const unsigned char *data, unsigned length)
{
    return fwrite(data, 1, length, out) == length ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static cairo_surface_t *surface_create(paper as, const ves_view *view, FILE *out)
{
    double points = 0.75; /* PDF counts in 1/72 inch, a pixel of paper is 1/96 */
    if (as == SVG) return cairo_svg_surface_create_for_stream(put, out, view->width, view->height);
    if (as == PDF)
        return cairo_pdf_surface_create_for_stream(put, out, points * view->width, points * view->height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, view->width, view->height);
}

static void title_set(cairo_surface_t *surface, paper as, const char *title)
{
    char clean[512];
    ves_utf8_copy(clean, sizeof clean, title);
    if (as == PDF) cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, clean);
}

/* Draws and writes; what cairo says at the end. */
static cairo_status_t surface_write(paper as, const ves_figure *figure, const ves_view *view,
                                    const ves_scene *scene, FILE *out)
{
    cairo_surface_t *surface = surface_create(as, view, out);
    title_set(surface, as, figure->title);
    cairo_t *cairo = cairo_create(surface);
    if (as == PDF) cairo_scale(cairo, 0.75, 0.75);
    ves_draw(cairo, figure, view, scene);
    cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    if (as == PNG && status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_write_to_png_stream(surface, put, out);
    cairo_surface_finish(surface);
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return status;
}

static ves_status picture_write(const ves_figure *figure, const ves_view *view, const ves_scene *scene,
                                const char *path, ves_diag *diag)
{
    ves_file file;
    paper as = paper_of(path);
    VES_TRY(ves_file_begin(&file, path, paper_name[as], diag));
    errno = 0;
    cairo_status_t status = surface_write(as, figure, view, scene, file.out);
    ves_status result = VES_OK;
    if (status == CAIRO_STATUS_NO_MEMORY)
        result = refuse(diag, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    else if (status == CAIRO_STATUS_WRITE_ERROR)
        result = ves_file_complain(path, errno, diag);
    else if (status != CAIRO_STATUS_SUCCESS)
        result = refuse(diag, VES_FAULT, "cairo: %s", cairo_status_to_string(status));
    return ves_file_end(&file, result, diag);
}

ves_status ves_picture_write(ves_figure *figure, const ves_view *view, const char *path, ves_diag *diag)
{
    ves_scene scene;
    ves_arena arena = {0};
    ves_view whole = view ? *view : ves_view_default();
    if (!whole.width) whole.width = WIDTH;
    if (!whole.height) whole.height = HEIGHT;
    VES_TRY(check(&whole, path, diag));
    ves_frame frame = ves_draw_frame(figure, &whole);
    frame.cell = paper_of(path) == PNG ? cell_pixels : 0;
    ves_status status = ves_scene_build(&scene, figure, &whole, &frame, &arena);
    if (status == VES_OK)
        status = picture_write(figure, &whole, &scene, path, diag);
    else
        refuse(diag, status, "%s", ves_status_text(status));
    ves_arena_destroy(&arena);
    return status;
}
