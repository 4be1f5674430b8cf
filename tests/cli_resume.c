/* Runs that are killed, stopped, resumed and read, as a user meets them. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

#define CURVATURE PROBLEMS "curvature.yaml --evaluations 200000 --progress none"

static void same_bytes_of(const char *a, const char *b, const char *name)
{
    char command[500];
    snprintf(command, sizeof command, "cmp %s/%s %s/%s", a, name, b, name);
    cr_assert(system(command) == 0, "%s differs", name);
}

static void same_run(const char *a, const char *b)
{
    static const char *const names[] = {"result.json", "trace.jsonl", "journal", "run.json", "best.vtp"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) same_bytes_of(a, b, names[k]);
}

/* Starts a run, and sends it the signal when some of its journal is on the disk. */
static int end_by(int signal_number, const char *folder)
{
    char words[300], path[100];
    struct stat there;
    snprintf(words, sizeof words, "run " CURVATURE " --out %s", folder);
    snprintf(path, sizeof path, "%s/journal", folder);
    pid_t child = launch(words, NULL, "stdout");
    wait_for_file(path);
    for (int k = 0; k < 3000 && stat(path, &there) == 0 && there.st_size < 1000000; k++)
        nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
    kill(child, signal_number);
    return wait_for(child);
}

Test(cli_resume, killed_or_stopped_a_run_goes_on_to_the_same_end)
{
    root_make();
    expect(vesica(NULL, "run " CURVATURE " --out whole"), 0, "bending", NULL, "whole");
    cr_assert(eq(int, end_by(SIGKILL, "killed"), -SIGKILL));
    cr_expect(access("killed/result.json", F_OK) != 0, "it was done before it was killed");
    expect(vesica(NULL, "run --resume killed --jobs 1"), 0, "bending", "goes on after", "killed");
    same_run("whole", "killed");
    cr_assert(eq(int, end_by(SIGTERM, "stopped"), 130));
    char *err = slurp("stderr");
    cr_expect(strstr(err, "to go on: vesica run --resume stopped\n") != NULL, "%s", err);
    free(err);
    expect(vesica(NULL, "run --resume stopped/ --progress plain"), 0, "bending", "goes on after", "stopped");
    same_run("whole", "stopped");
    expect(vesica(NULL, "run --resume whole"), 0, "bending", "this run is done, nothing was asked again",
           "whole");
    outcome o = vesica(NULL, "run --resume stopped --json");
    json j = json_of(o.out);
    cr_expect(o.code == 0 && number(&j, "objective", NULL) < 12.2);
    json_done(&j);
    done(&o);
    root_remove();
}

Test(cli_resume, two_processes_do_not_work_in_one_folder)
{
    root_make();
    pid_t child = launch("run " PROBLEMS "curvature.yaml --evaluations 900000000 --out long", NULL, "stdout");
    wait_for_file("long/journal");
    char want[60];
    snprintf(want, sizeof want, "process %ld works in \"long\"", (long)child);
    expect(vesica(NULL, "run --resume long"), 2, NULL, want, "at the same time");
    expect(vesica(NULL, "journal long"), 0, "evaluation,stage,chain,d1Tx", NULL, "reading meanwhile");
    kill(child, SIGKILL);
    wait_for(child);
    root_remove();
}

Test(cli_resume, what_cannot_go_on_says_what_to_do)
{
    root_make();
    cr_assert(mkdir("empty", 0777) == 0);
    expect(vesica(NULL, "run --resume empty"), 2, NULL, "\"empty/run.json\" cannot be read", "empty");
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --evaluations 300 --journal none --out none"), 0,
           "volume", NULL, "none");
    cr_expect(access("none/journal", F_OK) != 0);
    expect(vesica(NULL, "run --resume none"), 2, NULL, "keeps no journal (--journal none)", "none");
    expect(vesica(NULL, "journal none"), 2, NULL,
           "the run \"none\" has no journal: it was made with --journal none", "none");
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --evaluations 300 --out all"), 0, "volume", NULL, "all");
    write_file("all/result.json", "{");
    write_file("all/journal", "something else");
    expect(vesica(NULL, "run --resume all"), 2, NULL, "is no journal, or its beginning is damaged",
           "no journal");
    write_file("all/run.json", "{\"seed\": 1}");
    expect(vesica(NULL, "run --resume all"), 2, NULL,
           "\"all/run.json\" is damaged: run \"all/problem.yaml\" anew", "run.json");
    root_remove();
}

Test(cli_resume, a_journal_can_be_read)
{
    root_make();
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --evaluations 300 --out run"), 0, "volume", NULL, "run");
    outcome o = vesica(NULL, "journal run");
    cr_assert(eq(int, o.code, 0));
    static const char head[] =
        "evaluation,stage,chain,r,h,value,violation,area == 3*pi,T,accepted,status,asked\n";
    cr_expect(strncmp(o.out, head, strlen(head)) == 0, "%.200s", o.out);
    cr_expect(strstr(o.out, "\n1,0,0,0.5,1,0.7853981633974") != NULL, "%.300s", o.out);
    cr_expect(strstr(o.out, ",OK,proof\n") && strstr(o.out, ",OK,gradient\n") &&
              strstr(o.out, ",OK,value\n"));
    long lines = -1;
    for (const char *at = o.out; *at; at++) lines += *at == '\n';
    done(&o);
    o = vesica(NULL, "journal run --to jsonl");
    for (char *rest, *line = strtok_r(o.out, "\n", &rest); line;
         line = strtok_r(NULL, "\n", &rest), lines--) {
        if (lines % 50) continue;
        json j = json_of(line);
        cr_expect(number(&j, "x", "r") >= 0.2 && number(&j, "stage", NULL) >= 0);
        json_done(&j);
    }
    cr_expect(eq(long, lines, 0));
    done(&o);
    root_remove();
}

/* Drawn, of a run with more candidates than the picture has room for, too; where nothing is feasible it is told. */
Test(cli_resume, a_journal_can_be_drawn)
{
    root_make();
    expect(vesica(NULL, "run " PROBLEMS "curvature.yaml --evaluations 20000 --out run"), 0, NULL, NULL,
           "run");
    outcome o = vesica(NULL, "journal run --png run.svg");
    cr_expect(o.code == 0 && strcmp(o.out, "run.svg\n") == 0, "%d: %s", o.code, o.out);
    done(&o);
    char *picture = slurp("run.svg");
    cr_expect(strncmp(picture, "<?xml", 5) == 0 && strstr(picture, "</svg>"));
    free(picture);
    expect(vesica(NULL, "journal run --png run.vtp"), 2, NULL, "ends in .png, .svg or .pdf", "ending");
    expect(vesica(NULL, "run " PROBLEMS
                        "bottle.yaml --evaluations 60 --set constraints=[volume<=0.01,area>=20] --out none"),
           1, NULL, NULL, "nothing is feasible");
    expect(vesica(NULL, "journal none --png none.png"), 2, NULL, "no feasible candidate", "nothing to draw");
    cr_expect(access("none.png", F_OK) != 0);
    root_remove();
}

static void build_plugin(const char *name, const char *defines)
{
    char command[1200];
    snprintf(command, sizeof command,
             "cc -std=c17 -shared -fPIC %s -I" VESICA_SOURCE "/include -o %s " VESICA_SOURCE
             "/examples/plugin/sphericity.c -lm",
             defines, name);
    cr_assert(system(command) == 0, "%s", command);
}

Test(cli_resume, a_resumed_run_takes_its_plugins_again)
{
    root_make();
    build_plugin("good.so", "");
    expect(vesica(NULL, "run " PROBLEMS
                        "bottle.yaml --set maximize=sphericity --plugin good.so --evaluations 300 --out run"),
           0, "sphericity", NULL, "run");
    cr_assert(
        system("cp -r run part && truncate -s 9000 part/journal && rm part/result.json && mkdir else") == 0);
    cr_assert(chdir("else") == 0);
    hush();
    expect(vesica(NULL, "run --resume ../part"), 0, "sphericity", "goes on after", "from elsewhere");
    cr_assert(chdir("..") == 0);
    same_run("run", "part");
    build_plugin("good.so", "-Dunused=1 -g");
    expect(vesica(NULL, "run --resume part"), 2, NULL, "is not the one that the run \"part\" was made with",
           "another make");
    remove("good.so");
    expect(vesica(NULL, "run --resume part"), 2, NULL, "cannot load the plugin", "none");
    root_remove();
}

/* This build has no MPI (tests/slow/ranks.sh builds one that has): one of the processes says so. */
Test(cli_resume, mpirun_is_recognised)
{
    root_make();
    setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
    setenv("OMPI_COMM_WORLD_RANK", "0", 1);
    expect(vesica(NULL, "run " PROBLEMS "bottle.yaml --no-files"), 2, NULL,
           "one of 2 processes that mpirun has started, but this build of vesica has no MPI", "rank 0");
    expect(vesica(NULL, "sweep " PROBLEMS "bottle.yaml"), 2, NULL, "this build of vesica has no MPI",
           "sweep");
    setenv("OMPI_COMM_WORLD_RANK", "1", 1);
    outcome o = vesica(NULL, "run " PROBLEMS "bottle.yaml --no-files");
    cr_expect(o.code == 2 && strlen(o.out) == 0 && strlen(o.err) == 0, "%s%s", o.out, o.err);
    done(&o);
    root_remove();
}

/* What only one process may do is not done by each of them: rank 0 says so, the others are silent. */
Test(cli_resume, only_what_can_be_shared_is_by_the_processes_of_mpirun)
{
    static const char *const words[] = {"check " PROBLEMS "bottle.yaml", "eval " PROBLEMS "bottle.yaml",
                                        "export " PROBLEMS "bottle.yaml --to stl --out b.stl",
                                        "new tube tube.yaml", "journal none"};
    root_make();
    setenv("OMPI_COMM_WORLD_SIZE", "3", 1);
    for (size_t k = 0; k < sizeof words / sizeof *words; k++)
        for (int rank = 0; rank < 2; rank++) {
            setenv("OMPI_COMM_WORLD_RANK", rank ? "1" : "0", 1);
            outcome o = vesica(NULL, "%s", words[k]);
            cr_expect(o.code == 2 && !*o.out, "%s: %d, %s", words[k], o.code, o.out);
            bool told =
                strstr(o.err, "this is one of 3 processes that mpirun has started, and they cannot share");
            cr_expect(rank ? !*o.err : told, "%s: %s", words[k], o.err);
            done(&o);
        }
    cr_expect(access("b.stl", F_OK) && access("tube.yaml", F_OK) && access("runs", F_OK),
              "something was written");
    expect(vesica(NULL, "version"), 0, "vesica", NULL, "what writes nothing may be asked");
    setenv("OMPI_COMM_WORLD_RANK", "0", 1);
    outcome o = vesica(NULL, "bench " PROBLEMS "../bench/suites/elastica.yaml");
    cr_expect(strstr(o.err, "cannot share") == NULL, "a benchmark is shared: %s", o.err);
    done(&o);
    root_remove();
}
