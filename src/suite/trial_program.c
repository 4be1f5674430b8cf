/* A program of one's own as a method: JSON lines through its stdin and stdout (docs/benchmark.md). It is told
 * the problem, asks, is answered, and ends when it is told {"done": ...}. When it has done before that, it is
 * started again, from another random point. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "base/text.h"
#include "suite/instance.h"
#include "suite/line.h"
#include "suite/trial.h"

enum { QUOTE = 80, IDLE = 3 };
static const double patience = 2; /* s, for its end after it has been told */

typedef struct talk {
    ves_trial *trial;
    ves_search_problem problem;
    ves_line line;
    char *text; /* what is to be said; [room] */
    size_t length, room;
    bool failed; /* no memory for it */
    bool ended;  /* why there is no more to say is known */
    double *u;
    ves_verdict answer;
    long asked;   /* of the process that runs */
    double begun; /* s, when it was started; its own time begins with its first question */
} talk;

/* --- saying --- */

__attribute__((format(printf, 2, 3))) static void say(talk *t, const char *format, ...)
{
    char part[256];
    va_list list;
    va_start(list, format);
    size_t length = (size_t)vsnprintf(part, sizeof part, format, list);
    va_end(list);
    if (t->length + length + 1 > t->room) {
        size_t room = 2 * t->room + 4096;
        char *more = ves_memory_grow(t->text, room);
        if (!more) t->failed = true;
        if (!more) return;
        t->text = more;
        t->room = room;
    }
    memcpy(t->text + t->length, part, length + 1);
    t->length += length;
}

static void say_number(talk *t, const char *key, double value)
{
    char text[32];
    ves_text_shortest(value, text);
    say(t, "%s%s", key, isfinite(value) ? text : "null");
}

static void say_numbers(talk *t, const char *key, const double *value, int count)
{
    say(t, "%s[", key);
    for (int k = 0; k < count; k++) say_number(t, k ? "," : "", value[k]);
    say(t, "]");
}

static bool send_off(talk *t)
{
    const ves_trial *c = t->trial;
    say(t, "\n");
    ves_line_end end = VES_LINE_MEMORY;
    double seconds = c->meter->over ? patience : c->method->seconds;
    if (!t->failed) end = ves_line_write(&t->line, seconds, c->stopped, c->data, t->text, t->length);
    t->length = 0;
    t->ended = end == VES_LINE_LATE || end == VES_LINE_STOPPED;
    if (end == VES_LINE_LATE && !c->meter->over)
        ves_trial_fail(t->trial, "the program read nothing for %g s", c->method->seconds);
    return end == VES_LINE_DONE;
}

static bool slopes_given(const talk *t)
{
    return t->problem.gradients && !t->trial->method->values;
}

static bool say_problem(talk *t)
{
    const ves_search_problem *p = &t->problem;
    const ves_meter *meter = t->trial->meter;
    uint64_t seed = ves_instance_hash("program", t->trial->seed + (uint64_t)t->trial->starts) >> 33;
    say(t, "{\"vesica\":1,\"n\":%d,\"m\":%d,\"equality\":[", p->n, p->m);
    for (int j = 0; j < p->m; j++)
        say(t, "%s%s", j ? "," : "", p->equality && p->equality[j] ? "true" : "false");
    say(t, "],\"gradients\":%s", slopes_given(t) ? "true" : "false");
    say_number(t, ",\"budget\":", ves_meter_left(meter));
    say_number(t, ",\"cost\":", meter->cost);
    say_number(t, ",\"cost_gradient\":", meter->cost_gradient);
    say(t, ",\"seed\":%llu", (unsigned long long)seed);
    say_numbers(t, ",\"start\":", t->trial->start, p->n);
    say(t, "}");
    return send_off(t);
}

static bool say_answer(talk *t, bool slopes)
{
    const ves_search_problem *p = &t->problem;
    const ves_verdict *v = &t->answer;
    say(t, "{\"status\":\"%s\"", ves_status_word(v->status));
    if (v->status == VES_OK) {
        say_number(t, ",\"value\":", v->value);
        say_numbers(t, ",\"constraints\":", v->constraint, p->m);
    }
    if (v->status == VES_OK && slopes) {
        say_numbers(t, ",\"gradient\":", v->gradient, p->n);
        say(t, ",\"jacobian\":[");
        for (int j = 0; j < p->m; j++) say_numbers(t, j ? "," : "", v->jacobian + (size_t)j * p->n, p->n);
        say(t, "]");
    }
    say_number(t, ",\"left\":", ves_meter_left(t->trial->meter));
    say(t, "}");
    return send_off(t);
}

/* --- hearing --- */

/* Why the program that has closed its side is no more. */
static void mourn(talk *t)
{
    int code = ves_line_close(&t->line, patience);
    if (code < 0)
        ves_trial_fail(t->trial, "the program was ended by signal %d", -code);
    else
        ves_trial_fail(t->trial, "the program ended without {\"done\": true}, exit code %d", code);
}

static bool nonsense(talk *t, const char *what, const char *line)
{
    ves_trial_fail(t->trial, "%s: %.*s%s", what, QUOTE, line, strlen(line) > QUOTE ? "..." : "");
    return false;
}

/* One request that makes sense. False: it failed, or stopped. */
static bool hear(talk *t, ves_request *request)
{
    ves_trial *c = t->trial;
    char *line;
    switch (ves_line_read(&t->line, c->method->seconds, c->stopped, c->data, &line)) {
    case VES_LINE_DONE:
        break;
    case VES_LINE_LATE:
        ves_trial_fail(c, "the program said nothing for %g s", c->method->seconds);
        return false;
    case VES_LINE_CLOSED:
        mourn(t);
        return false;
    case VES_LINE_LONG:
        return nonsense(t, "the program said a line without an end", "");
    case VES_LINE_MEMORY:
        t->failed = true;
        return false;
    case VES_LINE_STOPPED:
        return false;
    }
    int n = t->problem.n;
    if (!ves_request_read(line, n, t->u, request))
        return nonsense(t, "the program said what is no request", line);
    if (request->done) return true;
    if (request->count != n) return nonsense(t, "the program asked for another number of variables", line);
    for (int i = 0; i < n; i++)
        if (!(t->u[i] >= 0 && t->u[i] <= 1))
            return nonsense(t, "the program asked beyond the unit box", line);
    if (request->gradient && !slopes_given(t))
        return nonsense(t, "the program asked for gradients, and there are none", line);
    return true;
}

/* One process from its start to its end. */
static ves_status converse(talk *t)
{
    ves_trial *c = t->trial;
    ves_request request;
    bool alive = say_problem(t);
    while (!c->meter->over && alive && hear(t, &request) && !request.done) {
        if (!t->asked) c->aside += ves_trial_clock(c) - t->begun;
        const ves_ask ask = {
            .x = t->u, .cutoff = HUGE_VAL, .want = request.gradient ? VES_WANT_GRADIENT : VES_WANT_VALUE};
        t->answer.status = VES_OK;
        t->answer.value = t->answer.violation = NAN;
        ves_status status = t->problem.evaluate(t->problem.data, 0, &ask, &t->answer);
        t->asked++;
        if (status != VES_OK && status != VES_INTERRUPTED) return status;
        if (!c->meter->over) alive = say_answer(t, request.gradient);
    }
    if (t->failed) return VES_MEMORY;
    if (!alive && !t->ended && !c->meter->over) mourn(t);
    if (c->meter->over && t->line.child) {
        say(t, "{\"done\":\"%s\"}", c->meter->hit ? "target" : "budget");
        send_off(t);
    }
    return VES_OK;
}

static ves_status repeat(talk *t)
{
    ves_trial *c = t->trial;
    for (int idle = 0; !c->meter->over && !c->failed;) {
        if (c->stopped && c->stopped(c->data)) break;
        VES_TRY(ves_trial_start(c));
        t->begun = ves_trial_clock(c);
        int error = ves_line_open(&t->line, c->method->word);
        if (error) {
            ves_trial_fail(c, "cannot start \"%s\": %s", c->method->word[0], strerror(error));
            break;
        }
        t->asked = 0;
        ves_status status = converse(t);
        bool waits = status == VES_OK && !c->failed && !(c->stopped && c->stopped(c->data));
        double end = ves_trial_clock(c);
        if (t->line.child) ves_line_close(&t->line, waits ? patience : 0);
        c->aside += ves_trial_clock(c) - end;
        if (status != VES_OK) return status;
        idle = t->asked ? 0 : idle + 1;
        if (idle == IDLE) ves_trial_fail(c, "the program ends without asking");
    }
    return VES_OK;
}

ves_status ves_trial_program(ves_trial *trial)
{
    talk t = {.trial = trial, .problem = ves_meter_problem(trial->meter, trial->start)};
    size_t n = (size_t)t.problem.n, m = (size_t)t.problem.m;
    ves_arena arena = {0};
    t.line.socket = -1;
    t.u = ves_arena_take(&arena, 2 * n + m + m * n, sizeof *t.u);
    if (!t.u) return VES_MEMORY;
    t.answer.gradient = t.u + n;
    t.answer.constraint = t.u + 2 * n;
    t.answer.jacobian = t.u + 2 * n + m;
    ves_status status = repeat(&t);
    ves_memory_free(t.text);
    ves_arena_destroy(&arena);
    return status;
}
