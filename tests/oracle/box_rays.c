/// A ray between each two neighbouring directions, in 64-bit integers.
#include "oracle/box_rays.h"

#include "oracle/must.h"

#include <assert.h>
#include <stdlib.h>

/// Where a ray meets a segment: num / den of its way, den > 0; den 0 for nowhere.
typedef struct place {
    int64_t num, den;
} place;

typedef struct ray {
    sl_point to; ///< where it leads, from the origin
} ray;

typedef struct rays {
    const two_points *eye;
    size_t cover;
    sl_segment sides[4];
    ray *items;
    size_t count;
} rays;

bool box_rays_in_view(const sl_view *view, sl_point p) {
    return view->full || (two_points_half(view->eye, view->right, p) != 0 &&
                          two_points_half(view->eye, view->left, p) != 0 &&
                          two_points_after(view->eye, view->right, p, view->left));
}

bool box_rays_on_border(const sl_view *view, sl_point p) {
    return !view->full && (two_points_half(view->eye, view->right, p) == 0 ||
                           two_points_half(view->eye, view->left, p) == 0);
}

static bool is_before(place a, place b) {
    return a.den && (!b.den || a.num * b.den < b.num * a.den);
}

/// `closed`: also at the segment's ends and along it.
static place meet(sl_point eye, sl_point to, sl_segment s, bool closed) {
    const place none = {0, 0};
    const int64_t a = two_points_cross(eye, to, s.a), b = two_points_cross(eye, to, s.b);
    if ((a > 0 && b > 0) || (a < 0 && b < 0) || (!closed && (!a || !b))) return none;
    if (!a && !b) { // the nearer end; the eye is not on a side of the box
        const int64_t p = two_points_dot(eye, to, s.a), q = two_points_dot(eye, to, s.b);
        return p < 0 || q < 0 ? none : (place){p < q ? p : q, two_points_dot(eye, to, to)};
    }
    const sl_point along = {eye.x + s.b.x - s.a.x, eye.y + s.b.y - s.a.y};
    place at = {two_points_cross(eye, s.a, along), two_points_cross(eye, to, along)};
    if (at.den < 0) at = (place){-at.num, -at.den};
    return at.num < 0 ? none : at;
}

static void add_direction(rays *r, sl_point p) {
    const sl_point to = {p.x - r->eye->p.x, p.y - r->eye->p.y};
    if (to.x == 0 && to.y == 0) return;
    r->items[r->count++].to = to;
    r->items[r->count++].to = (sl_point){-to.x, -to.y};
}

/// Where a side of the box and a wall cross, which is at integers.
static void add_crossing(rays *r, sl_segment side, sl_segment wall) {
    const int64_t a = two_points_cross(side.a, side.b, wall.a);
    const int64_t b = two_points_cross(side.a, side.b, wall.b);
    const int64_t p = two_points_cross(wall.a, wall.b, side.a);
    const int64_t q = two_points_cross(wall.a, wall.b, side.b);
    if (a == b || (a > 0 && b > 0) || (a < 0 && b < 0)) return;
    if ((p > 0 && q > 0) || (p < 0 && q < 0)) return;
    const int64_t x = a * (int64_t)(wall.b.x - wall.a.x), y = a * (int64_t)(wall.b.y - wall.a.y);
    assert(x % (a - b) == 0 && y % (a - b) == 0);
    add_direction(r,
                  (sl_point){wall.a.x + (double)(x / (a - b)), wall.a.y + (double)(y / (a - b))});
}

static int by_direction(const void *left, const void *right) {
    const sl_point a = ((const ray *)left)->to, b = ((const ray *)right)->to;
    const int half_a = a.y < 0 || (a.y == 0 && a.x < 0), half_b = b.y < 0 || (b.y == 0 && b.x < 0);
    const int64_t turn = two_points_cross((sl_point){0, 0}, a, b);
    return half_a != half_b ? half_a - half_b : (turn < 0) - (turn > 0);
}

static void gather(rays *r, const sl_view *view) {
    const two_points *eye = r->eye;
    r->items = must(calloc(4 * eye->count + 2 * 4 * eye->count + 20, sizeof *r->items));
    for (size_t i = 0; i < eye->count; i++) {
        add_direction(r, eye->walls[i].a);
        add_direction(r, eye->walls[i].b);
        for (int k = 0; k < 4; k++) add_crossing(r, r->sides[k], eye->walls[i]);
    }
    for (int k = 0; k < 4; k++) add_direction(r, r->sides[k].a);
    if (!view->full) {
        add_direction(r, view->left);
        add_direction(r, view->right);
    }
    qsort(r->items, r->count, sizeof *r->items, by_direction);
}

/// What the ray through a point says. `single`: it is one of the directions.
static box_sight along(const rays *r, sl_point to, bool single, double range) {
    two_points start = *r->eye;
    bool open = false;
    place first = {0, 0};
    start.q = to;
    for (int k = 0; k < 4; k++) {
        const place at = meet(start.p, to, r->sides[k], single);
        if (is_before(at, first)) first = at;
    }
    if (!first.den || (!two_points_starts(&start, true) && !two_points_starts(&start, false)))
        return BOX_HIDDEN;
    for (size_t i = 0; i < start.count; i++) {
        if (two_points_on(start.walls[i], start.p)) continue;
        const place wall = meet(start.p, to, start.walls[i], false);
        // A side that a wall covers is not seen. One that a wall crosses there may be touched.
        if (is_before(wall, first) ||
            (!single && i < r->cover && wall.den && !is_before(first, wall)))
            return BOX_HIDDEN;
        open |= wall.den && !is_before(first, wall);
    }
    const double x = to.x - start.p.x, y = to.y - start.p.y;
    const double share = (double)first.num / (double)first.den;
    const bool far = range > 0 && share * share * (x * x + y * y) > range * range * (1 - 1e-9);
    return single ? BOX_TOUCHED : open || far ? BOX_OPEN : BOX_SEEN;
}

/// The nearest point of the box is out of range.
static bool is_far(sl_point eye, sl_box box, double range) {
    const double x = eye.x < box.min.x   ? box.min.x - eye.x
                     : eye.x > box.max.x ? eye.x - box.max.x
                                         : 0;
    const double y = eye.y < box.min.y   ? box.min.y - eye.y
                     : eye.y > box.max.y ? eye.y - box.max.y
                                         : 0;
    return range > 0 && x * x + y * y > range * range;
}

box_sight box_rays_sight(const two_points *eye, size_t cover, sl_box box, const sl_view *view,
                         double range) {
    const sl_point c[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    rays r = {.eye = eye, .cover = cover};
    box_sight most = BOX_HIDDEN;
    if (eye->p.x >= box.min.x && eye->p.x <= box.max.x && eye->p.y >= box.min.y &&
        eye->p.y <= box.max.y)
        return BOX_SEEN;
    if (is_far(eye->p, box, range)) return BOX_HIDDEN;
    for (int k = 0; k < 4; k++) r.sides[k] = (sl_segment){c[k], c[(k + 1) % 4]};
    gather(&r, view);
    for (size_t i = 0; i < r.count && most < BOX_SEEN; i++) {
        const sl_point d = r.items[i].to, next = r.items[(i + 1) % r.count].to;
        const sl_point p = {eye->p.x + d.x, eye->p.y + d.y};
        const sl_point between = {p.x + next.x, p.y + next.y};
        box_sight sight = BOX_HIDDEN;
        if (box_rays_in_view(view, p) || box_rays_on_border(view, p))
            sight = along(&r, p, true, range);
        if (sight > most) most = sight;
        // Opposite directions are both there: neighbours are the same, or less than half a circle
        // apart.
        if (two_points_cross((sl_point){0, 0}, d, next) > 0 && box_rays_in_view(view, between))
            sight = along(&r, between, false, range);
        if (sight > most) most = sight;
    }
    free(r.items);
    return most;
}
