#include <math.h>

#include "shell/buckling.h"
#include "shell/view.h"
#include "vesica/measure.h"

enum { CASE };

static const ves_key KEYS[] = {VES_SHELL_CASE, {.name = NULL}};

/* What no load of this kind makes buckle. */
static const double NEVER = 1e9;

static size_t room(const ves_measure_input *input)
{
    (void)input;
    return 1; /* the factor */
}

/* The factor of the loads of a case at which the shell buckles (shell/buckling.h): the least of all classes of symmetry,
 * since modes need not be as symmetric as shape and loads. Linear: of the perfect shape; shells of packaging and of rockets
 * carry a half to a fifth of it.
 * test  cylinders, columns, plates and rings in closed form; sectors against whole models; another program */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_shell_buckled found;
    VES_TRY(ves_shell_buckling(input->shell->shell, input->args->arg[CASE].value, &found));
    *value = *input->room = fmin(found.factor, NEVER);
    return VES_OK;
}

/* Of the class and the mode of the least factor; where two are the same, of one of them. */
static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)adjoint, (void)number_adjoint;
    if (*input->room < NEVER) input->shell->reading[input->args->arg[CASE].value].factor += seed;
}

const ves_measure ves_measure_buckling = {
    .name = "buckling",
    .about = "factor of the loads at which the perfect shell buckles; 1e9: it never does",
    .unit = "1",
    .degree = VES_NO_DEGREE,
    .cost = 1,
    .extreme = true,
    .shell = true,
    .buckles = true,
    .keys = KEYS,
    .room = room,
    .eval = eval,
    .gradient = gradient};
