/* What vesica bench prints: docs/benchmark.md says how to read it. */
#include "app/screen_bench.h"

#include <math.h>
#include <string.h>

#include "app/table.h"

enum { COLUMNS = 6, CELL = 96 };

static const char *number(double value, char text[32])
{
    if (isnan(value))
        text[0] = 0;
    else if (isinf(value))
        snprintf(text, 32, "-");
    else if (fabs(value) >= 1e5)
        snprintf(text, 32, "%.3gM", value / 1e6);
    else if (fabs(value) >= 1e3)
        snprintf(text, 32, "%.3gk", value / 1e3);
    else
        snprintf(text, 32, "%.3g", value);
    return text;
}

static const char *seconds(double value, char text[32])
{
    if (!isfinite(value)) return number(value, text);
    return app_screen_time(value, text);
}

/* [low, high] */
static void interval_cell(app_table *t, ves_interval i, const char *(*show)(double, char *))
{
    char low[32], high[32];
    if (isfinite(i.value))
        app_table_cell(t, "[%s, %s]", show(i.low, low), show(i.high, high));
    else
        app_table_cell(t, "%s", "");
}

static const ves_score *score_of(const ves_bench *b, int method, int problem)
{
    return &b->tally.score[method * b->suite->problems + problem];
}

/* A maximum with its own sign, not that of what is minimised. */
static double told(const ves_bench *b, int problem, double value)
{
    return b->problem[problem].maximize ? -value : value;
}

static void heading(const ves_bench *b, FILE *out)
{
    const ves_suite *s = b->suite;
    char budget[32], most[32], runs[32], p[64], m[64], r[64];
    fprintf(out, "%s\n\n", s->title);
    fprintf(out, "  %s, %s, %s of each (%s of %d done), vesica %s, %d %s\n",
            app_screen_plural(s->problems, "problem", "problems", p),
            app_screen_plural(s->methods, "method", "methods", m),
            app_screen_plural(s->seeds, "run", "runs", r), app_screen_thousands(b->done, runs), b->runs,
            VESICA_VERSION, b->jobs, b->jobs == 1 ? "job" : "jobs");
    if (b->done < b->runs) fprintf(out, "  interrupted: what follows is of the runs that are done\n");
    fprintf(out, "  budget: %s for each variable, at most %s; a value costs %g, with gradients %g\n",
            number(s->per_dimension, budget), number(s->most, most), s->cost, s->cost_gradient);
    fprintf(out,
            "  targets: the reference + gap max(1, |reference|) (files: gap |reference|), gaps %g, %g, %g\n  "
            "feasible: violated by no more ",
            s->target[0], s->target[1], s->target[2]);
    fprintf(out, "than %g (<=), %g (==)\n\n", s->inequality, s->equality);
}

static void references(const ves_bench *b, FILE *out)
{
    const ves_suite *s = b->suite;
    app_table t = {.align = "lrrrll"};
    for (const char *const *w = (const char *const[]){"problem", "n", "constraints", "reference", "from",
                                                      "value, with gradients", NULL};
         *w; w++)
        app_table_cell(&t, "%s", *w);
    for (int p = 0; p < s->problems; p++) {
        const ves_bench_problem *f = &b->problem[p];
        const ves_reference *r = &b->tally.reference[p];
        char a[32], c[32];
        app_table_cell(&t, "%s", s->problem[p].name);
        app_table_cell(&t, "%d", f->n);
        char held[CELL] = "";
        if (f->m) snprintf(held, sizeof held, f->equalities ? "%d, %d ==" : "%d", f->m, f->equalities);
        app_table_cell(&t, "%s%s%s", held, *held && *f->eliminated ? ", " : "", f->eliminated);
        app_table_number(&t, told(b, p, r->value));
        if (r->known)
            app_table_cell(&t, "known");
        else if (isnan(r->value))
            app_table_cell(&t, "no feasible value was found");
        else
            app_table_cell(&t, "best of all runs%s: %s, run %d", r->polished ? ", polished" : "",
                           s->method[r->method].name, r->seed);
        app_table_cell(&t, "%s%s%s", seconds(f->seconds, a), f->gradients ? ", " : "",
                       f->gradients ? seconds(f->seconds_gradient, c) : "");
    }
    app_table_print(&t, out);
    for (int p = 0; p < s->problems; p++) {
        const ves_reference *r = &b->tally.reference[p];
        if (!isnan(r->below))
            fprintf(out,
                    "  %s: %.9g, which is feasible, is better than the optimum that the suite gives, %.9g\n",
                    s->problem[p].name, told(b, p, r->below), told(b, p, r->value));
    }
    fputc('\n', out);
}

/* 13/15 1.2k: hits at the last target and its ERT. */
static void matrix(const ves_bench *b, FILE *out)
{
    const ves_suite *s = b->suite;
    int last = VES_TARGETS - 1;
    fprintf(out, "  runs that met the last target, and the expected cost of meeting it (ERT)\n\n");
    for (int first = 0; first < s->methods; first += COLUMNS) {
        int end = first + COLUMNS < s->methods ? first + COLUMNS : s->methods;
        char align[COLUMNS + 2] = "l", text[32];
        memset(align + 1, 'l', (size_t)(end - first));
        app_table t = {.align = align};
        app_table_cell(&t, "problem");
        for (int e = first; e < end; e++) app_table_cell(&t, "%s", s->method[e].name);
        for (int p = 0; p < s->problems; p++) {
            app_table_cell(&t, "%s", s->problem[p].name);
            for (int e = first; e < end; e++) {
                const ves_score *c = score_of(b, e, p);
                if (c->runs && c->failed == c->runs)
                    app_table_cell(&t, "failed");
                else if (!c->runs)
                    app_table_cell(&t, "no run yet");
                else
                    app_table_cell(&t, "%d/%d %s", c->hits[last], c->runs, number(c->ert[last].value, text));
            }
        }
        app_table_print(&t, out);
        fputc('\n', out);
    }
}

static void totals(const ves_bench *b, FILE *out)
{
    const ves_suite *s = b->suite;
    app_table t = {.align = "lrlrlrlrrl"};
    char text[32];
    app_table_cell(&t, "all problems");
    for (int k = 0; k < VES_TARGETS; k++) {
        app_table_cell(&t, "%g", s->target[k]);
        app_table_cell(&t, "95 %%");
    }
    app_table_cell(&t, "feasible");
    app_table_cell(&t, "failed");
    app_table_cell(&t, "own time");
    for (int e = 0; e < s->methods; e++) {
        const ves_total *c = &b->tally.total[e];
        app_table_cell(&t, "%s", s->method[e].name);
        for (int k = 0; k < VES_TARGETS; k++) {
            app_table_cell(&t, c->runs ? "%.1f %%" : "-", 100 * c->share[k].value);
            app_table_cell(&t, c->runs ? "[%.0f, %.0f]" : "", 100 * c->share[k].low, 100 * c->share[k].high);
        }
        app_table_cell(&t, c->runs ? "%.0f %%" : "-", c->runs ? 100.0 * c->feasible / c->runs : NAN);
        app_table_cell(&t, "%d", c->failed);
        app_table_cell(&t, "%s", seconds(c->own, text));
    }
    app_table_print(&t, out);
    fprintf(out, "\n  failed: runs that the method could not end; own time: outside the problem, for each "
                 "evaluation\n\n");
}

static void score_row(app_table *t, const ves_bench *b, int method, int problem)
{
    const ves_score *c = score_of(b, method, problem);
    int last = VES_TARGETS - 1;
    char hits[CELL] = "", text[32], other[32];
    for (int k = 0; k < VES_TARGETS; k++)
        snprintf(hits + strlen(hits), sizeof hits - strlen(hits), "%s%d", k ? "/" : "", c->hits[k]);
    app_table_cell(t, "%s", b->suite->method[method].name);
    app_table_cell(t, "%s of %d", hits, c->runs);
    app_table_cell(t, c->runs ? "[%.0f, %.0f] %%" : "", 100 * c->share[last].low, 100 * c->share[last].high);
    app_table_cell(t, "%s", c->runs ? number(c->ert[last].value, text) : "");
    interval_cell(t, c->ert[last], number);
    app_table_cell(t, "%s", seconds(c->seconds.value, text));
    app_table_cell(t, isfinite(c->quartile[1]) ? "%.9g" : "-", told(b, problem, c->quartile[1]));
    app_table_cell(t, isfinite(c->best) ? "%.9g" : "-", told(b, problem, c->best));
    app_table_cell(t, "%d", c->feasible);
    app_table_cell(t, "%s", b->problem[problem].m ? number(c->worst, text) : "");
    app_table_cell(t, "%s", seconds(c->own, other));
}

static void details(const ves_bench *b, FILE *out)
{
    static const char *const head[] = {"hits",   "last, 95 %", "ERT",      "95 %",  "seconds",
                                       "median", "best",       "feasible", "worst", "own time"};
    const ves_suite *s = b->suite;
    for (int p = 0; p < s->problems; p++) {
        app_table t = {.align = "lllrlrrrrrr"};
        app_table_cell(&t, "%s", s->problem[p].name);
        for (size_t k = 0; k < sizeof head / sizeof *head; k++) app_table_cell(&t, "%s", head[k]);
        for (int e = 0; e < s->methods; e++) score_row(&t, b, e, p);
        app_table_print(&t, out);
        for (int e = 0; e < s->methods; e++) {
            const ves_score *c = score_of(b, e, p);
            if (c->reason)
                fprintf(out, "    %s %s %d of %d: %s\n", s->method[e].name, c->failed ? "failed" : "notes",
                        c->failed, c->runs, c->reason);
        }
        fputc('\n', out);
    }
    fprintf(out,
            "  hits: runs that met each of the three targets; median, best: of the final feasible values;\n"
            "  worst: the largest final violation in units of what is allowed\n\n");
}

static void pair_cell(app_table *t, const ves_pair *pair)
{
    static const char *const word[] = {"", "too few runs", "no difference shown", ", no direction", "", ""};
    ves_finding finding = ves_tally_finding(pair);
    char p[32] = "", by[32] = "";
    if (finding >= VES_FINDING_MIXED)
        snprintf(p, sizeof p, pair->p < 1e-4 ? "p < 1e-4" : "p = %.2g", pair->p);
    if (*p && !isnan(pair->by_problem)) snprintf(by, sizeof by, " / %.2g", pair->by_problem);
    if (finding == VES_FINDING_NONE)
        app_table_cell(t, "%s", "");
    else
        app_table_cell(t, "%.2f %s%s%s", pair->effect, p, by, word[finding]);
}

/* The most that any pair could show, where that is nothing. */
static void too_few(const ves_bench *b, FILE *out)
{
    double least = NAN;
    for (int k = 0; k < b->suite->methods * b->suite->methods; k++)
        if (ves_tally_finding(&b->tally.pair[k]) == VES_FINDING_FEW)
            least = fmax(least, b->tally.pair[k].least);
    if (!isnan(least))
        fprintf(
            out,
            "  too few runs: whatever comes of them, p cannot fall below %.2g; more seeds or problems, or "
            "fewer methods\n\n",
            least);
}

static void pairs(const ves_bench *b, FILE *out)
{
    const ves_suite *s = b->suite;
    if (s->methods < 2) return;
    fprintf(
        out,
        "  chance that a run of the method on the left does better (A12), and p of Wilcoxon's signed ranks,\n"
        "  paired by problem and run, corrected for all pairs (Holm): whether they differ on these "
        "problems\n");
    if (s->problems >= VES_TALLY_PROBLEMS)
        fprintf(out, "  / p of the means of each problem: whether they would on others of the kind\n");
    fputc('\n', out);
    for (int first = 0; first < s->methods; first += COLUMNS - 2) {
        int end = first + COLUMNS - 2 < s->methods ? first + COLUMNS - 2 : s->methods;
        char align[COLUMNS + 2] = "l";
        memset(align + 1, 'l', (size_t)(end - first));
        app_table t = {.align = align};
        app_table_cell(&t, "%s", "");
        for (int e = first; e < end; e++) app_table_cell(&t, "%s", s->method[e].name);
        for (int i = 0; i < s->methods; i++) {
            app_table_cell(&t, "%s", s->method[i].name);
            for (int j = first; j < end; j++)
                if (i == j)
                    app_table_cell(&t, "%s", "");
                else
                    pair_cell(&t, &b->tally.pair[i * s->methods + j]);
        }
        app_table_print(&t, out);
        fputc('\n', out);
    }
    too_few(b, out);
}

static void optima(const ves_bench *b, FILE *out)
{
    const ves_suite *s = b->suite;
    for (int k = 0; k < b->optima; k++) {
        const ves_bench_optimum *o = &b->optimum[k];
        bool first = !k || b->optimum[k - 1].problem != o->problem;
        const char *gap = "";
        ves_suite_place place = ves_suite_run(s, o->run);
        if (first) fprintf(out, "  distinct ends of %s\n", s->problem[o->problem].name);
        fprintf(out, "    %.9g   first by %s, run %d; ", told(b, o->problem, o->value),
                s->method[place.method].name, place.seed);
        for (int e = 0; e < s->methods; e++) {
            if (!o->hits[e]) continue;
            fprintf(out, "%s%s ", gap, s->method[e].name);
            fprintf(out, o->hits[e] == 1 ? "once" : "%d times", o->hits[e]);
            gap = ", ";
        }
        fputc('\n', out);
    }
    if (b->optima) fputc('\n', out);
}

/* The largest share of runs that met the last target; of equals the better one of the pair. */
static int best_of(const ves_bench *b)
{
    int best = 0, last = VES_TARGETS - 1;
    for (int e = 1; e < b->suite->methods; e++) {
        const ves_pair *pair = &b->tally.pair[e * b->suite->methods + best];
        double more = b->tally.total[e].share[last].value - b->tally.total[best].share[last].value;
        if (more > 0 || (more == 0 && pair->effect > 0.5)) best = e;
    }
    return best;
}

/* Those of which the pair with the best says this; `often`: and that met the last target as often. */
static void others(const ves_bench *b, int best, ves_finding finding, bool often, const char *before,
                   FILE *out)
{
    int last = VES_TARGETS - 1;
    const ves_total *total = b->tally.total;
    for (int e = 0; e < b->suite->methods; e++) {
        const ves_pair *pair = &b->tally.pair[best * b->suite->methods + e];
        bool same = total[e].share[last].value == total[best].share[last].value;
        if (e == best || ves_tally_finding(pair) != finding || (often && !same)) continue;
        fprintf(out, "%s%s", before, b->suite->method[e].name);
        before = ", ";
    }
}

/* Who leads among methods of which one has not begun cannot be said. */
static bool all_begun(const ves_bench *b, FILE *out)
{
    const char *before = "No verdict: there is no run yet of ";
    bool all = true;
    for (int e = 0; e < b->suite->methods; e++) {
        if (b->tally.total[e].runs) continue;
        fprintf(out, "%s%s", before, b->suite->method[e].name);
        before = ", ";
        all = false;
    }
    if (!all) fprintf(out, ".\n");
    return all;
}

static void verdict(const ves_bench *b, FILE *out)
{
    const ves_suite *s = b->suite;
    int best = best_of(b), last = VES_TARGETS - 1;
    char budget[32], most[32];
    const ves_total *t = &b->tally.total[best];
    if (!all_begun(b, out)) return;
    if (b->done < b->runs) fprintf(out, "So far, with %d of %d runs: ", b->done, b->runs);
    fprintf(out, "Within %s cost units for each variable, at most %s, ", number(s->per_dimension, budget),
            number(s->most, most));
    if (!t->hits[last]) {
        fprintf(out, "no method met the last target.\n");
        return;
    }
    fprintf(out, "%s met the last target most often: %.1f %% of %d runs", s->method[best].name,
            100 * t->share[last].value, t->runs);
    others(b, best, VES_FINDING_FIRST, true, "; as often, at a higher cost: ", out);
    others(b, best, VES_FINDING_SECOND, false, "; but run by run it is behind ", out);
    others(b, best, VES_FINDING_MIXED, false, "; different, but neither better: ", out);
    others(b, best, VES_FINDING_SAME, false, "; no difference is shown from ", out);
    others(b, best, VES_FINDING_FEW, false, "; too few runs to tell it from ", out);
    fprintf(out, ".\n");
}

void app_screen_bench(const ves_bench *bench, FILE *out)
{
    heading(bench, out);
    references(bench, out);
    details(bench, out);
    optima(bench, out);
    matrix(bench, out);
    totals(bench, out);
    pairs(bench, out);
    verdict(bench, out);
    if (bench->folder) fprintf(out, "\n  %s/\n", bench->folder);
}
