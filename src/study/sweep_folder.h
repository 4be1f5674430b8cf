/* The folder of a sweep: lines that are written once, and read back when it is gone on with. */
#ifndef VES_STUDY_SWEEP_FOLDER_H
#define VES_STUDY_SWEEP_FOLDER_H

#include "output/output.h"
#include "study/sweep.h"

/* Makes what a new folder begins with. */
ves_status ves_sweep_folder_begin(const ves_sweep *sweep, const ves_sweep_options *options, ves_arena *arena,
                                  ves_diag *diag);

/* How a sweep was asked for: sweep.json. */
typedef struct ves_sweep_about {
    const char *problem; /* the file's name */
    bool seeded;
    uint64_t seed;
    int plugins;
    const ves_saved_plugin *plugin;
} ves_sweep_about;
/* VES_USAGE: this is no folder of a sweep; VES_STALE: another version of vesica has walked there. */
ves_status ves_sweep_about_read(const char *folder, ves_arena *arena, ves_sweep_about *about, ves_diag *diag);
/* Opens the problem as it was read. plugin: NULL-terminated, or NULL. */
ves_status ves_sweep_about_open(const char *folder, const ves_sweep_about *about,
                                const ves_measure *const *plugin, ves_opened *opened, ves_diag *diag);

/* Appends point `index` to the file of its walk. */
ves_status ves_sweep_line_write(const ves_sweep *sweep, int index, ves_arena *arena, ves_diag *diag);

/* The points of a walk that are done, kept in the arena; what follows the last whole line is cut off if `cut`. *count:
 * how many there are. */
ves_status ves_sweep_lines_read(const ves_sweep *sweep, int walk, bool cut, ves_arena *arena, int *count,
                                ves_diag *diag);

/* One point as an object. compared: with what the points beside it say; clocks: and how long it took. */
void ves_sweep_point_json(const ves_sweep *sweep, int index, bool compared, bool clocks, ves_json *json);

#endif
