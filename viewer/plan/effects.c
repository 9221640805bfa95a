/// What a map has beside walls, in words and by hand: doors turn, mirrors and objects are dragged,
/// the view range is set. A change that needs no bake shows at once; others follow from the
/// background.
#include "plan/effects.h"

#include "app/modes.h"
#include "plan/edit.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- in words

static void append(char text[CALLS_TEXT], const char *before, const char *more) {
    const size_t used = strlen(text);
    snprintf(text + used, CALLS_TEXT - used, "%s%s", before, more);
}

void effects_left_out(const sl_map *map, char text[CALLS_TEXT]) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    text[0] = '\0';
    for (size_t i = 0; i < count; i++)
        if (!(called_for >> i & 1)) append(text, *text ? ", " : "", effects[i]->several);
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
        append(text, *text ? ", " : "calls for ", counted);
    }
}

// --- the pane

/// Lists the effects, each with the stages that it adds; returns the base line below.
static double draw_found(app_state *app, sl_box box, double y) {
    ui_state *ui = &app->ui;
    const sl_map *map = &app->document.map;
    const double t = ui->text, left = box.min.x + 1.1 * t, right = box.max.x - t;
    // A narrow pane has the words below the name.
    const bool beside = right - left > 24 * t;
    const double words = beside ? left + 10 * t : left;
    const unsigned called_for = sl_plan_make(map).effects;
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    for (size_t i = 0; i < count; i++) {
        char name[64];
        if (!(called_for >> i & 1)) continue;
        snprintf(name, sizeof name, "%s (%zu)", effects[i]->several, effects[i]->count(map));
        const double below = ui_lines(ui, left, y, beside ? 9.5 * t : right - left, 0.95, true,
                                      ui->palette.ink, name);
        y = fmax(below, ui_paragraph(ui, words, beside ? y : below, right - words, 0.95,
                                     ui->palette.ink, effects[i]->adds));
    }
    return y;
}

/// What the bake did for them.
static void write_work(const document_state *document, char text[256]) {
    if (!document->has_visibility) {
        snprintf(text, 256, "What cells see is being worked out.");
        return;
    }
    const sl_visibility *v = &document->baked->visibility;
    const sl_see_account *a = &v->account;
    int length = snprintf(text, 256, "Baked by %s", document->baked->method);
    if (v->mirrored.cell_count)
        length += snprintf(text + length, 256 - (size_t)length, "; %llu pairs seen by mirror",
                           (unsigned long long)a->mirrored_pairs);
    if (v->doors.cell_count)
        length += snprintf(text + length, 256 - (size_t)length,
                           "; %llu bytes for pairs that depend on doors, %llu pairs over the limit",
                           (unsigned long long)sl_door_sets_bytes(&v->doors),
                           (unsigned long long)a->effects.door_fallbacks);
    if (a->effects.range_tests)
        length += snprintf(text + length, 256 - (size_t)length,
                           "; %llu sightlines held against the range",
                           (unsigned long long)a->effects.range_tests);
    snprintf(text + length, 256 - (size_t)length, ".");
}

void pane_effects(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const double t = ui->text, left = box.min.x + 1.1 * t, wide = box_width(box) - 2.2 * t;
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    const sl_box room = {{box.min.x, box.min.y + 1}, box.max};
    double y = ui_begin_scroll(ui, SCROLL_EFFECTS, room);
    y = ui_lines(ui, left, y + 1.6 * t, wide, 1, true, ui->palette.ink, "What the map calls for");
    box.max.x -= ui_bar_width(ui);
    y = draw_found(app, box, y + 0.2 * t);
    char text[256], none[CALLS_TEXT];
    effects_left_out(&app->document.map, none);
    if (none[0]) {
        snprintf(text, sizeof text, "Left out, as nothing calls for it: %s.", none);
        y = ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    }
    write_work(&app->document, text);
    y = ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    ui_end_scroll(ui, room, y - 0.6 * t);
    ui_end_area(ui);
}

// --- doors

static uint32_t nearest_door(const document_state *document, sl_point at, double within) {
    const sl_map *map = &document->map;
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->door_count; i++) {
        const double distance = edit_distance(at, map->doors[i].segment.a, map->doors[i].segment.b);
        if (distance > within) continue;
        within = distance;
        found = (uint32_t)i;
    }
    return found;
}

uint32_t door_at(const app_state *app, sl_point at) {
    return nearest_door(&app->document, at, edit_reach(app));
}

void door_toggle(app_state *app, uint32_t door) {
    sl_map *map = &app->document.map;
    if (door >= map->door_count) return;
    const bool open = !map->doors[door].open;
    size_t parts = 0;
    app_keep(app);
    for (size_t i = 0; i < map->door_count; i++) {
        if (strcmp(map->doors[i].name, map->doors[door].name) != 0) continue;
        map->doors[i].open = open;
        parts++;
    }
    app_after_touch(app);
    char several[32] = "";
    if (parts > 1) snprintf(several, sizeof several, " (%zu parts)", parts);
    ui_say(&app->ui, false, "door %s is %s%s", map->doors[door].name, open ? "open" : "shut",
           several);
}

void door_toggle_nearest(app_state *app) {
    const uint32_t door = nearest_door(&app->document, app->view.eye.at, INFINITY);
    if (door == UINT32_MAX)
        ui_say(&app->ui, false, "this map has no doors");
    else
        door_toggle(app, door);
}

// --- mirrors

static double distance(sl_point a, sl_point b) {
    return hypot(a.x - b.x, a.y - b.y);
}

uint32_t mirror_at(const app_state *app, sl_point at, grip *part) {
    const sl_map *map = &app->document.map;
    double within = edit_reach(app);
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->mirror_count; i++) {
        const sl_segment s = map->mirrors[i].segment;
        const double off = edit_distance(at, s.a, s.b);
        if (off > within) continue;
        within = off;
        found = (uint32_t)i;
        // An end has more room around it, but no more than a quarter of the mirror.
        const double room = fmin(1.5 * edit_reach(app), distance(s.a, s.b) / 4);
        *part = distance(at, s.a) <= room   ? GRIP_A
                : distance(at, s.b) <= room ? GRIP_B
                                            : GRIP_WHOLE;
    }
    return found;
}

bool mirror_take(app_state *app, drag_state *drag) {
    grip part;
    drag->index = mirror_at(app, drag->at, &part);
    if (drag->index == UINT32_MAX) return false;
    drag->part = part;
    drag->segment = app->document.map.mirrors[drag->index].segment;
    return true;
}

static bool usable(sl_segment s) {
    return sl_coordinate_usable(s.a.x) && sl_coordinate_usable(s.a.y) &&
           sl_coordinate_usable(s.b.x) && sl_coordinate_usable(s.b.y) &&
           (s.a.x != s.b.x || s.a.y != s.b.y);
}

void mirror_move(app_state *app, drag_state *drag, sl_point now) {
    sl_map *map = &app->document.map;
    if (drag->index >= map->mirror_count) return;
    const double step = edit_step(app);
    const double dx = step * round((now.x - drag->at.x) / step);
    const double dy = step * round((now.y - drag->at.y) / step);
    sl_segment to = drag->segment;
    if (drag->part == GRIP_A) to.a = edit_snap(app, now);
    if (drag->part == GRIP_B) to.b = edit_snap(app, now);
    if (drag->part == GRIP_WHOLE) {
        to.a = (sl_point){to.a.x + dx, to.a.y + dy};
        to.b = (sl_point){to.b.x + dx, to.b.y + dy};
    }
    const sl_segment is = map->mirrors[drag->index].segment;
    const bool same = to.a.x == is.a.x && to.a.y == is.a.y && to.b.x == is.b.x && to.b.y == is.b.y;
    if (same || !usable(to)) return;
    if (app->document.source.path && document_is_baked(app->document.source.path)) {
        ui_say(&app->ui, true, "mirrors of a baked file stay: open the map that it was made from");
        return;
    }
    if (!drag->changed) app_before_edit(app);
    drag->changed = true;
    map->mirrors[drag->index].segment = to;
    app_after_step(app);
}

void mirror_drop(app_state *app, const drag_state *drag) {
    const sl_map *map = &app->document.map;
    if (!drag->changed || drag->index >= map->mirror_count) return;
    const sl_segment s = map->mirrors[drag->index].segment;
    ui_say(&app->ui, false, "mirror from %.10g,%.10g to %.10g,%.10g", s.a.x, s.a.y, s.b.x, s.b.y);
    app_after_edit(app);
}

void mirror_set_depth(app_state *app, uint32_t depth) {
    if (depth == app->document.mirror_depth) return;
    app->document.mirror_depth = depth;
    app_after_touch(app);
}

void mirror_settle_depth(app_state *app) {
    if (app->document.baked_depth != app->document.mirror_depth) app_after_edit(app);
}

void mirror_draw(app_state *app, const sl_frame *frame) {
    const sl_map *map = &app->document.map;
    const bool held = app->tool.drag.kind == DRAG_MIRROR;
    const window_layout l = app_layout(app);
    grip part;
    uint32_t mirror = held ? app->tool.drag.index : UINT32_MAX;
    if (app->tool.drag.kind == DRAG_NONE && box_has(l.plan[0], app->tool.pointer))
        mirror =
            mirror_at(app, camera_point(&app->view.camera, l.plan[0], app->tool.pointer), &part);
    if (mirror >= map->mirror_count) return;
    const sl_segment s = map->mirrors[mirror].segment;
    sl_draw_line(app->ui.cairo, frame, s.a, s.b, app->ui.palette.start, 4 * frame->unit);
    for (int i = 0; i < 2; i++) {
        sl_point at;
        if (!sl_frame_holds(frame, i ? s.b : s.a, &at)) continue;
        cairo_new_path(app->ui.cairo);
        cairo_arc(app->ui.cairo, at.x, at.y, 5 * frame->unit, 0, 6.283185307179586);
        sl_set_colour(app->ui.cairo, app->ui.palette.start);
        cairo_fill(app->ui.cairo);
    }
}

// --- objects

static double distance_to_border(sl_box b, sl_point at) {
    const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    double nearest = INFINITY;
    for (int i = 0; i < 4; i++)
        nearest = fmin(nearest, edit_distance(at, corners[i], corners[(i + 1) % 4]));
    return nearest;
}

uint32_t object_at(const app_state *app, sl_point at) {
    const sl_map *map = &app->document.map;
    double within = edit_reach(app);
    uint32_t found = UINT32_MAX;
    if (!(app->view.show & SHOW_STARTS)) return UINT32_MAX;
    for (size_t i = 0; i < map->object_count && i < app->document.object_count; i++) {
        const double off = distance_to_border(map->objects[i].box, at);
        if (off > within) continue;
        within = off;
        found = (uint32_t)i;
    }
    return found;
}

bool object_take(app_state *app, drag_state *drag) {
    drag->index = object_at(app, drag->at);
    if (drag->index == UINT32_MAX) return false;
    const sl_box box = app->document.map.objects[drag->index].box;
    drag->segment = (sl_segment){box.min, box.max};
    return true;
}

void object_move(app_state *app, drag_state *drag, sl_point now) {
    sl_map *map = &app->document.map;
    if (drag->index >= map->object_count) return;
    const double step = edit_step(app);
    const double dx = step * round((now.x - drag->at.x) / step);
    const double dy = step * round((now.y - drag->at.y) / step);
    const sl_box to = {{drag->segment.a.x + dx, drag->segment.a.y + dy},
                       {drag->segment.b.x + dx, drag->segment.b.y + dy}};
    sl_box *box = &map->objects[drag->index].box;
    if (to.min.x == box->min.x && to.min.y == box->min.y) return;
    if (!sl_coordinate_usable(to.min.x) || !sl_coordinate_usable(to.min.y) ||
        !sl_coordinate_usable(to.max.x) || !sl_coordinate_usable(to.max.y))
        return;
    if (!drag->changed) app_keep(app);
    drag->changed = true;
    *box = to;
    ui_say(&app->ui, false, "%s at %.10g,%.10g", map->objects[drag->index].name, to.min.x,
           to.min.y);
    app_after_touch(app);
}

void object_toggle(app_state *app, uint32_t object) {
    document_state *document = &app->document;
    if (object >= document->object_count) return;
    document->blocks[object] = !document->blocks[object];
    app_after_touch(app);
    if (document->blocks[object] && app->view.present.still) {
        document->blocks[object] = false;
        app_after_touch(app);
        ui_say(&app->ui, true, "objects cannot block sight from here");
        return;
    }
    ui_say(&app->ui, false, "%s %s", document->map.objects[object].name,
           document->blocks[object] ? "blocks sight" : "is seen through");
}

void object_describe(const app_state *app, uint32_t object, char *text, size_t room) {
    const bool blocks = app->document.blocks[object];
    const seen_state *seen = &app->view.seen;
    const bool known = seen->valid && object < seen->object_count;
    snprintf(text, room, "%s: %s, %s. Drag it; a click has it %s.",
             app->document.map.objects[object].name,
             known && seen->objects[object]            ? "seen by the eye"
             : known && seen->objects_mirrored[object] ? "seen by mirror"
                                                       : "not seen",
             blocks ? "blocks sight" : "seen through", blocks ? "seen through" : "block sight");
}

void object_draw(app_state *app, const sl_frame *frame) {
    const sl_map *map = &app->document.map;
    cairo_t *cairo = app->ui.cairo;
    const sl_palette *palette = &app->ui.palette;
    const window_layout l = app_layout(app);
    uint32_t held = app->tool.drag.kind == DRAG_OBJECT ? app->tool.drag.index : UINT32_MAX;
    if (app->tool.drag.kind == DRAG_NONE && box_has(l.plan[0], app->tool.pointer))
        held = object_at(app, camera_point(&app->view.camera, l.plan[0], app->tool.pointer));
    if (!app->view.seen.valid || !(app->view.show & SHOW_STARTS)) return;
    for (size_t i = 0; i < map->object_count && i < app->view.seen.object_count; i++) {
        const sl_box b = map->objects[i].box;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        const bool blocks = app->document.blocks[i], seen = app->view.seen.objects[i];
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

void range_set(app_state *app, double range) {
    app->document.map.range = rounded(fmax(range, 1e-3 * range_most(&app->document)));
    app_after_touch(app);
}

void range_settle(app_state *app) {
    const kept_maps *done = &app->document.history.done;
    if (done->count && done->items[done->count - 1].map.range == app->document.map.range)
        history_forget_last(app->context, &app->document.history);
    if (app->document.baked->map.range != app->document.map.range) app_after_edit(app);
}

void range_toggle(app_state *app) {
    if (!app->document.baked) return;
    app_keep(app);
    app->document.map.range =
        app->document.map.range > 0 ? 0 : rounded(fmax(0.3 * range_most(&app->document), 1e-100));
    app_after_touch(app);
    range_settle(app);
    if (app->document.map.range > 0)
        ui_say(&app->ui, false, "nothing farther than %g is seen; the slider changes that",
               app->document.map.range);
    else
        ui_say(&app->ui, false, "sight reaches any distance");
}

void range_draw(app_state *app, const sl_frame *frame) {
    cairo_t *cairo = app->ui.cairo;
    const double radius = app->document.map.range * frame->scale;
    const double dashes[] = {5 * frame->unit, 4 * frame->unit};
    sl_point at;
    // One that is larger than what cairo can hold is nowhere near the page's middle either.
    if (!(radius > 0) || radius > 1e5 || !sl_frame_holds(frame, app->view.eye.at, &at)) return;
    cairo_save(cairo);
    cairo_new_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, 6.283185307179586);
    sl_set_colour(cairo, app->ui.palette.start);
    cairo_set_line_width(cairo, 1.4 * frame->unit);
    cairo_set_dash(cairo, dashes, 2, 0);
    cairo_stroke(cairo);
    cairo_restore(cairo);
}
