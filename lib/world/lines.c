/// The walls of a world as they are given: taken from a map, edited, and copied to a map. Edits
/// wait for the commit.
#include "world/world.h"

#include "geometry/orient.h"
#include "map/source.h"

#include <string.h>

static bool is_within(const sl_box *box, sl_point p) {
    return p.x > box->min.x && p.x < box->max.x && p.y > box->min.y && p.y < box->max.y;
}

/// Whether a line will be in the mesh.
static bool stands(const sli_world_line *line) {
    return line->next_there && !(line->kind == SL_WORLD_DOOR && line->next_open) &&
           line->stops & (SL_STOPS_SIGHT | SL_STOPS_LIMITED);
}

/// Lists a line if the query must know of it. There is room.
static void list(sl_world *s, uint32_t number) {
    sli_world_line *line = &s->lines.items[number];
    if (line->listed || !sli_world_is_special(line)) return;
    s->special.items[s->special.count++] = number;
    line->listed = true;
}

// --- from a map

/// Takes a wall of a map, of any kind.
static sl_status take_line(sl_world *s, const sl_map *map, const sl_box *bounds,
                           sli_world_line line) {
    char text[SL_LINE_TEXT];
    const char *const kinds[] = {"wall", "door", "one-way glass", "seam", "mirror"};
    sl_map_say_line(map, line.file_line, text);
    if (!is_within(bounds, line.at.a) || !is_within(bounds, line.at.b))
        return sl_fail(s->context, SL_BAD_INPUT,
                       "%s %zu (%s) is not within the bounds of the world", kinds[line.kind],
                       s->lines.count, text);
    if (sli_same_point(line.at.a, line.at.b))
        return sl_fail(s->context, SL_BAD_INPUT, "%s %zu (%s) has no length: clean the map first",
                       kinds[line.kind], s->lines.count, text);
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->lines, 1));
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->special, 1));
    line.there = line.next_there = true;
    line.next_at = line.at;
    line.next_open = line.open;
    line.stands = line.next_stands = stands(&line);
    s->lines.items[s->lines.count++] = line;
    list(s, (uint32_t)s->lines.count - 1);
    return SL_OK;
}

sl_status sli_world_take(sl_world *s, const sl_map *map, const sl_box *bounds) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *w = &map->walls[i];
        SL_TRY(take_line(s, map, bounds,
                         (sli_world_line){.at = {w->a, w->b},
                                          .stops = SL_STOPS_ALL,
                                          .file_line = w->line,
                                          .ground = w->ground}));
    }
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_door *d = &map->doors[i];
        SL_TRY(take_line(s, map, bounds,
                         (sli_world_line){.at = d->segment,
                                          .kind = SL_WORLD_DOOR,
                                          .stops = SL_STOPS_ALL,
                                          .open = d->open,
                                          .file_line = d->line}));
        s->lines.items[s->lines.count - 1].name =
            sl_copy_text(s->context, d->name, strlen(d->name));
        if (!s->lines.items[s->lines.count - 1].name) return SL_NO_MEMORY;
    }
    for (size_t i = 0; i < map->oneway_count; i++)
        SL_TRY(take_line(s, map, bounds,
                         (sli_world_line){.at = map->oneways[i].segment,
                                          .kind = SL_WORLD_ONEWAY,
                                          .stops = SL_STOPS_ALL,
                                          .file_line = map->oneways[i].line}));
    for (size_t i = 0; i < map->seam_count; i++)
        SL_TRY(take_line(s, map, bounds,
                         (sli_world_line){.at = map->seams[i].segment,
                                          .kind = SL_WORLD_SEAM,
                                          .stops = map->seams[i].stops,
                                          .file_line = map->seams[i].line,
                                          .ground = map->seams[i].ground}));
    for (size_t i = 0; i < map->mirror_count; i++)
        SL_TRY(take_line(s, map, bounds,
                         (sli_world_line){.at = map->mirrors[i].segment,
                                          .kind = SL_WORLD_MIRROR,
                                          .stops = SL_STOPS_ALL,
                                          .one_sided = map->mirrors[i].one_sided,
                                          .file_line = map->mirrors[i].line}));
    return SL_OK;
}

// --- edits

static sl_status check_segment(sl_context *context, const sl_world *s, sl_segment *at) {
    at->a = sli_coordinates(at->a);
    at->b = sli_coordinates(at->b);
    if (!is_within(&s->live.space.bounds, at->a) || !is_within(&s->live.space.bounds, at->b))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the wall from %.17g %.17g to %.17g %.17g is not within the bounds of the "
                       "world",
                       at->a.x, at->a.y, at->b.x, at->b.y);
    if (sli_same_point(at->a, at->b))
        return sl_fail(context, SL_BAD_ARGUMENT, "the wall at %.17g %.17g has no length", at->a.x,
                       at->a.y);
    return SL_OK;
}

static sl_status check_number(sl_context *context, const sl_world *s, uint32_t wall) {
    if (wall < s->lines.count && s->lines.items[wall].next_there) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "there is no wall %u", wall);
}

/// Notes that a line has edits.
static sl_status note_edit(sl_context *context, sl_world *s, uint32_t number) {
    if (s->lines.items[number].pending) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &s->pending, 1));
    s->pending.items[s->pending.count++] = number;
    s->lines.items[number].pending = true;
    return SL_OK;
}

static sl_status add_line(sl_context *context, sl_world *s, sl_segment at, sl_world_kind kind,
                          uint32_t stops, uint32_t *wall) {
    SL_TRY(check_segment(context, s, &at));
    if (!s->free_line) {
        if (s->lines.count >= INT32_MAX / 2) return sl_fail_memory(context);
        SL_TRY(SL_ARRAY_ROOM(context, &s->lines, 1));
        s->lines.items[s->lines.count] = (sli_world_line){0};
        s->free_line = (uint32_t)++s->lines.count;
    }
    const uint32_t number = s->free_line - 1;
    SL_TRY(SL_ARRAY_ROOM(context, &s->special, 1));
    SL_TRY(note_edit(context, s, number));
    sli_world_line *line = &s->lines.items[number];
    s->free_line = line->next_free;
    sl_free(context, line->name);
    line->name = NULL;
    line->one_sided = false;
    line->kind = (uint8_t)kind;
    line->stops = (uint8_t)stops;
    line->file_line = line->ground = 0;
    line->next_at = at;
    line->next_there = true;
    line->next_open = false;
    line->next_stands = stands(line);
    list(s, number);
    *wall = number;
    return SL_OK;
}

sl_status sl_world_add_wall(sl_context *context, sl_world *s, sl_segment at, uint32_t *wall) {
    return add_line(context, s, at, SL_WORLD_WALL, SL_STOPS_ALL, wall);
}

sl_status sl_world_add_oneway(sl_context *context, sl_world *s, sl_segment at, uint32_t *wall) {
    return add_line(context, s, at, SL_WORLD_ONEWAY, SL_STOPS_ALL, wall);
}

sl_status sl_world_add_mirror(sl_context *context, sl_world *s, sl_segment at, bool one_sided,
                              uint32_t *wall) {
    SL_TRY(add_line(context, s, at, SL_WORLD_MIRROR, SL_STOPS_ALL, wall));
    s->lines.items[*wall].one_sided = one_sided;
    return SL_OK;
}

sl_status sl_world_add_partial(sl_context *context, sl_world *s, sl_segment at, uint32_t stops,
                               uint32_t *wall) {
    if (stops & ~(uint32_t)(SL_STOPS_ALL | SL_STOPS_LIMITED))
        return sl_fail(context, SL_BAD_ARGUMENT, "a wall stops sight, steps, sound or several");
    if (stops & SL_STOPS_LIMITED && stops & SL_STOPS_SIGHT)
        return sl_fail(context, SL_BAD_ARGUMENT, "a wall stops sight, or limits it");
    return add_line(context, s, at, stops == SL_STOPS_ALL ? SL_WORLD_WALL : SL_WORLD_SEAM, stops,
                    wall);
}

sl_status sl_world_add_door(sl_context *context, sl_world *s, const char *name, sl_segment at,
                            bool open, uint32_t *wall) {
    char *copy = sl_copy_text(context, name, strlen(name));
    if (!copy) return SL_NO_MEMORY;
    const sl_status status = add_line(context, s, at, SL_WORLD_DOOR, SL_STOPS_ALL, wall);
    if (status != SL_OK) {
        sl_free(context, copy);
        return status;
    }
    sli_world_line *line = &s->lines.items[*wall];
    line->name = copy;
    line->next_open = open;
    line->next_stands = stands(line);
    return SL_OK;
}

sl_status sl_world_set_open(sl_context *context, sl_world *s, uint32_t wall, bool open) {
    SL_TRY(check_number(context, s, wall));
    sli_world_line *line = &s->lines.items[wall];
    if (line->kind != SL_WORLD_DOOR)
        return sl_fail(context, SL_BAD_ARGUMENT, "wall %u is no door", wall);
    SL_TRY(note_edit(context, s, wall));
    line->next_open = open;
    line->next_stands = stands(line);
    return SL_OK;
}

/// Takes an edit back that nothing came of.
static void take_back(sl_world *s, uint32_t wall) {
    sli_world_line *line = &s->lines.items[wall];
    line->next_there = line->next_stands = false;
}

sl_status sl_world_add_solid(sl_context *context, sl_world *s, const sl_point *corners,
                             size_t count, uint32_t *walls) {
    sl_map map = {0};
    sl_status status = sl_map_add_solid(context, &map, corners, count, 0);
    if (status == SL_OK && map.wall_count != count)
        status = sl_fail(context, SL_BAD_ARGUMENT, "solid: a corner repeats the one before");
    size_t made = 0;
    for (; made < map.wall_count && status == SL_OK; made++) {
        const sl_wall *wall = &map.walls[made];
        status = sl_world_add_wall(context, s, (sl_segment){wall->a, wall->b}, &walls[made]);
        if (status != SL_OK) break;
        s->lines.items[walls[made]].ground = wall->ground;
    }
    while (status != SL_OK && made) take_back(s, walls[--made]);
    sl_map_destroy(context, &map);
    return status;
}

sl_status sl_world_remove(sl_context *context, sl_world *s, uint32_t wall) {
    SL_TRY(check_number(context, s, wall));
    SL_TRY(note_edit(context, s, wall));
    s->lines.items[wall].next_there = s->lines.items[wall].next_stands = false;
    return SL_OK;
}

sl_status sl_world_move(sl_context *context, sl_world *s, uint32_t wall, sl_segment at) {
    SL_TRY(check_number(context, s, wall));
    SL_TRY(check_segment(context, s, &at));
    SL_TRY(note_edit(context, s, wall));
    s->lines.items[wall].next_at = at;
    return SL_OK;
}

/// Ends the edits that waited: what will stand is what stands. Numbers without a wall are free.
void sli_world_end_edits(sl_world *s) {
    for (size_t i = 0; i < s->pending.count; i++) {
        sli_world_line *line = &s->lines.items[s->pending.items[i]];
        line->pending = false;
        line->next_at = line->at;
        line->next_there = line->there;
        line->next_open = line->open;
        line->next_stands = line->stands;
        if (line->there) continue;
        line->next_free = s->free_line;
        s->free_line = s->pending.items[i] + 1;
    }
    s->pending.count = 0;
}

void sl_world_discard(sl_world *world) {
    sli_world_end_edits(world);
}

// --- what there is

uint32_t sl_world_wall_count(const sl_world *world) {
    return (uint32_t)world->lines.count;
}

bool sl_world_wall(const sl_world *world, uint32_t wall, sl_segment *at) {
    if (wall >= world->lines.count || !world->lines.items[wall].there) return false;
    *at = world->lines.items[wall].at;
    return true;
}

sl_world_kind sl_world_kind_of(const sl_world *world, uint32_t wall) {
    return wall < world->lines.count ? (sl_world_kind)world->lines.items[wall].kind : SL_WORLD_WALL;
}

bool sl_world_is_open(const sl_world *world, uint32_t wall) {
    return wall < world->lines.count && world->lines.items[wall].there &&
           world->lines.items[wall].open;
}

/// Adds a line to a map; *number: its number among those of its kind.
static sl_status copy_line(sl_context *context, const sli_world_line *line, sl_map *map,
                           size_t *number) {
    if (line->kind == SL_WORLD_DOOR) {
        *number = map->door_count;
        return sl_map_add_door(context, map, line->name, line->at, line->open, line->file_line);
    }
    if (line->kind == SL_WORLD_MIRROR) {
        *number = map->mirror_count;
        SL_TRY(sl_map_add_mirror(context, map, line->at, line->file_line));
        map->mirrors[*number].one_sided = line->one_sided;
        return SL_OK;
    }
    if (line->kind == SL_WORLD_ONEWAY) {
        *number = map->oneway_count;
        return sl_map_add_oneway(context, map, line->at, line->file_line);
    }
    if (line->kind == SL_WORLD_SEAM) {
        *number = map->seam_count;
        SL_TRY(sl_map_add_seam(context, map, line->at, line->file_line));
        map->seams[*number].stops = line->stops;
        map->seams[*number].ground = (uint8_t)line->ground;
        return SL_OK;
    }
    *number = map->wall_count;
    SL_TRY(sl_map_add_wall(context, map, line->at.a, line->at.b, line->file_line));
    map->walls[*number].ground = line->ground;
    return SL_OK;
}

sl_status sl_world_copy_map(sl_context *context, const sl_world *world, uint32_t *numbers,
                            sl_map *out) {
    sl_map map = {.range = world->map.range};
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < world->lines.count && status == SL_OK; i++) {
        const sli_world_line *line = &world->lines.items[i];
        size_t number = UINT32_MAX;
        if (line->there) status = copy_line(context, line, &map, &number);
        if (numbers) numbers[i] = (uint32_t)number;
    }
    if (status == SL_OK)
        *out = map;
    else
        sl_map_destroy(context, &map);
    return status;
}
