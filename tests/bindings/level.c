/// The handle of sightline_level owns what the runtime header leaves to its caller: doors, answers
/// that grow, boxes that outgrow their lists. Its answers are the header's.
#define SL_RUNTIME_API static inline
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "unit/runtime_maps.h"

#include "sightline_level.h"

typedef struct opened {
    sl_context *context;
    baked_file file;
    sl_level *level;
    unsigned char shut[8];
    uint32_t *scratch;
} opened;

static const char rooms[] = "walls 0 0 12 0 12 8 0 8 0 0\n"
                            "walls 6 0 6 3\nwalls 6 5 6 8\n"
                            "door gate 6 3 6 5 shut\n"
                            "start 2 4 90\n";

static int open_rooms(void **state) {
    opened *o = calloc(1, sizeof *o);
    o->context = sl_context_create(NULL);
    o->file = baked_file_of_text(o->context, rooms);
    o->level = sl_level_open(o->file.bytes, o->file.size);
    o->scratch = calloc(sl_runtime_scratch_count(&o->file.runtime), sizeof *o->scratch);
    assert_non_null(o->level);
    *state = o;
    return 0;
}

static int close_rooms(void **state) {
    opened *o = *state;
    sl_level_close(o->level);
    baked_file_destroy(o->context, &o->file);
    sl_context_destroy(o->context);
    free(o->scratch);
    free(o);
    return 0;
}

static void faults_are_told(void **state) {
    (void)state;
    assert_null(sl_level_open("nothing at all, and long enough for a header", 44));
    assert_string_equal(sl_level_error(), sl_runtime_status_text(SL_RUNTIME_NOT_BAKED));
    assert_null(sl_level_open_file("/nothing/at/all.slv"));
    assert_string_equal(sl_level_error(), "cannot be opened");
    sl_level_close(NULL);
}

static void numbers_of_nothing_answer_nothing(void **state) {
    const opened *o = *state;
    double start[3] = {7, 7, 7};
    int32_t count = 7;
    assert_int_equal(sl_level_locate(o->level, 99, 99), -1);
    for (int32_t wrong = -1; wrong < 1000; wrong += 1000) {
        assert_int_equal(sl_level_can_see(o->level, wrong, 0), 0);
        assert_int_equal(sl_level_can_see(o->level, 0, wrong), 0);
        assert_int_equal(sl_level_is_solid(o->level, wrong), 0);
        assert_null(sl_level_door_name(o->level, wrong));
        assert_int_equal(sl_level_door_is_open(o->level, wrong), 0);
        assert_null(sl_level_door_segments(o->level, wrong, &count));
        assert_int_equal(count, 0);
        assert_null(sl_level_cell_corners(o->level, wrong, &count));
        assert_int_equal(sl_level_start(o->level, wrong, start), 0);
        assert_float_equal(start[0], 7, 0);
        sl_level_set_door(o->level, wrong, 1);
        sl_level_move_box(o->level, wrong, 0, 0, 1, 1, 1);
    }
    assert_int_equal(sl_level_find_door(o->level, "moon", 0), -1);
    assert_int_equal(sl_level_find_door(o->level, "gate", 1), -1);
    assert_null(sl_level_boxes_seen(o->level, 2, 4, 0, 360, 0, &count));
    assert_int_equal(count, 0);
}

/// What the header answers with the same doors.
static void compare(opened *o, double x, double y, double heading, double fov, double range) {
    const double degree = 3.14159265358979323846 / 180;
    const sl_runtime *rt = &o->file.runtime;
    const sl_runtime_view view =
        fov >= 180 ? sl_runtime_view_all_round(x, y)
                   : sl_runtime_view_toward(x, y, cos(heading * degree), sin(heading * degree),
                                            tan(fov / 2 * degree));
    uint32_t cells[64];
    double points[512];
    int32_t count;
    const uint32_t seen = sl_runtime_look_past(rt, &view, o->shut, range, o->scratch, cells, 64);
    const int32_t *found = sl_level_look(o->level, x, y, heading, fov, range, &count);
    assert_int_equal(count, seen);
    assert_memory_equal(found, cells, seen * sizeof *cells);
    const uint32_t corners =
        sl_runtime_visible_polygon(rt, &view, o->shut, range, o->scratch, points, 256);
    const double *polygon = sl_level_visible_polygon(o->level, x, y, heading, fov, range, &count);
    assert_int_equal(count, corners);
    assert_true(corners > 2);
    assert_memory_equal(polygon, points, 2 * corners * sizeof *points);
}

static void answers_are_the_headers(void **state) {
    opened *o = *state;
    double start[3];
    assert_int_equal(sl_level_start_count(o->level), 1);
    assert_int_equal(sl_level_start(o->level, 0, start), 1);
    assert_float_equal(start[2], 90, 0);
    const int32_t door = sl_level_find_door(o->level, "gate", 0);
    assert_int_equal(door, 0);
    assert_string_equal(sl_level_door_name(o->level, door), "gate");
    int32_t areas[2] = {0};
    for (int open = 0; open < 2; open++) {
        assert_int_equal(sl_level_door_is_open(o->level, door), open);
        o->shut[0] = !open;
        assert_int_equal(sl_level_sees(o->level, 2, 4, 10, 4), open);
        assert_int_equal(sl_level_can_walk(o->level, 2, 4, 10, 4, -1), open);
        const int32_t near_cell = sl_level_locate(o->level, 2, 4);
        const int32_t far_cell = sl_level_locate(o->level, 10, 4);
        assert_int_equal(sl_level_can_see(o->level, near_cell, far_cell),
                         sl_runtime_can_see_past(&o->file.runtime, (uint32_t)near_cell,
                                                 (uint32_t)far_cell, o->shut));
        sl_level_look(o->level, 2, 4, 0, 360, 0, &areas[open]);
        compare(o, 2, 4, 0, 360, 0);
        compare(o, 2, 4, 30, 60, 0);
        compare(o, 2, 4, 30, 60, 3);
        compare(o, 2, 4, -170, 400, 2.5);
        sl_level_set_door(o->level, door, 1);
    }
    assert_true(areas[0] < areas[1]);
}

/// Walls break and are built once; what is exact after that is settled in steps.
static void walls_break(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 9 0 9 9 0 9 0 0\n"
                                               "door wall 3 0 3 3 breakable\n"
                                               "door wall 3 3 3 9 breakable\n"
                                               "door site 6 0 6 9 site\n");
    sl_level *level = sl_level_open(f.bytes, f.size);
    assert_non_null(level);
    const int32_t left = sl_level_locate(level, 1, 1), middle = sl_level_locate(level, 4, 1);
    const int32_t right = sl_level_locate(level, 8, 1);
    assert_int_equal(sl_level_door_kind(level, 0), 1);
    assert_int_equal(sl_level_door_kind(level, 2), 2);
    assert_int_equal(sl_level_door_kind(level, 3), -1);
    assert_true(sl_level_settle(level, -1) > 0);
    assert_int_equal(sl_level_settle(level, 100000), 0);
    assert_false(sl_level_can_see(level, left, middle));
    assert_true(sl_level_can_see(level, middle, right));
    assert_int_equal(sl_level_set_door(level, 1, 1), 1);
    assert_int_equal(sl_level_door_is_open(level, 0), 1); // of the same name
    assert_int_equal(sl_level_set_door(level, 0, 0), 0);
    assert_int_equal(sl_level_set_door(level, 2, 0), 1);
    assert_int_equal(sl_level_set_door(level, 2, 1), 0);
    assert_int_equal(sl_level_set_door(level, 3, 1), 0);
    assert_int_equal(sl_level_settle(level, 100000), 0);
    assert_true(sl_level_can_see(level, left, middle));
    assert_false(sl_level_can_see(level, left, right));
    sl_level_close(level);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Below 0 a field of view is the line of the heading, as 0 is; NaN and 360 or more are all round.
static void any_field_of_view_is_one(void **state) {
    opened *o = *state;
    const double fields[][2] = {{-60, 0},   {-180, 0},  {-400, 0},    {-INFINITY, 0},
                                {NAN, 360}, {360, 180}, {1e300, 180}, {INFINITY, 360}};
    int32_t cells[2], boxes;
    bool seen[2];
    sl_level_set_door(o->level, 0, 1);
    assert_int_equal(sl_level_set_box_count(o->level, 1), 1);
    sl_level_move_box(o->level, 0, 0.5, 3.5, 1, 4.5, 0); // behind the eye, which looks to the right
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        for (int k = 0; k < 2; k++) {
            sl_level_look(o->level, 2, 4, 0, fields[i][k], 0, &cells[k]);
            seen[k] = sl_level_boxes_seen(o->level, 2, 4, 0, fields[i][k], 0, &boxes)[0];
        }
        assert_int_equal(cells[0], cells[1]);
        assert_true(cells[0] > 0);
        assert_int_equal(seen[0], seen[1]);
        assert_int_equal(seen[0], fields[i][1] > 0);
    }
}

/// In pixels: 10 a unit, with y down from the upper left corner.
static void coordinates_are_chosen(void **state) {
    opened *o = *state;
    int32_t count, other;
    double start[3], bounds[4];
    const double *found = sl_level_visible_polygon(o->level, 2, 3, 30, 60, 2.5, &count);
    double *polygon = malloc(2 * (size_t)count * sizeof *polygon);
    memcpy(polygon, found, 2 * (size_t)count * sizeof *polygon);
    assert_int_equal(sl_level_set_box_count(o->level, 1), 1);
    assert_int_equal(sl_level_y_is_down(o->level), 0);
    sl_level_use_coordinates(o->level, 0, 8, 16, 1);
    assert_int_equal(sl_level_y_is_down(o->level), 1);
    sl_level_bounds(o->level, bounds);
    const double pixels[4] = {0, 0, 192, 128};
    assert_memory_equal(bounds, pixels, sizeof pixels);
    assert_int_equal(sl_level_start(o->level, 0, start), 1);
    assert_true(start[0] == 32 && start[1] == 64 && start[2] == -90);
    const double *turned = sl_level_visible_polygon(o->level, 32, 80, -30, 60, 40, &other);
    assert_int_equal(other, count);
    for (int32_t i = 0; i < count; i++) {
        assert_float_equal(turned[2 * i], 16 * polygon[2 * i], 1e-9);
        assert_float_equal(turned[2 * i + 1], 16 * (8 - polygon[2 * i + 1]), 1e-9);
    }
    free(polygon);
    const double *door = sl_level_door_segments(o->level, 0, &count);
    assert_int_equal(count, 1);
    assert_true(door[0] == 96 && door[1] == 80 && door[2] == 96 && door[3] == 48);
    sl_level_move_box(o->level, 0, 48, 48, 64, 80, 1); // between both points
    assert_int_equal(sl_level_sees(o->level, 16, 64, 80, 64), 0);
    assert_int_equal(sl_level_sees(o->level, 16, 112, 80, 112), 1);
    assert_int_equal(sl_level_can_walk(o->level, 16, 64, 80, 64, -1), 0);
    assert_int_equal(sl_level_boxes_seen(o->level, 16, 64, 0, 360, 0, &count)[0], 1);
    assert_int_equal(sl_level_boxes_seen(o->level, 16, 64, 180, 90, 0, &count)[0], 0);
    assert_true(sl_level_locate(o->level, 16, 64) >= 0 && sl_level_locate(o->level, 16, -1) < 0);
}

static void discs_walk_and_servers_ask(void **state) {
    const opened *o = *state;
    const double player[4] = {1.5, 3.5, 2.5, 4.5};
    const double things[12] = {3, 3, 3.5, 3.5, 9, 3.5, 10, 4.5, 9, 7.3, 9.5, 7.8};
    double at[2];
    for (int32_t open = 0; open < 2; open++) {
        sl_level_set_door(o->level, 0, open);
        assert_int_equal(sl_level_walk(o->level, 2, 4, 10, 4, 0.5, -1, at), open);
        assert_float_equal(at[0], open ? 10 : 5.5, 1e-6);
        assert_float_equal(at[1], 4, 1e-6);
        const unsigned char *bits = sl_level_relevant(o->level, player, 1, 0.25, things, 3);
        assert_int_equal(bits[0], open ? 3 : 1); // the third is in a corner behind the wall
    }
    sl_level_use_coordinates(o->level, 0, 8, 16, 1);
    assert_int_equal(sl_level_walk(o->level, 32, 64, 160, 64, 8, -1, at), 1);
    assert_true(at[0] == 160 && at[1] == 64);
    const double pixels[8] = {24, 56, 40, 72, 144, 56, 160, 72};
    assert_int_equal(sl_level_relevant(o->level, pixels, 1, 4, pixels + 4, 1)[0], 1);
    assert_non_null(sl_level_relevant(o->level, pixels, 0, 4, pixels, -1));
}

static void boxes_outgrow_their_lists(void **state) {
    enum { BOXES = 3 };
    opened *o = *state;
    int32_t count;
    assert_int_equal(sl_level_set_box_count(o->level, BOXES), 1);
    // Each in all cells: more pairs than there is room for at first, in a map of many cells.
    for (int round = 0; round < 2; round++) {
        sl_level_move_box(o->level, 0, 3, 3, 4, 5, 1);       // hides
        sl_level_move_box(o->level, 1, 4.5, 3.9, 5, 4.1, 0); // behind it
        sl_level_move_box(o->level, 2, 0, 0, 12, 8, 0);      // everywhere
        const unsigned char *seen = sl_level_boxes_seen(o->level, 1, 4, 0, 360, 0, &count);
        assert_int_equal(count, BOXES);
        assert_int_equal(seen[0], 1);
        assert_int_equal(seen[1], 0);
        assert_int_equal(seen[2], 1);
        assert_int_equal(sl_level_sees(o->level, 1, 4, 4.7, 4), 0);
        assert_int_equal(sl_level_can_walk(o->level, 1, 4, 4.7, 4, -1), 0);
        assert_int_equal(sl_level_can_walk(o->level, 1, 4, 4.7, 4, 0), 1);
    }
    sl_level_move_box(o->level, 0, 3, 7, 4, 8, 1);
    assert_int_equal(sl_level_boxes_seen(o->level, 1, 4, 0, 360, 0, &count)[1], 1);
    assert_int_equal(sl_level_set_box_count(o->level, 0), 1);
    assert_null(sl_level_boxes_seen(o->level, 1, 4, 0, 360, 0, &count));
}

/// One box that is in each of many cells.
static void a_box_in_all_cells(void **state) {
    (void)state;
    sl_context *context = sl_context_create(NULL);
    char text[1024] = "walls 0 0 40 0 40 4 0 4 0 0\n";
    for (int i = 1; i < 20; i++) {
        char wall[64];
        snprintf(wall, sizeof wall, "wall %d 0 %d 3\n", 2 * i, 2 * i);
        strcat(text, wall);
    }
    baked_file file = baked_file_of_text(context, text);
    sl_level *level = sl_level_open(file.bytes, file.size);
    assert_true(sl_level_cell_count(level) > 16);
    assert_int_equal(sl_level_set_box_count(level, 2), 1);
    sl_level_move_box(level, 1, 0.5, 1, 0.6, 1.1, 0);
    sl_level_move_box(level, 0, 0, 0.5, 40, 0.6, 0);
    int32_t count;
    // Without room for its pairs a box would be seen from everywhere: the second one is not.
    assert_int_equal(sl_level_boxes_seen(level, 39, 1, 0, 360, 0, &count)[0], 1);
    assert_int_equal(sl_level_boxes_seen(level, 39, 1, 0, 360, 0, &count)[1], 0);
    sl_level_move_box(level, 0, 0.2, 0.5, 0.3, 0.6, 0);
    assert_int_equal(sl_level_boxes_seen(level, 39, 1, 0, 360, 0, &count)[0], 0);
    sl_level_close(level);
    baked_file_destroy(context, &file);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faults_are_told),
        cmocka_unit_test_setup_teardown(numbers_of_nothing_answer_nothing, open_rooms, close_rooms),
        cmocka_unit_test_setup_teardown(answers_are_the_headers, open_rooms, close_rooms),
        cmocka_unit_test(walls_break),
        cmocka_unit_test_setup_teardown(any_field_of_view_is_one, open_rooms, close_rooms),
        cmocka_unit_test_setup_teardown(coordinates_are_chosen, open_rooms, close_rooms),
        cmocka_unit_test_setup_teardown(discs_walk_and_servers_ask, open_rooms, close_rooms),
        cmocka_unit_test_setup_teardown(boxes_outgrow_their_lists, open_rooms, close_rooms),
        cmocka_unit_test(a_box_in_all_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
