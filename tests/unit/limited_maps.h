/// Random maps of walls that limit sight, some of which stop it, and what an eye sees there by
/// oracles that follow no cell and no portal. Walls cross, touch, overlap and end together.
#ifndef SL_TESTS_LIMITED_MAPS_H
#define SL_TESTS_LIMITED_MAPS_H

#include "testing.h"

#include "oracle/limited_points.h"

#include <math.h>

/// Of the oracle's units there are so many in one of the map, whose numbers are 0 to SIZE.
enum { FINE = 64, SIZE = 16, WALLS = 24 };

/// A map as the oracle has it, and how its numbers become those of the library.
typedef struct scene {
    sl_context *context;
    limited_wall walls[WALLS + 8]; ///< those, a border, a box
    size_t count;
    double unit, shift;
    sl_baked baked;
    sl_query *query;
    uint64_t seed;
} scene;

static inline double coordinate(const scene *s, int64_t fine) {
    return (double)fine / FINE * s->unit + s->shift;
}

static inline sl_point point(const scene *s, int64_t x, int64_t y) {
    return (sl_point){coordinate(s, x), coordinate(s, y)};
}

static inline void add_wall(scene *s, sl_map *map, limited_wall wall, uint32_t stops) {
    const size_t first = map->wall_count;
    s->walls[s->count++] = wall;
    assert_ok(s->context, sl_map_add_wall(s->context, map, point(s, wall.ax, wall.ay),
                                          point(s, wall.bx, wall.by), 0));
    assert_ok(s->context, sl_map_walls_stop(s->context, map, first, stops));
}

/// A wall between even places, upright, level or at 45 degrees: all crossings are exact.
static inline limited_wall random_wall(sl_random *random, bool axial) {
    const int64_t x = 2 * (int64_t)sl_random_below(random, SIZE / 2 + 1);
    const int64_t y = 2 * (int64_t)sl_random_below(random, SIZE / 2 + 1);
    const int64_t length = 2 + 2 * (int64_t)sl_random_below(random, SIZE / 2);
    const uint64_t way = sl_random_below(random, axial ? 2 : 4);
    const int64_t dx = way == 0 ? 0 : way == 3 ? -length : length, dy = way == 1 ? 0 : length;
    return (limited_wall){x * FINE, y * FINE, (x + dx) * FINE, (y + dy) * FINE, false};
}

/// `blocks`: of eight walls so many stop sight. `bits`: what walls may say.
static inline void make_with(scene *s, uint64_t seed, uint64_t blocks, sl_sight sight,
                             uint32_t bits) {
    sl_random random = {seed};
    sl_map map = {0};
    *s = (scene){.context = testing_context(NULL), .seed = seed, .unit = 1};
    if (seed % 5 == 3) s->unit = 0x1p-40;
    if (seed % 5 == 4) s->shift = 0x1p30;
    const size_t count = 2 + (size_t)sl_random_below(&random, WALLS - 1);
    const int64_t low = -SIZE * FINE - FINE, high = 2 * SIZE * FINE + FINE;
    const limited_wall box[4] = {{low, low, high, low, true},
                                 {high, low, high, high, true},
                                 {high, high, low, high, true},
                                 {low, high, low, low, true}};
    for (int i = 0; i < 4; i++) add_wall(s, &map, box[i], SL_STOPS_ALL);
    for (size_t i = 0; i < count; i++) {
        limited_wall wall = random_wall(&random, seed % 2);
        const uint32_t rest = (uint32_t)sl_random_below(&random, 4) * SL_STOPS_STEPS;
        wall.stops = sl_random_below(&random, 8) < blocks;
        add_wall(s, &map, wall, rest | (wall.stops ? SL_STOPS_SIGHT : SL_STOPS_LIMITED));
    }
    for (size_t i = 0; i < map.seam_count; i++) map.seams[i].stops &= (uint8_t)bits;
    sl_bake_options options = sl_bake_options_default();
    options.see.sight = sight;
    assert_ok(s->context, sl_bake(s->context, &map, &options, &s->baked, NULL));
    assert_ok(s->context, sl_space_check(s->context, &s->baked.space));
    assert_ok(s->context, sl_query_create(s->context, &s->baked, &s->query));
    sl_map_destroy(s->context, &map);
}

static inline void make(scene *s, uint64_t seed, uint64_t blocks, sl_sight sight) {
    make_with(s, seed, blocks, sight, SL_STOPS_ALL | SL_STOPS_LIMITED);
}

static inline void end(scene *s) {
    sl_query_destroy(s->context, s->query);
    sl_baked_destroy(s->context, &s->baked);
    sl_context_destroy(s->context);
}

static inline limited_way way_between(const scene *s, int64_t px, int64_t py, int64_t qx,
                                      int64_t qy) {
    return (limited_way){s->walls, s->count, px, py, qx, qy};
}

/// Whether a place is on a wall that stops sight.
static inline bool is_on_wall(const scene *s, int64_t x, int64_t y) {
    for (size_t i = 0; i < s->count; i++) {
        const limited_wall *w = &s->walls[i];
        if (w->stops && (w->bx - w->ax) * (y - w->ay) == (w->by - w->ay) * (x - w->ax) &&
            (w->ax - x) * (w->bx - x) <= 0 && (w->ay - y) * (w->by - y) <= 0)
            return true;
    }
    return false;
}

/// Whether the line through two places meets no end of a wall and no crossing, and runs along no
/// wall.
static inline bool is_generic(const limited_way *w) {
    for (size_t i = 0; i < w->count; i++) {
        const limited_wall *one = &w->walls[i];
        limited_place at, other;
        if (!limited_side(w, one->ax, one->ay) || !limited_side(w, one->bx, one->by)) return false;
        for (size_t k = 0; k < i; k++) {
            const limited_wall *two = &w->walls[k];
            if ((one->bx - one->ax) * (two->by - two->ay) !=
                    (one->by - one->ay) * (two->bx - two->ax) &&
                limited_meets(w, one, &at) && limited_meets(w, two, &other) && at.above &&
                !limited_compare(&at, &other))
                return false;
        }
    }
    return true;
}

/// An eye where walls end, cross and lie along lines, often on limited ones, but on no other wall.
static inline bool random_eye(const scene *s, sl_random *random, int64_t *x, int64_t *y) {
    for (int tries = 0; tries < 50; tries++) {
        const int64_t step = sl_random_below(random, 4) ? FINE : 1;
        *x = (int64_t)sl_random_below(random, (uint64_t)(SIZE * FINE / step)) * step;
        *y = (int64_t)sl_random_below(random, (uint64_t)(SIZE * FINE / step)) * step;
        if (!is_on_wall(s, *x, *y)) return true;
    }
    return false;
}

/// Marks the cells that a ray in a direction between two corners passes before it is stopped.
static inline void mark_ray(const scene *s, int64_t px, int64_t py, int64_t dx, int64_t dy,
                            uint64_t *cells) {
    // So far that it leaves the map, in units that are small enough.
    const int64_t far = 6 * SIZE * FINE / (llabs(dx) > llabs(dy) ? llabs(dx) : llabs(dy)) + 1;
    const limited_way w = way_between(s, px, py, px + far * dx, py + far * dy);
    double stop = 1;
    int passed = 0;
    limited_place *all = malloc((s->count + 1) * sizeof *all);
    assert_non_null(all);
    size_t count = 0;
    for (size_t i = 0; i < s->count; i++) {
        limited_place at;
        if (limited_meets(&w, &s->walls[i], &at) && at.above > 0) all[count++] = at;
    }
    qsort(all, count, sizeof *all, limited_compare);
    for (size_t i = 0; i < count && passed < 2; i++) {
        if (i && !limited_compare(&all[i - 1], &all[i])) continue; // one on another
        for (size_t k = 0; k < s->count; k++) {
            limited_place at;
            if (s->walls[k].stops && limited_meets(&w, &s->walls[k], &at) &&
                !limited_compare(&at, &all[i]))
                passed = 2;
        }
        passed++;
        if (passed >= 2) stop = (double)all[i].above / (double)all[i].below;
    }
    free(all);
    // Cells along it: sampled between all sides that it crosses.
    const sl_space *space = &s->baked.space;
    double last = 0;
    const double x = (double)(far * dx), y = (double)(far * dy);
    while (last < stop) {
        double next = stop;
        for (uint32_t i = 0; i < space->portal_count; i++) {
            const sl_point a = space->portals[i].right, b = space->portals[i].left;
            const double ax = (a.x - s->shift) / s->unit * FINE - (double)px;
            const double ay = (a.y - s->shift) / s->unit * FINE - (double)py;
            const double bx = (b.x - s->shift) / s->unit * FINE - (double)px;
            const double by = (b.y - s->shift) / s->unit * FINE - (double)py;
            const double turn = x * (by - ay) - y * (bx - ax);
            if (turn == 0 || (x * ay - y * ax) * (x * by - y * bx) > 0) continue;
            const double t = (ax * (by - ay) - ay * (bx - ax)) / turn;
            if (t > last + 1e-9 && t < next) next = t;
        }
        const double middle = (last + next) / 2;
        const sl_point at = {((double)px + middle * x) / FINE * s->unit + s->shift,
                             ((double)py + middle * y) / FINE * s->unit + s->shift};
        sl_bits_add(cells, sl_space_locate(space, at));
        last = next;
    }
}

/// Directions from the eye, counter-clockwise from +x.
typedef struct directions {
    int64_t (*items)[2];
    size_t count;
} directions;

static inline bool is_lower(const int64_t *d) {
    return d[1] < 0 || (d[1] == 0 && d[0] < 0);
}

static inline void add_direction(const scene *s, int64_t px, int64_t py, sl_point to,
                                 directions *all) {
    const int64_t d[2] = {llrint((to.x - s->shift) / s->unit * FINE) - px,
                          llrint((to.y - s->shift) / s->unit * FINE) - py};
    size_t at = 0;
    if (!d[0] && !d[1]) return;
    for (; at < all->count; at++) {
        const int64_t *other = all->items[at];
        const int64_t turn = other[0] * d[1] - other[1] * d[0];
        if (is_lower(other) == is_lower(d) && turn == 0) return;
        if (is_lower(other) > is_lower(d) || (is_lower(other) == is_lower(d) && turn < 0)) break;
    }
    memmove(all->items + at + 1, all->items + at, (all->count++ - at) * sizeof *all->items);
    memcpy(all->items[at], d, sizeof d);
}

/// To all corners of cells and ends of portals.
static inline directions list_directions(const scene *s, int64_t px, int64_t py) {
    const sl_space *space = &s->baked.space;
    directions all = {calloc(space->vertex_count + 2 * space->portal_count + 1, 16), 0};
    assert_non_null(all.items);
    for (uint32_t i = 0; i < space->vertex_count; i++)
        add_direction(s, px, py, space->vertices[i], &all);
    for (uint32_t i = 0; i < space->portal_count; i++) {
        add_direction(s, px, py, space->portals[i].left, &all);
        add_direction(s, px, py, space->portals[i].right, &all);
    }
    return all;
}

/// Marks the cells that an eye sees by rays between all corners. The directions are to be freed.
static inline directions mark_rays(const scene *s, int64_t px, int64_t py, uint64_t *cells) {
    directions all = list_directions(s, px, py);
    memset(cells, 0, sl_eye_words(&s->baked.space) * sizeof *cells);
    for (size_t i = 0; i < all.count; i++) {
        const int64_t *a = all.items[i], *b = all.items[(i + 1) % all.count];
        if (a[0] * b[1] - a[1] * b[0] > 0) mark_ray(s, px, py, a[0] + b[0], a[1] + b[1], cells);
    }
    return all;
}

/// Where a way first meets a cell.
static inline bool meets_cell(const scene *s, const limited_way *w, uint32_t number,
                              limited_place *out) {
    const sl_cell *cell = &s->baked.space.cells[number];
    const sl_point *corners = s->baked.space.vertices + cell->first_vertex;
    bool any = false;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % cell->vertex_count];
        const limited_wall side = {.ax = llrint((a.x - s->shift) / s->unit * FINE),
                                   .ay = llrint((a.y - s->shift) / s->unit * FINE),
                                   .bx = llrint((b.x - s->shift) / s->unit * FINE),
                                   .by = llrint((b.y - s->shift) / s->unit * FINE)};
        limited_place at;
        if (!limited_meets(w, &side, &at) || at.above < 0) continue;
        if (!any || limited_compare(&at, out) < 0) *out = at;
        any = true;
    }
    return any;
}

/// A cell that is listed beside what rays pass: closed sight must come to it by a single ray, which
/// touches corners.
static inline bool is_touched(const scene *s, int64_t px, int64_t py, const directions *all,
                              uint32_t cell) {
    for (size_t i = 0; i < all->count; i++) {
        const int64_t dx = all->items[i][0], dy = all->items[i][1];
        const int64_t far = 4 * SIZE * FINE / (llabs(dx) > llabs(dy) ? llabs(dx) : llabs(dy)) + 1;
        const limited_way w = way_between(s, px, py, px + far * dx, py + far * dy);
        limited_place at;
        if (meets_cell(s, &w, cell, &at) && limited_passed_until(&w, at) < 2) return true;
    }
    return false;
}

#endif
