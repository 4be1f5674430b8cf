/* Whole files. */
#ifndef TESTS_SLURP_H
#define TESTS_SLURP_H

#include <stdio.h>
#include <stdlib.h>

/* Ended by 0; the caller frees. */
static inline char *slurp_bytes(const char *path, size_t *size)
{
    FILE *in = fopen(path, "rb");
    cr_assert(in != NULL, "cannot open %s", path);
    fseek(in, 0, SEEK_END);
    *size = (size_t)ftell(in);
    rewind(in);
    char *data = malloc(*size + 1);
    cr_assert(fread(data, 1, *size, in) == *size);
    data[*size] = 0;
    fclose(in);
    return data;
}

static inline char *slurp(const char *path)
{
    size_t size;
    return slurp_bytes(path, &size);
}

#endif
