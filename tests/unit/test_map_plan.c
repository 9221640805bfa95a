// The ASCII plan: the walls that it stands for, and the way back.
#include "testing.h"

#include "map/scan.h"
#include "map_same.h"
#include "sightline/support.h"

static sl_status read(sl_context *context, const char *text, sl_map *map) {
    return sli_map_read_plan(context, "p.txt", text, strlen(text), map);
}

/// The map's walls as text, in the order of cleaning but not cleaned; other things behind them.
static void assert_map(sl_context *context, const char *plan, const char *expected) {
    sl_map map = {0};
    assert_ok(context, read(context, plan, &map));
    char *text = map_walls_text(&map);
    assert_string_equal(text, expected);
    free(text);
    sl_map_destroy(context, &map);
}

static void test_walls(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *const square =
        "sightline 1\nwall 1 2 2 2\nwall 1 1 2 1\nwall 1 1 1 2\nwall 2 1 2 2\n";
    assert_map(context, "###\n#.#\n###\n", square);
    assert_map(context, "###\r\n# #\r\n###", square);
    assert_map(context, "###\r# #\r###", square);
    assert_map(context, "\xef\xbb\xbf#\n#.\n#\n", square);
    // The last line is empty, and solid as all is beyond the plan.
    assert_map(context, "#.\n\n", square);
    // Walls go on as long as the floor is on the same side.
    assert_map(context, ".#\n#.\n",
               "sightline 1\nwall 0 2 1 2\nwall 0 1 1 1\nwall 1 1 2 1\nwall 0 1 0 2\n"
               "wall 1 1 1 2\nwall 1 0 2 0\nwall 1 0 1 1\nwall 2 0 2 1\n");
    assert_map(context, "..\n.\n",
               "sightline 1\nwall 0 2 2 2\nwall 1 1 2 1\nwall 2 1 2 2\nwall 0 0 1 0\n"
               "wall 0 0 0 2\nwall 1 0 1 1\n");
    sl_context_destroy(context);
}

static void test_lines(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, read(context, "####\n#@.#\n#..#\n####\n", &map));
    for (size_t i = 0; i < map.wall_count; i++) {
        const sl_wall *wall = &map.walls[i];
        // Walls are as they stand to a line of the file: the top one above its row.
        const uint32_t line = wall->a.y == 1 && wall->b.y == 1 ? 4 : 2;
        assert_int_equal(wall->line, line);
    }
    assert_int_equal(map.starts[0].line, 2);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_doors_and_starts(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, read(context,
                            "#######\n"
                            "#.+.@.#\n"
                            "#+###.#\n"
                            "#.....#\n"
                            "##+####\n"
                            "#######\n",
                            &map));
    assert_int_equal(map.door_count, 3);
    assert_string_equal(map.doors[0].name, "door1");
    assert_true(same_segment(map.doors[0].segment, (sl_segment){{2.5, 4}, {2.5, 5}}));
    assert_string_equal(map.doors[1].name, "door2");
    assert_true(same_segment(map.doors[1].segment, (sl_segment){{1, 3.5}, {2, 3.5}}));
    assert_int_equal(map.doors[1].line, 3);
    assert_true(map.doors[1].open);
    // Before a niche's end the solid squares to the left and right decide.
    assert_true(same_segment(map.doors[2].segment, (sl_segment){{2, 1.5}, {3, 1.5}}));
    assert_int_equal(map.start_count, 1);
    assert_true(map.starts[0].at.x == 4.5 && map.starts[0].at.y == 4.5);
    assert_true(map.starts[0].heading == 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_refusals(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const struct {
        const char *text, *message;
    } cases[] = {
        {"", "p.txt: the plan has no open square"},
        {"###\n##\n", "p.txt: the plan has no open square"},
        {"###\n#\t#\n", "p.txt:2: column 2: expected '#', ' ', '.', '+' or '@', found a tab"},
        {"###\n#.x\n", "p.txt:2: column 3: expected '#', ' ', '.', '+' or '@', found 'x'"},
        {"#.\r#\n", "p.txt:1: column 3: expected '#', ' ', '.', '+' or '@', found byte 0x0d"},
        {"\xe2\x96\x88\n",
         "p.txt:1: column 1: expected '#', ' ', '.', '+' or '@', found byte 0xe2"},
        {"...\n.+.\n...\n", "p.txt:2: column 2: a door needs"},
        {"###\n#+#\n###\n", "p.txt:2: column 2: a door needs"},
        {"####\n#++.\n#..#\n", "p.txt:2: column 2: a door needs"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0};
        assert_int_equal(read(context, cases[i].text, &map), SL_BAD_INPUT);
        assert_true(map_is_empty(&map));
        const char *message = sl_context_message(context);
        if (strncmp(message, cases[i].message, strlen(cases[i].message)) != 0)
            fail_msg("expected '%s', got '%s'", cases[i].message, message);
    }
    sl_map map = {0};
    assert_int_equal(sli_map_read_plan(context, "p.txt", "#\n.\0.", 5, &map), SL_BAD_INPUT);
    assert_string_equal(sl_context_message(context),
                        "p.txt:2: a NUL byte: expected plain text (ASCII or UTF-8)");
    sl_context_destroy(context);
}

/// The plan of the map of a plan.
static char *there_and_back(sl_context *context, const char *plan) {
    sl_map map = {0};
    assert_ok(context, read(context, plan, &map));
    sl_status status;
    char *text = map_plan_text(context, &map, &status);
    assert_ok(context, status);
    sl_map_destroy(context, &map);
    return text;
}

static void test_identity(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *const plans[] = {
        "###\n#.#\n###\n",
        ".\n",
        "..#\n#..\n",
        "#####\n#@..#\n#.#.#\n#...#\n#####\n",
        "#########\n#...#...#\n#.#.+.#.#\n#...#.@.#\n##+###+##\n#.......#\n#########\n",
        // Rooms that no start leads to, a room in a pillar, squares that meet at corners.
        "#########\n#@.#....#\n#..#.##.#\n####.##.#\n#..#....#\n#########\n",
        "#######\n#.....#\n#.###.#\n#.#.#.#\n#.###.#\n#.....#\n#######\n",
        "#####\n#.#.#\n##.##\n#.#.#\n#####\n",
        // Solid squares to the left and below keep the floor's place.
        "######\n####.#\n####.#\n######\n######\n######\n",
    };
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        char *text = there_and_back(context, plans[i]);
        assert_string_equal(text, plans[i]);
        free(text);
    }
    // Trailing solid columns do not come back, nor do solid lines above the first.
    char *text = there_and_back(context, "#####\n#####\n#.\n###\n");
    assert_string_equal(text, "###\n#.#\n###\n");
    free(text);
    sl_context_destroy(context);
}

/// A random plan, in a ring of solid squares.
static void make_plan(sl_random *random, char *text, size_t width, size_t height, int share) {
    for (size_t row = 0; row < height; row++) {
        for (size_t column = 0; column < width; column++) {
            const bool ring = row == 0 || column == 0 || row == height - 1 || column == width - 1;
            const bool open = sl_random_below(random, 100) < (uint64_t)share;
            *text++ = ring || !open ? '#' : sl_random_below(random, 20) ? '.' : '@';
        }
        *text++ = '\n';
    }
    *text = '\0';
}

static void test_random_plans(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {7};
    for (int round = 0; round < 500; round++) {
        const size_t width = 3 + sl_random_below(&random, 12),
                     height = 3 + sl_random_below(&random, 12);
        char plan[16 * 16 + 1];
        make_plan(&random, plan, width, height, 20 + (int)sl_random_below(&random, 70));
        // The floor must reach to the ring on top and at the bottom right, or it does not come
        // back.
        plan[width + 1 + 1] = '.';
        plan[(height - 1) * (width + 1) - 3] = '.';
        char *text = there_and_back(context, plan);
        assert_string_equal(text, plan);
        sl_map map = {0}, back = {0};
        assert_ok(context, read(context, plan, &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        // Cleaned walls are the same walls.
        sl_status status;
        char *again = map_plan_text(context, &map, &status);
        assert_ok(context, status);
        assert_string_equal(again, plan);
        assert_ok(context, read(context, again, &back));
        assert_ok(context, sl_map_clean(context, &back, NULL, NULL));
        assert_true(map_same(&map, &back));
        sl_map_destroy(context, &map);
        sl_map_destroy(context, &back);
        free(again);
        free(text);
    }
    sl_context_destroy(context);
}

static sl_status write_of(sl_context *context, const char *statements, char **plan) {
    char text[1000];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    sl_map map = {0};
    assert_ok(context, sli_map_read_text(context, "m.map", text, strlen(text), &map));
    sl_status status;
    *plan = map_plan_text(context, &map, &status);
    sl_map_destroy(context, &map);
    return status;
}

static void test_write(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const struct {
        const char *statements, *plan;
    } cases[] = {
        {"walls 0 0 2 0 2 1 0 1 0 0\n", "..\n"},
        {"walls 1 0 2 0 2 1 1 1 1 0\n", "#.#\n"},
        {"walls 0 1 2 1 2 2 0 2 0 1\n", "##\n..\n##\n"},
        // Moved where it must.
        {"walls -5 -7 -3 -7 -3 -6 -5 -6 -5 -7\n", "####\n#..#\n####\n"},
        {"walls 9000 0 9001 0 9001 1 9000 1 9000 0\n", "#.#\n"},
        {"walls 4095 0 4094 0 4094 1 4095 1 4095 0\nwall 3 3 3 3\n", NULL},
        // Overlapping and repeated pieces, a start on the corner of its square.
        {"walls 0 0 2 0 2 2 0 2 0 0\nwall 0 0 1 0\nwall 2 1 2 2\nstart 0 1 90\n", "@.\n..\n"},
        {"walls 0 0 3 0 3 2 2 2 2 1 1 1 1 2 0 2 0 0\ndoor d 1.5 1 1.5 0\n", ".#.\n.+.\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *plan;
        assert_ok(context, write_of(context, cases[i].statements, &plan));
        if (cases[i].plan) assert_string_equal(plan, cases[i].plan);
        free(plan);
    }
    sl_context_destroy(context);
}

#define ROOM "walls 0 0 4 0 4 4 0 4 0 0\n"

static void test_write_refusals(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const struct {
        const char *statements, *message;
    } cases[] = {
        {"range 5\n", "the map:2: a plan has no place for a range"},
        {"", "the map: a plan needs walls, the map has none"},
        {ROOM "wall 1 1 2 2\n", "the map:3: wall 1 1 2 2: a plan has horizontal and vertical"},
        {ROOM "wall 1 1 1 2.5\n", "the map:3: wall 1 1 1 2.5: a plan has walls at whole"},
        {ROOM "wall 2 0 2 4\n", "the map:3: wall 2 0 2 4: open floor on both sides"},
        {ROOM "wall 2 1 2 3\n", "the map:3: wall 2 1 2 3: open floor on both sides"},
        {ROOM "wall 4 2 5 2\n", "the map:3: wall 4 2 5 2: no floor at either side"},
        {"walls 0 0 1 0 1 1 0 1\n", "the map:2: wall 0 0 1 0: no floor at either side"},
        {"walls 0 0 9 0 9 9 0 9 0 0\nsolid 1 1 4 1 4 4 1 4\nsolid 3 3 6 3 6 6 3 6\n",
         "the map:3: wall 4 1 4 4: a plan cannot say which side of it is solid ground"},
        {ROOM "wall 0 0 5000 0\n", "the map:3: wall 0 0 5000 0: more than 4096 x 4096"},
        {ROOM "wall 0 0 1e150 0\n", "the map:3: wall 0 0 1e+150 0: more than 4096 x 4096"},
        {ROOM "mirror 0 0 1 0\n", "the map:3: a plan has no place for a mirror"},
        {ROOM "oneway 0 0 1 0\n", "the map:3: a plan has no place for one-way glass"},
        {ROOM "seam 0 0 1 0\n", "the map:3: a plan has no place for a seam"},
        {ROOM "cell 0 0 1 0 1 1\n", "the map:3: a plan has no place for cells of the map's own"},
        {"wall 0 1 0 1\n", "the map: a plan needs walls, the map has none"},
        {ROOM "path p 1 1\n", "the map:3: a plan has no place for path p"},
        {ROOM "object o 1 1 2 2\n", "the map:3: a plan has no place for object o"},
        {"#! (c)\n" ROOM, "the map: a plan has no place for the map's notes"},
        {ROOM "start 5 5 0\n", "the map:3: the start stands in a solid square"},
        {ROOM "start 4 1 0\n", "the map:3: the start stands in a solid square"},
        {ROOM "start 1.2 1 0\nstart 1.7 1 0\n", "the map:4: the start's square holds"},
        {ROOM "walls 1 1 2 1 2 2 1 2 1 1\nstart 1.5 1.5 0\n",
         "the map:4: the start stands in a solid square"},
        {ROOM "door d 0 1.5 1 1.5\n", "the map:3: door 0 1.5 1 1.5: a plan's doors stand"},
        {"walls 0 0 3 0 3 1 0 1 0 0\ndoor d 1 0 1 1\n", "the map:3: door 1 0 1 1: a plan's doors"},
        {"walls 0 0 3 0 3 1 0 1 0 0\ndoor d 1.5 0 1.5 1 shut\n",
         "the map:3: door 1.5 0 1.5 1: a plan has open doors only"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *plan;
        assert_int_equal(write_of(context, cases[i].statements, &plan), SL_UNSUPPORTED);
        const char *message = sl_context_message(context);
        if (strncmp(message, cases[i].message, strlen(cases[i].message)) != 0)
            fail_msg("expected '%s', got '%s'", cases[i].message, message);
    }
    sl_context_destroy(context);
}

/// All squares there are, with none left for a border: moved to 0.
static void test_longest(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char *plan;
    assert_ok(
        context,
        write_of(context, "walls 100 3 4196 3 4196 4 100 4 100 3\nstart 100.5 3.5 0\n", &plan));
    char *last = strstr(plan, "@");
    assert_non_null(last);
    assert_int_equal(strspn(last + 1, "."), 4095);
    assert_true(last[-1] == '\n' && last[4096] == '\n');
    free(plan);
    assert_ok(context, write_of(context, "walls 2 0 4095 0 4095 1 2 1 2 0\n", &plan));
    assert_int_equal(strspn(plan, "#"), 2);
    assert_string_equal(strchr(plan, '\n') - 2, ".#\n");
    free(plan);
    sl_context_destroy(context);
}

static void test_large(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    // A comb of 4096 by 4096 squares fits, one more column does not.
    sl_map map = {0};
    const double high = 4096;
    for (int x = 0; x <= 4094; x += 2) {
        const sl_point a = {x, 0}, b = {x + 1, 0}, c = {x + 1, high}, d = {x, high};
        assert_ok(context, sl_map_add_wall(context, &map, a, b, 0));
        assert_ok(context, sl_map_add_wall(context, &map, b, c, 0));
        assert_ok(context, sl_map_add_wall(context, &map, c, d, 0));
        assert_ok(context, sl_map_add_wall(context, &map, d, a, 0));
    }
    sl_status status;
    char *text = map_plan_text(context, &map, &status);
    assert_ok(context, status);
    assert_int_equal(strlen(text), 4096 * 4096); // the last column is solid and not there
    free(text);
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){4097, 0}, (sl_point){4097, 1}, 9));
    assert_null(map_plan_text(context, &map, &status));
    assert_int_equal(status, SL_UNSUPPORTED);
    assert_string_equal(
        sl_context_message(context),
        "the map:9: wall 4097 0 4097 1: more than 4096 x 4096 squares up to this wall");
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_file_stays(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char path[] = "/tmp/sightline-plan-XXXXXX";
    assert_true(mkstemp(path) >= 0);
    sl_map map = {0};
    assert_ok(context, read(context, "###\n#.#\n###\n", &map));
    size_t count;
    const sl_map_format *plan = &sl_map_formats(context, &count)[1];
    assert_string_equal(plan->name, "plan");
    assert_ok(context, sl_map_write(context, &map, plan, path));
    map.range = 1;
    assert_int_equal(sl_map_write(context, &map, plan, path), SL_UNSUPPORTED);
    FILE *file = fopen(path, "r");
    char text[100] = "";
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    remove(path);
    assert_string_equal(text, "###\n#.#\n###\n");
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walls),
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_doors_and_starts),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_identity),
        cmocka_unit_test(test_random_plans),
        cmocka_unit_test(test_write),
        cmocka_unit_test(test_write_refusals),
        cmocka_unit_test(test_longest),
        cmocka_unit_test(test_large),
        cmocka_unit_test(test_file_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
