#include "study/gallery.h"

#include "base/diag.h"

static char *title_of(const char *name, int drawn, int designs, ves_arena *arena)
{
    if (drawn < designs)
        return ves_arena_format(arena, "The best %d of the %d optima listed: %s", drawn, designs, name);
    if (designs == 1) return ves_arena_format(arena, "One optimum: %s", name);
    return ves_arena_format(arena, "%d distinct optima: %s", designs, name);
}

static ves_status picture_write(ves_gallery *gallery, const char *name, int designs, const char *path,
                                ves_diag *diag)
{
    ves_arena arena = {0};
    ves_status status = VES_OK;
    if (!gallery->items) return VES_OK;
    gallery->title = title_of(name, gallery->items, designs, &arena);
    status = gallery->title ? ves_gallery_write(gallery, path, diag) : ves_diag_fail(diag, VES_MEMORY);
    ves_arena_destroy(&arena);
    return status;
}

ves_status ves_designs_draw(ves_plan *plan, const char *name, const ves_shown_design *design, int designs,
                            const char *path, ves_diag *diag)
{
    ves_figure *figure[VES_GALLERY_MOST];
    ves_gallery_item item[VES_GALLERY_MOST];
    ves_gallery gallery = {.item = item};
    ves_status status = VES_OK;
    for (int k = 0; k < designs && gallery.items < VES_GALLERY_MOST && status >= VES_OK; k++) {
        ves_figure **made = &figure[gallery.items];
        status = ves_plan_figure(plan, design[k].x, 0, 0, made, NULL);
        if (!*made) continue;
        item[gallery.items++] = (ves_gallery_item){*made, design[k].caption, design[k].note, design[k].notes};
    }
    status =
        status < VES_OK ? ves_diag_fail(diag, status) : picture_write(&gallery, name, designs, path, diag);
    for (int k = 0; k < gallery.items; k++) ves_figure_destroy(figure[k]);
    return status;
}
