/* The result of a run as JSON. The names are a contract: programs read them. */
#ifndef VES_STUDY_RESULT_H
#define VES_STUDY_RESULT_H

#include "output/output.h"
#include "study/run.h"

/* Everything but clock data: the same bytes for the same seed, whatever the number of jobs. To be called
 * inside an object, so that the caller can add to it. */
void ves_result_write(const ves_run *run, ves_json *json);

/* variables, measures, objective, violation of one design: what eval answers. */
void ves_result_design(const ves_problem *problem, const ves_design *design, ves_json *json);

/* joints: an array, of the best of a run. */
void ves_result_joints(const ves_run *run, ves_json *json);

/* times.json: all clock data. */
void ves_result_times(const ves_run *run, ves_json *json);

#endif
