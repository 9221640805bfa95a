/// View cells beside what brute force says: segments beside every wall by itself, sets beside every
/// leaf and segment by itself, splits beside all places where one could be.
#include "view_cells_maps.h"

#include "cell_to_cell/pvs_rows.h"
#include "sightline/support.h"

#define NEAR 1e-9

// --- segments

/// The walls that a line from a point meets first; all within rounding of the nearest are marked.
static void first_walls(const sl_space *space, sl_point from, sl_point to, bool *first) {
    double least = INFINITY;
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < space->wall_count; i++) {
            const sl_wall *w = &space->walls[i];
            const double a = cross_of(from, to, w->a), b = cross_of(from, to, w->b);
            if (pass) first[i] = false;
            if ((a > NEAR && b > NEAR) || (a < -NEAR && b < -NEAR)) continue;
            if (a == b) continue;
            const double from_side = cross_of(w->a, w->b, from), to_side = cross_of(w->a, w->b, to);
            const double t = from_side / (from_side - to_side);
            if (!(t > -NEAR)) continue;
            if (!pass && a * b < 0 && t < least) least = t;
            if (pass) first[i] = t < least + NEAR;
        }
}

static void check_segments(const char *statements, bool oblique) {
    sl_context *context = testing_context(NULL);
    view_world w;
    make_world(context, statements, oblique, SL_VIEW_WALLS, 3000, &w);
    const sl_view_segments *s = &w.segments;
    bool first[64];
    assert_true(w.space.wall_count <= 64 && s->count > 1000);
    assert_int_equal(s->drawn, s->count + s->empty + s->unseeing + s->lost);
    assert_int_equal(s->lost, 0);
    for (uint32_t i = 0; i < s->count; i++) {
        const sl_segment *l = &s->items[i];
        const sl_point middle = {(l->a.x + l->b.x) / 2, (l->a.y + l->b.y) / 2};
        const sl_point ends[2] = {l->a, l->b};
        uint64_t at = s->first[i];
        for (int k = 0; k < 2; k++) {
            first_walls(&w.space, middle, ends[k], first);
            // An end is on the wall that is met first, or on the border where none is.
            bool any = false, told = false;
            for (uint32_t j = 0; j < w.space.wall_count; j++) {
                any = any || first[j];
                told = told || (at < s->first[i + 1] && first[j] && s->objects[at] == j);
            }
            if (told) at++;
            const bool border = fabs(ends[k].x - 20) < NEAR;
            assert_true(told || (!any && border) ||
                        (at > s->first[i] && first[s->objects[at - 1]]));
        }
        assert_int_equal(at, s->first[i + 1]);
    }
    drop_world(context, &w);
    sl_context_destroy(context);
}

static void segments_end_at_the_first_wall(void **state) {
    (void)state;
    check_segments(TWO_ROOMS, false);
    check_segments(OBLIQUE_ROOMS, true);
    check_segments(TURNED_ROOMS, true);
}

static void segments_see_the_cells_they_pass(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int map = 0; map < ROOMS; map++) {
        view_world w;
        make_world(context, rooms_map(map), map > 0, SL_VIEW_CELLS, 2000, &w);
        for (uint32_t i = 0; i < w.segments.count; i++)
            for (uint32_t c = 0; c < w.space.cell_count; c++) {
                const sl_cell *cell = &w.space.cells[c];
                const double share =
                    share_inside(&w.segments.items[i], w.space.vertices + cell->first_vertex,
                                 cell->vertex_count);
                bool told = false;
                for (uint64_t k = w.segments.first[i]; k < w.segments.first[i + 1]; k++)
                    told = told || w.segments.objects[k] == c;
                if (share > NEAR) assert_true(told);
                if (share < -NEAR) assert_false(told);
            }
        drop_world(context, &w);
    }
    sl_context_destroy(context);
}

static void threads_make_no_difference(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    view_world w;
    make_world(context, TWO_ROOMS, false, SL_VIEW_CELLS, 20000, &w);
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.objects = SL_VIEW_CELLS;
    sampling.samples = 20000;
    sampling.threads = 3;
    sl_view_segments other;
    assert_ok(context, sl_view_sample(context, &w.outline, &sampling, &other));
    assert_int_equal(other.count, w.segments.count);
    assert_memory_equal(other.items, w.segments.items, other.count * sizeof *other.items);
    assert_memory_equal(other.objects, w.segments.objects,
                        other.first[other.count] * sizeof *other.objects);
    const sl_view_subdivision options = sl_view_subdivision_default();
    sl_view_tree tree;
    sl_view_sets sets[2];
    assert_ok(context,
              view_method("kd-casm")->divide(context, &w.scene, NULL, &options, &tree, NULL));
    for (unsigned i = 0; i < 2; i++)
        assert_ok(context,
                  sl_view_sets_sample(context, &w.scene, &tree, &other, 1 + 2 * i, &sets[i]));
    assert_memory_equal(sets[0].bits, sets[1].bits,
                        sets[0].count * sets[0].words * sizeof *sets[0].bits);
    for (int i = 0; i < 2; i++) sl_view_sets_destroy(context, &sets[i]);
    sl_view_tree_destroy(context, &tree);
    sl_view_segments_destroy(context, &other);
    drop_world(context, &w);
    sl_context_destroy(context);
}

// --- trees

static double area_of(const sl_point *corners, uint32_t count) {
    double twice = 0;
    for (uint32_t i = 1; i + 1 < count; i++)
        twice += cross_of(corners[0], corners[i], corners[i + 1]);
    return twice / 2;
}

static void check_tree(const view_world *w, const sl_view_tree *tree) {
    double area = 0, mass = 0;
    for (uint32_t i = 0; i < tree->leaf_count; i++) {
        const uint32_t first = tree->first[i], count = tree->first[i + 1] - first;
        assert_true(count >= 3);
        const double leaf = area_of(tree->corners + first, count);
        assert_true(leaf > 0);
        area += leaf;
        mass += tree->mass[i];
        assert_true((i < tree->cell_count) == (tree->mass[i] > 0));
    }
    const sl_box *b = &tree->bounds;
    const double whole = (b->max.x - b->min.x) * (b->max.y - b->min.y);
    assert_true(fabs(area - whole) < NEAR * whole);
    assert_true(fabs(mass - 1) < NEAR);
    assert_int_equal(tree->leaf_count, tree->node_count + 1);
    sl_random random = {7};
    for (int i = 0; i < 2000; i++) {
        const sl_point p = {b->min.x + (b->max.x - b->min.x) * sl_random_unit(&random),
                            b->min.y + (b->max.y - b->min.y) * sl_random_unit(&random)};
        const uint32_t leaf = sl_view_tree_locate(tree, p);
        assert_true(leaf < tree->leaf_count);
        const sl_point *corners = tree->corners + tree->first[leaf];
        const uint32_t count = tree->first[leaf + 1] - tree->first[leaf];
        for (uint32_t k = 0; k < count; k++)
            assert_true(cross_of(corners[k], corners[(k + 1) % count], p) > -NEAR);
        const uint32_t cell = sl_space_locate(&w->space, p);
        if (w->space.cells[cell].inside) assert_true(leaf < tree->cell_count);
    }
    assert_int_equal(sl_view_tree_locate(tree, (sl_point){b->max.x + 1, 0}), SL_NO_VIEW_CELL);
    assert_int_equal(sl_view_tree_locate(tree, (sl_point){NAN, 0}), SL_NO_VIEW_CELL);
}

static void check_sets(const view_world *w, const sl_view_tree *tree, const sl_view_sets *sets) {
    bool expected[256][64] = {0}, possible[256][64] = {0};
    assert_true(sets->count <= 256 && sets->object_count <= 64);
    for (uint32_t i = 0; i < tree->cell_count; i++)
        for (uint32_t s = 0; s < w->segments.count; s++) {
            const double share = share_inside(&w->segments.items[s], tree->corners + tree->first[i],
                                              tree->first[i + 1] - tree->first[i]);
            for (uint64_t k = w->segments.first[s]; k < w->segments.first[s + 1]; k++) {
                if (share > NEAR) expected[i][w->segments.objects[k]] = true;
                if (share > -NEAR) possible[i][w->segments.objects[k]] = true;
            }
        }
    for (uint32_t i = 0; i < tree->cell_count; i++)
        for (uint32_t o = 0; o < sets->object_count; o++) {
            if (expected[i][o]) assert_true(set_has(sets, i, o));
            if (set_has(sets, i, o)) assert_true(possible[i][o]);
        }
}

static void every_method_divides_all_of_view_space(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    for (int map = 0; map < ROOMS; map++) {
        view_world w;
        make_world(context, rooms_map(map), map > 0, SL_VIEW_WALLS, 2000, &w);
        for (size_t i = 0; i < count; i++) {
            sl_view_subdivision options = sl_view_subdivision_default();
            options.cells = 60;
            options.wall_splits = i ? 0 : 20;
            sl_view_tree tree;
            sl_view_sets sets;
            assert_ok(context, methods[i].divide(context, &w.scene,
                                                 methods[i].needs_segments ? &w.segments : NULL,
                                                 &options, &tree, NULL));
            assert_true(tree.cell_count > 4 && tree.cell_count <= options.cells + 1);
            check_tree(&w, &tree);
            assert_ok(context,
                      sl_view_sets_sample(context, &w.scene, &tree, &w.segments, 1, &sets));
            check_sets(&w, &tree, &sets);
            sl_view_sets_destroy(context, &sets);
            sl_view_tree_destroy(context, &tree);
        }
        drop_world(context, &w);
    }
    sl_context_destroy(context);
}

/// Mass and what is seen on either side of a split, from the polygons and segments themselves.
static double gain_of(const view_world *w, int axis, double at) {
    double mass[2] = {0}, all = 0;
    bool seen[2][64] = {0};
    for (uint32_t i = 0; i < w->space.cell_count; i++) {
        const sl_point *c = w->space.vertices + w->space.cells[i].first_vertex;
        if (!w->space.cells[i].inside) continue;
        const double low = axis ? c[0].y : c[0].x, high = axis ? c[2].y : c[2].x;
        const double across = axis ? c[2].x - c[0].x : c[2].y - c[0].y;
        const double below = fmin(fmax(at - low, 0), high - low);
        mass[0] += across * below;
        mass[1] += across * (high - low - below);
    }
    for (uint32_t s = 0; s < w->segments.count; s++) {
        const sl_segment *l = &w->segments.items[s];
        const double a = axis ? l->a.y : l->a.x, b = axis ? l->b.y : l->b.x;
        for (uint64_t k = w->segments.first[s]; k < w->segments.first[s + 1]; k++) {
            seen[0][w->segments.objects[k]] |= fmin(a, b) < at;
            seen[1][w->segments.objects[k]] |= fmax(a, b) > at || fmin(a, b) >= at;
        }
    }
    double gain = 0;
    all = mass[0] + mass[1];
    for (uint32_t o = 0; o < w->space.wall_count; o++)
        for (int side = 0; side < 2; side++)
            gain += mass[side] / all * ((seen[0][o] || seen[1][o]) - seen[side][o]);
    return gain;
}

static void the_first_split_gains_most(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    view_world w;
    make_world(context, TWO_ROOMS, false, SL_VIEW_WALLS, 300, &w);
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = 2;
    sl_view_tree tree;
    assert_ok(context,
              view_method("av-s")->divide(context, &w.scene, &w.segments, &options, &tree, NULL));
    assert_int_equal(tree.node_count, 1);
    const double gain = gain_of(&w, tree.nodes[0].axis, tree.nodes[0].position);
    assert_true(gain > 1);
    for (int axis = 0; axis < 2; axis++) {
        for (uint32_t s = 0; s < w.segments.count; s++) {
            const sl_segment *l = &w.segments.items[s];
            assert_true(gain_of(&w, axis, axis ? l->a.y : l->a.x) <= gain + NEAR);
            assert_true(gain_of(&w, axis, axis ? l->b.y : l->b.x) <= gain + NEAR);
        }
        for (double at = 0.01; at < (axis ? 12 : 20); at += 0.0173)
            assert_true(gain_of(&w, axis, at) <= gain + NEAR);
    }
    sl_view_tree_destroy(context, &tree);
    drop_world(context, &w);
    sl_context_destroy(context);
}

// --- places of viewpoints

static void places_give_the_mass(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    view_world w;
    make_world(context, TWO_ROOMS "path tour 1 1 9 1 9 3\n", false, SL_VIEW_WALLS, 300, &w);
    sl_view_places paths, density;
    assert_ok(context, sl_view_places_paths(context, &w.map, &w.space, 1, &paths));
    assert_int_equal(paths.count, 11);
    const double values[4] = {0, 3, 1, 0}; // lower left, lower right, upper left, upper right
    assert_ok(context, sl_view_places_density(context, &w.space, values, 2, 2, &density));
    const sl_view_places *all[3] = {&w.places, &paths, &density};
    for (int i = 0; i < 3; i++) {
        w.scene.places = all[i];
        sl_view_subdivision options = sl_view_subdivision_default();
        options.cells = 2;
        sl_view_tree tree;
        assert_ok(context,
                  view_method("kd-lasm")->divide(context, &w.scene, NULL, &options, &tree, NULL));
        const double west = tree.mass[sl_view_tree_locate(&tree, (sl_point){2, 2})];
        // Left of x = 10 there are 111 of 227 square units; all points of the path but those where
        // the tree has been cut on to leave none empty; and a quarter of the density.
        if (i == 0) assert_true(fabs(west - 111.0 / 227) < NEAR);
        if (i == 1) assert_true(west < 1 && west > 0);
        if (i == 2) assert_true(fabs(west - 0.25) < NEAR);
        sl_view_tree_destroy(context, &tree);
    }
    const double none[1] = {0};
    sl_view_places bad;
    assert_int_equal(sl_view_places_density(context, &w.space, none, 1, 1, &bad), SL_BAD_ARGUMENT);
    assert_int_equal(sl_view_places_paths(context, &w.map, &w.space, 0, &bad), SL_BAD_ARGUMENT);
    w.map.path_count = 0;
    assert_int_equal(sl_view_places_paths(context, &w.map, &w.space, 1, &bad), SL_BAD_ARGUMENT);
    w.map.path_count = 1;
    sl_view_places_destroy(context, &paths);
    sl_view_places_destroy(context, &density);
    drop_world(context, &w);
    sl_context_destroy(context);
}

static void options_out_of_range_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    view_world w;
    make_world(context, TWO_ROOMS, false, SL_VIEW_WALLS, 100, &w);
    sl_view_tree tree;
    for (int i = 0; i < 6; i++) {
        sl_view_subdivision options = sl_view_subdivision_default();
        if (i == 0) options.cells = 0;
        if (i == 1) options.patience = 0;
        if (i == 2) options.cost_weight = 1.5;
        if (i == 3) options.least_gain = NAN;
        if (i == 4) w.scene.cost.b = -1;
        if (i == 5) w.scene.cost = (sl_render_cost){INFINITY, 0, 0};
        assert_int_equal(
            view_method("av-m")->divide(context, &w.scene, &w.segments, &options, &tree, NULL),
            SL_BAD_ARGUMENT);
        w.scene.cost = sl_render_cost_default();
    }
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.samples = UINT64_C(1) << 32;
    sl_view_segments segments;
    assert_int_equal(sl_view_sample(context, &w.outline, &sampling, &segments), SL_BAD_ARGUMENT);
    drop_world(context, &w);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_end_at_the_first_wall),
        cmocka_unit_test(segments_see_the_cells_they_pass),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(every_method_divides_all_of_view_space),
        cmocka_unit_test(the_first_split_gains_most),
        cmocka_unit_test(places_give_the_mass),
        cmocka_unit_test(options_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
