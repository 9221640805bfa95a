/// Single lines of sight on random maps of small integers, beside every wall taken by itself.
#include "space/outline.h"
#include "testing.h"

#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sight/region.h"
#include "space/subdivide.h"

#include <math.h>

/// Twice a coordinate is a small integer, so that all of this is exact.
static double cross(sl_point a, sl_point b, sl_point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static bool on_segment(sl_point a, sl_point b, sl_point p) {
    return cross(a, b, p) == 0 && fmin(a.x, b.x) <= p.x && p.x <= fmax(a.x, b.x) &&
           fmin(a.y, b.y) <= p.y && p.y <= fmax(a.y, b.y);
}

static bool crosses(sl_point a, sl_point b, const sl_wall *w) {
    return cross(a, b, w->a) * cross(a, b, w->b) < 0 &&
           cross(w->a, w->b, a) * cross(w->a, w->b, b) < 0;
}

static bool touches(sl_point a, sl_point b, const sl_wall *w) {
    return crosses(a, b, w) || on_segment(a, b, w->a) || on_segment(a, b, w->b) ||
           on_segment(w->a, w->b, a) || on_segment(w->a, w->b, b);
}

/// The wall that a ray turned a little to the left meets first; on a tie either. UINT32_MAX: none.
static double first_wall(const sl_space *space, sl_point eye, sl_point through, uint32_t *wall) {
    const sl_point d = {through.x - eye.x, through.y - eye.y};
    const sl_point ray = {d.x - 0x1p-20 * d.y, d.y + 0x1p-20 * d.x}, origin = {0, 0};
    double least = INFINITY;
    *wall = UINT32_MAX;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        const sl_point a = {w->a.x - eye.x, w->a.y - eye.y}, b = {w->b.x - eye.x, w->b.y - eye.y};
        if (cross(origin, ray, a) * cross(origin, ray, b) >= 0) continue;
        const sl_point along = {b.x - a.x, b.y - a.y};
        const double share = cross(origin, a, along) / cross(origin, ray, along);
        if (share < 0 || share >= least) continue;
        least = share;
        *wall = i;
    }
    return least;
}

static sl_point random_point(const sl_space *space, sl_random *random) {
    const sl_box *b = &space->bounds;
    const uint64_t wide = (uint64_t)(2 * (b->max.x - b->min.x)) + 1;
    const uint64_t high = (uint64_t)(2 * (b->max.y - b->min.y)) + 1;
    return (sl_point){b->min.x + (double)sl_random_below(random, wide) / 2,
                      b->min.y + (double)sl_random_below(random, high) / 2};
}

typedef struct tally {
    int closed, open, grazing, shots;
} tally;

static void check_pair(sl_context *context, const sl_outline *outline, sl_point eye, sl_point point,
                       tally *count) {
    const sl_space *space = outline->space;
    bool closed = false, open = false, back = false, free = true, crossed = false, on_wall = false;
    assert_ok(context, sli_sees(context, outline, eye, point, SL_CLOSED, &closed));
    assert_ok(context, sli_sees(context, outline, eye, point, SL_OPEN, &open));
    assert_ok(context, sli_sees(context, outline, point, eye, SL_CLOSED, &back));
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        free = free && !touches(eye, point, w);
        crossed = crossed || crosses(eye, point, w);
        on_wall = on_wall || on_segment(w->a, w->b, eye) || on_segment(w->a, w->b, point);
    }
    assert_int_equal(open, free);
    assert_true(closed || !open);
    assert_false(closed && crossed);
    if (!on_wall) assert_int_equal(closed, back);
    count->closed += closed;
    count->open += open;
    count->grazing += closed && !open;
    if (on_wall || (eye.x == point.x && eye.y == point.y)) return;
    sl_hit hit;
    uint32_t wall;
    assert_ok(context, sli_ray_cast(context, outline, eye, point, &hit));
    const double share = first_wall(space, eye, point, &wall);
    assert_int_equal(hit.wall, wall);
    if (wall == UINT32_MAX) return;
    const double reach = hypot(hit.point.x - eye.x, hit.point.y - eye.y);
    const double due = share * hypot(point.x - eye.x, point.y - eye.y);
    assert_true(fabs(reach - due) <= 1e-3 * (1 + due));
    count->shots++;
}

static void as_every_wall_says(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    tally count = {0};
    for (uint64_t seed = 1; seed <= 150; seed++) {
        sl_map map = {0};
        sl_space space = {0};
        sl_outline outline = {0};
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        const sl_subdivide_options options = sl_subdivide_options_default();
        if (map.wall_count && sli_subdivide_kd(context, &map, &options, &space) == SL_OK) {
            assert_ok(context, sli_outline_make(context, &space, &outline));
            sl_random random = {seed};
            for (int i = 0; i < 200; i++)
                check_pair(context, &outline, random_point(&space, &random),
                           random_point(&space, &random), &count);
        }
        sli_outline_destroy(context, &outline);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    assert_true(count.open > 1000 && count.grazing > 1000 && count.shots > 1000);
    assert_true(count.closed < 150 * 200);
    sl_context_destroy(context);
}

/// Walls of all magnitudes, and some steps of doubles apart.
static void among_oblique_walls(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const uint64_t seeds = testing_seeds(1000);
    size_t counts[2] = {0};
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_map map = {0};
        sl_space space = {0};
        sl_outline outline = {0};
        sl_random random = {seed};
        const oblique_grid grid = (oblique_grid)(seed % OBLIQUE_GRIDS);
        assert_ok(context, oblique_random_map(context, seed, grid, 12, &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        const bool made = sli_subdivide_mesh(context, &map, &space) == SL_OK;
        if (made) assert_ok(context, sli_outline_make(context, &space, &outline));
        for (int i = 0; i < 100 && made; i++) {
            const sl_point p = oblique_random_point(&random, &map, space.bounds);
            const sl_point q = i % 9 ? oblique_random_point(&random, &map, space.bounds) : p;
            if (sl_space_locate(&space, p) == SL_NO_CELL ||
                sl_space_locate(&space, q) == SL_NO_CELL)
                continue;
            bool seen;
            assert_ok(context, sli_sees(context, &outline, p, q, SL_OPEN, &seen));
            if (seen != oblique_is_free(&map, p, q))
                fail_msg("seed %d: %.17g %.17g to %.17g %.17g: %d", (int)seed, p.x, p.y, q.x, q.y,
                         seen);
            counts[seen]++;
        }
        sli_outline_destroy(context, &outline);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    assert_true(counts[0] > seeds && counts[1] > seeds);
    sl_context_destroy(context);
}

/// A point a rounding away from where three walls cross: rooms on all sides reach to it.
static void beside_a_crossing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    sl_outline outline;
    testing_space(context,
                  "wall 6.596019314557644 8.141465400346082 68.17049733805885 88.43245635397898\n"
                  "wall 28.550868439696664 79.39966056623055 87.73486867641729 52.30671798509814\n"
                  "wall 37.30095052412456 81.20179809802582 51.551989641147046 71.37708028432638\n"
                  "wall 39.26494500635116 140.267989688547 49.58799515892044 12.310888693805211\n"
                  "wall 40.41421690502257 60.54203689753292 48.438723260249034 92.03684148481929\n"
                  "wall 43.59653998247251 16.703498914055103 45.2564001827991 135.8753794682971\n",
                  &map, &space);
    assert_ok(context, sli_outline_make(context, &space, &outline));
    const sl_point eye = {44.426470082635802, 76.289439191176129};
    const sl_point point = {41.888425542764288, 109.38618019456719};
    assert_true(oblique_is_free(&map, eye, point));
    bool seen;
    assert_ok(context, sli_sees(context, &outline, eye, point, SL_OPEN, &seen));
    assert_true(seen);
    sli_outline_destroy(context, &outline);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Where a segment passes within sides alone, and where it ends at a wall: no room is remembered.
static void plain_pairs_take_no_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_space space = {0};
    sl_outline outline = {0};
    testing_space(context, "walls 0 0 8 0 8 8 0 8 0 0\nwall 2 0 2 4\nwall 4 4 4 8\nwall 5 1 7 2\n",
                  &map, &space);
    assert_ok(context, sli_outline_make(context, &space, &outline));
    const struct {
        sl_point eye, point;
        bool seen;
    } pairs[] = {{{1.3, 3.3}, {3.7, 6.9}, true},  {{1.3, 1.1}, {6.2, 1.3}, false},
                 {{3.1, 0.7}, {7.7, 1.9}, false}, {{3.1, 0.7}, {6.1, 2.1}, true},
                 {{3.1, 0.7}, {7.7, 0.9}, true},  {{6.3, 3.6}, {3.1, 3.4}, true}};
    const long calls = memory.calls;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        bool seen = !pairs[i].seen;
        assert_ok(context,
                  sli_sees(context, &outline, pairs[i].eye, pairs[i].point, SL_OPEN, &seen));
        assert_int_equal(seen, pairs[i].seen);
        assert_ok(context,
                  sli_sees(context, &outline, pairs[i].point, pairs[i].eye, SL_CLOSED, &seen));
        assert_int_equal(seen, pairs[i].seen);
    }
    assert_int_equal(memory.calls, calls);
    sli_outline_destroy(context, &outline);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void corners_and_slits(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    sl_outline outline = {0};
    testing_space(
        context,
        "walls 0 0 8 0 8 8 0 8 0 0\nwall 2 0 2 4\nwall 4 4 4 8\nwall 6 0 6 4\nwall 6 4 6 8\n", &map,
        &space);
    assert_ok(context, sli_outline_make(context, &space, &outline));
    bool seen = false;
    // Along y = 4: past one corner on its upper and one on its lower side.
    assert_ok(context,
              sli_sees(context, &outline, (sl_point){1, 4}, (sl_point){5, 4}, SL_CLOSED, &seen));
    assert_true(seen);
    assert_ok(context,
              sli_sees(context, &outline, (sl_point){1, 4}, (sl_point){5, 4}, SL_OPEN, &seen));
    assert_false(seen);
    // Where two walls meet in a corner there is no way between them.
    assert_ok(context,
              sli_sees(context, &outline, (sl_point){1, 4}, (sl_point){7, 4}, SL_CLOSED, &seen));
    assert_false(seen);
    assert_ok(context,
              sli_sees(context, &outline, (sl_point){9, 4}, (sl_point){7, 4}, SL_CLOSED, &seen));
    assert_false(seen);
    sl_hit hit;
    const sl_point eye = {1, 4}, outside = {9, 9};
    assert_ok(context, sli_ray_cast(context, &outline, eye, (sl_point){2, 4}, &hit));
    assert_true(hit.point.x == 4 && hit.point.y == 4);
    assert_ok(context, sli_ray_cast(context, &outline, (sl_point){2, 1}, (sl_point){1, 1}, &hit));
    assert_true(hit.point.x == 2 && hit.point.y == 1);
    assert_int_equal(sli_ray_cast(context, &outline, eye, eye, &hit), SL_BAD_ARGUMENT);
    assert_int_equal(sli_ray_cast(context, &outline, outside, eye, &hit), SL_BAD_ARGUMENT);
    assert_int_equal(sli_ray_cast(context, &outline, eye, (sl_point){NAN, 0}, &hit),
                     SL_BAD_ARGUMENT);
    sli_outline_destroy(context, &outline);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_every_wall_says), cmocka_unit_test(among_oblique_walls),
        cmocka_unit_test(beside_a_crossing),  cmocka_unit_test(plain_pairs_take_no_memory),
        cmocka_unit_test(corners_and_slits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
