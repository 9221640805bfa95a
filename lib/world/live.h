/// A mesh that lives: a triangulation that changes, the cells that its triangles are merged to, and
/// the space and the outline of these cells. It is changed in three steps:
///
/// 1. The triangulation is edited (space/triangulator.h). Its journal says which triangles are new.
/// 2. sli_live_plan: the cells that lost a triangle are taken apart, and merged again.
/// 3. sli_live_apply: the new cells are written into the space.
///
/// Only the last step changes the space, and it cannot fail. sli_live_undo takes back the others.
///
/// Numbers: portal e and wall e of the space are edge e of the triangulation, so there are gaps.
/// Sides of the outline, directed portals and vertices of a cell are at the same places, in a block
/// of the cell's own.
#ifndef SL_WORLD_LIVE_H
#define SL_WORLD_LIVE_H

#include "space/index.h"
#include "space/triangulator.h"
#include "world/blocks.h"

/// What an edge of the graph is.
typedef struct sli_live_edge {
    bool wall;     ///< else a seam
    uint32_t from; ///< the point where the wall starts
    uint32_t line; ///< sl_wall.line
    uint32_t ground;
} sli_live_edge;

/// Says what the edge with a label is.
typedef sli_live_edge sli_live_label(void *user, uint32_t label);

/// A seam on an edge: one-way glass, or a limited wall.
typedef struct sli_live_seam {
    uint32_t seam, from; ///< its number, and the point where it starts
    bool limits;         ///< a limited wall
} sli_live_seam;

/// Says which seams are on an edge with a label: the k-th one; false where there are no more.
typedef bool sli_live_seams(void *user, uint32_t label, uint32_t k, sli_live_seam *out);

/// A cell to come.
typedef struct sli_live_cell {
    uint32_t first_triangle, triangle_count; ///< in `triangles`
    uint32_t half;                           ///< a side
    uint32_t corners;
    uint32_t number;                     ///< of the cell that stays as it is, else SL_NO_CELL
    uint32_t first_bucket, bucket_count; ///< in `new_buckets`
} sli_live_cell;

/// A side that may be removed.
typedef struct sli_live_side {
    double length;
    uint32_t half;
} sli_live_side;

typedef SL_ARRAY(uint32_t) sli_numbers;

static inline sl_status sli_numbers_push(sl_context *context, sli_numbers *list, uint32_t number) {
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = number;
    return SL_OK;
}

typedef struct sli_live {
    sl_context *context; ///< of the call under way
    sli_triangulation triangles;
    sli_triangulator maker;
    sli_live_label *label;
    sli_live_seams *seams;
    void *user;
    size_t seam_room;
    bool new_seams; ///< some were written, so the list of seam portals is to be sorted
    bool limits;    ///< there are limited walls, or were: the outline lists them

    // By half-edge.
    uint32_t *owner; ///< the cell of its triangle; SL_NO_CELL outside
    uint32_t *place; ///< of a side of a cell: its place in space.vertices
    uint32_t *mark;  ///< of a half-edge that is its triangle's lowest: the edit that it is part of
    uint32_t *wrote; ///< the edit that last wrote it
    size_t half_room, place_room, mark_room, wrote_room;
    uint8_t *inner; ///< by edge: it is within a cell
    size_t inner_room;
    uint32_t now; ///< the mark of this edit

    // By cell.
    uint32_t *half_of;   ///< a side; of a number that is free the next free one
    uint32_t *dissolved; ///< the mark of the edit that took it apart
    size_t half_of_room, dissolved_room, cell_room;
    uint32_t free_cell; ///< 1 + the first free number

    sl_space space;
    sl_outline outline;
    uint32_t *room_of;     ///< the outline's
    uint8_t *bucket_class; ///< by bucket: the size of its block
    sli_blocks corners, bucket_blocks;
    size_t corner_room, entry_room, edge_room;
    uint32_t live_count; ///< cells that there are
    bool planned;

    // The edit.
    sli_numbers region; ///< its triangles, each by its lowest half-edge
    sli_numbers old;    ///< cells taken apart
    SL_ARRAY(sli_live_side) sides;
    sli_numbers unmerged;     ///< edges that were within a cell before the edit
    sli_numbers merged;       ///< edges that were not, and are
    sli_numbers triangles_of; ///< by new cell
    SL_ARRAY(sli_live_cell) cells;
    sli_bucket_list new_buckets, old_buckets;
    SL_ARRAY(sl_point) loop;
    sl_cell ground;         ///< what new cells have for `inside` and `solid`
    sli_numbers gone, came; ///< cells, as of the last edit
} sli_live;

/// Makes the mesh of a graph, with a label 1 + its number for each edge. Destroy it also on
/// failure.
sl_status sli_live_create(sl_context *context, const sli_planar *graph, const sl_box *bounds,
                          sli_live_label *label, sli_live_seams *seams, void *user, sli_live *out);
void sli_live_destroy(sl_context *context, sli_live *live); ///< and zeroes it

/// A half-edge near a point, to start walks.
void sli_live_go_near(sli_live *live, sl_point at);

/// Begins new marks: `now` is one that nothing has yet.
void sli_live_next_mark(sli_live *live);

sl_status sli_live_plan(sli_live *live);
void sli_live_apply(sli_live *live);
void sli_live_undo(sli_live *live);

/// A copy of the space without gaps: cells in the order of their numbers. `numbers`: by cell of the
/// live space, its number there; NULL for none.
sl_status sli_live_pack(sl_context *context, const sli_live *live, uint32_t *numbers,
                        sl_space *out);

static inline uint32_t sli_live_next(const sli_live *live, uint32_t half) {
    return live->triangles.halves.items[half].next;
}

static inline bool sli_live_is_free(const sli_live *live, uint32_t half) {
    return live->triangles.halves.items[half].from == UINT32_MAX;
}

static inline sl_point sli_live_start(const sli_live *live, uint32_t half) {
    return live->triangles.points.items[live->triangles.halves.items[half].from];
}

static inline sl_point sli_live_end(const sli_live *live, uint32_t half) {
    return sli_live_start(live, half ^ 1);
}

/// The next side of the cell of a side, counter-clockwise.
static inline uint32_t sli_live_next_side(const sli_live *live, uint32_t half) {
    uint32_t next = sli_live_next(live, half);
    while (live->inner[next / 2]) next = sli_live_next(live, next ^ 1);
    return next;
}

/// The lowest half-edge of a triangle.
static inline uint32_t sli_live_triangle(const sli_live *live, uint32_t half) {
    const uint32_t b = sli_live_next(live, half), c = sli_live_next(live, b);
    return half < b ? (half < c ? half : c) : (b < c ? b : c);
}

// --- the space (live_space.c)

/// Makes room for what the new cells need.
sl_status sli_live_room(sli_live *live);
/// Writes the new cells, and drops the old ones.
void sli_live_write(sli_live *live);
/// Makes the grid of a space that has none.
sl_status sli_live_start_grid(sli_live *live);

#endif
