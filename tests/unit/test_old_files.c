/// Files that older programs made: the library and the runtime read them, and say the same of them.
#include "baked_bytes.h"
#include "runtime_maps.h"
#include "slv_file.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>

static baked_file read_old(sl_context *context, const char *name) {
    char path[1024];
    baked_file f = {.name = name};
    sl_bytes bytes;
    snprintf(path, sizeof path, "%s/tests/old_files/%s", SIGHTLINE_SOURCE_DIR, name);
    assert_ok(context, sl_file_read(context, path, &bytes));
    assert_ok(context, sl_baked_parse(context, name, bytes.data, bytes.size, &f.baked));
    f.bytes = malloc(bytes.size);
    assert_non_null(f.bytes);
    f.size = bytes.size;
    memcpy(f.bytes, bytes.data, bytes.size);
    sl_free(context, bytes.data);
    baked_file_open(&f);
    return f;
}

/// The same, written as this program does it, and read again.
static baked_file written_anew(sl_context *context, const baked_file *old) {
    baked_file f = {.name = old->name};
    f.bytes = baked_bytes(context, &old->baked, &f.size);
    assert_ok(context, sl_baked_parse(context, f.name, f.bytes, f.size, &f.baked));
    baked_file_open(&f);
    return f;
}

static uint32_t version_of(const baked_file *f) {
    return slv_header(f->bytes).version;
}

/// Whether a point is in a cell or on its border, by the library's predicate.
static bool holds(const sl_space *s, uint32_t cell, sl_point p) {
    const sl_cell *c = &s->cells[cell];
    const sl_point *v = s->vertices + c->first_vertex;
    for (uint32_t i = 0; i < c->vertex_count; i++)
        if (sli_orient(v[i], v[(i + 1) % c->vertex_count], p) < 0) return false;
    return true;
}

static void check_place(const baked_file *f, double x, double y) {
    const sl_space *s = &f->baked.space;
    const uint32_t cell = sl_runtime_locate(&f->runtime, x, y);
    const bool within = x >= s->bounds.min.x && x <= s->bounds.max.x && y >= s->bounds.min.y &&
                        y <= s->bounds.max.y;
    assert_int_equal(cell, sl_space_locate(s, (sl_point){x, y}));
    if (!s->loose) return;
    uint32_t first = SL_NO_CELL;
    for (uint32_t i = 0; within && i < s->cell_count; i++) {
        const bool better = first == SL_NO_CELL || (s->cells[i].inside && !s->cells[first].inside);
        if (better && holds(s, i, (sl_point){x, y})) first = i;
    }
    assert_int_equal(cell, first);
}

/// Corners, a step of rounding about them, and anywhere.
static void check_places(const baked_file *f) {
    const sl_space *s = &f->baked.space;
    sl_random random = {4};
    for (uint32_t i = 0; i < s->vertex_count; i++)
        for (int k = 0; k < 9; k++) {
            const sl_point v = s->vertices[i];
            check_place(f, k % 3 ? nextafter(v.x, (k % 3 - 1.5) * INFINITY) : v.x,
                        k / 3 ? nextafter(v.y, (k / 3 - 1.5) * INFINITY) : v.y);
        }
    for (int i = 0; i < 20000; i++)
        check_place(
            f, s->bounds.min.x + (s->bounds.max.x - s->bounds.min.x) * sl_random_unit(&random),
            s->bounds.min.y + (s->bounds.max.y - s->bounds.min.y) * sl_random_unit(&random));
}

static void check_rows(const baked_file *f) {
    const sl_pvs *pvs = &f->baked.visibility.pvs;
    for (uint32_t from = 0; from < pvs->cell_count; from++)
        for (uint32_t to = 0; to < pvs->cell_count; to++)
            assert_int_equal(sl_runtime_can_see(&f->runtime, from, to), sl_pvs_sees(pvs, from, to));
}

static void check_file(const char *name) {
    sl_context *context = testing_context(NULL);
    baked_file old = read_old(context, name);
    baked_file now = written_anew(context, &old), again = written_anew(context, &now);
    assert_int_equal(version_of(&old), 1);
    assert_int_equal(version_of(&now), 2);
    assert_int_equal(again.size, now.size);
    assert_memory_equal(again.bytes, now.bytes, now.size);
    assert_true(sl_baked_same_space(&old.baked.space, &now.baked.space));
    assert_null(old.runtime.grid_cells);
    assert_non_null(now.runtime.grid_cells);
    const baked_file *each[] = {&old, &now};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(each[i]->baked.space.loose, 1);
        assert_true(each[i]->runtime.loose);
        check_places(each[i]);
        check_rows(each[i]);
    }
    baked_file_destroy(context, &again);
    baked_file_destroy(context, &now);
    baked_file_destroy(context, &old);
    sl_context_destroy(context);
}

static void ten_walls_through_a_point(void **state) {
    (void)state;
    check_file("star.slv");
}

static void a_door_among_oblique_walls(void **state) {
    (void)state;
    check_file("askew.slv");
    sl_context *context = testing_context(NULL);
    baked_file f = read_old(context, "askew.slv");
    const sl_runtime *r = &f.runtime;
    uint32_t scratch[128], cells[16];
    assert_true(r->cell_count <= 16 && sl_runtime_scratch_count(r) <= 128);
    assert_int_equal(r->door_count, 1);
    const uint32_t here = sl_runtime_locate(r, 3, 4), there = sl_runtime_locate(r, 9, 5);
    const sl_runtime_view view = sl_runtime_view_all_round(3, 4);
    for (unsigned char shut = 0; shut < 2; shut++) {
        bool seen = false;
        const uint32_t count = sl_runtime_look_past(r, &view, &shut, 0, scratch, cells, 16);
        for (uint32_t i = 0; i < count; i++) seen = seen || cells[i] == there;
        assert_int_equal(seen, !shut);
        assert_int_equal(sl_runtime_can_see_past(r, here, there, &shut), !shut);
    }
    // Discs go by cells, which are not exact here.
    const sl_runtime_walker walker = {0.1, NULL, NULL, SL_RUNTIME_NO_BOX};
    double x, y;
    assert_false(sl_runtime_can_walk_wide(r, &walker, 3, 4, 3.1, 4, scratch));
    assert_false(sl_runtime_walk(r, &walker, 3, 4, 3.1, 4, scratch, &x, &y));
    assert_true(x == 3 && y == 4);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Found by a fuzzer: the library read a file that the runtime refused.
static void half_of_the_door_sets(void **state) {
    (void)state;
    const char *const tags[] = {"DORO", "DORB"};
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < 2; i++) {
        baked_file f = read_old(context, "askew.slv");
        sl_baked baked = {0};
        sl_runtime runtime;
        memcpy(slv_entry(f.bytes, tags[i]), "XXXX", 4);
        slv_seal(f.bytes, f.size);
        assert_int_equal(sl_baked_parse(context, "askew", f.bytes, f.size, &baked), SL_BAD_INPUT);
        assert_int_equal(sl_runtime_open(f.bytes, f.size, &runtime), SL_RUNTIME_ROW);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

/// With all effects, of the version before this one: see also tests/command/test_export.py.
static void all_effects(void **state) {
    (void)state;
    const char *const names[] = {"effects.slv", "effects_oblique.slv"};
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < 2; i++) {
        baked_file f = read_old(context, names[i]);
        assert_int_equal(version_of(&f), i + 1);
        assert_int_equal(f.runtime.door_count, 1);
        assert_int_equal(f.baked.map.mirror_count, 2);
        assert_int_equal(f.baked.map.oneway_count, 1);
        check_places(&f);
        check_rows(&f);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_walls_through_a_point),
        cmocka_unit_test(a_door_among_oblique_walls),
        cmocka_unit_test(half_of_the_door_sets),
        cmocka_unit_test(all_effects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
