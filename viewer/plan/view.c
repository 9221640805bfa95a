/// The camera over the plan, the eye that walks through the map, and changes by hand.
#include "plan/view.h"

#include "plan/drag_world.h"

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
static plan_camera *take_camera(view_state *view) {
    if (!(view->camera.scale > 0)) return NULL;
    view->fitted = false;
    view->motion = 0.2;
    return &view->camera;
}

void view_set_mode(view_state *view, view_mode mode) {
    if ((mode == MODE_PLAN) != (view->mode == MODE_PLAN)) {
        const double cone = view->eye.fov;
        view->eye.fov = view->other_cone;
        view->other_cone = cone;
    }
    view->mode = mode;
}

void view_pan(view_state *view, double dx, double dy) {
    plan_camera *camera = take_camera(view);
    if (!camera) return;
    camera->middle.x -= dx / camera->scale;
    camera->middle.y += dy / camera->scale;
}

void view_zoom(view_state *view, double factor, sl_point offset) {
    plan_camera *camera = take_camera(view);
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

// --- the state

void view_follow(view_state *view) {
    view_check(view, present_update(view->context, &view->present, view->document, view->eye.at));
}

bool view_pointed(const view_state *view, sl_point *at) {
    *at = camera_point(&view->camera, view->plan[0], view->ui->pointer);
    return box_has(view->plan[0], view->ui->pointer);
}

void view_say_place(const sl_map *map, sl_point at, char text[PLACE_TEXT]) {
    const int digits = (int)fmin(fmax(sl_map_digits(map) - 2, 4), 17);
    char whole[2 * 330]; // as far as the compiler can tell
    snprintf(whole, sizeof whole, "%.*g, %.*g", digits, at.x, digits, at.y);
    snprintf(text, PLACE_TEXT, "%.*s", PLACE_TEXT - 1, whole);
}

void view_mark(const view_state *view, const sl_frame *frame, sl_point place) {
    cairo_t *cairo = view->ui->cairo;
    sl_point at;
    if (!sl_frame_holds(frame, place, &at)) return;
    cairo_new_path(cairo);
    cairo_arc(cairo, at.x, at.y, 5 * frame->unit, 0, 6.283185307179586);
    sl_set_colour(cairo, view->ui->palette.start);
    cairo_fill(cairo);
}

void view_drop_scenes(view_state *view) {
    sl_scene_destroy(view->context, view->scene);
    sl_scene_destroy(view->context, view->tree);
    view->scene = view->tree = NULL;
}

bool view_is_solid(const view_state *view, sl_point at) {
    if (!view->document->baked) return false;
    const sl_space *space = &view->document->baked->space;
    const uint32_t cell = sl_space_locate(space, at);
    return cell != SL_NO_CELL && space->cells[cell].solid;
}

uint32_t view_eye_cell(const view_state *view) {
    return view->document->baked && !view_is_solid(view, view->eye.at)
               ? sl_space_locate(&view->document->baked->space, view->eye.at)
               : SL_NO_CELL;
}

// --- changes by hand

void view_keep(view_state *view) {
    view_check(view, history_keep(view->context, &view->document->history, &view->document->map));
}

void view_before_edit(view_state *view) {
    view->fitted = false; // the plan stays where it is, whatever the map becomes
    view_keep(view);
    sl_map_drop_cells(view->context, &view->document->map); // they do not know other walls
}

void view_after_edit(view_state *view) {
    view->document->stale = false;
    view_check(view, document_rebuild(view->context, view->document, false));
}

void view_after_step(view_state *view) {
    if (drag_world_step(view)) return;
    view->document->stale = true;
    view_check(view, document_keep_up(view->context, view->document));
}

bool view_is_late(const view_state *view) {
    return document_is_late(view->document) || drag_world_is_late(view);
}

void view_after_touch(view_state *view) {
    document_touch(view->document);
    view_follow(view);
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
static bool segments_meet(sl_point a, sl_point b, sl_point p, sl_point q) {
    if (!spans(a.x, b.x, fmin(p.x, q.x), fmax(p.x, q.x)) ||
        !spans(a.y, b.y, fmin(p.y, q.y), fmax(p.y, q.y)))
        return false;
    return sl_orient(a, b, p) * sl_orient(a, b, q) <= 0 &&
           sl_orient(p, q, a) * sl_orient(p, q, b) <= 0;
}

/// The wall in the way; wall_count for none.
static uint32_t first_wall(const sl_space *space, sl_point from, sl_point to) {
    for (uint32_t i = 0; i < space->wall_count; i++)
        if (segments_meet(from, to, space->walls[i].a, space->walls[i].b)) return i;
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
static void slide_along(view_state *view, double dx, double dy, double body, uint32_t wall) {
    const sl_space *space = view->present.space;
    if (wall >= space->wall_count) return;
    const sl_wall *w = &space->walls[wall];
    const double x = w->b.x - w->a.x, y = w->b.y - w->a.y, square = x * x + y * y;
    if (!(square > 0)) return;
    const double share = (dx * x + dy * y) / square;
    try_move(view, share * x, share * y, body, &wall);
}

void walk_tick(view_state *view, double seconds) {
    if (!view->present.query || !view->held) return;
    const unsigned held = view->held;
    const double turn = ((held & HOLD_TURN_LEFT) != 0) - ((held & HOLD_TURN_RIGHT) != 0);
    view->eye.heading = fmod(view->eye.heading + 120 * turn * seconds + 360, 360);
    const double ahead = ((held & HOLD_FORWARD) != 0) - ((held & HOLD_BACK) != 0);
    const double aside = ((held & HOLD_RIGHT) != 0) - ((held & HOLD_LEFT) != 0);
    const double length = hypot(ahead, aside);
    if (!(length > 0)) return;
    const double step = walk_speed(view->document) * seconds / length,
                 body = 0.04 * walk_speed(view->document);
    const double c = cos(view->eye.heading * RADIANS), s = sin(view->eye.heading * RADIANS);
    const double dx = step * (ahead * c + aside * s), dy = step * (ahead * s - aside * c);
    uint32_t wall;
    view_check(view, present_space(view->context, &view->present));
    if (!view->present.space) return;
    if (!try_move(view, dx, dy, body, &wall)) slide_along(view, dx, dy, body, wall);
}

void walk_home(view_state *view) {
    const document_state *d = view->document;
    if (!d->baked) return;
    const sl_map *map = &d->baked->map;
    if (d->source.has_start && !view_is_solid(view, d->source.start)) {
        view->eye.at = d->source.start;
        return;
    }
    for (size_t i = 0; i < map->start_count; i++) {
        if (view_is_solid(view, map->starts[i].at)) continue;
        view->eye.at = map->starts[i].at;
        view->eye.heading = fmod(map->starts[i].heading, 360);
        return;
    }
    // The largest cell may be a courtyard, or outdoors.
    const uint32_t roomiest = sl_space_locate(&d->baked->space, map->interior.roomiest);
    if (roomiest != SL_NO_CELL) {
        view->eye.at = sl_space_middle(&d->baked->space, roomiest);
        return;
    }
    uint32_t best = 0;
    double largest = -1;
    for (uint32_t cell = 0; cell < d->baked->space.cell_count; cell++)
        if (sl_baked_counts(d->baked, cell) && d->areas[cell] > largest) {
            largest = d->areas[cell];
            best = cell;
        }
    if (d->baked->space.cell_count) view->eye.at = sl_space_middle(&d->baked->space, best);
}
