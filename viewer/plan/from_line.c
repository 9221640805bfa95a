/// The regions are found once the line is dropped: behind many walls that takes a while.
#include "plan/from_line.h"

#include "sightline/draw.h"
#include "ui/tones.h"

static void forget(sl_context *context, from_line *layer) {
    tool_job_drop(context, &layer->job);
    for (int i = 0; i < 2; i++) sl_set_region_destroy(context, &layer->seen[i]);
}

void from_line_destroy(sl_context *context, from_line *layer) {
    if (!layer) return;
    forget(context, layer);
    sl_free(context, layer);
}

void from_line_begin(view_state *view, sl_point at) {
    if (!view->from_line)
        view->from_line = sl_alloc_array(view->context, 1, sizeof *view->from_line);
    from_line *layer = view->from_line;
    if (!layer) {
        view_check(view, SL_NO_MEMORY);
        return;
    }
    forget(view->context, layer);
    layer->drawn = true;
    layer->ends[0] = layer->ends[1] = at;
}

void from_line_move(view_state *view, sl_point to) {
    if (view->from_line) view->from_line->ends[1] = to;
}

static sl_status find_regions(sl_context *context, void *data) {
    from_line *layer = data;
    sl_set_sight *sight;
    SL_TRY(sl_set_sight_create(context, layer->job.query, layer->ends, 2, SL_SET_LINE, &sight));
    sl_status status = SL_OK;
    for (int i = 0; i < 2 && status == SL_OK; i++)
        status = sl_set_sight_region(context, sight, (sl_set_seen)i, &layer->seen[i]);
    sl_set_sight_destroy(context, sight);
    return status;
}

void from_line_update(view_state *view, bool wait) {
    from_line *layer = view->from_line;
    if (!layer || !layer->drawn) return;
    if (tool_job_is_old(view, &layer->job)) forget(view->context, layer);
    if (view->drag.kind == DRAG_FROM_LINE) return;
    if (tool_job_update(view, &layer->job, wait, find_regions, layer))
        ui_say(view->ui, false, "some point of the line sees %.4g, all of them see %.4g",
               layer->seen[SL_SEEN_FROM_SOME].area, layer->seen[SL_SEEN_FROM_ALL].area);
}

const from_line *from_line_seen(const view_state *view) {
    const from_line *layer = view->from_line;
    return layer && layer->drawn && layer->job.made ? layer : NULL;
}

bool from_line_clear(view_state *view) {
    if (!view->from_line || !view->from_line->drawn) return false;
    forget(view->context, view->from_line);
    view->from_line->drawn = false;
    return true;
}

// --- drawing

static void draw_region(const view_state *view, const sl_frame *frame, const sl_shape *shape,
                        uint32_t class) {
    cairo_t *cairo = view->ui->cairo;
    const sl_colour colour = sl_coverage_colour(&view->ui->palette, class);
    cairo_new_path(cairo);
    for (size_t i = 0, from = 0; i < shape->count; from = shape->ends[i++])
        sl_path_polygon(cairo, frame, shape->points + from, shape->ends[i] - from);
    sl_set_colour(cairo, colour);
    cairo_fill_preserve(cairo);
    sl_set_colour(cairo, sl_colour_mix(colour, view->ui->palette.ink, 0.4));
    cairo_set_line_width(cairo, 0.9 * frame->unit);
    cairo_stroke(cairo);
}

void from_line_draw_below(view_state *view, const sl_frame *frame) {
    const from_line *layer = from_line_seen(view);
    if (!layer) return;
    draw_region(view, frame, &layer->seen[SL_SEEN_FROM_SOME].shape, 1);
    draw_region(view, frame, &layer->seen[SL_SEEN_FROM_ALL].shape, 3);
}

void from_line_draw_above(const view_state *view, const sl_frame *frame) {
    const from_line *layer = view->from_line;
    if (!layer || !layer->drawn) return;
    cairo_new_path(view->ui->cairo);
    sl_path_segment(view->ui->cairo, frame, layer->ends[0], layer->ends[1]);
    tone_cased(view->ui->cairo, &view->ui->palette, view->ui->palette.start, 2.6 * frame->unit, 0);
    for (int i = 0; i < 2; i++) view_mark(view, frame, layer->ends[i]);
}
