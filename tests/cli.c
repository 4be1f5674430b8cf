/* The command line, as a user meets it. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

/* --- the command line --- */

Test(cli, every_mistake_has_its_exit_code_and_a_hint)
{
    static const struct {
        const char *words;
        int code;
        const char *hint;
    } list[] = {
        {"rum x.yaml", 2, "did you mean \"run\"?"},
        {"nothing", 2, "vesica help"},
        {"--json run", 2, "a command comes first"},
        {"run", 2, "something is missing: vesica run FILE"},
        {"run nosuch.yaml", 2, "cannot open \"nosuch.yaml\""},
        {"run a.yaml b.yaml", 2, "what is \"b.yaml\" for?"},
        {"run a.yaml --sed 1", 2, "did you mean \"--set\"?"},
        {"run a.yaml --zzzzzz", 2, "vesica help run"},
        {"run a.yaml --seed", 2, "--seed needs a value"},
        {"run a.yaml --seed -1", 2, "whole number"},
        {"run a.yaml --jobs 0", 2, "1 to 256"},
        {"run a.yaml --evaluations 1e3", 2, "whole number"},
        {"run a.yaml --set radius", 2, "--set needs name=value"},
        {"run a.yaml --json=yes", 2, "takes no value"},
        {"run a.yaml --progress loud", 2, "auto, plain or none"},
        {"run a.yaml -q", 2, "two dashes"},
        {"eval a.yaml --seed 1", 2, "no option \"--seed\""},
        {"export a.yaml", 2, "--to FORMAT"},
        {"export a.yaml --to stk", 2, "did you mean \"stl\"?"},
        {"export a.yaml --to step", 2, "does not write step yet"},
        {"show a.yaml --view 3", 2, "azimuth,height"},
        {"show a.yaml --colour=", 2, "--colour needs a word"},
        {"show a.yaml --grid 4", 2, "48x96"},
        {"sample a.yaml", 2, "--points FILE or --spine N"},
        {"sample a.yaml --spine 1", 2, "2 to 1000000"},
        {"list", 2, "list what?"},
        {"list unit", 2, "did you mean \"units\"?"},
        {"help rnu", 2, "did you mean \"run\"?"},
        {"new cna", 2, "did you mean \"can\"?"},
        {"explain cirle", 2, "did you mean \"circle\"?"},
        {"sweep", 2, "sweep --resume DIR"},
        {"sweep a.yaml --over nu", 2, "NAME=FROM..TO:COUNT"},
        {"sweep a.yaml --over nu=1..2", 2, "NAME=FROM..TO:COUNT"},
        {"sweep a.yaml --over nu=1..2:1", 2, "NAME=FROM..TO:COUNT"},
        {"sweep --resume runs/a", 2, "there is no sweep to go on with in"},
        {"bench", 2, "needs a suite file"},
        {"bench a.yaml --add b={nlopt:GN_ESCH}", 2, "goes with --resume"},
        {"bench a.yaml --resume runs/a", 2, "the suite of its folder"},
        {"bench --resume .", 2, "not the folder of a benchmark"},
        {"bench --resume . --add b", 2, "--add needs NAME={...}"},
        {"serve", 2, "does not have"},
        {"report runs/a", 2, "does not have"},
        {"run --resume runs/a", 2, "there is no run to go on with in"},
        {"run --resume runs/a --seed 3", 2, "--seed cannot be given with it"},
        {"run a.yaml --resume runs/a", 2, "a.yaml cannot be given with it"},
        {"run", 2, "run --resume RUN"},
        {"run a.yaml --journal some", 2, "all or none"},
        {"journal", 2, "something is missing"},
        {"journal runs/a", 2, "cannot read \"runs/a/journal\""},
        {"journal runs/a --to vtp", 2, "csv or jsonl"},
        {"journal runs/a --png a.png --to csv", 2, "one of them"},
        {"run .", 2, "is a folder"},
        {"run a.yaml --plugin ./none.so", 2, "cannot load the plugin"},
    };
    root_make();
    for (size_t k = 0; k < sizeof list / sizeof *list; k++)
        expect(vesica(NULL, "%s", list[k].words), list[k].code, NULL, list[k].hint, list[k].words);
    root_remove();
}

Test(cli, help_and_lists_speak_of_everything)
{
    static const struct {
        const char *words, *has;
    } list[] = {
        {"help", "vesica help COMMAND"},
        {"--help", "usage:"},
        {"help run", "--evaluations"},
        {"run --help", "--evaluations"},
        {"version", "CGAL"},
        {"--version", "NLopt"},
        {"list measures", "bending"},
        {"list curves", "bspline"},
        {"list moves", "ridge"},
        {"list algorithms", "slsqp"},
        {"list formats", "vtp"},
        {"list units", "mm"},
        {"list templates", "tube"},
        {"new", "tube"},
        {"schema", "\"$schema\""},
        {"schema --reference", "circle"},
        {"explain circle", "radius"},
        {"explain slsqp", "slsqp"},
    };
    root_make();
    for (size_t k = 0; k < sizeof list / sizeof *list; k++)
        expect(vesica(NULL, "%s", list[k].words), 0, list[k].has, NULL, list[k].words);
    root_remove();
}

Test(cli, a_template_is_a_problem_that_runs)
{
    root_make();
    outcome names = vesica(NULL, "new");
    int count = 0;
    for (char *rest, *line = strtok_r(names.out, "\n", &rest); line;
         line = strtok_r(NULL, "\n", &rest), count++) {
        char name[64], path[80];
        cr_assert(sscanf(line, " %63s", name) == 1);
        snprintf(path, sizeof path, "%s.yaml", name);
        expect(vesica(NULL, "new %s", name), 0, path, NULL, name);
        expect(vesica(NULL, "new %s", name), 2, NULL, "nothing is overwritten", name);
        expect(vesica(NULL, "check %s", path), 0, ": ok", NULL, name);
        expect(vesica(NULL, "run %s --test --no-files", path), 0, NULL, NULL, name);
        char *text = slurp(path);
        expect(vesica(NULL, "new %s -", name), 0, text, NULL, name);
        free(text);
    }
    cr_assert(count >= 3, "%d templates", count);
    cr_assert(access("runs", F_OK) != 0, "--no-files made a folder");
    done(&names);
    root_remove();
}

/* --- run --- */

Test(cli, run_prints_one_object_and_keeps_a_folder)
{
    static const char *const contract[] = {"title",    "objective",   "feasible",    "violation", "variables",
                                           "measures", "constraints", "evaluations", "gradients", "stop",
                                           "seed",     "version",     "wall_s",      "cpu_s"};
    root_make();
    outcome o = vesica(NULL, "run " PROBLEMS "bottle.yaml --evaluations 3000 --seed 5 --json");
    cr_assert(eq(int, o.code, 0), "%s", o.err);
    json j = json_of(o.out);
    for (size_t k = 0; k < sizeof contract / sizeof *contract; k++)
        cr_assert(ves_node_find(j.root, contract[k]) != NULL, "no \"%s\"", contract[k]);
    cr_assert(fabs(number(&j, "objective", NULL) - 2.2214414690791831) < 5e-6, "V = pi / sqrt 2, got %.9g",
              number(&j, "objective", NULL)); /* area within 1e-6 of its size */
    cr_assert(number(&j, "seed", NULL) == 5);
    char *kept = slurp("runs/bottle-0001/result.json");
    json r = json_of(kept);
    cr_assert(number(&r, "objective", NULL) == number(&j, "objective", NULL));
    cr_assert(ves_node_find(r.root, "wall_s") == NULL, "clock data in result.json");
    static const char *const files[] = {"problem.yaml", "times.json", "trace.jsonl", "log.txt",
                                        "best.vtp",     "start.vtp",  "best.png"};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        char path[100];
        snprintf(path, sizeof path, "runs/bottle-0001/%s", files[k]);
        cr_assert(access(path, F_OK) == 0, "%s is missing", path);
    }
    json_done(&j);
    json_done(&r);
    free(kept);
    done(&o);
    root_remove();
}

Test(cli, runs_are_numbered_and_FILE_alone_is_run)
{
    root_make();
    expect(vesica(NULL, PROBLEMS "bottle.yaml --evaluations 1500"), 0, "runs/bottle-0001/", "bottle", "FILE");
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --evaluations 1500 --jobs 1"), 0, "runs/bottle-0002/",
           NULL, "run");
    char *a = slurp("runs/bottle-0001/result.json"), *b = slurp("runs/bottle-0002/result.json");
    cr_assert(eq(str, a, b), "all threads and one thread differ");
    free(a);
    free(b);
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --out runs/bottle-0001"), 2, NULL, "not empty", "--out");
    root_remove();
}

Test(cli, an_infeasible_or_unexpected_end_is_exit_1)
{
    root_make();
    expect(vesica(NULL,
                  "run " PROBLEMS "bottle.yaml --no-files --evaluations 800 --set constraints=[area==100]"),
           1, "no design met all constraints", NULL, "out of reach");
    char *text = slurp(PROBLEMS "bottle.yaml"), *at = strstr(text, "expect:");
    cr_assert(at != NULL);
    *at = 0;
    write_file("greedy.yaml", text);
    FILE *out = fopen("greedy.yaml", "a");
    fputs("expect: [volume > 3]\n", out);
    fclose(out);
    free(text);
    expect(vesica(NULL, "run greedy.yaml --no-files --evaluations 800"), 1, "FAILED  volume > 3", NULL,
           "expect");
    root_remove();
}

Test(cli, an_interrupt_keeps_everything_and_exits_130)
{
    static const int signals[] = {SIGINT, SIGTERM};
    root_make();
    for (int k = 0; k < 2; k++) {
        char words[300], path[100];
        snprintf(words, sizeof words,
                 "run " PROBLEMS "curvature.yaml --evaluations 900000000 --jobs %d --json --out stop%d",
                 k + 1, k);
        snprintf(path, sizeof path, "stop%d/trace.jsonl", k);
        pid_t child = launch(words, NULL, "stdout");
        wait_for_file(path);
        kill(child, signals[k]);
        cr_assert(eq(int, wait_for(child), 130));
        char *out = slurp("stdout");
        json j = json_of(out);
        cr_assert(number(&j, "objective", NULL) > 12, "the best so far");
        snprintf(path, sizeof path, "stop%d/best.vtp", k);
        cr_assert(access(path, F_OK) == 0);
        json_done(&j);
        free(out);
    }
    root_remove();
}

Test(cli, a_full_disk_under_stdout_is_no_success)
{
    root_make();
    cr_assert(eq(int, wait_for(launch("list measures", NULL, "/dev/full")), 3));
    char *err = slurp("stderr");
    cr_assert(strstr(err, "cannot write to standard output") != NULL, "%s", err);
    free(err);
    root_remove();
}

/* --- one design --- */

Test(cli, eval_answers_at_the_start_and_where_it_is_set)
{
    static const char *const contract[] = {"variables", "measures", "objective", "violation"};
    root_make();
    outcome o = vesica(NULL, "eval " PROBLEMS "bottle.yaml --set r=0.7 --set h=1.3 --json");
    json j = json_of(o.out);
    for (int k = 0; k < 4; k++)
        cr_assert(ves_node_find(j.root, contract[k]) != NULL, "no \"%s\"", contract[k]);
    double V = 3.14159265358979324 * 0.49 * 1.3;
    /* rounding of a sum over all nodes */
    cr_assert(fabs(number(&j, "objective", NULL) - V) < 1e-12 * V, "got %.17g, want %.17g",
              number(&j, "objective", NULL), V);
    cr_assert(number(&j, "variables", "r") == 0.7);
    cr_assert(eq(int, o.code, 1), "the area is not 3 pi");
    json_done(&j);
    done(&o);
    root_remove();
}

Test(cli, a_run_is_a_design_for_every_command)
{
    root_make();
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --evaluations 3000 --out best"), 0, NULL, NULL, "run");
    char *kept = slurp("best/result.json");
    json r = json_of(kept);
    outcome o = vesica(NULL, "eval best --json");
    json j = json_of(o.out);
    cr_assert(number(&j, "objective", NULL) == number(&r, "objective", NULL), "eval of a run is its best");
    expect(vesica(NULL, "export best --to vtp,stl --out files --grid 12x24"), 0, "files/best.stl", NULL,
           "export");
    expect(vesica(NULL, "export best --to stl --out files"), 0, "files/best-2.stl", NULL, "export again");
    expect(vesica(NULL, "show best --view 40,10 --colour H"), 0, "best.png", NULL, "show");
    expect(vesica(NULL, "show best --colour red"), 2, NULL, "known: patch, H, K, k1, k2", "no such colour");
    expect(vesica(NULL, "sample best --patch wall --spine 5"), 0, "u,x,y,z", NULL, "spine");
    cr_assert(eq(int, o.code, 0), "eval of a feasible run");
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --start best --no-files --evaluations 300"), 0, NULL,
           NULL, "--start");
    expect(vesica(NULL, "run " PROBLEMS "curvature.yaml --start best --no-files"), 2, NULL,
           "has none of the variables of the problem", "--start of another");
    json_done(&j);
    json_done(&r);
    free(kept);
    done(&o);
    root_remove();
}

/* --- sample --- */

/* One row of numbers. */
static int row_read(char **text, double *value, int most)
{
    int count = 0;
    for (char *end; count < most; *text = end + 1) {
        value[count++] = strtod(*text, &end);
        if (*end != ',') {
            *text = *end == '\n' ? end + 1 : end;
            break;
        }
    }
    return count;
}

/* The wall of the bottle: X = (r cos v, r sin v, h u), with the rounding of a few operations on numbers
 * below 2. */
Test(cli, sample_gives_the_surface_exactly)
{
    root_make();
    write_file("uv.csv", "u,v\n0,0\n0.25,1.1\r\n\n 1 , 6.2\n0.5,-3\n");
    outcome o =
        vesica("uv.csv", "sample " PROBLEMS "bottle.yaml --patch wall --points - --set r=0.61 --set h=1.7");
    cr_assert(eq(int, o.code, 0), "%s", o.err);
    char *at = strchr(o.out, '\n') + 1;
    double x[40], r = 0.61, h = 1.7;
    for (int k = 0; k < 4; k++) {
        cr_assert(eq(int, row_read(&at, x, 40), 20));
        double u = x[0], c = cos(x[1]), s = sin(x[1]);
        double want[18] = {r * c, r * s, h * u, 0, 0, h, -r * s, r * c,  0,
                           0,     0,     0,     0, 0, 0, -r * c, -r * s, 0};
        for (int f = 0; f < 18; f++)
            cr_assert(fabs(x[2 + f] - want[f]) < 1e-14, "row %d, column %d: got %.17g, want %.17g", k, f + 3,
                      x[2 + f], want[f]);
    }
    cr_assert(eq(int, *at, 0), "more rows than points: %s", at);
    done(&o);
    write_file("bad.csv", "0,0\n0.5\n");
    expect(vesica(NULL, "sample " PROBLEMS "bottle.yaml --patch wall --points bad.csv"), 2, NULL,
           "bad.csv:2: two numbers", "bad row");
    write_file("far.csv", "0,0\n1.5,0\n");
    expect(vesica(NULL, "sample " PROBLEMS "bottle.yaml --patch wall --points far.csv"), 2, NULL,
           "far.csv:2: u = 1.5", "outside");
    expect(vesica(NULL, "sample " PROBLEMS "bottle.yaml --patch wal --points far.csv"), 2, NULL,
           "did you mean \"wall\"?", "patch");
    expect(vesica(NULL, "sample " PROBLEMS "bottle.yaml --points far.csv"), 2, NULL, "--patch NAME is needed",
           "no patch");
    root_remove();
}
