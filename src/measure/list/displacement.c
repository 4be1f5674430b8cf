#include <math.h>

#include "base/vector.h"
#include "measure/argument.h"
#include "shell/view.h"

enum { CASE, AT, ALONG };

static const ves_key KEYS[] = {
    VES_SHELL_CASE,
    {.name = "at",
     .kind = VES_SHELL_AT,
     .about = "where: a place, or the mean along a curve or an edge; unless given the largest of all"},
    {.name = "along",
     .kind = VES_VECTOR,
     .unit = "1",
     .about = "the part along this direction, with its sign; unless given the length, or [0, 1, 0] along a "
              "curve or an edge"},
    {.name = NULL}};

static void moved(const ves_measure_input *input, int sheet, int s, double U[3])
{
    double director[3];
    ves_shell_displacement(input->shell->shell, input->args->arg[CASE].value, sheet, s, U, director);
}

static double part(const ves_measure_input *input, const ves_direction *d, const double U[3])
{
    return input->args->arg[ALONG].given ? ves_dot(d->unit, U) : sqrt(ves_dot(U, U));
}

static double largest(const ves_measure_input *input, const ves_direction *d)
{
    const ves_shell_model *m = input->shell->model;
    double most = 0;
    for (int k = 0; k < m->sheets; k++)
        for (int s = 0; s < ves_shell_rows(&m->sheet[k]) * ves_shell_columns(&m->sheet[k]); s++) {
            double U[3];
            moved(input, k, s, U);
            most = fmax(most, fabs(part(input, d, U)));
        }
    return most;
}

/* The mean along an edge, of the whole shell. */
static void along_edge(const ves_measure_input *input, const ves_shell_spot *spot, double mean[3])
{
    const ves_shell_view *view = input->shell;
    double sum[3] = {0};
    ves_shell_edge_mean(view->shell, input->args->arg[CASE].value, spot->sheet, spot->edge, sum);
    for (int c = 0; c < 3; c++) mean[c] = ves_dot(view->share[c], sum);
}

/* Of the nodes of the mid-surface.
 * test  closed forms of beams, plates and pressed shells */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    VES_TRY(ves_direction_init(input, ALONG, &d));
    if (!input->args->arg[AT].given) {
        *value = largest(input, &d);
        return VES_OK;
    }
    const ves_shell_spot *spot = &input->shell->spot[input->args->arg[AT].value];
    double U[3], here[3];
    if (spot->edge >= 0) {
        along_edge(input, spot, U);
        *value = ves_dot(d.unit, U);
        return VES_OK;
    }
    moved(input, spot->sheet, spot->s, here);
    for (int c = 0; c < 3; c++) U[c] = ves_dot(spot->map[c], here);
    *value = part(input, &d, U);
    return VES_OK;
}

const ves_measure ves_measure_displacement = {.name = "displacement",
                                              .about = "how far the shell moves, somewhere or at most",
                                              .unit = "m",
                                              .degree = VES_NO_DEGREE,
                                              .cost = 1,
                                              .shell = true,
                                              .keys = KEYS,
                                              .eval = eval};
