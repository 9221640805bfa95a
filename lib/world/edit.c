/// Editing the triangulation: the chains of walls become edges with labels, and other edges lose
/// theirs. A label is a list of the walls that an edge is part of.
#include "world/world.h"

#include "geometry/orient.h"
#include "map/ground.h"

#include <string.h>

// --- labels

static sl_status new_use(sl_world *s, sli_world_use use, uint32_t *out) {
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->fresh, 1));
    if (s->free_use) {
        *out = s->free_use;
        s->free_use = s->uses.items[*out - 1].next;
    } else {
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->uses, 1));
        *out = (uint32_t)++s->uses.count;
    }
    s->uses.items[*out - 1] = use;
    s->fresh.items[s->fresh.count++] = *out;
    return SL_OK;
}

/// A list with one more use.
static sl_status label_with(sl_world *s, uint32_t label, uint32_t line, uint32_t from,
                            uint32_t *out) {
    return new_use(s, (sli_world_use){line, from, label}, out);
}

/// A copy of a list, without the uses of a line; 0 for none.
static sl_status label_without(sl_world *s, uint32_t label, uint32_t line, uint32_t *out) {
    *out = 0;
    for (uint32_t at = label; at; at = s->uses.items[at - 1].next) {
        sli_world_use use = s->uses.items[at - 1];
        SL_TRY(sli_numbers_push(s->context, &s->stale, at));
        if (use.line == line) continue;
        use.next = *out;
        SL_TRY(new_use(s, use, out));
    }
    return SL_OK;
}

static void free_uses(sl_world *s, sli_numbers *list) {
    for (size_t i = 0; i < list->count; i++) {
        s->uses.items[list->items[i] - 1].next = s->free_use;
        s->free_use = list->items[i];
    }
    list->count = 0;
}

void sli_world_drop_uses(sl_world *s) {
    free_uses(s, &s->fresh);
    s->stale.count = 0;
}

static bool is_wall(const sl_world *s, uint32_t use) {
    return !sli_world_is_seam(&s->lines.items[s->uses.items[use - 1].line]);
}

bool sli_world_seams(void *world, uint32_t label, uint32_t k, sli_live_seam *out) {
    const sl_world *s = world;
    for (uint32_t at = label; at; at = s->uses.items[at - 1].next) {
        if (is_wall(s, at) || k--) continue;
        const sli_world_use *use = &s->uses.items[at - 1];
        *out = (sli_live_seam){use->line, use->from,
                               s->lines.items[use->line].kind != SL_WORLD_ONEWAY};
        return true;
    }
    return false;
}

sli_live_edge sli_world_edge(void *world, uint32_t label) {
    const sl_world *s = world;
    // The wall of the lowest number says how the edge runs.
    uint32_t first = 0;
    for (uint32_t at = label; at; at = s->uses.items[at - 1].next)
        if (is_wall(s, at) &&
            (!first || s->uses.items[at - 1].line < s->uses.items[first - 1].line))
            first = at;
    if (!first) return (sli_live_edge){0};
    const sli_world_use *use = &s->uses.items[first - 1];
    sli_live_edge edge = {true, use->from, s->lines.items[use->line].file_line, 0};
    for (uint32_t at = label; at; at = s->uses.items[at - 1].next) {
        if (!is_wall(s, at)) continue;
        const uint32_t ground = s->lines.items[s->uses.items[at - 1].line].ground;
        edge.ground = sli_ground_joined(edge.ground, s->uses.items[at - 1].from == use->from
                                                         ? ground
                                                         : sl_ground_turned(ground));
    }
    return edge;
}

// --- chains

/// Whether the chain of a line stays as it is.
static bool stays(const sl_world *s, size_t involved) {
    const sli_world_line *line = &s->lines.items[s->involved.items[involved]];
    const uint32_t first = s->first_corner.items[involved];
    if (line->count != s->first_corner.items[involved + 1] - first) return false;
    for (uint32_t i = 0; i < line->count; i++)
        if (!sli_same_point(s->live.triangles.points.items[s->points[line->first + i]],
                            s->corners.items[first + i]))
            return false;
    return true;
}

static sl_point chain_point(const sl_world *s, const sli_world_line *line, uint32_t i) {
    return s->live.triangles.points.items[s->points[line->first + i]];
}

/// Whether a line is where it was, though it may be cut elsewhere.
static bool keeps_place(const sl_world *s, size_t involved) {
    const sli_world_line *line = &s->lines.items[s->involved.items[involved]];
    const sl_segment at = line->at, next = line->next_at;
    if (!line->stands || !line->next_stands || !sli_same_point(at.a, next.a) ||
        !sli_same_point(at.b, next.b))
        return false;
    if (stays(s, involved)) return true;
    for (uint32_t i = 0; i < line->count; i++)
        if (sli_orient(at.a, at.b, chain_point(s, line, i)) != 0) return false;
    for (uint32_t i = s->first_corner.items[involved]; i < s->first_corner.items[involved + 1]; i++)
        if (sli_orient(at.a, at.b, s->corners.items[i]) != 0) return false;
    return true;
}

sl_status sli_world_find_opened(sl_world *s) {
    s->opened.count = 0;
    s->only_opens = true;
    for (size_t i = 0; i < s->involved.count; i++) {
        const sli_world_line *line = &s->lines.items[s->involved.items[i]];
        if (keeps_place(s, i)) continue;
        s->only_opens &= !line->next_stands;
        for (uint32_t k = 0; k + 1 < line->count; k++) {
            SL_TRY(SL_ARRAY_ROOM(s->context, &s->opened, 1));
            s->opened.items[s->opened.count++] =
                (sl_segment){chain_point(s, line, k), chain_point(s, line, k + 1)};
        }
    }
    return SL_OK;
}

static sl_status set_label(sl_world *s, uint32_t edge, uint32_t label) {
    SL_TRY(sli_triangulator_room(&s->live.maker));
    sli_triangulator_put(&s->live.maker, SLI_WORD_LABEL, edge, label);
    return SL_OK;
}

/// Takes a line off its edges.
static sl_status lift(sl_world *s, uint32_t number) {
    const sli_world_line line = s->lines.items[number];
    const sli_triangulation *t = &s->live.triangles;
    for (uint32_t i = 0; i < line.count; i++) {
        const uint32_t *at = s->points + line.first + i;
        uint32_t label;
        SL_TRY(sli_numbers_push(s->context, &s->doubtful, *at));
        if (i + 1 == line.count) break;
        const uint32_t edge = sli_triangulator_half(t, at[0], at[1]) / 2;
        SL_TRY(label_without(s, t->labels[edge], number, &label));
        SL_TRY(label ? set_label(s, edge, label) : sli_triangulator_unlabel(&s->live.maker, edge));
    }
    return SL_OK;
}

/// The point of the triangulation at a place; it is added where there is none.
static sl_status point_at(sl_world *s, sl_point at, uint32_t *out) {
    sli_triangulator *m = &s->live.maker;
    const sli_half_edge *halves = m->t->halves.items;
    bool on;
    sli_live_go_near(&s->live, at);
    uint32_t half = m->last = sli_triangulator_walk(m, at, &on);
    for (int k = 0; k < 3; k++, half = halves[half].next) {
        *out = halves[half].from;
        if (sli_same_point(m->t->points.items[*out], at)) return SL_OK;
    }
    SL_TRY(sli_triangulator_new_point(m, at, out));
    return sli_triangulator_add_point(m, *out);
}

static sl_status want(sl_world *s, uint32_t point) {
    const size_t old = s->wanted_room;
    SL_TRY(sl_reserve(s->context, &s->wanted, &s->wanted_room, s->live.triangles.points.count,
                      sizeof *s->wanted));
    for (size_t i = old; i < s->wanted_room; i++) s->wanted[i] = 0;
    s->wanted[point] = s->now;
    return SL_OK;
}

/// Whether some wall ends at a point, or leads through it.
static bool is_used(const sl_world *s, uint32_t point) {
    const sli_triangulation *t = &s->live.triangles;
    const uint32_t first = t->out[point];
    uint32_t half = first;
    do {
        if (t->labels[half / 2]) return true;
        half = sli_half_around(t, half);
    } while (half != first);
    return false;
}

static sl_status drop_points(sl_world *s) {
    for (size_t i = 0; i < s->doubtful.count; i++) {
        const uint32_t point = s->doubtful.items[i];
        if (point < s->wanted_room && s->wanted[point] == s->now) continue;
        SL_TRY(want(s, point)); // once is enough
        if (!is_used(s, point)) SL_TRY(sli_triangulator_remove_point(&s->live.maker, point));
    }
    return SL_OK;
}

/// Puts a line on the edges of its new chain.
static sl_status lay(sl_world *s, uint32_t number, const uint32_t *chain, uint32_t count) {
    sli_triangulator *m = &s->live.maker;
    for (uint32_t i = 0; i + 1 < count; i++) {
        const uint32_t half = sli_triangulator_half(m->t, chain[i], chain[i + 1]);
        const uint32_t old = half == SLI_OUTSIDE ? 0 : m->t->labels[half / 2];
        uint32_t label;
        SL_TRY(label_with(s, old, number, chain[i], &label));
        SL_TRY(half == SLI_OUTSIDE ? sli_triangulator_add_edge(m, chain[i], chain[i + 1], label)
                                   : set_label(s, half / 2, label));
    }
    return SL_OK;
}

/// Makes room for the new chains among those of all lines.
static sl_status make_room(sl_world *s) {
    size_t needed = s->point_blocks.used;
    for (size_t i = 0; i < s->involved.count; i++)
        needed += sli_block_size(s->first_corner.items[i + 1] - s->first_corner.items[i]);
    return sl_reserve(s->context, &s->points, &s->point_room, needed, sizeof *s->points);
}

sl_status sli_world_edit(sl_world *s) {
    s->doubtful.count = s->chain.count = 0;
    SL_TRY(make_room(s));
    for (size_t i = 0; i < s->involved.count; i++)
        if (!stays(s, i)) SL_TRY(lift(s, s->involved.items[i]));
    for (size_t i = 0; i < s->corners.count; i++) {
        uint32_t point;
        SL_TRY(point_at(s, s->corners.items[i], &point));
        SL_TRY(sli_numbers_push(s->context, &s->chain, point));
        SL_TRY(want(s, point));
    }
    SL_TRY(drop_points(s));
    for (size_t i = 0; i < s->involved.count; i++) {
        const uint32_t first = s->first_corner.items[i],
                       count = s->first_corner.items[i + 1] - first;
        if (count && !stays(s, i))
            SL_TRY(lay(s, s->involved.items[i], s->chain.items + first, count));
    }
    return SL_OK;
}

void sli_world_settle_chains(sl_world *s) {
    for (size_t i = 0; i < s->involved.count; i++) {
        sli_world_line *line = &s->lines.items[s->involved.items[i]];
        const uint32_t first = s->first_corner.items[i],
                       count = s->first_corner.items[i + 1] - first;
        if (line->count) sli_block_give(&s->point_blocks, s->points, line->first, line->count);
        line->count = count;
        if (!count) continue;
        line->first = sli_block_take(&s->point_blocks, s->points, count);
        memcpy(s->points + line->first, s->chain.items + first, count * sizeof *s->points);
    }
    free_uses(s, &s->stale);
    s->fresh.count = 0;
}
