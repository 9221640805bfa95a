/// A space with boxes that block sight cut into it.
#ifndef SL_MOVING_H
#define SL_MOVING_H

#include "sightline/cell_to_cell.h"
#include "sightline/space.h"
#include "sightline/view.h"

/// A space with boxes in it. For one thread at a time.
typedef struct sli_moving sli_moving;

/// Creates it without boxes. The space and the visible sets must outlive it. `visibility` is as for
/// sli_eye_search_create; stab trees are not used. SL_UNSUPPORTED for a loose space, and for one in
/// which a portal lacks a direction: glass is added by sli_moving_add_glass().
sl_status sli_moving_create(sl_context *context, const sl_space *space,
                            const sl_visibility *visibility, sli_moving **out);
/// Frees what sli_moving_create gave; NULL is fine.
void sli_moving_destroy(sl_context *context, sli_moving *moving);

/// Replaces the boxes by these. Only cells that sides of boxes touch are cut; the rest of the space
/// is copied. SL_BAD_ARGUMENT for boxes whose corners are not in order, or whose coordinates
/// sl_coordinate_usable refuses. SL_UNSUPPORTED where walls run along each other within steps of
/// doubles and bend each other without end. On failure the former boxes stay.
///
/// Where a side of a box crosses an oblique wall, the wall is bent to the nearest representable
/// point on that side; all else is exact. In a space of axial walls no coordinate is computed.
/// (Borders between cells are bent in the same way; that neither hides nor shows anything.)
sl_status sli_moving_set_boxes(sl_context *context, sli_moving *moving, const sl_moving_box *boxes,
                               size_t count);

/// Sets how far is seen, as sli_eye_search_set_range does, until it is set again.
void sli_moving_set_range(sli_moving *moving, double range);

/// Makes queries use mirrors, as sli_eye_search_add_mirrors does. The map must outlive it.
sl_status sli_moving_add_mirrors(sl_context *context, sli_moving *moving, const sl_map *map,
                                 uint32_t depth);

/// Makes one-way glass of the space count, which else is open both ways.
sl_status sli_moving_add_glass(sl_context *context, sli_moving *moving);

/// The space with the boxes: cells are cut along the boxes' sides, which are walls where they
/// block. Cell c of it is cell parents[c] of the space without boxes, or a part of it. Cells and
/// walls keep their numbers. A cell as narrow as a step of doubles may vanish: the last cell then
/// takes its number. In a mesh, a crossed wall is several sides of cells (sl_space.cut_walls). With
/// glass it has walls on the dark sides (sli_filtered_space.dark_walls). Valid until boxes are
/// placed again.
const sl_space *sli_moving_space(const sli_moving *moving, const uint32_t **parents);

/// Its outline, for sli_region_make, sli_sees, sli_ray_cast and sli_room_mirrors_make. Made by the
/// first call.
sl_status sli_moving_outline(sl_context *context, sli_moving *moving, const sl_outline **out);

/// What an eye sees past the boxes, by exact eye-to-cell culling within the visible set of its
/// cell.
///
/// `cells`: the cells of the space without boxes of which a part is seen (sl_eye_words() words), as
/// if the sides of blocking boxes were walls. `seen`: by box, whether it is seen. A box is seen if
/// it holds the eye, or if a sightline crosses one of its sides or ends there; with closed sight
/// also if it touches a side or runs along it. A side that a wall covers is not seen. A box that is
/// one point is seen where sli_sees says so. Boxes that block also hide each other.
///
/// `account`, which may be NULL, is set, in cells of the space with boxes. Errors are those of the
/// method "exact".
sl_status sli_moving_look(sl_context *context, sli_moving *moving, const sl_view *view,
                          uint64_t *cells, bool *seen, sl_eye_account *account);

/// The same for what is seen by mirror, with at least one reflection. Boxes block sightlines before
/// and behind mirrors, and are seen in them. The box that holds the eye is seen where a sightline
/// comes back to it. A box that is one point is not seen. SL_BAD_ARGUMENT where no mirrors were
/// added.
sl_status sli_moving_look_mirrored(sl_context *context, sli_moving *moving, const sl_view *view,
                                   uint64_t *cells, bool *seen, sl_eye_account *account);

#endif
