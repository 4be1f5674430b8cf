/* The folder of a benchmark where others than vesica have written in it: what does not hold is told and made again, and
 * what cannot be read is not lost. */
#include <criterion/criterion.h>

#include "program.h"

enum { SEEDS = 25, RUNS = 2 * SEEDS };

/* A problem of two variables with values of its own, and a function. */
static const char suite[] = "vesica: 1\nsuite: two\nproblems: [{file: " PROBLEMS
                            "bottle.yaml, name: can}, {function: rastrigin, n: 2}]\n"
                            "seeds: 25\nbudget: {per_dimension: 60}\nmethods: {auto: {search: auto}}\n";

TestSuite(cli_bench_folder, .timeout = 600);

static void whole_make(void)
{
    root_make();
    write_file("s.yaml", suite);
    expect(vesica(NULL, "bench s.yaml --out whole"), 0, NULL, NULL, "whole");
}

static void whole_again(const char *out, const char *err, const char *what)
{
    expect(vesica(NULL, "bench --resume part"), 0, out, err, what);
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    same_file("whole/report.json", "part/report.json");
}

/* What mpirun has left where it was killed: lines of three ranks. */
static void ranks_make(void)
{
    cr_assert(system("rm -rf part && cp -r whole part && cd part && for f in runs times; do"
                     " head -20 ../whole/$f.jsonl >$f.jsonl; sed -n 21,35p ../whole/$f.jsonl >$f.2.jsonl;"
                     " tail -15 ../whole/$f.jsonl >$f.11.jsonl; done") == 0);
}

Test(cli_bench_folder, lines_of_other_ranks_are_gathered_or_stay)
{
    whole_make();
    ranks_make();
    whole_again(NULL, "50 of 50 runs are there already", "ranks");
    same_file("whole/times.jsonl", "part/times.jsonl");
    cr_expect(system("ls part | grep -q '[0-9].jsonl'") != 0, "files of ranks are left");
    ranks_make(); /* who is root reads what has no permissions, but no folder as a file */
    cr_assert(system("cd part && mv times.2.jsonl ../ && mkdir times.2.jsonl && cp -r . ../before") == 0);
    expect(vesica(NULL, "bench --resume part"), 3, NULL, "cannot read \"part/times.2.jsonl\"", "a folder");
    cr_expect(system("diff -r -x report.json -x '*.png' before part") == 0, "lines are lost");
    cr_assert(system("rmdir part/times.2.jsonl && mv times.2.jsonl part/") == 0);
    whole_again(NULL, "50 of 50 runs are there already", "readable again");
    root_remove();
}

/* Rank 0 writes runs.jsonl, and no other name than that of a rank is one. */
Test(cli_bench_folder, what_looks_like_a_rank_is_none)
{
    static const char *const name[] = {"runs.0.jsonl",          "runs.-1.jsonl", "runs.01.jsonl",
                                       "runs.1.jsonl~",         "runs.+1.jsonl", "runs.1e.jsonl",
                                       "runs.99999999999.jsonl"};
    whole_make();
    cr_assert(system("cp -r whole part && tail -3 whole/runs.jsonl >tail && head -47 whole/runs.jsonl "
                     ">part/runs.jsonl") == 0);
    for (size_t k = 0; k < sizeof name / sizeof *name; k++) {
        char command[100];
        snprintf(command, sizeof command, "cp tail 'part/%s'", name[k]);
        cr_assert(system(command) == 0);
    }
    whole_again(NULL, "47 of 50 runs are there already", "names");
    for (size_t k = 0; k < sizeof name / sizeof *name; k++) {
        char path[100];
        snprintf(path, sizeof path, "part/%s", name[k]);
        same_file("tail", path);
    }
    root_remove();
}

/* A journal that is there but cannot be read is no damage: nothing is lost. That there are no times is told. */
Test(cli_bench_folder, a_journal_that_cannot_be_read_ends_it)
{
    whole_make();
    cr_assert(system("cp -r whole part && rm part/journals/00003.jsonl && mkdir part/journals/00003.jsonl && "
                     "head -47 whole/runs.jsonl >part/runs.jsonl && cp part/runs.jsonl before") == 0);
    expect(vesica(NULL, "bench --resume part"), 3, NULL, "cannot read \"part/journals/00003.jsonl\"",
           "a folder");
    same_file("before", "part/runs.jsonl");
    cr_assert(system("rmdir part/journals/00003.jsonl && cp whole/journals/00003.jsonl part/journals/ && "
                     "rm part/times.jsonl") == 0);
    whole_again(NULL, "part/times.jsonl\" is missing: how long the runs before took is not known", "times");
    root_remove();
}

/* Gives a key of a line another value (NULL: removes it). */
static void line_spoil(FILE *out, const char *line, int length, const char *key, const char *value)
{
    char word[32];
    snprintf(word, sizeof word, "\"%s\":", key);
    const char *at = strstr(line, word), *end = line + length;
    cr_assert(at != NULL && at < end, "no %s in %.*s", word, length, line);
    const char *old = at + strlen(word),
               *after = *old == '[' ? strchr(old, ']') + 1 : old + strcspn(old, ",}");
    if (value)
        fprintf(out, "%.*s%s%.*s\n", (int)(old - line), line, value, (int)(end - after), after);
    else
        fprintf(out, "%.*s%.*s\n", (int)(at - line), line, (int)(end - after - 1), after + 1);
}

typedef struct damage {
    const char *key, *value;
} damage;

/* Line k of a file gets damage k. */
static void lines_spoil(const char *from, const char *to, const damage *list, int count)
{
    char *text = slurp(from);
    FILE *out = fopen(to, "w");
    cr_assert(out != NULL);
    int k = 0;
    for (const char *line = text; *line; line += strcspn(line, "\n") + 1, k++) {
        int length = (int)strcspn(line, "\n");
        if (k < count)
            line_spoil(out, line, length, list[k].key, list[k].value);
        else
            fprintf(out, "%.*s\n", length, line);
    }
    cr_assert(k >= count, "%s has %d lines", from, k);
    fclose(out);
    free(text);
}

static void lines_told(const outcome *o, const char *path, const damage *list, int count)
{
    for (int k = 0; k < count; k++) {
        char said[100];
        snprintf(said, sizeof said, "\"part/%s\": line %d is damaged", path, k + 1);
        cr_expect(strstr(o->err, said) != NULL, "%s %s: no \"%s\" in\n%s", list[k].key,
                  list[k].value ? list[k].value : "left out", said, o->err);
    }
    cr_expect(count_of("stderr", "is damaged") == count, "%s", o->err);
}

Test(cli_bench_folder, a_run_that_cannot_have_been_is_made_again)
{
    static const damage damages[] = {{"x", "[0.5]"},
                                     {"x", "[0.5,0.5,0.5]"},
                                     {"x", "[]"},
                                     {"x", "[0.5,1.5]"},
                                     {"x", "[-1e-9,0.5]"},
                                     {"x", "[0.5,null]"},
                                     {"x", "[0.5,[0.5]]"},
                                     {"x", "0.5"},
                                     {"value", "null"},
                                     {"value", "1e999"},
                                     {"value", "nan"},
                                     {"value", NULL},
                                     {"violation", "-1e-9"},
                                     {"violation", "null"},
                                     {"violation", "3"}, /* and feasible */
                                     {"feasible", "false"},
                                     {"end", "\"won\""},
                                     {"end", NULL},
                                     {"budget", "119"},
                                     {"budget", "null"},
                                     {"spent", "-1"},
                                     {"spent", "120.5"},
                                     {"spent", "null"},
                                     {"evaluations", "54.5"},
                                     {"evaluations", "-55"},
                                     {"evaluations", "1e300"},
                                     {"evaluations", "null"},
                                     {"evaluations", NULL},
                                     {"gradients", "1e3"}, /* more than evaluations */
                                     {"gradients", "nan"},
                                     {"failures", "1e3"},
                                     {"failures", "-1"},
                                     {"starts", "0.5"},
                                     {"starts", "3e9"},
                                     {"starts", "null"},
                                     {"reason", "[]"},
                                     {"reason", NULL},
                                     {"run", "0.5"},
                                     {"run", "-1"},
                                     {"run", "1e300"},
                                     {"run", "null"},
                                     {"seed", "1e300"},
                                     {"seed", "-1"},
                                     {"problem", "\"\""}};
    enum { COUNT = sizeof damages / sizeof *damages };
    whole_make();
    cr_assert(system("cp -r whole part") == 0);
    lines_spoil("whole/runs.jsonl", "part/runs.jsonl", damages, COUNT);
    outcome o = vesica(NULL, "bench --resume part");
    cr_expect(o.code == 0, "exit %d\n%s", o.code, o.err);
    lines_told(&o, "runs.jsonl", damages, COUNT);
    done(&o);
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    same_file("whole/report.json", "part/report.json");
    root_remove();
}

/* What a run took is not worth the run; but it is no time either. */
Test(cli_bench_folder, times_that_cannot_have_been_are_not_known)
{
    static const damage damages[] = {{"run", "0.5"},      {"run", "-1"},         {"run", "1e300"},
                                     {"run", "50"},       {"run", "null"},       {"run", NULL},
                                     {"wall_s", "-1"},    {"wall_s", "1e999"},   {"wall_s", NULL},
                                     {"inside_s", "[1]"}, {"inside_s", "\"a\""}, {"cpu_s", "-1e-3"}};
    enum { COUNT = sizeof damages / sizeof *damages };
    whole_make();
    cr_assert(system("cp -r whole part") == 0);
    lines_spoil("whole/times.jsonl", "part/times.jsonl", damages, COUNT);
    outcome o = vesica(NULL, "bench --resume part");
    cr_expect(o.code == 0 && strstr(o.err, "50 of 50 runs are there already") != NULL, "exit %d\n%s", o.code,
              o.err);
    lines_told(&o, "times.jsonl", damages, COUNT);
    done(&o);
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    cr_expect(count_of("part/times.jsonl", "\n") == RUNS);
    cr_expect(count_of("part/times.jsonl", "\"wall_s\":null") == COUNT);
    o = vesica(NULL, "bench --resume part"); /* told once */
    cr_expect(o.code == 0 && strstr(o.err, "damaged") == NULL, "%s", o.err);
    done(&o);
    root_remove();
}

Test(cli_bench_folder, a_journal_that_cannot_have_been_is_made_again)
{
    static const struct {
        const char *before, *after; /* text put before and after it */
        int drop;                   /* bytes of its end left out; -1: all, -2: its last line */
    } damages[] = {{"", "", -1},
                   {"", "", -2}, /* does not come to the best */
                   {"", "", 1},
                   {"", "[", 0},
                   {"", "\n", 0},
                   {"[1e-3,5,-1]\n", "", 0},
                   {"[1e-3,null,5]\n", "", 0},
                   {"[null,5,1e99]\n", "", 0},
                   {"[1e-3,5,null]\n", "", 0},
                   {"[1e-3,nan,1e99]\n", "", 0},
                   {"[-1,5,1e99]\n", "", 0},
                   {"[0,5,1e99]\n", "", 0},
                   {"[50,5,1e99]\n", "", 0},    /* then costs fall */
                   {"[1e-3,5,1e-99]\n", "", 0}, /* then it gets worse */
                   {"", "[1e-3,-99,0]\n", 0},
                   {"", "[1e9,-99,0]\n", 0},
                   {"", "[110,99,0]\n", 0},
                   {"", "[110,-99,0]\n", 0}, /* better than the best */
                   {"[1e-3,5]\n", "", 0},
                   {"[1e-3,5,1e99,1]\n", "", 0},
                   {"[1e-3 5,1e99,1]\n", "", 0},
                   {"1e-3,5,1e99\n", "", 0},
                   {"{}\n", "", 0}};
    enum { COUNT = sizeof damages / sizeof *damages };
    cr_assert((int)COUNT <= (int)SEEDS, "all on the first problem");
    whole_make();
    cr_assert(system("cp -r whole part") == 0);
    for (int k = 0; k < COUNT; k++) {
        char path[64];
        snprintf(path, sizeof path, "part/journals/%05d.jsonl", k);
        char *text = slurp(path);
        size_t length = strlen(text);
        cr_assert(length > 2);
        size_t last = length - 1;
        while (last > 0 && text[last - 1] != '\n') last--;
        text[damages[k].drop == -1 ? 0 : damages[k].drop == -2 ? last : length - (size_t)damages[k].drop] = 0;
        FILE *out = fopen(path, "w");
        cr_assert(out != NULL);
        fprintf(out, "%s%s%s", damages[k].before, text, damages[k].after);
        fclose(out);
        free(text);
    }
    outcome o = vesica(NULL, "bench --resume part");
    cr_expect(o.code == 0, "exit %d\n%s", o.code, o.err);
    for (int k = 0; k < COUNT; k++) {
        char said[100];
        snprintf(said, sizeof said, "journals/%05d.jsonl\" is missing or damaged: run %d is made again", k,
                 k);
        cr_expect(strstr(o.err, said) != NULL, "%d: %s", k, o.err);
    }
    done(&o);
    cr_expect(count_of("stderr", "is made again") == COUNT);
    cr_expect(system("diff -r whole/journals part/journals") == 0);
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    /* a zero byte is no end of a file */
    cr_assert(system("printf '\\0' | dd of=part/runs.jsonl bs=1 seek=3 conv=notrunc 2>dd && "
                     "printf '\\0' | dd of=part/journals/00007.jsonl bs=1 seek=3 conv=notrunc 2>dd") == 0);
    o = vesica(NULL, "bench --resume part");
    cr_expect(o.code == 0 && strstr(o.err, "48 of 50") != NULL &&
                  strstr(o.err, "line 1 is damaged") != NULL &&
                  strstr(o.err, "00007.jsonl\" is missing or damaged") != NULL,
              "%s", o.err);
    done(&o);
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    root_remove();
}
