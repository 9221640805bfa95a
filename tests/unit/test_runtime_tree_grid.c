// The grid over the tree of a file: points are located as without it, wherever rounding puts them.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime_maps.h"

#include "sightline/support.h"

enum { POINTS = 4000 };

/// A coordinate: anywhere, on a border of buckets, on a line of the tree, or a few numbers beside.
static double some_place(sl_random *random, double low, double high, uint32_t count,
                         const sl_space *s, int axis) {
    const uint64_t kind = sl_random_below(random, 4);
    double at = low + (high - low) * sl_random_unit(random);
    if (kind == 1) at = low + (high - low) / count * (double)sl_random_below(random, count + 1ull);
    if (kind > 1) {
        const sl_point p = s->vertices[sl_random_below(random, s->vertex_count)];
        at = axis ? p.y : p.x;
    }
    for (uint64_t steps = sl_random_below(random, 2) * sl_random_below(random, 4); steps; steps--)
        at = nextafter(at, kind == 3 ? -INFINITY : INFINITY);
    return at;
}

/// The column or row of a coordinate that comes out too high or too low by a part of a bucket.
static uint32_t rounded(double value, double low, double high, uint32_t count, double by) {
    const double step = (value - low) / (high - low) * count + by;
    return step < 0 ? 0 : step < count ? (uint32_t)step : count - 1;
}

/// Starts hold for points that rounding puts a bit beside their bucket.
static void check_starts_near(const sl_runtime *r, double x, double y) {
    const uint32_t cell = slrt_descend(r, r->root, x, y);
    for (int i = 0; i < 9; i++) {
        const double by_x = (i % 3 - 1) / 2048.0, by_y = (i / 3 - 1) / 2048.0;
        const size_t bucket =
            (size_t)rounded(y, r->min_y, r->max_y, r->tree_rows, by_y) * r->tree_columns +
            rounded(x, r->min_x, r->max_x, r->tree_columns, by_x);
        const int32_t start = slrt_i32(r->tree_starts + bucket * 4);
        assert_int_equal(slrt_descend(r, start, x, y), cell);
    }
}

static void check_points(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    const sl_space *s = &f->baked.space;
    sl_random random = {5};
    assert_int_equal(r->tree_starts != NULL, !s->neighbour);
    if (!r->tree_starts) return;
    sl_runtime without = *r;
    without.tree_starts = NULL;
    for (int i = 0; i < POINTS; i++) {
        const sl_point p = {some_place(&random, r->min_x, r->max_x, r->tree_columns, s, 0),
                            some_place(&random, r->min_y, r->max_y, r->tree_rows, s, 1)};
        const uint32_t cell = sl_runtime_locate(r, p.x, p.y);
        assert_int_equal(cell, sl_space_locate(s, p));
        assert_int_equal(cell, sl_runtime_locate(&without, p.x, p.y));
        if (cell != SL_RUNTIME_NO_CELL) check_starts_near(r, p.x, p.y);
    }
}

static void points_of_all_maps_are_located_as_without(void **state) {
    (void)state;
    baked_file_each(check_points);
}

/// A map made wider, smaller, and moved.
static void check_moved(sl_context *context, const char *name, double wide, double high,
                        double offset) {
    baked_file f = {.name = name, .baked = {.method = "dfs", .solver = "funnel"}};
    char path[1024];
    snprintf(path, sizeof path, "%s/maps/%s.map", SIGHTLINE_SOURCE_DIR, name);
    map_files_read(context, path, &f.baked.map);
    sl_map *map = &f.baked.map;
    for (size_t i = 0; i < 2 * map->wall_count; i++) {
        sl_point *p = i % 2 ? &map->walls[i / 2].a : &map->walls[i / 2].b;
        *p = (sl_point){offset + wide * p->x, offset + high * p->y};
    }
    map->start_count = 0;
    baked_file_make(context, &f, false);
    assert_non_null(f.runtime.tree_starts);
    check_points(&f);
    baked_file_destroy(context, &f);
}

static void so_are_those_of_maps_of_any_size_anywhere(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    check_moved(context, "office", 1, 1, 1e9);
    check_moved(context, "office", 0x1p-20, 0x1p-20, 1e3);
    check_moved(context, "office", 1e-6, 1e-6, 0);
    check_moved(context, "office", 1e-6, 1e-6, 1);
    check_moved(context, "office", 1e9, 1e-6, 0); // a row of buckets
    check_moved(context, "office", 1e-6, 1e9, 0);
    check_moved(context, "office", 1e140, 1e-140, 0);
    sl_context_destroy(context);
}

/// Ground with a point on each of its borders, and a map of one cell.
static void so_are_points_at_solid_ground(void **state) {
    (void)state;
    static const char *const maps[] = {
        "walls 0 0 9 0 9 9 0 9 0 0\nsolid 2 2 4 2 4 4 2 4\nsolid 6 1 7 1 7 8 6 8\n",
        "walls 0 0 9 0 9 9 0 9 0 0\n"};
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < 2; i++) {
        baked_file f = baked_file_of_text(context, maps[i]);
        assert_non_null(f.runtime.tree_starts);
        check_points(&f);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

/// Most points of a map are found in a few steps.
static void the_ways_down_are_short(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of(context, SIGHTLINE_SOURCE_DIR "/maps/office.map");
    const sl_runtime *r = &f.runtime;
    const size_t buckets = (size_t)r->tree_columns * r->tree_rows;
    size_t cells = 0;
    assert_true(buckets <= 4 * (size_t)r->cell_count && buckets > 3 * (size_t)r->cell_count);
    for (size_t i = 0; i < buckets; i++) cells += slrt_i32(r->tree_starts + i * 4) < 0;
    assert_true(cells > buckets / 5);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_of_all_maps_are_located_as_without),
        cmocka_unit_test(so_are_those_of_maps_of_any_size_anywhere),
        cmocka_unit_test(so_are_points_at_solid_ground),
        cmocka_unit_test(the_ways_down_are_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
