#include "base/vector.h"
#include "measure/argument.h"
#include "shell/view.h"

enum { CASE, AT, ALONG };

static const ves_key KEYS[] = {VES_SHELL_CASE,
                               {.name = "at",
                                .kind = VES_SHELL_HELD,
                                .required = true,
                                .about = "where: a curve, an edge or a place that a support names"},
                               {.name = "along",
                                .kind = VES_VECTOR,
                                .required = true,
                                .unit = "1",
                                .about = "the part along this direction, with its sign"},
                               {.name = NULL}};

/* What the supports there do to the whole shell (shell/reaction.c): with those of all others it is against its loads.
 * test  equilibrium of strips, sectors, quarters and whole shells; a propped cantilever */
static ves_status eval(const ves_measure_input *input, double *value)
{
    const ves_shell_view *view = input->shell;
    const ves_arg *arg = input->args->arg;
    ves_direction d;
    double F[3];
    VES_TRY(ves_direction_init(input, ALONG, &d));
    ves_shell_reaction(view->shell, arg[CASE].value, &view->grip[arg[AT].value], F);
    *value = 0;
    for (int c = 0; c < 3; c++) *value += d.unit[c] * view->copies * ves_dot(view->share[c], F);
    return VES_OK;
}

const ves_measure ves_measure_reaction = {.name = "reaction",
                                          .about = "force with which supports hold the shell",
                                          .unit = "N",
                                          .degree = VES_NO_DEGREE,
                                          .cost = 1,
                                          .shell = true,
                                          .keys = KEYS,
                                          .eval = eval};
