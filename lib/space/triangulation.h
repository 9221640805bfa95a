/// A constrained triangulation: all points of a planar graph in a box, joined by triangles of which
/// each edge of the graph is a side.
#ifndef SL_SPACE_TRIANGULATION_H
#define SL_SPACE_TRIANGULATION_H

#include "map/planar.h"
#include "sightline/support.h"

/// Beyond the box: what a half-edge on the outside has next.
#define SL_OUTSIDE UINT32_MAX

/// One side of an edge, with a triangle at its left. The other side of half-edge h is h ^ 1.
typedef struct sl_half_edge {
    uint32_t from; ///< the point where it starts
    uint32_t next; ///< counter-clockwise around the triangle
} sl_half_edge;

/// Zeroed, it is empty. Points are those of the graph, by the same numbers, and behind them corners
/// of the box. All triangles are counter-clockwise and of positive area, by exact signs, and cover
/// the box once. No coordinate is computed.
typedef struct sl_triangulation {
    SL_ARRAY(sl_point) points;
    SL_ARRAY(sl_half_edge) halves;
    uint32_t *labels; ///< by edge (h / 2): 1 + the edge of the graph that it is, 0 for none
    size_t label_room;
    uint32_t *out; ///< by point: a half-edge within the box that starts there
} sl_triangulation;

/// Triangulates. Where no edge of the graph forbids it, triangles are Delaunay's, but for points
/// that lie nearly on one circle. SL_BAD_INPUT, naming a place, where edges cross or go through
/// points: the graph is none. Time about O(n log n).
sl_status sl_triangulate(sl_context *context, const sl_planar *graph, const sl_box *box,
                         sl_triangulation *out);
void sl_triangulation_destroy(sl_context *context, sl_triangulation *t); ///< and zeroes it

static inline uint32_t sl_half_end(const sl_triangulation *t, uint32_t half) {
    return t->halves.items[half ^ 1].from;
}

static inline bool sl_half_is_outside(const sl_triangulation *t, uint32_t half) {
    return t->halves.items[half].next == SL_OUTSIDE;
}

#endif
