/* Eigenvalues and eigenvectors of a small symmetric matrix. */
#ifndef VES_SEARCH_EIGEN_H
#define VES_SEARCH_EIGEN_H

/* a [n][n], destroyed; value [n] unordered; vector [n][n], column k belongs to value[k]. */
void ves_eigen_symmetric(int n, double *a, double *value, double *vector);

#endif
