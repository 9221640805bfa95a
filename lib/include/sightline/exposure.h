/// Exposure: what of a thing is seen from a path, and for how long?
///
///     const sl_point way[] = {{2, 5}, {30, 5}}, sides[] = {{8, 9}, {12, 9}};
///     const size_t end = 2;
///     const sl_exposed wall = {{sides, &end, 1}, false};
///     sl_exposure exposure;
///     sl_status status = sl_exposure_make(context, query, way, 2, &wall, 1, &exposure);
///     // exposure.seen / exposure.size of the wall is seen; along exposure.some.total of the path
///     sl_exposure_destroy(context, &exposure);
#ifndef SIGHTLINE_EXPOSURE_H
#define SIGHTLINE_EXPOSURE_H

#include "sightline/path_parts.h"
#include "sightline/set_sight.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A thing that may be seen: lines (walls, doors, an outline), or one convex area. What stands on a
/// wall is seen from both sides of it.
typedef struct sl_exposed {
    sl_shape parts; ///< by loop: the points of a line, which is not closed; or the area's corners
    bool is_area;
} sl_exposed;

/// How a thing is seen. Zeroed, it is empty.
typedef struct sl_exposure {
    double size;         ///< the length of its lines; of an area, what of it is inside
    double seen;         ///< of that, what some point of the path sees
    sl_path_parts some;  ///< the parts of the path that see some of it
    sl_path_parts whole; ///< the parts that see all of it
} sl_exposure;

/// The exposure of things to a path of 2 points or more, one after the other in `out`. Both are
/// decided by sight from lines and areas (set_sight.h): exactly in the middle of each part; ends of
/// parts are rounded, and parts up to 2^-36 times the largest coordinate long are left out.
///
/// SL_BAD_ARGUMENT for points outside the bounds, lines of less than 2 points, and areas that are
/// several or not convex; SL_UNSUPPORTED as sl_set_sight_create and sl_set_sight_region. The
/// message has the number of the thing. On failure `out` is empty.
///
/// Time: that of the region of the path, and of both regions of each line or area.
SL_API sl_status sl_exposure_make(sl_context *context, sl_query *query, const sl_point *path,
                                  size_t path_count, const sl_exposed *things, size_t count,
                                  sl_exposure *out);
SL_API void sl_exposure_destroy(sl_context *context, sl_exposure *exposure); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif
