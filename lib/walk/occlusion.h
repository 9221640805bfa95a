/// The node visibility tests: the shadows of a frame's occluders, merged in one of two ways.
#ifndef SL_OCCLUSION_H
#define SL_OCCLUSION_H

#include "sightline/support.h"
#include "walk/shape.h"

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
