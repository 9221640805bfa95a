#include "app.h"

#include "bake_job.h"
#include "effect_words.h"
#include "modes.h"
#include "panes.h"
#include "quiz.h"
#include "shelf.h"
#include "sightline/support.h"
#include "walk.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

void sl_app_init(sl_app *app, sl_context *context) {
    size_t count;
    sl_eye_methods(&count);
    *app = (sl_app){.context = context,
                    .eye = {.fov = 90},
                    .show = SL_SHOW_CELLS | SL_SHOW_PORTALS | SL_SHOW_CULL | SL_SHOW_REGION |
                            SL_SHOW_STARTS,
                    .document = {.mirror_depth = 1},
                    .split_depth = 6,
                    .tree_depth = 64,
                    .method = count - 1,
                    .other = 0,
                    .side_panel = true,
                    .effects = true,
                    .text_scale = 1,
                    .density = 1,
                    .width = 1200,
                    .height = 760,
                    .wall = UINT32_MAX,
                    .fitted = true,
                    .pointer = {-1, -1},
                    .quiz = {.random = 1}};
}

static void drop_scenes(sl_app *app) {
    sl_scene_free(app->context, app->scene);
    sl_scene_free(app->context, app->tree);
    app->scene = app->tree = NULL;
}

void sl_app_destroy(sl_app *app) {
    drop_scenes(app);
    if (app->under.surface) cairo_surface_destroy(app->under.surface);
    if (app->over.surface) cairo_surface_destroy(app->over.surface);
    if (app->account.surface) cairo_surface_destroy(app->account.surface);
    sl_node_layer_destroy(app->context, app->nodes);
    sl_view_layer_destroy(app->context, app->views);
    sl_watch_layer_destroy(app->context, app->watch);
    sl_seen_destroy(app->context, &app->seen);
    sl_present_drop(app->context, &app->present);
    sl_lesson_destroy(app->context, &app->lesson);
    sl_history_clear(app->context, &app->history);
    sl_record_destroy(app->context, &app->recorder);
    sl_explanation_destroy(app->context, &app->quiz.explanation);
    sl_document_close(app->context, &app->document);
    sl_shelf_empty(app);
}

void sl_app_say(sl_app *app, bool error, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(app->message, sizeof app->message, format, arguments);
    va_end(arguments);
    app->message_is_error = error;
}

void sl_app_check(sl_app *app, sl_status status) {
    if (status != SL_OK && status != SL_CANCELLED)
        sl_app_say(app, true, "%s", sl_context_message(app->context));
}

uint32_t sl_app_eye_cell(const sl_app *app) {
    return app->document.baked ? sl_space_locate(&app->document.baked->space, app->eye.at)
                               : SL_NO_CELL;
}

static sl_view eye_view(const sl_app *app) {
    const sl_box b = app->document.baked->space.bounds;
    const double reach = hypot(b.max.x - b.min.x, b.max.y - b.min.y);
    return app->eye.fov >= 360 ? sl_view_all_round(app->eye.at)
                               : sl_view_cone(app->eye.at, app->eye.heading, app->eye.fov, reach);
}

/// What was made of the document before its last change.
static void drop_made(sl_app *app) {
    drop_scenes(app);
    app->seen.valid = false;
}

/// A map that was opened starts from its own start; one that was edited keeps the eye.
static void take_document(sl_app *app, bool opened) {
    drop_made(app);
    app->wall = UINT32_MAX;
    sl_quiz_forget(app);
    if (!opened || !app->document.baked) return;
    app->fitted = true;
    app->drag = (sl_drag){0};
    app->stale = false;
    sl_history_clear(app->context, &app->history);
    app->recorder.records = app->recorder.plays = false;
    app->recorder.frames.count = 0;
    sl_walk_home(app);
    const char *path = app->document.source.path;
    const char *slash = path ? strrchr(path, '/') : NULL;
    const char *map = app->document.source.options.map;
    const sl_space *space = &app->document.baked->space;
    char calls[SL_CALLS_TEXT];
    sl_effects_in_words(&app->document.map, calls);
    sl_app_say(app, false, "%s%s%s: %u cells, %u portals, %u walls; %s",
               slash  ? slash + 1
               : path ? path
                      : "map",
               map ? " " : "", map ? map : "", space->cell_count, space->portal_count,
               space->wall_count, calls);
    char partial[SL_PARTIAL_TEXT];
    sl_baked_say_partial(app->document.baked, partial);
    if (partial[0]) sl_app_say(app, false, "%s is %s", slash ? slash + 1 : path, partial);
}

void sl_app_take_opened(sl_app *app) {
    take_document(app, true);
}

/// What the eye sees of the document now; words about what it was are dropped.
static void follow(sl_app *app) {
    const uint32_t before = app->present.version;
    sl_app_check(app, sl_present_update(app->context, &app->present, &app->document, app->eye.at));
    if (app->present.version != before && app->quiz.answered) sl_quiz_forget(app);
}

/// While something is dragged the map is made anew as soon as the last one has its cells: one
/// that was begun at each step would never get that far.
static void keep_up(sl_app *app) {
    if (!app->stale || (app->document.job && !app->document.job->taken)) return;
    sl_app_after_edit(app);
}

static void poll(sl_app *app, bool wait) {
    keep_up(app);
    const uint32_t before = app->document.opened, version = app->document.version;
    bool changed = false;
    const sl_status status = wait ? sl_document_wait(app->context, &app->document, &changed)
                                  : sl_document_poll(app->context, &app->document, &changed);
    if (status == SL_CANCELLED) sl_app_say(app, false, "stopped");
    if (changed) drop_made(app);
    if (version != app->document.version) take_document(app, before != app->document.opened);
    follow(app);
    sl_app_check(app, status);
    sl_view_layer_update(app, wait);
}

sl_document_progress sl_app_progress(const sl_app *app) {
    const sl_document_progress document = sl_document_progress_of(&app->document);
    return document.running ? document : sl_view_layer_progress(app->views);
}

static void look(sl_app *app) {
    if (!app->document.baked) return;
    follow(app);
    app->seen.patient = app->steady;
    const sl_view view = eye_view(app);
    sl_app_check(app,
                 sl_seen_update(app->context, &app->seen, &app->document, &app->present, &view));
    if (app->mode == SL_MODE_LEARN)
        sl_app_check(app, sl_lesson_update(app->context, &app->lesson, &app->document,
                                           sl_app_eye_cell(app)));
}

void sl_app_settle(sl_app *app) {
    poll(app, true);
    look(app);
}

void sl_app_tick(sl_app *app, double seconds) {
    poll(app, app->steady);
    app->motion = fmax(app->motion - seconds, 0);
    sl_record_frame frame;
    if (sl_record_play(&app->recorder, seconds, &frame)) {
        app->eye.at = frame.at;
        app->eye.heading = frame.heading;
    } else {
        sl_walk(app, fmin(seconds, 0.1));
    }
    sl_app_check(app, sl_record_tick(app->context, &app->recorder, seconds,
                                     (sl_record_frame){app->eye.at, app->eye.heading}));
    if (app->document.baked) sl_lesson_tick(&app->lesson, &app->document, seconds);
    look(app);
}

void sl_app_keep(sl_app *app) {
    sl_app_check(app, sl_history_keep(app->context, &app->history, &app->document.map));
}

void sl_app_after_touch(sl_app *app) {
    sl_document_touch(&app->document);
    follow(app);
}

void sl_app_before_edit(sl_app *app) {
    app->fitted = false; // the plan stays where it is, whatever the map becomes
    sl_app_keep(app);
    sl_map_drop_cells(app->context, &app->document.map); // the file's own do not know other walls
}

void sl_app_after_edit(sl_app *app) {
    app->stale = false;
    sl_app_check(app, sl_document_rebuild(app->context, &app->document));
}

// --- the frame

static sl_box box(double left, double top, double right, double bottom) {
    return (sl_box){{left, top}, {fmax(right, left + 1), fmax(bottom, top + 1)}};
}

sl_layout sl_app_layout(const sl_app *app) {
    const double t = sl_app_text(app), w = app->width, h = app->height;
    sl_layout l = {.plan_count = 1};
    const double bar = 2.3 * t, status = 1.9 * t;
    const double side = app->side_panel ? fmin(26 * t, 0.5 * w) : 0;
    l.bar = box(0, 0, w, bar);
    l.status = box(0, h - status, w, h);
    l.side = box(w - side, bar, w, h - status);
    const double right = w - side;
    double bottom = h - status;
    if (app->mode == SL_MODE_LEARN) {
        l.time = box(0, bottom - 4.7 * t, right, bottom);
        bottom = l.time.min.y;
    }
    int shown = 0, before = 0;
    const double share = 0.42 * (bottom - bar);
    double high = 0;
    for (int i = 0; i < SL_PANES_BELOW; i++) {
        const sl_pane_below *pane = &sl_panes_below()[i];
        if (!pane->shown(app)) continue;
        high = fmax(high, pane->lines ? fmin(1.4 * t * pane->lines(app), share) : share);
        shown++;
    }
    if (shown) {
        const double top = bottom - high;
        for (int i = 0; i < SL_PANES_BELOW; i++) {
            if (!sl_panes_below()[i].shown(app)) continue;
            const double left = right * before / shown;
            l.below[i] = box(left, top, right * ++before / shown, bottom);
        }
        bottom = top;
    }
    l.plan[0] = box(0, bar, right, bottom);
    if (app->compare == SL_COMPARE_PANES && app->mode == SL_MODE_EXPLORE) {
        l.plan_count = 2;
        l.plan[0].max.x = floor(right / 2);
        l.plan[1] = box(l.plan[0].max.x, bar, right, bottom);
    }
    return l;
}

void sl_app_fit(sl_app *app, sl_box plan) {
    if (app->fitted && app->document.baked)
        app->camera = sl_camera_fit(app->document.baked->space.bounds, sl_box_width(plan),
                                    sl_box_height(plan));
}

void sl_app_draw(sl_app *app, cairo_t *cairo) {
    const sl_layout l = sl_app_layout(app);
    app->ui.cairo = cairo;
    app->ui.palette = sl_palette_make(app->dark);
    app->ui.text = sl_app_text(app);
    app->ui.pointer = app->pointer;
    app->ui.hit_count = 0;
    sl_app_fit(app, l.plan[0]);
    for (int i = 0; i < l.plan_count; i++) sl_pane_plan(app, l.plan[i], i, false);
    for (int i = 0; i < SL_PANES_BELOW; i++)
        if (sl_box_width(l.below[i]) > 0) sl_panes_below()[i].draw(app, l.below[i]);
    if (sl_box_width(l.time) > 0) sl_pane_time(app, l.time);
    if (app->side_panel) sl_mode_rows()[app->mode].panel(app, l.side);
    sl_pane_bar(app, l.bar);
    sl_pane_status(app, l.status);
    if (app->maps_open) sl_pane_maps(app);
    if (app->help) sl_pane_help(app);
}
