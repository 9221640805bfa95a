/// The kd-tree while it is built: what the later steps of making a space need of it.
#ifndef SL_KD_TREE_H
#define SL_KD_TREE_H

#include "sightline/space.h"
#include "space/wall_lines.h"

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

#endif
