/// The kd-tree, portals, point location, inside and outside, the whole-graph check.
#include "testing.h"

#include "sightline/support.h"
#include "space/subdivide.h"

#include <math.h>

/// A box of 20 x 10 with a wall across that leaves a gap at y 4 .. 6.
static const char *two_rooms = "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n";

static void two_rooms_are_joined_by_one_portal(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context, two_rooms, &map, &space);
    assert_int_equal(space.cell_count, 2);
    assert_int_equal(space.portal_count, 1);
    assert_int_equal(space.directed_count, 2);
    assert_int_equal(space.inside_count, 2);
    const sl_portal *p = &space.portals[0];
    assert_true(p->left.x == 10 && p->left.y == 6 && p->right.x == 10 && p->right.y == 4);
    const sl_directed_portal *back = &space.directed[space.cells[1].first_directed];
    assert_true(back->cell == 0 && back->left.y == 4 && back->right.y == 6);
    assert_true(sl_space_area(&space, 0) == 100 && sl_space_area(&space, 1) == 100);
    assert_ok(context, sl_space_check(context, &space));
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void the_middle_of_a_far_cell_is_in_it(void **state) {
    (void)state;
    const double at = 1e15 + 1, step = nextafter(at, INFINITY) - at;
    sl_point corners[] = {{at, at}, {at + 3 * step, at}, {at, at + 3 * step}};
    sl_cell cell = {.vertex_count = 3};
    const sl_space space = {.cells = &cell, .cell_count = 1, .vertices = corners};
    const sl_point middle = sl_space_middle(&space, 0);
    assert_true(middle.x == at + step && middle.y == at + step);
}

static void points_on_boundaries_have_a_cell(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context, two_rooms, &map, &space);
    const struct {
        double x, y;
        uint32_t cell;
    } cases[] = {{5, 5, 0},
                 {15, 5, 1},
                 {10, 5, 1},
                 {10, 0, 1},
                 {0, 0, 0},
                 {20, 10, 1},
                 {20, 5, 1},
                 {nextafter(10, 0), 5, 0},
                 {-1, 5, SL_NO_CELL},
                 {5, 11, SL_NO_CELL},
                 {NAN, 5, SL_NO_CELL},
                 {5, NAN, SL_NO_CELL},
                 {INFINITY, 5, SL_NO_CELL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(sl_space_locate(&space, (sl_point){cases[i].x, cases[i].y}),
                         cases[i].cell);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void starts_or_the_border_tell_inside_from_outside(void **state) {
    (void)state;
    const struct {
        const char *map;
        uint32_t inside, cells;
    } cases[] = {
        // An L: the missing quarter of the bounds is outside.
        {"walls 0 0 4 0 4 2 2 2 2 4 0 4 0 0\n", 2, 3},
        // The same with a start in the missing quarter.
        {"walls 0 0 4 0 4 2 2 2 2 4 0 4 0 0\nstart 3 3 0\n", 1, 3},
        // A closed pillar in a closed room: without a start only what the border reaches is
        // outside.
        {"walls 0 0 9 0 9 9 0 9 0 0\nwalls 3 3 6 3 6 6 3 6 3 3\n", 5, 5},
        {"walls 0 0 9 0 9 9 0 9 0 0\nwalls 3 3 6 3 6 6 3 6 3 3\nstart 1 1 0\n", 4, 5},
        // Nothing encloses anything: all is inside.
        {"wall 0 0 4 0\nwall 0 1 0 4\n", 1, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        sl_space space;
        testing_space(context, cases[i].map, &map, &space);
        assert_int_equal(space.cell_count, cases[i].cells);
        assert_int_equal(space.inside_count, cases[i].inside);
        assert_ok(context, sl_space_check(context, &space));
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

static void an_oblique_wall_is_named(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){0, 0}, (sl_point){1, 0}, 7));
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){0, 0}, (sl_point){2, 3}, 8));
    const sl_subdivide_options options = sl_subdivide_options_default();
    sl_space space;
    assert_int_equal(sli_subdivide_kd(context, &map, &options, &space), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "the map:8: "));
    assert_non_null(strstr(sl_context_message(context), "0 0 to 2 3"));
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void walls_that_overlap_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){0, 0}, (sl_point){2, 0}, 1));
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){1, 0}, (sl_point){3, 0}, 2));
    const sl_subdivide_options options = sl_subdivide_options_default();
    sl_space space;
    assert_int_equal(sli_subdivide_kd(context, &map, &options, &space), SL_BAD_INPUT);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Walls on a grid, crossing, touching and overlapping at will; `scale` and `shift` are exact.
static void random_walls(sl_context *context, sl_random *random, double scale, double shift,
                         sl_map *map) {
    const size_t count = 1 + sl_random_below(random, 30);
    for (size_t i = 0; i < count; i++) {
        const double x = (double)sl_random_below(random, 12) * scale + shift;
        const double y = (double)sl_random_below(random, 12) * scale + shift;
        const double length = (double)sl_random_below(random, 7) * scale;
        const bool vertical = sl_random_below(random, 2);
        const sl_point end = {vertical ? x : x + length, vertical ? y + length : y};
        assert_ok(context, sl_map_add_wall(context, map, (sl_point){x, y}, end, 0));
    }
}

static sl_subdivide_options options_of(unsigned number) {
    return (sl_subdivide_options){.spanning = number & 1,
                                  .obscured = number & 2 ? 0.5 : 0,
                                  .cleaving = number & 4,
                                  .median = number & 8};
}

static void random_maps_pass_the_check_by_any_rules(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p-400, 0x1p400, 1, 0x1p-20};
    const double shifts[] = {0, 0, 0, 0x1p40, -0x1p30};
    sl_random random = {2};
    for (unsigned round = 0; round < 1000; round++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        random_walls(context, &random, scales[round % 5], shifts[round % 5], &map);
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        const sl_subdivide_options options = options_of(round / 5 % 16);
        sl_space space = {0};
        const sl_status status = sli_subdivide_kd(context, &map, &options, &space);
        if (map.wall_count) {
            assert_ok(context, status);
            assert_ok(context, sl_space_check(context, &space));
        } else
            assert_int_equal(status, SL_BAD_INPUT);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

static sl_wall *inner_wall(sl_space *space) {
    sl_wall *wall = space->walls;
    while (wall->a.x != 10 || wall->b.x != 10) wall++;
    return wall;
}

/// Each damage does one thing to a good space that the check must find.
static void damage(sl_space *space, unsigned number) {
    sl_wall *wall;
    switch (number) {
    case 0:
        space->nodes[0].position = 30;
        break;
    case 1:
        space->nodes[0].below = 0;
        break;
    case 2:
        space->nodes[0].below = space->nodes[0].above;
        break;
    case 3:
        space->nodes[0].axis = 2;
        break;
    case 4:
        space->vertices[0].x -= 1;
        break;
    case 5:
        space->portals[0].left.y -= 1;
        break;
    case 6:
        space->directed[0].left.y -= 0.5;
        break;
    case 7:
        space->directed[0].cell = space->cell_count;
        break;
    case 8:
        space->directed[0].portal = space->portal_count;
        break;
    case 9:
        space->cells[0].directed_count++;
        break;
    case 10:
        space->cells[0].first_directed = 1;
        break;
    case 11:
        space->cells[0].inside = 0;
        break;
    case 12:
        space->inside_count--;
        break;
    case 13:
        space->walls[0].b.y = NAN;
        break;
    case 14:
        space->root = -9;
        break;
    case 15:
        space->bounds.max.x = NAN;
        break;
    case 16: // a boundary that is neither wall nor portal
        *inner_wall(space) = space->walls[space->wall_count - 1];
        space->wall_count--;
        break;
    case 17:
        space->directed_count--;
        break;
    case 18:
        space->cells[1].first_vertex = UINT32_MAX;
        break;
    case 19:
        space->portals[0].cell[1] = UINT32_MAX;
        break;
    case 20: // a wall through a cell
        wall = inner_wall(space);
        wall->a.x = wall->b.x = 11;
        break;
    default:
        fail_msg("no damage %u", number);
    }
}

static void the_check_finds_damage(void **state) {
    (void)state;
    for (unsigned number = 0; number <= 20; number++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        sl_space space;
        testing_space(context, two_rooms, &map, &space);
        damage(&space, number);
        if (sl_space_check(context, &space) != SL_BAD_INPUT) fail_msg("damage %u passes", number);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

static void memory_may_fail_at_any_call(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {3};
    sl_map map = {0};
    random_walls(context, &random, 1, 0, &map);
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status == SL_NO_MEMORY; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        sl_space space = {0};
        status = sli_subdivide_kd(context, &map, &options, &space);
        if (status == SL_OK) status = sl_space_check(context, &space);
        sl_space_destroy(context, &space);
        assert_int_equal(memory.live, before);
        assert_true(at < 100000);
    }
    assert_int_equal(status, SL_OK);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_rooms_are_joined_by_one_portal),
        cmocka_unit_test(the_middle_of_a_far_cell_is_in_it),
        cmocka_unit_test(points_on_boundaries_have_a_cell),
        cmocka_unit_test(starts_or_the_border_tell_inside_from_outside),
        cmocka_unit_test(an_oblique_wall_is_named),
        cmocka_unit_test(walls_that_overlap_are_refused),
        cmocka_unit_test(random_maps_pass_the_check_by_any_rules),
        cmocka_unit_test(the_check_finds_damage),
        cmocka_unit_test(memory_may_fail_at_any_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
