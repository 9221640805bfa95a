/// What a map has beside walls, in words and by hand: doors turn, mirrors and objects are dragged,
/// the view range is set. A change that needs no bake shows at once; others follow from the
/// background.
#include "plan/effects.h"

#include "plan/grid.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- in words

static void append_words(char text[CALLS_TEXT], const char *before, const char *more) {
    const size_t used = strlen(text);
    snprintf(text + used, CALLS_TEXT - used, "%s%s", before, more);
}

void effects_left_out(const sl_map *map, char text[CALLS_TEXT]) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    text[0] = '\0';
    for (size_t i = 0; i < count; i++)
        if (!(called_for >> i & 1)) append_words(text, *text ? ", " : "", effects[i]->several);
}

void effects_in_words(const sl_map *map, char text[CALLS_TEXT]) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    text[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        char counted[64];
        if (!(called_for >> i & 1)) continue;
        snprintf(counted, sizeof counted, "%s (%zu)", effects[i]->several, effects[i]->count(map));
        append_words(text, *text ? ", " : "calls for ", counted);
    }
}

// --- doors

static uint32_t nearest_door(const document_state *document, sl_point at, double within) {
    const sl_map *map = &document->map;
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->door_count; i++) {
        const double distance = grid_distance(at, map->doors[i].segment.a, map->doors[i].segment.b);
        if (distance > within) continue;
        within = distance;
        found = (uint32_t)i;
    }
    return found;
}

uint32_t door_at(const view_state *view, sl_point at) {
    return nearest_door(view->document, at, grid_reach(view));
}

void door_toggle(view_state *view, uint32_t door) {
    sl_map *map = &view->document->map;
    if (door >= map->door_count) return;
    const bool open = !map->doors[door].open;
    size_t parts = 0;
    view_keep(view);
    for (size_t i = 0; i < map->door_count; i++) {
        if (strcmp(map->doors[i].name, map->doors[door].name) != 0) continue;
        map->doors[i].open = open;
        parts++;
    }
    view_after_touch(view);
    char several[32] = "";
    if (parts > 1) snprintf(several, sizeof several, " (%zu parts)", parts);
    ui_say(view->ui, false, "door %s is %s%s", map->doors[door].name, open ? "open" : "shut",
           several);
}

void door_toggle_nearest(view_state *view) {
    const uint32_t door = nearest_door(view->document, view->eye.at, INFINITY);
    if (door == UINT32_MAX)
        ui_say(view->ui, false, "this map has no doors");
    else
        door_toggle(view, door);
}

// --- mirrors

static double distance(sl_point a, sl_point b) {
    return hypot(a.x - b.x, a.y - b.y);
}

/// The mirror under a place of the plan, and which part of it; UINT32_MAX for none.
static uint32_t mirror_at(const view_state *view, sl_point at, grip *part) {
    const sl_map *map = &view->document->map;
    double within = grid_reach(view);
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->mirror_count; i++) {
        const sl_segment s = map->mirrors[i].segment;
        const double off = grid_distance(at, s.a, s.b);
        if (off > within) continue;
        within = off;
        found = (uint32_t)i;
        // An end has more room around it, but no more than a quarter of the mirror.
        const double room = fmin(1.5 * grid_reach(view), distance(s.a, s.b) / 4);
        *part = distance(at, s.a) <= room   ? GRIP_A
                : distance(at, s.b) <= room ? GRIP_B
                                            : GRIP_WHOLE;
    }
    return found;
}

bool mirror_take(view_state *view, drag_state *drag) {
    grip part;
    drag->index = mirror_at(view, drag->at, &part);
    if (drag->index == UINT32_MAX) return false;
    drag->part = part;
    drag->segment = view->document->map.mirrors[drag->index].segment;
    return true;
}

static bool is_usable(sl_segment s) {
    return sl_coordinate_usable(s.a.x) && sl_coordinate_usable(s.a.y) &&
           sl_coordinate_usable(s.b.x) && sl_coordinate_usable(s.b.y) &&
           (s.a.x != s.b.x || s.a.y != s.b.y);
}

void mirror_move(view_state *view, drag_state *drag, sl_point now) {
    sl_map *map = &view->document->map;
    if (drag->index >= map->mirror_count) return;
    const sl_point by = grid_moved(view, drag->at, now);
    sl_segment to = drag->segment;
    if (drag->part == GRIP_A) to.a = grid_snap(view, now);
    if (drag->part == GRIP_B) to.b = grid_snap(view, now);
    if (drag->part == GRIP_WHOLE) {
        to.a = (sl_point){to.a.x + by.x, to.a.y + by.y};
        to.b = (sl_point){to.b.x + by.x, to.b.y + by.y};
    }
    const sl_segment is = map->mirrors[drag->index].segment;
    const bool same = to.a.x == is.a.x && to.a.y == is.a.y && to.b.x == is.b.x && to.b.y == is.b.y;
    if (same || !is_usable(to)) return;
    if (view->document->source.path && document_is_baked(view->document->source.path)) {
        ui_say(view->ui, true, "mirrors of a baked file stay: open the map that it was made from");
        return;
    }
    if (!drag->changed) view_before_edit(view);
    drag->changed = true;
    map->mirrors[drag->index].segment = to;
    view_after_step(view);
}

void mirror_drop(view_state *view, const drag_state *drag) {
    const sl_map *map = &view->document->map;
    if (!drag->changed || drag->index >= map->mirror_count) return;
    const sl_segment s = map->mirrors[drag->index].segment;
    ui_say(view->ui, false, "mirror from %.10g,%.10g to %.10g,%.10g", s.a.x, s.a.y, s.b.x, s.b.y);
    view_after_edit(view);
}

void mirror_set_depth(view_state *view, uint32_t depth) {
    if (depth == view->document->mirror_depth) return;
    view->document->mirror_depth = depth;
    view_after_touch(view);
}

void mirror_settle_depth(view_state *view) {
    if (view->document->baked_depth != view->document->mirror_depth) view_after_edit(view);
}

void mirror_draw(view_state *view, const sl_frame *frame) {
    const sl_map *map = &view->document->map;
    const bool held = view->drag.kind == DRAG_MIRROR;
    grip part;
    uint32_t mirror = held ? view->drag.index : UINT32_MAX;
    sl_point pointed;
    if (view->drag.kind == DRAG_NONE && view_pointed(view, &pointed))
        mirror = mirror_at(view, pointed, &part);
    if (mirror >= map->mirror_count) return;
    const sl_segment s = map->mirrors[mirror].segment;
    sl_draw_line(view->ui->cairo, frame, s.a, s.b, view->ui->palette.start, 4 * frame->unit);
    view_mark(view, frame, s.a);
    view_mark(view, frame, s.b);
}

// --- objects

static double distance_to_border(sl_box b, sl_point at) {
    const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    double nearest = INFINITY;
    for (int i = 0; i < 4; i++)
        nearest = fmin(nearest, grid_distance(at, corners[i], corners[(i + 1) % 4]));
    return nearest;
}

uint32_t object_at(const view_state *view, sl_point at) {
    const sl_map *map = &view->document->map;
    double within = grid_reach(view);
    uint32_t found = UINT32_MAX;
    if (!(view->show & SHOW_STARTS)) return UINT32_MAX;
    for (size_t i = 0; i < map->object_count && i < view->document->object_count; i++) {
        const double off = distance_to_border(map->objects[i].box, at);
        if (off > within) continue;
        within = off;
        found = (uint32_t)i;
    }
    return found;
}

bool object_take(view_state *view, drag_state *drag) {
    drag->index = object_at(view, drag->at);
    if (drag->index == UINT32_MAX) return false;
    const sl_box box = view->document->map.objects[drag->index].box;
    drag->segment = (sl_segment){box.min, box.max};
    return true;
}

void object_move(view_state *view, drag_state *drag, sl_point now) {
    sl_map *map = &view->document->map;
    if (drag->index >= map->object_count) return;
    const sl_point by = grid_moved(view, drag->at, now);
    const sl_box to = {{drag->segment.a.x + by.x, drag->segment.a.y + by.y},
                       {drag->segment.b.x + by.x, drag->segment.b.y + by.y}};
    sl_box *box = &map->objects[drag->index].box;
    if (to.min.x == box->min.x && to.min.y == box->min.y) return;
    if (!sl_coordinate_usable(to.min.x) || !sl_coordinate_usable(to.min.y) ||
        !sl_coordinate_usable(to.max.x) || !sl_coordinate_usable(to.max.y))
        return;
    if (!drag->changed) view_keep(view);
    drag->changed = true;
    *box = to;
    ui_say(view->ui, false, "%s at %.10g,%.10g", map->objects[drag->index].name, to.min.x,
           to.min.y);
    view_after_touch(view);
}

void object_toggle(view_state *view, uint32_t object) {
    document_state *document = view->document;
    if (object >= document->object_count) return;
    document->blocks[object] = !document->blocks[object];
    view_after_touch(view);
    if (document->blocks[object] && view->present.still) {
        document->blocks[object] = false;
        view_after_touch(view);
        ui_say(view->ui, true, "objects cannot block sight from here");
        return;
    }
    ui_say(view->ui, false, "%s %s", document->map.objects[object].name,
           document->blocks[object] ? "blocks sight" : "is seen through");
}

void object_describe(const view_state *view, uint32_t object, char *text, size_t room) {
    const bool blocks = view->document->blocks[object];
    const seen_state *seen = &view->seen;
    const bool known = seen->valid && object < seen->object_count;
    snprintf(text, room, "%s: %s, %s. Drag it; a click has it %s.",
             view->document->map.objects[object].name,
             known && seen->objects[object]            ? "seen by the eye"
             : known && seen->objects_mirrored[object] ? "seen by mirror"
                                                       : "not seen",
             blocks ? "blocks sight" : "seen through", blocks ? "seen through" : "block sight");
}

void object_draw(view_state *view, const sl_frame *frame) {
    const sl_map *map = &view->document->map;
    cairo_t *cairo = view->ui->cairo;
    const sl_palette *palette = &view->ui->palette;
    uint32_t held = view->drag.kind == DRAG_OBJECT ? view->drag.index : UINT32_MAX;
    sl_point at;
    if (view->drag.kind == DRAG_NONE && view_pointed(view, &at)) held = object_at(view, at);
    if (!view->seen.valid || !(view->show & SHOW_STARTS)) return;
    for (size_t i = 0; i < map->object_count && i < view->seen.object_count; i++) {
        const sl_box b = map->objects[i].box;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        const bool blocks = view->document->blocks[i], seen = view->seen.objects[i];
        if (!blocks && !seen && i != held) continue;
        sl_path_polygon(cairo, frame, corners, 4);
        const sl_colour fill = blocks ? palette->wall : palette->start;
        cairo_set_source_rgba(cairo, fill.red, fill.green, fill.blue, blocks ? 0.45 : 0.25);
        if (blocks || seen) cairo_fill_preserve(cairo);
        const bool marked = seen || i == held;
        sl_set_colour(cairo, marked ? palette->start : palette->wall);
        cairo_set_line_width(cairo, (i == held ? 4 : 2) * frame->unit);
        cairo_stroke(cairo);
    }
}

// --- the view range

double range_most(const document_state *document) {
    const sl_box b = document->baked->space.bounds;
    return hypot(b.max.x - b.min.x, b.max.y - b.min.y);
}

/// Rounds to three digits, so that one can read it.
static double rounded(double range) {
    const double step = pow(10, floor(log10(range)) - 2);
    return step * round(range / step);
}

void range_set(view_state *view, double range) {
    view->document->map.range = rounded(fmax(range, 1e-3 * range_most(view->document)));
    view_after_touch(view);
}

void range_settle(view_state *view) {
    const kept_maps *done = &view->document->history.done;
    if (done->count && done->items[done->count - 1].map.range == view->document->map.range)
        history_forget_last(view->context, &view->document->history);
    if (view->document->baked->map.range != view->document->map.range) view_after_edit(view);
}

void range_toggle(view_state *view) {
    if (!view->document->baked) return;
    view_keep(view);
    view->document->map.range =
        view->document->map.range > 0 ? 0 : rounded(fmax(0.3 * range_most(view->document), 1e-100));
    view_after_touch(view);
    range_settle(view);
    if (view->document->map.range > 0)
        ui_say(view->ui, false, "nothing farther than %g is seen; the slider changes that",
               view->document->map.range);
    else
        ui_say(view->ui, false, "sight reaches any distance");
}

void range_draw(view_state *view, const sl_frame *frame) {
    cairo_t *cairo = view->ui->cairo;
    const double radius = view->document->map.range * frame->scale;
    const double dashes[] = {5 * frame->unit, 4 * frame->unit};
    sl_point at;
    // One that is larger than what cairo can hold is nowhere near the page's middle either.
    if (!(radius > 0) || radius > 1e5 || !sl_frame_holds(frame, view->eye.at, &at)) return;
    cairo_save(cairo);
    cairo_new_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, 6.283185307179586);
    sl_set_colour(cairo, view->ui->palette.start);
    cairo_set_line_width(cairo, 1.4 * frame->unit);
    cairo_set_dash(cairo, dashes, 2, 0);
    cairo_stroke(cairo);
    cairo_restore(cairo);
}
