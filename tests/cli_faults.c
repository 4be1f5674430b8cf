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
    expect(o, 0, "does not pass the checks: the surface crosses itself", "crosses itself", "check");
    o = vesica(NULL, "run crossed.yaml --json");
    json j = json_of(o.out);
    const ves_node *notes = ves_node_find(j.root, "notes");
    cr_assert(notes && notes->count == 1 && strstr(notes->item[0]->text, "the surface crosses itself"), "%s",
              o.out);
    json_done(&j);
    expect(o, 1, NULL, "crosses itself", "run");
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
