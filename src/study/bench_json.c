#include "study/bench_json.h"

#include <math.h>

static void interval(ves_json *json, const char *key, ves_interval i)
{
    const double part[] = {i.value, i.low, i.high};
    ves_json_array(json, key);
    for (int k = 0; k < 3; k++) ves_json_number(json, NULL, part[k]);
    ves_json_end(json, ']');
}

static void numbers(ves_json *json, const char *key, const double *value, int count)
{
    ves_json_array(json, key);
    for (int k = 0; k < count; k++) ves_json_number(json, NULL, value[k]);
    ves_json_end(json, ']');
}

static void hits(ves_json *json, const int *hit, const ves_interval *share)
{
    ves_json_array(json, "hits");
    for (int t = 0; t < VES_TARGETS; t++) ves_json_integer(json, NULL, hit[t]);
    ves_json_end(json, ']');
    ves_json_array(json, "share");
    for (int t = 0; t < VES_TARGETS; t++) interval(json, NULL, share[t]);
    ves_json_end(json, ']');
}

static void head(const ves_bench *bench, ves_json *json)
{
    const ves_suite *s = bench->suite;
    ves_json_text(json, "suite", s->title);
    ves_json_text(json, "version", VESICA_VERSION);
    ves_json_integer(json, "runs", bench->runs);
    ves_json_integer(json, "done", bench->done);
    ves_json_flag(json, "interrupted", bench->done < bench->runs);
    ves_json_integer(json, "seeds", s->seeds);
    ves_json_count(json, "seed", s->seed);
    ves_json_number(json, "budget_per_dimension", s->per_dimension);
    ves_json_number(json, "budget_most", s->most);
    ves_json_number(json, "cost", s->cost);
    ves_json_number(json, "cost_gradient", s->cost_gradient);
    numbers(json, "targets", s->target, VES_TARGETS);
}

/* A maximum with its own sign, not that of what is minimised. */
static double told(const ves_bench *bench, int problem, double value)
{
    return bench->problem[problem].maximize ? -value : value;
}

static void problem(const ves_bench *bench, int p, bool clocks, ves_json *json)
{
    const ves_suite *s = bench->suite;
    const ves_bench_problem *facts = &bench->problem[p];
    const ves_reference *r = &bench->tally.reference[p];
    bool found = !r->known && !isnan(r->value);
    ves_json_object(json, NULL);
    ves_json_text(json, "name", s->problem[p].name);
    ves_json_integer(json, "n", facts->n);
    ves_json_integer(json, "constraints", facts->m);
    ves_json_integer(json, "equations", facts->equalities);
    ves_json_text(json, "eliminated", *facts->eliminated ? facts->eliminated : NULL);
    ves_json_flag(json, "gradients", facts->gradients);
    ves_json_number(json, "budget", ves_suite_budget(s, facts->n));
    ves_json_flag(json, "maximize", facts->maximize);
    ves_json_number(json, "reference", told(bench, p, r->value));
    ves_json_flag(json, "known", r->known);
    ves_json_flag(json, "polished", r->polished);
    ves_json_number(json, "better_than_known", told(bench, p, r->below));
    ves_json_text(json, "found_by", found ? s->method[r->method].name : NULL);
    ves_json_number(json, "found_in", found ? (double)r->seed : NAN);
    if (clocks) ves_json_number(json, "value_s", facts->seconds);
    if (clocks) ves_json_number(json, "gradient_s", facts->seconds_gradient);
    ves_json_end(json, '}');
}

static void score(const ves_bench *bench, int e, int p, bool clocks, ves_json *json)
{
    const ves_suite *s = bench->suite;
    const ves_score *c = &bench->tally.score[e * s->problems + p];
    ves_json_object(json, NULL);
    ves_json_text(json, "method", s->method[e].name);
    ves_json_text(json, "problem", s->problem[p].name);
    ves_json_integer(json, "runs", c->runs);
    ves_json_integer(json, "failed", c->failed);
    ves_json_text(json, "reason", c->reason);
    hits(json, c->hits, c->share);
    ves_json_array(json, "ert");
    for (int t = 0; t < VES_TARGETS; t++) interval(json, NULL, c->ert[t]);
    ves_json_end(json, ']');
    ves_json_array(json, "quartiles"); /* the best first */
    for (int q = 0; q < 3; q++) ves_json_number(json, NULL, told(bench, p, c->quartile[q]));
    ves_json_end(json, ']');
    ves_json_number(json, "best", told(bench, p, c->best));
    ves_json_integer(json, "feasible", c->feasible);
    ves_json_number(json, "worst_violation", c->worst);
    if (clocks) interval(json, "ert_s", c->seconds);
    if (clocks) ves_json_number(json, "own_s", c->own);
    ves_json_end(json, '}');
}

static void total(const ves_bench *bench, int e, bool clocks, ves_json *json)
{
    const ves_total *c = &bench->tally.total[e];
    ves_json_object(json, NULL);
    ves_json_text(json, "name", bench->suite->method[e].name);
    ves_json_integer(json, "runs", c->runs);
    ves_json_integer(json, "failed", c->failed);
    ves_json_integer(json, "feasible", c->feasible);
    hits(json, c->hits, c->share);
    if (clocks) ves_json_number(json, "own_s", c->own);
    ves_json_end(json, '}');
}

static const char *const VERDICT[] = {"none to compare",     "too few runs",
                                      "no difference shown", "different, no direction",
                                      "the first is better", "the second is better"};

static void pairs(const ves_bench *bench, ves_json *json)
{
    const ves_suite *s = bench->suite;
    ves_json_array(json, "pairs");
    for (int i = 0; i < s->methods; i++)
        for (int j = i + 1; j < s->methods; j++) {
            const ves_pair *pair = &bench->tally.pair[i * s->methods + j];
            ves_json_object(json, NULL);
            ves_json_text(json, "first", s->method[i].name);
            ves_json_text(json, "second", s->method[j].name);
            ves_json_number(json, "a12", pair->effect);
            ves_json_number(json, "p", pair->p);
            ves_json_number(json, "p_by_problem", pair->by_problem);
            ves_json_number(json, "p_least", pair->least);
            ves_json_text(json, "verdict", VERDICT[ves_tally_finding(pair)]);
            ves_json_end(json, '}');
        }
    ves_json_end(json, ']');
}

static void optima(const ves_bench *bench, ves_json *json)
{
    const ves_suite *s = bench->suite;
    ves_json_array(json, "optima");
    for (int k = 0; k < bench->optima; k++) {
        const ves_bench_optimum *o = &bench->optimum[k];
        const ves_outcome *run = &bench->outcome[o->run];
        ves_json_object(json, NULL);
        ves_json_text(json, "problem", s->problem[o->problem].name);
        ves_json_number(json, "value", told(bench, o->problem, o->value));
        ves_json_integer(json, "run", o->run);
        ves_json_object(json, "hits");
        for (int e = 0; e < s->methods; e++) ves_json_integer(json, s->method[e].name, o->hits[e]);
        ves_json_end(json, '}');
        numbers(json, "x", run->x, run->n);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

void ves_bench_json(const ves_bench *bench, bool clocks, ves_json *json)
{
    const ves_suite *s = bench->suite;
    head(bench, json);
    if (clocks) ves_json_integer(json, "jobs", bench->jobs);
    if (clocks) ves_json_number(json, "wall_s", bench->wall);
    if (clocks) ves_json_text(json, "folder", bench->folder);
    ves_json_array(json, "problems");
    for (int p = 0; p < s->problems; p++) problem(bench, p, clocks, json);
    ves_json_end(json, ']');
    ves_json_array(json, "methods");
    for (int e = 0; e < s->methods; e++) total(bench, e, clocks, json);
    ves_json_end(json, ']');
    ves_json_array(json, "scores");
    for (int p = 0; p < s->problems; p++)
        for (int e = 0; e < s->methods; e++) score(bench, e, p, clocks, json);
    ves_json_end(json, ']');
    pairs(bench, json);
    optima(bench, json);
}
