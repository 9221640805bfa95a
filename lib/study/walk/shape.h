/// Shapes about an eye: in which directions does a node lie, and on which side of an occluder?
#ifndef SL_SHAPE_H
#define SL_SHAPE_H

#include "sight/cone.h"
#include "sightline/support.h"
#include "sightline/view.h"

/// Directions strictly between two rays, counter-clockwise from right to left: more than 0 and
/// less than 180 degrees.
typedef struct sli_wedge {
    sli_ray right, left;
} sli_wedge;

/// A convex polygon of positive area, counter-clockwise, and its bounding box.
typedef struct sli_shape {
    const sl_point *corners;
    uint32_t count;
    sl_box box;
    bool is_box; ///< the polygon is its box, from the lower left corner on
} sli_shape;

/// A wall that hides what is behind it. The eye is strictly left of the line from a to b.
typedef struct sli_occluder {
    sl_point a, b;
} sli_occluder;

static inline sli_ray sli_ray_back(sli_ray ray) {
    ray.away = !ray.away;
    return ray;
}

/// How a ray's line lies to a wedge: the turns from the ray to the wedge's borders. The line cuts
/// the wedge where they are opposite; else the wedge lies on the side of the one that is not 0.
typedef struct sli_split {
    int right, left;
} sli_split;

static inline sli_split sli_wedge_split(sli_pivot *pivot, const sli_wedge *wedge, sli_ray ray) {
    return (sli_split){sli_ray_turn(pivot, ray, wedge->right),
                       sli_ray_turn(pivot, ray, wedge->left)};
}

static inline bool sli_has_left(sli_split split) {
    return split.right > 0 || split.left > 0;
}

static inline bool sli_has_right(sli_split split) {
    return split.right < 0 || split.left < 0;
}

/// The part of a wedge left of the ray's line. It must not be empty.
static inline sli_wedge sli_left_part(const sli_wedge *wedge, sli_split split, sli_ray ray) {
    sli_wedge part = *wedge;
    if (split.right < 0) part.right = ray;
    if (split.left < 0) part.left = sli_ray_back(ray);
    return part;
}

/// The part right of the line.
static inline sli_wedge sli_right_part(const sli_wedge *wedge, sli_split split, sli_ray ray) {
    sli_wedge part = *wedge;
    if (split.right > 0) part.right = sli_ray_back(ray);
    if (split.left > 0) part.left = ray;
    return part;
}

/// The directions in which a shape's inside lies, as disjoint wedges: one where the eye is outside,
/// else one for each side that the eye is not on. Returns how many, at most the shape's `count`.
uint32_t sli_shape_wedges(sli_pivot *pivot, const sli_shape *shape, sli_wedge *wedges);

/// A view cone as open wedges, made once a frame.
typedef struct sli_walk_cone {
    enum { SLI_CONE_ALL, SLI_CONE_NONE, SLI_CONE_WEDGE, SLI_CONE_HALF, SLI_CONE_WIDE } kind;
    sli_ray right, left;
} sli_walk_cone;

sli_walk_cone sli_walk_cone_of(sli_pivot *pivot, const sl_view *view);

/// Clips a wedge to the cone: up to two parts. Returns how many. Sets *cut where something was
/// taken off, and else leaves it.
unsigned sli_wedge_in_cone(sli_pivot *pivot, const sli_walk_cone *cone, const sli_wedge *wedge,
                           sli_wedge parts[2], bool *cut);

/// Where the inside of a shape lies about an occluder, within a wedge that the occluder spans:
/// bits, at least one. Exact: what is set for a shape is set for every shape that holds it. The
/// wedge must be part of one of the shape's.
enum { SLI_BEFORE = 1, SLI_BEHIND = 2, SLI_BOTH_SIDES = SLI_BEFORE | SLI_BEHIND };
unsigned sli_shape_about(sli_pivot *pivot, const sli_shape *shape, const sli_wedge *wedge,
                         const sli_occluder *occluder);

/// Whether one occluder hides nothing beyond what the other hides, within a wedge that both span.
bool sli_occluder_is_behind(const sli_occluder *one, const sli_occluder *other);

// --- The node visibility tests: the shadows of a frame's occluders, merged in one of two ways.

/// An occluder of a leaf, and the next one of the leaf, -1 for none.
typedef struct sli_shadow {
    uint32_t occluder;
    int32_t next;
} sli_shadow;

/// The occluders, and the lists of all leaves.
typedef struct sli_shadows {
    sli_pivot pivot;
    SL_ARRAY(sli_occluder) occluders;
    SL_ARRAY(sli_shadow) shadows;
} sli_shadows;

/// The data of either test begins with this.
typedef struct sli_occlusion {
    sli_shadows shadows;
} sli_occlusion;

/// A test. Memory is allocated while frames grow.
typedef struct sli_node_test_calls {
    sl_status (*create)(sl_context *context, sli_occlusion **out);
    void (*destroy)(sl_context *context, sli_occlusion *occlusion);
    /// Empties it, for a new eye.
    sl_status (*clear)(sl_context *context, sli_occlusion *occlusion, sl_point eye);
    /// Merges an occluder's shadow within a wedge that it spans. Sets *added where it hides
    /// anything that was free.
    sl_status (*add)(sl_context *context, sli_occlusion *occlusion, uint32_t occluder,
                     const sli_wedge *wedge, bool *added);
    /// Adds to the bits where the part of a shape in a wedge of its own lies: SLI_BEFORE,
    /// SLI_BEHIND.
    void (*query)(sli_occlusion *occlusion, const sli_shape *shape, const sli_wedge *wedge,
                  unsigned *bits);
} sli_node_test_calls;

extern const sli_node_test_calls sli_occlusion_tree, sli_occlusion_intervals;

#endif
