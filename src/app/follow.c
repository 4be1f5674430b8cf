#include "app/follow.h"

#include <math.h>
#include <string.h>

#include "study/design.h"
#include "vesica/run.h"

static const double FAR = 0.1;   /* e of the displacement */
static const double MOST = 0.5;  /* of the mode's square: less is another displacement */
static const double BACK = 1e-5; /* of the objective: the same shape again */

static bool comes_back(const ves_stability *s, const ves_run *run)
{
    return fabs(run->best.objective - s->objective) <= BACK * fabs(s->objective);
}

static void tell(const ves_stability *s, const ves_run *run, const char *way, FILE *out)
{
    const ves_problem *p = run->problem;
    const double factor = p->objective_shown.factor, by = run->best.objective - s->objective;
    fprintf(out, "  %s  ", way);
    if (!run->any || !run->feasible)
        fputs("no design met all constraints", out);
    else if (comes_back(s, run))
        fputs("comes back to the design", out);
    else
        fprintf(out, "ends at %.9g, %.2g %s", run->best.objective / factor, fabs(by) / factor,
                by < 0 ? "lower" : "higher");
    if (run->any && p->kinds) fprintf(out, ": %s", ves_design_kind(p, run->best.kind));
    if (run->folder) fprintf(out, "   %s", run->folder);
    fputc('\n', out);
}

/* The problem that begins there, with a descent for a search. */
static ves_status read_at(app *a, const ves_problem *p, const double *x, ves_problem **there)
{
    ves_override *set = ves_arena_take(&a->arena, (size_t)p->variables + 1, sizeof *set);
    if (!set) return VES_MEMORY;
    VES_TRY(ves_study_starts(p, x, &a->arena, set));
    set[p->variables] = (ves_override){"search", "[{polish: {f_tolerance: 1e-10}}]"};
    const ves_read_options options = {
        .overrides = p->variables + 1, .override = set, .plugin = a->measure, .plugin_file = p->plugin_file};
    return ves_problem_read_text(p->path, p->text, strlen(p->text), &options, there, a->diag);
}

static ves_status descend(app *a, const ves_opened *opened, const ves_stability *s, const double *x,
                          const char *way)
{
    ves_problem *there = NULL;
    ves_run *run = NULL;
    const ves_run_options options = {.files = !a->options.no_files, .name = opened->name};
    ves_status status = read_at(a, opened->problem, x, &there);
    if (status == VES_OK) status = ves_run_create(there, &options, NULL, &run, a->diag);
    if (run) tell(s, run, way, a->options.json ? stderr : stdout);
    ves_run_destroy(run);
    ves_problem_destroy(there);
    return status;
}

void app_follow(app *a, const ves_opened *opened, const ves_stability *s, const double *change)
{
    static const char *const way[] = {"one way    ", "other way  "};
    const ves_problem *p = opened->problem;
    FILE *out = a->options.json ? stderr : stdout;
    double *x = ves_arena_take(&a->arena, (size_t)p->variables, sizeof *x);
    fprintf(out, "\n  along       n = %d: the variables of the file make %.3g %% of it%s\n", s->followed,
            100 * s->made,
            s->made < MOST
                ? ", which is too little to follow: it takes a file whose variables displace the shape so"
                : "");
    for (int k = 0; k < 2 && x && s->made >= MOST; k++) {
        for (int i = 0; i < p->variables; i++) x[i] = p->variable[i].start + (k ? -FAR : FAR) * change[i];
        if (descend(a, opened, s, x, way[k]) != VES_OK) app_say(a);
    }
}
