// Numbers that are 0 but for 1e-300: every reader takes them as 0, and so do the functions that add
// things to a map. Numbers that are too large stay errors.
#include "testing.h"

#include "sightline/io.h"
#include "sightline/support.h"

#include <math.h>

/// A room of 4 x 4 with one corner at (T, T) in each text format that has coordinates. '~' stands
/// for T, which is too small for a coordinate, or too small for a double.
static const struct {
    const char *name, *text;
} files[] = {
    {"a.map", "sightline 1\nwalls ~ ~ 4 ~ 4 4 ~ 4 ~ ~\nstart 1 1 ~\nobject o ~ ~ 1 1\n"
              "path p ~ 1 2 2\nsolid 1 1 2 ~ 2 2\ndoor d ~ 1 4 1\n"},
    {"a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\" height=\"4\">"
              "<path d=\"M ~ ~ L 4 ~ L 4 4 L ~ 4 Z\"/></svg>"},
    {"a.dxf",
     "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n~\n20\n~\n11\n4\n21\n~\n0\nENDSEC\n0\nEOF\n"},
    {"a.ug", "v a ~ ~ 0;\nv b 4 ~ 0;\nv c 4 ~ 2;\nv d ~ ~ 2;\nf (a b c d);\n"},
    {"a.tmx",
     "<map orientation=\"orthogonal\" width=\"1\" height=\"1\" tilewidth=\"4\" tileheight=\"4\">"
     "<objectgroup name=\"walls\"><object id=\"1\" x=\"~\" y=\"~\">"
     "<polyline points=\"~,~ 4,~\"/></object></objectgroup></map>"},
    {"a.uvtt",
     "{\"resolution\": {\"map_size\": {\"x\": 4, \"y\": 4}, \"pixels_per_grid\": 70},"
     " \"line_of_sight\": [[{\"x\": ~, \"y\": ~}, {\"x\": 4, \"y\": ~}]], \"portals\": []}"},
    {"a.json", "{\"walls\": [{\"c\": [~, ~, 4, ~], \"move\": 20}], \"padding\": 0, \"height\": 4}"},
};

/// The text with `value` in place of each '~', for free().
static char *with(const char *text, const char *value) {
    char *out = calloc(strlen(text) * (strlen(value) + 1) + 1, 1);
    assert_non_null(out);
    for (size_t used = 0; *text; text++) {
        if (*text == '~') used += (size_t)sprintf(out + used, "%s", value);
        if (*text != '~') out[used++] = *text;
    }
    return out;
}

static sl_status read_with(sl_context *context, size_t i, const char *value, sl_map *map) {
    char *text = with(files[i].text, value);
    sl_import_options options = sl_import_options_default();
    options.slice = 1;
    options.has_slice = strcmp(files[i].name, "a.ug") == 0;
    options.layers = strcmp(files[i].name, "a.tmx") == 0 ? "walls" : NULL;
    const sl_status status =
        sl_map_parse(context, files[i].name, text, strlen(text), &options, map);
    free(text);
    return status;
}

static void test_files(void **state) {
    (void)state;
    static const char *const small[] = {"1e-300", "-1e-151", "4.9e-324", "1e-999"};
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_io_use(context));
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        sl_map zero = {0};
        assert_ok(context, read_with(context, i, "0", &zero));
        assert_true(zero.wall_count > 0);
        for (size_t k = 0; k < sizeof small / sizeof *small; k++) {
            sl_map map = {0};
            if (read_with(context, i, small[k], &map) != SL_OK)
                fail_msg("%s: %s", small[k], sl_context_message(context));
            assert_int_equal(map.wall_count, zero.wall_count);
            for (size_t w = 0; w < map.wall_count; w++)
                assert_true(testing_same_point(map.walls[w].a, zero.walls[w].a) &&
                            testing_same_point(map.walls[w].b, zero.walls[w].b));
            sl_map_destroy(context, &map);
        }
        // Drawings pass over a shape that is too far away; other files are refused.
        const bool drawing = strstr(files[i].name, ".svg") || strstr(files[i].name, ".dxf");
        static const char *const large[] = {"1e300", "1e999"};
        for (size_t k = 0; k < sizeof large / sizeof *large; k++) {
            sl_map far = {0};
            const sl_status status = read_with(context, i, large[k], &far);
            assert_true(status == SL_BAD_INPUT || (drawing && status == SL_OK));
            assert_true(far.wall_count < zero.wall_count);
            sl_map_destroy(context, &far);
        }
        sl_map_destroy(context, &zero);
    }
    sl_context_destroy(context);
}

static void test_functions(void **state) {
    (void)state;
    const double t = 1e-300;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    const sl_point a = {t, -t}, b = {4, t}, corners[] = {{t, t}, {4, t}, {4, 4}};
    const sl_segment at = {a, b};
    assert_ok(context, sl_map_add_wall(context, &map, a, b, 0));
    assert_ok(context, sl_map_add_door(context, &map, "d", at, true, 0));
    assert_ok(context, sl_map_add_mirror(context, &map, at, 0));
    assert_ok(context, sl_map_add_oneway(context, &map, at, 0));
    assert_ok(context, sl_map_add_seam(context, &map, at, 0));
    assert_ok(context, sl_map_add_start(context, &map, a, t, 0));
    assert_ok(context, sl_map_add_path(context, &map, "p", corners, 3, 0));
    assert_ok(context, sl_map_add_object(context, &map, "o", (sl_box){{t, t}, {1, 1}}, 0));
    assert_ok(context, sl_map_add_solid(context, &map, corners, 3, 0));
    assert_ok(context, sl_map_add_cell(context, &map, corners, 3, 0));
    const sl_point zero = {0, 0};
    const sl_point points[] = {map.walls[0].a,   map.doors[0].segment.a, map.mirrors[0].segment.a,
                               map.walls[1].a,   map.seams[0].segment.a, map.oneways[0].segment.a,
                               map.starts[0].at, map.paths[0].points[0], map.objects[0].box.min,
                               map.corners[0]};
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        assert_true(testing_same_point(points[i], zero));
    const size_t walls = map.wall_count;
    const double bad[] = {1e151, -1e300, INFINITY, NAN};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const sl_point out[] = {{bad[i], 0}, {1, 0}, {0, 1}};
        assert_int_equal(sl_map_add_wall(context, &map, out[0], b, 0), SL_BAD_ARGUMENT);
        assert_int_equal(sl_map_add_solid(context, &map, out, 3, 0), SL_BAD_ARGUMENT);
        assert_int_equal(sl_map_add_path(context, &map, "q", out, 3, 0), SL_BAD_ARGUMENT);
        assert_int_equal(sl_map_add_cell(context, &map, out, 3, 0), SL_BAD_ARGUMENT);
    }
    assert_int_equal(map.wall_count, walls);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// All digits of a double without an exponent.
static void test_long_decimals(void **state) {
    (void)state;
    static const double values[] = {0x1p-1074, 0x1.fffffffffffffp-1022, 1e-300,
                                    0x1.fffffffffffffp1023};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char text[2048];
        double back = 0;
        const int length = snprintf(text, sizeof text, "%.1074f", values[i]);
        assert_true(sl_number_read(text, (size_t)length, &back));
        assert_true(back == values[i]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_functions),
        cmocka_unit_test(test_long_decimals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
