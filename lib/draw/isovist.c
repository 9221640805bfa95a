/// Pictures of what is seen from places: regions over the plan, heat maps of their measures, and
/// patches coloured by cost.
#include "draw/marks.h"
#include "draw/page.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

enum { TICKS = 5, RAMP_STEPS = 64 };

/// What a picture shows: regions, or else a field, or else patches.
typedef struct picture {
    sl_scene scene;
    const sl_drawn_region *regions;
    size_t region_count;
    const sl_field *field;
    const sl_patches *patches;
    const char *caption, *scale; ///< `scale`: what the colours tell
    const double *values;        ///< of the field or the patches
    size_t value_count;
    double least, most; ///< of the values
} picture;

static void find_range(picture *p) {
    p->least = INFINITY;
    p->most = -INFINITY;
    for (size_t i = 0; i < p->value_count; i++) {
        if (isnan(p->values[i])) continue;
        p->least = fmin(p->least, p->values[i]);
        p->most = fmax(p->most, p->values[i]);
    }
}

static double share_of(const picture *p, double value) {
    return p->most > p->least ? (value - p->least) / (p->most - p->least) : 0;
}

static int step_of(const picture *p, double value) {
    return (int)fmin(share_of(p, value) * RAMP_STEPS, RAMP_STEPS - 1);
}

static void add_square(cairo_t *cairo, const sl_frame *frame, const sl_box *bounds,
                       const sl_field *f, size_t i) {
    const double x = f->corner.x + f->step * (double)(i % f->columns);
    const double y = f->corner.y + f->step * (double)(i / f->columns);
    const sl_point low = {fmax(x, bounds->min.x), fmax(y, bounds->min.y)};
    const sl_point high = {fmin(x + f->step, bounds->max.x), fmin(y + f->step, bounds->max.y)};
    const sl_point corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
    if (low.x < high.x && low.y < high.y) sl_path_polygon(cairo, frame, corners, 4);
}

static void add_patch(cairo_t *cairo, const sl_frame *frame, const sl_patches *patches, size_t i) {
    const uint32_t first = patches->first[i];
    sl_path_polygon(cairo, frame, patches->points + first, patches->first[i + 1] - first);
}

/// Squares or patches of one colour make one path. A thin stroke covers the seams between them.
static sl_status draw_values(sl_context *context, cairo_t *cairo, const picture *p,
                             const sl_frame *frame) {
    for (int step = 0; step < RAMP_STEPS; step++) {
        SL_TRY(sl_check_cancelled(context));
        for (size_t i = 0; i < p->value_count; i++) {
            if (isnan(p->values[i]) || step_of(p, p->values[i]) != step) continue;
            if (p->field)
                add_square(cairo, frame, &p->scene.baked->space.bounds, p->field, i);
            else
                add_patch(cairo, frame, p->patches, i);
        }
        sl_set_colour(cairo, sl_palette_ramp(p->scene.palette.dark, (step + 0.5) / RAMP_STEPS));
        cairo_fill_preserve(cairo);
        cairo_set_line_width(cairo, 0.6);
        cairo_stroke(cairo);
    }
    return SL_OK;
}

static void draw_lines(cairo_t *cairo, const picture *p, const sl_frame *frame) {
    for (size_t i = 0; i < p->patches->line_count; i++) {
        const sl_point a = sl_frame_point(frame, p->patches->lines[i].a);
        const sl_point b = sl_frame_point(frame, p->patches->lines[i].b);
        cairo_move_to(cairo, a.x, a.y);
        cairo_line_to(cairo, b.x, b.y);
    }
    sl_set_colour(cairo, p->scene.palette.page);
    cairo_set_line_width(cairo, 0.8 * frame->unit);
    cairo_stroke(cairo);
}

static void draw_eye(cairo_t *cairo, const picture *p, const sl_frame *frame, sl_point eye) {
    const sl_point at = sl_frame_point(frame, eye);
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, 5 * frame->unit, 0, 6.283185307179586);
    sl_set_colour(cairo, p->scene.palette.start);
    cairo_fill_preserve(cairo);
    sl_set_colour(cairo, p->scene.palette.page);
    cairo_set_line_width(cairo, 1.2 * frame->unit);
    cairo_stroke(cairo);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const picture *p = what;
    SL_TRY(sl_draw_plan(context, cairo, &p->scene, p->scene.options.layers, frame));
    SL_TRY(draw_values(context, cairo, p, frame));
    if (p->patches) draw_lines(cairo, p, frame);
    // Squares and patches may reach from the floor into solid ground.
    sli_draw_solid(cairo, &p->scene, frame);
    for (size_t i = 0; i < p->region_count; i++)
        sl_draw_seen(cairo, &p->scene.palette, frame, &p->regions[i]);
    SL_TRY(sl_draw_walls(context, cairo, &p->scene, frame));
    for (size_t i = 0; i < p->region_count; i++) draw_eye(cairo, p, frame, p->regions[i].eye);
    return SL_OK;
}

/// The ramp with numbers under it. Returns its height.
static double draw_scale(cairo_t *cairo, const picture *p, const sli_page *g, bool paint) {
    const double width = fmin(30 * g->text, g->inner), high = 1.2 * g->text;
    if (!paint || !(p->least <= p->most)) return 3.2 * g->text;
    for (int i = 0; i < RAMP_STEPS; i++) {
        cairo_rectangle(cairo, g->margin + width * i / RAMP_STEPS, g->key,
                        width / RAMP_STEPS + (i + 1 < RAMP_STEPS ? 0.5 : 0), high);
        sl_set_colour(cairo, sl_palette_ramp(p->scene.palette.dark, (i + 0.5) / RAMP_STEPS));
        cairo_fill(cairo);
    }
    sl_text_font(cairo, g->text, false);
    const int ticks = p->most > p->least ? TICKS : 1;
    for (int i = 0; i < ticks; i++) {
        const double share = ticks > 1 ? (double)i / (ticks - 1) : 0;
        char number[32];
        snprintf(number, sizeof number, "%.4g", p->least + share * (p->most - p->least));
        const double x = g->margin + share * width, wide = sl_text_width(cairo, number);
        cairo_move_to(cairo, x, g->key + high);
        cairo_line_to(cairo, x, g->key + high + 0.35 * g->text);
        sl_set_colour(cairo, p->scene.palette.ink);
        cairo_set_line_width(cairo, 0.09 * g->text);
        cairo_stroke(cairo);
        sl_text_show(cairo, p->scene.palette.ink, fmax(x - wide / 2, g->margin),
                     g->key + high + 1.5 * g->text, number);
    }
    sl_text_show(cairo, p->scene.palette.ink, g->margin + width + 1.6 * g->text,
                 g->key + 0.95 * g->text, p->scale);
    return 3.2 * g->text;
}

static void set_page(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const picture *p = what;
    const sl_palette *palette = &p->scene.palette;
    const double top = sli_page_heading(cairo, page, palette, p->scene.options.title, NULL, paint);
    if (!paint) sli_page_place_plan(page, p->scene.baked->space.bounds, top, SLI_PAGE_TALLEST);
    double y = page->key;
    if (p->scale) y += draw_scale(cairo, p, page, paint);
    y += sli_draw_seen_key(cairo, palette, p->regions, p->region_count, (sl_point){page->margin, y},
                           page->inner, page->text, paint);
    y += sli_draw_ground_key(cairo, &p->scene, (sl_point){page->margin, y}, page->text, paint);
    if (p->caption) {
        if (paint)
            sl_text_show_within(cairo, palette->ink, page->margin, y + 1.1 * page->text,
                                page->inner, page->text, false, p->caption);
        y += 1.6 * page->text;
    }
    page->height = ceil(y + 0.7 * page->margin);
}

static sl_status draw_picture(sl_context *context, const sl_baked *baked,
                              const sl_draw_options *options, picture *p, const char *path) {
    const sli_paper_kind *kind;
    SL_TRY(sli_paper_kind_of(context, path, &kind));
    SL_TRY(sli_page_check_width(context, options->width));
    sl_draw_options plain = *options;
    plain.layers = SL_LAYER_WALLS | (p->scale ? 0 : (unsigned)SL_LAYER_STARTS);
    plain.cell = SL_NO_CELL;
    SL_TRY(sli_scene_make(context, baked, &plain, NULL, &p->scene));
    const sli_page_parts parts = {.set = set_page,
                                  .draw_plan = draw_plan,
                                  .what = p,
                                  .ground = p->scene.palette.page,
                                  .title = options->title};
    const sl_status status = sli_page_write(context, &parts, options->width, kind, path);
    sli_scene_clear(context, &p->scene);
    return status;
}

sl_status sl_draw_regions_file(sl_context *context, const sl_baked *baked,
                               const sl_drawn_region *regions, size_t count, const char *caption,
                               const sl_draw_options *options, const char *path) {
    picture p = {.regions = regions, .region_count = count, .caption = caption};
    return draw_picture(context, baked, options, &p, path);
}

sl_status sl_draw_field_file(sl_context *context, const sl_baked *baked, const sl_field *field,
                             const sl_draw_options *options, const char *path) {
    picture p = {.field = field,
                 .scale = field->name,
                 .values = field->values,
                 .value_count = field->columns * field->rows};
    find_range(&p);
    return draw_picture(context, baked, options, &p, path);
}

sl_status sl_draw_patches_file(sl_context *context, const sl_baked *baked,
                               const sl_patches *patches, const char *caption,
                               const sl_draw_options *options, const char *path) {
    picture p = {.patches = patches,
                 .caption = caption,
                 .scale = patches->name,
                 .values = patches->values,
                 .value_count = patches->count};
    find_range(&p);
    return draw_picture(context, baked, options, &p, path);
}
