#include <math.h>

#include "measure/argument.h"
#include "measure/cut.h"

enum { AXIS };

static const ves_key KEYS[] = {{.name = "axis",
                                .kind = VES_VECTOR,
                                .unit = "1",
                                .about = "the way the mould opens, [0, 1, 0] unless given; any length"},
                               {.name = NULL}};

/* room: f, 1 and d / d f of a row, then what a cut takes. */
static size_t room(const ves_measure_input *input)
{
    size_t most = 0;
    for (int i = 0; i < input->samples; i++) {
        size_t nu = (size_t)input->sample[i]->nu;
        if (input->sample[i]->site == VES_SITE_SURFACE && nu > most) most = nu;
    }
    return 3 * most + ves_cut_room((int)most);
}

/* f is -n . axis for each du dv. */
static ves_cut_row row_init(const ves_measure_input *input, const ves_samples *s, int j, const double axis[3])
{
    double *f = input->room, *g = f + s->nu;
    for (int i = 0; i < s->nu; i++) {
        int n = j * s->nu + i;
        double along = axis[0] * s->normal[0][n] + axis[1] * s->normal[1][n] + axis[2] * s->normal[2][n];
        f[i] = -along * s->dA[n] / s->weight[n];
        g[i] = 1;
    }
    return (ves_cut_row){.s = s, .j = j, .f = f, .g = g, .room = f + 3 * s->nu};
}

/* The area of what faces along the axis, seen along it: integral of max(0, n . axis) dA, n outward. It is 0 where
 * there is no undercut, and grows with the square of the angle past that: it has a gradient everywhere, without
 * smoothing. (The area itself would jump where a wall stands along the axis.) Caps do not count, so that an open mouth
 * is none. Rows are cut where the wall turns (measure/cut.h).
 * test  ball: its upper half, pi R^2; torus; leaning ellipsoid; order; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    double sum = 0;
    VES_TRY(ves_direction_init(input, AXIS, &d));
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        for (int j = 0; s->site == VES_SITE_SURFACE && j < s->nv; j++) {
            ves_cut_row row = row_init(input, s, j, d.unit);
            sum -= ves_cut_weight(s, j) * ves_cut_eval(&row);
        }
    }
    *value = sum;
    return VES_OK;
}

static void scatter(const ves_cut_row *row, const double axis[3], const double *f_back,
                    const ves_adjoint *adjoint, double axis_back[3])
{
    const ves_samples *s = row->s;
    for (int i = 0; i < s->nu; i++) {
        int n = row->j * s->nu + i;
        double g = -f_back[i] / s->weight[n], along = 0;
        for (int c = 0; c < 3; c++) {
            along += axis[c] * s->normal[c][n];
            axis_back[c] += g * s->dA[n] * s->normal[c][n];
        }
        if (!adjoint->dA) continue;
        adjoint->dA[n] += g * along;
        for (int c = 0; c < 3; c++) adjoint->normal[c][n] += g * s->dA[n] * axis[c];
    }
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double back[3] = {0};
    if (ves_direction_init(input, AXIS, &d) != VES_OK) return;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        for (int j = 0; s->site == VES_SITE_SURFACE && j < s->nv; j++) {
            ves_cut_row row = row_init(input, s, j, d.unit);
            double *f_back = input->room + 2 * s->nu;
            for (int k = 0; k < s->nu; k++) f_back[k] = 0;
            ves_cut_gradient(&row, -seed * ves_cut_weight(s, j), f_back, NULL);
            scatter(&row, d.unit, f_back, adjoint[i], back);
        }
    }
    ves_direction_gradient(input, AXIS, &d, back, number_adjoint);
}

const ves_measure ves_measure_undercut = {
    .name = "undercut",
    .about = "how much of the wall is undercut: the area of what faces along an axis, seen along it; caps do "
             "not count",
    .unit = "m^2",
    .degree = 2,
    .surface = VES_NORMAL | VES_AREA,
    .closed = true,
    .keys = KEYS,
    .room = room,
    .eval = eval,
    .gradient = gradient};
