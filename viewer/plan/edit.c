/// What the pointer holds, where it may go, and what a drag makes of it.
#include "plan/edit.h"
#include "plan/grid.h"

#include "plan/drag_world.h"
#include "plan/effects.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// The wall that is near to both places; UINT32_MAX for none.
static uint32_t pick_along(const view_state *view, sl_point from, sl_point to) {
    const sl_map *map = &view->document->map;
    double nearest = grid_reach(view);
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *w = &map->walls[i];
        const double off = fmax(grid_distance(from, w->a, w->b), grid_distance(to, w->a, w->b));
        if (off > nearest) continue;
        nearest = off;
        found = (uint32_t)i;
    }
    return found;
}

// --- what is held

static size_t count_of(const sl_map *map, int kind) {
    const size_t counts[HELD_KINDS] = {map->wall_count, map->door_count, map->mirror_count,
                                       map->oneway_count, map->seam_count};
    return counts[kind];
}

/// The first end of a segment, or its second one.
static sl_point *end_of(const sl_map *map, int kind, size_t index, bool second) {
    if (kind == HELD_WALL) return second ? &map->walls[index].b : &map->walls[index].a;
    sl_segment *at = kind == HELD_DOOR     ? &map->doors[index].segment
                     : kind == HELD_MIRROR ? &map->mirrors[index].segment
                     : kind == HELD_ONEWAY ? &map->oneways[index].segment
                                           : &map->seams[index].segment;
    return second ? &at->b : &at->a;
}

static bool hold_end(view_state *view, int kind, size_t index, bool second) {
    const sl_status status = SL_ARRAY_ROOM(view->context, &view->edit.ends, 1);
    view_check(view, status);
    if (status != SL_OK) return false;
    view->edit.ends.items[view->edit.ends.count++] =
        (held_end){kind, index, second, *end_of(&view->document->map, kind, index, second)};
    return true;
}

/// A baked file has its doors and glass cut to pieces: they stay where they are.
static int kinds_that_move(const view_state *view) {
    const char *path = view->document->source.path;
    return path && document_is_baked(path) ? HELD_DOOR : HELD_KINDS;
}

/// The end of a wall or door under a place. Short walls keep room between their corners.
static bool find_corner(const view_state *view, sl_point at, sl_point *found) {
    const sl_map *map = &view->document->map;
    double nearest = INFINITY;
    for (int kind = HELD_WALL; kind <= HELD_DOOR && kind < kinds_that_move(view); kind++)
        for (size_t i = 0; i < count_of(map, kind); i++) {
            const sl_point ends[2] = {*end_of(map, kind, i, false), *end_of(map, kind, i, true)};
            const double length = hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y);
            const double room = fmin(1.2 * grid_reach(view), length / 4);
            for (int k = 0; k < 2; k++) {
                const double off = hypot(at.x - ends[k].x, at.y - ends[k].y);
                if (off > room || off >= nearest) continue;
                nearest = off;
                *found = ends[k];
            }
        }
    return nearest < INFINITY;
}

/// Holds all ends at a corner. Ends that cleaning would weld are at one corner.
static void hold_corner(view_state *view, sl_point at) {
    const sl_map *map = &view->document->map;
    for (int kind = HELD_WALL; kind < kinds_that_move(view); kind++)
        for (size_t i = 0; i < count_of(map, kind); i++)
            for (int k = 0; k < 2; k++) {
                const sl_point end = *end_of(map, kind, i, k);
                if (hypot(end.x - at.x, end.y - at.y) <= view->document->weld)
                    hold_end(view, kind, i, k);
            }
}

static uint32_t pick_door(const view_state *view, sl_point at) {
    return kinds_that_move(view) > HELD_DOOR ? door_at(view, at) : UINT32_MAX;
}

drag_kind edit_take(view_state *view, drag_state *drag) {
    sl_point corner;
    view->edit.ends.count = 0;
    view->edit.bakes = false;
    drag->segment = (sl_segment){{0, 0}, {0, 0}};
    view->edit.chosen = UINT32_MAX;
    if (!view->edit.draws_doors && find_corner(view, drag->at, &corner)) {
        hold_corner(view, corner);
        return DRAG_CORNER;
    }
    const uint32_t door = pick_door(view, drag->at);
    const int kind = door == UINT32_MAX ? HELD_WALL : HELD_DOOR;
    if (view->edit.draws_doors && kind == HELD_WALL) return DRAG_NEW_DOOR;
    view->edit.chosen_kind = kind;
    view->edit.chosen = kind == HELD_WALL ? pick_along(view, drag->at, drag->at) : door;
    if (view->edit.chosen == UINT32_MAX) return DRAG_NEW_WALL;
    hold_end(view, kind, view->edit.chosen, false);
    hold_end(view, kind, view->edit.chosen, true);
    return kind == HELD_WALL ? DRAG_WALL : DRAG_DOOR;
}

static bool is_same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

static bool is_usable(sl_point p) {
    return sl_coordinate_usable(p.x) && sl_coordinate_usable(p.y);
}

/// Where a held end is when the drag is at a place: corners on the grid, the rest by whole steps.
static sl_point place_of(const view_state *view, const drag_state *drag, const held_end *end,
                         sl_point now) {
    if (drag->kind == DRAG_CORNER || drag->kind == DRAG_NEW_WALL) return grid_snap(view, now);
    const sl_point by = grid_moved(view, drag->at, now);
    return (sl_point){end->was.x + by.x, end->was.y + by.y};
}

/// Whether all ends can go there, and one of them is not there yet. No segment may lose its length.
static bool can_go(const view_state *view, const drag_state *drag, sl_point now) {
    const sl_map *map = &view->document->map;
    const bool whole = drag->kind == DRAG_WALL || drag->kind == DRAG_DOOR;
    bool any = false;
    for (size_t i = 0; i < view->edit.ends.count; i++) {
        const held_end *e = &view->edit.ends.items[i];
        const sl_point to = place_of(view, drag, e, now);
        if (e->index >= count_of(map, e->kind) || !is_usable(to)) return false;
        if (!whole && is_same(to, *end_of(map, e->kind, e->index, !e->second))) return false;
        any |= !is_same(to, *end_of(map, e->kind, e->index, e->second));
    }
    return any;
}

/// Keeps the map for undo. Walls that are moved are no longer the sides of the solid ground that
/// the file speaks of: where they contradict each other, ground is open from now on.
static void begin_change(view_state *view, drag_state *drag) {
    view_before_edit(view);
    drag_world_drop(view); // of the drag before
    view->document->map.ground_guessed = true;
    drag->changed = true;
}

/// A new wall begins where the pointer was pressed. Its second end is held.
static bool begin_wall(view_state *view, drag_state *drag, sl_point now) {
    const sl_point from = grid_snap(view, drag->at), to = grid_snap(view, now);
    if (is_same(from, to) || !is_usable(from) || !is_usable(to)) return false;
    begin_change(view, drag);
    const sl_status status = sl_map_add_wall(view->context, &view->document->map, from, to, 0);
    view_check(view, status);
    return status == SL_OK && hold_end(view, HELD_WALL, view->document->map.wall_count - 1, true);
}

// --- new doors

/// The place of a wall nearest to a place of the grid; near an end of the wall, that end.
static sl_point place_on(const view_state *view, const sl_wall *wall, sl_point at) {
    const sl_point a = wall->a, b = wall->b, to = grid_snap(view, at);
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double share = ((to.x - a.x) * dx + (to.y - a.y) * dy) / (dx * dx + dy * dy);
    if (share <= 0 || hypot(at.x - a.x, at.y - a.y) <= grid_reach(view)) return a;
    if (share >= 1 || hypot(at.x - b.x, at.y - b.y) <= grid_reach(view)) return b;
    if (dx == 0) return (sl_point){a.x, to.y};
    if (dy == 0) return (sl_point){to.x, a.y};
    return (sl_point){a.x + share * dx, a.y + share * dy};
}

/// The place of a corner that is near, else of the grid.
static sl_point place_at(const view_state *view, sl_point at) {
    sl_point corner;
    return find_corner(view, at, &corner) ? corner : grid_snap(view, at);
}

/// Along a wall a door lies in that wall; UINT32_MAX: along none.
static sl_segment door_between(const view_state *view, uint32_t along, sl_point from, sl_point to) {
    if (along == UINT32_MAX) return (sl_segment){place_at(view, from), place_at(view, to)};
    const sl_wall *wall = &view->document->map.walls[along];
    return (sl_segment){place_on(view, wall, from), place_on(view, wall, to)};
}

/// A name that no door has: "door1".
static void name_door(const sl_map *map, char name[32]) {
    bool used = true;
    for (unsigned number = 1; used; number++) {
        snprintf(name, 32, "door%u", number);
        used = false;
        for (size_t i = 0; i < map->door_count; i++) used |= !strcmp(map->doors[i].name, name);
    }
}

/// A new door is open, and its ends are held.
static bool begin_door(view_state *view, drag_state *drag, sl_segment at) {
    sl_map *map = &view->document->map;
    char name[32];
    begin_change(view, drag);
    name_door(map, name);
    const sl_status status = sl_map_add_door(view->context, map, name, at, true, 0);
    view_check(view, status);
    return status == SL_OK && hold_end(view, HELD_DOOR, map->door_count - 1, false) &&
           hold_end(view, HELD_DOOR, map->door_count - 1, true);
}

/// The drag's index is the wall that the door lies in.
static void drag_door(view_state *view, drag_state *drag, sl_point now) {
    const uint32_t along = pick_along(view, drag->at, now);
    const sl_segment at = door_between(view, along, drag->at, now);
    if (is_same(at.a, at.b) || !is_usable(at.a) || !is_usable(at.b)) return;
    drag->index = along;
    if (!drag->changed) {
        if (begin_door(view, drag, at)) view_after_step(view);
        return;
    }
    sl_map *map = &view->document->map;
    if (!view->edit.ends.count || view->edit.ends.items[0].index >= map->door_count) return;
    sl_segment *door = &map->doors[view->edit.ends.items[0].index].segment;
    if (is_same(door->a, at.a) && is_same(door->b, at.b)) return;
    *door = at;
    view_after_step(view);
}

static void say_last_wall(ui_state *ui) {
    ui_say(ui, true, "the last wall stays: a map without walls has no cells");
}

/// Leaves of a wall what is beside the door in it; false if that is the last wall and nothing is.
static bool cut_wall(view_state *view, uint32_t wall, sl_segment door) {
    sl_map *map = &view->document->map;
    sl_wall parts[2] = {map->walls[wall], map->walls[wall]};
    const sl_point a = parts[0].a;
    const bool turned =
        hypot(door.b.x - a.x, door.b.y - a.y) < hypot(door.a.x - a.x, door.a.y - a.y);
    parts[0].b = turned ? door.b : door.a;
    parts[1].a = turned ? door.a : door.b;
    if (map->wall_count == 1 && is_same(parts[0].a, parts[0].b) && is_same(parts[1].a, parts[1].b))
        return false;
    map->walls[wall] = map->walls[--map->wall_count];
    for (int i = 0; i < 2; i++)
        if (!is_same(parts[i].a, parts[i].b))
            view_check(view, sl_map_add_walls(view->context, map, &parts[i], 1));
    return true;
}

// --- drags

void edit_drag(view_state *view, drag_state *drag, sl_point now) {
    if (drag->kind == DRAG_NEW_DOOR) {
        drag_door(view, drag, now);
        return;
    }
    if (drag->kind == DRAG_NEW_WALL && !drag->changed) {
        if (begin_wall(view, drag, now)) view_after_step(view);
        return;
    }
    if (!can_go(view, drag, now)) return;
    if (!drag->changed) begin_change(view, drag);
    for (size_t i = 0; i < view->edit.ends.count; i++) {
        const held_end *e = &view->edit.ends.items[i];
        *end_of(&view->document->map, e->kind, e->index, e->second) = place_of(view, drag, e, now);
    }
    view_after_step(view);
}

/// Says where things are now.
static void say_moved(view_state *view, const drag_state *drag) {
    const held_end *e = &view->edit.ends.items[0];
    const sl_point at = *end_of(&view->document->map, e->kind, e->index, e->second);
    if (drag->kind == DRAG_NEW_WALL) {
        const sl_point from = *end_of(&view->document->map, HELD_WALL, e->index, false);
        ui_say(view->ui, false, "wall from %.10g,%.10g to %.10g,%.10g", from.x, from.y, at.x, at.y);
    } else if (drag->kind == DRAG_NEW_DOOR) {
        const sl_door *door = &view->document->map.doors[e->index];
        const sl_segment s = door->segment;
        ui_say(view->ui, false,
               "%s from %.10g,%.10g to %.10g,%.10g, open; in Explore a click shuts it", door->name,
               s.a.x, s.a.y, s.b.x, s.b.y);
    } else if (drag->kind == DRAG_CORNER) {
        ui_say(view->ui, false, "corner at %.10g,%.10g, %zu end%s moved", at.x, at.y,
               view->edit.ends.count, view->edit.ends.count == 1 ? "" : "s");
    } else {
        ui_say(view->ui, false, "%s moved by %g,%g", drag->kind == DRAG_DOOR ? "door" : "wall",
               at.x - e->was.x, at.y - e->was.y);
    }
}

/// The map is as it was before the drag.
static bool take_back(view_state *view) {
    drag_world_drop(view);
    return history_take_back(view->context, &view->document->history, &view->document->map);
}

void edit_drop(view_state *view, const drag_state *drag) {
    sl_map *map = &view->document->map;
    bool moved = drag->kind == DRAG_NEW_WALL || drag->kind == DRAG_NEW_DOOR;
    for (size_t i = 0; i < view->edit.ends.count && drag->changed; i++) {
        const held_end *e = &view->edit.ends.items[i];
        if (e->index >= count_of(map, e->kind)) return;
        moved |= !is_same(e->was, *end_of(map, e->kind, e->index, e->second));
    }
    if (drag->changed && view->edit.ends.count) {
        if (moved) say_moved(view, drag);
        if (drag->kind == DRAG_NEW_DOOR && drag->index < map->wall_count &&
            !cut_wall(view, drag->index, map->doors[view->edit.ends.items[0].index].segment)) {
            say_last_wall(view->ui);
            moved = false;
        }
        if (!moved) take_back(view);
        view->edit.chosen = UINT32_MAX;
        view_after_edit(view);
    }
    view->edit.ends.count = 0;
}

bool edit_cancel(view_state *view) {
    const drag_state drag = view->drag;
    if (drag.kind < DRAG_NEW_WALL || drag.kind > DRAG_MIRROR) return false;
    view->drag = (drag_state){0};
    view->edit.ends.count = 0;
    if (drag.changed && take_back(view)) {
        view->edit.chosen = UINT32_MAX;
        ui_say(view->ui, false, "everything is back where it was");
        view_after_edit(view);
    }
    return true;
}

static void drop_door(view_state *view, uint32_t door) {
    sl_map *map = &view->document->map;
    sl_free(view->context, map->doors[door].name);
    sl_free(view->context, map->doors[door].parts);
    map->doors[door] = map->doors[--map->door_count];
}

void edit_delete(view_state *view) {
    sl_map *map = &view->document->map;
    const uint32_t chosen = view->edit.chosen;
    const bool door = view->edit.chosen_kind == HELD_DOOR;
    if (view->drag.changed) return; // what is held stays
    if (chosen >= count_of(map, view->edit.chosen_kind)) {
        ui_say(view->ui, false, "nothing is chosen: click on a wall or a door");
        return;
    }
    if (!door && map->wall_count == 1) {
        say_last_wall(view->ui);
        return;
    }
    view_before_edit(view);
    map->ground_guessed = true;
    if (door)
        drop_door(view, chosen);
    else
        map->walls[chosen] = map->walls[--map->wall_count];
    view->edit.chosen = UINT32_MAX;
    ui_say(view->ui, false, "%s deleted", door ? "door" : "wall");
    view_after_edit(view);
}

static void draw_grid(view_state *view, const sl_frame *frame) {
    const double step = grid_step(view), size = fmax(frame->unit, 1);
    const double x0 = step * ceil(frame->corner.x / step);
    const double y0 = step * ceil(frame->corner.y / step);
    const int columns = (int)(frame->width / frame->scale / step) + 1;
    const int rows = (int)(frame->height / frame->scale / step) + 1;
    for (int i = 0; i < columns && columns < 1000; i++)
        for (int k = 0; k < rows && rows < 1000; k++) {
            const sl_point at = sl_frame_point(frame, (sl_point){x0 + i * step, y0 + k * step});
            cairo_rectangle(view->ui->cairo, floor(at.x), floor(at.y), size, size);
        }
    const sl_colour c = view->ui->palette.faint;
    cairo_set_source_rgba(view->ui->cairo, c.red, c.green, c.blue, 0.4);
    cairo_fill(view->ui->cairo);
}

/// Marks the corner that is held, or the one under the pointer.
static void draw_corner(view_state *view, const sl_frame *frame, sl_point pointer) {
    const drag_state *drag = &view->drag;
    sl_point corner;
    if (drag->kind == DRAG_CORNER || (drag->kind == DRAG_NEW_WALL && drag->changed)) {
        const held_end *e = view->edit.ends.items;
        if (!view->edit.ends.count || e->index >= count_of(&view->document->map, e->kind)) return;
        corner = *end_of(&view->document->map, e->kind, e->index, e->second);
    } else if (drag->kind != DRAG_NONE || !find_corner(view, pointer, &corner)) {
        return;
    }
    view_mark(view, frame, corner);
}

/// Draws each segment of which an end is held where it is now, however late the plan is.
static void draw_held(view_state *view, const sl_frame *frame) {
    const sl_map *map = &view->document->map;
    for (size_t i = 0; i < view->edit.ends.count && view->drag.changed; i++) {
        const held_end *e = &view->edit.ends.items[i];
        if (e->index >= count_of(map, e->kind)) return;
        sl_draw_line(view->ui->cairo, frame, *end_of(map, e->kind, e->index, false),
                     *end_of(map, e->kind, e->index, true), view->ui->palette.start,
                     4 * frame->unit);
    }
}

void edit_draw(view_state *view, const sl_frame *frame) {
    const sl_map *map = &view->document->map;
    const sl_colour colour = view->ui->palette.start;
    draw_grid(view, frame);
    const int kind = view->edit.chosen_kind;
    if (view->edit.chosen < count_of(map, kind))
        sl_draw_line(view->ui->cairo, frame, *end_of(map, kind, view->edit.chosen, false),
                     *end_of(map, kind, view->edit.chosen, true), colour, 5 * frame->unit);
    draw_held(view, frame);
    sl_point at;
    if (view_pointed(view, &at)) draw_corner(view, frame, at);
}
