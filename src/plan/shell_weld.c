/* Which nodes of the sheets are one, and what holds them. Sheets are welded along their edges, where these lie on each
 * other at every design that is looked at; what is welded may be a fold. */
#include "plan/shell.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* Of the shell's size: nodes that are meant to be one; and of normals that are meant to be alike (rad): a fold that is
 * less is not felt. */
static const double SAME = 1e-9, FOLD = 1e-4;

typedef struct rim_node {
    int part, s;
    double X[SHELL_DESIGNS][3], normal[SHELL_DESIGNS][3]; /* the outward one */
} rim_node;

/* --- the nodes on edges, at all designs --- */

static int rims_count(const plan_shell *shell)
{
    int count = 0;
    for (int k = 0; k < shell->def->parts; k++)
        for (int e = 0; e < VES_SHELL_EDGES; e++) count += ves_shell_edge_count(&shell->sheet[k], e);
    return count;
}

static bool is_new(const rim_node *rim, int count, int part, int s)
{
    for (int k = 0; k < count; k++)
        if (rim[k].part == part && rim[k].s == s) return false;
    return true;
}

/* What lies on the far side of a sector is no node of its own. */
static bool is_far(const plan_shell *shell, int part, int s)
{
    const ves_shell_sheet *sheet = &shell->sheet[part];
    bool turned = !shell->sector.whole && !shell->sector.mirrored;
    return turned && s / ves_shell_rows(sheet) == ves_shell_columns(sheet) - 1;
}

static int rims_list(const plan_shell *shell, rim_node *rim)
{
    int count = 0;
    for (int k = 0; k < shell->def->parts; k++) {
        int first = count;
        for (int e = 0; e < (shell->sheet[k].closed ? 2 : VES_SHELL_EDGES); e++)
            for (int i = 0; i < ves_shell_edge_count(&shell->sheet[k], e); i++) {
                int s = ves_shell_edge_node(&shell->sheet[k], e, i);
                if (!is_far(shell, k, s) && is_new(rim + first, count - first, k, s))
                    rim[count++] = (rim_node){.part = k, .s = s};
            }
    }
    return count;
}

/* Positions and normals of all of them at the design that is bound: those of the sites. */
static ves_status rims_sample(ves_plan *plan, const plan_shell *shell, int design, rim_node *rim, int count)
{
    const plan_level *l = &plan->level[shell->level];
    for (int k = 0; k < shell->def->parts; k++) {
        ves_status status = ves_site_sample(plan, &plan->level[shell->level].site[shell->part[k].site],
                                            VES_X | VES_NORMAL, false);
        if (status < 0) return status;
    }
    for (int k = 0; k < count; k++) {
        const ves_samples *m = &l->site[shell->part[rim[k].part].site].samples;
        for (int c = 0; c < 3; c++)
            rim[k].X[design][c] = m->X[c][rim[k].s], rim[k].normal[design][c] = m->normal[c][rim[k].s];
    }
    return VES_OK;
}

static double size_of(const rim_node *rim, int count, int design)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, size = 0;
    for (int k = 0; k < count; k++)
        for (int c = 0; c < 3; c++)
            low[c] = fmin(low[c], rim[k].X[design][c]), high[c] = fmax(high[c], rim[k].X[design][c]);
    for (int c = 0; c < 3; c++) size = fmax(size, high[c] - low[c]);
    return size;
}

/* What is no number at some design tells nothing there. */
static bool same(const rim_node *a, const rim_node *b, const double size[SHELL_DESIGNS])
{
    for (int d = 0; d < SHELL_DESIGNS; d++)
        for (int c = 0; c < 3; c++)
            if (fabs(a->X[d][c] - b->X[d][c]) > SAME * size[d]) return false;
    return true;
}

static bool folded(const rim_node *a, const rim_node *b)
{
    for (int d = 0; d < SHELL_DESIGNS; d++) {
        double across[3];
        ves_cross(a->normal[d], b->normal[d], across);
        if (ves_dot(across, across) > FOLD * FOLD || ves_dot(a->normal[d], b->normal[d]) < 0) return true;
    }
    return false;
}

/* --- welding --- */

static void number_inside(plan_shell *shell)
{
    for (int k = 0; k < shell->def->parts; k++)
        for (int s = 0; s < shell->part[k].count; s++)
            if (shell->part[k].weld[s] < 0 && !is_far(shell, k, s)) shell->part[k].weld[s] = shell->nodes++;
}

/* The far side of a sector is the near side of it, turned. */
static void sector_close(const plan_shell *shell, int k)
{
    int rows = ves_shell_rows(&shell->sheet[k]);
    plan_shell_part *part = &shell->part[k];
    for (int s = 0; s < part->count; s++)
        if (is_far(shell, k, s)) part->far[s] = true, part->weld[s] = part->weld[s % rows];
}

/* Edges first; of welded nodes the first gives the number. */
static void weld(plan_shell *shell, rim_node *rim, int count, const double size[SHELL_DESIGNS], bool *fold)
{
    for (int k = 0; k < shell->def->parts; k++)
        for (int s = 0; s < shell->part[k].count; s++) shell->part[k].weld[s] = -1;
    for (int b = 0; b < count; b++) {
        int *own = &shell->part[rim[b].part].weld[rim[b].s];
        for (int a = 0; a < b && *own < 0; a++)
            if (same(&rim[a], &rim[b], size)) {
                *own = shell->part[rim[a].part].weld[rim[a].s];
                fold[*own] = fold[*own] || folded(&rim[a], &rim[b]);
            }
        if (*own < 0) *own = shell->nodes++;
    }
    number_inside(shell);
    for (int k = 0; k < shell->def->parts; k++) sector_close(shell, k);
}

ves_status ves_shell_weld(ves_plan *plan, plan_shell *shell)
{
    int most = rims_count(shell), all = 0;
    double size[SHELL_DESIGNS];
    for (int k = 0; k < shell->def->parts; k++) all += shell->part[k].count;
    rim_node *rim = ves_arena_take(&plan->arena, (size_t)most, sizeof *rim);
    bool *fold = ves_arena_take(&plan->arena, (size_t)all, sizeof *fold);
    shell->node = ves_arena_take(&plan->arena, (size_t)all, sizeof *shell->node);
    if (!rim || !fold || !shell->node) return VES_MEMORY;
    int count = rims_list(shell, rim);
    for (int d = SHELL_DESIGNS - 1; d >= 0; d--) { /* the start last: it stays bound */
        ves_shell_design(plan, d);
        VES_TRY(rims_sample(plan, shell, d, rim, count));
        size[d] = size_of(rim, count, d);
    }
    weld(shell, rim, count, size, fold);
    for (int k = 0; k < shell->nodes; k++) shell->node[k].fold = fold[k];
    return VES_OK;
}

/* --- what is held --- */

/* Directions along which a node may not move, and axes about which it may not turn. */
typedef struct hold {
    double move[8][3], turn[12][3];
    int moves, turns;
} hold;

/* Adds a unit vector, but what lies in those that are there. */
static void direction_add(double (*list)[3], int *count, const double a[3])
{
    double rest[3];
    memcpy(rest, a, sizeof rest);
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < *count; k++) {
            double along = ves_dot(rest, list[k]);
            for (int c = 0; c < 3; c++) rest[c] -= along * list[k][c];
        }
    double length = sqrt(ves_dot(rest, rest));
    if (length < 1e-6 || *count > 2) return;
    for (int c = 0; c < 3; c++) list[*count][c] = rest[c] / length;
    ++*count;
}

static void across_add(double (*list)[3], int *count, const double axis[3])
{
    double t[3] = {0}, b[3];
    int least = fabs(axis[0]) <= fabs(axis[1]) ? 0 : 1;
    if (fabs(axis[2]) < fabs(axis[least])) least = 2;
    t[least] = 1;
    double along = ves_dot(t, axis);
    for (int c = 0; c < 3; c++) t[c] -= along * axis[c];
    double length = sqrt(ves_dot(t, t));
    for (int c = 0; c < 3; c++) t[c] /= length;
    ves_cross(axis, t, b);
    direction_add(list, count, t);
    direction_add(list, count, b);
}

static void mirror_add(hold *h, const double normal[3])
{
    direction_add(h->move, &h->moves, normal);
    across_add(h->turn, &h->turns, normal);
}

static void support_add(hold *h, const ves_support_def *support)
{
    if (support->kind == VES_SUPPORT_SYMMETRY) mirror_add(h, support->axis);
    if (support->kind == VES_SUPPORT_DIAPHRAGM) across_add(h->move, &h->moves, support->axis);
    for (int k = 0; k < 6 && support->kind == VES_SUPPORT_FIX; k++) {
        double e[3] = {0};
        e[k % 3] = 1;
        if (support->fix >> k & 1) direction_add(k < 3 ? h->move : h->turn, k < 3 ? &h->moves : &h->turns, e);
    }
}

/* How much of e lies in a list of orthonormal directions: 0 .. 1. */
static double within(double (*list)[3], int count, const double e[3])
{
    double sum = 0;
    for (int k = 0; k < count; k++) sum += ves_dot(list[k], e) * ves_dot(list[k], e);
    return sum;
}

/* A frame whose axes begin with the directions along which the node is held, then those about which. False: an axis of it
 * would have to be held about partly. */
static bool frame_make(hold *h, ves_shell_node *node)
{
    double axis[3][3];
    int count = 0;
    for (int k = 0; k < h->moves; k++) direction_add(axis, &count, h->move[k]);
    for (int k = 0; k < h->turns; k++) direction_add(axis, &count, h->turn[k]);
    for (int k = 0; k < 3; k++) {
        double e[3] = {0};
        e[k] = 1;
        direction_add(axis, &count, e);
    }
    node->held = 0;
    for (int k = 0; k < 3; k++) {
        double turns = within(h->turn, h->turns, axis[k]);
        memcpy(node->frame[k], axis[k], sizeof axis[k]);
        if (k < h->moves) node->held |= 1u << k;
        if (turns > 1e-6 && turns < 1 - 1e-6) return false;
        if (turns > 0.5) node->held |= 8u << k;
    }
    return true;
}

void ves_shell_spot_find(const ves_plan *plan, const plan_shell *shell, const ves_shell_at *at,
                         ves_shell_spot *spot)
{
    const ves_place *place = &plan->problem->place[at->index];
    const plan_shell_part *part = &shell->part[at->part];
    int rows = ves_shell_rows(&shell->sheet[at->part]), columns = part->count / rows, i = 0, j = 0;
    double u = plan->block[place->u], v = ves_sector_place(&shell->sector, plan->block[place->v], spot->map);
    for (int k = 1; k < rows; k++)
        if (fabs(part->u[k] - u) < fabs(part->u[i] - u)) i = k;
    for (int k = 1; k < columns; k++)
        if (fabs(part->v[k] - v) < fabs(part->v[j] - v)) j = k;
    spot->sheet = at->part, spot->edge = -1, spot->s = j * rows + i;
}

int ves_shell_place(const ves_plan *plan, const plan_shell *shell, const ves_shell_at *at)
{
    ves_shell_spot spot;
    ves_shell_spot_find(plan, shell, at, &spot);
    return spot.s;
}

/* Calls of each node, once or more, that a support is at. */
static void support_spread(ves_plan *plan, const plan_shell *shell, const ves_support_def *support, hold *h)
{
    const ves_shell_at *at = &support->at;
    if (support->kind == VES_SUPPORT_SPRING) return;
    if (at->kind == VES_AT_PLACE)
        support_add(&h[shell->part[at->part].weld[ves_shell_place(plan, shell, at)]], support);
    for (int k = 0; k < at->edges; k++)
        for (int i = 0; i < ves_shell_edge_count(&shell->sheet[at->on[k].part], at->on[k].edge); i++) {
            int s = ves_shell_edge_node(&shell->sheet[at->on[k].part], at->on[k].edge, i);
            support_add(&h[shell->part[at->on[k].part].weld[s]], support);
        }
}

/* In a plane of antisymmetry nothing moves along it, nor turns about its normal. */
static void antisymmetry_add(hold *h, const double normal[3])
{
    across_add(h->move, &h->moves, normal);
    direction_add(h->turn, &h->turns, normal);
}

/* The planes that a mirrored sector ends on; first, so that frames begin with their normals. odd: bit 0, 1: what happens is
 * antisymmetric about the first, the second; of half a shell both are one. */
static void sector_hold(const plan_shell *shell, unsigned odd, hold *h)
{
    for (int k = 0; k < shell->def->parts && shell->sector.mirrored; k++)
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < ves_shell_edge_count(&shell->sheet[k], 2 + end); i++) {
                int node = shell->part[k].weld[ves_shell_edge_node(&shell->sheet[k], 2 + end, i)];
                if (odd >> end & 1)
                    antisymmetry_add(&h[node], shell->sector.mirror[end]);
                else
                    mirror_add(&h[node], shell->sector.mirror[end]);
            }
}

static ves_status refuse(const plan_shell *shell, ves_diag *diag)
{
    return ves_diag_add(
        diag, VES_ERROR, VES_RANGE, shell->def->support[0].mark,
        "supports of the shell that meet at one place hold it along or about axes that are askew to each "
        "other: fix: all there, or mirror planes at right angles");
}

/* What is held, in the frame that there is. False: an axis of it partly. */
static bool mask_make(hold *h, const ves_shell_node *node, unsigned *held)
{
    *held = 0;
    for (int k = 0; k < 3; k++) {
        double moves = within(h->move, h->moves, node->frame[k]),
               turns = within(h->turn, h->turns, node->frame[k]);
        if (moves > 1e-6 && moves < 1 - 1e-6) return false;
        if (turns > 1e-6 && turns < 1 - 1e-6) return false;
        if (moves > 0.5) *held |= 1u << k;
        if (turns > 0.5) *held |= 8u << k;
    }
    return true;
}

/* The classes of modes that are antisymmetric about a plane that the sector ends on. */
static ves_status classes_hold(ves_plan *plan, plan_shell *shell, hold *h, ves_diag *diag)
{
    static const unsigned BOTH[] = {3}, EACH[] = {1, 2, 3};
    const unsigned *odd = shell->sector.folds == 1 ? BOTH : EACH;
    int classes = shell->buckles && shell->sector.mirrored ? shell->sector.folds == 1 ? 1 : 3 : 0;
    shell->held = ves_arena_take(&plan->arena, (size_t)classes, sizeof *shell->held);
    if (!shell->held) return VES_MEMORY;
    for (int c = 0; c < classes; c++) {
        unsigned *held = ves_arena_take(&plan->arena, (size_t)shell->nodes, sizeof *held);
        if (!held) return VES_MEMORY;
        memset(h, 0, sizeof *h * (size_t)shell->nodes);
        sector_hold(shell, odd[c], h);
        for (int k = 0; k < shell->def->supports; k++)
            support_spread(plan, shell, &shell->def->support[k], h);
        for (int k = 0; k < shell->nodes; k++)
            if (!mask_make(&h[k], &shell->node[k], &held[k])) return refuse(shell, diag);
        shell->held[c] = held;
    }
    shell->model.classes = classes;
    return VES_OK;
}

ves_status ves_shell_hold(ves_plan *plan, plan_shell *shell, ves_diag *diag)
{
    const ves_shell_def *def = shell->def;
    hold *h = ves_arena_take(&plan->arena, (size_t)shell->nodes, sizeof *h);
    if (!h) return VES_MEMORY;
    sector_hold(shell, 0, h);
    for (int k = 0; k < def->supports; k++) support_spread(plan, shell, &def->support[k], h);
    for (int k = 0; k < shell->nodes; k++)
        if (!frame_make(&h[k], &shell->node[k])) return refuse(shell, diag);
    return classes_hold(plan, shell, h, diag);
}

/* --- what measures ask of it --- */

static void grip_add(const ves_plan *plan, const plan_shell *shell, const ves_shell_at *at, bool *node)
{
    if (at->kind == VES_AT_PLACE) node[shell->part[at->part].weld[ves_shell_place(plan, shell, at)]] = true;
    for (int k = 0; k < at->edges; k++)
        for (int i = 0; i < ves_shell_edge_count(&shell->sheet[at->on[k].part], at->on[k].edge); i++)
            node[shell->part[at->on[k].part]
                     .weld[ves_shell_edge_node(&shell->sheet[at->on[k].part], at->on[k].edge, i)]] = true;
}

/* What one direction is held by, all are: supports at one place are the same along it. */
static ves_status grip_make(ves_plan *plan, const plan_shell *shell, const ves_shell_at *at,
                            ves_shell_grip *grip)
{
    const ves_shell_def *def = shell->def;
    bool *node = ves_arena_take(&plan->arena, (size_t)shell->nodes, sizeof *node);
    bool *spring = ves_arena_take(&plan->arena, (size_t)shell->model.springs, sizeof *spring);
    hold h = {.moves = 0};
    if (!node || !spring) return VES_MEMORY;
    for (int k = 0, sprung = 0; k < def->supports; k++) {
        const ves_support_def *s = &def->support[k];
        const bool springs = s->kind == VES_SUPPORT_SPRING, here = ves_shell_at_meets(at, &s->at);
        if (here) support_add(&h, s), grip_add(plan, shell, at, node);
        if (springs && s->at.kind == VES_AT_PLACE)
            grip->sprung = grip->sprung || here;
        else if (springs)
            spring[sprung++] = here;
    }
    for (int k = 0; k < h.moves; k++)
        for (int i = 0; i < 9; i++) grip->held[i / 3][i % 3] += h.move[k][i / 3] * h.move[k][i % 3];
    grip->node = node, grip->spring = spring;
    return VES_OK;
}

ves_status ves_shell_grips_make(ves_plan *plan, plan_shell *shell)
{
    shell->grip = ves_arena_take(&plan->arena, (size_t)shell->def->ats, sizeof *shell->grip);
    if (!shell->grip) return VES_MEMORY;
    for (int k = 0; k < shell->def->ats; k++)
        VES_TRY(grip_make(plan, shell, &shell->def->at[k], &shell->grip[k]));
    return VES_OK;
}
