// Readers, the cleaning and the writers, with an allocator that gives out after N calls.
#include "testing.h"

#include "io/io_formats.h"
#include "map/plans.h"
#include "map/scan.h"
#include "map/source.h"
#include "map_same.h"
#include "sightline/io.h"

static const char text[] =
    "sightline 1\n#! note\n#! and more\n# room\nwalls 0 0 9 0 9 9 0 9 0 0 # end\n"
    "wall 0 0 9 0\nwall 3 0 3 9\nwall 0 3 9 3\nwall 0 0 4 4\n"
    "wall 0 1 1 1\nwall 0 2 1 2\nwall 0 4 1 4\nwall 0 5 1 5\n"
    "door a 0 0 0 1 open\ndoor b 1 0 1 1 shut\nmirror 0 0 1 0\nmirror 2 0 3 0 one\n"
    "oneway 0 0 1 0\nseam 0 0 1 0\nrange 5\nstart 1 1 0\npath p 1 1 2 2 3 3\n"
    "path q 1 1\nobject o 1 1 2 2\nobject r 1 1 2 2\n";
static const char cells[] = "sightline 1\nwall 0 0 1 0\nsnap 0.5\ncell 0 0 1 0 1 1\n";
static const char plan[] = "#########\n#...#...#\n#.#.+.#.#\n#...#.@.#\n##+###+##\n#.......#\n"
                           "#########\n";
static const char model[] = "{ note }\nv a 0 0 0;v b 2 0 0;v c 2 3 0;v d 0 3 0;v A 0 0 4;"
                            "v B 2 0 4;v C 2 3 4;v D 0 3 4;f s (a b B A);f e (b c C B);"
                            "f n (c d D C);f w (d a A D);{ last }";
// The table of vertices starts with room for 32.
static char large_model[4000];

// Rooms with a window between them, a mirror, a start; in degrees.
static const char geojson[] =
    "{\"type\": \"FeatureCollection\", \"features\": ["
    "{\"type\": \"Feature\", \"properties\": {\"kind\": \"wall\", \"level\": \"0\"}, \"geometry\": "
    "{"
    "\"type\": \"Polygon\", \"coordinates\": [[[8.54,47.37],[8.5401,47.37],[8.5401,47.3701],"
    "[8.54,47.3701],[8.54,47.37]]]}},"
    "{\"type\": \"Feature\", \"properties\": {\"kind\": \"door\"}, \"geometry\": {"
    "\"type\": \"LineString\", \"coordinates\": [[8.54002,47.37],[8.54003,47.37]]}},"
    "{\"type\": \"Feature\", \"properties\": {\"kind\": \"mirror\"}, \"geometry\": {"
    "\"type\": \"LineString\", \"coordinates\": [[8.54002,47.37005],[8.54003,47.37005]]}},"
    "{\"type\": \"Feature\", \"properties\": {\"kind\": \"start\", \"heading\": 90}, \"geometry\": "
    "{"
    "\"type\": \"Point\", \"coordinates\": [8.54002,47.37002]}}]}";

typedef sl_status work(sl_context *context, sl_map *map);

static sl_status read_text(sl_context *context, sl_map *map) {
    return sli_map_read_text(context, "t", text, sizeof text - 1, map);
}

static sl_status read_cells(sl_context *context, sl_map *map) {
    return sli_map_read_text(context, "t", cells, sizeof cells - 1, map);
}

static sl_status read_plan(sl_context *context, sl_map *map) {
    return sli_map_read_plan(context, "t", plan, sizeof plan - 1, map);
}

static sl_status read_model(sl_context *context, sl_map *map) {
    const sl_import_options options = {.has_slice = true, .slice = 1};
    return sli_map_read_unigrafix(context, "t", model, sizeof model - 1, &options, map);
}

static sl_status read_large_model(sl_context *context, sl_map *map) {
    const sl_import_options options = {.has_slice = true, .slice = 1};
    return sli_map_read_unigrafix(context, "t", large_model, strlen(large_model), &options, map);
}

static sl_status read_geojson(sl_context *context, sl_map *map) {
    const sl_import_options options = {.doors = true};
    return sli_map_read_geojson(context, "t", geojson, sizeof geojson - 1, &options, map);
}

static sl_status read_level(sl_context *context, sl_map *map) {
    const sl_import_options options = {.map = "0"};
    return sli_map_read_geojson(context, "t", geojson, sizeof geojson - 1, &options, map);
}

/// Two plans of four rooms each, side by side.
static sl_status read_sheet(sl_context *context, sl_map *map) {
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            const double x = 20 * i, at = 5 * k;
            SL_TRY(sl_map_add_wall(context, map, (sl_point){x + at, 0}, (sl_point){x + at, 10}, 0));
            SL_TRY(sl_map_add_wall(context, map, (sl_point){x, at}, (sl_point){x + 10, at}, 0));
        }
    return SL_OK;
}

static sl_status read_file(sl_context *context, sl_map *map) {
    return sl_map_read(context, SIGHTLINE_SOURCE_DIR "/maps/dungeon.txt", NULL, map);
}

/// Runs with the Nth call failing and all after it, until there are enough; the map and all memory
/// must be as before each time. Gives how many calls were needed.
static long fail_at_each_call(work *run) {
    for (long fail_at = 2;; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        memory.fail_at = fail_at;
        sl_map map = {0};
        const sl_status status = run(context, &map);
        if (status == SL_OK) {
            assert_false(map_is_empty(&map));
        } else {
            assert_int_equal(status, SL_NO_MEMORY);
            assert_string_equal(sl_context_message(context), "out of memory");
            assert_true(map_is_empty(&map));
            assert_int_equal(memory.live, 1);
        }
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        if (status == SL_OK) return fail_at - 2;
    }
}

static void test_readers(void **state) {
    (void)state;
    char *end = large_model;
    for (int i = 0; i < 100; i++) end += sprintf(end, "v a%d %d %d %d;", i, i % 2, i, i % 3);
    sprintf(end, "f f (a0 a1 a2);");
    assert_true(fail_at_each_call(read_text) > 15);
    assert_true(fail_at_each_call(read_plan) > 8);
    assert_true(fail_at_each_call(read_model) > 5);
    assert_true(fail_at_each_call(read_large_model) > 8);
    assert_true(fail_at_each_call(read_file) > 4);
    assert_true(fail_at_each_call(read_geojson) > 8);
    assert_true(fail_at_each_call(read_level) > 8);
}

/// Runs on a map that is there already, which must stay as it was.
static void fail_on_map(work *read, work *run) {
    for (long fail_at = 1;; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        sl_map map = {0}, kept = {0};
        assert_ok(context, read(context, &map));
        assert_ok(context, read(context, &kept));
        const long live = memory.live;
        memory.fail_at = memory.calls + fail_at;
        const sl_status status = run(context, &map);
        if (status != SL_OK) {
            assert_int_equal(status, SL_NO_MEMORY);
            assert_true(map_same(&map, &kept));
            assert_int_equal(memory.live, live);
        }
        sl_map_destroy(context, &map);
        sl_map_destroy(context, &kept);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        if (status != SL_OK) continue;
        assert_true(fail_at > 1);
        return;
    }
}

static sl_status clean(sl_context *context, sl_map *map) {
    return sl_map_clean(context, map, NULL, NULL);
}

/// As a drawing's: the planar graph is made, and not taken where nothing moves.
static sl_status clean_drawing(sl_context *context, sl_map *map) {
    map->precision = 1e-4;
    return sl_map_clean(context, map, NULL, NULL);
}

static sl_status print_plan(sl_context *context, sl_map *map) {
    sl_status status;
    free(map_plan_text(context, map, &status));
    return status;
}

static sl_status write_text(sl_context *context, sl_map *map) {
    char path[] = "/tmp/sightline-memory-XXXXXX";
    assert_true(mkstemp(path) >= 0);
    const sl_status status = sl_map_write(context, map, NULL, path);
    assert_int_equal(remove(path), 0);
    return status;
}

static sl_status write_plan(sl_context *context, sl_map *map) {
    char path[] = "/tmp/sightline-memory-XXXXXX";
    assert_true(mkstemp(path) >= 0);
    size_t count;
    const sl_map_format *format = &sl_map_formats(context, &count)[1];
    const sl_status status = sl_map_write(context, map, format, path);
    assert_int_equal(remove(path), 0);
    return status;
}

static sl_status add_note(sl_context *context, sl_map *map) {
    return sli_map_add_note(context, map, "one more");
}

static sl_status add_path(sl_context *context, sl_map *map) {
    return sl_map_add_path(context, map, "one_more", &(sl_point){1, 2}, 1, 0);
}

static sl_status crop(sl_context *context, sl_map *map) {
    return sl_map_crop(context, map, (sl_box){{1.5, 1.5}, {7, 5}}, NULL);
}

static sl_status find_plans(sl_context *context, sl_map *map) {
    sli_sheet sheet;
    const sl_status status = sli_sheet_find(context, map, &sheet);
    if (status == SL_OK) assert_int_equal(sheet.count, 2);
    return status;
}

static sl_status copy(sl_context *context, sl_map *map) {
    sl_map other = {0};
    const sl_status status = sl_map_copy(context, map, &other);
    if (status == SL_OK)
        assert_true(map_same(map, &other));
    else
        assert_true(map_is_empty(&other));
    sl_map_destroy(context, &other);
    return status;
}

static void test_others(void **state) {
    (void)state;
    fail_on_map(read_text, copy);
    fail_on_map(read_cells, copy);
    fail_on_map(read_text, clean);
    fail_on_map(read_plan, clean);
    fail_on_map(read_plan, clean_drawing);
    fail_on_map(read_plan, print_plan);
    fail_on_map(read_text, write_text);
    fail_on_map(read_plan, write_plan);
    fail_on_map(read_text, crop);
    fail_on_map(read_plan, crop);
    fail_on_map(read_sheet, find_plans);
    fail_on_map(read_text, add_note);
    fail_on_map(read_text, add_path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_readers),
        cmocka_unit_test(test_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
