#include "vesica/verdict.h"

#include <math.h>

bool ves_verdict_better(const ves_verdict *a, const ves_verdict *b, double tolerance)
{
    if (a->status != VES_OK) return false;
    if (b->status != VES_OK) return true;
    bool fa = a->violation <= tolerance, fb = b->violation <= tolerance;
    if (fa != fb) return fa;
    return fa ? a->value < b->value : a->violation < b->violation;
}

double ves_verdict_energy(const ves_verdict *verdict, double weight, double tolerance)
{
    if (verdict->status != VES_OK) return HUGE_VAL;
    double excess = verdict->violation > tolerance ? verdict->violation - tolerance : 0;
    return verdict->value + weight * excess;
}
