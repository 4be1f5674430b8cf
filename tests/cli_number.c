/* What has no value is not met, not drawn and not best, and the screen says which formula it is. */
#include <criterion/criterion.h>
#include <stdarg.h>

#include "program.h"

#define HEAD "vesica: 1\nvariables: {h: [0.1, 1, 2]}\n"
#define TUBE                                                                                                 \
    HEAD "curves: {a: {circle: 1}, b: {circle: {radius: 1, centre: [0, 0, h]}}}\n"                           \
         "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: a}, {u: 1, position: b}]}}\n"
#define SHEET(z, more) HEAD "patches: {w: {surface: {formula: [u, v, \"" z "\"]}, periodic: false" more "}}\n"

static bool null(const json *j, const char *key)
{
    const ves_node *node = ves_node_find(j->root, key);
    return node && node->text && !strcmp(node->text, "null");
}

/* eval, check and run agree: not measured, not feasible, and why. */
static void unmeasured(const char *text, const char *why)
{
    static const char *const command[] = {"eval", "check", "run --no-files"};
    write_file("odd.yaml", text);
    for (int k = 0; k < 3; k++) {
        expect(vesica(NULL, "%s odd.yaml", command[k]), 1, "not measured", why, command[k]);
        outcome o = vesica(NULL, "%s odd.yaml --json", command[k]);
        json j = json_of(o.out);
        const ves_node *feasible = ves_node_find(j.root, "feasible");
        cr_expect(null(&j, "objective") && null(&j, "violation") && !strcmp(feasible->text, "false"),
                  "%s: %s", command[k], o.out);
        json_done(&j);
        done(&o);
    }
}

Test(cli_number, what_has_no_value_is_not_met)
{
    root_make();
    unmeasured(TUBE "minimize: area\nconstraints: [sqrt(-h) <= 1]\n",
               "odd.yaml:6:15: warning: the start design cannot be measured: the left side of "
               "\"sqrt(-h) <= 1\" is not a number");
    unmeasured(TUBE "minimize: area/0\n", "odd.yaml:5:11: warning: the start design cannot be measured: "
                                          "\"area/0\" is infinite");
    write_file("odd.yaml", TUBE "minimize: area\nconstraints: [sqrt(h - 1) >= 0.2]\n");
    expect(vesica(NULL, "eval odd.yaml --set h=0.5"), 1, "not measured", "odd.yaml:6:15", "eval");
    expect(vesica(NULL, "eval odd.yaml --set h=1.5"), 0, "ok", NULL, "eval");
    expect(vesica(NULL, "check odd.yaml"), 0, "VIOLATED", NULL, "an infeasible start is in order");
    root_remove();
}

Test(cli_number, a_surface_without_points_is_no_shape)
{
    static const char *const file[] = {SHEET("log(-1)*h", "") "minimize: area\n",
                                       SHEET("h*log(u)", "") "minimize: area\n",
                                       SHEET("h*log(v)", "") "minimize: area\n"};
    static const char says[] =
        "odd.yaml:3:11: warning: the start design cannot be measured: z of patch \"w\" "
        "is not a finite number (at u = 0, v = 0)";
    root_make();
    write_file("at.csv", "0,0\n");
    for (int k = 0; k < 3; k++) {
        unmeasured(file[k], says);
        expect(vesica(NULL, "export odd.yaml --to stl,vtp"), 1, NULL, "there is no shape to show: z of patch",
               "export");
        expect(vesica(NULL, "show odd.yaml --png odd.png"), 1, NULL, "there is no shape to show", "show");
        expect(vesica(NULL, "sample odd.yaml --points at.csv"), 1, NULL,
               "error: z of patch \"w\" is not a finite number at u = 0, v = 0", "sample");
    }
    unmeasured(HEAD "curves: {a: {circle: 1}, b: {circle: {radius: 1, centre: [0, 0, h + sqrt(h - 2.5)]}}}\n"
                    "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: a}, {u: 1, position: "
                    "b}]}}\nminimize: area\n",
               "odd.yaml:4:11: warning: the start design cannot be measured: z of patch \"w\"");
    write_file("odd.yaml",
               HEAD "patches: {w: {surface: {formula: [u, v, \"log(-1)*h\"]}}}\nminimize: area\n");
    expect(vesica(NULL, "check odd.yaml"), 2, NULL, "is periodic but does not close", "check");
    write_file("odd.yaml", SHEET("1/(u - 0.5)", "") "validity: {jacobian: any}\nminimize: area + h\n");
    expect(vesica(NULL, "show odd.yaml --png odd.png"), 1, NULL, "(at u = 0.5, v = 0)", "between the nodes");
    root_remove();
}

Test(cli_number, no_point_of_many_that_fail_is_the_best)
{
    root_make();
    write_file("odd.yaml", "vesica: 1\nvariables: {h: [0.1, 1, 2]}\n"
                           "curves: {a: {circle: h}, b: {circle: {radius: 1, centre: [0, 0, k]}}}\n"
                           "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: a}, {u: 1, "
                           "position: b}]}}\n"
                           "solve: {unknown: k, in: [1, 3], equation: area == 1000}\nminimize: bending\n");
    outcome o = vesica(NULL, "run odd.yaml --no-files");
    cr_expect(!strstr(o.out, "best"), "%s", o.out);
    expect(o, 1, "no design could be measured", "does not change its sign", "run");
    o = vesica(NULL, "run odd.yaml --no-files --json");
    json j = json_of(o.out);
    cr_expect(null(&j, "objective") && null(&j, "violation") && number(&j, "variables", "h") == 1, "%s",
              o.out);
    json_done(&j);
    done(&o);
    root_remove();
}

/* The plane z = 1 + 0 u over u in [-1, 3], v in [2, 4]: area 8, mean u 1, mean v 3. */
Test(cli_number, u_and_v_of_formulas_run_over_the_domain)
{
    root_make();
    write_file("odd.yaml",
               "vesica: 1\npatches: {w: {surface: {formula: [u, v, \"1 + 0*u\"]}, periodic: false, "
               "domain: {u: [-1, 3], v: [2, 4]}}}\n"
               "measures: {iu: {integral: u}, iv: {integral: v}, ux: {max: u}, vn: {min: v}}\n"
               "expect: [abs(iu - 8) < 1e-12, abs(iv - 24) < 1e-12, abs(ux - 3) < 1e-12, abs(vn - "
               "2) < 1e-12]\n");
    write_file("at.csv", "1,0\n");
    expect(vesica(NULL, "run odd.yaml --no-files"), 0, "4 of 4 hold", NULL, "run");
    expect(vesica(NULL, "sample odd.yaml --points at.csv"), 0, "\n1,0,3,2,1,", NULL, "sample");
    write_file("at.csv", "3,0\n");
    expect(vesica(NULL, "sample odd.yaml --points at.csv"), 2, NULL, "not those of a domain", "sample");
    expect(vesica(NULL, "explain domain"), 0, "integral, min and max", NULL, "explain");
    expect(vesica(NULL, "help sample"), 0, "v from 0 to 2 pi", NULL, "help");
    expect(vesica(NULL, "help check"), 0, "Exit code: 0", NULL, "help");
    root_remove();
}
