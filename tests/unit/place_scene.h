// Ten places at random in a plan, and what placement chooses of them.
#ifndef PLACE_SCENE_H
#define PLACE_SCENE_H

#include "testing.h"

#include "sightline/place_area.h"
#include "sightline/support.h"

#include <math.h>

enum { PLACES = 10 };
#define DEGREE 0.017453292519943295

#define PLAN "open 0 0 12 0 12 8 0 8\nsolid 3 3 5 3 5 5 3 5\nsolid 7 2 8 2 8 6 7 6\nwall 9 8 9 5\n"
#define TURNED                                                                                     \
    "open 0 0 11.457138 3.572 9.078 11.21 -2.379 7.638\nwall 3 3 5 3.7\nwall 6 4 5.5 6\n"          \
    "oneway 2 2 3 3\n"

typedef struct scene {
    testing_memory memory;
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_viewpoint places[PLACES];
    uint32_t costs[PLACES];
    sl_place_area area;
} scene;

static inline sl_point draw(scene *s, sl_random *random) {
    for (;;) {
        const sl_point at = {-3 + 16 * sl_random_unit(random), 12 * sl_random_unit(random)};
        if (sl_space_is_inside(&s->space, at)) return at;
    }
}

static inline void begin(scene *s, const char *plan, uint64_t seed, sl_viewpoint like) {
    sl_random random = {seed};
    *s = (scene){0};
    s->context = testing_context(&s->memory);
    testing_space(s->context, plan, &s->map, &s->space);
    assert_ok(s->context, sl_query_over(s->context, &s->space, &s->map, NULL, &s->query));
    for (int i = 0; i < PLACES; i++) {
        s->places[i] = like;
        s->places[i].at = i % 2 ? s->places[i - 1].at : draw(s, &random);
        s->places[i].heading = 360 * sl_random_unit(&random);
        s->costs[i] = 1 + (uint32_t)sl_random_below(&random, 3);
    }
    s->area = (sl_place_area){.places = s->places, .place_count = PLACES};
}

static inline void end(scene *s) {
    sl_query_destroy(s->context, s->query);
    sl_space_destroy(s->context, &s->space);
    sl_map_destroy(s->context, &s->map);
    sl_context_destroy(s->context);
    assert_int_equal(s->memory.live, 0);
}

/// Whether a place sees a point. *near: this hangs on the chords of a range.
static inline bool sees(scene *s, const sl_viewpoint *p, sl_point at, bool *near) {
    bool is_seen;
    const double x = at.x - p->at.x, y = at.y - p->at.y, distance = hypot(x, y);
    if (p->range > 0) *near |= fabs(distance / p->range - 1) < 5e-4;
    if (p->nearest > 0) *near |= fabs(distance / p->nearest - 1) < 5e-4;
    if ((p->range > 0 && distance > p->range) || distance < p->nearest) return false;
    const double off = fabs(remainder(atan2(y, x) - p->heading * DEGREE, 360 * DEGREE));
    *near |= p->fov < 360 && fabs(off - p->fov * DEGREE / 2) < 1e-9;
    assert_ok(s->context, sl_query_sees(s->context, s->query, p->at, at, &is_seen));
    return is_seen && (p->fov >= 360 || off <= p->fov * DEGREE / 2);
}

/// A point inside; every other one is close to a corner of the walls.
static inline sl_point sample(scene *s, sl_random *random, int number) {
    if (number % 2 || !s->space.wall_count) return draw(s, random);
    for (;;) {
        const sl_wall *wall = &s->space.walls[sl_random_below(random, s->space.wall_count)];
        const double size = exp(-18 * sl_random_unit(random));
        const sl_point at = {wall->a.x + size * (sl_random_unit(random) - 0.5),
                             wall->a.y + size * (sl_random_unit(random) - 0.5)};
        if (sl_space_is_inside(&s->space, at)) return at;
    }
}

static inline uint64_t cost_of(const scene *s, uint32_t set) {
    uint64_t cost = 0;
    for (int i = 0; i < PLACES; i++)
        if (set >> i & 1) cost += s->area.costs ? s->area.costs[i] : 1;
    return cost;
}

static inline uint32_t set_of(const sl_area_placement *placed) {
    uint32_t set = 0;
    for (uint32_t i = 0; i < placed->count; i++) set |= 1u << placed->chosen[i];
    return set;
}

static inline uint32_t bits_in(uint32_t set) {
    uint32_t bits = 0;
    for (; set; set &= set - 1) bits++;
    return bits;
}

static inline sl_area_placement place(scene *s) {
    sl_area_placement placed = {0};
    assert_ok(s->context, sl_place_area_cover(s->context, s->query, &s->area, NULL, &placed));
    assert_true(placed.lower <= placed.upper);
    assert_true(placed.count > 0 && placed.count <= PLACES);
    assert_int_equal(cost_of(s, set_of(&placed)), placed.upper);
    assert_true(placed.rounding <= 1e-9 * placed.area);
    return placed;
}

static inline void assert_refused(scene *s, const char *part) {
    sl_area_placement placed = {0};
    assert_int_equal(sl_place_area_cover(s->context, s->query, &s->area, NULL, &placed),
                     SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(s->context), part));
    assert_null(placed.chosen);
    assert_null(placed.line_lengths);
}

#endif
