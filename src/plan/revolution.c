#include "plan/revolution.h"

#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "base/vector.h"
#include "plan/inside.h"

enum { PIECE = 8, AROUND = 7, STRETCH = 64, WAVES_LEAST = 12, WAVES_MOST = 96 };

static const double ROUND = 1e-8; /* of the size: a surface made of modes 0 and 1 departs by rounding */
static const double UPRIGHT = 0.9999, LEANING = 0.3; /* how much of the field must lie along the normal */

/* --- the row of patches --- */

static ves_status refuse(const ves_plan *plan, ves_diag *diag, const char *why)
{
    return ves_diag_add(
        diag, VES_ERROR, VES_ABSENT, (ves_mark){0},
        "%s: stability is told of closed surfaces of revolution, patches in a row from pole to "
        "pole, and this shape %s",
        plan->problem->name, why);
}

/* The other end on the curve of this one. */
static bool next_end(const ves_plan *plan, int *patch, int *end)
{
    const int curve = ves_end_curve(plan, *patch, *end);
    if (curve < 0 || ves_ends_on(plan, curve) != 2) return false;
    for (int p = 0; p < plan->problem->patches; p++)
        for (int e = 0; e < 2; e++) {
            if (ves_end_curve(plan, p, e) != curve || (p == *patch && e == *end)) continue;
            *patch = p, *end = e;
            return true;
        }
    return false;
}

/* first[k]: the end of patch row[k] that is nearer to the first pole. */
static const char *row_find(const ves_plan *plan, int *row, int *first)
{
    const int patches = plan->problem->patches;
    int p = 0, e = 0, count = 0;
    while (p < patches && !ves_end_is_pole(plan, p, 0) && !ves_end_is_pole(plan, p, 1)) p++;
    if (p == patches) return "has no pole";
    e = ves_end_is_pole(plan, p, 0) ? 0 : 1;
    for (;;) {
        if (count == patches) return "is no such row";
        row[count] = p, first[count++] = e;
        e = 1 - e;
        if (ves_end_is_pole(plan, p, e)) break;
        if (!next_end(plan, &p, &e)) return "has an end where nothing goes on";
    }
    return count == patches ? NULL : "has more than one part";
}

static const char *joints_look(ves_plan *plan, ves_status *status)
{
    for (int k = 0; k < ves_plan_joints(plan); k++) {
        ves_joint joint;
        *status = ves_plan_joint(plan, k, &joint);
        if (*status != VES_OK) return "has a joint that cannot be measured";
        if (joint.continuity == VES_JOINT_OPEN || joint.continuity == VES_JOINT_C0) return "has a crease";
    }
    return NULL;
}

/* --- its axis --- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static ves_status point(ves_plan *plan, int patch, double u, double v, double x[3])
{
    double out[3 * VES_FIELDS];
    VES_TRY(ves_plan_points(plan, patch, 1, &u, &v, out));
    memcpy(x, out, 3 * sizeof *x);
    return VES_OK;
}

/* The unit vector from the axis to x, or false. */
static bool outward(const plan_revolution *s, const double x[3], double e[3])
{
    double d[3], size = 0;
    for (int c = 0; c < 3; c++) d[c] = x[c] - s->middle[c];
    const double z = dot(d, s->frame[2]);
    for (int c = 0; c < 3; c++) e[c] = d[c] - z * s->frame[2][c], size += e[c] * e[c];
    for (int c = 0; c < 3; c++) e[c] /= sqrt(size);
    return size > 0;
}

static ves_status axis_find(ves_plan *plan, const int *row, const int *first, plan_revolution *s, bool *found)
{
    double from[3], to[3], x[3], y[3], size = 0;
    const int last = plan->problem->patches - 1;
    VES_TRY(point(plan, row[0], first[0], 0, from));
    VES_TRY(point(plan, row[last], 1 - first[last], 0, to));
    VES_TRY(point(plan, row[0], 0.5, 0, x));
    VES_TRY(point(plan, row[0], 0.5, VES_TWO_PI / 4, y));
    for (int c = 0; c < 3; c++) {
        s->frame[2][c] = to[c] - from[c], size += s->frame[2][c] * s->frame[2][c];
        s->middle[c] = (from[c] + to[c]) / 2;
    }
    for (int c = 0; c < 3; c++) s->frame[2][c] /= sqrt(size);
    *found = size > 0 && outward(s, x, s->frame[0]) && outward(s, y, s->frame[1]);
    return VES_OK;
}

/* --- the meridian --- */

static ves_status meridian_take(const plan_site *site, ves_arena *arena, plan_meridian *m)
{
    const size_t n = (size_t)site->grid.nu;
    double **const plane[] = {&m->weight,    &m->bend,      &m->r[0],     &m->r[1],     &m->z[0],
                              &m->z[1],      &m->S[0],      &m->S[1],     &m->S[2],     &m->radial[0],
                              &m->radial[1], &m->radial[2], &m->axial[0], &m->axial[1], &m->axial[2]};
    m->patch = site->patch, m->nu = site->grid.nu;
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++) {
        *plane[k] = ves_arena_take(arena, n, sizeof(double));
        if (!*plane[k]) return VES_MEMORY;
    }
    for (int i = 0; i < m->nu; i++) m->weight[i] = site->grid.weight[i] * site->grid.nv;
    return VES_OK;
}

static double speed_at(const double *plane, int count, int k)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double x = plane[(VES_FIELD_U * 3 + c) * count + k];
        sum += x * x;
    }
    return sqrt(sum);
}

/* Lengths from u = 0 to each node, and to u = 1 at [nu]: Gauss's rule between every two. */
static ves_status lengths(ves_plan *plan, const plan_site *site, double *length)
{
    double node[PIECE], weight[PIECE], u[PIECE], v[PIECE] = {0}, out[PIECE * 3 * VES_FIELDS], sum = 0,
                                                 from = 0;
    ves_gauss_nodes(PIECE, node, weight);
    for (int i = 0; i <= site->grid.nu; i++) {
        const double to = i < site->grid.nu ? site->grid.u[i] : 1;
        for (int k = 0; k < PIECE; k++) u[k] = from + node[k] * (to - from);
        VES_TRY(ves_plan_points(plan, site->patch, PIECE, u, v, out));
        for (int k = 0; k < PIECE; k++) sum += weight[k] * (to - from) * speed_at(out, PIECE, k);
        length[i] = sum, from = to;
    }
    return VES_OK;
}

/* Is the site round the axis, and v its angle? Fills r, z and the derivatives of the length. */
static ves_status look_around(ves_plan *plan, const plan_revolution *s, const plan_site *site,
                              plan_meridian *m, double *off)
{
    static const double angle[AROUND] = {0, 0.7, 1.6, 2.5, 3.7, 4.4, 5.9};
    *off = 0;
    for (int i = 0; i < m->nu; i++) {
        double u[AROUND], out[AROUND * 3 * VES_FIELDS];
        for (int k = 0; k < AROUND; k++) u[k] = site->grid.u[i];
        VES_TRY(ves_plan_points(plan, m->patch, AROUND, u, angle, out));
        double at[VES_FIELDS][3];
        for (int f = 0; f < VES_FIELDS; f++)
            for (int c = 0; c < 3; c++)
                at[f][c] = out[(f * 3 + c) * AROUND] - (f == VES_FIELD_X ? s->middle[c] : 0);
        const double *x = at[VES_FIELD_X], *xu = at[VES_FIELD_U];
        m->r[0][i] = dot(x, s->frame[0]), m->z[0][i] = dot(x, s->frame[2]);
        m->r[1][i] = dot(xu, s->frame[0]), m->z[1][i] = dot(xu, s->frame[2]);
        m->S[1][i] = sqrt(dot(xu, xu));
        m->S[2][i] = dot(xu, at[VES_FIELD_UU]) / m->S[1][i];
        m->bend[i] = fabs(m->r[1][i] * dot(at[VES_FIELD_UU], s->frame[2]) -
                          m->z[1][i] * dot(at[VES_FIELD_UU], s->frame[0])) /
                     (m->S[1][i] * m->S[1][i] * m->S[1][i]);
        for (int k = 0; k < AROUND; k++)
            for (int c = 0; c < 3; c++) {
                const double want =
                    s->middle[c] + m->z[0][i] * s->frame[2][c] +
                    m->r[0][i] * (cos(angle[k]) * s->frame[0][c] + sin(angle[k]) * s->frame[1][c]);
                *off = fmax(*off, fabs(out[c * AROUND + k] - want));
            }
    }
    return VES_OK;
}

static ves_status meridian_make(ves_plan *plan, const plan_revolution *s, bool against, plan_meridian *m,
                                double *off)
{
    const plan_site *site = &plan->level[0].site[m->patch];
    ves_arena arena = {0};
    double *length = ves_arena_take(&arena, (size_t)m->nu + 1, sizeof *length);
    ves_status status = length ? lengths(plan, site, length) : VES_MEMORY;
    if (status == VES_OK) status = look_around(plan, s, site, m, off);
    for (int i = 0; status == VES_OK && i < m->nu; i++) {
        m->S[0][i] = against ? length[m->nu] - length[i] : length[i];
        if (against) m->S[1][i] = -m->S[1][i], m->S[2][i] = -m->S[2][i];
    }
    if (status == VES_OK) m->length = length[m->nu];
    ves_arena_destroy(&arena);
    return status;
}

/* --- the field --- */

/* The integral of the density of S along the meridian, times a wave. The density has no kink where the curvature
 * changes its sign: a function of S would need many waves to be straight there. */
static double density_wave(const plan_revolution *s, double mean, int j)
{
    double sum = 0;
    for (int k = 0; k < s->patches; k++) {
        const plan_meridian *m = &s->meridian[k];
        for (int i = 0; i < m->nu; i++)
            sum +=
                m->weight[i] / VES_TWO_PI * fabs(m->S[1][i]) * hypot(mean, m->bend[i]) * cos(j * m->S[0][i]);
    }
    return sum;
}

/* From arc lengths to S, by the root of the squares of the curvature and of its mean, smoothed by Fejer's sums, which
 * keep it positive, in waves that are even at both poles: what is smooth in S is smooth on the surface. */
static void stretch(const plan_revolution *s)
{
    double wave[STRETCH];
    const double mean = density_wave(s, 0, 0) / VES_PI, all = density_wave(s, mean, 0);
    for (int j = 1; j < STRETCH; j++)
        wave[j] = 2 * (1 - (double)j / STRETCH) * density_wave(s, mean, j) / all;
    for (int k = 0; k < s->patches; k++) {
        plan_meridian *m = &s->meridian[k];
        const double end = m->end;
        for (int j = 1; j < STRETCH; j++) m->end += wave[j] * sin(j * end) / j;
        for (int i = 0; i < m->nu; i++) {
            double x = m->S[0][i], by = 1, twice = 0;
            for (int j = 1; j < STRETCH; j++) {
                x += wave[j] * sin(j * m->S[0][i]) / j;
                by += wave[j] * cos(j * m->S[0][i]);
                twice -= wave[j] * j * sin(j * m->S[0][i]);
            }
            m->S[2][i] = twice * m->S[1][i] * m->S[1][i] + by * m->S[2][i];
            m->S[1][i] *= by, m->S[0][i] = x;
        }
    }
}

/* The normal's waves along the whole meridian: an even function of S along the axis, an odd one across, as the
 * smoothness at the poles asks. Smooth across joints, where the normal itself may have a kink. */
static void field_make(const plan_revolution *s, int waves)
{
    for (int k = 0; k < s->patches; k++) {
        plan_meridian *m = &s->meridian[k];
        for (int d = 0; d < 3; d++) {
            memset(m->radial[d], 0, sizeof(double) * (size_t)m->nu);
            memset(m->axial[d], 0, sizeof(double) * (size_t)m->nu);
        }
    }
    for (int j = 0; j <= waves; j++) {
        double a = 0, b = 0;
        for (int k = 0; k < s->patches; k++) {
            const plan_meridian *m = &s->meridian[k];
            for (int i = 0; i < m->nu; i++) {
                const double speed = hypot(m->r[1][i], m->z[1][i]); /* N = (dz, -dr) / ds */
                const double f = m->weight[i] / VES_TWO_PI * m->S[1][i] / speed * (j ? 2 : 1) / VES_PI;
                a += f * m->z[1][i] * sin(j * m->S[0][i]);
                b -= f * m->r[1][i] * cos(j * m->S[0][i]);
            }
        }
        for (int k = 0; k < s->patches; k++) {
            const plan_meridian *m = &s->meridian[k];
            for (int i = 0; i < m->nu; i++) {
                const double p = m->S[1][i], q = m->S[2][i], sine = sin(j * m->S[0][i]),
                             cosine = cos(j * m->S[0][i]);
                m->radial[0][i] += a * sine, m->axial[0][i] += b * cosine;
                m->radial[1][i] += a * j * cosine * p, m->axial[1][i] -= b * j * sine * p;
                m->radial[2][i] += a * j * (cosine * q - j * sine * p * p);
                m->axial[2][i] -= b * j * (sine * q + j * cosine * p * p);
            }
        }
    }
}

ves_status ves_metric_create(int nu, ves_arena *arena, plan_metric *m)
{
    double **const plane[] = {&m->share, &m->dA, &m->Nr, &m->Nz, &m->r, &m->z};
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++) {
        *plane[k] = ves_arena_take(arena, (size_t)nu, sizeof(double));
        if (!*plane[k]) return VES_MEMORY;
    }
    return VES_OK;
}

void ves_metric_find(const plan_meridian *m, double *const even[3], plan_metric *out)
{
    const double sign = m->S[1][0] > 0 ? 1 : -1;
    for (int i = 0; i < m->nu; i++) {
        double r = m->r[0][i], z = m->z[0][i], ru = m->r[1][i], zu = m->z[1][i];
        if (even) {
            const double w = even[0][i], wu = even[1][i];
            r += w * m->radial[0][i], z += w * m->axial[0][i];
            ru += wu * m->radial[0][i] + w * m->radial[1][i];
            zu += wu * m->axial[0][i] + w * m->axial[1][i];
        }
        const double speed = hypot(ru, zu);
        out->Nr[i] = sign * zu / speed, out->Nz[i] = -sign * ru / speed;
        out->share[i] = out->Nr[i] * m->radial[0][i] + out->Nz[i] * m->axial[0][i];
        out->dA[i] = m->weight[i] * r * speed;
        out->r[i] = r, out->z[i] = z;
    }
}

static double least_share(const plan_revolution *s)
{
    double least = 1;
    for (int k = 0; k < s->patches; k++) {
        const plan_meridian *m = &s->meridian[k];
        const double sign = m->S[1][0] > 0 ? 1 : -1;
        for (int i = 0; i < m->nu; i++)
            least = fmin(least, sign * (m->z[1][i] * m->radial[0][i] - m->r[1][i] * m->axial[0][i]) /
                                    hypot(m->r[1][i], m->z[1][i]));
    }
    return least;
}

static bool field_find(const plan_revolution *s)
{
    int nodes = 0;
    for (int k = 0; k < s->patches; k++) nodes += s->meridian[k].nu;
    for (int waves = WAVES_LEAST; waves <= WAVES_MOST && 2 * waves <= nodes; waves *= 2) {
        field_make(s, waves);
        if (least_share(s) >= UPRIGHT) return true;
    }
    return least_share(s) >= LEANING;
}

/* --- all of it --- */

static ves_status meridians_make(ves_plan *plan, ves_arena *arena, const int *row, const int *first,
                                 plan_revolution *s, bool *found)
{
    s->length = 0;
    for (int k = 0; k < s->patches; k++) {
        plan_meridian *m = &s->meridian[k];
        double off;
        VES_TRY(meridian_take(&plan->level[0].site[row[k]], arena, m));
        VES_TRY(meridian_make(plan, s, first[k] == 1, m, &off));
        for (int i = 0; i < m->nu; i++) m->S[0][i] += s->length;
        s->length += m->length;
        m->end = s->length;
        *found = *found && off <= ROUND * m->length;
    }
    for (int k = 0; k < s->patches; k++) {
        plan_meridian *m = &s->meridian[k];
        for (int d = 0; d < 3; d++)
            for (int i = 0; i < m->nu; i++) m->S[d][i] *= VES_PI / s->length;
        m->end *= VES_PI / s->length;
    }
    return VES_OK;
}

ves_status ves_revolution_find(ves_plan *plan, ves_arena *arena, plan_revolution *s, ves_diag *diag)
{
    const size_t patches = (size_t)plan->problem->patches;
    int *row = ves_arena_take(arena, patches, sizeof *row),
        *first = ves_arena_take(arena, patches, sizeof *first);
    s->patches = (int)patches;
    s->meridian = ves_arena_take(arena, patches, sizeof *s->meridian);
    if (!row || !first || !s->meridian) return ves_diag_fail(diag, VES_MEMORY);
    ves_status status = VES_OK;
    bool found = true;
    const char *why = row_find(plan, row, first);
    if (!why) why = joints_look(plan, &status);
    if (status == VES_MEMORY) return ves_diag_fail(diag, status);
    if (why) return refuse(plan, diag, why);
    status = axis_find(plan, row, first, s, &found);
    if (status == VES_OK && found) status = meridians_make(plan, arena, row, first, s, &found);
    if (status != VES_OK) return ves_diag_fail(diag, status);
    if (!found) return refuse(plan, diag, "is not round");
    stretch(s);
    return field_find(s) ? VES_OK : refuse(plan, diag, "has turns too sharp for it");
}
