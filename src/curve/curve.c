#include "curve/curve.h"

#include <string.h>

#include "curve/modes.h"

/* One operation of one curve, with its own buffers: a gradient needs what every step was given. */
typedef struct step {
    const ves_curve_op *op;
    ves_curve_input input;
    bool varies;
    int *input_modes; /* [input.inputs], which input points at */
    const double **in;
    double *out, *adjoint;  /* 3 * stride; adjoint NULL when the step does not vary */
    double **input_adjoint; /* [input.inputs], filled when all adjoints have their place */
    struct step **source;   /* [input.inputs]: the steps that made the inputs */
} step;

struct ves_curves {
    int count;
    step **curve; /* the last step of each curve */
    int moving;
    step **order; /* the steps that vary, inputs before users */
    double *adjoint;
    size_t adjoints;
};

/* What creation works with. */
typedef struct build {
    const ves_curve_def *def;
    int limit;
    const double *number, *middle;
    const bool *varying;
    ves_arena *arena;
    ves_diag *diag;
    ves_curves *curves;
} build;

static size_t doubles(const ves_curve_input *input)
{
    return 3 * (size_t)ves_curve_stride(input->modes);
}

static ves_status no_memory(const build *b, ves_mark mark)
{
    return ves_diag_add(b->diag, VES_ERROR, VES_MEMORY, mark, "%s", ves_status_text(VES_MEMORY));
}

/* Does anything that the step itself reads depend on a variable? */
static bool reads_varying(const ves_curve_input *input)
{
    for (int key = 0; key < input->args->count; key++) {
        if (input->args->key[key].kind != VES_FORMULAS) {
            bool number = input->args->key[key].kind <= VES_TERMS;
            if (number && ves_input_varies(input, key)) return true;
            continue;
        }
        for (int slot = ves_input_slots(input, key) - 1; slot >= 0; slot--)
            if (ves_input_reads(input, key, slot) && input->varying[slot]) return true;
    }
    return false;
}

/* Places for what a step reads from; step_connect fills them. */
static bool step_init(const build *b, const ves_curve_step *written, int inputs, step *s)
{
    size_t n = (size_t)inputs;
    s->op = written->op;
    s->input_modes = ves_arena_take(b->arena, n, sizeof *s->input_modes);
    s->in = ves_arena_take(b->arena, n, sizeof *s->in);
    s->input_adjoint = ves_arena_take(b->arena, n, sizeof *s->input_adjoint);
    s->source = ves_arena_take(b->arena, n, sizeof *s->source);
    s->input = (ves_curve_input){.args = &written->args,
                                 .number = b->number,
                                 .middle = b->middle,
                                 .varying = b->varying,
                                 .limit = b->limit,
                                 .inputs = inputs,
                                 .input_modes = s->input_modes,
                                 .input = s->in};
    return s->input_modes && s->in && s->input_adjoint && s->source;
}

static void step_connect(step *s, int i, step *source)
{
    s->source[i] = source;
    s->input_modes[i] = source->input.modes;
    s->in[i] = source->out;
    s->varies = s->varies || source->varies;
}

/* Prepares a connected step and evaluates it at the start design. */
static ves_status step_prepare(const build *b, step *s)
{
    ves_curve_input *input = &s->input;
    s->varies = s->varies || reads_varying(input);
    if (s->op->prepare) VES_TRY(s->op->prepare(input, b->arena, &input->state, b->diag));
    input->modes = s->op->modes(input);
    s->out = ves_arena_doubles(b->arena, doubles(input));
    if (s->op->room) input->room = ves_arena_doubles(b->arena, s->op->room(input));
    if (!s->out || (s->op->room && !input->room)) return no_memory(b, input->args->mark);
    s->op->eval(input, s->out);
    if (s->varies) b->curves->moving++;
    return VES_OK;
}

/* VES_FAULT: a curve that it reads has failed, which has been said already. */
static ves_status curve_create(const build *b, int index)
{
    const ves_curve_def *def = &b->def[index];
    step *chain = ves_arena_take(b->arena, (size_t)def->steps, sizeof *chain);
    if (!chain) return no_memory(b, def->mark);
    for (int k = 0; k < def->steps; k++) {
        int inputs = k ? 1 : def->inputs;
        if (!step_init(b, &def->step[k], inputs, &chain[k])) return no_memory(b, def->mark);
        for (int i = 0; i < inputs; i++) {
            step *source = k ? &chain[k - 1] : b->curves->curve[def->input[i]];
            if (!source) return VES_FAULT;
            step_connect(&chain[k], i, source);
        }
        VES_TRY(step_prepare(b, &chain[k]));
    }
    b->curves->curve[index] = &chain[def->steps - 1];
    return VES_OK;
}

/* Sections of one family are written in one place: what is wrong with all of them is said once. */
static bool is_sibling(const ves_curve_def *def, int index)
{
    const ves_mark *own = &def[index].mark, *before = index ? &def[index - 1].mark : own;
    return index && own->line > 0 && own->line == before->line && own->column == before->column;
}

/* Lists the varying steps behind `last` (of one curve), in order of evaluation. */
static void curve_list(ves_curves *curves, const ves_curve_def *def, step *last)
{
    step *chain = last - (def->steps - 1);
    for (int k = 0; k < def->steps; k++) {
        if (!chain[k].varies) continue;
        curves->order[curves->moving++] = &chain[k];
        curves->adjoints += doubles(&chain[k].input);
    }
}

/* Gives every varying step its adjoint, all in one block so that clearing is one call. */
static ves_status adjoints_place(const build *b)
{
    ves_curves *curves = b->curves;
    ves_mark nowhere = {0};
    curves->order = ves_arena_take(b->arena, (size_t)curves->moving, sizeof *curves->order);
    if (!curves->order) return no_memory(b, nowhere);
    curves->moving = 0;
    for (int i = 0; i < curves->count; i++) curve_list(curves, &b->def[i], curves->curve[i]);
    curves->adjoint = ves_arena_doubles(b->arena, curves->adjoints);
    if (!curves->adjoint) return no_memory(b, nowhere);
    double *place = curves->adjoint;
    for (int k = 0; k < curves->moving; k++) {
        step *s = curves->order[k];
        s->adjoint = place;
        place += doubles(&s->input);
        for (int i = 0; i < s->input.inputs; i++) s->input_adjoint[i] = s->source[i]->adjoint;
    }
    return VES_OK;
}

ves_status ves_curves_create(const ves_curve_set *set, ves_arena *arena, ves_curves **curves, ves_diag *diag)
{
    *curves = NULL;
    ves_curves *made = ves_arena_take(arena, 1, sizeof *made);
    int limit = set->limit > 0 ? set->limit : VES_CURVE_MODES;
    const double *middle = set->middle ? set->middle : set->number;
    build b = {set->def, limit, set->number, middle, set->varying, arena, diag, made};
    if (made) made->curve = ves_arena_take(arena, (size_t)set->count, sizeof *made->curve);
    if (!made || !made->curve) return no_memory(&b, (ves_mark){0});
    made->count = set->count;
    ves_status first = VES_OK;
    for (int i = 0, messages = 0; i < set->count && first != VES_MEMORY; i++) {
        if (!is_sibling(set->def, i)) messages = ves_diag_count(diag);
        b.diag = ves_diag_count(diag) > messages ? NULL : diag;
        ves_status status = curve_create(&b, i);
        if (status == VES_MEMORY || first == VES_OK) first = status;
    }
    b.diag = diag;
    if (first == VES_OK) first = adjoints_place(&b);
    if (first == VES_OK) *curves = made;
    return first;
}

int ves_curves_modes(const ves_curves *curves, int index)
{
    return curves->curve[index]->input.modes;
}

bool ves_curves_varies(const ves_curves *curves, int index)
{
    return curves->curve[index]->varies;
}

const double *ves_curves_coef(const ves_curves *curves, int index)
{
    return curves->curve[index]->out;
}

void ves_curves_bind(ves_curves *curves, const double *number)
{
    for (int k = 0; k < curves->moving; k++) {
        step *s = curves->order[k];
        s->input.number = number;
        s->op->eval(&s->input, s->out);
    }
}

double *ves_curves_adjoint(ves_curves *curves, int index)
{
    return curves->curve[index]->adjoint;
}

void ves_curves_clear(ves_curves *curves)
{
    memset(curves->adjoint, 0, curves->adjoints * sizeof *curves->adjoint);
}

void ves_curves_scatter(ves_curves *curves, const double *number, double *number_adjoint)
{
    for (int k = curves->moving - 1; k >= 0; k--) {
        step *s = curves->order[k];
        s->input.number = number;
        s->op->gradient(&s->input, s->adjoint, s->input_adjoint, number_adjoint);
    }
}
