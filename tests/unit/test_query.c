/// The façade: a map is baked as its stages do one by one, and a query of it, or of its file, takes
/// settings and refuses wrong ones. What it answers is in test_query_matrix.c.
#include "testing.h"

#include "map/scan.h"

#include <math.h>

// Three rooms in a row and one above: a door, one-way glass, and gaps.
static const char rooms[] = "sightline 1\n"
                            "walls 0 0 30 0 30 20 0 20 0 0\n"
                            "wall 10 0 10 3\nwall 10 5 10 10\n"
                            "wall 20 0 20 3\nwall 20 5 20 10\n"
                            "wall 0 10 4 10\nwall 6 10 30 10\n"
                            "start 5 5 0\n";
static const char door[] = "door west 10 3 10 5 open\n";
static const char glass[] = "oneway 20 3 20 5\n"; // seen through from the right to the left
static const sl_moving_box box = {{{3, 6}, {7, 8}}, true};

static void read_map(sl_context *context, const char *const *parts, sl_map *map) {
    char text[1024] = "";
    for (size_t i = 0; parts[i]; i++) strcat(text, parts[i]);
    assert_ok(context, sli_map_read_text(context, "rooms", text, strlen(text), map));
}

static void bake(sl_context *context, const char *const *parts, sl_baked *baked) {
    sl_map map = {0};
    read_map(context, parts, &map);
    assert_ok(context, sl_bake(context, &map, NULL, baked, NULL));
    assert_int_equal(map.wall_count + map.start_count, 0);
}

static void a_file_answers_as_memory_does(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *const parts[] = {rooms, door, glass, NULL};
    char path[] = "/tmp/test_query_XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    sl_baked baked = {0};
    sl_query *query, *opened;
    bake(context, parts, &baked);
    assert_ok(context, sl_baked_write(context, &baked, path));
    assert_ok(context, sl_query_create(context, &baked, &query));
    assert_ok(context, sl_query_open(context, path, &opened));
    assert_true(sl_baked_same_space(&baked.space, sl_query_asked(opened)));
    bool sees;
    const uint32_t from = sl_query_locate(opened, (sl_point){5, 5});
    const uint32_t to = sl_query_locate(opened, (sl_point){15, 4});
    assert_ok(context, sl_query_can_see(context, opened, from, to, &sees));
    assert_true(sees);
    sl_query_set_doors(context, opened, false);
    assert_ok(context, sl_query_can_see(context, opened, from, to, &sees));
    assert_false(sees);
    assert_int_equal(sl_query_can_see(context, opened, from, 4000, &sees), SL_BAD_ARGUMENT);
    sl_query_destroy(context, opened);
    sl_query_destroy(context, query);
    assert_int_equal(sl_query_open(context, "no such file.slv", &opened), SL_BAD_ARGUMENT);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    assert_int_equal(remove(path), 0);
}

/// A ray ends at the door where it is shut, and in the next room where it is open.
static void rays_meet_what_stands(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *const parts[] = {rooms, door, NULL};
    sl_baked baked = {0};
    sl_query *query;
    bake(context, parts, &baked);
    assert_ok(context, sl_query_create(context, &baked, &query));
    for (int open = 0; open < 2; open++) {
        const sl_space *space;
        sl_hit hit;
        sl_query_set_doors(context, query, open);
        assert_ok(context, sl_query_prepare(context, query));
        assert_ok(context, sl_query_cast(context, query, (sl_point){5, 4}, (sl_point){6, 4}, &hit));
        assert_float_equal(hit.point.x, open ? 30 : 10, 0);
        assert_float_equal(hit.point.y, 4, 0);
        assert_ok(context, sl_query_space(context, query, &space, NULL));
        assert_true(hit.wall < space->wall_count);
        assert_true((hit.wall < sl_query_asked(query)->wall_count) == open);
    }
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void mirrors_show_what_the_depth_allows(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const char text[] = "sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 6\n"
                               "wall 10 8 10 10\n"
                               "mirror 4 10 16 10\ndoor out 10 6 10 8 open\n";
    const char *const parts[] = {text, NULL};
    sl_baked baked = {0};
    sl_query *query;
    bake(context, parts, &baked);
    assert_string_equal(baked.method, "sweep");
    assert_ok(context, sl_query_create(context, &baked, &query));
    const sl_view view = sl_query_view(query, (sl_point){5, 1}, 0, 360);
    uint64_t cells[8];
    sl_mirrored_region region = {0};
    sl_eye_account account;
    assert_true(sl_eye_words(&baked.space) <= 8);
    assert_ok(context, sl_query_look_mirrored(context, query, &view, NULL, cells, &account));
    assert_true(sl_eye_sees(cells, sl_query_locate(query, (sl_point){15, 1})));
    assert_ok(context, sl_query_mirrored_region(context, query, &view, &region));
    assert_true(region.part_count > 0);
    sl_mirrored_region other = {0};
    assert_ok(context, sl_query_mirrored_region_to(context, query, &view, 0, &other));
    assert_int_equal(other.part_count, 0);
    assert_ok(context, sl_query_mirrored_region_to(context, query, &view, 1, &other));
    assert_int_equal(other.part_count, region.part_count);
    assert_true(sl_mirrored_area(&other) == sl_mirrored_area(&region));
    sl_mirrored_region_destroy(context, &other);
    assert_ok(context, sl_query_set_mirror_depth(context, query, 0));
    assert_ok(context, sl_query_look_mirrored(context, query, &view, NULL, cells, NULL));
    assert_int_equal(cells[0], 0);
    assert_int_equal(sl_query_set_mirror_depth(context, query, 17), SL_BAD_ARGUMENT);
    assert_ok(context, sl_query_set_mirror_depth(context, query, 1));
    const sl_eye_method *loosest = sl_eye_methods(&(size_t){0});
    for (int open = 0; open < 2; open++) {
        const uint32_t behind = sl_query_locate(query, (sl_point){15, 1});
        sl_query_set_doors(context, query, open);
        for (int exact = 0; exact < 2; exact++) {
            assert_ok(context, sl_query_look_mirrored(context, query, &view, exact ? NULL : loosest,
                                                      cells, NULL));
            assert_int_equal(sl_eye_sees(cells, behind), open);
        }
    }
    sl_mirrored_region_destroy(context, &region);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void boxes_are_seen_and_wrong_settings_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *const parts[] = {rooms, door, NULL};
    sl_baked baked = {0};
    sl_query *query;
    bake(context, parts, &baked);
    assert_ok(context, sl_query_create(context, &baked, &query));
    const sl_moving_box boxes[] = {{{{12, 3}, {13, 4}}, false}, {{{22, 12}, {23, 13}}, false}};
    const sl_view view = sl_query_view(query, (sl_point){5, 4}, 0, 60);
    bool seen[2];
    assert_ok(context, sl_query_set_boxes(context, query, boxes, 2));
    assert_ok(context, sl_query_boxes_seen(context, query, &view, seen, NULL));
    assert_true(seen[0]);
    assert_false(seen[1]);
    assert_ok(context, sl_query_set_door(context, query, "west", false));
    assert_ok(context, sl_query_boxes_seen(context, query, &view, seen, NULL));
    assert_false(seen[0]);
    assert_int_equal(sl_query_set_door(context, query, "east", true), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(context), "west"));
    assert_int_equal(sl_query_set_range(context, query, -1), SL_BAD_ARGUMENT);
    assert_int_equal(sl_query_set_range(context, query, NAN), SL_BAD_ARGUMENT);
    const sl_moving_box wrong = {{{5, 5}, {4, 4}}, true};
    uint64_t cells[8];
    assert_ok(context, sl_query_set_boxes(context, query, &wrong, 1));
    assert_int_equal(sl_query_look(context, query, &view, NULL, cells, NULL), SL_BAD_ARGUMENT);
    assert_ok(context, sl_query_set_boxes(context, query, NULL, 0));
    assert_ok(context, sl_query_look(context, query, &view, NULL, cells, NULL));
    const sl_view outside = sl_query_view(query, (sl_point){50, 50}, 0, 360);
    assert_ok(context, sl_query_look(context, query, &outside, NULL, cells, NULL));
    assert_int_equal(cells[0], 0);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// A side on dark glass is not seen from there, whether boxes block or not, and of what kind the
/// cells are. From the lit side it is seen.
static void dark_glass_covers_sides_of_boxes(void **state) {
    (void)state;
    static const char *const grounds[] = {"", "wall 6 0.5 7 1\n"};
    const sl_moving_box behind = {{{3, 4}, {5, 6}}, false}, blocks = {{{1, 1}, {2, 2}}, true};
    const sl_moving_box both[] = {behind, blocks}, hides[] = {{behind.box, true}};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < 2; i++) {
        const char *const parts[] = {"sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\n",
                                     "oneway 5 9 5 1\nstart 8 5 0\n", grounds[i], NULL};
        sl_baked baked = {0};
        sl_query *query;
        bake(context, parts, &baked);
        assert_ok(context, sl_query_create(context, &baked, &query));
        for (int lit = 0; lit < 2; lit++) {
            const sl_view view = sl_view_all_round((sl_point){8, 5});
            bool seen[2];
            sl_query_set_backwards(context, query, lit);
            assert_ok(context, sl_query_set_boxes(context, query, &behind, 1));
            assert_ok(context, sl_query_boxes_seen(context, query, &view, seen, NULL));
            assert_int_equal(seen[0], lit);
            assert_ok(context, sl_query_set_boxes(context, query, both, 2));
            assert_ok(context, sl_query_boxes_seen(context, query, &view, seen, NULL));
            assert_int_equal(seen[0], lit);
            assert_ok(context, sl_query_set_boxes(context, query, hides, 1));
            assert_ok(context, sl_query_boxes_seen(context, query, &view, seen, NULL));
            assert_int_equal(seen[0], lit);
        }
        sl_query_destroy(context, query);
        sl_baked_destroy(context, &baked);
    }
    sl_context_destroy(context);
}

/// An eye on glass sees along it, past the end of a wall, into a cell that the visible sets of its
/// own cells lack: from the cells below, nobody looks through the glass.
static void along_glass_a_bake_hides_nothing(void **state) {
    (void)state;
    const char *const parts[] = {"sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\n",
                                 "wall 8 5 8 10\noneway 10 5 2 5\nstart 5 5 0\n", NULL};
    const sl_moving_box boxes[] = {{{{8.5, 5}, {9, 6}}, false}, {{{1, 1}, {2, 2}}, true}};
    const sl_view view = sl_view_all_round((sl_point){6, 5});
    sl_context *context = testing_context(NULL);
    sl_baked baked = {0};
    sl_query *queries[2];
    bake(context, parts, &baked);
    const uint32_t behind = sl_space_locate(&baked.space, (sl_point){9, 8});
    assert_ok(context, sl_query_create(context, &baked, &queries[0]));
    assert_ok(context, sl_query_over(context, &baked.space, &baked.map, NULL, &queries[1]));
    for (int bare = 0; bare < 2; bare++) {
        sl_query *query = queries[bare];
        uint64_t cells[4];
        size_t count;
        bool sees, seen[2];
        const sl_eye_method *methods = sl_eye_methods(&count);
        assert_true(sl_eye_words(&baked.space) <= 4);
        assert_ok(context, sl_query_sees(context, query, view.eye, (sl_point){9, 5}, &sees));
        assert_true(sees);
        for (size_t blocks = 0; blocks < 2; blocks++) {
            assert_ok(context, sl_query_set_boxes(context, query, boxes, 1 + blocks));
            for (size_t i = 0; i < count; i++) {
                if (bare && methods[i].needs_pvs) continue;
                assert_ok(context, sl_query_look(context, query, &view, &methods[i], cells, NULL));
                assert_true(sl_eye_sees(cells, behind));
            }
            assert_ok(context, sl_query_boxes_seen(context, query, &view, seen, NULL));
            assert_true(seen[0]);
        }
        sl_query_destroy(context, query);
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void a_bake_is_its_stages(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *const parts[] = {rooms, door, glass, NULL};
    sl_map map = {0};
    sl_baked baked = {0};
    sl_bake_account account;
    read_map(context, parts, &map);
    assert_ok(context, sl_bake(context, &map, NULL, &baked, &account));
    assert_string_equal(baked.method, "sweep");
    assert_string_equal(account.subdivision->name, "kd");
    size_t count;
    sl_space space = {0};
    sl_visibility seen = {0};
    read_map(context, parts, &map);
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    assert_ok(context, sl_subdivisions(&count)[0].subdivide(context, &map, NULL, &space));
    const sl_plan plan = sl_plan_make(&map);
    sl_see_options options = sl_see_options_default();
    options.plan = &plan;
    options.solver = sl_funnel();
    assert_ok(context, testing_method("dfs")->see(context, &space, &options, &seen));
    assert_true(sl_baked_same_space(&baked.space, &space));
    assert_true(testing_same_rows(&baked.visibility.pvs, &seen.pvs));
    options.trees = true;
    options.solver = NULL;
    assert_string_equal(sl_see_method_for(&map, &options)->name, "dfs");
    assert_null(sl_see_method_named("no such method"));
    sl_visibility_destroy(context, &seen);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void what_a_bake_does_not_know_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *const parts[] = {rooms, "range 9\n", NULL};
    sl_map map = {0};
    sl_baked baked = {0};
    sl_query *query;
    sl_bake_options options = sl_bake_options_default();
    options.mirror_depth = 17;
    read_map(context, parts, &map);
    assert_int_equal(sl_bake(context, &map, &options, &baked, NULL), SL_BAD_ARGUMENT);
    sl_map_destroy(context, &map);
    bake(context, parts, &baked);
    assert_ok(context, sl_query_create(context, &baked, &query));
    assert_int_equal(sl_query_set_range(context, query, 0), SL_BAD_ARGUMENT);
    assert_int_equal(sl_query_set_range(context, query, 9.5), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(context), "range of 9,"));
    assert_ok(context, sl_query_set_range(context, query, 9));
    const sl_visibility no_rows = {.sight = SL_CLOSED};
    assert_ok(context, sl_query_set_visibility(context, query, &no_rows));
    assert_ok(context, sl_query_set_range(context, query, 9.5));
    assert_int_equal(sl_query_set_visibility(context, query, &baked.visibility), SL_BAD_ARGUMENT);
    assert_ok(context, sl_query_set_range(context, query, 8));
    assert_ok(context, sl_query_set_visibility(context, query, &baked.visibility));
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// All that a caller does once, with an allocator that fails at its Nth call.
/// The answers of one query for an eye in a map with rock, from a kd-tree or a mesh.
static void ask_from(sl_context *context, sl_query *query, sl_point eye, bool sees) {
    uint64_t cells[4] = {0};
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const sl_view view = sl_query_view(query, eye, 0, 360);
    sl_region region = {0};
    sl_mirrored_region mirrored = {0};
    bool out;
    assert_true(sl_eye_words(sl_query_asked(query)) <= 4);
    for (size_t i = 0; i < count; i++) {
        assert_ok(context, sl_query_look(context, query, &view, &methods[i], cells, NULL));
        assert_true(((cells[0] | cells[1] | cells[2] | cells[3]) != 0) == sees);
    }
    assert_ok(context, sl_query_region(context, query, &view, &region));
    assert_true((region.count > 0) == sees);
    assert_ok(context, sl_query_mirrored_region(context, query, &view, &mirrored));
    assert_true((mirrored.direct.count > 0) == sees);
    assert_ok(context, sl_query_sees(context, query, eye, (sl_point){eye.x + 0.25, eye.y}, &out));
    assert_true(out == sees);
    const sl_moving_box near = {{{eye.x + 0.125, eye.y}, {eye.x + 0.25, eye.y + 0.125}}, false};
    assert_ok(context, sl_query_set_boxes(context, query, &near, 1));
    assert_ok(context, sl_query_boxes_seen(context, query, &view, &out, NULL));
    assert_true(out == sees);
    assert_ok(context, sl_query_set_boxes(context, query, NULL, 0));
    sl_region_destroy(context, &region);
    sl_mirrored_region_destroy(context, &mirrored);
}

static void an_eye_in_rock_sees_nothing(void **state) {
    (void)state;
    static const char *const rocks[] = {"solid 10 10 14 10 14 14 10 14\n",
                                        "solid 10 10 14 10 12 15\n"};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < 2; i++) {
        const char *const parts[] = {rooms, rocks[i], NULL};
        sl_baked baked = {0};
        sl_query *query;
        bool out;
        bake(context, parts, &baked);
        assert_ok(context, sl_query_create(context, &baked, &query));
        ask_from(context, query, (sl_point){12, 12}, false);
        ask_from(context, query, (sl_point){5, 12}, true);
        const uint32_t rock = sl_query_locate(query, (sl_point){12, 12});
        assert_true(baked.space.cells[rock].solid);
        assert_ok(context, sl_query_can_see(context, query, rock, rock, &out));
        assert_false(out);
        sl_query_destroy(context, query);
        sl_baked_destroy(context, &baked);
    }
    sl_context_destroy(context);
}

static sl_status bake_and_ask(sl_context *context, const char *const *parts) {
    char text[1024] = "";
    for (size_t i = 0; parts[i]; i++) strcat(text, parts[i]);
    sl_map map = {0};
    sl_baked baked = {0};
    sl_query *query = NULL;
    sl_region region = {0};
    sl_mirrored_region mirrored = {0};
    uint64_t cells[8];
    sl_status status = sli_map_read_text(context, "rooms", text, strlen(text), &map);
    sl_bake_options options = sl_bake_options_default();
    options.see.threads = 1;
    if (status == SL_OK) status = sl_bake(context, &map, &options, &baked, NULL);
    if (status == SL_OK) status = sl_query_create(context, &baked, &query);
    if (status == SL_OK) sl_query_set_doors(context, query, false);
    if (status == SL_OK) status = sl_query_set_boxes(context, query, &box, 1);
    for (int i = 0; i < 2 && status == SL_OK; i++) {
        const sl_view view = sl_query_view(query, (sl_point){i ? 25 : 5, 4}, 0, 360);
        const sl_moving_box clear = {box.box, false}; // is listed, and cuts no cells
        bool seen;
        status = sl_query_set_boxes(context, query, &clear, 1);
        if (status == SL_OK) status = sl_query_boxes_seen(context, query, &view, &seen, NULL);
        if (status == SL_OK) status = sl_query_set_boxes(context, query, &box, 1);
        if (status != SL_OK) break;
        status = sl_query_look(context, query, &view, NULL, cells, NULL);
        if (status == SL_OK) status = sl_query_region(context, query, &view, &region);
        if (status != SL_OK || !sl_query_map(query)->mirror_count) continue;
        status = sl_query_look_mirrored(context, query, &view, NULL, cells, NULL);
        if (status == SL_OK) status = sl_query_mirrored_region(context, query, &view, &mirrored);
    }
    sl_region_destroy(context, &region);
    sl_mirrored_region_destroy(context, &mirrored);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    return status;
}

static void ask_without_memory(const char *const *parts) {
    testing_memory memory = {0};
    sl_status status = SL_NO_MEMORY;
    for (long n = 1; status == SL_NO_MEMORY; n++) {
        memory = (testing_memory){0};
        sl_context *context = testing_context(&memory);
        memory.calls = 0;
        memory.fail_at = n;
        status = bake_and_ask(context, parts);
        memory.fail_at = 0;
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        assert_true(n < 20000);
    }
    assert_int_equal(status, SL_OK);
}

static void without_memory_nothing_leaks(void **state) {
    (void)state;
    static const char *const maps[][5] = {
        {rooms, door, glass, NULL},
        {rooms, door, glass, "mirror 12 10 18 10\n", NULL},
        {rooms, "mirror 22 2 28 4\n", NULL},
        {rooms, "mirror 22 2 28 4\noneway 1 9 9 7\n", NULL},
    };
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) ask_without_memory(maps[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bake_is_its_stages),
        cmocka_unit_test(a_file_answers_as_memory_does),
        cmocka_unit_test(rays_meet_what_stands),
        cmocka_unit_test(mirrors_show_what_the_depth_allows),
        cmocka_unit_test(boxes_are_seen_and_wrong_settings_refused),
        cmocka_unit_test(dark_glass_covers_sides_of_boxes),
        cmocka_unit_test(along_glass_a_bake_hides_nothing),
        cmocka_unit_test(what_a_bake_does_not_know_is_refused),
        cmocka_unit_test(an_eye_in_rock_sees_nothing),
        cmocka_unit_test(without_memory_nothing_leaks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
