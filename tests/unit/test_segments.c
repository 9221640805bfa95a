/// Segment measures: chains and crossings by hand; networks that are turned, mirrored, listed in
/// another order or the other way round; radii; what is refused.
#include "testing.h"

#include "sightline/axial.h"

#include <math.h>
#include <string.h>

enum { MOST = 256 };

static const sl_segment_options one_thread = {.threads = 1};

static void measure(sl_context *context, const sl_segment *segments, uint32_t count,
                    const sl_segment_options *options, sl_segment_measures *out) {
    assert_ok(context, sl_segment_measure(context, segments, count, options, out));
}

static bool same(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

static bool same_measures(const sl_segment_measures *a, const sl_segment_measures *b) {
    const double *x = (const double *)a, *y = (const double *)b;
    for (size_t k = 0; k < sizeof *a / sizeof *x; k++)
        if (!same(x[k], y[k])) return false;
    return true;
}

/// Segments of length 1 in a row.
static uint32_t make_chain(sl_segment *segments, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) segments[i] = (sl_segment){{i, 0}, {i + 1.0, 0}};
    return count;
}

/// Streets of a bent grid, some of them left out, and a street apart from it.
static uint32_t make_streets(sl_segment *segments) {
    static const int shift[5][5] = {
        {0, 2, -1, 3, 1}, {1, -2, 0, 2, -3}, {-1, 3, 1, 0, 2}, {2, 0, -2, 1, 3}, {0, 1, 3, -1, 0}};
    uint32_t count = 0;
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++) {
            const sl_point at = {10 * i + shift[i][j], 10 * j + shift[j][i]};
            if (i < 4 && (i * 7 + j) % 6)
                segments[count++] =
                    (sl_segment){at, {10 * (i + 1) + shift[i + 1][j], 10 * j + shift[j][i + 1]}};
            if (j < 4 && (i + j * 5) % 7)
                segments[count++] =
                    (sl_segment){at, {10 * i + shift[i][j + 1], 10 * (j + 1) + shift[j + 1][i]}};
        }
    segments[count++] = (sl_segment){{90, 90}, {95, 91}};
    return count;
}

static void chains_count_pairs(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_segment segments[9];
    sl_segment_measures m[9];
    const uint32_t n = make_chain(segments, 9);
    measure(context, segments, n, &one_thread, m);
    for (uint32_t i = 0; i < n; i++) {
        assert_true(m[i].connectivity == (i == 0 || i == n - 1 ? 1 : 2));
        assert_true(m[i].segment_length == 1 && m[i].t1024_node_count == n);
        assert_true(m[i].t1024_total_depth == 0 && isnan(m[i].t1024_integration));
        assert_true(m[i].t1024_choice == i * (n - 1 - i));
        assert_true(m[i].nach == log10(m[i].t1024_choice + 1) / log10(3));
    }
    sl_context_destroy(context);
}

/// From middle to middle: 1, 2, ... A path counts where both of its ends are within reach.
static void metric_radii_end_paths(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_segment segments[9];
    sl_segment_measures m[9];
    const uint32_t n = make_chain(segments, 9);
    for (uint32_t radius = 1; radius < 9; radius++) {
        const sl_segment_options options = {.threads = 1, .metric_radius = radius};
        measure(context, segments, n, &options, m);
        for (uint32_t i = 0; i < n; i++) {
            uint32_t nodes = 0, pairs = 0;
            for (uint32_t k = 0; k < n; k++) {
                nodes += (k > i ? k - i : i - k) <= radius;
                for (uint32_t j = i + 1; k < i && j < n; j++) pairs += j - k <= radius;
            }
            assert_true(m[i].t1024_node_count == nodes && m[i].t1024_choice == pairs);
        }
    }
    sl_context_destroy(context);
}

/// Four arms: one is straight ahead, two are a right angle away.
static void crossings_turn(void **state) {
    (void)state;
    static const sl_segment arms[] = {
        {{0, 0}, {3, 0}}, {{0, 2}, {0, 0}}, {{0, 0}, {-1, 0}}, {{0, -5}, {0, 0}}};
    sl_context *context = testing_context(NULL);
    sl_segment_measures m[4];
    measure(context, arms, 4, &one_thread, m);
    for (uint32_t i = 0; i < 4; i++) {
        assert_true(m[i].connectivity == 3 && m[i].t1024_node_count == 4);
        assert_true(m[i].t1024_total_depth == 2 && m[i].t1024_integration == 8);
        assert_true(m[i].t1024_choice == 0 && m[i].nach == 0);
        assert_true(m[i].nain == pow(4, 1.2) / 2);
    }
    const sl_segment_options ahead = {.threads = 1, .angular_radius = 0.5};
    measure(context, arms, 4, &ahead, m);
    for (uint32_t i = 0; i < 4; i++)
        assert_true(m[i].t1024_node_count == 2 && m[i].t1024_total_depth == 0);
    sl_context_destroy(context);
}

/// Two ways round a square tie: each has half of a pair.
static void equal_ways_share(void **state) {
    (void)state;
    static const sl_segment square[] = {{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}},   {{1, 1}, {0, 1}},
                                        {{0, 1}, {0, 0}}, {{-1, -1}, {0, 0}}, {{1, 1}, {2, 2}}};
    sl_context *context = testing_context(NULL);
    sl_segment_measures m[6];
    measure(context, square, 6, &one_thread, m);
    // Of the two diagonal arms one path leads by each corner: 45, 90 and 45 degrees.
    assert_true(m[4].t1024_total_depth == m[5].t1024_total_depth);
    assert_true(m[4].t1024_total_depth == 0.5 + 0.5 + 1.5 + 1.5 + 2);
    for (int i = 0; i < 4; i++) assert_true(m[i].t1024_choice == m[0].t1024_choice);
    assert_true(m[0].t1024_choice > 0.5);
    sl_context_destroy(context);
}

static void turned_networks_measure_the_same(void **state) {
    (void)state;
    static const double turns[][4] = {
        {0, -1, 1, 0}, {-1, 0, 0, -1}, {0, 1, -1, 0}, {-1, 0, 0, 1}, {0, 4, 4, 0}};
    static const sl_segment_options radii[] = {{.threads = 1},
                                               {.threads = 3},
                                               {.threads = 1, .metric_radius = 25},
                                               {.threads = 2, .angular_radius = 1}};
    sl_context *context = testing_context(NULL);
    sl_segment plain[MOST], turned[MOST];
    sl_segment_measures before[MOST], after[MOST];
    const uint32_t n = make_streets(plain);
    double choice = 0;
    for (size_t r = 0; r < sizeof radii / sizeof *radii; r++) {
        measure(context, plain, n, &radii[r], before);
        for (uint32_t i = 0; i < n; i++) choice += before[i].t1024_choice;
        for (size_t t = 0; t < sizeof turns / sizeof *turns; t++) {
            const double *by = turns[t], scale = fabs(by[0] + by[1]);
            sl_segment_options options = radii[r];
            options.metric_radius *= scale;
            for (uint32_t i = 0; i < n; i++) {
                // In another order, and every third the other way round.
                const sl_segment s = plain[i];
                const sl_segment moved = {
                    {by[0] * s.a.x + by[1] * s.a.y, by[2] * s.a.x + by[3] * s.a.y},
                    {by[0] * s.b.x + by[1] * s.b.y, by[2] * s.b.x + by[3] * s.b.y}};
                turned[n - 1 - i] = i % 3 ? moved : (sl_segment){moved.b, moved.a};
            }
            measure(context, turned, n, &options, after);
            for (uint32_t i = 0; i < n; i++) {
                sl_segment_measures *m = &after[n - 1 - i];
                m->segment_length /= scale;
                // Shares of ties are rounded to 2^-24 each, in another order.
                assert_true(fabs(m->t1024_choice - before[i].t1024_choice) < 1e-4);
                assert_true(fabs(m->nach - before[i].nach) < 1e-4);
                m->t1024_choice = before[i].t1024_choice;
                m->nach = before[i].nach;
                assert_true(same_measures(m, &before[i]));
            }
        }
    }
    assert_true(n > 30 && choice > 100);
    sl_context_destroy(context);
}

static void threads_do_not_change_bits(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_segment segments[MOST];
    sl_segment_measures one[MOST], three[MOST];
    const sl_segment_options three_threads = {.threads = 3};
    const uint32_t n = make_streets(segments);
    measure(context, segments, n, &one_thread, one);
    measure(context, segments, n, &three_threads, three);
    assert_memory_equal(one, three, n * sizeof *one);
    sl_context_destroy(context);
}

static void points_are_refused(void **state) {
    (void)state;
    static const sl_segment segments[] = {{{0, 0}, {1, 0}}, {{2, 2}, {2, 2}}};
    sl_context *context = testing_context(NULL);
    sl_segment_measures m[2];
    assert_int_equal(sl_segment_measure(context, segments, 2, &one_thread, m), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(context), "segment 1 has no length"));
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chains_count_pairs),
        cmocka_unit_test(metric_radii_end_paths),
        cmocka_unit_test(crossings_turn),
        cmocka_unit_test(equal_ways_share),
        cmocka_unit_test(turned_networks_measure_the_same),
        cmocka_unit_test(threads_do_not_change_bits),
        cmocka_unit_test(points_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
