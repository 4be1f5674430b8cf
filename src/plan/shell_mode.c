/* Modes of buckling of a whole shell, of which a sector was solved: from one copy to the next they go on as their class
 * says (shell/buckling.h). */
#include "plan/shell.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

enum { LINE = VES_SHELL_ORDER + 1 };

/* Of the mirror planes at `from` and `to`: is the mode odd about it? Classes as in shell_weld.c, one plane cut twice or
 * two planes. */
static bool odd_about(const plan_sector *s, const ves_shell_buckled *mode, int end)
{
    if (!s->mirrored || !mode->symmetry) return false;
    return s->folds == 1 || (mode->symmetry >> end & 1);
}

static bool reflects(double map[3][3])
{
    double across[3];
    ves_cross(map[0], map[1], across);
    return ves_dot(across, map[2]) < 0;
}

double ves_sector_mode(const plan_sector *s, const ves_shell_buckled *mode, double v, double map[3][3],
                       double phase[2])
{
    double place = ves_sector_place(s, v, map), period = VES_TWO_PI / s->folds, at = v - s->from;
    double copy = s->whole ? 0 : floor(at / period + 1e-12), angle = s->ring ? at : copy * period;
    /* a turn by a fold is a reflection in one plane after one in the other */
    bool turned = odd_about(s, mode, 0) != odd_about(s, mode, 1) && fmod(fabs(copy), 2) != 0;
    bool behind = odd_about(s, mode, 1) && reflects(map);
    phase[0] = cos(mode->wave * angle), phase[1] = sin(mode->wave * angle);
    for (int k = 0; k < 2 && turned != behind; k++) phase[k] = -phase[k];
    return place;
}

/* The element of a row of them that has x, and the values there of its functions. */
static int row_at(const ves_shell_sheet *sheet, int d, double x, double value[LINE])
{
    const double *knot = sheet->knot[d];
    double node[LINE], slope[LINE];
    int k = 0;
    while (k + 1 < sheet->elements[d] && x > knot[k + 1]) k++;
    double inside = 2 * (x - knot[k]) / (knot[k + 1] - knot[k]) - 1;
    ves_rule_nodes(sheet->order[d], node);
    ves_rule_lagrange(sheet->order[d] + 1, node, fmin(1, fmax(-1, inside)), value, slope);
    return k * sheet->order[d];
}

void ves_shell_mode_at(const plan_shell *shell, const ves_shell_buckled *mode, int part, double u, double v,
                       double U[3])
{
    const ves_shell_sheet *sheet = &shell->sheet[part];
    double map[3][3], phase[2], along[LINE], across[LINE], sum[3] = {0};
    double place = ves_sector_mode(&shell->sector, mode, v, map, phase);
    int rows = ves_shell_rows(sheet), columns = ves_shell_columns(sheet);
    int row = row_at(sheet, 0, u, along), column = row_at(sheet, 1, place, across);
    for (int j = 0; j <= sheet->order[1]; j++)
        for (int i = 0; i <= sheet->order[0]; i++) {
            double here[2][3], weight = along[i] * across[j];
            ves_shell_mode(shell->shell, part, (column + j) % columns * rows + row + i, here);
            for (int c = 0; c < 3; c++) sum[c] += weight * (phase[0] * here[0][c] - phase[1] * here[1][c]);
        }
    for (int c = 0; c < 3; c++) U[c] = ves_dot(map[c], sum);
}
