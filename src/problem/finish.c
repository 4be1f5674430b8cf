/* After everything is read: the number block as the plan takes it, and a look for names that drive nothing. */
#include <string.h>

#include "problem/reader.h"

enum { IDLE, BY_UNUSED_CURVE, DRIVES };

/* A curve that a used curve is made of is used. Inputs come before users. */
static void spread_curves(ves_reader *reader)
{
    for (int k = reader->curves_read - 1; k >= 0; k--) {
        const ves_curve_def *curve = &reader->curve[k];
        for (int i = 0; reader->curve_used[k] && i < curve->inputs; i++)
            if (curve->input[i] >= 0) reader->curve_used[curve->input[i]] = true;
    }
}

static int weight_of(const ves_reader *reader, int owner)
{
    if (owner == -1) return DRIVES;
    if (owner < -1) return IDLE; /* parameters count where they are used, checks never */
    int curve = reader->curves.name[owner].index;
    bool used = curve >= 0 ? reader->curve_used[curve] : reader->family[owner].used;
    return used ? DRIVES : BY_UNUSED_CURVE;
}

static void mark_slots(const ves_reader *reader, const ves_formula *formula, int weight, char *use)
{
    if (!formula || weight == IDLE || ves_formula_is_constant(formula, NULL)) return;
    for (int k = 0; k < reader->slots; k++)
        if (use[k] < weight && ves_formula_uses_slot(formula, k)) use[k] = (char)weight;
}

/* After other errors formulas are missing; then only a name that stands nowhere is sure to be idle. */
static bool stands_nowhere(const ves_reader *reader, const ves_fields *root, const char *name)
{
    if (ves_reader_full(reader)) return false;
    if (!ves_node_find(ves_fields_find(root, "variables"), name)) return false; /* by vary or solve */
    for (int k = 0; k < root->count; k++) {
        const ves_field *f = &root->field[k];
        bool declares = !strcmp(f->key->name, "variables") || !strcmp(f->key->name, "start");
        if (f->node && !declares && ves_node_mentions(f->node, name)) return false;
    }
    return true;
}

static void idle(ves_reader *reader, const ves_fields *root, const ves_variable *v, bool sure)
{
    static const char text[] = "variable \"%s\" drives nothing: no curve, patch, measure or goal uses it";
    if (!sure && !stands_nowhere(reader, root, v->name)) return;
    if (reader->script->edit)
        ves_reader_warn(reader, v->mark, text, v->name); /* --set may well have done that */
    else
        ves_reader_fail(reader, VES_NAME, v->mark, text, v->name);
}

static void check_use(ves_reader *reader, const ves_fields *root)
{
    const ves_problem *p = reader->problem;
    char *use = ves_arena_take(reader->arena, (size_t)reader->slots, 1);
    if (!ves_reader_memory(reader, use)) return;
    for (int k = 0; k < reader->uses; k++)
        mark_slots(reader, reader->use[k].formula, weight_of(reader, reader->use[k].owner), use);
    int first = p->variables + p->unknowns;
    bool sure = reader->status == VES_OK;
    for (int k = p->parameters - 1; k >= 0; k--)
        mark_slots(reader, p->parameter[k].formula, use[first + k], use);
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        if (use[k] == IDLE)
            idle(reader, root, v, sure);
        else if (use[k] == BY_UNUSED_CURVE && sure)
            ves_reader_warn(reader, v->mark, "variable \"%s\" moves only a curve that no patch uses",
                            v->name);
    }
    const ves_node *unknown = ves_node_find(ves_fields_find(root, "solve"), "unknown");
    if (p->unknowns && use[p->variables] == IDLE && sure)
        ves_reader_error(reader, VES_NAME, unknown, "the unknown \"%s\" drives nothing", p->solve->name);
}

static void number_block(ves_reader *reader)
{
    ves_problem *p = reader->problem;
    p->slots = reader->slots;
    p->numbers = reader->numbers;
    p->block = p->slots + p->numbers;
    const ves_formula **number = ves_arena_take(reader->arena, (size_t)p->numbers, sizeof *number);
    bool *varying = ves_arena_take(reader->arena, (size_t)p->block, sizeof *varying);
    if (!ves_reader_memory(reader, number) || !ves_reader_memory(reader, varying)) return;
    for (int k = 0; k < p->slots; k++) varying[k] = reader->varying[k];
    for (int k = 0; k < p->numbers; k++) {
        number[k] = reader->number[k];
        varying[p->slots + k] = ves_reader_varies(reader, number[k]);
    }
    p->number = number;
    p->varying = varying;
}

/* What nothing uses may leave its range. */
static void limits(ves_reader *reader)
{
    ves_limit *limit = ves_arena_take(reader->arena, (size_t)reader->limits, sizeof *limit);
    if (!ves_reader_memory(reader, limit)) return;
    for (int k = 0; k < reader->limits; k++)
        if (weight_of(reader, reader->limit[k].owner) == DRIVES)
            limit[reader->problem->limits++] = reader->limit[k].limit;
    reader->problem->limit = limit;
}

void ves_reader_finish(ves_reader *reader, const ves_fields *root)
{
    spread_curves(reader);
    ves_reader_shell_finish(reader);
    check_use(reader, root);
    if (reader->status == VES_OK) number_block(reader);
    if (reader->status == VES_OK) ves_reader_shown(reader, root);
    if (reader->status == VES_OK) limits(reader);
}
