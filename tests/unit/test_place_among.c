// Placement among listed places against all subsets of them: fields of view, ranges, costs,
// demands, fixed places, and the most that a number of places sees.
#include "testing.h"

#include "sightline/place.h"
#include "sightline/support.h"

#include <math.h>

enum { PLACES = 12, TARGETS = 30 };

#define PLAN "open 0 0 12 0 12 8 0 8\nsolid 3 3 5 3 5 5 3 5\nsolid 7 2 8 2 8 6 7 6\nwall 9 8 9 5\n"

typedef struct scene {
    testing_memory memory;
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_viewpoint places[PLACES];
    sl_point targets[TARGETS];
    uint32_t costs[PLACES], demands[TARGETS], fixed[2];
    double weights[TARGETS];
    sl_place_list list;
    uint32_t sees[PLACES]; ///< bits of targets
} scene;

static sl_point draw(scene *s, sl_random *random) {
    for (;;) {
        const sl_point at = {12 * sl_random_unit(random), 8 * sl_random_unit(random)};
        if (sl_space_is_inside(&s->space, at)) return at;
    }
}

/// Whether the place sees the target, by other means than the library's cones and regions.
static bool sees_by_angle(scene *s, const sl_viewpoint *p, sl_point at) {
    bool sees;
    assert_ok(s->context, sl_query_sees(s->context, s->query, p->at, at, &sees));
    const double x = at.x - p->at.x, y = at.y - p->at.y;
    if (p->range > 0 && x * x + y * y > p->range * p->range) return false;
    const double off =
        fabs(remainder(atan2(y, x) - p->heading * 0.017453292519943295, 6.283185307179586));
    return sees && (p->fov >= 360 || off <= p->fov * 0.5 * 0.017453292519943295);
}

static void begin(scene *s, uint64_t seed, double fov, double range) {
    sl_random random = {seed};
    *s = (scene){0};
    s->context = testing_context(&s->memory);
    testing_space(s->context, PLAN, &s->map, &s->space);
    assert_ok(s->context, sl_query_over(s->context, &s->space, &s->map, NULL, &s->query));
    for (int i = 0; i < TARGETS; i++) s->targets[i] = draw(s, &random);
    for (int i = 0; i < TARGETS; i++) s->demands[i] = 1 + (uint32_t)sl_random_below(&random, 2);
    for (int i = 0; i < TARGETS; i++) s->weights[i] = 1 + (double)sl_random_below(&random, 5);
    for (int i = 0; i < PLACES; i++) {
        // Two headings at each point.
        const sl_point at = i % 2 ? s->places[i - 1].at : draw(s, &random);
        s->places[i] = (sl_viewpoint){
            .at = at, .heading = 360 * sl_random_unit(&random), .fov = fov, .range = range};
        s->costs[i] = 1 + (uint32_t)sl_random_below(&random, 4);
        for (int t = 0; t < TARGETS; t++)
            s->sees[i] |= (uint32_t)sees_by_angle(s, &s->places[i], s->targets[t]) << t;
    }
    s->list = (sl_place_list){
        .places = s->places, .place_count = PLACES, .targets = s->targets, .target_count = TARGETS};
}

static void end(scene *s) {
    sl_query_destroy(s->context, s->query);
    sl_space_destroy(s->context, &s->space);
    sl_map_destroy(s->context, &s->map);
    sl_context_destroy(s->context);
    assert_int_equal(s->memory.live, 0);
}

static bool holds(const scene *s, uint32_t set) {
    for (uint32_t i = 0; i < s->list.fixed_count; i++)
        if (!(set >> s->list.fixed[i] & 1)) return false;
    for (int t = 0; t < TARGETS; t++) {
        uint32_t seers = 0;
        for (int i = 0; i < PLACES; i++) seers += set >> i & s->sees[i] >> t & 1;
        if (seers < (s->list.demands ? s->list.demands[t] : 1)) return false;
    }
    return true;
}

static uint64_t cost_of(const scene *s, uint32_t set) {
    uint64_t cost = 0;
    for (int i = 0; i < PLACES; i++)
        if (set >> i & 1) cost += s->list.costs ? s->list.costs[i] : 1;
    return cost;
}

static double weight_of(const scene *s, uint32_t set) {
    uint32_t seen = 0;
    double weight = 0;
    for (int i = 0; i < PLACES; i++)
        if (set >> i & 1) seen |= s->sees[i];
    for (int t = 0; t < TARGETS; t++)
        if (seen >> t & 1) weight += s->list.weights ? s->list.weights[t] : 1;
    return weight;
}

/// The set of a result's viewpoints.
static uint32_t set_of(const scene *s, const sl_placement *placed) {
    uint32_t set = 0, next = 0;
    for (int i = 0; i < PLACES && next < placed->count; i++)
        if (memcmp(&placed->viewpoints[next], &s->places[i], sizeof s->places[i]) == 0)
            set |= 1u << i, next++;
    assert_int_equal(next, placed->count);
    return set;
}

static int check_fewest(scene *s) {
    uint64_t best = UINT64_MAX;
    for (uint32_t set = 0; set < 1u << PLACES; set++)
        if (holds(s, set) && cost_of(s, set) < best) best = cost_of(s, set);
    sl_placement placed = {0};
    const sl_status status = sl_place_among(s->context, s->query, &s->list, NULL, &placed);
    if (best == UINT64_MAX) {
        assert_int_equal(status, SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(s->context), "target "));
        return 0;
    }
    assert_int_equal(status, SL_OK);
    assert_int_equal(placed.upper, best);
    assert_int_equal(placed.lower, best);
    assert_true(holds(s, set_of(s, &placed)));
    assert_int_equal(cost_of(s, set_of(s, &placed)), best);
    sl_placement_destroy(s->context, &placed);
    return 1;
}

/// Leaves out the targets that too few places see.
static void drop_hopeless(scene *s) {
    uint32_t count = 0;
    uint32_t kept[PLACES] = {0};
    sl_point targets[TARGETS];
    for (int t = 0; t < TARGETS; t++) {
        uint32_t seers = 0;
        for (int i = 0; i < PLACES; i++) seers += s->sees[i] >> t & 1;
        if (seers < 2) continue;
        for (int i = 0; i < PLACES; i++) kept[i] |= (s->sees[i] >> t & 1) << count;
        targets[count++] = s->targets[t];
    }
    // What is seen nowhere is replaced by one that is: the number stays.
    for (int t = (int)count; t < TARGETS; t++) {
        for (int i = 0; i < PLACES; i++) kept[i] |= (kept[i] & 1) << t;
        targets[t] = targets[0];
    }
    memcpy(s->targets, targets, sizeof targets);
    memcpy(s->sees, kept, sizeof kept);
}

static void fewest(void **state) {
    (void)state;
    static const double fovs[] = {360, 180, 90}, ranges[] = {0, 6, 4};
    int solved = 0;
    const uint64_t seeds = testing_seeds(6);
    for (uint64_t seed = 0; seed < seeds; seed++)
        for (int k = 0; k < 3; k++) {
            scene s;
            begin(&s, 100 * seed + (uint64_t)k, fovs[k], ranges[k]);
            solved += check_fewest(&s);
            drop_hopeless(&s);
            solved += check_fewest(&s);
            s.list.costs = s.costs;
            solved += check_fewest(&s);
            s.list.demands = s.demands;
            solved += check_fewest(&s);
            s.fixed[0] = 3;
            s.fixed[1] = 8;
            s.list.fixed = s.fixed;
            s.list.fixed_count = 2;
            solved += check_fewest(&s);
            end(&s);
        }
    assert_true(solved >= (int)(3 * 4 * seeds));
}

static void most(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(6);
    for (uint64_t seed = 0; seed < seeds; seed++) {
        scene s;
        begin(&s, seed, 120, 0);
        s.list.weights = s.weights;
        for (uint32_t count = 1; count <= 4; count++) {
            s.list.count = count;
            s.fixed[0] = 5;
            s.list.fixed = s.fixed;
            s.list.fixed_count = count % 2;
            double best = 0;
            for (uint32_t set = 0; set < 1u << PLACES; set++) {
                uint32_t size = 0;
                for (int i = 0; i < PLACES; i++) size += set >> i & 1;
                if (size > count + s.list.fixed_count || (s.list.fixed_count && !(set >> 5 & 1)))
                    continue;
                if (weight_of(&s, set) > best) best = weight_of(&s, set);
            }
            sl_placement placed = {0};
            assert_ok(s.context, sl_place_among(s.context, s.query, &s.list, NULL, &placed));
            assert_true(placed.count <= count + s.list.fixed_count);
            assert_true(placed.seen == weight_of(&s, set_of(&s, &placed)));
            assert_true(placed.seen <= best && best <= placed.seen_bound);
            sl_placement_destroy(s.context, &placed);
        }
        end(&s);
    }
}

static bool has(const sl_point *points, uint32_t count, double x, double y) {
    for (uint32_t i = 0; i < count; i++)
        if (points[i].x == x && points[i].y == y) return true;
    return false;
}

static void points_of_a_plan(void **state) {
    (void)state;
    scene s;
    sl_point *points;
    uint32_t count;
    begin(&s, 1, 360, 0);
    assert_ok(s.context, sl_place_points(s.context, s.query, SL_PLACE_CORNERS, 0, &points, &count));
    assert_int_equal(count, 14); // the hall's, two pillars' and a wall's, each once
    assert_true(has(points, count, 9, 5) && has(points, count, 3, 3) && has(points, count, 0, 8));
    sl_free(s.context, points);
    // 11 walls, and a thin one with two sides; its end cuts the wall that it stands on.
    assert_ok(s.context, sl_place_points(s.context, s.query, SL_PLACE_WALLS, 0, &points, &count));
    assert_true(count >= 15);
    for (uint32_t i = 0; i < count; i++) assert_true(sl_space_is_inside(&s.space, points[i]));
    const uint32_t few = count;
    sl_free(s.context, points);
    assert_ok(s.context, sl_place_points(s.context, s.query, SL_PLACE_WALLS, 0.5, &points, &count));
    assert_true(count > 3 * few);
    sl_free(s.context, points);
    assert_ok(s.context, sl_place_points(s.context, s.query, SL_PLACE_GRID, 2, &points, &count));
    assert_int_equal(count, 7 * 5 - 1); // (4, 4) is solid
    assert_false(has(points, count, 4, 4));
    sl_free(s.context, points);
    assert_int_equal(sl_place_points(s.context, s.query, SL_PLACE_GRID, 0, &points, &count),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_place_points(s.context, s.query, SL_PLACE_GRID, 1e-9, &points, &count),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_place_points(s.context, s.query, SL_PLACE_WALLS, -1, &points, &count),
                     SL_BAD_ARGUMENT);
    end(&s);
}

static void refused(void **state) {
    (void)state;
    scene s;
    sl_placement placed = {0};
    begin(&s, 1, 360, 0);
    s.places[2].fov = 0;
    assert_int_equal(sl_place_among(s.context, s.query, &s.list, NULL, &placed), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(s.context), "place 3"));
    s.places[2].fov = 90;
    s.fixed[0] = PLACES;
    s.list.fixed = s.fixed;
    s.list.fixed_count = 1;
    assert_int_equal(sl_place_among(s.context, s.query, &s.list, NULL, &placed), SL_BAD_ARGUMENT);
    s.list.fixed_count = 0;
    s.targets[4] = (sl_point){4, 4}; // in solid ground
    assert_int_equal(sl_place_among(s.context, s.query, &s.list, NULL, &placed), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(s.context), "(4, 4)"));
    assert_null(placed.viewpoints);
    end(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fewest),
        cmocka_unit_test(most),
        cmocka_unit_test(points_of_a_plan),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
