/* Stiffness of elements that are not tied, by sums over the points along r and then along s (sum factorization [Orszag 1980]):
 * for order p some p^5 products, where one row of strains a point takes p^6. */
#ifndef VES_SHELL_TENSOR_H
#define VES_SHELL_TENSOR_H

#include "shell/element.h"

/* The tables of a kind: products of the functions of two nodes along a direction, and their slopes, at the points of the rule. */
ves_status ves_shell_tensor_make(ves_shell_kind *kind, ves_arena *arena);

/* How much scratch (doubles): of the points, of lines, of blocks. */
typedef struct ves_shell_tensor_size {
    size_t points, lines, blocks;
} ves_shell_tensor_size;
ves_shell_tensor_size ves_shell_tensor_needs(const ves_shell_kind *kind);

ves_status ves_shell_tensor_stiffness(const ves_shell_body *body, const ves_shell_material *material,
                                      int columns, const ves_shell_column *column,
                                      const ves_shell_scratch *scratch, double *K);

#endif
