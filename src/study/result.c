#include "study/result.h"

#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "base/vector.h"

static void variables(const ves_problem *problem, const double *x, ves_json *json)
{
    ves_json_object(json, "variables");
    for (int k = 0; k < problem->variables; k++) ves_json_number(json, problem->variable[k].name, x[k]);
    ves_json_end(json, '}');
}

static void measures(const ves_problem *problem, const ves_design *design, ves_json *json)
{
    ves_json_object(json, "measures");
    for (int k = 0; k < problem->measures; k++)
        ves_json_number(json, problem->measure[k].name, design->measure[k]);
    ves_json_end(json, '}');
}

static void unit(const ves_problem *problem, const char *key, ves_dim dim, ves_json *json)
{
    char text[48];
    ves_dim_text(dim, text);
    ves_json_text(json, key, problem->units && !dim.any ? text : "1");
}

static void constraints(const ves_problem *problem, const ves_design *design, ves_json *json)
{
    ves_json_array(json, "constraints");
    for (int k = 0; k < problem->constraints; k++) {
        const ves_sides *s = &design->side[k];
        ves_json_object(json, NULL);
        ves_json_text(json, "text", problem->constraint[k].text);
        ves_json_number(json, "value", s->value);
        ves_json_number(json, "limit", s->limit);
        ves_json_number(json, "violation", s->violation);
        ves_dim dim = ves_formula_dim(problem->constraint[k].left);
        unit(problem, "unit", dim.any ? ves_formula_dim(problem->constraint[k].right) : dim, json);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

/* null: none of these, or it cannot be measured. */
static void kind(const ves_problem *problem, int k, ves_json *json)
{
    if (problem->kinds) ves_json_text(json, "kind", ves_problem_kind(problem, k));
}

static void checks(const ves_problem *problem, const ves_design *design, ves_json *json)
{
    const ves_validity_def *v = &problem->validity;
    if (!v->checks) return;
    ves_json_array(json, "checks");
    for (int k = 0; k < v->checks; k++) {
        ves_json_object(json, NULL);
        ves_json_text(json, "text", v->check[k].text);
        ves_json_flag(json, "holds", design->check[k]);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

/* Of all numbers here: SI, whatever the file writes. "1": none, as everywhere in a file without units. */
static void units(const ves_problem *problem, ves_json *json)
{
    ves_json_object(json, "units");
    if (problem->objective) unit(problem, "objective", ves_formula_dim(problem->objective), json);
    ves_json_object(json, "variables");
    for (int k = 0; k < problem->variables; k++) {
        const ves_variable *v = &problem->variable[k];
        if (!strcmp(v->shown.unit, "deg"))
            ves_json_text(json, v->name, "rad");
        else
            unit(problem, v->name, v->dim, json);
    }
    ves_json_end(json, '}');
    ves_json_object(json, "measures");
    for (int k = 0; k < problem->measures; k++)
        unit(problem, problem->measure[k].name, problem->measure[k].dim, json);
    ves_json_end(json, '}');
    if (problem->solve) {
        ves_json_object(json, "unknown");
        unit(problem, problem->solve->name, problem->solve->dim, json);
        ves_json_end(json, '}');
    }
    ves_json_end(json, '}');
}

/* What solve: found. */
static void unknown(const ves_problem *problem, const ves_design *design, ves_json *json)
{
    if (!problem->solve) return;
    ves_json_object(json, "unknown");
    ves_json_number(json, problem->solve->name,
                    design->status == VES_OK ? design->slot[problem->variables] : NAN);
    ves_json_end(json, '}');
}

void ves_result_design(const ves_problem *problem, const ves_design *design, ves_json *json)
{
    kind(problem, design->kind, json);
    variables(problem, design->x, json);
    measures(problem, design, json);
    ves_json_number(json, "objective", design->objective);
    ves_json_number(json, "violation", design->violation);
    ves_json_flag(json, "feasible", design->feasible);
    constraints(problem, design, json);
    checks(problem, design, json);
    unknown(problem, design, json);
    if (problem->scale) ves_json_number(json, "scale", design->similarity);
    units(problem, json);
    if (design->status != VES_OK) ves_json_text(json, "status", ves_status_text(design->status));
}

static void grids(const ves_run *run, ves_json *json)
{
    ves_json_object(json, "quadrature");
    ves_json_integer(json, "u", run->quadrature[0]);
    ves_json_integer(json, "v", run->quadrature[1]);
    ves_json_number(json, "change", run->change);
    ves_json_end(json, '}');
    ves_json_object(json, "finer");
    ves_json_number(json, "objective", run->finer.objective);
    measures(run->problem, &run->finer, json);
    checks(run->problem, &run->finer, json);
    ves_json_number(json, "change", run->finer_change);
    ves_json_end(json, '}');
}

static void start(const ves_run *run, ves_json *json)
{
    ves_json_object(json, "start");
    kind(run->problem, run->start.kind, json);
    ves_json_number(json, "objective", run->start.objective);
    ves_json_number(json, "violation", run->start.violation);
    variables(run->problem, run->start.x, json);
    measures(run->problem, &run->start, json);
    ves_json_end(json, '}');
}

static void optima(const ves_run *run, ves_json *json)
{
    ves_json_array(json, "optima");
    for (int k = 0; k < run->optima; k++) {
        const ves_optimum *o = &run->optimum[k];
        ves_json_object(json, NULL);
        ves_json_number(json, "value", o->value);
        ves_json_number(json, "violation", o->violation);
        kind(run->problem, run->optimum_kind[k], json);
        ves_json_integer(json, "hits", o->hits);
        ves_json_flag(json, "saddle", o->saddle);
        variables(run->problem, o->x, json);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

static void sentences(const ves_run *run, ves_json *json)
{
    ves_json_array(json, "notes");
    for (int k = 0; k < run->notes; k++) ves_json_text(json, NULL, run->note[k]);
    ves_json_end(json, ']');
    ves_json_array(json, "expect");
    for (int k = 0; k < run->expects; k++) {
        ves_json_object(json, NULL);
        ves_json_text(json, "text", run->expect[k].text);
        ves_json_flag(json, "passed", run->expect[k].passed);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

static const char *health_word(ves_health health)
{
    static const char *const word[] = {"frozen", "not equilibrated", "budget too short", "sampled",
                                       "stopped"};
    return word[health];
}

static void annealings(const ves_run *run, ves_json *json)
{
    ves_json_array(json, "annealings");
    for (int k = 0; k < run->annealings; k++) {
        const ves_annealing_report *r = &run->annealing[k];
        ves_json_object(json, NULL);
        ves_json_integer(json, "stage", r->stage);
        ves_json_text(json, "proposal", r->proposal);
        ves_json_text(json, "schedule", r->schedule);
        ves_json_text(json, "population", r->population);
        ves_json_text(json, "constraints", r->constraints);
        ves_json_text(json, "polish", r->polish);
        ves_json_integer(json, "chains", r->chains);
        ves_json_integer(json, "legs", r->legs);
        ves_json_number(json, "c0", r->c0);
        ves_json_number(json, "c", r->c);
        ves_json_number(json, "freezing", r->freezing);
        ves_json_number(json, "peak", r->peak);
        ves_json_number(json, "apart", r->apart);
        ves_json_integer(json, "swaps", r->swaps);
        ves_json_integer(json, "swapped", r->swapped);
        ves_json_number(json, "least_swap", r->least_swap);
        ves_json_text(json, "health", health_word(r->health));
        ves_json_text(json, "sentence", r->sentence);
        ves_json_object(json, "moves");
        for (int j = 0; j < r->moves; j++) {
            ves_json_object(json, r->move[j]);
            ves_json_integer(json, "trials", r->count[j].trials);
            ves_json_integer(json, "accepted", r->count[j].accepted);
            ves_json_number(json, "width", r->count[j].width);
            ves_json_end(json, '}');
        }
        ves_json_end(json, '}');
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

/* In the order of the moves of its annealing. */
static void moves(const ves_run *run, const ves_temperature *t, ves_json *json)
{
    int count = run->annealing[t->annealing].moves;
    ves_json_array(json, "acceptance");
    for (int j = 0; j < count; j++)
        ves_json_number(json, NULL, (double)t->move[j].accepted / (double)t->move[j].trials);
    ves_json_end(json, ']');
    ves_json_array(json, "width");
    for (int j = 0; j < count; j++) ves_json_number(json, NULL, t->move[j].width);
    ves_json_end(json, ']');
}

static void statistics(const ves_run *run, ves_json *json)
{
    ves_json_object(json, "failed");
    for (int k = 0; k < run->failures; k++)
        ves_json_integer(json, ves_status_word(run->failure[k].status), run->failure[k].count);
    ves_json_end(json, '}');
    annealings(run, json);
    ves_json_array(json, "temperatures");
    for (int k = 0; k < run->temperatures; k++) {
        const ves_temperature *t = &run->temperature[k];
        ves_json_object(json, NULL);
        ves_json_integer(json, "stage", t->stage);
        ves_json_integer(json, "annealing", t->annealing);
        ves_json_integer(json, "leg", t->leg);
        ves_json_number(json, "c", t->c);
        ves_json_integer(json, "steps", t->steps);
        ves_json_integer(json, "trials", t->trials);
        ves_json_integer(json, "accepted", t->accepted);
        ves_json_number(json, "mean", t->mean);
        ves_json_number(json, "variance", t->variance);
        moves(run, t, json);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

static void strategies(const ves_run *run, ves_json *json)
{
    ves_json_array(json, "strategies");
    for (int k = 0; k < run->strategies; k++) {
        const ves_strategy_report *r = &run->strategy[k];
        ves_json_object(json, NULL);
        ves_json_integer(json, "stage", r->stage);
        ves_json_text(json, "name", r->name);
        ves_json_integer(json, "evaluations", r->evaluations);
        ves_json_integer(json, "gradients", r->gradients);
        ves_json_integer(json, "bests", r->bests);
        ves_json_flag(json, "best", r->best);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

static void evidence(const ves_run *run, ves_json *json)
{
    static const char *const word[] = {
        [VES_TRUST_NONE] = "none",           [VES_TRUST_STOPPED] = "stopped",
        [VES_TRUST_REFUSED] = "refused",     [VES_TRUST_SHORT] = "budget too short",
        [VES_TRUST_EDGE] = "edge",           [VES_TRUST_KINK] = "kink",
        [VES_TRUST_LOST] = "lost",           [VES_TRUST_FROZEN] = "frozen",
        [VES_TRUST_CONVERGED] = "converged", [VES_TRUST_REPEATED] = "repeated"};
    const ves_evidence *e = &run->evidence;
    if (!e->sentence) return;
    ves_json_object(json, "evidence");
    ves_json_text(json, "verdict", word[e->trust]);
    ves_json_text(json, "sentence", e->sentence);
    ves_json_integer(json, "descents", e->descents);
    ves_json_integer(json, "minima", e->minima);
    ves_json_integer(json, "hits", e->hits);
    ves_json_integer(json, "unmeasured", e->unmeasured);
    ves_json_number(json, "expected_minima", e->expected);
    ves_json_number(json, "unseen", e->unseen);
    ves_json_end(json, '}');
}

/* What of the objective one unit of something costs. */
static void rate(const ves_problem *problem, ves_dim of, double value, ves_json *json)
{
    ves_dim dim = problem->objective ? ves_formula_dim(problem->objective) : (ves_dim){.any = true};
    dim.m = (signed char)(dim.m - of.m);
    dim.kg = (signed char)(dim.kg - of.kg);
    dim.s = (signed char)(dim.s - of.s);
    ves_json_number(json, "rate", value);
    unit(problem, "unit", dim, json);
}

/* What holds the best, and what the objective changes by when it is moved: by so much for each unit added to the
 * limit of the constraint, or to the bound. */
static void kkt(const ves_run *run, ves_json *json)
{
    const ves_problem *p = run->problem;
    const ves_kkt *k = &run->kkt;
    if (!k->known) return;
    ves_json_object(json, "kkt");
    ves_json_number(json, "slope", k->slope);
    ves_json_number(json, "residual", k->residual);
    ves_json_flag(json, "unique", k->unique);
    ves_json_array(json, "constraints");
    for (int j = 0; j < p->constraints; j++) {
        const ves_constraint_def *c = &p->constraint[j];
        ves_dim dim = ves_formula_dim(c->left);
        if (k->multiplier[j] == 0) continue;
        ves_json_object(json, NULL);
        ves_json_text(json, "text", c->text);
        rate(p, dim.any ? ves_formula_dim(c->right) : dim, k->multiplier[j], json);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
    ves_json_array(json, "bounds");
    for (int i = 0; i < p->variables; i++) {
        const ves_variable *v = &p->variable[i];
        if (k->bound[i] == 0) continue;
        ves_json_object(json, NULL);
        ves_json_text(json, "variable", v->name);
        ves_json_text(json, "side", run->best.x[i] - v->min < v->max - run->best.x[i] ? "lower" : "upper");
        rate(p, v->dim, k->bound[i], json);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
    ves_json_end(json, '}');
}

/* The files to give again with --plugin. */
static void plugins(const ves_problem *problem, ves_json *json)
{
    const char *const *file = problem->plugin_file;
    if (!file) return;
    ves_json_array(json, "plugins");
    for (; *file; file++) ves_json_text(json, NULL, *file);
    ves_json_end(json, ']');
}

void ves_result_joints(const ves_run *run, ves_json *json)
{
    ves_json_array(json, "joints");
    for (int k = 0; k < run->joints; k++) {
        const ves_joint *j = &run->joint[k];
        ves_json_object(json, NULL);
        ves_json_array(json, "ends");
        for (int i = 0; i < 2; i++) {
            char end[96];
            snprintf(end, sizeof end, "%.80s.u%d", run->problem->patch[j->patch[i]].name, j->end[i]);
            ves_json_text(json, NULL, end);
        }
        ves_json_end(json, ']');
        ves_json_text(json, "curve", j->curve);
        ves_json_number(json, "gap", j->gap);
        ves_json_number(json, "angle_deg", j->angle * 180 / VES_PI);
        ves_json_number(json, "slope_jump", j->slope_jump);
        ves_json_number(json, "second_jump", j->second_jump);
        ves_json_number(json, "curvature_jump", j->curvature_jump);
        ves_json_number(json, "curvature_relative", j->curvature_relative);
        ves_json_text(json, "class", ves_joint_text(j->continuity));
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

void ves_result_write(const ves_run *run, ves_json *json)
{
    const ves_problem *problem = run->problem;
    ves_json_text(json, "title", problem->title);
    ves_json_text(json, "goal", problem->objective_text);
    ves_json_flag(json, "maximize", problem->maximize);
    ves_json_number(json, "objective", run->best.objective);
    ves_json_flag(json, "feasible", run->feasible);
    kind(problem, run->best.kind, json);
    ves_json_number(json, "violation", run->best.violation);
    variables(problem, run->best.x, json);
    measures(problem, &run->best, json);
    constraints(problem, &run->best, json);
    checks(problem, &run->best, json);
    unknown(problem, &run->best, json);
    if (problem->scale) ves_json_number(json, "scale", run->best.similarity);
    ves_result_joints(run, json);
    units(problem, json);
    ves_json_integer(json, "evaluations", run->evaluations);
    ves_json_integer(json, "gradients", run->gradients);
    ves_json_integer(json, "refused", run->refused);
    ves_json_text(json, "stop", run->stop);
    ves_json_count(json, "seed", run->seed);
    ves_json_text(json, "version", VESICA_VERSION);
    plugins(problem, json);
    grids(run, json);
    start(run, json);
    optima(run, json);
    evidence(run, json);
    kkt(run, json);
    strategies(run, json);
    sentences(run, json);
    statistics(run, json);
}

void ves_result_times(const ves_run *run, ves_json *json)
{
    const ves_run_times *t = &run->times;
    ves_json_text(json, "started", t->started);
    ves_json_number(json, "wall_s", t->wall);
    ves_json_number(json, "cpu_s", t->cpu);
    ves_json_number(json, "search_s", t->search);
    ves_json_integer(json, "jobs", run->jobs);
    ves_json_integer(json, "machine_threads", t->threads);
    ves_json_array(json, "stages");
    for (int k = 0; k < t->stages; k++) {
        ves_json_object(json, NULL);
        ves_json_text(json, "name", t->stage[k].name);
        ves_json_integer(json, "evaluations", t->stage[k].evaluations);
        ves_json_number(json, "wall_s", t->stage[k].wall);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}
