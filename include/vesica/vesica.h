/* vesica: shape optimization with PDE surfaces. This header brings in the whole public interface. */
#ifndef VESICA_VESICA_H
#define VESICA_VESICA_H

#include "vesica/diag.h"
#include "vesica/field.h"
#include "vesica/figure.h"
#include "vesica/measure.h"
#include "vesica/plan.h"
#include "vesica/problem.h"
#include "vesica/run.h"
#include "vesica/search.h"
#include "vesica/status.h"
#include "vesica/verdict.h"

#endif
