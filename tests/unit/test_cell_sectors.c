// Which sectors a cell is in, where the lines about it are in awkward places.
#include "testing.h"

#include "bake/cell_sectors.h"

/// The sectors of a cell of four corners.
static uint32_t find_in(sl_doom_line *lines, size_t count, sl_point corners[4], uint32_t found[4]) {
    sl_context *context = testing_context(NULL);
    sl_cell cell = {.vertex_count = 4};
    const sl_space space = {.bounds = {{0, 0}, {1024, 1024}},
                            .cell_count = 1,
                            .vertex_count = 4,
                            .cells = &cell,
                            .vertices = corners};
    const sl_doom_level level = {.lines = lines, .line_count = count};
    sl_cell_sectors sectors = {0};
    assert_ok(context, sl_cell_sectors_find(context, &space, &level, &sectors));
    const uint32_t number = sectors.first[1];
    assert_in_range(number, 0, 4);
    for (uint32_t i = 0; i < number; i++) found[i] = sectors.sectors[i];
    sl_cell_sectors_destroy(context, &sectors);
    sl_context_destroy(context);
    return number;
}

/// The sectors of a square cell, 0 0 to 2 2 but for its right side, which is at `right`.
static uint32_t find(sl_doom_line *lines, size_t count, double right, uint32_t found[4]) {
    sl_point corners[] = {{0, 0}, {right, 0}, {right, 2}, {0, 2}};
    return find_in(lines, count, corners, found);
}

/// The ray from the cell's middle meets three lines in one place, one of them from behind the
/// others.
static void test_middle_level_with_a_vertex(void **state) {
    (void)state;
    sl_doom_line lines[] = {
        {.from = {3, 2}, .to = {2, 1}, .right = 16, .left = SL_NO_SECTOR},
        {.from = {2, 0}, .to = {2, 1}, .right = 8, .left = 7},
        {.from = {2, 1}, .to = {2, 2}, .right = 8, .left = 7},
    };
    uint32_t found[4];
    assert_int_equal(find(lines, 3, 2, found), 1);
    assert_int_equal(found[0], 7);
}

/// The ray passes just below a vertex at which two lines meet from below.
static void test_middle_just_below_a_vertex(void **state) {
    (void)state;
    const sl_point top = {3, 1 + 1e-12};
    sl_doom_line lines[] = {
        {.from = top, .to = {4, 0}, .right = 8, .left = 7},
        {.from = {2.5, 0}, .to = top, .right = 8, .left = 7},
        {.from = {5, -1}, .to = {5, 3}, .right = SL_NO_SECTOR, .left = 7},
    };
    uint32_t found[4];
    assert_int_equal(find(lines, 3, 2, found), 1);
    assert_int_equal(found[0], 7);
}

/// Two corners are rounded to be beyond the line that the cell was cut along by so little that it
/// is lost where their distance is rounded.
static void test_beyond_a_line_by_a_bit(void **state) {
    (void)state;
    sl_doom_line lines[] = {
        {.from = {0, 0}, .to = {3, 1}, .right = 8, .left = 7},
        {.from = {5, -1}, .to = {5, 3}, .right = SL_NO_SECTOR, .left = 7},
    };
    sl_point corners[] = {{1, 1. / 3}, {2, 2. / 3}, {2, 2}, {1, 2}};
    uint32_t found[4];
    assert_int_equal(find_in(lines, 2, corners, found), 1);
    assert_int_equal(found[0], 7);
}

/// A cell that was cut along a line reaches beyond it by rounding; one that was not, by more.
static void test_beyond_a_line(void **state) {
    (void)state;
    sl_doom_line lines[] = {
        {.from = {2, -1}, .to = {2, 3}, .right = 8, .left = 7},
        {.from = {5, -1}, .to = {5, 3}, .right = SL_NO_SECTOR, .left = 8},
    };
    uint32_t found[4];
    assert_int_equal(find(lines, 2, 2 + 1e-7, found), 1);
    assert_int_equal(found[0], 7);
    assert_int_equal(find(lines, 2, 3, found), 2);
    assert_int_equal(found[0], 7);
    assert_int_equal(found[1], 8);
}

/// Walls back to back: the one that has a sector on this side tells.
static void test_walls_back_to_back(void **state) {
    (void)state;
    sl_doom_line lines[] = {
        {.from = {4, -1}, .to = {4, 3}, .right = 9, .left = SL_NO_SECTOR},
        {.from = {4, 3}, .to = {4, -1}, .right = 7, .left = SL_NO_SECTOR},
    };
    uint32_t found[4];
    assert_int_equal(find(lines, 2, 2, found), 1);
    assert_int_equal(found[0], 7);
}

/// Between two lines nearer to each other than what rounding may do, a cell has no sector.
static void test_thin_cell(void **state) {
    (void)state;
    sl_doom_line lines[] = {{.from = {0, -1}, .to = {0, 3}, .right = 8, .left = 7}};
    uint32_t found[4];
    assert_int_equal(find(lines, 1, 1e-7, found), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_middle_level_with_a_vertex),
        cmocka_unit_test(test_middle_just_below_a_vertex),
        cmocka_unit_test(test_beyond_a_line),
        cmocka_unit_test(test_beyond_a_line_by_a_bit),
        cmocka_unit_test(test_walls_back_to_back),
        cmocka_unit_test(test_thin_cell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
