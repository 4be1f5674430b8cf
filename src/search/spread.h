/* Robust sizes of a sample in which some are NAN: not measured. The arrays are sorted in place, NAN left out; *count
 * becomes the number of those that stay. */
#ifndef VES_SEARCH_SPREAD_H
#define VES_SEARCH_SPREAD_H

/* The spread below the median, as a standard deviation of a normal: the half that a minimiser will live in, and
 * deaf to the long upper tail of extreme shapes. 0: none, or all equal. */
double ves_spread(double *value, int *count);

/* The median of those above a limit; 0: there are none. */
double ves_median_above(double *value, int count, double limit);

/* What f may cost per unit of violation, so that a middle one costs two spreads. typical: the median of the violations
 * beyond the tolerance, or `usual` where there are none. */
double ves_weight(double width, double typical);
double ves_typical(double *violation, int count, double tolerance, double usual);

#endif
