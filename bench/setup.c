/* What a new `a` costs: the weight tables of modes 1 .. M at 16 places (mode 0 stays), with and without the
 * derivative with respect to a. Prints JSON Lines: the least of ROUNDS rounds, CPU time of this thread, and the
 * ratio to the first. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "surface/weights.h"

enum { ROUNDS = 15, PLACES = 16 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Half of the conditions at each end, each with all lower derivatives; or curves at Chebyshev's places. */
static ves_layout layout_of(int power, bool inside)
{
    ves_layout layout = {.power = power};
    int n = 2 * power;
    for (int j = 0; j < n; j++)
        layout.knot[j] =
            inside ? (ves_knot){(1 - cos(acos(-1) * j / (n - 1))) / 2, 0} : (ves_knot){j / power, j % power};
    return layout;
}

/* (d_uu + a^2 d_vv)^N, or with roots 1, 1.2, 1.4, ... times a and all coefficients. */
static ves_operator operator_of(int power, bool general, double a)
{
    ves_operator op = {.power = power, .general = general, .parameter = {a}};
    if (!general) return op;
    op.parameter[0] = 1;
    for (int i = 0; i < power; i++) {
        double s = a * a * (1 + 0.2 * i) * (1 + 0.2 * i);
        for (int k = i + 1; k > 0; k--) op.parameter[k] += s * op.parameter[k - 1];
    }
    return op;
}

static const struct row {
    const char *name;
    int power, modes, calls;
    bool inside, general;
    double a;
} ROW[] = {
    {"order 4, ends, M = 6", 2, 6, 4000, false, false, 0.9},
    {"order 4, curves inside, M = 6", 2, 6, 400, true, false, 0.9},
    {"order 6, ends, M = 6", 3, 6, 400, false, false, 0.9},
    {"order 8, ends, M = 6", 4, 6, 400, false, false, 0.9},
    {"order 14, ends, M = 6", 7, 6, 100, false, false, 0.9},
    {"order 14, curves inside, M = 6", 7, 6, 100, true, false, 0.9},
    {"order 40, ends, M = 16", 20, 16, 2, false, false, 0.9},
    {"order 40, curves inside, M = 16", 20, 16, 2, true, false, 0.9},
    {"order 40, ends, M = 16, a = 3", 20, 16, 2, false, false, 3},
    {"general, order 4, ends, M = 6", 2, 6, 100, false, true, 0.9},
    {"general, order 6, ends, M = 6", 3, 6, 100, false, true, 0.9},
    {"general, order 6, ends, M = 6, a = 5", 3, 6, 100, false, true, 5},
    {"general, order 12, ends, M = 6", 6, 6, 20, false, true, 0.9},
};
enum { ROWS = sizeof ROW / sizeof *ROW };

typedef struct bed {
    double *table, *slope, *room, u[PLACES], sum;
} bed;

static double us_of(const struct row *r, bool slopes, bed *b)
{
    ves_layout layout = layout_of(r->power, r->inside);
    double t = now();
    for (int c = 0; c < r->calls; c++) {
        ves_operator op = operator_of(r->power, r->general, r->a + 1e-9 * c);
        ves_weights_bind(&layout, &op, r->modes, PLACES, b->u,
                         &(ves_table){b->table, slopes ? b->slope : NULL, b->room, c > 0});
        b->sum += b->table[PLACES];
    }
    return (now() - t) / r->calls * 1e6;
}

static double *doubles(long count)
{
    return aligned_alloc(64, (sizeof(double) * (size_t)count + 63) / 64 * 64);
}

int main(void)
{
    ves_layout most = layout_of(VES_POWER_MAX, false), general = layout_of(VES_GENERAL_MAX, false);
    long size = ves_weights_size(&most, 16, PLACES);
    long rooms[] = {ves_weights_room(&most, PLACES), ves_weights_room(&general, PLACES)};
    long room = rooms[rooms[1] > rooms[0]];
    bed b = {.table = doubles(size), .slope = doubles(size), .room = doubles(room)};
    double us[ROWS][2];
    for (int i = 0; i < PLACES; i++) b.u[i] = (i + 0.5) / PLACES;
    for (int k = 0; k < ROWS; k++) us[k][0] = us[k][1] = HUGE_VAL;
    for (int r = 0; r < ROUNDS; r++)
        for (int k = 0; k < ROWS; k++)
            for (int s = 0; s < 2; s++) us[k][s] = fmin(us[k][s], us_of(&ROW[k], s, &b));
    for (int k = 0; k < ROWS; k++)
        printf("{\"name\": \"%s\", \"us\": %.2f, \"us_with_slopes\": %.2f, \"over_first\": %.1f}\n",
               ROW[k].name, us[k][0], us[k][1], us[k][0] / us[0][0]);
    free(b.table), free(b.slope), free(b.room);
    return isnan(b.sum);
}
