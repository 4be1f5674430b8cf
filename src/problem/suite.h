/* Suite files: read with the same tree, messages and tables as problem files. */
#ifndef VES_PROBLEM_SUITE_H
#define VES_PROBLEM_SUITE_H

#include "suite/suite.h"
#include "vesica/diag.h"

/* options: --set, and none besides. Every error of the file is in diag. The caller destroys *suite. The
 * problem files and plugins that it names are not opened. */
ves_status ves_suite_read(const char *path, const ves_read_options *options, ves_suite **suite,
                          ves_diag *diag);
/* The same for a text; what it names is looked for from the folder of `path` on. */
ves_status ves_suite_read_text(const char *path, const char *text, size_t length,
                               const ves_read_options *options, ves_suite **suite, ves_diag *diag);

#endif
