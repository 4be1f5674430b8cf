/* The power mean (sum w x^p / sum w)^(1/p) of values x >= 0 with weights w: a smooth lower bound of the
 * largest, which it meets as p grows. Values are taken over the largest, so that x^p cannot overflow. test
 * closed forms through max_curvature and max; differences in x, w and p */
#ifndef VES_MEASURE_POWER_H
#define VES_MEASURE_POWER_H

typedef struct ves_power {
    double p, largest;           /* set these before the first add */
    double weight, sum, entropy; /* sums of w, w y^p, w y^p log y, with y = x / largest */
    double mean;                 /* after ves_power_close */
} ves_power;

void ves_power_add(ves_power *power, double x, double w);
void ves_power_close(ves_power *power);

/* d mean / d (x, its w). All 0 while every value is 0. */
typedef struct ves_power_slope {
    double x, w;
} ves_power_slope;
ves_power_slope ves_power_gradient(const ves_power *power, double x, double w);
double ves_power_by_exponent(const ves_power *power);

#endif
