// The heat map of the viewer: its values are those of the library for the map as it is now, with
// doors shut or open and after a change; it ends when it is told to.
#include "effects/filtered.h"
#include "space/outline.h"
#include "viewer_app.h"

#include "app/frame.h"
#include "app/layout.h"
#include "app/turn.h"
#include "plan/heat.h"
#include "sightline/bake.h"

#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

// --- the viewer

static app_state *start(const char *map) {
    app_state *app = viewer_start(true);
    viewer_open(app, map);
    script_frame(app);
    return app;
}

static void press_key(app_state *app, const char *key) {
    viewer_press(app, key);
    app_tick(app, 0);
}

// --- against the library

/// A space of the map as it is now: of sight, or of steps.
typedef struct cut_plan {
    sl_baked baked;
    sl_space space;
    sl_outline outline;
} cut_plan;

/// What the library says of the map as it is now.
typedef struct fresh {
    cut_plan sight, steps;
    sl_vga_grid grid;
    sl_vga_graph graph, walked;
    sl_vga_measures *measures;
} fresh;

static void make_plan(app_state *app, sl_context *context, uint32_t channel, cut_plan *out) {
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account;
    sl_map map = {0};
    *out = (cut_plan){0};
    assert_int_equal(sl_map_copy(context, &app->document.map, &map), SL_OK);
    map.channel = channel;
    assert_int_equal(sl_bake_space(context, &map, &options, &out->baked, &account), SL_OK);
    bool *shut = calloc(out->baked.map.door_count + 1, sizeof *shut);
    for (size_t i = 0; i < out->baked.map.door_count; i++) shut[i] = !out->baked.map.doors[i].open;
    const bool glass = out->baked.map.oneway_count > 0;
    const sli_filtered_space filtered = {.shut = shut, .one_way = glass, .dark_walls = glass};
    assert_int_equal(
        sli_filtered_space_make(context, &out->baked.space, &filtered, NULL, &out->space), SL_OK);
    free(shut);
    sl_map_destroy(context, &map);
    assert_int_equal(sli_outline_make(context, &out->space, &out->outline), SL_OK);
}

static void drop_plan(sl_context *context, cut_plan *p) {
    sli_outline_destroy(context, &p->outline);
    sl_space_destroy(context, &p->space);
    sl_baked_destroy(context, &p->baked);
}

/// The grid and paths go by steps, all else by sight.
static void make_fresh(app_state *app, sl_context *context, unsigned part, fresh *f) {
    sl_vga_options measured = sl_vga_options_default();
    measured.parts = part;
    *f = (fresh){0};
    make_plan(app, context, SL_STOPS_SIGHT, &f->sight);
    make_plan(app, context, SL_STOPS_STEPS, &f->steps);
    assert_int_equal(
        sl_vga_grid_make(context, &f->steps.outline, heat_step(&app->view), NULL, 0, &f->grid),
        SL_OK);
    assert_int_equal(sl_vga_graph_make(context, &f->sight.outline, &f->grid,
                                       app->document.map.range, 1, &f->graph),
                     SL_OK);
    const bool differ = sl_map_steps_differ(&app->document.map);
    const bool walks = differ && part & (SL_VGA_METRIC | SL_VGA_ANGULAR);
    if (walks)
        assert_int_equal(sl_vga_graph_make(context, &f->steps.outline, &f->grid, 0, 1, &f->walked),
                         SL_OK);
    f->measures = calloc(f->grid.count, sizeof *f->measures);
    assert_int_equal(sl_vga_measure(context, walks ? &f->steps.outline : &f->sight.outline,
                                    &f->grid, walks ? &f->walked : &f->graph, &measured,
                                    f->measures),
                     SL_OK);
}

static void drop_fresh(sl_context *context, fresh *f) {
    free(f->measures);
    sl_vga_graph_destroy(context, &f->graph);
    sl_vga_graph_destroy(context, &f->walked);
    sl_vga_grid_destroy(context, &f->grid);
    drop_plan(context, &f->sight);
    drop_plan(context, &f->steps);
}

/// The values that are shown; there must be some.
static const double *shown(app_state *app, const heat_graph **graph) {
    const double *values = heat_layer_values(&app->view, graph);
    if (!values) fail_msg("no heat map: %s", app->ui.message);
    return values;
}

/// Each value is the library's, and the colour scale is that of the large parts.
static void assert_fresh(app_state *app) {
    const sl_measure *measure = heat_measure(app->view.heat_choice.measure);
    sl_context *context = sl_context_create(NULL);
    const heat_graph *graph;
    fresh f;
    double low, high;
    const double *values = shown(app, &graph);
    make_fresh(app, context, heat_measure_part(measure), &f);
    assert_int_equal(graph->grid.count, f.grid.count);
    assert_memory_equal(graph->grid.points, f.grid.points, f.grid.count * sizeof *f.grid.points);
    for (uint32_t p = 0; p < f.grid.count; p++) {
        const double value = sl_measure_value(measure, &f.measures[p]);
        if (!isfinite(value)) {
            assert_true(isnan(values[p]));
            continue;
        }
        if (values[p] != value) fail_msg("%s: %g, not %g", measure->name, values[p], value);
    }
    // The scale is that of the part that the eye is in.
    uint32_t *parts = calloc(f.grid.count, sizeof *parts), part_count;
    assert_int_equal(sl_vga_parts(context, &f.graph, NULL, 0, parts, &part_count), SL_OK);
    const uint32_t at = heat_graph_nearest(context, graph, app->view.eye.at);
    assert_true(at != UINT32_MAX);
    double least = INFINITY, most = -INFINITY;
    for (uint32_t p = 0; p < f.grid.count; p++) {
        if (parts[p] != parts[at]) continue;
        least = fmin(least, values[p]);
        most = fmax(most, values[p]);
    }
    heat_layer_scale(&app->view, &low, &high);
    assert_true(low == least && high == most);
    free(parts);
    drop_fresh(context, &f);
    sl_context_destroy(context);
}

/// Every measure of the graph can be chosen, each once.
static void test_list(void **state) {
    size_t count, numbers = 0;
    const sl_measure *all = sl_measures(SL_VGA, &count);
    (void)state;
    for (size_t k = 0; k < count; k++) {
        size_t times = 0;
        for (size_t n = 0; n < heat_measure_count(); n++) times += heat_measure(n) == &all[k];
        const bool steps = strcmp(all[k].name, "visual_step_depth") == 0;
        assert_int_equal(times, all[k].of == SL_OF_GRAPH || steps);
        numbers += times;
    }
    assert_int_equal(numbers, heat_measure_count());
}

/// All measures, one after the other, and back to the first one.
static void test_measures(void **state) {
    static const char *const maps[] = {MAPS "/office.map", MAPS "/oblique/rotunda.map",
                                       MAPS "/effects/range.map", MAPS "/effects/oneway.map",
                                       MAPS "/effects/stops.map"};
    const size_t count = heat_measure_count();
    (void)state;
    for (size_t m = 0; m < sizeof maps / sizeof *maps; m++) {
        app_state *app = start(maps[m]);
        heat_set_step(&app->view, 0);
        press_key(app, "4");
        press_key(app, "1");
        for (size_t k = 0; k + 1 < count; k++) {
            assert_int_equal(app->view.heat_choice.measure, k);
            assert_fresh(app);
            press_key(app, "2");
        }
        press_key(app, "2");
        assert_int_equal(app->view.heat_choice.measure, 0);
        press_key(app, "3");
        assert_int_equal(app->view.heat_choice.measure, count - 1);
        viewer_end(app);
    }
}

/// A door that is shut, a wall that is drawn, another grid: the heat map is made anew.
static void test_changes(void **state) {
    (void)state;
    app_state *app = start(MAPS "/effects/doors.map");
    const heat_graph *graph;
    press_key(app, "1");
    assert_fresh(app);
    const uint64_t before = (shown(app, &graph), graph->graph.edges);
    press_key(app, "N");
    assert_fresh(app);
    assert_true((shown(app, &graph), graph->graph.edges) != before);
    press_key(app, "Ctrl+Z");
    assert_fresh(app);
    assert_true((shown(app, &graph), graph->graph.edges) == before);
    const uint32_t points = graph->grid.count;
    press_key(app, "5");
    assert_fresh(app);
    assert_true((shown(app, &graph), graph->grid.count) > points);
    press_key(app, "4");
    const sl_wall wall = {.a = {2, 2}, .b = {8, 7}};
    view_before_edit(&app->view);
    assert_int_equal(sl_map_add_walls(app->context, &app->document.map, &wall, 1), SL_OK);
    view_after_edit(&app->view);
    app_tick(app, 0);
    assert_fresh(app);
    assert_true((shown(app, &graph), graph->graph.edges) < before);
    viewer_end(app);
}

/// The scale that is kept stays while a door is shut. Another measure lets it go.
static void test_kept_scale(void **state) {
    (void)state;
    app_state *app = start(MAPS "/effects/doors.map");
    double least, most, low, high;
    press_key(app, "1");
    heat_layer_scale(&app->view, &least, &most);
    press_key(app, "7");
    press_key(app, "N");
    heat_layer_scale(&app->view, &low, &high);
    assert_true(low == least && high == most);
    press_key(app, "7");
    assert_fresh(app);
    heat_layer_scale(&app->view, &low, &high);
    assert_true(low != least || high != most);
    press_key(app, "7");
    press_key(app, "2");
    assert_fresh(app);
    viewer_end(app);
}

static void point_at(app_state *app, sl_point at) {
    const sl_box plan = app_layout(app).plan[0];
    const sl_frame frame = camera_frame(&app->view.camera, plan, 1);
    input_move(app, sl_frame_point(&frame, at));
    app_tick(app, 0);
}

/// Steps follow the pointer, through doors that are open.
static void test_steps(void **state) {
    static const sl_point places[] = {{5, 5}, {25, 15}, {15, 5}, {5, 15}};
    (void)state;
    app_state *app = start(MAPS "/effects/doors.map");
    press_key(app, "1");
    press_key(app, "6");
    sl_context *context = sl_context_create(NULL);
    fresh f;
    make_fresh(app, context, SL_VGA_LOCAL, &f);
    uint32_t *steps = calloc(f.grid.count, sizeof *steps);
    double least, most;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const heat_graph *graph;
        uint32_t from = 0;
        point_at(app, places[i]);
        const double *values = shown(app, &graph);
        for (uint32_t p = 0; p < f.grid.count; p++)
            if (hypot(f.grid.points[p].x - places[i].x, f.grid.points[p].y - places[i].y) <
                hypot(f.grid.points[from].x - places[i].x, f.grid.points[from].y - places[i].y))
                from = p;
        assert_int_equal(sl_vga_step_depth(context, &f.graph, &from, 1, steps), SL_OK);
        heat_layer_scale(&app->view, &least, &most);
        for (uint32_t p = 0; p < f.grid.count; p++) {
            assert_true(steps[p] == UINT32_MAX ? isnan(values[p]) : values[p] == steps[p]);
            assert_true(isnan(values[p]) || (least <= values[p] && values[p] <= most));
        }
        assert_true(values[from] == 0);
    }
    // Back to the measure before.
    press_key(app, "6");
    assert_int_equal(app->view.heat_choice.measure, 0);
    assert_fresh(app);
    free(steps);
    drop_fresh(context, &f);
    sl_context_destroy(context);
    viewer_end(app);
}

/// Mirrors are refused by name and with a reason, and nothing is shown.
static void test_refused(void **state) {
    (void)state;
    const heat_graph *graph;
    app_state *app = start(MAPS "/effects/mirrors.map");
    press_key(app, "1");
    assert_true(app->ui.message_is_error);
    assert_non_null(strstr(app->ui.message, "heat map"));
    assert_non_null(strstr(app->ui.message, "mirror"));
    assert_non_null(strstr(app->ui.message, "not to mirror images"));
    assert_null(heat_layer_values(&app->view, &graph));
    viewer_end(app);
}

/// Glass counts one way: some steps go to a point from which none go back.
static void test_glass(void **state) {
    (void)state;
    app_state *app = start(MAPS "/effects/oneway.map");
    const heat_graph *graph;
    press_key(app, "1");
    assert_fresh(app);
    shown(app, &graph);
    const uint32_t count = graph->grid.count;
    size_t one_way = 0;
    for (uint32_t p = 0; p < count; p += 7)
        for (uint32_t q = 0; q < count; q += 11)
            one_way += sl_vga_sees(&graph->graph, p, q) && !sl_vga_sees(&graph->graph, q, p);
    assert_true(one_way > 0);
    viewer_end(app);
}

/// Escape stops the work at any time; switched off and on, the heat map is made again.
static void test_stopped(void **state) {
    (void)state;
    for (int waits = 0; waits < 4; waits++) {
        const heat_graph *graph;
        app_state *app = start(MAPS "/office.map");
        app->ui.steady = false;
        app->view.heat_choice.step = 0.25; // the finest grid: it takes a while
        press_key(app, "1");
        assert_true(heat_layer_progress(app->view.heat).running);
        assert_true(app_progress(app).running);
        const struct timespec pause = {0, 30000000L * waits};
        nanosleep(&pause, NULL);
        press_key(app, "Escape");
        if (waits == 0) assert_null(heat_layer_values(&app->view, &graph));
        assert_false(heat_layer_progress(app->view.heat).running);
        app->view.heat_choice.step = 5;
        app->ui.steady = true;
        press_key(app, "1");
        press_key(app, "1");
        assert_fresh(app);
        // Closed at any time.
        app->ui.steady = false;
        app->view.heat_choice.step = 0.25;
        app_tick(app, 0);
        nanosleep(&pause, NULL);
        viewer_end(app);
    }
}

/// Without a start the eye begins in the roomiest place, where the heat map counts: not in the
/// largest cell, which may be a corridor or a court.
static void test_first_eye(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-heat-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.map", folder);
    viewer_write(path, "sightline 1\nwalls 0 0 40 0 40 1 0 1 0 0\nwalls 0 3 6 3 6 9 0 9 0 3\n");
    app_state *app = start(path);
    assert_true(app->view.eye.at.x == 3 && app->view.eye.at.y == 6);
    viewer_end(app);
    unlink(path);
    rmdir(folder);
}

/// In a room where all see all, no point has an integration: the key says so, in place of a scale
/// from inf to -inf.
static void test_no_value(void **state) {
    static const char *const starts[2] = {"start 1 1 0\n", ""};
    static const char *const told[2] = {"not defined here", "put a start in a room"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        char folder[] = "/tmp/sightline-heat-XXXXXX", path[64];
        assert_non_null(mkdtemp(folder));
        snprintf(path, sizeof path, "%s/a.map", folder);
        FILE *stream = fopen(path, "w");
        assert_non_null(stream);
        fprintf(stream, "sightline 1\nwalls 0 0 4 0 4 4 0 4 0 0\n%s", starts[i]);
        assert_int_equal(fclose(stream), 0);
        app_state *app = start(path);
        heat_set_step(&app->view, 0);
        press_key(app, "1");
        size_t k = 0;
        while (!strstr(heat_measure(k)->name, "integration")) k++;
        while (app->view.heat_choice.measure != k) press_key(app, "2");
        legend_key key;
        assert_true(heat_layer_key(&app->view, &key));
        assert_string_equal(key.least, "\xe2\x80\x93");
        assert_string_equal(key.most, "\xe2\x80\x93");
        assert_string_equal(key.rows[key.count - 1].text, told[i]);
        viewer_end(app);
        assert_int_equal(remove(path), 0);
        assert_int_equal(rmdir(folder), 0);
    }
}

/// A layer that is switched on fills the plan. Once it is off, the one before does again.
static void test_fills(void **state) {
    (void)state;
    app_state *app = start(MAPS "/office.map");
    assert_int_equal(layers_fill(&app->view), LAYER_CULL);
    press_key(app, "1");
    assert_int_equal(layers_fill(&app->view), LAYER_HEAT);
    press_key(app, "V");
    assert_int_equal(layers_fill(&app->view), LAYER_PVS);
    press_key(app, "V");
    assert_int_equal(layers_fill(&app->view), LAYER_HEAT);
    press_key(app, "1");
    assert_int_equal(layers_fill(&app->view), LAYER_CULL);
    press_key(app, "M");
    assert_int_equal(layers_fill(&app->view), LAYER_REGION);
    viewer_end(app);
}

/// Of two halls that do not see each other the eye's has the scale.
static void test_parts(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-heat-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.map", folder);
    viewer_write(path,
                 "sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 6\n"
                 "walls 30 0 36 0 36 6 30 6 30 0\nwall 33 0 33 4\nstart 1 1 0\nstart 31 1 0\n");
    app_state *app = start(path);
    double low, high, least, most;
    legend_key key;
    press_key(app, "1");
    assert_fresh(app);
    heat_layer_scale(&app->view, &low, &high);
    assert_true(heat_layer_key(&app->view, &key));
    bool told = false;
    for (int i = 0; i < key.count; i++) told |= strstr(key.rows[i].text, "points are grey") != NULL;
    assert_true(told);
    const uint32_t stamp = app->view.heat_choice.stamp;
    app->view.eye.at = (sl_point){2, 2};
    app_tick(app, 0);
    assert_int_equal(app->view.heat_choice.stamp, stamp);
    app->view.eye.at = (sl_point){31.2, 1.1};
    app_tick(app, 0);
    assert_fresh(app);
    heat_layer_scale(&app->view, &least, &most);
    assert_true(least != low && most != high);
    assert_true(app->view.heat_choice.stamp != stamp);
    viewer_end(app);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

static cairo_surface_t *draw_window(app_state *app, bool portals) {
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, app->ui.width, app->ui.height);
    cairo_t *cairo = cairo_create(surface);
    app->view.show = SHOW_CELLS | SHOW_HEAT | (portals ? SHOW_PORTALS : 0);
    app_draw(app, cairo);
    cairo_destroy(cairo);
    cairo_surface_flush(surface);
    return surface;
}

/// The pixels beside a line of the map in which two pictures of the window differ.
static unsigned differing(const app_state *app, cairo_surface_t *one, cairo_surface_t *other,
                          sl_point from, sl_point to) {
    const sl_frame frame = camera_frame(&app->view.camera, app->view.plan[0], 1);
    const sl_point a = sl_frame_point(&frame, from), b = sl_frame_point(&frame, to);
    const size_t stride = (size_t)cairo_image_surface_get_stride(one);
    const unsigned char *p = cairo_image_surface_get_data(one);
    const unsigned char *q = cairo_image_surface_get_data(other);
    unsigned count = 0;
    for (int y = (int)fmin(a.y, b.y) + 8; y < (int)fmax(a.y, b.y) - 8; y++)
        for (int x = (int)fmin(a.x, b.x) - 4; x <= (int)fmax(a.x, b.x) + 4; x++) {
            const size_t at = (size_t)y * stride + 4 * (size_t)x;
            count += memcmp(p + at, q + at, 3) != 0;
        }
    return count;
}

/// Portals are drawn over the heat map, but not between cells outside, where there is no map.
static void test_portals(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-heat-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.map", folder);
    // An L; in its notch a wall that has the notch cut in two.
    viewer_write(path, "sightline 1\nwalls 0 0 20 0 20 10 10 10 10 20 0 20 0 0\nwall 15 10 15 14\n"
                       "wall 5 0 5 4\nstart 2 12 0\n");
    app_state *app = start(path);
    app->view.show = SHOW_CELLS | SHOW_HEAT;
    layers_set_fill(&app->view, LAYER_HEAT);
    app_tick(app, 0);
    script_frame(app);
    const heat_graph *graph;
    assert_non_null(heat_layer_values(&app->view, &graph));
    const sl_space *space = &app->document.baked->space;
    cairo_surface_t *with = draw_window(app, true), *without = draw_window(app, false);
    uint32_t inside = 0, outside = 0;
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_portal *portal = &space->portals[i];
        if (portal->left.x != portal->right.x) continue;
        const bool in = space->cells[portal->cell[0]].inside;
        const unsigned pixels = differing(app, with, without, portal->left, portal->right);
        assert_true(in ? pixels > 20 : pixels == 0);
        inside += in;
        outside += !in;
    }
    assert_true(inside && outside);
    cairo_surface_destroy(with);
    cairo_surface_destroy(without);
    viewer_end(app);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_list),      cmocka_unit_test(test_measures),
        cmocka_unit_test(test_changes),   cmocka_unit_test(test_kept_scale),
        cmocka_unit_test(test_steps),     cmocka_unit_test(test_refused),
        cmocka_unit_test(test_glass),     cmocka_unit_test(test_stopped),
        cmocka_unit_test(test_fills),     cmocka_unit_test(test_no_value),
        cmocka_unit_test(test_first_eye), cmocka_unit_test(test_portals),
        cmocka_unit_test(test_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
