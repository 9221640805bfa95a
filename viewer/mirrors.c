#include "mirrors.h"

#include "edit.h"
#include "sightline/canvas.h"

#include <math.h>

static double distance(sl_point a, sl_point b) {
    return hypot(a.x - b.x, a.y - b.y);
}

uint32_t sl_mirror_at(const sl_app *app, sl_point at, sl_grip *part) {
    const sl_map *map = &app->document.map;
    double within = sl_edit_reach(app);
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->mirror_count; i++) {
        const sl_segment s = map->mirrors[i].segment;
        const double off = sl_edit_distance(at, s.a, s.b);
        if (off > within) continue;
        within = off;
        found = (uint32_t)i;
        // An end has more room around it, but no more than a quarter of the mirror.
        const double room = fmin(1.5 * sl_edit_reach(app), distance(s.a, s.b) / 4);
        *part = distance(at, s.a) <= room   ? SL_GRIP_A
                : distance(at, s.b) <= room ? SL_GRIP_B
                                            : SL_GRIP_WHOLE;
    }
    return found;
}

bool sl_mirror_take(sl_app *app, sl_drag *drag) {
    sl_grip part;
    drag->index = sl_mirror_at(app, drag->at, &part);
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

void sl_mirror_move(sl_app *app, sl_drag *drag, sl_point now) {
    sl_map *map = &app->document.map;
    if (drag->index >= map->mirror_count) return;
    const double step = sl_edit_step(app);
    const double dx = step * round((now.x - drag->at.x) / step);
    const double dy = step * round((now.y - drag->at.y) / step);
    sl_segment to = drag->segment;
    if (drag->part == SL_GRIP_A) to.a = sl_edit_snap(app, now);
    if (drag->part == SL_GRIP_B) to.b = sl_edit_snap(app, now);
    if (drag->part == SL_GRIP_WHOLE) {
        to.a = (sl_point){to.a.x + dx, to.a.y + dy};
        to.b = (sl_point){to.b.x + dx, to.b.y + dy};
    }
    const sl_segment is = map->mirrors[drag->index].segment;
    const bool same = to.a.x == is.a.x && to.a.y == is.a.y && to.b.x == is.b.x && to.b.y == is.b.y;
    if (same || !usable(to)) return;
    if (app->document.source.path && sl_document_is_baked(app->document.source.path)) {
        sl_app_say(app, true, "mirrors of a baked file stay: open the map that it was made from");
        return;
    }
    if (!drag->changed) sl_app_before_edit(app);
    drag->changed = true;
    map->mirrors[drag->index].segment = to;
    app->stale = true;
}

void sl_mirror_drop(sl_app *app, const sl_drag *drag) {
    const sl_map *map = &app->document.map;
    if (!drag->changed || drag->index >= map->mirror_count) return;
    const sl_segment s = map->mirrors[drag->index].segment;
    sl_app_say(app, false, "mirror from %g,%g to %g,%g", s.a.x, s.a.y, s.b.x, s.b.y);
    sl_app_after_edit(app);
}

void sl_mirror_set_depth(sl_app *app, uint32_t depth) {
    if (depth == app->document.mirror_depth) return;
    app->document.mirror_depth = depth;
    sl_app_check(app, sl_document_renew_search(app->context, &app->document));
    sl_present_drop(app->context, &app->present);
    sl_app_after_touch(app);
}

void sl_mirror_settle_depth(sl_app *app) {
    if (app->document.baked_depth != app->document.mirror_depth) sl_app_after_edit(app);
}

void sl_mirror_draw(sl_app *app, const sl_frame *frame) {
    const sl_map *map = &app->document.map;
    const bool held = app->drag.kind == SL_DRAG_MIRROR;
    const sl_layout l = sl_app_layout(app);
    sl_grip part;
    uint32_t mirror = held ? app->drag.index : UINT32_MAX;
    if (app->drag.kind == SL_DRAG_NONE && sl_box_has(l.plan[0], app->pointer))
        mirror = sl_mirror_at(app, sl_camera_point(&app->camera, l.plan[0], app->pointer), &part);
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
