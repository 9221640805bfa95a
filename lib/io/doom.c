#include "io/doom_cells.h"

#include "sightline/io.h"

#include <string.h>

/// What was made of the lines.
typedef struct line_account {
    size_t walls, seen_through, zero_length, without_sides, doors, shut;
} line_account;

typedef struct doom_import {
    sl_context *context;
    const sl_doom_level *level;
    const bool *is_door; ///< NULL where doors are seen through
    bool seams;          ///< lines between sectors are to cut cells
    sl_map *map;
    line_account lines;
} doom_import;

/// A line between a door and another sector is a door, named after the sector.
static sl_status add_door(doom_import *import, const sl_doom_line *line) {
    const bool *is_door = import->is_door;
    if (line->right == line->left || !(is_door[line->right] || is_door[line->left])) return SL_OK;
    // Between two doors: the one with the lower number, wherever the line's front is.
    const uint32_t low = line->right < line->left ? line->right : line->left;
    const uint32_t high = line->right < line->left ? line->left : line->right;
    const uint32_t owner = is_door[low] ? low : high;
    const sl_doom_sector *sector = &import->level->sectors[owner];
    const bool open = sector->ceiling > sector->floor;
    char name[32];
    snprintf(name, sizeof name, "sector_%lu", (unsigned long)owner);
    import->lines.doors++;
    import->lines.shut += !open;
    return sl_map_add_door(import->context, import->map, name, (sl_segment){line->from, line->to},
                           open, line->line);
}

static sl_status add_line(doom_import *import, const sl_doom_line *line) {
    line_account *lines = &import->lines;
    if (line->from.x == line->to.x && line->from.y == line->to.y) {
        lines->zero_length++;
        return SL_OK;
    }
    if (line->right == SL_NO_SECTOR && line->left == SL_NO_SECTOR) {
        lines->without_sides++;
        return SL_OK;
    }
    if (line->right != SL_NO_SECTOR && line->left != SL_NO_SECTOR) {
        lines->seen_through++;
        if (import->seams && line->right != line->left)
            SL_TRY(sl_map_add_seam(import->context, import->map, (sl_segment){line->from, line->to},
                                   line->line));
        return import->is_door ? add_door(import, line) : SL_OK;
    }
    lines->walls++;
    return sl_map_add_wall(import->context, import->map, line->from, line->to, line->line);
}

/// The game puts player 1 where the last of the starts is.
static sl_status add_start(doom_import *import) {
    const sl_doom_level *level = import->level;
    if (level->start_count == 0) return SL_OK;
    const sl_start *start = &level->starts[level->start_count - 1];
    return sl_map_add_start(import->context, import->map, start->at, start->heading, start->line);
}

static void tell(const doom_import *import, const char *name) {
    const sl_doom_level *level = import->level;
    const line_account *lines = &import->lines;
    char doors[64] = "";
    if (import->is_door)
        snprintf(doors, sizeof doors, " (%zu of them doors, %zu shut)", lines->doors, lines->shut);
    sl_note(import->context,
            "%s: map %s (%s): of %zu lines %zu with one side are walls, %zu with two are seen "
            "through%s; left out %zu of zero length, %zu without sides",
            name, level->name, level->format, level->line_count, lines->walls, lines->seen_through,
            doors, lines->zero_length, lines->without_sides);
    if (level->start_count != 1)
        sl_note(import->context, "%s: map %s: player 1 has %zu starts; %s", name, level->name,
                level->start_count, level->start_count ? "the last is taken" : "there is none");
}

/// How many doors are seen through, as nobody asked for doors.
static void tell_doors_left_out(sl_context *context, const char *name, const sl_doom_level *level,
                                const bool *is_door) {
    size_t doors = 0;
    for (size_t i = 0; i < level->sector_count; i++) doors += is_door[i];
    if (doors)
        sl_note(context,
                "%s: map %s: %zu sectors are doors and seen through, shut ones too; "
                "--doors takes them as doors",
                name, level->name, doors);
}

static sl_status add_lines(doom_import *import) {
    for (size_t i = 0; i < import->level->line_count; i++)
        SL_TRY(add_line(import, &import->level->lines[i]));
    return SL_OK;
}

static sl_status make_map(sl_context *context, const sl_wad *wad, const sl_wad_map *chosen,
                          const sl_doom_level *level, const sl_import_options *options,
                          sl_map *map) {
    const char *name = wad->name;
    bool *is_door = sl_alloc_array(context, level->sector_count, sizeof *is_door);
    if (!is_door) return SL_NO_MEMORY;
    sl_doom_find_doors(level, is_door);
    doom_import import = {.context = context,
                          .level = level,
                          .is_door = options->doors ? is_door : NULL,
                          .seams = options->sectors,
                          .map = map};
    sl_status status = add_lines(&import);
    if (status == SL_OK && options->cells) status = sl_doom_add_cells(context, wad, chosen, map);
    if (status == SL_OK) status = add_start(&import);
    if (status == SL_OK) tell(&import, name);
    if (status == SL_OK && !options->doors) tell_doors_left_out(context, name, level, is_door);
    sl_free(context, is_door);
    return status;
}

sl_status sl_map_read_wad(sl_context *context, const char *name, const char *text, size_t size,
                          const sl_import_options *options, sl_map *map) {
    sl_wad wad;
    sl_wad_map chosen;
    sl_doom_level level = {0};
    sl_map read = {0};
    SL_TRY(sl_wad_open(context, name, text, size, &wad));
    SL_TRY(sl_wad_find_map(context, &wad, options->map, &chosen));
    SL_TRY(sl_doom_read(context, &wad, &chosen, &level));
    const sl_status status = make_map(context, &wad, &chosen, &level, options, &read);
    sl_doom_level_destroy(context, &level);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

sl_status sl_map_list_wad(sl_context *context, const char *name, const char *text, size_t size,
                          sl_map_list *list) {
    sl_wad wad;
    sl_wad_map map;
    SL_TRY(sl_wad_open(context, name, text, size, &wad));
    for (uint32_t at = 0; sl_wad_next_map(&wad, &at, &map);) {
        bool known = false;
        for (size_t i = 0; i < list->count && !known; i++)
            known = strcmp(list->names[i], map.name) == 0;
        if (!known) SL_TRY(sl_map_list_add(context, list, map.name, strlen(map.name)));
    }
    return SL_OK;
}
