/// Edits of a world one by one: what they do, what they refuse, and what they leave as it was.
/// test_world.c compares worlds with spaces made anew.
#include "testing.h"

#include <math.h>
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
                                          SL_STOPS_LIMITED | SL_STOPS_SIGHT, &wall),
                     SL_BAD_ARGUMENT);
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

/// How much an eye sees by mirror.
static double area_mirrored(trial *t, sl_point eye, uint32_t *wall) {
    sl_mirrored_region region = {0};
    const sl_view view = sl_view_all_round(eye);
    assert_ok(t->context,
              sl_query_mirrored_region(t->context, sl_world_query(t->world), &view, &region));
    const double area = sl_mirrored_area(&region);
    *wall = region.part_count ? sl_world_mirror_wall(t->world, region.parts[0].mirror) : UINT32_MAX;
    sl_mirrored_region_destroy(t->context, &region);
    return area;
}

/// A room with a mirror that moves, turns and goes, and limited walls of which sight passes one.
static void test_mirrors_and_limited_walls_by_hand(void **state) {
    (void)state;
    const sl_point west = {1, 5}, east = {9, 5}, middle = {5, 5};
    trial t = {testing_context(NULL), NULL};
    sl_map map = {0}, copy = {0};
    uint32_t first = 1, mirror, one, other, seen;
    uint64_t cells[8];
    for (int i = 0; i < FRAME; i++) {
        static const sl_point corners[] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
        assert_ok(t.context, sl_map_add_wall(t.context, &map, corners[i], corners[i + 1], 0));
    }
    assert_ok(t.context, sl_map_add_mirror(t.context, &map, (sl_segment){{0, 4}, {0, 6}}, 7));
    sl_world_options options = sl_world_options_default();
    options.rows = SL_WORLD_ROWS_NOW;
    assert_ok(t.context, sl_world_create(t.context, &map, &options, &t.world));
    assert_int_equal(sl_world_kind_of(t.world, FRAME), SL_WORLD_MIRROR);
    // From 2 5 by the mirror at x = 0: as wide as far away from the image at -2 5, and no wider
    // than the room.
    const double all = area_mirrored(&t, (sl_point){2, 5}, &first);
    assert_true(fabs(all - 68) < 1e-9 && first == FRAME);
    assert_ok(t.context, sl_world_remove(t.context, t.world, FRAME));
    commit(&t);
    assert_true(area_mirrored(&t, (sl_point){2, 5}, &seen) == 0 && seen == UINT32_MAX);
    assert_int_equal(sl_world_mirror_wall(t.world, 0), UINT32_MAX);
    // One that reflects eastwards alone, for going from a to b the east is at its left.
    assert_ok(t.context,
              sl_world_add_mirror(t.context, t.world, (sl_segment){{5, 6}, {5, 4}}, true, &mirror));
    commit(&t);
    assert_true(area_mirrored(&t, east, &seen) > 1 && seen == mirror);
    assert_true(area_mirrored(&t, west, &seen) == 0);
    assert_false(sees(&t, west, east));
    assert_ok(t.context, sl_world_move(t.context, t.world, mirror, (sl_segment){{5, 4}, {5, 6}}));
    commit(&t);
    assert_true(area_mirrored(&t, east, &seen) == 0);
    assert_true(area_mirrored(&t, west, &seen) > 1);
    assert_ok(t.context, sl_world_copy_map(t.context, t.world, NULL, &copy));
    assert_true(copy.mirror_count == 1 && copy.mirrors[0].one_sided && copy.wall_count == FRAME);
    sl_map_destroy(t.context, &copy);
    // Sets by mirror are not kept, and said not to be.
    sl_query *query = sl_world_query(t.world);
    const sl_view view = sl_view_all_round(west);
    assert_true(sl_eye_words(sl_query_asked(query)) <= 8);
    assert_int_equal(sl_query_row(t.context, query, sl_query_locate(query, west), true, cells),
                     SL_UNSUPPORTED);
    assert_ok(t.context, sl_query_look_mirrored(t.context, query, &view, NULL, cells, NULL));
    assert_true(sl_eye_sees(cells, sl_query_locate(query, west)));
    assert_ok(t.context, sl_world_remove(t.context, t.world, mirror));
    // Limited walls: one is passed, two are not.
    assert_ok(t.context, sl_world_add_partial(t.context, t.world, (sl_segment){{3, 1}, {3, 9}},
                                              SL_STOPS_LIMITED, &one));
    commit(&t);
    assert_true(sees(&t, west, east));
    assert_int_equal(sl_world_visibility(t.world)->guarantee, SL_CONSERVATIVE);
    assert_ok(t.context, sl_world_add_partial(t.context, t.world, (sl_segment){{7, 1}, {7, 9}},
                                              SL_STOPS_LIMITED | SL_STOPS_STEPS, &other));
    commit(&t);
    assert_false(sees(&t, west, east));
    assert_true(sees(&t, west, middle) && sees(&t, middle, east));
    assert_ok(t.context, sl_world_copy_map(t.context, t.world, NULL, &copy));
    assert_int_equal(sl_map_limited_walls(&copy), 2);
    sl_map_destroy(t.context, &copy);
    assert_ok(t.context, sl_world_move(t.context, t.world, one, (sl_segment){{3, 1}, {3, 2}}));
    commit(&t);
    assert_true(sees(&t, west, east));
    assert_ok(t.context, sl_world_remove(t.context, t.world, one));
    assert_ok(t.context, sl_world_remove(t.context, t.world, other));
    commit(&t);
    assert_int_equal(sl_world_visibility(t.world)->guarantee, SL_EXACT);
    sl_map_destroy(t.context, &map);
    sl_world_destroy(t.context, t.world);
    sl_context_destroy(t.context);
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
        cmocka_unit_test(test_mirrors_and_limited_walls_by_hand),
        cmocka_unit_test(test_inside_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
