/* Proof: the dear check that only accepted bests get. */
#include "bridge/bridge.h"
#include "plan/inside.h"

enum { ALONG = 24, AROUND = 48 };

/* Does the shape of the last evaluation cross itself? A mesh of this fineness costs about 2 ms a patch. */
ves_status ves_plan_crosses(ves_plan *plan)
{
    ves_figure *figure;
    ves_mesh mesh;
    char message[VES_BRIDGE_TEXT];
    bool crosses = false;
    if (plan->branched) return VES_OK;
    VES_TRY(ves_plan_figure_make(plan, ALONG, AROUND, &figure));
    ves_status status = ves_figure_mesh(figure, true, &mesh);
    if (status == VES_OK) status = ves_bridge_crosses(&mesh, &crosses, message);
    ves_figure_destroy(figure);
    if (status == VES_FAULT) return VES_TOUCHES; /* no manifold */
    return status == VES_OK && crosses ? VES_SELF_INTERSECTS : status;
}
