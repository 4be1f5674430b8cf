/* Gallery of a sweep: shapes.png, the best at some values of the first parameter, a row for each of the second. */
#ifndef VES_STUDY_SWEEP_GALLERY_H
#define VES_STUDY_SWEEP_GALLERY_H

#include "study/sweep_point.h"

/* Where all points are lost there is no file. */
ves_status ves_sweep_gallery_write(const ves_sweep_task *task, ves_diag *diag);

#endif
