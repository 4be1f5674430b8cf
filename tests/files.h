/* Files that a test writes and reads again. */
#ifndef TESTS_FILES_H
#define TESTS_FILES_H

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "slurp.h"

/* A folder of this process, so that tests may run at the same time. */
static inline const char *path_of(const char *name)
{
    static char path[4][512];
    static int turn;
    char folder[256];
    turn = (turn + 1) % 4;
    snprintf(folder, sizeof folder, "%s/test_files.%ld", VESICA_BUILD, (long)getpid());
    mkdir(folder, 0777);
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static inline void clean(void)
{
    static const char *const names[] = {"a.stl", "a.obj", "a.ply", "a.off", "a.vtp", "a.csv", "a.png",
                                        "a.svg", "a.pdf", "a.inp", "b.png", "log",   ""};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) remove(path_of(names[k]));
}

static inline void check_nothing_left(void)
{
    char folder[512];
    snprintf(folder, sizeof folder, "%s", path_of(""));
    folder[strlen(folder) - 1] = 0;
    cr_assert(rmdir(folder) == 0, "something was left in %s: %s", folder, strerror(errno));
}

#endif
