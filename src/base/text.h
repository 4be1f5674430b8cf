/* Small text services that several rooms need. */
#ifndef VES_BASE_TEXT_H
#define VES_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* The whole of `text` as a finite decimal number, whatever the locale; false when anything is left over, or
 * when the number is not finite. No hexadecimal, no inf, no nan. */
bool ves_text_number(const char *text, double *value);

/* Index of the candidate nearest to `word` when it is near enough to be a slip of the pen, else -1. Distance:
 * Damerau-Levenshtein, insensitive to case; near: at most a third of the longer word, at least one. */
int ves_text_nearest(const char *word, const char *const *candidate, int count);

/* Position of `word` in "one|two|three", or -1; and the k-th word's length and start. */
int ves_words_find(const char *words, const char *word);
int ves_words_count(const char *words);
const char *ves_words_at(const char *words, int index, int *length);

/* The shortest decimal text that reads back as exactly `value`; size >= 32. "inf", "-inf", "nan" for those. */
void ves_text_shortest(double value, char buffer[32]);

#endif
