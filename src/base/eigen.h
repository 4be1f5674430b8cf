/* Eigenvalues and eigenvectors of a small symmetric matrix. */
#ifndef VES_BASE_EIGEN_H
#define VES_BASE_EIGEN_H

/* a [n][n], destroyed; value [n] unordered; vector [n][n], column k belongs to value[k]. */
void ves_eigen_symmetric(int n, double *a, double *value, double *vector);

/* The same for a matrix that has changed a little since: a [n][n] (lower triangle), basis [n][n] orthonormal, one
 * vector a row, that of the former matrix on entry and of this one on return; value [n]; scratch [2 n n].
 * Diagonal only as far as a distribution with this covariance can tell: off the diagonal remains at most 1e-4
 * of the root of the two values. */
void ves_eigen_follow(int n, const double *a, double *basis, double *value, double *scratch);

#endif
