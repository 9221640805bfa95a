// Doom's REJECT: a bit for each ordered pair of sectors, set where no place of the one sees a place
// of the other, rows by the looking sector, low bits first (Unofficial Doom Specs 1.666, 4-9).
#include "bake/cell_sectors.h"
#include "bake/exports.h"
#include "base/bits.h"
#include "base/file.h"
#include "import/wad_write.h"
#include "sightline/import.h"

#include <string.h>

typedef struct reject_export {
    sl_context *context;
    const sl_baked *baked;
    const sl_export_options *options;
    sl_wad wad;
    sl_wad_map map;
    sl_doom_level level;
    sl_cell_sectors cells;
    size_t words;   ///< of a row of sectors
    sl_bits *seen;  ///< a row for each sector
    size_t unknown; ///< sectors that no cell reaches into, or of which a cell was not looked at
} reject_export;

// --- the same map

static bool has_walls(const sl_space *space, const sl_map *map) {
    if (map->wall_count != space->wall_count) return false;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *a = &map->walls[i], *b = &space->walls[i];
        if (a->a.x != b->a.x || a->a.y != b->a.y || a->b.x != b->b.x || a->b.y != b->b.y)
            return false;
    }
    return true;
}

/// SL_BAD_INPUT where the walls of the space are not those of the WAD's map: as they are, which
/// cells of the map's own leave them, or cleaned.
static sl_status check_walls(const reject_export *export, sl_map *map) {
    if (has_walls(&export->baked->space, map)) return SL_OK;
    SL_TRY(sl_map_clean(export->context, map, NULL));
    if (has_walls(&export->baked->space, map)) return SL_OK;
    return sl_fail_at(export->context, export->wad.name, 0,
                      "map %s has other walls than the baked file, which was made from another map",
                      export->map.name);
}

static sl_status check_map(const reject_export *export) {
    const sl_import_options options = {.map = export->map.name};
    sl_map map = {0};
    SL_TRY(sl_map_read_wad(export->context, export->wad.name, (const char *)export->wad.bytes,
                           export->wad.size, &options, &map));
    const sl_status status = check_walls(export, &map);
    sl_map_destroy(export->context, &map);
    return status;
}

/// A REJECT must hide nothing that is seen.
static sl_status check_baked(sl_context *context, const sl_baked *baked) {
    if (baked->visibility.guarantee == SL_AGGRESSIVE)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a REJECT needs a method that misses nothing; this file was baked by '%s', "
                       "which may",
                       baked->method);
    if (baked->map.door_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a REJECT needs doors that are seen through; bake without --doors, or "
                       "with --without door");
    return SL_OK;
}

// --- sectors that see each other

static sl_bits *row_of(const reject_export *export, size_t sector) {
    return export->seen + sector * export->words;
}

/// All sectors that cells seen from this one reach into.
static void collect_seen(const reject_export *export, uint32_t cell, sl_bits *row) {
    const sl_cell_sectors *cells = &export->cells;
    memset(row, 0, export->words * sizeof *row);
    for (sl_pvs_run r = sl_pvs_begin(&export->baked->visibility.pvs, cell); sl_pvs_next(&r);)
        for (uint32_t i = cells->first[r.first]; i < cells->first[r.end]; i++)
            sl_bits_add(row, cells->sectors[i]);
}

static void see_all(const reject_export *export, size_t sector) {
    memset(row_of(export, sector), 0xff, export->words * sizeof(sl_bits));
}

static sl_status spread_rows(reject_export *export, sl_bits *row, bool *reached) {
    const sl_cell_sectors *cells = &export->cells;
    for (uint32_t cell = 0; cell < export->baked->space.cell_count; cell++) {
        if (cell % 256 == 0) SL_TRY(sl_check_cancelled(export->context));
        if (cells->first[cell] == cells->first[cell + 1]) continue;
        const bool looked = sl_pvs_count(&export->baked->visibility.pvs, cell) > 0;
        collect_seen(export, cell, row);
        for (uint32_t i = cells->first[cell]; i < cells->first[cell + 1]; i++) {
            const uint32_t sector = cells->sectors[i];
            sl_bits *seen = row_of(export, sector);
            for (size_t w = 0; w < export->words; w++) seen[w] |= row[w];
            reached[sector] |= looked;
            // Nothing is known of what a cell sees that the bake did not look from.
            if (!looked) see_all(export, sector);
        }
    }
    for (size_t i = 0; i < export->level.sector_count; i++) {
        export->unknown += !reached[i];
        if (!reached[i]) see_all(export, i);
    }
    return SL_OK;
}

static sl_status find_seen(reject_export *export) {
    const size_t count = export->level.sector_count;
    export->words = sl_bits_words(count);
    if (count && export->words > SIZE_MAX / 64 / count) return sl_fail_memory(export->context);
    export->seen = sl_alloc_array(export->context, count * export->words, sizeof(sl_bits));
    sl_bits *row = sl_alloc_array(export->context, export->words, sizeof *row);
    bool *reached = sl_alloc_array(export->context, count, sizeof *reached);
    const sl_status status =
        export->seen && row && reached ? spread_rows(export, row, reached) : SL_NO_MEMORY;
    sl_free(export->context, row);
    sl_free(export->context, reached);
    return status;
}

// --- the lump

static sl_status write_reject(reject_export *export, const char *path) {
    const size_t count = export->level.sector_count;
    const size_t size = (count * count + 7) / 8;
    uint64_t hidden = 0;
    unsigned char *bytes = sl_alloc_array(export->context, size, 1);
    if (!bytes) return SL_NO_MEMORY;
    for (size_t a = 0; a < count; a++)
        for (size_t b = 0; b < count; b++) {
            // Sight goes both ways: a pair of which one sees the other is not hidden.
            if (a == b || sl_bits_has(row_of(export, a), b) || sl_bits_has(row_of(export, b), a))
                continue;
            const size_t bit = a * count + b;
            bytes[bit / 8] |= (unsigned char)(1u << bit % 8);
            hidden++;
        }
    const sl_lump lump = {.bytes = bytes, .size = size};
    const sl_status status =
        sl_wad_write_with(export->context, &export->wad, &export->map, "REJECT", &lump, path);
    if (status == SL_OK)
        sl_note(export->context,
                "map %s: of %zu sectors %llu pairs (%.1f %%) are hidden; %zu sectors that no "
                "looked-at cell reaches into hide nothing",
                export->map.name, count, (unsigned long long)hidden / 2,
                count > 1 ? 100 * (double)hidden / ((double)count * (double)(count - 1)) : 0,
                export->unknown);
    sl_free(export->context, bytes);
    return status;
}

static sl_status export_map(reject_export *export, const char *path) {
    SL_TRY(sl_wad_find_map(export->context, &export->wad, export->options->map, &export->map));
    SL_TRY(check_map(export));
    SL_TRY(sl_doom_read(export->context, &export->wad, &export->map, &export->level));
    SL_TRY(sl_cell_sectors_find(export->context, &export->baked->space, &export->level,
                                &export->cells));
    SL_TRY(find_seen(export));
    return write_reject(export, path);
}

sl_status sl_export_reject(sl_context *context, const sl_baked *baked,
                           const sl_export_options *options, const char *path) {
    if (!options->wad || !options->map)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a REJECT is written into a copy of its WAD: give --wad IN.wad and --map "
                       "NAME, the map that was baked");
    SL_TRY(check_baked(context, baked));
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, options->wad, &bytes));
    reject_export export = {.context = context, .baked = baked, .options = options};
    sl_status status = sl_wad_open(context, options->wad, bytes.data, bytes.size, &export.wad);
    if (status == SL_OK) status = export_map(&export, path);
    sl_doom_level_destroy(context, &export.level);
    sl_cell_sectors_destroy(context, &export.cells);
    sl_free(context, export.seen);
    sl_free(context, bytes.data);
    return status;
}
