#include "search/algorithms.h"

#include <string.h>

#include "vesica/search.h"

static const ves_algorithm list[] = {
    {"slsqp", "sequential quadratic programming (Kraft 1988); the default with gradients", true, true, true},
    {"mma",
     "method of moving asymptotes (Svanberg 2002); equalities and opposite inequalities through auglag", true,
     true, false},
    {"ccsa",
     "conservative convex separable approximation (Svanberg 2002); equalities and opposite inequalities "
     "through auglag",
     true, true, false},
    {"lbfgs",
     "limited-memory BFGS (Nocedal 1980, by Luksan): its own time grows like n; constraints through auglag",
     true, false, false},
    {"cobyla", "linear models (Powell 1994); the default with constraints and without gradients", false, true,
     true},
    {"bobyqa",
     "quadratic models (Powell 2009); the default without constraints and gradients; constraints through "
     "auglag",
     false, false, false},
    {"sbplx", "Nelder-Mead on subspaces (Rowan 1990); for rough functions; constraints through auglag", false,
     false, false},
    {"auglag", "augmented Lagrangian (Birgin and Martinez 2008) around slsqp or, without gradients, bobyqa",
     false, true, true},
    {NULL, NULL, false, false, false},
};

const ves_algorithm *ves_search_algorithms(void)
{
    return list;
}

static nlopt_algorithm plain(const char *name)
{
    static const struct {
        const char *name;
        nlopt_algorithm id;
    } table[] = {{"slsqp", NLOPT_LD_SLSQP}, {"mma", NLOPT_LD_MMA},       {"ccsa", NLOPT_LD_CCSAQ},
                 {"lbfgs", NLOPT_LD_LBFGS}, {"cobyla", NLOPT_LN_COBYLA}, {"bobyqa", NLOPT_LN_BOBYQA},
                 {"sbplx", NLOPT_LN_SBPLX}};
    for (size_t k = 0; k < sizeof table / sizeof table[0]; k++)
        if (!strcmp(table[k].name, name)) return table[k].id;
    return NLOPT_LN_COBYLA;
}

/* BOBYQA's quadratic models need two variables. */
static nlopt_algorithm fitting(nlopt_algorithm id, int n)
{
    return id == NLOPT_LN_BOBYQA && n < 2 ? NLOPT_LN_COBYLA : id;
}

ves_recipe ves_recipe_find(const char *name, int n, bool gradients)
{
    const ves_algorithm *a = list;
    while (a->name && strcmp(a->name, name)) a++;
    ves_recipe recipe = {.name = name, .gradient = a->gradient};
    recipe.inequalities = !a->inequality;
    recipe.equalities = !a->equality;
    recipe.id = plain(name);
    if (!strcmp(name, "auglag")) {
        recipe.gradient = gradients;
        recipe.id = gradients ? NLOPT_LD_SLSQP : NLOPT_LN_BOBYQA;
        recipe.inequalities = recipe.equalities = true;
    }
    recipe.id = fitting(recipe.id, n);
    recipe.dual = recipe.id == NLOPT_LD_MMA || recipe.id == NLOPT_LD_CCSAQ;
    return recipe;
}

const char *ves_recipe_sentence(nlopt_result code)
{
    switch (code) {
    case NLOPT_SUCCESS:
        return "converged";
    case NLOPT_STOPVAL_REACHED:
        return "the value asked for was reached";
    case NLOPT_FTOL_REACHED:
        return "converged: the value changes by less than its tolerance";
    case NLOPT_XTOL_REACHED:
        return "converged: the variables change by less than their tolerance";
    case NLOPT_MAXEVAL_REACHED:
        return "the budget of evaluations is spent";
    case NLOPT_MAXTIME_REACHED:
        return "the time is over";
    case NLOPT_ROUNDOFF_LIMITED:
        return "converged: rounding errors allow no further step";
    case NLOPT_FORCED_STOP:
        return "stopped from outside";
    case NLOPT_OUT_OF_MEMORY:
        return "out of memory";
    case NLOPT_INVALID_ARGS:
        return "the algorithm does not take this problem";
    default:
        return "the algorithm failed to take a step";
    }
}
