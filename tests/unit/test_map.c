// The map itself: what may be added, what is kept, its bounds.
#include "testing.h"

#include "map/source.h"
#include "map_same.h"

#include <math.h>

static void test_coordinates(void **state) {
    (void)state;
    const double good[] = {0, -0.0, 1, -1, 1e-150, -1e-150, 1e150, -1e150};
    const double bad[] = {NAN,     INFINITY, -INFINITY, 0x1p-1074, 9.9e-151,
                          1.1e150, -1.1e150, 1e308,     -1e-300};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_true(sl_coordinate_usable(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(sl_coordinate_usable(bad[i]));
}

static void test_add_and_destroy(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    const long before = memory.live;
    sl_map map = {0};
    const sl_point points[] = {{1, 2}, {3, 4}, {5, 6}};
    for (uint32_t i = 1; i <= 20; i++) {
        const sl_segment at = {{i, 0}, {i, 1}};
        char name[8];
        snprintf(name, sizeof name, "n%u", i);
        assert_ok(context, sl_map_add_wall(context, &map, at.a, at.b, i));
        assert_ok(context, sl_map_add_door(context, &map, name, at, i % 2, 100 + i));
        assert_ok(context, sl_map_add_mirror(context, &map, at, 200 + i));
        assert_ok(context, sl_map_add_oneway(context, &map, at, 300 + i));
        assert_ok(context, sl_map_add_start(context, &map, at.a, 1e200, 400 + i));
        assert_ok(context, sl_map_add_path(context, &map, name, points, 1 + i % 3, 500 + i));
        assert_ok(context, sl_map_add_object(context, &map, name, (sl_box){at.a, at.b}, 600 + i));
    }
    assert_int_equal(map.wall_count, 20);
    assert_int_equal(map.walls[19].line, 20);
    assert_int_equal(map.doors[7].line, 108);
    assert_string_equal(map.doors[7].name, "n8");
    assert_false(map.doors[7].open);
    assert_true(map.doors[8].open);
    assert_true(map.mirrors[4].segment.b.x == 5);
    assert_int_equal(map.oneways[4].line, 305);
    assert_true(map.starts[0].heading == 1e200);
    assert_int_equal(map.paths[1].count, 3);
    assert_true(map.paths[1].points[2].y == 6);
    assert_string_equal(map.objects[19].name, "n20");
    sl_map_destroy(context, &map);
    assert_true(map_is_empty(&map));
    assert_int_equal(memory.live, before);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void test_bad_arguments(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    const sl_point good = {1, 2}, bad = {1, NAN}, large = {-1e200, 0};
    const sl_segment segment = {good, {3, 4}}, broken = {good, bad};
#define REFUSED(call) assert_int_equal(call, SL_BAD_ARGUMENT)
    REFUSED(sl_map_add_wall(context, &map, good, bad, 0));
    REFUSED(sl_map_add_wall(context, &map, large, good, 0));
    assert_non_null(strstr(sl_context_message(context), "-1e+200"));
    REFUSED(sl_map_add_door(context, &map, "d", broken, true, 0));
    REFUSED(sl_map_add_mirror(context, &map, broken, 0));
    REFUSED(sl_map_add_oneway(context, &map, broken, 0));
    REFUSED(sl_map_add_start(context, &map, bad, 0, 0));
    REFUSED(sl_map_add_start(context, &map, good, INFINITY, 0));
    REFUSED(sl_map_add_path(context, &map, "p", &good, 0, 0));
    REFUSED(sl_map_add_path(context, &map, "p", (sl_point[]){good, bad}, 2, 0));
    REFUSED(sl_map_add_object(context, &map, "o", (sl_box){good, bad}, 0));
    REFUSED(sl_map_add_object(context, &map, "o", (sl_box){{3, 0}, {2, 1}}, 0));
    const char *const names[] = {
        "",     " ",    "a b",      "a#",           "a\n",   "\t",           "\x7f",
        "\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xc3(", "\xe0\x9f\xbf", "\xf4\x90\x80\x80"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        REFUSED(sl_map_add_door(context, &map, names[i], segment, true, 0));
        REFUSED(sl_map_add_path(context, &map, names[i], &good, 1, 0));
        REFUSED(sl_map_add_object(context, &map, names[i], (sl_box){good, good}, 0));
    }
    assert_int_equal(map.wall_count + map.door_count + map.mirror_count + map.oneway_count +
                         map.start_count + map.path_count + map.object_count,
                     0);
    assert_ok(context, sl_map_add_door(context, &map, "S\xc3\xa9quin\xe2\x82\xac\xf0\x9f\x98\x80",
                                       segment, true, 0));
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_notes(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, sli_map_add_note(context, &map, "one"));
    assert_string_equal(map.source.notes, "one\n");
    assert_ok(context, sli_map_add_note(context, &map, ""));
    assert_ok(context, sli_map_add_note(context, &map, "  two\r\nthree\n"));
    assert_ok(context, sli_map_add_note(context, &map, "fo\rur\r\r"));
    assert_string_equal(map.source.notes, "one\n\n  two\nthree\nfo\rur\n");
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void assert_box(sl_box box, double x0, double y0, double x1, double y1) {
    assert_true(box.min.x == x0 && box.min.y == y0 && box.max.x == x1 && box.max.y == y1);
}

static void test_bounds(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_box(sl_map_bounds(&map), 0, 0, 0, 0);
    assert_ok(context, sl_map_add_start(context, &map, (sl_point){5, 5}, 0, 0));
    assert_box(sl_map_bounds(&map), 5, 5, 5, 5);
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){6, 5}, (sl_point){5, 6}, 0));
    assert_box(sl_map_bounds(&map), 5, 5, 6, 6);
    assert_ok(context, sl_map_add_door(context, &map, "d", (sl_segment){{4, 5}, {5, 5}}, true, 0));
    assert_box(sl_map_bounds(&map), 4, 5, 6, 6);
    assert_ok(context, sl_map_add_mirror(context, &map, (sl_segment){{5, 4}, {5, 5}}, 0));
    assert_box(sl_map_bounds(&map), 4, 4, 6, 6);
    assert_ok(context, sl_map_add_oneway(context, &map, (sl_segment){{5, 5}, {7, 5}}, 0));
    assert_box(sl_map_bounds(&map), 4, 4, 7, 6);
    assert_ok(context, sl_map_add_path(context, &map, "p", (sl_point[]){{5, 5}, {5, 7}}, 2, 0));
    assert_box(sl_map_bounds(&map), 4, 4, 7, 7);
    assert_ok(context, sl_map_add_object(context, &map, "o", (sl_box){{-1, 5}, {5, 9}}, 0));
    assert_box(sl_map_bounds(&map), -1, 4, 7, 9);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// What a file calls its lines.
static void test_labels(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0}, copy = {0};
    char text[SL_LINE_TEXT];
    assert_ok(context, sli_map_add_label(context, &map, 3, "layer WALLS, handle 1F"));
    assert_ok(context, sli_map_add_label(context, &map, 7, "layer A\tB"));
    assert_ok(context, sli_map_add_label(context, &map, 9, "layer A?B"));
    assert_ok(context, sli_map_add_label(context, &map, 12, "one"));
    assert_ok(context, sli_map_add_label(context, &map, 12, "two"));
    assert_ok(context, sli_map_add_label(context, &map, 12, "three"));
    assert_int_equal(sli_map_add_label(context, &map, 11, "late"), SL_BAD_ARGUMENT);
    assert_int_equal(sli_map_add_label(context, &map, 0, "none"), SL_BAD_ARGUMENT);
    assert_int_equal(map.source.labels[1].text, map.source.labels[2].text);
    assert_ok(context, sl_map_copy(context, &map, &copy));
    sl_map_destroy(context, &map);
    static const struct {
        uint32_t line;
        const char *said, *item;
    } cases[] = {
        {0, "", ""},
        {3, "line 3 (layer WALLS, handle 1F)", "layer WALLS, handle 1F"},
        {5, "line 5", "item 5"},
        {9, "line 9 (layer A?B)", "layer A?B"},
        {12, "line 12 (one or another on this line)", "one or another on this line"},
        {13, "line 13", "item 13"},
    };
    for (int items = 0; items < 2; items++) {
        copy.source.lines_are_items = items;
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            sl_map_say_line(&copy, cases[i].line, text);
            assert_string_equal(text, items ? cases[i].item : cases[i].said);
        }
        copy.source.name = (char *)"a.dxf";
        assert_int_equal(sli_map_fail(context, &copy, SL_UNSUPPORTED, 3, "no %s", "way"),
                         SL_UNSUPPORTED);
        assert_string_equal(sl_context_message(context),
                            items ? "a.dxf: layer WALLS, handle 1F: no way"
                                  : "a.dxf:3: layer WALLS, handle 1F: no way");
        sli_map_fail(context, &copy, SL_UNSUPPORTED, 5, "no");
        assert_string_equal(sl_context_message(context),
                            items ? "a.dxf: item 5: no" : "a.dxf:5: no");
        sli_map_fail(context, &copy, SL_UNSUPPORTED, 0, "no");
        assert_string_equal(sl_context_message(context), "a.dxf: no");
        copy.source.name = NULL;
    }
    sl_map_destroy(context, &copy);
    // A long name is cut between two characters.
    char longest[400] = "";
    for (int i = 0; i < 150; i++) strcat(longest, "\xc3\xa9");
    assert_ok(context, sli_map_add_label(context, &map, 1, longest));
    const char *label = sl_map_label(&map, 1);
    assert_true(strlen(label) > 100 && strlen(label) < SL_LINE_TEXT && strlen(label) % 2 == 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_coordinates),   cmocka_unit_test(test_add_and_destroy),
        cmocka_unit_test(test_bad_arguments), cmocka_unit_test(test_notes),
        cmocka_unit_test(test_bounds),        cmocka_unit_test(test_labels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
