/* vesica stability --follow: descents from beside a shape. */
#ifndef VES_APP_FOLLOW_H
#define VES_APP_FOLLOW_H

#include "app/app.h"
#include "vesica/stability.h"

/* From the design, displaced both ways by `change`, scaled. Tells where they end, on stdout or, with --json, where that is
 * talk; each is a run with a folder of its own, unless --no-files. */
void app_follow(app *a, const ves_opened *opened, const ves_stability *found, const double *change);

#endif
