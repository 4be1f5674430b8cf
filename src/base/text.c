#include "base/text.h"

#include <ctype.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD = 64 };

/* Accepts [+-]digits[.digits][(e|E)[+-]digits] with at least one digit before the exponent. */
static bool decimal(const char *s)
{
    int digits = 0;
    if (*s == '+' || *s == '-') s++;
    for (; isdigit((unsigned char)*s); s++) digits++;
    if (*s == '.')
        for (s++; isdigit((unsigned char)*s); s++) digits++;
    if (!digits) return false;
    if (*s == 'e' || *s == 'E') {
        s++;
        if (*s == '+' || *s == '-') s++;
        if (!isdigit((unsigned char)*s)) return false;
        while (isdigit((unsigned char)*s)) s++;
    }
    return *s == 0;
}

bool ves_text_number(const char *text, double *value)
{
    if (!decimal(text)) return false;
    char copy[512];
    size_t length = strlen(text);
    if (length >= sizeof copy) return false;
    memcpy(copy, text, length + 1);
    char *point = strchr(copy, '.');
    if (point) *point = localeconv()->decimal_point[0]; /* strtod follows the locale, problem files do not */
    double v = strtod(copy, NULL);
    if (!isfinite(v)) return false;
    *value = v;
    return true;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* Optimal string alignment distance; words longer than WORD are cut. */
static int distance(const char *a, const char *b)
{
    int d[3][WORD + 1], la = (int)strlen(a), lb = (int)strlen(b);
    if (la > WORD) la = WORD;
    if (lb > WORD) lb = WORD;
    for (int j = 0; j <= lb; j++) d[0][j] = j;
    for (int i = 1; i <= la; i++) {
        int *now = d[i % 3], *up = d[(i + 2) % 3], *up2 = d[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= lb; j++) {
            int x = tolower((unsigned char)a[i - 1]), y = tolower((unsigned char)b[j - 1]);
            now[j] = least(least(up[j] + 1, now[j - 1] + 1), up[j - 1] + (x != y));
            bool swapped = i > 1 && j > 1 && x == tolower((unsigned char)b[j - 2]) &&
                           y == tolower((unsigned char)a[i - 2]);
            if (swapped) now[j] = least(now[j], up2[j - 2] + 1);
        }
    }
    return d[la % 3][lb];
}

int ves_text_nearest(const char *word, const char *const *candidate, int count)
{
    int best = -1, best_distance = 0;
    for (int k = 0; k < count; k++) {
        size_t la = strlen(word), lb = strlen(candidate[k]), longer = la > lb ? la : lb;
        int far = distance(word, candidate[k]), allowed = longer < 6 ? 1 + (longer > 2) : (int)(longer / 3);
        if (far <= allowed && (best < 0 || far < best_distance)) best = k, best_distance = far;
    }
    return best;
}

const char *ves_words_at(const char *words, int index, int *length)
{
    for (; words && index > 0; index--) {
        words = strchr(words, '|');
        if (words) words++;
    }
    if (words) *length = (int)strcspn(words, "|");
    return words;
}

int ves_words_count(const char *words)
{
    int count = 0, length;
    while (ves_words_at(words, count, &length)) count++;
    return count;
}

int ves_words_find(const char *words, const char *word)
{
    int length;
    const char *at;
    for (int k = 0; (at = ves_words_at(words, k, &length)); k++)
        if ((size_t)length == strlen(word) && !strncmp(at, word, (size_t)length)) return k;
    return -1;
}

void ves_text_shortest(double value, char buffer[32])
{
    if (!isfinite(value)) {
        snprintf(buffer, 32, "%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
        return;
    }
    for (int digits = 15; digits <= 17;
         digits++) { /* %g drops zeros at the end: 15 digits give every shorter text too */
        snprintf(buffer, 32, "%.*g", digits, value);
        if (strtod(buffer, NULL) == value) break;
    }
    char *comma = strchr(buffer, localeconv()->decimal_point[0]);
    if (comma) *comma = '.';
}
