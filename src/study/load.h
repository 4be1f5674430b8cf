/* Load: files of a run folder that hold one JSON object each. */
#ifndef VES_STUDY_LOAD_H
#define VES_STUDY_LOAD_H

#include "problem/tree.h"

/* Without a message. VES_IO: errno tells why, 0 that it is no such file; VES_SYNTAX: damaged or not whole, and
 * *root is NULL. */
ves_status ves_json_load(const char *path, ves_arena *arena, const ves_node **root);

/* What stands under a key: a word, or NULL; a number, or `otherwise`; is it `true`. */
const char *ves_json_word(const ves_node *map, const char *key);
double ves_json_double(const ves_node *map, const char *key, double otherwise);
bool ves_json_true(const ves_node *map, const char *key);

/* The checksum of a file (CRC-32); 0: it cannot be read. */
unsigned long ves_study_sum(const char *path);

/* The path as it holds from any folder. NULL: out of memory. */
const char *ves_study_absolute(const char *path, ves_arena *arena);

#endif
