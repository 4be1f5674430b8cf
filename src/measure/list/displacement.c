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

/* Where the largest of all is. */
static void largest_at(const ves_measure_input *input, const ves_direction *d, ves_shell_spot *spot)
{
    const ves_shell_model *m = input->shell->model;
    double most = -1;
    for (int k = 0; k < m->sheets; k++)
        for (int s = 0; s < ves_shell_rows(&m->sheet[k]) * ves_shell_columns(&m->sheet[k]); s++) {
            double U[3];
            moved(input, k, s, U);
            double here = fabs(part(input, d, U));
            if (here > most) most = here, spot->sheet = k, spot->s = s;
        }
}

/* What is asked at a node: its displacement, of the whole shell. */
static ves_shell_spot spot_of(const ves_measure_input *input, const ves_direction *d)
{
    ves_shell_spot spot = {.edge = -1, .map = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (input->args->arg[AT].given) return input->shell->spot[input->args->arg[AT].value];
    largest_at(input, d, &spot);
    return spot;
}

/* The mean along an edge, of the whole shell. */
static void along_edge(const ves_measure_input *input, const ves_shell_spot *spot, double mean[3])
{
    const ves_shell_view *view = input->shell;
    double sum[3] = {0};
    ves_shell_edge_mean(view->shell, input->args->arg[CASE].value, spot->sheet, spot->edge, sum);
    for (int c = 0; c < 3; c++) mean[c] = ves_dot(view->share[c], sum);
}

static void whole(const ves_measure_input *input, const ves_shell_spot *spot, double U[3])
{
    double here[3];
    if (spot->edge >= 0) {
        along_edge(input, spot, U);
        return;
    }
    moved(input, spot->sheet, spot->s, here);
    for (int c = 0; c < 3; c++) U[c] = ves_dot(spot->map[c], here);
}

/* Of the nodes of the mid-surface.
 * test  closed forms of beams, plates and pressed shells */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    VES_TRY(ves_direction_init(input, ALONG, &d));
    double U[3];
    const ves_shell_spot spot = spot_of(input, &d);
    whole(input, &spot, U);
    *value = spot.edge >= 0 ? ves_dot(d.unit, U) : part(input, &d, U);
    if (!input->args->arg[AT].given) *value = fabs(*value);
    return VES_OK;
}

/* on: d J / d displacement of the whole shell. */
static void scatter(const ves_measure_input *input, const ves_shell_spot *spot, const double on[3])
{
    ves_shell_reading *r = &input->shell->reading[input->args->arg[CASE].value];
    const bool edge = spot->edge >= 0;
    const double(*map)[3] = edge ? input->shell->share : spot->map;
    for (int c = 0; c < 3; c++) {
        double here = 0;
        for (int i = 0; i < 3; i++) here += map[i][c] * on[i];
        if (edge)
            r->mean[spot->sheet][spot->edge][c] += here;
        else
            r->U[spot->sheet][c][spot->s] += here;
    }
    *(edge ? &r->meant : &r->moved) = true;
}

/* The largest: that of the node where it is. */
static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double U[3], on[3], back[3];
    (void)adjoint;
    if (ves_direction_init(input, ALONG, &d) != VES_OK) return;
    const ves_shell_spot spot = spot_of(input, &d);
    whole(input, &spot, U);
    const double length = sqrt(ves_dot(U, U)), along = ves_dot(d.unit, U);
    const bool directed = spot.edge >= 0 || input->args->arg[ALONG].given;
    if (!input->args->arg[AT].given && directed && along < 0) seed = -seed;
    for (int c = 0; c < 3; c++) {
        on[c] = seed * (directed ? d.unit[c] : length > 0 ? U[c] / length : 0);
        back[c] = seed * U[c];
    }
    if (directed) ves_direction_gradient(input, ALONG, &d, back, number_adjoint);
    scatter(input, &spot, on);
}

const ves_measure ves_measure_displacement = {.name = "displacement",
                                              .about = "how far the shell moves, somewhere or at most",
                                              .unit = "m",
                                              .degree = VES_NO_DEGREE,
                                              .cost = 1,
                                              .shell = true,
                                              .keys = KEYS,
                                              .eval = eval,
                                              .gradient = gradient};
