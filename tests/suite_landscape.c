/* Landscapes and their instances: gradients against differences, the optimum that is told, moved and
 * turned. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "base/random.h"
#include "suite/instance.h"

enum { N = 60, M = 16, POINTS = 8 };

typedef struct answer {
    ves_verdict verdict;
    double constraint[M], gradient[N], jacobian[M * N];
} answer;

static ves_status ask(const ves_instance *it, const double *u, bool slopes, answer *a)
{
    double room[2 * N];
    a->verdict = (ves_verdict){.constraint = a->constraint, .gradient = a->gradient, .jacobian = a->jacobian};
    return ves_instance_eval(it, u, slopes, &a->verdict, room);
}

static const int sizes[] = {1, 2, 3, 4, 5, 6, 7, 8, 10, 13, 15, 30};

/* Every landscape in every of these sizes that it takes, turned too where it can be. */
static void for_all(void (*look)(const ves_instance *it))
{
    int seen = 0;
    for (const ves_landscape *const *l = ves_landscapes(); *l; l++)
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
            for (int turned = 0; turned <= (*l)->free; turned++) {
                ves_arena arena = {0};
                ves_instance it;
                if (!ves_landscape_takes(*l, sizes[k])) continue;
                cr_assert(ves_instance_init(&arena, *l, sizes[k], turned, 1, 2, &it) == VES_OK);
                cr_assert(it.m <= M);
                look(&it);
                seen++;
                ves_arena_destroy(&arena);
            }
    cr_assert(seen > 100, "only %d instances", seen);
}

static double component(const answer *a, int j)
{
    return j < 0 ? a->verdict.value : a->constraint[j];
}

/* Five points of a difference, error h^4 f^(5)/30. The steps are 1e-5 of the box, so that the finest waves,
 * of Weierstrass (3^11 in the box: steps of a thousandth of one), are resolved, and rounding makes 1e-11 of
 * the values. */
static double difference(const ves_instance *it, const double *u, int j, int i, double h)
{
    double at[N], value[4], by[4] = {-2, -1, 1, 2};
    for (int k = 0; k < 4; k++) {
        answer a;
        memcpy(at, u, (size_t)it->n * sizeof *at);
        at[i] += by[k] * h;
        if (ask(it, at, false, &a) != VES_OK) return NAN;
        value[k] = component(&a, j);
    }
    return (value[0] - 8 * value[1] + 8 * value[2] - value[3]) / (12 * h);
}

static void gradients(const ves_instance *it)
{
    bool fine = !strcmp(it->landscape->name, "weierstrass");
    double h = fine ? 2e-8 : 1e-5, rounding = 1e-15 / h;
    int looked = 0;
    for (int p = 0; p < 10 * POINTS && looked < POINTS; p++) {
        double u[N];
        answer a;
        ves_instance_start(77, p, it->n, u);
        if (ask(it, u, true, &a) != VES_OK) continue;
        looked++;
        for (int j = -1; j < it->m; j++) {
            const double *g = j < 0 ? a.gradient : a.jacobian + j * it->n;
            double steep = 0;
            for (int i = 0; i < it->n; i++) steep = fmax(steep, fabs(g[i]));
            for (int i = 0; i < it->n; i++) {
                double want = difference(it, u, j, i, h);
                double bound = 2e-6 * steep + 100 * rounding * fabs(component(&a, j)) + 1e-9;
                cr_expect(fabs(g[i] - want) <= bound, "%s n %d, %d by %d: got %.12g, want %.12g",
                          it->landscape->name, it->n, j, i, g[i], want);
            }
        }
    }
    cr_expect(looked > 0, "%s: no point with a value", it->landscape->name);
}

Test(suite_landscape, gradients_are_those_of_differences)
{
    for_all(gradients);
}

static double violation(const ves_instance *it, const answer *a)
{
    double worst = 0;
    for (int j = 0; j < it->m; j++)
        worst = fmax(worst, it->equality[j] ? fabs(a->constraint[j]) : a->constraint[j]);
    return worst;
}

/* The value is told to 1e-10 of its size (and 1e-12), the place to eight digits and more. */
static void optimum(const ves_instance *it)
{
    double u[N];
    answer a;
    if (!ves_instance_best(it, u)) return;
    for (int i = 0; i < it->n; i++)
        cr_expect(u[i] >= -1e-12 && u[i] <= 1 + 1e-12, "%s: u[%d] = %g", it->landscape->name, i, u[i]);
    cr_assert(ask(it, u, true, &a) == VES_OK);
    double size = fmax(1, fabs(it->optimum)), bad = violation(it, &a);
    cr_expect(fabs(a.verdict.value - it->optimum) <= 1e-9 * size, "%s n %d: got %.15g, want %.15g",
              it->landscape->name, it->n, a.verdict.value, it->optimum);
    cr_expect(bad <= 1e-9, "%s n %d: violated by %g", it->landscape->name, it->n, bad);
}

Test(suite_landscape, the_optimum_is_where_and_what_it_is_told)
{
    for_all(optimum);
}

/* The optimum of what is smooth has a multiplier for each constraint and wall that it touches, none of the
 * wrong sign, so that the slopes cancel: found by projecting one after the other (each row is small; Gauss
 * and Seidel), 1e-6 of the slope, which is what eight digits of the place leave. */
typedef struct touching {
    int count;
    bool both[M + 2 * N];
    double row[M + 2 * N][N], multiplier[M + 2 * N];
} touching;

static void touch(touching *t, int n, const double *row, double sign, bool both)
{
    double length = 0;
    for (int i = 0; i < n; i++) length += row[i] * row[i];
    for (int i = 0; i < n; i++) t->row[t->count][i] = sign * row[i] / sqrt(length);
    t->both[t->count++] = both;
}

static void find_touching(const ves_instance *it, const double *u, const answer *a, touching *t)
{
    t->count = 0;
    for (int j = 0; j < it->m; j++)
        if (it->equality[j] || a->constraint[j] > -1e-8)
            touch(t, it->n, a->jacobian + j * it->n, 1, it->equality[j]);
    for (int i = 0; i < it->n; i++) {
        double wall[N] = {0};
        wall[i] = 1;
        if (u[i] < 1e-9) touch(t, it->n, wall, -1, false);
        if (u[i] > 1 - 1e-9) touch(t, it->n, wall, 1, false);
    }
}

static double left_over(const ves_instance *it, const touching *t, double *rest)
{
    double most = 0;
    for (int sweep = 0; sweep < 20000; sweep++)
        for (int k = 0; k < t->count; k++) {
            double along = 0, *multiplier = (double *)&t->multiplier[k];
            for (int i = 0; i < it->n; i++) along += rest[i] * t->row[k][i];
            double next = *multiplier - along;
            if (!t->both[k] && next < 0) next = 0;
            for (int i = 0; i < it->n; i++) rest[i] += (next - *multiplier) * t->row[k][i];
            *multiplier = next;
        }
    for (int i = 0; i < it->n; i++) most = fmax(most, fabs(rest[i]));
    return most;
}

static void stationary(const ves_instance *it)
{
    static touching t;
    double u[N], rest[N], size = 0;
    answer a;
    if (!ves_instance_best(it, u) || it->n > 15) return;
    if (!strcmp(it->landscape->name, "ackley")) return; /* a kink */
    memset(&t, 0, sizeof t);
    cr_assert(ask(it, u, true, &a) == VES_OK);
    find_touching(it, u, &a, &t);
    for (int i = 0; i < it->n; i++) rest[i] = a.gradient[i], size = fmax(size, fabs(rest[i]));
    double most = left_over(it, &t, rest), want = 1e-6 * fmax(size, it->m ? 0 : 1);
    cr_expect(most <= want, "%s n %d: a slope of %g is left of %g", it->landscape->name, it->n, most, size);
}

Test(suite_landscape, the_optimum_is_stationary)
{
    for_all(stationary);
}

/* Solves A y = b, A [m][m] positive definite but for rounding, by Gauss with pivots. */
static bool solve(int m, double a[M][M], double *b)
{
    for (int k = 0; k < m; k++) {
        int pivot = k;
        for (int i = k + 1; i < m; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
        if (!(fabs(a[pivot][k]) > 1e-14)) return false;
        for (int j = 0; j < m; j++) {
            double other = a[k][j];
            a[k][j] = a[pivot][j], a[pivot][j] = other;
        }
        double other = b[k];
        b[k] = b[pivot], b[pivot] = other;
        for (int i = 0; i < m; i++) {
            double part = i == k ? 0 : a[i][k] / a[k][k];
            for (int j = k; j < m; j++) a[i][j] -= part * a[k][j];
            b[i] -= part * b[k];
        }
    }
    for (int k = 0; k < m; k++) b[k] /= a[k][k];
    return true;
}

/* One step of Newton towards where the equations hold, the shortest one: u - J^T (J J^T)^-1 c. */
static bool step(const ves_instance *it, const answer *a, double *u)
{
    double square[M][M], c[M];
    const double *row[M];
    int count = 0;
    for (int j = 0; j < it->m; j++)
        if (it->equality[j] || a->constraint[j] > 0)
            row[count] = a->jacobian + j * it->n, c[count++] = a->constraint[j];
    for (int j = 0; j < count; j++)
        for (int k = 0; k < count; k++) {
            square[j][k] = 0;
            for (int i = 0; i < it->n; i++) square[j][k] += row[j][i] * row[k][i];
        }
    if (!solve(count, square, c)) return false;
    for (int i = 0; i < it->n; i++) {
        for (int j = 0; j < count; j++) u[i] -= c[j] * row[j][i];
        u[i] = fmin(fmax(u[i], 0), 1);
    }
    return true;
}

/* Random points meet no equation: they are led to one that does, where Newton finds it. */
static bool feasible(const ves_instance *it, double *u, answer *a)
{
    for (int k = 0; k < 40; k++) {
        if (ask(it, u, it->m > 0, a) != VES_OK) return false;
        double bad = violation(it, a);
        if (bad <= 1e-13) return true;
        if (!isfinite(bad) || !step(it, a, u)) return false;
    }
    return false;
}

/* Among points anywhere in the box and around the optimum, near and far. */
static void lowest(const ves_instance *it)
{
    double best[N], u[N], slack = 1e-9 * fmax(1, fabs(it->optimum));
    bool told = ves_instance_best(it, best);
    int seen = 0;
    for (int p = 0; p < 2000; p++) {
        ves_random random = {.seed = 5, .step = (uint64_t)p};
        double reach = pow(10, -8 * ves_random_uniform(&random));
        answer a;
        for (int i = 0; i < it->n; i++) {
            double any = ves_random_uniform(&random), near = told ? best[i] + reach * (2 * any - 1) : any;
            u[i] = p % 2 && near > 0 && near < 1 ? near : any;
        }
        if (!feasible(it, u, &a)) continue;
        seen++;
        cr_expect(a.verdict.value >= it->optimum - slack, "%s n %d: %.15g is below %.15g",
                  it->landscape->name, it->n, a.verdict.value, it->optimum);
    }
    cr_expect(seen > 20, "%s n %d: only %d feasible points", it->landscape->name, it->n, seen);
}

Test(suite_landscape, nothing_is_lower_than_the_optimum)
{
    for_all(lowest);
}

/* A ring with a cusp between two nodes of the sum, of length 2 pi and area 0.7 pi, had 7.73; and the other ring in
 * which descents end, with its long axis along x, bends more than the one that is told. */
Test(suite_landscape, the_elastica_has_no_cusps)
{
    static const double cusp[] = {0.554662024554755,   -0.128174904596847, 0.162892890585771,
                                  0.0207745618819231,  1.30329727610618,   0.0225542591473333,
                                  -0.0299886102481608, -0.0295184505315671},
                        other[] = {1.28885214922476,    -0.126519550678168, 0.0371524656561372,
                                   -0.0214433982674778, 0.526521150071294,  -0.0361352713563027,
                                   0.0812857281950754,  -0.0371740501665956};
    const ves_landscape *l = ves_landscape_find("elastica");
    double constraint[2], place[8];
    ves_verdict out = {.constraint = constraint};
    cr_expect(l->eval(8, cusp, false, &out) == VES_DEGENERATE);
    cr_expect(l->eval(8, other, false, &out) == VES_OK);
    cr_expect(fabs(constraint[0]) < 1e-12 && fabs(constraint[1]) < 1e-12);
    cr_expect(out.value > l->optimum(8, place) + 2e-4, "%.10g", out.value);
}

Test(suite_instance, turns_are_orthogonal_and_instances_differ)
{
    for (int n = 1; n <= 40; n += 13) {
        ves_arena arena = {0};
        ves_instance a, b, again, other;
        const ves_landscape *l = ves_landscape_find("rastrigin");
        cr_assert(ves_instance_init(&arena, l, n, true, 1, 0, &a) == VES_OK);
        cr_assert(ves_instance_init(&arena, l, n, true, 1, 1, &b) == VES_OK);
        cr_assert(ves_instance_init(&arena, l, n, true, 1, 0, &again) == VES_OK);
        cr_assert(ves_instance_init(&arena, l, n, true, 2, 0, &other) == VES_OK);
        for (int i = 0; i < n; i++) {
            cr_expect(a.home[i] == again.home[i] && a.home[i] != b.home[i]);
            cr_expect(a.home[i] != other.home[i], "another seed, another place");
            cr_expect(fabs(a.home[i]) < 0.8 * 5.12, "%g lies in the margin", a.home[i]);
            for (int j = 0; j < n; j++) {
                double sum = 0;
                for (int k = 0; k < n; k++) sum += a.turn[i * n + k] * a.turn[j * n + k];
                cr_expect(fabs(sum - (i == j)) < 1e-14 * n, "%d %d: %g", i, j, sum);
                cr_expect(a.turn[i * n + j] == again.turn[i * n + j]);
            }
        }
        ves_arena_destroy(&arena);
    }
}

Test(suite_instance, what_does_not_fit_is_refused)
{
    ves_arena arena = {0};
    ves_instance it;
    cr_expect(ves_instance_init(&arena, ves_landscape_find("g01"), 12, false, 1, 0, &it) == VES_RANGE);
    cr_expect(ves_instance_init(&arena, ves_landscape_find("lennard_jones"), 10, false, 1, 0, &it) ==
              VES_RANGE);
    cr_expect(ves_instance_init(&arena, ves_landscape_find("schwefel"), 5, true, 1, 0, &it) == VES_RANGE);
    cr_expect(ves_instance_init(&arena, ves_landscape_find("sphere"), 201, false, 1, 0, &it) == VES_RANGE);
    cr_expect(ves_instance_init(&arena, ves_landscape_find("sphere"), 5, false, 1, -1, &it) == VES_RANGE);
    cr_expect(ves_landscape_find("spher") == NULL);
    ves_arena_destroy(&arena);
}

/* The tabled least values of the clusters of 2 and 3 atoms are those of a bond and a triangle, of 4 a
 * tetrahedron. */
Test(suite_landscape, small_clusters)
{
    const double r = pow(2, 1.0 / 6);
    const double x[12] = {
        0, 0, 0, r, 0, 0, r / 2, r * sqrt(0.75), 0, r / 2, r * sqrt(1.0 / 12), r * sqrt(2.0 / 3)};
    const ves_landscape *l = ves_landscape_find("lennard_jones");
    for (int n = 6; n <= 12; n += 3) {
        double none[12];
        ves_verdict out = {.value = NAN};
        cr_assert(l->eval(n, x, false, &out) == VES_OK);
        cr_expect(fabs(out.value - l->optimum(n, none)) < 1e-13, "got %.17g", out.value);
    }
}
