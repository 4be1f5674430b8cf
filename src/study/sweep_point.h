/* One point of a sweep: the problem there, its search, and what came of it. */
#ifndef VES_STUDY_SWEEP_POINT_H
#define VES_STUDY_SWEEP_POINT_H

#include "study/sweep.h"
#include "vesica/figure.h"

typedef struct ves_sweep_task {
    const ves_sweep *sweep;
    const ves_sweep_options *options;
    const ves_sweep_hooks *hooks;
    int jobs; /* threads of one run */
} ves_sweep_task;

/* Reads the problem with what a branch sets, to tell what is wrong with it before anything is searched. */
ves_status ves_sweep_branch_check(const ves_sweep_task *task, int branch, ves_diag *diag);

/* from: the point whose best it begins at, moved into the ranges; -1: it begins where the branch does. Keeps
 * what it finds in the arena and the shape in the folder. VES_INTERRUPTED: stopped, nothing is known. Otherwise
 * negative for faults. diag is for this point alone. */
ves_status ves_sweep_point_find(const ves_sweep_task *task, int index, int from, ves_arena *arena,
                                ves_diag *diag);

/* The shape of a good point, as fine as a small picture needs it, owned by the caller. A positive status: it has none. */
ves_status ves_sweep_point_figure(const ves_sweep_task *task, int index, ves_figure **figure);

#endif
