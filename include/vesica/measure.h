/* Measures: Shape -> number. *Objective* and *constraint* are roles that a problem file gives to measures.
 *
 * A measure declares which samples it reads; the plan fills them once for all measures. A measure built
 * outside the tree is the same descriptor in a shared object that exports
 *     const ves_plugin ves_plugin_entry = {VES_PLUGIN, "my measures", list};
 * and is loaded with --plugin. Everything here is in SI units, angles in radians.
 *
 * Planes: a scalar at node s = j * nu + i (i along u, j along v: u runs fastest, since every sum over modes
 * is then a sum of whole vector registers along u); a vector is three planes. */
#ifndef VESICA_MEASURE_H
#define VESICA_MEASURE_H

#include <stddef.h>

#include "vesica/field.h"
#include "vesica/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { VES_ABI = 2, VES_NO_DEGREE = -100 };

/* What a measure may ask to be filled. */
enum {
    VES_X = 1 << 0,  /* position, m */
    VES_XU = 1 << 1, /* first derivatives */
    VES_XV = 1 << 2,
    VES_XUU = 1 << 3, /* second derivatives */
    VES_XUV = 1 << 4,
    VES_XVV = 1 << 5,
    VES_NORMAL = 1 << 6,   /* unit normal, outward for closed shapes */
    VES_AREA = 1 << 7,     /* dA = |Xu x Xv| times the quadrature weight, m^2 */
    VES_CURVATURE = 1 << 8 /* H and K; H = +1/R on a sphere of radius R */
};

/* Where samples are taken, and what can be filled there. */
typedef enum ves_site {
    VES_SITE_SURFACE, /* the quadrature nodes of a patch: everything */
    VES_SITE_CAP, /* an end curve closed by a fan (a cone) to its mean point; nodes along v (nu = 1): everything,
                     but of the patch at that end. The fan itself is what X and Xv make of it */
    VES_SITE_CURVE, /* a curve that a CURVE or PLACE key names; nodes along v (nu = 1): X, Xv, Xvv. They are
                       evenly spread, more than two for each of its Fourier modes, and so say all of it */
    VES_SITE_PLACE, /* one named point of a patch (nu = nv = 1): X, Xv, Xvv */
    VES_SITE_LOOK   /* 3 x 3 points of a patch wherever the measure wants them: what it asks of surfaces */
} ves_site;

/* Samples of one site. A plane that nobody asked for is NULL. */
typedef struct ves_samples {
    ves_site site;
    int patch;     /* index of the patch; -1 for a curve */
    int nu, nv;    /* nodes along u and v */
    int count;     /* nu * nv */
    double side;   /* SITE_CAP: +1 or -1, so that side * (X - mean of X) x Xv points out of the shape */
    bool periodic; /* in v */
    /* [nu], [nv]: 0 <= u <= 1, 0 <= v < 2 pi. On a surface u are Gauss nodes; v are evenly spread when
     * periodic, Gauss nodes of 0 .. 2 pi when not: the ends of a surface are no nodes. */
    const double *u, *v;
    /* What formulas of u and v mean: the patch's own `domain`, else 0, 1 and 0, 2 pi. */
    double u_range[2], v_range[2];
    const double *weight; /* [count] quadrature weight in du dv; along curves and caps dv; none at a place */
    const double *X[3], *Xu[3], *Xv[3], *Xuu[3], *Xuv[3], *Xvv[3];
    const double *normal[3];
    const double *dA;
    const double *H, *K;
} ves_samples;

/* d J / d (each plane of ves_samples): same shapes; a measure adds to it. NULL where the plane is NULL, and
 * for sites that do not depend on any variable. */
typedef struct ves_adjoint {
    double *X[3], *Xu[3], *Xv[3], *Xuu[3], *Xuv[3], *Xvv[3];
    double *normal[3];
    double *dA;
    double *H, *K;
} ves_adjoint;

/* What an instance of a measure reads. Samples come in this order: surfaces (those named in `over`, or all;
 * none when `surface` is 0), caps (on the patches named in `over`, or all; none when `cap` is 0), looks
 * (`looks` for each surface), then one for each CURVE or PLACE key that was given, in the order of the table.
 * An optional key that was not given has no sample: those behind it move up. ves_sample_of finds them. */
typedef struct ves_measure_input {
    int samples;
    const ves_samples *const *sample;
    const ves_args *args;
    const double *number; /* number block: the value of key k is number[args->arg[k].first] */
    double *room;         /* scratch: what `room` asked for */
    int level;            /* 0: the grid of the search, 1: the one twice as fine */
    void *state;          /* what `prepare` made for this plan and level, or NULL */

    /* NULL where there are no looks. Samples the surface exactly, between nodes and on its ends too.
     * Fills look number k of surface number i at the points u[0..2] x v[0..2] (node = 3 j + i; 0 <= u <= 1,
     * 0 <= v <= 2 pi; they may coincide) and returns the index of its sample and of its adjoint; -1: at one
     * of them the surface has no number, or no tangent plane for what needs one. At an end that is one point
     * (a pole) normal, H and K are their limits along v; -1 where these do not exist, as at the tip of a
     * cone. What a look was filled with last in eval is what gradient finds. It costs a quarter of what 16 x
     * 32 nodes of a patch cost. input is the very one that eval was called with, no copy. */
    int (*look)(const struct ves_measure_input *input, int i, int k, const double u[3], const double v[3]);
    int first_look;                     /* index of the first sample of looks */
    const struct ves_shell_view *shell; /* internal, of built-in measures with `shell`: the solved shell */
} ves_measure_input;

/* The index of the sample, and of its adjoint, that belongs to key number k, a CURVE or PLACE; -1: the key
 * was not given. */
static inline int ves_sample_index(const ves_measure_input *input, int k)
{
    const ves_args *args = input->args;
    int index = input->samples;
    if (!args->arg[k].given) return -1;
    for (int i = k; i < args->count; i++)
        if ((args->key[i].kind == VES_CURVE || args->key[i].kind == VES_PLACE) && args->arg[i].given) index--;
    return index;
}

/* That sample, or NULL. */
static inline const ves_samples *ves_sample_of(const ves_measure_input *input, int k)
{
    int index = ves_sample_index(input, k);
    return index < 0 ? NULL : input->sample[index];
}

/* One descriptor serves many instances: eval and gradient run in several threads at once, on different inputs
 * (each with samples, room and state of its own), and write only through their arguments.
 *
 * Measures from outside are checked when they are loaded: name, about, eval and a readable unit must be
 * there; their names must be words that nothing else has; they ask for what the sites can fill; their keys
 * are complete, and of kinds that are open to them (vesica/field.h). */
typedef struct ves_measure {
    const char *name;  /* the word in problem files */
    const char *about; /* one line */
    const char *unit;  /* dimension: "m^2"; "1". Files without units ignore it. Of built-in measures alone:
                          NULL is that of the POINTWISE key `of`, and a leading * multiplies that: "*m^2" */
    int degree;   /* of homogeneity: scaling the shape by s scales the measure by s^degree (for exact scale:).
                     VES_NO_DEGREE: it does not scale so, and cannot be used in scale: */
    int cost;     /* 0: like the samples themselves; 1: dear (solves systems): measured last */
    bool extreme; /* an extreme: it has no say in choosing a grid */
    int looks;    /* places between nodes that it looks at, for each surface: see `look` */
    unsigned surface; /* VES_X | ... wanted at surface nodes */
    unsigned cap;     /* ... along caps; 0: the measure does not look at caps */
    unsigned curve;   /* ... along curves and at places that keys name: of VES_X, VES_XV, VES_XVV */
    bool closed;      /* needs a closed shape (caps count): the reader refuses it elsewhere */
    bool (*closes)(const ves_args *args); /* NULL, or whether an instance with these arguments needs one */
    const ves_key *keys; /* besides `over`, which every measure with `surface` has; NULL: none */

    /* What this instance wants at surface nodes, when that depends on its arguments; NULL: `surface`, which
     * must hold all that any instance may want. */
    unsigned (*needs)(const ves_args *args);

    /* Called once for each plan and level, before any eval; samples have their sizes but no values yet.
     * Whatever an evaluation must not allocate is made here. NULL: nothing. A failure is VES_MEMORY or
     * another negative status. `release` frees it. */
    ves_status (*prepare)(const ves_measure_input *input, void **state);
    void (*release)(void *state);

    /* Doubles of scratch for this instance; NULL: none. */
    size_t (*room)(const ves_measure_input *input);

    /* VES_OK, or a positive status: this candidate cannot be measured; *value untouched. VES_CUT, which is
     * the plan's own, and a positive status that vesica/status.h does not list count as VES_NO_NUMBER, as
     * does a value that is not finite. */
    ves_status (*eval)(const ves_measure_input *input, double *value);

    /* Adds seed * dJ/d(plane) to adjoint[i] for each sample i, and seed * dJ/d(number) to number_adjoint
     * (indexed like the number block). Called after eval on the same input, perhaps several times after one
     * eval with other seeds: room must stay as eval left it. A plane that this instance did not ask for has
     * no adjoint to add to. NULL: no gradient. */
    void (*gradient)(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint);

    double most;         /* no surface has more: a constraint that asks for it is refused. 0: not known */
    const char *most_of; /* what has it: "a sphere" */
    bool shell;          /* is of the shell: the reader refuses it in a file without `shell` */
    bool buckles; /* with it: its buckling is asked for, which needs more of its symmetry than its stresses */
} ves_measure;

/* Members are only ever appended, to this struct and to those above, and the enums only grow; the sizes tell
 * which of them a plugin was built with: a vesica that is older than the plugin, in any of them, refuses it,
 * a newer one takes the members of ves_measure that the plugin does not know for 0. ves_key and ves_arg stand
 * in arrays: they change only with VES_ABI. */
typedef struct ves_plugin {
    int abi;      /* VES_ABI */
    size_t size;  /* sizeof(ves_measure) */
    size_t given; /* the sizes of ves_measure_input, ves_samples and ves_adjoint together */
    const char *name;
    const ves_measure *const *measure; /* NULL-terminated */
} ves_plugin;

/* The first three members, as these headers have them. */
#define VES_PLUGIN                                                                                           \
    VES_ABI, sizeof(ves_measure), sizeof(ves_measure_input) + sizeof(ves_samples) + sizeof(ves_adjoint)

#ifdef __cplusplus
}
#endif
#endif
