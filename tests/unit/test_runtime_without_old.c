// The runtime without what it needs for files before 2.0: it refuses these, and reads all others.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#define SL_RUNTIME_WITHOUT_OLD_FILES
#include "runtime_maps.h"
#include "slv_file.h"

#include "sightline/support.h"

static void old_files_are_refused(void **state) {
    (void)state;
    static const char *const names[] = {"askew", "effects", "effects_oblique", "star"};
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < 4; i++) {
        char path[1024];
        sl_bytes file;
        sl_runtime runtime, empty;
        memset(&empty, 0x5a, sizeof empty);
        memcpy(&runtime, &empty, sizeof empty);
        snprintf(path, sizeof path, "%s/tests/old_files/%s.slv", SIGHTLINE_SOURCE_DIR, names[i]);
        assert_ok(context, sl_file_read(context, path, &file));
        assert_int_equal(sl_runtime_open(file.data, file.size, &runtime), SL_RUNTIME_OLD);
        assert_memory_equal(&runtime, &empty, sizeof empty);
        // Damage is still called damage.
        file.data[file.size - 1] ^= 1;
        assert_int_equal(sl_runtime_open(file.data, file.size, &runtime), SL_RUNTIME_CHECKSUM);
        sl_free(context, file.data);
    }
    sl_context_destroy(context);
}

/// An old file that the library writes again is a new one, with all its names.
static void a_file_written_anew_opens(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = {.name = "effects"};
    assert_ok(context, sl_baked_read(context, SIGHTLINE_SOURCE_DIR "/tests/old_files/effects.slv",
                                     &f.baked));
    f.bytes = baked_bytes(context, &f.baked, &f.size);
    baked_file_open(&f);
    const sl_map *map = &f.baked.map;
    assert_int_equal(f.runtime.door_count, map->door_count);
    assert_int_equal(sl_runtime_find_door(&f.runtime, map->doors[0].name), 0);
    assert_int_equal(f.runtime.mirror_count, 2);
    assert_int_equal(f.runtime.start_count, map->start_count);
    assert_true(f.runtime.range == map->range);
    sl_runtime_transform transform; // which nobody knows
    assert_false(sl_runtime_map_transform(&f.runtime, &transform));
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(old_files_are_refused),
        cmocka_unit_test(a_file_written_anew_opens),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
