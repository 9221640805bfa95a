// Lines to be seen against points close together along them, each asked of sl_query_sees and
// distances; and against all subsets of the places.
#include "place_scene.h"

enum { LINES = 4 };
/// Between points along lines, and how far beside a point the same must hold, else it is not
/// decided.
#define STEP   0.003
#define BESIDE 1e-6

typedef struct samples {
    SL_ARRAY(uint32_t) seers; ///< by point, a bit for each place that sees it
    SL_ARRAY(double) weights; ///< by point
    double length;            ///< of what is inside
} samples;

static sl_point point_at(const sl_segment *line, double share) {
    return (sl_point){line->a.x + share * (line->b.x - line->a.x),
                      line->a.y + share * (line->b.y - line->a.y)};
}

/// False where the point is outside, or what sees it is not decided.
static bool look(scene *s, const sl_segment *line, double share, double length, uint32_t *seers) {
    uint32_t sets[3] = {0};
    bool near = false;
    for (int k = 0; k < 3; k++) {
        const sl_point at = point_at(line, share + (k - 1) * BESIDE / length);
        if (!sl_space_is_inside(&s->space, at)) return false;
        for (int i = 0; i < PLACES; i++)
            sets[k] |= (uint32_t)sees(s, &s->places[i], at, &near) << i;
    }
    *seers = sets[1];
    return !near && sets[0] == sets[1] && sets[1] == sets[2];
}

static samples sample_lines(scene *s) {
    samples all = {0};
    for (uint32_t i = 0; i < s->area.line_count; i++) {
        const sl_segment *line = &s->area.lines[i];
        const double length = hypot(line->b.x - line->a.x, line->b.y - line->a.y);
        for (double at = STEP / 2; at < length; at += STEP) {
            uint32_t seers;
            if (sl_space_is_inside(&s->space, point_at(line, at / length))) all.length += STEP;
            if (!look(s, line, at / length, length, &seers)) continue;
            assert_ok(s->context, SL_ARRAY_ROOM(s->context, &all.seers, 1));
            assert_ok(s->context, SL_ARRAY_ROOM(s->context, &all.weights, 1));
            all.seers.items[all.seers.count++] = seers;
            all.weights.items[all.weights.count++] =
                STEP * (s->area.line_weights ? s->area.line_weights[i] : 1);
        }
    }
    return all;
}

static void samples_destroy(scene *s, samples *all) {
    sl_free(s->context, all->seers.items);
    sl_free(s->context, all->weights.items);
}

/// Whether a set sees points as often as asked, or as all places do.
static bool does(const scene *s, const uint32_t *seers, size_t count, uint32_t set) {
    const uint32_t cover = s->area.cover ? s->area.cover : 1;
    for (size_t i = 0; i < count; i++) {
        const uint32_t most = bits_in(seers[i]);
        if (bits_in(seers[i] & set) < (most < cover ? most : cover)) return false;
    }
    return true;
}

static double seen_by(const samples *all, uint32_t set) {
    double sum = 0;
    for (size_t i = 0; i < all->seers.count; i++)
        sum += all->seers.items[i] & set ? all->weights.items[i] : 0;
    return sum;
}

/// No cheaper set of places sees all witnesses, which are asked anew.
static void assert_bound(scene *s, const sl_area_placement *placed) {
    uint32_t seers[4096];
    bool near = false;
    assert_true(placed->witness_count <= 4096);
    for (uint32_t w = 0; w < placed->columns.row_count; w++) {
        seers[w] = 0;
        for (int i = 0; i < PLACES; i++)
            seers[w] |= (uint32_t)sees(s, &s->places[i], placed->witnesses[w], &near) << i;
    }
    for (uint32_t set = 0; set < 1u << PLACES; set++)
        if (cost_of(s, set) < placed->lower)
            assert_false(does(s, seers, placed->columns.row_count, set));
}

static const sl_viewpoint kinds[] = {{.fov = 360},
                                     {.fov = 130},
                                     {.fov = 360, .range = 5},
                                     {.fov = 360, .nearest = 1.5},
                                     {.fov = 200, .range = 6, .nearest = 0.5}};

/// Lines at random, across walls and solid ground too. `k` is the number of the scene.
static void begin_lines(scene *s, unsigned k, sl_segment lines[LINES]) {
    sl_random random = {900 + k};
    begin(s, k % 2 ? TURNED : PLAN, 1100 + k, kinds[k % 5]);
    for (int i = 1; i < PLACES; i += 2) s->places[i].at = draw(s, &random);
    for (int i = 0; i < LINES; i++) lines[i] = (sl_segment){draw(s, &random), draw(s, &random)};
    s->area.lines = lines;
    s->area.line_count = LINES;
}

static void test_fewest(void **state) {
    (void)state;
    const unsigned seeds = testing_seeds(20);
    for (unsigned k = 0; k < seeds; k++) {
        scene s;
        sl_segment lines[LINES];
        begin_lines(&s, k, lines);
        if (k % 4 == 1) s.area.costs = s.costs;
        if (k % 5 == 2) s.area.cover = 2;
        samples all = sample_lines(&s);
        sl_area_placement placed = place(&s);
        assert_int_equal(placed.lower, placed.upper);
        assert_true(does(&s, all.seers.items, all.seers.count, set_of(&placed)));
        assert_bound(&s, &placed);
        double inside = 0, blind = 0;
        for (int i = 0; i < LINES; i++) inside += placed.line_lengths[i];
        for (uint32_t i = 0; i < placed.blind_count; i++) blind += placed.blind[i].area;
        assert_true(fabs(placed.area - inside) < 1e-9);
        assert_true(fabs(placed.area - all.length) < 0.01 * all.length);
        assert_true(fabs(blind - placed.blind_area) < 1e-9);
        assert_true(fabs(placed.seen + placed.blind_area - placed.area) < 1e-9);
        if (!s.area.cover) assert_true(fabs(placed.seen - seen_by(&all, ~0u)) < 0.01 * all.length);
        samples_destroy(&s, &all);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

static void test_most(void **state) {
    (void)state;
    const double weights[LINES] = {1, 5, 0.5, 2};
    const unsigned seeds = testing_seeds(10);
    for (unsigned k = 0; k < seeds; k++) {
        scene s;
        sl_segment lines[LINES];
        begin_lines(&s, 40 + k, lines);
        s.area.count = 1 + k % 3;
        if (k % 2) s.area.line_weights = weights;
        samples all = sample_lines(&s);
        sl_area_placement placed = place(&s);
        const double off = 0.02 * placed.area;
        assert_true(placed.count <= s.area.count);
        assert_true(fabs(placed.seen - seen_by(&all, set_of(&placed))) < off);
        for (uint32_t set = 0; set < 1u << PLACES; set++)
            if (bits_in(set) == s.area.count)
                assert_true(seen_by(&all, set) < placed.seen_most + off);
        samples_destroy(&s, &all);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

/// An area and a line beside it: both are seen, and the area alone needs fewer.
static void test_with_area(void **state) {
    (void)state;
    const sl_point corners[] = {{9.5, 0.5}, {11, 0.5}, {11, 2}, {9.5, 2}};
    const size_t count = 4;
    const sl_shape zone = {corners, &count, 1};
    const sl_segment line = {{1, 7}, {6, 7}};
    scene s;
    begin(&s, PLAN, 7, (sl_viewpoint){.fov = 360});
    for (int i = 0; i < PLACES; i++)
        s.places[i].at = (sl_point){i < 5 ? 1.0 + i / 4. : 11.5, i % 5 ? 7.5 : 1};
    s.area.see = &zone;
    sl_area_placement alone = place(&s);
    assert_int_equal(alone.upper, 1);
    s.area.lines = &line;
    s.area.line_count = 1;
    sl_area_placement both = place(&s);
    assert_int_equal(both.lower, 2);
    assert_int_equal(both.upper, 2);
    assert_true(fabs(both.area - 2.25) < 1e-9);
    assert_true(fabs(both.line_lengths[0] - 5) < 1e-9);
    sl_area_placement_destroy(s.context, &alone);
    sl_area_placement_destroy(s.context, &both);
    end(&s);
}

static void test_refusals(void **state) {
    (void)state;
    const sl_point corners[] = {{0.5, 0.5}, {1, 0.5}, {1, 1}};
    const size_t count = 3;
    const sl_shape zone = {corners, &count, 1};
    const double weight = 0;
    sl_segment line = {{3.5, 3.5}, {4.5, 4.5}};
    scene s;
    begin(&s, PLAN, 5, (sl_viewpoint){.fov = 360, .range = 1});
    s.area.lines = &line;
    s.area.line_count = 1;
    assert_refused(&s, "nothing of the lines to be seen is inside");
    line = (sl_segment){{0.5, 0.5}, {1, 0.5}};
    for (int i = 0; i < PLACES; i++) s.places[i].at = (sl_point){11, 7};
    assert_refused(&s, "none of the 10 places sees any of the lines, at (0.75, 0.5); the nearest");
    s.area.line_weights = &weight;
    assert_refused(&s, "its weight must be over 0");
    s.area.line_weights = NULL;
    s.area.scan_range = 3;
    assert_refused(&s, "not seen with scans of walls");
    s.area.scan_range = 0;
    s.area.count = 1;
    s.area.see = &zone;
    assert_refused(&s, "not both");
    end(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fewest),
        cmocka_unit_test(test_most),
        cmocka_unit_test(test_with_area),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
