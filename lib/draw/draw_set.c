/// Pictures of what is seen from a line or an area: from some point of it, and from all.
#include "draw/marks.h"
#include "draw/page.h"

#include <math.h>

typedef struct picture {
    sl_scene scene;
    const sl_drawn_set *set;
    const char *caption;
} picture;

static void draw_shape(cairo_t *cairo, const picture *p, const sl_frame *frame,
                       const sl_shape *shape, uint32_t class) {
    const sl_colour colour = sl_coverage_colour(&p->scene.palette, class);
    for (size_t i = 0, from = 0; i < shape->count; from = shape->ends[i++])
        sl_path_polygon(cairo, frame, shape->points + from, shape->ends[i] - from);
    sl_set_colour(cairo, colour);
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, sl_colour_mix(colour, p->scene.palette.ink, 0.4), 0.9 * frame->unit);
}

static void draw_points(cairo_t *cairo, const picture *p, const sl_frame *frame) {
    const sl_drawn_set *set = p->set;
    for (size_t i = 0; i < set->count; i++) {
        const sl_point at = sl_frame_point(frame, set->points[i]);
        if (i)
            cairo_line_to(cairo, at.x, at.y);
        else
            cairo_move_to(cairo, at.x, at.y);
    }
    if (set->is_area) cairo_close_path(cairo);
    if (set->count == 1) cairo_close_path(cairo); // a dot
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    sli_pen_stroke(cairo, sl_viewpoint_colour(&p->scene.palette, 1), 3 * frame->unit);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const picture *p = what;
    SL_TRY(sl_draw_plan(context, cairo, &p->scene, p->scene.options.layers, frame));
    draw_shape(cairo, p, frame, &p->set->some, 1);
    draw_shape(cairo, p, frame, &p->set->all, 3);
    sli_draw_solid(cairo, &p->scene, frame);
    SL_TRY(sl_draw_walls(context, cairo, &p->scene, frame));
    draw_points(cairo, p, frame);
    return SL_OK;
}

static void draw_key(cairo_t *cairo, const picture *p, sl_point at, double size) {
    static const char *const texts[] = {"seen from some point", "from all points"};
    double x = at.x;
    for (uint32_t i = 0; i < 2; i++) {
        cairo_rectangle(cairo, x, at.y + 0.22 * size, 2 * size, 1.2 * size);
        sl_set_colour(cairo, sl_coverage_colour(&p->scene.palette, i ? 3 : 1));
        cairo_fill(cairo);
        sl_text_font(cairo, size, false);
        sl_text_show(cairo, p->scene.palette.ink, x + 2.55 * size, at.y + 1.16 * size, texts[i]);
        x += 4.45 * size + sl_text_width(cairo, texts[i]);
    }
}

static void set_page(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const picture *p = what;
    const sl_palette *palette = &p->scene.palette;
    const double top = sli_page_heading(cairo, page, palette, p->scene.options.title, NULL, paint);
    if (!paint) sli_page_place_plan(page, p->scene.baked->space.bounds, top, SLI_PAGE_TALLEST);
    double y = page->key;
    if (paint) draw_key(cairo, p, (sl_point){page->margin, y}, page->text);
    y += 1.95 * page->text;
    y += sli_draw_ground_key(cairo, &p->scene, (sl_point){page->margin, y}, page->text, paint);
    y += sli_page_caption(cairo, page, palette, y, p->caption, paint);
    page->height = ceil(y + 0.7 * page->margin);
}

sl_status sl_draw_set_file(sl_context *context, const sl_baked *baked, const sl_drawn_set *set,
                           const char *caption, const sl_draw_options *options, const char *path) {
    picture p = {.set = set, .caption = caption};
    const sli_page_parts parts = {.set = set_page, .draw_plan = draw_plan, .what = &p};
    return sli_page_draw_map(context, baked, options, SL_LAYER_WALLS, &p.scene, parts,
                             &(sli_page_target){.path = path});
}
