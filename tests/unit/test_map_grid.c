// Grids of squares: their walls, where they stand and how few they are.
#include "testing.h"

#include "map/grid.h"
#include "sightline/support.h"
#include "unit/map_same.h"

static void fill(sli_grid *grid, const char *squares) {
    memcpy(grid->squares, squares, grid->count * grid->rows[0].length);
}

static void assert_walls(const sli_grid *grid, const char *expected) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, sli_grid_add_walls(context, grid, &map));
    char *text = map_walls_text(&map);
    assert_string_equal(text, expected);
    free(text);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static sli_grid grid_of(size_t width, size_t height, const char *squares) {
    sl_context *context = testing_context(NULL);
    sli_grid grid;
    assert_ok(context, sli_grid_create(context, width, height, &grid));
    fill(&grid, squares);
    sl_context_destroy(context);
    return grid;
}

static void destroy(sli_grid *grid) {
    sl_context *context = testing_context(NULL);
    sli_grid_destroy(context, grid);
    sl_context_destroy(context);
}

static void test_open_floor_has_a_frame(void **state) {
    (void)state;
    sli_grid grid = grid_of(3, 2, "......");
    assert_walls(&grid, "sightline 1\nwall 0 2 3 2\nwall 0 0 3 0\nwall 0 0 0 2\nwall 3 0 3 2\n");
    grid.open_outside = true;
    assert_walls(&grid, "sightline 1\n");
    destroy(&grid);
}

static void test_walls_run_over_many_squares(void **state) {
    (void)state;
    sli_grid grid = grid_of(4, 3, ".....##.....");
    grid.open_outside = true;
    assert_walls(&grid, "sightline 1\nwall 1 2 3 2\nwall 1 1 3 1\nwall 1 1 1 2\nwall 3 1 3 2\n");
    destroy(&grid);
}

static void test_squares_that_touch_at_a_corner(void **state) {
    (void)state;
    sli_grid grid = grid_of(2, 2, "#..#");
    grid.open_outside = true;
    // Where two squares meet at a corner, solid and open change sides: other walls begin.
    assert_walls(&grid, "sightline 1\nwall 0 2 1 2\nwall 0 1 1 1\nwall 1 1 2 1\nwall 0 1 0 2\n"
                        "wall 1 1 1 2\nwall 1 0 2 0\nwall 1 0 1 1\nwall 2 0 2 1\n");
    destroy(&grid);
}

static void test_origin_and_step(void **state) {
    (void)state;
    sli_grid grid = grid_of(1, 2, ".#");
    grid.origin = (sl_point){-10, 0.5};
    grid.step = (sl_point){16, 0.25};
    assert_walls(&grid, "sightline 1\nwall -10 1 6 1\nwall -10 0.75 6 0.75\n"
                        "wall -10 0.75 -10 1\nwall 6 0.75 6 1\n");
    destroy(&grid);
}

enum { SIDE = 6 };

/// How many walls run along the unit edge from a corner, to the right or up.
static int walls_along(const sl_map *map, double x, double y, bool upright) {
    int count = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        if ((wall->a.x == wall->b.x) != upright) continue;
        count += upright ? wall->a.x == x && wall->a.y <= y && y < wall->b.y
                         : wall->a.y == y && wall->a.x <= x && x < wall->b.x;
    }
    return count;
}

/// No wall goes on where another in its line ends and has solid ground on the same side.
static void assert_longest(const sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++)
        for (size_t k = 0; k < map->wall_count; k++) {
            const sl_wall *a = &map->walls[i], *b = &map->walls[k];
            if ((a->a.x == a->b.x) != (b->a.x == b->b.x)) continue;
            assert_false(a->b.x == b->a.x && a->b.y == b->a.y && a->ground == b->ground);
        }
}

static void test_random_grids(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {.state = 1};
    for (int run = 0; run < 2000; run++) {
        const size_t width = 1 + (size_t)run % SIDE, height = 1 + (size_t)run / SIDE % SIDE;
        sli_grid grid;
        sl_map map = {0};
        assert_ok(context, sli_grid_create(context, width, height, &grid));
        grid.open_outside = run & 1;
        for (size_t i = 0; i < width * height; i++)
            if (sl_random_below(&random, 256) < (uint64_t)(run & 0xff)) grid.squares[i] = '#';
        assert_ok(context, sli_grid_add_walls(context, &grid, &map));
        // Row by row from one above the top, each square's left and lower edge.
        for (size_t row = SIZE_MAX; row == SIZE_MAX || row < height; row++)
            for (size_t column = 0; column <= width; column++) {
                const double x = (double)column, y = (double)(height - 1 - row);
                const bool here = sli_grid_solid(&grid, row, column);
                assert_int_equal(walls_along(&map, x, y, true),
                                 here != sli_grid_solid(&grid, row, column - 1));
                assert_int_equal(walls_along(&map, x, y, false),
                                 here != sli_grid_solid(&grid, row + 1, column));
            }
        assert_longest(&map);
        sl_map_destroy(context, &map);
        sli_grid_destroy(context, &grid);
    }
    sl_context_destroy(context);
}

static void test_memory(void **state) {
    (void)state;
    for (long fail_at = 1; fail_at <= 2; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        memory.fail_at = memory.calls + fail_at;
        sli_grid grid = {0};
        assert_int_equal(sli_grid_create(context, 3, 3, &grid), SL_NO_MEMORY);
        assert_null(grid.rows);
        memory.fail_at = 0;
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_open_floor_has_a_frame),
        cmocka_unit_test(test_walls_run_over_many_squares),
        cmocka_unit_test(test_squares_that_touch_at_a_corner),
        cmocka_unit_test(test_origin_and_step),
        cmocka_unit_test(test_random_grids),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
