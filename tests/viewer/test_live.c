// Dragging walls, corners and doors: at each step the viewer has the cells, the region and the
// culling of a fresh bake of the map as it is then. Jobs end when they are told to.
#include "viewer_app.h"

#include "app/turn.h"
#include "dialogs/opening.h"
#include "plan/grid.h"
#include "sightline/bake.h"
#include "sightline/generate.h"

#include <dirent.h>
#include <math.h>
#include <time.h>
#include <unistd.h>

// --- the viewer

/// Lets time pass until the background has nothing left to do.
static void wait_for_all(app_state *app) {
    for (int i = 0; i < 60000 && (app->document.job || app->document.stale); i++) {
        const struct timespec pause = {0, 1000000};
        nanosleep(&pause, NULL);
        app_tick(app, 0.001);
    }
    assert_null(app->document.job);
    assert_false(app->document.stale);
}

static void open_map(app_state *app, const char *path) {
    viewer_open(app, path);
    viewer_press(app, "F3");
    script_frame(app);
}

// --- against a fresh bake

static void assert_same_space(const sl_space *a, const sl_space *b) {
    assert_int_equal(a->cell_count, b->cell_count);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->portal_count, b->portal_count);
    assert_int_equal(a->directed_count, b->directed_count);
    assert_int_equal(a->wall_count, b->wall_count);
    assert_int_equal(a->inside_count, b->inside_count);
    for (uint32_t i = 0; i < a->cell_count; i++) {
        assert_int_equal(a->cells[i].vertex_count, b->cells[i].vertex_count);
        assert_int_equal(a->cells[i].inside, b->cells[i].inside);
        assert_int_equal(a->cells[i].solid, b->cells[i].solid);
    }
    assert_memory_equal(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices);
    assert_memory_equal(a->directed, b->directed, a->directed_count * sizeof *a->directed);
    for (uint32_t i = 0; i < a->wall_count; i++)
        assert_memory_equal(&a->walls[i], &b->walls[i], 2 * sizeof(sl_point));
}

/// What the eye sees, by the exact method and as a region, with the doors as they are.
static void assert_same_sight(app_state *app, sl_context *context, const sl_baked *fresh) {
    const seen_state *seen = &app->view.seen;
    size_t count;
    sl_eye_methods(&count);
    if (!seen->valid) return;
    sl_bits *cells = calloc(sl_eye_words(&fresh->space), sizeof *cells);
    sl_query *query = NULL;
    sl_region region = {0};
    assert_non_null(cells);
    assert_int_equal(sl_query_create(context, fresh, &query), SL_OK);
    assert_int_equal(sl_query_look(context, query, &seen->view, NULL, cells, NULL), SL_OK);
    assert_memory_equal(cells, seen->methods[count - 1].cells,
                        sl_eye_words(&fresh->space) * sizeof *cells);
    assert_int_equal(sl_query_region(context, query, &seen->view, &region), SL_OK);
    assert_true(sl_region_area(&region) == seen->region_area);
    sl_region_destroy(context, &region);
    sl_query_destroy(context, query);
    free(cells);
}

static void assert_fresh(app_state *app, bool whole) {
    if (document_is_late(&app->document)) fail_msg("late: %s", app->ui.message);
    sl_context *context = sl_context_create(NULL);
    sl_map map = {0};
    sl_baked fresh = {0};
    assert_int_equal(sl_map_copy(context, &app->document.map, &map), SL_OK);
    assert_int_equal(sl_bake(context, &map, NULL, &fresh, NULL), SL_OK);
    sl_map_destroy(context, &map);
    assert_same_space(&app->document.baked->space, &fresh.space);
    assert_same_sight(app, context, &fresh);
    assert_int_equal(app->document.has_visibility, whole);
    if (whole) {
        const sl_pvs *a = &app->document.baked->visibility.pvs, *b = &fresh.visibility.pvs;
        const size_t cells = fresh.space.cell_count;
        assert_int_equal(a->cell_count, cells);
        assert_memory_equal(a->offsets, b->offsets, (cells + 1) * sizeof *a->offsets);
        assert_memory_equal(a->bytes, b->bytes, a->offsets[cells]);
    }
    sl_baked_destroy(context, &fresh);
    sl_context_destroy(context);
}

// --- drags

/// Drags from a place of the map by some pixels in steps. Returns how many steps changed the map.
static int drag(app_state *app, sl_point from, double dx, double dy, bool release) {
    const sl_point at = viewer_on_page(app, from);
    uint32_t edit = app->document.edit;
    int changes = 0;
    input_press(app, BUTTON_LEFT, at);
    for (int i = 1; i <= 5; i++) {
        input_move(app, (sl_point){at.x + dx * i / 5, at.y + dy * i / 5});
        app_tick(app, 1.0 / 60);
        if (app->document.edit == edit) continue;
        edit = app->document.edit;
        changes++;
        if (app->ui.steady) {
            assert_fresh(app, false);
            script_frame(app);
        }
    }
    if (!release) return changes;
    input_release(app, app->ui.pointer);
    if (app->ui.steady)
        app_settle(app);
    else
        wait_for_all(app);
    assert_fresh(app, true);
    return changes;
}

static sl_point middle(sl_point a, sl_point b) {
    return (sl_point){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/// Drags the middles of some walls, and some corners.
static void drag_much(app_state *app, uint64_t seed) {
    sl_random random = {seed};
    int changes = 0;
    for (int i = 0; i < 8; i++) {
        const sl_map *map = &app->document.map;
        const sl_wall *wall = &map->walls[sl_random_below(&random, map->wall_count)];
        const sl_point from = i % 2 ? wall->a : middle(wall->a, wall->b);
        changes += drag(app, from, 50 * (sl_random_unit(&random) - 0.5),
                        50 * (sl_random_unit(&random) - 0.5), true);
    }
    assert_true(changes > 4);
}

static const char *const maps[] = {
    "office.map",          "maze.map",           "dungeon.txt",
    "oblique/rotunda.map", "oblique/chapel.map", "effects/doors.map",
    "effects/mirrors.map", "effects/oneway.map", "effects/objects.map"};

static void test_maps(void **state) {
    (void)state;
    for (size_t i = 0; i < 2 * sizeof maps / sizeof *maps; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", MAPS, maps[i / 2]);
        app_state *app = viewer_start(i % 2 == 0);
        open_map(app, path);
        drag_much(app, i);
        viewer_end(app);
    }
}

/// Writes a map that is turned, so that walls in line are so but for rounding.
static void write_turned(const char *path, double angle, uint64_t walls) {
    sl_context *context = sl_context_create(NULL);
    size_t count;
    sl_generate_options options = sl_generate_options_default();
    options.walls = walls;
    options.turned = angle;
    sl_map map = {0};
    const sl_map_kind *kind = sl_map_kinds(&count);
    assert_int_equal(sl_generate(context, kind, &options, &map), SL_OK);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("sightline 1\n", file);
    for (size_t i = 0; i < map.wall_count; i++)
        fprintf(file, "wall %.17g %.17g %.17g %.17g\n", map.walls[i].a.x, map.walls[i].a.y,
                map.walls[i].b.x, map.walls[i].b.y);
    for (size_t i = 0; i < map.start_count; i++)
        fprintf(file, "start %.17g %.17g 0\n", map.starts[i].at.x, map.starts[i].at.y);
    assert_int_equal(fclose(file), 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_turned(void **state) {
    (void)state;
    static const double angles[] = {30, 45, 0.001};
    for (int i = 0; i < 3; i++) {
        write_turned("turned.map", angles[i], 300);
        app_state *app = viewer_start(true);
        open_map(app, "turned.map");
        drag_much(app, 100 + (uint64_t)i);
        viewer_end(app);
    }
    remove("turned.map");
}

// --- corners and doors

static size_t ends_at(const sl_map *map, sl_point at) {
    size_t count = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        count += map->walls[i].a.x == at.x && map->walls[i].a.y == at.y;
        count += map->walls[i].b.x == at.x && map->walls[i].b.y == at.y;
    }
    return count;
}

static void test_corner(void **state) {
    (void)state;
    app_state *app = viewer_start(true);
    open_map(app, MAPS "/oblique/chapel.map");
    const sl_map *map = &app->document.map;
    sl_point corner = map->walls[0].a;
    for (size_t i = 0; i < map->wall_count && ends_at(map, corner) < 2; i++)
        corner = map->walls[i].a;
    const size_t ends = ends_at(map, corner), walls = map->wall_count;
    assert_true(ends >= 2);
    assert_true(drag(app, corner, 25, 10, true) > 0);
    assert_int_equal(map->wall_count, walls);
    assert_int_equal(ends_at(map, corner), 0);
    viewer_press(app, "Ctrl+Z");
    app_settle(app);
    assert_int_equal(ends_at(&app->document.map, corner), ends);
    assert_fresh(app, true);
    viewer_end(app);
}

static void test_door(void **state) {
    (void)state;
    for (int steady = 0; steady < 2; steady++) {
        app_state *app = viewer_start(steady);
        open_map(app, MAPS "/effects/doors.map");
        const sl_segment door = app->document.map.doors[0].segment;
        const size_t walls = app->document.map.wall_count;
        const sl_wall first = app->document.map.walls[0];
        assert_true(drag(app, middle(door.a, door.b), 30, 40, true) > 0);
        const sl_segment now = app->document.map.doors[0].segment;
        assert_true(now.a.x != door.a.x || now.a.y != door.a.y);
        assert_true(now.b.x - now.a.x == door.b.x - door.a.x);
        assert_true(now.b.y - now.a.y == door.b.y - door.a.y);
        assert_int_equal(app->document.map.wall_count, walls);
        assert_memory_equal(&app->document.map.walls[0], &first, sizeof first);
        viewer_end(app);
    }
}

static double length_of(sl_point a, sl_point b) {
    return hypot(b.x - a.x, b.y - a.y);
}

/// A door that is drawn along a wall cuts it: what is left of the wall ends at the door.
static void test_new_door(void **state) {
    (void)state;
    static const char *const names[] = {MAPS "/flat.map", MAPS "/oblique/chapel.map"};
    for (int i = 0; i < 4; i++) {
        app_state *app = viewer_start(i % 2);
        open_map(app, names[i / 2]);
        viewer_press(app, "X");
        const sl_map *map = &app->document.map;
        const size_t walls = map->wall_count, doors = map->door_count;
        sl_wall wall = map->walls[0];
        for (size_t k = 0; k < walls; k++)
            if (length_of(map->walls[k].a, map->walls[k].b) > length_of(wall.a, wall.b))
                wall = map->walls[k];
        const sl_point from = middle(wall.a, wall.b);
        const sl_point low = viewer_on_page(app, from), high = viewer_on_page(app, wall.b);
        assert_true(drag(app, from, 0.5 * (high.x - low.x) + 2, 0.5 * (high.y - low.y) - 2, true));
        assert_int_equal(map->door_count, doors + 1);
        const sl_segment door = map->doors[doors].segment;
        assert_int_equal(map->wall_count, walls + 1);
        const sl_wall *parts = &map->walls[walls - 1];
        assert_string_equal(map->doors[doors].name, "door1");
        assert_true(length_of(door.a, door.b) > 0.1 * length_of(wall.a, wall.b));
        assert_memory_equal(&parts[0].a, &wall.a, sizeof wall.a);
        assert_memory_equal(&parts[0].b, &door.a, sizeof door.a);
        assert_memory_equal(&parts[1].a, &door.b, sizeof door.b);
        assert_memory_equal(&parts[1].b, &wall.b, sizeof wall.b);
        assert_true(wall.a.x != wall.b.x || (door.a.x == wall.a.x && door.b.x == wall.a.x));
        assert_true(wall.a.y != wall.b.y || (door.a.y == wall.a.y && door.b.y == wall.a.y));
        viewer_press(app, "Ctrl+Z");
        wait_for_all(app);
        assert_int_equal(app->document.map.door_count, doors);
        assert_int_equal(app->document.map.wall_count, walls);
        assert_fresh(app, true);
        viewer_end(app);
    }
}

/// Elsewhere a new door lies on the grid. A click chooses it, and it can be deleted.
static void test_door_in_the_open(void **state) {
    (void)state;
    app_state *app = viewer_start(true);
    open_map(app, MAPS "/flat.map");
    viewer_press(app, "X");
    const sl_map *map = &app->document.map;
    const size_t walls = map->wall_count, doors = map->door_count;
    sl_point free_place = {0, 0};
    for (uint32_t cell = 0; cell < app->document.baked->space.cell_count; cell++) {
        const sl_cell *c = &app->document.baked->space.cells[cell];
        const sl_point *p = app->document.baked->space.vertices + c->first_vertex;
        if (c->inside && app->document.areas[cell] > 5) free_place = middle(p[0], p[2]);
    }
    assert_true(drag(app, free_place, 30, 0, true) > 0);
    assert_int_equal(map->door_count, doors + 1);
    assert_int_equal(map->wall_count, walls);
    const sl_segment door = map->doors[doors].segment;
    assert_true(grid_snap(&app->view, door.a).x == door.a.x &&
                grid_snap(&app->view, door.b).y == door.b.y);
    drag(app, middle(door.a, door.b), 0, 0, true);
    viewer_press(app, "Delete");
    app_settle(app);
    assert_int_equal(map->door_count, doors);
    viewer_press(app, "X");
    assert_true(drag(app, free_place, 30, 0, true) > 0);
    assert_int_equal(map->wall_count, walls + 1);
    viewer_end(app);
}

/// While the pointer stays at its place of the grid, a new door makes no new space.
static void test_door_that_rests(void **state) {
    (void)state;
    app_state *app = viewer_start(true);
    open_map(app, MAPS "/flat.map");
    viewer_press(app, "X");
    const sl_wall wall = app->document.map.walls[0];
    const sl_point from = middle(wall.a, wall.b);
    const sl_point low = viewer_on_page(app, from), high = viewer_on_page(app, wall.b);
    assert_true(drag(app, from, 0.5 * (high.x - low.x), 0.5 * (high.y - low.y), false) > 0);
    const uint32_t edit = app->document.edit;
    const sl_point at = app->ui.pointer;
    input_move(app, (sl_point){at.x + 0.25, at.y + 0.25});
    app_tick(app, 1.0 / 60);
    assert_int_equal(app->document.edit, edit);
    viewer_end(app);
}

static void write_wall(const char *path, double x, double y) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "sightline 1\nwall %.17g %.17g %.17g %.17g\nstart %.17g %.17g 90\n", x, y, x + 20,
            y, x + 5, y - 3);
    fclose(file);
}

/// A map needs a wall: a door along all of the last one is not made.
static void test_door_for_the_last_wall(void **state) {
    (void)state;
    write_wall("one.map", 0, 5);
    app_state *app = viewer_start(true);
    open_map(app, "one.map");
    viewer_press(app, "X");
    const sl_map *map = &app->document.map;
    const sl_wall wall = map->walls[0];
    const double length = viewer_on_page(app, wall.b).x - viewer_on_page(app, wall.a).x;
    assert_true(drag(app, wall.a, length, 0, true) > 0);
    assert_int_equal(map->door_count, 0);
    assert_int_equal(map->wall_count, 1);
    assert_memory_equal(&map->walls[0].a, &wall.a, 2 * sizeof wall.a);
    assert_non_null(strstr(app->ui.message, "the last wall stays"));
    assert_fresh(app, true);
    assert_true(drag(app, wall.a, length / 2, 0, true) > 0);
    assert_int_equal(map->door_count, 1);
    assert_int_equal(map->wall_count, 1);
    viewer_end(app);
    remove("one.map");
}

/// Far from the origin messages have all digits of a place.
static void test_far_places(void **state) {
    (void)state;
    write_wall("far.map", 5000000, 400000);
    app_state *app = viewer_start(true);
    open_map(app, "far.map");
    assert_true(drag(app, (sl_point){5000002, 399998}, 60, 0, true) > 0);
    assert_non_null(strstr(app->ui.message, "wall from 5000002,399998 to 500000"));
    viewer_end(app);
    remove("far.map");
}

/// Esc, or Ctrl+Z, while the button is down takes all of it back.
static void test_taken_back(void **state) {
    (void)state;
    static const char *const keys[] = {"Escape", "Ctrl+Z"};
    for (int i = 0; i < 4; i++) {
        app_state *app = viewer_start(i % 2);
        open_map(app, MAPS "/effects/doors.map");
        const sl_wall *was = app->document.map.walls;
        const size_t count = app->document.map.wall_count;
        sl_wall *before = malloc(count * sizeof *before);
        memcpy(before, was, count * sizeof *before);
        const sl_point from =
            i < 2 ? middle(was[1].a, was[1].b) : (sl_point){was[1].a.x, was[1].a.y};
        assert_true(drag(app, from, 30, 25, false) > 0);
        viewer_press(app, keys[i % 2]);
        assert_int_equal(app->view.drag.kind, DRAG_NONE);
        input_move(app, (sl_point){5, 5});
        input_release(app, (sl_point){5, 5});
        if (app->ui.steady) app_settle(app);
        wait_for_all(app);
        assert_int_equal(app->document.map.wall_count, count);
        assert_memory_equal(app->document.map.walls, before, count * sizeof *before);
        assert_int_equal(app->document.history.done.count, 0);
        assert_fresh(app, true);
        free(before);
        viewer_end(app);
    }
}

/// How many pixels of a picture differ from another one, as a share.
static double difference(cairo_surface_t *a, cairo_surface_t *b) {
    const int width = cairo_image_surface_get_width(a), height = cairo_image_surface_get_height(a);
    size_t count = 0;
    assert_int_equal(width, cairo_image_surface_get_width(b));
    assert_int_equal(height, cairo_image_surface_get_height(b));
    for (int y = 0; y < height; y++) {
        const size_t row = (size_t)y * (size_t)cairo_image_surface_get_stride(a);
        const unsigned char *p = cairo_image_surface_get_data(a) + row;
        const unsigned char *q = cairo_image_surface_get_data(b) + row;
        for (int x = 0; x < width; x++) {
            int most = 0;
            for (int k = 0; k < 4; k++) most |= abs(p[4 * x + k] - q[4 * x + k]) > 24;
            count += most != 0;
        }
    }
    return (double)count / width / height;
}

/// The pictures that a drag has mended are those that are drawn as a whole, but for dashes.
static void test_mended(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", MAPS, maps[i]);
        app_state *app = viewer_start(true);
        open_map(app, path);
        const sl_wall *wall = &app->document.map.walls[app->document.map.wall_count / 2];
        assert_true(drag(app, wall->a, 30, 20, false) > 0);
        kept_picture *const kept[] = {&app->view.under, &app->view.over};
        cairo_surface_t *mended[2];
        for (int k = 0; k < 2; k++) {
            assert_true(kept[k]->items.count > 0);
            mended[k] = kept[k]->surface;
            kept[k]->surface = NULL;
            kept[k]->items.count = 0;
        }
        script_frame(app);
        for (int k = 0; k < 2; k++) {
            const double share = difference(mended[k], kept[k]->surface);
            if (share > 0.004) fail_msg("%s: %.2f %% differ", maps[i], 100 * share);
            cairo_surface_destroy(mended[k]);
        }
        viewer_end(app);
    }
}

/// A wall that is drawn shows while it is drawn.
static void test_new_wall(void **state) {
    (void)state;
    app_state *app = viewer_start(true);
    open_map(app, MAPS "/office.map");
    const size_t walls = app->document.map.wall_count;
    const sl_box b = app->document.baked->space.bounds;
    const sl_point outside = {b.min.x - 0.02 * (b.max.x - b.min.x), b.min.y};
    assert_true(drag(app, outside, 60, -35, true) > 0);
    assert_int_equal(app->document.map.wall_count, walls + 1);
    viewer_press(app, "Ctrl+Z");
    app_settle(app);
    assert_int_equal(app->document.map.wall_count, walls);
    viewer_end(app);
}

// --- jobs that end

static void test_stopped(void **state) {
    (void)state;
    write_turned("large.map", 30, 20000);
    app_state *app = viewer_start(true);
    open_map(app, MAPS "/office.map");
    const uint32_t cells = app->document.baked->space.cell_count;
    const uint32_t version = app->document.version;
    app->ui.steady = false;
    files_open(&app->desk, "large.map", false);
    assert_non_null(app->document.job);
    for (int i = 0; i < 3; i++) app_tick(app, 0.001);
    // Whatever stage it is in: it ends, and the map that was open stays.
    if (app->document.version == version) {
        viewer_press(app, "Escape");
        assert_null(app->document.job);
        assert_int_equal(app->document.baked->space.cell_count, cells);
        assert_true(app->document.has_visibility);
        assert_false(document_is_late(&app->document));
    }
    viewer_end(app);
    remove("large.map");
}

/// The window may close at any time.
static void test_closed(void **state) {
    (void)state;
    write_turned("large.map", 30, 20000);
    for (int waits = 0; waits < 40; waits += 13) {
        app_state *app = viewer_start(false);
        viewer_press(app, "F5"); // view cells as well
        files_open(&app->desk, "large.map", false);
        for (int i = 0; i < waits; i++) {
            const struct timespec pause = {0, 20000000};
            nanosleep(&pause, NULL);
            app_tick(app, 0.02);
        }
        viewer_end(app);
    }
    remove("large.map");
}

/// Counts the pictures of a folder, and removes it with them. Nothing else may be in it.
static size_t take_away(const char *folder) {
    size_t count = 0;
    DIR *dir = opendir(folder);
    assert_non_null(dir);
    for (struct dirent *entry; (entry = readdir(dir));) {
        char path[512];
        if (entry->d_name[0] == '.') continue;
        assert_int_equal(strncmp(entry->d_name, "frame-", 6), 0);
        assert_string_equal(strrchr(entry->d_name, '.'), ".png");
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        assert_int_equal(remove(path), 0);
        count++;
    }
    closedir(dir);
    assert_int_equal(rmdir(folder), 0);
    return count;
}

static void wait_for_pictures(app_state *app) {
    for (int i = 0; i < 60000 && app->exports.job; i++) {
        const struct timespec pause = {0, 1000000};
        nanosleep(&pause, NULL);
        app_tick(app, 0.001);
    }
    assert_null(app->exports.job);
}

/// Types the path of a file of the working folder into the dialog that asks for one.
static void choose_path(app_state *app, const char *name) {
    char path[512];
    assert_non_null(getcwd(path, sizeof path - 32));
    strcat(path, "/");
    strcat(path, name);
    viewer_press(app, "Ctrl+U");
    input_text(app, path);
    viewer_press(app, "Return");
}

static void save_way(app_state *app) {
    action_run(app, action_find("export_series"));
    script_frame(app);
    choose_path(app, "sightline-frames");
}

static void test_exported(void **state) {
    (void)state;
    app_state *app = viewer_start(false);
    open_map(app, MAPS "/office.map");
    viewer_press(app, "F9");
    for (int i = 0; i < 20; i++) app_tick(app, 1.0 / 60);
    viewer_press(app, "F9");
    const size_t frames = app->recorder.frames.count;
    assert_true(frames > 10);
    save_way(app);
    assert_non_null(app->exports.job);
    wait_for_pictures(app);
    assert_int_equal(take_away("sightline-frames"), (frames + 1) / 2);
    // Stopped: each picture is whole or not there.
    save_way(app);
    for (int i = 0; i < 3; i++) app_tick(app, 0.001);
    viewer_press(app, "Escape");
    assert_null(app->exports.job);
    assert_true(take_away("sightline-frames") <= 3);
    static const char *const keys[][2] = {{"Ctrl+E", "sightline-live.png"},
                                          {"Ctrl+G", "sightline-live.svg"},
                                          {"Ctrl+P", "sightline-live.pdf"}};
    for (int i = 0; i < 3; i++) {
        viewer_press(app, keys[i][0]);
        script_frame(app);
        choose_path(app, keys[i][1]);
        wait_for_pictures(app);
        assert_int_equal(strncmp(app->ui.message, "saved ", 6), 0);
        assert_int_equal(remove(keys[i][1]), 0);
    }
    // Closed while a picture is being written.
    save_way(app);
    app_tick(app, 0.001);
    viewer_end(app);
    take_away("sightline-frames");
}

/// Words about what was done go after a while, errors do not.
/// The tooltip of the plan goes once its cursor moves: it would cover the place.
static void test_cursor_tip(void **state) {
    (void)state;
    app_state *app = viewer_start(true);
    open_map(app, MAPS "/office.map");
    viewer_press(app, "F3");
    script_frame(app);
    viewer_press(app, "Tab");
    app_tick(app, 1);
    assert_int_equal(ui_tip_of(&app->ui).kind, HIT_PLAN);
    viewer_press(app, "Right");
    app_tick(app, 1);
    assert_int_equal(ui_tip_of(&app->ui).kind, HIT_NONE);
    viewer_end(app);
}

/// A house with a doubtful entrance: the eye begins in its room, and what is in doubt is said.
static void test_doubtful_house(void **state) {
    (void)state;
    viewer_write(
        "house.map",
        "sightline 1\nunit m\nwalls 4 0 10 0 10 6 0 6 0 0 2 0\n"
        "walls 3.8 -0.2 10.2 -0.2 10.2 6.2 -0.2 6.2 -0.2 -0.2 2 -0.2\nwall 30 -20 31 -20\n");
    app_state *app = viewer_start(true);
    viewer_open(app, "house.map");
    script_frame(app);
    const sl_point eye = app->view.eye.at;
    assert_true(eye.x > 0 && eye.x < 10 && eye.y > 0 && eye.y < 6);
    assert_non_null(strstr(app->ui.message, "inside is doubtful"));
    viewer_end(app);
    remove("house.map");
}

static void test_message(void **state) {
    (void)state;
    app_state *app = viewer_start(true);
    open_map(app, MAPS "/office.map");
    app->ui.steady = false;
    ui_say(&app->ui, false, "done");
    app_tick(app, 5);
    assert_string_equal(app->ui.message, "done");
    app_tick(app, 30);
    app_tick(app, 0);
    assert_non_null(strstr(app->ui.message, "office.map: "));
    ui_say(&app->ui, true, "wrong");
    app_tick(app, 30);
    app_tick(app, 0);
    assert_string_equal(app->ui.message, "wrong");
    viewer_end(app);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_maps),
        cmocka_unit_test(test_turned),
        cmocka_unit_test(test_corner),
        cmocka_unit_test(test_door),
        cmocka_unit_test(test_new_door),
        cmocka_unit_test(test_door_in_the_open),
        cmocka_unit_test(test_far_places),
        cmocka_unit_test(test_door_that_rests),
        cmocka_unit_test(test_door_for_the_last_wall),
        cmocka_unit_test(test_taken_back),
        cmocka_unit_test(test_new_wall),
        cmocka_unit_test(test_mended),
        cmocka_unit_test(test_exported),
        cmocka_unit_test(test_stopped),
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_doubtful_house),
        cmocka_unit_test(test_message),
        cmocka_unit_test(test_cursor_tip),
    };
    return cmocka_run_group_tests(tests, viewer_enter_folder, viewer_leave_folder);
}
