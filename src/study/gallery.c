#include "study/gallery.h"

#include "base/diag.h"

char *ves_shown_value(double value, const ves_shown *shown, ves_arena *arena)
{
    return ves_arena_format(arena, "%#.9g%s%s", value / shown->factor, *shown->unit ? " " : "", shown->unit);
}

static char *title_of(const ves_shown_designs *d, int drawn, ves_arena *arena)
{
    if (drawn < d->designs)
        return ves_arena_format(arena, "The best %d of the %d %s listed: %s", drawn, d->designs, d->many,
                                d->name);
    if (drawn == 1) return ves_arena_format(arena, "One %s: %s", d->one, d->name);
    return ves_arena_format(arena, "%d distinct %s: %s", drawn, d->many, d->name);
}

static ves_status picture_write(ves_gallery *gallery, const ves_shown_designs *d, const char *path,
                                ves_diag *diag)
{
    ves_arena arena = {0};
    ves_status status = VES_OK;
    if (!gallery->items) return VES_OK;
    gallery->title = title_of(d, gallery->items, &arena);
    status = gallery->title ? ves_gallery_write(gallery, path, diag) : ves_diag_fail(diag, VES_MEMORY);
    ves_arena_destroy(&arena);
    return status;
}

ves_status ves_designs_draw(ves_plan *plan, const ves_shown_designs *d, const char *path, ves_diag *diag)
{
    ves_figure *figure[VES_GALLERY_MOST];
    ves_gallery_item item[VES_GALLERY_MOST];
    ves_gallery gallery = {.item = item};
    ves_status status = VES_OK;
    for (int k = 0; k < d->designs && gallery.items < VES_GALLERY_MOST && status >= VES_OK; k++) {
        ves_figure **made = &figure[gallery.items];
        const ves_shown_design *design = &d->design[k];
        status = ves_plan_figure(plan, design->x, 0, 0, made, NULL);
        if (!*made) continue;
        item[gallery.items++] = (ves_gallery_item){*made, design->caption, design->note, design->notes};
    }
    status = status < VES_OK ? ves_diag_fail(diag, status) : picture_write(&gallery, d, path, diag);
    for (int k = 0; k < gallery.items; k++) ves_figure_destroy(figure[k]);
    return status;
}
