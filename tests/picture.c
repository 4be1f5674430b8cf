#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include "files.h"
#include "fonts.h"
#include "output/output.h"
#include "output/scene.h"
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
        unsigned char *data = (unsigned char *)slurp_bytes(path_of("a.png"), &size);
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
        char *svg = slurp_bytes(path_of("a.svg"), &size);
        cr_assert(strstr(svg, "<svg") && strstr(svg, "</svg>") && strstr(svg, "400") && strstr(svg, "300"));
        free(svg);
        char *pdf = slurp_bytes(path_of("a.pdf"), &size);
        cr_assert(memcmp(pdf, "%PDF-", 5) == 0 && !memcmp(pdf + size - 6, "%%EOF\n", 6));
        free(pdf);
        char *one = slurp_bytes(path_of("a.png"), &size), *two = slurp_bytes(path_of("b.png"), &again);
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

/* Which axis is up on paper. */
static int up_of(const ves_figure *figure)
{
    ves_scene scene;
    ves_arena arena = {0};
    const ves_view view = ves_view_default();
    const ves_frame frame = {0, 0, 100, 100, 0};
    int up = 0;
    cr_assert(ves_scene_build(&scene, figure, &view, &frame, &arena) == VES_OK);
    for (int c = 1; c < 3; c++)
        if (fabs(scene.camera.up[c]) > fabs(scene.camera.up[up])) up = c;
    ves_arena_destroy(&arena);
    return up;
}

Test(picture, a_tube_stands_on_its_end_and_a_sheet_has_z_upwards)
{
    ves_figure figure;
    shape_pipe(&figure, 0.3, 2, false, 8, 12);
    ves_figure_patch *p = &figure.patch[0];
    double *z = p->X[2];
    cr_assert(eq(int, up_of(&figure), 2));
    p->X[2] = p->X[0], p->X[0] = z;
    cr_assert(eq(int, up_of(&figure), 0), "a tube along x");
    p->periodic = false; /* its two ends are two of four sides */
    cr_assert(eq(int, up_of(&figure), 2), "a sheet");
    shape_end(&figure);
}

Test(picture, a_constant_has_no_range_of_colours)
{
    double zero[4] = {0, 1e-9, -1e-9, 0}, two[4] = {2, 2, 2 + 1e-9, 2}, rising[4] = {0, 1, 2, 3};
    ves_colour_scale s = ves_colour_scale_of(zero, 4, 1e-6, 0.48);
    cr_assert(s.constant && s.diverging && s.lo == -s.hi, "%g %g", s.lo, s.hi);
    s = ves_colour_scale_of(two, 4, 1e-6, 0.48);
    cr_assert(s.constant && fabs((s.lo + s.hi) / 2 - 2) < 2e-9, "%g %g", s.lo, s.hi);
    s = ves_colour_scale_of(rising, 4, 1e-6, 0.48);
    cr_assert(s.constant == false && s.lo == 0 && s.hi == 3, "%g %g", s.lo, s.hi);
}
