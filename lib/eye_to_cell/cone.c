#include "eye_to_cell/cone.h"

sl_cone sl_cone_of(sl_pivot *pivot, const sl_view *view) {
    sl_cone cone = {.full = view->full};
    if (view->full) return cone;
    const sl_ray right = sl_ray_to(view->right), left = sl_ray_to(view->left);
    cone.wide = !sl_arc_make(pivot, right, left, &cone.arc);
    if (cone.wide) cone.arc = (sl_arc){left, right, SL_SPAN_WEDGE};
    return cone;
}

/// Whether the cone, which is not full, holds a ray that is `turn` from its arc's right border.
static bool holds_turned(sl_pivot *pivot, const sl_cone *cone, sl_ray ray, int turn) {
    const sl_arc *arc = &cone->arc;
    if (cone->wide) return turn <= 0 || sl_ray_turn(pivot, ray, arc->left) <= 0;
    if (arc->span == SL_SPAN_RAY) return turn == 0 && sl_ray_same_way(pivot, arc->right, ray);
    return turn >= 0 && (arc->span == SL_SPAN_HALF || sl_ray_turn(pivot, ray, arc->left) >= 0);
}

static bool holds_ray(sl_pivot *pivot, const sl_cone *cone, sl_ray ray) {
    return cone->full || holds_turned(pivot, cone, ray, sl_ray_turn(pivot, cone->arc.right, ray));
}

bool sl_cone_holds(sl_pivot *pivot, const sl_cone *cone, sl_point point) {
    return sl_same_point(point, pivot->eye) || holds_ray(pivot, cone, sl_ray_to(point));
}

/// Whether a segment neither end of which is within the cone passes through it nevertheless: over
/// its border on both sides, or through the eye. The ends are `to_a` and `to_b` from the arc's
/// right border, and on either side of it where they do. What a wide cone leaves out is convex, so
/// that no such segment leaves it.
static bool passes(sl_pivot *pivot, const sl_cone *cone, sl_ray a, int to_a, sl_ray b, int to_b) {
    if (cone->wide || to_a * to_b >= 0) return false;
    const int turn = sl_ray_turn(pivot, a, b);
    return turn == to_b || turn == 0;
}

bool sl_cone_meets_polygon(sl_pivot *pivot, const sl_cone *cone, const sl_point *corners,
                           size_t count) {
    if (cone->full) return true;
    sl_ray before = sl_ray_to(corners[count - 1]);
    int turn_before = sl_ray_turn(pivot, cone->arc.right, before);
    for (size_t i = 0; i < count; i++) {
        const sl_ray ray = sl_ray_to(corners[i]);
        const int turn = sl_ray_turn(pivot, cone->arc.right, ray);
        if (sl_same_point(corners[i], pivot->eye) || holds_turned(pivot, cone, ray, turn) ||
            passes(pivot, cone, before, turn_before, ray, turn))
            return true;
        before = ray;
        turn_before = turn;
    }
    return false;
}

bool sl_cone_meets_segment(sl_pivot *pivot, const sl_cone *cone, sl_point a, sl_point b) {
    return sl_cone_meets_polygon(pivot, cone, (const sl_point[2]){a, b}, 2);
}

/// A border of an arc, where the cone's border is the same ray.
static sl_ray border(sl_pivot *pivot, sl_ray cone, sl_ray arc) {
    return sl_ray_turn(pivot, cone, arc) == 0 && sl_ray_same_way(pivot, cone, arc) ? arc : cone;
}

/// Around what a wide cone leaves out.
static unsigned clip_around(sl_pivot *pivot, const sl_cone *cone, const sl_arc *arc,
                            sl_arc pieces[2]) {
    const sl_ray cone_left = cone->arc.right, cone_right = cone->arc.left;
    const bool at_left = sl_arc_has(pivot, arc, cone_left);
    const bool at_right = sl_arc_has(pivot, arc, cone_right);
    unsigned count = 0;
    if (at_left)
        count += sl_arc_make(pivot, arc->right, border(pivot, cone_left, arc->left), pieces);
    if (at_right)
        count +=
            sl_arc_make(pivot, border(pivot, cone_right, arc->right), arc->left, &pieces[count]);
    if (at_left || at_right || !holds_ray(pivot, cone, arc->right)) return count;
    pieces[0] = *arc;
    return 1;
}

unsigned sl_cone_clip(sl_pivot *pivot, const sl_cone *cone, const sl_arc *arc, sl_arc pieces[2]) {
    if (cone->wide) return clip_around(pivot, cone, arc, pieces);
    if (!cone->full) return sl_arc_meet(pivot, &cone->arc, arc, pieces);
    pieces[0] = *arc;
    return 1;
}
