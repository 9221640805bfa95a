/// A Doom map as its lines and sectors.
#ifndef SL_DOOM_H
#define SL_DOOM_H

#include "io/wad.h"
#include "sightline/map.h"

#define SL_NO_SECTOR UINT32_MAX

/// A line from one vertex to another. The right hand is its front.
typedef struct sl_doom_line {
    sl_point from, to;
    uint32_t right, left; ///< the sectors at its sides; SL_NO_SECTOR where it has no such side
    int special, tag;     ///< of a line with Hexen's specials, the tag is its first argument
    uint32_t line;        ///< of the TEXTMAP; 0 in lumps of records
} sl_doom_line;

typedef struct sl_doom_sector {
    double floor, ceiling; ///< when the map begins
    int tag;
} sl_doom_sector;

/// Zeroed, it is empty.
typedef struct sl_doom_level {
    char name[SL_LUMP_NAME];
    const char *format; ///< "Doom", "Hexen" or "UDMF"
    bool hexen_specials;
    sl_doom_line *lines;
    sl_doom_sector *sectors;
    sl_start *starts; ///< of player 1
    size_t line_count, sector_count, start_count;
} sl_doom_level;

/// Reads a map of a WAD. SL_BAD_INPUT names the file, the lump, and the line in a TEXTMAP.
/// `level` must be empty; on failure it stays so.
sl_status sl_doom_read(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                       sl_doom_level *level);
void sl_doom_level_destroy(sl_context *context, sl_doom_level *level); ///< and zeroes it

/// Marks the sectors that are doors: those that a door special of a line moves, and those whose
/// ceiling meets the floor when the map begins. `is_door` has one flag a sector, all false.
void sl_doom_find_doors(const sl_doom_level *level, bool *is_door);

#endif
