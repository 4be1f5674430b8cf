/* Curves: closed space curves, periodic in v, held as Fourier modes
 *     C(v) = a_0 + sum_n a_n cos(n v) + b_n sin(n v)                                   [Ugail 2011, eq 4.20]
 * A curve is a chain of operations: one *source* (circle, bspline, like ...) and then *moves* (translate,
 * rotate ...). Every operation is linear or affine in the modes of its inputs, so a curve is never resampled
 * during a search; the exception is a `formula` curve whose formula itself uses variables.
 *
 * Layout of modes: coef[c * stride + k], c = 0..2 for x, y, z, stride = 1 + 2 * modes; k = 0 the mean a_0,
 * 2n-1 the cosine a_n, 2n the sine b_n. */
#ifndef VES_CURVE_CURVE_H
#define VES_CURVE_CURVE_H

#include "base/arena.h"
#include "formula/formula.h"
#include "vesica/field.h"

/* Default band limit of curves with endless spectra (splines, ridges, bumps). */
enum { VES_CURVE_MODES = 128 };

static inline int ves_curve_stride(int modes)
{
    return 1 + 2 * modes;
}

/* What an operation reads. */
typedef struct ves_curve_input {
    const ves_args *args;
    const double *number; /* the number block: slots first, then numbers; args' `first` index it */
    const double *middle; /* [number block] with every variable in the middle of its range; for `prepare`:
                             what is chosen by it does not depend on where a search starts */
    const bool *varying;  /* [number block]: depends on a variable; for `prepare` and `modes` */
    int limit;            /* most modes the file allows a curve to have */
    int modes;            /* of the output, as `modes` answered */
    int inputs;           /* a move has one: the curve before it; like one; combine one for each term */
    const int *input_modes;
    const double *const *input; /* coefficients of the inputs */
    void *state;                /* what `prepare` made, constant afterwards */
    double *room;               /* scratch of `room` doubles */
} ves_curve_input;

/* One file under src/curve/source/ or src/curve/move/ is one operation: file name = word in problem files =
 * NAME in the symbol ves_curve_NAME_op. Called in this order: prepare, modes, room, then eval and gradient
 * any number of times. */
typedef struct ves_curve_op {
    const char *name, *about;
    bool move; /* false: a source */
    const ves_key *keys;

    /* Tables that do not depend on x: called once, at the start design, may be NULL. Checks what the key
     * table cannot say. */
    ves_status (*prepare)(const ves_curve_input *input, ves_arena *arena, void **state, ves_diag *diag);

    /* Number of modes of the result (input->modes is not known yet). */
    int (*modes)(const ves_curve_input *input);

    /* Doubles of scratch; NULL: none. */
    size_t (*room)(const ves_curve_input *input);

    /* Fills out[3 * stride]. Allocates nothing, cannot fail. */
    void (*eval)(const ves_curve_input *input, double *out);

    /* Transpose: adjoint[3 * stride] is d J / d out. Adds to input_adjoint[i][...] (an entry may be NULL: not
     * wanted) and to number_adjoint (indexed like the number block). */
    void (*gradient)(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint);
} ves_curve_op;

const ves_curve_op *const *
ves_curve_ops(void); /* NULL-terminated: sources, then moves, each sorted by name */
const ves_curve_op *ves_curve_op_find(const char *name, bool move);

/* One operation as written in a file. */
typedef struct ves_curve_step {
    const ves_curve_op *op;
    ves_args args;
} ves_curve_step;

/* A curve as written in a file: step[0] is a source, the rest are moves. input: the curves that step[0]
 * reads, one for each reference, in the order of its keys and terms. */
typedef struct ves_curve_def {
    const char *name;
    ves_mark mark;
    int steps;
    const ves_curve_step *step;
    int inputs;
    const int *input;
    ves_dim dim; /* of its points: a length, or dimensionless for direction fields */
} ves_curve_def;

/* Curves made ready for evaluation. Lives in an arena; one per thread. */
typedef struct ves_curves ves_curves;

/* What curves are made from. */
typedef struct ves_curve_set {
    const ves_curve_def *def; /* [count] in an order in which inputs come before their users */
    int count;
    int limit; /* most modes of a curve; <= 0: VES_CURVE_MODES */
    const double
        *number; /* the number block at the start design, from which the operations learn their constants */
    const bool *varying;  /* [number block] depends on a variable: curves that read no such number are
                             evaluated once */
    const double *middle; /* the number block with every variable in the middle of its range; NULL: number */
} ves_curve_set;

ves_status ves_curves_create(const ves_curve_set *set, ves_arena *arena, ves_curves **curves, ves_diag *diag);

int ves_curves_modes(const ves_curves *curves, int index);
bool ves_curves_varies(const ves_curves *curves, int index);
const double *ves_curves_coef(const ves_curves *curves, int index);

/* Evaluates every curve that varies. */
void ves_curves_bind(ves_curves *curves, const double *number);

/* The adjoint of curve `index`, to be added to between clear and scatter (one scatter for each clear). NULL
 * for a curve that does not vary. */
double *ves_curves_adjoint(ves_curves *curves, int index);
void ves_curves_clear(ves_curves *curves);
void ves_curves_scatter(ves_curves *curves, const double *number, double *number_adjoint);

/* Point and derivatives at one v: out[3 * d + c], d = 0 .. order (at most 2). */
void ves_curve_point(const double *coef, int modes, double v, int order, double *out);

/* Fourier coefficients of `count` samples at v = 2 pi j / count, [c * count + j], eqs 4.25-4.27 as corrected
 * in docs/errata.md: modes n < count / 2 exactly, and at n = count / 2 the cosine with weight 1. */
void ves_curve_analyse(const double *sample, int count, int modes, double *coef);

#endif
