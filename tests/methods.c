/* docs/methods: whatever a search can be made of has its page or its section there, with its measured row. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <dirent.h>
#include <string.h>
#include <unistd.h>

#include <vesica/search.h>

#include "slurp.h"

#define FOLDER VESICA_SOURCE "/docs/methods/"

static char *page(const char *name)
{
    char path[600];
    snprintf(path, sizeof path, FOLDER "%s.md", name);
    cr_assert(access(path, R_OK) == 0, "the method \"%s\" has no page: %s is missing", name, path);
    return slurp(path);
}

static void holds(const char *text, const char *words, const char *name)
{
    cr_expect(strstr(text, words) != NULL, "docs/methods/%s.md: no \"%s\"", name, words);
}

/* A page of its own, that says what each page says. */
static void page_check(const char *name, const char *index)
{
    static const char *const parts[] = {"**Sources.** ", "**Settings.** ", "**When.** ",
                                        "<!-- rows classic: ", "<!-- rows constrained: "};
    char words[100], *text = page(name);
    snprintf(words, sizeof words, "# %s: ", name);
    cr_expect(strncmp(text, words, strlen(words)) == 0, "docs/methods/%s.md does not begin with %s", name,
              words);
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) holds(text, parts[k], name);
    snprintf(words, sizeof words, "\n| `%s` | ", name);
    holds(text, words, name);
    holds(index, words, "README");
    snprintf(words, sizeof words, "(%s.md)", name);
    holds(index, words, "README");
    free(text);
}

Test(methods, strategies_and_algorithms_have_pages)
{
    char *index = page("README");
    ves_choice choice;
    int count = 0;
    page_check("auto", index);
    page_check("anneal", index);
    for (; ves_search_choice(VES_SLOT_STRATEGY, count, &choice); count++) page_check(choice.name, index);
    for (const ves_algorithm *a = ves_search_algorithms(); a->name; a++, count++) page_check(a->name, index);
    cr_expect(count >= 12, "%d pages", count);
    free(index);
}

Test(methods, words_of_the_annealing_have_their_place)
{
    static const struct {
        ves_slot slot;
        const char *section, *row;
    } slots[] = {{VES_SLOT_PROPOSAL, "\n## proposal: ", "\n| `%s` | "},
                 {VES_SLOT_SCHEDULE, "\n## schedule: ", "\n| `%s` | "},
                 {VES_SLOT_POPULATION, "\n## population: ", "\n| `%s` | "},
                 {VES_SLOT_CONSTRAINTS, "\n## constraints: ", "\n| `%s` | "},
                 {VES_SLOT_POLISH, "\n## polish: ", "\n| `%s` | "},
                 {VES_SLOT_PRESET, "# anneal: ", "\n`as: %s` means "}};
    char *text = page("anneal"), words[100];
    for (size_t k = 0; k < sizeof slots / sizeof *slots; k++) {
        ves_choice choice;
        char *from = strstr(text, slots[k].section);
        cr_assert(from != NULL, "docs/methods/anneal.md: no section \"%s\"", slots[k].section + 1);
        char *end = strstr(from + 1, "\n## ");
        size_t length = end ? (size_t)(end - from) : strlen(from);
        char *section = strndup(from, length);
        for (int i = 0; ves_search_choice(slots[k].slot, i, &choice); i++) {
            snprintf(words, sizeof words, slots[k].row, choice.name);
            cr_expect(strstr(section, words) != NULL, "docs/methods/anneal.md, section \"%s\": no \"%s\"",
                      slots[k].section + 1, words + 1);
        }
        free(section);
    }
    free(text);
}

/* What is linked is there, and no row is left to be filled in. */
Test(methods, pages_are_whole)
{
    DIR *folder = opendir(FOLDER);
    cr_assert(folder != NULL);
    int links = 0;
    for (struct dirent *e; (e = readdir(folder));) {
        size_t length = strlen(e->d_name);
        if (length < 3 || strcmp(e->d_name + length - 3, ".md")) continue;
        char path[1200], *text = NULL;
        snprintf(path, sizeof path, FOLDER "%s", e->d_name);
        text = slurp(path);
        cr_expect(strstr(text, "-->\n<!-- end -->") == NULL, "%s: rows are missing (bench/rows.py)",
                  e->d_name);
        for (char *at = text; (at = strstr(at, "](")); links++) {
            size_t end = strcspn(at += 2, "#)");
            if (!end || !strncmp(at, "http", 4)) continue;
            snprintf(path, sizeof path, FOLDER "%.*s", (int)end, at);
            cr_expect(access(path, F_OK) == 0, "%s: nothing is at %.*s", e->d_name, (int)end, at);
        }
        free(text);
    }
    cr_expect(links > 50, "%d links", links);
    closedir(folder);
}
