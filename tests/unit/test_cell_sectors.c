// Which sectors a cell is in, where the lines about it are in awkward places.
#include "testing.h"

#include "io/doom/wad.h"

/// The sectors of a cell of four corners.
static uint32_t find_in(sli_doom_line *lines, size_t count, sl_point corners[4],
                        uint32_t found[4]) {
    sl_context *context = testing_context(NULL);
    sl_cell cell = {.vertex_count = 4};
    const sl_space space = {.bounds = {{0, 0}, {1024, 1024}},
                            .cell_count = 1,
                            .vertex_count = 4,
                            .cells = &cell,
                            .vertices = corners};
    const sli_doom_level level = {.lines = lines, .line_count = count};
    sli_cell_sectors sectors = {0};
    assert_ok(context, sli_cell_sectors_find(context, &space, &level, &sectors));
    const uint32_t number = sectors.first[1];
    assert_true(number <= 4);
    for (uint32_t i = 0; i < number; i++) found[i] = sectors.sectors[i];
    sli_cell_sectors_destroy(context, &sectors);
    sl_context_destroy(context);
    return number;
}

/// The sectors of a square cell, 0 0 to 2 2 but for its right side, which is at `right`.
static uint32_t find(sli_doom_line *lines, size_t count, double right, uint32_t found[4]) {
    sl_point corners[] = {{0, 0}, {right, 0}, {right, 2}, {0, 2}};
    return find_in(lines, count, corners, found);
}

/// The ray from the cell's middle meets three lines in one place, one of them from behind the
/// others.
static void test_middle_level_with_a_vertex(void **state) {
    (void)state;
    sli_doom_line lines[] = {
        {.from = {3, 2}, .to = {2, 1}, .right = 16, .left = SLI_NO_SECTOR},
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
    sli_doom_line lines[] = {
        {.from = top, .to = {4, 0}, .right = 8, .left = 7},
        {.from = {2.5, 0}, .to = top, .right = 8, .left = 7},
        {.from = {5, -1}, .to = {5, 3}, .right = SLI_NO_SECTOR, .left = 7},
    };
    uint32_t found[4];
    assert_int_equal(find(lines, 3, 2, found), 1);
    assert_int_equal(found[0], 7);
}

/// A cell counts for the sector beyond a line as soon as a corner is beyond it, by however little;
/// not where a side lies on the line.
static void test_beyond_a_line(void **state) {
    (void)state;
    sli_doom_line lines[] = {
        {.from = {2, -1}, .to = {2, 3}, .right = 8, .left = 7},
        {.from = {5, -1}, .to = {5, 3}, .right = SLI_NO_SECTOR, .left = 8},
    };
    uint32_t found[4];
    const double rights[] = {2 + 0x1p-51, 2 + 1e-7, 3};
    for (size_t i = 0; i < sizeof rights / sizeof *rights; i++) {
        assert_int_equal(find(lines, 2, rights[i], found), 2);
        assert_int_equal(found[0], 7);
        assert_int_equal(found[1], 8);
    }
    assert_int_equal(find(lines, 2, 2, found), 1);
    assert_int_equal(found[0], 7);
}

/// Walls back to back: the one that has a sector on this side tells.
static void test_walls_back_to_back(void **state) {
    (void)state;
    sli_doom_line lines[] = {
        {.from = {4, -1}, .to = {4, 3}, .right = 9, .left = SLI_NO_SECTOR},
        {.from = {4, 3}, .to = {4, -1}, .right = 7, .left = SLI_NO_SECTOR},
    };
    uint32_t found[4];
    assert_int_equal(find(lines, 2, 2, found), 1);
    assert_int_equal(found[0], 7);
}

/// However thin a cell is, it has the sector between the lines about it.
static void test_thin_cell(void **state) {
    (void)state;
    sli_doom_line lines[] = {{.from = {0, -1}, .to = {0, 3}, .right = 8, .left = 7}};
    uint32_t found[4];
    assert_int_equal(find(lines, 1, 1e-7, found), 1);
    assert_int_equal(found[0], 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_middle_level_with_a_vertex),
        cmocka_unit_test(test_middle_just_below_a_vertex),
        cmocka_unit_test(test_beyond_a_line),
        cmocka_unit_test(test_walls_back_to_back),
        cmocka_unit_test(test_thin_cell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
