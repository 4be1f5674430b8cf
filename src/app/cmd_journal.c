/* vesica journal */
#include <math.h>
#include <string.h>

#include "app/app.h"
#include "base/diag.h"
#include "base/text.h"
#include "study/convergence.h"

/* --- CSV --- */

static void quoted(const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        fputs(text, stdout);
        return;
    }
    putchar('"');
    for (; *text; text++) {
        if (*text == '"') putchar('"');
        putchar(*text);
    }
    putchar('"');
}

static void cell(double value)
{
    char text[32];
    putchar(',');
    if (!isfinite(value)) return;
    ves_text_shortest(value, text);
    fputs(text, stdout);
}

static void csv_head(const ves_entries *e)
{
    fputs("evaluation,stage,chain", stdout);
    for (int k = 0; k < e->n; k++) putchar(','), quoted(e->variable[k]);
    fputs(",value,violation", stdout);
    for (int k = 0; k < e->m; k++) putchar(','), quoted(e->constraint[k]);
    fputs(",T,accepted,status,asked\n", stdout);
}

static const char *asked(const ves_entry *entry)
{
    return entry->proof ? "proof" : entry->gradient ? "gradient" : "value";
}

static void csv_line(const ves_entries *e, const ves_entry *entry)
{
    printf("%ld,%d,%d", entry->evaluation, entry->stage, entry->chain);
    for (int k = 0; k < e->n; k++) cell(entry->x[k]);
    cell(entry->value);
    cell(entry->violation);
    for (int k = 0; k < e->m; k++) cell(entry->excess ? entry->excess[k] : NAN);
    cell(entry->temperature);
    printf(",%d,%s,%s\n", entry->accepted, ves_status_word(entry->status), asked(entry));
}

/* --- JSON lines --- */

static void json_line(const ves_entries *e, const ves_entry *entry)
{
    ves_json json = {.out = stdout, .line = true};
    ves_json_object(&json, NULL);
    ves_json_integer(&json, "evaluation", entry->evaluation);
    ves_json_integer(&json, "stage", entry->stage);
    ves_json_integer(&json, "chain", entry->chain);
    ves_json_object(&json, "x");
    for (int k = 0; k < e->n; k++) ves_json_number(&json, e->variable[k], entry->x[k]);
    ves_json_end(&json, '}');
    ves_json_number(&json, "value", entry->value);
    ves_json_number(&json, "violation", entry->violation);
    ves_json_array(&json, "constraints");
    for (int k = 0; k < e->m; k++) ves_json_number(&json, NULL, entry->excess ? entry->excess[k] : NAN);
    ves_json_end(&json, ']');
    ves_json_number(&json, "T", entry->temperature);
    ves_json_flag(&json, "accepted", entry->accepted);
    ves_json_text(&json, "status", ves_status_word(entry->status));
    ves_json_text(&json, "asked", asked(entry));
    ves_json_end(&json, '}');
}

int app_journal(app *a)
{
    ves_entries entries;
    ves_entry entry;
    if (a->options.png && a->options.to)
        return app_fail(a, VES_USAGE, "--png draws the journal, --to %s prints it: one of them",
                        a->options.to);
    int format = a->options.to ? ves_words_find("csv|jsonl", a->options.to) : 0;
    if (format < 0)
        return app_fail(a, VES_USAGE, "vesica journal writes csv or jsonl, not \"%s\"", a->options.to);
    ves_status status = ves_entries_open(&entries, a->operand[0], &a->arena, a->diag);
    if (status != VES_OK) return status == VES_IO ? APP_WRONG : app_code(status);
    if (a->options.png)
        status = ves_convergence_write(&entries, a->options.png, &a->arena, a->diag);
    else if (format == 0)
        csv_head(&entries);
    while (!a->options.png && !ferror(stdout) && ves_entries_next(&entries, &entry))
        (format ? json_line : csv_line)(&entries, &entry);
    long torn = ves_entries_torn(&entries);
    if (torn > 0)
        ves_diag_add(a->diag, VES_NOTE, VES_OK, (ves_mark){0},
                     "the last %ld bytes of \"%s\" are not whole: the run is going on, or was killed", torn,
                     entries.path);
    int code = torn < 0 ? app_fail(a, VES_IO, "cannot read \"%s\" to its end", entries.path) : APP_DONE;
    ves_entries_close(&entries);
    if (a->options.png && status == VES_OK) printf("%s\n", a->options.png);
    return status == VES_OK ? code : app_code(status);
}
