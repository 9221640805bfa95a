/// A map of a Doom WAD as walls, seams, doors and starts; and its GL nodes as cells.
///
/// A line with one side is a wall. A line with two sides is seen through, as are doors, unless
/// doors are asked for. Lines of polyobjects are left out: the game moves them. GL nodes are the
/// convex subsectors that a node builder cut the map into (glBSP's GL nodes, versions 1, 2, 3 and
/// 5, as its document "Specification for GL Nodes" has them: GL_VERT, GL_SEGS and GL_SSECT; the
/// tree of GL_NODES is not needed).
#include "geometry/orient.h"
#include "io/doom/wad.h"
#include "io/io_formats.h"
#include "map/source.h"
#include "sightline/io.h"

#include <string.h>

// --- the cells of a node builder: its lumps

/// One of the lumps, without the four bytes of its version, if it has them.
typedef struct gl_lump {
    const char *name;
    const unsigned char *bytes;
    size_t count;  ///< of records
    size_t record; ///< bytes
} gl_lump;

typedef struct gl_nodes {
    sl_context *context;
    const sli_wad *wad;
    const sli_wad_map *map;
    bool is_wide;      ///< numbers of segs and vertices have 32 bits: versions 3 and 5
    bool is_fixed;     ///< new vertices have 16 bits behind the point: all but version 1
    uint32_t new_flag; ///< of a vertex of GL_VERT
    gl_lump old_vertices, vertices, segs, subsectors;
    SL_ARRAY(sl_point) corners; ///< of the subsector at hand
} gl_nodes;

static sl_status fail_lump(const gl_nodes *gl, const char *lump, const char *what) {
    return sl_fail_at(gl->context, gl->wad->name, 0, "map %s, lump %s: %s", gl->map->name, lump,
                      what);
}

/// Whether a lump is the header of the map's GL nodes: GL_ and the map's name, or, for longer
/// names, GL_LEVEL with a line LEVEL=NAME.
static bool is_header(const gl_nodes *gl, uint32_t index) {
    char name[SLI_LUMP_NAME];
    sli_lump lump;
    sli_wad_lump_name(gl->wad, index, name);
    if (strncmp(name, "GL_", 3) != 0) return false;
    if (strcmp(name + 3, gl->map->name) == 0) return true;
    if (strcmp(name, "GL_LEVEL") != 0 || sli_wad_lump(gl->context, gl->wad, index, &lump) != SL_OK)
        return false;
    const size_t length = strlen(gl->map->name);
    return lump.size >= 6 + length && memcmp(lump.bytes, "LEVEL=", 6) == 0 &&
           memcmp(lump.bytes + 6, gl->map->name, length) == 0 &&
           (lump.size == 6 + length || lump.bytes[6 + length] <= ' ');
}

/// The last header, which is the one that the game takes; the WAD's lump count where there is none.
static uint32_t find_header(const gl_nodes *gl) {
    uint32_t found = gl->wad->lump_count;
    for (uint32_t i = 0; i < gl->wad->lump_count; i++)
        if (is_header(gl, i)) found = i;
    return found;
}

static sl_status find_lump(const gl_nodes *gl, uint32_t header, const char *name, sli_lump *out) {
    for (uint32_t i = header + 1; i < gl->wad->lump_count && i <= header + 5; i++) {
        char own[SLI_LUMP_NAME];
        sli_wad_lump_name(gl->wad, i, own);
        if (strncmp(own, "GL_", 3) != 0) break;
        if (strcmp(own, name) == 0) return sli_wad_lump(gl->context, gl->wad, i, out);
    }
    return fail_lump(gl, name, "is missing");
}

static bool has_mark(const sli_lump *lump, const char *mark) {
    return lump->size >= 4 && memcmp(lump->bytes, mark, 4) == 0;
}

static sl_status cut_records(const gl_nodes *gl, const char *name, sli_lump lump, size_t skip,
                             size_t record, gl_lump *out) {
    const size_t size = lump.size - skip;
    if (size % record) return fail_lump(gl, name, "is cut off: its last record is not whole");
    *out = (gl_lump){
        .name = name, .bytes = lump.bytes + skip, .count = size / record, .record = record};
    return SL_OK;
}

static sl_status open_lumps(gl_nodes *gl) {
    const uint32_t header = find_header(gl);
    if (header == gl->wad->lump_count)
        return sl_fail_at(gl->context, gl->wad->name, 0,
                          "map %s brings no cells: it has no GL nodes; a node builder adds them "
                          "(glbsp IN.wad -o OUT.wad)",
                          gl->map->name);
    sli_lump vertices, segs, subsectors, old;
    SL_TRY(find_lump(gl, header, "GL_VERT", &vertices));
    SL_TRY(find_lump(gl, header, "GL_SEGS", &segs));
    SL_TRY(find_lump(gl, header, "GL_SSECT", &subsectors));
    const bool is_fifth = has_mark(&vertices, "gNd5"), is_third = has_mark(&segs, "gNd3");
    if (has_mark(&vertices, "gNd4"))
        return fail_lump(gl, "GL_VERT", "is of version 4; known are 1, 2, 3 and 5");
    gl->is_wide = is_fifth || is_third;
    gl->is_fixed = is_fifth || has_mark(&vertices, "gNd2");
    gl->new_flag = is_fifth ? 0x80000000u : is_third ? 0x40000000u : 0x8000u;
    const size_t skip = is_third ? 4 : 0, wide = gl->is_wide;
    SL_TRY(cut_records(gl, "GL_VERT", vertices, gl->is_fixed ? 4 : 0, gl->is_fixed ? 8 : 4,
                       &gl->vertices));
    SL_TRY(cut_records(gl, "GL_SEGS", segs, skip, wide ? 16 : 10, &gl->segs));
    if (is_third && !has_mark(&subsectors, "gNd3"))
        return fail_lump(gl, "GL_SSECT", "is of another version than GL_SEGS");
    SL_TRY(cut_records(gl, "GL_SSECT", subsectors, skip, wide ? 8 : 4, &gl->subsectors));
    const uint32_t index = sli_wad_find_lump(gl->wad, gl->map, "VERTEXES");
    if (index == gl->wad->lump_count) return fail_lump(gl, "VERTEXES", "is missing");
    SL_TRY(sli_wad_lump(gl->context, gl->wad, index, &old));
    return cut_records(gl, "VERTEXES", old, 0, 4, &gl->old_vertices);
}

// --- the cells of a node builder: its records

static const unsigned char *record_at(const gl_lump *lump, size_t index) {
    return lump->bytes + index * lump->record;
}

static uint32_t number_at(const gl_nodes *gl, const unsigned char *record, size_t field) {
    return gl->is_wide ? sli_wad_u32(record + 4 * field) : sli_wad_u16(record + 2 * field);
}

static double fixed_at(const unsigned char *at) {
    return (double)(int32_t)sli_wad_u32(at) / 65536;
}

static sl_status find_vertex(const gl_nodes *gl, size_t seg, uint32_t number, sl_point *out) {
    const bool is_new = number & gl->new_flag;
    const gl_lump *lump = is_new ? &gl->vertices : &gl->old_vertices;
    const uint32_t index = number & ~gl->new_flag;
    if (index >= lump->count)
        return sl_fail_at(gl->context, gl->wad->name, 0,
                          "map %s, lump GL_SEGS, seg %zu: vertex %lu of %s, but there are %zu",
                          gl->map->name, seg, (unsigned long)index, lump->name, lump->count);
    const unsigned char *at = record_at(lump, index);
    *out = is_new && gl->is_fixed ? (sl_point){fixed_at(at), fixed_at(at + 4)}
                                  : (sl_point){sli_wad_i16(at), sli_wad_i16(at + 2)};
    return SL_OK;
}

/// The seg's start.
static sl_status add_corner(gl_nodes *gl, size_t seg) {
    sl_point at;
    SL_TRY(find_vertex(gl, seg, number_at(gl, record_at(&gl->segs, seg), 0), &at));
    SL_TRY(SL_ARRAY_ROOM(gl->context, &gl->corners, 1));
    gl->corners.items[gl->corners.count++] = at;
    return SL_OK;
}

static sl_status add_subsector(gl_nodes *gl, size_t index, sl_map *out) {
    const unsigned char *record = record_at(&gl->subsectors, index);
    const uint32_t count = number_at(gl, record, 0), first = number_at(gl, record, 1);
    if (first > gl->segs.count || count > gl->segs.count - first)
        return sl_fail_at(
            gl->context, gl->wad->name, 0,
            "map %s, lump GL_SSECT, subsector %zu: segs %lu to %lu, but there are %zu",
            gl->map->name, index, (unsigned long)first, (unsigned long)first + count,
            gl->segs.count);
    gl->corners.count = 0;
    for (uint32_t i = 0; i < count; i++) SL_TRY(add_corner(gl, first + i));
    // Rounding to whole numbers, as version 1 does, leaves some no area.
    if (sli_distinct_corners(gl->corners.items, count) < 3) return SL_OK;
    return sl_map_add_cell(gl->context, out, gl->corners.items, count, 0);
}

static sl_status add_all(gl_nodes *gl, sl_map *out) {
    SL_TRY(open_lumps(gl));
    for (size_t i = 0; i < gl->subsectors.count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(gl->context));
        SL_TRY(add_subsector(gl, i, out));
    }
    // What vertices are rounded to, with room to spare: whole numbers stay apart.
    out->snap = gl->is_fixed ? 0x1p-11 : 0.49;
    return SL_OK;
}

/// Adds each subsector that the WAD has for the map to `out` as a cell. SL_BAD_INPUT, naming the
/// lump, where there are none or they are damaged.
static sl_status doom_add_cells(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                                sl_map *out) {
    gl_nodes gl = {.context = context, .wad = wad, .map = map};
    const sl_status status = add_all(&gl, out);
    sl_free(context, gl.corners.items);
    return status;
}

// --- walls

/// What was made of the lines.
typedef struct line_account {
    size_t walls, seen_through, zero_length, without_sides, moves, doors, shut;
} line_account;

typedef struct doom_import {
    sl_context *context;
    const sli_doom_level *level;
    const bool *is_door; ///< NULL where doors are seen through
    bool seams;          ///< lines between sectors are to cut cells
    sl_map *map;
    uint32_t item; ///< the number of the line at hand, from 1
    line_account lines;
} doom_import;

/// A line between a door and another sector is a door, named after the sector.
static sl_status add_door(doom_import *import, const sli_doom_line *line) {
    const bool *is_door = import->is_door;
    if (line->right == line->left || !(is_door[line->right] || is_door[line->left])) return SL_OK;
    // Between two doors: the one with the lower number, wherever the line's front is.
    const uint32_t low = line->right < line->left ? line->right : line->left;
    const uint32_t high = line->right < line->left ? line->left : line->right;
    const uint32_t owner = is_door[low] ? low : high;
    const sli_doom_sector *sector = &import->level->sectors[owner];
    const bool open = sector->ceiling > sector->floor;
    char name[32];
    snprintf(name, sizeof name, "sector_%lu", (unsigned long)owner);
    import->lines.doors++;
    import->lines.shut += !open;
    return sl_map_add_door(import->context, import->map, name, (sl_segment){line->from, line->to},
                           open, import->item);
}

static sl_status add_line(doom_import *import, const sli_doom_line *line) {
    line_account *lines = &import->lines;
    if (line->from.x == line->to.x && line->from.y == line->to.y) {
        lines->zero_length++;
        return SL_OK;
    }
    if (line->right == SLI_NO_SECTOR && line->left == SLI_NO_SECTOR) {
        lines->without_sides++;
        return SL_OK;
    }
    if (line->moves) {
        lines->moves++;
        return SL_OK;
    }
    if (line->right != SLI_NO_SECTOR && line->left != SLI_NO_SECTOR) {
        lines->seen_through++;
        if (import->seams && line->right != line->left)
            SL_TRY(sl_map_add_seam(import->context, import->map, (sl_segment){line->from, line->to},
                                   import->item));
        return import->is_door ? add_door(import, line) : SL_OK;
    }
    lines->walls++;
    SL_TRY(sl_map_add_wall(import->context, import->map, line->from, line->to, import->item));
    const uint32_t ground = SL_OPEN_RIGHT | SL_SOLID_LEFT; // the front is open, behind it is void
    import->map->walls[import->map->wall_count - 1].ground =
        line->right != SLI_NO_SECTOR ? ground : sl_ground_turned(ground);
    import->map->ground_guessed = true;
    return SL_OK;
}

/// The starts of one kind: all of them, or the last, where the game puts the player.
static sl_status add_starts_of(doom_import *import, int kind, bool all) {
    const sli_doom_level *level = import->level;
    const sl_start *last = NULL;
    for (size_t i = 0; i < level->start_count; i++) {
        if (level->starts[i].kind != kind) continue;
        if (all && last)
            SL_TRY(sl_map_add_start(import->context, import->map, last->at, last->heading,
                                    last->line));
        last = &level->starts[i].start;
    }
    if (!last) return SL_OK;
    return sl_map_add_start(import->context, import->map, last->at, last->heading, last->line);
}

/// The starts of the players; those of a deathmatch where there are none.
static sl_status add_starts(doom_import *import) {
    for (int player = 1; player <= SLI_DOOM_PLAYERS; player++)
        SL_TRY(add_starts_of(import, player, false));
    if (!import->map->start_count) SL_TRY(add_starts_of(import, SLI_DOOM_DEATHMATCH, true));
    return SL_OK;
}

static void tell_starts(const doom_import *import, const char *name) {
    const size_t all = import->map->start_count;
    const char *plural = all == 1 ? "" : "s";
    bool players = false;
    for (size_t i = 0; i < import->level->start_count; i++)
        players |= import->level->starts[i].kind <= SLI_DOOM_PLAYERS;
    if (!all)
        sl_note(import->context, "%s: map %s: no player has a start", name, import->level->name);
    else if (players)
        sl_note(import->context, "%s: map %s: players start at %zu place%s", name,
                import->level->name, all, plural);
    else
        sl_note(import->context,
                "%s: map %s: no player has a start; the %zu start%s of a deathmatch %s taken", name,
                import->level->name, all, plural, all == 1 ? "is" : "are");
}

static void tell(const doom_import *import, const char *name) {
    const sli_doom_level *level = import->level;
    const line_account *lines = &import->lines;
    char doors[64] = "";
    if (import->is_door)
        snprintf(doors, sizeof doors, " (%zu of them doors, %zu shut)", lines->doors, lines->shut);
    sl_note(import->context,
            "%s: map %s (%s): of %zu lines %zu with one side are walls, %zu with two are seen "
            "through%s",
            name, level->name, level->format, level->line_count, lines->walls, lines->seen_through,
            doors);
}

/// How many lines are portals: what is seen through them stands elsewhere on the map.
static size_t count_portals(const sli_doom_level *level) {
    enum { SECTOR_PORTAL = 57, LINE_PORTAL = 156, QUICK_PORTAL = 301 };
    size_t count = 0;
    for (size_t i = 0; i < level->line_count && level->hexen_specials; i++) {
        const int special = level->lines[i].special;
        count += special == SECTOR_PORTAL || special == LINE_PORTAL || special == QUICK_PORTAL;
    }
    return count;
}

/// Notes of what few maps have.
static void tell_unusual(const doom_import *import, const char *name) {
    const line_account *lines = &import->lines;
    const char *what[] = {"of zero length", "without sides",
                          "of polyobjects, which the game moves"};
    const size_t counts[] = {lines->zero_length, lines->without_sides, lines->moves};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (counts[i])
            sl_note(import->context, "%s: map %s: left out: %zu line%s %s", name,
                    import->level->name, counts[i], counts[i] == 1 ? "" : "s", what[i]);
    const size_t portals = count_portals(import->level);
    if (portals)
        sl_note(
            import->context,
            "%s: map %s: %zu line%s of portals: portals are not followed; a REJECT may hide what "
            "they show",
            name, import->level->name, portals, portals == 1 ? "" : "s");
}

/// How many doors are seen through, as nobody asked for doors. A REJECT, which wants sectors, has
/// no use for them.
static void tell_doors_left_out(sl_context *context, const char *name, const sli_doom_level *level,
                                bool sectors, const bool *is_door) {
    size_t doors = 0;
    for (size_t i = 0; i < level->sector_count; i++) doors += is_door[i];
    if (doors)
        sl_note(context, "%s: map %s: %zu %s and seen through, shut ones too%s", name, level->name,
                doors, doors == 1 ? "sector is a door" : "sectors are doors",
                sectors ? "" : "; --doors takes them as doors");
}

/// "linedef 117", and its line in a TEXTMAP.
static sl_status name_line(doom_import *import, const sli_doom_line *line) {
    char label[SL_LINE_TEXT];
    snprintf(label, sizeof label, "linedef %u", (unsigned)import->item - 1);
    const size_t used = strlen(label);
    if (line->line)
        snprintf(label + used, sizeof label - used, ", TEXTMAP line %u", (unsigned)line->line);
    return sli_map_add_label(import->context, import->map, import->item, label);
}

static sl_status add_lines(doom_import *import) {
    import->map->source.lines_are_items = true;
    for (size_t i = 0; i < import->level->line_count; i++) {
        import->item = (uint32_t)i + 1;
        SL_TRY(name_line(import, &import->level->lines[i]));
        SL_TRY(add_line(import, &import->level->lines[i]));
    }
    return SL_OK;
}

sl_status sli_doom_make_map(sl_context *context, const sli_wad *wad, const sli_wad_map *chosen,
                            const sli_doom_level *level, const sl_import_options *options,
                            bool brief, sl_map *map) {
    const char *name = wad->name;
    bool *is_door = sl_alloc_array(context, level->sector_count, sizeof *is_door);
    if (!is_door) return SL_NO_MEMORY;
    sli_doom_find_doors(level, is_door);
    doom_import import = {.context = context,
                          .level = level,
                          .is_door = options->doors ? is_door : NULL,
                          .seams = options->sectors,
                          .map = map};
    sl_status status = add_lines(&import);
    if (status == SL_OK && options->cells) status = doom_add_cells(context, wad, chosen, map);
    if (status == SL_OK) status = add_starts(&import);
    if (status == SL_OK && !brief) {
        tell(&import, name);
        tell_starts(&import, name);
        if (!options->doors) tell_doors_left_out(context, name, level, options->sectors, is_door);
    }
    if (status == SL_OK) status = sli_doom_settle_starts(context, level, name, brief, map);
    if (status == SL_OK) tell_unusual(&import, name);
    sl_free(context, is_door);
    // The map's lines are numbers of linedefs: a start is none of them.
    for (size_t i = 0; i < map->start_count; i++) map->starts[i].line = 0;
    return status;
}

sl_status sli_map_read_wad(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    sli_wad wad;
    sli_wad_map chosen;
    sli_doom_level level = {0};
    sl_map read = {0};
    SL_TRY(sli_wad_open(context, name, text, size, &wad));
    SL_TRY(sli_wad_find_map(context, &wad, options->map, &chosen));
    SL_TRY(sli_doom_read(context, &wad, &chosen, &level));
    const sl_status status =
        sli_doom_make_map(context, &wad, &chosen, &level, options, false, &read);
    sli_doom_level_destroy(context, &level);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

sl_status sli_map_list_wad(sl_context *context, const char *name, const char *text, size_t size,
                           sl_map_list *list) {
    sli_wad wad;
    sli_wad_map map;
    SL_TRY(sli_wad_open(context, name, text, size, &wad));
    for (uint32_t at = 0; sli_wad_next_map(&wad, &at, &map);) {
        bool known = false;
        for (size_t i = 0; i < list->count && !known; i++)
            known = strcmp(list->names[i], map.name) == 0;
        if (!known) SL_TRY(sl_map_list_add(context, list, map.name, strlen(map.name)));
    }
    return SL_OK;
}
