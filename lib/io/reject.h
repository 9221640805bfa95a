/// Doom's REJECT: a bit for each ordered pair of sectors, set where no place of the one sees a
/// place of the other, rows by the looking sector, low bits first (Unofficial Doom Specs 1.666,
/// 4-9).
#ifndef SL_REJECT_H
#define SL_REJECT_H

#include "io/doom.h"
#include "sightline/pvs.h"
#include "sightline/reject.h"
#include "sightline/space.h"

// --- which sectors a cell reaches into. Lines that are seen through cut cells only where that is
// --- asked for (seams), so that one cell may reach into several sectors.

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

// --- the table

/// Zeroed, it is empty.
typedef struct sl_reject {
    unsigned char *bytes;
    size_t size;
    sl_reject_account account; ///< its name is left empty
} sl_reject;

/// The REJECT of a level from the visible sets of a space made of its walls: hidden are the sectors
/// of which no cells see each other. Nothing is hidden that a sightline joins, where the sets miss
/// nothing: a cell counts for each sector that it reaches into. `out` must be empty; on failure it
/// stays so.
sl_status sl_reject_make(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                         const sl_doom_level *level, sl_reject *out);
void sl_reject_destroy(sl_context *context, sl_reject *reject); ///< and zeroes it

#endif
