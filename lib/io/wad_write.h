/// Writing a WAD anew with some lumps changed.
#ifndef SL_WAD_WRITE_H
#define SL_WAD_WRITE_H

#include "io/wad.h"

/// A map's lump that is to have other bytes, which are borrowed.
typedef struct sl_wad_edit {
    sl_wad_map map;
    const char *name;
    sl_lump lump;
} sl_wad_edit;

/// Writes a copy of the WAD in which some lumps, each of which stands there once at most, have
/// other bytes; "-" for stdout. Where a lump has that size already and shares its bytes with no
/// other, the copy differs in these bytes alone. Else the new bytes stand at the end, before a new
/// directory; a lump that the map did not have comes before its BLOCKMAP, or last (before the
/// ENDMAP of a TEXTMAP). All other lumps keep their bytes, their place and their order.
/// SL_UNSUPPORTED where the copy is larger than a WAD can be.
sl_status sl_wad_write(sl_context *context, const sl_wad *wad, const sl_wad_edit *edits,
                       size_t count, const char *path);

#endif
