// Any map file by one call: which format it is read as, and what the map says of its file.
#include "testing.h"

#include "import_check.h"
#include "io/parts/names.h"
#include "map_same.h"
#include "sightline/io.h"

/// Whether each word of a list is in another one.
static bool all_words_in(const char *words, const char *others) {
    for (const char *at = words; *at; at += strspn(at, " ")) {
        const size_t length = strcspn(at, " ");
        bool found = false;
        for (const char *other = others; *other && !found; other += strspn(other, " ")) {
            const size_t same = strcspn(other, " ");
            found = same == length && memcmp(other, at, length) == 0;
            other += same;
        }
        if (!found) return false;
        at += length;
    }
    return true;
}

static void test_table(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t core, count, again;
    assert_string_equal(sl_map_formats(context, &core)[1].endings, ".txt");
    assert_int_equal(core, 2);
    assert_ok(context, sl_io_use(context));
    const sl_map_format *formats = sl_map_formats(context, &count);
    assert_true(count > core);
    assert_string_equal(formats[0].endings, ".map");
    for (size_t i = 0; i < count; i++)
        assert_true(formats[i].name[0] && formats[i].endings[0] == '.' && formats[i].what[0] &&
                    formats[i].read);
    // SL_IO_ENDINGS has the ending of each format that is not the core's, and no other.
    for (size_t i = core; i < count; i++)
        assert_true(all_words_in(formats[i].endings, SL_IO_ENDINGS));
    char endings[512] = "";
    for (size_t i = core; i < count; i++) {
        strcat(endings, " ");
        strcat(endings, formats[i].endings);
    }
    assert_true(all_words_in(SL_IO_ENDINGS, endings));
    // Formats that are there already are passed over.
    assert_ok(context, sl_io_use(context));
    assert_ptr_equal(sl_map_formats(context, &again), formats);
    assert_int_equal(again, count);
    sl_export_formats(context, &again);
    assert_int_equal(again, 6);
    sl_context_destroy(context);
    assert_false(sl_import_options_default().has_slice);
}

static void test_endings(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_io_use(context));
    const char *const text = "sightline 1\nwall 0 0 1 0\n", *const plan = "...\n";
    const char *const model = "v a 0 0 0;v b 4 0 0;v c 2 0 2;f f (a b c);";
    char folder[] = "/tmp/sightline-formats-XXXXXX";
    assert_non_null(mkdtemp(folder));
    const struct {
        const char *file, *text;
        size_t walls;
        bool slice;
    } cases[] = {
        {"a.map", text, 1, false},     {"a.txt", plan, 4, false},   {"a.TXT", plan, 4, false},
        {"a.ug", model, 1, true},      {"a", text, 1, false},       {"txt", text, 1, false},
        {"a.txt.map", text, 1, false}, {"a.other", text, 1, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[100];
        snprintf(path, sizeof path, "%s/%s", folder, cases[i].file);
        import_write_file(path, cases[i].text);
        const sl_import_options options = {.has_slice = cases[i].slice, .slice = 1};
        sl_map map = {0};
        assert_ok(context, sl_map_read(context, path, &options, &map));
        assert_int_equal(map.wall_count, cases[i].walls);
        assert_string_equal(map.source.name, path);
        sl_map_destroy(context, &map);
        remove(path);
    }
    remove(folder);
    sl_context_destroy(context);
}

static void count_report(void *user, const sl_progress *progress) {
    int *count = user;
    assert_string_equal(progress->stage, "read");
    assert_true(progress->done == progress->total && progress->total == 24);
    ++*count;
}

static void test_report_and_failures(void **state) {
    (void)state;
    int reports = 0;
    const sl_hooks hooks = {.user = &reports, .progress = count_report};
    sl_context *context = sl_context_create(&hooks);
    char path[] = "/tmp/sightline-formats-XXXXXX";
    assert_true(mkstemp(path) >= 0);
    sl_map map = {0};
    import_write_file(path, "sightline 1\nwall 0 0 1 0");
    assert_ok(context, sl_map_read(context, path, NULL, &map));
    assert_int_equal(reports, 1);
    sl_map_destroy(context, &map);
    import_write_file(path, "sightline 1\n\nwall 0 0 1\n");
    assert_int_equal(sl_map_read(context, path, NULL, &map), SL_BAD_INPUT);
    assert_true(map_is_empty(&map));
    char where[100];
    snprintf(where, sizeof where, "%s:3: ", path);
    assert_memory_equal(sl_context_message(context), where, strlen(where));
    remove(path);
    assert_int_equal(sl_map_read(context, path, NULL, &map), SL_BAD_ARGUMENT);
    assert_true(map_is_empty(&map));
    assert_int_equal(reports, 1);
    sl_context_destroy(context);
}

/// A format refuses the options that it has no use for.
static void test_options_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_io_use(context));
    char path[] = "/tmp/sightline-formats-XXXXXX";
    assert_true(mkstemp(path) >= 0);
    import_write_file(path, "sightline 1\nwall 0 0 1 0");
    const struct {
        const char *name;
        sl_import_options options;
    } cases[] = {
        {"--map:", {.map = "E1M1"}},          {"--slice:", {.has_slice = true}},
        {"--layers:", {.layers = "walls"}},   {"--tolerance:", {.tolerance = 1}},
        {"--threshold:", {.threshold = 0.5}}, {"--doors:", {.doors = true}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0};
        assert_int_equal(sl_map_read(context, path, &cases[i].options, &map), SL_BAD_ARGUMENT);
        assert_memory_equal(sl_context_message(context), cases[i].name, strlen(cases[i].name));
        assert_true(map_is_empty(&map));
    }
    sl_map_choice choice;
    assert_ok(context, sl_map_choice_read(context, path, &choice));
    assert_string_equal(choice.format->name, "text");
    assert_int_equal(choice.maps.count, 0);
    assert_true(choice.lowest == choice.highest);
    sl_map_choice_destroy(context, &choice);
    remove(path);
    assert_int_equal(sl_map_choice_read(context, path, &choice), SL_BAD_ARGUMENT);
    sl_context_destroy(context);
}

/// Without sl_io_use() a foreign file is taken for map text, and the message says so.
static void test_formats_missing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char folder[] = "/tmp/sightline-formats-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/plan.dxf", folder);
    import_write_file(path, "  0\nSECTION\n");
    sl_map map = {0};
    assert_int_equal(sl_map_read(context, path, NULL, &map), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), ".dxf:1: "));
    assert_non_null(strstr(sl_context_message(context), "sl_io_use()"));
    assert_int_equal(remove(path), 0);
    assert_int_equal(remove(folder), 0);
    sl_context_destroy(context);
}

/// A list that is too long for a note ends between two names.
static void test_list_cut(void **state) {
    (void)state;
    sli_name_list list = {.full = false};
    static const char *const names[] = {"walls", "doors", "windows"};
    for (size_t i = 0; i < 3; i++) sli_name_list_add(&list, (sli_word){names[i], strlen(names[i])});
    sli_name_list whole = list, one = list, none = list;
    assert_string_equal(sli_name_list_cut(&whole, 21), "walls, doors, windows");
    assert_string_equal(sli_name_list_cut(&list, 20), "walls, doors, ...");
    assert_string_equal(sli_name_list_cut(&one, 16), "walls, ...");
    assert_string_equal(sli_name_list_cut(&none, 6), "...");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),           cmocka_unit_test(test_endings),
        cmocka_unit_test(test_formats_missing), cmocka_unit_test(test_options_refused),
        cmocka_unit_test(test_list_cut),        cmocka_unit_test(test_report_and_failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
