/// Walls that limit sight, beside oracles: points, regions, cells, visibility graphs and rays.
#include "unit/limited_maps.h"

#include "sightline/explain.h"
#include "sightline/vga.h"

// --- points

/// Closed and open sight, both ways, where lines touch ends, run along walls and pass crossings.
static void points_see_past_one_limited_wall(void **state) {
    (void)state;
    size_t counts[4] = {0}, touching = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(600); seed++) {
        scene s;
        sl_random random = {seed ^ 0x11};
        const sl_sight sight = seed % 3 ? SL_CLOSED : SL_OPEN;
        make(&s, seed, seed / 7 % 4, sight);
        for (int i = 0; i < 150; i++) {
            int64_t px, py, qx, qy;
            if (!random_eye(&s, &random, &px, &py) || !random_eye(&s, &random, &qx, &qy)) continue;
            const limited_way w = way_between(&s, px, py, qx, qy);
            const int64_t passed = limited_passed(&w);
            const bool open = sight == SL_CLOSED || !limited_touches(&w);
            bool sees, back;
            assert_ok(s.context, sl_query_sees(s.context, s.query, point(&s, px, py),
                                               point(&s, qx, qy), &sees));
            assert_ok(s.context, sl_query_sees(s.context, s.query, point(&s, qx, qy),
                                               point(&s, px, py), &back));
            counts[passed < 3 ? passed : 3]++;
            touching += !is_generic(&w);
            if (sees != (open && passed < 2) || back != sees)
                fail_msg("seed %llu: from %g %g to %g %g: %lld passed; library %d, back %d",
                         (unsigned long long)seed, (double)px / FINE, (double)py / FINE,
                         (double)qx / FINE, (double)qy / FINE, (long long)passed, sees, back);
        }
        end(&s);
    }
    assert_true(counts[0] && counts[1] && counts[2] && counts[3] && touching);
}

/// The cases that the format names, one by one.
static void places_where_walls_meet_count_as_said(void **state) {
    (void)state;
    static const struct {
        const char *walls;
        double p[2], q[2];
        bool sees;
    } cases[] = {
        {"wall 3 0 3 8 stops limited\n", {1, 4}, {9, 4}, true},
        {"wall 3 0 3 8 stops limited\nwall 6 0 6 8 stops limited\n", {1, 4}, {5, 4}, true},
        {"wall 3 0 3 8 stops limited\nwall 6 0 6 8 stops limited\n", {1, 4}, {6, 4}, true},
        {"wall 3 0 3 8 stops limited\nwall 6 0 6 8 stops limited\n", {1, 4}, {7, 4}, false},
        // from one to behind the other
        {"wall 3 0 3 8 stops limited\nwall 6 0 6 8 stops limited\n", {3, 4}, {7, 4}, true},
        // a common end: one wall
        {"wall 3 0 3 4 stops limited\nwall 3 4 3 8 stops limited\n", {1, 4}, {9, 4}, true},
        {"wall 3 0 3 4 stops limited\nwall 3 4 3 8 stops limited\nwall 6 0 6 8 stops limited\n",
         {1, 4},
         {9, 4},
         false},
        // a tip: none
        {"walls 5 0 3 4 1 0 stops limited\nwall 6 0 6 8 stops limited\n", {1, 4}, {9, 4}, true},
        // a crossing: two
        {"wall 1 2 5 6 stops limited\nwall 1 6 5 2 stops limited\n", {1, 4}, {9, 4}, false},
        {"wall 1 2 5 6 stops limited\nwall 1 6 5 2 stops limited\n", {1, 4}, {3, 4}, true},
        {"wall 1 2 5 6 stops limited\nwall 1 6 5 2 stops limited\n", {3, 4}, {9, 4}, true},
        // one on another: one
        {"wall 3 0 3 8 stops limited\nwall 3 2 3 8 stops limited\n", {1, 4}, {9, 4}, true},
        {"wall 3 0 3 8 stops limited\nwall 3 0 3 8\n", {1, 4}, {9, 4}, false},
        // a wall that stops sight goes on as a limited one
        {"wall 3 0 3 4\nwall 3 4 3 8 stops limited\n", {1, 4}, {9, 4}, true},
        {"wall 3 0 3 4\nwall 3 4 3 8 stops limited\nwall 6 0 6 8 stops limited\n",
         {1, 4},
         {9, 4},
         false},
        // along a limited wall, from its left to its right and back
        {"wall 3 4 6 4 stops limited\nwall 4 4 4 8\nwall 5 4 5 0\n", {1, 4}, {9, 4}, true},
        {"wall 3 4 6 4 stops limited\nwall 4 4 4 8\nwall 5 4 5 0\nwall 7 0 7 8 stops limited\n",
         {1, 4},
         {9, 4},
         false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        sl_baked baked = {0};
        sl_query *query = NULL;
        char text[512];
        bool sees[2];
        snprintf(text, sizeof text, "sightline 1\nwalls 0 0 10 0 10 8 0 8 0 0\n%s", cases[i].walls);
        assert_ok(context, sl_map_parse(context, "test.map", text, strlen(text), NULL, &map));
        assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
        assert_ok(context, sl_query_create(context, &baked, &query));
        const sl_point p = {cases[i].p[0], cases[i].p[1]}, q = {cases[i].q[0], cases[i].q[1]};
        assert_ok(context, sl_query_sees(context, query, p, q, &sees[0]));
        assert_ok(context, sl_query_sees(context, query, q, p, &sees[1]));
        if (sees[0] != cases[i].sees || sees[1] != sees[0])
            fail_msg("case %zu: %d, back %d", i, sees[0], sees[1]);
        sl_query_destroy(context, query);
        sl_baked_destroy(context, &baked);
        sl_context_destroy(context);
    }
}

// --- regions

/// Whether a point is in a polygon; -1 where it is near an edge.
static int is_in(const sl_region *region, sl_point q, double near) {
    bool inside = false;
    for (size_t i = 0, k = region->count - 1; i < region->count; k = i++) {
        const sl_point a = {region->points[k].x - q.x, region->points[k].y - q.y};
        const sl_point b = {region->points[i].x - q.x, region->points[i].y - q.y};
        const double turn = a.x * b.y - a.y * b.x, length = hypot(b.x - a.x, b.y - a.y);
        if (fabs(turn) <= near * length) return -1;
        if ((a.y > 0) != (b.y > 0) && (turn > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
}

static void regions_end_at_the_second_limited_wall(void **state) {
    (void)state;
    size_t in = 0, out = 0, limited = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(500); seed++) {
        scene s;
        sl_random random = {seed ^ 0x22};
        sl_region region = {0};
        make(&s, seed, seed / 7 % 4, SL_CLOSED);
        for (int eye = 0; eye < 6; eye++) {
            int64_t px, py;
            if (!random_eye(&s, &random, &px, &py)) continue;
            const sl_view view = sl_view_all_round(point(&s, px, py));
            assert_ok(s.context, sl_query_region(s.context, s.query, &view, &region));
            assert_true(region.count > 2);
            for (size_t i = 0; i < region.count; i++) {
                if (region.edges[i].kind != SL_EDGE_WALL) continue;
                if (region.edges[i].wall < SL_LIMITED_WALL) continue;
                const uint32_t seam = region.edges[i].wall - SL_LIMITED_WALL;
                assert_true(seam < s.baked.space.seam_count);
                assert_int_equal(s.baked.space.seams[seam].kind, SL_SEAM_LIMITED);
                limited++;
            }
            for (int i = 0; i < 40; i++) {
                const int64_t qx = (int64_t)sl_random_below(&random, SIZE * FINE);
                const int64_t qy = (int64_t)sl_random_below(&random, SIZE * FINE);
                const limited_way w = way_between(&s, px, py, qx, qy);
                if (!is_generic(&w)) continue;
                const bool seen = limited_passed(&w) < 2;
                const int found = is_in(&region, point(&s, qx, qy), 1e-5 * s.unit);
                if (found < 0) continue;
                in += seen;
                out += !seen;
                if (found != seen)
                    fail_msg("seed %llu: eye %g %g, point %g %g: oracle %d, region %d",
                             (unsigned long long)seed, (double)px / FINE, (double)py / FINE,
                             (double)qx / FINE, (double)qy / FINE, seen, found);
            }
        }
        sl_region_destroy(s.context, &region);
        end(&s);
    }
    assert_true(in && out && limited);
}

// --- cells

static void ask_cells(scene *s, int64_t px, int64_t py, sl_sight sight) {
    const size_t words = sl_eye_words(&s->baked.space);
    uint64_t *rays = calloc(words, 8), *cells = calloc(words, 8);
    assert_true(rays && cells);
    const sl_view view = sl_view_all_round(point(s, px, py));
    directions all = mark_rays(s, px, py, rays);
    assert_ok(s->context, sl_query_look(s->context, s->query, &view, NULL, cells, NULL));
    for (uint32_t c = 0; c < s->baked.space.cell_count; c++) {
        const bool by_rays = sl_bits_has(rays, c), listed = sl_bits_has(cells, c);
        const bool right =
            by_rays ? listed : !listed || (sight == SL_CLOSED && is_touched(s, px, py, &all, c));
        if (!right)
            fail_msg("seed %llu, sight %d: eye %g %g, cell %u: by rays %d, listed %d",
                     (unsigned long long)s->seed, sight, (double)px / FINE, (double)py / FINE, c,
                     by_rays, listed);
    }
    free(rays);
    free(cells);
    free(all.items);
}

static void cells_are_those_that_rays_pass(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= testing_seeds(300); seed++) {
        scene s;
        sl_random random = {seed ^ 0x33};
        const sl_sight sight = seed / 2 % 2 ? SL_CLOSED : SL_OPEN;
        make(&s, seed, seed / 7 % 4, sight);
        for (int eye = 0; eye < 6; eye++) {
            int64_t px, py;
            if (random_eye(&s, &random, &px, &py)) ask_cells(&s, px, py, sight);
        }
        end(&s);
    }
}

// --- visible sets, and what is found of points

/// Rows take limited walls as open, and say so.
static void rows_are_those_with_open_walls(void **state) {
    (void)state;
    size_t pairs = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(200); seed++) {
        scene s, open;
        make(&s, seed, seed / 7 % 4, SL_CLOSED);
        make_with(&open, seed, seed / 7 % 4, SL_CLOSED, SL_STOPS_ALL);
        const sl_visibility *one = &s.baked.visibility, *other = &open.baked.visibility;
        const uint32_t cells = s.baked.space.cell_count;
        assert_int_equal(cells, open.baked.space.cell_count);
        for (uint32_t a = 0; a < cells; a++)
            for (uint32_t b = 0; b < cells; b++, pairs++)
                assert_int_equal(sl_pvs_sees(&one->pvs, a, b), sl_pvs_sees(&other->pvs, a, b));
        const bool any = sl_map_limited_walls(&s.baked.map) != 0;
        assert_int_equal(other->guarantee, SL_EXACT);
        assert_int_equal(one->guarantee, any ? SL_CONSERVATIVE : SL_EXACT);
        end(&open);
        end(&s);
    }
    assert_true(pairs);
}

static void graphs_count_limited_walls(void **state) {
    (void)state;
    size_t seen = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(60); seed++) {
        scene s;
        sl_vga_grid grid = {0};
        sl_vga_graph graph = {0};
        const sl_outline *outline;
        make(&s, seed, seed / 7 % 4, SL_CLOSED);
        assert_ok(s.context, sl_query_outline(s.context, s.query, &outline));
        const sl_point seed_point = point(&s, 9 * FINE + 1, 7 * FINE);
        assert_ok(s.context,
                  sl_vga_grid_make(s.context, outline, 3 * s.unit, &seed_point, 1, &grid));
        assert_ok(s.context, sl_vga_graph_make(s.context, outline, &grid, 0, 1, &graph));
        for (uint32_t a = 0; a < grid.count; a++)
            for (uint32_t b = 0; b < grid.count; b++) {
                bool sees;
                const bool linked = sl_vga_sees(&graph, a, b);
                assert_ok(s.context,
                          sl_query_sees(s.context, s.query, grid.points[a], grid.points[b], &sees));
                seen += sees;
                hidden += !sees;
                if (a != b && sees != linked)
                    fail_msg("seed %llu: %g %g and %g %g: sees %d, graph %d",
                             (unsigned long long)seed, grid.points[a].x, grid.points[a].y,
                             grid.points[b].x, grid.points[b].y, sees, linked);
            }
        sl_vga_graph_destroy(s.context, &graph);
        sl_vga_grid_destroy(s.context, &grid);
        end(&s);
    }
    assert_true(seen && hidden);
}

static void rays_end_at_the_second_limited_wall(void **state) {
    (void)state;
    size_t limited = 0, stopped = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(300); seed++) {
        scene s;
        sl_random random = {seed ^ 0x44};
        make(&s, seed, seed / 7 % 4, SL_CLOSED);
        for (int i = 0; i < 60; i++) {
            int64_t px, py;
            const int64_t qx = (int64_t)sl_random_below(&random, SIZE * FINE);
            const int64_t qy = (int64_t)sl_random_below(&random, SIZE * FINE);
            if (!random_eye(&s, &random, &px, &py)) continue;
            limited_way w = way_between(&s, px, py, qx, qy);
            if ((px == qx && py == qy) || !is_generic(&w)) continue;
            limited_place last = {INT64_MAX / (1 << 30), 1};
            bool at_limit = false;
            for (size_t k = 0; k < s.count; k++) {
                limited_place at;
                int64_t before = 0;
                if (!limited_meets(&w, &s.walls[k], &at) || at.above <= 0) continue;
                for (size_t j = 0; j < s.count && !s.walls[k].stops; j++) {
                    limited_place other;
                    before += !s.walls[j].stops && limited_meets(&w, &s.walls[j], &other) &&
                              other.above > 0 && limited_compare(&other, &at) < 0;
                }
                if ((!s.walls[k].stops && !before) || limited_compare(&at, &last) > 0) continue;
                at_limit = !s.walls[k].stops && (limited_compare(&at, &last) < 0 || at_limit);
                last = at;
            }
            sl_hit hit;
            assert_ok(s.context, sl_query_cast(s.context, s.query, point(&s, px, py),
                                               point(&s, qx, qy), &hit));
            const double t = (double)last.above / (double)last.below;
            const double x = ((double)px + t * (double)(qx - px)) / FINE * s.unit + s.shift;
            const double y = ((double)py + t * (double)(qy - py)) / FINE * s.unit + s.shift;
            const double near = 1e-9 * s.unit + 1e-15 * s.shift;
            if (fabs(hit.point.x - x) > near || fabs(hit.point.y - y) > near)
                fail_msg("seed %llu: eye %g %g through %g %g: %g %g, not %g %g",
                         (unsigned long long)seed, (double)px / FINE, (double)py / FINE,
                         (double)qx / FINE, (double)qy / FINE, hit.point.x, hit.point.y, x, y);
            if (at_limit) {
                assert_true(hit.wall >= SL_LIMITED_WALL && hit.wall != SL_NO_WALL);
                limited++;
            } else {
                assert_true(hit.wall < s.baked.space.wall_count);
                stopped++;
            }
        }
        end(&s);
    }
    assert_true(limited && stopped);
}

// --- files

/// A file for sight tells which seams limit it; one for steps keeps it. What it cannot say is
/// refused.
static void files_keep_limited_walls(void **state) {
    (void)state;
    static const char text[] = "sightline 1\nwalls 0 0 10 0 10 8 0 8 0 0\n"
                               "wall 3 0 3 4 stops limited\nwall 6 0 6 8 stops steps,limited\n"
                               "seam 8 0 8 8\n";
    for (uint32_t channel = SL_STOPS_SIGHT; channel <= SL_STOPS_STEPS; channel *= 2) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        sl_baked baked = {0}, again = {0};
        sl_bytes bytes = {0};
        assert_ok(context, sl_map_parse(context, "test.map", text, strlen(text), NULL, &map));
        map.channel = channel;
        assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
        assert_int_equal(sl_map_limited_walls(&baked.map), channel == SL_STOPS_SIGHT ? 2 : 0);
        assert_ok(context, sl_baked_print(context, &baked, &bytes));
        assert_ok(context, sl_baked_parse(context, "test", bytes.data, bytes.size, &again));
        assert_ok(context, sl_space_check(context, &again.space));
        assert_int_equal(again.space.seam_count, 3);
        for (uint32_t i = 0; i < 3; i++) {
            const sl_seam *seam = &again.space.seams[i];
            const bool limits = again.map.seams[seam->number].stops & SL_STOPS_LIMITED;
            assert_int_equal(seam->kind, baked.space.seams[i].kind);
            assert_int_equal(seam->kind == SL_SEAM_LIMITED, limits && channel == SL_STOPS_SIGHT);
            assert_int_equal(again.map.seams[seam->number].stops,
                             baked.map.seams[baked.space.seams[i].number].stops);
        }
        assert_int_equal(again.visibility.guarantee,
                         channel == SL_STOPS_SIGHT ? SL_CONSERVATIVE : SL_EXACT);
        sl_free(context, bytes.data);
        sl_baked_destroy(context, &baked);
        sl_baked_destroy(context, &again);
        sl_context_destroy(context);
    }
}

// --- what does not count them

static void what_cannot_count_refuses(void **state) {
    (void)state;
    static const char text[] = "sightline 1\nwalls 0 0 10 0 10 8 0 8 0 0\nmirror 9 1 9 7\n"
                               "wall 3 0 3 8 stops limited\n";
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_baked baked = {0};
    sl_query *query = NULL;
    assert_ok(context, sl_map_parse(context, "test.map", text, strlen(text), NULL, &map));
    assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
    assert_ok(context, sl_query_create(context, &baked, &query));
    const sl_view view = sl_view_all_round((sl_point){1, 4});
    sl_mirrored_region region = {0};
    uint64_t cells[4] = {0};
    assert_true(sl_eye_words(&baked.space) <= 4);
    assert_int_equal(sl_query_mirrored_region(context, query, &view, &region), SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(context), "limit sight"));
    assert_non_null(strstr(sl_context_message(context), "--without mirror"));
    assert_int_equal(sl_query_look_mirrored(context, query, &view, NULL, cells, NULL),
                     SL_UNSUPPORTED);
    assert_ok(context, sl_query_set_mirror_depth(context, query, 0));
    assert_ok(context, sl_query_mirrored_region(context, query, &view, &region));
    assert_ok(context, sl_query_look_mirrored(context, query, &view, NULL, cells, NULL));
    sl_explain_options options = sl_explain_options_default();
    sl_explanation explanation = {0};
    assert_int_equal(sl_explain(context, &baked.space, &options, 0, 1, &explanation),
                     SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(context), "an explanation"));
    sl_mirrored_region_destroy(context, &region);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// Boxes that block, in the middle of limited walls too: an eye sees past them what it sees past
/// walls in their place.
static void boxes_hide_as_walls_do(void **state) {
    (void)state;
    size_t seen = 0, hidden = 0, touched = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(200); seed++) {
        scene s;
        sl_random random = {seed ^ 0x88};
        make(&s, seed, seed / 7 % 4, SL_CLOSED);
        const int64_t x = 2 + (int64_t)sl_random_below(&random, SIZE - 4);
        const int64_t y = 2 + (int64_t)sl_random_below(&random, SIZE - 4);
        const sl_point low = point(&s, x * FINE, y * FINE);
        const sl_point high = point(&s, (x + 2) * FINE, (y + 3) * FINE);
        const sl_moving_box box = {.box = {low, high}, .blocks = true};
        const limited_wall sides[4] = {
            {x * FINE, y * FINE, (x + 2) * FINE, y * FINE, true},
            {(x + 2) * FINE, y * FINE, (x + 2) * FINE, (y + 3) * FINE, true},
            {(x + 2) * FINE, (y + 3) * FINE, x * FINE, (y + 3) * FINE, true},
            {x * FINE, (y + 3) * FINE, x * FINE, y * FINE, true}};
        assert_ok(s.context, sl_query_set_boxes(s.context, s.query, &box, 1));
        memcpy(s.walls + s.count, sides, sizeof sides);
        s.count += 4;
        for (int i = 0; i < 60; i++) {
            int64_t px, py, qx, qy;
            bool sees;
            if (!random_eye(&s, &random, &px, &py) || !random_eye(&s, &random, &qx, &qy)) continue;
            const limited_way w = way_between(&s, px, py, qx, qy);
            const bool truth = limited_passed(&w) < 2;
            assert_ok(s.context, sl_query_sees(s.context, s.query, point(&s, px, py),
                                               point(&s, qx, qy), &sees));
            seen += truth;
            hidden += !truth;
            touched += !is_generic(&w);
            if (sees != truth)
                fail_msg("seed %llu: from %g %g to %g %g past a box at %g %g: oracle %d, not %d",
                         (unsigned long long)seed, (double)px / FINE, (double)py / FINE,
                         (double)qx / FINE, (double)qy / FINE, (double)x, (double)y, truth, sees);
        }
        end(&s);
    }
    assert_true(seen && hidden && touched);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_see_past_one_limited_wall),
        cmocka_unit_test(places_where_walls_meet_count_as_said),
        cmocka_unit_test(regions_end_at_the_second_limited_wall),
        cmocka_unit_test(cells_are_those_that_rays_pass),
        cmocka_unit_test(rows_are_those_with_open_walls),
        cmocka_unit_test(graphs_count_limited_walls),
        cmocka_unit_test(rays_end_at_the_second_limited_wall),
        cmocka_unit_test(files_keep_limited_walls),
        cmocka_unit_test(what_cannot_count_refuses),
        cmocka_unit_test(boxes_hide_as_walls_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
