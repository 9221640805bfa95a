/// Segments become a planar graph, in rounds of two steps, until a round finds nothing:
///
///     weld                 split near an end         split at a crossing
///
///     a----. .----b              .c                  a     d            a     d
///                           a---------b                \ /               \ /
///           |                                           X        ->        o
///           v                    |                     / \               / \.
///                                v                   c     b            c     b
///     a-----c-----b         a----c----b
///
/// 1. Find the pairs of edges that cross, or of which one comes too near to an end of the other.
/// 2. Split the edges at the points found. A crossing gets the nearest representable point.
///
/// A rounded crossing moves an edge a little, and so it may come to cross others. That is why there
/// are rounds. An edge never changes: it is replaced by its parts. So a pair is looked at once.
///
/// Pairs are found by halving: a box is split in the middle of its edges, and edges that run across
/// the middle are cut for the search. A box of few edges compares all of them.
///
/// This is iterated snap rounding (Guibas & Marimont 1998; Halperin & Packer 2002) without a grid:
/// the ends themselves, with a tolerance about each, take the place of the pixels. Time
/// O((n + k) log n) for k crossings, where few edges come near to each other in one place.
#include "map/planar.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

#define NONE UINT32_MAX

enum {
    FEW = 12,         ///< a box with so many pieces is not split further
    MOST_HALVES = 96, ///< boxes within boxes
    MOST_ROUNDS = 64,
    MOST_GROWTH = 16, ///< times the points that ends and the first round's crossings give
};

/// A box is split only if the number of pieces grows by less than this factor.
static const double MOST_CUTS = 1.6;

/// An edge during the work. A replaced one has parts: parts[first .. first + count).
typedef struct working_edge {
    uint32_t a, b;
    uint32_t first, count;
} working_edge;

/// A piece of an edge within a box, in doubles.
typedef struct piece {
    sl_point p, q;
    uint32_t edge;
} piece;

/// An edge, and a point that it must go through.
typedef struct split {
    uint32_t edge, point;
} split;

/// Two edges that cross, and about where.
typedef struct meeting {
    sl_point at;
    uint32_t edges[2];
} meeting;

/// A hash table by open addressing. A slot has 1 + the number of an item, or 0.
typedef struct table {
    uint32_t *slots;
    size_t count; ///< of slots: a power of two
} table;

typedef struct planer {
    sl_context *context;
    const char *source;
    double weld;
    double side;         ///< of a square of the point table
    double scale, slack; ///< of working coordinates: places times scale are at most 1
    SL_ARRAY(sl_point) points;
    SL_ARRAY(working_edge) edges;
    SL_ARRAY(sli_planar_link) parts;
    table of_squares;             ///< the point that was put last into a square
    SL_ARRAY(uint32_t) next_near; ///< by point: 1 + the point before it in its square
    table of_ends;                ///< the edge between two points
    SL_ARRAY(piece) pieces;
    SL_ARRAY(split) splits;
    SL_ARRAY(meeting) meetings;
    size_t most;  ///< of meetings
    uint32_t old; ///< the edges below this number have been compared with each other
} planer;

/// As qsort, where items are often in order already.
static void sort_items(void *items, size_t count, size_t size,
                       int (*compare)(const void *, const void *)) {
    const char *at = items;
    size_t i = 1;
    while (i < count && compare(at + (i - 1) * size, at + i * size) <= 0) i++;
    if (i < count) qsort(items, count, size, compare);
}

// --- hash tables

static uint64_t mix(uint64_t z) {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/// The words that an item is found by.
typedef struct key {
    uint64_t a, b;
} key;

/// The slot of a key, which is 0 where no item has it.
static inline uint32_t *find_slot(const planer *p, const table *t, key k,
                                  key (*key_of)(const planer *, uint32_t item)) {
    size_t slot = (size_t)mix(k.a + 0x9e3779b97f4a7c15u * mix(k.b + 1)) & (t->count - 1);
    while (t->slots[slot]) {
        const key other = key_of(p, t->slots[slot] - 1);
        if (other.a == k.a && other.b == k.b) break;
        slot = (slot + 1) & (t->count - 1);
    }
    return &t->slots[slot];
}

/// Twice as many slots, all empty.
static sl_status grow(sl_context *context, table *t) {
    const size_t count = t->count ? 2 * t->count : 1024;
    uint32_t *slots = sl_alloc_array(context, count, sizeof *slots);
    if (!slots) return SL_NO_MEMORY;
    sl_free(context, t->slots);
    *t = (table){slots, count};
    return SL_OK;
}

// --- points: those within the tolerance are found through squares much larger than it

typedef struct square {
    double x, y;
} square;

/// Without a tolerance, a square is a place.
static square square_of(const planer *p, sl_point at) {
    if (p->weld > 0) return (square){floor(at.x / p->side), floor(at.y / p->side)};
    return (square){at.x, at.y};
}

static key key_of_square(square s) {
    // Equal numbers have equal bits, as -0 becomes 0.
    union {
        double value;
        uint64_t bits;
    } x = {s.x + 0.0}, y = {s.y + 0.0};
    return (key){x.bits, y.bits};
}

static key key_of_point(const planer *p, uint32_t point) {
    return key_of_square(square_of(p, p->points.items[point]));
}

static void enter_point(planer *p, uint32_t point) {
    uint32_t *slot = find_slot(p, &p->of_squares, key_of_point(p, point), key_of_point);
    p->next_near.items[point] = *slot;
    *slot = point + 1;
}

static double distance(sl_point a, sl_point b) {
    return sli_length(a.x - b.x, a.y - b.y);
}

/// A point within the tolerance, and its distance.
typedef struct found_point {
    uint32_t point;
    double distance;
} found_point;

static void find_in_square(const planer *p, sl_point at, square s, found_point *found) {
    const uint32_t *slot = find_slot(p, &p->of_squares, key_of_square(s), key_of_point);
    for (uint32_t n = *slot; n; n = p->next_near.items[n - 1]) {
        const sl_point other = p->points.items[n - 1];
        const double d = sli_same_point(at, other) ? 0
                         : p->weld > 0             ? distance(at, other)
                                                   : HUGE_VAL;
        if (d > p->weld || d > found->distance ||
            (d == found->distance && sli_compare_points(other, p->points.items[found->point]) > 0))
            continue;
        *found = (found_point){n - 1, d};
    }
}

/// The nearest point within the tolerance; NONE for none.
static uint32_t find_point(const planer *p, sl_point at) {
    found_point found = {NONE, HUGE_VAL};
    if (!p->of_squares.count) return NONE;
    const square low = square_of(p, (sl_point){at.x - p->weld, at.y - p->weld});
    const square high = square_of(p, (sl_point){at.x + p->weld, at.y + p->weld});
    for (int i = 0; i <= (high.x > low.x); i++)
        for (int k = 0; k <= (high.y > low.y); k++)
            find_in_square(p, at, (square){i ? high.x : low.x, k ? high.y : low.y}, &found);
    return found.point;
}

/// The point that stands for a place: one within the tolerance, or a new one.
static sl_status take_point(planer *p, sl_point at, uint32_t *out) {
    at = (sl_point){at.x + 0.0, at.y + 0.0}; // one zero
    *out = find_point(p, at);
    if (*out != NONE) return SL_OK;
    if (p->points.count >= INT32_MAX) return sl_fail_memory(p->context);
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->points, 1));
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->next_near, 1));
    *out = (uint32_t)p->points.count++;
    p->next_near.count++;
    p->points.items[*out] = at;
    uint32_t first = *out;
    if (2 * p->points.count > p->of_squares.count) {
        SL_TRY(grow(p->context, &p->of_squares));
        first = 0;
    }
    for (uint32_t i = first; i < p->points.count; i++) enter_point(p, i);
    return SL_OK;
}

// --- edges

static key key_of_edge(const planer *p, uint32_t edge) {
    return (key){p->edges.items[edge].a, p->edges.items[edge].b};
}

static uint32_t *find_edge(const planer *p, uint32_t a, uint32_t b) {
    return find_slot(p, &p->of_ends, (key){a, b}, key_of_edge);
}

static sl_status grow_edges(planer *p) {
    SL_TRY(grow(p->context, &p->of_ends));
    for (uint32_t i = 0; i < p->edges.count; i++)
        *find_edge(p, p->edges.items[i].a, p->edges.items[i].b) = i + 1;
    return SL_OK;
}

/// The edge between two different points, there already or new.
static sl_status take_edge(planer *p, uint32_t from, uint32_t to, sli_planar_link *out) {
    const uint32_t a = from < to ? from : to, b = from < to ? to : from;
    if (2 * (p->edges.count + 1) > p->of_ends.count) SL_TRY(grow_edges(p));
    uint32_t *slot = find_edge(p, a, b);
    if (!*slot) {
        if (p->edges.count >= INT32_MAX) return sl_fail_memory(p->context);
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->edges, 1));
        p->edges.items[p->edges.count++] = (working_edge){.a = a, .b = b};
        *slot = (uint32_t)p->edges.count;
    }
    *out = 2 * (*slot - 1) + (from > to);
    return SL_OK;
}

static bool is_whole(const planer *p, uint32_t edge) {
    return p->edges.items[edge].count == 0;
}

// --- two edges

static bool strictly_between(sl_point a, sl_point b, sl_point v) {
    return a.x != b.x ? (a.x < v.x) == (v.x < b.x) && v.x != a.x && v.x != b.x
                      : (a.y < v.y) == (v.y < b.y) && v.y != a.y && v.y != b.y;
}

/// Whether an edge must go through a point that is none of its ends.
static bool is_near(const planer *p, sl_point a, sl_point b, sl_point v) {
    const double reach = p->weld / 2;
    if (v.x < sli_lesser(a.x, b.x) - reach || v.x > sli_greater(a.x, b.x) + reach ||
        v.y < sli_lesser(a.y, b.y) - reach || v.y > sli_greater(a.y, b.y) + reach)
        return false;
    const double dx = (b.x - a.x) * p->scale, dy = (b.y - a.y) * p->scale;
    const double vx = (v.x - a.x) * p->scale, vy = (v.y - a.y) * p->scale;
    const double length = sli_length(dx, dy);
    const double along = (vx * dx + vy * dy) / length, off = fabs(dx * vy - dy * vx) / length;
    if (reach > 0 && off <= reach * p->scale && along > 0 && along < length) return true;
    return off <= 0x1p-48 * (fabs(vx) + fabs(vy)) + 0x1p-1000 && sli_orient(a, b, v) == 0 &&
           strictly_between(a, b, v);
}

static sl_status add_split(planer *p, uint32_t edge, uint32_t point) {
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->splits, 1));
    p->splits.items[p->splits.count++] = (split){edge, point};
    return SL_OK;
}

/// Splits an edge at those ends of another one that are near to it.
static sl_status split_near(planer *p, uint32_t edge, uint32_t other) {
    const working_edge *e = &p->edges.items[edge], *o = &p->edges.items[other];
    const sl_point a = p->points.items[e->a], b = p->points.items[e->b];
    const uint32_t ends[2] = {o->a, o->b};
    for (int i = 0; i < 2; i++)
        if (ends[i] != e->a && ends[i] != e->b && is_near(p, a, b, p->points.items[ends[i]]))
            SL_TRY(add_split(p, edge, ends[i]));
    return SL_OK;
}

static sl_segment segment_of(const planer *p, uint32_t edge) {
    const working_edge *e = &p->edges.items[edge];
    return (sl_segment){p->points.items[e->a], p->points.items[e->b]};
}

static sl_status add_meeting(planer *p, uint32_t edge, uint32_t other) {
    const uint32_t first = edge < other ? edge : other, second = edge < other ? other : edge;
    const sl_segment s = segment_of(p, first), t = segment_of(p, second);
    const double sx = (s.b.x - s.a.x) * p->scale, sy = (s.b.y - s.a.y) * p->scale;
    const double tx = (t.b.x - t.a.x) * p->scale, ty = (t.b.y - t.a.y) * p->scale;
    const double gx = (t.a.x - s.a.x) * p->scale, gy = (t.a.y - s.a.y) * p->scale;
    const double share = (gx * ty - gy * tx) / (sx * ty - sy * tx);
    const double along = share > 0 ? share < 1 ? share : 1 : 0;
    if (p->meetings.count >= p->most)
        return sl_fail(p->context, SL_UNSUPPORTED, "%s: more than %zu crossings", p->source,
                       p->most);
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->meetings, 1));
    p->meetings.items[p->meetings.count++] = (meeting){
        {s.a.x + along * (s.b.x - s.a.x), s.a.y + along * (s.b.y - s.a.y)}, {first, second}};
    return SL_OK;
}

static sl_status meet(planer *p, uint32_t edge, uint32_t other) {
    const size_t before = p->splits.count;
    SL_TRY(split_near(p, edge, other));
    SL_TRY(split_near(p, other, edge));
    const working_edge *e = &p->edges.items[edge], *o = &p->edges.items[other];
    if (p->splits.count != before || e->a == o->a || e->a == o->b || e->b == o->a || e->b == o->b)
        return SL_OK;
    const sl_point a = p->points.items[e->a], b = p->points.items[e->b];
    const sl_point c = p->points.items[o->a], d = p->points.items[o->b];
    if (sli_orient(a, b, c) * sli_orient(a, b, d) >= 0 ||
        sli_orient(c, d, a) * sli_orient(c, d, b) >= 0)
        return SL_OK;
    return add_meeting(p, edge, other);
}

// --- halving

static bool apart(const planer *p, const piece *s, const piece *t) {
    const double slack = p->slack;
    return sli_greater(s->p.x, s->q.x) + slack < sli_lesser(t->p.x, t->q.x) ||
           sli_greater(t->p.x, t->q.x) + slack < sli_lesser(s->p.x, s->q.x) ||
           sli_greater(s->p.y, s->q.y) + slack < sli_lesser(t->p.y, t->q.y) ||
           sli_greater(t->p.y, t->q.y) + slack < sli_lesser(s->p.y, s->q.y);
}

static sl_status compare_all(planer *p, size_t first, size_t count) {
    for (size_t i = first; i < first + count; i++) {
        if (count > 256) SL_TRY(sl_check_cancelled(p->context));
        for (size_t k = i + 1; k < first + count; k++) {
            const piece *s = &p->pieces.items[i], *t = &p->pieces.items[k];
            if ((s->edge < p->old && t->edge < p->old) || s->edge == t->edge || apart(p, s, t))
                continue;
            SL_TRY(meet(p, s->edge, t->edge));
        }
    }
    return SL_OK;
}

/// Keeps the part of a piece below a place on an axis, or above it, with some slack. False for
/// none.
static bool clip(const planer *p, piece *s, int axis, double at, bool above) {
    const double from = axis ? s->p.y : s->p.x, to = axis ? s->q.y : s->q.x;
    const double border = above ? at - p->slack : at + p->slack;
    const bool from_in = above ? from >= border : from <= border;
    const bool to_in = above ? to >= border : to <= border;
    if (from_in && to_in) return true;
    if (!from_in && !to_in) return false;
    const double share = (border - from) / (to - from);
    const sl_point cut = axis ? (sl_point){s->p.x + share * (s->q.x - s->p.x), border}
                              : (sl_point){border, s->p.y + share * (s->q.y - s->p.y)};
    *(from_in ? &s->q : &s->p) = cut;
    return true;
}

/// Puts the parts of the pieces behind all pieces: first those below a place, then those above.
static sl_status part(planer *p, size_t first, size_t count, int axis, double at, size_t *below) {
    const size_t start = p->pieces.count;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->pieces, 2 * count));
    for (int above = 0; above < 2; above++) {
        for (size_t i = first; i < first + count; i++) {
            piece s = p->pieces.items[i];
            if (clip(p, &s, axis, at, above)) p->pieces.items[p->pieces.count++] = s;
        }
        if (!above) *below = p->pieces.count - start;
    }
    return SL_OK;
}

typedef struct spread {
    double low, high, middle;
} spread;

static spread spread_of(const planer *p, size_t first, size_t count, int axis) {
    spread s = {HUGE_VAL, -HUGE_VAL, 0};
    for (size_t i = first; i < first + count; i++) {
        const piece *at = &p->pieces.items[i];
        const double from = axis ? at->p.y : at->p.x, to = axis ? at->q.y : at->q.x;
        s.low = sli_lesser(s.low, sli_lesser(from, to));
        s.high = sli_greater(s.high, sli_greater(from, to));
        s.middle += (from + to) / 2 / (double)count;
    }
    return s;
}

static bool any_new(const planer *p, size_t first, size_t count) {
    for (size_t i = first; i < first + count; i++)
        if (p->pieces.items[i].edge >= p->old) return true;
    return false;
}

static sl_status halve(planer *p, size_t first, size_t count, int depth) {
    if (count < 2 || !any_new(p, first, count)) return SL_OK;
    if (count <= FEW || depth == MOST_HALVES) return compare_all(p, first, count);
    if (count > 1024) SL_TRY(sl_check_cancelled(p->context));
    const spread x = spread_of(p, first, count, 0), y = spread_of(p, first, count, 1);
    const int wider = y.high - y.low > x.high - x.low;
    const size_t start = p->pieces.count;
    for (int attempt = 0; attempt < 2; attempt++) {
        const int axis = attempt ? !wider : wider;
        size_t below = 0;
        SL_TRY(part(p, first, count, axis, axis ? y.middle : x.middle, &below));
        const size_t above = p->pieces.count - start - below;
        if ((double)(below + above) <= MOST_CUTS * (double)count && below < count &&
            above < count) {
            SL_TRY(halve(p, start, below, depth + 1));
            SL_TRY(halve(p, start + below, above, depth + 1));
            p->pieces.count = start;
            return SL_OK;
        }
        p->pieces.count = start;
    }
    return compare_all(p, first, count);
}

/// Finds the pairs of edges that meet, without those of earlier rounds.
static sl_status find_meetings(planer *p) {
    p->pieces.count = p->splits.count = p->meetings.count = 0;
    for (uint32_t i = 0; i < p->edges.count; i++) {
        if (!is_whole(p, i)) continue;
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->pieces, 1));
        const sl_point a = p->points.items[p->edges.items[i].a];
        const sl_point b = p->points.items[p->edges.items[i].b];
        p->pieces.items[p->pieces.count++] =
            (piece){{a.x * p->scale, a.y * p->scale}, {b.x * p->scale, b.y * p->scale}, .edge = i};
    }
    SL_TRY(sl_check_cancelled(p->context));
    SL_TRY(halve(p, 0, p->pieces.count, 0));
    p->old = (uint32_t)p->edges.count;
    return SL_OK;
}

// --- splitting edges at points

static int compare_meetings(const void *left, const void *right) {
    const meeting *a = left, *b = right;
    const int order = sli_compare_points(a->at, b->at);
    if (order) return order;
    const int i = a->edges[0] == b->edges[0];
    return (a->edges[i] > b->edges[i]) - (a->edges[i] < b->edges[i]);
}

/// The point where two edges cross: one within the tolerance, or the nearest representable one.
static sl_status take_meeting(planer *p, const meeting *m, uint32_t *out) {
    *out = p->weld > 0 ? find_point(p, m->at) : NONE;
    if (*out != NONE) return SL_OK;
    return take_point(p, sli_crossing(segment_of(p, m->edges[0]), segment_of(p, m->edges[1])), out);
}

/// Gives the crossings their points, in the order of places.
static sl_status take_meetings(planer *p) {
    sort_items(p->meetings.items, p->meetings.count, sizeof *p->meetings.items, compare_meetings);
    for (size_t i = 0; i < p->meetings.count; i++) {
        const meeting m = p->meetings.items[i];
        uint32_t point;
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(p->context));
        SL_TRY(take_meeting(p, &m, &point));
        for (int k = 0; k < 2; k++) {
            const working_edge *e = &p->edges.items[m.edges[k]];
            if (e->a != point && e->b != point) SL_TRY(add_split(p, m.edges[k], point));
        }
    }
    return SL_OK;
}

static int compare_splits(const void *left, const void *right) {
    const split *a = left, *b = right;
    if (a->edge != b->edge) return a->edge < b->edge ? -1 : 1;
    return (a->point > b->point) - (a->point < b->point);
}

/// How far along an edge a point is.
static double progress(const planer *p, const working_edge *e, uint32_t point) {
    const sl_point a = p->points.items[e->a], b = p->points.items[e->b];
    const sl_point at = p->points.items[point];
    const double dx = b.x - a.x, dy = b.y - a.y;
    return fabs(dx) >= fabs(dy) ? (dx > 0 ? at.x - a.x : a.x - at.x)
                                : (dy > 0 ? at.y - a.y : a.y - at.y);
}

/// Sorts the few points of one edge along it.
static void sort_along(const planer *p, split *splits, size_t count) {
    const working_edge *e = &p->edges.items[splits->edge];
    for (size_t i = 1; i < count; i++) {
        const split moved = splits[i];
        const double at = progress(p, e, moved.point);
        size_t k = i;
        for (; k && progress(p, e, splits[k - 1].point) > at; k--) splits[k] = splits[k - 1];
        splits[k] = moved;
    }
}

static sl_status split_edge(planer *p, const split *splits, size_t count) {
    const uint32_t edge = splits->edge, last = p->edges.items[edge].b;
    const size_t first = p->parts.count;
    uint32_t from = p->edges.items[edge].a;
    for (size_t i = 0; i <= count; i++) {
        const uint32_t to = i < count ? splits[i].point : last;
        if (to == from) continue;
        sli_planar_link link;
        SL_TRY(take_edge(p, from, to, &link));
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->parts, 1));
        p->parts.items[p->parts.count++] = link;
        from = to;
    }
    if (p->parts.count > UINT32_MAX) return sl_fail_memory(p->context);
    p->edges.items[edge].first = (uint32_t)first;
    p->edges.items[edge].count = (uint32_t)(p->parts.count - first);
    return SL_OK;
}

static sl_status split_all(planer *p) {
    sort_items(p->splits.items, p->splits.count, sizeof *p->splits.items, compare_splits);
    size_t kept = 0; // each once
    for (size_t i = 0; i < p->splits.count; i++)
        if (!kept || compare_splits(&p->splits.items[kept - 1], &p->splits.items[i]) != 0)
            p->splits.items[kept++] = p->splits.items[i];
    p->splits.count = kept;
    for (size_t i = 0, done = 0; i < kept; done++) {
        size_t end = i;
        if (done % 4096 == 0) SL_TRY(sl_check_cancelled(p->context));
        while (end < kept && p->splits.items[end].edge == p->splits.items[i].edge) end++;
        sort_along(p, &p->splits.items[i], end - i);
        SL_TRY(split_edge(p, &p->splits.items[i], end - i));
        i = end;
    }
    return SL_OK;
}

static sl_status fail_endless(const planer *p) {
    sl_point at = {0, 0};
    if (p->meetings.count)
        at = p->meetings.items[0].at;
    else if (p->splits.count)
        at = p->points.items[p->splits.items[0].point];
    return sl_fail(p->context, SL_UNSUPPORTED,
                   "%s: walls near %.17g %.17g cross again each time that their crossing is "
                   "rounded; weld ends with a larger tolerance than %g (--weld)",
                   p->source, at.x, at.y, p->weld);
}

/// Rounds, until one finds nothing. Without a tolerance a round may find more than the one before.
static sl_status settle(planer *p) {
    size_t most = SIZE_MAX;
    for (int round = 0; round < MOST_ROUNDS && p->points.count <= most; round++) {
        SL_TRY(find_meetings(p));
        if (!p->splits.count && !p->meetings.count) return SL_OK;
        if (round == 0) most = MOST_GROWTH * (p->points.count + p->meetings.count);
        SL_TRY(take_meetings(p));
        if (!p->splits.count) break;
        SL_TRY(split_all(p));
    }
    return fail_endless(p);
}

// --- from segments to edges

static int compare_for_qsort(const void *left, const void *right) {
    return sli_compare_points(*(const sl_point *)left, *(const sl_point *)right);
}

/// Takes all ends in the order of places, so that the order of the input does not matter.
static sl_status take_ends(planer *p, const sl_segment *segments, size_t count) {
    sl_point *ends = sl_alloc_array(p->context, 2 * count, sizeof *ends);
    if (!ends) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        ends[2 * i] = segments[i].a;
        ends[2 * i + 1] = segments[i].b;
    }
    sort_items(ends, 2 * count, sizeof *ends, compare_for_qsort);
    sl_status status = SL_OK;
    uint32_t point;
    for (size_t i = 0; i < 2 * count && status == SL_OK; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(p->context);
        if (status == SL_OK) status = take_point(p, ends[i], &point);
    }
    sl_free(p->context, ends);
    return status;
}

static int compare_edges(const void *left, const void *right) {
    const sli_planar_edge *a = left, *b = right;
    if (a->a != b->a) return a->a < b->a ? -1 : 1;
    return (a->b > b->b) - (a->b < b->b);
}

/// Takes the edges between the segments' points, in the order of places. So the numbers of points
/// and edges, and all that follows from them, do not depend on the order of the input.
static sl_status take_edges(planer *p, const sli_planar_edge *ends, size_t count) {
    sli_planar_edge *sorted = sl_alloc_array(p->context, count, sizeof *sorted);
    if (!sorted) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const uint32_t a = ends[i].a, b = ends[i].b;
        sorted[i] = a < b ? ends[i] : (sli_planar_edge){b, a};
    }
    sort_items(sorted, count, sizeof *sorted, compare_edges);
    sl_status status = SL_OK;
    sli_planar_link link;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(p->context);
        if (status == SL_OK && sorted[i].a != sorted[i].b)
            status = take_edge(p, sorted[i].a, sorted[i].b, &link);
    }
    sl_free(p->context, sorted);
    return status;
}

/// The link of each segment before it is split; NONE for a segment of no length.
static sl_status take_segments(planer *p, const sl_segment *segments, size_t count,
                               sli_planar_link *roots, size_t *welded) {
    sli_planar_edge *ends = sl_alloc_array(p->context, count, sizeof *ends);
    if (!ends) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        ends[i] = (sli_planar_edge){find_point(p, segments[i].a), find_point(p, segments[i].b)};
        *welded += !sli_same_point(p->points.items[ends[i].a], segments[i].a);
        *welded += !sli_same_point(p->points.items[ends[i].b], segments[i].b);
    }
    sl_status status = sl_check_cancelled(p->context);
    if (status == SL_OK) status = take_edges(p, ends, count);
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        roots[i] = NONE;
        if (ends[i].a != ends[i].b) status = take_edge(p, ends[i].a, ends[i].b, &roots[i]);
    }
    sl_free(p->context, ends);
    return status;
}

// --- from edges to the graph

/// The graph that is handed over.
typedef struct writer {
    planer *p;
    const sl_segment *segments;
    sli_planar *out;
    uint32_t *number; ///< the new one: by point, then by edge
    SL_ARRAY(sli_planar_link) links;
    SL_ARRAY(sli_planar_link) waiting;
} writer;

static void turn_round(sli_planar_link *links, size_t count) {
    for (size_t i = 0; i < count / 2; i++) {
        const sli_planar_link link = links[i];
        links[i] = links[count - 1 - i];
        links[count - 1 - i] = link;
    }
}

/// Adds the edges that a link has become.
static sl_status add_links(writer *w, sli_planar_link link) {
    w->waiting.count = 0;
    SL_TRY(SL_ARRAY_ROOM(w->p->context, &w->waiting, 1));
    w->waiting.items[w->waiting.count++] = link;
    while (w->waiting.count) {
        const sli_planar_link at = w->waiting.items[--w->waiting.count];
        const working_edge *e = &w->p->edges.items[at / 2];
        if (!e->count) {
            SL_TRY(SL_ARRAY_ROOM(w->p->context, &w->links, 1));
            w->links.items[w->links.count++] = at;
            continue;
        }
        SL_TRY(SL_ARRAY_ROOM(w->p->context, &w->waiting, e->count));
        sli_planar_link *top = w->waiting.items + w->waiting.count;
        for (uint32_t i = 0; i < e->count; i++) top[i] = w->p->parts.items[e->first + i] ^ (at % 2);
        // The first one to go along must be the last on the stack.
        if (at % 2 == 0) turn_round(top, e->count);
        w->waiting.count += e->count;
    }
    return SL_OK;
}

/// The distance of a point from a segment whose ends are in order, rounded up.
static double distance_to(const sl_segment *s, sl_point v) {
    const double dx = s->b.x - s->a.x, dy = s->b.y - s->a.y, length = sli_length(dx, dy);
    const double vx = v.x - s->a.x, vy = v.y - s->a.y, error = 0x1p-50 * (fabs(vx) + fabs(vy));
    if (sli_same_point(v, s->a) || sli_same_point(v, s->b)) return 0;
    if (length == 0) return distance(v, s->a) + error;
    const double along = vx * (dx / length) + vy * (dy / length);
    if (along <= 0) return distance(v, s->a) + error;
    if (along >= length) return distance(v, s->b) + error;
    if (sli_orient(s->a, s->b, v) == 0) return 0;
    return fabs(dx / length * vy - dy / length * vx) + error;
}

static void measure(writer *w, sl_segment s, size_t from) {
    if (sli_compare_points(s.a, s.b) > 0) s = (sl_segment){s.b, s.a};
    for (size_t i = from; i < w->links.count; i++) {
        const working_edge *e = &w->p->edges.items[w->links.items[i] / 2];
        const uint32_t ends[2] = {e->a, e->b};
        for (int k = 0; k < 2; k++) {
            const double move = distance_to(&s, w->p->points.items[ends[k]]);
            if (move > w->out->largest_move) w->out->largest_move = move;
        }
    }
}

static sl_status write_chains(writer *w, const sli_planar_link *roots, size_t count) {
    SL_TRY(SL_ARRAY_ROOM(w->p->context, &w->links, 1)); // a place to point to, without a link too
    for (size_t i = 0; i < count; i++) {
        w->out->first[i] = w->links.count;
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(w->p->context));
        if (roots[i] == NONE) continue;
        SL_TRY(add_links(w, roots[i]));
        measure(w, w->segments[i], w->out->first[i]);
    }
    w->out->first[count] = w->links.count;
    return SL_OK;
}

typedef struct numbered {
    sl_point at;
    uint32_t was;
} numbered;

static int compare_numbered(const void *left, const void *right) {
    const numbered *a = left, *b = right;
    return sli_compare_points(a->at, b->at);
}

/// Hands over the points at the ends of edges, sorted.
static sl_status write_points(writer *w) {
    planer *p = w->p;
    numbered *used = sl_alloc_array(p->context, p->points.count, sizeof *used);
    if (!used) return SL_NO_MEMORY;
    size_t count = 0;
    for (size_t i = 0; i < p->points.count; i++) w->number[i] = NONE;
    for (size_t i = 0; i < p->edges.count; i++) {
        const uint32_t ends[2] = {p->edges.items[i].a, p->edges.items[i].b};
        for (int k = 0; k < 2 && is_whole(p, (uint32_t)i); k++) w->number[ends[k]] = 0;
    }
    for (uint32_t i = 0; i < p->points.count; i++)
        if (w->number[i] != NONE) used[count++] = (numbered){p->points.items[i], i};
    sort_items(used, count, sizeof *used, compare_numbered);
    w->out->points = sl_alloc_array(p->context, count, sizeof *w->out->points);
    for (size_t i = 0; i < count && w->out->points; i++) {
        w->out->points[i] = used[i].at;
        w->number[used[i].was] = (uint32_t)i;
    }
    w->out->point_count = count;
    sl_free(p->context, used);
    return w->out->points ? SL_OK : SL_NO_MEMORY;
}

/// Hands over the edges that were not replaced, with the new numbers of points.
static sl_status write_edges(writer *w) {
    planer *p = w->p;
    uint32_t *number = w->number + p->points.count;
    size_t count = 0;
    w->out->edges = sl_alloc_array(p->context, p->edges.count, sizeof *w->out->edges);
    if (!w->out->edges) return SL_NO_MEMORY;
    for (size_t i = 0; i < p->edges.count; i++) {
        if (!is_whole(p, (uint32_t)i)) continue;
        const uint32_t a = w->number[p->edges.items[i].a], b = w->number[p->edges.items[i].b];
        number[i] = (uint32_t)(2 * count + (a > b));
        w->out->edges[count++] = (sli_planar_edge){a < b ? a : b, a < b ? b : a};
    }
    w->out->edge_count = count;
    for (size_t i = 0; i < w->links.count; i++)
        w->links.items[i] = number[w->links.items[i] / 2] ^ (w->links.items[i] % 2);
    w->out->links = w->links.items;
    w->links.items = NULL;
    return SL_OK;
}

static sl_status write(planer *p, const sl_segment *segments, const sli_planar_link *roots,
                       size_t count, sli_planar *out) {
    writer w = {.p = p, .segments = segments, .out = out};
    w.number = sl_alloc_array(p->context, p->points.count + p->edges.count, sizeof *w.number);
    out->first = sl_alloc_array(p->context, count + 1, sizeof *out->first);
    sl_status status = w.number && out->first ? write_chains(&w, roots, count) : SL_NO_MEMORY;
    if (status == SL_OK) status = write_points(&w);
    if (status == SL_OK) status = write_edges(&w);
    sl_free(p->context, w.number);
    sl_free(p->context, w.links.items);
    sl_free(p->context, w.waiting.items);
    return status;
}

// --- all of it

static double magnitude(const sl_segment *segments, size_t count) {
    double most = 0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fmax(fabs(segments[i].a.x), fabs(segments[i].a.y)));
        most = fmax(most, fmax(fabs(segments[i].b.x), fabs(segments[i].b.y)));
    }
    return most;
}

double sli_planar_tolerance(const sl_box *b) {
    const double most =
        fmax(fmax(fabs(b->min.x), fabs(b->min.y)), fmax(fabs(b->max.x), fabs(b->max.y)));
    return 0x1p-46 * most;
}

static sl_status make(planer *p, const sl_segment *segments, size_t count, sli_planar *out) {
    sli_planar_link *roots = sl_alloc_array(p->context, count, sizeof *roots);
    if (!roots) return SL_NO_MEMORY;
    sl_status status = take_ends(p, segments, count);
    if (status == SL_OK) status = take_segments(p, segments, count, roots, &out->welded);
    const size_t ends = p->points.count;
    if (status == SL_OK) status = settle(p);
    out->crossings = p->points.count - ends;
    if (status == SL_OK) status = write(p, segments, roots, count, out);
    sl_free(p->context, roots);
    return status;
}

sl_status sli_planar_make(sl_context *context, const char *source, const sl_segment *segments,
                          size_t count, double weld, sli_planar *out) {
    return sli_planar_make_up_to(context, source, segments, count, weld, SIZE_MAX, out);
}

sl_status sli_planar_make_up_to(sl_context *context, const char *source, const sl_segment *segments,
                                size_t count, double weld, size_t most, sli_planar *out) {
    int exponent = 0;
    frexp(magnitude(segments, count), &exponent);
    planer p = {.context = context,
                .source = source,
                .weld = weld,
                .scale = ldexp(1, -exponent),
                .most = most};
    // A tolerance far below rounding counts as none: doubles must hold the numbers of squares.
    if (!(weld * p.scale >= 0x1p-50)) p.weld = 0;
    p.side = 64 * p.weld;
    p.slack = 4 * p.weld * p.scale + 0x1p-46;
    sli_planar made = {0};
    const sl_status status = make(&p, segments, count, &made);
    sl_free(context, p.points.items);
    sl_free(context, p.edges.items);
    sl_free(context, p.parts.items);
    sl_free(context, p.of_squares.slots);
    sl_free(context, p.of_ends.slots);
    sl_free(context, p.next_near.items);
    sl_free(context, p.pieces.items);
    sl_free(context, p.splits.items);
    sl_free(context, p.meetings.items);
    if (status == SL_OK)
        *out = made;
    else
        sli_planar_destroy(context, &made);
    return status;
}

void sli_planar_destroy(sl_context *context, sli_planar *planar) {
    sl_free(context, planar->points);
    sl_free(context, planar->edges);
    sl_free(context, planar->links);
    sl_free(context, planar->first);
    *planar = (sli_planar){0};
}
