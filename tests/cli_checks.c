/* What a file asks of its bests (validity: holds), as a user meets it. */
#include <criterion/criterion.h>

#include "base/vector.h"
#include "program.h"

/* A sphere with a rim that stands between the nodes: its height is the same on every grid, so that
 * the proof has nothing to compare. Whatever closed shape it is, its Gauss curvature amounts to 4 pi. */
#define RIM "(1 + s*exp(-((u - 0.5)/0.03)^2))"
#define SPHERE                                                                                               \
    "vesica: 1\nvariables: {s: [0, 0, 0.3]}\nquadrature: {u: 8, v: 8}\n"                                     \
    "patches: {ball: {surface: {formula: [\"" RIM "*sin(pi*u)*cos(v)\", \"" RIM                              \
    "*sin(pi*u)*sin(v)\", \"" RIM "*cos(pi*u)\"]}}}\nmaximize: s\n"

Test(cli_checks, a_shape_that_cheats_between_the_nodes_is_refused_by_what_the_file_asks)
{
    root_make();
    write_file("plain.yaml", SPHERE "validity: {jacobian: any}\n");
    write_file("holds.yaml", SPHERE "validity: {jacobian: any, holds: [abs(gauss_curvature - 4*pi) < 1]}\n");
    expect(vesica(NULL, "run plain.yaml --evaluations 300 --out plain"), 0, "best   range", NULL, "plain");
    expect(vesica(NULL, "run holds.yaml --evaluations 300 --out holds"), 0,
           "abs(gauss_curvature - 4*pi) < 1   holds", NULL, "holds");
    char *text[2] = {slurp("plain/result.json"), slurp("holds/result.json")};
    json plain = json_of(text[0]), held = json_of(text[1]);
    cr_expect(number(&plain, "objective", NULL) > 0.25, "%g", number(&plain, "objective", NULL));
    cr_expect(number(&held, "objective", NULL) < 0.01, "%g", number(&held, "objective", NULL));
    cr_expect(fabs(number(&held, "measures", "gauss_curvature") - 4 * VES_PI) < 1);
    json_done(&plain);
    json_done(&held);
    free(text[0]);
    free(text[1]);
    char *log = slurp("holds/log.txt");
    cr_expect(strstr(log, "a best was refused by its proof: a check of the file does not hold: "
                          "\"abs(gauss_curvature - 4*pi) < 1\", with gauss_curvature = ") != NULL,
              "%s", log);
    free(log);
    /* gone on with, the proof that the sentence is about comes from the journal */
    cr_assert(system("cp -r holds part && rm part/result.json && truncate -s 9000 part/journal") == 0);
    expect(vesica(NULL, "run --resume part --jobs 2"), 0, "a best was refused by its proof", NULL, "resume");
    same_file("holds/result.json", "part/result.json");
    expect(vesica(NULL, "check holds.yaml --set s=0.2"), 1, "DOES NOT HOLD",
           "holds.yaml:6:35: warning: the design did not pass its checks: a check of the file does not hold",
           "check");
    write_file("sweep.yaml", SPHERE
               "parameters: {K: 4*pi}\nvalidity: {jacobian: any, holds: [abs(gauss_curvature - K) < 1]}\n"
               "start: {s: 0.2}\nsweep: {over: {K: [12, 12.5]}}\n");
    expect(
        vesica(NULL, "sweep sweep.yaml --out sweep"), 1,
        "lost       at K = 12 ... 12.5: the best did not pass its checks: a check of the file does not hold: "
        "\"abs(gauss_curvature - K) < 1\", with gauss_curvature = ",
        NULL, "sweep");
    root_remove();
}
