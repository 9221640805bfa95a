/// Reach: by hand at doors and corners, and on random maps against many places near both points:
/// what one of them sees is never missed, straight and on foot.
#include "testing.h"

#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sightline/path.h"
#include "sightline/reach.h"

#include <math.h>

typedef struct room {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_reach *reach;
} room;

static void make_room(room *r, testing_memory *memory, const char *statements) {
    *r = (room){.context = testing_context(memory)};
    testing_space(r->context, statements, &r->map, &r->space);
    assert_ok(r->context, sl_query_over(r->context, &r->space, &r->map, NULL, &r->query));
    assert_ok(r->context, sl_reach_create(r->context, r->query, &r->reach));
}

static void end_map(room *r) {
    sl_reach_destroy(r->context, r->reach);
    sl_query_destroy(r->context, r->query);
    sl_space_destroy(r->context, &r->space);
    sl_map_destroy(r->context, &r->map);
}

static void end_room(room *r) {
    end_map(r);
    sl_context_destroy(r->context);
}

static bool sees(room *r, sl_point a, double ra, sl_point b, double rb, sl_reach_kind kind) {
    bool out;
    assert_ok(r->context, sl_reach_sees_within(r->context, r->reach, a, ra, b, rb, kind, &out));
    return out;
}

/// Two rooms with a wall between them, and a door in it.
static void rooms_and_doors(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL,
              "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
              "start 2 5 0\nstart 12 5 0\ndoor middle 10 4 10 6 shut\n");
    const sl_point left = {9, 1}, right = {11, 1}, far = {2, 9}, door = {9, 5};
    assert_false(sees(&r, left, 0.5, right, 0.5, SL_REACH_STRAIGHT));
    assert_true(sees(&r, left, 1.5, right, 0.5, SL_REACH_STRAIGHT)); // through the wall
    assert_false(sees(&r, left, 1.5, right, 1.5, SL_REACH_ON_FOOT));
    assert_false(sees(&r, left, 8, right, 8, SL_REACH_ON_FOOT)); // the door is shut
    sl_query_set_doors(r.context, r.query, true);
    assert_false(sees(&r, left, 0.5, right, 0.5, SL_REACH_ON_FOOT));
    assert_true(sees(&r, left, 4.5, right, 0.5, SL_REACH_ON_FOOT)); // up to the door
    assert_true(sees(&r, door, 0, right, 8, SL_REACH_ON_FOOT));
    assert_true(sees(&r, far, 0, left, 0, SL_REACH_ON_FOOT));
    sl_query_set_doors(r.context, r.query, false);
    assert_false(sees(&r, door, 0.5, right, 8, SL_REACH_ON_FOOT));
    assert_ok(r.context, sl_query_set_range(r.context, r.query, 5));
    assert_false(sees(&r, far, 1, left, 1, SL_REACH_ON_FOOT));
    assert_true(sees(&r, far, 5, left, 3, SL_REACH_ON_FOOT));
    // Out of the map.
    assert_false(sees(&r, (sl_point){-9, 5}, 1, left, 3, SL_REACH_STRAIGHT));
    assert_false(sees(&r, (sl_point){-9, 5}, 1, left, 3, SL_REACH_ON_FOOT));
    end_room(&r);
}

static void wrong_questions(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls 0 0 20 0 20 10 0 10 0 0\nstart 2 5 0\n");
    bool out;
    const double wrong[] = {-1, NAN, INFINITY};
    for (int i = 0; i < 3; i++)
        assert_int_equal(sl_reach_sees_within(r.context, r.reach, (sl_point){1, 1}, 1,
                                              (sl_point){2, 2}, wrong[i], SL_REACH_ON_FOOT, &out),
                         SL_BAD_ARGUMENT);
    assert_int_equal(sl_reach_sees_within(r.context, r.reach, (sl_point){NAN, 1}, 1,
                                          (sl_point){2, 2}, 1, SL_REACH_STRAIGHT, &out),
                     SL_BAD_ARGUMENT);
    end_room(&r);
}

// --- on random maps

enum { ACROSS = 7, PLACES = ACROSS * ACROSS };

typedef struct near_places {
    sl_point at[PLACES];
    bool on_foot[PLACES];
    int count;
} near_places;

static bool is_on_wall(const sl_space *space, sl_point p) {
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_point a = space->walls[i].a, b = space->walls[i].b;
        if (fmin(a.x, b.x) <= p.x && p.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= p.y &&
            p.y <= fmax(a.y, b.y) && sl_orient(a, b, p) == 0)
            return true;
    }
    return false;
}

/// Places of the disc, some of them on its border, and which of them ways lead to.
static void gather(const room *r, sl_route_finder *finder, sl_point middle, double radius,
                   near_places *out) {
    sl_route route = {0};
    const uint32_t own = sl_space_locate(&r->space, middle);
    const bool stands = own != SL_NO_CELL && !r->space.cells[own].solid;
    out->count = 0;
    for (int i = 0; i < PLACES; i++) {
        const double x = 2.0 * (i % ACROSS) / (ACROSS - 1) - 1,
                     y = 2.0 * ((double)(i / ACROSS)) / (ACROSS - 1) - 1;
        const sl_point at = {middle.x + radius * x, middle.y + radius * y};
        const uint32_t cell = sl_space_locate(&r->space, at);
        if (x * x + y * y > 1 || cell == SL_NO_CELL || r->space.cells[cell].solid) continue;
        bool on_foot = false;
        if (stands) {
            assert_ok(r->context, sl_route_find(r->context, finder, middle, at, &route));
            on_foot = route.found && route.length <= radius && !is_on_wall(&r->space, at);
        }
        out->at[out->count] = at;
        out->on_foot[out->count++] = on_foot;
    }
    sl_route_destroy(r->context, &route);
}

static sl_point random_point(const sl_box *b, sl_random *random) {
    // Whole numbers are on walls and in line with them.
    const sl_point at = {b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                         b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
    return sl_random_below(random, 2) ? at : (sl_point){floor(at.x), floor(at.y)};
}

typedef struct counts {
    int seen[2], said[2];
} counts;

static void check_pair(room *r, sl_route_finder *finder, sl_random *random, counts *c) {
    const double size = r->space.bounds.max.x - r->space.bounds.min.x;
    const sl_point a = random_point(&r->space.bounds, random),
                   b = random_point(&r->space.bounds, random);
    const double ra = 0.2 * size * sl_random_unit(random), rb = 0.1 * size * sl_random_unit(random);
    near_places from, to;
    gather(r, finder, a, ra, &from);
    gather(r, finder, b, rb, &to);
    bool seen[2] = {false, false};
    for (int i = 0; i < from.count && !seen[1]; i++)
        for (int k = 0; k < to.count && !seen[1]; k++) {
            bool one;
            assert_ok(r->context, sl_query_sees(r->context, r->query, from.at[i], to.at[k], &one));
            seen[0] |= one;
            seen[1] |= one && from.on_foot[i] && to.on_foot[k];
        }
    for (int kind = 0; kind < 2; kind++) {
        const bool said = sees(r, a, ra, b, rb, (sl_reach_kind)kind);
        assert_true(said || !seen[kind]);
        c->said[kind] += said;
        c->seen[kind] += seen[kind];
    }
}

static bool make_random(sl_context *context, uint64_t seed, room *r) {
    *r = (room){.context = context};
    if (seed % 2)
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &r->map));
    else
        assert_ok(context, oblique_random_map(context, seed, OBLIQUE_ANYWHERE, 20, &r->map));
    assert_ok(context, sl_map_clean(context, &r->map, NULL, NULL));
    if (!r->map.wall_count) return false;
    assert_ok(context, sl_subdivision_for(&r->map)->subdivide(context, &r->map, NULL, &r->space));
    assert_ok(context, sl_query_over(context, &r->space, &r->map, NULL, &r->query));
    assert_ok(context, sl_reach_create(context, r->query, &r->reach));
    return true;
}

static void random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    counts c = {{0}, {0}};
    const uint64_t seeds = testing_seeds(150);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        room r;
        sl_random random = {seed};
        if (make_random(context, seed, &r)) {
            sl_route_finder *finder;
            assert_ok(context, sl_route_finder_create(context, r.query, &finder));
            for (int i = 0; i < 12; i++) check_pair(&r, finder, &random, &c);
            sl_route_finder_destroy(context, finder);
        }
        end_map(&r);
    }
    print_message("straight: %d seen, %d said; on foot: %d seen, %d said\n", c.seen[0], c.said[0],
                  c.seen[1], c.said[1]);
    assert_true(c.seen[1] > (int)seeds && c.seen[0] > c.seen[1]);
    assert_true(c.said[1] < c.said[0]);
    sl_context_destroy(context);
}

static void memory_that_ends(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r;
    make_room(&r, &memory, "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nstart 2 5 0\n");
    const long live = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status != SL_OK; at++) {
        sl_reach *reach;
        memory.calls = 0;
        memory.fail_at = at;
        memory.once = true;
        status = sl_reach_create(r.context, r.query, &reach);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        if (status == SL_OK) sl_reach_destroy(r.context, reach);
        assert_int_equal(memory.live, live);
    }
    memory.fail_at = 0;
    end_room(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rooms_and_doors), cmocka_unit_test(wrong_questions),
        cmocka_unit_test(random_maps), cmocka_unit_test(memory_that_ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
