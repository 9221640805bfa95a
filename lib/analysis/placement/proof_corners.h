/// Corners of the arrangement of what eyes see, for checks of placements; and the directions around
/// a corner. All is decided exactly.
#ifndef SLI_PROOF_CORNERS_H
#define SLI_PROOF_CORNERS_H

#include "analysis/placement/proof_sight.h"

/// What a part of a line is. Sight ends at walls, and borders end there, so these need no crossings
/// with walls; nor do walls with walls, and borders with borders.
typedef enum sli_part_kind {
    SLI_PART_SIGHT,  ///< a ray on which the region of an eye ends
    SLI_PART_BORDER, ///< of what is inside, or between cells
    SLI_PART_EDGE,   ///< of a polygon, which may lie across walls
    SLI_PART_WALL,
} sli_part_kind;

/// A part of a line on which something ends.
typedef struct sli_ray_part {
    sl_segment line;
    sl_point from;
    sli_meet to;
    sl_box box;     ///< holds all of it
    uint32_t group; ///< parts of one group cross nowhere else
    int32_t wall;   ///< at its end; SLI_NO_WALL: the end is no corner of its own
    sli_part_kind kind;
} sli_ray_part;

typedef SL_ARRAY(sli_ray_part) sli_ray_parts;

/// A direction, from a to b.
typedef sl_segment sli_direction;

typedef SL_ARRAY(sli_direction) sli_directions;

/// What is called for each corner: on `wall`, or SLI_NO_WALL; `group` is that of a part there.
typedef sl_status (*sli_corner_visit)(void *data, const sli_meet *p, int32_t wall, uint32_t group);

bool sli_box_may_hold(const sl_box *box, const sli_meet *p);

sl_status sli_ray_add(sl_context *context, sli_ray_part part, sli_ray_parts *parts);
/// From a to b, with no corner at its end.
sli_ray_part sli_ray_between(sl_point a, sl_point b, uint32_t group, sli_part_kind kind);
/// The part of an eye's ray on which its region ends; false where it ends on none.
bool sli_ray_of_eye(const sli_proof_scene *scene, const sli_eye *eye, uint32_t ray, uint32_t group,
                    sli_ray_part *out);
/// The rays on which the region of an eye ends; its number is their group.
sl_status sli_ray_add_eye(sl_context *context, const sli_proof_scene *scene, const sli_eye *eye,
                          uint32_t group, sli_ray_parts *parts);
/// Whether two parts may cross; *p is where. Corners of walls are left out: they are tried for
/// themselves, as a place there stands between two walls, which rays do not know.
bool sli_rays_cross(const sli_proof_scene *scene, const sli_ray_part *r, const sli_ray_part *s,
                    sli_meet *p);
/// Sorts parts, and visits the ends of rays and all crossings of two.
sl_status sli_rays_visit(sl_context *context, const sli_proof_scene *scene, sli_ray_parts *parts,
                         sli_corner_visit visit, void *data);

/// Whether a closed cell that is inside has a place. `box`: of the cell.
bool sli_cell_has_meet(const sl_space *space, uint32_t cell, const sl_box *box, const sli_meet *p);

// --- directions around a corner

/// Adds a direction, and the one back.
sl_status sli_directions_add(sl_context *context, sl_point a, sl_point b, sli_directions *out);
/// Adds those of lines through a place at which the region of an eye ends.
sl_status sli_directions_add_eye(sl_context *context, const sli_proof_scene *scene,
                                 const sli_eye *eye, const sli_meet *p, sli_directions *out);
/// Adds those of a cell's sides that a place is on.
sl_status sli_directions_add_cell(sl_context *context, const sl_space *space, uint32_t cell,
                                  const sli_meet *p, sli_directions *out);
/// Counter-clockwise, one of each.
void sli_directions_sort(sli_directions *directions);

// A sector is what follows its first direction, counter-clockwise, up to its second one.

/// Whether the beginning of a sector at a place is left of a line.
bool sli_sector_is_left(sl_point a, sl_point b, const sli_meet *p, const sli_direction *sector);
/// Whether a convex polygon, counter-clockwise, has the beginning of a sector at a place.
bool sli_polygon_has_sector(const sl_point *corners, size_t count, const sli_meet *p,
                            const sli_direction *sector);
/// Whether an eye sees the beginning of a sector at a place.
bool sli_eye_sees_sector(const sli_proof_scene *scene, const sli_eye *eye, const sli_meet *p,
                         const sli_direction *sector);
/// Whether an eye sees all around a place.
bool sli_eye_sees_around(const sli_proof_scene *scene, const sli_eye *eye, const sli_meet *p);

#endif
