#include "study/entries.h"

#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/diag.h"
#include "study/design.h"
#include "study/folder.h"
#include "study/load.h"
#include "study/open.h"

static bool names(const ves_node *list, int count, const char **name)
{
    if (!list || list->kind != VES_NODE_LIST || list->count != count) return false;
    for (int k = 0; k < count; k++) name[k] = list->item[k]->text;
    return true;
}

static bool constraints(const ves_node *list, ves_entries *e)
{
    if (!list || list->kind != VES_NODE_LIST || list->count != e->m) return false;
    for (int k = 0; k < e->m; k++) {
        const char *relation = ves_json_word(list->item[k], "relation");
        e->constraint[k] = ves_json_word(list->item[k], "text");
        e->within[k] = ves_json_double(list->item[k], "within", VES_FEASIBLE);
        e->equal[k] = relation && !strcmp(relation, "==");
        if (!e->constraint[k]) return false;
    }
    return true;
}

static ves_status head_take(const ves_journal_head *head, ves_arena *arena, ves_entries *e)
{
    const ves_node *root = ves_study_json(head->text, strlen(head->text), arena);
    size_t n = (size_t)head->n, m = (size_t)head->m;
    if (!root) return VES_SYNTAX;
    e->n = head->n, e->m = head->m;
    e->maximize = ves_json_true(root, "maximize");
    e->variable = ves_arena_take(arena, n, sizeof *e->variable);
    e->constraint = ves_arena_take(arena, m, sizeof *e->constraint);
    e->within = ves_arena_take(arena, m, sizeof *e->within);
    e->equal = ves_arena_take(arena, m, sizeof *e->equal);
    e->excess = ves_arena_take(arena, m, sizeof *e->excess);
    if (!e->variable || !e->constraint || !e->within || !e->equal || !e->excess) return VES_MEMORY;
    bool good = names(ves_node_find(root, "variables"), e->n, e->variable) &&
                constraints(ves_node_find(root, "constraints"), e);
    return good ? VES_OK : VES_SYNTAX;
}

/* Where there is none, why. */
static ves_status journal_is(const char *folder, const char *path, ves_arena *arena, ves_diag *diag)
{
    char *run = ves_folder_path(folder, "run.json", arena);
    char *bench = ves_folder_path(folder, "bench.json", arena);
    if (!run || !bench) return ves_diag_fail(diag, VES_MEMORY);
    if (!access(path, F_OK)) return VES_OK;
    if (!access(run, F_OK))
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0},
                            "the run \"%s\" has no journal: it was made with --journal none, or ended before "
                            "its first evaluation",
                            folder);
    if (access(bench, F_OK)) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0},
                        "\"%s\" is the folder of a benchmark: the journals of its runs are "
                        "%s/journals/NUMBER.jsonl",
                        folder, folder);
}

ves_status ves_entries_open(ves_entries *e, const char *folder, ves_arena *arena, ves_diag *diag)
{
    ves_journal_head head;
    *e = (ves_entries){.path = ves_folder_path(folder, "journal", arena)};
    char *part = ves_folder_path(folder, "journal.part", arena);
    if (!e->path || !part) return ves_diag_fail(diag, VES_MEMORY);
    VES_TRY(journal_is(folder, e->path, arena, diag));
    VES_TRY(ves_journal_open(e->path, arena, &head, &e->file[0], diag));
    ves_status status = head_take(&head, arena, e);
    e->file[1] = (ves_frames){.fd = open(part, O_RDONLY | O_CLOEXEC)};
    for (int k = 0; k < 2; k++) ves_frames_limit(&e->file[k]); /* a run may be quicker than who reads */
    if (status == VES_OK) return VES_OK;
    ves_entries_close(e);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    return ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "the head of \"%s\" is damaged", e->path);
}

/* The next frame with evaluations. */
static bool turn(ves_entries *e)
{
    e->cursor = (ves_search_cursor){0};
    if (!e->parts) {
        if (ves_frames_next(&e->file[0]) && e->file[0].frame.kind == VES_JOURNAL_WHOLE) {
            e->rounds++;
            return true;
        }
        e->parts = true;
    }
    return ves_frames_next(&e->file[1]) && e->file[1].frame.round == e->rounds;
}

static void fill(ves_entries *e, const ves_record *r, ves_entry *entry)
{
    bool good = r->status == VES_OK;
    *entry = (ves_entry){.evaluation = ++e->evaluation,
                         .stage = e->file[e->parts].frame.stages + r->stage,
                         .chain = r->chain,
                         .x = r->x,
                         .value = !good         ? NAN
                                  : e->maximize ? -r->value
                                                : r->value,
                         .violation = good ? 0 : NAN,
                         .temperature = r->temperature,
                         .excess = good ? e->excess : NULL,
                         .status = r->status,
                         .accepted = r->accepted,
                         .proof = r->proof,
                         .gradient = r->slope != NULL};
    for (int k = 0; good && k < e->m; k++) {
        e->excess[k] = ves_design_excess(r->constraint[k], e->within[k]);
        entry->violation = fmax(entry->violation, e->equal[k] ? fabs(e->excess[k]) : e->excess[k]);
    }
}

bool ves_entries_next(ves_entries *e, ves_entry *entry)
{
    ves_record record;
    for (;;) {
        const ves_frames *f = &e->file[e->parts];
        if (ves_search_block_read(f->block, f->block ? f->frame.size : 0, e->n, e->m, &e->cursor, &record))
            break;
        if (!turn(e)) return false;
    }
    fill(e, &record, entry);
    return true;
}

long ves_entries_torn(const ves_entries *e)
{
    if (e->file[0].status != VES_OK || e->file[1].status != VES_OK) return -1;
    return (long)ves_frames_left(&e->file[0]);
}

void ves_entries_close(ves_entries *e)
{
    ves_frames_close(&e->file[0]);
    ves_frames_close(&e->file[1]);
}
