/* Spines in figures, files and pictures; what they are on a patch is in surface_pde.c. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "files.h"
#include "output/output.h"
#include "output/scene.h"
#include "surface/figure.h"

enum { ALONG = 7, AROUND = 24, ROWS = ALONG + 1 };

/* A sheet between two PDE patches that share a ring. */
static const char SHAPE[] =
    "vesica: 1\ncurves:\n"
    "  low: {circle: {radius: 1}}\n"
    "  mid: {formula: [\"1.2*cos(v) + 0.1*cos(3*v)\", \"sin(v) + 0.3\", \"1 + 0.2*cos(2*v)\"]}\n"
    "  high: {circle: {radius: 0.7, centre: [0.5, 0, 2.5]}}\n"
    "patches:\n"
    "  foot: {operator: {power: 1, a: 1}, conditions: [{u: 0, position: low}, {u: 1, position: mid}]}\n"
    "  dish: {surface: {formula: [\"(1 + u)*cos(v)\", \"(1 + u)*sin(v)\", \"5\"]}}\n"
    "  head: {operator: {power: 2, a: 0.7}, conditions: [{u: 0, position: mid}, {u: 0, derivative: 1, from: "
    "low, to: mid}, {u: 1, position: high}, {u: 1, derivative: 1, from: mid, to: high, scale: 2}]}\n"
    "expect: [area > 0]\n";

static ves_figure *figure_of(const bed *b)
{
    ves_figure *figure;
    double none = 0;
    cr_assert_eq(ves_plan_figure(b->plan, &none, ALONG, AROUND, &figure, b->diag), VES_OK);
    return figure;
}

/* The mean of 24 nodes is exact for 3 modes; figures in other units have their spines in them. */
Test(spine, figures_have_the_spine_of_each_pde_patch)
{
    bed b = bed_with(SHAPE, NULL, 8, 16);
    for (int inches = 0; inches < 2; inches++) {
        ves_figure *figure = figure_of(&b);
        if (inches) ves_figure_scale(figure, 1 / 0.0254, "in");
        cr_expect(figure->patch[1].spine[0] == NULL, "a sheet has none");
        for (int k = 0; k < 3; k += 2)
            for (int c = 0; c < 3; c++)
                for (int i = 0; i < ROWS; i++) {
                    const ves_figure_patch *p = &figure->patch[k];
                    double mean = 0, size = inches ? 40 : 1;
                    for (int j = 0; j < AROUND; j++) mean += p->X[c][i * p->columns + j] / AROUND;
                    cr_expect(fabs(p->spine[c][i] - mean) < 1e-14 * size, "%s %d: %.17g %.17g", p->name, i,
                              p->spine[c][i], mean);
                }
        ves_figure_destroy(figure);
    }
    bed_clear(&b);
}

/* The caller frees. */
static char *written(ves_figure *figure, const char *format, ves_diag *diag)
{
    char name[16];
    size_t size;
    snprintf(name, sizeof name, "a.%s", format);
    cr_assert_eq(ves_format_find(format)->spines(figure, path_of(name), diag), VES_OK);
    char *text = slurp_bytes(path_of(name), &size);
    clean();
    return text;
}

/* The next number of a text, read back exactly. */
static double next(const char **at)
{
    char *end;
    double value = strtod(*at, &end);
    cr_assert(end != *at, "no number at \"%.20s\"", *at);
    *at = end;
    return value;
}

static void expect_points(const ves_figure_patch *p, const char *const mark[], const char **at)
{
    for (int i = 0; i < ROWS; i++) {
        const char *from = mark ? strstr(*at, mark[0]) : *at;
        cr_assert(from != NULL);
        *at = from + (mark ? strlen(mark[0]) : 0);
        for (int c = 0; c < 3; c++) {
            if (mark && **at == ',') ++*at;
            double got = next(at);
            cr_expect(got == p->spine[c][i], "%s %d: %.17g %.17g", p->name, i, got, p->spine[c][i]);
        }
    }
}

/* obj: an object, its vertices, a line through them; numbers of vertices go on through the file. */
Test(spine, obj_has_a_line_for_each)
{
    bed b = bed_with(SHAPE, NULL, 8, 16);
    ves_figure *figure = figure_of(&b);
    char *text = written(figure, "obj", b.diag);
    const char *at = text;
    for (int k = 0; k < 3; k += 2) {
        char head[32];
        snprintf(head, sizeof head, "o %s\n", figure->patch[k].name);
        at = strstr(at, head);
        cr_assert(at != NULL, "%s", text);
        expect_points(&figure->patch[k], (const char *const[]){"\nv "}, &at);
        cr_assert(strncmp(at, "\nl ", 3) == 0, "%.20s", at);
        at += 3;
        for (int i = 1; i <= ROWS; i++) cr_expect_eq(next(&at), k / 2 * ROWS + i);
    }
    cr_expect(strstr(text, "dish") == NULL);
    free(text);
    ves_figure_destroy(figure);
    bed_clear(&b);
}

/* vtp: two cells of polylines over 16 points, with u and the patch's number. */
Test(spine, vtp_has_a_polyline_for_each)
{
    bed b = bed_with(SHAPE, NULL, 8, 16);
    ves_figure *figure = figure_of(&b);
    char *text = written(figure, "vtp", b.diag);
    cr_expect(strstr(text, "NumberOfPoints=\"16\"") && strstr(text, "NumberOfLines=\"2\""), "%s", text);
    static const char *const array[] = {
        "Name=\"u\"",       "Name=\"patch\"",        "Name=\"Points\"", "<Lines>", "Name=\"connectivity\"",
        "Name=\"offsets\"", "</Lines>\n    </Piece>"};
    const char *at = text;
    for (int k = 0; k < 7; k++) {
        at = strstr(at, array[k]);
        cr_assert(at != NULL, "no %s in its place", array[k]);
        if (k == 3 || k == 6) continue;
        at = strchr(at, '>') + 1;
        if (k == 2) expect_points(&figure->patch[0], NULL, &at), expect_points(&figure->patch[2], NULL, &at);
        for (int i = 0; i < 2 * ROWS && k < 2; i++)
            cr_expect_eq(next(&at), k ? i / ROWS * 2 : (double)(i % ROWS) / ALONG);
        for (int i = 0; i < 2 * ROWS && k == 4; i++) cr_expect_eq(next(&at), i);
        for (int i = 1; i <= 2 && k == 5; i++) cr_expect_eq(next(&at), i * ROWS);
        cr_expect(strncmp(at + strspn(at, " \n"), "</DataArray>", 12) == 0, "%s: %.30s", array[k], at);
    }
    free(text);
    ves_figure_destroy(figure);
    bed_clear(&b);
}

Test(spine, csv_has_a_line_for_each_place)
{
    bed b = bed_with(SHAPE, NULL, 8, 16);
    ves_figure *figure = figure_of(&b);
    char *text = written(figure, "csv", b.diag), *line = strtok(text, "\n");
    cr_expect_str_eq(line, "patch,i,u,x,y,z");
    for (int n = 0; n < 2 * ROWS; n++) {
        const ves_figure_patch *p = &figure->patch[n / ROWS * 2];
        int i = -1, length = 0;
        double u, x[3];
        char name[8] = "";
        line = strtok(NULL, "\n");
        cr_assert(line &&
                  sscanf(line, "%4[a-z],%d,%lf,%lf,%lf,%lf%n", name, &i, &u, &x[0], &x[1], &x[2], &length) ==
                      6 &&
                  line[length] == 0);
        cr_expect(strcmp(name, p->name) == 0 && i == n % ROWS && u == (double)i / ALONG);
        for (int c = 0; c < 3; c++) cr_expect(x[c] == p->spine[c][i]);
    }
    cr_expect(strtok(NULL, "\n") == NULL);
    free(text);
    ves_figure_destroy(figure);
    bed_clear(&b);
}

/* What has no lines says so. */
Test(spine, meshes_have_no_lines)
{
    static const char *const format[] = {"stl", "ply", "off"};
    for (int k = 0; k < 3; k++) cr_expect(ves_format_find(format[k])->spines == NULL, "%s", format[k]);
}

/* Asked for, they are the last things drawn, each in as many pieces as the patch has rows. */
Test(spine, pictures_show_spines_over_the_shape)
{
    bed b = bed_with(SHAPE, NULL, 8, 16);
    ves_figure *figure = figure_of(&b);
    const ves_frame frame = {40, 40, 600, 600, 4};
    ves_view view = ves_view_default();
    for (int asked = 0; asked < 2; asked++) {
        ves_arena arena = {0};
        ves_scene scene;
        int found = 0, last = 0;
        view.spines = asked;
        cr_assert_eq(ves_scene_build(&scene, figure, &view, &frame, &arena), VES_OK);
        for (int k = 0; k < scene.pieces; k++) {
            found += scene.piece[k].spine;
            last += scene.piece[k].spine && k >= scene.pieces - 2 * ALONG;
        }
        cr_expect(found == asked * 2 * ALONG && last == found, "%d of %d", last, found);
        ves_arena_destroy(&arena);
    }
    ves_figure_destroy(figure);
    bed_clear(&b);
}
