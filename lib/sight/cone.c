/// Rays, arcs and view cones, as cone.h declares them; and the public functions of a view.
#include "sight/cone.h"

#include <math.h>

// --- rays

int sli_ray_orient_fine(const sli_pivot *pivot, const sli_ray *from, const sli_ray *to) {
    return sli_orient_fine(&(sli_fine){pivot->eye, pivot->rest},
                           &(sli_fine){from->point, from->rest}, &(sli_fine){to->point, to->rest});
}

/// Which way `b` lies from `a`, by x or, where that is equal, by y: -1, 0 or 1.
static int way(sl_point a, sl_point b) {
    return a.x != b.x ? (b.x > a.x) - (b.x < a.x) : (b.y > a.y) - (b.y < a.y);
}

/// The same for one coordinate of two fine points.
static int way_along(double from, double from_rest, double to, double to_rest) {
    return from != to ? (to > from) - (to < from) : (to_rest > from_rest) - (to_rest < from_rest);
}

/// Which way a ray's point lies from the eye.
static int way_to(const sli_pivot *pivot, const sli_ray *ray) {
    const int x = way_along(pivot->eye.x, pivot->rest.x, ray->point.x, ray->rest.x);
    return x ? x : way_along(pivot->eye.y, pivot->rest.y, ray->point.y, ray->rest.y);
}

/// Whether the eye is at a point of the map.
static bool is_at(const sli_pivot *pivot, sl_point point) {
    return sli_same_point(pivot->eye, point) && pivot->rest.x == 0 && pivot->rest.y == 0;
}

bool sli_ray_same_way(const sli_pivot *pivot, sli_ray a, sli_ray b) {
    const bool points = way_to(pivot, &a) == way_to(pivot, &b);
    return points == (a.away == b.away);
}

static bool is_same_ray(sli_pivot *pivot, sli_ray a, sli_ray b) {
    return sli_ray_turn(pivot, a, b) == 0 && sli_ray_same_way(pivot, a, b);
}

bool sli_arc_make(sli_pivot *pivot, sli_ray right, sli_ray left, sli_arc *out) {
    const int turn = sli_ray_turn(pivot, right, left);
    if (turn < 0) return false;
    sli_span span = SLI_SPAN_WEDGE;
    if (turn == 0) span = sli_ray_same_way(pivot, right, left) ? SLI_SPAN_RAY : SLI_SPAN_HALF;
    if (span == SLI_SPAN_RAY && right.along && left.along) return false;
    *out = (sli_arc){right, left, span};
    return true;
}

static bool arc_has(sli_pivot *pivot, const sli_arc *arc, sli_ray ray) {
    const int turn = sli_ray_turn(pivot, arc->right, ray);
    if (arc->span == SLI_SPAN_RAY) return turn == 0 && sli_ray_same_way(pivot, arc->right, ray);
    return turn >= 0 && (arc->span == SLI_SPAN_HALF || sli_ray_turn(pivot, ray, arc->left) >= 0);
}

/// Chooses of two borders the one that lies within the other's arc. Where both are one ray, portals
/// along either are along it.
static bool choose(sli_pivot *pivot, bool a_counts, sli_ray a, bool b_counts, sli_ray b,
                   sli_ray *out) {
    *out = b_counts ? b : a;
    if (a_counts && b_counts && is_same_ray(pivot, a, b)) out->along = a.along || b.along;
    return a_counts || b_counts;
}

unsigned sli_arc_meet(sli_pivot *pivot, const sli_arc *a, const sli_arc *b, sli_arc pieces[2]) {
    const bool b_right = arc_has(pivot, a, b->right), a_right = arc_has(pivot, b, a->right);
    const bool b_left = arc_has(pivot, a, b->left), a_left = arc_has(pivot, b, a->left);
    if (b_right && a_right && !is_same_ray(pivot, a->right, b->right)) {
        unsigned count = sli_arc_make(pivot, a->right, b->left, &pieces[0]);
        count += sli_arc_make(pivot, b->right, a->left, &pieces[count]);
        return count;
    }
    sli_ray right, left;
    return choose(pivot, a_right, a->right, b_right, b->right, &right) &&
           choose(pivot, a_left, a->left, b_left, b->left, &left) &&
           sli_arc_make(pivot, right, left, &pieces[0]);
}

/// Marks the border at which a portal that lies along the ray is crossed. `ray` is the arc's.
static void mark_along(const sli_pivot *pivot, const sl_directed_portal *portal, sli_arc *arc) {
    // Who goes from the portal's right end to its left end crosses it to the right.
    const bool ahead = way_to(pivot, &arc->right) == way(portal->right, portal->left);
    if (ahead != arc->right.away)
        arc->left.along = true;
    else
        arc->right.along = true;
}

bool sli_arc_of_portal(sli_pivot *pivot, const sl_directed_portal *portal, sli_arc *out) {
    sli_arc arc = {sli_ray_to(portal->right), sli_ray_to(portal->left), SLI_SPAN_HALF};
    if (is_at(pivot, portal->left)) {
        arc.left = (sli_ray){.point = portal->right, .away = true};
    } else if (is_at(pivot, portal->right)) {
        arc.right = (sli_ray){.point = portal->left, .away = true};
    } else {
        const int turn = sli_ray_turn(pivot, arc.right, arc.left);
        if (turn < 0) return false;
        if (turn > 0)
            arc.span = SLI_SPAN_WEDGE;
        else if (sli_ray_same_way(pivot, arc.right, arc.left))
            arc.span = SLI_SPAN_RAY;
    }
    if (arc.span == SLI_SPAN_HALF) arc.right.along = arc.left.along = true;
    if (arc.span == SLI_SPAN_RAY) mark_along(pivot, portal, &arc);
    *out = arc;
    return true;
}

bool sli_arc_narrow(sli_pivot *pivot, const sli_arc *arc, const sl_directed_portal *portal,
                    sli_arc *out) {
    const sli_ray to_right = sli_ray_to(portal->right), to_left = sli_ray_to(portal->left);
    sli_arc narrow = *arc;
    if (sli_ray_turn(pivot, arc->right, to_right) > 0) narrow.right = to_right;
    if (sli_ray_turn(pivot, arc->left, to_left) < 0) narrow.left = to_left;
    const int turn = sli_ray_turn(pivot, narrow.right, narrow.left);
    if (turn < 0) return false;
    narrow.span = turn > 0 ? SLI_SPAN_WEDGE : SLI_SPAN_RAY;
    if (turn == 0 && sli_ray_turn(pivot, to_right, to_left) == 0)
        mark_along(pivot, portal, &narrow);
    if (turn == 0 && narrow.right.along && narrow.left.along) return false;
    *out = narrow;
    return true;
}

// --- view cones

sli_cone sli_cone_of(sli_pivot *pivot, const sl_view *view) {
    sli_cone cone = {.full = view->full};
    if (view->full) return cone;
    const sli_ray right = sli_ray_to(view->right), left = sli_ray_to(view->left);
    cone.wide = !sli_arc_make(pivot, right, left, &cone.arc);
    if (cone.wide) cone.arc = (sli_arc){left, right, SLI_SPAN_WEDGE};
    return cone;
}

/// Whether the cone, which is not full, holds a ray that is `turn` from its arc's right border.
static bool holds_turned(sli_pivot *pivot, const sli_cone *cone, sli_ray ray, int turn) {
    const sli_arc *arc = &cone->arc;
    if (cone->wide) return turn <= 0 || sli_ray_turn(pivot, ray, arc->left) <= 0;
    if (arc->span == SLI_SPAN_RAY) return turn == 0 && sli_ray_same_way(pivot, arc->right, ray);
    return turn >= 0 && (arc->span == SLI_SPAN_HALF || sli_ray_turn(pivot, ray, arc->left) >= 0);
}

static bool holds_ray(sli_pivot *pivot, const sli_cone *cone, sli_ray ray) {
    return cone->full || holds_turned(pivot, cone, ray, sli_ray_turn(pivot, cone->arc.right, ray));
}

/// Whether a segment crosses the cone though neither end is within: it passes both borders, or the
/// eye. Its ends are then on opposite sides of the arc's right border (`to_a`, `to_b`). A wide cone
/// leaves out a convex set, so no segment between two points of that set meets the cone.
static bool passes(sli_pivot *pivot, const sli_cone *cone, sli_ray a, int to_a, sli_ray b,
                   int to_b) {
    if (cone->wide || to_a * to_b >= 0) return false;
    const int turn = sli_ray_turn(pivot, a, b);
    return turn == to_b || turn == 0;
}

bool sli_cone_meets_polygon(sli_pivot *pivot, const sli_cone *cone, const sl_point *corners,
                            size_t count) {
    if (cone->full) return true;
    sli_ray before = sli_ray_to(corners[count - 1]);
    int turn_before = sli_ray_turn(pivot, cone->arc.right, before);
    for (size_t i = 0; i < count; i++) {
        const sli_ray ray = sli_ray_to(corners[i]);
        const int turn = sli_ray_turn(pivot, cone->arc.right, ray);
        if (sli_same_point(corners[i], pivot->eye) || holds_turned(pivot, cone, ray, turn) ||
            passes(pivot, cone, before, turn_before, ray, turn))
            return true;
        before = ray;
        turn_before = turn;
    }
    return false;
}

bool sli_cone_meets_segment(sli_pivot *pivot, const sli_cone *cone, sl_point a, sl_point b) {
    return sli_cone_meets_polygon(pivot, cone, (const sl_point[2]){a, b}, 2);
}

/// The cone's border; where the arc's border is the same ray, that one, with its portals along.
static sli_ray border(sli_pivot *pivot, sli_ray cone, sli_ray arc) {
    return sli_ray_turn(pivot, cone, arc) == 0 && sli_ray_same_way(pivot, cone, arc) ? arc : cone;
}

/// Clips an arc to a wide cone: what is left lies on both sides of what the cone leaves out.
static unsigned clip_around(sli_pivot *pivot, const sli_cone *cone, const sli_arc *arc,
                            sli_arc pieces[2]) {
    const sli_ray cone_left = cone->arc.right, cone_right = cone->arc.left;
    const bool at_left = arc_has(pivot, arc, cone_left);
    const bool at_right = arc_has(pivot, arc, cone_right);
    unsigned count = 0;
    if (at_left)
        count += sli_arc_make(pivot, arc->right, border(pivot, cone_left, arc->left), pieces);
    if (at_right)
        count +=
            sli_arc_make(pivot, border(pivot, cone_right, arc->right), arc->left, &pieces[count]);
    if (at_left || at_right || !holds_ray(pivot, cone, arc->right)) return count;
    pieces[0] = *arc;
    return 1;
}

unsigned sli_cone_clip(sli_pivot *pivot, const sli_cone *cone, const sli_arc *arc,
                       sli_arc pieces[2]) {
    if (cone->wide) return clip_around(pivot, cone, arc, pieces);
    if (!cone->full) return sli_arc_meet(pivot, &cone->arc, arc, pieces);
    pieces[0] = *arc;
    return 1;
}

// --- views

/// The point at an angle in degrees and about a distance: exact for the directions of the axes, and
/// for those between them where the eye has bits to spare, since they take a power of two. So views
/// of eyes in one line meet in this line.
static sl_point toward(sl_point eye, double degrees, double reach) {
    const double turned = remainder(degrees, 360);
    double x, y;
    if (turned == 0 || fabs(turned) == 180) {
        x = turned == 0 ? 1 : -1;
        y = 0;
    } else if (fabs(turned) == 90) {
        x = 0;
        y = turned > 0 ? 1 : -1;
    } else if (fabs(turned) == 45 || fabs(turned) == 135) {
        int exponent;
        (void)frexp(reach, &exponent);
        reach = ldexp(0.5, exponent);
        x = fabs(turned) == 45 ? 1 : -1;
        y = turned > 0 ? 1 : -1;
    } else {
        const double radians = turned * (acos(-1) / 180);
        x = cos(radians);
        y = sin(radians);
    }
    return (sl_point){eye.x + reach * x, eye.y + reach * y};
}

sl_view sl_view_all_round(sl_point eye) {
    return (sl_view){.eye = eye, .full = true};
}

sl_view sl_view_cone(sl_point eye, double heading, double fov, double reach) {
    heading = fmod(heading, 360); // exact; else half of `fov` is lost beside a large heading
    const sl_view cone = {.eye = eye,
                          .left = toward(eye, heading + fov / 2, reach),
                          .right = toward(eye, heading - fov / 2, reach)};
    const bool closed = cone.left.x == cone.right.x && cone.left.y == cone.right.y;
    return fov >= 360 || (fov > 180 && closed) ? sl_view_all_round(eye) : cone;
}

bool sli_view_usable(const sl_view *view) {
    if (!isfinite(view->eye.x) || !isfinite(view->eye.y)) return false;
    if (view->full) return true;
    return isfinite(view->left.x) && isfinite(view->left.y) && isfinite(view->right.x) &&
           isfinite(view->right.y) && !sli_same_point(view->eye, view->left) &&
           !sli_same_point(view->eye, view->right);
}

bool sli_view_holds(const sl_view *view, sl_point point) {
    sli_pivot pivot = {.eye = view->eye};
    const sli_cone cone = sli_cone_of(&pivot, view);
    return sli_same_point(point, view->eye) || holds_ray(&pivot, &cone, sli_ray_to(point));
}
