#include <math.h>
#include <stdlib.h>

#include "output/scene.h"

enum { PATCHES = 8, STOPS = 9 };

const ves_rgb ves_ink = {0.16, 0.19, 0.23}, ves_quiet = {0.42, 0.46, 0.51};

static const unsigned patch_colour[PATCHES] = {0x5088bd, 0xe2a854, 0x62ab8d, 0xc9717c,
                                               0x8d80b8, 0x7f919c, 0xb98d62, 0x57aab8};

/* Lines stand side by side and cross: colours that also differ for who does not see red and green alike, after
 * Okabe and Ito, without their yellow. */
static const unsigned line_colour[PATCHES] = {0x0072b2, 0xe69f00, 0x009e73, 0xd55e00,
                                              0xcc79a7, 0x404040, 0x56b4e9, 0x8b6b3d};

/* ColorBrewer RdBu, reversed: blue below zero, red above. */
static const unsigned diverging[STOPS] = {0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7,
                                          0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b};

/* Viridis: as evenly spaced to the eye as to the number, in grey too. */
static const unsigned sequential[STOPS] = {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                           0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

static ves_rgb rgb(unsigned code)
{
    return (ves_rgb){(code >> 16 & 255) / 255.0, (code >> 8 & 255) / 255.0, (code & 255) / 255.0};
}

ves_rgb ves_colour_mix(ves_rgb a, ves_rgb b, double share)
{
    double rest = 1 - share;
    return (ves_rgb){rest * a.r + share * b.r, rest * a.g + share * b.g, rest * a.b + share * b.b};
}

ves_rgb ves_colour_patch(int index)
{
    return rgb(patch_colour[index % PATCHES]);
}

ves_rgb ves_colour_line(int index)
{
    return rgb(line_colour[index % PATCHES]);
}

ves_rgb ves_colour_value(const ves_colour_scale *scale, double value)
{
    const unsigned *stop = scale->diverging ? diverging : sequential;
    double t = (value - scale->lo) / (scale->hi - scale->lo) * (STOPS - 1);
    if (!(t > 0)) t = 0;
    if (t > STOPS - 1) t = STOPS - 1;
    int k = t < STOPS - 1 ? (int)t : STOPS - 2;
    return ves_colour_mix(rgb(stop[k]), rgb(stop[k + 1]), t - k);
}

double ves_step_below(double step)
{
    double power = pow(10, floor(log10(step) + 1e-9)), digit = step / power * (1 + 1e-9);
    return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

ves_colour_scale ves_colour_scale_of(double *values, int count, double noise, double unit)
{
    int kept = 0;
    for (int k = 0; k < count; k++)
        if (isfinite(values[k])) values[kept++] = values[k];
    if (!kept) return (ves_colour_scale){.lo = -unit, .hi = unit, .diverging = true};
    qsort(values, (size_t)kept, sizeof *values, compare);
    double lo = values[kept / 100], hi = values[kept - 1 - kept / 100], middle = (lo + hi) / 2;
    double largest = fmax(fabs(lo), fabs(hi)), spread = values[kept - 1] - values[0];
    if (spread <= noise || spread <= 1e-6 * largest) {
        if (largest <= noise) middle = 0, largest = unit;
        return (ves_colour_scale){
            .lo = middle - largest, .hi = middle + largest, .diverging = !middle, .constant = true};
    }
    if (hi - lo <= noise || hi - lo <= 1e-6 * largest) {
        double half = largest > noise ? largest / 2 : unit;
        lo = middle - half, hi = middle + half;
    }
    ves_colour_scale scale = {.lo = lo, .hi = hi, .diverging = fmin(-lo, hi) > 0.04 * largest};
    if (scale.diverging) scale.hi = fmax(-lo, hi), scale.lo = -scale.hi;
    double slack = 1e-3 * (scale.hi - scale.lo);
    scale.below = values[0] < scale.lo - slack;
    scale.above = values[kept - 1] > scale.hi + slack;
    return scale;
}

ves_colour_scale ves_colour_scale_whole(const double *values, int count)
{
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int k = 0; k < count; k++)
        if (isfinite(values[k])) lo = fmin(lo, values[k]), hi = fmax(hi, values[k]);
    if (!(hi > 0)) return (ves_colour_scale){.lo = -1, .hi = 1, .constant = true};
    if (hi - lo <= 1e-6 * hi) return (ves_colour_scale){.lo = 0, .hi = lo + hi, .constant = true};
    return (ves_colour_scale){.lo = lo, .hi = hi};
}
