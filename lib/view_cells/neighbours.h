/// Which leaves share a piece of boundary.
#ifndef SL_VIEW_NEIGHBOURS_H
#define SL_VIEW_NEIGHBOURS_H

#include "sightline/support.h"
#include "sightline/view_cells.h"

typedef struct sl_view_pair {
    uint32_t a, b;
    sl_segment shared; ///< the piece
} sl_view_pair;

typedef SL_ARRAY(sl_view_pair) sl_view_pairs;

/// Adds each pair of leaves that are neighbours, once for each piece that they share.
/// Pieces of oblique splits overlap within rounding.
sl_status sl_view_neighbours(sl_context *context, const sl_view_tree *tree, sl_view_pairs *out);

#endif
