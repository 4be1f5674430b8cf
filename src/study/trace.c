#include "study/trace.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/diag.h"
#include "output/file.h"
#include "study/design.h"

/* Room for the words and the fixed numbers of a line, and for each variable: a line of the tube with 17
 * variables has about 300 bytes. */
enum { FIXED = 400, EACH = 28 };

/* Lines of a short trace before it takes but every second of what it took. */
enum { THIN = 2500 };

ves_status ves_tracer_begin(ves_tracer *tracer, const char *path, bool again, ves_arena *arena)
{
    tracer->path = path;
    tracer->best = (ves_verdict){.status = VES_NO_NUMBER};
    tracer->room = (size_t)(FIXED + EACH * tracer->problem->variables);
    tracer->line = ves_arena_take(arena, tracer->room, 1);
    if (!tracer->line) return ves_diag_fail(tracer->diag, VES_MEMORY);
    tracer->out = again ? fopen(path, "r+b") : NULL;
    if (!tracer->out) tracer->out = fopen(path, "wbx");
    return tracer->out ? VES_OK : ves_file_complain(path, errno, tracer->diag);
}

static void complain(ves_tracer *tracer)
{
    if (tracer->status == VES_OK) tracer->status = ves_file_complain(tracer->path, errno, tracer->diag);
}

static size_t number(char *at, const char *key, double value, const char *format)
{
    size_t length = (size_t)snprintf(at, EACH * 2, ",\"%s\":", key);
    if (!isfinite(value)) return length + (size_t)snprintf(at + length, EACH, "null");
    return length + (size_t)snprintf(at + length, EACH, format, value);
}

/* x and value with all their digits: what has been traced can be measured again. */
static size_t compose(const ves_tracer *tracer, const ves_record *r, char *at)
{
    const char *begin = at;
    double sign = tracer->problem->maximize ? -1 : 1;
    at += snprintf(at, FIXED / 2, "{\"evaluation\":%ld,\"stage\":%d,\"chain\":%d,\"x\":[", r->evaluation,
                   r->stage, r->chain);
    for (int k = 0; k < tracer->problem->variables; k++)
        at += snprintf(at, EACH, k ? ",%.17g" : "%.17g", r->x[k]);
    *at++ = ']';
    at += number(at, "value", r->status == VES_OK ? sign * r->value : NAN, "%.17g");
    at += number(at, "violation", ves_design_violation(tracer->problem, r), "%.9g");
    at += number(at, "T", r->temperature, "%.9g");
    at += snprintf(at, FIXED / 4, ",\"accepted\":%s,\"status\":\"%s\"}\n", r->accepted ? "true" : "false",
                   ves_status_word(r->status));
    return (size_t)(at - begin);
}

/* Decided by the order of the records alone: the same lines for any number of threads. */
static bool is_wanted(ves_tracer *tracer, const ves_record *r)
{
    ves_verdict verdict = {.status = r->status, .value = r->value, .violation = r->violation};
    if (tracer->which == VES_TRACE_ALL) return true;
    if (tracer->which == VES_TRACE_ACCEPTED) return r->accepted;
    bool best = ves_verdict_better(&verdict, &tracer->best, VES_FEASIBLE), turn = false;
    if (best) tracer->best = verdict;
    if (r->accepted) {
        long halvings = tracer->kept / THIN;
        turn = halvings < 62 && tracer->accepted++ % (1L << halvings) == 0;
        tracer->kept += turn;
    }
    return best || turn;
}

void ves_tracer_write(ves_tracer *tracer, const ves_record *record)
{
    if (!tracer->out || tracer->status != VES_OK) return;
    if (!is_wanted(tracer, record)) return;
    size_t length = compose(tracer, record, tracer->line);
    if (fwrite(tracer->line, 1, length, tracer->out) != length) complain(tracer);
    if (record->stage != tracer->stage && fflush(tracer->out)) complain(tracer);
    tracer->stage = record->stage;
}

ves_status ves_tracer_end(ves_tracer *tracer)
{
    if (!tracer->out) return tracer->status;
    long end = ftell(tracer->out);
    if (fflush(tracer->out) || end < 0 || ftruncate(fileno(tracer->out), end)) complain(tracer);
    if (fclose(tracer->out)) complain(tracer);
    tracer->out = NULL;
    return tracer->status;
}
