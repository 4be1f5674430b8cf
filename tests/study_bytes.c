/* The same seed gives the same bytes of a run's files: twice, and for any number of jobs. Problems that
 * differ in what could disturb the order: many chains and a long polish, equations that are solved and
 * scaled, bests that their proof refuses. */
#include <criterion/criterion.h>
#include <string.h>

#include "files.h"
#include "fonts.h"
#include "problem/problem.h"
#include "study/run.h"

typedef struct trial {
    const char *name, *text; /* text: NULL, and name is that of problems/NAME.yaml */
    long evaluations;
    long proofs; /* that must have refused a best */
} trial;

/* A tube whose ends lean against each other: with a large k its profile is a loop. The larger the better, so
 * what the search likes best crosses itself. */
static const char LOOP[] =
    "vesica: 1\nvariables: {k: [0.2, 1, 20], t: [-1, 0.1, 1]}\n"
    "curves:\n  p: {circle: {radius: 1}}\n  q: {like: p, apply: [{translate: [t, 0, 1.2]}]}\n"
    "  out: {formula: [\"cos(v)\", \"sin(v)\", \"1\"]}\n  in: {formula: [\"-cos(v)\", \"-sin(v)\", \"1\"]}\n"
    "patches: {wall: {operator: {power: 2, a: 0.5}, conditions: [{u: 0, position: p}, {u: 1, position: q}, "
    "{u: 0, derivative: 1, field: out, scale: k}, {u: 1, derivative: 1, field: in, scale: k}]}}\n"
    "maximize: area\n";

static const char *const FILES[] = {"optima.png", "annealing.png", "result.json", "trace.jsonl",
                                    "journal",    "problem.yaml",  "run.json",    "start.vtp",
                                    "best.vtp",   "best.png",      "times.json",  "log.txt"};
/* Those that must be the same come first; of these, those that need not be there. */
enum { SOME = 2, SAME = 10, ALL = 12 };

static void read_problem(const trial *t, ves_problem **problem, ves_diag *diag)
{
    char path[512];
    snprintf(path, sizeof path, "%s/problems/%s.yaml", VESICA_SOURCE, t->name);
    ves_status status = t->text
                            ? ves_problem_read_text(t->name, t->text, strlen(t->text), NULL, problem, diag)
                            : ves_problem_read(path, NULL, problem, diag);
    cr_assert_eq(status, VES_OK, "%s: %s", t->name, ves_status_text(status));
}

/* One run, and what it wrote. */
static void run(const trial *t, int jobs, char *text[SAME], size_t length[SAME])
{
    char folder[512], path[600];
    ves_problem *problem;
    ves_run *r;
    ves_diag *diag = ves_diag_create();
    read_problem(t, &problem, diag);
    const char *slash = strrchr(t->name, '/');
    snprintf(folder, sizeof folder, "%s", path_of(slash ? slash + 1 : t->name));
    ves_run_options options = {.evaluations = t->evaluations, .jobs = jobs, .files = true, .out = folder};
    cr_assert_eq(ves_run_create(problem, &options, NULL, &r, diag), VES_OK, "%s", t->name);
    cr_assert_eq(r->jobs, jobs);
    cr_assert(r->any && r->evaluations > t->evaluations / 4, "%s: %ld evaluations", t->name, r->evaluations);
    cr_assert(r->refused >= t->proofs, "%s: %ld proofs refused", t->name, r->refused);
    for (int k = 0; k < ALL; k++) {
        snprintf(path, sizeof path, "%s/%s", folder, FILES[k]);
        bool there = access(path, F_OK) == 0;
        cr_assert(there || k < SOME, "%s is missing", path);
        if (k < SAME) text[k] = there ? slurp_bytes(path, &length[k]) : calloc(1, 1);
        if (k < SAME && !there) length[k] = 0;
        remove(path);
    }
    cr_assert_eq(rmdir(folder), 0, "something was left in %s", folder);
    ves_run_destroy(r);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

static void same(const trial *t)
{
    static const int jobs[] = {1, 1, 2};
    char *first[SAME], *again[SAME];
    size_t size[SAME], length[SAME];
    for (int k = 0; k < 3; k++) {
        run(t, jobs[k], k ? again : first, k ? length : size);
        for (int f = 0; k && f < SAME; f++) {
            bool equal = size[f] == length[f] && !memcmp(first[f], again[f], size[f]);
            cr_expect(equal, "%s: %s differs in run %d, with %d jobs", t->name, FILES[f], k, jobs[k]);
            free(again[f]);
        }
    }
    for (int f = 0; f < SAME; f++) free(first[f]);
}

static void check(const trial *t)
{
    same(t);
    clean();
    check_nothing_left();
}

Test(study_bytes, of_many_chains_and_a_long_polish)
{
    check(&(trial){"curvature-twist", NULL, 4000, 0});
}

Test(study_bytes, of_an_equation_that_is_solved)
{
    check(&(trial){"pot", NULL, 250, 0});
}

Test(study_bytes, of_an_equation_that_is_scaled)
{
    check(&(trial){"vesicle/book", NULL, 1500, 0});
}

Test(study_bytes, of_bests_that_their_proof_refuses)
{
    check(&(trial){"loop", LOOP, 800, 1});
}
