/* vesica sweep, as a user meets it. */
#include <criterion/criterion.h>

#include "base/vector.h"
#include "program.h"

enum { LINES = 400 };

/* The bottle of problems/bottle.yaml: of all cylinders of area A the largest has h = 2 r, A = 6 pi r^2, so that
 * V = 2 pi (A / 6 pi)^(3/2) and dV/dA = r / 2. */
#define CAN                                                                                                  \
    "variables: {r: [0.2, 0.5, 1.1], h: [0.2, 1.0, 4.0]}\n"                                                  \
    "curves:\n  floor: {point: [0, 0, 0]}\n  lid: {point: [0, 0, h]}\n  low: {circle: {radius: r}}\n"        \
    "  high: {like: low, apply: [{translate: [0, 0, h]}]}\n"                                                 \
    "patches:\n"                                                                                             \
    "  base: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: floor}, {u: 1, position: low}]}\n"   \
    "  wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: high}]}\n"    \
    "  top: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: high}, {u: 1, position: lid}]}\n"     \
    "shape: {closed: true}\nmaximize: volume\nconstraints: [area == A]\n"

static const char can[] = "vesica: 1\nparameters: {A: 3*pi}\n" CAN;

/* A double well in x, tilted by t: (x^2 - 1)^2 + t x, which has two minima while |t| < 8/(3 sqrt(3)) = 1.5396. s adds to
 * all of it. */
#define WELL                                                                                                 \
    "vesica: 1\nparameters: {t: 0, s: 0}\nvariables: {x: [-2, 0.5, 2]}\n"                                    \
    "curves: {low: {circle: {radius: 3 + x}}, high: {like: low, apply: [{translate: [0, 0, 1]}]}}\n"         \
    "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "     \
    "high}]}}\n"                                                                                             \
    "minimize: (x^2 - 1)^2 + t*x + s\nmeasures: {A: {area: {over: [wall]}}}\nconstraints: [A <= 1000]\n"     \
    "quadrature: {u: 8, v: 8}\nvalidity: {self_intersection: never}\n"

static const char well[] = WELL "sweep:\n  over: {t: {from: -2.4, to: 2.4, step: 0.4, walk: both}}\n";

static const char branches[] =
    WELL "sweep:\n  over: {t: {from: -1, to: 1, count: 5, walk: both}, s: [0, 3]}\n"
         "  branches: {left: {set: {x: -1.1, seed: 3}}, right: {set: {x: 1.2}}}\n";

static double price_at(double area)
{
    return sqrt(area / (6 * VES_PI)) / 2;
}

static double volume_at(double area)
{
    return 2 * VES_PI * pow(area / (6 * VES_PI), 1.5);
}

/* --- lines --- */

typedef struct lines {
    int count;
    json line[LINES];
} lines;

static lines *lines_of(const char *path)
{
    lines *l = calloc(1, sizeof *l);
    char *text = slurp(path), *rest;
    for (char *line = strtok_r(text, "\n", &rest); line && l->count < LINES;
         line = strtok_r(NULL, "\n", &rest))
        l->line[l->count++] = json_of(line);
    free(text);
    return l;
}

static void lines_done(lines *l)
{
    for (int k = 0; k < l->count; k++) json_done(&l->line[k]);
    free(l);
}

static const char *word(const json *j, const char *key)
{
    const ves_node *node = ves_node_find(j->root, key);
    cr_assert(node && node->kind == VES_NODE_WORD, "no %s", key);
    return node->text;
}

static double constraint(const json *j, const char *key)
{
    const ves_node *list = ves_node_find(j->root, "constraints");
    const ves_node *node = ves_node_find(list->item[0], key);
    cr_assert(node != NULL, "no %s", key);
    return strtod(node->text, NULL);
}

static void same_sweep(const char *a, const char *b, int points)
{
    static const char *const file[] = {"problem.yaml", "sweep.json", "points.jsonl", "sweep.csv",
                                       "shapes.pvd",   "sweep.png",  "shapes.png"};
    char x[200], y[200];
    for (size_t k = 0; k < sizeof file / sizeof *file; k++) {
        snprintf(x, sizeof x, "%s/%s", a, file[k]);
        snprintf(y, sizeof y, "%s/%s", b, file[k]);
        same_file(x, y);
    }
    for (int k = 0; k < points; k++) {
        snprintf(x, sizeof x, "%s/shapes/%04d.vtp", a, k);
        snprintf(y, sizeof y, "%s/shapes/%04d.vtp", b, k);
        cr_expect((access(x, F_OK) == 0) == (access(y, F_OK) == 0), "%s", x);
        if (access(x, F_OK) == 0) same_file(x, y);
    }
}

/* --- what comes out --- */

/* The price of the limit is the slope of the best over the limit: as the formula has it, and as the neighbours show it,
 * whose central difference is off by h^2/6 V''' < 1e-6. */
Test(cli_sweep, a_front_and_its_prices)
{
    root_make();
    write_file("can.yaml", can);
    expect(vesica(NULL, "sweep can.yaml --over A=8..9:21 --out front"), 0, "price of area == A",
           "21 points in 1 walk", "front");
    lines *l = lines_of("front/points.jsonl");
    cr_assert(l->count == 21);
    for (int k = 0; k < 21; k++) {
        const json *j = &l->line[k];
        double area = number(j, "parameters", "A"), volume = number(j, "objective", NULL);
        double price = constraint(j, "price");
        cr_expect(fabs(area - (8 + k / 20.0)) < 1e-15 * 8, "%d at %.17g", k, area);
        cr_expect(fabs(volume - volume_at(area)) < 1e-8, "%.12g, want %.12g", volume, volume_at(area));
        cr_expect(fabs(price - price_at(area)) < 1e-6, "%.12g, want %.12g", price, price_at(area));
        cr_expect(fabs(number(j, "variables", "h") - 2 * number(j, "variables", "r")) < 1e-5);
        cr_expect(fabs(constraint(j, "value") - area) < 1e-6 * area && constraint(j, "limit") == area);
        cr_expect(!strcmp(word(j, "status"), "ok") && !strcmp(word(j, "best"), "true"));
        if (k < 1 || k > 19) continue;
        double rise = number(j + 1, "objective", NULL) - number(j - 1, "objective", NULL);
        cr_expect(fabs(rise / 0.1 - price) < 2e-6, "%.12g, by differences %.12g", price, rise / 0.1);
    }
    lines_done(l);
    cr_expect(count_of("front/shapes.pvd", "<DataSet ") == 21 &&
              count_of("front/times.jsonl", "wall_s") == 21);
    cr_expect(count_of("front/sweep.csv", ",ok,,1,true,true,") == 21);
    root_remove();
}

/* Rows of the table are in the units of the file, lines in SI. */
Test(cli_sweep, units)
{
    root_make();
    write_file(
        "u.yaml",
        "vesica: 1\nparameters: {V: 150 ml, tilt: 0 deg}\n"
        "variables: {r: [20 mm, 30 mm, 60 mm], h: [20 mm, 60 mm, 120 mm]}\n"
        "curves: {low: {circle: {radius: r}}, high: {like: low, apply: [{rotate: [tilt, 0, 0]}, {translate: "
        "[0 mm, "
        "0 mm, h]}]}}\n"
        "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "
        "high}]}}\n"
        "shape: {caps: [wall.u0, wall.u1], closed: true}\nminimize: area\nconstraints: [volume >= V]\n");
    expect(vesica(NULL, "sweep u.yaml --over V=100ml..200ml:3 --over tilt=0,5deg --out u"), 0, "V [ml]",
           "6 points in 2 walks", "units");
    cr_expect(count_of("u/sweep.csv", "point,walk,direction,V [ml],tilt [deg],status") == 1);
    cr_expect(count_of("u/sweep.csv", ",limit of volume >= V [ml],") == 1);
    cr_expect(count_of("u/sweep.csv", ",r [mm],h [mm],") == 1);
    cr_expect(count_of("u/sweep.csv", ",up,150,0,ok,,1,true,true,") == 1, "%s", slurp("u/sweep.csv"));
    lines *l = lines_of("u/points.jsonl");
    cr_assert(l->count == 6);
    for (int k = 0; k < 6; k++) {
        double V = 1e-4 + k % 3 * 5e-5, tilt = k < 3 ? 0 : 5 * VES_PI / 180;
        cr_expect(fabs(number(&l->line[k], "parameters", "V") - V) < 1e-18);
        cr_expect(fabs(number(&l->line[k], "parameters", "tilt") - tilt) < 1e-15);
    }
    /* straight: an open cylinder, least area of its wall at the bound of r */
    double V = 1.5e-4, r = number(&l->line[1], "variables", "r"), h = number(&l->line[1], "variables", "h");
    cr_expect(fabs(VES_PI * r * r * h - V) < 1e-6 * V);
    lines_done(l);
    /* dimensions whose SI unit is no plain product: a curvature, an energy */
    write_file(
        "w.yaml",
        "vesica: 1\nparameters: {k: 2 um^-1, e: 3 J}\nvariables: {r: [0.2 um, 0.3 um, 0.6 um]}\n"
        "curves: {low: {circle: {radius: r}}, high: {like: low, apply: [{translate: [0 um, 0 um, 1 um]}]}}\n"
        "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "
        "high}]}}\nminimize: e*(1 - k*r)^2\n");
    expect(vesica(NULL, "sweep w.yaml --over k=2um^-1,2.5um^-1 --over e=1J,3J --out w"), 0, "k [um^-1]",
           "4 points in 2 walks", "such units");
    cr_expect(count_of("w/sweep.csv", ",2.5,3,ok,,") == 1, "%s", slurp("w/sweep.csv"));
    cr_expect(count_of("w/sweep.csv", ",0,ok,") == 0 && count_of("w/sweep.csv", ",ok,") == 4);
    root_remove();
}

/* The root of 4 x^3 - 4 x + t = 0 in the well that `side` tells. */
static double root_of(double t, double side)
{
    double x = side * 1.3;
    for (int k = 0; k < 100; k++) x -= (4 * x * x * x - 4 * x + t) / (12 * x * x - 4);
    return x;
}

/* Each walk stays in its well until that ends, at |t| = 1.5396: between, up and down disagree, and it is said. */
Test(cli_sweep, hysteresis)
{
    root_make();
    write_file("w.yaml", well);
    outcome o = vesica(NULL, "sweep w.yaml --out w");
    expect(o, 0, "up and down end at different optima at 7 of 13 values, t = -1.2 ... 1.2",
           "26 points in 2 walks", "well");
    /* the wells change places at t = 0; their depths, t x + ..., are odd in t up to its third power */
    o = vesica(
        NULL,
        "sweep w.yaml --set sweep.over.t.from=-2.2 --set sweep.over.t.to=2.3 --set sweep.over.t.step=0.5 "
        "--out odd --json");
    json odd = json_of(o.out);
    const ves_node *list = ves_node_find(odd.root, "changes");
    cr_assert(list && list->count == 1);
    cr_expect(!strcmp(ves_node_find(list->item[0], "from")->text, "up"));
    cr_expect(fabs(strtod(ves_node_find(list->item[0], "at")->text, NULL)) < 5e-3);
    json_done(&odd);
    done(&o);
    expect(vesica(NULL, "sweep w.yaml --set sweep.over.t.from=-2.2 --set sweep.over.t.to=2.2 --out even"), 0,
           "the best goes from up to down between t = -0.2 ... 0.2, their lines cross at ", NULL, "even");
    lines *l = lines_of("w/points.jsonl");
    cr_assert(l->count == 26);
    for (int k = 0; k < 26; k++) {
        const json *j = &l->line[k];
        double t = number(j, "parameters", "t"), x = number(j, "variables", "x");
        bool up = !strcmp(word(j, "direction"), "up");
        double side = fabs(t) < 1.54 ? (up ? 1 : -1) : t < 0 ? 1 : -1;
        cr_expect(up == (k < 13) && fabs(t - (up ? -2.4 + k * 0.4 : 2.4 - (k - 13) * 0.4)) < 1e-14);
        cr_expect(fabs(x - root_of(t, side)) < 1e-5, "t = %g, %s: %.9g, want %.9g", t, up ? "up" : "down", x,
                  root_of(t, side));
        /* the deeper well is the best; at t = 0 both are */
        bool best = fabs(t) > 1.54 ? up : fabs(t) < 1e-9 ? up : (t < 0) == up;
        cr_expect(best == !strcmp(word(j, "best"), "true"), "t = %g, %s", t, up ? "up" : "down");
        cr_expect(number(j, "optimum", NULL) == (best || fabs(t) > 1.54 ? 1 : 2) || fabs(t) < 1e-9);
    }
    lines_done(l);
    root_remove();
}

/* Named branches stay apart, at every value of the second parameter. */
Test(cli_sweep, branches_and_a_second_parameter)
{
    root_make();
    write_file("b.yaml", branches);
    expect(vesica(NULL, "sweep b.yaml --out b"), 0, "right, s = 3, down", "40 points in 8 walks", "branches");
    lines *l = lines_of("b/points.jsonl");
    cr_assert(l->count == 40);
    for (int k = 0; k < 40; k++) {
        const json *j = &l->line[k];
        double t = number(j, "parameters", "t"), s = number(j, "parameters", "s"), side = k < 20 ? -1 : 1;
        double x = root_of(t, side), value = (x * x - 1) * (x * x - 1) + t * x + s;
        cr_expect(!strcmp(word(j, "branch"), k < 20 ? "left" : "right"));
        cr_expect(s == (k / 10 % 2 ? 3 : 0) && fabs(number(j, "variables", "x") - x) < 1e-5);
        cr_expect(fabs(number(j, "objective", NULL) - value) < 1e-9);
        cr_expect(number(j, "optimum", NULL) == (t == 0         ? (side < 0 ? 1 : 2)
                                                 : t * side < 0 ? 1
                                                                : 2) ||
                  fabs(t) < 1e-9);
    }
    lines_done(l);
    expect(vesica(NULL, "sweep b.yaml --out one --over t=-1..1:3 --json"), 0, "\"branch\": \"left\"",
           "6 points in 2 walks", "over");
    root_remove();
}

/* What cannot be met, measured or read is lost, with a reason; its neighbours are not. */
Test(cli_sweep, lost_points)
{
    root_make();
    write_file("can.yaml", can);
    outcome o = vesica(NULL, "sweep can.yaml --over A=20..44:4 --out up"); /* 35.2 is the most there is */
    expect(o, 1, "lost       at A = 36 ... 44: infeasible: area == A is violated by 0.0", NULL, "up");
    cr_expect(count_of("up/points.jsonl", "\"status\":\"lost\"") == 2 &&
              access("up/shapes/0002.vtp", F_OK) != 0);
    cr_expect(count_of("up/points.jsonl", "\"feasible\":false") == 2 &&
              access("up/shapes/0001.vtp", F_OK) == 0);
    expect(vesica(NULL, "sweep can.yaml --over A=43,44 --out none"), 1, "sweep.png  shapes.pvd",
           "2 points in 1 walk", "none");
    cr_expect(access("up/shapes.png", F_OK) == 0 && access("none/shapes.png", F_OK) != 0);
    expect(vesica(NULL, "sweep can.yaml --over A=44..20:4 --out down"), 1,
           "lost       at A = 44 ... 36: infeasible", NULL, "down");
    lines *l = lines_of("down/points.jsonl");
    cr_assert(l->count == 4);
    for (int k = 2; k < 4; k++) cr_expect(!strcmp(word(&l->line[k], "status"), "ok"));
    lines_done(l);
    /* found from the good one before the gap */
    expect(vesica(NULL, "sweep can.yaml --over A=10,-1,12 --out gap"), 2, NULL, "must rise or fall", "gap");
    write_file("gap.yaml",
               "vesica: 1\nparameters: {A: 3*pi, R: 1}\n" CAN "places: {p: {patch: wall, u: 0.1*R, v: 0}}\n"
               "sweep: {over: {R: [5, 11, 12]}}\n");
    expect(vesica(NULL, "sweep gap.yaml --out gap"), 1, "\"u\" must be in [0, 1]", NULL, "gap");
    cr_expect(count_of("gap/points.jsonl", "\"status\":\"lost\"") == 2);
    /* reasons that differ by more than their numbers have rows of their own */
    write_file("two.yaml", "vesica: 1\nparameters: {A: 3*pi}\n" CAN
                           "places: {p: {patch: wall, u: A/40, v: 0}}\nsweep: {over: {A: [20, 36, 44]}}\n");
    o = vesica(NULL, "sweep two.yaml --out two");
    cr_expect(strstr(o.out, "lost       at A = 36: infeasible") && strstr(o.out, "lost       at A = 44: "),
              "%s", o.out);
    done(&o);
    root_remove();
}

/* --- the same bytes --- */

Test(cli_sweep, the_same_bytes_for_any_number_of_jobs)
{
    root_make();
    write_file("b.yaml", branches);
    expect(vesica(NULL, "sweep b.yaml --out one --jobs 1"), 0, NULL, "1 job\n", "one");
    expect(vesica(NULL, "sweep b.yaml --out two --jobs 2"), 0, NULL, "2 jobs\n", "two");
    expect(vesica(NULL, "sweep b.yaml --out three --jobs 3"), 0, NULL, "3 jobs\n", "three");
    same_sweep("one", "two", 40);
    same_sweep("one", "three", 40);
    root_remove();
}

/* Broken off after each point, and in the middle of a line; with shapes and files of the end that are not there yet. */
Test(cli_sweep, goes_on_where_it_was_broken_off, .timeout = 200)
{
    root_make();
    write_file("w.yaml", well);
    expect(vesica(NULL, "sweep w.yaml --out whole --set sweep.over.t.from=-1.6 --set sweep.over.t.to=1.6 "
                        "--set sweep.over.t.step=0.8 --seed 5"),
           0, NULL, "10 points in 2 walks", "whole");
    char *text = slurp("whole/walks/0001.jsonl");
    size_t at = 0, length = strlen(text);
    for (int part = 0; part <= 15; part++) {
        cr_assert(system("rm -rf part && cp -r whole part && rm part/points.jsonl part/sweep.csv") == 0);
        write_file("part/shapes/.0003.vtp.vesica-77-0.vtp", "half a shape");
        if (part < 15 && part % 3 == 0) {
            char *cut = strndup(text, at);
            write_file("part/walks/0001.jsonl", cut);
            free(cut);
            if (part == 0) cr_assert(unlink("part/walks/0000.jsonl") == 0);
        } else if (part < 15) { /* a third and two thirds into the line */
            size_t line = strcspn(text + at, "\n") + 1;
            char *cut = strndup(text, at + line * (size_t)(part % 3) / 3);
            write_file("part/walks/0001.jsonl", cut);
            free(cut);
            if (part % 3 == 2) at += line;
        }
        expect(vesica(NULL, "sweep --resume part --jobs 2"), 0, NULL, part ? "there already" : NULL,
               "resumed");
        same_sweep("whole", "part", 10);
        cr_expect(access("part/shapes/.0003.vtp.vesica-77-0.vtp", F_OK) != 0 &&
                  access("part/lock", F_OK) != 0);
    }
    cr_expect(at == length);
    free(text);
    root_remove();
}

Test(cli_sweep, survives_kills_and_interrupts, .timeout = 200)
{
    root_make();
    write_file("b.yaml", branches);
    expect(vesica(NULL, "sweep b.yaml --out whole"), 0, NULL, NULL, "whole");
    for (int k = 0; k < 6; k++) {
        pid_t child = launch("sweep b.yaml --out part", NULL, "stdout");
        wait_for_file("part/sweep.json");
        for (int n = 0; n < 3; n++) {
            nanosleep(&(struct timespec){.tv_nsec = 7000000L * (1 + 5 * k + 3 * n)}, NULL);
            kill(child, k % 2 ? SIGKILL : SIGINT);
            int code = wait_for(child);
            cr_expect(code == 0 || code == (k % 2 ? -SIGKILL : 130) ||
                          code == -SIGINT, /* before it listens */
                      "%d: %s", code, slurp("stderr"));
            child = launch("sweep --resume part", NULL, "stdout");
        }
        cr_expect(wait_for(child) == 0);
        same_sweep("whole", "part", 40);
        cr_assert(system("rm -rf part") == 0);
    }
    root_remove();
}

Test(cli_sweep, what_cannot_go_on_says_what_to_do)
{
    root_make();
    write_file("can.yaml", can);
    expect(vesica(NULL, "sweep can.yaml"), 2, NULL, "has no \"sweep\": say over which parameter", "no sweep");
    expect(vesica(NULL, "sweep can.yaml --over B=1..2:3"), 2, NULL, "no parameter \"B\"", "name");
    expect(vesica(NULL, "sweep can.yaml --over r=1..2:3"), 2, NULL, "is a variable", "variable");
    expect(vesica(NULL, "sweep can.yaml --over A=8..9:3 --out a"), 0, NULL, NULL, "a");
    expect(vesica(NULL, "sweep can.yaml --over A=8..9:3 --out a"), 2, NULL, "is not empty", "again");
    expect(vesica(NULL, "sweep --resume a --seed 3"), 2, NULL, "--seed cannot be given with it", "seed");
    expect(vesica(NULL, "sweep a"), 2, NULL, "is a folder", "folder");
    char *line = slurp("a/walks/0000.jsonl");
    char *other = strstr(line, "\"A\":8.5");
    cr_assert(other != NULL);
    other[4] = '7';
    write_file("a/walks/0000.jsonl", line);
    free(line);
    expect(vesica(NULL, "sweep --resume a"), 2, NULL, "line 2 is not point 1 of this sweep", "another sweep");
    write_file("a/sweep.json",
               "{\"version\": \"0.0.1\", \"problem\": \"can.yaml\", \"seed\": 1, \"plugins\": []}");
    expect(vesica(NULL, "sweep --resume a"), 2, NULL, "vesica 0.0.1 has begun the sweep", "another version");
    write_file("a/sweep.json", "{\"version\": ");
    expect(vesica(NULL, "sweep --resume a"), 2, NULL, "is damaged or not whole", "damaged");
    write_file("set.yaml", "vesica: 1\nparameters: {A: 3*pi}\n" CAN
                           "sweep: {over: {A: [8, 9]}, branches: {x: {set: {rr: 1}}}}\n");
    expect(vesica(NULL, "sweep set.yaml"), 2, NULL, "no variable or parameter \"rr\", did you mean \"r\"?",
           "branch");
    write_file("set.yaml",
               "vesica: 1\nparameters: {A: 3*pi}\n" CAN
               "sweep: {over: {A: [8, 9]}, branches: {x: {set: {minimize: bending, maximize: volume}}}}\n");
    expect(vesica(NULL, "sweep set.yaml"), 2, NULL, "", "branch");
    write_file("set.yaml", "vesica: 1\nparameters: {A: 3*pi}\n" CAN
                           "sweep: {over: {A: [8, 9]}, branches: {x: {}, y: {set: {maximize: 2*volume}}}}\n");
    expect(vesica(NULL, "sweep set.yaml"), 2, NULL,
           "set.yaml:16:46: error: what is set here changes what is minimized or maximized", "other goal");
    write_file("set.yaml", "vesica: 1\nparameters: {A: 3*pi}\n" CAN
                           "sweep: {over: {A: [8, 9]}, branches: {x: {set: {constraints.0: area <= A}}}}\n");
    expect(vesica(NULL, "sweep set.yaml"), 2, NULL, "what is set here changes the constraints", "constraint");
    root_remove();
}

Test(cli_sweep, one_process_at_a_time)
{
    root_make();
    write_file("w.yaml", well);
    pid_t child =
        launch("sweep w.yaml --out busy --set sweep.over.t.step=0.001 --progress none", NULL, "stdout.busy");
    wait_for_file("busy/walks/0000.jsonl");
    expect(vesica(NULL, "sweep --resume busy"), 2, NULL, "process", "taken");
    kill(child, SIGINT);
    cr_expect(wait_for(child) == 130);
    cr_expect(count_of("busy/points.jsonl", "\n") > 0 && count_of("busy/points.jsonl", "\n") < 8002);
    root_remove();
}

/* Every point of a sweep, and every optimum of a run, can be where another command begins. */
Test(cli_sweep, begins_elsewhere)
{
    root_make();
    write_file("can.yaml", can);
    write_file("b.yaml", branches);
    expect(vesica(NULL, "sweep can.yaml --over A=8..44:4 --out front"), 1, NULL, NULL, "front");
    lines *l = lines_of("front/points.jsonl");
    outcome o = vesica(NULL, "eval can.yaml --set A=20 --start front:1 --json");
    json j = json_of(o.out);
    for (int k = 0; k < 2; k++)
        cr_expect(number(&j, "variables", k ? "r" : "h") == number(&l->line[1], "variables", k ? "r" : "h"));
    json_done(&j);
    done(&o);
    lines_done(l);
    expect(vesica(NULL, "eval can.yaml --start front"), 2, NULL, "say which of its points, --start front:N",
           "none");
    expect(vesica(NULL, "eval can.yaml --start front:4"), 2, NULL, "there is no point 4", "beyond");
    expect(vesica(NULL, "eval can.yaml --start front:3"), 2, NULL, "point 3 of the sweep \"front\" is lost",
           "lost");
    expect(vesica(NULL, "run b.yaml --set t=0.1 --out run"), 0, NULL, NULL, "run");
    o = vesica(NULL, "eval b.yaml --start run:2 --json");
    j = json_of(o.out);
    cr_expect(fabs(number(&j, "variables", "x") - root_of(0.1, 1)) < 1e-5,
              "the shallower well is the second optimum");
    json_done(&j);
    done(&o);
    expect(vesica(NULL, "eval b.yaml --start run:3"), 2, NULL, "has no optimum 3: it has found 2",
           "optimum 3");
    expect(vesica(NULL, "eval b.yaml --start run:0"), 2, NULL, "has no optimum 0", "optimum 0");
    expect(vesica(NULL, "check b.yaml"), 0, "over t, 5 values, for 2 of s: 40 points in 8 walks", NULL,
           "check");
    root_remove();
}

/* Ranges that depend on the parameter: where the neighbour's best lies beyond them, the search begins at their end. The
 * best radius is 1/sqrt(2), or the largest there is. */
Test(cli_sweep, ranges_that_move)
{
    root_make();
    char text[4000];
    snprintf(text, sizeof text, "vesica: 1\nparameters: {A: 3*pi, R: 1}\n%s", CAN);
    char *range = strstr(text, "1.1]");
    cr_assert(range != NULL);
    memcpy(range, "  R]", 4);
    write_file("can.yaml", text);
    expect(vesica(NULL, "sweep can.yaml --over R=1..0.6:5 --out m"), 0, NULL, NULL, "m");
    lines *l = lines_of("m/points.jsonl");
    cr_assert(l->count == 5);
    for (int k = 0; k < 5; k++) {
        double r = fmin(1 - k * 0.1, 1 / sqrt(2)), h = 1.5 / r - r;
        cr_expect(!strcmp(word(&l->line[k], "direction"), "down"));
        cr_expect(fabs(number(&l->line[k], "variables", "r") - r) < 1e-5, "%d", k);
        cr_expect(fabs(number(&l->line[k], "objective", NULL) - VES_PI * r * r * h) < 1e-6, "%d", k);
    }
    lines_done(l);
    root_remove();
}
