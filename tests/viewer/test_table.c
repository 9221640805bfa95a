// The tables of the Plan mode's tools: sorted, chosen in and in the plan, written; and the parts of
// a network of lines.
#include "hand.h"

#include "plan/heat.h"
#include "plan/line_map.h"
#include "plan/route.h"
#include "plan/table.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static app_state *start(const char *text, const char *key) {
    char folder[] = "/tmp/sightline-table-XXXXXX", path[64];
    app_state *app = viewer_start(true);
    if (text) {
        assert_non_null(mkdtemp(folder));
        snprintf(path, sizeof path, "%s/a.map", folder);
        viewer_write(path, text);
    }
    viewer_open(app, text ? path : MAPS "/office.map");
    if (text) assert_int_equal(remove(path), 0);
    if (text) assert_int_equal(rmdir(folder), 0);
    press(app, "9");
    press(app, key);
    return app;
}

/// Clicks on a widget, which must be in the window.
static void click_hit(app_state *app, hit_kind kind, int value) {
    for (int i = 0; i < app->ui.hit_count; i++) {
        const hit_area *hit = &app->ui.hits[i];
        if (hit->kind != kind || hit->value != value) continue;
        click(app, (sl_point){(hit->box.min.x + hit->box.max.x) / 2, hit->box.min.y + 3});
        return;
    }
    fail_msg("no widget %d %d", kind, value);
}

static size_t find_column(const app_state *app, const char *wanted) {
    const table_source *of = app->view.table.of;
    char name[TABLE_NAME];
    for (size_t k = 0; k < of->columns(&app->view); k++) {
        of->name(&app->view, k, name);
        if (strcmp(name, wanted) == 0) return k;
    }
    fail_msg("no column %s", wanted);
    return 0;
}

/// A click on a head sorts by it, largest first; the next one turns that round; a third one undoes
/// it. All rows stay.
static void test_sorted(void **state) {
    (void)state;
    app_state *app = start(NULL, "Ctrl+5");
    press(app, "Ctrl+L");
    const table_state *t = &app->view.table;
    assert_true(t->of && t->rows == line_map_shown(&app->view)->count && t->rows > 10);
    const size_t column = find_column(app, "line_length");
    for (int turn = 0; turn < 3; turn++) {
        click_hit(app, HIT_HEAD, (int)column);
        assert_true(t->sorted == (turn < 2));
        size_t sum = 0;
        for (size_t i = 0; i < t->rows; i++) {
            const double here = t->of->value(&app->view, table_row(t, i), column);
            sum += table_row(t, i);
            if (turn == 2) assert_int_equal(table_row(t, i), i);
            if (!i || turn == 2) continue;
            const double before = t->of->value(&app->view, table_row(t, i - 1), column);
            assert_true(turn == 0 ? before >= here : before <= here);
        }
        assert_int_equal(sum, t->rows * (t->rows - 1) / 2);
    }
    viewer_end(app);
}

/// A row that is clicked is chosen in the plan; a line that is clicked is chosen in the table,
/// which scrolls to it.
static void test_chosen(void **state) {
    (void)state;
    app_state *app = start(NULL, "Ctrl+5");
    press(app, "Ctrl+L");
    const table_state *t = &app->view.table;
    click_hit(app, HIT_ROW, 3);
    assert_int_equal(t->chosen, 3);
    const line_map *map = line_map_shown(&app->view);
    assert_int_equal(map->chosen, 3);
    const uint32_t last = map->count - 1;
    const sl_segment *line = &map->lines[last];
    const sl_point at = {line->a.x + 0.02 * (line->b.x - line->a.x),
                         line->a.y + 0.02 * (line->b.y - line->a.y)};
    click_at(app, at);
    assert_int_equal(t->chosen, line_map_at(&app->view, at));
    assert_int_equal(map->chosen, t->chosen);
    bool seen = false;
    for (int i = 0; i < app->ui.hit_count; i++)
        seen |= app->ui.hits[i].kind == HIT_ROW && app->ui.hits[i].value == (int)t->chosen;
    assert_true(seen);
    // By keys: the next row, around the end.
    table_choose(&app->view, last);
    press(app, "Ctrl+PageDown");
    assert_int_equal(t->chosen, 0);
    press(app, "Ctrl+PageUp");
    assert_int_equal(t->chosen, last);
    // On free ground nothing is chosen.
    click_at(app, (sl_point){-1, -1});
    assert_true(t->chosen == SIZE_MAX && map->chosen == UINT32_MAX);
    viewer_end(app);
}

/// The graph's points are chosen by the click that puts the viewpoint. Another tool has a table of
/// its own.
static void test_tools(void **state) {
    (void)state;
    app_state *app = start(NULL, "Ctrl+2");
    const heat_graph *graph;
    press(app, "Ctrl+L");
    const table_state *t = &app->view.table;
    assert_non_null(heat_layer_values(&app->view, &graph));
    assert_int_equal(t->rows, graph->grid.count);
    click_at(app, graph->grid.points[40]);
    assert_int_equal(t->chosen, 40);
    assert_true(t->of->value(&app->view, 40, 0) == graph->grid.points[40].x);
    press(app, "Ctrl+3");
    assert_null(t->of); // no way is there yet
    click_at(app, (sl_point){20, 32});
    click_at(app, (sl_point){53, 20});
    assert_string_equal(t->of->noun, "corner");
    const sl_route *route = &app->view.route->route;
    assert_int_equal(t->rows, route->count);
    assert_true(fabs(t->of->value(&app->view, t->rows - 1, 2) - route->length) < 1e-9);
    press(app, "Ctrl+6");
    assert_string_equal(t->of->noun, "segment");
    assert_true(t->chosen == SIZE_MAX && !t->sorted);
    viewer_end(app);
}

/// Nothing is written before a name is given. The file is as the table stands.
static void test_written(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-table-XXXXXX", path[64], line[1024];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/lines.csv", folder);
    app_state *app = start(NULL, "Ctrl+5");
    press(app, "Ctrl+L");
    const table_state *t = &app->view.table;
    const size_t column = find_column(app, "line_length");
    table_sort(&app->view, column);
    press(app, "Ctrl+Shift+E");
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_BROWSER);
    assert_int_not_equal(access(path, F_OK), 0);
    press(app, "Ctrl+A");
    input_text(app, path);
    show(app);
    press(app, "Return");
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    size_t rows = 0;
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(strncmp(line, "x1,y1,x2,y2,connectivity,line_length,", 37), 0);
    for (; fgets(line, sizeof line, file); rows++) {
        double v[6];
        assert_int_equal(
            sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf", v, v + 1, v + 2, v + 3, v + 4, v + 5), 6);
        for (size_t k = 0; k < 6; k++)
            assert_true(v[k] == t->of->value(&app->view, table_row(t, rows), k));
    }
    assert_int_equal(rows, t->rows);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0);
    viewer_end(app);
}

/// Two halls that nothing joins, one with pillars and so with more lines.
static const char halls[] = "sightline 1\nunit m\nwalls 0 0 11 0 11 10 0 10 0 0\nwalls 12 0 20 0 "
                            "20 10 12 10 12 0\nwall 4 3 4 7\n"
                            "wall 7 2 7 8\nwall 14 4 18 4\nstart 1 1 0\nstart 13 1 0\n";

/// The largest part has the colours, until a line of another one is clicked.
static void test_parts(void **state) {
    (void)state;
    app_state *app = start(halls, "Ctrl+5");
    const line_map *map = line_map_shown(&app->view);
    legend_key key;
    app->view.line_measure[0] = sl_measure_find(SL_AXIAL, "line_length"); // all have one
    show(app);
    assert_true(map && map->part_count == 2 && map->part == 0);
    uint32_t sizes[2] = {0}, other = UINT32_MAX;
    for (uint32_t i = 0; i < map->count; i++) {
        const bool right = map->lines[i].a.x > 11.5;
        assert_int_equal(right, map->parts[i]);
        sizes[map->parts[i]]++;
        if (right) other = i;
    }
    assert_true(sizes[0] > sizes[1] && sizes[1] > 0);
    assert_int_equal(map->within, sizes[0]);
    assert_int_equal(map->scale.count, sizes[0]);
    assert_true(line_map_key(&app->view, &key));
    assert_non_null(strstr(key.rows[key.count - 1].label, "grey"));
    assert_int_equal(atoi(key.rows[key.count - 1].text), (int)sizes[1]);
    table_update(&app->view);
    table_choose(&app->view, other);
    show(app);
    assert_int_equal(map->part, 1);
    assert_int_equal(map->within, sizes[1]);
    viewer_end(app);
}

/// A measure is chosen by its row in the panel or by a key. Drawn lines are the walls.
static void test_measures(void **state) {
    (void)state;
    app_state *app = start(halls, "Ctrl+5");
    const line_map *map = line_map_shown(&app->view);
    const size_t length = sl_measure_find(SL_AXIAL, "line_length");
    click_hit(app, HIT_MEASURE, (int)length);
    assert_int_equal(map->measure, length);
    double most = 0;
    for (uint32_t i = 0; i < map->count; i++)
        if (!map->parts[i])
            most = fmax(most, hypot(map->lines[i].b.x - map->lines[i].a.x,
                                    map->lines[i].b.y - map->lines[i].a.y));
    assert_true(fabs(map->scale.most - most) <= 1e-12 * most);
    press(app, "2");
    assert_int_equal(map->measure, length + 1);
    press(app, "3");
    press(app, "3");
    assert_int_equal(map->measure, length - 1);
    action_run(app, action_find("plan_drawn"));
    show(app);
    map = line_map_shown(&app->view);
    assert_int_equal(map->count, app->document.map.wall_count);
    action_run(app, action_find("plan_drawn"));
    show(app);
    assert_true(line_map_shown(&app->view)->count != app->document.map.wall_count);
    viewer_end(app);
}

/// Work that is stopped begins anew when the tool is chosen once more.
static void test_stopped(void **state) {
    (void)state;
    app_state *app = viewer_start(false);
    viewer_open(app, MAPS "/office.map");
    press(app, "9");
    viewer_press(app, "Ctrl+5");
    app_tick(app, 0);
    viewer_press(app, "Escape");
    assert_non_null(strstr(app->ui.message, "stopped"));
    show(app);
    assert_null(line_map_shown(&app->view));
    viewer_press(app, "Ctrl+5");
    app_settle(app);
    assert_non_null(line_map_shown(&app->view));
    viewer_end(app);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sorted),  cmocka_unit_test(test_chosen),
        cmocka_unit_test(test_tools),   cmocka_unit_test(test_written),
        cmocka_unit_test(test_parts),   cmocka_unit_test(test_measures),
        cmocka_unit_test(test_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
