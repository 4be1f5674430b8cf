#include "output/mesh.h"

#include "bridge/bridge.h"
#include "output/file.h"

ves_status ves_mesh_write(ves_figure *figure, const char *path, const char *ending, ves_diag *diag)
{
    ves_mesh mesh;
    ves_file file;
    char message[VES_BRIDGE_TEXT] = "";
    ves_status status = ves_figure_mesh(figure, true, &mesh);
    if (status != VES_OK)
        return ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "cannot weld the patches: %s",
                            ves_status_text(status));
    VES_TRY(ves_file_begin(&file, path, ending, diag));
    if (file.temporary)
        status = ves_bridge_write(&mesh, file.temporary, message);
    else
        status =
            ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot write \"%s\": not a file", path);
    if (file.temporary && status != VES_OK)
        ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "cannot write \"%s\": %s", path, message);
    else if (message[0])
        ves_diag_add(diag, VES_WARNING, VES_OK, (ves_mark){0}, "\"%s\": %s", path, message);
    return ves_file_end(&file, status, diag);
}
