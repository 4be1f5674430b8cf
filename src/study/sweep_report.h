/* What the points of a sweep say together, and the files that show it. */
#ifndef VES_STUDY_SWEEP_REPORT_H
#define VES_STUDY_SWEEP_REPORT_H

#include "output/output.h"
#include "study/sweep.h"

/* Which ends at each place are the same, and which is the best. VES_OK or VES_MEMORY. */
ves_status ves_sweep_compare(ves_sweep *sweep);

/* The best goes from one walk to another: none is best at both places. All points between them are lost. */
typedef struct ves_sweep_change {
    int place, next;
    int from, to; /* walks */
    double at; /* the value where straight lines through the objectives of both walks cross; NAN: one is not
                     known at both places */
} ves_sweep_change;
/* The first change at `place` or behind it, of one second value. */
bool ves_sweep_change_find(const ves_sweep *sweep, int second, int place, ves_sweep_change *change);

/* What the file says that others have found of it, within a tenth of the values that are walked along; NULL: nothing. */
const ves_sweep_known *ves_sweep_change_known(const ves_sweep *s, const ves_sweep_change *change);

/* What `vesica sweep --json` says; inside an object. */
void ves_sweep_json(const ves_sweep *sweep, ves_json *json);

/* points.jsonl, times.jsonl, sweep.csv, sweep.png, shapes.pvd. */
ves_status ves_sweep_report_write(const ves_sweep *sweep, ves_diag *diag);

/* sweep.png. Of nothing that has a value there is none. */
ves_status ves_sweep_chart_write(const ves_sweep *sweep, ves_diag *diag);

/* The point that is marked as the best at one place of one second value; -1: all are lost. */
int ves_sweep_best_at(const ves_sweep *sweep, int second, int place);

/* At how many places two walks of one second value end at different optima; the first and the last of them. */
int ves_sweep_apart(const ves_sweep *sweep, int walk, int other, int *first, int *last);

#endif
