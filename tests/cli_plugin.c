/* Measures from shared objects, as a user meets them. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

static void build_plugin(const char *name, const char *defines)
{
    char command[1200];
    snprintf(command, sizeof command,
             "cc -std=c17 -shared -fPIC %s -I" VESICA_SOURCE "/include -o %s " VESICA_SOURCE
             "/examples/plugin/sphericity.c -lm",
             defines, name);
    cr_assert(system(command) == 0, "%s", command);
}

Test(cli_plugin, a_plugin_is_a_measure_like_any_other)
{
    root_make();
    build_plugin("good.so", "");
    expect(vesica(NULL, "list measures --plugin good.so"), 0, "sphericity", NULL, "list");
    expect(vesica(NULL, "explain sphericity --plugin ./good.so"), 0, "sphericity", NULL, "explain");
    expect(vesica(NULL, "eval " PROBLEMS "bottle.yaml --set maximize=sphericity"), 2, NULL, "sphericity",
           "without it");
    outcome o =
        vesica(NULL, "eval " PROBLEMS "bottle.yaml --set maximize=sphericity --plugin good.so --json");
    json j = json_of(o.out);
    /* V = pi / 4, A = 1.5 pi; rounding of a sum over all nodes */
    double V = 0.78539816339744831, A = 4.71238898038468986,
           want = cbrt(36 * 3.14159265358979324 * V * V) / A;
    cr_assert(fabs(number(&j, "objective", NULL) - want) < 1e-13, "got %.17g, want %.17g",
              number(&j, "objective", NULL), want);
    json_done(&j);
    done(&o);
    expect(vesica(NULL, "list measures --plugin good.so --plugin ./good.so"), 2, NULL,
           "there is one of that name", "twice");
    /* a run's folder needs it again, and says which */
    expect(vesica(NULL,
                  "run " PROBLEMS "bottle.yaml --set maximize=sphericity --plugin good.so --evaluations 300"),
           0,
           "export runs/bottle-0001 --to stl,obj --plugin good.so    vesica show runs/bottle-0001 --plugin "
           "good.so",
           NULL, "run");
    expect(vesica(NULL, "eval runs/bottle-0001"), 2, NULL,
           "note: the run \"runs/bottle-0001\" was made with measures of a plugin, which it needs again: "
           "--plugin "
           "good.so",
           "without the plugin");
    expect(vesica(NULL, "eval runs/bottle-0001 --plugin good.so"), 0, "sphericity", NULL, "with it");
    write_file(
        "old.c",
        "const struct { int abi; long size; const char *name; const void *measure; } ves_plugin_entry = "
        "{99, 8, \"old\", 0};\n");
    cr_assert(system("cc -shared -fPIC -o old.so old.c && cc -shared -fPIC -x c -o empty.so /dev/null") == 0);
    expect(vesica(NULL, "list measures --plugin old.so"), 2, NULL, "built for interface 99", "ABI");
    expect(vesica(NULL, "list measures --plugin empty.so"), 2, NULL, "no ves_plugin_entry", "no entry");
    root_remove();
}

/* `entry` and `measure` are C: what stands in the braces of ves_plugin and of one ves_measure. */
static void refuse_plugin(const char *entry, const char *measure, int code, const char *want)
{
    char text[1500];
    snprintf(
        text, sizeof text,
        "#include <vesica/measure.h>\n"
        "static ves_status eval(const ves_measure_input *i, double *v) { *v = i->samples; return VES_OK; }\n"
        "static const ves_measure m = {.about = \"a\", .unit = \"1\", .surface = VES_X, .eval = eval, %s};\n"
        "static const ves_measure *const list[] = {&m, NULL};\n"
        "const ves_plugin ves_plugin_entry = {VES_PLUGIN, .name = \"bad\", .measure = list, %s};\n",
        measure, entry);
    write_file("bad.c", text);
    cr_assert(system("cc -std=c17 -w -shared -fPIC -I" VESICA_SOURCE "/include -o bad.so bad.c") == 0, "%s",
              text);
    expect(vesica(NULL, "list measures --plugin bad.so"), code, NULL, want, want);
}

Test(cli_plugin, a_plugin_that_is_not_sound_is_refused)
{
    static const char sound[] = ".abi = VES_ABI", name[] = ".name = \"mine\"";
    static const char unsized[] = "does not say which vesica it was built with";
    root_make();
    refuse_plugin(".size = sizeof(ves_measure) + 8", name, 2, "was built for a newer vesica");
    refuse_plugin(".given = sizeof(ves_measure_input) + sizeof(ves_samples) + sizeof(ves_adjoint) + 8", name,
                  2, "was built for a newer vesica");
    refuse_plugin(".size = offsetof(ves_measure, gradient)", name, 2, unsized);
    refuse_plugin(".size = offsetof(ves_measure, most)", name, 0, ""); /* an older one is taken */
    refuse_plugin(".size = 0", name, 2, unsized);
    refuse_plugin(".given = 0", name, 2, unsized);
    refuse_plugin(".measure = NULL", name, 2, "lacks its name or its list");
    refuse_plugin(sound, ".name = \"area\"", 2, "\"area\" from outside has the name of a built-in one");
    refuse_plugin(sound, ".name = \"mine\", .eval = NULL", 2, "note: it is in the plugin \"bad.so\"");
    refuse_plugin(sound, ".name = \"mine\", .surface = 1 << 12", 2, "this version of vesica does not know");
    root_remove();
}

/* A plugin whose gradient has a wrong factor: the run ends well or not, but it is told. */
Test(cli_plugin, a_gradient_that_is_wrong_is_told)
{
    root_make();
    build_plugin("good.so", "");
    cr_assert(system("sed 's/seed \\* psi \\* 2/seed * psi * 6/' " VESICA_SOURCE
                     "/examples/plugin/sphericity.c > wrong.c && cc -std=c17 -shared -fPIC -I" VESICA_SOURCE
                     "/include -o wrong.so wrong.c -lm") == 0);
    static const char run[] =
        "run " PROBLEMS "bottle.yaml --set maximize=sphericity --evaluations 900 --no-files";
    outcome o = vesica(NULL, "%s --plugin wrong.so", run);
    cr_expect(strstr(o.out, "the gradient seems to be wrong: near the start") != NULL, "%s", o.out);
    done(&o);
    o = vesica(NULL, "%s --plugin good.so", run);
    cr_expect(strstr(o.out, "seems to be wrong") == NULL, "%s", o.out);
    done(&o);
    root_remove();
}

/* A start design that takes long, without waiting for it: its measure rings the bell. */
Test(cli_plugin, who_waits_for_a_start_design_is_told)
{
    root_make();
    write_file("slow.c",
               "#include <vesica/measure.h>\n#include <signal.h>\n"
               "static ves_status eval(const ves_measure_input *i, double *v)\n"
               "{ static int rung; if (!rung++) raise(SIGALRM); *v = i->samples; return VES_OK; }\n"
               "static const ves_measure m = {.name = \"slow\", .about = \"a\", .unit = \"1\", "
               ".surface = VES_X, .eval = eval};\n"
               "static const ves_measure *const list[] = {&m, NULL};\n"
               "const ves_plugin ves_plugin_entry = {VES_PLUGIN, .name = \"slow\", .measure = list};\n");
    cr_assert(system("cc -D_POSIX_C_SOURCE=200809L -std=c17 -shared -fPIC -I" VESICA_SOURCE
                     "/include -o slow.so slow.c") == 0);
    static const struct {
        const char *command, *says;
    } row[] = {{"check", "  still at work on the start design\n"},
               {"run --no-files --evaluations 9", "  still at work on the start design\nbottle  "}};
    for (int k = 0; k < 2; k++) {
        outcome o =
            vesica(NULL, "%s " PROBLEMS "bottle.yaml --set maximize=slow --plugin slow.so", row[k].command);
        cr_assert(strstr(o.err, row[k].says) == o.err, "%s: %d, %s", row[k].command, o.code, o.err);
        done(&o);
    }
    root_remove();
}
