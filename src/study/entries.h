/* Entries: a journal as people read it: all evaluations of a run in their order, in the sign and the units of
 * result.json. It needs nothing but the journal, whose head tells the names; the run may still be going on. */
#ifndef VES_STUDY_ENTRIES_H
#define VES_STUDY_ENTRIES_H

#include "study/journal.h"
#include "vesica/search.h"

typedef struct ves_entries {
    int n, m;
    const char **variable;   /* [n] names */
    const char **constraint; /* [m] as written */
    double *within;          /* [m] */
    bool *equal, maximize;   /* [m] */
    ves_frames file[2];      /* the whole rounds, and the parts of the next */
    bool parts;              /* the second one is being read */
    uint64_t rounds;         /* whole ones read */
    ves_search_cursor cursor;
    long evaluation;
    double *excess;   /* [m] of the entry at hand */
    const char *path; /* of the journal, for messages */
} ves_entries;

/* One evaluation; its arrays live until the next is read. Numbers that it does not have are NAN. */
typedef struct ves_entry {
    long evaluation; /* from 1 */
    int stage, chain;
    const double *x; /* [n] */
    double value, violation, temperature;
    const double
        *excess; /* [m] by how much each constraint is missed, relative to its size: <= 0 is met; of an
                             equality with its sign. NULL: not measured */
    ves_status status;
    bool accepted, proof, gradient;
} ves_entry;

/* folder: of the run. On failure nothing is open. */
ves_status ves_entries_open(ves_entries *entries, const char *folder, ves_arena *arena, ves_diag *diag);
bool ves_entries_next(ves_entries *entries, ves_entry *entry);

/* Bytes behind the last entry that cannot be read; negative when it is not the file that ends. */
long ves_entries_torn(const ves_entries *entries);
void ves_entries_close(ves_entries *entries);

#endif
