/// A WAD: lumps, pieces of bytes with a name each, in a directory. Maps are runs of lumps behind a
/// header lump that has the map's name. (The format as in M. Fell's Unofficial Doom Specs 1.666,
/// chapters 2 and 4, and the Universal Doom Map Format 1.1.)
#ifndef SL_WAD_H
#define SL_WAD_H

#include "sightline/import.h"
#include "sightline/io.h"
#include "sightline/map.h"
#include "sightline/pvs.h"
#include "sightline/space.h"
#include "sightline/support.h"

enum { SLI_LUMP_NAME = 9 }; ///< eight characters and a 0

/// A WAD in memory, which it borrows. `name` is for messages.
typedef struct sli_wad {
    const char *name;
    const unsigned char *bytes;
    size_t size, directory;
    uint32_t lump_count;
} sli_wad;

typedef struct sli_lump {
    const unsigned char *bytes;
    size_t size;
} sli_lump;

/// A map: the lumps header + 1 .. end - 1.
typedef struct sli_wad_map {
    char name[SLI_LUMP_NAME];
    uint32_t header, end;
    bool is_text; ///< a TEXTMAP, not lumps of records
} sli_wad_map;

/// Whether the bytes start as a WAD does.
bool sli_wad_known(const void *bytes, size_t size);

/// Checks the header and that the directory lies in the file. SL_BAD_INPUT.
sl_status sli_wad_open(sl_context *context, const char *name, const void *bytes, size_t size,
                       sli_wad *wad);

void sli_wad_lump_name(const sli_wad *wad, uint32_t index, char name[SLI_LUMP_NAME]);

/// SL_BAD_INPUT where the lump does not lie in the file.
sl_status sli_wad_lump(sl_context *context, const sli_wad *wad, uint32_t index, sli_lump *lump);

/// The next map whose header is lump *at or a later one, *at then behind it; false for none.
bool sli_wad_next_map(const sli_wad *wad, uint32_t *at, sli_wad_map *map);

/// The map by its name (letters and capitals are the same), NULL for the first; of several with one
/// name the last, which is the one that the game takes. SL_BAD_INPUT where there is none.
sl_status sli_wad_find_map(sl_context *context, const sli_wad *wad, const char *name,
                           sli_wad_map *map);

/// The lump of a map by its name; wad->lump_count where there is none.
uint32_t sli_wad_find_lump(const sli_wad *wad, const sli_wad_map *map, const char *name);

/// Numbers of records: 16 bits, low byte first.
static inline unsigned sli_wad_u16(const unsigned char *at) {
    return at[0] | (unsigned)at[1] << 8;
}

static inline int sli_wad_i16(const unsigned char *at) {
    const int value = (int)sli_wad_u16(at);
    return value < 0x8000 ? value : value - 0x10000;
}

static inline uint32_t sli_wad_u32(const unsigned char *at) {
    return sli_wad_u16(at) | (uint32_t)sli_wad_u16(at + 2) << 16;
}

// --- writing a WAD with some lumps changed

/// A map's lump that is to have other bytes, which are borrowed.
typedef struct sli_wad_edit {
    sli_wad_map map;
    const char *name;
    sli_lump lump;
} sli_wad_edit;

/// Writes a copy of the WAD in which some lumps, each of which stands there once at most, have
/// other bytes; "-" for stdout. Where a lump has that size already and shares its bytes with no
/// other, the copy differs in these bytes alone. Else the new bytes stand at the end, before a new
/// directory; a lump that the map did not have comes before its BLOCKMAP, or last (before the
/// ENDMAP of a TEXTMAP). All other lumps keep their bytes, their place and their order.
/// SL_UNSUPPORTED where the copy is larger than a WAD can be.
sl_status sli_wad_write(sl_context *context, const sli_wad *wad, const sli_wad_edit *edits,
                        size_t count, const char *path);

// --- A Doom map as its lines and sectors.

#define SLI_NO_SECTOR UINT32_MAX

/// A line from one vertex to another. The right hand is its front.
typedef struct sli_doom_line {
    sl_point from, to;
    uint32_t right, left; ///< the sectors at its sides; SLI_NO_SECTOR where it has no such side
    int special, tag;     ///< of a line with Hexen's specials, the tag is its first argument
    uint32_t line;        ///< of the TEXTMAP; 0 in lumps of records
    bool moves;           ///< a polyobject's: the game may move it away
} sli_doom_line;

typedef struct sli_doom_sector {
    double floor, ceiling; ///< when the map begins
    int tag;
} sli_doom_sector;

/// The kinds of things where players start: 1 to 4, and any of them in a deathmatch; and where
/// teleporters lead to.
enum { SLI_DOOM_PLAYERS = 4, SLI_DOOM_DEATHMATCH = 11, SLI_DOOM_ARRIVAL = 14 };

typedef struct sli_doom_start {
    sl_start start;
    int kind; ///< 1 .. SLI_DOOM_PLAYERS, SLI_DOOM_DEATHMATCH or SLI_DOOM_ARRIVAL
} sli_doom_start;

/// Zeroed, it is empty.
typedef struct sli_doom_level {
    char name[SLI_LUMP_NAME];
    const char *format; ///< "Doom", "Hexen" or "UDMF"
    bool hexen_specials;
    sli_doom_line *lines;
    sli_doom_sector *sectors;
    sli_doom_start *starts;
    size_t line_count, sector_count, start_count;
} sli_doom_level;

/// Reads a map of a WAD. SL_BAD_INPUT names the file, the lump, and the line in a TEXTMAP.
/// `level` must be empty; on failure it stays so.
sl_status sli_doom_read(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                        sli_doom_level *level);
void sli_doom_level_destroy(sl_context *context, sli_doom_level *level); ///< and zeroes it

/// Makes the walls, doors, seams, cells and starts of a level that was read from the WAD's map.
/// `brief`: notes only of what is unusual. `map` must be empty; on failure it is left half made.
sl_status sli_doom_make_map(sl_context *context, const sli_wad *wad, const sli_wad_map *chosen,
                            const sli_doom_level *level, const sl_import_options *options,
                            bool brief, sl_map *map);

/// Drops the map's starts that reach little, and names them. Adds those where players arrive by
/// teleporters, in regions without a start. `brief`: notes only of what is dropped.
sl_status sli_doom_settle_starts(sl_context *context, const sli_doom_level *level, const char *name,
                                 bool brief, sl_map *map);

/// Marks the sectors that are doors: those that a door special of a line moves, and those whose
/// ceiling meets the floor when the map begins. `is_door` has one flag a sector, all false.
void sli_doom_find_doors(const sli_doom_level *level, bool *is_door);

// --- Doom's REJECT: a bit for each ordered pair of sectors, set where no place of the one sees a
// --- place of the other, rows by the looking sector, low bits first (Unofficial Doom Specs 1.666,
// --- 4-9).

// --- which sectors a cell reaches into. Lines that are seen through cut cells only where that is
// --- asked for (seams), so that one cell may reach into several sectors.

/// The sectors of cell i are sectors[first[i] .. first[i + 1]), ascending, each once.
typedef struct sli_cell_sectors {
    uint32_t *first; ///< cell_count + 1
    uint32_t *sectors;
} sli_cell_sectors;

/// Every sector that has a part within a cell's polygon is among the cell's, for each map whose
/// lines say the sectors at both their sides rightly: a sector is found by the lines that pass
/// through the cell's interior (exactly decided), by those that run along its border, and by the
/// line to the right of its middle. Where cleaning rounded or welded lines, a cell may reach beyond
/// a line as read, and then counts for the sector there too. Reports stage "sectors", unit "cells".
sl_status sli_cell_sectors_find(sl_context *context, const sl_space *space,
                                const sli_doom_level *level, sli_cell_sectors *out);
void sli_cell_sectors_destroy(sl_context *context, sli_cell_sectors *sectors); ///< and zeroes it

// --- the table

/// Zeroed, it is empty.
typedef struct sli_reject {
    unsigned char *bytes;
    size_t size;
    sl_reject_account account; ///< its name is left empty
} sli_reject;

/// The REJECT of a level from the visible sets of a space made of its walls: hidden are the sectors
/// of which no cells see each other. Nothing is hidden that a sightline joins, where the sets miss
/// nothing: a cell counts for each sector that it reaches into. `out` must be empty; on failure it
/// stays so.
sl_status sli_reject_make(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                          const sli_doom_level *level, sli_reject *out);
void sli_reject_destroy(sl_context *context, sli_reject *reject); ///< and zeroes it

#endif
