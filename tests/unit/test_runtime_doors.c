// What the runtime reads of the things of a map: doors by name, starts, objects, paths, mirrors; of
// files before 2.0, which have no sections for them, from the map text.
#include "runtime_maps.h"
#include "slv_file.h"

#include "sightline/support.h"

#include <math.h>

static void the_doors_are_the_same(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    const sl_map *map = &f->baked.map;
    const sl_space *s = &f->baked.space;
    assert_int_equal(r->door_count, map->door_count);
    for (uint32_t i = 0; i < r->door_count; i++) {
        const sl_runtime_name name = sl_runtime_door_name(r, i);
        sl_runtime_segment segments[16];
        uint32_t count = 0;
        assert_int_equal(name.length, strlen(map->doors[i].name));
        assert_memory_equal(name.text, map->doors[i].name, name.length);
        assert_int_equal(sl_runtime_door_open(r, i), map->doors[i].open);
        // Numbered alike. An old file does not tell: all are plain there.
        assert_int_equal(sl_runtime_get_door_kind(r, i), r->text ? 0 : map->doors[i].kind);
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

static bool same_name(sl_runtime_name name, const char *text) {
    return name.length == strlen(text) && memcmp(name.text, text, name.length) == 0;
}

static void the_objects_and_paths_are_the_same(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    const sl_map *map = &f->baked.map;
    sl_runtime_name name = {"", 0};
    sl_runtime_segment box = {1, 2, 3, 4};
    uint32_t count = 7;
    assert_int_equal(r->object_count, map->object_count);
    for (uint32_t i = 0; i < r->object_count; i++) {
        const sl_box *is = &map->objects[i].box;
        assert_true(sl_runtime_object(r, i, &name, &box));
        assert_true(same_name(name, map->objects[i].name));
        assert_true(box.x0 == is->min.x && box.y0 == is->min.y && box.x1 == is->max.x &&
                    box.y1 == is->max.y);
    }
    assert_int_equal(r->path_count, map->path_count);
    for (uint32_t i = 0; i < r->path_count; i++) {
        const sl_path *is = &map->paths[i];
        double points[64];
        assert_true(sl_runtime_path(r, i, &name, &count));
        assert_true(same_name(name, is->name) && count == is->count && count <= 32);
        sl_runtime_path_points(r, i, points);
        for (uint32_t k = 0; k < count; k++)
            assert_true(points[2 * k] == is->points[k].x && points[2 * k + 1] == is->points[k].y);
    }
    box = (sl_runtime_segment){1, 2, 3, 4};
    count = 7;
    assert_false(sl_runtime_object(r, r->object_count, &name, &box));
    assert_false(sl_runtime_path(r, UINT32_MAX, &name, &count));
    sl_runtime_path_points(r, r->path_count, NULL);
    assert_true(box.x0 == 1 && count == 7);
}

static void the_mirrors_are_the_same(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    const sl_map *map = &f->baked.map;
    sl_runtime_segment at;
    bool one_sided;
    assert_int_equal(r->mirror_count, map->mirror_count);
    assert_int_equal(r->mirrors != SL_RUNTIME_NO_MIRRORS, map->mirror_count > 0);
    for (uint32_t i = 0; i < r->mirror_count; i++) {
        const sl_segment *is = &map->mirrors[i].segment;
        assert_true(sl_runtime_mirror(r, i, &at, &one_sided));
        assert_true(at.x0 == is->a.x && at.y0 == is->a.y && at.x1 == is->b.x && at.y1 == is->b.y);
        assert_int_equal(one_sided, map->mirrors[i].one_sided);
    }
    assert_false(sl_runtime_mirror(r, r->mirror_count, &at, &one_sided));
}

/// As a program before 2.0 wrote it: no reader looks for the sections then.
static void as_old(baked_file *f) {
    memcpy(slv_entry(f->bytes, "MAPI"), "????", 4);
    slv_seal(f->bytes, f->size);
    baked_file_open(f);
    assert_non_null(f->runtime.text);
}

static void old_files_have_the_same(const baked_file *f) {
    baked_file old = *f;
    sl_baked back = {0};
    sl_context *context = testing_context(NULL);
    old.bytes = malloc(f->size);
    assert_non_null(old.bytes);
    memcpy(old.bytes, f->bytes, f->size);
    as_old(&old);
    the_doors_are_the_same(&old);
    the_starts_are_the_same(&old);
    assert_true(old.runtime.range == f->runtime.range);
    assert_int_equal(old.runtime.mirrors, f->runtime.mirrors);
    assert_int_equal(old.runtime.object_count, 0);
    assert_ok(context, sl_baked_parse(context, "old", old.bytes, old.size, &back));
    assert_true(back.map.source.transform.scale == 0);
    sl_baked_destroy(context, &back);
    sl_context_destroy(context);
    free(old.bytes);
}

/// What the library reads back are the things of the map that was written.
static void the_library_reads_the_same(const baked_file *f) {
    sl_baked back = {0};
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_baked_parse(context, "new", f->bytes, f->size, &back));
    assert_memory_equal(&back.map.source.transform.origin, &f->baked.map.source.transform.origin,
                        sizeof(sl_point));
    assert_true(back.map.source.transform.scale == f->baked.map.source.transform.scale);
    sl_baked_destroy(context, &back);
    sl_context_destroy(context);
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
    baked_file_each(the_objects_and_paths_are_the_same);
    baked_file_each(the_mirrors_are_the_same);
    baked_file_each(the_library_reads_the_same);
    baked_file_each(old_files_have_the_same);
}

static void all_things(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(
        context, "walls 0 0 9 0 9 9 0 9 0 0\nmirror 2 2 2 5 one\nmirror 5 2 5 -0 \nrange 0.1\n"
                 "object crate -0 1 2 2.5\nobject t\xc3\xbcr 1 1 1 1\npath p 1 1\n"
                 "path q 1 1 1e-200 3 5e149 1e150\npath q 4 -0\ndoor d 6 0 6 9 shut\n"
                 "start -0 1e-300 -1e300\n");
    f.baked.map.source.transform = (sl_transform){{3, -4e149}, 1e-150, true};
    f.baked.map.mirrors[1].segment.a.x = f.baked.map.paths[1].points[0].y = 1e-200; // not of a text
    free(f.bytes);
    f.bytes = baked_bytes(context, &f.baked, &f.size);
    f.baked.map.mirrors[1].segment.a.x = f.baked.map.paths[1].points[0].y = 0;
    baked_file_open(&f);
    assert_true(f.runtime.transform.origin_y == -4e149 && f.runtime.transform.scale == 1e-150);
    assert_true(f.runtime.transform.origin_x == 3 && f.runtime.transform.y_down);
    the_doors_are_the_same(&f);
    the_starts_are_the_same(&f);
    the_objects_and_paths_are_the_same(&f);
    the_mirrors_are_the_same(&f);
    the_library_reads_the_same(&f);
    old_files_have_the_same(&f);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
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
    assert_int_equal(open_with(&f, "door front", "dour front"), SL_RUNTIME_OK); // not read
    as_old(&f);
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
        memcpy(slv_entry(f.bytes, "MAPI"), "NONE", 4);
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
        cmocka_unit_test(every_map_has_the_same),  cmocka_unit_test(all_things),
        cmocka_unit_test(doors_are_found_by_name), cmocka_unit_test(a_damaged_text_is_refused),
        cmocka_unit_test(a_missing_text_is_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
