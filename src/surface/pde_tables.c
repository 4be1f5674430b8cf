/* Weight tables of a PDE patch on a row of places, made anew when its operators have changed. */
#include "surface/pde.h"

#include <string.h>

ves_status ves_pde_tables_create(const pde *p, int nup, ves_arena *arena, pde_tables *tables)
{
    size_t table = (size_t)ves_weights_size(&p->layout, p->modes, nup),
           rest = 3 * (size_t)(p->conditions * nup);
    bool tail = p->band > p->modes;
    for (int k = 0; k < p->def->operators; k++) {
        pde_tables *t = &tables[k];
        size_t slopes = p->op_varies[k] ? (size_t)p->parameters : 0;
        size_t rest_slopes = !tail ? 0 : p->omega_varies ? 1 : p->def->omega < 0 ? slopes : 0;
        *t = (pde_tables){.table = ves_arena_doubles(arena, table),
                          .slope = ves_arena_doubles(arena, slopes * table),
                          .rest = ves_arena_doubles(arena, tail ? rest : 0),
                          .rest_slope = ves_arena_doubles(arena, rest_slopes * rest)};
        if (!t->table || !t->slope || !t->rest || !t->rest_slope) return VES_MEMORY;
    }
    return VES_OK;
}

static bool same_operator(const ves_operator *a, const ves_operator *b)
{
    for (int k = 0; k < ves_operator_parameters(a); k++)
        if (a->parameter[k] != b->parameter[k]) return false;
    return true;
}

static ves_status rest_make(const pde *p, int op, int nup, const double *u, bool slopes, const pde_tables *t,
                            double *room)
{
    bool given = p->def->omega >= 0;
    double *slope = given ? (p->omega_varies && slopes ? t->rest_slope : NULL)
                          : (p->op_varies[op] && slopes ? t->rest_slope : NULL);
    return ves_weights_mode(&p->layout, given ? &p->rest : &p->op[op], given ? 1 : p->rest_mode, nup, u,
                            &(ves_table){.weight = t->rest, .slope = slope, .room = room});
}

/* Mode 0 is the same for every operator, and its slopes are 0: both are made once. */
ves_status ves_pde_tables_make(const pde *p, int op, int nup, const double *u, bool gradient, pde_tables *t,
                               double *room)
{
    bool slopes = gradient && (p->op_varies[op] || p->omega_varies), tail = p->band > p->modes;
    bool operator_same = t->fresh && same_operator(&t->made, &p->op[op]);
    bool omega_same = t->fresh && t->omega == p->rest.parameter[0];
    if (operator_same && omega_same && (t->has_slope || !slopes)) return t->status;
    bool own = slopes && p->op_varies[op], more = slopes && !t->has_slope;
    bool zero = t->fresh && t->modes_status == VES_OK && (t->has_slope || !own);
    if (!operator_same || (own && more))
        t->modes_status = ves_weights_bind(
            &p->layout, &p->op[op], p->modes, nup, u,
            &(ves_table){.weight = t->table, .slope = own ? t->slope : NULL, .room = room, .has_zero = zero});
    bool rest_same = p->def->omega >= 0 ? omega_same : operator_same;
    if (tail && (!rest_same || more)) t->rest_status = rest_make(p, op, nup, u, slopes, t, room);
    t->made = p->op[op];
    t->omega = p->rest.parameter[0];
    t->has_slope = slopes;
    t->fresh = true;
    return t->status = t->modes_status == VES_OK ? t->rest_status : t->modes_status;
}
