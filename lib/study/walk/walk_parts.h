/// What the parts of a walk share: what is remembered of each node, the walk, and the node
/// visibility test.
#ifndef SL_WALK_PARTS_H
#define SL_WALK_PARTS_H

#include "sightline/support.h"
#include "sightline/walk.h"
#include "study/walk/shape.h"

/// What a method does besides the classical way: bits.
enum {
    SLI_WALK_UPDATES = 1,    ///< does not test nodes that the last frame opened; pulls states up
    SLI_WALK_PROPAGATES = 2, ///< takes a node's state from its neighbours where they decide it
    SLI_WALK_SKIPS = 4,      ///< takes what was drawn as visible without a test, by chance
    SLI_WALK_ADAPTS = 8,     ///< sets the chances by each node's history
    SLI_WALK_PREDICTS = 16,  ///< assumes that leaves stay partially visible, by their history
    SLI_WALK_BOUNDS = 32,    ///< tests no node before the eye has moved far enough to matter
};

/// A share of successes over the last few tries.
typedef struct sli_walk_history {
    uint8_t tries, hits;
} sli_walk_history;

/// What holds for a node while the eye stays near enough.
typedef enum sli_walk_known {
    SLI_WALK_HIDDEN,  ///< all of it is hidden
    SLI_WALK_IN_VIEW, ///< the occluders then chosen hide nothing of it
    SLI_WALK_WITNESS, ///< they do not hide a point inside it
} sli_walk_known;

/// What is known of a node since it was last visited.
typedef struct sli_walk_memory {
    uint64_t frame; ///< when that was; 0 for never
    uint8_t state, reason;
    bool spread;              ///< propagation decided its state when it was last visited
    sli_walk_history kept;    ///< of the times it was drawn: a test found that it still is
    sli_walk_history spreads; ///< how often propagation succeeded
    uint8_t known;            ///< an sli_walk_known, that holds for eyes nearer to ...
    sl_point from;
    double bound;          ///< ... this point than this
    uint8_t wait, waiting; ///< tests without a search for a bound: in all, and still to come
    sl_point witness;      ///< a point of it that is seen
} sli_walk_memory;

typedef struct sli_chooser sli_chooser;

struct sl_walk {
    const sl_hierarchy *hierarchy;
    const sl_walk_method *method;
    sl_walk_options options;
    const sli_node_test_calls *test;
    sli_occlusion *occlusion;
    sli_chooser *chooser;
    sl_view view; ///< the frame's
    double moved; ///< no less than how far the eye moved to this frame
    sli_walk_cone cone;
    sli_walk_memory *nodes;
    uint64_t *stack;
    sli_wedge *wedges; ///< of the node in question, within the cone
    sl_bits *cells;
    uint32_t *wall_counts; ///< by node: the sum over its cells
    uint64_t frame;
    sl_random random;
};

/// A node as the eye sees it. Its wedges within the cone are in sl_walk.wedges until the next call.
typedef struct sli_node_view {
    sl_point box_corners[4];
    sli_shape shape;
    uint32_t wedge_count; ///< 0: outside the cone
    bool cut;             ///< part of it is outside the cone
} sli_node_view;

/// Fills *seen.
void sli_walk_view_node(sl_walk *walk, uint32_t node, sli_node_view *seen);
/// The node visibility test.
sl_node_state sli_walk_test(sl_walk *walk, const sli_node_view *seen);

/// Chooses the occluders of a frame: the largest that are visible (occluders.c).
sl_status sli_chooser_create(sl_context *context, const sl_hierarchy *hierarchy, sli_chooser **out);
void sli_chooser_destroy(sl_context *context, sli_chooser *chooser);
/// Fills the walk's occlusion, which must be clear.
sl_status sli_chooser_choose(sl_context *context, sl_walk *walk, const sl_view *view);

/// How far the eye may move, in any direction, before an invisible node can be seen; 0 where that
/// is not known (walk_bounds.c).
double sli_walk_hidden_bound(sl_walk *walk, const sli_node_view *seen);
/// How far before the occluders of this frame can hide something of a node.
double sli_walk_whole_bound(sl_walk *walk, const sli_node_view *seen);
/// How far before they can hide a point inside a node and in the view cone: the best of a few
/// points, *witness.
double sli_walk_witness_bound(sl_walk *walk, const sli_node_view *seen, sl_point *witness);

/// No less than the distance that an eye has moved.
double sli_walk_moved(sl_point from, sl_point to);

/// Counts a try. Forgets half of the past whenever there are many.
static inline void sli_walk_note(sli_walk_history *history, bool hit) {
    enum { MUCH = 16 };
    if (history->tries == MUCH) {
        history->tries /= 2;
        history->hits /= 2;
    }
    history->tries++;
    history->hits += hit;
}

/// The estimated share of successes; a half where nothing is known (Laplace's rule).
static inline double sli_walk_share(const sli_walk_history *history) {
    return (history->hits + 1.) / (history->tries + 2.);
}

#endif
