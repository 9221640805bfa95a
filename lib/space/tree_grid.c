/// A grid over the kd-tree of a space, so that points are located in a few steps.
#include "base/base.h"
#include "space/index.h"

/// Buckets for each cell of the space. More are hardly faster.
enum { BUCKETS_FOR_A_CELL = 4 };

/// About square buckets.
static void choose_size(const sl_space *space, sli_tree_grid *out) {
    const sl_box *b = &space->bounds;
    const double most = fmin((double)BUCKETS_FOR_A_CELL * space->cell_count, INT32_MAX);
    const double wide = sqrt(most * ((b->max.x - b->min.x) / (b->max.y - b->min.y)));
    out->columns = (uint32_t)fmin(fmax(wide, 1), most);
    out->rows = (uint32_t)(most / out->columns);
}

/// Where a bucket starts, or with `end` 1 where it ends, and 1/1024 of a bucket beyond. Whoever
/// rounds a coordinate to a column or row errs by far less; and what is rounded last here is this
/// place, so that no number that is beyond it becomes less.
static double edge(double low, double high, uint32_t count, uint32_t bucket, int end) {
    const double beyond = end ? 1 + 1.0 / 1024 : -1.0 / 1024;
    return low + (high - low) / count * (bucket + beyond);
}

/// The node or cell, coded as a child, where the ways to the points of a box part.
static int32_t common_start(const sl_space *space, const sl_box *box) {
    int32_t at = space->root;
    while (at >= 0) {
        const sl_node *node = &space->nodes[at];
        if ((node->axis ? box->min.y : box->min.x) >= node->position)
            at = node->above;
        else if ((node->axis ? box->max.y : box->max.x) < node->position)
            at = node->below;
        else
            break;
    }
    return at;
}

sl_status sli_tree_grid_make(sl_context *context, const sl_space *space, sli_tree_grid *out) {
    const sl_box *b = &space->bounds;
    choose_size(space, out);
    out->starts = sl_alloc_array(context, (size_t)out->columns * out->rows, sizeof *out->starts);
    if (!out->starts) return SL_NO_MEMORY;
    int32_t *at = out->starts;
    for (uint32_t row = 0; row < out->rows; row++)
        for (uint32_t column = 0; column < out->columns; column++) {
            const sl_box box = {{edge(b->min.x, b->max.x, out->columns, column, 0),
                                 edge(b->min.y, b->max.y, out->rows, row, 0)},
                                {edge(b->min.x, b->max.x, out->columns, column, 1),
                                 edge(b->min.y, b->max.y, out->rows, row, 1)}};
            *at++ = common_start(space, &box);
        }
    return SL_OK;
}
