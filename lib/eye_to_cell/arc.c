#include "eye_to_cell/arc.h"

int sl_ray_orient_fine(const sl_pivot *pivot, const sl_ray *from, const sl_ray *to) {
    return sl_orient_fine(&(sl_fine){pivot->eye, pivot->rest}, &(sl_fine){from->point, from->rest},
                          &(sl_fine){to->point, to->rest});
}

/// Whether `b` lies from `a` the way of its coordinates that differ: -1, 0, 1 for x, else for y.
static int way(sl_point a, sl_point b) {
    return a.x != b.x ? (b.x > a.x) - (b.x < a.x) : (b.y > a.y) - (b.y < a.y);
}

/// Which way a sum of two lies from another, both as those of sl_fine.
static int way_along(double from, double from_rest, double to, double to_rest) {
    return from != to ? (to > from) - (to < from) : (to_rest > from_rest) - (to_rest < from_rest);
}

/// Which way a ray's point lies from the eye.
static int way_to(const sl_pivot *pivot, const sl_ray *ray) {
    const int x = way_along(pivot->eye.x, pivot->rest.x, ray->point.x, ray->rest.x);
    return x ? x : way_along(pivot->eye.y, pivot->rest.y, ray->point.y, ray->rest.y);
}

/// Whether the eye is at a point of the map.
static bool is_at(const sl_pivot *pivot, sl_point point) {
    return sl_same_point(pivot->eye, point) && pivot->rest.x == 0 && pivot->rest.y == 0;
}

bool sl_ray_same_way(const sl_pivot *pivot, sl_ray a, sl_ray b) {
    const bool points = way_to(pivot, &a) == way_to(pivot, &b);
    return points == (a.away == b.away);
}

static bool is_same_ray(sl_pivot *pivot, sl_ray a, sl_ray b) {
    return sl_ray_turn(pivot, a, b) == 0 && sl_ray_same_way(pivot, a, b);
}

bool sl_arc_make(sl_pivot *pivot, sl_ray right, sl_ray left, sl_arc *out) {
    const int turn = sl_ray_turn(pivot, right, left);
    if (turn < 0) return false;
    sl_span span = SL_SPAN_WEDGE;
    if (turn == 0) span = sl_ray_same_way(pivot, right, left) ? SL_SPAN_RAY : SL_SPAN_HALF;
    if (span == SL_SPAN_RAY && right.along && left.along) return false;
    *out = (sl_arc){right, left, span};
    return true;
}

bool sl_arc_has(sl_pivot *pivot, const sl_arc *arc, sl_ray ray) {
    const int turn = sl_ray_turn(pivot, arc->right, ray);
    if (arc->span == SL_SPAN_RAY) return turn == 0 && sl_ray_same_way(pivot, arc->right, ray);
    return turn >= 0 && (arc->span == SL_SPAN_HALF || sl_ray_turn(pivot, ray, arc->left) >= 0);
}

/// The one of two borders that lies within the other's arc; of one ray both, and portals along
/// either are along it.
static bool choose(sl_pivot *pivot, bool a_counts, sl_ray a, bool b_counts, sl_ray b, sl_ray *out) {
    *out = b_counts ? b : a;
    if (a_counts && b_counts && is_same_ray(pivot, a, b)) out->along = a.along || b.along;
    return a_counts || b_counts;
}

unsigned sl_arc_meet(sl_pivot *pivot, const sl_arc *a, const sl_arc *b, sl_arc pieces[2]) {
    const bool b_right = sl_arc_has(pivot, a, b->right), a_right = sl_arc_has(pivot, b, a->right);
    const bool b_left = sl_arc_has(pivot, a, b->left), a_left = sl_arc_has(pivot, b, a->left);
    if (b_right && a_right && !is_same_ray(pivot, a->right, b->right)) {
        unsigned count = sl_arc_make(pivot, a->right, b->left, &pieces[0]);
        count += sl_arc_make(pivot, b->right, a->left, &pieces[count]);
        return count;
    }
    sl_ray right, left;
    return choose(pivot, a_right, a->right, b_right, b->right, &right) &&
           choose(pivot, a_left, a->left, b_left, b->left, &left) &&
           sl_arc_make(pivot, right, left, &pieces[0]);
}

/// Marks the border at which a portal that lies along the ray is crossed. `ray` is the arc's.
static void mark_along(const sl_pivot *pivot, const sl_directed_portal *directed, sl_arc *arc) {
    // Who goes from the portal's right end to its left end crosses it to the right.
    const bool ahead = way_to(pivot, &arc->right) == way(directed->right, directed->left);
    if (ahead != arc->right.away)
        arc->left.along = true;
    else
        arc->right.along = true;
}

bool sl_arc_of_portal(sl_pivot *pivot, const sl_directed_portal *directed, sl_arc *out) {
    sl_arc arc = {sl_ray_to(directed->right), sl_ray_to(directed->left), SL_SPAN_HALF};
    if (is_at(pivot, directed->left)) {
        arc.left = (sl_ray){.point = directed->right, .away = true};
    } else if (is_at(pivot, directed->right)) {
        arc.right = (sl_ray){.point = directed->left, .away = true};
    } else {
        const int turn = sl_ray_turn(pivot, arc.right, arc.left);
        if (turn < 0) return false;
        if (turn > 0)
            arc.span = SL_SPAN_WEDGE;
        else if (sl_ray_same_way(pivot, arc.right, arc.left))
            arc.span = SL_SPAN_RAY;
    }
    if (arc.span == SL_SPAN_HALF) arc.right.along = arc.left.along = true;
    if (arc.span == SL_SPAN_RAY) mark_along(pivot, directed, &arc);
    *out = arc;
    return true;
}

bool sl_arc_narrow(sl_pivot *pivot, const sl_arc *arc, const sl_directed_portal *directed,
                   sl_arc *out) {
    const sl_ray to_right = sl_ray_to(directed->right), to_left = sl_ray_to(directed->left);
    sl_arc narrow = *arc;
    if (sl_ray_turn(pivot, arc->right, to_right) > 0) narrow.right = to_right;
    if (sl_ray_turn(pivot, arc->left, to_left) < 0) narrow.left = to_left;
    const int turn = sl_ray_turn(pivot, narrow.right, narrow.left);
    if (turn < 0) return false;
    narrow.span = turn > 0 ? SL_SPAN_WEDGE : SL_SPAN_RAY;
    if (turn == 0 && sl_ray_turn(pivot, to_right, to_left) == 0)
        mark_along(pivot, directed, &narrow);
    if (turn == 0 && narrow.right.along && narrow.left.along) return false;
    *out = narrow;
    return true;
}
