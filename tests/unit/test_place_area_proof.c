// Proofs of placements among given places: other code confirms what is found, with cones, ranges,
// dead zones, costs, fixed places, zones and demands, and no change of a proof makes it prove more.
#include "place_scene.h"

#include "sightline/place_proof.h"

#include <string.h>

#define FLAT "open 0 0 11.457138 3.572 9.078 11.21 -2.379 7.638\nwall 3 3 5 3.7\nwall 6 4 5.5 6\n"

static sl_place_area_verdict check(scene *s, const sl_area_placement *claim) {
    sl_place_area_verdict v;
    assert_ok(s->context, sl_place_area_proof_check(s->context, s->query, &s->area, claim, &v));
    return v;
}

/// Both bounds hold. With one of the chosen places less, something is left that it saw, unless it
/// is spare.
static void confirm(scene *s, const sl_area_placement *placed) {
    const sl_place_area_verdict v = check(s, placed);
    assert_int_equal(v.weak, UINT32_MAX);
    assert_int_equal(v.lower, placed->lower);
    assert_int_equal(v.upper, placed->upper);
    assert_true(v.sees_as_all);
    if (placed->blind_area > 1e-6 * placed->area) assert_false(v.sees_all);
    if (placed->lower < placed->upper || s->area.fixed_count) return;
    for (uint32_t out = 0; out < placed->count; out++) {
        uint32_t rest[PLACES];
        sl_area_placement less = *placed;
        less.chosen = rest;
        less.count = 0;
        for (uint32_t i = 0; i < placed->count; i++)
            if (i != out) rest[less.count++] = placed->chosen[i];
        const sl_place_area_verdict left = check(s, &less);
        assert_false(left.sees_as_all);
        assert_false(left.sees_all);
        assert_true(left.place < PLACES);
        assert_true(left.upper < left.lower);
    }
}

static const sl_viewpoint kinds[] = {{.fov = 360},
                                     {.fov = 90},
                                     {.fov = 200, .range = 6},
                                     {.fov = 360, .range = 5, .nearest = 1},
                                     {.fov = 180, .nearest = 0.5}};

static void other_code_confirms(void **state) {
    (void)state;
    static const char *const plans[] = {PLAN, FLAT};
    const unsigned seeds = (unsigned)testing_seeds(30);
    for (unsigned k = 0; k < seeds; k++) {
        scene s;
        begin(&s, plans[k % 2], 100 + k, kinds[k / 2 % 5]);
        const uint32_t fixed[] = {2, 7};
        if (k % 3 == 0) s.area.costs = s.costs;
        if (k % 4 == 3) s.area.cover = 2;
        if (k % 5 == 4) s.area.fixed = fixed, s.area.fixed_count = 2;
        sl_area_placement placed = place(&s);
        confirm(&s, &placed);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

/// Points at random and beside corners confirm what the check says of sets of places at random.
static void points_confirm_the_check(void **state) {
    (void)state;
    uint32_t all = 0, some = 0;
    const unsigned seeds = (unsigned)testing_seeds(40);
    for (unsigned k = 0; k < seeds; k++) {
        scene s;
        sl_random random = {k};
        uint32_t chosen[PLACES];
        sl_area_placement claim = {.chosen = chosen};
        begin(&s, k % 2 ? FLAT : PLAN, 500 + k, kinds[k / 2 % 5]);
        s.area.cover = 1 + k % 3 / 2;
        for (uint32_t i = 0; i < PLACES; i++)
            if (sl_random_below(&random, 4)) chosen[claim.count++] = i;
        const sl_place_area_verdict v = check(&s, &claim);
        all += v.sees_all;
        some += v.sees_as_all;
        for (int n = 0; n < 1000; n++) {
            const sl_point at = sample(&s, &random, n);
            uint32_t seen = 0;
            bool near = false, other = false, is_seen[PLACES];
            for (int i = 0; i < PLACES; i++) is_seen[i] = sees(&s, &s.places[i], at, &near);
            for (uint32_t i = 0; i < claim.count; i++) seen += is_seen[chosen[i]];
            for (uint32_t i = 0, c = 0; i < PLACES; i++) {
                if (c < claim.count && chosen[c] == i)
                    c++;
                else
                    other |= is_seen[i];
            }
            if (near || seen >= s.area.cover) continue;
            assert_false(v.sees_all);
            if (other) assert_false(v.sees_as_all);
        }
        end(&s);
    }
    assert_true(all < some && some < seeds);
}

/// Zones that overlap, with a hole, and across walls.
static void zones_are_what_is_to_be_seen(void **state) {
    (void)state;
    static const sl_point points[] = {{1, 1},   {6, 1},   {6, 7}, {1, 7}, {2, 2}, {2, 4},
                                      {4.5, 4}, {4.5, 2}, {4, 5}, {9, 5}, {9, 9}, {4, 9}};
    static const size_t ends[] = {4, 8, 12};
    const sl_shape see = {points, ends, 3};
    for (unsigned k = 0; k < 10; k++) {
        scene s;
        begin(&s, k % 2 ? FLAT : PLAN, 300 + k, kinds[k / 2]);
        s.area.see = &see;
        sl_area_placement placed = place(&s);
        confirm(&s, &placed);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

/// Four circles that touch in one point, which is a place with a dead zone, too.
static void circles_that_touch(void **state) {
    (void)state;
    scene s;
    begin(&s, "open 0 0 8 0 8 8 0 8\n", 1, (sl_viewpoint){.fov = 360, .range = 4});
    for (int i = 0; i < PLACES; i++) s.places[i].at = (sl_point){4 * (i % 3), 4 * (i / 3 % 3)};
    sl_area_placement placed = place(&s);
    confirm(&s, &placed);
    sl_area_placement_destroy(s.context, &placed);
    end(&s);
}

/// What the check says of the one witness (4, 4) in an empty square, which two places see and
/// nobody sees all around: their borders lie along the axes.
static sl_place_area_verdict one_witness(double x, double y, double heading, uint32_t cover) {
    scene s;
    begin(&s, "open 0 0 8 0 8 8 0 8\n", 1, (sl_viewpoint){.fov = 90});
    s.places[0] = (sl_viewpoint){.at = {2, 4}, .heading = 45, .fov = 90};
    s.places[1] = (sl_viewpoint){.at = {x, y}, .heading = heading, .fov = 90};
    s.area.place_count = 2;
    s.area.cover = cover;
    size_t ends[] = {1, 2};
    uint32_t entries[] = {0, 0}, demands[] = {cover}, chosen[] = {0, 1};
    sl_point witness = {4, 4};
    const sl_cover_problem columns = {
        .row_count = 1, .column_count = 2, .ends = ends, .entries = entries, .demands = demands};
    sl_cover_result result;
    assert_ok(s.context, sl_cover_solve(s.context, &columns, NULL, &result));
    const sl_area_placement claim = {.chosen = chosen,
                                     .count = 2,
                                     .witnesses = &witness,
                                     .columns = columns,
                                     .proof = result.proof};
    const sl_place_area_verdict v = check(&s, &claim);
    sl_cover_result_destroy(s.context, &result);
    end(&s);
    return v;
}

/// A witness counts as often as places see one sector there.
static void witnesses_on_borders(void **state) {
    (void)state;
    for (uint32_t cover = 1; cover <= 2; cover++) {
        // Both see the sector above and to the left.
        const sl_place_area_verdict both = one_witness(4, 2, 135, cover);
        assert_int_equal(both.weak, UINT32_MAX);
        assert_int_equal(both.lower, cover);
        // One sees what is above, one what is below.
        const sl_place_area_verdict apart = one_witness(6, 4, 225, cover);
        assert_int_equal(apart.weak, cover == 1 ? UINT32_MAX : 0);
        assert_int_equal(apart.lower, cover == 1);
    }
}

/// Four headings at corners of a plan along the axes, as planners choose them. Borders are along
/// the axes, and between them: there several are in one line.
static void cones_along_walls(void **state) {
    (void)state;
    static const sl_point at[] = {{3, 3}, {5, 5}, {7, 2}};
    scene s;
    for (int turned = 0; turned <= 45; turned += 45) {
        begin(&s, PLAN, 1, (sl_viewpoint){.fov = 90});
        for (int i = 0; i < PLACES; i++) {
            s.places[i].at = at[i / 4];
            s.places[i].heading = turned + 90 * (i % 4);
        }
        sl_area_placement placed = place(&s);
        confirm(&s, &placed);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

static char *print(scene *s, const sl_area_placement *placed, size_t *size) {
    char *text = NULL;
    FILE *stream = open_memstream(&text, size);
    assert_non_null(stream);
    assert_ok(s->context,
              sl_place_area_proof_print(s->context, s->query, &s->area, placed, stream));
    assert_int_equal(fclose(stream), 0);
    return text;
}

static sl_status parse(scene *s, const char *text, size_t size, sl_area_placement *out) {
    return sl_place_area_proof_parse(s->context, s->query, &s->area, "proof.json", text, size, out);
}

/// What is read back is what was written.
static void files_keep_it(void **state) {
    (void)state;
    scene s;
    sl_area_placement back;
    size_t size, again;
    begin(&s, PLAN, 5, kinds[2]);
    s.area.costs = s.costs;
    sl_area_placement placed = place(&s);
    char *text = print(&s, &placed, &size);
    assert_ok(s.context, parse(&s, text, size, &back));
    assert_int_equal(back.lower, placed.lower);
    assert_int_equal(back.count, placed.count);
    assert_memory_equal(back.chosen, placed.chosen, placed.count * sizeof *placed.chosen);
    confirm(&s, &back);
    char *copy = print(&s, &placed, &again);
    assert_int_equal(again, size);
    assert_memory_equal(copy, text, size);
    free(copy);
    sl_area_placement_destroy(s.context, &back);
    copy = malloc(size + 3); // behind a byte order mark
    memcpy(copy, "\xef\xbb\xbf", 3);
    memcpy(copy + 3, text, size);
    assert_ok(s.context, parse(&s, copy, size + 3, &back));
    assert_int_equal(back.lower, placed.lower);
    free(copy);
    for (size_t cut = 0; cut < size - 2; cut += 1 + size / 200) {
        sl_area_placement part;
        assert_int_equal(parse(&s, text, cut, &part), SL_BAD_INPUT);
    }
    free(text);
    sl_area_placement_destroy(s.context, &back);
    sl_area_placement_destroy(s.context, &placed);
    end(&s);
}

/// Of other places, another area, and of viewpoints anywhere.
static void other_questions_are_refused(void **state) {
    (void)state;
    scene s;
    sl_area_placement back;
    sl_placement anywhere;
    size_t size;
    begin(&s, PLAN, 5, kinds[1]);
    sl_area_placement placed = place(&s);
    char *text = print(&s, &placed, &size);
    s.places[3].heading += 1;
    assert_int_equal(parse(&s, text, size, &back), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(s.context), "other places"));
    s.places[3].heading -= 1;
    s.area.cover = 2;
    assert_int_equal(parse(&s, text, size, &back), SL_BAD_INPUT);
    s.area.cover = 0;
    s.area.place_count--;
    assert_int_equal(parse(&s, text, size, &back), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(s.context), "10 places and headings"));
    s.area.place_count++;
    assert_int_equal(sl_place_proof_parse(s.context, s.query, "p", text, size, &anywhere),
                     SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(s.context), "among given places"));
    s.area.network = true;
    assert_int_equal(parse(&s, text, size, &back), SL_UNSUPPORTED);
    free(text);
    sl_area_placement_destroy(s.context, &placed);
    end(&s);
}

/// Whatever is changed, no more is proven than holds.
static void no_number_proves_more(void **state) {
    (void)state;
    scene s;
    begin(&s, PLAN, 9, kinds[1]);
    s.area.costs = s.costs;
    sl_area_placement placed = place(&s);
    assert_int_equal(placed.lower, placed.upper);
    const sl_cover_proof proof = placed.proof;
    for (size_t i = 0; i < proof.dual_count; i++) {
        proof.duals[i] += proof.denominator;
        assert_true(check(&s, &placed).lower <= placed.lower);
        proof.duals[i] -= proof.denominator;
    }
    uint32_t *demands = (uint32_t *)(uintptr_t)placed.columns.demands;
    for (uint32_t w = 0; w < placed.columns.row_count; w++) {
        demands[w]++;
        const sl_place_area_verdict v = check(&s, &placed);
        assert_int_equal(v.lower, 0);
        assert_int_equal(v.weak, w);
        demands[w]--;
    }
    const sl_point kept = placed.witnesses[0];
    placed.witnesses[0] = (sl_point){-100, -100};
    sl_place_area_verdict v;
    assert_int_equal(sl_place_area_proof_check(s.context, s.query, &s.area, &placed, &v),
                     SL_BAD_ARGUMENT);
    placed.witnesses[0] = kept;
    placed.chosen[0] = PLACES;
    assert_int_equal(sl_place_area_proof_check(s.context, s.query, &s.area, &placed, &v),
                     SL_BAD_ARGUMENT);
    sl_area_placement_destroy(s.context, &placed);
    end(&s);
}

/// Without one of its places a choice is completed again, in order and with the costs, and all of
/// the places see no more.
static void what_is_missing_is_added(void **state) {
    (void)state;
    for (unsigned k = 0; k < 10; k++) {
        scene s;
        sl_place_area_verdict v;
        uint32_t added;
        begin(&s, k % 2 ? FLAT : PLAN, 700 + k, kinds[k / 2]);
        if (k % 3 == 0) s.area.costs = s.costs;
        sl_area_placement placed = place(&s);
        const uint64_t least = placed.lower;
        assert_ok(s.context,
                  sl_place_area_proof_complete(s.context, s.query, &s.area, &placed, &added, &v));
        assert_int_equal(added, 0);
        const uint32_t count = placed.count, out = k % count, gone = placed.chosen[out];
        placed.upper -= s.area.costs ? s.costs[gone] : 1;
        for (uint32_t i = out; i + 1 < count; i++) placed.chosen[i] = placed.chosen[i + 1];
        placed.count--;
        assert_false(check(&s, &placed).sees_as_all);
        assert_ok(s.context,
                  sl_place_area_proof_complete(s.context, s.query, &s.area, &placed, &added, &v));
        assert_true(added > 0);
        assert_true(v.sees_as_all);
        assert_int_equal(placed.count, count - 1 + added);
        assert_int_equal(v.upper, placed.upper);
        assert_true(v.upper >= least);
        for (uint32_t i = 1; i < placed.count; i++)
            assert_true(placed.chosen[i - 1] < placed.chosen[i]);
        sl_area_placement_destroy(s.context, &placed);
        end(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_code_confirms),
        cmocka_unit_test(points_confirm_the_check),
        cmocka_unit_test(zones_are_what_is_to_be_seen),
        cmocka_unit_test(circles_that_touch),
        cmocka_unit_test(witnesses_on_borders),
        cmocka_unit_test(cones_along_walls),
        cmocka_unit_test(files_keep_it),
        cmocka_unit_test(other_questions_are_refused),
        cmocka_unit_test(no_number_proves_more),
        cmocka_unit_test(what_is_missing_is_added),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
