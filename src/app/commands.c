#include "app/app.h"

#define PROBLEM "set|start|plugin|json"

const app_command app_commands[] = {
    {"run", "run FILE", "search for the best shape; the result goes into a numbered folder under runs/", 1, 1,
     PROBLEM "|seed|evaluations|jobs|out|progress|trace|test|no-files", app_run},
    {"check", "check FILE", "read a problem file, measure its start design, say what a run will do", 1, 1,
     PROBLEM, app_check},
    {"eval", "eval FILE|RUN", "measure one design", 1, 1, PROBLEM, app_eval},
    {"sample", "sample FILE|RUN", "exact points and derivatives of one patch, as CSV", 1, 1,
     "set|start|plugin|patch|points|spine", app_sample},
    {"export", "export FILE|RUN", "write the shape for other programs", 1, 1,
     "set|start|plugin|to|unit|out|grid", app_export},
    {"show", "show FILE|RUN", "draw the shape", 1, 1, "set|start|plugin|png|colour|view|grid", app_show},
    {"new", "new [TEMPLATE [FILE]]",
     "write a commented problem file to begin with; alone: list the templates", 0, 2, "", app_new},
    {"list", "list measures|curves|moves|algorithms|formats|units|templates", "what problem files may use", 0,
     1, "plugin|json", app_list},
    {"schema", "schema", "the JSON Schema of problem files, for editors", 0, 0, "plugin|reference",
     app_schema},
    {"explain", "explain WORD",
     "what a word means: a key, measure, function, unit, format, or why a candidate failed", 1, 1, "plugin",
     app_explain},
    {"version", "version", "the version of vesica and of what it is built on", 0, 0, "json", app_version},
    {"help", "help [COMMAND]", "this text, or one on a command", 0, 1, "", app_help},
    {0},
};
