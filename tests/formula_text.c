/* Formulas: dimensions, units, messages, limits. */
#include "formula_shelf.h"

#define PI 3.14159265358979323846

static ves_dim dim(const char *text)
{
    ves_dim d = {.any = true};
    cr_assert(ves_dim_read(text, &d, NULL), "%s", text);
    return d;
}

/* Names with dimensions; s, m and min are names that are units too. */
static ves_scope physical(ves_symbol slot[8], ves_symbol argument[2])
{
    const char *const name[8][2] = {{"radius", "m"}, {"wall", "mm"}, {"load", "N/m"}, {"rho", "kg/m^3"},
                                    {"n", "1"},      {"s", "1"},     {"m", "kg"},     {"rim.height", "m"}};
    for (int k = 0; k < 8; k++) slot[k] = (ves_symbol){name[k][0], dim(name[k][1])};
    argument[0] = (ves_symbol){"area", dim("m^2")};
    argument[1] = (ves_symbol){"x", dim("m")};
    return (ves_scope){slot, 8, argument, 2, true};
}

Test(formula_text, dimensions_follow_the_operations)
{
    static const char *const row[][2] = {
        {"radius", "m"},
        {"radius + 2 mm", "m"},
        {"radius - wall", "m"},
        {"radius*wall", "m^2"},
        {"area*wall*rho", "kg"},
        {"load/wall", "kg/(m s^2)"},
        {"15 N/m", "kg/s^2"},
        {"15 N/m^2", "kg/(m s^2)"},
        {"2 mm*s", "m s"},
        {"(2 mm)*s", "m"},
        {"sqrt(area)", "m"},
        {"sqrt(radius)", "m^(1/2)"},
        {"radius^3", "m^3"},
        {"radius^-1", "1/m"},
        {"(area*radius)^(1/3)", "m"},
        {"area^1.5", "m^3"},
        {"radius^(2/3)", "m^(2/3)"},
        {"radius/wall", "1"},
        {"sin(radius/wall)", "1"},
        {"min(radius, 2 mm, wall)", "m"},
        {"max(radius, 0)", "m"},
        {"max(0, radius)", "m"},
        {"hypot(radius, wall, 1 cm)", "m"},
        {"atan2(radius, wall)", "1"},
        {"sign(load)", "1"},
        {"abs(-load)", "kg/s^2"},
        {"mod(radius, wall)", "m"},
        {"if(radius > wall, radius, 0)", "m"},
        {"if(x > 4*wall, 1, 0)*rho", "kg/m^3"},
        {"radius > 0", "1"},
        {"0", "any"},
        {"-0 + radius", "m"},
        {"0 mm", "m"},
        {"10 deg", "1"},
        {"2^n", "1"},
        {"rim.height*n", "m"},
        {"3 J/(m^2)", "kg/s^2"},
        {"3 kg/(m s^2)", "kg/(m s^2)"},
        {"2 N*m/s", "kg m^2/s^3"},
        {"5 kg*m^2", "kg m^2"},
        {"1 m^(1/2)", "m^(1/2)"},
    };
    ves_symbol slot[8], argument[2];
    ves_scope scope = physical(slot, argument);
    ves_arena arena = {0};
    char got[48];
    for (int k = 0; k < COUNT(row); k++) {
        ves_dim_text(ves_formula_dim(compiled(row[k][0], &scope, &arena)), got);
        cr_expect(!strcmp(got, row[k][1]), "%s: got %s want %s", row[k][0], got, row[k][1]);
    }
    const ves_formula *f = compiled("radius*x^2", &scope, &arena);
    ves_dim_text(ves_formula_dim(ves_formula_derivative(f, 1, &arena)), got);
    cr_expect(!strcmp(got, "m^2"), "derivative of a volume by a length: %s", got);
    ves_dim_text(ves_formula_dim(ves_formula_derivative(ves_formula_derivative(f, 1, &arena), 1, &arena)),
                 got);
    cr_expect(!strcmp(got, "m"), "second derivative: %s", got);
    ves_arena_destroy(&arena);
}

Test(formula_text, has_units_only_when_a_dimension_was_written)
{
    static const struct {
        const char *text;
        bool units;
    } row[] = {{"2 mm", true},  {"2*radius", false}, {"10 deg", false},
               {"30 %", false}, {"1 Hz", true},      {"0 m/s", true}};
    ves_symbol slot[8], argument[2];
    ves_scope scope = physical(slot, argument);
    ves_arena arena = {0};
    for (int k = 0; k < COUNT(row); k++)
        for (int checked = 0; checked < 2; checked++) {
            scope.dimensions = checked;
            const ves_formula *f = compiled(row[k].text, &scope, &arena);
            cr_expect(ves_formula_has_units(f) == row[k].units, "%s", row[k].text);
        }
    scope.dimensions = false; /* then everything fits, and units still scale */
    const ves_formula *f = compiled("2 mm + 3 s + sin(1 N)^x", &scope, &arena);
    cr_expect(ves_formula_dim(f).any);
    f = compiled("2 mm + 3 s", &scope, &arena);
    cr_expect(evaluated(f) == 3.002, "%.17g", evaluated(f));
    ves_arena_destroy(&arena);
}

typedef struct wrong {
    const char *text;
    ves_status status;
    int offset, length;
    const char *message;
} wrong;

static void check_wrong(const wrong *row, int count, const ves_scope *scope)
{
    ves_arena arena = {0};
    for (int k = 0; k < count; k++) {
        const ves_formula *formula = (const ves_formula *)&arena;
        ves_formula_error e;
        ves_status status = ves_formula_compile(row[k].text, scope, &arena, &formula, &e);
        bool same = status == row[k].status && e.status == status && !formula && e.offset == row[k].offset &&
                    e.length == row[k].length && !strcmp(e.text, row[k].message);
        cr_expect(same, "%s\n   got %d at %d+%d: %s\n  want %d at %d+%d: %s", row[k].text, status, e.offset,
                  e.length, e.text, row[k].status, row[k].offset, row[k].length, row[k].message);
    }
    ves_arena_destroy(&arena);
}

Test(formula_text, syntax_errors_point_at_the_place_and_help)
{
    static const wrong row[] = {
        {"", VES_SYNTAX, 0, 1, "the formula is empty"},
        {"  \t", VES_SYNTAX, 0, 1, "the formula is empty"},
        {"a = 2", VES_SYNTAX, 2, 1, "write == to compare"},
        {"1,5", VES_SYNTAX, 1, 1, "\",\" is no decimal sign: write a point"},
        {"2*(1,5 + a)", VES_SYNTAX, 4, 1, "\",\" is no decimal sign: write a point"},
        {"a, b", VES_SYNTAX, 1, 1, "\",\" belongs between the arguments of a function"},
        {"0x10", VES_SYNTAX, 0, 4, "hexadecimal numbers are not read; write a decimal number"},
        {"2 + 0xff", VES_SYNTAX, 4, 4, "hexadecimal numbers are not read; write a decimal number"},
        {"1_000", VES_SYNTAX, 0, 5, "digits are not grouped; write 1000, not 1_000"},
        {"0.1_000", VES_SYNTAX, 0, 7, "digits are not grouped; write 1000, not 1_000"},
        {".1_000", VES_SYNTAX, 0, 6, "digits are not grouped; write 1000, not 1_000"},
        {"1.2.3", VES_SYNTAX, 0, 4, "a number has one decimal point"},
        {"1e999", VES_SYNTAX, 0, 5, "this number is too large: numbers end at 1.8e308"},
        {"2a", VES_SYNTAX, 1, 1, "an operator is missing before \"a\": write 2*a"},
        {"2.5 pi", VES_SYNTAX, 4, 2, "an operator is missing before \"pi\": write 2.5*pi"},
        {"3 sin(v)", VES_SYNTAX, 2, 3, "an operator is missing before \"sin\": write 3*sin"},
        {"2(a + b)", VES_SYNTAX, 1, 1, "an operator is missing before \"(\""},
        {"a b", VES_SYNTAX, 2, 1, "an operator is missing before \"b\""},
        {"(a)(b)", VES_SYNTAX, 3, 1, "an operator is missing before \"(\""},
        {"a(2)", VES_SYNTAX, 0, 1, "\"a\" is not a function: write a*(...)"},
        {"(a + b", VES_SYNTAX, 0, 1, "\"(\" is never closed"},
        {"2*((a + b)", VES_SYNTAX, 2, 1, "\"(\" is never closed"},
        {"sin(v", VES_SYNTAX, 3, 1, "\"(\" is never closed"},
        {"a + b)", VES_SYNTAX, 5, 1, "\")\" without \"(\""},
        {"()", VES_SYNTAX, 1, 1, "a number or a name is missing before \")\""},
        {"a +", VES_SYNTAX, 3, 1, "the formula ends where a number or a name is needed"},
        {"a + * b", VES_SYNTAX, 4, 1, "a number or a name is missing before \"*\""},
        {"a and", VES_SYNTAX, 5, 1, "the formula ends where a number or a name is needed"},
        {"and a", VES_SYNTAX, 0, 3, "a number or a name is missing before \"and\""},
        {"sin v", VES_SYNTAX, 0, 3, "\"sin\" is a function: write sin(...)"},
        {"sin()", VES_SYNTAX, 0, 3, "\"sin\" takes 1 argument, found 0"},
        {"sin(a,)", VES_SYNTAX, 6, 1, "a number or a name is missing before \")\""},
        {"sin(1,5)", VES_SYNTAX, 0, 3, "\"sin\" takes 1 argument, found 2 (a comma is no decimal sign)"},
        {"atan2(1)", VES_SYNTAX, 0, 5, "\"atan2\" takes 2 arguments, found 1"},
        {"hypot(1)", VES_SYNTAX, 0, 5, "\"hypot\" takes 2 to 3 arguments, found 1"},
        {"a + if(a, b)", VES_SYNTAX, 4, 2, "\"if\" takes 3 arguments, found 2"},
        {"a < b < c", VES_SYNTAX, 6, 1, "comparisons cannot be chained: write a < b and b < c"},
        {"a*not b", VES_SYNTAX, 2, 3, "put parentheses around \"not ...\" here"},
        {"a ** 2", VES_SYNTAX, 2, 2, "a power is written with ^"},
        {"a && b", VES_SYNTAX, 2, 2, "write \"and\""},
        {"a || b", VES_SYNTAX, 2, 2, "write \"or\""},
        {"|a|", VES_SYNTAX, 0, 1, "write \"or\", or abs(x)"},
        {"!a", VES_SYNTAX, 0, 1, "write \"not\"; there is no factorial"},
        {"a => b", VES_SYNTAX, 2, 2, "write >="},
        {"a ? b : c", VES_SYNTAX, 2, 1, "write if(condition, a, b)"},
        {"a % b", VES_SYNTAX, 2, 1, "% must follow a number; the rest of a division is mod(a, b)"},
        {"a \xE2\x88\x92 b", VES_SYNTAX, 2, 3, "this is not the minus of the keyboard; write -"},
        {"3 \xC2\xB5m", VES_SYNTAX, 2, 2, "write u for micro, as in um"},
        {"a\xC2\xB2", VES_SYNTAX, 1, 2, "write ^2"},
        {"a $ b", VES_SYNTAX, 2, 1, "this character has no meaning in a formula"},
        {"\xF0\x9F\x98\x80", VES_SYNTAX, 0, 4, "this character has no meaning in a formula"},
        {"\x80\xFF", VES_SYNTAX, 0, 1, "this character has no meaning in a formula"},
        {"a mm", VES_SYNTAX, 2, 2,
         "an operator is missing before \"mm\"; a unit follows a number, and units are joined by * and /"},
        {"2 N m", VES_SYNTAX, 4, 1,
         "an operator is missing before \"m\"; a unit follows a number, and units are joined by * and /"},
        {"2 mm^a", VES_SYNTAX, 5, 1,
         "a unit's exponent is a small whole number, or a fraction as in m^(1/2); a power of the whole is "
         "written (2 "
         "mm)^x"},
        {"2 mm^0.5", VES_SYNTAX, 5, 3,
         "a unit's exponent is a small whole number, or a fraction as in m^(1/2); a power of the whole is "
         "written (2 "
         "mm)^x"},
    };
    check_wrong(row, COUNT(row), &plain);
}

Test(formula_text, unknown_names_are_answered_with_near_ones)
{
    static const wrong row[] = {
        {"radius*coss(x/radius)", VES_NAME, 7, 4, "unknown function \"coss\", did you mean \"cos\"?"},
        {"2*raduis", VES_NAME, 2, 6, "unknown name \"raduis\", did you mean \"radius\"?"},
        {"Radius", VES_NAME, 0, 6, "unknown name \"Radius\", did you mean \"radius\"?"},
        {"rim.heigth", VES_NAME, 0, 10, "unknown name \"rim.heigth\", did you mean \"rim.height\"?"},
        {"ara", VES_NAME, 0, 3, "unknown name \"ara\", did you mean \"area\"?"},
        {"zzzzzz + 1", VES_NAME, 0, 6, "unknown name \"zzzzzz\""},
        {"q", VES_NAME, 0, 1, "unknown name \"q\""},
        {"2*X", VES_NAME, 2, 1, "unknown name \"X\", did you mean \"x\"?"},
        {"zzzzzz(1)", VES_NAME, 0, 6, "unknown function \"zzzzzz\""},
        {"ln(2)", VES_NAME, 0, 2, "unknown function \"ln\", write log(x)"},
        {"pow(2, 3)", VES_NAME, 0, 3, "unknown function \"pow\", write x^y"},
        {"mm", VES_NAME, 0, 2, "unknown name \"mm\"; as a unit it must follow a number: 1 mm"},
        {"radius/cm", VES_NAME, 7, 2, "unknown name \"cm\"; as a unit it must follow a number: 1 cm"},
        {"2 mmm", VES_UNIT, 2, 3, "unknown unit \"mmm\", did you mean \"mm\"?"},
        {"2 KPa", VES_UNIT, 2, 3, "unknown unit \"KPa\", did you mean \"kPa\"?"},
        {"5 t", VES_UNIT, 2, 1, "unknown unit \"t\"; a product is written 5*t"},
        {"5 parsec", VES_UNIT, 2, 6, "unknown unit \"parsec\"; a product is written 5*parsec"},
        {"2radius", VES_SYNTAX, 1, 6, "an operator is missing before \"radius\": write 2*radius"},
    };
    ves_symbol slot[8], argument[2];
    ves_scope scope = physical(slot, argument);
    check_wrong(row, COUNT(row), &scope);
}

Test(formula_text, dimension_errors_name_both_sides)
{
    static const wrong row[] = {
        {"radius + 2 MPa", VES_UNIT, 7, 1, "adds a length (m) to a pressure (kg/(m s^2))"},
        {"radius - area", VES_UNIT, 7, 1, "subtracts an area (m^2) from a length (m)"},
        {"radius + 2", VES_UNIT, 7, 1, "adds a length (m) to a plain number"},
        {"rho > 2 J", VES_UNIT, 4, 1, "compares a density (kg/m^3) with an energy (kg m^2/s^2)"},
        {"min(radius, 1, wall)", VES_UNIT, 12, 1, "\"min\" of a length (m) and a plain number"},
        {"max(0, radius, 1 s)", VES_UNIT, 15, 3,
         "\"max\" of a length (m) and a time (s); \"s\" is a unit here: write 1*s"},
        {"hypot(load, 1 N)", VES_UNIT, 12, 3,
         "\"hypot\" of a force per length (kg/s^2) and a force (kg m/s^2)"},
        {"if(radius, 1, 2)", VES_UNIT, 3, 6, "\"if\" needs a plain number, found a length (m)"},
        {"if(n, radius, m)", VES_UNIT, 14, 1, "\"if\" of a length (m) and a mass (kg)"},
        {"sin(2*radius)", VES_UNIT, 4, 8, "\"sin\" needs a plain number, found a length (m)"},
        {"radius and n", VES_UNIT, 0, 6, "\"and\" needs plain numbers, found a length (m)"},
        {"not area", VES_UNIT, 4, 4, "\"not\" needs a plain number, found an area (m^2)"},
        {"2^radius", VES_UNIT, 2, 6, "an exponent must be a plain number, found a length (m)"},
        {"radius^n", VES_UNIT, 7, 1, "the exponent must be a constant number, for the base is a length (m)"},
        {"radius^0.7", VES_UNIT, 7, 3, "a length (m) to the power 0.7 has no dimension"},
        {"radius^100", VES_UNIT, 7, 3, "a length (m) to the power 100 has no dimension"},
        {"radius^20*radius^20", VES_UNIT, 9, 1, "the dimension of the product is out of range"},
        {"(1 kg*m^2/s) + radius", VES_UNIT, 13, 1,
         "adds a quantity in kg m^2/s to a length (m); \"m\" is a unit here: write (1 kg)*m"},
        {"radius + 2 mm*s", VES_UNIT, 7, 1,
         "adds a length (m) to a quantity in m s; \"s\" is a unit here: write (2 mm)*s"},
        {"2 N/m + 1 N", VES_UNIT, 6, 1,
         "adds a force per length (kg/s^2) to a force (kg m/s^2); \"m\" is a unit here: write (2 N)/m"},
        {"0.5 m + m", VES_UNIT, 6, 1, "adds a length (m) to a mass (kg); \"m\" is a unit here: write 0.5*m"},
    };
    ves_symbol slot[8], argument[2];
    ves_scope scope = physical(slot, argument);
    check_wrong(row, COUNT(row), &scope);
}

Test(formula_text, units_read_and_write)
{
    static const struct {
        const char *unit, *dim;
        double factor;
    } row[] = {{"m", "m", 1},
               {"mm", "m", 1e-3},
               {"N/m", "kg/s^2", 1},
               {"m^2", "m^2", 1},
               {"1", "1", 1},
               {"1/m", "1/m", 1},
               {"1/(m s)", "1/(m s)", 1},
               {"kg/(m s^2)", "kg/(m s^2)", 1},
               {"kg m^2/s^2", "kg m^2/s^2", 1},
               {"N*m", "kg m^2/s^2", 1},
               {"g/cm^3", "kg/m^3", 1000},
               {"ml", "m^3", 1e-6},
               {"l", "m^3", 1e-3},
               {"GPa", "kg/(m s^2)", 1e9},
               {"bar", "kg/(m s^2)", 1e5},
               {"km/h", "m/s", 1 / 3.6},
               {"deg", "1", PI / 180},
               {"%", "1", 0.01},
               {"Hz", "1/s", 1},
               {"kJ", "kg m^2/s^2", 1000},
               {"W", "kg m^2/s^3", 1},
               {"us", "s", 1e-6},
               {"min", "s", 60},
               {"m^(1/2)", "m^(1/2)", 1},
               {"m^(-2/3)", "1/m^(2/3)", 1},
               {"mm^-2", "1/m^2", 1e6}};
    for (int k = 0; k < COUNT(row); k++) {
        ves_dim d;
        double factor;
        char text[48];
        cr_assert(ves_dim_read(row[k].unit, &d, &factor), "%s", row[k].unit);
        ves_dim_text(d, text);
        cr_expect(!strcmp(text, row[k].dim), "%s: got %s want %s", row[k].unit, text, row[k].dim);
        /* products of exact powers of ten, one division: 1 ulp */
        cr_expect(near(factor, row[k].factor, 3e-16), "%s: got %.17g want %.17g", row[k].unit, factor,
                  row[k].factor);
    }
    static const char *const bad[] = {"",    "t",         "2",  "m/",    "m^",   "m^0.5",
                                      "m^x", "kg/(m s^2", "m)", "m s +", "m^99", "(m)"};
    for (int k = 0; k < COUNT(bad); k++) {
        ves_dim d;
        cr_expect(!ves_dim_read(bad[k], &d, NULL), "%s was read", bad[k]);
    }
    for (int m = -127; m <= 127; m += 5)
        for (int kg = -127; kg <= 127; kg += 7)
            for (int s = -127; s <= 127; s += 11) {
                ves_dim d = {(signed char)m, (signed char)kg, (signed char)s, false}, back;
                char text[48];
                ves_dim_text(d, text);
                bool same = ves_dim_read(text, &back, NULL) && ves_dim_equal(d, back);
                cr_assert(same, "%d %d %d: %s does not read back", m, kg, s, text);
            }
}

Test(formula_text, splits_at_the_one_comparison)
{
    static const struct {
        const char *text, *operator, * left, *right;
    } row[] = {{"area <= 14", "<=", "area", "14"},
               {"volume == 150 ml", "==", "volume", "150 ml"},
               {"a<b", "<", "a", "b"},
               {"max(a, (b > c)) >= 2 ", ">=", "max(a, (b > c))", "2 "},
               {" a  >  b", ">", " a", "b"},
               {"a <=", "<=", "a", ""},
               {"a", NULL, NULL, NULL},
               {"", NULL, NULL, NULL},
               {"a < b < c", NULL, NULL, NULL},
               {"a = b", NULL, NULL, NULL},
               {"(a < b)", NULL, NULL, NULL},
               {"a != b", NULL, NULL, NULL}};
    for (int k = 0; k < COUNT(row); k++) {
        char operator[3];
        int left, right;
        ves_status status = ves_formula_split(row[k].text, operator, & left, &right);
        cr_assert(status == (row[k].operator? VES_OK : VES_SYNTAX), "%s", row[k].text);
        if (!row[k].operator) continue;
        bool same = !strcmp(operator, row[k].operator) && strlen(row[k].left) == (size_t)left &&
                    !strncmp(row[k].text, row[k].left, (size_t)left) &&
                    !strcmp(row[k].text + right, row[k].right);
        cr_expect(same, "%s: %.*s|%s|%s", row[k].text, left, row[k].text, operator, row[k].text + right);
    }
}

/* piece repeated to about `size` bytes */
static char *repeated(const char *piece, size_t size)
{
    size_t length = strlen(piece), times = size / length;
    char *text = malloc(times * length + 1);
    cr_assert(text != NULL);
    for (size_t k = 0; k < times; k++) memcpy(text + k * length, piece, length);
    text[times * length] = 0;
    return text;
}

Test(formula_text, long_and_deep_texts_are_errors)
{
    static const char *const piece[] = {
        "(",        "-",  "+",    "not ", "a^",     "a*",     "sin(",    "if(a,",    "1+",    "a)",
        "9e9",      "9.", "2 m*", "a<",   "a and ", "min(a,", "hypot",   "a.",       "2 mm^", "2/(m ",
        "-(-a+b)*", "@",  "\xFF", "1,",   "((a)",   "u*v+",   "sin(u)*", "(u+v)^3-", "2^"};
    ves_arena arena = {0};
    const ves_formula *formula;
    ves_formula_error e;
    for (int k = 0; k < COUNT(piece); k++)
        for (size_t size = 100; size <= 100000; size *= 10) {
            char *text = repeated(piece[k], size);
            ves_status status = ves_formula_compile(text, &plain, &arena, &formula, &e);
            bool shown = e.offset >= 0 && e.offset <= (int)strlen(text) && e.length > 0 && e.text[0];
            cr_expect(status < 0 && !formula && shown, "%s x %zu: %d at %d: %s", piece[k], size, status,
                      e.offset, e.text);
            free(text);
        }
    char *text = repeated("a+", 99000);
    text[strlen(text) - 1] = 0;
    cr_expect(ves_formula_compile(text, &plain, &arena, &formula, &e) == VES_SYNTAX);
    cr_expect(!strcmp(e.text, "a formula has at most 65536 bytes"), "%s", e.text);
    text[60001] = 0;
    cr_expect(ves_formula_compile(text, &plain, &arena, &formula, &e) == VES_SYNTAX);
    cr_expect(!strcmp(e.text, "a formula has at most 10000 operations"), "%s", e.text);
    text[1001] = 0;
    cr_expect(ves_formula_compile(text, &plain, &arena, &formula, &e) == VES_OK, "%s", e.text);
    free(text);
    text = repeated("(", 400);
    strcpy(text + 150, "a");
    for (int k = 0; k < 150; k++) strcat(text, ")");
    cr_expect(ves_formula_compile(text, &plain, &arena, &formula, &e) == VES_OK, "%s", e.text);
    free(text);
    ves_arena_destroy(&arena);
}

Test(formula_text, random_texts_give_a_formula_or_an_error_inside_the_text)
{
    static const char *const word[] = {
        "a", "b", "u",       "v",  "2",   "0.5",  "1e3",  "mm", "kg",  "m",  "s",   "^", "*",  "/",     "+",
        "-", "(", ")",       ",",  "sin", "sqrt", "min",  "if", "and", "or", "not", "<", "==", "=",     "%",
        " ", " ", "m^(1/2)", "pi", ".",   "_",    "\xC2", "\n", "x",   "@",  "e",   "(", ")",  "hypot("};
    ves_arena arena = {0};
    int good = 0;
    for (int k = 0; k < 40000; k++) {
        ves_random random = {.seed = 7, .step = (uint64_t)k};
        char text[200] = "";
        for (int n = ves_random_below(&random, 14); n >= 0; n--)
            strcat(text, word[ves_random_below(&random, COUNT(word))]);
        const ves_formula *formula;
        ves_formula_error e;
        ves_status status = ves_formula_compile(text, &plain, &arena, &formula, &e);
        bool inside = e.offset >= 0 && e.length > 0 && e.offset + e.length <= (int)strlen(text) + 1;
        cr_expect(status == VES_OK ? formula != NULL : !formula && inside && e.text[0], "%s: %d at %d+%d %s",
                  text, status, e.offset, e.length, e.text);
        if (status == VES_OK) {
            const ves_formula *d = ves_formula_derivative(formula, 0, &arena);
            good += d && (evaluated(formula), evaluated(d), true);
        }
        if (k % 1000 == 0) ves_arena_destroy(&arena);
    }
    cr_expect(good > 500, "%d", good);
    ves_arena_destroy(&arena);
}

Test(formula_text, the_unit_that_a_text_uses)
{
    static const struct {
        const char *text, *dim, *unit;
        double factor;
    } list[] = {
        {"150 ml", "m^3", "ml", 1e-6},
        {"volume == 150 ml", "m^3", "ml", 1e-6},
        {"area < 85.95 cm^2", "m^2", "cm^2", 1e-4},
        {"2*L + 3mm", "m", "mm", 1e-3},
        {"t <= 2 kN/(m s) * 1", "kg/s^3", "kN/(m s)", 1000},
        {"15 N/m + x", "kg/s^2", "N/m", 1},
        {"r >= 3 mm and a < 2 cm^2", "m^2", "cm^2", 1e-4},
        {"3*h", "s", NULL, 0},
        {"3 m", "m^2", NULL, 0},
        {"-20 deg", "1", "deg", 3.14159265358979324 / 180},
        {"30 %", "1", "%", 0.01},
        {"a*20 deg", "1", NULL, 0},
        {"20 deg*a", "1", NULL, 0},
        {"7", "1", NULL, 0},
        {"", "m", NULL, 0},
        {"3 $", "m", NULL, 0},
    };
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        ves_dim dim;
        char unit[VES_UNIT_TEXT] = "";
        double factor = 0;
        cr_assert(ves_dim_read(list[k].dim, &dim, NULL));
        bool found = ves_unit_find(list[k].text, dim, unit, &factor);
        cr_assert(found == (list[k].unit != NULL), "%s in \"%s\": %s", list[k].dim, list[k].text, unit);
        if (!found) continue;
        cr_assert(!strcmp(unit, list[k].unit), "\"%s\": got %s, want %s", list[k].text, unit, list[k].unit);
        /* products of a few factors: some ulp */
        cr_assert(fabs(factor - list[k].factor) <= 1e-15 * list[k].factor, "%s: %.17g", unit, factor);
    }
}

/* A token that cannot be read is stepped over: splitting ends. */
Test(formula_text, wrong_tokens_do_not_stop_a_split)
{
    static const char *const text[] = {"0.1_000 <= a", ".1_0 <= a", "0x1f <= a", "1.2.3 <= a", "@ <= a"};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        char operator[3];
        int left, right;
        cr_assert(ves_formula_split(text[k], operator, & left, &right) == VES_OK, "%s", text[k]);
        cr_assert(!strcmp(operator, "<=") && !strcmp(text[k] + right, "a"), "%s", text[k]);
    }
}
