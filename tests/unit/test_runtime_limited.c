/// The runtime header on walls that limit sight, beside the oracles of test_limited: points, cells
/// and polygons.
#include "runtime/sightline_runtime.h"

#include "unit/limited_maps.h"

enum { MOST_POINTS = 4096 };

/// A scene, and its file in the header's hands.
typedef struct opened {
    scene s;
    sl_bytes bytes;
    sl_runtime runtime;
    uint32_t *scratch, *cells;
    double points[2 * MOST_POINTS];
} opened;

static opened *open_scene(uint64_t seed) {
    opened *o = calloc(1, sizeof *o);
    assert_non_null(o);
    make(&o->s, seed, seed / 7 % 4, SL_CLOSED);
    assert_ok(o->s.context, sl_baked_print(o->s.context, &o->s.baked, &o->bytes));
    assert_int_equal(sl_runtime_open(o->bytes.data, o->bytes.size, &o->runtime), SL_RUNTIME_OK);
    assert_int_equal(o->runtime.has_limits, sl_map_limited_walls(&o->s.baked.map) != 0);
    o->scratch = calloc(sl_runtime_scratch_count(&o->runtime), sizeof *o->scratch);
    o->cells = calloc(o->runtime.cell_count, sizeof *o->cells);
    assert_true(o->scratch && o->cells);
    return o;
}

static void close_scene(opened *o) {
    sl_free(o->s.context, o->bytes.data);
    free(o->scratch);
    free(o->cells);
    end(&o->s);
    free(o);
}

static void points_are_seen_past_one_limited_wall(void **state) {
    (void)state;
    size_t seen = 0, hidden = 0, touching = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(600); seed++) {
        opened *o = open_scene(seed);
        sl_random random = {seed ^ 0x55};
        for (int i = 0; i < 150; i++) {
            int64_t px, py, qx, qy;
            if (!random_eye(&o->s, &random, &px, &py) || !random_eye(&o->s, &random, &qx, &qy))
                continue;
            const limited_way w = way_between(&o->s, px, py, qx, qy);
            const sl_point p = point(&o->s, px, py), q = point(&o->s, qx, qy);
            const bool truth = limited_passed(&w) < 2;
            const bool sees = sl_runtime_sees(&o->runtime, p.x, p.y, q.x, q.y, NULL, 0, o->scratch);
            const bool back = sl_runtime_sees(&o->runtime, q.x, q.y, p.x, p.y, NULL, 0, o->scratch);
            seen += truth;
            hidden += !truth;
            touching += !is_generic(&w);
            if (sees != truth || back != truth)
                fail_msg("seed %llu: from %g %g to %g %g: oracle %d, header %d, back %d",
                         (unsigned long long)seed, (double)px / FINE, (double)py / FINE,
                         (double)qx / FINE, (double)qy / FINE, truth, sees, back);
        }
        close_scene(o);
    }
    assert_true(seen && hidden && touching);
}

static void cells_are_those_that_rays_pass(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= testing_seeds(300); seed++) {
        opened *o = open_scene(seed);
        sl_random random = {seed ^ 0x66};
        uint64_t *rays = calloc(sl_eye_words(&o->s.baked.space), 8);
        assert_non_null(rays);
        for (int eye = 0; eye < 6; eye++) {
            int64_t px, py;
            if (!random_eye(&o->s, &random, &px, &py)) continue;
            const sl_point p = point(&o->s, px, py);
            const sl_runtime_view view = sl_runtime_view_all_round(p.x, p.y);
            const uint32_t count =
                sl_runtime_look(&o->runtime, &view, o->scratch, o->cells, o->runtime.cell_count);
            directions all = mark_rays(&o->s, px, py, rays);
            for (uint32_t i = 0; i < count; i++)
                if (!sl_bits_has(rays, o->cells[i]) &&
                    !is_touched(&o->s, px, py, &all, o->cells[i]))
                    fail_msg("seed %llu: eye %g %g: cell %u is added", (unsigned long long)seed,
                             (double)px / FINE, (double)py / FINE, o->cells[i]);
            for (uint32_t i = 0; i < count; i++)
                rays[o->cells[i] / 64] &= ~(1ull << o->cells[i] % 64);
            for (uint32_t c = 0; c < o->runtime.cell_count; c++)
                if (sl_bits_has(rays, c))
                    fail_msg("seed %llu: eye %g %g: cell %u is missed", (unsigned long long)seed,
                             (double)px / FINE, (double)py / FINE, c);
            free(all.items);
        }
        free(rays);
        close_scene(o);
    }
}

/// The header's polygon is the library's region, but for rounding.
static void polygons_are_regions(void **state) {
    (void)state;
    size_t limited = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(500); seed++) {
        opened *o = open_scene(seed);
        sl_random random = {seed ^ 0x77};
        sl_region region = {0};
        for (int eye = 0; eye < 6; eye++) {
            int64_t px, py;
            if (!random_eye(&o->s, &random, &px, &py)) continue;
            const sl_point p = point(&o->s, px, py);
            const double range = sl_random_below(&random, 3) ? 0 : 5 * o->s.unit;
            const sl_runtime_view asked = sl_runtime_view_all_round(p.x, p.y);
            const sl_view view = sl_view_all_round(p);
            assert_ok(o->s.context, sl_query_set_range(o->s.context, o->s.query, range));
            assert_ok(o->s.context, sl_query_region(o->s.context, o->s.query, &view, &region));
            const uint32_t count = sl_runtime_visible_polygon(&o->runtime, &asked, NULL, range,
                                                              o->scratch, o->points, MOST_POINTS);
            assert_in_range(count, 3, MOST_POINTS);
            double area = 0;
            for (uint32_t i = 0, k = count - 1; i < count; k = i++)
                area += ((o->points[2 * k] - p.x) * (o->points[2 * i + 1] - p.y) -
                         (o->points[2 * i] - p.x) * (o->points[2 * k + 1] - p.y)) /
                        2;
            for (size_t i = 0; i < region.count; i++)
                limited +=
                    region.edges[i].kind == SL_EDGE_WALL && region.edges[i].wall >= SL_LIMITED_WALL;
            const double expected = sl_region_area(&region);
            if (fabs(area - expected) > (range > 0 ? 1e-3 : 1e-6) * expected)
                fail_msg("seed %llu: eye %g %g, range %g: area %.17g, not %.17g",
                         (unsigned long long)seed, (double)px / FINE, (double)py / FINE, range,
                         area, expected);
        }
        sl_region_destroy(o->s.context, &region);
        close_scene(o);
    }
    assert_true(limited);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_seen_past_one_limited_wall),
        cmocka_unit_test(cells_are_those_that_rays_pass),
        cmocka_unit_test(polygons_are_regions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
