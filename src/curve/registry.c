#include <string.h>

#include "curve/curve.h"

/* The generated list names ves_curve_NAME for each file; the descriptor itself is ves_curve_NAME_op, since
 * ves_curve_point is taken by the function that evaluates one. */
#define VES_ENTRY(symbol) extern const ves_curve_op symbol##_op;
#include "curve_ops.inc"
#undef VES_ENTRY

static const ves_curve_op *const list[] = {
#define VES_ENTRY(symbol) &symbol##_op,
#include "curve_ops.inc"
#undef VES_ENTRY
    NULL};

const ves_curve_op *const *ves_curve_ops(void)
{
    return list;
}

const ves_curve_op *ves_curve_op_find(const char *name, bool move)
{
    for (const ves_curve_op *const *op = list; *op; op++)
        if ((*op)->move == move && !strcmp((*op)->name, name)) return *op;
    return NULL;
}
