/* --set name=value written into the text of a problem file, so that what runs is what the run folder keeps. */
#ifndef VES_PROBLEM_OVERRIDE_H
#define VES_PROBLEM_OVERRIDE_H

#include "problem/problem.h"
#include "problem/script.h"
#include "problem/tree.h"

/* Applies all overrides; *root is the tree of the final text. Each override is a source of its own for
 * messages. */
ves_status ves_override_apply(ves_script *script, const ves_read_options *options, const ves_node **root,
                              ves_diag *diag);

#endif
