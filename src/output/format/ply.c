#include "output/mesh.h"

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    return ves_mesh_write(figure, path, "ply", diag);
}

const ves_format ves_format_ply = {
    .name = "ply", .about = "triangles, binary, coordinates to the last bit", .write = write};
