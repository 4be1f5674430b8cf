#include "formula/parser.h"

#include <stdio.h>
#include <string.h>

#include "base/vector.h"

enum {
    TEXT = 1 << 16, /* bytes of a formula */
    NODES = 10000,  /* operations of a formula */
    DEPTH = 200,    /* nested parentheses, functions and signs */
    ARGUMENTS = 16
};

/* How tightly signs bind. */
enum { OR = 1, AND, NOT, COMPARE, ADD, MULTIPLY, MINUS, POWER };

static const ves_function functions[] = {
    {"sin", VES_OP_SIN, 1, 1, VES_RULE_PLAIN,
     "sin(x): sine of an angle, in radians or with a unit: sin(30 deg)"},
    {"cos", VES_OP_COS, 1, 1, VES_RULE_PLAIN,
     "cos(x): cosine of an angle, in radians or with a unit: cos(30 deg)"},
    {"tan", VES_OP_TAN, 1, 1, VES_RULE_PLAIN, "tan(x): tangent of an angle, in radians or with a unit"},
    {"asin", VES_OP_ASIN, 1, 1, VES_RULE_PLAIN,
     "asin(x): the angle in radians, -pi/2 to pi/2, whose sine is x"},
    {"acos", VES_OP_ACOS, 1, 1, VES_RULE_PLAIN, "acos(x): the angle in radians, 0 to pi, whose cosine is x"},
    {"atan", VES_OP_ATAN, 1, 1, VES_RULE_PLAIN,
     "atan(x): the angle in radians, -pi/2 to pi/2, whose tangent is x"},
    {"atan2", VES_OP_ATAN2, 2, 2, VES_RULE_RATIO,
     "atan2(y, x): the angle in radians, -pi to pi, of the point (x, y); both of one dimension"},
    {"sinh", VES_OP_SINH, 1, 1, VES_RULE_PLAIN, "sinh(x): hyperbolic sine"},
    {"cosh", VES_OP_COSH, 1, 1, VES_RULE_PLAIN, "cosh(x): hyperbolic cosine"},
    {"tanh", VES_OP_TANH, 1, 1, VES_RULE_PLAIN, "tanh(x): hyperbolic tangent"},
    {"exp", VES_OP_EXP, 1, 1, VES_RULE_PLAIN, "exp(x): e to the power x"},
    {"log", VES_OP_LOG, 1, 1, VES_RULE_PLAIN, "log(x): natural logarithm"},
    {"sqrt", VES_OP_SQRT, 1, 1, VES_RULE_ROOT, "sqrt(x): square root; of an area a length"},
    {"abs", VES_OP_ABS, 1, 1, VES_RULE_SAME, "abs(x): x without its sign"},
    {"min", VES_OP_MIN, 2, ARGUMENTS, VES_RULE_SAME, "min(a, b, ...): the least, all of one dimension"},
    {"max", VES_OP_MAX, 2, ARGUMENTS, VES_RULE_SAME, "max(a, b, ...): the largest, all of one dimension"},
    {"hypot", VES_OP_HYPOT, 2, 3, VES_RULE_SAME,
     "hypot(a, b) or hypot(a, b, c): the root of the sum of squares"},
    {"sign", VES_OP_SIGN, 1, 1, VES_RULE_RATIO, "sign(x): -1, 0 or 1"},
    {"floor", VES_OP_FLOOR, 1, 1, VES_RULE_PLAIN, "floor(x): the largest whole number that is not above x"},
    {"mod", VES_OP_MOD, 2, 2, VES_RULE_SAME,
     "mod(a, b): what is left of a after whole multiples of b; it has the sign of b"},
    {"if", VES_OP_IF, 3, 3, VES_RULE_IF, "if(c, a, b): a where c is not 0, else b; as in if(x > 0, x, 0)"},
};

const ves_function *ves_function_at(int index)
{
    return index < (int)(sizeof functions / sizeof *functions) ? &functions[index] : NULL;
}

const ves_function *ves_function_find(const ves_lexer *lexer)
{
    for (int k = 0; ves_function_at(k); k++)
        if (ves_lexer_is(lexer, functions[k].name)) return &functions[k];
    return NULL;
}

static int find(const ves_lexer *name, const ves_symbol *symbol, int count)
{
    for (int k = 0; k < count; k++)
        if (symbol[k].name[0] == name->text[name->begin] && ves_lexer_is(name, symbol[k].name)) return k;
    return -1;
}

int ves_parser_argument(const ves_parser *parser, const ves_lexer *name)
{
    return find(name, parser->scope->argument, parser->scope->arguments);
}

int ves_parser_slot(const ves_parser *parser, const ves_lexer *name)
{
    return find(name, parser->scope->slot, parser->scope->slots);
}

/* Without dimensions everything fits everything. */
static ves_dim known(const ves_parser *parser, ves_dim dim)
{
    return parser->scope->dimensions ? dim : (ves_dim){.any = true};
}

static int make(ves_parser *parser, ves_operation operation, int a, int b)
{
    return ves_graph_make(&parser->graph, operation, a, b, 0);
}

/* a and b joined: the place of both, the node of `operation`, the dimension still that of a (b when a has
 * none). */
static ves_part joined(ves_parser *parser, ves_operation operation, const ves_part *a, const ves_part *b)
{
    ves_part part = {
        .node = make(parser, operation, a->node, b->node), .dim = a->dim, .begin = a->begin, .end = b->end};
    if (part.dim.any) part.dim = b->dim;
    return part;
}

static void need_plain(ves_parser *parser, const ves_part *part, const char *what)
{
    if (!ves_dim_plain(part->dim)) ves_parser_misfit(parser, part, what, part->dim, NULL, part->dim);
}

static ves_part expression(ves_parser *parser, int least);

static void read_unit(ves_parser *parser, ves_part *part, double number, int begin)
{
    ves_lexer *lexer = &parser->lexer;
    ves_unit unit = {.up = 1, .down = 100};
    if (lexer->token == VES_TOKEN_PERCENT) {
        ves_lexer_next(lexer);
    } else if (!ves_unit_at(lexer) || ves_lexer_calls(lexer)) {
        ves_parser_unknown_unit(parser, begin);
        return;
    } else if (!ves_unit_read(lexer, &unit)) {
        ves_parser_fail(
            parser, VES_SYNTAX, lexer->begin, lexer->end,
            "a unit's exponent is a small whole number, or a fraction as in m^(1/2); a power of the "
            "whole is written (2 mm)^x");
        return;
    }
    part->dim = known(parser, unit.dim);
    part->node = ves_graph_constant(&parser->graph, ves_unit_apply(&unit, number));
    parser->units |= unit.physical;
}

/* A number and the unit after it. A bare 0 has every dimension. */
static ves_part read_number(ves_parser *parser)
{
    ves_lexer *lexer = &parser->lexer;
    double number = lexer->number;
    ves_part part = {.node = ves_graph_constant(&parser->graph, number), .begin = lexer->begin};
    part.dim = known(parser, (ves_dim){.any = number == 0});
    part.end = lexer->end;
    ves_lexer_next(lexer);
    bool word = ves_lexer_is(lexer, "and") || ves_lexer_is(lexer, "or");
    if (lexer->token != VES_TOKEN_PERCENT && (lexer->token != VES_TOKEN_NAME || word)) return part;
    read_unit(parser, &part, number, part.begin);
    part.end = lexer->before;
    return part;
}

/* The arguments up to ")"; how many there are, of which the first ARGUMENTS are kept. */
static int read_arguments(ves_parser *parser, ves_part argument[ARGUMENTS], int open)
{
    ves_lexer *lexer = &parser->lexer;
    int count = 0;
    ves_part extra;
    ves_lexer_next(lexer);
    if (lexer->token == VES_TOKEN_CLOSE) return 0;
    for (;;) {
        *(count < ARGUMENTS ? &argument[count] : &extra) = expression(parser, OR);
        count++;
        if (lexer->token != VES_TOKEN_COMMA) break;
        ves_lexer_next(lexer);
    }
    if (lexer->token == VES_TOKEN_END)
        ves_parser_fail(parser, VES_SYNTAX, open, open + 1, "\"(\" is never closed");
    else if (lexer->token != VES_TOKEN_CLOSE)
        ves_parser_operator_missing(parser);
    return count;
}

static void wrong_count(ves_parser *parser, const ves_function *f, int count, int begin, int end)
{
    char wanted[32];
    if (f->least == f->most)
        snprintf(wanted, sizeof wanted, "%d argument%s", f->least, f->least > 1 ? "s" : "");
    else
        snprintf(wanted, sizeof wanted, "%d to %d arguments", f->least, f->most);
    ves_parser_fail(parser, VES_SYNTAX, begin, end, "\"%s\" takes %s, found %d%s", f->name, wanted, count,
                    count == f->most + 1 ? " (a comma is no decimal sign)" : "");
}

/* Dimensions of the arguments against the function's rule; the dimension of the result. */
static ves_dim ruled(ves_parser *parser, const ves_function *f, const ves_part *argument, int count)
{
    char what[48];
    ves_dim dim = argument[0].dim, plain = known(parser, (ves_dim){0});
    snprintf(what, sizeof what, "\"%s\" needs a plain number, found", f->name);
    if (f->rule == VES_RULE_PLAIN || f->rule == VES_RULE_IF) need_plain(parser, &argument[0], what);
    if (f->rule == VES_RULE_PLAIN) return plain;
    if (f->rule == VES_RULE_ROOT) {
        if (!ves_dim_power(dim, 0.5, &dim))
            ves_parser_misfit(parser, &argument[0], "no dimension is the root of", argument[0].dim, NULL,
                              dim);
        return dim;
    }
    int first = f->rule == VES_RULE_IF;
    dim = argument[first].dim;
    snprintf(what, sizeof what, "\"%s\" of", f->name);
    for (int k = first + 1; k < count; k++) {
        if (!ves_dim_equal(dim, argument[k].dim))
            ves_parser_misfit(parser, &argument[k], what, dim, " and ", argument[k].dim);
        if (dim.any) dim = argument[k].dim;
    }
    return f->rule == VES_RULE_RATIO ? plain : dim;
}

static ves_part read_call(ves_parser *parser, const ves_function *f)
{
    ves_lexer *lexer = &parser->lexer;
    ves_part part = {.begin = lexer->begin}, argument[ARGUMENTS] = {{0}};
    int name_end = lexer->end;
    ves_lexer_next(lexer);
    int count = read_arguments(parser, argument, lexer->begin);
    if (parser->error->status) return part;
    part.end = lexer->end;
    ves_lexer_next(lexer);
    if (count < f->least || count > f->most) {
        wrong_count(parser, f, count, part.begin, name_end);
        return part;
    }
    part.dim = ruled(parser, f, argument, count);
    part.node =
        ves_graph_make(&parser->graph, f->operation, argument[0].node, argument[1].node, argument[2].node);
    for (int k = 2; k < count && f->operation != VES_OP_IF; k++)
        part.node = make(parser, f->operation, part.node, argument[k].node);
    return part;
}

static ves_part read_name(ves_parser *parser)
{
    ves_lexer *lexer = &parser->lexer;
    ves_part part = {.begin = lexer->begin, .end = lexer->end};
    bool call = ves_lexer_calls(lexer);
    const ves_function *f = call ? ves_function_find(lexer) : NULL;
    int argument, slot;
    if (f) return read_call(parser, f);
    if (!call && (argument = ves_parser_argument(parser, lexer)) >= 0) {
        part.node = ves_graph_leaf(&parser->graph, VES_OP_ARGUMENT, argument);
        part.dim = known(parser, parser->scope->argument[argument].dim);
    } else if (!call && (slot = ves_parser_slot(parser, lexer)) >= 0) {
        part.node = ves_graph_leaf(&parser->graph, VES_OP_SLOT, slot);
        part.dim = known(parser, parser->scope->slot[slot].dim);
    } else if (!call && ves_lexer_is(lexer, "pi")) {
        part.node = ves_graph_constant(&parser->graph, VES_PI);
        part.dim = known(parser, part.dim);
    } else {
        ves_parser_unknown_name(parser);
    }
    ves_lexer_next(lexer);
    return part;
}

static ves_part read_parenthesis(ves_parser *parser)
{
    ves_lexer *lexer = &parser->lexer;
    int open = lexer->begin;
    ves_lexer_next(lexer);
    ves_part part = expression(parser, OR);
    if (lexer->token == VES_TOKEN_END)
        ves_parser_fail(parser, VES_SYNTAX, open, open + 1, "\"(\" is never closed");
    else if (lexer->token != VES_TOKEN_CLOSE)
        ves_parser_operator_missing(parser);
    part.begin = open;
    part.end = lexer->end;
    ves_lexer_next(lexer);
    return part;
}

static ves_part read_negation(ves_parser *parser, int least)
{
    int begin = parser->lexer.begin, end = parser->lexer.end;
    if (least > NOT)
        ves_parser_fail(parser, VES_SYNTAX, begin, end, "put parentheses around \"not ...\" here");
    ves_lexer_next(&parser->lexer);
    ves_part part = expression(parser, NOT);
    need_plain(parser, &part, "\"not\" needs a plain number, found");
    part.node = make(parser, VES_OP_NOT, part.node, 0);
    part.dim = known(parser, (ves_dim){0});
    part.begin = begin;
    return part;
}

static ves_part read_sign(ves_parser *parser)
{
    int begin = parser->lexer.begin;
    bool minus = parser->lexer.token == VES_TOKEN_MINUS;
    ves_lexer_next(&parser->lexer);
    ves_part part = expression(parser, MINUS);
    if (minus) part.node = make(parser, VES_OP_NEG, part.node, 0);
    part.begin = begin;
    return part;
}

static ves_part operand(ves_parser *parser, int least)
{
    const ves_lexer *lexer = &parser->lexer;
    bool word = ves_lexer_is(lexer, "and") || ves_lexer_is(lexer, "or");
    switch (lexer->token) {
    case VES_TOKEN_NUMBER:
        return read_number(parser);
    case VES_TOKEN_OPEN:
        return read_parenthesis(parser);
    case VES_TOKEN_PLUS:
    case VES_TOKEN_MINUS:
        return read_sign(parser);
    case VES_TOKEN_NAME:
        if (ves_lexer_is(lexer, "not")) return read_negation(parser, least);
        if (!word) return read_name(parser);
        break;
    default:
        break;
    }
    ves_parser_operand_missing(parser);
    return (ves_part){.begin = lexer->begin, .end = lexer->begin};
}

/* How tightly the token binds as a sign between two operands; 0: it is none. */
static int binding(const ves_lexer *lexer)
{
    switch (lexer->token) {
    case VES_TOKEN_PLUS:
    case VES_TOKEN_MINUS:
        return ADD;
    case VES_TOKEN_TIMES:
    case VES_TOKEN_OVER:
        return MULTIPLY;
    case VES_TOKEN_POWER:
        return POWER;
    case VES_TOKEN_LESS:
    case VES_TOKEN_ATMOST:
    case VES_TOKEN_GREATER:
    case VES_TOKEN_ATLEAST:
    case VES_TOKEN_EQUAL:
    case VES_TOKEN_UNEQUAL:
        return COMPARE;
    case VES_TOKEN_NAME:
        return ves_lexer_is(lexer, "and") ? AND : ves_lexer_is(lexer, "or") ? OR : 0;
    default:
        return 0;
    }
}

static ves_part add(ves_parser *parser, ves_token sign, const ves_part *a, const ves_part *b,
                    const ves_part *place)
{
    bool plus = sign == VES_TOKEN_PLUS;
    ves_part part = joined(parser, plus ? VES_OP_ADD : VES_OP_SUB, a, b);
    if (ves_dim_equal(a->dim, b->dim)) return part;
    if (plus)
        ves_parser_misfit(parser, place, "adds", a->dim, " to ", b->dim);
    else
        ves_parser_misfit(parser, place, "subtracts", b->dim, " from ", a->dim);
    return part;
}

static ves_part multiply(ves_parser *parser, ves_token sign, const ves_part *a, const ves_part *b,
                         const ves_part *place)
{
    bool times = sign == VES_TOKEN_TIMES;
    ves_part part = joined(parser, times ? VES_OP_MUL : VES_OP_DIV, a, b);
    if (!ves_dim_multiply(a->dim, b->dim, times ? 1 : -1, &part.dim))
        ves_parser_fail(parser, VES_UNIT, place->begin, place->end,
                        "the dimension of the product is out of range");
    return part;
}

/* A dimension can be raised to a known number only. */
static ves_part raise(ves_parser *parser, const ves_part *a, const ves_part *b)
{
    ves_part part = {.node = ves_graph_power(&parser->graph, a->node, b->node),
                     .dim = a->dim,
                     .begin = a->begin,
                     .end = b->end};
    double exponent;
    char text[64];
    need_plain(parser, b, "an exponent must be a plain number, found");
    if (parser->error->status || ves_dim_plain(a->dim)) return part;
    if (!ves_graph_is_constant(&parser->graph, b->node, &exponent))
        ves_parser_misfit(parser, b, "the exponent must be a constant number, for the base is", a->dim, NULL,
                          a->dim);
    else if (!ves_dim_power(a->dim, exponent, &part.dim)) {
        ves_dim_describe(a->dim, text);
        ves_parser_fail(parser, VES_UNIT, b->begin, b->end, "%s to the power %g has no dimension", text,
                        exponent);
    }
    return part;
}

static ves_part compare(ves_parser *parser, ves_token sign, const ves_part *a, const ves_part *b,
                        const ves_part *place)
{
    bool turned = sign == VES_TOKEN_GREATER || sign == VES_TOKEN_ATLEAST; /* a > b is b < a */
    ves_operation operation = sign == VES_TOKEN_EQUAL                               ? VES_OP_EQUAL
                              : sign == VES_TOKEN_UNEQUAL                           ? VES_OP_UNEQUAL
                              : sign == VES_TOKEN_LESS || sign == VES_TOKEN_GREATER ? VES_OP_LESS
                                                                                    : VES_OP_ATMOST;
    if (!ves_dim_equal(a->dim, b->dim))
        ves_parser_misfit(parser, place, "compares", a->dim, " with ", b->dim);
    ves_part part = joined(parser, operation, turned ? b : a, turned ? a : b);
    part.begin = a->begin;
    part.end = b->end;
    part.dim = known(parser, (ves_dim){0});
    if (binding(&parser->lexer) == COMPARE) ves_parser_operator_missing(parser);
    return part;
}

static ves_part connect(ves_parser *parser, int level, const ves_part *a, const ves_part *b)
{
    const char *what =
        level == AND ? "\"and\" needs plain numbers, found" : "\"or\" needs plain numbers, found";
    need_plain(parser, a, what);
    need_plain(parser, b, what);
    ves_part part = joined(parser, level == AND ? VES_OP_AND : VES_OP_OR, a, b);
    part.dim = known(parser, (ves_dim){0});
    return part;
}

/* Precedence climbing [Richards and Whitby-Strevens 1979]: reads signs that bind at least as tightly as
 * `least`. */
static ves_part expression(ves_parser *parser, int least)
{
    ves_lexer *lexer = &parser->lexer;
    if (++parser->depth > DEPTH)
        ves_parser_fail(parser, VES_SYNTAX, lexer->begin, lexer->end, "nested more than %d deep", DEPTH);
    ves_part a = operand(parser, least);
    for (int level; (level = binding(lexer)) >= least && level;) {
        ves_token sign = lexer->token;
        ves_part place = {.begin = lexer->begin, .end = lexer->end};
        ves_lexer_next(lexer);
        ves_part b = expression(parser, level == POWER ? POWER : level + 1);
        if (parser->error->status) break;
        if (level == ADD)
            a = add(parser, sign, &a, &b, &place);
        else if (level == MULTIPLY)
            a = multiply(parser, sign, &a, &b, &place);
        else if (level == POWER)
            a = raise(parser, &a, &b);
        else if (level == COMPARE)
            a = compare(parser, sign, &a, &b, &place);
        else
            a = connect(parser, level, &a, &b);
    }
    parser->depth--;
    return a;
}

/* Reads the whole text. */
static ves_part whole(ves_parser *parser)
{
    ves_part part = {0};
    if (strnlen(parser->text, TEXT + 1) > TEXT) {
        ves_parser_fail(parser, VES_SYNTAX, 0, 1, "a formula has at most %d bytes", TEXT);
        return part;
    }
    ves_lexer_start(&parser->lexer, parser->text);
    part = expression(parser, OR);
    if (!parser->error->status && parser->lexer.token != VES_TOKEN_END) ves_parser_operator_missing(parser);
    if (parser->graph.status == VES_RANGE)
        ves_parser_fail(parser, VES_SYNTAX, 0, 1, "a formula has at most %d operations", NODES);
    return part;
}

ves_status ves_formula_compile(const char *text, const ves_scope *scope, ves_arena *arena,
                               const ves_formula **formula, ves_formula_error *error)
{
    *formula = NULL;
    *error = (ves_formula_error){0};
    ves_parser parser = {.text = text, .scope = scope, .error = error};
    if (ves_graph_init(&parser.graph, false, NODES) == VES_OK) {
        ves_part part = whole(&parser);
        ves_dim *dim = NULL;
        if (!error->status && scope->arguments > 0)
            dim = ves_memory_take((size_t)scope->arguments * sizeof *dim);
        for (int k = 0; dim && k < scope->arguments; k++) dim[k] = known(&parser, scope->argument[k].dim);
        ves_formula like = {
            .dim = part.dim, .units = parser.units, .dims = scope->arguments, .argument_dim = dim};
        if (!error->status && (dim || !scope->arguments))
            *formula = ves_graph_finish(&parser.graph, part.node, &like, arena);
        ves_memory_free(dim);
    }
    ves_graph_clear(&parser.graph);
    if (!*formula && !error->status) {
        error->status = VES_MEMORY;
        snprintf(error->text, sizeof error->text, "%s", ves_status_text(VES_MEMORY));
    }
    return error->status;
}
