/* Descriptors of measures from outside: what is refused, in which words, and what is taken. Which sample
 * belongs to which key. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "measure/registry.h"

static ves_status eval(const ves_measure_input *input, double *value)
{
    *value = input->samples;
    return VES_OK;
}

static const ves_measure sound = {
    .name = "mine", .about = "one of mine", .unit = "m^2", .surface = VES_X | VES_AREA, .eval = eval};

static void refused(const ves_measure *m, const char *want)
{
    char got[400] = "";
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_measure_check(m, diag);
    ves_diag_text(diag, 0, got, sizeof got);
    cr_expect(status == VES_RANGE && ves_diag_count(diag) == 1 && strstr(got, want),
              "status %d, got \"%s\", want \"%s\"", status, got, want);
    ves_diag_destroy(diag);
}

Test(measure_check, a_sound_descriptor_is_taken_whatever_it_may_ask_for)
{
    static const ves_key keys[] = {
        {.name = "k",
         .kind = VES_NUMBER,
         .unit = "J",
         .min = VES_POSITIVE,
         .max = HUGE_VAL,
         .fallback = NAN,
         .about = "a"},
        {.name = "n", .kind = VES_COUNT, .min = 1, .max = 9, .fallback = 3, .about = "b"},
        {.name = "way", .kind = VES_CHOICE, .words = "up|down", .fallback = 1, .about = "c"},
        {.name = "to", .kind = VES_PLACE, .about = "d"},
        {.name = "along", .kind = VES_VECTOR, .about = "e"},
        {0}};
    ves_measure m = sound;
    cr_assert(ves_measure_check(&m, NULL) == VES_OK);
    m.surface = 511, m.cap = 511, m.curve = VES_X | VES_XV | VES_XVV, m.keys = keys;
    cr_assert(ves_measure_check(&m, NULL) == VES_OK);
    cr_assert(ves_measures_check((const ves_measure *const[]){&m, NULL}, NULL) == VES_OK);
    cr_assert(ves_measures_check(NULL, NULL) == VES_OK);
}

Test(measure_check, a_descriptor_that_lacks_something_is_refused_in_words)
{
    ves_measure m = sound;
    m.name = NULL, refused(&m, "a measure from outside has no name");
    static const char *const words[][2] = {{"", "has no name"},
                                           {"my-own", "is no word"},
                                           {"2nd", "is no word"},
                                           {"a.b", "is no word"},
                                           {"area", "\"area\" from outside has the name of a built-in one"},
                                           {"sin", "a meaning of its own in formulas"},
                                           {"pi", "a meaning of its own in formulas"},
                                           {"and", "a meaning of its own in formulas"},
                                           {"violation", "a meaning of its own in formulas"}};
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) m.name = words[k][0], refused(&m, words[k][1]);
    m = sound, m.about = NULL, refused(&m, "\"mine\" from outside says nothing about itself");
    m = sound, m.eval = NULL, refused(&m, "has no eval");
    static const char *const units[] = {NULL, "", "metres", "*m^2", "m^"};
    for (int k = 0; k < 5; k++) m = sound, m.unit = units[k], refused(&m, "has no unit that can be read");
    for (int k = 0; k < 3; k++) {
        m = sound;
        *(k == 0 ? &m.surface : k == 1 ? &m.cap : &m.curve) |= 1u << 9;
        refused(&m, "this version of vesica does not know");
    }
    static const unsigned nowhere[] = {VES_XU, VES_XUU, VES_XUV, VES_NORMAL, VES_AREA, VES_CURVATURE};
    for (int k = 0; k < 6; k++)
        m = sound, m.curve = VES_X | nowhere[k], refused(&m, "curves and places for more than X, Xv and Xvv");
    m = sound, m.surface = 0, refused(&m, "reads nothing");
    m = sound, m.looks = -1, refused(&m, "has a number of looks that is not 0 .. 8");
    m = sound, m.looks = 9, refused(&m, "has a number of looks that is not 0 .. 8");
    m = sound, m.surface = 0, m.looks = 1, refused(&m, "looks at surfaces but asks for nothing there");
}

Test(measure_check, keys_that_nobody_could_answer_are_refused_in_words)
{
    static const struct {
        ves_key key;
        const char *want;
    } row[] = {
        {{.name = "a b", .kind = VES_NUMBER, .about = ""}, "its key \"a b\" has a name that is no word"},
        {{.name = "over", .kind = VES_NUMBER, .about = ""},
         "its key \"over\" has the name of a key that every"},
        {{.name = "first", .kind = VES_NUMBER, .about = ""}, "its key \"first\" is there twice"},
        {{.kind = VES_NUMBER, .about = "lost"}, "has a key without a name"},
        {{.name = "k", .about = ""}, "its key \"k\" is of no kind"},
        {{.name = "k", .kind = (ves_kind)64, .about = ""}, "is of no kind"},
        {{.name = "k", .kind = VES_NUMBER}, "says nothing about itself"},
        {{.name = "k", .kind = VES_FORMULAS, .about = ""}, "only built-in measures"},
        {{.name = "k", .kind = VES_POINTWISE, .about = ""}, "only built-in measures"},
        {{.name = "k", .kind = VES_CURVE, .about = ""}, "nothing is asked for there"},
        {{.name = "k", .kind = VES_PLACE, .about = ""}, "nothing is asked for there"},
        {{.name = "k", .kind = VES_NUMBER, .unit = "metres", .about = ""}, "a unit that cannot be read"},
        {{.name = "k", .kind = VES_VECTOR, .min = 2, .max = 1, .about = ""}, "an empty range"},
        {{.name = "k", .kind = VES_VECTOR, .min = NAN, .max = 1, .about = ""}, "an empty range"},
        {{.name = "k", .kind = VES_COUNT, .fallback = NAN, .about = ""}, "a fallback that is no such number"},
        {{.name = "k", .kind = VES_NUMBER, .fallback = HUGE_VAL, .about = ""},
         "a fallback that is no such number"},
        {{.name = "k", .kind = VES_FLAG, .fallback = 2, .about = ""}, "a fallback but 0 and 1"},
        {{.name = "k", .kind = VES_CHOICE, .about = ""}, "lacks the words to choose from"},
        {{.name = "k", .kind = VES_CHOICE, .words = "a||b", .about = ""}, "lacks the words to choose from"},
        {{.name = "k", .kind = VES_CHOICE, .words = "a|b", .fallback = 2, .about = ""}, "none of its words"},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        const ves_key keys[] = {{.name = "first", .kind = VES_NUMBER, .about = "sound"}, row[k].key, {0}};
        ves_measure m = sound;
        m.keys = keys;
        refused(&m, row[k].want);
    }
    ves_key many[40] = {{0}};
    char name[40][8];
    for (int k = 0; k < 39; k++) {
        snprintf(name[k], sizeof name[k], "k%d", k);
        many[k] = (ves_key){.name = name[k], .kind = VES_NUMBER, .about = "one of many"};
    }
    ves_measure m = sound;
    m.keys = many, refused(&m, "its key \"k30\" is one too many");
}

/* An optional key that was not given has no sample: the others are found all the same. */
Test(measure_check, the_sample_of_a_key_is_found_by_the_keys_that_were_given)
{
    static const ves_key key[] = {{.name = "a", .kind = VES_PLACE},
                                  {.name = "b", .kind = VES_NUMBER},
                                  {.name = "c", .kind = VES_CURVE},
                                  {.name = "d", .kind = VES_PLACE}};
    const ves_samples some[5] = {{.patch = 0}, {.patch = 1}, {.patch = 2}, {.patch = 3}, {.patch = 4}};
    const ves_samples *sample[5] = {&some[0], &some[1], &some[2], &some[3], &some[4]};
    for (int given = 0; given < 16; given++) {
        ves_arg arg[4] = {{0}};
        int want = 2; /* two surfaces come first */
        for (int k = 0; k < 4; k++) arg[k].given = given >> k & 1;
        const ves_args args = {.key = key, .arg = arg, .count = 4};
        ves_measure_input input = {.samples = 2 + arg[0].given + arg[2].given + arg[3].given};
        input.sample = sample, input.args = &args;
        for (int k = 0; k < 4; k++) {
            if (key[k].kind == VES_NUMBER) continue;
            const ves_samples *got = ves_sample_of(&input, k);
            int index = ves_sample_index(&input, k);
            if (arg[k].given)
                cr_assert(index == want && got == sample[want], "keys %x, key %d: got %d, want %d", given, k,
                          index, want);
            else
                cr_assert(index == -1 && !got, "keys %x, key %d: got %d, want none", given, k, index);
            want += arg[k].given;
        }
    }
}
