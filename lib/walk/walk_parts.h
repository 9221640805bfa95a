/// What the parts of a walk share.
#ifndef SL_WALK_PARTS_H
#define SL_WALK_PARTS_H

#include "sightline/support.h"
#include "sightline/walk.h"
#include "walk/occlusion.h"

/// What a method does beside the classical way, or-ed.
enum {
    SL_WALK_UPDATES = 1,    ///< skips the nodes that the last frame opened, and pulls states up
    SL_WALK_PROPAGATES = 2, ///< takes a node's state from its neighbours where they allow it
    SL_WALK_SKIPS = 4,      ///< takes what was drawn as visible, by chance, without a test
    SL_WALK_ADAPTS = 8,     ///< and sets the chances by each node's history
    SL_WALK_PREDICTS = 16,  ///< takes leaves to stay partially visible, by their history
    SL_WALK_BOUNDS = 32,    ///< tests nothing before the eye has moved far enough to matter
};

/// A share of successes, as far back as the last few tries.
typedef struct sl_walk_history {
    uint8_t tries, hits;
} sl_walk_history;

/// What holds of a node while the eye is near enough.
typedef enum sl_walk_known {
    SL_WALK_HIDDEN,  ///< all of it is hidden
    SL_WALK_IN_VIEW, ///< the occluders then chosen hide nothing of it
    SL_WALK_WITNESS, ///< they do not hide a point inside it
} sl_walk_known;

/// What is known of a node since it was last visited.
typedef struct sl_walk_memory {
    uint64_t frame; ///< when that was; 0 for never
    uint8_t state, reason;
    bool spread;             ///< propagation decided of it when it was last visited
    sl_walk_history kept;    ///< of what was drawn, how often a test found it to be drawn still
    sl_walk_history spreads; ///< how often propagation succeeded
    uint8_t known;           ///< an sl_walk_known, of the eye here:
    sl_point from;
    double bound;          ///< and wherever is less far off than this
    uint8_t wait, waiting; ///< tests without a search for a bound: in all, and to come
    sl_point witness;      ///< where it is known to be seen in part
} sl_walk_memory;

typedef struct sl_chooser sl_chooser;

struct sl_walk {
    const sl_hierarchy *hierarchy;
    const sl_walk_method *method;
    sl_walk_options options;
    const sl_node_test_calls *test;
    sl_occlusion *occlusion;
    sl_chooser *chooser;
    sl_view view; ///< the frame's
    double moved; ///< no less than how far the eye moved to this frame
    sl_walk_cone cone;
    sl_walk_memory *nodes;
    uint64_t *stack;
    sl_sector *sectors; ///< those of the node at hand, within the cone
    sl_bits *cells;
    uint32_t *wall_counts; ///< by node, those of its cells added up
    uint64_t frame;
    sl_random random;
};

/// A node as it is seen: its sectors within the cone are the walk's, until the next look.
typedef struct sl_walk_look {
    sl_point box_corners[4];
    sl_shape shape;
    uint32_t sector_count; ///< 0: outside the cone
    bool cut;              ///< part of it is outside the cone
} sl_walk_look;

void sl_walk_look_at(sl_walk *walk, uint32_t node, sl_walk_look *look);
/// The node visibility test.
sl_node_state sl_walk_test(sl_walk *walk, const sl_walk_look *look);

/// Chooses the occluders of a frame: the largest that are seen (occluders.c).
sl_status sl_chooser_create(sl_context *context, const sl_hierarchy *hierarchy, sl_chooser **out);
void sl_chooser_destroy(sl_context *context, sl_chooser *chooser);
/// Fills the walk's occlusion, which must be clear.
sl_status sl_chooser_choose(sl_context *context, sl_walk *walk, const sl_view *view);

/// How far the eye may move, any way, with an invisible node still being so; 0 where that is not
/// known (bounds.c).
double sl_walk_hidden_bound(sl_walk *walk, const sl_walk_look *look);
/// Likewise with nothing of a node being hidden by the occluders of this frame (bounds_seen.c).
double sl_walk_whole_bound(sl_walk *walk, const sl_walk_look *look);
/// Likewise with a point inside a node, and in the view's cone, being hidden by none of them: the
/// best of a few points.
double sl_walk_witness_bound(sl_walk *walk, const sl_walk_look *look, sl_point *witness);

#define SL_WALK_SLACK 0x1p-50 ///< more than the rounding of a few operations, relative
/// A vector's length, to a few roundings.
double sl_walk_length(double x, double y);
/// No more than the distance from a point to the line through two others; 0 where rounding leaves
/// nothing to be sure of.
double sl_walk_clearance(sl_point p, sl_point a, sl_point b);
/// No less than how far an eye has moved.
double sl_walk_moved(sl_point from, sl_point to);

/// The state of a node by its neighbours': false where they do not tell. Nodes before it, front to
/// back, must have been visited in this frame (propagation.c).
bool sl_walk_propagate(const sl_walk *walk, uint32_t node, sl_node_state *state);

/// Counts a try. Half of what was before is forgotten whenever there is much of it.
static inline void sl_walk_note(sl_walk_history *history, bool hit) {
    enum { MUCH = 16 };
    if (history->tries == MUCH) {
        history->tries /= 2;
        history->hits /= 2;
    }
    history->tries++;
    history->hits += hit;
}

/// The estimated share of successes: a half where nothing is known (Laplace's rule).
static inline double sl_walk_share(const sl_walk_history *history) {
    return (history->hits + 1.) / (history->tries + 2.);
}

#endif
