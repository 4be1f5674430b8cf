/* A measure with the keys that only measures of shells have, so that tests see what the reader makes of them. */
#ifndef SHELL_PROBE_H
#define SHELL_PROBE_H

#include <stddef.h>

#include "vesica/measure.h"

static ves_status shell_probe_eval(const ves_measure_input *input, double *value)
{
    *value = input->args->arg[0].value;
    return VES_OK;
}

static const ves_key shell_probe_keys[] = {
    {.name = "case", .kind = VES_CASE, .about = "which load case"},
    {.name = "at", .kind = VES_SHELL_AT, .about = "where"},
    {0},
};

static const ves_measure shell_probe = {.name = "probe",
                                        .about = "tells the load case",
                                        .unit = "1",
                                        .degree = VES_NO_DEGREE,
                                        .curve = VES_X,
                                        .shell = true,
                                        .keys = shell_probe_keys,
                                        .eval = shell_probe_eval};

static const ves_measure *const shell_probes[] = {&shell_probe, NULL};

#endif
