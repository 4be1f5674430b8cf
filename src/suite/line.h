/* Line: a program that is talked to in lines of JSON, through one socket that is its stdin and its stdout. */
#ifndef VES_SUITE_LINE_H
#define VES_SUITE_LINE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ves_line {
    int socket; /* -1: none */
    long child; /* process id, also of its group; 0: none */
    char *text; /* what has come, terminated; [room] */
    size_t length, room;
    size_t taken; /* of it, by the line handed out last */
} ves_line;

/* word: the command, ends with NULL. Returns 0, or errno. */
int ves_line_open(ves_line *line, const char *const *word);

typedef enum ves_line_end {
    VES_LINE_DONE,    /* *text is the next line; or all was written */
    VES_LINE_CLOSED,  /* the program has ended, or closed its stdout */
    VES_LINE_LATE,    /* nothing came, or went, for so long */
    VES_LINE_STOPPED, /* stopped said so */
    VES_LINE_LONG,    /* more than 16 MB without an end */
    VES_LINE_MEMORY
} ves_line_end;
ves_line_end ves_line_read(ves_line *line, double seconds, bool (*stopped)(void *), void *data, char **text);

/* Writes all of it. A program that writes and never reads is VES_LINE_LATE, not a wait for ever. */
ves_line_end ves_line_write(ves_line *line, double seconds, bool (*stopped)(void *), void *data,
                            const char *text, size_t length);

/* Waits a moment for its end, then kills it with all that it has started. Returns its exit code, or minus the
 * signal that ended it. */
int ves_line_close(ves_line *line, double seconds);

/* What a program may say: {"ask": [u, ...], "gradient": true} or {"done": true}. */
typedef struct ves_request {
    bool done, gradient;
    int count; /* numbers in ask; -1: none was said */
} ves_request;

/* u [n]. False: it is no such line. */
bool ves_request_read(const char *text, int n, double *u, ves_request *request);

#endif
