/// The turn of a frame: results are taken, and what follows is made anew.
#include "app/turn.h"

#include "app/layout.h"
#include "dialogs/map_file.h"
#include "dialogs/opening.h"
#include "dialogs/recovery.h"
#include "document/drawings.h"
#include "lessons/quiz.h"
#include "plan/building_way.h"
#include "plan/cameras.h"
#include "plan/compare.h"
#include "plan/drag_world.h"
#include "plan/effects.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"
#include "plan/table.h"
#include "plan/view_cells.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// A frame of a drag takes this long, where its space does not come sooner.
#define DRAG_FRAME_SECONDS 0.014
/// It waits at least this long: small maps are never late.
#define DRAG_WAIT_SECONDS 0.003

static sl_view eye_view(const app_state *app) {
    const sl_box b = app->document.baked->space.bounds;
    const double reach = hypot(b.max.x - b.min.x, b.max.y - b.min.y);
    return app->view.eye.fov >= 360
               ? sl_view_all_round(app->view.eye.at)
               : sl_view_cone(app->view.eye.at, app->view.eye.heading, app->view.eye.fov, reach);
}

/// Drops what was made of the document before its last change.
static void drop_made(app_state *app) {
    view_drop_scenes(&app->view);
    app->view.seen.valid = false;
}

void app_say_document(app_state *app) {
    if (!app->document.baked) return;
    const sl_space *space = &app->document.baked->space;
    char name[TITLE_TEXT], calls[CALLS_TEXT], partial[SL_PARTIAL_TEXT];
    map_file_name(&app->desk, name);
    effects_in_words(&app->document.map, calls);
    sl_baked_say_partial(app->document.baked, partial);
    char inside[SL_INSIDE_TEXT + 2] = "";
    if (*app->document.inside) snprintf(inside, sizeof inside, "; %s", app->document.inside);
    if (partial[0])
        ui_say(&app->ui, false, "%s is %s", name, partial);
    else if (app->view.mode == MODE_PLAN)
        ui_say(&app->ui, false, "%s: %u wall%s%s%s", name, space->wall_count,
               space->wall_count == 1 ? "" : "s", inside,
               *inside                ? ""
               : *app->document.notes ? "; Ctrl+J: what was read"
                                      : "");
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

static bool eye_is_inside(const app_state *app) {
    const uint32_t cell = view_eye_cell(&app->view);
    return cell != SL_NO_CELL && app->document.baked->space.cells[cell].inside;
}

/// A map that is read in another scale has all places elsewhere. One that is read otherwise may
/// have another inside: an eye that is outside then goes into it.
static void follow_reading(app_state *app, bool opened) {
    if (!app->document.baked) return;
    const double before = app->view.source_scale;
    const bool read = app->view.source_read != app->document.read;
    app->view.source_scale = app->document.map.source.transform.scale;
    app->view.source_read = app->document.read;
    if (opened) return;
    if (before != app->view.source_scale)
        app->view.fitted = true;
    else if (!read || eye_is_inside(app))
        return;
    walk_home(&app->view);
}

/// A map that was opened starts from its own start. After a change by hand the eye stays.
static void take_document(app_state *app, bool opened) {
    drop_made(app);
    quiz_forget(&app->learn);
    const bool was_mesh = app->view.mesh;
    if (app->document.baked) app->view.mesh = app->document.baked->space.neighbour != NULL;
    if (!opened && app->document.baked && app->view.mesh != was_mesh)
        say_subdivision(app, was_mesh);
    follow_reading(app, opened);
    if (!opened || !app->document.baked) return;
    app->view.edit.chosen = UINT32_MAX;
    app->view.fitted = true;
    app->view.drag = (drag_state){0};
    app->document.stale = false;
    history_clear(app->context, &app->document.history);
    app->recorder.records = app->recorder.plays = false;
    app->recorder.frames.count = 0;
    cameras_clear(&app->view);
    if (!building_way_shown(&app->view)) route_clear(&app->view);
    from_line_clear(&app->view);
    compare_clear(&app->view);
    if (app->view.mode == MODE_EXPLORE && drawing_is(app->document.source.path))
        view_set_mode(&app->view, MODE_PLAN);
    walk_home(&app->view);
    map_file_taken(&app->desk);
    app_say_document(app);
    files_ask_once(&app->desk);
}

void app_take_opened(app_state *app) {
    take_document(app, true);
}

/// Follows the document and the eye; drops words about what was seen before.
static void follow_document(app_state *app) {
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
        if (status == SL_OK && again) app_say_document(app);
    }
    follow_document(app);
    if (*opening)
        map_file_check(&app->desk, opening, status);
    else
        view_check(&app->view, status);
}

static void poll_all(app_state *app, bool wait) {
    do {
        view_check(&app->view, document_keep_up(app->context, &app->document));
        if (!wait) wait_for_drag(app);
        take_results(app, wait);
        drag_world_update(&app->view, wait); // it may have a bake begin
    } while (wait && (app->document.stale || app->document.job));
    view_check(&app->view, document_keep_up(app->context, &app->document));
    view_layer_update(&app->view, wait);
    compare_update(&app->view, wait);
    heat_layer_update(&app->view, wait);
    cameras_update(&app->view, wait);
    building_way_update(&app->view, wait);
    route_update(&app->view);
    from_line_update(&app->view, wait);
    line_map_update(&app->view, wait);
    room_map_update(&app->view, wait);
    table_update(&app->view);
    app->desk.file.cameras = cameras_unsaved(&app->view);
    map_file_tick(&app->desk, wait);
    recovery_tick(&app->desk);
}

job_progress app_progress(const app_state *app) {
    const job_progress document = document_progress(&app->document);
    if (document.running) return document;
    const job_progress file = map_file_progress(&app->desk),
                       pictures = export_progress(app->exports.job);
    if (file.running) return file;
    if (pictures.running) return pictures;
    const job_progress views = view_layer_progress(app->view.views);
    if (views.running) return views;
    const job_progress cameras = cameras_progress(app->view.cameras);
    if (cameras.running) return cameras;
    const job_progress line =
        app->view.from_line ? tool_job_progress(&app->view.from_line->job) : (job_progress){0};
    if (line.running) return line;
    const job_progress way = building_way_progress(&app->view);
    if (way.running) return way;
    const job_progress other = compare_progress(&app->view);
    if (other.running) return other;
    const job_progress rooms = room_map_progress(&app->view);
    if (rooms.running) return rooms;
    const job_progress lines = line_map_progress(&app->view);
    return lines.running ? lines : heat_layer_progress(app->view.heat);
}

static void look_again(app_state *app) {
    if (!app->document.baked) return;
    follow_document(app);
    app->view.seen.patient = app->ui.steady;
    const sl_view view = eye_view(app);
    sl_query *dragged = drag_world_query(&app->view);
    view_check(&app->view, dragged ? seen_update_region(app->context, &app->view.seen,
                                                        &app->document, dragged, &view)
                                   : seen_update(app->context, &app->view.seen, &app->document,
                                                 &app->view.present, &view));
    room_map_follow(&app->view);
    if (app->view.mode == MODE_LEARN)
        view_check(&app->view, lesson_update(app->context, &app->learn.lesson, &app->document,
                                             view_eye_cell(&app->view)));
    quiz_follow_lesson(&app->learn);
}

void app_settle(app_state *app) {
    app_place(app);
    poll_all(app, true);
    look_again(app);
}

#define STALE_SECONDS 20

/// After a while the line says again what is open. Errors stay.
static void tidy_message(app_state *app) {
    const ui_state *ui = &app->ui;
    if (app->ui.steady || ui->message_is_error || !*ui->message) return;
    if (ui->message_seconds < STALE_SECONDS || app_progress(app).running) return;
    app_say_document(app);
}

static void put_eye(app_state *app, const record_frame *frame) {
    app->view.eye.at = frame->at;
    app->view.eye.heading = frame->heading;
}

void app_tick(app_state *app, double seconds) {
    app_place(app);
    poll_all(app, app->ui.steady);
    ui_tick(&app->ui, seconds);
    tidy_message(app);
    app->view.motion = fmax(app->view.motion - seconds, 0);
    record_frame frame;
    if (dialog_open_now(&app->desk.dialog) != DIALOG_NONE) app->view.held = 0;
    if (record_play(&app->recorder, seconds, &frame)) {
        put_eye(app, &frame);
    } else {
        walk_tick(&app->view, fmin(seconds, 0.1));
    }
    view_check(&app->view, record_tick(app->context, &app->recorder, seconds,
                                       (record_frame){app->view.eye.at, app->view.eye.heading}));
    if (app->document.baked) lesson_tick(&app->learn.lesson, &app->document, seconds);
    if (export_move(&app->exports, &frame)) put_eye(app, &frame);
    look_again(app);
    export_take(&app->exports);
}
