#define _XOPEN_SOURCE 700 /* pseudo-terminals */

#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <fcntl.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "output/output.h"
#include "vesica/search.h"

/* --- JSON --- */

static const char *read_all(FILE *file)
{
    static char text[65536];
    fflush(file);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    return text;
}

static void json_sample(ves_json *json)
{
    ves_json_object(json, NULL);
    ves_json_text(json, "title", "a \"b\" \\ \n\t\x01 é");
    ves_json_flag(json, "feasible", true);
    ves_json_integer(json, "seed", -3);
    ves_json_array(json, "x");
    ves_json_number(json, NULL, 0.1);
    ves_json_number(json, NULL, -1e300);
    ves_json_end(json, ']');
    ves_json_array(json, "constraints");
    for (int k = 0; k < 2; k++) {
        ves_json_object(json, NULL);
        ves_json_number(json, "value", k ? NAN : 2);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
    ves_json_object(json, "empty");
    ves_json_end(json, '}');
    ves_json_end(json, '}');
}

Test(json, is_laid_out_and_escaped)
{
    FILE *file = tmpfile();
    ves_json json = {.out = file};
    json_sample(&json);
    cr_assert(eq(str, (char *)read_all(file),
                 "{\n"
                 "  \"title\": \"a \\\"b\\\" \\\\ \\n\\t\\u0001 é\",\n"
                 "  \"feasible\": true,\n"
                 "  \"seed\": -3,\n"
                 "  \"x\": [0.1, -1e+300],\n"
                 "  \"constraints\": [\n"
                 "    {\n"
                 "      \"value\": 2\n"
                 "    },\n"
                 "    {\n"
                 "      \"value\": null\n"
                 "    }\n"
                 "  ],\n"
                 "  \"empty\": {}\n"
                 "}\n"));
    fclose(file);
}

Test(json, lines_take_one_line_each)
{
    FILE *file = tmpfile();
    ves_json json = {.out = file, .line = true};
    for (int k = 0; k < 2; k++) {
        ves_json_object(&json, NULL);
        ves_json_array(&json, "x");
        ves_json_number(&json, NULL, 1.5);
        ves_json_array(&json, NULL);
        ves_json_end(&json, ']');
        ves_json_end(&json, ']');
        ves_json_text(&json, "s", k ? "bad \xff\xc0\xaf\xed\xa0\x80." : NULL);
        ves_json_end(&json, '}');
    }
    cr_assert(eq(str, (char *)read_all(file),
                 "{\"x\":[1.5,[]],\"s\":null}\n"
                 "{\"x\":[1.5,[]],\"s\":\"bad "
                 "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD.\"}\n"));
    fclose(file);
}

Test(json, numbers_read_back_exactly)
{
    uint64_t bits = 88172645463325252u;
    FILE *file = tmpfile();
    ves_json json = {.out = file};
    double value[2000];
    for (int k = 0; k < 2000; k++) {
        do {
            bits ^= bits << 13, bits ^= bits >> 7,
                bits ^= bits << 17; /* Marsaglia's xorshift: all exponents */
            memcpy(&value[k], &bits, sizeof bits);
        } while (!isfinite(value[k]));
        ves_json_number(&json, NULL, value[k]);
    }
    const char *text = read_all(file);
    for (int k = 0; k < 2000; k++) {
        char *end;
        double got = strtod(text, &end);
        cr_assert(got == value[k] && *end == '\n', "got %.17g want %.17g", got, value[k]);
        text = end + 1;
    }
    fclose(file);
}

/* --- progress --- */

static ves_progress state(int stage, const char *name, long evaluations)
{
    return (ves_progress){.stage = stage,
                          .stage_name = name,
                          .evaluations = evaluations,
                          .budget = 40000,
                          .temperature = 0.02119,
                          .acceptance = 0.314,
                          .any = true,
                          .value = 1.73121,
                          .violation = 3.1e-4};
}

Test(progress, log_gets_a_line_each_ten_seconds)
{
    FILE *file = tmpfile();
    ves_progress_bar *bar = ves_progress_create(file, VES_PROGRESS_AUTO);
    for (int k = 0; k <= 250; k++) {
        ves_progress p = state(0, "anneal", 100 * k);
        ves_progress_show_at(bar, &p, 1000 + 0.1 * k);
    }
    ves_progress p = state(1, "slsqp", 26000);
    p.temperature = p.acceptance = NAN, p.violation = 0, p.budget = 0;
    ves_progress_show_at(bar, &p, 1026);
    ves_progress_destroy(bar);
    cr_assert(eq(
        str, (char *)read_all(file),
        "  anneal   10,000/40,000  25%  T 2.1e-2  accept 31%  best 1.7312  feas 3e-4  1000 eval/s  ETA 30 s\n"
        "  anneal   20,000/40,000  50%  T 2.1e-2  accept 31%  best 1.7312  feas 3e-4  1000 eval/s  ETA 20 s\n"
        "  anneal   25,000/40,000  62%  T 2.1e-2  accept 31%  best 1.7312  feas 3e-4  1000 eval/s  ETA 15 "
        "s\n"));
    fclose(file);
}

Test(progress, short_run_leaves_no_line_in_a_log)
{
    FILE *file = tmpfile();
    for (int k = 0; k < 3; k++) {
        ves_progress_bar *bar = ves_progress_create(file, (ves_progress_style)k);
        ves_progress p = state(0, "anneal", 100);
        ves_progress_show(bar, &p);
        if (k == 2) ves_progress_show_at(bar, &p, 1e9);
        ves_progress_show(bar, &p);
        ves_progress_destroy(bar);
    }
    ves_progress_destroy(NULL);
    cr_assert(eq(str, (char *)read_all(file), ""));
    fclose(file);
}

/* What arrives at the other side of a terminal. */
static const char *on_terminal(const char *locale, const char *term)
{
    static char text[65536];
    int master = posix_openpt(O_RDWR | O_NOCTTY);
    cr_assert(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
    FILE *slave = fopen(ptsname(master), "w");
    cr_assert(slave != NULL);
    setenv("LC_ALL", locale, 1);
    setenv("TERM", term, 1);
    ves_progress_bar *bar = ves_progress_create(slave, VES_PROGRESS_AUTO);
    for (int k = 0; k <= 100; k++) {
        ves_progress p = state(0, "anneal", 244 * k);
        ves_progress_show_at(bar, &p, 5 + 0.011 * k);
    }
    ves_progress_destroy(bar);
    fclose(slave);
    size_t length = 0; /* until the other side is closed and drained */
    for (ssize_t got = 1; got > 0; length += got > 0 ? (size_t)got : 0)
        got = read(master, text + length, sizeof text - 1 - length);
    text[length] = 0;
    close(master);
    return text;
}

Test(progress, terminal_gets_one_line_rewritten)
{
    const char *text = on_terminal("en_US.UTF-8", "xterm");
    int updates = 0, lines = 0, column = 0, widest = 0;
    for (const char *c = text; *c; c++) {
        updates += *c == '\x1b', lines += *c == '\n';
        if (*c == '\r' || *c == '\x1b')
            column = 0;
        else
            column += (*c & 0xC0) != 0x80;
        if (column > widest) widest = column;
    }
    /* 1.1 s at ten a second: the first and ten more, and the last state */
    cr_assert(updates >= 10 && updates <= 13, "got %d updates: %s", updates, text);
    cr_assert(eq(int, lines, 1));
    cr_assert(widest < 80, "a terminal of 80 columns is not left: %d", widest);
    cr_assert(strstr(text, "anneal   ██████░░░░  24,400/40,000  61%") != NULL, "%s", text);
    text = on_terminal("C", "xterm");
    cr_assert(strstr(text, "anneal   ######....  24,400/40,000  61%") != NULL, "%s", text);
    text = on_terminal("C", "dumb");
    cr_assert(eq(str, (char *)text, ""), "one second on a terminal that cannot rewrite lines");
}
