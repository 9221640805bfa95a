// What the runtime reads of the map text in a file: doors by name, and starts.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime_maps.h"
#include "slv_file.h"

#include "sightline/support.h"

#include <math.h>

static void the_doors_are_the_same(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    const sl_map *map = &f->baked.map;
    const sl_space *s = &f->baked.space;
    assert_true(r->door_count <= map->door_count);
    for (uint32_t i = 0; i < r->door_count; i++) {
        const sl_runtime_name name = sl_runtime_door_name(r, i);
        sl_runtime_segment segments[16];
        uint32_t count = 0;
        assert_int_equal(name.length, strlen(map->doors[i].name));
        assert_memory_equal(name.text, map->doors[i].name, name.length);
        assert_int_equal(sl_runtime_door_open(r, i), map->doors[i].open);
        const uint32_t first = sl_runtime_find_door(r, map->doors[i].name);
        assert_true(first <= i && strcmp(map->doors[first].name, map->doors[i].name) == 0);
        const uint32_t found = sl_runtime_door_segments(r, i, segments, 16);
        for (uint32_t k = 0; k < s->seam_count; k++) {
            if (s->seams[k].kind != SL_SEAM_DOOR || s->seams[k].number != i) continue;
            assert_memory_equal(&segments[count], &s->seams[k].at, sizeof *segments);
            count++;
        }
        assert_int_equal(found, count);
    }
}

static void the_starts_are_the_same(const baked_file *f) {
    const sl_map *map = &f->baked.map;
    assert_int_equal(sl_runtime_start_count(&f->runtime), map->start_count);
    for (uint32_t i = 0; i < map->start_count; i++) {
        const sl_start *is = &map->starts[i];
        sl_runtime_viewpoint said = {0};
        assert_true(sl_runtime_start(&f->runtime, i, &said));
        assert_true(said.x == is->at.x && said.y == is->at.y && said.heading == is->heading);
    }
    sl_runtime_viewpoint none = {1, 2, 3};
    assert_false(sl_runtime_start(&f->runtime, (uint32_t)map->start_count, &none));
    assert_false(sl_runtime_start(&f->runtime, UINT32_MAX, &none));
    assert_true(none.x == 1 && none.y == 2 && none.heading == 3);
}

static void solid_ground_is_the_same(const baked_file *f) {
    for (uint32_t i = 0; i < f->runtime.cell_count; i++)
        assert_int_equal(sl_runtime_is_solid(&f->runtime, i), f->baked.space.cells[i].solid);
    assert_false(sl_runtime_is_solid(&f->runtime, f->runtime.cell_count));
    assert_false(sl_runtime_is_solid(&f->runtime, SL_RUNTIME_NO_CELL));
}

static void every_map_has_the_same(void **state) {
    (void)state;
    baked_file_each(the_doors_are_the_same);
    baked_file_each(the_starts_are_the_same);
    baked_file_each(solid_ground_is_the_same);
}

static void doors_are_found_by_name(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f =
        baked_file_of_text(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 2\nwall 4 5 4 9\n"
                                    "door front 4 2 4 3\ndoor t\xc3\xbcr 4 3 4 4 shut # shut\n"
                                    "door front 4 4 4 5 shut\nstart 1.5 2 -90\nstart 8 8 1e-3\n");
    const sl_runtime *r = &f.runtime;
    sl_runtime_segment at[2] = {{0, 0, 0, 0}, {7, 7, 7, 7}};
    assert_int_equal(r->door_count, 3);
    assert_int_equal(sl_runtime_find_door(r, "front"), 0);
    assert_int_equal(sl_runtime_find_door(r, "t\xc3\xbcr"), 1);
    assert_int_equal(sl_runtime_find_door(r, "fron"), SL_RUNTIME_NO_DOOR);
    assert_int_equal(sl_runtime_find_door(r, "front2"), SL_RUNTIME_NO_DOOR);
    assert_int_equal(sl_runtime_find_door(r, ""), SL_RUNTIME_NO_DOOR);
    assert_true(sl_runtime_door_open(r, 0));
    assert_false(sl_runtime_door_open(r, 1));
    assert_false(sl_runtime_door_open(r, 2));
    assert_int_equal(sl_runtime_door_segments(r, 1, at, 1), 1);
    assert_true(at[0].x0 == 4 && at[0].y0 == 3 && at[0].x1 == 4 && at[0].y1 == 4);
    assert_true(at[1].x0 == 7);
    assert_int_equal(sl_runtime_door_segments(r, 1, NULL, 0), 1);
    for (uint32_t none = 3; none; none = none == 3 ? UINT32_MAX : 0) {
        assert_int_equal(sl_runtime_door_name(r, none).length, 0);
        assert_false(sl_runtime_door_open(r, none));
        assert_int_equal(sl_runtime_door_segments(r, none, at, 2), 0);
    }
    the_doors_are_the_same(&f);
    the_starts_are_the_same(&f);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

// --- numbers

static bool reads(const char *text, double *value) {
    slrt_text line = {(const unsigned char *)text, (const unsigned char *)text + strlen(text)};
    return slrt_take_number(&line, false, value);
}

static void same_number(const char *text) {
    double is, said = NAN;
    const bool finite = sl_number_read(text, strlen(text), &is) && isfinite(is);
    if (reads(text, &said) != finite || (finite && memcmp(&is, &said, sizeof is) != 0))
        fail_msg("%s is read as %.17g", text, said);
}

static void numbers_are_read_to_the_last_bit(void **state) {
    (void)state;
    static const char *const hard[] = {"0",
                                       "-0",
                                       "+.5",
                                       "5.",
                                       ".",
                                       "-",
                                       "",
                                       "e5",
                                       "1e",
                                       "1e+",
                                       "1.2.3",
                                       "0x1",
                                       "inf",
                                       "nan",
                                       "1e308",
                                       "1.7976931348623157e308",
                                       "1.7976931348623158e308",
                                       "1.7976931348623159e308",
                                       "1e309",
                                       "1e99999999999",
                                       "0e99999999999",
                                       "1e-99999999999",
                                       "4.9e-324",
                                       "2.4703282292e-324",
                                       "2.4703282292062328e-324",
                                       "2.2250738585072011e-308",
                                       "2.2250738585072014e-308",
                                       "9007199254740993",
                                       "9007199254740992.9999",
                                       "9007199254740993.00000000000000000000000001",
                                       "0.1",
                                       "1e22",
                                       "1e23",
                                       "8.5e-5",
                                       "123456789012345678901234567890",
                                       "-1.5E+3",
                                       "1,5"};
    char text[600];
    sl_random random = {17};
    for (size_t i = 0; i < sizeof hard / sizeof *hard; i++) same_number(hard[i]);
    for (int length = 490; length < 520; length++) {
        double value;
        memset(text, '3', (size_t)length);
        memcpy(text + length, "e-505", 6);
        if (length + 5 < 512)
            same_number(text);
        else
            assert_false(reads(text, &value));
        text[length] = '\0';
        assert_false(reads(text, &value));
    }
    for (int i = 0; i < 20000; i++) {
        const uint64_t bits = sl_random_next(&random);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) continue;
        snprintf(text, sizeof text, "%.*g", 1 + (int)sl_random_below(&random, 20), value);
        same_number(text);
        // A tie between two doubles, written to its last digit.
        const double whole = (double)(bits >> 12) + 0x1p52;
        snprintf(text, sizeof text, "%.0f.5", whole);
        same_number(text);
    }
}

// --- damage

static sl_runtime_status open_with(const baked_file *f, const char *from, const char *to) {
    char *bytes = malloc(f->size), *at;
    sl_runtime r;
    assert_non_null(bytes);
    assert_int_equal(strlen(from), strlen(to));
    memcpy(bytes, f->bytes, f->size);
    at = slv_items(bytes, "MAPT");
    while (at + strlen(from) < bytes + f->size && memcmp(at, from, strlen(from)) != 0) at++;
    assert_true(at + strlen(from) < bytes + f->size);
    memcpy(at, to, strlen(to));
    slv_seal(bytes, f->size);
    const sl_runtime_status status = sl_runtime_open(bytes, f->size, &r);
    free(bytes);
    return status;
}

static void a_damaged_text_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(
        context, "walls 0 0 9 0 9 9 0 9 0 0\ndoor front 4 0 4 9\nrange 12.5\nstart 1.5 2 90\n");
    assert_int_equal(open_with(&f, "start", "start"), SL_RUNTIME_OK);
    assert_int_equal(open_with(&f, "start 1.5", "start 1x5"), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "start 1.5 2", "start 9e150"), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "1.5 2 90", "1.5 2   "), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "1.5 2 90", "1 1e999 "), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "1.5 2 90", "1 3e150 "), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "1.5 2 90", "1.5 2 #9"), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "door front", "dour front"), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "door front", "door #ront"), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "range 12.5", "range  2.5"), SL_RUNTIME_OK);
    assert_int_equal(open_with(&f, "range 12.5", "range 0000"), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "range 12.5", "range -2.5"), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "range 12.5", "range     "), SL_RUNTIME_TEXT);
    assert_int_equal(open_with(&f, "start", "stars"), SL_RUNTIME_OK); // another statement
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// A file without the section has no doors and starts. With doors, it is damaged.
static void a_missing_text_is_empty(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int doors = 0; doors < 2; doors++) {
        baked_file f =
            baked_file_of_text(context, doors ? "walls 0 0 9 0 9 9 0 9 0 0\ndoor front 4 0 4 9\n"
                                              : "walls 0 0 9 0 9 9 0 9 0 0\nstart 1 2 3\n");
        char *entry = slv_entry(f.bytes, "MAPT");
        assert_non_null(entry);
        memcpy(entry, "NONE", 4);
        slv_seal(f.bytes, f.size);
        sl_runtime r;
        const sl_runtime_status status = sl_runtime_open(f.bytes, f.size, &r);
        assert_int_equal(status, doors ? SL_RUNTIME_TEXT : SL_RUNTIME_OK);
        if (!doors) assert_int_equal(sl_runtime_start_count(&r), 0);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_map_has_the_same),
        cmocka_unit_test(doors_are_found_by_name),
        cmocka_unit_test(numbers_are_read_to_the_last_bit),
        cmocka_unit_test(a_damaged_text_is_refused),
        cmocka_unit_test(a_missing_text_is_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
