/* Interpolation and quadrature on [-1, 1]. */
#ifndef VES_SHELL_RULE_H
#define VES_SHELL_RULE_H

enum { VES_SHELL_ORDER = 12 }; /* highest order of an element along one direction */

/* The order + 1 nodes of an element: evenly spread for orders 1 and 2, Gauss-Lobatto-Legendre beyond, where
 * interpolation stays well conditioned. */
void ves_rule_nodes(int order, double *node);

/* Lagrange's polynomials on given nodes, and their derivatives, at x. */
void ves_rule_lagrange(int count, const double *node, double x, double *value, double *slope);

/* Gauss-Legendre on [-1, 1]. */
void ves_rule_gauss(int count, double *node, double *weight);

#endif
