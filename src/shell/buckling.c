#include "shell/buckling.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "shell/geometric.h"
#include "shell/lanczos.h"

/* Of one layout. */
typedef struct spectrum {
    shell_parts stiff, geometric;  /* stiff.x[0] NULL: it is layout->matrix */
    cholmod_factor *real, *turned; /* of a class; real NULL: that of the loads */
} spectrum;

struct shell_buckling {
    shell_geometric element;
    spectrum *of;        /* [layouts] */
    int prepared, which; /* layout and case whose parts are there; -1: none */
    int waves;           /* a ring: at most */
    double angle;        /* of the turn to the far side */
    double *values[2];   /* of the class at hand: K, K_sigma; complex ones in pairs */
    cholmod_sparse matrix[2];
    cholmod_factor *factor; /* of the class at hand */
    cholmod_dense *solution, *Y, *E;
    ves_lanczos work;
    double *found, *mode; /* of the class at hand, and the one that is kept */
    int mode_layout;
    int mode_wave; /* > 0: it is complex */
    int mode_case;
    bool mode_fine; /* as a gradient needs it */
    double mode_factor, mode_scale;
    struct {
        int layout, wave; /* -1: no mode */
    } * least;            /* [cases] the class of the least factor */
};

/* --- what is made once --- */

static bool turns(const ves_shell *shell)
{
    return shell->model->far != NULL;
}

static bool rings(const ves_shell *shell)
{
    bool any = false;
    for (int k = 0; k < shell->model->sheets; k++) any = any || shell->model->sheet[k].ring;
    return any && turns(shell);
}

static double turn_angle(const ves_shell *shell)
{
    const double(*R)[3] = shell->model->turn;
    double sine[3] = {R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]};
    return atan2(sqrt(ves_dot(sine, sine)), R[0][0] + R[1][1] + R[2][2] - 1);
}

static ves_status parts_make(const shell_layout *layout, bool turned, ves_arena *arena, shell_parts *parts)
{
    for (int k = 0; k < (turned ? 3 : 1); k++) {
        parts->x[k] = ves_arena_doubles(arena, layout->matrix->nzmax);
        if (!parts->x[k]) return VES_MEMORY;
    }
    return VES_OK;
}

static ves_status spectrum_make(ves_shell *shell, int index, ves_arena *arena)
{
    const shell_layout *layout = &shell->layout[index];
    spectrum *of = &shell->buckling->of[index];
    bool turned = turns(shell);
    VES_TRY(parts_make(layout, turned, arena, &of->geometric));
    if (index || turned) VES_TRY(parts_make(layout, turned, arena, &of->stiff));
    if (index) of->real = cholmod_copy_factor(layout->factor, &shell->common);
    if (turned) of->turned = cholmod_copy_factor(layout->factor, &shell->common);
    return (index && !of->real) || (turned && !of->turned) ? VES_MEMORY : VES_OK;
}

ves_status ves_shell_buckling_make(ves_shell *shell, ves_arena *arena)
{
    shell_buckling *b = ves_arena_take(arena, 1, sizeof *b);
    size_t n = 0, most = 0, size = turns(shell) ? 2 : 1;
    if (!b) return VES_MEMORY;
    shell->buckling = b;
    b->prepared = -1, b->mode_layout = -1;
    b->least = ves_arena_take(arena, (size_t)shell->model->cases, sizeof *b->least);
    if (!b->least) return VES_MEMORY;
    ves_shell_buckling_stale(shell);
    b->angle = turns(shell) ? turn_angle(shell) : VES_TWO_PI;
    b->waves = (int)lround(VES_TWO_PI / b->angle) / (rings(shell) ? 16 : 2) + 1;
    if (!turns(shell)) b->waves = 1;
    b->of = ves_arena_take(arena, (size_t)shell->layouts, sizeof *b->of);
    if (!b->of) return VES_MEMORY;
    for (int k = 0; k < shell->layouts; k++) {
        VES_TRY(spectrum_make(shell, k, arena));
        if ((size_t)shell->layout[k].freedoms > n) n = (size_t)shell->layout[k].freedoms;
        if (shell->layout[k].matrix->nzmax > most) most = shell->layout[k].matrix->nzmax;
    }
    for (int k = 0; k < 2; k++) b->values[k] = ves_arena_doubles(arena, size * most);
    b->found = ves_arena_doubles(arena, size * n);
    b->mode = ves_arena_doubles(arena, size * n);
    if (!b->values[0] || !b->values[1] || !b->found || !b->mode) return VES_MEMORY;
    VES_TRY(ves_lanczos_make(size * n, arena, &b->work));
    return ves_shell_geometric_make(shell, arena, &b->element);
}

void ves_shell_buckling_free(ves_shell *shell)
{
    shell_buckling *b = shell->buckling;
    for (int k = 0; b && b->of && k < shell->layouts; k++) {
        cholmod_free_factor(&b->of[k].real, &shell->common);
        cholmod_free_factor(&b->of[k].turned, &shell->common);
    }
    if (!b) return;
    cholmod_free_dense(&b->solution, &shell->common);
    cholmod_free_dense(&b->Y, &shell->common);
    cholmod_free_dense(&b->E, &shell->common);
}

void ves_shell_buckling_stale(ves_shell *shell)
{
    shell_buckling *b = shell->buckling;
    if (!b) return;
    b->prepared = b->mode_layout = -1;
    for (int k = 0; k < shell->model->cases; k++) b->least[k].layout = -1;
}

/* --- the matrices of a layout, and of a class --- */

static ves_status prepare(ves_shell *shell, int index, int which)
{
    shell_buckling *b = shell->buckling;
    shell_layout *layout = &shell->layout[index];
    const spectrum *of = &b->of[index];
    if (b->prepared == index && b->which == which) return VES_OK;
    b->prepared = -1;
    ves_shell_parts_clear(layout, &of->geometric);
    ves_shell_parts_clear(layout, &of->stiff);
    for (int i = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        VES_TRY(ves_shell_geometric_take(shell, e, which, &b->element));
        ves_shell_body body = ves_shell_gather(shell, e);
        int columns = ves_shell_columns_of(shell, layout, e);
        ves_shell_geometric(shell, &body, columns, &b->element);
        ves_shell_element_add(shell, layout, e, columns, &of->geometric);
        if (!of->stiff.x[0]) continue;
        VES_TRY(ves_shell_stiffness(&body, &shell->input->material, columns, shell->column, &shell->scratch,
                                    shell->K));
        ves_shell_springs(shell, e, &body, columns);
        ves_shell_element_add(shell, layout, e, columns, &of->stiff);
    }
    if (of->stiff.x[0]) ves_shell_nodes_add(shell, layout, &of->stiff);
    b->prepared = index, b->which = which;
    return VES_OK;
}

/* [0] + cos a [1] + i sin a [2]. */
static void parts_join(const shell_layout *layout, const shell_parts *of, double angle, bool turned,
                       double *to)
{
    size_t count = layout->matrix->nzmax;
    double co = cos(angle), si = sin(angle);
    for (size_t k = 0; turned && k < count; k++)
        to[2 * k] = of->x[0][k] + co * of->x[1][k], to[2 * k + 1] = si * of->x[2][k];
    for (size_t k = 0; !turned && k < count; k++) to[k] = of->x[0][k] + (of->x[1] ? co * of->x[1][k] : 0);
}

static void class_take(ves_shell *shell, int index, int wave)
{
    shell_buckling *b = shell->buckling;
    const shell_layout *layout = &shell->layout[index];
    bool turned = wave > 0;
    for (int k = 0; k < 2; k++) {
        b->matrix[k] = *layout->matrix;
        b->matrix[k].x = b->values[k];
        b->matrix[k].xtype = turned ? CHOLMOD_COMPLEX : CHOLMOD_REAL;
    }
    parts_join(layout, &b->of[index].geometric, wave * b->angle, turned, b->values[1]);
}

/* K + load K_sigma of a class other than that of the loads, in b->values[0]; *positive: and its factor in b->factor. */
static ves_status class_factor(ves_shell *shell, int index, int wave, double load, bool *positive)
{
    shell_buckling *b = shell->buckling;
    const shell_layout *layout = &shell->layout[index];
    size_t count = layout->matrix->nzmax * (wave > 0 ? 2 : 1);
    parts_join(layout, &b->of[index].stiff, wave * b->angle, wave > 0, b->values[0]);
    for (size_t k = 0; load > 0 && k < count; k++) b->values[0][k] += load * b->values[1][k];
    b->factor = wave > 0 ? b->of[index].turned : b->of[index].real;
    if (!cholmod_factorize(&b->matrix[0], b->factor, &shell->common) && shell->common.status < 0)
        return VES_MEMORY;
    *positive = shell->common.status != CHOLMOD_NOT_POSDEF;
    return VES_OK;
}

/* --- the operator --- */

static cholmod_dense dense(const cholmod_sparse *like, double *x)
{
    return (cholmod_dense){.nrow = like->nrow,
                           .ncol = 1,
                           .nzmax = like->nrow,
                           .d = like->nrow,
                           .x = x,
                           .xtype = like->xtype,
                           .dtype = like->dtype};
}

static ves_status geometric_apply(void *of, const double *v, double *out)
{
    ves_shell *shell = of;
    cholmod_sparse *S = &shell->buckling->matrix[1];
    double minus[2] = {-1, 0}, none[2] = {0, 0};
    cholmod_dense X = dense(S, (double *)v), Y = dense(S, out);
    return cholmod_sdmult(S, 0, minus, none, &X, &Y, &shell->common) ? VES_OK : VES_MEMORY;
}

static ves_status stiffness_solve(void *of, const double *r, double *w)
{
    ves_shell *shell = of;
    shell_buckling *b = shell->buckling;
    const cholmod_sparse *S = &b->matrix[1];
    cholmod_dense X = dense(S, (double *)r);
    if (!cholmod_solve2(CHOLMOD_A, b->factor, &X, NULL, &b->solution, NULL, &b->Y, &b->E, &shell->common))
        return VES_MEMORY;
    memcpy(w, b->solution->x, sizeof *w * S->nrow * (S->xtype == CHOLMOD_COMPLEX ? 2 : 1));
    return VES_OK;
}

/* --- classes --- */

static void mode_keep(ves_shell *shell, int index, int wave, bool fine, double factor)
{
    shell_buckling *b = shell->buckling;
    const shell_layout *layout = &shell->layout[index];
    double most = 0;
    int size = wave > 0 ? 2 : 1;
    memcpy(b->mode, b->found, sizeof *b->mode * (size_t)(size * layout->freedoms));
    b->mode_layout = isfinite(factor) ? index : -1;
    b->mode_wave = wave, b->mode_factor = factor, b->mode_case = b->which;
    b->mode_fine = fine;
    for (int k = 0; k < shell->model->nodes; k++) {
        const shell_freedom *f = &layout->freedom[k];
        double square = 0;
        for (int i = 0; i < 3; i++)
            for (int part = 0; f->moves[i] >= 0 && part < size; part++)
                square += pow(b->mode[size * (f->first + f->moves[i]) + part], 2);
        if (square > most) most = square;
    }
    b->mode_scale = sqrt(most);
    for (int k = 0; most > 0 && k < size * layout->freedoms; k++) b->mode[k] /= sqrt(most);
}

static bool is_of_loads(int index, int wave)
{
    return index == 0 && wave == 0;
}

/* Is the least factor of a class above a load? Then, and only then, K + load K_sigma is positive [Sylvester's law of inertia],
 * which takes one factor where the least factor itself takes as many solutions as Lanczos has steps. */
static ves_status class_is_above(ves_shell *shell, int which, int index, int wave, double load, bool *above)
{
    *above = false;
    if (!isfinite(load) || is_of_loads(index, wave)) return VES_OK;
    VES_TRY(ves_shell_held(shell, &shell->layout[index], wave * shell->buckling->angle));
    VES_TRY(prepare(shell, index, which));
    class_take(shell, index, wave);
    return class_factor(shell, index, wave, load, above);
}

/* The least factor of a class; the mode is left in `found`. fine: a gradient errs as much as the mode, a factor as much as
 * its square. */
static ves_status class_solve(ves_shell *shell, int which, int index, int wave, bool fine,
                              ves_shell_buckled *found)
{
    shell_buckling *b = shell->buckling;
    static const double VALUE = 1e-4, MODE = 1e-7;
    ves_lanczos_found top;
    bool positive = true;
    if (!is_of_loads(index, wave)) VES_TRY(ves_shell_held(shell, &shell->layout[index], wave * b->angle));
    VES_TRY(prepare(shell, index, which));
    class_take(shell, index, wave);
    b->factor = shell->layout[index].factor;
    if (!is_of_loads(index, wave)) VES_TRY(class_factor(shell, index, wave, 0, &positive));
    if (!positive) return VES_LOOSE;
    const ves_lanczos_pencil pencil = {.n = shell->layout[index].freedoms * (wave > 0 ? 2 : 1),
                                       .close = fine ? MODE : VALUE,
                                       .of = shell,
                                       .apply = geometric_apply,
                                       .solve = stiffness_solve};
    VES_TRY(ves_lanczos_largest(&pencil, &b->work, &top, b->found));
    *found = (ves_shell_buckled){.factor = top.value > 0 ? 1 / top.value : HUGE_VAL,
                                 .symmetry = index,
                                 .wave = wave,
                                 .classes = 1,
                                 .solves = top.solves};
    return VES_OK;
}

ves_status ves_shell_buckling_class(ves_shell *shell, int which, int symmetry, int wave,
                                    ves_shell_buckled *found)
{
    VES_TRY(class_solve(shell, which, symmetry, wave, false, found));
    mode_keep(shell, symmetry, wave, false, found->factor);
    return VES_OK;
}

int ves_shell_waves(const ves_shell *shell)
{
    return shell->buckling->waves;
}

/* How many waves a compressed cylinder of the largest radius and the least thickness can have. */
static double waves_enough(const ves_shell *shell)
{
    const ves_shell_input *in = shell->input;
    const double(*R)[3] = shell->model->turn;
    double axis[3] = {R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]}, nu = in->material.nu;
    double length = sqrt(ves_dot(axis, axis)), farthest = 0, thinnest = HUGE_VAL;
    for (int k = 0; k < shell->model->sheets; k++) {
        const ves_shell_sheet *sheet = &shell->model->sheet[k];
        for (int s = 0; s < ves_shell_rows(sheet) * ves_shell_columns(sheet); s++) {
            double X[3] = {in->X[k][0][s], in->X[k][1][s], in->X[k][2][s]}, out[3];
            ves_cross(axis, X, out);
            farthest = fmax(farthest, sqrt(ves_dot(out, out)) / length);
            thinnest = fmin(thinnest, in->thickness[k][s]);
        }
    }
    return pow(12 * (1 - nu * nu), 0.25) * sqrt(farthest / thinnest);
}

/* One class after others: *found, if its least factor is less. *above: it is more than `load`. */
static ves_status class_next(ves_shell *shell, int which, int index, int wave, double load, bool *above,
                             ves_shell_buckled *found)
{
    shell_buckling *b = shell->buckling;
    const int classes = found->classes + 1, solves = found->solves + 1;
    ves_shell_buckled at;
    VES_TRY(class_is_above(shell, which, index, wave, load, above));
    found->classes = classes, found->solves = solves;
    if (*above) return VES_OK;
    VES_TRY(class_solve(shell, which, index, wave, false, &at));
    *above = at.factor > load;
    if (at.factor < found->factor) {
        *found = at;
        mode_keep(shell, index, wave, false, at.factor);
        b->least[which].layout = index, b->least[which].wave = wave;
    }
    found->classes = classes, found->solves = solves + at.solves;
    return VES_OK;
}

/* The k-th wave that is looked at: a ring's from 0 on, until they rise; of a sector's the first and the last before those between,
 * as most often one of the two has the least factor, and then one factorization tells of each other that it has not. */
static int wave_of(int k, int waves, bool ring)
{
    return ring || k == 0 ? k : k == 1 ? waves - 1 : k - 1;
}

ves_status ves_shell_buckling(ves_shell *shell, int which, ves_shell_buckled *found)
{
    enum { RISING = 5 };
    static const double SAME = 1 - 1e-6,
                        MORE = 1.5; /* twins of a mode in other classes are not sought; see the header */
    shell_buckling *b = shell->buckling;
    bool ring = rings(shell);
    double enough = ring ? waves_enough(shell) : HUGE_VAL;
    *found = (ves_shell_buckled){.factor = HUGE_VAL};
    b->mode_layout = b->least[which].layout = -1;
    for (int index = 0; index < shell->layouts; index++) {
        int rising = 0;
        for (int k = 0; k < b->waves; k++) {
            int wave = wave_of(k, b->waves, ring);
            bool above;
            double load = (ring ? MORE : SAME) * found->factor;
            VES_TRY(class_next(shell, which, index, wave, load, &above, found));
            rising = above ? rising + 1 : 0;
            if (wave >= enough && (rising >= RISING || !isfinite(found->factor))) break;
        }
    }
    return VES_OK;
}

ves_status ves_shell_mode_take(ves_shell *shell, int which, shell_mode *mode)
{
    shell_buckling *b = shell->buckling;
    ves_shell_buckled found;
    if (!b || b->least[which].layout < 0) return VES_DEGENERATE;
    int index = b->least[which].layout, wave = b->least[which].wave;
    bool kept = b->mode_fine && b->mode_case == which && b->mode_layout == index && b->mode_wave == wave;
    if (!kept) {
        VES_TRY(class_solve(shell, which, index, wave, true, &found));
        mode_keep(shell, index, wave, true, found.factor);
    }
    if (b->mode_layout < 0) return VES_DEGENERATE;
    *mode = (shell_mode){.layout = index,
                         .parts = wave > 0 ? 2 : 1,
                         .factor = b->mode_factor,
                         .phase = wave * b->angle,
                         .scale = b->mode_scale,
                         .vector = b->mode};
    return VES_OK;
}

void ves_shell_mode(const ves_shell *shell, int sheet, int s, double U[2][3])
{
    const shell_buckling *b = shell->buckling;
    memset(U, 0, 2 * sizeof *U);
    if (b->mode_layout < 0) return;
    int node = shell->model->weld[sheet][s], size = b->mode_wave > 0 ? 2 : 1;
    const shell_freedom *f = &shell->layout[b->mode_layout].freedom[node];
    for (int i = 0; i < 3; i++)
        for (int part = 0; f->moves[i] >= 0 && part < size; part++)
            for (int c = 0; c < 3; c++)
                U[part][c] +=
                    b->mode[size * (f->first + f->moves[i]) + part] * shell->model->node[node].frame[i][c];
    if (!ves_shell_is_far(shell, sheet, s)) return;
    double angle = b->mode_wave * b->angle, near[2][3];
    memcpy(near, U, sizeof near);
    for (int r = 0; r < 3; r++) {
        double re = ves_dot(shell->model->turn[r], near[0]), im = ves_dot(shell->model->turn[r], near[1]);
        U[0][r] = cos(angle) * re - sin(angle) * im;
        U[1][r] = sin(angle) * re + cos(angle) * im;
    }
}
