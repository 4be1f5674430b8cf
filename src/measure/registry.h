/* The measures that are built in: one file each under src/measure/list/, file name = word in problem files =
 * symbol. */
#ifndef VES_MEASURE_REGISTRY_H
#define VES_MEASURE_REGISTRY_H

#include "vesica/measure.h"

const ves_measure *const *ves_measures(void); /* NULL-terminated, sorted by name */

/* By name, among the built-in ones and then the plugins' (NULL-terminated, or NULL). NULL: there is none. */
const ves_measure *ves_measure_find(const char *name, const ves_measure *const *plugin);

/* Words with a meaning of their own in formulas, which nothing else can be called: "u|v|pi|...". */
extern const char ves_names_reserved[];

/* The most keys and looks of a measure. */
enum { VES_MEASURE_KEYS = 30, VES_MEASURE_LOOKS = 8 };

/* Is the descriptor of a measure from outside sound (vesica/measure.h says what that is), and its name not
 * that of a built-in one? The status of the first fault, which diag then has, or VES_OK. */
ves_status ves_measure_check(const ves_measure *m, ves_diag *diag);

/* The same of each of a list (NULL-terminated, or NULL), no two of which may have one name. */
ves_status ves_measures_check(const ves_measure *const *list, ves_diag *diag);

#endif
