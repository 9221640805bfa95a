/// The shapes of view cells: the outlines of what their elementary cells cover together.
///
/// Each side of an elementary cell lies on the split that made it. All ends of sides on one split
/// cut all of these sides, so that neighbours share their pieces, and a piece inside a view cell is
/// there twice, once each way:
///
///        +-----+-----+          +-----+-----+
///        |     | ^ | |          |           |
///        |  A  | | v |    =>    |           |     what is left of A and B after the
///        |     | | B |          |           |     pieces between them have cancelled
///        +-----+-----+          +-----+-----+
///
/// What does not cancel bounds the view cell, with its ground at the left. From each piece the
/// outline goes on with the next one clockwise about its end, so it stays on the ground that it
/// bounds. An outline that comes back to a point of its own is cut there. Rings that then go
/// counter-clockwise are outer ones, the others are holes of the smallest ring around them.
///
/// Invariant: the pieces of a cell form closed rings, and stay so when pairs cancel. Rounded ends
/// on oblique splits that are equal along the split are one point. O(n log n) but for the holes.
#include "geometry/orient.h"
#include "study/view_cells/view_cell_tree.h"

#include <stdlib.h>
#include <string.h>

/// An end of a side, by its place along the split.
typedef struct stop {
    uint32_t node, point;
    double at;
} stop;

/// A piece of the boundary of a view cell, with the cell at its left.
typedef struct piece {
    uint32_t cell, from, to;
    bool used;
} piece;

typedef struct ring {
    size_t first;
    uint32_t count, cell;
    double area;    ///< positive: an outer ring
    uint32_t outer; ///< of a hole: its ring
} ring;

typedef struct shaper {
    sl_context *context;
    const sl_view_tree *tree;
    SL_ARRAY(sl_point) points; ///< ascending, each once
    uint32_t *joined;          ///< by point: one that stands for it, maybe through others
    uint32_t *place;           ///< by point: where it is on the way so far; UINT32_MAX: nowhere
    SL_ARRAY(stop) stops;
    SL_ARRAY(piece) pieces;
    SL_ARRAY(uint32_t) way;     ///< of the outline that is followed
    SL_ARRAY(uint32_t) corners; ///< of rings
    SL_ARRAY(ring) rings;
} shaper;

// --- points

static int compare_points(const void *left, const void *right) {
    const sl_point *a = left, *b = right;
    return sli_compare_points(*a, *b);
}

static uint32_t number_of(const shaper *s, sl_point p) {
    const sl_point *found = bsearch(&p, s->points.items, s->points.count, sizeof p, compare_points);
    return (uint32_t)(found - s->points.items);
}

static uint32_t find(const shaper *s, uint32_t point) {
    while (s->joined[point] != point) point = s->joined[point];
    return point;
}

static sl_point at(const shaper *s, uint32_t point) {
    return s->points.items[point];
}

static sl_status gather_points(shaper *s) {
    const sl_view_tree *tree = s->tree;
    const uint32_t all = tree->first[tree->cell_count];
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->points, all));
    if (all) {
        memcpy(s->points.items, tree->corners, all * sizeof *tree->corners);
        qsort(s->points.items, all, sizeof *s->points.items, compare_points);
    }
    for (uint32_t i = 0; i < all; i++)
        if (!i || !sli_same_point(s->points.items[i], s->points.items[s->points.count - 1]))
            s->points.items[s->points.count++] = s->points.items[i];
    s->joined = sl_alloc_array(s->context, s->points.count, sizeof *s->joined);
    s->place = sl_alloc_array(s->context, s->points.count, sizeof *s->place);
    if (!s->joined || !s->place) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->points.count; i++) {
        s->joined[i] = i;
        s->place[i] = UINT32_MAX;
    }
    return SL_OK;
}

// --- sides and their pieces

static int compare_stops(const void *left, const void *right) {
    const stop *a = left, *b = right;
    if (a->node != b->node) return a->node < b->node ? -1 : 1;
    if (a->at != b->at) return a->at < b->at ? -1 : 1;
    return (a->point > b->point) - (a->point < b->point);
}

static sl_point corner_behind(const sl_view_tree *tree, uint32_t cell, uint32_t i) {
    return tree->corners[i + 1 < tree->first[cell + 1] ? i + 1 : tree->first[cell]];
}

/// All ends on all splits, each once. Those that are equal along a split become one point.
static sl_status gather_stops(shaper *s) {
    const sl_view_tree *tree = s->tree;
    for (uint32_t cell = 0; cell < tree->cell_count; cell++)
        for (uint32_t i = tree->first[cell]; i < tree->first[cell + 1]; i++) {
            const sl_point ends[2] = {tree->corners[i], corner_behind(tree, cell, i)};
            if (tree->edges[i] == UINT32_MAX) continue;
            SL_TRY(SL_ARRAY_ROOM(s->context, &s->stops, 2));
            for (int k = 0; k < 2; k++)
                s->stops.items[s->stops.count++] =
                    (stop){tree->edges[i], number_of(s, ends[k]),
                           sli_view_along(tree, &tree->nodes[tree->edges[i]], ends[k])};
        }
    if (!s->stops.count) return SL_OK;
    qsort(s->stops.items, s->stops.count, sizeof *s->stops.items, compare_stops);
    size_t kept = 1;
    for (size_t i = 1; i < s->stops.count; i++) {
        const stop *last = &s->stops.items[kept - 1], *next = &s->stops.items[i];
        if (next->node != last->node || next->at != last->at) {
            s->stops.items[kept++] = *next;
            continue;
        }
        const uint32_t a = find(s, last->point), b = find(s, next->point);
        s->joined[a > b ? a : b] = a > b ? b : a;
    }
    s->stops.count = kept;
    return SL_OK;
}

static sl_status add_piece(shaper *s, uint32_t cell, uint32_t from, uint32_t to) {
    from = find(s, from);
    to = find(s, to);
    if (from == to) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->pieces, 1));
    s->pieces.items[s->pieces.count++] = (piece){cell, from, to, false};
    return SL_OK;
}

static size_t find_stop(const shaper *s, uint32_t node, double place) {
    size_t low = 0, high = s->stops.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const stop *m = &s->stops.items[middle];
        if (m->node < node || (m->node == node && m->at < place))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// The pieces of a side, from stop to stop.
static sl_status add_side(shaper *s, uint32_t view_cell, uint32_t node, sl_point p, sl_point q) {
    if (node == UINT32_MAX) return add_piece(s, view_cell, number_of(s, p), number_of(s, q));
    const double from = sli_view_along(s->tree, &s->tree->nodes[node], p);
    const double to = sli_view_along(s->tree, &s->tree->nodes[node], q);
    const size_t first = find_stop(s, node, from), last = find_stop(s, node, to);
    for (size_t i = first; i != last;) {
        const size_t next = first < last ? i + 1 : i - 1;
        SL_TRY(add_piece(s, view_cell, s->stops.items[i].point, s->stops.items[next].point));
        i = next;
    }
    return SL_OK;
}

static sl_status gather_pieces(shaper *s, const uint32_t *view_cells) {
    const sl_view_tree *tree = s->tree;
    for (uint32_t cell = 0; cell < tree->cell_count; cell++)
        for (uint32_t i = tree->first[cell]; i < tree->first[cell + 1]; i++)
            SL_TRY(add_side(s, view_cells[cell], tree->edges[i], tree->corners[i],
                            corner_behind(tree, cell, i)));
    return SL_OK;
}

/// Pieces of one cell between the same two points stand together, those of one direction first.
static int compare_pairs(const void *left, const void *right) {
    const piece *a = left, *b = right;
    const uint32_t low_a = a->from < a->to ? a->from : a->to, high_a = a->from ^ a->to ^ low_a;
    const uint32_t low_b = b->from < b->to ? b->from : b->to, high_b = b->from ^ b->to ^ low_b;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    if (low_a != low_b) return low_a < low_b ? -1 : 1;
    if (high_a != high_b) return high_a < high_b ? -1 : 1;
    return (a->from > b->from) - (a->from < b->from);
}

static int compare_starts(const void *left, const void *right) {
    const piece *a = left, *b = right;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return (a->to > b->to) - (a->to < b->to);
}

static bool is_reversed(const piece *a, const piece *b) {
    return a->cell == b->cell && a->from == b->to && a->to == b->from;
}

/// Drops pieces that are there both ways.
static void cancel(shaper *s) {
    size_t kept = 0;
    if (s->pieces.count)
        qsort(s->pieces.items, s->pieces.count, sizeof *s->pieces.items, compare_pairs);
    for (size_t i = 0; i < s->pieces.count; i++) {
        if (kept && is_reversed(&s->pieces.items[kept - 1], &s->pieces.items[i]))
            kept--;
        else
            s->pieces.items[kept++] = s->pieces.items[i];
    }
    s->pieces.count = kept;
    if (kept) qsort(s->pieces.items, kept, sizeof *s->pieces.items, compare_starts);
}

// --- outlines

/// How far clockwise about a point `to` is from `back`, in classes: 0 less than half a turn.
static int turn_class(sl_point about, sl_point back, sl_point to) {
    const int side = sli_orient(about, back, to);
    if (side) return side < 0 ? 0 : 2;
    const bool same =
        (back.x - about.x) * (to.x - about.x) > 0 || (back.y - about.y) * (to.y - about.y) > 0;
    return same ? 3 : 1;
}

/// Whether a comes before b, going clockwise about a point from `back`.
static bool is_before(sl_point about, sl_point back, sl_point a, sl_point b) {
    const int class_a = turn_class(about, back, a), class_b = turn_class(about, back, b);
    return class_a != class_b ? class_a < class_b : sli_orient(about, a, b) < 0;
}

/// The piece that the outline goes on with; NULL where it ends.
static piece *find_next(shaper *s, const piece *last) {
    size_t low = 0, high = s->pieces.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const piece *m = &s->pieces.items[middle];
        if (m->cell < last->cell || (m->cell == last->cell && m->from < last->to))
            low = middle + 1;
        else
            high = middle;
    }
    piece *best = NULL;
    for (; low < s->pieces.count; low++) {
        piece *p = &s->pieces.items[low];
        if (p->cell != last->cell || p->from != last->to) break;
        if (!p->used &&
            (!best || is_before(at(s, p->from), at(s, last->from), at(s, p->to), at(s, best->to))))
            best = p;
    }
    return best;
}

/// Makes a ring of the end of the way, from `first` on. Corners of 180 degrees are left out.
static sl_status add_ring(shaper *s, size_t first, uint32_t cell) {
    const size_t count = s->way.count - first;
    const uint32_t *way = s->way.items + first;
    ring made = {.first = s->corners.count, .cell = cell};
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->corners, count));
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->rings, 1));
    for (size_t i = 0; i < count; i++) {
        const sl_point before = at(s, way[(i + count - 1) % count]), p = at(s, way[i]);
        const sl_point behind = at(s, way[(i + 1) % count]), base = at(s, way[0]);
        if (sli_orient(before, p, behind) != 0)
            s->corners.items[made.first + made.count++] = way[i];
        made.area += (p.x - base.x) * (behind.y - base.y) - (behind.x - base.x) * (p.y - base.y);
    }
    s->way.count = first;
    if (made.count < 3 || made.area == 0) return SL_OK;
    s->corners.count += made.count;
    s->rings.items[s->rings.count++] = made;
    return SL_OK;
}

/// Takes a point into the way. Where the way was there before, it cuts the ring between off.
static sl_status step(shaper *s, uint32_t point, uint32_t cell) {
    if (s->place[point] != UINT32_MAX) {
        const size_t first = s->place[point];
        for (size_t i = first; i < s->way.count; i++) s->place[s->way.items[i]] = UINT32_MAX;
        SL_TRY(add_ring(s, first, cell));
    }
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->way, 1));
    s->place[point] = (uint32_t)s->way.count;
    s->way.items[s->way.count++] = point;
    return SL_OK;
}

static sl_status follow_outlines(shaper *s) {
    for (size_t i = 0; i < s->pieces.count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(s->context));
        for (piece *p = &s->pieces.items[i]; p && !p->used; p = find_next(s, p)) {
            p->used = true;
            if (!s->way.count) SL_TRY(step(s, p->from, p->cell));
            SL_TRY(step(s, p->to, p->cell));
        }
        for (size_t k = 0; k < s->way.count; k++) s->place[s->way.items[k]] = UINT32_MAX;
        s->way.count = 0;
    }
    return SL_OK;
}

// --- holes

/// 1 inside a ring, 0 on it, -1 outside. Exact.
static int side_of(const shaper *s, const ring *r, sl_point p) {
    bool inside = false;
    for (uint32_t i = 0; i < r->count; i++) {
        const sl_point a = at(s, s->corners.items[r->first + i]);
        const sl_point b = at(s, s->corners.items[r->first + (i + 1) % r->count]);
        const int side = sli_orient(a, b, p);
        if (side == 0 && p.x >= fmin(a.x, b.x) && p.x <= fmax(a.x, b.x) && p.y >= fmin(a.y, b.y) &&
            p.y <= fmax(a.y, b.y))
            return 0;
        if ((a.y <= p.y) != (b.y <= p.y) && (side > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside ? 1 : -1;
}

static bool is_around(const shaper *s, const ring *outer, const ring *hole) {
    for (uint32_t i = 0; i < hole->count; i++) {
        const int side = side_of(s, outer, at(s, s->corners.items[hole->first + i]));
        if (side) return side > 0;
    }
    return true;
}

/// Outer rings stand before holes, by cell.
static int compare_rings(const void *left, const void *right) {
    const ring *a = left, *b = right;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    if ((a->area > 0) != (b->area > 0)) return a->area > 0 ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

static void find_outer_rings(shaper *s) {
    size_t first = 0;
    if (s->rings.count)
        qsort(s->rings.items, s->rings.count, sizeof *s->rings.items, compare_rings);
    for (size_t i = 0; i < s->rings.count; i++) {
        ring *r = &s->rings.items[i];
        if (r->cell != s->rings.items[first].cell) first = i;
        r->outer = UINT32_MAX;
        for (size_t k = first; r->area < 0 && k < i; k++) {
            const ring *other = &s->rings.items[k];
            const bool smaller =
                r->outer == UINT32_MAX || other->area < s->rings.items[r->outer].area;
            if (other->area > 0 && smaller && is_around(s, other, r)) r->outer = (uint32_t)k;
        }
    }
}

// --- the result

static void put_ring(const shaper *s, const ring *r, sl_shapes *out, uint32_t *ring_count) {
    uint32_t count = out->rings[*ring_count];
    for (uint32_t i = 0; i < r->count; i++)
        out->points[count++] = at(s, s->corners.items[r->first + i]);
    out->rings[++*ring_count] = count;
}

static void put_polygon(const shaper *s, size_t outer, sl_shapes *out, uint32_t *ring_count) {
    const ring *rings = s->rings.items;
    put_ring(s, &rings[outer], out, ring_count);
    for (size_t i = outer + 1; i < s->rings.count && rings[i].cell == rings[outer].cell; i++)
        if (rings[i].outer == outer) put_ring(s, &rings[i], out, ring_count);
}

static sl_status put_shapes(const shaper *s, uint32_t count, sl_shapes *out) {
    uint32_t polygons = 0, rings = 0;
    size_t next = 0;
    out->count = count;
    out->points = sl_alloc_array(s->context, s->corners.count, sizeof *out->points);
    out->rings = sl_alloc_array(s->context, s->rings.count + 1, sizeof *out->rings);
    out->polygons = sl_alloc_array(s->context, s->rings.count + 1, sizeof *out->polygons);
    out->shapes = sl_alloc_array(s->context, (size_t)count + 1, sizeof *out->shapes);
    if (!out->points || !out->rings || !out->polygons || !out->shapes) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < count; cell++) {
        for (; next < s->rings.count && s->rings.items[next].cell == cell; next++) {
            if (s->rings.items[next].area < 0) continue;
            put_polygon(s, next, out, &rings);
            out->polygons[++polygons] = rings;
        }
        out->shapes[cell + 1] = polygons;
    }
    return SL_OK;
}

static sl_status make(shaper *s, const uint32_t *view_cells, uint32_t count, sl_shapes *out) {
    SL_TRY(gather_points(s));
    SL_TRY(gather_stops(s));
    SL_TRY(gather_pieces(s, view_cells));
    cancel(s);
    SL_TRY(follow_outlines(s));
    find_outer_rings(s);
    return put_shapes(s, count, out);
}

sl_status sl_view_shapes(sl_context *context, const sl_view_tree *tree, const uint32_t *view_cells,
                         uint32_t count, sl_shapes *out) {
    shaper s = {.context = context, .tree = tree};
    sl_shapes made = {0};
    const sl_status status = make(&s, view_cells, count, &made);
    if (status == SL_OK)
        *out = made;
    else
        sl_view_shapes_destroy(context, &made);
    sl_free(context, s.points.items);
    sl_free(context, s.joined);
    sl_free(context, s.place);
    sl_free(context, s.stops.items);
    sl_free(context, s.pieces.items);
    sl_free(context, s.way.items);
    sl_free(context, s.corners.items);
    sl_free(context, s.rings.items);
    return status;
}

void sl_view_shapes_destroy(sl_context *context, sl_shapes *shapes) {
    sl_free(context, shapes->points);
    sl_free(context, shapes->rings);
    sl_free(context, shapes->polygons);
    sl_free(context, shapes->shapes);
    *shapes = (sl_shapes){0};
}
