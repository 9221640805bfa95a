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
#include "space/kd_tree.h"

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
    for (size_t i = 0; i < s->lines.count; i++) sl_free(context, s->lines.items[i].name);
    sl_free(context, s->live.space.seams);
    sli_world_rows_destroy(context, &s->rows);
    sli_live_destroy(context, &s->live);
    sl_map_destroy(context, &s->map);
    void *const blocks[] = {s->lines.items,    s->pending.items,      s->points,
                            s->uses.items,     s->fresh.items,        s->stale.items,
                            s->involved.items, s->segments.items,     s->corners.items,
                            s->chain.items,    s->first_corner.items, s->doubtful.items,
                            s->wanted,         s->flood.items,        s->opened.items,
                            s->special.items,  s->mirror_walls.items};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) sl_free(context, blocks[i]);
    sl_free(context, s);
}

// --- making one

static sl_status refuse(sl_context *context, const sl_map *map) {
    if (!map->cell_count) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED,
                   "a world cuts its cells itself: leave out those of the map");
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

/// Makes the chains of all lines that stand, and the uses of all edges.
static sl_status take_graph(sl_world *s, const sli_planar *g, size_t count) {
    size_t room = 0;
    for (size_t i = 0; i < count; i++)
        room += sli_block_size((uint32_t)(g->first[i + 1] - g->first[i] + 1));
    if (room > INT32_MAX) return sl_fail_memory(s->context);
    SL_TRY(sl_reserve(s->context, &s->points, &s->point_room, room, sizeof *s->points));
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->uses, g->edge_count));
    for (; s->uses.count < g->edge_count; s->uses.count++)
        s->uses.items[s->uses.count] = (sli_world_use){.line = UINT32_MAX};
    for (uint32_t i = 0, segment = 0; i < s->lines.count; i++) {
        sli_world_line *line = &s->lines.items[i];
        if (!line->stands) continue;
        line->count = (uint32_t)(g->first[segment + 1] - g->first[segment] + 1);
        line->first = sli_block_take(&s->point_blocks, s->points, line->count);
        uint32_t *to = s->points + line->first;
        for (size_t k = g->first[segment]; k < g->first[segment + 1]; k++) {
            const sli_planar_edge *e = &g->edges[g->links[k] / 2];
            *to++ = g->links[k] % 2 ? e->b : e->a;
            *to = g->links[k] % 2 ? e->a : e->b;
            SL_TRY(add_use(s, g->links[k] / 2, i, to[-1]));
        }
        segment++;
    }
    return SL_OK;
}

static sl_status make_mesh(sl_world *s, const sl_box *bounds) {
    sli_planar graph = {0};
    size_t count = 0;
    sl_segment *segments = sl_alloc_array(s->context, s->lines.count, sizeof *segments);
    if (!segments) return SL_NO_MEMORY;
    for (size_t i = 0; i < s->lines.count; i++)
        if (s->lines.items[i].stands) segments[count++] = s->lines.items[i].at;
    sl_status status = sli_planar_make(s->context, "the world", segments, count, 0, &graph);
    sl_free(s->context, segments);
    if (status == SL_OK) status = take_graph(s, &graph, count);
    if (status == SL_OK)
        status = sli_live_create(s->context, &graph, bounds, sli_world_edge, sli_world_seams, s,
                                 &s->live);
    sli_planar_destroy(s->context, &graph);
    return status;
}

static sl_status start(sl_world *s, const sl_map *map, const sl_box *bounds, sl_sight sight) {
    const sl_visibility *visibility = s->mode == SL_WORLD_NO_ROWS ? NULL : &s->rows.visibility;
    SL_TRY(sli_world_take(s, map, bounds));
    SL_TRY(make_mesh(s, bounds));
    SL_TRY(sli_world_prepare_special(s));
    sli_world_follow_special(s);
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
    if (map->wall_count + map->door_count + map->oneway_count + map->seam_count +
            map->mirror_count >
        INT32_MAX / 2)
        return sl_fail_memory(context);
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

// --- commits

/// Whether the edit takes walls away and does nothing else, and rows are exact and stay so.
static bool reveals(const sl_world *s) {
    return s->only_opens && !s->has_seams && s->rows.kept && s->mode == SL_WORLD_ROWS_NOW &&
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
    SL_TRY(sli_world_prepare_special(s));
    sli_triangulator_begin(&s->live.maker);
    const sl_status status = prepare(s);
    if (status != SL_OK) {
        sli_live_undo(&s->live);
        sli_world_drop_uses(s);
        return status;
    }
    sli_live_apply(&s->live);
    sli_world_settle_chains(s);
    const bool opened = opens(s);
    for (size_t i = 0; i < s->pending.count; i++) {
        sli_world_line *line = &s->lines.items[s->pending.items[i]];
        line->at = line->next_at;
        line->there = line->next_there;
        line->open = line->next_open;
        line->stands = line->next_stands;
    }
    sli_world_follow_special(s);
    follow_rows(s, opened); // a copy for rows has the new seams, too
    sli_query_space_changed(s->context, s->query, &s->live.outline);
    return SL_OK;
}

sl_status sl_world_commit(sl_context *context, sl_world *s, sl_world_changes *changes) {
    use_context(s, context);
    s->live.gone.count = s->live.came.count = s->rows.changed.count = 0;
    const sl_status status = s->pending.count ? commit(s) : SL_OK;
    sli_world_end_edits(s);
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

uint32_t sl_world_cell_count(const sl_world *world) {
    return world->live.live_count;
}

sl_status sl_world_copy_space(sl_context *context, const sl_world *world, uint32_t *numbers,
                              sl_space *out) {
    sl_map map = {0};
    sl_space space = {0};
    SL_TRY(sl_world_copy_map(context, world, NULL, &map));
    sl_status status = sl_map_settle_stops(context, &map, NULL);
    if (status == SL_OK) status = sli_live_pack(context, &world->live, numbers, &space);
    if (status == SL_OK) status = sli_mark_inside(context, &map, NULL, &space);
    sl_map_destroy(context, &map);
    if (status == SL_OK)
        *out = space;
    else
        sl_space_destroy(context, &space);
    return status;
}

sl_status sl_world_mark_inside(sl_context *context, sl_world *world) {
    sl_space *live = &world->live.space;
    sl_space space = {0};
    uint32_t *numbers = sl_alloc_array(context, live->cell_count, sizeof *numbers);
    sl_status status = numbers ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sl_world_copy_space(context, world, numbers, &space);
    for (uint32_t c = 0; c < live->cell_count && status == SL_OK; c++) {
        if (numbers[c] == SL_NO_CELL) continue;
        live->cells[c].inside = space.cells[numbers[c]].inside;
        live->cells[c].solid = space.cells[numbers[c]].solid;
    }
    if (status == SL_OK) live->inside_count = space.inside_count;
    sli_query_space_changed(context, world->query, &world->live.outline);
    sl_space_destroy(context, &space);
    sl_free(context, numbers);
    return status;
}
