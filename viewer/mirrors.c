#include "mirrors.h"

#include "edit.h"
#include "sightline/canvas.h"

#include <math.h>

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
        app_say(app, true, "mirrors of a baked file stay: open the map that it was made from");
        return;
    }
    if (!drag->changed) app_before_edit(app);
    drag->changed = true;
    map->mirrors[drag->index].segment = to;
    app->document.stale = true;
}

void mirror_drop(app_state *app, const drag_state *drag) {
    const sl_map *map = &app->document.map;
    if (!drag->changed || drag->index >= map->mirror_count) return;
    const sl_segment s = map->mirrors[drag->index].segment;
    app_say(app, false, "mirror from %g,%g to %g,%g", s.a.x, s.a.y, s.b.x, s.b.y);
    app_after_edit(app);
}

void mirror_set_depth(app_state *app, uint32_t depth) {
    if (depth == app->document.mirror_depth) return;
    app->document.mirror_depth = depth;
    app_check(app, document_renew_search(app->context, &app->document));
    present_drop(app->context, &app->view.present);
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
