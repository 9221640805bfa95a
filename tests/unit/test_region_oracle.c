/// The visible region against a brute-force sweep in rationals, on random maps with every way to
/// place an eye: anywhere, in line with walls, on walls, on their ends, on portals and on corners
/// of cells, on the border.
#include "sight/region.h"
#include "space/outline.h"
#include "testing.h"

#include "oracle/isovist.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "space/subdivide.h"

#include <math.h>

static sl_point mix(sl_point a, sl_point b, double share) {
    return (sl_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

/// An eye on a place of the space of a kind that goes by turns.
static sl_point place_eye(const sl_space *space, sl_random *random, uint64_t kind) {
    const sl_box *b = &space->bounds;
    const sl_wall *wall = &space->walls[sl_random_below(random, space->wall_count)];
    const sl_wall *other = &space->walls[sl_random_below(random, space->wall_count)];
    const double share = (double)sl_random_below(random, 5) / 4;
    switch (kind % 6) {
    case 0:
        return (sl_point){b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                          b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
    case 1:
        return (sl_point){wall->a.x, other->b.y};
    case 2:
        return mix(wall->a, wall->b, share);
    case 3: {
        if (!space->portal_count) return wall->a;
        const sl_portal *p = &space->portals[sl_random_below(random, space->portal_count)];
        return mix(p->left, p->right, share);
    }
    case 4:
        return space->vertices[sl_random_below(random, space->vertex_count)];
    default:
        return mix(b->min, (sl_point){b->max.x, b->min.y}, share);
    }
}

static sl_view random_view(const sl_space *space, sl_random *random, sl_point eye) {
    if (sl_random_below(random, 3)) return sl_view_all_round(eye);
    sl_view view = {.eye = eye};
    const double size = space->bounds.max.x - space->bounds.min.x;
    if (sl_random_below(random, 2))
        return sl_view_cone(eye, 15 * (double)sl_random_below(random, 24),
                            30 * (double)sl_random_below(random, 13), size);
    do {
        view.left = place_eye(space, random, sl_random_below(random, 6));
        view.right = place_eye(space, random, sl_random_below(random, 6));
    } while ((view.left.x == eye.x && view.left.y == eye.y) ||
             (view.right.x == eye.x && view.right.y == eye.y));
    return view;
}

static void assert_near(const char *what, double found, double expected, double reach,
                        uint64_t seed, const sl_view *view) {
    if (fabs(found - expected) <= reach) return;
    fail_msg("seed %llu: %s %.17g, not %.17g; eye %.17g %.17g, full %d, right %.17g %.17g, left "
             "%.17g %.17g",
             (unsigned long long)seed, what, found, expected, view->eye.x, view->eye.y, view->full,
             view->right.x, view->right.y, view->left.x, view->left.y);
}

/// Counter-clockwise, without a repeated point, and every wall edge on its wall's line.
static void check_shape(const sl_region *region, const sl_space *space, uint64_t seed) {
    for (size_t i = 0; i < region->count; i++) {
        const sl_point p = region->points[i], q = region->points[(i + 1) % region->count];
        if (p.x == q.x && p.y == q.y)
            fail_msg("seed %llu: %.17g %.17g twice; eye %.17g %.17g; right %.17g %.17g, left %.17g "
                     "%.17g",
                     (unsigned long long)seed, p.x, p.y, region->view.eye.x, region->view.eye.y,
                     region->view.right.x, region->view.right.y, region->view.left.x,
                     region->view.left.y);
        const sl_region_edge *e = &region->edges[i];
        assert_true((e->kind == SL_EDGE_WALL) == (e->wall != SL_NO_WALL));
        if (e->kind != SL_EDGE_WALL) continue;
        const sl_wall *w = &space->walls[e->wall];
        if (w->a.x == w->b.x) assert_true(p.x == w->a.x && q.x == w->a.x);
        if (w->a.y == w->b.y) assert_true(p.y == w->a.y && q.y == w->a.y);
    }
}

/// `accuracy`: relative, of what is measured.
static void check_eye(sl_context *context, const sl_outline *outline, const sl_view *view,
                      double accuracy, uint64_t seed, sl_region *region) {
    assert_ok(context, sli_region_make(context, outline, view, 0, region));
    if (sl_space_locate(outline->space, view->eye) == SL_NO_CELL) {
        assert_int_equal(region->count, 0); // mixed from two points and rounded, out of the bounds
        return;
    }
    const oracle_isovist expected = oracle_isovist_of(outline->space, view);
    const sl_region_measures found = sl_region_measure(region);
    // Of a sliver, the places of its corners say less than of the square on its length.
    const double square = found.max_radial * found.max_radial;
    assert_near("area", found.area, expected.area, accuracy * fmax(expected.area, 1e-3 * square),
                seed, view);
    const double length = accuracy * expected.perimeter;
    assert_near("perimeter", found.perimeter, expected.perimeter, length, seed, view);
    assert_near("occlusivity", found.occlusivity, expected.occlusivity, length, seed, view);
    check_shape(region, outline->space, seed);
}

static void as_the_sweep_says(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const uint64_t seeds = testing_seeds(60);
    sl_region region = {0};
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_map map = {0};
        sl_space space = {0};
        sl_outline outline = {0};
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        if (map.wall_count) {
            const sl_subdivide_options options = sl_subdivide_options_default();
            assert_ok(context, sli_subdivide_kd(context, &map, &options, &space));
            assert_ok(context, sli_outline_make(context, &space, &outline));
            sl_random random = {seed};
            for (uint64_t i = 0; i < 12; i++) {
                const sl_point eye = place_eye(&space, &random, i);
                const sl_view view = random_view(&space, &random, eye);
                check_eye(context, &outline, &view, 1e-12, seed, &region);
            }
        }
        sli_outline_destroy(context, &outline);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_region_destroy(context, &region);
    sl_context_destroy(context);
}

/// Turned and moved, where places on walls are rounded. The eye is on no wall.
static void among_turned_walls(void **state) {
    (void)state;
    static const double angles[] = {17.3, 33, 45, 0.001};
    sl_context *context = testing_context(NULL);
    const uint64_t seeds = testing_seeds(60);
    sl_region region = {0};
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_map map = {0};
        sl_space space = {0};
        sl_outline outline = {0};
        sl_random random = {seed};
        const double move = seed / 4 % 2 ? 1e6 : 0;
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &map));
        oblique_turn_map(&map, angles[seed % 4], move);
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        if (map.wall_count) {
            assert_ok(context, sli_subdivide_mesh(context, &map, &space));
            assert_ok(context, sli_outline_make(context, &space, &outline));
            for (uint64_t i = 0; i < 12; i++) {
                const sl_view view = random_view(&space, &random, place_eye(&space, &random, 0));
                check_eye(context, &outline, &view, move > 0 ? 1e-6 : 1e-11, seed, &region);
            }
        }
        sli_outline_destroy(context, &outline);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_region_destroy(context, &region);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_the_sweep_says),
        cmocka_unit_test(among_turned_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
