/// The panel of the Plan mode: what is measured, in the units of the plan.
#include "document/drawings.h"
#include "document/files.h"
#include "document/measure.h"
#include "panes/panel.h"
#include "panes/panes.h"
#include "plan/building_way.h"
#include "plan/compare.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// A value stands beside its label, or below it where the panel is narrow.
static void put_row(ui_state *ui, column *c, const char *label, const char *value) {
    const double t = ui->text, wide = ui_text_width(ui, 0.95, false, value) + 0.6 * t;
    const bool beside = ui_text_width(ui, 0.95, false, label) + wide <= column_width(c);
    const double base = c->y + 1.1 * t;
    const double end =
        ui_lines(ui, c->left, base, column_width(c), 0.95, false, ui->palette.ink, label);
    ui_text_right(ui, c->right, beside ? base : end, 0.95, ui->palette.ink, value);
    c->y = end - (beside ? 0.95 : -0.3) * t;
}

// --- the plan

static void draw_plan_words(const view_state *view, column *c) {
    char area[MEASURE_TEXT], text[256];
    if (!view->document->baked) return;
    measure_say(view->document->inside_area, view->document->map.unit, "\xc2\xb2", area);
    if (*view->document->map.unit)
        snprintf(text, sizeof text, "%s inside.", area);
    else
        snprintf(text, sizeof text, "%s inside. The file does not say what lengths are in: %s.",
                 area, drawing_unit_hint(view->document->source.path));
    column_words(view->ui, c, 0.95, view->ui->palette.ink, text);
    c->y += 0.4 * view->ui->text;
}

/// The first note says what was taken; those behind it are doubts.
static void draw_doubts(const view_state *view, column *c) {
    const char *doubt = strchr(view->document->notes, '\n');
    char text[NOTES_TEXT];
    if (!doubt || !view->document->baked) return;
    for (; doubt; doubt = strchr(doubt + 1, '\n')) {
        // The name of the file is known: the folders before it are left out.
        const char *path = view->document->source.path, *from = doubt + 1;
        if (path && strncmp(from, path, strlen(path)) == 0) from += files_base(path) - path;
        const size_t length = strcspn(from, "\n");
        snprintf(text, sizeof text, "%.*s", (int)length, from);
        column_words(view->ui, c, 0.9, view->ui->palette.start, text);
    }
    column_words(view->ui, c, 0.9, view->ui->palette.faint, "Ctrl+I changes how the file is read.");
    c->y += 0.4 * view->ui->text;
}

// --- the isovist

static void draw_isovist(const view_state *view, column *c) {
    char place[PLACE_TEXT], unit[SL_UNIT_TEXT], name[64], text[MEASURE_TEXT];
    size_t count;
    const sl_measure *measures = sl_measures(SL_ISOVIST, &count);
    view_say_place(&view->document->map, view->eye.at, place);
    column_heading(view->ui, c, "Isovist", place);
    if (!view->seen.valid) return;
    const sl_space *space = &view->document->baked->space;
    const uint32_t cell = view_eye_cell(view);
    const bool sees = view->seen.region.count > 2;
    if (cell == SL_NO_CELL || !space->cells[cell].inside)
        column_words(view->ui, c, 0.95, view->ui->palette.start,
                     view_is_solid(view, view->eye.at)
                         ? "The viewpoint is in solid ground and sees "
                           "nothing. Click in a room."
                     : sees ? "The viewpoint is outside. Click in a room to put it inside."
                            : "The viewpoint is outside of the plan and sees nothing of it. Click "
                              "in a room.");
    if (!sees) return;
    const sl_region_measures all = sl_region_measure(&view->seen.region);
    for (size_t i = 0; i < count; i++) {
        const double value = sl_measure_value(&measures[i], &all);
        sl_measure_say_unit(&measures[i], view->document->map.unit, unit);
        snprintf(name, sizeof name, "%s", measures[i].name);
        ui_spaces(name);
        if (isnan(value))
            snprintf(text, sizeof text, "not defined");
        else
            snprintf(text, sizeof text, "%.4g%s%s", value, *unit ? " " : "", unit);
        put_row(view->ui, c, name, text);
    }
}

// --- the path

/// Of a building: the whole way, and the links that it takes.
static void draw_building_way(const view_state *view, column *c) {
    const struct building_way *way = building_way_shown(view);
    char text[MEASURE_TEXT];
    if (!way || way->clicks < 2 || !way->made) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink,
                     !way || !way->clicks ? "Click where the way begins, on any storey."
                     : way->clicks == 1 ? "Click where it ends. Ctrl+Shift+B shows another storey."
                     : way->task        ? "Looking for the way ..."
                                        : "The way was not found. A click begins another one.");
        return;
    }
    if (!way->route.found) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink,
                     "No way leads there: walls, shut doors or missing links are between.");
        return;
    }
    measure_say(way->route.length, view->document->map.unit, "", text);
    put_row(view->ui, c, "length", text);
    for (size_t i = 0; i < way->route.link_count; i++) {
        const sl_storey_link *link = &way->building.links[way->route.links[i]];
        measure_say(link->length, view->document->map.unit, "", text);
        put_row(view->ui, c, link->name, text);
    }
    column_words(view->ui, c, 0.9, view->ui->palette.faint,
                 "Doors are as the files have them. Ctrl+Shift+B shows the way on another storey.");
}

static void draw_route(const view_state *view, column *c) {
    const route_layer *layer = view->route;
    char text[MEASURE_TEXT];
    column_heading(view->ui, c, "Path", NULL);
    if (*view->building) {
        draw_building_way(view, c);
        return;
    }
    if (!layer || !layer->clicks) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink, "Click where the way begins.");
        return;
    }
    if (layer->clicks == 1) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink, "Click where it ends.");
        return;
    }
    if (layer->tight) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink,
                     "An end of the way has no room for this radius.");
        return;
    }
    if (!layer->route.found) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink,
                     "No way leads there. The ring marks the nearest place that can be reached.");
        return;
    }
    measure_say(layer->route.length, view->document->map.unit, "", text);
    put_row(view->ui, c, "length", text);
    measure_say(hypot(layer->to.x - layer->from.x, layer->to.y - layer->from.y),
                view->document->map.unit, "", text);
    put_row(view->ui, c, "straight line", text);
    snprintf(text, sizeof text, "%zu", layer->route.count - 2);
    put_row(view->ui, c, "turns at corners", text);
    if (sl_map_limited_walls(&view->document->map))
        column_words(view->ui, c, 0.9, view->ui->palette.faint,
                     "Some walls stop only sight or only steps. This way goes by sight; "
                     "'sightline path' goes by steps.");
}

// --- from a line

static void draw_from_line(const view_state *view, column *c) {
    static const char *const labels[] = {"seen from some point", "seen from all points"};
    const from_line *layer = from_line_seen(view);
    char text[MEASURE_TEXT], name[64];
    column_heading(view->ui, c, "From a line", NULL);
    if (!view->from_line || !view->from_line->drawn) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink,
                     "Drag a line in the plan. Some of its points see the light area; all of them "
                     "see the dark one.");
        return;
    }
    const sl_point *ends = view->from_line->ends;
    measure_say(hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y), view->document->map.unit, "",
                text);
    put_row(view->ui, c, "length of the line", text);
    for (int i = 0; layer && i < 2; i++) {
        measure_say(layer->seen[i].area, view->document->map.unit, "\xc2\xb2", text);
        put_row(view->ui, c, labels[i], text);
        snprintf(name, sizeof name, "%s, share", i ? "from all" : "from some");
        sl_text_percent(view->document->area > 0 ? layer->seen[i].area / view->document->area : 0,
                        text);
        put_row(view->ui, c, name, text);
    }
    if (layer && layer->seen[SL_SEEN_FROM_ALL].walled)
        column_words(view->ui, c, 0.9, view->ui->palette.faint,
                     "A wall crosses the line, so no place is seen from all of it.");
}

// --- axial lines and segments

static void list_measure(const view_state *view, column *c, const sl_measure *measure, int number,
                         bool chosen, double value) {
    char name[64], text[SCALE_TEXT] = "";
    snprintf(name, sizeof name, "%s", measure->name);
    ui_spaces(name);
    if (!isnan(value)) value_scale_say(value, text);
    ui_hit_focus(view->ui, HIT_MEASURE, number, column_row(view->ui, c, NULL, name, text, chosen));
}

/// The measures, with those of the chosen line.
static void draw_lines(const view_state *view, column *c) {
    const line_map *map = line_map_shown(view);
    const bool segments = view->tool == TOOL_SEGMENTS;
    size_t count;
    column_heading(view->ui, c, segments ? "Segments" : "Axial lines",
                   map && map->chosen < map->count ? "chosen" : NULL);
    const sl_measure *measures = sl_measures(segments ? SL_SEGMENTS : SL_AXIAL, &count);
    for (size_t k = 0; k < count; k++)
        list_measure(view, c, &measures[k], (int)k, k == view->line_measure[segments],
                     map && map->chosen < map->count ? line_map_value(map, k, map->chosen) : NAN);
    if (map && map->part_count > 1)
        column_words(view->ui, c, 0.9, view->ui->palette.faint,
                     "The colours are those of the largest part, or of the one that you click. "
                     "Lines that are not joined to it are grey.");
}

// --- rooms

bool column_name(const view_state *view, column *c) {
    ui_state *ui = view->ui;
    const sl_box box = {{c->left, c->y + 0.3 * ui->text}, {c->right, c->y + 2.1 * ui->text}};
    if (ui->field != &view->name || ui_types_value(ui)) return false;
    ui_text_field(ui, box, ui->field, "a name", true);
    ui_hit(ui, HIT_FIELD, 1, box);
    c->y = box.max.y + 0.3 * ui->text;
    return true;
}

/// The name of the chosen room, or what is typed in its place.
static void draw_room_name(const view_state *view, column *c) {
    static const char *const zone[] = {"room_name", "room_delete", NULL};
    static const char *const room[] = {"room_name", NULL};
    const room_map *map = room_map_shown(view);
    if (view->table.chosen >= room_map_rows(map)) return;
    if (column_name(view, c)) return;
    column_buttons(view->ui, c, room_map_is_zone(map, view->table.chosen) ? zone : room);
}

static void draw_rooms(const view_state *view, column *c) {
    const room_map *map = room_map_shown(view);
    char text[MEASURE_TEXT + SL_COUNT_TEXT + 4], share[SL_COUNT_TEXT];
    column_heading(view->ui, c, "Rooms", map ? "area, seen" : NULL);
    if (!map) {
        column_words(view->ui, c, 0.95, view->ui->palette.ink, "Looking for the rooms ...");
        return;
    }
    if (!room_map_rows(map))
        column_words(view->ui, c, 0.95, view->ui->palette.ink,
                     "No room is found: Ctrl+I sets what is inside.");
    for (size_t i = 0; i < room_map_rows(map); i++) {
        const double area = room_map_area(map, i);
        char size[MEASURE_TEXT];
        measure_say(area, view->document->map.unit, "\xc2\xb2", size);
        sl_text_percent(area > 0 ? map->seen[i] / area : 0, share);
        snprintf(text, sizeof text, "%s, %s", size, share);
        ui_hit_focus(
            view->ui, HIT_ROW, (int)i,
            column_row(view->ui, c, NULL, room_map_name(map, i), text, view->table.chosen == i));
    }
    draw_room_name(view, c);
    if (map->rooms.width > 0) {
        measure_say(map->rooms.width, view->document->map.unit, "", text);
        char words[2 * MEASURE_TEXT + 64];
        snprintf(words, sizeof words, "Openings up to %s count as doors.", text);
        column_words(view->ui, c, 0.9, view->ui->palette.faint, words);
    }
}

// --- another plan

static void put_walls(const view_state *view, column *c, const char *label,
                      const wall_list *walls) {
    char text[MEASURE_TEXT];
    measure_say(wall_change_length(walls), view->document->map.unit, "", text);
    put_row(view->ui, c, label, text);
}

static void draw_compare(const view_state *view, column *c) {
    const plan_compare *other = compare_shown(view);
    const char *path = view->compared ? view->compared->source.path : NULL;
    char text[MEASURE_TEXT];
    static const char *const buttons[] = {"plan_other", NULL};
    column_heading(view->ui, c, "Compare", path ? files_base(path) : NULL);
    column_buttons(view->ui, c, buttons);
    if (!other)
        column_words(view->ui, c, 0.95, view->ui->palette.ink,
                     path ? "Reading the other plan ..." : "Choose the other plan.");
    if (other) {
        measure_say(view->document->inside_area, view->document->map.unit, "\xc2\xb2", text);
        put_row(view->ui, c, "inside this plan", text);
        measure_say(other->area, view->document->map.unit, "\xc2\xb2", text);
        put_row(view->ui, c, "inside the other plan", text);
        if (other->job.made) {
            put_walls(view, c, "walls of the other alone", &other->added);
            put_walls(view, c, "walls of this one alone", &other->removed);
        }
        column_words(view->ui, c, 0.9, view->ui->palette.faint,
                     "1 colours what each place gains (red) or loses (blue) in the other plan.");
    }
}

void pane_measures(learn_state *learn, sl_box box) {
    view_state *view = learn->view;
    column c = column_begin(learn->ui, box);
    static const char *const tools[] = {"plan_isovist",  "plan_line", "plan_graph", "plan_axial",
                                        "plan_segments", "plan_path", "plan_rooms", "plan_compare",
                                        "table",         "cameras",   NULL};
    static const char *const lines[] = {"heat_back", "heat_next", "heat_ranks", "plan_drawn", NULL};
    static void (*const panels[TOOLS])(const view_state *view, column *c) = {
        [TOOL_ISOVIST] = draw_isovist, [TOOL_FROM_LINE] = draw_from_line,
        [TOOL_PATH] = draw_route,      [TOOL_AXIAL] = draw_lines,
        [TOOL_SEGMENTS] = draw_lines,  [TOOL_COMPARE] = draw_compare,
        [TOOL_ROOMS] = draw_rooms};
    static const char *const heat[] = {"heat_back", "heat_next", "heat_ranks", "heat_hold", NULL};
    static const char *const changes[] = {"heat_back", "heat_next", "heat_hold", NULL};
    column_heading(learn->ui, &c, "Plan", view->document->map.unit);
    draw_plan_words(view, &c);
    draw_doubts(view, &c);
    column_buttons(learn->ui, &c, tools);
    if (view->document->baked) {
        // What presses or slides comes before what grows.
        if (layers_shows(view, LAYER_HEAT))
            column_buttons(learn->ui, &c, heat_layer_changes(view) ? changes : heat);
        if (line_map_choice(view)) column_buttons(learn->ui, &c, lines);
        c.y += 0.3 * learn->ui->text;
        column_sliders(learn->ui, &c);
        // The values of a heat map are in sight before the many of the isovist.
        const bool first = !(view->tool == TOOL_ISOVIST && layers_shows(view, LAYER_HEAT));
        if (first) panels[view->tool](view, &c);
        pane_words(view, &c);
        column_legend(view, &c);
        if (!first) panels[view->tool](view, &c);
    }
    column_layers(view, &c);
    column_end(learn->ui, &c);
}
