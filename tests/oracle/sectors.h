/// Which sector of a Doom map a point is in, by the lines around it: apart from the library's own
/// way, and from any nodes that the map comes with.
#ifndef SECTORS_H
#define SECTORS_H

#include "io/doom/wad.h"
#include "oracle/blockers.h"

typedef struct sector_finder sector_finder;

sector_finder *sector_finder_create(const sli_doom_level *level);
void sector_finder_destroy(sector_finder *map);

/// The sector that the nearest lines to the left, right, top and bottom agree on; SLI_NO_SECTOR
/// outside the map, and where they do not agree.
uint32_t sectors_at(sector_finder *map, sl_point point);

/// Whether a REJECT of so many sectors says that `to` is never seen from `from`.
static inline bool sectors_rejected(const sli_lump *reject, size_t count, uint32_t from,
                                    uint32_t to) {
    const size_t bit = (size_t)from * count + to;
    return bit / 8 < reject->size && (reject->bytes[bit / 8] >> bit % 8 & 1);
}

#endif
