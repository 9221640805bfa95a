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
#include "study/walk/shape.h"

#include "geometry/crossing.h"

/// The rightmost and the leftmost corner of a box seen from outside, by where the eye is: left of,
/// in the column of, right of the box; then below, in the row of, above it.
static const uint8_t box_ends[3][3][2] = {
    {{1, 3}, {0, 3}, {0, 2}},
    {{1, 0}, {0, 0}, {3, 2}},
    {{2, 0}, {2, 1}, {3, 1}},
};

static bool box_wedge(const sli_shape *shape, sl_point eye, sli_wedge *wedge) {
    const sl_box *b = &shape->box;
    const int column = eye.x < b->min.x ? 0 : eye.x > b->max.x ? 2 : 1;
    const int row = eye.y < b->min.y ? 0 : eye.y > b->max.y ? 2 : 1;
    if (column == 1 && row == 1) return false;
    const uint8_t *ends = box_ends[column][row];
    *wedge = (sli_wedge){sli_ray_to(shape->corners[ends[0]]), sli_ray_to(shape->corners[ends[1]])};
    return true;
}

uint32_t sli_shape_wedges(sli_pivot *pivot, const sli_shape *shape, sli_wedge *wedges) {
    if (shape->is_box && box_wedge(shape, pivot->eye, wedges)) return 1;
    uint32_t inner = 0, facing = 0;
    sli_wedge outer = {.right = sli_ray_to(shape->corners[0])};
    const sl_point *corners = shape->corners;
    const uint32_t last = shape->count - 1;
    pivot->tests += shape->count;
    bool before = sli_orient(corners[last], corners[0], pivot->eye) < 0;
    for (uint32_t k = 0; k <= last; k++) {
        const sl_point from = corners[k], to = corners[k < last ? k + 1 : 0];
        const int side = sli_orient(from, to, pivot->eye);
        if (side > 0) wedges[inner++] = (sli_wedge){sli_ray_to(from), sli_ray_to(to)};
        // The sides that face the eye are one chain, which runs from the left to the right.
        if (side < 0 && !before) outer.left = sli_ray_to(from);
        if (side >= 0 && before) outer.right = sli_ray_to(from);
        before = side < 0;
        facing += before;
    }
    if (!facing) return inner;
    wedges[0] = outer;
    return 1;
}

sli_walk_cone sli_walk_cone_of(sli_pivot *pivot, const sl_view *view) {
    sli_walk_cone cone = {.kind = SLI_CONE_ALL};
    if (view->full) return cone;
    cone.right = sli_ray_to(view->right);
    cone.left = sli_ray_to(view->left);
    const int turn = sli_ray_turn(pivot, cone.right, cone.left);
    if (turn > 0)
        cone.kind = SLI_CONE_WEDGE;
    else if (turn < 0)
        cone.kind = SLI_CONE_WIDE;
    else
        cone.kind = sli_ray_same_way(pivot, cone.right, cone.left) ? SLI_CONE_NONE : SLI_CONE_HALF;
    return cone;
}

/// Clips to a cone of more than half a turn: the part left of its right border, and of the rest the
/// part right of its left border.
static unsigned in_wide_cone(sli_pivot *pivot, const sli_walk_cone *cone, const sli_wedge *wedge,
                             sli_wedge parts[2], bool *cut) {
    unsigned count = 0;
    const sli_split split = sli_wedge_split(pivot, wedge, cone->right);
    if (sli_has_left(split)) parts[count++] = sli_left_part(wedge, split, cone->right);
    if (!sli_has_right(split)) return count;
    const sli_wedge right = sli_right_part(wedge, split, cone->right);
    const sli_split rest = sli_wedge_split(pivot, &right, cone->left);
    if (sli_has_right(rest)) parts[count++] = sli_right_part(&right, rest, cone->left);
    *cut = *cut || sli_has_left(rest);
    return count;
}

unsigned sli_wedge_in_cone(sli_pivot *pivot, const sli_walk_cone *cone, const sli_wedge *wedge,
                           sli_wedge parts[2], bool *cut) {
    if (cone->kind == SLI_CONE_WIDE) return in_wide_cone(pivot, cone, wedge, parts, cut);
    parts[0] = *wedge;
    if (cone->kind == SLI_CONE_ALL) return 1;
    if (cone->kind == SLI_CONE_NONE) return *cut = true, 0;
    const sli_split first = sli_wedge_split(pivot, wedge, cone->right);
    *cut = *cut || sli_has_right(first);
    if (!sli_has_left(first)) return 0;
    if (sli_has_right(first)) parts[0] = sli_left_part(wedge, first, cone->right);
    if (cone->kind == SLI_CONE_HALF) return 1;
    const sli_split second = sli_wedge_split(pivot, &parts[0], cone->left);
    *cut = *cut || sli_has_left(second);
    if (sli_has_left(second) && sli_has_right(second))
        parts[0] = sli_right_part(&parts[0], second, cone->left);
    return sli_has_right(second);
}

// --- about an occluder

/// Whether a box has directions within a wedge. The borders of both lie within half a turn.
static bool box_meets(sli_pivot *pivot, const sl_box *box, const sli_wedge *wedge) {
    const sl_point corners[4] = {
        box->min, {box->max.x, box->min.y}, box->max, {box->min.x, box->max.y}};
    sli_wedge own;
    if (!box_wedge(&(sli_shape){corners, 4, *box, true}, pivot->eye, &own)) return true;
    return sli_ray_turn(pivot, wedge->right, own.left) > 0 &&
           sli_ray_turn(pivot, wedge->left, own.right) < 0;
}

/// sli_shape_about for a box and an axial occluder. The occluder's line cuts the box into two boxes
/// with the same coordinates.
static unsigned box_about(sli_pivot *pivot, const sl_box *box, const sli_wedge *wedge,
                          const sli_occluder *o) {
    sl_box lower = *box, upper = *box;
    bool eye_below;
    if (o->a.x == o->b.x) {
        lower.max.x = upper.min.x = o->a.x;
        eye_below = pivot->eye.x < o->a.x;
    } else {
        lower.max.y = upper.min.y = o->a.y;
        eye_below = pivot->eye.y < o->a.y;
    }
    const unsigned before = box_meets(pivot, eye_below ? &lower : &upper, wedge) ? SLI_BEFORE : 0;
    const unsigned behind = box_meets(pivot, eye_below ? &upper : &lower, wedge) ? SLI_BEHIND : 0;
    return before | behind;
}

/// The parts of a shape, before and behind an occluder's line, that have a point left of the
/// wedge's right border, and those that have one right of its left border. A part in both has
/// directions within the wedge, because it lies within half a turn of it.
typedef struct reach {
    unsigned from_right, from_left;
} reach;

/// On which sides of an occluder's line a point is.
static unsigned sides_of(const sli_occluder *o, sl_point p) {
    const int side = sli_orient(o->a, o->b, p);
    return side > 0 ? SLI_BEFORE : side < 0 ? SLI_BEHIND : SLI_BOTH_SIDES;
}

static void reach_corner(sli_pivot *pivot, const sli_wedge *wedge, sl_point p, unsigned sides,
                         reach *r) {
    const sli_ray ray = sli_ray_to(p);
    if (sides & ~r->from_right && sli_ray_turn(pivot, wedge->right, ray) > 0)
        r->from_right |= sides;
    if (sides & ~r->from_left && sli_ray_turn(pivot, wedge->left, ray) < 0) r->from_left |= sides;
}

/// The turn from a ray to where a side of the shape crosses the occluder's line.
static int turn_to_crossing(sli_pivot *pivot, sli_ray ray, sl_segment side, const sli_occluder *o) {
    pivot->tests++;
    const int turn = sli_crossing_side(pivot->eye, ray.point, side, (sl_segment){o->a, o->b});
    return ray.away ? -turn : turn;
}

/// Where the line crosses a side of the shape, both parts have a point.
static void reach_crossings(sli_pivot *pivot, const sli_shape *shape, const sli_wedge *wedge,
                            const sli_occluder *o, reach *r) {
    sl_point p = shape->corners[shape->count - 1];
    unsigned before = sides_of(o, p);
    for (uint32_t k = 0; k < shape->count; k++) {
        const sl_segment side = {p, shape->corners[k]};
        const unsigned sides = sides_of(o, side.b);
        if (!(before & sides)) {
            if (r->from_right != SLI_BOTH_SIDES &&
                turn_to_crossing(pivot, wedge->right, side, o) > 0)
                r->from_right = SLI_BOTH_SIDES;
            if (r->from_left != SLI_BOTH_SIDES && turn_to_crossing(pivot, wedge->left, side, o) < 0)
                r->from_left = SLI_BOTH_SIDES;
        }
        p = side.b;
        before = sides;
    }
}

static bool holds_eye(sli_pivot *pivot, const sli_shape *shape) {
    const sl_point eye = pivot->eye;
    const sl_box *b = &shape->box;
    if (eye.x < b->min.x || eye.x > b->max.x || eye.y < b->min.y || eye.y > b->max.y) return false;
    for (uint32_t k = 0; k < shape->count && !shape->is_box; k++) {
        pivot->tests++;
        if (sli_orient(shape->corners[k], shape->corners[k + 1 < shape->count ? k + 1 : 0], eye) <
            0)
            return false;
    }
    return true;
}

unsigned sli_shape_about(sli_pivot *pivot, const sli_shape *shape, const sli_wedge *wedge,
                         const sli_occluder *occluder) {
    bool before = false, behind = false;
    for (uint32_t k = 0; k < shape->count && !(before && behind); k++) {
        const unsigned sides = sides_of(occluder, shape->corners[k]);
        pivot->tests++;
        before = before || sides == SLI_BEFORE;
        behind = behind || sides == SLI_BEHIND;
    }
    if (!behind) return SLI_BEFORE;
    if (!before) return SLI_BEHIND;
    if (shape->is_box && (occluder->a.x == occluder->b.x || occluder->a.y == occluder->b.y))
        return box_about(pivot, &shape->box, wedge, occluder);
    reach r = {0};
    if (holds_eye(pivot, shape)) r.from_right = r.from_left = SLI_BEFORE;
    for (uint32_t k = 0; k < shape->count; k++)
        reach_corner(pivot, wedge, shape->corners[k], sides_of(occluder, shape->corners[k]), &r);
    if ((r.from_right & r.from_left) != SLI_BOTH_SIDES)
        reach_crossings(pivot, shape, wedge, occluder, &r);
    return r.from_right & r.from_left;
}

bool sli_occluder_is_behind(const sli_occluder *one, const sli_occluder *other) {
    if (sli_orient(other->a, other->b, one->a) <= 0 && sli_orient(other->a, other->b, one->b) <= 0)
        return true;
    return sli_orient(one->a, one->b, other->a) >= 0 && sli_orient(one->a, one->b, other->b) >= 0;
}
