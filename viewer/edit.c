#include "edit.h"

#include "sightline/canvas.h"

#include <math.h>

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

uint32_t edit_pick(const app_state *app, sl_point at) {
    const sl_map *map = &app->document.map;
    double nearest = edit_reach(app);
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->wall_count; i++) {
        const double distance = edit_distance(at, map->walls[i].a, map->walls[i].b);
        if (distance > nearest) continue;
        nearest = distance;
        found = (uint32_t)i;
    }
    return found;
}

void edit_add(app_state *app, sl_point from, sl_point end) {
    if (end.x == from.x && end.y == from.y) return;
    if (!sl_coordinate_usable(end.x) || !sl_coordinate_usable(end.y)) return;
    app_before_edit(app);
    app_check(app, sl_map_add_wall(app->context, &app->document.map, from, end, 0));
    ui_say(&app->ui, false, "wall from %g,%g to %g,%g", from.x, from.y, end.x, end.y);
    app_after_edit(app);
}

void edit_move(app_state *app, uint32_t wall, double dx, double dy) {
    if (wall >= app->document.map.wall_count || (dx == 0 && dy == 0)) return;
    const sl_wall *old = &app->document.map.walls[wall];
    const double moved[4] = {old->a.x + dx, old->a.y + dy, old->b.x + dx, old->b.y + dy};
    for (int i = 0; i < 4; i++)
        if (!sl_coordinate_usable(moved[i])) return;
    app_before_edit(app);
    sl_wall *w = &app->document.map.walls[wall];
    w->a = (sl_point){moved[0], moved[1]};
    w->b = (sl_point){moved[2], moved[3]};
    ui_say(&app->ui, false, "wall moved by %g,%g", dx, dy);
    app_after_edit(app);
}

void edit_delete(app_state *app) {
    sl_map *map = &app->document.map;
    if (app->tool.wall >= map->wall_count) {
        ui_say(&app->ui, false, "no wall is chosen: click on one");
        return;
    }
    if (map->wall_count == 1) {
        ui_say(&app->ui, true, "the last wall stays: a map without walls has no cells");
        return;
    }
    app_before_edit(app);
    map->walls[app->tool.wall] = map->walls[--map->wall_count];
    app->tool.wall = UINT32_MAX;
    ui_say(&app->ui, false, "wall deleted");
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

void edit_draw(app_state *app, const sl_frame *frame) {
    const sl_map *map = &app->document.map;
    const sl_colour colour = app->ui.palette.start;
    const drag_state *drag = &app->tool.drag;
    draw_grid(app, frame);
    const window_layout l = app_layout(app);
    const sl_point now = camera_point(&app->view.camera, l.plan[0], app->tool.pointer);
    if (app->tool.wall < map->wall_count)
        sl_draw_line(app->ui.cairo, frame, map->walls[app->tool.wall].a,
                     map->walls[app->tool.wall].b, colour, 5 * frame->unit);
    if (drag->kind == DRAG_NEW_WALL) {
        const sl_point from = edit_snap(app, drag->at);
        sl_draw_line(app->ui.cairo, frame, from, edit_snap(app, now), colour, 4 * frame->unit);
    }
    if (drag->kind == DRAG_WALL && drag->index < map->wall_count) {
        const double step = edit_step(app);
        const double dx = step * round((now.x - drag->at.x) / step);
        const double dy = step * round((now.y - drag->at.y) / step);
        const sl_wall *w = &map->walls[drag->index];
        sl_draw_line(app->ui.cairo, frame, (sl_point){w->a.x + dx, w->a.y + dy},
                     (sl_point){w->b.x + dx, w->b.y + dy}, colour, 4 * frame->unit);
    }
}
