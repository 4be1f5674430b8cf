#include "study/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "base/diag.h"
#include "study/folder.h"
#include "study/run.h"
#include "vesica/search.h"

enum { FORMAT = 1, ORDER = 0x01020304, UNIT = 8, TEXT_MOST = 1 << 26, BUFFER = 1 << 18, NAME = 64 };

/* How much work may be lost: to a kill, and to the machine going down. The search itself hands over parts of
 * long rounds every 2 s. */
static const double WRITE_EVERY = 0.1, SYNC_EVERY = 3; /* s */

static const uint64_t NO_ROUND = UINT64_MAX;

typedef struct prefix {
    char magic[8];
    uint32_t order, format;
    int32_t n, m;
    uint32_t size, crc;
} prefix;

static const char MAGIC[8] = "vesica\r\n";

/* --- reading --- */

/* false: errno tells why, 0 that the file ends before. */
static bool read_at(int fd, void *to, size_t size, uint64_t at)
{
    errno = 0;
    for (size_t done = 0; done < size;) {
        ssize_t count = pread(fd, (char *)to + done, size - done, (off_t)(at + done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        done += (size_t)count;
    }
    return true;
}

static uint64_t length_of(int fd)
{
    struct stat there;
    return fd >= 0 && fstat(fd, &there) == 0 ? (uint64_t)there.st_size : 0;
}

static uint32_t sum(const ves_frame *frame, const void *block)
{
    const unsigned char *begin = (const unsigned char *)frame + sizeof frame->crc;
    uLong crc = crc32_z(0, begin, sizeof *frame - sizeof frame->crc);
    return (uint32_t)(frame->size ? crc32_z(crc, block, frame->size) : crc);
}

/* A disk that cannot be read, or memory that is not there, is no end of the file. */
static bool take(ves_frames *f, void *to, size_t size, uint64_t at)
{
    if (read_at(f->fd, to, size, at)) return true;
    if (errno) f->status = VES_IO;
    return false;
}

static bool room_make(ves_frames *f, size_t size)
{
    if (size <= f->room) return true;
    unsigned char *block = ves_memory_grow(f->block, size);
    if (!block) {
        f->status = VES_MEMORY;
        return false;
    }
    f->block = block;
    f->room = size;
    return true;
}

bool ves_frames_next(ves_frames *f)
{
    ves_frame frame;
    uint64_t length = f->most ? f->most : length_of(f->fd);
    if (length < f->at + sizeof frame || f->status != VES_OK) return false;
    if (!take(f, &frame, sizeof frame, f->at)) return false;
    if (frame.size > length - f->at - sizeof frame || frame.size % UNIT || !room_make(f, frame.size))
        return false;
    if (!take(f, f->block, frame.size, f->at + sizeof frame)) return false;
    if (sum(&frame, f->block) != frame.crc) return false;
    f->frame = frame;
    f->at += sizeof frame + frame.size;
    return true;
}

void ves_frames_limit(ves_frames *f)
{
    f->most = length_of(f->fd);
}

uint64_t ves_frames_left(const ves_frames *f)
{
    return (f->most ? f->most : length_of(f->fd)) - f->at;
}

void ves_frames_close(ves_frames *f)
{
    if (f->fd >= 0) close(f->fd);
    ves_memory_free(f->block);
    *f = (ves_frames){.fd = -1};
}

/* --- the head --- */

static size_t padded(size_t length)
{
    return (length + UNIT - 1) / UNIT * UNIT;
}

/* The head as bytes; NULL when out of memory. */
static unsigned char *head_bytes(const ves_journal_head *h, ves_arena *arena, size_t *size)
{
    size_t length = strlen(h->text), text = padded(length);
    unsigned char *bytes = ves_arena_take(arena, sizeof(prefix) + text, 1);
    if (!bytes) return NULL;
    prefix at = {.order = ORDER, .format = FORMAT, .n = h->n, .m = h->m, .size = (uint32_t)text};
    memcpy(at.magic, MAGIC, sizeof MAGIC);
    memset(bytes + sizeof at, ' ', text);
    memcpy(bytes + sizeof at, h->text, length);
    at.crc = (uint32_t)crc32_z(0, bytes + sizeof at, text);
    memcpy(bytes, &at, sizeof at);
    *size = sizeof at + text;
    return bytes;
}

static ves_status refuse(const char *path, const char *why, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_STALE, (ves_mark){0}, "\"%s\" %s", path, why);
}

/* NULL: this version reads it. */
static const char *foreign(const prefix *h)
{
    if (h->order == 0x04030201) return "was written on a machine with another byte order: read it there";
    if (h->format != FORMAT)
        return "is a journal of another format: it takes the version of vesica that has written it";
    return NULL;
}

static ves_status head_read(ves_frames *f, const char *path, ves_arena *arena, ves_journal_head *out,
                            ves_diag *diag)
{
    prefix h;
    const char *why;
    bool whole = read_at(f->fd, &h, sizeof h, 0) && !memcmp(h.magic, MAGIC, sizeof MAGIC);
    if (whole && (why = foreign(&h))) return refuse(path, why, diag);
    whole = whole && h.size <= TEXT_MOST && h.size <= length_of(f->fd) && h.n > 0 && h.m >= 0;
    char *text = whole ? ves_arena_take(arena, (size_t)h.size + 1, 1) : NULL;
    if (whole && !text) return ves_diag_fail(diag, VES_MEMORY);
    whole = whole && read_at(f->fd, text, h.size, sizeof h) &&
            h.crc == (uint32_t)crc32_z(0, (unsigned char *)text, h.size);
    if (!whole)
        return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, (ves_mark){0},
                            "\"%s\" is no journal, or its beginning is damaged", path);
    *out = (ves_journal_head){h.n, h.m, text};
    f->at = sizeof h + h.size;
    return VES_OK;
}

ves_status ves_journal_open(const char *path, ves_arena *arena, ves_journal_head *head, ves_frames *frames,
                            ves_diag *diag)
{
    *frames = (ves_frames){.fd = open(path, O_RDONLY | O_CLOEXEC)};
    if (frames->fd < 0)
        return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot read \"%s\": %s", path,
                            strerror(errno));
    ves_status status = head_read(frames, path, arena, head, diag);
    if (status != VES_OK) ves_frames_close(frames);
    return status;
}

/* --- writing --- */

static bool write_at(int fd, const void *from, size_t size, uint64_t at)
{
    for (size_t done = 0; done < size;) {
        ssize_t count = pwrite(fd, (const char *)from + done, size - done, (off_t)(at + done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        done += (size_t)count;
    }
    return true;
}

/* The first failure ends all writing: what would come behind a gap is of no use. */
static void fail(ves_journal *j)
{
    if (!j->error) j->error = errno ? errno : EIO;
}

static void flush(ves_journal *j)
{
    if (!j->error && !write_at(j->whole.fd, j->buffer, j->buffered, j->end - j->buffered)) fail(j);
    j->buffered = 0;
    j->written = ves_study_clock();
}

/* Behind the end of the file; what is too large for the buffer goes at once. */
static void add(ves_journal *j, const void *from, size_t size)
{
    if (j->buffered + size > BUFFER) flush(j);
    if (size > BUFFER) {
        if (!j->error && !write_at(j->whole.fd, from, size, j->end)) fail(j);
    } else if (size) {
        memcpy(j->buffer + j->buffered, from, size);
        j->buffered += size;
    }
    j->end += size;
}

/* A file whose folder was removed can still be written, but nobody will find it. */
static void look(ves_journal *j)
{
    struct stat there;
    if (j->error || fstat(j->whole.fd, &there) || there.st_nlink) return;
    errno = ENOENT;
    fail(j);
}

static void sync_all(ves_journal *j)
{
    flush(j);
    look(j);
    if (j->error) return;
    if (fdatasync(j->whole.fd) && errno != EINVAL) fail(j);
    if (j->part.fd >= 0 && fdatasync(j->part.fd) && errno != EINVAL) fail(j);
    j->synced = ves_study_clock();
}

static void by_time(ves_journal *j)
{
    double now = ves_study_clock();
    if (now - j->synced > SYNC_EVERY)
        sync_all(j);
    else if (now - j->written > WRITE_EVERY)
        flush(j);
}

static ves_frame frame_of(int kind, int stages, uint64_t round, const void *block, size_t size)
{
    ves_frame frame = {.kind = (uint16_t)kind, .stages = (uint16_t)stages, .round = round, .size = size};
    frame.crc = sum(&frame, block);
    return frame;
}

/* A round that the file has already must be the same again. */
static void check(ves_journal *j, const ves_frame *frame)
{
    ves_frame there;
    bool same = read_at(j->whole.fd, &there, sizeof there, j->checked) && there.crc == frame->crc &&
                there.size == frame->size;
    if (!same) j->stale = true;
    j->checked += sizeof there + frame->size;
}

static void keep_whole(ves_journal *j, const ves_frame *frame, const void *block)
{
    if (j->round++ < j->known) {
        check(j, frame);
        return;
    }
    add(j, frame, sizeof *frame);
    add(j, block, frame->size);
}

/* The rounds before must be in the file when a part is. */
static bool part_begin(ves_journal *j)
{
    flush(j);
    if (j->error) return false;
    if (j->part.fd < 0) j->part.fd = open(j->part_path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (j->part.fd < 0 || ftruncate(j->part.fd, (off_t)(j->part_round == j->round ? j->part_end : 0))) {
        fail(j);
        return false;
    }
    if (j->part_round != j->round) j->part_end = 0;
    j->part_round = j->round;
    return true;
}

static void keep_part(ves_journal *j, const ves_frame *frame, const void *block)
{
    if (j->round < j->known || !part_begin(j)) return;
    if (!write_at(j->part.fd, frame, sizeof *frame, j->part_end) ||
        !write_at(j->part.fd, block, frame->size, j->part_end + sizeof *frame))
        fail(j);
    j->part_end += sizeof *frame + frame->size;
}

void ves_journal_keep(ves_journal *j, const void *block, size_t size, bool whole, int stages)
{
    if (!j->open || j->error) return;
    int kind = whole ? VES_JOURNAL_WHOLE : VES_JOURNAL_PART;
    ves_frame frame = frame_of(kind, stages, j->round, block, size);
    if (whole)
        keep_whole(j, &frame, block);
    else
        keep_part(j, &frame, block);
    by_time(j);
}

bool ves_journal_recall(ves_journal *j, const void **block, size_t *size, bool *whole)
{
    if (!j->open) return false;
    bool rounds = j->recalled < j->known;
    ves_frames *f = rounds ? &j->whole : &j->part;
    if ((!rounds && f->at >= j->part_end) || !ves_frames_next(f)) return false;
    j->recalled += rounds;
    *block = f->block;
    *size = f->frame.size;
    *whole = rounds;
    return true;
}

/* --- opening and ending --- */

static ves_status set_up(ves_journal *j, const char *folder, ves_arena *arena, ves_diag *diag)
{
    *j = (ves_journal){.arena = arena, .whole = {.fd = -1}, .part = {.fd = -1}, .part_round = NO_ROUND};
    j->path = ves_folder_path(folder, "journal", arena);
    j->part_path = ves_folder_path(folder, "journal.part", arena);
    j->buffer = ves_arena_take(arena, BUFFER, 1);
    j->written = j->synced = ves_study_clock();
    return j->path && j->part_path && j->buffer ? VES_OK : ves_diag_fail(diag, VES_MEMORY);
}

static ves_status cannot_write(const ves_journal *j, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot write \"%s\": %s", j->path,
                        strerror(errno));
}

static ves_status begin(ves_journal *j, const ves_journal_head *head, ves_arena *arena, ves_diag *diag)
{
    size_t size;
    unsigned char *bytes = head_bytes(head, arena, &size);
    if (!bytes) return ves_diag_fail(diag, VES_MEMORY);
    if (j->whole.fd < 0 || ftruncate(j->whole.fd, 0) || !write_at(j->whole.fd, bytes, size, 0)) {
        ves_status status = cannot_write(j, diag);
        ves_frames_close(&j->whole);
        return status;
    }
    j->end = j->checked = j->whole.at = size;
    j->open = true;
    return VES_OK;
}

ves_status ves_journal_create(ves_journal *j, const char *folder, const ves_journal_head *head,
                              ves_arena *arena, ves_diag *diag)
{
    VES_TRY(set_up(j, folder, arena, diag));
    j->whole.fd = open(j->path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return begin(j, head, arena, diag);
}

static void count(const ves_frames *f, const ves_journal_head *head, long *evaluations)
{
    ves_search_cursor cursor = {0};
    ves_record record;
    while (ves_search_block_read(f->block, f->frame.size, head->n, head->m, &cursor, &record)) ++*evaluations;
}

/* Goes through what is there once, to find where it ends. */
static ves_status scan(ves_journal *j, const ves_journal_head *head)
{
    j->checked = j->end = j->whole.at;
    while (!j->done && ves_frames_next(&j->whole) && j->whole.frame.round == j->known) {
        j->end = j->whole.at;
        j->done = j->whole.frame.kind == VES_JOURNAL_DONE;
        if (j->done) break;
        j->known++;
        count(&j->whole, head, &j->evaluations);
    }
    j->whole.at = j->checked;
    j->torn = length_of(j->whole.fd) - j->end;
    j->part.fd = open(j->part_path, O_RDWR | O_CLOEXEC);
    while (ves_frames_next(&j->part) && j->part.frame.round == j->known) {
        count(&j->part, head, &j->evaluations);
        j->part_end = j->part.at;
        j->part_round = j->known;
    }
    j->part.at = 0;
    return j->whole.status != VES_OK ? j->whole.status : j->part.status;
}

/* A head that a kill has torn: nothing was asked yet. */
static bool is_torn(const ves_journal *j, const unsigned char *bytes, size_t size, ves_arena *arena)
{
    uint64_t length = length_of(j->whole.fd);
    unsigned char *there = length < size ? ves_arena_take(arena, length + 1, 1) : NULL;
    return there && (!length || read_at(j->whole.fd, there, length, 0)) && !memcmp(there, bytes, length);
}

/* The key of a JSON object under which two texts begin to differ. */
static void differ(const char *a, const char *b, char *key, size_t size)
{
    int depth = 0;
    size_t at = 0;
    *key = 0;
    for (; a[at] && a[at] == b[at]; at++) {
        depth += (a[at] == '{' || a[at] == '[') - (a[at] == '}' || a[at] == ']');
        if (depth == 1 && a[at] == '"' && (a[at - 1] == '{' || a[at - 1] == ','))
            snprintf(key, size, "%.*s", (int)strcspn(a + at + 1, "\""), a + at + 1);
    }
}

static ves_status compare(const char *path, const char *there, const char *ours, ves_diag *diag)
{
    char key[NAME];
    if (!strncmp(there, ours, strlen(ours))) return VES_OK;
    differ(there, ours, key, sizeof key);
    if (!strcmp(key, "vesica"))
        return refuse(path,
                      "was written by another version of vesica (this is " VESICA_VERSION
                      "): go on with that one, or run the problem.yaml beside it anew",
                      diag);
    if (!strcmp(key, "problem"))
        return refuse(
            path,
            "belongs to another problem than the problem.yaml beside it: put the old one back, or run "
            "the new one anew",
            diag);
    return ves_diag_add(diag, VES_ERROR, VES_STALE, (ves_mark){0},
                        "\"%s\" belongs to another run (its \"%s\" is not the same): run the problem.yaml "
                        "beside it anew",
                        path, key);
}

ves_status ves_journal_reopen(ves_journal *j, const char *folder, const ves_journal_head *head,
                              ves_arena *arena, ves_diag *diag)
{
    size_t size;
    ves_journal_head there;
    VES_TRY(set_up(j, folder, arena, diag));
    unsigned char *bytes = head_bytes(head, arena, &size);
    if (!bytes) return ves_diag_fail(diag, VES_MEMORY);
    j->whole.fd = open(j->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (j->whole.fd < 0 || is_torn(j, bytes, size, arena)) return begin(j, head, arena, diag);
    ves_status status = head_read(&j->whole, j->path, arena, &there, diag);
    if (status == VES_OK) status = compare(j->path, there.text, head->text, diag);
    if (status == VES_OK) {
        status = scan(j, &there);
        if (status != VES_OK)
            ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "cannot read \"%s\": %s", j->path,
                         ves_status_text(status));
        else if (j->torn && ftruncate(j->whole.fd, (off_t)j->end))
            status = cannot_write(j, diag);
    }
    j->open = status == VES_OK;
    if (!j->open) ves_frames_close(&j->whole), ves_frames_close(&j->part);
    return status;
}

void ves_journal_end(ves_journal *j, bool done)
{
    if (!j->open) return;
    if (done && !j->done && !j->stale) {
        const ves_frame last = frame_of(VES_JOURNAL_DONE, 0, j->round, NULL, 0);
        add(j, &last, sizeof last);
    }
    flush(j);
    look(j);
    if (done && !j->error && !j->stale) unlink(j->part_path);
    ves_frames_close(&j->whole);
    ves_frames_close(&j->part);
    j->open = false;
}
