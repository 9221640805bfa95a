/// The visible region with what is seen in mirrors, part by part.
#ifndef SIGHTLINE_MIRRORED_H
#define SIGHTLINE_MIRRORED_H

#include "sightline/region.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A piece of a room's side on a mirror that reflects there, counter-clockwise around the room.
typedef struct sl_room_mirror {
    sl_point right, left;
    uint32_t mirror; ///< of the map
} sl_room_mirror;

/// Where the rooms of an outline end at mirrors. Where mirrors lie on each other, the first one of
/// the map counts.
typedef struct sl_room_mirrors {
    const sl_outline *outline; ///< the caller's, as the map; both must stay as long
    const sl_map *map;
    uint32_t *first; ///< by side of the outline, and one more: pieces[first[i] .. first[i + 1])
    sl_room_mirror *pieces;
} sl_room_mirrors;

/// Finds them. Mirrors must be walls of the outline's space too (sl_map_clean makes them so).
SL_API sl_status sl_room_mirrors_make(sl_context *context, const sl_outline *outline,
                                      const sl_map *map, sl_room_mirrors *out);
/// Frees what sl_room_mirrors_make gave and zeroes it.
SL_API void sl_room_mirrors_destroy(sl_context *context, sl_room_mirrors *mirrors);

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
    sl_region direct;      ///< as sl_region_make gives it
    sl_mirror_part *parts; ///< each after its parent
    size_t part_count, part_room;
} sl_mirrored_region;

/// Frees a region and zeroes it.
SL_API void sl_mirrored_region_destroy(sl_context *context, sl_mirrored_region *region);

/// The region of a view, with what is seen by up to `depth` reflections. Sightlines are at most
/// `range` long, with their reflections; 0 for no limit.
///
/// Behind axial mirrors it is decided exactly which walls are met, and in what order, as in the
/// direct region. Places in mirrored space are sums of two doubles; `rounded` says where these do
/// not suffice. Behind oblique mirrors the eye's image and the borders of what is seen are rounded,
/// at each reflection by a few units in the last place of the largest coordinates. A part is then
/// exact for an eye and a cone moved by that much.
///
/// An eye on a mirror sees nothing in it. Time: that of a region for each part. The number of parts
/// may grow with the depth as a power of the number of mirrors.
SL_API sl_status sl_mirrored_region_make(sl_context *context, const sl_room_mirrors *mirrors,
                                         const sl_view *view, double range, uint32_t depth,
                                         sl_mirrored_region *out);

/// Where a point of the map seems to be in a part, in mirrored space. Rounded. SL_NO_PART: where it
/// is. `mirrors` are those that the region was made with.
SL_API sl_point sl_mirror_part_place(const sl_room_mirrors *mirrors,
                                     const sl_mirrored_region *region, uint32_t part,
                                     sl_point point);

/// The area of all parts. What two mirrors show counts twice.
SL_API double sl_mirrored_area(const sl_mirrored_region *region);

#ifdef __cplusplus
}
#endif

#endif
