/* Sweep: the walks that `sweep:` of a problem file asks for, in a folder that can be gone on with.
 *
 * A walk belongs to a branch, a value of the second parameter and a direction. Its first point is searched as the file
 * says, or, so that it stays on its branch, as `first` of the sweep does; each further one from the best of the last
 * good point before it, bit for bit. Walks know nothing of each other, so that threads and ranks share them out and the
 * result does not depend on how many.
 *
 *     problem.yaml         the file as asked         sweep.json   how it was asked, which vesica walked
 *     walks/NNNN.jsonl     the points of a walk, each as soon as it is done: all that going on needs
 *     points.jsonl         all points, walk after walk, with what their neighbours say of them
 *     times.jsonl          what clocks say of each
 *     sweep.csv            the same as a table in the units of the file
 *     sweep.png            the objective over the first parameter
 *     shapes/NNNN.vtp      the shape of point NNNN        shapes.pvd   the best ones, the first parameter as time
 *     shapes.png           some of the best ones side by side */
#ifndef VES_STUDY_SWEEP_H
#define VES_STUDY_SWEEP_H

#include "study/saved.h"

typedef struct ves_sweep_walk {
    int branch; /* index; 0 where there are none */
    int second; /* index of the value of the second parameter; 0 where there is none */
    bool back;
    const char *name; /* "oblate, c0 = 3, down": what tells it from the others; "" when it is the only one */
} ves_sweep_walk;

/* What is told of a point: number k of it is column[k]. The price of a constraint is what the best objective
 * changes by, per unit, when something is added to its limit. */
typedef enum ves_sweep_group {
    VES_SWEEP_OBJECTIVE,
    VES_SWEEP_VIOLATION,
    VES_SWEEP_VARIABLE,
    VES_SWEEP_UNKNOWN,
    VES_SWEEP_MEASURE,
    VES_SWEEP_VALUE,
    VES_SWEEP_LIMIT,
    VES_SWEEP_PRICE,
    VES_SWEEP_GROUPS
} ves_sweep_group;

typedef struct ves_sweep_point {
    bool done;
    bool good;          /* feasible, proved and converged: what the next point begins at */
    const char *reason; /* why not; NULL: good */
    double reached; /* of a lost point: how far smaller steps followed the branch towards it; NAN: none did */
    int kind;       /* of the best there was, an index in kinds; -1: none, or not known */
    bool feasible;  /* it meets the constraints, proved or not */
    double *column; /* [first[VES_SWEEP_GROUPS]] SI, of the best there was; NAN: not known */
    double slope;   /* what is left of it there (ves_kkt.slope), of the objective, SI; NAN: not known */
    long evaluations, gradients;
    double wall; /* s */
    int notes;
    const char **note; /* what the run says of itself */
    int optimum;       /* which of the distinct ends of all walks at this place, from 1, the best; 0: lost */
    bool best;         /* the first of all points at this place whose end is the best */
} ves_sweep_point;

typedef struct ves_sweep {
    const ves_problem *problem;
    const ves_sweep_def *def;
    const char *folder;
    int jobs;
    int walks, count; /* points of each walk */
    int done, before; /* points; before: by earlier processes */
    const ves_sweep_walk *walk;
    int first[VES_SWEEP_GROUPS + 1]; /* the columns of each group */
    ves_sweep_point *point;          /* [walks][count] in the order of the walk */
    double wall;                     /* s, of this process */
} ves_sweep;

typedef struct ves_sweep_hooks {
    void (*begun)(void *data, const ves_sweep *sweep);               /* before the first point */
    void (*progress)(void *data, const ves_sweep *sweep, int point); /* after each, one call at a time */
    bool (*stopped)(void *data);                                     /* from any thread */
    void *data;
} ves_sweep_hooks;

typedef struct ves_sweep_options {
    int jobs;        /* 0: all threads of the machine */
    const char *out; /* this folder, new or empty; NULL: runs/NAME-sweep-NNNN */
    bool seeded;     /* seed holds; else the problem's */
    uint64_t seed;
    bool resume;                      /* go on in the folder `out` */
    const ves_measure *const *plugin; /* what the problem was read with */
    const ves_team *team;             /* NULL: alone. All ranks see the same folder */
} ves_sweep_options;

/* The problem must outlive the sweep. *sweep is not NULL where there is something to show, also after
 * VES_INTERRUPTED and when a file could not be written; on ranks other than 0 it is always NULL. */
ves_status ves_sweep_run(const ves_problem *problem, const ves_sweep_options *options,
                         const ves_sweep_hooks *hooks, ves_sweep **sweep, ves_diag *diag);
void ves_sweep_destroy(ves_sweep *sweep); /* NULL: nothing */

/* Which value of the first parameter point `index` stands at; the point of a walk at one. */
int ves_sweep_place(const ves_sweep *sweep, int index);
int ves_sweep_point_at(const ves_sweep *sweep, int walk, int place);
/* The point of the walk at which this one began, if both were measured and are of different kinds; -1: none. */
int ves_sweep_turned(const ves_sweep *sweep, int index);
/* The walk of the same branch and second value the other way; -1: there is none. */
int ves_sweep_return(const ves_sweep *sweep, int walk);

const char *ves_sweep_direction(const ves_sweep *sweep, bool back); /* "up", "down" */

/* As people are told it: "nu = 0.55", with its unit. */
void ves_sweep_text(const ves_sweep *sweep, int axis, int value, char text[VES_QUANTITY]);

#endif
