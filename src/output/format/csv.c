/* One line a node. Numbers in the shortest form that reads back exactly, with a point whatever the locale
 * [RFC 4180]. */
#include <string.h>

#include "base/text.h"
#include "output/file.h"
#include "output/output.h"

static void text(FILE *out, const char *word)
{
    if (!strpbrk(word, ",\"\r\n")) {
        fputs(word, out);
        return;
    }
    putc('"', out);
    for (; *word; word++) {
        if (*word == '"') putc('"', out);
        putc(*word, out);
    }
    putc('"', out);
}

static void number(FILE *out, double value)
{
    char buffer[32];
    ves_text_shortest(value, buffer);
    putc(',', out);
    fputs(buffer, out);
}

static void node_write(FILE *out, const ves_figure_patch *p, int node)
{
    text(out, p->name ? p->name : "");
    fprintf(out, ",%d,%d", node / p->columns, node % p->columns);
    number(out, ves_figure_u(p, node));
    number(out, ves_figure_v(p, node));
    for (int c = 0; c < 3; c++) number(out, p->X[c][node]);
    for (int c = 0; c < 3; c++) number(out, p->normal[c][node]);
    number(out, p->H[node]);
    number(out, p->K[node]);
    number(out, p->k1[node]);
    number(out, p->k2[node]);
    putc('\n', out);
}

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    ves_file file;
    VES_TRY(ves_file_begin(&file, path, "csv", diag));
    fputs("patch,i,j,u,v,x,y,z,nx,ny,nz,H,K,k1,k2\n", file.out);
    for (int k = 0; k < figure->patches; k++)
        for (int node = 0; node < figure->patch[k].rows * figure->patch[k].columns; node++)
            node_write(file.out, &figure->patch[k], node);
    return ves_file_end(&file, VES_OK, diag);
}

static ves_status spines(ves_figure *figure, const char *path, ves_diag *diag)
{
    ves_file file;
    VES_TRY(ves_file_begin(&file, path, "csv", diag));
    fputs("patch,i,u,x,y,z\n", file.out);
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        for (int i = 0; i < p->rows && p->spine[0]; i++) {
            text(file.out, p->name ? p->name : "");
            fprintf(file.out, ",%d", i);
            number(file.out, (double)i / p->nu);
            for (int c = 0; c < 3; c++) number(file.out, p->spine[c][i]);
            putc('\n', file.out);
        }
    }
    return ves_file_end(&file, VES_OK, diag);
}

const ves_format ves_format_csv = {.name = "csv",
                                   .about = "nodes with normals and curvatures, for spreadsheets",
                                   .write = write,
                                   .spines = spines};
