// Another plan over the open one: walls that one of them has alone, and what measures change.
#include "hand.h"

#include "plan/compare.h"
#include "plan/heat.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

// --- walls, against points of a grid

enum { PARTS = 64 };

/// Twice PARTS times as large, so that the middles of parts are whole numbers too.
static bool covers(const sl_segment *s, long long x, long long y) {
    const long long k = 2 * PARTS;
    const long long ax = k * (long long)s->a.x, ay = k * (long long)s->a.y;
    const long long bx = k * (long long)s->b.x, by = k * (long long)s->b.y;
    const bool in_x = x >= (ax < bx ? ax : bx) && x <= (ax < bx ? bx : ax);
    const bool in_y = y >= (ay < by ? ay : by) && y <= (ay < by ? by : ay);
    return in_x && in_y && (bx - ax) * (y - ay) == (by - ay) * (x - ax);
}

static bool any_covers(const wall_list *walls, long long x, long long y) {
    bool any = false;
    for (size_t i = 0; i < walls->count; i++) any |= covers(&walls->items[i], x, y);
    return any;
}

static wall_list random_walls(sl_context *context, sl_random *random) {
    wall_list walls = {0};
    for (int i = 0; i < 14; i++) {
        double c[4];
        for (int k = 0; k < 4; k++) c[k] = (double)sl_random_below(random, 4);
        assert_int_equal(SL_ARRAY_ROOM(context, &walls, 1), SL_OK);
        walls.items[walls.count++] = (sl_segment){{c[0], c[1]}, {c[2], c[3]}};
    }
    return walls;
}

/// Of each point of a wall: it is in the result if and only if no other wall covers it.
static void test_walls(void **state) {
    (void)state;
    sl_context *context = sl_context_create(NULL);
    const int seeds = (int)testing_seeds(300);
    for (int seed = 1; seed <= seeds; seed++) {
        sl_random random = {(uint64_t)seed};
        wall_list one = random_walls(context, &random), other = random_walls(context, &random);
        wall_list alone = {0};
        assert_int_equal(wall_change_add(context, &one, &other, &alone), SL_OK);
        for (size_t i = 0; i < one.count; i++)
            for (int k = 0; k < PARTS; k++) {
                const sl_segment *s = &one.items[i];
                const long long x = 2 * PARTS * (long long)s->a.x +
                                    (2 * k + 1) * ((long long)s->b.x - (long long)s->a.x);
                const long long y = 2 * PARTS * (long long)s->a.y +
                                    (2 * k + 1) * ((long long)s->b.y - (long long)s->a.y);
                if (s->a.x == s->b.x && s->a.y == s->b.y) continue;
                assert_int_equal(any_covers(&alone, x, y), !any_covers(&other, x, y));
            }
        for (size_t i = 0; i < alone.count; i++) {
            const sl_segment *s = &alone.items[i];
            assert_true(s->a.x != s->b.x || s->a.y != s->b.y);
        }
        sl_free(context, one.items);
        sl_free(context, other.items);
        sl_free(context, alone.items);
    }
    sl_context_destroy(context);
}

// --- the tool

static const char now[] = "sightline 1\nunit m\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 2 10 8\n"
                          "start 1 1 0\n";
/// Half of the inner wall is gone, and another one is there.
static const char later[] = "sightline 1\nunit m\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 2 10 5\n"
                            "wall 4 6 8 6\nstart 1 1 0\n";

static void choose(app_state *app, const char *path) {
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_BROWSER);
    press(app, "Ctrl+A");
    input_text(app, path);
    press(app, "Return");
    show(app);
}

static app_state *start(const char *path) {
    app_state *app = viewer_start(true);
    viewer_open(app, path);
    press(app, "9");
    return app;
}

static void test_compare(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-compare-XXXXXX", paths[4][64];
    static const char *const names[] = {"now", "later", "broken", "feet"};
    const char *const texts[] = {now, later, "sightline 1\nwall 0 0 1\n",
                                 "sightline 1\nunit ft\nwalls 0 0 9 0 9 9 0 9 0 0\nstart 1 1 0\n"};
    assert_non_null(mkdtemp(folder));
    for (int i = 0; i < 4; i++) {
        snprintf(paths[i], sizeof paths[i], "%s/%s.map", folder, names[i]);
        viewer_write(paths[i], texts[i]);
    }
    app_state *app = start(paths[0]), *other = start(paths[1]);
    press(app, "Ctrl+7");
    choose(app, paths[1]);
    const plan_compare *c = compare_shown(&app->view);
    assert_true(c && c->job.made);
    assert_true(c->area == 200 && app->document.area == 200);
    assert_int_equal(c->added.count, 1);
    assert_true(c->added.items[0].a.x == 4 && c->added.items[0].b.x == 8);
    assert_int_equal(c->removed.count, 1);
    assert_true(c->removed.items[0].a.y == 5 && c->removed.items[0].b.y == 8);
    // Changes of a measure, beside the values of both plans.
    const heat_graph *graph, *of_other;
    legend_key key;
    press(app, "1");
    press(other, "1");
    for (int turn = 0; turn < 3; turn++) {
        const double *changes = heat_layer_values(&app->view, &graph);
        const double *values = heat_layer_values(&other->view, &of_other);
        size_t both = 0, moved = 0;
        double most = 0;
        assert_true(changes && values);
        const sl_measure *measure = heat_measure(app->view.heat_choice.measure);
        for (uint32_t p = 0; p < graph->grid.count; p++) {
            const uint32_t q = heat_graph_square(of_other, graph->grid.points[p]);
            const double here = sl_measure_value(measure, &graph->measures[p]);
            const double change = q == UINT32_MAX ? NAN : values[q] - here;
            assert_true(isnan(change) ? isnan(changes[p]) : changes[p] == change);
            if (isnan(change)) continue;
            both++;
            moved += change != 0;
            most = fmax(most, fabs(change));
        }
        double least, greatest;
        heat_layer_scale(&app->view, &least, &greatest);
        if (both < 500 || moved < 50) fail_msg("only %zu points, %zu changed", both, moved);
        assert_true(least == -most && greatest == most);
        assert_true(heat_layer_key(&app->view, &key));
        assert_int_equal(strncmp(key.rows[0].label, "change of ", 10), 0);
        press(app, "2");
        press(other, "2");
    }
    // Another tool shows the values again.
    press(app, "Ctrl+1");
    assert_true(heat_layer_key(&app->view, &key));
    assert_null(strstr(key.rows[0].label, "change"));
    // What cannot be compared is said, and nothing stays.
    for (int i = 2; i < 4; i++) {
        action_run(app, action_find("plan_other"));
        script_frame(app);
        choose(app, paths[i]);
        assert_true(app->ui.message_is_error);
        assert_non_null(
            strstr(app->ui.message, i == 2 ? "broken.map:2:" : "its lengths are in ft"));
        assert_null(compare_shown(&app->view));
    }
    viewer_end(app);
    viewer_end(other);
    for (int i = 0; i < 4; i++) assert_int_equal(remove(paths[i]), 0);
    assert_int_equal(rmdir(folder), 0);
}

/// Of a building one storey is compared, which is asked for.
static void test_storey(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-compare-XXXXXX", paths[3][64];
    static const char *const names[] = {"now.map", "later.map", "house.storeys"};
    const char *const texts[] = {now, later,
                                 "storeys 1\nstorey ground now.map\nstorey first later.map\n"
                                 "link stair ground 1,1 first 1,1\n"};
    assert_non_null(mkdtemp(folder));
    for (int i = 0; i < 3; i++) {
        snprintf(paths[i], sizeof paths[i], "%s/%s", folder, names[i]);
        viewer_write(paths[i], texts[i]);
    }
    app_state *app = start(paths[0]);
    press(app, "Ctrl+7");
    choose(app, paths[2]);
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_IMPORT);
    press(app, "Down"); // behind the one that is open
    press(app, "Return");
    const plan_compare *c = compare_shown(&app->view);
    assert_true(c && c->job.made);
    assert_string_equal(c->source.path, paths[1]);
    assert_int_equal(c->added.count, 1);
    assert_string_equal(app->document.source.path, paths[0]);
    viewer_end(app);
    for (int i = 0; i < 3; i++) assert_int_equal(remove(paths[i]), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walls),
        cmocka_unit_test(test_compare),
        cmocka_unit_test(test_storey),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
