/// Worlds: the edits that wait, and the commit that makes them or leaves all as it was.
///
///     sl_world_commit
///       sli_world_involve     which walls have to do with it, and how they are cut (involved.c)
///       sli_world_edit        the triangulation, with a journal (edit.c)
///       sli_live_plan         the new cells (live.c)
///     then, if nothing failed
///       sli_live_apply        the space (live_space.c)
#include "world/world.h"

#include "geometry/orient.h"
#include "sight/query.h"
#include "sightline/effects.h"

#include <math.h>
#include <string.h>

static void use_context(sl_world *s, sl_context *context) {
    s->context = s->live.context = s->live.maker.context = context;
}

sl_world_options sl_world_options_default(void) {
    return (sl_world_options){0};
}

void sl_world_destroy(sl_context *context, sl_world *s) {
    if (!s) return;
    sl_query_destroy(context, s->query);
    sli_world_rows_destroy(context, &s->rows);
    sli_live_destroy(context, &s->live);
    sl_map_destroy(context, &s->map);
    void *const blocks[] = {s->lines.items,    s->pending.items,      s->points,
                            s->uses.items,     s->fresh.items,        s->stale.items,
                            s->involved.items, s->segments.items,     s->corners.items,
                            s->chain.items,    s->first_corner.items, s->doubtful.items,
                            s->wanted,         s->flood.items,        s->opened.items};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) sl_free(context, blocks[i]);
    sl_free(context, s);
}

// --- making one

static bool is_within(const sl_box *box, sl_point p) {
    return p.x > box->min.x && p.x < box->max.x && p.y > box->min.y && p.y < box->max.y;
}

static sl_status refuse(sl_context *context, const sl_map *map) {
    bool marked = false;
    for (size_t i = 0; i < map->wall_count; i++) marked |= map->walls[i].ground != 0;
    const char *what = map->door_count     ? "doors"
                       : map->mirror_count ? "mirrors"
                       : map->oneway_count ? "one-way glass"
                       : map->seam_count   ? "seams"
                       : map->cell_count   ? "cells of its own"
                       : marked            ? "solid ground"
                                           : NULL;
    if (!what) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED, "a world does not know %s yet: leave them out", what);
}

/// The bounds by the map: an eighth more on each side.
static sl_box bounds_of(const sl_map *map) {
    sl_box b = sl_map_bounds(map);
    double more = fmax(b.max.x - b.min.x, b.max.y - b.min.y) / 8;
    if (!(more > 0)) more = fmax(1, fmax(fabs(b.min.x), fabs(b.min.y)) / 8);
    b.min = (sl_point){b.min.x - more, b.min.y - more};
    b.max = (sl_point){b.max.x + more, b.max.y + more};
    return b;
}

static sl_status take_walls(sl_world *s, const sl_map *map, const sl_box *bounds) {
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->lines, map->wall_count));
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *w = &map->walls[i];
        char line[SL_LINE_TEXT];
        sl_map_say_line(map, w->line, line);
        if (!is_within(bounds, w->a) || !is_within(bounds, w->b))
            return sl_fail(s->context, SL_BAD_INPUT,
                           "wall %zu (%s) is not within the bounds of the world", i, line);
        if (sli_same_point(w->a, w->b))
            return sl_fail(s->context, SL_BAD_INPUT,
                           "wall %zu (%s) has no length: clean the map first", i, line);
        s->lines.items[s->lines.count++] = (sli_world_line){.at = {w->a, w->b},
                                                            .next_at = {w->a, w->b},
                                                            .stands = true,
                                                            .next_stands = true,
                                                            .file_line = w->line};
    }
    return SL_OK;
}

/// Notes a line on an edge of the graph. Use e is the first one of edge e.
static sl_status add_use(sl_world *s, uint32_t edge, uint32_t line, uint32_t from) {
    sli_world_use *use = &s->uses.items[edge];
    if (use->line != UINT32_MAX) {
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->uses, 1));
        use = &s->uses.items[edge];
        s->uses.items[s->uses.count++] = *use;
        use->next = (uint32_t)s->uses.count;
    }
    use->line = line;
    use->from = from;
    return SL_OK;
}

/// Makes the chains of all lines, and the uses of all edges.
static sl_status take_graph(sl_world *s, const sli_planar *g) {
    size_t room = 0;
    for (size_t i = 0; i < s->lines.count; i++)
        room += sli_block_size((uint32_t)(g->first[i + 1] - g->first[i] + 1));
    if (room > INT32_MAX) return sl_fail_memory(s->context);
    SL_TRY(sl_reserve(s->context, &s->points, &s->point_room, room, sizeof *s->points));
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->uses, g->edge_count));
    for (; s->uses.count < g->edge_count; s->uses.count++)
        s->uses.items[s->uses.count] = (sli_world_use){.line = UINT32_MAX};
    for (uint32_t i = 0; i < s->lines.count; i++) {
        sli_world_line *line = &s->lines.items[i];
        line->count = (uint32_t)(g->first[i + 1] - g->first[i] + 1);
        line->first = sli_block_take(&s->point_blocks, s->points, line->count);
        uint32_t *to = s->points + line->first;
        for (size_t k = g->first[i]; k < g->first[i + 1]; k++) {
            const sli_planar_edge *e = &g->edges[g->links[k] / 2];
            *to++ = g->links[k] % 2 ? e->b : e->a;
            *to = g->links[k] % 2 ? e->a : e->b;
            SL_TRY(add_use(s, g->links[k] / 2, i, to[-1]));
        }
    }
    return SL_OK;
}

static sl_status make_mesh(sl_world *s, const sl_map *map, const sl_box *bounds) {
    sli_planar graph = {0};
    sl_segment *segments = sl_alloc_array(s->context, map->wall_count, sizeof *segments);
    if (!segments) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->wall_count; i++) segments[i] = s->lines.items[i].at;
    sl_status status =
        sli_planar_make(s->context, "the world", segments, map->wall_count, 0, &graph);
    sl_free(s->context, segments);
    if (status == SL_OK) status = take_graph(s, &graph);
    if (status == SL_OK)
        status = sli_live_create(s->context, &graph, bounds, sli_world_edge, s, &s->live);
    sli_planar_destroy(s->context, &graph);
    return status;
}

static sl_status start(sl_world *s, const sl_map *map, const sl_box *bounds, sl_sight sight) {
    const sl_visibility *visibility = s->mode == SL_WORLD_NO_ROWS ? NULL : &s->rows.visibility;
    SL_TRY(take_walls(s, map, bounds));
    SL_TRY(make_mesh(s, map, bounds));
    if (visibility) SL_TRY(sli_world_rows_start(s->context, &s->live, sight, &s->rows));
    s->rows.visibility.sight = sight;
    SL_TRY(sl_query_over(s->context, &s->live.space, &s->map, visibility, &s->query));
    SL_TRY(sl_query_set_range(s->context, s->query, map->range));
    sli_query_space_changed(s->context, s->query, &s->live.outline);
    s->live.outline.space = &s->live.space;
    return SL_OK;
}

sl_status sl_world_create(sl_context *context, const sl_map *map, const sl_world_options *options,
                          sl_world **out) {
    const sl_world_options how = options ? *options : sl_world_options_default();
    const sl_box b = how.bounds;
    const sl_box bounds = b.max.x > b.min.x && b.max.y > b.min.y ? b : bounds_of(map);
    SL_TRY(refuse(context, map));
    if (map->wall_count > INT32_MAX / 2) return sl_fail_memory(context);
    sl_world *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    use_context(s, context);
    s->mode = how.rows;
    const sl_status status = start(s, map, &bounds, how.sight);
    if (status == SL_OK)
        *out = s;
    else
        sl_world_destroy(context, s);
    return status;
}

sl_query *sl_world_query(sl_world *world) {
    return world->query;
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
    if (wall < s->lines.count && s->lines.items[wall].next_stands) return SL_OK;
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

sl_status sl_world_add_wall(sl_context *context, sl_world *s, sl_segment at, uint32_t *wall) {
    SL_TRY(check_segment(context, s, &at));
    if (!s->free_line) {
        if (s->lines.count >= INT32_MAX / 2) return sl_fail_memory(context);
        SL_TRY(SL_ARRAY_ROOM(context, &s->lines, 1));
        s->lines.items[s->lines.count] = (sli_world_line){0};
        s->free_line = (uint32_t)++s->lines.count;
    }
    const uint32_t number = s->free_line - 1;
    SL_TRY(note_edit(context, s, number));
    sli_world_line *line = &s->lines.items[number];
    s->free_line = line->next_free;
    line->file_line = line->ground = 0;
    line->next_at = at;
    line->next_stands = true;
    *wall = number;
    return SL_OK;
}

sl_status sl_world_remove(sl_context *context, sl_world *s, uint32_t wall) {
    SL_TRY(check_number(context, s, wall));
    SL_TRY(note_edit(context, s, wall));
    s->lines.items[wall].next_stands = false;
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
static void end_edits(sl_world *s) {
    for (size_t i = 0; i < s->pending.count; i++) {
        sli_world_line *line = &s->lines.items[s->pending.items[i]];
        line->pending = false;
        line->next_at = line->at;
        line->next_stands = line->stands;
        if (line->stands) continue;
        line->next_free = s->free_line;
        s->free_line = s->pending.items[i] + 1;
    }
    s->pending.count = 0;
}

void sl_world_discard(sl_world *world) {
    end_edits(world);
}

/// Whether the edit takes walls away and does nothing else, and rows are exact and stay so.
static bool reveals(const sl_world *s) {
    return s->only_opens && s->rows.kept && s->mode == SL_WORLD_ROWS_NOW &&
           s->rows.visibility.guarantee == SL_EXACT;
}

static sl_status prepare(sl_world *s) {
    SL_TRY(sli_world_edit(s));
    SL_TRY(sli_live_plan(&s->live));
    SL_TRY(sli_world_rows_plan(s->context, &s->live, &s->rows));
    return reveals(s) ? sli_world_rows_note_lines(s->context, &s->live, &s->rows) : SL_OK;
}

/// Whether some edit takes a wall away from where it is.
static bool opens(const sl_world *s) {
    for (size_t i = 0; i < s->pending.count; i++)
        if (s->lines.items[s->pending.items[i]].stands) return true;
    return false;
}

/// Makes the visible sets that the caller chose. Where memory is lacking there are none.
static void follow_rows(sl_world *s, bool opened) {
    sli_world_rows *r = &s->rows;
    sl_status status;
    if (!r->kept) return;
    sli_world_rows_apply(&s->live, r);
    if (reveals(s)) {
        status = sli_world_rows_reveal(s->context, &s->live, r, s->opened.items, s->opened.count);
    } else {
        sli_world_rows_doubt(r);
        status = s->mode == SL_WORLD_ROWS_NOW
                     ? sli_world_rows_settle(s->context, &s->live, r, HUGE_VAL)
                     : sli_world_rows_loosen(s->context, &s->live, r, opened);
    }
    if (status != SL_OK) sli_world_rows_lose(&s->live, r);
}

static sl_status commit(sl_world *s) {
    SL_TRY(sli_world_involve(s));
    SL_TRY(sli_world_find_opened(s));
    sli_triangulator_begin(&s->live.maker);
    const sl_status status = prepare(s);
    if (status != SL_OK) {
        sli_live_undo(&s->live);
        sli_world_drop_uses(s);
        return status;
    }
    sli_live_apply(&s->live);
    sli_world_settle_chains(s);
    follow_rows(s, opens(s));
    for (size_t i = 0; i < s->pending.count; i++) {
        sli_world_line *line = &s->lines.items[s->pending.items[i]];
        line->at = line->next_at;
        line->stands = line->next_stands;
    }
    sli_query_space_changed(s->context, s->query, &s->live.outline);
    return SL_OK;
}

sl_status sl_world_commit(sl_context *context, sl_world *s, sl_world_changes *changes) {
    use_context(s, context);
    s->live.gone.count = s->live.came.count = s->rows.changed.count = 0;
    const sl_status status = s->pending.count ? commit(s) : SL_OK;
    end_edits(s);
    if (changes)
        *changes =
            (sl_world_changes){s->live.gone.items, s->live.came.items,    s->live.gone.count,
                               s->live.came.count, s->rows.changed.items, s->rows.changed.count};
    return status;
}

sl_status sl_world_settle(sl_context *context, sl_world *world, double milliseconds, size_t *left) {
    use_context(world, context);
    const sl_status status =
        sli_world_rows_settle(context, &world->live, &world->rows, milliseconds / 1000);
    sli_query_space_changed(context, world->query, &world->live.outline);
    if (left) *left = world->rows.unsettled.count;
    return status;
}

const sl_visibility *sl_world_visibility(const sl_world *world) {
    return &world->rows.visibility;
}

// --- what there is

uint32_t sl_world_wall_count(const sl_world *world) {
    return (uint32_t)world->lines.count;
}

bool sl_world_wall(const sl_world *world, uint32_t wall, sl_segment *at) {
    if (wall >= world->lines.count || !world->lines.items[wall].stands) return false;
    *at = world->lines.items[wall].at;
    return true;
}

uint32_t sl_world_cell_count(const sl_world *world) {
    return world->live.live_count;
}

sl_status sl_world_copy_map(sl_context *context, const sl_world *world, uint32_t *numbers,
                            sl_map *out) {
    sl_map map = {.range = world->map.range};
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < world->lines.count && status == SL_OK; i++) {
        const sli_world_line *line = &world->lines.items[i];
        if (numbers) numbers[i] = line->stands ? (uint32_t)map.wall_count : UINT32_MAX;
        if (line->stands)
            status = sl_map_add_wall(context, &map, line->at.a, line->at.b, line->file_line);
    }
    if (status == SL_OK)
        *out = map;
    else
        sl_map_destroy(context, &map);
    return status;
}

sl_status sl_world_copy_space(sl_context *context, const sl_world *world, uint32_t *numbers,
                              sl_space *out) {
    return sli_live_pack(context, &world->live, numbers, out);
}
