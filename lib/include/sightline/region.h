/// The visible region (isovist) of an eye: an exact polygon, with arcs where the range ends.
#ifndef SIGHTLINE_REGION_H
#define SIGHTLINE_REGION_H

#include "sightline/measures.h"
#include "sightline/space.h"
#include "sightline/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The `wall` of an edge that lies on none.
#define SL_NO_WALL UINT32_MAX
/// The `wall` of an edge on a side of box i (sl_query_set_boxes) is SL_BOX_WALL + 4 * i + k, with k
/// 0 for its left side, 1 for the right, 2 for the lower and 3 for the upper one.
#define SL_BOX_WALL UINT32_C(0x40000000)

/// The `wall` of an edge on a limited wall that is the second one on the way from the eye, and of
/// such a hit, is SL_LIMITED_WALL + the number of the seam (sl_space.seams).
#define SL_LIMITED_WALL UINT32_C(0x80000000)

/// What an edge of a region lies on.
typedef enum sl_edge_kind {
    SL_EDGE_WALL,      ///< on a wall, or on several pieces that portals cut one wall into
    SL_EDGE_BORDER,    ///< on the map's border, where no wall is
    SL_EDGE_OCCLUDING, ///< radial: what lies beyond it is hidden by the corner at its near end
    SL_EDGE_CONE,      ///< on a border of the view cone
    SL_EDGE_MIRROR,    ///< of what is seen by mirror: the mirror, nearest to the eye
    SL_EDGE_ARC,       ///< of up to half a circle about the eye, counter-clockwise: the range
} sl_edge_kind;

/// An edge of a region.
typedef struct sl_region_edge {
    uint32_t wall; ///< index of the space's walls, of a box's side: SL_BOX_WALL, or of a limited
                   ///< wall: SL_LIMITED_WALL; SL_NO_WALL for all kinds but walls
    uint8_t kind;  ///< of sl_edge_kind
    bool exact;    ///< its start is a corner of the space (or the eye), not a computed point
} sl_region_edge;

/// A region: a counter-clockwise polygon, star-shaped about the eye. Edge i leads from points[i] to
/// the next point, around. Zero it to start. It keeps its memory from one sl_query_region to the
/// next, so repeated calls allocate only while regions grow.
///
/// It is decided exactly which walls are met, and in what order. A point that is no corner is
/// computed in doubles, to a few units in the last place of its distance from the eye along each
/// axis. What is seen only in a single direction (a needle) is not part of the region. A wall that
/// is seen edge-on hides nothing; the radial edge along it counts as occluding.
typedef struct sl_region {
    sl_view view;
    double range;  ///< 0 for no limit
    uint32_t cell; ///< that sl_space_locate gives for the eye; SL_NO_CELL, and the region is empty,
                   ///< outside the bounds and in solid ground
    size_t count;  ///< of points, offsets and edges; 0 for an empty region
    sl_point *points;
    sl_point *offsets; ///< the points less the eye: more precise far from the origin
    sl_region_edge *edges;
    uint64_t portals_passed; ///< of the outline, to find it: the measure of the work
    struct sli_region_memory *memory;
} sl_region;

SL_API void sl_region_destroy(sl_context *context, sl_region *region); ///< and zeroes it

/// Measures under the names that depthmapX gives them (isovist.cpp of its salalib), in the map's
/// unit: measures.h says what each is. All are 0 for an empty region. Arcs count as arcs, not as
/// chords.
typedef struct sl_region_measures {
    SL_ISOVIST_MEASURES(SL_MEASURE_MEMBER)
    SL_RADIAL_MEASURES(SL_MEASURE_MEMBER)
} sl_region_measures;

/// All measures of a region. Time: its edges.
SL_API sl_region_measures sl_region_measure(const sl_region *region);

/// The area alone: faster.
SL_API double sl_region_area(const sl_region *region);

/// Whether the region ends somewhere at the border of the map, where no wall is. What lies beyond
/// is not known, so the region may be larger in truth. Time: its edges.
SL_API bool sl_region_meets_border(const sl_region *region);

/// The visible corners of walls, not of boxes: ends of walls that are points of the region, in its
/// order. `space` is the one that the region is of, with walls in shut doors (sl_query_space).
/// Writes up to `room` of them and returns how many there are; at most region->count.
SL_API size_t sl_region_corners(const sl_region *region, const sl_space *space, sl_point *corners,
                                size_t room);

/// The region as a plain polygon, its arcs as chords that lie within `tolerance` of them. Writes up
/// to `room` points and returns how many there are.
SL_API size_t sl_region_flatten(const sl_region *region, double tolerance, sl_point *points,
                                size_t room);

/// What a ray meets (sl_query_cast).
typedef struct sl_hit {
    uint32_t wall;  ///< index of the space's walls, or SL_LIMITED_WALL; SL_NO_WALL: the border of
                    ///< the map
    sl_point point; ///< rounded; on the wall where that is axial
} sl_hit;

// --- with what is seen in mirrors, part by part

/// The parent of a part whose mirror is seen directly.
#define SL_NO_PART UINT32_MAX

/// What is seen in a mirror, which is itself seen directly or in another mirror. A polygon with one
/// edge on the mirror, star-shaped about the eye's image. Each piece of a mirror that is seen gives
/// a part.
typedef struct sl_mirror_part {
    uint32_t mirror; ///< of the map
    uint32_t parent; ///< the part in which the mirror is seen; SL_NO_PART: it is seen directly
    uint32_t depth;  ///< reflections: 1 where the mirror is seen directly
    bool rounded;    ///< the eye's image or a border of what is seen is rounded
    /// What it shows, in the map: `view.eye` is the image of the eye; points are counter-clockwise.
    sl_region region;
    /// Where it seems to be, in mirrored space, where the eye looks straight on: region.count
    /// points in the same order, clockwise where `depth` is odd. Rounded.
    sl_point *image;
} sl_mirror_part;

/// Zero it to start. It keeps the direct region's memory from one to the next.
typedef struct sl_mirrored_region {
    sl_region direct;      ///< as sl_query_region gives it
    sl_mirror_part *parts; ///< each after its parent
    size_t part_count, part_room;
} sl_mirrored_region;

/// Frees a region and zeroes it.
SL_API void sl_mirrored_region_destroy(sl_context *context, sl_mirrored_region *region);

/// Where a point of the map seems to be in a part, in mirrored space. Rounded. SL_NO_PART: where it
/// is. `map`: whose mirrors are in the region.
SL_API sl_point sl_mirror_part_place(const sl_map *map, const sl_mirrored_region *region,
                                     uint32_t part, sl_point point);

/// The area of all parts. What two mirrors show counts twice.
SL_API double sl_mirrored_area(const sl_mirrored_region *region);

#ifdef __cplusplus
}
#endif

#endif
