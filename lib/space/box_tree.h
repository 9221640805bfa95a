/// Boxes in a tree: those that meet a box, without asking all. (A packed R-tree: Kamel & Faloutsos
/// 1993, On packing R-trees, here packed along the Z-order curve.)
#ifndef SL_SPACE_BOX_TREE_H
#define SL_SPACE_BOX_TREE_H

#include "sightline/geometry.h"
#include "sightline/support.h"

/// Deep enough for 2^32 boxes.
enum { SL_BOX_TREE_LEVELS = 12 };

/// Zeroed, it is empty.
typedef struct sl_box_tree {
    uint32_t *items; ///< the boxes' numbers as they stand on the lowest level
    sl_box *boxes;   ///< level after level, the lowest first; each of the next is around 8 of them
    size_t first[SL_BOX_TREE_LEVELS + 1]; ///< where each level starts; one more at the end
    uint32_t levels;
} sl_box_tree;

typedef struct sl_box_list {
    uint32_t *items;
    size_t count, capacity;
} sl_box_list;

/// The box around two points.
sl_box sl_box_around(sl_point a, sl_point b);
/// The box around a box and a point.
sl_box sl_box_with(sl_box box, sl_point point);

/// Fewer than 2^32 boxes, of coordinates that are no NaN; they are copied. `out` is to be
/// destroyed whatever comes.
sl_status sl_box_tree_create(sl_context *context, const sl_box *boxes, size_t count,
                             sl_box_tree *out);
void sl_box_tree_destroy(sl_context *context, sl_box_tree *tree); ///< and zeroes it

/// The numbers of the boxes that meet a box, be it at a border, ascending, in the place of what was
/// found before. The list begins zeroed; sl_free(items) ends it.
sl_status sl_box_tree_find(sl_context *context, const sl_box_tree *tree, const sl_box *box,
                           sl_box_list *found);

#endif
