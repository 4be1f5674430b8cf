#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "formula/parser.h"

enum { SHOWN = 40 }; /* bytes of a name that a message quotes */

static int quoted(const ves_lexer *lexer)
{
    int length = lexer->end - lexer->begin;
    return length < SHOWN ? length : SHOWN;
}

void ves_parser_fail(ves_parser *parser, ves_status status, int begin, int end, const char *format, ...)
{
    ves_formula_error *error = parser->error;
    if (error->status == VES_OK) {
        error->status = status;
        error->offset = begin;
        error->length = end > begin ? end - begin : 1;
        va_list list;
        va_start(list, format);
        vsnprintf(error->text, sizeof error->text, format, list);
        va_end(list);
    }
    ves_lexer_start(&parser->lexer, "");
}

/* A tournament in small batches, so that no candidate list needs memory. */
typedef struct contest {
    const char *word;
    const char *candidate[32];
    int count;
} contest;

static void settle(contest *c)
{
    int best = ves_text_nearest(c->word, c->candidate, c->count);
    if (best >= 0) c->candidate[0] = c->candidate[best];
    c->count = best >= 0;
}

static void enter(contest *c, const char *candidate)
{
    c->candidate[c->count++] = candidate;
    if (c->count == (int)(sizeof c->candidate / sizeof *c->candidate)) settle(c);
}

static const char *winner(contest *c)
{
    settle(c);
    return c->count ? c->candidate[0] : NULL;
}

static void enter_functions(contest *c)
{
    for (int k = 0; ves_function_at(k); k++) enter(c, ves_function_at(k)->name);
}

static void enter_names(contest *c, const ves_scope *scope)
{
    for (int k = 0; k < scope->arguments; k++) enter(c, scope->argument[k].name);
    for (int k = 0; k < scope->slots; k++) enter(c, scope->slot[k].name);
    enter(c, "pi");
}

/* The known name nearest to the token; functions first where one is called. */
static const char *nearest(const ves_parser *parser, bool call)
{
    char word[SHOWN + 1];
    snprintf(word, sizeof word, "%.*s", quoted(&parser->lexer), parser->text + parser->lexer.begin);
    for (int round = 0; round < 2; round++) {
        contest c = {.word = word};
        if (call == (round == 0))
            enter_functions(&c);
        else
            enter_names(&c, parser->scope);
        const char *best = winner(&c);
        bool letter = best && !word[1]; /* every letter is near to every other */
        if (best && (!letter || (!best[1] && (best[0] ^ word[0]) == ('a' ^ 'A')))) return best;
    }
    return NULL;
}

static const char *other_word(const ves_lexer *lexer)
{
    static const char *const word[][2] = {{"ln", "log(x)"},
                                          {"log10", "log(x)/log(10)"},
                                          {"log2", "log(x)/log(2)"},
                                          {"pow", "x^y"},
                                          {"ceil", "-floor(-x)"},
                                          {"round", "floor(x + 0.5)"},
                                          {"fabs", "abs(x)"},
                                          {"fmod", "mod(x, y)"},
                                          {"arcsin", "asin(x)"},
                                          {"arccos", "acos(x)"},
                                          {"arctan", "atan(x)"},
                                          {"sgn", "sign(x)"},
                                          {"e", "exp(1)"},
                                          {"true", "1"},
                                          {"false", "0"}};
    for (size_t k = 0; k < sizeof word / sizeof *word; k++)
        if (ves_lexer_is(lexer, word[k][0])) return word[k][1];
    return NULL;
}

void ves_parser_unknown_name(ves_parser *parser)
{
    const ves_lexer at = parser->lexer;
    const char *name = parser->text + at.begin, *other = other_word(&at);
    bool call = ves_lexer_calls(&at);
    const char *kind = call ? "function" : "name", *near = other ? NULL : nearest(parser, call);
    int n = quoted(&at);
    if (ves_function_find(&at))
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end, "\"%.*s\" is a function: write %.*s(...)", n,
                        name, n, name);
    else if (call && (ves_parser_argument(parser, &at) >= 0 || ves_parser_slot(parser, &at) >= 0))
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end, "\"%.*s\" is not a function: write %.*s*(...)",
                        n, name, n, name);
    else if (other)
        ves_parser_fail(parser, VES_NAME, at.begin, at.end, "unknown %s \"%.*s\", write %s", kind, n, name,
                        other);
    else if (!call && ves_unit_at(&at))
        ves_parser_fail(parser, VES_NAME, at.begin, at.end,
                        "unknown name \"%.*s\"; as a unit it must follow a number: 1 %.*s", n, name, n, name);
    else if (near)
        ves_parser_fail(parser, VES_NAME, at.begin, at.end, "unknown %s \"%.*s\", did you mean \"%s\"?", kind,
                        n, name, near);
    else
        ves_parser_fail(parser, VES_NAME, at.begin, at.end, "unknown %s \"%.*s\"", kind, n, name);
}

void ves_parser_unknown_unit(ves_parser *parser, int number_begin)
{
    const ves_lexer at = parser->lexer;
    const char *name = parser->text + at.begin, *number = parser->text + number_begin;
    int n = quoted(&at), digits = (int)strspn(number, "0123456789.eE"), units;
    const char *const *unit = ves_unit_names(&units);
    bool known = ves_parser_argument(parser, &at) >= 0 || ves_parser_slot(parser, &at) >= 0 ||
                 ves_lexer_is(&at, "pi") || ves_lexer_calls(&at);
    if (number + digits > name) digits = (int)(name - number);
    if (digits > SHOWN) digits = SHOWN;
    char word[SHOWN + 1];
    snprintf(word, sizeof word, "%.*s", n, name);
    int near = n > 1 ? ves_text_nearest(word, unit, units) : -1; /* every letter is near to some other */
    if (known)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end,
                        "an operator is missing before \"%s\": write %.*s*%s", word, digits, number, word);
    else if (near >= 0)
        ves_parser_fail(parser, VES_UNIT, at.begin, at.end, "unknown unit \"%s\", did you mean \"%s\"?", word,
                        unit[near]);
    else
        ves_parser_fail(parser, VES_UNIT, at.begin, at.end,
                        "unknown unit \"%s\"; a product is written %.*s*%s", word, digits, number, word);
}

/* What can be said of a token wherever it stands: true when it has been. */
static bool hinted(ves_parser *parser)
{
    const ves_lexer at = parser->lexer;
    bool comma = at.token == VES_TOKEN_COMMA && at.begin > 0;
    const char *text = parser->text + at.begin;
    if (comma) comma = strspn(text - 1, "0123456789") && strspn(text + 1, "0123456789");
    if (at.token == VES_TOKEN_BAD)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end, "%s", at.hint);
    else if (comma)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end, "\",\" is no decimal sign: write a point");
    else if (at.token == VES_TOKEN_PERCENT)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end,
                        "%% must follow a number; the rest of a division is mod(a, b)");
    else
        return false;
    return true;
}

void ves_parser_operand_missing(ves_parser *parser)
{
    const ves_lexer at = parser->lexer;
    if (hinted(parser)) return;
    if (at.token != VES_TOKEN_END)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end, "a number or a name is missing before \"%.*s\"",
                        quoted(&at), parser->text + at.begin);
    else if (!parser->text[strspn(parser->text, " \t\r\n")])
        ves_parser_fail(parser, VES_SYNTAX, 0, 1, "the formula is empty");
    else
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end,
                        "the formula ends where a number or a name is needed");
}

void ves_parser_operator_missing(ves_parser *parser)
{
    const ves_lexer at = parser->lexer;
    if (hinted(parser)) return;
    if (at.token == VES_TOKEN_CLOSE)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end, "\")\" without \"(\"");
    else if (at.token == VES_TOKEN_COMMA)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end,
                        "\",\" belongs between the arguments of a function");
    else if (at.token >= VES_TOKEN_LESS)
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end,
                        "comparisons cannot be chained: write a < b and b < c");
    else
        ves_parser_fail(parser, VES_SYNTAX, at.begin, at.end, "an operator is missing before \"%.*s\"%s",
                        quoted(&at), parser->text + at.begin,
                        ves_unit_at(&at) ? "; a unit follows a number, and units are joined by * and /" : "");
}

/* Appends to the message that was just written. */
__attribute__((format(printf, 2, 3))) static void append(ves_parser *parser, const char *format, ...)
{
    char *text = parser->error->text;
    size_t length = strlen(text);
    va_list list;
    va_start(list, format);
    vsnprintf(text + length, sizeof parser->error->text - length, format, list);
    va_end(list);
}

static bool declared(const ves_parser *parser, const ves_lexer *name)
{
    return name->token == VES_TOKEN_NAME &&
           (ves_parser_argument(parser, name) >= 0 || ves_parser_slot(parser, name) >= 0);
}

/* Looks for a declared name among the units at `at`, up to `end`, that follow the number that begins at
 * `number`. */
static bool taken(ves_parser *parser, ves_lexer at, int number, int end)
{
    const char *text = parser->text;
    int units = at.begin, last = at.begin; /* where what can be kept ends */
    char sign = '*';
    for (; at.begin < end; ves_lexer_next(&at)) {
        const char *name = text + at.begin;
        if (at.token == VES_TOKEN_OVER) sign = '/';
        if (at.token == VES_TOKEN_TIMES) sign = '*';
        if (declared(parser, &at) && last - number > SHOWN)
            append(parser, "; \"%.*s\" is a unit here", quoted(&at), name);
        else if (declared(parser, &at) && at.begin == units)
            append(parser, "; \"%.*s\" is a unit here: write %.*s*%.*s", quoted(&at), name,
                   (int)strspn(text + number, "0123456789.eE"), text + number, quoted(&at), name);
        else if (declared(parser, &at))
            append(parser, "; \"%.*s\" is a unit here: write (%.*s)%c%.*s", quoted(&at), name, last - number,
                   text + number, sign, quoted(&at), name);
        if (declared(parser, &at)) return true;
        if (at.token == VES_TOKEN_NAME || at.token == VES_TOKEN_NUMBER) last = at.end;
    }
    return false;
}

/* Says so when a name of the scope was read as a unit: the likely reason for a misfit. */
static void note_taken(ves_parser *parser)
{
    ves_lexer at;
    ves_lexer_start(&at, parser->text);
    while (at.token != VES_TOKEN_END && at.token != VES_TOKEN_BAD) {
        bool number = at.token == VES_TOKEN_NUMBER;
        int begin = at.begin;
        ves_unit unit;
        ves_lexer_next(&at);
        if (!number || !ves_unit_at(&at) || ves_lexer_calls(&at)) continue;
        ves_lexer units = at;
        if (!ves_unit_read(&at, &unit) || taken(parser, units, begin, at.begin)) return;
    }
}

void ves_parser_misfit(ves_parser *parser, const ves_part *place, const char *what, ves_dim dim,
                       const char *joint, ves_dim other)
{
    char text[64], more[64];
    bool first = parser->error->status == VES_OK;
    ves_dim_describe(dim, text);
    ves_dim_describe(other, more);
    ves_parser_fail(parser, VES_UNIT, place->begin, place->end, "%s %s%s%s", what, text, joint ? joint : "",
                    joint ? more : "");
    if (first) note_taken(parser);
}
