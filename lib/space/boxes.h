/// Boxes put into a space, without subdividing it anew: only the cells that they lie in are cut.
#ifndef SL_BOXES_H
#define SL_BOXES_H

#include "sightline/space.h"
#include "space/kd_tree.h"

/// A space to put boxes into. Zeroed, it is empty.
typedef struct sl_box_ground {
    const sl_space *space;
    sl_piece *walls; ///< its axial walls by line, each place once
    size_t wall_count;
} sl_box_ground;

/// SL_UNSUPPORTED for a space that has directed portals missing, or is loose.
sl_status sl_box_ground_create(sl_context *context, const sl_space *space, sl_box_ground *out);
void sl_box_ground_destroy(sl_context *context, sl_box_ground *ground);

/// A space with boxes in it. The sides of those that block are walls, behind those of the ground;
/// where an axial wall stands already there is no second one. Cells that are cut are cut along the
/// sides of all boxes. Cells keep their numbers: of one that is cut, the first part does, and the
/// others come behind all cells.
///
/// In a kd-tree's space no coordinate is computed. In a mesh, walls and borders of cells that a
/// box's side crosses are led through the nearest representable point of that side. So cells may
/// reach into neighbours of their parents, by the size of rounding: `shares` has these neighbours,
/// exactly. The space has no seams then.
typedef struct sl_boxed_space {
    sl_space space;
    uint32_t *parents;     ///< by cell: that of the ground which it is (a part of)
    uint32_t *first_share; ///< by cell, and one more; NULL: no cell has a share
    uint32_t *shares;      ///< cells of the ground beside the parent with which cell c has inner
                           ///< points in common: from first_share[c] to first_share[c + 1]
} sl_boxed_space;

sl_status sl_boxes_put(sl_context *context, const sl_box_ground *ground, const sl_moving_box *boxes,
                       size_t count, sl_boxed_space *out);
void sl_boxed_space_destroy(sl_context *context, sl_boxed_space *boxed); ///< and zeroes it

// --- parts of sl_boxes_put; `out` is zeroed, and to be destroyed also on failure

/// In a mesh (boxes_mesh.c).
sl_status sl_boxes_put_mesh(sl_context *context, const sl_box_ground *ground,
                            const sl_moving_box *boxes, size_t count, sl_boxed_space *out);

/// Whether a box and a cell have a point in common, be it on their borders. Exact.
bool sl_cell_meets_box(const sl_space *space, uint32_t cell, sl_box box);

// --- the sides of boxes (box_sides.c)

typedef SL_ARRAY(sl_piece) sl_piece_list;

/// Adds to a list what sorted pieces, as sl_wall_lines gives them, leave free of one.
sl_status sl_piece_add_free(sl_context *context, const sl_piece *walls, size_t count,
                            sl_piece piece, sl_piece_list *out);

/// The sides of a box: those of positive length.
unsigned sl_box_sides(sl_box box, sl_piece sides[4]);

/// Adds the sides of those boxes that block, or of those that do not, to an empty list: sorted,
/// each place once, what of them lies within the space's bounds and is free of its axial walls.
sl_status sl_box_sides_put(sl_context *context, const sl_box_ground *ground,
                           const sl_moving_box *boxes, size_t count, bool blocking,
                           sl_piece_list *out);

/// A piece as a wall, from lo to hi.
sl_wall sl_piece_wall(const sl_piece *piece);

#endif
