/* PDE patches at scattered points, and the spine [Ugail 2011, 5.3]. */
#include "surface/pde.h"

#include <math.h>
#include <string.h>

enum { CHUNK = PDE_CHUNK };

/* One operator's weights: modes 0 .. M, the remainder. */
static long table_size(const pde *p)
{
    return ves_weights_size(&p->layout, p->modes, CHUNK) + 3L * p->conditions * CHUNK;
}

long ves_pde_point_room(const ves_patch *patch)
{
    const pde *p = patch->state;
    return p->def->operators * table_size(p) + 3L * p->spine.terms * CHUNK +
           ves_weights_room(&p->layout, CHUNK);
}

/* The tables of a chunk, in the room of the caller. Modes that are not determined have no weights. */
typedef struct chunk {
    pde_tables tables[3];
    double *spine;
} chunk;

static void chunk_make(const pde *p, int count, const double *u, double *room, chunk *c)
{
    _Alignas(64) double place[CHUNK];
    pde_places(count, u, CHUNK, place);
    memset(c, 0, sizeof *c);
    double *scratch = room + p->def->operators * table_size(p);
    c->spine = scratch;
    scratch += 3 * p->spine.terms * CHUNK;
    ves_pde_spine_basis(p, CHUNK, place, c->spine);
    for (int k = 0; k < p->def->operators; k++) {
        pde_tables *t = &c->tables[k];
        t->table = room + k * table_size(p);
        t->rest = t->table + ves_weights_size(&p->layout, p->modes, CHUNK);
        ves_pde_tables_make(p, k, CHUNK, place, false, t, scratch);
    }
}

static double spine_value(const pde *p, const double *basis, int d, int i, int k)
{
    double sum = 0;
    for (int q = 0; q < p->spine.terms; q++)
        sum += basis[(d * p->spine.terms + q) * CHUNK + i] * p->spine.point[3 * q + k];
    return sum;
}

/* sum_j W[d][j] F_j for coefficient `part` of the mode that the weights are of. */
static double solved_value(const pde *p, const double *weight, int part, int d, int i, int k)
{
    int K = p->conditions, width = ves_curve_stride(p->band);
    double sum = 0;
    for (int j = 0; j < K; j++) sum += weight[(d * K + j) * CHUNK + i] * p->data[(j * 3 + k) * width + part];
    return sum;
}

static double mode_value(const pde *p, const chunk *c, int n, int part, int d, int i, int k)
{
    const pde_tables *t = &c->tables[pde_operator(p, k)];
    if (n == 0 && p->spine.terms) return spine_value(p, c->spine, d, i, k);
    return solved_value(p, n <= p->modes ? t->table + (size_t)(n * 3 * p->conditions * CHUNK) : t->rest, part,
                        d, i, k);
}

static void point_sum(const pde *p, const chunk *c, int i, double v, double out[VES_FIELDS][3])
{
    memset(out, 0, sizeof(double) * VES_FIELDS * 3);
    for (int n = 0; n <= p->band; n++)
        for (int k = 0; k < 3; k++)
            for (int d = 0; d < 3; d++) {
                double a = mode_value(p, c, n, n ? 2 * n - 1 : 0, d, i, k);
                double b = n ? mode_value(p, c, n, 2 * n, d, i, k) : 0;
                for (int f = 0; f < VES_FIELDS; f++) {
                    double of_cosine, of_sine;
                    if (ves_field_d[f] != d) continue;
                    ves_wave(n, v, ves_field_e[f], &of_cosine, &of_sine);
                    out[f][k] += a * of_cosine + b * of_sine;
                }
            }
}

void ves_pde_point(const ves_patch *patch, const ves_bound *bound, int count, const double *u,
                   const double *v, double *out, double *room)
{
    (void)bound;
    const pde *p = patch->state;
    for (int first = 0; first < count; first += CHUNK) {
        int n = count - first < CHUNK ? count - first : CHUNK;
        chunk c;
        chunk_make(p, n, u + first, room, &c);
        for (int i = 0; i < n; i++) {
            double field[VES_FIELDS][3];
            point_sum(p, &c, i, v[first + i], field);
            for (int f = 0; f < VES_FIELDS; f++)
                for (int k = 0; k < 3; k++) out[(f * 3 + k) * count + first + i] = field[f][k];
        }
    }
}

/* Mode 0 alone, which is the same for every operator. */
bool ves_pde_spine_points(const ves_patch *patch, const ves_bound *bound, int count, const double *u,
                          double *out, double *room)
{
    (void)bound;
    const pde *p = patch->state;
    bool given = p->spine.terms > 0;
    double *table = room, *scratch = room + 3 * (given ? p->spine.terms : p->conditions) * CHUNK;
    for (int first = 0; first < count; first += CHUNK) {
        int n = count - first < CHUNK ? count - first : CHUNK;
        _Alignas(64) double place[CHUNK];
        pde_places(n, u + first, CHUNK, place);
        if (given)
            ves_pde_spine_basis(p, CHUNK, place, table);
        else
            ves_weights_mode(&p->layout, &p->op[0], 0, CHUNK, place,
                             &(ves_table){.weight = table, .room = scratch});
        for (int i = 0; i < n; i++)
            for (int d = 0; d < 3; d++)
                for (int k = 0; k < 3; k++)
                    out[(d * 3 + k) * count + first + i] =
                        given ? spine_value(p, table, d, i, k) : solved_value(p, table, 0, d, i, k);
    }
    return true;
}
