/* Run folders: a new one for every run, nothing is ever overwritten, every file appears whole. */
#ifndef VES_STUDY_FOLDER_H
#define VES_STUDY_FOLDER_H

#include "base/arena.h"
#include "vesica/diag.h"

/* Makes PARENT/NAME-NNNN with the next free number. Two processes never get the same folder: mkdir
 * decides. */
ves_status ves_folder_number(const char *parent, const char *name, ves_arena *arena, char **folder,
                             ves_diag *diag);

/* Makes exactly this folder, with those above it. VES_USAGE: it is there already, and not empty. */
ves_status ves_folder_make(const char *path, ves_arena *arena, char **folder, ves_diag *diag);

/* Makes a folder and those above it, unless it is there. */
ves_status ves_folder_open(const char *path, ves_arena *arena, ves_diag *diag);

/* FOLDER/NAME; NULL when out of memory. */
char *ves_folder_path(const char *folder, const char *name, ves_arena *arena);

/* Names to names of files, each another one. What a file's name should not hold becomes '-' in it; where that makes
 * two one, the later gets -2, or the next number that makes a name that nobody has. name: [count] in and out. False:
 * out of memory. */
bool ves_folder_names(const char **name, int count, ves_arena *arena);

/* FOLDER/KIND/NAME.png, a name of ves_folder_names; the folder of its kind is made. */
ves_status ves_folder_picture(const char *folder, const char *kind, const char *name, ves_arena *arena,
                              char **path, ves_diag *diag);

/* Removes what a killed process left unfinished in a run folder (output/file.h). Nobody else may work there. */
void ves_folder_tidy(const char *path, ves_arena *arena);

bool ves_folder_is(const char *path); /* is there a folder? */

/* A path that does not exist yet: STEM.ENDING, or STEM-2.ENDING ... */
char *ves_folder_free(const char *stem, const char *ending, ves_arena *arena);

#endif
