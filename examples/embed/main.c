/* vesica inside another program: runs a problem file and tells what came out, searches it again with a
 * polish of its own from the best, and takes the mesh of the shape. No file is written.
 *
 *     embed problems/bottle.yaml */
#include <stdio.h>

#include <vesica/vesica.h>

/* What went wrong, or was worth a warning. */
static int complain(const ves_diag *diag)
{
    char text[2000];
    for (int k = 0; k < ves_diag_count(diag); k++) {
        ves_diag_text(diag, k, text, sizeof text);
        fprintf(stderr, "%s\n", text);
    }
    return 1;
}

static void tell(const ves_run *run)
{
    static const char *const sense[] = {"<=", ">=", "=="};
    static const char *const ending[] = {"of itself", "its budget was spent", "it was stopped"};
    const ves_problem *p = run->problem;
    bool maximize;
    const char *objective = ves_problem_objective(p, &maximize);
    if (objective)
        printf("%s %s: %.9g (start %.9g)\n", maximize ? "maximize" : "minimize", objective,
               run->best.objective, run->start.objective);
    for (int k = 0; k < ves_problem_variables(p); k++)
        printf("  %s = %.6f\n", ves_problem_variable(p, k, NULL, NULL, NULL), run->best.x[k]);
    for (int k = 0; k < ves_problem_constraints(p); k++) {
        ves_relation relation;
        const char *text = ves_problem_constraint(p, k, &relation);
        const ves_sides *s = &run->best.side[k];
        printf("  %s: %.9g %s %.9g %s\n", text, s->value, sense[relation], s->limit,
               s->holds ? "holds" : "is violated");
    }
    for (int k = 0; k < run->optima; k++)
        printf("optimum %d: %.9g, found %d times%s\n", k + 1, run->optimum[k].value, run->optimum[k].hits,
               run->optimum[k].saddle ? ", a saddle" : "");
    for (int k = 0; k < run->notes; k++) printf("note: %s\n", run->note[k]);
    printf("%ld evaluations; ended: %s (%s)\n", run->evaluations, ending[run->ending], run->stop);
}

/* One polish by an algorithm that needs no gradients, from x. */
static ves_status polish(ves_plan *plan, const double *x)
{
    ves_search_problem search = ves_plan_search(&plan, 1);
    ves_search_options options = ves_search_options_default();
    ves_search_result *result;
    ves_design design;
    search.start = x;
    options.stages = 1;
    options.stage[0] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = ves_polish_default()};
    options.stage[0].polish.algorithm = "cobyla";
    ves_status status = ves_search_run(&search, &options, NULL, &result);
    if (status != VES_OK) return status;
    if (ves_plan_measure(plan, result->x, 0, &design) == VES_OK)
        printf("cobyla from there: %.9g in %ld evaluations\n", design.objective, result->evaluations);
    ves_search_result_destroy(result);
    return VES_OK;
}

static ves_status mesh_tell(ves_plan *plan, const double *x, ves_diag *diag)
{
    ves_figure *figure;
    ves_mesh mesh;
    double least = 0, most = 0;
    ves_status status = ves_plan_figure(plan, x, 0, 0, &figure, diag);
    if (status != VES_OK) return status;
    status = ves_figure_mesh(figure, false, &mesh);
    for (int k = 0; k < mesh.vertices; k++) {
        if (!k || mesh.H[k] < least) least = mesh.H[k];
        if (!k || mesh.H[k] > most) most = mesh.H[k];
    }
    printf("%d triangles, mean curvature %.4g to %.4g\n", mesh.triangles, least, most);
    ves_figure_destroy(figure);
    return status;
}

int main(int count, char **word)
{
    ves_diag *diag = ves_diag_create();
    ves_problem *problem = NULL;
    ves_run *run = NULL;
    ves_plan *plan = NULL;
    if (count != 2) return fprintf(stderr, "usage: embed FILE\n"), 2;
    ves_status status = ves_problem_read(word[1], NULL, &problem, diag);
    if (status == VES_OK) status = ves_run_create(problem, NULL, NULL, &run, diag);
    if (status == VES_OK) status = ves_plan_create(problem, NULL, &plan, diag);
    if (status == VES_OK && run->any) {
        tell(run);
        status = polish(plan, run->best.x);
        if (status == VES_OK) status = mesh_tell(plan, run->best.x, diag);
    }
    int code = status != VES_OK ? complain(diag) : run->feasible && run->passed ? 0 : 1;
    ves_plan_destroy(plan);
    ves_run_destroy(run);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
    return code;
}
