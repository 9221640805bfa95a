/// Edits of a world one by one: what they do, what they refuse, and what they leave as it was.
/// test_world.c compares worlds with spaces made anew.
#include "testing.h"

#include <string.h>

enum { FRAME = 4 };

typedef struct trial {
    sl_context *context;
    sl_world *world;
} trial;

static bool sees(trial *t, sl_point eye, sl_point point) {
    bool out;
    assert_ok(t->context, sl_query_sees(t->context, sl_world_query(t->world), eye, point, &out));
    return out;
}

static void test_edits_by_hand(void **state) {
    (void)state;
    const sl_point west = {1, 5}, east = {9, 5};
    trial t = {testing_context(NULL), NULL};
    sl_map map = {0};
    sl_space space;
    sl_map given;
    sl_query *copy;
    sl_world_changes changes;
    sl_segment at;
    uint32_t wall, other;
    testing_space(t.context, "wall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n",
                  &given, &space);
    for (size_t i = 0; i < given.wall_count; i++)
        assert_ok(t.context,
                  sl_map_add_wall(t.context, &map, given.walls[i].a, given.walls[i].b, 0));
    assert_ok(t.context, sl_world_create(t.context, &map, NULL, &t.world));
    assert_true(sees(&t, west, east));
    at = (sl_segment){{5, 2}, {5, 8}};
    assert_ok(t.context, sl_world_add_wall(t.context, t.world, at, &wall));
    assert_int_equal(wall, FRAME);
    assert_true(sees(&t, west, east)); // not before the commit
    assert_ok(t.context, sl_world_commit(t.context, t.world, &changes));
    assert_false(sees(&t, west, east));
    assert_true(changes.gone_count && changes.came_count);
    // A wall across it, and the first one goes and comes back.
    assert_ok(t.context,
              sl_world_add_wall(t.context, t.world, (sl_segment){{2, 3}, {8, 7}}, &other));
    assert_ok(t.context, sl_world_commit(t.context, t.world, NULL));
    assert_ok(t.context, sl_world_remove(t.context, t.world, other));
    assert_ok(t.context, sl_world_move(t.context, t.world, wall, (sl_segment){{5, 6}, {5, 8}}));
    assert_ok(t.context, sl_world_commit(t.context, t.world, NULL));
    assert_true(sees(&t, west, east));
    assert_ok(t.context, sl_world_move(t.context, t.world, wall, at));
    assert_ok(t.context, sl_world_commit(t.context, t.world, NULL));
    assert_false(sees(&t, west, east));
    assert_true(sl_world_wall(t.world, wall, &at) && at.b.y == 8);
    assert_false(sl_world_wall(t.world, other, &at));
    // What is forgotten changes nothing.
    assert_ok(t.context, sl_world_remove(t.context, t.world, wall));
    sl_world_discard(t.world);
    assert_ok(t.context, sl_world_commit(t.context, t.world, &changes));
    assert_true(!changes.gone_count && !changes.came_count);
    assert_false(sees(&t, west, east));
    // What is no wall is refused.
    assert_int_equal(sl_world_remove(t.context, t.world, other), SL_BAD_ARGUMENT);
    assert_int_equal(sl_world_add_wall(t.context, t.world, (sl_segment){{1, 1}, {1, 1}}, &other),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_world_move(t.context, t.world, wall, (sl_segment){{1, 1}, {1, 99}}),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_query_copy(t.context, sl_world_query(t.world), &copy), SL_UNSUPPORTED);
    sl_space_destroy(t.context, &space);
    sl_map_destroy(t.context, &given);
    sl_map_destroy(t.context, &map);
    sl_world_destroy(t.context, t.world);
    sl_context_destroy(t.context);
}

static void commit(trial *t) {
    assert_ok(t->context, sl_world_commit(t->context, t->world, NULL));
}

/// The area of a copy's cells that are solid.
static double solid_area(trial *t) {
    sl_space space = {0};
    double area = 0;
    assert_ok(t->context, sl_world_copy_space(t->context, t->world, NULL, &space));
    for (uint32_t c = 0; c < space.cell_count; c++)
        if (space.cells[c].solid) area += sl_space_area(&space, c);
    sl_space_destroy(t->context, &space);
    return area;
}

/// A room with a wall across, in which a door, glass and a low wall stand one after the other.
static void test_effects_by_hand(void **state) {
    (void)state;
    const sl_point west = {1, 5}, east = {9, 5};
    const sl_point crate[] = {{7, 4}, {8, 4}, {8, 6}, {7, 6}};
    trial t = {testing_context(NULL), NULL};
    sl_map map = {0}, copy = {0};
    sl_space space;
    uint32_t door = 4, glass, low, wall, sides[4];
    testing_space(t.context,
                  "wall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"
                  "wall 5 0 5 4\nwall 5 6 5 10\ndoor gate 5 4 5 6 shut\n",
                  &map, &space);
    assert_ok(t.context, sl_world_create(t.context, &map, NULL, &t.world));
    door = (uint32_t)map.wall_count;
    assert_int_equal(sl_world_kind_of(t.world, door), SL_WORLD_DOOR);
    assert_false(sl_world_is_open(t.world, door));
    assert_false(sees(&t, west, east));
    assert_ok(t.context, sl_world_set_open(t.context, t.world, door, true));
    assert_false(sees(&t, west, east)); // not before the commit
    commit(&t);
    assert_true(sees(&t, west, east) && sl_world_is_open(t.world, door));
    assert_int_equal(sl_world_set_open(t.context, t.world, 0, true), SL_BAD_ARGUMENT);
    // Glass that is seen through from its right to its left, so from the east.
    assert_ok(t.context,
              sl_world_add_oneway(t.context, t.world, (sl_segment){{5, 4}, {5, 6}}, &glass));
    commit(&t);
    assert_true(sees(&t, east, west));
    assert_false(sees(&t, west, east));
    assert_ok(t.context, sl_world_move(t.context, t.world, glass, (sl_segment){{5, 6}, {5, 4}}));
    commit(&t);
    assert_false(sees(&t, east, west));
    assert_true(sees(&t, west, east));
    assert_ok(t.context, sl_world_remove(t.context, t.world, glass));
    // A low wall stops steps alone.
    assert_ok(t.context, sl_world_add_partial(t.context, t.world, (sl_segment){{5, 4}, {5, 6}},
                                              SL_STOPS_STEPS, &low));
    commit(&t);
    assert_true(sees(&t, west, east) && sees(&t, east, west));
    assert_int_equal(sl_world_add_partial(t.context, t.world, (sl_segment){{5, 4}, {5, 6}},
                                          SL_STOPS_LIMITED, &wall),
                     SL_UNSUPPORTED);
    // Solid ground, and its walls gone.
    assert_ok(t.context, sl_world_add_solid(t.context, t.world, crate, 4, sides));
    commit(&t);
    assert_false(sees(&t, west, east));
    assert_true(solid_area(&t) == 2);
    assert_ok(t.context, sl_world_copy_map(t.context, t.world, NULL, &copy));
    assert_true(copy.door_count == 1 && copy.doors[0].open && copy.seam_count == 1);
    assert_true(copy.seams[0].stops == SL_STOPS_STEPS && copy.oneway_count == 0);
    sl_map_destroy(t.context, &copy);
    for (int i = 0; i < 4; i++) assert_ok(t.context, sl_world_remove(t.context, t.world, sides[i]));
    commit(&t);
    assert_true(sees(&t, west, east) && solid_area(&t) == 0);
    // A polygon that is refused leaves nothing.
    assert_int_equal(
        sl_world_add_solid(t.context, t.world, (sl_point[]){{7, 4}, {8, 4}, {99, 6}}, 3, sides),
        SL_BAD_ARGUMENT);
    commit(&t);
    assert_true(sees(&t, west, east));
    // Mirrors are refused by name.
    sl_world *other;
    assert_ok(t.context, sl_map_add_mirror(t.context, &map, (sl_segment){{1, 1}, {2, 1}}, 0));
    assert_int_equal(sl_world_create(t.context, &map, NULL, &other), SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(t.context), "mirrors"));
    sl_space_destroy(t.context, &space);
    sl_map_destroy(t.context, &map);
    sl_world_destroy(t.context, t.world);
    sl_context_destroy(t.context);
}

/// How much an eye sees.
static double area_seen(trial *t, sl_point eye) {
    sl_region region = {0};
    const sl_view view = sl_view_all_round(eye);
    assert_ok(t->context, sl_query_region(t->context, sl_world_query(t->world), &view, &region));
    const double area = sl_region_area(&region);
    sl_region_destroy(t->context, &region);
    return area;
}

/// Eyes on the outline of a room look into it, also after edits within and beyond.
static void test_inside_by_hand(void **state) {
    (void)state;
    static const sl_point eyes[] = {{3, 0}, {10, 7}, {6, 10}, {0, 2}};
    trial t = {testing_context(NULL), NULL};
    sl_map map = {0};
    sl_world_options options = sl_world_options_default();
    uint32_t within, beyond;
    options.bounds = (sl_box){{-9, -9}, {19, 19}};
    for (int i = 0; i < FRAME; i++) {
        static const sl_point corners[] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
        assert_ok(t.context, sl_map_add_wall(t.context, &map, corners[i], corners[i + 1], 0));
    }
    assert_ok(t.context, sl_world_create(t.context, &map, &options, &t.world));
    assert_ok(t.context, sl_world_mark_inside(t.context, t.world));
    for (int i = 0; i < FRAME; i++) assert_true(area_seen(&t, eyes[i]) == 100);
    assert_ok(t.context,
              sl_world_add_wall(t.context, t.world, (sl_segment){{4, 4}, {6, 7}}, &within));
    assert_ok(t.context,
              sl_world_add_wall(t.context, t.world, (sl_segment){{-5, 3}, {-2, 14}}, &beyond));
    commit(&t);
    assert_ok(t.context, sl_world_remove(t.context, t.world, within));
    commit(&t);
    assert_ok(t.context, sl_world_move(t.context, t.world, beyond, (sl_segment){{3, -4}, {7, -2}}));
    commit(&t);
    for (int i = 0; i < FRAME; i++) assert_true(area_seen(&t, eyes[i]) == 100);
    // Without a wall there is no inside, and both sides count.
    assert_ok(t.context, sl_world_remove(t.context, t.world, 0));
    commit(&t);
    assert_ok(t.context, sl_world_mark_inside(t.context, t.world));
    const sl_space *space = sl_query_asked(sl_world_query(t.world));
    assert_int_equal(space->inside_count, sl_world_cell_count(t.world));
    sl_map_destroy(t.context, &map);
    sl_world_destroy(t.context, t.world);
    sl_context_destroy(t.context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edits_by_hand),
        cmocka_unit_test(test_effects_by_hand),
        cmocka_unit_test(test_inside_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
