/// Terrains of Tiled's tilesets: tiles that are drawn by a terrain, or a colour of a Wang set,
/// which is solid by its name ("Wall"). A tile is such a one if at least half of its corners and
/// edges that have a terrain at all have one of these.
///
/// Terrains were in Tiled until 1.4, numbered from 0, four to a tile. Wang sets followed them:
/// colours are numbered from 1, eight to a tile, 0 for none. Both are lists of numbers, as an array
/// or as text with commas between, where nothing stands for none.
#include "io/tiled/tiled.h"

#include <stdlib.h>

static bool is_solid_name(const char *name) {
    return sli_game_kind_of(name) >= SLI_GAME_LIKELY;
}

/// The numbers of a tile, and how many of them are terrains, and solid ones.
typedef struct tally {
    const sli_json *names; ///< of the terrains
    int64_t first;         ///< the number of the first
    bool all;              ///< the whole set is named for what is solid
    size_t any, solid;
} tally;

static void count(tally *all, int64_t number) {
    const int64_t at = number - all->first;
    if (at < 0 || (size_t)at >= json_array_size(all->names->value)) return;
    const sli_json terrain = sli_json_item(all->names, (size_t)at);
    const char *name = sli_json_text_of(&terrain, "name");
    const sli_game_kind kind = sli_game_kind_of(name);
    all->any++;
    all->solid +=
        is_solid_name(name) || (all->all && (kind == SLI_GAME_UNSAID || kind == SLI_GAME_STANDS));
}

/// Whether the numbers of a tile make it solid.
static bool are_solid(tally all, const json_t *numbers) {
    for (size_t i = 0; i < json_array_size(numbers); i++) {
        const json_t *number = json_array_get(numbers, i);
        if (json_is_integer(number)) count(&all, json_integer_value(number));
    }
    const char *text = json_string_value(numbers);
    for (const char *at = text; at && *at; at += strcspn(at, ","), at += *at == ',') {
        if (*at < '0' || *at > '9') continue;
        count(&all, strtol(at, NULL, 10));
    }
    return all.solid && 2 * all.solid >= all.any;
}

bool sli_tiled_has_terrain(const sli_json *set, const sli_json *tile) {
    const sli_json names = sli_json_member(set, "terrains");
    const sli_json numbers = sli_json_member(tile, "terrain");
    return are_solid((tally){.names = &names}, numbers.value);
}

static sl_status read_wang_set(const sli_json *wang, sli_tiled_set *set) {
    const sli_json names = sli_json_member(wang, "colors"),
                   tiles = sli_json_member(wang, "wangtiles");
    const tally none = {
        .names = &names, .first = 1, .all = is_solid_name(sli_json_text_of(wang, "name"))};
    for (size_t i = 0; i < json_array_size(tiles.value); i++) {
        const sli_json tile = sli_json_item(&tiles, i), id = sli_json_member(&tile, "tileid");
        const sli_json numbers = sli_json_member(&tile, "wangid");
        int64_t number;
        if (!are_solid(none, numbers.value)) continue;
        SL_TRY(sli_json_whole(&id, 0, UINT32_MAX, &number));
        SL_TRY(sli_tiled_add_tile(wang->file->context, set,
                                  (sli_tiled_tile){.id = (uint32_t)number, .terrain = true}));
    }
    return SL_OK;
}

sl_status sli_tiled_read_wang_sets(const sli_json *json, sli_tiled_set *set) {
    const sli_json sets = sli_json_member(json, "wangsets");
    for (size_t i = 0; i < json_array_size(sets.value); i++) {
        const sli_json wang = sli_json_item(&sets, i);
        SL_TRY(read_wang_set(&wang, set));
    }
    return SL_OK;
}
