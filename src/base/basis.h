/* Gram-Schmidt: rows made orthogonal to unit rows that are so already (Golub and Van Loan, 5.2.7). */
#ifndef VES_BASE_BASIS_H
#define VES_BASE_BASIS_H

double ves_basis_size(int n, const double *row);

/* Takes from the row what lies along a unit row; the numbers behind the first n, up to `wide`, follow. Returns how much
 * it was. */
double ves_basis_strip(int n, int wide, const double *unit, double *row);

/* The same for the first `count` of the rows unit[][n], twice, for orthogonality. along [count]: how much it was of
 * each, or NULL. Returns the size of what is left. */
double ves_basis_strip_all(int n, const double *unit, int count, double *row, double *along);

#endif
