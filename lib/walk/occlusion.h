/// What the chosen occluders of a frame hide: their shadows merged, in one of two ways.
///
/// The directions about the eye are cut at the occluders' ends into sectors, leaves. A leaf has the
/// occluders that span it and of which none is known to stand behind another: none where sight is
/// free, one nearly always; more only where walls cross each other.
#ifndef SL_OCCLUSION_H
#define SL_OCCLUSION_H

#include "sightline/support.h"
#include "walk/shape.h"

/// An occluder of a leaf, and the next one, -1 for none.
typedef struct sl_shadow {
    uint32_t occluder;
    int32_t next;
} sl_shadow;

/// What leaves are made of.
typedef struct sl_shadows {
    sl_pivot pivot;
    SL_ARRAY(sl_occluder) occluders;
    SL_ARRAY(sl_shadow) shadows;
} sl_shadows;

/// A test's own data begin with this.
typedef struct sl_occlusion {
    sl_shadows shadows;
} sl_occlusion;

/// A test. Memory is allocated while frames grow.
typedef struct sl_node_test_calls {
    sl_status (*create)(sl_context *context, sl_occlusion **out);
    void (*destroy)(sl_context *context, sl_occlusion *occlusion);
    /// Empties it, for a new eye.
    sl_status (*clear)(sl_context *context, sl_occlusion *occlusion, sl_point eye);
    /// Merges an occluder's shadow within a sector that it spans. *added is set where it hides
    /// anything that was free.
    sl_status (*add)(sl_context *context, sl_occlusion *occlusion, uint32_t occluder,
                     const sl_sector *sector, bool *added);
    /// Where a shape lies within a sector of its own: bits SL_BEFORE and SL_BEHIND, added to.
    void (*look)(sl_occlusion *occlusion, const sl_shape *shape, const sl_sector *sector,
                 unsigned *bits);
} sl_node_test_calls;

extern const sl_node_test_calls sl_occlusion_tree, sl_occlusion_intervals;

/// Whether the leaf's occluders already hide what one hides within the leaf.
bool sl_shadows_hide(sl_shadows *shadows, int32_t leaf, uint32_t occluder);
/// The leaf with the occluder added, without those now hidden.
sl_status sl_shadows_add(sl_context *context, sl_shadows *shadows, int32_t leaf, uint32_t occluder,
                         int32_t *out);
/// As `look` within one leaf.
void sl_shadows_look(sl_shadows *shadows, int32_t leaf, const sl_shape *shape,
                     const sl_sector *sector, unsigned *bits);

enum { SL_LOOK_BOTH = SL_BEFORE | SL_BEHIND };

#endif
