#include "app/app.h"

#define PROBLEM "set|start|plugin|json"

const app_command app_commands[] = {
    {"run", "run FILE", "search for the best shape; the result goes into a numbered folder under runs/", 0, 1,
     PROBLEM "|seed|evaluations|jobs|out|progress|trace|journal|resume|test|no-files", app_run,
     "A run that was stopped by Ctrl-C, or killed, goes on with `vesica run --resume RUN` and ends with the "
     "same\n"
     "result as one that never was. All it needs is in its folder."},
    {"bench", "bench SUITE | bench --resume DIR",
     "compare searches on the problems of a suite file; all runs go into a numbered folder under runs/", 0, 1,
     "set|resume|add|jobs|out|progress|no-files|json", app_bench,
     "bench/suites/ has suites to begin with; docs/benchmark.md tells what is printed, and how a program of "
     "your "
     "own\n"
     "takes part. Exit code: 0 when all runs are done, 130 when interrupted: --resume goes on."},
    {"sweep", "sweep FILE | sweep --resume DIR",
     "search for the best shape at each value of a parameter, from neighbour to neighbour; into a numbered "
     "folder",
     0, 1, PROBLEM "|over|seed|jobs|out|progress|resume", app_sweep,
     "What is swept over stands under `sweep` in the file (vesica explain sweep), or in --over; "
     "docs/sweep.md tells "
     "what is\n"
     "written. Exit code: 0 when every value has a good point (feasible, checked, converged), 1 when one has "
     "none; 130\n"
     "when interrupted: --resume goes on, as after a kill, and ends with the same bytes."},
    {"check", "check FILE", "read a problem file, measure its start design, say what a run will do", 1, 1,
     PROBLEM, app_check,
     "Exit code: 0 when the file is in order and its start design can be measured and passes its checks; 1 "
     "when\n"
     "it does not; 2 when the file is wrong. A start that violates a constraint is in order: a search begins "
     "there."},
    {"eval", "eval FILE|RUN", "measure one design", 1, 1, PROBLEM, app_eval,
     "feasible: the constraints hold. Whether the surface crosses itself and a finer grid agrees is looked "
     "at by\n"
     "`vesica check`, and by a run for its bests."},
    {"stability", "stability FILE|RUN",
     "is the shape a minimum among all shapes near it? Which way is it softest?", 1, 1,
     PROBLEM "|modes|functions|follow|no-files|png", app_stability,
     "Closed surfaces of revolution. docs/stability.md tells what the eigenvalues are. Exit code: 0 when "
     "none is "
     "negative\n"
     "beyond its error, 1 when one is or nobody can tell. --png draws the meridian and the lowest mode of "
     "each n."},
    {"journal", "journal RUN", "all evaluations of a run, one a line", 1, 1, "to|png", app_journal,
     "In SI units, as in result.json, with the sign of the goal. A constraint's column says by how much it "
     "is missed,\n"
     "relative to its size: 0 or less is met. T: temperature; stage and chain as in trace.jsonl.\n"
     "--png draws how the run came to its best: the best feasible value and what was accepted, over the "
     "evaluations."},
    {"sample", "sample FILE|RUN", "exact points and derivatives of one patch, as CSV", 1, 1,
     "set|start|plugin|patch|points|spine", app_sample,
     "u runs from 0 to 1 along the patch and v from 0 to 2 pi round it, also where a `domain` gives the "
     "formulas\n"
     "of a sheet other ranges; derivatives are by these u and v."},
    {"export", "export FILE|RUN", "write the shape for other programs", 1, 1,
     "set|start|plugin|to|unit|out|grid|spines|buckling", app_export, NULL},
    {"show", "show FILE|RUN", "draw the shape", 1, 1, "set|start|plugin|png|colour|view|grid|spines",
     app_show, NULL},
    {"new", "new [TEMPLATE [FILE]]",
     "write a commented problem file to begin with; alone: list the templates", 0, 2, "", app_new, NULL},
    {"list", "list THINGS",
     "what problem files and suites may use: measures, curves ...; alone: which things", 0, 1, "plugin|json",
     app_list, NULL},
    {"schema", "schema", "the JSON Schema of problem files, for editors", 0, 0, "plugin|reference|suite",
     app_schema, NULL},
    {"explain", "explain WORD",
     "what a word means: a key, measure, function, unit, format, or why a candidate failed", 1, 1, "plugin",
     app_explain, NULL},
    {"version", "version", "the version of vesica and of what it is built on", 0, 0, "json", app_version,
     NULL},
    {"help", "help [COMMAND]", "this text, or one on a command", 0, 1, "", app_help, NULL},
    {0},
};
