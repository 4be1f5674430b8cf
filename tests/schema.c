/* What is written from the schema: help, the manual's reference, JSON Schema. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure/registry.h"
#include "problem/describe.h"
#include "problem/problem.h"
#include "problem/schema.h"
#include "vesica/search.h"

static const char head[] = "vesica: 1\n"
                           "parameters: {gap: 2}\n";
static const char curves[] = "curves:\n"
                             "  p1: {circle: {radius: 1}}\n"
                             "  p2: {circle: {radius: 2}, apply: [{translate: [0, 0, gap]}]}\n";
static const char patches[] =
    "patches:\n"
    "  wall: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\n";
static const char shell[] =
    "shell: {parts: {wall: {thickness: 0.1}}, material: {E: 1, nu: 0.3}, supports: [{at: p1, fix: all}],\n"
    "  cases: {push: [{at: p2, line: [0, 0, 1]}]}}\n";

static void expect_read(const char *text, const char *what)
{
    ves_problem *problem = NULL;
    ves_diag *diag = ves_diag_create();
    char message[2000] = "";
    ves_status status = ves_problem_read_text("x", text, strlen(text), NULL, &problem, diag);
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, message, sizeof message);
    cr_expect(status == VES_OK, "%s: %s", what, message);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

static const char *example(ves_arena *arena, const char *name, const ves_key *keys)
{
    ves_writer w = {0};
    ves_describe_example(&w, name, keys);
    return ves_writer_finish(&w, arena);
}

Test(schema, examples_of_curves_moves_and_measures_can_be_read)
{
    ves_arena arena = {0};
    char text[4000];
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++) {
        const char *e = example(&arena, (*op)->name, (*op)->keys);
        if ((*op)->move)
            snprintf(text, sizeof text, "%s%s  new: {like: p1, apply: [%s]}\n%s", head, curves, e, patches);
        else
            snprintf(text, sizeof text, "%s%s  new: %s\n%s", head, curves, e, patches);
        expect_read(text, e);
    }
    for (const ves_measure *const *m = ves_measures(); *m; m++) {
        const char *e = example(&arena, (*m)->name, (*m)->keys);
        snprintf(text, sizeof text, "%s%s%s%smeasures: {new: %s}\nminimize: new\n", head, curves, patches,
                 (*m)->shell ? shell : "", e);
        expect_read(text, e);
    }
    ves_arena_destroy(&arena);
}

/* Examples of keys name things that the file around them must have. */
Test(schema, examples_of_keys_can_be_read)
{
    static const char *const whole[] = {
        "title",  "scale", "solve", "minimize", "maximize", "constraints", "validity", "quadrature",
        "search", "seed",  "modes", "test",     "expect",   "places",      "measures", "shell"};
    for (size_t k = 0; k < sizeof whole / sizeof *whole; k++) {
        const ves_entry *e = ves_schema_find(ves_schema_root.table, whole[k]);
        char text[4000], use[200] = "";
        cr_assert(e != NULL, "%s", whole[k]);
        if (!strcmp(whole[k], "solve"))
            snprintf(use, sizeof use, "measures: {m: {integral: {of: \"h*x\"}}}\n");
        const char *sized =
            strcmp(whole[k], "solve") ? curves : "curves: {p1: {circle: 1 m}, p2: {circle: h}}\n";
        const char *start = strcmp(whole[k], "solve") ? head : "vesica: 1\n";
        snprintf(text, sizeof text, "%s%s%s%s\n%s", start, sized, patches, e->example, use);
        expect_read(text, e->example);
    }
    for (const ves_entry *e = ves_schema_root.table; e->key.name; e++)
        if ((int)e->key.kind != VES_LATER)
            cr_expect(!strncmp(e->example, e->key.name, strlen(e->key.name)),
                      "%s has an example of another key", e->key.name);
}

static void expect_about(const ves_entry *table, const char *path)
{
    for (const ves_entry *e = table; e && e->key.name; e++) {
        bool later = (int)e->key.kind == VES_LATER;
        cr_expect(e->key.about && *e->key.about, "%s.%s says nothing about itself", path, e->key.name);
        cr_expect(later || (e->example && *e->example), "%s.%s has no example", path, e->key.name);
        expect_about(e->table, e->key.name);
    }
}

Test(schema, every_entry_says_what_it_is_and_gives_an_example)
{
    expect_about(ves_schema_root.table, "problem");
}

static void expect_explained(const char *word, const char *part)
{
    ves_arena arena = {0};
    bool found = false;
    char *text = ves_schema_explain(&arena, word, NULL, NULL, &found);
    cr_expect(text && found && strstr(text, part), "%s: want \"%s\", got:\n%s", word, part, text);
    ves_arena_destroy(&arena);
}

Test(schema, explain_knows_every_word)
{
    for (const ves_entry *e = ves_schema_root.table; e->key.name; e++)
        expect_explained(e->key.name, e->key.about);
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++)
        expect_explained((*op)->name, (*op)->about);
    for (const ves_measure *const *m = ves_measures(); *m; m++) expect_explained((*m)->name, (*m)->about);
    for (const ves_algorithm *a = ves_search_algorithms(); a->name; a++) expect_explained(a->name, a->about);
    static const char *const row[][2] = {{"scale", "patches.conditions.scale"},
                                         {"conditions.scale", "length of the derivative"},
                                         {"mm", "1 mm = 0.001"},
                                         {"N/m", "1 N/m = 1 kg/s^2"},
                                         {"formula", "comparisons"},
                                         {"animate", "not in this version yet"},
                                         {"shell.supports", "example: {at: p1, fix: all}"},
                                         {"shell.cases.stack.0.line", "force per length"},
                                         {"hips", "E = 2 GPa, nu = 0.35"},
                                         {"power", "whole number (1 .. 20)"},
                                         {"jacobian", "positive or any, default positive"}};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) expect_explained(row[k][0], row[k][1]);
    /* what check says of joints and of conditions inside */
    static const char *const joint[] = {"joint", "joints", "C0", "G1",   "G2",
                                        "C1",    "C1 G2",  "C2", "open", "crease"};
    for (size_t k = 0; k < sizeof joint / sizeof *joint; k++) expect_explained(joint[k], "joint");
    expect_explained("C0", "0.001 degrees");
    expect_explained("C2", "within 1e-4");
    expect_explained("amplified", "Lebesgue");
    expect_explained("lebesgue", "remainder");
    expect_explained("chebyshev", "sections.nodes");
}

Test(schema, explain_suggests_a_word_for_one_that_it_does_not_know)
{
    ves_arena arena = {0};
    bool found = true;
    char *text = ves_schema_explain(&arena, "cirle", NULL, NULL, &found);
    cr_expect(!found && !strcmp(text, "nothing is known about \"cirle\", did you mean \"circle\"?\n"), "%s",
              text);
    text = ves_schema_explain(&arena, "", NULL, NULL, &found);
    cr_expect(!found && text);
    ves_arena_destroy(&arena);
}

Test(schema, the_reference_chapter_is_what_the_program_writes)
{
    ves_arena arena = {0};
    char *want = ves_schema_reference(&arena, NULL);
    FILE *in = fopen(VESICA_SOURCE "/docs/reference.md", "rb");
    cr_assert(in != NULL && want != NULL);
    size_t size = strlen(want);
    char *got = calloc(size + 2, 1);
    size_t length = fread(got, 1, size + 1, in);
    fclose(in);
    size_t at = 0;
    while (at < size && got[at] == want[at]) at++;
    cr_expect(length == size && at == size,
              "docs/reference.md differs at byte %zu: write it anew (vesica schema --reference)\n%.80s", at,
              want + at);
    free(got);
    ves_arena_destroy(&arena);
}

/* One value of JSON; returns behind it, NULL when it is none. */
static const char *json_value(const char *at);

static const char *json_string(const char *at)
{
    if (*at++ != '"') return NULL;
    for (; *at && *at != '"'; at++)
        if ((unsigned char)*at < 32 || (*at == '\\' && !strchr("\"\\/bfnrtu", *++at))) return NULL;
    return *at ? at + 1 : NULL;
}

static const char *json_list(const char *at, char end)
{
    if (*at == end) return at + 1;
    for (;;) {
        if (end == '}' && (!(at = json_string(at)) || *at++ != ':')) return NULL;
        at = json_value(at);
        if (!at || (*at != ',' && *at != end)) return NULL;
        if (*at++ == end) return at;
    }
}

static const char *json_value(const char *at)
{
    if (*at == '{') return json_list(at + 1, '}');
    if (*at == '[') return json_list(at + 1, ']');
    if (*at == '"') return json_string(at);
    size_t word = strspn(at, "truefalsn"), number = strspn(at, "0123456789+-.eE");
    return word > 3 ? at + word : number ? at + number : NULL;
}

Test(schema, the_json_schema_is_json_and_has_every_key)
{
    ves_arena arena = {0};
    char *text = ves_schema_json(&arena, NULL), key[100];
    const char *end = json_value(text);
    cr_expect(end && !strcmp(end, "\n"), "not JSON");
    for (const ves_entry *e = ves_schema_root.table; e->key.name; e++) {
        snprintf(key, sizeof key, "\"%s\":{", e->key.name);
        cr_expect(!strstr(text, key) == ((int)e->key.kind == VES_LATER), "%s", key);
    }
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++) {
        snprintf(key, sizeof key, "\"%s\":{", (*op)->name);
        cr_expect(strstr(text, key) != NULL, "%s", key);
    }
    ves_arena_destroy(&arena);
}
