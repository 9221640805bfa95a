/// Exposure: by hand in small rooms, and on random maps by many places on the path and on things.
#include "room.h"

#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sightline/exposure.h"

#include <math.h>

static void assert_near(double a, double b) {
    if (!(fabs(a - b) <= 1e-9 * (1 + fabs(b)))) fail_msg("%.17g, not %.17g", a, b);
}

/// The hall: a wall with a gap from x = 9 to 11 between the path, below, and what is above.
///
///     +-------------------------+ 10
///     |      [area]    ---line  | 8
///     |                         |
///     |---------      ----------| 5
///     |  s===================s  | 4
///     +-------------------------+ 0
static const char hall[] =
    "walls 0 0 20 0 20 10 0 10 0 0\nwall 0 5 9 5\nwall 11 5 20 5\nstart 2 2 0\n";

static void through_a_gap(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, hall);
    const sl_point path[] = {{2, 4}, {18, 4}};
    const sl_point line[] = {{10, 8}, {12, 8}}, own[] = {{5, 2}, {9, 2}, {9, 3}};
    const sl_point area[] = {{9.5, 6}, {10.5, 6}, {10.5, 7}, {9.5, 7}};
    const sl_point outline[] = {{20, 0}, {20, 10}};
    const size_t two = 2, three = 3, four = 4, both_ends[] = {2, 5};
    const sl_point both[] = {{10, 8}, {12, 8}, {5, 2}, {9, 2}, {9, 3}};
    const sl_exposed things[] = {{{line, &two, 1}, false},
                                 {{own, &three, 1}, false},
                                 {{area, &four, 1}, true},
                                 {{outline, &two, 1}, false},
                                 {{both, both_ends, 2}, false}};
    sl_exposure e[5];
    assert_ok(r.context, sl_exposure_make(r.context, r.query, path, 2, things, 5, e));
    assert_near(e[0].size, 2);
    assert_near(e[0].seen, 2);
    // From (p, 4) the line's end (x, 8) is seen through the gap at y = 5: 9 <= p + (x - p) / 4
    // <= 11.
    assert_near(e[0].some.total, (44 - 10) / 3.0 - (36 - 12) / 3.0);
    assert_near(e[0].some.parts[0].from, 8 - 2);
    assert_near(e[0].whole.total, (44 - 12) / 3.0 - (36 - 10) / 3.0);
    assert_near(e[1].size, 5);
    assert_near(e[1].seen, 5);
    assert_near(e[1].some.total, 16);
    assert_near(e[1].whole.total, 16);
    assert_near(e[2].size, 1);
    assert_near(e[2].seen, 1);
    // All of the area: its upper corners are the hardest.
    assert_near(e[2].whole.parts[0].start.x, (27 - 9.5) / 2);
    assert_near(e[2].whole.parts[0].end.x, (33 - 10.5) / 2);
    // The outer wall: 5 below; and above it from y = 6 on: the path begins at (2, 4).
    assert_near(e[3].size, 10);
    assert_near(e[3].seen, 5 + 4);
    assert_near(e[4].size, 7);
    assert_near(e[4].some.total, 16);
    assert_near(e[4].whole.total, e[0].whole.total);
    for (int i = 0; i < 5; i++) sl_exposure_destroy(r.context, &e[i]);
    end_room(&r);
}

static void wrong_things(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, hall);
    const sl_point path[] = {{2, 4}, {18, 4}}, far[] = {{2, 4}, {38, 4}};
    const sl_point dent[] = {{1, 1}, {9, 1}, {4, 2}, {1, 4}};
    const size_t two = 2, four = 4, one = 1, areas[] = {3, 6};
    const sl_exposed good = {{path, &two, 1}, false};
    const struct {
        sl_exposed thing;
        const char *message;
    } wrong[] = {{{{far, &two, 1}, false}, "thing 2: point 2"},
                 {{{dent, &four, 1}, true}, "thing 2: the area to look from is not convex"},
                 {{{path, &one, 1}, false}, "thing 2: a path needs 2 points"},
                 {{{dent, areas, 2}, true}, "thing 2: it is 2 areas"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const sl_exposed things[] = {good, wrong[i].thing};
        sl_exposure e[2];
        assert_int_equal(sl_exposure_make(r.context, r.query, path, 2, things, 2, e),
                         SL_BAD_ARGUMENT);
        if (!strstr(sl_context_message(r.context), wrong[i].message))
            fail_msg("%s", sl_context_message(r.context));
        assert_true(e[0].size == 0 && !e[0].some.parts);
    }
    sl_exposure e;
    assert_int_equal(sl_exposure_make(r.context, r.query, far, 2, &good, 1, &e), SL_BAD_ARGUMENT);
    assert_int_equal(sl_exposure_make(r.context, r.query, path, 1, &good, 1, &e), SL_BAD_ARGUMENT);
    assert_ok(r.context, sl_exposure_make(r.context, r.query, path, 2, &good, 0, &e));
    end_room(&r);
}

// --- on random maps

enum { PLACES = 60 };

static bool make_random(sl_context *context, uint64_t seed, room *r) {
    *r = (room){.context = context};
    if (seed % 2)
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &r->map));
    else
        assert_ok(context, oblique_random_map(context, seed, OBLIQUE_ANYWHERE, 12, &r->map));
    assert_ok(context, sl_map_clean(context, &r->map, NULL, NULL));
    if (!r->map.wall_count || r->map.oneway_count || r->map.mirror_count) return false;
    assert_ok(context, sl_subdivision_for(&r->map)->subdivide(context, &r->map, NULL, &r->space));
    assert_ok(context, sl_query_over(context, &r->space, &r->map, NULL, &r->query));
    return true;
}

static sl_point along(const sl_point s[2], double t) {
    return (sl_point){s[0].x + t * (s[1].x - s[0].x), s[0].y + t * (s[1].y - s[0].y)};
}

static bool has(const sl_path_parts *parts, double at) {
    for (size_t i = 0; i < parts->count; i++)
        if (parts->parts[i].from <= at && at <= parts->parts[i].to) return true;
    return false;
}

/// Sightlines between places on both lines.
static void check_pair(const room *r, const sl_point path[2], const sl_point line[2],
                       const sl_exposure *e, sl_random *random, int counts[3]) {
    bool line_seen[PLACES] = {false};
    int seen = 0;
    double at[PLACES];
    for (int k = 0; k < PLACES; k++) at[k] = (k + sl_random_unit(random)) / PLACES;
    for (int i = 0; i < PLACES; i++) {
        const double t = (i + sl_random_unit(random)) / PLACES;
        int some = 0;
        for (int k = 0; k < PLACES; k++) {
            bool sees;
            assert_ok(r->context, sl_query_sees(r->context, r->query, along(path, t),
                                                along(line, at[k]), &sees));
            some += sees;
            line_seen[k] |= sees;
        }
        const double way = t * e->some.length;
        assert_true(has(&e->some, way) || !some);
        assert_true(!has(&e->whole, way) || some == PLACES);
        counts[0] += has(&e->some, way) && !some; // by less than a step
        counts[1] += some > 0;
        counts[2] += some == PLACES;
    }
    for (int k = 0; k < PLACES; k++) seen += line_seen[k];
    // Each place stands for a piece; a piece may be seen in part.
    assert_true(seen <= PLACES * e->seen / e->size + 6);
}

static void random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    int counts[3] = {0};
    const uint64_t seeds = testing_seeds(120);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        room r;
        sl_random random = {seed};
        if (make_random(context, seed, &r)) {
            const sl_point path[] = {random_point(&r.space.bounds, &random),
                                     random_point(&r.space.bounds, &random)};
            const sl_point line[] = {random_point(&r.space.bounds, &random),
                                     random_point(&r.space.bounds, &random)};
            const size_t two = 2;
            const sl_exposed thing = {{line, &two, 1}, false};
            sl_exposure e;
            assert_ok(context, sl_exposure_make(context, r.query, path, 2, &thing, 1, &e));
            // Sums of parts, each rounded.
            assert_true(e.seen <= e.size * (1 + 1e-12) &&
                        e.whole.total <= e.some.total * (1 + 1e-12));
            check_pair(&r, path, line, &e, &random, counts);
            sl_exposure_destroy(context, &e);
        }
        sl_query_destroy(context, r.query);
        sl_space_destroy(context, &r.space);
        sl_map_destroy(context, &r.map);
    }
    assert_true(counts[1] > 8 * (int)seeds && counts[2] > 0 && counts[0] < counts[1] / 8);
    sl_context_destroy(context);
}

/// Each allocation that fails leaves nothing behind.
static void memory_that_ends(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r;
    make_room(&r, &memory, hall);
    const sl_point path[] = {{2, 4}, {18, 4}};
    const sl_point area[] = {{9.5, 6}, {10.5, 6}, {10.5, 7}, {9.5, 7}};
    const size_t two = 2, four = 4;
    const sl_exposed things[] = {{{path, &two, 1}, false}, {{area, &four, 1}, true}};
    sl_exposure e[2];
    assert_ok(r.context, sl_exposure_make(r.context, r.query, path, 2, things, 2, e));
    for (int i = 0; i < 2; i++) sl_exposure_destroy(r.context, &e[i]);
    const long live = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status != SL_OK; at += 7) {
        memory.calls = 0;
        memory.fail_at = at;
        memory.once = true;
        status = sl_exposure_make(r.context, r.query, path, 2, things, 2, e);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        for (int i = 0; i < 2; i++) sl_exposure_destroy(r.context, &e[i]);
        assert_true(memory.live <= live + 1);
    }
    memory.fail_at = 0;
    end_room(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(through_a_gap), cmocka_unit_test(wrong_things),
        cmocka_unit_test(random_maps), cmocka_unit_test(memory_that_ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
