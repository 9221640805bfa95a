/// How far apart cells lie, as a view range asks.
#ifndef SL_CELLS_APART_H
#define SL_CELLS_APART_H

#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

/// Whether lines between two cells, from where they leave the one to where they enter the other,
/// are within the range: ordered by how far apart the cells are.
typedef enum sl_apart {
    SL_ALL_WITHIN, ///< all are
    SL_SOME_WITHIN,
    SL_NONE_WITHIN, ///< none is, nor within rounding of it
} sl_apart;

/// The pairs of `pvs` whose cells are no farther apart than `most`.
sl_status sl_pvs_within(sl_context *context, const sl_space *space, const sl_pvs *pvs, double range,
                        sl_apart most, sl_pvs *out);

#endif
