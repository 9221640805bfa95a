/// Arcs of directions about an eye: what a view cone, a portal, or a sequence of portals lets
/// through. Closed, and decided by orientation tests on given points alone.
#ifndef SL_ARC_H
#define SL_ARC_H

#include "geometry/orient.h"
#include "sightline/space.h"

#include <stdbool.h>
#include <stdint.h>

/// The eye about which rays turn, and how many orientation tests have been made. `fine`: the eye is
/// the image of one in mirrors; it and the points of rays may have a rest, as those of sl_fine.
typedef struct sl_pivot {
    sl_point eye;
    uint64_t tests;
    sl_point rest;
    bool fine;
} sl_pivot;

/// A ray from the eye: through a point other than the eye, or straight away from that point.
/// `along`: as an arc's border, a portal crossed lies along it, so that it is crossed towards the
/// arc's inside.
typedef struct sl_ray {
    sl_point point;
    bool away, along;
    sl_point rest; ///< of the point; 0 unless the pivot is fine
} sl_ray;

/// How far an arc reaches: 0 degrees, up to 180, or 180.
typedef enum sl_span { SL_SPAN_RAY, SL_SPAN_WEDGE, SL_SPAN_HALF } sl_span;

/// The directions counter-clockwise from `right` to `left`, both included: at most 180 degrees.
typedef struct sl_arc {
    sl_ray right, left;
    sl_span span;
} sl_arc;

/// sl_orient for a fine pivot.
int sl_ray_orient_fine(const sl_pivot *pivot, const sl_ray *from, const sl_ray *to);

/// The sense of the turn from one ray to another: 1 to the left, -1 to the right, 0 in line.
static inline int sl_ray_turn(sl_pivot *pivot, sl_ray from, sl_ray to) {
    pivot->tests++;
    const int sign = pivot->fine ? sl_ray_orient_fine(pivot, &from, &to)
                                 : sl_orient(pivot->eye, from.point, to.point);
    return from.away == to.away ? sign : -sign;
}

static inline sl_ray sl_ray_to(sl_point point) {
    return (sl_ray){.point = point};
}

/// Whether two rays that are in line go the same way.
bool sl_ray_same_way(const sl_pivot *pivot, sl_ray a, sl_ray b);

/// Makes an arc of two rays that are at most 180 degrees apart. False where there is no such arc,
/// or where a single ray is left that would have to cross portals along it to both sides: no
/// direction crosses them all strictly forwards.
bool sl_arc_make(sl_pivot *pivot, sl_ray right, sl_ray left, sl_arc *out);

bool sl_arc_has(sl_pivot *pivot, const sl_arc *arc, sl_ray ray);

/// What two arcs have in common: up to two arcs (two when they are opposite halves). Returns how
/// many.
unsigned sl_arc_meet(sl_pivot *pivot, const sl_arc *a, const sl_arc *b, sl_arc pieces[2]);

/// The directions in which a line through the eye crosses a portal, for an eye in the cell that the
/// directed portal leads out of: a half where the eye is on the portal, a single ray where it is
/// elsewhere on the portal's line. False where there is none.
bool sl_arc_of_portal(sl_pivot *pivot, const sl_directed_portal *directed, sl_arc *out);

/// What of an arc passes a directed portal of a cell beyond a portal that the eye is not on: so all
/// of the cell that the arc can reach is ahead, within less than 180 degrees. False where nothing
/// does.
bool sl_arc_narrow(sl_pivot *pivot, const sl_arc *arc, const sl_directed_portal *directed,
                   sl_arc *out);

#endif
