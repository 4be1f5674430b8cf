/* What a suite file may hold (vesica bench): tables as in schema.c. */
#include <math.h>

#include "problem/schema.h"
#include "suite/suite.h"

#define END                                                                                                  \
    {                                                                                                        \
        .key = {.name = NULL }                                                                               \
    }
#define KIND(kind) ((ves_kind)(kind))

/* clang-format off */

static const ves_entry count[] = {
    {{"number of variables", VES_COUNT, .min = 1, .max = VES_LANDSCAPE_MOST, .about = "how many variables the function has"}, "10", NULL},
    END};

static const ves_entry setting[] = {
    {{"setting", VES_TEXT, .about = "what --set would say: a variable's start, a parameter, or a key"}, "nu: 0.6", NULL},
    END};

static const ves_entry problem_keys[] = {
    {{"name", VES_TEXT, .about = "what it is called in results; unless given, the function's or the file's name"}, "name: tube", NULL},
    {{"function", VES_TEXT, .about = "a built-in function (vesica list functions): the optimum of run k lies at a random place in the box, the same for every method"}, "function: rastrigin", NULL},
    {{"n", KIND(VES_LIST), .about = "numbers of variables: a problem each; may be left out where a function has but one"}, "n: [5, 10, 20]", count},
    {{"rotate", VES_FLAG, .fallback = 0, .about = "the axes of the function are turned at random, for each run anew"}, "rotate: true", NULL},
    {{"file", VES_TEXT, .about = "a problem file, from the folder of the suite on; its own search is not used"}, "file: ../../problems/curvature.yaml", NULL},
    {{"set", KIND(VES_NAMED), .about = "changes of that file, as --set makes them"}, "set: {nu: 0.6}", setting},
    {{"plugin", VES_TEXT, .about = "a shared object with objectives in C (vesica/objective.h), from the folder of the suite on"}, "plugin: ./mine.so", NULL},
    {{"objective", VES_TEXT, .about = "which of the objectives in the plugin; the first unless given"}, "objective: tower", NULL},
    {{"optimum", VES_NUMBER, .unit = "1", .fallback = NAN, .about = "the least value, where it is known (of a problem file that maximizes, the greatest); of functions it is"}, "optimum: 12.16456", NULL},
    END};

static const ves_entry problem[] = {
    {{"problem", KIND(VES_MAP), .about = "one of function, file and plugin, and what belongs to it"}, "{function: rastrigin, n: [5, 10], rotate: true}", problem_keys},
    END};

static const ves_entry word[] = {
    {{"word", VES_TEXT, .about = "a word of a command line; one that begins with ./ or ../ is a path from the folder of the suite on"}, "python3", NULL},
    END};

static const ves_entry method_keys[] = {
    {{"search", KIND(VES_LIST), .words = "auto", .about = "stages of our own, as in problem files"}, "search: [{anneal: {chains: 1}}, {polish: {}}]", ves_schema_stage},
    {{"doubling", VES_FLAG, .fallback = 0, .about = "with search: runs of 1/15, 2/15, 4/15 and 8/15 of the budget, instead of one that is told all of it"}, "doubling: true", NULL},
    {{"nlopt", VES_TEXT, .about = "an algorithm of NLopt, by its name there; one that ends early begins again at a random point"}, "nlopt: GN_CRS2_LM", NULL},
    {{"local", VES_TEXT, .about = "with nlopt: the algorithm that MLSL and AUGLAG need inside"}, "local: LN_BOBYQA", NULL},
    {{"program", KIND(VES_LIST), .about = "the words of a command: a program that asks through JSON lines (docs/benchmark.md)"}, "program: [python3, ./mine.py]", word},
    {{"seconds", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = 1e6, .fallback = 60, .about = "with program: the longest wait for its next line; then it is said to hang"}, "seconds: 10", NULL},
    {{"gradients", VES_FLAG, .fallback = 1, .about = "it is given gradients where the problem has them"}, "gradients: false", NULL},
    END};

static const ves_entry method[] = {
    {{"method", KIND(VES_MAP), .about = "one of search, nlopt and program, and what belongs to it"}, "auto: {search: auto}", method_keys},
    END};

static const ves_entry budget_keys[] = {
    {{"per_dimension", VES_NUMBER, .unit = "1", .min = 1, .max = 1e12, .fallback = 1e4, .about = "cost units for each variable"}, "per_dimension: 1e4", NULL},
    {{"most", VES_NUMBER, .unit = "1", .min = 1, .max = 1e12, .fallback = 2e5, .about = "but no more than these"}, "most: 2e5", NULL},
    END};

static const ves_entry cost_keys[] = {
    {{"value", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = 1e6, .fallback = 1, .about = "of the value with all constraints"}, "value: 1", NULL},
    {{"gradient", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = 1e6, .fallback = 3, .about = "of these with their gradients"}, "gradient: 3", NULL},
    END};

static const ves_entry feasible_keys[] = {
    {{"inequality", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = HUGE_VAL, .fallback = 1e-6, .about = "of a constraint <= 0, divided by its size"}, "inequality: 1e-6", NULL},
    {{"equality", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = HUGE_VAL, .fallback = 1e-6, .about = "of a constraint == 0, divided by its size"}, "equality: 1e-6", NULL},
    END};

static const ves_entry root[] = {
    {{"vesica", VES_COUNT, .required = true, .about = "version of the format: 1"}, "vesica: 1", NULL},
    {{"suite", VES_TEXT, .required = true, .about = "one line for people; it tells that the file is a suite for vesica bench"}, "suite: Classic functions, moved and turned", NULL},
    {{"problems", KIND(VES_LIST), .required = true, .max = HUGE_VAL, .about = "what is to be minimised"}, "problems: [{function: rastrigin, n: [5, 10]}]", problem},
    {{"methods", KIND(VES_NAMED), .required = true, .about = "by what"}, "methods: {auto: {search: auto}, isres: {nlopt: GN_ISRES}}", method},
    {{"seeds", VES_COUNT, .min = 1, .max = 1000, .fallback = 15, .about = "how often: runs of each method on each problem"}, "seeds: 15", NULL},
    {{"seed", KIND(VES_SEED), .fallback = 1, .about = "what all random numbers come from"}, "seed: 1", NULL},
    {{"budget", KIND(VES_MAP), .about = "what a run may cost"}, "budget: {per_dimension: 1e4, most: 2e5}", budget_keys},
    {{"cost", KIND(VES_MAP), .about = "what an evaluation costs"}, "cost: {value: 1, gradient: 3}", cost_keys},
    {{"targets", VES_NUMBERS, .about = "three gaps, falling, [1e-1, 1e-3, 1e-6] unless given: a target is met by a feasible value up to the optimum + gap * max(1, |optimum|), of a problem file gap * |optimum|; a run ends at the last, where the optimum is known"}, "targets: [1e-1, 1e-3, 1e-6]", NULL},
    {{"feasible", KIND(VES_MAP), .about = "what functions and plugins may violate; a problem file says it for itself"}, "feasible: {inequality: 1e-6, equality: 1e-6}", feasible_keys},
    END};

const ves_entry ves_schema_suite = {{"suite", KIND(VES_MAP), .about = "a suite file"}, NULL, root};
