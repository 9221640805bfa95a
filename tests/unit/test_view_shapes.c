/// The shapes of view cells beside the elementary cells that they are made of: the same area, the
/// same points, for cuts of the hierarchy and for groups of cells that no method would make.
#include "view_cells_maps.h"

#include "sightline/support.h"

#define NEAR 1e-9

static double area_of(const sl_point *corners, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += cross_of(corners[0], corners[i], corners[(i + 1) % count]);
    return sum / 2;
}

/// Whether a ring goes around a point that is not on it.
static bool is_around(const sl_point *corners, uint32_t count, sl_point p) {
    bool odd = false;
    for (uint32_t i = 0; i < count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % count];
        if ((a.y <= p.y) != (b.y <= p.y) && (cross_of(a, b, p) > 0) == (b.y > a.y)) odd = !odd;
    }
    return odd;
}

static bool covers(const sl_shapes *shapes, uint32_t shape, sl_point p) {
    bool odd = false;
    const uint32_t first = shapes->polygons[shapes->shapes[shape]];
    for (uint32_t i = first; i < shapes->polygons[shapes->shapes[shape + 1]]; i++)
        odd ^= is_around(shapes->points + shapes->rings[i], shapes->rings[i + 1] - shapes->rings[i],
                         p);
    return odd;
}

static void check_rings(const sl_shapes *shapes) {
    for (uint32_t i = 0; i < shapes->shapes[shapes->count]; i++)
        for (uint32_t k = shapes->polygons[i]; k < shapes->polygons[i + 1]; k++) {
            const uint32_t count = shapes->rings[k + 1] - shapes->rings[k];
            const sl_point *ring = shapes->points + shapes->rings[k];
            assert_true(count >= 3);
            assert_true((area_of(ring, count) > 0) == (k == shapes->polygons[i]));
            if (k > shapes->polygons[i]) {
                const uint32_t outer = shapes->polygons[i];
                const sl_point middle = {(ring[0].x + ring[1].x) / 2, (ring[0].y + ring[1].y) / 2};
                assert_true(is_around(shapes->points + shapes->rings[outer],
                                      shapes->rings[outer + 1] - shapes->rings[outer], middle));
            }
        }
}

static void check(sl_context *context, const sl_view_tree *tree, const uint32_t *groups,
                  uint32_t count, uint32_t *holes, uint32_t *parts) {
    sl_shapes shapes;
    double *areas = calloc(count, sizeof *areas);
    assert_non_null(areas);
    assert_ok(context, sl_view_shapes(context, tree, groups, count, &shapes));
    assert_int_equal(shapes.count, count);
    check_rings(&shapes);
    for (uint32_t i = 0; i < tree->cell_count; i++)
        areas[groups[i]] +=
            area_of(tree->corners + tree->first[i], tree->first[i + 1] - tree->first[i]);
    for (uint32_t i = 0; i < count; i++) {
        double area = 0;
        const uint32_t first = shapes.polygons[shapes.shapes[i]];
        for (uint32_t k = first; k < shapes.polygons[shapes.shapes[i + 1]]; k++)
            area += area_of(shapes.points + shapes.rings[k], shapes.rings[k + 1] - shapes.rings[k]);
        assert_true(fabs(area - areas[i]) <= NEAR * (1 + areas[i]));
        *parts += shapes.shapes[i + 1] - shapes.shapes[i];
    }
    sl_random random = {7};
    for (int i = 0; i < 2000; i++) {
        const sl_box *b = &tree->bounds;
        const sl_point p = {b->min.x + sl_random_unit(&random) * (b->max.x - b->min.x),
                            b->min.y + sl_random_unit(&random) * (b->max.y - b->min.y)};
        const uint32_t leaf = sl_view_tree_locate(tree, p);
        for (uint32_t k = 0; k < count; k++)
            assert_int_equal(covers(&shapes, k, p), leaf < tree->cell_count && groups[leaf] == k);
    }
    *holes += shapes.polygons[shapes.shapes[count]] - shapes.shapes[count];
    sl_view_shapes_destroy(context, &shapes);
    sl_view_shapes_destroy(context, &shapes); // twice does no harm
    free(areas);
}

static void divide(sl_context *context, int number, uint32_t cells, view_world *w,
                   sl_view_tree *tree) {
    make_world(context, rooms_map(number), number > 0, SL_VIEW_WALLS, 3000, w);
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = cells;
    options.wall_splits = number > 0 ? 10 : 0;
    assert_ok(context,
              view_method("av-m")->divide(context, &w->scene, &w->segments, &options, tree, NULL));
}

static void shapes_cover_their_cells(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    uint32_t holes = 0, parts = 0, shapes = 0;
    for (int number = 0; number < ROOMS; number++) {
        view_world w;
        sl_view_tree tree = {0};
        divide(context, number, 120, &w, &tree);
        uint32_t *groups = calloc(tree.cell_count, sizeof *groups);
        assert_non_null(groups);
        sl_random random = {3};
        const uint32_t counts[] = {1, 2, 5, tree.cell_count};
        for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
            for (uint32_t k = 0; k < tree.cell_count; k++)
                groups[k] = counts[i] == tree.cell_count
                                ? k
                                : (uint32_t)sl_random_below(&random, counts[i]);
            check(context, &tree, groups, counts[i], &holes, &parts);
            shapes += counts[i];
        }
        free(groups);
        sl_view_tree_destroy(context, &tree);
        drop_world(context, &w);
    }
    assert_true(holes > 10 && parts > shapes + 10); // both kinds are there to be checked
    sl_context_destroy(context);
}

static void no_memory_is_told(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    view_world w;
    sl_view_tree tree = {0};
    divide(context, 1, 20, &w, &tree);
    uint32_t groups[64] = {0};
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long fail = 1; status != SL_OK; fail++) {
        sl_shapes shapes = {0};
        memory.calls = 0;
        memory.fail_at = fail;
        status = sl_view_shapes(context, &tree, groups, 1, &shapes);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        assert_true(status == SL_OK ? fail > 5 : !shapes.points);
        sl_view_shapes_destroy(context, &shapes);
        assert_int_equal(memory.live, before);
    }
    memory.fail_at = 0;
    sl_view_tree_destroy(context, &tree);
    drop_world(context, &w);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes_cover_their_cells),
                                       cmocka_unit_test(no_memory_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
