/* Saved: what a run folder keeps of how the run was asked for, beside problem.yaml: run.json. With both it can
 * go on. */
#ifndef VES_STUDY_SAVED_H
#define VES_STUDY_SAVED_H

#include "output/output.h"
#include "study/open.h"
#include "vesica/run.h"

typedef struct ves_saved_plugin {
    const char *given, *path; /* as the user wrote it; absolute */
    unsigned long sum;        /* of the file */
} ves_saved_plugin;

typedef struct ves_saved {
    const char *folder, *problem; /* the folder; the name of the problem file, for messages */
    ves_run_options options;
    int plugins;
    const ves_saved_plugin *plugin;
} ves_saved;

/* The plugins of a problem, as a list under the key "plugins", and back. */
ves_status ves_saved_plugins_write(const ves_problem *problem, ves_arena *arena, ves_json *json);
ves_status ves_saved_plugins_read(const ves_node *list, ves_arena *arena, const ves_saved_plugin **plugin,
                                  int *count);

/* run.json, when a run begins. */
ves_status ves_saved_write(const ves_run *run, const ves_run_options *options, ves_arena *arena,
                           ves_diag *diag);

/* VES_USAGE: this is no folder of a run that can go on. */
ves_status ves_saved_read(const char *folder, ves_arena *arena, ves_saved *saved, ves_diag *diag);

/* Measures of another make would go on with another search. path[plugins]: the files that are used now. */
ves_status ves_saved_compare(const ves_saved *saved, const char *const *path, ves_diag *diag);

/* Opens the problem as the run read it. plugin: NULL-terminated, or NULL. */
ves_status ves_saved_open(const ves_saved *saved, const ves_measure *const *plugin, ves_opened *opened,
                          ves_diag *diag);

/* The text of the head of its journal: one line of JSON. NULL: out of memory. */
char *ves_saved_head(const ves_run *run, const ves_run_options *options, ves_arena *arena);

#endif
