/* Materials: few, of which thin walls are made. Where a source gives a range, its middle. Plastics creep:
 * these are numbers for minutes at room temperature, not for weeks under load. */
#include "problem/material.h"

#include <stddef.h>
#include <string.h>

/* Callister: W. D. Callister, D. G. Rethwisch, Fundamentals of Materials Science and Engineering, 3rd edition,
 * 2008. */
static const ves_material table[] = {
    /* E 1.6 to 2.4 GPa, nu about 0.34, yield 15 to 30 MPa, 1040 to 1060 kg/m^3. */
    {"hips", "high-impact polystyrene, as of yoghurt pots",
     "data sheets of grades for thermoforming, of which these are the middle", 2.0e9, 0.35, 1050, 20e6},
    /* E 1.14 to 1.55 GPa, yield 31.0 to 37.2 MPa. */
    {"pp", "polypropylene", "Callister, Appendix B", 1.35e9, 0.40, 905, 34e6},
    /* E 2.76 to 4.14 GPa. */
    {"pet", "poly(ethylene terephthalate), as of bottles and trays", "Callister, Appendix B", 3.45e9, 0.33,
     1350, 59.3e6},
    /* The proof strength is that of sheet from 0.4 to 12.5 mm, EN 485-2. */
    {"aluminium", "aluminium EN AW-6061 T6, sheet", "EN 1999-1-1, 3.2.5; EN 485-2", 70e9, 0.3, 2700, 240e6},
    /* The yield strength holds up to 40 mm. */
    {"steel", "structural steel S235", "EN 1993-1-1, Table 3.1 and 3.2.6; density EN 1991-1-1, Table A.4",
     210e9, 0.3, 7850, 235e6},
    /* The proof strength of cold-rolled strip. */
    {"stainless", "stainless steel 1.4301 (AISI 304), cold-rolled strip", "EN 10088-1 and -2", 200e9, 0.3,
     7900, 230e6},
    {0}};

const ves_material *ves_materials(void)
{
    return table;
}

const ves_material *ves_material_find(const char *name)
{
    for (const ves_material *m = table; m->name; m++)
        if (!strcmp(m->name, name)) return m;
    return NULL;
}
