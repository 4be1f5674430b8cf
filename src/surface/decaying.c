#include "surface/basis.h"

/* f_k = u^k e^(-lam u) / k!, f_k' = f_(k-1) - lam f_k, df_k/dlam = -(k+1) f_(k+1); a mirror image changes its
 * sign with each derivative. */
static void family(const ves_mode *mode, ves_twos u, double sign, int first, const ves_basis *basis)
{
    int N = mode->op->power, orders = basis->orders;
    ves_two lam = ves_two_product(mode->op->parameter[0], mode->n), minus = ves_two_negative(lam);
    ves_twos before[2 * VES_CONDITIONS_MAX], f = ves_twos_exp(ves_twos_times(u, minus));
    for (int k = 0; k <= N; k++) {
        ves_twos here[2 * VES_CONDITIONS_MAX];
        if (k) f = ves_twos_times(ves_twos_multiply(f, u), ves_two_inverse(k));
        here[0] = f;
        for (int d = 1; d < orders; d++) {
            here[d] = ves_twos_times(here[d - 1], minus);
            if (k) here[d] = ves_twos_add(here[d], before[d - 1]);
        }
        double flip = 1;
        for (int d = 0; d < orders; d++, flip *= sign) {
            if (k < N) basis->value[(first + k) * orders + d] = ves_twos_shift(here[d], flip);
            if (k && basis->slope)
                basis->slope[(first + k - 1) * orders + d] =
                    ves_twos_times(here[d], ves_two_of(-flip * k * mode->n));
            before[d] = here[d];
        }
        if (!basis->slope && k == N - 1) return;
    }
}

void ves_basis_decaying(const ves_mode *mode, ves_lanes u, const ves_basis *basis)
{
    ves_twos left = {u, {0}}, right = ves_twos_sum(1 + (ves_lanes){0}, -u);
    family(mode, left, 1, 0, basis);
    family(mode, right, -1, mode->op->power, basis);
}
