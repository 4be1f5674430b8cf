/* Status: what every fallible function of vesica returns.
 *
 * 0 is success. A positive status says "this candidate is no good": nothing has changed, a search goes on.
 * A negative status says "the run cannot go on": whoever met the fault has written the one diagnostic, if
 * it was given a ves_diag. */
#ifndef VESICA_STATUS_H
#define VESICA_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* X(name, value, sentence): the enum and the sentences come from this one list. */
#define VES_STATUS_LIST(X)                                                                                   \
    X(OK, 0, "ok")                                                                                           \
    X(DEGENERATE, 1, "the surface has a point without a tangent plane")                                      \
    X(FOLDED, 2, "the surface folds back on itself")                                                         \
    X(INVERTED, 3, "the shape has turned inside out")                                                        \
    X(NARROW, 4, "the shape comes closer to its axis than allowed")                                          \
    X(NOT_MONOTONE, 5, "the height does not grow along the surface")                                         \
    X(NO_ROOT, 6, "the equation to solve does not change its sign between the ends of solve.in")             \
    X(NO_NUMBER, 7, "a measure is not a finite number")                                                      \
    X(SELF_INTERSECTS, 8, "the surface crosses itself")                                                      \
    X(COARSE, 9, "the value does not hold on a finer grid")                                                  \
    X(CUT, 10, "measuring stopped: already worse than the cutoff")                                           \
    X(TOUCHES, 11, "the surface touches itself")                                                             \
    X(OUTSIDE, 12, "a number of the problem has left its range")                                             \
    X(NO_BRACKET, 13, "the equation to solve cannot be measured at the ends of solve.in, nor near them")     \
    X(NO_POINT, 14, "a coordinate of the surface is not a finite number")                                    \
    X(NO_SCALE, 15, "no size of the shape meets the scale equation")                                         \
    X(NOT_ELLIPTIC, 16, "the operator of a patch is not elliptic")                                           \
    X(UNDETERMINED, 17, "the conditions of a patch do not determine one of its modes")                       \
    X(BROKEN, 18, "a check of the file does not hold")                                                       \
    X(LOOSE, 19, "the supports of the shell let it move without strain")                                     \
    X(NO_CONVERGENCE, 20, "an eigenvalue was not found in the steps that there are")                         \
    X(NO_WALL, 21, "the wall of the shell has no thickness somewhere")                                       \
    X(SYNTAX, -1, "the text cannot be read")                                                                 \
    X(NAME, -2, "a name is not known")                                                                       \
    X(UNIT, -3, "a dimension does not fit")                                                                  \
    X(RANGE, -4, "a value is outside its range")                                                             \
    X(SINGULAR, -5, "the conditions do not determine the surface")                                           \
    X(MEMORY, -6, "out of memory")                                                                           \
    X(IO, -7, "a file cannot be read or written")                                                            \
    X(ABSENT, -8, "this build does not have that feature")                                                   \
    X(USAGE, -9, "the command line is wrong")                                                                \
    X(INTERRUPTED, -10, "interrupted")                                                                       \
    X(FAULT, -11, "a fault of vesica itself")                                                                \
    X(STALE, -12, "the journal belongs to another run, or another version has written it")

typedef enum ves_status {
#define VES_STATUS_ENUM(name, value, sentence) VES_##name = value,
    VES_STATUS_LIST(VES_STATUS_ENUM)
#undef VES_STATUS_ENUM
} ves_status;

/* The sentence for a status; never NULL. */
const char *ves_status_text(ves_status status);

/* Passes a failure up. Who fails has written the diagnostic; callers only return. */
#define VES_TRY(call)                                                                                        \
    do {                                                                                                     \
        ves_status ves_try_status = (call);                                                                  \
        if (ves_try_status != VES_OK) return ves_try_status;                                                 \
    } while (0)

#ifdef __cplusplus
}
#endif
#endif
