/// Pictures of what an eye sees: the counts of each layer, cones of all widths, failures.
#include "sightline/draw.h"

#include "test_draw_map.h"

#include "sightline/support.h"

#include <cairo.h>
#include <math.h>
#include <stddef.h>
#include <unistd.h>

static int set_up(void **state) {
    draw_bench *b = draw_bench_make();
    if (!b) return -1;
    testing_space(b->context,
                  "walls 0 0 40 0 40 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
                  "wall 20 2 20 10\nwall 30 0 30 8\n",
                  &b->map.baked.map, &b->map.baked.space);
    *state = b;
    return 0;
}

/// All four cells, three, and one.
static const uint64_t sets[3] = {15, 7, 1};
static const sl_eye_layer layers[3] = {
    {"cell_to_cell", &sets[0]}, {"incident_portals", &sets[1]}, {"exact", &sets[2]}};

static sl_bytes drawn(draw_bench *b, const sl_view *view, const char *name) {
    const sl_draw_options options = sl_draw_options_default();
    sl_bytes file;
    assert_ok(b->context, sl_draw_eye(b->context, &b->map.baked, view, layers, 3, NULL, 0, &options,
                                      draw_path(b, name)));
    assert_ok(b->context, sl_file_read(b->context, b->path, &file));
    unlink(b->path);
    return file;
}

static void views_look_different(void **state) {
    draw_bench *b = *state;
    const sl_point eye = {5, 5};
    const sl_view views[] = {
        sl_view_all_round(eye),          sl_view_cone(eye, 0, 0, 40),
        sl_view_cone(eye, 30, 60, 40),   sl_view_cone(eye, 30, 200, 40),
        sl_view_cone(eye, -90, 359, 40), sl_view_all_round((sl_point){15, 5}),
    };
    enum { VIEWS = sizeof views / sizeof *views };
    sl_bytes files[VIEWS];
    for (int i = 0; i < VIEWS; i++) {
        files[i] = drawn(b, &views[i], "eye.svg");
        assert_non_null(strstr(files[i].data, "<svg"));
        for (int k = 0; k < i; k++)
            assert_true(files[i].size != files[k].size ||
                        memcmp(files[i].data, files[k].data, files[i].size) != 0);
    }
    sl_bytes again = drawn(b, &views[2], "eye.svg");
    assert_int_equal(again.size, files[2].size);
    assert_memory_equal(again.data, files[2].data, again.size);
    sl_free(b->context, again.data);
    for (int i = 0; i < VIEWS; i++) sl_free(b->context, files[i].data);
}

/// What is seen directly is drawn over the cells.
static void the_visible_region_is_drawn(void **state) {
    draw_bench *b = *state;
    const sl_view view = sl_view_all_round((sl_point){5, 5});
    const sl_point corners[4] = {{3, 3}, {7, 3}, {7, 7}, {3, 7}};
    const sl_drawn_region region = {.eye = view.eye, .points = corners, .count = 4};
    const sl_draw_options options = sl_draw_options_default();
    cairo_surface_t *surfaces[2];
    for (size_t i = 0; i < 2; i++) {
        assert_ok(b->context, sl_draw_eye(b->context, &b->map.baked, &view, layers, 3, &region, i,
                                          &options, draw_path(b, "eye.png")));
        surfaces[i] = cairo_image_surface_create_from_png(b->path);
        unlink(b->path);
    }
    const int width = cairo_image_surface_get_width(surfaces[0]);
    const int plan = 380; // the key is below, and longer for a region
    size_t lighter = 0;
    for (int y = 0; y < plan; y++) {
        const unsigned char *rows[2];
        for (int i = 0; i < 2; i++)
            rows[i] = cairo_image_surface_get_data(surfaces[i]) +
                      (ptrdiff_t)y * cairo_image_surface_get_stride(surfaces[i]);
        for (int x = 0; x < width; x++) lighter += rows[1][4 * x + 1] > rows[0][4 * x + 1] + 20;
    }
    const double area = pow(4 * 0.92 * width / 40, 2);
    assert_true((double)lighter > 0.95 * area && (double)lighter < 1.02 * area);
    for (int i = 0; i < 2; i++) cairo_surface_destroy(surfaces[i]);
}

static void an_eye_outside_can_be_drawn(void **state) {
    draw_bench *b = *state;
    const sl_view view = sl_view_cone((sl_point){-1e6, 5}, 0, 60, 40);
    sl_bytes file = drawn(b, &view, "eye.png");
    assert_true(file.size > 1000);
    sl_free(b->context, file.data);
}

static void refused(draw_bench *b, const sl_view *view, size_t count, double width,
                    const char *name) {
    sl_draw_options options = sl_draw_options_default();
    sl_eye_layer many[SL_EYE_LAYERS_MOST + 1];
    for (size_t i = 0; i <= SL_EYE_LAYERS_MOST; i++) many[i] = layers[0];
    options.width = width;
    assert_int_equal(sl_draw_eye(b->context, &b->map.baked, view, many, count, NULL, 0, &options,
                                 draw_path(b, name)),
                     SL_BAD_ARGUMENT);
    assert_int_not_equal(access(b->path, F_OK), 0);
}

static void what_is_refused(void **state) {
    draw_bench *b = *state;
    const sl_view view = sl_view_all_round((sl_point){5, 5});
    const sl_view none = sl_view_all_round((sl_point){NAN, 5});
    refused(b, &view, SL_EYE_LAYERS_MOST + 1, 1200, "eye.png");
    refused(b, &view, 1, 63, "eye.png");
    refused(b, &view, 1, NAN, "eye.png");
    refused(b, &view, 1, 1200, "eye.jpg");
    refused(b, &none, 1, 1200, "eye.png");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(views_look_different, set_up, draw_bench_end),
        cmocka_unit_test_setup_teardown(the_visible_region_is_drawn, set_up, draw_bench_end),
        cmocka_unit_test_setup_teardown(an_eye_outside_can_be_drawn, set_up, draw_bench_end),
        cmocka_unit_test_setup_teardown(what_is_refused, set_up, draw_bench_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
