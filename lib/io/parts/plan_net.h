/// A drawing as a net of lines: which walls are joined, and which stand side by side. Ends that
/// meet are one corner; an end that meets the side of a line divides it, and so does a crossing.
/// Lines that are joined are a piece.
#ifndef SL_PLAN_NET_H
#define SL_PLAN_NET_H

#include "geometry/length.h"
#include "sightline/map.h"
#include "sightline/support.h"
#include "space/index.h"

/// Two walls side by side: parallel, along half of the shorter one at least.
typedef struct sli_plan_pair {
    uint32_t wall, other; ///< wall < other
    double away, along;   ///< how far apart, and how far along each other
} sli_plan_pair;

/// Zeroed, it is empty.
typedef struct sli_plan_net {
    sl_context *context;
    const sl_map *map;
    double least, most; ///< how far apart pairs are
    double tolerance;   ///< how far apart ends may be that meet
    sl_box bounds;
    double size; ///< the longer side of the bounds
    sli_wall_index index;
    uint32_t *piece;  ///< by wall: another wall of the same piece, or itself
    uint32_t *corner; ///< by end, two a wall: another end of the same corner, or itself
    sl_box *boxes;    ///< by wall, of the first of each piece
    uint32_t *counts; ///< likewise: walls
    SL_ARRAY(sli_plan_pair) pairs;
    SL_ARRAY(sli_plan_pair) crossings; ///< walls that cross; nothing else is set
    size_t ends_on_sides;
    size_t near; ///< walls that were near others
    bool whole;  ///< false where it has too many walls, or crowds of them: nothing else holds then
} sli_plan_net;

/// Makes a net of the map's walls; pairs are looked for from `least` to `most` apart, `most` 0 for
/// none. The map must outlive it. Destroy it also on failure. Time O(n log n) where few lines are
/// near each other.
sl_status sli_plan_net_make(sl_context *context, const sl_map *map, double least, double most,
                            double tolerance, sli_plan_net *out);
void sli_plan_net_destroy(sli_plan_net *net);

static inline double sli_box_width(sl_box box) {
    return box.max.x - box.min.x;
}

static inline double sli_box_height(sl_box box) {
    return box.max.y - box.min.y;
}

#endif
