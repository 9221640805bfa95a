/// What a Doom map's lumps say, record by record, before anything is looked up.
#ifndef SL_DOOM_RECORDS_H
#define SL_DOOM_RECORDS_H

#include "io/doom.h"

typedef struct sl_doom_linedef {
    int64_t vertex[2]; ///< from, to
    int64_t side[2];   ///< right, left; -1 for none
    int special, tag;
    uint32_t line; ///< of the TEXTMAP; 0 in lumps of records
} sl_doom_linedef;

typedef struct sl_doom_sidedef {
    int64_t sector;
    uint32_t line;
} sl_doom_sidedef;

/// Zeroed, it is empty.
typedef struct sl_doom_records {
    SL_ARRAY(sl_point) vertices;
    SL_ARRAY(sl_doom_linedef) linedefs;
    SL_ARRAY(sl_doom_sidedef) sidedefs;
    SL_ARRAY(sl_doom_sector) sectors;
    SL_ARRAY(sl_start) starts;
    bool hexen_specials;
    const char *format;
} sl_doom_records;

/// The type of a thing where player 1 starts.
enum { SL_DOOM_PLAYER_1 = 1 };

/// Reads lumps of records: Doom's, or Hexen's where there is a BEHAVIOR.
sl_status sl_doom_read_lumps(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                             sl_doom_records *records);

/// Reads a TEXTMAP.
sl_status sl_doom_read_textmap(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                               sl_doom_records *records);

#endif
