/// Estimated mean depths of visibility graphs, beside exact ones.
#include "space/outline.h"
#include "testing.h"

#include "sightline/import.h"
#include "sightline/support.h"
#include "sightline/vga.h"

#include <math.h>
#include <string.h>

typedef struct fixture {
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_vga_grid grid;
    sl_vga_graph graph;
    sl_vga_measures *exact, *estimated;
    sl_vga_interval *ends;
} fixture;

static const struct {
    const char *name;
    double step;
} maps[] = {{"office.map", 1}, {"courtyard.map", 0.5}, {"maze.map", 0.5}, {"pillars.map", 1}};
enum { MAPS = sizeof maps / sizeof *maps };

static void fixture_make(sl_context *context, size_t map, fixture *f) {
    sl_vga_options options = sl_vga_options_default();
    char path[512];
    snprintf(path, sizeof path, "%s/maps/%s", SIGHTLINE_SOURCE_DIR, maps[map].name);
    *f = (fixture){0};
    options.parts = SL_VGA_GLOBAL;
    assert_ok(context, sl_map_read(context, path, NULL, &f->map));
    testing_subdivide(context, &f->map, &f->space);
    assert_ok(context, sli_outline_make(context, &f->space, &f->outline));
    assert_ok(context, sl_vga_grid_make(context, &f->outline, maps[map].step, NULL, 0, &f->grid));
    assert_ok(context, sl_vga_graph_make(context, &f->outline, &f->grid, 0, 1, &f->graph));
    f->exact = sl_alloc_array(context, f->grid.count, sizeof *f->exact);
    f->estimated = sl_alloc_array(context, f->grid.count, sizeof *f->estimated);
    f->ends = sl_alloc_array(context, f->grid.count, sizeof *f->ends);
    assert_true(f->exact && f->estimated && f->ends);
    assert_ok(context,
              sl_vga_measure(context, &f->outline, &f->grid, &f->graph, &options, f->exact));
}

static void fixture_destroy(sl_context *context, fixture *f) {
    sl_free(context, f->exact);
    sl_free(context, f->estimated);
    sl_free(context, f->ends);
    sl_vga_graph_destroy(context, &f->graph);
    sl_vga_grid_destroy(context, &f->grid);
    sli_outline_destroy(context, &f->outline);
    sl_space_destroy(context, &f->space);
    sl_map_destroy(context, &f->map);
}

static void estimate(sl_context *context, fixture *f, sl_vga_estimate options) {
    assert_ok(context, sl_vga_estimate_depths(context, &f->grid, &f->graph, &options, f->estimated,
                                              f->ends));
}

/// The share of points whose exact value is outside; only sums of doubles differ otherwise.
static double share_outside(const fixture *f) {
    double outside = 0;
    for (uint32_t p = 0; p < f->grid.count; p++) {
        const double exact = f->exact[p].visual_mean_depth;
        outside += exact < f->ends[p].least - 1e-12 || exact > f->ends[p].most + 1e-12;
        assert_true(f->estimated[p].visual_node_count == f->exact[p].visual_node_count);
        assert_true(f->estimated[p].connectivity == f->exact[p].connectivity);
        assert_true(isnan(f->estimated[p].visual_mean_depth) == isnan(exact));
        assert_true(isnan(f->estimated[p].visual_entropy));
    }
    return outside / f->grid.count;
}

static double mean_width(const fixture *f) {
    double width = 0;
    for (uint32_t p = 0; p < f->grid.count; p++)
        if (!isnan(f->ends[p].least)) width += f->ends[p].most - f->ends[p].least;
    return width / f->grid.count;
}

/// At several confidences, over many draws. A confidence of 0.2 gives ends so near each other that
/// points are outside of them: a bound that is too narrow by a few times would show.
static void ends_hold_as_often_as_said(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const double confidences[] = {0.2, 0.6, 0.99};
    double ever = 0;
    for (size_t m = 0; m < MAPS; m++) {
        fixture f;
        fixture_make(context, m, &f);
        for (size_t c = 0; c < 3; c++) {
            const uint64_t seeds = testing_seeds(20);
            double outside = 0;
            for (uint64_t seed = 1; seed <= seeds; seed++) {
                sl_vga_estimate options = sl_vga_estimate_default();
                options.roots = 24;
                options.confidence = confidences[c];
                options.seed = seed;
                options.threads = 1;
                estimate(context, &f, options);
                outside += share_outside(&f);
            }
            ever += outside;
            if (outside > (1 - confidences[c]) * (double)seeds)
                fail_msg("%s: %.4f of the points are outside at %g", maps[m].name,
                         outside / (double)seeds, confidences[c]);
        }
        fixture_destroy(context, &f);
    }
    assert_true(ever > 0);
    sl_context_destroy(context);
}

/// Four times the roots: ends half as far apart, or nearer. All points as roots: exact.
static void more_roots_say_more(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (size_t m = 0; m < MAPS; m++) {
        fixture f;
        fixture_make(context, m, &f);
        sl_vga_estimate options = sl_vga_estimate_default();
        options.roots = 16;
        estimate(context, &f, options);
        const double wide = mean_width(&f);
        options.roots = 64;
        estimate(context, &f, options);
        assert_true(mean_width(&f) > 0 && mean_width(&f) < 0.65 * wide);
        options.roots = f.grid.count;
        estimate(context, &f, options);
        assert_true(mean_width(&f) == 0 && share_outside(&f) == 0);
        for (uint32_t p = 0; p < f.grid.count; p++) {
            const double hh = f.exact[p].visual_integration_hh,
                         same = f.estimated[p].visual_integration_hh;
            assert_true(isnan(hh) ? isnan(same) : hh == same);
        }
        fixture_destroy(context, &f);
    }
    sl_context_destroy(context);
}

static void threads_and_seeds(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    fixture f;
    fixture_make(context, 0, &f);
    sl_vga_estimate options = sl_vga_estimate_default();
    const size_t bytes = f.grid.count * sizeof *f.ends;
    sl_vga_interval *first = sl_alloc_array(context, f.grid.count, sizeof *first);
    assert_non_null(first);
    options.roots = 20;
    options.threads = 1;
    estimate(context, &f, options);
    memcpy(first, f.ends, bytes);
    options.threads = 3;
    estimate(context, &f, options);
    assert_memory_equal(first, f.ends, bytes);
    options.seed = 2;
    estimate(context, &f, options);
    assert_true(memcmp(first, f.ends, bytes) != 0);
    sl_free(context, first);
    f.graph.directed = true;
    assert_int_equal(
        sl_vga_estimate_depths(context, &f.grid, &f.graph, &options, f.estimated, f.ends),
        SL_UNSUPPORTED);
    f.graph.directed = false;
    options.roots = 0;
    assert_int_equal(
        sl_vga_estimate_depths(context, &f.grid, &f.graph, &options, f.estimated, f.ends),
        SL_BAD_ARGUMENT);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_hold_as_often_as_said),
        cmocka_unit_test(more_roots_say_more),
        cmocka_unit_test(threads_and_seeds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
