/// Lines that the query must know beside the walls of the mesh:
///
///     one-way glass    a seam of the space, and glass of the query's map
///     limited walls    likewise
///     mirrors          walls of the space, and mirrors of the map
///
/// Seam i of the space is line i. A mirror is one of the map's as long as the pieces that other
/// walls cut it into lie on its line exactly. Where rounding has bent them, each is a mirror.
#include "world/world.h"

#include "geometry/orient.h"

#include <string.h>

static bool is_there(const sli_world_line *line) {
    return line->there || line->next_there;
}

/// Room for seams by line.
static sl_status grow_seams(sl_world *s) {
    sl_space *space = &s->live.space;
    size_t room = space->seam_count;
    if (s->lines.count <= room) return SL_OK;
    SL_TRY(sl_reserve(s->context, &space->seams, &room, s->lines.count, sizeof *space->seams));
    memset(space->seams + space->seam_count, 0, (room - space->seam_count) * sizeof *space->seams);
    space->seam_count = (uint32_t)room;
    return SL_OK;
}

sl_status sli_world_prepare_special(sl_world *s) {
    sl_map *map = &s->map;
    size_t seams = 0, pieces = s->corners.count;
    for (size_t i = 0; i < s->special.count; i++) {
        const sli_world_line *line = &s->lines.items[s->special.items[i]];
        if (!is_there(line)) continue;
        seams += sli_world_is_seam(line);
        if (line->kind == SL_WORLD_MIRROR) pieces += line->count;
    }
    s->has_seams = seams > 0;
    if (!s->special.count) return SL_OK;
    if (seams) SL_TRY(grow_seams(s));
    SL_TRY(sl_reserve(s->context, &map->oneways, &map->oneway_room, seams, sizeof *map->oneways));
    SL_TRY(sl_reserve(s->context, &map->seams, &map->seam_room, seams, sizeof *map->seams));
    SL_TRY(sl_reserve(s->context, &map->mirrors, &map->mirror_room, pieces, sizeof *map->mirrors));
    const size_t known = s->mirror_walls.count;
    return SL_ARRAY_ROOM(s->context, &s->mirror_walls, pieces > known ? pieces - known : 0);
}

static void add_mirror(sl_world *s, uint32_t number, sl_segment at) {
    const sli_world_line *line = &s->lines.items[number];
    s->mirror_walls.items[s->map.mirror_count] = number;
    s->map.mirrors[s->map.mirror_count++] =
        (sl_glass){.segment = at, .line = line->file_line, .one_sided = line->one_sided};
}

static void add_mirrors(sl_world *s, uint32_t number) {
    const sli_world_line *line = &s->lines.items[number];
    const sl_point *points = s->live.triangles.points.items;
    const uint32_t *chain = s->points + line->first;
    bool straight = true;
    for (uint32_t i = 1; i + 1 < line->count && straight; i++)
        straight = sli_orient(line->at.a, line->at.b, points[chain[i]]) == 0;
    if (straight) add_mirror(s, number, line->at);
    for (uint32_t i = 0; i + 1 < line->count && !straight; i++)
        add_mirror(s, number, (sl_segment){points[chain[i]], points[chain[i + 1]]});
}

static void add_seam(sl_world *s, uint32_t number) {
    const sli_world_line *line = &s->lines.items[number];
    sl_map *map = &s->map;
    const bool glass = line->kind == SL_WORLD_ONEWAY;
    const size_t at = glass ? map->oneway_count++ : map->seam_count++;
    s->live.space.seams[number] =
        (sl_seam){line->at, glass ? SL_SEAM_ONEWAY : SL_SEAM_LIMITED, (uint32_t)at};
    *(glass ? &map->oneways[at] : &map->seams[at]) =
        (sl_glass){.segment = line->at, .line = line->file_line, .stops = glass ? 0 : line->stops};
}

void sli_world_follow_special(sl_world *s) {
    size_t kept = 0;
    s->map.oneway_count = s->map.seam_count = s->map.mirror_count = 0;
    s->rows.limits = false;
    for (size_t i = 0; i < s->special.count; i++) {
        const uint32_t number = s->special.items[i];
        sli_world_line *line = &s->lines.items[number];
        if (number < s->live.space.seam_count) s->live.space.seams[number] = (sl_seam){0};
        line->listed = line->there && sli_world_is_special(line);
        if (!line->listed) continue;
        s->special.items[kept++] = number;
        s->rows.limits |= line->stops & SL_STOPS_LIMITED;
        if (line->kind == SL_WORLD_MIRROR)
            add_mirrors(s, number);
        else
            add_seam(s, number);
    }
    s->special.count = kept;
    s->mirror_walls.count = s->map.mirror_count;
}

uint32_t sl_world_mirror_wall(const sl_world *world, uint32_t mirror) {
    return mirror < world->mirror_walls.count ? world->mirror_walls.items[mirror] : UINT32_MAX;
}
