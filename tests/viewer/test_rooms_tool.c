// The tool Rooms of the Plan mode: names from the drawing and typed ones, what is seen of each, the
// mean of the heat map in each, zones, and the table with all of that.
#include "hand.h"

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

enum { FOLDER = 32 };

static void write_house(char folder[FOLDER], char path[64]) {
    snprintf(folder, FOLDER, "/tmp/sightline-rooms-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(path, 64, "%s/house.svg", folder);
    viewer_write(path, svg);
}

static app_state *start(void) {
    char folder[FOLDER], path[64];
    write_house(folder, path);
    app_state *app = viewer_start(true);
    viewer_open(app, path);
    script_frame(app);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
    return app;
}

/// The same where nothing waits by itself for what is made in the background.
static void settle_and_press(app_state *app, const char *key) {
    press(app, key);
    app_settle(app);
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
    // With none chosen, Ctrl+K takes the room of the viewpoint: letters never run keys.
    assert_int_equal(app->view.table.chosen, SIZE_MAX);
    const size_t here = room_map_at(map, app->view.eye.at);
    press(app, "Ctrl+K");
    assert_non_null(app->ui.field);
    assert_int_equal(app->view.table.chosen, here);
    assert_string_equal(app->view.name.text, room_map_name(map, here));
    press(app, "Escape");
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

/// Where no room can be named, Ctrl+K says what to do first.
static void no_room_to_name(void **state) {
    (void)state;
    app_state *app = start();
    press(app, "9");
    press(app, "Ctrl+K");
    assert_string_equal(app->ui.message, "Ctrl+8 shows the rooms first");
    press(app, "Ctrl+8");
    app->view.eye.at = (sl_point){-40, 50};
    press(app, "Ctrl+K");
    assert_string_equal(app->ui.message, "click a room first");
    assert_null(app->ui.field);
    assert_int_equal(app->view.table.chosen, SIZE_MAX);
    app->view.eye.at = (sl_point){150, 50};
    press(app, "Ctrl+K");
    assert_non_null(app->ui.field);
    viewer_end(app);
    char folder[] = "/tmp/sightline-rooms-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/walls.map", folder);
    viewer_write(path, "sightline 1\nwall 0 0 5 0\nwall 5 0 5 5\n");
    app = viewer_start(true);
    viewer_open(app, path);
    press(app, "9");
    press(app, "Ctrl+8");
    press(app, "Ctrl+K");
    assert_string_equal(app->ui.message, "there is no room in this plan");
    viewer_end(app);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
    // While they are found it says so.
    app = viewer_start(false);
    viewer_open(app, MAPS "/office.map");
    viewer_press(app, "9");
    viewer_press(app, "Ctrl+8");
    app_tick(app, 0);
    for (int i = 0; i < 100 && !room_map_shown(&app->view); i++) {
        viewer_press(app, "Ctrl+K");
        assert_string_equal(app->ui.message, "the rooms are still being found");
        app_tick(app, 0);
    }
    viewer_end(app);
}

static void zones_are_drawn(void **state) {
    (void)state;
    app_state *app = start();
    press(app, "Ctrl+8");
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
    assert_int_equal(room_map_rows(room_map_shown(&app->view)), 2);
    drag(app, (sl_point){20, 30}, (sl_point){20, 30});
    press(app, "Delete");
    assert_int_equal(room_map_rows(room_map_shown(&app->view)), 2);
    viewer_end(app);
}

/// Typed names and zones are there at the next start, with all their letters; those of another file
/// stay with it.
static void names_are_kept(void **state) {
    (void)state;
    char folder[FOLDER], path[64], config[] = "/tmp/sightline-config-XXXXXX", kept[96], text[1024];
    write_house(folder, path);
    assert_non_null(mkdtemp(config));
    assert_int_equal(setenv("XDG_CONFIG_HOME", config, 1), 0);
    for (int run = 0; run < 2; run++) {
        app_state *app = viewer_start(false);
        viewer_open(app, path);
        script_frame(app);
        if (dialog_open_now(&app->desk.dialog) != DIALOG_NONE) viewer_press(app, "Return");
        settle_and_press(app, "Ctrl+8");
        const room_map *map = room_map_shown(&app->view);
        assert_non_null(map);
        const size_t studio = room_map_at(map, (sl_point){150, 50});
        if (run == 0) {
            drag(app, (sl_point){150, 30}, (sl_point){150, 30});
            settle_and_press(app, "Ctrl+K");
            input_text(app, "12 \xc3\x84rger, 3");
            settle_and_press(app, "Return");
            drag(app, (sl_point){110, 60}, (sl_point){130, 90});
            drag(app, (sl_point){10, 60}, (sl_point){30, 90});
            settle_and_press(app, "Ctrl+8");
            drag(app, (sl_point){120, 75}, (sl_point){120, 75});
            settle_and_press(app, "Delete");
        }
        assert_string_equal(room_map_name(map, studio), "12 \xc3\x84rger, 3");
        assert_string_equal(room_map_name(map, !studio), "Hall, \"old\"");
        assert_int_equal(room_map_rows(map), 3);
        assert_string_equal(room_map_name(map, 2), "Zone 2");
        assert_true(fabs(room_map_area(map, 2) - 600) < 30);
        assert_int_equal(room_map_at(map, (sl_point){20, 75}), 2);
        if (run == 1) { // a plan that is opened next has its own
            viewer_open(app, MAPS "/office.map");
            settle_and_press(app, "9");
            map = room_map_shown(&app->view);
            assert_non_null(map);
            for (size_t i = 0; i < room_map_rows(map); i++) assert_false(room_map_is_zone(map, i));
        }
        viewer_end(app);
    }
    snprintf(kept, sizeof kept, "%s/sightline/rooms", config);
    FILE *stream = fopen(kept, "r");
    assert_non_null(stream);
    text[fread(text, 1, sizeof text - 1, stream)] = '\0';
    fclose(stream);
    assert_int_equal(strncmp(text, "file /", 6), 0);
    named_places rooms = {0}, zones = {0};
    sl_context *context = testing_context(NULL);
    assert_ok(context, places_recall(context, path, &rooms, &zones));
    assert_true(rooms.count == 1 && zones.count == 1);
    // Without a name and a zone nothing is kept for the file.
    rooms.count = zones.count = 0;
    places_remember(context, path, &rooms, &zones);
    assert_ok(context, places_recall(context, path, &rooms, &zones));
    assert_true(rooms.count == 0 && zones.count == 0);
    sl_free(context, rooms.items);
    sl_free(context, zones.items);
    sl_context_destroy(context);
    static const char *const files[] = {"rooms", "drawings", "recent"};
    for (size_t i = 0; i < 3; i++) {
        snprintf(kept, sizeof kept, "%s/sightline/%s", config, files[i]);
        remove(kept);
    }
    snprintf(kept, sizeof kept, "%s/sightline", config);
    assert_int_equal(rmdir(kept), 0);
    assert_int_equal(rmdir(config), 0);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rooms_have_names), cmocka_unit_test(seen_and_means),
        cmocka_unit_test(no_room_to_name),  cmocka_unit_test(zones_are_drawn),
        cmocka_unit_test(names_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
