/// The choice of a subdivision, and where the splits of a tree lie.
#include "testing.h"

#include "sightline/import.h"
#include "space/splits.h"

#include <math.h>
#include <string.h>

static double area_of(const sl_splits *splits, sl_split_region region) {
    const sl_point *p = splits->corners.items + region.first;
    double sum = 0;
    for (size_t i = 0; i < region.count; i++) {
        const sl_point a = p[i], b = p[(i + 1) % region.count];
        sum += (a.x * b.y - a.y * b.x) / 2;
    }
    return sum;
}

static bool near(double a, double b) {
    return fabs(a - b) <= 1e-9 * fmax(1, fmax(fabs(a), fabs(b)));
}

static void walls_choose_the_subdivision(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){0, 0}, (sl_point){4, 0}, 0));
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){4, 0}, (sl_point){4, 3}, 0));
    assert_int_equal(sl_map_count_oblique(&map), 0);
    assert_string_equal(sl_subdivision_for(&map)->name, "kd");
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){4, 3}, (sl_point){0, 0}, 0));
    assert_int_equal(sl_map_count_oblique(&map), 1);
    assert_string_equal(sl_subdivision_for(&map)->name, "mesh");
    size_t count;
    const sl_subdivision *all = sl_subdivisions(&count);
    assert_true(count >= 2);
    sl_space space;
    assert_int_equal(all[0].subdivide(context, &map, NULL, &space), SL_BAD_INPUT);
    assert_ok(context, all[1].subdivide(context, &map, NULL, &space));
    assert_true(space.cell_count > 1);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// The sides of splits that are cells fill the bounds; in a kd-tree each node has one split.
static void check_splits(const sl_space *space, const sl_splits *splits) {
    double cells = 0;
    assert_int_equal(splits->node_count, space->node_count);
    assert_int_equal(splits->first[space->node_count], splits->splits.count);
    for (uint32_t n = 0; n < space->node_count; n++) {
        if (!space->beyond) assert_int_equal(splits->first[n + 1], splits->first[n] + 1);
        for (uint32_t i = splits->first[n]; i < splits->first[n + 1]; i++) {
            const sl_split *s = &splits->splits.items[i];
            assert_int_equal(s->node, n);
            assert_true(s->depth < space->tree_depth);
            assert_true(area_of(splits, s->below) >= 0 && area_of(splits, s->above) >= 0);
            if (space->nodes[n].below < 0) cells += area_of(splits, s->below);
            if (space->nodes[n].above < 0) cells += area_of(splits, s->above);
        }
    }
    const sl_box b = space->bounds;
    assert_true(near(cells, (b.max.x - b.min.x) * (b.max.y - b.min.y)));
}

static void regions_fill_the_bounds(void **state) {
    (void)state;
    const char *const paths[] = {"/maps/office.map", "/maps/spiral.map", "/maps/grazing.map",
                                 "/maps/oblique/rotunda.map"};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        char path[4096];
        sl_map map = {0};
        sl_space space;
        sl_splits splits;
        snprintf(path, sizeof path, "%s%s", SIGHTLINE_SOURCE_DIR, paths[i]);
        assert_ok(context, sl_map_read(context, path, NULL, &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        assert_ok(context, sl_subdivision_for(&map)->subdivide(context, &map, NULL, &space));
        assert_int_equal(space.beyond != NULL, strstr(path, "oblique") != NULL);
        assert_ok(context, sl_splits_make(context, &space, &splits));
        check_splits(&space, &splits);
        sl_splits_destroy(context, &splits);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static void walls_cover_splits(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    sl_splits splits;
    // The one split is x = 2, of which a wall covers a quarter.
    testing_space(context, "walls 0 0 4 0 4 4 0 4 0 0\nwall 2 1 2 2\n", &map, &space);
    assert_ok(context, sl_splits_make(context, &space, &splits));
    assert_int_equal(splits.splits.count, 1);
    assert_true(sl_splits_covered(&splits, &space, 0) == 0.25);
    const sl_segment along = splits.splits.items[0].along;
    assert_true(along.a.x == 2 && along.b.x == 2 && fabs(along.a.y - along.b.y) == 4);
    sl_splits_destroy(context, &splits);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    // Without a wall inside there is no split.
    map = (sl_map){0};
    testing_space(context, "walls 0 0 4 0 4 4 0 4 0 0\n", &map, &space);
    assert_ok(context, sl_splits_make(context, &space, &splits));
    assert_int_equal(splits.splits.count, 0);
    sl_splits_destroy(context, &splits);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_choose_the_subdivision),
        cmocka_unit_test(regions_fill_the_bounds),
        cmocka_unit_test(walls_cover_splits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
