/// Indexes over boxes, walls and cells: they find those near a place without looking at all.
#ifndef SL_SPACE_INDEX_H
#define SL_SPACE_INDEX_H

#include "sightline/geometry.h"
#include "sightline/map.h"
#include "sightline/space.h"
#include "sightline/support.h"

#include <math.h>
#include <stdbool.h>

/// Whether a seam of a space is one of the map's seams, and no door or glass.
static inline bool sli_is_map_seam(const sl_seam *seam) {
    return seam->kind == SL_SEAM_PLAIN || seam->kind == SL_SEAM_LIMITED;
}

/// SL_UNSUPPORTED, naming `who`, for a space with walls that limit sight. `or_else`: what else to
/// do about it, "" for nothing.
sl_status sli_refuse_limited(sl_context *context, const sl_space *space, const char *who,
                             const char *or_else);

// --- boxes in a tree (a packed R-tree)

/// Deep enough for 2^32 boxes.
enum { SLI_BOX_TREE_LEVELS = 12 };

/// Zeroed, it is empty.
typedef struct sli_box_tree {
    uint32_t *items; ///< the numbers of the boxes, in the order of the lowest level
    sl_box *boxes;   ///< level after level, the lowest first; a box holds 8 of the level below
    size_t first[SLI_BOX_TREE_LEVELS + 1]; ///< where each level starts; one more at the end
    uint32_t levels;
} sli_box_tree;

typedef struct sli_box_list {
    uint32_t *items;
    size_t count, capacity;
} sli_box_list;

/// The box around two points.
sl_box sli_box_around(sl_point a, sl_point b);
/// The box around a box and a point.
sl_box sli_box_with(sl_box box, sl_point point);
/// The box around a cell.
sl_box sli_box_of_cell(const sl_space *space, uint32_t cell);

/// Takes fewer than 2^32 boxes, without NaN, and copies them. Destroy `out` also on failure.
sl_status sli_box_tree_create(sl_context *context, const sl_box *boxes, size_t count,
                              sli_box_tree *out);
void sli_box_tree_destroy(sl_context *context, sli_box_tree *tree); ///< and zeroes it

/// Finds the numbers, ascending, of the boxes that meet a box; a common border is enough. Replaces
/// what the list held. The list begins zeroed; sl_free(items) ends it.
sl_status sli_box_tree_find(sl_context *context, const sli_box_tree *tree, const sl_box *box,
                            sli_box_list *found);

/// Calls `look` with the number of each box whose distance from a point is at most *most, nearest
/// branches first. `look` may lessen *most. Boxes that are farther by a rounding come, too.
/// Returns how many boxes were looked at.
size_t sli_box_tree_near(const sli_box_tree *tree, sl_point point, const double *most,
                         void (*look)(void *user, uint32_t item), void *user);

// --- walls in a tree

/// Zeroed, it is empty.
typedef struct sli_wall_index {
    const sl_wall *walls; ///< the map's
    sli_box_tree tree;
    sli_box_list near; ///< what was found last
} sli_wall_index;

/// Keeps the map's walls, which must stay where they are in memory. A wall that moves is found
/// as long as `reach` is larger by its way. Destroy `out` also on failure.
sl_status sli_wall_index_create(sl_context *context, const sl_map *map, sli_wall_index *out);
void sli_wall_index_destroy(sl_context *context, sli_wall_index *index); ///< and zeroes it

/// Puts the walls within `reach` of a segment, or of a point, into index->near, in any order. A few
/// that are a little farther may be among them.
sl_status sli_walls_near(sl_context *context, sli_wall_index *index, sl_segment at, double reach);

// --- a grid over the tree

/// For each bucket, row by row, where the ways from the root of the tree to its points part: a node
/// or a cell, coded as a child. The bucket of a point is as sli_cell_grid_step; also if that is
/// rounded otherwise.
typedef struct sli_tree_grid {
    uint32_t columns, rows;
    int32_t *starts; ///< end with sl_free
} sli_tree_grid;

/// Makes the grid of a space with a tree and bounds. It has at most 4 buckets for each cell.
sl_status sli_tree_grid_make(sl_context *context, const sl_space *space, sli_tree_grid *out);

// --- cells in a grid

/// Where the cells of a bucket end.
static inline uint32_t sli_cell_grid_stop(const sl_cell_grid *g, size_t bucket) {
    return g->stop ? g->stop[bucket] : g->first[bucket + 1];
}

typedef SL_ARRAY(uint32_t) sli_bucket_list;

/// Adds the buckets that a convex polygon reaches into, as those of sli_cell_grid_make.
sl_status sli_cell_grid_reach(sl_context *context, const sl_space *space, const sl_point *corners,
                              uint32_t count, sli_bucket_list *out);

/// Makes the grid of a space that has its cells, vertices and bounds. It has at most 4 buckets and
/// 32 entries for each cell.
sl_status sli_cell_grid_make(sl_context *context, sl_space *space);

/// Checks that each cell is in all buckets that it reaches into. The grid must be readable, and the
/// cells within the bounds. SL_BAD_INPUT names a cell that is not.
sl_status sli_cell_grid_check(sl_context *context, const sl_space *space);

void sli_cell_grid_destroy(sl_context *context, sl_cell_grid *grid); ///< and zeroes it

/// The column or row of a coordinate; there are `count` from low to high. It never decreases as the
/// coordinate grows. So a bucket is a box, however it is rounded.
static inline uint32_t sli_cell_grid_step(double value, double low, double high, uint32_t count) {
    const double step = (value - low) / (high - low) * count;
    return step < count ? (uint32_t)step : count - 1;
}

/// The bucket of a point within the bounds.
static inline uint32_t sli_cell_grid_bucket(const sl_space *space, sl_point point) {
    const sl_box *b = &space->bounds;
    const sl_cell_grid *g = &space->grid;
    return sli_cell_grid_step(point.y, b->min.y, b->max.y, g->rows) * g->columns +
           sli_cell_grid_step(point.x, b->min.x, b->max.x, g->columns);
}

/// A walk over the buckets that a box meets.
typedef struct sli_cell_grid_range {
    uint32_t from_column, to_column, to_row; ///< inclusive
    uint32_t column, row, entry;             ///< the next entry, counted in its bucket
} sli_cell_grid_range;

/// The start of a walk. A box outside the bounds gets the buckets nearest to it.
static inline sli_cell_grid_range sli_cell_grid_range_of(const sl_space *space, sl_box box) {
    const sl_box *b = &space->bounds;
    const sl_cell_grid *g = &space->grid;
    const double left = fmin(fmax(box.min.x, b->min.x), b->max.x);
    const double right = fmin(fmax(box.max.x, b->min.x), b->max.x);
    const double low = fmin(fmax(box.min.y, b->min.y), b->max.y);
    const double high = fmin(fmax(box.max.y, b->min.y), b->max.y);
    sli_cell_grid_range r = {.from_column =
                                 sli_cell_grid_step(left, b->min.x, b->max.x, g->columns),
                             .to_column = sli_cell_grid_step(right, b->min.x, b->max.x, g->columns),
                             .to_row = sli_cell_grid_step(high, b->min.y, b->max.y, g->rows),
                             .row = sli_cell_grid_step(low, b->min.y, b->max.y, g->rows)};
    r.column = r.from_column;
    return r;
}

/// The next cell that may meet the box; a cell may come several times. False after the last.
static inline bool sli_cell_grid_next(const sl_cell_grid *g, sli_cell_grid_range *r,
                                      uint32_t *cell) {
    for (; r->row <= r->to_row; r->row++, r->column = r->from_column)
        for (; r->column <= r->to_column; r->column++, r->entry = 0) {
            const uint32_t bucket = r->row * g->columns + r->column;
            const uint32_t at = g->first[bucket] + r->entry;
            if (at == sli_cell_grid_stop(g, bucket)) continue;
            r->entry++;
            *cell = g->cells[at];
            return true;
        }
    return false;
}

/// Whether a point is in a cell or on its border. Exact.
bool sli_cell_holds(const sl_space *space, uint32_t cell, sl_point point);

/// The cell that an eye looks from: as sl_space_locate, but SL_NO_CELL in solid ground.
static inline uint32_t sli_eye_cell(const sl_space *space, sl_point eye) {
    const uint32_t cell = sl_space_locate(space, eye);
    return cell != SL_NO_CELL && space->cells[cell].solid ? SL_NO_CELL : cell;
}

// --- Rays within a cell.

/// The length of a ray from a point of the cell to where it leaves the cell, as a multiple of
/// `direction`. Rounded.
static inline double sli_ray_length(const sl_space *space, uint32_t cell, sl_point from,
                                    sl_point direction) {
    const sl_cell *c = &space->cells[cell];
    const sl_point *corners = space->vertices + c->first_vertex;
    double length = INFINITY;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % c->vertex_count];
        const double nx = b.y - a.y, ny = a.x - b.x; // outwards, corners being counter-clockwise
        const double ahead = nx * direction.x + ny * direction.y;
        const double room = nx * (a.x - from.x) + ny * (a.y - from.y);
        if (ahead > 0) length = fmin(length, fmax(room / ahead, 0));
    }
    return length;
}

#endif
