/// Things that move at run time: boxes that are culled, and boxes that block sight, in a space and
/// with visible sets that know nothing of them. No new bake is made when they move.
#ifndef SIGHTLINE_MOVING_H
#define SIGHTLINE_MOVING_H

#include "sightline/eye_to_cell.h"
#include "sightline/outline.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The cells in which a box lies, those that it only touches included: a bit a cell, sl_eye_words()
/// words, set. Exact. Time: in a kd-tree's space all cells, in a mesh those in the buckets near it.
SL_API void sl_cells_of_box(const sl_space *space, sl_box box, uint64_t *cells);

/// A space with boxes in it, to look at. Serves one thread at a time.
typedef struct sl_moving sl_moving;

/// No boxes are in it yet. The space and the visible sets must outlive it; `visibility` is as
/// sl_eye_search_create takes it, and stab trees are not looked at. SL_UNSUPPORTED for a space
/// without directed portals that its portals should have (one-way glass), and for a loose one.
SL_API sl_status sl_moving_create(sl_context *context, const sl_space *space,
                                  const sl_visibility *visibility, sl_moving **out);
/// Frees what sl_moving_create gave; NULL is fine.
SL_API void sl_moving_destroy(sl_context *context, sl_moving *moving);

/// Puts these boxes in, in place of those before. Only the cells that sides of boxes touch are cut,
/// but the rest of the space is copied. SL_BAD_ARGUMENT for boxes whose corners are not in order or
/// have coordinates that sl_coordinate_usable does not take, SL_UNSUPPORTED where walls run along
/// each other within steps of doubles and bend each other without end; what was there before then
/// stays.
///
/// Where a side of a box crosses an oblique wall, the wall is led through the nearest representable
/// point on that side; everything else is exact. In a space of axial walls no coordinate is
/// computed at all. (Borders between cells are led through such points too; nothing is hidden or
/// seen by that.)
SL_API sl_status sl_moving_place(sl_context *context, sl_moving *moving, const sl_moving_box *boxes,
                                 size_t count);

/// How far is seen, as sl_eye_search_limit tells; it stays until it is set anew.
SL_API void sl_moving_limit(sl_moving *moving, double range);

/// Has looks go into mirrors, with boxes and without them, as sl_eye_search_add_mirrors tells. The
/// map must outlive it.
SL_API sl_status sl_moving_add_mirrors(sl_context *context, sl_moving *moving, const sl_map *map,
                                       uint32_t depth);

/// The space with the boxes: cells cut along their sides, which are walls where they block. Cell c
/// of it is (a part of) cell parents[c] of the space without. Cells and walls of that one keep
/// their numbers, but that a cell as narrow as a step of doubles may vanish: the last one then
/// takes its number. In a mesh, a wall that is crossed is several sides of cells
/// (sl_space.cut_walls), and there are no seams. Until boxes are next placed.
SL_API const sl_space *sl_moving_space(const sl_moving *moving, const uint32_t **parents);

/// Its outline, for sl_region_make, sl_sees, sl_ray_cast and sl_room_mirrors_make. Made when it is
/// first asked for.
SL_API sl_status sl_moving_outline(sl_context *context, sl_moving *moving, const sl_outline **out);

/// What an eye sees past the boxes, by exact eye-to-cell culling within the visible set of its
/// cell.
///
/// `cells`: the cells of the space without boxes, sl_eye_words() words: those of which a part is
/// seen, as in a space whose walls the boxes' sides are.
/// `seen`: by box, whether it is seen: whether a sightline meets one of its sides, crossing it or
/// ending there, with closed sight also touching it or running along it; or whether it holds the
/// eye. A side that a wall covers is not seen. A box that is one point is seen where sl_sees says
/// so. Of several boxes that block, each is seen past the others.
///
/// `account` is set, in cells of the space with boxes. Fails as the method "exact" does.
SL_API sl_status sl_moving_look(sl_context *context, sl_moving *moving, const sl_view *view,
                                uint64_t *cells, bool *seen, sl_eye_account *account);

/// Likewise what is seen by mirror, with at least one reflection: boxes block sightlines before and
/// behind mirrors, and are seen in them. The box that holds the eye is seen so where a sightline
/// comes back to it; one that is a point is not. SL_BAD_ARGUMENT where no mirrors were added.
SL_API sl_status sl_moving_look_mirrored(sl_context *context, sl_moving *moving,
                                         const sl_view *view, uint64_t *cells, bool *seen,
                                         sl_eye_account *account);

#ifdef __cplusplus
}
#endif

#endif
