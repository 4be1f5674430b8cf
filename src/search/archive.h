/* Archive: the distinct places where descents have ended, best first. */
#ifndef VES_SEARCH_ARCHIVE_H
#define VES_SEARCH_ARCHIVE_H

#include "search/session.h"

enum { VES_ARCHIVE_ROOM = 64 };

typedef struct ves_archive {
    const ves_session *session;
    int count;
    ves_end *end;                /* [VES_ARCHIVE_ROOM + 1]; the last is spare */
    long hits[VES_ARCHIVE_ROOM]; /* how often each was met */
    long met, blind,
        kinds; /* all ends; those of descents from random points, and how many of them were new */
    long blind_hits[VES_ARCHIVE_ROOM]; /* of these, by place */
} ves_archive;

/* False when out of memory. */
bool ves_archive_create(ves_archive *archive, ves_session *session);

/* Adds an end; blind: it was reached from a point drawn at random. Failed ones are counted only. Returns its
 * place, or -1 when it is worse than all of a full archive. */
int ves_archive_add(ves_archive *archive, const ves_point *point, bool blind);

/* Forgets an end; brings the ends back into order after prices have changed. */
void ves_archive_drop(ves_archive *archive, int k);
void ves_archive_sort(ves_archive *archive);

/* Two ends at one place, within 1e-3 of the ranges. */
bool ves_archive_near(const ves_archive *archive, const ves_point *a, const ves_point *b);

#endif
