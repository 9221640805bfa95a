/// What each tool adds to a sheet, in the colours of paper.
#include "app/sheet_parts.h"

#include "document/measure.h"
#include "plan/building_way.h"
#include "plan/cameras.h"
#include "plan/compare.h"
#include "plan/from_line.h"
#include "plan/room_map.h"
#include "plan/route.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/// So many rows stand below a plan. The table has all of them.
enum { ROWS_MOST = 40 };

typedef struct sheet_work {
    const view_state *view;
    sl_palette palette;
    bool over_heat;
    sheet_parts *out;
    sl_status said; ///< SL_NO_MEMORY: words are missing
} sheet_work;

SL_PRINTF(2, 3) static void say(sheet_work *w, const char *format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    const size_t room = (size_t)length + 1;
    if (w->said == SL_OK) w->said = SL_ARRAY_ROOM(w->view->context, &w->out->words, room);
    if (w->said == SL_OK) {
        vsnprintf(w->out->words.items + w->out->words.count, room, format, again);
        w->out->words.count += (size_t)length;
    }
    va_end(again);
    va_end(arguments);
}

static void say_rest(sheet_work *w, size_t rows) {
    if (rows > ROWS_MOST) say(w, " And %zu more, which the exported table has.", rows - ROWS_MOST);
}

static sl_status add_part(sheet_work *w, sl_drawn_part part) {
    SL_TRY(SL_ARRAY_ROOM(w->view->context, &w->out->parts, 1));
    SL_TRY(SL_ARRAY_ROOM(w->view->context, &w->out->line_counts, 1));
    if (w->over_heat) part.opacity = 0;
    w->out->parts.items[w->out->parts.count++] = part;
    w->out->line_counts.items[w->out->line_counts.count++] = 0;
    return SL_OK;
}

/// To the last part.
static sl_status add_line(sheet_work *w, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(w->view->context, &w->out->lines, 1));
    w->out->lines.items[w->out->lines.count++] = (sl_segment){a, b};
    w->out->line_counts.items[w->out->line_counts.count - 1]++;
    return SL_OK;
}

static sl_status add_eye(sheet_work *w) {
    w->out->places[0] = w->view->eye.at;
    return add_part(w, (sl_drawn_part){.name = "viewpoint",
                                       .colour = w->palette.start,
                                       .places = w->out->places,
                                       .place_count = 1});
}

// --- tools

static sl_status add_isovist(sheet_work *w) {
    const sl_region *region = &w->view->seen.region;
    const double tolerance = 1e-4 * fmax(region->range, 0);
    char place[PLACE_TEXT], unit[SL_UNIT_TEXT];
    if (!w->view->seen.valid) return SL_OK;
    w->out->end = sl_region_flatten(region, tolerance, NULL, 0);
    SL_TRY(SL_ARRAY_ROOM(w->view->context, &w->out->points, w->out->end));
    sl_point *points = w->out->points.items;
    sl_region_flatten(region, tolerance, points, w->out->end);
    SL_TRY(add_part(w, (sl_drawn_part){.name = "seen from the viewpoint",
                                       .colour = sl_viewpoint_colour(&w->palette, 0),
                                       .area = {points, &w->out->end, w->out->end > 0},
                                       .opacity = 0.3}));
    for (size_t i = 0; i < w->out->end; i++)
        SL_TRY(add_line(w, points[i], points[i + 1 < w->out->end ? i + 1 : 0]));
    SL_TRY(add_eye(w));
    size_t count;
    const sl_measure *measures = sl_measures(SL_ISOVIST, &count);
    const sl_region_measures all = sl_region_measure(region);
    view_say_place(&w->view->document->map, w->view->eye.at, place);
    say(w, "Isovist of %s: ", place);
    for (size_t i = 0; i < count; i++) {
        char name[64];
        const double value = sl_measure_value(&measures[i], &all);
        sl_measure_say_unit(&measures[i], w->view->document->map.unit, unit);
        snprintf(name, sizeof name, "%s", measures[i].name);
        ui_spaces(name);
        if (!isnan(value))
            say(w, "%s%s %.4g%s%s", i ? ", " : "", name, value, *unit ? " " : "", unit);
    }
    return SL_OK;
}

static sl_status add_from_line(sheet_work *w) {
    static const char *const labels[] = {"seen from some point of the line",
                                         "seen from all of its points"};
    const from_line *layer = from_line_seen(w->view);
    if (!layer) return SL_OK;
    for (int i = 0; i < 2; i++) {
        char text[MEASURE_TEXT];
        measure_say(layer->seen[i].area, w->view->document->map.unit, "\xc2\xb2", text);
        snprintf(w->out->names[i], SHEET_NAME, "%s: %s", labels[i], text);
        SL_TRY(add_part(w, (sl_drawn_part){.name = w->out->names[i],
                                           .colour = sl_coverage_colour(&w->palette, i ? 3 : 1),
                                           .area = layer->seen[i].shape,
                                           .opacity = 1}));
    }
    SL_TRY(add_part(w, (sl_drawn_part){.name = "line", .colour = w->palette.start}));
    return add_line(w, layer->ends[0], layer->ends[1]);
}

/// What of the way lies on the open storey, and the length of all of it.
static sl_status add_building_way(sheet_work *w) {
    const struct building_way *way = building_way_shown(w->view);
    const size_t storey = building_way_storey(w->view);
    char text[MEASURE_TEXT];
    if (!way || !way->made || !way->route.found) return SL_OK;
    const sl_building_place *p = way->route.points;
    measure_say(way->route.length, w->view->document->map.unit, "", text);
    snprintf(w->out->names[0], SHEET_NAME, "shortest way through the building: %s", text);
    SL_TRY(add_part(w, (sl_drawn_part){.name = w->out->names[0], .colour = w->palette.start}));
    for (size_t i = 1; i < way->route.count; i++)
        if (p[i - 1].storey == storey && p[i].storey == storey)
            SL_TRY(add_line(w, p[i - 1].at, p[i].at));
    return SL_OK;
}

static sl_status add_route(sheet_work *w) {
    const route_layer *layer = w->view->route;
    char text[MEASURE_TEXT];
    if (*w->view->building) return add_building_way(w);
    if (!layer || layer->clicks < 2 || layer->tight || !layer->route.found) return SL_OK;
    measure_say(layer->route.length, w->view->document->map.unit, "", text);
    snprintf(w->out->names[0], SHEET_NAME, "shortest way: %s", text);
    w->out->places[0] = layer->from;
    w->out->places[1] = layer->to;
    SL_TRY(add_part(w, (sl_drawn_part){.name = w->out->names[0],
                                       .colour = w->palette.start,
                                       .places = w->out->places,
                                       .place_count = 2}));
    for (size_t i = 1; i < layer->route.count; i++)
        SL_TRY(add_line(w, layer->route.points[i - 1], layer->route.points[i]));
    return SL_OK;
}

static sl_status add_rooms(sheet_work *w) {
    const room_map *map = room_map_shown(w->view);
    if (!map) return SL_OK;
    const size_t rows = room_map_rows(map);
    SL_TRY(SL_ARRAY_ROOM(w->view->context, &w->out->labels, rows));
    for (size_t i = 0; i < rows; i++) {
        char area[MEASURE_TEXT], share[SL_COUNT_TEXT];
        const sl_box box = room_map_box(map, i);
        w->out->labels.items[w->out->labels.count++] =
            (sl_plan_label){room_map_name(map, i), room_map_place(map, i), 0.9 * box_width(box)};
        measure_say(room_map_area(map, i), w->view->document->map.unit, "\xc2\xb2", area);
        sl_text_percent(room_map_area(map, i) > 0 ? map->seen[i] / room_map_area(map, i) : 0,
                        share);
        if (i < ROWS_MOST)
            say(w, "%s %s (%s), %s",
                i ? ";" : "Rooms, and how much is seen from the viewpoint:", room_map_name(map, i),
                area, share);
        if (!room_map_is_zone(map, i)) {
            SL_TRY(add_part(w, (sl_drawn_part){.colour = room_map_tint(&w->palette, i),
                                               .area = map->rooms.items[i].shape,
                                               .opacity = 0.16}));
            continue;
        }
        const sl_point corners[] = {
            box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
        SL_TRY(add_part(w, (sl_drawn_part){.colour = w->palette.start, .dashed = true}));
        for (int k = 0; k < 4; k++) SL_TRY(add_line(w, corners[k], corners[(k + 1) % 4]));
    }
    say_rest(w, rows);
    return add_eye(w);
}

static sl_status add_walls(sheet_work *w, const char *name, const wall_list *walls, bool added) {
    SL_TRY(add_part(w, (sl_drawn_part){.name = name,
                                       .colour = sl_palette_changes(false, added),
                                       .dashed = !added}));
    for (size_t i = 0; i < walls->count; i++)
        SL_TRY(add_line(w, walls->items[i].a, walls->items[i].b));
    return SL_OK;
}

static sl_status add_compare(sheet_work *w) {
    const plan_compare *c = compare_shown(w->view);
    char text[MEASURE_TEXT], other[MEASURE_TEXT];
    if (!c || !c->job.made) return SL_OK;
    SL_TRY(add_walls(w, "walls of this plan alone", &c->removed, false));
    SL_TRY(add_walls(w, "walls of the other plan alone", &c->added, true));
    measure_say(w->view->document->inside_area, w->view->document->map.unit, "\xc2\xb2", text);
    measure_say(c->area, w->view->document->map.unit, "\xc2\xb2", other);
    say(w, "Inside: %s here, %s in the other plan, %s.", text, other,
        files_base(w->view->compared->source.path));
    return SL_OK;
}

// --- cameras

/// Their numbers are those in the picture.
static void say_blind(sheet_work *w, const sl_coverage *c) {
    const sl_map *map = &w->view->document->map;
    char area[MEASURE_TEXT], place[PLACE_TEXT];
    if (w->view->cameras->table.count > ROWS_MOST && c->blind_count) say(w, "\n");
    for (uint32_t i = 0; i < c->blind_count && i < ROWS_MOST; i++) {
        measure_say(c->blind[i].area, w->view->document->map.unit, "\xc2\xb2", area);
        view_say_place(map, c->blind[i].at, place);
        say(w, "%s %u: %s at %s",
            i                     ? ";"
            : c->blind_count == 1 ? "Blind spot"
                                  : "Blind spots:",
            (unsigned)i + 1, area, place);
    }
    if (c->blind_count) say(w, ".");
    if (c->blind_count > ROWS_MOST)
        say(w, " And %u smaller one%s.", (unsigned)c->blind_count - ROWS_MOST,
            c->blind_count == ROWS_MOST + 1 ? "" : "s");
}

/// The table and the classes, in words below the plan.
static void say_cameras(sheet_work *w) {
    static const char *const classes[SL_COVERAGE_CLASSES] = {"Not seen", "seen by 1", "seen by 2",
                                                             "seen by 3 or more"};
    const camera_layer *layer = w->view->cameras;
    const sl_map *map = &w->view->document->map;
    char text[MEASURE_TEXT], name[CAMERA_NAME];
    if (*layer->proof) say(w, "%s\n", layer->proof);
    const char *before = "";
    for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++) {
        const double area = sl_coverage_class_area(&layer->coverage, k);
        if (k && !(area > 0)) continue;
        measure_say(area, map->unit, "\xc2\xb2", text);
        say(w, "%s%s: %s", before, classes[k], text);
        before = "; ";
    }
    say(w, ".\n");
    for (size_t i = 0; i < layer->table.count && i < ROWS_MOST; i++) {
        const sl_viewpoint *v = &layer->table.items[i].view;
        char place[PLACE_TEXT];
        camera_name(layer, i, name);
        view_say_place(map, v->at, place);
        say(w, "%s: at %s, ", name, place);
        if (v->fov < 360)
            say(w, "heading %.4g\xc2\xb0, field of view %.4g\xc2\xb0, ", v->heading, v->fov);
        measure_say(v->range, w->view->document->map.unit, "", text);
        if (v->range > 0) say(w, "range %s, ", text);
        measure_say(layer->coverage.seen[i], w->view->document->map.unit, "\xc2\xb2", text);
        say(w, "sees %s", text);
        measure_say(layer->coverage.alone[i], w->view->document->map.unit, "\xc2\xb2", text);
        if (sl_coverage_is_spare(&layer->coverage, i))
            say(w, " (spare)\n");
        else
            say(w, ", %s alone\n", text);
    }
    say_rest(w, layer->table.count);
    say_blind(w, &layer->coverage);
}

// --- the parts

sl_status sheet_parts_fill(const view_state *view, bool over_heat, sheet_parts *out) {
    static sl_status (*const tools[TOOLS])(sheet_work * w) = {[TOOL_ISOVIST] = add_isovist,
                                                              [TOOL_FROM_LINE] = add_from_line,
                                                              [TOOL_PATH] = add_route,
                                                              [TOOL_ROOMS] = add_rooms,
                                                              [TOOL_COMPARE] = add_compare};
    sheet_work w = {
        .view = view, .palette = sl_palette_make(false), .over_heat = over_heat, .out = out};
    if (view->mode == MODE_CAMERAS && cameras_are_seen(view)) say_cameras(&w);
    if (view->mode == MODE_PLAN && tools[view->tool]) SL_TRY(tools[view->tool](&w));
    return w.said;
}

void sheet_parts_apply(const sheet_parts *parts, sl_draw_options *options) {
    for (size_t i = 0, first = 0; i < parts->parts.count; i++) {
        parts->parts.items[i].lines = parts->lines.items + first;
        parts->parts.items[i].line_count = parts->line_counts.items[i];
        first += parts->line_counts.items[i];
        // Over a heat map it is an outline, also in the key.
        if (parts->parts.items[i].opacity == 0 && parts->parts.items[i].line_count)
            parts->parts.items[i].area = (sl_shape){0};
    }
    options->parts = parts->parts.items;
    options->part_count = parts->parts.count;
    options->labels = parts->labels.items;
    options->label_count = parts->labels.count;
    options->words = parts->words.items;
}

void sheet_parts_destroy(sl_context *context, sheet_parts *parts) {
    sl_free(context, parts->parts.items);
    sl_free(context, parts->labels.items);
    sl_free(context, parts->points.items);
    sl_free(context, parts->lines.items);
    sl_free(context, parts->line_counts.items);
    sl_free(context, parts->words.items);
}
