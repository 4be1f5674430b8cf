/* What is said of the best of a run once it is there: its joints, its kind, and whether what `expect:` asks for
 * holds. */
#ifndef VES_STUDY_JUDGE_H
#define VES_STUDY_JUDGE_H

#include "base/arena.h"
#include "vesica/run.h"

/* Only of a best that can be measured; the plan evaluates it again. VES_OK or a fault. */
ves_status ves_judge_joints(ves_plan *plan, ves_run *run, ves_arena *arena);

/* A note where a search has ended at another kind of design than it began at; NULL: it has not, or one of them
 * cannot be measured. VES_OK or VES_MEMORY. */
ves_status ves_judge_kind(const ves_run *run, ves_arena *arena, const char **note);

/* test: what `test:` gives replaces what the file expects. VES_OK or VES_MEMORY. */
ves_status ves_judge_expect(ves_run *run, bool test, ves_arena *arena);

#endif
