#include "output/mesh.h"

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    return ves_mesh_write(figure, path, "stl", diag);
}

const ves_format ves_format_stl = {.name = "stl",
                                   .about =
                                       "triangles, binary, for printing (coordinates rounded to 7 digits)",
                                   .write = write};
