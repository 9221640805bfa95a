/// Doom's REJECT: a bit for each ordered pair of sectors, set where no place of the one sees a
/// place of the other, rows by the looking sector, low bits first (Unofficial Doom Specs 1.666,
/// 4-9).
#ifndef SL_REJECT_H
#define SL_REJECT_H

#include "import/doom.h"
#include "sightline/pvs.h"
#include "sightline/reject.h"
#include "sightline/space.h"

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
