/// Rooms: triangles joined where what they make up is convex. Portals are dropped, the longest
/// first, where both of their ends stay convex corners (Hertel and Mehlhorn 1983, Fast
/// triangulation of simple polygons), until none can be.
#include "space/rooms.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

typedef struct candidate {
    double length;
    uint32_t side;
} candidate;

/// A room before it has its number: by the cell that it has a point of, so that neighbours stand
/// near to each other.
typedef struct start {
    uint32_t cell, side;
} start;

/// A room that has a part of a cell.
typedef struct share {
    uint32_t cell, room;
} share;

typedef struct joiner {
    const sl_space *space;
    sl_mesh mesh;
    SL_ARRAY(candidate) candidates;
    SL_ARRAY(start) starts;
    SL_ARRAY(share) shares;
    SL_ARRAY(uint32_t) waiting; ///< cells
    uint32_t *number;           ///< by side of the mesh: where it goes
    uint32_t *seen;             ///< by cell: the last room, and one more, that came to it
} joiner;

static const sl_side *side(const joiner *j, uint32_t i) {
    return &j->mesh.sides.items[i];
}

static int compare_candidates(const void *left, const void *right) {
    const candidate *a = left, *b = right;
    if (a->length != b->length) return a->length > b->length ? -1 : 1;
    return (a->side > b->side) - (a->side < b->side);
}

static int compare_starts(const void *left, const void *right) {
    const start *a = left, *b = right;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    return (a->side > b->side) - (a->side < b->side);
}

/// Whether the corner where a portal starts is convex once the portal is gone.
static bool leaves_convex(const joiner *j, uint32_t portal) {
    const uint32_t after = side(j, side(j, portal)->neighbour)->next;
    return sl_goes_on(side(j, j->mesh.previous.items[portal])->start, side(j, portal)->start,
                      sl_mesh_end(&j->mesh, after));
}

/// Tries every portal once, the longest first. *any tells whether one was dropped.
static sl_status join_round(sl_context *context, joiner *j, bool *any) {
    sl_mesh *m = &j->mesh;
    j->candidates.count = 0;
    for (uint32_t i = 0; i < m->sides.count; i++) {
        if (m->previous.items[i] == SL_SIDE_GONE || !sl_side_is_portal(side(j, i)) ||
            side(j, i)->neighbour < i)
            continue;
        const sl_point a = side(j, i)->start, b = sl_mesh_end(m, i);
        SL_TRY(SL_ARRAY_ROOM(context, &j->candidates, 1));
        j->candidates.items[j->candidates.count++] = (candidate){hypot(b.x - a.x, b.y - a.y), i};
    }
    *any = false;
    if (!j->candidates.count) return SL_OK;
    qsort(j->candidates.items, j->candidates.count, sizeof *j->candidates.items,
          compare_candidates);
    for (size_t i = 0; i < j->candidates.count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(context));
        const uint32_t portal = j->candidates.items[i].side;
        if (!leaves_convex(j, portal) || !leaves_convex(j, side(j, portal)->neighbour)) continue;
        SL_TRY(sl_mesh_drop(context, m, portal));
        *any = true;
    }
    return SL_OK;
}

/// The cell in the middle of the room of a side; where the room is a sliver, rounding may make it
/// another one.
static uint32_t middle_cell(const joiner *j, uint32_t first) {
    sl_point middle = {0, 0};
    uint32_t count = 0, i = first;
    do {
        count++;
        i = side(j, i)->next;
    } while (i != first);
    do {
        middle.x += side(j, i)->start.x / count;
        middle.y += side(j, i)->start.y / count;
        i = side(j, i)->next;
    } while (i != first);
    return sl_space_locate(j->space, middle);
}

/// Finds the rooms, and numbers their sides, room by room.
static sl_status number_rooms(sl_context *context, joiner *j, uint32_t *count) {
    const sl_mesh *m = &j->mesh;
    j->number = sl_alloc_array(context, m->sides.count, sizeof *j->number);
    if (!j->number) return SL_NO_MEMORY;
    for (uint32_t first = 0; first < m->sides.count; first++) {
        if (m->previous.items[first] == SL_SIDE_GONE || j->number[first]) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &j->starts, 1));
        j->starts.items[j->starts.count++] = (start){middle_cell(j, first), first};
        for (uint32_t i = first; !j->number[i]; i = side(j, i)->next) j->number[i] = 1;
    }
    if (j->starts.count)
        qsort(j->starts.items, j->starts.count, sizeof *j->starts.items, compare_starts);
    *count = 0;
    for (size_t r = 0; r < j->starts.count; r++) {
        const uint32_t first = j->starts.items[r].side;
        uint32_t i = first;
        do {
            j->number[i] = (*count)++;
            i = side(j, i)->next;
        } while (i != first);
    }
    return SL_OK;
}

/// Puts the sides of each room together.
static sl_status pack(sl_context *context, joiner *j, sl_outline *o) {
    uint32_t count;
    SL_TRY(number_rooms(context, j, &count));
    sl_side *sides = sl_alloc_array(context, count, sizeof *sides);
    uint32_t *first = sl_alloc_array(context, j->starts.count + 1, sizeof *first);
    sl_free(context, o->sides);
    sl_free(context, o->first);
    o->sides = sides;
    o->first = first;
    if (!sides || !first) return SL_NO_MEMORY;
    for (size_t r = 0; r < j->starts.count; r++) first[r] = j->number[j->starts.items[r].side];
    first[j->starts.count] = count;
    for (uint32_t i = 0; i < j->mesh.sides.count; i++) {
        if (j->mesh.previous.items[i] == SL_SIDE_GONE) continue;
        const sl_side *s = side(j, i);
        const uint32_t neighbour = sl_side_is_portal(s) ? j->number[s->neighbour] : s->neighbour;
        sides[j->number[i]] = (sl_side){s->start, j->number[s->next], neighbour};
    }
    o->side_count = count;
    o->room_count = (uint32_t)j->starts.count;
    return SL_OK;
}

/// Whether a cell and a room have inner points in common: no side of either has the other on its
/// right.
static bool overlap(const sl_outline *o, uint32_t cell, uint32_t room) {
    const sl_cell *c = &o->space->cells[cell];
    const sl_point *corners = o->space->vertices + c->first_vertex;
    const uint32_t first = o->first[room], stop = o->first[room + 1], count = c->vertex_count;
    for (uint32_t i = first; i < stop; i++) {
        const sl_point a = o->sides[i].start, b = o->sides[o->sides[i].next].start;
        uint32_t k = 0;
        while (k < count && sl_orient(a, b, corners[k]) <= 0) k++;
        if (k == count) return false;
    }
    for (uint32_t k = 0; k < count; k++) {
        const sl_point a = corners[k], b = corners[k + 1 < count ? k + 1 : 0];
        uint32_t i = first;
        while (i < stop && sl_orient(a, b, o->sides[i].start) <= 0) i++;
        if (i == stop) return false;
    }
    return true;
}

static sl_status share_cell(sl_context *context, joiner *j, const sl_outline *o, uint32_t cell,
                            uint32_t room) {
    if (j->seen[cell] == room + 1) return SL_OK;
    j->seen[cell] = room + 1;
    if (!overlap(o, cell, room)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &j->shares, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &j->waiting, 1));
    j->shares.items[j->shares.count++] = (share){cell, room};
    j->waiting.items[j->waiting.count++] = cell;
    return SL_OK;
}

/// Finds the cells that a room has a part of: one leads to the next through portals, as no wall is
/// in a room.
static sl_status share_room(sl_context *context, joiner *j, const sl_outline *o, uint32_t room) {
    const uint32_t cell = j->starts.items[room].cell;
    const size_t before = j->shares.count;
    if (cell != SL_NO_CELL) SL_TRY(share_cell(context, j, o, cell, room));
    const bool found = j->shares.count > before;
    for (uint32_t i = 0; !found && i < o->space->cell_count; i++)
        SL_TRY(share_cell(context, j, o, i, room));
    while (j->waiting.count) {
        const sl_cell *c = &o->space->cells[j->waiting.items[--j->waiting.count]];
        for (uint32_t i = 0; i < c->directed_count; i++)
            SL_TRY(share_cell(context, j, o, o->space->directed[c->first_directed + i].cell, room));
    }
    return SL_OK;
}

/// Tells by cell which rooms have a part of it.
static sl_status share_all(sl_context *context, joiner *j, sl_outline *o) {
    const uint32_t cells = o->space->cell_count;
    j->seen = sl_alloc_array(context, cells, sizeof *j->seen);
    o->first_part = sl_alloc_array(context, (size_t)cells + 2, sizeof *o->first_part);
    if (!j->seen || !o->first_part) return SL_NO_MEMORY;
    for (uint32_t room = 0; room < o->room_count; room++) {
        if (room % 1024 == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(share_room(context, j, o, room));
    }
    o->parts = sl_alloc_array(context, j->shares.count, sizeof *o->parts);
    if (!o->parts) return SL_NO_MEMORY;
    for (size_t i = 0; i < j->shares.count; i++) o->first_part[j->shares.items[i].cell + 2]++;
    for (uint32_t i = 1; i < cells; i++) o->first_part[i + 1] += o->first_part[i];
    for (size_t i = 0; i < j->shares.count; i++)
        o->parts[o->first_part[j->shares.items[i].cell + 1]++] = j->shares.items[i].room;
    return SL_OK;
}

static sl_status fill_mesh(sl_context *context, sl_mesh *m, const sl_outline *o) {
    SL_TRY(SL_ARRAY_ROOM(context, &m->sides, o->side_count));
    SL_TRY(SL_ARRAY_ROOM(context, &m->previous, o->side_count));
    m->sides.count = m->previous.count = o->side_count;
    for (uint32_t i = 0; i < o->side_count; i++) {
        m->sides.items[i] = o->sides[i];
        m->previous.items[o->sides[i].next] = i;
    }
    return SL_OK;
}

static sl_status make(sl_context *context, joiner *j, sl_outline *o) {
    SL_TRY(fill_mesh(context, &j->mesh, o));
    SL_TRY(sl_mesh_triangulate(context, &j->mesh));
    for (bool any = true; any;) SL_TRY(join_round(context, j, &any));
    SL_TRY(pack(context, j, o));
    return share_all(context, j, o);
}

sl_status sl_rooms_make(sl_context *context, sl_outline *o) {
    joiner j = {.space = o->space};
    const sl_status status = make(context, &j, o);
    sl_free(context, j.mesh.sides.items);
    sl_free(context, j.mesh.previous.items);
    sl_free(context, j.mesh.unused.items);
    sl_free(context, j.candidates.items);
    sl_free(context, j.starts.items);
    sl_free(context, j.shares.items);
    sl_free(context, j.waiting.items);
    sl_free(context, j.number);
    sl_free(context, j.seen);
    return status;
}

static bool holds(const sl_outline *o, uint32_t room, sl_point point) {
    for (uint32_t i = o->first[room]; i < o->first[room + 1]; i++)
        if (sl_orient(o->sides[i].start, o->sides[o->sides[i].next].start, point) < 0) return false;
    return true;
}

uint32_t sl_outline_room(const sl_outline *o, uint32_t cell, sl_point point) {
    const uint32_t *parts = o->parts + o->first_part[cell];
    const uint32_t count = o->first_part[cell + 1] - o->first_part[cell];
    uint32_t i = 0;
    while (i + 1 < count && !holds(o, parts[i], point)) i++;
    return parts[i];
}
