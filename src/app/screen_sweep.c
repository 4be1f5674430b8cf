/* What vesica sweep prints: docs/sweep.md says how to read it. */
#include "app/screen_sweep.h"

#include <math.h>
#include <string.h>

#include "app/table.h"
#include "study/design.h"

enum { ROWS = 24, WALKS = 48, BAR = 30, COLUMNS = 16, LOST = 3 };

static void range_print(const ves_sweep *s, int axis, FILE *out)
{
    const ves_sweep_axis *a = &s->def->axis[axis];
    char first[VES_QUANTITY], last[VES_QUANTITY];
    ves_sweep_text(s, axis, 0, first);
    ves_sweep_text(s, axis, a->count - 1, last);
    if (a->count == 1)
        fputs(first, out);
    else
        fprintf(out, "%s ... %s (%d values)", first, strstr(last, " = ") + 3, a->count);
}

void app_screen_sweep_head(const ves_sweep *s, FILE *out)
{
    const ves_problem *p = s->problem;
    char points[64], walks[64], jobs[64];
    fprintf(out, "%s  %s\n  ", p->name, p->title);
    for (int k = 0; k < s->def->axes; k++) {
        if (k) fputs(", ", out);
        range_print(s, k, out);
    }
    fprintf(out, ": %s in %s, %s\n", app_screen_plural(s->walks * s->count, "point", "points", points),
            app_screen_plural(s->walks, "walk", "walks", walks),
            app_screen_plural(s->jobs, "job", "jobs", jobs));
}

/* --- walks --- */

static int good_of(const ves_sweep *s, int walk, int *done)
{
    int good = 0;
    *done = 0;
    for (int k = walk * s->count; k < (walk + 1) * s->count; k++) {
        *done += s->point[k].done;
        good += s->point[k].done && s->point[k].good;
    }
    return good;
}

static void bar(const ves_sweep *s, int walk, char text[4 * BAR + 1])
{
    const int length = s->count < BAR ? s->count : BAR;
    size_t at = 0;
    for (int k = 0; k < length; k++) {
        bool all = true;
        for (int place = k * s->count / length; place < (k + 1) * s->count / length; place++) {
            const ves_sweep_point *point = &s->point[ves_sweep_point_at(s, walk, place)];
            all = all && point->done && point->good;
        }
        const char *block = all ? "█" : "░";
        memcpy(text + at, block, strlen(block));
        at += strlen(block);
    }
    text[at] = 0;
}

static void walks(const ves_sweep *s, FILE *out)
{
    app_table t = {.align = "llrl"};
    for (int w = 0; w < s->walks && w < WALKS; w++) {
        char text[4 * BAR + 1];
        int done, good = good_of(s, w, &done);
        bar(s, w, text);
        app_table_cell(&t, "%s", *s->walk[w].name ? s->walk[w].name : s->def->axis[0].name);
        app_table_cell(&t, "%s", text);
        app_table_cell(&t, "%d/%d", good, s->count);
        if (done < s->count)
            app_table_cell(&t, "%d not done yet", s->count - done);
        else if (good < done)
            app_table_cell(&t, "%d lost", done - good);
        app_table_end(&t);
    }
    app_table_print(&t, out);
    if (s->walks > WALKS) fprintf(out, "  ... and %d walks more\n", s->walks - WALKS);
    fputc('\n', out);
}

/* --- what is worth a word --- */

/* "0.5", "0.5 ... 0.58" */
static void range_of_places(const ves_sweep *s, int first, int last, FILE *out)
{
    char a[VES_QUANTITY], b[VES_QUANTITY];
    ves_sweep_text(s, 0, first, a);
    ves_sweep_text(s, 0, last, b);
    fputs(strstr(a, " = ") + 3, out);
    if (first != last) fprintf(out, " ... %s", strstr(b, " = ") + 3);
}

static void places_print(const ves_sweep *s, int first, int last, FILE *out)
{
    fprintf(out, "%s = ", s->def->axis[0].name);
    range_of_places(s, first, last, out);
}

static bool is_lost(const ves_sweep *s, int walk, int place)
{
    const ves_sweep_point *point = &s->point[ves_sweep_point_at(s, walk, place)];
    return point->done && !point->good;
}

/* Are two reasons one but for the numbers in them? */
static bool alike(const char *a, const char *b)
{
    static const char digits[] = "0123456789.e+-";
    for (;; a++, b++) {
        a += strspn(a, digits), b += strspn(b, digits);
        if (*a != *b) return false;
        if (!*a) return true;
    }
}

static bool lost_for(const ves_sweep *s, int walk, int place, const char *reason)
{
    return is_lost(s, walk, place) && alike(s->point[ves_sweep_point_at(s, walk, place)].reason, reason);
}

/* Rows of neighbours that were lost for one reason; the first few. */
static void lost_places(const ves_sweep *s, int walk, const char *reason, FILE *out)
{
    int rows = 0;
    for (int first = 0, last; first < s->count; first = last + 1) {
        last = first;
        if (!lost_for(s, walk, first, reason)) continue;
        while (last + 1 < s->count && lost_for(s, walk, last + 1, reason)) last++;
        if (rows == LOST) {
            fputs(" and elsewhere", out);
            return;
        }
        if (rows++)
            fputs(", ", out);
        else
            fprintf(out, "%s = ", s->def->axis[0].name);
        range_of_places(s, first, last, out);
    }
}

/* A line for each reason that a walk lost points for, as the first that it lost so has it. */
static void lost(const ves_sweep *s, int walk, FILE *out)
{
    const char *name = s->walk[walk].name;
    const ves_sweep_point *point = s->point + walk * s->count;
    for (int k = 0; k < s->count; k++) {
        int before = k - 1;
        if (!point[k].done || point[k].good) continue;
        while (before >= 0 &&
               (!point[before].done || point[before].good || !alike(point[before].reason, point[k].reason)))
            before--;
        if (before >= 0) continue;
        fprintf(out, "  lost       %s%sat ", name, *name ? ", " : "");
        lost_places(s, walk, point[k].reason, out);
        fprintf(out, ": %s\n", point[k].reason);
    }
}

/* How far smaller steps went where a branch was lost. */
static void ends(const ves_sweep *s, int walk, FILE *out)
{
    const ves_sweep_axis *axis = &s->def->axis[0];
    const double factor = s->problem->parameter[axis->parameter].shown.factor;
    const char *name = s->walk[walk].name;
    for (int k = walk * s->count; k < (walk + 1) * s->count; k++) {
        char reached[32], finest[32];
        if (!is_lost(s, walk, ves_sweep_place(s, k)) || !isfinite(s->point[k].reached)) continue;
        fprintf(out, "  ends       %s%sfollowed to %s = %s; a step of %s loses it: %s\n", name,
                *name ? ", " : "", axis->name, app_screen_number(s->point[k].reached / factor, reached),
                app_screen_number(s->def->finest / factor, finest), s->point[k].reason);
    }
}

/* Where a walk goes over to another kind of design. */
static void turns(const ves_sweep *s, int walk, FILE *out)
{
    const char *name = s->walk[walk].name;
    for (int k = walk * s->count; k < (walk + 1) * s->count; k++) {
        const int before = ves_sweep_turned(s, k);
        if (before < 0 || !s->point[k].good) continue;
        fprintf(out, "  kind       %s%s%s becomes %s between ", name, *name ? ": " : "",
                ves_design_kind(s->problem, s->point[before].kind),
                ves_design_kind(s->problem, s->point[k].kind));
        places_print(s, ves_sweep_place(s, before), ves_sweep_place(s, k), out);
        fputc('\n', out);
    }
}

static void apart(const ves_sweep *s, int walk, FILE *out)
{
    int other = ves_sweep_return(s, walk), first, last;
    if (other < walk) return;
    int count = ves_sweep_apart(s, walk, other, &first, &last);
    if (!count) return;
    fprintf(out, "  apart      %s and %s end at different optima at %d of %d values, ", s->walk[walk].name,
            s->walk[other].name, count, s->count);
    places_print(s, first, last, out);
    fputc('\n', out);
}

static void merged(const ves_sweep *s, int walk, FILE *out)
{
    for (int other = walk + 1; other < s->walks; other++) {
        const ves_sweep_walk *a = &s->walk[walk], *b = &s->walk[other];
        int first = 0, last = 0, count = 0;
        if (a->branch == b->branch || a->second != b->second || a->back != b->back) continue;
        for (int k = 0; k < s->count; k++) {
            int i = s->point[ves_sweep_point_at(s, walk, k)].optimum;
            if (!i || i != s->point[ves_sweep_point_at(s, other, k)].optimum) continue;
            if (!count) first = k;
            last = k;
            count++;
        }
        if (!count) continue;
        fprintf(out, "  one        %s and %s end at one optimum at %d of %d values, ", a->name, b->name,
                count, s->count);
        places_print(s, first, last, out);
        fputc('\n', out);
    }
}

static void changes(const ves_sweep *s, int second, FILE *out)
{
    const double factor = s->problem->parameter[s->def->axis[0].parameter].shown.factor;
    ves_sweep_change c;
    for (int place = 0; ves_sweep_change_find(s, second, place, &c); place = c.next) {
        char number[32];
        const ves_sweep_known *known = ves_sweep_change_known(s, &c);
        const bool gone = is_lost(s, c.from, c.next), come = is_lost(s, c.to, c.place);
        fprintf(out, "  changes    the best goes from %s to %s between ", s->walk[c.from].name,
                s->walk[c.to].name);
        places_print(s, c.place, c.next, out);
        if (c.next > c.place + 1) fputs(", all lost between", out);
        if (isfinite(c.at))
            fprintf(out, ", their lines cross at %s", app_screen_number(c.at / factor, number));
        if (known)
            fprintf(out, " (%s%s%s)", app_screen_number(known->at / factor, number),
                    *known->source ? ": " : "", known->source);
        if (!isfinite(c.at) && (gone || come))
            fprintf(out, ": no crossing, %s is lost there%s", s->walk[gone ? c.from : c.to].name,
                    gone && come ? ", and the other before" : "");
        fputc('\n', out);
    }
}

/* --- the best at each value --- */

/* Does the limit of a constraint cost anything, anywhere? */
static bool is_priced(const ves_sweep *s, int constraint)
{
    for (int k = 0; k < s->walks * s->count; k++) {
        double price = s->point[k].done ? s->point[k].column[s->first[VES_SWEEP_PRICE] + constraint] : 0;
        if (s->point[k].best && isfinite(price) && price != 0) return true;
    }
    return false;
}

static void head_cell(app_table *t, const char *before, const char *name, const char *unit)
{
    app_table_cell(t, *unit ? "%s%s [%s]" : "%s%s", before, name, unit);
}

static void best_head(const ves_sweep *s, const int *priced, int prices, app_table *t)
{
    const ves_problem *p = s->problem;
    for (int k = 0; k < s->def->axes; k++)
        head_cell(t, "", s->def->axis[k].name, p->parameter[s->def->axis[k].parameter].shown.unit);
    head_cell(t, "", p->objective ? p->objective_text : "violation", p->objective_shown.unit);
    for (int k = 0; k < prices; k++) {
        const ves_constraint_def *c = &p->constraint[priced[k]];
        app_table_cell(t, "price of %s%s%s", c->text, *c->shown.unit ? ", per " : "", c->shown.unit);
    }
    app_table_cell(t, "%s", s->walks > 1 ? "walk" : "");
    if (p->kinds) app_table_cell(t, "kind");
}

static void best_row(const ves_sweep *s, int index, const int *priced, int prices, app_table *t)
{
    const ves_problem *p = s->problem;
    const ves_sweep_walk *walk = &s->walk[index / s->count];
    const int at[VES_SWEEP_AXES] = {ves_sweep_place(s, index), walk->second};
    const double *column = s->point[index].column;
    for (int k = 0; k < s->def->axes; k++) {
        const ves_sweep_axis *axis = &s->def->axis[k];
        app_table_number(t, axis->value[at[k]] / p->parameter[axis->parameter].shown.factor);
    }
    double value = column[s->first[p->objective ? VES_SWEEP_OBJECTIVE : VES_SWEEP_VIOLATION]];
    app_table_number(t, value / p->objective_shown.factor);
    for (int k = 0; k < prices; k++) {
        double of = p->objective_shown.factor, per = p->constraint[priced[k]].shown.factor;
        app_table_number(t, column[s->first[VES_SWEEP_PRICE] + priced[k]] / of * per);
    }
    app_table_cell(t, "%s", s->walk[index / s->count].name);
    if (p->kinds) app_table_cell(t, "%s", ves_design_kind(p, s->point[index].kind));
}

static void bests(const ves_sweep *s, FILE *out)
{
    const int seconds = s->def->axes > 1 ? s->def->axis[1].count : 1, all = s->count * seconds;
    const int rows = all < ROWS ? all : ROWS;
    int priced[COLUMNS], prices = 0;
    for (int k = 0; k < s->problem->constraints && prices < COLUMNS - 8 - (s->problem->kinds > 0); k++)
        if (is_priced(s, k)) priced[prices++] = k;
    char align[COLUMNS + 1] = "";
    memset(align, 'r', (size_t)(s->def->axes + 1 + prices));
    memset(align + s->def->axes + 1 + prices, 'l', s->problem->kinds ? 2 : 1);
    app_table t = {.align = align};
    best_head(s, priced, prices, &t);
    int shown = 0;
    for (int k = 0; k < rows; k++) {
        int at = rows > 1 ? (int)((long)k * (all - 1) / (rows - 1)) : 0;
        int index = ves_sweep_best_at(s, at / s->count, at % s->count);
        if (index >= 0) best_row(s, index, priced, prices, &t), shown++;
    }
    app_table_print(&t, out);
    if (all > rows && shown) fprintf(out, "  (%d of %d values; all are in sweep.csv)\n", shown, all);
    fputc('\n', out);
}

/* shapes.png is drawn when all is done. */
static bool has_shapes(const ves_sweep *s)
{
    if (s->done < s->walks * s->count) return false;
    for (int k = 0; k < s->walks * s->count; k++)
        if (s->point[k].done && s->point[k].best) return true;
    return false;
}

void app_screen_sweep(const ves_sweep *s, FILE *out)
{
    walks(s, out);
    bests(s, out);
    const int shown = s->walks < WALKS ? s->walks : WALKS;
    for (int w = 0; w < shown; w++) lost(s, w, out);
    for (int w = 0; w < shown; w++) ends(s, w, out);
    for (int w = 0; w < shown; w++) turns(s, w, out);
    for (int w = 0; w < shown; w++) apart(s, w, out);
    for (int w = 0; w < shown; w++) merged(s, w, out);
    for (int j = 0; j < (s->def->axes > 1 ? s->def->axis[1].count : 1); j++) changes(s, j, out);
    fprintf(out, "  %s/   sweep.csv  sweep.png  %sshapes.pvd  points.jsonl\n", s->folder,
            has_shapes(s) ? "shapes.png  " : "");
}
