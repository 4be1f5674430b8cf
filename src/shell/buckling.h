/* Linear buckling: the least positive factor of the loads of a case at which the shell has a second state beside its
 * own, (K + factor K_sigma) mode = 0, with the geometric stiffness of the stresses that the loads make
 * (shell/geometric.h says which loads turn with the surface). Of a model with `buckling`, and solved.
 *
 * Modes need not be as symmetric as the loads, so they are sought in classes, one pair of matrices each. A sector of a
 * shell that comes again N times around an axis: its mode goes from copy to copy as exp(i 2 pi wave / N), wave = 0 .. N/2
 * (wave and -wave have the same factors: the matrices are each other's conjugate). A ring: as exp(i wave angle), wave
 * the circumferential wave number. A model cut by mirror planes: what model->held says. */
#ifndef VES_SHELL_BUCKLING_H
#define VES_SHELL_BUCKLING_H

#include "shell/shell.h"

typedef struct ves_shell_buckled {
    double factor;      /* HUGE_VAL: no load of this kind makes it buckle */
    int symmetry, wave; /* its class; 0: as the loads, k: model->held[k - 1] */
    int classes, solves;
} ves_shell_buckled;

/* Over all classes. Waves of a ring are tried from 0 on, until the factor has been above 1.5 times the least for five
 * and the wave is beyond the largest of a cylinder that is compressed (twice that of the circle of the wave numbers that buckle together:
 * (12 (1 - nu^2))^(1/4) sqrt(R / t) with the largest distance R from the axis and the least thickness t).
 * VES_LOOSE: in some class it can move without strain. VES_NO_CONVERGENCE. */
ves_status ves_shell_buckling(ves_shell *shell, int which, ves_shell_buckled *found);

int ves_shell_waves(
    const ves_shell *shell); /* of a class of mirrors: how many waves there are; a ring: at most */
ves_status ves_shell_buckling_class(ves_shell *shell, int which, int symmetry, int wave,
                                    ves_shell_buckled *found);

/* Until the next solve: displacement of node s in the mode that was found last, real and imaginary part; the largest is
 * of length 1. In copy c of a sector, turned c times, it is Re (exp(i c 2 pi wave / N) (U[0] + i U[1])). */
void ves_shell_mode(const ves_shell *shell, int sheet, int s, double U[2][3]);

#endif
