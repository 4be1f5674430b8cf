/* Measures: Shape -> number. *Objective* and *constraint* are roles that a problem file gives to measures.
 *
 * A measure declares which samples it reads; the plan fills them once for all measures. A measure built
 * outside the tree is the same descriptor in a shared object that exports const ves_plugin ves_plugin_entry =
 * {VES_ABI, "my measures", list}; and is loaded with --plugin. Everything here is in SI units, angles in
 * radians.
 *
 * Planes: a scalar at node s = j * nu + i (i along u, j along v: u runs fastest, since every sum over modes
 * is then a sum of whole vector registers along u); a vector is three planes. */
#ifndef VESICA_MEASURE_H
#define VESICA_MEASURE_H

#include "vesica/field.h"
#include "vesica/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { VES_ABI = 1, VES_NO_DEGREE = -100 };

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

typedef enum ves_site {
    VES_SITE_SURFACE, /* the quadrature nodes of a patch */
    VES_SITE_CAP,     /* an end curve closed by a flat fan to its mean point; nodes along v (nu = 1) */
    VES_SITE_CURVE,   /* a curve that a CURVE or PLACE key names; nodes along v (nu = 1) */
    VES_SITE_PLACE    /* one named point of a patch (nu = nv = 1) */
} ves_site;

/* Samples of one site. A plane that nobody asked for is NULL. */
typedef struct ves_samples {
    ves_site site;
    int patch;           /* index of the patch; -1 for a curve */
    int nu, nv;          /* nodes along u and v */
    int count;           /* nu * nv */
    double side;         /* SITE_CAP: +1 or -1, so that side * (X - mean of X) x Xv points out of the shape */
    bool periodic;       /* in v */
    const double *u, *v; /* [nu], [nv]: 0 <= u <= 1, 0 <= v < 2 pi (or both ends when not periodic) */
    const double *weight; /* [count] quadrature weight in du dv (along a curve: dv) */
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

/* What an instance of a measure reads. Samples come in this order: surfaces (those named in `over`, or all),
 * caps, then one for each CURVE or PLACE key in the order of the table. */
typedef struct ves_measure_input {
    int samples;
    const ves_samples *const *sample;
    const ves_args *args;
    const double *number; /* number block: the value of key k is number[args->arg[k].first] */
    double *room;         /* scratch: what `room` asked for */
} ves_measure_input;

typedef struct ves_measure {
    const char *name;  /* the word in problem files */
    const char *about; /* one line */
    const char *unit;  /* dimension: "m^2"; "1". Files without units ignore it. NULL: that of the key `of`; a
                          leading * multiplies that: "*m^2" */
    int degree; /* of homogeneity: scaling the shape by s scales the measure by s^degree (for exact scale:).
                   VES_NO_DEGREE: it does not scale so, and cannot be used in scale: */
    int cost;   /* 0: like the samples themselves; 1: dear (solves systems): measured last */
    unsigned surface; /* VES_X | ... wanted at surface nodes */
    unsigned cap;     /* ... along caps; 0: the measure does not look at caps */
    unsigned curve;   /* ... along curves and at places that keys name */
    bool closed;      /* needs a closed shape (caps count): the reader refuses it elsewhere */
    bool (*closes)(const ves_args *args); /* NULL, or whether an instance with these arguments needs one */
    const ves_key *keys; /* besides `over`, which every measure with `surface` has; NULL: none */

    /* Doubles of scratch for this instance; NULL: none. */
    size_t (*room)(const ves_measure_input *input);

    /* VES_OK, or a positive status: this candidate cannot be measured; *value untouched. */
    ves_status (*eval)(const ves_measure_input *input, double *value);

    /* Adds seed * dJ/d(plane) to adjoint[i] for each sample i, and seed * dJ/d(number) to number_adjoint
     * (indexed like the number block). Called after eval on the same input; room as eval left it. NULL: no
     * gradient. */
    void (*gradient)(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint);
} ves_measure;

typedef struct ves_plugin {
    int abi; /* VES_ABI */
    const char *name;
    const ves_measure *const *measure; /* NULL-terminated */
} ves_plugin;

#ifdef __cplusplus
}
#endif
#endif
