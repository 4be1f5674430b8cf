/* What a user is told: every mistake of a file, where lengths are from, what a word means. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

/* A tube of two rings. What changes: its heading, its variables, its curve q. */
static void tube_write(const char *path, const char *variables, const char *curve)
{
    char text[1500];
    snprintf(text, sizeof text,
             "vesica: 1\n%s\ncurves: {p: {circle: {radius: 1}}, q: %s}\n"
             "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n",
             variables, curve);
    write_file(path, text);
}

static int count(const char *text, const char *word)
{
    int found = 0;
    for (const char *at = text; (at = strstr(at, word)); at += strlen(word)) found++;
    return found;
}

Test(cli_words, every_error_of_a_file_is_told_or_counted)
{
    char text[8000] = "vesica: 1\n";
    size_t length = strlen(text);
    root_make();
    for (int k = 0; k < 40; k++)
        length += (size_t)snprintf(text + length, sizeof text - length, "w%d: 1\n", k);
    write_file("some.yaml", text);
    for (int k = 40; k < 223; k++)
        length += (size_t)snprintf(text + length, sizeof text - length, "w%d: 1\n", k);
    write_file("many.yaml", text);
    outcome some = vesica(NULL, "check some.yaml"), many = vesica(NULL, "check many.yaml");
    cr_assert(count(some.err, "unknown key") == 40 && strstr(some.err, "more error") == NULL, "%s", some.err);
    /* 223 keys, and patches are missing */
    cr_assert(count(many.err, "error: ") == 100 && strstr(many.err, "\n... and 124 more errors\n"), "%s",
              many.err);
    done(&some), done(&many);
    root_remove();
}

Test(cli_words, stdin_is_a_file_for_every_command)
{
    root_make();
    tube_write("a.yaml", "variables: {h: [1, 2, 3]}\nminimize: area",
               "{circle: {radius: 1, centre: [0, 0, h]}}");
    expect(vesica("a.yaml", "check -"), 0, "stdin: ok", NULL, "check");
    expect(vesica("a.yaml", "eval -"), 0, "area", NULL, "eval");
    expect(vesica("a.yaml", "run - --test"), 0, "runs/stdin-0001", NULL, "run");
    expect(vesica("a.yaml", "check - --start runs/stdin-0001"), 0, "stdin: ok", NULL, "twice read");
    write_file("b.yaml", "vesica: 1\npatchez: {}\n");
    expect(vesica("b.yaml", "check -"), 2, NULL, "stdin:2:1: error: unknown key \"patchez\"", "broken");
    root_remove();
}

Test(cli_words, a_run_of_a_file_without_a_title_is_called_as_its_folder)
{
    root_make();
    tube_write("hose.yaml", "variables: {h: [1, 2, 3]}\nminimize: area",
               "{circle: {radius: 1, centre: [0, 0, h]}}");
    expect(vesica(NULL, "run hose.yaml --test"), 0, NULL, NULL, "run");
    expect(vesica(NULL, "check runs/hose-0001"), 0, "\n  hose-0001\n", NULL, "check");
    root_remove();
}

/* The least and the largest x of a file in the format off. */
static double width_of(const char *path)
{
    int vertices, triangles, edges;
    double x, y, z, low = HUGE_VAL, high = -HUGE_VAL;
    FILE *in = fopen(path, "r");
    cr_assert(in && fscanf(in, "OFF %d %d %d", &vertices, &triangles, &edges) == 3, "%s", path);
    for (int k = 0; k < vertices && fscanf(in, "%lf %lf %lf", &x, &y, &z) == 3; k++)
        low = fmin(low, x), high = fmax(high, x);
    fclose(in);
    return high - low;
}

/* x, H, K, k1, k2 of the first node of a CSV. */
static void first_node(const char *path, double value[5])
{
    FILE *in = fopen(path, "r");
    cr_assert(in && fscanf(in, "%*[^\n] %*[^,],%*d,%*d,%*f,%*f,%lf,%*f,%*f,%*f,%*f,%*f,%lf,%lf,%lf,%lf",
                           value, value + 1, value + 2, value + 3, value + 4) == 5,
              "%s", path);
    fclose(in);
}

Test(cli_words, exported_lengths_have_the_unit_that_is_asked_for)
{
    root_make();
    tube_write("plain.yaml", "", "{circle: {radius: 1, centre: [0, 0, 3]}}");
    write_file(
        "tube.yaml",
        "vesica: 1\ncurves: {p: {circle: {radius: 20 mm}}, q: {circle: {radius: 20 mm, centre: [0 mm, "
        "0 mm, 50 mm]}}}\n"
        "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n");
    expect(vesica(NULL, "export tube.yaml --to off"), 0, "tube.off", "box 0.04 x 0.04 x 0.05 m\n", "SI");
    expect(vesica(NULL, "export tube.yaml --to off --unit mm"), 0, "tube-2.off", "box 40 x 40 x 50 mm\n",
           "mm");
    expect(vesica(NULL, "export tube.yaml --to off --unit cm"), 0, "tube-3.off", "box 4 x 4 x 5 cm\n", "cm");
    /* a circle of 20 mm has nodes at v = 0 and pi; rounding alone */
    static const double want[] = {0.04, 40, 4};
    for (int k = 0; k < 3; k++) {
        double got = width_of(k == 0 ? "tube.off" : k == 1 ? "tube-2.off" : "tube-3.off");
        cr_assert(fabs(got / want[k] - 1) < 1e-14, "got %.17g, want %g", got, want[k]);
    }
    /* curvatures follow */
    expect(vesica(NULL, "export tube.yaml --to csv"), 0, "tube.csv", NULL, "csv");
    expect(vesica(NULL, "export tube.yaml --to csv --unit mm"), 0, "tube-2.csv", NULL, "csv in mm");
    static const double factor[] = {1000, 1e-3, 1e-6, 1e-3, 1e-3}; /* x, H, K, k1, k2 */
    double in_m[5], in_mm[5];
    first_node("tube.csv", in_m), first_node("tube-2.csv", in_mm);
    for (int k = 0; k < 5; k++)
        cr_assert(fabs(in_mm[k] / in_m[k] / factor[k] - 1) < 1e-14, "%d: %.17g and %.17g", k, in_m[k],
                  in_mm[k]);
    expect(vesica(NULL, "export plain.yaml --to off"), 0, NULL,
           "box 2 x 2 x 3 (the problem file has no units)", "no units");
    expect(vesica(NULL, "export plain.yaml --to off --unit mm"), 2, NULL, "the problem file has no units",
           "a unit for none");
    expect(vesica(NULL, "export tube.yaml --to off --unit ml"), 2, NULL, "--unit needs a unit of length",
           "ml");
    expect(vesica(NULL, "export tube.yaml --to off --unit furlong"), 2, NULL, "--unit needs a unit of length",
           "unknown");
    static const char *const format[] = {"stl", "obj", "ply", "off"};
    for (int k = 0; k < 4; k++)
        expect(vesica(NULL, "explain %s", format[k]), 0, "lengths in m", NULL, format[k]);
    expect(vesica(NULL, "help export"), 0, "--unit UNIT", NULL, "help");
    root_remove();
}

Test(cli_words, lengths_along_an_axis_say_which)
{
    root_make();
    tube_write("a.yaml",
               "measures: {up: {extent: {along: [0, 0, 1]}}, mine: {centroid: {of: surface}}}\n"
               "minimize: height + width + depth + extent + up + mine\nvariables: {h: [1, 2, 3]}",
               "{circle: {radius: 1, centre: [0, 0, h]}}");
    outcome o = vesica(NULL, "eval a.yaml");
    static const char *const line[] = {"height (along y)", "width (along x)", "depth (along z)",
                                       "extent (along y)", "mine (along y)",  "\n  up  "};
    for (int k = 0; k < 6; k++) cr_assert(strstr(o.out, line[k]) != NULL, "no %s:\n%s", line[k], o.out);
    done(&o);
    expect(vesica(NULL, "explain extent"), 0, "along a direction, y unless", NULL, "extent");
    expect(vesica(NULL, "explain centroid"), 0, "along y unless", NULL, "centroid");
    expect(vesica(NULL, "list measures"), 0, "along a direction, y unless", NULL, "list");
    root_remove();
}

Test(cli_words, every_name_of_formulas_is_explained)
{
    static const char *const word[] = {"x",         "y",        "z",         "u",           "v",
                                       "H",         "K",        "k1",        "k2",          "objective",
                                       "violation", "feasible", "gradients", "evaluations", "optima"};
    root_make();
    for (size_t k = 0; k < sizeof word / sizeof *word; k++) {
        char want[80];
        snprintf(want, sizeof want, "%s: a name in ", word[k]);
        expect(vesica(NULL, "explain %s", word[k]), 0, k < 9 ? NULL : want, NULL, word[k]);
        outcome o = vesica(NULL, "explain %s", word[k]);
        cr_assert(strstr(o.out, ": a name ") != NULL, "%s: %s", word[k], o.out);
        done(&o);
    }
    expect(vesica(NULL, "explain trace"), 0, "trace.jsonl", NULL, "trace");
    expect(vesica(NULL, "explain ml"), 0, "1 ml = 1e-06 m^3\n", NULL, "ml");
    root_remove();
}

Test(cli_words, a_curve_that_crosses_itself_is_named)
{
    root_make();
    tube_write("eight.yaml", "minimize: area\nvariables: {h: [1, 2, 3]}",
               "{formula: [\"sin(2*v)\", \"sin(v)\", h]}");
    expect(vesica(NULL, "check eight.yaml"), 1, NULL,
           "eight.yaml:4:36: warning: curve \"q\" crosses itself at v = 0 and v = 3.142, both at (0, 0, 2)",
           "eight");
    /* not at a node: r = 1/2 + cos v comes through the origin at v = 2 pi/3 and 4 pi/3 */
    tube_write("loop.yaml", "minimize: area\nvariables: {h: [1, 2, 3]}",
               "{formula: [\"(0.5 + cos(v))*cos(v)\", \"(0.5 + cos(v))*sin(v)\", h]}");
    expect(vesica(NULL, "check loop.yaml"), 1, NULL, "crosses itself at v = 2.094 and v = 4.189", "loop");
    /* pressed flat it runs over its own way back, and in space it passes above itself */
    static const char *const sound[] = {
        "{circle: {radius: 1, centre: [0, 0, h]}, apply: [{dilate: [1, 0, 1]}]}",
        "{formula: [\"2*sin(2*v)\", \"2*sin(v)\", \"h + 0.1*cos(v)\"]}",
        "{formula: [\"2*cos(v)\", \"2*sin(v)\", h]}"};
    for (int k = 0; k < 3; k++) {
        tube_write("sound.yaml", "minimize: area\nvariables: {h: [1, 2, 3]}", sound[k]);
        outcome o = vesica(NULL, "check sound.yaml");
        cr_assert(strstr(o.err, "crosses itself") == NULL, "%s: %s", sound[k], o.err);
        done(&o);
    }
    root_remove();
}

Test(cli_words, decks_need_a_shell)
{
    root_make();
    tube_write("tube.yaml", "", "{circle: {radius: 1, centre: [0, 0, 3]}}");
    tube_write("wall.yaml",
               "shell: {parts: {w: {thickness: 0.01}}, material: {E: 1e6, nu: 0.3}, supports: [{at: "
               "w.u0, fix: all}], cases: "
               "{a: [{at: w.u1, line: [0, 0, -1]}]}}",
               "{circle: {radius: 1, centre: [0, 0, 3]}}");
    expect(vesica(NULL, "export tube.yaml --to stl,inp"), 2, NULL, "--to inp needs the section \"shell\"",
           "none");
    expect(vesica(NULL, "export wall.yaml --to stl --buckling 2"), 2, NULL,
           "--buckling: no format of --to \"stl\" has load cases; add inp", "no deck");
    expect(vesica(NULL, "export wall.yaml --to inp --buckling 0"), 2, NULL, "a whole number from 1 to 100",
           "none");
    expect(vesica(NULL, "export wall.yaml --to inp --grid 9x12"), 2, NULL, "give a --grid of even numbers",
           "odd");
    expect(vesica(NULL, "export wall.yaml --to stl,inp --buckling 3"), 0, "wall.stl\nwall.inp\n", NULL,
           "both");
    char *deck = slurp("wall.inp");
    cr_assert(strstr(deck, "*BUCKLE\n3, 1e-6, 20, 5000\n") != NULL && strstr(deck, "** case a\n") != NULL);
    free(deck);
    root_remove();
}

Test(cli_words, spines_are_written_beside_the_shape)
{
    root_make();
    tube_write("tube.yaml", "", "{circle: {radius: 1, centre: [0, 0, 3]}}");
    write_file("sheet.yaml",
               "vesica: 1\npatches: {s: {surface: {formula: [\"cos(v)\", \"sin(v)\", \"u\"]}}}\n");
    outcome o = vesica(NULL, "export tube.yaml --to vtp,stl,obj,csv --spines --grid 2x12");
    cr_assert(eq(int, o.code, 0), "%s", o.err);
    cr_assert(
        eq(str, o.out,
           "tube.vtp\ntube-spines.vtp\ntube.stl\ntube.obj\ntube-spines.obj\ntube.csv\ntube-spines.csv\n"));
    done(&o);
    char *csv = slurp("tube-spines.csv");
    cr_assert(eq(int, count(csv, "\n"), 4), "%s", csv);
    free(csv);
    expect(vesica(NULL, "export tube.yaml --to csv"), 0, "tube-2.csv", NULL, "no spines unless asked for");
    expect(vesica(NULL, "export tube.yaml --to stl,off --spines"), 2, NULL,
           "no format of --to \"stl,off\" has lines; add vtp, obj or csv", "meshes");
    expect(vesica(NULL, "export sheet.yaml --to vtp --spines"), 2, NULL,
           "no patch of this shape has a spine: none is the solution of a PDE", "a sheet");
    expect(vesica(NULL, "show tube.yaml --spines"), 0, "tube.png", NULL, "show");
    /* the axis, straight, with its speed and no curvature */
    o = vesica(NULL, "sample tube.yaml --spine 3");
    cr_assert(strstr(o.out, "u,x,y,z,xu,yu,zu,xuu,yuu,zuu\n0,") == o.out, "%s", o.out);
    double at[10];
    const char *line = strstr(o.out, "\n0.5,") + 1;
    for (int k = 0; k < 10; k++) at[k] = strtod(line, (char **)&line), line++;
    static const double want[] = {0.5, 0, 0, 1.5, 0, 0, 3, 0, 0, 0};
    for (int k = 0; k < 10; k++) cr_assert(fabs(at[k] - want[k]) < 1e-14, "%d: %.17g", k, at[k]);
    done(&o);
    root_remove();
}
