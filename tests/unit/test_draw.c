/// Pictures as files: their kinds, what is refused, and that nothing is left of a failure.

#include "test_draw_map.h"

#include "sightline/draw.h"
#include "sightline/support.h"

#include <cairo.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static int set_up(void **state) {
    draw_bench *b = draw_bench_make();
    if (!b) return -1;
    b->map = draw_map_make(b->context, DRAW_PLAIN);
    *state = b;
    return 0;
}

static sl_draw_options everything(const draw_bench *b) {
    sl_draw_options options = sl_draw_options_default();
    options.layers |= SL_LAYER_STAB_TREE;
    options.cell = b->map.cells[LEFT_BELOW];
    options.width = 400;
    options.title = "Corridors & \"r\xc3\xa8gles\" <1>";
    return options;
}

static const char *const kinds[] = {"a.png", "a.svg", "a.pdf", "b.PNG"};
static const char *const magics[] = {"\x89PNG\r\n\x1a\n", "<?xml", "%PDF-", "\x89PNG\r\n\x1a\n"};

static void the_ending_tells_the_kind(void **state) {
    draw_bench *b = *state;
    const sl_draw_options options = everything(b);
    for (int i = 0; i < 4; i++) {
        const char *path = draw_path(b, kinds[i]);
        sl_bytes file;
        assert_ok(b->context, sl_draw_file(b->context, &b->map.baked, &options, path));
        assert_ok(b->context, sl_file_read(b->context, path, &file));
        assert_true(file.size > 1000);
        assert_memory_equal(file.data, magics[i], strlen(magics[i]));
        if (i == 1) assert_non_null(strstr(file.data, "</svg>"));
        sl_free(b->context, file.data);
        unlink(path);
    }
}

/// Also when cairo made other surfaces meanwhile, and whatever the date.
static void the_same_input_gives_the_same_bytes(void **state) {
    draw_bench *b = *state;
    const sl_draw_options options = everything(b);
    for (int i = 0; i < 3; i++) {
        const char *path = draw_path(b, kinds[i]);
        sl_bytes files[2];
        for (int k = 0; k < 2; k++) {
            assert_ok(b->context, sl_draw_file(b->context, &b->map.baked, &options, path));
            assert_ok(b->context, sl_file_read(b->context, path, &files[k]));
            for (int n = 0; n < 12; n++)
                cairo_surface_destroy(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
            if (i == 2 && k == 0) sleep(1); // PDF keeps dates to the second
        }
        assert_int_equal(files[0].size, files[1].size);
        assert_memory_equal(files[0].data, files[1].data, files[0].size);
        sl_free(b->context, files[0].data);
        sl_free(b->context, files[1].data);
        unlink(path);
    }
}

static void expect_refusal(draw_bench *b, const sl_draw_options *options, const char *name,
                           const char *message) {
    const char *path = draw_path(b, name);
    assert_int_equal(sl_draw_file(b->context, &b->map.baked, options, path), SL_BAD_ARGUMENT);
    if (!strstr(sl_context_message(b->context), message))
        fail_msg("\"%s\" is not in: %s", message, sl_context_message(b->context));
    assert_int_equal(draw_files_in(b->directory), 0);
}

static void what_makes_no_sense_is_refused(void **state) {
    draw_bench *b = *state;
    const sl_draw_options good = everything(b);
    expect_refusal(b, &good, "a.gif", ".png, .svg or .pdf");
    expect_refusal(b, &good, "png", ".png, .svg or .pdf");
    expect_refusal(b, &good, "a.png.txt", ".png, .svg or .pdf");
    const double widths[] = {63.9, 20000.5, 0, -400, NAN, INFINITY};
    for (int i = 0; i < 6; i++) {
        sl_draw_options bad = good;
        bad.width = widths[i];
        expect_refusal(b, &bad, "a.png", "width");
    }
    sl_draw_options bad = good;
    bad.layers |= 256;
    expect_refusal(b, &bad, "a.png", "layers");
    bad = good;
    bad.cell = b->map.baked.space.cell_count;
    expect_refusal(b, &bad, "a.png", "cell 5");
    bad = good;
    bad.title = "\xff\xfe";
    for (int i = 0; i < 3; i++) expect_refusal(b, &bad, kinds[i], "title");
}

static void bounds_of_width_are_drawn(void **state) {
    draw_bench *b = *state;
    sl_draw_options options = everything(b);
    options.width = SL_DRAW_WIDTH_MIN;
    assert_ok(b->context, sl_draw_file(b->context, &b->map.baked, &options, draw_path(b, "a.png")));
    unlink(b->path);
    options.width = SL_DRAW_WIDTH_MAX;
    assert_ok(b->context, sl_draw_file(b->context, &b->map.baked, &options, draw_path(b, "a.svg")));
    unlink(b->path);
}

static void titles_of_any_length_fit(void **state) {
    draw_bench *b = *state;
    char title[2000];
    sl_draw_options options = everything(b);
    options.title = title;
    // Two-byte characters, so that a cut at any byte could fall into one.
    for (size_t length = 0; length < sizeof title / 2; length = length * 3 + 1) {
        for (size_t i = 0; i < length; i++) memcpy(title + 2 * i, "\xc3\xa8", 2);
        title[2 * length] = '\0';
        assert_ok(b->context,
                  sl_draw_file(b->context, &b->map.baked, &options, draw_path(b, "a.png")));
        unlink(b->path);
    }
}

static void a_directory_that_is_not_there_is_an_io_failure(void **state) {
    draw_bench *b = *state;
    const sl_draw_options options = everything(b);
    for (int i = 0; i < 3; i++) {
        char name[32];
        snprintf(name, sizeof name, "none/%s", kinds[i]);
        assert_int_equal(sl_draw_file(b->context, &b->map.baked, &options, draw_path(b, name)),
                         SL_IO);
        assert_non_null(strstr(sl_context_message(b->context), name));
    }
    assert_int_equal(draw_files_in(b->directory), 0);
}

/// The system refuses to write beyond a size, as it does when a disk is full.
static void a_refused_write_leaves_the_old_file(void **state) {
    draw_bench *b = *state;
    const sl_draw_options options = everything(b);
    struct rlimit usual;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &usual), 0);
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    for (int i = 0; i < 3; i++) {
        const char *path = draw_path(b, kinds[i]);
        FILE *old = fopen(path, "w");
        assert_non_null(old);
        fputs("old", old);
        fclose(old);
        const struct rlimit low = {700, usual.rlim_max};
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &low), 0);
        const sl_status status = sl_draw_file(b->context, &b->map.baked, &options, path);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &usual), 0);
        assert_int_equal(status, SL_IO);
        assert_int_equal(draw_files_in(b->directory), 1);
        sl_bytes file;
        assert_ok(b->context, sl_file_read(b->context, path, &file));
        assert_string_equal(file.data, "old");
        sl_free(b->context, file.data);
        unlink(path);
    }
    signal(SIGXFSZ, handler);
}

static void every_failing_allocation_is_reported(void **state) {
    draw_bench *b = *state;
    sl_draw_options options = everything(b);
    for (int i = 0; i < 6; i++) {
        if (i == 3) options.cell = SL_NO_CELL;
        const char *path = draw_path(b, kinds[i % 3]);
        sl_status status = SL_NO_MEMORY;
        for (long fail_at = 1; status != SL_OK; fail_at++) {
            testing_memory memory = {0};
            sl_context *context = testing_context(&memory);
            memory.fail_at = memory.calls + fail_at;
            status = sl_draw_file(context, &b->map.baked, &options, path);
            if (status != SL_OK) {
                assert_int_equal(status, SL_NO_MEMORY);
                assert_string_not_equal(sl_context_message(context), "");
                assert_int_equal(draw_files_in(b->directory), 0);
            }
            assert_int_equal(memory.live, 1); // the context
            sl_context_destroy(context);
            assert_true(fail_at < 1000);
        }
        unlink(path);
    }
}

static void cancelling_leaves_nothing(void **state) {
    draw_bench *b = *state;
    const sl_draw_options options = everything(b);
    const sl_hooks hooks = {.cancelled = testing_cancelled};
    sl_context *context = sl_context_create(&hooks);
    for (int i = 0; i < 3; i++)
        assert_int_equal(sl_draw_file(context, &b->map.baked, &options, draw_path(b, kinds[i])),
                         SL_CANCELLED);
    assert_int_equal(draw_files_in(b->directory), 0);
    sl_context_destroy(context);
}

/// One cell; and a baked map without anything, which gives a page without a plan.
static void the_smallest_maps_are_drawn(void **state) {
    draw_bench *b = *state;
    sl_baked one = {0}, none = {0};
    testing_space(b->context, "walls 0 0 4 0 4 5 0 5 0 0\n", &one.map, &one.space);
    assert_int_equal(one.space.cell_count, 1);
    sl_draw_options options = sl_draw_options_default();
    for (int i = 0; i < 3; i++) {
        const char *path = draw_path(b, kinds[i]);
        options.cell = 0;
        assert_ok(b->context, sl_draw_file(b->context, &one, &options, path));
        options.cell = SL_NO_CELL;
        assert_ok(b->context, sl_draw_file(b->context, &one, &options, path));
        assert_ok(b->context, sl_draw_file(b->context, &none, &options, path));
        unlink(path);
    }
    sl_baked_destroy(b->context, &one);
}

/// All effects and marks at once.
static void effects_are_drawn(void **state) {
    draw_bench *b = *state;
    sl_map *map = &b->map.baked.map;
    const sl_point points[] = {{2, 2}, {8, 2}, {8, 8}};
    assert_ok(b->context,
              sl_map_add_door(b->context, map, "d", (sl_segment){{20, 4}, {20, 10}}, true, 0));
    assert_ok(b->context,
              sl_map_add_door(b->context, map, "e", (sl_segment){{20, 14}, {20, 20}}, false, 0));
    assert_ok(b->context, sl_map_add_mirror(b->context, map, (sl_segment){{2, 0}, {6, 0}}, 0));
    assert_ok(b->context, sl_map_add_oneway(b->context, map, (sl_segment){{30, 0}, {30, 10}}, 0));
    assert_ok(b->context, sl_map_add_path(b->context, map, "p", points, 3, 0));
    assert_ok(b->context, sl_map_add_object(b->context, map, "o", (sl_box){{12, 2}, {14, 4}}, 0));
    sl_draw_options options = everything(b);
    sl_bytes with, without;
    assert_ok(b->context, sl_draw_file(b->context, &b->map.baked, &options, draw_path(b, "a.svg")));
    assert_ok(b->context, sl_file_read(b->context, b->path, &with));
    options.layers &= ~(unsigned)(SL_LAYER_WALLS | SL_LAYER_STARTS);
    assert_ok(b->context, sl_draw_file(b->context, &b->map.baked, &options, b->path));
    assert_ok(b->context, sl_file_read(b->context, b->path, &without));
    // The colours of doors, glass, paths and objects, as cairo's SVG writes them.
    static const char *const colours[] = {
        "rgb(65.882353%,28.235294%,49.019608%)", "rgb(0%,44.705882%,69.803922%)",
        "rgb(35.686275%,29.019608%,54.117647%)", "rgb(47.843137%,41.568627%,32.54902%)"};
    for (int i = 0; i < 4; i++) {
        assert_non_null(strstr(with.data, colours[i]));
        assert_null(strstr(without.data, colours[i]));
    }
    sl_free(b->context, with.data);
    sl_free(b->context, without.data);
    unlink(b->path);
}

static void numbers_read_well(void **state) {
    (void)state;
    static const struct {
        uint64_t count;
        const char *unit, *text;
    } counts[] = {
        {0, "cell", "0 cells"},
        {1, "cell", "1 cell"},
        {999, "wall", "999 walls"},
        {1000, "wall",
         "1\xe2\x80\x89"
         "000 walls"},
        {1234567, "",
         "1\xe2\x80\x89"
         "234\xe2\x80\x89"
         "567"},
    };
    char text[SL_COUNT_TEXT];
    for (int i = 0; i < 5; i++) {
        sl_text_count(counts[i].count, counts[i].unit, text);
        assert_string_equal(text, counts[i].text);
    }
    sl_text_count(UINT64_MAX, "cell", text);
    assert_int_equal(strlen(text), 20 + 6 * 3 + 6);
    sl_text_percent(0.2345, text);
    assert_string_equal(text, "23.5\xe2\x80\x89%");
    sl_text_percent(1.00001, text);
    assert_string_equal(text, "100.0\xe2\x80\x89%");
}

#define WITH_BENCH(test) cmocka_unit_test_setup_teardown(test, set_up, draw_bench_end)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_BENCH(the_ending_tells_the_kind),
        WITH_BENCH(the_same_input_gives_the_same_bytes),
        WITH_BENCH(what_makes_no_sense_is_refused),
        WITH_BENCH(bounds_of_width_are_drawn),
        WITH_BENCH(titles_of_any_length_fit),
        WITH_BENCH(a_directory_that_is_not_there_is_an_io_failure),
        WITH_BENCH(a_refused_write_leaves_the_old_file),
        WITH_BENCH(every_failing_allocation_is_reported),
        WITH_BENCH(cancelling_leaves_nothing),
        WITH_BENCH(the_smallest_maps_are_drawn),
        WITH_BENCH(effects_are_drawn),
        cmocka_unit_test(numbers_read_well),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
