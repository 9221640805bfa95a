/// Sight past boxes that block, of which none is cut into the space: compared with a brute-force
/// sweep in rationals over a map that has the boxes' sides as walls, and with the space that the
/// boxes are cut into. Boxes touch walls, each other and the eye's lines; some are huge or tiny.
#include "box_scene.h"

#include "oracle/isovist.h"
#include "sight/moving.h"
#include "sight/region.h"

static void assert_near(const scene *s, const char *what, double found, double expected,
                        double reach, const sl_view *view) {
    if (fabs(found - expected) <= reach) return;
    for (size_t i = 0; i < s->box_count; i++)
        fprintf(stderr, "box %.17g %.17g %.17g %.17g, blocks %d\n", s->boxes[i].box.min.x,
                s->boxes[i].box.min.y, s->boxes[i].box.max.x, s->boxes[i].box.max.y,
                s->boxes[i].blocks);
    fail_msg("seed %llu: %s %.17g, not %.17g; eye %.17g %.17g, full %d, right %.17g %.17g, left "
             "%.17g %.17g",
             (unsigned long long)s->seed, what, found, expected, view->eye.x, view->eye.y,
             view->full, view->right.x, view->right.y, view->left.x, view->left.y);
}

/// Each edge on a side of a box is on that side, seen from where it is seen from.
static void check_sides(const scene *s, const sl_region *region) {
    for (size_t i = 0; i < region->count; i++) {
        const sl_point p = region->points[i], q = region->points[(i + 1) % region->count];
        const sl_region_edge *edge = &region->edges[i];
        if (edge->kind != SL_EDGE_WALL || edge->wall < SL_BOX_WALL) continue;
        const uint32_t number = edge->wall - SL_BOX_WALL;
        assert_true(number / 4 < s->box_count && s->boxes[number / 4].blocks);
        const sl_box b = s->boxes[number / 4].box;
        const double at[4] = {b.min.x, b.max.x, b.min.y, b.max.y};
        if (number % 4 < 2)
            assert_true(p.x == at[number % 4] && q.x == at[number % 4]);
        else
            assert_true(p.y == at[number % 4] && q.y == at[number % 4]);
    }
}

/// Whether a point is in line with a side of a box that blocks.
static bool is_in_line(const scene *s, sl_point p) {
    for (size_t i = 0; i < s->box_count; i++) {
        const sl_box b = s->boxes[i].box;
        if (s->boxes[i].blocks &&
            (p.x == b.min.x || p.x == b.max.x || p.y == b.min.y || p.y == b.max.y))
            return true;
    }
    return false;
}

/// `accuracy`: relative, of what is measured.
static void check_region(scene *s, const sl_view *view, double accuracy, sl_region *region) {
    assert_ok(s->context, sl_query_region(s->context, s->query, view, region));
    const oracle_isovist expected = oracle_isovist_of(&s->other, view);
    const sl_region_measures found = sl_region_measure(region);
    const double square = found.max_radial * found.max_radial;
    const double length = accuracy * expected.perimeter;
    assert_near(s, "area", found.area, expected.area, accuracy * fmax(expected.area, 1e-3 * square),
                view);
    // Turned, cleaning may close gaps between walls and boxes that are as wide as rounding errors.
    if (!s->space.neighbour)
        assert_near(s, "perimeter", found.perimeter, expected.perimeter, length, view);
    // The sweep takes a wall at the eye as a wall up to where a box cuts it only.
    if (!s->space.neighbour && !is_in_line(s, view->eye))
        assert_near(s, "occlusivity", found.occlusivity, expected.occlusivity, length, view);
    check_sides(s, region);
}

static void check_scenes(uint64_t count, double move, bool turned, double accuracy) {
    static const double angles[] = {17.3, 33, 45, 0.001};
    scene s = {.context = testing_context(NULL)};
    sl_region region = {0};
    const uint64_t seeds = testing_seeds(count);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        if (make_scene(&s, seed, turned ? angles[seed % 4] : 0, move))
            for (int i = 0; i < 12; i++) {
                const sl_view view = any_view(&s, any_eye(&s, turned));
                if (!is_outside(&s, view.eye) && !is_on_box(&s, view.eye))
                    check_region(&s, &view, accuracy, &region);
            }
        destroy_scene(&s);
    }
    sl_region_destroy(s.context, &region);
    sl_context_destroy(s.context);
}

static void as_the_sweep_says(void **state) {
    (void)state;
    check_scenes(40, 0, false, 1e-12);
}

static void among_turned_walls(void **state) {
    (void)state;
    check_scenes(16, 0, true, 1e-10);
}

static void far_from_the_origin(void **state) {
    (void)state;
    check_scenes(12, 1e6, true, 1e-6);
}

/// The line between two points, as in the space that the boxes are cut into.
static void points_see_as_past_walls(void **state) {
    (void)state;
    scene s = {.context = testing_context(NULL)};
    const uint64_t seeds = testing_seeds(60);
    size_t seen_count = 0, all = 0;
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        if (make_scene(&s, seed, 0, 0)) {
            const sl_outline *outline;
            assert_ok(s.context, sl_query_outline(s.context, s.query, &outline));
            for (int i = 0; i < 60; i++) {
                const sl_point eye = any_point(&s), point = any_point(&s);
                bool seen, expected;
                assert_ok(s.context, sl_query_sees(s.context, s.query, eye, point, &seen));
                assert_ok(s.context,
                          sli_sees(s.context, outline, eye, point, SL_CLOSED, &expected));
                if (seen != expected)
                    fail_msg("seed %llu: %d, not %d: %.17g %.17g to %.17g %.17g",
                             (unsigned long long)seed, seen, expected, eye.x, eye.y, point.x,
                             point.y);
                seen_count += seen;
                all++;
            }
        }
        destroy_scene(&s);
    }
    assert_true(seen_count > all / 20 && seen_count < all);
    sl_context_destroy(s.context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_the_sweep_says),
        cmocka_unit_test(among_turned_walls),
        cmocka_unit_test(far_from_the_origin),
        cmocka_unit_test(points_see_as_past_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
