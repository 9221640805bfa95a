/// Top-down subdivision of view space: parts of it, each with the segments that pass it, are split
/// one after the other in the order that the method gives.
#ifndef SL_VIEW_DIVIDE_H
#define SL_VIEW_DIVIDE_H

#include "base/heap.h"
#include "study/view_cells/pieces.h"
#include "study/view_cells/view_cell_tree.h"

#include <math.h>

// --- a priority queue

typedef struct sli_view_entry {
    double key;
    uint32_t a, b;
} sli_view_entry;

/// The largest key first, of equal ones that with the lowest numbers.
static inline bool sli_view_is_before(const sli_view_entry *x, const sli_view_entry *y) {
    if (x->key != y->key) return x->key > y->key;
    return x->a != y->a ? x->a < y->a : x->b < y->b;
}

SLI_HEAP(sli_view_queue, sli_view_entry, sli_view_is_before)

// --- dividing

/// A split: along an axis at a position, or (axis 2) along a line, below being right of it.
typedef struct sli_view_split {
    int32_t axis;
    double position;
    sl_segment line;
    double gain; ///< in expected cost, by the segments
} sli_view_split;

/// The pieces of sl_view_places within a part.
typedef struct sli_view_share {
    sli_view_points points;
    SL_ARRAY(uint32_t) ends; ///< by piece: where its points end
    SL_ARRAY(double) mass;   ///< of each piece
} sli_view_share;

/// A leaf of the tree while it grows.
typedef struct sli_view_part {
    sli_view_points corners;
    SL_ARRAY(uint32_t) edges;  ///< as in sl_view_tree
    sli_view_numbers segments; ///< those that pass it
    sli_view_numbers pieces;   ///< those that make it up, where there are any
    sli_view_share share;
    sl_box box;     ///< about the corners
    bool is_box;    ///< no oblique split made it
    double mass;    ///< of `share`
    double seen;    ///< cost of rendering all that its segments see
    uint32_t depth; ///< splits above it
    int32_t parent; ///< node that leads here, -1 for none
    bool above;     ///< which child of it
    sli_view_split split;
    struct sli_view_part_halves *cut; ///< its halves, where they were found ahead
} sli_view_part;

/// A part split in two, with the halves of its pieces that lie on both sides, in order. The node is
/// not made yet: sides on the split have the edge SLI_VIEW_EDGE_NEW.
typedef struct sli_view_part_halves {
    sli_view_part below, above;
    SL_ARRAY(sli_view_halves) pieces;
} sli_view_part_halves;

#define SLI_VIEW_EDGE_NEW (UINT32_MAX - 1)

/// Where along an axis an object starts or ends to be seen, and its cost.
typedef struct sli_view_event {
    double at, cost;
} sli_view_event;

typedef SL_ARRAY(sli_view_event) sli_view_events;

typedef struct sli_view_divider {
    sl_context *context;
    const sl_view_scene *scene;
    const sl_view_segments *segments;
    sli_view_pieces *pieces;
    const sl_view_subdivision *options;
    sli_view_render render;
    sl_random random;
    double all_seen;               ///< cost of rendering all objects
    SL_ARRAY(sli_view_part) parts; ///< the leaves
    SL_ARRAY(sl_view_node) nodes;
    SL_ARRAY(sl_segment) lines;
    uint32_t with_mass; ///< parts that are not empty space
    uint64_t made;      ///< parts that a method has queued
    sli_view_queue queue;
    // Scratch for choosing splits.
    sli_view_extent *extents; ///< by object; low over high for those not seen
    uint8_t *sides;           ///< by object: 1: seen right of a line, 2: left of it
    sli_view_numbers seen;    ///< objects that the part sees
    sli_view_events starts, ends;
    SL_ARRAY(double) positions;
    SL_ARRAY(sl_segment) clipped; ///< the part's segments, clipped to it
    sli_view_numbers walls;
} sli_view_divider;

/// Sets part->split and *priority (the highest is split first). *splits is false for a part that
/// stays whole. Called once for each part with mass.
typedef sl_status (*sli_view_choose)(sli_view_divider *d, sli_view_part *part, double *priority,
                                     bool *splits);

/// `segments` or `pieces` give what is seen; either or both may be NULL. Pieces are those of all
/// rooms, from sli_view_pieces_create; they are cut as parts are split, by options->threads
/// threads. `stops_early`: by least_gain and patience. `sets`: what pieces see, by leaf with mass;
/// may be NULL.
sl_status sli_view_divide(sl_context *context, const sl_view_scene *scene,
                          const sl_view_segments *segments, sli_view_pieces *pieces,
                          const sl_view_subdivision *options, sli_view_choose choose,
                          bool stops_early, sl_view_tree *out, sl_view_sets *sets);

/// The split across an axis in the middle of a part; false where doubles allow none. `gain` is 0.
bool sli_view_split_middle(const sli_view_part *part, int axis, sli_view_split *out);
int sli_view_longer_axis(const sli_view_part *part);

/// One of this many of a part's segments is weighed, so that no more are than the options say.
static inline size_t sli_view_step(const sli_view_divider *d, const sli_view_part *part) {
    return part->segments.count ? 1 + (part->segments.count - 1) / d->options->weighed : 1;
}

/// Finds what a part's segments or pieces see: the extents of objects, and part->seen. The caller
/// has the extents forgotten before the next part.
void sli_view_find_extents(sli_view_divider *d, sli_view_part *part);
void sli_view_forget_extents(sli_view_divider *d);
/// Finds part->seen alone.
void sli_view_find_seen(sli_view_divider *d, sli_view_part *part);

/// Replaces *best by the axis-aligned split with the largest gain, if that is better (splits.c).
sl_status sli_view_choose_axes(sli_view_divider *d, const sli_view_part *part,
                               sli_view_split *best);
/// The same along the lines of walls within the part.
sl_status sli_view_choose_walls(sli_view_divider *d, const sli_view_part *part,
                                sli_view_split *best);

/// sli_view_find_extents for pieces (divide.c).
void sli_view_find_piece_extents(sli_view_divider *d, sli_view_part *part);

/// The split along a wall's line.
sli_view_split sli_view_split_along(const sl_wall *wall);
/// The walls that go into a part and whose lines divide it: all, or `most` of them at random.
sl_status sli_view_walls_within(sli_view_divider *d, const sli_view_part *part, uint32_t most,
                                sli_view_numbers *out);

// --- geometry of parts (view_cell_parts.c)

static inline double sli_along(sl_point p, int axis) {
    return axis ? p.y : p.x;
}

/// Where a point lies: below a split (negative), on it or above it.
static inline double sli_view_side(const sli_view_split *split, sl_point p) {
    return split->axis < 2 ? sli_along(p, split->axis) - split->position
                           : sli_view_line_side(&split->line, p);
}

sl_point sli_view_part_middle(const sli_view_part *part);
void sli_view_part_destroy(sl_context *context, sli_view_part *part);

/// The part of a segment within a part of view space; a point where rounding leaves nothing.
sl_segment sli_view_part_clip(const sli_view_part *part, const sl_segment *segment);

/// Cuts a part's polygon and share in two. `node` is the one that splits it.
sl_status sli_view_part_cut(sl_context *context, const sli_view_part *part,
                            const sli_view_split *split, uint32_t node, sli_view_part *below,
                            sli_view_part *above);

/// The mass of a share below a split.
double sli_view_share_below(const sli_view_share *share, const sli_view_split *split);

#endif
