/// The turn of a frame: results are taken, what follows is made anew, the page is drawn.
#include "app/app.h"

#include "app/actions.h"
#include "app/sliders.h"
#include "document/document.h"
#include "document/files.h"
#include "document/recovery.h"
#include "lessons/quiz.h"
#include "panes/modes.h"
#include "panes/panes.h"
#include "plan/effects.h"
#include "plan/heat.h"
#include "plan/view.h"
#include "plan/view_cells.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// A frame of a drag takes this long, where its space does not come sooner.
#define DRAG_FRAME_SECONDS 0.014
/// It waits at least this long: small maps are never late.
#define DRAG_WAIT_SECONDS 0.003

void app_init(app_state *app, sl_context *context) {
    size_t count;
    sl_eye_methods(&count);
    *app = (app_state){
        .context = context,
        .document = {.mirror_depth = 1},
        .view = {.context = context,
                 .ui = &app->ui,
                 .document = &app->document,
                 .edit = {.chosen = UINT32_MAX},
                 .fitted = true,
                 .eye = {.fov = 90},
                 .show =
                     SHOW_CELLS | SHOW_PORTALS | SHOW_CULL | SHOW_REGION | SHOW_STARTS | SHOW_NAMES,
                 .filled = {[LAYER_CULL] = 1},
                 .last_filled = 1,
                 .split_depth = 6,
                 .tree_depth = 64,
                 .method = count - 1},
        .learn = {.context = context,
                  .ui = &app->ui,
                  .document = &app->document,
                  .view = &app->view,
                  .quiz = {.random = 1}},
        .ui = {.pointer = {-1, -1},
               .bar_rows = 1,
               .time_lines = 1,
               .scrolling = -1,
               .legend = true,
               .side_panel = true,
               .effects = true,
               .text_scale = 1,
               .density = 1,
               .width = 1200,
               .height = 760,
               .window_width = 1200,
               .window_height = 760},
    };
}

static void drop_scenes(app_state *app) {
    sl_scene_destroy(app->context, app->view.scene);
    sl_scene_destroy(app->context, app->view.tree);
    app->view.scene = app->view.tree = NULL;
}

void app_destroy(app_state *app) {
    // All jobs are told before any of them is waited for.
    document_stop_soon(&app->document);
    export_stop(app);
    view_layer_stop(&app->view);
    heat_layer_stop(&app->view);
    drop_scenes(app);
    if (app->view.under.surface) cairo_surface_destroy(app->view.under.surface);
    if (app->view.over.surface) cairo_surface_destroy(app->view.over.surface);
    sl_free(app->context, app->view.under.items.items);
    sl_free(app->context, app->view.over.items.items);
    if (app->view.account.surface) cairo_surface_destroy(app->view.account.surface);
    node_layer_destroy(app->context, app->view.nodes);
    view_layer_destroy(app->context, app->view.views);
    heat_layer_destroy(app->context, app->view.heat);
    watch_layer_destroy(app->context, app->view.watch);
    seen_destroy(app->context, &app->view.seen);
    present_drop(app->context, &app->view.present);
    lesson_destroy(app->context, &app->learn.lesson);
    map_file_destroy(app);
    dialog_destroy(app);
    history_clear(app->context, &app->document.history);
    record_destroy(app->context, &app->recorder);
    sl_free(app->context, app->view.edit.ends.items);
    sl_explanation_destroy(app->context, &app->learn.quiz.explanation);
    document_close(app->context, &app->document);
}

static sl_view eye_view(const app_state *app) {
    const sl_box b = app->document.baked->space.bounds;
    const double reach = hypot(b.max.x - b.min.x, b.max.y - b.min.y);
    return app->view.eye.fov >= 360
               ? sl_view_all_round(app->view.eye.at)
               : sl_view_cone(app->view.eye.at, app->view.eye.heading, app->view.eye.fov, reach);
}

/// Drops what was made of the document before its last change.
static void drop_made(app_state *app) {
    drop_scenes(app);
    app->view.seen.valid = false;
}

/// Says what was read.
static void say_document(app_state *app) {
    const sl_space *space = &app->document.baked->space;
    char name[TITLE_TEXT], calls[CALLS_TEXT], partial[SL_PARTIAL_TEXT];
    map_file_name(app, name);
    effects_in_words(&app->document.map, calls);
    sl_baked_say_partial(app->document.baked, partial);
    char inside[SL_INSIDE_TEXT + 2] = "";
    if (*app->document.inside) snprintf(inside, sizeof inside, "; %s", app->document.inside);
    if (partial[0])
        ui_say(&app->ui, false, "%s is %s", name, partial);
    else
        ui_say(&app->ui, false, "%s: %u cells, %u portals, %u walls%s%s%s", name, space->cell_count,
               space->portal_count, space->wall_count, *calls ? "; " : "", calls,
               *inside                ? inside
               : *app->document.notes ? "; Ctrl+J: what was read"
                                      : "");
}

/// A wall may change how the whole map is cut into cells. That is said, as all cells are others.
static void say_subdivision(app_state *app, bool was_mesh) {
    const bool mesh = app->document.baked->space.neighbour != NULL;
    if (mesh && !was_mesh)
        ui_say(&app->ui, false,
               "A wall is oblique now: the cells are those of a mesh, no longer of a kd-tree");
    if (!mesh && was_mesh)
        ui_say(&app->ui, false,
               "All walls are axial now: the cells are those of a kd-tree, no longer of a mesh");
}

/// A map that was opened starts from its own start. After a change by hand the eye stays.
static void take_document(app_state *app, bool opened) {
    drop_made(app);
    quiz_forget(&app->learn);
    const bool was_mesh = app->view.mesh;
    if (app->document.baked) app->view.mesh = app->document.baked->space.neighbour != NULL;
    if (!opened && app->document.baked && app->view.mesh != was_mesh)
        say_subdivision(app, was_mesh);
    if (!opened || !app->document.baked) return;
    app->view.edit.chosen = UINT32_MAX;
    app->view.fitted = true;
    app->view.drag = (drag_state){0};
    app->document.stale = false;
    history_clear(app->context, &app->document.history);
    app->recorder.records = app->recorder.plays = false;
    app->recorder.frames.count = 0;
    walk_home(&app->view);
    map_file_taken(app);
    say_document(app);
}

void app_take_opened(app_state *app) {
    take_document(app, true);
}

/// Follows the document and the eye; drops words about what was seen before.
static void follow(app_state *app) {
    const quiz_state *quiz = &app->learn.quiz;
    view_follow(&app->view);
    if (quiz->answered && quiz->version != app->view.present.version) quiz_forget(&app->learn);
}

/// A frame of a drag waits for its space if that comes soon. So the plan is mostly not late at all,
/// and else by one frame.
static void wait_for_drag(const app_state *app) {
    const double spare = DRAG_FRAME_SECONDS - app->view.draw_seconds;
    if (app->view.drag.changed && document_awaits_space(&app->document))
        document_wait_space(&app->document, fmax(spare, DRAG_WAIT_SECONDS));
}

/// Takes over what the background has made.
static void take_results(app_state *app, bool wait) {
    const uint32_t before = app->document.opened, version = app->document.version;
    const uint32_t read = app->document.read;
    char opening[PATH_TEXT] = "";
    const char *file = document_opening(&app->document);
    if (file) snprintf(opening, sizeof opening, "%s", file);
    bool changed = false;
    const sl_status status = wait ? document_wait(app->context, &app->document, &changed)
                                  : document_poll(app->context, &app->document, &changed);
    if (status == SL_CANCELLED) ui_say(&app->ui, false, "stopped");
    if (changed) drop_made(app);
    if (read != app->document.read) app->view.drag = (drag_state){0}; // of another map
    if (version != app->document.version) {
        take_document(app, before != app->document.opened);
        // What was said before was of the map before.
        const bool again = before == app->document.opened && *opening;
        if (status == SL_OK && again && app->document.baked) say_document(app);
    }
    follow(app);
    if (*opening)
        files_check(app, opening, status);
    else
        view_check(&app->view, status);
}

/// The view knows where the plans are on the page.
static window_layout place_plans(app_state *app) {
    const window_layout l = app_layout(app);
    memcpy(app->view.plan, l.plan, sizeof l.plan);
    app->view.plan_count = l.plan_count;
    return l;
}

static void poll(app_state *app, bool wait) {
    do {
        view_check(&app->view, document_keep_up(app->context, &app->document));
        if (!wait) wait_for_drag(app);
        take_results(app, wait);
    } while (wait && app->document.stale);
    view_check(&app->view, document_keep_up(app->context, &app->document));
    view_layer_update(&app->view, wait);
    heat_layer_update(&app->view, wait);
    map_file_tick(app, wait);
    recovery_tick(app);
}

job_progress app_progress(const app_state *app) {
    const job_progress document = document_progress(&app->document);
    if (document.running) return document;
    const job_progress file = map_file_progress(app), pictures = export_progress(app->exports);
    if (file.running) return file;
    if (pictures.running) return pictures;
    const job_progress views = view_layer_progress(app->view.views);
    return views.running ? views : heat_layer_progress(app->view.heat);
}

static void look(app_state *app) {
    if (!app->document.baked) return;
    follow(app);
    app->view.seen.patient = app->ui.steady;
    const sl_view view = eye_view(app);
    view_check(&app->view, seen_update(app->context, &app->view.seen, &app->document,
                                       &app->view.present, &view));
    if (app->view.mode == MODE_LEARN)
        view_check(&app->view, lesson_update(app->context, &app->learn.lesson, &app->document,
                                             view_eye_cell(&app->view)));
    quiz_follow_lesson(&app->learn);
}

void app_settle(app_state *app) {
    place_plans(app);
    poll(app, true);
    look(app);
}

#define STALE_SECONDS 20

/// After a while the line says again what is open. Errors stay.
static void tidy_message(app_state *app) {
    const ui_state *ui = &app->ui;
    if (app->ui.steady || ui->message_is_error || !*ui->message) return;
    if (ui->message_seconds < STALE_SECONDS || app_progress(app).running) return;
    if (app->document.baked) say_document(app);
}

void app_tick(app_state *app, double seconds) {
    place_plans(app);
    poll(app, app->ui.steady);
    ui_tick(&app->ui, seconds);
    tidy_message(app);
    app->view.motion = fmax(app->view.motion - seconds, 0);
    record_frame frame;
    if (record_play(&app->recorder, seconds, &frame)) {
        app->view.eye.at = frame.at;
        app->view.eye.heading = frame.heading;
    } else {
        walk_tick(&app->view, fmin(seconds, 0.1));
    }
    view_check(&app->view, record_tick(app->context, &app->recorder, seconds,
                                       (record_frame){app->view.eye.at, app->view.eye.heading}));
    if (app->document.baked) lesson_tick(&app->learn.lesson, &app->document, seconds);
    export_move(app);
    look(app);
    export_take(app);
}

// --- the frame

static sl_box box(double left, double top, double right, double bottom) {
    return (sl_box){{left, top}, {fmax(right, left + 1), fmax(bottom, top + 1)}};
}

static double side_width(const app_state *app) {
    const ui_state *ui = &app->ui;
    const double t = ui_text_size(ui), chosen = ui->edges[EDGE_SIDE];
    if (!ui_has_panel(&app->ui)) return 0;
    return fmin(fmax(chosen > 0 ? chosen : 26, 8) * t, 0.55 * ui->width);
}

static void place_below(const app_state *app, window_layout *l, double right, double *bottom) {
    int shown = 0, before = 0;
    const double t = ui_text_size(&app->ui), chosen = app->ui.edges[EDGE_BELOW];
    const double room = *bottom - l->bar.max.y;
    double high = 0;
    for (int i = 0; i < PANES_BELOW; i++) {
        const pane_below *pane = &panes_below()[i];
        if (!pane->shown(&app->learn)) continue;
        high = fmax(high, pane->lines ? fmin(1.4 * t * pane->lines(&app->learn), 0.42 * room)
                                      : 0.42 * room);
        shown++;
    }
    if (!shown) return;
    if (chosen > 0) high = fmin(fmax(chosen, 0.1), 0.8) * room;
    const double top = round(*bottom - high);
    for (int i = 0; i < PANES_BELOW; i++) {
        if (!panes_below()[i].shown(&app->learn)) continue;
        const double left = right * before / shown;
        l->below[i] = box(left, top, right * ++before / shown, *bottom);
    }
    *bottom = top;
}

window_layout app_layout(const app_state *app) {
    const double t = ui_text_size(&app->ui), w = app->ui.width, h = app->ui.height;
    window_layout l = {.plan_count = 1};
    const double bar = (0.3 + 2 * app->ui.bar_rows) * t, status = 1.9 * t;
    l.bar = box(0, 0, w, bar);
    l.status = box(0, h - status, w, h);
    double bottom = h - status;
    if (pane_time_shown(&app->learn)) {
        l.time = box(0, fmax(bottom - pane_time_height(&app->learn), bar + 0.3 * (bottom - bar)), w,
                     bottom);
        bottom = l.time.min.y;
    }
    const double right = round(w - side_width(app));
    l.side = box(right, bar, w, bottom);
    place_below(app, &l, right, &bottom);
    l.plan[0] = box(0, bar, right, bottom);
    if (app->view.compare == COMPARE_PANES && app->view.mode == MODE_EXPLORE) {
        l.plan_count = 2;
        l.plan[0].max.x = floor(right / 2);
        l.plan[1] = box(l.plan[0].max.x, bar, right, bottom);
    }
    return l;
}

void app_drag_edge(app_state *app, int edge, double by) {
    const window_layout l = app_layout(app);
    if (edge == EDGE_SIDE) {
        app->ui.edges[edge] = fmax(side_width(app) + by, 1) / ui_text_size(&app->ui);
        return;
    }
    double high = 0, bottom = l.plan[0].max.y;
    for (int i = 0; i < PANES_BELOW; i++) high = fmax(high, box_height(l.below[i]));
    const double room = bottom + high - l.bar.max.y;
    app->ui.edges[edge] = fmin(fmax((high + by) / room, 0.1), 0.8);
}

/// The borders that can be dragged: over all panes, as they are narrow.
static void draw_edges(app_state *app, const window_layout *l) {
    ui_state *ui = &app->ui;
    const double wide = fmax(0.35 * ui->text, 4);
    if (side_width(app) > 0)
        ui_edge(ui, EDGE_SIDE,
                (sl_box){{l->side.min.x - wide / 2, l->side.min.y},
                         {l->side.min.x + wide / 2, l->side.max.y}});
    for (int i = 0; i < PANES_BELOW; i++)
        if (box_width(l->below[i]) > 0) {
            ui_edge(ui, EDGE_BELOW,
                    (sl_box){{0, l->below[i].min.y - wide / 2},
                             {l->side.min.x, l->below[i].min.y + wide / 2}});
            break;
        }
}

void app_fit(app_state *app, sl_box plan) {
    if (app->view.fitted && app->document.baked)
        app->view.camera =
            camera_fit(app->document.baked->space.bounds, box_width(plan), box_height(plan));
}

/// On a projector pale tones vanish.
static sl_palette palette_of(const ui_state *ui) {
    sl_palette p = sl_palette_make(ui->dark);
    if (!ui->presents) return p;
    p.faint = sl_colour_mix(p.faint, p.ink, 0.6);
    p.outline = sl_colour_mix(p.outline, p.ink, 0.4);
    for (int i = 0; i < SL_TONES; i++) p.floor[i] = sl_colour_mix(p.floor[i], p.floor[0], 0.7);
    return p;
}

void app_draw(app_state *app, cairo_t *cairo) {
    const double before = sl_seconds();
    app->ui.cairo = cairo;
    app->ui.palette = palette_of(&app->ui);
    app->ui.text = ui_text_size(&app->ui);
    app->ui.over = ui_find(&app->ui, app->ui.pointer);
    ui_begin(&app->ui);
    actions_show(app);
    pane_bar_measure(&app->learn);
    pane_time_measure(&app->learn);
    const window_layout l = place_plans(app);
    app_fit(app, l.plan[0]);
    heat_layer_follow(&app->view);
    pane_dual_hover(&app->learn, l.below[PANE_DUAL]);
    for (int i = 0; i < l.plan_count; i++) pane_plan(&app->learn, l.plan[i], i, false);
    for (int i = 0; i < PANES_BELOW; i++)
        if (box_width(l.below[i]) > 0) panes_below()[i].draw(&app->learn, l.below[i]);
    sliders_show(app);
    if (side_width(app) > 0) mode_table()[app->view.mode].panel(&app->learn, l.side);
    draw_edges(app, &l);
    if (box_width(l.time) > 0) pane_time(&app->learn, l.time);
    pane_bar(&app->learn, l.bar);
    const job_progress work = app_progress(app);
    pane_status(&app->learn, l.status, &work,
                app->recorder.records ? "recording"
                : app->recorder.plays ? "playing"
                                      : "");
    if (app->ui.help) pane_help(&app->ui);
    dialog_draw(app);
    if (app->view.drag.kind == DRAG_NONE) pane_tip(&app->ui);
    app->view.draw_seconds = 0.8 * app->view.draw_seconds + 0.2 * (sl_seconds() - before);
}
