#include "output/mesh.h"

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    return ves_mesh_write(figure, path, "obj", diag);
}

const ves_format ves_format_obj = {
    .name = "obj", .about = "triangles as text, for modelling programs", .write = write};
