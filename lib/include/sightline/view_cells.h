/// View cells that adapt to what is seen (Mattausch, Bittner & Wimmer 2006, Adaptive
/// Visibility-Driven View Cell Construction): for a number of view cells, those with the lowest
/// expected render cost.
///
/// The steps: visibility segments (samples of what sees what) and a scene (render costs, places of
/// viewpoints) give a tree of elementary view cells. Merging gives a hierarchy of them. A cut of
/// the hierarchy is a set of view cells.
///
/// Sampling estimates costs and places view cells; it decides no visibility. Its arithmetic is
/// rounded.
#ifndef SIGHTLINE_VIEW_CELLS_H
#define SIGHTLINE_VIEW_CELLS_H

#include "sightline/cell_to_cell.h"
#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

// --- what is seen

/// What the objects in potentially visible sets are.
typedef enum sl_view_objects {
    SL_VIEW_WALLS, ///< the space's walls: a segment sees the walls at its ends
    SL_VIEW_CELLS, ///< the space's cells: a segment sees the cells that it passes
} sl_view_objects;

/// Start from sl_view_sampling_default().
typedef struct sl_view_sampling {
    sl_view_objects objects;
    uint64_t samples; ///< points drawn, with those in empty space; below 2^32
    uint64_t seed;    ///< the same seed gives the same segments for any number of threads
    unsigned threads; ///< 0: one a core
} sl_view_sampling;

/// The usual options, as told at each field.
SL_API sl_view_sampling sl_view_sampling_default(void);

/// Visibility segments: maximal free segments (section 4.1). Zeroed, there are none.
typedef struct sl_view_segments {
    uint32_t count;
    sl_segment *items;
    uint64_t *first;   ///< by segment, and one more: objects[first[s] .. first[s + 1]) are its own
    uint32_t *objects; ///< each once a segment
    uint64_t drawn;    ///< points
    uint64_t empty;    ///< points in empty space
    uint64_t unseeing; ///< points whose line ends at no wall, only at the map's border
    uint64_t lost;     ///< points on a corner or edge, whose line only touches the room
} sl_view_segments;

/// Draws points evenly over the map's bounds and directions evenly over the circle, and follows
/// each line both ways to what it hits. Points that are not inside (sl_cell.inside) are in empty
/// space and give no segment. The walk from room to room is decided by exact predicates; the ends
/// are rounded. Reports stage "sample". SL_BAD_ARGUMENT for too many samples.
SL_API sl_status sl_view_sample(sl_context *context, const sl_outline *outline,
                                const sl_view_sampling *options, sl_view_segments *out);
/// Frees segments and zeroes them.
SL_API void sl_view_segments_destroy(sl_context *context, sl_view_segments *segments);

// --- what rendering costs, and where viewpoints are

/// The time to render an object (section 3.3): max(a, b * t, c * p), where t is the number of its
/// walls and p the share of the full circle that it takes up, seen from the middle of the view
/// cell. Finite and not negative. Start from sl_render_cost_default(): 1 for each object.
typedef struct sl_render_cost {
    double a, b, c;
} sl_render_cost;

/// The usual cost model: an object costs 1.
SL_API sl_render_cost sl_render_cost_default(void);

/// Places of viewpoints: convex polygons and single points, each with its share of the probability.
typedef struct sl_view_places {
    uint32_t count;
    sl_point *points;
    uint32_t *first; ///< by place, and one more: points[first[i] .. first[i + 1]); one, or three up
    double *mass;    ///< positive; spread evenly over the polygon
} sl_view_places;

/// Viewpoints spread evenly over the inside of a space. SL_BAD_ARGUMENT where it has none.
SL_API sl_status sl_view_places_inside(sl_context *context, const sl_space *space,
                                       sl_view_places *out);
/// Viewpoints along a map's paths, walked at constant speed: the points inside, `step` apart.
/// SL_BAD_ARGUMENT for none, for more than ten million, and for a step that is not positive.
SL_API sl_status sl_view_places_paths(sl_context *context, const sl_map *map, const sl_space *space,
                                      double step, sl_view_places *out);
/// Viewpoints by a density: values that are not negative, on a grid over the bounds of the space,
/// row after row from the lower left, each spread evenly over its square. SL_BAD_ARGUMENT where
/// none is positive.
SL_API sl_status sl_view_places_density(sl_context *context, const sl_space *space,
                                        const double *values, uint32_t columns, uint32_t rows,
                                        sl_view_places *out);
/// Frees places and zeroes them.
SL_API void sl_view_places_destroy(sl_context *context, sl_view_places *places);

/// All that costs depend on besides the view cells.
typedef struct sl_view_scene {
    const sl_space *space; ///< the caller's, as all else here
    sl_view_objects objects;
    sl_render_cost cost;
    const sl_view_places *places;
} sl_view_scene;

// --- elementary view cells

/// A split of view space. A child c >= 0 is node c, a child c < 0 is leaf ~c.
typedef struct sl_view_node {
    double position; ///< x = position (axis 0) or y = position (axis 1)
    int32_t axis;    ///< 2: along the line through lines[line], from its a to its b
    int32_t below;   ///< where the coordinate is below the position; strictly right of the line
    int32_t above;   ///< elsewhere
    int32_t line;    ///< 0 but for axis 2
} sl_view_node;

/// A binary space partition of the bounds. Nodes are in the order of splitting: the first k of them
/// make k + 1 leaves. Leaves below cell_count are elementary view cells; the rest are empty space.
typedef struct sl_view_tree {
    sl_box bounds;
    int32_t root; ///< as a child of a node
    uint32_t node_count, leaf_count, cell_count, line_count;
    sl_view_node *nodes;
    sl_segment *lines;
    sl_point *corners; ///< of the leaves' polygons, counter-clockwise
    uint32_t *edges;   ///< by corner: the node that made the side from there; UINT32_MAX: border
    uint32_t *first;   ///< by leaf, and one more: corners[first[i] .. first[i + 1])
    double *mass;      ///< by leaf: the probability that a viewpoint is in it
} sl_view_tree;

/// Frees a tree and zeroes it.
SL_API void sl_view_tree_destroy(sl_context *context, sl_view_tree *tree);

/// The leaf that holds a point. Exact. A point on a split line belongs to the leaf right of or over
/// it, or left of an oblique line. SL_NO_VIEW_CELL outside the bounds and for NaN.
SL_API uint32_t sl_view_tree_locate(const sl_view_tree *tree, sl_point point);

/// Start from sl_view_subdivision_default().
typedef struct sl_view_subdivision {
    uint32_t cells;       ///< stop at this many elementary view cells, at least 1
    double least_gain;    ///< stop where splits gain less than this share of the first cost ...
    uint32_t patience;    ///< ... this many times in a row, at least 1
    double cost_weight;   ///< of a cell's own cost in its priority, 0 to 1; 0.01 in the paper
    uint32_t weighed;     ///< most segments used to choose a cell's split, at least 1
    uint32_t candidates;  ///< axis-aligned splits tried for a cell; 0: all that can be best
    uint32_t wall_splits; ///< lines of walls tried for a cell; 0: only axis-aligned splits
    double visible_share; ///< KD-VT: cells that see up to this share of all are not split
    uint32_t deepest;     ///< KD-VT*: cells at this depth are not split
    uint64_t seed;        ///< of candidates that are drawn
    sl_sight sight;       ///< "hybrid": which lines count
    unsigned threads;     ///< of "hybrid", 0: one a core; the result does not depend on it
} sl_view_subdivision;

/// The usual options, as told at each field.
SL_API sl_view_subdivision sl_view_subdivision_default(void);

/// Sets of objects, a row of bits each.
typedef struct sl_view_sets {
    uint32_t count, object_count;
    size_t words;   ///< of a row
    uint64_t *bits; ///< bit o % 64 of word o / 64 of a row: object o is in the set
} sl_view_sets;

/// The work of a method by exact sets. A room is a cell of the space or, where objects are walls, a
/// convex part of it. A look is a search from one piece of one room within one quadrant of
/// directions.
typedef struct sl_view_work {
    uint64_t rooms;      ///< searched from by the passes that come first
    uint64_t cuts;       ///< pieces cut in two
    uint64_t looks;      ///< in passes and from pieces
    uint64_t candidates; ///< rooms in the refine sets of all looks
    uint64_t relations;  ///< rooms in directed visible sets: the results of all looks
    uint64_t tests;      ///< portal sequences tested by the solver
    uint64_t weighed;    ///< objects in directed visible sets used to choose splits
} sl_view_work;

/// What methods by exact sets find besides a tree. Zeroed: nothing. Free the sets.
typedef struct sl_view_found {
    sl_view_sets sets; ///< of the elementary view cells
    sl_view_work work;
} sl_view_found;

/// What each elementary view cell of a tree sees, by the segments that pass it. `threads`: 0 for
/// one per core.
SL_API sl_status sl_view_sets_sample(sl_context *context, const sl_view_scene *scene,
                                     const sl_view_tree *tree, const sl_view_segments *segments,
                                     unsigned threads, sl_view_sets *out);
/// Frees sets and zeroes them.
SL_API void sl_view_sets_destroy(sl_context *context, sl_view_sets *sets);

// --- the hierarchy and its cuts

/// An inner part of a hierarchy: it joins two earlier ones. Numbers below cell_count are elementary
/// view cells, c + cell_count is joints[c].
typedef struct sl_view_joint {
    uint32_t parts[2];
} sl_view_joint;

/// A hierarchy over elementary view cells: the first j joints leave cell_count - j view cells. The
/// arrays are by number: the render cost of a viewpoint there (rounded), the probability of a
/// viewpoint, the size of the set, and the bytes of the set as runs (pvs.h).
typedef struct sl_view_hierarchy {
    uint32_t cell_count;   ///< at least 1; there is one joint fewer
    sl_view_joint *joints; ///< the last one is all of view space
    double *cost, *mass;
    uint32_t *objects;
    uint64_t *bytes;
} sl_view_hierarchy;

/// Frees a hierarchy and zeroes it.
SL_API void sl_view_hierarchy_destroy(sl_context *context, sl_view_hierarchy *hierarchy);

/// A method of making view cells, reachable by name. Each divides view space into a tree. `merges`
/// says whether cells are then merged by cost (the merge history tree, section 4.3) or joined in
/// the reverse order of splits.
///
/// "hybrid" uses exact directed visible sets in place of samples (Laine 2005 names this as future
/// work). View space is one view cell at first. The split with the largest gain by the cost model
/// comes next. The sets of rooms come from a multipass pass in each quadrant. A room that is cut is
/// searched from again, among what it saw.
///
/// Its sets are exact: the objects that a sightline through portals reaches, where the sightline
/// passes the view cell or, with closed sight, touches it. With open sight that is what the cells
/// see that the view cell's borders cut out of the space. With closed sight those cells may miss an
/// object that is seen only by grazing lines, which would have to cross a border both ways. This
/// holds in a kd-tree's space. Where a split crosses an oblique side of a cell, the crossing is
/// rounded: the sets are exact for pieces with this corner, and part of what the whole cell sees.
/// SL_UNSUPPORTED with wall_splits.
typedef struct sl_view_method {
    const char *name, *what;
    bool merges;
    bool needs_segments; ///< others may be given none
    bool exact;          ///< it finds the exact sets of its view cells
    /// `found`: set by exact methods only; may be NULL.
    sl_status (*divide)(sl_context *context, const sl_view_scene *scene,
                        const sl_view_segments *segments, const sl_view_subdivision *options,
                        sl_view_tree *out, sl_view_found *found);
} sl_view_method;

/// All methods, *count of them.
SL_API const sl_view_method *sl_view_methods(size_t *count);

/// Makes a hierarchy: of the splits themselves, or with `merges` (sl_view_method.merges) the merge
/// history, in which always the two neighbours that cost least to merge become one. Neighbours
/// share a piece of boundary. Where none are left, because view space is in several parts, the two
/// lowest numbers are merged. `sets`: what the elementary cells see. Reports stage "merge".
SL_API sl_status sl_view_hierarchy_make(sl_context *context, const sl_view_scene *scene,
                                        const sl_view_tree *tree, const sl_view_sets *sets,
                                        bool merges, sl_view_hierarchy *out);

/// The same joints, measured by other sets: so a hierarchy can be evaluated by segments that were
/// not used to make it.
SL_API sl_status sl_view_evaluate(sl_context *context, const sl_view_scene *scene,
                                  const sl_view_tree *tree, const sl_view_hierarchy *hierarchy,
                                  const sl_view_sets *sets, sl_view_hierarchy *out);

/// The expected cost (equation 1) and the bytes of all sets, for the cut with n view cells at place
/// n - 1 of each array. Either may be NULL.
SL_API void sl_view_curve(const sl_view_hierarchy *hierarchy, double *costs, uint64_t *bytes);

/// Where to cut (section 5.1). Each gives a number of view cells, from 1 to the number of
/// elementary cells.
///
/// As many view cells as fit into a number of bytes.
SL_API sl_status sl_view_cut_by_bytes(sl_context *context, const sl_view_hierarchy *hierarchy,
                                      uint64_t bytes, uint32_t *cells);
/// As few view cells as cost up to 1 + tolerance times what the elementary cells do.
SL_API sl_status sl_view_cut_by_cost(sl_context *context, const sl_view_hierarchy *hierarchy,
                                     double tolerance, uint32_t *cells);

/// The view cells of a cut, ascending by the lowest of their elementary cells: view_cells[e] is the
/// view cell of elementary cell e, numbers[v] the number of view cell v in the hierarchy. Arrays of
/// cell_count and of `cells` items.
SL_API sl_status sl_view_cut(sl_context *context, const sl_view_hierarchy *hierarchy,
                             uint32_t cells, uint32_t *view_cells, uint32_t *numbers);

/// The pieces of boundary between different view cells, and between view cells and empty space. The
/// caller frees the array with sl_free (sightline/support.h).
SL_API sl_status sl_view_borders(sl_context *context, const sl_view_tree *tree,
                                 const uint32_t *view_cells, sl_segment **borders, size_t *count);

/// The shapes of the view cells of a cut, `count` of them: what their elementary cells cover, as
/// polygons with holes. Points are corners of the tree. Polygons of one shape meet in single points
/// at most. Free it with sl_view_shapes_destroy.
SL_API sl_status sl_view_shapes(sl_context *context, const sl_view_tree *tree,
                                const uint32_t *view_cells, uint32_t count, sl_shapes *out);
/// Frees what sl_view_shapes gave and zeroes it.
SL_API void sl_view_shapes_destroy(sl_context *context, sl_shapes *shapes);

// --- exact sets, for use

/// Adds the borders of view cells to a map as seams. Then no cell of a space made of it lies in two
/// view cells (but for rounding where walls are oblique), and a view cell sees what its cells see,
/// by any method. `objects`, a space of the map or NULL: its portals become seams too. Then no cell
/// lies in two of its cells either, as sl_view_rows_cost needs.
SL_API sl_status sl_view_add_seams(sl_context *context, const sl_view_tree *tree,
                                   const uint32_t *view_cells, const sl_space *objects,
                                   sl_map *map);

/// What each elementary view cell sees, as exactly as `method` is, in cells of the scene's space.
/// The scene's objects must be cells (SL_BAD_ARGUMENT). View cells merged and measured by these
/// sets depend on samples only in where they were split. `map` is the map of the scene's space.
SL_API sl_status sl_view_sets_exact(sl_context *context, const sl_map *map,
                                    const sl_view_scene *scene, const sl_view_tree *tree,
                                    const sl_see_method *method, const sl_see_options *options,
                                    sl_view_sets *out);

/// Makes the rows of the view cells of a cut (as from sl_view_cut), over a space with their seams,
/// from what its cells see. Only cells inside count. `compressed`: what two siblings of the
/// hierarchy both see is stored once, above them; else there are no nodes above. SL_BAD_ARGUMENT
/// where the space has fewer cells than there are nodes.
SL_API sl_status sl_view_rows_make(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                                   const sl_view_tree *tree, const sl_view_hierarchy *hierarchy,
                                   uint32_t cells, bool compressed, sl_view_rows *out);

/// The expected cost (equation 1) by exact sets, in cells of the scene's own space; its objects
/// must be cells. `space` is the one with the seams, also along the scene's portals. `hierarchy`
/// and `cells` define the cut.
SL_API sl_status sl_view_rows_cost(sl_context *context, const sl_view_scene *scene,
                                   const sl_space *space, const sl_view_rows *rows,
                                   const sl_view_hierarchy *hierarchy, uint32_t cells,
                                   double *cost);

#ifdef __cplusplus
}
#endif

#endif
