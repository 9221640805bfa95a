/// Pictures of explanations: that each kind of answer shows what it should, and failures.
#include "sightline/draw.h"

#include "test_draw_map.h"

#include "sightline/support.h"

#include <math.h>
#include <unistd.h>

/// Cells of the map below by what they are to each other.
enum { FIRST, NEXT, GRAZED, LAST, CORNER, CLOSET, PLACES };

/// A hall of four cells behind screens through which a line only grazes, a cell round its corner,
/// and a closet.
static int set_up(void **state) {
    static const char *const map = "walls 0 0 40 0 40 20 0 20 0 0\n"
                                   "walls 0 10 34 10\nwalls 36 10 40 10\n"
                                   "wall 10 0 10 5\nwall 20 5 20 10\nwall 30 0 30 5\n"
                                   "wall 10 10 10 20\n";
    static const sl_point places[PLACES] = {{5, 2}, {15, 2}, {35, 2}, {25, 2}, {20, 15}, {5, 15}};
    draw_bench *b = draw_bench_make();
    if (!b) return -1;
    testing_space(b->context, map, &b->map.baked.map, &b->map.baked.space);
    for (int i = 0; i < PLACES; i++)
        b->map.cells[i] = sl_space_locate(&b->map.baked.space, places[i]);
    *state = b;
    return 0;
}

static sl_explanation explain(draw_bench *b, int from, int to, uint32_t misses) {
    sl_explain_options options = sl_explain_options_default();
    options.most_misses = misses;
    sl_explanation e;
    assert_ok(b->context, sl_explain(b->context, &b->map.baked.space, &options, b->map.cells[from],
                                     b->map.cells[to], &e));
    return e;
}

static sl_bytes drawn(draw_bench *b, const sl_explanation *e, const sl_draw_options *options,
                      const char *name) {
    sl_bytes file;
    assert_ok(b->context,
              sl_draw_explanation(b->context, &b->map.baked, e, options, draw_path(b, name)));
    assert_ok(b->context, sl_file_read(b->context, b->path, &file));
    unlink(b->path);
    return file;
}

/// How often a text occurs in a file.
static int count_of(const sl_bytes *file, const char *text) {
    int count = 0;
    for (const char *at = file->data; (at = strstr(at, text)); at++) count++;
    return count;
}

/// Without the blanks that versions of cairo put differently.
static void strip_blanks(sl_bytes *file) {
    char *to = file->data;
    for (const char *from = file->data; *from; from++)
        if (*from != ' ') *to++ = *from;
    *to = '\0';
    file->size = (size_t)(to - file->data);
}

typedef struct shown {
    int left, right; ///< marks of ends, those of the key and of what decides included
} shown;

static shown ends_shown(draw_bench *b, int from, int to, uint32_t misses) {
    sl_explanation e = explain(b, from, to, misses);
    const sl_draw_options options = sl_draw_options_default();
    sl_bytes file = drawn(b, &e, &options, "a.svg");
    strip_blanks(&file);
    const shown result = {count_of(&file, "rgb(0%,44.705882%,69.803922%)"),
                          count_of(&file, "rgb(76.862745%,32.156863%,0%)")};
    sl_free(b->context, file.data);
    sl_explanation_destroy(b->context, &e);
    return result;
}

static void each_answer_shows_its_ends(void **state) {
    draw_bench *b = *state;
    shown s = ends_shown(b, FIRST, FIRST, 3);
    assert_int_equal(s.left + s.right, 0);
    s = ends_shown(b, FIRST, CLOSET, 3);
    assert_int_equal(s.left + s.right, 0);
    s = ends_shown(b, FIRST, CORNER, 0);
    assert_int_equal(s.left + s.right, 0);
    // One in the key, one a portal.
    s = ends_shown(b, FIRST, NEXT, 3);
    assert_int_equal(s.left, 2);
    assert_int_equal(s.right, 2);
    // Three portals, and of the ends that are touched one left and two right.
    s = ends_shown(b, FIRST, GRAZED, 3);
    assert_int_equal(s.left, 1 + 3 + 1);
    assert_int_equal(s.right, 1 + 3 + 2);
}

/// Each hidden pair's hulls are filled and stroked in the colours of their ends.
static void a_hidden_pair_shows_its_conflict(void **state) {
    draw_bench *b = *state;
    sl_explanation e = explain(b, FIRST, CORNER, 3);
    assert_int_equal(e.verdict, SL_HIDDEN);
    assert_true(e.miss_count > 0);
    assert_false(e.misses[0].turns);
    const sl_sequence *sequence = &e.misses[0].sequence;
    int left = 0, right = 0;
    for (uint32_t i = 0; i < sequence->end_count; i++) sequence->ends[i].left ? left++ : right++;
    const int portals = (int)sequence->directed_count;
    const shown s = ends_shown(b, FIRST, CORNER, 3);
    assert_int_equal(s.left, 1 + portals + left + 2);
    assert_int_equal(s.right, 1 + portals + right + 2);
    sl_explanation_destroy(b->context, &e);
}

static const char *const kinds[] = {"a.png", "a.svg", "a.pdf"};
static const char *const magics[] = {"\x89PNG\r\n\x1a\n", "<?xml", "%PDF-"};

static void all_kinds_of_files_are_the_same_each_time(void **state) {
    draw_bench *b = *state;
    sl_draw_options options = sl_draw_options_default();
    options.width = 500;
    for (int to = 0; to < PLACES; to++) {
        sl_explanation e = explain(b, FIRST, to, 3);
        for (int i = 0; i < 3; i++) {
            options.dark = to % 2;
            sl_bytes one = drawn(b, &e, &options, kinds[i]);
            sl_bytes two = drawn(b, &e, &options, kinds[i]);
            assert_memory_equal(one.data, magics[i], strlen(magics[i]));
            assert_int_equal(one.size, two.size);
            assert_memory_equal(one.data, two.data, one.size);
            sl_free(b->context, one.data);
            sl_free(b->context, two.data);
        }
        sl_explanation_destroy(b->context, &e);
    }
}

static void widths_and_titles_of_all_lengths_are_drawn(void **state) {
    draw_bench *b = *state;
    sl_explanation e = explain(b, FIRST, CORNER, 1);
    sl_draw_options options = sl_draw_options_default();
    const double widths[] = {SL_DRAW_WIDTH_MIN, 333.3, SL_DRAW_WIDTH_MAX};
    for (int i = 0; i < 3; i++) {
        options.width = widths[i];
        sl_bytes file = drawn(b, &e, &options, "a.svg");
        sl_free(b->context, file.data);
    }
    // Two-byte characters, so that a cut at any byte could fall into one.
    char title[2001];
    for (size_t i = 0; i < sizeof title / 2; i++) memcpy(title + 2 * i, "\xc3\xa8", 2);
    options.width = 400;
    options.title = title;
    for (int length = 0; length <= 1000; length += 250) {
        title[2 * length] = '\0';
        sl_bytes file = drawn(b, &e, &options, "a.pdf");
        sl_free(b->context, file.data);
        title[2 * length] = '\xc3';
    }
    sl_explanation_destroy(b->context, &e);
}

static void what_makes_no_sense_is_refused(void **state) {
    draw_bench *b = *state;
    sl_explanation e = explain(b, FIRST, CORNER, 1);
    sl_draw_options options = sl_draw_options_default();
    assert_int_equal(
        sl_draw_explanation(b->context, &b->map.baked, &e, &options, draw_path(b, "a.gif")),
        SL_BAD_ARGUMENT);
    const double widths[] = {63.9, 20000.5, NAN};
    for (int i = 0; i < 3; i++) {
        options.width = widths[i];
        assert_int_equal(
            sl_draw_explanation(b->context, &b->map.baked, &e, &options, draw_path(b, "a.png")),
            SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(b->context), "width"));
    }
    assert_int_equal(draw_files_in(b->directory), 0);
    sl_explanation_destroy(b->context, &e);
}

static void every_failing_allocation_is_reported(void **state) {
    draw_bench *b = *state;
    sl_explanation e = explain(b, FIRST, CORNER, 1);
    const sl_draw_options options = sl_draw_options_default();
    sl_status status = SL_NO_MEMORY;
    for (long fail_at = 1; status != SL_OK; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        memory.fail_at = memory.calls + fail_at;
        status = sl_draw_explanation(context, &b->map.baked, &e, &options, draw_path(b, "a.svg"));
        if (status != SL_OK) {
            assert_int_equal(status, SL_NO_MEMORY);
            assert_int_equal(draw_files_in(b->directory), 0);
        }
        assert_int_equal(memory.live, 1); // the context
        sl_context_destroy(context);
        assert_true(fail_at < 1000);
    }
    unlink(b->path);
    sl_explanation_destroy(b->context, &e);
}

static void cancelling_leaves_nothing(void **state) {
    draw_bench *b = *state;
    sl_explanation e = explain(b, FIRST, CORNER, 1);
    const sl_draw_options options = sl_draw_options_default();
    const sl_hooks hooks = {.cancelled = testing_cancelled};
    sl_context *context = sl_context_create(&hooks);
    assert_int_equal(
        sl_draw_explanation(context, &b->map.baked, &e, &options, draw_path(b, "a.png")),
        SL_CANCELLED);
    assert_int_equal(draw_files_in(b->directory), 0);
    sl_context_destroy(context);
    sl_explanation_destroy(b->context, &e);
}

#define WITH_BENCH(test) cmocka_unit_test_setup_teardown(test, set_up, draw_bench_end)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_BENCH(each_answer_shows_its_ends),
        WITH_BENCH(a_hidden_pair_shows_its_conflict),
        WITH_BENCH(all_kinds_of_files_are_the_same_each_time),
        WITH_BENCH(widths_and_titles_of_all_lengths_are_drawn),
        WITH_BENCH(what_makes_no_sense_is_refused),
        WITH_BENCH(every_failing_allocation_is_reported),
        WITH_BENCH(cancelling_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
