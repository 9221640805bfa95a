/// The plan: pictures that are kept from frame to frame, and over them what changes.
#include "panes/panes.h"

#include "panes/modes.h"
#include "plan/drag_world.h"
#include "plan/heat.h"
#include "plan/view_cells.h"

#include "draw/draw_lesson.h" // private: the layer of splits shows the inside of the library
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

/// While the plan moves, a picture that takes longer than this to draw is moved instead.
#define SLOW_SECONDS 0.007

// --- scenes

static unsigned scene_layers(const view_state *view) {
    const bool named = layers_shows(view, LAYER_NAMES) && !view->in_the_making;
    const bool numbers = layers_shows(view, LAYER_NUMBERS) || named;
    return SL_LAYER_WALLS | (layers_shows(view, LAYER_CELLS) ? SL_LAYER_CELLS : 0u) |
           (layers_shows(view, LAYER_PORTALS) ? SL_LAYER_PORTALS : 0u) |
           (numbers ? SL_LAYER_NUMBERS : 0u) | (view->show & SHOW_STARTS ? SL_LAYER_STARTS : 0u);
}

static bool make_scene(view_state *view) {
    const unsigned layers = scene_layers(view);
    const uint32_t key = layers | (view->ui->dark ? 1024u : 0u) | (view->ui->presents ? 2048u : 0u);
    if (view->scene && view->scene_version == view->document->version && view->scene_show == key)
        return true;
    sl_scene_destroy(view->context, view->scene);
    view->scene = NULL;
    sl_draw_options options = sl_draw_options_default();
    options.layers = layers;
    options.cell = SL_NO_CELL;
    options.dark = view->ui->dark;
    const sl_status status =
        sl_scene_create(view->context, view->document->baked, &options, NULL, &view->scene);
    view_check(view, status);
    if (!view->document->live) view->pen_size = 0;
    if (status == SL_OK) plan_keep_pens(view->scene, &view->pen_size, ui_strength(view->ui));
    view->scene_version = view->document->version;
    view->scene_show = key;
    return status == SL_OK;
}

// --- pictures that are kept

static sl_context *drawing(const view_state *view) {
    return view->drawing ? view->drawing : view->context;
}

/// Draws what is below all that changes: cells, portals, view cells, splits. False if it was
/// stopped.
static bool draw_under(view_state *view, cairo_t *cairo, const sl_frame *frame) {
    const unsigned layers =
        scene_layers(view) & ~(unsigned)(SL_LAYER_WALLS | SL_LAYER_STARTS | SL_LAYER_NUMBERS);
    sl_set_colour(cairo, view->ui->palette.page);
    cairo_paint(cairo);
    if (sl_draw_plan(drawing(view), cairo, view->scene, layers, frame) != SL_OK) return false;
    if (layers_shows(view, LAYER_VIEWS)) view_layer_draw(view, cairo, frame);
    heat_layer_draw(view, cairo, frame);
    const unsigned fill = layers_fill(view);
    if ((fill == LAYER_VIEWS || fill == LAYER_HEAT) && layers_shows(view, LAYER_PORTALS))
        layers_draw_portals(view, cairo, frame, NULL, NULL);
    if (view->show & SHOW_SPLITS && view->mode != MODE_PLAN)
        sli_draw_splits(cairo, &view->ui->palette, frame, view->document->splits,
                        view->document->baked->space.node_count, view->split_depth);
    return true;
}

/// Draws what is over it: walls and other things of the map.
static bool draw_over(view_state *view, cairo_t *cairo, const sl_frame *frame) {
    const sl_scene *dragged = drag_world_walls(view, view->scene);
    return sl_draw_walls(drawing(view), cairo, dragged ? dragged : view->scene, frame) == SL_OK;
}

/// The frame of a pane with its upper left at the origin.
static sl_frame at_origin(sl_frame frame) {
    frame.left = frame.top = 0;
    return frame;
}

/// Draws a picture where it is clipped to.
static bool paint_picture(view_state *view, cairo_t *cairo, bool over, const sl_frame *frame) {
    bool whole;
    if (over) {
        cairo_set_operator(cairo, CAIRO_OPERATOR_CLEAR);
        cairo_paint(cairo);
        cairo_set_operator(cairo, CAIRO_OPERATOR_OVER);
        whole = draw_over(view, cairo, frame);
    } else {
        whole = draw_under(view, cairo, frame);
    }
    return whole && cairo_status(cairo) == CAIRO_STATUS_SUCCESS;
}

/// The part of a frame around a box of the map, in whole pixels.
static void part_of_frame(const sl_frame *frame, const sl_box *box, sl_frame *part) {
    const double around = 16 * frame->unit + 2; // lines and marks reach out of the box
    const sl_point low = sl_frame_point(frame, box->min), high = sl_frame_point(frame, box->max);
    const double left = fmax(floor(low.x - around), 0), top = fmax(floor(high.y - around), 0);
    const double right = fmin(ceil(high.x + around), frame->width);
    const double bottom = fmin(ceil(low.y + around), frame->height);
    *part = *frame;
    part->left = left;
    part->top = top;
    part->width = fmax(right - left, 0);
    part->height = fmax(bottom - top, 0);
    part->corner.x = frame->corner.x + left / frame->scale;
    part->corner.y = frame->corner.y + (frame->height - bottom) / frame->scale;
}

/// Pixels about a part in which things are drawn only to be clipped.
#define AROUND 200

/// Draws what differs from the picture, which was drawn for the same frame. False if that is much.
static bool mend_picture(view_state *view, kept_picture *kept, bool over, const sl_frame *local) {
    const document_state *document = view->document;
    plan_items now = {0};
    sl_box boxes[CHANGES_MOST];
    sl_frame parts[CHANGES_MOST];
    if (!kept->items.count ||
        plan_items_list(view->context, document->baked, view->scene, over, &now) != SL_OK) {
        sl_free(view->context, now.items);
        return false;
    }
    const int count = plan_items_compare(&kept->items, &now, boxes);
    sl_free(view->context, kept->items.items);
    kept->items = now;
    double area = 0;
    for (int i = 0; i < count; i++) {
        part_of_frame(local, &boxes[i], &parts[i]);
        area += (parts[i].width + AROUND) * (parts[i].height + AROUND);
    }
    if (area > 0.8 * (local->width + AROUND) * (local->height + AROUND)) return false;
    bool good = true;
    for (int i = 0; i < count && good; i++) {
        cairo_t *cairo = cairo_create(kept->surface);
        cairo_rectangle(cairo, parts[i].left, parts[i].top, parts[i].width, parts[i].height);
        cairo_clip(cairo);
        good = paint_picture(view, cairo, over, &parts[i]);
        cairo_destroy(cairo);
    }
    return good;
}

static bool remake_picture(view_state *view, kept_picture *kept, bool over, const sl_frame *local) {
    const int width = (int)ceil(local->width), height = (int)ceil(local->height);
    const double before = sl_seconds();
    if (!kept->surface || cairo_image_surface_get_width(kept->surface) != width ||
        cairo_image_surface_get_height(kept->surface) != height) {
        if (kept->surface) cairo_surface_destroy(kept->surface);
        kept->surface = cairo_image_surface_create(over ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24,
                                                   width, height);
    }
    cairo_t *cairo = cairo_create(kept->surface);
    const bool good = paint_picture(view, cairo, over, local);
    cairo_destroy(cairo);
    kept->items.count = 0;
    if (!good) kept->key.version = view->document->version - 1; // it is drawn again
    if (good && view->drag.changed && !view->drag_world)
        view_check(view, plan_items_list(view->context, view->document->baked, view->scene, over,
                                         &kept->items));
    kept->seconds = sl_seconds() - before;
    return good;
}

/// Shows the picture at the present frame: moves and scales it if it was drawn for another one.
static void show_picture(cairo_t *cairo, const kept_picture *kept, const sl_frame *frame,
                         sl_colour page, bool over) {
    const sl_frame *old = &kept->key.frame;
    const double s = frame->scale / old->scale;
    const double x = (old->corner.x - frame->corner.x) * frame->scale;
    const double y =
        frame->height - s * old->height - (old->corner.y - frame->corner.y) * frame->scale;
    const bool moved = s != 1 || fabs(x) > 1e-9 || fabs(y) > 1e-9;
    cairo_save(cairo);
    if (moved && !over) {
        sl_set_colour(cairo, page);
        cairo_paint(cairo);
    }
    cairo_translate(cairo, frame->left, frame->top);
    if (moved) {
        cairo_translate(cairo, s == 1 ? round(x) : x, s == 1 ? round(y) : y);
        cairo_scale(cairo, s, s);
    }
    cairo_set_source_surface(cairo, kept->surface, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cairo),
                             moved && s != 1 ? CAIRO_FILTER_FAST : CAIRO_FILTER_NEAREST);
    cairo_paint(cairo);
    cairo_restore(cairo);
}

static void show_kept(view_state *view, kept_picture *kept, bool over, const sl_frame *frame) {
    kept_picture now;
    memset(&now.key, 0, sizeof now.key);
    now.key.version = view->document->version;
    now.key.touched = over ? view->document->touched : 0;
    now.key.show = scene_layers(view) | (view->show & SHOW_SPLITS && !over ? 2048u : 0u) |
                   (view->mode == MODE_PLAN ? 4096u : 0u);
    now.key.depth = view->show & SHOW_SPLITS && !over ? view->split_depth : 0;
    now.key.dark = view->ui->dark;
    if (!over && layers_shows(view, LAYER_VIEWS)) {
        now.key.views = view_layer_shown(view->views) << 1 | (layers_fill(view) == LAYER_VIEWS);
        now.key.mark = view_layer_marked(view->views);
    }
    if (!over && layers_fill(view) == LAYER_HEAT) now.key.heat = view->heat_choice.stamp + 1;
    if (over && drag_world_query(view)) now.key.drag = view->drag_worlds;
    now.key.frame = at_origin(*frame);
    const bool same = kept->surface && memcmp(&kept->key, &now.key, sizeof now.key) == 0;
    if (!same) {
        kept_picture other = *kept;
        other.key.frame = now.key.frame;
        const bool only_moved =
            kept->surface && memcmp(&other.key, &now.key, sizeof now.key) == 0 &&
            kept->key.frame.width == frame->width && kept->key.frame.height == frame->height;
        const bool wait =
            only_moved && !view->ui->steady && view->motion > 0 && kept->seconds > SLOW_SECONDS;
        other = *kept;
        other.key.version = now.key.version;
        other.key.touched = now.key.touched;
        const bool only_dragged = kept->surface && view->document->live &&
                                  memcmp(&other.key, &now.key, sizeof now.key) == 0;
        const bool mended = only_dragged && mend_picture(view, kept, over, &now.key.frame);
        if (mended || (!wait && remake_picture(view, kept, over, &now.key.frame)))
            memcpy(&kept->key, &now.key, sizeof now.key);
    }
    if (kept->surface) show_picture(view->ui->cairo, kept, frame, view->ui->palette.page, over);
}

// --- the pane

static void draw_empty(view_state *view, sl_box box) {
    ui_state *ui = view->ui;
    const double t = ui->text, gap = fmin(3 * t, 0.08 * box_width(box));
    const double x = box.min.x + gap, wide = box_width(box) - 2 * gap;
    ui_fill(ui, box, ui->palette.ground);
    const double y =
        ui_lines(ui, x, fmax((box.min.y + box.max.y) / 2 - 2 * t, box.min.y + 2.5 * t), wide, 1.6,
                 true, ui->palette.ink, view->document->job ? "Opening ..." : "No map is open");
    ui_lines(ui, x, y, wide, 1, false, ui->palette.faint,
             "Drop a map or a .slv file here, or press O for the maps at hand.");
}

static void draw_name(view_state *view, sl_box box, int index, int count) {
    if (count < 2) return;
    ui_state *ui = view->ui;
    if (index) ui_line(ui, box.min.x, box.min.y, box.min.x, box.max.y, ui->palette.faint);
    size_t methods;
    const size_t method = index ? view->other : view->method;
    const char *name = sl_eye_methods(&methods)[method].name;
    char text[96];
    const seen_method *seen = &view->seen.methods[method];
    char words[64];
    snprintf(words, sizeof words, "%s", name);
    ui_spaces(words);
    snprintf(text, sizeof text, "%s: %u cells", words, view->seen.valid ? seen->count : 0);
    const double t = ui->text, gap = fmin(t, 0.04 * box_width(box));
    const double wide =
        fmin(ui_text_width(ui, 1, true, text) + 1, box_width(box) - 2 * gap - 1.2 * t);
    const double high = ui_lines_height(ui, wide, 1, true, text);
    const sl_box ground = {{box.min.x + gap, box.min.y + 0.8 * t},
                           {box.min.x + gap + wide + 1.2 * t, box.min.y + 1.3 * t + high}};
    if (box_height(ground) > 0.4 * box_height(box)) return; // the panel says it too
    ui_fill_round(ui, ground, 0.3 * t, ui->palette.page);
    ui_lines(ui, ground.min.x + 0.6 * t, ground.min.y + 1.25 * t, wide, 1, true, ui->palette.ink,
             text);
}

/// The cursor that keys move: a cross with a rim, over any ground.
static void draw_cursor(ui_state *ui, sl_box box) {
    const sl_point at = ui->pointer;
    const double arm = 9 * ui_scale(ui), gap = 2.5 * ui_scale(ui);
    ui_mark_focus(ui, box);
    if (!box_has(box, at)) return;
    for (int i = -1; i <= 1; i += 2) {
        cairo_move_to(ui->cairo, at.x + i * gap, at.y);
        cairo_line_to(ui->cairo, at.x + i * arm, at.y);
        cairo_move_to(ui->cairo, at.x, at.y + i * gap);
        cairo_line_to(ui->cairo, at.x, at.y + i * arm);
    }
    tone_cased(ui->cairo, &ui->palette, ui->palette.start, 2 * ui_scale(ui), 0);
}

/// Says that the plan is not that of the map as it is now.
static void draw_late(view_state *view, sl_box box) {
    if (!view_is_late(view)) return;
    ui_state *ui = view->ui;
    const double t = ui->text;
    const char *text = view->document->stale || view->document->job
                           ? "Updating ..."
                           : "The plan does not show the last change.";
    const double half = fmin(ui_text_width(ui, 1, true, text), box_width(box) - 3 * t) / 2;
    const double middle = (box.min.x + box.max.x) / 2, base = box.min.y + 2.1 * t;
    ui_fill_round(ui,
                  (sl_box){{middle - half - 0.6 * t, base - 1.3 * t},
                           {middle + half + 0.6 * t, base + 0.6 * t}},
                  0.3 * t, ui->palette.page);
    sl_text_show_within(ui->cairo, ui->palette.start, middle - half, base, 2 * half, t, true, text);
}

void pane_plan(learn_state *learn, sl_box box, int index, bool vector) {
    view_state *view = learn->view;
    ui_state *ui = view->ui;
    ui_hit(ui, HIT_PLAN, index, box);
    const bool focused = ui_has_focus(ui);
    ui->area = box;
    view->in_the_making =
        view->mode == MODE_LEARN && lesson_subject(&learn->lesson) == &lesson_subdivision;
    if (!view->document->baked || !make_scene(view)) {
        draw_empty(view, box);
        return;
    }
    const sl_frame frame = camera_frame(&view->camera, box, ui_scale(ui));
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(ui->cairo);
    if (vector)
        draw_under(view, ui->cairo, &frame);
    else
        show_kept(view, &view->under, false, &frame);
    modes_draw_below(learn, &frame, index);
    if (vector)
        draw_over(view, ui->cairo, &frame);
    else
        show_kept(view, &view->over, true, &frame);
    drag_world_draw(view, &frame);
    modes_draw_above(learn, &frame);
    if (!index) legend_over_plan(view, &frame, vector);
    const bool panes = view->compare == COMPARE_PANES && view->mode == MODE_EXPLORE;
    draw_name(view, box, index, panes ? 2 : 1);
    if (!vector && focused) draw_cursor(ui, box);
    draw_late(view, box);
    cairo_restore(ui->cairo);
}
