/* vesica bench, as a user meets it. */
#include <criterion/criterion.h>
#include <dirent.h>

#include "program.h"

static const char suite[] =
    "vesica: 1\nsuite: a small one\nproblems:\n  - {function: rastrigin, n: 4, rotate: true}\n  - {function: "
    "g13}\n"
    "  - {function: sphere, n: 3}\nseeds: 3\nbudget: {per_dimension: 300}\nmethods:\n  auto: {search: auto}\n"
    "  anneal: {search: [{anneal: {chains: 2}}], doubling: true, gradients: false}\n  isres: {nlopt: "
    "GN_ISRES}\n"
    "  crs2: {nlopt: GN_CRS2_LM}\n  mlsl: {nlopt: G_MLSL_LDS, local: LD_LBFGS}\n"
    "  auglag: {nlopt: AUGLAG, local: LD_LBFGS}\n";

/* One limit for all: Criterion forgets a timer of its own where tests that run side by side have different ones. */
TestSuite(cli_bench, .timeout = 600);

Test(cli_bench, the_same_bytes_for_any_number_of_jobs)
{
    root_make();
    write_file("s.yaml", suite);
    expect(vesica(NULL, "bench s.yaml --jobs 1 --out one"), 0, "rot_rastrigin 4", "3 problems, 6 methods",
           "one");
    expect(vesica(NULL, "bench s.yaml --jobs 3 --out three"), 0, "sphere 3", NULL, "three");
    same_file("one/runs.jsonl", "three/runs.jsonl");
    same_file("one/report.json", "three/report.json");
    for (int k = 0; k < 54; k++) {
        char a[64], b[64];
        snprintf(a, sizeof a, "one/journals/%05d.jsonl", k);
        snprintf(b, sizeof b, "three/journals/%05d.jsonl", k);
        same_file(a, b);
    }
    cr_expect(count_of("one/runs.jsonl", "\n") == 54);
    cr_expect(count_of("one/runs.jsonl",
                       "\"end\":\"failed\",\"reason\":\"NLopt's GN_CRS2_LM does not take equations\"") == 3);
    cr_expect(count_of("one/times.jsonl", "wall_s") == 54);
    root_remove();
}

/* Cut anywhere, in the middle of a line too, and gone on with; then with one method more. */
Test(cli_bench, goes_on_where_it_was_broken_off)
{
    root_make();
    write_file("s.yaml", suite);
    expect(vesica(NULL, "bench s.yaml --out whole"), 0, NULL, NULL, "whole");
    for (int part = 1; part < 6; part++) {
        char *text = slurp("whole/runs.jsonl");
        cr_assert(system("rm -rf part && cp -r whole part") == 0);
        text[strlen(text) * (size_t)part / 6] = 0;
        write_file("part/runs.jsonl", text);
        free(text);
        expect(vesica(NULL, "bench --resume part --jobs 2"), 0, NULL, "runs are there already", "resumed");
        same_file("whole/runs.jsonl", "part/runs.jsonl");
        same_file("whole/report.json", "part/report.json");
    }
    expect(vesica(NULL, "bench --resume part --add nm={nlopt:LN_NELDERMEAD}"), 2, NULL, "nlopt:LN_NELDERMEAD",
           "no blank");
    same_file("whole/bench.json", "part/bench.json");
    expect(vesica(NULL, "bench --resume part --add nm={\"nlopt\":LN_NELDERMEAD}"), 0, "nm", NULL, "added");
    cr_expect(count_of("part/runs.jsonl", "\n") == 63 && count_of("part/bench.json", "nm") == 1);
    expect(vesica(NULL, "bench --resume part --add nm={\"nlopt\":LN_COBYLA}"), 2, NULL, "already", "again");
    expect(vesica(NULL, "bench --resume part"), 0, "nm", "63 of 63", "nothing left");
    root_remove();
}

Test(cli_bench, one_process_at_a_time)
{
    root_make();
    write_file("s.yaml", "vesica: 1\nsuite: slow\nproblems: [{function: sphere, n: 2}]\nseeds: 2\n"
                         "methods: {sleeps: {program: [sleep, \"60\"], seconds: 60}}\n");
    pid_t child = launch("bench s.yaml --out busy", NULL, "stdout.busy");
    wait_for_file("busy/suite.yaml");
    expect(vesica(NULL, "bench --resume busy"), 2, NULL, "process", "taken");
    kill(child, SIGINT);
    cr_expect(wait_for(child) == 130);
    child = launch("bench --resume busy", NULL, "stdout.busy");
    nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
    kill(child, SIGTERM);
    cr_expect(wait_for(child) == 130, "free again, and stopped");
    root_remove();
}

/* Killed at any moment. */
Test(cli_bench, survives_kills)
{
    root_make();
    write_file("s.yaml", suite);
    expect(vesica(NULL, "bench s.yaml --out whole"), 0, NULL, NULL, "whole");
    pid_t child = launch("bench s.yaml --out killed --jobs 2", NULL, "stdout");
    wait_for_file("killed/runs.jsonl");
    for (int k = 0; k < 5; k++) {
        nanosleep(&(struct timespec){.tv_nsec = 15000000 * (k + 1)}, NULL);
        kill(child, SIGKILL);
        wait_for(child);
        child = launch("bench --resume killed --jobs 2", NULL, "stdout");
    }
    cr_expect(wait_for(child) == 0);
    same_file("whole/runs.jsonl", "killed/runs.jsonl");
    root_remove();
}

Test(cli_bench, shapes_are_measured_against_the_best_of_all)
{
    root_make();
    write_file("s.yaml",
               "vesica: 1\nsuite: shapes\nproblems: [{file: " PROBLEMS "bottle.yaml, name: can}]\nseeds: 2\n"
               "budget: {per_dimension: 100}\nmethods: {auto: {search: auto}, cobyla: {nlopt: LN_COBYLA}}\n");
    expect(vesica(NULL, "bench s.yaml --out b"), 0, "can", NULL, "shapes");
    cr_expect(count_of("b/runs.jsonl", "\"end\":\"budget\"") == 4);
    expect(vesica(NULL, "bench --resume b"), 0, "distinct ends of can", "4 of 4 runs", "again");
    expect(vesica(NULL, "bench --resume b"), 0, "best of all runs, polished: ", NULL, "again");
    outcome o = vesica(NULL, "bench --resume b --json");
    json j = json_of(o.out);
    cr_expect(number(&j, "done", NULL) == 4 && number(&j, "runs", NULL) == 4);
    /* the volume of the best can of area 3 pi */
    const ves_node *problem = ves_node_find(j.root, "problems")->item[0];
    double best = strtod(ves_node_find(problem, "reference")->text, NULL);
    cr_expect(fabs(best - 3.14159265358979 / sqrt(2)) < 1e-8, "got %.9g", best);
    json_done(&j);
    done(&o);
    root_remove();
}

/* It writes and never reads: after some thousand answers the socket is full. */
#define DEAF                                                                                                 \
    "import sys\nwhile True:\n    sys.stdout.write('{\"ask\": [0.5, 0.5]}\\n' * 100)\n    "                  \
    "sys.stdout.flush()\n"

static int failed_with(const char *path, const char *method, const char *reason)
{
    char *text = slurp(path), head[64];
    int count = 0;
    snprintf(head, sizeof head, "\"method\":\"%s\"", method);
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"))
        count += strstr(line, head) && strstr(line, reason);
    free(text);
    return count;
}

/* What programs may do wrong is recorded, and the others go on. */
Test(cli_bench, programs_take_part_and_what_they_do_wrong_is_recorded)
{
    static const char *const faults[][2] = {{"none", "cannot start"},
                                            {"talks", "said what is no request: hello"},
                                            {"silent", "exit code 3"},
                                            {"killed", "ended by signal 9"},
                                            {"hangs", "said nothing for 0.3 s"},
                                            {"gives_up", "ends without asking"},
                                            {"outside", "beyond the unit box"},
                                            {"three", "another number of variables"},
                                            {"slopes", "asked for gradients"}};
    root_make();
    cr_assert(system("cp " VESICA_SOURCE "/bench/suites/random.py .") == 0);
    write_file("s.yaml",
               "vesica: 1\nsuite: programs\nproblems: [{function: sphere, n: 2}]\nseeds: 2\n"
               "budget: {per_dimension: 100}\nmethods:\n"
               "  random: {program: [python3, ./random.py]}\n"
               "  none: {program: nonesuch}\n"
               "  talks: {program: [sh, -c, \"read a; echo hello; exit 3\"]}\n"
               "  silent: {program: [sh, -c, \"read a; exit 3\"]}\n"
               "  killed: {program: [sh, -c, \"kill -9 $$\"]}\n"
               "  hangs: {program: [sleep, \"60\"], seconds: 0.3}\n"
               "  gives_up: {program: [sh, -c, \"read a; echo '{\\\"done\\\": true}'\"]}\n"
               "  outside: {program: [sh, -c, \"read a; echo '{\\\"ask\\\": [0.5, 1.5]}'; read b\"]}\n"
               "  three: {program: [sh, -c, \"read a; echo '{\\\"ask\\\": [0, 0.5, 1]}'; read b\"]}\n"
               "  slopes: {gradients: false, program: [sh, -c, \"read a; echo '{\\\"ask\\\": [0, 1], "
               "\\\"gradient\\\": true}'; read b\"]}\n"
               "  once: {program: [sh, -c, \"read a; echo '{\\\"ask\\\": [0.5, 0.5]}'; read b; "
               "echo '{\\\"done\\\": true}'\"]}\n");
    expect(vesica(NULL, "bench s.yaml --out one --jobs 1"), 0, "random", NULL, "programs");
    expect(vesica(NULL, "bench s.yaml --out two --jobs 2"), 0, "random", NULL, "programs");
    same_file("one/runs.jsonl", "two/runs.jsonl");
    for (size_t k = 0; k < sizeof faults / sizeof *faults; k++)
        cr_expect(failed_with("one/runs.jsonl", faults[k][0], faults[k][1]) == 2, "%s: no \"%s\"",
                  faults[k][0], faults[k][1]);
    cr_expect(failed_with("one/runs.jsonl", "random", "\"end\":\"budget\",\"reason\":null") == 2);
    cr_expect(failed_with("one/runs.jsonl", "random", "\"spent\":200,\"evaluations\":200") == 2);
    cr_expect(failed_with("one/runs.jsonl", "once", "\"spent\":200,\"evaluations\":200") == 2,
              "started again");
    root_remove();
}

static bool alive(const char *word)
{
    char command[200];
    snprintf(command, sizeof command, "pgrep -f '%s' >/dev/null", word);
    return system(command) == 0;
}

/* Neither a program that does not read nor one that hangs holds up a signal, and what is killed takes it along. */
Test(cli_bench, ends_with_a_program_that_does_not_listen)
{
    root_make();
    write_file("deaf.py", DEAF);
    write_file("d.yaml", "vesica: 1\nsuite: deaf\nproblems: [{function: sphere, n: 2}]\nseeds: 1\n"
                         "budget: {per_dimension: 1e9, most: 1e9}\n"
                         "methods: {deaf: {program: [python3, ./deaf.py], seconds: 4}}\n");
    expect(vesica(NULL, "bench d.yaml --out deaf"), 0, NULL, NULL, "deaf");
    cr_expect(failed_with("deaf/runs.jsonl", "deaf", "the program read nothing for 4 s") == 1);
    write_file("s.yaml", "vesica: 1\nsuite: deaf\nproblems: [{function: sphere, n: 2}]\nseeds: 1\n"
                         "budget: {per_dimension: 1e9, most: 1e9}\n"
                         "methods: {deaf: {program: [python3, ./deaf.py]}}\n");
    pid_t child = launch("bench s.yaml --out busy", NULL, "stdout.busy");
    wait_for_file("busy/suite.yaml");
    nanosleep(&(struct timespec){.tv_sec = 2}, NULL);
    kill(child, SIGTERM);
    cr_expect(wait_for(child) == 130);
    write_file("s.yaml", "vesica: 1\nsuite: hangs\nproblems: [{function: sphere, n: 2}]\nseeds: 1\n"
                         "methods: {hangs: {program: [sleep, \"61.25\"]}}\n");
    child = launch("bench s.yaml --out killed", NULL, "stdout.busy");
    for (int k = 0; k < 500 && !alive("sleep 61.2[5]"); k++)
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    cr_expect(alive("sleep 61.2[5]"));
    kill(child, SIGKILL);
    wait_for(child);
    for (int k = 0; k < 500 && alive("sleep 61.2[5]"); k++)
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    cr_expect(!alive("sleep 61.2[5]"), "a program outlives the bench");
    root_remove();
}

/* Every suite that is shipped, as far as a few evaluations go; and one in which ends are drawn together by symmetry. */
Test(cli_bench, every_suite_that_is_shipped_runs)
{
    int count = 0;
    root_make();
    DIR *folder = opendir(VESICA_SOURCE "/bench/suites");
    cr_assert(folder != NULL);
    for (struct dirent *file; (file = readdir(folder));) {
        if (!strstr(file->d_name, ".yaml")) continue;
        expect(vesica(NULL,
                      "bench " VESICA_SOURCE
                      "/bench/suites/%s --set seeds=1 --set budget.most=200 --no-files",
                      file->d_name),
               0, "Within ", NULL, file->d_name);
        count++;
    }
    closedir(folder);
    cr_expect(count >= 4, "%d suites", count);
    write_file("s.yaml",
               "vesica: 1\nsuite: pot\nproblems: [{file: " VESICA_SOURCE "/problems/pot.yaml}]\nseeds: 2\n"
               "budget: {per_dimension: 50}\nmethods: {auto: {search: auto}}\n");
    expect(vesica(NULL, "bench s.yaml --no-files"), 0, "; auto 2 times\n", NULL, "pot");
    root_remove();
}

/* The tower: where both constraints hold as equations or the stress alone does, found here by a grid in 1e6 nodes. */
static double lightest(void)
{
    const double pi = 3.14159265358979323846;
    double best = INFINITY;
    for (int k = 0; k <= 1000000; k++) {
        double h = 5 + 45e-6 * k, L = sqrt(h * h + 900), low = 0.5, high = 5;
        for (int step = 0; step < 60; step++) { /* the thinnest tube that stands; both get easier with d */
            double d = (low + high) / 2, stress = 30000 * L / (0.2 * h * pi * d);
            bool stands = stress <= 100000 && stress <= pi * pi * 30e6 * (d * d + 0.01) / (8 * L * L);
            *(stands ? &high : &low) = d;
        }
        if (high < 5) best = fmin(best, 0.06 * pi * high * L);
    }
    return best;
}

Test(cli_bench, an_objective_of_a_plugin)
{
    root_make();
    cr_assert(system("cc -std=c17 -shared -fPIC -I" VESICA_SOURCE "/include -o tower.so " VESICA_SOURCE
                     "/examples/objective/tower.c -lm && cp " VESICA_SOURCE
                     "/examples/objective/tower.yaml .") == 0);
    expect(vesica(NULL, "bench tower.yaml --out one --jobs 1"), 0, "distinct ends of tower", NULL, "plugin");
    expect(vesica(NULL, "bench tower.yaml --out two --jobs 2"), 0, "best of all runs", NULL, "plugin");
    same_file("one/runs.jsonl", "two/runs.jsonl");
    outcome o = vesica(NULL, "bench --resume one --json");
    json j = json_of(o.out);
    double got = strtod(ves_node_find(ves_node_find(j.root, "problems")->item[0], "reference")->text, NULL);
    double want = lightest(); /* constraints are met within 1e-6 */
    cr_expect(fabs(got - want) < 3e-6 * want, "got %.9g, want %.9g", got, want);
    json_done(&j);
    done(&o);
    static const struct {
        const char *problem, *hint;
    } faults[] = {{"{plugin: ./none.so}", "cannot load the plugin"},
                  {"{plugin: ./empty.so}", "no ves_objectives_entry"},
                  {"{plugin: ./tower.so, objective: towel}", "brings no objective \"towel\""},
                  {"{plugin: ./old.so}", "interface 99 of objectives"},
                  {"{plugin: ./odd.so}", "is not whole"}};
    write_file("old.c", "const struct { int abi; long size; } ves_objectives_entry = {99, 8};\n");
    write_file("odd.c",
               "#include <vesica/objective.h>\nstatic const ves_objective odd = {.name = \"odd\", .n = 2};\n"
               "static const ves_objective *const list[] = {&odd, NULL};\n"
               "const ves_objectives ves_objectives_entry = {VES_OBJECTIVES, \"odd\", list};\n");
    cr_assert(system("cc -shared -fPIC -o old.so old.c && cc -shared -fPIC -x c -o empty.so /dev/null && "
                     "cc -shared -fPIC -I" VESICA_SOURCE "/include -o odd.so odd.c") == 0);
    for (size_t k = 0; k < sizeof faults / sizeof *faults; k++) {
        char text[400];
        snprintf(text, sizeof text,
                 "vesica: 1\nsuite: wrong\nproblems: [%s]\nmethods: {auto: {search: auto}}\n",
                 faults[k].problem);
        write_file("w.yaml", text);
        expect(vesica(NULL, "bench w.yaml --no-files"), 2, NULL, faults[k].hint, faults[k].problem);
    }
    root_remove();
}
