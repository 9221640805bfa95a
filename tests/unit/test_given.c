/// Cells that come with a map: taken as they are, mended where they are rounded, refused by name.
#include "unit/grid_walls.h"

#include <math.h>

enum { MAPS = 600 };

static sl_status take(sl_context *context, const char *statements, sl_space *space) {
    char text[2048];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    sl_map map = {0};
    assert_ok(context, sl_map_read_text(context, "test", text, strlen(text), &map));
    const sl_status status = sl_subdivide_given(context, &map, space);
    sl_map_destroy(context, &map);
    return status;
}

/// The walls of a box of 20 x 10.
#define BOX "walls 0 0 20 0 20 10 0 10 0 0\n"

static void test_taken(void **state) {
    (void)state;
    const struct {
        const char *text;
        uint32_t cells, portals;
    } cases[] = {
        {BOX "cell 0 0 20 0 20 10 0 10", 1, 0},
        // Two cells, one the other way round.
        {BOX "cell 0 0 10 0 10 10 0 10\ncell 10 0 10 10 20 10 20 0", 2, 1},
        // A T-junction, exact; and one that is off its side, which bends the cell.
        {BOX "cell 0 0 10 0 10 10 0 10\ncell 10 0 20 0 20 5 10 5\ncell 10 5 20 5 20 10 10 10", 3,
         3},
        {BOX "snap 0.01\ncell 0 0 10 0 10 10 0 10\n"
             "cell 10 0 20 0 20 5 9.995 5\ncell 9.995 5 20 5 20 10 10 10",
         4, 4},
        {BOX "snap 0.01\ncell 0 0 10 0 10 10 0 10\n"
             "cell 10 0 20 0 20 5 10.005 5\ncell 10.005 5 20 5 20 10 10 10",
         3, 3},
        // Corners that miss each other and the walls.
        {BOX "snap 0.01\ncell 0 0.001 10 -0.001 10 10.001 0.002 10\n"
             "cell 10.003 0.001 20 0 20.001 10 9.999 9.999",
         2, 1},
        // A thin wall between two cells, of part of their side.
        {BOX "wall 10 0 10 4\ncell 0 0 10 0 10 10 0 10\ncell 10 0 20 0 20 10 10 10", 2, 1},
        // Cells without walls: beyond the outer sides there is nothing.
        {"cell 0 0 10 0 10 10 0 10\ncell 10 0 20 0 20 10 10 10", 2, 1},
        // A hole that walls enclose; two rooms apart.
        {"walls 4 4 4 6 6 6 6 4 4 4\ncell 0 0 10 0 10 4 0 4\ncell 0 6 10 6 10 10 0 10\n"
         "cell 0 4 4 4 4 6 0 6\ncell 6 4 10 4 10 6 6 6",
         4, 4},
        {"walls 0 0 1 0 1 1 0 1 0 0\nwalls 5 0 6 0 6 1 5 1 5 0\ncell 0 0 1 0 1 1 0 1\n"
         "cell 5 0 6 0 6 1 5 1",
         2, 0},
        // Half of a room, with nothing beyond.
        {BOX "cell 0 0 10 0 10 10 0 10", 1, 0},
        // Without area.
        {BOX "cell 0 0 20 0 20 10 0 10\ncell 0 0 10 0 20 0", 1, 0},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_space space = {0};
        assert_ok(context, take(context, cases[i].text, &space));
        assert_int_equal(space.cell_count, cases[i].cells);
        assert_int_equal(space.portal_count, cases[i].portals);
        assert_int_equal(space.partial, 1);
        for (uint32_t c = 0; c < space.cell_count; c++)
            assert_in_range(sl_space_locate(&space, space.vertices[space.cells[c].first_vertex]), 0,
                            space.cell_count - 1);
        sl_space_destroy(context, &space);
    }
    sl_context_destroy(context);
}

static void test_gaps_have_no_cell(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_space space = {0};
    assert_ok(context,
              take(context,
                   "walls 4 4 4 6 6 6 6 4 4 4\ncell 0 0 10 0 10 4 0 4\ncell 0 6 10 6 10 10 0 10\n"
                   "cell 0 4 4 4 4 6 0 6\ncell 6 4 10 4 10 6 6 6",
                   &space));
    assert_int_equal(sl_space_locate(&space, (sl_point){5, 5}), SL_NO_CELL);
    assert_int_equal(sl_space_locate(&space, (sl_point){11, 5}), SL_NO_CELL);
    assert_int_not_equal(sl_space_locate(&space, (sl_point){5, 4}), SL_NO_CELL);
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
}

static void test_refused(void **state) {
    (void)state;
    const struct {
        const char *text, *message;
    } cases[] = {
        {BOX, "the map: the map brings no cells of its own"},
        {BOX "cell 0 0 10 0 20 0", "the map: the map's cells enclose no area"},
        {BOX "cell 0 0 10 0 10 10 0 10\ncell 10.5 0 20 0 20 10 10.5 10",
         "the map:3: cell 0 has the side 10 0 to 10 10, which is along no wall and"},
        {BOX "cell 0 0 12 0 12 10 0 10\ncell 10 0 20 0 20 10 10 10", "along no wall and"},
        {BOX "wall 80 0 90 0\ncell 0 0 20 0 20 10 0 10\ncell 0 0 20 0 20 10 0 10",
         "two of them overlap at"},
        {"cell 0 0 20 0 20 10 0 10\ncell 0 0 20 0 20 10 0 10",
         "which cell 0 has at the same hand: the two overlap"},
        {BOX "wall 5 5 6 6\ncell 0 0 20 0 20 10 0 10", "has a wall inside"},
        {"walls 0 0 20 0 0 10 18 8 0 0\ncell 0 0 20 0 0 10 18 8", "cell 0 is bent so far"},
        {BOX "snap 4\ncell 1 1 2 1 2 2 1 2", "than the snapping distance 4"},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_space space = {0};
        const sl_status status = take(context, cases[i].text, &space);
        if (status != SL_BAD_INPUT || !strstr(sl_context_message(context), cases[i].message))
            fail_msg("%s: %s", cases[i].text, sl_context_message(context));
        assert_null(space.cells);
    }
    sl_context_destroy(context);
}

/// The cells of a BSP's space, their corners rounded as a node builder's are.
static void bring_cells(sl_context *context, const sl_space *space, double unit, sl_map *map) {
    sl_point corners[256];
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const sl_cell *cell = &space->cells[c];
        assert_in_range(cell->vertex_count, 3, 256);
        for (uint32_t i = 0; i < cell->vertex_count; i++) {
            const sl_point at = space->vertices[cell->first_vertex + i];
            corners[i] = (sl_point){round(at.x / unit) * unit, round(at.y / unit) * unit};
        }
        assert_ok(context, sl_map_add_cell(context, map, corners, NULL, cell->vertex_count, 0));
    }
    map->snap = 2 * unit;
}

static int check_given(const drawn *d, sl_context *context, const sl_map *map, sl_random *random,
                       int *refused) {
    sl_space given = {0};
    sl_visibility swept = {0}, searched = {0};
    if (sl_subdivide_given(context, map, &given) != SL_OK) {
        ++*refused;
        return 0;
    }
    assert_ok(context, sl_space_check(context, &given));
    see(context, &given, "sweep", SL_CLOSED, &swept);
    see(context, &given, "dfs", SL_CLOSED, &searched);
    for (uint32_t a = 0; a < given.cell_count; a++)
        for (uint32_t b = 0; b < given.cell_count; b++)
            assert_int_equal(sl_pvs_sees(&swept.pvs, a, b), sl_pvs_sees(&searched.pvs, a, b));
    const int checked = check_free(d, &given, &swept.pvs, 1, 0, random);
    sl_visibility_destroy(context, &swept);
    sl_visibility_destroy(context, &searched);
    sl_space_destroy(context, &given);
    return checked;
}

/// Free sightlines of the walls, through cells rounded to a 65536th and to a thousandth.
static void test_random_walls(void **state) {
    (void)state;
    sl_random random = {8};
    int checked = 0, refused = 0;
    for (int i = 0; i < MAPS; i++) {
        sl_context *context = testing_context(NULL);
        const drawn d = draw(&random, i % 4);
        sl_map map = {0};
        sl_space space = {0};
        for (int k = 0; k < d.count; k++)
            assert_ok(context, sl_map_add_wall(context, &map, scaled(d.a[k], 1, 0),
                                               scaled(d.b[k], 1, 0), 0));
        assert_ok(context, sl_subdivide_mesh(context, &options, &space));
        bring_cells(context, &space, i % 2 ? 0x1p-16 : 0.001, &map);
        checked += check_given(&d, context, &map, &random, &refused);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
    assert_true(checked > 2 * MAPS);
    assert_true(refused < MAPS / 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_taken),
        cmocka_unit_test(test_gaps_have_no_cell),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_random_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
