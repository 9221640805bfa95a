/// Segment measures: chains and crossings by hand; networks that are turned, mirrored, listed in
/// another order or the other way round; radii; rows, rings, spirals and wheels against all paths
/// of single segments, with weights and unlinked crossings too; what is refused.
#include "testing.h"

#include "sightline/axial.h"
#include "sightline/support.h"

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

// --- against all pairs of walks

enum { FEW = 40, WALKS = 2 * FEW };

/// Walk 2 s goes along segment s from a to b, walk 2 s + 1 back. Keys are turns times 2^32 and
/// steps; `paths` is how many paths have the least.
typedef struct all_pairs {
    uint64_t keys[WALKS][WALKS];
    double paths[WALKS][WALKS];
} all_pairs;

static sl_point walk_end(const sl_segment *segments, uint32_t walk) {
    return walk % 2 ? segments[walk / 2].a : segments[walk / 2].b;
}

static double heading(const sl_segment *segments, uint32_t walk) {
    const sl_point from = walk_end(segments, walk ^ 1), to = walk_end(segments, walk);
    return atan2(to.y - from.y, to.x - from.x);
}

static bool is_at(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// To the left, positive.
static double turn_of(const sl_segment *segments, uint32_t from, uint32_t to) {
    return remainder(heading(segments, to) - heading(segments, from), 2 * acos(-1));
}

/// Whether a walk may go on into another that begins at its end: at an unlinked crossing, only into
/// the one that has one to its left and one to its right.
static bool may_go_on(const sl_segment *segments, uint32_t count, const sl_segment_options *options,
                      uint32_t from, uint32_t to) {
    const sl_point end = walk_end(segments, from);
    bool linked = true;
    for (uint32_t i = 0; i < options->unlink_count; i++) linked &= !is_at(options->unlinks[i], end);
    uint32_t left = 0, right = 0;
    for (uint32_t w = 0; w < 2 * count; w++) {
        if (w / 2 == from / 2 || w / 2 == to / 2 || !is_at(walk_end(segments, w ^ 1), end))
            continue;
        left += turn_of(segments, from, w) > turn_of(segments, from, to);
        right += turn_of(segments, from, w) < turn_of(segments, from, to);
    }
    return linked || (left == 1 && right == 1);
}

/// The key of going from one walk on into another; 0 if it cannot be.
static uint64_t step_key(const sl_segment *segments, uint32_t count,
                         const sl_segment_options *options, uint32_t from, uint32_t to) {
    if (from / 2 == to / 2 || !is_at(walk_end(segments, from), walk_end(segments, to ^ 1)) ||
        !may_go_on(segments, count, options, from, to))
        return 0;
    return ((uint64_t)lround(fabs(turn_of(segments, from, to)) * 512 / acos(-1)) << 32) + 1;
}

/// From one walk to all, the nearest that is left first.
static void find_paths(const sl_segment *segments, uint32_t count,
                       const sl_segment_options *options, uint32_t from, all_pairs *out) {
    bool done[WALKS] = {false};
    uint64_t *keys = out->keys[from];
    double *paths = out->paths[from];
    for (uint32_t w = 0; w < 2 * count; w++) keys[w] = UINT64_MAX;
    memset(paths, 0, WALKS * sizeof *paths);
    keys[from] = 0;
    paths[from] = 1;
    for (;;) {
        uint32_t at = UINT32_MAX;
        for (uint32_t w = 0; w < 2 * count; w++)
            if (!done[w] && keys[w] < UINT64_MAX && (at == UINT32_MAX || keys[w] < keys[at]))
                at = w;
        if (at == UINT32_MAX) return;
        done[at] = true;
        for (uint32_t w = 0; w < 2 * count; w++) {
            const uint64_t step = step_key(segments, count, options, at, w);
            if (!step || keys[at] + step > keys[w]) continue;
            if (keys[at] + step < keys[w]) paths[w] = 0;
            keys[w] = keys[at] + step;
            paths[w] += paths[at];
        }
    }
}

static double weight_of(const sl_segment_options *options, uint32_t segment) {
    return options->weights ? options->weights[segment] : 1;
}

/// Sums up the pairs of two segments: both walks of one, both of the other.
static void sum_pair(const all_pairs *all, uint32_t count, const sl_segment_options *options,
                     uint32_t s, uint32_t t, uint64_t most, double *turns, double *nodes,
                     double *choice) {
    uint64_t least = UINT64_MAX;
    double paths = 0;
    for (uint32_t k = 0; k < 4; k++)
        if (all->keys[2 * s + k / 2][2 * t + k % 2] < least)
            least = all->keys[2 * s + k / 2][2 * t + k % 2];
    if (least >= most) return;
    *turns += (double)(least >> 32) * weight_of(options, t);
    *nodes += weight_of(options, t);
    for (uint32_t k = 0; k < 4; k++)
        if (all->keys[2 * s + k / 2][2 * t + k % 2] == least)
            paths += all->paths[2 * s + k / 2][2 * t + k % 2];
    for (uint32_t k = 0; k < 4; k++) {
        const uint32_t from = 2 * s + k / 2, to = 2 * t + k % 2;
        if (all->keys[from][to] != least) continue;
        for (uint32_t w = 0; w < 2 * count; w++)
            if (w / 2 != s && w / 2 != t && all->keys[from][w] != UINT64_MAX &&
                all->keys[w][to] != UINT64_MAX && all->keys[from][w] + all->keys[w][to] == least)
                choice[w / 2] += all->paths[from][w] * all->paths[w][to] / paths / 2 *
                                 weight_of(options, s) * weight_of(options, t);
    }
}

/// `plain`: without radius.
static void check_against_all_paths(sl_context *context, const sl_segment *segments, uint32_t count,
                                    const sl_segment_options *plain) {
    static all_pairs all;
    static const double radii[] = {0, 0.3, 1, 2.5};
    for (uint32_t w = 0; w < 2 * count; w++) find_paths(segments, count, plain, w, &all);
    for (size_t r = 0; r < sizeof radii / sizeof *radii; r++) {
        sl_segment_options options = *plain;
        options.angular_radius = radii[r];
        const uint64_t most =
            radii[r] > 0 ? ((uint64_t)floor(radii[r] * 256) + 1) << 32 : UINT64_MAX;
        sl_segment_measures m[FEW];
        double choice[FEW] = {0};
        measure(context, segments, count, &options, m);
        for (uint32_t s = 0; s < count; s++) {
            double turns = 0, nodes = weight_of(plain, s);
            for (uint32_t t = 0; t < count; t++)
                if (s != t) sum_pair(&all, count, plain, s, t, most, &turns, &nodes, choice);
            // Weights are whole numbers here, so that sums are exact.
            assert_true(m[s].t1024_node_count == nodes);
            assert_true(m[s].t1024_total_depth == turns / 256);
        }
        // Shares are rounded to 2^-24, a few for each root.
        for (uint32_t s = 0; s < count; s++)
            assert_true(fabs(m[s].t1024_choice - choice[s]) < 4 * FEW * 0x1p-24);
    }
}

/// Corners of a small lattice, joined by chance: rows, rings, crossings, and some streets twice.
static uint32_t make_by_chance(sl_segment *segments, sl_random *random, uint32_t size) {
    uint32_t count = 0;
    const uint32_t most = 8 + sl_random_below(random, FEW - 8);
    while (count < most) {
        const uint32_t x = sl_random_below(random, size), y = sl_random_below(random, size);
        const uint32_t u = sl_random_below(random, 3), v = sl_random_below(random, 3);
        if (u != 1 || v != 1) segments[count++] = (sl_segment){{x, y}, {x + u - 1.0, y + v - 1.0}};
    }
    return count;
}

static void networks_by_chance_agree_with_all_paths(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {1};
    for (uint32_t i = 0; i < testing_seeds(60); i++) {
        sl_segment segments[FEW];
        const uint32_t count = make_by_chance(segments, &random, 3 + i % 8);
        check_against_all_paths(context, segments, count, &one_thread);
    }
    sl_context_destroy(context);
}

static void weights_agree_with_all_paths(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {2};
    for (uint32_t i = 0; i < testing_seeds(30); i++) {
        sl_segment segments[FEW];
        double weights[FEW];
        const sl_segment_options weighted = {.threads = 1, .weights = weights};
        const uint32_t count = make_by_chance(segments, &random, 3 + i % 8);
        for (uint32_t s = 0; s < count; s++) weights[s] = sl_random_below(&random, 4);
        check_against_all_paths(context, segments, count, &weighted);
    }
    sl_context_destroy(context);
}

/// Streets of a lattice, cut where they cross; a third of the crossings are unlinked.
static void unlinks_agree_with_all_paths(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {3};
    uint32_t all = 0;
    for (uint32_t i = 0; i < testing_seeds(30); i++) {
        sl_segment segments[FEW];
        sl_point at[4][4], unlinks[4];
        uint32_t count = 0, unlinked = 0;
        for (int k = 0; k < 16; k++)
            at[k / 4][k % 4] = (sl_point){40 * (k / 4) + sl_random_below(&random, 9),
                                          40 * (k % 4) + sl_random_below(&random, 9)};
        for (int x = 0; x < 4; x++)
            for (int y = 0; y < 4; y++) {
                if (x < 3) segments[count++] = (sl_segment){at[x][y], at[x + 1][y]};
                if (y < 3) segments[count++] = (sl_segment){at[x][y + 1], at[x][y]};
                if (x % 3 && y % 3 && sl_random_below(&random, 2)) unlinks[unlinked++] = at[x][y];
            }
        const sl_segment_options options = {
            .threads = 1, .unlinks = unlinks, .unlink_count = unlinked};
        check_against_all_paths(context, segments, count, &options);
        all += unlinked;
    }
    assert_true(all > 10);
    sl_context_destroy(context);
}

/// Two streets, one over the other: neither meets the other, within a metric radius too.
static void bridges_are_no_junctions(void **state) {
    (void)state;
    static const sl_segment cross[] = {
        {{0, 0}, {3, 0}}, {{0, 2}, {0, 0}}, {{0, 0}, {-1, 0}}, {{0, -5}, {0, 0}}, {{3, 0}, {9, 0}}};
    static const sl_point bridge = {0, 0}, twice[] = {{0, 0}, {0, 0}}, end = {3, 0};
    sl_context *context = testing_context(NULL);
    sl_segment_measures m[5];
    for (uint32_t radius = 0; radius < 100; radius += 50) {
        const sl_segment_options options = {
            .threads = 1, .metric_radius = radius, .unlinks = &bridge, .unlink_count = 1};
        measure(context, cross, 5, &options, m);
        assert_true(m[0].connectivity == 2 && m[0].t1024_node_count == 3);
        assert_true(m[0].t1024_choice == 1 && m[0].t1024_total_depth == 0);
        assert_true(m[1].connectivity == 1 && m[1].t1024_node_count == 2);
    }
    sl_segment_options options = {.threads = 1, .unlinks = twice, .unlink_count = 2};
    assert_int_equal(sl_segment_measure(context, cross, 5, &options, m), SL_BAD_ARGUMENT);
    options = (sl_segment_options){.threads = 1, .unlinks = &end, .unlink_count = 1};
    assert_int_equal(sl_segment_measure(context, cross, 5, &options, m), SL_BAD_ARGUMENT);
    sl_point found;
    assert_ok(context, sl_segment_crossing(context, cross, 5, (sl_point){0.1, -0.2}, &found));
    assert_true(found.x == 0 && found.y == 0);
    assert_int_equal(sl_segment_crossing(context, cross, 5, (sl_point){3, 0.1}, &found),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_segment_crossing(context, cross, 5, (sl_point){0.6, 0}, &found),
                     SL_BAD_ARGUMENT);
    sl_context_destroy(context);
}

static void weights_out_of_range_are_refused(void **state) {
    (void)state;
    static const sl_segment segments[] = {{{0, 0}, {1, 0}}, {{1, 0}, {2, 2}}};
    static const double wrong[][2] = {{1, -1}, {1, NAN}, {INFINITY, 1}};
    sl_context *context = testing_context(NULL);
    sl_segment_measures m[2];
    for (size_t i = 0; i < 3; i++) {
        const sl_segment_options options = {.threads = 1, .weights = wrong[i]};
        assert_int_equal(sl_segment_measure(context, segments, 2, &options, m), SL_BAD_ARGUMENT);
    }
    static const double none[2] = {0, 0}, much[2] = {1e100, 1e100};
    sl_segment_options options = {.threads = 1, .weights = none};
    measure(context, segments, 2, &options, m);
    assert_true(m[0].t1024_node_count == 0 && m[0].t1024_choice == 0);
    options.weights = much;
    measure(context, segments, 2, &options, m);
    assert_true(m[0].t1024_node_count == 2e100 && m[0].t1024_choice == 0);
    sl_context_destroy(context);
}

/// Choice is counted in units: they are as small as weights are.
static void tiny_weights_count(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_segment segments[9];
    sl_segment_measures m[9];
    double weights[9];
    const sl_segment_options options = {.threads = 1, .weights = weights};
    const uint32_t n = make_chain(segments, 9);
    for (uint32_t i = 0; i < n; i++) weights[i] = 0x1p-30;
    measure(context, segments, n, &options, m);
    for (uint32_t i = 0; i < n; i++)
        assert_true(m[i].t1024_node_count == n * 0x1p-30 &&
                    m[i].t1024_choice == i * (n - 1 - i) * 0x1p-60);
    sl_context_destroy(context);
}

static void pieces_share_the_value_of_their_street(void **state) {
    (void)state;
    static const sl_segment segments[] = {
        {{0, 0}, {3, 0}}, {{0, 0}, {0, 7}}, {{3, 0}, {3, 1}}, {{9, 9}, {9, 9}}};
    static const uint32_t streets[] = {2, 0, 2};
    static const double values[] = {5, 1, 8};
    sl_context *context = testing_context(NULL);
    double weights[4];
    assert_ok(context, sl_segment_share(context, segments, 3, streets, values, 3, weights));
    assert_true(weights[0] == 6 && weights[1] == 5 && weights[2] == 2);
    assert_int_equal(sl_segment_share(context, segments, 3, streets, values, 2, weights),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_segment_share(context, segments + 3, 1, streets, values, 3, weights),
                     SL_BAD_ARGUMENT);
    sl_context_destroy(context);
}

/// Rows that turn by more than a half turn: rings, a ring with an arm, a spiral with a street
/// across.
static void rings_and_spirals_agree_with_all_paths(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint32_t sides = 3; sides < 20; sides++)
        for (uint32_t shape = 0; shape < 3; shape++) {
            sl_segment segments[FEW];
            sl_point at[FEW];
            uint32_t count = 0;
            for (uint32_t i = 0; i <= sides; i++) {
                const double far = shape == 2 ? 10 + i : 10, angle = (double)i * 0.7;
                at[i] = (sl_point){floor(far * 100 * cos(shape == 2 ? angle : 6.28 * i / sides)),
                                   floor(far * 100 * sin(shape == 2 ? angle : 6.28 * i / sides))};
            }
            if (shape != 2) at[sides] = at[0];
            for (uint32_t i = 0; i < sides; i++) {
                segments[count] = (sl_segment){at[i], at[i + 1]};
                if (i % 3 == 1) segments[count] = (sl_segment){at[i + 1], at[i]};
                count++;
            }
            if (shape == 1) segments[count++] = (sl_segment){at[1], {2000, 1700}};
            if (shape == 2) segments[count++] = (sl_segment){at[sides / 2], at[sides]};
            check_against_all_paths(context, segments, count, &one_thread);
        }
    sl_context_destroy(context);
}

/// Wheels with up to 12 spokes at uneven angles: crossings of many arms, sharp turns, and a rim
/// that is walked both ways.
static void wheels_agree_with_all_paths(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {4};
    for (uint32_t i = 0; i < testing_seeds(60); i++) {
        const uint32_t spokes = 3 + i % 10;
        sl_segment segments[FEW];
        sl_point rim[12];
        uint32_t count = 0;
        for (uint32_t k = 0; k < spokes; k++) {
            const double angle = (k + 0.9 * sl_random_below(&random, 100) / 100) * 6.28 / spokes;
            const double far = 300 + sl_random_below(&random, 700);
            rim[k] = (sl_point){floor(far * cos(angle)), floor(far * sin(angle))};
        }
        for (uint32_t k = 0; k < spokes; k++) {
            const sl_point next = rim[(k + 1) % spokes];
            if (sl_random_below(&random, 5)) segments[count++] = (sl_segment){{0, 0}, rim[k]};
            if (sl_random_below(&random, 8)) segments[count++] = (sl_segment){next, rim[k]};
            if (!sl_random_below(&random, 3))
                segments[count++] = (sl_segment){rim[k], {3 * rim[k].x, 2 * rim[k].y}};
        }
        check_against_all_paths(context, segments, count, &one_thread);
    }
    sl_context_destroy(context);
}

/// From the lowest segment, paths come to the row from 0,0 to 20,0 by both ends, the one from the
/// right somewhat later. It is the better one only two chains on: in the last but one.
static void later_walks_count_beyond_the_next_crossing(void **state) {
    (void)state;
    static const sl_segment segments[] = {
        {{-40, -50}, {-30, -50}}, {{-30, -50}, {20, -50}}, {{20, -50}, {40, -30}},
        {{40, -30}, {45, -10}},   {{45, -10}, {35, 2}},    {{35, 2}, {20, 0}},
        {{-40, -50}, {-60, -30}}, {{-60, -30}, {-50, -5}}, {{-50, -5}, {-10, 0}},
        {{-10, 0}, {0, 0}},       {{0, 0}, {10, 0}},       {{10, 0}, {20, 0}},
        {{10, 0}, {10, -8}},      {{0, 0}, {-10, 1}},      {{20, 0}, {20, 8}}};
    sl_context *context = testing_context(NULL);
    check_against_all_paths(context, segments, sizeof segments / sizeof *segments, &one_thread);
    sl_context_destroy(context);
}

/// More steps than one chain takes, on one of two ways that turn equally. Only a segment at each
/// end has weight, so their path is the only one that counts.
static void long_streets_are_several_chains(void **state) {
    (void)state;
    enum { LONG = 65600, SHORT = 100, EACH = LONG / SHORT, ALL = LONG + 1 + SHORT + 1 + 2 };
    sl_context *context = testing_context(NULL);
    sl_segment *segments = sl_alloc_array(context, ALL, sizeof *segments);
    sl_segment_measures *m = sl_alloc_array(context, ALL, sizeof *m);
    double *weights = sl_alloc_array(context, ALL, sizeof *weights);
    assert_true(segments && m && weights);
    const sl_point end = {2 * LONG, 0};
    uint32_t count = 0;
    for (double i = 0; i < LONG; i++) segments[count++] = (sl_segment){{i, i}, {i + 1, i + 1}};
    segments[count++] = (sl_segment){{LONG, LONG}, end};
    for (double i = 0; i < SHORT; i++)
        segments[count++] = (sl_segment){{i * EACH, -i * EACH}, {(i + 1) * EACH, -(i + 1) * EACH}};
    segments[count++] = (sl_segment){{LONG, -LONG}, end};
    for (uint32_t k = 0; k < 2; k++) {
        weights[count] = 1;
        segments[count++] = (sl_segment){{k * end.x, 0}, {k * end.x + 2.0 * k - 1, 0}};
    }
    assert_int_equal(count, ALL);
    const sl_segment_options options = {.threads = 1, .weights = weights};
    measure(context, segments, count, &options, m);
    for (uint32_t i = 0; i < count; i++)
        assert_true(m[i].t1024_choice == (i > LONG && i < ALL - 2));
    sl_free(context, weights);
    sl_free(context, m);
    sl_free(context, segments);
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
        cmocka_unit_test(networks_by_chance_agree_with_all_paths),
        cmocka_unit_test(weights_agree_with_all_paths),
        cmocka_unit_test(unlinks_agree_with_all_paths),
        cmocka_unit_test(bridges_are_no_junctions),
        cmocka_unit_test(weights_out_of_range_are_refused),
        cmocka_unit_test(tiny_weights_count),
        cmocka_unit_test(pieces_share_the_value_of_their_street),
        cmocka_unit_test(rings_and_spirals_agree_with_all_paths),
        cmocka_unit_test(wheels_agree_with_all_paths),
        cmocka_unit_test(later_walks_count_beyond_the_next_crossing),
        cmocka_unit_test(long_streets_are_several_chains),
        cmocka_unit_test(points_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
