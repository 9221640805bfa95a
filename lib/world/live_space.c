/// The space of a mesh that lives. Cells have blocks for their corners; a cell that goes leaves its
/// number and its block to others. A number without a cell has no corners.
///
/// Neighbours of a new cell that stay learn its number: their directed portals and the sides of the
/// outline are written in place.
#include "world/live.h"

#include "geometry/orient.h"

#include <stdlib.h>
#include <string.h>

// --- room

/// Grows an array to `room` items.
static sl_status grow(sl_context *context, void *array, size_t old, size_t room, size_t size) {
    size_t capacity = old;
    return sl_reserve(context, array, &capacity, room, size);
}

#define GROW(array, old, room) SL_TRY(grow(l->context, &(array), (old), (room), sizeof *(array)))

static size_t more(size_t needed) {
    return needed + needed / 2;
}

static sl_status grow_cells(sli_live *l, size_t needed) {
    const size_t old = l->cell_room, room = old ? more(needed) : needed;
    sl_space *s = &l->space;
    if (room > INT32_MAX) return sl_fail_memory(l->context);
    GROW(s->cells, old, room);
    GROW(l->outline.first, old ? old + 1 : 0, room + 1);
    GROW(l->outline.first_part, old ? old + 1 : 0, room + 1);
    GROW(l->outline.parts, old, room);
    GROW(l->half_of, old, room);
    GROW(l->dissolved, old, room);
    for (size_t c = room; c-- > old;) {
        s->cells[c] = (sl_cell){0};
        l->outline.first[c] = l->dissolved[c] = 0;
        l->outline.parts[c] = l->outline.first_part[c] = (uint32_t)c;
        l->half_of[c] = l->free_cell;
        l->free_cell = (uint32_t)c + 1;
    }
    l->outline.first_part[room] = (uint32_t)room;
    l->outline.first[room] = 0;
    l->cell_room = room;
    s->cell_count = l->outline.room_count = (uint32_t)room;
    return SL_OK;
}

static sl_status grow_limited(sli_live *l, size_t old, size_t room) {
    GROW(l->outline.limited, old, room);
    for (size_t i = old; i < room; i++) l->outline.limited[i] = SL_NO_SEAM;
    return SL_OK;
}

static sl_status grow_corners(sli_live *l, size_t needed) {
    const size_t old = l->corner_room, room = more(needed);
    sl_space *s = &l->space;
    if (needed <= old) return SL_OK;
    if (room > INT32_MAX) return sl_fail_memory(l->context);
    GROW(s->vertices, old, room);
    GROW(s->neighbour, old, room);
    GROW(s->directed, old, room);
    GROW(l->outline.sides, old, room);
    GROW(l->room_of, old, room);
    for (size_t i = old; i < room; i++) {
        s->vertices[i] = s->bounds.min;
        s->neighbour[i] = SL_NEIGHBOUR_BORDER;
        s->directed[i] = (sl_directed_portal){0};
        l->outline.sides[i] = (sl_side){s->bounds.min, (uint32_t)i, SL_SIDE_BORDER};
        l->room_of[i] = SL_NO_CELL;
    }
    if (l->outline.limited) SL_TRY(grow_limited(l, old, room));
    l->outline.room_of = l->room_of;
    l->corner_room = room;
    s->vertex_count = s->directed_count = l->outline.side_count = (uint32_t)room;
    return SL_OK;
}

static void clear_edge(sli_live *l, size_t edge) {
    sl_space *s = &l->space;
    s->portals[edge] = (sl_portal){{SL_NO_CELL, SL_NO_CELL}, s->bounds.min, s->bounds.min};
    s->walls[edge] = (sl_wall){.a = s->bounds.min, .b = s->bounds.min};
}

static sl_status grow_edges(sli_live *l) {
    const size_t old = l->edge_room, needed = l->triangles.halves.count / 2, room = more(needed);
    sl_space *s = &l->space;
    if (needed <= old) return SL_OK;
    GROW(s->portals, old, room);
    GROW(s->walls, old, room);
    for (size_t i = old; i < room; i++) clear_edge(l, i);
    l->edge_room = room;
    s->portal_count = s->wall_count = (uint32_t)room;
    return SL_OK;
}

/// Room for the entries of buckets: each new one may need a larger block.
static sl_status grow_entries(sli_live *l, uint32_t new_cells) {
    sl_cell_grid *g = &l->space.grid;
    size_t needed = l->bucket_blocks.used;
    for (size_t i = 0; i < l->new_buckets.count; i++) {
        const uint32_t bucket = l->new_buckets.items[i];
        needed += sli_block_size(g->stop[bucket] - g->first[bucket] + new_cells);
    }
    if (needed > INT32_MAX) return sl_fail_memory(l->context);
    if (needed > l->entry_room) {
        GROW(g->cells, l->entry_room, more(needed));
        l->entry_room = more(needed);
    }
    return SL_OK;
}

/// Room for the seams on the sides of new cells.
static sl_status grow_seams(sli_live *l) {
    sl_space *s = &l->space;
    size_t needed = s->seam_portal_count;
    sli_live_seam on;
    for (size_t i = 0; i < l->cells.count; i++) {
        const sli_live_cell *cell = &l->cells.items[i];
        uint32_t half = cell->half;
        for (uint32_t k = 0; k < cell->corners; k++, half = sli_live_next_side(l, half)) {
            const uint32_t label = l->triangles.labels[half / 2];
            for (uint32_t g = 0; label && l->seams(l->user, label, g, &on); g++) {
                l->limits |= on.limits;
                needed++;
            }
        }
    }
    if (needed > INT32_MAX) return sl_fail_memory(l->context);
    return sl_reserve(l->context, &s->seam_portals, &l->seam_room, needed, sizeof *s->seam_portals);
}

sl_status sli_live_room(sli_live *l) {
    size_t cells = 0, corners = l->corners.used;
    for (size_t i = 0; i < l->cells.count; i++) {
        if (l->cells.items[i].number != SL_NO_CELL) continue;
        cells++;
        corners += sli_block_size(l->cells.items[i].corners);
    }
    // Old cells give numbers back before new ones take them.
    const size_t all = l->live_count + cells;
    if (all > l->cell_room) SL_TRY(grow_cells(l, all));
    SL_TRY(grow_corners(l, corners));
    SL_TRY(grow_edges(l));
    SL_TRY(grow_seams(l));
    if (l->limits && !l->outline.limited) SL_TRY(grow_limited(l, 0, l->corner_room));
    l->gone.count = l->came.count = 0;
    SL_TRY(SL_ARRAY_ROOM(l->context, &l->gone, l->old.count));
    SL_TRY(SL_ARRAY_ROOM(l->context, &l->came, cells));
    return l->space.grid.columns ? grow_entries(l, (uint32_t)cells) : SL_OK;
}

// --- buckets

static void leave_bucket(sli_live *l, uint32_t bucket, uint32_t cell) {
    sl_cell_grid *g = &l->space.grid;
    uint32_t at = g->first[bucket];
    const uint32_t stop = g->stop[bucket];
    while (at < stop && g->cells[at] != cell) at++;
    if (at == stop) return;
    for (; at + 1 < stop; at++) g->cells[at] = g->cells[at + 1];
    g->stop[bucket]--;
}

static void enter_bucket(sli_live *l, uint32_t bucket, uint32_t cell) {
    sl_cell_grid *g = &l->space.grid;
    const uint32_t count = g->stop[bucket] - g->first[bucket];
    const uint32_t size = (uint32_t)SLI_BLOCK_LEAST << l->bucket_class[bucket];
    if (count == size) {
        const uint32_t first = sli_block_take(&l->bucket_blocks, g->cells, count + 1);
        memcpy(g->cells + first, g->cells + g->first[bucket], count * sizeof *g->cells);
        sli_block_give(&l->bucket_blocks, g->cells, g->first[bucket], size);
        g->first[bucket] = first;
        g->stop[bucket] = first + count;
        l->bucket_class[bucket] = (uint8_t)sli_block_class(count + 1);
    }
    uint32_t at = g->stop[bucket]++;
    for (; at > g->first[bucket] && g->cells[at - 1] > cell; at--) g->cells[at] = g->cells[at - 1];
    g->cells[at] = cell;
}

sl_status sli_live_start_grid(sli_live *l) {
    sl_cell_grid *g = &l->space.grid;
    SL_TRY(sli_cell_grid_make(l->context, &l->space));
    const size_t buckets = (size_t)g->columns * g->rows;
    const uint32_t *from = g->cells;
    size_t total = 0;
    for (size_t b = 0; b < buckets; b++) total += sli_block_size(g->first[b + 1] - g->first[b]);
    if (total > INT32_MAX) return sl_fail_memory(l->context);
    uint32_t *cells = sl_alloc_array(l->context, total, sizeof *cells);
    g->stop = sl_alloc_array(l->context, buckets, sizeof *g->stop);
    l->bucket_class = sl_alloc_array(l->context, buckets, sizeof *l->bucket_class);
    if (!cells || !g->stop || !l->bucket_class) {
        sl_free(l->context, cells);
        return SL_NO_MEMORY;
    }
    uint32_t at = 0;
    for (size_t b = 0; b < buckets; b++) {
        const uint32_t count = g->first[b + 1] - at;
        const uint32_t first = sli_block_take(&l->bucket_blocks, cells, count);
        memcpy(cells + first, from + at, count * sizeof *cells);
        l->bucket_class[b] = (uint8_t)sli_block_class(count);
        at = g->first[b + 1];
        g->first[b] = first;
        g->stop[b] = first + count;
    }
    sl_free(l->context, g->cells);
    g->cells = cells;
    g->entry_count = (uint32_t)total;
    l->entry_room = total;
    return SL_OK;
}

// --- cells

static void drop_cell(sli_live *l, uint32_t number) {
    sl_space *s = &l->space;
    sl_cell *cell = &s->cells[number];
    const uint32_t first = cell->first_vertex, stop = first + cell->vertex_count;
    for (uint32_t i = first; i < first + cell->directed_count; i++)
        clear_edge(l, s->directed[i].portal);
    for (uint32_t i = first; i < stop; i++) {
        if (s->neighbour[i] < SL_NEIGHBOUR_BORDER)
            clear_edge(l, s->neighbour[i] & ~SL_NEIGHBOUR_RIGHT);
        l->outline.sides[i] = (sl_side){s->bounds.min, i, SL_SIDE_BORDER};
        if (l->outline.limited) l->outline.limited[i] = SL_NO_SEAM;
        l->room_of[i] = SL_NO_CELL;
    }
    sli_block_give(&l->corners, s->neighbour, first, cell->vertex_count);
    s->inside_count -= cell->inside;
    *cell = (sl_cell){0};
    l->half_of[number] = l->free_cell;
    l->free_cell = number + 1;
    l->live_count--;
    l->gone.items[l->gone.count++] = number;
}

/// What the cells that go have in common. Where they differ, new ones count as inside.
static void find_ground(sli_live *l) {
    const sl_cell *first = NULL;
    l->ground = (sl_cell){.inside = 1};
    for (size_t i = 0; i < l->old.count; i++) {
        const sl_cell *cell = &l->space.cells[l->old.items[i]];
        if (l->dissolved[l->old.items[i]] != l->now) continue;
        if (!first) first = cell;
        if (cell->inside != first->inside || cell->solid != first->solid) return;
    }
    if (first) l->ground = (sl_cell){.inside = first->inside, .solid = first->solid};
}

static void drop_old(sli_live *l) {
    size_t at = 0;
    for (size_t i = 0; i < l->old.count; i++) {
        const uint32_t cell = l->old.items[i];
        if (l->dissolved[cell] != l->now) continue;
        if (l->space.grid.columns) {
            const uint32_t count = l->old_buckets.items[at++];
            for (uint32_t k = 0; k < count; k++) leave_bucket(l, l->old_buckets.items[at++], cell);
        }
        drop_cell(l, cell);
    }
}

/// Gives a new cell its number, and its sides their places.
static void place_cell(sli_live *l, sli_live_cell *c) {
    sl_space *s = &l->space;
    const uint32_t number = c->number = l->free_cell - 1;
    l->free_cell = l->half_of[number];
    l->live_count++;
    l->came.items[l->came.count++] = number;
    for (uint32_t i = 0; i < c->triangle_count; i++) {
        uint32_t half = l->triangles_of.items[c->first_triangle + i];
        for (int k = 0; k < 3; k++, half = sli_live_next(l, half)) l->owner[half] = number;
    }
    const uint32_t first = sli_block_take(&l->corners, s->neighbour, c->corners);
    s->cells[number] = (sl_cell){.first_vertex = first,
                                 .vertex_count = c->corners,
                                 .first_directed = first,
                                 .inside = l->ground.inside,
                                 .solid = l->ground.solid};
    s->inside_count += l->ground.inside;
    l->outline.first[number] = first;
    l->half_of[number] = c->half;
    uint32_t half = c->half;
    for (uint32_t i = 0; i < c->corners; i++, half = sli_live_next_side(l, half))
        l->place[half] = first + i;
    for (uint32_t i = 0; i < c->bucket_count; i++)
        enter_bucket(l, l->new_buckets.items[c->first_bucket + i], number);
}

/// Notes the seams on the portal of a side, and at both of its sides whether they limit sight.
static void write_seams(sli_live *l, uint32_t half) {
    sl_space *s = &l->space;
    const uint32_t edge = half / 2;
    uint32_t limited = SL_NO_SEAM;
    sli_live_seam on;
    for (uint32_t k = 0; l->seams(l->user, l->triangles.labels[edge], k, &on); k++) {
        s->seam_portals[s->seam_portal_count++] = (sl_seam_portal){
            edge, on.seam,
            sli_same_point(l->triangles.points.items[on.from], s->portals[edge].left)};
        l->new_seams = true;
        if (on.limits && on.seam < limited) limited = on.seam;
    }
    if (!l->outline.limited) return;
    l->outline.limited[l->place[half]] = l->outline.limited[l->place[half ^ 1]] = limited;
}

/// A seam that rounding has folded lies on a portal both ways.
static int compare_seam_portals(const void *left, const void *right) {
    const sl_seam_portal *a = left, *b = right;
    if (a->portal != b->portal) return a->portal > b->portal ? 1 : -1;
    if (a->seam != b->seam) return a->seam > b->seam ? 1 : -1;
    return (a->forward > b->forward) - (a->forward < b->forward);
}

/// Sorts the seams of portals. Two new cells have both written what is between them.
static void sort_seams(sli_live *l) {
    sl_seam_portal *items = l->space.seam_portals;
    const uint32_t all = l->space.seam_portal_count;
    uint32_t count = 0;
    qsort(items, all, sizeof *items, compare_seam_portals);
    for (uint32_t i = 0; i < all; i++)
        if (!count || compare_seam_portals(&items[count - 1], &items[i]) != 0)
            items[count++] = items[i];
    l->space.seam_portal_count = count;
    l->new_seams = false;
}

/// Drops the seams of portals that cells are about to lose, or that they write again.
static void drop_seams(sli_live *l) {
    sl_space *s = &l->space;
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->seam_portal_count; i++) {
        const uint32_t *cells = s->portals[s->seam_portals[i].portal].cell;
        if (l->dissolved[cells[0]] != l->now && l->dissolved[cells[1]] != l->now)
            s->seam_portals[count++] = s->seam_portals[i];
    }
    s->seam_portal_count = count;
}

static uint32_t border_of(const sl_box *b, sl_point from, sl_point to) {
    if (from.y == b->min.y && to.y == b->min.y) return SL_SIDE_BORDER;
    if (from.x == b->max.x && to.x == b->max.x) return SL_SIDE_BORDER + 1;
    return SL_SIDE_BORDER + (from.y == b->max.y && to.y == b->max.y ? 2 : 3);
}

/// Writes a portal, and what the neighbour knows of it.
static uint32_t write_portal(sli_live *l, sl_cell *cell, uint32_t number, uint32_t half) {
    sl_space *s = &l->space;
    const uint32_t edge = half / 2, twin = half ^ 1, other = l->owner[twin];
    const sl_point right = sli_live_start(l, half), left = sli_live_end(l, half);
    s->directed[cell->first_directed + cell->directed_count++] =
        (sl_directed_portal){edge, other, left, right};
    s->portals[edge] = number < other ? (sl_portal){{number, other}, left, right}
                                      : (sl_portal){{other, number}, right, left};
    const sl_cell *beyond = &s->cells[other];
    for (uint32_t i = beyond->first_directed; i < beyond->first_directed + beyond->directed_count;
         i++)
        if (s->directed[i].portal == edge) s->directed[i].cell = number;
    l->outline.sides[l->place[twin]].neighbour = l->place[half];
    return l->place[twin];
}

static void write_cell(sli_live *l, const sli_live_cell *c) {
    sl_space *s = &l->space;
    sl_cell *cell = &s->cells[c->number];
    const uint32_t first = cell->first_vertex;
    uint32_t half = c->half;
    for (uint32_t i = first; i < first + c->corners; i++, half = sli_live_next_side(l, half)) {
        const uint32_t edge = half / 2, label = l->triangles.labels[edge];
        const sl_point a = sli_live_start(l, half), b = sli_live_end(l, half);
        const sli_live_edge is = label ? l->label(l->user, label) : (sli_live_edge){0};
        sl_side *side = &l->outline.sides[i];
        *side = (sl_side){a, i + 1 < first + c->corners ? i + 1 : first, 0};
        s->vertices[i] = a;
        l->room_of[i] = c->number;
        if (l->outline.limited) l->outline.limited[i] = SL_NO_SEAM;
        if (is.wall) {
            const bool along = is.from == l->triangles.halves.items[half].from;
            s->neighbour[i] = edge | (along ? 0 : SL_NEIGHBOUR_RIGHT);
            s->walls[edge] = (sl_wall){along ? a : b, along ? b : a, is.line, is.ground};
            side->neighbour = SL_SIDE_WALL + edge;
        } else if (sli_half_is_outside(&l->triangles, half ^ 1)) {
            s->neighbour[i] = SL_NEIGHBOUR_BORDER;
            side->neighbour = border_of(&s->bounds, a, b);
        } else {
            s->neighbour[i] = SL_NEIGHBOUR_PORTAL;
            side->neighbour = write_portal(l, cell, c->number, half);
            if (label) write_seams(l, half);
        }
    }
}

void sli_live_write(sli_live *l) {
    drop_seams(l);
    find_ground(l);
    drop_old(l);
    size_t fresh = 0;
    for (size_t i = 0; i < l->cells.count; i++) {
        if (l->cells.items[i].number != SL_NO_CELL) continue;
        place_cell(l, &l->cells.items[i]);
        l->cells.items[fresh++] = l->cells.items[i];
    }
    for (size_t i = 0; i < fresh; i++) write_cell(l, &l->cells.items[i]);
    if (l->new_seams) sort_seams(l);
}
