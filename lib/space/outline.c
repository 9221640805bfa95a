/// The outline: each cell's exits in order, and between them what walls and the border there are.
/// Which wall lies on a piece of the boundary is found through a grid of buckets over the walls and
/// decided by the exact predicate.
#include "sightline/outline.h"

#include "base/base.h"
#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

/// What a wall covers of a piece of boundary, in the coordinate that runs along it.
typedef struct cover {
    double from, to;
    sl_point start, end; ///< the same as points
    uint32_t wall;
} cover;

/// Walls by the squares of a grid that their boxes meet: those of a square are
/// walls[begin[s] .. begin[s + 1]).
typedef struct buckets {
    uint32_t across;
    uint32_t *begin, *walls;
} buckets;

typedef struct outliner {
    const sl_space *space;
    buckets near;
    SL_ARRAY(cover) covers;
    SL_ARRAY(sl_side) sides;
    uint32_t *of_exit; ///< the side of each exit
} outliner;

static uint32_t column(double value, double low, double high, uint32_t across) {
    const double place = (value / 2 - low / 2) / (high / 2 - low / 2) * across;
    return place <= 0 ? 0 : place >= across ? across - 1 : (uint32_t)place;
}

/// The squares that the box of two points meets, columns and rows inclusive.
static void squares_of(const outliner *o, sl_point a, sl_point b, uint32_t out[4]) {
    const sl_box *box = &o->space->bounds;
    const uint32_t across = o->near.across;
    out[0] = column(fmin(a.x, b.x), box->min.x, box->max.x, across);
    out[1] = column(fmax(a.x, b.x), box->min.x, box->max.x, across);
    out[2] = column(fmin(a.y, b.y), box->min.y, box->max.y, across);
    out[3] = column(fmax(a.y, b.y), box->min.y, box->max.y, across);
}

/// Counts the walls of each square into begin[square + 1], or (fill) puts them in their places.
static void deal_walls(outliner *o, bool fill) {
    buckets *n = &o->near;
    for (uint32_t w = 0; w < o->space->wall_count; w++) {
        uint32_t s[4];
        squares_of(o, o->space->walls[w].a, o->space->walls[w].b, s);
        for (uint32_t y = s[2]; y <= s[3]; y++)
            for (uint32_t x = s[0]; x <= s[1]; x++) {
                uint32_t *slot = &n->begin[(size_t)y * n->across + x + !fill];
                if (fill) n->walls[*slot] = w;
                ++*slot;
            }
    }
}

static sl_status make_buckets(sl_context *context, outliner *o) {
    buckets *n = &o->near;
    n->across = (uint32_t)fmin(ceil(sqrt((double)o->space->wall_count)), 1024) + 1;
    const size_t squares = (size_t)n->across * n->across;
    n->begin = sl_alloc_array(context, squares + 1, sizeof *n->begin);
    if (!n->begin) return SL_NO_MEMORY;
    deal_walls(o, false);
    for (size_t i = 0; i < squares; i++) n->begin[i + 1] += n->begin[i];
    n->walls = sl_alloc_array(context, n->begin[squares], sizeof *n->walls);
    if (!n->walls) return SL_NO_MEMORY;
    deal_walls(o, true);
    for (size_t i = squares; i > 0; i--) n->begin[i] = n->begin[i - 1];
    n->begin[0] = 0;
    return SL_OK;
}

static bool same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// Where a point of the line through `from` and `to` lies along it: ascending from one to the
/// other.
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

static sl_status add_cover(sl_context *context, outliner *o, uint32_t wall, sl_point from,
                           sl_point to) {
    const sl_wall *w = &o->space->walls[wall];
    if (sl_orient(w->a, w->b, from) != 0 || sl_orient(w->a, w->b, to) != 0) return SL_OK;
    const double a = along(from, to, w->a), b = along(from, to, w->b);
    cover c = {fmin(a, b), fmax(a, b), a < b ? w->a : w->b, a < b ? w->b : w->a, wall};
    if (c.to <= along(from, to, from) || c.from >= along(from, to, to)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &o->covers, 1));
    o->covers.items[o->covers.count++] = c;
    return SL_OK;
}

static sl_status gather_covers(sl_context *context, outliner *o, sl_point from, sl_point to) {
    const buckets *n = &o->near;
    uint32_t s[4];
    squares_of(o, from, to, s);
    o->covers.count = 0;
    for (uint32_t y = s[2]; y <= s[3]; y++)
        for (uint32_t x = s[0]; x <= s[1]; x++) {
            const size_t square = (size_t)y * n->across + x;
            for (uint32_t i = n->begin[square]; i < n->begin[square + 1]; i++)
                SL_TRY(add_cover(context, o, n->walls[i], from, to));
        }
    if (o->covers.count)
        qsort(o->covers.items, o->covers.count, sizeof *o->covers.items, compare_covers);
    return SL_OK;
}

static sl_status add_side(sl_context *context, outliner *o, sl_point start, uint32_t beyond) {
    SL_TRY(SL_ARRAY_ROOM(context, &o->sides, 1));
    const uint32_t next = (uint32_t)o->sides.count + 1;
    o->sides.items[o->sides.count++] = (sl_side){start, next, beyond};
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

/// Adds the sides of a piece of boundary that has no portal.
static sl_status add_gap(sl_context *context, outliner *o, uint32_t cell, sl_point from,
                         sl_point to) {
    SL_TRY(gather_covers(context, o, from, to));
    sl_point at = from;
    for (size_t i = 0; i < o->covers.count && !same(at, to); i++) {
        const cover *c = &o->covers.items[i];
        if (c->to <= along(from, to, at)) continue;
        if (c->from > along(from, to, at)) {
            SL_TRY(add_border(context, o, cell, at, c->start));
            at = c->start;
        }
        SL_TRY(add_side(context, o, at, SL_SIDE_WALL + c->wall));
        at = c->to < along(from, to, to) ? c->end : to;
    }
    return same(at, to) ? SL_OK : add_border(context, o, cell, at, to);
}

static bool on_edge(sl_point a, sl_point b, sl_point p) {
    return sl_orient(a, b, p) == 0 && along(a, b, p) >= along(a, b, a) &&
           along(a, b, p) <= along(a, b, b);
}

static sl_status outline_cell(sl_context *context, outliner *o, uint32_t cell) {
    const sl_cell *c = &o->space->cells[cell];
    const sl_point *corners = o->space->vertices + c->first_vertex;
    const uint32_t first = (uint32_t)o->sides.count;
    uint32_t exit = c->first_exit;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        sl_point at = corners[i];
        const sl_point end = corners[(i + 1) % c->vertex_count];
        for (; exit < c->first_exit + c->exit_count; exit++) {
            const sl_exit *e = &o->space->exits[exit];
            if (!on_edge(corners[i], end, e->right) || !on_edge(corners[i], end, e->left)) break;
            if (!same(at, e->right)) SL_TRY(add_gap(context, o, cell, at, e->right));
            o->of_exit[exit] = (uint32_t)o->sides.count;
            SL_TRY(add_side(context, o, e->right, 0));
            at = e->left;
        }
        if (!same(at, end)) SL_TRY(add_gap(context, o, cell, at, end));
    }
    if (exit != c->first_exit + c->exit_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell %u: exit %u is not on its boundary", cell,
                       exit - c->first_exit);
    if (o->sides.count > INT32_MAX) return sl_fail_memory(context);
    o->sides.items[o->sides.count - 1].next = first;
    return SL_OK;
}

/// Joins the two sides of each portal.
static sl_status join_portals(sl_context *context, outliner *o) {
    const sl_space *s = o->space;
    uint32_t *one = sl_alloc_array(context, s->portal_count, sizeof *one);
    if (!one) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->portal_count; i++) one[i] = UINT32_MAX;
    for (uint32_t i = 0; i < s->exit_count; i++) {
        const uint32_t portal = s->exits[i].portal, side = o->of_exit[i];
        if (one[portal] == UINT32_MAX) {
            one[portal] = side;
            continue;
        }
        o->sides.items[side].beyond = one[portal];
        o->sides.items[one[portal]].beyond = side;
    }
    sl_free(context, one);
    return SL_OK;
}

static sl_status outline_all(sl_context *context, outliner *o, uint32_t *first) {
    const sl_space *s = o->space;
    SL_TRY(make_buckets(context, o));
    o->of_exit = sl_alloc_array(context, s->exit_count, sizeof *o->of_exit);
    if (!o->of_exit) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        first[i] = (uint32_t)o->sides.count;
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(outline_cell(context, o, i));
    }
    first[s->cell_count] = (uint32_t)o->sides.count;
    return join_portals(context, o);
}

sl_status sl_outline_make(sl_context *context, const sl_space *space, sl_outline *out) {
    outliner o = {.space = space};
    uint32_t *first = sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *first);
    sl_status status = first ? outline_all(context, &o, first) : SL_NO_MEMORY;
    if (status == SL_OK) {
        *out = (sl_outline){space, o.sides.items, first, (uint32_t)o.sides.count};
        o.sides.items = NULL;
        first = NULL;
    }
    sl_free(context, first);
    sl_free(context, o.sides.items);
    sl_free(context, o.near.begin);
    sl_free(context, o.near.walls);
    sl_free(context, o.covers.items);
    sl_free(context, o.of_exit);
    return status;
}

void sl_outline_destroy(sl_context *context, sl_outline *outline) {
    sl_free(context, outline->sides);
    sl_free(context, outline->first);
    *outline = (sl_outline){0};
}
