#include "shell/view.h"
#include "vesica/measure.h"

enum { CASE };

static const ves_key KEYS[] = {VES_SHELL_CASE, {.name = NULL}};

/* F . u, twice the strain energy of the whole shell.
 * test  cantilevers; hyperboloids against another program */
static ves_status eval(const ves_measure_input *input, double *value)
{
    *value = input->shell->copies * ves_shell_work(input->shell->shell, input->args->arg[CASE].value);
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)adjoint, (void)number_adjoint;
    input->shell->reading[input->args->arg[CASE].value].work += seed * input->shell->copies;
}

const ves_measure ves_measure_compliance = {
    .name = "compliance",
    .about = "work of the loads, F . u: twice the strain energy of the shell",
    .unit = "J",
    .degree = VES_NO_DEGREE,
    .cost = 1,
    .shell = true,
    .keys = KEYS,
    .eval = eval,
    .gradient = gradient};
