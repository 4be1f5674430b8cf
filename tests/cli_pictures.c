/* The pictures that runs and benchmarks leave in their folders. */
#include <criterion/criterion.h>

#include "program.h"

TestSuite(cli_pictures, .timeout = 300);

/* Of an annealing, and of several optima: the twisted tube has four. */
static const char tube[] = "run " PROBLEMS "curvature-twist.yaml --evaluations 12000";

static void same_bytes(const char *a, const char *b)
{
    char command[600];
    snprintf(command, sizeof command, "cmp '%s' '%s'", a, b);
    cr_expect(system(command) == 0, "%s and %s differ", a, b);
}

static void is_png(const char *path, unsigned width, unsigned height)
{
    unsigned char head[24] = {0};
    FILE *in = fopen(path, "rb");
    cr_assert(in && fread(head, 1, sizeof head, in) == sizeof head, "%s", path);
    fclose(in);
    cr_expect(memcmp(head, "\x89PNG\r\n\x1a\n", 8) == 0);
    unsigned w = (unsigned)(head[18] << 8 | head[19]), h = (unsigned)(head[22] << 8 | head[23]);
    cr_expect(w == width && h == height, "%s: %u x %u", path, w, h);
}

Test(cli_pictures, a_run_draws_its_optima_and_its_annealing)
{
    root_make();
    expect(vesica(NULL, "%s --out one --jobs 1", tube), 0, "best.png  optima.png  annealing.png  ", NULL,
           "one");
    expect(vesica(NULL, "%s --out two --jobs 2", tube), 0, "found", NULL, "two");
    is_png("one/optima.png", 760, 730);
    is_png("one/annealing.png", 960, 680);
    same_bytes("one/optima.png", "two/optima.png");
    same_bytes("one/annealing.png", "two/annealing.png");
    root_remove();
}

/* One optimum is in best.png; without a second temperature there is no curve, without an annealing none at all. */
Test(cli_pictures, nothing_is_drawn_of_what_there_is_not)
{
    root_make();
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --out auto"), 0, "best.png  start.vtp", NULL, "auto");
    cr_expect(access("auto/optima.png", F_OK) != 0 && access("auto/annealing.png", F_OK) != 0);
    char *text = slurp(PROBLEMS "bottle.yaml");
    *strstr(text, "search:") = 0;
    FILE *out = fopen("fixed.yaml", "w");
    fprintf(out, "%ssearch: [{anneal: {schedule: fixed, evaluations: 900}}]\n", text);
    fclose(out);
    free(text);
    outcome o = vesica(NULL, "run fixed.yaml --out fixed");
    cr_expect(strstr(o.out, "annealed") && strstr(o.out, "annealing.png") == NULL, "%s", o.out);
    cr_expect(access("fixed/annealing.png", F_OK) != 0);
    done(&o);
    root_remove();
}

/* What was left by a run that was interrupted, with several optima, goes when it ends with one. */
Test(cli_pictures, a_run_that_goes_on_leaves_no_picture_of_before)
{
    root_make();
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --out can"), 0, NULL, NULL, "can");
    cr_assert(remove("can/result.json") == 0);
    write_file("can/optima.png", "of before");
    write_file("can/.optima.png.vesica-77-0.png", "unfinished");
    static const char *const mine[] = {"can/.vesica-77-0.png",           "can/.a.77.png",
                                       "can/optima.png.vesica-77-0.png", "can/.a.vesica-7x-0.png",
                                       "can/.a.vesica--0.png",           "can/.notes.2026-11.txt"};
    for (size_t k = 0; k < sizeof mine / sizeof *mine; k++) write_file(mine[k], "of the user");
    expect(vesica(NULL, "run --resume can"), 0, "best.png  start.vtp", NULL, "resumed");
    cr_expect(access("can/optima.png", F_OK) != 0 && access("can/.optima.png.vesica-77-0.png", F_OK) != 0);
    for (size_t k = 0; k < sizeof mine / sizeof *mine; k++)
        cr_expect(access(mine[k], F_OK) == 0, "%s", mine[k]);
    root_remove();
}

Test(cli_pictures, what_cannot_be_written_is_told)
{
    static const char *const picture[] = {"optima.png", "annealing.png"};
    root_make();
    expect(vesica(NULL, "%s --out tube", tube), 0, NULL, NULL, "tube");
    for (int k = 0; k < 2; k++) {
        char path[64], message[128];
        snprintf(path, sizeof path, "tube/%s", picture[k]);
        snprintf(message, sizeof message, "cannot write \"%s\": Is a directory", path);
        cr_assert(remove("tube/result.json") == 0 && remove(path) == 0 && mkdir(path, 0777) == 0);
        expect(vesica(NULL, "run --resume tube"), 3, NULL, message, picture[k]);
        cr_assert(rmdir(path) == 0);
        cr_expect(access("tube/result.json", F_OK) == 0, "the others are written");
    }
    cr_assert(remove("tube/result.json") == 0);
    expect(vesica(NULL, "run --resume tube"), 0, NULL, NULL, "and at last all");
    is_png("tube/annealing.png", 960, 680);
    root_remove();
}

Test(cli_pictures, a_benchmark_draws_the_optima_of_problem_files)
{
    root_make();
    write_file("s.yaml",
               "vesica: 1\nsuite: tubes\nproblems: [{file: " PROBLEMS "curvature-twist.yaml, name: a tube}, "
               "{function: sphere, n: 2}]\nseeds: 3\nbudget: {per_dimension: 50}\n"
               "methods: {auto: {search: auto}, slsqp: {nlopt: LD_SLSQP}, values: {nlopt: LN_SBPLX}}\n");
    expect(vesica(NULL, "bench s.yaml --out one --jobs 1"), 0, "distinct ends of a tube", NULL, "one");
    expect(vesica(NULL, "bench s.yaml --out two --jobs 2"), 0, NULL, NULL, "two");
    same_bytes("one/optima/a-tube.png", "two/optima/a-tube.png");
    cr_expect(access("one/optima/sphere-2.png", F_OK) != 0, "a function has no shape");
    cr_assert(system("mv one/optima/a-tube.png first.png") == 0);
    write_file("one/optima/.a-tube.png.vesica-77-0.png", "unfinished");
    expect(vesica(NULL, "bench --resume one"), 0, NULL, NULL, "again");
    same_bytes("one/optima/a-tube.png", "first.png");
    cr_expect(access("one/optima/.a-tube.png.vesica-77-0.png", F_OK) != 0);
    cr_assert(system("rm -r one/optima && touch one/optima") == 0);
    expect(vesica(NULL, "bench --resume one"), 3, NULL, "one/optima", "a file is in the way");
    write_file("f.yaml", "vesica: 1\nsuite: functions\nproblems: [{function: sphere, n: 2}]\nseeds: 2\n"
                         "methods: {auto: {search: auto}}\n");
    expect(vesica(NULL, "bench f.yaml --out none"), 0, NULL, NULL, "functions");
    cr_expect(access("none/optima", F_OK) != 0);
    root_remove();
}

/* Their names differ only in what files' names do not hold. */
Test(cli_pictures, problems_do_not_share_a_picture)
{
    static const char *const folder[] = {"convergence", "optima"}, *const name[] = {"a-b", "a-b-3", "a-b-2"};
    root_make();
    write_file("s.yaml", "vesica: 1\nsuite: s\nproblems: [{file: " PROBLEMS "bottle.yaml, name: a b}, "
                         "{file: " PROBLEMS "curvature-twist.yaml, name: a-b}, "
                         "{file: " PROBLEMS "curvature.yaml, name: a-b-2}]\n"
                         "seeds: 1\nbudget: {per_dimension: 30}\nmethods: {auto: {search: auto}}\n");
    expect(vesica(NULL, "bench s.yaml --out one"), 0, "distinct ends of a-b-2", NULL, "three");
    for (int f = 0; f < 2; f++)
        for (int k = 0; k < 3; k++) {
            char path[64];
            snprintf(path, sizeof path, "one/%s/%s.png", folder[f], name[k]);
            cr_expect(access(path, F_OK) == 0, "%s", path);
        }
    cr_expect(system("cmp -s one/optima/a-b.png one/optima/a-b-3.png") != 0, "each has its own");
    root_remove();
}

/* A sheet of all would be taller than anybody can look at. */
Test(cli_pictures, of_many_annealings_the_first_and_the_last_are_drawn)
{
    static const struct {
        int annealings;
        unsigned height;
    } all[] = {{2, 2 * 680}, {6, 6 * 680}, {7, 6 * 680}, {12, 6 * 680}};
    root_make();
    char *text = slurp(PROBLEMS "bottle.yaml");
    *strstr(text, "search:") = 0;
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char path[64];
        FILE *out = fopen("many.yaml", "w");
        fprintf(out, "%ssearch: [", text);
        for (int j = 0; j < all[k].annealings; j++)
            fprintf(out, "%s{anneal: {evaluations: 400}}", j ? ", " : "");
        fputs("]\n", out);
        fclose(out);
        expect(vesica(NULL, "run many.yaml --out many%d", all[k].annealings), 0, "annealing.png", NULL,
               "many");
        snprintf(path, sizeof path, "many%d/annealing.png", all[k].annealings);
        is_png(path, 960, all[k].height);
    }
    free(text);
    root_remove();
}
