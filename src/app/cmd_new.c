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
void app_template_title(const app_template *t, char *title, size_t size)
{
    static const char key[] = "title: ";
    const char *text = strstr(t->text, key);
    if (text) text += sizeof key - 1;
    snprintf(title, size, "%.*s", text ? (int)strcspn(text, "\n") : 0, text ? text : "");
}

static void templates_list(void)
{
    app_table table = {.align = "ll"};
    for (const app_template *t = app_templates; t->name; t++) {
        char title[200];
        app_template_title(t, title, sizeof title);
        app_table_cell(&table, "%s", t->name);
        app_table_cell(&table, "%s", title);
    }
    app_table_print(&table, stdout);
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
    fprintf(stderr, "next: %s check %s, then %s run %s\n", app_called(), path, app_called(), path);
    return APP_DONE;
}

int app_new(app *a)
{
    int code = APP_DONE;
    if (!a->operands) {
        templates_list();
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
