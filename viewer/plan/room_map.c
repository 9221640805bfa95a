/// A job finds the rooms. Names and zones stay with the file, whatever is changed in it, and are
/// kept between runs: a name belongs to the room about the place where it was typed.
#include "plan/room_map.h"

#include "draw/draw_plan.h" // private: names are cut as in pictures
#include "plan/cameras.h"
#include "plan/heat.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool is_at_hand(const view_state *view) {
    return view->mode == MODE_PLAN && view->tool == TOOL_ROOMS;
}

static void forget_measures(sl_context *context, room_map *map) {
    sl_free(context, map->seen);
    sl_free(context, map->means);
    sl_free(context, map->points);
    map->seen = map->means = NULL;
    map->points = NULL;
    map->measured = false;
}

static void forget_rooms(sl_context *context, room_map *map) {
    tool_job_drop(context, &map->job);
    sl_map_destroy(context, &map->map);
    sl_rooms_destroy(context, &map->rooms);
    forget_measures(context, map);
}

void room_map_destroy(sl_context *context, room_map *map) {
    if (!map) return;
    forget_rooms(context, map);
    sl_free(context, map->names.items);
    sl_free(context, map->zones.items);
    sl_free(context, map);
}

// --- the work

static sl_status name_rooms(sl_context *context, room_map *map) {
    SL_TRY(sl_rooms_take_names(context, &map->rooms, &map->map));
    for (size_t i = 0; i < map->names.count; i++) {
        const uint32_t room = sl_rooms_at(&map->rooms, map->names.items[i].box.min);
        if (room != SL_NO_ROOM)
            SL_TRY(sl_rooms_name(context, &map->rooms, room, map->names.items[i].name));
    }
    return SL_OK;
}

static sl_status find_rooms(sl_context *context, void *data) {
    room_map *map = data;
    const sl_outline *outline;
    SL_TRY(sl_query_outline(context, map->job.query, &outline));
    SL_TRY(sl_rooms_find(context, &map->map, outline->space, 0, &map->rooms));
    return name_rooms(context, map);
}

// --- what is kept between runs

static const char *kept_path(const view_state *view) {
    return view->ui->steady ? NULL : view->document->source.path;
}

static void recall(view_state *view) {
    room_map *map = view->rooms;
    const char *path = kept_path(view);
    map->names.count = map->zones.count = 0;
    if (path) view_check(view, places_recall(view->context, path, &map->names, &map->zones));
}

static void remember(const view_state *view) {
    const room_map *map = view->rooms;
    const char *path = kept_path(view);
    if (path) places_remember(view->context, path, &map->names, &map->zones);
}

static sl_status begin_map(view_state *view) {
    if (!view->rooms) view->rooms = sl_alloc_array(view->context, 1, sizeof *view->rooms);
    room_map *map = view->rooms;
    if (!map) return SL_NO_MEMORY;
    const bool other = map->opened != view->document->opened;
    if (other || tool_job_is_old(view, &map->job)) forget_rooms(view->context, map);
    if (other) recall(view); // no job reads the names any more
    map->opened = view->document->opened;
    if (map->map.wall_count || map->job.made || map->job.task) return SL_OK;
    return sl_baked_copy_map(view->context, view->document->baked, &map->map);
}

// --- what is measured in each

/// The area that is seen of each row: all of them are laid over the region at once.
static sl_status measure_seen(view_state *view, room_map *map) {
    sl_context *context = view->context;
    const size_t rows = room_map_rows(map);
    const sl_region *region = &view->seen.region;
    const double tolerance = 1e-4 * fmax(region->range, 0);
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    sl_point *points = sl_alloc_array(context, count + 1, sizeof *points);
    sl_point *corners = sl_alloc_array(context, 4 * map->zones.count + 1, sizeof *corners);
    sl_shape *shapes = sl_alloc_array(context, rows + 1, sizeof *shapes);
    static const size_t four = 4;
    sl_overlay overlay = {0};
    sl_status status = points && corners && shapes ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) sl_region_flatten(region, tolerance, points, count);
    for (size_t i = 0; status == SL_OK && i < map->rooms.count; i++)
        shapes[i] = map->rooms.items[i].shape;
    for (size_t i = 0; status == SL_OK && i < map->zones.count; i++) {
        const sl_box b = map->zones.items[i].box;
        const sl_point all[] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        memcpy(corners + 4 * i, all, sizeof all);
        shapes[map->rooms.count + i] = (sl_shape){corners + 4 * i, &four, 1};
    }
    const sl_shape seen = {points, &count, count >= 3};
    if (status == SL_OK) status = sl_overlay_make(context, &seen, shapes, rows, &overlay);
    for (size_t i = 0; status == SL_OK && i < rows; i++) map->seen[i] = overlay.covered[i];
    if (status == SL_OK) sl_overlay_destroy(context, &overlay);
    sl_free(context, points);
    sl_free(context, corners);
    sl_free(context, shapes);
    return status;
}

/// The mean of the heat map's values in each row. A point counts for its room, and for all zones.
static void measure_means(const view_state *view, room_map *map) {
    const heat_graph *graph;
    const double *values = heat_layer_values(view, &graph);
    const size_t rows = room_map_rows(map);
    for (size_t i = 0; i < rows; i++) {
        map->means[i] = 0;
        map->points[i] = 0;
    }
    for (uint32_t i = 0; values && i < graph->grid.count; i++) {
        const sl_point at = graph->grid.points[i];
        const uint32_t room = sl_rooms_at(&map->rooms, at);
        for (size_t k = room == SL_NO_ROOM ? map->rooms.count : room; k < rows; k++) {
            if (k != room && !(room_map_is_zone(map, k) &&
                               box_has(map->zones.items[k - map->rooms.count].box, at)))
                continue;
            if (isnan(values[i])) continue;
            map->means[k] += values[i];
            map->points[k]++;
        }
    }
    for (size_t i = 0; i < rows; i++)
        map->means[i] = map->points[i] ? map->means[i] / map->points[i] : NAN;
}

static sl_status measure(view_state *view, room_map *map) {
    const heat_graph *graph;
    const bool heat = heat_layer_values(view, &graph) != NULL;
    const uint32_t stamp = heat ? view->heat_choice.stamp + 1 : 0;
    if (map->measured && map->heat_stamp == stamp && map->seen_version == view->seen.version &&
        seen_same_view(&map->view, &view->seen.view))
        return SL_OK;
    const size_t rows = room_map_rows(map);
    forget_measures(view->context, map);
    map->seen = sl_alloc_array(view->context, rows + 1, sizeof *map->seen);
    map->means = sl_alloc_array(view->context, rows + 1, sizeof *map->means);
    map->points = sl_alloc_array(view->context, rows + 1, sizeof *map->points);
    if (!map->seen || !map->means || !map->points) return SL_NO_MEMORY;
    measure_means(view, map);
    map->measured = true;
    map->heat_stamp = stamp;
    map->seen_version = view->seen.version;
    map->view = view->seen.view;
    map->zone_stamp++;
    return view->seen.valid && rows ? measure_seen(view, map) : SL_OK;
}

/// Blind spots of cameras are said by their rooms.
static bool is_asked(const view_state *view) {
    return is_at_hand(view) || (view->mode == MODE_CAMERAS && view->cameras &&
                                view->cameras->known && view->cameras->coverage.blind_count);
}

void room_map_update(view_state *view, bool wait) {
    if (!is_asked(view) || !view->document->baked) return;
    const sl_status status = begin_map(view);
    view_check(view, status);
    if (status != SL_OK) return;
    room_map *map = view->rooms;
    if (tool_job_update(view, &map->job, wait, find_rooms, map) && is_at_hand(view))
        ui_say(view->ui, false, "%u room%s; drag for a zone", map->rooms.count,
               map->rooms.count == 1 ? "" : "s");
}

void room_map_follow(view_state *view) {
    room_map *map = is_at_hand(view) ? view->rooms : NULL;
    if (map && map->job.made && !map->drags && !view->held) view_check(view, measure(view, map));
}

const room_map *room_map_shown(const view_state *view) {
    const room_map *map = is_at_hand(view) ? view->rooms : NULL;
    return map && map->job.made && map->measured ? map : NULL;
}

const char *room_map_room(const view_state *view, sl_point at) {
    const room_map *map = view->rooms;
    if (!map || !map->job.made || tool_job_is_old(view, &map->job)) return NULL;
    const uint32_t room = sl_rooms_at(&map->rooms, at);
    return room == SL_NO_ROOM ? NULL : map->rooms.items[room].name;
}

bool room_map_stop(view_state *view) {
    return view->rooms && tool_job_stop(view->context, &view->rooms->job);
}

job_progress room_map_progress(const view_state *view) {
    return view->rooms ? tool_job_progress(&view->rooms->job) : (job_progress){0};
}

// --- rows

size_t room_map_rows(const room_map *map) {
    return map->rooms.count + map->zones.count;
}

bool room_map_is_zone(const room_map *map, size_t row) {
    return row >= map->rooms.count;
}

const char *room_map_name(const room_map *map, size_t row) {
    return room_map_is_zone(map, row) ? map->zones.items[row - map->rooms.count].name
                                      : map->rooms.items[row].name;
}

double room_map_area(const room_map *map, size_t row) {
    if (!room_map_is_zone(map, row)) return map->rooms.items[row].area;
    const sl_box b = map->zones.items[row - map->rooms.count].box;
    return box_width(b) * box_height(b);
}

sl_point room_map_place(const room_map *map, size_t row) {
    return room_map_is_zone(map, row) ? box_middle(map->zones.items[row - map->rooms.count].box)
                                      : map->rooms.items[row].at;
}

sl_box room_map_box(const room_map *map, size_t row) {
    return room_map_is_zone(map, row) ? map->zones.items[row - map->rooms.count].box
                                      : map->rooms.items[row].bounds;
}

size_t room_map_at(const room_map *map, sl_point at) {
    size_t best = SIZE_MAX;
    for (size_t i = map->rooms.count; i < room_map_rows(map); i++)
        if (box_has(map->zones.items[i - map->rooms.count].box, at) &&
            (best == SIZE_MAX || room_map_area(map, i) < room_map_area(map, best)))
            best = i;
    const uint32_t room = best == SIZE_MAX ? sl_rooms_at(&map->rooms, at) : SL_NO_ROOM;
    return room == SL_NO_ROOM ? best : room;
}

void room_map_rename(view_state *view, size_t row, const char *name) {
    room_map *map = view->rooms;
    if (!map || !map->job.made || row >= room_map_rows(map)) return;
    if (room_map_is_zone(map, row)) {
        named_place *zone = &map->zones.items[row - map->rooms.count];
        if (*name) sli_text_copy(name, strlen(name), zone->name, sizeof zone->name);
        remember(view);
        return;
    }
    size_t at = map->names.count;
    for (size_t i = 0; i < map->names.count; i++) // of several in one room the last counts
        if (sl_rooms_at(&map->rooms, map->names.items[i].box.min) == row) at = i;
    sl_status status = SL_OK;
    if (*name && at == map->names.count) status = SL_ARRAY_ROOM(view->context, &map->names, 1);
    if (*name && status == SL_OK) {
        map->names.count += at == map->names.count;
        named_place *place = &map->names.items[at];
        place->box = (sl_box){map->rooms.items[row].at, map->rooms.items[row].at};
        sli_text_copy(name, strlen(name), place->name, sizeof place->name);
    } else if (at < map->names.count) {
        map->names.items[at] = map->names.items[--map->names.count];
    }
    if (status == SL_OK) status = sl_rooms_name(view->context, &map->rooms, (uint32_t)row, "");
    if (status == SL_OK) status = name_rooms(view->context, map);
    map->zone_stamp++;
    view_check(view, status);
    remember(view);
}

/// Names a new zone by the first number that no other one has.
static void number_zone(const named_places *zones, named_place *zone) {
    bool taken = true;
    for (size_t number = 1; taken; number++) {
        snprintf(zone->name, sizeof zone->name, "Zone %zu", number);
        taken = false;
        for (size_t i = 0; i < zones->count; i++)
            taken |= &zones->items[i] != zone && strcmp(zones->items[i].name, zone->name) == 0;
    }
}

void room_map_begin_zone(view_state *view, sl_point at) {
    room_map *map = view->rooms;
    if (!map || !map->job.made) return;
    const sl_status status = SL_ARRAY_ROOM(view->context, &map->zones, 1);
    view_check(view, status);
    if (status != SL_OK) return;
    named_place *zone = &map->zones.items[map->zones.count++];
    *zone = (named_place){.box = {at, at}};
    number_zone(&map->zones, zone);
    map->drags = true;
    map->measured = false;
}

void room_map_drag_zone(view_state *view, sl_point to) {
    room_map *map = view->rooms;
    if (!map || !map->drags) return;
    const sl_point from = view->drag.at;
    map->zones.items[map->zones.count - 1].box = (sl_box){{fmin(from.x, to.x), fmin(from.y, to.y)},
                                                          {fmax(from.x, to.x), fmax(from.y, to.y)}};
}

void room_map_drop_zone(view_state *view) {
    room_map *map = view->rooms;
    if (!map || !map->drags) return;
    map->drags = false;
    if (!(room_map_area(map, room_map_rows(map) - 1) > 0)) map->zones.count--;
    remember(view);
}

void room_map_delete(view_state *view, size_t row) {
    room_map *map = view->rooms;
    if (!map || !map->job.made || row >= room_map_rows(map) || !room_map_is_zone(map, row)) return;
    const size_t zone = row - map->rooms.count;
    map->zones.count--;
    memmove(&map->zones.items[zone], &map->zones.items[zone + 1],
            (map->zones.count - zone) * sizeof *map->zones.items);
    map->measured = false;
    remember(view);
}

// --- the picture

/// A name at its place, on a ground of the page, where the room is wide enough for it.
static void draw_name(const view_state *view, const sl_frame *frame, const room_map *map,
                      size_t row) {
    ui_state *ui = view->ui;
    const char *name = room_map_name(map, row);
    const sl_point at = sl_frame_point(frame, room_map_place(map, row));
    const double wide = ui_text_width(ui, 0.95, true, name), t = ui->text;
    const sl_box box = room_map_box(map, row);
    const bool chosen = view->table.chosen == row;
    if (!chosen && wide > frame->scale * box_width(box)) return;
    ui_fill_round(ui,
                  (sl_box){{at.x - wide / 2 - 0.3 * t, at.y - 0.9 * t},
                           {at.x + wide / 2 + 0.3 * t, at.y + 0.5 * t}},
                  0.25 * t, ui->palette.page);
    ui_text(ui, at.x - wide / 2, at.y + 0.15 * t, 0.95, true, ui->palette.ink, name);
}

sl_colour room_map_tint(const sl_palette *p, size_t room) {
    const sl_colour tints[] = {p->glass, p->door, p->object, p->tree};
    return tints[room % 4];
}

static void draw_room(const view_state *view, const sl_frame *frame, const sl_room *room,
                      size_t number, bool chosen) {
    cairo_t *cairo = view->ui->cairo;
    const sl_colour tint = room_map_tint(&view->ui->palette, number);
    cairo_new_path(cairo);
    for (size_t i = 0; i < room->shape.count; i++)
        sl_path_polygon(cairo, frame, room->shape.points + 3 * i, 3);
    const heat_graph *graph; // its colours stay those of the legend
    const double least = heat_layer_values(view, &graph) ? 0 : 0.16;
    cairo_set_source_rgba(cairo, tint.red, tint.green, tint.blue, chosen ? 0.45 : least);
    cairo_fill(cairo);
}

void room_map_draw(const view_state *view, const sl_frame *frame) {
    const room_map *map = is_at_hand(view) ? view->rooms : NULL;
    cairo_t *cairo = view->ui->cairo;
    if (!map || !map->job.made) return;
    for (size_t i = 0; i < map->rooms.count; i++)
        draw_room(view, frame, &map->rooms.items[i], i, view->table.chosen == i);
    for (size_t i = 0; i < map->zones.count; i++) {
        const sl_box b = map->zones.items[i].box;
        const sl_point corners[] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        const double dash[] = {7 * frame->unit, 4 * frame->unit};
        cairo_new_path(cairo);
        sl_path_polygon(cairo, frame, corners, 4);
        cairo_save(cairo);
        cairo_set_dash(cairo, dash, 2, 0);
        sl_set_colour(cairo, view->ui->palette.start);
        cairo_set_line_width(cairo,
                             (view->table.chosen == map->rooms.count + i ? 3 : 1.8) * frame->unit);
        cairo_stroke(cairo);
        cairo_restore(cairo);
    }
    for (size_t i = 0; i < room_map_rows(map); i++) draw_name(view, frame, map, i);
}
