/// A WAD: lumps, pieces of bytes with a name each, in a directory. Maps are runs of lumps behind a
/// header lump that has the map's name. (The format as in M. Fell's Unofficial Doom Specs 1.666,
/// chapters 2 and 4, and the Universal Doom Map Format 1.1.)
#ifndef SL_WAD_H
#define SL_WAD_H

#include "sightline/support.h"

enum { SL_LUMP_NAME = 9 }; ///< eight characters and a 0

/// A WAD in memory, which it borrows. `name` is for messages.
typedef struct sl_wad {
    const char *name;
    const unsigned char *bytes;
    size_t size, directory;
    uint32_t lump_count;
} sl_wad;

typedef struct sl_lump {
    const unsigned char *bytes;
    size_t size;
} sl_lump;

/// A map: the lumps header + 1 .. end - 1.
typedef struct sl_wad_map {
    char name[SL_LUMP_NAME];
    uint32_t header, end;
    bool is_text; ///< a TEXTMAP, not lumps of records
} sl_wad_map;

/// Whether the bytes start as a WAD does.
bool sl_wad_known(const void *bytes, size_t size);

/// Checks the header and that the directory lies in the file. SL_BAD_INPUT.
sl_status sl_wad_open(sl_context *context, const char *name, const void *bytes, size_t size,
                      sl_wad *wad);

void sl_wad_lump_name(const sl_wad *wad, uint32_t index, char name[SL_LUMP_NAME]);

/// SL_BAD_INPUT where the lump does not lie in the file.
sl_status sl_wad_lump(sl_context *context, const sl_wad *wad, uint32_t index, sl_lump *lump);

/// The next map whose header is lump *at or a later one, *at then behind it; false for none.
bool sl_wad_next_map(const sl_wad *wad, uint32_t *at, sl_wad_map *map);

/// The map by its name (letters and capitals are the same), NULL for the first; of several with one
/// name the last, which is the one that the game takes. SL_BAD_INPUT where there is none.
sl_status sl_wad_find_map(sl_context *context, const sl_wad *wad, const char *name,
                          sl_wad_map *map);

/// The lump of a map by its name; wad->lump_count where there is none.
uint32_t sl_wad_find_lump(const sl_wad *wad, const sl_wad_map *map, const char *name);

/// Numbers of records: 16 bits, low byte first.
static inline unsigned sl_wad_u16(const unsigned char *at) {
    return at[0] | (unsigned)at[1] << 8;
}

static inline int sl_wad_i16(const unsigned char *at) {
    const int value = (int)sl_wad_u16(at);
    return value < 0x8000 ? value : value - 0x10000;
}

static inline uint32_t sl_wad_u32(const unsigned char *at) {
    return sl_wad_u16(at) | (uint32_t)sl_wad_u16(at + 2) << 16;
}

// --- writing a WAD with some lumps changed

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
