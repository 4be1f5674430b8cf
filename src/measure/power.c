#include "measure/power.h"

#include <math.h>

void ves_power_add(ves_power *power, double x, double w)
{
    power->weight += w;
    if (!(x > 0)) return;
    double y = log(x / power->largest), term = w * exp(power->p * y);
    power->sum += term;
    power->entropy += term * y;
}

void ves_power_close(ves_power *power)
{
    power->mean = power->sum > 0 ? power->largest * pow(power->sum / power->weight, 1 / power->p) : 0;
}

ves_power_slope ves_power_gradient(const ves_power *power, double x, double w)
{
    if (!(power->sum > 0)) return (ves_power_slope){0, 0};
    double part = x > 0 ? exp(power->p * log(x / power->largest)) / power->sum : 0;
    return (ves_power_slope){x > 0 ? power->mean * part * w / x : 0,
                             power->mean / power->p * (part - 1 / power->weight)};
}

double ves_power_by_exponent(const ves_power *power)
{
    if (!(power->sum > 0)) return 0;
    double relative = power->entropy / power->sum - log(power->sum / power->weight) / power->p;
    return power->mean / power->p * relative;
}
