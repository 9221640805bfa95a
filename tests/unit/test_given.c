/// Cells that come with a map: welded where they are rounded, filled up where they leave gaps,
/// refused by number and line where they overlap.
#include "unit/grid_walls.h"

#include "map/scan.h"
#include "oracle/blockers.h"
#include "space/subdivide.h"

#include <math.h>

enum { MAPS = 600 };

// --- each cell of the space in one of the map's cells, or in none

typedef struct polygon {
    const sl_point *corners;
    size_t count;
} polygon;

static polygon polygon_of(const sl_space *space, uint32_t cell) {
    return (polygon){space->vertices + space->cells[cell].first_vertex,
                     space->cells[cell].vertex_count};
}

/// Whether a segment has no point inside of a convex polygon: one of its sides parts the two, or
/// the segment's own line does. Exact.
static bool is_apart(polygon p, sl_point a, sl_point b) {
    bool at_left = false, at_right = false;
    for (size_t i = 0; i < p.count; i++) {
        const sl_point c = p.corners[i], d = p.corners[(i + 1) % p.count];
        if (blockers_turn(c, d, a) <= 0 && blockers_turn(c, d, b) <= 0) return true;
        at_left |= blockers_turn(a, b, c) > 0;
        at_right |= blockers_turn(a, b, c) < 0;
    }
    return !at_left || !at_right;
}

/// No side of a cell of the map, which was cleaned, goes through a cell of the space.
static void assert_within(const sl_map *map, const sl_space *space) {
    for (uint32_t c = 0; c < space->cell_count; c++)
        for (size_t i = 0; i < map->cell_count; i++) {
            const sl_map_cell *cell = &map->cells[i];
            const sl_point *corners = map->corners + cell->first;
            for (size_t k = 0; k < cell->count; k++)
                if (!is_apart(polygon_of(space, c), corners[k], corners[(k + 1) % cell->count]))
                    fail_msg("cell %u of the space, side %zu of cell %zu of the map", c, k, i);
        }
}

// --- maps by hand

static void read_map(sl_context *context, const char *statements, sl_map *map) {
    char text[2048];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "test", text, strlen(text), map));
}

/// Cleans and subdivides.
static sl_status take(sl_context *context, const char *statements, sl_map *map, sl_space *space) {
    read_map(context, statements, map);
    const sl_status status = sl_map_clean(context, map, NULL, NULL);
    return status == SL_OK ? sli_subdivide_given(context, map, space) : status;
}

static double area_within(const sl_space *space) {
    double sum = 0;
    for (uint32_t i = 0; i < space->cell_count; i++) sum += sl_space_area(space, i);
    return sum;
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
        // A T-junction, exact; and one that is off its side and bends the cell inwards or outwards.
        {BOX "cell 0 0 10 0 10 10 0 10\ncell 10 0 20 0 20 5 10 5\ncell 10 5 20 5 20 10 10 10", 3,
         3},
        {BOX "snap 0.01\ncell 0 0 10 0 10 10 0 10\n"
             "cell 10 0 20 0 20 5 9.995 5\ncell 9.995 5 20 5 20 10 10 10",
         4, 4},
        {BOX "snap 0.01\ncell 0 0 10 0 10 10 0 10\n"
             "cell 10 0 20 0 20 5 10.005 5\ncell 10.005 5 20 5 20 10 10 10",
         3, 3},
        // Corners that miss each other, the walls' ends and the walls, which are bent: there are
        // two slivers below them and one above.
        {BOX "snap 0.01\ncell 0 0.001 10 -0.001 10 10.001 0.002 10\n"
             "cell 10.003 0.001 20 0 20.001 10 9.999 9.999",
         5, 1},
        // A wall between two cells, of part of their side; and one inside a cell.
        {BOX "wall 10 0 10 4\ncell 0 0 10 0 10 10 0 10\ncell 10 0 20 0 20 10 10 10", 2, 1},
        {BOX "wall 5 0 5 4\ncell 0 0 20 0 20 10 0 10", 3, 2},
        // A way around a place that no cell is in; two rooms apart, and the gap between them.
        {"walls 4 4 4 6 6 6 6 4 4 4\ncell 0 0 10 0 10 4 0 4\ncell 0 6 10 6 10 10 0 10\n"
         "cell 0 4 4 4 4 6 0 6\ncell 6 4 10 4 10 6 6 6",
         5, 4},
        {"walls 0 0 1 0 1 1 0 1 0 0\nwalls 5 0 6 0 6 1 5 1 5 0\ncell 0 0 1 0 1 1 0 1\n"
         "cell 5 0 6 0 6 1 5 1",
         3, 0},
        // Half of a room: the other half is filled.
        {BOX "cell 0 0 10 0 10 10 0 10", 2, 1},
        // Without area; by welding alone; turned round by welding.
        {BOX "cell 0 0 20 0 20 10 0 10\ncell 0 0 10 0 20 0", 1, 0},
        {BOX "snap 0.01\ncell 0 0 20 0 20 10 0 10\ncell 0 0 10 0.005 20 0", 3, 1},
        {"walls 0 -10 20 -10 20 10 0 10 0 -10\nsnap 0.5\ncell 0 -10 3 -10 3 -2 2 7 2 10 0 10\n"
         "cell 4 -2 2 7 4 -3\ncell 3 -10 20 -10 20 10 2 10 2 7 4 -3",
         6, 8},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0};
        sl_space space = {0};
        assert_ok(context, take(context, cases[i].text, &map, &space));
        assert_ok(context, sl_space_check(context, &space));
        if (space.cell_count != cases[i].cells || space.portal_count != cases[i].portals)
            fail_msg("%s: %u cells, %u portals", cases[i].text, space.cell_count,
                     space.portal_count);
        assert_within(&map, &space);
        const sl_box *b = &space.bounds;
        assert_float_equal(area_within(&space), (b->max.x - b->min.x) * (b->max.y - b->min.y),
                           1e-9);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

/// Beside cells a map may have whatever else maps have.
static void test_beside_cells(void **state) {
    (void)state;
    const char *text = BOX "snap 0.01\ndoor front 4.995 0 5 10 open\noneway 12 0 12 9.995\n"
                           "seam 14 5 20 5\nmirror 10 2 10 5\ncell 0 0 5 0 5 10 0 10\n"
                           "cell 5 0 10 0 10 10 5 10\ncell 10 0 20 0 20 10 10.005 10";
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    assert_ok(context, take(context, text, &map, &space));
    assert_ok(context, sl_space_check(context, &space));
    assert_within(&map, &space);
    size_t kinds[3] = {0};
    for (uint32_t i = 0; i < space.seam_portal_count; i++)
        kinds[space.seams[space.seam_portals[i].seam].kind]++;
    assert_true(kinds[SL_SEAM_DOOR] == 1 && kinds[SL_SEAM_ONEWAY] >= 1 &&
                kinds[SL_SEAM_PLAIN] == 1);
    bool walled = false; // the mirror
    for (uint32_t i = 0; i < space.wall_count; i++)
        walled |= space.walls[i].a.x == 10 && space.walls[i].b.x == 10;
    assert_true(walled);
    const uint32_t behind = sl_space_locate(&space, (sl_point){10.5, 3});
    assert_int_not_equal(behind, sl_space_locate(&space, (sl_point){9.5, 3}));
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// What cleaning has welded is as it was after another round.
static void test_clean_stays(void **state) {
    (void)state;
    const char *text = BOX "snap 0.01\nwall 3 0.004 7 9.997\ncell 0 0 10.002 0 10 10.003 0 10\n"
                           "cell 10 0 20 0 20 5 9.995 5\ncell 9.99 5 20 5 20 10 10 10\n"
                           "cell 1 0.003 2 0 3 0.002";
    sl_context *context = testing_context(NULL);
    sl_map once = {0}, twice = {0};
    sl_clean_account account;
    read_map(context, text, &once);
    assert_ok(context, sl_map_clean(context, &once, NULL, &account));
    assert_true(account.welded > 0 && account.largest_move > 0 && account.largest_move <= 0.02);
    assert_int_equal(once.cell_count, 4);
    assert_ok(context, sl_map_copy(context, &once, &twice));
    assert_ok(context, sl_map_clean(context, &twice, NULL, &account));
    assert_true(account.welded == 0 && account.largest_move == 0);
    assert_int_equal(twice.corner_count, once.corner_count);
    assert_memory_equal(twice.corners, once.corners, once.corner_count * sizeof *once.corners);
    assert_int_equal(twice.wall_count, once.wall_count);
    assert_memory_equal(twice.walls, once.walls, once.wall_count * sizeof *once.walls);
    sl_map_destroy(context, &once);
    sl_map_destroy(context, &twice);
    sl_context_destroy(context);
}

static void test_refused(void **state) {
    (void)state;
    const struct {
        const char *text, *message;
    } cases[] = {
        {BOX, "the map: the map brings no cells of its own"},
        {BOX "cell 0 0 10 0 20 0", "the map: the map's cells enclose no area"},
        {BOX "snap 2\ncell 4 4 5 4 5 5", "the map: the map brings no cells of its own"},
        {BOX "cell 0 0 8 0 8 10 0 10\ncell 8 0 12 0 12 10 8 10\ncell 11 0 20 0 20 10 11 10",
         "the map:5: cell 2 overlaps another one or itself near 11 "},
        // Inside of another one; on another one; by more than what is welded.
        {BOX "cell 0 0 20 0 20 10 0 10\ncell 5 5 6 5 6 6", "cell 1 overlaps another one"},
        {BOX "cell 0 0 20 0 20 10 0 10\ncell 0 0 0 10 20 10 20 0", "cell 0 overlaps another one"},
        {BOX "snap 0.01\ncell 0 0 10 0 10 10 0 10\ncell 9.9 0 20 0 20 10 10 10",
         "the map:4: cell 0 overlaps another one"},
        // Crossing itself, with areas that cancel or do not; winding twice.
        {"walls 0 0 20 0 20 10 0 10 0 0\ncell 0 0 20 0 0 10 20 10", "enclose no area"},
        {"walls 0 0 20 0 20 10 0 10 0 0\ncell 0 0 20 0 0 10 18 8", "the map:3: cell 0 overlaps"},
        {BOX "cell 0 0 20 0 20 10 0 10 0 0 10 0 10 5 0 5", "cell 0 overlaps another one or itself"},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0};
        sl_space space = {0};
        const sl_status status = take(context, cases[i].text, &map, &space);
        if (status != SL_BAD_INPUT || !strstr(sl_context_message(context), cases[i].message))
            fail_msg("%s: %s", cases[i].text, sl_context_message(context));
        assert_null(space.cells);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

// --- maps at random

/// The cells of a mesh, their corners rounded as a node builder's are. Some are clockwise, and some
/// are left out.
static void bring_cells(sl_context *context, const sl_space *space, double unit, sl_random *random,
                        sl_map *map) {
    sl_point corners[256];
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const sl_cell *cell = &space->cells[c];
        const bool clockwise = sl_random_below(random, 2), left_out = !sl_random_below(random, 8);
        assert_true(cell->vertex_count >= 3 && cell->vertex_count <= 256);
        for (uint32_t i = 0; i < cell->vertex_count; i++) {
            const uint32_t k = clockwise ? cell->vertex_count - 1 - i : i;
            const sl_point at = space->vertices[cell->first_vertex + k];
            corners[i] = (sl_point){round(at.x / unit) * unit, round(at.y / unit) * unit};
        }
        if (!left_out || map->cell_count == 0)
            assert_ok(context, sl_map_add_cell(context, map, corners, cell->vertex_count, 0));
    }
    map->snap = 2 * unit;
}

static int check_given(const drawn *d, sl_context *context, sl_map *map, sl_random *random) {
    sl_space given = {0};
    sl_visibility swept = {0}, searched = {0};
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
    assert_ok(context, sli_subdivide_given(context, map, &given));
    assert_ok(context, sl_space_check(context, &given));
    assert_within(map, &given);
    assert_int_equal(given.wall_count, map->wall_count);
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
    int checked = 0;
    for (int i = 0; i < MAPS; i++) {
        sl_context *context = testing_context(NULL);
        const drawn d = draw(&random, i % 4);
        sl_map map = {0};
        sl_space space = {0};
        for (int k = 0; k < d.count; k++)
            assert_ok(context, sl_map_add_wall(context, &map, scaled(d.a[k], 1, 0),
                                               scaled(d.b[k], 1, 0), 0));
        assert_ok(context, sli_subdivide_mesh(context, &map, &space));
        bring_cells(context, &space, i % 2 ? 0x1p-16 : 0.001, &random, &map);
        checked += check_given(&d, context, &map, &random);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
    assert_true(checked > 2 * MAPS);
}

/// What is no clean map, as callers of the library may have it, is welded all the same.
static void test_not_cleaned(void **state) {
    (void)state;
    const char *text = BOX "snap 0.01\ncell 0 0 10.002 0 10 9.997 0 10\n"
                           "cell 10 0 20 0 20 5 9.995 5\ncell 9.99 5 20 5 20 10 10 10";
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space cleaned = {0}, plain = {0};
    read_map(context, text, &map);
    assert_ok(context, sli_subdivide_given(context, &map, &plain));
    assert_ok(context, sl_space_check(context, &plain));
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    assert_ok(context, sli_subdivide_given(context, &map, &cleaned));
    assert_int_equal(plain.cell_count, cleaned.cell_count);
    assert_memory_equal(plain.vertices, cleaned.vertices,
                        plain.vertex_count * sizeof *plain.vertices);
    sl_space_destroy(context, &plain);
    sl_space_destroy(context, &cleaned);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Found by a fuzzer: all is one place, so that no edge is left.
static void test_welded_to_a_point(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    read_map(context, BOX "snap 5201\ncell 0 0 10 0 10 10\n", &map);
    assert_int_not_equal(sli_subdivide_given(context, &map, &space), SL_OK);
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    assert_true(map.wall_count == 0 && map.cell_count == 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Every allocation that fails is reported, and nothing is left behind.
static void test_lack_of_memory(void **state) {
    (void)state;
    const char *text = BOX "snap 0.01\ndoor front 5 0 5 10 open\ncell 0 0 10 0 10 10 0 10\n"
                           "cell 10 0 20 0 20 5 9.995 5\ncell 9.995 5 20 5 20 10 10 10";
    sl_status status = SL_NO_MEMORY;
    long fails = 0;
    for (long fail_at = 1; status != SL_OK; fail_at++, fails++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        sl_map map = {0};
        sl_space space = {0};
        read_map(context, text, &map);
        memory.fail_at = memory.calls + fail_at;
        status = sl_map_clean(context, &map, NULL, NULL);
        if (status == SL_OK) status = sli_subdivide_given(context, &map, &space);
        if (status != SL_OK) assert_int_equal(status, SL_NO_MEMORY);
        if (status != SL_OK) assert_null(space.cells);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
    }
    assert_true(fails > 40);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_taken),          cmocka_unit_test(test_beside_cells),
        cmocka_unit_test(test_clean_stays),    cmocka_unit_test(test_refused),
        cmocka_unit_test(test_random_walls),   cmocka_unit_test(test_not_cleaned),
        cmocka_unit_test(test_lack_of_memory), cmocka_unit_test(test_welded_to_a_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
