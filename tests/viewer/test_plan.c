// The Plan mode of the viewer: it opens for floor plans, its paths are those of the library for the
// doors as they are now, and its colours by rank have as many points each.
#include "hand.h"

#include "app/layout.h"
#include "document/measure.h"
#include "plan/building_way.h"
#include "plan/effects.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/route.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static app_state *start(const char *name, const char *text) {
    char folder[] = "/tmp/sightline-plan-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/%s", folder, name);
    viewer_write(path, text);
    app_state *app = viewer_start(true);
    viewer_open(app, path);
    script_frame(app);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
    return app;
}

static const char svg[] = "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='100'>"
                          "<g id='walls'><path d='M0 0 H200 V100 H0 Z M100 0 V60' stroke='black' "
                          "fill='none'/></g></svg>";

/// A drawing opens in the Plan mode. A map does not, nor does a drawing once another mode is
/// chosen.
static void test_opens(void **state) {
    (void)state;
    app_state *app = start("house.svg", svg);
    assert_int_equal(app->view.mode, MODE_PLAN);
    assert_non_null(strstr(app->ui.message, "house.svg: "));
    assert_null(strstr(app->ui.message, "cells"));
    char area[MEASURE_TEXT];
    measure_say(123456, app->document.map.unit, "", area);
    assert_string_equal(area, "123500 px");
    measure_say(12.3456, app->document.map.unit, "", area);
    assert_string_equal(area, "12.35 px");
    assert_false(layers_lists(&app->view, LAYER_CULL));
    assert_false(layers_lists(&app->view, LAYER_TREE));
    assert_int_equal(layers_fill(&app->view), LAYER_REGION);
    press(app, "F1");
    assert_int_equal(app->view.mode, MODE_EXPLORE);
    press(app, "9");
    assert_int_equal(app->view.mode, MODE_PLAN);
    press(app, "Ctrl+2");
    assert_int_equal(layers_fill(&app->view), LAYER_HEAT);
    viewer_end(app);
    app = viewer_start(true);
    viewer_open(app, MAPS "/office.map");
    assert_int_equal(app->view.mode, MODE_EXPLORE);
    viewer_end(app);
    app = viewer_start(true);
    app->view.mode = MODE_DRAW;
    viewer_open(app, MAPS "/keep.tmx");
    assert_int_equal(app->view.mode, MODE_DRAW);
    viewer_end(app);
}

/// An eye that sees nothing is told so, in place of rows of zeros.
static void test_eye_outside(void **state) {
    (void)state;
    app_state *app = start("house.svg", svg);
    viewer_keep_spots(app);
    app->view.eye.at = (sl_point){-1000, -1000};
    app_tick(app, 0);
    script_frame(app);
    assert_true(viewer_says(app, "outside of the plan"));
    assert_false(viewer_says(app, "perimeter"));
    viewer_drop_spots(app);
    viewer_end(app);
}

/// A way begins on one storey and ends on another: over the link that makes it shortest.
static void test_building(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-building-XXXXXX", paths[3][64];
    static const char *const names[] = {"ground.map", "first.map", "house.storeys"};
    static const char *const texts[] = {
        "sightline 1\nunit m\nwalls 0 0 12 0 12 4 0 4 0 0\nstart 1 1 0\n",
        "sightline 1\nunit m\nwalls 0 0 12 0 12 4 0 4 0 0\nstart 1 1 0\n",
        ("storeys 1\nstorey ground ground.map\nstorey first first.map\n"
         "link stair ground 10,2 first 10,2 6.5\nlink lift ground 2,3 first 2,3 40\n")};
    assert_non_null(mkdtemp(folder));
    for (int i = 0; i < 3; i++) {
        snprintf(paths[i], sizeof paths[i], "%s/%s", folder, names[i]);
        viewer_write(paths[i], texts[i]);
    }
    app_state *app = viewer_start(true);
    viewer_open(app, paths[0]);
    viewer_open(app, paths[2]);
    press(app, "Return");
    assert_string_equal(app->document.source.path, paths[0]);
    press(app, "9");
    press(app, "Ctrl+3");
    route_click(&app->view, (sl_point){2, 2});
    press(app, "Ctrl+Shift+B");
    press(app, "Down");
    press(app, "Return");
    assert_string_equal(app->document.source.path, paths[1]);
    route_click(&app->view, (sl_point){4, 2});
    app_tick(app, 0);
    script_frame(app);
    const struct building_way *way = building_way_shown(&app->view);
    assert_non_null(way);
    assert_true(way->made && way->route.found);
    assert_true(fabs(way->route.length - (8 + 6.5 + 6)) < 1e-9);
    assert_int_equal(way->route.link_count, 1);
    assert_string_equal(way->building.links[way->route.links[0]].name, "stair");
    assert_int_equal(way->route.count, 4);
    assert_int_equal(building_way_storey(&app->view), 1);
    // It stays while storeys change; a click begins anew; Escape takes it back.
    press(app, "Ctrl+Shift+B");
    press(app, "Up");
    press(app, "Return");
    assert_int_equal(building_way_storey(&app->view), 0);
    assert_true(building_way_shown(&app->view)->made);
    route_click(&app->view, (sl_point){2, 2});
    route_click(&app->view, (sl_point){5, 2});
    app_tick(app, 0);
    assert_true(fabs(building_way_shown(&app->view)->route.length - 3) < 1e-9);
    press(app, "Escape");
    assert_null(building_way_shown(&app->view));
    // A plan in another unit has no way in common, and is told.
    viewer_write(paths[1], "sightline 1\nunit ft\nwalls 0 0 12 0 12 4 0 4 0 0\nstart 1 1 0\n");
    route_click(&app->view, (sl_point){2, 2});
    route_click(&app->view, (sl_point){5, 2});
    app_tick(app, 0);
    assert_true(app->ui.message_is_error);
    assert_non_null(strstr(app->ui.message, "its lengths are in 'ft'"));
    // A plan that is opened by itself is of no building.
    viewer_open(app, paths[0]);
    app_tick(app, 0);
    assert_null(app->view.way);
    viewer_end(app);
    for (int i = 0; i < 3; i++) assert_int_equal(remove(paths[i]), 0);
    assert_int_equal(rmdir(folder), 0);
}

/// The first person stands below the plan, or has the half of its place beside it.
static void test_beside(void **state) {
    (void)state;
    app_state *app = start("house.svg", svg);
    const sl_box all = app_layout(app).plan[0];
    press(app, "I");
    assert_true(app_layout(app).plan[0].max.y < all.max.y);
    press(app, "Shift+I");
    const window_layout l = app_layout(app);
    const sl_box looks = l.below[PANE_FIRST_PERSON];
    assert_true(l.plan[0].max.y == all.max.y && l.plan[0].max.x == floor(all.max.x / 2));
    assert_true(looks.min.x == l.plan[0].max.x && looks.max.x == all.max.x);
    assert_true(looks.min.y == all.min.y && looks.max.y == all.max.y);
    press(app, "Ctrl+L"); // the table is below both
    const window_layout below = app_layout(app);
    assert_true(below.below[PANE_TABLE].min.y == below.plan[0].max.y);
    assert_true(below.below[PANE_FIRST_PERSON].max.y == below.plan[0].max.y);
    press(app, "Ctrl+L");
    press(app, "Shift+I");
    assert_true(app_layout(app).plan[0].max.x == all.max.x);
    viewer_end(app);
}

static const char doors[] = "sightline 1\nunit m\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 2 10 8\n"
                            "door low 10 0 10 2 open\ndoor high 10 8 10 10 open\nstart 1 1 0\n";

/// Two clicks; a door that is shut sends the way through the other one, or nowhere.
static void test_path(void **state) {
    (void)state;
    app_state *app = start("a.map", doors);
    press(app, "9");
    press(app, "Ctrl+3");
    const sl_point eye = app->view.eye.at;
    click_at(app, (sl_point){5, 3});
    assert_int_equal(app->view.route->clicks, 1);
    click_at(app, (sl_point){15, 3});
    const route_layer *layer = app->view.route;
    assert_int_equal(layer->clicks, 2);
    assert_true(app->view.eye.at.x == eye.x && app->view.eye.at.y == eye.y);
    assert_true(layer->route.found && layer->route.count == 3);
    assert_true(layer->route.points[1].x == 10 && layer->route.points[1].y == 2);
    const double low = layer->route.length;
    assert_true(fabs(low - 2 * hypot(5, 1)) < 0.1);
    door_toggle(&app->view, 0);
    app_tick(app, 0);
    assert_true(layer->route.found && layer->route.points[1].y == 8);
    assert_true(fabs(layer->route.length - 2 * hypot(5, 5)) < 0.1);
    door_toggle(&app->view, 1);
    show(app);
    assert_false(layer->route.found);
    door_toggle(&app->view, 0);
    app_tick(app, 0);
    assert_true(layer->route.length == low);
    // A third click begins anew; Escape takes it back.
    click_at(app, (sl_point){3, 3});
    assert_int_equal(layer->clicks, 1);
    press(app, "Escape");
    assert_int_equal(layer->clicks, 0);
    // The other tool puts the viewpoint again.
    press(app, "Ctrl+1");
    click_at(app, (sl_point){12, 5});
    assert_int_equal(layer->clicks, 0);
    assert_true(fabs(app->view.eye.at.x - 12) < 0.1);
    viewer_end(app);
}

/// A walker with a radius keeps away from walls, and does not pass a door that is too narrow.
static void test_walker(void **state) {
    (void)state;
    app_state *app = start("a.map", doors);
    press(app, "9");
    press(app, "Ctrl+3");
    click_at(app, (sl_point){5, 5});
    click_at(app, (sl_point){15, 5});
    const route_layer *layer = app->view.route;
    const double thin = layer->route.length;
    app->view.walker = 0.4;
    show(app);
    assert_true(layer->route.found && layer->route.length > thin);
    for (size_t i = 1; i + 1 < layer->route.count; i++) {
        const sl_point p = layer->route.points[i];
        const bool low = p.y < 5;
        assert_true(hypot(p.x - 10, p.y - (low ? 2 : 8)) >= 0.4);
    }
    app->view.walker = 1.1; // the doors are 2 wide
    show(app);
    assert_false(layer->route.found || layer->tight);
    app->view.walker = 6; // more than the room is
    show(app);
    assert_true(layer->tight && layer->clicks == 2);
    app->view.walker = 0;
    app_tick(app, 0);
    assert_true(layer->route.found && layer->route.length == thin);
    viewer_end(app);
}

/// The regions of a line that is dragged are those of the library, for the doors as they are.
static void test_from_line(void **state) {
    (void)state;
    app_state *app = start("a.map", doors);
    press(app, "9");
    press(app, "Ctrl+4");
    assert_null(from_line_seen(&app->view));
    const sl_point eye = app->view.eye.at;
    for (int shut = 0; shut < 2; shut++) {
        if (shut)
            door_toggle(&app->view, 0);
        else
            drag(app, (sl_point){3, 3}, (sl_point){7, 8});
        app_tick(app, 0);
        script_frame(app);
        const from_line *layer = from_line_seen(&app->view);
        sl_query *query;
        sl_set_sight *sight;
        assert_non_null(layer);
        assert_true(hypot(layer->ends[0].x - 3, layer->ends[0].y - 3) < 0.1);
        assert_true(hypot(layer->ends[1].x - 7, layer->ends[1].y - 8) < 0.1);
        assert_int_equal(sl_query_copy(app->context, app->view.present.query, &query), SL_OK);
        assert_int_equal(
            sl_set_sight_create(app->context, query, layer->ends, 2, SL_SET_LINE, &sight), SL_OK);
        for (int i = 0; i < 2; i++) {
            sl_set_region region = {0};
            assert_int_equal(sl_set_sight_region(app->context, sight, (sl_set_seen)i, &region),
                             SL_OK);
            assert_true(region.area > 90 && region.area == layer->seen[i].area);
            sl_set_region_destroy(app->context, &region);
        }
        assert_true(layer->seen[0].area > layer->seen[1].area);
        sl_set_sight_destroy(app->context, sight);
        sl_query_destroy(app->context, query);
    }
    assert_true(app->view.eye.at.x == eye.x && app->view.eye.at.y == eye.y);
    assert_int_equal(layers_fill(&app->view), LAYER_COUNT);
    press(app, "Escape");
    assert_null(from_line_seen(&app->view));
    // A click is no line; another tool brings layers back.
    click_at(app, (sl_point){12, 5});
    assert_true(app->view.eye.at.x == eye.x && !app->view.from_line->drawn);
    press(app, "Ctrl+2");
    assert_int_equal(app->view.tool, TOOL_ISOVIST);
    assert_int_equal(layers_fill(&app->view), LAYER_HEAT);
    viewer_end(app);
}

/// With colours by rank the key tells where quarters of the points end.
static void test_ranks(void **state) {
    (void)state;
    app_state *app = start("a.map", doors);
    const heat_graph *graph;
    legend_key key;
    press(app, "9");
    press(app, "Ctrl+2");
    const double *values = heat_layer_values(&app->view, &graph);
    assert_non_null(values);
    const uint32_t before = app->view.heat_choice.stamp;
    action_run(app, action_find("heat_ranks"));
    app_tick(app, 0);
    assert_true(app->view.heat_choice.stamp != before);
    assert_true(heat_layer_key(&app->view, &key));
    double ends[3] = {0};
    for (int i = 0; i < key.count; i++)
        if (strstr(key.rows[i].label, "quarters"))
            assert_int_equal(sscanf(key.rows[i].text, "%lf, %lf, %lf", ends, ends + 1, ends + 2),
                             3);
    for (int i = 0; i < 3; i++) {
        uint32_t below = 0, to = 0, valued = 0;
        for (uint32_t p = 0; p < graph->grid.count; p++) {
            valued += !isnan(values[p]);
            below += values[p] < ends[i] * (1 - 1e-3);
            to += values[p] <= ends[i] * (1 + 1e-3);
        }
        const double share = 0.25 * (i + 1) * valued;
        assert_true(below <= share && share <= to + 1);
    }
    viewer_end(app);
}

/// How high a doubt of so many words is drawn.
static double doubt_height(app_state *app, int words) {
    char *notes = app->document.notes;
    size_t length = (size_t)snprintf(notes, NOTES_TEXT, "the lines are taken\n");
    for (int i = 0; i < words; i++)
        length += (size_t)snprintf(notes + length, NOTES_TEXT - length, "words ");
    app->ui.spot_count = 0;
    show(app);
    for (int i = 0; i < app->ui.spot_count; i++) {
        const text_spot *spot = &app->ui.spots[i];
        if (strncmp(spot->text, "words", 5) == 0) return spot->box.max.y - spot->box.min.y;
    }
    fail_msg("the doubt is not shown");
    return 0;
}

/// What the reader doubts is shown up to its end, which says what to do.
static void test_long_doubt(void **state) {
    (void)state;
    app_state *app = start("house.svg", svg);
    viewer_keep_spots(app);
    assert_true(doubt_height(app, 120) > 2.8 * doubt_height(app, 40));
    viewer_drop_spots(app);
    viewer_end(app);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_opens),      cmocka_unit_test(test_eye_outside),
        cmocka_unit_test(test_beside),     cmocka_unit_test(test_building),
        cmocka_unit_test(test_path),       cmocka_unit_test(test_walker),
        cmocka_unit_test(test_from_line),  cmocka_unit_test(test_ranks),
        cmocka_unit_test(test_long_doubt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
