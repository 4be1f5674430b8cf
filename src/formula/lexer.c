#include "formula/lexer.h"

#include <stddef.h>
#include <string.h>

#include "base/text.h"

enum { NUMBER = 400 }; /* longest number read */

/* What stands for something else, longest first where one begins another. */
static const struct {
    const char *text, *hint;
} wrong[] = {
    {"**", "a power is written with ^"},
    {"&&", "write \"and\""},
    {"||", "write \"or\""},
    {"&", "write \"and\""},
    {"|", "write \"or\", or abs(x)"},
    {"=<", "write <="},
    {"=>", "write >="},
    {"<>", "write !="},
    {"=", "write == to compare"},
    {"!", "write \"not\"; there is no factorial"},
    {"?", "write if(condition, a, b)"},
    {":", "write if(condition, a, b)"},
    {"\xC2\xB2", "write ^2"},
    {"\xC2\xB3", "write ^3"},
    {"\xC2\xB7", "write *"},
    {"\xC3\x97", "write *"},
    {"\xC3\xB7", "write /"},
    {"\xC2\xB5", "write u for micro, as in um"},
    {"\xCE\xBC", "write u for micro, as in um"},
    {"\xCF\x80", "write pi"},
    {"\xC2\xB0", "write deg"},
    {"\xE2\x88\x92", "this is not the minus of the keyboard; write -"},
    {"\xE2\x80\x93", "this is not the minus of the keyboard; write -"},
    {"\xE2\x89\xA4", "write <="},
    {"\xE2\x89\xA5", "write >="},
    {"\xE2\x89\xA0", "write !="},
    {"\xE2\x88\x9A", "write sqrt(x)"},
};

static bool digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static void bad(ves_lexer *lexer, int end, const char *hint)
{
    lexer->token = VES_TOKEN_BAD;
    lexer->end = end;
    lexer->hint = hint;
}

/* Bytes of the character at `at`, so that the place of an error covers whole characters. */
static int width(const char *at)
{
    int n = 1;
    while (((unsigned char)at[n] & 0xC0) == 0x80) n++;
    return n;
}

static int name_end(const char *text, int at)
{
    while (letter(text[at]) || digit(text[at]) || (text[at] == '.' && letter(text[at + 1]))) at++;
    return at;
}

/* digits [. digits] [e [+-] digits]; the exponent only if it has digits. */
static int number_end(const char *text, int at)
{
    while (digit(text[at])) at++;
    if (text[at] == '.') at++;
    while (digit(text[at])) at++;
    if (text[at] != 'e' && text[at] != 'E') return at;
    int exponent = at + 1;
    if (text[exponent] == '+' || text[exponent] == '-') exponent++;
    if (!digit(text[exponent])) return at;
    while (digit(text[exponent])) exponent++;
    return exponent;
}

static void read_number(ves_lexer *lexer)
{
    const char *text = lexer->text + lexer->begin;
    char copy[NUMBER];
    int length = number_end(text, 0);
    bool prefix = text[0] == '0' && length == 1, hex = prefix && (text[1] == 'x' || text[1] == 'X');
    if (hex && (digit(text[2]) || (letter(text[2]) && text[2] <= 'f'))) {
        bad(lexer, lexer->begin + name_end(text, 0),
            "hexadecimal numbers are not read; write a decimal number");
    } else if (text[length] == '_' && digit(text[length + 1])) {
        bad(lexer, lexer->begin + name_end(text, length), "digits are not grouped; write 1000, not 1_000");
    } else if (text[length] == '.') {
        bad(lexer, lexer->begin + length + 1, "a number has one decimal point");
    } else if (length >= NUMBER) {
        bad(lexer, lexer->begin + length, "this number has too many digits");
    } else {
        memcpy(copy, text, (size_t)length);
        copy[length] = 0;
        lexer->token = VES_TOKEN_NUMBER;
        lexer->end = lexer->begin + length;
        if (!ves_text_number(copy, &lexer->number))
            bad(lexer, lexer->end, "this number is too large: numbers end at 1.8e308");
    }
}

static void read_sign(ves_lexer *lexer)
{
    static const struct {
        const char text[3];
        ves_token token;
    } sign[] = {{"<=", VES_TOKEN_ATMOST},  {">=", VES_TOKEN_ATLEAST}, {"==", VES_TOKEN_EQUAL},
                {"!=", VES_TOKEN_UNEQUAL}, {"+", VES_TOKEN_PLUS},     {"-", VES_TOKEN_MINUS},
                {"*", VES_TOKEN_TIMES},    {"/", VES_TOKEN_OVER},     {"^", VES_TOKEN_POWER},
                {"(", VES_TOKEN_OPEN},     {")", VES_TOKEN_CLOSE},    {",", VES_TOKEN_COMMA},
                {"%", VES_TOKEN_PERCENT},  {"<", VES_TOKEN_LESS},     {">", VES_TOKEN_GREATER}};
    const char *at = lexer->text + lexer->begin;
    bool twice = at[0] == '=' && at[1] == '=';
    for (size_t k = 0; !twice && k < sizeof wrong / sizeof *wrong; k++) {
        int length = (int)strlen(wrong[k].text);
        if (strncmp(at, wrong[k].text, (size_t)length) || (at[0] == '!' && at[1] == '=')) continue;
        bad(lexer, lexer->begin + length, wrong[k].hint);
        return;
    }
    for (size_t k = 0; k < sizeof sign / sizeof *sign; k++) {
        int length = (int)strlen(sign[k].text);
        if (strncmp(at, sign[k].text, (size_t)length)) continue;
        lexer->token = sign[k].token;
        lexer->end = lexer->begin + length;
        return;
    }
    bad(lexer, lexer->begin + width(at), "this character has no meaning in a formula");
}

void ves_lexer_next(ves_lexer *lexer)
{
    const char *text = lexer->text;
    int at = lexer->end;
    lexer->before = at;
    while (blank(text[at])) at++;
    lexer->begin = at;
    if (!text[at]) {
        lexer->token = VES_TOKEN_END;
        lexer->end = at;
    } else if (letter(text[at])) {
        lexer->token = VES_TOKEN_NAME;
        lexer->end = name_end(text, at);
    } else if (digit(text[at]) || (text[at] == '.' && digit(text[at + 1]))) {
        read_number(lexer);
    } else {
        read_sign(lexer);
    }
}

void ves_lexer_start(ves_lexer *lexer, const char *text)
{
    *lexer = (ves_lexer){.text = text};
    ves_lexer_next(lexer);
}

bool ves_lexer_is(const ves_lexer *lexer, const char *word)
{
    size_t length = (size_t)(lexer->end - lexer->begin);
    return lexer->token == VES_TOKEN_NAME && strlen(word) == length &&
           !strncmp(lexer->text + lexer->begin, word, length);
}

bool ves_lexer_calls(const ves_lexer *lexer)
{
    const char *at = lexer->text + lexer->end;
    while (blank(*at)) at++;
    return *at == '(';
}
