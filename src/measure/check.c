/* Measures from outside: what a descriptor must have before anything follows its pointers. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "formula/formula.h"
#include "measure/registry.h"

enum {
    EVERYTHING =
        VES_X | VES_XU | VES_XV | VES_XUU | VES_XUV | VES_XVV | VES_NORMAL | VES_AREA | VES_CURVATURE,
    ALONG = VES_X | VES_XV | VES_XVV, /* what a curve has */
    NAME = 64
};

const char ves_names_reserved[] =
    "u|v|pi|and|or|not|if|sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|log|sqrt|abs|min|max|hypot|"
    "sign|floor|mod|objective|violation|feasible|evaluations|gradients|optima|auto|true|false|null";

static bool is_word(const char *name)
{
    size_t length = 0;
    if (!isalpha((unsigned char)*name) && *name != '_') return false;
    while (isalnum((unsigned char)name[length]) || name[length] == '_') length++;
    return !name[length] && length <= NAME;
}

static ves_status fault(ves_diag *diag, const ves_measure *m, const char *what)
{
    return ves_diag_add(diag, VES_ERROR, VES_RANGE, (ves_mark){0}, "the measure \"%s\" from outside %s",
                        m->name, what);
}

static ves_status key_fault(ves_diag *diag, const ves_measure *m, const char *key, const char *what)
{
    return ves_diag_add(diag, VES_ERROR, VES_RANGE, (ves_mark){0},
                        "the measure \"%s\" from outside: its key \"%s\" %s", m->name, key, what);
}

static bool readable(const char *unit)
{
    ves_dim dim;
    return unit && ves_dim_read(unit, &dim, NULL);
}

/* Every word of "one|two" has a letter. */
static bool sound_words(const char *words)
{
    if (!words || !*words || *words == '|') return false;
    for (const char *c = words; *c; c++)
        if (*c == '|' && (!c[1] || c[1] == '|')) return false;
    return true;
}

static const char *number_fault(const ves_key *key)
{
    if (key->unit && !readable(key->unit)) return "has a unit that cannot be read";
    if (!(key->min <= key->max)) return "has an empty range";
    bool count = key->kind == VES_COUNT; /* NAN is a number's way to say that it has no fallback */
    bool fits = count ? fabs(key->fallback) <= 1e9 : !isinf(key->fallback);
    return fits ? NULL : "has a fallback that is no such number";
}

static const char *kind_fault(const ves_measure *m, const ves_key *key)
{
    bool reference = key->kind == VES_CURVE || key->kind == VES_PLACE;
    if (key->kind < VES_NUMBER || key->kind > VES_SHELL_HELD) return "is of no kind";
    if (key->kind == VES_FORMULAS || key->kind == VES_POINTWISE || key->kind == VES_SHELLWISE)
        return "is of a kind that only built-in measures can have";
    if (!key->about) return "says nothing about itself";
    if (reference && !m->curve) return "names a curve or place, but nothing is asked for there";
    if (key->kind <= VES_COUNT) return number_fault(key);
    if (key->kind == VES_FLAG && key->fallback != 0 && key->fallback != 1)
        return "has a fallback but 0 and 1";
    if (key->kind != VES_CHOICE) return NULL;
    if (!sound_words(key->words)) return "lacks the words to choose from";
    bool inside = key->fallback >= 0 && key->fallback < ves_words_count(key->words);
    return inside ? NULL : "has a fallback that is none of its words";
}

static const char *name_fault(const ves_measure *m, int index)
{
    const char *name = m->keys[index].name;
    if (!is_word(name)) return "has a name that is no word: letters, digits and _, a letter first";
    if (m->surface && !strcmp(name, "over"))
        return "has the name of a key that every measure of surfaces has";
    for (int k = 0; k < index; k++)
        if (!strcmp(m->keys[k].name, name)) return "is there twice";
    return NULL;
}

/* A table ends with zeros: a key that only lacks its name would cut it short. */
static bool is_end(const ves_key *key)
{
    return !key->kind && !key->about && !key->words && !key->unit;
}

static ves_status check_keys(const ves_measure *m, ves_diag *diag)
{
    int k = 0;
    for (; m->keys && m->keys[k].name; k++) {
        const char *what = k < VES_MEASURE_KEYS ? name_fault(m, k) : "is one too many";
        if (!what) what = kind_fault(m, &m->keys[k]);
        if (what) return key_fault(diag, m, m->keys[k].name, what);
    }
    return !m->keys || is_end(&m->keys[k]) ? VES_OK : fault(diag, m, "has a key without a name");
}

static const char *mask_fault(const ves_measure *m)
{
    if ((m->surface | m->cap | m->curve) & ~(unsigned)EVERYTHING)
        return "asks for something that this version of vesica does not know";
    if (m->curve & ~(unsigned)ALONG) return "asks curves and places for more than X, Xv and Xvv";
    return m->surface | m->cap | m->curve ? NULL : "reads nothing: surface, cap and curve are 0";
}

static const char *measure_name_fault(const char *name)
{
    if (!is_word(name)) return "has a name that is no word: letters, digits and _, a letter first";
    if (ves_measure_find(name, NULL)) return "has the name of a built-in one";
    if (ves_words_find(ves_names_reserved, name) >= 0)
        return "has a name with a meaning of its own in formulas";
    return NULL;
}

ves_status ves_measure_check(const ves_measure *m, ves_diag *diag)
{
    if (!m->name || !*m->name)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, (ves_mark){0}, "a measure from outside has no name");
    const char *what = measure_name_fault(m->name);
    if (what) return fault(diag, m, what);
    if (!m->about) return fault(diag, m, "says nothing about itself");
    if (!m->eval) return fault(diag, m, "has no eval");
    if (!readable(m->unit))
        return fault(diag, m, "has no unit that can be read; of a plain number it is \"1\"");
    if (m->looks < 0 || m->looks > VES_MEASURE_LOOKS)
        return fault(diag, m, "has a number of looks that is not 0 .. 8");
    if (m->looks && !m->surface) return fault(diag, m, "looks at surfaces but asks for nothing there");
    what = mask_fault(m);
    return what ? fault(diag, m, what) : check_keys(m, diag);
}

ves_status ves_measures_check(const ves_measure *const *list, ves_diag *diag)
{
    for (int k = 0; list && list[k]; k++) {
        VES_TRY(ves_measure_check(list[k], diag));
        for (int i = 0; i < k; i++)
            if (!strcmp(list[i]->name, list[k]->name)) return fault(diag, list[k], "is there twice");
    }
    return VES_OK;
}
