#include "search/archive.h"

#include <math.h>
#include <string.h>

bool ves_archive_create(ves_archive *archive, ves_session *session, int room)
{
    *archive = (ves_archive){.session = session, .room = room};
    archive->end = ves_session_ends(session, room + 1);
    return archive->end;
}

bool ves_archive_near(const ves_archive *archive, const ves_point *a, const ves_point *b)
{
    for (int i = 0; i < archive->session->n; i++)
        if (!(fabs(a->u[i] - b->u[i]) <= VES_ONE_OPTIMUM)) return false;
    return true;
}

int ves_archive_find(const ves_archive *archive, const ves_point *point)
{
    for (int k = 0; k < archive->count; k++)
        if (ves_archive_near(archive, &archive->end[k].point, point)) return k;
    return -1;
}

static void exchange(ves_archive *archive, int a, int b)
{
    ves_end end = archive->end[a];
    archive->end[a] = archive->end[b];
    archive->end[b] = end;
}

static int rise(ves_archive *archive, int k)
{
    for (; k && ves_session_better(archive->session, &archive->end[k].point.verdict,
                                   &archive->end[k - 1].point.verdict);
         k--)
        exchange(archive, k - 1, k);
    return k;
}

int ves_archive_add(ves_archive *archive, const ves_point *point)
{
    const ves_session *session = archive->session;
    if (archive->closes && archive->count == archive->room) return ves_archive_find(archive, point);
    if (point->verdict.status != VES_OK) {
        archive->failed++;
        return -1;
    }
    archive->met++;
    int k = ves_archive_find(archive, point);
    if (k < 0) {
        archive->kinds++;
        bool full = archive->count == archive->room;
        k = full ? archive->count - 1 : archive->count++;
        if (full && !ves_session_better(session, &point->verdict, &archive->end[k].point.verdict)) return -1;
        archive->end[k] = (ves_end){.point = archive->end[k].point};
        ves_point_copy(&archive->end[k].point, point, session->n, session->m);
    } else {
        if (ves_session_better(session, &point->verdict, &archive->end[k].point.verdict))
            ves_point_copy(&archive->end[k].point, point, session->n, session->m);
    }
    archive->end[k].hits++;
    return rise(archive, k);
}

void ves_archive_drop(ves_archive *archive, int k)
{
    for (int j = k; j + 1 < archive->count; j++) exchange(archive, j, j + 1);
    archive->count--;
}

void ves_archive_sort(ves_archive *archive)
{
    for (int k = 1; k < archive->count; k++) rise(archive, k);
}
