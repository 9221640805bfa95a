/// Shapes about an eye: in which directions does a node lie, and on which side of an occluder?
#ifndef SL_SHAPE_H
#define SL_SHAPE_H

#include "eye_to_cell/cone.h"
#include "sightline/support.h"
#include "sightline/view.h"

/// Directions strictly between two rays, counter-clockwise from right to left: more than 0 and
/// less than 180 degrees.
typedef struct sl_wedge {
    sl_ray right, left;
} sl_wedge;

/// A convex polygon of positive area, counter-clockwise, and its bounding box.
typedef struct sl_shape {
    const sl_point *corners;
    uint32_t count;
    sl_box box;
    bool is_box; ///< the polygon is its box, from the lower left corner on
} sl_shape;

/// A wall that hides what is behind it. The eye is strictly left of the line from a to b.
typedef struct sl_occluder {
    sl_point a, b;
} sl_occluder;

static inline sl_ray sl_ray_back(sl_ray ray) {
    ray.away = !ray.away;
    return ray;
}

/// How a ray's line lies to a wedge: the turns from the ray to the wedge's borders. The line cuts
/// the wedge where they are opposite; else the wedge lies on the side of the one that is not 0.
typedef struct sl_split {
    int right, left;
} sl_split;

static inline sl_split sl_wedge_split(sl_pivot *pivot, const sl_wedge *wedge, sl_ray ray) {
    return (sl_split){sl_ray_turn(pivot, ray, wedge->right), sl_ray_turn(pivot, ray, wedge->left)};
}

static inline bool sl_has_left(sl_split split) {
    return split.right > 0 || split.left > 0;
}

static inline bool sl_has_right(sl_split split) {
    return split.right < 0 || split.left < 0;
}

/// The part of a wedge left of the ray's line. It must not be empty.
static inline sl_wedge sl_left_part(const sl_wedge *wedge, sl_split split, sl_ray ray) {
    sl_wedge part = *wedge;
    if (split.right < 0) part.right = ray;
    if (split.left < 0) part.left = sl_ray_back(ray);
    return part;
}

/// The part right of the line.
static inline sl_wedge sl_right_part(const sl_wedge *wedge, sl_split split, sl_ray ray) {
    sl_wedge part = *wedge;
    if (split.right > 0) part.right = sl_ray_back(ray);
    if (split.left > 0) part.left = ray;
    return part;
}

/// The directions in which a shape's inside lies, as disjoint wedges: one where the eye is outside,
/// else one for each side that the eye is not on. Returns how many, at most the shape's `count`.
uint32_t sl_shape_wedges(sl_pivot *pivot, const sl_shape *shape, sl_wedge *wedges);

/// A view cone as open wedges, made once a frame.
typedef struct sl_walk_cone {
    enum { SL_CONE_ALL, SL_CONE_NONE, SL_CONE_WEDGE, SL_CONE_HALF, SL_CONE_WIDE } kind;
    sl_ray right, left;
} sl_walk_cone;

sl_walk_cone sl_walk_cone_of(sl_pivot *pivot, const sl_view *view);

/// Clips a wedge to the cone: up to two parts. Returns how many. Sets *cut where something was
/// taken off, and else leaves it.
unsigned sl_wedge_in_cone(sl_pivot *pivot, const sl_walk_cone *cone, const sl_wedge *wedge,
                          sl_wedge parts[2], bool *cut);

/// Where the inside of a shape lies about an occluder, within a wedge that the occluder spans:
/// bits, at least one. Exact: what is set for a shape is set for every shape that holds it. The
/// wedge must be part of one of the shape's.
enum { SL_BEFORE = 1, SL_BEHIND = 2, SL_BOTH_SIDES = SL_BEFORE | SL_BEHIND };
unsigned sl_shape_about(sl_pivot *pivot, const sl_shape *shape, const sl_wedge *wedge,
                        const sl_occluder *occluder);

/// Whether one occluder hides nothing beyond what the other hides, within a wedge that both span.
bool sl_occluder_is_behind(const sl_occluder *one, const sl_occluder *other);

// --- The node visibility tests: the shadows of a frame's occluders, merged in one of two ways.

/// An occluder of a leaf, and the next one of the leaf, -1 for none.
typedef struct sl_shadow {
    uint32_t occluder;
    int32_t next;
} sl_shadow;

/// The occluders, and the lists of all leaves.
typedef struct sl_shadows {
    sl_pivot pivot;
    SL_ARRAY(sl_occluder) occluders;
    SL_ARRAY(sl_shadow) shadows;
} sl_shadows;

/// The data of either test begins with this.
typedef struct sl_occlusion {
    sl_shadows shadows;
} sl_occlusion;

/// A test. Memory is allocated while frames grow.
typedef struct sl_node_test_calls {
    sl_status (*create)(sl_context *context, sl_occlusion **out);
    void (*destroy)(sl_context *context, sl_occlusion *occlusion);
    /// Empties it, for a new eye.
    sl_status (*clear)(sl_context *context, sl_occlusion *occlusion, sl_point eye);
    /// Merges an occluder's shadow within a wedge that it spans. Sets *added where it hides
    /// anything that was free.
    sl_status (*add)(sl_context *context, sl_occlusion *occlusion, uint32_t occluder,
                     const sl_wedge *wedge, bool *added);
    /// Adds to the bits where the part of a shape in a wedge of its own lies: SL_BEFORE, SL_BEHIND.
    void (*query)(sl_occlusion *occlusion, const sl_shape *shape, const sl_wedge *wedge,
                  unsigned *bits);
} sl_node_test_calls;

extern const sl_node_test_calls sl_occlusion_tree, sl_occlusion_intervals;

#endif
