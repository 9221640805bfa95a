/// The BSP on random walls that cross, touch and overlap: the space is in order, what is free in
/// the map is seen in it, and methods agree on it.
#include "unit/grid_walls.h"

enum { MAPS = 1200 };

static int check_map(sl_random *random, int kind, double scale, double shift) {
    sl_context *context = testing_context(NULL);
    const drawn d = draw(random, kind);
    sl_map map = {0};
    sl_space space = {0};
    int checked = 0;
    for (int i = 0; i < d.count; i++)
        assert_ok(context, sl_map_add_wall(context, &map, scaled(d.a[i], scale, shift),
                                           scaled(d.b[i], scale, shift), 0));
    const sl_bsp_options options = sl_bsp_options_default();
    assert_ok(context, sl_subdivide_bsp(context, &map, &options, &space));
    assert_ok(context, sl_space_check(context, &space));
    for (sl_sight sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_visibility swept = {0}, searched = {0};
        see(context, &space, "sweep", sight, &swept);
        see(context, &space, "dfs", sight, &searched);
        for (uint32_t a = 0; a < space.cell_count; a++)
            for (uint32_t b = 0; b < space.cell_count; b++)
                assert_int_equal(sl_pvs_sees(&swept.pvs, a, b), sl_pvs_sees(&searched.pvs, a, b));
        if (sight == SL_CLOSED) checked = check_free(&d, &space, &swept.pvs, scale, shift, random);
        sl_visibility_destroy(context, &swept);
        sl_visibility_destroy(context, &searched);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return checked;
}

static void random_walls(void **state) {
    (void)state;
    sl_random random = {3};
    int checked = 0;
    for (int i = 0; i < MAPS; i++) checked += check_map(&random, i % 4, 1, 0);
    assert_true(checked > 3 * MAPS);
}

static void tiny_huge_and_far(void **state) {
    (void)state;
    sl_random random = {4};
    for (int i = 0; i < MAPS / 3; i++) {
        check_map(&random, i % 4, 0x1p-400, 0);
        check_map(&random, i % 4, 0x1p400, 0);
        check_map(&random, i % 4, 1, 0x1p40);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_walls),
        cmocka_unit_test(tiny_huge_and_far),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
