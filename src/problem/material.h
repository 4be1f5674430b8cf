/* Material: the built-in table of what shells are made of. SI units. */
#ifndef VES_PROBLEM_MATERIAL_H
#define VES_PROBLEM_MATERIAL_H

typedef struct ves_material {
    const char *name;   /* the word in problem files */
    const char *about;  /* one line */
    const char *source; /* of its numbers */
    double E, nu, density, yield;
} ves_material;

const ves_material *ves_materials(void); /* ends with one without a name */
const ves_material *ves_material_find(const char *name);

#endif
