/* The state of one compilation, and how it complains. */
#ifndef VES_FORMULA_PARSER_H
#define VES_FORMULA_PARSER_H

#include "formula/dimension.h"
#include "formula/formula.h"
#include "formula/graph.h"
#include "formula/lexer.h"

/* What was read for one part of the text. */
typedef struct ves_part {
    int node;
    ves_dim dim;
    int begin, end;
} ves_part;

typedef enum ves_rule {
    VES_RULE_PLAIN, /* plain numbers to a plain number */
    VES_RULE_SAME,  /* equal dimensions; the result has them too */
    VES_RULE_RATIO, /* equal dimensions to a plain number */
    VES_RULE_ROOT,
    VES_RULE_IF
} ves_rule;

typedef struct ves_function {
    const char *name;
    ves_operation operation;
    int least, most; /* arguments; more than two are folded from the left */
    ves_rule rule;
    const char *about; /* how it is called, and what it gives */
} ves_function;

const ves_function *ves_function_find(const ves_lexer *lexer); /* by the token's name; NULL */
const ves_function *ves_function_at(int index);                /* NULL past the last */

typedef struct ves_parser {
    const char *text;
    ves_lexer lexer;
    const ves_scope *scope;
    ves_graph graph;
    ves_formula_error *error; /* the first error; status VES_OK: none */
    int depth;
    bool units;
} ves_parser;

/* Notes the first error and ends the text, so that the descent unwinds by itself. */
void ves_parser_fail(ves_parser *parser, ves_status status, int begin, int end, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Index of the token's name, or -1. */
int ves_parser_argument(const ves_parser *parser, const ves_lexer *name);
int ves_parser_slot(const ves_parser *parser, const ves_lexer *name);

/* The usual complaints, about the token where the lexer stands. */
void ves_parser_unknown_name(ves_parser *parser);
void ves_parser_unknown_unit(ves_parser *parser, int number_begin);
void ves_parser_operand_missing(ves_parser *parser);
void ves_parser_operator_missing(ves_parser *parser);

/* VES_UNIT: "WHAT DIM" or, when joint is not NULL, "WHAT DIM JOINT OTHER"; with a note when a declared name
 * of the text was taken for a unit. */
void ves_parser_misfit(ves_parser *parser, const ves_part *place, const char *what, ves_dim dim,
                       const char *joint, ves_dim other);

#endif
