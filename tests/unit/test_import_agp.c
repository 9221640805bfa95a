// Polygons of AGPLIB: outline, holes, fractions, and what is refused where.
#include "testing.h"

#include "io/fraction.h"
#include "io/io_formats.h"
#include "map_same.h"

static sl_status read(sl_context *context, const char *text, sl_map *map) {
    return sli_map_read_agp(context, "p.pol", text, strlen(text), NULL, map);
}

static void test_read(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    assert_ok(context, read(context,
                            "4 0/1 0/1 9/2 0/1 4.5 16/4\n-0/3 4\n"
                            "1\r\n3 1 1 1 2 2 2",
                            &map));
    char *text = map_text(&map);
    assert_string_equal(text, "sightline 1\nopen 0 0 0 4 4.5 4 4.5 0\nsolid 1 1 2 2 1 2\n");
    free(text);
    testing_subdivide(context, &map, &space);
    assert_true(sl_space_is_inside(&space, (sl_point){4, 1}));
    assert_false(sl_space_is_inside(&space, (sl_point){1.25, 1.75}));
    assert_false(sl_space_is_inside(&space, (sl_point){5, 1}));
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    // What is too small for a coordinate is 0, also as a quotient.
    assert_ok(context, read(context, "3 1e-300 1/1e200 1 0 1 1 0", &map));
    assert_true(map.walls[0].a.x == 0 && map.walls[0].a.y == 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// A whole number and zeros behind it.
static void put_long(char *text, size_t size, const char *digits, int zeros) {
    snprintf(text, size, "%s%0*d", digits, zeros, 0);
}

static void test_long_fractions(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    char above[400], below[400], text[2000];
    double value;
    bool exact;
    // The nearest double, of two the even one; past 53 bits and past the range of doubles, too.
    static const struct {
        const char *above, *below;
        double value;
        bool exact;
    } cases[] = {
        {"1", "3", 1.0 / 3, false},
        {"-7", "+4", -1.75, true},
        {"9007199254740993", "1", 9007199254740992.0, false},
        {"9007199254740995", "1", 9007199254740996.0, false},
        {"90071992547409930000000000000001", "10000000000000000", 9007199254740994.0, false},
        {"9007199254740993", "2", 4503599627370496.0, false},
        {"18446744073709551615", "1", 18446744073709551616.0, false},
        {"1267650600228229401496703205376", "1", 0x1p100, true},
        {"-3", "1267650600228229401496703205376", -0x1.8p-99, true},
        {"0", "12", 0, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_true(sli_fraction_read(cases[i].above, strlen(cases[i].above), cases[i].below,
                                      strlen(cases[i].below), &value, &exact));
        assert_true(value == cases[i].value);
        assert_int_equal(exact, cases[i].exact);
    }
    put_long(above, sizeof above, "9", 340);
    put_long(below, sizeof below, "2", 340);
    assert_true(sli_fraction_read(above, strlen(above), below, strlen(below), &value, &exact));
    assert_true(value == 4.5 && exact);
    snprintf(text, sizeof text, "3 0 0 %s/%s 0 0 1/3", above, below);
    assert_ok(context, read(context, text, &map));
    assert_true(sl_map_bounds(&map).max.x == 4.5 && sl_map_bounds(&map).max.y == 1.0 / 3);
    sl_map_destroy(context, &map);
    assert_false(sli_fraction_read("1", 1, "0", 1, &value, &exact));
    assert_false(sli_fraction_read("", 0, "1", 1, &value, &exact));
    assert_false(sli_fraction_read("1.5", 3, "1", 1, &value, &exact));
    sl_context_destroy(context);
}

static void test_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "p.pol: expected the number of corners"},
        {"2 0 0 1 1", "p.pol:1: expected the number of corners, at least 3, found '2'"},
        {"3.5 0 0 1 1", "found '3.5'"},
        {"99 0 0 1 1", "the file is too short for 99 corners"},
        {"3 0 0 1 0\n1", "p.pol:2: the file ends before the last coordinate"},
        {"3 0 0 1 0\n1 a/2", "p.pol:2: expected a number or a fraction such as 3/4, found 'a/2'"},
        {"3 0 0 1 0\n1 1/0", "found '1/0'"},
        {"3 0 0 1 0\n1 1/", "found '1/'"},
        {"3 0 0 1 0\n1 1e151", "out of range"},
        {"3 0 0 1 0\n1 1e200/1", "out of range"},
        {"3 0 0 1 0 1 1 -1", "expected the number of holes, at least 0, found '-1'"},
        {"3 0 0 1 0 1 1 0 7", "expected the end of the file, found '7'"},
        {"3 0 0 1 0 1 1 1 ", "the file is too short for 1 holes"},
        {"4 0 0 1 1 1 0 0 1", "p.pol:1"}, // it crosses itself
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0};
        assert_int_equal(read(context, cases[i].text, &map), SL_BAD_INPUT);
        if (!strstr(sl_context_message(context), cases[i].message))
            fail_msg("'%s' has no '%s'", sl_context_message(context), cases[i].message);
        assert_int_equal(map.wall_count, 0);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_read),
        cmocka_unit_test(test_long_fractions),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
