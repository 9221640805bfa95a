/// Boxes put into a space whose walls are axial, without subdividing it anew: only the cells that
/// they lie in are cut, at the lines of their sides. No coordinate is computed.
#ifndef SL_BOXES_H
#define SL_BOXES_H

#include "sightline/space.h"
#include "space/wall_lines.h"

/// A space to put boxes into. Zeroed, it is empty.
typedef struct sl_box_ground {
    const sl_space *space;
    sl_piece *walls; ///< its walls by line
} sl_box_ground;

/// SL_UNSUPPORTED for a space that is no kd-tree's, or has exits missing.
sl_status sl_box_ground_create(sl_context *context, const sl_space *space, sl_box_ground *out);
void sl_box_ground_destroy(sl_context *context, sl_box_ground *ground);

/// A space with boxes in it. The sides of those that block are walls, behind those of the ground;
/// where a wall stands already there is no second one. Cells keep their numbers: of one that is
/// cut, the first part does, and the others come behind all cells. No open cell reaches over a
/// side of a box.
typedef struct sl_boxed_space {
    sl_space space;
    uint32_t *parents; ///< by cell: that of the ground which it is (a part of)
} sl_boxed_space;

sl_status sl_boxes_put(sl_context *context, const sl_box_ground *ground, const sl_moving_box *boxes,
                       size_t count, sl_boxed_space *out);
void sl_boxed_space_destroy(sl_context *context, sl_boxed_space *boxed); ///< and zeroes it

typedef SL_ARRAY(sl_piece) sl_piece_list;

/// Adds to a list what sorted pieces, as sl_wall_lines gives them, leave free of one.
sl_status sl_piece_add_free(sl_context *context, const sl_piece *walls, size_t count,
                            sl_piece piece, sl_piece_list *out);

/// The sides of a box: those of positive length.
unsigned sl_box_sides(sl_box box, sl_piece sides[4]);

#endif
