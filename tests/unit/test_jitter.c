/// Maps whose coordinates are all a little off: with the suggested tolerance they have the rooms,
/// the inside and the solid ground of the map that they come from.
#include "testing.h"

#include "map/scan.h"
#include "sightline/faults.h"
#include "sightline/support.h"
#include "space/subdivide.h"

#include <math.h>

static sl_box bounds;

/// What a map is at places on a grid: the number of the room, counted in the order of the grid, and
/// whether it is inside or solid. Places near a wall are not looked at.
enum { COLUMNS = 97, ROWS = 61 };

typedef struct look {
    int room[COLUMNS * ROWS];
    bool inside[COLUMNS * ROWS], solid[COLUMNS * ROWS];
    int rooms;
} look;

static sl_point place_at(int i) {
    const double x = (i % COLUMNS + 0.37) / COLUMNS, y = ((double)(i / COLUMNS) + 0.41) / ROWS;
    return (sl_point){bounds.min.x + x * (bounds.max.x - bounds.min.x),
                      bounds.min.y + y * (bounds.max.y - bounds.min.y)};
}

static double distance(sl_point p, const sl_wall *w) {
    const double x = w->b.x - w->a.x, y = w->b.y - w->a.y;
    const double along = ((p.x - w->a.x) * x + (p.y - w->a.y) * y) / (x * x + y * y);
    const double held = fmin(fmax(along, 0), 1);
    return hypot(p.x - w->a.x - held * x, p.y - w->a.y - held * y);
}

static void spread(const sl_space *space, uint32_t cell, int room, int *rooms) {
    rooms[cell] = room;
    const sl_cell *c = &space->cells[cell];
    for (uint32_t i = 0; i < c->directed_count; i++) {
        const uint32_t next = space->directed[c->first_directed + i].cell;
        if (!rooms[next]) spread(space, next, room, rooms);
    }
}

/// Takes the map over. `clear` are the places to look at.
static void look_at(sl_context *context, sl_map *map, double weld, const bool *clear, look *out) {
    sl_space space;
    assert_ok(context, sl_map_clean(context, map, &(sl_clean_options){.weld = weld}, NULL));
    assert_ok(context, sli_subdivide_mesh(context, map, &space));
    assert_ok(context, sl_space_check(context, &space));
    int *rooms = calloc(space.cell_count, sizeof *rooms);
    assert_non_null(rooms);
    *out = (look){0};
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        if (!clear[i]) continue;
        const uint32_t cell = sl_space_locate(&space, place_at(i));
        assert_true(cell != SL_NO_CELL);
        out->inside[i] = space.cells[cell].inside;
        out->solid[i] = space.cells[cell].solid;
        if (out->solid[i]) continue; // along the border, slivers join the rock of several places
        if (!rooms[cell]) spread(&space, cell, ++out->rooms, rooms);
        out->room[i] = rooms[cell];
    }
    free(rooms);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, map);
}

static double off(sl_random *random, double by) {
    return ((double)sl_random_below(random, 2000001) / 1e6 - 1) * by;
}

static void move(sl_random *random, double by, sl_point *p) {
    p->x += off(random, by);
    p->y += off(random, by);
}

/// Moves every coordinate by up to `by`, each on its own.
static void jitter(sl_random *random, double by, sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++) {
        move(random, by, &map->walls[i].a);
        move(random, by, &map->walls[i].b);
    }
    for (size_t i = 0; i < map->door_count; i++) {
        move(random, by, &map->doors[i].segment.a);
        move(random, by, &map->doors[i].segment.b);
    }
    for (size_t i = 0; i < map->start_count; i++) move(random, by, &map->starts[i].at);
}

static void turn(double degrees, sl_map *map) {
    const double c = cos(degrees * acos(-1) / 180), s = sin(degrees * acos(-1) / 180);
#define TURN(p) ((p) = (sl_point){c * (p).x - s * (p).y, s * (p).x + c * (p).y})
    for (size_t i = 0; i < map->wall_count; i++) {
        TURN(map->walls[i].a);
        TURN(map->walls[i].b);
    }
    for (size_t i = 0; i < map->door_count; i++) {
        TURN(map->doors[i].segment.a);
        TURN(map->doors[i].segment.b);
    }
    for (size_t i = 0; i < map->start_count; i++) TURN(map->starts[i].at);
#undef TURN
}

static void read_map(sl_context *context, const char *name, double degrees, sl_map *map) {
    char path[4096];
    snprintf(path, sizeof path, "%s/maps/%s", SIGHTLINE_SOURCE_DIR, name);
    assert_ok(context, sl_map_read(context, path, NULL, map));
    if (degrees != 0) turn(degrees, map);
}

static void check(const char *name, double degrees, uint64_t seeds) {
    static const double sizes[] = {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6};
    static look truth, found;
    static bool clear[COLUMNS * ROWS];
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    read_map(context, name, degrees, &map);
    bounds = sl_map_bounds(&map);
    const double size = fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        clear[i] = true;
        for (size_t k = 0; k < map.wall_count && clear[i]; k++)
            clear[i] = distance(place_at(i), &map.walls[k]) > 1e-4 * size;
    }
    look_at(context, &map, -1, clear, &truth);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_random random = {.state = seed};
        const double by = sizes[seed % (sizeof sizes / sizeof *sizes)] * size;
        double weld;
        read_map(context, name, degrees, &map);
        jitter(&random, by, &map);
        assert_ok(context, sl_suggest_weld(context, &map, &weld));
        if (!(weld > 0)) fail_msg("%s, seed %d: nothing suggested", name, (int)seed);
        if (seed == 1 && strcmp(name, "office.map") == 0) {
            // Without a tolerance the difference would be seen.
            sl_map copy = {0};
            assert_ok(context, sl_map_copy(context, &map, &copy));
            look_at(context, &copy, 0, clear, &found);
            assert_memory_not_equal(&truth, &found, sizeof truth);
        }
        look_at(context, &map, weld, clear, &found);
        if (memcmp(&truth, &found, sizeof truth) != 0)
            fail_msg("%s, seed %d: %d rooms and not %d with --weld %g", name, (int)seed,
                     found.rooms, truth.rooms, weld);
    }
    sl_context_destroy(context);
}

static void jittered_maps_keep_their_rooms(void **state) {
    (void)state;
    check("office.map", 0, testing_seeds(100));
    check("office.map", 17.3, testing_seeds(20));
    check("courtyard.map", 0, testing_seeds(20));
    check("cellar.txt", 0, testing_seeds(20));
}

/// What is meant is not closed: a slit, and a door's width.
static void what_is_meant_stays(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const char *const texts[] = {
        "sightline 1\nwall 0 0 9.9 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n",
        "sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\n",
        "sightline 1\nwall 0 0 1 0\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        sl_map map = {0};
        double weld = 1;
        assert_ok(context, sli_map_read_text(context, "m", texts[i], strlen(texts[i]), &map));
        assert_ok(context, sl_suggest_weld(context, &map, &weld));
        assert_true(weld == 0);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(jittered_maps_keep_their_rooms),
        cmocka_unit_test(what_is_meant_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
