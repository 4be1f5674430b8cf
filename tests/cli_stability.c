/* vesica stability, as a user meets it. */
#include <criterion/criterion.h>
#include <unistd.h>

#include "program.h"

#define BALL(formula, c0)                                                                                    \
    "vesica: 1\nparameters: {c: 1}\npatches:\n  ball: {surface: {formula: " formula                          \
    "}, domain: {u: [0, pi]}}\n"                                                                             \
    "shape: {closed: true}\nquadrature: {u: 16, v: 8}\nmeasures:\n  E: {canham: {" c0 ": c}}\n"
#define SPHERE "[\"sin(u)*cos(v)\", \"sin(u)*sin(v)\", \"cos(u)\"]"
#define ROUND  BALL(SPHERE, "reduced_c0")
#define SIZED  BALL(SPHERE, "c0")

static const char sphere[] = ROUND "minimize: E/(8*pi)\nscale: {equation: area == 4*pi}\n";
static const char oval[] =
    BALL("[\"1.2*sin(u)*cos(v)\", \"sin(u)*sin(v)\", \"cos(u)\"]", "c0") "minimize: E\n";
static const char idle[] = ROUND "constraints: [area <= 20]\n";
static const char pole[] =
    "vesica: 1\npatches:\n  ring: {surface: {formula: [\"(2+cos(2*pi*u))*cos(v)\", "
    "\"(2+cos(2*pi*u))*sin(v)\", \"sin(2*pi*u)\"]}}\nquadrature: {u: 16, v: 8}\nminimize: area\n";

/* A vesicle of one parameter, by two patches of order 4. */
static const char drop[] =
    "vesica: 1\nparameters: {nu: 0.95}\nvariables: {h: [0.3, 0.8, 3], m: [0.3, 1.4, 3], d: [0.3, 1.4, 3]}\n"
    "curves:\n  north: {point: [0, 0, h]}\n  south: {point: [0, 0, -h]}\n  rim: {circle: {radius: 1}}\n"
    "  out: {formula: [\"cos(v)\", \"sin(v)\", \"0\"]}\n  back: {like: out, apply: [{dilate: -1}]}\n"
    "  down: {point: [0, 0, -1]}\npatches:\n"
    "  top: {operator: {power: 2, a: 1}, conditions: [{u: 0, position: north}, {u: 0, derivative: 1, field: "
    "out, "
    "scale: m}, {u: 1, position: rim}, {u: 1, derivative: 1, field: down, scale: d}]}\n"
    "  bottom: {operator: {power: 2, a: 1}, conditions: [{u: 0, position: rim}, {u: 0, derivative: 1, field: "
    "down, "
    "scale: d}, {u: 1, position: south}, {u: 1, derivative: 1, field: back, scale: m}]}\n"
    "shape: {closed: true}\nquadrature: {u: 24, v: 8}\nscale: {equation: area == 4*pi}\n"
    "measures: {E: {canham: {}}}\nminimize: E/(8*pi)\nconstraints: [reduced_volume == nu]\n"
    "search: [{polish: {}}]\n";

Test(cli_stability, what_it_prints_and_its_exit_code)
{
    root_make();
    write_file("sphere.yaml", sphere);
    expect(vesica(NULL, "stability sphere.yaml"), 0, "softest mode is n = ", NULL, "stable");
    expect(vesica(NULL, "stability sphere.yaml"), 0, "held        area", NULL, "stable");
    expect(vesica(NULL, "stability sphere.yaml --set c=6.5 --modes 2"), 1, "unstable", NULL, "unstable");
    expect(vesica(NULL, "stability sphere.yaml --set c=6.5 --json --modes 0"), 1, "\"verdict\": \"unstable\"",
           NULL, "json");
    expect(vesica(NULL, "stability sphere.yaml --modes 2 --png modes.svg"), 0, NULL, NULL, "a picture");
    cr_expect(access("modes.svg", R_OK) == 0);
    expect(vesica(NULL, "stability sphere.yaml --modes 0 --png modes.gif"), 2, NULL, "modes.gif", "gif");
    expect(vesica(NULL, "stability sphere.yaml --modes 13"), 2, NULL, "--modes needs", "13");
    expect(vesica(NULL, "stability sphere.yaml --functions 5"), 2, NULL, "--functions needs", "5");
    expect(vesica(NULL, "stability"), 2, NULL, "something is missing", "nothing");
    write_file("held.yaml", SIZED "minimize: E/(8*pi)\nconstraints: [\"area >= 4*pi\"]\n");
    expect(vesica(NULL, "stability held.yaml --set c=7 --modes 2"), 1, "held        area >= 4*pi", NULL,
           "pushes"); /* (l - 1)(l + 2)(l (l + 1) - c)/(8 pi), l = 2 */
    expect(vesica(NULL, "stability held.yaml --set c=7 --modes 2"), 1, " with -0.1592 +- ", NULL, "pushes");
    write_file("loose.yaml", SIZED "minimize: E/(8*pi)\nconstraints: [\"area <= 4*pi\"]\n");
    expect(vesica(NULL, "stability loose.yaml --set c=7 --modes 0"), 1,
           "  verdict     unknown: only at a stationary shape do eigenvalues tell", NULL, "does not push");
    write_file(
        "many.yaml", ROUND
        "scale: {equation: area == 4*pi}\nminimize: E/(8*pi)\nconstraints: [volume >= 0, "
        "\"volume == 4*pi/3\", \"2*volume == 8*pi/3\", \"3*volume == 4*pi\", \"4*volume == 16*pi/3\", "
        "\"5*volume == 20*pi/3\", \"6*volume == 8*pi\", \"7*volume == 28*pi/3\", \"8*volume == 32*pi/3\"]\n");
    outcome o = vesica(NULL, "stability many.yaml --modes 0");
    cr_expect(strstr(o.out, " and 1 more\n  functions ") != NULL, "%s%s", o.out, o.err);
    done(&o);
    root_remove();
}

Test(cli_stability, what_it_refuses)
{
    root_make();
    write_file("oval.yaml", oval);
    write_file("idle.yaml", idle);
    write_file("pole.yaml", pole);
    expect(vesica(NULL, "stability oval.yaml"), 2, NULL, "is not round", "oval");
    expect(vesica(NULL, "stability idle.yaml"), 2, NULL, "no objective", "idle");
    expect(vesica(NULL, "stability pole.yaml"), 2, NULL, "has no pole", "pole");
    expect(vesica(NULL, "stability " PROBLEMS "bottle.yaml"), 2, NULL, "has a crease", "bottle");
    write_file("far.yaml", ROUND "minimize: E\nconstraints: [max_curvature <= 9]\n");
    expect(vesica(NULL, "stability far.yaml"), 0, NULL, NULL, "it does not touch");
    write_file("near.yaml", ROUND "minimize: E + max_curvature\n");
    expect(vesica(NULL, "stability near.yaml"), 2, NULL, "reads more than surfaces", "near");
    write_file("tilted.yaml", ROUND
               "  W: {adhesion: {at: [0, 0, -1], normal: [1, 0, 1], w: 1, range: 1}}\nminimize: E + W\n");
    expect(vesica(NULL, "stability tilted.yaml"), 2, NULL, "turned about its own axis", "tilted");
    root_remove();
}

Test(cli_stability, runs_their_optima_and_points_of_sweeps)
{
    root_make();
    write_file("drop.yaml", drop);
    expect(vesica(NULL, "run drop.yaml --out r --progress none"), 0, NULL, NULL, "run");
    outcome whole = vesica(NULL, "stability r --modes 2"), part = vesica(NULL, "stability r:1 --modes 2");
    cr_expect(whole.code == 1 && strcmp(whole.out, part.out) == 0, "%s%s\n%s%s", whole.out, whole.err,
              part.out, part.err); /* an oblate of 0.95 is unstable against n = 2 */
    cr_expect(strstr(whole.out, "softest mode is n = 2") != NULL && strstr(whole.out, "variables  ") != NULL,
              "%s", whole.out);
    done(&whole), done(&part);
    expect(vesica(NULL, "stability r:2"), 2, NULL, "has no optimum 2", "r:2");
    expect(vesica(NULL, "sweep drop.yaml --over nu=0.95,0.96 --out s --progress none"), 0, NULL, NULL,
           "sweep");
    whole = vesica(NULL, "eval s:1"), part = vesica(NULL, "stability s:1 --modes 0");
    cr_expect(whole.code == 0 && strstr(whole.out, "0.96") != NULL, "%s%s", whole.out, whole.err);
    cr_expect(part.code == 0, "%s%s", part.out, part.err);
    done(&whole), done(&part);
    expect(vesica(NULL, "stability s:7"), 2, NULL, "there is no point 7", "s:7");
    write_file("large.yaml", ROUND "minimize: E\nconstraints: [area >= 1000]\n");
    expect(vesica(NULL, "run large.yaml --out large --progress none"), 1, NULL, NULL, "infeasible");
    expect(vesica(NULL, "stability large --modes 1"), 0,
           "not feasible: area >= 1000 is missed by 0.99 of its size", NULL, "infeasible");
    expect(vesica(NULL, "stability ."), 2, NULL, "\".\" is not the folder of a finished run", "no run");
    expect(vesica(NULL, "stability nowhere:3"), 2, NULL, "cannot open \"nowhere:3\"", "nowhere");
    expect(vesica(NULL, "stability s"), 2, NULL, "\"s\" is a sweep: name one of its points, s:0 to s:1", "s");
    root_remove();
}

/* A sphere that can be drawn out: with c0 = 7 it is unstable and both ways lead lower, with c0 = 0 it is not and both come
 * back; n = 2 is none of its shapes. */
Test(cli_stability, a_mode_is_followed)
{
    root_make();
    write_file("p.yaml",
               "vesica: 1\ntitle: Drawn out\nparameters: {c: 7}\nvariables: {e: [-0.4, 0, 0.6]}\npatches:\n  "
               "ball: {surface: {formula: "
               "[\"(1+e*(1.5*cos(u)^2-0.5))*sin(u)*cos(v)\", \"(1+e*(1.5*cos(u)^2-0.5))*sin(u)*sin(v)\", "
               "\"(1+e*(1.5*cos(u)^2-0.5))*cos(u)\"]}, domain: {u: [0, pi]}}\nshape: {closed: true}\n"
               "quadrature: {u: 16, v: 8}\nscale: {equation: area == 4*pi}\nmeasures: {E: {canham: "
               "{reduced_c0: c}}}\n"
               "minimize: E/(8*pi)\nkinds: {long: e > 0.01, flat: e < -0.01}\nsearch: [{polish: {}}]\n");
    outcome o = vesica(NULL, "stability p.yaml --modes 0 --follow softest");
    cr_expect(
        o.code == 1 && strstr(o.out, "  along       n = 0: the variables of the file make 100 % of it\n") &&
            strstr(o.out, " lower: long   runs/p-0001\n") && strstr(o.out, " lower: flat   runs/p-0002\n"),
        "%s%s", o.out, o.err);
    done(&o);
    cr_expect(count_of("runs/p-0001/result.json", "\"kind\": \"long\"") >= 1);
    o = vesica(NULL, "stability p.yaml --modes 0 --set c=0 --follow 0 --no-files");
    cr_expect(o.code == 0 && strstr(o.out, "one way      comes back to the design: none of these\n") &&
                  strstr(o.out, "other way    comes back to the design: none of these\n"),
              "%s%s", o.out, o.err);
    done(&o);
    expect(vesica(NULL, "stability p.yaml --follow 2 --no-files"), 1, "which is too little to follow", NULL,
           "n = 2");
    expect(vesica(NULL, "stability p.yaml --modes 0 --follow 0 --json --no-files"), 1, "\"along\": {",
           "  one way ", "json");
    expect(vesica(NULL, "stability p.yaml --follow far"), 2, NULL, "--follow needs softest or", "far");
    root_remove();
}
