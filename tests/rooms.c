/* The rules of the house (docs/architecture.md says why), checked on its text; a sample breaks each of them. */
#include <criterion/criterion.h>
#include <stdarg.h>
#include <unistd.h>

#include "source.h"

enum { FILE_LINES = 600, FUNCTION_LINES = 100, PARAMETERS = 7, FUNCTIONS = 20000, ROOMS = 32 };

typedef struct house {
    int breaches, files;
    char last[512]; /* the last breach, for the test of the rules */
    bool quiet;
    int functions, length[FUNCTIONS];
    char looked[ROOMS][200]; /* into which rooms the sources of each room look */
} house;

static void complain(house *h, const source *s, int line, const char *format, ...)
{
    char text[320];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    snprintf(h->last, sizeof h->last, "%.150s:%d: %s", s->path, line, text);
    h->breaches++;
    if (!h->quiet) cr_log_error("%s", h->last);
}

/* ---- which room may look into which: includes go one way ---- */

typedef struct row {
    char name[32], sees[160];
} row;

/* A row of the table in docs/architecture.md: | `src/ROOM` | what it knows | ROOM, ROOM |. */
static bool row_read(const char *line, row *r)
{
    *r = (row){0};
    if (sscanf(line, "| `src/%31[a-z]` |%*[^|]|%159[^|\n]|", r->name, r->sees) < 2) return false;
    for (char *at = r->sees; *at; at++)
        if (*at == ',') *at = ' ';
    return true;
}

static const row *rows(void)
{
    static row table[ROOMS]; /* an empty name ends it */
    if (table[0].name[0]) return table;
    char *text = read_text(VESICA_SOURCE "/docs/architecture.md");
    int n = 0;
    cr_assert(text != NULL, "no docs/architecture.md");
    for (const char *at = text; *at && n < ROOMS - 1; at += strcspn(at, "\n"), at += *at == '\n')
        n += row_read(at, &table[n]);
    table[n] = (row){0};
    free(text);
    return table;
}

typedef struct arrow {
    const char *room, *sees;
} arrow;

/* Other people's libraries: one door each. The app only asks them for their versions. */
static const arrow DOORS[] = {
    {"yaml.h", "problem app"},
    {"nlopt.h", "search suite app"},
    {"cairo", "output app"},
    {"CGAL/", "bridge"},
    {"cholmod.h", "shell"},
    {"cblas.h", "shell"},
    {"zlib.h", "study"},
    {"mpi.h", "study"},
    {"gmp", "bridge"},
    {"mpfr", "bridge"},
    {"Random123/", "base"},
    {"pthread.h", "base"},
    {"dlfcn.h", "app"},
    {"threads.h", "base"},
    {"stdatomic.h", "base search"},
    {"signal.h", "app suite"},
    {"omp.h", "shell"},
    {"assert.h", ""},
    {"setjmp.h", ""},
};

static bool has_word(const char *words, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = words; length && (at = strstr(at, word)); at += length)
        if ((at == words || at[-1] == ' ') && (at[length] == 0 || at[length] == ' ')) return true;
    return false;
}

/* src/ROOM/...; "" elsewhere. */
static void room_of(const char *path, char room[64])
{
    room[0] = 0;
    if (starts_with(path, "src/")) snprintf(room, 64, "%.*s", (int)strcspn(path + 4, "/"), path + 4);
}

/* Where it stands in the table, or -1. */
static int row_of(const char *name)
{
    const row *table = rows();
    for (int k = 0; table[k].name[0]; k++)
        if (!strcmp(table[k].name, name)) return k;
    return -1;
}

static void look_note(char looked[200], const char *target)
{
    size_t length = strlen(looked);
    if (!has_word(looked, target)) snprintf(looked + length, 200 - length, " %s", target);
}

static void check_include(house *h, const source *s, int line, const char *name, bool angle)
{
    char room[64], target[64] = "";
    room_of(s->path, room);
    for (size_t k = 0; angle && k < sizeof DOORS / sizeof *DOORS; k++)
        if (starts_with(name, DOORS[k].room) && !has_word(DOORS[k].sees, room))
            complain(h, s, line, "<%s> is not for %s", name, room);
    size_t length = strcspn(name, "/");
    if (angle || ends_with(name, ".inc")) return;
    if (name[length] != '/') {
        complain(h, s, line, "\"%s\" does not say which room it is in", name);
        return;
    }
    snprintf(target, sizeof target, "%.*s", (int)length, name);
    if (!strcmp(target, "vesica") || !strcmp(target, "base") || !strcmp(target, room)) return;
    int from = row_of(room);
    look_note(h->looked[from], target);
    if (!has_word(rows()[from].sees, target)) complain(h, s, line, "%s may not look into %s", room, target);
}

static void check_includes(house *h, const source *s)
{
    char name[128], open, room[64];
    room_of(s->path, room);
    if (row_of(room) < 0) {
        complain(h, s, 1, "there is no room \"%s\"", room);
        return;
    }
    for (const char *line = s->raw; *line; line += strcspn(line, "\n"), line += *line == '\n')
        if (sscanf(line, " # include %c%127[^\">\n]", &open, name) == 2)
            check_include(h, s, line_of(s->raw, line), name, open == '<');
}

static void check_public_include(house *h, const source *s)
{
    char name[128];
    for (const char *line = s->raw; *line; line += strcspn(line, "\n"), line += *line == '\n')
        if (sscanf(line, " # include \"%127[^\"\n]", name) == 1 && !starts_with(name, "vesica/"))
            complain(h, s, line_of(s->raw, line), "a public header may not include \"%s\"", name);
}

/* ---- words that belong to a room ---- */

static const struct word {
    const char *words, *rooms, *why;
} WORDS[] = {
    {"printf fprintf vprintf vfprintf puts putchar perror dprintf", "app output", "prints"},
    {"malloc calloc realloc free strdup strndup aligned_alloc posix_memalign", "base",
     "takes or frees memory"},
    {"exit _Exit quick_exit", "app", "ends the program"},
    {"abort assert setjmp longjmp", "", "does not return"},
    {"time clock clock_gettime gettimeofday", "app study output", "reads the clock"},
    {"strtod atof", "base", "depends on the locale"},
    {"rand srand random drand48", "", "draws from hidden state"},
    {"strtok setlocale", "", "has hidden state"},
    {"gets sprintf vsprintf system popen", "", "is not safe"},
};

/* The next call of the word in code: the whole identifier, then a parenthesis; not a member (ops->free). */
static const char *next_call(const char *at, const char *word, size_t length)
{
    for (; (at = strstr(at, word)); at++) {
        char before = at[-1]; /* a file's first byte opens a comment */
        if (isalnum((unsigned char)before) || before == '_' || before == '.' || before == '>') continue;
        if (at[length] == '(') return at;
    }
    return NULL;
}

static void check_words(house *h, const source *s)
{
    char room[64], word[32];
    room_of(s->path, room);
    for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS; k++) {
        if (has_word(WORDS[k].rooms, room)) continue;
        for (const char *at = WORDS[k].words; sscanf(at, " %31s", word) == 1;
             at += strspn(at, " ") + strlen(word))
            for (const char *hit = s->code + 1; (hit = next_call(hit, word, strlen(word))); hit++)
                complain(h, s, line_of(s->code, hit), "%s() %s: not in %s", word, WORDS[k].why, room);
    }
}

/* ---- statements: functions and objects ---- */

/* `text` up to `end` declares a pointer to a function. */
static bool is_hook(const char *text, const char *end)
{
    const char *open = text + strcspn(text, "(");
    return open < end && open[1] == '*';
}

/* `text` up to `end` declares something const: the object itself, not what it points to. */
static bool is_const(const char *text, const char *end)
{
    const char *star = text;
    if (is_hook(text, end)) return starts_with(text + strcspn(text, "("), "(*const ");
    for (const char *at = text; at < end; at++)
        if (*at == '*') star = at;
    for (const char *at = strstr(star, "const"); at && at < end; at = strstr(at + 1, "const"))
        if (!isalnum((unsigned char)at[5]) && at[5] != '_') return true;
    return false;
}

static bool has(const char *text, const char *end, const char *part)
{
    const char *at = strstr(text, part);
    return at && at < end;
}

static bool first_word_is(const char *text, const char *words)
{
    char word[32] = "";
    sscanf(text, "%31[A-Za-z_]", word);
    return has_word(words, word);
}

static int words_in(const char *text, const char *end)
{
    int words = 0;
    for (bool in = false; text < end && *text != '['; text++) {
        bool letter = isalnum((unsigned char)*text) || *text == '_';
        words += letter && !in;
        in = letter;
    }
    return words;
}

/* The one exception: what a signal handler tells the program, for which C has no other way. */
static const char SIGNALLED[] = "static volatile sig_atomic_t ";

/* A statement, or its head before = or {. depth: braces around it. */
static void check_object(house *h, const source *s, const char *text, const char *end, int depth)
{
    while (text < end && isspace((unsigned char)*text)) text++;
    bool is_static = first_word_is(text, "static _Thread_local");
    if (!is_static && (depth > 0 || first_word_is(text, "typedef extern struct union enum _Static_assert")))
        return;
    if (starts_with(s->path, "src/app/") && starts_with(text, SIGNALLED)) return;
    bool function = has(text, end, "(") && !is_hook(text, end);
    if (function || words_in(text, end) < 2 || is_const(text, end)) return;
    complain(h, s, line_of(s->code, text), "\"%.*s\" can change: no state outside of structs",
             (int)(end - text), text);
}

static void check_parameters(house *h, const source *s, const char *text, const char *end)
{
    int count = 1, depth = 0;
    const char *open = text + strcspn(text, "(");
    for (const char *at = open; at < end; at++) {
        depth += (*at == '(') - (*at == ')');
        count += depth == 1 && *at == ',';
        if (depth == 0) break;
    }
    const char *name = open;
    while (name > text && (isalnum((unsigned char)name[-1]) || name[-1] == '_')) name--;
    if (count > PARAMETERS)
        complain(h, s, line_of(s->code, name), "%.*s has %d parameters, at most %d: a struct is missing",
                 (int)(open - name), name, count, PARAMETERS);
}

static void check_length(house *h, const source *s, const char *head, const char *end)
{
    int first = line_of(s->code, head), lines = line_of(s->code, end) - first + 1;
    if (h->functions < FUNCTIONS) h->length[h->functions++] = lines;
    if (lines > FUNCTION_LINES)
        complain(h, s, first, "a function of %d lines, at most %d", lines, FUNCTION_LINES);
}

typedef struct reader {
    house *h;
    const source *s;
    int depth;
    const char *start;    /* of the statement */
    const char *function; /* the head of the function we are in */
    bool assigned;        /* past the = of the statement */
    bool tag;             /* past the braces of a struct, union or enum */
} reader;

static const char *trimmed(const char *text)
{
    return text + strspn(text, " \t\n");
}

static void open_brace(reader *r, const char *at)
{
    const char *head = trimmed(r->start);
    if (first_word_is(head, "extern") && !has(head, at, "(")) { /* extern "C" */
        r->start = at + 1;
        return;
    }
    r->tag = first_word_is(head, "typedef struct union enum") && !has(head, at, "(");
    if (r->depth == 0 && !r->assigned && has(head, at, "(")) {
        r->function = head;
        check_parameters(r->h, r->s, head, at);
    }
    r->depth++;
    if (!r->assigned) r->start = at + 1;
}

static void close_brace(reader *r, const char *at)
{
    if (r->depth == 0) { /* of extern "C" */
        r->start = at + 1;
        return;
    }
    if (--r->depth == 0 && r->function) {
        check_length(r->h, r->s, r->function, at);
        r->function = NULL;
    }
    if (!r->assigned) r->start = at + 1;
}

static void check_statements(house *h, const source *s)
{
    reader r = {.h = h, .s = s, .start = s->code};
    int inside = 0; /* parentheses, and braces of an initialiser */
    for (const char *at = s->code; *at; at++) {
        if (*at == '(') inside++;
        if (*at == ')') inside--;
        if (inside) continue;
        if (*at == '=' && !r.assigned) {
            if (!r.tag) check_object(h, s, r.start, at, r.depth);
            r.assigned = true;
        }
        if (*at == '{') open_brace(&r, at);
        if (*at == '}') close_brace(&r, at);
        if (*at != ';') continue;
        if (!r.assigned && !r.tag) check_object(h, s, r.start, at, r.depth);
        r.start = at + 1;
        r.assigned = r.tag = false;
    }
    if (r.depth) complain(h, s, line_of(s->code, s->code + strlen(s->code)), "the braces do not match");
}

/* ---- files ---- */

static void check_size(house *h, const source *s)
{
    int lines = line_of(s->raw, s->raw + strlen(s->raw)) - 1;
    if (lines > FILE_LINES) complain(h, s, lines, "%d lines, at most %d", lines, FILE_LINES);
}

static void check_unfinished(house *h, const source *s)
{
    static const char *const marks[] = {"TO"
                                        "DO",
                                        "FIX"
                                        "ME"};
    for (size_t k = 0; k < sizeof marks / sizeof *marks; k++)
        for (const char *at = s->raw; (at = strstr(at, marks[k])); at++)
            if (!isalnum((unsigned char)at[strlen(marks[k])]) && at[strlen(marks[k])] != '_')
                complain(h, s, line_of(s->raw, at), "unfinished: %s", marks[k]);
}

static void check_header(house *h, const source *s)
{
    if (!starts_with(s->raw, "/* ")) complain(h, s, 1, "a header begins with what it is for");
}

/* Plugin folders: the file's name is the word in problem files and part of the symbol. */
static const struct shelf {
    const char *folder, *symbol, *end;
} SHELVES[] = {
    {"src/curve/source/", " ves_curve_", "_op = {"},
    {"src/curve/move/", " ves_curve_", "_op = {"},
    {"src/measure/list/", " ves_measure_", " = {"},
    {"src/output/format/", " ves_format_", " = {"},
    {"src/search/proposal/", " ves_proposal_", " = {"},
    {"src/search/schedule/", " ves_schedule_", " = {"},
    {"src/search/population/", " ves_population_", " = {"},
    {"src/search/constraint/", " ves_constraint_", " = {"},
    {"src/suite/landscape/", " ves_landscape_", " = {"},
};

static void check_shelf(house *h, const source *s)
{
    char name[64], wanted[160];
    for (size_t k = 0; k < sizeof SHELVES / sizeof *SHELVES; k++) {
        if (!starts_with(s->path, SHELVES[k].folder) || !ends_with(s->path, ".c")) continue;
        const char *file = s->path + strlen(SHELVES[k].folder);
        snprintf(name, sizeof name, "%.*s", (int)strcspn(file, "."), file);
        snprintf(wanted, sizeof wanted, "%s%s%s", SHELVES[k].symbol, name, SHELVES[k].end);
        if (!strstr(s->raw, wanted)) complain(h, s, 1, "does not define%s%s", SHELVES[k].symbol, name);
        snprintf(wanted, sizeof wanted, ".name = \"%s\"", name);
        if (!strstr(s->raw, wanted)) complain(h, s, 1, "%s is missing", wanted);
    }
}

/* ---- the tests ---- */

static void visit_source(void *data, const source *s)
{
    house *h = data;
    h->files++;
    check_includes(h, s);
    check_words(h, s);
    check_statements(h, s);
    check_size(h, s);
    check_unfinished(h, s);
    check_shelf(h, s);
    if (ends_with(s->path, ".h")) check_header(h, s);
}

static void visit_public(void *data, const source *s)
{
    house *h = data;
    h->files++;
    check_public_include(h, s);
    check_size(h, s);
    check_unfinished(h, s);
    check_header(h, s);
}

static void visit_other(void *data, const source *s)
{
    house *h = data;
    h->files++;
    check_size(h, s);
    check_unfinished(h, s);
}

static int by_size(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

Test(rooms, every_file_under_src_keeps_the_rules)
{
    static house h;
    walk("src", visit_source, &h);
    cr_assert(h.files >= 50, "only %d files found under %s/src", h.files, VESICA_SOURCE);
    cr_assert(h.breaches == 0, "%d breaches in %d files (above)", h.breaches, h.files);
}

/* What the table allows is what the source does: no row without a room, no arrow that nothing
 * follows, and all arrows go up. */
Test(rooms, the_table_of_the_architecture_says_no_more_than_the_source_does)
{
    static house h = {.quiet = true};
    const row *table = rows();
    int k = 0, length;
    walk("src", visit_source, &h);
    for (; table[k].name[0]; k++) {
        char path[512], word[32];
        snprintf(path, sizeof path, VESICA_SOURCE "/src/%.31s", table[k].name);
        cr_expect(!access(path, F_OK), "there is no src/%s", table[k].name);
        for (const char *at = table[k].sees; sscanf(at, " %31s%n", word, &length) == 1; at += length)
            cr_expect(has_word(h.looked[k], word) && row_of(word) < k,
                      "%s looks nowhere into %s, or it is below it", table[k].name, word);
    }
    cr_expect(k > 8, "only %d rooms in the table", k);
}

Test(rooms, public_headers_stand_alone_and_say_what_they_are_for)
{
    static house h;
    walk("include", visit_public, &h);
    cr_assert(h.files >= 8, "only %d public headers found", h.files);
    cr_assert(h.breaches == 0, "%d breaches in %d files (above)", h.breaches, h.files);
}

Test(rooms, tests_benches_and_examples_are_of_readable_size_and_finished)
{
    static house h;
    walk("tests", visit_other, &h);
    walk("bench", visit_other, &h);
    walk("examples", visit_other, &h);
    cr_assert(h.breaches == 0, "%d breaches in %d files (above)", h.breaches, h.files);
}

/* Lines counted from the line of the name to the closing brace. */
Test(rooms, half_the_functions_fit_16_lines_and_nine_of_ten_50)
{
    static house h = {.quiet = true};
    walk("src", visit_source, &h);
    cr_assert(h.functions > 100, "only %d functions found", h.functions);
    qsort(h.length, (size_t)h.functions, sizeof *h.length, by_size);
    int median = h.length[h.functions / 2], most = h.length[h.functions * 9 / 10];
    cr_assert(median <= 16, "median of %d functions: got %d lines, want at most 16", h.functions, median);
    cr_assert(most <= 50, "nine of ten of %d functions: got %d lines, want at most 50", h.functions, most);
}

/* A source that breaks exactly one rule, and a part of what must be said; NULL: it breaks none. */
static const struct sample {
    const char *path, *text, *want;
} SAMPLES[] = {
    {"src/search/a.c", "/**/\n#include \"surface/patch.h\"\n", "a.c:2: search may not look into surface"},
    {"src/curve/a.c", "/**/\n#include \"plan/plan.h\"\n", "curve may not look into plan"},
    {"src/base/a.c", "/**/\n#include \"formula/formula.h\"\n", "base may not look into formula"},
    {"src/plan/a.c", "/**/\n#include \"study/run.h\"\n", "plan may not look into study"},
    {"src/plan/a.c", "/**/\n#include \"inside.h\"\n", "does not say which room"},
    {"src/attic/a.c", "/**/\n", "no room \"attic\""},
    {"src/plan/a.c", "/**/\n#include <nlopt.h>\n", "<nlopt.h> is not for plan"},
    {"src/plan/a.c", "/**/\n#include \"plan/plan.h\"\n#include \"surface/patch.h\"\n#include <math.h>\n",
     NULL},
    {"src/plan/a.c", "/**/\nint f(void)\n{\n    printf(\"\");\n}\n", "a.c:4: printf() prints: not in plan"},
    {"src/plan/a.c", "/**/\nint f(void)\n{\n    snprintf(a, 1, \"printf(\"); /* printf( */ // puts(\n}\n",
     NULL},
    {"src/plan/a.c", "/**/\nint f(void)\n{\n    return free(a);\n}\n", "free() takes or frees memory"},
    {"src/plan/a.c", "/**/\nint f(void)\n{\n    return a->free(a) + a.free(a) + my_free(a);\n}\n", NULL},
    {"src/search/a.c", "/**/\nint f(void)\n{\n    return clock();\n}\n", "reads the clock"},
    {"src/app/a.c", "/**/\nint f(void)\n{\n    exit(1);\n}\n", NULL},
    {"src/app/a.c", "/**/\nint f(void)\n{\n    abort();\n}\n", "does not return"},
    {"src/plan/a.c", "/**/\nstatic int count;\n", "a.c:2: \"static int count\" can change"},
    {"src/plan/a.c", "/**/\nint count = 3;\n", "\"int count \" can change"},
    {"src/plan/a.c", "/**/\nstatic const char *name = \"\";\n", "can change"},
    {"src/plan/a.c", "/**/\nstatic double table[] = {1, 2};\n", "can change"},
    {"src/plan/a.c", "/**/\nstatic int (*hook)(const int *);\n", "can change"},
    {"src/plan/a.c", "/**/\nint f(int a, void (*task)(int));\n", NULL},
    {"src/plan/a.c", "/**/\nint f(void)\n{\n    static int calls;\n    return ++calls;\n}\n",
     "a.c:4: \"static int calls\""},
    {"src/plan/a.c", "/**/\nstatic _Thread_local int depth;\n", "can change"},
    {"src/plan/a.c", "/**/\nstatic volatile sig_atomic_t asked;\n", "can change"},
    {"src/app/a.c", "/**/\nstatic volatile sig_atomic_t asked;\n", NULL},
    {"src/plan/a.c",
     "/**/\ntypedef struct t {\n    int a;\n} t;\nstruct u {\n    int b;\n};\nenum { A = 1, B };\nextern int "
     "c;\n"
     "static const char *const names[] = {\"a\", \"b\"};\nstatic const t one = {.a = 1};\nstatic int f(int "
     "a);\n"
     "const t two = {2};\nint f(int a)\n{\n    int b = 1;\n    for (int k = 0; k < a; k++) b *= 2;\n    "
     "return b;\n}\n"
     "static int (*const hook)(int) = f;\ntypedef int (*maker)(void);\n",
     NULL},
    {"src/plan/a.h",
     "/* What. */\n#ifdef __cplusplus\nextern \"C\" {\n#endif\nint f(int);\n#ifdef __cplusplus\n}\n#endif\n",
     NULL},
    {"src/plan/a.h", "#ifndef A\n", "a header begins with what it is for"},
    {"src/plan/a.c",
     "/**/\nint f(int a, int b, int c, int d, int e, int g, int h, int i, int j)\n{\n    return 0;\n}\n",
     "9 parameters"},
    {"src/plan/a.c",
     "/**/\nint f(int a, int (*b)(int, int, int), int c, int d, int e, int g, int h)\n{\n    return 0;\n}\n",
     NULL},
    {"src/plan/a.c", "/**/\nint f(void)\n{\n", "braces do not match"},
    {"src/plan/a.c",
     "/* TO"
     "DO */\n",
     "unfinished"},
    {"src/measure/list/area.c", "/**/\nconst ves_measure ves_measure_are = {.name = \"area\"};\n",
     "does not define ves_measure_area"},
    {"src/measure/list/area.c", "/**/\nconst ves_measure ves_measure_area = {.name = \"aera\"};\n",
     ".name = \"area\" is missing"},
    {"src/curve/move/shift.c", "/**/\nconst ves_curve_op ves_curve_shift_op = {.name = \"shift\"};\n", NULL},
};

Test(rooms, each_rule_sees_its_breach_and_nothing_else)
{
    for (size_t k = 0; k < sizeof SAMPLES / sizeof *SAMPLES; k++) {
        static house h;
        memset(&h, 0, sizeof h);
        h.quiet = true;
        source s = source_of(SAMPLES[k].path, copy_of(SAMPLES[k].text));
        visit_source(&h, &s);
        source_free(&s);
        const char *want = SAMPLES[k].want;
        cr_expect(h.breaches == (want ? 1 : 0) && (!want || strstr(h.last, want)),
                  "sample %zu: got %d breaches, the last \"%s\"; want \"%s\"\n%s", k, h.breaches, h.last,
                  want ? want : "none", SAMPLES[k].text);
    }
}

Test(rooms, long_functions_and_files_are_seen)
{
    static house h = {.quiet = true};
    char *text = calloc(1, 20000);
    size_t length = (size_t)snprintf(text, 20000, "/**/\nint f(void)\n{\n");
    for (int k = 0; k < 98; k++) length += (size_t)snprintf(text + length, 20000 - length, "    g();\n");
    snprintf(text + length, 20000 - length, "}\n");
    source s = source_of("src/plan/a.c", text);
    visit_source(&h, &s);
    cr_expect(h.breaches == 1 && strstr(h.last, "101 lines, at most 100"), "got %d, \"%s\"", h.breaches,
              h.last);
    source_free(&s);
    memset(&h, 0, sizeof h);
    h.quiet = true;
    text = calloc(1, 20000);
    memcpy(text, "/**/", 4);
    memset(text + 4, '\n', 601);
    s = source_of("src/plan/a.c", text);
    visit_source(&h, &s);
    cr_expect(h.breaches == 1 && strstr(h.last, "601 lines, at most 600"), "got %d, \"%s\"", h.breaches,
              h.last);
    source_free(&s);
}
