/// What other files need of trees of elementary view cells and of sets.
#ifndef SL_VIEW_TREE_H
#define SL_VIEW_TREE_H

#include "sightline/support.h"
#include "sightline/view_cells.h"

#include <math.h>
#include <pthread.h>

/// The area that a point spans with a line, positive left of it. 0 for a point as near to the line
/// as places rounded onto it may be: a segment that ends at a wall is not behind it.
static inline double sl_view_line_side(const sl_segment *line, sl_point p) {
    const sl_point a = line->a;
    const double x = line->b.x - a.x, y = line->b.y - a.y;
    const double side = x * (p.y - a.y) - y * (p.x - a.x);
    const double reach = fabs(a.x) + fabs(a.y) + fabs(p.x) + fabs(p.y);
    return fabs(side) > 0x1p-46 * reach * (fabs(x) + fabs(y)) ? side : 0;
}

/// The mean of a leaf's corners.
sl_point sl_view_leaf_middle(const sl_view_tree *tree, uint32_t leaf);

/// The mean of the corners of a space's cell.
sl_point sl_view_cell_middle(const sl_space *space, uint32_t cell);

/// The cell of another space that one lies in, of which no side runs through it. In a kd-tree's
/// space that is where the lower left corner of its box is, which is right of or on all splits to
/// its left, and over or on all below it, however thin the cell. In a mesh's its middle, rounded.
uint32_t sl_view_cell_home(const sl_space *homes, const sl_space *space, uint32_t cell);

/// The leaf that a cell lies in which no split cuts, but for rounding where oblique walls cross the
/// splits: always on the side of the corner that is farthest from the split.
uint32_t sl_view_cell_leaf(const sl_view_tree *tree, const sl_space *space, uint32_t cell);

sl_status sl_view_sets_create(sl_context *context, uint32_t count, uint32_t object_count,
                              sl_view_sets *sets);

static inline sl_bits *sl_view_set(const sl_view_sets *sets, uint32_t row) {
    return sets->bits + row * sets->words;
}

#endif
