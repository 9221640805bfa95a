/// The kd-tree of axial walls, from sorted walls to the rooms of the finished space.
#ifndef SL_KD_TREE_H
#define SL_KD_TREE_H

#include "sightline/map.h"
#include "sightline/space.h"
#include "sightline/support.h"

// --- axial walls by line

/// A wall or a part of one: on the line x = at (axis 0) or y = at (axis 1), from lo to hi in the
/// other coordinate, lo < hi.
typedef struct sli_piece {
    double at, lo, hi;
    int axis;
    uint32_t seam; ///< 0 for a wall; for a part of a seam, 1 + its number
} sli_piece;

/// The order of pieces by axis, at, lo, for qsort.
int sli_compare_pieces(const void *left, const void *right);

/// Sorts walls so. SL_BAD_INPUT names a wall that is not axial, as `map` calls
/// it (NULL: none), or a place where two walls overlap.
sl_status sli_wall_lines(sl_context *context, const sl_map *map, const sl_wall *walls, size_t count,
                         sli_piece **out);

/// The first of `count` sorted pieces that is on the line and ends after `lo`, or is on a later
/// line.
size_t sli_wall_lines_find(const sli_piece *pieces, size_t count, int axis, double at, double lo);

/// Whether walls cover lo .. hi on a line without a gap.
bool sli_wall_lines_cover(const sli_piece *pieces, size_t count, int axis, double at, double lo,
                          double hi);

// --- the tree

/// The walls on the split line of a node, within its region: on_splits[first .. first + count).
typedef struct sli_split_walls {
    size_t first, count;
} sli_split_walls;

typedef struct sli_kd_tree {
    SL_ARRAY(sl_node) nodes;
    SL_ARRAY(sli_split_walls) splits; ///< by node
    SL_ARRAY(sli_piece) on_splits;    ///< sorted along each line
    SL_ARRAY(sl_box) cells;           ///< the regions of leaves, in tree order
    int32_t root;
    uint32_t depth;
} sli_kd_tree;

/// Builds the tree over walls sorted by line. `tree` is zeroed; destroy it also on failure.
sl_status sli_kd_build(sl_context *context, const sli_piece *walls, size_t count, sl_box bounds,
                       const sl_subdivide_options *options, sli_kd_tree *tree);
void sli_kd_destroy(sl_context *context, sli_kd_tree *tree);

/// Makes the portals and directed portals of a space from its tree and cells.
sl_status sli_make_portals(sl_context *context, const sli_kd_tree *tree, sl_space *space);

/// The order of a space's portals, for qsort.
int sli_compare_portals(const void *left, const void *right);
/// Makes the directed portals of a space's portals. The cells have none yet.
sl_status sli_make_directed(sl_context *context, sl_space *space);

/// SL_BAD_INPUT for a map without walls, which has no size.
sl_status sli_check_has_walls(sl_context *context, const sl_map *map);

/// The bounds of a space: those of the map; wider where they would have no area, and where a wall
/// on their border does not stop all, so that there are cells on both sides of it.
sl_box sli_space_bounds(const sl_map *map);

/// Marks the cells that are solid, and those that are inside (inside.c). A mesh does not need
/// `walls`. SL_BAD_INPUT, with the line, where the map contradicts itself: see sl_space.
sl_status sli_mark_inside(sl_context *context, const sl_map *map, const sli_piece *walls,
                          sl_space *space);

/// Gives walls the marks of solid ground, and of open ground across, that the space's cells have
/// (inside.c): those of a file have none yet. The space must pass sl_space_check.
void sli_ground_of_cells(sl_space *space);

// --- rooms (rooms.c)

/// As sli_outline_make, with walls in `count` of the portals, which have both directions: rooms end
/// there. Portal i of the list is the wall space->wall_count + i. (outline.c)
sl_status sli_outline_make_walled(sl_context *context, const sl_space *space,
                                  const uint32_t *portals, uint32_t count, sl_outline *out);

/// Replaces the boundaries of cells in an outline by those of rooms. Lists for each cell the rooms
/// that have a part of it.
sl_status sli_rooms_make(sl_context *context, sl_outline *outline);

// --- splits of a finished space

/// The split of a node.
typedef struct sli_split {
    uint32_t depth; ///< the number of nodes above it
    sl_box below, above;
    sl_segment along; ///< the split line within the node's box
} sli_split;

/// The splits of a space by node, node_count of them; sl_free() frees them. A mesh has none. The
/// space must pass sl_space_check.
sl_status sli_splits_make(sl_context *context, const sl_space *space, sli_split **out);

/// The share of a node's split that walls cover: 0 to 1.
double sli_splits_covered(const sli_split *splits, const sl_space *space, uint32_t node);

#endif
