#include "study/load.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "base/text.h"
#include "study/open.h"

enum { CHUNK = 65536 };

ves_status ves_json_load(const char *path, ves_arena *arena, const ves_node **root)
{
    char *text = NULL;
    size_t length = 0;
    *root = NULL;
    errno = 0;
    VES_TRY(ves_study_load(path, arena, &text, &length));
    *root = ves_study_json(text, length, arena);
    return *root ? VES_OK : VES_SYNTAX;
}

const char *ves_json_word(const ves_node *map, const char *key)
{
    const ves_node *node = map ? ves_node_find(map, key) : NULL;
    return node && node->kind == VES_NODE_WORD ? node->text : NULL;
}

double ves_json_double(const ves_node *map, const char *key, double otherwise)
{
    double value;
    const char *word = ves_json_word(map, key);
    return word && ves_text_number(word, &value) ? value : otherwise;
}

bool ves_json_true(const ves_node *map, const char *key)
{
    const char *word = ves_json_word(map, key);
    return word && !strcmp(word, "true");
}

unsigned long ves_study_sum(const char *path)
{
    unsigned char chunk[CHUNK];
    uLong crc = crc32_z(0, NULL, 0);
    FILE *file = fopen(path, "rb");
    if (!file) return 0;
    for (size_t count; (count = fread(chunk, 1, sizeof chunk, file)) > 0;) crc = crc32_z(crc, chunk, count);
    fclose(file);
    return crc;
}

const char *ves_study_absolute(const char *path, ves_arena *arena)
{
    char here[PATH_MAX];
    if (*path == '/' || !getcwd(here, sizeof here)) return path;
    return ves_arena_format(arena, "%s/%s", here, path);
}
