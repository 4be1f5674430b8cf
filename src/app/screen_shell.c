/* The shell of a problem, as vesica check tells it. */
#include "app/app.h"
#include "app/table.h"

static void support_cell(app_table *t, const ves_support_def *s)
{
    static const char *const word[] = {"x", "y", "z", "rx", "ry", "rz"};
    char text[64] = "all six";
    size_t at = 0;
    for (int k = 0; k < 6 && s->fix != 63; k++)
        if (s->fix >> k & 1)
            at += (size_t)snprintf(text + at, sizeof text - at, "%s%s", at ? ", " : "", word[k]);
    if (s->kind == VES_SUPPORT_FIX)
        app_table_cell(t, "fixed: %s", text);
    else if (s->kind == VES_SUPPORT_SPRING)
        app_table_cell(t, "on springs");
    else
        app_table_cell(t, "%s [%.4g, %.4g, %.4g]",
                       s->kind == VES_SUPPORT_SYMMETRY ? "in a mirror plane, normal" : "on a diaphragm, axis",
                       s->axis[0], s->axis[1], s->axis[2]);
}

static const char *load_word(ves_load_kind kind)
{
    static const char *const word[] = {"line", "force", "pressure", "area", "gravity"};
    return word[kind];
}

static void loads_row(app_table *t, const ves_problem *p, const ves_case_def *c)
{
    char text[300] = "";
    size_t at = 0;
    for (int k = 0; k < c->loads && at < sizeof text; k++) {
        const ves_load_def *l = &c->load[k];
        at += (size_t)snprintf(text + at, sizeof text - at, "%s%s", k ? "; " : "", load_word(l->kind));
        if (l->at.text && at < sizeof text)
            at += (size_t)snprintf(text + at, sizeof text - at, " at %s", l->at.text);
        for (int i = 0; i < l->parts && l->parts < p->shell->parts && at < sizeof text; i++)
            at += (size_t)snprintf(text + at, sizeof text - at, "%s%s", i ? ", " : " over ",
                                   p->patch[p->shell->part[l->part[i]].patch].name);
    }
    app_table_cell(t, "case %s", c->name);
    app_table_cell(t, "%s", text);
    app_table_end(t);
}

static void mesh_row(app_table *t, const char *what, const ves_shell_facts *f)
{
    char part[80] = "the whole shell";
    if (f->order == 0) return;
    if (f->copies == 0)
        snprintf(part, sizeof part, "a strip of a surface of revolution");
    else if (f->copies > 1)
        snprintf(part, sizeof part, "1/%d of it, %s", f->copies,
                 f->mirrored ? "between mirror planes" : "which comes again turned");
    app_table_cell(t, "%s", what);
    app_table_cell(t, "%s: %d element%s of order %d, %d degrees of freedom", part, f->elements,
                   f->elements == 1 ? "" : "s", f->order, f->freedoms);
    app_table_end(t);
}

void app_screen_shell(const ves_problem *p, const ves_shell_facts facts[2], FILE *out)
{
    const ves_shell_def *s = p->shell;
    app_table t = {.align = "ll"};
    if (!s) return;
    app_table_cell(&t, "shell");
    app_table_cell(&t, "of %s", s->made_of);
    app_table_end(&t);
    for (int k = 0; k < s->parts; k++) {
        app_table_cell(&t, "%s", p->patch[s->part[k].patch].name);
        app_table_cell(&t, "%s thick%s", s->part[k].text, s->part[k].varies ? ", varies" : "");
        app_table_end(&t);
    }
    for (int k = 0; k < s->supports; k++) {
        app_table_cell(&t, "%s", s->support[k].at.text);
        support_cell(&t, &s->support[k]);
        app_table_end(&t);
    }
    for (int k = 0; k < s->cases; k++) loads_row(&t, p, &s->load_case[k]);
    mesh_row(&t, "solved", &facts[0]);
    mesh_row(&t, "verified", &facts[1]);
    app_table_print(&t, out);
    fputc('\n', out);
}

void app_screen_shell_json(const ves_problem *p, const ves_shell_facts facts[2], ves_json *json)
{
    static const char *const support[] = {"fix", "symmetry", "diaphragm", "spring"};
    const ves_shell_def *s = p->shell;
    if (!s) return;
    ves_json_object(json, "shell");
    for (int k = 0; k < 2 && facts[k].order; k++) {
        ves_json_object(json, k ? "verified" : "solved");
        ves_json_integer(json, "order", facts[k].order);
        ves_json_integer(json, "elements", facts[k].elements);
        ves_json_integer(json, "freedoms", facts[k].freedoms);
        ves_json_integer(json, "copies", facts[k].copies);
        ves_json_end(json, '}');
    }
    ves_json_text(json, "material", s->made_of);
    ves_json_object(json, "parts");
    for (int k = 0; k < s->parts; k++) ves_json_text(json, p->patch[s->part[k].patch].name, s->part[k].text);
    ves_json_end(json, '}');
    ves_json_array(json, "supports");
    for (int k = 0; k < s->supports; k++) {
        ves_json_object(json, NULL);
        ves_json_text(json, "at", s->support[k].at.text);
        ves_json_text(json, "kind", support[s->support[k].kind]);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
    ves_json_object(json, "cases");
    for (int k = 0; k < s->cases; k++) {
        ves_json_array(json, s->load_case[k].name);
        for (int i = 0; i < s->load_case[k].loads; i++)
            ves_json_text(json, NULL, load_word(s->load_case[k].load[i].kind));
        ves_json_end(json, ']');
    }
    ves_json_end(json, '}');
    ves_json_end(json, '}');
}
