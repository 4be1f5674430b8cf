/* A deck for CalculiX: the shell of a shape as elements S8R (beside poles S6), with its supports and load
 * cases.
 *
 * What CalculiX 2.20 does to shells, and a deck must know: it reads 20 characters of a number and drops the
 * rest, exponent and all. It makes bricks of shells; where one or two of the three rotations of a node are
 * held it is far too stiff (a quarter of the Scordelis-Lo roof: 0.04 instead of 0.302). S8 locks, S3 and
 * S4R are unusable. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "output/file.h"
#include "output/output.h"
#include "surface/elements.h"

enum { DIGITS = 20, NAME = 64, AXES = 3 };

typedef struct deck {
    FILE *out;
    const ves_figure *figure;
    const ves_figure_shell *shell;
    ves_arena arena;
    ves_elements all;
    unsigned *fix; /* [nodes] degrees of freedom that supports hold; ROTATIONS of them all or some */
    bool partial;  /* some, somewhere */
    int *by;       /* [nodes] the oblique diaphragm that it lies on, from 1; or SEVERAL; 0: none */
    int *node;     /* [nodes] scratch, as the next two */
    char *met;
    double (*force)[AXES];
} deck;

enum { DISPLACEMENTS = 7, ROTATIONS = 7 << AXES, SEVERAL = -1 };

/* As exactly as 20 characters allow. */
static void number(FILE *out, double value)
{
    char text[32];
    ves_text_shortest(value, text);
    if (strlen(text) > DIGITS) {
        snprintf(text, sizeof text, "%.13g", value);
        for (char *c = text; *c; c++)
            if (*c == ',') *c = '.';
    }
    fputs(text, out);
}

/* One line of a comment, whatever is in the text. */
static void remark(FILE *out, const char *before, const char *text)
{
    fprintf(out, "** %s", before);
    for (int k = 0; text[k] && k < 200; k++) putc((unsigned char)text[k] < ' ' ? ' ' : text[k], out);
    putc('\n', out);
}

/* The set of a part: its name, and where sets cannot be told apart by that (case does not count) its
 * number. */
static void part_name(const deck *d, int patch, char name[NAME])
{
    const char *from = d->figure->patch[patch].name ? d->figure->patch[patch].name : "";
    int length = 0, same = 0;
    for (; from[length] && length < NAME - 16; length++)
        name[length] =
            isalnum((unsigned char)from[length]) ? (char)toupper((unsigned char)from[length]) : '_';
    name[length] = 0;
    for (int k = 0; k < patch; k++) {
        char other[NAME];
        if (!d->shell->thickness[k]) continue;
        part_name(d, k, other);
        same += !strncmp(other, name, strlen(name));
    }
    if (same || !length || !strcmp(name, "EALL"))
        snprintf(name + length, NAME - (size_t)length, "_PART_%d", patch + 1);
}

static int node_of(const deck *d, int image, int patch, int node)
{
    return d->all.number[image * d->all.grid + d->all.first[patch] + node];
}

/* --- mesh --- */

static void head_write(const deck *d)
{
    const char *unit = d->figure->unit;
    remark(d->out, "", d->figure->title ? d->figure->title : "");
    fprintf(d->out, "** A deck for CalculiX (ccx), made by vesica %s.\n", VESICA_VERSION);
    if (unit)
        fprintf(d->out, "** Lengths in %s, forces in N, E and stresses in N/%s^2.\n", unit, unit);
    else
        fputs("** The problem file has no units; nor have the numbers here.\n", d->out);
    if (d->all.images > 1)
        fprintf(d->out,
                "** Planes of symmetry: %d images make the whole, and nothing is held there. CalculiX is far "
                "too\n"
                "** stiff where one or two of the three rotations of a node of a shell are held.\n",
                d->all.images);
    fputs("*NODE, NSET=NALL\n", d->out);
    for (int k = 0; k < d->all.nodes; k++) {
        fprintf(d->out, "%d", k + 1);
        for (int c = 0; c < AXES; c++) putc(',', d->out), number(d->out, d->all.point[k][c]);
        putc('\n', d->out);
    }
}

/* The elements of a part that have so many nodes. */
static void kind_write(const deck *d, int patch, int nodes, int *element)
{
    const ves_figure_patch *p = &d->figure->patch[patch];
    char name[NAME];
    bool begun = false;
    part_name(d, patch, name);
    for (int image = 0; image < d->all.images; image++)
        for (int i = 0; i < p->nu; i += 2)
            for (int j = 0; j < p->nv; j += 2) {
                const int at[4] = {image, patch, i, j};
                int node[VES_ELEMENT_NODES];
                if (ves_elements_nodes(&d->all, d->figure, at, node) != nodes) continue;
                if (!begun)
                    fprintf(d->out, "*ELEMENT, TYPE=%s, ELSET=%s\n",
                            nodes == VES_ELEMENT_NODES ? "S8R" : "S6", name);
                begun = true;
                fprintf(d->out, "%d", ++*element);
                for (int k = 0; k < nodes; k++) fprintf(d->out, ",%d", node[k] + 1);
                putc('\n', d->out);
            }
}

/* Thickness at the nodes of the parts where it is not the same everywhere; where such parts meet, that of the
 * first. */
static void thickness_write(deck *d)
{
    bool begun = false;
    memset(d->met, 0, (size_t)d->all.nodes);
    for (int patch = 0; patch < d->figure->patches; patch++) {
        const double *t = d->shell->thickness[patch];
        const ves_figure_patch *p = &d->figure->patch[patch];
        for (int s = 0; t && !d->shell->uniform[patch] && s < p->rows * p->columns * d->all.images; s++) {
            int node = node_of(d, s % d->all.images, patch, s / d->all.images);
            if (node < 0 || d->met[node]) continue;
            if (!begun) fputs("*NODAL THICKNESS\n", d->out);
            begun = true, d->met[node] = 1;
            fprintf(d->out, "%d,", node + 1);
            number(d->out, t[s / d->all.images]);
            putc('\n', d->out);
        }
    }
}

static void sections_write(deck *d)
{
    fputs("*MATERIAL, NAME=MATERIAL\n*ELASTIC\n", d->out);
    number(d->out, d->shell->E), putc(',', d->out), number(d->out, d->shell->nu), putc('\n', d->out);
    if (isfinite(d->shell->density))
        fputs("*DENSITY\n", d->out), number(d->out, d->shell->density), putc('\n', d->out);
    for (int patch = 0; patch < d->figure->patches; patch++) {
        char name[NAME];
        if (!d->shell->thickness[patch]) continue;
        part_name(d, patch, name);
        fprintf(d->out, "*SHELL SECTION, ELSET=%s, MATERIAL=MATERIAL%s\n", name,
                d->shell->uniform[patch] ? "" : ", NODAL THICKNESS");
        number(d->out, d->shell->thickness[patch][0]); /* read, but not used, where nodes have their own */
        putc('\n', d->out);
    }
    thickness_write(d);
}

/* --- supports --- */

/* The axis of x, y, z along which a unit vector points; -1: none. */
static int along(const double axis[AXES])
{
    for (int c = 0; c < AXES; c++)
        if (fabs(axis[c]) > 1 - 1e-12) return c;
    return -1;
}

/* A diaphragm across an axis of coordinates holds two displacements. */
static unsigned fix_of(const ves_figure_support *s)
{
    int axis = s->across ? along(s->axis) : -1;
    return axis < 0 ? s->fix : DISPLACEMENTS & ~(1u << axis);
}

static bool oblique(const ves_figure_support *s)
{
    return s->across && along(s->axis) < 0;
}

/* The nodes of a support in all images, each once; returns how many. */
static int nodes_of(deck *d, int index, int *node)
{
    const ves_figure_support *s = &d->shell->support[index];
    int count = 0;
    memset(d->met, 0, (size_t)d->all.nodes);
    for (int k = 0; k < s->nodes * d->all.images; k++) {
        int at = node_of(d, k % d->all.images, s->node[k / d->all.images][0], s->node[k / d->all.images][1]);
        if (at >= 0 && !d->met[at]) d->met[at] = 1, node[count++] = at;
    }
    return count;
}

static void set_write(deck *d, int index)
{
    const ves_figure_support *s = &d->shell->support[index];
    int count = nodes_of(d, index, d->node);
    remark(d->out, s->mirror ? "in a plane of symmetry: " : "held: ", s->text);
    fprintf(d->out, "*NSET, NSET=SUPPORT_%d\n", index + 1);
    for (int k = 0; k < count; k++) {
        fprintf(d->out, "%d,\n", d->node[k] + 1);
        d->fix[d->node[k]] |= fix_of(s);
        if (!oblique(s)) continue;
        int *by = &d->by[d->node[k]];
        *by = *by && *by != index + 1 ? SEVERAL : index + 1;
    }
}

static void fix_write(deck *d, int index)
{
    unsigned fix = fix_of(&d->shell->support[index]), turns = fix & ROTATIONS;
    if (!fix) return;
    if (turns && turns != ROTATIONS) {
        d->partial = true;
        fputs("** Some, not all, rotations of a node are held: CalculiX is then far too stiff.\n", d->out);
    }
    fputs("*BOUNDARY\n", d->out);
    for (int k = 0; k < 2 * AXES; k++) {
        int last = k;
        if (!(fix & (1u << k))) continue;
        while (fix & (2u << last)) last++;
        fprintf(d->out, "SUPPORT_%d,%d,%d\n", index + 1, k + 1, last + 1);
        k = last;
    }
}

/* Only displacements u = s a along the axis a of a diaphragm are free: with p where |a| is largest, u_c =
 * (a_c / a_p) u_p. Where something else holds the node too, a displacement that has a part in that is 0,
 * and all are. */
static void oblique_write(deck *d)
{
    for (int node = 0; node < d->all.nodes; node++) {
        if (!d->by[node]) continue;
        const double *a = d->shell->support[d->by[node] == SEVERAL ? 0 : d->by[node] - 1].axis;
        int p = 0;
        bool all = d->by[node] == SEVERAL;
        for (int c = 0; c < AXES; c++) {
            if (fabs(a[c]) > fabs(a[p])) p = c;
            all = all || (d->fix[node] & (1u << c) && a[c] != 0);
        }
        if (all) fprintf(d->out, "*BOUNDARY\n%d,1,3\n", node + 1);
        for (int c = 0; c < AXES && !all; c++) {
            if (c == p || d->fix[node] & (1u << c)) continue;
            if (a[c] == 0) {
                fprintf(d->out, "*BOUNDARY\n%d,%d\n", node + 1, c + 1);
                continue;
            }
            fprintf(d->out, "*EQUATION\n2\n%d,%d,1,%d,%d,", node + 1, c + 1, node + 1, p + 1);
            number(d->out, -a[c] / a[p]);
            putc('\n', d->out);
        }
    }
}

/* Springs to the ground, one for each node and axis. */
static void springs_write(deck *d, int *element)
{
    for (int index = 0; index < d->shell->supports; index++) {
        const ves_figure_support *s = &d->shell->support[index];
        if (!s->spring) continue;
        memset(d->force, 0, (size_t)d->all.nodes * sizeof *d->force);
        for (int image = 0; image < d->all.images; image++)
            for (int k = 0; k < s->nodes; k++) {
                int node = node_of(d, image, s->node[k][0], s->node[k][1]);
                for (int c = 0; c < AXES && node >= 0; c++) d->force[node][c] += s->spring[k][c];
            }
        int count = nodes_of(d, index, d->node);
        for (int k = 0; k < AXES * count; k++) {
            double stiffness = d->force[d->node[k / AXES]][k % AXES];
            if (!(stiffness > 0)) continue;
            ++*element;
            fprintf(d->out, "*ELEMENT, TYPE=SPRING1, ELSET=SPRING_%d\n%d,%d\n*SPRING, ELSET=SPRING_%d\n%d\n",
                    *element, *element, d->node[k / AXES] + 1, *element, k % AXES + 1);
            number(d->out, stiffness);
            putc('\n', d->out);
        }
    }
}

static void supports_write(deck *d, int *element)
{
    for (int k = 0; k < d->shell->supports; k++) set_write(d, k);
    for (int k = 0; k < d->shell->supports; k++) fix_write(d, k);
    oblique_write(d);
    springs_write(d, element);
}

/* --- load cases --- */

/* The forces of a case at all nodes of all images. */
static void forces_sum(deck *d, const ves_figure_case *load)
{
    memset(d->force, 0, (size_t)d->all.nodes * sizeof *d->force);
    for (int image = 0; image < d->all.images; image++)
        for (int patch = 0; patch < d->figure->patches; patch++) {
            const ves_figure_patch *p = &d->figure->patch[patch];
            for (int s = 0; d->shell->thickness[patch] && s < p->rows * p->columns; s++) {
                int node = node_of(d, image, patch, s);
                for (int c = 0; c < AXES && node >= 0; c++)
                    d->force[node][c] += d->all.sign[image][c] * load->force[patch][c][s];
            }
        }
}

static void forces_write(deck *d, const ves_figure_case *load)
{
    forces_sum(d, load);
    fputs("*CLOAD, OP=NEW\n", d->out);
    for (int node = 0; node < d->all.nodes; node++)
        for (int c = 0; c < AXES; c++) {
            if (d->force[node][c] == 0) continue;
            fprintf(d->out, "%d,%d,", node + 1, c + 1);
            number(d->out, d->force[node][c]);
            putc('\n', d->out);
        }
}

static void static_write(deck *d, const ves_figure_case *load)
{
    remark(d->out, "case ", load->name);
    fputs("*STEP\n*STATIC\n", d->out);
    forces_write(d, load);
    fputs("*NODE FILE\nU\n*EL FILE\nS\n*NODE PRINT, NSET=NALL\nU\n", d->out);
    for (int k = 0; k < d->shell->supports; k++)
        if (!d->shell->support[k].mirror && !d->shell->support[k].spring)
            fprintf(d->out, "*NODE PRINT, NSET=SUPPORT_%d, TOTALS=ONLY\nRF\n", k + 1);
    fputs("*END STEP\n", d->out);
}

/* By itself: what was loaded before does not count in a step that is no perturbation. */
static void buckle_write(deck *d, const ves_figure_case *load)
{
    remark(d->out, "buckling of case ", load->name);
    /* what is not said has ccx iterate to 1 %, which it takes of clustered factors: up to a tenth too much */
    int wanted = d->shell->factors, vectors = 4 * wanted > 20 ? 4 * wanted : 20;
    fprintf(d->out, "*STEP\n*BUCKLE\n%d, 1e-6, %d, 5000\n", wanted, vectors);
    forces_write(d, load);
    fputs("*NODE FILE\nU\n*END STEP\n", d->out);
}

/* --- all --- */

static ves_status room_make(deck *d)
{
    size_t nodes = (size_t)d->all.nodes;
    d->fix = ves_arena_take(&d->arena, nodes, sizeof *d->fix);
    d->by = ves_arena_take(&d->arena, nodes, sizeof *d->by);
    d->node = ves_arena_take(&d->arena, nodes, sizeof *d->node);
    d->met = ves_arena_take(&d->arena, nodes, sizeof *d->met);
    d->force = ves_arena_take(&d->arena, nodes, sizeof *d->force);
    return d->fix && d->by && d->node && d->met && d->force ? VES_OK : VES_MEMORY;
}

static void deck_write(deck *d)
{
    int element = 0;
    head_write(d);
    for (int patch = 0; patch < d->figure->patches; patch++) {
        if (!d->shell->thickness[patch]) continue;
        kind_write(d, patch, VES_ELEMENT_NODES, &element);
        kind_write(d, patch, VES_TRIANGLE_NODES, &element);
    }
    sections_write(d);
    supports_write(d, &element);
    for (int k = 0; k < d->shell->cases; k++) static_write(d, &d->shell->load_case[k]);
    for (int k = 0; k < d->shell->cases && d->shell->factors > 0; k++)
        buckle_write(d, &d->shell->load_case[k]);
}

static ves_status deck_make(deck *d, const char *path, ves_diag *diag)
{
    ves_file file;
    const char *refused = d->shell->refused;
    if (!refused) {
        ves_status status = ves_elements_make(d->figure, &d->arena, &d->all);
        if (status == VES_OK && !d->all.refused) status = room_make(d);
        if (status != VES_OK)
            return ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "%s", ves_status_text(status));
        refused = d->all.refused;
    }
    if (refused) return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0}, "no deck inp: %s", refused);
    VES_TRY(ves_file_begin(&file, path, "inp", diag));
    d->out = file.out;
    deck_write(d);
    if (d->partial)
        ves_diag_add(
            diag, VES_WARNING, VES_OK, (ves_mark){0},
            "\"%s\": some, not all, rotations of a node are held, and CalculiX is then far too stiff", path);
    return ves_file_end(&file, VES_OK, diag);
}

static ves_status write(ves_figure *figure, const char *path, ves_diag *diag)
{
    deck d = {.figure = figure, .shell = figure->shell};
    if (!figure->shell)
        return ves_diag_add(
            diag, VES_ERROR, VES_USAGE, (ves_mark){0},
            "no deck inp: the problem file has no section \"shell\", which says how thick the shape is, what "
            "holds it and what pulls");
    ves_status status = deck_make(&d, path, diag);
    ves_arena_destroy(&d.arena);
    return status;
}

const ves_format ves_format_inp = {.name = "inp",
                                   .about = "the shell with its supports and load cases, a deck for CalculiX",
                                   .write = write,
                                   .shell = true};
