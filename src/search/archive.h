/* Archive: the distinct places where descents have ended, best first. */
#ifndef VES_SEARCH_ARCHIVE_H
#define VES_SEARCH_ARCHIVE_H

#include "search/session.h"

enum { VES_ARCHIVE_ROOM = 64 };

typedef struct ves_archive {
    const ves_session *session;
    int count, room;
    ves_end *end;     /* [room + 1]; the last is spare */
    bool closes;      /* a full one counts no more, as it could not tell what is new */
    long met, failed; /* all ends with a value; and without one */
    long
        kinds; /* how many of the first were new: too many where one that there was no room for is met again */
} ves_archive;

/* False when out of memory. */
bool ves_archive_create(ves_archive *archive, ves_session *session, int room);

/* Adds an end. Returns its place; -1: it failed, or there was no place for it. */
int ves_archive_add(ves_archive *archive, const ves_point *point);

/* The place of the end that is near a point, or -1. */
int ves_archive_find(const ves_archive *archive, const ves_point *point);

/* Forgets an end; brings the ends back into order after prices have changed. */
void ves_archive_drop(ves_archive *archive, int k);
void ves_archive_sort(ves_archive *archive);

/* Two ends at one place, within 1e-3 of the ranges. */
bool ves_archive_near(const ves_archive *archive, const ves_point *a, const ves_point *b);

#endif
