/// What the files of this folder share: trees of elementary view cells, sets, and render costs.
#ifndef SL_VIEW_TREE_H
#define SL_VIEW_TREE_H

#include "sightline/support.h"
#include "sightline/view_cells.h"

#include <math.h>

/// Twice the area that a point spans with a line, positive left of it. 0 for a point so near to the
/// line that it may have been rounded onto it: a segment that ends at a wall is not behind it.
static inline double sli_view_line_side(const sl_segment *line, sl_point p) {
    const sl_point a = line->a;
    const double x = line->b.x - a.x, y = line->b.y - a.y;
    const double side = x * (p.y - a.y) - y * (p.x - a.x);
    const double reach = fabs(a.x) + fabs(a.y) + fabs(p.x) + fabs(p.y);
    return fabs(side) > 0x1p-46 * reach * (fabs(x) + fabs(y)) ? side : 0;
}

/// Where a point lies: below a node's split (negative), on it or above it.
static inline double sli_view_node_side(const sl_view_tree *tree, const sl_view_node *node,
                                        sl_point p) {
    if (node->axis < 2) return (node->axis ? p.y : p.x) - node->position;
    return sli_view_line_side(&tree->lines[node->line], p);
}

/// The mean of a leaf's corners.
sl_point sli_view_leaf_middle(const sl_view_tree *tree, uint32_t leaf);

/// The cell of another space that a cell lies in; no side of that one runs through it. In a
/// kd-tree's space it is found by the lower left corner of the cell's box, however thin the cell
/// is: a point on a split is right of it, or over it. In a mesh it is found by the cell's rounded
/// middle.
uint32_t sli_view_cell_home(const sl_space *homes, const sl_space *space, uint32_t cell);

/// The leaf that a cell lies in. No split cuts the cell, but for rounding where oblique walls cross
/// splits: it is on the side of its corner that is farthest from the split.
uint32_t sli_view_cell_leaf(const sl_view_tree *tree, const sl_space *space, uint32_t cell);

sl_status sli_view_sets_create(sl_context *context, uint32_t count, uint32_t object_count,
                               sl_view_sets *sets);

static inline sl_bits *sli_view_set(const sl_view_sets *sets, uint32_t row) {
    return sets->bits + row * sets->words;
}

// --- neighbours

/// A coordinate that grows along a node's split.
double sli_view_along(const sl_view_tree *tree, const sl_view_node *node, sl_point p);

typedef struct sli_view_pair {
    uint32_t a, b;
    sl_segment shared; ///< the piece
} sli_view_pair;

typedef SL_ARRAY(sli_view_pair) sli_view_pairs;

/// Adds each pair of leaves that are neighbours, once for each piece that they share.
/// Pieces of oblique splits overlap within rounding.
sl_status sli_view_neighbours(sl_context *context, const sl_view_tree *tree, sli_view_pairs *out);

// --- render costs (view_cell_scene.c)

typedef struct sli_view_render {
    const sl_view_scene *scene;
    uint32_t object_count;
    double *fixed; ///< by object: max(a, b * t)
    bool even;     ///< all of these are the same, and c is 0
} sli_view_render;

sl_status sli_view_render_make(sl_context *context, const sl_view_scene *scene,
                               sli_view_render *out);
void sli_view_render_destroy(sl_context *context, sli_view_render *render);

/// The share of the full circle that an object takes up, seen from a place.
double sli_view_render_share(const sli_view_render *render, uint32_t object, sl_point from);

/// The cost of an object, seen from a place.
static inline double sli_view_render_object(const sli_view_render *render, uint32_t object,
                                            sl_point from) {
    const double fixed = render->fixed[object], c = render->scene->cost.c;
    if (!(c > 0)) return fixed;
    const double seen = c * sli_view_render_share(render, object, from);
    return seen > fixed ? seen : fixed;
}

/// The cost of a set with this many words, seen from a place.
double sli_view_render_set(const sli_view_render *render, const sl_bits *set, size_t words,
                           sl_point from);

#endif
