/* Pictures of several things on one sheet: shapes side by side, charts below each other. */
#include <criterion/criterion.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include "files.h"
#include "fonts.h"
#include "output/chart.h"
#include "output/gallery.h"
#include "output/scene.h"
#include "shapes.h"
#include "study/folder.h"
#include "study/gallery.h"

enum { NOTES = 40 };

static const char *note[NOTES];

static unsigned big_endian(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (unsigned)b[0] << 24 | (unsigned)b[1] << 16 | (unsigned)b[2] << 8 | b[3];
}

/* A PNG, and how large. */
static void size_of(const char *path, unsigned *width, unsigned *height)
{
    size_t size;
    char *data = slurp_bytes(path, &size);
    cr_assert(size > 100 && memcmp(data, "\x89PNG\r\n\x1a\n", 8) == 0 && !memcmp(data + 12, "IHDR", 4));
    cr_assert(memcmp(data + size - 8, "IEND", 4) == 0);
    *width = big_endian(data + 16), *height = big_endian(data + 20);
    free(data);
}

static void same(const char *a, const char *b)
{
    size_t one, two;
    char *x = slurp_bytes(a, &one), *y = slurp_bytes(b, &two);
    cr_expect(one == two && !memcmp(x, y, one), "%s and %s differ", a, b);
    free(x);
    free(y);
}

static ves_gallery hang(ves_gallery_item *item, const ves_figure *figure, int items)
{
    for (int k = 0; k < NOTES; k++)
        note[k] =
            k == 3 ? "a_method_with_a_name_that_is_longer_than_its_column_is_wide 7/9" : "auto_values 12/15";
    for (int k = 0; k < items; k++)
        item[k] = (ves_gallery_item){&figure[k % 2], "12.1579981", note, k == 0 ? 0 : k == 1 ? 1 : NOTES};
    return (ves_gallery){.title = "A title \xff that is no text", .items = items, .item = item};
}

Test(gallery, a_sheet_has_room_for_all)
{
    static const unsigned size[][3] = {{1, 720, 430},  {2, 760, 430},   {3, 1060, 430},  {4, 760, 730},
                                       {5, 1060, 730}, {9, 1060, 1030}, {12, 1360, 1030}};
    double torus[] = {1, 0.4};
    ves_figure figure[2];
    ves_gallery_item item[VES_GALLERY_MOST];
    shape_sphere(&figure[0], 1, 6, 16);
    shape_ring(&figure[1], shape_torus, torus, 12, 8);
    for (size_t k = 0; k < sizeof size / sizeof *size; k++) {
        unsigned width, height;
        const ves_gallery gallery = hang(item, figure, (int)size[k][0]);
        cr_assert(ves_gallery_write(&gallery, path_of("a.png"), NULL) == VES_OK);
        cr_assert(ves_gallery_write(&gallery, path_of("b.png"), NULL) == VES_OK);
        size_of(path_of("a.png"), &width, &height);
        cr_expect(width == size[k][1] && height == size[k][2], "%u: %u x %u", size[k][0], width, height);
        same(path_of("a.png"), path_of("b.png"));
    }
    const ves_gallery gallery = hang(item, figure, 2);
    cr_expect(ves_gallery_write(&gallery, path_of("a.svg"), NULL) == VES_OK);
    cr_expect(ves_gallery_write(&gallery, path_of("a.pdf"), NULL) == VES_OK);
    cr_expect(ves_gallery_write(&gallery, path_of("nowhere/a.png"), NULL) == VES_IO);
    cr_expect(ves_gallery_write(&gallery, path_of("a.gif"), NULL) == VES_NAME);
    for (int k = 0; k < 2; k++) shape_end(&figure[k]);
    clean();
    check_nothing_left();
}

/* To one scale, each in the middle of its frame; in the same colours; from one side. */
Test(gallery, shapes_can_be_compared)
{
    const ves_frame frame[2] = {{0, 0, 100, 100, 0}, {200, 0, 300, 100, 0}};
    ves_view view = ves_view_default();
    ves_figure figure[2];
    ves_scene scene[2];
    ves_arena arena = {0};
    double low[2], high[2];
    shape_sphere(&figure[0], 1, 12, 24);
    shape_sphere(&figure[1], 0.5, 12, 24);
    const ves_figure *both[] = {&figure[0], &figure[1]};
    cr_assert(ves_scenes_build(scene, both, 2, &view, frame, &arena) == VES_OK);
    for (int s = 0; s < 2; s++) {
        low[s] = HUGE_VAL, high[s] = -HUGE_VAL;
        for (int k = 0; k < scene[s].pieces; k++)
            for (int c = 0; c < scene[s].piece[k].corners; c++) {
                low[s] = fmin(low[s], scene[s].piece[k].x[c]);
                high[s] = fmax(high[s], scene[s].piece[k].x[c]);
            }
    }
    double ratio = (high[1] - low[1]) / (high[0] - low[0]);
    cr_expect(fabs(ratio - 0.5) < 1e-5, "single precision: %g", ratio);
    cr_expect(fabs(low[0] + high[0] - 100) < 1e-3 && fabs(low[1] + high[1] - 500) < 1e-3, "in the middle");
    cr_expect(scene[0].colours.lo == scene[1].colours.lo && scene[0].colours.hi == scene[1].colours.hi);
    cr_expect(scene[0].colours.hi - scene[0].colours.lo > 0.9, "H is 1 and 2");
    cr_expect(memcmp(scene[0].camera.up, scene[1].camera.up, sizeof scene[0].camera.up) == 0);
    ves_arena_destroy(&arena);
    for (int k = 0; k < 2; k++) shape_end(&figure[k]);
}

Test(gallery, small_pictures_stand_in_their_cells)
{
    static const int cell[] = {0, 3};
    ves_figure figure[2];
    ves_gallery_item item[2];
    unsigned width, height;
    for (int k = 0; k < 2; k++) shape_sphere(&figure[k], 1, 6, 16);
    ves_gallery gallery = hang(item, figure, 2);
    gallery.columns = 2, gallery.cell = cell, gallery.cut = true;
    cr_assert(ves_gallery_write(&gallery, path_of("a.png"), NULL) == VES_OK);
    size_of(path_of("a.png"), &width, &height);
    cr_expect(width == 720 && height == 698, "two rows: %u x %u", width, height);
    for (int k = 0; k < 2; k++) shape_end(&figure[k]);
    clean();
    check_nothing_left();
}

/* Half of a sphere, cut along the plane through its axis that the viewer looks at, whose edge is drawn; an open shape is
 * left whole. */
Test(gallery, closed_shapes_are_cut_open)
{
    const ves_frame frame = {0, 0, 100, 100, 0};
    ves_view view = ves_view_default();
    ves_figure sphere;
    int pieces[2], rims[2] = {0};
    view.cut = true;
    shape_sphere(&sphere, 1, 12, 24);
    for (int closed = 0; closed < 2; closed++) {
        ves_scene scene;
        ves_arena arena = {0};
        sphere.closed = closed;
        cr_assert(ves_scene_build(&scene, &sphere, &view, &frame, &arena) == VES_OK);
        pieces[closed] = scene.pieces;
        for (int k = 0; k < scene.pieces; k++) rims[closed] += scene.piece[k].rim != 0;
        ves_arena_destroy(&arena);
    }
    cr_expect(pieces[0] > 12 * 24 && 2 * pieces[1] == pieces[0], "%d, %d", pieces[0], pieces[1]);
    cr_expect(rims[0] == 0 && rims[1] >= 2 * 12, "%d, %d: its edge", rims[0], rims[1]);
    shape_end(&sphere);
}

/* Logarithmic axes of less than a decade have ticks as well; guides beyond the axis are left out. */
Test(gallery, charts_stand_below_each_other)
{
    static const double x[] = {0.02, 0.025, 0.05}, y[] = {0, 1, 0.5};
    static const double low[] = {1e-9, 0.02, 0.021, 3e-7, 1}, high[] = {10, 0.05, 0.029, 8e-7, 40};
    const ves_chart_guide guide[] = {
        {"here", 0.03, true}, {"no number", NAN, false}, {NULL, 0.02, true}, {"beyond", 1e9, false}};
    const ves_chart_line line = {.name = "a", .count = 3, .x = x, .y = y, .mark = VES_MARK_SPECK};
    for (size_t k = 0; k < sizeof low / sizeof *low; k++) {
        unsigned width, height;
        const ves_chart chart[] = {
            {"above", {NULL, low[k], high[k], true}, {"y", 0, 1, false}, 1, &line, 4, guide, 300},
            {NULL, {"x", low[k], high[k], true}, {"y", 0, 1, false}, 1, &line, 4, guide, 350}};
        cr_assert(ves_charts_write(chart, 2, path_of("a.png"), NULL) == VES_OK);
        size_of(path_of("a.png"), &width, &height);
        cr_expect(width == 960 && height == 650, "%u x %u", width, height);
        cr_assert(ves_chart_write(&chart[1], path_of("a.png"), NULL) == VES_OK);
        size_of(path_of("a.png"), &width, &height);
        cr_expect(width == 960 && height == 350, "%u x %u", width, height);
    }
    clean();
    check_nothing_left();
}

/* Of names that become one the first keeps it; a number never makes a name that somebody has, before or behind. */
Test(gallery, names_of_pictures_are_all_different)
{
    enum { NAMES = 9, LONG = 400 };
    static char far[2][LONG + 1];
    for (int k = 0; k < 2; k++) memset(far[k], 'x', LONG), far[k][LONG - 1] = (char)('a' + k);
    const char *name[NAMES] = {"a b", "a-b", "a-b-2", "a/b", "a-b-4", far[0], far[1], "a_b", "\xc3\xa9"},
               *want[NAMES] = {"a-b", "a-b-3", "a-b-2", "a-b-5", "a-b-4", NULL, NULL, "a_b", "--"};
    ves_arena arena = {0};
    cr_assert(ves_folder_names(name, NAMES, &arena));
    for (int k = 0; k < NAMES; k++) {
        if (want[k]) cr_expect(strcmp(name[k], want[k]) == 0, "%s, want %s", name[k], want[k]);
        for (int j = 0; j < k; j++) cr_expect(strcmp(name[k], name[j]) != 0, "two are %s", name[k]);
        cr_expect(strlen(name[k]) < 160 && strchr(name[k], '/') == NULL, "%s", name[k]);
    }
    ves_arena_destroy(&arena);
    check_nothing_left();
}

Test(gallery, values_have_units_and_all_their_digits)
{
    static const struct {
        double value;
        ves_shown shown;
        const char *want;
    } all[] = {{0.00858920619, {"cm^2", 1e-4}, "85.8920619 cm^2"},
               {0.5, {"", 1}, "0.500000000"},
               {-12.25, {"J", 1}, "-12.2500000 J"}};
    ves_arena arena = {0};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const char *text = ves_shown_value(all[k].value, &all[k].shown, &arena);
        cr_expect(text && strcmp(text, all[k].want) == 0, "%s, want %s", text, all[k].want);
    }
    ves_arena_destroy(&arena);
}
