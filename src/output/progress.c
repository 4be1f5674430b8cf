#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "base/arena.h"
#include "output/output.h"
#include "vesica/search.h"

enum { CELLS = 10, FIELDS = 12, FIELD = 64, NAME = 32, COLUMNS = 80 };

static const double terminal_gap = 0.1, plain_gap = 10; /* seconds between two updates */

struct ves_progress_bar {
    FILE *stream;
    bool terminal, blocks, silent;
    bool started, drawn,
        pending;         /* a stage is shown; its line or lines begun; its latest state not yet written */
    double begin, shown; /* clock: the stage's first sight; the last update */
    long first;          /* evaluations at the stage's first sight */
    double now;
    ves_progress latest;
    char name[NAME]; /* of the stage; latest.stage_name may be gone */
};

/* One line, as fields: when a terminal is too narrow, those of the highest rank go first. */
typedef struct field {
    char text[FIELD];
    int rank;
} field;

typedef struct line {
    field field[FIELDS];
    int fields;
} line;

static void add(line *l, int rank, const char *format, ...) __attribute__((format(printf, 3, 4)));

static void add(line *l, int rank, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    field *f = &l->field[l->fields++];
    vsnprintf(f->text, FIELD, format, list);
    f->rank = rank;
    va_end(list);
}

static int width(const char *text)
{
    int count = 0;
    for (; *text; text++) count += ((unsigned char)*text & 0xC0) != 0x80;
    return count;
}

/* 24310 -> 24,310 */
static const char *thousands(long value, char buffer[32])
{
    char digits[32];
    int length = snprintf(digits, sizeof digits, "%ld", value), at = 0;
    for (int k = 0; k < length; k++) {
        if (k && (length - k) % 3 == 0 && digits[k - 1] != '-') buffer[at++] = ',';
        buffer[at++] = digits[k];
    }
    buffer[at] = 0;
    return buffer;
}

/* 0.021 -> 2.1e-2 */
static const char *scientific(double value, int decimals, char buffer[32])
{
    char text[32];
    snprintf(text, sizeof text, "%.*e", decimals, value);
    char *e = strchr(text, 'e');
    if (!e)
        snprintf(buffer, 32, "%s", text); /* inf, nan */
    else
        snprintf(buffer, 32, "%.*se%ld", (int)(e - text), text, strtol(e + 1, NULL, 10));
    return buffer;
}

static void add_bar(line *l, double share, bool blocks)
{
    char text[FIELD] = "";
    double full = share * CELLS;
    for (int k = 0; k < CELLS; k++)
        strcat(text, k + 0.5 <= full ? (blocks ? "█" : "#") : (blocks ? "░" : "."));
    add(l, 5, "%s", text);
}

static void add_rate(line *l, double rate)
{
    if (rate >= 1e6)
        add(l, 7, "%.1f M eval/s", rate / 1e6);
    else if (rate >= 1e4)
        add(l, 7, "%.1f k eval/s", rate / 1e3);
    else
        add(l, 7, "%.*f eval/s", rate < 100, rate);
}

static void add_eta(line *l, double seconds)
{
    long s = (long)ceil(seconds);
    if (s < 60)
        add(l, 3, "ETA %ld s", s);
    else if (s < 3600)
        add(l, 3, "ETA %ld min %02ld s", s / 60, s % 60);
    else if (s < 100 * 3600)
        add(l, 3, "ETA %ld h %02ld min", s / 3600, s / 60 % 60);
}

static void add_search(line *l, const ves_progress *p)
{
    char text[32];
    if (isfinite(p->temperature)) add(l, 8, "T %s", scientific(p->temperature, 1, text));
    if (isfinite(p->acceptance)) add(l, 9, "accept %.0f%%", 100 * p->acceptance);
    if (p->any) add(l, 2, "best %.5g", p->value);
    if (p->any && p->violation > 0) add(l, 4, "feas %s", scientific(p->violation, 0, text));
}

static void compose(const ves_progress_bar *bar, line *l)
{
    const ves_progress *p = &bar->latest;
    double share = p->budget > 0 ? (double)p->evaluations / (double)p->budget : -1;
    double elapsed = bar->now - bar->begin;
    double rate = elapsed > 0.2 ? (double)(p->evaluations - bar->first) / elapsed : 0;
    char done[32], all[32];
    l->fields = 0;
    if (share > 1) share = 1;
    add(l, 0, "%-7s", bar->name);
    if (share >= 0) {
        if (bar->terminal) add_bar(l, share, bar->blocks);
        add(l, 6, "%s/%s", thousands(p->evaluations, done), thousands(p->budget, all));
        add(l, 1, "%.0f%%", floor(100 * share));
    } else {
        add(l, 1, "%s", thousands(p->evaluations, done));
    }
    add_search(l, p);
    if (rate > 0) add_rate(l, rate);
    if (rate > 0 && share >= 0) add_eta(l, (double)(p->budget - p->evaluations) / rate);
}

static void drop_one(line *l)
{
    int worst = 0;
    for (int k = 1; k < l->fields; k++)
        if (l->field[k].rank > l->field[worst].rank) worst = k;
    l->fields--;
    memmove(&l->field[worst], &l->field[worst + 1], (size_t)(l->fields - worst) * sizeof(field));
}

static int line_width(const line *l)
{
    int sum = 0;
    for (int k = 0; k < l->fields; k++) sum += width(l->field[k].text) + 2;
    return sum - 2;
}

static int columns(FILE *stream)
{
    struct winsize size;
    if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    return COLUMNS;
}

static void draw(ves_progress_bar *bar)
{
    line l;
    compose(bar, &l);
    if (bar->terminal) {
        int most = columns(bar->stream) - 3; /* two blanks before, and the last column stays free */
        while (l.fields > 1 && line_width(&l) > most) drop_one(&l);
        putc('\r', bar->stream);
    }
    for (int k = 0; k < l.fields; k++) fprintf(bar->stream, "  %s", l.field[k].text);
    fputs(bar->terminal ? "\x1b[K" : "\n", bar->stream);
    fflush(bar->stream);
    bar->shown = bar->now;
    bar->drawn = true;
    bar->pending = false;
}

/* Of a stage that was shown, the last state stays on the screen or in the log. */
static void stage_end(ves_progress_bar *bar)
{
    if (!bar->started || !bar->drawn) return;
    if (bar->pending) draw(bar);
    if (bar->terminal) putc('\n', bar->stream);
    fflush(bar->stream);
}

static void stage_begin(ves_progress_bar *bar, const ves_progress *progress, double now)
{
    if (!bar->started)
        bar->shown = now; /* a log's first line comes after ten seconds; short runs leave none */
    bar->started = true;
    bar->drawn = false;
    bar->begin = now;
    bar->first = progress->evaluations;
    snprintf(bar->name, NAME, "%s", progress->stage_name ? progress->stage_name : "search");
}

void ves_progress_break(ves_progress_bar *bar)
{
    if (!bar || bar->silent || !bar->terminal || !bar->drawn) return;
    putc('\n', bar->stream);
    bar->drawn = false;
}

void ves_progress_show_at(ves_progress_bar *bar, const ves_progress *progress, double now)
{
    if (!bar || bar->silent) return;
    if (!bar->started || bar->latest.stage != progress->stage) {
        stage_end(bar);
        stage_begin(bar, progress, now);
    }
    bar->latest = *progress;
    bar->now = now;
    bar->pending = true;
    bool first = bar->terminal && !bar->drawn;
    if (first || now - bar->shown >= (bar->terminal ? terminal_gap : plain_gap)) draw(bar);
}

void ves_progress_show(ves_progress_bar *bar, const ves_progress *progress)
{
    struct timespec now;
    if (!bar || bar->silent) return;
    clock_gettime(CLOCK_MONOTONIC, &now);
    ves_progress_show_at(bar, progress, (double)now.tv_sec + 1e-9 * (double)now.tv_nsec);
}

/* Blocks unless the environment names a character set that has none. */
static bool has_blocks(void)
{
    const char *name[] = {"LC_ALL", "LC_CTYPE", "LANG"}, *value = NULL;
    for (int k = 0; k < 3 && !(value && *value); k++) value = getenv(name[k]);
    if (!value || !*value) return true;
    const char *set = strchr(value, '.');
    return set && (!strncasecmp(set, ".utf8", 5) || !strncasecmp(set, ".utf-8", 6));
}

ves_progress_bar *ves_progress_create(FILE *stream, ves_progress_style style)
{
    ves_progress_bar *bar = ves_memory_take(sizeof *bar);
    if (!bar) return NULL;
    const char *term = getenv("TERM");
    bool dumb = term && !strcmp(term, "dumb");
    bar->stream = stream;
    bar->silent = style == VES_PROGRESS_NONE;
    bar->terminal = style == VES_PROGRESS_AUTO && !dumb && isatty(fileno(stream));
    bar->blocks = has_blocks();
    return bar;
}

void ves_progress_destroy(ves_progress_bar *bar)
{
    if (!bar) return;
    stage_end(bar);
    ves_memory_free(bar);
}
