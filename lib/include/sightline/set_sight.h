/// What is seen from a set of points: from a segment, a polyline, a convex polygon or a disc. A
/// point is seen from some point of the set (weak visibility) or from all of them (complete
/// visibility).
///
///     const sl_point corridor[] = {{2, 5}, {30, 5}};
///     sl_set_sight *sight;
///     sl_set_region seen = {0};
///     sl_set_sight_create(context, query, corridor, 2, SL_SET_LINE, &sight);
///     sl_set_sight_region(context, sight, SL_SEEN_FROM_SOME, &seen);
///     sl_set_region_destroy(context, &seen);
///     sl_set_sight_destroy(context, sight);
///
/// A point p of the set sees a point x if the segment from p to x crosses no wall. It may graze
/// walls on either side. Neither has a side: a set that lies on a wall looks to both sides of it,
/// and a point on a wall is seen from both. Shut doors are walls, and one-way glass is passed the
/// way that it is seen through. Within a view range, the segment must be no longer than it.
///
/// How the region is found: while p moves along the set, what it sees changes only along the rays
/// that graze the end of a wall. Such a ray from p through the end u sweeps a cone behind u, as far
/// as u sees. In this cone, each point loses or gains sight of p where it is on the ray. So
///
/// - the points that are seen from some p are those that one p sees, and all cones;
/// - the points that are seen from all p are those that one p sees, without the cones.
///
/// The borders of a cone are lines through u and another end of a wall, or an end of the set, or a
/// wall's direction: they are compared exactly. No two ends of walls need be tried together: what u
/// sees of the set gives them (Suri & O'Rourke 1986, Worst-case optimal algorithms for constructing
/// visibility polygons with holes, has all pairs).
#ifndef SIGHTLINE_SET_SIGHT_H
#define SIGHTLINE_SET_SIGHT_H

#include "sightline/overlay.h"
#include "sightline/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The most corners that the parts of a region may have in all, before they are joined. Behind
/// holes a region may have corners as the fourth power of the walls.
#define SL_SET_REGION_CORNERS 4000000
/// The most crossings of their borders, which are found when they are joined.
#define SL_SET_REGION_CROSSINGS 2000000

/// Within a range R, the region from some point is a part of the true one: its bent borders are
/// chords. A point that is seen from some point of the set is in it if one is at most (1 - this) R
/// away. The region from all points has chords of circles, too.
#define SL_SET_RANGE_SHARE (1 / 256.0)

/// What the points of a set are.
typedef enum sl_set_kind {
    SL_SET_LINE, ///< one point, the ends of a segment, or the points of a polyline
    SL_SET_AREA, ///< the corners of a convex polygon, in either order
} sl_set_kind;

/// From where a point must be seen.
typedef enum sl_set_seen {
    SL_SEEN_FROM_SOME, ///< some point of the set: weak visibility
    SL_SEEN_FROM_ALL,  ///< all points of the set: complete visibility
} sl_set_seen;

/// The sight of one set. Serves one thread at a time.
typedef struct sl_set_sight sl_set_sight;

/// What is seen. Zero it to start.
typedef struct sl_set_region {
    sl_shape shape;   ///< simple loops: outer ones counter-clockwise, holes clockwise
    double area;      ///< of the shape
    bool walled;      ///< a wall crosses the set, so nothing is seen from all of it
    uint64_t cones;   ///< behind ends of walls, before they are joined
    uint64_t corners; ///< of all parts, before they are joined: the measure of the work
} sl_set_region;

SL_API void sl_set_region_destroy(sl_context *context, sl_set_region *region); ///< and zeroes it

/// Prepares a set for questions. The points are copied. The query must outlive it, and its settings
/// must stay as they are until then.
///
/// SL_BAD_ARGUMENT for a point that is outside the bounds or not finite, and for an area that is
/// not convex or has none. SL_UNSUPPORTED, by name, for mirrors, boxes that block, limited walls
/// and loose spaces. Time O(n log n), n walls.
SL_API sl_status sl_set_sight_create(sl_context *context, sl_query *query, const sl_point *points,
                                     size_t count, sl_set_kind kind, sl_set_sight **out);
SL_API void sl_set_sight_destroy(sl_context *context, sl_set_sight *sight); ///< NULL is allowed

/// The region that is seen from some point of the set, or from all.
///
/// Which walls the cones meet, and in what order, is decided exactly. Corners that are no ends of
/// walls are rounded. The parts are then joined as overlay.h says: places are right to about 2^-46
/// of the largest coordinate. Loops thinner than four times that are left out, and so is what is
/// seen along single lines only, and of pieces of the set shorter than that. An area is seen from
/// itself, but for its solid ground.
///
/// Within a range, corners are rounded all the more (SL_SET_RANGE_SHARE).
///
/// SL_UNSUPPORTED over SL_SET_REGION_CORNERS and SL_SET_REGION_CROSSINGS. On failure the region is
/// empty.
///
/// Time: for each segment of the set, and each end of a wall, the rooms between them that see both;
/// and the joining of the cones, O((c + k) log c) for c corners and k crossings.
SL_API sl_status sl_set_sight_region(sl_context *context, sl_set_sight *sight, sl_set_seen seen,
                                     sl_set_region *out);

/// Whether a point is seen from some point of the set, or from all. Exact, within a range, too: a
/// point that is as far as the range is seen. Only where a wall crosses the set, and that place is
/// the nearest one that sees the point, its distance is rounded. Seen from some: it sees
/// a piece of the set of some length, or one of its points that was given, or the end of a wall
/// that lies on the set. One that is seen along a single line only, past ends of walls on both
/// sides of it, does not count. Where single points must tell, as for a point in line with a
/// segment, sl_query_sees tells, from one of the two to the other. False for points outside the
/// bounds and in solid ground.
SL_API sl_status sl_set_sight_sees(sl_context *context, sl_set_sight *sight, sl_set_seen seen,
                                   sl_point point, bool *out);

/// The corners of a regular polygon in a disc, for SL_SET_AREA: chords that lie within `tolerance`
/// of the circle. Writes up to `room` of them, counter-clockwise, and returns how many there are:
/// 3 to 4096. Radius and tolerance must be positive.
SL_API size_t sl_set_of_disc(sl_point middle, double radius, double tolerance, sl_point *points,
                             size_t room);

#ifdef __cplusplus
}
#endif

#endif
