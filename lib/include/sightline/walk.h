/// Walking with coherence: hierarchical visibility culling frame by frame, without visible sets
/// (Bittner & Havran 2002, Exploiting coherence in hierarchical visibility algorithms).
///
/// Each frame chooses a few large occluders. What they do not hide within the view cone is the
/// visible part of the plane. A node of the hierarchy is invisible where nothing of its inside lies
/// in that part, visible where all of it does, else partially visible. What is seen only along
/// single rays counts as hidden, as for the visible region (region.h).
#ifndef SIGHTLINE_WALK_H
#define SIGHTLINE_WALK_H

#include "sightline/space.h"
#include "sightline/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A node of the hierarchy. Node 0 is the root; parents come before their children.
typedef struct sl_walk_node {
    sl_box box;       ///< in a kd-tree's space the node itself; else a box about its cells
    int32_t parent;   ///< -1 for the root
    int32_t child[2]; ///< below the split and above it; -1, -1 for a leaf
    int32_t axis;     ///< of the split; 0: at x = position, 1: at y = position
    double position;  ///< what lies below it is child 0's; not used in leaves
    uint32_t cell;    ///< of a leaf; else SL_NO_CELL
    uint32_t first_leaf, leaf_count; ///< of sl_hierarchy.leaves: those of the node
    /// Ropes (Havran, Bittner & Zara 1998), by face (left, right, lower, upper): the smallest node
    /// beyond that holds all of the face; -1 for none.
    int32_t rope[4];
} sl_walk_node;

/// The hierarchy of a space, with the walls of its cells: the nodes of the kd-tree, or nested boxes
/// over the cells of a mesh, which may overlap. Zeroed, it is empty.
typedef struct sl_hierarchy {
    const sl_space *space; ///< the caller's; it must stay as long as the hierarchy
    bool tiles;            ///< a kd-tree's: children tile their parent, leaves are their boxes
    uint32_t node_count, leaf_count, occluder_count;
    uint32_t corner_most; ///< the most corners of a cell, at least 4
    sl_walk_node *nodes;
    uint32_t *leaves;     ///< cells, in the order of the nodes
    uint32_t *first_wall; ///< by cell, and one more
    uint32_t *walls;      ///< those on the boundary of cell c: from first_wall[c] on
    /// By node, and one more: the occluders that lie within it, and in neither child.
    uint32_t *first_occluder;
    sl_segment *occluders; ///< the walls, where axial ones that overlap or touch in line are one
} sl_hierarchy;

/// Time O(n log n).
SL_API sl_status sl_hierarchy_make(sl_context *context, const sl_space *space, sl_hierarchy *out);
SL_API void sl_hierarchy_destroy(sl_context *context, sl_hierarchy *hierarchy); ///< and zeroes it

/// How much of a node is seen.
typedef enum sl_node_state {
    SL_NODE_INVISIBLE, ///< nothing of its inside is in the visible part
    SL_NODE_PARTIAL,
    SL_NODE_VISIBLE, ///< all of its inside is
} sl_node_state;

/// A node visibility test: how the occluders' shadows are merged and nodes are looked up. All tests
/// give the same answer. It is exact for the chosen occluders and the node's box, or a leaf's cell.
typedef struct sl_node_test {
    const char *name, *what;
    const struct sli_node_test_calls *calls; ///< the library's own
} sl_node_test;

/// All tests: "tree", "intervals".
SL_API const sl_node_test *sl_node_tests(size_t *count);

/// The most occluders that a frame may have.
#define SL_WALK_OCCLUDERS_MOST 1024

/// Start from sl_walk_options_default().
typedef struct sl_walk_options {
    const sl_node_test *test;
    uint32_t occluders; ///< at most this many a frame, up to SL_WALK_OCCLUDERS_MOST; usually 16
    uint32_t cheap;     ///< nodes with up to this many walls are drawn untested; usually 0: none
    double p_vp;        ///< chance that visibility propagation is tried; usually 0.5
    double p_skip;      ///< chance that what was drawn is drawn again untested; usually 0.5
    uint64_t seed;      ///< of all chances
} sl_walk_options;

/// The usual options, as told at each field.
SL_API sl_walk_options sl_walk_options_default(void);

/// What a method draws, compared with the classical method in the same frame. All methods draw all
/// that is seen.
typedef enum sl_walk_agreement {
    SL_WALK_AS_CLASSICAL, ///< the same: leaves have the same states in every frame
    SL_WALK_MAYBE_MORE,   ///< the same, and maybe more
    /// Less where a node is known from earlier frames to be hidden; more where nodes are drawn
    /// untested.
    SL_WALK_MAYBE_EITHER,
} sl_walk_agreement;

/// A method of walking: reachable by name, listed everywhere from this table.
typedef struct sl_walk_method {
    const char *name, *what;
    sl_walk_agreement agreement;
    unsigned policies; ///< the library's own
} sl_walk_method;

/// All methods, the classical one first: "classical", "updating", "propagation", "skipping" (A to D
/// in the paper), "adaptive", "predicting", "bounded", "combined".
SL_API const sl_walk_method *sl_walk_methods(size_t *count);

/// What decided a node's state, in the frame in which it was last visited.
typedef enum sl_walk_reason {
    SL_WALK_FRUSTUM,    ///< outside the view cone
    SL_WALK_CHEAP,      ///< cheaper to draw than to test
    SL_WALK_TESTED,     ///< the node visibility test
    SL_WALK_OPENED,     ///< nothing: the last frame opened it, and this one does again
    SL_WALK_PROPAGATED, ///< its neighbours' states
    SL_WALK_SKIPPED,    ///< chance: it was drawn in the last frame
    SL_WALK_PULLED_UP,  ///< its children's states, which have different reasons
    /// The eye has not moved far enough since a test for the occluders of that frame to give
    /// another answer. A leaf of which they leave a part in view is partially visible, even where
    /// all of it is.
    SL_WALK_BOUNDED,
} sl_walk_reason;

/// What a frame did; counts of nodes unless said otherwise.
typedef struct sl_walk_frame {
    uint32_t occluders;                ///< chosen
    uint32_t visited;                  ///< reached on the way down
    uint32_t frustum_tests;            ///< by view frustum culling
    uint32_t tests;                    ///< by the node visibility test
    uint32_t cheap;                    ///< drawn untested because they are cheap
    uint32_t opened;                   ///< not tested because the last frame opened them
    uint32_t propagations, propagated; ///< tries to take a state from neighbours, and successes
    uint32_t skipped;                  ///< drawn untested because the last frame drew them
    uint32_t bounded;                  ///< known to be still hidden, or still in view
    uint32_t out, invisible, partial, visible; ///< visited, by state; `out`: of the view cone
    uint32_t cells;                            ///< to be drawn
    uint64_t orientations;                     ///< orientation tests
} sl_walk_frame;

/// A walk: keeps from frame to frame what its method needs. For one thread at a time.
typedef struct sl_walk sl_walk;

/// Hierarchy and method must outlive the walk. SL_BAD_ARGUMENT for options out of range. Frames
/// allocate memory only while they grow.
SL_API sl_status sl_walk_create(sl_context *context, const sl_hierarchy *hierarchy,
                                const sl_walk_method *method, const sl_walk_options *options,
                                sl_walk **out);
/// Frees a walk; NULL is fine.
SL_API void sl_walk_destroy(sl_context *context, sl_walk *walk);

/// The next frame: classifies what the view sees. An eye outside the bounds looks in from there. A
/// cone of 0 degrees sees nothing. SL_BAD_ARGUMENT for a view that is not usable.
SL_API sl_status sl_walk_step(sl_context *context, sl_walk *walk, const sl_view *view,
                              sl_walk_frame *out);

/// A node's state in the last frame. A node that was not reached has the state of the nearest node
/// above it that was.
SL_API sl_node_state sl_walk_state(const sl_walk *walk, uint32_t node, sl_walk_reason *reason);

/// The cells to be drawn in the last frame: bit c % 64 of word c / 64 is cell c. All cells that
/// the view sees by more than single rays are among them.
SL_API const uint64_t *sl_walk_cells(const sl_walk *walk);

#ifdef __cplusplus
}
#endif

#endif
