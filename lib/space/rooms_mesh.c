/// The triangles that rooms are made of. Where the corners of cells meet away from the ends of
/// walls, a view would be split for nothing; so such corners are dropped, one by one: the faces
/// around one are joined and cut again without it.
///
/// Cutting needs no proof that polygons are simple: when all triangles of one turn left, by the
/// exact predicate, they cover what its boundary winds around, once.
#include "space/rooms.h"

#include "geometry/orient.h"

#include <math.h>

/// A polygon to be cut, corner by corner.
typedef struct corner {
    sl_point at;
    uint32_t side;           ///< that starts there
    uint32_t next, previous; ///< of the corners left
} corner;

typedef struct cutter {
    sl_context *context;
    sl_mesh *mesh;
    SL_ARRAY(corner) ring;
    SL_ARRAY(uint32_t) ears;   ///< corners, as they are cut off
    SL_ARRAY(uint32_t) spokes; ///< the portals that start at a corner to be dropped
} cutter;

static sl_side *side(const sl_mesh *m, uint32_t i) {
    return &m->sides.items[i];
}

static sl_status add_side(sl_context *context, sl_mesh *m, uint32_t *out) {
    if (m->unused.count) {
        *out = m->unused.items[--m->unused.count];
        return SL_OK;
    }
    if (m->sides.count >= INT32_MAX) return sl_fail_memory(context);
    SL_TRY(SL_ARRAY_ROOM(context, &m->sides, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &m->previous, 1));
    *out = (uint32_t)m->sides.count++;
    m->previous.items[m->previous.count++] = SL_SIDE_GONE;
    return SL_OK;
}

static sl_status remove_side(sl_context *context, sl_mesh *m, uint32_t i) {
    m->previous.items[i] = SL_SIDE_GONE;
    SL_TRY(SL_ARRAY_ROOM(context, &m->unused, 1));
    m->unused.items[m->unused.count++] = i;
    return SL_OK;
}

sl_status sl_mesh_drop(sl_context *context, sl_mesh *m, uint32_t portal) {
    const uint32_t other = side(m, portal)->neighbour;
    sl_mesh_link(m, m->previous.items[portal], side(m, other)->next);
    sl_mesh_link(m, m->previous.items[other], side(m, portal)->next);
    SL_TRY(remove_side(context, m, portal));
    return remove_side(context, m, other);
}

/// Adds a portal between the starts of two sides of a face. *out is the side of it that starts
/// where a does, and has b after it.
static sl_status connect(sl_context *context, sl_mesh *m, uint32_t a, uint32_t b, uint32_t *out) {
    uint32_t to_a = 0, to_b = 0;
    SL_TRY(add_side(context, m, &to_a));
    SL_TRY(add_side(context, m, &to_b));
    const uint32_t before_a = m->previous.items[a], before_b = m->previous.items[b];
    *side(m, to_a) = (sl_side){side(m, b)->start, 0, to_b};
    *side(m, to_b) = (sl_side){side(m, a)->start, 0, to_a};
    sl_mesh_link(m, before_b, to_a);
    sl_mesh_link(m, to_a, a);
    sl_mesh_link(m, before_a, to_b);
    sl_mesh_link(m, to_b, b);
    *out = to_b;
    return SL_OK;
}

static sl_status add_corner(cutter *c, uint32_t i) {
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->ring, 1));
    c->ring.items[c->ring.count++] = (corner){.at = side(c->mesh, i)->start, .side = i};
    return SL_OK;
}

/// Whether a corner may be cut off: it turns left, and no other corner is in the way.
static bool is_ear(const cutter *c, uint32_t at, bool convex) {
    const corner *ring = c->ring.items;
    const uint32_t before = ring[at].previous, after = ring[at].next;
    const sl_point p = ring[before].at, q = ring[at].at, r = ring[after].at;
    if (sl_orient(p, q, r) <= 0) return false;
    for (uint32_t i = ring[after].next; !convex && i != before; i = ring[i].next) {
        const sl_point s = ring[i].at;
        if (!sl_same_point(s, p) && !sl_same_point(s, q) && !sl_same_point(s, r) &&
            sl_orient(p, q, s) >= 0 && sl_orient(q, r, s) >= 0 && sl_orient(r, p, s) >= 0)
            return false;
    }
    return true;
}

/// Finds how to cut the ring. False where it cannot be done.
static bool find_ears(cutter *c, bool convex) {
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
        if (!is_ear(c, at, convex)) continue;
        c->ears.items[c->ears.count++] = at;
        ring[ring[at].next].previous = ring[at].previous;
        ring[ring[at].previous].next = ring[at].next;
        left--;
        tries = 0;
        at = ring[at].next;
    }
    return left == 3 && is_ear(c, at, true);
}

/// Cuts the face of the ring as find_ears found.
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
    return find_ears(c, true) ? cut_ears(c) : SL_OK;
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

/// The side by which the faces around the start of `from` begin, clockwise of it: one that is no
/// portal, or `from` again.
static uint32_t first_spoke(const sl_mesh *m, uint32_t from) {
    uint32_t i = from;
    while (sl_side_is_portal(side(m, i))) {
        i = side(m, side(m, i)->neighbour)->next;
        if (i == from) return from;
    }
    return i;
}

/// Gathers the ring around the start of a side, and the portals that end there. *last is the side
/// that ends the faces around it where these are not all round, else SL_SIDE_GONE.
static sl_status gather_star(cutter *c, uint32_t first, uint32_t *last) {
    const sl_mesh *m = c->mesh;
    c->ring.count = c->spokes.count = 0;
    *last = SL_SIDE_GONE;
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

/// Whether two sides go on in one line along the same wall or border.
static bool goes_on(const sl_mesh *m, uint32_t before, uint32_t after) {
    const sl_point a = side(m, before)->start, p = side(m, after)->start, b = sl_mesh_end(m, after);
    return side(m, before)->neighbour == side(m, after)->neighbour && sl_orient(a, p, b) == 0 &&
           (a.x < p.x) == (p.x < b.x) && (a.y < p.y) == (p.y < b.y) && !sl_same_point(a, b);
}

/// Drops the corner where a side starts, if no wall ends there.
static sl_status drop_corner(cutter *c, uint32_t at) {
    sl_mesh *m = c->mesh;
    const uint32_t first = first_spoke(m, at);
    uint32_t last;
    SL_TRY(gather_star(c, first, &last));
    if (last != SL_SIDE_GONE && !goes_on(m, last, first)) return SL_OK;
    if (c->ring.count < 3 || !find_ears(c, false)) return SL_OK;
    for (size_t i = 0; i < c->spokes.count; i++)
        SL_TRY(sl_mesh_drop(c->context, m, c->spokes.items[i]));
    if (last != SL_SIDE_GONE) {
        sl_mesh_link(m, last, side(m, first)->next);
        SL_TRY(remove_side(c->context, m, first));
    }
    return cut_ears(c);
}

static double length(sl_point a, sl_point b) {
    return hypot(b.x - a.x, b.y - a.y);
}

/// Turns a portal between two triangles to the other two of their corners where it is shorter
/// there.
static sl_status flip(cutter *c, uint32_t portal, bool *any) {
    sl_mesh *m = c->mesh;
    const uint32_t other = side(m, portal)->neighbour;
    const uint32_t after = side(m, portal)->next, across = side(m, other)->next;
    const uint32_t to = m->previous.items[portal], from = m->previous.items[other];
    if (side(m, after)->next != to || side(m, across)->next != from) return SL_OK;
    const sl_point a = side(m, portal)->start, b = side(m, other)->start;
    const sl_point p = side(m, to)->start, q = side(m, from)->start;
    if (!(length(p, q) < length(a, b))) return SL_OK;
    if (sl_orient(p, a, q) <= 0 || sl_orient(q, b, p) <= 0) return SL_OK;
    *any = true;
    SL_TRY(sl_mesh_drop(c->context, m, portal));
    return connect(c->context, m, to, from, &(uint32_t){0});
}

/// Shortens portals until none can be: each turn makes their sum smaller.
static sl_status flip_all(cutter *c) {
    for (bool any = true; any;) {
        any = false;
        SL_TRY(sl_check_cancelled(c->context));
        for (uint32_t i = 0; i < c->mesh->sides.count; i++)
            if (c->mesh->previous.items[i] != SL_SIDE_GONE && sl_side_is_portal(side(c->mesh, i)))
                SL_TRY(flip(c, i, &any));
    }
    return SL_OK;
}

static sl_status triangulate(cutter *c) {
    SL_TRY(cut_cells(c));
    for (uint32_t i = 0; i < c->mesh->sides.count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(c->context));
        if (c->mesh->previous.items[i] != SL_SIDE_GONE) SL_TRY(drop_corner(c, i));
    }
    return flip_all(c);
}

sl_status sl_mesh_triangulate(sl_context *context, sl_mesh *mesh) {
    cutter c = {.context = context, .mesh = mesh};
    const sl_status status = triangulate(&c);
    sl_free(context, c.ring.items);
    sl_free(context, c.ears.items);
    sl_free(context, c.spokes.items);
    return status;
}
