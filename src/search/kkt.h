/* First-order conditions at the best of a search: how far the slope has vanished, and what limits cost. */
#ifndef VES_SEARCH_KKT_H
#define VES_SEARCH_KKT_H

#include "search/session.h"

/* Asks for the slopes at the best and, when another evaluation is left, at the start. The arrays are those of what
 * the result keeps. kkt->known tells whether it could. */
ves_status ves_kkt_find(ves_session *session, const ves_point *best, long evaluations, ves_kkt *kkt);

#endif
