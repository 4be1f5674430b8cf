/* What the public header tells about a run. */
#include "study/run.h"

const double *ves_run_best(const ves_run *run, double *objective, double *violation, const double **measures)
{
    if (!run->any) return NULL;
    if (objective) *objective = run->best.objective;
    if (violation) *violation = run->best.violation;
    if (measures) *measures = run->best.measure;
    return run->best.x;
}

bool ves_run_feasible(const ves_run *run)
{
    return run->feasible;
}

bool ves_run_passed(const ves_run *run)
{
    return run->passed;
}

const char *ves_run_stop(const ves_run *run)
{
    return run->stop;
}

int ves_run_notes(const ves_run *run)
{
    return run->notes;
}

const char *ves_run_note(const ves_run *run, int index)
{
    return run->note[index];
}

const char *ves_run_folder(const ves_run *run)
{
    return run->folder;
}
