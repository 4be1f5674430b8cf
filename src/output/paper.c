#include "output/paper.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "output/file.h"
#include "output/utf8.h"

static const char *const kind_name[] = {"png", "svg", "pdf"};

static const double points = 0.75; /* PDF counts in 1/72 inch, a pixel of paper is 1/96 */

ves_paper_kind ves_paper_kind_of(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int k = 0; dot && k < VES_PAPER_NONE; k++)
        if (!strcmp(dot + 1, kind_name[k])) return (ves_paper_kind)k;
    return VES_PAPER_NONE;
}

static cairo_status_t put(void *out, const unsigned char *data, unsigned length)
{
    return fwrite(data, 1, length, out) == length ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static cairo_surface_t *surface_create(ves_paper_kind as, const ves_paper *paper, FILE *out)
{
    int width = paper->width, height = paper->height;
    if (as == VES_PAPER_SVG) return cairo_svg_surface_create_for_stream(put, out, width, height);
    if (as == VES_PAPER_PDF)
        return cairo_pdf_surface_create_for_stream(put, out, points * width, points * height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
}

static void title_set(cairo_surface_t *surface, ves_paper_kind as, const char *title)
{
    char clean[512];
    ves_utf8_copy(clean, sizeof clean, title);
    if (as == VES_PAPER_PDF) cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, clean);
}

/* Draws and writes; what cairo says at the end. */
static cairo_status_t surface_write(ves_paper_kind as, const ves_paper *paper, FILE *out)
{
    cairo_surface_t *surface = surface_create(as, paper, out);
    title_set(surface, as, paper->title);
    cairo_t *cairo = cairo_create(surface);
    if (as == VES_PAPER_PDF) cairo_scale(cairo, points, points);
    paper->draw(cairo, paper->data);
    cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    if (as == VES_PAPER_PNG && status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_write_to_png_stream(surface, put, out);
    cairo_surface_finish(surface);
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return status;
}

ves_status ves_paper_write(const ves_paper *paper, const char *path, ves_diag *diag)
{
    ves_file file;
    ves_paper_kind as = ves_paper_kind_of(path);
    const ves_mark nowhere = {0};
    if (as == VES_PAPER_NONE)
        return ves_diag_add(diag, VES_ERROR, VES_NAME, nowhere,
                            "a picture's name ends in .png, .svg or .pdf, not \"%s\"", path);
    VES_TRY(ves_file_begin(&file, path, kind_name[as], diag));
    errno = 0;
    cairo_status_t status = surface_write(as, paper, file.out);
    ves_status result = VES_OK;
    if (status == CAIRO_STATUS_NO_MEMORY)
        result = ves_diag_add(diag, VES_ERROR, VES_MEMORY, nowhere, "%s", ves_status_text(VES_MEMORY));
    else if (status == CAIRO_STATUS_WRITE_ERROR)
        result = ves_file_complain(path, errno, diag);
    else if (status != CAIRO_STATUS_SUCCESS)
        result =
            ves_diag_add(diag, VES_ERROR, VES_FAULT, nowhere, "cairo: %s", cairo_status_to_string(status));
    return ves_file_end(&file, result, diag);
}
