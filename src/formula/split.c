#include "formula/formula.h"
#include "formula/lexer.h"

ves_status ves_formula_split(const char *text, char operator[3], int *left_end, int *right_begin)
{
    ves_lexer lexer;
    int depth = 0, found = 0;
    for (ves_lexer_start(&lexer, text); lexer.token != VES_TOKEN_END; ves_lexer_next(&lexer)) {
        bool compares = lexer.token >= VES_TOKEN_LESS && lexer.token <= VES_TOKEN_EQUAL;
        depth += (lexer.token == VES_TOKEN_OPEN) - (lexer.token == VES_TOKEN_CLOSE);
        if (compares && depth == 0) {
            found++;
            *left_end = lexer.before;
            operator[0] = text[lexer.begin];
            operator[1] = lexer.end - lexer.begin> 1 ? '=' : '\0';
            operator[2] = '\0';
            *right_begin = lexer.end;
        }
    }
    while (found == 1 && (text[*right_begin] == ' ' || text[*right_begin] == '\t')) ++*right_begin;
    return found == 1 ? VES_OK : VES_SYNTAX;
}
