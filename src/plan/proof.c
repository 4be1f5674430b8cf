/* Proof: the dear check that only accepted bests get. */
#include "bridge/bridge.h"
#include "plan/inside.h"

enum { ALONG = 24, AROUND = 48 };

/* A hollow that has come out, or a body that has gone into another, would be counted with the wrong sign. */
static ves_status nested(const ves_plan *plan, ves_figure *figure)
{
    int *corner = ves_arena_take(&figure->arena, 6 * ALONG * AROUND, sizeof *corner);
    if (!corner) return VES_MEMORY;
    return ves_plan_nested(plan, figure, corner) ? VES_OK : VES_INVERTED;
}

/* Does the shape of the last evaluation cross itself? A mesh of this fineness costs about 2 ms a patch. */
ves_status ves_plan_crosses(ves_plan *plan)
{
    ves_figure *figure;
    ves_mesh mesh;
    char message[VES_BRIDGE_TEXT];
    bool crosses = false;
    if (plan->branched) return VES_OK;
    VES_TRY(ves_plan_figure_make(plan, ALONG, AROUND, &figure));
    ves_status status = ves_plan_figure_finite(plan, figure, "", NULL) ? VES_OK : VES_NO_POINT;
    if (status == VES_OK) status = ves_figure_mesh(figure, true, &mesh);
    if (status == VES_OK) status = ves_bridge_crosses(&mesh, &crosses, message);
    if (status == VES_FAULT) status = VES_TOUCHES; /* no manifold */
    if (status == VES_OK && crosses) status = VES_SELF_INTERSECTS;
    if (status == VES_OK) status = nested(plan, figure);
    ves_figure_destroy(figure);
    return status;
}
