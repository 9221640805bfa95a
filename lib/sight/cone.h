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
/// and the points of rays may have a rest, as those of sli_fine.
typedef struct sli_pivot {
    sl_point eye;
    uint64_t tests;
    sl_point rest;
    bool fine;
} sli_pivot;

/// A ray from the eye: through a point other than the eye, or straight away from that point.
/// `along`: this border of an arc lies along a portal of the sequence, which is crossed towards the
/// inside of the arc.
typedef struct sli_ray {
    sl_point point;
    bool away, along;
    sl_point rest; ///< of the point; 0 unless the pivot is fine
} sli_ray;

/// How wide an arc is: 0 degrees, between 0 and 180, or 180.
typedef enum sli_span { SLI_SPAN_RAY, SLI_SPAN_WEDGE, SLI_SPAN_HALF } sli_span;

/// The directions counter-clockwise from `right` to `left`, both included: at most 180 degrees.
typedef struct sli_arc {
    sli_ray right, left;
    sli_span span;
} sli_arc;

/// sli_orient for a fine pivot.
int sli_ray_orient_fine(const sli_pivot *pivot, const sli_ray *from, const sli_ray *to);

/// The sense of the turn from one ray to another: 1 to the left, -1 to the right, 0 in line.
static inline int sli_ray_turn(sli_pivot *pivot, sli_ray from, sli_ray to) {
    pivot->tests++;
    const int sign = pivot->fine ? sli_ray_orient_fine(pivot, &from, &to)
                                 : sli_orient(pivot->eye, from.point, to.point);
    return from.away == to.away ? sign : -sign;
}

static inline sli_ray sli_ray_to(sl_point point) {
    return (sli_ray){.point = point};
}

/// Whether two rays that are in line go the same way.
bool sli_ray_same_way(const sli_pivot *pivot, sli_ray a, sli_ray b);

/// Makes an arc of two rays that are at most 180 degrees apart. False where there is none, or where
/// a single ray is left with portals along it that are crossed to both sides: no direction crosses
/// them all strictly forwards.
bool sli_arc_make(sli_pivot *pivot, sli_ray right, sli_ray left, sli_arc *out);

/// The intersection of two arcs: up to two arcs (two where they are opposite halves). Returns how
/// many.
unsigned sli_arc_meet(sli_pivot *pivot, const sli_arc *a, const sli_arc *b, sli_arc pieces[2]);

/// The directions in which a line through the eye crosses a portal, for an eye in the cell that the
/// directed portal leads out of: a half where the eye is on the portal, a single ray where it is
/// elsewhere on the portal's line. False where there is none.
bool sli_arc_of_portal(sli_pivot *pivot, const sl_directed_portal *portal, sli_arc *out);

/// Clips an arc to a directed portal of a cell. The cell was entered by a portal that the eye is
/// not on, so all of it that the arc reaches is ahead, within less than 180 degrees. False where
/// nothing is left.
bool sli_arc_narrow(sli_pivot *pivot, const sli_arc *arc, const sl_directed_portal *portal,
                    sli_arc *out);

/// A view cone as an arc, made once for many questions. Where the cone is wider than 180 degrees
/// (`wide`), `arc` is what it leaves out, without the borders.
typedef struct sli_cone {
    bool full, wide;
    sli_arc arc;
} sli_cone;

/// The pivot must be at the view's eye, and the view usable.
sli_cone sli_cone_of(sli_pivot *pivot, const sl_view *view);

bool sli_cone_meets_segment(sli_pivot *pivot, const sli_cone *cone, sl_point a, sl_point b);
bool sli_cone_meets_polygon(sli_pivot *pivot, const sli_cone *cone, const sl_point *corners,
                            size_t count);

/// The part of an arc within the cone: up to two arcs. Returns how many.
unsigned sli_cone_clip(sli_pivot *pivot, const sli_cone *cone, const sli_arc *arc,
                       sli_arc pieces[2]);

// --- of a view

/// Whether a view is usable: its points are finite, and the cone's points differ from the eye. All
/// functions that take a view need that.
bool sli_view_usable(const sl_view *view);

/// Whether a point is within the cone, its border included. The eye itself always is. Exact.
bool sli_view_holds(const sl_view *view, sl_point point);

#endif
