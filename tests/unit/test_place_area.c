// Placement for an area against points at random and beside corners, each asked of sl_query_sees
// and angles; and against all subsets of the places.
#include "place_scene.h"

enum { SAMPLES = 10000 };

static bool within(const sl_shape *shape, sl_point p) {
    if (!shape) return true;
    const sl_point low = shape->points[0], high = shape->points[2];
    return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y;
}

/// Every point that places could see is seen, as often as asked or as they could.
static void check_points(scene *s, const sl_area_placement *placed) {
    sl_random random = {11};
    const uint32_t cover = s->area.cover ? s->area.cover : 1;
    uint32_t asked = 0;
    for (int k = 0; k < SAMPLES; k++) {
        const sl_point at = sample(s, &random, k);
        uint32_t all = 0, chosen = 0;
        bool near = false, seen[PLACES];
        if (!within(s->area.see, at)) continue;
        for (int i = 0; i < PLACES; i++) all += seen[i] = sees(s, &s->places[i], at, &near);
        if (near) continue;
        for (uint32_t i = 0; i < placed->count; i++) chosen += seen[placed->chosen[i]];
        assert_true(chosen >= (all < cover ? all : cover));
        asked += all > 0;
    }
    assert_true(asked > 0);
}

/// The area that a set of places sees of all that is inside.
static double area_of(scene *s, uint32_t set) {
    sl_viewpoint chosen[PLACES];
    sl_coverage coverage;
    size_t count = 0;
    for (int i = 0; i < PLACES; i++)
        if (set >> i & 1) chosen[count++] = s->places[i];
    if (!count) return 0;
    assert_ok(s->context, sl_coverage_make(s->context, s->query, chosen, count, &coverage));
    const double area = coverage.overlay.areas[1];
    sl_coverage_destroy(s->context, &coverage);
    return area;
}

/// No set that costs less sees as much as all places together.
static void check_lower(scene *s, const sl_area_placement *placed) {
    const uint32_t every = (1u << PLACES) - 1;
    const double most = area_of(s, every);
    uint32_t tried = 0;
    for (uint32_t set = 0; set <= every; set++) {
        // The dearest of the cheaper sets: another place makes them too dear.
        if (cost_of(s, set) + 1 != placed->lower) continue;
        assert_true(area_of(s, set) < most * (1 - 1e-9));
        if (++tried == 40) break;
    }
}

static void test_fewest(void **state) {
    (void)state;
    static const sl_viewpoint kinds[] = {{.fov = 360},
                                         {.fov = 90},
                                         {.fov = 200, .range = 6},
                                         {.fov = 360, .range = 5, .nearest = 1}};
    static const char *const plans[] = {PLAN, TURNED};
    for (unsigned k = 0; k < 12; k++) {
        scene s;
        begin(&s, plans[k % 2], 100 + k, kinds[k / 2 % 4]);
        if (k % 3 == 0) s.area.costs = s.costs;
        sl_area_placement placed = place(&s);
        // With ranges, the bounds are of arcs and of chords.
        if (k / 2 % 4 < 2) assert_int_equal(placed.lower, placed.upper);
        check_points(&s, &placed);
        check_lower(&s, &placed);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

/// A limit in rounds ends the work early, with a set that sees all and a bound that holds.
static void test_rounds(void **state) {
    (void)state;
    scene s;
    sl_point *points;
    uint32_t count;
    sl_place_options one = sl_place_options_default();
    one.rounds = 1;
    begin(&s, PLAN, 1, (sl_viewpoint){.fov = 360});
    assert_ok(s.context, sl_place_points(s.context, s.query, SL_PLACE_WALLS, 0.5, &points, &count));
    sl_viewpoint *places = calloc(count, sizeof *places);
    assert_non_null(places);
    for (uint32_t i = 0; i < count; i++)
        places[i] = (sl_viewpoint){.at = points[i], .heading = 75.0 * i, .fov = 90};
    s.area = (sl_place_area){.places = places, .place_count = count};
    sl_area_placement whole = {0}, placed = {0};
    assert_ok(s.context, sl_place_area_cover(s.context, s.query, &s.area, NULL, &whole));
    assert_true(whole.rounds > 1);
    assert_ok(s.context, sl_place_area_cover(s.context, s.query, &s.area, &one, &placed));
    assert_int_equal(placed.rounds, 1);
    assert_true(placed.lower <= whole.upper && placed.upper >= whole.lower);
    assert_true(fabs(placed.seen - whole.seen) <= 1e-9 * whole.area);
    sl_area_placement_destroy(s.context, &placed);
    sl_area_placement_destroy(s.context, &whole);
    sl_free(s.context, points);
    free(places);
    end(&s);
}

/// Places just off walls leave strips beside them that are thinner than a millionth of the plan.
static void test_off_walls(void **state) {
    (void)state;
    for (unsigned k = 0; k < 3; k++) {
        sl_point *points;
        uint32_t count;
        scene s;
        begin(&s, PLAN, 400 + k, (sl_viewpoint){.fov = 110});
        assert_ok(s.context,
                  sl_place_points(s.context, s.query, SL_PLACE_WALLS, 0, &points, &count));
        assert_true(count >= PLACES);
        for (int i = 0; i < PLACES; i++) s.places[i].at = points[i];
        sl_area_placement placed = place(&s);
        check_points(&s, &placed);
        check_lower(&s, &placed);
        sl_area_placement_destroy(s.context, &placed);
        sl_free(s.context, points);
        end(&s);
    }
}

/// Views from one eye have the same chords up to their range, so those between two that see all
/// see nothing more. In the second plan a wall cuts the arcs, in the third one it touches them.
static void test_one_eye(void **state) {
    (void)state;
    static const char *const plans[] = {"open 0 0 12 0 12 12 0 12\n", "open 0 0 12 0 12 7 0 7\n",
                                        "open 0 0 12 0 12 9 0 9\n"};
    for (int k = 0; k < 6; k++) {
        scene s;
        begin(&s, plans[k % 3], 500, (sl_viewpoint){.fov = 90, .range = 4});
        for (int i = 0; i < PLACES; i++) {
            s.places[i].at = (sl_point){6.3, 5};
            s.places[i].heading = 10 * i;
            s.places[i].nearest = k / 3;
        }
        sl_area_placement placed = place(&s);
        assert_int_equal(placed.lower, 2);
        assert_int_equal(placed.upper, 2);
        check_points(&s, &placed);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

static void test_demands_and_fixed(void **state) {
    (void)state;
    for (unsigned k = 0; k < 6; k++) {
        const uint32_t fixed[2] = {1, 4};
        scene s;
        begin(&s, PLAN, 200 + k, (sl_viewpoint){.fov = k % 2 ? 360 : 150, .range = k < 3 ? 0 : 7});
        s.area.cover = 2;
        s.area.fixed = fixed;
        s.area.fixed_count = 2;
        sl_area_placement placed = place(&s);
        int found = 0;
        for (uint32_t i = 0; i < placed.count; i++)
            found += placed.chosen[i] == 1 || placed.chosen[i] == 4;
        assert_int_equal(found, 2);
        check_points(&s, &placed);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

static void test_zone(void **state) {
    (void)state;
    const sl_point corners[] = {{1, 1}, {6, 1}, {6, 6}, {1, 6}};
    const size_t count = 4;
    const sl_shape zone = {corners, &count, 1};
    scene s;
    begin(&s, PLAN, 7, (sl_viewpoint){.fov = 120});
    s.area.see = &zone;
    sl_area_placement placed = place(&s);
    assert_true(fabs(placed.area - 21) < 1e-9);
    check_points(&s, &placed);
    sl_area_placement_destroy(s.context, &placed);
    end(&s);
}

static void test_most(void **state) {
    (void)state;
    for (unsigned k = 0; k < 6; k++) {
        scene s;
        begin(&s, k % 2 ? PLAN : TURNED, 300 + k,
              (sl_viewpoint){.fov = k % 3 ? 80 : 360, .range = k < 3 ? 0 : 4});
        const uint32_t fixed = 2;
        s.area.count = 1 + k % 3;
        s.area.fixed = &fixed;
        s.area.fixed_count = k / 3;
        sl_area_placement placed = place(&s);
        assert_int_equal(placed.count, s.area.count + s.area.fixed_count);
        uint32_t chosen = 0;
        double best = 0;
        for (uint32_t i = 0; i < placed.count; i++) chosen |= 1u << placed.chosen[i];
        assert_true(fabs(area_of(&s, chosen) - placed.seen) < 1e-9 * placed.area);
        for (uint32_t set = 0; set < 1u << PLACES; set++) {
            uint32_t size = 0;
            for (int i = 0; i < PLACES; i++) size += set >> i & 1;
            const bool stands = !s.area.fixed_count || set >> fixed & 1;
            if (size == placed.count && stands) best = fmax(best, area_of(&s, set));
        }
        assert_true(best <= placed.seen_most);
        assert_true(placed.seen <= best + 1e-9 * placed.area);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

/// So many places that they see everything are proven best, whatever sums of areas are rounded to;
/// one place alone sees less than the bound.
static void test_most_is_all(void **state) {
    (void)state;
    uint32_t all = 0;
    for (unsigned k = 0; k < 12; k++) {
        scene s;
        begin(&s, k % 2 ? PLAN : TURNED, 400 + k, (sl_viewpoint){.fov = 360});
        sl_area_placement placed = place(&s);
        const bool sees_all = !placed.blind_count;
        sl_area_placement_destroy(s.context, &placed);
        s.area.count = PLACES;
        placed = place(&s);
        if (sees_all) assert_true(placed.seen == placed.seen_most);
        all += sees_all;
        sl_area_placement_destroy(s.context, &placed);
        s.area.count = 1;
        placed = place(&s);
        assert_true(placed.seen < placed.seen_most);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
    assert_true(all > 0);
}

/// The area that is seen within a box: pieces cut by its sides one after the other.
static double area_within(const sl_coverage *coverage, const sl_point box[4]) {
    const sl_space *pieces = &coverage->overlay.pieces;
    double area = 0;
    for (uint32_t c = 0; c < pieces->cell_count; c++) {
        sl_point now[64], next[64];
        size_t count = pieces->cells[c].vertex_count;
        if (!pieces->cells[c].inside || !coverage->overlay.counts[c]) continue;
        assert_true(count < 32);
        memcpy(now, &pieces->vertices[pieces->cells[c].first_vertex], count * sizeof *now);
        for (int side = 0; side < 4; side++) {
            const sl_point a = box[side], b = box[(side + 1) % 4];
            size_t left = 0;
            for (size_t i = 0; i < count; i++) {
                const sl_point p = now[i], q = now[(i + 1) % count];
                const double u = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
                const double v = (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
                if (u >= 0) next[left++] = p;
                if ((u >= 0) != (v >= 0))
                    next[left++] = (sl_point){p.x + u / (u - v) * (q.x - p.x),
                                              p.y + u / (u - v) * (q.y - p.y)};
            }
            count = left;
            memcpy(now, next, count * sizeof *now);
        }
        for (size_t i = 1; i + 1 < count; i++)
            area += ((now[i].x - now[0].x) * (now[i + 1].y - now[0].y) -
                     (now[i].y - now[0].y) * (now[i + 1].x - now[0].x)) /
                    2;
    }
    return area;
}

/// Zones of which one is worth more, one lies in the other, and one is partly outside: against all
/// sets of places.
static void test_weights(void **state) {
    (void)state;
    const sl_point corners[3][4] = {{{0, 0}, {6, 0}, {6, 3}, {0, 3}},
                                    {{1, 1}, {3, 1}, {3, 2}, {1, 2}},
                                    {{8.5, 4}, {14, 4}, {14, 9}, {8.5, 9}}};
    const size_t count = 4;
    const sl_shape zones[3] = {
        {corners[0], &count, 1}, {corners[1], &count, 1}, {corners[2], &count, 1}};
    const double weights[3] = {1, 7, 2.5};
    for (unsigned k = 0; k < 4; k++) {
        scene s;
        begin(&s, k % 2 ? PLAN : TURNED, 600 + k, (sl_viewpoint){.fov = k < 2 ? 100 : 360});
        s.area.count = 1 + k % 3;
        s.area.zones = zones;
        s.area.weights = weights;
        s.area.zone_count = 3;
        sl_area_placement placed = place(&s);
        double best = 0, seen = 0;
        uint32_t chosen = 0;
        for (uint32_t i = 0; i < placed.count; i++) chosen |= 1u << placed.chosen[i];
        if (k % 2) assert_true(fabs(placed.area - (18 + 7 * 2 + 2.5 * 14)) < 1e-9);
        for (uint32_t set = 0; set < 1u << PLACES; set++) {
            sl_viewpoint views[PLACES];
            sl_coverage coverage;
            size_t size = 0;
            double worth = 0;
            for (int i = 0; i < PLACES; i++)
                if (set >> i & 1) views[size++] = s.places[i];
            if (size != s.area.count) continue;
            assert_ok(s.context, sl_coverage_make(s.context, s.query, views, size, &coverage));
            for (int z = 0; z < 3; z++) worth += weights[z] * area_within(&coverage, corners[z]);
            sl_coverage_destroy(s.context, &coverage);
            best = fmax(best, worth);
            if (set == chosen) seen = worth;
        }
        assert_true(fabs(seen - placed.seen) < 1e-9 * placed.area);
        assert_true(best <= placed.seen_most);
        assert_true(placed.seen >= 0.9 * best);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

/// Whether lines of sight join all places of a set.
static bool is_network(scene *s, uint32_t set) {
    uint32_t joined = set & (0u - set), before = 0;
    while (joined != before) {
        before = joined;
        for (int i = 0; i < PLACES; i++)
            for (int j = 0; j < PLACES; j++) {
                const sl_viewpoint *p = &s->places[i], *q = &s->places[j];
                bool there, back;
                if (!(joined >> i & 1) || !(set >> j & 1) || joined >> j & 1) continue;
                const double distance = hypot(p->at.x - q->at.x, p->at.y - q->at.y);
                if ((p->range > 0 && distance > p->range) || (q->range > 0 && distance > q->range))
                    continue;
                assert_ok(s->context, sl_query_sees(s->context, s->query, p->at, q->at, &there));
                assert_ok(s->context, sl_query_sees(s->context, s->query, q->at, p->at, &back));
                if (there && back) joined |= 1u << j;
            }
    }
    return joined == set;
}

/// The areas that a set sees by one place, and by two.
static void areas_of(scene *s, uint32_t set, double areas[2]) {
    sl_viewpoint chosen[PLACES];
    sl_coverage coverage;
    size_t count = 0;
    for (int i = 0; i < PLACES; i++)
        if (set >> i & 1) chosen[count++] = s->places[i];
    assert_ok(s->context, sl_coverage_make(s->context, s->query, chosen, count, &coverage));
    for (uint32_t k = 0; k < 2; k++) areas[k] = k < count ? coverage.overlay.areas[k + 1] : 0;
    sl_coverage_destroy(s->context, &coverage);
}

/// No network of less than a cost, with the fixed places, sees all that all places see. What is
/// part of a network that does not sees no more.
static void check_networks(scene *s, uint64_t cost) {
    const uint32_t cover = s->area.cover ? s->area.cover : 1, every = (1u << PLACES) - 1;
    double all[2], areas[2];
    uint32_t fixed = 0, tried[1u << PLACES], count = 0;
    for (uint32_t i = 0; i < s->area.fixed_count; i++) fixed |= 1u << s->area.fixed[i];
    areas_of(s, every, all);
    for (uint32_t set = every; set > 0; set--) {
        if ((set & fixed) != fixed || cost_of(s, set) >= cost) continue;
        uint32_t i = 0;
        while (i < count && (set & tried[i]) != set) i++;
        if (i < count || !is_network(s, set)) continue;
        tried[count++] = set;
        areas_of(s, set, areas);
        assert_true(areas[0] < all[0] * (1 - 1e-9) ||
                    (cover > 1 && areas[1] < all[1] - 1e-9 * all[0]));
    }
}

/// Networks against all sets of places. A wall parts the plan but for a gap at its end, or all of
/// it; places may stand on walls and see one side of them.
static void test_network(void **state) {
    (void)state;
    static const sl_viewpoint kinds[] = {
        {.fov = 360}, {.fov = 250}, {.fov = 360, .range = 7}, {.fov = 200, .range = 9}};
    static const char *const plans[] = {PLAN, TURNED, PLAN "wall 5 8 5 5\nwall 8 2 8 0\n",
                                        PLAN "wall 5 8 5 5\nwall 4 3 4 0\n"};
    static const uint32_t fixed[2] = {0, 7};
    uint32_t dearer = 0, refused = 0, proven = 0;
    for (unsigned k = 0; k < 24; k++) {
        scene s;
        sl_random random = {k};
        sl_area_placement free = {0}, placed = {0};
        begin(&s, plans[k % 4], 500 + k, kinds[k / 4 % 4]);
        for (int i = 1; i < PLACES && k % 6; i += 2) s.places[i].at = draw(&s, &random);
        if (k % 3 == 0) s.area.costs = s.costs;
        if (k % 5 == 0) s.area.cover = 2;
        if (k % 7 == 0) {
            s.area.fixed = fixed;
            s.area.fixed_count = 2;
        }
        if (k % 8 == 3) s.places[2].at = s.places[3].at = s.space.walls[5].a;
        assert_ok(s.context, sl_place_area_cover(s.context, s.query, &s.area, NULL, &free));
        s.area.network = true;
        const sl_status status = sl_place_area_cover(s.context, s.query, &s.area, NULL, &placed);
        if (status == SL_OK) {
            uint32_t set = 0;
            for (uint32_t i = 0; i < placed.count; i++) set |= 1u << placed.chosen[i];
            assert_int_equal(cost_of(&s, set), placed.upper);
            assert_true(is_network(&s, set));
            check_points(&s, &placed);
            check_networks(&s, placed.lower);
            assert_true(placed.lower >= free.lower);
            dearer += placed.lower > free.upper;
            proven += placed.lower == placed.upper;
        } else {
            assert_int_equal(status, SL_BAD_ARGUMENT);
            assert_non_null(strstr(sl_context_message(s.context), "no network"));
            check_networks(&s, UINT64_MAX);
            refused++;
        }
        sl_area_placement_destroy(s.context, &free);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
    assert_true(dearer > 1 && refused > 1);
    assert_int_equal(proven + refused, 24);
}

/// What is blind, and a place that could see it.
static void test_blind(void **state) {
    (void)state;
    scene s;
    begin(&s, PLAN, 5, (sl_viewpoint){.fov = 360, .range = 2});
    sl_area_placement placed = place(&s);
    double blind = 0;
    for (uint32_t i = 0; i < placed.blind_count; i++) blind += placed.blind[i].area;
    assert_true(placed.blind_count > 0);
    assert_true(fabs(blind - placed.blind_area) < 1e-9 * placed.area);
    assert_true(fabs(area_of(&s, (1u << PLACES) - 1) + blind - placed.area) < 1e-8 * placed.area);
    sl_point at;
    bool found, reached;
    assert_ok(s.context, sl_place_nearest(s.context, s.query, &s.places[0], placed.blind[0].at,
                                          s.places, PLACES, &at, &found));
    assert_true(found);
    assert_ok(s.context, sl_query_sees(s.context, s.query, at, placed.blind[0].at, &reached));
    assert_true(reached);
    assert_true(hypot(at.x - placed.blind[0].at.x, at.y - placed.blind[0].at.y) <= 2);
    sl_area_placement_destroy(s.context, &placed);
    end(&s);
}

static void test_refusals(void **state) {
    (void)state;
    const sl_point outside[] = {{20, 20}, {21, 20}, {21, 21}}, closed[] = {{0, 0}, {1, 0}, {1, 1}};
    const size_t count = 3;
    const sl_shape nowhere = {outside, &count, 1}, corner = {closed, &count, 1};
    const uint32_t costs[PLACES] = {1, 0};
    scene s;
    begin(&s, PLAN, 5, (sl_viewpoint){.fov = 360});
    s.area.see = &nowhere;
    assert_refused(&s, "nothing is to be seen");
    for (int i = 0; i < PLACES; i++) s.places[i].range = 1e-3;
    s.area.see = &corner;
    assert_refused(&s, "none of the 10 places sees any");
    s.area.see = NULL;
    s.area.costs = costs;
    assert_refused(&s, "place 2");
    s.area.costs = NULL;
    s.area.count = s.area.cover = 2;
    assert_refused(&s, "not by several");
    s.area.zones = &corner;
    s.area.weights = (double[]){0};
    s.area.zone_count = 1;
    assert_refused(&s, "zone 1: its weight");
    s.area.weights = (double[]){1};
    s.area.count = 0;
    assert_refused(&s, "weights are for the most");
    s.area.zone_count = 0;
    s.area.place_count = 0;
    assert_refused(&s, "no place");
    end(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fewest),
        cmocka_unit_test(test_off_walls),
        cmocka_unit_test(test_rounds),
        cmocka_unit_test(test_one_eye),
        cmocka_unit_test(test_demands_and_fixed),
        cmocka_unit_test(test_zone),
        cmocka_unit_test(test_most),
        cmocka_unit_test(test_most_is_all),
        cmocka_unit_test(test_weights),
        cmocka_unit_test(test_network),
        cmocka_unit_test(test_blind),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
