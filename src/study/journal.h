/* Journal: the file that keeps what a search was answered, so that a run that was broken off, by a stop or a
 * kill at any moment, goes on as if nothing had happened.
 *
 *     journal        head, then frames: one for each round that is over, and one behind the last
 *     journal.part   frames of what is known of the round that is not over; gone when the run is done
 *     head           "vesica\r\n", u32 0x01020304, u32 format, i32 n, i32 m, u32 size, u32 crc, text [size]
 *     frame          u32 crc, u16 kind, u16 stages, u64 round, u64 size, block [size]
 *
 * In the byte order of the machine, in units of eight bytes. crc: zlib's, of all of the text, or of all of the
 * frame behind it. text: one JSON object, filled up with blanks, that tells what the run was made with; who goes
 * on must have the same. kind: 1 a whole round, 2 a part of one, 3 the run is done (no block). stages: of the
 * searches of the run before this one. round: how many whole ones come before; a part of another round than the
 * next is of no use. block: as in search/block.h; ves_search_block_read reads it.
 *
 * Frames are only added, so that a kill tears the last one at worst. What cannot be read is dropped, and all
 * behind it: the search asks for it again. */
#ifndef VES_STUDY_JOURNAL_H
#define VES_STUDY_JOURNAL_H

#include <stdint.h>

#include "base/arena.h"
#include "vesica/diag.h"

enum { VES_JOURNAL_WHOLE = 1, VES_JOURNAL_PART = 2, VES_JOURNAL_DONE = 3 };

typedef struct ves_journal_head {
    int n, m;
    const char *text;
} ves_journal_head;

typedef struct ves_frame {
    uint32_t crc;
    uint16_t kind, stages;
    uint64_t round, size;
} ves_frame;

/* One of the two files; who only reads needs no more. */
typedef struct ves_frames {
    int fd;          /* -1: there is none */
    uint64_t at;     /* the frame to be read next */
    uint64_t most;   /* read no further; 0: to the end */
    ves_frame frame; /* the last one read, and its block */
    unsigned char *block;
    size_t room;
    ves_status status; /* VES_IO, VES_MEMORY: it is not the file that ends */
} ves_frames;

typedef struct ves_journal {
    ves_arena *arena; /* of the paths and the buffer */
    const char *path, *part_path;
    bool open;
    ves_frames whole, part;
    uint64_t checked;       /* where in the file the frame of the round that is over next begins */
    uint64_t end, part_end; /* behind what is in the files, or in the buffer */
    uint64_t known,
        recalled;          /* whole rounds in the file when it was opened; of these, handed to the search */
    uint64_t round;        /* that the search has kept */
    uint64_t part_round;   /* that the parts in the file are of */
    bool done;             /* the last frame says so */
    bool stale;            /* the search did not go the same way again */
    long evaluations;      /* that were known when it was opened */
    uint64_t torn;         /* bytes that could not be read then */
    int error;             /* errno of what could not be written: nothing is any more */
    unsigned char *buffer; /* of the whole rounds */
    size_t buffered;
    double written, synced; /* s, of ves_study_clock */
} ves_journal;

/* A new one in the folder. Without memory or a file: a message, nothing is open. */
ves_status ves_journal_create(ves_journal *journal, const char *folder, const ves_journal_head *head,
                              ves_arena *arena, ves_diag *diag);

/* Goes on with the one in the folder; a new one where there is none, or not even its head. VES_STALE: it is of
 * another run. */
ves_status ves_journal_reopen(ves_journal *journal, const char *folder, const ves_journal_head *head,
                              ves_arena *arena, ves_diag *diag);

/* The hooks of a search. What cannot be written is remembered in `error`. */
void ves_journal_keep(ves_journal *journal, const void *block, size_t size, bool whole, int stages);
bool ves_journal_recall(ves_journal *journal, const void **block, size_t *size, bool *whole);

/* done: the run needs no journal any more, but for people who want to read it. */
void ves_journal_end(ves_journal *journal, bool done);

/* Reads the head of a journal and puts `frames` before the first frame. VES_SYNTAX: it has none; VES_STALE: that
 * of another machine or format. *end: behind it. */
ves_status ves_journal_open(const char *path, ves_arena *arena, ves_journal_head *head, ves_frames *frames,
                            ves_diag *diag);
bool ves_frames_next(ves_frames *frames);           /* false: there is none, or none whole */
void ves_frames_limit(ves_frames *frames);          /* what a search adds from now on is not read */
uint64_t ves_frames_left(const ves_frames *frames); /* bytes behind those read */
void ves_frames_close(ves_frames *frames);

#endif
