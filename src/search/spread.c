#include "search/spread.h"

#include <math.h>

static int sorted(double *value, int count)
{
    int kept = 0;
    for (int k = 0; k < count; k++) {
        double v = value[k];
        if (isnan(v)) continue;
        int j = kept++;
        for (; j && value[j - 1] > v; j--) value[j] = value[j - 1];
        value[j] = v;
    }
    return kept;
}

double ves_spread(double *value, int *count)
{
    int kept = *count = sorted(value, *count);
    if (!kept) return 0;
    double width = (value[kept / 2] - value[kept / 4]) / 0.6745;
    return width > 0 ? width : (value[kept - 1] - value[0]) / 4;
}

double ves_median_above(double *value, int count, double limit)
{
    int kept = sorted(value, count), first = 0;
    while (first < kept && value[first] <= limit) first++;
    return first < kept ? value[first + (kept - first) / 2] : 0;
}

double ves_weight(double width, double typical)
{
    return 2 * width / typical;
}

double ves_typical(double *violation, int count, double tolerance, double usual)
{
    double typical = ves_median_above(violation, count, tolerance);
    return typical > 0 ? typical : usual;
}
