/// Actions of the Plan mode and of the Cameras mode: tools, measures of the heat map, cameras.
#include "app/action_parts.h"

#include "app/sliders.h"
#include "dialogs/browser.h"
#include "dialogs/map_file.h"
#include "dialogs/storeys.h"
#include "plan/cameras.h"
#include "plan/compare.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/layers.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"
#include "plan/table.h"

#include <stdio.h>
#include <string.h>

// --- tools of the Plan mode

static void choose_tool(app_state *app, plan_tool tool, const char *hint) {
    app->view.tool = tool;
    line_map_try_again(&app->view);
    ui_say(&app->ui, false, "%s", hint);
}

#define TOOL(name, value, hint)                                                                    \
    DO(name, choose_tool(app, value, hint))                                                        \
    IS(name, app->view.tool == (value))
TOOL(plan_isovist, TOOL_ISOVIST, "click where the viewpoint is to stand")
TOOL(plan_line, TOOL_FROM_LINE, "drag a line: what is seen from it, and what from all of it")
TOOL(plan_path, TOOL_PATH, "click where the way begins, then where it ends")

TOOL(plan_axial, TOOL_AXIAL, "the fewest lines of sight that cover the plan; 2 the next measure")
TOOL(plan_segments, TOOL_SEGMENTS, "axial lines, cut where they cross; 2 the next measure")
DO(plan_drawn, line_map_toggle_drawn(&app->view))
IS(plan_drawn, app->view.drawn_lines)

// --- rooms

TOOL(plan_rooms, TOOL_ROOMS, "click a room, or drag a zone; Ctrl+K names what is chosen")

/// Has letters typed into the field of the panel.
static void type_name(app_state *app, const char *name) {
    app->ui.side_panel = true;
    field_set(&app->view.name, name);
    app->view.name.chosen = true;
    app->ui.field = &app->view.name;
    app->ui.number = NULL;
}

DO(value_type, slider_type(app, -1))

/// Where none is chosen, it is the room of the viewpoint.
static void room_name_typed(app_state *app) {
    const room_map *map = room_map_shown(&app->view);
    const size_t *chosen = &app->view.table.chosen;
    if (map) table_update(&app->view);
    if (map && *chosen >= room_map_rows(map))
        table_choose(&app->view, room_map_at(map, app->view.eye.at));
    if (map && *chosen < room_map_rows(map))
        type_name(app, room_map_name(map, *chosen));
    else
        ui_say(&app->ui, false, "%s",
               map && room_map_rows(map)               ? "click a room first"
               : map                                   ? "there is no room in this plan"
               : room_map_progress(&app->view).running ? "the rooms are still being found"
                                                       : "Ctrl+8 shows the rooms first");
}

static void camera_name_typed(app_state *app) {
    char name[CAMERA_NAME];
    if (!camera_chosen(&app->view)) {
        ui_say(&app->ui, false, "choose a camera first: click on it");
        return;
    }
    camera_name(app->view.cameras, app->view.cameras->chosen, name);
    type_name(app, name);
}

DO(room_delete, room_map_delete(&app->view, app->view.table.chosen))

bool plan_field_key(app_state *app, const char *key) {
    const bool done = strcmp(key, "Return") == 0;
    if (app->ui.field != &app->view.name || (!done && strcmp(key, "Escape") != 0)) return false;
    if (done && ui_types_value(&app->ui)) {
        if (slider_typed(app)) app->ui.field = NULL;
        return true;
    }
    app->ui.field = NULL;
    if (done && app->view.mode == MODE_CAMERAS)
        camera_rename(&app->view, app->view.name.text);
    else if (done)
        room_map_rename(&app->view, app->view.table.chosen, app->view.name.text);
    return true;
}

// --- another plan

static void compare_with(desk_state *desk, const char *path) {
    wish_for(desk, WISH_COMPARE, path);
}

/// Of a building one storey is compared.
static void take_other(desk_state *desk, const char *path, bool ask) {
    (void)ask;
    if (storeys_is(path))
        map_file_check(desk, path, storeys_compare(desk, path, compare_with));
    else
        compare_with(desk, path);
}

static void choose_other(app_state *app) {
    app->view.tool = TOOL_COMPARE;
    browser_open(&app->desk, BROWSE_PLANS, take_other);
}

/// The first time it asks for the other plan.
static void plan_compared(app_state *app) {
    if (app->view.compared)
        choose_tool(app, TOOL_COMPARE,
                    "1 shows what each place gains and loses, 2 the next measure");
    else if (app->document.baked)
        choose_other(app);
}

IS(plan_compared, app->view.tool == TOOL_COMPARE)

// --- the table

DO(table, app->ui.table = !app->ui.table)
IS(table, app->ui.table)
DO(table_left, table_shift(&app->view, -1))
DO(table_right, table_shift(&app->view, 1))
DO(table_next, table_step(&app->view, 1))
DO(table_back, table_step(&app->view, -1))

static void export_values(desk_state *desk, const char *path) {
    wish_for(desk, WISH_WRITE_VALUES, path);
}

static void table_export(app_state *app) {
    char name[TITLE_TEXT], ending[32];
    const table_source *of = table_source_now(&app->view);
    if (!of) {
        ui_say(&app->ui, false, "this tool has no table yet");
        return;
    }
    snprintf(ending, sizeof ending, "-%ss.csv", of->noun);
    map_file_name_output(&app->desk, ending, name);
    browser_save(&app->desk, BROWSE_VALUES, name, export_values);
}

/// A tool that paints the plan itself gives way to it.
static void plan_graph(app_state *app) {
    const bool hidden = tool_paints(app->view.tool);
    if (hidden) app->view.tool = TOOL_ISOVIST;
    if (!hidden || !(app->view.show & SHOW_HEAT)) layers_toggle(&app->view, LAYER_HEAT);
}

IS(plan_graph, (app->view.show & SHOW_HEAT) != 0 && !tool_paints(app->view.tool))

bool plan_escape(app_state *app) {
    view_state *view = &app->view;
    const char *said = NULL;
    if (view->mode != MODE_PLAN) return false;
    if (compare_stop(view))
        said = "stopped comparing";
    else if (line_map_stop(view) || room_map_stop(view))
        said = "stopped; choose the tool once more to begin anew";
    else if (view->tool == TOOL_PATH && route_clear(view))
        said = "the way is gone";
    else if (view->tool == TOOL_FROM_LINE && from_line_clear(view))
        said = "the line is gone";
    if (said) ui_say(&app->ui, false, "%s", said);
    return said != NULL;
}

// --- the heat map

/// Of the tool at hand.
static void choose_measure(app_state *app, int by) {
    if (line_map_choice(&app->view))
        line_map_choose(&app->view, by);
    else
        heat_choose(&app->view, by);
}

DO(heat_next, choose_measure(app, 1))
DO(heat_back, choose_measure(app, -1))
DO(heat_steps, heat_toggle_steps(&app->view))

static bool is_heat_steps(const app_state *app) {
    return !heat_measure_part(heat_measure(app->view.heat_choice.measure));
}

DO(heat_ranks, heat_toggle_ranks(&app->view))
IS(heat_ranks, app->view.heat_choice.ranks)
DO(heat_hold, heat_toggle_held(&app->view))
IS(heat_hold, app->view.heat_choice.held)

static void heat_step_by(app_state *app, int by) {
    heat_turn_step(&app->view, by);
    ui_say(&app->ui, false, "heat map: %.3g from point to point", heat_step(&app->view));
}

DO(heat_coarser, heat_step_by(app, -1))
DO(heat_finer, heat_step_by(app, 1))

// --- cameras

DO(camera_left, camera_turn(&app->view, 5))
DO(camera_right, camera_turn(&app->view, -5))
DO(camera_narrower, camera_widen(&app->view, -5))
DO(camera_wider, camera_widen(&app->view, 5))
DO(camera_nearer, camera_reach(&app->view, 1 / 1.1))
DO(camera_farther, camera_reach(&app->view, 1.1))
DO(camera_copied, camera_copy(&app->view))
DO(camera_deleted, camera_delete(&app->view))
DO(camera_next, camera_choose(&app->view, 1))
DO(camera_back, camera_choose(&app->view, -1))
DO(camera_spot, camera_go_to_spot(&app->view, app->view.cameras ? app->view.cameras->spot : 0))
DO(camera_find, cameras_find(&app->view, SEARCH_FEWEST))
DO(camera_more, cameras_find(&app->view, SEARCH_MORE))
DO(camera_one, cameras_find(&app->view, SEARCH_ONE))

static bool searches(const app_state *app, camera_search kind) {
    const camera_layer *layer = app->view.cameras;
    return cameras_progress(layer).running && cameras_search(layer) == kind;
}

static bool is_camera_find(const app_state *app) {
    return searches(app, SEARCH_FEWEST);
}

static bool is_camera_more(const app_state *app) {
    return searches(app, SEARCH_MORE);
}

static bool is_camera_one(const app_state *app) {
    return searches(app, SEARCH_ONE);
}

static void import_table(desk_state *desk, const char *path, bool ask) {
    (void)ask;
    wish_for(desk, WISH_READ_TABLE, path);
}

static void export_table(desk_state *desk, const char *path) {
    wish_for(desk, WISH_WRITE_TABLE, path);
}

DO(camera_import, browser_open(&app->desk, BROWSE_TABLES, import_table))
DO(camera_export, browser_save(&app->desk, BROWSE_TABLES, "cameras.csv", export_table))

static const action_row rows[] = {
    {"plan_isovist", "Ctrl+1", "Isovist", "plan: a click puts the viewpoint", PLAN, 0, plan_isovist,
     is_plan_isovist},
    {"plan_graph", "Ctrl+2", "Visibility graph", "plan: the heat map of the visibility graph", PLAN,
     0, plan_graph, is_plan_graph},
    {"plan_path", "Ctrl+3", "Path", "plan: two clicks, and the shortest way between them", PLAN, 0,
     plan_path, is_plan_path},
    {"plan_line", "Ctrl+4", "From a line", "plan: drag a line, and what is seen from it", PLAN, 0,
     plan_line, is_plan_line},
    {"plan_axial", "Ctrl+5", "Axial", "plan: axial lines, by a measure", PLAN, 0, plan_axial,
     is_plan_axial},
    {"plan_segments", "Ctrl+6", "Segments", "plan: axial lines cut into segments, by a measure",
     PLAN, 0, plan_segments, is_plan_segments},
    {"plan_drawn", NULL, "Drawn lines", "plan: axial lines and segments are those of the drawing",
     PLAN, 0, plan_drawn, is_plan_drawn},
    {"plan_compare", "Ctrl+7", "Compare", "plan: another plan over this one, and what changes",
     PLAN, 0, plan_compared, is_plan_compared},
    {"plan_other", NULL, "Other plan", "plan: choose the plan to compare with", PLAN, 0,
     choose_other, NULL},
    {"plan_rooms", "Ctrl+8", "Rooms", "plan: the rooms, with their names; drag a zone", PLAN, 0,
     plan_rooms, is_plan_rooms},
    {"room_name", "Ctrl+K", "Name", "rooms: name the chosen room or zone", PLAN, 0, room_name_typed,
     NULL},
    {"room_delete", "Delete", "Delete", "rooms: delete the chosen zone", PLAN, 0, room_delete,
     NULL},
    {"table", "Ctrl+L", "Table", "plan: the table of what the tool has computed", PLAN, 0, table,
     is_table},
    {"table_left", "Ctrl+Home", "\xe2\x97\x80", "table: columns to the left", PLAN, 0, table_left,
     NULL},
    {"table_right", "Ctrl+End", "\xe2\x96\xb6", "table: columns to the right", PLAN, 0, table_right,
     NULL},
    {"table_next", "Ctrl+PageDown", NULL, "table: the next row", PLAN, 0, table_next, NULL},
    {"table_back", "Ctrl+PageUp", NULL, "table: the row before", PLAN, 0, table_back, NULL},
    {"table_export", "Ctrl+Shift+E", "Export", "table: write it as CSV", PLAN, 0, table_export,
     NULL},
    {"value_type", "Ctrl+Shift+K", NULL,
     "type the value of a slider: a field of view, a range, a grid step; again: the next one", 0, 0,
     value_type, NULL},
    {"heat_next", "2", "Next measure", "heat map: the next measure", NOT_LEARN, 0, heat_next, NULL},
    {"heat_back", "3", "Back", "heat map: the measure before", NOT_LEARN, 0, heat_back, NULL},
    {"heat_coarser", "4", "Coarser", "heat map: a coarser grid", NOT_LEARN, 0, heat_coarser, NULL},
    {"heat_finer", "5", "Finer", "heat map: a finer grid", NOT_LEARN, 0, heat_finer, NULL},
    {"heat_steps", "6", "Steps", "heat map: steps from the pointer, live", NOT_LEARN, 0, heat_steps,
     is_heat_steps},
    {"heat_hold", "7", "Keep colours", "heat map: keep the colour scale, to compare", NOT_LEARN, 0,
     heat_hold, is_heat_hold},
    {"heat_ranks", NULL, "Equal shares", "heat map: as many points in each colour", NOT_LEARN, 0,
     heat_ranks, is_heat_ranks},
    {"camera_find", "Space", "Find the fewest",
     "cameras: the fewest like the chosen one that see everything, in place of all", CAMERAS, 0,
     camera_find, is_camera_find},
    {"camera_more", "Shift+Space", "Add fewest",
     "cameras: keep all, and add the fewest for the rest", CAMERAS, 0, camera_more, is_camera_more},
    {"camera_one", "Ctrl+Space", "Add one",
     "cameras: keep all, and add the one that sees most of the rest", CAMERAS, 0, camera_one,
     is_camera_one},
    {"camera_left", "Left", NULL, "cameras: turn the chosen one left", CAMERAS, 0, camera_left,
     NULL},
    {"camera_right", "Right", NULL, "cameras: turn it right", CAMERAS, 0, camera_right, NULL},
    {"camera_narrower", ",", NULL, "cameras: narrower field of view", CAMERAS, 0, camera_narrower,
     NULL},
    {"camera_wider", ".", NULL, "cameras: wider field of view", CAMERAS, 0, camera_wider, NULL},
    {"camera_nearer", "-", NULL, "cameras: shorter range", CAMERAS, 0, camera_nearer, NULL},
    {"camera_farther", "=", NULL, "cameras: longer range", CAMERAS, 0, camera_farther, NULL},
    {"camera_copy", "Ctrl+C", "Copy", "cameras: copy the chosen one", CAMERAS, 0, camera_copied,
     NULL},
    {"camera_delete", "Delete", "Delete", "cameras: delete it", CAMERAS, 0, camera_deleted, NULL},
    {"camera_name", "Ctrl+K", "Name", "cameras: name the chosen one", CAMERAS, 0, camera_name_typed,
     NULL},
    {"camera_next", "Down", "Next", "cameras: choose the next one", CAMERAS, 0, camera_next, NULL},
    {"camera_back", "Up", "Back", "cameras: choose the one before", CAMERAS, 0, camera_back, NULL},
    {"camera_spot", "B", "Next blind spot", "cameras: go to the next blind spot", CAMERAS, 0,
     camera_spot, NULL},
    {"camera_import", "Ctrl+Shift+O", "Import",
     "cameras: read a table (name,x,y,heading,fov,range,height,tilt)", CAMERAS, 0, camera_import,
     NULL},
    {"camera_export", "Ctrl+Shift+E", "Export", "cameras: write the table", CAMERAS, 0,
     camera_export, NULL},
};

action_part actions_plan(void) {
    return (action_part){rows, sizeof rows / sizeof *rows};
}
