/// Writing a WAD anew with one lump changed.
#ifndef SL_WAD_WRITE_H
#define SL_WAD_WRITE_H

#include "import/wad.h"

/// Writes a copy of the WAD in which a map's lump has other bytes; "-" for stdout. Where the lump
/// has that size already and shares its bytes with no other, the copy differs in these bytes alone.
/// Else the new bytes stand at the end, before a new directory; a lump that the map did not have
/// comes before its BLOCKMAP, or last (before the ENDMAP of a TEXTMAP). All other lumps keep their
/// bytes, their place and their order.
sl_status sl_wad_write_with(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                            const char *lump_name, const sl_lump *lump, const char *path);

#endif
