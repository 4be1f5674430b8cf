/* What supports leave free is seen and told, however the shell is cut into sectors: by hand, each motion that is left is
 * plain. Lengths without units; walls of Et = 1e5. */
#include <math.h>
#include <stdio.h>

#include "bed.h"

/* Round; oval, or with six ridges, by a formula of r. */
static const char TUBE[] = "vesica: 1\n"
                           "patches:\n"
                           "  wall:\n"
                           "    surface: {formula: [\"2*cos(v)%s\", \"3*u\", \"2*sin(v)%s\"]}\n"
                           "shell:\n"
                           "  parts: {wall: {thickness: 0.01}}\n"
                           "  material: {E: 1e7, nu: 0.3}\n"
                           "  %s\n"
                           "  supports: [%s]\n"
                           "  cases: {load: [{at: wall.u1, line: [0, -1, 0]}]}\n"
                           "measures:\n"
                           "  d: {displacement: {at: wall.u1, along: [0, 1, 0]}}\n"
                           "  lambda: {buckling: {}}\n"
                           "minimize: %s\n";

/* Two plates, beside each other, apart, at a corner, or folded along their common edge. */
static const char PLATES[] =
    "vesica: 1\n"
    "patches:\n"
    "  one: {surface: {formula: [u, v, 0]}, periodic: false, domain: {u: [0, 1], v: [0, 1]}}\n"
    "  two: {surface: {formula: [%s]}, periodic: false, domain: {u: [0, 1], v: [0, 1]}}\n"
    "shell:\n"
    "  parts: {one: {thickness: 0.01}, two: {thickness: 0.01}}\n"
    "  material: {E: 1e7, nu: 0.3}\n"
    "  supports: [%s]\n"
    "  mesh: {order: 6, elements: [1, 1]}\n"
    "  verify: {order: 6, elements: [1, 1]}\n"
    "  cases: {load: [{over: [two], area: [0, 0, 1]}]}\n"
    "measures: {d: {displacement: {}}}\n"
    "minimize: d\n";

static ves_verdict verdict_of(bed *b, const char *text)
{
    ves_verdict verdict;
    ves_ask ask = {.x = NULL, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    *b = bed_with(text, NULL, 8, 8);
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    return verdict;
}

/* told: of the motion; NULL: it is held. */
static void look(const char *text, const char *told)
{
    bed b;
    char message[1000] = "";
    ves_verdict verdict = verdict_of(&b, text);
    cr_expect_eq(verdict.status, told ? VES_LOOSE : VES_OK, "%s: %s", ves_status_text(verdict.status), text);
    if (told && verdict.status == VES_LOOSE) {
        int before = ves_diag_count(b.diag);
        ves_plan_why(b.plan, VES_LOOSE, "here", b.diag);
        ves_diag_text(b.diag, before, message, sizeof message);
        cr_expect(strstr(message, told) && strstr(message, "test.yaml:"), "\"%s\" of \"%s\": %s", told,
                  message, text);
    }
    if (!told && verdict.status == VES_OK) cr_expect(isfinite(verdict.value), "%g: %s", verdict.value, text);
    bed_clear(&b);
}

static void tube(const char *ridges[2], const char *manner, const char *supports, const char *measure,
                 const char *told)
{
    char text[2000];
    snprintf(text, sizeof text, TUBE, ridges[0], ridges[1], manner, supports, measure);
    look(text, told);
}

static const char CUT[] = "mesh: {order: 6, elements: [2, 6]}\n"
                          "  verify: {order: 6, elements: [2, 6]}",
                  WHOLE[] = "symmetry: none\n"
                            "  mesh: {order: 6, elements: [2, 6]}\n"
                            "  verify: {order: 6, elements: [2, 6]}";
static const char *ROUND[2] = {"", ""}, *OVAL[2] = {"*1.2", ""},
                  *CLOCK = "turn about (0, 1, 0) through (0, 1.5, 0)", *UP = "move along (0, 1, 0)",
                  *SIX[2] = {"*(1 + 0.05*cos(6*v))", "*(1 + 0.05*cos(6*v))"},
                  *SCREW[2] = {"*(1 + 0.05*cos(6*v + u))",
                               "*(1 + 0.05*cos(6*v + u))"}; /* without mirror planes */

/* A strip of the tube, one fold of it, half of one, and all of it say the same. */
Test(shell_loose, turned)
{
    const char *manners[] = {CUT, WHOLE,
                             "mesh: {order: 2, elements: [4, 12]}\n  verify: {order: 6, elements: [2, 6]}"};
    const char *const *shapes[] = {ROUND, SIX, SCREW};
    for (int m = 0; m < 3; m++)
        for (int s = 0; s < 3; s++) {
            const char **shape = (const char **)shapes[s], *manner = manners[m];
            if (m && s == 2) continue;
            tube(shape, manner, "{at: wall.u0, fix: [x, z]}", "d", UP);
            tube(shape, manner, "{diaphragm: [0, 1, 0], at: wall.u0}, {at: wall.u1, fix: [x, z, rx, ry, rz]}",
                 "d", UP);
            tube(shape, manner, "{at: wall.u0, fix: pinned}", "d", NULL);
            tube(shape, manner, "{at: wall.u0, fix: y}, {at: wall.u1, fix: [x, z]}", "d", NULL);
            tube(shape, manner, "{at: wall.u0, spring: [2, 0.1, 2]}", "d", NULL);
            tube(shape, manner, "{at: wall.u0, spring: [2, 0, 2]}", "d", UP);
            tube(shape, manner, "{at: wall.u0, spring: [1e14, 0, 1e14]}", "d", UP);
            tube(shape, manner, "{at: wall.u0, spring: [1e14, 0.1, 1e14]}", "d", NULL);
        }
    tube(ROUND, CUT, "{at: wall.u0, fix: y}", "d", CLOCK);
    tube(ROUND, CUT, "{at: wall.u0, fix: [y, rx, rz]}, {at: wall.u1, fix: [y, rx, rz]}", "d", CLOCK);
    tube(ROUND, CUT, "{at: wall.u0, fix: [y, ry]}", "d", NULL); /* directors lie across the axis */
    tube(SCREW, CUT, "{at: wall.u0, fix: y}", "d", CLOCK);
    tube(ROUND, CUT, "{at: wall.u0, spring: [0, 7, 0]}", "d", CLOCK);
    tube(ROUND, WHOLE, "{at: wall.u0, fix: y}", "d", "move along (1, 0, 0)");
}

/* Of a quarter what is as symmetric as it: its modes of buckling need not be. */
Test(shell_loose, quarter)
{
    tube(OVAL, CUT, "{at: wall.u0, fix: [x, z]}", "d", UP);
    tube(OVAL, CUT, "{at: wall.u0, fix: [y, rx, ry, rz]}", "d", NULL);
    tube(OVAL, CUT, "{at: wall.u0, fix: [y, rx, ry, rz]}", "lambda", "move along (0, 0, 1)");
    tube(OVAL, CUT, "{at: wall.u0, fix: all}", "lambda", NULL);
    tube(ROUND, CUT, "{at: wall.u0, fix: pinned}", "lambda", NULL);
    tube(SIX, CUT, "{at: wall.u0, fix: pinned}", "lambda", NULL);
    tube(OVAL, WHOLE, "{at: wall.u0, fix: y}", "d", "move along (1, 0, 0)");
}

/* Soft and stiff springs hold what they hold exactly: a load q on k moves q / k along, beside what the wall gives. */
Test(shell_loose, springs)
{
    const char *stiff[] = {"1e-2", "1e3", "1e15"};
    for (int sector = 0; sector < 2; sector++)
        for (int s = 0; s < 3; s++) {
            char text[2000], supports[200];
            bed b;
            snprintf(supports, sizeof supports, "{at: wall.u0, spring: [%s, 1e-2, %s]}", stiff[s], stiff[s]);
            snprintf(text, sizeof text, TUBE, "*1.2", "", sector ? CUT : WHOLE, supports, "d");
            ves_verdict verdict = verdict_of(&b, text);
            cr_assert_eq(verdict.status, VES_OK, "%s: %s", ves_status_text(verdict.status), text);
            /* the rounding of elements whose sides are as 1 to 10, over 1e-2 * 2 / 1e5 */
            cr_expect(fabs(verdict.value / -100 - 1) < 1e-5, "%.9g of -100: %s", verdict.value, text);
            bed_clear(&b);
        }
    tube(OVAL, CUT, "{at: wall.u0, spring: [1, 1e-12, 1]}", "d",
         "springs alone keep it from moving along (0, 1, 0)");
    tube(ROUND, CUT, "{at: wall.u0, spring: [1, 1e-12, 1]}", "d",
         "springs alone keep it from moving along (0, 1, 0)");
}

static void plates(const char *second, const char *supports, const char *told)
{
    char text[2000];
    snprintf(text, sizeof text, PLATES, second, supports);
    look(text, told);
}

/* Held along an edge; in parts that are not joined; joined in one point alone, about the normal of which they turn. */
Test(shell_loose, plates)
{
    const char *beside = "1 + u, v, 0", *apart = "3 + u, v, 0", *corner = "1 + u, 1 + v, 0",
               *folded = "1, v, u", *other = "1, 1 + v, u";
    plates(beside, "{at: one.u0, fix: pinned}", "turn about (0, 1, 0) through (0, 0.5, 0)");
    plates(beside, "{at: one.u0, fix: [x, y, z, ry]}", NULL);
    plates(beside, "{at: one.u0, fix: pinned}, {at: two.v0, fix: z}", NULL);
    plates(beside, "{at: one.u0, fix: z}, {at: one.v0, fix: y}, {at: one.v1, fix: z}",
           "move along (1, 0, 0)");
    plates(folded, "{at: one.u0, fix: all}", NULL);
    plates(folded, "{at: one.u1, fix: pinned}", "turn about (0, 1, 0) through (1, 0.5, 0)");
    plates(folded, "{at: one.u1, fix: [x, y, z, rx, rz]}", "turn about (0, 1, 0) through (1, 0.5, 0)");
    plates(folded, "{at: one.u1, fix: [x, y, z, ry]}", NULL);
    plates(apart, "{at: one.u0, fix: all}", "let \"two\" move along (1, 0, 0)");
    plates(apart, "{at: one.u0, fix: all}, {at: two.u0, fix: pinned}",
           "let \"two\" turn about (0, 1, 0) through (3, 0.5, 0)");
    plates(apart, "{at: one.u0, fix: all}, {at: two.u0, fix: all}", NULL);
    plates(corner, "{at: one.u0, fix: all}", "let \"two\" turn about (0, 0, 1) through (1, 1, 0)");
    plates(corner, "{at: one.u0, fix: all}, {at: two.u1, fix: y}", NULL);
    plates(other, "{at: one.u0, fix: all}", "let \"two\" turn about (");
}

/* What is no number or no wall is never measured, and told with its place. */
Test(shell_loose, odd)
{
    static const struct {
        const char *thickness, *line;
        ves_status status;
        const char *told;
    } odd[] = {
        {"0.01", "sqrt(u - 2)", VES_NO_NUMBER, "this load, on \"wall\" at u = 1, v = 0 is not a number"},
        {"0.01", "1/(u - 1)", VES_NO_NUMBER, "this load, on \"wall\" at u = 1, v = 0 is infinite"},
        {"0.01*(u - 0.5)", "1", VES_NO_WALL,
         "the thickness of \"wall\" at u = 0, v = 0 must be > 0, got -0.005"},
        {"sqrt(u - 2)", "1", VES_NO_WALL, "must be > 0, got no number"},
        {"8", "1", VES_DEGENERATE, "8 thick, turns over"}};
    for (size_t k = 0; k < sizeof odd / sizeof *odd; k++) {
        char text[1000], message[1000] = "";
        snprintf(
            text, sizeof text,
            "vesica: 1\npatches: {wall: {surface: {formula: [2*cos(v), 3*u, 2*sin(v)]}}}\n"
            "shell:\n  parts: {wall: {thickness: \"%s\"}}\n  material: {E: 1e7, nu: 0.3}\n"
            "  supports: [{at: wall.u0, fix: all}]\n  cases: {load: [{at: wall.u1, line: [0, \"%s\", 0]}]}\n"
            "measures: {d: {displacement: {}}}\nminimize: d\n",
            odd[k].thickness, odd[k].line);
        bed b;
        ves_verdict verdict = verdict_of(&b, text);
        cr_expect_eq(verdict.status, odd[k].status, "%s: %s", ves_status_text(verdict.status), text);
        int before = ves_diag_count(b.diag);
        ves_plan_why(b.plan, verdict.status, "here", b.diag);
        ves_diag_text(b.diag, before, message, sizeof message);
        cr_expect(strstr(message, odd[k].told) && strstr(message, "test.yaml:"), "%s", message);
        bed_clear(&b);
    }
}
