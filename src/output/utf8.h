/* UTF-8: names of files and titles may hold any bytes; JSON and cairo take none that are not Unicode. */
#ifndef VES_OUTPUT_UTF8_H
#define VES_OUTPUT_UTF8_H

#include <stddef.h>

/* Bytes of the well-formed sequence at text (1 .. 4), 0 when there is none [RFC 3629]. */
int ves_utf8_length(const char *text);

/* Copies what fits of text, in whole sequences; ill-formed bytes become '?'. size > 0. */
void ves_utf8_copy(char *copy, size_t size, const char *text);

#endif
