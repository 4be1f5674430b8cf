/* The trace of a run: what it keeps. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <math.h>

#include "files.h"
#include "study/trace.h"

/* A search of this many candidates: every third accepted, value falling by ever smaller steps at the best. */
static long trace_lines(ves_trace which, long candidates, long *bests)
{
    const ves_variable variable = {.name = "r"};
    const ves_problem problem = {.variables = 1, .variable = &variable};
    ves_arena arena = {0};
    ves_tracer tracer = {.problem = &problem, .which = which};
    const char *path = path_of("log");
    double best = HUGE_VAL;
    size_t size;
    long lines = 0;
    remove(path);
    *bests = 0;
    cr_assert(ves_tracer_begin(&tracer, path, false, &arena) == VES_OK);
    for (long k = 0; k < candidates; k++) {
        double x = fmod(0.618034 * (double)k, 1), value = x * x;
        *bests += value < best;
        best = fmin(best, value);
        ves_record record = {
            .evaluation = k + 1, .x = &x, .value = value, .temperature = 1, .accepted = k % 3 == 0};
        ves_tracer_write(&tracer, &record);
    }
    cr_assert(ves_tracer_end(&tracer) == VES_OK);
    char *text = slurp_bytes(path, &size), want[80];
    for (size_t k = 0; k < size; k++) lines += text[k] == '\n';
    snprintf(want, sizeof want, "\"value\":%.15g,", best);
    cr_assert(which == VES_TRACE_ACCEPTED || strstr(text, want) != NULL, "the best is missing: %s", want);
    free(text);
    remove(path);
    ves_arena_destroy(&arena);
    return lines;
}

Test(trace, keeps_what_was_asked_for)
{
    long bests;
    cr_assert(eq(long, trace_lines(VES_TRACE_ALL, 3000, &bests), 3000));
    cr_assert(eq(long, trace_lines(VES_TRACE_ACCEPTED, 3000, &bests), 1000));
    long lines = trace_lines(VES_TRACE_SHORT, 3000, &bests);
    cr_assert(lines >= 1000 && lines <= 1000 + bests, "%ld lines, %ld bests", lines, bests);
    check_nothing_left();
}

/* 100,000 accepted: 2500 each at steps of 1, 2, 4, 8, 16 take 77,500, and the rest, one in 32, 704. */
Test(trace, a_short_one_grows_ever_more_slowly)
{
    long bests, lines = trace_lines(VES_TRACE_SHORT, 300000, &bests);
    cr_assert(bests < 40, "%ld bests: this test wants few", bests);
    cr_assert(lines >= 13200 && lines <= 13210 + bests, "%ld lines, %ld bests", lines, bests);
    check_nothing_left();
}
