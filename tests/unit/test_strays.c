// Strays: what lies far away from the rest of a map, in any place and order, and no more than that.
#include "testing.h"

#include "map/scan.h"
#include "sightline/faults.h"

#include <string.h>

#define ROOM "walls 0 0 10 0 10 10 0 10 0 0\n"

/// The lines of the strays in a map text, each after a blank.
static void assert_strays(const char *statements, const char *expected) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_strays strays = {0};
    char text[4096], lines[256] = "";
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "f", text, strlen(text), &map));
    assert_ok(context, sl_find_strays(context, &map, &strays));
    for (uint32_t i = 0; i < strays.count; i++)
        snprintf(lines + strlen(lines), sizeof lines - strlen(lines), " %u", strays.items[i].line);
    assert_string_equal(lines, expected);
    sl_strays_destroy(context, &strays);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void test_lines(void **state) {
    (void)state;
    assert_strays("", "");
    assert_strays("wall 0 0 1 0\n", "");
    assert_strays(ROOM, "");
    assert_strays(ROOM "wall 150 5 160 5\n", "");
    assert_strays(ROOM "wall 250 5 251 5\n", " 3");
    assert_strays(ROOM "wall 5 5 5 1e7\n", " 3"); // by one end
    assert_strays("wall -1e9 0 -1e9 1\n" ROOM "wall 2 2 3 2\nwall 4 4 4 5e8\n", " 2 5");
    assert_strays(ROOM "start 5 4000 0\n", " 3");
    assert_strays(ROOM "door d 1e5 0 1e5 1\n", " 3");
    // Half of the map far away from the other half: neither is stray.
    assert_strays(ROOM "walls 5000 0 5010 0 5010 10 5000 10 5000 0\n", "");
    // Far from the origin, but not from each other.
    assert_strays("walls 1e8 1e8 100000010 1e8 100000010 100000010 1e8 1e8\n", "");
    // All in one line, and all at one place but one.
    assert_strays("wall 0 0 1 0\nwall 1 0 2 0\nwall 2 0 3 0\nwall 3 0 4 0\nwall 900 0 901 0\n",
                  " 6");
}

static void test_distance(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_strays strays = {0};
    const char *text = "sightline 1\n" ROOM "wall 310 10 310 410\n";
    assert_ok(context, sli_map_read_text(context, "f", text, strlen(text), &map));
    assert_ok(context, sl_find_strays(context, &map, &strays));
    assert_int_equal(strays.count, 1);
    assert_int_equal(strays.items[0].wall, 4);
    assert_true(strays.items[0].at.x == 310 && strays.items[0].at.y == 410);
    assert_true(strays.items[0].distance == 500);
    assert_true(strays.rest.min.x == 0 && strays.rest.max.x == 10 && strays.rest.max.y == 10);
    sl_strays_destroy(context, &strays);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
