// The search for faults on maps made to have them, one by one; and what snapping mends.
#include "testing.h"

#include "geometry/orient.h"
#include "map/scan.h"
#include "map_same.h"
#include "space/faults/faults.h"

#include <math.h>

typedef struct examined {
    sl_context *context;
    testing_memory memory;
    sl_map map, cleaned;
    sl_space space;
    sl_faults faults;
} examined;

static void read_into(sl_context *context, const char *statements, sl_map *map) {
    char text[4096];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "f", text, strlen(text), map));
}

static void examine(const char *statements, double gap, double thin, examined *out) {
    *out = (examined){0};
    out->context = testing_context(&out->memory);
    const sl_faults_options options = {.gap = gap, .thin = thin};
    read_into(out->context, statements, &out->map);
    testing_space(out->context, statements, &out->cleaned, &out->space);
    assert_ok(out->context,
              sl_find_faults(out->context, &out->map, &out->space, &options, &out->faults));
}

static void finish(examined *e) {
    sl_map_destroy(e->context, &e->map);
    sl_map_destroy(e->context, &e->cleaned);
    sl_space_destroy(e->context, &e->space);
    sl_faults_destroy(e->context, &e->faults);
    sl_context_destroy(e->context);
    assert_int_equal(e->memory.live, 0);
}

static void assert_counts(const examined *e, uint32_t leaks, uint32_t gaps, uint32_t overlaps,
                          uint32_t crossings, uint32_t thin, uint32_t unreachable) {
    const uint32_t expected[SL_FAULT_KINDS] = {leaks, gaps, overlaps, crossings, thin, unreachable};
    uint32_t sum = 0;
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++) {
        if (e->faults.counts[kind] != expected[kind])
            fail_msg("%s: %u, not %u", sl_fault_name((sl_fault_kind)kind), e->faults.counts[kind],
                     expected[kind]);
        sum += expected[kind];
    }
    assert_int_equal(e->faults.count, sum);
    for (uint32_t i = 1; i < e->faults.count; i++)
        assert_true(e->faults.items[i - 1].kind <= e->faults.items[i].kind);
}

#define ROOM "walls 0 0 10 0 10 10 0 10 0 0\n"

static void test_nothing(void **state) {
    (void)state;
    examined e;
    examine(ROOM "start 5 5 0\n", 0.5, 0.5, &e);
    assert_counts(&e, 0, 0, 0, 0, 0, 0);
    assert_true(e.faults.has_starts);
    finish(&e);
    examine(ROOM, 0.5, 0.5, &e);
    assert_counts(&e, 0, 0, 0, 0, 0, 0);
    assert_false(e.faults.has_starts);
    finish(&e);
}

/// A room in a frame, with a way out of the room 2 wide and one out of the frame 1 wide and 3 wide.
static void test_leak(void **state) {
    (void)state;
    examined e;
    examine(
        "walls 4 2 2 2 2 8 8 8 8 2 6 2\n"
        "walls 0 0 10 0 10 4\nwall 10 5 10 10\nwalls 0 10 0 0\nwalls 0 10 4 10\nwall 7 10 10 10\n"
        "start 5 5 0\n",
        0.5, 0.1, &e);
    // The way out of the room is the one to close; those out of the frame are shown as well.
    assert_counts(&e, 3, 0, 0, 0, 0, 0);
    assert_true(e.faults.items[0].size == 1 && e.faults.items[2].size == 3);
    const sl_fault *leak = &e.faults.items[1];
    assert_true(leak->size == 2);
    assert_true(leak->at.a.y == 2 && leak->at.b.y == 2);
    const sl_point *way = e.faults.points + leak->first_point;
    assert_true(way[0].x == 5 && way[0].y == 5);
    const sl_point end = way[leak->point_count - 1];
    assert_true(end.x == 0 || end.x == 10 || end.y == 0 || end.y == 10);
    assert_true(leak->point_count > 2);
    finish(&e);
    // Two starts in the same room leak once; one in a closed room does not.
    examine("walls 4 2 2 2 2 8 8 8 8 2 6 2\nwalls 20 2 25 2 25 8 20 8 20 2\n"
            "start 5 5 0\nstart 6 6 0\nstart 22 4 0\n",
            0.5, 0.1, &e);
    assert_int_equal(e.faults.counts[SL_FAULT_LEAK], 1);
    finish(&e);
}

/// Whether a way goes through no wall of the map.
static void assert_free(const examined *e, const sl_fault *leak) {
    const sl_point *way = e->faults.points + leak->first_point;
    for (uint32_t i = 1; i < leak->point_count; i++) {
        for (size_t k = 0; k < e->map.wall_count; k++) {
            const sl_wall *w = &e->map.walls[k];
            const int a = sli_orient(w->a, w->b, way[i - 1]), b = sli_orient(w->a, w->b, way[i]);
            const int c = sli_orient(way[i - 1], way[i], w->a);
            const int d = sli_orient(way[i - 1], way[i], w->b);
            assert_false(a * b <= 0 && c * d <= 0 && (a || b) && (c || d));
        }
    }
}

static void test_leak_is_the_opening(void **state) {
    (void)state;
    examined e;
    // One cell reaches over the hole in the border, which is not at its middle.
    examine("wall 0 0 9.9 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\nstart 5 5 0\n", 0, 0,
            &e);
    assert_counts(&e, 1, 0, 0, 0, 0, 0);
    const sl_fault *leak = &e.faults.items[0];
    assert_true(fmin(leak->at.a.x, leak->at.b.x) == 9.9 && fmax(leak->at.a.x, leak->at.b.x) == 10);
    assert_true(leak->at.a.y == 0 && leak->at.b.y == 0 && fabs(leak->size - 0.1) < 1e-12);
    assert_int_equal(leak->walls[0] + leak->walls[1], 1);
    assert_free(&e, leak);
    finish(&e);
    // The narrowest first, then the next larger one.
    examine("wall 0 0 9.9 0\nwall 10 0 10 4\nwall 10 6 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"
            "wall 3 0 3 9\nwall 6 1 6 10\nstart 1 5 0\n",
            0, 0, &e);
    assert_counts(&e, 3, 0, 0, 0, 0, 0);
    assert_true(e.faults.items[0].size < 0.11 && e.faults.items[2].size == 2);
    // Between them the narrowest place on the way to the larger one.
    assert_true(e.faults.items[1].size == 1);
    for (int i = 0; i < 3; i++) assert_free(&e, &e.faults.items[i]);
    finish(&e);
    // An end near the side of a wall, within the bounds.
    examine("walls 2 2 8 2 8 8 2 8 2 2.5\nwall 0 0 10 10\nwalls 1 2.25 3 2.25\nstart 4 5 0\n", 0.01,
            0.01, &e);
    for (uint32_t i = 0; i < e.faults.counts[SL_FAULT_LEAK]; i++)
        assert_free(&e, &e.faults.items[i]);
    assert_true(e.faults.counts[SL_FAULT_LEAK] > 0 && e.faults.items[0].size == 0.25);
    finish(&e);
}

/// Walls in all leaks part the start from the outside.
static void test_leaks_closed(void **state) {
    (void)state;
    sl_random random = {7};
    size_t leaks = 0;
    for (int round = 0; round < 60; round++) {
        char text[3000] = "start 3.4871 16.3917 0\n";
        for (int i = 0; i < 24; i++) {
            const unsigned x = (unsigned)(sl_random_next(&random) % 16);
            const unsigned y = (unsigned)(sl_random_next(&random) % 18);
            const unsigned length = 1 + (unsigned)(sl_random_next(&random) % 9);
            const bool level = sl_random_next(&random) % 2;
            snprintf(text + strlen(text), sizeof text - strlen(text), "wall %u %u %u %u\n", x, y,
                     x + level * length, y + !level * length);
        }
        strcat(text, "wall 0 19 25 19\nwall 2 16 4 16\nwall 4 16 4 18\n");
        examined e;
        examine(text, 0, 0, &e);
        for (uint32_t i = 0; i < e.faults.counts[SL_FAULT_LEAK]; i++) {
            const sl_fault *leak = &e.faults.items[i];
            assert_free(&e, leak);
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     "wall %.17g %.17g %.17g %.17g\n", leak->at.a.x, leak->at.a.y, leak->at.b.x,
                     leak->at.b.y);
            leaks++;
        }
        finish(&e);
        examine(text, 0, 0, &e);
        assert_int_equal(e.faults.counts[SL_FAULT_LEAK], 0);
        finish(&e);
    }
    assert_true(leaks > 60);
}

static void test_doubt(void **state) {
    (void)state;
    static const struct {
        const char *map;
        sl_inside doubt;
    } cases[] = {
        {ROOM, SL_INSIDE_SURE},
        {ROOM "start 5 5 0\n", SL_INSIDE_SURE},
        {"walls 0 0 9.9 0\nwalls 10 0 10 10 0 10 0 0\n", SL_INSIDE_SMALL},
        {"walls 0 0 9.9 0\nwalls 10 0 10 10 0 10 0 0\nstart 5 5 0\n", SL_INSIDE_LEAKS},
        {"walls 0 0 4 0 4 4 0 4 0 0\nwall 9 9 10 9\n", SL_INSIDE_SMALL},
        {"walls 0 0 4 0 4 4 0 4 0 0\nwall 9 9 10 9\nstart 1 1 0\n", SL_INSIDE_SURE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        examined e;
        sl_inside doubt;
        examine(cases[i].map, 0, 0, &e);
        assert_ok(e.context, sl_doubt_inside(e.context, &e.map, &e.space, &doubt));
        assert_int_equal(doubt, cases[i].doubt);
        finish(&e);
    }
}

static void test_gaps(void **state) {
    (void)state;
    examined e;
    // An end near the middle of a wall, and two ends near each other.
    examine(ROOM "wall 5 0.25 5 6\nwall 5 6.5 5 10\nstart 1 1 0\n", 0.5, 0.1, &e);
    assert_counts(&e, 0, 2, 0, 0, 0, 0);
    assert_true(e.faults.items[0].size == 0.25 && e.faults.items[1].size == 0.5);
    assert_true(e.faults.items[0].at.b.y == 0 && e.faults.items[0].at.b.x == 5);
    finish(&e);
    examine(ROOM "wall 5 0.25 5 6\nwall 5 6.5 5 10\nstart 1 1 0\n", 0.4, 0.1, &e);
    assert_counts(&e, 0, 1, 0, 0, 0, 0);
    finish(&e);
    // Joined by a short wall, or with a wall between, it is no gap.
    examine(ROOM "wall 5 0.25 5 6\nwall 5 0.25 5 0\nstart 1 1 0\n", 0.5, 0.1, &e);
    assert_counts(&e, 0, 0, 0, 0, 0, 0);
    finish(&e);
    examine(ROOM "wall 5 0.25 5 6\nwall 4 0.125 6 0.125\nstart 1 1 0\n", 0.3, 0.01, &e);
    assert_counts(&e, 0, 3, 0, 0, 0, 0);
    for (int i = 0; i < 3; i++) assert_true(e.faults.items[i].size == 0.125);
    finish(&e);
}

static void test_pairs(void **state) {
    (void)state;
    examined e;
    examine(ROOM "wall 2 5 6 5\nwall 4 5 8 5\nwall 4 5 4.5 5\nstart 1 1 0\n", 0.1, 0.1, &e);
    // The third wall lies in both others, and is named once.
    assert_counts(&e, 0, 0, 2, 0, 0, 0);
    assert_true(e.faults.items[0].size == 2 && e.faults.items[1].size == 0.5);
    finish(&e);
    // Walls that touch in a point, end to end and end to side, are in order.
    examine(ROOM "wall 2 5 6 5\nwall 6 5 8 5\nwall 5 5 5 7\nstart 1 1 0\n", 0.1, 0.1, &e);
    assert_counts(&e, 0, 0, 0, 0, 0, 0);
    finish(&e);
    examine(ROOM "wall 2 5 6 5\nwall 5 4 5 7\nstart 1 1 0\n", 0.1, 0.1, &e);
    assert_counts(&e, 0, 0, 0, 1, 0, 0);
    assert_true(e.faults.items[0].at.a.x == 5 && e.faults.items[0].at.a.y == 5);
    finish(&e);
}

static void test_cells(void **state) {
    (void)state;
    examined e;
    examine(ROOM "walls 4 4 6 4 6 6 4 6 4 4\nwall 6 6 6 10\nwall 6.25 6 6.25 10\nstart 1 1 0\n",
            0.1, 0.3, &e);
    assert_counts(&e, 0, 0, 0, 0, 1, 1);
    assert_true(e.faults.items[0].size == 0.25);
    assert_true(e.faults.items[1].size == 4 && e.faults.items[1].cells == 1);
    assert_true(e.faults.items[1].at.a.x == 5 && e.faults.items[1].at.a.y == 5);
    finish(&e);
}

/// Any order and turn of the walls tells the same faults.
static void test_order(void **state) {
    (void)state;
    const char *const walls[] = {"wall 0 0 10 0\n", "wall 10 0 10 10\n", "wall 10 10 0 10\n",
                                 "wall 0 10 0 0\n", "wall 5 0.25 5 6\n", "wall 5 6.5 5 9.5\n",
                                 "wall 2 3 5 3\n",  "wall 1 3 4 3\n",    "wall 4 2 4 4\n"};
    const size_t count = sizeof walls / sizeof *walls;
    for (size_t first = 0; first < count; first++) {
        char text[512] = "start 1 1 0\n";
        for (size_t i = 0; i < count; i++) strcat(text, walls[(first + 2 * i) % count]);
        examined e;
        examine(text, 0.5, 0.1, &e);
        assert_counts(&e, 0, 3, 1, 1, 0, 0);
        finish(&e);
    }
}

static void assert_snapped(const char *before, double gap, const char *after, size_t moved) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_mend_account account;
    read_into(context, before, &map);
    assert_ok(context, sli_map_snap(context, &map, gap, &account));
    char *text = map_text(&map);
    assert_string_equal(text + strlen("sightline 1\n"), after);
    assert_int_equal(account.moved, moved);
    assert_true(account.farthest <= gap);
    free(text);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_snap(void **state) {
    (void)state;
    // Onto a wall, along its own line; the other end is too far.
    assert_snapped("wall 0 0 10 0\nwall 5 0.25 5 6\n", 0.5, "wall 0 0 10 0\nwall 5 0 5 6\n", 1);
    // Ends that are near: the place that more walls have stays.
    assert_snapped("wall 0 0 5 0.25\nwall 5 0 9 0\nwall 5 0 5 4\n", 0.5,
                   "wall 0 0 5 0\nwall 5 0 9 0\nwall 5 0 5 4\n", 1);
    // What touches is left alone, and so is what is farther.
    assert_snapped("wall 0 0 10 0\nwall 5 0 5 6\nwall 7 1 7 3\n", 0.5,
                   "wall 0 0 10 0\nwall 5 0 5 6\nwall 7 1 7 3\n", 0);
    // A wall shorter than the gap vanishes.
    assert_snapped("wall 0 0 0.25 0\nwall 3 0 5 0\n", 0.5, "wall 3 0 5 0\n", 1);
    // Oblique, onto an upright wall: exactly onto it.
    assert_snapped("wall 0 0 0 9\nwall 0.25 4 3 8\n", 0.5, "wall 0 0 0 9\nwall 0 4 3 8\n", 1);
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_int_equal(sli_map_snap(context, &map, 0, NULL), SL_BAD_ARGUMENT);
    assert_int_equal(sli_map_snap(context, &map, NAN, NULL), SL_BAD_ARGUMENT);
    assert_ok(context, sli_map_snap(context, &map, 1, NULL));
    sl_context_destroy(context);
}

/// Whatever allocation fails, nothing is lost.
/// Cells of a map's own do not go with walls that were moved.
static void test_snap_drops_cells(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    read_into(context, ROOM "wall 5 0.25 5 6\ncell 0 0 10 0 10 10 0 10\n", &map);
    assert_int_equal(map.cell_count, 1);
    assert_ok(context, sli_map_snap(context, &map, 0.5, NULL));
    assert_int_equal(map.cell_count, 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_memory(void **state) {
    (void)state;
    for (long fail_at = 1;; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        sl_map map = {0}, cleaned = {0};
        sl_space space = {0};
        sl_faults faults = {0};
        const char *const text = "walls 0 0 9.5 0\nwalls 10 0 10 10 0 10 0 0\n"
                                 "wall 5 0.25 5 6\nwall 2 5 8 5\nstart 1 1 0\n";
        read_into(context, text, &map);
        testing_space(context, text, &cleaned, &space);
        const long live = memory.live;
        memory.calls = 0;
        memory.fail_at = fail_at;
        const sl_faults_options options = {.gap = 0.5};
        const sl_status status = sl_find_faults(context, &map, &space, &options, &faults);
        memory.fail_at = 0;
        if (status != SL_OK) {
            assert_int_equal(status, SL_NO_MEMORY);
            assert_int_equal(memory.live, live);
        }
        sl_faults_destroy(context, &faults);
        sl_map_destroy(context, &map);
        sl_map_destroy(context, &cleaned);
        sl_space_destroy(context, &space);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        if (status == SL_OK) break;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_leak),
        cmocka_unit_test(test_leak_is_the_opening),
        cmocka_unit_test(test_doubt),
        cmocka_unit_test(test_leaks_closed),
        cmocka_unit_test(test_gaps),
        cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_cells),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_snap),
        cmocka_unit_test(test_snap_drops_cells),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
