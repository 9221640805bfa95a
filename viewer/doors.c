#include "doors.h"

#include "edit.h"

#include <math.h>

static uint32_t nearest_door(const app_state *app, sl_point at, double within) {
    const sl_map *map = &app->document.map;
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->door_count; i++) {
        const double distance = edit_distance(at, map->doors[i].segment.a, map->doors[i].segment.b);
        if (distance > within) continue;
        within = distance;
        found = (uint32_t)i;
    }
    return found;
}

uint32_t door_at(const app_state *app, sl_point at) {
    return nearest_door(app, at, edit_reach(app));
}

void door_toggle(app_state *app, uint32_t door) {
    sl_map *map = &app->document.map;
    if (door >= map->door_count) return;
    app_keep(app);
    map->doors[door].open = !map->doors[door].open;
    app_after_touch(app);
    app_say(app, false, "door %s is %s", map->doors[door].name,
            map->doors[door].open ? "open" : "shut");
}

void door_toggle_nearest(app_state *app) {
    const uint32_t door = nearest_door(app, app->view.eye.at, INFINITY);
    if (door == UINT32_MAX)
        app_say(app, false, "this map has no doors");
    else
        door_toggle(app, door);
}
