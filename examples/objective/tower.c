/* A plugin for vesica bench: two bars that carry a load between them at the height h, each of them leaning by
 * half the span b. The lightest is asked; they must neither yield nor buckle.
 *
 *     x = (d, h): diameter of the tubes and height, cm
 *     mass      2 rho pi d t L,  L^2 = h^2 + b^2/4
 *     stress    F L/(h pi d t)/2          <= yield
 *     buckling  the same                  <= pi^2 E (d^2 + t^2)/(8 L^2)
 *
 * It includes nothing but <vesica/objective.h>: cc -std=c17 -shared -fPIC -I.../include -o tower.so tower.c
 * -lm */
#include <math.h>

#include <vesica/objective.h>

static const double pi = 3.14159265358979323846;

static const double load = 30000, E = 30e6, yield = 100000, rho = 0.3, wall = 0.1, span = 60;

static const double lower[] = {0.5, 5}, upper[] = {5, 50};

static ves_status eval(void *state, const double *x, bool slopes, ves_verdict *out)
{
    double d = x[0], h = x[1], L = sqrt(h * h + span * span / 4), L_h = h / L;
    double stress = load * L / (2 * h * pi * d * wall),
           critical = pi * pi * E * (d * d + wall * wall) / (8 * L * L);
    (void)state;
    out->value = 2 * rho * pi * d * wall * L;
    out->constraint[0] = stress / yield - 1;
    out->constraint[1] = stress / critical - 1;
    if (!slopes) return VES_OK;
    double stress_d = -stress / d, stress_h = stress * (L_h / L - 1 / h);
    double critical_d = critical * 2 * d / (d * d + wall * wall), critical_h = -critical * 2 * L_h / L;
    out->gradient[0] = out->value / d;
    out->gradient[1] = out->value * L_h / L;
    out->jacobian[0] = stress_d / yield; /* row = constraint, column = variable */
    out->jacobian[1] = stress_h / yield;
    out->jacobian[2] = (stress_d - stress * critical_d / critical) / critical;
    out->jacobian[3] = (stress_h - stress * critical_h / critical) / critical;
    return VES_OK;
}

static const ves_objective tower = {
    .name = "tower",
    .about = "two bars that carry a load, as light as may be",
    .n = 2,
    .m = 2,
    .lower = lower,
    .upper = upper,
    .optimum = NAN,
    .gradients = true,
    .eval = eval,
};

static const ves_objective *const list[] = {&tower, NULL};

const ves_objectives ves_objectives_entry = {VES_OBJECTIVES, "a tower", list};
