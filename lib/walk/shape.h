/// Shapes about an eye: which directions a node lies in, and on which side of a wall. Decided by
/// exact predicates alone.
#ifndef SL_SHAPE_H
#define SL_SHAPE_H

#include "eye_to_cell/cone.h"
#include "sightline/view.h"

/// Directions strictly between two rays, counter-clockwise from right to left: more than 0 and
/// less than 180 degrees.
typedef struct sl_sector {
    sl_ray right, left;
} sl_sector;

/// A convex polygon of positive area, counter-clockwise, and the least box that holds it.
typedef struct sl_shape {
    const sl_point *corners;
    uint32_t count;
    sl_box box;
    bool is_box; ///< the polygon is its box, from the lower left corner on
} sl_shape;

/// A wall that hides what is behind it; the eye is strictly left of it, going from a to b.
typedef struct sl_occluder {
    sl_point a, b;
} sl_occluder;

static inline sl_ray sl_ray_back(sl_ray ray) {
    ray.away = !ray.away;
    return ray;
}

/// How a ray's line lies to a sector: the turns from the ray to its borders. It cuts the sector
/// where they are opposite, else the sector lies on the side that one of them tells.
typedef struct sl_split {
    int right, left;
} sl_split;

static inline sl_split sl_sector_split(sl_pivot *pivot, const sl_sector *sector, sl_ray ray) {
    return (sl_split){sl_ray_turn(pivot, ray, sector->right),
                      sl_ray_turn(pivot, ray, sector->left)};
}

static inline bool sl_has_left(sl_split split) {
    return split.right > 0 || split.left > 0;
}

static inline bool sl_has_right(sl_split split) {
    return split.right < 0 || split.left < 0;
}

/// The part of a sector that is left of the ray's line, which there must be.
static inline sl_sector sl_left_part(const sl_sector *sector, sl_split split, sl_ray ray) {
    sl_sector part = *sector;
    if (split.right < 0) part.right = ray;
    if (split.left < 0) part.left = sl_ray_back(ray);
    return part;
}

/// Likewise right of it.
static inline sl_sector sl_right_part(const sl_sector *sector, sl_split split, sl_ray ray) {
    sl_sector part = *sector;
    if (split.right > 0) part.right = sl_ray_back(ray);
    if (split.left > 0) part.left = ray;
    return part;
}

/// The directions in which a shape's inside lies, as sectors without common directions: one where
/// the eye is outside, else one for each side that it is not on. Returns how many, at most `count`
/// of the shape.
uint32_t sl_shape_sectors(sl_pivot *pivot, const sl_shape *shape, sl_sector *sectors);

/// A view cone, taken apart once a frame.
typedef struct sl_walk_cone {
    enum { SL_CONE_ALL, SL_CONE_NONE, SL_CONE_WEDGE, SL_CONE_HALF, SL_CONE_WIDE } kind;
    sl_ray right, left;
} sl_walk_cone;

sl_walk_cone sl_walk_cone_of(sl_pivot *pivot, const sl_view *view);

/// Narrows a sector to the cone: up to two parts; returns how many. *cut is set where something was
/// taken off, and else left as it is.
unsigned sl_sector_in_cone(sl_pivot *pivot, const sl_walk_cone *cone, const sl_sector *sector,
                           sl_sector parts[2], bool *cut);

/// Where a shape's inside lies, within a sector, about an occluder that spans the sector: bits. At
/// least one is set. Exact: what is set for a shape is set for every shape that holds it. The
/// sector must be part of one of the shape's.
enum { SL_BEFORE = 1, SL_BEHIND = 2 };
unsigned sl_shape_about(sl_pivot *pivot, const sl_shape *shape, const sl_sector *sector,
                        const sl_occluder *occluder);

/// Whether one occluder hides nothing that another does not hide, within a sector that both span.
bool sl_occluder_is_behind(const sl_occluder *one, const sl_occluder *other);

#endif
