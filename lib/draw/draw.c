#include "sightline/draw.h"

#include "draw/legend.h"
#include "draw/page.h"
#include "draw/plan.h"
#include "sightline/support.h"

#include <math.h>

#define ALL_LAYERS                                                                                 \
    (SL_LAYER_CELLS | SL_LAYER_PORTALS | SL_LAYER_WALLS | SL_LAYER_PVS | SL_LAYER_STAB_TREE |      \
     SL_LAYER_STARTS | SL_LAYER_LEGEND)

sl_draw_options sl_draw_options_default(void) {
    return (sl_draw_options){
        .layers = ALL_LAYERS & ~(unsigned)SL_LAYER_STAB_TREE, .cell = SL_NO_CELL, .width = 1200};
}

static sl_status check_options(sl_context *context, const sl_baked *baked,
                               const sl_draw_options *options) {
    SL_TRY(sl_page_check_width(context, options->width));
    if (options->layers & ~(unsigned)ALL_LAYERS)
        return sl_fail(context, SL_BAD_ARGUMENT, "layers 0x%x: only 0x%x are known",
                       options->layers, ALL_LAYERS);
    if (options->cell != SL_NO_CELL && options->cell >= baked->space.cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: the map has %u cells", options->cell,
                       baked->space.cell_count);
    return SL_OK;
}

static sl_strip strip_at(const sl_page *page, double top, bool paint) {
    return (sl_strip){page->margin, top, page->inner, page->text, paint};
}

static void set_page(cairo_t *cairo, const void *what, sl_page *page, bool paint) {
    const sl_scene *scene = what;
    const sl_strip heading = strip_at(page, page->margin, paint);
    double y = page->margin + sl_draw_heading(cairo, scene, &heading);
    if (y > page->margin) y += 0.6 * page->margin;
    if (!paint) sl_page_place_plan(page, scene->baked->space.bounds, y, SL_PAGE_TALLEST);
    y = page->bottom;
    if (scene->options.layers & SL_LAYER_LEGEND) {
        const sl_strip legend = strip_at(page, y + 0.55 * page->margin, paint);
        const sl_pens pens = sl_pens_for(scene, &page->frame);
        y = legend.top + sl_draw_legend(cairo, scene, &page->frame, &pens, &legend) -
            0.3 * page->margin;
    }
    page->height = ceil(y + page->margin);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    return sl_draw_onto(context, cairo, what, frame);
}

static sl_status draw_scene(sl_context *context, const sl_scene *scene, const sl_paper_kind *kind,
                            const char *path) {
    const sl_page_parts parts = {.set = set_page,
                                 .draw_plan = draw_plan,
                                 .what = scene,
                                 .ground = scene->palette.page,
                                 .title = scene->options.title};
    return sl_page_write(context, &parts, scene->options.width, kind, path);
}

sl_status sl_draw_file(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                       const char *path) {
    const sl_paper_kind *kind;
    sl_scene scene;
    SL_TRY(sl_paper_kind_of(context, path, &kind));
    SL_TRY(check_options(context, baked, options));
    SL_TRY(sl_scene_make(context, baked, options, &scene));
    const sl_status status = draw_scene(context, &scene, kind, path);
    sl_scene_destroy(context, &scene);
    return status;
}
