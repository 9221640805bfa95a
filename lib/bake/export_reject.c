// A copy of a WAD with the REJECT of the map that was baked.
#include "bake/exports.h"
#include "bake/reject.h"
#include "import/wad_write.h"
#include "sightline/import.h"
#include "sightline/support.h"

typedef struct reject_export {
    sl_context *context;
    const sl_baked *baked;
    const sl_export_options *options;
    sl_wad wad;
    sl_wad_map map;
    sl_doom_level level;
    sl_reject reject;
} reject_export;

static bool has_walls(const sl_space *space, const sl_map *map) {
    if (map->wall_count != space->wall_count) return false;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *a = &map->walls[i], *b = &space->walls[i];
        if (a->a.x != b->a.x || a->a.y != b->a.y || a->b.x != b->b.x || a->b.y != b->b.y)
            return false;
    }
    return true;
}

/// Whether the walls of the space are those of the WAD's map, read and cleaned as a bake does.
static sl_status compare_map(const reject_export *export, bool cells, bool *same) {
    const sl_import_options options = {
        .map = export->map.name, .cells = cells, .sectors = export->baked->map.seam_count > 0};
    sl_map map = {0};
    SL_TRY(sl_map_read_wad(export->context, export->wad.name, (const char *)export->wad.bytes,
                           export->wad.size, &options, &map));
    const sl_status status = sl_map_clean(export->context, &map, NULL, NULL);
    *same = has_walls(&export->baked->space, &map);
    sl_map_destroy(export->context, &map);
    return status;
}

/// Baked with the cells of a node builder, walls are cut where these have corners.
static sl_status check_map(const reject_export *export) {
    bool same = false;
    SL_TRY(compare_map(export, false, &same));
    if (!same) {
        const sl_status status = compare_map(export, true, &same);
        if (status != SL_BAD_INPUT) SL_TRY(status); // there may be no such cells
    }
    if (same) return SL_OK;
    return sl_fail_at(export->context, export->wad.name, 0,
                      "map %s has other walls than the baked file, which was made from another map",
                      export->map.name);
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

static sl_status write_reject(const reject_export *export, const char *path) {
    const sl_wad_edit edit = {
        .map = export->map, .name = "REJECT", .lump = {export->reject.bytes, export->reject.size}};
    SL_TRY(sl_wad_write(export->context, &export->wad, &edit, 1, path));
    const sl_reject_account *account = &export->reject.account;
    const double pairs = (double)account->sectors * ((double)account->sectors - 1) / 2;
    sl_note(export->context,
            "map %s: of %u sectors %llu pairs (%.1f %%) are hidden; %u sectors that no "
            "looked-at cell reaches into hide nothing",
            export->map.name, account->sectors, (unsigned long long)account->hidden,
            pairs > 0 ? 100 * (double)account->hidden / pairs : 0, account->unknown);
    return SL_OK;
}

static sl_status export_map(reject_export *export, const char *path) {
    SL_TRY(sl_wad_find_map(export->context, &export->wad, export->options->map, &export->map));
    SL_TRY(check_map(export));
    SL_TRY(sl_doom_read(export->context, &export->wad, &export->map, &export->level));
    SL_TRY(sl_reject_make(export->context, &export->baked->space, &export->baked->visibility.pvs,
                          &export->level, &export->reject));
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
    sl_reject_destroy(context, &export.reject);
    sl_free(context, bytes.data);
    return status;
}
