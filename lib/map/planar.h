/// Segments made a planar graph: what cleaning does to a map, and what a mesh is made over.
///
/// In the graph no two edges cross, overlap or touch but in common ends, by exact predicates. Each
/// segment becomes a chain of edges.
#ifndef SL_MAP_PLANAR_H
#define SL_MAP_PLANAR_H

#include "sightline/map.h"

/// An edge of the graph, from points[a] to points[b]; a < b, and points are by x, then y.
typedef struct sl_planar_edge {
    uint32_t a, b;
} sl_planar_edge;

/// An edge of a chain: 2 * edge, and 1 more where it is passed from b to a.
typedef uint32_t sl_planar_link;

/// Zeroed, a graph is empty.
typedef struct sl_planar {
    sl_point *points;
    sl_planar_edge *edges;
    size_t point_count, edge_count;
    sl_planar_link *links; ///< of segment i: links[first[i]] .. links[first[i + 1] - 1], in order
                           ///< from its a to its b; none for one of no length
    size_t *first;
    size_t welded;       ///< ends that were moved
    size_t crossings;    ///< points that were computed
    double largest_move; ///< no point of a chain is farther than this from its segment
} sl_planar;

/// Makes the graph of segments.
///
/// Ends that are no farther apart than `weld` become one of them, and a segment that an end comes
/// nearer to than half of it goes through this end. Where segments still cross, both go through the
/// nearest representable point, or through an end within `weld` of it. With weld 0 ends only count
/// as one where they are equal, and as on a segment where they are exactly on it.
///
/// With a tolerance above the rounding of coordinates this ends: points are never moved once they
/// are welded, they are `weld` apart, so that there is room for so many only; and each time that a
/// segment is led through a point, its parts are shorter than it was. SL_UNSUPPORTED where it does
/// not come to an end nevertheless, as may be with tolerances that are smaller.
///
/// The graph is the same for all orders of the segments. Time O((n + k) log n) for k crossings,
/// where few segments come near to each other in one place.
sl_status sl_planar_make(sl_context *context, const char *source, const sl_segment *segments,
                         size_t count, double weld, sl_planar *out);
void sl_planar_destroy(sl_context *context, sl_planar *planar); ///< and zeroes it

/// The tolerance that doubles of a map's size call for: what turning and moving a map leaves of
/// ends that met, with room to spare.
double sl_planar_tolerance(const sl_box *bounds);

static inline sl_segment sl_planar_at(const sl_planar *planar, sl_planar_link link) {
    const sl_planar_edge *e = &planar->edges[link / 2];
    const sl_point a = planar->points[e->a], b = planar->points[e->b];
    return link % 2 ? (sl_segment){b, a} : (sl_segment){a, b};
}

#endif
