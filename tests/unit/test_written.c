// What is written can be read: writers read back their file before it takes its place. The files of
// random maps, cleaned with large tolerances, are read again; what cannot be read is not written.
#include "testing.h"

#include "map/scan.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <sys/stat.h>
#include <unistd.h>

enum { SPAN = 12 };

static char folder[64], target[128];

static int make_folder(void **state) {
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/test_written.XXXXXX");
    return mkdtemp(folder) ? 0 : 1;
}

static int remove_folder(void **state) {
    (void)state;
    return rmdir(folder);
}

static const char *in_folder(const char *name) {
    snprintf(target, sizeof target, "%s/%s", folder, name);
    return target;
}

/// The target is there, and nothing beside it; it is removed.
static void assert_alone(void) {
    assert_int_equal(unlink(target), 0);
    if (rmdir(folder) != 0) fail_msg("a file was left in %s", folder);
    assert_int_equal(mkdir(folder, 0700), 0);
}

static void assert_text(sl_context *context, const char *text) {
    sl_bytes bytes;
    assert_ok(context, sl_file_read(context, target, &bytes));
    assert_string_equal(bytes.data, text);
    sl_free(context, bytes.data);
}

static void put_text(const char *text) {
    FILE *stream = fopen(target, "w");
    assert_non_null(stream);
    fputs(text, stream);
    assert_int_equal(fclose(stream), 0);
}

static sl_point any_point(sl_random *random, double step) {
    return (sl_point){step * (double)sl_random_below(random, (uint64_t)(SPAN / step)),
                      step * (double)sl_random_below(random, (uint64_t)(SPAN / step))};
}

static sl_segment any_segment(sl_random *random, double step, bool axial) {
    sl_segment at = {any_point(random, step), any_point(random, step)};
    if (axial && sl_random_below(random, 2))
        at.b.x = at.a.x;
    else if (axial)
        at.b.y = at.a.y;
    if (sl_random_below(random, 3) == 0)
        at.b =
            (sl_point){at.a.x + (axial ? 0 : 0.25), at.a.y + 0.5}; // shorter than many tolerances
    return at;
}

static void fill(sl_context *context, sl_random *random, sl_map *map) {
    const bool axial = sl_random_below(random, 2);
    const double step = sl_random_below(random, 2) ? 1 : 0.25;
    const uint64_t counts[] = {4 + sl_random_below(random, 12), sl_random_below(random, 4),
                               sl_random_below(random, 3),      sl_random_below(random, 3),
                               sl_random_below(random, 3),      sl_random_below(random, 3)};
    for (uint32_t kind = 0; kind < 6; kind++)
        for (uint32_t i = 0; i < counts[kind]; i++) {
            const sl_segment at = any_segment(random, step, axial);
            const sl_point corners[] = {at.a, {at.b.x, at.a.y}, at.b, {at.a.x, at.b.y}};
            char name[16];
            snprintf(name, sizeof name, "d%u", i);
            sl_status status = SL_OK;
            if (kind == 0) status = sl_map_add_wall(context, map, at.a, at.b, i);
            if (kind == 1) status = sl_map_add_door(context, map, name, at, i % 2, i);
            if (kind == 2) status = sl_map_add_mirror(context, map, at, i);
            if (kind == 3) status = sl_map_add_oneway(context, map, at, i);
            if (kind == 4) status = sl_map_add_seam(context, map, at, i);
            assert_ok(context, status);
            // Boxes without area are refused: they are not added.
            if (kind == 5) (void)sl_map_add_solid(context, map, corners, 4, i);
        }
    assert_ok(context, sl_map_add_start(context, map, any_point(random, step), 30, 0));
}

/// Writes it in all formats that read it again by themselves, whatever it holds.
static void write_all(sl_context *context, const sl_map *map) {
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++) {
        if (!formats[i].write || strcmp(formats[i].name, "plan") == 0) continue;
        assert_ok(context, sl_map_write(context, map, &formats[i], in_folder("written")));
        assert_alone();
    }
}

/// Whatever cleaning makes of a map, its files can be read, and baked files too.
static void test_cleaned_maps_can_be_read(void **state) {
    (void)state;
    static const double tolerances[] = {-1, 0, 0.3, 0.6, 1, 2.5};
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_io_use(context));
    sl_random random = {7};
    size_t written = 0, baked_count = 0;
    for (uint64_t i = testing_seeds(150); i > 0; i--) {
        sl_map map = {0};
        sl_baked baked = {0};
        fill(context, &random, &map);
        const sl_clean_options clean = {tolerances[sl_random_below(&random, 6)]};
        // Welding may leave ground that contradicts itself: that is said.
        sl_status status = sl_map_clean(context, &map, &clean, NULL);
        if (status == SL_OK) status = sl_map_settle_ground(context, &map);
        if (status == SL_OK && map.wall_count) {
            write_all(context, &map);
            written++;
            if (sl_bake(context, &map, NULL, &baked, NULL) == SL_OK) {
                sl_baked again = {0};
                assert_ok(context, sl_baked_write(context, &baked, in_folder("written.slv")));
                assert_ok(context, sl_baked_read(context, target, &again));
                assert_alone();
                sl_baked_destroy(context, &again);
                baked_count++;
            }
            sl_baked_destroy(context, &baked);
        }
        sl_map_destroy(context, &map);
    }
    assert_true(written > 10 && baked_count > 10);
    sl_context_destroy(context);
}

static sl_status print_broken(sl_context *context, const sl_map *map, FILE *stream) {
    (void)context, (void)map;
    fputs("sightline 1\ndoor d 1 1 1 1 open\n", stream);
    return SL_OK;
}

/// A writer that prints what its reader refuses: the older file stays, and the message is the
/// reader's.
static void test_older_file_stays(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    size_t count;
    sl_map_format broken = sl_map_formats(context, &count)[0];
    broken.write = print_broken;
    in_folder("a.map");
    put_text("older");
    assert_int_equal(sl_map_write(context, &map, &broken, target), SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(context),
                           "a.map: not written, as it could not be read "
                           "again: "));
    assert_non_null(
        strstr(sl_context_message(context), "a.map:2: door: expected two different ends"));
    assert_text(context, "older");
    assert_alone();
    sl_context_destroy(context);
}

/// The same of a baked file, by its map text.
static void test_baked_file_is_read_back(void **state) {
    (void)state;
    static const char text[] =
        "sightline 1\nwalls 0 0 4 0 4 4 0 4 0 0\ndoor d 2 0 2 4\nstart 1 1 0\n";
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_baked baked = {0}, again = {0};
    assert_ok(context, sli_map_read_text(context, "test", text, strlen(text), &map));
    assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
    assert_ok(context, sl_baked_write(context, &baked, in_folder("a.slv")));
    assert_alone();
    put_text("older");
    baked.map.doors[0].segment.b = baked.map.doors[0].segment.a;
    assert_int_equal(sl_baked_write(context, &baked, target), SL_UNSUPPORTED);
    assert_text(context, "older");
    assert_int_equal(sl_baked_read(context, target, &again), SL_BAD_INPUT);
    assert_alone();
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cleaned_maps_can_be_read),
        cmocka_unit_test(test_older_file_stays),
        cmocka_unit_test(test_baked_file_is_read_back),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
