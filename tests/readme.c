/* README: its commands and its problem file are what a reader types first. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "program.h"

/* The words of one line, without its comment. */
static void command_check(char *line)
{
    char *comment = strchr(line, '#'), path[600];
    if (comment) *comment = 0;
    for (size_t end = strlen(line); end && line[end - 1] == ' ';) line[--end] = 0;
    if (!strncmp(line, "test", 4)) return; /* of the launcher */
    expect(vesica(NULL, "%s --help", line), 0, "usage: vesica", NULL, line);
    for (char *word = strtok(line, " "); word; word = strtok(NULL, " ")) {
        if (strncmp(word, "problems/", 9)) continue;
        snprintf(path, sizeof path, VESICA_SOURCE "/%s", word);
        cr_assert(access(path, F_OK) == 0, "README speaks of \"%s\"", word);
    }
}

Test(readme, its_commands_are_understood)
{
    static const char mark[] = "    ./vesica ";
    int count = 0;
    root_make();
    char *text = slurp(VESICA_SOURCE "/README.md"), *rest;
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        if (strncmp(line, mark, sizeof mark - 1)) continue;
        char words[300];
        snprintf(words, sizeof words, "%s", line + sizeof mark - 1);
        command_check(words);
        count++;
    }
    cr_assert(count >= 6, "%d commands", count);
    free(text);
    root_remove();
}

Test(readme, its_problem_file_runs)
{
    root_make();
    char *text = slurp(VESICA_SOURCE "/README.md"), *rest, *from = strstr(text, "    vesica: 1\n");
    cr_assert(from != NULL);
    FILE *out = fopen("readme.yaml", "w");
    for (char *line = strtok_r(from, "\n", &rest); line && !strncmp(line, "    ", 4);
         line = strtok_r(NULL, "\n", &rest))
        fprintf(out, "%s\n", line + 4);
    fclose(out);
    expect(vesica(NULL, "check readme.yaml"), 0, "readme.yaml: ok", NULL, "check");
    expect(vesica(NULL, "run readme.yaml --no-files"), 0, "expected   1 of 1 hold", NULL, "run");
    free(text);
    root_remove();
}
