/* How high the order of a patch's equation may be: what the surface room can solve, and what the reader of
 * problem files lets through. The powers of (d_uu + a^2 d_vv)^N go to 2N = 40, as in the Klein bottle of
 * [Ugail 2011, 4.55-4.57]; with coefficients of its own an equation is of order 2N = 12 at most. */
#ifndef VES_BASE_ORDER_H
#define VES_BASE_ORDER_H

enum {
    VES_POWER_MAX = 20,                       /* N of (d_uu + a^2 d_vv)^N */
    VES_GENERAL_MAX = 6,                      /* N of sum_k c_k d_u^(2N-2k) d_v^(2k) */
    VES_PARAMETERS_MAX = VES_GENERAL_MAX + 1, /* c_0 .. c_N */
    VES_CONDITIONS_MAX = 2 * VES_POWER_MAX
};

#endif
