/// Coverage: what given viewpoints see together. Which part of the inside none, one, two or more of
/// them see, where the blind spots are, what each viewpoint alone sees.
///
///     sl_viewpoint cameras[] = {{.at = {4, 3}, .heading = 90, .fov = 60, .range = 12},
///                               {.at = {9, 7}, .fov = 360}};
///     sl_coverage coverage;
///     sl_status status = sl_coverage_make(context, query, cameras, 2, &coverage);
///     // coverage.overlay.areas[1] / coverage.overlay.areas[0] is the share that is seen
#ifndef SIGHTLINE_COVERAGE_H
#define SIGHTLINE_COVERAGE_H

#include "sightline/overlay.h"
#include "sightline/path_parts.h"
#include "sightline/query.h"
#include "sightline/viewpoint.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A part of the inside that no viewpoint sees: pieces that join, up to walls.
typedef struct sl_blind_spot {
    double area;
    sl_point at; ///< the middle of its largest piece
    sl_box bounds;
} sl_blind_spot;

/// Zeroed, it is empty.
typedef struct sl_coverage {
    sl_overlay overlay;   ///< its first shape are the walls, which cover nothing; then a viewpoint
                          ///< each. So areas[k] is the area that at least k viewpoints see
    sl_shape *regions;    ///< by viewpoint: what it sees, with the dead zone as a hole
    size_t count;         ///< of viewpoints
    const double *seen;   ///< by viewpoint: the area inside that it sees
    const double *alone;  ///< by viewpoint: the area that it alone sees
    double negligible;    ///< areas up to this are rounding: 1e-9 of the inside, overlay.areas[0]
    uint32_t *spots;      ///< by piece of the overlay: its blind spot; UINT32_MAX: none
    sl_blind_spot *blind; ///< the largest first, those over `negligible`
    uint32_t blind_count;
    struct sli_coverage_memory *memory;
} sl_coverage;

/// Lays the regions of viewpoints over what is inside. Doors, glass and boxes count as the query
/// has them; what is seen in mirrors does not. A viewpoint outside or in solid ground sees nothing.
/// Regions are decided exactly, and corners of what they share are rounded as overlay.h says. Where
/// a range ends, an arc is a chain of chords up to 1e-4 of the range off it: within it, and outside
/// of the arc of a dead zone. So nothing counts that is not seen. A sign (sl_viewpoint_sign) covers
/// where it can be read: chords lie within its disc, up to 1e-4 of its radius.
///
/// SL_BAD_ARGUMENT, with the number of the viewpoint, for a cone, range or dead zone that is none.
/// SL_UNSUPPORTED for signs and one-way glass.
/// The query's range is the most that counts. The query has its own settings again afterwards.
/// Time: the regions, and O((n + k) log n) for n corners and k crossings of their borders.
SL_API sl_status sl_coverage_make(sl_context *context, sl_query *query,
                                  const sl_viewpoint *viewpoints, size_t count, sl_coverage *out);
SL_API void sl_coverage_destroy(sl_context *context, sl_coverage *coverage); ///< and zeroes it

/// The parts of a path from which no sign can be read, or which no camera sees. `coverage` is of
/// these viewpoints and the query as it is.
///
/// Where a part begins and ends is computed in doubles, from all borders of regions that cross the
/// path; whether it is seen is decided in its middle, exactly but for a sign's disc: by
/// sl_query_sees, with arcs in place of chords. Parts up to 2^-36 times the largest coordinate long
/// are left out. SL_BAD_ARGUMENT for a point that is outside the bounds, and for less than 2
/// points. Time: for each segment of the path the corners of all regions, and what crosses it times
/// the viewpoints.
SL_API sl_status sl_coverage_of_path(sl_context *context, sl_query *query,
                                     const sl_coverage *coverage, const sl_viewpoint *viewpoints,
                                     const sl_point *path, size_t count, sl_path_parts *out);

/// Classes of coverage: what 0, 1, 2, 3 or more viewpoints see.
#define SL_COVERAGE_CLASSES 4

/// The area inside that exactly so many viewpoints see; of the last class, that many or more. 0
/// where it is negligible, and for a `class_index` from SL_COVERAGE_CLASSES on.
SL_API double sl_coverage_class_area(const sl_coverage *coverage, uint32_t class_index);

/// Whether the others see all that a viewpoint sees, but for rounding. Of two that see the same,
/// each is spare; take one away and ask again.
SL_API bool sl_coverage_is_spare(const sl_coverage *coverage, size_t viewpoint);

#ifdef __cplusplus
}
#endif

#endif
