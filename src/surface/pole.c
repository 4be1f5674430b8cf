#include "surface/pole.h"

#include <string.h>

#include "base/vector.h"

/* What is no more than rounding, fields being exact to 1e-13: the sine of the angle between A'' and the plane
 * of A and A' (what has this little of a point bends by 1e-9 / t more), and A itself beside B. */
static const double NOTHING = 1e-9;

bool ves_pole_lanes(const ves_grid *grid, const ves_tile *tile, const bool pole[2], int s[VES_LANES])
{
    bool any = false;
    for (int i = 0; i < VES_LANES; i++) {
        double u = grid->u[tile->block + (i < tile->lanes ? i : tile->lanes - 1)];
        s[i] = pole[0] && u == 0 ? 1 : pole[1] && u == 1 ? -1 : 0;
        any = any || s[i];
    }
    return any;
}

/* The end seen along one line towards it. */
typedef struct line {
    double A[3], A1[3], A2[3], B[3], B1[3], B2[3]; /* and their derivatives by v */
    double n[3], square;                           /* A x A' */
    double turned[3], bent[3];                     /* A'' x A', A x A'' */
    double p, q;
} line;

static void take(const ves_tile_planes *field, int f, int at, double x[3])
{
    for (int c = 0; c < 3; c++) x[c] = field->at[f * 3 + c][at];
}

static void give(ves_tile_planes *field, int f, int at, const double x[3])
{
    for (int c = 0; c < 3; c++) field->at[f * 3 + c][at] = x[c];
}

static line line_init(const ves_tile_planes *field, int at)
{
    line l;
    take(field, VES_FIELD_U, at, l.A);
    take(field, VES_FIELD_UV, at, l.A1);
    take(field, VES_FIELD_UVV, at, l.A2);
    take(field, VES_FIELD_UU, at, l.B);
    take(field, VES_FIELD_UUV, at, l.B1);
    take(field, VES_FIELD_UUVV, at, l.B2);
    ves_cross(l.A, l.A1, l.n);
    ves_cross(l.A2, l.A1, l.turned);
    ves_cross(l.A, l.A2, l.bent);
    l.square = ves_dot(l.n, l.n);
    l.p = ves_dot(l.turned, l.n) / l.square;
    l.q = ves_dot(l.bent, l.n) / l.square;
    return l;
}

static bool has_limit(const line *l)
{
    double off = ves_dot(l->n, l->A2), small = NOTHING * NOTHING;
    bool planar = off * off <= small * l->square * ves_dot(l->A2, l->A2);
    return planar && ves_dot(l->A, l->A) > small * ves_dot(l->B, l->B);
}

static void unfold(int s, int at, ves_tile_planes *field)
{
    line l = line_init(field, at);
    bool smooth = has_limit(&l);
    double v[3], uv[3], vv[3];
    for (int c = 0; c < 3; c++) {
        v[c] = smooth ? s * l.A1[c] : 0;
        uv[c] = s * l.B1[c] / 2;
        vv[c] = l.B2[c] / 2 - l.p * l.B[c] - l.q * l.B1[c] / 2;
    }
    give(field, VES_FIELD_V, at, v);
    give(field, VES_FIELD_UV, at, uv);
    give(field, VES_FIELD_VV, at, vv);
}

void ves_pole_unfold(const ves_tile *tile, const int s[VES_LANES], ves_tile_planes *field)
{
    for (int at = 0; at < tile->rows * VES_LANES; at++)
        if (s[at % VES_LANES]) unfold(s[at % VES_LANES], at, field);
}

static void add_cross(double factor, const double a[3], const double b[3], double sum[3])
{
    double x[3];
    ves_cross(a, b, x);
    for (int c = 0; c < 3; c++) sum[c] += factor * x[c];
}

/* g?: d J / d ?. p and q flow back through n, A, A' and A''; n through A and A'. */
static void fold(int s, int at, const ves_tile_planes *field, ves_tile_planes *adjoint)
{
    line l = line_init(field, at);
    double gA[3], gA1[3], gA2[3] = {0}, gB[3], gB1[3], gB2[3], gn[3], gvv[3];
    take(adjoint, VES_FIELD_U, at, gA);
    take(adjoint, VES_FIELD_V, at, gA1);
    take(adjoint, VES_FIELD_UU, at, gB);
    take(adjoint, VES_FIELD_UV, at, gB1);
    take(adjoint, VES_FIELD_VV, at, gvv);
    double gp = -ves_dot(l.B, gvv) / l.square, gq = -ves_dot(l.B1, gvv) / 2 / l.square;
    for (int c = 0; c < 3; c++) {
        gA1[c] *= s;
        gB[c] -= l.p * gvv[c];
        gB1[c] = (s * gB1[c] - l.q * gvv[c]) / 2;
        gB2[c] = gvv[c] / 2;
        gn[c] = gp * l.turned[c] + gq * l.bent[c] - 2 * (gp * l.p + gq * l.q) * l.n[c];
    }
    add_cross(gp, l.A1, l.n, gA2);
    add_cross(gp, l.n, l.A2, gA1);
    add_cross(gq, l.A2, l.n, gA);
    add_cross(gq, l.n, l.A, gA2);
    add_cross(1, l.A1, gn, gA);
    add_cross(1, gn, l.A, gA1);
    static const double nothing[3];
    give(adjoint, VES_FIELD_U, at, gA);
    give(adjoint, VES_FIELD_V, at, nothing);
    give(adjoint, VES_FIELD_UU, at, gB);
    give(adjoint, VES_FIELD_UV, at, gA1);
    give(adjoint, VES_FIELD_VV, at, nothing);
    give(adjoint, VES_FIELD_UVV, at, gA2);
    give(adjoint, VES_FIELD_UUV, at, gB1);
    give(adjoint, VES_FIELD_UUVV, at, gB2);
}

void ves_pole_gradient(const ves_tile *tile, const int s[VES_LANES], const ves_tile_planes *field,
                       ves_tile_planes *adjoint)
{
    int count = tile->rows * VES_LANES;
    for (int k = VES_FIELDS * 3; k < VES_POLE_FIELDS * 3; k++)
        memset(adjoint->at[k], 0, sizeof(double) * (size_t)count);
    for (int at = 0; at < count; at++)
        if (s[at % VES_LANES]) fold(s[at % VES_LANES], at, field, adjoint);
}
