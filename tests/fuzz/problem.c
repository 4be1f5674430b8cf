/* Fuzz target of the readers: whatever the bytes, the answer is a problem or messages. Most inputs are
 * problem files, with --set before them or not; some are formulas, lists of points, tables of measures
 * (parts.h).
 *
 * By itself a mutating fuzzer that repeats to the byte: fuzz_problem [SECONDS [SEED]]; seeds are the shipped
 * and the broken problem files. With clang -fsanitize=fuzzer -DVESICA_LIBFUZZER the same target serves
 * libFuzzer. On a finding the sanitizer stops; the input is in VESICA_BUILD/fuzz_problem.input. */
#include <dirent.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/order.h"
#include "base/random.h"
#include "fuzz/parts.h"
#include "problem/problem.h"

static void check_args(const ves_problem *p, const ves_args *args)
{
    for (int k = 0; k < args->count; k++) {
        const ves_arg *arg = &args->arg[k];
        bool numbers = args->key[k].kind >= VES_NUMBER && args->key[k].kind <= VES_TERMS && arg->count;
        if (numbers)
            require(arg->first >= p->slots && arg->first + arg->count <= p->block,
                    "numbers outside the block");
        bool curves = (args->key[k].kind == VES_CURVE || args->key[k].kind == VES_TERMS) && arg->given;
        for (int i = 0; curves && i < arg->count; i++)
            require(arg->ref[i] >= 0 && arg->ref[i] < p->curves, "a curve that is none");
    }
}

static void check_condition(const ves_problem *p, const ves_condition *c, int order)
{
    require(c->u >= 0 && c->u <= 1 && c->derivative >= 0 && c->derivative < order, "a condition nowhere");
    require(c->scale == -1 || (c->scale >= p->slots && c->scale < p->block), "a scale outside the block");
    for (int s = 0; s < c->shares; s++)
        require(c->share[s].curve >= 0 && c->share[s].curve < p->curves && c->share[s].factor != 0,
                "a share");
}

static void check_spine(const ves_problem *p, const ves_patch_def *patch)
{
    if (patch->spine == VES_SPINE_NONE) return;
    int own = 2 * (patch->lower ? patch->lower : patch->power), ends = 0;
    require(patch->spine_vectors >= 1 && patch->spine_first >= p->slots &&
                patch->spine_first + 3 * patch->spine_vectors <= p->block,
            "a spine outside the block");
    require(patch->spine != VES_SPINE_BY_HERMITE || patch->spine_vectors == 2, "a Hermite spine");
    for (int i = 0; i < own; i++)
        ends +=
            patch->condition[i].derivative == 0 && (patch->condition[i].u == 0 || patch->condition[i].u == 1);
    require(ends == 2, "a spine without ends");
}

static void check_pde(const ves_problem *p, const ves_patch_def *patch)
{
    int numbers = patch->general ? patch->power + 1 : 1;
    require(patch->power >= 1 && patch->power <= (patch->general ? VES_GENERAL_MAX : VES_POWER_MAX),
            "a power");
    require(patch->operators == 1 || (patch->general && patch->operators == 3), "operators");
    for (int k = 0; k < patch->operators; k++)
        require(patch->parameter[k] >= p->slots && patch->parameter[k] + numbers <= p->block,
                "an operator outside the block");
    require(patch->conditions == 2 * patch->power, "conditions");
    for (int i = 0; i < patch->conditions; i++) check_condition(p, &patch->condition[i], patch->conditions);
    require(patch->lower >= 0 && patch->lower < patch->power && !(patch->lower && patch->general),
            "a lower order");
    require(patch->omega == -1 || (!patch->general && patch->omega >= p->slots && patch->omega < p->block),
            "an omega outside the block");
    require(patch->modes >= 0, "modes");
    check_spine(p, patch);
}

/* What the plan takes for granted. */
static void check_problem(const ves_problem *p)
{
    require(p->block == p->slots + p->numbers && p->slots == p->variables + p->unknowns + p->parameters,
            "sizes of the block");
    for (int k = 0; k < p->numbers; k++) require(p->number[k] != NULL, "a number without a formula");
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        require(v->min < v->max && v->start >= v->min && v->start <= v->max, "a start outside its range");
    }
    for (int k = 0; k < p->curves; k++) {
        require(p->curve[k].steps > 0 && !p->curve[k].step[0].op->move, "a curve without a source");
        for (int i = 0; i < p->curve[k].inputs; i++)
            require(p->curve[k].input[i] >= 0 && p->curve[k].input[i] < k, "an input that comes later");
        const ves_args *source = &p->curve[k].step[0].args;
        bool formula = source->count && source->key[0].kind == VES_FORMULAS;
        for (int i = 0; formula && i < 3; i++)
            require(source->arg[0].formula[i] != NULL, "a curve without a formula");
        for (int i = 0; formula && i < 3; i++) /* of v, and of the number of its family */
            require(!ves_formula_uses_argument(source->arg[0].formula[i], source->count),
                    "a section without its number");
        for (int i = 0; i < p->curve[k].steps; i++) check_args(p, &p->curve[k].step[i].args);
    }
    for (int k = 0; k < p->patches; k++) {
        const ves_patch_def *patch = &p->patch[k];
        bool formula = patch->kind == VES_PATCH_FORMULA;
        if (patch->kind == VES_PATCH_PDE) check_pde(p, patch);
        for (int i = 0; formula && i < 3; i++)
            require(patch->formula[i] != NULL, "a surface without a formula");
    }
    for (int k = 0; k < p->measures; k++) check_args(p, &p->measure[k].args);
    for (int k = 0; k < p->constraints; k++)
        require(p->constraint[k].left && p->constraint[k].right, "a constraint without a side");
    for (int k = 0; k < p->expects; k++) require(p->expect[k].formula != NULL, "a check without a formula");
}

static void read_once(const char *text, size_t length, const ves_read_options *options)
{
    ves_problem *problem = NULL;
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_problem_read_text("fuzz", text, length, options, &problem, diag);
    require((status == VES_OK) == (problem != NULL), "status and problem disagree");
    require(status <= 0, "a reader's failure is never a candidate's");
    require(status == VES_OK || status == VES_MEMORY || ves_diag_errors(diag) > 0,
            "a failure without a message");
    char message[4000];
    for (int k = 0; k < ves_diag_count(diag); k++) ves_diag_text(diag, k, message, sizeof message);
    if (problem) check_problem(problem);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

enum { OVERRIDES = 3, WIDTH = 256 };

/* Lines "--set NAME=VALUE" before the file are taken off and applied, three at most. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char name[OVERRIDES][WIDTH], value[OVERRIDES][WIDTH];
    const char *text = (const char *)data;
    ves_override override[OVERRIDES];
    ves_read_options options = {.override = override};
    if (fuzz_part(text, size)) return 0;
    for (int k = 0; k < OVERRIDES && size > 6 && !memcmp(text, "--set ", 6); k++) {
        size_t line = 0;
        while (line < size && text[line] != '\n') line++;
        if (line == size || line >= WIDTH) break;
        snprintf(name[k], WIDTH, "%.*s", (int)(line - 6), text + 6);
        char *equal = strchr(name[k], '=');
        snprintf(value[k], WIDTH, "%s", equal ? equal + 1 : "");
        if (equal) *equal = 0;
        override[k] = (ves_override){name[k], value[k]};
        options.overrides = k + 1;
        text += line + 1;
        size -= line + 1;
    }
    char *copy = malloc(size + 1); /* of the exact size, so that reading past it shows */
    memcpy(copy, text, size);
    read_once(copy, size, &options);
    free(copy);
    return 0;
}

#ifndef VESICA_LIBFUZZER

enum { SEEDS = 600, LARGEST = 1 << 16 };

typedef struct input {
    char *text;
    size_t length;
} input;

static const char *const dictionary[] = {
    "vesica: 1\n",
    "title: ",
    "parameters: {",
    "variables: {",
    "vary: {",
    "start: {",
    "curves:\n  ",
    "patches:\n  ",
    "places: {",
    "shape: {",
    "scale: {equation: ",
    "solve: {unknown: h, in: [0, 1], equation: ",
    "measures: {",
    "minimize: ",
    "maximize: ",
    "constraints: [",
    "validity: {",
    "quadrature: ",
    "search: [",
    "seed: ",
    "expect: [",
    "test: {",
    "circle: ",
    "point: ",
    "ellipse: ",
    "fourier: ",
    "bspline: ",
    "points: ",
    "formula: ",
    "like: ",
    "combine: ",
    "family: w, ",
    "sections: {of: sec, w: [0, 1], count: 4}",
    "sections: {curves: [p1, p2]}",
    "nodes: ",
    "joins: [",
    "{ends: [wall.u0, wall.u1], tangent: p1, scale: [1, 2], bend: p2}",
    "apply: [",
    "{translate: ",
    "{rotate: ",
    "{dilate: ",
    "{ridge: ",
    "{shift: ",
    "{bump: ",
    "operator: ",
    "conditions: [",
    "power: ",
    "coefficients: [",
    "differences: [",
    "remainder: {",
    "omega: ",
    "raise: [",
    "spine: {",
    "hermite: ",
    "u: 0.5, ",
    "a: ",
    "u: ",
    "derivative: ",
    "position: ",
    "field: ",
    "from: ",
    "to: ",
    "scale: ",
    "surface: ",
    "periodic: ",
    "domain: ",
    "modes: ",
    "closed: true",
    "caps: [",
    "p1",
    "p2",
    "d1",
    "wall",
    "wall.u0",
    "area",
    "bending",
    "volume",
    "distance",
    "integral: {of: ",
    "over: ",
    "require: ",
    "within: ",
    "jacobian: ",
    "least_radius: ",
    "monotone: ",
    "{anneal: ",
    "{polish: ",
    "auto",
    "evaluations",
    "feasible",
    "violation",
    "T",
    "[T, R, D]",
    " <= ",
    " >= ",
    " == ",
    " = ",
    "&x ",
    "*x",
    "<<: *x",
    "!!str ",
    "%YAML 1.1\n",
    "---\n",
    "...\n",
    "? ",
    "| \n",
    ">-\n",
    "\t",
    "\r\n",
    "\xEF\xBB\xBF",
    "\xC2\x85",
    "\xE2\x80\xA8",
    "\0",
    "\xFF",
    "\"",
    "'",
    "\\",
    "#",
    ": ",
    ", ",
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    "[[",
    "]]",
    "- ",
    "-",
    "1",
    "0",
    "-1",
    "1e400",
    "1e-400",
    "0x10",
    "1_000",
    "1:30",
    "1,5",
    "nan",
    ".inf",
    "yes",
    "no",
    "null",
    "~",
    "2 mm",
    "15 N/m",
    "10 deg",
    "30 %",
    "1 m^2",
    "pi",
    "v",
    "x",
    "H",
    "sin(",
    "max(1, 2)",
    "if(",
    "--set a=",
    "--set patches.wall.operator.a=",
    "--set seed=1\n",
    "--set d1Tx=0.5\n",
    "99999999999999999999",
    "a^b^c^d",
    "((((((((((((((((",
};
enum { WORDS = sizeof dictionary / sizeof *dictionary };

static void add_seeds(const char *folder, input *seed, int *count)
{
    DIR *dir = opendir(folder);
    if (!dir) return;
    for (struct dirent *e; (e = readdir(dir)) && *count < SEEDS;) {
        char path[1200];
        size_t length = strlen(e->d_name);
        if (length < 5 || strcmp(e->d_name + length - 5, ".yaml")) continue;
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        FILE *in = fopen(path, "rb");
        if (!in) continue;
        input *s = &seed[(*count)++];
        s->text = malloc(LARGEST);
        s->length = fread(s->text, 1, LARGEST / 2, in);
        fclose(in);
    }
    closedir(dir);
}

/* Inputs of the other kinds: every third seed. */
static void add_parts(input *seed, int *count)
{
    static const struct {
        const char *text;
        size_t length;
    } part[] = {
#define PART(text) {text, sizeof text - 1}
        PART("--formula\n2 mm + a*sin(30 deg)^2"),
        PART("--formula\nif(a < 2 m and not b > 1, min(a, 3 m, abs(b)), hypot(1, 2, rim.r))"),
        PART("--formula\nkg/(m s^2)"),
        PART("--formula\n-2^-0.5^u + mod(7, -3)*atan2(b, 1e-300) <= area"),
        PART("--points\nu,v\n0.25, 1\n1,-2e3\n"),
        PART("--points\n\xEF\xBB\xBFU,V\r\n0,6.28\r\n"),
        PART("--"
             "plugin\n\x48\x02\x0e\x80\x80\x00\x02\x01\x00\x06\x00\x06\x02\x08\x0e\x14\x09\x00\x06\x00\x06"
             "\x02"),
        PART("--plugin\n\x20\x01\x80\x07\x01\x0b\x00\x00\x00\x00\x00\x00\x0e"),
#undef PART
    };
    int rounds = *count / 3 / (int)(sizeof part / sizeof *part);
    for (int k = 0; k < rounds; k++)
        for (size_t i = 0; i < sizeof part / sizeof *part && *count < SEEDS; i++) {
            input *s = &seed[(*count)++];
            s->text = malloc(LARGEST);
            memcpy(s->text, part[i].text, s->length = part[i].length);
        }
}

/* Folders are read in any order; the run must not depend on it. */
static int by_text(const void *a, const void *b)
{
    const input *x = a, *y = b;
    size_t shorter = x->length < y->length ? x->length : y->length;
    int order = memcmp(x->text, y->text, shorter);
    return order ? order : (x->length > y->length) - (x->length < y->length);
}

static void replace(input *i, size_t at, size_t gone, const char *text, size_t length)
{
    if (at > i->length) at = i->length;
    if (gone > i->length - at) gone = i->length - at;
    if (i->length - gone + length >= LARGEST) return;
    memmove(i->text + at + length, i->text + at + gone, i->length - at - gone);
    memcpy(i->text + at, text, length);
    i->length += length - gone;
}

/* The word of YAML around a place: up to blanks and brackets. */
static size_t word_at(const input *i, size_t at, size_t *length)
{
    size_t begin = at, end = at;
    while (begin > 0 && !strchr(" ,[]{}\n:", i->text[begin - 1])) begin--;
    while (end < i->length && i->text[end] && !strchr(" ,[]{}\n:", i->text[end])) end++;
    *length = end - begin;
    return begin;
}

static void mutate(input *i, const input *seed, int seeds, ves_random *r)
{
    size_t at = (size_t)(ves_random_uniform(r) * (double)(i->length + 1)), length;
    const char *word = dictionary[ves_random_below(r, WORDS)];
    const input *other = &seed[ves_random_below(r, seeds)];
    size_t from = (size_t)(ves_random_uniform(r) * (double)other->length),
           some = (size_t)ves_random_below(r, 60);
    if (some > other->length - from) some = other->length - from;
    char byte = (char)ves_random_below(r, 256);
    switch (ves_random_below(r, 8)) {
    case 0:
        replace(i, at, 1, &byte, 1);
        break;
    case 1:
        replace(i, at, 0, word, *word ? strlen(word) : 1);
        break;
    case 2:
        replace(i, at, (size_t)ves_random_below(r, 20), "", 0);
        break;
    case 3:
        replace(i, at, 0, other->text + from, some);
        break;
    case 4:
    case 5:
        at = word_at(i, at, &length);
        replace(i, at, length, word, strlen(word));
        break;
    case 6: {
        size_t begin;
        from = word_at(other, from, &begin);
        at = word_at(i, at, &length);
        replace(i, at, length, other->text + from, begin);
        break;
    }
    default: { /* a line of another file */
        while (from > 0 && other->text[from - 1] != '\n') from--;
        size_t end = from;
        while (end < other->length && other->text[end] != '\n') end++;
        while (at > 0 && i->text[at - 1] != '\n') at--;
        replace(i, at, 0, other->text + from, end < other->length ? end + 1 - from : end - from);
    }
    }
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The file stays open: closing one that was cut short waits for the disk, and took most of the time. */
static void remember(int file, const input *i)
{
    if (pwrite(file, i->text, i->length, 0) != (ssize_t)i->length || ftruncate(file, (off_t)i->length))
        perror("fuzz: the input is not kept");
}

static int replay(const char *path)
{
    static uint8_t data[LARGEST];
    FILE *in = fopen(path, "rb");
    if (!in) return 2;
    size_t length = fread(data, 1, sizeof data, in);
    fclose(in);
    return LLVMFuzzerTestOneInput(data, length);
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], "--replay")) return replay(argv[2]);
    double seconds = argc > 1 ? atof(argv[1]) : 60, begin = now(), slowest = 0;
    uint64_t number = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    static input seed[SEEDS];
    int seeds = 0;
    add_seeds(VESICA_SOURCE "/problems", seed, &seeds);
    add_seeds(VESICA_SOURCE "/problems/surfaces", seed, &seeds);
    add_seeds(VESICA_SOURCE "/tests/broken", seed, &seeds);
    require(seeds > 40, "no seeds found");
    qsort(seed, (size_t)seeds, sizeof *seed, by_text);
    add_parts(seed, &seeds);
    long runs = 0;
    input i = {malloc(LARGEST), 0};
    int file = open(VESICA_BUILD "/fuzz_problem.input", O_RDWR | O_CREAT | O_TRUNC, 0666);
    require(file >= 0, "no place for the input");
    for (; now() - begin < seconds; runs++) {
        ves_random random = {.seed = number, .step = (uint64_t)runs};
        const input *start = &seed[runs < seeds ? (int)runs : ves_random_below(&random, seeds)];
        memcpy(i.text, start->text, i.length = start->length);
        int changes = runs < seeds ? 0 : 1 + ves_random_below(&random, 6);
        for (int k = 0; k < changes; k++) mutate(&i, seed, seeds, &random);
        remember(file, &i);
        double before = now();
        alarm(20); /* one that never ends is a finding: its input stays in the file */
        LLVMFuzzerTestOneInput((const uint8_t *)i.text, i.length);
        double took = now() - before;
        if (took > slowest) slowest = took;
        alarm(0);
    }
    printf("fuzz: %ld inputs in %.0f s, none broke a reader; slowest %.3f s\n", runs, now() - begin, slowest);
    close(file);
    remove(VESICA_BUILD "/fuzz_problem.input");
    for (int k = 0; k < seeds; k++) free(seed[k].text);
    free(i.text);
    return 0;
}
#endif
