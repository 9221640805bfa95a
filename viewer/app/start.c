/// How the state of the viewer starts and ends.
#include "app/start.h"

#include "app/frame.h"
#include "dialogs/browser.h"
#include "dialogs/import_dialog.h"
#include "dialogs/map_file.h"
#include "dialogs/question.h"
#include "plan/building_way.h"
#include "plan/cameras.h"
#include "plan/compare.h"
#include "plan/drag_world.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"
#include "plan/table.h"
#include "plan/view_cells.h"

static const dialog_row dialogs[DIALOG_KINDS] = {
    [DIALOG_MENU] = {menu_draw, menu_act, NULL, NULL, NULL, 0},
    [DIALOG_BROWSER] = {browser_draw, browser_act, browser_edited, browser_key, browser_destroy, 0},
    [DIALOG_IMPORT] = {import_draw, import_act, import_edited, import_key, import_destroy,
                       IMPORT_TYPES_INTO},
    [DIALOG_QUESTION] = {question_draw, question_act, NULL, question_key, NULL, 0},
};

void app_init(app_state *app, sl_context *context) {
    size_t count;
    sl_eye_methods(&count);
    *app = (app_state){
        .context = context,
        .document = {.mirror_depth = 1},
        .view = {.context = context,
                 .ui = &app->ui,
                 .document = &app->document,
                 .building = &app->desk.file.building,
                 .edit = {.chosen = UINT32_MAX},
                 .fitted = true,
                 .eye = {.fov = 90},
                 .other_cone = 360,
                 .show =
                     SHOW_CELLS | SHOW_PORTALS | SHOW_CULL | SHOW_REGION | SHOW_STARTS | SHOW_NAMES,
                 .filled = {[LAYER_CULL] = 1},
                 .last_filled = 1,
                 .split_depth = 6,
                 .tree_depth = 64,
                 .line_measure = {sl_measure_find(SL_AXIAL, "integration_hh"),
                                  sl_measure_find(SL_SEGMENTS, "t1024_choice")},
                 .table = {.chosen = SIZE_MAX},
                 .world_walls = 2000,
                 .method = count - 1},
        .learn = {.context = context,
                  .ui = &app->ui,
                  .document = &app->document,
                  .view = &app->view,
                  .quiz = {.random = 1}},
        .desk = {.context = context,
                 .ui = &app->ui,
                 .document = &app->document,
                 .dialog = {.desk = &app->desk, .ui = &app->ui, .rows = dialogs}},
        .exports = {.context = context,
                    .ui = &app->ui,
                    .recorder = &app->recorder,
                    .user = app,
                    .draw_window = frame_draw},
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

void app_destroy(app_state *app) {
    // All jobs are told before any of them is waited for.
    document_stop_soon(&app->document);
    export_stop(&app->exports);
    view_layer_stop(&app->view);
    heat_layer_stop(&app->view);
    cameras_stop(&app->view);
    view_drop_scenes(&app->view);
    if (app->view.under.surface) cairo_surface_destroy(app->view.under.surface);
    if (app->view.over.surface) cairo_surface_destroy(app->view.over.surface);
    sl_free(app->context, app->view.under.items.items);
    sl_free(app->context, app->view.over.items.items);
    if (app->view.account.surface) cairo_surface_destroy(app->view.account.surface);
    node_layer_destroy(app->context, app->view.nodes);
    view_layer_destroy(app->context, app->view.views);
    heat_layer_destroy(app->context, app->view.heat);
    watch_layer_destroy(app->context, app->view.watch);
    camera_layer_destroy(app->context, app->view.cameras);
    building_way_clear(&app->view);
    route_layer_destroy(app->context, app->view.route);
    from_line_destroy(app->context, app->view.from_line);
    compare_clear(&app->view);
    room_map_destroy(app->context, app->view.rooms);
    table_destroy(app->context, &app->view.table);
    for (int i = 0; i < 2; i++) line_map_destroy(app->context, app->view.lines[i]);
    drag_world_drop(&app->view);
    seen_destroy(app->context, &app->view.seen);
    present_drop(app->context, &app->view.present);
    lesson_destroy(app->context, &app->learn.lesson);
    map_file_destroy(&app->desk);
    dialog_destroy(&app->desk.dialog);
    history_clear(app->context, &app->document.history);
    record_destroy(app->context, &app->recorder);
    sl_free(app->context, app->view.edit.ends.items);
    sl_explanation_destroy(app->context, &app->learn.quiz.explanation);
    document_close(app->context, &app->document);
}
