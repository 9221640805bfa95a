/// What the pointer holds, where it may go, and what a drag makes of it.
#include "plan/edit.h"

#include "plan/effects.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double edit_step(const app_state *app) {
    const double wanted = 11 * app->ui.density / app->view.camera.scale;
    double step = pow(10, floor(log10(wanted)));
    if (step * 2 >= wanted) return step * 2;
    return step * 5 >= wanted ? step * 5 : step * 10;
}

sl_point edit_snap(const app_state *app, sl_point at) {
    const double step = edit_step(app);
    return (sl_point){step * round(at.x / step), step * round(at.y / step)};
}

double edit_distance(sl_point p, sl_point a, sl_point b) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
    const double along = length > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length : 0;
    const double t = fmin(fmax(along, 0), 1);
    return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

double edit_reach(const app_state *app) {
    return 7 * app->ui.density / app->view.camera.scale;
}

/// The wall that is near to both places; UINT32_MAX for none.
static uint32_t pick_along(const app_state *app, sl_point from, sl_point to) {
    const sl_map *map = &app->document.map;
    double nearest = edit_reach(app);
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *w = &map->walls[i];
        const double off = fmax(edit_distance(from, w->a, w->b), edit_distance(to, w->a, w->b));
        if (off > nearest) continue;
        nearest = off;
        found = (uint32_t)i;
    }
    return found;
}

// --- what is held

/// The kinds of segments whose ends can be held.
enum { WALLS, DOORS, MIRRORS, ONEWAYS, SEAMS, KINDS };

static size_t count_of(const sl_map *map, int kind) {
    const size_t counts[KINDS] = {map->wall_count, map->door_count, map->mirror_count,
                                  map->oneway_count, map->seam_count};
    return counts[kind];
}

/// The first end of a segment, or its second one.
static sl_point *end_of(const sl_map *map, int kind, size_t index, bool second) {
    if (kind == WALLS) return second ? &map->walls[index].b : &map->walls[index].a;
    sl_segment *at = kind == DOORS     ? &map->doors[index].segment
                     : kind == MIRRORS ? &map->mirrors[index].segment
                     : kind == ONEWAYS ? &map->oneways[index].segment
                                       : &map->seams[index].segment;
    return second ? &at->b : &at->a;
}

static bool hold(app_state *app, int kind, size_t index, bool second) {
    const sl_status status = SL_ARRAY_ROOM(app->context, &app->tool.ends, 1);
    app_check(app, status);
    if (status != SL_OK) return false;
    app->tool.ends.items[app->tool.ends.count++] =
        (held_end){kind, index, second, *end_of(&app->document.map, kind, index, second)};
    return true;
}

/// A baked file has its doors and glass cut to pieces: they stay where they are.
static int kinds_that_move(const app_state *app) {
    const char *path = app->document.source.path;
    return path && document_is_baked(path) ? DOORS : KINDS;
}

/// The end of a wall or door under a place. Short walls keep room between their corners.
static bool find_corner(const app_state *app, sl_point at, sl_point *found) {
    const sl_map *map = &app->document.map;
    double nearest = INFINITY;
    for (int kind = WALLS; kind <= DOORS && kind < kinds_that_move(app); kind++)
        for (size_t i = 0; i < count_of(map, kind); i++) {
            const sl_point ends[2] = {*end_of(map, kind, i, false), *end_of(map, kind, i, true)};
            const double length = hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y);
            const double room = fmin(1.2 * edit_reach(app), length / 4);
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
static void hold_corner(app_state *app, sl_point at) {
    const sl_map *map = &app->document.map;
    for (int kind = 0; kind < kinds_that_move(app); kind++)
        for (size_t i = 0; i < count_of(map, kind); i++)
            for (int k = 0; k < 2; k++) {
                const sl_point end = *end_of(map, kind, i, k);
                if (hypot(end.x - at.x, end.y - at.y) <= app->document.weld) hold(app, kind, i, k);
            }
}

static uint32_t pick_door(const app_state *app, sl_point at) {
    return kinds_that_move(app) > DOORS ? door_at(app, at) : UINT32_MAX;
}

drag_kind edit_take(app_state *app, drag_state *drag) {
    sl_point corner;
    app->tool.ends.count = 0;
    drag->segment = (sl_segment){{0, 0}, {0, 0}};
    app->tool.chosen = UINT32_MAX;
    if (!app->tool.draws_doors && find_corner(app, drag->at, &corner)) {
        hold_corner(app, corner);
        return DRAG_CORNER;
    }
    const uint32_t door = pick_door(app, drag->at);
    const int kind = door == UINT32_MAX ? WALLS : DOORS;
    if (app->tool.draws_doors && kind == WALLS) return DRAG_NEW_DOOR;
    app->tool.chosen_kind = kind;
    app->tool.chosen = kind == WALLS ? pick_along(app, drag->at, drag->at) : door;
    if (app->tool.chosen == UINT32_MAX) return DRAG_NEW_WALL;
    hold(app, kind, app->tool.chosen, false);
    hold(app, kind, app->tool.chosen, true);
    return kind == WALLS ? DRAG_WALL : DRAG_DOOR;
}

static bool is_same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

static bool is_usable(sl_point p) {
    return sl_coordinate_usable(p.x) && sl_coordinate_usable(p.y);
}

/// Where a held end is when the drag is at a place: corners on the grid, the rest by whole steps.
static sl_point place_of(const app_state *app, const drag_state *drag, const held_end *end,
                         sl_point now) {
    const double step = edit_step(app);
    if (drag->kind == DRAG_CORNER || drag->kind == DRAG_NEW_WALL) return edit_snap(app, now);
    return (sl_point){end->was.x + step * round((now.x - drag->at.x) / step),
                      end->was.y + step * round((now.y - drag->at.y) / step)};
}

/// Whether all ends can go there, and one of them is not there yet. No segment may lose its length.
static bool can_go(const app_state *app, const drag_state *drag, sl_point now) {
    const sl_map *map = &app->document.map;
    const bool whole = drag->kind == DRAG_WALL || drag->kind == DRAG_DOOR;
    bool any = false;
    for (size_t i = 0; i < app->tool.ends.count; i++) {
        const held_end *e = &app->tool.ends.items[i];
        const sl_point to = place_of(app, drag, e, now);
        if (e->index >= count_of(map, e->kind) || !is_usable(to)) return false;
        if (!whole && is_same(to, *end_of(map, e->kind, e->index, !e->second))) return false;
        any |= !is_same(to, *end_of(map, e->kind, e->index, e->second));
    }
    return any;
}

/// Keeps the map for undo. Walls that are moved are no longer the sides of the solid ground that
/// the file speaks of: where they contradict each other, ground is open from now on.
static void begin_change(app_state *app, drag_state *drag) {
    app_before_edit(app);
    app->document.map.ground_guessed = true;
    drag->changed = true;
}

/// A new wall begins where the pointer was pressed. Its second end is held.
static bool begin_wall(app_state *app, drag_state *drag, sl_point now) {
    const sl_point from = edit_snap(app, drag->at), to = edit_snap(app, now);
    if (is_same(from, to) || !is_usable(from) || !is_usable(to)) return false;
    begin_change(app, drag);
    const sl_status status = sl_map_add_wall(app->context, &app->document.map, from, to, 0);
    app_check(app, status);
    return status == SL_OK && hold(app, WALLS, app->document.map.wall_count - 1, true);
}

// --- new doors

/// The place of a wall nearest to a place of the grid; near an end of the wall, that end.
static sl_point place_on(const app_state *app, const sl_wall *wall, sl_point at) {
    const sl_point a = wall->a, b = wall->b, to = edit_snap(app, at);
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double share = ((to.x - a.x) * dx + (to.y - a.y) * dy) / (dx * dx + dy * dy);
    if (share <= 0 || hypot(at.x - a.x, at.y - a.y) <= edit_reach(app)) return a;
    if (share >= 1 || hypot(at.x - b.x, at.y - b.y) <= edit_reach(app)) return b;
    if (dx == 0) return (sl_point){a.x, to.y};
    if (dy == 0) return (sl_point){to.x, a.y};
    return (sl_point){a.x + share * dx, a.y + share * dy};
}

/// The place of a corner that is near, else of the grid.
static sl_point place_at(const app_state *app, sl_point at) {
    sl_point corner;
    return find_corner(app, at, &corner) ? corner : edit_snap(app, at);
}

/// Along a wall a door lies in that wall; UINT32_MAX: along none.
static sl_segment door_between(const app_state *app, uint32_t along, sl_point from, sl_point to) {
    if (along == UINT32_MAX) return (sl_segment){place_at(app, from), place_at(app, to)};
    const sl_wall *wall = &app->document.map.walls[along];
    return (sl_segment){place_on(app, wall, from), place_on(app, wall, to)};
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
static bool begin_door(app_state *app, drag_state *drag, sl_segment at) {
    sl_map *map = &app->document.map;
    char name[32];
    begin_change(app, drag);
    name_door(map, name);
    const sl_status status = sl_map_add_door(app->context, map, name, at, true, 0);
    app_check(app, status);
    return status == SL_OK && hold(app, DOORS, map->door_count - 1, false) &&
           hold(app, DOORS, map->door_count - 1, true);
}

/// The drag's index is the wall that the door lies in.
static void drag_door(app_state *app, drag_state *drag, sl_point now) {
    const uint32_t along = pick_along(app, drag->at, now);
    const sl_segment at = door_between(app, along, drag->at, now);
    if (is_same(at.a, at.b) || !is_usable(at.a) || !is_usable(at.b)) return;
    drag->index = along;
    if (!drag->changed) {
        if (begin_door(app, drag, at)) app_after_step(app);
        return;
    }
    sl_map *map = &app->document.map;
    if (!app->tool.ends.count || app->tool.ends.items[0].index >= map->door_count) return;
    sl_segment *door = &map->doors[app->tool.ends.items[0].index].segment;
    if (is_same(door->a, at.a) && is_same(door->b, at.b)) return;
    *door = at;
    app_after_step(app);
}

static void say_last_wall(app_state *app) {
    ui_say(&app->ui, true, "the last wall stays: a map without walls has no cells");
}

/// Leaves of a wall what is beside the door in it; false if that is the last wall and nothing is.
static bool cut_wall(app_state *app, uint32_t wall, sl_segment door) {
    sl_map *map = &app->document.map;
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
            app_check(app, sl_map_add_walls(app->context, map, &parts[i], 1));
    return true;
}

// --- drags

void edit_drag(app_state *app, drag_state *drag, sl_point now) {
    if (drag->kind == DRAG_NEW_DOOR) {
        drag_door(app, drag, now);
        return;
    }
    if (drag->kind == DRAG_NEW_WALL && !drag->changed) {
        if (begin_wall(app, drag, now)) app_after_step(app);
        return;
    }
    if (!can_go(app, drag, now)) return;
    if (!drag->changed) begin_change(app, drag);
    for (size_t i = 0; i < app->tool.ends.count; i++) {
        const held_end *e = &app->tool.ends.items[i];
        *end_of(&app->document.map, e->kind, e->index, e->second) = place_of(app, drag, e, now);
    }
    app_after_step(app);
}

/// Says where things are now.
static void say_moved(app_state *app, const drag_state *drag) {
    const held_end *e = &app->tool.ends.items[0];
    const sl_point at = *end_of(&app->document.map, e->kind, e->index, e->second);
    if (drag->kind == DRAG_NEW_WALL) {
        const sl_point from = *end_of(&app->document.map, WALLS, e->index, false);
        ui_say(&app->ui, false, "wall from %.10g,%.10g to %.10g,%.10g", from.x, from.y, at.x, at.y);
    } else if (drag->kind == DRAG_NEW_DOOR) {
        const sl_door *door = &app->document.map.doors[e->index];
        const sl_segment s = door->segment;
        ui_say(&app->ui, false,
               "%s from %.10g,%.10g to %.10g,%.10g, open; in Explore a click shuts it", door->name,
               s.a.x, s.a.y, s.b.x, s.b.y);
    } else if (drag->kind == DRAG_CORNER) {
        ui_say(&app->ui, false, "corner at %.10g,%.10g, %zu end%s moved", at.x, at.y,
               app->tool.ends.count, app->tool.ends.count == 1 ? "" : "s");
    } else {
        ui_say(&app->ui, false, "%s moved by %g,%g", drag->kind == DRAG_DOOR ? "door" : "wall",
               at.x - e->was.x, at.y - e->was.y);
    }
}

void edit_drop(app_state *app, const drag_state *drag) {
    sl_map *map = &app->document.map;
    bool moved = drag->kind == DRAG_NEW_WALL || drag->kind == DRAG_NEW_DOOR;
    for (size_t i = 0; i < app->tool.ends.count && drag->changed; i++) {
        const held_end *e = &app->tool.ends.items[i];
        if (e->index >= count_of(map, e->kind)) return;
        moved |= !is_same(e->was, *end_of(map, e->kind, e->index, e->second));
    }
    if (drag->changed && app->tool.ends.count) {
        if (moved) say_moved(app, drag);
        if (drag->kind == DRAG_NEW_DOOR && drag->index < map->wall_count &&
            !cut_wall(app, drag->index, map->doors[app->tool.ends.items[0].index].segment)) {
            say_last_wall(app);
            moved = false;
        }
        if (!moved) history_take_back(app->context, &app->document.history, map);
        app->tool.chosen = UINT32_MAX;
        app_after_edit(app);
    }
    app->tool.ends.count = 0;
}

bool edit_cancel(app_state *app) {
    const drag_state drag = app->tool.drag;
    if (drag.kind < DRAG_NEW_WALL || drag.kind > DRAG_MIRROR) return false;
    app->tool.drag = (drag_state){0};
    app->tool.ends.count = 0;
    if (drag.changed &&
        history_take_back(app->context, &app->document.history, &app->document.map)) {
        app->tool.chosen = UINT32_MAX;
        ui_say(&app->ui, false, "everything is back where it was");
        app_after_edit(app);
    }
    return true;
}

static void drop_door(app_state *app, uint32_t door) {
    sl_map *map = &app->document.map;
    sl_free(app->context, map->doors[door].name);
    sl_free(app->context, map->doors[door].parts);
    map->doors[door] = map->doors[--map->door_count];
}

void edit_delete(app_state *app) {
    sl_map *map = &app->document.map;
    const uint32_t chosen = app->tool.chosen;
    const bool door = app->tool.chosen_kind == DOORS;
    if (app->tool.drag.changed) return; // what is held stays
    if (chosen >= count_of(map, app->tool.chosen_kind)) {
        ui_say(&app->ui, false, "nothing is chosen: click on a wall or a door");
        return;
    }
    if (!door && map->wall_count == 1) {
        say_last_wall(app);
        return;
    }
    app_before_edit(app);
    map->ground_guessed = true;
    if (door)
        drop_door(app, chosen);
    else
        map->walls[chosen] = map->walls[--map->wall_count];
    app->tool.chosen = UINT32_MAX;
    ui_say(&app->ui, false, "%s deleted", door ? "door" : "wall");
    app_after_edit(app);
}

static void draw_grid(app_state *app, const sl_frame *frame) {
    const double step = edit_step(app), size = fmax(frame->unit, 1);
    const double x0 = step * ceil(frame->corner.x / step);
    const double y0 = step * ceil(frame->corner.y / step);
    const int columns = (int)(frame->width / frame->scale / step) + 1;
    const int rows = (int)(frame->height / frame->scale / step) + 1;
    for (int i = 0; i < columns && columns < 1000; i++)
        for (int k = 0; k < rows && rows < 1000; k++) {
            const sl_point at = sl_frame_point(frame, (sl_point){x0 + i * step, y0 + k * step});
            cairo_rectangle(app->ui.cairo, floor(at.x), floor(at.y), size, size);
        }
    const sl_colour c = app->ui.palette.faint;
    cairo_set_source_rgba(app->ui.cairo, c.red, c.green, c.blue, 0.4);
    cairo_fill(app->ui.cairo);
}

/// Marks the corner that is held, or the one under the pointer.
static void draw_corner(app_state *app, const sl_frame *frame, sl_point pointer) {
    const drag_state *drag = &app->tool.drag;
    sl_point corner, at;
    if (drag->kind == DRAG_CORNER || (drag->kind == DRAG_NEW_WALL && drag->changed)) {
        const held_end *e = app->tool.ends.items;
        if (!app->tool.ends.count || e->index >= count_of(&app->document.map, e->kind)) return;
        corner = *end_of(&app->document.map, e->kind, e->index, e->second);
    } else if (drag->kind != DRAG_NONE || !find_corner(app, pointer, &corner)) {
        return;
    }
    if (!sl_frame_holds(frame, corner, &at)) return;
    cairo_new_path(app->ui.cairo);
    cairo_arc(app->ui.cairo, at.x, at.y, 5 * frame->unit, 0, 6.283185307179586);
    sl_set_colour(app->ui.cairo, app->ui.palette.start);
    cairo_fill(app->ui.cairo);
}

/// Draws each segment of which an end is held where it is now, however late the plan is.
static void draw_held(app_state *app, const sl_frame *frame) {
    const sl_map *map = &app->document.map;
    for (size_t i = 0; i < app->tool.ends.count && app->tool.drag.changed; i++) {
        const held_end *e = &app->tool.ends.items[i];
        if (e->index >= count_of(map, e->kind)) return;
        sl_draw_line(app->ui.cairo, frame, *end_of(map, e->kind, e->index, false),
                     *end_of(map, e->kind, e->index, true), app->ui.palette.start, 4 * frame->unit);
    }
}

void edit_draw(app_state *app, const sl_frame *frame) {
    const sl_map *map = &app->document.map;
    const sl_colour colour = app->ui.palette.start;
    draw_grid(app, frame);
    const window_layout l = app_layout(app);
    const int kind = app->tool.chosen_kind;
    if (app->tool.chosen < count_of(map, kind))
        sl_draw_line(app->ui.cairo, frame, *end_of(map, kind, app->tool.chosen, false),
                     *end_of(map, kind, app->tool.chosen, true), colour, 5 * frame->unit);
    draw_held(app, frame);
    if (box_has(l.plan[0], app->tool.pointer))
        draw_corner(app, frame, camera_point(&app->view.camera, l.plan[0], app->tool.pointer));
}
