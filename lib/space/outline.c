/// The outline of a space: for each cell its portals in order, and between them walls and border.
///
///          left ____ portal ____ right        a cell is walked counter-clockwise; a gap
///         .                           .       between two portals is a piece of wall, or of
///        wall                       border    several walls, or of the map's border
///         .____ wall 3 _____ wall 4 __.
///
/// Glass that is dark from one side has a directed portal at the one side and a wall at the other.
/// While cells are joined, both sides are that wall, which keeps them; then they are linked.
///
/// A mesh knows what each side is. In a kd-tree's space all is axial, so walls sorted by line say
/// which of them lie on a gap. Then cells are joined to rooms (rooms.c). No coordinate is computed.
/// Time O(n log n).
#include "space/outline.h"

#include "geometry/orient.h"
#include "sightline/space.h"
#include "sightline/support.h"
#include "space/index.h"
#include "space/kd_tree.h"

#include <math.h>
#include <stdlib.h>

/// The part of a piece of boundary that a wall covers, in the coordinate along it.
typedef struct cover {
    double from, to;
    sl_point start, end; ///< the same, as points
    uint32_t wall;
} cover;

/// A wall of a kd-tree's space, on its line.
typedef struct line_wall {
    int axis; ///< 0: on the line x = at, 1: on y = at
    uint32_t wall;
    double at, lo, hi;
    double reach; ///< the highest `hi` on the line up to here: walls may overlap
} line_wall;

typedef struct outliner {
    const sl_space *space;
    line_wall *lines; ///< sorted; NULL for a mesh
    uint32_t line_count;
    SL_ARRAY(cover) covers;
    SL_ARRAY(sl_side) sides;
    uint32_t *of_portal; ///< the side of each directed portal
    uint32_t dark_count; ///< portals that lead one way
} outliner;

/// The place of a point along the line from `from` to `to`; it grows on the way.
static double along(sl_point from, sl_point to, sl_point point) {
    const bool by_x = fabs(to.x / 2 - from.x / 2) >= fabs(to.y / 2 - from.y / 2);
    if (by_x) return to.x > from.x ? point.x : -point.x;
    return to.y > from.y ? point.y : -point.y;
}

static int compare_covers(const void *left, const void *right) {
    const cover *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

/// The first of the walls on a line that ends after `lo`, or a later one.
static uint32_t find_line(const outliner *o, int axis, double at, double lo) {
    uint32_t first = 0, end = o->line_count;
    while (first < end) {
        const uint32_t middle = first + (end - first) / 2;
        const line_wall *l = &o->lines[middle];
        const bool before = l->axis != axis ? l->axis < axis
                            : l->at != at   ? l->at < at
                                            : l->reach <= lo;
        if (before)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

static sl_status add_cover(sl_context *context, outliner *o, uint32_t wall, sl_point from,
                           sl_point to) {
    const sl_wall *w = &o->space->walls[wall];
    const double a = along(from, to, w->a), b = along(from, to, w->b);
    SL_TRY(SL_ARRAY_ROOM(context, &o->covers, 1));
    o->covers.items[o->covers.count++] =
        (cover){fmin(a, b), fmax(a, b), a < b ? w->a : w->b, a < b ? w->b : w->a, wall};
    return SL_OK;
}

/// Finds the walls on a piece of boundary.
static sl_status gather_covers(sl_context *context, outliner *o, sl_point from, sl_point to) {
    const int axis = from.x == to.x ? 0 : 1;
    const double at = axis ? from.y : from.x;
    const double lo = axis ? fmin(from.x, to.x) : fmin(from.y, to.y);
    const double hi = axis ? fmax(from.x, to.x) : fmax(from.y, to.y);
    o->covers.count = 0;
    for (uint32_t i = find_line(o, axis, at, lo); i < o->line_count; i++) {
        const line_wall *l = &o->lines[i];
        if (l->axis != axis || l->at != at || l->lo >= hi) break;
        if (l->hi > lo) SL_TRY(add_cover(context, o, l->wall, from, to));
    }
    if (o->covers.count > 1)
        qsort(o->covers.items, o->covers.count, sizeof *o->covers.items, compare_covers);
    return SL_OK;
}

static sl_status add_side(sl_context *context, outliner *o, sl_point start, uint32_t neighbour) {
    SL_TRY(SL_ARRAY_ROOM(context, &o->sides, 1));
    const uint32_t next = (uint32_t)o->sides.count + 1;
    o->sides.items[o->sides.count++] = (sl_side){start, next, neighbour};
    return SL_OK;
}

static sl_status add_border(sl_context *context, outliner *o, uint32_t cell, sl_point from,
                            sl_point to) {
    const sl_box *b = &o->space->bounds;
    const bool on[4] = {
        from.y == b->min.y && to.y == b->min.y, from.x == b->max.x && to.x == b->max.x,
        from.y == b->max.y && to.y == b->max.y, from.x == b->min.x && to.x == b->min.x};
    for (uint32_t i = 0; i < 4; i++)
        if (on[i]) return add_side(context, o, from, SL_SIDE_BORDER + i);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "cell %u: from %.17g %.17g to %.17g %.17g is neither portal nor wall nor border",
                   cell, from.x, from.y, to.x, to.y);
}

/// Adds the sides of a piece of boundary without portals.
static sl_status add_gap(sl_context *context, outliner *o, uint32_t cell, sl_point from,
                         sl_point to) {
    SL_TRY(gather_covers(context, o, from, to));
    sl_point at = from;
    for (size_t i = 0; i < o->covers.count && !sli_same_point(at, to); i++) {
        const cover *c = &o->covers.items[i];
        if (c->to <= along(from, to, at)) continue;
        if (c->from > along(from, to, at)) {
            SL_TRY(add_border(context, o, cell, at, c->start));
            at = c->start;
        }
        SL_TRY(add_side(context, o, at, SL_SIDE_WALL + c->wall));
        at = c->to < along(from, to, to) ? c->end : to;
    }
    return sli_same_point(at, to) ? SL_OK : add_border(context, o, cell, at, to);
}

static bool on_edge(sl_point a, sl_point b, sl_point p) {
    return sli_orient(a, b, p) == 0 && along(a, b, p) >= along(a, b, a) &&
           along(a, b, p) <= along(a, b, b);
}

/// The sides of a mesh's cell.
static sl_status outline_known(sl_context *context, outliner *o, uint32_t cell) {
    const sl_space *s = o->space;
    const sl_cell *c = &s->cells[cell];
    const uint32_t first = (uint32_t)o->sides.count;
    uint32_t directed = c->first_directed;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const sl_point *corners = s->vertices + c->first_vertex;
        const uint32_t edge = s->neighbour[c->first_vertex + i];
        if (edge == SL_NEIGHBOUR_BORDER) {
            SL_TRY(add_border(context, o, cell, corners[i], corners[(i + 1) % c->vertex_count]));
        } else if (edge != SL_NEIGHBOUR_PORTAL) {
            SL_TRY(add_side(context, o, corners[i], SL_SIDE_WALL + (edge & ~SL_NEIGHBOUR_RIGHT)));
        } else {
            o->of_portal[directed++] = (uint32_t)o->sides.count;
            SL_TRY(add_side(context, o, corners[i], 0));
        }
    }
    if (o->sides.count > INT32_MAX) return sl_fail_memory(context);
    o->sides.items[o->sides.count - 1].next = first;
    return SL_OK;
}

static sl_status outline_cell(sl_context *context, outliner *o, uint32_t cell) {
    if (o->space->neighbour) return outline_known(context, o, cell);
    const sl_cell *c = &o->space->cells[cell];
    const sl_point *corners = o->space->vertices + c->first_vertex;
    const uint32_t first = (uint32_t)o->sides.count;
    uint32_t directed = c->first_directed;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        sl_point at = corners[i];
        const sl_point end = corners[(i + 1) % c->vertex_count];
        for (; directed < c->first_directed + c->directed_count; directed++) {
            const sl_directed_portal *e = &o->space->directed[directed];
            if (!on_edge(corners[i], end, e->right) || !on_edge(corners[i], end, e->left)) break;
            if (!sli_same_point(at, e->right)) SL_TRY(add_gap(context, o, cell, at, e->right));
            o->of_portal[directed] = (uint32_t)o->sides.count;
            SL_TRY(add_side(context, o, e->right, 0));
            at = e->left;
        }
        if (!sli_same_point(at, end)) SL_TRY(add_gap(context, o, cell, at, end));
    }
    if (directed != c->first_directed + c->directed_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: portal %u is not on its boundary", cell,
                       directed - c->first_directed);
    if (o->sides.count > INT32_MAX) return sl_fail_memory(context);
    o->sides.items[o->sides.count - 1].next = first;
    return SL_OK;
}

/// Finds the wall on the dark side of a portal that leads one way, and gives it to the lit side.
static sl_status darken(sl_context *context, outliner *o, const uint32_t *first,
                        uint32_t directed) {
    const sl_directed_portal *portal = &o->space->directed[directed];
    sl_side *sides = o->sides.items;
    for (uint32_t i = first[portal->cell]; i < first[portal->cell + 1]; i++) {
        const bool wall = sides[i].neighbour >= SL_SIDE_WALL && sides[i].neighbour < SL_SIDE_BORDER;
        if (!wall || !sli_same_point(sides[i].start, portal->left) ||
            !sli_same_point(sides[sides[i].next].start, portal->right))
            continue;
        sides[o->of_portal[directed]].neighbour = sides[i].neighbour;
        o->dark_count++;
        return SL_OK;
    }
    return sl_fail(context, SL_BAD_ARGUMENT, "portal %u leads one way, and is no wall at the other",
                   portal->portal);
}

/// Joins the two sides of each portal.
static sl_status join_portals(sl_context *context, outliner *o, const uint32_t *first) {
    const sl_space *s = o->space;
    uint32_t *one = sl_alloc_array(context, s->portal_count, sizeof *one);
    if (!one) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->portal_count; i++) one[i] = UINT32_MAX;
    for (uint32_t i = 0; i < s->directed_count; i++) {
        const uint32_t portal = s->directed[i].portal, side = o->of_portal[i];
        if (one[portal] == UINT32_MAX) {
            one[portal] = side;
            continue;
        }
        o->sides.items[side].neighbour = one[portal];
        o->sides.items[one[portal]].neighbour = side;
        one[portal] = UINT32_MAX;
    }
    sl_status status = SL_OK;
    if (s->directed_count < 2 * (uint64_t)s->portal_count)
        for (uint32_t i = 0; i < s->directed_count && status == SL_OK; i++)
            if (one[s->directed[i].portal] == o->of_portal[i])
                status = darken(context, o, first, i);
    sl_free(context, one);
    return status;
}

/// Links the two sides of each glass again. The wall runs as its dark side does.
static sl_status link_glass(sl_context *context, uint32_t count, sl_outline *out) {
    const sl_space *s = out->space;
    if (!count) return SL_OK;
    out->first_dark = s->wall_count - count;
    out->lit = sl_alloc_array(context, count, sizeof *out->lit);
    uint32_t *dark = sl_alloc_array(context, count, sizeof *dark);
    for (uint32_t i = 0; i < out->side_count && out->lit && dark; i++) {
        if (!sl_side_is_dark(out, &out->sides[i])) continue;
        const uint32_t wall = out->sides[i].neighbour - SL_SIDE_WALL;
        const bool is_dark = sli_same_point(out->sides[i].start, s->walls[wall].a);
        (is_dark ? dark : out->lit)[wall - out->first_dark] = i;
    }
    for (uint32_t i = 0; i < count && out->lit && dark; i++)
        out->sides[out->lit[i]].neighbour = dark[i];
    const bool done = out->lit && dark;
    sl_free(context, dark);
    return done ? SL_OK : SL_NO_MEMORY;
}

static int compare_lines(const void *left, const void *right) {
    const line_wall *a = left, *b = right;
    if (a->axis != b->axis) return a->axis - b->axis;
    if (a->at != b->at) return a->at < b->at ? -1 : 1;
    return (a->lo > b->lo) - (a->lo < b->lo);
}

/// Sorts the walls of a kd-tree's space by line.
static sl_status sort_lines(sl_context *context, outliner *o) {
    const sl_space *s = o->space;
    o->lines = sl_alloc_array(context, s->wall_count, sizeof *o->lines);
    if (!o->lines) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->wall_count; i++) {
        const sl_point a = s->walls[i].a, b = s->walls[i].b;
        const int axis = a.x == b.x ? 0 : 1;
        const double from = axis ? a.x : a.y, to = axis ? b.x : b.y;
        if (from == to) continue;
        o->lines[o->line_count++] =
            (line_wall){axis, i, axis ? a.y : a.x, fmin(from, to), fmax(from, to), 0};
    }
    if (o->line_count) qsort(o->lines, o->line_count, sizeof *o->lines, compare_lines);
    for (uint32_t i = 0; i < o->line_count; i++) {
        line_wall *l = &o->lines[i];
        const bool goes_on = i && l[-1].axis == l->axis && l[-1].at == l->at;
        l->reach = goes_on ? fmax(l[-1].reach, l->hi) : l->hi;
    }
    return SL_OK;
}

/// Makes walls of both sides of some portals.
static void wall_portals(outliner *o, const uint32_t *portals, uint32_t count) {
    const sl_space *s = o->space;
    sl_side *sides = o->sides.items;
    for (uint32_t i = 0; i < count; i++) {
        const sl_cell *cell = &s->cells[s->portals[portals[i]].cell[0]];
        const uint32_t stop = cell->first_directed + cell->directed_count;
        uint32_t k = cell->first_directed;
        while (k < stop && s->directed[k].portal != portals[i]) k++;
        if (k == stop || !sl_side_is_portal(&sides[o->of_portal[k]])) continue;
        sl_side *side = &sides[o->of_portal[k]];
        sides[side->neighbour].neighbour = SL_SIDE_WALL + s->wall_count + i;
        side->neighbour = SL_SIDE_WALL + s->wall_count + i;
    }
}

// --- limited walls

/// While cells are joined, limited walls are walls. Those that are not yet have numbers from
/// `first` on.
typedef struct limits {
    uint32_t first, count;
    uint32_t *seam_of; ///< by wall; SL_NO_SEAM for most. NULL where no wall limits sight
} limits;

static bool is_limited(const sl_space *s, uint32_t on) {
    return s->seams[s->seam_portals[on].seam].kind == SL_SEAM_LIMITED;
}

/// The side of a portal in either of its cells; UINT32_MAX for none.
static uint32_t side_of_portal(const outliner *o, uint32_t portal) {
    const sl_space *s = o->space;
    for (unsigned k = 0; k < 2; k++) {
        const sl_cell *cell = &s->cells[s->portals[portal].cell[k]];
        const uint32_t stop = cell->first_directed + cell->directed_count;
        for (uint32_t i = cell->first_directed; i < stop; i++)
            if (s->directed[i].portal == portal) return o->of_portal[i];
    }
    return UINT32_MAX;
}

/// Makes a wall of a portal on a limited wall, if it is none.
static void limit_portal(outliner *o, limits *l, uint32_t portal, uint32_t seam) {
    const uint32_t i = side_of_portal(o, portal);
    if (i == UINT32_MAX) return;
    sl_side *side = &o->sides.items[i];
    if (sl_side_is_portal(side)) {
        const uint32_t wall = SL_SIDE_WALL + l->first + l->count++;
        o->sides.items[side->neighbour].neighbour = wall;
        side->neighbour = wall;
    }
    l->seam_of[side->neighbour - SL_SIDE_WALL] = seam;
}

/// `first`: the number of walls there are.
static sl_status wall_limits(sl_context *context, outliner *o, uint32_t first, limits *l) {
    const sl_space *s = o->space;
    uint32_t most = 0;
    for (uint32_t i = 0; i < s->seam_portal_count; i++) most += is_limited(s, i);
    if (!most) return SL_OK;
    l->first = first;
    l->seam_of = sl_alloc_array(context, (size_t)first + most, sizeof *l->seam_of);
    if (!l->seam_of) return SL_NO_MEMORY;
    for (size_t i = 0; i < (size_t)first + most; i++) l->seam_of[i] = SL_NO_SEAM;
    for (uint32_t i = 0, last = UINT32_MAX; i < s->seam_portal_count; i++) {
        const sl_seam_portal *on = &s->seam_portals[i];
        if (!is_limited(s, i) || on->portal == last) continue;
        last = on->portal;
        limit_portal(o, l, last, on->seam);
    }
    return SL_OK;
}

/// Says which sides limit sight, and links those again that were made walls for it.
static sl_status link_limits(sl_context *context, const limits *l, sl_outline *out) {
    if (!l->seam_of) return SL_OK;
    uint32_t *other = sl_alloc_array(context, l->count, sizeof *other);
    out->limited = sl_alloc_array(context, out->side_count, sizeof *out->limited);
    const bool room = other && out->limited;
    for (uint32_t i = 0; room && i < l->count; i++) other[i] = UINT32_MAX;
    for (uint32_t i = 0; room && i < out->side_count; i++) {
        sl_side *side = &out->sides[i];
        out->limited[i] = SL_NO_SEAM;
        if (sl_side_is_portal(side) || side->neighbour >= SL_SIDE_BORDER) continue;
        const uint32_t wall = side->neighbour - SL_SIDE_WALL;
        out->limited[i] = l->seam_of[wall];
        if (wall < l->first) continue;
        uint32_t *one = &other[wall - l->first];
        if (*one != UINT32_MAX) {
            side->neighbour = *one;
            out->sides[*one].neighbour = i;
        }
        *one = i;
    }
    sl_free(context, other);
    return room ? SL_OK : SL_NO_MEMORY;
}

static sl_status outline_all(sl_context *context, outliner *o, uint32_t *first) {
    const sl_space *s = o->space;
    if (!s->neighbour) SL_TRY(sort_lines(context, o));
    o->of_portal = sl_alloc_array(context, s->directed_count, sizeof *o->of_portal);
    if (!o->of_portal) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        first[i] = (uint32_t)o->sides.count;
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(outline_cell(context, o, i));
    }
    first[s->cell_count] = (uint32_t)o->sides.count;
    return join_portals(context, o, first);
}

/// Makes each cell a room of its own.
static sl_status start_rooms(sl_context *context, const sl_space *space, sl_outline *out) {
    out->space = space;
    out->room_count = space->cell_count;
    out->first = sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *out->first);
    return out->first ? SL_OK : SL_NO_MEMORY;
}

/// The cells of a mesh are its rooms.
static sl_status keep_cells(sl_context *context, sl_outline *o) {
    const uint32_t count = o->space->cell_count;
    o->first_part = sl_alloc_array(context, (size_t)count + 1, sizeof *o->first_part);
    o->parts = sl_alloc_array(context, count, sizeof *o->parts);
    if (!o->first_part || !o->parts) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) o->first_part[i] = o->parts[i] = i;
    o->first_part[count] = count;
    return SL_OK;
}

sl_status sli_outline_make(sl_context *context, const sl_space *space, sl_outline *out) {
    return sli_outline_make_walled(context, space, NULL, 0, out);
}

sl_status sli_outline_make_walled(sl_context *context, const sl_space *space,
                                  const uint32_t *portals, uint32_t count, sl_outline *out) {
    outliner o = {.space = space};
    limits l = {0};
    sl_outline made = {0};
    sl_status status = start_rooms(context, space, &made);
    if (status == SL_OK) status = outline_all(context, &o, made.first);
    if (status == SL_OK) wall_portals(&o, portals, count);
    if (status == SL_OK) status = wall_limits(context, &o, space->wall_count + count, &l);
    made.sides = o.sides.items;
    made.side_count = (uint32_t)o.sides.count;
    if (status == SL_OK)
        status = space->neighbour ? keep_cells(context, &made) : sli_rooms_make(context, &made);
    if (status == SL_OK) status = link_limits(context, &l, &made);
    if (status == SL_OK) status = link_glass(context, o.dark_count, &made);
    if (status == SL_OK)
        *out = made;
    else
        sli_outline_destroy(context, &made);
    sl_free(context, o.lines);
    sl_free(context, o.covers.items);
    sl_free(context, o.of_portal);
    sl_free(context, l.seam_of);
    return status;
}

void sli_outline_destroy(sl_context *context, sl_outline *outline) {
    sl_free(context, outline->sides);
    sl_free(context, outline->first);
    sl_free(context, outline->first_part);
    sl_free(context, outline->parts);
    sl_free(context, outline->lit);
    sl_free(context, outline->limited);
    *outline = (sl_outline){0};
}
