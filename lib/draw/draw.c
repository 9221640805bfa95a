#include "sightline/draw.h"

#include "base/base.h"
#include "draw/legend.h"
#include "draw/paper.h"
#include "draw/plan.h"

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
    if (!(options->width >= SL_DRAW_WIDTH_MIN && options->width <= SL_DRAW_WIDTH_MAX))
        return sl_fail(context, SL_BAD_ARGUMENT, "width %g: must be %d to %d", options->width,
                       SL_DRAW_WIDTH_MIN, SL_DRAW_WIDTH_MAX);
    if (options->layers & ~(unsigned)ALL_LAYERS)
        return sl_fail(context, SL_BAD_ARGUMENT, "layers 0x%x: only 0x%x are known",
                       options->layers, ALL_LAYERS);
    if (options->cell != SL_NO_CELL && options->cell >= baked->space.cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: the map has %u cells", options->cell,
                       baked->space.cell_count);
    return SL_OK;
}

/// Where everything stands on the page.
typedef struct page {
    double width, height;
    sl_strip heading, legend;
    sl_frame frame;
} page;

/// The frame for the map is as wide as the margins leave and as high as the map then is, but never
/// lower than a sixth or higher than 1.4 of its width: a long thin map gets free paper beside it
/// and is not stretched, and the page stays within cairo's 32,767 pixels for every width allowed.
static page lay_out(cairo_t *cairo, const sl_scene *scene) {
    const double width = round(scene->options.width), margin = 0.04 * width;
    const double inner = width - 2 * margin;
    // Text shrinks less than the picture does, to stay readable in small ones.
    const double text = 16.5 * pow(width / 1200, 0.75);
    const sl_box bounds = scene->baked->space.bounds;
    const double wide = bounds.max.x - bounds.min.x, high = bounds.max.y - bounds.min.y;
    const double ratio = wide > 0 ? high / wide : high > 0 ? INFINITY : 1;
    const double map_height = inner * fmin(fmax(ratio, 1.0 / 6), 1.4);

    page p = {.width = width, .heading = {margin, margin, inner, text, false}};
    double y = margin + sl_draw_heading(cairo, scene, &p.heading);
    if (y > margin) y += 0.6 * margin;
    p.frame = sl_frame_fit(bounds, margin, y, inner, map_height, width / 1200);
    y += map_height;
    p.legend = (sl_strip){margin, y + 0.55 * margin, inner, text, false};
    if (scene->options.layers & SL_LAYER_LEGEND)
        y = p.legend.top + sl_draw_legend(cairo, scene, NULL, NULL, &p.legend) - 0.3 * margin;
    p.height = ceil(y + margin);
    p.heading.paint = p.legend.paint = true;
    return p;
}

/// Measuring text needs a surface, and the file's needs the page's height.
static sl_status measure(sl_context *context, const sl_scene *scene, const char *path, page *out) {
    cairo_surface_t *scratch = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
    cairo_t *cairo = cairo_create(scratch);
    *out = lay_out(cairo, scene);
    const cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_destroy(scratch);
    return status ? sl_fail_cairo(context, path, status) : SL_OK;
}

static sl_status draw_page(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                           const page *p) {
    const sl_pens pens = sl_pens_for(scene, &p->frame);
    sl_set_colour(cairo, scene->palette.page);
    cairo_paint(cairo);
    sl_draw_heading(cairo, scene, &p->heading);
    SL_TRY(sl_draw_onto(context, cairo, scene, &p->frame));
    if (scene->options.layers & SL_LAYER_LEGEND)
        sl_draw_legend(cairo, scene, &p->frame, &pens, &p->legend);
    return SL_OK;
}

static sl_status draw_scene(sl_context *context, const sl_scene *scene, const sl_paper_kind *kind,
                            const char *path) {
    sl_paper paper;
    page p;
    SL_TRY(measure(context, scene, path, &p));
    SL_TRY(sl_paper_open(context, kind, path, (int)p.width, (int)p.height, scene->options.title,
                         &paper));
    return sl_paper_close(context, &paper, draw_page(context, paper.cairo, scene, &p));
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
