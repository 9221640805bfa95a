#include "io/doom_records.h"

/// The records of one lump.
typedef struct record_lump {
    const unsigned char *bytes;
    size_t count;
} record_lump;

static sl_status open_lump(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                           const char *name, size_t record_bytes, record_lump *out) {
    const uint32_t index = sl_wad_find_lump(wad, map, name);
    if (index == wad->lump_count)
        return sl_fail_at(context, wad->name, 0, "map %s has no lump %s", map->name, name);
    sl_lump lump;
    SL_TRY(sl_wad_lump(context, wad, index, &lump));
    if (lump.size % record_bytes)
        return sl_fail_at(context, wad->name, 0,
                          "map %s, lump %s: %zu bytes are no whole number of records of %zu bytes",
                          map->name, name, lump.size, record_bytes);
    *out = (record_lump){.bytes = lump.bytes, .count = lump.size / record_bytes};
    return SL_OK;
}

static sl_status read_vertices(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                               sl_doom_records *records) {
    enum { BYTES = 4 };
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "VERTEXES", BYTES, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->vertices, lump.count));
    for (size_t i = 0; i < lump.count; i++) {
        const unsigned char *at = lump.bytes + i * BYTES;
        records->vertices.items[records->vertices.count++] =
            (sl_point){sl_wad_i16(at), sl_wad_i16(at + 2)};
    }
    return SL_OK;
}

static int64_t side_at(const unsigned char *at) {
    const unsigned side = sl_wad_u16(at);
    return side == 0xffff ? -1 : (int64_t)side;
}

static sl_status read_linedefs(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                               bool hexen, sl_doom_records *records) {
    const size_t bytes = hexen ? 16 : 14;
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "LINEDEFS", bytes, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->linedefs, lump.count));
    for (size_t i = 0; i < lump.count; i++) {
        const unsigned char *at = lump.bytes + i * bytes;
        // Hexen has a special of one byte and five arguments where Doom has special and tag.
        records->linedefs.items[records->linedefs.count++] = (sl_doom_linedef){
            .vertex = {sl_wad_u16(at), sl_wad_u16(at + 2)},
            .special = hexen ? at[6] : (int)sl_wad_u16(at + 6),
            .tag = hexen ? at[7] : sl_wad_i16(at + 8),
            .side = {side_at(at + bytes - 4), side_at(at + bytes - 2)},
        };
    }
    return SL_OK;
}

static sl_status read_sidedefs(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                               sl_doom_records *records) {
    enum { BYTES = 30, SECTOR = 28 };
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "SIDEDEFS", BYTES, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->sidedefs, lump.count));
    for (size_t i = 0; i < lump.count; i++)
        records->sidedefs.items[records->sidedefs.count++] =
            (sl_doom_sidedef){.sector = sl_wad_u16(lump.bytes + i * BYTES + SECTOR)};
    return SL_OK;
}

static sl_status read_sectors(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                              sl_doom_records *records) {
    enum { BYTES = 26, TAG = 24 };
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "SECTORS", BYTES, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->sectors, lump.count));
    for (size_t i = 0; i < lump.count; i++) {
        const unsigned char *at = lump.bytes + i * BYTES;
        records->sectors.items[records->sectors.count++] = (sl_doom_sector){
            .floor = sl_wad_i16(at), .ceiling = sl_wad_i16(at + 2), .tag = sl_wad_i16(at + TAG)};
    }
    return SL_OK;
}

static sl_status read_things(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                             bool hexen, sl_doom_records *records) {
    const size_t bytes = hexen ? 20 : 10;
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "THINGS", bytes, &lump));
    for (size_t i = 0; i < lump.count; i++) {
        // A Hexen thing has an id in front, and its height behind its place.
        const unsigned char *at = lump.bytes + i * bytes + (hexen ? 2 : 0);
        const unsigned char *angle = at + (hexen ? 6 : 4);
        if (sl_wad_u16(angle + 2) != SL_DOOM_PLAYER_1) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &records->starts, 1));
        records->starts.items[records->starts.count++] =
            (sl_start){.at = {sl_wad_i16(at), sl_wad_i16(at + 2)}, .heading = sl_wad_i16(angle)};
    }
    return SL_OK;
}

sl_status sl_doom_read_lumps(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                             sl_doom_records *records) {
    const bool hexen = sl_wad_find_lump(wad, map, "BEHAVIOR") < wad->lump_count;
    records->format = hexen ? "Hexen" : "Doom";
    records->hexen_specials = hexen;
    SL_TRY(read_vertices(context, wad, map, records));
    SL_TRY(read_linedefs(context, wad, map, hexen, records));
    SL_TRY(read_sidedefs(context, wad, map, records));
    SL_TRY(read_sectors(context, wad, map, records));
    return read_things(context, wad, map, hexen, records);
}
