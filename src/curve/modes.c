#include "curve/modes.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

static const ves_arg *answer(const ves_curve_input *input, int key)
{
    return &input->args->arg[key];
}

double ves_input_number(const ves_curve_input *input, int key)
{
    const ves_arg *arg = answer(input, key);
    return arg->count > 0 ? input->number[arg->first] : input->args->key[key].fallback;
}

const double *ves_input_vector(const ves_curve_input *input, int key, const double fallback[3])
{
    const ves_arg *arg = answer(input, key);
    return arg->given ? input->number + arg->first : fallback;
}

const double *ves_input_list(const ves_curve_input *input, int key, int *count)
{
    const ves_arg *arg = answer(input, key);
    *count = arg->given ? arg->count : 0;
    return input->number + arg->first;
}

void ves_input_scatter(const ves_curve_input *input, int key, int i, double value, double *number_adjoint)
{
    const ves_arg *arg = answer(input, key);
    if (arg->given) number_adjoint[arg->first + i] += value;
}

bool ves_input_varies(const ves_curve_input *input, int key)
{
    const ves_arg *arg = answer(input, key);
    for (int i = 0; arg->given && i < arg->count; i++)
        if (input->varying[arg->first + i]) return true;
    return false;
}

bool ves_input_reads(const ves_curve_input *input, int key, int slot)
{
    for (int c = 0; c < answer(input, key)->count; c++)
        if (ves_formula_uses_slot(answer(input, key)->formula[c], slot)) return true;
    return false;
}

int ves_input_slots(const ves_curve_input *input, int key)
{
    int slots = 0;
    for (int c = 0; c < answer(input, key)->count; c++) {
        int own = ves_formula_slots(answer(input, key)->formula[c]);
        slots = own > slots ? own : slots;
    }
    return slots;
}

ves_mark ves_input_mark(const ves_curve_input *input, int key)
{
    const ves_arg *arg = answer(input, key);
    return arg->given ? arg->mark : input->args->mark;
}

ves_status ves_input_memory(const ves_curve_input *input, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_MEMORY, input->args->mark, "%s", ves_status_text(VES_MEMORY));
}

int ves_input_modes(const ves_curve_input *input)
{
    int most = 0;
    for (int i = 0; i < input->inputs; i++)
        if (input->input_modes[i] > most) most = input->input_modes[i];
    return most;
}

double ves_sinc(double x)
{
    return x == 0 ? 1 : sin(x) / x;
}

void ves_modes_copy(const double *input, int input_modes, int modes, double *out)
{
    memset(out, 0, 3 * (size_t)ves_curve_stride(modes) * sizeof *out);
    ves_modes_add(input, input_modes, 1, modes, out);
}

void ves_modes_add(const double *input, int input_modes, double factor, int modes, double *out)
{
    int from = ves_curve_stride(input_modes), to = ves_curve_stride(modes);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < from; k++) out[c * to + k] += factor * input[c * from + k];
}

void ves_modes_scatter(const double *adjoint, int modes, double factor, int input_modes,
                       double *input_adjoint)
{
    int from = ves_curve_stride(input_modes), to = ves_curve_stride(modes);
    for (int c = 0; input_adjoint && c < 3; c++)
        for (int k = 0; k < from; k++) input_adjoint[c * from + k] += factor * adjoint[c * to + k];
}

double ves_modes_largest(const double *coef, int modes, int first)
{
    int stride = ves_curve_stride(modes);
    double largest = 0;
    for (int c = 0; c < 3; c++)
        for (int k = first > 0 ? 2 * first - 1 : 0; k < stride; k++)
            largest = fmax(largest, fabs(coef[c * stride + k]));
    return largest;
}

int ves_modes_needed(const double *coef, int modes)
{
    int stride = ves_curve_stride(modes), n = modes;
    double floor = 1e-10 * ves_modes_largest(coef, modes, 1) + 1e-13 * ves_modes_largest(coef, modes, 0);
    for (double tail = 0; n > 0; n--) {
        for (int c = 0; c < 3; c++) tail += hypot(coef[c * stride + 2 * n - 1], coef[c * stride + 2 * n]);
        if (!(tail <= floor)) break;
    }
    return n;
}

/* The weight of one sample in eqs 4.25-4.27: 1/J for the mean, 2/J for a mode, and at n = J/2, where sampling
 * cannot tell cos from its alias, 1/J. */
static double weight(int n, int count)
{
    return (n == 0 || 2 * n == count ? 1.0 : 2.0) / count;
}

/* cos and sin of 2 pi n j / count; the product is reduced first, so that large n loses nothing. At n = count
 * / 2 the sine is exactly 0: undetermined, hence left out. */
static void wave(int n, int j, int count, double z[2])
{
    int r = (int)((long)n * j % count);
    double angle = VES_TWO_PI * r / count;
    z[0] = cos(angle);
    z[1] = 2 * r == count ? 0 : sin(angle);
}

bool ves_modes_map_create(int points, int modes, const double *factor, ves_arena *arena, ves_modes_map *map)
{
    map->points = points, map->modes = modes;
    map->table = ves_arena_doubles(arena, (size_t)ves_curve_stride(modes) * (size_t)points);
    if (!map->table) return false;
    for (int n = 0; n <= modes; n++) {
        double w = factor ? factor[n] * (n ? 2.0 : 1.0) / points : weight(n, points);
        for (int j = 0; j < points; j++) {
            double z[2];
            wave(n, j, points, z);
            map->table[(n ? 2 * n - 1 : 0) * points + j] = w * z[0];
            if (n) map->table[2 * n * points + j] = w * z[1];
        }
    }
    return true;
}

void ves_modes_map_eval(const ves_modes_map *map, const double *restrict point, double *restrict out)
{
    int stride = ves_curve_stride(map->modes);
    for (int k = 0; k < stride; k++) {
        const double *restrict row = map->table + (size_t)k * (size_t)map->points;
        double x = 0, y = 0, z = 0;
        for (int j = 0; j < map->points; j++) {
            x += row[j] * point[3 * j];
            y += row[j] * point[3 * j + 1];
            z += row[j] * point[3 * j + 2];
        }
        out[k] = x, out[stride + k] = y, out[2 * stride + k] = z;
    }
}

void ves_modes_map_gradient(const ves_modes_map *map, const double *restrict adjoint,
                            double *restrict point_adjoint)
{
    int stride = ves_curve_stride(map->modes);
    for (int k = 0; k < stride; k++) {
        const double *restrict row = map->table + (size_t)k * (size_t)map->points;
        double x = adjoint[k], y = adjoint[stride + k], z = adjoint[2 * stride + k];
        for (int j = 0; j < map->points; j++) {
            point_adjoint[3 * j] += row[j] * x;
            point_adjoint[3 * j + 1] += row[j] * y;
            point_adjoint[3 * j + 2] += row[j] * z;
        }
    }
}

/* Fourier analysis by the trapezoid rule  [Ugail 2011, eqs 4.24-4.27, as corrected in docs/errata.md] */
void ves_curve_analyse(const double *sample, int count, int modes, double *coef)
{
    int stride = ves_curve_stride(modes);
    memset(coef, 0, 3 * (size_t)stride * sizeof *coef);
    for (int n = 0; n <= modes && 2 * n <= count; n++)
        for (int j = 0; j < count; j++) {
            double z[2];
            wave(n, j, count, z);
            for (int c = 0; c < 3; c++) {
                double g = weight(n, count) * sample[c * count + j];
                coef[c * stride + (n ? 2 * n - 1 : 0)] += g * z[0];
                if (n) coef[c * stride + 2 * n] += g * z[1];
            }
        }
}

/* [Ugail 2011, eq 4.20] and its derivatives with respect to v. */
void ves_curve_point(const double *coef, int modes, double v, int order, double *out)
{
    int stride = ves_curve_stride(modes);
    double step[2] = {cos(v), sin(v)}, z[2] = {1, 0};
    for (int i = 0; i < 3 * (order + 1); i++) out[i] = 0;
    for (int c = 0; c < 3; c++) out[c] = coef[c * stride];
    for (int n = 1; n <= modes; n++) {
        ves_turn(z, step);
        for (int c = 0; c < 3; c++) {
            double a = coef[c * stride + 2 * n - 1], b = coef[c * stride + 2 * n];
            double value = a * z[0] + b * z[1];
            out[c] += value;
            if (order > 0) out[3 + c] += n * (b * z[0] - a * z[1]);
            if (order > 1) out[6 + c] -= n * n * value;
        }
    }
}
