#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <signal.h>
#include <stdint.h>
#include <sys/resource.h>

#include "bridge/bridge.h"
#include "files.h"
#include "output/output.h"
#include "shapes.h"

static char first_message[1024];

static ves_status export(ves_figure *figure, const char *format, const char *path)
{
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_format_find(format)->write(figure, path, diag);
    first_message[0] = 0;
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, first_message, sizeof first_message);
    ves_diag_destroy(diag);
    return status;
}

static unsigned char *exported(ves_figure *figure, const char *format, size_t *size)
{
    char name[16];
    snprintf(name, sizeof name, "a.%s", format);
    const char *path = path_of(name);
    cr_assert(eq(int, export(figure, format, path), VES_OK), "%s: %s", format, first_message);
    cr_assert(first_message[0] == 0, "%s: %s", format, first_message);
    return (unsigned char *)slurp_bytes(path, size);
}

Test(output, formats_are_listed_sorted_and_found)
{
    int count = 0;
    for (const ves_format *const *f = ves_formats(); *f; f++, count++) {
        cr_assert(count == 0 || strcmp(f[-1]->name, (*f)->name) < 0, "%s", (*f)->name);
        cr_assert(ves_format_find((*f)->name) == *f && (*f)->about[0]);
    }
    cr_assert(count >= 6, "got %d formats", count);
    cr_assert(ves_format_find("stp") == NULL);
}

/* --- meshes, read again by small parsers --- */

/* Each edge must be met once in each direction. */
static int open_edges(const float *corner, int triangles)
{
    int missing = 0;
    for (int a = 0; a < 3 * triangles; a++) {
        const float *from = corner + 3 * a, *to = corner + 3 * (a % 3 == 2 ? a - 2 : a + 1);
        int met = 0;
        for (int b = 0; b < 3 * triangles; b++) {
            const float *f = corner + 3 * b, *t = corner + 3 * (b % 3 == 2 ? b - 2 : b + 1);
            met += !memcmp(f, to, 12) && !memcmp(t, from, 12);
        }
        missing += met != 1;
    }
    return missing;
}

Test(output, stl_is_closed_edge_by_edge)
{
    for (int k = 0; k < 2; k++) {
        ves_figure figure;
        size_t size;
        uint32_t triangles;
        if (k == 0)
            shape_sphere(&figure, 1.3, 6, 16);
        else
            shape_pipe(&figure, 0.6, 1.7, true, 4, 14);
        ves_mesh mesh;
        ves_figure_mesh(&figure, true, &mesh);
        unsigned char *data = exported(&figure, "stl", &size);
        memcpy(&triangles, data + 80, 4);
        cr_assert(eq(int, (int)triangles, mesh.triangles));
        cr_assert(size == 84 + 50 * (size_t)triangles, "got %zu bytes", size);
        float *corner = malloc(36 * (size_t)triangles);
        double outward = 0;
        for (uint32_t t = 0; t < triangles; t++) {
            float n[3];
            memcpy(n, data + 84 + 50 * t, 12);
            memcpy(corner + 9 * t, data + 84 + 50 * t + 12, 36);
            for (int c = 0; c < 3; c++) outward += n[c] * corner[9 * t + c];
        }
        cr_assert(eq(int, open_edges(corner, (int)triangles), 0));
        cr_assert(outward > 0, "normals point outward");
        free(corner);
        free(data);
        shape_end(&figure);
    }
    clean();
}

/* All coordinates come back exactly: 17 digits, or 8 bytes. */
static void check_point(const ves_mesh *mesh, int v, const double x[3], const char *what)
{
    for (int c = 0; c < 3; c++)
        cr_assert(x[c] == mesh->point[3 * v + c], "%s: vertex %d got %.17g want %.17g", what, v, x[c],
                  mesh->point[3 * v + c]);
}

static void check_corners(const ves_mesh *mesh, int t, const int c[3], const char *what)
{
    const int *w = mesh->corner + 3 * t;
    bool same = false; /* the first corner may differ */
    for (int k = 0; k < 3; k++)
        same = same || (c[k] == w[0] && c[(k + 1) % 3] == w[1] && c[(k + 2) % 3] == w[2]);
    cr_assert(same, "%s: triangle %d got %d %d %d want %d %d %d", what, t, c[0], c[1], c[2], w[0], w[1],
              w[2]);
}

static void check_obj(char *text, const ves_mesh *mesh)
{
    int vertices = 0, triangles = 0, c[3];
    double x[3];
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        if (sscanf(line, "v %lf %lf %lf", x, x + 1, x + 2) == 3) check_point(mesh, vertices++, x, "obj");
        if (sscanf(line, "f %d %d %d", c, c + 1, c + 2) == 3) {
            for (int k = 0; k < 3; k++) c[k]--;
            check_corners(mesh, triangles++, c, "obj");
        }
    }
    cr_assert(eq(int, vertices, mesh->vertices));
    cr_assert(eq(int, triangles, mesh->triangles));
}

static void check_off(char *text, const ves_mesh *mesh)
{
    int vertices, triangles, edges, at = 0, step, n, c[3];
    double x[3];
    cr_assert(sscanf(text, "OFF %d %d %d%n", &vertices, &triangles, &edges, &at) == 3, "%.20s", text);
    cr_assert(vertices == mesh->vertices && triangles == mesh->triangles);
    for (int v = 0; v < vertices; v++, at += step) {
        cr_assert(sscanf(text + at, "%lf %lf %lf%n", x, x + 1, x + 2, &step) == 3);
        check_point(mesh, v, x, "off");
    }
    for (int t = 0; t < triangles; t++, at += step) {
        cr_assert(sscanf(text + at, "%d %d %d %d%n", &n, c, c + 1, c + 2, &step) == 4 && n == 3);
        check_corners(mesh, t, c, "off");
    }
}

static void check_ply(const char *data, size_t size, const ves_mesh *mesh)
{
    int vertices = -1, faces = -1, c[3];
    double x[3];
    sscanf(strstr(data, "element vertex"), "element vertex %d", &vertices);
    sscanf(strstr(data, "element face"), "element face %d", &faces);
    cr_assert(vertices == mesh->vertices && faces == mesh->triangles);
    cr_assert(strstr(data, "binary_little_endian") && strstr(data, "property double x"), "%.300s", data);
    const char *at = strstr(data, "end_header\n") + 11;
    cr_assert(size == (size_t)(at - data) + 24 * (size_t)vertices + 13 * (size_t)faces, "%zu bytes", size);
    for (int v = 0; v < vertices; v++, at += 24) memcpy(x, at, 24), check_point(mesh, v, x, "ply");
    for (int t = 0; t < faces; t++, at += 13) {
        cr_assert(at[0] == 3);
        memcpy(c, at + 1, 12);
        check_corners(mesh, t, c, "ply");
    }
}

Test(output, obj_off_and_ply_give_back_every_bit)
{
    double torus[] = {1.37, 0.41};
    ves_figure figure;
    ves_mesh mesh;
    size_t size;
    shape_ring(&figure, shape_torus, torus, 23, 12);
    ves_figure_mesh(&figure, true, &mesh);
    char *text = (char *)exported(&figure, "obj", &size);
    check_obj(text, &mesh);
    free(text);
    text = (char *)exported(&figure, "off", &size);
    check_off(text, &mesh);
    free(text);
    text = (char *)exported(&figure, "ply", &size);
    check_ply(text, size, &mesh);
    free(text);
    shape_end(&figure);
    clean();
}

/* --- VTP --- */

/* The block that a DataArray of this name points to; checks its length. */
static const char *block(const char *data, const char *name, size_t bytes)
{
    char key[64];
    unsigned long long offset;
    uint64_t length;
    snprintf(key, sizeof key, "Name=\"%s\"", name);
    const char *array = strstr(data, key), *appended = strstr(data, "<AppendedData encoding=\"raw\">");
    cr_assert(array && appended, "%s", name);
    cr_assert(sscanf(strstr(array, "offset="), "offset=\"%llu\"", &offset) == 1);
    const char *at = strchr(appended, '_') + 1 + offset;
    memcpy(&length, at, sizeof length);
    cr_assert(length == bytes, "%s: got %llu bytes want %zu", name, (unsigned long long)length, bytes);
    return at + sizeof length;
}

static double real(const char *block, size_t k)
{
    double value;
    memcpy(&value, block + 8 * k, 8);
    return value;
}

static int64_t whole(const char *block, size_t k)
{
    int64_t value;
    memcpy(&value, block + 8 * k, 8);
    return value;
}

/* Sum over the triangles of a . (b x c) / 6. */
static double volume_of(const char *x, const char *corner, size_t triangles)
{
    double sum = 0;
    for (size_t t = 0; t < triangles; t++) {
        double p[3][3];
        for (size_t k = 0; k < 3; k++)
            for (size_t c = 0; c < 3; c++) p[k][c] = real(x, 3 * (size_t)whole(corner, 3 * t + k) + c);
        for (int c = 0; c < 3; c++) {
            int d = (c + 1) % 3, e = (c + 2) % 3;
            sum += p[0][c] * (p[1][d] * p[2][e] - p[1][e] * p[2][d]) / 6;
        }
    }
    return sum;
}

Test(output, vtp_holds_points_triangles_and_fields)
{
    static const size_t count[3] = {2 * (1 + 9 * 20), 5 * 14 + 2 * 15, 5 * 14 + 2 * 14};
    int lid[12][3];
    for (int t = 0; t < 12; t++) lid[t][0] = 0, lid[t][1] = t + 1, lid[t][2] = t + 2;
    for (int k = 0; k < 3; k++) {
        ves_figure figure;
        ves_mesh mesh;
        size_t size, points = 0, triangles = 0;
        if (k == 0)
            shape_sphere(&figure, 1.3, 9, 20);
        else
            shape_pipe(&figure, 0.6, 1.7, true, 4, 14);
        if (k == 2) figure.patch[0].lid[0] = figure.patch[0].lid[1] = lid[0];
        figure.title = "Ä <ring> & \"more\"";
        char *data = (char *)exported(&figure, "vtp", &size);
        sscanf(strstr(data, "NumberOfPoints"), "NumberOfPoints=\"%zu\"", &points);
        sscanf(strstr(data, "NumberOfPolys"), "NumberOfPolys=\"%zu\"", &triangles);
        ves_figure_mesh(&figure, true, &mesh);
        cr_assert(triangles == (size_t)mesh.triangles, "got %zu triangles want %d", triangles,
                  mesh.triangles);
        /* patches keep their own points: one pole and nine rows each; or five rows and two caps, as fans with
         * a middle or cut without one */
        cr_assert(points == count[k], "got %zu points", points);
        const char *x = block(data, "Points", 24 * points),
                   *corner = block(data, "connectivity", 24 * triangles);
        const char *end = block(data, "offsets", 8 * triangles),
                   *normal = block(data, "normals", 24 * points);
        const char *h = block(data, "H", 8 * points), *u = block(data, "u", 8 * points);
        const char *v = block(data, "v", 8 * points), *patch = block(data, "patch", 4 * points);
        block(data, "K", 8 * points), block(data, "k1", 8 * points), block(data, "k2", 8 * points);
        for (size_t t = 0; t < triangles; t++) cr_assert(whole(end, t) == 3 * (int64_t)t + 3);
        for (size_t s = 0; s < points; s++) {
            int32_t of;
            double n = 0;
            memcpy(&of, patch + 4 * s, 4);
            for (size_t c = 0; c < 3; c++) n += real(normal, 3 * s + c) * real(normal, 3 * s + c);
            cr_assert(fabs(n - 1) < 1e-14, "unit normals: got %.17g", n); /* rounding */
            double want = k == 0 ? 1 / 1.3 : of < 0 ? 0 : 0.5 / 0.6;
            cr_assert(real(h, s) == want, "H at %zu of %d: got %g want %g", s, of, real(h, s), want);
            cr_assert(real(u, s) >= 0 && real(u, s) <= 1 && real(v, s) >= 0 && real(v, s) < 2 * PI);
            cr_assert(of >= -1 && of < figure.patches);
            if (of < 0) /* pointing out of the pipe */
                cr_assert(real(normal, 3 * s + 2) * (real(x, 3 * s + 2) - 0.65) > 0.84, "cap at %zu", s);
        }
        ves_mesh_facts facts;
        char message[VES_BRIDGE_TEXT];
        ves_bridge_facts(&mesh, false, &facts, message);
        cr_assert(facts.closed && facts.outward);
        double volume = volume_of(x, corner, triangles);
        /* the same triangles: rounding of ~1e3 terms */
        cr_assert(fabs(volume - facts.volume) < 1e-13, "volume: got %.17g want %.17g", volume, facts.volume);
        const char *last = end + 8 * triangles;
        cr_assert(strcmp(last, "\n  </AppendedData>\n</VTKFile>\n") == 0, "got \"%s\"", last);
        cr_assert(strstr(data, "195 132 32 60 114") != NULL, "the title as codes of its bytes");
        free(data);
        shape_end(&figure);
    }
    clean();
}

Test(output, vtp_points_of_a_seam_coincide_to_the_bit)
{
    double torus[] = {1.37, 0.41};
    ves_figure figure;
    size_t size, points = 24 * 12;
    shape_ring(&figure, shape_torus, torus, 23, 12);
    for (int j = 0; j < 12; j++) figure.patch[0].X[1][23 * 12 + j] += 1e-15;
    char *data = (char *)exported(&figure, "vtp", &size);
    const char *x = block(data, "Points", 24 * points);
    cr_assert(memcmp(x, x + 24 * 23 * 12, 24 * 12) == 0, "first and last row");
    free(data);
    shape_end(&figure);
    clean();
}

Test(output, csv_gives_back_every_number)
{
    double torus[] = {1.37, 0.41};
    ves_figure figure;
    size_t size;
    int node = 0;
    shape_ring(&figure, shape_torus, torus, 11, 6);
    figure.patch[0].name = "ring, \"1\"";
    char *data = (char *)exported(&figure, "csv", &size), *line = strtok(data, "\n");
    cr_assert(eq(str, line, "patch,i,j,u,v,x,y,z,nx,ny,nz,H,K,k1,k2"));
    while ((line = strtok(NULL, "\n"))) {
        const ves_figure_patch *p = figure.patch;
        int i, j;
        double u, v, f[10],
            want[10] = {p->X[0][node],      p->X[1][node],      p->X[2][node], p->normal[0][node],
                        p->normal[1][node], p->normal[2][node], p->H[node],    p->K[node],
                        p->k1[node],        p->k2[node]};
        int got = sscanf(line, "\"ring, \"\"1\"\"\",%d,%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf",
                         &i, &j, &u, &v, f, f + 1, f + 2, f + 3, f + 4, f + 5, f + 6, f + 7, f + 8, f + 9);
        cr_assert(eq(int, got, 14), "%s", line);
        cr_assert(i == node / 6 && j == node % 6 && u == i / 11.0 && v == j * (2 * PI) / 6, "%s", line);
        for (int k = 0; k < 10; k++)
            cr_assert(f[k] == want[k], "%s: field %d got %g want %g", line, k, f[k], want[k]);
        node++;
    }
    cr_assert(eq(int, node, 12 * 6));
    free(data);
    shape_end(&figure);
    clean();
}

/* --- files that cannot be written --- */

/* The ball as a shell that nothing holds or loads, so that every format has something to write. */
static void shape_shell(ves_figure *figure)
{
    static double thickness[13 * 40], *plane[4] = {thickness, thickness, thickness, thickness};
    static const bool uniform[4] = {true, true, true, true};
    static ves_figure_shell shell;
    cr_assert(figure->patches <= 4);
    shell = (ves_figure_shell){.E = 1, .nu = .3, .density = NAN, .thickness = plane, .uniform = uniform};
    figure->shell = &shell;
}

Test(output, folders_that_are_not_there_are_told)
{
    ves_figure figure;
    shape_sphere(&figure, 1, 4, 8);
    shape_shell(&figure);
    for (const ves_format *const *f = ves_formats(); *f; f++) {
        char path[512];
        snprintf(path, sizeof path, "%s/nowhere/a.%s", path_of(""), (*f)->name);
        cr_assert(eq(int, export(&figure, (*f)->name, path), VES_IO), "%s", (*f)->name);
        cr_assert(strstr(first_message, path) && strstr(first_message, strerror(ENOENT)), "%s",
                  first_message);
        cr_assert(eq(int, export(&figure, (*f)->name, VESICA_BUILD), VES_IO), "a folder is no file");
        cr_assert(strstr(first_message, strerror(EISDIR)) != NULL, "%s", first_message);
    }
    check_nothing_left();
    shape_end(&figure);
}

Test(output, a_full_disk_leaves_the_old_file_alone)
{
    ves_figure figure;
    struct rlimit old, small = {64, 64};
    shape_sphere(&figure, 1, 12, 40);
    shape_shell(&figure);
    path_of("");
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old);
    small.rlim_max = old.rlim_max;
    for (const ves_format *const *f = ves_formats(); *f; f++) {
        char name[16];
        size_t size;
        snprintf(name, sizeof name, "a.%s", (*f)->name);
        const char *path = path_of(name);
        FILE *out = fopen(path, "wb");
        fputs("old", out);
        fclose(out);
        setrlimit(RLIMIT_FSIZE, &small);
        ves_status status = export(&figure, (*f)->name, path);
        setrlimit(RLIMIT_FSIZE, &old);
        cr_assert(eq(int, status, VES_IO), "%s", (*f)->name);
        cr_assert(strstr(first_message, strerror(EFBIG)) != NULL, "%s: %s", (*f)->name, first_message);
        char *data = slurp_bytes(path, &size);
        cr_assert(eq(str, data, "old"), "%s", (*f)->name);
        free(data);
        remove(path);
    }
    check_nothing_left();
    shape_end(&figure);
}
