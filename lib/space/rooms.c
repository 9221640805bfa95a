/// Rooms: the cells of a kd-tree, joined to larger convex polygons. A view then passes fewer
/// portals.
///
/// 1. Faces of more than three corners are cut into triangles, ear by ear.
/// 2. Cells also meet away from the ends of walls. Such a corner would split a view for nothing, so
///    it is dropped: the faces around it become one, which is cut into triangles without it.
/// 3. Portals between two triangles are flipped where that makes them shorter.
/// 4. Portals are dropped, the longest first, if both of their ends stay convex corners (Hertel &
///    Mehlhorn 1983, Fast triangulation of simple polygons), in rounds until none is dropped.
///
///     +---+---+         +-------+         +-------+
///     |   |   |         |\      |         |       |       # is a wall: its end keeps the corner
///     +---+---+   2     |  \    |   4     |       |
///     |   |   |  --->   |    \  |  --->   |       |
///     +---#---+         +---#---+         +---#---+
///
/// Cutting needs no proof that a polygon is simple. If all triangles of it turn left, by exact
/// signs, they cover once what its boundary winds around. If some does not, the face stays as it
/// is. No coordinate is computed.
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/space.h"
#include "sightline/support.h"
#include "space/kd_tree.h"
#include "space/outline.h"

#include <stdlib.h>

/// The boundaries during the work: sides in any order, those of a face linked both ways.
typedef struct faces {
    SL_ARRAY(sl_side) sides;
    SL_ARRAY(uint32_t) previous; ///< by side; GONE for a removed side
    SL_ARRAY(uint32_t) unused;   ///< the removed sides
    bool *stale; ///< by side, while portals are flipped or dropped: what it touches has changed
                 ///< since it was tried. Others need not be tried again
} faces;

#define GONE UINT32_MAX

static sl_point end_of(const faces *mesh, uint32_t side) {
    return mesh->sides.items[mesh->sides.items[side].next].start;
}

static void link_sides(faces *mesh, uint32_t before, uint32_t after) {
    mesh->sides.items[before].next = after;
    mesh->previous.items[after] = before;
}

/// A corner of a polygon that is cut ear by ear.
typedef struct corner {
    sl_point at;
    uint32_t side;           ///< the side that starts here
    uint32_t next, previous; ///< of the corners that are left
} corner;

typedef struct cutter {
    sl_context *context;
    faces *mesh;
    SL_ARRAY(corner) ring;
    SL_ARRAY(uint32_t) ears;   ///< corners, in the order of cutting
    SL_ARRAY(uint32_t) spokes; ///< the portals that start at a corner to be dropped
} cutter;

static sl_side *side(const faces *m, uint32_t i) {
    return &m->sides.items[i];
}

static sl_status add_side(sl_context *context, faces *m, uint32_t *out) {
    if (m->unused.count) {
        *out = m->unused.items[--m->unused.count];
        return SL_OK;
    }
    if (m->sides.count >= INT32_MAX) return sl_fail_memory(context);
    SL_TRY(SL_ARRAY_ROOM(context, &m->sides, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &m->previous, 1));
    *out = (uint32_t)m->sides.count++;
    m->previous.items[m->previous.count++] = GONE;
    return SL_OK;
}

static sl_status remove_side(sl_context *context, faces *m, uint32_t i) {
    m->previous.items[i] = GONE;
    SL_TRY(SL_ARRAY_ROOM(context, &m->unused, 1));
    m->unused.items[m->unused.count++] = i;
    return SL_OK;
}

static sl_status drop_portal(sl_context *context, faces *m, uint32_t portal) {
    const uint32_t other = side(m, portal)->neighbour;
    link_sides(m, m->previous.items[portal], side(m, other)->next);
    link_sides(m, m->previous.items[other], side(m, portal)->next);
    SL_TRY(remove_side(context, m, portal));
    return remove_side(context, m, other);
}

/// Adds a portal between the starts of two sides of a face. *out is its side from the start of a to
/// that of b.
static sl_status connect(sl_context *context, faces *m, uint32_t a, uint32_t b, uint32_t *out) {
    uint32_t to_a = 0, to_b = 0;
    SL_TRY(add_side(context, m, &to_a));
    SL_TRY(add_side(context, m, &to_b));
    const uint32_t before_a = m->previous.items[a], before_b = m->previous.items[b];
    *side(m, to_a) = (sl_side){side(m, b)->start, 0, to_b};
    *side(m, to_b) = (sl_side){side(m, a)->start, 0, to_a};
    link_sides(m, before_b, to_a);
    link_sides(m, to_a, a);
    link_sides(m, before_a, to_b);
    link_sides(m, to_b, b);
    *out = to_b;
    return SL_OK;
}

static sl_status add_corner(cutter *c, uint32_t i) {
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->ring, 1));
    c->ring.items[c->ring.count++] = (corner){.at = side(c->mesh, i)->start, .side = i};
    return SL_OK;
}

/// Whether a corner is an ear: it turns left, and no other corner is in the way. A ring that is not
/// convex sees all its corners from a centre. So none is in the way if the ear does not hold the
/// centre, and the rest is such a ring again (Devillers 2002, On deletion in Delaunay
/// triangulations).
static bool is_ear(const cutter *c, uint32_t at, const sl_point *centre) {
    const corner *ring = c->ring.items;
    const sl_point p = ring[ring[at].previous].at, r = ring[ring[at].next].at;
    return sli_orient(p, ring[at].at, r) > 0 && (!centre || sli_orient(p, r, *centre) >= 0);
}

/// Finds the ears of the ring, in order. `centre` is NULL for a convex ring. False if it cannot be
/// cut.
static bool find_ears(cutter *c, const sl_point *centre) {
    corner *ring = c->ring.items;
    const uint32_t count = (uint32_t)c->ring.count;
    for (uint32_t i = 0; i < count; i++) {
        ring[i].next = i + 1 < count ? i + 1 : 0;
        ring[i].previous = i ? i - 1 : count - 1;
    }
    c->ears.count = 0;
    uint32_t left = count, tries = 0, at = 0;
    for (; left > 3 && tries < left; at = ring[at].next) {
        tries++;
        if (!is_ear(c, at, centre)) continue;
        c->ears.items[c->ears.count++] = at;
        ring[ring[at].next].previous = ring[at].previous;
        ring[ring[at].previous].next = ring[at].next;
        left--;
        tries = 0;
        at = ring[at].next;
    }
    return left == 3 && is_ear(c, at, NULL);
}

/// Cuts the ears that find_ears found off the face.
static sl_status cut_ears(cutter *c) {
    corner *ring = c->ring.items;
    const uint32_t count = (uint32_t)c->ring.count;
    for (uint32_t i = 0; i < count; i++) {
        ring[i].next = i + 1 < count ? i + 1 : 0;
        ring[i].previous = i ? i - 1 : count - 1;
    }
    for (size_t i = 0; i < c->ears.count; i++) {
        const corner *ear = &ring[c->ears.items[i]];
        corner *before = &ring[ear->previous], *after = &ring[ear->next];
        before->next = ear->next;
        after->previous = ear->previous;
        SL_TRY(connect(c->context, c->mesh, before->side, after->side, &before->side));
    }
    return SL_OK;
}

static sl_status cut_cell(cutter *c, uint32_t first) {
    c->ring.count = 0;
    uint32_t i = first;
    do {
        SL_TRY(add_corner(c, i));
        i = side(c->mesh, i)->next;
    } while (i != first);
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->ears, c->ring.count));
    return find_ears(c, NULL) ? cut_ears(c) : SL_OK;
}

/// Cuts all faces of more than three corners.
static sl_status cut_cells(cutter *c) {
    const size_t count = c->mesh->sides.count;
    for (uint32_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(c->context));
        if (side(c->mesh, side(c->mesh, side(c->mesh, i)->next)->next)->next != i)
            SL_TRY(cut_cell(c, i));
    }
    return SL_OK;
}

/// The first side around the start of `from`, clockwise: one that is no portal, else `from`.
static uint32_t first_spoke(const faces *m, uint32_t from) {
    uint32_t i = from;
    while (sl_side_is_portal(side(m, i))) {
        i = side(m, side(m, i)->neighbour)->next;
        if (i == from) return from;
    }
    return i;
}

/// Gathers the ring around the start of a side, and the portals that end there. If the faces do not
/// go all the way around, *last is the side where they end, else GONE.
static sl_status gather_star(cutter *c, uint32_t first, uint32_t *last) {
    const faces *m = c->mesh;
    c->ring.count = c->spokes.count = 0;
    *last = GONE;
    for (uint32_t spoke = first;;) {
        if (sl_side_is_portal(side(m, spoke))) {
            SL_TRY(SL_ARRAY_ROOM(c->context, &c->spokes, 1));
            c->spokes.items[c->spokes.count++] = spoke;
        }
        const uint32_t stop = m->previous.items[spoke];
        for (uint32_t i = side(m, spoke)->next; i != stop; i = side(m, i)->next)
            SL_TRY(add_corner(c, i));
        if (!sl_side_is_portal(side(m, stop))) {
            *last = stop;
            SL_TRY(add_corner(c, stop));
            break;
        }
        spoke = side(m, stop)->neighbour;
        if (spoke == first) break;
    }
    return SL_ARRAY_ROOM(c->context, &c->ears, c->ring.count);
}

/// Whether two sides lie in one line along the same wall or border.
static bool goes_on(const faces *m, uint32_t before, uint32_t after) {
    const sl_point a = side(m, before)->start, p = side(m, after)->start, b = end_of(m, after);
    return side(m, before)->neighbour == side(m, after)->neighbour && sli_orient(a, p, b) == 0 &&
           (a.x < p.x) == (p.x < b.x) && (a.y < p.y) == (p.y < b.y) && !sli_same_point(a, b);
}

/// Drops the corner where a side starts, if no wall ends there.
static sl_status drop_corner(cutter *c, uint32_t at) {
    faces *m = c->mesh;
    const uint32_t first = first_spoke(m, at);
    const sl_point centre = side(m, at)->start;
    uint32_t last;
    SL_TRY(gather_star(c, first, &last));
    if (last != GONE && !goes_on(m, last, first)) return SL_OK;
    if (c->ring.count < 3 || !find_ears(c, &centre)) return SL_OK;
    for (size_t i = 0; i < c->spokes.count; i++)
        SL_TRY(drop_portal(c->context, m, c->spokes.items[i]));
    if (last != GONE) {
        link_sides(m, last, side(m, first)->next);
        SL_TRY(remove_side(c->context, m, first));
    }
    return cut_ears(c);
}

static double length(sl_point a, sl_point b) {
    return sli_length(b.x - a.x, b.y - a.y);
}

/// Makes all portals be tried, while no side is added.
static sl_status start_trying(sl_context *context, faces *m) {
    sl_free(context, m->stale);
    m->stale = sl_alloc_array(context, m->sides.count, sizeof *m->stale);
    for (size_t i = 0; m->stale && i < m->sides.count; i++) m->stale[i] = true;
    return m->stale ? SL_OK : SL_NO_MEMORY;
}

/// Whether a portal is there and must be tried.
static bool is_due(faces *m, uint32_t i) {
    const bool stale = m->stale[i];
    m->stale[i] = false;
    return stale && m->previous.items[i] != GONE && sl_side_is_portal(side(m, i));
}

/// Makes both sides of a portal be tried again.
static void retry(faces *m, uint32_t i) {
    m->stale[i] = true;
    if (sl_side_is_portal(side(m, i))) m->stale[side(m, i)->neighbour] = true;
}

/// Makes the sides be tried again that are next to a portal about to be changed.
static void retry_around(faces *m, uint32_t portal) {
    const uint32_t other = side(m, portal)->neighbour;
    retry(m, portal);
    retry(m, side(m, portal)->next);
    retry(m, side(m, other)->next);
    retry(m, m->previous.items[portal]);
    retry(m, m->previous.items[other]);
}

/// Flips a portal between two triangles to their other two corners if it is shorter there.
static sl_status flip(cutter *c, uint32_t portal, bool *any) {
    faces *m = c->mesh;
    const uint32_t other = side(m, portal)->neighbour;
    const uint32_t after = side(m, portal)->next, across = side(m, other)->next;
    const uint32_t to = m->previous.items[portal], from = m->previous.items[other];
    if (side(m, after)->next != to || side(m, across)->next != from) return SL_OK;
    const sl_point a = side(m, portal)->start, b = side(m, other)->start;
    const sl_point p = side(m, to)->start, q = side(m, from)->start;
    if (!(length(p, q) < length(a, b))) return SL_OK;
    if (sli_orient(p, a, q) <= 0 || sli_orient(q, b, p) <= 0) return SL_OK;
    *any = true;
    retry_around(m, portal);
    SL_TRY(drop_portal(c->context, m, portal));
    return connect(c->context, m, to, from, &(uint32_t){0});
}

/// Flips until nothing changes. This ends, as each flip makes the sum of lengths smaller.
static sl_status flip_all(cutter *c) {
    SL_TRY(start_trying(c->context, c->mesh));
    for (bool any = true; any;) {
        any = false;
        SL_TRY(sl_check_cancelled(c->context));
        for (uint32_t i = 0; i < c->mesh->sides.count; i++)
            if (is_due(c->mesh, i)) SL_TRY(flip(c, i, &any));
    }
    return SL_OK;
}

static sl_status triangulate(cutter *c) {
    SL_TRY(cut_cells(c));
    for (uint32_t i = 0; i < c->mesh->sides.count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(c->context));
        if (c->mesh->previous.items[i] != GONE) SL_TRY(drop_corner(c, i));
    }
    return flip_all(c);
}

static sl_status triangulate_faces(sl_context *context, faces *mesh) {
    cutter c = {.context = context, .mesh = mesh};
    const sl_status status = triangulate(&c);
    sl_free(context, c.ring.items);
    sl_free(context, c.ears.items);
    sl_free(context, c.spokes.items);
    return status;
}

// --- joining

typedef struct candidate {
    double length;
    uint32_t side;
} candidate;

/// A room before it has a number. Rooms are sorted by a cell of theirs, so that neighbours are near
/// each other.
typedef struct start {
    uint32_t cell, side;
} start;

/// A room that has a part of a cell.
typedef struct share {
    uint32_t cell, room;
} share;

typedef struct joiner {
    const sl_space *space;
    faces mesh;
    SL_ARRAY(candidate) candidates;
    SL_ARRAY(start) starts;
    SL_ARRAY(share) shares;
    SL_ARRAY(uint32_t) waiting; ///< cells
    uint32_t *number;           ///< by side: its new number
    uint32_t *seen;             ///< by cell: 1 + the last room that was compared with it
} joiner;

static const sl_side *side_of(const joiner *j, uint32_t i) {
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

/// Whether the corner where a portal starts is convex without the portal.
static bool leaves_convex(const joiner *j, uint32_t portal) {
    const uint32_t after = side_of(j, side_of(j, portal)->neighbour)->next;
    return sli_goes_on(side_of(j, j->mesh.previous.items[portal])->start, side_of(j, portal)->start,
                       end_of(&j->mesh, after));
}

/// Sorts the portals, the longest first.
static sl_status sort_portals(sl_context *context, joiner *j) {
    const faces *m = &j->mesh;
    for (uint32_t i = 0; i < m->sides.count; i++) {
        if (m->previous.items[i] == GONE || !sl_side_is_portal(side_of(j, i)) ||
            side_of(j, i)->neighbour < i)
            continue;
        const sl_point a = side_of(j, i)->start, b = end_of(m, i);
        SL_TRY(SL_ARRAY_ROOM(context, &j->candidates, 1));
        j->candidates.items[j->candidates.count++] =
            (candidate){sli_length(b.x - a.x, b.y - a.y), i};
    }
    if (j->candidates.count)
        qsort(j->candidates.items, j->candidates.count, sizeof *j->candidates.items,
              compare_candidates);
    return SL_OK;
}

/// Tries the portals once, the longest first. *any: whether one was dropped.
static sl_status join_round(sl_context *context, joiner *j, bool *any) {
    faces *m = &j->mesh;
    *any = false;
    for (size_t i = 0; i < j->candidates.count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(context));
        const uint32_t portal = j->candidates.items[i].side;
        if (!is_due(m, portal) || !leaves_convex(j, portal) ||
            !leaves_convex(j, side_of(j, portal)->neighbour))
            continue;
        retry_around(m, portal);
        SL_TRY(drop_portal(context, m, portal));
        *any = true;
    }
    return SL_OK;
}

static sl_status join(sl_context *context, joiner *j) {
    SL_TRY(sort_portals(context, j));
    SL_TRY(start_trying(context, &j->mesh));
    for (bool any = true; any;) SL_TRY(join_round(context, j, &any));
    return SL_OK;
}

/// The cell in the middle of a side's room. For a sliver, rounding may give a cell beside it.
static uint32_t middle_cell(const joiner *j, uint32_t first) {
    sl_point middle = {0, 0};
    uint32_t count = 0, i = first;
    do {
        count++;
        i = side_of(j, i)->next;
    } while (i != first);
    do {
        middle.x += side_of(j, i)->start.x / count;
        middle.y += side_of(j, i)->start.y / count;
        i = side_of(j, i)->next;
    } while (i != first);
    return sl_space_locate(j->space, middle);
}

/// Finds the rooms, and numbers their sides, room by room.
static sl_status number_rooms(sl_context *context, joiner *j, uint32_t *count) {
    const faces *m = &j->mesh;
    j->number = sl_alloc_array(context, m->sides.count, sizeof *j->number);
    if (!j->number) return SL_NO_MEMORY;
    for (uint32_t first = 0; first < m->sides.count; first++) {
        if (m->previous.items[first] == GONE || j->number[first]) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &j->starts, 1));
        j->starts.items[j->starts.count++] = (start){middle_cell(j, first), first};
        for (uint32_t i = first; !j->number[i]; i = side_of(j, i)->next) j->number[i] = 1;
    }
    if (j->starts.count)
        qsort(j->starts.items, j->starts.count, sizeof *j->starts.items, compare_starts);
    *count = 0;
    for (size_t r = 0; r < j->starts.count; r++) {
        const uint32_t first = j->starts.items[r].side;
        uint32_t i = first;
        do {
            j->number[i] = (*count)++;
            i = side_of(j, i)->next;
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
        if (j->mesh.previous.items[i] == GONE) continue;
        const sl_side *s = side_of(j, i);
        const uint32_t neighbour = sl_side_is_portal(s) ? j->number[s->neighbour] : s->neighbour;
        sides[j->number[i]] = (sl_side){s->start, j->number[s->next], neighbour};
    }
    o->side_count = count;
    o->room_count = (uint32_t)j->starts.count;
    return SL_OK;
}

/// Whether a cell and a room overlap: no side of either has the other one on its right.
static bool overlap(const sl_outline *o, uint32_t cell, uint32_t room) {
    const sl_cell *c = &o->space->cells[cell];
    const sl_point *corners = o->space->vertices + c->first_vertex;
    const uint32_t first = o->first[room], stop = o->first[room + 1], count = c->vertex_count;
    for (uint32_t i = first; i < stop; i++) {
        const sl_point a = o->sides[i].start, b = o->sides[o->sides[i].next].start;
        uint32_t k = 0;
        while (k < count && sli_orient(a, b, corners[k]) <= 0) k++;
        if (k == count) return false;
    }
    for (uint32_t k = 0; k < count; k++) {
        const sl_point a = corners[k], b = corners[k + 1 < count ? k + 1 : 0];
        uint32_t i = first;
        while (i < stop && sli_orient(a, b, o->sides[i].start) <= 0) i++;
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

/// Finds the cells that a room has a part of. No wall is in a room, so portals lead from one to the
/// next.
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

/// Lists for each cell the rooms that have a part of it.
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

static sl_status fill_mesh(sl_context *context, faces *m, const sl_outline *o) {
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
    SL_TRY(triangulate_faces(context, &j->mesh));
    SL_TRY(join(context, j));
    SL_TRY(pack(context, j, o));
    return share_all(context, j, o);
}

sl_status sli_rooms_make(sl_context *context, sl_outline *o) {
    joiner j = {.space = o->space};
    const sl_status status = make(context, &j, o);
    sl_free(context, j.mesh.sides.items);
    sl_free(context, j.mesh.previous.items);
    sl_free(context, j.mesh.unused.items);
    sl_free(context, j.mesh.stale);
    sl_free(context, j.candidates.items);
    sl_free(context, j.starts.items);
    sl_free(context, j.shares.items);
    sl_free(context, j.waiting.items);
    sl_free(context, j.number);
    sl_free(context, j.seen);
    return status;
}

bool sli_outline_room_holds(const sl_outline *o, uint32_t room, sl_point point) {
    for (uint32_t i = o->first[room]; i < sl_outline_stop(o, room); i++)
        if (sli_orient(o->sides[i].start, o->sides[o->sides[i].next].start, point) < 0)
            return false;
    return true;
}

uint32_t sl_outline_room(const sl_outline *o, uint32_t cell, sl_point point) {
    const uint32_t *parts = o->parts + o->first_part[cell];
    const uint32_t count = o->first_part[cell + 1] - o->first_part[cell];
    uint32_t i = 0;
    while (i + 1 < count && !sli_outline_room_holds(o, parts[i], point)) i++;
    return parts[i];
}
