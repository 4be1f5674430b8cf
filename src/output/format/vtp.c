/* VTK XML PolyData, appended raw. Patches keep their own points along shared curves (they coincide to the
 * bit; "Clean to Grid" or clean() joins them), since normals and curvatures may jump there. Caps are
 * patch -1, curvature 0. Of a shell its thickness, stresses and displacements; NaN off its parts. */
#include <math.h>
#include <stdint.h>

#include "base/diag.h"
#include "base/text.h"
#include "output/file.h"
#include "output/output.h"

/* The scalars of a point, in the order of the file. */
enum { SCALARS = 6, FIELD_NAME = 100 };

static const char *const scalar_name[SCALARS] = {"H", "K", "k1", "k2", "u", "v"};

/* --- fields of a shell --- */

static bool is_hidden(const ves_figure_patch *p, int node)
{
    int row = node / p->columns;
    return ((row == 0 && p->pole[0]) || (row == p->nu && p->pole[1])) && node % p->columns;
}

/* Which node of its patch a vertex is: patches come one after the other, of a pole the first node alone; -1: of a cap. */
static ves_status nodes_find(const ves_figure *figure, const ves_mesh *mesh, ves_arena *arena, int **node)
{
    *node = ves_arena_take(arena, (size_t)mesh->vertices, sizeof **node);
    if (!*node) return VES_MEMORY;
    for (int k = 0, patch = -1, next = 0; k < mesh->vertices; k++) {
        (*node)[k] = -1;
        if (mesh->patch[k] < 0) continue;
        if (mesh->patch[k] != patch) patch = mesh->patch[k], next = 0;
        while (is_hidden(&figure->patch[patch], next)) next++;
        (*node)[k] = next++;
    }
    return VES_OK;
}

static int fields_of(const ves_figure *figure)
{
    return figure->shell ? figure->shell->fields : 0;
}

static void field_name(const ves_figure_field *f, char name[FIELD_NAME])
{
    snprintf(name, FIELD_NAME, "%s%s%s", f->name, f->of ? "_" : "", f->of ? f->of : "");
}

static double field_at(const ves_figure_field *f, int patch, int node, int c)
{
    if (node < 0 || !f->value[patch]) return NAN; /* no part of the shell */
    return f->vector ? f->vector[patch][c][node] : f->value[patch][node];
}

/* A String array is written as the codes of its bytes, each text ended by 0. */
static void text_write(FILE *out, const char *text)
{
    for (; text && *text; text++) fprintf(out, "%d ", (unsigned char)*text);
    fputs("0\n", out);
}

static void names_write(FILE *out, const ves_figure *figure)
{
    fputs("    <FieldData>\n"
          "      <Array type=\"String\" Name=\"title\" NumberOfTuples=\"1\" format=\"ascii\">\n",
          out);
    text_write(out, figure->title);
    fprintf(out,
            "      </Array>\n"
            "      <Array type=\"String\" Name=\"patches\" NumberOfTuples=\"%d\" format=\"ascii\">\n",
            figure->patches);
    for (int k = 0; k < figure->patches; k++) text_write(out, figure->patch[k].name);
    fputs("      </Array>\n    </FieldData>\n", out);
}

static uint64_t array_write(FILE *out, const char *type, const char *name, int components, uint64_t offset)
{
    fprintf(out, "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" ", type, name,
            components);
    fprintf(out, "format=\"appended\" offset=\"%llu\"/>\n", (unsigned long long)offset);
    return offset + sizeof(uint64_t);
}

static void header_write(FILE *out, const ves_figure *figure, const ves_mesh *mesh)
{
    const uint16_t one = 1;
    bool little = *(const unsigned char *)&one == 1;
    uint64_t at = 0, points = (uint64_t)mesh->vertices, triangles = (uint64_t)mesh->triangles;
    fprintf(out,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"%s\" header_type=\"UInt64\">\n  "
            "<PolyData>\n",
            little ? "LittleEndian" : "BigEndian");
    names_write(out, figure);
    fprintf(out,
            "    <Piece NumberOfPoints=\"%llu\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"%llu\">\n      <PointData Scalars=\"H\" Normals=\"normals\">\n",
            (unsigned long long)points, (unsigned long long)triangles);
    at = array_write(out, "Float64", "normals", 3, at) + 24 * points;
    for (int q = 0; q < SCALARS; q++) at = array_write(out, "Float64", scalar_name[q], 1, at) + 8 * points;
    at = array_write(out, "Int32", "patch", 1, at) + 4 * points;
    for (int q = 0; q < fields_of(figure); q++) {
        const ves_figure_field *f = &figure->shell->field[q];
        char name[FIELD_NAME];
        int components = f->vector ? 3 : 1;
        field_name(f, name);
        at = array_write(out, "Float64", name, components, at) + 8 * (uint64_t)components * points;
    }
    fputs("      </PointData>\n      <Points>\n", out);
    at = array_write(out, "Float64", "Points", 3, at) + 24 * points;
    fputs("      </Points>\n      <Polys>\n", out);
    at = array_write(out, "Int64", "connectivity", 1, at) + 24 * triangles;
    array_write(out, "Int64", "offsets", 1, at);
    fputs("      </Polys>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_", out);
}

static void block_begin(FILE *out, size_t size, int count)
{
    uint64_t bytes = size * (uint64_t)count;
    fwrite(&bytes, sizeof bytes, 1, out);
}

static void block_write(FILE *out, const void *data, size_t size, int count)
{
    block_begin(out, size, count);
    fwrite(data, size, (size_t)count, out);
}

static void field_write(FILE *out, const ves_figure_field *f, const ves_mesh *m, const int *node)
{
    int components = f->vector ? 3 : 1;
    block_begin(out, 8 * (size_t)components, m->vertices);
    for (int k = 0; k < m->vertices; k++)
        for (int c = 0; c < components; c++)
            fwrite(&(double){field_at(f, m->patch[k], node[k], c)}, 8, 1, out);
}

static void mesh_write(FILE *out, const ves_figure *figure, const ves_mesh *m, const int *node)
{
    const double *const scalar[SCALARS] = {m->H, m->K, m->k1, m->k2, m->u, m->v};
    header_write(out, figure, m);
    block_write(out, m->normal, 24, m->vertices);
    for (int q = 0; q < SCALARS; q++) block_write(out, scalar[q], 8, m->vertices);
    block_begin(out, 4, m->vertices);
    for (int k = 0; k < m->vertices; k++) fwrite(&(int32_t){m->patch[k]}, 4, 1, out);
    for (int q = 0; q < fields_of(figure); q++) field_write(out, &figure->shell->field[q], m, node);
    block_write(out, m->point, 24, m->vertices);
    block_begin(out, 24, m->triangles);
    for (int k = 0; k < 3 * m->triangles; k++) fwrite(&(int64_t){m->corner[k]}, 8, 1, out);
    block_begin(out, 8, m->triangles); /* where each polygon ends */
    for (int k = 1; k <= m->triangles; k++) fwrite(&(int64_t){3 * k}, 8, 1, out);
    fputs("\n  </AppendedData>\n</VTKFile>\n", out);
}

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    ves_file file;
    ves_mesh mesh;
    ves_arena arena = {0};
    int *node;
    ves_status status = ves_figure_mesh(figure, false, &mesh);
    if (status == VES_OK) status = nodes_find(figure, &mesh, &arena, &node);
    if (status != VES_OK) {
        ves_arena_destroy(&arena);
        return ves_diag_fail(diag, status);
    }
    status = ves_file_begin(&file, path, "vtp", diag);
    if (status == VES_OK) {
        mesh_write(file.out, figure, &mesh, node);
        status = ves_file_end(&file, VES_OK, diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

/* --- spines: one polyline a patch --- */

/* One number for each place of each spine. */
typedef double at_place(const ves_figure_patch *p, int patch, int i, int component);

static double place_x(const ves_figure_patch *p, int patch, int i, int component)
{
    (void)patch;
    return p->spine[component][i];
}

static double place_u(const ves_figure_patch *p, int patch, int i, int component)
{
    (void)patch, (void)component;
    return (double)i / p->nu;
}

static double place_patch(const ves_figure_patch *p, int patch, int i, int component)
{
    (void)p, (void)i, (void)component;
    return patch;
}

static void places_write(FILE *out, const ves_figure *figure, const char *kind, int components, at_place *at)
{
    char number[32];
    fprintf(out, "        <DataArray %s NumberOfComponents=\"%d\" format=\"ascii\">\n", kind, components);
    for (int k = 0; k < figure->patches; k++)
        for (int i = 0; i < figure->patch[k].rows && figure->patch[k].spine[0]; i++)
            for (int c = 0; c < components; c++) {
                ves_text_shortest(at(&figure->patch[k], k, i, c), number);
                fprintf(out, "%s%c", number, c + 1 < components ? ' ' : '\n');
            }
    fputs("        </DataArray>\n", out);
}

static void lines_write(FILE *out, const ves_figure *figure, int points)
{
    int end = 0;
    fputs("        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n", out);
    for (int k = 0; k < points; k++) fprintf(out, "%d\n", k);
    fputs("        </DataArray>\n        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n",
          out);
    for (int k = 0; k < figure->patches; k++)
        if (figure->patch[k].spine[0]) fprintf(out, "%d\n", end += figure->patch[k].rows);
    fputs("        </DataArray>\n", out);
}

static ves_status spines(ves_figure *figure, const char *path, ves_diag *diag)
{
    ves_file file;
    int points = 0, lines = 0;
    VES_TRY(ves_file_begin(&file, path, "vtp", diag));
    for (int k = 0; k < figure->patches; k++)
        if (figure->patch[k].spine[0]) points += figure->patch[k].rows, lines++;
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">\n  <PolyData>\n", file.out);
    names_write(file.out, figure);
    fprintf(file.out,
            "    <Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" NumberOfLines=\"%d\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n      <PointData Scalars=\"u\">\n",
            points, lines);
    places_write(file.out, figure, "type=\"Float64\" Name=\"u\"", 1, place_u);
    places_write(file.out, figure, "type=\"Int32\" Name=\"patch\"", 1, place_patch);
    fputs("      </PointData>\n      <Points>\n", file.out);
    places_write(file.out, figure, "type=\"Float64\" Name=\"Points\"", 3, place_x);
    fputs("      </Points>\n      <Lines>\n", file.out);
    lines_write(file.out, figure, points);
    fputs("      </Lines>\n    </Piece>\n  </PolyData>\n</VTKFile>\n", file.out);
    return ves_file_end(&file, VES_OK, diag);
}

const ves_format ves_format_vtp = {.name = "vtp",
                                   .about = "triangles with normals and curvatures, for ParaView and PyVista",
                                   .write = write,
                                   .spines = spines};
