#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include "files.h"
#include "fonts.h"
#include "output/output.h"
#include "shapes.h"

static char first_message[1024];

static ves_status picture(ves_figure *figure, const ves_view *view, const char *path)
{
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_picture_write(figure, view, path, diag);
    first_message[0] = 0;
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, first_message, sizeof first_message);
    ves_diag_destroy(diag);
    return status;
}

static unsigned big_endian(const unsigned char *b)
{
    return (unsigned)b[0] << 24 | (unsigned)b[1] << 16 | (unsigned)b[2] << 8 | b[3];
}

Test(picture, pictures_have_the_size_asked_for)
{
    static const int sizes[][2] = {{0, 0}, {321, 200}, {64, 900}};
    ves_figure figure;
    shape_sphere(&figure, 1.3e-5, 6, 16); /* micrometres fill the paper too */
    figure.unit = "m";
    for (int k = 0; k < 3; k++) {
        size_t size;
        ves_view view = ves_view_default();
        view.width = sizes[k][0], view.height = sizes[k][1], view.orthographic = k == 1;
        cr_assert(eq(int, picture(&figure, &view, path_of("a.png")), VES_OK), "%s", first_message);
        unsigned char *data = slurp(path_of("a.png"), &size);
        cr_assert(memcmp(data, "\x89PNG\r\n\x1a\n", 8) == 0 && !memcmp(data + 12, "IHDR", 4));
        unsigned w = big_endian(data + 16), h = big_endian(data + 20);
        cr_assert(w == (k ? (unsigned)sizes[k][0] : 960) && h == (k ? (unsigned)sizes[k][1] : 720), "%u x %u",
                  w, h);
        free(data);
    }
    shape_end(&figure);
    clean();
}

Test(picture, vector_pictures_are_written_and_repeat)
{
    static const char *const colours[] = {"patch", "H", "K", "k1", "k2"};
    double torus[] = {1, 0.4};
    ves_figure figure;
    shape_ring(&figure, shape_torus, torus, 24, 16);
    figure.title =
        "A title that is much too long for one line of this picture, so that it is broken \xff and cut";
    for (int k = 0; k < 5; k++) {
        size_t size, again;
        ves_view view = ves_view_default();
        view.colour = colours[k], view.width = 400, view.height = 300;
        cr_assert(eq(int, picture(&figure, &view, path_of("a.svg")), VES_OK), "%s", first_message);
        cr_assert(eq(int, picture(&figure, &view, path_of("a.pdf")), VES_OK), "%s", first_message);
        cr_assert(eq(int, picture(&figure, &view, path_of("a.png")), VES_OK), "%s", first_message);
        cr_assert(eq(int, picture(&figure, &view, path_of("b.png")), VES_OK), "%s", first_message);
        char *svg = (char *)slurp(path_of("a.svg"), &size);
        cr_assert(strstr(svg, "<svg") && strstr(svg, "</svg>") && strstr(svg, "400") && strstr(svg, "300"));
        free(svg);
        char *pdf = (char *)slurp(path_of("a.pdf"), &size);
        cr_assert(memcmp(pdf, "%PDF-", 5) == 0 && !memcmp(pdf + size - 6, "%%EOF\n", 6));
        free(pdf);
        unsigned char *one = slurp(path_of("a.png"), &size), *two = slurp(path_of("b.png"), &again);
        cr_assert(size == again && !memcmp(one, two, size), "%s: the same picture twice", colours[k]);
        free(one);
        free(two);
    }
    shape_end(&figure);
    clean();
}

Test(picture, pictures_of_odd_shapes_are_written)
{
    double torus[] = {1, 0.4};
    for (int k = 0; k < 4; k++) {
        ves_figure figure;
        ves_view view = ves_view_default();
        shape_ring(&figure, shape_torus, torus, 12, 8);
        if (k == 0) figure.patches = 0;
        for (int s = 0; k > 0 && s < 13 * 8; s++) {
            for (int c = 0; c < 3; c++) {
                if (k == 1) figure.patch[0].X[c][s] = 0.7; /* all in one point */
                if (k == 2 && s % 5 == 0) figure.patch[0].X[c][s] = NAN;
                if (k == 3) figure.patch[0].normal[c][s] = 0;
            }
            if (k == 2) figure.patch[0].K[s] = s % 3 ? HUGE_VAL : NAN;
        }
        view.colour = k == 2 ? "K" : "H", view.width = view.height = 200;
        cr_assert(eq(int, picture(&figure, &view, path_of("a.png")), VES_OK), "case %d: %s", k,
                  first_message);
        shape_end(&figure);
    }
    clean();
}

Test(picture, what_no_picture_can_be_is_refused)
{
    ves_figure figure;
    shape_sphere(&figure, 1, 4, 8);
    ves_view good = ves_view_default(), bad = good;
    cr_assert(eq(int, picture(&figure, &good, path_of("a.gif")), VES_NAME));
    cr_assert(strstr(first_message, ".png, .svg or .pdf") != NULL, "%s", first_message);
    bad.colour = "h";
    cr_assert(eq(int, picture(&figure, &bad, path_of("a.png")), VES_NAME));
    cr_assert(strstr(first_message, "no colour \"h\"") != NULL, "%s", first_message);
    bad = good, bad.width = 20000;
    cr_assert(eq(int, picture(&figure, &bad, path_of("a.png")), VES_RANGE));
    cr_assert(eq(int, picture(&figure, &good, path_of("nowhere/a.png")), VES_IO));
    check_nothing_left();
    shape_end(&figure);
}
