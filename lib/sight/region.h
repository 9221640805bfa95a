/// What an eye sees of an outline: regions, directly and by mirror, and single lines of sight.
#ifndef SL_EYE_REGION_H
#define SL_EYE_REGION_H

#include "sightline/region.h"
#include "sightline/stab.h"

/// Makes the region of a view by expanding it through portals, from the cells at the eye (Teller
/// 1992, Visibility Computations in Densely Occluded Polyhedral Environments, eye-to-region; Bungiu
/// et al. 2014, Efficient Computation of Visibility Polygons, on triangles). `range` limits how far
/// is seen; 0 for no limit.
///
/// What an eye sees that is on a wall, on its end or on a portal, view.h says. Where a wall parts
/// what is around the eye, the eye is a point of its region; so is the eye of a cone. An eye that
/// sees nothing, and a cone of 0 degrees, have an empty region.
///
/// SL_BAD_ARGUMENT for a range that is negative or not finite, and for a cone's border that is the
/// eye itself or not finite. On failure the region is empty.
sl_status sli_region_make(sl_context *context, const sl_outline *outline, const sl_view *view,
                          double range, sl_region *region);

// --- with what is seen in mirrors

/// A piece of a room's side on a mirror that reflects there, counter-clockwise around the room.
typedef struct sli_room_mirror {
    sl_point right, left;
    uint32_t mirror; ///< of the map
} sli_room_mirror;

/// Where the rooms of an outline end at mirrors. Where mirrors lie on each other, the first one of
/// the map counts.
typedef struct sli_room_mirrors {
    const sl_outline *outline; ///< the caller's, as the map; both must stay as long
    const sl_map *map;
    uint32_t *first; ///< by side of the outline, and one more: pieces[first[i] .. first[i + 1])
    sli_room_mirror *pieces;
} sli_room_mirrors;

/// Finds them. Mirrors must be walls of the outline's space too (sl_map_clean makes them so).
sl_status sli_room_mirrors_make(sl_context *context, const sl_outline *outline, const sl_map *map,
                                sli_room_mirrors *out);
/// Frees what sli_room_mirrors_make gave and zeroes it.
void sli_room_mirrors_destroy(sl_context *context, sli_room_mirrors *mirrors);

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
sl_status sli_mirrored_region_make(sl_context *context, const sli_room_mirrors *mirrors,
                                   const sl_view *view, double range, uint32_t depth,
                                   sl_mirrored_region *out);

// --- single lines of sight

/// Whether an eye sees a point. Exact. SL_CLOSED: portals lead from a cell that the eye stands in
/// (view.h) to a cell that touches the point, and the segment between eye and point touches each of
/// them. It may graze walls on either side, but crosses none. (One that grazes walls on both sides
/// leads the culling methods to no cell, as view.h says.) SL_OPEN: the same, and the segment
/// has no point in common with a wall. False where either point is outside the bounds, and where
/// the eye is in solid ground.
sl_status sli_sees(sl_context *context, const sl_outline *outline, sl_point eye, sl_point point,
                   sl_sight sight, bool *out);

/// As sl_query_cast, in an outline.
sl_status sli_ray_cast(sl_context *context, const sl_outline *outline, sl_point eye,
                       sl_point through, sl_hit *out);

#endif
