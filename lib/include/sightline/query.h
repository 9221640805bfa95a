/// Questions about sight: where is a point, what sees what, what does an eye see. Doors, boxes,
/// range and mirrors can be set between questions; nothing is baked again. This is the one place
/// that puts all of them together.
///
///     sl_query *query;
///     sl_region region = {0};
///     sl_query_over(context, &space, &map, NULL, &query); // a map without a bake
///     sl_query_set_door(context, query, "front", false);
///     sl_view view = sl_query_view(query, eye, 90, 60);
///     sl_query_region(context, query, &view, &region);
///
/// Answers are exact where the visible sets are, unless a method of culling is asked for that is
/// looser. An eye outside the bounds or in solid ground sees nothing: the answer is empty, not a
/// failure. Doors, mirrors, one-way glass, the range and boxes may come together. Numbers of cells
/// are those of the space that is asked.
///
/// Time: a door costs the cells that it touches. Boxes that block cost sl_query_region and
/// sl_query_sees nothing but themselves. Other questions past them cost a copy of the space after
/// each change of a box or a door. The first region costs the outline of all rooms.
#ifndef SIGHTLINE_QUERY_H
#define SIGHTLINE_QUERY_H

#include "sightline/cell_to_cell.h"
#include "sightline/region.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Serves one thread at a time. What a question needs is made when it is first asked, and kept
/// until a setting changes.
typedef struct sl_query sl_query;

/// A query over a space. `map` is the one that the space was made from: its doors, glass, mirrors
/// and range count. `visibility` may be NULL, or have no rows: then the exact method searches the
/// whole space, and sight is closed where it is NULL. All three must outlive the query, and stay as
/// they are until then.
///
/// Doors are as the map has them, the range is the map's, sightlines are reflected once, and there
/// are no boxes.
SL_API sl_status sl_query_over(sl_context *context, const sl_space *space, const sl_map *map,
                               const sl_visibility *visibility, sl_query **out);

/// A query over copies of the space and the map, with the same settings, but without visible sets
/// and boxes: for work that outlives the query or its space.
SL_API sl_status sl_query_copy(sl_context *context, const sl_query *query, sl_query **out);

/// Frees a query. NULL is allowed.
SL_API void sl_query_destroy(sl_context *context, sl_query *query);

/// The space that is asked, as it was given.
SL_API const sl_space *sl_query_asked(const sl_query *query);
/// Its map, as it was given.
SL_API const sl_map *sl_query_map(const sl_query *query);

// --- settings

/// Replaces the visible sets, for example when a bake ends while its space is being asked. As in
/// sl_query_over. SL_BAD_ARGUMENT, and no change, where the range is more than they know of.
SL_API sl_status sl_query_set_visibility(sl_context *context, sl_query *query,
                                         const sl_visibility *visibility);

/// Opens or shuts all doors of a name. SL_BAD_ARGUMENT, with the names there are, for one that the
/// map does not have.
SL_API sl_status sl_query_set_door(sl_context *context, sl_query *query, const char *name,
                                   bool open);
/// Opens or shuts one door, by its number in the map.
SL_API void sl_query_set_door_at(sl_context *context, sl_query *query, size_t door, bool open);
/// All doors at once: open, or shut.
SL_API void sl_query_set_doors(sl_context *context, sl_query *query, bool open);
/// Whether a door is open, by its number in the map.
SL_API bool sl_query_door_is_open(const sl_query *query, size_t door);

/// Asks from where the eye is seen, in place of what it sees: sight goes through one-way glass the
/// other way. Methods that need visible sets refuse then where there is glass.
SL_API void sl_query_set_backwards(sl_context *context, sl_query *query, bool backwards);

/// Boxes that block sight or are to be seen themselves, in place of those before. They are copied.
/// The next question fails with SL_BAD_ARGUMENT for boxes whose corners are not in order, or whose
/// coordinates sl_coordinate_usable refuses; with SL_UNSUPPORTED for a loose space, and where walls
/// run along each other within steps of doubles and bend each other without end. If some box
/// blocks, questions other than sl_query_region and sl_query_sees cut the cells at the sides of all
/// boxes, and copy the rest of the space. So do these two where an eye is on the border of a box,
/// or a line touches boxes and crosses none.
///
/// Where a side of a box crosses an oblique wall, the wall is bent to the nearest representable
/// point on that side; all else is exact. In a space of axial walls no coordinate is computed.
/// SL_UNSUPPORTED in a build without boxes (SIGHTLINE_BOXES).
SL_API sl_status sl_query_set_boxes(sl_context *context, sl_query *query,
                                    const sl_moving_box *boxes, size_t count);

/// How far is seen, in map units; 0 for no limit. The distance of a cell is that of the nearest
/// place that the eye sees of it, along the sightline with its reflections. It is compared exactly:
/// a place at just that distance is seen with closed sight, and not with open sight. Images in
/// mirrors that are rounded count from where they are. SL_BAD_ARGUMENT for less and for values that
/// are not finite; and for more than the map's own range, where it has one: the visible sets know
/// of nothing farther.
SL_API sl_status sl_query_set_range(sl_context *context, sl_query *query, double range);
/// How far is seen, as it is set; 0 for no limit.
SL_API double sl_query_range(const sl_query *query);

/// How often mirrors reflect a sightline at most: 0 to 16, else SL_BAD_ARGUMENT.
SL_API sl_status sl_query_set_mirror_depth(sl_context *context, sl_query *query, uint32_t depth);

// --- questions

/// The cell that holds a point; SL_NO_CELL outside the bounds.
SL_API uint32_t sl_query_locate(const sl_query *query, sl_point point);

/// Whether some point of cell `from` sees some point of cell `to` directly, with the doors as they
/// are: the visible sets' answer.
SL_API sl_status sl_query_can_see(sl_context *context, sl_query *query, uint32_t from, uint32_t to,
                                  bool *out);

/// What some point of a cell sees, directly or by mirror, with the doors as they are: the visible
/// sets' row, sl_eye_words() words. SL_BAD_ARGUMENT without visible sets. Time: the row; backwards,
/// all rows.
SL_API sl_status sl_query_row(sl_context *context, sl_query *query, uint32_t cell, bool mirrored,
                              uint64_t *cells);

/// The space as the settings make it. Shut doors are walls, and so is the dark side of glass. Its
/// walls are those of the space that is asked, and then these. With boxes that block, cells are
/// cut: cell c is a part of cell (*parents)[c]. Else *parents, which may be NULL, is NULL. Valid
/// until a setting changes. A portal that is shut has no directed portals.
SL_API sl_status sl_query_space(sl_context *context, sl_query *query, const sl_space **space,
                                const uint32_t **parents);

/// A copy of the space as one eye finds it, without its boxes, for methods that do not know one-way
/// glass. Shut doors are walls, and so is glass that is dark for the eye; other glass is open both
/// ways. Cells have their numbers. The caller's: sl_space_destroy().
SL_API sl_status sl_query_copy_space(sl_context *context, sl_query *query, sl_point eye,
                                     sl_space *out);

/// The outline that sight goes by, of the space that the settings make; made when it is first asked
/// for. Valid until a setting changes.
SL_API sl_status sl_query_outline(sl_context *context, sl_query *query, const sl_outline **out);

/// Makes what regions and sightlines need. Then several threads may ask for regions, whether points
/// are seen and what rays meet at the same time, each with a context of its own, until a setting
/// changes; not with boxes that block.
SL_API sl_status sl_query_prepare(sl_context *context, sl_query *query);

/// Whether an eye sees a point directly, past boxes and within range. Exact. With closed sight,
/// portals lead from a cell that the eye stands in (view.h) to a cell that touches the point, and
/// the segment between eye and point touches each of them. It may graze walls on either side, but
/// crosses none. (One that grazes walls on both sides leads the culling methods to no cell.) With
/// open sight, if the bake has it, the segment has no point in common with a wall. False where
/// either point is outside the bounds, and where the eye is in solid ground.
SL_API sl_status sl_query_sees(sl_context *context, sl_query *query, sl_point eye, sl_point point,
                               bool *out);

/// The first wall on the ray from an eye through a point, whatever the range: just to the left of
/// the ray, so a corner that the ray touches stops it where the corner's walls reach to its left.
/// For an eye on a wall, whose ray does not lead into what the eye sees (view.h), it is that wall,
/// at the eye. The wall is exact; the point is rounded. SL_BAD_ARGUMENT where the eye is outside
/// the bounds or in solid ground, the two points are the same, or one is not finite.
SL_API sl_status sl_query_cast(sl_context *context, sl_query *query, sl_point eye, sl_point through,
                               sl_hit *out);

/// A view from an eye: heading in degrees counter-clockwise from +x, width in degrees. A width of
/// 360 is all round.
SL_API sl_view sl_query_view(const sl_query *query, sl_point eye, double heading, double fov);

/// The cells that a view sees directly: sl_eye_words() words, a bit a cell. `method`: NULL for the
/// exact one, or one of sl_eye_methods(). The exact one sees past boxes and within range; the
/// others take no notice of either and keep more. `account` may be NULL. Fails as the method does.
SL_API sl_status sl_query_look(sl_context *context, sl_query *query, const sl_view *view,
                               const sl_eye_method *method, uint64_t *cells,
                               sl_eye_account *account);

/// Takes the cells out of a set of which every point is out of range of an eye: methods other than
/// the exact one keep them. Exact. Nothing without a range.
SL_API void sl_query_drop_far(const sl_query *query, sl_point eye, uint64_t *cells);

/// The cells that a view sees by mirror, as sl_query_look. A sightline crosses a mirror as it would
/// cross a portal, by the same rules: it must cross all of them strictly forwards, in mirrored
/// space. So an eye on a mirror looks into it. Behind axial mirrors answers are exact. They are
/// rounded where sums of two doubles do not hold the place of an image (coordinates that are more
/// than about 30 digits apart) and behind oblique mirrors; the account counts those. They are then
/// exact for an eye and a cone that each reflection moves by a few units in the last place of the
/// largest coordinates.
///
/// Methods other than the exact one give what was baked, so no more reflections than the bake's.
/// None where the map has no mirror or the depth is 0. SL_UNSUPPORTED where the method does not
/// know mirrors (sl_eye_method.mirrored).
SL_API sl_status sl_query_look_mirrored(sl_context *context, sl_query *query, const sl_view *view,
                                        const sl_eye_method *method, uint64_t *cells,
                                        sl_eye_account *account);

/// By box, whether it is seen directly (`seen`) and by mirror (`mirrored`). A box is seen if it
/// holds the eye, or if a sightline crosses one of its sides or ends there; with closed sight also
/// if it touches a side or runs along it. A side that a wall covers is not seen. A box that is one
/// point is seen where sl_query_sees says so, and not by mirror. By mirror, the box that holds the
/// eye is seen where a sightline comes back to it. Boxes that block also hide each other.
///
/// Either may be NULL: it then costs nothing. If no box blocks, sight is closed, and there is
/// no mirror or range, cells are not cut. Then 1,000 boxes that move cost a millisecond. A box then
/// also counts if a sightline ends at a single point of it.
SL_API sl_status sl_query_boxes_seen(sl_context *context, sl_query *query, const sl_view *view,
                                     bool *seen, bool *mirrored);

/// The visible region of a view, past boxes and within range, by expanding it through portals from
/// the cells at the eye (Teller 1992, Visibility Computations in Densely Occluded Polyhedral
/// Environments, eye-to-region; Bungiu et al. 2014, Efficient Computation of Visibility Polygons).
///
/// What an eye sees that is on a wall, on its end or on a portal, view.h says. Where a wall parts
/// what is around the eye, the eye is a point of its region; so is the eye of a cone. An eye that
/// sees nothing, and a cone of 0 degrees, have an empty region. SL_BAD_ARGUMENT for a cone's border
/// that is the eye itself or not finite. On failure the region is empty.
///
/// Edges on the sides of boxes have walls from SL_BOX_WALL on. For an eye on the border of a box
/// that blocks, walls are those of sl_query_space.
SL_API sl_status sl_query_region(sl_context *context, sl_query *query, const sl_view *view,
                                 sl_region *out);

/// The same with what is seen by mirror; without a mirror, the direct region alone. Sightlines are
/// at most as long as the range, with their reflections.
///
/// Behind axial mirrors it is decided exactly which walls are met, and in what order, as in the
/// direct region. Places in mirrored space are sums of two doubles; `rounded` says where these do
/// not suffice. Behind oblique mirrors the eye's image and the borders of what is seen are rounded,
/// at each reflection by a few units in the last place of the largest coordinates. A part is then
/// exact for an eye and a cone moved by that much.
///
/// An eye on a mirror sees nothing in it. Time: that of a region for each part. The number of parts
/// may grow with the depth as a power of the number of mirrors.
SL_API sl_status sl_query_mirrored_region(sl_context *context, sl_query *query, const sl_view *view,
                                          sl_mirrored_region *out);
/// The same with up to `depth` reflections, whatever is set: deeper ones take longer.
SL_API sl_status sl_query_mirrored_region_to(sl_context *context, sl_query *query,
                                             const sl_view *view, uint32_t depth,
                                             sl_mirrored_region *out);

#ifdef __cplusplus
}
#endif

#endif
