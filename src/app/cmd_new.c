/* vesica new: problem files to begin with. They are built into the program. */
#include <errno.h>
#include <string.h>

#include "app/app.h"
#include "app/table.h"
#include "app/template.h"
#include "base/text.h"

const app_template app_templates[] = {
#include "templates.inc"
    {NULL, NULL},
};

/* What stands after title: in its text. */
static const char *title_of(const app_template *t, int *length)
{
    const char *title = strstr(t->text, "title: ");
    if (!title) return NULL;
    title += strlen("title: ");
    *length = (int)strcspn(title, "\n");
    return title;
}

void app_templates_list(FILE *out)
{
    app_table t = {.align = "ll"};
    for (const app_template *k = app_templates; k->name; k++) {
        int length = 0;
        const char *title = title_of(k, &length);
        app_table_cell(&t, "%s", k->name);
        app_table_cell(&t, "%.*s", length, title ? title : "");
    }
    app_table_print(&t, out);
}

static const app_template *find(app *a, const char *word, int *code)
{
    const char *name[64] = {0};
    int count = 0;
    for (const app_template *t = app_templates; t->name && count < 64; t++) {
        if (!strcmp(t->name, word)) return t;
        name[count++] = t->name;
    }
    int near = ves_text_nearest(word, name, count);
    *code = near < 0 ? app_fail(a, VES_USAGE, "no template \"%s\" (vesica new lists them)", word)
                     : app_fail(a, VES_USAGE, "no template \"%s\", did you mean \"%s\"?", word, name[near]);
    return NULL;
}

static int cannot(app *a, const char *path)
{
    if (errno == EEXIST)
        return app_fail(a, VES_USAGE, "\"%s\" is there already: nothing is overwritten, choose another name",
                        path);
    return app_fail(a, VES_IO, "cannot write \"%s\": %s", path, strerror(errno));
}

static int write_new(app *a, const app_template *t, const char *path)
{
    FILE *out = fopen(path, "wbx");
    if (!out) return cannot(a, path);
    bool good = fputs(t->text, out) >= 0;
    good = fclose(out) == 0 && good;
    if (!good) {
        int code = cannot(a, path);
        remove(path);
        return code;
    }
    printf("%s\n", path);
    fprintf(stderr, "next: vesica check %s, then vesica run %s\n", path, path);
    return APP_DONE;
}

int app_new(app *a)
{
    int code = APP_DONE;
    if (!a->operands) {
        app_templates_list(stdout);
        return APP_DONE;
    }
    const app_template *t = find(a, a->operand[0], &code);
    if (!t) return code;
    if (a->operands == 2 && !strcmp(a->operand[1], "-")) {
        fputs(t->text, stdout);
        return APP_DONE;
    }
    const char *path = a->operands == 2 ? a->operand[1] : ves_arena_format(&a->arena, "%s.yaml", t->name);
    return path ? write_new(a, t, path) : app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
}
