/* Lists of points: what is a row, what is not, and where it stands. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

#include "study/points.h"

static ves_status read_points(const char *bytes, size_t length, ves_points *points, char message[500])
{
    ves_diag *diag = ves_diag_create();
    FILE *in = fmemopen((void *)bytes, length, "rb");
    ves_status status = ves_points_read(in, "p.csv", points, diag);
    message[0] = 0;
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, message, 500);
    cr_expect_eq(ves_diag_count(diag), status != VES_OK);
    ves_diag_destroy(diag);
    fclose(in);
    return status;
}

Test(points, rows_may_be_written_as_spreadsheets_do)
{
    static const char *const text[] = {
        "0.25,1\n1,-2e3\n", "u,v\n0.25,1\n1,-2e3", " 0.25 , 1 \r\n\r\n1,-2e3\r\n",
        "\xEF\xBB\xBFU, V\r\n0.25,1\r\n1,-2e3\r\n", "\"u\",\"v\"\n0.25,1\n1,-2e3\n"};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        ves_points p;
        char message[500];
        cr_assert_eq(read_points(text[k], strlen(text[k]), &p, message), VES_OK, "%zu: %s", k, message);
        cr_assert(p.count == 2 && p.u[0] == 0.25 && p.v[0] == 1 && p.u[1] == 1 && p.v[1] == -2e3, "%zu", k);
        ves_points_free(&p);
    }
}

Test(points, a_row_that_is_none_is_told_with_its_line)
{
    char longer[600];
    snprintf(longer, sizeof longer, "0.5,1%280s\n0.5,2\n", "");
    static const char zero[] = "0.5,1\n0.5,1\0"
                               "2\n";
    const struct {
        const char *bytes, *want;
        size_t length;
    } row[] = {
        {"0,0\n0.5\n", "error: p.csv:2: two numbers u,v are needed, found \"0.5\"", 8},
        {"0,0\n\n0.5,1,2\n", "error: p.csv:3: two numbers u,v are needed, found \"0.5,1,2\"", 13},
        {"v,u\n0,1\n", "error: p.csv:1: two numbers u,v are needed, found \"v,u\"", 8},
        {"0,0\nu,v\n", "error: p.csv:2: two numbers u,v are needed, found \"u,v\"", 8},
        {"0,nan\n", "error: p.csv:1: two numbers u,v are needed", 6},
        {"1e999,0\n", "error: p.csv:1: two numbers u,v are needed", 8},
        {"1.5,0\n", "error: p.csv:1: u = 1.5 lies outside the patch (0 to 1)", 6},
        {"-1e-300,0\n", "error: p.csv:1: u = -1e-300 lies outside", 10},
        {"u,v\n", "error: \"p.csv\" has no points", 4},
        {longer, "error: p.csv:1: two numbers u,v are needed, found a line of 256 bytes or more",
         strlen(longer)},
        {zero, "error: p.csv:2: two numbers u,v are needed, found a line of 256 bytes or more, or no text",
         sizeof zero - 1},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        ves_points p;
        char message[500];
        cr_expect_neq(read_points(row[k].bytes, row[k].length, &p, message), VES_OK);
        cr_expect(!strncmp(message, row[k].want, strlen(row[k].want)), "%zu: got %s, want %s", k, message,
                  row[k].want);
        ves_points_free(&p);
    }
}
