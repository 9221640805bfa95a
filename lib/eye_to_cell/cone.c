#include "eye_to_cell/cone.h"

sl_cone sl_cone_of(sl_pivot *pivot, const sl_view *view) {
    sl_cone cone = {.full = view->full};
    if (view->full) return cone;
    const sl_ray right = sl_ray_to(view->right), left = sl_ray_to(view->left);
    cone.wide = !sl_arc_make(pivot, right, left, &cone.arc);
    if (cone.wide) cone.arc = (sl_arc){left, right, SL_SPAN_WEDGE};
    return cone;
}

static bool holds_ray(sl_pivot *pivot, const sl_cone *cone, sl_ray ray) {
    if (cone->full) return true;
    if (!cone->wide) return sl_arc_has(pivot, &cone->arc, ray);
    return sl_turn(pivot, cone->arc.right, ray) <= 0 || sl_turn(pivot, ray, cone->arc.left) <= 0;
}

bool sl_cone_holds(sl_pivot *pivot, const sl_cone *cone, sl_point point) {
    return sl_same_point(point, pivot->eye) || holds_ray(pivot, cone, sl_ray_to(point));
}

/// Whether a segment neither end of which is within the cone passes through it nevertheless: over
/// its border on both sides, or through the eye.
static bool passes(sl_pivot *pivot, const sl_cone *cone, sl_ray a, sl_ray b) {
    const int turn = sl_turn(pivot, a, b);
    if (turn == 0) return !sl_ray_same_way(pivot, a, b);
    if (cone->wide) return false; // what it leaves out is convex
    const int to_a = sl_turn(pivot, cone->arc.right, a), to_b = sl_turn(pivot, cone->arc.right, b);
    return to_a * to_b < 0 && turn == to_b;
}

bool sl_cone_meets_segment(sl_pivot *pivot, const sl_cone *cone, sl_point a, sl_point b) {
    if (sl_cone_holds(pivot, cone, a) || sl_cone_holds(pivot, cone, b)) return true;
    return passes(pivot, cone, sl_ray_to(a), sl_ray_to(b));
}

bool sl_cone_meets_polygon(sl_pivot *pivot, const sl_cone *cone, const sl_point *corners,
                           size_t count) {
    for (size_t i = 0; i < count; i++)
        if (sl_cone_holds(pivot, cone, corners[i])) return true;
    for (size_t i = 0; i < count; i++)
        if (passes(pivot, cone, sl_ray_to(corners[i]), sl_ray_to(corners[(i + 1) % count])))
            return true;
    return false;
}

/// A border of an arc, where the cone's border is the same ray.
static sl_ray border(sl_pivot *pivot, sl_ray cone, sl_ray arc) {
    return sl_turn(pivot, cone, arc) == 0 && sl_ray_same_way(pivot, cone, arc) ? arc : cone;
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
