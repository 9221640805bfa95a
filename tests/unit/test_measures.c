// The table of measures: a row for each double of the structures, found by name, with its unit.
#include "testing.h"

#include "sightline/axial.h"
#include "sightline/region.h"
#include "sightline/vga.h"

#include <string.h>

static const sl_analysis analyses[] = {SL_ISOVIST, SL_VGA, SL_AXIAL, SL_SEGMENTS};
enum { ANALYSES = sizeof analyses / sizeof *analyses };

static void each_value_has_one_row(void **state) {
    static const size_t doubles[] = {[SL_OF_REGION] = sizeof(sl_region_measures) / sizeof(double),
                                     [SL_OF_GRAPH] = sizeof(sl_vga_measures) / sizeof(double),
                                     [SL_OF_DEPTH] = sizeof(sl_vga_depths) / sizeof(double),
                                     [SL_OF_AGENTS] = 1,
                                     [SL_OF_LINE] = sizeof(sl_axial_measures) / sizeof(double),
                                     [SL_OF_SEGMENT] =
                                         sizeof(sl_segment_measures) / sizeof(double)};
    size_t seen[sizeof doubles / sizeof *doubles] = {0};
    (void)state;
    for (int a = 0; a < ANALYSES; a++) {
        size_t count;
        const sl_measure *rows = sl_measures(analyses[a], &count);
        for (size_t k = 0; k < count; k++) {
            const bool again = analyses[a] == SL_VGA && rows[k].of == SL_OF_REGION;
            assert_int_equal(sl_measure_find(analyses[a], rows[k].name), k);
            assert_true(*rows[k].meaning && *sl_measure_group_name(rows[k].group));
            if (!again) assert_int_equal(rows[k].index, seen[rows[k].of]++);
        }
        assert_int_equal(sl_measure_find(analyses[a], "none"), count);
    }
    assert_memory_equal(seen, doubles, sizeof doubles);
}

static void values_are_those_of_the_members(void **state) {
    const sl_region_measures region = {.area = 2, .radial_skewness = 3};
    const sl_vga_measures graph = {.connectivity = 4, .angular_node_count = 5};
    const sl_segment_measures segment = {.nain = 6};
    size_t count;
    (void)state;
    const sl_measure *rows = sl_measures(SL_ISOVIST, &count);
    assert_true(sl_measure_value(&rows[0], &region) == 2);
    assert_true(sl_measure_value(&rows[sl_measure_find(SL_ISOVIST, "radial_skewness")], &region) ==
                3);
    rows = sl_measures(SL_VGA, &count);
    assert_true(sl_measure_value(&rows[0], &graph) == 4);
    const size_t last = sl_measure_find(SL_VGA, "angular_node_count");
    assert_true(sl_measure_value(&rows[last], &graph) == 5);
    rows = sl_measures(SL_SEGMENTS, &count);
    assert_true(sl_measure_value(&rows[sl_measure_find(SL_SEGMENTS, "nain")], &segment) == 6);
}

static void check_unit(sl_analysis analysis, const char *name, const char *of_map,
                       const char *wanted) {
    size_t count;
    char text[SL_UNIT_TEXT];
    sl_measure_say_unit(&sl_measures(analysis, &count)[sl_measure_find(analysis, name)], of_map,
                        text);
    assert_string_equal(text, wanted);
}

static void units_follow_that_of_the_map(void **state) {
    (void)state;
    check_unit(SL_ISOVIST, "perimeter", "m", "m");
    check_unit(SL_ISOVIST, "area", "m", "m\xc2\xb2");
    check_unit(SL_ISOVIST, "area", "", "");
    check_unit(SL_ISOVIST, "radial_skewness", "ft", "ft\xc2\xb3");
    check_unit(SL_ISOVIST, "compactness", "m", "");
    check_unit(SL_ISOVIST, "drift_angle", "", "\xc2\xb0");
    check_unit(SL_VGA, "visual_entropy", "m", "bits");
    check_unit(SL_SEGMENTS, "t1024_total_depth", "m", "right angles");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_value_has_one_row),
        cmocka_unit_test(values_are_those_of_the_members),
        cmocka_unit_test(units_follow_that_of_the_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
