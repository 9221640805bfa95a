/// The Cameras mode through the state of the app: by pointer, with undo; tables; and jobs in the
/// background, which nothing may wait for.
#include "viewer_app.h"

#include "app/sliders.h"
#include "document/measure.h"
#include "plan/cameras.h"
#include "plan/heat.h"
#include "plan/room_map.h"
#include "sightline/place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static void click(app_state *app, sl_point at) {
    const sl_point page = viewer_on_page(app, at);
    input_press(app, BUTTON_LEFT, page);
    input_release(app, page);
    app_tick(app, 0);
}

static void drag(app_state *app, sl_point from, sl_point to) {
    const sl_point a = viewer_on_page(app, from), b = viewer_on_page(app, to);
    input_press(app, BUTTON_LEFT, a);
    for (int i = 1; i <= 5; i++) {
        input_move(app, (sl_point){a.x + (b.x - a.x) * i / 5, a.y + (b.y - a.y) * i / 5});
        app_tick(app, 1.0 / 60);
        script_frame(app);
    }
    input_release(app, b);
    app_tick(app, 0);
}

static app_state *start(const char *map, bool steady) {
    app_state *app = viewer_start(steady);
    viewer_open(app, map);
    while (!steady && !app->document.has_visibility) app_tick(app, 0.01);
    script_frame(app);
    viewer_press(app, "8");
    app_tick(app, 0);
    return app;
}

static bool is_near(double a, double b, double within) {
    return fabs(a - b) <= within;
}

/// The coverage that is shown is that of the table, found anew.
static void assert_surveyed(app_state *app) {
    const camera_layer *layer = app->view.cameras;
    sl_context *context = testing_context(NULL);
    sl_query *query = NULL;
    sl_coverage fresh;
    sl_viewpoint viewpoints[64];
    assert_true(layer->known && layer->seen_stamp == layer->stamp);
    assert_true(layer->table.count <= 64);
    for (size_t i = 0; i < layer->table.count; i++) viewpoints[i] = layer->table.items[i].view;
    const sl_baked *baked = app->document.baked;
    assert_ok(context, sl_query_over(context, &baked->space, &baked->map, NULL, &query));
    for (size_t i = 0; i < app->document.map.door_count; i++)
        sl_query_set_door_at(context, query, i, app->document.map.doors[i].open);
    assert_ok(context, sl_coverage_make(context, query, viewpoints, layer->table.count, &fresh));
    double all = 0;
    for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++)
        all += sl_coverage_class_area(&layer->coverage, k);
    assert_true(is_near(all, fresh.overlay.areas[0], 1e-6 * all));
    assert_int_equal(layer->coverage.count, fresh.count);
    for (size_t i = 0; i <= fresh.count; i++)
        assert_true(is_near(layer->coverage.overlay.areas[i], fresh.overlay.areas[i], 1e-6 * all));
    assert_int_equal(layer->coverage.blind_count, fresh.blind_count);
    sl_coverage_destroy(context, &fresh);
    sl_query_destroy(context, query);
    sl_context_destroy(context);
}

/// Ctrl+K and letters name the chosen camera, which can be undone; blind spots are said by rooms.
static void names(void **state) {
    (void)state;
    app_state *app = start(MAPS "/office.map", true);
    const sl_point at = {53, 20};
    click(app, at);
    viewer_press(app, "Ctrl+K");
    input_text(app, "door, north");
    viewer_press(app, "Return");
    app_tick(app, 0);
    const camera_layer *layer = app->view.cameras;
    assert_string_equal(layer->table.items[0].name, "door, north");
    assert_surveyed(app);
    viewer_press(app, "Ctrl+K");
    input_text(app, "other");
    viewer_press(app, "Escape");
    assert_string_equal(layer->table.items[0].name, "door, north");
    app_tick(app, 0);
    script_frame(app);
    assert_true(layer->coverage.blind_count > 0);
    const char *room = room_map_room(&app->view, layer->coverage.blind[0].at);
    assert_non_null(room);
    assert_non_null(strstr(room, "Room "));
    viewer_press(app, "Ctrl+Z");
    assert_null(layer->table.items[0].name);
    viewer_end(app);
}

static void by_pointer(void **state) {
    (void)state;
    app_state *app = start(MAPS "/oblique/comb.map", true);
    click(app, (sl_point){6, 0.5});
    click(app, (sl_point){1, 8}); // between two teeth, outside
    const camera_layer *layer = app->view.cameras;
    assert_int_equal(layer->table.count, 1);
    assert_surveyed(app);
    drag(app, (sl_point){6, 0.5}, (sl_point){14, 0.5});
    assert_true(is_near(layer->table.items[0].view.at.x, 14, 1e-6));
    assert_surveyed(app);
    drag(app, (sl_point){14, 0.5}, (sl_point){14, -3}); // out of the room: it stays inside
    assert_true(layer->table.items[0].view.at.y > 0);
    for (int i = 0; i < 40; i++) viewer_press(app, ",");
    app_tick(app, 0);
    sl_viewpoint *v = camera_chosen(&app->view);
    assert_non_null(v);
    assert_true(v->fov == 160);
    const double reach = 44 / app->view.camera.scale;
    drag(app, (sl_point){v->at.x + reach, v->at.y}, (sl_point){v->at.x, v->at.y + reach});
    assert_true(is_near(v->heading, 90, 2));
    assert_surveyed(app);
    viewer_press(app, "Left");
    assert_true(is_near(v->heading, 95, 2));
    viewer_press(app, "-");
    assert_true(camera_chosen(&app->view)->range > 0);
    viewer_press(app, "Ctrl+C");
    app_tick(app, 0);
    assert_int_equal(layer->table.count, 2);
    assert_surveyed(app);
    viewer_press(app, "Delete");
    app_tick(app, 0);
    assert_int_equal(layer->table.count, 1);
    size_t steps = 0;
    for (; layer->done.count; steps++) viewer_press(app, "Ctrl+Z");
    assert_true(steps > 40);
    assert_int_equal(layer->table.count, 0);
    for (size_t i = 0; i < steps; i++) viewer_press(app, "Ctrl+Y");
    app_tick(app, 0);
    assert_int_equal(layer->table.count, 1);
    assert_surveyed(app);
    assert_int_equal(layer->undone.count, 0);
    viewer_end(app);
}

/// Puts a slider to a share by the setting behind it, as a drag does.
static void slide(app_state *app, const char *label, double share) {
    size_t count;
    const slider_row *rows = slider_table(&count), *row = NULL;
    for (size_t i = 0; i < count; i++)
        if (strcmp(rows[i].label, label) == 0) row = &rows[i];
    assert_non_null(row);
    assert_true(row->shown(app));
    row->begin(&app->view);
    row->set(app, share);
    row->end(&app->view);
    app_tick(app, 0);
}

/// Height and tilt: the same ground as that of a table with these columns, whatever is changed
/// last; a smaller range that was set stays.
static void ground(void **state) {
    (void)state;
    app_state *app = start(MAPS "/office.map", true);
    click(app, (sl_point){53, 20});
    const camera_layer *layer = app->view.cameras;
    slide(app, "Field of view", (90 - 5) / 355.0);
    const size_t before = layer->done.count;
    slide(app, "Height", 0.4);
    slide(app, "Tilt", 50 / 90.0);
    assert_int_equal(layer->done.count, before + 2);
    slide(app, "Tilt", 50 / 90.0); // no change, nothing to undo
    assert_int_equal(layer->done.count, before + 2);
    const sl_camera *row = camera_chosen_row(&app->view);
    sl_viewpoint wanted = {.fov = 90};
    assert_true(row->height > 0 && row->tilt == 50);
    sl_viewpoint_tilt(&wanted, row->height, row->tilt, SL_PICTURE_ASPECT);
    assert_true(wanted.nearest > 0 && wanted.range > wanted.nearest);
    assert_true(row->view.nearest == wanted.nearest && row->view.range == wanted.range);
    assert_surveyed(app);
    // A wider picture reaches farther, and one that is no longer tilted has no end.
    slide(app, "Field of view", (100 - 5) / 355.0);
    assert_true(row->view.range > wanted.range && row->view.nearest < wanted.nearest);
    slide(app, "Tilt", 0);
    assert_true(row->view.range == 0 && row->view.nearest > 0);
    slide(app, "Range", 0.1);
    const double by_hand = row->view.range;
    slide(app, "Tilt", 40 / 90.0);
    assert_true(row->view.range == by_hand);
    slide(app, "Height", 0);
    assert_true(row->view.range == by_hand && row->view.nearest == 0);
    while (layer->done.count > before) viewer_press(app, "Ctrl+Z");
    assert_true(layer->table.items[0].height == 0 && layer->table.items[0].view.range == 0);
    viewer_end(app);
}

static void fewest(void **state) {
    (void)state;
    app_state *app = start(MAPS "/oblique/comb.map", true);
    click(app, (sl_point){6, 0.5});
    viewer_press(app, "Space");
    app_tick(app, 0);
    const camera_layer *layer = app->view.cameras;
    assert_int_equal(layer->table.count, 5);
    assert_true(sl_coverage_class_area(&layer->coverage, 0) == 0);
    assert_non_null(strstr(layer->proof, "No fewer can: "));
    assert_non_null(
        strstr(app->ui.message, "Looked for: field of view 360\xc2\xb0, no limit of range"));
    viewer_press(app, "Ctrl+Z");
    assert_int_equal(layer->table.count, 1);
    assert_true(layer->proof[0] == '\0');
    viewer_end(app);
}

/// A door that is shut, and a map that is another one.
static void map_changes(void **state) {
    (void)state;
    app_state *app = start(MAPS "/effects/doors.map", true);
    click(app, app->view.eye.at);
    assert_int_equal(app->view.cameras->table.count, 1);
    for (int i = 0; i < 3; i++) {
        sl_map *map = &app->document.map;
        assert_true(map->door_count > 0);
        map->doors[0].open = !map->doors[0].open;
        document_touch(&app->document);
        app_tick(app, 0);
        assert_surveyed(app);
    }
    viewer_open(app, MAPS "/oblique/comb.map");
    viewer_answer(app, "D");
    app_settle(app);
    assert_true(!app->view.cameras || !app->view.cameras->table.count);
    viewer_end(app);
}

static void tables(void **state) {
    (void)state;
    char path[] = "/tmp/sightline-cameras-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    app_state *app = start(MAPS "/office.map", true);
    assert_int_equal(cameras_write(&app->view, path), SL_BAD_ARGUMENT); // nothing to write
    viewer_write(path, "name,x,y,heading,fov,range\ngate,53,20,90,60,12.5\n,30,20,,,\n");
    assert_int_equal(cameras_read(&app->view, path), SL_OK);
    assert_int_equal(cameras_write(&app->view, path), SL_OK);
    assert_int_equal(cameras_read(&app->view, path), SL_OK);
    const camera_layer *layer = app->view.cameras;
    app_tick(app, 0);
    assert_int_equal(layer->table.count, 2);
    assert_string_equal(layer->table.items[0].name, "gate");
    assert_true(layer->table.items[0].view.range == 12.5 && layer->table.items[1].view.fov == 360);
    assert_surveyed(app);
    viewer_write(path, "x,y,fov\n1,2,700\n");
    assert_int_equal(cameras_read(&app->view, path), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(app->context), ":2"));
    assert_int_equal(layer->table.count, 2); // as it was
    unlink(path);
    viewer_end(app);
}

/// The search runs in the background with both bounds, and stops at once with the best set.
static void stopped(void **state) {
    (void)state;
    app_state *app = start(MAPS "/office.map", false);
    const camera_layer *layer = app->view.cameras;
    const struct timespec pause = {.tv_nsec = 2000000};
    viewer_press(app, "Space");
    job_progress p = cameras_progress(layer);
    while (p.running && !p.total) {
        nanosleep(&pause, NULL);
        app_tick(app, 0.002);
        p = cameras_progress(layer);
    }
    assert_true(p.running && p.done >= 1 && p.done <= p.total);
    viewer_press(app, "Escape");
    while (cameras_progress(layer).running) {
        nanosleep(&pause, NULL);
        app_tick(app, 0.002);
    }
    assert_true(layer->table.count >= p.done && layer->table.count <= p.total);
    assert_non_null(strstr(layer->proof, "ended early"));
    while (!layer->known || layer->seen_stamp != layer->stamp) {
        nanosleep(&pause, NULL);
        app_tick(app, 0.002);
    }
    assert_true(sl_coverage_class_area(&layer->coverage, 0) == 0);
    viewer_press(app, "Space"); // ends with the program
    viewer_end(app);
}

static void wait_for_search(app_state *app) {
    while (cameras_progress(app->view.cameras).running) app_tick(app, 0.01);
}

/// What is looked for is like the chosen camera. Those that stand are kept where that is asked for:
/// one more sees more than they did, and the fewest for the rest see all that can be seen.
static void like_the_chosen(void **state) {
    (void)state;
    app_state *app = start(MAPS "/oblique/comb.map", true);
    click(app, (sl_point){6, 0.5});
    for (int i = 0; i < 54; i++) viewer_press(app, ",");
    viewer_press(app, "Ctrl+K");
    input_text(app, "gate");
    viewer_press(app, "Return");
    app_tick(app, 0);
    const camera_layer *layer = app->view.cameras;
    assert_true(layer->table.items[0].view.fov == 90);
    const double unseen = sl_coverage_class_area(&layer->coverage, 0);
    viewer_press(app, "Ctrl+Space");
    wait_for_search(app);
    assert_int_equal(layer->table.count, 2);
    assert_string_equal(layer->table.items[0].name, "gate");
    assert_true(layer->table.items[1].view.fov == 90);
    app_tick(app, 0);
    assert_true(sl_coverage_class_area(&layer->coverage, 0) < unseen);
    assert_surveyed(app);
    viewer_press(app, "Up"); // the last one
    viewer_press(app, "Shift+Space");
    wait_for_search(app);
    assert_true(layer->table.count > 2);
    assert_string_equal(layer->table.items[0].name, "gate");
    for (size_t i = 0; i < layer->table.count; i++)
        assert_true(layer->table.items[i].view.fov == 90);
    assert_non_null(strstr(layer->proof, "places and headings"));
    viewer_press(app, "Ctrl+Z");
    assert_int_equal(layer->table.count, 2);
    viewer_end(app);
}

/// A camera of a table that stands in no room is named.
static void of_no_room(void **state) {
    (void)state;
    app_state *app = start(MAPS "/office.map", true);
    char path[] = "/tmp/sightline-no-room-XXXXXX";
    close(mkstemp(path));
    viewer_write(path, "name,x,y\nhall,53,20\nfar off,900,900\n");
    assert_int_equal(cameras_read(&app->view, path), SL_OK);
    assert_non_null(strstr(app->ui.message, "far off stands in no room"));
    viewer_press(app, "Shift+Space");
    assert_false(cameras_progress(app->view.cameras).running);
    assert_non_null(strstr(app->ui.message, "far off stands in no room"));
    remove(path);
    viewer_end(app);
}

/// Cameras stand in a plan: nothing of cells or portals is drawn, also after a heat map.
static void test_no_portals(void **state) {
    (void)state;
    app_state *app = viewer_start(true);
    viewer_open(app, MAPS "/office.map");
    script_frame(app);
    assert_true(app->view.scene_show & SL_LAYER_PORTALS);
    viewer_press(app, "1");
    script_frame(app);
    viewer_press(app, "8");
    app_tick(app, 0);
    script_frame(app);
    assert_false(app->view.scene_show & (SL_LAYER_PORTALS | SL_LAYER_CELLS));
    viewer_press(app, "F1");
    script_frame(app);
    assert_true(app->view.scene_show & SL_LAYER_PORTALS);
    viewer_end(app);
}

/// Buttons stay where they are while cameras come and go and a search runs; areas have their unit.
static void test_panel(void **state) {
    (void)state;
    static const char *const buttons[] = {"Find the fewest", "Copy", "Undo", "Import", "Export"};
    enum { BUTTONS = sizeof buttons / sizeof *buttons };
    app_state *app = start(MAPS "/office.map", true);
    snprintf(app->document.map.unit, sizeof app->document.map.unit, "m");
    viewer_keep_spots(app);
    double before[BUTTONS];
    script_frame(app);
    for (int i = 0; i < BUTTONS; i++) before[i] = viewer_spot(app, buttons[i]).min.y;
    click(app, (sl_point){30, 20});
    cameras_find(&app->view, SEARCH_ONE);
    for (int step = 0; step < 3; step++) {
        script_frame(app);
        for (int i = 0; i < BUTTONS; i++)
            assert_true(viewer_spot(app, buttons[i]).min.y == before[i]);
        app_tick(app, 0);
    }
    // Rows stay, too, when a camera is chosen and its sliders come.
    const double row = viewer_spot(app, "not seen").min.y;
    app->view.cameras->chosen = SIZE_MAX;
    script_frame(app);
    assert_true(viewer_spot(app, "not seen").min.y == row);
    char text[96], share[SL_COUNT_TEXT];
    const sl_coverage *c = &app->view.cameras->coverage;
    sl_text_percent(sl_coverage_class_area(c, 1) / c->overlay.areas[0], share);
    snprintf(text, sizeof text, "%.4g m\xc2\xb2   %s", sl_coverage_class_area(c, 1), share);
    viewer_spot(app, text);
    viewer_drop_spots(app);
    viewer_end(app);
}

static void type_value(app_state *app, const char *text) {
    input_text(app, text);
    viewer_press(app, "Return");
    app_tick(app, 0);
    script_frame(app);
}

/// Fields of view, headings and ranges are typed; what they cannot be is told, and undo knows them.
static void test_typed(void **state) {
    (void)state;
    app_state *app = start(MAPS "/office.map", true);
    viewer_press(app, "Ctrl+Shift+K"); // nothing to type without a camera
    assert_null(app->ui.field);
    click(app, (sl_point){30, 20});
    script_frame(app);
    const sl_viewpoint *v = camera_chosen(&app->view);
    viewer_press(app, "Ctrl+Shift+K");
    type_value(app, "62,5\xc2\xb0");
    assert_true(v->fov == 62.5);
    viewer_press(app, "Ctrl+Shift+K");
    viewer_press(app, "Ctrl+Shift+K"); // the next one
    type_value(app, "-90");
    assert_true(camera_chosen(&app->view)->heading == 270);
    for (int i = 0; i < 3; i++) viewer_press(app, "Ctrl+Shift+K");
    type_value(app, "7.25");
    v = camera_chosen(&app->view);
    assert_true(v->range == 7.25 && v->fov == 62.5);
    // What is not changed stays as it is, with all of its digits.
    camera_chosen(&app->view)->range = 12345.6;
    for (int i = 0; i < 3; i++) viewer_press(app, "Ctrl+Shift+K");
    assert_string_equal(app->view.name.text, "12350");
    char said[MEASURE_TEXT];
    measure_say(9999.7, app->document.map.unit, "", said);
    assert_memory_equal(said, "10000", 5);
    viewer_press(app, "Return");
    assert_true(camera_chosen(&app->view)->range == 12345.6);
    camera_chosen(&app->view)->range = 7.25;
    viewer_press(app, "Ctrl+Shift+K");
    type_value(app, "400");
    assert_true(app->ui.message_is_error);
    assert_non_null(strstr(app->ui.message, "Field of view: '400'"));
    assert_non_null(app->ui.field);
    viewer_press(app, "Escape");
    assert_null(app->ui.field);
    assert_true(camera_chosen(&app->view)->fov == 62.5);
    viewer_press(app, "Ctrl+Z");
    assert_true(app->view.cameras->table.items[0].view.range == 0);
    // A name is still a name.
    app->view.cameras->chosen = 0;
    viewer_press(app, "Ctrl+K");
    type_value(app, "45");
    assert_string_equal(app->view.cameras->table.items[0].name, "45");
    // The grid of the heat map takes any step that it can have.
    viewer_press(app, "9");
    viewer_press(app, "1");
    app_tick(app, 0);
    script_frame(app);
    for (int i = 0; i < 2; i++) viewer_press(app, "Ctrl+Shift+K"); // behind the view cone
    type_value(app, "0.7");
    assert_true(heat_step(&app->view) == 0.7);
    app_tick(app, 0);
    const heat_graph *graph;
    assert_non_null(heat_layer_values(&app->view, &graph));
    assert_true(graph->grid.step == 0.7);
    for (int i = 0; i < 2; i++) viewer_press(app, "Ctrl+Shift+K");
    type_value(app, "0.0001");
    assert_true(app->ui.message_is_error);
    assert_true(heat_step(&app->view) == 0.7);
    viewer_press(app, "Escape");
    viewer_press(app, "5");
    assert_true(heat_step(&app->view) == 0.5);
    // Keys and the slider go to the steps beside one that is typed.
    static const struct {
        double typed, coarser, finer;
    } steps[] = {{0.7, 1, 0.5}, {0.6, 1, 0.5}, {1.9, 2, 1}, {1, 2, 0.5}};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        int last;
        assert_true(heat_type_step(&app->view, steps[i].typed));
        viewer_press(app, "4");
        assert_true(heat_step(&app->view) == steps[i].coarser);
        assert_true(heat_type_step(&app->view, steps[i].typed));
        viewer_press(app, "5");
        assert_true(heat_step(&app->view) == steps[i].finer);
        heat_set_step(&app->view, heat_step_place(&app->view, &last));
        assert_true(heat_step(&app->view) == steps[i].finer);
        const int place = heat_step_place(&app->view, &last);
        assert_true(heat_type_step(&app->view, 1.1 * steps[i].finer));
        heat_set_step(&app->view, place);
        assert_true(heat_step(&app->view) == steps[i].finer);
    }
    viewer_end(app);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_panel),      cmocka_unit_test(test_no_portals),
        cmocka_unit_test(test_typed),      cmocka_unit_test(by_pointer),
        cmocka_unit_test(names),           cmocka_unit_test(fewest),
        cmocka_unit_test(map_changes),     cmocka_unit_test(tables),
        cmocka_unit_test(stopped),         cmocka_unit_test(ground),
        cmocka_unit_test(like_the_chosen), cmocka_unit_test(of_no_room)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
