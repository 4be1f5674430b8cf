/* How a shell moves that its supports do not hold, told with its place in the file. */
#include "plan/shell.h"

#include <math.h>
#include <stdio.h>

enum { WAY = 96, PLACE = 3 * VES_QUANTITY + 8, SIXTHS = 6 };

static void way_text(const double way[3], char text[WAY])
{
    snprintf(text, WAY, "(%.4g, %.4g, %.4g)", way[0], way[1], way[2]);
}

/* What is rounding beside the farthest coordinate is 0. */
static void place_text(const ves_problem *p, const double at[3], char text[PLACE])
{
    char number[3][VES_QUANTITY];
    double most = fmax(fabs(at[0]), fmax(fabs(at[1]), fabs(at[2])));
    for (int c = 0; c < 3; c++)
        ves_quantity_text(fabs(at[c]) > 1e-9 * most ? at[c] : 0, (ves_dim){.m = SIXTHS}, p->units, number[c]);
    snprintf(text, PLACE, "(%s, %s, %s)", number[0], number[1], number[2]);
}

static const ves_shell_motion *motion_of(const ves_plan *plan)
{
    for (int k = 0; k < LEVELS; k++) {
        const plan_shell *shell = plan->level[k].shell;
        const ves_shell_motion *motion = shell && shell->shell ? ves_shell_loose(shell->shell) : NULL;
        if (motion) return motion;
    }
    return NULL;
}

bool ves_shell_loose_tell(const ves_plan *plan, const char *what, ves_diag *diag)
{
    static const double FELT = 1e-25; /* springs against it, not their rounding */
    const ves_shell_def *def = plan->problem->shell;
    const ves_shell_motion *m = motion_of(plan);
    char way[WAY], place[PLACE] = "", part[VES_QUANTITY] = "it";
    if (!m) return false;
    way_text(m->way, way);
    if (m->turns) place_text(plan->problem, m->at, place);
    if (!m->whole)
        snprintf(part, sizeof part, "\"%.80s\"", plan->problem->patch[def->part[m->sheet].patch].name);
    if (m->firmness > FELT)
        ves_diag_add(
            diag, VES_WARNING, VES_LOOSE, def->support[0].mark,
            "%s: springs alone keep %s from %s %s%s%s, %.2g times as firmly as its wall: too soft to be "
            "felt in a solution, for which %.2g would do",
            what, part, m->turns ? "turning about" : "moving along", way, m->turns ? " through " : "", place,
            m->firmness, m->least);
    else
        ves_diag_add(diag, VES_WARNING, VES_LOOSE, def->support[0].mark,
                     "%s: the supports of the shell let %s %s %s%s%s without strain: hold it there too", what,
                     part, m->turns ? "turn about" : "move along", way, m->turns ? " through " : "", place);
    return true;
}
