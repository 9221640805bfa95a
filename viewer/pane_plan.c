/// The plan: what is kept from frame to frame, and over it what changes.
#include "panes.h"

#include "clock.h"
#include "draw/lesson.h"
#include "modes.h"
#include "sightline/canvas.h"

#include <math.h>
#include <string.h>

/// A picture that takes longer than this to draw is moved as it is while the plan moves.
#define SLOW_SECONDS 0.007

// --- scenes

static unsigned scene_layers(const sl_app *app) {
    return SL_LAYER_WALLS | (app->show & SL_SHOW_CELLS ? SL_LAYER_CELLS : 0u) |
           (app->show & SL_SHOW_PORTALS ? SL_LAYER_PORTALS : 0u) |
           (app->show & SL_SHOW_STARTS ? SL_LAYER_STARTS : 0u);
}

static bool make_scene(sl_app *app) {
    const unsigned layers = scene_layers(app);
    const uint32_t key = layers | (app->dark ? 1024u : 0u);
    if (app->scene && app->scene_version == app->document.version && app->scene_show == key)
        return true;
    sl_scene_free(app->context, app->scene);
    app->scene = NULL;
    sl_draw_options options = sl_draw_options_default();
    options.layers = layers;
    options.cell = SL_NO_CELL;
    options.dark = app->dark;
    const sl_status status =
        sl_scene_create(app->context, app->document.baked, &options, NULL, &app->scene);
    sl_app_check(app, status);
    app->scene_version = app->document.version;
    app->scene_show = key;
    return status == SL_OK;
}

// --- pictures that are kept

/// What is below all that changes: cells, portals, view cells, splits.
static void draw_under(sl_app *app, cairo_t *cairo, const sl_frame *frame) {
    const unsigned layers = scene_layers(app) & ~(unsigned)(SL_LAYER_WALLS | SL_LAYER_STARTS);
    sl_set_colour(cairo, app->ui.palette.page);
    cairo_paint(cairo);
    sl_app_check(app, sl_draw_plan(app->context, cairo, app->scene, layers, frame));
    if (sl_layers_shows(app, SL_LAYER_NUMBER_VIEWS)) sl_view_layer_draw(app, cairo, frame);
    if (app->show & SL_SHOW_SPLITS)
        sl_draw_splits(cairo, &app->ui.palette, frame, app->document.splits,
                       app->document.baked->space.node_count, app->split_depth);
}

/// What is over it: walls and what else the map has.
static void draw_over(sl_app *app, cairo_t *cairo, const sl_frame *frame) {
    sl_app_check(app, sl_draw_walls(app->context, cairo, app->scene, frame));
}

/// A pane's frame with its upper left at the origin.
static sl_frame at_origin(sl_frame frame) {
    frame.left = frame.top = 0;
    return frame;
}

static bool remake(sl_app *app, sl_kept *kept, bool over, const sl_frame *local) {
    const int width = (int)ceil(local->width), height = (int)ceil(local->height);
    const double before = sl_clock_seconds();
    if (!kept->surface || cairo_image_surface_get_width(kept->surface) != width ||
        cairo_image_surface_get_height(kept->surface) != height) {
        if (kept->surface) cairo_surface_destroy(kept->surface);
        kept->surface = cairo_image_surface_create(over ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24,
                                                   width, height);
    }
    cairo_t *cairo = cairo_create(kept->surface);
    if (over) {
        cairo_set_operator(cairo, CAIRO_OPERATOR_CLEAR);
        cairo_paint(cairo);
        cairo_set_operator(cairo, CAIRO_OPERATOR_OVER);
        draw_over(app, cairo, local);
    } else {
        draw_under(app, cairo, local);
    }
    const bool good = cairo_status(cairo) == CAIRO_STATUS_SUCCESS;
    cairo_destroy(cairo);
    kept->seconds = sl_clock_seconds() - before;
    return good;
}

/// Puts the picture where the frame is now; one of another frame is moved and scaled to it.
static void blit(cairo_t *cairo, const sl_kept *kept, const sl_frame *frame, sl_colour page,
                 bool over) {
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

static void show_kept(sl_app *app, sl_kept *kept, bool over, const sl_frame *frame) {
    sl_kept now;
    memset(&now.key, 0, sizeof now.key);
    now.key.version = app->document.version;
    now.key.touched = over ? app->document.touched : 0;
    now.key.show = scene_layers(app) | (app->show & SL_SHOW_SPLITS && !over ? 2048u : 0u);
    now.key.depth = app->show & SL_SHOW_SPLITS && !over ? app->split_depth : 0;
    now.key.dark = app->dark;
    if (!over && sl_layers_shows(app, SL_LAYER_NUMBER_VIEWS)) {
        now.key.views = sl_view_layer_shown(app->views);
        now.key.mark = sl_view_layer_marked(app->views);
    }
    now.key.frame = at_origin(*frame);
    const bool same = kept->surface && memcmp(&kept->key, &now.key, sizeof now.key) == 0;
    if (!same) {
        sl_kept other = *kept;
        other.key.frame = now.key.frame;
        const bool only_moved =
            kept->surface && memcmp(&other.key, &now.key, sizeof now.key) == 0 &&
            kept->key.frame.width == frame->width && kept->key.frame.height == frame->height;
        const bool wait = only_moved && app->motion > 0 && kept->seconds > SLOW_SECONDS;
        if (!wait && remake(app, kept, over, &now.key.frame))
            memcpy(&kept->key, &now.key, sizeof now.key);
    }
    if (kept->surface) blit(app->ui.cairo, kept, frame, app->ui.palette.page, over);
}

// --- the pane

static void draw_empty(sl_app *app, sl_box box) {
    sl_ui *ui = &app->ui;
    sl_ui_fill(ui, box, ui->palette.ground);
    const double x = box.min.x + 3 * ui->text, y = (box.min.y + box.max.y) / 2;
    sl_ui_text(ui, x, y, 1.6, true, ui->palette.ink,
               app->document.job ? "Opening ..." : "No map is open");
    sl_ui_text(ui, x, y + 2 * ui->text, 1, false, ui->palette.faint,
               "Drop a map or a .slv file here, or press O for the maps at hand.");
}

static void draw_name(sl_app *app, sl_box box, int index, int count) {
    if (count < 2) return;
    sl_ui *ui = &app->ui;
    size_t methods;
    const size_t method = index ? app->other : app->method;
    const char *name = sl_eye_methods(&methods)[method].name;
    char text[96];
    const sl_seen_method *seen = &app->seen.methods[method];
    char words[64];
    snprintf(words, sizeof words, "%s", name);
    for (char *at = words; *at; at++)
        if (*at == '_') *at = ' ';
    snprintf(text, sizeof text, "%s: %u cells", words, app->seen.valid ? seen->count : 0);
    const double width = sl_ui_text_width(ui, 1, true, text);
    const sl_box ground = {{box.min.x + ui->text, box.min.y + 0.8 * ui->text},
                           {box.min.x + 2.2 * ui->text + width, box.min.y + 2.7 * ui->text}};
    sl_ui_fill_round(ui, ground, 0.3 * ui->text, ui->palette.page);
    sl_ui_text(ui, ground.min.x + 0.6 * ui->text, ground.max.y - 0.6 * ui->text, 1, true,
               ui->palette.ink, text);
    if (index) sl_ui_line(ui, box.min.x, box.min.y, box.min.x, box.max.y, ui->palette.faint);
}

void sl_pane_plan(sl_app *app, sl_box box, int index, bool vector) {
    cairo_t *cairo = app->ui.cairo;
    sl_ui_hit(&app->ui, SL_HIT_PLAN, index, box);
    if (!app->document.baked || !make_scene(app)) {
        draw_empty(app, box);
        return;
    }
    const sl_frame frame = sl_camera_frame(&app->camera, box, sl_app_scale(app));
    cairo_save(cairo);
    cairo_rectangle(cairo, box.min.x, box.min.y, sl_box_width(box), sl_box_height(box));
    cairo_clip(cairo);
    if (vector)
        draw_under(app, cairo, &frame);
    else
        show_kept(app, &app->under, false, &frame);
    sl_modes_draw_below(app, &frame, index);
    if (vector)
        draw_over(app, cairo, &frame);
    else
        show_kept(app, &app->over, true, &frame);
    sl_modes_draw_above(app, &frame);
    if (!index) sl_layers_draw_keys(app, &frame);
    const bool panes = app->compare == SL_COMPARE_PANES && app->mode == SL_MODE_EXPLORE;
    draw_name(app, box, index, panes ? 2 : 1);
    cairo_restore(cairo);
}
