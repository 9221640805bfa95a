// Explanations on maps made for them: each kind of answer, limits and failures.
#include "explain_proofs.h"

/// Two halls of three cells, one over the other, with a door between the left ones, and a closet
/// without a door. Through the lower hall's screens a line only grazes; in the upper one the doors
/// stand in a row.
static const char *const halls = "walls 0 0 30 0 30 20 0 20 0 0\n"
                                 "walls 0 10 4 10\nwalls 6 10 30 10\n"
                                 "wall 10 0 10 5\nwall 20 5 20 10\n"
                                 "wall 10 10 10 13\nwall 10 16 10 20\n"
                                 "wall 20 10 20 13\nwall 20 16 20 20\n"
                                 "walls 26 10 26 12 30 12\n";

typedef struct bench {
    sl_context *context;
    testing_memory memory;
    sl_map map;
    sl_space space;
    bool cancelled;
    uint64_t reported;
} bench;

static bool is_cancelled(void *user) {
    return ((bench *)user)->cancelled;
}

static void take_report(void *user, const sl_progress *progress) {
    if (strcmp(progress->stage, "explain") != 0) return;
    assert_string_equal(progress->unit, "tests");
    ((bench *)user)->reported = progress->done;
}

static void *resize(void *user, void *block, size_t bytes) {
    return testing_resize(&((bench *)user)->memory, block, bytes);
}

static bench *begin_bench(const char *map) {
    bench *b = calloc(1, sizeof *b);
    assert_non_null(b);
    const sl_hooks hooks = {
        .user = b, .resize = resize, .progress = take_report, .cancelled = is_cancelled};
    b->context = sl_context_create(&hooks);
    assert_non_null(b->context);
    testing_space(b->context, map, &b->map, &b->space);
    return b;
}

static void end_bench(bench *b) {
    sl_space_destroy(b->context, &b->space);
    sl_map_destroy(b->context, &b->map);
    sl_context_destroy(b->context);
    assert_int_equal(b->memory.live, 0);
    free(b);
}

static uint32_t cell_at(const bench *b, double x, double y) {
    const uint32_t cell = sl_space_locate(&b->space, (sl_point){x, y});
    assert_int_not_equal(cell, SL_NO_CELL);
    return cell;
}

static sl_explanation explained(bench *b, uint32_t from, uint32_t to) {
    const sl_explain_options options = sl_explain_options_default();
    sl_explanation e;
    assert_ok(b->context, sl_explain(b->context, &b->space, &options, from, to, &e));
    return e;
}

static void a_cell_sees_itself(void **state) {
    (void)state;
    bench *b = begin_bench(halls);
    sl_explanation e = explained(b, 1, 1);
    assert_true(e.seen && e.complete);
    assert_int_equal(e.distance, 0);
    assert_int_equal(e.tests, 0);
    assert_int_equal(e.sequence.directed_count + e.miss_count, 0);
    sl_explanation_destroy(b->context, &e);
    end_bench(b);
}

static void a_closet_is_not_reached(void **state) {
    (void)state;
    bench *b = begin_bench(halls);
    sl_explanation e = explained(b, cell_at(b, 2, 2), cell_at(b, 28, 11));
    assert_false(e.seen);
    assert_true(e.complete);
    assert_int_equal(e.verdict, SL_HIDDEN);
    assert_int_equal(e.distance, SL_NO_WAY);
    assert_int_equal(e.tests, 0);
    assert_int_equal(e.miss_count, 0);
    sl_explanation_destroy(b->context, &e);
    end_bench(b);
}

static void neighbours_take_one_test(void **state) {
    (void)state;
    bench *b = begin_bench(halls);
    const uint32_t from = cell_at(b, 5, 5), to = cell_at(b, 15, 5);
    sl_explanation e = explained(b, from, to);
    assert_true(e.seen);
    assert_int_equal(e.tests, 1);
    assert_int_equal(e.sequence.directed_count, 1);
    check_witness(&b->space, &e);
    // Across the portal, from the middle of one cell to that of the other.
    assert_true(e.shown.a.x == 5 && e.shown.b.x == 15);
    assert_true(e.shown.a.y == e.shown.b.y && e.shown.a.y > 6 && e.shown.a.y < 9);
    sl_explanation_destroy(b->context, &e);
    end_bench(b);
}

static void screens_leave_a_grazing_line(void **state) {
    (void)state;
    bench *b = begin_bench("walls 0 0 40 0 40 10 0 10 0 0\n"
                           "wall 10 0 10 5\nwall 20 5 20 10\nwall 30 0 30 5\n");
    const sl_space *space = &b->space;
    sl_explanation e = explained(b, cell_at(b, 2, 2), cell_at(b, 38, 2));
    assert_int_equal(e.verdict, SL_GRAZING);
    assert_true(e.seen && e.touches);
    assert_int_equal(e.sequence.directed_count, 3);
    assert_int_equal(e.sequence.end_count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        const sl_stab_end end = e.sequence.ends[i];
        const sl_point p = sl_sequence_end(space, &e.sequence, end);
        assert_int_equal(end.left, end.portal == 1);
        assert_true(p.y == 5 && p.x == 10 + 10 * end.portal);
    }
    assert_string_equal(sl_sequence_reason(space, &e.sequence),
                        "that left end lies between those right ends, on one line");
    assert_true(e.shown.a.x == 5 && e.shown.a.y == 5 && e.shown.b.x == 35 && e.shown.b.y == 5);
    sl_explanation_destroy(b->context, &e);

    sl_explain_options options = sl_explain_options_default();
    options.sight = SL_OPEN;
    assert_ok(b->context,
              sl_explain(b->context, space, &options, cell_at(b, 2, 2), cell_at(b, 38, 2), &e));
    assert_int_equal(e.verdict, SL_GRAZING);
    assert_false(e.seen);
    sl_explanation_destroy(b->context, &e);
    end_bench(b);
}

static void doors_in_a_row_give_a_simple_line(void **state) {
    (void)state;
    bench *b = begin_bench(halls);
    sl_explanation e = explained(b, cell_at(b, 5, 15), cell_at(b, 24, 15));
    assert_int_equal(e.verdict, SL_STABBED);
    assert_false(e.touches);
    assert_int_equal(e.sequence.directed_count, 2);
    check_witness(&b->space, &e);
    const double values[4] = {e.witness.a.x, e.witness.a.y, e.witness.b.x, e.witness.b.y};
    for (int i = 0; i < 4; i++) assert_true(values[i] == round(values[i]));
    sl_explanation_destroy(b->context, &e);
    end_bench(b);
}

static void corners_tell_what_stops_them(void **state) {
    (void)state;
    bench *b = begin_bench(halls);
    const sl_space *space = &b->space;
    const uint32_t from = cell_at(b, 15, 5), to = cell_at(b, 15, 15);
    sl_explanation e = explained(b, from, to);
    assert_false(e.seen);
    assert_int_equal(e.distance, 3);
    assert_int_equal(e.miss_count, 1);
    // Left into the first cell, up through the door, and then it would have to go right.
    const sl_miss *miss = &e.misses[0];
    check_miss(b->context, space, &e, 0);
    assert_true(miss->turns);
    assert_int_equal(miss->missing, 1);
    assert_int_equal(miss->sequence.directed_count, 3);
    assert_int_equal(miss->sequence.ends[0].portal, 0);
    sl_explanation_destroy(b->context, &e);

    e = explained(b, cell_at(b, 2, 2), cell_at(b, 24, 15));
    assert_int_equal(e.verdict, SL_HIDDEN);
    assert_int_equal(e.misses[0].missing, 1);
    assert_false(e.misses[0].turns);
    check_miss(b->context, space, &e, 0);
    assert_string_equal(
        sl_sequence_reason(space, &e.misses[0].sequence),
        "the segment between those left ends crosses the segment between those right ends");
    sl_explanation_destroy(b->context, &e);
    end_bench(b);
}

/// Reasons of ends that maps give seldom: directed portals of a made-up space, one portal each.
static void reasons_follow_the_ends(void **state) {
    (void)state;
    static const struct {
        sl_point left, right;
        unsigned sides; ///< 1: the left end decides; 2: the right one
    } all[][4] = {
        {{{0, 0}, {9, 9}, 1}, {{9, 9}, {0, 0}, 2}},
        {{{0, 0}, {9, 9}, 1}, {{4, 0}, {9, 9}, 1}, {{9, 9}, {2, 0}, 2}},
        {{{0, 0}, {9, 9}, 1}, {{9, 0}, {9, 9}, 1}, {{0, 9}, {9, 9}, 1}, {{9, 9}, {2, 2}, 2}},
        {{{2, 2}, {0, 0}, 3}, {{9, 9}, {9, 0}, 2}, {{9, 9}, {0, 9}, 2}},
        {{{0, 0}, {4, 0}, 3}, {{8, 0}, {9, 0}, 3}},
    };
    static const char *const reasons[] = {
        "that left end is the same point as that right end",
        "that right end lies between those left ends, on one line",
        "that right end lies within the triangle of those left ends",
        "that left end lies within the triangle of those right ends",
        "what lies between those left ends overlaps what lies between those right ends"};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        sl_directed_portal directed[4];
        uint32_t order[4];
        sl_sequence sequence = {.directed = order};
        for (uint32_t k = 0; k < 4 && all[i][k].sides; k++) {
            directed[k] = (sl_directed_portal){.left = all[i][k].left, .right = all[i][k].right};
            order[sequence.directed_count++] = k;
            if (all[i][k].sides & 1) sequence.ends[sequence.end_count++] = (sl_stab_end){k, true};
            if (all[i][k].sides & 2) sequence.ends[sequence.end_count++] = (sl_stab_end){k, false};
        }
        const sl_space space = {.directed = directed, .directed_count = sequence.directed_count};
        assert_string_equal(sl_sequence_reason(&space, &sequence), reasons[i]);
    }
}

// --- options and failures

static void arguments_are_checked(void **state) {
    (void)state;
    bench *b = begin_bench(halls);
    const uint32_t count = b->space.cell_count;
    sl_explain_options options = sl_explain_options_default();
    sl_explanation e;
    const uint32_t pairs[2][2] = {{0, count}, {count, 0}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(sl_explain(b->context, &b->space, &options, pairs[i][0], pairs[i][1], &e),
                         SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(b->context), "cell"));
    }
    sl_solver lesser = *sl_funnel();
    options.solver = &lesser;
    lesser.guarantee = SL_ROUNDED;
    assert_int_equal(sl_explain(b->context, &b->space, &options, 0, 1, &e), SL_BAD_ARGUMENT);
    lesser = *sl_funnel();
    lesser.conflict = NULL;
    assert_int_equal(sl_explain(b->context, &b->space, &options, 0, 1, &e), SL_BAD_ARGUMENT);
    end_bench(b);
}

/// A hall of small pillars that stand in no rows: many sequences, and long searches.
static bench *begin_pillars(void) {
    char text[8192];
    int used = snprintf(text, sizeof text, "walls 0 0 35 0 35 35 0 35 0 0\n");
    for (int x = 0; x < 5; x++)
        for (int y = 0; y < 5; y++) {
            const int left = 2 + 7 * x + y * 3 % 5, low = 2 + 7 * y + x * 2 % 5;
            const int right = left < 33 ? left + 1 : 34, high = low < 33 ? low + 1 : 34;
            used += snprintf(text + used, sizeof text - (size_t)used,
                             "walls %d %d %d %d %d %d %d %d %d %d\n", left, low, right, low, right,
                             high, left, high, left, low);
        }
    return begin_bench(text);
}

static void misses_are_as_many_as_asked(void **state) {
    (void)state;
    bench *b = begin_pillars();
    const uint32_t from = cell_at(b, 32.1, 26.1), to = cell_at(b, 32.1, 34.1);
    sl_explain_options options = sl_explain_options_default();
    sl_explanation e;
    for (uint32_t i = 0; i < 5; i++) {
        options.most_misses = i;
        assert_ok(b->context, sl_explain(b->context, &b->space, &options, from, to, &e));
        assert_int_equal(e.verdict, SL_HIDDEN);
        assert_int_equal(e.miss_count, i);
        for (uint32_t k = 0; k < i; k++) check_miss(b->context, &b->space, &e, k);
        sl_explanation_destroy(b->context, &e);
    }
    end_bench(b);
}

static void a_limit_ends_the_search(void **state) {
    (void)state;
    bench *b = begin_pillars();
    const uint32_t from = cell_at(b, 32.1, 26.1), to = cell_at(b, 32.1, 34.1);
    sl_explain_options options = sl_explain_options_default();
    sl_explanation e = explained(b, from, to);
    const uint64_t all = e.tests;
    assert_true(e.complete && all > 200);
    assert_int_equal(e.verdict, SL_HIDDEN);
    sl_explanation_destroy(b->context, &e);
    for (options.most_tests = 1; options.most_tests < all; options.most_tests *= 3) {
        assert_ok(b->context, sl_explain(b->context, &b->space, &options, from, to, &e));
        assert_false(e.complete);
        assert_false(e.seen);
        assert_int_equal(e.tests, options.most_tests);
        for (uint32_t i = 0; i < e.miss_count; i++) check_miss(b->context, &b->space, &e, i);
        sl_explanation_destroy(b->context, &e);
    }
    end_bench(b);
}

static void a_long_search_reports_and_can_be_cancelled(void **state) {
    (void)state;
    bench *b = begin_pillars();
    const uint32_t from = cell_at(b, 32.1, 26.1), to = cell_at(b, 32.1, 34.1);
    sl_explanation e = explained(b, from, to);
    assert_true(b->reported >= 1 && b->reported <= e.tests);
    sl_explanation_destroy(b->context, &e);
    b->cancelled = true;
    const sl_explain_options options = sl_explain_options_default();
    const long live = b->memory.live;
    assert_int_equal(sl_explain(b->context, &b->space, &options, from, to, &e), SL_CANCELLED);
    assert_int_equal(b->memory.live, live);
    end_bench(b);
}

static void lack_of_memory_leaves_nothing(void **state) {
    (void)state;
    bench *b = begin_bench(halls);
    const sl_explain_options options = sl_explain_options_default();
    const uint32_t cells[4] = {cell_at(b, 24, 5), cell_at(b, 24, 15), cell_at(b, 5, 15),
                               cell_at(b, 5, 5)};
    const long live = b->memory.live;
    for (int pair = 0; pair < 3; pair++) {
        sl_explanation e = {0};
        sl_status status = SL_NO_MEMORY;
        long failures = 0;
        for (; status == SL_NO_MEMORY; failures++) {
            b->memory.calls = 0;
            b->memory.fail_at = failures + 1;
            status = sl_explain(b->context, &b->space, &options, cells[pair], cells[pair + 1], &e);
            if (status == SL_NO_MEMORY) assert_int_equal(b->memory.live, live);
        }
        assert_int_equal(status, SL_OK);
        assert_true(failures > 5);
        b->memory.fail_at = 0;
        sl_explanation_destroy(b->context, &e);
        assert_int_equal(b->memory.live, live);
    }
    end_bench(b);
}

/// The same where the effect that decides is sought.
static void lack_of_memory_with_effects(void **state) {
    (void)state;
    bench *b = begin_bench("walls 0 0 30 0 30 10 0 10 0 0\nwall 10 0 10 4\nwall 20 0 20 4\n"
                           "door a 10 4 10 10 shut\noneway 20 4 20 10\nmirror 12 10 18 10\n");
    const sl_explain_options options = sl_explain_options_default();
    const bool shut[1] = {true};
    const sl_explain_state as = {shut, 1};
    const uint32_t from = cell_at(b, 5, 2), to = cell_at(b, 25, 2);
    const long live = b->memory.live;
    sl_effect_explanation e = {0};
    sl_status status = SL_NO_MEMORY;
    for (long failures = 0; status == SL_NO_MEMORY; failures++) {
        b->memory.calls = 0;
        b->memory.fail_at = failures + 1;
        status = sl_explain_effects(b->context, &b->space, &b->map, &as, &options, from, to, &e);
        if (status == SL_NO_MEMORY) assert_int_equal(b->memory.live, live);
    }
    b->memory.fail_at = 0;
    assert_int_equal(status, SL_OK);
    assert_false(e.direct.seen || e.mirrored.seen);
    assert_int_equal(e.direct.decides, 0);
    assert_int_equal(e.direct.without, SL_EFFECT_DOOR | SL_EFFECT_ONEWAY);
    assert_int_equal(e.mirrored.without, SL_EFFECT_DOOR | SL_EFFECT_ONEWAY);
    assert_true(e.without.seen && e.bent_without.mirrors == 1);
    sl_effect_explanation_destroy(b->context, &e);
    assert_int_equal(b->memory.live, live);
    end_bench(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cell_sees_itself),
        cmocka_unit_test(a_closet_is_not_reached),
        cmocka_unit_test(neighbours_take_one_test),
        cmocka_unit_test(screens_leave_a_grazing_line),
        cmocka_unit_test(doors_in_a_row_give_a_simple_line),
        cmocka_unit_test(corners_tell_what_stops_them),
        cmocka_unit_test(reasons_follow_the_ends),
        cmocka_unit_test(misses_are_as_many_as_asked),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(a_limit_ends_the_search),
        cmocka_unit_test(a_long_search_reports_and_can_be_cancelled),
        cmocka_unit_test(lack_of_memory_leaves_nothing),
        cmocka_unit_test(lack_of_memory_with_effects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
