/// Which sectors of a Doom map each cell reaches into. Lines that are seen through cut cells only
/// where that is asked for (seams), so that one cell may reach into several sectors.
#ifndef SL_CELL_SECTORS_H
#define SL_CELL_SECTORS_H

#include "import/doom.h"
#include "sightline/space.h"

/// The sectors of cell i are sectors[first[i] .. first[i + 1]), ascending, each once.
typedef struct sl_cell_sectors {
    uint32_t *first; ///< cell_count + 1
    uint32_t *sectors;
} sl_cell_sectors;

/// Every sector that has a part within a cell's polygon is among the cell's, for each map whose
/// lines say the sectors at both their sides rightly: a sector is found by the lines that pass
/// through the cell's interior (exactly decided), by those that run along its border, and by the
/// line to the right of its middle. Where cleaning rounded or welded lines, a cell may reach beyond
/// a line as read, and then counts for the sector there too. Reports stage "sectors", unit "cells".
sl_status sl_cell_sectors_find(sl_context *context, const sl_space *space,
                               const sl_doom_level *level, sl_cell_sectors *out);
void sl_cell_sectors_destroy(sl_context *context, sl_cell_sectors *sectors); ///< and zeroes it

#endif
