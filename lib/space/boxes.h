/// Boxes put into a space. The space is not subdivided again: only the cells with boxes are cut.
#ifndef SL_BOXES_H
#define SL_BOXES_H

#include "sightline/space.h"
#include "space/kd_tree.h"

/// A space to put boxes into. Zeroed, it is empty.
typedef struct sli_box_ground {
    const sl_space *space;
    sli_piece *walls; ///< its axial walls by line, each place once
    size_t wall_count;
} sli_box_ground;

/// SL_UNSUPPORTED for a space with directed portals missing, and for a loose one.
sl_status sli_box_ground_create(sl_context *context, const sl_space *space, sli_box_ground *out);
void sli_box_ground_destroy(sl_context *context, sli_box_ground *ground);

/// A space with boxes in it. The sides of boxes that block are walls, after those of the ground; an
/// axial wall in the same place is not doubled. Cells are cut along the sides of all boxes. Cells
/// keep their numbers: the first part of a cut cell has the number of the cell, the other parts
/// come after all cells.
///
/// In a kd-tree's space no coordinate is computed. In a mesh, a wall or portal that a side of a box
/// crosses goes through the nearest representable point of that side. So cells may reach into
/// neighbours of their parents, by the size of rounding. `shares` lists exactly these neighbours.
/// Portals keep the seams of the portals that they are parts of.
typedef struct sli_boxed_space {
    sl_space space;
    uint32_t *parents;     ///< by cell: the cell of the ground that it is, or is a part of
    uint32_t *first_share; ///< by cell, and one more; NULL: no cell has a share
    uint32_t *shares; ///< the cells of the ground, other than the parent, that cell c overlaps:
                      ///< from first_share[c] to first_share[c + 1]
} sli_boxed_space;

sl_status sli_boxes_put(sl_context *context, const sli_box_ground *ground,
                        const sl_moving_box *boxes, size_t count, sli_boxed_space *out);
void sli_boxed_space_destroy(sl_context *context, sli_boxed_space *boxed); ///< and zeroes it

// --- parts of sli_boxes_put; `out` is zeroed, and to be destroyed also on failure

/// In a mesh (boxes_mesh.c).
sl_status sli_boxes_put_mesh(sl_context *context, const sli_box_ground *ground,
                             const sl_moving_box *boxes, size_t count, sli_boxed_space *out);

/// SL_BAD_ARGUMENT for boxes whose corners are not in order, or whose coordinates
/// sl_coordinate_usable refuses.
sl_status sli_boxes_check(sl_context *context, const sl_moving_box *boxes, size_t count);

/// Whether a box and a cell have a point in common; a point of the border is enough. Exact.
bool sli_cell_meets_box(const sl_space *space, uint32_t cell, sl_box box);

// --- the sides of boxes

typedef SL_ARRAY(sli_piece) sli_piece_list;

/// Adds to a list the parts of a piece that sorted walls (sli_wall_lines) leave free.
sl_status sli_piece_add_free(sl_context *context, const sli_piece *walls, size_t count,
                             sli_piece piece, sli_piece_list *out);

/// The sides of positive length of a box.
unsigned sli_box_sides(sl_box box, sli_piece sides[4]);

/// Adds the sides of the boxes that block, or of those that do not, to an empty list: sorted, each
/// place once, without the parts outside the bounds or on axial walls.
sl_status sli_box_sides_put(sl_context *context, const sli_box_ground *ground,
                            const sl_moving_box *boxes, size_t count, bool blocking,
                            sli_piece_list *out);

/// A piece as a wall, from lo to hi.
sl_wall sli_piece_wall(const sli_piece *piece);

#endif
