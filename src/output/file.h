/* A file that appears whole or not at all: written under another name in the same folder, renamed when all
 * went well. What is no regular file (a pipe, a device) is written directly. */
#ifndef VES_OUTPUT_FILE_H
#define VES_OUTPUT_FILE_H

#include <stdio.h>

#include "vesica/diag.h"

typedef struct ves_file {
    const char *path; /* of the caller */
    char *temporary;  /* NULL: path is written directly */
    FILE *out;
} ves_file;

/* ending: that of the temporary name, for writers that look at it ("vtp"). On failure nothing is left to end. */
ves_status ves_file_begin(ves_file *file, const char *path, const char *ending, ves_diag *diag);

/* Ends it: renames when `status` is VES_OK and all was written, else removes it. Returns the first failure. */
ves_status ves_file_end(ves_file *file, ves_status status, ves_diag *diag);

/* VES_IO with "cannot write PATH: " and the reason (strerror of `error`; 0: unknown). */
ves_status ves_file_complain(const char *path, int error, ves_diag *diag);

#endif
