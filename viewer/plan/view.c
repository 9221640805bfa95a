/// Where things are seen from: the camera over the plan, and the eye that walks through the map.
#include "plan/view.h"

#include "app/app.h"

#include <math.h>

// --- the camera

plan_camera camera_fit(sl_box bounds, double width, double height) {
    const double wide = fmax(bounds.max.x - bounds.min.x, 1e-100);
    const double high = fmax(bounds.max.y - bounds.min.y, 1e-100);
    const double scale = 0.94 * fmin(width / wide, height / high);
    return (plan_camera){.middle = {bounds.min.x + wide / 2, bounds.min.y + high / 2},
                         .scale = scale,
                         .least = scale / 8,
                         .most = scale * 4096};
}

/// The camera from now on; NULL: no map was shown yet.
static plan_camera *take_camera(app_state *app) {
    if (!(app->view.camera.scale > 0)) return NULL;
    app->view.fitted = false;
    app->view.motion = 0.2;
    return &app->view.camera;
}

void view_pan(app_state *app, double dx, double dy) {
    plan_camera *camera = take_camera(app);
    if (!camera) return;
    camera->middle.x -= dx / camera->scale;
    camera->middle.y += dy / camera->scale;
}

void view_zoom(app_state *app, double factor, sl_point offset) {
    plan_camera *camera = take_camera(app);
    if (!camera) return;
    const double scale = fmin(fmax(camera->scale * factor, camera->least), camera->most);
    camera->middle.x += offset.x / camera->scale - offset.x / scale;
    camera->middle.y -= offset.y / camera->scale - offset.y / scale;
    camera->scale = scale;
}

sl_frame camera_frame(const plan_camera *camera, sl_box pane, double unit) {
    const double width = pane.max.x - pane.min.x, height = pane.max.y - pane.min.y;
    return (sl_frame){.corner = {camera->middle.x - width / 2 / camera->scale,
                                 camera->middle.y - height / 2 / camera->scale},
                      .scale = camera->scale,
                      .left = pane.min.x,
                      .top = pane.min.y,
                      .width = width,
                      .height = height,
                      .unit = unit};
}

sl_point camera_point(const plan_camera *camera, sl_box pane, sl_point page) {
    const double x = page.x - (pane.min.x + pane.max.x) / 2;
    const double y = page.y - (pane.min.y + pane.max.y) / 2;
    return (sl_point){camera->middle.x + x / camera->scale, camera->middle.y - y / camera->scale};
}

// --- the eye

#define RADIANS (3.14159265358979323846 / 180)

double walk_speed(const document_state *document) {
    return document->counted ? 1.6 * sqrt(document->area / document->counted) : 1;
}

static bool spans(double a, double b, double low, double high) {
    return fmax(a, b) >= low && fmin(a, b) <= high;
}

/// Whether two closed segments have a point in common. Exact.
static bool meet(sl_point a, sl_point b, sl_point p, sl_point q) {
    if (!spans(a.x, b.x, fmin(p.x, q.x), fmax(p.x, q.x)) ||
        !spans(a.y, b.y, fmin(p.y, q.y), fmax(p.y, q.y)))
        return false;
    return sl_orient(a, b, p) * sl_orient(a, b, q) <= 0 &&
           sl_orient(p, q, a) * sl_orient(p, q, b) <= 0;
}

/// The wall in the way; wall_count for none.
static uint32_t first_wall(const sl_space *space, sl_point from, sl_point to) {
    for (uint32_t i = 0; i < space->wall_count; i++)
        if (meet(from, to, space->walls[i].a, space->walls[i].b)) return i;
    return space->wall_count;
}

/// Moves the eye if nothing stops it. Else *wall is what stops it (wall_count: the border of the
/// map).
static bool try_move(view_state *view, double dx, double dy, double body, uint32_t *wall) {
    const sl_space *space = view->present.space;
    const double length = hypot(dx, dy);
    *wall = space->wall_count;
    if (!(length > 0)) return false;
    const sl_point at = view->eye.at, to = {at.x + dx, at.y + dy};
    // A little farther than the step, so that some room to the wall is left.
    const sl_point ahead = {to.x + dx / length * body, to.y + dy / length * body};
    if (!view->eye.flies) {
        *wall = first_wall(space, at, ahead);
        if (*wall < space->wall_count || sl_space_locate(space, ahead) == SL_NO_CELL) return false;
    }
    view->eye.at = to;
    return true;
}

/// Moves by the part of a step that is along the wall.
static void slide(view_state *view, double dx, double dy, double body, uint32_t wall) {
    const sl_space *space = view->present.space;
    if (wall >= space->wall_count) return;
    const sl_wall *w = &space->walls[wall];
    const double x = w->b.x - w->a.x, y = w->b.y - w->a.y, square = x * x + y * y;
    if (!(square > 0)) return;
    const double share = (dx * x + dy * y) / square;
    try_move(view, share * x, share * y, body, &wall);
}

void walk_tick(app_state *app, double seconds) {
    if (!app->view.present.query || !app->tool.held) return;
    const unsigned held = app->tool.held;
    const double turn = ((held & HOLD_TURN_LEFT) != 0) - ((held & HOLD_TURN_RIGHT) != 0);
    app->view.eye.heading = fmod(app->view.eye.heading + 120 * turn * seconds + 360, 360);
    const double ahead = ((held & HOLD_FORWARD) != 0) - ((held & HOLD_BACK) != 0);
    const double aside = ((held & HOLD_RIGHT) != 0) - ((held & HOLD_LEFT) != 0);
    const double length = hypot(ahead, aside);
    if (!(length > 0)) return;
    const double step = walk_speed(&app->document) * seconds / length,
                 body = 0.04 * walk_speed(&app->document);
    const double c = cos(app->view.eye.heading * RADIANS), s = sin(app->view.eye.heading * RADIANS);
    const double dx = step * (ahead * c + aside * s), dy = step * (ahead * s - aside * c);
    uint32_t wall;
    app_check(app, present_space(app->context, &app->view.present));
    if (!app->view.present.space) return;
    if (!try_move(&app->view, dx, dy, body, &wall)) slide(&app->view, dx, dy, body, wall);
}

void walk_home(app_state *app) {
    const document_state *d = &app->document;
    if (!d->baked) return;
    const sl_map *map = &d->baked->map;
    if (d->source.has_start && !app_is_solid(app, d->source.start)) {
        app->view.eye.at = d->source.start;
        return;
    }
    for (size_t i = 0; i < map->start_count; i++) {
        if (app_is_solid(app, map->starts[i].at)) continue;
        app->view.eye.at = map->starts[i].at;
        app->view.eye.heading = fmod(map->starts[i].heading, 360);
        return;
    }
    // The largest cell may be a courtyard, or outdoors.
    const uint32_t roomiest = sl_space_locate(&d->baked->space, map->interior.roomiest);
    if (roomiest != SL_NO_CELL) {
        app->view.eye.at = sl_space_middle(&d->baked->space, roomiest);
        return;
    }
    uint32_t best = 0;
    double largest = -1;
    for (uint32_t cell = 0; cell < d->baked->space.cell_count; cell++)
        if (sl_baked_counts(d->baked, cell) && d->areas[cell] > largest) {
            largest = d->areas[cell];
            best = cell;
        }
    if (d->baked->space.cell_count) app->view.eye.at = sl_space_middle(&d->baked->space, best);
}
