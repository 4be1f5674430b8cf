#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "search_problems.h"

/* A search that is gone through again from its journal ends as one that was never interrupted, wherever it was
 * broken off: the same questions in the same order, the same result. */

enum { BLOCKS = 4096, BYTES = 1 << 24 };

typedef struct journal {
    int count, whole, next;
    size_t at[BLOCKS], size[BLOCKS], used;
    bool full[BLOCKS];
    unsigned char *bytes;
    double *heard; /* what the record hook was told: x[0], value, accepted */
    long told;
    atomic_long asked;
    long stop; /* after so many questions; 0: never */
} journal;

static journal *journal_create(void)
{
    journal *j = calloc(1, sizeof *j);
    j->bytes = malloc(BYTES);
    j->heard = malloc(sizeof(double) * 3 << 20);
    return j;
}

static void journal_destroy(journal *j)
{
    free(j->bytes);
    free(j->heard);
    free(j);
}

/* A whole block takes the place of the parts before it. */
static void keep(void *data, const void *block, size_t size, bool whole)
{
    journal *j = data;
    if (whole) {
        j->count = j->whole;
        j->used = j->count ? j->at[j->count - 1] + j->size[j->count - 1] : 0;
    }
    cr_assert(j->count < BLOCKS && j->used + size <= BYTES);
    memcpy(j->bytes + j->used, block, size);
    j->at[j->count] = j->used;
    j->size[j->count] = size;
    j->full[j->count++] = whole;
    j->used += size;
    if (whole) j->whole = j->count;
}

static void record(void *data, const ves_record *r)
{
    journal *j = data;
    double *to = j->heard + 3 * j->told++;
    to[0] = r->x[0];
    to[1] = r->value;
    to[2] = r->accepted;
}

/* Rosenbrock's valley in 4 variables on two constraints. */

static ves_status valley(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    journal *j = data;
    atomic_fetch_add(&j->asked, 1);
    double sum = 0, circle = -4, line = -1;
    double *g = gradient_of(ask, v);
    for (int i = 0; g && i < 4; i++) g[i] = 0;
    for (int i = 0; i < 4; i++) {
        circle += ask->x[i] * ask->x[i];
        line += ask->x[i];
        if (g) v->jacobian[i] = 2 * ask->x[i], v->jacobian[4 + i] = 1;
    }
    for (int i = 0; i < 3; i++) {
        double a = 1 - ask->x[i], b = ask->x[i + 1] - ask->x[i] * ask->x[i];
        sum += a * a + 100 * b * b;
        if (g) g[i] += -2 * a - 400 * b * ask->x[i], g[i + 1] += 200 * b;
    }
    v->value = sum;
    v->constraint[0] = circle;
    v->constraint[1] = line;
    return VES_OK;
}

static bool stopped(void *data)
{
    journal *j = data;
    return j->stop && atomic_load(&j->asked) >= j->stop;
}

typedef struct replay {
    journal *from, *to;
} replay;

static void keep_both(void *data, const void *block, size_t size, bool whole)
{
    keep(((replay *)data)->to, block, size, whole);
}

static void record_both(void *data, const ves_record *r)
{
    record(((replay *)data)->to, r);
}

static bool recall(void *data, const void **block, size_t *size, bool *whole)
{
    journal *j = ((replay *)data)->from;
    if (j->next == j->count) return false;
    *block = j->bytes + j->at[j->next];
    *size = j->size[j->next];
    *whole = j->full[j->next++];
    return true;
}

static bool stopped_both(void *data)
{
    return stopped(((replay *)data)->to);
}

/* from: NULL, or what is known. */
static ves_search_result *search(journal *from, journal *to, int workers, long budget)
{
    given g = {.evaluate = valley, .n = 4, .m = 2, .gradients = true, .workers = workers, .data = to};
    for (int i = 0; i < 4; i++) g.lower[i] = -2, g.upper[i] = 2, g.start[i] = -1 + 0.3 * i;
    g.equality[0] = true;
    ves_search_options options = ves_search_options_default();
    options.evaluations = budget;
    replay both = {from, to};
    ves_search_hooks hooks = {
        .record = record_both, .stopped = stopped_both, .data = &both, .keep = keep_both};
    if (from) hooks.recall = recall, from->next = 0;
    ves_search_result *result = NULL;
    ves_status status = run(&g, &options, &hooks, &result);
    if (result == NULL) cr_log_info("status %d", status);
    return result;
}

static void same_result(const ves_search_result *a, const ves_search_result *b)
{
    cr_assert(a && b);
    cr_expect(eq(dbl, a->value, b->value));
    cr_expect(eq(long, a->evaluations, b->evaluations));
    cr_expect(eq(long, a->gradients, b->gradients));
    cr_expect(eq(int, a->optima, b->optima));
    cr_expect(eq(int, a->temperatures, b->temperatures));
    cr_expect(memcmp(a->x, b->x, sizeof(double) * 4) == 0);
}

static void same_journal(const journal *a, const journal *b)
{
    cr_expect(eq(long, a->told, b->told));
    cr_expect(memcmp(a->heard, b->heard, sizeof(double) * 3 * (size_t)a->told) == 0);
    cr_expect(eq(int, a->whole, b->whole));
    cr_expect(eq(sz, a->used, b->used));
    cr_expect(memcmp(a->bytes, b->bytes, a->used) == 0);
}

Test(search_resume, a_whole_journal_answers_every_question)
{
    journal *first = journal_create(), *again = journal_create();
    ves_search_result *a = search(NULL, first, 1, 3000), *b = search(first, again, 1, 3000);
    same_result(a, b);
    same_journal(first, again);
    cr_expect(eq(long, first->asked, a->evaluations));
    cr_expect(eq(long, again->asked, 0));
    ves_search_result_destroy(a);
    ves_search_result_destroy(b);
    journal_destroy(first);
    journal_destroy(again);
}

Test(search_resume, threads_leave_the_same_journal)
{
    journal *one = journal_create(), *three = journal_create();
    ves_search_result *a = search(NULL, one, 1, 3000), *b = search(NULL, three, 3, 3000);
    same_result(a, b);
    same_journal(one, three);
    ves_search_result_destroy(a);
    ves_search_result_destroy(b);
    journal_destroy(one);
    journal_destroy(three);
}

static void broken_off(long at, int workers, int workers_after)
{
    journal *whole = journal_create(), *part = journal_create(), *rest = journal_create();
    ves_search_result *a = search(NULL, whole, 1, 3000);
    part->stop = at;
    ves_search_result *b = search(NULL, part, workers, 3000), *c = search(part, rest, workers_after, 3000);
    cr_expect(b->status == VES_INTERRUPTED, "the whole search asks %ld times", whole->asked);
    same_result(a, c);
    same_journal(whole, rest);
    /* not one answer was lost: those after the stop are the proofs of an interrupted best */
    cr_expect(rest->asked + at <= whole->asked, "stop %ld: %ld asked again", at,
              rest->asked + at - whole->asked);
    ves_search_result_destroy(a);
    ves_search_result_destroy(b);
    ves_search_result_destroy(c);
    journal_destroy(whole);
    journal_destroy(part);
    journal_destroy(rest);
}

Test(search_resume, broken_off_anywhere_and_resumed, .timeout = 120)
{
    for (long at = 1; at < 2014; at += 1 + at / 7) {
        broken_off(at, 1, 1);
        broken_off(at, 2, 1);
        broken_off(at, 1, 3);
    }
}

Test(search_resume, a_journal_of_another_run_is_refused)
{
    journal *first = journal_create(), *other = journal_create();
    ves_search_result *a = search(NULL, first, 1, 3000);
    cr_expect(search(first, other, 1, 4000) == NULL);
    ves_search_result_destroy(a);
    journal_destroy(first);
    journal_destroy(other);
}

Test(search_resume, blocks_can_be_read)
{
    journal *j = journal_create();
    ves_search_result *a = search(NULL, j, 1, 3000);
    long count = 0, gradients = 0;
    double best = HUGE_VAL;
    for (int k = 0; k < j->count; k++) {
        ves_search_cursor cursor = {0};
        ves_record r;
        while (ves_search_block_read(j->bytes + j->at[k], j->size[k], 4, 2, &cursor, &r)) {
            cr_expect(eq(dbl, r.x[0], j->heard[3 * count]));
            cr_expect(eq(dbl, r.value, j->heard[3 * count + 1]));
            count++;
            gradients += r.slope != NULL;
            if (r.status == VES_OK && r.violation <= 1e-10 && r.value < best) best = r.value;
        }
        ves_search_cursor torn = {0};
        long left = 0;
        while (ves_search_block_read(j->bytes + j->at[k], j->size[k] - 1, 4, 2, &torn, &r)) left++;
        cr_expect(left < cursor.evaluation);
    }
    cr_expect(eq(long, count, a->evaluations));
    cr_expect(eq(long, gradients, a->gradients));
    /* a violation of 1e-10 is rounding; the multipliers are some tens */
    cr_expect(fabs(best - a->value) <= 1e-8 * fabs(best), "%.12g, %.12g", best, a->value);
    ves_search_result_destroy(a);
    journal_destroy(j);
}
