/// Shapes about an eye. All is decided by exact predicates on input coordinates.
///
///           left border
///              .  +--o       A convex shape seen from outside lies in one open wedge of less
///           .     |  |       than 180 degrees, between its two tangent corners. For a box these
///        eye .    o--+       follow from where the eye is: left of, over or right of it, and
///              .  right      below, beside or above it (nine cases).
///
/// An occluder that spans a wedge cuts the wedge into a part before it and a part behind it. A
/// shape may reach into both. It reaches into a part if that part of the shape has directions
/// within the wedge: a corner or a crossing left of the right border, and one right of the left
/// border.
///
/// Cost: O(1) predicates for a box, O(corners) for a polygon.
#include "walk/shape.h"

#include "geometry/crossing.h"

/// The rightmost and the leftmost corner of a box seen from outside, by where the eye is: left of,
/// in the column of, right of the box; then below, in the row of, above it.
static const uint8_t box_ends[3][3][2] = {
    {{1, 3}, {0, 3}, {0, 2}},
    {{1, 0}, {0, 0}, {3, 2}},
    {{2, 0}, {2, 1}, {3, 1}},
};

static bool box_wedge(const sl_shape *shape, sl_point eye, sl_wedge *wedge) {
    const sl_box *b = &shape->box;
    const int column = eye.x < b->min.x ? 0 : eye.x > b->max.x ? 2 : 1;
    const int row = eye.y < b->min.y ? 0 : eye.y > b->max.y ? 2 : 1;
    if (column == 1 && row == 1) return false;
    const uint8_t *ends = box_ends[column][row];
    *wedge = (sl_wedge){sl_ray_to(shape->corners[ends[0]]), sl_ray_to(shape->corners[ends[1]])};
    return true;
}

uint32_t sl_shape_wedges(sl_pivot *pivot, const sl_shape *shape, sl_wedge *wedges) {
    if (shape->is_box && box_wedge(shape, pivot->eye, wedges)) return 1;
    uint32_t inner = 0, facing = 0;
    sl_wedge outer = {.right = sl_ray_to(shape->corners[0])};
    const sl_point *corners = shape->corners;
    const uint32_t last = shape->count - 1;
    pivot->tests += shape->count;
    bool before = sl_orient(corners[last], corners[0], pivot->eye) < 0;
    for (uint32_t k = 0; k <= last; k++) {
        const sl_point from = corners[k], to = corners[k < last ? k + 1 : 0];
        const int side = sl_orient(from, to, pivot->eye);
        if (side > 0) wedges[inner++] = (sl_wedge){sl_ray_to(from), sl_ray_to(to)};
        // The sides that face the eye are one chain, which runs from the left to the right.
        if (side < 0 && !before) outer.left = sl_ray_to(from);
        if (side >= 0 && before) outer.right = sl_ray_to(from);
        before = side < 0;
        facing += before;
    }
    if (!facing) return inner;
    wedges[0] = outer;
    return 1;
}

sl_walk_cone sl_walk_cone_of(sl_pivot *pivot, const sl_view *view) {
    sl_walk_cone cone = {.kind = SL_CONE_ALL};
    if (view->full) return cone;
    cone.right = sl_ray_to(view->right);
    cone.left = sl_ray_to(view->left);
    const int turn = sl_ray_turn(pivot, cone.right, cone.left);
    if (turn > 0)
        cone.kind = SL_CONE_WEDGE;
    else if (turn < 0)
        cone.kind = SL_CONE_WIDE;
    else
        cone.kind = sl_ray_same_way(pivot, cone.right, cone.left) ? SL_CONE_NONE : SL_CONE_HALF;
    return cone;
}

/// Clips to a cone of more than half a turn: the part left of its right border, and of the rest the
/// part right of its left border.
static unsigned in_wide_cone(sl_pivot *pivot, const sl_walk_cone *cone, const sl_wedge *wedge,
                             sl_wedge parts[2], bool *cut) {
    unsigned count = 0;
    const sl_split split = sl_wedge_split(pivot, wedge, cone->right);
    if (sl_has_left(split)) parts[count++] = sl_left_part(wedge, split, cone->right);
    if (!sl_has_right(split)) return count;
    const sl_wedge right = sl_right_part(wedge, split, cone->right);
    const sl_split rest = sl_wedge_split(pivot, &right, cone->left);
    if (sl_has_right(rest)) parts[count++] = sl_right_part(&right, rest, cone->left);
    *cut = *cut || sl_has_left(rest);
    return count;
}

unsigned sl_wedge_in_cone(sl_pivot *pivot, const sl_walk_cone *cone, const sl_wedge *wedge,
                          sl_wedge parts[2], bool *cut) {
    if (cone->kind == SL_CONE_WIDE) return in_wide_cone(pivot, cone, wedge, parts, cut);
    parts[0] = *wedge;
    if (cone->kind == SL_CONE_ALL) return 1;
    if (cone->kind == SL_CONE_NONE) return *cut = true, 0;
    const sl_split first = sl_wedge_split(pivot, wedge, cone->right);
    *cut = *cut || sl_has_right(first);
    if (!sl_has_left(first)) return 0;
    if (sl_has_right(first)) parts[0] = sl_left_part(wedge, first, cone->right);
    if (cone->kind == SL_CONE_HALF) return 1;
    const sl_split second = sl_wedge_split(pivot, &parts[0], cone->left);
    *cut = *cut || sl_has_left(second);
    if (sl_has_left(second) && sl_has_right(second))
        parts[0] = sl_right_part(&parts[0], second, cone->left);
    return sl_has_right(second);
}

// --- about an occluder

/// Whether a box has directions within a wedge. The borders of both lie within half a turn.
static bool box_meets(sl_pivot *pivot, const sl_box *box, const sl_wedge *wedge) {
    const sl_point corners[4] = {
        box->min, {box->max.x, box->min.y}, box->max, {box->min.x, box->max.y}};
    sl_wedge own;
    if (!box_wedge(&(sl_shape){corners, 4, *box, true}, pivot->eye, &own)) return true;
    return sl_ray_turn(pivot, wedge->right, own.left) > 0 &&
           sl_ray_turn(pivot, wedge->left, own.right) < 0;
}

/// sl_shape_about for a box and an axial occluder. The occluder's line cuts the box into two boxes
/// with the same coordinates.
static unsigned box_about(sl_pivot *pivot, const sl_box *box, const sl_wedge *wedge,
                          const sl_occluder *o) {
    sl_box lower = *box, upper = *box;
    bool eye_below;
    if (o->a.x == o->b.x) {
        lower.max.x = upper.min.x = o->a.x;
        eye_below = pivot->eye.x < o->a.x;
    } else {
        lower.max.y = upper.min.y = o->a.y;
        eye_below = pivot->eye.y < o->a.y;
    }
    const unsigned before = box_meets(pivot, eye_below ? &lower : &upper, wedge) ? SL_BEFORE : 0;
    const unsigned behind = box_meets(pivot, eye_below ? &upper : &lower, wedge) ? SL_BEHIND : 0;
    return before | behind;
}

/// The parts of a shape, before and behind an occluder's line, that have a point left of the
/// wedge's right border, and those that have one right of its left border. A part in both has
/// directions within the wedge, because it lies within half a turn of it.
typedef struct reach {
    unsigned from_right, from_left;
} reach;

/// On which sides of an occluder's line a point is.
static unsigned sides_of(const sl_occluder *o, sl_point p) {
    const int side = sl_orient(o->a, o->b, p);
    return side > 0 ? SL_BEFORE : side < 0 ? SL_BEHIND : SL_BOTH_SIDES;
}

static void reach_corner(sl_pivot *pivot, const sl_wedge *wedge, sl_point p, unsigned sides,
                         reach *r) {
    const sl_ray ray = sl_ray_to(p);
    if (sides & ~r->from_right && sl_ray_turn(pivot, wedge->right, ray) > 0) r->from_right |= sides;
    if (sides & ~r->from_left && sl_ray_turn(pivot, wedge->left, ray) < 0) r->from_left |= sides;
}

/// The turn from a ray to where a side of the shape crosses the occluder's line.
static int turn_to_crossing(sl_pivot *pivot, sl_ray ray, sl_segment side, const sl_occluder *o) {
    pivot->tests++;
    const int turn = sl_crossing_side(pivot->eye, ray.point, side, (sl_segment){o->a, o->b});
    return ray.away ? -turn : turn;
}

/// Where the line crosses a side of the shape, both parts have a point.
static void reach_crossings(sl_pivot *pivot, const sl_shape *shape, const sl_wedge *wedge,
                            const sl_occluder *o, reach *r) {
    sl_point p = shape->corners[shape->count - 1];
    unsigned before = sides_of(o, p);
    for (uint32_t k = 0; k < shape->count; k++) {
        const sl_segment side = {p, shape->corners[k]};
        const unsigned sides = sides_of(o, side.b);
        if (!(before & sides)) {
            if (r->from_right != SL_BOTH_SIDES &&
                turn_to_crossing(pivot, wedge->right, side, o) > 0)
                r->from_right = SL_BOTH_SIDES;
            if (r->from_left != SL_BOTH_SIDES && turn_to_crossing(pivot, wedge->left, side, o) < 0)
                r->from_left = SL_BOTH_SIDES;
        }
        p = side.b;
        before = sides;
    }
}

static bool holds_eye(sl_pivot *pivot, const sl_shape *shape) {
    const sl_point eye = pivot->eye;
    const sl_box *b = &shape->box;
    if (eye.x < b->min.x || eye.x > b->max.x || eye.y < b->min.y || eye.y > b->max.y) return false;
    for (uint32_t k = 0; k < shape->count && !shape->is_box; k++) {
        pivot->tests++;
        if (sl_orient(shape->corners[k], shape->corners[k + 1 < shape->count ? k + 1 : 0], eye) < 0)
            return false;
    }
    return true;
}

unsigned sl_shape_about(sl_pivot *pivot, const sl_shape *shape, const sl_wedge *wedge,
                        const sl_occluder *occluder) {
    bool before = false, behind = false;
    for (uint32_t k = 0; k < shape->count && !(before && behind); k++) {
        const unsigned sides = sides_of(occluder, shape->corners[k]);
        pivot->tests++;
        before = before || sides == SL_BEFORE;
        behind = behind || sides == SL_BEHIND;
    }
    if (!behind) return SL_BEFORE;
    if (!before) return SL_BEHIND;
    if (shape->is_box && (occluder->a.x == occluder->b.x || occluder->a.y == occluder->b.y))
        return box_about(pivot, &shape->box, wedge, occluder);
    reach r = {0};
    if (holds_eye(pivot, shape)) r.from_right = r.from_left = SL_BEFORE;
    for (uint32_t k = 0; k < shape->count; k++)
        reach_corner(pivot, wedge, shape->corners[k], sides_of(occluder, shape->corners[k]), &r);
    if ((r.from_right & r.from_left) != SL_BOTH_SIDES)
        reach_crossings(pivot, shape, wedge, occluder, &r);
    return r.from_right & r.from_left;
}

bool sl_occluder_is_behind(const sl_occluder *one, const sl_occluder *other) {
    if (sl_orient(other->a, other->b, one->a) <= 0 && sl_orient(other->a, other->b, one->b) <= 0)
        return true;
    return sl_orient(one->a, one->b, other->a) >= 0 && sl_orient(one->a, one->b, other->b) >= 0;
}
