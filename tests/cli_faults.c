/* What can go wrong around the program: files, folders, disks, signals. Every time one sentence, and no work
 * lost. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

static const char tilted[] =
    "vesica: 1\n"
    "variables: {r: [20 mm, 31.7 mm, 80 mm], tilt: [-20 deg, 3 deg, 20 deg]}\n"
    "parameters: {lean: 2 deg, H: 0.1 m}\n"
    "curves:\n"
    "  low: {circle: {radius: r}}\n"
    "  high: {circle: {radius: 0.05 m}, apply: [{rotate: [tilt + lean, 0, 0]}, {translate: [0 m, 0 m, H]}]}\n"
    "patches: {wall: {operator: {power: 1, a: 1}, conditions: [{u: 0, position: low}, {u: 1, position: "
    "high}]}}\n"
    "minimize: area\n";

/* A tube through itself: the search refuses it, and so do the checks of a design that is measured once. */
static const char crossed[] =
    "vesica: 1\n"
    "curves:\n"
    "  low: {circle: {radius: 1}}\n"
    "  high: {circle: {radius: 1}, apply: [{translate: [3, 0, 0]}]}\n"
    "  up: {formula: [\"0\", \"0\", \"9\"]}\n"
    "  across: {formula: [\"-12\", \"0\", \"-9\"]}\n"
    "patches:\n"
    "  wall:\n"
    "    operator: {power: 2, a: 0}\n"
    "    conditions: [{u: 0, position: low}, {u: 1, position: high},\n"
    "                 {u: 0, derivative: 1, field: up}, {u: 1, derivative: 1, field: across}]\n"
    "validity: {jacobian: any}\n"
    "expect: [area > 0]\n";

Test(cli_faults, a_folder_that_cannot_be_made_stops_before_the_search)
{
    static const char *const folder[] = {"tilted.yaml", "tilted.yaml/below", "/proc/none"};
    static const int code[] = {2, 3, 3};
    root_make();
    write_file("tilted.yaml", tilted);
    for (int k = 0; k < 3; k++) {
        outcome o = vesica(NULL, "run tilted.yaml --out %s", folder[k]);
        cr_assert(eq(str, o.out, ""), "%s: something was searched:\n%s", folder[k], o.out);
        expect(o, code[k], NULL, folder[k], folder[k]);
        expect(vesica(NULL, "export tilted.yaml --to stl --out %s", folder[k]), 3, NULL, folder[k],
               folder[k]);
    }
    root_remove();
}

Test(cli_faults, a_start_that_cannot_be_measured_is_not_ok)
{
    root_make();
    write_file("tilted.yaml", tilted);
    outcome o = vesica(NULL, "check tilted.yaml --set lean=172deg");
    cr_assert(strstr(o.out, ": ok") == NULL, "%s", o.out);
    expect(o, 1, "its start design cannot be measured: the surface folds back on itself", NULL, "check");
    expect(vesica(NULL, "check tilted.yaml"), 0, "tilted.yaml: ok", NULL, "check");
    root_remove();
}

Test(cli_faults, what_failed_a_check_stands_in_the_result)
{
    root_make();
    write_file("crossed.yaml", crossed);
    outcome o = vesica(NULL, "check crossed.yaml");
    cr_assert(strstr(o.out, ": ok") == NULL, "%s", o.out);
    expect(o, 1, "does not pass the checks: the surface crosses itself", "crosses itself", "check");
    o = vesica(NULL, "run crossed.yaml --json");
    json j = json_of(o.out);
    const ves_node *notes = ves_node_find(j.root, "notes");
    cr_assert(notes && notes->count == 1 && strstr(notes->item[0]->text, "the surface crosses itself"), "%s",
              o.out);
    json_done(&j);
    expect(o, 1, NULL, "crosses itself", "run");
    char *log = slurp("runs/crossed-0001/log.txt"), *once = strstr(log, "the surface crosses itself");
    cr_assert(once && !strstr(once + 1, "the surface crosses itself"), "said once: %s", log);
    free(log);
    write_file("balls.yaml",
               "vesica: 1\nvariables: {d: [0.5, 1.5, 4]}\npatches:\n"
               "  o: {surface: {formula: [\"sin(pi*u)*cos(v)\", \"sin(pi*u)*sin(v)\", \"-cos(pi*u)\"]}}\n"
               "  i: {surface: {formula: [\"0.9*sin(pi*u)*cos(v) + d\", \"0.9*sin(pi*u)*sin(v)\", "
               "\"-0.9*cos(pi*u)\"]}}\nshape: {closed: true}\nminimize: (width - 4.2)^2\n"
               "constraints: [volume >= 6]\n");
    expect(vesica(NULL, "run balls.yaml"), 0,
           "notes      the start design did not pass its checks: the surface crosses itself", NULL, "run");
    root_remove();
}

Test(cli_faults, a_format_named_twice_is_written_once)
{
    root_make();
    write_file("tilted.yaml", tilted);
    outcome o = vesica(NULL, "export tilted.yaml --to vtp,stl,vtp --grid 4x8");
    cr_assert(eq(str, o.out, "tilted.vtp\ntilted.stl\n"));
    expect(o, 0, NULL, NULL, "twice");
    expect(vesica(NULL, "export tilted.yaml --to vtp,"), 2, NULL, "a format is missing in --to \"vtp,\"",
           "comma");
    root_remove();
}

Test(cli_faults, one_is_singular)
{
    root_make();
    write_file("tilted.yaml", tilted);
    outcome o = vesica(NULL, "run tilted.yaml --evaluations 1 --jobs 1");
    cr_assert(strstr(o.out, " 1 evaluation, no gradients") != NULL, "%s", o.out);
    cr_assert(strstr(o.out, "1 evaluations") == NULL, "%s", o.out);
    done(&o);
    char *log = slurp("runs/tilted-0001/log.txt");
    cr_assert(strstr(log, ", 1 job, ") && strstr(log, ", 1 evaluation\n"), "%s", log);
    free(log);
    root_remove();
}

Test(cli_faults, a_run_folder_that_is_not_whole_says_what_is_wrong)
{
    static const struct {
        const char *make, *says;
    } list[] = {
        {"head -c 300 whole/result.json > best/result.json", "\"best/result.json\" is damaged or not whole"},
        {": > best/result.json", "\"best/result.json\" is damaged or not whole"},
        {"head -c 300 /bin/sh > best/result.json", "\"best/result.json\" is damaged or not whole"},
        {"echo '{}' > best/result.json", "\"best/result.json\" holds no variables"},
        {"rm best/result.json", "\"best/result.json\" cannot be read: No such file"},
        {"mkdir best/result.json", "\"best/result.json\" cannot be read: "},
        {"rm -r best/result.json best/problem.yaml; cp whole/result.json best",
         "cannot open \"best/problem.yaml\""},
    };
    root_make();
    write_file("tilted.yaml", tilted);
    expect(vesica(NULL, "run tilted.yaml --evaluations 300 --out best"), 0, NULL, NULL, "run");
    cr_assert(system("cp -r best whole") == 0);
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        cr_assert(system(list[k].make) == 0, "%s", list[k].make);
        expect(vesica(NULL, "eval best"), 2, NULL, list[k].says, list[k].make);
        expect(vesica(NULL, "export best --to stl"), 2, NULL, list[k].says, list[k].make);
    }
    root_remove();
}

Test(cli_faults, files_that_are_none)
{
    static const struct {
        const char *words, *says;
        int code;
    } list[] = {
        {"check empty", "the file is empty; a problem begins with vesica: 1", 2},
        {"check folder", "is not the folder of a finished run", 2},
        {"run folder", "is a folder: vesica run needs a problem file", 2},
        {"check noise", "has no place in a text (UTF-8)", 2},
        {"check none.yaml", "cannot open \"none.yaml\": No such file", 2},
        {"run tilted.yaml --start empty", "is not the folder of a finished run", 2},
        {"sample tilted.yaml --points folder", "cannot read \"folder\": Is a directory", 2},
        {"sample tilted.yaml --points empty", "has no points", 2},
        {"show tilted.yaml --png folder.png", "cannot write \"folder.png\": Is a directory", 3},
        {"show tilted.yaml --png none/a.png", "cannot write \"none/a.png\": No such file", 3},
        {"new can folder", "nothing is overwritten", 2},
        {"new can none/can.yaml", "cannot write \"none/can.yaml\": No such file", 3},
        {"list units --plugin folder", "cannot load the plugin \"folder\"", 2},
    };
    root_make();
    write_file("tilted.yaml", tilted);
    write_file("empty", "");
    write_file("noise", "\x1b[31m\xfe\xfe\x01");
    mkdir("folder", 0777);
    mkdir("folder.png", 0777);
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        outcome o = vesica(NULL, "%s", list[k].words);
        cr_assert(strchr(o.err, '\x1b') == NULL, "%s: a control character on the screen", list[k].words);
        expect(o, list[k].code, NULL, list[k].says, list[k].words);
    }
    root_remove();
}

/* No half files, and none hidden. */
Test(cli_faults, an_interrupted_export_leaves_whole_files)
{
    root_make();
    write_file("tilted.yaml", tilted);
    pid_t child =
        launch("export tilted.yaml --to csv,vtp,stl,obj,ply,off --grid 160x160 --out files", NULL, "stdout");
    wait_for_file("files/tilted.csv");
    kill(child, SIGINT);
    cr_assert(eq(int, wait_for(child), 130));
    char *err = slurp("stderr");
    cr_assert(strstr(err, "interrupted: ") && strstr(err, " of 6 files are not written"), "%s", err);
    free(err);
    cr_assert(system("test -z \"$(ls -A files | grep '^\\.')\" && test ! -e files/tilted.off") == 0);
    root_remove();
}

Test(cli_faults, a_full_disk_is_no_success_for_any_command)
{
    static const char *const words[] = {"check tilted.yaml",
                                        "eval tilted.yaml --json",
                                        "sample tilted.yaml --spine 500",
                                        "schema",
                                        "help",
                                        "explain circle",
                                        "run tilted.yaml --no-files --evaluations 99"};
    root_make();
    write_file("tilted.yaml", tilted);
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
        int code = wait_for(launch(words[k], NULL, "/dev/full"));
        char *err = slurp("stderr");
        cr_assert(code == 3 && strstr(err, "cannot write to standard output"), "%s: %d, %s", words[k], code,
                  err);
        free(err);
    }
    root_remove();
}
