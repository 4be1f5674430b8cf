#include "output/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "base/vector.h"

enum { REFINE = 12, AROUND = 24, CAP_MOST = 64, PIECES = 1000000 };

static double normalise(double a[3])
{
    double size = sqrt(ves_dot(a, a));
    for (int c = 0; c < 3 && size > 0; c++) a[c] /= size;
    return size;
}

static int nodes(const ves_figure_patch *p)
{
    return p->rows * p->columns;
}

/* The axis along which the ends of the patches are strung; z when they are not (size: of the shape), and for
 * open sheets, whose ends are but two of four sides. */
static int natural_up(const ves_figure *figure, double size)
{
    double span[3] = {0}, first[3], last[3];
    for (int k = 0; k < figure->patches; k++) {
        if (!figure->patch[k].periodic && !figure->patch[k].sides_meet) continue;
        ves_figure_middle(&figure->patch[k], 0, first);
        ves_figure_middle(&figure->patch[k], 1, last);
        for (int c = 0; c < 3; c++) span[c] += fabs(last[c] - first[c]);
    }
    int up = 2;
    for (int c = 1; c >= 0; c--)
        if (span[c] > span[up] * (1 + 1e-6) + 1e-3 * size) up = c;
    return up;
}

static void camera_aim(ves_camera *camera, const ves_view *view, int up)
{
    int e1 = (up + 1) % 3, e2 = (up + 2) % 3;
    double ca = cos(view->azimuth), sa = sin(view->azimuth), ch = cos(view->height_angle);
    camera->toward[e1] = ch * ca, camera->toward[e2] = ch * sa, camera->toward[up] = sin(view->height_angle);
    camera->right[e1] = -sa, camera->right[e2] = ca, camera->right[up] = 0;
    ves_cross(camera->toward, camera->right, camera->up);
}

/* Middle of the bounding box and half its diagonal. */
static double bounds(const ves_figure *figure, double middle[3])
{
    double lo[3], hi[3], half[3];
    ves_figure_box(figure, lo, hi);
    for (int c = 0; c < 3; c++) {
        bool any = lo[c] <= hi[c];
        middle[c] = any ? (lo[c] + hi[c]) / 2 : 0;
        half[c] = any ? (hi[c] - lo[c]) / 2 : 0;
    }
    double size = sqrt(ves_dot(half, half));
    return size > 0 ? size : 1;
}

/* Across the axis among those that are not up along which the viewer looks most: there grids have lines. */
static void camera_cut(ves_camera *camera, int up)
{
    int e1 = (up + 1) % 3, e2 = (up + 2) % 3;
    int along = fabs(camera->toward[e1]) > fabs(camera->toward[e2]) ? e1 : e2;
    camera->cut[along] = camera->toward[along] > 0 ? 1 : -1;
}

/* How far beyond the cut. */
static double beyond(const ves_camera *camera, const double x[3])
{
    return ves_dot(x, camera->cut) - ves_dot(camera->target, camera->cut);
}

/* Corners beyond the cut are moved onto it; false: all are. rim: the sides that then lie on it. */
static bool piece_cut(const ves_scene *scene, double x[4][3], unsigned char *rim)
{
    static const int side[4][2] = {{0, 3}, {1, 2}, {0, 1}, {3, 2}};
    const ves_camera *camera = &scene->camera;
    bool on[4] = {false};
    int count = 0;
    *rim = 0;
    if (!(ves_dot(camera->cut, camera->cut) > 0)) return true;
    for (int k = 0; k < 4; k++) {
        double by = beyond(camera, x[k]);
        if (!(by > -1e-9 * scene->size)) continue;
        for (int c = 0; c < 3; c++) x[k][c] -= by * camera->cut[c];
        on[k] = true, count++;
    }
    for (int k = 0; k < 4; k++) *rim |= (unsigned char)((on[side[k][0]] && on[side[k][1]]) << k);
    return count < 4;
}

/* Paper coordinates; returns how far the point is towards the viewer. */
static double project(const ves_camera *camera, const double x[3], double *px, double *py)
{
    double d[3] = {x[0] - camera->target[0], x[1] - camera->target[1], x[2] - camera->target[2]};
    double depth = ves_dot(d, camera->toward);
    double near = camera->distance > 0 ? camera->distance / (camera->distance - depth) : 1;
    *px = camera->x + camera->scale * near * ves_dot(d, camera->right);
    *py = camera->y - camera->scale * near * ves_dot(d, camera->up);
    return depth;
}

/* Scale and shift so that the shape just fills the frame. */
static void camera_fit(ves_camera *camera, const ves_figure *figure, const ves_frame *frame)
{
    double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
    camera->scale = 1, camera->x = camera->y = 0;
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        for (int s = 0; s < nodes(p); s++) {
            double x[3] = {p->X[0][s], p->X[1][s], p->X[2][s]}, at[2];
            project(camera, x, &at[0], &at[1]);
            for (int c = 0; c < 2 && isfinite(at[0] + at[1]); c++)
                lo[c] = fmin(lo[c], at[c]), hi[c] = fmax(hi[c], at[c]);
        }
    }
    if (!(lo[0] <= hi[0])) lo[0] = lo[1] = -1, hi[0] = hi[1] = 1;
    double wide = fmax(hi[0] - lo[0], 1e-9 * camera->distance + 1e-300);
    double high = fmax(hi[1] - lo[1], 1e-9 * camera->distance + 1e-300);
    camera->scale = fmin((frame->right - frame->left) / wide, (frame->bottom - frame->top) / high);
    camera->x = (frame->left + frame->right) / 2 - camera->scale * (lo[0] + hi[0]) / 2;
    camera->y = (frame->top + frame->bottom) / 2 - camera->scale * (lo[1] + hi[1]) / 2;
}

/* To a smaller scale, in the middle of the frame as before. */
static void camera_shrink(ves_camera *camera, const ves_frame *frame, double scale)
{
    double x = (frame->left + frame->right) / 2, y = (frame->top + frame->bottom) / 2;
    if (scale >= camera->scale) return;
    camera->x = x + (camera->x - x) * scale / camera->scale;
    camera->y = y + (camera->y - y) * scale / camera->scale;
    camera->scale = scale;
}

/* Lambert from two soft lamps that go with the viewer, a highlight, and a shade towards the outline. n,
 * to_eye: in the camera's axes, n on the viewer's side. depth: how far shading may darken; less where colours
 * are to be read as numbers. */
static ves_rgb lit(ves_rgb base, const double n[3], const double to_eye[3], double depth, double gloss)
{
    static const double key[3] = {-0.4205, 0.6207, 0.6619}, fill[3] = {0.8452, 0.1690, 0.5071};
    double half[3] = {key[0] + to_eye[0], key[1] + to_eye[1], key[2] + to_eye[2]};
    normalise(half);
    double facing = fmax(0, ves_dot(n, to_eye)), soft = pow(fmax(0, 0.5 + 0.5 * ves_dot(n, key)), 1.4);
    double shade = 0.92 * soft + 0.16 * fmax(0, ves_dot(n, fill)) - 0.30 * fmax(0, 1 - 2.6 * facing);
    double light = 1.06 - depth * (1 - shade), shine = gloss * pow(fmax(0, ves_dot(n, half)), 44);
    ves_rgb colour = {fmin(1, base.r * light), fmin(1, base.g * light), fmin(1, base.b * light)};
    return ves_colour_mix(colour, (ves_rgb){1, 1, 1}, shine);
}

typedef struct maker {
    ves_scene *scene;
    const ves_figure_patch *p;
    const double *plane;  /* of the coloured quantity */
    ves_rgb base;         /* else */
    int fine[2], step[2]; /* pieces along a quad; nodes between two drawn lines */
    double reach;         /* size of a quad, in lengths */
    bool closed;          /* nobody sees the inside */
} maker;

static const ves_rgb grey = {0.80, 0.81, 0.82}; /* what has no value to show */

/* Value of a plane at (i, j) + (fu, fv), bilinear. */
static double blend(const maker *m, const double *plane, int i, int j, double fu, double fv)
{
    int columns = m->p->columns, next = (j + 1) % columns;
    const double *a = plane + i * columns, *b = a + columns;
    return (1 - fu) * ((1 - fv) * a[j] + fv * a[next]) + fu * ((1 - fv) * b[j] + fv * b[next]);
}

static void blend3(const maker *m, double *const plane[3], int i, int j, double fu, double fv, double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = blend(m, plane[c], i, j, fu, fv);
}

static void toward_eye(const maker *m, const double x[3], double eye[3])
{
    const ves_camera *camera = &m->scene->camera;
    for (int c = 0; c < 3; c++)
        eye[c] = camera->distance > 0 ? camera->target[c] + camera->distance * camera->toward[c] - x[c]
                                      : camera->toward[c];
    normalise(eye);
}

static bool turned_away(const maker *m, const double x[3], const double normal[3])
{
    double eye[3];
    toward_eye(m, x, eye);
    return ves_dot(normal, eye) < 0;
}

/* What a surface of colour `base` looks like at x. */
static ves_rgb surface_colour(const maker *m, const double x[3], const double normal[3], ves_rgb base)
{
    const ves_camera *camera = &m->scene->camera;
    static const ves_rgb lining = {0.86, 0.84, 0.80};
    double eye[3], n[3], to_eye[3];
    toward_eye(m, x, eye);
    bool inside = ves_dot(normal, eye) < 0;
    const double *axis[3] = {camera->right, camera->up, camera->toward};
    for (int c = 0; c < 3; c++) {
        n[c] = ves_dot(normal, axis[c]) * (inside ? -1 : 1);
        to_eye[c] = ves_dot(eye, axis[c]);
    }
    if (inside && !m->p->one_sided) base = ves_colour_mix(base, lining, m->plane ? 0.30 : 0.78);
    return lit(base, n, to_eye, m->plane ? 0.42 : 0.60, inside ? 0.04 : 0.25);
}

static void piece_add(const maker *m, int i, int j, int a, int b)
{
    static const int du[4] = {0, 1, 1, 0}, dv[4] = {0, 0, 1, 1};
    const ves_figure_patch *p = m->p;
    ves_scene *scene = m->scene;
    ves_piece *piece = &scene->piece[scene->pieces];
    double x[4][3], middle[3], normal[3], one[3], two[3], px, py;
    for (int k = 0; k < 4; k++)
        blend3(m, p->X, i, j, (double)(a + du[k]) / m->fine[0], (double)(b + dv[k]) / m->fine[1], x[k]);
    if (!piece_cut(scene, x, &piece->rim)) return;
    for (int k = 0; k < 4; k++) {
        project(&scene->camera, x[k], &px, &py);
        if (!isfinite(px + py)) return;
        piece->x[k] = (float)px, piece->y[k] = (float)py;
    }
    double fu = (a + 0.5) / m->fine[0], fv = (b + 0.5) / m->fine[1];
    blend3(m, p->X, i, j, fu, fv, middle);
    blend3(m, p->normal, i, j, fu, fv, normal);
    if (!(normalise(normal) > 1e-3)) {
        for (int c = 0; c < 3; c++) one[c] = x[2][c] - x[0][c], two[c] = p->side * (x[3][c] - x[1][c]);
        ves_cross(one, two, normal);
        normalise(normal);
    }
    if (m->closed && turned_away(m, middle, normal)) return;
    ves_rgb base = m->plane ? ves_colour_value(&scene->colours, blend(m, m->plane, i, j, fu, fv)) : m->base;
    ves_rgb colour = surface_colour(m, middle, normal, base);
    piece->r = (float)colour.r, piece->g = (float)colour.g, piece->b = (float)colour.b;
    piece->depth = (float)project(&scene->camera, middle, &px, &py);
    piece->corners = 4;
    piece->order = scene->pieces;
    bool low_u = a == 0 && i % m->step[0] == 0, high_u = a == m->fine[0] - 1 && (i + 1) % m->step[0] == 0;
    bool low_v = b == 0 && j % m->step[1] == 0, high_v = b == m->fine[1] - 1 && (j + 1) % m->step[1] == 0;
    piece->lines =
        (unsigned char)(low_u * VES_LOW_U | high_u * VES_HIGH_U | low_v * VES_LOW_V | high_v * VES_HIGH_V);
    scene->pieces++;
}

/* --- caps --- */

/* A point of a triangle: s from its last corner to the opposite side, t along that side. The middle of a fan
 * is its last corner. */
static void triangle_at(double (*const x)[3], double s, double t, double out[3])
{
    for (int c = 0; c < 3; c++) out[c] = x[2][c] + s * ((1 - t) * x[0][c] + t * x[1][c] - x[2][c]);
}

/* Flat pieces of one triangle of a cap, rows from its last corner outward. */
static void triangle_add(const maker *m, double (*const x)[3], ves_rgb base, const int fine[2])
{
    static const int ds[4] = {0, 1, 1, 0}, dt[4] = {0, 0, 1, 1};
    ves_scene *scene = m->scene;
    double one[3], two[3], normal[3], px, py;
    for (int c = 0; c < 3; c++) one[c] = x[0][c] - x[2][c], two[c] = x[1][c] - x[2][c];
    ves_cross(one, two, normal);
    normalise(normal);
    for (int a = 0; a < fine[0]; a++)
        for (int b = 0; b < fine[1]; b++) {
            ves_piece *piece = &scene->piece[scene->pieces];
            double edge[4][3], at[3];
            for (int k = 0; k < 4; k++)
                triangle_at(x, (double)(a + ds[k]) / fine[0], (double)(b + dt[k]) / fine[1], edge[k]);
            bool good = piece_cut(scene, edge, &piece->rim);
            for (int k = 0; k < 4; k++) {
                project(&scene->camera, edge[k], &px, &py);
                good = good && isfinite(px + py);
                piece->x[k] = (float)px, piece->y[k] = (float)py;
            }
            triangle_at(x, (a + 0.5) / fine[0], (b + 0.5) / fine[1], at);
            if (!good || (m->closed && turned_away(m, at, normal))) continue;
            ves_rgb colour = surface_colour(m, at, normal, base);
            piece->r = (float)colour.r, piece->g = (float)colour.g, piece->b = (float)colour.b;
            piece->depth = (float)project(&scene->camera, at, &px, &py);
            piece->corners = 4, piece->lines = 0;
            piece->order = scene->pieces++;
        }
}

/* As fine as the surface beside it, so that what is nearer covers what is behind. */
static void cap_fineness(const maker *m, double (*const x)[3], int fine[2])
{
    double across = 0, along = 0;
    for (int c = 0; c < 3; c++) {
        double middle = (x[0][c] + x[1][c]) / 2;
        across += (middle - x[2][c]) * (middle - x[2][c]), along += (x[1][c] - x[0][c]) * (x[1][c] - x[0][c]);
    }
    double size = m->reach > 0 ? m->reach : 1;
    fine[0] = (int)fmin(ceil(sqrt(across) / size), CAP_MOST);
    fine[1] = (int)fmin(ceil(sqrt(along) / size), CAP_MOST);
    for (int k = 0; k < 2; k++)
        if (fine[k] < 1) fine[k] = 1;
}

/* A cap has no curvature to show: then it is grey. Nobody sees a closed shape's caps from inside. */
static long cap_add(const maker *m, int end, int *corner, bool draw)
{
    const ves_figure_patch *p = m->p;
    double x[3][3], middle[3];
    long pieces = 0;
    int count = ves_figure_cap(p, end, corner), fine[2];
    ves_figure_middle(p, end, middle);
    for (int t = 0; t < count; t++) {
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++) {
                int node = corner[3 * t + k];
                x[k][c] = node < 0 ? middle[c] : p->X[c][node];
            }
        cap_fineness(m, x, fine);
        pieces += fine[0] * fine[1];
        if (draw) triangle_add(m, x, m->plane ? grey : ves_colour_mix(m->base, grey, 0.35), fine);
    }
    return pieces;
}

/* How many pieces the caps of a patch have; draws them too. */
static long caps_add(const maker *m, int *corner, bool draw)
{
    long pieces = 0;
    for (int end = 0; end < 2; end++)
        if (m->p->cap[end] && !m->p->pole[end]) pieces += cap_add(m, end, corner, draw);
    return pieces;
}

/* A straight line between two places of a row of points, brought forward. */
static void line_add(const maker *m, double *const point[3], const int end[2], double forward, bool spine)
{
    ves_scene *scene = m->scene;
    ves_piece *piece = &scene->piece[scene->pieces];
    double depth = 0, px, py;
    for (int k = 0; k < 2; k++) {
        double x[3] = {point[0][end[k]], point[1][end[k]], point[2][end[k]]};
        depth += project(&scene->camera, x, &px, &py) / 2;
        if (!isfinite(px + py) || (!spine && beyond(&scene->camera, x) > 1e-9 * scene->size)) return;
        piece->x[k] = (float)px, piece->y[k] = (float)py;
    }
    piece->corners = 2, piece->lines = 0, piece->spine = spine;
    piece->order = scene->pieces;
    piece->depth = (float)(depth + forward);
    scene->pieces++;
}

/* A segment of an end curve: the surface it bounds does not hide it. */
static void segment_add(const maker *m, int from, int to)
{
    line_add(m, m->p->X, (int[]){from, to}, 0.75 * m->reach, false);
}

/* A spine lies inside its surface: it comes before everything. */
static void spine_add(const maker *m)
{
    for (int i = 0; i < m->p->nu && m->p->spine[0]; i++)
        line_add(m, m->p->spine, (int[]){i, i + 1}, 4 * m->scene->size, true);
}

/* Mean length of the lines along u (0) and around v (1). */
static double line_length(const ves_figure_patch *p, int along)
{
    int di = along == 0, dj = along == 1, count = 0;
    double sum = 0;
    for (int i = 0; i < p->rows - di; i++) {
        for (int j = 0; j < (dj ? p->nv : p->columns); j++) {
            int a = i * p->columns + j, b = (i + di) * p->columns + (j + dj) % p->columns;
            double d[3] = {p->X[0][a] - p->X[0][b], p->X[1][a] - p->X[1][b], p->X[2][a] - p->X[2][b]};
            double length = sqrt(ves_dot(d, d));
            if (isfinite(length)) sum += length, count++;
        }
    }
    return count ? sum / count * (along ? p->nv : p->nu) : 0;
}

/* The least step that divides n and leaves at most `most` parts. */
static int divide(int n, int most)
{
    int step = 1;
    while (step < n && (n % step || n / step > most)) step++;
    return step;
}

static int refinement(double pixels, double cell)
{
    if (cell <= 0) return 1;
    int fine = (int)ceil(pixels / cell);
    return fine < 1 ? 1 : fine > REFINE ? REFINE : fine;
}

static void maker_init(maker *m, ves_scene *scene, const ves_figure *figure, int patch, double cell)
{
    const ves_figure_patch *p = &figure->patch[patch];
    double u = line_length(p, 0), v = line_length(p, 1);
    *m = (maker){.scene = scene,
                 .p = p,
                 .base = ves_colour_patch(patch),
                 .closed = figure->closed && !(ves_dot(scene->camera.cut, scene->camera.cut) > 0)};
    m->plane = scene->plane ? scene->plane[patch] : NULL;
    if (scene->plane && !m->plane) m->base = grey; /* it is no part of the shell */
    m->fine[0] = refinement(u / p->nu * scene->camera.scale, cell);
    m->fine[1] = refinement(v / p->nv * scene->camera.scale, cell);
    /* As many lines along u as make the drawn meshes square, within reason. */
    double wanted = v > 0 ? fmin(fmax(AROUND * u / v, 4), AROUND) : AROUND;
    m->step[0] = divide(p->nu, (int)wanted);
    m->step[1] = divide(p->nv, AROUND);
    m->reach = fmax(u / p->nu, v / p->nv);
}

static void surface_add(const maker *m)
{
    for (int i = 0; i < m->p->nu; i++)
        for (int j = 0; j < m->p->nv; j++)
            for (int a = 0; a < m->fine[0]; a++)
                for (int b = 0; b < m->fine[1]; b++) piece_add(m, i, j, a, b);
}

static void curves_add(const maker *m)
{
    const ves_figure_patch *p = m->p;
    for (int end = 0; end < 2; end++) {
        int row = end ? p->nu * p->columns : 0;
        for (int j = 0; j < p->nv && !p->pole[end] && !p->ends_meet; j++)
            segment_add(m, row + j, row + (j + 1) % p->columns);
    }
    for (int i = 0; i < p->nu && !p->periodic && !p->sides_meet; i++) {
        segment_add(m, i * p->columns, (i + 1) * p->columns);
        segment_add(m, i * p->columns + p->nv, (i + 1) * p->columns + p->nv);
    }
}

/* The planes of one scene; their values go behind the `count` that are there. */
static ves_status planes_find(ves_scene *scene, const ves_figure *figure, const ves_quantity *quantity,
                              ves_arena *arena, double *values, int *count)
{
    const double **plane = ves_arena_take(arena, (size_t)figure->patches, sizeof *plane);
    if (!plane) return VES_MEMORY;
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *p = &figure->patch[k];
        const double *const choice[] = {p->H, p->K, p->k1, p->k2};
        plane[k] = quantity->field ? quantity->field->value[k] : choice[quantity->plane];
        if (!plane[k]) continue;
        memcpy(values + *count, plane[k], (size_t)nodes(p) * sizeof *values);
        *count += nodes(p);
    }
    scene->plane = plane;
    return VES_OK;
}

/* One scale for all: of curvatures without their few largest, of a shell from the least to the largest. */
static ves_status colours_find(ves_scene *scene, const ves_figure *const *figure, int scenes,
                               const char *word, ves_arena *arena)
{
    int all = 0, count = 0;
    double size = 0;
    ves_quantity quantity;
    if (!ves_quantity_find(figure[0], word, &quantity)) return VES_OK;
    for (int s = 0; s < scenes; s++) {
        size = fmax(size, scene[s].size);
        for (int k = 0; k < figure[s]->patches; k++) all += nodes(&figure[s]->patch[k]);
    }
    double *values = ves_arena_doubles(arena, (size_t)all),
           unit = quantity.curvature == 2 ? 1 / (size * size) : 1 / size;
    if (!values) return VES_MEMORY;
    for (int s = 0; s < scenes; s++) {
        if (s > 0 && !ves_quantity_find(figure[s], word, &quantity)) return VES_FAULT;
        VES_TRY(planes_find(&scene[s], figure[s], &quantity, arena, values, &count));
    }
    scene[0].colours = quantity.curvature ? ves_colour_scale_of(values, count, 1e-6 * unit, unit)
                                          : ves_colour_scale_whole(values, count);
    for (int s = 1; s < scenes; s++) scene[s].colours = scene[0].colours;
    return VES_OK;
}

/* Farthest first; where depths agree, in the order of making, so that pictures repeat. */
static int compare(const void *a, const void *b)
{
    const ves_piece *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return (p->order > q->order) - (p->order < q->order);
}

static long pieces_needed(ves_scene *scene, const ves_figure *figure, double cell, int *corner)
{
    long need = 1;
    for (int k = 0; k < figure->patches; k++) {
        maker m;
        maker_init(&m, scene, figure, k, cell);
        need += (long)m.p->nu * m.p->nv * m.fine[0] * m.fine[1] + 2L * (m.p->nu + m.p->nv) + m.p->nu +
                caps_add(&m, corner, false);
    }
    return need;
}

static ves_status pieces_make(ves_scene *scene, const ves_figure *figure, const ves_view *view, double cell,
                              ves_arena *arena)
{
    int most = 1;
    for (int k = 0; k < figure->patches; k++)
        if (figure->patch[k].nv > most) most = figure->patch[k].nv;
    int *corner = ves_arena_take(arena, 3 * (size_t)most, sizeof *corner);
    if (!corner) return VES_MEMORY;
    long need = pieces_needed(scene, figure, cell, corner);
    for (; need > PIECES && cell > 0 && cell < 100; need = pieces_needed(scene, figure, cell, corner))
        cell *= 1.5;
    scene->piece = ves_arena_take(arena, (size_t)need, sizeof *scene->piece);
    if (!scene->piece) return VES_MEMORY;
    for (int k = 0; k < figure->patches; k++) {
        maker m;
        maker_init(&m, scene, figure, k, cell);
        surface_add(&m);
        caps_add(&m, corner, true);
        curves_add(&m);
        if (view->spines) spine_add(&m);
    }
    qsort(scene->piece, (size_t)scene->pieces, sizeof *scene->piece, compare);
    return VES_OK;
}

/* The side that is up is that of the first figure; the scale that which all have room for. */
static void cameras_set(ves_scene *scene, const ves_figure *const *figure, int scenes, const ves_view *view,
                        const ves_frame *frame)
{
    double scale = HUGE_VAL;
    int up = view->up;
    for (int s = 0; s < scenes; s++) {
        ves_camera *camera = &scene[s].camera;
        scene[s] = (ves_scene){0};
        scene[s].size = bounds(figure[s], camera->target);
        if (up < 0 || up > 2) up = natural_up(figure[s], scene[s].size);
        camera->distance = view->orthographic ? 0 : 4.6 * scene[s].size;
        camera_aim(camera, view, up);
        if (view->cut && figure[s]->closed) camera_cut(camera, up);
        camera_fit(camera, figure[s], &frame[s]);
        scale = fmin(scale, camera->scale);
    }
    for (int s = 0; s < scenes; s++) camera_shrink(&scene[s].camera, &frame[s], scale);
}

ves_status ves_scenes_build(ves_scene *scene, const ves_figure *const *figure, int scenes,
                            const ves_view *view, const ves_frame *frame, ves_arena *arena)
{
    cameras_set(scene, figure, scenes, view, frame);
    VES_TRY(colours_find(scene, figure, scenes, view->colour, arena));
    for (int s = 0; s < scenes; s++) VES_TRY(pieces_make(&scene[s], figure[s], view, frame[s].cell, arena));
    return VES_OK;
}

ves_status ves_scene_build(ves_scene *scene, const ves_figure *figure, const ves_view *view,
                           const ves_frame *frame, ves_arena *arena)
{
    return ves_scenes_build(scene, &figure, 1, view, frame, arena);
}
