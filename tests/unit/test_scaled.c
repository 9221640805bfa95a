/// Units that a user measures: "0.5=m" is the length of a unit of the file, of any format.
#include "testing.h"

#include "sightline/import.h"
#include "sightline/io.h"

#include <math.h>

static const char plan[] = "sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\ndoor d 4 10 6 10 open\n"
                           "mirror 1 2 1 4\noneway 3 3 3 5\nseam 0 6 20 6\nrange 7\nentrance 1.5\n"
                           "start 5 5 90\npath p 1 1 2 2\nobject o 4 4 5 5\n"
                           "cell 0 0 5 0 5 5 0 5\nsnap 0.25\n";

static void all_is_scaled(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    options.unit = "0.5=ft";
    assert_ok(context, sl_map_parse(context, "x.map", plan, strlen(plan), &options, &map));
    assert_string_equal(map.unit, "ft");
    const sl_box b = sl_map_bounds(&map);
    assert_true(b.min.x == 0 && b.min.y == 0 && b.max.x == 10 && b.max.y == 5);
    assert_true(map.doors[0].segment.b.x == 3 && map.mirrors[0].segment.b.y == 2);
    assert_true(map.oneways[0].segment.a.x == 1.5 && map.seams[0].segment.b.x == 10);
    assert_true(map.range == 3.5 && map.entrance == 0.75 && map.snap == 0.125);
    assert_true(map.starts[0].at.x == 2.5 && map.starts[0].heading == 90);
    assert_true(map.paths[0].points[1].x == 1 && map.objects[0].box.max.y == 2.5);
    assert_true(map.corners[2].x == 2.5);
    // A place of the map is where it is in the file.
    const sl_transform t = map.source.transform;
    assert_true(t.scale * (3 - t.origin.x) == 6);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void wrong_measures(void **state) {
    static const char *const wrong[] = {"0=m", "-1=m", "2=elephants", "2=", "1e300=m", "x=m"};
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_import_options options = sl_import_options_default();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        sl_map map = {0};
        options.unit = wrong[i];
        assert_int_equal(sl_map_parse(context, "x.map", plan, strlen(plan), &options, &map),
                         SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(context), "--unit"));
        assert_int_equal(map.wall_count, 0);
    }
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

/// Pixels of a picture become metres, and what is measured in a drawing counts in place of the unit
/// that it says.
static void drawings(void **state) {
    static const char svg[] =
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'><g id='walls'>"
        "<path d='M10 0H90V90H0Z'/></g><text x='10' y='20'>Hall</text></svg>";
    static const char pgm[] = "P2 4 2 1 0 1 1 0 0 1 1 0\n";
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    assert_ok(context, sl_io_use(context));
    options.unit = "0.1=m";
    assert_ok(context, sl_map_parse(context, "x.svg", svg, strlen(svg), &options, &map));
    assert_true(fabs(sl_map_bounds(&map).max.x - 9) < 1e-12);
    assert_true(fabs(map.source.texts[0].at.y - 8) < 1e-12);
    sl_map_destroy(context, &map);
    options.unit = "3=m";
    assert_ok(context, sl_map_parse(context, "x.pgm", pgm, strlen(pgm), &options, &map));
    assert_true(sl_map_bounds(&map).max.x <= 12 && sl_map_is_axial(&map));
    assert_string_equal(map.unit, "m");
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_is_scaled),
        cmocka_unit_test(wrong_measures),
        cmocka_unit_test(drawings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
