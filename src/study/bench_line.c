#include "study/bench_line.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "output/output.h"
#include "study/load.h"

enum { NUMBER = 32 };

static const double count_most = 9007199254740992; /* 2^53: a double tells whole numbers apart up to here */

static const char *const ENDS[] = {"failed", "target", "budget"};

/* --- writing --- */

static bool feasible(const ves_outcome *o)
{
    return o->any && o->violation <= 1;
}

void ves_bench_run_write(const ves_suite *suite, int index, const ves_outcome *o, FILE *out)
{
    ves_suite_place place = ves_suite_run(suite, index);
    ves_json json = {.out = out, .line = true};
    ves_json_object(&json, NULL);
    ves_json_integer(&json, "run", index);
    ves_json_text(&json, "method", suite->method[place.method].name);
    ves_json_text(&json, "problem", suite->problem[place.problem].name);
    ves_json_integer(&json, "seed", place.seed);
    ves_json_text(&json, "end", ENDS[o->failed ? 0 : o->hit ? 1 : 2]);
    ves_json_text(&json, "reason", *o->reason ? o->reason : NULL);
    ves_json_number(&json, "budget", o->budget);
    ves_json_number(&json, "spent", o->spent);
    ves_json_integer(&json, "evaluations", o->evaluations);
    ves_json_integer(&json, "gradients", o->gradients);
    ves_json_integer(&json, "failures", o->failures);
    ves_json_integer(&json, "starts", o->starts);
    ves_json_flag(&json, "feasible", feasible(o));
    ves_json_number(&json, "value", o->any ? o->value : NAN);
    ves_json_number(&json, "violation", o->any ? o->violation : NAN);
    ves_json_array(&json, "x");
    for (int i = 0; o->any && i < o->n; i++) ves_json_number(&json, NULL, o->x[i]);
    ves_json_end(&json, ']');
    ves_json_end(&json, '}');
}

void ves_bench_times_write(int index, const ves_outcome *o, FILE *out)
{
    ves_json json = {.out = out, .line = true};
    ves_json_object(&json, NULL);
    ves_json_integer(&json, "run", index);
    ves_json_number(&json, "wall_s", o->wall);
    ves_json_number(&json, "inside_s", o->inside);
    ves_json_number(&json, "cpu_s", o->cpu);
    ves_json_end(&json, '}');
}

void ves_bench_steps_write(const ves_outcome *o, FILE *out)
{
    ves_json json = {.out = out, .line = true};
    for (int k = 0; k < o->steps; k++) {
        ves_json_array(&json, NULL);
        ves_json_number(&json, NULL, o->step[k].cost);
        ves_json_number(&json, NULL, o->step[k].value);
        ves_json_number(&json, NULL, o->step[k].violation);
        ves_json_end(&json, ']');
    }
}

/* --- reading back --- */

static bool word_is(const ves_node *line, const char *key, const char *word)
{
    const char *found = ves_json_word(line, key);
    return found && !strcmp(found, word);
}

/* A whole number from 0 to most; -1: it is none. */
static double count_of(const ves_node *line, const char *key, double most)
{
    double count = ves_json_double(line, key, -1);
    return count >= 0 && count <= most && count == floor(count) ? count : -1;
}

int ves_bench_run_of(const ves_node *line, const ves_suite *suite)
{
    int run = (int)count_of(line, "run", ves_suite_runs(suite) - 1);
    if (run < 0) return -1;
    ves_suite_place place = ves_suite_run(suite, run);
    bool fits = count_of(line, "seed", INT_MAX) == place.seed &&
                word_is(line, "method", suite->method[place.method].name) &&
                word_is(line, "problem", suite->problem[place.problem].name);
    return fits ? run : -1;
}

static bool x_read(const ves_node *line, int n, ves_outcome *o)
{
    const ves_node *x = ves_node_find(line, "x");
    if (!x || x->kind != VES_NODE_LIST || (x->count && x->count != n)) return false;
    o->any = x->count > 0;
    o->n = n;
    o->x = ves_memory_take((size_t)n * sizeof *o->x);
    for (int i = 0; o->x && i < x->count; i++)
        if (x->item[i]->kind != VES_NODE_WORD || !ves_text_number(x->item[i]->text, &o->x[i])) return false;
    return o->x;
}

static bool end_read(const ves_node *line, ves_outcome *o)
{
    const ves_node *reason = ves_node_find(line, "reason");
    o->failed = word_is(line, "end", ENDS[0]);
    o->hit = word_is(line, "end", ENDS[1]);
    if (!reason || reason->kind != VES_NODE_WORD) return false;
    if (!reason->plain) snprintf(o->reason, sizeof o->reason, "%s", reason->text);
    return o->failed || o->hit || word_is(line, "end", ENDS[2]);
}

/* -1: none, which does not hold. */
static void counts_read(const ves_node *line, ves_outcome *o)
{
    o->evaluations = (long)count_of(line, "evaluations", count_most);
    o->gradients = (long)count_of(line, "gradients", count_most);
    o->failures = (long)count_of(line, "failures", count_most);
    o->starts = (int)count_of(line, "starts", INT_MAX);
}

bool ves_bench_run_read(const ves_node *line, int n, double budget, ves_outcome *o)
{
    if (!x_read(line, n, o) || !end_read(line, o)) return false;
    counts_read(line, o);
    o->budget = ves_json_double(line, "budget", NAN);
    o->spent = ves_json_double(line, "spent", NAN);
    o->value = ves_json_double(line, "value", HUGE_VAL);
    o->violation = ves_json_double(line, "violation", HUGE_VAL);
    o->wall = o->inside = o->cpu = NAN;
    return o->budget == budget && word_is(line, "feasible", feasible(o) ? "true" : "false") &&
           ves_outcome_holds(o);
}

/* [cost,value,violation] */
static bool step_read(const char *line, size_t length, ves_step *step)
{
    double *to[3] = {&step->cost, &step->value, &step->violation};
    const char *end = line + length;
    if (!length || *line++ != '[') return false;
    for (int k = 0; k < 3; k++) {
        size_t part = strcspn(line, ",]");
        char word[NUMBER] = "";
        if (part >= NUMBER || line + part >= end || line[part] != (k < 2 ? ',' : ']')) return false;
        memcpy(word, line, part);
        if (!ves_text_number(word, to[k])) return false;
        line += part + 1;
    }
    return line == end;
}

bool ves_bench_steps_read(const char *text, size_t length, ves_outcome *o)
{
    size_t lines = 0;
    for (size_t k = 0; k < length; k++) lines += text[k] == '\n';
    o->step = ves_memory_take((lines + 1) * sizeof *o->step);
    if (!o->step || lines > INT_MAX || (length && text[length - 1] != '\n')) return false;
    for (const char *at = text, *end; (size_t)o->steps < lines; at = end + 1) {
        end = strchr(at, '\n'); /* NULL: there is a zero before */
        if (!end || !step_read(at, (size_t)(end - at), &o->step[o->steps])) return false;
        o->steps++;
    }
    return ves_outcome_leads(o);
}

/* NAN: null, which is not known. */
static bool seconds_read(const ves_node *line, const char *key, double *seconds)
{
    *seconds = ves_json_double(line, key, NAN);
    return *seconds >= 0 || word_is(line, key, "null");
}

bool ves_bench_times_read(const ves_node *line, int runs, ves_outcome *outcome)
{
    int run = (int)count_of(line, "run", runs - 1);
    double wall, inside, cpu;
    if (run < 0 || !seconds_read(line, "wall_s", &wall) || !seconds_read(line, "inside_s", &inside) ||
        !seconds_read(line, "cpu_s", &cpu))
        return false;
    if (!outcome[run].done) return true;
    outcome[run].wall = wall;
    outcome[run].inside = inside;
    outcome[run].cpu = cpu;
    return true;
}
