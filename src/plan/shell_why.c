/* What of a shell is behind a verdict, told with its place in the file: how it moves that is not held; where it has
 * no wall, or one that turns over; which load is no number. */
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

static bool loose_tell(const ves_plan *plan, const char *what, ves_diag *diag)
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

/* "bowl" at u = 0.5, v = 1, in the u and v of the patch's own formulas. */
static void node_text(const ves_plan *plan, const plan_shell *shell, int part, int s, char text[PLACE])
{
    const plan_shell_part *p = &shell->part[part];
    int rows = ves_shell_rows(&shell->sheet[part]);
    double own[2];
    ves_plan_domain_at(plan, p->patch, p->u[s % rows], p->v[s / rows], own);
    snprintf(text, PLACE, "\"%.80s\" at u = %.4g, v = %.4g", plan->problem->patch[p->patch].name, own[0],
             own[1]);
}

static bool wall_tell(const ves_plan *plan, const plan_shell *shell, const char *what, ves_diag *diag)
{
    for (int k = 0; k < shell->def->parts; k++)
        for (int s = 0; s < shell->part[k].count; s++) {
            double t = shell->part[k].thickness[s];
            char at[PLACE], thick[VES_QUANTITY];
            if (t > 0) continue;
            node_text(plan, shell, k, s, at);
            ves_quantity_text(t, (ves_dim){.m = SIXTHS}, plan->problem->units, thick);
            ves_diag_add(diag, VES_WARNING, VES_NO_WALL, shell->def->part[k].mark,
                         "%s: the thickness of %s must be > 0, got %s", what, at,
                         isnan(t) ? "no number" : thick);
            return true;
        }
    return false;
}

static bool turned_tell(const ves_plan *plan, const plan_shell *shell, const char *what, ves_diag *diag)
{
    char at[PLACE], thick[VES_QUANTITY];
    int part, s;
    ves_shell_turned(shell->shell, &part, &s);
    node_text(plan, shell, part, s, at);
    ves_quantity_text(shell->part[part].thickness[s], (ves_dim){.m = SIXTHS}, plan->problem->units, thick);
    ves_diag_add(
        diag, VES_WARNING, VES_DEGENERATE, shell->def->part[part].mark,
        "%s: an element of %s, %s thick, turns over: its wall is thicker than twice a radius of curvature "
        "there, or the mesh does not follow the surface",
        what, at, thick);
    return true;
}

static bool odd_tell(const ves_plan *plan, const plan_shell *shell, const char *what, ves_diag *diag)
{
    const plan_shell_odd *odd = &shell->odd;
    char at[PLACE] = "";
    if (!odd->found) return false;
    if (odd->part >= 0) node_text(plan, shell, odd->part, odd->s, at);
    ves_diag_add(diag, VES_WARNING, VES_NO_NUMBER, odd->mark, "%s: this %s%s is %s", what,
                 odd->part < 0 ? "spring" : "load, on ", at, isnan(odd->value) ? "not a number" : "infinite");
    return true;
}

bool ves_shell_why(const ves_plan *plan, ves_status status, const char *what, ves_diag *diag)
{
    if (status == VES_LOOSE) return loose_tell(plan, what, diag);
    for (int k = 0; k < LEVELS; k++) {
        const plan_shell *shell = plan->level[k].shell;
        if (!shell || !shell->solved || shell->outcome != status) continue;
        if (status == VES_NO_WALL) return wall_tell(plan, shell, what, diag);
        if (status == VES_DEGENERATE) return turned_tell(plan, shell, what, diag);
        if (status == VES_NO_NUMBER) return odd_tell(plan, shell, what, diag);
    }
    return false;
}
