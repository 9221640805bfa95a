// Dragging walls through a map by a world: at each step the eye sees what it sees in a fresh bake
// of the map as it is then, and after the drag the window shows what a fresh start shows.
#include "viewer_app.h"

#include "app/frame.h"
#include "plan/drag_world.h"
#include "sightline/bake.h"
#include "sightline/generate.h"

#include <math.h>
#include <string.h>

static void press(app_state *app, const char *key) {
    viewer_press(app, key);
    app_settle(app);
    script_frame(app);
}

/// Opens a map to draw in; worlds serve it whatever its size.
static app_state *start(const char *path) {
    app_state *app = viewer_start(true);
    app->view.world_walls = 0;
    viewer_open(app, path);
    press(app, "F3");
    return app;
}

static void write_city(const char *path, double turned) {
    sl_context *context = sl_context_create(NULL);
    sl_generate_options options = sl_generate_options_default();
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_map map = {0};
    options.walls = 300;
    options.turned = turned;
    const sl_map_kind *kind = NULL;
    for (size_t i = 0; i < count; i++)
        if (!strcmp(kinds[i].name, "city")) kind = &kinds[i];
    assert_non_null(kind);
    assert_int_equal(sl_generate(context, kind, &options, &map), SL_OK);
    assert_int_equal(sl_map_write(context, &map, NULL, path), SL_OK);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

// --- against a fresh bake

static sl_point random_place(sl_random *random, const sl_box *b) {
    return (sl_point){b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                      b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
}

/// Sightlines between places by chance, and the region of the eye where it is indoors.
static void assert_same_sight(app_state *app, sl_random *random, bool indoors) {
    sl_query *query = drag_world_query(&app->view), *fresh_query = NULL;
    assert_non_null(query);
    sl_context *context = sl_context_create(NULL);
    sl_map map = {0};
    sl_baked fresh = {0};
    sl_region region = {0};
    assert_int_equal(sl_map_copy(context, &app->document.map, &map), SL_OK);
    assert_int_equal(sl_bake(context, &map, NULL, &fresh, NULL), SL_OK);
    assert_int_equal(sl_query_create(context, &fresh, &fresh_query), SL_OK);
    const sl_box bounds = fresh.space.bounds;
    for (int i = 0; i < 300; i++) {
        const sl_point a = i % 3 ? random_place(random, &bounds) : app->view.eye.at;
        const sl_point b = random_place(random, &bounds);
        bool now = false, then = false;
        assert_int_equal(sl_query_sees(context, query, a, b, &now), SL_OK);
        assert_int_equal(sl_query_sees(context, fresh_query, a, b, &then), SL_OK);
        if (now != then)
            fail_msg("%.17g,%.17g to %.17g,%.17g: %d, and %d by a bake", a.x, a.y, b.x, b.y, now,
                     then);
    }
    const seen_state *seen = &app->view.seen;
    assert_true(seen->valid);
    assert_int_equal(sl_query_region(context, fresh_query, &seen->view, &region), SL_OK);
    const double area = sl_region_area(&region);
    sl_mirrored_region mirrored = {0};
    if (indoors && map.mirror_count) {
        assert_int_equal(sl_query_mirrored_region_to(context, fresh_query, &seen->view,
                                                     app->document.mirror_depth, &mirrored),
                         SL_OK);
        const double by_mirror = sl_mirrored_area(&mirrored);
        if (fabs(by_mirror - seen->mirrored_area) > 1e-9 * area)
            fail_msg("mirrors show %.17g, by a bake %.17g", seen->mirrored_area, by_mirror);
        sl_mirrored_region_destroy(context, &mirrored);
    }
    if (indoors && fabs(area - seen->region_area) > 1e-9 * area)
        fail_msg("the region has %.17g, by a bake %.17g", seen->region_area, area);
    sl_region_destroy(context, &region);
    sl_query_destroy(context, fresh_query);
    sl_baked_destroy(context, &fresh);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// The plan as it is drawn. The caller's.
static cairo_surface_t *draw(app_state *app) {
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, app->ui.width, app->ui.height);
    for (int i = 0; i < 2; i++) {
        cairo_t *cairo = cairo_create(surface);
        app_draw(app, cairo);
        cairo_destroy(cairo);
    }
    cairo_surface_flush(surface);
    return surface;
}

/// Saves the map, opens it in another viewer, and compares their plans, pixel by pixel.
static void assert_same_picture(app_state *app) {
    static const char path[] = "dragged.map";
    assert_int_equal(sl_map_write(app->context, &app->document.map, NULL, path), SL_OK);
    app_state *other = start(path);
    input_move(app, (sl_point){-1, -1});
    input_move(other, (sl_point){-1, -1});
    other->view.fitted = app->view.fitted = false;
    other->view.camera = app->view.camera;
    other->view.eye = app->view.eye;
    app_settle(other);
    app_settle(app);
    const sl_box plan = app_layout(app).plan[0];
    cairo_surface_t *a = draw(app), *b = draw(other);
    const int stride = cairo_image_surface_get_stride(a);
    for (int y = (int)ceil(plan.min.y); y < (int)plan.max.y; y++)
        for (int x = (int)ceil(plan.min.x); x < (int)plan.max.x; x++) {
            const size_t at = (size_t)y * (size_t)stride + 4 * (size_t)x;
            if (memcmp(cairo_image_surface_get_data(a) + at, cairo_image_surface_get_data(b) + at,
                       3) != 0)
                fail_msg("pixel %d,%d differs", x, y);
        }
    cairo_surface_destroy(a);
    cairo_surface_destroy(b);
    viewer_end(other);
    remove(path);
}

// --- drags

/// Drags by some pixels in steps, with the button down at the end. Returns the steps by a world.
static int drag(app_state *app, sl_random *random, sl_point from, double dx, double dy,
                bool indoors) {
    const sl_point at = viewer_on_page(app, from);
    int steps = 0;
    input_press(app, BUTTON_LEFT, at);
    for (int i = 1; i <= 4; i++) {
        input_move(app, (sl_point){at.x + dx * i / 4, at.y + dy * i / 4});
        app_tick(app, 1.0 / 60);
        script_frame(app);
        if (!app->view.drag.changed || !app->view.drag_world) continue;
        assert_false(view_is_late(&app->view));
        assert_same_sight(app, random, indoors);
        steps++;
    }
    return steps;
}

static void drop(app_state *app) {
    input_release(app, app->ui.pointer);
    app_settle(app);
    assert_null(app->view.drag_world);
    assert_false(view_is_late(&app->view));
    assert_true(app->document.has_visibility);
}

/// A wall whose middle can be taken, away from the border of the map.
static sl_wall inner_wall(const app_state *app, sl_random *random) {
    const sl_map *map = &app->document.map;
    const sl_box b = app->document.baked->space.bounds;
    const double margin = (b.max.x - b.min.x) / 8;
    for (;;) {
        const sl_wall w = map->walls[sl_random_below(random, map->wall_count)];
        const sl_point m = {(w.a.x + w.b.x) / 2, (w.a.y + w.b.y) / 2};
        if (m.x > b.min.x + margin && m.x < b.max.x - margin && m.y > b.min.y + margin &&
            m.y < b.max.y - margin)
            return w;
    }
}

/// Walls and corners of cities that are axial, turned, and turned by next to nothing.
static void test_walls(void **state) {
    (void)state;
    static const double turned[] = {0, 17.3, 0.001};
    for (int k = 0; k < 3; k++) {
        write_city("city.map", turned[k]);
        app_state *app = start("city.map");
        sl_random random = {(uint64_t)k + 1};
        int steps = 0;
        for (int i = 0; i < 6; i++) {
            const sl_wall w = inner_wall(app, &random);
            const sl_point from =
                i % 2 ? w.a : (sl_point){(w.a.x + w.b.x) / 2, (w.a.y + w.b.y) / 2};
            // Eyes at the dragged wall, and elsewhere.
            if (i > 3) app->view.eye.at = (sl_point){w.a.x + 0.3, w.a.y + 0.4};
            steps += drag(app, &random, from, 60 * (sl_random_unit(&random) - 0.5),
                          60 * (sl_random_unit(&random) - 0.5), false);
            drop(app);
        }
        assert_true(steps > 6);
        assert_same_picture(app);
        viewer_end(app);
        remove("city.map");
    }
}

static const char rooms[] = "sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 2 10 8\n"
                            "door low 10 0 10 2 open\ndoor high 10 8 10 10 shut\nstart 3 3 0\n";

/// Indoors the region is that of the bake: a wall over another, along it, out of the plan and back;
/// a door that is shut; a wall that is drawn; and one that is taken back.
static void test_rooms(void **state) {
    (void)state;
    sl_random random = {7};
    viewer_write("rooms.map", rooms);
    app_state *app = start("rooms.map");
    const double unit = app->view.camera.scale;
    app->view.eye.fov = 360;
    assert_true(drag(app, &random, (sl_point){10, 5}, 4 * unit, 0, true) == 4);
    assert_null(app->document.job); // no cells are made before the drag ends
    drop(app);
    assert_true(drag(app, &random, (sl_point){10, 9}, -3 * unit, 0, true) > 0);
    drop(app);
    assert_false(app->document.map.doors[1].open);
    const size_t walls = app->document.map.wall_count;
    assert_true(drag(app, &random, (sl_point){4, 6}, 5 * unit, 2 * unit, true) > 0);
    drop(app);
    assert_int_equal(app->document.map.wall_count, walls + 1);
    assert_same_picture(app);
    sl_point was = app->document.map.walls[walls].a;
    assert_true(drag(app, &random, was, 2 * unit, -unit, true) > 0);
    press(app, "Escape");
    assert_null(app->view.drag_world);
    assert_memory_equal(&was, &app->document.map.walls[walls].a, sizeof was);
    assert_same_picture(app);
    viewer_end(app);
    remove("rooms.map");
}

/// A door that is shut during a drag: cells are made anew from then on, to its end.
static void test_touched(void **state) {
    (void)state;
    sl_random random = {6};
    viewer_write("rooms.map", rooms);
    app_state *app = start("rooms.map");
    const double unit = app->view.camera.scale;
    assert_true(drag(app, &random, (sl_point){10, 5}, 2 * unit, 0, true) > 0);
    press(app, "N");
    assert_null(app->view.drag_world);
    assert_true(app->document.live);
    drop(app);
    assert_false(app->document.map.doors[0].open);
    viewer_end(app);
    remove("rooms.map");
}

/// A place that is beyond the world's bounds is one for a bake, to the end of the drag.
static void test_far(void **state) {
    (void)state;
    sl_random random = {8};
    viewer_write("rooms.map", rooms);
    app_state *app = start("rooms.map");
    const double unit = app->view.camera.scale;
    const int steps = drag(app, &random, (sl_point){10, 5}, 0, -30 * unit, true);
    assert_true(steps < 4);
    assert_null(app->view.drag_world);
    assert_true(app->document.live);
    drop(app);
    assert_same_picture(app);
    viewer_end(app);
    remove("rooms.map");
}

/// Mirrors, glass, walls that limit sight or do not stop it: they stand beside the wall that is
/// dragged, and then they are dragged themselves by a corner that they share with a wall.
static void test_effects(void **state) {
    (void)state;
    static const char *const more[] = {
        "mirror 2 2 2 8\n", "oneway 6 2 6 8\n", "wall 6 2 6 8 stops steps\n",
        "wall 6 2 6 4 stops limited\nwall 7 3 7 9 stops limited\n", "seam 0 5 10 5\n"};
    static const char *const at_corner[] = {"mirror 14 4 16 6\n", "oneway 14 4 16 6\n",
                                            "wall 14 4 16 6 stops steps\n",
                                            "wall 14 4 16 6 stops limited\n", "seam 14 4 16 6\n"};
    sl_random random = {9};
    for (int i = 0; i < 5; i++) {
        char text[512];
        snprintf(text, sizeof text, "%s%s%swall 14 2 14 4\n", rooms, more[i], at_corner[i]);
        viewer_write("rooms.map", text);
        app_state *app = start("rooms.map");
        const double unit = app->view.camera.scale;
        app->view.eye.fov = 360;
        assert_int_equal(drag(app, &random, (sl_point){10, 5}, 3 * unit, 0, true), 4);
        assert_false(app->document.live);
        drop(app);
        assert_same_picture(app);
        app->view.eye.at = (sl_point){17, 2};
        // A mirror itself is dragged by bakes.
        assert_int_equal(drag(app, &random, (sl_point){14, 4}, unit, unit, true), i ? 4 : 0);
        drop(app);
        assert_same_picture(app);
        viewer_end(app);
    }
    remove("rooms.map");
}

/// A small map is baked at each step.
static void test_small(void **state) {
    (void)state;
    sl_random random = {9};
    viewer_write("rooms.map", rooms);
    app_state *app = start("rooms.map");
    app->view.world_walls = 2000;
    assert_int_equal(drag(app, &random, (sl_point){10, 5}, 3 * app->view.camera.scale, 0, true), 0);
    assert_true(app->document.live);
    drop(app);
    viewer_end(app);
    remove("rooms.map");
}

/// A drag that ends, is taken back, or whose window closes before the world is made.
static void test_hasty(void **state) {
    (void)state;
    write_city("city.map", 17.3);
    for (int i = 0; i < 3; i++) {
        app_state *app = start("city.map");
        sl_random random = {4};
        const sl_wall w = inner_wall(app, &random);
        const sl_point at =
            viewer_on_page(app, (sl_point){(w.a.x + w.b.x) / 2, (w.a.y + w.b.y) / 2});
        app->ui.steady = false;
        input_press(app, BUTTON_LEFT, at);
        input_move(app, (sl_point){at.x + 30, at.y + 20});
        if (i == 1) viewer_press(app, "Escape");
        if (i == 0) {
            input_release(app, app->ui.pointer);
            app_settle(app);
            assert_null(app->view.drag_world);
            app->ui.steady = true;
            assert_same_picture(app);
        }
        viewer_end(app);
    }
    remove("city.map");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_walls), cmocka_unit_test(test_rooms), cmocka_unit_test(test_touched),
        cmocka_unit_test(test_far),   cmocka_unit_test(test_small), cmocka_unit_test(test_effects),
        cmocka_unit_test(test_hasty),
    };
    return cmocka_run_group_tests(tests, viewer_enter_folder, viewer_leave_folder);
}
