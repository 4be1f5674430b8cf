#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <stdio.h>

#include "bridge/bridge.h"
#include "shapes.h"

static ves_mesh mesh_of(ves_figure *figure)
{
    ves_mesh mesh;
    cr_assert(eq(int, ves_figure_mesh(figure, true, &mesh), VES_OK));
    return mesh;
}

static ves_mesh_facts facts_of(ves_figure *figure)
{
    char message[VES_BRIDGE_TEXT];
    ves_mesh_facts facts;
    ves_mesh mesh = mesh_of(figure);
    cr_assert(eq(int, ves_bridge_facts(&mesh, true, &facts, message), VES_OK), "%s", message);
    cr_assert(message[0] == 0, "unexpected remark: %s", message);
    return facts;
}

static void check_closed(const ves_mesh_facts *f, const char *what)
{
    cr_assert(f->closed && f->outward && f->components == 1 && f->border_edges == 0 && f->crossings == 0,
              "%s: closed %d outward %d components %d border %d crossings %d", what, f->closed, f->outward,
              f->components, f->border_edges, f->crossings);
}

/* Area and volume without CGAL: cross products and tetrahedra. */
static void by_hand(const ves_mesh *mesh, double *area, double *volume)
{
    *area = *volume = 0;
    for (int t = 0; t < mesh->triangles; t++) {
        const double *a = mesh->point + 3 * mesh->corner[3 * t],
                     *b = mesh->point + 3 * mesh->corner[3 * t + 1];
        const double *c = mesh->point + 3 * mesh->corner[3 * t + 2];
        double n[3], p[3], q[3];
        for (int k = 0; k < 3; k++) p[k] = b[k] - a[k], q[k] = c[k] - a[k];
        for (int k = 0; k < 3; k++) n[k] = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
        *area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
        *volume += (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / 6;
    }
}

/* An inscribed mesh misses area and volume by O(h^2): halving h divides the error by 4. Tolerance 0.1 of the
 * order: the next term is O(h^4), 1 % of the error at the coarsest pair. */
static void check_order(const char *what, double coarse, double fine, double exact)
{
    double order = log2(fabs(coarse - exact) / fabs(fine - exact));
    cr_assert(fabs(order - 2) < 0.1, "%s: got order %.3f, want 2 (%.9g, %.9g -> %.9g)", what, order, coarse,
              fine, exact);
}

Test(bridge, sphere_of_two_patches_converges_at_order_two)
{
    double R = 1.37, area = 4 * PI * R * R, volume = area * R / 3, before[2] = {0};
    for (int n = 8; n <= 64; n *= 2) {
        ves_figure figure;
        shape_sphere(&figure, R, n, 4 * n);
        ves_mesh mesh = mesh_of(&figure);
        cr_assert(eq(int, mesh.vertices, 4 * n * (2 * n - 1) + 2), "two poles, one equator");
        cr_assert(eq(int, mesh.triangles, 2 * (mesh.vertices - 2)), "Euler: F = 2 V - 4");
        ves_mesh_facts f = facts_of(&figure);
        check_closed(&f, "sphere");
        if (n > 8)
            check_order("area", before[0], f.area, area), check_order("volume", before[1], f.volume, volume);
        before[0] = f.area, before[1] = f.volume;
        shape_end(&figure);
    }
}

Test(bridge, torus_whose_ends_are_one_seam_is_closed)
{
    double param[] = {1.9, 0.6}, area = 4 * PI * PI * 1.9 * 0.6, volume = 2 * PI * PI * 1.9 * 0.36,
           before[2] = {0};
    for (int n = 16; n <= 64; n *= 2) {
        ves_figure figure;
        shape_ring(&figure, shape_torus, param, 2 * n, n);
        ves_mesh mesh = mesh_of(&figure);
        cr_assert(eq(int, mesh.vertices, 2 * n * n));
        cr_assert(eq(int, mesh.triangles, 4 * n * n), "Euler: F = 2 V");
        ves_mesh_facts f = facts_of(&figure);
        check_closed(&f, "torus");
        if (n > 16)
            check_order("area", before[0], f.area, area), check_order("volume", before[1], f.volume, volume);
        before[0] = f.area, before[1] = f.volume;
        shape_end(&figure);
    }
}

Test(bridge, caps_close_a_tube_and_point_outward)
{
    double r = 0.385, length = 2.2;
    int n = 24;
    for (int caps = 0; caps < 2; caps++) {
        ves_figure figure;
        shape_pipe(&figure, r, length, caps, 7, n);
        ves_mesh_facts f = facts_of(&figure);
        cr_assert(eq(int, f.closed, caps));
        cr_assert(eq(int, f.border_edges, caps ? 0 : 2 * n));
        cr_assert(eq(int, f.crossings, 0));
        /* A prism over a regular polygon; rounding of ~1e3 additions: 1e-13 relative. */
        double side = 2 * n * r * sin(PI / n) * length, lid = n / 2.0 * r * r * sin(2 * PI / n);
        double area = side + (caps ? 2 * lid : 0), volume = caps ? lid * length : 0;
        cr_assert(fabs(f.area - area) < 1e-13 * area, "area: got %.17g want %.17g", f.area, area);
        cr_assert(fabs(f.volume - volume) < 1e-13, "volume: got %.17g want %.17g", f.volume, volume);
        if (caps) check_closed(&f, "capped tube");
        shape_end(&figure);
    }
}

Test(bridge, cgal_agrees_with_sums_over_the_triangles)
{
    double torus[] = {1.3, 0.4};
    for (int k = 0; k < 3; k++) {
        ves_figure figure;
        double area, volume;
        if (k == 0) shape_sphere(&figure, 0.83, 11, 26);
        if (k == 1) shape_ring(&figure, shape_torus, torus, 33, 17);
        if (k == 2) shape_pipe(&figure, 0.7, 1.1, true, 5, 19);
        ves_mesh mesh = mesh_of(&figure);
        ves_mesh_facts f = facts_of(&figure);
        by_hand(&mesh, &area, &volume);
        /* the same sums in another order, ~1e3 terms: 1e-13 relative */
        cr_assert(fabs(f.area - area) < 1e-13 * area, "area: got %.17g want %.17g", f.area, area);
        cr_assert(fabs(f.volume - volume) < 1e-13 * volume, "volume: got %.17g want %.17g", f.volume, volume);
        shape_end(&figure);
    }
}

Test(bridge, crossing_surfaces_are_found_and_others_are_not)
{
    double eight[] = {0.12}, fat[] = {0.5, 0.8}, thin[] = {0.9, 0.8};
    for (int k = 0; k < 4; k++) {
        char message[VES_BRIDGE_TEXT];
        ves_figure figure;
        bool crosses, want = k < 2;
        if (k == 0) shape_ring(&figure, shape_eight, eight, 80, 16);
        if (k == 1) shape_ring(&figure, shape_torus, fat, 40, 24); /* a spindle: R < r */
        if (k == 2) shape_ring(&figure, shape_torus, thin, 40, 24);
        if (k == 3) shape_sphere(&figure, 2.1, 12, 40);
        ves_mesh mesh = mesh_of(&figure);
        cr_assert(eq(int, ves_bridge_crosses(&mesh, &crosses, message), VES_OK), "%s", message);
        cr_assert(eq(int, crosses, want), "shape %d", k);
        ves_mesh_facts f;
        cr_assert(eq(int, ves_bridge_facts(&mesh, true, &f, message), VES_OK), "%s", message);
        cr_assert(eq(int, f.crossings > 0, want), "shape %d: %d pairs", k, f.crossings);
        cr_assert(eq(int, ves_bridge_facts(&mesh, false, &f, message), VES_OK));
        cr_assert(eq(int, f.crossings, -1), "not asked for");
        shape_end(&figure);
    }
}

Test(bridge, a_shape_inside_out_is_told)
{
    ves_figure figure;
    shape_sphere(&figure, 1, 6, 20);
    for (int k = 0; k < 2; k++) figure.patch[k].side *= -1;
    ves_mesh_facts f = facts_of(&figure);
    cr_assert(f.closed && !f.outward && f.volume < 0, "closed %d outward %d volume %g", f.closed, f.outward,
              f.volume);
    shape_end(&figure);
}

Test(bridge, separate_parts_are_counted)
{
    const double low[] = {1, 0, PI, 0}, high[] = {0.5, 0, PI, 4};
    ves_figure figure;
    shape_begin(&figure, 2, "Two balls", true);
    for (int k = 0; k < 2; k++) {
        ves_figure_patch *p = shape_patch(&figure, k, "ball", 10, 12, shape_ball, k ? high : low);
        p->pole[0] = p->pole[1] = true;
    }
    ves_mesh_facts f = facts_of(&figure);
    cr_assert(f.closed && f.outward && f.components == 2, "components: got %d want 2", f.components);
    shape_end(&figure);
}

Test(bridge, broken_meshes_are_refused_with_the_place)
{
    static double cube[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                  hole[12] = {0, 0, 0, NAN, 0, 0, 0, 1, 0, 0, 0, 1};
    static int outside[] = {0, 1, 4}, twice[] = {0, 1, 1}, round[] = {0, 1, 2, 0, 1, 3}, lonely[] = {0, 1, 2};
    static int three[] = {0, 1, 2, 1, 0, 3, 0, 1, 3}, good[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
#define MESH(n, xyz, list)                                                                                   \
    {                                                                                                        \
        .vertices = 4, .triangles = n, .point = xyz, .corner = list                                          \
    }
    const struct {
        ves_mesh mesh;
        const char *want;
    } cases[] = {
        {MESH(0, cube, NULL), "no triangle"},
        {MESH(1, cube, outside), "triangle 0 has the corner 4, outside 0 .. 3"},
        {MESH(1, cube, twice), "triangle 0 (0, 1, 1) has a corner twice"},
        {MESH(2, cube, round), "triangle 1 (0, 1, 3) does not fit"},
        {MESH(3, cube, three), "triangle 2 (0, 1, 3) does not fit"},
        {MESH(1, cube, lonely), "vertex 3 belongs to no triangle"},
        {MESH(4, hole, good), "vertex 1 is not finite"},
    };
#undef MESH
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char message[VES_BRIDGE_TEXT] = "";
        bool crosses;
        ves_mesh_facts f;
        ves_status status = ves_bridge_facts(&cases[k].mesh, true, &f, message);
        cr_assert(eq(int, status, VES_FAULT), "%s", cases[k].want);
        cr_assert(strstr(message, cases[k].want) != NULL, "got \"%s\" want \"%s\"", message, cases[k].want);
        cr_assert(eq(int, ves_bridge_crosses(&cases[k].mesh, &crosses, message), VES_FAULT));
        cr_assert(eq(int, ves_bridge_write(&cases[k].mesh, VESICA_BUILD "/never.off", message), VES_FAULT));
    }
    ves_mesh whole = {.vertices = 4, .triangles = 4, .point = cube, .corner = good};
    ves_mesh_facts f;
    char message[VES_BRIDGE_TEXT];
    cr_assert(eq(int, ves_bridge_facts(&whole, true, &f, message), VES_OK), "%s", message);
    cr_assert(fabs(f.volume - 1.0 / 6) < 1e-16, "volume of the corner of a cube: got %.17g",
              f.volume); /* rounding */
}

Test(bridge, triangles_without_area_are_tolerated_and_told)
{
    /* the tetrahedron above with a vertex in the middle of an edge, joined by a flat triangle */
    static double point[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0, 0};
    static int corner[] = {0, 2, 1, 0, 1, 4, 0, 4, 3, 4, 1, 3, 1, 2, 3, 2, 0, 3};
    ves_mesh mesh = {.vertices = 5, .triangles = 6, .point = point, .corner = corner};
    char message[VES_BRIDGE_TEXT];
    ves_mesh_facts f;
    bool crosses;
    cr_assert(eq(int, ves_bridge_facts(&mesh, true, &f, message), VES_OK), "%s", message);
    cr_assert(f.closed && f.outward && fabs(f.volume - 1.0 / 6) < 1e-16, "volume %.17g",
              f.volume); /* rounding */
    cr_assert(strstr(message, "1 triangle has no area, the first is 1") != NULL, "got \"%s\"", message);
    /* both sides of the split edge touch the whole one: (0 2 1) and (0 4 3), (0 2 1) and (4 1 3) */
    cr_assert(eq(int, f.crossings, 2));
    cr_assert(eq(int, ves_bridge_crosses(&mesh, &crosses, message), VES_OK));
    cr_assert(crosses && message[0]);
}

Test(bridge, seams_that_do_not_fit_are_refused)
{
    const double ball[] = {1, 0, PI / 2, 0}, low[] = {1, PI / 2, PI, 0};
    for (int k = 0; k < 3; k++) {
        ves_figure figure;
        ves_mesh mesh;
        shape_begin(&figure, 2, "", true);
        ves_figure_patch *p = shape_patch(&figure, 0, "a", 4, 12, shape_ball, ball);
        p->pole[0] = true, p->edge[1] = 5;
        p = shape_patch(&figure, 1, "b", 4, k == 0 ? 10 : 12, shape_ball, low);
        p->pole[1] = true, p->edge[0] = 5;
        if (k == 1) p->pole[0] = true;
        if (k == 2) p->rows = 4;
        cr_assert(eq(int, ves_figure_mesh(&figure, true, &mesh), VES_FAULT), "case %d", k);
        shape_end(&figure);
    }
}

Test(bridge, vertices_know_where_they_came_from)
{
    ves_figure figure;
    ves_mesh mesh;
    int middles = 0;
    shape_pipe(&figure, 0.7, 1.3, true, 6, 18);
    cr_assert(eq(int, ves_figure_mesh(&figure, true, &mesh), VES_OK));
    for (int v = 0; v < mesh.vertices; v++) {
        if (mesh.patch[v] < 0) {
            middles++;
            /* the mean of a ring of 18 points: rounding, 5e-17 was seen */
            cr_assert(hypot(mesh.point[3 * v], mesh.point[3 * v + 1]) < 1e-15, "on the axis");
            continue;
        }
        const ves_figure_patch *p = &figure.patch[mesh.patch[v]];
        int i = (int)lround(mesh.u[v] * p->nu), j = (int)lround(mesh.v[v] * p->nv / (2 * PI));
        for (int c = 0; c < 3; c++) cr_assert(mesh.point[3 * v + c] == p->X[c][i * p->columns + j]);
    }
    cr_assert(eq(int, middles, 2));
    shape_end(&figure);
}

/* Quads sheared along v: the shorter diagonal of each is known. */
static void sheared(const double *p, double u, double v, shape_point *out)
{
    *out = (shape_point){.X = {cos(v + p[0] * u), sin(v + p[0] * u), u}, .normal = {0, 0, 1}};
}

Test(bridge, quads_are_cut_along_the_shorter_diagonal)
{
    for (int k = 0; k < 2; k++) {
        double shear = k ? 0.9 : -0.9;
        int corner[6 * 3 * 12];
        ves_figure figure;
        shape_begin(&figure, 1, "", false);
        ves_figure_patch *p = shape_patch(&figure, 0, "", 3, 12, sheared, &shear);
        int count = ves_figure_triangles(p, corner), straight = 0;
        cr_assert(eq(int, count, 2 * 3 * 12));
        for (int t = 0; t < count; t++) {
            int *c = corner +
                     3 * t; /* the diagonal (i, j) - (i + 1, j + 1) is in every triangle of a straight cut */
            for (int e = 0; e < 3; e++) {
                int a = c[e], b = c[(e + 1) % 3], low = a < b ? a : b, high = a < b ? b : a;
                straight += high / 12 == low / 12 + 1 && high % 12 == (low + 1) % 12;
            }
        }
        cr_assert(eq(int, straight, k ? 0 : count), "shear %g", shear);
        shape_end(&figure);
    }
}

Test(bridge, figures_are_destroyed_whole)
{
    ves_figure *figure = ves_memory_take(sizeof *figure);
    ves_mesh mesh;
    shape_sphere(figure, 1, 4, 8);
    cr_assert(eq(int, ves_figure_mesh(figure, true, &mesh), VES_OK));
    ves_figure_destroy(figure); /* a leak shows under the sanitizer */
    ves_figure_destroy(NULL);
}

Test(bridge, version_is_that_of_the_headers)
{
    int major = 0, minor = -1;
    cr_assert(sscanf(ves_bridge_version(), "%d.%d", &major, &minor) == 2 && major >= 5 && minor >= 0, "%s",
              ves_bridge_version());
}
