/// Segments become a planar graph. Cleaning does this to a map, and a mesh is made over such a
/// graph.
///
/// No two edges of the graph cross, overlap or touch, except in common ends, by exact predicates.
/// Each segment becomes a chain of edges.
#ifndef SL_MAP_PLANAR_H
#define SL_MAP_PLANAR_H

#include "sightline/map.h"

/// An edge of the graph, from points[a] to points[b]; a < b, and points are by x, then y.
typedef struct sli_planar_edge {
    uint32_t a, b;
} sli_planar_edge;

/// An edge of a chain: 2 * edge, plus 1 where the chain runs from b to a.
typedef uint32_t sli_planar_link;

/// Zeroed, a graph is empty.
typedef struct sli_planar {
    sl_point *points;
    sli_planar_edge *edges;
    size_t point_count, edge_count;
    sli_planar_link *links; ///< of segment i: links[first[i]] .. links[first[i + 1] - 1], in order
                            ///< from its a to its b; none for a segment of no length
    size_t *first;
    size_t welded;       ///< ends that were moved
    size_t crossings;    ///< points that were computed
    double largest_move; ///< the largest distance of a chain's point from its segment
} sli_planar;

/// Makes the graph of segments.
///
/// Ends that are at most `weld` apart become one of them. A segment with an end nearer to it than
/// weld / 2 goes through this end. Where segments still cross, both go through the nearest
/// representable point, or through an end within `weld` of it. With weld 0, only equal ends are
/// one, and an end is on a segment only where it is exactly on it.
///
/// With a tolerance above the rounding of coordinates this ends. Welded points never move and are
/// `weld` apart, so there is room for a limited number only. And each split makes parts that are
/// shorter than their segment. With a smaller tolerance it may not end: SL_UNSUPPORTED.
///
/// The order of the segments does not matter. Time O((n + k) log n) for k crossings, where few
/// segments come near to each other in one place.
sl_status sli_planar_make(sl_context *context, const char *source, const sl_segment *segments,
                          size_t count, double weld, sli_planar *out);
/// The same, but SL_UNSUPPORTED where more than `most` crossings are found.
sl_status sli_planar_make_up_to(sl_context *context, const char *source, const sl_segment *segments,
                                size_t count, double weld, size_t most, sli_planar *out);
void sli_planar_destroy(sl_context *context, sli_planar *planar); ///< and zeroes it

/// The tolerance for doubles of a map's size. Ends that met still do after a map was turned and
/// moved in doubles.
double sli_planar_tolerance(const sl_box *bounds);

/// Cleans a map with oblique walls (clean_oblique.c). `walls` are to stand for the map's own;
/// mirrors are among them. The walls come out in no order. Where `idle` is not NULL, it says
/// whether no wall had to move; the map and the account then stay as they were.
sl_status sli_clean_oblique(sl_context *context, sl_map *map, const sl_wall *walls, size_t count,
                            double weld, bool *idle, sl_clean_account *account);

static inline sl_segment sli_planar_at(const sli_planar *planar, sli_planar_link link) {
    const sli_planar_edge *e = &planar->edges[link / 2];
    const sl_point a = planar->points[e->a], b = planar->points[e->b];
    return link % 2 ? (sl_segment){b, a} : (sl_segment){a, b};
}

#endif
