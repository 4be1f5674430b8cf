/* What the rooms share beyond the public vesica/diag.h. */
#ifndef VES_BASE_DIAG_H
#define VES_BASE_DIAG_H

#include "vesica/diag.h"

/* An error of which nothing is known but its status, which it hands back. */
ves_status ves_diag_fail(ves_diag *diag, ves_status status);

#endif
