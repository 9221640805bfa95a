/// A baked file whose checksum is right and whose contents are wrong is refused, by name.
#include "baked_bytes.h"
#include "slv_file.h"

#include "runtime/sightline_runtime.h"
#include "sightline/stab.h"
#include "space/index.h"

#include <math.h>

static const char *const rooms =
    "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\nseam 4 5 4 9\nstart 1 1 45\n";

/// Looked from with trees.
static void bake(sl_context *context, const char *statements, sl_baked *baked) {
    *baked = (sl_baked){.method = "dfs", .solver = "funnel"};
    testing_space(context, statements, &baked->map, &baked->space);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.trees = true;
    size_t count;
    assert_ok(context,
              sl_see_methods(&count)->see(context, &baked->space, &options, &baked->visibility));
    baked->map.wall_count = 0;
}

typedef struct file {
    char *bytes;
    size_t size;
} file;

static file print(sl_context *context, const sl_baked *baked) {
    file f = {0};
    f.bytes = baked_bytes(context, baked, &f.size);
    return f;
}

#define INFO_FIELD(field) offsetof(sli_slv_info, field), sizeof(((sli_slv_info *)0)->field)

typedef struct lie {
    const char *tag;
    size_t offset, size;
    const void *bytes;
    const char *message;
} lie;

static void check_lies(sl_context *context, const sl_baked *baked, const lie *lies, size_t count) {
    sl_baked back = {0};
    for (size_t i = 0; i < count; i++) {
        const file f = print(context, baked);
        assert_ok(context, sl_baked_parse(context, "cell", f.bytes, f.size, &back));
        sl_baked_destroy(context, &back);
        memcpy(slv_items(f.bytes, lies[i].tag) + lies[i].offset, lies[i].bytes, lies[i].size);
        slv_seal(f.bytes, f.size);
        // The name is how a message of the graph's check starts: it must stand before it all the
        // same.
        assert_int_equal(sl_baked_parse(context, "cell", f.bytes, f.size, &back), SL_BAD_INPUT);
        assert_int_equal(strncmp(sl_context_message(context), "cell: ", 6), 0);
        if (!strstr(sl_context_message(context), lies[i].message))
            fail_msg("%s, where it should say %s", sl_context_message(context), lies[i].message);
        free(f.bytes);
    }
}

static void a_lie_under_a_seal_is_refused(void **state) {
    (void)state;
    const double nan = slv_f64(NAN), far = slv_f64(1e200);
    const uint64_t pairs = 0;
    const uint32_t one = slv_u32(1), most = UINT32_MAX;
    const char escape[16] = "d\033[2Js", hidden[16] = "glpk\0hidden";
    const lie lies[] = {
        {"INFO", offsetof(sli_slv_info, bounds), sizeof far, &far, "INFO makes no sense"},
        {"INFO", offsetof(sli_slv_info, bounds), sizeof nan, &nan, "INFO makes no sense"},
        {"INFO", INFO_FIELD(sight), &most, "INFO makes no sense"},
        {"INFO", INFO_FIELD(method), escape, "INFO makes no sense"},
        {"INFO", INFO_FIELD(solver), hidden, "INFO makes no sense"},
        {"INFO", INFO_FIELD(solver), "sixteen-letters-", "INFO makes no sense"},
        {"INFO", INFO_FIELD(pairs), &pairs, "do not hold as many pairs"},
        {"WALL", 0, sizeof nan, &nan, "wall 0 lies out of range"},
        {"WALL", 24, sizeof far, &far, "wall 0 lies out of range"},
        {"CELL", offsetof(sl_cell, first_directed), sizeof most, &most,
         "cell 0 has portals out of"},
        {"PVSB", 0, 2, "\1\1", "visible set 0 lacks its own cell"},
        {"PVSB", 0, 1, "\3", "visible set 0 is damaged"},
        {"NODG", 0, 4, &one, "NODG and NODS are not of the tree"},
        {"NODG", 4, 4, &one, "NODG and NODS are not of the tree"},
        {"NODS", 0, 4, &most, "NODG and NODS are not of the tree"},
        {"PVSP", 0, 1, "\0", "PVSP is not of the visible sets"},
        {"PVSP", 7, 1, "\1", "PVSP is not of the visible sets"},
        {"TREN", offsetof(sl_stab_node, parent), sizeof one, &one, "stab tree 0 is no tree"},
        {"SEAM", offsetof(sl_seam, number), sizeof one, &one, "seam 0 is of nothing"},
        {"SEAM", offsetof(sl_seam, at), sizeof far, &far, "seam 0 leaves the bounds"},
        {"SEPO", offsetof(sl_seam_portal, portal), sizeof most, &most, "portals on seams are"},
        {"MAPT", 12, 12, "wall 0 0 1 1", "section MAPT holds walls"},
        {"STRT", 0, 8, &far, "section STRT is not that of the map text"},
        {"STRT", 16, 8, &nan, "section STRT is not that of the map text"},
        {"MAPI", offsetof(sli_slv_map_info, range), 8, &far, "MAPI makes no sense"},
        {"MAPI", offsetof(sli_slv_map_info, origin_x), 8, &nan, "MAPI makes no sense"},
        {"MAPI", offsetof(sli_slv_map_info, origin_y), 8, &far, "MAPI makes no sense"},
        {"MAPI", offsetof(sli_slv_map_info, scale), 8, &far, "MAPI makes no sense"},
        {"MAPI", offsetof(sli_slv_map_info, y_down), 1, "\2", "MAPI makes no sense"},
    };
    sl_context *context = testing_context(NULL);
    sl_baked baked;
    bake(context, rooms, &baked);
    check_lies(context, &baked, lies, sizeof lies / sizeof *lies);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// Sections say what the map text says, no more and no less.
static void things_that_are_not_those_of_the_text_are_refused(void **state) {
    (void)state;
    static const char *const tags[] = {"MAPN", "DOOR", "STRT", "OBJE", "PATH", "PAPO", "MIRR"};
    const double more[8] = {0};
    sl_context *context = testing_context(NULL);
    sl_baked baked, bare, back = {0};
    bake(context,
         "walls 0 0 9 0 9 9 0 9 0 0\ndoor d 4 0 4 9\nstart 1 1 0\nobject o 1 1 2 2\npath p 1 1\n"
         "mirror 6 2 6 5\n",
         &baked);
    bake(context, "walls 0 0 9 0 9 9 0 9 0 0\nstart 1 1 0\n", &bare);
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
        const file f = print(context, &baked);
        const sli_slv_section s = slv_section(slv_entry(f.bytes, tags[i]));
        slv_items(f.bytes, tags[i])[0] ^= 1;
        for (int missing = 0; missing < 2; missing++) {
            if (missing) memcpy(slv_entry(f.bytes, tags[i]), "????", 4);
            slv_seal(f.bytes, f.size);
            assert_int_equal(sl_baked_parse(context, "f", f.bytes, f.size, &back), SL_BAD_INPUT);
            assert_non_null(strstr(sl_context_message(context), tags[i]));
        }
        free(f.bytes);
        if (strcmp(tags[i], "STRT") == 0) continue;
        file plain = print(context, &bare);
        char *with = slv_with(plain.bytes, &plain.size, tags[i], more, s.item_bytes, 1);
        assert_int_equal(sl_baked_parse(context, "f", with, plain.size, &back), SL_BAD_INPUT);
        assert_non_null(strstr(sl_context_message(context), tags[i]));
        free(with);
        free(plain.bytes);
    }
    sl_baked_destroy(context, &baked);
    sl_baked_destroy(context, &bare);
    sl_context_destroy(context);
}

/// A bucket in the midst of a cell, without a corner of any.
static uint32_t lonely_bucket(const sl_space *s) {
    for (uint32_t bucket = 0; bucket < s->grid.columns * s->grid.rows; bucket++) {
        uint32_t i = 0;
        while (i < s->vertex_count && sli_cell_grid_bucket(s, s->vertices[i]) != bucket) i++;
        if (i == s->vertex_count && s->grid.first[bucket + 1] == s->grid.first[bucket] + 1)
            return bucket;
    }
    fail_msg("each bucket has a corner");
    return 0;
}

static void a_lie_about_the_grid_is_refused(void **state) {
    (void)state;
    const uint32_t none = 0, one = slv_u32(1), most = UINT32_MAX;
    sl_context *context = testing_context(NULL);
    sl_baked baked;
    bake(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 2 2 6 5\n", &baked);
    const sl_cell_grid *g = &baked.space.grid;
    const uint32_t lonely = lonely_bucket(&baked.space), at = g->first[lonely];
    const uint32_t other = slv_u32(g->cells[at] ? 0 : 1);
    const lie lies[] = {
        {"INFO", INFO_FIELD(grid_columns), &none, "GRIO and GRIC make no grid"},
        {"INFO", INFO_FIELD(grid_rows), &most, "GRIO and GRIC make no grid"},
        {"GRIO", 0, 4, &one, "the grid of buckets is none"},
        {"GRIO", 4, 4, &most, "a bucket ends before it starts"},
        {"GRIC", 0, 4, &most, "cells out of range or order"},
        {"GRIC", 4 * at, 4, &other, "is not in a bucket that it reaches into"},
        {"BEYO", 0, 4, &none, "has a side that is not the wall it is said to be"},
    };
    check_lies(context, &baked, lies, sizeof lies / sizeof *lies);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// A file of version 2 is one of a mesh.
static void a_mesh_without_its_sections_is_refused(void **state) {
    (void)state;
    static const char *const tags[] = {"BEYO", "GRIO", "GRIC"};
    sl_context *context = testing_context(NULL);
    sl_baked baked, back = {0};
    bake(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 2 2 6 5\n", &baked);
    for (int i = 0; i < 3; i++) {
        const file f = print(context, &baked);
        memcpy(slv_entry(f.bytes, tags[i]), "????", 4);
        slv_seal(f.bytes, f.size);
        assert_int_equal(sl_baked_parse(context, "mesh", f.bytes, f.size, &back), SL_BAD_INPUT);
        assert_non_null(strstr(sl_context_message(context), tags[i]));
        free(f.bytes);
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void memory_and_file_hold_the_same_bytes(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked baked, back = {0}, nothing = {0};
    bake(context, rooms, &baked);
    const char *path = "test_slv_same_bytes.slv";
    assert_ok(context, sl_baked_write(context, &baked, path));
    sl_bytes written, memory = {0};
    assert_ok(context, sl_file_read(context, path, &written));
    assert_int_equal(sl_baked_print(context, &nothing, &memory), SL_BAD_ARGUMENT);
    assert_null(memory.data);
    assert_ok(context, sl_baked_print(context, &baked, &memory));
    assert_int_equal(memory.size, written.size);
    assert_memory_equal(memory.data, written.data, written.size + 1);
    assert_ok(context, sl_baked_parse(context, "memory", memory.data, memory.size, &back));
    sl_free(context, written.data);
    sl_free(context, memory.data);
    sl_baked_destroy(context, &back);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    remove(path);
}

static void what_cannot_be_read_back_is_not_written(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked baked, nothing = {0};
    assert_int_equal(sl_baked_write(context, &nothing, "/dev/null"), SL_BAD_ARGUMENT);
    bake(context, rooms, &baked);
    assert_ok(context, sl_baked_write(context, &baked, "/dev/null"));
    memcpy(baked.method, "two words", 10);
    assert_int_equal(sl_baked_write(context, &baked, "/dev/null"), SL_BAD_ARGUMENT);
    memcpy(baked.method, "sixteen-letters-", sizeof baked.method);
    assert_int_equal(sl_baked_write(context, &baked, "/dev/null"), SL_BAD_ARGUMENT);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// The reader's bounds of a transform are the writer's: each written file can be read.
static void a_transform_out_of_range_is_not_written(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const double far = 2 * SL_COORDINATE_MAX;
    const struct {
        sl_transform transform;
        bool good;
    } cases[] = {
        {{{0, 0}, 0, false}, true},
        {{{far, -far}, SL_COORDINATE_MIN, true}, true},
        {{{0, 0}, SL_COORDINATE_MAX, false}, true},
        {{{0, 0}, 1e-200, false}, false},
        {{{0, 0}, 1e200, false}, false},
        {{{0, 0}, -1, false}, false},
        {{{0, 0}, NAN, false}, false},
        {{{nextafter(far, INFINITY), 0}, 1, false}, false},
        {{{0, -INFINITY}, 1, false}, false},
        {{{NAN, 0}, 1, false}, false},
    };
    sl_baked baked;
    bake(context, rooms, &baked);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_bytes memory = {0};
        sl_baked back = {0};
        baked.map.source.transform = cases[i].transform;
        const sl_status status = sl_baked_print(context, &baked, &memory);
        assert_int_equal(status, cases[i].good ? SL_OK : SL_UNSUPPORTED);
        if (cases[i].good)
            assert_ok(context, sl_baked_parse(context, "t", memory.data, memory.size, &back));
        else
            assert_non_null(strstr(sl_context_message(context), "transform"));
        sl_free(context, memory.data);
        sl_baked_destroy(context, &back);
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static bool cancel_after(void *user) {
    int *calls = user;
    return (*calls)-- <= 0;
}

static void an_export_can_be_interrupted(void **state) {
    (void)state;
    int calls = 1000000;
    const sl_hooks hooks = {.user = &calls, .cancelled = cancel_after};
    sl_context *context = sl_context_create(&hooks);
    assert_non_null(context);
    sl_baked baked;
    bake(context, rooms, &baked);
    size_t count;
    const sl_export_format *formats = sl_export_formats(context, &count);
    const sl_export_options none = {0};
    for (size_t i = 0; i < count; i++) {
        if (formats[i].takes & SL_EXPORT_TAKES_WAD) continue;
        assert_ok(context, formats[i].write(context, &baked, &none, "/dev/null"));
        calls = 0;
        assert_int_equal(formats[i].write(context, &baked, &none, "/dev/null"), SL_CANCELLED);
        calls = 1000000;
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

// --- what is not finished

static bool after_one_source(void *user) {
    return (*(int *)user)++ > 0;
}

/// The same bake, stopped after a source, or one shard of it.
static void bake_part(sl_context *context, uint32_t shard_count, sl_baked *baked) {
    bake(context, rooms, baked);
    sl_visibility_destroy(context, &baked->visibility);
    int asked = 0;
    size_t count;
    const sl_see_method *dfs = sl_see_methods(&count);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.shard = options.shard_count = shard_count;
    options.enough = after_one_source;
    options.enough_user = &asked;
    assert_ok(context, dfs->run(context, &baked->space, &options, &baked->partial));
    assert_true(sl_partial_left(&baked->partial) > 0 || shard_count);
    if (!shard_count)
        assert_ok(context, dfs->finish(context, &baked->space, &options, &baked->partial,
                                       &baked->visibility));
}

static void a_partial_file_says_what_it_is(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked baked, back = {0};
    char text[SL_PARTIAL_TEXT];
    bake_part(context, 0, &baked);
    const file f = print(context, &baked);
    assert_ok(context, sl_baked_parse(context, "part", f.bytes, f.size, &back));
    assert_int_equal(back.visibility.guarantee, SL_CONSERVATIVE);
    assert_int_equal(back.partial.done_count, baked.partial.done_count);
    sl_baked_say_partial(&back, text);
    assert_non_null(strstr(text, "cells looked at; what is not decided counts as seen"));
    const file again = print(context, &back);
    assert_int_equal(again.size, f.size);
    assert_memory_equal(again.bytes, f.bytes, f.size);
    sl_runtime runtime;
    assert_int_equal(sl_runtime_open(f.bytes, f.size, &runtime), SL_RUNTIME_OK);
    assert_true(runtime.unfinished);
    sl_baked_destroy(context, &baked);
    sl_baked_destroy(context, &back);
    free(f.bytes);
    free(again.bytes);
    sl_context_destroy(context);
}

static void a_shard_is_no_baked_file(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked baked, back = {0};
    bake_part(context, 3, &baked);
    const file f = print(context, &baked);
    assert_int_equal(sl_baked_parse(context, "part", f.bytes, f.size, &back), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "one shard of a bake, 3 of 3"));
    sl_runtime runtime;
    assert_int_equal(sl_runtime_open(f.bytes, f.size, &runtime), SL_RUNTIME_SHARD);
    sl_baked_destroy(context, &baked);
    free(f.bytes);
    sl_context_destroy(context);
}

static void a_lie_about_what_is_done_is_refused(void **state) {
    (void)state;
    const uint32_t two = slv_u32(2), most = UINT32_MAX;
    const lie lies[] = {
        {"PART", offsetof(sli_slv_part, shard), 4, &two, "PART makes no sense"},
        {"PART", offsetof(sli_slv_part, inside_only), 4, &two, "PART makes no sense"},
        {"PART", offsetof(sli_slv_part, unit_count), 4, &most, "DONE does not tell of each unit"},
        {"PART", offsetof(sli_slv_part, shard_count), 4, &two, "PART makes no sense"},
        {"DONE", 7, 1, "\200", "DONE does not tell of each unit"},
        {"FNDO", 0, 4, &most, "do not start at their first byte"},
        {"FNDB", 0, 1, "\177", "visible set 0 is damaged"},
    };
    sl_context *context = testing_context(NULL);
    sl_baked baked, back = {0};
    bake_part(context, 0, &baked);
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        const file f = print(context, &baked);
        memcpy(slv_items(f.bytes, lies[i].tag) + lies[i].offset, lies[i].bytes, lies[i].size);
        slv_seal(f.bytes, f.size);
        assert_int_equal(sl_baked_parse(context, "part", f.bytes, f.size, &back), SL_BAD_INPUT);
        if (!strstr(sl_context_message(context), lies[i].message))
            fail_msg("%s: %s, where it should say %s", lies[i].tag, sl_context_message(context),
                     lies[i].message);
        assert_non_null(strstr(sl_context_message(context), "part: "));
        free(f.bytes);
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lie_under_a_seal_is_refused),
        cmocka_unit_test(things_that_are_not_those_of_the_text_are_refused),
        cmocka_unit_test(a_lie_about_the_grid_is_refused),
        cmocka_unit_test(a_mesh_without_its_sections_is_refused),
        cmocka_unit_test(memory_and_file_hold_the_same_bytes),
        cmocka_unit_test(what_cannot_be_read_back_is_not_written),
        cmocka_unit_test(a_transform_out_of_range_is_not_written),
        cmocka_unit_test(an_export_can_be_interrupted),
        cmocka_unit_test(a_partial_file_says_what_it_is),
        cmocka_unit_test(a_shard_is_no_baked_file),
        cmocka_unit_test(a_lie_about_what_is_done_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
