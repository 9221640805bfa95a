// The tool Rooms of the Plan mode: names from the drawing and typed ones, what is seen of each, the
// mean of the heat map in each, zones, and the table with all of that.
#include "viewer_app.h"

#include "app/layout.h"
#include "plan/heat.h"
#include "plan/room_map.h"
#include "plan/table.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/// Two rooms of 96 by 96 and 100 by 96 with a gap of 10; one of them has a name, with a comma.
static const char svg[] =
    "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='100'><g id='walls'>"
    "<path d='M0 0 H200 V100 H0 Z M100 0 V45 M100 55 V100' stroke='black' fill='none'/></g>"
    "<text x='20' y='20'>Hall, \"old\"</text></svg>";

static app_state *start(void) {
    char folder[] = "/tmp/sightline-rooms-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/house.svg", folder);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(svg, stream);
    assert_int_equal(fclose(stream), 0);
    app_state *app = viewer_start(true);
    viewer_open(app, path);
    script_frame(app);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
    return app;
}

static void press(app_state *app, const char *key) {
    viewer_press(app, key);
    app_tick(app, 0);
    script_frame(app);
}

static sl_point on_page(const app_state *app, sl_point at) {
    const sl_frame frame = camera_frame(&app->view.camera, app_layout(app).plan[0], 1);
    return sl_frame_point(&frame, at);
}

static void drag(app_state *app, sl_point from, sl_point to) {
    const sl_point a = on_page(app, from), b = on_page(app, to);
    input_move(app, a);
    input_press(app, BUTTON_LEFT, a);
    input_move(app, b);
    script_frame(app);
    input_release(app, b);
    app_tick(app, 0);
    script_frame(app);
}

/// The text of the table as it is written.
static void read_table(app_state *app, char *text, size_t room) {
    char path[] = "/tmp/sightline-table-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    assert_ok(app->context, table_write(&app->view, path));
    FILE *stream = fopen(path, "r");
    assert_non_null(stream);
    text[fread(text, 1, room - 1, stream)] = '\0';
    fclose(stream);
    assert_int_equal(remove(path), 0);
}

static void rooms_have_names(void **state) {
    (void)state;
    app_state *app = start();
    char text[1024];
    press(app, "Ctrl+8");
    const room_map *map = room_map_shown(&app->view);
    assert_non_null(map);
    assert_int_equal(room_map_rows(map), 2);
    const size_t hall = room_map_at(map, (sl_point){20, 50}), other = !hall;
    assert_int_equal(room_map_at(map, (sl_point){150, 50}), other);
    assert_string_equal(room_map_name(map, hall), "Hall, \"old\"");
    // A click chooses a room and puts the viewpoint; Ctrl+K and letters name it.
    drag(app, (sl_point){150, 30}, (sl_point){150, 30});
    assert_int_equal(app->view.table.chosen, other);
    assert_true(fabs(app->view.eye.at.x - 150) < 1);
    press(app, "Ctrl+K");
    input_text(app, "Studio");
    press(app, "Return");
    assert_string_equal(room_map_name(map, other), "Studio");
    assert_null(app->ui.field);
    // Escape leaves a name as it was; an empty one takes the typed name back.
    press(app, "Ctrl+K");
    input_text(app, "x");
    press(app, "Escape");
    assert_string_equal(room_map_name(map, other), "Studio");
    read_table(app, text, sizeof text);
    assert_int_equal(strncmp(text, "name,area,seen_area,seen_share\n", 31), 0);
    assert_non_null(strstr(text, "\"Hall, \"\"old\"\"\","));
    assert_non_null(strstr(text, "Studio,"));
    // The name stays through a change of the map.
    press(app, "F3");
    drag(app, (sl_point){150, 70}, (sl_point){170, 70});
    press(app, "9");
    map = room_map_shown(&app->view);
    assert_non_null(map);
    assert_string_equal(room_map_name(map, room_map_at(map, (sl_point){150, 30})), "Studio");
    drag(app, (sl_point){150, 30}, (sl_point){150, 30});
    press(app, "Ctrl+K");
    press(app, "Delete");
    press(app, "Return");
    assert_non_null(strstr(room_map_name(map, app->view.table.chosen), "Room "));
    viewer_end(app);
}

/// The eye sees all of its own convex room, all round, and a part of the other one.
static void seen_and_means(void **state) {
    (void)state;
    app_state *app = start();
    char text[1024];
    press(app, "Ctrl+8");
    app->view.eye.fov = 360;
    drag(app, (sl_point){150, 30}, (sl_point){150, 30});
    const room_map *map = room_map_shown(&app->view);
    const size_t own = app->view.table.chosen;
    const double all = app->view.seen.region_area;
    assert_true(fabs(map->seen[own] - room_map_area(map, own)) < 1e-6 * all);
    assert_true(map->seen[!own] > 0 && map->seen[!own] < room_map_area(map, !own) / 2);
    assert_true(fabs(map->seen[0] + map->seen[1] - all) < 0.01 * all);
    // The mean over a room is that of the points in it.
    press(app, "1");
    const heat_graph *graph;
    const double *values = heat_layer_values(&app->view, &graph);
    map = room_map_shown(&app->view);
    assert_non_null(values);
    double sum = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < graph->grid.count; i++) {
        if (sl_rooms_at(&map->rooms, graph->grid.points[i]) != own) continue;
        sum += values[i];
        count++;
    }
    assert_true(count > 100 && map->points[own] == count);
    assert_true(fabs(map->means[own] - sum / count) < 1e-9 * fabs(sum));
    read_table(app, text, sizeof text);
    assert_int_equal(strncmp(text, "name,area,mean_", 15), 0);
    viewer_end(app);
}

static void zones_are_drawn(void **state) {
    (void)state;
    app_state *app = start();
    press(app, "Ctrl+8");
    app->view.eye.fov = 360;
    drag(app, (sl_point){150, 30}, (sl_point){150, 30});
    drag(app, (sl_point){110, 60}, (sl_point){130, 90});
    const room_map *map = room_map_shown(&app->view);
    assert_int_equal(room_map_rows(map), 3);
    assert_true(fabs(room_map_area(map, 2) - 600) < 30);
    assert_true(fabs(map->seen[2] - room_map_area(map, 2)) < 1e-6 * map->seen[2]);
    assert_string_equal(room_map_name(map, 2), "Zone 1");
    // A click in it chooses it before the room; it is named, and deleted.
    drag(app, (sl_point){120, 75}, (sl_point){120, 75});
    assert_int_equal(app->view.table.chosen, 2);
    press(app, "Ctrl+K");
    input_text(app, "Desk");
    press(app, "Return");
    assert_string_equal(room_map_name(map, 2), "Desk");
    press(app, "Delete");
    assert_int_equal(room_map_rows(room_map_shown(&app->view)), 2);
    // A zone without an area is none, and rooms are not deleted.
    drag(app, (sl_point){110, 60}, (sl_point){130, 60});
    assert_true(room_map_rows(room_map_shown(&app->view)) <= 3);
    drag(app, (sl_point){20, 30}, (sl_point){20, 30});
    press(app, "Delete");
    assert_true(room_map_rows(room_map_shown(&app->view)) >= 2);
    viewer_end(app);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rooms_have_names),
        cmocka_unit_test(seen_and_means),
        cmocka_unit_test(zones_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
