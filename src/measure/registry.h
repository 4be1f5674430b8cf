/* The measures that are built in: one file each under src/measure/list/, file name = word in problem files =
 * symbol. */
#ifndef VES_MEASURE_REGISTRY_H
#define VES_MEASURE_REGISTRY_H

#include "vesica/measure.h"

const ves_measure *const *ves_measures(void); /* NULL-terminated, sorted by name */

/* By name, among the built-in ones and then the plugins' (NULL-terminated, or NULL). NULL: there is none. */
const ves_measure *ves_measure_find(const char *name, const ves_measure *const *plugin);

#endif
