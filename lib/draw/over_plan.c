/// What callers add to a picture of a plan: tinted areas, lines, places and names over it; a key
/// and words below it.
#include "draw/marks.h"
#include "draw/page.h"

#include <math.h>

/// Tints, and the walls over them again.
static sl_status draw_areas(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                            const sl_frame *frame) {
    bool any = false;
    for (size_t i = 0; i < scene->options.part_count; i++) {
        const sl_drawn_part *part = &scene->options.parts[i];
        const sl_shape *area = &part->area;
        if (!area->count) continue;
        if (!any) sli_layer_begin(cairo, "parts");
        any = true;
        for (size_t k = 0, from = 0; k < area->count; from = area->ends[k++])
            sl_path_polygon(cairo, frame, area->points + from, area->ends[k] - from);
        sli_set_faded(cairo, part->colour, part->opacity);
        cairo_fill(cairo);
    }
    return any ? sl_draw_walls(context, cairo, scene, frame) : SL_OK;
}

static void draw_lines(cairo_t *cairo, const sl_drawn_part *part, double width) {
    const double dash[] = {5 * width, 3 * width};
    cairo_save(cairo);
    if (part->dashed) cairo_set_dash(cairo, dash, 2, 0);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    sli_pen_stroke(cairo, part->colour, width);
    cairo_restore(cairo);
}

static void draw_place(cairo_t *cairo, const sl_scene *scene, const sl_drawn_part *part,
                       sl_point at, double radius) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, SLI_FULL_TURN);
    sl_set_colour(cairo, part->colour);
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, scene->palette.page, 0.24 * radius);
}

static void draw_label(cairo_t *cairo, const sl_scene *scene, const sl_plan_label *label,
                       const sl_frame *frame, double size) {
    const double room = fmax(label->width * frame->scale, 3 * size);
    const sl_point at = sl_frame_point(frame, label->at);
    sl_text_font(cairo, size, false);
    const double wide = fmin(sl_text_width(cairo, label->text), room);
    sl_text_show_within(cairo, scene->palette.ink, at.x - wide / 2, at.y + 0.36 * size, room, size,
                        false, label->text);
}

sl_status sli_draw_over_plan(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                             const sl_frame *frame, double text) {
    const sl_draw_options *o = &scene->options;
    SL_TRY(draw_areas(context, cairo, scene, frame));
    if (o->part_count) sli_layer_begin(cairo, "marks");
    for (size_t i = 0; i < o->part_count; i++) {
        const sl_drawn_part *part = &o->parts[i];
        for (size_t k = 0; k < part->line_count; k++)
            sl_path_segment(cairo, frame, part->lines[k].a, part->lines[k].b);
        draw_lines(cairo, part, 2.2 * frame->unit);
        for (size_t k = 0; k < part->place_count; k++)
            draw_place(cairo, scene, part, sl_frame_point(frame, part->places[k]), 5 * frame->unit);
    }
    if (o->label_count) sli_layer_begin(cairo, "names");
    for (size_t i = 0; i < o->label_count; i++)
        draw_label(cairo, scene, &o->labels[i], frame, 0.85 * text);
    return SL_OK;
}

// --- the key

/// What of a part its swatch shows: a tint, a line through the middle, or a disc.
static void draw_swatch(cairo_t *cairo, const sl_scene *scene, const sl_drawn_part *part,
                        sl_point at, double size) {
    const sl_point middle = {at.x + size, at.y + 0.82 * size};
    if (part->area.count) {
        cairo_rectangle(cairo, at.x, at.y + 0.22 * size, 2 * size, 1.2 * size);
        sli_set_faded(cairo, part->colour, part->opacity);
        cairo_fill(cairo);
    } else if (part->line_count) {
        cairo_move_to(cairo, at.x, middle.y);
        cairo_line_to(cairo, at.x + 2 * size, middle.y);
        draw_lines(cairo, part, 0.2 * size);
    } else {
        draw_place(cairo, scene, part, middle, 0.4 * size);
    }
}

double sli_draw_over_key(cairo_t *cairo, const sl_scene *scene, const sli_page *page, double top,
                         bool paint) {
    const sl_draw_options *o = &scene->options;
    sli_key key = sli_key_at((sl_point){page->margin, top}, page->inner, page->text);
    double y = top;
    for (size_t i = 0; i < o->part_count; i++) {
        const sl_drawn_part *part = &o->parts[i];
        if (!part->name) continue;
        const sl_point at = sli_key_entry(cairo, scene->palette.ink, &key, part->name, paint);
        if (paint) draw_swatch(cairo, scene, part, at, page->text);
        y = sli_key_end(&key);
    }
    y += sli_page_caption(cairo, page, &scene->palette, y, o->words, paint);
    return y > top ? y - top + 0.2 * page->margin : 0;
}
