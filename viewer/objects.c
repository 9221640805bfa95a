#include "objects.h"

#include "edit.h"
#include "sightline/canvas.h"

#include <math.h>
#include <stdio.h>

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
    app_say(app, false, "%s at %g,%g", map->objects[drag->index].name, to.min.x, to.min.y);
    app_after_touch(app);
}

void object_toggle(app_state *app, uint32_t object) {
    document_state *document = &app->document;
    if (object >= document->object_count) return;
    if (!app->view.present.moving && !document->blocks[object]) {
        app_say(app, true, "objects cannot block sight from here");
        return;
    }
    document->blocks[object] = !document->blocks[object];
    app_after_touch(app);
    app_say(app, false, "%s %s", document->map.objects[object].name,
            document->blocks[object] ? "blocks sight" : "is seen through");
}

void object_describe(const app_state *app, uint32_t object, char *text, size_t room) {
    const bool blocks = app->document.blocks[object];
    const bool seen = app->view.seen.valid && object < app->view.seen.object_count &&
                      app->view.seen.objects[object];
    snprintf(text, room, "%s: %s, %s. Drag it; a click has it %s.",
             app->document.map.objects[object].name, seen ? "seen by the eye" : "not seen",
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
