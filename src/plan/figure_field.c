/* What a figure knows of its shell's solution, that of the mesh of searches: stresses and displacements of each case at the nodes
 * of the parts, over the whole shell where a sector of it was solved. */
#include "base/vector.h"
#include "plan/shell.h"

#include <math.h>
#include <string.h>

enum { OF_A_CASE = 3, MOST = OF_A_CASE + 1, LINE = VES_SHELL_ORDER + 1 };

typedef double stress_size(const double stress[VES_STRESSES]);

/* A place of a part, in the element that has it. */
typedef struct spot {
    int part, element[2];
    double at[2], map[3][3]; /* -1 .. 1; displacements there are map times those of the element */
} spot;

static void element_at(const double *knot, int elements, double x, int *element, double *at)
{
    int k = 0;
    while (k + 1 < elements && x > knot[k + 1]) k++;
    double inside = 2 * (x - knot[k]) / (knot[k + 1] - knot[k]) - 1;
    *element = k;
    *at = fmin(1, fmax(-1, inside));
}

static spot spot_of(const plan_shell *shell, int part, const ves_figure_patch *p, int node)
{
    const ves_shell_sheet *sheet = &shell->sheet[part];
    spot s = {.part = part};
    double v = ves_sector_place(&shell->sector, ves_figure_v(p, node), s.map);
    element_at(sheet->knot[0], sheet->elements[0], ves_figure_u(p, node), &s.element[0], &s.at[0]);
    element_at(sheet->knot[1], sheet->elements[1], v, &s.element[1], &s.at[1]);
    return s;
}

/* --- stresses: linear between the places where the elements report them --- */

static int first_point(const ves_shell_stresses *stresses, const plan_shell *shell, const spot *s)
{
    int first = 0;
    for (int k = 0; k <= s->part; k++) {
        const int *points = stresses->lattice[k], *elements = shell->sheet[k].elements;
        int before = k < s->part ? elements[0] * elements[1] : s->element[1] * elements[0] + s->element[0];
        first += before * points[0] * points[1];
    }
    return first;
}

static void cell_at(int points, double at, int *cell, double *share)
{
    double x = points > 1 ? (at + 1) / 2 * (points - 1) : 0;
    *cell = (int)fmin(floor(x), fmax(0, points - 2));
    *share = x - *cell;
}

static double largest(const ves_shell_stresses *stresses, int point, stress_size *size)
{
    double most = 0;
    for (int level = 0; level < VES_SHELL_LEVELS; level++)
        most = fmax(most, size(stresses->stress[point][level]));
    return most;
}

static double stress_at(const ves_shell_stresses *stresses, const plan_shell *shell, const spot *s,
                        stress_size *size)
{
    const int *points = stresses->lattice[s->part];
    int i, j, first = first_point(stresses, shell, s);
    double a, b, sum = 0, weights = 0;
    cell_at(points[0], s->at[0], &i, &a);
    cell_at(points[1], s->at[1], &j, &b);
    for (int k = 0; k < 4; k++) {
        double weight = (k & 1 ? a : 1 - a) * (k & 2 ? b : 1 - b);
        if (weight == 0) continue;
        double here = largest(stresses, first + (j + (k >> 1)) * points[0] + i + (k & 1), size);
        if (here > 0) sum += weight * here, weights += weight; /* a pole has none */
    }
    return weights > 0 ? sum / weights : 0;
}

/* --- displacements: the elements' own --- */

/* moved [nodes of the sheet]: displacements there */
static void displacement_at(const plan_shell *shell, const double (*moved)[3], const spot *s, double U[3])
{
    const ves_shell_sheet *sheet = &shell->sheet[s->part];
    int rows = ves_shell_rows(sheet), columns = ves_shell_columns(sheet);
    double node[LINE], value[2][LINE], slope[LINE], sum[3] = {0};
    for (int d = 0; d < 2; d++) {
        ves_rule_nodes(sheet->order[d], node);
        ves_rule_lagrange(sheet->order[d] + 1, node, s->at[d], value[d], slope);
    }
    for (int j = 0; j <= sheet->order[1]; j++)
        for (int i = 0; i <= sheet->order[0]; i++) {
            int column = (s->element[1] * sheet->order[1] + j) % columns;
            const double weight = value[0][i] * value[1][j],
                         *here = moved[column * rows + s->element[0] * sheet->order[0] + i];
            for (int c = 0; c < 3; c++) sum[c] += weight * here[c];
        }
    for (int c = 0; c < 3; c++) U[c] = ves_dot(s->map[c], sum);
}

/* --- fields --- */

static ves_status planes_make(const plan_shell *shell, ves_figure *figure, ves_figure_field *field)
{
    bool vector = !strcmp(field->name, "displacement") || !strcmp(field->name, "mode");
    size_t patches = (size_t)figure->patches;
    field->value = ves_arena_take(&figure->arena, patches, sizeof *field->value);
    if (vector) field->vector = ves_arena_take(&figure->arena, patches, sizeof *field->vector);
    if (!field->value || (vector && !field->vector)) return VES_MEMORY;
    for (int part = 0; part < shell->def->parts; part++) {
        int k = shell->def->part[part].patch;
        size_t count = (size_t)(figure->patch[k].rows * figure->patch[k].columns);
        if (!(field->value[k] = ves_arena_doubles(&figure->arena, count))) return VES_MEMORY;
        for (int c = 0; vector && c < 3; c++)
            if (!(field->vector[k][c] = ves_arena_doubles(&figure->arena, count))) return VES_MEMORY;
    }
    return VES_OK;
}

static void part_fill(const plan_shell *shell, const ves_figure *figure, int which, int part,
                      const double (*moved)[3], const ves_figure_field *field)
{
    const ves_shell_stresses *stresses = ves_shell_stress(shell->shell, which);
    int k = shell->def->part[part].patch;
    const ves_figure_patch *p = &figure->patch[k];
    for (int node = 0; node < p->rows * p->columns; node++) {
        const spot s = spot_of(shell, part, p, node);
        double U[3];
        displacement_at(shell, moved, &s, U);
        field[0].value[k][node] = stress_at(stresses, shell, &s, ves_stress_shear);
        field[1].value[k][node] = stress_at(stresses, shell, &s, ves_stress_mises);
        field[2].value[k][node] = sqrt(ves_dot(U, U));
        for (int c = 0; c < 3; c++) field[2].vector[k][c][node] = U[c];
    }
}

static ves_status case_fill(const plan_shell *shell, const ves_figure *figure, int which,
                            const ves_figure_field *field)
{
    ves_arena arena = {0};
    ves_status status = VES_OK;
    for (int part = 0; part < shell->def->parts && status == VES_OK; part++) {
        double(*moved)[3] = ves_arena_take(&arena, (size_t)shell->part[part].count, sizeof *moved),
        director[3];
        status = moved ? VES_OK : VES_MEMORY;
        for (int s = 0; moved && s < shell->part[part].count; s++)
            ves_shell_displacement(shell->shell, which, part, s, moved[s], director);
        if (moved) part_fill(shell, figure, which, part, (const double(*)[3])moved, field);
    }
    ves_arena_destroy(&arena);
    return status;
}

static ves_status case_make(const plan_shell *shell, ves_figure *figure, int which, ves_figure_field *field)
{
    const char *given = shell->def->load_case[which].name,
               *name = ves_arena_text(&figure->arena, given, strlen(given));
    if (!name) return VES_MEMORY;
    const ves_figure_field kind[OF_A_CASE] = {
        {.name = "max_shear", .of = name, .about = "largest shear", .unit = "Pa", .power = -2},
        {.name = "von_mises", .of = name, .about = "von Mises stress", .unit = "Pa", .power = -2},
        {.name = "displacement", .of = name, .about = "displacement", .unit = "m", .power = 1}};
    memcpy(field, kind, sizeof kind);
    for (int k = 0; k < OF_A_CASE; k++) VES_TRY(planes_make(shell, figure, &field[k]));
    return case_fill(shell, figure, which, field);
}

/* --- modes of buckling --- */

/* Does a measure of the file ask for the buckling of a case? */
static bool asks_buckling(const ves_plan *plan, int which)
{
    for (int m = 0; m < plan->problem->measures; m++) {
        const ves_measure_def *def = &plan->problem->measure[m];
        for (int k = 0; def->measure->buckles && plan->runs[PROGRAM_ALL][m] && k < def->args.count; k++)
            if (def->args.key[k].kind == VES_CASE && def->args.arg[k].value == which) return true;
    }
    return false;
}

static void mode_fill(const plan_shell *shell, const ves_figure *figure, const ves_shell_buckled *mode,
                      const ves_figure_field *field)
{
    for (int part = 0; part < shell->def->parts; part++) {
        int k = shell->def->part[part].patch;
        const ves_figure_patch *p = &figure->patch[k];
        for (int node = 0; node < p->rows * p->columns; node++) {
            double U[3];
            ves_shell_mode_at(shell, mode, part, ves_figure_u(p, node), ves_figure_v(p, node), U);
            field->value[k][node] = sqrt(ves_dot(U, U));
            for (int c = 0; c < 3; c++) field->vector[k][c][node] = U[c];
        }
    }
}

/* None where the case does not make it buckle. */
static ves_status mode_make(const plan_shell *shell, ves_figure *figure, int which, const char *name,
                            int *made, ves_figure_field *field)
{
    ves_shell_buckled mode;
    if (ves_shell_buckling(shell->shell, which, &mode) != VES_OK || !isfinite(mode.factor)) return VES_OK;
    *field =
        (ves_figure_field){.name = "mode",
                           .of = name,
                           .about = ves_arena_format(&figure->arena, "buckling at %.4g times", mode.factor)};
    if (!field->about) return VES_MEMORY;
    VES_TRY(planes_make(shell, figure, field));
    mode_fill(shell, figure, &mode, field);
    (*made)++;
    return VES_OK;
}

static ves_status solve(ves_plan *plan, plan_shell *shell)
{
    for (int k = 0; k < shell->def->parts; k++)
        VES_TRY(ves_site_sample(plan, &plan->level[0].site[shell->part[k].site], VES_X | VES_NORMAL, false));
    shell->solved = false;
    return ves_shell_run(plan, 0);
}

/* Of a shell that nothing is asked of, or that has no solution, thickness alone. */
ves_status ves_figure_fields_make(ves_plan *plan, ves_figure *figure)
{
    plan_shell *shell = plan->level[0].shell;
    ves_figure_shell *to = figure->shell;
    if (!to || !to->thickness) return VES_OK;
    const int cases = plan->problem->shell->cases;
    ves_figure_field *field = ves_arena_take(&figure->arena, (size_t)(1 + MOST * cases), sizeof *field);
    if (!field) return VES_MEMORY;
    field[0] = (ves_figure_field){
        .name = "thickness", .about = "thickness", .unit = "m", .value = (double **)to->thickness};
    to->field = field, to->fields = 1;
    ves_status status = shell && shell->solid ? solve(plan, shell) : VES_NO_POINT;
    for (int k = 0; k < cases && status == VES_OK; k++, to->fields += OF_A_CASE)
        VES_TRY(case_make(shell, figure, k, field + to->fields));
    for (int k = 0; k < cases && status == VES_OK; k++)
        if (asks_buckling(plan, k))
            VES_TRY(
                mode_make(shell, figure, k, field[1 + OF_A_CASE * k].of, &to->fields, field + to->fields));
    return status < VES_OK ? status : VES_OK;
}
