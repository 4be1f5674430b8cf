#include "formula/dimension.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"

enum { LARGEST = 127, SIXTHS = 6 };

typedef struct unit_row {
    const char *name;
    double up, down;      /* to SI: times up, over down */
    signed char m, kg, s; /* whole exponents */
} unit_row;

/* clang-format off */
#define UNITS(X)                                                                                             \
    X(m,    1, 1,     1, 0, 0)   X(mm,  1, 1e3,   1, 0, 0)   X(cm,  1, 100,   1, 0, 0)                       \
    X(um,   1, 1e6,   1, 0, 0)   X(nm,  1, 1e9,   1, 0, 0)   X(km,  1e3, 1,   1, 0, 0)                       \
    X(kg,   1, 1,     0, 1, 0)   X(g,   1, 1e3,   0, 1, 0)   X(mg,  1, 1e6,   0, 1, 0)                       \
    X(s,    1, 1,     0, 0, 1)   X(ms,  1, 1e3,   0, 0, 1)   X(us,  1, 1e6,   0, 0, 1)                       \
    X(min,  60, 1,    0, 0, 1)   X(h,   3600, 1,  0, 0, 1)   X(Hz,  1, 1,     0, 0, -1)                      \
    X(N,    1, 1,     1, 1, -2)  X(kN,  1e3, 1,   1, 1, -2)  X(mN,  1, 1e3,   1, 1, -2)                      \
    X(Pa,   1, 1,    -1, 1, -2)  X(kPa, 1e3, 1,  -1, 1, -2)  X(MPa, 1e6, 1,  -1, 1, -2)                      \
    X(GPa,  1e9, 1,  -1, 1, -2)  X(bar, 1e5, 1,  -1, 1, -2)  X(W,   1, 1,     2, 1, -3)                      \
    X(J,    1, 1,     2, 1, -2)  X(kJ,  1e3, 1,   2, 1, -2)  X(mJ,  1, 1e3,   2, 1, -2)                      \
    X(l,    1, 1e3,   3, 0, 0)   X(ml,  1, 1e6,   3, 0, 0)                                                   \
    X(deg,  VES_PI, 180,  0, 0, 0)   X(rad, 1, 1,     0, 0, 0)

#define UNIT_ROW(name, up, down, m, kg, s) {#name, up, down, m, kg, s},
#define UNIT_NAME(name, up, down, m, kg, s) #name,
static const unit_row row[] = {UNITS(UNIT_ROW)};
static const char *const names[] = {UNITS(UNIT_NAME)};
/* clang-format on */

static const struct {
    signed char m, kg, s;
    const char *name;
} known[] = {
    {1, 0, 0, "a length"},
    {2, 0, 0, "an area"},
    {3, 0, 0, "a volume"},
    {-1, 0, 0, "a curvature"},
    {0, 1, 0, "a mass"},
    {0, 0, 1, "a time"},
    {1, 1, -2, "a force"},
    {0, 1, -2, "a force per length"},
    {-1, 1, -2, "a pressure"},
    {2, 1, -2, "an energy"},
    {2, 1, -3, "a power"},
    {-3, 1, 0, "a density"},
    {-2, 1, 0, "a mass per area"},
    {-1, 1, 0, "a mass per length"},
    {-2, 1, -2, "a force per volume"},
    {1, 0, -1, "a speed"},
    {1, 0, -2, "an acceleration"},
    {0, 0, -1, "a frequency"},
};

const char *const *ves_unit_names(int *count)
{
    *count = (int)(sizeof names / sizeof *names);
    return names;
}

bool ves_dim_equal(ves_dim a, ves_dim b)
{
    return a.any || b.any || (a.m == b.m && a.kg == b.kg && a.s == b.s);
}

bool ves_dim_plain(ves_dim dim)
{
    return ves_dim_equal(dim, (ves_dim){0});
}

static bool stored(int m, int kg, int s, ves_dim *dim)
{
    if (m < -LARGEST || m > LARGEST || kg < -LARGEST || kg > LARGEST || s < -LARGEST || s > LARGEST)
        return false;
    *dim = (ves_dim){.m = (signed char)m, .kg = (signed char)kg, .s = (signed char)s};
    return true;
}

bool ves_dim_multiply(ves_dim a, ves_dim b, int sign, ves_dim *product)
{
    *product = (ves_dim){.any = true};
    return a.any || b.any || stored(a.m + sign * b.m, a.kg + sign * b.kg, a.s + sign * b.s, product);
}

/* Exponents such as 1/3 arrive rounded: within 1e-9 of a whole number of sixths is exact. */
static bool times(signed char part, double exponent, int *result)
{
    double sixths = part * exponent, whole = floor(sixths + 0.5);
    if (!(fabs(whole) <= LARGEST) || !(fabs(sixths - whole) < 1e-9)) return false;
    *result = (int)whole;
    return true;
}

bool ves_dim_power(ves_dim dim, double exponent, ves_dim *power)
{
    int m, kg, s;
    *power = (ves_dim){.any = true};
    if (dim.any) return true;
    return times(dim.m, exponent, &m) && times(dim.kg, exponent, &kg) && times(dim.s, exponent, &s) &&
           stored(m, kg, s, power);
}

/* "m^2", "m^(1/2)"; nothing for exponent 0 */
static int write_power(char *at, size_t size, const char *unit, int sixths, const char *before)
{
    if (sixths == 0) return 0;
    int whole = sixths / SIXTHS, common = sixths % 3 == 0 ? 3 : sixths % 2 == 0 ? 2 : 1;
    if (sixths == SIXTHS) return snprintf(at, size, "%s%s", before, unit);
    if (sixths % SIXTHS == 0) return snprintf(at, size, "%s%s^%d", before, unit, whole);
    return snprintf(at, size, "%s%s^(%d/%d)", before, unit, sixths / common, SIXTHS / common);
}

void ves_dim_text(ves_dim dim, char buffer[48])
{
    static const char *const unit[3] = {"kg", "m", "s"};
    int sixths[3] = {dim.kg, dim.m, dim.s}, below = 0, at = 0;
    snprintf(buffer, 48, "%s", dim.any ? "any" : "1");
    if (dim.any) return;
    for (int k = 0; k < 3; k++) {
        below += sixths[k] < 0;
        if (sixths[k] > 0) at += write_power(buffer + at, 48 - (size_t)at, unit[k], sixths[k], at ? " " : "");
    }
    if (!below) return;
    at = at ? at : 1; /* after the 1 of 1/m */
    at += snprintf(buffer + at, 48 - (size_t)at, below > 1 ? "/(" : "/");
    const char *before = "";
    for (int k = 0; k < 3; k++) {
        if (sixths[k] >= 0) continue;
        at += write_power(buffer + at, 48 - (size_t)at, unit[k], -sixths[k], before);
        before = " ";
    }
    if (below > 1) snprintf(buffer + at, 48 - (size_t)at, ")");
}

void ves_dim_describe(ves_dim dim, char buffer[64])
{
    char text[48];
    ves_dim_text(dim, text);
    if (ves_dim_plain(dim)) {
        snprintf(buffer, 64, "a plain number");
        return;
    }
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        if (dim.m != SIXTHS * known[k].m || dim.kg != SIXTHS * known[k].kg || dim.s != SIXTHS * known[k].s)
            continue;
        snprintf(buffer, 64, "%s (%s)", known[k].name, text);
        return;
    }
    snprintf(buffer, 64, "a quantity in %s", text);
}

double ves_unit_apply(const ves_unit *unit, double value)
{
    return unit->down == 1 ? value * unit->up
           : unit->up == 1 ? value / unit->down
                           : value * unit->up / unit->down;
}

static const unit_row *found(const ves_lexer *lexer)
{
    if (lexer->token != VES_TOKEN_NAME || lexer->end - lexer->begin > 3) return NULL;
    for (size_t k = 0; k < sizeof row / sizeof *row; k++)
        if (ves_lexer_is(lexer, row[k].name)) return &row[k];
    return NULL;
}

bool ves_unit_at(const ves_lexer *lexer)
{
    return found(lexer) != NULL;
}

static bool whole_number(const ves_lexer *lexer)
{
    return lexer->token == VES_TOKEN_NUMBER && lexer->number == floor(lexer->number) && lexer->number < 1000;
}

static int read_sign(ves_lexer *lexer)
{
    bool minus = lexer->token == VES_TOKEN_MINUS;
    if (minus || lexer->token == VES_TOKEN_PLUS) ves_lexer_next(lexer);
    return minus ? -1 : 1;
}

/* 2, -2, (2), (-1/2) */
static bool read_exponent(ves_lexer *lexer, double *exponent)
{
    bool open = lexer->token == VES_TOKEN_OPEN;
    if (open) ves_lexer_next(lexer);
    int sign = read_sign(lexer);
    if (!whole_number(lexer)) return false;
    *exponent = sign * lexer->number;
    ves_lexer_next(lexer);
    if (!open) return true;
    if (lexer->token == VES_TOKEN_OVER) {
        ves_lexer_next(lexer);
        if (!whole_number(lexer) || lexer->number == 0) return false;
        *exponent /= lexer->number;
        ves_lexer_next(lexer);
    }
    if (lexer->token != VES_TOKEN_CLOSE) return false;
    ves_lexer_next(lexer);
    return true;
}

/* up and down of a part are multiplied in, a common factor is taken out while that is exact */
static bool join(ves_unit *unit, const ves_unit *part, int sign)
{
    unit->up *= sign > 0 ? part->up : part->down;
    unit->down *= sign > 0 ? part->down : part->up;
    if (unit->down != 1 && fmod(unit->up, unit->down) == 0)
        unit->up /= unit->down, unit->down = 1;
    else if (unit->up != 1 && fmod(unit->down, unit->up) == 0)
        unit->down /= unit->up, unit->up = 1;
    unit->physical |= part->physical;
    return ves_dim_multiply(unit->dim, part->dim, sign, &unit->dim);
}

/* One unit with its exponent, times or over what is there. */
static bool read_part(ves_lexer *lexer, int sign, ves_unit *unit)
{
    const unit_row *r = found(lexer);
    ves_unit part = {.up = r->up, .down = r->down, .physical = r->m || r->kg || r->s};
    if (!stored(SIXTHS * r->m, SIXTHS * r->kg, SIXTHS * r->s, &part.dim)) return false;
    ves_lexer_next(lexer);
    if (lexer->token == VES_TOKEN_POWER) {
        double exponent;
        ves_lexer before = *lexer;
        ves_lexer_next(lexer);
        bool fits = read_exponent(lexer, &exponent) && lexer->token != VES_TOKEN_POWER &&
                    ves_dim_power(part.dim, exponent, &part.dim);
        if (!fits) {
            *lexer = before;
            ves_lexer_next(lexer);
            return false;
        }
        if (exponent < 0) sign = -sign, ves_dim_power(part.dim, -1, &part.dim);
        part.up = pow(part.up, fabs(exponent));
        part.down = pow(part.down, fabs(exponent));
    }
    return join(unit, &part, sign);
}

/* The open parenthesis of a group of units: (m s^2), (m*s). Leaves the lexer where it was when it is none. */
static bool read_group(ves_lexer *lexer, int sign, ves_unit *unit)
{
    ves_lexer ahead = *lexer;
    ves_unit inner = {.up = 1, .down = 1};
    int inner_sign = 1, parts = 0;
    if (ahead.token != VES_TOKEN_OPEN) return false;
    ves_lexer_next(&ahead);
    for (; ves_unit_at(&ahead); parts++) {
        if (!read_part(&ahead, inner_sign, &inner)) return false;
        inner_sign = ahead.token == VES_TOKEN_OVER ? -1 : 1;
        bool joined = ahead.token == VES_TOKEN_OVER || ahead.token == VES_TOKEN_TIMES;
        if (joined) ves_lexer_next(&ahead);
        if (joined && !ves_unit_at(&ahead)) return false;
    }
    if (ahead.token != VES_TOKEN_CLOSE || !parts) return false;
    ves_lexer_next(&ahead);
    ves_unit whole = *unit;
    if (!join(&whole, &inner, sign)) return false;
    *unit = whole;
    *lexer = ahead;
    return true;
}

/* [* or /] and a unit or a group: +1 read, 0 not there, -1 wrong. */
static int read_factor(ves_lexer *lexer, ves_unit *unit)
{
    bool over = lexer->token == VES_TOKEN_OVER;
    ves_lexer ahead = *lexer;
    if (!over && lexer->token != VES_TOKEN_TIMES) return 0;
    ves_lexer_next(&ahead);
    if (ves_unit_at(&ahead) && !ves_lexer_calls(&ahead)) {
        *lexer = ahead;
        return read_part(lexer, over ? -1 : 1, unit) ? 1 : -1;
    }
    if (!read_group(&ahead, over ? -1 : 1, unit)) return 0;
    *lexer = ahead;
    return 1;
}

bool ves_unit_read(ves_lexer *lexer, ves_unit *unit)
{
    *unit = (ves_unit){.up = 1, .down = 1};
    if (!read_part(lexer, 1, unit)) return false;
    int more = 1;
    while (more > 0) more = read_factor(lexer, unit);
    return more == 0;
}

/* 1, 1/m, m s, kg/(m s^2), %: as ves_dim_text writes it and as people do; a blank between units is a product. */
bool ves_dim_read(const char *text, ves_dim *dim, double *factor)
{
    ves_unit unit = {.up = 1, .down = 1};
    ves_lexer lexer;
    ves_lexer_start(&lexer, text);
    bool started = lexer.token == VES_TOKEN_PERCENT || (lexer.token == VES_TOKEN_NUMBER && lexer.number == 1);
    if (lexer.token == VES_TOKEN_PERCENT) unit.down = 100;
    if (started) ves_lexer_next(&lexer);
    if (!started && ves_unit_at(&lexer)) started = read_part(&lexer, 1, &unit);
    while (started && lexer.token != VES_TOKEN_END) {
        if (ves_unit_at(&lexer))
            started = read_part(&lexer, 1, &unit);
        else
            started = read_factor(&lexer, &unit) > 0;
    }
    if (!started) return false;
    *dim = unit.dim;
    if (factor) *factor = ves_unit_apply(&unit, 1);
    return true;
}

/* The unit behind a number; false: there is none, or not of this dimension. */
static bool unit_behind(ves_lexer *lexer, ves_dim dim, double *factor)
{
    ves_unit unit = {.up = 1, .down = 100};
    bool percent = lexer->token == VES_TOKEN_PERCENT;
    if (percent)
        ves_lexer_next(lexer);
    else if (!ves_unit_at(lexer) || ves_lexer_calls(lexer) || !ves_unit_read(lexer, &unit))
        return false;
    *factor = ves_unit_apply(&unit, 1);
    return !dim.any && unit.dim.m == dim.m && unit.dim.kg == dim.kg && unit.dim.s == dim.s;
}

bool ves_unit_find(const char *text, ves_dim dim, char unit[VES_UNIT_TEXT], double *factor)
{
    ves_lexer lexer;
    bool alone = true; /* nothing but a sign before the number */
    for (ves_lexer_start(&lexer, text); lexer.token != VES_TOKEN_END && lexer.token != VES_TOKEN_BAD;) {
        ves_token token = lexer.token;
        ves_lexer_next(&lexer);
        int begin = lexer.begin;
        if (token == VES_TOKEN_NUMBER && unit_behind(&lexer, dim, factor) &&
            lexer.before - begin < VES_UNIT_TEXT &&
            (!ves_dim_plain(dim) || (alone && lexer.token == VES_TOKEN_END))) {
            snprintf(unit, VES_UNIT_TEXT, "%.*s", lexer.before - begin, text + begin);
            return true;
        }
        alone = alone && token == VES_TOKEN_MINUS;
    }
    return false;
}
