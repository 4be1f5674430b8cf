/* Apart: how two optima of a run differ, in words. */
#ifndef VES_STUDY_APART_H
#define VES_STUDY_APART_H

#include "study/run.h"

enum { VES_APART = 3, VES_APART_TEXT = 160 };

/* "d2Ry = -0.4724": the variables of optimum `index` that differ most, relative to their ranges, from those of optimum
 * `other`, in the units of the file; those that have no effect are left out. Returns how many. */
int ves_apart_tell(const ves_run *run, int index, int other, char text[VES_APART][VES_APART_TEXT]);

#endif
