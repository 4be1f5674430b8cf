/* Results that have names (kinds), as a user meets them. */
#include <criterion/criterion.h>

#include "program.h"

/* A double well in x, tilted by t: (x^2 - 1)^2 + t x, which has two minima while |t| < 8/(3 sqrt(3)) = 1.5396. */
#define WELL(kinds)                                                                                          \
    "vesica: 1\nparameters: {t: 0, k: 1, h: 1}\nvariables: {x: [-2, 0.5, 2]}\n"                              \
    "curves: {low: {circle: {radius: 3 + x}}, high: {like: low, apply: [{translate: [0, 0, 1]}]}}\n"         \
    "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "     \
    "high}]}}\n"                                                                                             \
    "minimize: (x^2 - 1)^2 + t*x\nquadrature: {u: 8, v: 8}\nvalidity: {self_intersection: never}\n"          \
    "kinds: {" kinds "}\n"

/* The width is 6 + 2 x. */
#define SIDES "left: x < 0, right: width > 6"

static const char well[] = WELL(SIDES) "sweep: {over: {t: {from: -2.4, to: 2.4, step: 0.4, walk: both}}}\n";

static const char *kind_of(const ves_node *node)
{
    const ves_node *kind = ves_node_find(node, "kind");
    cr_assert(kind && kind->kind == VES_NODE_WORD);
    return kind->text;
}

Test(cli_kinds, a_run_names_its_designs)
{
    root_make();
    write_file("w.yaml", well);
    write_file("far.yaml", WELL("left: x < -1.5, right: x > 1.5"));
    expect(vesica(NULL, "check w.yaml"), 0, "  kind   right\n", NULL, "check");
    expect(vesica(NULL, "eval w.yaml --set x=-0.5 --json"), 0, "\"kind\": \"left\"", NULL, "eval");
    expect(vesica(NULL, "run far.yaml --set t=0.1 --out far"), 0,
           "  kind   none of these   start none of these\n", NULL, "far");
    expect(vesica(NULL, "run w.yaml --set t=1.8 --out one"), 0, "  kind   left   start right\n", NULL, "one");
    char *text = slurp("one/result.json"), *log = slurp("one/log.txt");
    json j = json_of(text);
    cr_expect_str_eq(kind_of(j.root), "left");
    cr_expect_str_eq(kind_of(ves_node_find(j.root, "start")), "right");
    cr_expect(strstr(log, "note: the search has left the kind of its start: left, was right\n") != NULL, "%s",
              log);
    json_done(&j);
    free(text);
    free(log);
    /* at t = 0.1 the left well is the deeper one */
    outcome o = vesica(NULL, "run w.yaml --set t=0.1 --set x=-0.5 --out two");
    cr_expect(strstr(o.out, "   left\n") && strstr(o.out, "   right   at x = ") && !strstr(o.out, "has left"),
              "%s", o.out);
    done(&o);
    text = slurp("two/result.json");
    j = json_of(text);
    const ves_node *optima = ves_node_find(j.root, "optima");
    cr_assert(optima->count == 2);
    cr_expect_str_eq(kind_of(optima->item[0]), "left");
    cr_expect_str_eq(kind_of(optima->item[1]), "right");
    json_done(&j);
    free(text);
    root_remove();
}

/* Up, the right well ends between 1.2 and 1.6; down, the left one between -1.2 and -1.6. Gone on with, it is the same. */
Test(cli_kinds, a_sweep_says_where_a_walk_changes_its_kind)
{
    root_make();
    write_file("w.yaml", well);
    outcome o = vesica(NULL, "sweep w.yaml --out w");
    cr_assert(o.code == 0, "%s", o.err);
    cr_expect(strstr(o.out, "  kind       up: right becomes left between t = 1.2 ... 1.6\n") &&
                  strstr(o.out, "  kind       down: left becomes right between t = -1.6 ... -1.2\n") ==
                      NULL &&
                  strstr(o.out, "  kind       down: left becomes right between t = -1.2 ... -1.6\n"),
              "%s", o.out);
    done(&o);
    cr_expect(count_of("w/sweep.csv", ",status,reason,kind,was,optimum,") == 1);
    cr_expect(count_of("w/sweep.csv", ",ok,,right,,") == 13 - 3 + 2 &&
              count_of("w/sweep.csv", ",ok,,left,,") == 2 + 10);
    cr_expect(count_of("w/sweep.csv", ",ok,,left,right,") == 1 &&
              count_of("w/sweep.csv", ",ok,,right,left,") == 1);
    cr_expect(count_of("w/points.jsonl", "\"kind\":\"left\",\"was\":\"right\"") == 1);
    cr_assert(system("cp -r w part && sed -i 8,99d part/walks/0000.jsonl && rm part/walks/0001.jsonl") == 0);
    expect(vesica(NULL, "sweep --resume part"), 0, NULL, "7 points are there already", "resume");
    same_file("w/sweep.csv", "part/sweep.csv");
    same_file("w/points.jsonl", "part/points.jsonl");
    root_remove();
}

/* Where there is no right well the search falls into the left one. The branch that says its kind loses these points, and
 * begins anew; the other stays where it has fallen. */
Test(cli_kinds, a_branch_that_names_its_kind_loses_what_has_left_it)
{
    root_make();
    write_file("b.yaml",
               WELL(SIDES) "sweep:\n  over: {t: {from: 2, to: 0.4, step: 0.4}}\n"
                           "  branches: {right: {set: {x: 1.2}, kind: right}, any: {set: {x: 1.2}}}\n");
    expect(vesica(NULL, "sweep b.yaml --out b"), 0,
           "lost       right, at t = 2 ... 1.6: left its branch: left, not right", NULL, "b");
    cr_expect(count_of("b/sweep.csv", ",lost,\"left its branch: left, not right\",left,,0,false,true,") == 2);
    cr_expect(count_of("b/sweep.csv", ",ok,,right,,") == 3 && count_of("b/sweep.csv", ",ok,,left,,") == 5);
    write_file("set.yaml",
               WELL(SIDES) "sweep: {over: {t: [1, 2]}, branches: {x: {set: {kinds.left: x < 1}}}}\n");
    expect(vesica(NULL, "sweep set.yaml"), 2, NULL, "what is set here changes the kinds", "kinds");
    root_remove();
}

static double reached_of(const char *file, int line)
{
    char *text = slurp(file), *at = text;
    for (; line > 0; line--) at = strchr(at, '\n') + 1;
    at[strcspn(at, "\n")] = 0;
    json j = json_of(at);
    const ves_node *reached = ves_node_find(j.root, "reached");
    cr_assert(reached && reached->kind == VES_NODE_WORD);
    double value = strcmp(reached->text, "null") ? atof(reached->text) : NAN;
    json_done(&j);
    free(text);
    return value;
}

/* The right well is there until t = 8/(3 sqrt(3)) = 1.5396. A step from 1 to 2 loses it; smaller ones follow it nearly to
 * its end: near there the first stride of a descent is longer than the well is wide. Gone on with, it is the same. */
Test(cli_kinds, smaller_steps_follow_a_branch_to_its_end)
{
    root_make();
    write_file("w.yaml", WELL(SIDES) "sweep:\n  over: {t: {from: 0, to: 3, step: 1}}\n  finest: 0.002\n"
                                     "  branches: {right: {set: {x: 1.2}, kind: right}}\n");
    outcome o = vesica(NULL, "sweep w.yaml --out w");
    cr_expect(strstr(o.out, "  ends       right, followed to t = 1.5") &&
                  strstr(o.out, "; a step of 0.002 loses it: left its branch: left, not right\n") &&
                  strstr(o.out, "  lost       right, at t = 2 ... 3: left its branch: left, not right\n"),
              "%s", o.out);
    done(&o);
    const double end = 8 / (3 * sqrt(3)), reached = reached_of("w/points.jsonl", 2);
    cr_expect(reached <= end && reached >= 1.5, "%.6f, the end is at %.6f", reached, end);
    cr_expect(isnan(reached_of("w/points.jsonl", 1)) && isnan(reached_of("w/points.jsonl", 3)));
    cr_expect(count_of("w/sweep.csv", ",status,reason,reached,kind,was,") == 1);
    char *whole = slurp("w/points.jsonl"), *walk = slurp("w/walks/0000.jsonl");
    char *third = strchr(strchr(strchr(walk, '\n') + 1, '\n') + 1, '\n') + 1;
    *third = 0; /* as if it had been killed before the last point */
    write_file("w/walks/0000.jsonl", walk);
    expect(vesica(NULL, "sweep --resume w"), 1, "followed to t = 1.5", NULL, "resumed");
    char *again = slurp("w/points.jsonl");
    cr_expect_str_eq(again, whole);
    free(whole), free(walk), free(again);
    root_remove();
}

/* A branch may be walked at some values of the second parameter alone. */
Test(cli_kinds, a_branch_has_its_values_of_the_second_parameter)
{
    root_make();
    write_file("w.yaml", WELL(SIDES) "sweep:\n  over: {t: [0, 0.5], k: [1, 2, 3]}\n"
                                     "  branches: {right: {set: {x: 1.2}, at: {k: [1, 3]}}, left: {set: {x: "
                                     "-1.2}, at: {k: {from: 1.5, to: 2}}}}\n");
    outcome o = vesica(NULL, "sweep w.yaml --out w");
    cr_expect(strstr(o.out, "  right, k = 1 ") && strstr(o.out, "  right, k = 3 ") &&
                  strstr(o.out, "  left, k = 2 ") && strstr(o.out, "right, k = 2") == NULL,
              "%s", o.out);
    cr_expect(strstr(o.err, ": 6 points in 3 walks") != NULL, "%s", o.err);
    done(&o);
    expect(vesica(NULL, "sweep w.yaml --over t=0,0.5 --over k=2 --out k2"), 0, "  left, k = 2 ",
           "warning: branch \"right\" is not walked: no value is one that `at` names", "k = 2");
    expect(vesica(NULL, "sweep w.yaml --over t=0,0.5 --set k=3 --out k3"), 0, "  right ",
           "warning: branch \"left\" is not walked", "k is no axis");
    write_file("p.yaml",
               WELL(SIDES) "sweep:\n  over: {t: [0, 0.5], h: [1, 2, 3]}\n"
                           "  branches: {right: {set: {x: 1.2}, at: {k: 2}}, left: {set: {x: -1.2}}}\n");
    expect(vesica(NULL, "sweep p.yaml --out p"), 0, "  left, h = 3 ", ": 6 points in 3 walks",
           "k, which is not swept");
    expect(vesica(NULL, "sweep w.yaml --over t=0,0.5 --over k=7 --out k7"), 2, NULL,
           "no branch is walked at these values", "none");
    root_remove();
}

/* Where others have found the same change it stands beside. */
Test(cli_kinds, a_change_that_is_known)
{
    root_make();
    write_file(
        "w.yaml",
        WELL(SIDES) "sweep:\n  over: {t: {from: -0.4, to: 0.5, step: 0.3}}\n"
                    "  known: [{from: right, to: left, at: 0.01, source: by symmetry}]\n"
                    "  branches: {right: {set: {x: 1}, kind: right}, left: {set: {x: -1}, kind: left}}\n");
    expect(vesica(NULL, "sweep w.yaml --out w"), 0, "(0.01: by symmetry)\n", NULL, "known");
    expect(vesica(NULL, "sweep w.yaml --out j --json"), 0, "\"known\": 0.01", NULL, "json");
    root_remove();
}
