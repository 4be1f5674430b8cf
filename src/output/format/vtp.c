/* VTK XML PolyData, appended raw. Patches keep their own points along shared curves (they coincide to the
 * bit; "Clean to Grid" or clean() joins them), since normals and curvatures may jump there. Caps are
 * patch -1, curvature 0. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "output/file.h"
#include "output/output.h"

enum { H, K, K1, K2, U, V, SCALARS };

static const char *const scalar_name[SCALARS] = {"H", "K", "k1", "k2", "u", "v"};

typedef struct sheet {
    int64_t points, triangles;
    double *x, *normal;      /* [points][3] */
    double *scalar[SCALARS]; /* [points] */
    int32_t *patch;          /* [points] */
    int64_t *corner, *end;   /* [triangles][3], [triangles]: where each polygon ends */
} sheet;

static bool sheet_take(sheet *s, ves_arena *arena, const ves_figure *figure)
{
    size_t points = 1, triangles = 1;
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        points += (size_t)p->rows * p->columns + 2 * (size_t)p->columns + 2;
        triangles += 2 * (size_t)p->nu * p->nv + 2 * (size_t)p->nv;
    }
    *s = (sheet){.x = ves_arena_doubles(arena, 3 * points), .normal = ves_arena_doubles(arena, 3 * points)};
    bool good = s->x && s->normal;
    for (int k = 0; k < SCALARS; k++)
        good = (s->scalar[k] = ves_arena_doubles(arena, points)) != NULL && good;
    s->patch = ves_arena_take(arena, points, sizeof *s->patch);
    s->corner = ves_arena_take(arena, triangles, 3 * sizeof *s->corner);
    s->end = ves_arena_take(arena, triangles, sizeof *s->end);
    return good && s->patch && s->corner && s->end;
}

/* label: the patch, or -1 on a cap. */
static int64_t point_add(sheet *s, const ves_figure *figure, int patch, int node, int label)
{
    int64_t k = s->points++;
    const ves_figure_patch *p = &figure->patch[patch];
    int owner, from = ves_figure_owner(figure, patch, node, &owner);
    for (int c = 0; c < 3; c++) {
        s->x[3 * k + c] = figure->patch[owner].X[c][from];
        s->normal[3 * k + c] = p->normal[c][node];
    }
    const double value[SCALARS] = {
        p->H[node], p->K[node], p->k1[node], p->k2[node], ves_figure_u(p, node), ves_figure_v(p, node)};
    for (int q = 0; q < SCALARS; q++) s->scalar[q][k] = value[q];
    s->patch[k] = (int32_t)label;
    return k;
}

static void triangle_add(sheet *s, int64_t a, int64_t b, int64_t c)
{
    int64_t *corner = s->corner + 3 * s->triangles;
    corner[0] = a, corner[1] = b, corner[2] = c;
    s->end[s->triangles] = 3 * (s->triangles + 1);
    s->triangles++;
}

/* Of a pole only the first node becomes a point. */
static bool hidden(const ves_figure_patch *p, int node)
{
    int row = node / p->columns;
    bool pole = (row == 0 && p->pole[0]) || (row == p->nu && p->pole[1]);
    return pole && node % p->columns != 0;
}

/* scratch: 6 nu nv corners, then a point number for each node. */
static void patch_add(sheet *s, const ves_figure *figure, int patch, int *scratch)
{
    const ves_figure_patch *p = &figure->patch[patch];
    int *corner = scratch, *point = scratch + 6 * (size_t)p->nu * p->nv;
    for (int node = 0; node < p->rows * p->columns; node++)
        if (!hidden(p, node)) point[node] = (int)point_add(s, figure, patch, node, patch);
    int count = ves_figure_triangles(p, corner);
    for (int t = 0; t < count; t++)
        triangle_add(s, point[corner[3 * t]], point[corner[3 * t + 1]], point[corner[3 * t + 2]]);
}

static void cross_add(double sum[3], const double *o, const double *a, const double *b)
{
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        sum[c] += (a[d] - o[d]) * (b[e] - o[e]) - (a[e] - o[e]) * (b[d] - o[d]);
    }
}

/* The end's nodes once more and, of a fan, their middle; normals are those of the triangles around each,
 * which on a flat cap are all the same. */
static void cap_add(sheet *s, const ves_figure *figure, int patch, int end, int *corner)
{
    const ves_figure_patch *p = &figure->patch[patch];
    int row = end ? p->nu * p->columns : 0, count = ves_figure_cap(p, end, corner);
    int64_t first = s->points, middle = -1, last = first + p->columns - 1;
    for (int j = 0; j < p->columns; j++) point_add(s, figure, patch, row + j, -1);
    if (!p->lid[end]) {
        middle = last = point_add(s, figure, patch, row, -1);
        ves_figure_middle(p, end, s->x + 3 * middle);
    }
    memset(s->normal + 3 * first, 0, 3 * sizeof *s->normal * (size_t)(last + 1 - first));
    for (int t = 0; t < count; t++) {
        int64_t at[3];
        for (int k = 0; k < 3; k++) {
            int node = corner[3 * t + k];
            at[k] = node < 0 ? middle : first + node - row;
        }
        triangle_add(s, at[0], at[1], at[2]);
        for (int k = 0; k < 3; k++)
            cross_add(s->normal + 3 * at[k], s->x + 3 * at[0], s->x + 3 * at[1], s->x + 3 * at[2]);
    }
    for (int64_t k = first; k <= last; k++) {
        double *n = s->normal + 3 * k, size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int c = 0; c < 3 && size > 0; c++) n[c] /= size;
        for (int q = H; q <= K2; q++) s->scalar[q][k] = 0;
    }
}

static ves_status sheet_fill(sheet *s, ves_arena *arena, const ves_figure *figure)
{
    size_t most = 1;
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        size_t need = 6 * (size_t)p->nu * p->nv + (size_t)p->rows * p->columns;
        if (need > most) most = need;
    }
    int *scratch = ves_arena_take(arena, most, sizeof *scratch);
    if (!scratch || !sheet_take(s, arena, figure)) return VES_MEMORY;
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        patch_add(s, figure, k, scratch);
        for (int end = 0; end < 2; end++)
            if (p->cap[end] && !p->pole[end]) cap_add(s, figure, k, end, scratch);
    }
    return VES_OK;
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

static void header_write(FILE *out, const ves_figure *figure, const sheet *s)
{
    const uint16_t one = 1;
    bool little = *(const unsigned char *)&one == 1;
    uint64_t at = 0, points = (uint64_t)s->points, triangles = (uint64_t)s->triangles;
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
    fputs("      </PointData>\n      <Points>\n", out);
    at = array_write(out, "Float64", "Points", 3, at) + 24 * points;
    fputs("      </Points>\n      <Polys>\n", out);
    at = array_write(out, "Int64", "connectivity", 1, at) + 24 * triangles;
    array_write(out, "Int64", "offsets", 1, at);
    fputs("      </Polys>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_", out);
}

static void block_write(FILE *out, const void *data, size_t size, int64_t count)
{
    uint64_t bytes = size * (uint64_t)count;
    fwrite(&bytes, sizeof bytes, 1, out);
    fwrite(data, size, (size_t)count, out);
}

static void sheet_write(FILE *out, const ves_figure *figure, const sheet *s)
{
    header_write(out, figure, s);
    block_write(out, s->normal, 24, s->points);
    for (int q = 0; q < SCALARS; q++) block_write(out, s->scalar[q], 8, s->points);
    block_write(out, s->patch, 4, s->points);
    block_write(out, s->x, 24, s->points);
    block_write(out, s->corner, 24, s->triangles);
    block_write(out, s->end, 8, s->triangles);
    fputs("\n  </AppendedData>\n</VTKFile>\n", out);
}

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    ves_file file;
    ves_arena arena = {0};
    sheet s;
    ves_status status = sheet_fill(&s, &arena, figure);
    if (status != VES_OK)
        ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "%s", ves_status_text(status));
    else
        status = ves_file_begin(&file, path, "vtp", diag);
    if (status == VES_OK) {
        sheet_write(file.out, figure, &s);
        status = ves_file_end(&file, VES_OK, diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

const ves_format ves_format_vtp = {.name = "vtp",
                                   .about = "triangles with normals and curvatures, for ParaView and PyVista",
                                   .write = write};
