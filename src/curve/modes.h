/* What the operations on curves share: reading their arguments, and linear algebra on modes. */
#ifndef VES_CURVE_MODES_H
#define VES_CURVE_MODES_H

#include "curve/curve.h"

/* --- arguments: `key` counts the keys of the operation's table --- */

/* The value of a number key, or its fallback. */
double ves_input_number(const ves_curve_input *input, int key);

/* The three numbers of a vector key, or `fallback` where it was not given. */
const double *ves_input_vector(const ves_curve_input *input, int key, const double fallback[3]);

/* The numbers of a list, as they lie in the block; *count of them. */
const double *ves_input_list(const ves_curve_input *input, int key, int *count);

/* Adds to the adjoint of number i of a key; nothing where the fallback stands. */
void ves_input_scatter(const ves_curve_input *input, int key, int i, double value, double *number_adjoint);

/* Does any number of the key depend on a variable? */
bool ves_input_varies(const ves_curve_input *input, int key);

/* Does a formula of the key read this slot? One more than the highest slot that any reads. */
bool ves_input_reads(const ves_curve_input *input, int key, int slot);
int ves_input_slots(const ves_curve_input *input, int key);

/* Where to point when the key is at fault. */
ves_mark ves_input_mark(const ves_curve_input *input, int key);

/* VES_MEMORY with its message. */
ves_status ves_input_memory(const ves_curve_input *input, ves_diag *diag);

/* `modes` of an operation that leaves the band alone: the most that an input has. */
int ves_input_modes(const ves_curve_input *input);

/* --- modes --- */

double ves_sinc(double x); /* sin x / x */

/* e^{i n angle} from e^{i (n - 1) angle}: z = {cos, sin}, step = {cos angle, sin angle}. */
static inline void ves_turn(double z[2], const double step[2])
{
    double c = z[0] * step[0] - z[1] * step[1];
    z[1] = z[0] * step[1] + z[1] * step[0];
    z[0] = c;
}

/* out = input, padded with zeros. */
void ves_modes_copy(const double *input, int input_modes, int modes, double *out);

/* out += factor * input, and its transpose; input_adjoint may be NULL. */
void ves_modes_add(const double *input, int input_modes, double factor, int modes, double *out);
void ves_modes_scatter(const double *adjoint, int modes, double factor, int input_modes,
                       double *input_adjoint);

/* The smallest number of modes beyond which nothing of a constant curve shows: 1e-10 of its size, or
 * rounding. */
int ves_modes_needed(const double *coef, int modes);

/* Largest |coefficient| from mode `first` on. */
double ves_modes_largest(const double *coef, int modes, int first);

/* A linear map from points to modes: out[c][k] = sum_j table[k * points + j] point[3 j + c]. */
typedef struct ves_modes_map {
    int modes, points;
    double *table;
} ves_modes_map;

/* The analysis of eqs 4.25-4.27 (see ves_curve_analyse) as a map, for modes <= points / 2. With `factor` mode
 * n is that of the periodic extension to any n, times factor[n]: points as control points of a basis with
 * that spectrum. False: no memory. */
bool ves_modes_map_create(int points, int modes, const double *factor, ves_arena *arena, ves_modes_map *map);
void ves_modes_map_eval(const ves_modes_map *map, const double *restrict point, double *restrict out);
void ves_modes_map_gradient(const ves_modes_map *map, const double *restrict adjoint,
                            double *restrict point_adjoint);

#endif
