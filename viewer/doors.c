#include "doors.h"

#include "edit.h"

#include <math.h>

static uint32_t nearest_door(const sl_app *app, sl_point at, double within) {
    const sl_map *map = &app->document.map;
    uint32_t found = UINT32_MAX;
    for (size_t i = 0; i < map->door_count; i++) {
        const double distance =
            sl_edit_distance(at, map->doors[i].segment.a, map->doors[i].segment.b);
        if (distance > within) continue;
        within = distance;
        found = (uint32_t)i;
    }
    return found;
}

uint32_t sl_door_at(const sl_app *app, sl_point at) {
    return nearest_door(app, at, sl_edit_reach(app));
}

void sl_door_toggle(sl_app *app, uint32_t door) {
    sl_map *map = &app->document.map;
    if (door >= map->door_count) return;
    sl_app_keep(app);
    map->doors[door].open = !map->doors[door].open;
    sl_app_after_touch(app);
    sl_app_say(app, false, "door %s is %s", map->doors[door].name,
               map->doors[door].open ? "open" : "shut");
}

void sl_door_toggle_nearest(sl_app *app) {
    const uint32_t door = nearest_door(app, app->eye.at, INFINITY);
    if (door == UINT32_MAX)
        sl_app_say(app, false, "this map has no doors");
    else
        sl_door_toggle(app, door);
}
