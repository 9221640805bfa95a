/// What other files need of trees of elementary view cells and of sets.
#ifndef SL_VIEW_TREE_H
#define SL_VIEW_TREE_H

#include "base/base.h"
#include "base/bits.h"
#include "sightline/view_cells.h"

#include <math.h>
#include <pthread.h>

/// The mean of a leaf's corners.
sl_point sl_view_leaf_middle(const sl_view_tree *tree, uint32_t leaf);

/// The mean of the corners of a space's cell.
sl_point sl_view_cell_middle(const sl_space *space, uint32_t cell);

/// A place by which a space's cell is found in trees whose splits do not cut it. Of a box it is the
/// lower left corner, which is right of or on all splits to its left and over or on all below it,
/// however thin the box; else the cell's middle, rounded.
sl_point sl_view_cell_place(const sl_space *space, uint32_t cell);

sl_status sl_view_sets_create(sl_context *context, uint32_t count, uint32_t object_count,
                              sl_view_sets *sets);

static inline sl_bits *sl_view_set(const sl_view_sets *sets, uint32_t row) {
    return sets->bits + row * sets->words;
}

#endif
