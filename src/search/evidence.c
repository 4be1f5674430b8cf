#include "search/evidence.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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
    const int last = session->stages - 1, count = session->annealings;
    const ves_annealing_report *report = count ? &session->annealing_log[count - 1] : NULL;
    if (!report || report->stage != last)
        return session->ending == VES_ENDED_BUDGET ? VES_TRUST_SHORT : VES_TRUST_CONVERGED;
    switch (report->health) {
    case VES_HEALTH_FROZEN:
    case VES_HEALTH_UNEVEN:
        return VES_TRUST_FROZEN;
    case VES_HEALTH_SHORT:
        return VES_TRUST_SHORT;
    default:
        return VES_TRUST_NONE;
    }
}

/* A slope that is all but gone counts for more than what an algorithm says; where nobody has looked at it, one
 * that is a part of the largest tells that this is none of the ends that descents come to. */
static const double gone = 1e-6, steep = 0.01; /* of the residual */

/* A portfolio spends its budget, though its descents have ended. */
static bool broken_off(const ves_session *session)
{
    return session->ending == VES_ENDED_BUDGET && session->stage[session->stages - 1].kind != VES_STAGE_AUTO;
}

/* What speaks against an end that seems to have converged. */
static ves_trust doubt(const ves_session *session, const ves_witness *w, ves_trust trust)
{
    switch (w->halt) {
    case VES_HALT_KINK:
        return VES_TRUST_KINK;
    case VES_HALT_EDGE:
        return w->residual < gone ? trust : VES_TRUST_EDGE;
    case VES_HALT_LOST:
        return w->residual < gone ? trust : VES_TRUST_LOST;
    case VES_HALT_UNKNOWN:
        if (!(w->residual > steep)) return trust;
        return broken_off(session) ? VES_TRUST_SHORT : VES_TRUST_KINK;
    default:
        return trust;
    }
}

static ves_trust judge(const ves_session *session, const ves_witness *w)
{
    if (session->ending == VES_ENDED_STOPPED) return VES_TRUST_STOPPED;
    if (!w->feasible) return VES_TRUST_NONE;
    if (w->refused) return VES_TRUST_REFUSED;
    ves_trust trust = w->hits > 1 ? VES_TRUST_REPEATED : local(session);
    bool converged = trust == VES_TRUST_REPEATED || trust == VES_TRUST_CONVERGED;
    return converged ? doubt(session, w, trust) : trust;
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
    case VES_TRUST_KINK:
        return "not converged: the slope has not vanished, as at a kink or where gradients are wrong, and a "
               "polish by "
               "sbplx or cobyla, which need none, may go lower";
    case VES_TRUST_EDGE:
        return "ended beside designs that cannot be measured: the optimum may lie beyond them, so make them "
               "measurable or keep away from them by a constraint";
    case VES_TRUST_LOST:
        return "not converged: the descent lost its way, and a polish by another algorithm may go lower";
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
        snprintf(text, size, ": about %.3g minima to be expected, %.2g %% of the box%s leads to unseen ones",
                 e->expected, 100 * e->unseen, e->unmeasured ? ", where it can be measured," : "");
}

static void unmeasured_write(const ves_evidence *e, char *text, size_t size)
{
    if (e->unmeasured) snprintf(text, size, "; %ld more met nothing that can be measured", e->unmeasured);
}

ves_evidence ves_evidence_judge(ves_session *session, const ves_witness *w)
{
    ves_evidence e = {.trust = judge(session, w),
                      .descents = session->blind,
                      .unmeasured = session->unmeasured,
                      .minima = session->kinds - w->merged,
                      .hits = w->hits};
    e.expected = ves_evidence_expected(e.descents, e.minima);
    e.unseen = ves_evidence_unseen(e.descents, e.minima);
    char count[160] = "", unseen[160] = "", more[80] = "";
    if (w->feasible) {
        count_write(&e, count, sizeof count);
        unseen_write(&e, unseen, sizeof unseen);
        unmeasured_write(&e, more, sizeof more);
    }
    const char *verdict = opening(e.trust, w->feasible);
    e.verdict = (int)strlen(verdict);
    e.sentence = ves_arena_format(&session->kept, "%s%s%s%s", verdict, count, unseen, more);
    if (!e.sentence) session->fault = VES_MEMORY;
    return e;
}
