#include "surface/weights.h"

#include <math.h>

#include "base/arena.h"
#include "base/vector.h"
#include "surface/exact.h"
#include "surface/factor.h"
#include "surface/fast.h"

enum { ORDERS = 3 };

static int conditions(const ves_layout *layout)
{
    return 2 * layout->power;
}

long ves_weights_size(const ves_layout *layout, int modes, int nu)
{
    return (long)(modes + 1) * ORDERS * conditions(layout) * nu;
}

long ves_weights_room(const ves_layout *layout, int nu)
{
    long fast = ves_fast_room(nu), exact = ves_exact_room(layout, ORDERS);
    return fast > exact ? fast : exact;
}

/* The cardinal functions of a raised order are those of the lower one and, for what departs from it, those of
 * the whole. out: of the whole. */
static ves_status exact(const ves_layout *layout, const ves_factor *factor, double n, int nu, const double *u,
                        ves_exact_out out, double *room)
{
    out.count = out.columns = conditions(layout);
    out.orders = ORDERS;
    if (layout->lower) {
        ves_layout low = *layout;
        ves_operator op = *factor->op;
        ves_factor of;
        low.power = op.power = layout->lower;
        ves_factor_make(&op, out.slope, &of);
        out.count = conditions(&low);
        VES_TRY(ves_exact_mode(&low, &of, n, nu, u, &out, room));
        out.first = out.count;
        out.count = out.columns - out.first;
    }
    return ves_exact_mode(layout, factor, n, nu, u, &out, room);
}

ves_status ves_weights_mode(const ves_layout *layout, const ves_operator *op, double n, int nu,
                            const double *u, const ves_table *row)
{
    int size = ORDERS * conditions(layout) * nu;
    if (!ves_fast_fits(layout, op)) {
        ves_exact_out out = {.weight = row->weight, .slope = row->slope, .stride = (size_t)size};
        ves_factor factor;
        ves_factor_make(op, row->slope, &factor);
        return exact(layout, &factor, n, nu, u, out, row->room);
    }
    ves_status status =
        ves_fast_mode(layout, op->parameter[0] * n, nu, u, row->weight, row->slope, row->room);
    for (int k = 0; row->slope && k < size; k++) row->slope[k] *= n; /* d/da = n d/dlam */
    return status;
}

ves_status ves_weights_bind(const ves_layout *layout, const ves_operator *op, int modes, int nu,
                            const double *u, const ves_table *table)
{
    if (ves_fast_fits(layout, op)) return ves_fast_bind(layout, op->parameter[0], modes, nu, u, table);
    size_t row = (size_t)(ORDERS * conditions(layout) * nu);
    ves_exact_out out = {.stride = row * (size_t)(modes + 1)};
    ves_status worst = VES_OK;
    ves_factor factor;
    ves_factor_make(op, table->slope, &factor);
    for (int n = table->has_zero ? 1 : 0; n <= modes; n++) {
        out.weight = table->weight + row * (size_t)n;
        out.slope = table->slope ? table->slope + row * (size_t)n : NULL;
        ves_status status = exact(layout, &factor, n, nu, u, out, table->room);
        if (status != VES_OK) worst = status;
    }
    return worst;
}

/* --- what the conditions make of a mode --- */

enum { LOOKS = 256 };

/* Largest |l_j(u)| of condition j. */
static double largest(const double *weight, int j)
{
    double most = 0;
    for (int i = 0; i < LOOKS; i++) most = fmax(most, fabs(weight[j * LOOKS + i]));
    return most;
}

/* Looked for at Chebyshev's places: what conditions inside make grows towards the ends, in layers 1 / lam wide. */
static ves_status amplification(const ves_layout *layout, const ves_operator *op, double n, ves_arena *arena,
                                ves_amplification *found)
{
    int count = conditions(layout);
    double *weight = ves_arena_doubles(arena, (size_t)(ORDERS * count * LOOKS));
    double *room = ves_arena_doubles(arena, (size_t)ves_weights_room(layout, LOOKS)), u[LOOKS];
    double lam = fmax(1, n * ves_operator_rate(op));
    if (!weight || !room) return VES_MEMORY;
    for (int i = 0; i < LOOKS; i++) u[i] = (1 - cos(VES_PI * i / (LOOKS - 1))) / 2;
    VES_TRY(ves_weights_mode(layout, op, n, LOOKS, u, &(ves_table){.weight = weight, .room = room}));
    found->lebesgue = 0;
    for (int i = 0; i < LOOKS; i++) {
        double sum = 0;
        for (int j = 0; j < count; j++)
            if (layout->knot[j].derivative == 0) sum += fabs(weight[j * LOOKS + i]);
        found->lebesgue = fmax(found->lebesgue, sum);
    }
    found->amplified = found->lebesgue;
    for (int j = 0; j < count; j++)
        found->amplified = fmax(found->amplified, largest(weight, j) * pow(lam, layout->knot[j].derivative));
    return VES_OK;
}

/* Beyond what e^(lam u_N) explains, and beyond what 32 digits can tell from singular. */
static const double SINGULAR = 1e10, CONDITION = 1e28;

/* Each derivative among the first `count` knots with all lower ones. */
static bool complete(const ves_layout *layout, int count)
{
    for (int j = 0; j < count; j++) {
        const ves_knot *knot = &layout->knot[j];
        bool found = knot->derivative == 0;
        for (int i = 0; i < count; i++)
            found =
                found || (layout->knot[i].u == knot->u && layout->knot[i].derivative == knot->derivative - 1);
        if (!found) return false;
    }
    return true;
}

static bool both_complete(const ves_layout *layout)
{
    return complete(layout, conditions(layout)) && complete(layout, 2 * layout->lower);
}

bool ves_layout_regular(const ves_layout *layout)
{
    return ves_layout_depth(layout) == 0 && both_complete(layout);
}

/* What the numbers found mean. */
static void classify(const ves_layout *layout, const ves_operator *op, ves_amplification *found)
{
    double depth = ves_layout_depth(layout), growth = found->lam * depth;
    bool told = isfinite(found->amplified) && found->condition <= CONDITION;
    bool regular = both_complete(layout) && (!op->general || depth == 0);
    found->free =
        !regular && (isfinite(found->lebesgue) ? log(found->lebesgue) > log(SINGULAR) + growth : false);
    if (!regular && !told && growth < log(CONDITION)) found->free = true;
    found->solvable = told && !found->free;
}

ves_status ves_weights_amplification(const ves_layout *layout, const ves_operator *op, double n,
                                     ves_amplification *found)
{
    ves_arena arena = {0};
    double *room = ves_arena_doubles(&arena, (size_t)ves_exact_room(layout, 1));
    *found = (ves_amplification){.lebesgue = HUGE_VAL, .amplified = HUGE_VAL, .condition = HUGE_VAL};
    ves_factor factor;
    ves_factor_make(op, false, &factor);
    found->lam = n * ves_factor_growth(&factor);
    ves_status status = room ? ves_exact_condition(layout, &factor, n, &found->condition, room) : VES_MEMORY;
    if (status == VES_OK) status = amplification(layout, op, n, &arena, found);
    ves_arena_destroy(&arena);
    classify(layout, op, found);
    return status == VES_MEMORY ? status : VES_OK;
}

/* Of the first 2N knots. */
static double depth_of(const ves_layout *layout, int N)
{
    double depth = 0;
    for (int j = 0; j < 2 * N; j++) {
        int nearer[2] = {0, 0}; /* conditions before this one, as seen from each end */
        for (int i = 0; i < 2 * N; i++) {
            double here = layout->knot[j].u, there = layout->knot[i].u;
            nearer[0] += there < here || (there == here && i < j);
            nearer[1] += there > here || (there == here && i < j);
        }
        for (int e = 0; e < 2; e++)
            if (nearer[e] == N - 1) depth = fmax(depth, e ? 1 - layout->knot[j].u : layout->knot[j].u);
    }
    return depth;
}

double ves_layout_depth(const ves_layout *layout)
{
    return fmax(depth_of(layout, layout->power), depth_of(layout, layout->lower));
}
