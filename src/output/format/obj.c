#include "base/text.h"
#include "output/file.h"
#include "output/mesh.h"

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    return ves_mesh_write(figure, path, "obj", diag);
}

/* One object a patch: its vertices, and one line element through them. */
static ves_status spines(ves_figure *figure, const char *path, ves_diag *diag)
{
    ves_file file;
    char at[32];
    int vertex = 1;
    VES_TRY(ves_file_begin(&file, path, "obj", diag));
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        if (!p->spine[0]) continue;
        fprintf(file.out, "o %s\n", p->name ? p->name : "");
        for (int i = 0; i < p->rows; i++) {
            putc('v', file.out);
            for (int c = 0; c < 3; c++) {
                ves_text_shortest(p->spine[c][i], at);
                fprintf(file.out, " %s", at);
            }
            putc('\n', file.out);
        }
        putc('l', file.out);
        for (int i = 0; i < p->rows; i++) fprintf(file.out, " %d", vertex++);
        putc('\n', file.out);
    }
    return ves_file_end(&file, VES_OK, diag);
}

const ves_format ves_format_obj = {
    .name = "obj", .about = "triangles as text, for modelling programs", .write = write, .spines = spines};
