#include "output/mesh.h"

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    return ves_mesh_write(figure, path, "off", diag);
}

const ves_format ves_format_off = {
    .name = "off", .about = "triangles as text, for geometry programs", .write = write};
