/* The words for what colours show. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "output/scene.h"

enum { CURVATURES = 4, LIST = 400 };

static const ves_quantity curvature[CURVATURES] = {
    {.word = "H", .about = "mean curvature", .curvature = 1, .plane = 0},
    {.word = "K", .about = "Gauss curvature", .curvature = 2, .plane = 1},
    {.word = "k1", .about = "largest curvature", .curvature = 1, .plane = 2},
    {.word = "k2", .about = "least curvature", .curvature = 1, .plane = 3}};

static const ves_quantity *curvature_of(const char *word)
{
    for (int k = 0; k < CURVATURES; k++)
        if (!strcmp(word, curvature[k].word)) return &curvature[k];
    return NULL;
}

bool ves_quantity_find(const ves_figure *figure, const char *word, ves_quantity *quantity)
{
    const ves_quantity *known = curvature_of(word);
    const ves_figure_field *field;
    if (known) {
        *quantity = *known;
        return true;
    }
    if (ves_figure_fields(figure, word, &field) != 1) return false;
    *quantity = (ves_quantity){
        .word = field->name, .about = field->about, .of = field->of, .unit = field->unit, .field = field};
    return true;
}

/* ", of its shell thickness, max_shear:book, ..." */
static void fields_list(const ves_figure *figure, char list[LIST])
{
    size_t length = 0;
    list[0] = 0;
    for (int k = 0; figure->shell && k < figure->shell->fields && length < LIST; k++) {
        const ves_figure_field *f = &figure->shell->field[k];
        length += (size_t)snprintf(list + length, LIST - length, "%s%s%s%s", k ? ", " : ", of its shell ",
                                   f->name, f->of ? ":" : "", f->of ? f->of : "");
    }
}

ves_status ves_quantity_check(const ves_figure *figure, const char *word, ves_diag *diag)
{
    const ves_figure_field *field;
    char list[LIST];
    if (word && (!strcmp(word, "patch") || curvature_of(word))) return VES_OK;
    int found = word ? ves_figure_fields(figure, word, &field) : 0;
    if (found == 1) return VES_OK;
    fields_list(figure, list);
    return ves_diag_add(
        diag, VES_ERROR, VES_NAME, (ves_mark){0}, "%s \"%s\" (known: patch, H, K, k1, k2%s)%s",
        found ? "several load cases have a colour" : "no colour", word ? word : "", list,
        !found && figure->shell && figure->shell->fields == 1
            ? "; stresses and displacements are known where a measure of the file asks for some"
            : "");
}
