/// A plan with many doors, for tests and measurements.
#ifndef SL_DOORS_PLAN_H
#define SL_DOORS_PLAN_H

#include "sightline/map.h"
#include "sightline/support.h"

enum { DOORS_COLUMNS = 6, DOORS_ROWS = 4, DOORS = 30, DOORS_ROOM = 10 };

/// Fills an empty map: rooms in a grid, a gap of 2 in each wall between two of them, doors in the
/// first 30 gaps.
static inline sl_status doors_plan(sl_context *context, sl_map *map) {
    const double width = DOORS_COLUMNS * DOORS_ROOM, height = DOORS_ROWS * DOORS_ROOM;
    const sl_point box[5] = {{0, 0}, {width, 0}, {width, height}, {0, height}, {0, 0}};
    for (int i = 0; i < 4; i++) SL_TRY(sl_map_add_wall(context, map, box[i], box[i + 1], 0));
    for (int i = 0; i < DOORS_COLUMNS; i++)
        for (int k = 0; k < DOORS_ROWS; k++)
            for (int upright = 0; upright < 2; upright++) {
                if (upright ? i == 0 : k == 0) continue;
                const double x = i * DOORS_ROOM, y = k * DOORS_ROOM, from = 3.0 + (i + 2 * k) % 3;
                const double along[4] = {0, from, from + 2, DOORS_ROOM};
                sl_point p[4];
                for (int j = 0; j < 4; j++)
                    p[j] = upright ? (sl_point){x, y + along[j]} : (sl_point){x + along[j], y};
                SL_TRY(sl_map_add_wall(context, map, p[0], p[1], 0));
                SL_TRY(sl_map_add_wall(context, map, p[2], p[3], 0));
                if (map->door_count == DOORS) continue;
                char name[16];
                snprintf(name, sizeof name, "d%zu", map->door_count);
                SL_TRY(sl_map_add_door(context, map, name, (sl_segment){p[1], p[2]}, true, 0));
            }
    return SL_OK;
}

#endif
