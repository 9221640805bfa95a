/// Directions about an eye: rays, arcs of rays, and view cones.
///
/// A ray is given by the eye and one more point. An arc is a closed set of directions between two
/// rays. A view cone, the directions in which a line through the eye crosses a portal, and those in
/// which it crosses a sequence of portals are all arcs.
///
///         left   right       An arc holds the directions counter-clockwise from `right`
///            \   /           to `left`. Both borders belong to it.
///             \ /
///             eye
///
/// No angle is computed. Each decision is the sign of an orientation test on given points, so it is
/// exact. Each function makes a constant number of tests, one with a polygon some for each corner.
#ifndef SL_CONE_H
#define SL_CONE_H

#include "geometry/orient.h"
#include "sightline/space.h"
#include "sightline/view.h"

#include <stdbool.h>
#include <stdint.h>

/// The eye, and the number of orientation tests so far. `fine`: the eye is an image in mirrors; it
/// and the points of rays may have a rest, as those of sl_fine.
typedef struct sl_pivot {
    sl_point eye;
    uint64_t tests;
    sl_point rest;
    bool fine;
} sl_pivot;

/// A ray from the eye: through a point other than the eye, or straight away from that point.
/// `along`: this border of an arc lies along a portal of the sequence, which is crossed towards the
/// inside of the arc.
typedef struct sl_ray {
    sl_point point;
    bool away, along;
    sl_point rest; ///< of the point; 0 unless the pivot is fine
} sl_ray;

/// How wide an arc is: 0 degrees, between 0 and 180, or 180.
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

/// Makes an arc of two rays that are at most 180 degrees apart. False where there is none, or where
/// a single ray is left with portals along it that are crossed to both sides: no direction crosses
/// them all strictly forwards.
bool sl_arc_make(sl_pivot *pivot, sl_ray right, sl_ray left, sl_arc *out);

/// The intersection of two arcs: up to two arcs (two where they are opposite halves). Returns how
/// many.
unsigned sl_arc_meet(sl_pivot *pivot, const sl_arc *a, const sl_arc *b, sl_arc pieces[2]);

/// The directions in which a line through the eye crosses a portal, for an eye in the cell that the
/// directed portal leads out of: a half where the eye is on the portal, a single ray where it is
/// elsewhere on the portal's line. False where there is none.
bool sl_arc_of_portal(sl_pivot *pivot, const sl_directed_portal *portal, sl_arc *out);

/// Clips an arc to a directed portal of a cell. The cell was entered by a portal that the eye is
/// not on, so all of it that the arc reaches is ahead, within less than 180 degrees. False where
/// nothing is left.
bool sl_arc_narrow(sl_pivot *pivot, const sl_arc *arc, const sl_directed_portal *portal,
                   sl_arc *out);

/// A view cone as an arc, made once for many questions. Where the cone is wider than 180 degrees
/// (`wide`), `arc` is what it leaves out, without the borders.
typedef struct sl_cone {
    bool full, wide;
    sl_arc arc;
} sl_cone;

/// The pivot must be at the view's eye, and the view usable.
sl_cone sl_cone_of(sl_pivot *pivot, const sl_view *view);

bool sl_cone_meets_segment(sl_pivot *pivot, const sl_cone *cone, sl_point a, sl_point b);
bool sl_cone_meets_polygon(sl_pivot *pivot, const sl_cone *cone, const sl_point *corners,
                           size_t count);

/// The part of an arc within the cone: up to two arcs. Returns how many.
unsigned sl_cone_clip(sl_pivot *pivot, const sl_cone *cone, const sl_arc *arc, sl_arc pieces[2]);

#endif
