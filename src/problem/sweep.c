/* sweep: what vesica sweep walks over. */
#include <math.h>
#include <string.h>

#include "problem/reader.h"

enum { UP, DOWN, BOTH }; /* the words of `walk`, in their order */

/* A step that misses the last value by less than this part of itself was meant to meet it. */
static const double MISS = 1e-6;

typedef struct axes {
    ves_reader *reader;
    ves_sweep_def *sweep;
    ves_names branches;
} axes;

static const ves_entry *table_of(const char *name)
{
    const ves_entry *sweep = ves_schema_find(ves_schema_root.table, "sweep");
    return ves_schema_find(sweep->table, name)->table;
}

const ves_override *ves_reader_overrides(ves_reader *reader, const ves_node *node, int *count)
{
    *count = 0;
    if (node->kind != VES_NODE_MAP) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"set\" must be a mapping {name: value, ...}");
        return NULL;
    }
    ves_override *set = ves_arena_take(reader->arena, (size_t)node->count, sizeof *set);
    if (!ves_reader_memory(reader, set)) return NULL;
    for (int k = 0; k < node->count; k++)
        if (ves_reader_word(reader, node->item[k], "value"))
            set[(*count)++] = (ves_override){node->key[k]->text, node->item[k]->text};
    return set;
}

/* --- values --- */

/* A constant of the dimension that the parameter has. */
static double value_read(axes *a, const ves_node *node, const char *name, ves_dim dim)
{
    const ves_key key = {.name = name, .kind = VES_NUMBER};
    ves_dim *outer = a->reader->free;
    a->reader->free = &dim;
    double value = ves_reader_constant(a->reader, node, &key);
    a->reader->free = outer;
    return value;
}

static void list_read(axes *a, const ves_node *node, ves_sweep_axis *axis, ves_dim dim)
{
    const ves_node *const single[1] = {node};
    bool list = node->kind == VES_NODE_LIST;
    const ves_node *const *item = list ? node->item : single;
    int count = list ? node->count : 1, before = a->reader->errors;
    if (!count || count > VES_SWEEP_VALUES) {
        ves_reader_error(a->reader, VES_RANGE, node, "\"%s\" needs 1 to %d values, got %d", axis->name,
                         VES_SWEEP_VALUES, count);
        return;
    }
    double *value = ves_arena_take(a->reader->arena, (size_t)count, sizeof *value);
    if (!ves_reader_memory(a->reader, value)) return;
    for (int k = 0; k < count; k++) value[k] = value_read(a, item[k], axis->name, dim);
    axis->value = value;
    axis->count = count;
    bool walked = axis == a->sweep->axis && a->reader->errors == before;
    for (int k = 1; walked && k < count; k++)
        if (!((value[k] - value[k - 1]) * (value[1] - value[0]) > 0)) {
            ves_reader_error(a->reader, VES_RANGE, item[k],
                             "the values of \"%s\" must rise or fall: a walk goes from each to the next",
                             axis->name);
            return;
        }
}

/* How many values a step makes; 0 after an error. */
static int steps_count(axes *a, const ves_node *node, double from, double to, double step)
{
    double steps = fabs(to - from) / step, whole = round(steps);
    if (whole >= VES_SWEEP_VALUES)
        ves_reader_error(a->reader, VES_RANGE, node, "this step makes %.0f values, more than %d", whole + 1,
                         VES_SWEEP_VALUES);
    else if (whole < 1 || fabs(steps - whole) > MISS)
        ves_reader_error(a->reader, VES_RANGE, node,
                         "this step does not lead from \"from\" to \"to\": it fits in %.6g times", steps);
    else
        return (int)whole + 1;
    return 0;
}

static int count_read(axes *a, const ves_node *node, const ves_fields *f, const ves_sweep_axis *ends,
                      ves_dim dim)
{
    const ves_node *step = ves_fields_find(f, "step"), *count = ves_fields_find(f, "count");
    const double from = ends->value[0], to = ends->value[1];
    if (!step == !count) {
        if (!ves_fields_excused(f, "step") && !ves_fields_excused(f, "count"))
            ves_fields_one_of(a->reader, node, f, ends->name, "step", "count");
        return 0;
    }
    int before = a->reader->errors;
    if (count) {
        long n = ves_reader_count(a->reader, count, ves_fields_field(f, "count")->key);
        return a->reader->errors == before ? (int)n : 0;
    }
    double value = value_read(a, step, "step", dim);
    if (a->reader->errors > before) return 0;
    if (value > 0) return steps_count(a, step, from, to, value);
    ves_reader_error(a->reader, VES_RANGE, step,
                     "\"step\" must be > 0, got %g: the walk goes from \"from\" to \"to\"", value);
    return 0;
}

/* Without a `walk` from the first to the last. */
static void walk_read(axes *a, const ves_field *walk, const ves_sweep_axis *axis)
{
    ves_sweep_def *sweep = a->sweep;
    if (!walk->node) return;
    if (axis != sweep->axis) {
        ves_reader_error(a->reader, VES_SYNTAX, walk->node, "\"walk\" goes with the first parameter only");
        return;
    }
    ves_key key = *walk->key; /* it has no default, but must have one after an error */
    key.fallback = UP;
    int way = ves_reader_choice(a->reader, walk->node, &key);
    bool rises = axis->value[1] > axis->value[0];
    sweep->forth = way == BOTH || (way == UP) == rises;
    sweep->back = way == BOTH || (way == UP) != rises;
}

static void range_read(axes *a, const ves_node *node, ves_sweep_axis *axis, ves_dim dim)
{
    ves_fields f;
    const ves_entry *table = table_of("over")->table;
    if (!ves_fields_read(a->reader, node, table, axis->name, &f)) return;
    const ves_node *from = ves_fields_find(&f, "from"), *to = ves_fields_find(&f, "to");
    int before = a->reader->errors;
    if (!from || !to) return;
    const double end[2] = {value_read(a, from, "from", dim), value_read(a, to, "to", dim)};
    if (a->reader->errors > before) return;
    if (end[0] == end[1]) {
        ves_reader_error(a->reader, VES_RANGE, to, "\"from\" and \"to\" are the same: give \"%s\" alone",
                         from->text);
        return;
    }
    ves_sweep_axis ends = *axis;
    ends.value = end;
    int count = count_read(a, node, &f, &ends, dim);
    if (!count) return;
    double *value = ves_arena_take(a->reader->arena, (size_t)count, sizeof *value);
    if (!ves_reader_memory(a->reader, value)) return;
    for (int k = 0; k < count; k++)
        value[k] =
            (end[0] * (count - 1 - k) + end[1] * k) / (count - 1); /* 0.5, 0.51 ..., not 0.51 + 1e-16 */
    axis->value = value;
    axis->count = count;
    walk_read(a, ves_fields_field(&f, "walk"), axis);
}

/* --- over --- */

static int parameter_find(axes *a, const ves_node *word)
{
    const ves_problem *p = a->reader->problem;
    const char **name = ves_arena_take(a->reader->arena, (size_t)p->parameters, sizeof *name);
    if (!ves_reader_memory(a->reader, name)) return -1;
    for (int k = 0; k < p->parameters; k++) {
        name[k] = p->parameter[k].name;
        if (!strcmp(name[k], word->text)) return k;
    }
    for (int k = 0; k < p->variables; k++)
        if (!strcmp(p->variable[k].name, word->text)) {
            ves_reader_error(a->reader, VES_NAME, word,
                             "\"%s\" is a variable, which a search finds: a sweep goes over parameters",
                             word->text);
            return -1;
        }
    ves_reader_error(a->reader, VES_NAME, word, "no parameter \"%.80s\"%s", word->text,
                     ves_reader_suggestion(a->reader, word->text, name, p->parameters));
    return -1;
}

static void axis_read(axes *a, const ves_node *word, const ves_node *node)
{
    const ves_problem *p = a->reader->problem;
    ves_sweep_axis *axis = &a->sweep->axis[a->sweep->axes++];
    *axis = (ves_sweep_axis){.name = word->text, .parameter = parameter_find(a, word)};
    const ves_formula *formula = axis->parameter < 0 ? NULL : p->parameter[axis->parameter].formula;
    if (!formula) return;
    if (ves_reader_varies(a->reader, formula))
        ves_reader_error(a->reader, VES_RANGE, word,
                         "\"%s\" follows variables: a sweep goes over constant parameters", word->text);
    else if (node->kind == VES_NODE_MAP)
        range_read(a, node, axis, ves_formula_dim(formula));
    else
        list_read(a, node, axis, ves_formula_dim(formula));
}

static void over_read(axes *a, const ves_node *node)
{
    if (!node) return;
    if (node->kind != VES_NODE_MAP || !node->count || node->count > VES_SWEEP_AXES) {
        ves_reader_error(a->reader, VES_SYNTAX, node,
                         "\"over\" must be a mapping of one or two parameters, {nu: {from: 0.5, to: 1, "
                         "count: 51}}");
        return;
    }
    for (int k = 0; k < node->count; k++) axis_read(a, node->key[k], node->item[k]);
}

/* --- branches --- */

static bool swept(const ves_sweep_def *sweep, const char *name)
{
    for (int k = 0; k < sweep->axes; k++)
        if (!strcmp(sweep->axis[k].name, name)) return true;
    return false;
}

/* {from: 0, to: 1}, both of them included. */
static void range_ends(axes *a, const ves_node *node, ves_dim dim, double end[2])
{
    const ves_entry *table = ves_schema_find(table_of("branches")->table, "at")->table->table;
    ves_fields f;
    if (!ves_fields_read(a->reader, node, table, "at", &f)) return;
    const ves_node *from = ves_fields_find(&f, "from"), *to = ves_fields_find(&f, "to");
    if (from) end[0] = value_read(a, from, "from", dim);
    if (to) end[1] = value_read(a, to, "to", dim);
}

/* {c0: [0, 3]}: values of a parameter. The second one that is swept: at these of its values; one that is not swept: if it
 * has one of them. */
static void at_read(axes *a, const ves_node *node, ves_sweep_branch *branch)
{
    ves_reader *reader = a->reader;
    const ves_sweep_def *sweep = a->sweep;
    if (node->kind != VES_NODE_MAP || node->count != 1) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"at\" must be a mapping of one parameter, {c0: [0, 3]}");
        return;
    }
    const int before = reader->errors, parameter = parameter_find(a, node->key[0]);
    const ves_formula *formula = parameter < 0 ? NULL : reader->problem->parameter[parameter].formula;
    if (!formula) return;
    ves_sweep_axis at = {.name = node->key[0]->text, .parameter = parameter};
    if (sweep->axes && sweep->axis[0].parameter == parameter) {
        ves_reader_error(reader, VES_RANGE, node->key[0],
                         "\"%s\" is walked along: a branch says by its `kind` where it is lost", at.name);
        return;
    }
    double range[2] = {0};
    const bool ranged = node->item[0]->kind == VES_NODE_MAP;
    if (ranged)
        range_ends(a, node->item[0], ves_formula_dim(formula), range);
    else
        list_read(a, node->item[0], &at, ves_formula_dim(formula));
    if (reader->errors > before) return;
    const bool second = sweep->axes > 1 && sweep->axis[1].parameter == parameter;
    const double own = ves_reader_value(reader, formula);
    const int seconds = sweep->axes > 1 ? sweep->axis[1].count : 1;
    bool *skips = ves_arena_take(reader->arena, (size_t)seconds, sizeof *skips);
    if (!ves_reader_memory(reader, skips)) return;
    for (int j = 0; j < seconds; j++) {
        const double value = second ? sweep->axis[1].value[j] : own, same = MISS * fabs(value);
        skips[j] = !ranged || value < range[0] - same || value > range[1] + same;
        for (int k = 0; k < at.count; k++) skips[j] = skips[j] && fabs(value - at.value[k]) > same;
    }
    branch->skips = skips;
}

static void branch_read(axes *a, const ves_named *named, ves_sweep_branch *branch)
{
    ves_fields f;
    *branch =
        (ves_sweep_branch){.name = named->text, .mark = ves_reader_mark(a->reader, named->word), .kind = -1};
    if (!ves_fields_read(a->reader, named->value, table_of("branches")->table, "branch", &f)) return;
    const ves_node *set = ves_fields_find(&f, "set"), *kind = ves_fields_find(&f, "kind");
    const ves_named *found = kind ? ves_names_ask(a->reader, &a->reader->kinds, kind) : NULL;
    if (found) branch->kind = found->index;
    const ves_node *at = ves_fields_find(&f, "at");
    if (at) at_read(a, at, branch);
    if (!set) return;
    branch->set = ves_reader_overrides(a->reader, set, &branch->sets);
    for (int k = 0; set->kind == VES_NODE_MAP && k < set->count; k++)
        if (swept(a->sweep, set->key[k]->text))
            ves_reader_error(a->reader, VES_NAME, set->key[k], "\"%s\" is swept: a branch cannot set it",
                             set->key[k]->text);
}

static void branches_read(axes *a, const ves_node *node)
{
    ves_names *names = &a->branches;
    if (!node) return;
    ves_names_read(a->reader, node, "branch", false, names);
    ves_sweep_branch *branch = ves_arena_take(a->reader->arena, (size_t)names->count, sizeof *branch);
    if (!ves_reader_memory(a->reader, branch)) return;
    for (int k = 0; k < names->count; k++) {
        names->name[k].index = k;
        branch_read(a, &names->name[k], &branch[k]);
    }
    a->sweep->branch = branch;
    a->sweep->branches = names->count;
}

bool ves_sweep_walked(const ves_sweep_def *sweep, int branch, int second)
{
    const bool *skips = sweep->branches ? sweep->branch[branch].skips : NULL;
    return !skips || !skips[second];
}

/* Of the dimension of the first parameter. */
static void finest_read(axes *a, const ves_node *node)
{
    const ves_sweep_axis *axis = &a->sweep->axis[0];
    const ves_formula *formula = a->sweep->axes && axis->parameter >= 0
                                     ? a->reader->problem->parameter[axis->parameter].formula
                                     : NULL;
    if (!node || !formula) return;
    const int before = a->reader->errors;
    double value = value_read(a, node, "finest", ves_formula_dim(formula));
    if (a->reader->errors > before) return;
    a->sweep->finest = value;
    if (!(value > 0))
        ves_reader_error(a->reader, VES_RANGE, node,
                         "\"finest\" must be > 0, got %g: it is the length of a step", value);
}

static void known_read(axes *a, const ves_node *node, ves_sweep_known *known)
{
    ves_reader *reader = a->reader;
    const ves_sweep_axis *axis = &a->sweep->axis[0];
    ves_fields f;
    *known = (ves_sweep_known){.source = ""};
    if (!ves_fields_read(reader, node, table_of("known")->table, "known", &f)) return;
    const ves_node *from = ves_fields_find(&f, "from"), *to = ves_fields_find(&f, "to"),
                   *at = ves_fields_find(&f, "at"), *source = ves_fields_find(&f, "source");
    const ves_named *one = from ? ves_names_ask(reader, &a->branches, from) : NULL,
                    *two = to ? ves_names_ask(reader, &a->branches, to) : NULL;
    if (one) known->from = one->index;
    if (two) known->to = two->index;
    if (at && a->sweep->axes && axis->parameter >= 0 && reader->problem->parameter[axis->parameter].formula)
        known->at =
            value_read(a, at, "at", ves_formula_dim(reader->problem->parameter[axis->parameter].formula));
    if (source && ves_reader_word(reader, source, "text")) known->source = source->text;
}

static void knowns_read(axes *a, const ves_node *node)
{
    if (!node) return;
    if (node->kind != VES_NODE_LIST) {
        ves_reader_error(a->reader, VES_SYNTAX, node,
                         "\"known\" must be a list [{from: ..., to: ..., at: ...}]");
        return;
    }
    ves_sweep_known *known = ves_arena_take(a->reader->arena, (size_t)node->count, sizeof *known);
    if (!ves_reader_memory(a->reader, known)) return;
    for (int k = 0; k < node->count; k++) known_read(a, node->item[k], &known[k]);
    a->sweep->known = known;
    a->sweep->knowns = node->count;
}

void ves_reader_sweep(ves_reader *reader, const ves_fields *root)
{
    const ves_node *node = ves_fields_find(root, "sweep");
    ves_fields f;
    if (!node ||
        !ves_fields_read(reader, node, ves_schema_find(ves_schema_root.table, "sweep")->table, "sweep", &f))
        return;
    ves_sweep_def *sweep = ves_arena_take(reader->arena, 1, sizeof *sweep);
    if (!ves_reader_memory(reader, sweep)) return;
    axes a = {.reader = reader, .sweep = sweep};
    *sweep = (ves_sweep_def){.mark = ves_reader_mark(reader, node), .forth = true};
    sweep->search = ves_search_options_default();
    sweep->search.stages = 1;
    sweep->search.stage[0] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = ves_polish_default()};
    over_read(&a, ves_fields_find(&f, "over"));
    branches_read(&a, ves_fields_find(&f, "branches"));
    knowns_read(&a, ves_fields_find(&f, "known"));
    finest_read(&a, ves_fields_find(&f, "finest"));
    const ves_node *search = ves_fields_find(&f, "search");
    const ves_node *first = ves_fields_find(&f, "first");
    if (search) ves_reader_stages(reader, search, &sweep->search);
    sweep->first = sweep->search;
    sweep->begins = first || sweep->branches > 0;
    if (first) ves_reader_stages(reader, first, &sweep->first);
    reader->problem->sweep = sweep;
}
