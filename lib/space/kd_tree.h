/// The kd-tree while it is built: what the later steps of making a space need of it.
#ifndef SL_KD_TREE_H
#define SL_KD_TREE_H

#include "sightline/map.h"
#include "sightline/outline.h"
#include "sightline/space.h"
#include "sightline/support.h"

// --- axial walls by line

/// A wall, or what a region leaves of one: on the line x = at (axis 0) or y = at (axis 1), from lo
/// to hi in the other coordinate, lo < hi.
typedef struct sl_piece {
    double at, lo, hi;
    int axis;
    uint32_t seam; ///< 0 for a wall; else 1 + the part of the seams that this is of
} sl_piece;

/// All walls, by axis, at, lo. SL_BAD_INPUT names the first wall of `source` that is not axial, and
/// one that overlaps another.
sl_status sl_wall_lines(sl_context *context, const char *source, const sl_wall *walls, size_t count,
                        sl_piece **out);

/// The first of `count` sorted pieces on the line or beyond whose end is past `lo`.
size_t sl_wall_lines_find(const sl_piece *pieces, size_t count, int axis, double at, double lo);

/// Whether walls cover all of lo .. hi on a line.
bool sl_wall_lines_cover(const sl_piece *pieces, size_t count, int axis, double at, double lo,
                         double hi);

// --- the tree

/// The walls on a node's split line, within the node's region: pieces[first .. first + count).
typedef struct sl_split_walls {
    size_t first, count;
} sl_split_walls;

typedef struct sl_kd_tree {
    SL_ARRAY(sl_node) nodes;
    SL_ARRAY(sl_split_walls) splits; ///< one a node
    SL_ARRAY(sl_piece) on_splits;    ///< what splits index, sorted along each line
    SL_ARRAY(sl_box) cells;          ///< the leaves' regions, in tree order
    int32_t root;
    uint32_t depth;
} sl_kd_tree;

/// Builds the tree over walls sorted by line. `tree` is zeroed, and to be destroyed whatever comes.
sl_status sl_kd_build(sl_context *context, const sl_piece *walls, size_t count, sl_box bounds,
                      const sl_subdivide_options *options, sl_kd_tree *tree);
void sl_kd_destroy(sl_context *context, sl_kd_tree *tree);

/// Makes the space's portals and directed portals from its tree and cells.
sl_status sl_make_portals(sl_context *context, const sl_kd_tree *tree, sl_space *space);

/// For qsort: the order that a space's portals have.
int sl_compare_portals(const void *left, const void *right);
/// Gives cells, which count no directed portals yet, the directed portals of the space's portals.
sl_status sl_make_directed(sl_context *context, sl_space *space);

/// SL_BAD_INPUT for a map without walls: it has no size.
sl_status sl_check_has_walls(sl_context *context, const sl_map *map);

/// A map whose walls all lie on one line has no area: what it lacks is added on both sides.
sl_box sl_padded(sl_box box);

/// Marks the cells that are inside: reached from the map's starts, or, where it has none, not
/// reached from the border. Where that leaves none, all are. `walls` is not looked at where the
/// space tells its sides.
sl_status sl_mark_inside(sl_context *context, const sl_map *map, const sl_piece *walls,
                         sl_space *space);

// --- rooms (rooms.c)

/// Replaces the boundaries of cells in an outline by those of rooms, and tells which rooms each
/// cell has a part of.
sl_status sl_rooms_make(sl_context *context, sl_outline *outline);

// --- splits of a finished space

/// What a node splits.
typedef struct sl_split {
    uint32_t depth; ///< nodes above it
    sl_box below, above;
    sl_segment along; ///< the piece of the split line that is in the node's box
} sl_split;

/// The splits of a space by node, node_count of them; to be freed with sl_free(). A mesh has none.
/// The space must be one that sl_space_check finds no fault in.
sl_status sl_splits_make(sl_context *context, const sl_space *space, sl_split **out);

/// The share of a node's split that walls on its line cover: 0 to 1.
double sl_splits_covered(const sl_split *splits, const sl_space *space, uint32_t node);

#endif
