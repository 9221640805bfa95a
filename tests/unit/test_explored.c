/// Explored areas: against the regions that they were made of, with holes, saved and read.
#include "testing.h"

#include <math.h>

typedef struct trial {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_random random;
} trial;

enum { EYES = 40, POINTS = 400, SIDE = 16 };

/// A hall with pillars.
static void start(trial *t, sl_context *context) {
    char text[2048] = "wall 0 0 16 0\nwall 16 0 16 16\nwall 16 16 0 16\nwall 0 16 0 0\n";
    *t = (trial){.context = context, .random = {4}};
    for (int i = 2; i < SIDE; i += 4)
        for (int k = 2; k < SIDE; k += 5) {
            char pillar[128];
            snprintf(pillar, sizeof pillar,
                     "wall %d %d %d.5 %d.25\nwall %d.5 %d.25 %d.25 %d.75\nwall %d.25 %d.75 %d %d\n",
                     i, k, i, k, i, k, i, k, i, k, i, k);
            strcat(text, pillar);
        }
    testing_space(context, text, &t->map, &t->space);
    assert_ok(context, sl_query_over(context, &t->space, &t->map, NULL, &t->query));
}

static void end(trial *t) {
    sl_query_destroy(t->context, t->query);
    sl_space_destroy(t->context, &t->space);
    sl_map_destroy(t->context, &t->map);
    sl_context_destroy(t->context);
}

static sl_point random_point(trial *t) {
    return (sl_point){SIDE * sl_random_unit(&t->random), SIDE * sl_random_unit(&t->random)};
}

static void explore(trial *t, sl_explored *explored, sl_point *eyes) {
    sl_region region = {0};
    for (int i = 0; i < EYES; i++) {
        eyes[i] = random_point(t);
        const sl_view view = sl_view_all_round(eyes[i]);
        assert_ok(t->context, sl_query_region(t->context, t->query, &view, &region));
        assert_ok(t->context, sl_explored_add_region(t->context, explored, &region));
    }
    sl_region_destroy(t->context, &region);
}

/// Whether some eye sees a point.
static bool is_seen(trial *t, const sl_point *eyes, sl_point point) {
    for (int i = 0; i < EYES; i++) {
        bool sees;
        assert_ok(t->context, sl_query_sees(t->context, t->query, eyes[i], point, &sees));
        if (sees) return true;
    }
    return false;
}

static double area_of(const sl_shape *shape) {
    double twice = 0;
    for (size_t i = 0, first = 0; i < shape->count; first = shape->ends[i++])
        for (size_t k = first; k < shape->ends[i]; k++) {
            const sl_point a = shape->points[k];
            const sl_point b = shape->points[k + 1 < shape->ends[i] ? k + 1 : first];
            twice += a.x * b.y - a.y * b.x;
        }
    return twice / 2;
}

static void test_holds_what_was_seen(void **state) {
    (void)state;
    testing_memory memory = {0};
    trial t;
    sl_explored *explored;
    sl_point eyes[EYES];
    sl_shape area;
    start(&t, testing_context(&memory));
    assert_ok(t.context, sl_explored_create(t.context, 0, &explored));
    explore(&t, explored, eyes);
    int seen = 0;
    for (int i = 0; i < POINTS; i++) {
        const sl_point point = random_point(&t);
        bool holds;
        assert_ok(t.context, sl_explored_holds(t.context, explored, point, &holds));
        assert_int_equal(holds, is_seen(&t, eyes, point));
        seen += holds;
    }
    assert_true(seen > POINTS / 2);
    // The pillars are holes.
    assert_ok(t.context, sl_explored_area(t.context, explored, &area));
    assert_true(area.count > 4);
    assert_true(area_of(&area) < SIDE * SIDE);
    sl_explored_destroy(t.context, explored);
    end(&t);
    assert_int_equal(memory.live, 0);
}

static void test_reads_what_it_writes(void **state) {
    (void)state;
    testing_memory memory = {0};
    trial t;
    sl_explored *explored, *again;
    sl_point eyes[EYES];
    sl_bytes one, other;
    start(&t, testing_context(&memory));
    assert_ok(t.context, sl_explored_create(t.context, 0, &explored));
    explore(&t, explored, eyes);
    assert_ok(t.context, sl_explored_write(t.context, explored, &one));
    assert_ok(t.context, sl_explored_read(t.context, "fog", one.data, one.size, &again));
    assert_ok(t.context, sl_explored_write(t.context, again, &other));
    assert_int_equal(one.size, other.size);
    assert_memory_equal(one.data, other.data, one.size);
    sl_free(t.context, one.data);
    sl_free(t.context, other.data);
    sl_explored_destroy(t.context, explored);
    sl_explored_destroy(t.context, again);
    end(&t);
    assert_int_equal(memory.live, 0);
}

static void test_resolution_bounds_the_outline(void **state) {
    (void)state;
    trial t;
    sl_explored *exact, *coarse;
    sl_point eyes[EYES];
    sl_shape fine, grid;
    start(&t, testing_context(NULL));
    assert_ok(t.context, sl_explored_create(t.context, 0, &exact));
    assert_ok(t.context, sl_explored_create(t.context, 0.25, &coarse));
    explore(&t, exact, eyes);
    t.random = (sl_random){4};
    explore(&t, coarse, eyes);
    assert_ok(t.context, sl_explored_area(t.context, exact, &fine));
    assert_ok(t.context, sl_explored_area(t.context, coarse, &grid));
    for (size_t i = 0; i < grid.ends[grid.count - 1]; i++) {
        assert_true(grid.points[i].x * 4 == floor(grid.points[i].x * 4));
        assert_true(grid.points[i].y * 4 == floor(grid.points[i].y * 4));
    }
    assert_true(fabs(area_of(&fine) - area_of(&grid)) < 0.05 * area_of(&fine));
    sl_explored_destroy(t.context, exact);
    sl_explored_destroy(t.context, coarse);
    end(&t);
}

static void test_bad_text_is_refused(void **state) {
    (void)state;
    static const char *const bad[] = {"",
                                      "sightline-explored 2\nresolution 0\n",
                                      "sightline-explored 1\n",
                                      "sightline-explored 1\nresolution -1\n",
                                      "sightline-explored 1\nresolution 0\nloop 2\n0 0\n1 0\n",
                                      "sightline-explored 1\nresolution 0\nloop 3\n0 0\n1 0\n",
                                      "sightline-explored 1\nresolution 0\nloop 3\n0 0\n1 0\n1 x\n",
                                      "sightline-explored 1\nresolution 0\nloop 1e99\n0 0\n"};
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        sl_explored *explored = NULL;
        assert_int_equal(sl_explored_read(context, "fog", bad[i], strlen(bad[i]), &explored),
                         SL_BAD_INPUT);
        assert_null(explored);
    }
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void test_memory_may_fail(void **state) {
    (void)state;
    testing_memory memory = {0};
    trial t;
    sl_explored *explored;
    sl_region region = {0};
    sl_bytes before, after;
    start(&t, testing_context(&memory));
    assert_ok(t.context, sl_explored_create(t.context, 0, &explored));
    const sl_view view = sl_view_all_round((sl_point){1, 1});
    const sl_view second = sl_view_all_round((sl_point){15, 9});
    assert_ok(t.context, sl_query_region(t.context, t.query, &view, &region));
    assert_ok(t.context, sl_explored_add_region(t.context, explored, &region));
    assert_ok(t.context, sl_explored_write(t.context, explored, &before));
    assert_ok(t.context, sl_query_region(t.context, t.query, &second, &region));
    sl_status status = SL_NO_MEMORY;
    for (long call = 1; status != SL_OK; call++) {
        sl_shape area;
        memory.fail_at = memory.calls + call;
        status = sl_explored_add_region(t.context, explored, &region);
        memory.fail_at = 0;
        if (status != SL_OK) {
            assert_int_equal(status, SL_NO_MEMORY);
            assert_ok(t.context, sl_explored_write(t.context, explored, &after));
            assert_int_equal(before.size, after.size);
            assert_memory_equal(before.data, after.data, before.size);
            sl_free(t.context, after.data);
            continue;
        }
        memory.fail_at = memory.calls + call;
        while (sl_explored_area(t.context, explored, &area) != SL_OK) {
            memory.fail_at = memory.calls + ++call;
            assert_true(call < 10000);
        }
        memory.fail_at = 0;
    }
    sl_free(t.context, before.data);
    sl_region_destroy(t.context, &region);
    sl_explored_destroy(t.context, explored);
    end(&t);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_holds_what_was_seen),
        cmocka_unit_test(test_reads_what_it_writes),
        cmocka_unit_test(test_resolution_bounds_the_outline),
        cmocka_unit_test(test_bad_text_is_refused),
        cmocka_unit_test(test_memory_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
