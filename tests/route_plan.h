/// A plan with a finder of ways, places in it, and what stops ways there.
#ifndef SL_ROUTE_PLAN_H
#define SL_ROUTE_PLAN_H

#include "testing.h"

#include "geometry/orient.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "oracle/walks.h"
#include "sightline/path.h"

#include <math.h>

typedef struct plan {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_route_finder *finder;
    sl_route route;
} plan;

static inline void open_plan(plan *p) {
    assert_ok(p->context,
              sl_subdivision_for(&p->map)->subdivide(p->context, &p->map, NULL, &p->space));
    assert_ok(p->context, sl_query_over(p->context, &p->space, &p->map, NULL, &p->query));
    assert_ok(p->context, sl_route_finder_create(p->context, p->query, &p->finder));
}

static inline void close_plan(plan *p) {
    sl_route_destroy(p->context, &p->route);
    sl_route_finder_destroy(p->context, p->finder);
    sl_query_destroy(p->context, p->query);
    sl_space_destroy(p->context, &p->space);
    sl_map_destroy(p->context, &p->map);
    sl_context_destroy(p->context);
}

static inline void read_plan(plan *p, const char *text) {
    *p = (plan){.context = testing_context(NULL)};
    assert_ok(p->context, sl_map_parse(p->context, "test.map", text, strlen(text), NULL, &p->map));
    assert_ok(p->context, sl_map_clean(p->context, &p->map, NULL, NULL));
    open_plan(p);
}

/// The length; INFINITY for no way.
static inline double way(plan *p, double x, double y, double to_x, double to_y) {
    assert_ok(p->context, sl_route_find(p->context, p->finder, (sl_point){x, y},
                                        (sl_point){to_x, to_y}, &p->route));
    return p->route.found ? p->route.length : (double)INFINITY;
}

enum {
    WALLS_MOST = 2048,
    ORACLE_WALLS = 30 ///< with more the oracle takes too long
};

/// What stops ways: the walls of the space, doors that are shut among them, and its border.
typedef struct barrier {
    sl_segment walls[WALLS_MOST];
    size_t count;
} barrier;

static inline void add_wall(barrier *b, sl_point from, sl_point to) {
    assert_true(b->count < WALLS_MOST);
    if (!sli_same_point(from, to)) b->walls[b->count++] = (sl_segment){from, to};
}

static inline void find_barrier(plan *p, barrier *b) {
    const sl_space *space;
    b->count = 0;
    assert_ok(p->context, sl_query_space(p->context, p->query, &space, NULL));
    for (uint32_t i = 0; i < space->wall_count; i++)
        add_wall(b, space->walls[i].a, space->walls[i].b);
    const sl_box *s = &space->bounds;
    const sl_point corners[] = {s->min, {s->max.x, s->min.y}, s->max, {s->min.x, s->max.y}};
    for (int i = 0; i < 4; i++) add_wall(b, corners[i], corners[(i + 1) % 4]);
}

static inline walk_end stand(const plan *p, sl_point at) {
    const uint32_t cell = sl_space_locate(&p->space, at);
    return (walk_end){at, cell == SL_NO_CELL ? at : sl_space_middle(&p->space, cell)};
}

/// The middle of the cell says the side only where rounding has left it within the cell.
static inline bool is_clear(const plan *p, walk_end end) {
    return !sli_same_point(end.at, end.side) &&
           sl_space_locate(&p->space, end.at) == sl_space_locate(&p->space, end.side) &&
           !p->space.cells[sl_space_locate(&p->space, end.at)].solid;
}

/// Points at corners, on walls, in line with them, and anywhere.
static inline sl_point random_place(sl_random *random, const plan *p) {
    const sl_box *b = &p->space.bounds;
    const sl_point any = {b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                          b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
    const sl_wall *w = &p->space.walls[sl_random_below(random, p->space.wall_count)],
                  *v = &p->space.walls[sl_random_below(random, p->space.wall_count)];
    switch (sl_random_below(random, 5)) {
    case 0:
        return w->a;
    case 1:
        return (sl_point){w->a.x / 2 + w->b.x / 2, w->a.y / 2 + w->b.y / 2};
    case 2:
        return (sl_point){w->a.x, v->b.y};
    case 3:
        return p->space.vertices[sl_random_below(random, p->space.vertex_count)];
    default:
        return any;
    }
}

/// What is checked of a random plan; it closes it.
typedef void (*plan_check)(plan *p, uint64_t seed);

static inline void each_axial_plan(uint64_t count, plan_check check) {
    for (uint64_t seed = 0; seed < count; seed++) {
        plan p = {.context = testing_context(NULL)};
        assert_ok(p.context, oracle_random_map(p.context, seed, (oracle_grid)(seed % 3), &p.map));
        if (sl_map_clean(p.context, &p.map, NULL, NULL) == SL_OK && p.map.wall_count)
            check(&p, seed);
        else
            close_plan(&p);
    }
}

/// By 17.3 and 45 degrees, some of them far from the origin.
static inline void each_turned_plan(uint64_t count, plan_check check) {
    for (uint64_t seed = 0; seed < count; seed++) {
        plan p = {.context = testing_context(NULL)};
        assert_ok(p.context, oracle_random_map(p.context, seed, ORACLE_GRID_INTEGER, &p.map));
        oblique_turn_map(&p.map, seed % 2 ? 17.3 : 45, seed % 3 ? 0 : 1e7);
        assert_ok(p.context, sl_map_clean(p.context, &p.map, NULL, NULL));
        check(&p, seed);
    }
}

static inline void each_oblique_plan(uint64_t count, plan_check check) {
    for (uint64_t seed = 0; seed < count; seed++) {
        plan p = {.context = testing_context(NULL)};
        assert_ok(p.context, oblique_random_map(p.context, seed,
                                                (oblique_grid)(seed % OBLIQUE_GRIDS), 9, &p.map));
        if (sl_map_clean(p.context, &p.map, NULL, NULL) == SL_OK && p.map.wall_count)
            check(&p, seed);
        else
            close_plan(&p);
    }
}

#endif
