#include "walk/shape.h"

#include "geometry/crossing.h"

/// The corners of a box that is seen from outside, rightmost and leftmost, by where the eye is:
/// left of it, over or under it, right of it; and likewise below, beside, above.
static const uint8_t box_ends[3][3][2] = {
    {{1, 3}, {0, 3}, {0, 2}},
    {{1, 0}, {0, 0}, {3, 2}},
    {{2, 0}, {2, 1}, {3, 1}},
};

static bool box_sector(const sl_shape *shape, sl_point eye, sl_sector *sector) {
    const sl_box *b = &shape->box;
    const int column = eye.x < b->min.x ? 0 : eye.x > b->max.x ? 2 : 1;
    const int row = eye.y < b->min.y ? 0 : eye.y > b->max.y ? 2 : 1;
    if (column == 1 && row == 1) return false;
    const uint8_t *ends = box_ends[column][row];
    *sector = (sl_sector){sl_ray_to(shape->corners[ends[0]]), sl_ray_to(shape->corners[ends[1]])};
    return true;
}

uint32_t sl_shape_sectors(sl_pivot *pivot, const sl_shape *shape, sl_sector *sectors) {
    if (shape->is_box && box_sector(shape, pivot->eye, sectors)) return 1;
    uint32_t inner = 0, facing = 0;
    sl_sector outer = {.right = sl_ray_to(shape->corners[0])};
    const sl_point *corners = shape->corners;
    const uint32_t last = shape->count - 1;
    pivot->tests += shape->count;
    bool before = sl_orient(corners[last], corners[0], pivot->eye) < 0;
    for (uint32_t k = 0; k <= last; k++) {
        const sl_point from = corners[k], to = corners[k < last ? k + 1 : 0];
        const int side = sl_orient(from, to, pivot->eye);
        if (side > 0) sectors[inner++] = (sl_sector){sl_ray_to(from), sl_ray_to(to)};
        // The sides that face the eye are one chain, which runs from the left to the right.
        if (side < 0 && !before) outer.left = sl_ray_to(from);
        if (side >= 0 && before) outer.right = sl_ray_to(from);
        before = side < 0;
        facing += before;
    }
    if (!facing) return inner;
    sectors[0] = outer;
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

/// A cone of more than half a turn: what is left of its right border, and of the rest what is right
/// of its left one.
static unsigned in_wide_cone(sl_pivot *pivot, const sl_walk_cone *cone, const sl_sector *sector,
                             sl_sector parts[2], bool *cut) {
    unsigned count = 0;
    const sl_split split = sl_sector_split(pivot, sector, cone->right);
    if (sl_has_left(split)) parts[count++] = sl_left_part(sector, split, cone->right);
    if (!sl_has_right(split)) return count;
    const sl_sector right = sl_right_part(sector, split, cone->right);
    const sl_split rest = sl_sector_split(pivot, &right, cone->left);
    if (sl_has_right(rest)) parts[count++] = sl_right_part(&right, rest, cone->left);
    *cut = *cut || sl_has_left(rest);
    return count;
}

unsigned sl_sector_in_cone(sl_pivot *pivot, const sl_walk_cone *cone, const sl_sector *sector,
                           sl_sector parts[2], bool *cut) {
    if (cone->kind == SL_CONE_WIDE) return in_wide_cone(pivot, cone, sector, parts, cut);
    parts[0] = *sector;
    if (cone->kind == SL_CONE_ALL) return 1;
    if (cone->kind == SL_CONE_NONE) return *cut = true, 0;
    const sl_split first = sl_sector_split(pivot, sector, cone->right);
    *cut = *cut || sl_has_right(first);
    if (!sl_has_left(first)) return 0;
    if (sl_has_right(first)) parts[0] = sl_left_part(sector, first, cone->right);
    if (cone->kind == SL_CONE_HALF) return 1;
    const sl_split second = sl_sector_split(pivot, &parts[0], cone->left);
    *cut = *cut || sl_has_left(second);
    if (sl_has_left(second) && sl_has_right(second))
        parts[0] = sl_right_part(&parts[0], second, cone->left);
    return sl_has_right(second);
}

// --- about an occluder

/// Whether a box that the eye is not behind has directions within a sector. Its borders lie within
/// half a turn of the sector's.
static bool box_meets(sl_pivot *pivot, const sl_box *box, const sl_sector *sector) {
    const sl_point corners[4] = {
        box->min, {box->max.x, box->min.y}, box->max, {box->min.x, box->max.y}};
    sl_sector own;
    if (!box_sector(&(sl_shape){corners, 4, *box, true}, pivot->eye, &own)) return true;
    return sl_ray_turn(pivot, sector->right, own.left) > 0 &&
           sl_ray_turn(pivot, sector->left, own.right) < 0;
}

/// The line of an axial occluder cuts a box into two, of the same coordinates.
static unsigned box_about(sl_pivot *pivot, const sl_box *box, const sl_sector *sector,
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
    const unsigned before = box_meets(pivot, eye_below ? &lower : &upper, sector) ? SL_BEFORE : 0;
    const unsigned behind = box_meets(pivot, eye_below ? &upper : &lower, sector) ? SL_BEHIND : 0;
    return before | behind;
}

/// Of the parts of a shape before an occluder's line and behind it, those of which a place is known
/// left of the sector's right border, and right of its left border. Those of both have directions
/// within the sector: from where they are, they lie within half a turn of it.
typedef struct reach {
    unsigned from_right, from_left;
} reach;

enum { BOTH = SL_BEFORE | SL_BEHIND };

/// On which sides of an occluder's line a point is.
static unsigned sides_of(const sl_occluder *o, sl_point p) {
    const int side = sl_orient(o->a, o->b, p);
    return side > 0 ? SL_BEFORE : side < 0 ? SL_BEHIND : BOTH;
}

static void reach_corner(sl_pivot *pivot, const sl_sector *sector, sl_point p, unsigned sides,
                         reach *r) {
    const sl_ray ray = sl_ray_to(p);
    if (sides & ~r->from_right && sl_ray_turn(pivot, sector->right, ray) > 0)
        r->from_right |= sides;
    if (sides & ~r->from_left && sl_ray_turn(pivot, sector->left, ray) < 0) r->from_left |= sides;
}

/// The turn from a ray to where a side of the shape crosses the occluder's line.
static int turn_to_crossing(sl_pivot *pivot, sl_ray ray, sl_segment side, const sl_occluder *o) {
    pivot->tests++;
    const int turn = sl_crossing_side(pivot->eye, ray.point, side, (sl_segment){o->a, o->b});
    return ray.away ? -turn : turn;
}

/// Both parts reach to where the line cuts the shape's sides.
static void reach_crossings(sl_pivot *pivot, const sl_shape *shape, const sl_sector *sector,
                            const sl_occluder *o, reach *r) {
    sl_point p = shape->corners[shape->count - 1];
    unsigned before = sides_of(o, p);
    for (uint32_t k = 0; k < shape->count; k++) {
        const sl_segment side = {p, shape->corners[k]};
        const unsigned sides = sides_of(o, side.b);
        if (!(before & sides)) {
            if (r->from_right != BOTH && turn_to_crossing(pivot, sector->right, side, o) > 0)
                r->from_right = BOTH;
            if (r->from_left != BOTH && turn_to_crossing(pivot, sector->left, side, o) < 0)
                r->from_left = BOTH;
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

unsigned sl_shape_about(sl_pivot *pivot, const sl_shape *shape, const sl_sector *sector,
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
        return box_about(pivot, &shape->box, sector, occluder);
    reach r = {0};
    if (holds_eye(pivot, shape)) r.from_right = r.from_left = SL_BEFORE;
    for (uint32_t k = 0; k < shape->count; k++)
        reach_corner(pivot, sector, shape->corners[k], sides_of(occluder, shape->corners[k]), &r);
    if ((r.from_right & r.from_left) != BOTH) reach_crossings(pivot, shape, sector, occluder, &r);
    return r.from_right & r.from_left;
}

bool sl_occluder_is_behind(const sl_occluder *one, const sl_occluder *other) {
    if (sl_orient(other->a, other->b, one->a) <= 0 && sl_orient(other->a, other->b, one->b) <= 0)
        return true;
    return sl_orient(one->a, one->b, other->a) >= 0 && sl_orient(one->a, one->b, other->b) >= 0;
}
