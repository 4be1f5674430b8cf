/* What the screen says of numbers, and what result.json says of them. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

static const char tilted[] =
    "vesica: 1\n"
    "parameters: {lean: 2 deg, H: 10 cm}\n"
    "variables: {r: [20 mm, 31.7 mm, 80 mm], tilt: [-20 deg, 3 deg, 20 deg], fill: [10 %, 50 %, 90 %]}\n"
    "curves:\n"
    "  low: {circle: {radius: r}}\n"
    "  high: {circle: {radius: 0.05 m}, apply: [{rotate: [tilt + lean, 0, 0]}, {translate: [0 m, 0 m, H]}]}\n"
    "patches: {wall: {operator: {power: 1, a: 2*fill}, conditions: [{u: 0, position: low}, {u: 1, position: "
    "high}]}}\n"
    "measures: {up: {extent: {along: [0, 0, 1]}}, out: {extent: {along: [1, 0, 0]}}}\n"
    "minimize: area\n"
    "constraints: [up <= 1.2*H, out >= 0.03 m, tilt <= 10 deg]\n"
    "expect: [area < 300 cm^2]\n";

/* Each line, blanks drawn together, must stand in the text. */
static void has_lines(const char *text, const char *const *line)
{
    char *flat = malloc(strlen(text) + 1), *to = flat;
    for (const char *c = text; *c; c++)
        if (*c != ' ' || (to > flat && to[-1] != ' ')) *to++ = *c;
    *to = 0;
    for (; *line; line++) cr_assert(strstr(flat, *line) != NULL, "no \"%s\" in\n%s", *line, text);
    free(flat);
}

Test(cli_screen, numbers_are_in_the_units_of_the_file)
{
    root_make();
    write_file("tilted.yaml", tilted);
    outcome o = vesica(NULL, "check tilted.yaml");
    cr_assert(eq(int, o.code, 0), "%s", o.err);
    has_lines(o.out,
              (const char *const[]){"r 31.7 [20, 80] mm\n", "tilt 3 [-20, 20] deg\n", "fill 50 [10, 90] %\n",
                                    "cm^2\n", " 12 cm ok\n", " 0.03 m ok\n", "tilt <= 10 deg 3 10 deg ok\n",
                                    "\n up 10.43578 cm\n", "\n out 0.1 m\n", NULL});
    done(&o);
    o = vesica(NULL, "run tilted.yaml --evaluations 1500 --json");
    cr_assert(eq(int, o.code, 0), "%s", o.err);
    json j = json_of(o.out);
    const ves_node *units = ves_node_find(j.root, "units");
    cr_assert(number(&j, "variables", "r") < 0.0201, "SI in result.json");
    cr_assert(eq(str, (char *)ves_node_find(units, "objective")->text, "m^2"));
    cr_assert(eq(str, (char *)ves_node_find(ves_node_find(units, "variables"), "r")->text, "m"));
    cr_assert(eq(str, (char *)ves_node_find(ves_node_find(units, "variables"), "tilt")->text, "rad"));
    cr_assert(eq(str, (char *)ves_node_find(ves_node_find(units, "measures"), "up")->text, "m"));
    cr_assert(
        eq(str, (char *)ves_node_find(ves_node_find(j.root, "constraints")->item[0], "unit")->text, "m"));
    json_done(&j);
    done(&o);
    o = vesica(NULL, "eval runs/tilted-0001");
    cr_assert(eq(str, o.err, ""), "a run's own numbers have their units");
    done(&o);
    o = vesica(NULL, "check " PROBLEMS "bottle.yaml");
    has_lines(o.out, (const char *const[]){"r 0.5 [0.2, 1.1]\n", "area 4.712389\n",
                                           "\n base.u1, wall.u0 low C0 crease of 90 deg\n", NULL});
    done(&o);
    root_remove();
}

Test(cli_screen, what_is_set_without_a_unit_is_told_or_refused)
{
    root_make();
    write_file("tilted.yaml", tilted);
    expect(vesica(NULL, "eval tilted.yaml --set lean=0.1"), 0, NULL,
           "0.1 has no unit, where the file has \"2 deg\": taken as 5.72958 deg", "angle");
    expect(vesica(NULL, "eval tilted.yaml --set tilt=5"), 2, NULL,
           "start 286.478897565 deg is outside [-20, 20] deg", "start");
    expect(vesica(NULL, "eval tilted.yaml --set r=30"), 2, NULL,
           "30 has no unit, where the file has \"31.7 mm\": write 30 mm", "length");
    expect(vesica(NULL, "eval tilted.yaml --set H=0.2"), 2, NULL, "write 0.2 cm", "length");
    static const char *const fine[] = {"r=30mm", "tilt=5deg", "tilt=0", "lean=0.1rad", "H=2*r+3cm"};
    for (size_t k = 0; k < sizeof fine / sizeof *fine; k++) {
        outcome o = vesica(NULL, "eval tilted.yaml --set %s", fine[k]);
        cr_assert(eq(str, o.err, ""), "%s: %s", fine[k], o.err);
        done(&o);
    }
    root_remove();
}

/* A double well: the lower one at r = 1.2, the other near 0.5. */
Test(cli_screen, optima_are_told_apart_by_their_variables)
{
    root_make();
    write_file(
        "wells.yaml",
        "vesica: 1\n"
        "variables: {r: [0.2, 0.9, 1.6], idle: [0, 0.4, 1]}\n"
        "curves: {low: {circle: {radius: r}}, high: {circle: {radius: 1, centre: [0, 0, 1 + idle/100]}}}\n"
        "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: low}, {u: 1, position: "
        "high}]}}\n"
        "minimize: 10*((r - 0.5)*(r - 1.2))^2 + 0.001*(1.2 - r) + 0*area + (idle - 0.3)^2\n"
        "search: [{anneal: {evaluations: 500, chains: 8}}, {polish: {}}]\n");
    outcome o = vesica(NULL, "run wells.yaml --no-files --jobs 1");
    has_lines(o.out, (const char *const[]){" at r = 0.50", NULL});
    cr_assert(strstr(o.out, ", idle") == NULL, "idle is the same in both:\n%s", o.out);
    done(&o);
    root_remove();
}

Test(cli_screen, explain_knows_whatever_a_user_may_have_read)
{
    static const struct {
        const char *word;
        int code;
        const char *says;
    } list[] = {
        {"atan2", 0, "the angle in radians, -pi to pi, of the point (x, y)"},
        {"vtp", 0, "vesica export problem.yaml --to vtp"},
        {"svg", 0, "--png shape.svg"},
        {"export", 0, "vesica help export"},
        {"radius", 0, "circle.radius"},
        {"curves.circle.radius", 0, "circle.radius"},
        {"curves.low.circle", 0, "a curve kind"},
        {"search.anneal.c_end", 0, "frozen at"},
        {"search.0.anneal.c_end", 0, "frozen at"},
        {"patches.wall.conditions.2.scale", 0, "patches.conditions.scale"},
        {"measures.E.integral.of", 0, "integral.of"},
        {"FOLDED", 0, "the surface folds back on itself"},
        {"VES_COARSE", 0, "quadrature:"},
        {"self_intersects", 0, "the surface crosses itself"},
        {"search.anneal.cooling", 2,
         "\"search.anneal\" has no \"cooling\": it has evaluations, as, proposal"},
        {"curves.circle.raduis", 2, "it has radius, axis, centre"},
        {"atna2", 2, "did you mean \"atan2\"?"},
        {"vpt", 2, "did you mean \"vtp\"?"},
        {"...", 2, "nothing is known"},
    };
    root_make();
    for (size_t k = 0; k < sizeof list / sizeof *list; k++)
        expect(vesica(NULL, "explain %s", list[k].word), list[k].code, list[k].code ? NULL : list[k].says,
               list[k].code ? list[k].says : NULL, list[k].word);
    root_remove();
}

Test(cli_screen, every_list_is_one_json_object_too)
{
    static const char *const list[] = {"measures",  "curves",    "moves",       "algorithms",
                                       "proposals", "schedules", "populations", "constraints",
                                       "formats",   "units",     "templates"};
    root_make();
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        outcome o = vesica(NULL, "list %s --json", list[k]), plain = vesica(NULL, "list %s", list[k]);
        cr_assert(eq(int, o.code, 0));
        json j = json_of(o.out);
        const ves_node *all = ves_node_find(j.root, list[k]);
        int lines = 0;
        for (const char *c = plain.out; *c; c++) lines += *c == '\n';
        cr_assert(all && all->kind == VES_NODE_LIST && all->count == lines, "%s", o.out);
        for (int i = 0; i < all->count; i++)
            cr_assert(ves_node_find(all->item[i], "name") && ves_node_find(all->item[i], "about"), "%s",
                      o.out);
        json_done(&j);
        done(&o);
        done(&plain);
    }
    root_remove();
}

Test(cli_screen, what_is_proposed_can_be_typed)
{
    root_make();
    write_file("tilted.yaml", tilted);
    setenv("VESICA_AS", "./vesica", 1); /* as the launcher does */
    expect(vesica(NULL, "run tilted.yaml --evaluations 200"), 0,
           "next: ./vesica export runs/tilted-0001 --to stl,obj", NULL, "run");
    expect(vesica(NULL, "new can"), 0, NULL, "next: ./vesica check can.yaml", "new");
    unsetenv("VESICA_AS");
    expect(vesica(NULL, "export runs/tilted-0001 --to stl,obj"), 0, "tilted-0001.obj", NULL,
           "the first proposal");
    root_remove();
}

Test(cli_screen, the_picture_of_a_run_shows_the_mean_curvature)
{
    root_make();
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --evaluations 1500 --out best"), 0, NULL, NULL, "run");
    expect(vesica(NULL, "show best --png one.png"), 0, "one.png", NULL, "show");
    expect(vesica(NULL, "show best --png two.png --colour H"), 0, "two.png", NULL, "show H");
    expect(vesica(NULL, "show best --png three.png --colour patch"), 0, "three.png", NULL, "show patch");
    cr_assert(system("cmp one.png best/best.png && cmp one.png two.png && ! cmp -s one.png three.png") == 0);
    root_remove();
}

/* A wall whose equation has no number at an end of its interval, nor near it, cannot be measured anywhere. */
Test(cli_screen, a_grid_that_nothing_could_choose_is_not_said_to_be_the_file_s)
{
    const char *flat =
        "vesica: 1\nvariables: {r: [0.5, 1, 2]}\n"
        "curves: {low: {circle: {radius: r}}, high: {like: low, apply: [{translate: [0, 0, h]}]}}\n"
        "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, "
        "position: high}]}}\nshape: {closed: true, caps: [wall.u0, wall.u1]}\n"
        "solve: {unknown: h, in: [0, 4], equation: volume + sqrt(depth - 1) == 3}\nminimize: area\n";
    char given[1000];
    root_make();
    write_file("flat.yaml", flat);
    outcome o = vesica(NULL, "check flat.yaml");
    has_lines(o.out,
              (const char *const[]){"\n quadrature 16 x 16 nodes a patch, not chosen: nothing could be "
                                    "measured\n",
                                    NULL});
    done(&o);
    snprintf(given, sizeof given, "%squadrature: {u: 24, v: 32}\n", flat);
    write_file("given.yaml", given);
    o = vesica(NULL, "check given.yaml");
    has_lines(o.out, (const char *const[]){"\n quadrature 24 x 32 nodes a patch, as the file says\n", NULL});
    done(&o);
}
