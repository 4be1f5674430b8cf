/* Source files as the test of the house rules sees them: the tree walked, comments and literals blanked. */
#ifndef TESTS_SOURCE_H
#define TESTS_SOURCE_H

#include <ctype.h>
#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct source {
    char path[512]; /* from the root of the checkout */
    char *raw;      /* as it stands */
    char *bare; /* as long; comments and what is inside quotes are blanks, so are preprocessor lines in `code`
                 */
    char *code;
} source;

static inline void blank(char *at, char *end)
{
    for (; at < end; at++)
        if (*at != '\n') *at = ' ';
}

/* The end of the comment or literal that begins at `at`; `at` itself when none does. */
static inline char *skip_aside(char *at)
{
    if (at[0] == '/' && at[1] == '*') {
        char *end = strstr(at + 2, "*/");
        return end ? end + 2 : at + strlen(at);
    }
    if (at[0] == '/' && at[1] == '/') return at + strcspn(at, "\n");
    if (*at != '"' && *at != '\'') return at;
    char quote = *at++;
    while (*at && *at != quote && *at != '\n') at += *at == '\\' && at[1] ? 2 : 1;
    return *at == quote ? at + 1 : at;
}

static inline void blank_asides(char *text)
{
    for (char *at = text; *at;) {
        char *end = skip_aside(at);
        bool comment = *at == '/';
        if (end > at) blank(comment ? at : at + 1, comment || end == at + 1 ? end : end - 1);
        at = end > at ? end : at + 1;
    }
}

static inline void blank_directives(char *text)
{
    for (char *line = text; *line;) {
        char *end = line + strcspn(line, "\n");
        if (line[strspn(line, " \t")] == '#') {
            while (*end && end[-1] == '\\') end += 1 + strcspn(end + 1, "\n");
            blank(line, end);
        }
        line = *end ? end + 1 : end;
    }
}

static inline char *copy_of(const char *text)
{
    size_t size = strlen(text) + 1;
    return memcpy(malloc(size), text, size);
}

/* Takes raw over. */
static inline source source_of(const char *path, char *raw)
{
    source s = {.raw = raw, .bare = copy_of(raw)};
    snprintf(s.path, sizeof s.path, "%s", path);
    blank_asides(s.bare);
    s.code = copy_of(s.bare);
    blank_directives(s.code);
    return s;
}

static inline void source_free(source *s)
{
    free(s->raw);
    free(s->bare);
    free(s->code);
}

static inline int line_of(const char *text, const char *at)
{
    int line = 1;
    for (; text < at; text++) line += *text == '\n';
    return line;
}

static inline bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n >= m && !strcmp(text + n - m, end);
}

static inline bool starts_with(const char *text, const char *start)
{
    return !strncmp(text, start, strlen(start));
}

static inline char *read_text(const char *path)
{
    FILE *in = fopen(path, "rb");
    if (!in) return NULL;
    fseek(in, 0, SEEK_END);
    size_t size = (size_t)ftell(in);
    rewind(in);
    char *text = malloc(size + 1);
    text[fread(text, 1, size, in)] = 0;
    fclose(in);
    return text;
}

static inline bool is_source(const char *name)
{
    return ends_with(name, ".c") || ends_with(name, ".h") || ends_with(name, ".cpp");
}

static inline void walk(const char *folder, void (*visit)(void *data, const source *s), void *data)
{
    char path[512], full[1024];
    snprintf(full, sizeof full, "%s/%s", VESICA_SOURCE, folder);
    DIR *dir = opendir(full);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        struct stat about;
        if (entry->d_name[0] == '.') continue;
        if (snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) >= (int)sizeof path) continue;
        snprintf(full, sizeof full, "%s/%s", VESICA_SOURCE, path);
        if (stat(full, &about)) continue;
        if (S_ISDIR(about.st_mode)) walk(path, visit, data);
        char *raw = S_ISREG(about.st_mode) && is_source(path) ? read_text(full) : NULL;
        if (!raw) continue;
        source s = source_of(path, raw);
        visit(data, &s);
        source_free(&s);
    }
    if (dir) closedir(dir);
}

#endif
