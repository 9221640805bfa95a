// Depth-first over every sequence, as by_sequences.c, with what effects ask of one.
#include "oracle/effects.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

enum { DEEPEST = 64, ANGLES = 1440 };

typedef struct search {
    const sl_space *space;
    const sl_map *map;
    sl_sight sight;
    uint32_t depth;
    uint64_t left;
    oracle_sequence *sequence;
    oracle_portal portals[DEEPEST]; ///< of the sequence, where mirrored space has them
    size_t count;
    uint32_t mirrors[DEEPEST]; ///< crossed so far
    uint32_t mirror_count;
    uint32_t source;
    oracle_ways *out;
} search;

static double cross(sl_point a, sl_point b, sl_point p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

static bool holds(sl_segment s, sl_point p) {
    return cross(s.a, s.b, p) == 0 &&
           (p.x - s.a.x) * (p.x - s.b.x) + (p.y - s.a.y) * (p.y - s.b.y) <= 0;
}

static bool covers(sl_segment s, oracle_portal p) {
    return holds(s, p.left) && holds(s, p.right);
}

static sl_point reflect(sl_segment mirror, sl_point p) {
    if (mirror.a.x == mirror.b.x) return (sl_point){2 * mirror.a.x - p.x, p.y};
    return (sl_point){p.x, 2 * mirror.a.y - p.y};
}

/// Behind the mirrors crossed so far: the last one reflects first.
static sl_point unfold_point(const search *s, sl_point p) {
    for (uint32_t i = s->mirror_count; i-- > 0;)
        p = reflect(s->map->mirrors[s->mirrors[i]].segment, p);
    return p;
}

static oracle_portal unfold(const search *s, oracle_portal p) {
    const sl_point l = unfold_point(s, p.left), r = unfold_point(s, p.right);
    return s->mirror_count % 2 ? (oracle_portal){r, l} : (oracle_portal){l, r};
}

// --- lengths

/// Where the line from `at` in direction (dx, dy) crosses a portal, as a factor of the direction.
static double crossing(sl_point at, double dx, double dy, oracle_portal p, bool *parallel) {
    const double ex = p.left.x - p.right.x, ey = p.left.y - p.right.y;
    const double across = dx * ey - dy * ex;
    *parallel = fabs(across) < 1e-12;
    return ((p.right.x - at.x) * ey - (p.right.y - at.y) * ex) / across;
}

static bool passes(const search *s, sl_point at, double dx, double dy) {
    const double slack = 1e-9;
    for (size_t i = 0; i < s->count; i++) {
        const oracle_portal p = s->portals[i];
        if (dx * (p.left.y - at.y) - dy * (p.left.x - at.x) < -slack ||
            dx * (p.right.y - at.y) - dy * (p.right.x - at.x) > slack)
            return false;
    }
    return true;
}

static double nearest_along(sl_point at, double dx, double dy, oracle_portal p, bool late) {
    const double l = dx * (p.left.x - at.x) + dy * (p.left.y - at.y);
    const double r = dx * (p.right.x - at.x) + dy * (p.right.y - at.y);
    return late ? fmax(l, r) : fmin(l, r);
}

static double length_along(const search *s, sl_point at, double dx, double dy) {
    const oracle_portal first = s->portals[0], last = s->portals[s->count - 1];
    bool parallel;
    double from = crossing(at, dx, dy, first, &parallel);
    if (parallel) from = nearest_along(at, dx, dy, first, true);
    double to = crossing(at, dx, dy, last, &parallel);
    if (parallel) to = nearest_along(at, dx, dy, last, false);
    return fmax(0, to - from);
}

/// Lines through every end: towards every other, and all around.
static double shortest(const search *s) {
    double least = INFINITY;
    if (s->count == 1) return 0;
    for (size_t i = 0; i < 2 * s->count; i++) {
        const sl_point at = i % 2 ? s->portals[i / 2].left : s->portals[i / 2].right;
        for (size_t k = 0; k < 4 * s->count + ANGLES; k++) {
            double dx, dy;
            if (k < 4 * s->count) {
                const oracle_portal p = s->portals[k / 4];
                const sl_point to = k % 2 ? p.left : p.right;
                const double size = hypot(to.x - at.x, to.y - at.y);
                if (size == 0) continue;
                dx = (to.x - at.x) / size * (k % 4 < 2 ? 1 : -1);
                dy = (to.y - at.y) / size * (k % 4 < 2 ? 1 : -1);
            } else {
                const double angle = 6.283185307179586 * (double)(k - 4 * s->count) / ANGLES;
                dx = cos(angle);
                dy = sin(angle);
            }
            if (passes(s, at, dx, dy)) least = fmin(least, length_along(s, at, dx, dy));
        }
    }
    return least;
}

// --- the search

static bool go_on(search *s, uint32_t cell, uint32_t doors);

/// Goes through one portal more. `mirror`: UINT32_MAX for none.
static bool pass(search *s, oracle_portal portal, uint32_t cell, uint32_t doors, uint32_t mirror) {
    if (!oracle_sequence_forwards(s->sequence, portal)) return true;
    if (s->left == 0 || s->count == DEEPEST) return false;
    s->left--;
    const sl_stab_verdict verdict = oracle_sequence_push(s->sequence, portal);
    s->portals[s->count++] = portal;
    bool within = true;
    if (verdict == SL_STABBED || (verdict == SL_GRAZING && s->sight == SL_CLOSED)) {
        const double length = s->map->range > 0 ? shortest(s) : 0;
        if (s->out->count == s->out->room) {
            s->out->room = 2 * s->out->room + 256;
            s->out->items = realloc(s->out->items, s->out->room * sizeof *s->out->items);
            if (!s->out->items) abort();
        }
        if (mirror != UINT32_MAX) s->mirrors[s->mirror_count++] = mirror;
        s->out->items[s->out->count++] =
            (oracle_way){s->source, cell, doors, s->mirror_count > 0, length};
        if (!(s->map->range > 0) || length < 1.1 * s->map->range) within = go_on(s, cell, doors);
        if (mirror != UINT32_MAX) s->mirror_count--;
    }
    s->count--;
    oracle_sequence_pop(s->sequence);
    return within;
}

/// Whether the way of a portal goes from the glass's right to its left.
static bool is_lit(sl_segment glass, oracle_portal p) {
    const double x = p.left.y - p.right.y, y = p.right.x - p.left.x; // the way through
    return (glass.b.x - glass.a.x) * y - (glass.b.y - glass.a.y) * x > 0;
}

static bool go_through_directed(search *s, uint32_t at, uint32_t doors) {
    const sl_cell *cell = &s->space->cells[at];
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const sl_directed_portal *directed = &s->space->directed[cell->first_directed + i];
        const oracle_portal portal = {directed->left, directed->right};
        uint32_t passed = doors;
        bool lit = true;
        for (size_t k = 0; k < s->map->door_count; k++)
            if (covers(s->map->doors[k].segment, portal)) passed |= 1u << k;
        for (size_t k = 0; k < s->map->oneway_count; k++)
            if (covers(s->map->oneways[k].segment, portal))
                lit &= is_lit(s->map->oneways[k].segment, portal);
        if (lit && !pass(s, unfold(s, portal), directed->cell, passed, UINT32_MAX)) return false;
    }
    return true;
}

/// Corners are a box's, counter-clockwise; what of a side a mirror covers is a portal.
static bool go_through_mirrors(search *s, uint32_t at, uint32_t doors) {
    const sl_point *v = s->space->vertices + s->space->cells[at].first_vertex;
    for (uint32_t m = 0; m < s->map->mirror_count && s->mirror_count < s->depth; m++) {
        const sl_segment glass = s->map->mirrors[m].segment;
        if (s->mirror_count && s->mirrors[s->mirror_count - 1] == m) continue;
        for (int k = 0; k < 4; k++) {
            const sl_point from = v[k], to = v[(k + 1) % 4];
            if (cross(glass.a, glass.b, from) != 0 || cross(glass.a, glass.b, to) != 0) continue;
            sl_point ends[4] = {from, to, glass.a, glass.b}, right = from, left = to;
            const double ux = to.x - from.x, uy = to.y - from.y;
            double low = 0, high = ux * ux + uy * uy, a[2];
            for (int e = 0; e < 2; e++)
                a[e] = (ends[2 + e].x - from.x) * ux + (ends[2 + e].y - from.y) * uy;
            const bool same_way = a[0] < a[1];
            if (s->map->mirrors[m].one_sided && !same_way) continue;
            if (fmin(a[0], a[1]) > low) right = ends[same_way ? 2 : 3], low = fmin(a[0], a[1]);
            if (fmax(a[0], a[1]) < high) left = ends[same_way ? 3 : 2], high = fmax(a[0], a[1]);
            if (low < high && !pass(s, unfold(s, (oracle_portal){left, right}), at, doors, m))
                return false;
        }
    }
    return true;
}

static bool go_on(search *s, uint32_t cell, uint32_t doors) {
    return go_through_directed(s, cell, doors) && go_through_mirrors(s, cell, doors);
}

bool oracle_effects(const sl_space *space, const sl_map *map, sl_sight sight, uint32_t depth,
                    uint64_t limit, oracle_ways *out) {
    const sl_point unit = {1, 1};
    search s = {.space = space,
                .map = map,
                .sight = sight,
                .depth = depth,
                .left = limit,
                .sequence = oracle_sequence_create(&unit, 1),
                .out = out};
    *out = (oracle_ways){0};
    bool within = true;
    assert(map->door_count <= 32);
    for (uint32_t i = 0; i < space->cell_count && within; i++) {
        s.source = i;
        within = go_on(&s, i, 0);
    }
    oracle_sequence_destroy(s.sequence);
    return within;
}
