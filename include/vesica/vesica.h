/* vesica: shape optimization with PDE surfaces. This header brings in the whole public interface.
 *
 * Before version 1.0 structs may grow with every minor version: compile against the headers of
 * the library that you link. Plugins go by an interface of their own (vesica/measure.h). */
#ifndef VESICA_VESICA_H
#define VESICA_VESICA_H

#include "vesica/diag.h"
#include "vesica/field.h"
#include "vesica/figure.h"
#include "vesica/measure.h"
#include "vesica/objective.h"
#include "vesica/plan.h"
#include "vesica/problem.h"
#include "vesica/run.h"
#include "vesica/search.h"
#include "vesica/stability.h"
#include "vesica/status.h"
#include "vesica/verdict.h"

#endif
