/* Tokens of a formula, read one at a time, each with its place (byte offsets). A lexer is a small value: copy
 * it to look ahead. */
#ifndef VES_FORMULA_LEXER_H
#define VES_FORMULA_LEXER_H

#include <stdbool.h>

typedef enum ves_token {
    VES_TOKEN_END,
    VES_TOKEN_NUMBER,
    VES_TOKEN_NAME,
    VES_TOKEN_PLUS,
    VES_TOKEN_MINUS,
    VES_TOKEN_TIMES,
    VES_TOKEN_OVER,
    VES_TOKEN_POWER,
    VES_TOKEN_OPEN,
    VES_TOKEN_CLOSE,
    VES_TOKEN_COMMA,
    VES_TOKEN_PERCENT,
    VES_TOKEN_LESS,
    VES_TOKEN_ATMOST,
    VES_TOKEN_GREATER,
    VES_TOKEN_ATLEAST,
    VES_TOKEN_EQUAL,
    VES_TOKEN_UNEQUAL,
    VES_TOKEN_BAD /* `hint` says why; a full sentence */
} ves_token;

typedef struct ves_lexer {
    const char *text;
    ves_token token;
    int before;       /* end of the token before */
    int begin, end;   /* of the token */
    double number;    /* of VES_TOKEN_NUMBER */
    const char *hint; /* of VES_TOKEN_BAD */
} ves_lexer;

/* Starts at the first token. */
void ves_lexer_start(ves_lexer *lexer, const char *text);
void ves_lexer_next(ves_lexer *lexer);

/* The token is the name `word`. */
bool ves_lexer_is(const ves_lexer *lexer, const char *word);
/* The token is followed by "(". */
bool ves_lexer_calls(const ves_lexer *lexer);

#endif
