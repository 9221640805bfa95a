#include "io/doom_records.h"

#include <string.h>

/// What is needed to look up one record's references.
typedef struct lookup {
    sl_context *context;
    const sl_wad *wad;
    const sl_wad_map *map;
    const sl_doom_records *records;
} lookup;

/// "FILE:12: map MAP01, linedef 3: vertex 99, but there are 8"
static sl_status fail_reference(const lookup *look, const char *record, size_t index, uint32_t line,
                                const char *what, int64_t reference, size_t count) {
    return sl_fail_at(look->context, look->wad->name, line,
                      "map %s, %s %zu: %s %lld, but there are %zu", look->map->name, record, index,
                      what, (long long)reference, count);
}

static sl_status find_sector(const lookup *look, size_t linedef, int side, uint32_t *sector) {
    const sl_doom_records *records = look->records;
    const sl_doom_linedef *line = &records->linedefs.items[linedef];
    const int64_t index = line->side[side];
    *sector = SL_NO_SECTOR;
    if (index == -1) return SL_OK;
    if (index < 0 || (uint64_t)index >= records->sidedefs.count)
        return fail_reference(look, "linedef", linedef, line->line, "sidedef", index,
                              records->sidedefs.count);
    const sl_doom_sidedef *found = &records->sidedefs.items[index];
    if (found->sector < 0 || (uint64_t)found->sector >= records->sectors.count)
        return fail_reference(look, "sidedef", (size_t)index, found->line, "sector", found->sector,
                              records->sectors.count);
    *sector = (uint32_t)found->sector;
    return SL_OK;
}

static sl_status find_line(const lookup *look, size_t linedef, sl_doom_line *out) {
    const sl_doom_records *records = look->records;
    const sl_doom_linedef *line = &records->linedefs.items[linedef];
    sl_point ends[2];
    for (int i = 0; i < 2; i++) {
        if (line->vertex[i] < 0 || (uint64_t)line->vertex[i] >= records->vertices.count)
            return fail_reference(look, "linedef", linedef, line->line, "vertex", line->vertex[i],
                                  records->vertices.count);
        ends[i] = records->vertices.items[line->vertex[i]];
    }
    *out = (sl_doom_line){.from = ends[0],
                          .to = ends[1],
                          .special = line->special,
                          .tag = line->tag,
                          .line = line->line};
    SL_TRY(find_sector(look, linedef, 0, &out->right));
    return find_sector(look, linedef, 1, &out->left);
}

static sl_status find_lines(const lookup *look, sl_doom_level *level) {
    const size_t count = look->records->linedefs.count;
    level->lines = sl_alloc_array(look->context, count, sizeof *level->lines);
    if (!level->lines) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) SL_TRY(find_line(look, i, &level->lines[i]));
    level->line_count = count;
    return SL_OK;
}

sl_status sl_doom_read(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                       sl_doom_level *level) {
    sl_doom_records records = {0};
    const lookup look = {.context = context, .wad = wad, .map = map, .records = &records};
    sl_doom_level read = {0};
    sl_status status = map->is_text ? sl_doom_read_textmap(context, wad, map, &records)
                                    : sl_doom_read_lumps(context, wad, map, &records);
    if (status == SL_OK) status = find_lines(&look, &read);
    sl_free(context, records.vertices.items);
    sl_free(context, records.linedefs.items);
    sl_free(context, records.sidedefs.items);
    memcpy(read.name, map->name, sizeof read.name);
    read.format = records.format;
    read.hexen_specials = records.hexen_specials;
    read.sectors = records.sectors.items;
    read.sector_count = records.sectors.count;
    read.starts = records.starts.items;
    read.start_count = records.starts.count;
    if (status == SL_OK)
        *level = read;
    else
        sl_doom_level_destroy(context, &read);
    return status;
}

void sl_doom_level_destroy(sl_context *context, sl_doom_level *level) {
    sl_free(context, level->lines);
    sl_free(context, level->sectors);
    sl_free(context, level->starts);
    *level = (sl_doom_level){0};
}

// --- doors

/// Whether a special of Doom or Boom is a door's. A manual one moves the sector at its left side,
/// the others those of their tag.
static bool is_doom_door(int special, bool *manual) {
    static const unsigned char by_hand[] = {1, 26, 27, 28, 31, 32, 33, 34, 117, 118};
    static const unsigned char by_tag[] = {
        2,   3,   4,   16,  29,  42,  46,  50,  61,  63,  75,  76,  86,  90,  99,  103, 105, 106,
        107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 133, 134, 135, 136, 137, 175, 196};
    // Boom's generalized doors, the locked ones among them: the low three bits say how they are
    // triggered, 6 and 7 by hand.
    if (special >= 0x3800 && special < 0x4000) {
        *manual = (special & 7) >= 6;
        return true;
    }
    if (special <= 0 || special > 255) return false;
    *manual = memchr(by_hand, special, sizeof by_hand) != NULL;
    return *manual || memchr(by_tag, special, sizeof by_tag) != NULL;
}

/// Whether a special of Hexen or ZDoom is a door's; one with the tag 0 moves the sector at its
/// left.
static bool is_hexen_door(int special) {
    return (special >= 10 && special <= 14) || (special >= 105 && special <= 107) ||
           special == 202 || special == 249;
}

void sl_doom_find_doors(const sl_doom_level *level, bool *is_door) {
    for (size_t i = 0; i < level->sector_count; i++)
        is_door[i] = level->sectors[i].ceiling <= level->sectors[i].floor;
    for (size_t i = 0; i < level->line_count; i++) {
        const sl_doom_line *line = &level->lines[i];
        bool manual = line->tag == 0;
        if (!(level->hexen_specials ? is_hexen_door(line->special)
                                    : is_doom_door(line->special, &manual)))
            continue;
        if (manual && line->left != SL_NO_SECTOR) is_door[line->left] = true;
        if (manual || line->tag == 0) continue;
        for (size_t k = 0; k < level->sector_count; k++)
            if (level->sectors[k].tag == line->tag) is_door[k] = true;
    }
}
