/* What vesica sweep prints. */
#ifndef VES_APP_SCREEN_SWEEP_H
#define VES_APP_SCREEN_SWEEP_H

#include "app/app.h"
#include "study/sweep_report.h"

void app_screen_sweep_head(const ves_sweep *sweep, FILE *out); /* before it begins */
void app_screen_sweep(const ves_sweep *sweep, FILE *out);      /* what it came to */

#endif
