/* vesica bench where something goes wrong, is broken off, or is gone on with; and what it may conclude. */
#include <criterion/criterion.h>

#include "program.h"

/* One limit for all: Criterion forgets a timer of its own where tests that run side by side have different ones. */
TestSuite(cli_bench_ends, .timeout = 600);

/* The first run hangs; what ends meanwhile is written at once, and a stop says how far it came. */
Test(cli_bench_ends, a_run_that_is_over_is_kept)
{
    root_make();
    write_file("s.yaml", "vesica: 1\nsuite: one hangs\nproblems: [{function: sphere, n: 3}]\nseeds: 1\n"
                         "methods:\n  slow: {program: [sleep, \"60\"], seconds: 60}\n"
                         "  auto: {search: auto}\n  other: {search: auto, gradients: false}\n");
    pid_t child = launch("bench s.yaml --out b --jobs 2", NULL, "stdout.b");
    for (int k = 0; k < 1000 && (access("b/runs.jsonl", F_OK) || count_of("b/runs.jsonl", "\n") < 2); k++)
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    cr_expect(count_of("b/runs.jsonl", "\n") == 2, "the runs behind the first are not written");
    kill(child, SIGTERM);
    cr_expect(wait_for(child) == 130);
    cr_expect(count_of("stdout.b", "interrupted") == 1 && count_of("stdout.b", "nan") == 0);
    cr_expect(count_of("stdout.b", "No verdict: there is no run yet of slow.") == 1);
    cr_expect(count_of("stderr", "bench --resume b") == 1);
    cr_expect(count_of("b/report.json", "\"interrupted\": true") == 1);
    cr_expect(count_of("b/runs.jsonl", "\n") == 2);
    root_remove();
}

static const char mixed[] =
    "vesica: 1\nsuite: files and a program\nproblems: [{file: ./can.yaml, set: {search: auto}}, {function: "
    "sphere, n: 2}]\nseeds: 2\nbudget: {per_dimension: 60}\nmethods:\n  auto: {search: auto}\n"
    "  random: {program: [python3, ./random.py]}\n";

/* Benchmarks of different problems, programs or versions are not mixed; one of the same goes on from anywhere. */
Test(cli_bench_ends, goes_on_only_with_the_same)
{
    static const struct {
        const char *file, *old, *new, *hint;
    } changes[] = {
        {"part/suite.yaml", "60", "90", "part/suite.yaml\" is not what it was"},
        {"part/problems/0.yaml", "vesica: 1", "vesica:  1", "problems/0.yaml\" is not what it was"},
        {"random.py", "import json", "import  json", "random.py\" is not what it was"},
        {"part/bench.json", "\"version\": \"", "\"version\": \"9", "was made by vesica 9"}};
    root_make();
    cr_assert(
        system("cp " VESICA_SOURCE "/bench/suites/random.py . && cp " PROBLEMS "bottle.yaml can.yaml") == 0);
    write_file("s.yaml", mixed);
    expect(vesica(NULL, "bench s.yaml --out whole"), 0, NULL, NULL, "whole");
    cr_assert(system("head -3 whole/runs.jsonl >cut && cp random.py keep.py") == 0);
    for (size_t k = 0; k < sizeof changes / sizeof *changes; k++) {
        cr_assert(
            system("rm -rf part && cp -r whole part && cp cut part/runs.jsonl && cp keep.py random.py") == 0);
        replace(changes[k].file, changes[k].old, changes[k].new);
        expect(vesica(NULL, "bench --resume part"), 2, NULL, changes[k].hint, changes[k].file);
        cr_expect(count_of("part/runs.jsonl", "\n") == 3, "nothing is touched");
    }
    /* the problem is read from the folder, wherever vesica is called and whatever became of the file */
    cr_assert(system("rm -rf part && cp -r whole part && cp cut part/runs.jsonl && cp keep.py random.py && "
                     "rm can.yaml && mkdir elsewhere") == 0);
    cr_assert(chdir("elsewhere") == 0);
    hush();
    expect(vesica(NULL, "bench --resume ../part"), 0, NULL, "3 of 8 runs are there already", "elsewhere");
    cr_assert(chdir("..") == 0);
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    same_file("whole/report.json", "part/report.json");
    root_remove();
}

/* A program that is added later is one of the methods as any other: its runs are what they would have been, those
 * that were there stay, a stop is told, and it may not become another one. */
Test(cli_bench_ends, a_program_can_be_added)
{
    static const char head[] =
        "vesica: 1\nsuite: added\nproblems: [{file: ./can.yaml}, {function: sphere, n: "
        "2}]\nseeds: 2\nbudget: {per_dimension: 60}\nmethods:\n  auto: {search: auto}\n";
    static const char random[] = "  random: {program: [python3, ./random.py]}\n";
    char text[600];
    root_make();
    cr_assert(system("cp " VESICA_SOURCE "/bench/suites/random.py . && cp " PROBLEMS
                     "bottle.yaml can.yaml && "
                     "mkdir elsewhere") == 0);
    snprintf(text, sizeof text, "%s%s", head, random);
    write_file("both.yaml", text);
    write_file("s.yaml", head);
    write_file("may_hang.sh", "[ ! -e hang ] || exec sleep 60\nread a\nexit 3\n");
    expect(vesica(NULL, "bench both.yaml --out both"), 0, NULL, NULL, "both");
    expect(vesica(NULL, "bench s.yaml --out b"), 0, NULL, NULL, "one");
    cr_expect(count_of("b/bench.json", "random.py") == 0);
    cr_assert(chdir("elsewhere") == 0); /* ./ is where the suite is */
    hush();
    expect(vesica(NULL, "bench --resume ../b --add random={\"program\":[python3,./random.py]}"), 0, "random",
           "4 of 8 runs are there already", "added");
    cr_assert(chdir("..") == 0);
    same_file("both/runs.jsonl", "b/runs.jsonl");
    same_file("both/report.json", "b/report.json");
    cr_expect(count_of("b/bench.json", "random.py") == 1);

    write_file("hang", "");
    pid_t child = launch("bench --resume b --add maybe={\"program\":[sh,./may_hang.sh],\"seconds\":60}", NULL,
                         "stdout.b");
    for (int k = 0; k < 1000 && count_of("b/bench.json", "may_hang.sh") == 0; k++)
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
    kill(child, SIGTERM);
    cr_expect(wait_for(child) == 130);
    cr_expect(count_of("stdout.b", "No verdict: there is no run yet of maybe.") == 1);
    cr_expect(count_of("stderr", "bench --resume b") == 1);
    cr_expect(count_of("b/report.json", "\"interrupted\": true") == 1);
    same_file("both/runs.jsonl", "b/runs.jsonl");
    cr_assert(remove("hang") == 0);
    expect(vesica(NULL, "bench --resume b"), 0, "maybe", "8 of 12 runs are there already", "gone on with");
    cr_expect(count_of("b/runs.jsonl", "\"end\":\"failed\",\"reason\":\"the program ended") == 4);
    cr_expect(count_of("b/report.json", "\"interrupted\": false") == 1);

    replace("may_hang.sh", "exit 3", "exit 4");
    expect(vesica(NULL, "bench --resume b"), 2, NULL, "may_hang.sh\" is not what it was", "another program");
    replace("may_hang.sh", "exit 4", "exit 3");
    expect(vesica(NULL, "bench --resume b"), 0, NULL, "12 of 12", "the same again");
    cr_assert(remove("random.py") == 0);
    expect(vesica(NULL, "bench --resume b --add nm={\"nlopt\":LN_NELDERMEAD}"), 2, NULL,
           "random.py\" is not what it was", "no program");
    cr_expect(count_of("b/bench.json", "nm") == 0);
    root_remove();
}

Test(cli_bench_ends, goes_on_only_with_the_same_plugin)
{
    root_make();
    cr_assert(system("cc -std=c17 -shared -fPIC -I" VESICA_SOURCE "/include -o tower.so " VESICA_SOURCE
                     "/examples/objective/tower.c -lm && cp tower.so keep.so") == 0);
    write_file("s.yaml",
               "vesica: 1\nsuite: s\nproblems: [{plugin: ./tower.so}]\nseeds: 2\nbudget: {per_dimension: "
               "60}\nmethods: {auto: {search: auto}}\n");
    expect(vesica(NULL, "bench s.yaml --out b"), 0, NULL, NULL, "plugin");
    cr_assert(system("echo >>tower.so") == 0);
    expect(vesica(NULL, "bench --resume b"), 2, NULL, "tower.so\" is not what it was", "another");
    cr_assert(rename("keep.so", "tower.so") == 0);
    expect(vesica(NULL, "bench --resume b"), 0, NULL, "2 of 2 runs are there already", "the same");
    root_remove();
}

/* Lines in any order hold; what is damaged is named and made again. */
Test(cli_bench_ends, what_is_damaged_is_made_again)
{
    root_make();
    write_file("s.yaml", "vesica: 1\nsuite: two\nproblems: [{function: rastrigin, n: 2}]\nseeds: 2\n"
                         "budget: {per_dimension: 200}\nmethods: {auto: {search: auto}, nm: {nlopt: "
                         "LN_NELDERMEAD}}\n");
    expect(vesica(NULL, "bench s.yaml --out whole"), 0, NULL, NULL, "whole");
    cr_assert(system("cp -r whole part && tac whole/runs.jsonl >part/runs.jsonl") == 0);
    expect(vesica(NULL, "bench --resume part"), 0, NULL, "4 of 4 runs are there already", "backwards");
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    write_file("part/journals/00000.jsonl", "[1,2\n");
    expect(vesica(NULL, "bench --resume part"), 0, NULL,
           "part/journals/00000.jsonl\" is missing or damaged: run 0 is made again", "journal");
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    same_file("whole/journals/00000.jsonl", "part/journals/00000.jsonl");
    replace("part/runs.jsonl", "\"run\":1", "\"run\":7");
    expect(vesica(NULL, "bench --resume part"), 0, NULL, "line 2 is damaged, or of no run of this suite",
           "line");
    same_file("whole/runs.jsonl", "part/runs.jsonl");
    expect(vesica(NULL, "journal part"), 2, NULL, "part/journals/NUMBER.jsonl", "journals");
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --journal none --out silent --progress none"), 0, NULL,
           NULL, "run");
    expect(vesica(NULL, "journal silent"), 2, NULL, "\"silent\" has no journal", "journal");
    expect(vesica(NULL, "run --resume part"), 2, NULL, "vesica bench --resume part", "run");
    root_remove();
}

Test(cli_bench_ends, errors_have_a_place)
{
    static const struct {
        const char *problem, *first, *second;
    } faults[] = {{"{file: ./none.yaml}", "./none.yaml\": No such file",
                   "s.yaml:4:5: note: it is a problem of this suite"},
                  {"{file: ./can.yaml, set: {nosuch: 1}}",
                   "set: nosuch:1:6: error: no variable or parameter \"nosuch\"", "s.yaml:4:5: note"},
                  {"{file: ./bad.yaml}", "bad.yaml:2:1: error: unknown key", "s.yaml:4:5: note"},
                  {"{plugin: ./bad.so}", "s.yaml:4:5: error: \"bad\" could not be evaluated in run 0 of auto",
                   "SINGULAR"}};
    root_make();
    cr_assert(system("cp " PROBLEMS "bottle.yaml can.yaml") == 0);
    write_file("bad.yaml", "vesica: 1\nnonsense: 3\n");
    write_file("bad.c",
               "#include <vesica/objective.h>\n"
               "static ves_status eval(void *s, const double *x, bool g, ves_verdict *v)\n"
               "{\n    (void)s, (void)g;\n    v->value = x[0];\n    return x[0] < 0.5 ? VES_SINGULAR : "
               "VES_OK;\n}\nstatic const double low[] = {0, 0}, high[] = {1, 1};\n"
               "static const ves_objective bad = {.name = \"bad\", .about = \"b\", .n = 2, .lower = low,\n"
               "    .upper = high, .optimum = NAN, .eval = eval};\n"
               "static const ves_objective *const list[] = {&bad, NULL};\n"
               "const ves_objectives ves_objectives_entry = {VES_OBJECTIVES, \"bad\", list};\n");
    cr_assert(
        system("cc -std=c17 -include math.h -shared -fPIC -I" VESICA_SOURCE "/include -o bad.so bad.c") == 0);
    for (size_t k = 0; k < sizeof faults / sizeof *faults; k++) {
        char text[400];
        snprintf(text, sizeof text,
                 "vesica: 1\nsuite: wrong\nproblems:\n  - %s\nmethods: {auto: {search: auto}}\n",
                 faults[k].problem);
        write_file("s.yaml", text);
        outcome o = vesica(NULL, "bench s.yaml --no-files --jobs 1");
        cr_expect(o.code >= 2 && o.code != 130, "%s: exit %d", faults[k].problem, o.code);
        cr_expect(strstr(o.err, faults[k].first) != NULL && strstr(o.err, faults[k].second) != NULL,
                  "%s:\n%s", faults[k].problem, o.err);
        done(&o);
    }
    write_file("s.yaml", "vesica: 1\nsuite: s\nproblems: [{function: sphere, n: 2}]\nseeds: 3\n"
                         "methods: {slow: {program: [sh, -c, \"chmod 500 b/journals; read a; exit 3\"]}}\n");
    if (geteuid()) /* who is root writes anywhere */
        expect(vesica(NULL, "bench s.yaml --out b"), 3, NULL, "b/journals/00000.jsonl\": Permission denied",
               "journal");
    root_remove();
}

/* NEWUOA ignores bounds; below its box the Schwefel function has lower values than its optimum. */
Test(cli_bench_ends, nobody_wins_outside_the_box)
{
    root_make();
    write_file("s.yaml", "vesica: 1\nsuite: box\nproblems: [{function: schwefel, n: 5}]\nseeds: 3\n"
                         "budget: {per_dimension: 500}\nmethods: {newuoa: {nlopt: LN_NEWUOA}}\n");
    expect(vesica(NULL, "bench s.yaml --out b"), 0, "no method met the last target", NULL, "box");
    char *text = slurp("b/runs.jsonl");
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        json j = json_of(line);
        const ves_node *x = ves_node_find(j.root, "x");
        cr_assert(x && x->kind == VES_NODE_LIST);
        for (int i = 0; i < x->count; i++) {
            double u = strtod(x->item[i]->text, NULL);
            cr_expect(u >= 0 && u <= 1, "%g", u);
        }
        json_done(&j);
    }
    free(text);
    root_remove();
}

/* The best can of area 3 pi: a method that uses up what the area is allowed sets no reference for one that does
 * not. Its goal is a maximum, and is told as one. */
Test(cli_bench_ends, the_reference_meets_its_constraints_exactly)
{
    const double truth = 3.14159265358979323846 / sqrt(2);
    char text[600];
    root_make();
    write_file("s.yaml",
               "vesica: 1\nsuite: can\nproblems: [{file: " PROBLEMS "bottle.yaml, name: can}]\nseeds: 2\n"
               "budget: {per_dimension: 300}\nmethods: {auto: {search: auto}, cobyla: {nlopt: "
               "LN_COBYLA}}\n");
    outcome o = vesica(NULL, "bench s.yaml --no-files --json");
    json j = json_of(o.out);
    const ves_node *problem = ves_node_find(j.root, "problems")->item[0];
    double best = strtod(ves_node_find(problem, "reference")->text, NULL);
    cr_expect(fabs(best - truth) < 1e-8, "got %.10g, want %.10g", best, truth);
    cr_expect(!strcmp(ves_node_find(problem, "polished")->text, "true"));
    const ves_node *hits = ves_node_find(ves_node_find(j.root, "methods")->item[0], "hits");
    cr_expect(!strcmp(hits->item[2]->text, "2"), "auto, right to seven digits, met it %s times",
              hits->item[2]->text);
    json_done(&j);
    done(&o);
    expect(vesica(NULL, "bench s.yaml --no-files"), 0, "best of all runs, polished: ", NULL, "screen");
    snprintf(text, sizeof text,
             "vesica: 1\nsuite: can\nproblems: [{file: " PROBLEMS "bottle.yaml, name: can, optimum: %.15g},"
             "{file: " PROBLEMS
             "bottle.yaml, name: low, optimum: 2}]\nseeds: 2\nbudget: {per_dimension: 300}\n"
             "methods: {auto: {search: auto}}\n",
             truth);
    write_file("s.yaml", text);
    o = vesica(NULL, "bench s.yaml --no-files");
    cr_expect(o.code == 0 && strstr(o.out, "2.22144") != NULL && strstr(o.out, "-2.22144") == NULL, "%s",
              o.out);
    cr_expect(strstr(o.out, "can: ") == NULL, "%s", o.out);
    cr_expect(strstr(o.out, "which is feasible, is better than the optimum that the suite gives, 2\n") !=
                  NULL,
              "%s", o.out);
    done(&o);
    root_remove();
}

/* Another seed, other instances; and five runs of two methods can show nothing. */
Test(cli_bench_ends, seeds_and_what_they_can_show)
{
    root_make();
    write_file("s.yaml", "vesica: 1\nsuite: seeds\nproblems: [{function: rastrigin, n: 2}]\nseeds: 5\n"
                         "budget: {per_dimension: 100}\nmethods: {nm: {nlopt: LN_NELDERMEAD}, sbplx: {nlopt: "
                         "LN_SBPLX}}\n");
    expect(vesica(NULL, "bench s.yaml --out one"), 0,
           "too few runs: whatever comes of them, p cannot fall below 0.062", NULL, "five");
    cr_expect(count_of("one/report.json", "\"verdict\": \"too few runs\"") > 0);
    cr_expect(count_of("one/report.json", "\"p_least\": 0.0625") > 0);
    expect(vesica(NULL, "bench s.yaml --set seed=1 --out again"), 0, NULL, NULL, "one");
    same_file("one/runs.jsonl", "again/runs.jsonl");
    /* the point where a descent ends is the instance's */
    write_file("t.yaml", "vesica: 1\nsuite: seeds\nproblems: [{function: sphere, n: 2}]\nseeds: 1\n"
                         "methods: {auto: {search: auto}}\n");
    expect(vesica(NULL, "bench t.yaml --out first"), 0, NULL, NULL, "first");
    expect(vesica(NULL, "bench t.yaml --set seed=2 --out second"), 0, NULL, NULL, "second");
    double x[2];
    for (int k = 0; k < 2; k++) {
        char *text = slurp(k ? "second/runs.jsonl" : "first/runs.jsonl");
        json j = json_of(text);
        x[k] = strtod(ves_node_find(j.root, "x")->item[0]->text, NULL);
        json_done(&j);
        free(text);
    }
    cr_expect(fabs(x[0] - x[1]) > 1e-2, "%g and %g: the same place", x[0], x[1]);
    root_remove();
}
