/* What the rooms share beyond the public vesica/diag.h. */
#ifndef VES_BASE_DIAG_H
#define VES_BASE_DIAG_H

#include "vesica/diag.h"

/* An error of which nothing is known but its status, which it hands back. */
ves_status ves_diag_fail(ves_diag *diag, ves_status status);

/* From now on sources count from this one on; < 0: from the next. So a file that is read on behalf of another
 * marks its own lines. Returns what held before. */
int ves_diag_base(ves_diag *diag, int base);

/* The name of a status in files, as in VES_STATUS_LIST: FOLDED, NO_NUMBER ... */
const char *ves_status_word(ves_status status);

#endif
