#include "search/evidence.h"

#include <math.h>
#include <stdio.h>

/* Descents from uniformly drawn points are drawn from the minima with the sizes of their basins as chances. With
 * a uniform prior on the number k of minima (1, 2, ...) and, given k, on the sizes of their basins, the chance of
 * seeing w of them in n descents is proportional to C(k, w) / C(n + k - 1, n), and the unseen ones hold (k - w) /
 * (n + k) of the box; the two means over k are below [Boender and Rinnooy Kan 1987]. The sum over k converges for
 * n > w + 1, its first moment for n > w + 2.
 * test  the sums themselves: tests/search_honest.c */

double ves_evidence_expected(long n, long w)
{
    if (w < 1 || n <= w + 2) return NAN;
    return (double)w * (double)(n - 1) / (double)(n - w - 2);
}

double ves_evidence_unseen(long n, long w)
{
    if (w < 1 || n <= w + 2) return NAN;
    return (double)w * (double)(w + 1) / ((double)n * (double)(n - 1));
}

/* The last stage says how the search came to its end. */
static ves_trust local(const ves_session *session)
{
    const ves_stage *last = session->stages ? &session->stage[session->stages - 1] : NULL;
    if (session->ending == VES_ENDED_BUDGET) return VES_TRUST_SHORT;
    if (!last || last->kind != VES_STAGE_ANNEAL || !session->annealings) return VES_TRUST_CONVERGED;
    switch (session->annealing_log[session->annealings - 1].health) {
    case VES_HEALTH_FROZEN:
        return VES_TRUST_FROZEN;
    case VES_HEALTH_SHORT:
        return VES_TRUST_SHORT;
    default:
        return VES_TRUST_NONE;
    }
}

static ves_trust judge(const ves_session *session, const ves_witness *w)
{
    if (session->ending == VES_ENDED_STOPPED) return VES_TRUST_STOPPED;
    if (!w->feasible) return VES_TRUST_NONE;
    if (w->refused) return VES_TRUST_REFUSED;
    return w->hits > 1 ? VES_TRUST_REPEATED : local(session);
}

static const char *opening(ves_trust trust, bool feasible)
{
    switch (trust) {
    case VES_TRUST_NONE:
        return feasible ? "nothing was sought to its end: nothing can be said of the best"
                        : "nothing to judge: nothing feasible was proved";
    case VES_TRUST_STOPPED:
        return "stopped: the best may not be one";
    case VES_TRUST_REFUSED:
        return "better designs were refused: the best need be no optimum";
    case VES_TRUST_SHORT:
        return "budget too short: the best has not converged";
    case VES_TRUST_FROZEN:
        return "frozen: no other optimum is ruled out";
    default:
        return "converged";
    }
}

static int count_write(const ves_evidence *e, char *text, size_t size)
{
    long n = e->descents;
    if (!n) return snprintf(text, size, "; no independent descent has looked for others");
    const char *plural = n == 1 ? "" : "s";
    const long others = e->minima - (e->hits > 0);
    if (e->hits && !others)
        return snprintf(text, size, "; all of %ld independent descent%s ended there", n, plural);
    const char *so = e->hits ? "the others" : "but";
    char hits[32] = "none";
    if (e->hits) snprintf(hits, sizeof hits, "%ld", e->hits);
    return snprintf(text, size, "; %s of %ld independent descent%s ended there, %s at %ld other place%s",
                    hits, n, plural, so, others, others == 1 ? "" : "s");
}

static void unseen_write(const ves_evidence *e, char *text, size_t size)
{
    if (!e->descents) return;
    if (isnan(e->expected))
        snprintf(text, size, ": not enough descents to tell what is unseen");
    else
        snprintf(text, size, ": about %.3g minima to be expected, %.2g %% of the box leads to unseen ones",
                 e->expected, 100 * e->unseen);
}

ves_evidence ves_evidence_judge(ves_session *session, const ves_witness *w)
{
    ves_evidence e = {.trust = judge(session, w),
                      .descents = session->blind,
                      .minima = session->kinds - w->merged,
                      .hits = w->hits};
    e.expected = ves_evidence_expected(e.descents, e.minima);
    e.unseen = ves_evidence_unseen(e.descents, e.minima);
    char count[160] = "", unseen[160] = "";
    if (w->feasible) {
        count_write(&e, count, sizeof count);
        unseen_write(&e, unseen, sizeof unseen);
    }
    e.sentence = ves_arena_format(&session->kept, "%s%s%s", opening(e.trust, w->feasible), count, unseen);
    if (!e.sentence) session->fault = VES_MEMORY;
    return e;
}
